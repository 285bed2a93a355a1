!> Remarks of results: loss of contact, the lobe concerned, and the policy that refuses such cases.
module test_result_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree, two_pi
   use camroller_bearing_asperity, only : bearing_asperity_t
   use camroller_error, only : error_t, kind_domain, kind_internal
   use camroller_case, only : case_t
   use camroller_lift, only : lift_t
   use camroller_number_text, only : number_text
   use camroller_remarks, only : bearing_width, cold_estimate, film_without_limit, foreign_asperities, orbit_out_of_range, &
      & outside_range, remark_lines, rolling_out_of_range, rubbing_bearing
   use camroller_lubricant, only : get_oil, lubricant_t, oil_t
   use camroller_result, only : find_quantity, get_summary, result_t
   use camroller_run, only : run_case
   use camroller_run_remarks, only : judge_assumptions
   use closeness, only : expect_error, has_failed
   use lobe_cases, only : fast, low_lift, run, thesis_lift, two_lobes
   use reference_cases, only : add_pin_film, thesis_case, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_result_remarks

contains

   subroutine collect_result_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("loss of contact gives a remark with fraction of the turn, speed and angles", test_remark), &
         new_unittest("the remark on loss of contact names the lobe", test_lobe_remark), &
         new_unittest("contact_policy 'stop' refuses loss of contact and no other remark", test_policy), &
         new_unittest("rolling resistance by a law for elastic contacts gives a remark where the contact is rigid", test_rolling), &
         new_unittest("a camshaft bearing whose width its law is not for gives a remark with how far", test_width), &
         new_unittest("a roller's pin whose width its law is not for gives the same remark", test_pin_width), &
         new_unittest("a pressure-viscosity coefficient estimated where it falls with the cold gives a remark", test_cold), &
         new_unittest("a film of a camshaft bearing too thin for smooth surfaces gives a remark", test_thin_film), &
         new_unittest("an orbit beyond the eccentricities of its fit gives a remark", test_far_orbit), &
         new_unittest("a rough film gives a remark with asperities of Greenwood and Tripp, not with its own", test_asperities), &
         new_unittest("roughness and hardness beyond those of a rough film's paper give a remark, or refuse the case", &
            & test_rough_range), &
         new_unittest("a scalar that a remark needs and a result lacks is an error", test_lacking) &
         ]
   end subroutine collect_result_remarks

   subroutine test_remark(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Part of the cycle [-]
      real(wp) :: share

      case = thesis_case()
      case%film%law = "moes"
      call set_point(case, fast, point_viscosities(3))
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "contact is lost for ") == 1, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, &
         & index(remark_lines(result%remarks), " % of the cycle at 3600 rev/min, at cam angles 165.4 to 194.7 deg") > 0, &
         remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "above 2937 rev/min") > 0, remark_lines(result%remarks))
      if (allocated(error)) return
      ! both angles are rounded to a tenth
      call get_summary(result, "lost_contact_share", share, failure)
      call check(error, share, (194.7_wp - 165.4_wp)/360.0_wp, thr=0.1_wp/360.0_wp)
      if (allocated(error)) return
      call set_point(case, 0.7_wp*fast, point_viscosities(3))
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "contact is lost"), 0)
   end subroutine test_remark

   subroutine test_lobe_remark(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(lift_t) :: sharp

      sharp = thesis_lift()
      sharp%opening_half_angle = 50.0_wp*degree
      sharp%closing_half_angle = 50.0_wp*degree
      case = two_lobes(low_lift(), sharp, [1, 2])
      case%film%law = "moes"
      call set_point(case, 0.7_wp*fast, point_viscosities(3))
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "lobe 2: contact is lost for ") > 0, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "lobe 1: contact is lost for "), 0, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, any(result%remarks%kind == film_without_limit .and. result%remarks%lobe == 2) .and. &
         & index(remark_lines(result%remarks), "lobe 2: mean and largest value of film") > 0, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "largest asperity_friction_share may be those of next to no") > 0 &
         & .eqv. allocated(case%asperity), remark_lines(result%remarks))
      if (allocated(error)) return
      deallocate (case%asperity)
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "asperity_friction_share"), 0, remark_lines(result%remarks))
   end subroutine test_lobe_remark

   subroutine test_policy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%contact_policy = "stop"
      call run(case, result, error)
      if (allocated(error)) return
      call set_point(case, fast, point_viscosities(3))
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_domain, "contact is lost for ")
      if (allocated(error)) return
      call expect_error(error, failure, kind_domain, "contact_policy = 'stop'")
   end subroutine test_policy

   !> On a base circle with next to no load the rolling resistance of a rigid contact goes with the root of the load. The load rises
   !> within four degrees at both ends of the event, which are 2 % of the turn.
   subroutine test_rolling(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      ! Part of the cycle on the base circle [%]
      real(wp) :: on_base_circle
      integer :: i

      do i = 1, 3
         case = thesis_case()
         call set_point(case, point_speeds(1), point_viscosities(1))
         if (i < 3) case%traction%rolling_law = "goksem_hargreaves"
         if (i > 1) case%spring%base_circle_load = 1.0e-2_wp*case%spring%base_circle_load
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, any(result%remarks%kind == rolling_out_of_range) .eqv. i == 2, remark_lines(result%remarks))
         if (allocated(error)) return
         if (i /= 2) cycle
         on_base_circle = 100.0_wp - 100.0_wp*(case%lift%opening_half_angle + case%lift%closing_half_angle)/two_pi
         associate (share => pack(result%remarks%size, result%remarks%kind == rolling_out_of_range))
            call check(error, share(1), on_base_circle, thr=3.0_wp)
         end associate
         if (allocated(error)) return
      end do
   end subroutine test_rolling

   !> A cam between two bearings, on the first of which it presses three times as hard
   function one_cam(law, motion, speed) result(case)
      character(len=*), intent(in) :: law, motion
      real(wp), intent(in) :: speed
      type(case_t) :: case

      case = thesis_case()
      call set_point(case, speed, point_viscosities(3))
      allocate (case%cam_bearings)
      associate (bearings => case%cam_bearings)
         bearings%law = law
         bearings%journal_motion = motion
         bearings%diameter = 23.0e-3_wp
         bearings%width = 20.0e-3_wp
         bearings%radial_clearance = 47.5e-6_wp
         bearings%bearing_positions = [0.0_wp, 80.0e-3_wp]
         bearings%cam_positions = [20.0e-3_wp]
         bearings%cam_phases = [0.0_wp]
         bearings%cam_lobes = [1]
         bearings%follower_angles = [0.0_wp]
         bearings%by_bearing = .true.
      end associate
      case%numerics%output_step = 0.5_wp*degree
   end function one_cam

   subroutine test_width(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      character(len=*), parameter :: laws(8) = [character(len=20) :: "long_full_sommerfeld", "long_full_sommerfeld", &
         & "long_full_sommerfeld", "short_ocvirk", "short_ocvirk", "short_ocvirk", "short_ocvirk", "finite"]
      ! Width over diameter; by which factor it is too small or too large, 0 for neither [-]
      real(wp), parameter :: ratios(8) = [0.8_wp, 1.6_wp, 2.0_wp, 0.5_wp, 0.75_wp, 1.5_wp, 4.0_wp, 1.0_wp]
      real(wp), parameter :: factors(8) = [2.5_wp, 1.25_wp, 0.0_wp, 0.0_wp, 1.5_wp, 3.0_wp, 8.0_wp, 0.0_wp]
      character(len=*), parameter :: words(8) = [character(len=80) :: &
         & "wider than 2 diameters; 'finite' covers 0.1 to 1; these have 0.8", &
         & "wider than 2 diameters; no law here covers 1 to 2; these have 1.6", "", "", &
         & "narrower than 0.5 diameters; 'finite' covers 0.1 to 1; these have 0.75", &
         & "narrower than 0.5 diameters; no law here covers 1 to 2; these have 1.5", &
         & "narrower than 0.5 diameters; 'long_full_sommerfeld' covers these; these have 4", ""]
      integer :: i

      do i = 1, size(laws)
         case = one_cam(trim(laws(i)), "quasi_steady", point_speeds(3))
         case%cam_bearings%width = ratios(i)*case%cam_bearings%diameter
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, count(result%remarks%kind == bearing_width), merge(1, 0, factors(i) > 0.0_wp))
         if (allocated(error)) return
         if (.not. factors(i) > 0.0_wp) cycle
         associate (remark => result%remarks(findloc(result%remarks%kind, bearing_width, 1)))
            call check(error, remark%size, factors(i), thr=1.0e-12_wp)
            if (allocated(error)) return
            call check(error, index(remark%text, trim(words(i))) > 0 .and. index(remark%text, trim(laws(i))//"' is for") > 0, &
               & remark%text)
            if (allocated(error)) return
         end associate
      end do
      case = one_cam("long_full_sommerfeld", "quasi_steady", point_speeds(3))
      deallocate (case%cam_bearings)
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, count(result%remarks%kind == bearing_width), 0)
   end subroutine test_width

   subroutine test_pin_width(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      character(len=*), parameter :: laws(3) = [character(len=12) :: "short_ocvirk", "short_ocvirk", "finite"]
      ! Width over diameter; by which factor it is too large, 0 where it is not [-]
      real(wp), parameter :: ratios(3) = [0.75_wp, 0.45_wp, 0.75_wp], factors(3) = [1.5_wp, 0.0_wp, 0.0_wp]
      integer :: i

      do i = 1, size(laws)
         case = thesis_case()
         call add_pin_film(case, trim(laws(i)))
         associate (film => case%needle_bearing%film)
            film%width = ratios(i)*2.0_wp*(case%mechanism%roller_radius - case%roller%wall_thickness)
         end associate
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, count(result%remarks%kind == bearing_width), merge(1, 0, factors(i) > 0.0_wp))
         if (allocated(error)) return
         if (.not. factors(i) > 0.0_wp) cycle
         associate (remark => result%remarks(findloc(result%remarks%kind, bearing_width, 1)))
            call check(error, remark%size, factors(i), thr=1.0e-12_wp)
            if (allocated(error)) return
            call check(error, remark%text, "needle_bearing.pin_law 'short_ocvirk' is for bearings narrower than 0.5 diameters; "// &
               & "'finite' covers 0.1 to 1; the pin has 0.75")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_pin_width

   subroutine test_cold(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(lubricant_t) :: sheet
      type(oil_t) :: oil, warmer
      type(error_t), allocatable :: failure
      ! Temperatures on both sides of the largest estimate [K]
      real(wp), parameter :: temperatures(3) = [243.15_wp, 253.15_wp, 283.15_wp]
      logical :: falls
      integer :: i

      sheet%temperature_law = "data_sheet"
      sheet%sae_grade = "10W-40"
      do i = 1, size(temperatures)
         case = thesis_case()
         case%lubricant = sheet
         case%operating_point%oil_temperature = temperatures(i)
         call get_oil(sheet, temperatures(i), oil, failure)
         if (.not. allocated(failure)) call get_oil(sheet, temperatures(i) + 5.0_wp, warmer, failure)
         if (has_failed(failure, error)) return
         falls = oil%pressure_viscosity < warmer%pressure_viscosity
         ! The formula has its largest value between the second and the third temperature
         call check(error, falls .eqv. i < 3)
         if (allocated(error)) return
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, count(result%remarks%kind == cold_estimate), merge(1, 0, falls))
         if (allocated(error)) return
      end do
      ! What is given is no estimate
      case%operating_point%oil_temperature = temperatures(1)
      case%lubricant%pressure_viscosity = 3.0e-8_wp
      call run(case, result, error)
      if (.not. allocated(error)) call check(error, count(result%remarks%kind == cold_estimate), 0)
   end subroutine test_cold

   !> The remark comes where the film of the series is below half of the roughness, without asperities below half a micrometre
   subroutine test_thin_film(error)
      type(error_type), allocatable, intent(out) :: error
      ! Viscosities, from one that carries both journals to one that carries neither [Pa s]
      real(wp), parameter :: oils(3) = [2.0e-2_wp, 4.0e-3_wp, 1.5e-3_wp]
      type(case_t) :: case
      type(result_t) :: result
      ! Limit of the films [m]
      real(wp) :: limit
      integer :: i, k, seen(0:2)

      do k = 1, 2
         seen = 0
         limit = 0.5e-6_wp
         do i = 1, size(oils)
            case = one_cam("finite", "quasi_steady", point_speeds(1))
            if (k == 2) then
               case%bearing_asperity = bearing_asperity_t(1.2e-6_wp, 1.0e9_wp, 0.1_wp)
               limit = 0.6e-6_wp
            end if
            call set_point(case, point_speeds(1), oils(i))
            call run(case, result, error)
            if (allocated(error)) return
            associate (films => result%series_values(::3, find_quantity(result%series, "bearing_1_film_min")), &
               & others => result%series_values(::3, find_quantity(result%series, "bearing_2_film_min")))
               call check_films(error, result, rubbing_bearing, films, others, limit, "the film of camshaft bearing 1 goes "// &
                  & "down to "//number_text(minval(films)/merge(1.0e-6_wp, 1.2e-6_wp, k == 1), 2)// &
                  & trim(merge(" um              ", " of the roughness", k == 1))//", below 0.5 for", seen)
            end associate
            if (allocated(error)) return
         end do
         call check(error, all(seen > 0), "none, one and both bearings are too thin somewhere")
         if (allocated(error)) return
      end do
   end subroutine test_thin_film

   !> There is one remark on films below a limit, with part of the turn, if one is below, and whether the second one is as well
   subroutine check_films(error, result, kind, films, others, limit, words, seen)
      type(error_type), allocatable, intent(out) :: error
      type(result_t), intent(in) :: result
      integer, intent(in) :: kind
      ! Films of both bearings at the angles of the remark, every third of the series, limit [m]
      real(wp), intent(in) :: films(:), others(:), limit
      ! What stands before the part of the turn
      character(len=*), intent(in) :: words
      ! Cases with so many bearings below the limit
      integer, intent(inout) :: seen(0:2)
      integer :: below

      below = count([minval(films), minval(others)] < limit)
      seen(below) = seen(below) + 1
      call check(error, count(result%remarks%kind == kind), min(below, 1), remark_lines(result%remarks))
      if (allocated(error) .or. below == 0) return
      associate (remark => result%remarks(findloc(result%remarks%kind, kind, 1)))
         call check(error, index(remark%text, words//" "//number_text(100.0_wp*count(films < limit)/size(films), 2)// &
            & " % of the turn") == 1, remark%text//" / "//words)
         if (allocated(error)) return
         call check(error, (index(remark%text, "; 1 other bearing too") > 0) .eqv. below == 2, remark%text)
         if (allocated(error)) return
         ! the remark's films are those of the lobe's curve, to the accuracy of the case
         call check(error, remark%size, limit/minval(films), thr=1.0e-4_wp*remark%size)
      end associate
   end subroutine check_films

   !> The fit is to eccentricities up to 0.98, and for orbits by the law of finite width alone
   subroutine test_far_orbit(error)
      type(error_type), allocatable, intent(out) :: error
      ! Viscosities, from one that carries both journals to one that carries neither [Pa s]
      real(wp), parameter :: oils(3) = [2.0e-2_wp, 5.0e-3_wp, 1.5e-3_wp]
      type(case_t) :: case
      type(result_t) :: result
      integer :: i, seen(0:2)

      seen = 0
      do i = 1, size(oils)
         case = one_cam("finite", "orbit", point_speeds(1))
         call set_point(case, point_speeds(1), oils(i))
         call run(case, result, error)
         if (allocated(error)) return
         associate (films => result%series_values(::3, find_quantity(result%series, "bearing_1_film_min")), &
            & others => result%series_values(::3, find_quantity(result%series, "bearing_2_film_min")))
            call check_films(error, result, orbit_out_of_range, films, others, 0.02_wp*47.5e-6_wp, "the orbit of the journal "// &
               & "in camshaft bearing 1 goes to an eccentricity of "//number_text(1.0_wp - minval(films)/47.5e-6_wp, 4)// &
               & ", beyond 0.98 for", seen)
         end associate
         if (allocated(error)) return
      end do
      call check(error, all(seen > 0), "none, one and both journals are beyond somewhere")
      if (allocated(error)) return
      do i = 1, 2
         case = one_cam(trim(merge("short_ocvirk", "finite      ", i == 1)), &
            & trim(merge("orbit       ", "quasi_steady", i == 1)), point_speeds(1))
         call set_point(case, point_speeds(1), 0.1_wp*oils(3))
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, result%summary_values(find_quantity(result%summary, "max_bearing_1_eccentricity")) > 0.98_wp .and. &
            & count(result%remarks%kind == orbit_out_of_range) == 0, "no fit is used")
         if (allocated(error)) return
      end do
   end subroutine test_far_orbit

   subroutine test_asperities(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      integer :: i

      do i = 1, 4
         case = thesis_case()
         if (i > 1) case%film%law = "masjedi_khonsari_rough"
         if (i == 3) case%asperity%law = "masjedi_khonsari"
         if (i == 4) deallocate (case%asperity)
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, count(result%remarks%kind == foreign_asperities), merge(1, 0, i == 2), remark_lines(result%remarks))
         if (allocated(error)) return
      end do
   end subroutine test_asperities

   !> The event has a load within the range of the law, so that roughness or hardness alone bring the remark.
   subroutine test_rough_range(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, 2
         case = thesis_case()
         case%film%law = "masjedi_khonsari_rough"
         case%asperity%law = "masjedi_khonsari"
         case%materials%hardness = 20.0e9_wp
         case%surface%cam_roughness = 0.8e-6_wp
         if (i == 2) case%film%range_policy = "stop"
         call run_case(case, result, failure)
         if (i == 2) then
            call expect_error(error, failure, kind_domain, "hardness/E' up to 0.0991, published for 0.005 to 0.03")
            return
         end if
         if (has_failed(failure, error)) return
         call check(error, any(result%remarks%kind == outside_range) .and. index(remark_lines(result%remarks), "; sigma/R up to ") &
            & > 0, remark_lines(result%remarks))
         if (allocated(error)) return
      end do
   end subroutine test_rough_range

   subroutine test_lacking(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: place

      case = thesis_case()
      call run(case, result, error)
      if (allocated(error)) return
      place = find_quantity(result%summary, "mean_slip_ratio")
      result%summary(place)%name = "another"
      call judge_assumptions(case, result, failure)
      call expect_error(error, failure, kind_internal, "mean_slip_ratio")
   end subroutine test_lacking

end module test_result_remarks
