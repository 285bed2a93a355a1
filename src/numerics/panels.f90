!> Adaptive integration of several quantities at once: all are sampled at the same nodes, and panels are halved where necessary.
!>
!> In: panels, the values of all quantities at seven nodes in each. Out: integrals, integrals of the absolute values, and error
!> estimates (`errors`), which are upper bounds as a rule. The integrand is a type that extends `sampled_t`.
!>
!> The rule is the Gauss rule with three nodes and its Kronrod extension to seven: exact for polynomials of degree 11. The error
!> estimate is the root of the sum of squares of three terms: the difference of both rules, and the fifth and the sixth
!> coefficient of the interpolating polynomial in Legendre polynomials. At a kink or a jump one of them may vanish by chance; the
!> others then do not. Sources: Kronrod (1965), Nodes and Weights of Quadrature Formulas; Berntsen and Espelid, ACM Trans. Math.
!> Software 17 (1991) 233, on error estimates from several such terms.
module camroller_panels
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   implicit none
   private

   public :: sampled_t, panels_t, start_panels, add_panel, add_trapezoid, sample_panel, split_at, refine_panels, &
      & highest_terms, total_of

   !> Places of a panel
   integer, parameter, public :: panel_points = 7
   !> Which of them are those of the rule of three
   integer, parameter, public :: gauss_points(3) = [2, 4, 6]
   !> Positive nodes on [-1, 1], outermost first, and the weights of both rules there [-]
   real(wp), parameter :: outer = 0.960491268708020283423507092629080_wp, second = 0.774596669241483377035853079956480_wp, &
      & third = 0.434243749346802558002071502844628_wp
   real(wp), parameter :: kronrod(4) = [0.104656226026467265193823857192073_wp, 0.268488089868333440728569280666710_wp, &
      & 0.401397414775962222905051818618432_wp, 0.450916538658474142345110087045571_wp]
   real(wp), parameter :: gauss(2) = [5.0_wp/9.0_wp, 8.0_wp/9.0_wp]
   !> Weights of the rule of three on [0, 1] [-]
   real(wp), parameter, public :: gauss_weights(3) = 0.5_wp*[gauss(1), gauss(2), gauss(1)]
   !> Places on [0, 1] [-]
   real(wp), parameter, public :: panel_places(panel_points) = 0.5_wp*(1.0_wp + [-outer, -second, -third, 0.0_wp, third, second, &
      & outer])
   !> Weights of the rule of seven on [0, 1] [-]
   real(wp), parameter, public :: panel_weights(panel_points) = 0.5_wp*[kronrod, kronrod(3:1:-1)]
   !> Coefficients of degree 5 and 6 of the polynomial through the values, over Legendre's polynomials, from the differences and the
   !> sums of values at opposite nodes, outermost first [-]
   real(wp), parameter :: fifth(3) = [0.279226086984319099777228097127315_wp, -0.617670841024766752942759318542525_wp, &
      & 0.484178662140076336045515456826413_wp]
   real(wp), parameter :: sixth(4) = [0.158570039434041310899733116957686_wp, -0.434950705586700173980282234680070_wp, &
      & 0.608177901175700337734926997906715_wp, -0.663594470046082949308755760368663_wp]
   !> Weights of the polynomial through the values at the nodes by the barycentric formula, outermost first: one over the product of
   !> the distances of each from the others, over that of the middle one [-]
   real(wp), parameter :: half_weights(4) = [0.238956239980465031008625599860_wp, -0.655446549391069012178619756428_wp, &
      & 0.916490309410603981169994156568_wp, -1.000000000000000000000000000000_wp]
   real(wp), parameter, public :: interpolation_weights(panel_points) = [half_weights, half_weights(3:1:-1)]
   !> Panel that is no longer halved, over the largest angle or time [-]
   real(wp), parameter :: shortest = 1.0e-13_wp

   !> Quantities over one variable
   type, abstract :: sampled_t
   contains
      procedure(sample_values), deferred :: sample
   end type sampled_t

   abstract interface
      !> Values of all quantities at a point.
      subroutine sample_values(self, x, values, error)
         import :: sampled_t, error_t, wp
         !> The quantities; what they remember may change
         class(sampled_t), intent(inout) :: self
         !> The point [x]
         real(wp), intent(in) :: x
         !> Values [unit of each]
         real(wp), intent(out), contiguous :: values(:)
         !> Why there are none
         type(error_t), allocatable, intent(out) :: error
      end subroutine sample_values
   end interface

   !> Panels with their integrals
   type :: panels_t
      !> Number of panels in use
      integer :: count = 0
      !> Ends of each [x]
      real(wp), allocatable :: left(:), right(:)
      !> Integral of each quantity, of its size, and error estimate of the integral, shape (quantity, panel) [unit of each times x]
      real(wp), allocatable :: integrals(:, :), sizes(:, :), errors(:, :)
   end type panels_t

