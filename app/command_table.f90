!> The commands of the program: one table with name, subject, options and help of each.
!>
!> Out: the table, texts of the command `help`. `cli` reads the words of a command line by it; `commands` has one line for each
!> command that says what runs.
module camroller_command_table
   use camroller_flexible_measure_list, only : event_words
   use camroller_limits_page, only : unseen_limit
   use camroller_quotes, only : replaced
   implicit none
   private

   public :: command_t, list_commands, find_command, find_option, help_for, help_for_all
   public :: exit_codes

   !> One option of a command
   type :: option_t
      !> Long name with its dashes, short name or blank
      character(len=12) :: name = ""
      character(len=2) :: short = ""
      !> What its value is; blank where it takes none
      character(len=16) :: value = ""
      !> Meaning, lines parted by `n`
      character(len=:), allocatable :: meaning
      !> What it cannot be given with: names of options of the command, or its subject, single blanks between them
      character(len=:), allocatable :: excluded
      !> May it be given more than once?
      logical :: may_be_repeated = .false.
   end type option_t

   !> One command
   type :: command_t
      character(len=8) :: name = ""
      !> What it is about, in brackets where it may be left out; blank where it takes no word
      character(len=9) :: subject = ""
      !> A few words in the list of commands
      character(len=:), allocatable :: summary
      !> What it does
      character(len=:), allocatable :: description
      type(option_t), allocatable :: options(:)
   end type command_t

   character(len=*), parameter :: n = new_line("a")
   !> Exit codes of the program, in lines
   character(len=*), parameter :: exit_codes(3) = [character(len=96) :: &
      & "0 success, 2 command line, 3 deck or table, 4 impossible values or a law out of range,", &
      & "5 no convergence, 6 file, 7 a rerun differs, 8 stopped before the end, 9 too little memory,", "70 internal error."]
   !> Column where meanings of options and commands begin
   integer, parameter :: meaning_column = 29
   !> Meanings of options that several commands have
   character(len=*), parameter :: meaning_set = "replaces a value of the deck; of several values of a key the last counts", &
      & meaning_quiet = "print errors only", meaning_repeats = "runs whose median time counts; 5 where not given", &
      & meaning_threads = "threads, 1 to 1024; as many as there are cores where not given", &
      & meaning_log = "seconds between lines in a log; 60 where not given", &
      & meaning_default = "file to write: the deck's name with .h5 in the present folder where not given"

