!> What the accuracy of a numerical film costs over the cycle: the table of films over its accuracy, and contacts solved over the
!> cycle over nodes and errors of a step, beside a run with the film law of the deck.
!>
!> Layer: solver. In: a case. Out: rows of `study_table_t`: errors, work, time. A trial that fails is a row with a message.
!> References are finer than any trial: an accuracy of 1e-3 for the table; for the cycle 257 nodes with errors of a step of 3e-4.
module camroller_study_film
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_profiles, only : plain_model
   use camroller_ehl_record, only : ehl_record_t, column, make_ehl_record
   use camroller_ehl_table, only : ehl_t
   use camroller_model, only : model_t
   use camroller_result, only : quantity_t, result_t, find_quantity
   use camroller_study_probe, only : median
   use camroller_study_table, only : study_table_t, word_length, new_table, add_row
   use camroller_study_trials, only : largest_change, least_error, no_number, nothing, patience, scalar_of, seconds_since, &
      & series_of, time_run, words_of
   implicit none
   private

   public :: new_film_table_table, study_film_table, new_cycle_table, study_cycle

   !> Accuracies of the table, zero for the film law of the deck, and of its reference [-]
   real(wp), parameter :: accuracies(*) = [0.0_wp, 1.0e-1_wp, 3.0e-2_wp, 1.0e-2_wp, 3.0e-3_wp], table_reference = 1.0e-3_wp
   !> Nodes of the cycles, and of their reference
   integer, parameter :: cycle_nodes(*) = [33, 65, 129], reference_nodes = 257
   !> Errors of a step of the cycles, and of their reference [-]
   real(wp), parameter :: step_errors(*) = [1.0e-2_wp, 3.0e-3_wp, 1.0e-3_wp], reference_step = 3.0e-4_wp
   !> Trials of a quick study: of each ladder
   integer, parameter :: quick_trials = 2
   !> Nodes of its reference
   integer, parameter :: quick_nodes = 129
   !> Cam angles at which cycles are compared
   integer, parameter :: angle_count = 720

