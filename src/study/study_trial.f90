!> One run of a study: a case computed with one method and setting, its result, its time, and its errors relative to a reference.
!>
!> In: a case. Out: `trial_t`. A run that fails has a status and a message.
module camroller_study_trial
   use camroller_kinds, only : wp, two_pi, not_a_number
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_profiles, only : plain_model
   use camroller_ehl_record, only : ehl_record_t, column, cycle_quantities, make_ehl_record
   use camroller_ehl_summary, only : mean_over_cycle
   use camroller_model, only : model_t
   use camroller_case_result, only : output_angles
   use camroller_catalogue, only : lobe_prefix
   use camroller_result, only : result_t, find_quantity
   use camroller_run, only : run_case
   use camroller_sorting, only : median
   implicit none
   private

   public :: trial_t, run_trial, solve_trial, errors_against, largest_deviation, relative_error, smallest_error

   !> Error below which two results count as equal: the smallest that a study shows [-]
   real(wp), parameter :: smallest_error = 1.0e-8_wp
   !> Processor time after which a trial is not repeated [s]
   real(wp), parameter :: patience = 0.5_wp

   !> Outcome of a trial
   type :: trial_t
      !> 0, or the kind of the error
      integer :: status = 0
      !> What went wrong; empty where nothing did
      character(len=:), allocatable :: message
      !> Sliding speed at the output angles [m/s]
      real(wp), allocatable :: sliding_speed(:)
      !> Mean torque for all losses [N m]
      real(wp) :: mean_friction = 0.0_wp
      !> Smallest film at the output angles [m]
      real(wp) :: smallest_film = 0.0_wp
      !> Cycles of the longest period of flexible trains; 0 where one has none, 1 for rigid trains
      integer :: period = 1
      !> Part of its turns that the roller loses per cam revolution [-]
      real(wp) :: revolution_slip = 0.0_wp
      !> Error of the sliding speed as the program estimates it; not a number where it does not [-]
      real(wp) :: estimated_error = 0.0_wp
      !> Evaluations of the roller equation, not a number where there are none [-]; accepted steps [-]
      real(wp) :: evaluations = 0.0_wp, steps = 0.0_wp
      !> Median processor time of the trial [s]
      real(wp) :: time = 0.0_wp
   end type trial_t

