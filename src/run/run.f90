!> One case from start to end: models, cycles, result.
!>
!> In: `case_t`. Out: `result_t`. No files, no printing, no state left behind.
module camroller_run
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, add_context, kind_convergence, cause_unknown
   use camroller_accuracy, only : is_checked, has_tolerance, far_beyond, first_numerics, most_refinements, refine_tolerance, &
      & resolve_numerics, second_method, way_out
   use camroller_catalogue, only : list_series
   use camroller_case, only : case_t, numerics_t, automatic_method
   use camroller_kept_models, only : kept_models_t, keep_models, recall_models
   use camroller_model, only : model_t, new_model, revise_model
   use camroller_effect_choice, only : wants_choice, choose_effects
   use camroller_effect_list, only : choice_t
   use camroller_effect_report, only : add_choice
   use camroller_cam_check, only : check_geometry
   use camroller_cycle, only : cycle_t, integrate_cycle
   use camroller_number_text, only : number_text, fixed_text
   use camroller_margins, only : margins_t
   use camroller_means, only : statistics_t
   use camroller_report, only : make_result, search_extremes, take_statistics
   use camroller_remarks, only : add_remark, loose_tolerance, missed_accuracy, missed_extremes, missed_means, no_period
   use camroller_result, only : quantity_t, result_t, get_summary
   use camroller_running_in, only : aged_t, add_running_in, run_in
   implicit none
   private

   public :: run_case, run_next_case, build_models, build_model, take_way_out

   !> One try to integrate the cycles of a case
   type :: try_t
      !> Cycle of each lobe shape, its means and extremes, its margins
      type(cycle_t), allocatable :: cycles(:)
      type(statistics_t), allocatable :: statistics(:)
      type(margins_t), allocatable :: margins(:)
      !> Are the extremes there, and the margins?
      logical :: has_extremes = .false.
      !> Largest estimated error of a sliding speed or a mean [-]
      real(wp) :: error = 0.0_wp
   end type try_t

