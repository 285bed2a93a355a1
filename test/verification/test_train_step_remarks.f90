!> Remarks on steps of flexible trains: told where the state shows what they tell, of the kinds that the run has.
module test_train_step_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller, only : wp, pi, two_pi, degree, error_t, case_t, result_t, simulation_t, outcome_t, inputs_t, remark_t, &
      & remark_names, run_case, start_simulation, advance, list_step_remarks
   use camroller_lash_adjuster, only : ambient_pressure
   use camroller_remarks, only : empty_chamber, lost_contact, open_pivot, open_valve, outside_range, relieved_spring, &
      & sinking_plunger, stopped_plunger
   use deck_cases, only : get_deck_case
   use driven_trains, only : steady
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_train_step_remarks

contains

   subroutine collect_train_step_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a train with lash tells of lost contact where its cam has taken the lash up", test_lash), &
         new_unittest("steps of an adjuster's train tell what the run tells, where the state shows it", test_adjuster), &
         new_unittest("steps tell of a spring that waves relieve", test_relief), &
         new_unittest("steps of a train that keeps together tell nothing", test_healthy) &
         ]
   end subroutine collect_train_step_remarks

   !> A case at a speed.
   subroutine get_case(deck, rpm, the_case, failure)
      character(len=*), intent(in) :: deck
      !> Cam speed [1/min]
      real(wp), intent(in) :: rpm
      type(case_t), intent(out) :: the_case
      type(error_t), allocatable, intent(out) :: failure

      call get_deck_case("decks/"//deck//".nml", the_case, failure)
      the_case%operating_point%speed = two_pi*rpm/60.0_wp
   end subroutine get_case

   !> Cam and roller part at the nose of a cam that is too fast for its spring. On the base circle they are apart at every speed.
   subroutine test_lash(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      real(wp), parameter :: lash = 1.0e-4_wp ! [m]
      integer :: i, apart
      logical :: is_told

      call get_case("dynamics", 3000.0_wp, the_case, failure)
      if (has_failed(failure, error)) return
      the_case%dynamics%lash = lash
      ! What happens in every turn is no error
      the_case%contact_policy = "stop"
      inputs = steady(the_case)
      call start_simulation(follower, the_case, 0.0_wp, failure)
      apart = 0
      do i = 1, 720
         if (.not. allocated(failure)) call advance(follower, i*degree, inputs, inputs, outcome, failure)
         if (has_failed(failure, error)) return
         call list_step_remarks(follower, the_case, outcome, remarks)
         is_told = any(remarks%kind == lost_contact)
         ! Lift that the cam gives a rigid train, at the end of the step
         if (outcome%state%position%lift - outcome%state%flexible%lift_error > lash) then
            if (.not. outcome%state%contact%load > 0.0_wp) apart = apart + 1
            call check(error, is_told .or. outcome%state%contact%load > 0.0_wp, "contact is lost, and the step does not say so")
         else if (modulo(i, 360) < 60 .or. modulo(i, 360) > 300) then
            call check(error, .not. is_told, "the lash itself is told of")
         end if
         if (allocated(error)) return
      end do
      call check(error, apart > 40, "contact is hardly lost")
   end subroutine test_lash

   !> What the state at the end of a step shows is told, and over the last of some turns steps have the kinds of the run.
   subroutine test_adjuster(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: kinds(*) = [open_pivot, open_valve, stopped_plunger, sinking_plunger, empty_chamber]
      ! Cam speeds [1/min]
      real(wp), parameter :: speeds(*) = [2500.0_wp, 600.0_wp]
      ! Which of these kinds have been met
      logical :: met(size(kinds))
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      logical :: of_steps(size(remark_names))
      integer :: i, k

      met = .false.
      do i = 1, size(speeds)
         call get_case("lash_adjuster", speeds(i), the_case, failure)
         if (has_failed(failure, error)) return
         if (i == 2) then
            ! What leaks comes back through no check valve that opens, and hardly along the plunger
            the_case%lash_adjuster%crack_pressure = 2.9e5_wp
            the_case%lash_adjuster%gap = 1.0e-5_wp
         end if
         call run_case(the_case, result, failure)
         if (has_failed(failure, error)) return
         call drive_adjuster(the_case, of_steps, error)
         if (allocated(error)) return
         do k = 1, size(kinds)
            call check(error, any(result%remarks%kind == kinds(k)) .eqv. of_steps(kinds(k)), "'"//trim(remark_names(kinds(k)))// &
               & "' is told of by "//trim(merge("the steps", "the run  ", of_steps(kinds(k))))//" alone")
            if (allocated(error)) return
            met(k) = met(k) .or. of_steps(kinds(k))
         end do
      end do
      do k = 1, size(kinds)
         call check(error, met(k), "no speed has '"//trim(remark_names(kinds(k)))//"'")
         if (allocated(error)) return
      end do
   end subroutine test_adjuster

   !> Drive a train with an adjuster; each state is held against the remarks of the step that ends with it.
   subroutine drive_adjuster(the_case, of_steps, error)
      type(case_t), intent(in) :: the_case
      !> Kinds told of by the steps of the last turns
      logical, intent(out) :: of_steps(:)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: turns = 9, last_turns = 2
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      integer :: i

      of_steps = .false.
      inputs = steady(the_case)
      call start_simulation(follower, the_case, 0.0_wp, failure)
      do i = 1, 360*turns
         if (.not. allocated(failure)) call advance(follower, i*degree, inputs, inputs, outcome, failure)
         if (has_failed(failure, error)) return
         call list_step_remarks(follower, the_case, outcome, remarks)
         if (i > 360*(turns - last_turns)) of_steps(remarks%kind) = .true.
         associate (values => outcome%state%flexible, adjuster => the_case%lash_adjuster)
            ! The finger's weight is 0.4 N
            if (values%joint_force < -1.0_wp) call expect(open_pivot)
            if (values%plunger_travel > adjuster%highest .or. values%plunger_travel < adjuster%lowest) call expect(stopped_plunger)
            ! A fifth of the surroundings' pressure is left
            if (values%chamber_pressure < -0.8_wp*ambient_pressure) call expect(empty_chamber)
            if (modulo(i, 360) < 20 .and. outcome%state%position%lift <= 0.0_wp) call expect(-open_valve)
         end associate
         if (allocated(error)) return
      end do

   contains

      !> A kind must be told of, or must not where it is negative.
      subroutine expect(kind)
         integer, intent(in) :: kind

         if (allocated(error)) return
         call check(error, any(remarks%kind == abs(kind)) .eqv. kind > 0, "'"//trim(remark_names(abs(kind)))// &
            & "' does not go with the state at the end of a step")
      end subroutine expect

   end subroutine drive_adjuster

   !> With a spring of one mode, waves take all compression where the mode's part, pi times its amplitude at the fixed end, is more
   !> than precompression and lift.
   subroutine test_relief(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      integer :: i, told, shown

      call get_case("lash_adjuster", 3200.0_wp, the_case, failure)
      if (has_failed(failure, error)) return
      the_case%spring_surge%modes = 1
      the_case%spring_surge%damping_ratio = 1.0e-3_wp
      inputs = steady(the_case)
      call start_simulation(follower, the_case, 0.0_wp, failure)
      told = 0
      shown = 0
      do i = 1, 360*9
         if (.not. allocated(failure)) call advance(follower, i*degree, inputs, inputs, outcome, failure)
         if (has_failed(failure, error)) return
         call list_step_remarks(follower, the_case, outcome, remarks)
         if (any(remarks%kind == relieved_spring)) told = told + 1
         if (pi*abs(outcome%state%flexible%modes(1)) <= the_case%spring%precompression + outcome%state%position%lift) cycle
         shown = shown + 1
         call check(error, any(remarks%kind == relieved_spring), "waves relieve the spring, and the step does not say so")
         if (allocated(error)) return
      end do
      ! The state at the end of a step shows it in fewer steps than those in which it happens
      call check(error, shown > 10 .and. told >= shown .and. told < 1000, "waves relieve the spring in other steps than told")
   end subroutine test_relief

   subroutine test_healthy(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: decks(*) = [character(len=17) :: "dynamics", "lash_adjuster", "flexible_friction"]
      type(case_t) :: the_case
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(remark_t), allocatable :: remarks(:)
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      integer :: i, k

      do k = 1, size(decks)
         call get_case(trim(decks(k)), 900.0_wp, the_case, failure)
         if (has_failed(failure, error)) return
         inputs = steady(the_case)
         call start_simulation(follower, the_case, 0.0_wp, failure)
         do i = 1, 720
            if (.not. allocated(failure)) call advance(follower, i*degree, inputs, inputs, outcome, failure)
            if (has_failed(failure, error)) return
            call list_step_remarks(follower, the_case, outcome, remarks)
            ! The law of these decks is outside its range on the base circle
            call check(error, all(remarks%kind == outside_range), trim(decks(k))//": a remark on a step without need")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_healthy

end module test_train_step_remarks