contains

   !> Begin without panels.
   pure subroutine start_panels(panels, quantities, room)
      !> The panels
      type(panels_t), intent(out) :: panels
      !> Number of quantities
      integer, intent(in) :: quantities
      !> Number of panels to have room for
      integer, intent(in) :: room

      allocate (panels%left(room), panels%right(room), panels%integrals(quantities, room), panels%sizes(quantities, room), &
         & panels%errors(quantities, room))
   end subroutine start_panels

   !> Append a panel whose values are known.
   pure subroutine add_panel(panels, left, right, values)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> Ends [x]
      real(wp), intent(in) :: left, right
      !> Values at the seven nodes, shape (quantity, node) [unit of each]
      real(wp), intent(in), contiguous :: values(:, :)

      if (panels%count == size(panels%left)) call grow(panels)
      panels%count = panels%count + 1
      call set_panel(panels, panels%count, left, right, values)
   end subroutine add_panel

   !> Append a panel by the trapezoidal rule, for a solution that is known at its ends alone.
   !>
   !> The error estimate is that of a quantity that rises or falls all the way from one end to the other.
   pure subroutine add_trapezoid(panels, left, right, values)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> Ends [x]
      real(wp), intent(in) :: left, right
      !> Values there, shape (quantity, end) [unit of each]
      real(wp), intent(in) :: values(:, :)

      if (panels%count == size(panels%left)) call grow(panels)
      panels%count = panels%count + 1
      panels%left(panels%count) = left
      panels%right(panels%count) = right
      panels%integrals(:, panels%count) = 0.5_wp*(right - left)*(values(:, 1) + values(:, 2))
      panels%sizes(:, panels%count) = 0.5_wp*(right - left)*(abs(values(:, 1)) + abs(values(:, 2)))
      panels%errors(:, panels%count) = 0.5_wp*(right - left)*abs(values(:, 2) - values(:, 1))
   end subroutine add_trapezoid

   !> Append a panel and sample it.
   subroutine sample_panel(panels, sampled, left, right, error)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> What is integrated
      class(sampled_t), intent(inout) :: sampled
      !> Ends [x]
      real(wp), intent(in) :: left, right
      !> Why there is no value at a node
      type(error_t), allocatable, intent(out) :: error

      ! Values [unit of each]
      real(wp) :: values(size(panels%integrals, 1), panel_points)

      call sample_places(sampled, left, right, values, error)
      if (.not. allocated(error)) call add_panel(panels, left, right, values)
   end subroutine sample_panel

   !> Sum over panels, panel by panel: `sum` would go through all of them for each quantity.
   pure function total_of(values) result(total)
      !> What each panel has of the quantities, shape (quantity, panel) [any]
      real(wp), intent(in), contiguous :: values(:, :)
      !> The sums [any]
      real(wp) :: total(size(values, 1))

      integer :: panel

      total = 0.0_wp
      do panel = 1, size(values, 2)
         total = total + values(:, panel)
      end do
   end function total_of

   !> Halve the panel of the largest error estimate until the sums of the estimates are within what is allowed.
   subroutine refine_panels(panels, sampled, allowed, halvings, error)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> What is integrated
      class(sampled_t), intent(inout) :: sampled
      !> Error estimate allowed of each quantity, positive [unit of each times x]
      real(wp), intent(in) :: allowed(:)
      !> Halvings that are left; zero afterwards where the error estimates are not within what is allowed
      integer, intent(inout) :: halvings
      !> Why there is no value at a node
      type(error_t), allocatable, intent(out) :: error

      ! Sums of the error estimates [unit of each times x]; ends of a panel [x]
      real(wp) :: sums(size(allowed)), left, right
      integer :: quantity, panel

      sums = total_of(panels%errors(:, :panels%count))
      do while (halvings > 0)
         if (all(sums <= allowed)) sums = total_of(panels%errors(:, :panels%count))
         if (all(sums <= allowed)) return
         quantity = maxloc(sums/allowed, 1)
         panel = maxloc(panels%errors(quantity, :panels%count), 1)
         left = panels%left(panel)
         right = panels%right(panel)
         if (right - left <= shortest*max(abs(left), abs(right))) then
            halvings = 0
            return
         end if
         sums = sums - panels%errors(:, panel)
         call split_panel(panels, sampled, panel, 0.5_wp*(left + right), error)
         if (allocated(error)) return
         sums = sums + panels%errors(:, panel) + panels%errors(:, panels%count)
         halvings = halvings - 1
      end do
   end subroutine refine_panels

   !> Two panels in the place of the one that holds a point, where a quantity has a kink, on its two sides.
   subroutine split_at(panels, sampled, place, error)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> What is integrated
      class(sampled_t), intent(inout) :: sampled
      !> The point [x]
      real(wp), intent(in) :: place
      !> Why there is no value at a node
      type(error_t), allocatable, intent(out) :: error

      ! Least length of a panel [x]
      real(wp) :: least
      integer :: panel

      least = shortest*abs(place)
      do panel = 1, panels%count
         if (panels%left(panel) + least < place .and. place < panels%right(panel) - least) then
            call split_panel(panels, sampled, panel, place, error)
            return
         end if
      end do
   end subroutine split_at

   !> Divide a panel; the second part becomes the last panel.
   subroutine split_panel(panels, sampled, panel, place, error)
      type(panels_t), intent(inout) :: panels
      !> What is integrated
      class(sampled_t), intent(inout) :: sampled
      !> Which of them
      integer, intent(in) :: panel
      !> Where [x]
      real(wp), intent(in) :: place
      !> Why there is no value at a node
      type(error_t), allocatable, intent(out) :: error

      ! Values in both parts [unit of each]; right end [x]
      real(wp) :: values(size(panels%integrals, 1), panel_points, 2), right

      right = panels%right(panel)
      call sample_places(sampled, panels%left(panel), place, values(:, :, 1), error)
      if (.not. allocated(error)) call sample_places(sampled, place, right, values(:, :, 2), error)
      if (allocated(error)) return
      call set_panel(panels, panel, panels%left(panel), place, values(:, :, 1))
      call add_panel(panels, place, right, values(:, :, 2))
   end subroutine split_panel

   !> Values at the nodes between two ends.
   subroutine sample_places(sampled, left, right, values, error)
      !> What is integrated
      class(sampled_t), intent(inout) :: sampled
      !> Ends [x]
      real(wp), intent(in) :: left, right
      !> Values, shape (quantity, node) [unit of each]
      real(wp), intent(out), contiguous :: values(:, :)
      !> Why there is no value at a node
      type(error_t), allocatable, intent(out) :: error

      integer :: point

      do point = 1, panel_points
         call sampled%sample(left + panel_places(point)*(right - left), values(:, point), error)
         if (allocated(error)) return
      end do
   end subroutine sample_places

   !> Integrals and error estimates of a panel.
   pure subroutine set_panel(panels, panel, left, right, values)
      type(panels_t), intent(inout) :: panels
      !> Which of them
      integer, intent(in) :: panel
      !> Ends [x]
      real(wp), intent(in) :: left, right
      !> Values at the seven nodes, shape (quantity, node) [unit of each]
      real(wp), intent(in), contiguous :: values(:, :)

      panels%left(panel) = left
      panels%right(panel) = right
      call integrate(size(values, 1), right - left, values, panels%integrals(:, panel), panels%sizes(:, panel), &
         & panels%errors(:, panel))
   end subroutine set_panel

   !> The same for each quantity, of which the compiler takes several at once.
   pure subroutine integrate(count, length, values, integrals, sizes, errors)
      !> Number of quantities
      integer, intent(in) :: count
      !> Length of the panel [x]
      real(wp), intent(in) :: length
      !> Values at the seven nodes [unit of each]
      real(wp), intent(in) :: values(count, panel_points)
      !> Integrals of the values, of their magnitudes, error estimates [unit of each times that of x]
      real(wp), intent(out) :: integrals(count), sizes(count), errors(count)

      ! Sums and differences of values at opposite nodes; mean; error estimates one by one [unit of the quantity]
      real(wp) :: sums(4), differences(3), mean, by_rules, by_odd, by_even
      integer :: i

      do i = 1, count
         sums(1) = values(i, 1) + values(i, 7)
         sums(2) = values(i, 2) + values(i, 6)
         sums(3) = values(i, 3) + values(i, 5)
         sums(4) = values(i, 4)
         differences(1) = values(i, 7) - values(i, 1)
         differences(2) = values(i, 6) - values(i, 2)
         differences(3) = values(i, 5) - values(i, 3)
         mean = kronrod(1)*sums(1) + kronrod(2)*sums(2) + kronrod(3)*sums(3) + kronrod(4)*sums(4)
         by_rules = mean - gauss(1)*sums(2) - gauss(2)*sums(4)
         by_odd = fifth(1)*differences(1) + fifth(2)*differences(2) + fifth(3)*differences(3)
         by_even = sixth(1)*sums(1) + sixth(2)*sums(2) + sixth(3)*sums(3) + sixth(4)*sums(4)
         integrals(i) = 0.5_wp*length*mean
         sizes(i) = length*(panel_weights(1)*abs(values(i, 1)) + panel_weights(2)*abs(values(i, 2)) &
            & + panel_weights(3)*abs(values(i, 3)) + panel_weights(4)*abs(values(i, 4)) + panel_weights(5)*abs(values(i, 5)) &
            & + panel_weights(6)*abs(values(i, 6)) + panel_weights(7)*abs(values(i, 7)))
         errors(i) = 0.5_wp*length*sqrt(by_rules**2 + by_odd**2 + by_even**2)
      end do
   end subroutine integrate

   !> Sizes of the two highest terms of the polynomial through the values at the seven nodes: what a polynomial of degree four would
   !> miss, which is more than that of degree six does.
   pure function highest_terms(values) result(terms)
      !> Values at the nodes, shape (quantity, node) [unit of each]
      real(wp), intent(in) :: values(:, :)
      !> Sum of both sizes of each quantity [unit of each]
      real(wp) :: terms(size(values, 1))

      terms = abs(fifth(1)*(values(:, 7) - values(:, 1)) + fifth(2)*(values(:, 6) - values(:, 2)) &
         & + fifth(3)*(values(:, 5) - values(:, 3))) + abs(sixth(1)*(values(:, 1) + values(:, 7)) &
         & + sixth(2)*(values(:, 2) + values(:, 6)) + sixth(3)*(values(:, 3) + values(:, 5)) + sixth(4)*values(:, 4))
   end function highest_terms

   !> Twice the room.
   pure subroutine grow(panels)
      type(panels_t), intent(inout) :: panels

      ! Larger copies
      type(panels_t) :: larger

      call start_panels(larger, size(panels%integrals, 1), max(2*panels%count, 16))
      larger%count = panels%count
      larger%left(:panels%count) = panels%left(:panels%count)
      larger%right(:panels%count) = panels%right(:panels%count)
      larger%integrals(:, :panels%count) = panels%integrals(:, :panels%count)
      larger%sizes(:, :panels%count) = panels%sizes(:, :panels%count)
      larger%errors(:, :panels%count) = panels%errors(:, :panels%count)
      panels = larger
   end subroutine grow

end module camroller_panels