contains

   !> Table of film tables, one row a trial.
   subroutine new_film_table_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call new_table(table, [quantity_t("film", "", "film law, or table of numerical films", "study"), &
         & quantity_t("message", "", "what went wrong, or nothing", "study")], [ &
         & quantity_t("case", "1", "case of the sweep", "study"), &
         & quantity_t("accuracy", "1", "accuracy of the table asked for", "study"), &
         & quantity_t("table_error", "1", "error of the table as the program finds it", "study"), &
         & quantity_t("error_film_min", "1", "largest difference of the smallest film from that of the finest table", "study"), &
         & quantity_t("error_film_central", "1", "largest difference of the central film", "study"), &
         & quantity_t("error_slip", "1", "difference of the mean sliding speed over its value", "study"), &
         & quantity_t("error_friction", "1", "difference of the mean torque for all losses over its value", "study"), &
         & quantity_t("time", "s", "median time of the run with all series and means", "study")])
   end subroutine new_film_table_table

   !> Runs with tables of growing accuracy and with the film law, against the finest table.
   subroutine study_film_table(table, position, case, repeats, is_quick)
      !> Table of film tables
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Trials whose median time counts
      integer, intent(in) :: repeats
      !> A few trials only?
      logical, intent(in) :: is_quick

      type(case_t) :: trial
      type(result_t) :: right, result
      type(error_t), allocatable :: error
      ! Time [s]
      real(wp) :: time
      ! Accuracy asked for [-]
      real(wp) :: accuracy
      character(len=word_length) :: words(2)
      integer :: i, at

      trial = case
      if (.not. allocated(trial%ehl)) allocate (trial%ehl)
      trial%ehl%accuracy = merge(accuracies(quick_trials + 2), table_reference, is_quick)
      call time_run(trial, 1, right, time, error)
      if (allocated(error)) then
         call add_row(table, words_of("", "reference: "//error%message), [real(position - 1, wp), nothing(7)])
         return
      end if
      do i = 1, merge(quick_trials + 1, size(accuracies), is_quick)
         accuracy = no_number()
         if (i == 1) then
            deallocate (trial%ehl)
            words(1) = case%film%law
         else
            trial%ehl = ehl_t(accuracy=accuracies(i))
            if (allocated(case%ehl)) trial%ehl%compressible = case%ehl%compressible
            words(1) = "numerical"
            accuracy = accuracies(i)
         end if
         call time_run(trial, repeats, result, time, error)
         words(2) = ""
         if (allocated(error)) then
            words(2) = error%message
            call add_row(table, words, [real(position - 1, wp), accuracy, nothing(6)])
            cycle
         end if
         at = find_quantity(result%summary, "film_table_error")
         call add_row(table, words, [real(position - 1, wp), accuracy, merge(result%summary_values(max(at, 1)), &
            & no_number(), at > 0), run_differences(result, right), time])
      end do
   end subroutine study_film_table

   !> Differences of a run: both films, mean sliding speed, mean torque for losses.
   function run_differences(result, right) result(differences)
      !> The run, and what it is compared with
      type(result_t), intent(in) :: result, right
      !> The differences [-]
      real(wp) :: differences(4)

      differences(1) = largest_change(series_of(result, "film_thickness_min"), series_of(right, "film_thickness_min"))
      differences(2) = largest_change(series_of(result, "film_thickness_central"), series_of(right, "film_thickness_central"))
      differences(3) = abs(sum(series_of(result, "sliding_speed"))/sum(series_of(right, "sliding_speed")) - 1.0_wp)
      differences(4) = abs(scalar_of(result, "mean_torque_friction")/scalar_of(right, "mean_torque_friction") - 1.0_wp)
      differences = max(least_error, differences)
   end function run_differences

   !> Table of cycles, one row a trial.
   subroutine new_cycle_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call new_table(table, [quantity_t("model", "", "contacts solved over the cycle, or a film law", "study"), &
         & quantity_t("message", "", "what went wrong, or nothing", "study")], [ &
         & quantity_t("case", "1", "case of the sweep", "study"), &
         & quantity_t("nodes", "1", "nodes across the contact", "study"), &
         & quantity_t("step_error", "1", "error of a step asked for", "study"), &
         & quantity_t("error_film_min", "1", "largest error of the smallest film over its value", "study"), &
         & quantity_t("error_mean_film", "1", "error of the mean smallest film over its value", "study"), &
         & quantity_t("error_slip", "1", "error of the mean sliding speed over its value", "study"), &
         & quantity_t("error_friction", "1", "error of the mean torque for all losses of the follower over its value", "study"), &
         & quantity_t("steps", "1", "steps of the cycle", "study"), &
         & quantity_t("refused", "1", "steps refused", "study"), &
         & quantity_t("cycles", "1", "cycles until periodic", "study"), &
         & quantity_t("time", "s", "median time of the cycle", "study")])
   end subroutine new_cycle_table

   !> Contacts solved over the cycle, and a run with the film law and with a table, against the finest cycle.
   subroutine study_cycle(table, position, case, repeats, is_quick)
      !> Table of cycles
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Trials whose median time counts
      integer, intent(in) :: repeats
      !> A few trials only?
      logical, intent(in) :: is_quick

      type(model_t) :: model
      type(ehl_cycle_t) :: cycle
      type(error_t), allocatable :: error
      ! What is compared, shape (angle, quantity) [m], [m/s], [N m]; time [s]
      real(wp), allocatable :: right(:, :), values(:, :)
      real(wp) :: time
      integer :: i, k

      call plain_model(model, case, .false., error)
      if (.not. allocated(error)) call time_cycle(model, merge(quick_nodes, reference_nodes, is_quick), &
         & reference_step, 1, cycle, right, time, error)
      if (allocated(error)) then
         call add_row(table, words_of("", "reference: "//error%message), &
            & [real(position - 1, wp), nothing(10)])
         return
      end if
      do i = 1, merge(quick_trials, size(cycle_nodes), is_quick)
         do k = 1, merge(quick_trials, size(step_errors), is_quick)
            call time_cycle(model, cycle_nodes(i), step_errors(k), repeats, cycle, values, time, error)
            call add_cycle([real(cycle_nodes(i), wp), step_errors(k)])
         end do
      end do
      if (.not. is_quick) then
         call time_cycle(model, reference_nodes, step_errors(size(step_errors)), 1, cycle, values, time, error)
         call add_cycle([real(reference_nodes, wp), step_errors(size(step_errors))])
      end if
      call study_runs(table, position, case, repeats, right)

   contains

      !> Row of a cycle, or of what went wrong.
      subroutine add_cycle(choice)
         !> Nodes, error of a step [-]
         real(wp), intent(in) :: choice(2)

         if (allocated(error)) then
            call add_row(table, words_of("solved", error%message), &
               & [real(position - 1, wp), choice, nothing(8)])
         else
            call add_row(table, words_of("solved", ""), [real(position - 1, wp), choice, &
               & cycle_errors(values, right), real([size(cycle%angle), cycle%refused, cycle%turns], wp), time])
         end if
      end subroutine add_cycle
   end subroutine study_cycle

   !> Runs with the film law of the deck and with a table of numerical films.
   subroutine study_runs(table, position, case, repeats, right)
      !> Table of cycles
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Trials whose median time counts
      integer, intent(in) :: repeats
      !> What counts as right [m], [m/s], [N m]
      real(wp), intent(in) :: right(:, :)

      type(case_t) :: trial
      type(result_t) :: result
      type(error_t), allocatable :: error
      ! Values at the angles of the comparison [m], [m/s], [N m]; time [s]
      real(wp) :: values(angle_count, 3), time
      character(len=word_length) :: words(2)
      integer :: i

      trial = case
      if (allocated(trial%cam_bearings)) deallocate (trial%cam_bearings)
      trial%numerics%output_step = two_pi/angle_count
      do i = 1, 2
         if (allocated(trial%ehl)) deallocate (trial%ehl)
         words = words_of(case%film%law, "")
         if (i == 2) then
            words(1) = "numerical law"
            allocate (trial%ehl)
            if (allocated(case%ehl)) trial%ehl = case%ehl
         end if
         call time_run(trial, repeats, result, time, error)
         if (allocated(error)) then
            words(2) = error%message
            call add_row(table, words, [real(position - 1, wp), nothing(10)])
            cycle
         end if
         values(:, 1) = series_of(result, "film_thickness_min")
         values(:, 2) = series_of(result, "sliding_speed")
         values(:, 3) = series_of(result, "torque_friction")
         call add_row(table, words, [real(position - 1, wp), nothing(2), cycle_errors(values, right), nothing(3), time])
      end do
   end subroutine study_runs

   !> Errors of a cycle: largest and mean of the smallest film, mean sliding speed, mean torque for losses.
   pure function cycle_errors(values, right) result(errors)
      !> Films, sliding speeds, torques at the angles of the comparison, and what counts as right [m], [m/s], [N m]
      real(wp), intent(in) :: values(:, :), right(:, :)
      !> The errors [-]
      real(wp) :: errors(4)

      errors(1) = largest_change(values(:, 1), right(:, 1))
      errors(2:) = abs(sum(values, 1)/sum(right, 1) - 1.0_wp)
      errors = max(least_error, errors)
   end function cycle_errors

   !> Contacts solved over the cycle, what is compared of them, and the time it took.
   subroutine time_cycle(model, nodes, step_error, repeats, cycle, values, time, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Nodes
      integer, intent(in) :: nodes
      !> Error of a step [-]
      real(wp), intent(in) :: step_error
      !> Trials whose median time counts
      integer, intent(in) :: repeats
      !> The cycle
      type(ehl_cycle_t), intent(out) :: cycle
      !> Films, sliding speeds, torques at the angles of the comparison [m], [m/s], [N m]
      real(wp), allocatable, intent(out) :: values(:, :)
      !> Time [s]
      real(wp), intent(out) :: time
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(ehl_record_t) :: record
      ! Times of the trials [s]
      real(wp) :: times(max(repeats, 1))
      integer(int64) :: first, start
      integer :: i

      time = 0.0_wp
      call system_clock(first)
      do i = 1, size(times)
         call system_clock(start)
         call integrate_ehl_cycle(cycle, model, ehl_cycle_options_t(nodes=nodes, step_error=step_error), error)
         times(i) = seconds_since(start)
         if (allocated(error)) return
         if (seconds_since(first) > patience) exit
      end do
      time = median(times(:min(i, size(times))))
      call make_ehl_record(record, model, cycle)
      allocate (values(angle_count, 3))
      values(:, 1) = at_angles(record%angle, column(record, "film_min"))
      values(:, 2) = at_angles(record%angle, column(record, "sliding_speed"))
      values(:, 3) = at_angles(record%angle, column(record, "torque_friction"))
   end subroutine time_cycle

   !> Values at equally spaced angles, linear between those that are there.
   pure function at_angles(angles, values) result(row)
      !> Angles from full lift, increasing [rad]
      real(wp), intent(in) :: angles(:)
      !> Values there [any]
      real(wp), intent(in) :: values(:)
      !> Values at the angles of the comparison [any]
      real(wp) :: row(angle_count)

      ! Angle [rad], part of the way to the next one [-]
      real(wp) :: angle, part
      integer :: i, k

      k = 1
      do i = 1, angle_count
         angle = angles(1) + (i - 1)*two_pi/angle_count
         do while (k < size(angles) - 1 .and. angles(min(k + 1, size(angles))) < angle)
            k = k + 1
         end do
         part = (angle - angles(k))/(angles(k + 1) - angles(k))
         row(i) = values(k) + part*(values(k + 1) - values(k))
      end do
   end function at_angles

end module camroller_study_film
