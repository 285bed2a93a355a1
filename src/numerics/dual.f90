!> Dual numbers: a value with its derivative in one direction, so that a formula is written once and gives both.
!>
!> In: values with slopes. Out: the same, exact to round-off. Operators of two dual numbers, and of one and a real number, which is
!> constant. Source: Griewank and Walther, Evaluating Derivatives (2008), chapter 3, forward mode.
module camroller_dual
   use camroller_kinds, only : wp
   implicit none
   private

   public :: dual_t, constant_part, operator(+), operator(-), operator(*), operator(/), abs, sqrt, tanh

   !> A value and its derivative
   type :: dual_t
      !> Value [any]
      real(wp) :: value = 0.0_wp
      !> Derivative [any over the direction]
      real(wp) :: slope = 0.0_wp
   end type dual_t

   interface operator(+)
      module procedure add_dual, add_real
   end interface operator(+)

   interface operator(-)
      module procedure subtract_dual, subtract_from_real, negate
   end interface operator(-)

   interface operator(*)
      module procedure multiply_dual, multiply_real
   end interface operator(*)

   interface operator(/)
      module procedure divide_by_real
   end interface operator(/)

   interface abs
      module procedure absolute
   end interface abs

   interface sqrt
      module procedure square_root
   end interface sqrt

   interface tanh
      module procedure hyperbolic_tangent
   end interface tanh

contains

   !> The same value, constant in every direction.
   elemental function constant_part(number) result(constant)
      !> A number
      type(dual_t), intent(in) :: number
      !> Its value without slope
      type(dual_t) :: constant

      constant = dual_t(number%value, 0.0_wp)
   end function constant_part

   !> Sum of two dual numbers.
   elemental function add_dual(left, right) result(total)
      !> Terms
      type(dual_t), intent(in) :: left, right
      !> Sum
      type(dual_t) :: total

      total = dual_t(left%value + right%value, left%slope + right%slope)
   end function add_dual

   !> Sum of a dual number and a constant.
   elemental function add_real(left, right) result(total)
      !> First term
      type(dual_t), intent(in) :: left
      !> Second term [any]
      real(wp), intent(in) :: right
      !> Sum
      type(dual_t) :: total

      total = dual_t(left%value + right, left%slope)
   end function add_real

   !> Difference of two dual numbers.
   elemental function subtract_dual(left, right) result(difference)
      !> Terms
      type(dual_t), intent(in) :: left, right
      !> Difference
      type(dual_t) :: difference

      difference = dual_t(left%value - right%value, left%slope - right%slope)
   end function subtract_dual

   !> Difference of a constant and a dual number.
   elemental function subtract_from_real(left, right) result(difference)
      !> First term [any]
      real(wp), intent(in) :: left
      !> Second term
      type(dual_t), intent(in) :: right
      !> Difference
      type(dual_t) :: difference

      difference = dual_t(left - right%value, -right%slope)
   end function subtract_from_real

   !> A dual number with the other sign.
   elemental function negate(number) result(negative)
      type(dual_t), intent(in) :: number
      !> The same with the other sign
      type(dual_t) :: negative

      negative = dual_t(-number%value, -number%slope)
   end function negate

   !> Product of two dual numbers.
   elemental function multiply_dual(left, right) result(product)
      !> Factors
      type(dual_t), intent(in) :: left, right
      !> Product
      type(dual_t) :: product

      product = dual_t(left%value*right%value, left%slope*right%value + left%value*right%slope)
   end function multiply_dual

   !> Product of a constant and a dual number.
   elemental function multiply_real(left, right) result(product)
      !> First factor [any]
      real(wp), intent(in) :: left
      !> Second factor
      type(dual_t), intent(in) :: right
      !> Product
      type(dual_t) :: product

      product = dual_t(left*right%value, left*right%slope)
   end function multiply_real

   !> Quotient of a dual number and a constant.
   elemental function divide_by_real(left, right) result(quotient)
      !> Numerator
      type(dual_t), intent(in) :: left
      !> Denominator [any]
      real(wp), intent(in) :: right
      !> Quotient
      type(dual_t) :: quotient

      quotient = dual_t(left%value/right, left%slope/right)
   end function divide_by_real

   !> Size; its slope at zero is that on the positive side.
   elemental function absolute(number) result(size)
      type(dual_t), intent(in) :: number
      !> Its size
      type(dual_t) :: size

      size = dual_t(abs(number%value), sign(1.0_wp, number%value)*number%slope)
   end function absolute

   !> Square root; its slope at zero is left out.
   elemental function square_root(number) result(root)
      !> A number, not negative
      type(dual_t), intent(in) :: number
      !> Its square root
      type(dual_t) :: root

      root%value = sqrt(number%value)
      if (root%value > 0.0_wp) root%slope = 0.5_wp*number%slope/root%value
   end function square_root

   !> Hyperbolic tangent.
   elemental function hyperbolic_tangent(number) result(tangent)
      type(dual_t), intent(in) :: number
      !> Its hyperbolic tangent
      type(dual_t) :: tangent

      tangent%value = tanh(number%value)
      tangent%slope = (1.0_wp - tangent%value)*(1.0_wp + tangent%value)*number%slope
   end function hyperbolic_tangent

end module camroller_dual
