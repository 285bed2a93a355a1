!> Oil film between a roller and its pin: closed forms of the film, the journal bearings of the camshaft as a second way to the
!> mixed state, derivatives, energy, and what a case may say.
module test_pin_film
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, kind_deck
   use camroller_bearing_asperity, only : bearing_asperity_t, bearing_state_t, carry_load, new_touch, bearing_touch_t
   use camroller_case, only : case_t
   use camroller_journal, only : journal_law_names, journal_solved, journal_t, journal_at_speed
   use camroller_kinematics, only : rotation_names
   use camroller_model, only : model_t, new_model
   use camroller_pin_film, only : new_pin_part, pin_film_t, pin_law_names, pin_part_t, pin_state_t, set_pin_oil, solve_pin, &
      & unloaded_torque
   use closeness, only : check_close, check_scaled, expect_error
   use energy_checks, only : check_bearing_energy
   use reference_cases, only : add_gas_force, add_pin_film, skewed_case, thesis_case
   implicit none
   private

   public :: collect_pin_film

   !> Radius of the pin [m], friction coefficient of its asperities [-], viscosity [Pa s]
   real(wp), parameter :: radius = 6.1e-3_wp, coefficient = 0.1_wp, viscosity = 0.02_wp
   !> Spin over which the torque reverses, far below the spins tried [rad/s]
   real(wp), parameter :: reversal_spin = 1.0e-7_wp
   !> What the tables of the asperities' forces are allowed to change [-]
   real(wp), parameter :: table_error = 1.0e-7_wp