contains

   !> The table, in the order of the list of commands.
   subroutine list_commands(commands)
      !> The commands
      type(command_t), allocatable, intent(out) :: commands(:)

      allocate (commands(0))
      call list_runs(commands)
      call list_measurements(commands)
      call list_texts(commands)
   end subroutine list_commands

   !> Commands that compute the cases of a deck, and `check`, which says what they come to.
   subroutine list_runs(commands)
      type(command_t), allocatable, intent(inout) :: commands(:)

      call add(commands, "run", "DECK", "compute and write an HDF5 file", &
         & "Compute every case of a deck and write one HDF5 file: the deck's name with .h5 in the present folder, or FILE."//n// &
         & "An earlier file of that name is replaced only when the new one is complete. Ends with a table of the results."//n// &
         & "DECK may be -, the standard input.")
      call add_option(commands, "--output", "-o", "FILE", "file to write")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--point", "", "key=value", "one case: the deck without its &sweep, with this value, as "// &
         & "speed_rpm=3000 of"//n//"&operating_point or group.key=value", may_be_repeated=.true.)
      call add_option(commands, "--no-sweep", "", "", "one case: the deck without its &sweep")
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)

      call add(commands, "sweep", "DECK", "compute many cases in threads, restartable", &
         & "Compute every case of a deck with a &sweep, in threads, and write one HDF5 file. While it runs, results are in"//n// &
         & "FILE.part-*; however it ended, --resume computes the missing cases. The file does not depend on threads,"//n// &
         & "shards and interruptions. Without --resume an earlier FILE is replaced when all cases are done; a remark says"//n// &
         & "so where it is of another study.")
      call add_option(commands, "--output", "-o", "FILE", meaning_default)
      call add_option(commands, "--threads", "-j", "N", meaning_threads)
      call add_option(commands, "--shard", "", "K/N", "only the K-th of N equal parts of the cases; 'camroller merge' makes "// &
         & "the file")
      call add_option(commands, "--resume", "", "", "continue from part files, or start where there are none; nothing to do "// &
         & "where"//n//"FILE has every case of this study; an error where FILE is anything else")
      call add_option(commands, "--log-every", "", "S", meaning_log, excluded="--quiet")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)

      call add(commands, "merge", "DECK", "one file from the parts of a sweep", &
         & "Make the one file of a sweep from its parts FILE.part-*, and remove them. Takes the deck, FILE and values that"//n// &
         & "the sweep was given.")
      call add_option(commands, "--output", "-o", "FILE", meaning_default)
      call add_option(commands, "--partial", "", "", "also where cases are missing: they have status -1, FILE has the"//n// &
         & "attributes 'complete' 0 and 'missing_cases'; the parts stay for 'camroller sweep"//n//"--resume'")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)

      call add(commands, "rerun", "FILE.h5", "compute a file again and compare every bit", &
         & "Compute the cases of a result file (of 'ehl' too) again from the deck stored in it, and compare every bit"//n// &
         & "of them: swept values, status, messages, scalars, series, histories, profiles. What repeats the deck,"//n// &
         & "/deck/values and /deck/remarks, and rows of a table of cases, which are the input, are not compared;"//n// &
         & "where results differ, defaults that were others when the file was made are named first."//n// &
         & "Reports what differs and by how much, and which build made the file. The exit code is 7 where something differs.")
      call add_option(commands, "--threads", "-j", "N", meaning_threads)
      call add_option(commands, "--log-every", "", "S", meaning_log, excluded="--quiet")
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)

      call add(commands, "check", "DECK", "read and check a deck, print the resulting values", &
         & "Read a deck, check every case of it, and print what follows from it: oil, cam, ramps, loads, margins and film"//n// &
         & "of the deck's own case, then every value. Of many cases a few are run, to estimate the time, the memory and the"//n// &
         & "disk space of all of them. DECK may be -, the standard input.")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--point", "", "key=value", "the deck without its &sweep, with this value, as in "// &
         & "'camroller run'", may_be_repeated=.true.)
      call add_option(commands, "--no-sweep", "", "", "the deck without its &sweep")
      call add_option(commands, "--draw", "", "FILE.svg", "draw the mechanism to scale")
      call add_option(commands, "--draw-lift", "", "FILE.svg", "draw lift, velocity, acceleration and jerk, of a table also "// &
         & "before smoothing")
      call add_option(commands, "--cam", "", "FILE.csv", "write the cam as a table: contour, radius of curvature, pressure "// &
         & "angle; no table of another cam is replaced")
   end subroutine list_runs

   !> Commands that measure, and the numerical film over the cycle.
   subroutine list_measurements(commands)
      type(command_t), allocatable, intent(inout) :: commands(:)

      call add(commands, "study", "DECK", "measure what accuracy costs", &
         & "Measure what accuracy costs: the default method for several accuracies, each other one for several tolerances"//n// &
         & "or steps, with errors relative to a reference by two unrelated methods, work and time. Prints a table and"//n// &
         & "writes one HDF5 file: the deck's name with _study.h5 in the present folder, or FILE.")
      call add_option(commands, "--output", "-o", "FILE", "file to write")
      call add_option(commands, "--repeats", "", "N", meaning_repeats)
      call add_option(commands, "--quick", "", "", "a few settings of each method only")
      call add_option(commands, "--film", "", "", "the numerical film instead: as a film law with tables of several "// &
         & "accuracies, and"//n//"solved over the cycle on several grids, beside the film law of the deck;"//n// &
         & "writes the deck's name with _film_study.h5")
      call add_option(commands, "--laws", "", "", "the film laws instead: every case with each of them, and the range of "// &
         & "results;"//n//"prints a table, writes no file", excluded="--film --quick --repeats --output --quiet")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)

      call add(commands, "audit", "DECK", "measure the influence and the cost of each effect", &
         & "Run every case with all its effects, without each of them, with each alone and with those that it needs."//n// &
         & "Compare mean torque, smallest film, slip and time, and the changes with the estimates made before a run."//n// &
         & "Prints a table and writes one HDF5 file: the deck's name with _audit.h5 in the present folder, or FILE.")
      call add_option(commands, "--output", "-o", "FILE", "file to write")
      call add_option(commands, "--repeats", "", "N", meaning_repeats)
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)

      call add(commands, "limit", "DECK", "speeds up to which the train follows its cam", &
         & "Find the lowest speeds at which the joint of the pivot unloads, the lash adjuster pumps up, cam and roller"//n// &
         & "part in the "//event_words//", and the valve meets its seat too fast or no longer closes: for the deck"//n// &
         & "without its &sweep, whatever its speed. Those of the rigid train follow from its forces. A train with &dynamics"//n// &
         & "is run at one speed after another, and between two of them where a limit was passed, with a tolerance of 1e-4"//n// &
         & "where the deck gives none; "//unseen_limit//". Prints a table.")
      call add_option(commands, "--to", "", "SPEED", "highest speed of the camshaft tried [rev/min]; 6000 where not given")
      call add_option(commands, "--step", "", "SPEED", "step of these speeds [rev/min]; 100 where not given")
      call add_option(commands, "--seating", "", "SPEED", "speed of the valve at its seat that is too fast [m/s]; 0.5 where "// &
         & "not given")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--quiet", "-q", "", "print the table only")

      call add(commands, "ehl", "DECK", "solve the contact over the cycle, with squeeze", &
         & "Solve the contact over the cycle with a transient film (squeeze), together with the roller's slip."//n// &
         & "Prints film and slip of every case and lobe shape, their differences between two grids and from steady"//n// &
         & "films, and film and friction beside the closed formulas. Writes one HDF5 file with pressure and film across"//n// &
         & "the contact: the deck's name with _ehl.h5 in the present folder, or FILE. The number of nodes grows from"//n// &
         & "129 to 513 until film and mean slip on two grids differ by less than ehl.accuracy; a case in which they"//n// &
         & "never do is an error and has no numbers.")
      call add_option(commands, "--output", "-o", "FILE", "file to write")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)
   end subroutine list_measurements

   !> Commands that print.
   subroutine list_texts(commands)
      type(command_t), allocatable, intent(inout) :: commands(:)

      call add(commands, "defaults", "[GROUP]", "print a complete deck with every key explained", &
         & "Print a complete deck with every key explained, or one group of it.")
      call add_option(commands, "--markdown", "", "", "the same as a page")

      call add(commands, "fmu", "DECK", "write an FMU for co-simulation", &
         & "Write the valve trains of a deck as a Functional Mock-up Unit for co-simulation: the deck's name with .fmu in"//n// &
         & "the present folder, or FILE. Inputs are speed, oil temperature, gas pressure and the supply pressure of lash"//n// &
         & "adjusters; parameters the numbers that the deck gives; outputs torques, loads, films and slip of all cams. It"//n// &
         & "holds the library and what that needs, which are taken from ../lib/camroller of the program's folder, where"//n// &
         & "cmake --install puts them.")
      call add_option(commands, "--output", "-o", "FILE", "file to write")
      call add_option(commands, "--fmi", "", "N", "version of FMI, 2 or 3; 3 where not given")
      call add_option(commands, "--library", "", "FOLDER", "folder of the library")
      call add_option(commands, "--set", "-s", "group.key=value", meaning_set, may_be_repeated=.true.)
      call add_option(commands, "--quiet", "-q", "", meaning_quiet)

      call add(commands, "export", "FILE.h5", "print results as comma-separated values or JSON", &
         & "Print the series of one case, or the summary of all cases, as comma-separated values or JSON. A speed at which"//n// &
         & "something would happen that never does is infinite: Infinity, in JSON the text ""Infinity"". A case without a"//n// &
         & "result has NaN, in JSON null.")
      call add_option(commands, "--series", "", "", "series over the cam angle (the default)")
      call add_option(commands, "--case", "", "N", "number of the case, from 0 as in the file; 0 where not given")
      call add_option(commands, "--summary", "", "", "one row for each case", excluded="--series --case")
      call add_option(commands, "--columns", "", "NAMES", "these columns, separated by commas, beside the cam angle or the "// &
         & "keys that vary")
      call add_option(commands, "--format", "", "FORM", "'csv', with a line of names and one of units (the default), 'plain', "// &
         & "with one"//n//"line of names with units, or 'json'")
      call add_option(commands, "--output", "-o", "FILE", "file to write; printed where not given, or where FILE is -")

      call add(commands, "version", "", "version and build", "Print version, commit, compiler and compiler options.")
      call add(commands, "selftest", "", "compute a few numbers and compare them with values built in", &
         & "Compute key numbers of a small deck and compare them with values that are built in. Takes a few seconds, reads"//n// &
         & "and writes no file. Prints machine and build; where a number differs, the exit code is 7.")
      call add(commands, "help", "[COMMAND]", "this, or more about a command", "Print the list of commands, or the help of one.")
      call add_option(commands, "--man", "", "", "the help of all commands as a manual page", excluded="COMMAND --completion")
      call add_option(commands, "--completion", "", "", "completion of commands and options for bash", excluded="COMMAND")
   end subroutine list_texts

   !> Append a command; every command takes `--help`.
   subroutine add(commands, name, subject, summary, description)
      type(command_t), allocatable, intent(inout) :: commands(:)
      !> Name, what it is about, a few words, what it does
      character(len=*), intent(in) :: name, subject, summary, description

      commands = [commands, command_t()]
      associate (command => commands(size(commands)))
         command%name = name
         command%subject = subject
         command%summary = summary
         command%description = description
         allocate (command%options(0))
      end associate
      call add_option(commands, "--help", "-h", "", "print this")
   end subroutine add

   !> Append an option to the last command.
   subroutine add_option(commands, name, short, value, meaning, excluded, may_be_repeated)
      type(command_t), intent(inout) :: commands(:)
      !> Long name, short name, what its value is, meaning; what follows is added to it
      character(len=*), intent(in) :: name, short, value, meaning
      !> What it cannot be given with, as in `option_t`; nothing where not given
      character(len=*), intent(in), optional :: excluded
      !> May it be given more than once? Not where not given
      logical, intent(in), optional :: may_be_repeated

      associate (command => commands(size(commands)))
         command%options = [command%options, option_t()]
         associate (option => command%options(size(command%options)))
            option%name = name
            option%short = short
            option%value = value
            option%meaning = meaning
            option%excluded = ""
            if (present(excluded)) option%excluded = excluded
            if (present(may_be_repeated)) option%may_be_repeated = may_be_repeated
            if (option%may_be_repeated) option%meaning = option%meaning//";"//n//"may be repeated"
            if (option%excluded /= "") option%meaning = option%meaning//";"//n//"not together with "//option%excluded
         end associate
      end associate
   end subroutine add_option

   !> Position of a command, 0 where there is none of that name.
   pure function find_command(commands, name) result(position)
      !> The commands
      type(command_t), intent(in) :: commands(:)
      !> Name looked for
      character(len=*), intent(in) :: name
      !> Position, or 0
      integer :: position

      do position = size(commands), 1, -1
         if (commands(position)%name == name) return
      end do
   end function find_command

   !> Position of an option of a command by its long or short name, 0 where it has none.
   pure function find_option(command, name) result(position)
      !> The command
      type(command_t), intent(in) :: command
      !> Name looked for
      character(len=*), intent(in) :: name
      !> Position, or 0
      integer :: position

      position = 0
      if (name == "") return
      do position = size(command%options), 1, -1
         if (name == command%options(position)%name .or. name == command%options(position)%short) return
      end do
   end function find_option

   !> Help for a command.
   subroutine help_for(command, text)
      !> The command
      type(command_t), intent(in) :: command
      !> A few lines
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: line
      integer :: i

      text = "camroller "//trim(trim(command%name)//" "//command%subject)//" [options]"//n//n//command%description//n
      ! The first option is --help
      do i = 1, size(command%options)
         associate (option => command%options(modulo(i, size(command%options)) + 1))
            line = "  "
            if (option%short /= "") line = "  "//option%short//", "
            text = text//n//padded(line//trim(trim(option%name)//" "//option%value))
            text = text//replaced(option%meaning, n, n//padded(""))
         end associate
      end do
   end subroutine help_for

   !> Help for the program.
   subroutine help_for_all(commands, text)
      !> The commands
      type(command_t), intent(in) :: commands(:)
      !> A few lines
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = "camroller: friction, slip and drive torque of roller-finger-follower valve trains"//n
      do i = 1, size(commands)
         text = text//n//padded("  camroller "//trim(trim(commands(i)%name)//" "//commands(i)%subject))//commands(i)%summary
      end do
      text = text//n//n// &
         & "Exit codes: "//trim(exit_codes(1))//n//trim(exit_codes(2))//n//trim(exit_codes(3))
   end subroutine help_for_all

   !> A text made as long as the column before a meaning.
   pure function padded(text) result(long)
      character(len=*), intent(in) :: text
      !> With blanks behind, at least one
      character(len=max(meaning_column, len(text) + 1)) :: long

      long = text
   end function padded

end module camroller_command_table
