!> Cam angles at which an end of the roller begins or ceases to carry load.
!>
!> In: a cycle with the points met on the way round it. Out: panels that end there. The load at an end has a kink there and its
!> pressure, like a root, no slope; where an end carries for a part of a panel only, rules of seven and three points may agree by
!> chance.
module camroller_end_contacts
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_follower_samples, only : entrainment_of, entrainment_t, follower_samples_t
   use camroller_panels, only : panels_t, split_at
   use camroller_torque_list, only : torque_count
   implicit none
   private

   public :: split_at_ends

   !> Accuracy of the angle [rad]: what lies beside a kink adds the square of it to a mean, beside a root its power 3/2
   real(wp), parameter :: angle_tolerance = 1.0e-8_wp

contains

   !> Divide panels where the number of ends that carry load changes between two points in contact.
   subroutine split_at_ends(panels, samples, points, error)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> The samples, of a model with the load along the roller
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order
      type(entrainment_t), intent(in) :: points(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Next point, behind the changes found
      type(entrainment_t) :: next
      integer :: i, change

      do i = 2, size(points)
         next = points(i - 1)
         ! One end after the other
         do change = 1, 2
            if (.not. (next%is_touching .and. points(i)%is_touching)) exit
            if (next%loaded_ends == points(i)%loaded_ends) exit
            call find_change(samples, points(i), next, error)
            if (allocated(error)) return
            call split_at(panels, samples, next%angle, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine split_at_ends

   !> Find the first change by halving: loads have no sign that would tell how far away it is.
   subroutine find_change(samples, last, point, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Point behind the change
      type(entrainment_t), intent(in) :: last
      !> In: point before it; out: point next behind it
      type(entrainment_t), intent(inout) :: point
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(entrainment_t) :: left, right, middle
      ! Values of all that is sampled [unit of each]
      real(wp) :: values(samples%series + torque_count)

      left = point
      right = last
      do while (right%angle - left%angle > angle_tolerance)
         call samples%sample(0.5_wp*(left%angle + right%angle), values, error)
         if (allocated(error)) return
         middle = entrainment_of(samples, 0.5_wp*(left%angle + right%angle))
         if (middle%loaded_ends == left%loaded_ends) then
            left = middle
         else
            right = middle
         end if
      end do
      point = right
   end subroutine find_change

end module camroller_end_contacts