contains

   subroutine collect_pin_film(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("short bearing without contact of asperities: load and torque of Ocvirk in closed form", test_short), &
         new_unittest("without load the torque is Petroff's", test_petroff), &
         new_unittest("film and asperities share the load as in a camshaft bearing", test_mixed), &
         new_unittest("torque at standstill: nothing, and no jump; boundary friction at small spin", test_standstill), &
         new_unittest("derivatives of the torque over load and spin", test_slopes), &
         new_unittest("friction falls and rises with the speed", test_stribeck), &
         new_unittest("energy closes, with contact and without, in both senses of rotation", test_energy), &
         new_unittest("what a pin with a film cannot have is refused", test_refusals) &
         ]
   end subroutine collect_pin_film

   !> Pin of the reference train.
   subroutine make_part(part, law, roughness)
      type(pin_part_t), intent(out) :: part
      !> One of `pin_law_names`
      character(len=*), intent(in) :: law
      !> Roughness [m]
      real(wp), intent(in) :: roughness
      type(error_t), allocatable :: failure

      call new_pin_part(part, pin_film_t(law, 9.0e-3_wp, 20.0e-6_wp, roughness, 110.0e9_wp), radius, coefficient, failure)
      call set_pin_oil(part, viscosity)
   end subroutine make_part

   subroutine test_short(error)
      type(error_type), allocatable, intent(out) :: error
      type(pin_part_t) :: part
      type(pin_state_t) :: pin
      ! Eccentricities [-], spin [rad/s], load [N], torque [N m]; Ocvirk's factor of the load [N]
      real(wp), parameter :: eccentricities(4) = [0.1_wp, 0.4_wp, 0.7_wp, 0.95_wp], spin = 180.0_wp
      real(wp) :: load, torque, scale
      integer :: i

      call make_part(part, "short_ocvirk", 1.0e-9_wp)
      do i = 1, size(eccentricities)
         associate (e => eccentricities(i), width => 9.0e-3_wp, clearance => 20.0e-6_wp)
            scale = viscosity*spin*radius*width**3/(4.0_wp*clearance**2)
            load = scale*e/(1.0_wp - e**2)**2*sqrt(16.0_wp*e**2 + pi**2*(1.0_wp - e**2))
            ! Shear of the whole film, and half of the moment of the load beside the centre, c e sin A with sin A = across/load
            torque = 2.0_wp*pi*viscosity*spin*radius**3*width/(clearance*sqrt(1.0_wp - e**2)) &
               & + 0.5_wp*clearance*e*scale*pi*e/(1.0_wp - e**2)**1.5_wp
            call solve_pin(part, load, spin, reversal_spin, pin)
            call check_close(error, pin%eccentricity, e, 1.0e-12_wp, "eccentricity")
            if (allocated(error)) return
            call check_close(error, pin%torque + unloaded_torque(part)*spin, torque, 1.0e-12_wp, "torque")
            if (allocated(error)) return
            call check_close(error, pin%film, clearance*(1.0_wp - e), 1.0e-11_wp, "film")
            if (allocated(error)) return
            call check(error, .not. abs(pin%asperity_share) > 0.0_wp, "no asperity touches")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_short

   subroutine test_petroff(error)
      type(error_type), allocatable, intent(out) :: error
      type(pin_part_t) :: part
      type(pin_state_t) :: pin
      ! Petroff's torque over the spin [N m s/rad]
      real(wp), parameter :: petroff = 2.0_wp*pi*viscosity*radius**3*9.0e-3_wp/20.0e-6_wp
      integer :: law

      do law = 1, size(pin_law_names)
         call make_part(part, pin_law_names(law), 0.3e-6_wp)
         call check_close(error, unloaded_torque(part), petroff, 1.0e-13_wp, "torque over spin")
         if (allocated(error)) return
         call solve_pin(part, 0.0_wp, 100.0_wp, reversal_spin, pin)
         call check(error, .not. max(abs(pin%torque), abs(pin%by_load), abs(pin%by_spin), pin%eccentricity) > 0.0_wp, "no load")
         if (allocated(error)) return
         ! Shear grows by half of the square of the eccentricity, and the load beside the centre adds to that
         call solve_pin(part, 0.1_wp, 100.0_wp, reversal_spin, pin)
         call check(error, pin%torque > 0.5_wp*pin%eccentricity**2*petroff*100.0_wp .and. &
            & pin%torque < pin%eccentricity**2*petroff*100.0_wp .and. pin%eccentricity < 0.01_wp, "small load")
         if (allocated(error)) return
      end do
   end subroutine test_petroff

   subroutine test_mixed(error)
      type(error_type), allocatable, intent(out) :: error
      type(pin_part_t) :: part
      type(pin_state_t) :: pin
      type(bearing_touch_t) :: touch
      type(journal_t) :: journal
      type(bearing_state_t) :: bearing
      type(error_t), allocatable :: failure
      ! Loads [N], spins [rad/s], largest and smallest share of the asperities seen [-]
      real(wp), parameter :: loads(3) = [20.0_wp, 300.0_wp, 1500.0_wp], spins(3) = [0.01_wp, 20.0_wp, 400.0_wp]
      real(wp) :: largest, smallest, torque
      integer :: law, i, k, place, status

      call new_touch(touch, bearing_asperity_t(0.3e-6_wp, 110.0e9_wp, coefficient), 20.0e-6_wp, failure)
      largest = 0.0_wp
      smallest = 1.0_wp
      do law = 1, size(pin_law_names)
         call make_part(part, pin_law_names(law), 0.3e-6_wp)
         place = findloc(journal_law_names, pin_law_names(law), 1)
         do i = 1, size(loads)
            do k = 1, size(spins)
               journal = journal_at_speed(place, 2.0_wp*radius, 9.0e-3_wp, 20.0e-6_wp, viscosity, spins(k))
               call carry_load(journal, [loads(i), 0.0_wp], bearing, status, touch)
               call check(error, status, journal_solved)
               if (allocated(error)) return
               call solve_pin(part, loads(i), spins(k), reversal_spin, pin)
               call check_close(error, pin%film, bearing%film, table_error, "film")
               if (allocated(error)) return
               call check_scaled(error, pin%asperity_share, bearing%asperity_load/loads(i), 1.0_wp, table_error, "asperities")
               if (allocated(error)) return
               torque = pin%torque + unloaded_torque(part)*spins(k)
               largest = max(largest, pin%asperity_share)
               smallest = min(smallest, pin%asperity_share)
               call check_close(error, torque, bearing%torque, table_error, "torque")
               if (allocated(error)) return
            end do
         end do
      end do
      call check(error, largest > 0.9_wp .and. smallest < 1.0e-3_wp, "from mixed friction to a whole film")
   end subroutine test_mixed

   subroutine test_standstill(error)
      type(error_type), allocatable, intent(out) :: error
      type(pin_part_t) :: part
      type(pin_state_t) :: pin, mirror
      ! Spins over that of the reversal [-]
      real(wp), parameter :: spins(4) = [0.0_wp, 1.0e-8_wp, 1.0_wp, 30.0_wp]
      integer :: i

      call make_part(part, "finite", 0.3e-6_wp)
      do i = 1, size(spins)
         call solve_pin(part, 100.0_wp, 1.0e-3_wp*spins(i), 1.0e-3_wp, pin)
         call solve_pin(part, 100.0_wp, -1.0e-3_wp*spins(i), 1.0e-3_wp, mirror)
         call check(error, .not. abs(pin%torque + mirror%torque) > 0.0_wp, "the same torque in both senses")
         if (allocated(error)) return
         call check(error, (pin%by_spin > 0.0_wp .or. i == size(spins)) .and. pin%torque >= 0.0_wp, "against the spin")
         if (allocated(error)) return
      end do
      ! At a spin that makes no film: the normal forces are the load and a little more, since they stand around the line of centres
      call check(error, pin%asperity_share > 0.98_wp .and. pin%torque > coefficient*100.0_wp*radius*0.98_wp .and. &
         & pin%torque < coefficient*100.0_wp*radius*1.1_wp, "boundary friction")
   end subroutine test_standstill

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      ! Relative step [-]; difference allowed: truncation h^2, by third derivatives up to 1e3 times the first, and rounding
      ! 1e-12/h [-]
      real(wp), parameter :: h = 1.0e-5_wp, tolerance = 3.0e-7_wp
      ! Loads [N], spins [rad/s]
      real(wp), parameter :: loads(4) = [5.0_wp, 60.0_wp, 500.0_wp, 2500.0_wp], &
         & spins(5) = [0.0_wp, 0.3_wp, -4.0_wp, 50.0_wp, 600.0_wp]
      type(pin_part_t) :: part
      type(pin_state_t) :: pin, low, high
      ! Spin over which the torque reverses, step [rad/s]
      real(wp) :: reversal, step
      integer :: law, i, k

      reversal = 0.5_wp
      do law = 1, size(pin_law_names)
         call make_part(part, pin_law_names(law), 0.3e-6_wp)
         do i = 1, size(loads)
            do k = 1, size(spins)
               call solve_pin(part, loads(i), spins(k), reversal, pin)
               call solve_pin(part, loads(i)*(1.0_wp - h), spins(k), reversal, low)
               call solve_pin(part, loads(i)*(1.0_wp + h), spins(k), reversal, high)
               call check_scaled(error, pin%by_load, (high%torque - low%torque)/(2.0_wp*h), abs(pin%torque) + abs(pin%by_load), &
                  & tolerance, "over the load, "//trim(pin_law_names(law)))
               if (allocated(error)) return
               step = h*max(abs(spins(k)), reversal)
               call solve_pin(part, loads(i), spins(k) - step, reversal, low)
               call solve_pin(part, loads(i), spins(k) + step, reversal, high)
               call check_scaled(error, pin%by_spin, (high%torque - low%torque)/(2.0_wp*step), &
                  & abs(pin%by_spin) + abs(pin%torque)*h/step, tolerance, "over the spin, "//trim(pin_law_names(law)))
               if (allocated(error)) return
               call solve_pin(part, loads(i), spins(k), reversal*(1.0_wp - h), low)
               call solve_pin(part, loads(i), spins(k), reversal*(1.0_wp + h), high)
               call check_scaled(error, pin%by_reversal, (high%torque - low%torque)/(2.0_wp*h), &
                  & abs(pin%by_reversal) + abs(pin%torque)*1.0e-3_wp, tolerance, "over the spin of reversal")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_slopes

   subroutine test_stribeck(error)
      type(error_type), allocatable, intent(out) :: error
      type(pin_part_t) :: part
      type(pin_state_t) :: pin
      ! Torques over load and radius [-]: mixed, least, with a thick film
      real(wp) :: coefficients(3)
      real(wp), parameter :: spins(3) = [0.02_wp, 40.0_wp, 3000.0_wp]
      integer :: i

      call make_part(part, "finite", 0.3e-6_wp)
      do i = 1, size(spins)
         call solve_pin(part, 100.0_wp, spins(i), reversal_spin, pin)
         coefficients(i) = (pin%torque + unloaded_torque(part)*spins(i))/(100.0_wp*radius)
      end do
      call check(error, coefficients(1) > 0.08_wp .and. coefficients(2) < 0.02_wp .and. coefficients(3) > 2.0_wp*coefficients(2), &
         & "boundary friction, a thin film, a thick film")
   end subroutine test_stribeck

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: cases(3)
      integer :: k

      do k = 1, size(cases)
         cases(k) = skewed_case(rotation_names(1 + mod(k, 2)))
         call add_gas_force(cases(k))
         call add_pin_film(cases(k), pin_law_names(1 + mod(k, 2)))
      end do
      call check_bearing_energy(cases, 0.05_wp, error)
   end subroutine test_energy

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: pinned
      type(model_t) :: model
      type(error_t), allocatable :: failure
      character(len=*), parameter :: words(6) = [character(len=24) :: "covers widths", "covers widths", "above zero", &
         & "eight times", "above zero", "not combined"]
      integer :: i

      do i = 1, size(words)
         pinned = thesis_case()
         call add_pin_film(pinned, "finite")
         select case (i)
         case (1)
            pinned%needle_bearing%film%law = "long_full_sommerfeld"
         case (2)
            pinned%needle_bearing%film%width = 3.0_wp*radius
         case (3)
            pinned%needle_bearing%film%radial_clearance = 0.0_wp
         case (4)
            pinned%needle_bearing%film%roughness = 3.0e-6_wp
         case (5)
            pinned%needle_bearing%film%modulus = 0.0_wp
         case (6)
            allocate (pinned%needle_drag)
            pinned%needle_drag%pitch_diameter = 10.0e-3_wp
         end select
         call new_model(model, pinned, 1, failure)
         call expect_error(error, failure, kind_deck, trim(words(i)))
         if (allocated(error)) return
         deallocate (failure)
      end do
   end subroutine test_refusals

end module test_pin_film
