!> Elastic-plastic asperity contact after Zhao, Maietta and Chang: summits of a rough surface against a plane.
!>
!> In: product of summit density, tip radius and roughness; deflection at which a summit begins to yield; ratio of gap to
!> roughness. Out: load and area of all summits, each divided by a scale factor, with their slopes. Source: Zhao, Maietta and
!> Chang (2000), J. Tribol. 122, 86-93; mean height and scatter of the summits after Bush, Gibson and Thomas (1975), Wear 35,
!> 87-111, in the form of McCool (1986), Wear 107, 37-60. With the deflection w and the gap H relative to the roughness of the
!> surface, and the summits' heights Gaussian about y_s with the standard deviation s,
!>
!>     load = (2/3) n beta sigma sqrt(sigma/beta) E' int_0^inf g(w) phi(H - y_s + w) dw,  g = w^(3/2) below w_1
!>     area = pi n beta sigma int_0^inf w a(w) phi(H - y_s + w) dw,                       a = 1 below w_1, 2 above w_2
!>     g = (sqrt(w_1)/k) w a(w) m(w),  m = 1 - (1 - k) ln(w_2/w)/ln(w_2/w_1) up to w_2, 1 above
!>     a = 1 + 3 t^2 - 2 t^3,  t = (w - w_1)/(w_2 - w_1)
!>
!> Both integrals are analytic in H; the logarithm of each is a Chebyshev series, computed once for a pair of surfaces, with a
!> relative error below 1e-11 where the product is 0.025 or more.
module camroller_zhao_maietta_chang
   use camroller_kinds, only : wp, pi
   use camroller_quadrature, only : gauss_legendre
   implicit none
   private

   public :: summits_t, new_summits, sum_polynomials, first_yield, smallest_product

   !> Product of density, tip radius and roughness that the polynomials are good for; below 0.0193 summits would scatter less than
   !> not at all [-]
   real(wp), parameter :: smallest_product = 0.025_wp
   !> Mean pressure over hardness at which a summit begins to yield, k; flattening at which all of it has, over that at which it
   !> begins, w_2/w_1 [-]
   real(wp), parameter :: yield_pressure = 0.4_wp, yield_range = 54.0_wp
   !> Height of the mean plane of the summits, y_s, times the product (0.045944); what is missing to one in the square of their
   !> scatter, s, times the square of the product (3.717e-4) [-]
   real(wp), parameter :: summit_height = 1.0_wp/(pi*sqrt(48.0_wp)), summit_scatter = 0.8968_wp/(768.0_wp*pi)
   !> Scatters from the mean plane of the summits beyond which none is taken to touch [-]
   real(wp), parameter :: reach_of_summits = 8.0_wp
   !> Number of polynomials
   integer, parameter :: terms = 40

   !> Summits of a pair of surfaces, ready for evaluation
   type :: summits_t
      !> Gap over roughness beyond which none touches [-]
      real(wp) :: reach = 0.0_wp
      !> Coefficients of the logarithms of both integrals over 0 <= H <= reach [-]
      real(wp) :: load(0:terms - 1) = 0.0_wp, area(0:terms - 1) = 0.0_wp
   end type summits_t

