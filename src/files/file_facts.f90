!> File status from the operating system: existence, kind, size, and whether two names refer to the same file.
!>
!> In: paths, descriptors. Out: `file_facts_t`. Symbolic links are followed. The system call used (statx) has the same layout of
!> its result on every architecture that runs Linux.
module camroller_file_facts
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int16_t, c_int32_t, c_int64_t, c_null_char
   use, intrinsic :: iso_fortran_env, only : int64
   implicit none
   private

   public :: file_facts_t, facts_of_path, facts_of_descriptor, is_same_file, kind_in_words

   !> What is known of a file
   type :: file_facts_t
      !> Is there something of that name, a link that leads nowhere included?
      logical :: is_there = .false.
      !> Is it a regular file, or a folder?
      logical :: is_regular = .false., is_folder = .false.
      !> Size of a regular file [byte]
      integer(int64) :: bytes = 0
      !> Kind, as the system numbers it
      integer :: kind = 0
      !> Who may read, write and execute it, as the system numbers it
      integer :: permissions = 0
      !> Device, in two numbers, and number of the file on it
      integer :: device(2) = 0
      integer(int64) :: node = 0
   end type file_facts_t

   !> Moment, as `statx` gives it
   type, bind(C) :: moment_t
      integer(c_int64_t) :: seconds
      integer(c_int32_t) :: nanoseconds, reserved
   end type moment_t

   !> Answer of `statx`, with room for what later systems add
   type, bind(C) :: answer_t
      integer(c_int32_t) :: mask, block_size
      integer(c_int64_t) :: attributes
      integer(c_int32_t) :: links, user, group
      integer(c_int16_t) :: mode, spare
      integer(c_int64_t) :: node, bytes, blocks, attributes_mask
      type(moment_t) :: moments(4)
      integer(c_int32_t) :: stands_for(2), device(2)
      integer(c_int64_t) :: rest(14)
   end type answer_t

   !> What `statx` takes: a path from the present folder, the link itself, an empty path for the descriptor, the basic facts
   integer(c_int), parameter :: from_here = -100_c_int, not_followed = 256_c_int, empty_path = 4096_c_int, basic_facts = 2047_c_int
   !> Part of the mode that holds the permissions; part that holds the kind, and its values
   integer, parameter :: permission_mask = 511
   integer, parameter :: kind_mask = 61440, kind_pipe = 4096, kind_characters = 8192, kind_folder = 16384, kind_blocks = 24576, &
      & kind_regular = 32768, kind_link = 40960, kind_socket = 49152

   interface
      function c_statx(folder, path, flags, mask, answer) bind(C, name="statx") result(status)
         import :: answer_t, c_char, c_int
         integer(c_int), value :: folder, flags, mask
         character(kind=c_char), intent(in) :: path(*)
         type(answer_t), intent(out) :: answer
         integer(c_int) :: status
      end function c_statx
   end interface

   !> Kinds of files in words
   character(len=*), parameter :: kind_words(*) = [character(len=25) :: "a file", "a folder", "a pipe", "a device", "a socket", &
      & "a link that leads nowhere", "no file"]

contains

   !> Facts of the file that a path leads to.
   function facts_of_path(path) result(facts)
      !> The path
      character(len=*), intent(in) :: path
      !> The facts; of a link that leads nowhere, its own
      type(file_facts_t) :: facts

      facts = facts_of(from_here, path, 0_c_int)
      if (.not. facts%is_there) facts = facts_of(from_here, path, not_followed)
   end function facts_of_path

   !> Facts of an open file.
   function facts_of_descriptor(descriptor) result(facts)
      !> Its descriptor
      integer(c_int), intent(in) :: descriptor
      !> The facts
      type(file_facts_t) :: facts

      facts = facts_of(descriptor, "", empty_path)
   end function facts_of_descriptor

   !> Ask the system.
   function facts_of(folder, path, flags) result(facts)
      !> Descriptor that the path starts at
      integer(c_int), intent(in) :: folder
      character(len=*), intent(in) :: path
      !> How it is taken
      integer(c_int), intent(in) :: flags
      !> The facts
      type(file_facts_t) :: facts

      type(answer_t) :: answer

      facts%is_there = c_statx(folder, path//c_null_char, flags, basic_facts, answer) == 0
      if (.not. facts%is_there) return
      facts%kind = iand(int(answer%mode), kind_mask)
      facts%permissions = iand(int(answer%mode), permission_mask)
      facts%is_regular = facts%kind == kind_regular
      facts%is_folder = facts%kind == kind_folder
      if (facts%is_regular) facts%bytes = answer%bytes
      facts%device = answer%device
      facts%node = answer%node
   end function facts_of

   !> Are two files the same one, whatever they were called?
   pure function is_same_file(some, other) result(verdict)
      !> Facts of both
      type(file_facts_t), intent(in) :: some, other
      !> Are they?
      logical :: verdict

      verdict = some%is_there .and. other%is_there .and. some%node == other%node .and. all(some%device == other%device)
   end function is_same_file

   !> Position of what kind of file it is in `kind_words`.
   pure function kind_position(facts) result(position)
      type(file_facts_t), intent(in) :: facts
      !> The position
      integer :: position

      select case (facts%kind)
      case (kind_regular)
         position = 1
      case (kind_folder)
         position = 2
      case (kind_pipe)
         position = 3
      case (kind_characters, kind_blocks)
         position = 4
      case (kind_socket)
         position = 5
      case (kind_link)
         position = 6
      case default
         position = 7
      end select
   end function kind_position

   !> What kind of file it is.
   pure function kind_in_words(facts) result(words)
      !> Its facts
      type(file_facts_t), intent(in) :: facts
      !> The words
      character(len=len_trim(kind_words(kind_position(facts)))) :: words

      words = kind_words(kind_position(facts))
   end function kind_in_words

end module camroller_file_facts
