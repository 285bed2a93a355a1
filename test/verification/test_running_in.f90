!> Hours of running: growth of films and wear of surfaces, and what they make of the cycle.
module test_running_in
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_cam_surface, only : place_angle, value_at_angle
   use camroller_case, only : case_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_error, only : error_t, kind_deck, kind_domain
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_model, only : model_t
   use camroller_result, only : find_quantity, get_series, get_summary, result_t
   use camroller_run, only : run_case
   use camroller_running_in, only : aged_t, run_in
   use camroller_state, only : state_t
   use camroller_tribofilm, only : running_in_t, thickness_after, tribofilm_t
   use camroller_wear, only : wear_t
   use case_twins, only : compare_twins, leave_constants_out, rescale_case
   use reference_cases, only : add_heat, make_cycle, make_model, set_point, thesis_case, point_speeds, point_viscosities
   use unit_systems, only : unit_systems_tried
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_running_in

contains

   subroutine collect_running_in(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("films and depths without feedback are those of the first cycle, in closed form", test_no_feedback), &
         new_unittest("the volume that cam and roller lose for the same rate is the same", test_volume), &
         new_unittest("the stated error covers that of the steps, which are of second order", test_convergence), &
         new_unittest("a film that is complete within seconds of ten hours has its stated error, by few cycles", test_fast_film), &
         new_unittest("surfaces that change within a turn, and accuracies that are none, are errors", test_refused), &
         new_unittest("wear that falls to a part of what was foreseen is as accurate as asked", test_falling_wear), &
         new_unittest("the stated error covers what the error of the slip does to films and depths", test_slip_error), &
         new_unittest("films and depths between the places are those of more places, within what is stated", test_between), &
         new_unittest("hours in which nothing changes change no bit", test_nothing), &
         new_unittest("a film that grows changes the cycle, whose energy closes", test_feedback), &
         new_unittest("wear that is next to nothing has no part in estimates of errors", test_no_wear), &
         new_unittest("results are the same in other units", test_units) &
         ]
   end subroutine collect_running_in

   !> A hot case with a film that saturates within the hours, and wear
   function running_case() result(case)
      type(case_t) :: case

      case = thesis_case()
      call set_point(case, 300.0_wp*pi/30.0_wp, 0.006_wp)
      case%operating_point%oil_temperature = 368.15_wp
      case%numerics%tolerance = 1.0e-4_wp
      allocate (case%wear, case%tribofilm, case%running_in)
      case%wear = wear_t(1.0e-18_wp, 1.0e-18_wp)
      case%tribofilm = tribofilm_t(growth_rate=4.0e-2_wp, activation_energy=50.0e3_wp, activation_volume=0.1e-27_wp, &
         & removal_rate=2.0e-2_wp, largest_thickness=120.0e-9_wp, roughness_ratio=2.0_wp, coefficient=0.06_wp)
      case%running_in = running_in_t(duration=10.0_wp*3600.0_wp, accuracy=1.0e-2_wp, places=36)
   end function running_case

   !> A film as rough and as slippery as the surfaces: every cycle is the first
   subroutine test_no_feedback(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model, bare
      type(cycle_t) :: cycle
      type(aged_t) :: aged
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Part of the time, growth in contact [m/s], decay [1/s], thickness and depth [m]; sums for the roller
      real(wp) :: part, growth, film, depth, sums(3)
      integer :: i, hint

      case = running_case()
      call add_heat(case)
      case%tribofilm%roughness_ratio = 0.0_wp
      case%tribofilm%coefficient = case%asperity%boundary_coefficient
      call make_model(case, model, error)
      if (allocated(error)) return
      bare = model
      call run_in(case, model, aged, failure)
      if (has_failed(failure, error)) return
      call make_cycle(case, bare, cycle, error)
      if (allocated(error)) return
      hint = 1
      sums = 0.0_wp
      do i = 1, 36
         call state_at(cycle, bare, (10*i - 190)*degree, hint, state, failure)
         associate (contact => state%contact, film_law => case%tribofilm)
            part = 2.0_wp*contact%half_width/contact%cam_surface_speed/(two_pi/model%speed)
            growth = film_law%growth_rate*exp(-(film_law%activation_energy - 6.02214076e23_wp*film_law%activation_volume &
               & *abs(contact%traction)/contact%apparent_area)/(8.31446261815324_wp*(368.15_wp + contact%flash_rise)))
            film = thickness_after(0.0_wp, part*growth, part*(growth/film_law%largest_thickness + film_law%removal_rate), &
               & case%running_in%duration)
            depth = case%wear%cam_rate*contact%asperity_load/contact%length*abs(contact%sliding_speed)/contact%cam_surface_speed &
               & *case%running_in%duration*model%speed/two_pi
            ! round-off, and that of the cycle, whose stored energies are larger than its losses
            call check(error, abs(model%surface%cam_film(i) - film) < 1.0e-9_wp*film, "film")
            if (allocated(error)) return
            call check(error, abs(model%surface%cam_wear(i) - depth) < 1.0e-9_wp*depth + 1.0e-30_wp, "depth")
            if (allocated(error)) return
            part = 2.0_wp*contact%half_width/(two_pi*model%roller_radius)/36.0_wp
            sums = sums + part*[growth, film_law%removal_rate, case%wear%roller_rate*contact%asperity_load/contact%apparent_area &
               & *abs(contact%sliding_speed)]
         end associate
      end do
      film = thickness_after(0.0_wp, sums(1), sums(1)/case%tribofilm%largest_thickness + sums(2), case%running_in%duration)
      call check(error, abs(model%surface%roller_film - film) < 1.0e-9_wp*film .and. film > 1.0e-9_wp, "film of the roller")
      if (allocated(error)) return
      depth = sums(3)*case%running_in%duration
      call check(error, abs(model%surface%roller_wear - depth) < 1.0e-9_wp*depth .and. depth > 0.0_wp, "depth of the roller")
   end subroutine test_no_feedback

   !> Depth times length of the surface, cam and roller
   subroutine test_volume(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(aged_t) :: aged
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Area of the section that is worn away [m^2]
      real(wp) :: volume
      integer :: i, hint

      case = running_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      call run_in(case, model, aged, failure)
      if (has_failed(failure, error)) return
      call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      volume = 0.0_wp
      hint = 1
      do i = 1, 36
         call state_at(cycle, model, place_angle(i, 36), hint, state, failure)
         volume = volume + model%surface%cam_wear(i)*state%contact%cam_surface_speed/model%speed*two_pi/36.0_wp
      end do
      ! surface speeds do not depend on the friction: round-off of 36 terms
      call check(error, abs(volume/(two_pi*model%roller_radius*model%surface%roller_wear) - 1.0_wp) < 1.0e-11_wp)
   end subroutine test_volume

   subroutine test_convergence(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model, fine
      type(aged_t) :: aged, finest
      type(error_t), allocatable :: failure
      ! Error, by the measure of the estimate [-]
      real(wp) :: found
      integer :: k, steps(2)

      case = running_case()
      ! cycles whose own errors are below those of the steps
      case%numerics%tolerance = 3.0e-5_wp
      case%running_in%accuracy = 1.5e-3_wp
      call make_model(case, fine, error)
      if (allocated(error)) return
      call run_in(case, fine, finest, failure)
      if (has_failed(failure, error)) return
      do k = 1, 2
         case%running_in%accuracy = merge(3.0e-2_wp, 3.0e-3_wp, k == 1)
         call make_model(case, model, error)
         if (allocated(error)) return
         call run_in(case, model, aged, failure)
         if (has_failed(failure, error)) return
         found = largest_difference(case, model, fine)
         call check(error, found <= aged%error + finest%error .and. found > 0.0_wp, "the error is larger than stated")
         if (allocated(error)) return
         call check(error, aged%error <= case%running_in%accuracy, "more than allowed is stated")
         if (allocated(error)) return
         steps(k) = aged%steps
      end do
      ! a tenth of the error by sqrt(10) times as many steps, or fewer where the first ones have little
      call check(error, steps(2) > steps(1) .and. steps(2) < 5*steps(1), "order")
   end subroutine test_convergence

   !> A film ten thousand times as fast as that of `running_case`
   subroutine test_fast_film(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(aged_t) :: aged

      case = running_case()
      case%numerics%tolerance = 3.0e-5_wp
      case%tribofilm%growth_rate = 1.0e4_wp*case%tribofilm%growth_rate
      case%tribofilm%removal_rate = 1.0e4_wp*case%tribofilm%removal_rate
      call compare_with_finer(case, 1.0e-3_wp, aged, error)
      if (allocated(error)) return
      ! as many steps for the first seconds as for the hours of a slow film, each of four cycles
      call check(error, aged%solved%count < 150, "cycles")
   end subroutine test_fast_film

   subroutine test_refused(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(aged_t) :: aged
      type(error_t), allocatable :: failure
      ! Growth over that of `running_case`, accuracy [-]
      real(wp), parameter :: faster(2) = [1.0e8_wp, 1.0_wp], accuracies(2) = [1.0e-3_wp, 0.0_wp]
      integer, parameter :: kinds(2) = [kind_domain, kind_deck]
      integer :: i

      do i = 1, size(kinds)
         case = running_case()
         case%tribofilm%growth_rate = faster(i)*case%tribofilm%growth_rate
         case%tribofilm%removal_rate = faster(i)*case%tribofilm%removal_rate
         case%running_in%accuracy = accuracies(i)
         case%running_in%duration = 60.0_wp
         call make_model(case, model, error)
         if (allocated(error)) return
         call run_in(case, model, aged, failure)
         call check(error, allocated(failure), "no error")
         if (allocated(error)) return
         call check(error, failure%kind == kinds(i), failure%message)
         if (allocated(error)) return
      end do
   end subroutine test_refused

   !> The roller slips until the film's friction drives it, which leaves a part of the wear of bare surfaces
   subroutine test_falling_wear(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(aged_t) :: aged
      ! The second one is used up within half a thousandth where less is worn than was foreseen [-]
      real(wp), parameter :: accuracies(2) = [1.0e-2_wp, 1.0e-2_wp*(1.0_wp - 52*0.004_wp)]
      integer :: i

      do i = 1, 2
         case = running_case()
         call set_point(case, 600.0_wp*pi/30.0_wp, 0.01_wp)
         case%numerics%tolerance = 1.0e-4_wp
         case%tribofilm%growth_rate = 20.0_wp*case%tribofilm%growth_rate
         case%tribofilm%roughness_ratio = 0.0_wp
         case%needle_bearing%friction_coefficient = 0.01_wp
         case%asperity%boundary_coefficient = 0.02_wp
         case%tribofilm%coefficient = 0.3_wp
         call compare_with_finer(case, accuracies(i), aged, error)
         if (allocated(error)) return
      end do
   end subroutine test_falling_wear

   !> Run in, and compare with a tenth of the error.
   subroutine compare_with_finer(case, accuracy, aged, error)
      type(case_t), intent(inout) :: case
      !> Accuracy asked for [-]
      real(wp), intent(in) :: accuracy
      type(aged_t), intent(out) :: aged
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model, fine
      type(aged_t) :: finest
      type(error_t), allocatable :: failure
      ! Error, by the measure of the estimate [-]
      real(wp) :: found
      character(len=80) :: words

      case%running_in%accuracy = 0.1_wp*accuracy
      call make_model(case, fine, error)
      if (allocated(error)) return
      call run_in(case, fine, finest, failure)
      case%running_in%accuracy = accuracy
      call make_model(case, model, error)
      if (allocated(error)) return
      if (.not. allocated(failure)) call run_in(case, model, aged, failure)
      if (has_failed(failure, error)) return
      found = largest_difference(case, model, fine)
      write (words, "(a, es10.2, a, es10.2, a, i0)") "error", found, ", stated", aged%error, ", cycles ", aged%solved%count
      call check(error, found <= aged%error + finest%error .and. found > 1.0e-3_wp*aged%error, trim(words))
      if (allocated(error)) return
      call check(error, aged%error <= accuracy, trim(words))
   end subroutine compare_with_finer

   !> A film as rough and as slippery as the surfaces: steps over the hours have no error
   subroutine test_slip_error(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model, fine
      type(aged_t) :: aged, finest
      type(error_t), allocatable :: failure
      ! Error, by the measure of the estimate [-]
      real(wp) :: found
      character(len=60) :: words
      integer :: power

      case = running_case()
      call add_heat(case)
      case%tribofilm%roughness_ratio = 0.0_wp
      case%tribofilm%coefficient = case%asperity%boundary_coefficient
      case%numerics%tolerance = 1.0e-7_wp
      call make_model(case, fine, error)
      if (allocated(error)) return
      call run_in(case, fine, finest, failure)
      do power = 2, 5
         case%numerics%tolerance = 10.0_wp**(-power)
         call make_model(case, model, error)
         if (allocated(error)) return
         if (.not. allocated(failure)) call run_in(case, model, aged, failure)
         if (has_failed(failure, error)) return
         found = largest_difference(case, model, fine)
         write (words, "(i2, 2es11.3)") power, found, aged%error
         call check(error, found <= aged%error + finest%error .and. found > 1.0e-3_wp*aged%error, words)
         if (allocated(error)) return
      end do
   end subroutine test_slip_error

   !> Largest difference of films, over the largest possible thickness, and of depths, over the largest of the cam and that of the
   !> roller.
   function largest_difference(case, one, other) result(largest)
      type(case_t), intent(in) :: case
      type(model_t), intent(in) :: one, other
      ! [-]
      real(wp) :: largest

      largest = max(maxval(abs(one%surface%cam_film - other%surface%cam_film))/case%tribofilm%largest_thickness, &
         & abs(one%surface%roller_film - other%surface%roller_film)/case%tribofilm%largest_thickness, &
         & maxval(abs(one%surface%cam_wear - other%surface%cam_wear))/maxval(other%surface%cam_wear), &
         & abs(one%surface%roller_wear/other%surface%roller_wear - 1.0_wp))
   end function largest_difference

   !> With feedback and without
   subroutine test_between(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: numbers(3) = [24, 37, 180]
      type(case_t) :: case
      type(model_t) :: model, fine
      type(aged_t) :: aged, finer
      type(error_t), allocatable :: failure
      ! Difference, by the measure of the estimate [-]; value and slope with the places and with eight times as many [m], [m/rad]
      real(wp) :: found, value, slope, other
      character(len=60) :: words
      integer :: i, k, feedback

      do feedback = 0, 1
         do k = 1, size(numbers)
            case = running_case()
            case%running_in%places = numbers(k)
            if (feedback == 0) case%tribofilm%roughness_ratio = 0.0_wp
            if (feedback == 0) case%tribofilm%coefficient = case%asperity%boundary_coefficient
            call make_model(case, model, error)
            if (allocated(error)) return
            fine = model
            call run_in(case, model, aged, failure)
            case%running_in%places = 8*numbers(k)
            if (.not. allocated(failure)) call run_in(case, fine, finer, failure)
            if (has_failed(failure, error)) return
            found = 0.0_wp
            do i = 1, 3600
               call value_at_angle(model%surface%film_curve, 0.1_wp*i*degree, value, slope)
               call value_at_angle(fine%surface%film_curve, 0.1_wp*i*degree, other, slope)
               found = max(found, abs(value - other)/case%tribofilm%largest_thickness)
               call value_at_angle(model%surface%wear_curve, 0.1_wp*i*degree, value, slope)
               call value_at_angle(fine%surface%wear_curve, 0.1_wp*i*degree, other, slope)
               found = max(found, abs(value - other)/maxval(fine%surface%cam_wear))
            end do
            write (words, "(i4, 3es11.3)") numbers(k), found, aged%between, finer%between
            call check(error, found <= aged%between + finer%between + aged%error + finer%error .and. found > 0.1_wp*aged%between, &
               & words)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_between

   subroutine test_nothing(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, plain
      type(result_t) :: with, without
      type(error_t), allocatable :: failure
      integer :: i

      case = running_case()
      case%tribofilm%growth_rate = 0.0_wp
      case%wear = wear_t(0.0_wp, 0.0_wp)
      ! the coefficient of a film takes part in a scale of the integration
      case%tribofilm%coefficient = case%asperity%boundary_coefficient
      plain = case
      deallocate (plain%wear, plain%tribofilm, plain%running_in)
      call run_case(case, with, failure)
      if (.not. allocated(failure)) call run_case(plain, without, failure)
      if (has_failed(failure, error)) return
      do i = 1, size(without%series)
         call check(error, all(abs(with%series_values(:, find_quantity(with%series, without%series(i)%name)) &
            & - without%series_values(:, i)) <= 0.0_wp), "another bit in "//without%series(i)%name)
         if (allocated(error)) return
      end do
      call check(error, .not. allocated(without%history), "a history without hours")
   end subroutine test_nothing

   subroutine test_feedback(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Series
      real(wp), allocatable :: film(:), roughness(:), residual(:), coefficient(:)
      ! Losses [W]; scalars [any]
      real(wp) :: power, roller, error_stated
      integer :: i

      case = running_case()
      call run_case(case, result, failure)
      if (.not. allocated(failure)) call get_series(result, "cam_film_thickness", film, failure)
      if (.not. allocated(failure)) call get_series(result, "composite_roughness", roughness, failure)
      if (.not. allocated(failure)) call get_series(result, "energy_residual", residual, failure)
      if (.not. allocated(failure)) call get_series(result, "boundary_coefficient", coefficient, failure)
      if (.not. allocated(failure)) call get_summary(result, "power_friction", power, failure)
      if (.not. allocated(failure)) call get_summary(result, "roller_film_thickness", roller, failure)
      if (.not. allocated(failure)) call get_summary(result, "estimated_error_of_running_in", error_stated, failure)
      if (has_failed(failure, error)) return
      call check(error, maxval(film) > 20.0e-9_wp .and. maxval(film) < 120.0e-9_wp, "film")
      if (allocated(error)) return
      associate (bare => hypot(case%surface%cam_roughness, case%surface%roller_roughness))
         call check(error, all(abs(roughness - sqrt(bare**2 + 4.0_wp*(film**2 + roller**2))) < 1.0e-12_wp*bare), "roughness")
         if (allocated(error)) return
      end associate
      associate (covered => 0.5_wp*(film + roller)/120.0e-9_wp, bare => case%asperity%boundary_coefficient)
         call check(error, all(abs(coefficient - bare - covered*(0.06_wp - bare)) < 1.0e-12_wp), "coefficient")
         if (allocated(error)) return
      end associate
      ! round-off of stored powers up to 1e3 times larger, as elsewhere
      call check(error, maxval(abs(residual)) < 1.0e-10_wp*power, "energy residual")
      if (allocated(error)) return
      call check(error, error_stated > 0.0_wp .and. error_stated <= 1.0e-2_wp, "stated error")
      if (allocated(error)) return
      i = find_quantity(result%history, "roller_film")
      call check(error, abs(result%history_values(41, i) - roller) < 1.0e-12_wp*roller .and. abs(result%history_values(1, i)) <= &
         & 0.0_wp .and. all(result%history_values(2:, i) > result%history_values(:40, i)), "history of a film that grows")
      if (allocated(error)) return
      i = find_quantity(result%history, "mean_boundary_coefficient")
      call check(error, all(result%history_values(:, i) > 0.06_wp) .and. all(result%history_values(2:, i) &
         & < result%history_values(:40, i)), "history of the coefficient")
   end subroutine test_feedback

   subroutine test_no_wear(error)
      type(error_type), allocatable, intent(out) :: error
      ! Specific wear rates: usual, so small that a turn wears 1e-40 m, none [m^2/N]
      real(wp), parameter :: rates(3) = [1.0e-18_wp, 1.0e-45_wp, 0.0_wp]
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      real(wp) :: estimates(size(rates)) ! [-]
      integer :: i

      do i = 1, size(rates)
         case = thesis_case()
         call set_point(case, point_speeds(1), point_viscosities(2))
         case%numerics%method = "rodas5p"
         case%numerics%tolerance = 1.0e-3_wp
         case%wear = wear_t(rates(i), rates(i))
         call run_case(case, result, failure)
         if (.not. allocated(failure)) call get_summary(result, "estimated_error_of_extremes", estimates(i), failure)
         if (has_failed(failure, error)) return
      end do
      ! Wear of 1e-40 m is 1e-20 of what counts as none; the usual wear has the largest error here
      call check(error, abs(estimates(2) - estimates(3)) <= 1.0e-12_wp*estimates(3), "wear that is none counts")
      if (allocated(error)) return
      call check(error, estimates(1) > 2.0_wp*estimates(3), "usual wear does not count")
   end subroutine test_no_wear

   subroutine test_units(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, other
      type(result_t) :: one, twin
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: trouble

      case = running_case()
      case%tribofilm%activation_volume = 0.0_wp
      case%running_in%accuracy = 5.0e-2_wp
      call leave_constants_out(case)
      call run_case(case, one, failure)
      ! all units changed together: each run takes many cycles
      associate (units => unit_systems_tried(size(unit_systems_tried)))
         other = case
         call rescale_case(other, units)
         if (.not. allocated(failure)) call run_case(other, twin, failure)
         if (has_failed(failure, error)) return
         trouble = compare_twins(one, twin, units, 1.0e-9_wp)
         call check(error, trouble == "", trouble)
      end associate
   end subroutine test_units

end module test_running_in
