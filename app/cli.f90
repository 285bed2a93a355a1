!> The command line: words in, configuration out.
!>
!> In: the arguments of the program. Out: what to do, or a usage error.
module camroller_cli
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_command_table, only : command_t, find_command, find_option, list_commands
   use camroller_deck, only : override_t, add_override
   use camroller_deck_text, only : to_lower
   use camroller_export, only : export_formats
   use camroller_text_lines, only : add_line, line_t
   use camroller_kinds, only : wp
   use camroller_near_names, only : nearest_name
   use camroller_names, only : write_names, index_of_name
   use camroller_number_text, only : integer_text, is_number
   use camroller_option_values, only : read_positive, read_shard, read_whole_number
   use camroller_quotes, only : in_quotes, is_quoted
   implicit none
   private

   public :: config_t, get_arguments, read_arguments

   !> Most threads: more than machines have cores, fewer than the system refuses to start
   integer, parameter :: most_threads = 1024

   !> What to do
   type :: config_t
      !> Name of the command
      character(len=:), allocatable :: command
      !> Deck, result file, group or command that the command is about; blank where not given
      character(len=:), allocatable :: subject
      !> File to write; blank where not given
      character(len=:), allocatable :: output
      !> Values given beside the deck
      type(override_t), allocatable :: overrides(:)
      !> How often each option of the command was given, in the order of its table
      integer, allocatable :: given(:)
      !> Keys that a point has a value of, as `group.key` in small letters
      type(line_t), allocatable :: point_keys(:)
      !> Say nothing but errors?
      logical :: is_quiet = .false.
      !> A page instead of a deck?
      logical :: is_markdown = .false.
      !> Summary of all cases instead of the series of one?
      logical :: is_summary = .false.
      !> Is help wanted?
      logical :: is_help = .false.
      !> Case to export, from 0 as in the file
      integer :: case_number = 0
      !> Runs of a study whose median time counts
      integer :: repeats = 5
      !> A study of a few trials only?
      logical :: is_quick = .false.
      !> A study of numerical films, or of film laws?
      logical :: is_film = .false., is_laws = .false.
      !> Threads of a sweep; 0, which cannot be asked for, for as many as there are cores
      integer :: threads = 0
      !> This shard of a sweep, from 1, and the number of shards
      integer :: shard = 1, shards = 1
      !> Go on with a sweep that was stopped?
      logical :: is_resumed = .false.
      !> Put a sweep together that is not complete?
      logical :: is_partial = .false.
      !> Time between lines in a log [s]
      integer :: log_interval = 60
      !> The deck as it stands, without its sweep?
      logical :: has_no_sweep = .false.
      !> Version of FMI, and the folder of the library of an FMU; blank for that beside the program
      integer :: fmi_version = 3
      character(len=:), allocatable :: library
      !> Help as a manual page, or as completion for a shell?
      logical :: is_manual = .false., is_completion = .false.
      !> Columns to export, parted by commas; blank for all
      character(len=:), allocatable :: columns
      !> Form of an exported table
      character(len=:), allocatable :: form
      !> Drawings to write, of the mechanism and of the lift, and table of the cam; blank for none
      character(len=:), allocatable :: drawing, lift_drawing, cam_table
      !> Highest speed tried, step of the speeds [rev/min]
      real(wp) :: highest_speed = 6000.0_wp, speed_step = 100.0_wp
      !> Speed of seating that is too fast [m/s]
      real(wp) :: seating_speed = 0.5_wp
   end type config_t

