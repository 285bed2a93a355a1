!> What accuracy costs: every method over a ladder of tolerances or steps, against a reference from two unrelated methods.
!>
!> Layer: solver. In: a case. Out: rows of `study_table_t`: errors, work, time. A trial that fails is a row with a message.
!>
!> The reference is a Rosenbrock solution; it counts only where an explicit Runge-Kutta solution, which shares nothing with it
!> but the equation, agrees to a tenth of the smallest error that the study shows.
module camroller_study
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, add_context, kind_convergence
   use camroller_case, only : case_t, numerics_t
   use camroller_number_text, only : number_text
   use camroller_result, only : quantity_t
   use camroller_run, only : build_models
   use camroller_model, only : model_t
   use camroller_report, only : output_angles
   use camroller_spin, only : spin_problem_t
   use camroller_study_errors, only : errors_t, errors_against, largest_error, total_variation
   use camroller_study_ladder, only : rung_t, make_ladder, numerics_of
   use camroller_study_probe, only : probe_t, run_probe, loss_names, loss_count
   use camroller_study_table, only : study_table_t, new_table, add_row
   implicit none
   private

   public :: reference_t, smallest_error, make_reference, check_reference, new_method_table, study_methods, largest_rate
   public :: new_reference_table, add_reference

   !> Smallest error shown; what is below counts as this much [-]
   real(wp), parameter :: smallest_error = 1.0e-8_wp
   !> The two solutions must agree to this part of it [-]
   real(wp), parameter :: agreement = 0.1_wp
   !> Two unrelated ways to integrate, far below the smallest error
   type(rung_t), parameter :: reference_rungs(*) = [rung_t("rodas5p", tolerance=1.0e-11_wp), &
      & rung_t("dormand_prince", tolerance=1.0e-13_wp)]
   !> Periodicity of a reference [-]
   real(wp), parameter :: reference_periodicity = 1.0e-10_wp

   !> What counts as right
   type :: reference_t
      !> The solution
      type(probe_t) :: probe
      !> How far the two solutions are apart [-]
      real(wp) :: disagreement = 0.0_wp
      !> Fastest decay of a disturbance over the cycle [1/rad]
      real(wp) :: fastest_decay = 0.0_wp
      !> Total variation of the slip ratio [-]
      real(wp) :: variation = 0.0_wp
   end type reference_t

