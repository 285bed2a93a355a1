!> Where the next contact of a row is looked for: on the parabola through the last three.
module test_follower_samples
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_contact_forces, only : contact_t
   use camroller_follower_samples, only : trail_t, contact_ahead, extend_trail
   implicit none
   private

   public :: collect_follower_samples

contains

   subroutine collect_follower_samples(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a contact on a parabola is met, one far ahead or behind is not looked for", test_trail) &
         ]
   end subroutine collect_follower_samples

   !> Contact at an angle, with what is looked for on a parabola [N, N m, -].
   pure function contact_at(angle, touches) result(contact)
      real(wp), intent(in) :: angle
      logical, intent(in) :: touches
      type(contact_t) :: contact

      contact%is_touching = touches
      contact%tangential_force = 3.0_wp - 2.0_wp*angle + 5.0_wp*angle**2
      contact%bearing_torque = 1.0_wp + angle - angle**2
      contact%film_ratio = 2.0_wp + 0.5_wp*angle**2
   end function contact_at

   subroutine test_trail(error)
      type(error_type), allocatable, intent(out) :: error
      type(trail_t) :: trail
      type(contact_t) :: last, ahead, there
      ! Angles at uneven distances [rad]
      real(wp), parameter :: angles(4) = [0.0_wp, 0.1_wp, 0.4_wp, 0.6_wp]
      integer :: i

      do i = 1, size(angles)
         last = contact_at(angles(i), .true.)
         call extend_trail(trail, angles(i), last)
      end do
      ahead = contact_ahead(trail, 0.9_wp, last)
      there = contact_at(0.9_wp, .true.)
      call check(error, all(abs([ahead%tangential_force - there%tangential_force, ahead%bearing_torque - there%bearing_torque, &
         & ahead%film_ratio - there%film_ratio]) < 100.0_wp*epsilon(1.0_wp)), "not on the parabola")
      if (allocated(error)) return
      ahead = contact_ahead(trail, 1.2_wp, last)
      call check(error, .not. abs(ahead%film_ratio - last%film_ratio) > 0.0_wp, "looked for too far ahead")
      if (allocated(error)) return
      ! back to an angle before, and after a place without contact, there is one contact to start from
      call extend_trail(trail, 0.2_wp, contact_at(0.2_wp, .true.))
      call check(error, trail%count, 1, "a trail goes on behind its end")
      if (allocated(error)) return
      call extend_trail(trail, 0.3_wp, contact_at(0.3_wp, .false.))
      call check(error, trail%count, 0, "a trail goes on without contact")
   end subroutine test_trail

end module test_follower_samples
