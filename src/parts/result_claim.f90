!> One process at a time makes a result file of part files: who does has a claim on it.
!>
!> In: the path of a result file. Out: a claim, where no other process has one; unfinished files of processes that are
!> gone, removed. A claim is a lock on a file `<path>.part-lock`, which goes with it. The file says what it is, so that one of
!> this name that is not ours stays as it is. The process that gives a claim up takes the name away first and then says so in
!> the file, so that one that has opened that file before looks for the name again.
module camroller_result_claim
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t, raise, kind_file
   use camroller_text_lines, only : line_t
   use camroller_new_file, only : unfinished_beginning
   use camroller_output_kind, only : result_kind
   use camroller_part_file, only : part_beginning
   use camroller_raw_file, only : append_words, close_raw, find_files, is_locked, lock_raw, open_raw, raw_file_t, read_words, &
      & word_size
   use camroller_system_file, only : remove_file
   implicit none
   private

   public :: claim_t, claim_result, give_up_claim, remove_left_lock, remove_unfinished

   !> What a lock holds: letters that say what it is, and those behind them once it is given up
   integer(int64), parameter :: lock_mark = int(z'436C6F636B727400', int64), end_mark = int(z'43656E6465647200', int64)
   !> Words at the beginning of an unfinished file that say whose it is
   integer, parameter :: examined_words = 2048
   !> Byte with the version of HDF5's first block, and the word that says where the file ends in version 0
   integer, parameter :: version_byte = 9, end_word = 6

   !> A claim
   type :: claim_t
      !> The lock, open
      type(raw_file_t) :: file
   end type claim_t

contains

   !> Have a claim on a result, unless another process has one.
   subroutine claim_result(claim, path, is_mine, error)
      !> The claim
      type(claim_t), intent(out) :: claim
      !> Path of the result file
      character(len=*), intent(in) :: path
      !> Is it had? Where not, there is an error, or another process has it
      logical, intent(out) :: is_mine
      !> File error; also where a file that is no lock has its name
      type(error_t), allocatable, intent(out) :: error

      integer(int64) :: words(1)
      logical :: has_lock, is_lock

      is_mine = .false.
      do
         call open_raw(claim%file, part_beginning(path)//"lock", .true., error, is_shared=.true.)
         if (allocated(error)) exit
         call lock_raw(claim%file, has_lock, error)
         if (.not. has_lock) exit
         if (claim%file%bytes == 0) then
            call append_words(claim%file, [lock_mark], error)
            is_mine = .not. allocated(error)
            exit
         end if
         call read_words(claim%file, 0_int64, words, is_lock)
         if (.not. (is_lock .and. words(1) == lock_mark)) then
            call raise(error, kind_file, "'"//claim%file%path//"' exists and is not a lock of camroller; give it another name")
            exit
         end if
         is_mine = claim%file%bytes == word_size
         if (is_mine) exit
         call close_raw(claim%file)
      end do
      if (.not. is_mine) call close_raw(claim%file)
   end subroutine claim_result

   !> Let the next process have a claim.
   subroutine give_up_claim(claim)
      !> The claim
      type(claim_t), intent(inout) :: claim

      type(error_t), allocatable :: ignored

      call remove_file(claim%file%path)
      call append_words(claim%file, [end_mark], ignored)
      call close_raw(claim%file)
   end subroutine give_up_claim

   !> Remove the lock of a process that ended between the last part file and its lock. One that a process holds stays, as does a
   !> file that is no lock.
   subroutine remove_left_lock(path)
      !> Path of the result file
      character(len=*), intent(in) :: path

      type(claim_t) :: claim
      type(error_t), allocatable :: ignored
      logical :: is_there, is_mine

      inquire (file=part_beginning(path)//"lock", exist=is_there)
      if (.not. is_there) return
      call claim_result(claim, path, is_mine, ignored)
      if (is_mine) call give_up_claim(claim)
   end subroutine remove_left_lock

   !> Remove unfinished results of processes that are gone: those with the exact name that this program gives them,
   !> which no process writes and which are empty, not finished, or hold a result of this program.
   subroutine remove_unfinished(path)
      !> Path of the result file
      character(len=*), intent(in) :: path

      type(line_t), allocatable :: paths(:)
      character(len=:), allocatable :: beginning
      integer :: i

      beginning = unfinished_beginning(path)
      call find_files(beginning, paths)
      do i = 1, size(paths)
         if (verify(paths(i)%text(len(beginning) + 1:), "0123456789-") > 0) cycle
         if (is_ours(paths(i)%text)) call remove_file(paths(i)%text)
      end do
   end subroutine remove_unfinished

   !> Is an unfinished file one of this program, and does no process write it?
   function is_ours(path) result(verdict)
      character(len=*), intent(in) :: path
      !> Is it?
      logical :: verdict

      type(raw_file_t) :: file
      type(error_t), allocatable :: error
      character(len=word_size*examined_words) :: letters
      integer(int64) :: words(examined_words), count
      logical :: is_read, is_free

      verdict = .false.
      call open_raw(file, path, .false., error)
      if (allocated(error)) return
      count = min(int(examined_words, int64), file%bytes/word_size)
      call read_words(file, 0_int64, words(:count), is_read)
      is_free = .not. is_locked(file)
      if (is_read .and. is_free) then
         letters = transfer(words(:count), letters)
         letters(word_size*count + 1:) = ""
         if (index(letters, trim(result_kind%beginnings(1))) == 1) then
            ! A file that HDF5 has not finished says that it ends elsewhere than it does
            verdict = index(letters, trim(result_kind%mark)) > 0
            if (.not. verdict .and. count >= end_word .and. letters(version_byte:version_byte) == char(0)) then
               verdict = words(end_word) /= file%bytes
            end if
         else
            verdict = verify(letters, " "//char(0)) == 0
         end if
      end if
      call close_raw(file)
   end function is_ours

end module camroller_result_claim
