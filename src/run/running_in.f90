!> Hours of running: growth of a tribofilm and wear of cam and roller, by integration over cycles.
!>
!> In: case, model. Out: the model with its surfaces as they are after these hours, the way there, an estimate of the error.
!>
!> A turn takes a fraction of a second, the surfaces change over minutes to hours: within a turn they are held. Each evaluation
!> solves the periodic cycle for the surfaces as they are and takes from it, for each place, the time in contact, stress,
!> temperature and wear while it is; these make `dh/dt = a - b h` for thicknesses and `dd/dt = w` for depths. A place on the cam
!> meets the roller at its own cam angle alone. The roller creeps relative to the cam, so that a place on it has the mean over the
!> turn.
!>
!> A step takes a, b and w as constant at first, solves these equations exactly, evaluates the cycle at the end, and solves them
!> again with the means of a, b and w over both ends: second order in the change of the coefficients, exact where there is none,
!> and stable for any step. Each step is taken whole and in two halves; a third of the difference estimates the error of the halves,
!> which are kept. Steps are chosen such that this error is at most the accuracy times the part of the hours that the step covers.
!> Growth and removal make differences decay, so that the sum of these errors is an estimate from above of that at the end. What the
!> error of the slip does to a rate comes on top: the difference of the surfaces by the rates at the end and by those of a cycle at
!> ten times the tolerance, whose error is seven times as large on average and scatters.
module camroller_running_in
   use camroller_kinds, only : wp, two_pi
   use camroller_accuracy, only : resolve_numerics
   use camroller_case, only : case_t, numerics_t
   use camroller_cam_surface, only : cam_surface_t, place_angle
   use camroller_contact_forces, only : contact_t
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_error, only : error_t, add_context, raise, kind_convergence, kind_deck
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text
   use camroller_catalogue, only : lobe_prefix
   use camroller_result, only : append_quantity, lobe_scope, quantity_list_t, quantity_t, result_t, scope_length
   use camroller_running_history, only : history_row, history_rows, list_history
   use camroller_state, only : state_t
   use camroller_tribofilm, only : growth_rate, running_in_t, thickness_after, tribofilm_t
   use camroller_wear, only : time_in_contact, wear_t, worn_per_second
   implicit none
   private

   public :: run_in, add_running_in, aged_t

   !> Thicknesses and depths: places of the cam, then the roller
   type :: surfaces_t
      !> Thickness of film and worn depth [m]
      real(wp), allocatable :: film(:), wear(:)
   end type surfaces_t

   !> How surfaces change, in the same order
   type :: rates_t
      !> Growth of films, a [m/s], their decay, b [1/s], wear, w [m/s]
      real(wp), allocatable :: growth(:), decay(:), wear(:)
      !> Mean over the turn of friction torque [N m], of the slip ratio and of the coefficient of asperities [-]
      real(wp) :: means(3) = 0.0_wp
   end type rates_t

   !> What hours of running make of a model
   type :: aged_t
      !> Estimated error of thickness and depth, relative to the largest possible thickness and to the largest depth [-]
      real(wp) :: error = 0.0_wp
      !> Steps, and cycles that were solved
      integer :: steps = 0, cycles = 0
      !> The way: a row for each of the times of `history_rows` [unit of each quantity]
      real(wp), allocatable :: history(:, :)
   end type aged_t

   !> What a running-in is made of
   type :: plan_t
      type(running_in_t) :: running
      !> The film; zero rates where none grows
      type(tribofilm_t) :: film
      type(wear_t) :: wear
      type(numerics_t) :: numerics
      !> Temperature of the oil [K]
      real(wp) :: temperature = 0.0_wp
   end type plan_t

   !> First step and smallest step over all of the time; largest factor from one step to the next, and what a step is shortened by
   !> against the one that would just do [-]
   real(wp), parameter :: first_part = 0.02_wp, smallest_part = 1.0e-5_wp, largest_growth = 4.0_wp, safety = 0.8_wp

