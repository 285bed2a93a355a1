!> Quantities in which two results differ, each with the number of cases and the case that differs most.
!>
!> In: numbers and texts of both, case by case, in any order. Out: the list of what differs, by name, which does not depend on the
!> order of the cases.
module camroller_differences
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   implicit none
   private

   public :: difference_t, another_text, compare

   !> In the place of the largest difference: the quantity is a text [-]
   real(wp), parameter :: another_text = -1.0_wp

   !> Bits of the exponent of a number, all of which are set where it is not finite, and those of the fraction, which tell
   !> not-a-number from infinity
   integer(int64), parameter :: of_exponent = shiftl(2047_int64, 52), of_fraction = not(shiftl(4095_int64, 52))

   !> How a quantity differs
   type :: difference_t
      !> Its name in the file, e.g. `summary/mean_torque_drive`
      character(len=:), allocatable :: name
      !> Is it a row of numbers in each case?
      logical :: is_row = .false.
      !> Cases in which it does
      integer :: cases = 0
      !> Largest difference relative to the larger of both values, or to the largest value of the row [-]; huge where one of them is
      !> no number, `another_text` where they are texts
      real(wp) :: largest = 0.0_wp
      !> Case of the largest difference, from 0; the first of several
      integer :: case_number = 0
      !> The number in the file and the one computed now, where they differ most [unit of the quantity]
      real(wp) :: stored = 0.0_wp, computed = 0.0_wp
   end type difference_t

   !> Compare numbers bit by bit, or texts
   interface compare
      module procedure compare_number
      module procedure compare_row
      module procedure compare_text
   end interface compare

contains

   !> Compare two numbers bit by bit.
   subroutine compare_number(list, name, case_number, stored, computed, differs)
      !> What differs so far
      type(difference_t), allocatable, intent(inout) :: list(:)
      !> Name of the quantity in the file
      character(len=*), intent(in) :: name
      !> Number of the case, from 0
      integer, intent(in) :: case_number
      !> The number in the file and the one computed now [unit of the quantity]
      real(wp), intent(in) :: stored, computed
      !> Does the case differ?
      logical, intent(inout) :: differs

      if (transfer(stored, 0_int64) == transfer(computed, 0_int64)) return
      differs = .true.
      call note(list, difference_t(name, .false., 1, relative_difference(stored, computed, 0.0_wp), case_number, stored, computed))
   end subroutine compare_number

   !> Compare the numbers of a case; what is kept is the pair that differs most.
   !>
   !> Differences are relative to the largest number of the row: beside it, what rounding makes of one near zero is nothing.
   subroutine compare_row(list, name, number, stored, computed, differs)
      !> What differs so far
      type(difference_t), allocatable, intent(inout) :: list(:)
      !> Name of the quantity in the file
      character(len=*), intent(in) :: name
      !> Number of the case, from 0
      integer, intent(in) :: number
      !> The numbers in the file and those computed now [unit of the quantity]
      real(wp), intent(in) :: stored(:), computed(:)
      !> Does the case differ?
      logical, intent(inout) :: differs

      real(wp) :: scale, largest, relative ! [unit of the quantity], [-], [-]
      integer :: i, worst

      scale = 0.0_wp
      do i = 1, size(stored)
         if (is_finite(stored(i))) scale = max(scale, abs(stored(i)))
         if (is_finite(computed(i))) scale = max(scale, abs(computed(i)))
      end do
      worst = 0
      do i = 1, size(stored)
         if (transfer(stored(i), 0_int64) == transfer(computed(i), 0_int64)) cycle
         relative = relative_difference(stored(i), computed(i), scale)
         if (worst > 0) then
            if (relative <= largest) cycle
         end if
         worst = i
         largest = relative
      end do
      if (worst == 0) return
      differs = .true.
      call note(list, difference_t(name, .true., 1, largest, number, stored(worst), computed(worst)))
   end subroutine compare_row

   !> Compare two texts.
   subroutine compare_text(list, name, case_number, stored, computed, differs)
      !> What differs so far
      type(difference_t), allocatable, intent(inout) :: list(:)
      !> Name of the text in the file
      character(len=*), intent(in) :: name
      !> Number of the case, from 0
      integer, intent(in) :: case_number
      !> The text in the file and the one that there is now
      character(len=*), intent(in) :: stored, computed
      !> Does the case differ?
      logical, intent(inout) :: differs

      if (stored == computed) return
      differs = .true.
      call note(list, difference_t(name, .false., 1, another_text, case_number, 0.0_wp, 0.0_wp))
   end subroutine compare_text

   !> Note a difference.
   subroutine note(list, new)
      !> What differs so far
      type(difference_t), allocatable, intent(inout) :: list(:)
      !> The difference, of one case
      type(difference_t), intent(in) :: new

      integer :: place
      logical :: is_new

      if (.not. allocated(list)) allocate (list(0))
      place = 1
      do while (place <= size(list))
         if (list(place)%name >= new%name) exit
         place = place + 1
      end do
      is_new = place > size(list)
      if (.not. is_new) is_new = list(place)%name /= new%name
      if (is_new) then
         list = [list(:place - 1), new, list(place:)]
         return
      end if
      associate (known => list(place))
         known%cases = known%cases + 1
         ! Of equal differences that of the first case, since threads bring cases in any order
         if (new%largest < known%largest .or. .not. new%largest > known%largest .and. new%case_number > known%case_number) return
         known%largest = new%largest
         known%case_number = new%case_number
         known%stored = new%stored
         known%computed = new%computed
      end associate
   end subroutine note

   !> Difference of two numbers relative to the largest of both and a scale.
   pure function relative_difference(some, other, scale) result(difference)
      !> Two numbers, and the least that they are compared with [any unit]
      real(wp), intent(in) :: some, other, scale
      !> Their difference [-]; huge where one of them is no finite number
      real(wp) :: difference

      integer(int64) :: bits(2)
      real(wp) :: larger ! [any unit]

      bits = transfer([some, other], bits)
      difference = 0.0_wp
      if (all(iand(bits, of_exponent) == of_exponent .and. iand(bits, of_fraction) /= 0_int64)) return
      difference = huge(1.0_wp)
      if (.not. (is_finite(some) .and. is_finite(other))) return
      ! Divided first, since the difference may overflow
      larger = max(abs(some), abs(other), scale, tiny(1.0_wp))
      difference = abs(some/larger - other/larger)
   end function relative_difference

   !> Is a number finite? By its bits: a damaged file may hold a signalling not-a-number, which even `ieee_is_nan` of gfortran
   !> compares and thereby traps.
   elemental function is_finite(number)
      !> The number [any unit]
      real(wp), intent(in) :: number
      !> Is it?
      logical :: is_finite

      is_finite = iand(transfer(number, 0_int64), of_exponent) /= of_exponent
   end function is_finite

end module camroller_differences
