!> Hours of running of a flexible train: what its turns do to places of the cam and to the roller.
module test_flexible_running_in
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_cam_surface, only : place_angle
   use camroller_case, only : case_t
   use camroller_cycle, only : cycle_t, integrate_cycle
   use camroller_error, only : error_t, kind_domain
   use camroller_flexible_follower, only : follower_on_path
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text
   use camroller_running_in, only : aged_t, run_in
   use camroller_state, only : state_t
   use camroller_tribofilm, only : running_in_t, thickness_after, tribofilm_t
   use camroller_wear, only : wear_t
   use deck_cases, only : get_deck_case
   use flexible_cases, only : add_dynamics, stiff_case
   use reference_cases, only : make_model, set_point, thesis_case
   use closeness, only : expect_error, has_failed
   use run_settings, only : has_checks
   implicit none
   private

   public :: collect_flexible_running_in

   integer, parameter :: places = 36

contains

   subroutine collect_flexible_running_in(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("places of the cam have what the contact does when it is there, in all turns of a period", test_places), &
         new_unittest("films and depths of a very stiff train are those of a rigid train", test_rigid_limit), &
         new_unittest("a train that does not repeat itself is not run in", test_aperiodic) &
         ]
   end subroutine collect_flexible_running_in

   !> Add hours with a film as rough and as slippery as the surfaces, and wear: every cycle is the first.
   subroutine add_hours(the_case)
      type(case_t), intent(inout) :: the_case

      the_case%operating_point%oil_temperature = 368.15_wp
      allocate (the_case%wear, the_case%tribofilm, the_case%running_in)
      the_case%wear = wear_t(1.0e-18_wp, 1.0e-18_wp)
      the_case%tribofilm = tribofilm_t(growth_rate=4.0e-2_wp, activation_energy=50.0e3_wp, activation_volume=0.1e-27_wp, &
         & removal_rate=2.0e-2_wp, largest_thickness=120.0e-9_wp, roughness_ratio=0.0_wp, &
         & coefficient=the_case%asperity%boundary_coefficient)
      the_case%running_in = running_in_t(duration=36000.0_wp, accuracy=1.0e-2_wp, places=places)
   end subroutine add_hours

   !> Angles so close that straight lines between them err by next to nothing, sorted by the place where the roller is then: at
   !> 900 rev/min, and where contacts open and two turns make a period; with run-time checks the second alone, which is all of the
   !> first for each turn.
   subroutine test_places(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: angles = 10000
      type(case_t) :: the_case
      type(model_t) :: model, fresh
      type(cycle_t) :: cycle
      type(aged_t) :: aged
      type(error_t), allocatable :: failure
      ! Place on the cam [rad], growth [m/s], decay [1/s] and wear [m/s] at each angle
      real(wp) :: passed(0:angles), rates(0:angles, 3)
      ! Growth, decay and wear at the places, and at the angles of the places
      real(wp) :: found(places, 3), straight(places, 3)
      ! Films and depths of the places [m]
      real(wp) :: films(places), depths(places)
      character(len=:), allocatable :: words
      integer :: number, turn, i, k

      do number = merge(2, 1, has_checks()), 2
         call get_deck_case("decks/tribofilm.nml", the_case, failure)
         if (has_failed(failure, error)) return
         deallocate (the_case%wear, the_case%tribofilm, the_case%running_in)
         the_case%operating_point%speed = merge(900.0_wp, 3140.0_wp, number == 1)*pi/30.0_wp
         call add_dynamics(the_case, merge(5, 2, number == 1), .false.)
         call add_hours(the_case)
         the_case%numerics%tolerance = merge(1.0e-4_wp, 1.0e-5_wp, number == 1)
         call make_model(the_case, model, error)
         if (allocated(error)) return
         fresh = model
         call run_in(the_case, model, aged, failure)
         if (.not. allocated(failure)) call integrate_cycle(cycle, fresh, the_case%numerics, failure)
         if (has_failed(failure, error)) return
         call check(error, cycle%flexible%cycle%period, number, "turns of a period")
         if (allocated(error)) return
         found = 0.0_wp
         straight = 0.0_wp
         do turn = 1, number
            call scan(the_case, fresh, cycle, turn, passed, rates, error)
            if (allocated(error)) return
            do i = 1, 3
               found(:, i) = found(:, i) + at_places(passed, rates(:, i))/number
               straight(:, i) = straight(:, i) + rates([(nint(real(angles, wp)*(k - 1)/places), k=1, places)], i)/number
            end do
         end do
         films = thickness_after(spread(0.0_wp, 1, places), found(:, 1), found(:, 2), the_case%running_in%duration)
         depths = found(:, 3)*the_case%running_in%duration
         words = number_text(maxval(abs(model%surface%cam_film - films))/maxval(films), 3)//", "// &
            & number_text(maxval(abs(model%surface%cam_wear - depths))/maxval(depths), 3)
         ! Tolerances of 1e-4, which make 7e-4, and of 1e-5, of which large loads of contacts that open make 4e-4
         call check(error, all(abs(model%surface%cam_film - films) < 1.0e-3_wp*maxval(films)) .and. &
            & all(abs(model%surface%cam_wear - depths) < 1.0e-3_wp*maxval(depths)), words)
         if (allocated(error)) return
         call check(error, any(abs(straight(:, 3) - found(:, 3)) > 4.0e-3_wp*maxval(found(:, 3))), "places are angles")
         if (allocated(error)) return
      end do
   end subroutine test_places

   !> What the contact does along a turn, to the place where it is.
   subroutine scan(the_case, model, cycle, turn, passed, rates, error)
      type(case_t), intent(in) :: the_case
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      integer, intent(in) :: turn
      ! [rad]; [m/s], [1/s], [m/s]
      real(wp), intent(out) :: passed(0:), rates(0:, :)
      type(error_type), allocatable, intent(out) :: error
      type(state_t) :: state
      type(error_t), allocatable :: failure
      real(wp) :: part, growth ! [-], [m/s]
      integer :: i, hint

      hint = 1
      do i = 0, ubound(passed, 1)
         call follower_on_path(model, cycle%flexible%turns(turn), cycle%flexible%cycle%resolution, &
            & -pi + min(two_pi*i/ubound(passed, 1), two_pi*(1.0_wp - epsilon(1.0_wp))), hint, state, failure)
         if (has_failed(failure, error)) return
         passed(i) = -pi + two_pi*i/ubound(passed, 1) + state%flexible%contact_turn
         rates(i, :) = 0.0_wp
         associate (contact => state%contact, film_law => the_case%tribofilm)
            if (.not. contact%is_touching) cycle
            part = 2.0_wp*contact%half_width/contact%cam_surface_speed/(two_pi/model%speed)
            growth = film_law%growth_rate*exp(-(film_law%activation_energy - 6.02214076e23_wp*film_law%activation_volume &
               & *abs(contact%traction)/contact%apparent_area)/(8.31446261815324_wp*(368.15_wp + contact%flash_rise)))
            rates(i, :) = part*[growth, growth/film_law%largest_thickness + film_law%removal_rate, the_case%wear%cam_rate &
               & *contact%asperity_load/contact%apparent_area*abs(contact%sliding_speed)]
         end associate
      end do
   end subroutine scan

   !> Values at the places, along straight lines.
   function at_places(passed, values) result(there)
      ! [rad]; [any]
      real(wp), intent(in) :: passed(0:), values(0:)
      real(wp) :: there(places) ! [any]
      real(wp) :: angle ! [rad]
      integer :: i, k

      do i = 1, places
         angle = place_angle(i, places)
         if (angle < passed(0)) angle = angle + two_pi
         k = findloc(passed > angle, .true., 1) - 2
         there(i) = values(k) + (angle - passed(k))/(passed(k + 1) - passed(k))*(values(k + 1) - values(k))
      end do
   end function at_places

   subroutine test_rigid_limit(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: flexible, rigid
      type(model_t) :: models(2)
      type(aged_t) :: aged(2)
      type(error_t), allocatable :: failure
      ! Differences of mean film, mean depth and depth of the roller, over the rigid train's [-], stiffness over the usual [-]
      real(wp) :: differences(3, 2), factor
      integer :: i

      do i = 1, 2
         factor = 16.0_wp**(i - 1)
         flexible = stiff_case(factor, 0)
         call add_hours(flexible)
         flexible%numerics%tolerance = 1.0e-5_wp
         rigid = flexible
         deallocate (rigid%dynamics)
         call make_model(flexible, models(1), error)
         if (.not. allocated(error)) call make_model(rigid, models(2), error)
         if (allocated(error)) return
         call run_in(flexible, models(1), aged(1), failure)
         if (.not. allocated(failure)) call run_in(rigid, models(2), aged(2), failure)
         if (has_failed(failure, error)) return
         associate (one => models(1)%surface, other => models(2)%surface)
            differences(:, i) = [sum(one%cam_film)/sum(other%cam_film), sum(one%cam_wear)/sum(other%cam_wear), &
               & one%roller_wear/other%roller_wear] - 1.0_wp
         end associate
      end do
      ! They go with one over the stiffness, to a sixteenth; by how much depends on what vibrates at each place
      call check(error, all(abs(differences(:, 1)) > 3.0e-4_wp), "no difference")
      if (allocated(error)) return
      call check(error, all(abs(differences(2:, 2)) < 0.125_wp*abs(differences(2:, 1))), "depths")
      if (allocated(error)) return
      call check(error, abs(differences(1, 2)) < 1.0e-4_wp, "film")
   end subroutine test_rigid_limit

   subroutine test_aperiodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model
      type(aged_t) :: aged
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      call set_point(the_case, 3300.0_wp*pi/30.0_wp, 0.01_wp)
      call add_dynamics(the_case, 2, .false.)
      call add_hours(the_case)
      the_case%numerics%tolerance = 1.0e-4_wp
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call run_in(the_case, model, aged, failure)
      call expect_error(error, failure, kind_domain, "repeats itself")
   end subroutine test_aperiodic

end module test_flexible_running_in
