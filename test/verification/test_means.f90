!> Means over the cycle: those of the curve, with an estimate that bounds their errors; work of what is stored; extremes and
!> standstills of the curve and not of the points.
module test_means
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_dynamics, only : stored_energy
   use camroller_error, only : error_t
   use camroller_case, only : case_t, numerics_t
   use camroller_catalogue, only : list_series
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_means, only : statistics_t, integrate_lobe, integrate_torques, mean_sizes
   use camroller_model, only : model_t
   use camroller_panels, only : panels_t, panel_points, start_panels, add_panel
   use camroller_remarks, only : missed_means, remark_lines
   use camroller_result, only : result_t, quantity_t, get_summary
   use camroller_run, only : build_models, run_case
   use camroller_simulation, only : simulation_t, outcome_t, start_simulation, advance
   use camroller_state, only : state_t
   use camroller_torque_list, only : torque_count, is_torque, of_geometric, of_contact, of_needle, of_guide, of_roller_inertia
   use deck_cases, only : get_deck_case
   use random_decks, only : random_t, start_random, random_deck
   use reference_cases, only : thesis_case, source_case, set_point, point_viscosities
   use run_settings, only : has_checks
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_means

   !> Torques that are losses: contact, roller bearing, guide
   integer, parameter :: losses(3) = [of_contact, of_needle, of_guide]
   !> Rule of three points of Gauss on [0, 1] [-]
   real(wp), parameter :: nodes(3) = 0.5_wp*[1.0_wp - sqrt(0.6_wp), 1.0_wp, 1.0_wp + sqrt(0.6_wp)]
   real(wp), parameter :: weights(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

contains

   subroutine collect_means(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("mean torques agree with integrals of the solution within the tolerance of the cycle", test_curve), &
         new_unittest("the estimated error of means bounds the error", test_estimate), &
         new_unittest("without gas and loss of contact the mean of the geometric torque is zero", test_closed), &
         new_unittest("means account for the energy stored at loss and return of contact", test_lost), &
         new_unittest("contact that is lost where the roller's spin has it is accounted for as well", test_free_loss), &
         new_unittest("drive work of a host's step equals losses, stored energy and kinetic energy of the roller", test_step), &
         new_unittest("mean losses are within the accuracy asked for", test_accuracy), &
         new_unittest("a remark names the means whose accuracy is not reached", test_remark), &
         new_unittest("errors of a mean are relative to what counts as none at least", test_least), &
         new_unittest("the smallest film at zero entrainment does not depend on the accuracy", test_standstill), &
         new_unittest("extremes agree with a fine scan of the solution for every output step", test_extremes) &
         ]
   end subroutine collect_means

   !> Cases whose integrands are hard: the bookkeeping of the source, whose contact torque changes its sign; a few rows of cylinder
   !> pressure that take the contact away and give it back; a roller that is stuck.
   subroutine hard_case(number, the_case, error)
      integer, intent(in) :: number
      type(case_t), intent(out) :: the_case
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure

      select case (number)
      case (1, 2)
         call get_deck_case("decks/thesis_source.nml", the_case, failure, number=6 + number)
      case (3)
         the_case = gas_case()
      case (4)
         call get_deck_case("decks/hard/stuck_roller.nml", the_case, failure)
      case default
         the_case = thesis_case()
         call set_point(the_case, 94.0_wp, point_viscosities(1))
      end select
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(the_case%cam_bearings)) deallocate (the_case%cam_bearings)
      the_case%numerics = numerics_t()
   end subroutine hard_case

   !> At 4000 rev/min contact is lost beside the nose; the gas presses before it.
   function gas_case() result(the_case)
      type(case_t) :: the_case

      the_case = thesis_case()
      the_case%numerics = numerics_t()
      call set_point(the_case, 420.0_wp, point_viscosities(3))
      allocate (the_case%gas_force)
      the_case%gas_force%angle = [-180.0_wp, -140.0_wp, -100.0_wp, -60.0_wp, -20.0_wp, 20.0_wp, 60.0_wp, 100.0_wp, 140.0_wp, &
         & 180.0_wp]*degree
      the_case%gas_force%pressure = [0.0_wp, 0.0_wp, 0.0_wp, 4.0e5_wp, 6.0e5_wp, -0.3e5_wp, 1.0e5_wp, 2.0e6_wp, 0.0_wp, 0.0_wp]
      the_case%gas_force%valve_area = 6.0e-4_wp
   end function gas_case

   !> Cycle and means of a case without camshaft bearings.
   subroutine take_statistics(the_case, models, cycle, statistics, error)
      type(case_t), intent(in) :: the_case
      type(model_t), allocatable, intent(out) :: models(:)
      type(cycle_t), intent(out) :: cycle
      type(statistics_t), intent(out) :: statistics
      type(error_type), allocatable, intent(out) :: error
      type(quantity_t), allocatable :: series(:)
      type(error_t), allocatable :: failure

      call list_series(the_case, series)
      call build_models(the_case, models, failure)
      if (.not. allocated(failure)) call integrate_cycle(cycle, models(1), the_case%numerics, failure)
      if (.not. allocated(failure)) call integrate_lobe(the_case, series, models(1), cycle, statistics, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine take_statistics

   !> Means of torques and of their sizes by many panels in each interval.
   subroutine brute_force(model, cycle, parts, torques, sizes, error, lost_share)
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      !> Panels in an interval
      integer, intent(in) :: parts
      !> [N m]
      real(wp), intent(out) :: torques(torque_count), sizes(torque_count)
      type(error_type), allocatable, intent(out) :: error
      !> Part of the cycle without contact [-]
      real(wp), intent(out), optional :: lost_share
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Length of a panel, of the cycle [rad]
      real(wp) :: length, span
      integer :: interval, part, node, hint

      torques = 0.0_wp
      sizes = 0.0_wp
      if (present(lost_share)) lost_share = 0.0_wp
      hint = 1
      associate (times => cycle%trajectory%time(:cycle%trajectory%count))
         span = times(size(times)) - times(1)
         do interval = 1, size(times) - 1
            length = (times(interval + 1) - times(interval))/parts
            if (.not. length > 0.0_wp) cycle
            do part = 0, parts - 1
               do node = 1, size(nodes)
                  call state_at(cycle, model, times(interval) + (part + nodes(node))*length, hint, state, failure)
                  if (has_failed(failure, error)) return
                  torques = torques + weights(node)*length/span*state%torques
                  sizes = sizes + weights(node)*length/span*abs(state%torques)
                  if (present(lost_share) .and. .not. state%contact%is_touching) lost_share = lost_share &
                     & + weights(node)*length/span
               end do
            end do
         end do
      end associate
   end subroutine brute_force

   subroutine test_curve(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t), allocatable :: models(:)
      type(cycle_t) :: cycle
      type(statistics_t) :: statistics
      type(error_t), allocatable :: failure
      ! Torques by brute force and their sizes, by the routine for pieces [N m]
      real(wp) :: torques(torque_count), sizes(torque_count), of_piece(torque_count)
      character(len=80) :: words
      integer :: number, i

      do number = 1, 5
         call hard_case(number, the_case, error)
         if (allocated(error)) return
         ! The cycle of a result, and one whose spin is known far better than what is made of it
         the_case%numerics%accuracy = merge(1.0e-4_wp, 1.0e-7_wp, number <= 2)
         call take_statistics(the_case, models, cycle, statistics, error)
         if (.not. allocated(error)) call brute_force(models(1), cycle, merge(16, 64, has_checks()), torques, sizes, error)
         if (allocated(error)) return
         call integrate_torques(models(1), cycle, of_piece, failure)
         if (has_failed(failure, error)) return
         do i = 1, size(losses)
            associate (loss => losses(i))
               write (words, "(a, 2i2, 3es11.2)") "case, torque, errors, tolerance", number, loss, &
                  & abs([statistics%torques(loss), of_piece(loss)] - torques(loss))/max(sizes(loss), tiny(1.0_wp)), cycle%tolerance
               ! Brute force has errors of its own: kinks within a panel, of the square of its part of an interval
               call check(error, all(abs([statistics%torques(loss), of_piece(loss)] - torques(loss)) &
                  & <= 1.1_wp*cycle%tolerance*sizes(loss)), words)
               if (allocated(error)) return
            end associate
         end do
      end do
   end subroutine test_curve

   subroutine test_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=8), parameter :: methods(*) = [character(len=8) :: "hermite", "rodas5p", "radau5"]
      type(case_t) :: the_case
      type(model_t), allocatable :: models(:)
      type(cycle_t) :: cycle
      type(statistics_t) :: right, statistics
      ! Sizes of the mean torques [N m]; largest error of a mean [-], sum of the logarithms of the estimate over it
      real(wp) :: torques(torque_count), sizes(torque_count), largest, logarithms
      character(len=80) :: words
      integer :: number, method, power, tries

      logarithms = 0.0_wp
      tries = 0
      do number = 1, 5
         call hard_case(number, the_case, error)
         if (allocated(error)) return
         the_case%numerics%method = "rodas5p"
         the_case%numerics%tolerance = 1.0e-9_wp
         call take_statistics(the_case, models, cycle, right, error)
         if (.not. allocated(error)) call brute_force(models(1), cycle, 1, torques, sizes, error)
         if (allocated(error)) return
         do method = 1, size(methods)
            do power = 3, 5
               the_case%numerics%method = methods(method)
               the_case%numerics%tolerance = 10.0_wp**(-power)
               call take_statistics(the_case, models, cycle, statistics, error)
               if (allocated(error)) return
               largest = maxval(abs(statistics%torques(losses) - right%torques(losses))/sizes(losses), mask=sizes(losses) > 0.0_wp)
               largest = max(largest, abs(sum(statistics%torques - right%torques, mask=is_torque))/sum(sizes(losses)))
               write (words, "(2a, 2i2, 2es10.2)") "case, power, error, estimate: ", methods(method), number, power, largest, &
                  & statistics%mean_error
               ! The reference itself is good to a few times its tolerance
               call check(error, largest <= statistics%mean_error + 1.0e-8_wp, words)
               if (allocated(error)) return
               logarithms = logarithms + log(statistics%mean_error/max(largest, 1.0e-9_wp))
               tries = tries + 1
            end do
         end do
      end do
      ! An estimate of everything as wrong would not pass: a bound of sizes, where errors of both signs cancel, and not a guess
      call check(error, logarithms/tries <= log(300.0_wp))
   end subroutine test_estimate

   subroutine test_closed(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t), allocatable :: models(:)
      type(cycle_t) :: cycle
      type(statistics_t) :: statistics
      ! Largest difference of the kinetic energy of the roller between start and end, of its spin at any angle [J]
      real(wp) :: closed
      ! The roller turns at most so much faster than the cam [-]: its radius is less than half that of the base circle with the lift
      real(wp), parameter :: fastest = 6.0_wp

      the_case = thesis_case()
      the_case%numerics = numerics_t()
      call take_statistics(the_case, models, cycle, statistics, error)
      if (allocated(error)) return
      call check(error, abs(statistics%torques(of_geometric)) <= 0.0_wp, "mean of the geometric torque")
      if (allocated(error)) return
      closed = models(1)%roller_inertia*cycle%closure*cycle%scale/models(1)%roller_radius*fastest*models(1)%speed
      call check(error, abs(statistics%torques(of_roller_inertia))*two_pi &
         & <= closed*(1.0_wp + 1.0e-6_wp) + 1.0e-15_wp, "spin of the roller")
   end subroutine test_closed

   subroutine test_lost(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t), allocatable :: models(:)
      type(cycle_t) :: cycle
      type(statistics_t) :: statistics
      ! Torques by brute force and their sizes [N m]
      real(wp) :: torques(torque_count), sizes(torque_count)
      character(len=60) :: words
      integer :: i

      do i = 1, 2
         the_case = gas_case()
         if (i == 2) deallocate (the_case%gas_force)
         call take_statistics(the_case, models, cycle, statistics, error)
         if (.not. allocated(error)) call brute_force(models(1), cycle, 16, torques, sizes, error)
         if (allocated(error)) return
         call check(error, statistics%lost_share > 0.01_wp, "contact is not lost")
         if (allocated(error)) return
         write (words, "(4es13.5)") statistics%torques(of_geometric), torques(of_geometric), sizes(of_geometric), sum(sizes(losses))
         ! Brute force has 16 panels of three points in each interval, whose ends are all kinks there are: rounding of the large
         ! torque that goes to and fro is what is left
         call check(error, abs(statistics%torques(of_geometric) - torques(of_geometric)) <= 1.0e-9_wp*sizes(of_geometric) &
            & + cycle%tolerance*sum(sizes(losses)), &
            & words)
         if (allocated(error)) return
         ! The lift is even: without gas contact comes back with the energy that it was lost with
         call check(error, (abs(statistics%torques(of_geometric)) > 1.0e-3_wp*sizes(of_geometric)) &
            & .eqv. i == 1, "what is lost or gained")
         if (allocated(error)) return
      end do
   end subroutine test_lost

   subroutine test_least(error)
      type(error_type), allocatable, intent(out) :: error
      ! What counts as none of two series: less than their size, and more [unit of each times rad]
      real(wp), parameter :: least(2) = [1.0_wp, 3.0_wp]
      type(panels_t) :: panels
      real(wp) :: values(size(least) + torque_count, panel_points), sizes(size(least) + torque_count)

      ! Two over an interval of one radian
      values = 2.0_wp
      call start_panels(panels, size(values, 1), 1)
      call add_panel(panels, 0.0_wp, 1.0_wp, values)
      sizes = mean_sizes(panels, least, [1, 0])
      call check(error, all(abs(sizes(:2) - [2.0_wp, 3.0_wp]) < 1.0e-12_wp))
   end subroutine test_least

   !> The drag of the bearing turns the finger: where contact is lost is not known before the spin is, and no stop is there.
   subroutine test_free_loss(error)
      type(error_type), allocatable, intent(out) :: error
      ! Panels of brute force in an interval
      integer, parameter :: parts = 400
      ! Mean torque allowed to be missed [N m]: a torque of 2 N m that begins half an interval of brute force, 7e-5 rad, too early.
      ! With changes at stops 5.8e-5 are missed
      real(wp), parameter :: allowed = 2.0_wp*7.0e-5_wp/two_pi
      ! Part of the cycle without contact, allowed to be missed [-]: two such intervals. With changes at stops 7.5e-5 are missed
      real(wp), parameter :: allowed_share = 2.0_wp*7.0e-5_wp/two_pi
      type(case_t) :: the_case
      type(model_t), allocatable :: models(:)
      type(cycle_t) :: cycle
      type(statistics_t) :: statistics
      type(error_t), allocatable :: failure
      ! Torques by brute force, their sizes, by the routine for pieces [N m]; part of the cycle without torque of the cam [-]
      real(wp) :: torques(torque_count), sizes(torque_count), of_piece(torque_count), share
      character(len=80) :: words

      call get_deck_case("test/data/free_loss/deck.nml", the_case, failure)
      if (.not. allocated(failure)) call take_statistics(the_case, models, cycle, statistics, error)
      if (.not. allocated(failure) .and. .not. allocated(error)) call integrate_torques(models(1), cycle, of_piece, failure)
      if (has_failed(failure, error)) return
      call brute_force(models(1), cycle, parts, torques, sizes, error, share)
      if (allocated(error)) return
      write (words, "(5es13.5)") statistics%torques(of_geometric), of_piece(of_geometric), torques(of_geometric), &
         & statistics%lost_share, share
      call check(error, all(abs([statistics%torques(of_geometric), of_piece(of_geometric)] - torques(of_geometric)) <= allowed) &
         & .and. abs(statistics%lost_share - share) <= allowed_share .and. share > 0.01_wp, words)
   end subroutine test_free_loss

   subroutine test_step(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t), allocatable :: models(:)
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Step [rad]
      real(wp), parameter :: step = 7.3_wp*degree
      ! Energy stored before and after the step, work that is stored, largest energy met [J]
      real(wp) :: before, after, work, largest
      integer :: i

      the_case = thesis_case()
      call build_models(the_case, models, failure)
      if (.not. allocated(failure)) call start_simulation(simulation, the_case, 0.5_wp*pi, failure)
      largest = 0.0_wp
      do i = 1, 25
         if (.not. allocated(failure)) call advance(simulation, 0.5_wp*pi + i*step, the_case%operating_point%speed, &
            & the_case%operating_point%oil_temperature, outcome, failure)
         if (has_failed(failure, error)) return
         after = stored_energy(models(1)%train, outcome%state%position, models(1)%speed) &
            & + 0.5_wp*models(1)%roller_inertia*outcome%state%contact%roller_spin**2
         largest = max(largest, after)
         work = step*(outcome%mean_torque_drive - outcome%mean_torque_friction)
         ! Sums and differences of some energies
         if (i > 1) call check(error, abs(work - (after - before)) <= 100.0_wp*epsilon(1.0_wp)*largest)
         if (allocated(error)) return
         before = after
      end do
   end subroutine test_step

   subroutine test_accuracy(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=20) :: "mean_torque_contact", "mean_torque_needle", &
         & "mean_torque_friction", "mean_torque_drive"]
      type(case_t) :: the_case
      type(result_t) :: result, right
      type(error_t), allocatable :: failure
      ! Means [N m], friction torque [N m], estimate [-]
      real(wp) :: found, expected, friction, estimate
      character(len=100) :: words
      integer :: number, power, i

      do number = 1, 3
         call hard_case(number, the_case, error)
         if (allocated(error)) return
         the_case%numerics%accuracy = 1.0e-8_wp
         call run_case(the_case, right, failure)
         do power = 3, 5
            the_case%numerics%accuracy = 10.0_wp**(-power)
            if (.not. allocated(failure)) call run_case(the_case, result, failure)
            if (.not. allocated(failure)) call get_summary(result, "estimated_error_of_means", estimate, failure)
            if (.not. allocated(failure)) call get_summary(right, "mean_torque_friction", friction, failure)
            do i = 1, size(names)
               if (.not. allocated(failure)) call get_summary(result, trim(names(i)), found, failure)
               if (.not. allocated(failure)) call get_summary(right, trim(names(i)), expected, failure)
               if (has_failed(failure, error)) return
               write (words, "(a, 2i3, 3es10.2)") trim(names(i)), number, power, found, expected, estimate
               call check(error, abs(found - expected) <= the_case%numerics%accuracy*merge(friction, expected, i == 4), words)
               if (allocated(error)) return
            end do
            call check(error, estimate <= the_case%numerics%accuracy .and. &
               & all(result%remarks%kind /= missed_means), words)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_accuracy

   subroutine test_remark(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure

      the_case = source_case()
      the_case%numerics = numerics_t()
      the_case%numerics%accuracy = 1.0e-15_wp
      call run_case(the_case, result, failure)
      if (has_failed(failure, error)) return
      call check(error, any(result%remarks%kind == missed_means) .and. &
         & index(remark_lines(result%remarks), "error, of mean_") > 0, remark_lines(result%remarks))
      if (allocated(error)) return
      the_case%numerics%accuracy = 1.0e-4_wp
      call run_case(the_case, result, failure)
      if (has_failed(failure, error)) return
      call check(error, all(result%remarks%kind /= missed_means), remark_lines(result%remarks))
   end subroutine test_remark

   !> The entrainment speed of this random deck passes through zero twice.
   subroutine test_standstill(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: seed = 700090
      type(random_t) :: random
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: text
      ! Smallest film [m]; of the first accuracy; number of standstills
      real(wp) :: film, first, standstills
      character(len=60) :: words
      integer :: power

      call start_random(random, seed)
      call random_deck(random, text)
      call parse_deck(deck, text, "random deck", "", none, failure)
      if (.not. allocated(failure)) call make_case(deck, none, the_case, failure)
      ! the last ones take minutes with run-time checks
      do power = 3, merge(4, 5, has_checks())
         the_case%numerics%accuracy = 10.0_wp**(-power)
         if (.not. allocated(failure)) call run_case(the_case, result, failure)
         if (.not. allocated(failure)) call get_summary(result, "min_film_thickness_min", film, failure)
         if (.not. allocated(failure)) call get_summary(result, "entrainment_reversals", standstills, failure)
         if (has_failed(failure, error)) return
         if (power == 3) first = film
         write (words, "(3es12.4)") film, first, standstills
         ! The place of the standstill is known within the accuracy, and the load, which the film of dry surfaces follows, changes
         ! little over that
         call check(error, nint(standstills) == 2 .and. abs(film - first) <= 1.0e-3_wp*first + 1.0e-15_wp, words)
         if (allocated(error)) return
         call check(error, &
            & index(remark_lines(result%remarks), "the entrainment speed passes through zero 2 times in contact") > 0, &
            & remark_lines(result%remarks))
         if (allocated(error)) return
      end do
   end subroutine test_standstill

   subroutine test_extremes(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=24) :: "min_film_thickness_min", "max_film_thickness_min", &
         & "max_hertz_pressure", "max_contact_load", "max_sliding_speed", "min_sliding_speed"]
      type(case_t) :: the_case
      type(result_t) :: fine, coarse
      type(error_t), allocatable :: failure
      ! With points every 0.02 and 10 degrees [unit of the quantity]
      real(wp) :: values(2)
      character(len=80) :: words
      integer :: i

      the_case = thesis_case()
      call set_point(the_case, 94.0_wp, point_viscosities(2))
      the_case%numerics%output_step = 0.02_wp*degree
      call run_case(the_case, fine, failure)
      the_case%numerics%output_step = 10.0_wp*degree
      if (.not. allocated(failure)) call run_case(the_case, coarse, failure)
      do i = 1, size(names)
         if (.not. allocated(failure)) call get_summary(fine, trim(names(i)), values(1), failure)
         if (.not. allocated(failure)) call get_summary(coarse, trim(names(i)), values(2), failure)
         if (has_failed(failure, error)) return
         write (words, "(a, 2es17.9)") trim(names(i)), values
         ! A millionth of the range is stated, and no range here is more than a few times the largest value
         call check(error, abs(values(2) - values(1)) <= 3.0e-6_wp*maxval(abs(values)), words)
         if (allocated(error)) return
      end do
   end subroutine test_extremes

end module test_means
