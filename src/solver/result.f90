!> A result: named series over the cam angle and named scalars, each with unit, meaning and the effect it comes from.
!>
!> Layer: solver. In: what `camroller_report` evaluated. Out: `result_t`, to be read by name or written to a file.
module camroller_result
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_effect_list, only : choice_t
   implicit none
   private

   public :: quantity_t, result_t, get_series, get_summary, find_quantity

   !> What a column of numbers means
   type :: quantity_t
      !> Name in files and in `get_series`
      character(len=:), allocatable :: name
      !> SI unit, `1` for none, `degree` for the cam angle
      character(len=:), allocatable :: unit
      !> Meaning in a few words
      character(len=:), allocatable :: description
      !> Part of the model that it comes from, e.g. `asperity`
      character(len=:), allocatable :: source
   end type quantity_t

   !> Result of one case
   type :: result_t
      !> Cam angle of each row, 0 to 360 with the nose at 180, end point left out [deg]
      real(wp), allocatable :: angle(:)
      !> Meaning of each series
      type(quantity_t), allocatable :: series(:)
      !> Values, shape (angle, series), units as in `series`
      real(wp), allocatable :: series_values(:, :)
      !> Meaning of each scalar
      type(quantity_t), allocatable :: summary(:)
      !> Values of the scalars, units as in `summary`
      real(wp), allocatable :: summary_values(:)
      !> Remarks that do not make the result wrong, one per line; empty where there are none
      character(len=:), allocatable :: warnings
      !> Were profiles across the contact asked for that could not be solved? The reason is among the remarks
      logical :: lacks_profiles = .false.
      !> Which effects took part and why; allocated where the program chose them
      type(choice_t), allocatable :: choice
   end type result_t

contains

   !> Position of a quantity in a list, 0 where it is not there.
   pure function find_quantity(quantities, name) result(position)
      !> List to look in
      type(quantity_t), intent(in) :: quantities(:)
      !> Name looked for
      character(len=*), intent(in) :: name
      !> Position, or 0
      integer :: position

      do position = 1, size(quantities)
         if (quantities(position)%name == name) return
      end do
      position = 0
   end function find_quantity

   !> Copy of one series.
   subroutine get_series(result, name, values, error)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of the series
      character(len=*), intent(in) :: name
      !> One value for each angle [unit of the series]
      real(wp), allocatable, intent(out) :: values(:)
      !> Usage error where the result has no such series
      type(error_t), allocatable, intent(out) :: error

      integer :: position

      position = find_quantity(result%series, name)
      if (position == 0) then
         call raise(error, kind_usage, "the result has no series '"//name//"'")
         return
      end if
      values = result%series_values(:, position)
   end subroutine get_series

   !> One scalar.
   subroutine get_summary(result, name, value, error)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of the scalar
      character(len=*), intent(in) :: name
      !> Its value [unit of the scalar]
      real(wp), intent(out) :: value
      !> Usage error where the result has no such scalar
      type(error_t), allocatable, intent(out) :: error

      integer :: position

      value = 0.0_wp
      position = find_quantity(result%summary, name)
      if (position == 0) then
         call raise(error, kind_usage, "the result has no scalar '"//name//"'")
         return
      end if
      value = result%summary_values(position)
   end subroutine get_summary

end module camroller_result
