!> Radau IIA of order 5: fully implicit collocation with three stages, stiffly accurate and L-stable.
!>
!> In: number of components. Out: a `method_t`. The stages are found by simplified Newton iterations on all of them at once, with
!> the Jacobian at the start of the step; an approximate Jacobian suffices. Dense output is the collocation polynomial.
!>
!> Source: Hairer and Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer (1996), section IV.8: the iteration,
!> its starting values from the polynomial of the last step, its termination, and the filtered error estimate.
module camroller_ode_implicit
   use camroller_kinds, only : wp
   use camroller_ode, only : problem_t, method_t, step_t, counters_t
   use camroller_lapack, only : dgetrf, dgetrs
   implicit none
   private

   public :: radau_method_t, new_radau_method

   !> A step and its curve
   type :: made_step_t
      !> Its size, zero where there is none [time]
      real(wp) :: step = 0.0_wp
      !> State at its start and at its end [state]
      real(wp), allocatable :: start(:), end(:)
      !> Bends of its curve, shape (component, 2) [state]
      real(wp), allocatable :: bends(:, :)
   end type made_step_t

   !> Radau IIA with its work space
   type, extends(method_t) :: radau_method_t
      !> Inverse of the Runge-Kutta matrix [-]
      real(wp) :: inverse(3, 3) = 0.0_wp
      !> Factors of the matrix of the Newton iteration, of that of the error estimate [1/time]
      real(wp), allocatable :: matrix(:, :), estimate_matrix(:, :)
      !> Their pivots
      integer, allocatable :: pivots(:), estimate_pivots(:)
      !> Stages less the state at the start, shape (component, stage) [state]
      real(wp), allocatable :: stages(:, :)
      !> Right-hand side of the iteration, then its correction [state/time], [state]
      real(wp), allocatable :: correction(:, :)
      !> Rate at a stage [state/time]
      real(wp), allocatable :: stage_rate(:)
      !> The step before this point and the step last tried
      type(made_step_t) :: last, tried
   contains
      procedure :: try_step => try_radau_step
      procedure :: forget => forget_steps
   end type radau_method_t

   !> Square root of 6 [-]
   real(wp), parameter :: root_6 = sqrt(6.0_wp)
   !> Times of the stages, the zeros of a Radau polynomial [-]
   real(wp), parameter :: nodes(3) = [(4.0_wp - root_6)/10.0_wp, (4.0_wp + root_6)/10.0_wp, 1.0_wp]
   !> Weights of the stages (column) in a stage (row) [-]
   real(wp), parameter :: weights(3, 3) = reshape([ &
      & (88.0_wp - 7.0_wp*root_6)/360.0_wp, (296.0_wp + 169.0_wp*root_6)/1800.0_wp, (16.0_wp - root_6)/36.0_wp, &
      & (296.0_wp - 169.0_wp*root_6)/1800.0_wp, (88.0_wp + 7.0_wp*root_6)/360.0_wp, (16.0_wp + root_6)/36.0_wp, &
      & (-2.0_wp + 3.0_wp*root_6)/225.0_wp, (-2.0_wp - 3.0_wp*root_6)/225.0_wp, 1.0_wp/9.0_wp], [3, 3])
   !> Real eigenvalue of the inverse of the weights [-]
   real(wp), parameter :: real_eigenvalue = 30.0_wp/(6.0_wp + 81.0_wp**(1.0_wp/3.0_wp) - 9.0_wp**(1.0_wp/3.0_wp))
   !> Weights of the stages in the error estimate [-]
   real(wp), parameter :: estimate_weights(3) = [-13.0_wp - 7.0_wp*root_6, -13.0_wp + 7.0_wp*root_6, -1.0_wp]/3.0_wp
   !> Error of the iteration over the tolerance of a step [-]
   real(wp), parameter :: iteration_tolerance = 0.03_wp
   !> Corrections of this part of the state are round-off [-]
   real(wp), parameter :: rounding = 8.0_wp*epsilon(1.0_wp)
   !> Iterations after which a smaller step is better
   integer, parameter :: max_iterations = 10

