!> Linear equations of a step of a flexible train, reduced to a few unknowns.
!>
!> In: derivatives of the rates. Out: factors of `shift I - J`, solutions. Places are integrals of speeds, and modes of the spring
!> follow the valve's acceleration alone: both are eliminated in closed form. Speeds of finger, valve and plunger, sliding speed and
!> pressure remain, three or five unknowns, whose matrix LAPACK inverts: the stages of a step solve eight times with it. Source of
!> the elimination of places: Hairer and Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer (1996), section IV.8,
!> special structures.
!>
!> With u the solution, r the right-hand side, `sigma` the shift and `mu` the derivative of a place's rate over its speed:
!>
!>     place            u_q = (r_q + mu u_v)/sigma
!>     speed of a mode  u_v D = r_v + 2 s (r_x - sigma u_x) - w^2 mu/sigma r_q,   D = sigma + 2 zeta w mu + (w mu)^2/sigma
!>
!> where x stands for the valve's speed, whose row of J each mode has -2 s times.
module camroller_flexible_equations
   use camroller_kinds, only : wp
   use camroller_lapack, only : dgesv
   use camroller_ode_problem, only : factors_t
   use camroller_spring_modes, only : spring_modes_t
   use camroller_flexible_train, only : at_finger, at_finger_rate, at_lift, at_speed, at_sliding, at_plunger, at_plunger_rate, &
      & at_pressure
   implicit none
   private

   public :: factorise_train, solve_train

   !> Components that remain, and the places that are integrals of those of them that are speeds; the first three without adjuster
   integer, parameter :: kept(5) = [at_finger_rate, at_speed, at_sliding, at_plunger_rate, at_pressure]
   integer, parameter :: places(3) = [at_finger, at_lift, at_plunger], speeds(3) = [1, 2, 4]
   !> The valve's speed among those that remain
   integer, parameter :: valve = 2

contains

   !> Factors of `shift I - J`: the inverse of what remains of it.
   pure subroutine factorise_train(modes, has_adjuster, jacobian, shift, factors, status)
      !> Modes of the spring
      type(spring_modes_t), intent(in) :: modes
      !> Is there a lash adjuster?
      logical, intent(in) :: has_adjuster
      !> Derivatives of the rates (row) over the state (column) [1/rad]
      real(wp), intent(in) :: jacobian(:, :)
      !> The shift [1/rad]
      real(wp), intent(in) :: shift
      !> Factors; have their room
      type(factors_t), intent(inout) :: factors
      !> 0 fine, positive where the matrix is singular
      integer, intent(out) :: status

      ! Derivative of a place's rate over its speed [any]
      real(wp) :: by_speed
      ! What remains of the matrix [1/rad], its inverse [rad]
      real(wp) :: remaining(5, 5), inverse(5, 5)
      integer :: i, k, n, place, pivots(5)

      n = merge(5, 3, has_adjuster)
      by_speed = jacobian(at_lift, at_speed)
      factors%shift = shift
      remaining(:n, :n) = -jacobian(kept(:n), kept(:n))
      do k = 1, merge(3, 2, has_adjuster)
         remaining(:n, speeds(k)) = remaining(:n, speeds(k)) - jacobian(kept(:n), places(k))*(by_speed/shift)
      end do
      inverse = 0.0_wp
      do i = 1, n
         remaining(i, i) = remaining(i, i) + shift
         inverse(i, i) = 1.0_wp
      end do
      place = size(jacobian, 1) - 2*modes%count + 1
      do i = 1, modes%count
         associate (w => modes%frequency(i)*by_speed)
            factors%eliminated(i) = 1.0_wp/(shift + 2.0_wp*modes%damping_ratio*w + w*(w/shift))
         end associate
         remaining(valve, valve) = remaining(valve, valve) + (jacobian(at_speed, place)*(by_speed/shift) &
            & + jacobian(at_speed, place + 1))*(2.0_wp*modes%share(i)*shift*factors%eliminated(i))
         place = place + 2
      end do
      call dgesv(n, n, remaining, 5, pivots, inverse, 5, status)
      factors%matrix(:n, :n) = inverse(:n, :n)
   end subroutine factorise_train

   !> Solve with the factors.
   pure subroutine solve_train(modes, has_adjuster, jacobian, factors, right_side)
      !> Modes of the spring
      type(spring_modes_t), intent(in) :: modes
      !> Is there a lash adjuster?
      logical, intent(in) :: has_adjuster
      !> Derivatives of the rates (row) over the state (column) [1/rad]
      real(wp), intent(in) :: jacobian(:, :)
      !> The factors
      type(factors_t), intent(in) :: factors
      !> In: right-hand side [state/rad]; out: solution [state]
      real(wp), intent(inout) :: right_side(:)

      ! Right-hand side and solution of what remains [state/rad], [state]; derivative of a place's rate over its speed [any]; part
      ! of a place that is known [state]
      real(wp) :: side(5), unknown(5), by_speed, known
      ! Valve's row of the right-hand side [m/s/rad]; 1 over the shift [rad]
      real(wp) :: valve_side, per_shift
      integer :: i, k, n, place

      n = merge(5, 3, has_adjuster)
      by_speed = jacobian(at_lift, at_speed)
      per_shift = 1.0_wp/factors%shift
      valve_side = right_side(at_speed)
      side(:n) = right_side(kept(:n))
      do k = 1, merge(3, 2, has_adjuster)
         known = right_side(places(k))*per_shift
         side(:n) = side(:n) + jacobian(kept(:n), places(k))*known
      end do
      place = size(right_side) - 2*modes%count + 1
      do i = 1, modes%count
         known = right_side(place)*per_shift
         right_side(place + 1) = (right_side(place + 1) + 2.0_wp*modes%share(i)*valve_side &
            & - modes%frequency(i)**2*by_speed*known)*factors%eliminated(i)
         side(valve) = side(valve) + jacobian(at_speed, place)*(known + (by_speed*per_shift)*right_side(place + 1)) &
            & + jacobian(at_speed, place + 1)*right_side(place + 1)
         place = place + 2
      end do
      unknown = 0.0_wp
      do k = 1, n
         unknown(:n) = unknown(:n) + factors%matrix(:n, k)*side(k)
      end do
      right_side(kept(:n)) = unknown(:n)
      do k = 1, merge(3, 2, has_adjuster)
         right_side(places(k)) = (right_side(places(k)) + by_speed*unknown(speeds(k)))*per_shift
      end do
      place = size(right_side) - 2*modes%count + 1
      do i = 1, modes%count
         right_side(place + 1) = right_side(place + 1) - 2.0_wp*modes%share(i)*factors%shift*factors%eliminated(i)*unknown(valve)
         right_side(place) = (right_side(place) + by_speed*right_side(place + 1))*per_shift
         place = place + 2
      end do
   end subroutine solve_train

end module camroller_flexible_equations