contains

   !> Words after the name of the program.
   subroutine get_arguments(arguments)
      !> The words
      type(line_t), allocatable, intent(inout) :: arguments(:)

      integer :: i, length

      if (allocated(arguments)) deallocate (arguments)
      allocate (arguments(command_argument_count()))
      do i = 1, size(arguments)
         call get_command_argument(i, length=length)
         allocate (character(len=length) :: arguments(i)%text)
         if (length > 0) call get_command_argument(i, arguments(i)%text)
      end do
   end subroutine get_arguments

   !> What the command line asks for.
   subroutine read_arguments(arguments, config, error)
      !> Words after the name of the program
      type(line_t), intent(in) :: arguments(:)
      !> What to do
      type(config_t), intent(out) :: config
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      type(command_t), allocatable :: commands(:)
      character(len=len(commands%name)), allocatable :: names(:)
      integer :: i, words

      config%subject = ""
      config%output = ""
      config%columns = ""
      config%form = export_formats(1)
      config%drawing = ""
      config%lift_drawing = ""
      config%cam_table = ""
      config%library = ""
      allocate (config%overrides(0), config%point_keys(0))
      call list_commands(commands)
      names = [(commands(i)%name, i=1, size(commands))]
      call read_command(arguments, names, config, error)
      if (allocated(error)) return
      associate (command => commands(find_command(commands, config%command)))
         allocate (config%given(size(command%options)), source=0)
         words = 0
         i = 2
         do while (i <= size(arguments))
            if (index(arguments(i)%text, "-") == 1 .and. len(arguments(i)%text) > 1) then
               call read_option(arguments, command, i, config, error)
               if (allocated(error)) return
            else
               words = words + 1
               if (words > 1 .or. command%subject == "") then
                  call raise(error, kind_usage, "'"//config%command//"' does not take '"//arguments(i)%text//"'"// &
                     & see(config))
                  return
               end if
               config%subject = arguments(i)%text
            end if
            i = i + 1
         end do
         if (config%is_help) return
         if (command%subject /= "" .and. index(command%subject, "[") == 0 .and. config%subject == "") then
            call raise(error, kind_usage, "'"//config%command//"' needs the name of a file"//see(config))
            return
         end if
         call check_together(command, config, error)
         if (.not. allocated(error)) call check_values(config, error)
         if (.not. allocated(error)) call check_output(command, config, error)
      end associate
   end subroutine read_arguments

   !> An error where options are given together of which one would have no effect, or one twice.
   subroutine check_together(command, config, error)
      type(command_t), intent(in) :: command
      !> What to do
      type(config_t), intent(in) :: config
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: word
      integer :: i, first, last
      logical :: is_there

      do i = 1, size(command%options)
         associate (option => command%options(i))
            if (config%given(i) > 1 .and. .not. option%may_be_repeated) then
               call raise(error, kind_usage, "option '"//trim(option%name)//"' is given twice"//see(config))
               return
            end if
            if (config%given(i) == 0) cycle
            first = 1
            do while (first <= len(option%excluded))
               last = first + index(option%excluded(first:)//" ", " ") - 2
               word = option%excluded(first:last)
               first = last + 2
               is_there = config%subject /= ""
               if (index(word, "--") == 1) is_there = config%given(find_option(command, word)) > 0
               if (.not. is_there) cycle
               call raise(error, kind_usage, "'"//config%command//"' does not take '"//trim(option%name)//"' together with '"// &
                  & word//"'"//see(config))
               return
            end do
         end associate
      end do
   end subroutine check_together

   !> An error where a value given beside the deck would have no effect: of a sweep that is left out, or beside that of a point.
   subroutine check_values(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: values, value
      logical, allocatable :: are_of_key(:)
      integer :: i, k

      do i = 1, size(config%overrides)
         if (.not. config%has_no_sweep .or. index(key_of(config%overrides(i)%text), "sweep.") /= 1) cycle
         call raise(error, kind_usage, "'"//config%overrides(i)%text//"' is of &sweep, which '--point' and '--no-sweep' "// &
            & "leave out"//see(config))
         return
      end do
      do k = 1, size(config%point_keys)
         associate (key => config%point_keys(k)%text)
            are_of_key = [(key_of(config%overrides(i)%text) == key, i=1, size(config%overrides))]
            if (count(are_of_key) < 2) cycle
            values = ""
            do i = 1, size(config%overrides)
               if (.not. are_of_key(i)) cycle
               value = trim(adjustl(config%overrides(i)%text(index(config%overrides(i)%text, "=") + 1:)))
               if (.not. (is_number(value) .or. is_quoted(value))) value = in_quotes(value)
               if (values /= "") values = values//", "
               values = values//value
            end do
            call raise(error, kind_usage, "'"//key//"' has "//integer_text(count(are_of_key))//" values, and a point takes one"// &
               & "; several are a sweep, of a deck with the group &sweep key_1 = '"//key//"' values_1 = "//values// &
               & " / and without '--point'"//see(config))
            return
         end associate
      end do
   end subroutine check_values

   !> The key of a value given beside the deck, in small letters, without blanks.
   pure function key_of(text) result(key)
      !> As `group.key=value`
      character(len=*), intent(in) :: text
      !> As `group.key`
      character(len=:), allocatable :: key

      integer :: i

      key = ""
      do i = 1, index(text//"=", "=") - 1
         if (text(i:i) /= " ") key = key//to_lower(text(i:i))
      end do
   end function key_of

   !> An error where a file to be written would have no name, or that of the standard streams.
   subroutine check_output(command, config, error)
      type(command_t), intent(in) :: command
      !> What to do
      type(config_t), intent(in) :: config
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (find_option(command, "--output") == 0 .or. config%command == "export" .or. config%is_laws) return
      if (config%output == "-") then
         call raise(error, kind_usage, "'"//config%command//"' does not write to the standard output: give a name by -o FILE"// &
            & see(config))
      else if (config%subject == "-" .and. config%output == "") then
         call raise(error, kind_usage, "a deck from the standard input has no name that a file could take: give one by "// &
            & "-o FILE"//see(config))
      end if
   end subroutine check_output

   !> The first word.
   subroutine read_command(arguments, names, config, error)
      !> Words after the name of the program
      type(line_t), intent(in) :: arguments(:)
      !> Names of the commands
      character(len=*), intent(in) :: names(:)
      !> Gets the command
      type(config_t), intent(inout) :: config
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: nearest

      config%command = "help"
      if (size(arguments) == 0) then
         call raise(error, kind_usage, "no command; see 'camroller help'")
         return
      end if
      select case (arguments(1)%text)
      case ("--help", "-h")
         return
      case ("--version", "-V")
         config%command = "version"
         return
      end select
      config%command = arguments(1)%text
      if (index_of_name(config%command, names) > 0) return
      nearest = nearest_name(config%command, names)
      if (nearest /= "") then
         call raise(error, kind_usage, "unknown command '"//config%command//"'; did you mean '"//nearest//"'?")
      else
         call write_names(names, nearest)
         call raise(error, kind_usage, "unknown command '"//config%command//"'; known are "//nearest)
      end if
   end subroutine read_command

   !> One option, with its value where it has one.
   subroutine read_option(arguments, command, position, config, error)
      !> Words after the name of the program
      type(line_t), intent(in) :: arguments(:)
      type(command_t), intent(in) :: command
      !> Position of the option; moved to its value
      integer, intent(inout) :: position
      !> What to do
      type(config_t), intent(inout) :: config
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: option, value
      integer :: equals, found

      value = ""
      option = arguments(position)%text
      equals = index(option, "=")
      if (equals > 0 .and. index(option, "--") == 1) option = option(:equals - 1)
      found = find_option(command, option)
      if (found == 0) then
         call raise(error, kind_usage, "'"//config%command//"' has no option '"//arguments(position)%text//"'"// &
            & see(config))
         return
      end if
      config%given(found) = config%given(found) + 1
      option = trim(command%options(found)%name)
      if (command%options(found)%value /= "") then
         if (equals > 0 .and. index(arguments(position)%text, "--") == 1) then
            value = arguments(position)%text(equals + 1:)
         else if (position < size(arguments)) then
            position = position + 1
            value = arguments(position)%text
         else
            call raise(error, kind_usage, "option '"//option//"' needs a value"//see(config))
            return
         end if
      else if (equals > 0) then
         call raise(error, kind_usage, "option '"//option//"' takes no value"//see(config))
         return
      end if
      call set_option(option, value, config, error)
   end subroutine read_option

   !> What an option sets.
   ! style: procedure because it is one list
   subroutine set_option(option, value, config, error)
      !> The option, and its value where it has one
      character(len=*), intent(in) :: option, value
      !> What to do
      type(config_t), intent(inout) :: config
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: known, text

      select case (option)
      case ("--output")
         config%output = value
         if (value == "") call raise(error, kind_usage, "option '--output' needs the name of a file"//see(config))
      case ("--set")
         call add_override(config%overrides, value)
      case ("--case")
         call read_whole_number(option, value, "the number of a case, from 0", see(config), 0, huge(1), config%case_number, error)
      case ("--repeats")
         call read_whole_number(option, value, "a number of runs, from 1", see(config), 1, huge(1), config%repeats, error)
      case ("--quick")
         config%is_quick = .true.
      case ("--quiet")
         config%is_quiet = .true.
      case ("--markdown")
         config%is_markdown = .true.
      case ("--summary")
         config%is_summary = .true.
      case ("--help")
         config%is_help = .true.
      case ("--threads")
         call read_whole_number(option, value, "a number of threads, from 1 to "//integer_text(most_threads), see(config), 1, &
            & most_threads, config%threads, error)
      case ("--log-every")
         call read_whole_number(option, value, "a time in whole seconds", see(config), 0, huge(1), config%log_interval, error)
      case ("--shard")
         call read_shard(value, see(config), config%shard, config%shards, error)
      case ("--resume")
         config%is_resumed = .true.
      case ("--partial")
         config%is_partial = .true.
      case ("--film")
         config%is_film = .true.
      case ("--point")
         config%has_no_sweep = .true.
         text = value
         if (index(value, ".") == 0 .or. index(value, ".") > max(1, index(value, "="))) text = "operating_point."//value
         call add_override(config%overrides, text)
         if (index(text, "=") > 0) call add_line(config%point_keys, key_of(text))
      case ("--no-sweep")
         config%has_no_sweep = .true.
      case ("--laws")
         config%is_laws = .true.
      case ("--columns")
         config%columns = value
      case ("--format")
         config%form = value
         if (index_of_name(value, export_formats) == 0) then
            call write_names(export_formats, known)
            call raise(error, kind_usage, "option '--format' takes "//known//", not '"//value//"'"//see(config))
         end if
      case ("--fmi")
         call read_whole_number(option, value, "a version of FMI, 2 or 3", see(config), 2, 3, config%fmi_version, error)
      case ("--library")
         config%library = value
      case ("--man")
         config%is_manual = .true.
      case ("--completion")
         config%is_completion = .true.
      case ("--to")
         call read_positive(option, value, see(config), config%highest_speed, error)
      case ("--step")
         call read_positive(option, value, see(config), config%speed_step, error)
      case ("--seating")
         call read_positive(option, value, see(config), config%seating_speed, error)
      case ("--draw", "--draw-lift", "--cam")
         if (option == "--draw") config%drawing = value
         if (option == "--draw-lift") config%lift_drawing = value
         if (option == "--cam") config%cam_table = value
         if (value == "") call raise(error, kind_usage, "option '"//option//"' needs the name of a file"//see(config))
         if (option /= "--cam" .and. has_other_ending(value, ".svg")) call raise(error, kind_usage, "option '"//option// &
            & "' writes SVG: '"//value//"' has another ending than .svg"//see(config))
         if (value /= "" .and. count([config%drawing == value, config%lift_drawing == value, config%cam_table == value]) > 1) then
            call raise(error, kind_usage, "two options name the same file, '"//value//"'"//see(config))
         end if
      end select
   end subroutine set_option

   !> Does the name of a file end as that of another kind of file?
   pure function has_other_ending(path, ending) result(verdict)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The ending of its kind, with the point
      character(len=*), intent(in) :: ending
      !> Does it?
      logical :: verdict

      integer :: point

      point = index(path, ".", back=.true.)
      verdict = point > index(path, "/", back=.true.) + 1
      if (verdict) verdict = to_lower(path(point:)) /= ending
   end function has_other_ending

   !> Where to read more.
   pure function see(config) result(words)
      !> What to do
      type(config_t), intent(in) :: config
      !> The words
      character(len=:), allocatable :: words

      words = "; see 'camroller help "//config%command//"'"
   end function see

end module camroller_cli
