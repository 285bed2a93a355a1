!> A cycle by CVODE of SUNDIALS: variable-order BDF, modified Newton, dense Jacobian, event edges as stop times.
module bench_cvode
   use, intrinsic :: iso_c_binding, only : c_int, c_long, c_int64_t, c_double, c_ptr, c_null_ptr, c_funloc, c_loc, c_f_pointer
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, counters_t, linear_t, new_linear
   use bench_own, only : largest_step
   use bench_cvode_interface, only : new_context, free_context, new_vector, free_vector, vector_data, new_matrix, free_matrix, &
      & matrix_data, new_dense_solver, free_dense_solver, cvode_create, cvode_init, cvode_reinit, cvode_free, &
      & cvode_set_user_data, cvode_set_tolerances, cvode_set_linear_solver, cvode_set_jacobian, cvode_set_stop_time, &
      & cvode_set_max_step, cvode_set_max_steps, cvode_set_error_file, cvode_step, cvode_get_rates, cvode_get_linear_rates, &
      & cvode_get_jacobians, cvode_get_steps, cvode_get_fails, bdf, normal, success, tstop_return
   implicit none
   private

   public :: cvode_t, new_cvode, run_cvode, free_cvode

   !> What the callbacks need
   type :: callback_t
      class(problem_t), pointer :: problem => null()
      integer :: components = 0
      !> Room for a rate with its derivatives
      type(linear_t) :: linear
   end type callback_t

   !> CVODE with its memory
   type :: cvode_t
      !> Work of the last run
      type(counters_t) :: counters
      !> Does it start anew at each stop?
      logical :: restarts = .false.
      !> Is the Jacobian the problem's own, at the price of one evaluation with slopes?
      logical :: knows_slope = .false.
      type(callback_t), pointer :: callback => null()
      !> State and errors allowed, as CVODE sees them [state]
      real(c_double), pointer :: state(:) => null(), tolerance(:) => null()
      type(c_ptr) :: context, memory, state_vector, tolerance_vector, matrix, solver
   end type cvode_t

   !> Difference between angles that is rounding [rad]
   real(wp), parameter :: nothing = 1.0e-12_wp

