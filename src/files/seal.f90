!> Seal of a result file: a checksum of all its bytes, appended behind the HDF5 data, so that a damaged file is recognised before
!> it is read.
!>
!> In: the path of a file. Out: the file with a seal; whether seal and content agree. HDF5 ignores what stands behind its own end
!> of a file, and removes it when a program changes the file: a file that was changed on purpose has no seal and is treated like
!> a file without one. The seal is four words: a mark, the number of bytes before it (padded to whole words), their checksum, and
!> the checksum of these three.
module camroller_seal
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t, raise, kind_file
   use camroller_raw_file, only : append_words, close_raw, cut_raw, open_raw, raw_file_t, read_words, word_size
   use camroller_record, only : checksum
   implicit none
   private

   public :: seal_file, check_seal

   !> Mark of a seal, words of a seal, words that are read at a time
   character(len=word_size), parameter :: mark = "camrSEAL"
   integer, parameter :: seal_words = 4, block_words = 65536

contains

   !> Add a seal to a file that is complete.
   subroutine seal_file(path, shown, bytes, error)
      !> Its path, and what messages call it
      character(len=*), intent(in) :: path, shown
      !> Its size with the seal [byte]
      integer(int64), intent(out) :: bytes
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t) :: file
      integer(int64) :: seal(seal_words)
      logical :: is_complete

      bytes = 0
      call open_raw(file, path, .true., error)
      if (allocated(error)) return
      file%path = shown
      call cut_raw(file, word_size*((file%bytes + word_size - 1)/word_size), error)
      if (.not. allocated(error)) then
         seal(:2) = [transfer(mark, 0_int64), file%bytes]
         call sum_up(file, file%bytes/word_size, seal(3), is_complete)
         seal(4) = checksum(seal(:3), 0_int64)
         if (.not. is_complete) call raise(error, kind_file, "cannot write '"//shown//"': it cannot be read again")
      end if
      if (.not. allocated(error)) call append_words(file, seal, error)
      bytes = file%bytes
      call close_raw(file)
   end subroutine seal_file

   !> An error where a file has a seal that does not go with its bytes.
   subroutine check_seal(path, error)
      !> Its path
      character(len=*), intent(in) :: path
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t) :: file
      integer(int64) :: seal(seal_words), place, sum
      logical :: is_complete, is_good

      call open_raw(file, path, .false., error)
      if (allocated(error)) return
      place = file%bytes - word_size*seal_words
      is_good = .true.
      if (place >= 0) then
         call read_words(file, place, seal, is_complete)
         if (is_complete .and. seal(1) == transfer(mark, 0_int64)) then
            is_good = seal(2) == place .and. seal(4) == checksum(seal(:3), 0_int64)
            if (is_good) call sum_up(file, place/word_size, sum, is_good)
            if (is_good) is_good = sum == seal(3)
         end if
      end if
      call close_raw(file)
      if (.not. is_good) call raise(error, kind_file, "cannot read '"//path// &
         & "': it is damaged, its bytes are not those that were written")
   end subroutine check_seal

   !> Checksum of the beginning of a file.
   subroutine sum_up(file, words, sum, is_complete)
      type(raw_file_t), intent(in) :: file
      !> How many words of it
      integer(int64), intent(in) :: words
      !> Their checksum
      integer(int64), intent(out) :: sum
      !> Does the file hold that many?
      logical, intent(out) :: is_complete

      integer(int64) :: block(block_words), first, count

      sum = 0
      is_complete = .true.
      first = 0
      do while (first < words .and. is_complete)
         count = min(words - first, int(block_words, int64))
         call read_words(file, word_size*first, block(:count), is_complete)
         sum = checksum(block(:count), sum)
         first = first + count
      end do
   end subroutine sum_up

end module camroller_seal