contains

   !> Run a case, with all its effects or with those that matter.
   subroutine run_case(case, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(out) :: result
      !> What went wrong, of any kind
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable :: models(:)

      call build_models(case, models, error)
      if (.not. allocated(error)) call run_chosen(case, models, .true., result, error)
   end subroutine run_case

   !> Run a case after others, whose models serve again where geometry, masses and spring are the same.
   subroutine run_next_case(kept, train, case, result, error, with_series)
      !> Models of the cases before
      type(kept_models_t), intent(inout) :: kept
      !> What distinguishes the case's geometry, masses and spring from those of the cases before
      character(len=*), intent(in) :: train
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(out) :: result
      !> What went wrong, of any kind
      type(error_t), allocatable, intent(out) :: error
      !> Does the result hold series at the output angles, as it does unless told otherwise? Its scalars are the same without them
      logical, intent(in), optional :: with_series

      type(model_t), allocatable :: models(:)
      logical :: has_series

      call recall_models(kept, train, case, models, error)
      if (allocated(error)) return
      if (.not. allocated(models)) then
         call build_models(case, models, error)
         if (allocated(error)) return
         call keep_models(kept, train, models)
      end if
      has_series = .true.
      if (present(with_series)) has_series = with_series
      call run_chosen(case, models, has_series, result, error)
   end subroutine run_next_case

   !> Run a case whose models are there.
   subroutine run_chosen(case, models, with_series, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape; without what is left out afterwards
      type(model_t), intent(inout) :: models(:)
      !> Does the result hold series?
      logical, intent(in) :: with_series
      !> Its result
      type(result_t), intent(out) :: result
      !> What went wrong, of any kind
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: chosen
      type(choice_t) :: choice
      integer :: lobe, shapes

      if (.not. wants_choice(case)) then
         call run_aged(case, models, with_series, result, error)
         return
      end if
      call choose_effects(case, models, chosen, choice, error)
      ! Without its camshaft bearings a case has one lobe shape
      shapes = merge(size(models), 1, allocated(chosen%second_lift))
      do lobe = 1, shapes
         if (.not. allocated(error)) call revise_model(models(lobe), chosen, error)
      end do
      if (.not. allocated(error)) call run_aged(chosen, models(:shapes), with_series, result, error)
      if (.not. allocated(error)) call add_choice(result, choice)
   end subroutine run_chosen

   !> Run a case with all its effects, after the hours of running that it has.
   subroutine run_aged(case, models, with_series, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape; out: with surfaces as they are after these hours
      type(model_t), intent(inout) :: models(:)
      !> Does the result hold series?
      logical, intent(in) :: with_series
      !> Its result
      type(result_t), intent(out) :: result
      !> What went wrong, of any kind
      type(error_t), allocatable, intent(out) :: error

      type(aged_t) :: aged(size(models))
      integer :: lobe

      if (allocated(case%running_in)) then
         do lobe = 1, size(models)
            call run_in(case, models(lobe), aged(lobe), error)
            if (allocated(error)) return
         end do
      end if
      call run_listed(case, models, with_series, result, error)
      if (allocated(case%running_in) .and. .not. allocated(error)) call add_running_in(case, models, aged, result)
   end subroutine run_aged

   !> Run a case with all its effects.
   !>
   !> Where the estimated error of the sliding speed, of a mean or of an extreme is above the accuracy asked for, the cycles are
   !> integrated again with a smaller tolerance; with a flexible train, whose turns are many, only where that of load and sliding
   !> speed is. So they are with another method and another tolerance where they could not be. What a later try cannot do leaves the
   !> result of an earlier one, with a remark; without any figure that is right there is no result.
   subroutine run_listed(case, models, with_series, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Does the result hold series?
      logical, intent(in) :: with_series
      !> Its result
      type(result_t), intent(out) :: result
      !> What went wrong, of any kind
      type(error_t), allocatable, intent(out) :: error

      type(numerics_t) :: numerics
      type(try_t) :: latest, earlier
      type(quantity_t), allocatable :: series(:)
      ! Smallest tolerance that may work [-]
      real(wp) :: least
      integer :: attempt
      logical :: has_result, has_way_out, is_finer

      call list_series(case, series)
      numerics = first_numerics(case%numerics)
      if (allocated(case%dynamics)) numerics = resolve_numerics(case%numerics)
      has_result = .false.
      has_way_out = .false.
      least = 0.0_wp
      do attempt = 0, most_refinements
         call integrate_models(case, series, models, numerics, latest, error)
         if (.not. allocated(error)) then
            call refine(case%numerics, attempt, latest%error, least, numerics, is_finer)
            ! Before the rest of the result is made
            if (.not. is_finer) then
               call search_extremes(case, series, models, latest%cycles, latest%statistics, latest%margins, error)
               if (.not. (allocated(error) .or. allocated(case%dynamics))) call refine(case%numerics, attempt, &
                  & maxval(latest%statistics%extreme_error), least, numerics, is_finer)
               latest%has_extremes = .not. allocated(error)
            end if
            if (is_finer) then
               call move_try(latest, earlier)
               cycle
            end if
            if (.not. allocated(error)) call make_result(case, series, models, latest%cycles, latest%margins, &
               & latest%statistics, with_series, result, error)
            has_result = .not. allocated(error)
            if (has_result) exit
         end if
         if (allocated(earlier%cycles) .or. has_way_out .or. error%kind /= kind_convergence .or. &
            & .not. is_checked(case%numerics)) exit
         call take_way_out(case%numerics, numerics, least, has_way_out)
         if (has_way_out .and. error%cause /= cause_unknown) exit
      end do
      if (.not. has_result) then
         if (.not. allocated(earlier%cycles)) return
         deallocate (error)
         if (.not. earlier%has_extremes) call search_extremes(case, series, models, earlier%cycles, earlier%statistics, &
            & earlier%margins, error)
         if (.not. allocated(error)) call make_result(case, series, models, earlier%cycles, earlier%margins, &
            & earlier%statistics, with_series, result, error)
         if (allocated(error)) return
      end if
      call judge(case%numerics, result, error)
   end subroutine run_listed

   !> Keep a try for the case that later ones fail.
   pure subroutine move_try(latest, earlier)
      !> The try; out: empty
      type(try_t), intent(inout) :: latest
      !> The same try
      type(try_t), intent(out) :: earlier

      call move_alloc(latest%cycles, earlier%cycles)
      call move_alloc(latest%statistics, earlier%statistics)
      call move_alloc(latest%margins, earlier%margins)
      earlier%has_extremes = latest%has_extremes
   end subroutine move_try

   !> Smaller tolerance for another try, where errors are above the accuracy and a smaller one is left.
   pure subroutine refine(given, attempt, estimate, least, numerics, is_finer)
      !> Numerics as given
      type(numerics_t), intent(in) :: given
      !> Number of the try, from 0
      integer, intent(in) :: attempt
      !> Largest error estimated, smallest tolerance that may work [-]
      real(wp), intent(in) :: estimate, least
      !> Numerics of the try; out: of the next
      type(numerics_t), intent(inout) :: numerics
      !> Is there another?
      logical, intent(out) :: is_finer

      ! Tolerance of the next try [-]
      real(wp) :: other

      is_finer = .false.
      if (.not. is_checked(given) .or. attempt == most_refinements .or. .not. estimate > given%accuracy) return
      other = refine_tolerance(numerics%tolerance, given%accuracy, estimate, least)
      is_finer = other < numerics%tolerance
      if (is_finer) numerics%tolerance = other
   end subroutine refine

   !> Estimated errors of a result: of the sliding speed, of the means, of the extremes.
   subroutine get_estimates(result, estimates, error)
      !> The result
      type(result_t), intent(in) :: result
      !> Errors [-]
      real(wp), intent(out) :: estimates(3)
      !> Usage error where they are not in the summary
      type(error_t), allocatable, intent(out) :: error

      call get_summary(result, "estimated_error", estimates(1), error)
      if (.not. allocated(error)) call get_summary(result, "estimated_error_of_means", estimates(2), error)
      if (.not. allocated(error)) call get_summary(result, "estimated_error_of_extremes", estimates(3), error)
   end subroutine get_estimates

   !> Numerics for another try where a cycle could not be integrated: another method, unless one is named, then another tolerance.
   pure subroutine take_way_out(given, numerics, least, has_way_out)
      !> Numerics as given
      type(numerics_t), intent(in) :: given
      !> Numerics of the try that failed; out: of the next
      type(numerics_t), intent(inout) :: numerics
      !> Smallest tolerance that may work [-]
      real(wp), intent(inout) :: least
      !> Is this the last resort?
      logical, intent(out) :: has_way_out

      ! Distance from a tolerance that was too small [-]
      real(wp), parameter :: few = 10.0_wp
      ! Tolerance of the next try [-]
      real(wp) :: other

      has_way_out = given%method /= automatic_method .or. numerics%method == second_method
      if (.not. has_way_out) then
         numerics%method = second_method
         return
      end if
      other = way_out(numerics%tolerance)
      if (other > numerics%tolerance) least = few*numerics%tolerance
      numerics%tolerance = other
   end subroutine take_way_out

   !> Integrate all lobe shapes.
   subroutine integrate_models(case, series, models, numerics, try, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its series
      type(quantity_t), intent(in) :: series(:)
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Method, tolerance, criterion
      type(numerics_t), intent(in) :: numerics
      !> Their cycles
      type(try_t), intent(out) :: try
      !> What went wrong, of any kind
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      allocate (try%cycles(size(models)))
      do lobe = 1, size(models)
         call integrate_cycle(try%cycles(lobe), models(lobe), numerics, error)
         if (allocated(error)) return
      end do
      call take_statistics(case, series, models, try%cycles, try%statistics, error)
      if (allocated(error)) return
      try%error = maxval(try%statistics%error)
      if (.not. allocated(case%dynamics)) try%error = max(try%error, maxval(try%statistics%mean_error))
   end subroutine integrate_models

   !> Remarks on errors that are too large.
   subroutine judge(numerics, result, error)
      !> Numerics as given
      type(numerics_t), intent(in) :: numerics
      !> The result
      type(result_t), intent(inout) :: result
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Estimated errors of sliding speed, means and extremes [-]
      real(wp) :: estimates(3)

      call get_estimates(result, estimates, error)
      if (allocated(error)) return
      if (is_checked(numerics)) call judge_accuracy(result, numerics%accuracy, estimates, error)
      if (has_tolerance(numerics)) call judge_tolerance(numerics, result, estimates)
   end subroutine judge

   !> Remarks on an accuracy that was not reached, or an error where nothing of the result can be right.
   subroutine judge_accuracy(result, accuracy, estimates, error)
      !> The result
      type(result_t), intent(inout) :: result
      !> Accuracy wanted [-]
      real(wp), intent(in) :: accuracy
      !> Estimated errors of sliding speed, means and extremes [-]
      real(wp), intent(in) :: estimates(3)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Cam angle where the estimate is largest [deg]
      real(wp) :: angle

      if (estimates(1) >= 1.0_wp) then
         call get_summary(result, "estimated_error_angle", angle, error)
         if (allocated(error)) return
         call raise(error, kind_convergence, "the cycle was not found: its estimated error is "//number_text(estimates(1), 2)// &
            & " of the sliding speed, largest at cam angle "//fixed_text(angle, 3)//" deg; the spin is hardly damped there, or "// &
            & "friction reaches its limit abruptly")
         return
      end if
      if (estimates(1) > accuracy) call add_remark(result%remarks, missed_accuracy, &
         & "the accuracy asked for was not reached; the estimated error is "//number_text(estimates(1), 2), estimates(1))
      if (estimates(2) > accuracy) call add_remark(result%remarks, missed_means, &
         & "the means did not reach the accuracy asked for; the largest estimated error, of mean_"//trim(result%worst_mean)// &
         & ", is "//number_text(estimates(2), 2), estimates(2))
      if (estimates(3) > accuracy .and. lacks_period(result)) then
         call say_no_period(result)
      else if (estimates(3) > accuracy) then
         call add_remark(result%remarks, missed_extremes, "the extremes did not reach the accuracy asked for; the largest "// &
            & "estimated error, of "//trim(result%worst_extreme)//", is "//number_text(estimates(3), 2)//" of its range", &
            & estimates(3))
      end if
   end subroutine judge_accuracy

   !> Is a train of the case without a period?
   pure function lacks_period(result) result(verdict)
      !> The result
      type(result_t), intent(in) :: result
      !> Is one?
      logical :: verdict

      integer :: i

      verdict = any([(result%remarks(i)%kind == no_period, i=1, size(result%remarks))])
   end function lacks_period

   !> Remark on extremes of a motion without a period: a smaller tolerance leads along other turns, and no accuracy changes that.
   subroutine say_no_period(result)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result

      call add_remark(result%remarks, missed_extremes, "smallest and largest values are those of the turns computed: without a "// &
         & "period they have no error that could be estimated")
   end subroutine say_no_period

   !> Remark on a tolerance given by hand that says nothing of the error: steps keep to it and the curve between them does not, or
   !> errors of steps pile up where hardly anything damps, or means follow the sliding speed too strongly.
   subroutine judge_tolerance(numerics, result, estimates)
      !> Numerics as given
      type(numerics_t), intent(in) :: numerics
      !> The result
      type(result_t), intent(inout) :: result
      !> Estimated errors of sliding speed, means and extremes [-]
      real(wp), intent(in) :: estimates(3)

      if (estimates(1) > numerics%tolerance*far_beyond) call say_far("the error", estimates(1))
      if (estimates(2) > numerics%tolerance*far_beyond) call say_far("the error of mean_"//trim(result%worst_mean), estimates(2))
      if (estimates(3) > numerics%tolerance*far_beyond .and. lacks_period(result)) then
         call say_no_period(result)
      else if (estimates(3) > numerics%tolerance*far_beyond) then
         call say_far("the error of the extremes of "//trim(result%worst_extreme), estimates(3))
      end if

   contains

      !> The remark on one of the errors.
      subroutine say_far(what, estimate)
         !> The error in words
         character(len=*), intent(in) :: what
         !> Its estimate [-]
         real(wp), intent(in) :: estimate

         call add_remark(result%remarks, loose_tolerance, "the tolerance "//number_text(numerics%tolerance, 2)// &
            & " does not control "//what//": its estimate is "//number_text(estimate, 2)// &
            & "; give 'accuracy' instead of 'tolerance'", estimate)
      end subroutine say_far

   end subroutine judge_tolerance

   !> Models of the lobe shapes of a case, geometry checked over the whole cycle.
   subroutine build_models(case, models, error)
      !> The case
      type(case_t), intent(in) :: case
      !> One model per lobe shape
      type(model_t), allocatable, intent(out) :: models(:)
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      allocate (models(merge(2, 1, allocated(case%second_lift))))
      do lobe = 1, size(models)
         call build_model(case, lobe, models(lobe), error)
         if (allocated(error)) return
      end do
   end subroutine build_models

   !> Model of one of the lobe shapes of a case, geometry checked over the whole cycle.
   subroutine build_model(case, lobe, model, error)
      !> The case
      type(case_t), intent(in) :: case
      !> 1 for the lift, 2 for the second lift, which must be there
      integer, intent(in) :: lobe
      !> The model
      type(model_t), intent(out) :: model
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      if (lobe == 1) then
         call new_model(model, case, case%lift, error)
      else
         call new_model(model, case, case%second_lift, error)
      end if
      if (.not. allocated(error)) call check_geometry(model, case%mechanism%grinding_wheel_radius, error)
      if (lobe == 2) call add_context(error, "second lift")
   end subroutine build_model

end module camroller_run
