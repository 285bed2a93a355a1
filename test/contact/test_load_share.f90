!> How film and asperities share a load: the equation is satisfied, and its limits.
module test_load_share
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_film, only : groups_t, film_shape_t, film_line_t, film_law_names, new_film_line, film_at_load, &
      takes_whole_load, law_dowson_higginson, law_masjedi_khonsari, law_masjedi_khonsari_rough, law_moes
   use camroller_asperity, only : asperity_t, asperity_constants_t, new_asperity_constants, asperity_load_function, &
      asperity_area_function, asperity_law_names, law_greenwood_tripp, law_zhao_maietta_chang, &
      law_regression => law_masjedi_khonsari_asperities
   use camroller_load_share, only : share_t, share_change_t, share_load, share_change, improve_share
   implicit none
   private

   public :: collect_load_share

   !> A hundred roundings [-]
   real(wp), parameter :: roundings = 100.0_wp*epsilon(1.0_wp)
   !> Equivalent modulus [Pa], composite roughness over radius [-]: the thesis's contact
   real(wp), parameter :: modulus = 2.018e11_wp, roughness = 3.5e-5_wp

contains

   subroutine collect_load_share(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("film and asperities carry the load together, for every law, speed and load", test_residual), &
         new_unittest("without asperities the film carries everything", test_smooth), &
         new_unittest("a thick film leaves the asperities nothing", test_thick), &
         new_unittest("asperities that hardly touch carry what their law says, be it less than the rounding of the load", &
         test_hardly_touching), &
         new_unittest("at standstill a heavy load closes the film, and asperities carry what they can", test_standstill), &
         new_unittest("at standstill under a light load the dry gap is left", test_dry_gap), &
         new_unittest("slow motion tends to standstill", test_slow), &
         new_unittest("a huge load leaves the asperities a vanishing part", test_huge_load), &
         new_unittest("more load: thinner film, more on the asperities", test_monotonic), &
         new_unittest("a film that carries no load has changes of the size of the load's rounding", test_idle_film), &
         new_unittest("heat in the inlet of a rough contact acts as less speed, on film and share", test_warm_inlet), &
         new_unittest("one step from nearby is as good as the square of its change", test_improve) &
         ]
   end subroutine collect_load_share

   !> Asperities of Greenwood and Tripp with their usual constants, or of another law with the same and a usual hardness.
   subroutine make_contact(law, speed, load, line, constants, area, asperity_law)
      integer, intent(in) :: law
      real(wp), intent(in) :: speed, load
      type(film_line_t), intent(out) :: line
      type(asperity_constants_t), intent(out) :: constants
      real(wp), intent(out) :: area
      integer, intent(in), optional :: asperity_law
      type(asperity_t) :: asperity

      if (present(asperity_law)) asperity%law = asperity_law_names(asperity_law)
      call new_asperity_constants(constants, asperity, modulus, 0.01_wp*modulus)
      call new_film_line(line, law, groups_t(speed, 4440.0_wp, load, roughness, 0.01_wp))
      ! 2 b L/(E' R L) with b/R = sqrt(8 W*/pi)
      area = 2.0_wp*sqrt(8.0_wp*load/acos(-1.0_wp))/modulus
   end subroutine make_contact

   !> Asperity load at a film.
   function carried(constants, area, film) result(load)
      type(asperity_constants_t), intent(in) :: constants
      real(wp), intent(in) :: area, film
      real(wp) :: load
      real(wp) :: value, slope

      call asperity_load_function(constants, film/roughness, value, slope)
      load = constants%load_factor*area*value
   end function carried

   !> Its change with the logarithm of the film.
   function carried_slope(constants, area, film) result(size)
      type(asperity_constants_t), intent(in) :: constants
      real(wp), intent(in) :: area, film
      real(wp) :: size
      real(wp) :: value, slope

      call asperity_load_function(constants, film/roughness, value, slope)
      size = constants%load_factor*area*abs(slope)*film/roughness
   end function carried_slope

   subroutine test_residual(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: law, asperity_law

      do asperity_law = law_greenwood_tripp, law_zhao_maietta_chang
         do law = 1, size(film_law_names)
            call check_balance(law, asperity_law, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_residual

   subroutine check_balance(law, asperity_law, error)
      integer, intent(in) :: law, asperity_law
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share
      type(film_shape_t) :: shape
      real(wp) :: area, load, speed
      integer :: i, k
      logical :: has_film

      do i = -7, -3
         do k = -15, -10
            load = 2.0_wp*10.0_wp**i
            speed = 3.0_wp*10.0_wp**k
            call make_contact(law, speed, load, line, constants, area, asperity_law)
            call share_load(line, load, share, constants, area)
            call check(error, share%asperity_load >= 0.0_wp .and. share%asperity_load <= load, "asperity load out of bounds")
            if (allocated(error)) return
            ! where the film carries next to nothing its load has lost its figures, and the iteration ends at 1e-9 of the film,
            ! which moves the asperity load by as much times its logarithmic slope; a film that carries some 1e-9 of the load or
            ! less ends it early, since Newton's method follows the logarithm of that load, and is off by that load at most
            has_film = load - share%asperity_load > 1.0e-3_wp*load
            call check(error, abs(share%asperity_load - min(carried(constants, area, share%film_min), load)) &
               <= merge(1.0e-13_wp*load, 1.0e-9_wp*carried_slope(constants, area, share%film_min) + roundings*load &
               & + merge(load - share%asperity_load, 0.0_wp, load - share%asperity_load < 1.0e-8_wp*load), has_film), &
               "asperity load of "//trim(film_law_names(law)))
            if (allocated(error)) return
            if (.not. has_film) cycle
            call film_at_load(line, merge(load, load - share%asperity_load, takes_whole_load(law)), shape)
            call check(error, share%film_min, shape%minimum, thr=1.0e-11_wp, rel=.true.)
            if (allocated(error)) return
            call check(error, share%film_central, max(shape%central, shape%minimum, 1.0e-10_wp), thr=1.0e-11_wp, rel=.true.)
            if (allocated(error)) return
            call check(error, abs(share%real_area_ratio - area_ratio(constants, share%film_min)) <= roundings, "real area")
            if (allocated(error)) return
         end do
      end do
   end subroutine check_balance

   !> Real over apparent area at a film.
   function area_ratio(constants, film) result(ratio)
      type(asperity_constants_t), intent(in) :: constants
      real(wp), intent(in) :: film
      real(wp) :: ratio
      real(wp) :: value, slope

      call asperity_area_function(constants, film/roughness, value, slope)
      ratio = constants%area_factor*value
   end function area_ratio

   subroutine test_smooth(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share
      type(film_shape_t) :: shape
      real(wp) :: area
      integer :: law

      do law = 1, size(film_law_names)
         call make_contact(law, 1.0e-12_wp, 1.0e-4_wp, line, constants, area)
         call share_load(line, 1.0e-4_wp, share)
         call film_at_load(line, 1.0e-4_wp, shape)
         call check(error, share%film_min, shape%minimum, thr=roundings, rel=.true.)
         if (allocated(error)) return
         call check(error, share%film_central, max(shape%central, shape%minimum), thr=roundings, rel=.true.)
         if (allocated(error)) return
         call check(error, share%asperity_load <= 0.0_wp .and. share%real_area_ratio <= 0.0_wp, "something touches")
         if (allocated(error)) return
      end do
   end subroutine test_smooth

   subroutine test_thick(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share, smooth
      real(wp) :: area

      call make_contact(law_dowson_higginson, 1.0e-9_wp, 1.0e-4_wp, line, constants, area)
      call share_load(line, 1.0e-4_wp, share, constants, area)
      call share_load(line, 1.0e-4_wp, smooth)
      call check(error, share%asperity_load <= 0.0_wp .and. share%real_area_ratio <= 0.0_wp, "something touches")
      if (allocated(error)) return
      call check(error, share%film_min, smooth%film_min, thr=roundings, rel=.true.)
   end subroutine test_thick

   subroutine test_hardly_touching(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: load = 1.0e-4_wp
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share, near
      ! Area; speed group, what the law says at the film, smallest part of the load so far [-]
      real(wp) :: area, speed, expected, smallest, change
      integer :: i

      smallest = 1.0_wp
      do i = 0, 400
         speed = 1.0e-13_wp*10.0_wp**(0.01_wp*i)
         call make_contact(law_dowson_higginson, speed, load, line, constants, area)
         call share_load(line, load, share, constants, area)
         expected = carried(constants, area, share%film_min)
         if (.not. (expected > 0.0_wp .and. expected < 1.0e-9_wp*load)) cycle
         smallest = min(smallest, expected/load)
         ! The law's load falls with a power of some tens of the film, whose last step is 1e-9 of it
         call check(error, share%asperity_load, expected, thr=1.0e-6_wp, rel=.true.)
         if (allocated(error)) return
         call improve_share(line, load, near, constants, area, share%film_min/roughness, change)
         call check(error, near%asperity_load, expected, thr=1.0e-6_wp, rel=.true.)
         if (allocated(error)) return
      end do
      call check(error, smallest < 0.5_wp*epsilon(1.0_wp), "no contact is light enough to tell rounding from the law")
   end subroutine test_hardly_touching

   subroutine test_standstill(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share
      real(wp) :: area

      call make_contact(law_dowson_higginson, 0.0_wp, 1.0e-4_wp, line, constants, area)
      call share_load(line, 1.0e-4_wp, share, constants, area)
      call check(error, share%film_min <= 0.0_wp, "a film is left")
      if (allocated(error)) return
      call check(error, share%asperity_load, carried(constants, area, 0.0_wp), thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, share%asperity_load < 1.0e-4_wp .and. share%film_central > 0.0_wp, "limits at standstill")
   end subroutine test_standstill

   subroutine test_dry_gap(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share
      real(wp) :: area
      ! Load that the asperities of this contact carry with a gap left [-]
      real(wp), parameter :: load = 1.0e-8_wp

      call make_contact(law_dowson_higginson, 0.0_wp, load, line, constants, area)
      call share_load(line, load, share, constants, area)
      call check(error, share%film_min > 0.0_wp, "no gap is left")
      if (allocated(error)) return
      call check(error, carried(constants, area, share%film_min), load, thr=1.0e-13_wp, rel=.true.)
      if (allocated(error)) return
      call check(error, share%asperity_load, load, thr=1.0e-13_wp, rel=.true.)
   end subroutine test_dry_gap

   subroutine test_slow(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: still, slow
      real(wp) :: area
      real(wp), parameter :: loads(2) = [1.0e-8_wp, 1.0e-4_wp]
      integer :: i

      do i = 1, 2
         call make_contact(law_dowson_higginson, 0.0_wp, loads(i), line, constants, area)
         call share_load(line, loads(i), still, constants, area)
         call make_contact(law_dowson_higginson, 1.0e-30_wp, loads(i), line, constants, area)
         call share_load(line, loads(i), slow, constants, area)
         ! U^0.7 is 1e-21, the film over roughness 1e-14; where it carries nothing the iteration ends at 1e-9 of it
         call check(error, abs(slow%film_min - still%film_min) <= 1.0e-9_wp*roughness, "film")
         if (allocated(error)) return
         call check(error, abs(slow%asperity_load - still%asperity_load) <= 1.0e-9_wp*loads(i), "asperity load")
         if (allocated(error)) return
      end do
   end subroutine test_slow

   subroutine test_huge_load(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share
      real(wp) :: area

      call make_contact(law_moes, 1.0e-12_wp, 1.0_wp, line, constants, area)
      call share_load(line, 1.0_wp, share, constants, area)
      ! summits pressed flat carry 47 MPa, against a mean pressure of sqrt(pi W*/32) E' = 63 GPa; no film lets them carry more
      call check(error, share%asperity_load > 0.0_wp .and. share%asperity_load < carried(constants, area, 0.0_wp))
      if (allocated(error)) return
      call check(error, carried(constants, area, 0.0_wp), 47.0e6_wp/63.0e9_wp, thr=0.02_wp, rel=.true.)
   end subroutine test_huge_load

   subroutine test_monotonic(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share, before
      real(wp) :: area, load
      integer :: i

      before%film_min = huge(1.0_wp)
      before%asperity_load = 0.0_wp
      do i = 0, 400
         load = 1.0e-7_wp*10.0_wp**(0.06_wp*i)
         call make_contact(law_dowson_higginson, 5.0e-12_wp, load, line, constants, area)
         call share_load(line, load, share, constants, area)
         call check(error, share%film_min < before%film_min .and. share%asperity_load >= before%asperity_load &
            .and. share%asperity_load < load)
         if (allocated(error)) return
         before = share
      end do
   end subroutine test_monotonic

   subroutine test_idle_film(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: share
      type(share_change_t) :: change
      ! Load over E' R L [-], apparent area over E' R L [1/Pa]
      real(wp), parameter :: load = 1.0e-4_wp
      real(wp) :: area

      call make_contact(law_masjedi_khonsari_rough, 1.0e-11_wp, load, line, constants, area)
      call share_load(line, load, share, constants, area)
      share%asperity_load = load
      share%film_load = 0.0_wp
      change = share_change(line, load, share, 1.0_wp, 1.0_wp, 1.0_wp)
      ! Its logarithm times the film's load, at most the rounding of the load, is what forces follow
      call check(error, abs(change%film_load)*epsilon(load) <= 10.0_wp, "the change of an idle film has no bound")
   end subroutine test_idle_film

   !> The speed is that with which the smooth minimum film is thinner by the factor.
   subroutine test_warm_inlet(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line, slow, smooth, slow_smooth
      type(film_shape_t) :: thick, thin
      type(asperity_constants_t) :: constants
      type(share_t) :: cold, warm, slower
      ! Load over E' R L, speed, factor of the inlet [-]; apparent area over E' R L [1/Pa]
      real(wp), parameter :: load = 1.0e-4_wp, speed = 1.0e-11_wp, factor = 0.7_wp
      real(wp) :: area

      call make_contact(law_masjedi_khonsari_rough, speed, load, line, constants, area, law_regression)
      call make_contact(law_masjedi_khonsari_rough, speed*factor**(1.0_wp/0.716_wp), load, slow, constants, area, law_regression)
      call share_load(line, load, cold, constants, area)
      line%log_factor = log(factor)
      call share_load(line, load, warm, constants, area)
      call share_load(slow, load, slower, constants, area)
      call check(error, warm%film_min < cold%film_min .and. warm%asperity_load > 1.1_wp*cold%asperity_load, "heat is not seen")
      if (allocated(error)) return
      call check(error, all(abs([warm%film_min/slower%film_min, warm%film_central/slower%film_central, &
         & warm%asperity_load/slower%asperity_load] - 1.0_wp) < roundings), "not the contact at that speed")
      if (allocated(error)) return
      call make_contact(law_masjedi_khonsari, speed, load, smooth, constants, area)
      call make_contact(law_masjedi_khonsari, speed*factor**(1.0_wp/0.716_wp), load, slow_smooth, constants, area)
      call film_at_load(smooth, load, thick)
      call film_at_load(slow_smooth, load, thin)
      call check(error, thin%minimum/thick%minimum, factor, thr=roundings, rel=.true.)
   end subroutine test_warm_inlet

   subroutine test_improve(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(asperity_constants_t) :: constants
      type(share_t) :: exact, improved
      real(wp) :: area, change
      ! Starts, relative to the solution [-]
      real(wp), parameter :: starts(5) = [0.0_wp, 0.5_wp, 0.99_wp, 1.001_wp, 1.000001_wp]
      integer :: i

      call make_contact(law_dowson_higginson, 5.0e-12_wp, 1.0e-4_wp, line, constants, area)
      call share_load(line, 1.0e-4_wp, exact, constants, area)
      do i = 1, size(starts)
         call improve_share(line, 1.0e-4_wp, improved, constants, area, starts(i)*exact%film_min/roughness, change)
         call check(error, improved%film_min, exact%film_min, thr=max(2.0_wp*change**2, 1.0e-12_wp), rel=.true.)
         if (allocated(error)) return
         call check(error, abs(improved%asperity_load - exact%asperity_load) <= max(2.0_wp*change**2, 1.0e-12_wp)*1.0e-4_wp, &
            "asperity load")
         if (allocated(error)) return
      end do
   end subroutine test_improve

end module test_load_share