contains

   !> Run a model in.
   subroutine run_in(case, model, aged, error)
      !> The case, with hours of running
      type(case_t), intent(in) :: case
      !> Model of a lobe shape; out: with its surfaces after these hours
      type(model_t), intent(inout) :: model
      !> The way there
      type(aged_t), intent(out) :: aged
      !> Deck error for a flexible train; convergence error: no periodic cycle, or steps that became too small
      type(error_t), allocatable, intent(out) :: error

      type(plan_t) :: plan
      type(surfaces_t) :: now
      type(rates_t) :: rates

      if (allocated(model%flexible)) then
         call raise(error, kind_deck, "running-in needs a rigid train")
         return
      end if
      call make_plan(case, model, plan)
      associate (n => plan%running%places + 1)
         allocate (now%film(n), now%wear(n), source=0.0_wp)
      end associate
      call change_rates(plan, model, now, rates, aged%cycles, error)
      if (.not. allocated(error)) call march(plan, model, now, rates, aged, error)
      if (.not. allocated(error)) call add_slip_error(plan, model, now, rates, aged, error)
      call add_context(error, "running in")
   end subroutine run_in

   !> Add what the error of the slip does to the surfaces.
   subroutine add_slip_error(plan, model, now, rates, aged, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model
      type(model_t), intent(inout) :: model
      !> Surfaces at the end, and their rates
      type(surfaces_t), intent(in) :: now
      type(rates_t), intent(in) :: rates
      !> Gets the error
      type(aged_t), intent(inout) :: aged
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Tolerance of the other cycle over that of the first, its largest [-]
      real(wp), parameter :: coarser = 10.0_wp, largest = 0.1_wp
      type(plan_t) :: coarse
      type(rates_t) :: others
      type(surfaces_t) :: bare, one, other

      coarse = plan
      coarse%numerics = resolve_numerics(plan%numerics)
      coarse%numerics%tolerance = min(coarser*coarse%numerics%tolerance, largest)
      call change_rates(coarse, model, now, others, aged%cycles, error)
      if (allocated(error)) return
      bare = now
      bare%film = 0.0_wp
      bare%wear = 0.0_wp
      call move_surfaces(bare, rates, rates, plan%running%duration, one)
      call move_surfaces(bare, others, others, plan%running%duration, other)
      aged%error = aged%error + difference(plan, one, other)
   end subroutine add_slip_error

   !> What is given, and the model with its surfaces as they are at first.
   subroutine make_plan(case, model, plan)
      !> The case
      type(case_t), intent(in) :: case
      !> Its model; out: with surfaces
      type(model_t), intent(inout) :: model
      !> What the running-in is made of
      type(plan_t), intent(out) :: plan

      plan%running = case%running_in
      plan%numerics = case%numerics
      plan%temperature = case%operating_point%oil_temperature
      if (allocated(case%wear)) plan%wear = case%wear
      allocate (model%surface)
      allocate (model%surface%cam_film(plan%running%places), model%surface%cam_wear(plan%running%places), source=0.0_wp)
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

      type(surfaces_t) :: whole, middle, next
      type(rates_t) :: unused, at_middle, at_next
      ! Time, length of the step [s]; estimated error of the step over what it may be [-]
      real(wp) :: time, step, ratio
      ! Estimated error of the step [-]
      real(wp) :: mistake
      logical :: is_last

      time = 0.0_wp
      step = first_part*plan%running%duration
      call note_rows(plan, model, time, time, now, rates, rates, aged)
      do
         is_last = time + step >= (1.0_wp - 0.1_wp*smallest_part)*plan%running%duration
         if (is_last) step = plan%running%duration - time
         call take_step(plan, model, now, rates, step, whole, unused, aged%cycles, error)
         if (allocated(error)) return
         call take_step(plan, model, now, rates, 0.5_wp*step, middle, at_middle, aged%cycles, error)
         if (allocated(error)) return
         call change_rates(plan, model, middle, at_middle, aged%cycles, error)
         if (allocated(error)) return
         call take_step(plan, model, middle, at_middle, 0.5_wp*step, next, unused, aged%cycles, error)
         if (allocated(error)) return
         mistake = difference(plan, whole, next)/3.0_wp
         ratio = mistake*plan%running%duration/(plan%running%accuracy*step)
         if (ratio <= 1.0_wp) then
            call change_rates(plan, model, next, at_next, aged%cycles, error)
            if (allocated(error)) return
            call note_rows(plan, model, time, time + 0.5_wp*step, now, rates, at_middle, aged)
            call note_rows(plan, model, time + 0.5_wp*step, time + step, middle, at_middle, at_next, aged)
            aged%error = aged%error + mistake
            aged%steps = aged%steps + 1
            time = time + step
            now = next
            rates = at_next
            if (is_last) return
         end if
         ! The error of a step over its length goes with the square of the length
         step = step*min(largest_growth, max(1.0_wp/largest_growth, safety/sqrt(max(ratio, tiny(ratio)))))
         if (step < smallest_part*plan%running%duration) then
            call raise(error, kind_convergence, "steps became smaller than "//number_text(smallest_part, 2)//" of the "// &
               & "duration; running_in.accuracy may be below what the cycles have")
            return
         end if
      end do
   end subroutine march

   !> A step of second order.
   subroutine take_step(plan, model, now, rates, step, next, at_end, cycles, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; its surfaces move
      type(model_t), intent(inout) :: model
      !> Surfaces and their rates at the start
      type(surfaces_t), intent(in) :: now
      type(rates_t), intent(in) :: rates
      !> Length of the step [s]
      real(wp), intent(in) :: step
      !> Surfaces at the end, and rates near it
      type(surfaces_t), intent(out) :: next
      type(rates_t), intent(out) :: at_end
      !> Cycles solved, counted on
      integer, intent(inout) :: cycles
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(surfaces_t) :: guess

      call move_surfaces(now, rates, rates, step, guess)
      call change_rates(plan, model, guess, at_end, cycles, error)
      if (.not. allocated(error)) call move_surfaces(now, rates, at_end, step, next)
   end subroutine take_step

   !> Surfaces after a time with the means of two rates.
   pure subroutine move_surfaces(now, first, last, time, next)
      !> Surfaces at the start
      type(surfaces_t), intent(in) :: now
      !> The rates
      type(rates_t), intent(in) :: first, last
      !> The time [s]
      real(wp), intent(in) :: time
      !> Surfaces at the end
      type(surfaces_t), intent(out) :: next

      next%film = thickness_after(now%film, 0.5_wp*(first%growth + last%growth), 0.5_wp*(first%decay + last%decay), time)
      next%wear = now%wear + 0.5_wp*(first%wear + last%wear)*time
   end subroutine move_surfaces

   !> Largest difference of thicknesses over the largest possible one and of depths over the largest depth, cam and roller each.
   pure function difference(plan, one, other) result(largest)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The surfaces
      type(surfaces_t), intent(in) :: one, other
      !> The difference [-]
      real(wp) :: largest

      integer :: n

      n = size(one%film)
      largest = 0.0_wp
      if (plan%film%largest_thickness > 0.0_wp) largest = maxval(abs(one%film - other%film))/plan%film%largest_thickness
      if (any(other%wear(:n - 1) > 0.0_wp)) largest = max(largest, maxval(abs(one%wear(:n - 1) - other%wear(:n - 1))) &
         & /maxval(other%wear(:n - 1)))
      if (other%wear(n) > 0.0_wp) largest = max(largest, abs(one%wear(n) - other%wear(n))/other%wear(n))
   end function difference

   !> How surfaces change, from the periodic cycle with them.
   subroutine change_rates(plan, model, now, rates, cycles, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; out: with these surfaces
      type(model_t), intent(inout) :: model
      !> The surfaces
      type(surfaces_t), intent(in) :: now
      !> Their rates
      type(rates_t), intent(out) :: rates
      !> Cycles solved, counted on
      integer, intent(inout) :: cycles
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(cycle_t) :: cycle
      type(state_t) :: state
      integer :: i, n, hint

      n = plan%running%places
      call set_surface(model%surface, now)
      call integrate_cycle(cycle, model, plan%numerics, error)
      cycles = cycles + 1
      if (allocated(error)) return
      allocate (rates%growth(n + 1), rates%decay(n + 1), rates%wear(n + 1), source=0.0_wp)
      hint = 1
      do i = 1, n
         call state_at(cycle, model, place_angle(i, n), hint, state, error)
         if (allocated(error)) return
         rates%means(1) = rates%means(1) + state%torque_friction/n
         if (abs(state%contact%rolling_speed) > 0.0_wp) rates%means(2) = rates%means(2) + state%contact%sliding_speed &
            & /state%contact%rolling_speed/n
         rates%means(3) = rates%means(3) + state%contact%boundary_coefficient/n
         if (state%contact%is_touching) call add_place(plan, model, state%contact, i, rates)
      end do
   end subroutine change_rates

   !> What the contact at a cam angle does to its place on the cam, and its part in what the roller gets.
   pure subroutine add_place(plan, model, contact, place, rates)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Number of the place
      integer, intent(in) :: place
      !> Rates; out: with these
      type(rates_t), intent(inout) :: rates

      ! Parts of the time in contact, of the place on the cam and of any place of the roller [-]; turn of the cam [s]; growth and
      ! decay in contact [m/s], [1/s]
      real(wp) :: on_cam, on_roller, period, growth, decay

      associate (n => plan%running%places)
         period = two_pi/model%speed
         on_cam = time_in_contact(contact%half_width, contact%cam_surface_speed, period)
         on_roller = 2.0_wp*contact%half_width/(two_pi*model%roller_radius)/n
         rates%wear(place) = on_cam*worn_per_second(plan%wear%cam_rate, contact%asperity_load, contact%apparent_area, &
            & contact%sliding_speed)
         rates%wear(n + 1) = rates%wear(n + 1) + on_roller*worn_per_second(plan%wear%roller_rate, contact%asperity_load, &
            & contact%apparent_area, contact%sliding_speed)
         if (.not. plan%film%largest_thickness > 0.0_wp) return
         growth = growth_rate(plan%film, contact%traction/contact%apparent_area, plan%temperature + contact%flash_rise)
         decay = growth/plan%film%largest_thickness + plan%film%removal_rate
         rates%growth(place) = on_cam*growth
         rates%decay(place) = on_cam*decay
         rates%growth(n + 1) = rates%growth(n + 1) + on_roller*growth
         rates%decay(n + 1) = rates%decay(n + 1) + on_roller*decay
      end associate
   end subroutine add_place

   !> Give surfaces to a model.
   pure subroutine set_surface(surface, now)
      !> Those of the model
      type(cam_surface_t), intent(inout) :: surface
      !> The surfaces
      type(surfaces_t), intent(in) :: now

      integer :: n

      n = size(surface%cam_film)
      surface%cam_film = now%film(:n)
      surface%cam_wear = now%wear(:n)
      surface%roller_film = now%film(n + 1)
      surface%roller_wear = now%wear(n + 1)
   end subroutine set_surface

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
            & - 0.1_wp*smallest_part)*plan%running%duration)))) cycle
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
      integer :: lobe, k

      list%count = size(result%summary)
      list%items = result%summary
      list%values = result%summary_values
      allocate (history%items(0), history%values(0))
      call list_history(quantities)
      allocate (result%history_values(history_rows, 0))
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
               & "hours and the error of the slip", "running_in", aged(lobe)%error, scope)
            call append_quantity(list, prefix//"running_in_steps", "1", "steps over the hours of running", "running_in", &
               & real(aged(lobe)%steps, wp), scope)
            call append_quantity(list, prefix//"running_in_cycles", "1", "cycles solved for these steps", "running_in", &
               & real(aged(lobe)%cycles, wp), scope)
            do k = merge(1, 2, lobe == 1), size(quantities)
               call append_quantity(history, prefix//quantities(k)%name, quantities(k)%unit, quantities(k)%description, &
                  & quantities(k)%source, 0.0_wp, scope)
            end do
            result%history_values = reshape([result%history_values, aged(lobe)%history(:, merge(1, 2, lobe == 1):)], &
               & [history_rows, history%count])
         end associate
      end do
      result%history = history%items(:history%count)
      result%summary = list%items(:list%count)
      result%summary_values = list%values(:list%count)
   end subroutine add_running_in

end module camroller_running_in
