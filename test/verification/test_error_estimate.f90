!> The estimate of a cycle's error: closed forms, and whether it holds against a tighter solution.
module test_error_estimate
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, degree
   use camroller_accuracy, only : is_checked, refine_tolerance, resolve_numerics, way_out
   use camroller_case, only : case_t, numerics_t
   use camroller_error, only : error_t
   use camroller_remarks, only : loose_tolerance, missed_accuracy, remark_lines
   use camroller_result, only : result_t, get_series, get_summary
   use camroller_run, only : run_case
   use camroller_panels, only : gauss_points, panel_places, panel_points
   use camroller_error_estimate, only : estimate_t, add_defect, end_interval, estimated_error
   use camroller_slip_errors, only : error_at, slip_errors_t
   use camroller_study_trial, only : trial_t, errors_against, largest_deviation, run_trial
   use deck_cases, only : get_deck_case
   use reference_cases, only : thesis_case, source_case, skewed_case, set_point, point_speeds, point_viscosities
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_error_estimate

   !> Margin that the estimate contains [-]
   real(wp), parameter :: margin = 2.0_wp
   !> Gauss nodes [-]
   real(wp), parameter :: nodes(3) = 0.5_wp*[1.0_wp - sqrt(0.6_wp), 1.0_wp, 1.0_wp + sqrt(0.6_wp)]

