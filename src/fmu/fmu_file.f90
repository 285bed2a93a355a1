!> An FMU of a deck: an archive with the description, the library with what it needs, the deck and its tables.
!>
!> In: a deck, the folder of the library. Out: the file, the same bytes for the same deck and library.
module camroller_fmu_file
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : pi, two_pi
   use camroller_error, only : error_t, raise, kind_file, kind_usage
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, override_t, make_case
   use camroller_deck_document, only : write_resolved
   use camroller_fmu_description, only : describe_fmu
   use camroller_fmu_variables, only : variable_t, list_variables, write_variables
   use camroller_text_lines, only : line_t
   use camroller_new_file, only : save_text
   use camroller_output_kind, only : fmu_kind
   use camroller_number_text, only : hexadecimal_text
   use camroller_raw_file, only : find_files
   use camroller_record, only : checksum, text_words
   use camroller_settings, only : find_value, get_word, has_group
   use camroller_shaft_simulation, only : shaft_simulation_t, start_shaft
   use camroller_text_file, only : read_bytes, join_path
   use camroller_zip_archive, only : member_t, make_archive
   implicit none
   private

   public :: write_fmu

   !> Groups with a key `table`
   character(len=*), parameter :: groups(*) = [character(len=11) :: "lift", "second_lift", "gas_force"]
   !> Name of the library of an FMU in its folder; in an FMU it has the name of the model
   character(len=*), parameter :: library_name = "camroller_fmi.so"
   !> Beginning of the name of the library of the package of Python in that folder: what is in it is in that of an FMU, too
   character(len=*), parameter :: package_library = "libcamroller"
   !> Most bytes of a library or a table
   integer(int64), parameter :: most_bytes = 500000000_int64
   !> Letters that names of libraries have: those of identifiers of C
   character(len=*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"

contains

   !> Write an FMU.
   subroutine write_fmu(deck, version, folder, path, error)
      !> The deck, without its sweep; names of its tables are changed to those in the FMU
      type(deck_t), intent(inout) :: deck
      !> Version of FMI, 2 or 3
      integer, intent(in) :: version
      !> Folder of the library, with `/` at its end
      character(len=*), intent(in) :: folder
      !> Path of the FMU
      character(len=*), intent(in) :: path
      !> File, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      type(shaft_simulation_t) :: shaft
      type(override_t) :: none(0)
      type(variable_t), allocatable :: variables(:)
      type(member_t), allocatable :: members(:)
      character(len=:), allocatable :: text, table, identifier, token, bytes

      call make_case(deck, none, case, error)
      ! What cannot be started makes no FMU
      if (.not. allocated(error)) call start_shaft(shaft, case, pi, error)
      if (allocated(error)) return
      call get_identifier(path, identifier)
      call add_library(folder, version, identifier, members, error)
      if (.not. allocated(error)) call add_tables(deck, members, error)
      if (allocated(error)) return
      call list_variables(deck, case, variables)
      call write_variables(variables, table)
      call write_resolved(deck, text, is_short=.true.)
      call add_member("resources/deck.nml", text, members)
      token = hexadecimal_text(checksum(text_words(text), checksum(text_words(table), int(version, int64))))
      call add_member("resources/variables.txt", "token "//token//new_line("a")//table, members)
      call describe_fmu(version, identifier, case%title, token, two_pi/case%operating_point%speed, variables, text)
      call add_member("modelDescription.xml", text, members)
      call make_archive(members(size(members):1:-1), bytes, error)
      if (.not. allocated(error)) call save_text(path, fmu_kind, bytes, error)
   end subroutine write_fmu

   !> Name of a model: that of its file, with other letters than identifiers have as `_`.
   pure subroutine get_identifier(path, identifier)
      !> Path of the FMU
      character(len=*), intent(in) :: path
      !> The name
      character(len=:), allocatable, intent(out) :: identifier

      integer :: i, last

      identifier = path(index(path, "/", back=.true.) + 1:)
      last = index(identifier, ".", back=.true.)
      if (last > 1) identifier = identifier(:last - 1)
      do i = 1, len(identifier)
         if (index(letters, identifier(i:i)) == 0) identifier(i:i) = "_"
      end do
      if (scan(identifier(:1), "0123456789") == 1) identifier = "_"//identifier
   end subroutine get_identifier

   !> Append a file to the archive.
   subroutine add_member(name, content, members)
      !> Its path there, its bytes
      character(len=*), intent(in) :: name, content
      !> Files so far
      type(member_t), allocatable, intent(inout) :: members(:)

      type(member_t), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(members) + 1))
      do i = 1, size(members)
         call move_alloc(members(i)%name, longer(i)%name)
         call move_alloc(members(i)%content, longer(i)%content)
      end do
      longer(size(longer))%name = name
      longer(size(longer))%content = content
      call move_alloc(longer, members)
   end subroutine add_member

   !> The library and what it needs, in the folder that FMI has for this machine.
   subroutine add_library(folder, version, identifier, members, error)
      !> Where they are
      character(len=*), intent(in) :: folder
      !> Version of FMI
      integer, intent(in) :: version
      !> Name of the model
      character(len=*), intent(in) :: identifier
      !> The files
      type(member_t), allocatable, intent(out) :: members(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(line_t), allocatable :: paths(:)
      character(len=:), allocatable :: content, place, name
      integer :: i, machine

      allocate (members(0))
      call read_bytes(folder//library_name, most_bytes, content, error)
      if (allocated(error)) then
         call raise(error, kind_file, "there is no library for FMUs at '"//folder//library_name//"'; cmake --install puts it "// &
            & "beside the program, and --library FOLDER names another place")
         return
      end if
      ! The machine that it is for, by the 19th byte of a library of this system
      machine = 0
      if (len(content) > 20) machine = ichar(content(19:19))
      select case (machine)
      case (62)
         place = merge("binaries/linux64/     ", "binaries/x86_64-linux/", version == 2)
      case (183)
         place = "binaries/aarch64-linux/"
      case default
         call raise(error, kind_usage, "'"//folder//library_name//"' is for a machine that FMUs are not made for")
         return
      end select
      call add_member(trim(place)//identifier//".so", content, members)
      call find_files(folder//"lib", paths)
      do i = 1, size(paths)
         name = paths(i)%text(len(folder) + 1:)
         if (index(name, package_library) == 1) cycle
         call read_bytes(paths(i)%text, most_bytes, content, error)
         if (allocated(error)) return
         call add_member(trim(place)//name, content, members)
      end do
   end subroutine add_library

   !> The tables of the deck, and their names there.
   subroutine add_tables(deck, members, error)
      type(deck_t), intent(inout) :: deck
      !> Files so far
      type(member_t), allocatable, intent(inout) :: members(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: content, name
      integer :: i, position

      do i = 1, size(groups)
         if (.not. has_group(deck%settings, trim(groups(i)))) cycle
         name = get_word(deck%settings, trim(groups(i)), "table")
         if (name == "") cycle
         call read_bytes(join_path(deck%folder, name), most_bytes, content, error)
         if (allocated(error)) return
         call add_member("resources/"//trim(groups(i))//".txt", content, members)
         position = find_value(deck%settings, trim(groups(i)), "table")
         deck%settings%values(position)%text = "'"//trim(groups(i))//".txt'"
      end do
   end subroutine add_tables

end module camroller_fmu_file
