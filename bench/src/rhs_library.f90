!> The tasks for Python: right-hand sides, stops, output angles and errors behind C functions.
!>
!> Tasks are numbered from 0. The one place in the project with a module variable: a C caller has nowhere to keep them.
module bench_rhs_library
   use, intrinsic :: iso_c_binding, only : c_int, c_char, c_double, c_null_char
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_ode_problem, only : counters_t, linear_t, new_linear
   use bench_tasks, only : task_t, make_tasks, task_sets, set_accuracy, measure_errors
   implicit none
   private

   public :: bench_open, bench_name, bench_sizes, bench_data, bench_rate, bench_rate_1, bench_slope, bench_jacobian, &
      & bench_accuracy, bench_errors

   !> The tasks
   type(task_t), allocatable, save :: tasks(:)

contains

   !> Make the tasks of a set, from 0; returns their number, negative where that failed.
   function bench_open(folder, length, set) bind(c) result(number)
      !> Folder of the decks
      character(kind=c_char), intent(in) :: folder(*)
      !> Its length
      integer(c_int), value :: length
      !> The set
      integer(c_int), value :: set
      !> Number of tasks
      integer(c_int) :: number

      type(error_t), allocatable :: error
      character(len=length) :: path
      integer :: i

      do i = 1, length
         path(i:i) = folder(i)
      end do
      call make_tasks(tasks, path, task_sets(set + 1), error)
      number = -1_c_int
      if (.not. allocated(error)) number = int(size(tasks), c_int)
   end function bench_open

   !> Name of a task, ended by a null character; room for 25 characters.
   subroutine bench_name(task, name) bind(c)
      !> Which task
      integer(c_int), value :: task
      !> Its name
      character(kind=c_char), intent(out) :: name(*)

      integer :: i, length

      length = len_trim(tasks(task + 1)%name)
      do i = 1, length
         name(i) = tasks(task + 1)%name(i:i)
      end do
      name(length + 1) = c_null_char
   end subroutine bench_name

   !> Numbers of components, stops and output angles.
   subroutine bench_sizes(task, components, stops, angles) bind(c)
      !> Which task
      integer(c_int), value :: task
      !> Numbers
      integer(c_int), intent(out) :: components, stops, angles

      components = size(tasks(task + 1)%first_state)
      stops = size(tasks(task + 1)%stops)
      angles = size(tasks(task + 1)%angles)
   end subroutine bench_sizes

   !> Arrays of a task.
   subroutine bench_data(task, stops, angles, first_state, scale) bind(c)
      !> Which task
      integer(c_int), value :: task
      !> Stops, output angles [rad]
      real(c_double), intent(out) :: stops(*), angles(*)
      !> State at the start and size of each component [state]
      real(c_double), intent(out) :: first_state(*), scale(*)

      stops(:size(tasks(task + 1)%stops)) = tasks(task + 1)%stops
      angles(:size(tasks(task + 1)%angles)) = tasks(task + 1)%angles
      first_state(:size(tasks(task + 1)%first_state)) = tasks(task + 1)%first_state
      scale(:size(tasks(task + 1)%first_state)) = tasks(task + 1)%scale
   end subroutine bench_data

   !> Right-hand side.
   subroutine bench_rate(task, time, state, rate) bind(c)
      !> Which task
      integer(c_int), value :: task
      !> Cam angle [rad]
      real(c_double), value :: time
      !> State [state]
      real(c_double), intent(in) :: state(*)
      !> Rate [state/rad]
      real(c_double), intent(out) :: rate(*)

      integer :: n, status

      n = size(tasks(task + 1)%first_state)
      call tasks(task + 1)%problem%get_rate(time, state(:n), rate(:n), status)
   end subroutine bench_rate

   !> The same for one component, without arrays, which cost more than the call.
   function bench_rate_1(task, time, state) bind(c) result(rate)
      !> Which task
      integer(c_int), value :: task
      !> Cam angle [rad]
      real(c_double), value :: time
      !> State [m/s]
      real(c_double), value :: state
      !> Rate [m/s/rad]
      real(c_double) :: rate

      ! Rate [m/s/rad]
      real(wp) :: rates(1)
      integer :: status

      call tasks(task + 1)%problem%get_rate(time, [state], rates, status)
      rate = rates(1)
   end function bench_rate_1

   !> Jacobian, the rows of a column side by side.
   subroutine bench_jacobian(task, time, state, jacobian) bind(c)
      !> Which task
      integer(c_int), value :: task
      !> Cam angle [rad]
      real(c_double), value :: time
      !> State [state]
      real(c_double), intent(in) :: state(*)
      !> The derivatives [1/rad]
      real(c_double), intent(out) :: jacobian(*)

      type(linear_t) :: linear
      type(counters_t) :: counters
      integer :: n, status

      n = size(tasks(task + 1)%first_state)
      call new_linear(linear, n)
      call tasks(task + 1)%problem%linearise(time, state(:n), time, linear, counters, status)
      jacobian(:n*n) = reshape(linear%jacobian, [n*n])
   end subroutine bench_jacobian

   !> Derivative of the first rate with respect to the first component, friction's other dependencies left out.
   function bench_slope(task, time, state) bind(c) result(slope)
      !> Which task
      integer(c_int), value :: task
      !> Cam angle [rad]
      real(c_double), value :: time
      !> First component of the state [state]
      real(c_double), value :: state
      !> Derivative [1/rad]
      real(c_double) :: slope

      ! Decay rate [1/rad]
      real(wp) :: decay_rate

      call tasks(task + 1)%problem%get_decay_rate(time, [state, 0.0_wp], decay_rate)
      slope = -decay_rate
   end function bench_slope

   !> Let evaluations be as accurate as a tolerance wants them.
   subroutine bench_accuracy(task, tolerance) bind(c)
      !> Which task
      integer(c_int), value :: task
      !> Tolerance of the integration [-]
      real(c_double), value :: tolerance

      call set_accuracy(tasks(task + 1), tolerance)
   end subroutine bench_accuracy

   !> Errors of a solution at the output angles.
   subroutine bench_errors(task, states, slip_error, loss_error) bind(c)
      !> Which task
      integer(c_int), value :: task
      !> State, the components of an angle side by side [state]
      real(c_double), intent(in) :: states(*)
      !> Errors of sliding speed and mean loss [-]
      real(c_double), intent(out) :: slip_error, loss_error

      integer :: components, angles

      components = size(tasks(task + 1)%first_state)
      angles = size(tasks(task + 1)%angles)
      call measure_errors(tasks(task + 1), reshape(states(:components*angles), [components, angles]), slip_error, loss_error)
   end subroutine bench_errors

end module bench_rhs_library