contains

   subroutine collect_error_estimate(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a constant defect with decay gives the closed form", test_constant), &
         new_unittest("without decay a defect adds up to its integral", test_integral), &
         new_unittest("under fast decay the error is the defect over the decay rate", test_stiff), &
         new_unittest("a defect that vanishes at the Gauss nodes is seen between them", test_between), &
         new_unittest("a defect at the ends of an interval enters the estimate", test_ends), &
         new_unittest("over two intervals as one, the defect of each counts", test_joined), &
         new_unittest("the error at an angle is that of the crest of its panel", test_crest), &
         new_unittest("a cycle without decay has no finite error", test_no_decay), &
         new_unittest("where disturbances grow, the estimate grows with them", test_growth), &
         new_unittest("the estimate bounds the error against the reference for every kind of method", test_methods), &
         new_unittest("method and tolerance follow from the accuracy unless given in the case", test_resolved), &
         new_unittest("errors are within the accuracy, or a remark says that it was not reached", test_kept), &
         new_unittest("a tolerance too loose for its error gives a remark", test_far_beyond) &
         ]
   end subroutine collect_error_estimate

   !> Two panels, of which the second has a crest; the angles are before it, behind it, and between both panels.
   subroutine test_crest(error)
      type(error_type), allocatable, intent(out) :: error
      type(slip_errors_t) :: errors
      real(wp), parameter :: crest = -4.0e-3_wp, usual = 1.0e-3_wp ! [m/s]

      errors%angle = [panel_places, 1.0_wp + panel_places]
      errors%error = spread(usual, 1, 2*panel_points)
      errors%error(panel_points + 3) = crest
      call check(error, error_at(errors, 1.9_wp), crest, thr=0.0_wp)
      if (.not. allocated(error)) call check(error, error_at(errors, 1.1_wp), crest, thr=0.0_wp)
      if (.not. allocated(error)) call check(error, error_at(errors, 1.0_wp), crest, thr=0.0_wp)
      if (.not. allocated(error)) call check(error, error_at(errors, 0.9_wp), usual, thr=0.0_wp)
   end subroutine test_crest

   !> Carry a defect over equal intervals.
   pure subroutine carry(defects, rate, length, intervals, estimate)
      ! Defects at the nodes [m/s/rad], decay rate [1/rad], length of an interval [rad]
      real(wp), intent(in) :: defects(3), rate, length
      integer, intent(in) :: intervals
      type(estimate_t), intent(inout) :: estimate
      integer :: i, j

      do i = 1, intervals
         do j = 1, 3
            call add_defect(estimate, nodes(j), defects(j), rate)
         end do
         call end_interval(estimate, length)
      end do
   end subroutine carry

   subroutine test_constant(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate

      call carry([0.5_wp, 0.5_wp, 0.5_wp], 2.0_wp, 0.1_wp, 10, estimate)
      call check(error, estimate%error, 0.25_wp*(1.0_wp - exp(-2.0_wp)), thr=100.0_wp*epsilon(1.0_wp))
      if (allocated(error)) return
      call check(error, estimate%contraction, exp(-2.0_wp), thr=100.0_wp*epsilon(1.0_wp))
   end subroutine test_constant

   subroutine test_integral(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate

      ! 6 x^2 - 6 x + 1 has no integral over [0, 1]
      call carry(6.0_wp*nodes**2 - 6.0_wp*nodes + 1.0_wp, 0.0_wp, 0.3_wp, 5, estimate)
      call check(error, abs(estimate%error) <= 100.0_wp*epsilon(1.0_wp))
      if (allocated(error)) return
      call carry(nodes**2, 0.0_wp, 0.3_wp, 1, estimate)
      call check(error, estimate%error, 0.1_wp, thr=100.0_wp*epsilon(1.0_wp))
   end subroutine test_integral

   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate

      call carry([3.0_wp, 3.0_wp, 3.0_wp], 1.0e6_wp, 0.01_wp, 3, estimate)
      call check(error, estimate%error, 3.0e-6_wp, thr=100.0_wp*epsilon(1.0_wp), rel=.true.)
      if (allocated(error)) return
      call check(error, estimated_error(estimate), margin*3.0e-6_wp, thr=100.0_wp*epsilon(1.0_wp), rel=.true.)
   end subroutine test_stiff

   !> Under fast decay the error at a place is the defect there over the decay rate; sampled at the Gauss nodes alone it would be
   !> none.
   subroutine test_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate
      ! Decay rate [1/rad], length [rad]: the error is the defect a ten-thousandth of the interval before
      real(wp), parameter :: rate = 1.0e6_wp, length = 0.01_wp
      ! Defects at the places [m/s/rad]
      real(wp) :: defects(panel_points)
      integer :: i

      defects = (panel_places - nodes(1))*(panel_places - nodes(2))*(panel_places - nodes(3))
      defects(gauss_points) = 0.0_wp
      do i = 1, panel_points
         if (any(gauss_points == i)) then
            call add_defect(estimate, panel_places(i), defects(i), rate)
         else
            call add_defect(estimate, panel_places(i), defects(i))
         end if
      end do
      call end_interval(estimate, length)
      ! At the end it is 0.05, the product of its distances from the nodes; a ten-thousandth before it is 12 of them less
      call check(error, estimate%error, product(1.0_wp - nodes)/rate, thr=2.0e-3_wp, rel=.true.)
      if (allocated(error)) return
      call check(error, estimate%largest >= 0.99_wp*maxval(abs(defects))/rate)
   end subroutine test_between

   !> Without decay the integral of the polynomial through points and ends is the error.
   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate
      integer :: i

      do i = 1, size(nodes)
         call add_defect(estimate, nodes(i), nodes(i)**4, 0.0_wp)
      end do
      call end_interval(estimate, 1.0_wp, [0.0_wp, 1.0_wp])
      ! Simpson's rule over a part of 0.39 at most, for a power of four: 0.39**5/120 of each
      call check(error, estimate%error, 0.2_wp, thr=3.0e-4_wp)
   end subroutine test_ends

   !> The defect of each of two intervals is a hump: the points of a panel over both show the integral of them.
   subroutine test_joined(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate
      ! Place within an interval [-]
      real(wp) :: place
      integer :: i

      do i = 1, panel_points
         place = modulo(2.0_wp*panel_places(i), 1.0_wp)
         if (any([3, 5] == i)) then
            call add_defect(estimate, panel_places(i), 16.0_wp*place**2*(1.0_wp - place)**2, 0.0_wp)
         else
            call add_defect(estimate, panel_places(i), 16.0_wp*place**2*(1.0_wp - place)**2)
         end if
      end do
      call end_interval(estimate, 1.0_wp, [0.0_wp, 0.0_wp])
      ! The integral of a hump is 16/30; that of the polynomial of degree 8 through seven points in both and the ends is 0.521
      call check(error, estimate%error, 16.0_wp/30.0_wp, thr=0.05_wp, rel=.true.)
   end subroutine test_joined

   subroutine test_no_decay(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate

      call carry([1.0_wp, 1.0_wp, 1.0_wp], 0.0_wp, 0.1_wp, 1, estimate)
      call check(error, estimated_error(estimate) > 1.0e10_wp)
   end subroutine test_no_decay

   subroutine test_growth(error)
      type(error_type), allocatable, intent(out) :: error
      type(estimate_t) :: estimate

      call carry([0.5_wp, 0.5_wp, 0.5_wp], -2.0_wp, 0.1_wp, 10, estimate)
      call check(error, estimate%error, 0.25_wp*(exp(2.0_wp) - 1.0_wp), thr=100.0_wp*epsilon(1.0_wp))
      if (allocated(error)) return
      call check(error, estimate%contraction, exp(2.0_wp), thr=1000.0_wp*epsilon(1.0_wp))
   end subroutine test_growth

   subroutine test_methods(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=16), parameter :: methods(*) = [character(len=16) :: "rodas5p", "radau5", "hermite", "dormand_prince"]
      type(case_t) :: cases(4)
      type(trial_t) :: reference, trial
      ! Error found, sum of the logarithms of the estimate over it [-]
      real(wp) :: true_error, logarithms, errors(3)
      character(len=120) :: words
      integer :: i, method, power

      cases(1:2) = thesis_case()
      call set_point(cases(1), point_speeds(1), point_viscosities(1))
      call set_point(cases(2), point_speeds(3), point_viscosities(3))
      cases(3) = source_case()
      cases(4) = skewed_case("away_from_pivot")
      logarithms = 0.0_wp
      do i = 1, size(cases)
         cases(i)%numerics%method = "rodas5p"
         cases(i)%numerics%tolerance = 1.0e-10_wp
         cases(i)%numerics%output_step = 0.1_wp*degree
         call run_trial(cases(i), 1, reference)
         do method = 1, size(methods)
            do power = 3, 6
               cases(i)%numerics%method = methods(method)
               cases(i)%numerics%tolerance = 10.0_wp**(-power)
               call run_trial(cases(i), 1, trial)
               errors = errors_against(reference, trial)
               true_error = errors(1)
               write (words, "(a, i2, 1x, a, 3es10.2)") "case", i, methods(method), cases(i)%numerics%tolerance, true_error, &
                  & trial%estimated_error
               ! Above the true error; the reference itself is good to 1e-9
               call check(error, true_error <= trial%estimated_error + 1.0e-9_wp, words)
               if (allocated(error)) return
               logarithms = logarithms + log(trial%estimated_error/true_error)
            end do
         end do
      end do
      ! On the whole not far above it: errors that flare up between two angles count in the estimate and not in the comparison
      call check(error, logarithms/(4*size(methods)*size(cases)) <= log(2.0_wp*margin))
   end subroutine test_methods

   subroutine test_resolved(error)
      type(error_type), allocatable, intent(out) :: error
      type(numerics_t) :: numerics, resolved

      numerics%accuracy = 1.0e-8_wp
      resolved = resolve_numerics(numerics)
      call check(error, resolved%method == "hermite" .and. is_checked(numerics))
      if (allocated(error)) return
      call check(error, resolved%tolerance > 0.0_wp .and. resolved%tolerance < 1.0e-8_wp .and. resolved%periodicity < 1.0e-8_wp)
      if (allocated(error)) return
      numerics%method = "radau5"
      numerics%tolerance = 1.0e-3_wp
      resolved = resolve_numerics(numerics)
      call check(error, resolved%method == "radau5" .and. .not. is_checked(numerics))
      if (allocated(error)) return
      call check(error, resolved%tolerance, 1.0e-3_wp)
      if (allocated(error)) return
      numerics%method = "euler"
      numerics%tolerance = 0.0_wp
      call check(error, .not. is_checked(numerics))
      if (allocated(error)) return
      call check(error, refine_tolerance(1.0e-5_wp, 1.0e-4_wp, 2.0e-4_wp, 0.0_wp) < 0.5e-5_wp)
      if (allocated(error)) return
      call check(error, refine_tolerance(1.0e-12_wp, 1.0e-10_wp, 1.0_wp, 0.0_wp), 1.0e-12_wp)
      if (allocated(error)) return
      call check(error, way_out(1.0e-5_wp) < 1.0e-5_wp .and. way_out(1.0e-12_wp) > 1.0e-12_wp)
   end subroutine test_resolved

   subroutine test_kept(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result, reference
      type(error_t), allocatable :: failure
      ! Sliding speeds [m/s]; estimated error [-]
      real(wp), allocatable :: values(:), right(:)
      real(wp) :: estimate
      character(len=80) :: words
      integer :: power

      the_case = source_case()
      the_case%numerics%method = "rodas5p"
      the_case%numerics%tolerance = 1.0e-9_wp
      call run_case(the_case, reference, failure)
      if (.not. allocated(failure)) call get_series(reference, "sliding_speed", right, failure)
      the_case%numerics = numerics_t()
      do power = 2, 6
         the_case%numerics%accuracy = 10.0_wp**(-power)
         if (.not. allocated(failure)) call run_case(the_case, result, failure)
         if (.not. allocated(failure)) call get_series(result, "sliding_speed", values, failure)
         if (.not. allocated(failure)) call get_summary(result, "estimated_error", estimate, failure)
         if (has_failed(failure, error)) return
         write (words, "(a, 3es10.2)") "accuracy, error, estimate", the_case%numerics%accuracy, largest_deviation(values, right), &
            & estimate
         call check(error, largest_deviation(values, right) <= the_case%numerics%accuracy, words)
         if (allocated(error)) return
         call check(error, estimate <= the_case%numerics%accuracy .and. all(result%remarks%kind /= missed_accuracy), words)
         if (allocated(error)) return
      end do
      the_case%numerics%accuracy = 1.0e-15_wp
      call run_case(the_case, result, failure)
      if (has_failed(failure, error)) return
      call check(error, any(result%remarks%kind == missed_accuracy), remark_lines(result%remarks))
   end subroutine test_kept

   !> A hard deck with a sharp limit of traction, a kink that falls within a step and costs more than so small a tolerance
   !> allows, and an ordinary case.
   subroutine test_far_beyond(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure

      call get_deck_case("decks/hard/sharp_cap.nml", the_case, failure)
      the_case%numerics%method = "hermite"
      the_case%numerics%tolerance = 1.0e-9_wp
      if (.not. allocated(failure)) call run_case(the_case, result, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (.not. allocated(error)) call check(error, any(result%remarks%kind == loose_tolerance), remark_lines(result%remarks))
      if (allocated(error)) return
      the_case = thesis_case()
      the_case%numerics%tolerance = 1.0e-6_wp
      call run_case(the_case, result, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (.not. allocated(error)) call check(error, all(result%remarks%kind /= loose_tolerance), remark_lines(result%remarks))
   end subroutine test_far_beyond

end module test_error_estimate
