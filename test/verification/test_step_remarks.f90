!> Remarks on steps of a host: of the same kinds as those of the run of the case, and none where the run has none.
module test_step_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller, only : wp, pi, two_pi, error_t, case_t, result_t, simulation_t, outcome_t, inputs_t, remark_t, remark_names, &
      & shaft_simulation_t, shaft_outcome_t, run_case, start_simulation, advance, start_shaft, advance_shaft, &
      & list_step_remarks, list_shaft_remarks
   use camroller_kinds, only : celsius_zero, degree
   use camroller_remarks, only : beyond_pressure_law, far_temperature, lost_contact, outside_range, rubbing_bearing, &
      & rubbing_contact, unusual_gas, unusual_supply, yielding_surface
   use deck_cases, only : get_deck_case
   use reference_cases, only : thesis_case
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_step_remarks

   !> Kinds that a step tells of
   integer, parameter :: step_kinds(*) = [lost_contact, outside_range, rubbing_contact, beyond_pressure_law, yielding_surface, &
      & far_temperature, rubbing_bearing]

contains

   subroutine collect_step_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("steps of a turn have remarks of the kinds that the run has", test_kinds), &
         new_unittest("a long step tells of what is lost in any of its pieces", test_long_step), &
         new_unittest("oil far from its points is told of at either end of a step, and no longer than it is there", test_oil), &
         new_unittest("pressures from a host that no engine has are told of, and those of every cycle are not", test_pressures), &
         new_unittest("the range of a law for the film's own load is judged by that load in steps too", test_film_load) &
         ]
   end subroutine collect_step_remarks

   subroutine test_kinds(error)
      type(error_type), allocatable, intent(out) :: error

      ! Between them they have each of the kinds; the fourth has none
      character(len=*), parameter :: decks(*) = [character(len=28) :: "hard/contact_loss_3200_rpm", "hard/hot_thin_film", &
         & "hard/pressure_4000_MPa_barus", "four_cylinder", "hard/touching_bearings", "hard/cold_start_minus_30", "dynamics"]
      logical :: of_run(size(remark_names)), of_steps(size(remark_names)), met(size(remark_names))
      type(error_t), allocatable :: failure
      integer :: i, k

      met = .false.
      do i = 1, size(decks)
         call compare(trim(decks(i)), of_run, of_steps, failure)
         if (has_failed(failure, error)) return
         met = met .or. of_run
         do k = 1, size(step_kinds)
            associate (kind => step_kinds(k))
               call check(error, of_run(kind) .eqv. of_steps(kind), trim(decks(i))//": '"//trim(remark_names(kind))// &
                  & "' is told of by "//trim(merge("the run  ", "its steps", of_run(kind)))//" alone")
               if (allocated(error)) return
            end associate
         end do
         of_steps(step_kinds) = .false.
         call check(error, .not. any(of_steps), trim(decks(i))//": steps tell of a kind that is not listed here")
         if (allocated(error)) return
      end do
      do k = 1, size(step_kinds)
         call check(error, met(step_kinds(k)), "no deck has '"//trim(remark_names(step_kinds(k)))//"'")
         if (allocated(error)) return
      end do
   end subroutine test_kinds

   !> Kinds of the remarks of a deck's run, and of those on the steps of half a turn after half a turn, from closed valve to closed
   !> valve of the first cam.
   subroutine compare(deck, of_run, of_steps, failure)
      character(len=*), intent(in) :: deck
      logical, intent(out) :: of_run(:), of_steps(:)
      type(error_t), allocatable, intent(out) :: failure
      type(case_t) :: the_case
      type(result_t) :: result
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs
      integer, parameter :: steps = 120 ! of a turn
      integer :: i

      of_run = .false.
      of_steps = .false.
      call get_deck_case("decks/"//deck//".nml", the_case, failure)
      if (.not. allocated(failure)) call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, pi, failure)
      if (allocated(failure)) return
      of_run(result%remarks%kind) = .true.
      inputs = inputs_t(speed=the_case%operating_point%speed, oil_temperature=the_case%operating_point%oil_temperature)
      do i = 1, 2*steps
         call advance_shaft(shaft, pi + two_pi*i/steps, inputs, inputs, outcome, failure)
         if (allocated(failure)) return
         ! A flexible train vibrates from its start for a turn
         if (i <= steps) cycle
         call list_shaft_remarks(shaft, outcome, remarks)
         of_steps(remarks%kind) = .true.
      end do
   end subroutine compare

   !> Contact is lost beside the nose, in the second of the two pieces of a step of a whole turn.
   subroutine test_long_step(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      the_case%operating_point%speed = two_pi*3200.0_wp/60.0_wp
      inputs = inputs_t(speed=the_case%operating_point%speed, oil_temperature=the_case%operating_point%oil_temperature)
      call start_simulation(follower, the_case, -0.5_wp*pi, failure)
      if (has_failed(failure, error)) return
      call list_step_remarks(follower, the_case, outcome, remarks)
      call check(error, size(remarks) == 0, "there are remarks before a step")
      if (allocated(error)) return
      call advance(follower, 1.5_wp*pi, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      call list_step_remarks(follower, the_case, outcome, remarks)
      call check(error, count(remarks%kind == lost_contact) == 1 .and. outcome%extremes%contact_load(1) <= 0.0_wp, &
         & "contact is lost, and the step does not say so")
      if (allocated(error)) return
      call advance(follower, 1.5_wp*pi + degree, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      call list_step_remarks(follower, the_case, outcome, remarks)
      call check(error, .not. any(remarks%kind == lost_contact), "contact is lost on the base circle")
   end subroutine test_long_step

   subroutine test_oil(error)
      type(error_type), allocatable, intent(out) :: error
      ! The oil of the thesis has points from 25 to 95 degC; 20 K beyond are taken for good [degC]
      real(wp), parameter :: temperatures(*) = [60.0_wp, 114.0_wp, 116.0_wp, 60.0_wp]
      logical, parameter :: is_far(*) = [.false., .true., .true.]
      type(case_t) :: the_case
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs(4)
      type(error_t), allocatable :: failure
      integer :: i

      call get_deck_case("decks/thesis.nml", the_case, failure)
      if (has_failed(failure, error)) return
      inputs%speed = the_case%operating_point%speed
      inputs%oil_temperature = temperatures + celsius_zero
      call start_simulation(follower, the_case, 0.0_wp, failure)
      do i = 1, 3
         if (.not. allocated(failure)) call advance(follower, i*degree, inputs(i), inputs(i + 1), outcome, failure)
         if (has_failed(failure, error)) return
         call list_step_remarks(follower, the_case, outcome, remarks)
         call check(error, any(remarks%kind == far_temperature) .eqv. is_far(i), "oil that is far from its points")
         if (allocated(error)) return
      end do
   end subroutine test_oil

   !> Pressures in bar or MPa given for pascals, and the other way round, beside those of an engine that stands, idles and fires.
   subroutine test_pressures(error)
      type(error_type), allocatable, intent(out) :: error
      ! Gauge pressures [Pa], and which of them are unusual
      real(wp), parameter :: supply(*) = [0.0_wp, 2.0e4_wp, 1.0e6_wp, 2.0_wp, 0.2_wp, 2.0e8_wp]
      real(wp), parameter :: gas(*) = [0.0_wp, -9.0e4_wp, 2.5e7_wp, 6.0_wp, -5.0e5_wp, 1.0e9_wp]
      logical, parameter :: is_odd(6, 2) = reshape([.false., .false., .false., .true., .true., .true., .false., .false., .false., &
         & .false., .true., .true.], [6, 2])
      type(case_t) :: cases(2)
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs(2)
      type(error_t), allocatable :: failure
      integer :: i, k

      call get_deck_case("decks/lash_adjuster.nml", cases(1), failure)
      if (.not. allocated(failure)) call get_deck_case("decks/three_cam_head.nml", cases(2), failure)
      if (has_failed(failure, error)) return
      do k = 1, 2
         do i = 1, size(supply)
            inputs = inputs_t(speed=cases(k)%operating_point%speed, oil_temperature=cases(k)%operating_point%oil_temperature)
            inputs%has_supply = k == 1
            inputs%has_pressure = k == 2
            ! At one end of the step or at both
            if (k == 1) inputs%supply_pressure = [merge(supply(i), 2.0e5_wp, modulo(i, 2) == 1), supply(i)]
            if (k == 2) inputs%gas_pressure = [gas(i), merge(gas(i), 0.0_wp, modulo(i, 2) == 1)]
            call start_simulation(follower, cases(k), 0.0_wp, failure)
            if (.not. allocated(failure)) call advance(follower, 0.01_wp*degree, inputs(1), inputs(2), outcome, failure)
            if (has_failed(failure, error)) return
            call list_step_remarks(follower, cases(k), outcome, remarks)
            call check(error, any(remarks%kind == merge(unusual_supply, unusual_gas, k == 1)) .eqv. is_odd(i, k), &
               & "pressures of a host")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_pressures

   !> Rough surfaces take a tenth of the load of a short roller at the nose: W* of the whole load is above the range of Dowson and
   !> Higginson's law, that of the film's load within it, and the law is one for the film's load.
   subroutine test_film_load(error)
      type(error_type), allocatable, intent(out) :: error
      ! W* up to which the law was published by `film` [-]
      real(wp), parameter :: largest = 3.0e-4_wp
      type(case_t) :: the_case
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      type(remark_t), allocatable :: remarks(:)
      real(wp) :: whole, of_film ! W* [-]

      call get_deck_case("decks/hard/rough_surfaces.nml", the_case, failure, "mechanism.contact_width_mm=2.8")
      if (has_failed(failure, error)) return
      the_case%film%range_policy = "stop"
      inputs = inputs_t(speed=the_case%operating_point%speed, oil_temperature=the_case%operating_point%oil_temperature)
      call start_simulation(follower, the_case, pi, failure)
      if (.not. allocated(failure)) call advance(follower, pi + degree, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      associate (contact => outcome%state%contact)
         ! by the width of Hertz' contact
         whole = pi/8.0_wp*(contact%half_width/outcome%state%position%equivalent_radius)**2
         of_film = whole*(1.0_wp - contact%asperity_load/contact%load)
      end associate
      call check(error, whole > largest .and. of_film < largest, "the loads are not on both sides of the bound")
      if (allocated(error)) return
      call list_step_remarks(follower, the_case, outcome, remarks)
      call check(error, .not. any(remarks%kind == outside_range), "the range is judged by the whole load")
   end subroutine test_film_load

end module test_step_remarks
