!> What the error of hours of running makes of the errors that a result states of its means and extremes.
!>
!> In: a result with the error over the hours of each lobe shape. Out: both statements with it. The cycle that makes the other
!> series takes its surfaces as they are, so that the errors of thickness and worn depth come on top of what it states.
module camroller_running_in_errors
   use camroller_kinds, only : wp
   use camroller_catalogue, only : lobe_prefix
   use camroller_error, only : error_t
   use camroller_result, only : find_quantity, result_t
   use camroller_run_remarks, only : lobe_count, take_scalar
   implicit none
   private

   public :: add_hours_to_errors

   !> Series that hours of running leave
   character(len=*), parameter :: names(*) = [character(len=18) :: "cam_film_thickness", "cam_wear_depth"]
   !> Statements that get their errors, and what their meaning says of it
   character(len=*), parameter :: of_means = "estimated_error_of_means", of_extremes = "estimated_error_of_extremes", &
      & words = "; of tribofilm and worn depth with the error over hours of running at the places of the cam"
   !> Part of a value that is rounding [-]
   real(wp), parameter :: rounding = 1.0e-9_wp

contains

   !> Add the largest error over the hours to the errors of means and of extremes, relative to what these are relative to.
   subroutine add_hours_to_errors(result, error)
      !> The result, with the error over the hours; out: with both statements
      type(result_t), intent(inout) :: result
      !> Internal error where the result lacks what it should have
      type(error_t), allocatable, intent(out) :: error

      ! Error over the hours, relative to the largest possible thickness and the largest depth [-]
      real(wp) :: hours
      ! Largest of them relative to a mean, and to the range of a series [-]
      real(wp) :: largest(2)
      integer :: lobe, i

      largest = 0.0_wp
      do lobe = 1, lobe_count(result)
         call take_scalar(result, trim(lobe_prefix(lobe))//"estimated_error_of_running_in", hours, error)
         do i = 1, size(names)
            call take_larger(result, trim(lobe_prefix(lobe))//trim(names(i)), hours, largest, error)
         end do
         if (allocated(error)) return
      end do
      call add_to(result, of_means, largest(1))
      call add_to(result, of_extremes, largest(2))
   end subroutine add_hours_to_errors

   !> Errors of a series relative to its mean and to its range, where they are larger than those before.
   subroutine take_larger(result, name, hours, largest, error)
      type(result_t), intent(in) :: result
      !> Name of the series, which the result need not have
      character(len=*), intent(in) :: name
      !> Error over the hours [-]
      real(wp), intent(in) :: hours
      !> Errors so far; out: with these [-]
      real(wp), intent(inout) :: largest(2)
      !> Internal error, or one that is there already
      type(error_t), allocatable, intent(inout) :: error

      ! Mean, smallest and largest value [unit of the series]
      real(wp) :: mean, lowest, highest
      integer :: series

      series = find_quantity(result%series, name)
      if (series == 0) return
      call take_scalar(result, "mean_"//name, mean, error)
      call take_scalar(result, "min_"//name, lowest, error)
      call take_scalar(result, "max_"//name, highest, error)
      if (allocated(error)) return
      ! What counts as none of a thickness is the largest possible one, to which its errors are relative; of a depth nothing is
      associate (least => result%series(series)%least)
         if (.not. max(least, highest) > 0.0_wp) return
         largest = max(largest, hours*max(least, highest)/[max(least, mean), max(least, highest - lowest, rounding*highest)])
      end associate
   end subroutine take_larger

   !> Add an error to a statement.
   subroutine add_to(result, name, mistake)
      type(result_t), intent(inout) :: result
      !> Name of the statement
      character(len=*), intent(in) :: name
      !> The error [-]
      real(wp), intent(in) :: mistake

      associate (place => find_quantity(result%summary, name))
         result%summary_values(place) = result%summary_values(place) + mistake
         result%summary(place)%description = result%summary(place)%description//words
      end associate
   end subroutine add_to

end module camroller_running_in_errors
