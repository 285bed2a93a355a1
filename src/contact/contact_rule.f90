!> Quadrature over a Hertzian line contact.
!>
!> The pressure `p0 sqrt(1 - x^2/b^2)` is not smooth at the edges; with x = b sin(phi) it is `p0 cos(phi)`, and Gauss-Legendre
!> quadrature in phi converges fast: `int_0^b f(p(x)) dx = b sum_i weight_i f(p0 height_i)`.
module camroller_contact_rule
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: rule_heights, rule_weights

   !> Number of points of the rule on half a contact
   integer, parameter :: points = 24

   !> Positive nodes of 24-point Gauss-Legendre quadrature on [-1, 1] [-]; Abramowitz and Stegun (1964), table 25.4
   real(wp), parameter :: nodes(points/2) = [ &
      0.06405689286260562609_wp, 0.1911188674736163092_wp, 0.3150426796961633744_wp, 0.4337935076260451385_wp, &
      0.5454214713888395357_wp, 0.6480936519369755693_wp, 0.7401241915785543642_wp, 0.820001985973902922_wp, &
      0.8864155270044010342_wp, 0.9382745520027327585_wp, 0.9747285559713094982_wp, 0.9951872199970213602_wp]
   !> Their weights [-]
   real(wp), parameter :: weights(points/2) = [ &
      0.127938195346752157_wp, 0.1258374563468282961_wp, 0.1216704729278033912_wp, 0.1155056680537256014_wp, &
      0.1074442701159656348_wp, 0.09761865210411388827_wp, 0.08619016153195327592_wp, 0.07334648141108030573_wp, &
      0.05929858491543678075_wp, 0.04427743881741980617_wp, 0.02853138862893366318_wp, 0.01234122979998719955_wp]
   !> Angles phi of the rule [rad]
   real(wp), parameter :: angles(points) = [pi/4.0_wp*(1.0_wp - nodes), pi/4.0_wp*(1.0_wp + nodes)]

   !> Pressure at the points over that in the middle of the contact [-]
   real(wp), parameter :: rule_heights(points) = cos(angles)
   !> Weights of the points; their sum is one to the accuracy of the rule [-]
   real(wp), parameter :: rule_weights(points) = pi/4.0_wp*[weights, weights]*rule_heights

end module camroller_contact_rule
