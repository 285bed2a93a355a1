!> Estimates of a train's vibration.
module test_train_outlook
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_axial_table, only : effective_lengths
   use camroller_case, only : case_t
   use camroller_dynamics, only : moments_t
   use camroller_kinematics, only : position_t
   use camroller_lift, only : evaluate_lift, lift_t
   use camroller_model, only : evaluate_geometry, model_t
   use camroller_roller_profile, only : roller_profile_t
   use camroller_spring_modes, only : new_spring_modes, spring_modes_t, spring_surge_t
   use camroller_state, only : evaluate_loading
   use camroller_traction, only : line_lengths_t
   use camroller_train_outlook, only : find_outlook, largest_response, outlook_t
   use reference_cases, only : thesis_case, make_model, set_point
   use flexible_cases, only : add_dynamics
   use closeness, only : check_close, check_scaled
   implicit none
   private

   public :: collect_train_outlook

contains

   subroutine collect_train_outlook(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the response of an oscillator to a harmonic force agrees with the closed form", test_harmonic), &
         new_unittest("an oscillator without damping, and one that creeps, have responses of a size", test_extremes), &
         new_unittest("natural frequencies of the reference train, with fixed pivot and with adjuster, agree with the reference", &
            & test_frequencies), &
         new_unittest("a rigid train of another size has the frequency and the load factor of its size", test_size), &
         new_unittest("load factors of the reference train agree with the reference within one per cent", test_load_factors), &
         new_unittest("surge forced by one harmonic of the lift agrees with the closed form", test_one_harmonic), &
         new_unittest("surge is the sum of the closed responses to the harmonics of the lift", test_surge), &
         new_unittest("noise of close rows of a lift table is in the estimates as its harmonics are", test_noisy_table), &
         new_unittest("a crowned roller has the frequency of a flat one as long as the part that carries at full lift", &
            & test_crowned), &
         new_unittest("a train of unknown mass has no estimate", test_unknown) &
         ]
   end subroutine collect_train_outlook

   subroutine test_harmonic(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 20000
      ! Force [m/s^2], frequency of the oscillator and of the force [rad/s], damping ratio [-], period [s], response [m]
      real(wp) :: force(n), frequency, pulse, damping_ratio, period, response
      integer :: i

      frequency = 300.0_wp
      damping_ratio = 0.02_wp
      pulse = 290.0_wp
      period = two_pi/pulse
      force = [(cos(two_pi*real(i - 1, wp)/n), i=1, n)]
      response = largest_response(force, frequency, damping_ratio, period/n, is_either_side=.false.)
      ! A line between two points errs by (2 pi/n)^2/8 = 1.2e-8, and the largest value at the points by as much
      call check_close(error, response, 1.0_wp/sqrt((frequency**2 - pulse**2)**2 + (2.0_wp*damping_ratio*frequency*pulse)**2), &
         & 5.0e-8_wp, "response")
   end subroutine test_harmonic

   !> A unit force with a harmonic at resonance: without damping the response is that of a ratio of 0.001, and with a hundred times
   !> the critical damping it is not below the force.
   subroutine test_extremes(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 2000
      ! Force [m/s^2], frequency [rad/s], response [m]
      real(wp) :: force(n), frequency, response
      integer :: i

      frequency = 300.0_wp
      force = frequency**2*[(1.0_wp + 0.1_wp*cos(10.0_wp*two_pi*real(i - 1, wp)/n), i=1, n)]
      response = largest_response(force, frequency, 0.0_wp, 10.0_wp*two_pi/(n*frequency), is_either_side=.false.)
      ! 1 + 0.1/(2 0.001); lines between points take 2.7e-3 of the harmonic
      call check_close(error, response, 51.0_wp, 1.0e-2_wp, "no damping")
      if (allocated(error)) return
      response = largest_response(force, frequency, 100.0_wp, 10.0_wp*two_pi/(n*frequency), is_either_side=.false.)
      ! As with critical damping: 1 + 0.1/2
      call check_close(error, response, 1.05_wp, 1.0e-3_wp, "much damping")
   end subroutine test_extremes

   !> Estimates of the reference train.
   subroutine estimate(speed, modes, has_adjuster, outlook, error)
      !> Speed [rev/min]
      real(wp), intent(in) :: speed
      integer, intent(in) :: modes
      logical, intent(in) :: has_adjuster
      type(outlook_t), intent(out) :: outlook
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model

      the_case = thesis_case()
      call set_point(the_case, speed*pi/30.0_wp, 0.01_wp)
      if (modes >= 0) call add_dynamics(the_case, modes, has_adjuster)
      call make_model(the_case, model, error)
      if (.not. allocated(error)) call find_outlook(model, outlook)
   end subroutine estimate

   !> Rows of an independent program: 2012 Hz and 7.7 kHz; with an adjuster 1560 Hz, 4.3 and 8.9 kHz.
   subroutine test_frequencies(error)
      type(error_type), allocatable, intent(out) :: error
      type(outlook_t) :: fixed, rigid, adjuster

      call estimate(900.0_wp, 5, .false., fixed, error)
      if (.not. allocated(error)) call estimate(900.0_wp, -1, .false., rigid, error)
      if (.not. allocated(error)) call estimate(900.0_wp, 5, .true., adjuster, error)
      if (allocated(error)) return
      call check_scaled(error, fixed%frequencies(1)/two_pi, 2012.0_wp, 1.0_wp, 5.0_wp, "fixed pivot")
      if (allocated(error)) return
      call check_scaled(error, fixed%frequencies(2)/two_pi, 7700.0_wp, 1.0_wp, 50.0_wp, "fixed pivot, second")
      if (allocated(error)) return
      call check_scaled(error, adjuster%frequencies(1)/two_pi, 1560.0_wp, 1.0_wp, 5.0_wp, "adjuster")
      if (allocated(error)) return
      call check_scaled(error, adjuster%frequencies(2)/two_pi, 4300.0_wp, 1.0_wp, 50.0_wp, "adjuster, second")
      if (allocated(error)) return
      call check_scaled(error, adjuster%frequencies(3)/two_pi, 8900.0_wp, 1.0_wp, 55.0_wp, "adjuster, third")
      if (allocated(error)) return
      ! A rigid train takes the usual stiffness, which is the reference train's
      call check_close(error, rigid%frequencies(1), fixed%frequencies(1), 1.0e-12_wp, "rigid train")
   end subroutine test_frequencies

   !> Bodies of one shape and material: as much stiffer as they are larger, with masses as their volumes.
   subroutine test_size(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: size = 5.0_wp ! [-]
      type(case_t) :: the_case
      type(model_t) :: model
      type(outlook_t) :: small, large

      call estimate(2800.0_wp, -1, .false., small, error)
      if (allocated(error)) return
      the_case = thesis_case()
      call set_point(the_case, 2800.0_wp*pi/30.0_wp/size, 0.01_wp)
      associate (mechanism => the_case%mechanism)
         mechanism%pivot_to_roller = size*mechanism%pivot_to_roller
         mechanism%pivot_to_pad = size*mechanism%pivot_to_pad
         mechanism%pivot_to_cam = size*mechanism%pivot_to_cam
         mechanism%base_radius = size*mechanism%base_radius
         mechanism%roller_radius = size*mechanism%roller_radius
         mechanism%contact_width = size*mechanism%contact_width
      end associate
      the_case%lift%max_lift = size*the_case%lift%max_lift
      the_case%masses%valve = size**3*the_case%masses%valve
      the_case%masses%finger = size**3*the_case%masses%finger
      the_case%roller%mass = size**3*the_case%roller%mass
      the_case%roller%wall_thickness = size*the_case%roller%wall_thickness
      the_case%spring%stiffness = size*the_case%spring%stiffness
      the_case%spring%precompression = size*the_case%spring%precompression
      the_case%spring%base_circle_load = size**2*the_case%spring%base_circle_load
      the_case%spring%seat_stiffness = size*the_case%spring%seat_stiffness
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call find_outlook(model, large)
      call check_close(error, large%frequencies(1), small%frequencies(1)/size, 1.0e-12_wp, "frequency")
      if (.not. allocated(error)) call check_close(error, large%load_factor, small%load_factor, 1.0e-12_wp, "load factor")
   end subroutine test_size

   !> Rows of an independent program with the same estimate; where points half a vibration apart lie changes it by up to 0.01.
   subroutine test_load_factors(error)
      type(error_type), allocatable, intent(out) :: error
      type(outlook_t) :: outlook
      ! Speeds [rev/min], load factors with a fixed pivot and with an adjuster [-]
      real(wp), parameter :: speeds(4) = [300.0_wp, 900.0_wp, 1500.0_wp, 2500.0_wp]
      real(wp), parameter :: factors(4, 2) = reshape([1.000_wp, 1.002_wp, 1.025_wp, 1.091_wp, 1.000_wp, 1.017_wp, 1.088_wp, &
         & 1.163_wp], [4, 2])
      integer :: i, kind

      do kind = 1, 2
         do i = 1, size(speeds)
            call estimate(speeds(i), 5, kind == 2, outlook, error)
            if (allocated(error)) return
            call check_scaled(error, outlook%load_factor, factors(i, kind), 1.0_wp, 1.0e-2_wp, "load factor "// &
               & achar(48 + i)//achar(48 + kind))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_load_factors

   !> Each harmonic alone in resonance with the first mode of a spring of 36 g and 25 kN/m: `k L_h/zeta`.
   subroutine test_one_harmonic(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: harmonics(5) = [8, 9, 10, 11, 12], n = 36000
      ! Lift harmonics of the reference train [um] and forces at resonance [N]
      real(wp), parameter :: lifts(5) = [33.1030_wp, 11.2094_wp, 4.9464_wp, 6.6546_wp, 1.5177_wp]
      real(wp), parameter :: forces(5) = [82.7575_wp, 28.0235_wp, 12.3660_wp, 16.6364_wp, 3.7943_wp]
      type(spring_modes_t) :: modes
      ! Second derivative of the lift over time [m/s^2], force [N]
      real(wp) :: lift(n), force
      integer :: i, k

      call new_spring_modes(modes, spring_surge_t(mass=0.036_wp), 25.0e3_wp)
      associate (frequency => modes%frequency(1))
         do i = 1, 5
            lift = -1.0e-6_wp*lifts(i)*frequency**2*[(cos(two_pi*harmonics(i)*real(k - 1, wp)/n), k=1, n)]
            force = modes%stiffness*pi*largest_response(2.0_wp*modes%share(1)*lift, frequency, modes%damping_ratio, &
               & two_pi*harmonics(i)/(n*frequency), is_either_side=.true.)
            ! The lifts have five digits; lines between 3000 points of a wave and more take 5e-7 of it
            call check_close(error, force, forces(i), 2.0e-5_wp, "surge in resonance")
            if (allocated(error)) return
         end do
      end associate
   end subroutine test_one_harmonic

   !> Harmonics 8 to 12 of the lift drive the spring's first mode of 416.667 Hz in resonance; the sum of the closed responses to all
   !> harmonics against the response in time.
   subroutine test_surge(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: points = 720, harmonics = 60
      ! Harmonics of the lift of the reference train [um], from an independent program
      real(wp), parameter :: amplitudes(8:12) = [33.1030_wp, 11.2094_wp, 4.9464_wp, 6.6546_wp, 1.5177_wp]
      type(outlook_t) :: outlook
      type(case_t) :: the_case
      type(model_t) :: model
      type(position_t) :: position
      ! Lift [m], displacement of the mode [m]; frequency of the mode [rad/s]
      real(wp) :: lift(points), mode(points), pulse
      ! Harmonic of the lift and of the mode [m]
      complex(wp) :: driving, response
      integer :: harmonic, h, i, status

      do harmonic = 8, 12
         the_case = thesis_case()
         call set_point(the_case, two_pi*416.666667_wp/harmonic, 0.01_wp)
         call add_dynamics(the_case, 5, .false.)
         call make_model(the_case, model, error)
         if (allocated(error)) return
         call find_outlook(model, outlook)
         do i = 1, points
            call evaluate_geometry(model, angle(i), position, status)
            lift(i) = position%lift
         end do
         pulse = model%flexible%modes%frequency(1)
         mode = 0.0_wp
         do h = 1, harmonics
            driving = 2.0_wp*sum([(lift(i)*exp(cmplx(0.0_wp, -h*angle(i), wp)), i=1, points)])/points
            if (h == harmonic) call check_close(error, 1.0e6_wp*abs(driving), amplitudes(harmonic), 1.0e-4_wp, "harmonic")
            if (allocated(error)) return
            associate (drive => h*model%speed)
               response = 2.0_wp/pi*drive**2*driving/cmplx(pulse**2 - drive**2, 2.0_wp*0.01_wp*pulse*drive, wp)
            end associate
            mode = mode + [(real(response*exp(cmplx(0.0_wp, h*angle(i), wp)), wp), i=1, points)]
         end do
         ! Lines between the points of the second derivative err by (pi h/720)^2/3 at the harmonics that count: 1e-3
         call check_close(error, outlook%surge(1), 25.0e3_wp*pi*maxval(abs(mode)), 3.0e-3_wp, "surge")
         if (allocated(error)) return
      end do

   contains

      !> Cam angle of a point [rad].
      pure real(wp) function angle(number)
         integer, intent(in) :: number

         angle = two_pi*real(number - 1, wp)/points - pi
      end function angle

   end subroutine test_surge

   !> Rows every 0.2 degrees with noise of up to 0.03 um, whose second derivative is of the size of the lift's own: the estimates
   !> against the sums of the closed responses to harmonics of load and lift. Points every 0.5 degrees take one harmonic for another
   !> and miss the peaks of the load.
   subroutine test_noisy_table(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: half = 350, rows = 2*half + 1, points = 14400, harmonics = 2400
      type(case_t) :: the_case
      type(model_t) :: model
      type(position_t) :: position
      type(moments_t) :: moments
      type(outlook_t) :: outlook
      ! Gas force [N], lift and derivatives [m/rad^n], angles of the rows [rad], lifts there [m]
      real(wp) :: force, lift(0:3), angles(rows), lifts(rows)
      ! Load of the rigid train [N], second derivative of its lift over time [m/s^2], both at even angles; their responses [N], [m]
      real(wp), dimension(points) :: load, curvature, loads, modes
      ! Load factor of points every 0.5 degrees [-]
      real(wp) :: coarse
      integer :: i, status

      the_case = thesis_case()
      call set_point(the_case, 50.0_wp*pi, 0.01_wp)
      call add_dynamics(the_case, 1, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      do i = 1, rows
         angles(i) = 0.2_wp*degree*(i - 1 - half)
         call evaluate_lift(model%lift_law, angles(i), lift)
         lifts(i) = lift(0)*(1.0_wp + 0.03e-6_wp*sin(1.7_wp*i**2)/(lift(0) + 1.0e-6_wp))
      end do
      lifts([1, rows]) = 0.0_wp
      the_case%lift = lift_t(law="table", table_angle=angles, table_lift=lifts)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call find_outlook(model, outlook)
      do i = 1, points
         call evaluate_loading(model, two_pi*real(i - 1, wp)/points - pi, position, force, moments, status)
         load(i) = moments%total/position%normal_arm
         curvature(i) = model%speed**2*position%lift_curvature
      end do
      associate (pulse => outlook%frequencies(1), spring => model%flexible%modes)
         call respond(pulse**2*load, pulse, outlook%damping_ratio, loads)
         call respond(2.0_wp*spring%share(1)*curvature, spring%frequency(1), spring%damping_ratio, modes)
         call check_close(error, outlook%load_factor, maxval(loads)/maxval(load), 1.0e-2_wp, "load factor")
         if (allocated(error)) return
         coarse = largest_response(pulse**2*load(::points/720), pulse, outlook%damping_ratio, two_pi/(720*model%speed), &
            & is_either_side=.false.)/maxval(load(::points/720))
         call check(error, abs(coarse - outlook%load_factor) > 5.0e-2_wp, "the noise asks for no more than 720 points")
         if (allocated(error)) return
         call check_close(error, outlook%surge(1), spring%stiffness*pi*maxval(abs(modes)), 1.0e-2_wp, "surge")
      end associate

   contains

      !> Periodic motion of an oscillator, harmonic by harmonic.
      subroutine respond(driving, pulse, damping_ratio, motion)
         !> What drives it [any/s^2]; its frequency [rad/s], damping ratio [-]
         real(wp), intent(in) :: driving(:), pulse, damping_ratio
         !> Its displacement [any]
         real(wp), intent(out) :: motion(:)
         ! exp(i phi) [-]; harmonic of the motion [any]
         complex(wp) :: turn(0:points - 1), harmonic
         integer :: h, k

         turn = [(exp(cmplx(0.0_wp, two_pi*real(k, wp)/points, wp)), k=0, points - 1)]
         motion = sum(driving)/points/pulse**2
         do h = 1, harmonics
            harmonic = 2.0_wp*sum([(driving(k + 1)*conjg(turn(modulo(h*k, points))), k=0, points - 1)])/points
            associate (drive => h*model%speed)
               harmonic = harmonic/cmplx(pulse**2 - drive**2, 2.0_wp*damping_ratio*pulse*drive, wp)
            end associate
            motion = motion + [(real(harmonic*turn(modulo(h*k, points)), wp), k=0, points - 1)]
         end do
      end subroutine respond

   end subroutine test_noisy_table

   !> The contact of a crowned roller is as stiff as that of a flat one with its effective length under the spring's load at full
   !> lift, in a flexible train and in the estimate for a rigid one.
   subroutine test_crowned(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model
      type(position_t) :: position
      type(line_lengths_t) :: lengths, slopes(2)
      type(outlook_t) :: crowned, flat, full
      ! Load at full lift without speed [N]
      real(wp) :: load
      integer :: trial, status

      do trial = 1, 2
         the_case = thesis_case()
         if (trial == 1) call add_dynamics(the_case, 5, .false.)
         call make_model(the_case, model, error)
         if (allocated(error)) return
         call find_outlook(model, full)
         the_case%roller_profile = roller_profile_t(profile="crowned", crown_radius=0.3_wp)
         call make_model(the_case, model, error)
         if (allocated(error)) return
         call find_outlook(model, crowned)
         call evaluate_geometry(model, 0.0_wp, position, status)
         load = the_case%spring%stiffness*(position%lift + the_case%spring%precompression)*position%valve_arm/position%normal_arm
         call effective_lengths(model%axial, load, position%equivalent_radius, lengths, slopes(1), slopes(2))
         deallocate (the_case%roller_profile)
         the_case%mechanism%contact_width = lengths%mean
         call make_model(the_case, model, error)
         if (allocated(error)) return
         call find_outlook(model, flat)
         call check_close(error, crowned%frequencies(1), flat%frequencies(1), 1.0e-12_wp, "frequency")
         if (allocated(error)) return
         ! Far from all of the 13.7 mm carries
         call check(error, crowned%frequencies(1) < 0.92_wp*full%frequencies(1), "as stiff as all of its length")
         if (allocated(error)) return
      end do
   end subroutine test_crowned

   subroutine test_unknown(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model
      type(outlook_t) :: outlook

      the_case = thesis_case()
      the_case%masses%finger = 0.0_wp
      the_case%masses%finger_inertia = 2.0e-5_wp
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call find_outlook(model, outlook)
      call check(error, .not. outlook%is_known)
   end subroutine test_unknown

end module test_train_outlook
