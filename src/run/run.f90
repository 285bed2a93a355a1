!> One case from start to end: models, cycles, result.
!>
!> In: `case_t`. Out: `result_t`. No files, no printing, no state left behind.
module camroller_run
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, add_context, kind_convergence, cause_unknown
   use camroller_accuracy, only : is_checked, first_numerics, most_refinements, refine_tolerance, resolve_numerics, &
      & second_method, way_out
   use camroller_run_remarks, only : judge, judge_assumptions
   use camroller_catalogue, only : list_series
   use camroller_case, only : case_t, numerics_t, automatic_method
   use camroller_kept_models, only : kept_models_t, keep_models, recall_models
   use camroller_model, only : model_t, new_model, revise_model
   use camroller_effect_choice, only : wants_choice, choose_effects
   use camroller_effect_list, only : choice_t
   use camroller_effect_report, only : add_choice
   use camroller_cam_check, only : check_geometry
   use camroller_cycle, only : cycle_t, integrate_cycle
   use camroller_margins, only : margins_t
   use camroller_means, only : statistics_t
   use camroller_case_result, only : make_result, search_extremes, take_statistics
   use camroller_result, only : quantity_t, result_t
   use camroller_flexible_solution, only : train_method
   use camroller_running_in, only : aged_t, add_running_in, run_in
   use camroller_running_in_errors, only : add_hours_to_errors
   use camroller_running_in_remarks, only : judge_running_in
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
      type(case_t), intent(in) :: case
      !> Model of each lobe shape; without what is left out afterwards
      type(model_t), intent(inout) :: models(:)
      !> Does the result hold series?
      logical, intent(in) :: with_series
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
      type(case_t), intent(in) :: case
      !> Model of each lobe shape; out: with surfaces as they are after these hours
      type(model_t), intent(inout) :: models(:)
      !> Does the result hold series?
      logical, intent(in) :: with_series
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
      if (.not. allocated(case%running_in) .or. allocated(error)) return
      call add_running_in(case, models, aged, result)
      call add_hours_to_errors(result, error)
      if (.not. allocated(error)) call judge_running_in(case, result, error)
   end subroutine run_aged

   !> Run a case with all its effects.
   !>
   !> Where the estimated error of the sliding speed, of a mean or of an extreme is above the accuracy asked for, the cycles are
   !> integrated again with a smaller tolerance; with a flexible train, whose turns are many, only where that of load and sliding
   !> speed is, and the motion has a period. So they are with another method and another tolerance where they could not be. What a
   !> later try cannot do leaves the result of an earlier one, with a remark; without any figure that is right there is no result.
   subroutine run_listed(case, models, with_series, result, error)
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Does the result hold series?
      logical, intent(in) :: with_series
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
      if (allocated(case%dynamics)) then
         numerics = resolve_numerics(case%numerics)
         ! Else the way out by another method would be the same try again
         numerics%method = train_method(numerics)
      end if
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
      call judge_assumptions(case, result, error)
      if (.not. allocated(error)) call judge(case%numerics, result, error)
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
      type(case_t), intent(in) :: case
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
      ! Without a period a smaller tolerance leads along other turns, whose scatter is as large
      try%error = maxval(try%statistics%error, mask=[(may_be_refined(try%cycles(lobe)), lobe=1, size(models))])
      if (.not. allocated(case%dynamics)) try%error = max(try%error, maxval(try%statistics%mean_error))
   end subroutine integrate_models

   !> Does a smaller tolerance lead to the same cycle with a smaller error?
   pure function may_be_refined(cycle) result(verdict)
      type(cycle_t), intent(in) :: cycle
      !> Does it, as far as is known?
      logical :: verdict

      verdict = .true.
      if (allocated(cycle%flexible)) verdict = cycle%flexible%cycle%period > 0
   end function may_be_refined

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

      call new_model(model, case, lobe, error)
      if (.not. allocated(error)) call check_geometry(model, case%mechanism%grinding_wheel_radius, error)
      if (lobe == 2) call add_context(error, "second lift")
   end subroutine build_model

end module camroller_run
