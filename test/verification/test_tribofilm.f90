!> Growth of tribofilms, wear, stress below the surface, and surfaces that are known at places of the cam.
module test_tribofilm
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_cam_surface, only : cam_surface_t, meet_surfaces, meeting_t, place_angle, set_cam, value_at_angle
   use camroller_kinds, only : wp, two_pi
   use camroller_tribofilm, only : growth_rate, thickness_after, tribofilm_t
   use camroller_wear, only : largest_shear, orthogonal_shear, sliding_distance, time_in_contact, worn_per_second
   implicit none
   private

   public :: collect_tribofilm

contains

   subroutine collect_tribofilm(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("first-order growth and removal, in closed form", test_growth), &
         new_unittest("growth follows stress and temperature as a reaction with a barrier", test_reaction), &
         new_unittest("stresses below a line contact are those of its stress field", test_stress), &
         new_unittest("wear and sliding distance of a contact, by hand", test_wear), &
         new_unittest("what is known at places is smooth, periodic, within bounds, with exact slopes", test_places), &
         new_unittest("curves go through the places, and miss a sine between them as in closed form", test_curve) &
         ]
   end subroutine collect_tribofilm

   subroutine test_growth(error)
      type(error_type), allocatable, intent(out) :: error
      ! h_0, a, b of `dh/dt = a - b h` [m], [m/s], [1/s]; exact thickness, that of two steps [m]
      real(wp), parameter :: start = 3.0e-9_wp, growth = 2.0e-11_wp, decay = 4.0e-4_wp
      real(wp) :: exact, twice
      integer :: i

      do i = -8, 4
         associate (time => 10.0_wp**i/decay)
            exact = growth/decay + (start - growth/decay)*exp(-decay*time)
            call check(error, abs(thickness_after(start, growth, decay, time) - exact) < 1.0e-12_wp*exact, "closed form")
            if (allocated(error)) return
            twice = thickness_after(thickness_after(start, growth, decay, 0.3_wp*time), growth, decay, 0.7_wp*time)
            call check(error, abs(twice - exact) < 1.0e-12_wp*exact, "in two steps")
            if (allocated(error)) return
         end associate
      end do
      call check(error, abs(thickness_after(start, growth, 0.0_wp, 50.0_wp) - 4.0e-9_wp) < 1.0e-23_wp, "without decay")
   end subroutine test_growth

   subroutine test_reaction(error)
      type(error_type), allocatable, intent(out) :: error
      type(tribofilm_t) :: film
      ! Boltzmann's constant [J/K], Avogadro's [1/mol]
      real(wp), parameter :: boltzmann = 1.380649e-23_wp, avogadro = 6.02214076e23_wp
      real(wp) :: rate

      film%growth_rate = 1.0e-2_wp
      film%activation_energy = 80.0e3_wp
      film%activation_volume = 0.1e-27_wp
      rate = 1.0e-2_wp*exp(-(80.0e3_wp/avogadro - 3.0e8_wp*0.1e-27_wp)/(boltzmann*373.15_wp))
      call check(error, abs(growth_rate(film, -3.0e8_wp, 373.15_wp)/rate - 1.0_wp) < 1.0e-12_wp)
      if (allocated(error)) return
      ! 80 kJ/mol over 0.1 nm^3 is 1.33 GPa
      call check(error, abs(growth_rate(film, 2.0e9_wp, 373.15_wp) - 1.0e-2_wp) <= 0.0_wp, "no barrier left")
   end subroutine test_reaction

   !> Stresses by McEwen, as in Johnson (1985), section 4.2: half of the difference of principal stresses on the axis, and
   !> the shear along the surface, over p0 and b
   subroutine test_stress(error)
      type(error_type), allocatable, intent(out) :: error
      ! Place [half widths], stresses over the peak pressure [-]
      real(wp) :: x, z, m2, n2, s, largest, orthogonal
      integer :: i, k

      largest = 0.0_wp
      orthogonal = 0.0_wp
      do i = 0, 300
         do k = 1, 300
            x = 0.01_wp*i
            z = 0.01_wp*k
            s = sqrt((1.0_wp - x**2 + z**2)**2 + 4.0_wp*x**2*z**2)
            m2 = 0.5_wp*(s + 1.0_wp - x**2 + z**2)
            n2 = 0.5_wp*(s - (1.0_wp - x**2 + z**2))
            orthogonal = max(orthogonal, sqrt(n2)*(m2 - z**2)/(m2 + n2))
            if (i == 0) largest = max(largest, z - z**2/sqrt(1.0_wp + z**2))
         end do
      end do
      ! largest values on a grid are below by half of a second derivative of about one times the square of half a step
      call check(error, largest <= largest_shear .and. largest > largest_shear - 2.0e-5_wp, "largest shear")
      if (allocated(error)) return
      call check(error, orthogonal <= orthogonal_shear + epsilon(1.0_wp) .and. orthogonal > orthogonal_shear - 2.0e-5_wp, &
         & "orthogonal shear")
      if (allocated(error)) return
      ! depth over the half width, from the zero of that slope
      z = 0.7861513777574233_wp
      call check(error, abs(z - z**2/sqrt(1.0_wp + z**2) - largest_shear) < 1.0e-15_wp .and. abs(1.0_wp - z*(2.0_wp + z**2) &
         & /(1.0_wp + z**2)**1.5_wp) < 1.0e-14_wp, "it is at its depth, with a slope of zero")
      if (allocated(error)) return
      ! where x^2 = 1 - z^2 (1 + ...): sqrt(3)/2 from the middle
      x = sqrt(0.75_wp)
      z = 0.5_wp
      s = sqrt((1.0_wp - x**2 + z**2)**2 + 4.0_wp*x**2*z**2)
      m2 = 0.5_wp*(s + 1.0_wp - x**2 + z**2)
      n2 = 0.5_wp*(s - (1.0_wp - x**2 + z**2))
      call check(error, abs(sqrt(n2)*(m2 - z**2)/(m2 + n2) - orthogonal_shear) < 1.0e-15_wp, "at its depth")
   end subroutine test_stress

   subroutine test_wear(error)
      type(error_type), allocatable, intent(out) :: error

      ! 0.2 mm wide, 2 m/s, 50 turns a second: 0.1 ms of 20 ms
      call check(error, abs(time_in_contact(1.0e-4_wp, -2.0_wp, 0.02_wp) - 0.005_wp) < 1.0e-17_wp, "part of the time")
      if (allocated(error)) return
      call check(error, abs(time_in_contact(1.0e-4_wp, 0.0_wp, 0.02_wp) - 1.0_wp) <= 0.0_wp, "a contact that stays")
      if (allocated(error)) return
      call check(error, abs(sliding_distance(1.0e-4_wp, -0.1_wp, 2.0_wp, 0.02_wp) - 1.0e-5_wp) < 1.0e-19_wp, "distance")
      if (allocated(error)) return
      ! 100 N on 2 mm^2 and 0.1 m/s
      call check(error, abs(worn_per_second(1.0e-16_wp, 100.0_wp, 2.0e-6_wp, -0.1_wp) - 5.0e-10_wp) < 1.0e-23_wp, "depth")
   end subroutine test_wear

   subroutine test_places(error)
      type(error_type), allocatable, intent(out) :: error
      type(cam_surface_t) :: surface
      type(meeting_t) :: here, ahead, behind
      ! Value and slope [m], [m/rad]
      real(wp) :: value, slope, film(48)
      real(wp), parameter :: h = 1.0e-5_wp
      integer :: i

      film = [(1.0e-8_wp*(1.0_wp + sin(3.0_wp*place_angle(i, 48))), i=1, 48)]
      film(7) = 9.5e-8_wp
      surface%roller_film = 2.0e-8_wp
      surface%roughness_ratio = 2.0_wp
      surface%largest_thickness = 1.0e-7_wp
      call set_cam(surface, film, 10.0_wp*film)
      do i = -400, 400
         call value_at_angle(surface%wear_curve, 0.0317_wp*i, value, slope)
         call check(error, value >= 0.0_wp, "a depth below zero")
         if (allocated(error)) return
         call value_at_angle(surface%film_curve, 0.0317_wp*i, value, slope)
         call check(error, value >= 0.0_wp .and. value <= surface%largest_thickness, "bounds")
         if (allocated(error)) return
         call meet_surfaces(surface, 0.0317_wp*i, 1.0e-7_wp, here)
         call meet_surfaces(surface, 0.0317_wp*i + h, 1.0e-7_wp, ahead)
         call meet_surfaces(surface, 0.0317_wp*i - h, 1.0e-7_wp, behind)
         ! truncation: h^2 times a third derivative of about (48/2 pi)^3; round-off over h
         call check(error, abs(log(ahead%roughness/behind%roughness)/(2.0_wp*h) - here%roughness_slope) < 1.0e-7_wp, "roughness")
         if (allocated(error)) return
         call check(error, abs((ahead%covered - behind%covered)/(2.0_wp*h) - here%covered_slope) < 1.0e-7_wp, "cover")
         if (allocated(error)) return
      end do
      call value_at_angle([2.0_wp, 2.0_wp, 2.0_wp], 0.3_wp, value, slope)
      call check(error, abs(value - 2.0_wp) < 4.0_wp*epsilon(1.0_wp) .and. abs(slope) < 4.0_wp*epsilon(1.0_wp), "a constant")
   end subroutine test_places

   !> Between two places a cubic spline through a smooth function misses it by `t^2 (1 - t)^2 h^4/24` times the fourth derivative,
   !> in the middle 1/384; the next term is of the order of `(3 h)^2`, 0.04 with 96 places and 0.15 with 49.
   subroutine test_curve(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: numbers(2) = [96, 49]
      type(cam_surface_t) :: surface
      ! Value, slope, the most that is missed at and between places [m]; distance of places [rad]
      real(wp) :: value, slope, missed(2), h
      real(wp), allocatable :: depths(:)
      integer :: i, n, k

      do k = 1, size(numbers)
         n = numbers(k)
         h = two_pi/n
         depths = [(depth_at(place_angle(i, n)), i=1, n)]
         call set_cam(surface, 0.0_wp*depths, depths)
         missed = 0.0_wp
         do i = 1, n
            call value_at_angle(surface%wear_curve, place_angle(i, n), value, slope)
            missed(1) = max(missed(1), abs(value - depths(i)))
            call value_at_angle(surface%wear_curve, place_angle(i, n) + 0.5_wp*h, value, slope)
            missed(2) = max(missed(2), abs(value - depth_at(place_angle(i, n) + 0.5_wp*h)))
         end do
         ! round-off of angles and of 6 terms, of 3e-9 m
         call check(error, missed(1) < 1.0e-23_wp, "the curve does not go through the places")
         if (allocated(error)) return
         call check(error, abs(missed(2)*384.0_wp/((3.0_wp*h)**4*1.0e-9_wp) - 1.0_wp) < (3.0_wp*h)**2, "between the places")
         if (allocated(error)) return
         call check(error, abs(sum(surface%wear_curve) - sum(depths)) < 1.0e-13_wp*sum(depths), "the mean changes")
         if (allocated(error)) return
      end do

   contains

      !> A depth.
      pure function depth_at(angle) result(depth)
         !> Cam angle [rad]
         real(wp), intent(in) :: angle
         !> The depth [m]
         real(wp) :: depth

         depth = 1.0e-9_wp*(2.0_wp + sin(3.0_wp*angle))
      end function depth_at

   end subroutine test_curve

end module test_tribofilm
