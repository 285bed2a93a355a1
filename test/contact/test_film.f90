!> Film laws: numbers by hand and the limits that joining formulas must have.
module test_film
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_film, only : groups_t, film_shape_t, film_line_t, film_law_names, film_shape, new_film_line, film_at_load, &
      is_in_range, takes_whole_load, law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari, law_masjedi_khonsari_rough, &
      law_moes
   implicit none
   private

   public :: collect_film

   !> A hundred roundings [-]
   real(wp), parameter :: roundings = 100.0_wp*epsilon(1.0_wp)

contains

   subroutine collect_film(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("with groups of one the factors are left", test_factors), &
         new_unittest("power laws have their exponents", test_exponents), &
         new_unittest("Dowson and Higginson's film of a worked example", test_example), &
         new_unittest("roughness thickens the film and vanishes with the roughness", test_rough), &
         new_unittest("below the least published speed a rough film falls as the smooth one does", test_rough_slow), &
         new_unittest("Moes: rigid and isoviscous it is 3/M", test_moes_rigid), &
         new_unittest("Moes: elastic and isoviscous it is 2.621 M^(-1/5)", test_moes_elastic), &
         new_unittest("Moes: rigid and piezoviscous it is 1.287 L^(2/3)", test_moes_rigid_piezo), &
         new_unittest("Moes: elastic and piezoviscous it is 1.311 M^(-1/8) L^(3/4)", test_moes_elastic_piezo), &
         new_unittest("Moes: the minimum dips below the centre where deformation rules, and only there", test_moes_dip), &
         new_unittest("a line of loads gives the same films as single groups", test_line), &
         new_unittest("published ranges end where they are said to", test_ranges), &
         new_unittest("only the rough regression takes the whole load", test_whole_load) &
         ]
   end subroutine collect_film

   subroutine test_factors(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: shape
      real(wp), parameter :: central(3) = [3.06_wp, 2.922_wp, 2.691_wp], minimum(3) = [2.65_wp, 1.714_wp, 1.652_wp]
      integer, parameter :: laws(3) = [law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari]
      integer :: i

      do i = 1, 3
         call film_shape(laws(i), groups_t(1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp), shape)
         call check(error, shape%central, central(i), thr=roundings, rel=.true.)
         if (allocated(error)) return
         call check(error, shape%minimum, minimum(i), thr=roundings, rel=.true.)
         if (allocated(error)) return
      end do
      call film_shape(law_masjedi_khonsari_rough, groups_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), shape)
      call check(error, shape%central, 2.691_wp*1.2_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, shape%minimum, 1.652_wp*1.026_wp, thr=roundings, rel=.true.)
   end subroutine test_factors

   subroutine test_exponents(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: shape, unit
      ! Exponents of U, G, W*: central and minimum film of each law [-]
      real(wp), parameter :: central(3, 3) = reshape([0.69_wp, 0.56_wp, -0.10_wp, 0.692_wp, 0.470_wp, -0.166_wp, &
         0.705_wp, 0.556_wp, -0.135_wp], [3, 3])
      real(wp), parameter :: minimum(3, 3) = reshape([0.70_wp, 0.54_wp, -0.13_wp, 0.694_wp, 0.568_wp, -0.128_wp, &
         0.716_wp, 0.695_wp, -0.077_wp], [3, 3])
      ! Groups, all one but for a two [-]
      real(wp) :: g(3)
      integer :: law, k

      do law = 1, 3
         call film_shape(law, groups_t(1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp), unit)
         do k = 1, 3
            g = 1.0_wp
            g(k) = 2.0_wp
            call film_shape(law, groups_t(g(1), g(2), g(3), 0.0_wp, 0.0_wp), shape)
            call check(error, log(shape%central/unit%central)/log(2.0_wp), central(k, law), thr=roundings)
            if (allocated(error)) return
            call check(error, log(shape%minimum/unit%minimum)/log(2.0_wp), minimum(k, law), thr=roundings)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_exponents

   subroutine test_example(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: shape

      ! U 1e-11, G 5000, W* 1e-4: 2.65 10^(-7.7) 10^(0.54 3.69897) 10^(0.52) = 2.65 1.99526e-8 99.4132 3.31131
      call film_shape(law_dowson_higginson, groups_t(1.0e-11_wp, 5000.0_wp, 1.0e-4_wp, 0.0_wp, 0.0_wp), shape)
      call check(error, shape%minimum, 1.740563e-5_wp, thr=1.0e-6_wp, rel=.true.)
   end subroutine test_example

   subroutine test_rough(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: smooth, rough, rougher

      call film_shape(law_masjedi_khonsari, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 0.0_wp, 0.01_wp), smooth)
      call film_shape(law_masjedi_khonsari_rough, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 2.0e-5_wp, 0.01_wp), rough)
      call film_shape(law_masjedi_khonsari_rough, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 4.0e-5_wp, 0.01_wp), rougher)
      call check(error, rough%minimum > smooth%minimum .and. rougher%minimum > rough%minimum .and. &
         rough%central > smooth%central .and. rougher%central > rough%central, "roughness does not thicken the film")
      if (allocated(error)) return
      call film_shape(law_masjedi_khonsari_rough, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 1.0e-20_wp, 0.01_wp), rough)
      call check(error, rough%central, smooth%central, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, rough%minimum, smooth%minimum, thr=roundings, rel=.true.)
   end subroutine test_rough

   !> Roughness so large that its factors alone would thicken a slower film.
   subroutine test_rough_slow(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: smooth, rough
      ! Speeds, the second the least that is published; factor of each film by roughness [-]
      real(wp), parameter :: speeds(4) = [1.01e-12_wp, 1.0e-12_wp, 1.0e-13_wp, 1.0e-30_wp]
      real(wp) :: factors(2, 4), faster
      integer :: i

      do i = 1, 4
         call film_shape(law_masjedi_khonsari, groups_t(speeds(i), 4500.0_wp, 1.0e-4_wp, 2.0e-4_wp, 0.02_wp), smooth)
         faster = rough%minimum
         call film_shape(law_masjedi_khonsari_rough, groups_t(speeds(i), 4500.0_wp, 1.0e-4_wp, 2.0e-4_wp, 0.02_wp), rough)
         factors(:, i) = [rough%minimum/smooth%minimum, rough%central/smooth%central]
         if (i > 2) call check(error, rough%minimum < 0.2_wp*faster, "a slower film is no thinner")
         if (allocated(error)) return
      end do
      call check(error, all(factors(:, 1) < factors(:, 2)) .and. all(factors(:, 1) > 0.99_wp*factors(:, 2)), "a step in the film")
      if (allocated(error)) return
      do i = 3, 4
         call check(error, all(abs(factors(:, i)/factors(:, 2) - 1.0_wp) < roundings), "roughness grows at low speed")
         if (allocated(error)) return
      end do
   end subroutine test_rough_slow

   !> Moes' central film in his own units: with U = 1/2, M is W*, L is G, and the film is H.
   function moes_film(m, l) result(film)
      real(wp), intent(in) :: m, l
      real(wp) :: film
      type(film_shape_t) :: shape

      call film_shape(law_moes, groups_t(0.5_wp, l, m, 0.0_wp, 0.0_wp), shape)
      film = shape%central
   end function moes_film

   subroutine test_moes_rigid(error)
      type(error_type), allocatable, intent(out) :: error

      ! E/R = 0.87 M^0.8 is 2e-8, its power 7/3 far below round-off; P/R is 1e-26
      call check(error, moes_film(1.0e-9_wp, 1.0e-25_wp), 3.0e9_wp, thr=1.0e-13_wp, rel=.true.)
   end subroutine test_moes_rigid

   subroutine test_moes_elastic(error)
      type(error_type), allocatable, intent(out) :: error

      ! (R/E)^(7/3) = 1e-15
      call check(error, moes_film(1.0e8_wp, 1.0e-30_wp), 2.621_wp*1.0e8_wp**(-0.2_wp), thr=1.0e-13_wp, rel=.true.)
   end subroutine test_moes_elastic

   subroutine test_moes_rigid_piezo(error)
      type(error_type), allocatable, intent(out) :: error

      ! (P/Q)^3.5 = 2e-9 of which 2/7 counts, (R/P)^3 = 1e-11
      call check(error, moes_film(1.0e-8_wp, 1.0e18_wp), 1.287e12_wp, thr=1.0e-8_wp, rel=.true.)
   end subroutine test_moes_rigid_piezo

   subroutine test_moes_elastic_piezo(error)
      type(error_type), allocatable, intent(out) :: error

      ! (Q/P)^3.5 = 5e-5 of which 2/7 counts, E/Q = 1e-8
      call check(error, moes_film(1.0e16_wp, 1.0e9_wp), 1.311_wp*1.0e-2_wp*1.0e9_wp**0.75_wp, thr=2.0e-5_wp, rel=.true.)
   end subroutine test_moes_elastic_piezo

   subroutine test_moes_dip(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: shape

      ! elastic: 1.55 over 1.77 of the numerical solution, three digits each
      call film_shape(law_moes, groups_t(0.5_wp, 1.0e3_wp, 1.0e8_wp, 0.0_wp, 0.0_wp), shape)
      call check(error, shape%minimum/shape%central, 1.55_wp/1.77_wp, thr=0.5e-3_wp)
      if (allocated(error)) return
      call film_shape(law_moes, groups_t(0.5_wp, 1.0e-3_wp, 1.0e-9_wp, 0.0_wp, 0.0_wp), shape)
      call check(error, shape%minimum, shape%central, thr=1.0e-13_wp, rel=.true.)
   end subroutine test_moes_dip

   subroutine test_line(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(film_shape_t) :: single, shape
      type(groups_t) :: groups
      integer :: law, i

      do law = 1, size(film_law_names)
         groups = groups_t(2.0e-11_wp, 4000.0_wp, 1.0e-4_wp, 3.0e-5_wp, 0.01_wp)
         call new_film_line(line, law, groups)
         do i = -8, -2
            groups%load = 3.0_wp*10.0_wp**i
            call film_shape(law, groups, single)
            call film_at_load(line, groups%load, shape)
            call check(error, shape%minimum, single%minimum, thr=roundings, rel=.true.)
            if (allocated(error)) return
            call check(error, shape%central, single%central, thr=roundings, rel=.true.)
            if (allocated(error)) return
            call check(error, shape%minimum_load_slope, single%minimum_load_slope, thr=roundings)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_line

   subroutine test_ranges(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: law

      do law = 1, size(film_law_names)
         call check(error, is_in_range(law, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 2.0e-5_wp, 0.01_wp)), &
            trim(film_law_names(law)))
         if (allocated(error)) return
         call check(error, is_in_range(law, groups_t(1.0e-11_wp, 4500.0_wp, 4.0e-6_wp, 2.0e-5_wp, 0.01_wp)) .eqv. law == law_moes, &
            "light load: "//trim(film_law_names(law)))
         if (allocated(error)) return
         call check(error, is_in_range(law, groups_t(1.0e-11_wp, 1.0e5_wp, 1.0e-4_wp, 2.0e-5_wp, 0.01_wp)) .eqv. law == law_moes, &
            "stiff oil: "//trim(film_law_names(law)))
         if (allocated(error)) return
         call check(error, is_in_range(law, groups_t(1.0e-14_wp, 4500.0_wp, 1.0e-4_wp, 2.0e-5_wp, 0.01_wp)) .eqv. law == law_moes, &
            "slow: "//trim(film_law_names(law)))
         if (allocated(error)) return
         call check(error, is_in_range(law, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 4.1e-5_wp, 0.01_wp)) .neqv. &
            law == law_masjedi_khonsari_rough, "rough: "//trim(film_law_names(law)))
         if (allocated(error)) return
         call check(error, is_in_range(law, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 2.0e-5_wp, 0.031_wp)) .neqv. &
            law == law_masjedi_khonsari_rough, "hard: "//trim(film_law_names(law)))
         if (allocated(error)) return
         call check(error, is_in_range(law, groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 2.0e-5_wp, 0.0049_wp)) .neqv. &
            law == law_masjedi_khonsari_rough, "soft: "//trim(film_law_names(law)))
         if (allocated(error)) return
      end do
   end subroutine test_ranges

   subroutine test_whole_load(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: law

      do law = 1, size(film_law_names)
         call check(error, takes_whole_load(law) .eqv. film_law_names(law) == "masjedi_khonsari_rough")
         if (allocated(error)) return
      end do
   end subroutine test_whole_load

end module test_film
