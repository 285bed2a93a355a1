!> The cam cycle with a transient film.
!>
!> In: model, accuracy. Out: film, load share, sliding speed at every accepted angle, with profiles on request. The step size is
!> controlled: film and sliding speed are compared with their extrapolation from the previous steps. Steps end where lift, valve
!> or contact have a kink, so that no event is stepped over. Cycles are repeated until start and end agree. After a loss of
!> contact the film is computed without previous states.
module camroller_ehl_cycle
   use camroller_balance, only : least_slip
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, kind_convergence, kind_domain
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_events, only : find_stops_between
   use camroller_spin, only : rolling_speed_at
   use camroller_state, only : evaluate_loading
   use camroller_ehl_grid, only : new_ehl_grid
   use camroller_ehl_problem, only : ehl_problem_t, new_ehl_problem, asperity_reach, in_range, range_text
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_reynolds, only : new_ehl_fields
   use camroller_ehl_step, only : moment_t, ehl_march_t, make_step, contact_at, has_turned, thickening, max_rounds
   implicit none
   private

   public :: ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle, prepare_march

   !> How to integrate
   type :: ehl_cycle_options_t
      !> Nodes across the contact
      integer :: nodes = 129
      !> Error of a step, of the film over itself and of the sliding speed over that of rolling [-]
      real(wp) :: step_error = 1.0e-3_wp
      !> Does the film remember?
      logical :: is_transient = .true.
      !> Are profiles kept?
      logical :: keeps_profiles = .false.
   end type ehl_cycle_options_t

   !> The cycle
   type :: ehl_cycle_t
      !> Accepted angles from full lift [rad], what was found there
      real(wp), allocatable :: angle(:)
      type(moment_t), allocatable :: moments(:)
      !> Nodes [half widths]; pressure [Pa], film [m] and, of warm contacts, rise of its temperature [K] there at the accepted
      !> angles, on request
      real(wp), allocatable :: nodes(:), pressure(:, :), film(:, :), film_rise(:, :)
      !> Work: steps tried, of them refused, rounds of film and forces, cycles
      integer :: tried = 0, refused = 0, rounds = 0, turns = 1
   end type ehl_cycle_t

   !> First angle of the cycle and run-up before it [rad]
   real(wp), parameter :: start = -pi, run_up = 20.0_wp*degree
   !> First, longest and shortest step, and that below which the error is the noise of the nodes that the end of the film passes
   !> [rad]
   real(wp), parameter :: first_step = 0.1_wp*degree, longest_step = degree, shortest_step = 1.0e-6_wp*degree, &
      & smooth_step = 2.0e-3_wp*degree
   !> Two angles that are the same [rad]; part of a piece between two stops that its first step takes at most [-]
   real(wp), parameter :: angle_tolerance = 1.0e-12_wp, least_part = 0.0625_wp
   !> Difference of start and end over the error of a step [-]; cycles to give up after
   real(wp), parameter :: periodicity = 3.0_wp
   integer, parameter :: most_turns = 10
   !> Damping at the end of a cycle over that at its start, below which the next cycle is another [-]
   real(wp), parameter :: least_damping = 0.5_wp
   !> Growth of a step: safety, most and least; what counts as error of a step with nothing to compare with [-]
   real(wp), parameter :: safety = 0.85_wp, most_growth = 2.0_wp, least_growth = 0.2_wp, unknown_excess = 0.2_wp
   !> Sliding speed below which errors are measured by the largest of the cycle so far [m/s]
   real(wp), parameter :: small_slip = 1.0e-3_wp
   !> Thinnest film of a cycle over b^2/R from which on the spike of the pressure, where there is one, is about the middle [-]
   real(wp), parameter :: rigid_film = 1.0_wp
   !> Part of the error of a step that may be left of the sliding speed when film and forces agree [-]
   real(wp), parameter :: round_part = 1.0e-2_wp
   !> More steps than a cycle takes
   integer, parameter :: most_steps = 20000