contains

   !> Make a solver.
   subroutine new_cvode(solver, problem, components, knows_slope, restarts)
      !> Solver
      type(cvode_t), intent(out) :: solver
      !> Right-hand side
      class(problem_t), intent(in), target :: problem
      !> Number of components of the state
      integer, intent(in) :: components
      !> Is the Jacobian the problem's own? Else a difference quotient
      logical, intent(in) :: knows_slope
      !> Start anew at each stop?
      logical, intent(in) :: restarts

      integer(c_int64_t) :: n
      integer(c_int) :: flag

      n = components
      solver%restarts = restarts
      solver%knows_slope = knows_slope
      allocate (solver%callback, solver%state(components), solver%tolerance(components))
      solver%callback%problem => problem
      solver%callback%components = components
      call new_linear(solver%callback%linear, components)
      solver%state = 0.0_wp
      flag = new_context(c_null_ptr, solver%context)
      solver%state_vector = new_vector(n, c_loc(solver%state), solver%context)
      solver%tolerance_vector = new_vector(n, c_loc(solver%tolerance), solver%context)
      solver%matrix = new_matrix(n, n, solver%context)
      solver%solver = new_dense_solver(solver%state_vector, solver%matrix, solver%context)
      solver%memory = cvode_create(bdf, solver%context)
      flag = cvode_init(solver%memory, c_funloc(rate_for_cvode), 0.0_c_double, solver%state_vector)
      flag = cvode_set_user_data(solver%memory, c_loc(solver%callback))
      flag = cvode_set_linear_solver(solver%memory, solver%solver, solver%matrix)
      if (knows_slope) flag = cvode_set_jacobian(solver%memory, c_funloc(slope_for_cvode))
      flag = cvode_set_error_file(solver%memory, c_null_ptr)
      flag = cvode_set_max_step(solver%memory, largest_step)
      flag = cvode_set_max_steps(solver%memory, 10000000_c_long)
   end subroutine new_cvode

   !> Integrate, taking the state at the output angles on the way.
   subroutine run_cvode(solver, stops, first_state, tolerance, angles, states, has_failed)
      !> Solver
      type(cvode_t), intent(inout) :: solver
      !> Start, stops, end [rad]
      real(wp), intent(in) :: stops(:)
      !> State at the start [state]
      real(wp), intent(in) :: first_state(:)
      !> Error allowed per step and component [state]
      real(wp), intent(in) :: tolerance(:)
      !> Output angles, increasing, the last at the end [rad]
      real(wp), intent(in) :: angles(:)
      !> State at the output angles, shape (component, angle) [state]
      real(wp), intent(out) :: states(:, :)
      !> Did CVODE give up?
      logical, intent(out) :: has_failed

      ! Angle reached [rad]
      real(c_double) :: time
      integer :: i, stop
      integer(c_int) :: flag

      solver%counters = counters_t()
      solver%state = first_state
      solver%tolerance = tolerance
      flag = cvode_reinit(solver%memory, stops(1), solver%state_vector)
      flag = cvode_set_tolerances(solver%memory, 0.0_c_double, solver%tolerance_vector)
      stop = 2
      flag = cvode_set_stop_time(solver%memory, stops(stop))
      has_failed = .false.
      do i = 1, size(angles)
         do
            flag = cvode_step(solver%memory, angles(i), solver%state_vector, time, normal)
            has_failed = flag /= success .and. flag /= tstop_return
            if (has_failed) return
            if (flag == success) exit
            if (stop < size(stops)) then
               stop = stop + 1
               if (solver%restarts) then
                  call count_work(solver)
                  flag = cvode_reinit(solver%memory, time, solver%state_vector)
               end if
               flag = cvode_set_stop_time(solver%memory, stops(stop))
            end if
            if (angles(i) - time < nothing) exit
         end do
         states(:, i) = solver%state
      end do
      call count_work(solver)
   end subroutine run_cvode

   !> Add the work since the last start.
   subroutine count_work(solver)
      !> Solver
      type(cvode_t), intent(inout) :: solver

      integer(c_long) :: number
      integer(c_int) :: flag

      flag = cvode_get_rates(solver%memory, number)
      solver%counters%evaluations = solver%counters%evaluations + int(number)
      flag = cvode_get_linear_rates(solver%memory, number)
      solver%counters%evaluations = solver%counters%evaluations + int(number)
      flag = cvode_get_jacobians(solver%memory, number)
      solver%counters%jacobians = solver%counters%jacobians + int(number)
      if (solver%knows_slope) solver%counters%evaluations = solver%counters%evaluations + int(number)
      flag = cvode_get_steps(solver%memory, number)
      solver%counters%accepted = solver%counters%accepted + int(number)
      flag = cvode_get_fails(solver%memory, number)
      solver%counters%rejected = solver%counters%rejected + int(number)
   end subroutine count_work

   !> Give the memory back.
   subroutine free_cvode(solver)
      !> Solver
      type(cvode_t), intent(inout) :: solver

      integer(c_int) :: flag

      call cvode_free(solver%memory)
      flag = free_dense_solver(solver%solver)
      call free_matrix(solver%matrix)
      call free_vector(solver%state_vector)
      call free_vector(solver%tolerance_vector)
      flag = free_context(solver%context)
      deallocate (solver%callback, solver%state, solver%tolerance)
   end subroutine free_cvode

   !> Right-hand side as CVODE calls it.
   function rate_for_cvode(time, state, rate, user_data) bind(c) result(status)
      !> Cam angle [rad]
      real(c_double), value :: time
      !> Vectors of state and rate, callback_t
      type(c_ptr), value :: state, rate, user_data
      !> 0 fine, positive: try a smaller step, negative: give up
      integer(c_int) :: status

      type(callback_t), pointer :: callback
      ! State [state], rate [state/rad]
      real(c_double), pointer :: values(:), rates(:)
      integer :: code

      call c_f_pointer(user_data, callback)
      call c_f_pointer(vector_data(state), values, [callback%components])
      call c_f_pointer(vector_data(rate), rates, [callback%components])
      call callback%problem%get_rate(time, values, rates, code)
      status = int(code, c_int)
   end function rate_for_cvode

   !> Jacobian as CVODE calls it.
   function slope_for_cvode(time, state, rate, matrix, user_data, work_1, work_2, work_3) bind(c) result(status)
      !> Cam angle [rad]
      real(c_double), value :: time
      !> Vectors of state and rate, matrix, callback_t, vectors not needed
      type(c_ptr), value :: state, rate, matrix, user_data, work_1, work_2, work_3
      !> 0 fine
      integer(c_int) :: status

      type(callback_t), pointer :: callback
      ! State [state], Jacobian, column by column [1/rad]
      real(c_double), pointer :: values(:), jacobian(:)
      type(counters_t) :: counters
      integer :: code

      call c_f_pointer(user_data, callback)
      call c_f_pointer(vector_data(state), values, [callback%components])
      call c_f_pointer(matrix_data(matrix), jacobian, [callback%components**2])
      call callback%problem%linearise(time, values, time, callback%linear, counters, code)
      jacobian = reshape(callback%linear%jacobian, [size(jacobian)])
      status = int(code, c_int)
   end function slope_for_cvode

end module bench_cvode
