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

   !> How a quantity differs
   type :: difference_t
      !> Its name in the file, e.g. `summary/mean_torque_drive`
      character(len=:), allocatable :: name
      !> Cases in which it does
      integer :: cases = 0
      !> Largest difference relative to the larger of both values [-]; huge where one of them is no number,
      !> `another_text` where they are texts
      real(wp) :: largest = 0.0_wp
      !> Case of the largest difference, from 0; the first of several
      integer :: case_number = 0
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
      call note(list, name, case_number, relative_difference(stored, computed))
   end subroutine compare_number

   !> Compare the numbers of a case; what is kept is the one that differs most.
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

      integer :: i, worst

      worst = 0
      do i = 1, size(stored)
         if (transfer(stored(i), 0_int64) == transfer(computed(i), 0_int64)) cycle
         if (worst == 0) worst = i
         if (relative_difference(stored(i), computed(i)) > relative_difference(stored(worst), computed(worst))) worst = i
      end do
      if (worst > 0) call compare_number(list, name, number, stored(worst), computed(worst), differs)
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
      call note(list, name, case_number, another_text)
   end subroutine compare_text

   !> Note a difference.
   subroutine note(list, name, case_number, relative)
      !> What differs so far
      type(difference_t), allocatable, intent(inout) :: list(:)
      !> Name of the quantity in the file
      character(len=*), intent(in) :: name
      !> Number of the case, from 0
      integer, intent(in) :: case_number
      !> The difference [-]
      real(wp), intent(in) :: relative

      type(difference_t), allocatable :: longer(:)
      integer :: place
      logical :: is_new

      if (.not. allocated(list)) allocate (list(0))
      place = 1
      do while (place <= size(list))
         if (list(place)%name >= name) exit
         place = place + 1
      end do
      is_new = place > size(list)
      if (.not. is_new) is_new = list(place)%name /= name
      if (is_new) then
         allocate (longer(size(list) + 1))
         longer(:place - 1) = list(:place - 1)
         longer(place)%name = name
         longer(place + 1:) = list(place:)
         call move_alloc(longer, list)
      end if
      associate (difference => list(place))
         difference%cases = difference%cases + 1
         ! Of equal differences that of the first case, since threads bring cases in any order
         if (difference%cases > 1 .and. (relative < difference%largest .or. &
            & .not. relative > difference%largest .and. case_number > difference%case_number)) return
         difference%largest = relative
         difference%case_number = case_number
      end associate
   end subroutine note

   !> Difference of two numbers relative to the larger one.
   pure function relative_difference(some, other) result(difference)
      !> Two numbers [any unit]
      real(wp), intent(in) :: some, other
      !> Their difference [-]; huge where one of them is no finite number
      real(wp) :: difference

      ! Bits of the exponent, all of which are set where a number is not finite, and those of the fraction, which tell not-a-number
      ! from infinity
      integer(int64), parameter :: of_exponent = shiftl(2047_int64, 52), of_fraction = not(shiftl(4095_int64, 52))
      integer(int64) :: bits(2)
      real(wp) :: larger ! [any unit]

      ! A damaged file may hold a signalling not-a-number, which even `ieee_is_nan` of gfortran compares and thereby traps
      bits = transfer([some, other], bits)
      difference = 0.0_wp
      if (all(iand(bits, of_exponent) == of_exponent .and. iand(bits, of_fraction) /= 0_int64)) return
      difference = huge(1.0_wp)
      if (any(iand(bits, of_exponent) == of_exponent)) return
      ! Divided first, since the difference may overflow
      larger = max(abs(some), abs(other), tiny(1.0_wp))
      difference = abs(some/larger - other/larger)
   end function relative_difference

end module camroller_differences
