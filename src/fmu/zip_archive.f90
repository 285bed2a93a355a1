!> Archives of files in the ZIP format, without compression.
!>
!> In: names and contents. Out: the bytes of an archive, the same for the same files. Source: PKWARE, APPNOTE.TXT, ZIP File Format
!> Specification, version 6.3, sections 4.3.7, 4.3.12 and 4.3.16; the checksum is that of section 4.4.7.
module camroller_zip_archive
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t, raise, kind_file
   implicit none
   private

   public :: member_t, make_archive

   !> A file of an archive
   type :: member_t
      !> Its path there
      character(len=:), allocatable :: name
      !> Its bytes
      character(len=:), allocatable :: content
   end type member_t

   !> Most bytes of an archive without the extensions for larger ones
   integer(int64), parameter :: most_bytes = 2000000000_int64
   !> Bytes of the headers of a file, in its place and in the directory, and of the end of the directory, without names
   integer, parameter :: local_bytes = 30, entry_bytes = 46, end_bytes = 22
   !> First day that the format knows: archives do not depend on the day
   integer, parameter :: first_day = 33
   !> A regular file that everyone may read, as Unix has it, made under Unix by a version that knows the format 2.0
   integer(int64), parameter :: attributes = 33188_int64*65536_int64
   integer, parameter :: made_by = 3*256 + 20, format_needed = 20

contains

   !> The bytes of an archive.
   subroutine make_archive(members, bytes, error)
      !> Its files
      type(member_t), intent(in) :: members(:)
      !> The archive
      character(len=:), allocatable, intent(out) :: bytes
      !> File error where it would be too large
      type(error_t), allocatable, intent(out) :: error

      ! Checksums, places of the files
      integer(int64) :: sums(size(members)), places(size(members)), length, directory
      integer :: i, next

      length = end_bytes
      do i = 1, size(members)
         length = length + local_bytes + entry_bytes + 2*len(members(i)%name) + len(members(i)%content, kind=int64)
      end do
      if (length > most_bytes) then
         call raise(error, kind_file, "the archive would be larger than two gigabytes")
         return
      end if
      allocate (character(len=length) :: bytes)
      next = 0
      do i = 1, size(members)
         places(i) = next
         sums(i) = cyclic_redundancy(members(i)%content)
         call put(little(67324752_int64, 4)//facts(i)//members(i)%name)
         call put(members(i)%content)
      end do
      directory = next
      do i = 1, size(members)
         call put(little(33639248_int64, 4)//little(int(made_by, int64), 2)//facts(i)//little(0_int64, 6)// &
            & little(attributes, 4)//little(places(i), 4)//members(i)%name)
      end do
      length = next - directory
      call put(little(101010256_int64, 4)//little(0_int64, 4)//little(size(members, kind=int64), 2)// &
         & little(size(members, kind=int64), 2)//little(length, 4)//little(directory, 4)//little(0_int64, 2))

   contains

      !> Append to the archive.
      subroutine put(text)
         !> What to append
         character(len=*), intent(in) :: text

         bytes(next + 1:next + len(text)) = text
         next = next + len(text)
      end subroutine put

      !> What both headers of a file have in common: format, no flags, no compression, time, checksum, sizes, length of its name.
      pure function facts(i) result(text)
         !> Its number
         integer, intent(in) :: i
         !> The bytes
         character(len=26) :: text

         text = little(int(format_needed, int64), 2)//little(0_int64, 6)//little(int(first_day, int64), 2)//little(sums(i), 4)// &
            & little(len(members(i)%content, kind=int64), 4)//little(len(members(i)%content, kind=int64), 4)// &
            & little(len(members(i)%name, kind=int64), 2)//little(0_int64, 2)
      end function facts

   end subroutine make_archive

   !> A whole number as bytes, the least first.
   pure function little(number, count) result(text)
      integer(int64), intent(in) :: number
      !> Number of bytes
      integer, intent(in) :: count
      !> The bytes
      character(len=count) :: text

      integer :: i

      do i = 1, count
         text(i:i) = achar(int(iand(ishft(number, -8*(i - 1)), 255_int64)))
      end do
   end function little

   !> Checksum of a file: cyclic redundancy of 32 bits, least bit first.
   pure function cyclic_redundancy(text) result(sum)
      !> The file
      character(len=*), intent(in) :: text
      !> The checksum
      integer(int64) :: sum

      ! The generating polynomial with its bits turned round, all bits of a sum
      integer(int64), parameter :: polynomial = 3988292384_int64, all_bits = 4294967295_int64
      integer(int64) :: table(0:255)
      integer :: i, turn

      do i = 0, 255
         table(i) = i
         do turn = 1, 8
            table(i) = ieor(ishft(table(i), -1), merge(polynomial, 0_int64, btest(table(i), 0)))
         end do
      end do
      sum = all_bits
      do i = 1, len(text)
         sum = ieor(ishft(sum, -8), table(iand(ieor(sum, int(ichar(text(i:i)), int64)), 255_int64)))
      end do
      sum = ieor(sum, all_bits)
   end function cyclic_redundancy

end module camroller_zip_archive
