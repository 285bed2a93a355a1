!> Table of the Rosenbrock method against the order conditions, and the Jacobian by differences.
module test_ode_rosenbrock
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_ode, only : counters_t
   use camroller_ode_rosenbrock, only : rosenbrock_method_t, new_rosenbrock_method
   use ode_problems, only : known_t, pair
   implicit none
   private

   public :: collect_ode_rosenbrock

   !> Number of order conditions up to each order
   integer, parameter :: conditions_up_to(0:5) = [0, 1, 2, 4, 8, 17]

contains

   subroutine collect_ode_rosenbrock(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("nodes and slope weights are sums of the tables", test_sums), &
         new_unittest("method and companion meet the conditions of their order and miss one of the next", test_orders), &
         new_unittest("the curve meets the conditions of one order less at every place", test_curves), &
         new_unittest("the Jacobian by differences has half of the figures", test_differences) &
         ]
   end subroutine collect_ode_rosenbrock

   !> From the form that is stepped to the coefficients of the theory, alpha and gamma: column j of row i.
   subroutine get_coefficients(method, alpha, gamma)
      type(rosenbrock_method_t), intent(in) :: method
      real(wp), allocatable, intent(out) :: alpha(:, :), gamma(:, :)

      integer :: i, j, n

      n = method%stages
      allocate (alpha(n, n), gamma(n, n))
      ! gamma is the inverse of I/diagonal - C, lower triangular: rows from the top
      gamma = 0.0_wp
      do i = 1, n
         gamma(i, i) = method%diagonal
         do j = 1, i - 1
            gamma(i, j) = method%diagonal*dot_product(method%couplings(j:i - 1, i), gamma(j:i - 1, j))
         end do
      end do
      alpha = matmul(transpose(method%weights), gamma)
   end subroutine get_coefficients

   !> Left sides less right sides of the order conditions. Source: Hairer and Wanner (1996), section IV.7, table 7.1.
   pure function order_defects(weights, alpha, beta, place) result(defects)
      !> Weights of the solution, at a place of the step
      real(wp), intent(in) :: weights(:), alpha(:, :), beta(:, :), place
      real(wp) :: defects(17)

      real(wp), dimension(size(weights)) :: a, b, ab, aa, bb

      a = sum(alpha, 2)
      b = sum(beta, 2)
      ab = matmul(alpha, b)
      aa = matmul(alpha, a**2)
      bb = matmul(beta, b)
      defects(1) = sum(weights) - place
      defects(2) = dot_product(weights, b) - place**2/2.0_wp
      defects(3) = dot_product(weights, a**2) - place**3/3.0_wp
      defects(4) = dot_product(weights, bb) - place**3/6.0_wp
      defects(5) = dot_product(weights, a**3) - place**4/4.0_wp
      defects(6) = dot_product(weights, a*ab) - place**4/8.0_wp
      defects(7) = dot_product(weights, matmul(beta, a**2)) - place**4/12.0_wp
      defects(8) = dot_product(weights, matmul(beta, bb)) - place**4/24.0_wp
      defects(9) = dot_product(weights, a**4) - place**5/5.0_wp
      defects(10) = dot_product(weights, a**2*ab) - place**5/10.0_wp
      defects(11) = dot_product(weights, ab**2) - place**5/20.0_wp
      defects(12) = dot_product(weights, a*aa) - place**5/15.0_wp
      defects(13) = dot_product(weights, a*matmul(alpha, bb)) - place**5/30.0_wp
      defects(14) = dot_product(weights, matmul(beta, a**3)) - place**5/20.0_wp
      defects(15) = dot_product(weights, matmul(beta, a*ab)) - place**5/40.0_wp
      defects(16) = dot_product(weights, matmul(beta, matmul(beta, a**2))) - place**5/60.0_wp
      defects(17) = dot_product(weights, matmul(beta, matmul(beta, bb))) - place**5/120.0_wp
   end function order_defects

   subroutine test_sums(error)
      type(error_type), allocatable, intent(out) :: error
      type(rosenbrock_method_t) :: method
      real(wp), allocatable :: alpha(:, :), gamma(:, :)

      call new_rosenbrock_method(method, 1)
      call get_coefficients(method, alpha, gamma)
      ! sums of numbers up to 30, printed to 16 figures
      call check(error, all(abs(sum(alpha, 2) - method%nodes) < 1.0e-14_wp), "nodes")
      if (allocated(error)) return
      call check(error, all(abs(sum(gamma, 2) - method%slope_weights) < 1.0e-14_wp), "slope weights")
      if (allocated(error)) return
   end subroutine test_sums

   subroutine test_orders(error)
      type(error_type), allocatable, intent(out) :: error
      type(rosenbrock_method_t) :: method
      real(wp), allocatable :: alpha(:, :), gamma(:, :), weights(:)
      real(wp) :: defects(17)
      integer :: order, companion

      call new_rosenbrock_method(method, 1)
      call get_coefficients(method, alpha, gamma)
      weights = method%weights(:, method%stages)
      do companion = 1, 0, -1
         ! the error estimate is the last increment: the companion goes without it
         order = method%error_order - companion
         weights(method%stages) = 1.0_wp - companion
         defects = order_defects(matmul(weights, gamma), alpha, alpha + gamma, 1.0_wp)
         call check(error, all(abs(defects(:conditions_up_to(order))) < 1.0e-13_wp), "has a lower order")
         if (allocated(error)) return
         if (order == 5) cycle
         call check(error, any(abs(defects(:conditions_up_to(order + 1))) > 1.0e-4_wp), "the test cannot fail")
         if (allocated(error)) return
      end do
   end subroutine test_orders

   subroutine test_curves(error)
      type(error_type), allocatable, intent(out) :: error
      type(rosenbrock_method_t) :: method
      real(wp), allocatable :: alpha(:, :), gamma(:, :), weights(:)
      real(wp) :: defects(17), place
      integer :: k

      call new_rosenbrock_method(method, 1)
      call get_coefficients(method, alpha, gamma)
      do k = 1, 9
         place = 0.1_wp*k
         weights = method%weights(:, method%stages)
         weights(method%stages) = 1.0_wp
         weights = place*weights + place*(1.0_wp - place)*(method%bend_weights(:, 1) &
            & + place*(method%bend_weights(:, 2) + place*method%bend_weights(:, 3)))
         defects = order_defects(matmul(weights, gamma), alpha, alpha + gamma, place)
         call check(error, all(abs(defects(:conditions_up_to(method%error_order - 1))) < 1.0e-13_wp), &
            & "has a poorer curve")
         if (allocated(error)) return
      end do
   end subroutine test_curves

   subroutine test_differences(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(counters_t) :: counters
      real(wp) :: state(2), rate(2), jacobian(2, 2), slope(2), horizon
      integer :: status, k
      integer, target :: calls

      problem%kind = pair
      calls = 0
      problem%calls => calls
      state = [1.3_wp, 0.7_wp]
      do k = 0, 1
         ! with the horizon far away, and two increments away
         horizon = merge(1.5_wp, 0.5_wp + 2.0e-8_wp, k == 0)
         call problem%get_rate(0.5_wp, state, rate, status)
         call problem%get_jacobian(0.5_wp, state, rate, horizon, jacobian, slope, counters, status)
         ! increments of sqrt(epsilon): second derivatives up to 5 and roundings of rates up to 3
         call check(error, status == 0 .and. maxval(abs(jacobian(:, 1) - [2.0_wp*state(1)/state(2), 0.0_wp]*cos(0.5_wp))) &
            & < 20.0_wp*sqrt(epsilon(1.0_wp)), "first column")
         if (allocated(error)) return
         call check(error, maxval(abs(jacobian(:, 2) - [-(state(1)/state(2))**2, 1.0_wp]*cos(0.5_wp))) &
            & < 20.0_wp*sqrt(epsilon(1.0_wp)), "second column")
         if (allocated(error)) return
         call check(error, maxval(abs(slope + [state(1)**2/state(2), state(2)]*sin(0.5_wp))) &
            & < 20.0_wp*sqrt(epsilon(1.0_wp)), "slope with time")
         if (allocated(error)) return
      end do
      call check(error, counters%evaluations == calls - 2 .and. counters%jacobians == 2, "counters")
   end subroutine test_differences

end module test_ode_rosenbrock
