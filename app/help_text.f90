!> Texts of the command `help`.
!>
!> In: the name of a command. Out: text.
module camroller_help_text
   implicit none
   private

   public :: help_for

   character(len=*), parameter :: n = new_line("a")

contains

   !> Help for a command, or for the program where the name is none of a command.
   pure function help_for(command) result(text)
      !> Name of the command
      character(len=*), intent(in) :: command
      !> A few lines
      character(len=:), allocatable :: text

      select case (command)
      case ("run", "check")
         text = deck_help(command)
      case ("audit", "study")
         text = study_help(command)
      case ("sweep", "merge", "rerun", "ehl")
         text = help_for_many(command)
      case ("defaults")
         text = "camroller defaults [GROUP] [--markdown]"//n//n// &
            & "Print a complete deck with every key explained, or one group of it."//n//n// &
            & "  --markdown                 the same as a page"
      case ("export")
         text = "camroller export FILE.h5 [--series [--case N] | --summary] [--columns NAMES] [--format FORM] [-o FILE]"//n//n// &
            & "Print the series of one case, or the summary of all cases, as comma-separated values or JSON."//n//n// &
            & "  --series                   series over the cam angle (the default)"//n// &
            & "  --case N                   case, from 0 as in the file; 0 where not given"//n// &
            & "  --summary                  one row for each case"//n// &
            & "  --columns NAMES            these columns, parted by commas, beside the cam angle or the keys that vary"//n// &
            & "  --format FORM              'csv', with a line of names and one of units (the default), 'plain', with one"//n// &
            & "                             line of names with units, or 'json'"//n// &
            & "  -o, --output FILE          file to write; printed where not given, or where FILE is -"
      case ("selftest")
         text = "camroller selftest"//n//n// &
            & "Compute key numbers of a small deck and compare them with values that are built in. Takes a few seconds, reads"// &
            & n//"and writes no file. Prints machine and build; where a number differs, the exit code is 7."
      case ("version")
         text = "camroller version"//n//n//"Print version, commit, compiler and compiler options."
      case default
         text = "camroller: friction, slip and drive torque of roller-finger-follower valve trains"//n//n// &
            & "  camroller run DECK         compute and write an HDF5 file"//n// &
            & "  camroller sweep DECK       compute many cases in threads, restartable"//n// &
            & "  camroller merge DECK       one file from the parts of a sweep"//n// &
            & "  camroller rerun FILE.h5    compute a file again and compare every bit"//n// &
            & "  camroller check DECK       read and check a deck, print the resulting values"//n// &
            & "  camroller study DECK       measure what accuracy costs"//n// &
            & "  camroller audit DECK       measure what each effect is worth and costs"//n// &
            & "  camroller ehl DECK         solve the contact over the cycle, with squeeze"//n// &
            & "  camroller defaults [GROUP] print a complete deck with every key explained"//n// &
            & "  camroller export FILE.h5   print results as comma-separated values"//n// &
            & "  camroller version          version and build"//n// &
            & "  camroller selftest         compute a few numbers and compare them with values built in"//n// &
            & "  camroller help [COMMAND]   this, or more about a command"//n//n// &
            & "Exit codes: 0 success, 2 command line, 3 deck or table, 4 impossible values or a law out of range,"//n// &
            & "5 no convergence, 6 file, 7 a rerun differs, 8 stopped before the end, 9 too little memory,"//n// &
            & "70 internal error."
      end select
   end function help_for

   !> Help for commands on one deck.
   pure function deck_help(command) result(text)
      !> Name of the command
      character(len=*), intent(in) :: command
      !> A few lines
      character(len=:), allocatable :: text

      select case (command)
      case ("run")
         text = "camroller run DECK [-o FILE] [--set group.key=value]... [--point key=value]... [--no-sweep] [--quiet]"//n//n// &
            & "Compute every case of a deck and write one HDF5 file: the deck's name with .h5 in the present folder,"// &
            & n// &
            & "or FILE. An earlier file of that name is replaced only when the new one is complete. Ends with a table of the"// &
            & n//"results. DECK may be -, the standard input."//n//n// &
            & "  -o, --output FILE          file to write"//n// &
            & "  -s, --set group.key=value  other value than the deck's; may be repeated"//n// &
            & "  --point key=value          one case: the deck without its &sweep, with this value, as speed_rpm=3000 of"//n// &
            & "                             &operating_point or group.key=value; may be repeated"//n// &
            & "  --no-sweep                 one case: the deck without its &sweep"//n// &
            & "  -q, --quiet                print errors only"
      case default
         text = "camroller check DECK [--set group.key=value]... [--point key=value]... [--no-sweep] [--draw FILE.svg]"//n//n// &
            & "Read a deck, check every case of it, and print what it comes to: oil, cam, ramps, loads, margins and film of the"// &
            & n//"deck's own case, then every value. Of many cases a few are run, to estimate the time, the memory and the disk"// &
            & n//"space of all of them. DECK may be -, the standard input."//n//n// &
            & "  -s, --set group.key=value  other value than the deck's; may be repeated"//n// &
            & "  --point key=value          the deck without its &sweep, with this value, as in 'camroller run'"//n// &
            & "  --no-sweep                 the deck without its &sweep"//n// &
            & "  --draw FILE.svg            draw the mechanism to scale"
      end select
   end function deck_help

   !> Help for commands that measure.
   pure function study_help(command) result(text)
      !> Name of the command
      character(len=*), intent(in) :: command
      !> A few lines
      character(len=:), allocatable :: text

      select case (command)
      case ("audit")
         text = "camroller audit DECK [-o FILE] [--repeats N] [--set group.key=value]..."//n//n// &
            & "Run every case with all its effects, without each of them, with each alone and with those that it needs."//n// &
            & "Compare mean torque, smallest film, slip and time, and the changes with the estimates made before a run."//n// &
            & "Prints a table and writes one HDF5 file: the deck's name with _audit.h5 in the present folder, or FILE."//n//n// &
            & "  -o, --output FILE          file to write"//n// &
            & "  --repeats N                runs whose median time counts; 5 where not given"//n// &
            & "  -s, --set group.key=value  other value than the deck's; may be repeated"//n// &
            & "  -q, --quiet                print errors only"
      case ("study")
         text = "camroller study DECK [-o FILE] [--repeats N] [--quick] [--set group.key=value]..."//n//n// &
            & "Measure what accuracy costs: the default method for several accuracies, each other one for several tolerances"//n// &
            & "or steps, with errors relative to a reference by two unrelated methods, work and time. Prints a table and"//n// &
            & "writes one HDF5 file: the deck's name with _study.h5 in the present folder, or FILE."//n//n// &
            & "  -o, --output FILE          file to write"//n// &
            & "  --repeats N                runs whose median time counts; 5 where not given"//n// &
            & "  --quick                    a few settings of each method only"//n// &
            & "  --film                     the numerical film instead: as a film law with tables of several accuracies, and"//n// &
            & "                             solved over the cycle on several grids, beside the film law of the deck;"//n// &
            & "                             writes the deck's name with _film_study.h5"//n// &
            & "  --laws                     the film laws instead: every case with each of them, and the range of results;"//n// &
            & "                             prints a table, writes no file"//n// &
            & "  -s, --set group.key=value  other value than the deck's; may be repeated"//n// &
            & "  -q, --quiet                print errors only"
      case default
         text = ""
      end select
   end function study_help

   !> Help for the commands on many cases.
   pure function help_for_many(command) result(text)
      !> Name of the command
      character(len=*), intent(in) :: command
      !> A few lines
      character(len=:), allocatable :: text

      select case (command)
      case ("ehl")
         text = "camroller ehl DECK [-o FILE] [--set group.key=value]..."//n//n// &
            & "Solve the contact over the cycle with a transient film (squeeze), together with the roller's slip."//n// &
            & "Prints film and slip of every case and lobe shape, their differences between two grids and from steady"//n// &
            & "films, and film and friction beside the closed formulas. Writes one HDF5 file with pressure and film across"//n// &
            & "the contact: the deck's name with _ehl.h5 in the present folder, or FILE. The number of nodes grows from"//n// &
            & "129 to 513 until film and mean slip on two grids differ by less than ehl.accuracy; a case in which they"//n// &
            & "never do is an error and has no numbers."//n//n// &
            & "  -o, --output FILE          file to write"//n// &
            & "  -s, --set group.key=value  other value than the deck's; may be repeated"//n// &
            & "  -q, --quiet                print errors only"
      case ("sweep")
         text = "camroller sweep DECK [-o FILE] [--threads N] [--shard K/N] [--resume] [--log-every S] [--set ...] [--quiet]"// &
            & n//n// &
            & "Compute every case of a deck with a &sweep, in threads, and write one HDF5 file. While it runs, results are in"// &
            & n// &
            & "FILE.part-*; after any kind of end, --resume computes the missing cases. The file does not depend on threads,"//n// &
            & "shards and interruptions. Without --resume an earlier FILE is replaced when all cases are done; a remark says"//n// &
            & "so where it is of another study."//n//n// &
            & "  -o, --output FILE          file to write: the deck's name with .h5 in the present folder where not given"//n// &
            & "  -j, --threads N            threads, 1 to 1024; as many as there are cores where not given"//n// &
            & "  --shard K/N                only the K-th of N equal parts of the cases; 'camroller merge' makes the file"//n// &
            & "  --resume                   continue from part files, or start where there are none; nothing to do where"//n// &
            & "                             FILE has every case of this study; an error where FILE is anything else"//n// &
            & "  --log-every S              seconds between lines in a log; 60 where not given"//n// &
            & "  -s, --set group.key=value  other value than the deck's; may be repeated"//n// &
            & "  -q, --quiet                print errors only"
      case ("merge")
         text = "camroller merge DECK [-o FILE] [--partial] [--set group.key=value]... [--quiet]"//n//n// &
            & "Make the one file of a sweep from its parts FILE.part-*, and remove them. Takes the deck, FILE and values that"// &
            & n// &
            & "the sweep was given."//n//n// &
            & "  -o, --output FILE          file to write: the deck's name with .h5 in the present folder where not given"//n// &
            & "  --partial                  also where cases are missing: they have status -1, FILE has the"//n// &
            & "                             attributes 'complete' 0 and 'missing_cases'; the parts stay for 'camroller sweep"//n// &
            & "                             --resume'"//n// &
            & "  -s, --set group.key=value  other value than the deck's; may be repeated"//n// &
            & "  -q, --quiet                print errors only"
      case default
         text = "camroller rerun FILE.h5 [--threads N] [--log-every S] [--quiet]"//n//n// &
            & "Compute the cases of a result file (of 'ehl' too) again from the deck stored in it, and compare every bit."// &
            & n// &
            & "Reports what differs and by how much, and which build made the file; where something differs, the exit code is"// &
            & n// &
            & "then 7."//n//n// &
            & "  -j, --threads N            threads, 1 to 1024; as many as there are cores where not given"//n// &
            & "  --log-every S              seconds between lines in a log; 60 where not given"//n// &
            & "  -q, --quiet                print errors only"
      end select
   end function help_for_many

end module camroller_help_text
