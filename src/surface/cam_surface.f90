!> State of the surfaces of cam and roller as they run: films that grow on them, what is worn away.
!>
!> In: thickness and depth at places on the cam, evenly spaced over the cam angle, and on the roller. Out: composite roughness and
!> covered part where cam and roller meet at a cam angle, with their derivatives. The contact is always at the same place of the cam
!> at the same cam angle; the roller creeps relative to the cam, so that every place on it meets all of the cam in the long run, and
!> it is in the same state all round.
module camroller_cam_surface
   use camroller_kinds, only : wp, pi, two_pi
   implicit none
   private

   public :: cam_surface_t, meeting_t, set_cam, meet_surfaces, place_angle, value_at_angle

   !> State of both surfaces
   type :: cam_surface_t
      !> Thickness of the film at the places of the cam; depth that is worn away there [m]
      real(wp), allocatable :: cam_film(:), cam_wear(:)
      !> Coefficients of the curves through both [m]
      real(wp), allocatable :: film_curve(:), wear_curve(:)
      !> Thickness and depth on the roller [m]
      real(wp) :: roller_film = 0.0_wp, roller_wear = 0.0_wp
      !> Roughness of the film over its thickness [-]; thickness at which a surface is all covered [m]
      real(wp) :: roughness_ratio = 0.0_wp, largest_thickness = huge(1.0_wp)
   end type cam_surface_t

   !> What a contact needs of the surfaces that meet in it
   type :: meeting_t
      !> Composite roughness [m] and the derivative of its logarithm over the cam angle [1/rad]
      real(wp) :: roughness = 0.0_wp, roughness_slope = 0.0_wp
      !> Part of both surfaces that is covered by film [-] and its derivative over the cam angle [1/rad]
      real(wp) :: covered = 0.0_wp, covered_slope = 0.0_wp
   end type meeting_t

contains

   !> Cam angle of a place, from full lift: the first is opposite to the nose.
   pure function place_angle(place, places) result(angle)
      !> Its number, from 1, and how many there are
      integer, intent(in) :: place, places
      !> The angle [rad]
      real(wp) :: angle

      angle = -pi + two_pi*(place - 1)/places
   end function place_angle

   !> Thickness and depth at the places of the cam, and the curves through them: depths are not negative, thicknesses neither, nor
   !> larger than the largest possible one, at and between the places.
   pure subroutine set_cam(surface, film, wear)
      !> Surfaces; out: with this cam
      type(cam_surface_t), intent(inout) :: surface
      !> Thickness and depth at the places [m]
      real(wp), intent(in) :: film(:), wear(:)

      surface%cam_film = film
      surface%cam_wear = wear
      surface%film_curve = min(max(curve_through(film), 0.0_wp), surface%largest_thickness)
      surface%wear_curve = max(curve_through(wear), 0.0_wp)
   end subroutine set_cam

   !> Coefficients of the periodic cubic B-spline that has given values at the places: `(c_(i-1) + 4 c_i + c_(i+1))/6 = v_i`, by
   !> one recursion in each direction, whose start is the sum of all that came before in earlier turns.
   !>
   !> Source: Unser, Aldroubi and Eden (1993), IEEE Trans. Signal Process. 41, 821-833.
   pure function curve_through(values) result(coefficients)
      !> Values at the places [any]
      real(wp), intent(in) :: values(:)
      !> The coefficients [any]
      real(wp) :: coefficients(size(values))

      ! Root of z^2 + 4 z + 1 within the unit circle [-]
      real(wp), parameter :: z = sqrt(3.0_wp) - 2.0_wp
      real(wp) :: forward(size(values)) ! values after the first recursion [any]
      integer :: i, n

      n = size(values)
      forward(1) = sum([(z**i*values(1 + modulo(-i, n)), i=0, n - 1)])/(1.0_wp - z**n)
      do i = 2, n
         forward(i) = values(i) + z*forward(i - 1)
      end do
      coefficients(n) = -6.0_wp*sum([(z**(i + 1)*forward(1 + modulo(n - 1 + i, n)), i=0, n - 1)])/(1.0_wp - z**n)
      do i = n - 1, 1, -1
         coefficients(i) = z*(coefficients(i + 1) - 6.0_wp*forward(i))
      end do
   end function curve_through

   !> Roughness and cover where the surfaces meet: roughnesses that are independent of each other add up by their squares, and the
   !> film's grows in proportion to its thickness; the covered part is the mean of that of both surfaces.
   pure subroutine meet_surfaces(surface, angle, bare_roughness, meeting)
      !> State of the surfaces
      type(cam_surface_t), intent(in) :: surface
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Composite roughness without film [m]
      real(wp), intent(in) :: bare_roughness
      !> What the contact needs
      type(meeting_t), intent(out) :: meeting

      ! Thickness on the cam [m], its derivative [m/rad]; square of the roughness [m^2]
      real(wp) :: film, slope, square

      call value_at_angle(surface%film_curve, angle, film, slope)
      square = bare_roughness**2 + surface%roughness_ratio**2*(film**2 + surface%roller_film**2)
      meeting%roughness = sqrt(square)
      meeting%roughness_slope = surface%roughness_ratio**2*film*slope/square
      meeting%covered = 0.5_wp*(film + surface%roller_film)/surface%largest_thickness
      meeting%covered_slope = 0.5_wp*slope/surface%largest_thickness
   end subroutine meet_surfaces

   !> Value and derivative at a cam angle of a uniform cubic B-spline of period one turn. It has two continuous derivatives and
   !> stays between the smallest and the largest of the four coefficients around; at a place it is the mean of the coefficient
   !> there, four times, and of both neighbours.
   !>
   !> Source: de Boor (1978), A Practical Guide to Splines, chapter IX.
   pure subroutine value_at_angle(coefficients, angle, value, slope)
      !> One for each place [any]
      real(wp), intent(in) :: coefficients(:)
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Value [any] and derivative there [any/rad]
      real(wp), intent(out) :: value, slope

      ! Places from the first one on; the part of an interval [-]
      real(wp) :: distance, t
      ! Coefficients around [any]
      real(wp) :: near(4)
      integer :: i, n

      n = size(coefficients)
      distance = modulo((angle + pi)/two_pi, 1.0_wp)*n
      i = min(int(distance), n - 1)
      t = distance - i
      near = coefficients(1 + modulo([i - 1, i, i + 1, i + 2], n))
      value = ((1.0_wp - t)**3*near(1) + (4.0_wp - 6.0_wp*t**2 + 3.0_wp*t**3)*near(2) &
         & + (1.0_wp + 3.0_wp*t + 3.0_wp*t**2 - 3.0_wp*t**3)*near(3) + t**3*near(4))/6.0_wp
      slope = 0.5_wp*(-(1.0_wp - t)**2*near(1) + (3.0_wp*t**2 - 4.0_wp*t)*near(2) &
         & + (1.0_wp + 2.0_wp*t - 3.0_wp*t**2)*near(3) + t**2*near(4))*n/two_pi
   end subroutine value_at_angle

end module camroller_cam_surface
