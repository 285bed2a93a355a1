!> Journals that move in their bearings: velocity and force of the film.
module test_journal_motion
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_journal, only : film_at, film_t, journal_at_speed, journal_t
   use camroller_journal_motion, only : film_velocity, journal_velocity
   implicit none
   private

   public :: collect_journal_motion, bearing_of, across

   !> Places of laws in `journal_law_names`
   integer, parameter :: short = 2, finite = 3
   !> A bearing [m], [m], [m], [Pa s], [rad/s]
   real(wp), parameter :: diameter = 26.0e-3_wp, width = 10.4e-3_wp, clearance = 0.05e-3_wp, oil = 0.01_wp, speed = 30.0_wp

contains

   subroutine collect_journal_motion(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("at rest a short bearing is that of Ocvirk", test_at_rest), &
         new_unittest("velocity of a short bearing under the force of Capone's closed form", test_capone), &
         new_unittest("velocity and force are inverse to each other, at any place", test_inverse), &
         new_unittest("a load that squeezes a film without rotation does so by the closed form", test_squeeze), &
         new_unittest("a narrow bearing of finite width moves as a short one", test_narrow), &
         new_unittest("a shaft that turns the other way has the mirror image of the orbit", test_mirror) &
         ]
   end subroutine collect_journal_motion

   !> Bearing by a law
   function bearing_of(law) result(journal)
      integer, intent(in) :: law
      type(journal_t) :: journal

      journal = journal_at_speed(law, diameter, width, clearance, oil, speed)
   end function bearing_of

   !> A vector turned by a right angle
   function across(vector) result(turned)
      real(wp), intent(in) :: vector(2)
      real(wp) :: turned(2)

      turned = [-vector(2), vector(1)]
   end function across

   !> Force of a short bearing by Capone (1986), over place and velocity in the frame that turns with half the shaft's speed, for a
   !> shaft that turns from x to y [unit load]
   function capone_force(journal, place, velocity) result(force)
      type(journal_t), intent(in) :: journal
      real(wp), intent(in) :: place(2), velocity(2)
      real(wp) :: force(2), q, a, g, v, s

      associate (x => place(1), y => place(2), along => -2.0_wp*velocity(2), over => 2.0_wp*velocity(1))
         q = 1.0_wp - x**2 - y**2
         a = atan2(over, along) - pi
         g = 2.0_wp/sqrt(q)*(0.5_wp*pi + atan((y*cos(a) - x*sin(a))/sqrt(q)))
         v = (2.0_wp + (y*cos(a) - x*sin(a))*g)/q
         s = (x*cos(a) + y*sin(a))/(1.0_wp - (x*cos(a) + y*sin(a))**2)
         ! his force on the journal in mu omega R L^3/(4 c^2), which is (L/r)^2/4 unit loads
         force = journal%width_ratio**2*sqrt(along**2 + over**2)/q &
            & *[3.0_wp*x*v - sin(a)*g - 2.0_wp*cos(a)*s, 3.0_wp*y*v + cos(a)*g - 2.0_wp*sin(a)*s]
      end associate
   end function capone_force

   subroutine test_at_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      type(film_t) :: film
      real(wp) :: place(2), velocity(2), e, angle
      integer :: i

      journal = bearing_of(short)
      do i = 1, 400
         e = 1.0_wp - 10.0_wp**(-0.01_wp*i)
         place = e*[cos(0.1_wp*i), sin(0.1_wp*i)]
         film = film_at(journal, e/sqrt((1.0_wp - e)*(1.0_wp + e)))
         angle = 0.1_wp*i - film%angle
         velocity = film_velocity(journal, place, film%number*[cos(angle), sin(angle)])
         ! place is known to round-off over 1 - e
         call check(error, norm2(velocity + 0.5_wp*across(place)) < 1.0e-14_wp*e/(1.0_wp - e))
         if (allocated(error)) return
      end do
   end subroutine test_at_rest

   subroutine test_capone(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      real(wp) :: place(2), velocity(2), found(2), e
      integer :: i

      journal = bearing_of(short)
      do i = 1, 1000
         e = 0.99_wp*modulo(0.618034_wp*i, 1.0_wp)
         place = e*[cos(1.0_wp*i), sin(1.0_wp*i)]
         velocity = modulo(0.7548777_wp*i, 1.0_wp)*[cos(2.3_wp*i), sin(2.3_wp*i)] - 0.5_wp*across(place)
         found = film_velocity(journal, place, capone_force(journal, place, velocity))
         ! both lose digits to cancellation where a thin film is pulled apart
         call check(error, norm2(found - velocity) < 1.0e-13_wp*norm2(velocity)/(1.0_wp - e)**2)
         if (allocated(error)) return
      end do
   end subroutine test_capone

   subroutine test_inverse(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      real(wp) :: place(2), load(2), velocity(2), e
      integer :: i, k

      journal = bearing_of(short)
      do k = 0, 6
         e = 1.0_wp - 10.0_wp**(-0.5_wp*k)
         do i = 0, 99
            place = e*[cos(1.0_wp*i), sin(1.0_wp*i)]
            load = 10.0_wp**(0.1_wp*i - 5.0_wp)*[cos(0.063_wp*i**2), sin(0.063_wp*i**2)]
            velocity = film_velocity(journal, place, load)
            ! round-off over the part of the film that is left where it is pulled apart
            call check(error, norm2(capone_force(journal, place, velocity) - load) < 1.0e-13_wp*norm2(load) &
               & /(1.0_wp - e)**2, "force")
            if (allocated(error)) return
            call check(error, dot_product(load, velocity) > 0.0_wp, "the film drives the journal")
            if (allocated(error)) return
         end do
      end do
      call check(error, norm2(film_velocity(journal, place, [0.0_wp, 0.0_wp])) <= 0.0_wp, "without a load")
   end subroutine test_inverse

   !> Without rotation and along the load `q d theta = 4 (L/D)^2 d[e (pi - arccos e)/(1 - e^2)^(3/2) + 1/(1 - e^2)]`
   subroutine test_squeeze(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      real(wp) :: velocity(2), e, expected
      integer :: i

      journal = bearing_of(short)
      do i = -99, 99
         e = 0.01_wp*i
         call journal_velocity(journal, e*[0.6_wp, 0.8_wp], 3.0_wp*journal%unit_load*[0.6_wp, 0.8_wp], 0.0_wp, velocity)
         expected = 3.0_wp/(4.0_wp*journal%width_ratio**2)*(1.0_wp - e**2)**2 &
            & /((1.0_wp + 2.0_wp*e**2)*(pi - acos(e))/sqrt(1.0_wp - e**2) + 3.0_wp*e)
         ! what is left of the sum where the film is pulled apart, e to -1
         call check(error, norm2(velocity - expected*[0.6_wp, 0.8_wp]) < 1.0e-12_wp*expected/(1.0_wp + e)**2, "velocity")
         if (allocated(error)) return
      end do
   end subroutine test_squeeze

   subroutine test_narrow(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: place(2), load(2), velocities(2, 2)
      integer :: i, law

      do i = 1, 50
         place = 0.9_wp*sin(1.7_wp*i)*[cos(1.0_wp*i), sin(1.0_wp*i)]
         load = [cos(3.0_wp*i), sin(3.0_wp*i)]
         do law = short, finite
            velocities(:, law - 1) = film_velocity(journal_at_speed(law, 1.0_wp, 1.0e-3_wp, 1.0e-3_wp, oil, speed), place, load)
         end do
         ! k (L/D)^2/(1 - xi)
         call check(error, norm2(velocities(:, 1) - velocities(:, 2)) < 1.4e-6_wp/0.1_wp*norm2(velocities(:, 1)))
         if (allocated(error)) return
      end do
   end subroutine test_narrow

   subroutine test_mirror(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: place(2), load(2), velocities(2, 2)
      integer :: i, law

      do law = short, finite
         do i = 1, 50
            place = 0.9_wp*sin(1.7_wp*i)*[cos(1.0_wp*i), sin(1.0_wp*i)]
            load = bearing_unit(law)*[cos(3.0_wp*i), sin(3.0_wp*i)]
            call journal_velocity(bearing_of(law), place, load, 1.0_wp, velocities(:, 1))
            call journal_velocity(bearing_of(law), [place(1), -place(2)], [load(1), -load(2)], -1.0_wp, velocities(:, 2))
            call check(error, norm2(velocities(:, 1) - [velocities(1, 2), -velocities(2, 2)]) < 1.0e-12_wp*norm2(velocities(:, 1)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_mirror

   !> Unit load of a bearing
   function bearing_unit(law) result(load)
      integer, intent(in) :: law
      real(wp) :: load
      type(journal_t) :: journal

      journal = bearing_of(law)
      load = journal%unit_load
   end function bearing_unit

end module test_journal_motion
