!> A whole text file as one string.
!>
!> In: a path. Out: the text, or an error that says why there is none.
module camroller_text_file
   use, intrinsic :: iso_c_binding, only : c_associated, c_int, c_loc, c_long, c_null_char, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_c_library, only : c_fclose, c_fopen, c_fread, c_fseek, c_ftell
   use camroller_error, only : error_t, raise, kind_file
   use camroller_file_facts, only : facts_of_path, file_facts_t, kind_in_words
   use camroller_number_text, only : integer_text
   use camroller_system_file, only : error_number, system_words
   implicit none
   private

   public :: read_text_file, read_bytes, read_standard_input, join_path, folder_of, utf8_mark

   !> Marks of a text at its first bytes: of UTF-8, which is skipped, and of UTF-16, which is not read
   character(len=*), parameter :: utf8_mark = char(239)//char(187)//char(191), utf16_marks(*) = &
      & [char(255)//char(254), char(254)//char(255)]
   !> Larger files are no decks and no tables [bytes]
   integer(int64), parameter :: largest_size = 64_int64*1024_int64*1024_int64
   !> What `fseek` takes for the start and the end of a file, and `access` to ask whether there is one
   integer(c_int), parameter :: from_start = 0_c_int, from_end = 2_c_int

contains

   !> Read the standard input to its end into a string.
   subroutine read_standard_input(text, error)
      !> All that comes
      character(len=:), allocatable, intent(out) :: text
      !> File error where it cannot be read, is too long, or is no text
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: longer
      character(len=1) :: letter
      integer :: unit, status, length
      logical :: is_too_long

      text = ""
      is_too_long = .false.
      open (newunit=unit, file="/dev/stdin", access="stream", form="unformatted", action="read", iostat=status)
      if (status == 0) then
         allocate (character(len=1024) :: longer)
         length = 0
         do
            read (unit, iostat=status) letter
            if (status /= 0 .or. length >= largest_size) exit
            length = length + 1
            if (length > len(longer)) longer = longer//repeat(" ", len(longer))
            longer(length:length) = letter
         end do
         close (unit)
         text = longer(:length)
         is_too_long = status == 0
         status = merge(1, 0, length == 0)
      end if
      if (is_too_long) then
         call raise(error, kind_file, "the standard input is too large for a deck: more than "// &
            & integer_text(int(largest_size/1024_int64/1024_int64))//" MB")
      else if (status /= 0) then
         call raise(error, kind_file, "nothing can be read from the standard input")
      else if (any(text(:min(2, len(text))) == utf16_marks)) then
         call raise(error, kind_file, "the standard input is a text in UTF-16; give it in UTF-8")
      else if (.not. is_text(text)) then
         call raise(error, kind_file, "the standard input is no text: it holds bytes that no text has")
      end if
   end subroutine read_standard_input

   !> Read a file into a string.
   subroutine read_text_file(path, text, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> All that is in it
      character(len=:), allocatable, intent(out) :: text
      !> File error where it cannot be read
      type(error_t), allocatable, intent(out) :: error

      call read_bytes(path, largest_size, text, error)
      if (allocated(error)) return
      if (any(text(:min(2, len(text))) == utf16_marks)) then
         call raise(error, kind_file, "'"//path//"' is a text in UTF-16; save it in UTF-8")
      else if (.not. is_text(text)) then
         call raise(error, kind_file, "'"//path//"' is not a text file: it contains bytes that do not occur in text")
      else if (index(text, utf8_mark) == 1) then
         text = text(len(utf8_mark) + 1:)
      end if
   end subroutine read_text_file

   !> Read a file of any content into a string, by the C library: a Fortran program can open a file only once, and threads may
   !> read the same one. `inquire` would look at all units of the program, also at those by which other threads make numbers
   !> into text.
   subroutine read_bytes(path, most, text, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Larger files are refused [bytes]
      integer(int64), intent(in) :: most
      !> All that is in it
      character(len=:), allocatable, target, intent(out) :: text
      !> File error where it cannot be read
      type(error_t), allocatable, intent(out) :: error

      type(file_facts_t) :: facts
      type(c_ptr) :: stream
      character(len=:), allocatable :: advice
      integer(int64) :: bytes, found
      logical :: is_fine

      facts = facts_of_path(path)
      if (.not. facts%is_there) then
         call raise(error, kind_file, "there is no file '"//path//"'")
         return
      end if
      if (.not. facts%is_regular) then
         advice = ""
         if (kind_in_words(facts) == "a pipe") advice = "; only a deck may come by one, as the standard input, whose name is -"
         call raise(error, kind_file, "cannot read '"//path//"': it is "//kind_in_words(facts)//advice)
         return
      end if
      stream = c_fopen(path//c_null_char, "rb"//c_null_char)
      if (.not. c_associated(stream)) then
         call say_why(path, error_number(), error)
         return
      end if
      bytes = -1
      found = 0
      if (c_fseek(stream, 0_c_long, from_end) == 0) bytes = c_ftell(stream)
      is_fine = bytes >= 0 .and. bytes <= most
      if (is_fine) then
         allocate (character(len=bytes) :: text)
         is_fine = c_fseek(stream, 0_c_long, from_start) == 0
         if (bytes > 0) found = c_fread(c_loc(text), 1_c_size_t, int(bytes, c_size_t), stream)
         is_fine = is_fine .and. found == bytes
      end if
      if (c_fclose(stream) /= 0) is_fine = .false.
      if (.not. is_fine) call say_why(path, 0_c_int, error)
   end subroutine read_bytes

   !> Say why a file cannot be read: in the words of the system where it sees something wrong.
   subroutine say_why(path, number, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The system's number; zero where it sees nothing wrong
      integer(c_int), intent(in) :: number
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: words

      words = "it is too large for what it is read for, or has changed meanwhile"
      if (number /= 0) call system_words(number, words)
      call raise(error, kind_file, "cannot read '"//path//"': "//words)
   end subroutine say_why

   !> Are there no control characters but tabulators and those between lines and pages?
   pure function is_text(text) result(verdict)
      character(len=*), intent(in) :: text
      !> Are there none?
      logical :: verdict

      integer :: i

      verdict = .false.
      do i = 1, len(text)
         select case (iachar(text(i:i)))
         case (:8, 14:31, 127)
            return
         end select
      end do
      verdict = .true.
   end function is_text

   !> Path of a file named in another file: relative to that file's folder unless it begins at the root.
   pure function join_path(folder, name) result(path)
      !> Folder, with `/` at its end or blank
      character(len=*), intent(in) :: folder
      !> Name of the file
      character(len=*), intent(in) :: name
      !> Path of the file
      character(len=len(name) + len(folder)*merge(0, 1, index(name, "/") == 1)) :: path

      if (index(name, "/") == 1) then
         path = name
      else
         path = folder//name
      end if
   end function join_path

   !> Folder of a file, with `/` at its end; blank for the present one.
   pure function folder_of(path) result(folder)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Its folder
      character(len=index(path, "/", back=.true.)) :: folder

      folder = path
   end function folder_of

end module camroller_text_file
