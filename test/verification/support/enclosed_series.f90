!> Do the smallest and largest values of a result enclose its series? A check that needs no second result, and that no method of
!> integration passes by sharing a mistake with another: series are evaluated at the output angles, extremes are searched for.
module enclosed_series
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_number_text, only : number_text
   use camroller_result, only : result_t, find_quantity, is_film
   use camroller_torque_list, only : of_residual, torque_series
   use result_checks, only : promised_error
   implicit none
   private

   public :: check_enclosed

contains

   !> Series with a row beyond their extremes by more than the result promises: relative to their range, torques to that of all
   !> friction at least; films by the rows with contact, where they are not zero.
   function check_enclosed(case, result) result(trouble)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result, with series
      type(result_t), intent(in) :: result
      !> What is wrong, blank where nothing is
      character(len=:), allocatable :: trouble

      ! Rounding of another evaluation over the largest magnitude [-]
      real(wp), parameter :: rounding = 1.0e-9_wp
      ! Extremes, how far a row is beyond, range that counts [unit of the series]; promised error, that found [-]
      real(wp) :: low, high, beyond, extent, promised, found
      integer :: i

      trouble = ""
      promised = promised_error(case, result, "estimated_error_of_extremes")
      do i = 1, size(result%series)
         associate (series => result%series(i), values => result%series_values(:, i))
            if (series%name == torque_series(of_residual)) cycle
            if (find_quantity(result%summary, "min_"//series%name) == 0) cycle
            low = result%summary_values(find_quantity(result%summary, "min_"//series%name))
            high = result%summary_values(find_quantity(result%summary, "max_"//series%name))
            beyond = max(maxval(values) - high, low - minval(values, .not. is_film(series) .or. values > 0.0_wp)) &
               & - rounding*max(abs(low), abs(high))
            if (.not. beyond > 0.0_wp) cycle
            extent = max(high - low, series%least)
            if (series%unit == "N m") extent = max(extent, friction_range())
            found = beyond/max(extent, tiny(1.0_wp))
            if (found > promised) trouble = trouble//" "//series%name//" is beyond its extremes by "//number_text(found, 2)// &
               & " of "//number_text(promised, 2)//";"
         end associate
      end do

   contains

      !> Range of the friction torque [N m].
      function friction_range() result(range)
         real(wp) :: range

         range = result%summary_values(find_quantity(result%summary, "max_torque_friction")) &
            & - result%summary_values(find_quantity(result%summary, "min_torque_friction"))
      end function friction_range

   end function check_enclosed

end module enclosed_series