contains

   !> Integrate one cycle.
   subroutine integrate_ehl_cycle(cycle, model, options, error)
      !> The cycle
      type(ehl_cycle_t), intent(out) :: cycle
      !> The model
      type(model_t), intent(in) :: model
      !> How
      type(ehl_cycle_options_t), intent(in) :: options
      !> Domain error beyond the range of solutions, convergence error where no step succeeds
      type(error_t), allocatable, intent(out) :: error

      type(ehl_march_t) :: march
      type(ehl_state_t) :: state, saved
      type(moment_t) :: history(3), now
      ! Step [rad]; its error over what is allowed [-]; what errors of the sliding speed are measured by [m/s]
      real(wp) :: step, excess, scale
      ! Angles that end a step [rad]
      real(wp), allocatable :: stops(:)
      integer :: known
      logical :: converged

      call prepare_march(march, model, options, error)
      if (allocated(error)) return
      call find_stops_between(model, start - run_up, start + two_pi, stops)
      stops = [stops, start]
      call start_history(model, march, state, history(1), error)
      if (allocated(error)) return
      allocate (cycle%moments(0))
      scale = max(abs(history(1)%sliding_speed), least_slip*march%largest_rolling)
      known = 1
      step = first_step
      do while (cycle%tried < most_steps)
         cycle%tried = cycle%tried + 1
         saved = state
         step = bounded_step(min(step, longest_step), history(1)%angle, stops)
         march%slip_tolerance = round_part*options%step_error*scale
         call make_step(model, march, history(:min(known, 2)), history(1)%angle + step, state, now, converged)
         excess = huge(1.0_wp)
         if (converged) excess = step_excess(history(:known), now, scale, options%step_error)
         cycle%rounds = cycle%rounds + now%rounds
         if (.not. converged .or. (excess > 1.0_wp .and. step > smooth_step)) then
            cycle%refused = cycle%refused + 1
            state = saved
            step = step*merge(max(least_growth, safety*excess**(-1.0_wp/3.0_wp)), least_growth, converged)
            if (step < shortest_step) exit
            cycle
         end if
         if (now%has_film .neqv. history(1)%has_film) known = 0
         if (known == 0) step = min(step, first_step)
         history(2:3) = history(1:2)
         history(1) = now
         scale = max(scale, abs(now%sliding_speed))
         known = min(known + 1, 3)
         if (now%angle > start - angle_tolerance) call keep(cycle, march%grid%size, state, now, options%keeps_profiles)
         if (now%angle >= start + two_pi - angle_tolerance) then
            if (is_periodic(cycle%moments, options%step_error) .or. cycle%turns >= most_turns) exit
            cycle%turns = cycle%turns + 1
            call begin_again(cycle)
            history%angle = history%angle - two_pi
            call keep(cycle, march%grid%size, state, history(1), options%keeps_profiles)
         end if
         step = step*min(most_growth, safety*max(excess, 1.0e-6_wp)**(-1.0_wp/3.0_wp))
         if (any(abs(stops - now%angle) <= angle_tolerance)) step = min(step, step_after(now%angle, stops))
      end do
      cycle%angle = cycle%moments%angle
      cycle%nodes = march%grid%x
      call judge(cycle, history(1), now, options, error)
   end subroutine integrate_ehl_cycle

   !> A step that ends at the next stop where it would pass it, and half-way where it would leave a short piece.
   pure function bounded_step(wanted, angle, stops) result(step)
      !> The step wanted, its start [rad]
      real(wp), intent(in) :: wanted, angle
      !> Angles that end a step, in any order [rad]
      real(wp), intent(in) :: stops(:)
      !> The step [rad]
      real(wp) :: step

      ! What is left to the next stop [rad]
      real(wp) :: room

      room = minval(stops, mask=stops > angle + angle_tolerance) - angle
      step = wanted
      if (step > 0.5_wp*room) step = merge(room, 0.5_wp*room, step >= room)
   end function bounded_step

   !> Longest step after a stop, short enough for what lasts until the next one to be seen.
   pure function step_after(angle, stops) result(step)
      !> Where it starts, at a stop [rad]
      real(wp), intent(in) :: angle
      !> Angles that end a step, in any order [rad]
      real(wp), intent(in) :: stops(:)
      !> The step [rad]
      real(wp) :: step

      step = first_step
      if (any(stops > angle + angle_tolerance)) step = min(step, least_part*(minval(stops, mask=stops > angle + angle_tolerance) &
         & - angle))
   end function step_after

   !> Is the cycle complete and periodic?
   subroutine judge(cycle, reached, last, options, error)
      type(ehl_cycle_t), intent(in) :: cycle
      !> Last contact reached
      type(moment_t), intent(in) :: reached
      !> Last contact tried
      type(moment_t), intent(in) :: last
      !> How it was integrated
      type(ehl_cycle_options_t), intent(in) :: options
      !> Convergence error where it is not
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: reason

      if (last%status /= in_range) then
         call raise(error, kind_domain, "ehl: "//trim(range_text(last%status))//" at "//cam_angle_text(reached%angle, 3))
      else if (cycle%tried >= most_steps .or. last%angle < start + two_pi - angle_tolerance) then
         reason = "no film was found"
         if (cycle%tried >= most_steps) reason = "the cycle takes too many steps"
         if (last%rounds == max_rounds .and. options%is_transient) reason = "no balance of load and friction was found"
         if (last%rounds == max_rounds .and. .not. options%is_transient) reason = "the balance of load and friction, "// &
            & "where the spike of the pressure is narrower than the nodes, jumps with steady films (a film with squeeze does not)"
         if (options%is_transient .and. has_turned(last, reached)) reason = "the roller runs backwards so fast that oil begins "// &
            & "to be drawn in from the other side, which a film with squeeze does not follow (ehl.profiles = .true. has "// &
            & "steady films of a run)"
         call raise(error, kind_convergence, "ehl: the step size fell below its minimum at "// &
            & cam_angle_text(reached%angle, 3)//": "//reason)
      else if (.not. is_periodic(cycle%moments, options%step_error)) then
         call raise(error, kind_convergence, "ehl: the cycle did not become periodic")
      end if
   end subroutine judge

   !> Do start and end of a cycle agree as far as its steps are right? Where a cycle leaves a part of what the sliding speed
   !> was off, the change over the cycle is only the rest of it, and where it ends
   !> with less damping than it began, friction being at its limit, what it leaves is not known yet.
   pure function is_periodic(moments, allowed) result(periodic)
      !> Moments of the cycle
      type(moment_t), intent(in) :: moments(:)
      !> Error of a step [-]
      real(wp), intent(in) :: allowed
      !> True where they do
      logical :: periodic

      ! Part of a change of the sliding speed that a cycle leaves [-]
      real(wp) :: left

      associate (first => moments(1), last => moments(size(moments)), n => size(moments))
         left = exp(-max(0.0_wp, 0.5_wp*dot_product(moments(2:)%damping + moments(:n - 1)%damping, &
            & moments(2:)%angle - moments(:n - 1)%angle)))
         periodic = abs(last%films%minimum - first%films%minimum) <= periodicity*allowed*first%films%minimum .and. &
            & abs(last%sliding_speed - first%sliding_speed) <= periodicity*allowed*(1.0_wp - left) &
            & *maxval(abs(moments%sliding_speed)) .and. last%damping >= least_damping*first%damping
      end associate
   end function is_periodic

   !> Forget a cycle that was not periodic.
   subroutine begin_again(cycle)
      type(ehl_cycle_t), intent(inout) :: cycle

      deallocate (cycle%moments)
      allocate (cycle%moments(0))
      if (.not. allocated(cycle%pressure)) return
      deallocate (cycle%pressure, cycle%film)
   end subroutine begin_again

   !> Nodes that serve every angle, and the largest load.
   subroutine prepare_march(march, model, options, error)
      !> What stays over the cycle
      type(ehl_march_t), intent(out) :: march
      !> The model
      type(model_t), intent(in) :: model
      !> How
      type(ehl_cycle_options_t), intent(in) :: options
      !> Domain error beyond the range of solutions
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      type(moments_t) :: moments
      type(ehl_problem_t) :: problem
      ! Load without friction [N], gas force [N]; thinnest and thickest expected film [-]; length in which a gap doubles, and within
      ! which asperities touch [half widths]
      real(wp) :: load, force, films(2), parabola, touching
      integer :: i, status, pass

      if (allocated(model%axial)) call raise(error, kind_domain, "a numerical film over the cycle knows no roller profile; "// &
         & "leave out &roller_profile")
      if (allocated(error)) return
      march%is_transient = options%is_transient
      films = [huge(1.0_wp), 0.0_wp]
      touching = 0.0_wp
      do pass = 1, 2
         do i = 1, 180
            call evaluate_loading(model, 2.0_wp*i*degree, position, force, moments, status)
            if (status /= 0) cycle
            load = moments%total/position%normal_arm
            if (model%takes_maximum_load) load = max(load, model%base_circle_load)
            if (pass == 1) march%largest_rolling = max(march%largest_rolling, abs(rolling_speed_at(model, position)))
            if (pass == 1) march%largest_load = max(march%largest_load, load)
            if (pass == 1) cycle
            call new_ehl_problem(problem, contact_at(model, march, position, moment_t(load=load)), status)
            if (status /= in_range) then
               call raise(error, kind_domain, "ehl: "//trim(range_text(status))//" at "// &
                  & cam_angle_text(2.0_wp*i*degree, 3))
               return
            end if
            films = [min(films(1), problem%expected_film), max(films(2), problem%expected_film*thickening(march, load))]
            touching = max(touching, asperity_reach(problem))
         end do
      end do
      parabola = sqrt(films(2))
      call new_ehl_grid(march%grid, options%nodes, max(16.0_wp, 24.0_wp*parabola, touching), &
         & max(1.5_wp, 1.0_wp + 2.0_wp*parabola, touching), min(1.0_wp, 0.5_wp*films(1)**(2.0_wp/3.0_wp)), films(1) > rigid_film)
   end subroutine prepare_march

   !> Steady contact at the start of the run-up.
   subroutine start_history(model, march, state, first, error)
      type(model_t), intent(in) :: model
      !> What stays over the cycle
      type(ehl_march_t), intent(in) :: march
      !> Pressure
      type(ehl_state_t), intent(out) :: state
      type(moment_t), intent(out) :: first
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_march_t) :: steady
      type(moment_t) :: nothing(1)
      logical :: converged

      steady = march
      steady%is_transient = .false.
      call new_ehl_fields(state%fields, march%grid%size)
      nothing%angle = start - run_up - first_step
      call make_step(model, steady, nothing, start - run_up, state, first, converged)
      if (.not. converged) call raise(error, kind_convergence, "ehl: no film at the start of the cycle")
   end subroutine start_history

   !> Error of a step over what is allowed: difference from what the moments before lead to expect.
   pure function step_excess(before, now, scale, allowed) result(excess)
      !> Moments before, last first
      type(moment_t), intent(in) :: before(:)
      !> The step's end
      type(moment_t), intent(in) :: now
      !> Largest sliding speed so far, or what counts as none [m/s]
      real(wp), intent(in) :: scale
      !> Error allowed [-]
      real(wp), intent(in) :: allowed
      !> Error over it [-]
      real(wp) :: excess

      ! Weights of the moments before in the extrapolation [-]; films and sliding speeds [m], [m/s]
      real(wp) :: weights(size(before)), errors(3)
      integer :: i, k

      excess = unknown_excess
      if (size(before) < 2 .or. .not. (now%has_film .and. all(before%has_film))) return
      do i = 1, size(before)
         weights(i) = 1.0_wp
         do k = 1, size(before)
            if (k /= i) weights(i) = weights(i)*(now%angle - before(k)%angle)/(before(i)%angle - before(k)%angle)
         end do
      end do
      errors(1) = 1.0_wp - dot_product(weights, before%films%minimum)/now%films%minimum
      errors(2) = 1.0_wp - dot_product(weights, before%films%central)/now%films%central
      errors(3) = (now%sliding_speed - dot_product(weights, before%sliding_speed)) &
         & /max(abs(now%sliding_speed), abs(before(1)%sliding_speed), min(scale, small_slip))
      ! A backward difference of second order leaves less than a quarter of what its quadratic predictor is off
      excess = 0.25_wp*maxval(abs(errors))/allowed
   end function step_excess

   !> Keep a moment of the cycle.
   subroutine keep(cycle, nodes, state, now, keeps_profiles)
      type(ehl_cycle_t), intent(inout) :: cycle
      !> Nodes of a profile
      integer, intent(in) :: nodes
      !> The solution, where there has been a film
      type(ehl_state_t), intent(in) :: state
      type(moment_t), intent(in) :: now
      !> Are profiles kept?
      logical, intent(in) :: keeps_profiles

      type(moment_t) :: lean
      ! Profiles with one more [Pa], [m]
      real(wp), allocatable :: pressure(:, :), film(:, :)
      integer :: count

      lean = now
      if (allocated(lean%mass)) deallocate (lean%mass)
      if (allocated(lean%films%cells)) deallocate (lean%films%cells)
      cycle%moments = [cycle%moments, lean]
      if (.not. keeps_profiles) return
      count = size(cycle%moments)
      allocate (pressure(nodes, count), film(nodes, count), source=0.0_wp)
      if (allocated(cycle%pressure)) then
         pressure(:, :count - 1) = cycle%pressure
         film(:, :count - 1) = cycle%film
      end if
      if (now%has_film) then
         pressure(:, count) = state%total*now%pressure_scale
         film(:, count) = state%fields%film*now%film_scale
      end if
      call move_alloc(pressure, cycle%pressure)
      call move_alloc(film, cycle%film)
   end subroutine keep

end module camroller_ehl_cycle