contains

   !> Run a case and keep what a study compares.
   subroutine run_trial(case, repeats, trial)
      !> The case
      type(case_t), intent(in) :: case
      !> Runs whose median time counts; fewer where they are long
      integer, intent(in) :: repeats
      !> Its outcome
      type(trial_t), intent(out) :: trial

      type(result_t) :: result
      type(error_t), allocatable :: error
      ! Time of each run, at the start of the first and of one [s]
      real(wp) :: times(max(repeats, 1)), first, start, now
      integer :: run

      call cpu_time(first)
      do run = 1, size(times)
         call cpu_time(start)
         call run_case(case, result, error)
         call cpu_time(now)
         times(run) = now - start
         if (allocated(error) .or. now - first > patience) exit
      end do
      trial%message = ""
      if (allocated(error)) then
         trial%status = error%kind
         trial%message = error%message
         return
      end if
      trial%time = median(times(:min(run, size(times))))
      trial%sliding_speed = result%series_values(:, find_quantity(result%series, "sliding_speed"))
      trial%mean_friction = scalar("mean_torque_friction")
      trial%smallest_film = minval(result%series_values(:, find_quantity(result%series, "film_thickness_min")), &
         & result%series_values(:, find_quantity(result%series, "contact_load")) > 0.0_wp)
      trial%revolution_slip = scalar("revolution_slip")
      trial%estimated_error = scalar("estimated_error")
      trial%evaluations = scalar("counter_evaluations")
      trial%steps = scalar("counter_steps")
      trial%period = longest_period(result)

   contains

      !> A scalar of the result.
      pure function scalar(name) result(value)
         !> Its name
         character(len=*), intent(in) :: name
         !> Its value [unit of the scalar]
         real(wp) :: value

         value = result%summary_values(find_quantity(result%summary, name))
      end function scalar
   end subroutine run_trial

   !> Cycles of the longest period of a result's followers; 0 where one has none.
   pure function longest_period(result) result(period)
      type(result_t), intent(in) :: result
      !> The cycles
      integer :: period

      integer :: lobe, place, cycles

      period = 1
      lobe = 1
      do
         place = find_quantity(result%summary, trim(lobe_prefix(lobe))//"period_cycles")
         if (place == 0) return
         cycles = nint(result%summary_values(place))
         period = merge(0, max(period, cycles), min(period, cycles) == 0)
         lobe = lobe + 1
      end do
   end function longest_period

   !> Solve the contact of the first follower over the cycle, with its transient film, and keep the same.
   subroutine solve_trial(case, nodes, step_error, repeats, trial)
      !> The case; camshaft bearings take no part
      type(case_t), intent(in) :: case
      !> Nodes across the contact
      integer, intent(in) :: nodes
      !> Error of a step that is allowed [-]
      real(wp), intent(in) :: step_error
      !> Solutions whose median time counts; fewer where they are long
      integer, intent(in) :: repeats
      !> Its outcome
      type(trial_t), intent(out) :: trial

      type(model_t) :: model
      type(ehl_cycle_t) :: cycle
      type(ehl_record_t) :: record
      type(error_t), allocatable :: error
      ! Time of each solution, at the start of the first and of one [s]
      real(wp) :: times(max(repeats, 1)), first, start, now
      integer :: run

      call plain_model(model, case, .false., error)
      call cpu_time(first)
      do run = 1, size(times)
         if (allocated(error)) exit
         call cpu_time(start)
         call integrate_ehl_cycle(cycle, model, ehl_cycle_options_t(nodes=nodes, step_error=step_error), error)
         call cpu_time(now)
         times(run) = now - start
         if (now - first > patience) exit
      end do
      trial%message = ""
      if (allocated(error)) then
         trial%status = error%kind
         trial%message = error%message
         return
      end if
      trial%time = median(times(:min(run, size(times))))
      call make_ehl_record(record, model, cycle, cycle_quantities)
      trial%sliding_speed = at_angles(output_angles(case%numerics%output_step)*two_pi/360.0_wp, &
         & modulo(record%angle + 0.5_wp*two_pi, two_pi), column(record, "sliding_speed"))
      trial%mean_friction = mean_over_cycle(record%angle, column(record, "torque_friction"))
      trial%smallest_film = minval(at_angles(output_angles(case%numerics%output_step)*two_pi/360.0_wp, &
         & modulo(record%angle + 0.5_wp*two_pi, two_pi), column(record, "film_min")))
      trial%revolution_slip = not_a_number()
      trial%estimated_error = not_a_number()
      trial%evaluations = not_a_number()
      trial%steps = size(cycle%angle)
   end subroutine solve_trial

   !> Values over one turn, linear between neighbours, at other angles.
   pure function at_angles(wanted, angles, values) result(row)
      !> Angles at which values are wanted, those of the values, all within one turn from zero [rad]
      real(wp), intent(in) :: wanted(:), angles(:)
      !> The values [any]
      real(wp), intent(in) :: values(:)
      !> Values at the angles wanted [any]
      real(wp) :: row(size(wanted))

      ! Distances back and on to a point, the least of them [rad]
      real(wp) :: back, on
      integer :: i, before, after

      do i = 1, size(wanted)
         before = minloc(modulo(wanted(i) - angles, two_pi), 1)
         after = minloc(modulo(angles - wanted(i), two_pi), 1)
         back = modulo(wanted(i) - angles(before), two_pi)
         on = modulo(angles(after) - wanted(i), two_pi)
         row(i) = values(before)
         if (back + on > 0.0_wp) row(i) = (on*values(before) + back*values(after))/(back + on)
      end do
   end function at_angles

   !> Errors of a trial: of the sliding speed relative to its largest value, of mean friction and smallest film relative to theirs.
   pure function errors_against(reference, trial) result(errors)
      !> What counts as right
      type(trial_t), intent(in) :: reference
      !> The trial; its angles are those of the reference
      type(trial_t), intent(in) :: trial
      !> The three errors [-]
      real(wp) :: errors(3)

      errors(1) = largest_deviation(trial%sliding_speed, reference%sliding_speed)
      errors(2) = relative_error(trial%mean_friction, reference%mean_friction)
      errors(3) = relative_error(trial%smallest_film, reference%smallest_film)
   end function errors_against

   !> Largest deviation of some values relative to the largest of the reference.
   pure function largest_deviation(values, reference) result(error)
      !> Values and reference at the same angles [any]
      real(wp), intent(in) :: values(:), reference(:)
      !> Error [-]
      real(wp) :: error

      associate (largest => maxval(abs(reference)))
         error = relative_error(largest + maxval(abs(values - reference)), largest)
      end associate
   end function largest_deviation

   !> Deviation relative to the reference; one where the reference is zero and the value is not.
   elemental function relative_error(value, reference) result(error)
      !> Value and reference [any]
      real(wp), intent(in) :: value, reference
      !> Error [-]
      real(wp) :: error

      error = abs(value - reference)
      if (abs(reference) > 0.0_wp) then
         error = error/abs(reference)
      else if (error > 0.0_wp) then
         error = 1.0_wp
      end if
   end function relative_error

end module camroller_study_trial
