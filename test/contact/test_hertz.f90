!> Dry contact and the two bodies: numbers by hand and relations that must hold.
module test_hertz
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_hertz, only : half_width, peak_pressure
   use camroller_materials, only : combined_modulus, combined_roughness
   use camroller_contact_rule, only : rule_heights, rule_weights
   implicit none
   private

   public :: collect_hertz

   !> A hundred roundings [-]
   real(wp), parameter :: roundings = 100.0_wp*epsilon(1.0_wp)

contains

   subroutine collect_hertz(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("half width and peak pressure are those of a worked example", test_example), &
         new_unittest("peak pressure over the half ellipse carries the load", test_load), &
         new_unittest("without load there is neither width nor pressure", test_no_load), &
         new_unittest("two equal steels have E/(1 - nu^2), and a rigid partner doubles it", test_modulus), &
         new_unittest("roughness adds in squares", test_roughness), &
         new_unittest("the quadrature rule integrates powers of the pressure", test_rule) &
         ]
   end subroutine collect_hertz

   subroutine test_example(error)
      type(error_type), allocatable, intent(out) :: error

      ! W = pi L E'/8, R = 4 m: b = 2 m; p_max = 2 W/(pi b L) = E'/8
      call check(error, half_width(pi/8.0_wp*2.0e11_wp, 4.0_wp, 1.0_wp, 2.0e11_wp), 2.0_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, peak_pressure(pi/8.0_wp*2.0e11_wp, 4.0_wp, 1.0_wp, 2.0e11_wp), 0.25e11_wp, thr=roundings, &
         rel=.true.)
      if (allocated(error)) return
      ! 1000 N on 10 mm, R = 5 mm, E' = 220 GPa: b = sqrt(8 1000 0.005/(pi 0.01 2.2e11)) = 76.0753 um
      call check(error, half_width(1000.0_wp, 5.0e-3_wp, 1.0e-2_wp, 2.2e11_wp), 76.0753e-6_wp, thr=1.0e-6_wp, rel=.true.)
      if (allocated(error)) return
      call check(error, peak_pressure(1000.0_wp, 5.0e-3_wp, 1.0e-2_wp, 2.2e11_wp), 0.836828e9_wp, thr=1.0e-6_wp, rel=.true.)
   end subroutine test_example

   subroutine test_load(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: load = 740.0_wp, radius = 4.1e-3_wp, length = 13.7e-3_wp, modulus = 2.018e11_wp

      call check(error, 0.5_wp*pi*half_width(load, radius, length, modulus)*length*peak_pressure(load, radius, length, modulus), &
         load, thr=roundings, rel=.true.)
   end subroutine test_load

   subroutine test_no_load(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, half_width(0.0_wp, 5.0e-3_wp, 1.0e-2_wp, 2.2e11_wp) <= 0.0_wp .and. &
         peak_pressure(0.0_wp, 5.0e-3_wp, 1.0e-2_wp, 2.2e11_wp) <= 0.0_wp)
   end subroutine test_no_load

   subroutine test_modulus(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, combined_modulus(2.0e11_wp, 0.3_wp, 2.0e11_wp, 0.3_wp), 2.0e11_wp/0.91_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, combined_modulus(2.0e11_wp, 0.3_wp, 2.0e31_wp, 0.3_wp), 4.0e11_wp/0.91_wp, thr=roundings, rel=.true.)
   end subroutine test_modulus

   subroutine test_roughness(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, combined_roughness(3.0e-7_wp, 4.0e-7_wp), 5.0e-7_wp, thr=roundings, rel=.true.)
   end subroutine test_roughness

   subroutine test_rule(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: n

      ! int_0^1 (1 - x^2)^(n/2) dx = sqrt(pi)/2 Gamma(n/2 + 1)/Gamma(n/2 + 3/2); the nodes carry 19 digits, the gammas 15
      do n = 0, 16
         call check(error, sum(rule_weights*rule_heights**n), &
            0.5_wp*sqrt(pi)*gamma(0.5_wp*n + 1.0_wp)/gamma(0.5_wp*n + 1.5_wp), thr=1.0e-14_wp, rel=.true.)
         if (allocated(error)) return
      end do
   end subroutine test_rule

end module test_hertz
