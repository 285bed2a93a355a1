!> Values of a result by their names, for checks.
module result_values
   use camroller_kinds, only : wp
   use camroller_result, only : result_t, find_quantity
   implicit none
   private

   public :: series_of, scalar_of, lost_share

contains

   !> A series; zeros where the result does not have it.
   function series_of(result, name) result(values)
      !> The result
      type(result_t), intent(in) :: result
      !> Its name
      character(len=*), intent(in) :: name
      ! [unit of the series]
      real(wp), allocatable :: values(:)
      integer :: place

      place = find_quantity(result%series, trim(name))
      values = 0.0_wp*result%angle
      if (place > 0) values = result%series_values(:, place)
   end function series_of

   !> A scalar; zero where the result does not have it.
   function scalar_of(result, name) result(value)
      !> The result
      type(result_t), intent(in) :: result
      !> Its name
      character(len=*), intent(in) :: name
      ! [unit of the scalar]
      real(wp) :: value
      integer :: place

      value = 0.0_wp
      place = find_quantity(result%summary, trim(name))
      if (place > 0) value = result%summary_values(place)
   end function scalar_of

   !> Part of the cycle without contact, of both lobe shapes together [-].
   real(wp) function lost_share(result)
      type(result_t), intent(in) :: result

      lost_share = scalar_of(result, "lost_contact_share") + scalar_of(result, "lobe_2_lost_contact_share")
   end function lost_share

end module result_values