contains

   !> Flattening over roughness at which a summit begins to yield, `w_1 = (3 pi k V/2)^2 beta/sigma` with V the hardness over E'.
   elemental function first_yield(hardness, roughness_over_tip_radius) result(flattening)
      !> Hardness over E' [-]
      real(wp), intent(in) :: hardness
      !> sigma/beta [-]
      real(wp), intent(in) :: roughness_over_tip_radius
      !> w_1 [-]
      real(wp) :: flattening

      flattening = (1.5_wp*pi*yield_pressure*hardness)**2/roughness_over_tip_radius
   end function first_yield

   !> Make the summits of a pair of surfaces ready.
   pure subroutine new_summits(summits, product, flattening)
      !> The summits
      type(summits_t), intent(out) :: summits
      !> n beta sigma, `smallest_product` or more [-]
      real(wp), intent(in) :: product
      !> Flattening over roughness at which one begins to yield, w_1 [-]
      real(wp), intent(in) :: flattening

      ! Mean height and scatter of the summits over the roughness of the surface [-]
      real(wp) :: height, scatter
      ! Place [-], logarithms of load and area there [-]
      real(wp) :: place, logs(2)
      ! Chebyshev polynomials at the argument [-]
      real(wp) :: polynomials(0:terms - 1)
      integer :: i, k

      height = summit_height/product
      scatter = sqrt(1.0_wp - summit_scatter/product**2)
      summits%reach = height + reach_of_summits*scatter
      do i = 1, terms
         place = pi*(real(i, wp) - 0.5_wp)/terms
         polynomials = [(cos(k*place), k=0, terms - 1)]*2.0_wp/terms
         polynomials(0) = 0.5_wp*polynomials(0)
         logs = log_integrals((0.5_wp*summits%reach*(1.0_wp + cos(place)) - height)/scatter, scatter, flattening)
         summits%load = summits%load + logs(1)*polynomials
         summits%area = summits%area + logs(2)*polynomials
      end do
   end subroutine new_summits

   !> Exponential of a sum of Chebyshev polynomials, by Clenshaw's recurrence, and its slope; zero beyond the reach.
   pure subroutine sum_polynomials(coefficients, reach, film_ratio, value, slope)
      !> Coefficients [-]
      real(wp), intent(in) :: coefficients(0:)
      !> Upper end; gap over roughness [-]
      real(wp), intent(in) :: reach, film_ratio
      !> Value and slope [-]
      real(wp), intent(out) :: value, slope

      ! Twice the argument on (-1, 1); sums of the recurrence and their derivatives, of this step and of both before [-]
      real(wp) :: twice, sums(3), slopes(3)
      integer :: k

      value = 0.0_wp
      slope = 0.0_wp
      if (film_ratio > reach) return
      twice = 2.0_wp*(2.0_wp*film_ratio/reach - 1.0_wp)
      sums = 0.0_wp
      slopes = 0.0_wp
      do k = ubound(coefficients, 1), 1, -1
         sums(1) = coefficients(k) + twice*sums(2) - sums(3)
         slopes(1) = 2.0_wp*sums(2) + twice*slopes(2) - slopes(3)
         sums(2:3) = sums(1:2)
         slopes(2:3) = slopes(1:2)
      end do
      value = exp(coefficients(0) + 0.5_wp*twice*sums(2) - sums(3))
      slope = value*(sums(2) + 0.5_wp*twice*slopes(2) - slopes(3))*2.0_wp/reach
   end subroutine sum_polynomials

   !> Logarithms of both integrals at one gap, by Gauss' rule on pieces of half a scatter that end where a summit changes its law.
   pure function log_integrals(gap, scatter, flattening) result(logs)
      !> Gap from the mean plane of the summits over their scatter [-]
      real(wp), intent(in) :: gap
      !> Scatter over the roughness of the surface, s; flattening at which a summit begins to yield, w_1 [-]
      real(wp), intent(in) :: scatter, flattening
      !> ln of load and area [-]
      real(wp) :: logs(2)

      ! Points of a piece
      integer, parameter :: order = 12
      ! Length of a piece over the scatter; twice the exponent below the largest beyond which nothing counts [-]
      real(wp), parameter :: piece = 0.5_wp, far = 80.0_wp
      ! Places and weights of the points [-]
      real(wp) :: places(order), weights(order)
      ! Ends of the flattening that counts, and of laws in it, over the roughness; root of the flattening [-]
      real(wp) :: ends(4), low, high, root
      ! Weight of a flattening, with the largest exponent left out [-]
      real(wp) :: weight, terms_of(2), total(2)
      integer :: part, i, k, pieces

      call gauss_legendre(places, weights)
      ends(1) = scatter*max(0.0_wp, -gap - sqrt(far))
      ends(4) = scatter*(sqrt(max(gap, 0.0_wp)**2 + far) - gap)
      ends(2:3) = min(max(flattening*[1.0_wp, yield_range], ends(1)), ends(4))
      total = 0.0_wp
      do part = 1, 3
         pieces = ceiling((ends(part + 1) - ends(part))/(piece*scatter))
         do k = 1, pieces
            ! In the root of the flattening, of which the load is a cube
            low = sqrt(ends(part) + (ends(part + 1) - ends(part))*real(k - 1, wp)/pieces)
            high = sqrt(ends(part) + (ends(part + 1) - ends(part))*real(k, wp)/pieces)
            do i = 1, order
               root = 0.5_wp*(low + high) + 0.5_wp*(high - low)*places(i)
               weight = weights(i)*(high - low)*root &
                  & *exp(-0.5_wp*((gap + root**2/scatter)**2 - max(gap, 0.0_wp)**2))/(scatter*sqrt(2.0_wp*pi))
               call one_summit(root**2, flattening, part, terms_of(1), terms_of(2))
               total = total + weight*terms_of
            end do
         end do
      end do
      logs = log(total) - 0.5_wp*max(gap, 0.0_wp)**2
   end function log_integrals

   !> Load and area of one summit.
   pure subroutine one_summit(flattening, first, part, load, area)
      !> Flattening, and that at which it begins to yield, over the roughness [-]
      real(wp), intent(in) :: flattening, first
      !> Elastic, yielding, plastic: 1 to 3
      integer, intent(in) :: part
      !> Load over (4/3) E* sqrt(beta) sigma^(3/2), area over pi beta sigma [-]
      real(wp), intent(out) :: load, area

      ! Place between first and complete yield; area over that of an elastic summit, mean pressure over hardness [-]
      real(wp) :: t, widening, pressure

      select case (part)
      case (1)
         load = flattening*sqrt(flattening)
         area = flattening
         return
      case (2)
         t = (flattening - first)/(first*(yield_range - 1.0_wp))
         widening = 1.0_wp + t**2*(3.0_wp - 2.0_wp*t)
         pressure = 1.0_wp - (1.0_wp - yield_pressure)*(1.0_wp - log(flattening/first)/log(yield_range))
      case default
         widening = 2.0_wp
         pressure = 1.0_wp
      end select
      area = flattening*widening
      load = sqrt(first)/yield_pressure*area*pressure
   end subroutine one_summit

end module camroller_zhao_maietta_chang