contains

   !> Make the method.
   subroutine new_radau_method(method, components)
      !> The method
      type(radau_method_t), intent(out) :: method
      !> Number of components of the state
      integer, intent(in) :: components

      ! Factors of the weights [-]
      real(wp) :: factors(3, 3)
      integer :: pivots(3), info, i

      method%error_order = 4
      method%gives_rate = .false.
      method%needs_jacobian = .true.
      method%proportional = 1.0_wp
      method%integral = 0.0_wp
      method%has_curve = .true.
      factors = weights
      do i = 1, 3
         method%inverse(i, i) = 1.0_wp
      end do
      call dgetrf(3, 3, factors, 3, pivots, info)
      call dgetrs("N", 3, 3, factors, 3, pivots, method%inverse, 3, info)
      allocate (method%matrix(3*components, 3*components), method%estimate_matrix(components, components))
      allocate (method%pivots(3*components), method%estimate_pivots(components))
      allocate (method%stages(components, 3), method%correction(components, 3), method%stage_rate(components))
      allocate (method%bends(components, 3))
   end subroutine new_radau_method

   !> Forget earlier steps.
   pure subroutine forget_steps(self)
      class(radau_method_t), intent(inout) :: self

      self%last%step = 0.0_wp
      self%tried%step = 0.0_wp
   end subroutine forget_steps

   !> One step.
   subroutine try_radau_step(self, problem, step, counters, status)
      !> The method with its work space and the Jacobian at this point
      class(radau_method_t), intent(inout) :: self
      class(problem_t), intent(in) :: problem
      type(step_t), intent(inout) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      step%new_state(:) = step%state
      step%new_rate(:) = 0.0_wp
      step%estimate(:) = 0.0_wp
      call factorise(self, step%length, counters, status)
      if (status /= 0) return
      if (follows(self%tried, step%state)) self%last = self%tried
      call guess_stages(self, step%state, step%length)
      call iterate(self, problem, step, counters, status)
      if (status /= 0) return
      step%new_state(:) = step%state + self%stages(:, 3)
      call estimate_error(self, problem, step, counters, status)
      if (status /= 0) return
      call bend_curve(self)
      if (follows(self%last, step%state)) step%estimate(:) = max(abs(step%estimate), curve_error(self, step%length))
      self%tried%step = step%length
      self%tried%start = step%state
      self%tried%end = step%new_state
      self%tried%bends = self%bends(:, :2)
   end subroutine try_radau_step

   !> Does a step end at a state?
   pure function follows(made, state)
      type(made_step_t), intent(in) :: made
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Does it?
      logical :: follows

      follows = .false.
      if (made%step > 0.0_wp) follows = .not. any(abs(state - made%end) > 0.0_wp)
   end function follows

   !> Error of the curve between the ends, which the estimate for its end does not see where the problem is stiff.
   !>
   !> The third derivatives of the last two curves give the fourth; the polynomial whose zeros are the stages and the start
   !> does the rest.
   pure function curve_error(self, step) result(error)
      !> The method, both curves made
      type(radau_method_t), intent(in) :: self
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> Error [state]
      real(wp) :: error(size(self%bends, 1))

      ! Largest value of that polynomial on a step of length one, at place 0.86, over 4 factorial [-]
      real(wp), parameter :: largest = 0.01826_wp/24.0_wp

      error = largest*step**4*abs(6.0_wp*(self%bends(:, 2)/step**3 - self%last%bends(:, 2)/self%last%step**3)) &
         & /(0.5_wp*(step + self%last%step))
   end function curve_error

   !> Factors of the matrices of the iteration and of the error estimate.
   subroutine factorise(self, step, counters, status)
      !> The method with its work space
      type(radau_method_t), intent(inout) :: self
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive where a matrix is singular
      integer, intent(out) :: status

      integer :: i, j, k, n

      n = size(self%stage_rate)
      self%matrix = 0.0_wp
      self%estimate_matrix = -self%here%jacobian
      do i = 1, 3
         self%matrix((i - 1)*n + 1:i*n, (i - 1)*n + 1:i*n) = -self%here%jacobian
      end do
      do k = 1, n
         self%estimate_matrix(k, k) = self%estimate_matrix(k, k) + real_eigenvalue/step
         do j = 1, 3
            do i = 1, 3
               associate (entry => self%matrix((i - 1)*n + k, (j - 1)*n + k))
                  entry = entry + self%inverse(i, j)/step
               end associate
            end do
         end do
      end do
      counters%factorisations = counters%factorisations + 1
      call dgetrf(3*n, 3*n, self%matrix, 3*n, self%pivots, status)
      if (status == 0) call dgetrf(n, n, self%estimate_matrix, n, self%estimate_pivots, status)
   end subroutine factorise

   !> First guess of the stages: the last polynomial prolonged where the step follows on it, else the state at the start.
   subroutine guess_stages(self, state, step)
      !> The method with its work space
      type(radau_method_t), intent(inout) :: self
      !> State at the start of the step [state]
      real(wp), intent(in) :: state(:)
      !> Size of the step [time]
      real(wp), intent(in) :: step

      ! Place of a stage on the last step [-]
      real(wp) :: place
      integer :: i

      self%stages = 0.0_wp
      if (.not. follows(self%last, state)) return
      do i = 1, 3
         place = 1.0_wp + nodes(i)*step/self%last%step
         self%stages(:, i) = (place - 1.0_wp)*(self%last%end - self%last%start) &
            & + place*(1.0_wp - place)*(self%last%bends(:, 1) + place*self%last%bends(:, 2))
      end do
   end subroutine guess_stages

   !> Simplified Newton iteration for the stages.
   subroutine iterate(self, problem, step, counters, status)
      !> The method with its work space
      type(radau_method_t), intent(inout) :: self
      class(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: no convergence, try a smaller step, negative: give up
      integer, intent(out) :: status

      ! Correction over tolerance, the same of the iteration before, their ratio [-]
      real(wp) :: change, last_change, contraction
      integer :: iteration, i, n

      n = size(step%state)
      last_change = 0.0_wp
      do iteration = 1, max_iterations
         do i = 1, 3
            call problem%get_rate(step%time + nodes(i)*step%length, step%state + self%stages(:, i), self%stage_rate, status)
            counters%evaluations = counters%evaluations + 1
            if (status /= 0) return
            self%correction(:, i) = self%stage_rate - matmul(self%stages, self%inverse(i, :))/step%length
         end do
         call dgetrs("N", 3*n, 1, self%matrix, 3*n, self%pivots, self%correction, 3*n, status)
         self%stages = self%stages + self%correction
         change = 0.0_wp
         do i = 1, 3
            change = max(change, maxval(abs(self%correction(:, i))/self%tolerance))
         end do
         if (.not. change < huge(1.0_wp)) exit
         if (maxval(abs(self%correction)) <= rounding*maxval(abs(self%stages + spread(step%state, 2, 3)))) return
         if (iteration > 1) then
            contraction = change/last_change
            if (contraction >= 1.0_wp) exit
            if (contraction/(1.0_wp - contraction)*change <= iteration_tolerance) return
         end if
         last_change = change
      end do
      status = 1
   end subroutine iterate

   !> Difference to an embedded method of order 3, filtered so that stiff components do not blow it up.
   subroutine estimate_error(self, problem, step, counters, status)
      !> The method with its work space
      type(radau_method_t), intent(inout) :: self
      class(problem_t), intent(in) :: problem
      !> The step; out: with its error
      type(step_t), intent(inout) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      ! What the stages say [state/time]
      real(wp) :: difference(size(step%state))
      integer :: n, info

      n = size(step%state)
      status = 0
      difference = matmul(self%stages, estimate_weights)/step%length
      step%estimate(:) = difference + step%rate
      call dgetrs("N", n, 1, self%estimate_matrix, n, self%estimate_pivots, step%estimate, n, info)
      if (maxval(abs(step%estimate)/self%tolerance) <= 1.0_wp) return
      call problem%get_rate(step%time, step%state + step%estimate, self%stage_rate, status)
      counters%evaluations = counters%evaluations + 1
      if (status /= 0) return
      step%estimate(:) = difference + self%stage_rate
      call dgetrs("N", n, 1, self%estimate_matrix, n, self%estimate_pivots, step%estimate, n, info)
   end subroutine estimate_error

   !> The collocation polynomial as bends of a curve.
   pure subroutine bend_curve(self)
      !> The method with its work space
      type(radau_method_t), intent(inout) :: self

      ! What the bends add at the inner stages [state]
      real(wp) :: bend(size(self%stages, 1), 2)
      integer :: i

      do i = 1, 2
         bend(:, i) = (self%stages(:, i) - nodes(i)*self%stages(:, 3))/(nodes(i)*(1.0_wp - nodes(i)))
      end do
      self%bends(:, 2) = (bend(:, 2) - bend(:, 1))/(nodes(2) - nodes(1))
      self%bends(:, 1) = bend(:, 1) - nodes(1)*self%bends(:, 2)
      self%bends(:, 3) = 0.0_wp
   end subroutine bend_curve

end module camroller_ode_implicit