contains

   !> Reference of a case; refuses where two unrelated methods disagree.
   subroutine make_reference(case, reference, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its reference
      type(reference_t), intent(out) :: reference
      !> Convergence error where the two solutions disagree, or what went wrong with one of them
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: trial
      type(probe_t) :: other

      trial = case
      trial%numerics = numerics_of(reference_rungs(1), case%numerics)
      trial%numerics%periodicity = min(case%numerics%periodicity, reference_periodicity)
      call run_probe(trial, 1, reference%probe)
      call pass_failure(reference%probe, trial%numerics, error)
      if (allocated(error)) return
      trial%numerics = numerics_of(reference_rungs(2), trial%numerics)
      call run_probe(trial, 1, other)
      call pass_failure(other, trial%numerics, error)
      if (allocated(error)) return
      reference%disagreement = largest_error(errors_against(reference%probe, other))
      call check_reference(reference%disagreement, error)
      if (allocated(error)) return
      reference%variation = total_variation(reference%probe%slip_ratio)
      call largest_rate(case, reference%probe%sliding_speed, reference%fastest_decay, error)
   end subroutine make_reference

   !> Refuse a reference whose two solutions disagree.
   subroutine check_reference(disagreement, error)
      !> How far they are apart [-]
      real(wp), intent(in) :: disagreement
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      if (disagreement <= agreement*smallest_error) return
      call raise(error, kind_convergence, "no reference: "//trim(reference_rungs(1)%method)//" and "// &
         & trim(reference_rungs(2)%method)//" differ by "//number_text(disagreement, 2)//", allowed is "// &
         & number_text(agreement*smallest_error, 2))
   end subroutine check_reference

   !> The failure of a trial as an error.
   subroutine pass_failure(probe, numerics, error)
      !> The trial
      type(probe_t), intent(in) :: probe
      !> How it was integrated
      type(numerics_t), intent(in) :: numerics
      !> Its error, if any
      type(error_t), allocatable, intent(out) :: error

      if (probe%status == 0) return
      call raise(error, probe%status, probe%message)
      call add_context(error, "reference by "//trim(numerics%method))
   end subroutine pass_failure

   !> Fastest decay of a disturbance of the spin at the output angles.
   subroutine largest_rate(case, sliding_speed, fastest, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Sliding speed at the output angles [m/s]
      real(wp), intent(in) :: sliding_speed(:)
      !> Fastest decay rate [1/rad]
      real(wp), intent(out) :: fastest
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable, target :: models(:)
      type(spin_problem_t) :: problem
      ! Output angles from full lift [rad]; decay rate there [1/rad]
      real(wp), allocatable :: angles(:)
      real(wp) :: rate
      integer :: i

      fastest = 0.0_wp
      call build_models(case, models, error)
      if (allocated(error)) return
      problem%model => models(1)
      angles = (output_angles(case%numerics%output_step) - 180.0_wp)*degree
      do i = 1, size(angles)
         call problem%get_decay_rate(angles(i), sliding_speed(i:i), rate)
         fastest = max(fastest, rate)
      end do
   end subroutine largest_rate

   !> Table of references, one row a case.
   subroutine new_reference_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call new_table(table, [quantity_t("message", "", "what went wrong, or nothing", "study")], [ &
         & quantity_t("case", "1", "case of the sweep", "study"), &
         & quantity_t("status", "1", "0, or the kind of the error", "study"), &
         & quantity_t("speed", "rad s-1", "cam speed", "operating_point"), &
         & quantity_t("oil_temperature", "K", "temperature of the oil", "operating_point"), &
         & quantity_t("disagreement", "1", "largest deviation between two unrelated methods", "study"), &
         & quantity_t("fastest_decay", "1", "largest decay rate of a disturbance of the spin, per radian of the cam", "roller"), &
         & quantity_t("largest_sliding_speed", "m s-1", "largest size of the sliding speed", "roller"), &
         & quantity_t("revolution_slip", "1", "part of its turns that the roller loses per cam revolution", "roller"), &
         & quantity_t("mean_torque_friction", "N m", "mean torque for all losses", "torque"), &
         & quantity_t("min_film_thickness", "m", "smallest film", "film")])
   end subroutine new_reference_table

   !> Row of a reference, or of what went wrong with it.
   subroutine add_reference(table, position, case, reference, failure)
      !> Table of references
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Its reference
      type(reference_t), intent(in) :: reference
      !> What went wrong
      type(error_t), allocatable, intent(in) :: failure

      ! Numbers of the row [unit of the column]
      real(wp) :: numbers(10)

      numbers = ieee_value(1.0_wp, ieee_quiet_nan)
      numbers(1) = position - 1
      numbers(2) = 0.0_wp
      numbers(3:4) = [case%operating_point%speed, case%operating_point%oil_temperature]
      if (allocated(failure)) then
         numbers(2) = failure%kind
         call add_row(table, [failure%message], numbers)
         return
      end if
      associate (probe => reference%probe)
         numbers(5:) = [reference%disagreement, reference%fastest_decay, maxval(abs(probe%sliding_speed)), &
            & probe%revolution_slip, probe%losses(loss_count), probe%film_min]
      end associate
      call add_row(table, [""], numbers)
   end subroutine add_reference

   !> Table of methods, one row a trial.
   subroutine new_method_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      type(quantity_t), allocatable :: losses(:)
      integer :: i

      allocate (losses(loss_count))
      do i = 1, loss_count
         losses(i) = quantity_t("error_torque_"//trim(loss_names(i)), "1", &
            & "error of the mean torque lost over its value, "//trim(loss_names(i)), "study")
      end do
      call new_table(table, [quantity_t("method", "", "way to integrate", "study"), &
         & quantity_t("message", "", "what went wrong, or nothing", "study")], [ &
         & quantity_t("case", "1", "case of the sweep", "study"), &
         & quantity_t("status", "1", "0, or the kind of the error", "study"), &
         & quantity_t("tolerance", "1", "error of the sliding speed aimed at, over its largest value", "study"), &
         & quantity_t("step", "degree", "fixed step", "study"), &
         & quantity_t("error_sliding_speed", "1", "largest error of the sliding speed over its largest value", "study"), &
         & losses, &
         & quantity_t("error_film_min", "1", "error of the smallest film over its value", "study"), &
         & quantity_t("estimated_error", "1", "error of the sliding speed as the program estimates it", "study"), &
         & quantity_t("variation", "1", "total variation of the slip ratio over that of the reference", "study"), &
         & quantity_t("rate_times_step", "1", "fastest decay rate times fixed step", "study"), &
         & quantity_t("evaluations", "1", "evaluations of the roller equation", "study"), &
         & quantity_t("jacobians", "1", "Jacobians", "study"), &
         & quantity_t("steps", "1", "accepted steps", "study"), &
         & quantity_t("rejected", "1", "rejected steps", "study"), &
         & quantity_t("cycles", "1", "cycles until periodic", "study"), &
         & quantity_t("time", "s", "median time for the periodic cycle and its sliding speeds", "study"), &
         & quantity_t("series_time", "s", "time for all series and means", "study")])
   end subroutine new_method_table

   !> Every method and every rung for a case.
   subroutine study_methods(table, position, case, reference, repeats, is_quick)
      !> Table of methods
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Its reference
      type(reference_t), intent(in) :: reference
      !> Runs whose median time counts
      integer, intent(in) :: repeats
      !> A few rungs only?
      logical, intent(in) :: is_quick

      type(rung_t), allocatable :: rungs(:)
      type(case_t) :: trial
      type(probe_t) :: probe
      integer :: i

      call make_ladder(rungs, is_quick)
      trial = case
      do i = 1, size(rungs)
         trial%numerics = numerics_of(rungs(i), case%numerics)
         call run_probe(trial, repeats, probe)
         call add_trial(table, position, rungs(i), reference, probe)
      end do
   end subroutine study_methods

   !> Row of a trial.
   subroutine add_trial(table, position, rung, reference, probe)
      !> Table of methods
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> How it was integrated
      type(rung_t), intent(in) :: rung
      !> What counts as right
      type(reference_t), intent(in) :: reference
      !> What came of it
      type(probe_t), intent(in) :: probe

      type(errors_t) :: errors
      ! Numbers of the row [unit of the column]; not a number [-]
      real(wp) :: numbers(size(table%number_columns)), nothing
      character(len=max(len(rung%method), len(probe%message))) :: words(2)

      nothing = ieee_value(1.0_wp, ieee_quiet_nan)
      words(1) = rung%method
      words(2) = probe%message
      numbers = nothing
      numbers(1:2) = [real(position - 1, wp), real(probe%status, wp)]
      if (rung%tolerance > 0.0_wp) numbers(3) = rung%tolerance
      if (rung%step > 0.0_wp) numbers(4) = rung%step/degree
      associate (values => numbers(5 + loss_count:))
         if (rung%step > 0.0_wp) values(5) = rung%step*reference%fastest_decay
         if (probe%status == 0) then
            errors = errors_against(reference%probe, probe)
            numbers(5) = max(errors%sliding_speed, smallest_error)
            numbers(6:5 + loss_count) = merge(max(errors%losses, smallest_error), nothing, probe%has_loss)
            values(2:4) = [max(errors%film_min, smallest_error), probe%estimated_error, &
               & total_variation(probe%slip_ratio)/max(reference%variation, tiny(1.0_wp))]
            associate (counters => probe%counters)
               values(6:) = [real(counters%evaluations, wp), real(counters%jacobians, wp), real(counters%accepted, wp), &
                  & real(counters%rejected, wp), real(probe%cycles, wp), probe%time, probe%series_time]
            end associate
         end if
      end associate
      call add_row(table, words, numbers)
   end subroutine add_trial

end module camroller_study
