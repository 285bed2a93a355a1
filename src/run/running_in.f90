!> Hours of running: growth of a tribofilm and wear of cam and roller, by integration over cycles.
!>
!> In: case, model. Out: the model with its surfaces as they are after these hours, the way there, an estimate of the error.
!>
!> A turn takes a fraction of a second, the surfaces change over minutes to hours: `surface_change.f90` solves the periodic cycle
!> for the surfaces as they are, and gives `dh/dt = a - b h` for each thickness and `dd/dt = w` for each depth.
!>
!> A step takes a, b and w as constant at first, solves these equations exactly, evaluates the cycle at the end, and solves them
!> again with the means of a, b and w over both ends: second order in the change of the coefficients, exact where there is none,
!> and stable for any step. Each step is taken whole and in two halves, which are kept. The difference is three times their error
!> where coefficients change slowly, and their error where they change within a small part of the step: it is taken for it.
!>
!> Errors of thicknesses are relative to the largest possible one, those of depths to what will be worn in all: until the end, what
!> is worn so far and what the present rates add to it. A step may have a part of the accuracy that is left: its part of the time
!> that is left, the change of the film in it over its largest thickness, or a hundredth. Only films act back: a change of them has
!> its part of the accuracy however short it is, jumps of rates have the hundredth, and the sum stays below the accuracy. Growth
!> and removal make differences decay, so that the sum of these errors is an estimate from above of that at the end. Where rates of
!> wear fall so much that the accuracy is used up, all is integrated again with half of what was foreseen.
!>
!> What the error of the slip does to a rate comes on top: twice the difference of the surfaces by the rates at the end and by those
!> of a cycle at a tenth of the tolerance, which covers it where that cycle has at most half the error.
module camroller_running_in
   use camroller_kinds, only : wp, two_pi
   use camroller_accuracy, only : resolve_numerics
   use camroller_cam_surface, only : cam_surface_t, set_cam
   use camroller_case, only : case_t
   use camroller_error, only : error_t, add_context, raise, kind_convergence, kind_deck, kind_domain
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text
   use camroller_tribofilm, only : running_in_t
   use camroller_catalogue, only : lobe_prefix
   use camroller_result, only : append_history, append_quantity, lobe_scope, quantity_list_t, quantity_t, result_t, scope_length
   use camroller_surface_change, only : change_rates, differences, expected_scales, missed_between, move_surfaces, plan_t, &
      & rates_t, relative, set_surface, solved_t, surfaces_t
   implicit none
   private

   public :: run_in, add_running_in, aged_t

   !> Times at which the way is listed, the first and the last included
   integer, parameter :: history_rows = 41

   !> What hours of running make of a model
   type :: aged_t
      !> Estimated error of thickness and depth at the places of the cam and on the roller, relative to the largest possible
      !> thickness and to the largest depth [-]
      real(wp) :: error = 0.0_wp
      !> The same between the places of the cam, where a curve through them has no value that was computed [-]
      real(wp) :: between = 0.0_wp
      !> Steps
      integer :: steps = 0
      !> Cycles that were solved
      type(solved_t) :: solved
      !> The way: a row for each of the times of `history_rows` [unit of each quantity]
      real(wp), allocatable :: history(:, :)
   end type aged_t

   !> First step over all of the time, and a rest of it that is no step; largest factor from one step to the next, and what a step
   !> is shortened by against the one that would just do; part of the accuracy that is left which any step may have [-]
   real(wp), parameter :: first_part = 0.02_wp, no_part = 1.0e-10_wp, largest_growth = 4.0_wp, safety = 0.8_wp, least_part = 0.01_wp
   !> Relaxation of a film in a turn from where on surfaces change within it; accuracy left over time left that is none [-]
   real(wp), parameter :: fast_part = 0.1_wp, hardly = 0.01_wp
   !> An hour [s]
   real(wp), parameter :: hour = 3600.0_wp

contains

   !> Run a model in.
   subroutine run_in(case, model, aged, error)
      !> The case, with hours of running
      type(case_t), intent(in) :: case
      !> Model of a lobe shape; out: with its surfaces after these hours
      type(model_t), intent(inout) :: model
      !> The way there
      type(aged_t), intent(out) :: aged
      !> Deck error for an accuracy that is not positive; domain error where surfaces change within a turn, or a flexible train does
      !> not repeat itself; convergence error without a periodic cycle
      type(error_t), allocatable, intent(out) :: error

      type(plan_t) :: plan
      type(surfaces_t) :: now
      type(rates_t) :: rates

      if (.not. case%running_in%accuracy > 0.0_wp) then
         call raise(error, kind_deck, "running_in.accuracy must be positive")
         return
      end if
      call make_plan(case, model, plan)
      associate (n => plan%running%places + 1)
         allocate (now%film(n), now%wear(n), source=0.0_wp)
      end associate
      call change_rates(plan, model, now, rates, aged%solved, error)
      if (.not. allocated(error)) call march(plan, model, now, rates, aged, error)
      if (.not. allocated(error)) call add_slip_error(plan, model, now, rates, aged, error)
      if (.not. allocated(error)) aged%between = relative(missed_between(now), expected_scales(plan, now, rates, 0.0_wp))
      call add_context(error, "running in")
   end subroutine run_in

   !> Add what the error of the slip does to the surfaces.
   subroutine add_slip_error(plan, model, now, rates, aged, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      type(model_t), intent(inout) :: model
      !> Surfaces at the end, and their rates
      type(surfaces_t), intent(in) :: now
      type(rates_t), intent(in) :: rates
      !> Gets the error
      type(aged_t), intent(inout) :: aged
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Tolerance of the other cycle over that of the first; error over the difference of both, where the other has half of it [-]
      real(wp), parameter :: finer = 0.1_wp, covering = 2.0_wp
      type(plan_t) :: fine
      type(rates_t) :: others
      type(surfaces_t) :: bare, one, other

      fine = plan
      fine%numerics = resolve_numerics(plan%numerics)
      fine%numerics%tolerance = finer*fine%numerics%tolerance
      call change_rates(fine, model, now, others, aged%solved, error)
      if (allocated(error)) return
      bare = now
      bare%film = 0.0_wp
      bare%wear = 0.0_wp
      call move_surfaces(bare, rates, rates, plan%running%duration, one)
      call move_surfaces(bare, others, others, plan%running%duration, other)
      aged%error = aged%error + covering*relative(differences(one, other), expected_scales(plan, other, others, 0.0_wp))
   end subroutine add_slip_error

   !> What is given, and the model with its surfaces as they are at first.
   subroutine make_plan(case, model, plan)
      type(case_t), intent(in) :: case
      !> Its model; out: with surfaces
      type(model_t), intent(inout) :: model
      !> What the running-in is made of
      type(plan_t), intent(out) :: plan

      integer :: i

      plan%running = case%running_in
      plan%numerics = case%numerics
      plan%temperature = case%operating_point%oil_temperature
      if (allocated(case%wear)) plan%wear = case%wear
      allocate (model%surface)
      call set_cam(model%surface, [(0.0_wp, i=1, plan%running%places)], [(0.0_wp, i=1, plan%running%places)])
      if (.not. allocated(case%tribofilm)) return
      plan%film = case%tribofilm
      model%surface%roughness_ratio = plan%film%roughness_ratio
      model%surface%largest_thickness = plan%film%largest_thickness
      if (allocated(model%boundary)) model%boundary%film_coefficient = plan%film%coefficient
   end subroutine make_plan

   !> Integrate over the hours.
   subroutine march(plan, model, now, rates, aged, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; out: with its surfaces at the end
      type(model_t), intent(inout) :: model
      !> Surfaces at first; out: at the end
      type(surfaces_t), intent(inout) :: now
      !> Their rates at first; out: at the end
      type(rates_t), intent(inout) :: rates
      !> The way
      type(aged_t), intent(inout) :: aged
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(surfaces_t) :: fresh
      type(rates_t) :: fresh_rates
      ! Largest thickness, depths of cam and roller to which errors are relative at most [m]
      real(wp) :: scales(3)
      logical :: is_used_up

      fresh = now
      fresh_rates = rates
      scales = [plan%film%largest_thickness, huge(1.0_wp), huge(1.0_wp)]
      do
         now = fresh
         rates = fresh_rates
         call march_until_used_up(plan, model, scales, now, rates, aged, is_used_up, error)
         if (allocated(error) .or. .not. is_used_up) return
      end do
   end subroutine march

   !> Integrate over the hours until the accuracy is used up.
   subroutine march_until_used_up(plan, model, scales, now, rates, aged, is_used_up, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; out: with its surfaces at the end
      type(model_t), intent(inout) :: model
      !> Largest thickness, depths of cam and roller to which errors are relative at most; out, where the accuracy is used up: half
      !> of the depths that are foreseen now [m]
      real(wp), intent(inout) :: scales(3)
      !> Surfaces and their rates at first; out: at the end
      type(surfaces_t), intent(inout) :: now
      type(rates_t), intent(inout) :: rates
      !> The way
      type(aged_t), intent(inout) :: aged
      !> Whether errors became as large as they may be, or nearly so for the time that is left, since less is worn than was foreseen
      logical, intent(out) :: is_used_up
      !> Domain error where surfaces change within a turn, convergence error without a periodic cycle or with too short steps
      type(error_t), allocatable, intent(out) :: error

      type(surfaces_t) :: middle, next
      type(rates_t) :: at_middle, at_next
      ! Time, length of the step [s]; estimated errors of thickness and depths so far, of a step [m]
      real(wp) :: time, step, mistakes(3), mistake(3)
      ! Thickness and depths to which errors are relative [m]; part of the accuracy left that the step may have, error over it [-];
      ! largest part of the way to its balance that a film goes in a turn [-]
      real(wp) :: foreseen(3), share, ratio, relaxed
      logical :: is_last

      time = 0.0_wp
      step = first_part*plan%running%duration
      mistakes = 0.0_wp
      aged%steps = 0
      call note_rows(plan, model, time, time, now, rates, rates, aged)
      do
         is_last = time + step >= (1.0_wp - no_part)*plan%running%duration
         if (is_last) step = plan%running%duration - time
         call take_halves(plan, model, now, rates, step, middle, at_middle, next, mistake, aged%solved, error)
         if (allocated(error)) return
         associate (left => plan%running%duration - time)
            foreseen = min(scales, expected_scales(plan, next, at_middle, left - step))
            aged%error = relative(mistakes, foreseen)
            is_used_up = plan%running%accuracy - aged%error <= hardly*plan%running%accuracy*left/plan%running%duration
            if (is_used_up) then
               scales(2:) = 0.5_wp*foreseen(2:)
               return
            end if
            share = max(step/left, relative([1.0_wp, 0.0_wp, 0.0_wp]*differences(now, next), foreseen), least_part)
            ratio = relative(mistake, foreseen)/((plan%running%accuracy - aged%error)*share)
         end associate
         relaxed = two_pi/model%speed*maxval(max(rates%decay, at_middle%decay))
         if (ratio <= 1.0_wp .and. relaxed <= 1.0_wp) then
            call change_rates(plan, model, next, at_next, aged%solved, error)
            if (allocated(error)) return
            call note_rows(plan, model, time, time + 0.5_wp*step, now, rates, at_middle, aged)
            call note_rows(plan, model, time + 0.5_wp*step, time + step, middle, at_middle, at_next, aged)
            mistakes = mistakes + mistake
            aged%steps = aged%steps + 1
            time = time + step
            now = next
            rates = at_next
            if (is_last) exit
         else if (step < two_pi/model%speed .or. relaxed > 1.0_wp) then
            call refuse_step(plan%running, time, relaxed, aged%error, mistake/max(foreseen, tiny(ratio)), error)
            return
         end if
         ! The error of a step goes with the third power of its length
         step = step*min(largest_growth, max(1.0_wp/largest_growth, safety/max(ratio, tiny(ratio))**(1.0_wp/3.0_wp)))
      end do
      aged%error = relative(mistakes, expected_scales(plan, now, rates, 0.0_wp))
   end subroutine march_until_used_up

   !> Say why there is no step of a turn's length.
   subroutine refuse_step(running, time, relaxed, used, mistakes, error)
      !> What was asked for
      type(running_in_t), intent(in) :: running
      !> Time of the start of the step [s]
      real(wp), intent(in) :: time
      !> Largest part of the way to its balance that a film goes in a turn; accuracy used so far [-]
      real(wp), intent(in) :: relaxed, used
      !> Errors of the step: of thicknesses, of depths of the cam and of the roller, relative as the accuracy is [-]
      real(wp), intent(in) :: mistakes(3)
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: names(3) = [character(len=32) :: "the film's thickness", "the depth worn from the cam", &
         & "the depth worn from the roller"]

      if (relaxed > fast_part) then
         call raise(error, kind_domain, "surfaces change within a turn of the cam, over which they are taken as constant: "// &
            & "rates of growth or removal are too large")
      else
         call raise(error, kind_convergence, "running_in.accuracy = "//number_text(running%accuracy, 2)//" is too small: after "// &
            & number_text(time/hour, 3)//" of "//number_text(running%duration/hour, 3)//" h, with "// &
            & number_text(1.0e2_wp*used/running%accuracy, 2)//" % of it used up, the error of "// &
            & trim(names(maxloc(mistakes, 1)))//" asks for steps shorter than a turn of the cam")
      end if
   end subroutine refuse_step

   !> A step in two halves, and what their error is.
   subroutine take_halves(plan, model, now, rates, step, middle, at_middle, next, mistake, solved, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; its surfaces move
      type(model_t), intent(inout) :: model
      !> Surfaces and their rates at the start
      type(surfaces_t), intent(in) :: now
      type(rates_t), intent(in) :: rates
      !> Length of the step [s]
      real(wp), intent(in) :: step
      !> Surfaces in the middle and their rates, surfaces at the end
      type(surfaces_t), intent(out) :: middle, next
      type(rates_t), intent(out) :: at_middle
      !> Estimated errors of thicknesses, depths of the cam, depth of the roller [m]
      real(wp), intent(out) :: mistake(3)
      !> Cycles solved before; out: with these
      type(solved_t), intent(inout) :: solved
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(surfaces_t) :: whole

      call take_step(plan, model, now, rates, step, whole, solved, error)
      if (.not. allocated(error)) call take_step(plan, model, now, rates, 0.5_wp*step, middle, solved, error)
      if (.not. allocated(error)) call change_rates(plan, model, middle, at_middle, solved, error)
      if (.not. allocated(error)) call take_step(plan, model, middle, at_middle, 0.5_wp*step, next, solved, error)
      if (.not. allocated(error)) mistake = differences(whole, next)
   end subroutine take_halves

   !> A step of second order.
   subroutine take_step(plan, model, now, rates, step, next, solved, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; its surfaces move
      type(model_t), intent(inout) :: model
      !> Surfaces and their rates at the start
      type(surfaces_t), intent(in) :: now
      type(rates_t), intent(in) :: rates
      !> Length of the step [s]
      real(wp), intent(in) :: step
      !> Surfaces at the end
      type(surfaces_t), intent(out) :: next
      !> Cycles solved before; out: with these
      type(solved_t), intent(inout) :: solved
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(surfaces_t) :: guess
      type(rates_t) :: at_end

      call move_surfaces(now, rates, rates, step, guess)
      call change_rates(plan, model, guess, at_end, solved, error)
      if (.not. allocated(error)) call move_surfaces(now, rates, at_end, step, next)
   end subroutine take_step

   !> Rows of the history whose times lie in a piece of a step: surfaces as the step has them, means of the cycle along a straight
   !> line.
   subroutine note_rows(plan, model, from, to, now, first, last, aged)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model, for what goes with the surfaces
      type(model_t), intent(in) :: model
      !> Times of start and end [s]; the same for the very first row
      real(wp), intent(in) :: from, to
      !> Surfaces at the start
      type(surfaces_t), intent(in) :: now
      !> Rates at start and end
      type(rates_t), intent(in) :: first, last
      !> Gets the rows
      type(aged_t), intent(inout) :: aged

      type(cam_surface_t) :: surface
      type(surfaces_t) :: then
      type(quantity_t), allocatable :: quantities(:)
      ! Time of a row [s], part of the piece before it [-]
      real(wp) :: time, part
      integer :: row

      if (.not. allocated(aged%history)) then
         call list_history(quantities)
         allocate (aged%history(history_rows, size(quantities)), source=0.0_wp)
      end if
      surface = model%surface
      do row = 1, history_rows
         time = plan%running%duration*(row - 1)/(history_rows - 1)
         if (row == 1 .and. to > from) cycle
         if (row > 1 .and. .not. (time > from .and. (time <= to .or. (row == history_rows .and. to >= (1.0_wp &
            & - no_part)*plan%running%duration)))) cycle
         part = 0.0_wp
         if (to > from) part = (time - from)/(to - from)
         call move_surfaces(now, first, last, time - from, then)
         call set_surface(surface, then)
         aged%history(row, :) = history_row(time, surface, first%means + part*(last%means - first%means))
      end do
   end subroutine note_rows

   !> Add to a result what became of the surfaces of each lobe shape and its roller, and the way there.
   subroutine add_running_in(case, models, aged, result)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape, run in
      type(model_t), intent(in) :: models(:)
      !> The ways
      type(aged_t), intent(in) :: aged(:)
      !> The result
      type(result_t), intent(inout) :: result

      type(quantity_list_t) :: list, history
      type(quantity_t), allocatable :: quantities(:)
      character(len=:), allocatable :: prefix
      character(len=scope_length) :: scope
      ! Rows of the history [unit of each quantity]
      real(wp), allocatable :: rows(:, :)
      integer :: lobe, k

      list%count = size(result%summary)
      list%items = result%summary
      list%values = result%summary_values
      allocate (history%items(0), history%values(0), rows(history_rows, 0))
      call list_history(quantities)
      do lobe = 1, size(models)
         prefix = trim(lobe_prefix(lobe))
         scope = lobe_scope(lobe)
         associate (surface => models(lobe)%surface)
            if (allocated(case%tribofilm)) call append_quantity(list, prefix//"roller_film_thickness", "m", &
               & "thickness of the tribofilm on the roller", "running_in", surface%roller_film, scope)
            if (allocated(case%wear)) call append_quantity(list, prefix//"roller_wear_depth", "m", &
               & "depth worn away from the roller", "running_in", surface%roller_wear, scope)
            call append_quantity(list, prefix//"estimated_error_of_running_in", "1", "estimate of the largest error of a "// &
               & "thickness relative to the largest possible one, or of a depth relative to the largest, from the steps over "// &
               & "hours and the error of the slip, at the places of the cam", "running_in", aged(lobe)%error, scope)
            call append_quantity(list, prefix//"estimated_error_between_places", "1", "estimate of the same between places: "// &
               & "what a curve through every other place misses at those left out", "running_in", aged(lobe)%between, scope)
            call append_quantity(list, prefix//"running_in_steps", "1", "steps over the hours of running", "running_in", &
               & real(aged(lobe)%steps, wp), scope)
            call append_quantity(list, prefix//"running_in_cycles", "1", "cycles solved for these steps", "running_in", &
               & real(aged(lobe)%solved%count, wp), scope)
            do k = merge(1, 2, lobe == 1), size(quantities)
               call append_quantity(history, prefix//quantities(k)%name, quantities(k)%unit, quantities(k)%description, &
                  & quantities(k)%source, 0.0_wp, scope)
            end do
            rows = reshape([rows, aged(lobe)%history(:, merge(1, 2, lobe == 1):)], [history_rows, history%count])
         end associate
      end do
      call append_history(result, history%items(:history%count), rows)
      result%summary = list%items(:list%count)
      result%summary_values = list%values(:list%count)
   end subroutine add_running_in

   !> What the numbers of a row mean.
   subroutine list_history(quantities)
      type(quantity_t), allocatable, intent(out) :: quantities(:)

      type(quantity_list_t) :: list
      type(cam_surface_t) :: surface

      allocate (list%items(0), list%values(0))
      allocate (surface%cam_film(1), surface%cam_wear(1), source=0.0_wp)
      call add_all(list, 0.0_wp, surface, [0.0_wp, 0.0_wp, 0.0_wp])
      quantities = list%items(:list%count)
   end subroutine list_history

   !> A row.
   pure function history_row(time, surface, means) result(row)
      !> Time since the start [s]
      real(wp), intent(in) :: time
      !> Surfaces then
      type(cam_surface_t), intent(in) :: surface
      !> Means over the turn of friction torque [N m], of slip ratio and of coefficient [-]
      real(wp), intent(in) :: means(3)
      !> Numbers, in the order of `list_history` [unit of each]
      real(wp), allocatable :: row(:)

      type(quantity_list_t) :: list

      allocate (list%values(0))
      call add_all(list, time, surface, means)
      row = list%values(:list%count)
   end function history_row

   !> Numbers with their meaning.
   pure subroutine add_all(list, time, surface, means)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> Time since the start [s]
      real(wp), intent(in) :: time
      !> Surfaces then
      type(cam_surface_t), intent(in) :: surface
      !> Means over the turn of friction torque [N m], of slip ratio and of coefficient [-]
      real(wp), intent(in) :: means(3)

      associate (n => size(surface%cam_film))
         call append_quantity(list, "time", "s", "running time", "running_in", time)
         call append_quantity(list, "largest_cam_film", "m", "largest thickness of the tribofilm on the cam", "running_in", &
            & maxval(surface%cam_film))
         call append_quantity(list, "mean_cam_film", "m", "thickness of the tribofilm on the cam, mean over the cam angle", &
            & "running_in", sum(surface%cam_film)/n)
         call append_quantity(list, "roller_film", "m", "thickness of the tribofilm on the roller", "running_in", &
            & surface%roller_film)
         call append_quantity(list, "largest_cam_wear", "m", "largest depth worn away from the cam", "running_in", &
            & maxval(surface%cam_wear))
         call append_quantity(list, "mean_cam_wear", "m", "depth worn away from the cam, mean over the cam angle", "running_in", &
            & sum(surface%cam_wear)/n)
         call append_quantity(list, "roller_wear", "m", "depth worn away from the roller", "running_in", surface%roller_wear)
         call append_quantity(list, "mean_friction_torque", "N m", "friction torque of the follower, mean over the turn", &
            & "running_in", means(1))
         call append_quantity(list, "mean_slip_ratio", "1", "slip ratio, mean over the turn", "running_in", means(2))
         call append_quantity(list, "mean_boundary_coefficient", "1", "friction coefficient of the asperities, mean over the "// &
            & "turn", "running_in", means(3))
      end associate
   end subroutine add_all

end module camroller_running_in
