!> Lifts whose acceleration is given in segments: closed form, shape, rest at the end, refusals.
module test_lift_segments
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, kind_deck
   use camroller_lift, only : lift_t, lift_law_t, new_lift_law, evaluate_lift, stop_angles
   use closeness, only : expect_error
   implicit none
   private

   public :: collect_lift_segments

   !> Lift [m]
   real(wp), parameter :: height = 9.5e-3_wp

contains

   subroutine collect_lift_segments(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("three equal pulses of acceleration give the lift of the closed form", test_pulses), &
         new_unittest("scaled segments keep their shape, end at rest and reach full lift", test_segments), &
         new_unittest("impossible segments are refused with a message", test_segment_refusals) &
         ]
   end subroutine collect_lift_segments

   !> A lift by segments.
   function segment_lift(angles, accelerations) result(lift)
      !> Cam angles from the start of lift [deg], shape of the acceleration [any]
      real(wp), intent(in) :: angles(:), accelerations(:)
      type(lift_t) :: lift

      lift%law = "segments"
      lift%max_lift = height
      lift%segment_angles = angles*degree
      lift%segment_accelerations = accelerations
   end function segment_lift

   subroutine test_pulses(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law
      real(wp), parameter :: h = 20.0_wp*degree ! [rad]
      real(wp) :: f(0:3)

      ! Triangles of one width 2 h: the positive ones get half the height of the negative one, as velocity and lift vanish at the
      ! end. With the negative one's height as unit the lift at full lift is 5/6 h^2, and at 2 h from the start 1/2 h^2
      call new_lift_law(law, segment_lift([0.0_wp, 20.0_wp, 40.0_wp, 60.0_wp, 80.0_wp, 100.0_wp, 120.0_wp], &
         & [0.0_wp, 7.0_wp, 0.0_wp, -1.0_wp, 0.0_wp, 3.0_wp, 0.0_wp]), failure)
      call check(error, .not. allocated(failure))
      if (allocated(error)) return
      call expect_values(0.0_wp, height*[1.0_wp, 0.0_wp, -1.2_wp/h**2, 1.2_wp/h**3], "full lift")
      if (allocated(error)) return
      call expect_values(-h, height*[0.6_wp, 0.6_wp/h, 0.0_wp, -1.2_wp/h**3], "end of the first pulse")
      if (allocated(error)) return
      call expect_values(-2.0_wp*h, height*[0.1_wp, 0.3_wp/h, 0.6_wp/h**2, -0.6_wp/h**3], "top of the first pulse")
      if (allocated(error)) return
      call expect_values(2.0_wp*h, height*[0.1_wp, -0.3_wp/h, 0.6_wp/h**2, -0.6_wp/h**3], "top of the last pulse")

   contains

      subroutine expect_values(angle, expected, what)
         !> Cam angle [rad]; lift and its derivatives [m, m/rad, m/rad^2, m/rad^3]
         real(wp), intent(in) :: angle, expected(0:3)
         character(len=*), intent(in) :: what

         ! the third derivative is that behind a node
         call evaluate_lift(law, angle + 1.0e-12_wp, f)
         call check(error, all(abs(f - expected) < 1.0e-10_wp*height*[1.0_wp, 1.0_wp/h, 1.0_wp/h**2, 1.0_wp/h**3]), what)
      end subroutine expect_values

   end subroutine test_pulses

   subroutine test_segments(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law
      ! a change of sign within a segment, zeros within the flanks [deg], [any]
      real(wp), parameter :: angles(*) = [0.0_wp, 8.0_wp, 14.0_wp, 22.0_wp, 40.0_wp, 60.0_wp, 90.0_wp, 105.0_wp, 130.0_wp, &
         & 144.0_wp], &
         & shape(*) = [0.0_wp, 5.0_wp, 0.0_wp, 0.0_wp, 40.0_wp, -15.0_wp, -22.0_wp, 30.0_wp, 4.0_wp, 0.0_wp]
      real(wp), allocatable :: stops(:) ! [rad]
      real(wp) :: f(0:3), g(0:3), first, accelerations(size(angles)), highest
      integer :: i

      call new_lift_law(law, segment_lift(angles, shape), failure)
      call check(error, .not. allocated(failure))
      if (allocated(error)) return
      stops = stop_angles(law)
      first = stops(1)
      ! two nodes more, where the acceleration changes its sign
      call check(error, size(stops), size(angles) + 2)
      if (allocated(error)) return
      call check(error, stops(size(stops)) - first, 144.0_wp*degree, thr=1.0e-13_wp)
      if (allocated(error)) return
      do i = 1, size(angles)
         call evaluate_lift(law, first + angles(i)*degree, f)
         accelerations(i) = f(2)
      end do
      ! within each part the accelerations keep their ratios
      call check(error, abs(accelerations(2)/accelerations(5) - 5.0_wp/40.0_wp) < 1.0e-10_wp .and. &
         & abs(accelerations(6)/accelerations(7) - 15.0_wp/22.0_wp) < 1.0e-10_wp .and. &
         & abs(accelerations(9)/accelerations(8) - 4.0_wp/30.0_wp) < 1.0e-10_wp, "ratios")
      if (allocated(error)) return
      call evaluate_lift(law, stops(size(stops)) - 1.0e-9_wp, f)
      call check(error, all(abs(f(:1)) < 1.0e-12_wp), "rest at the end")
      if (allocated(error)) return
      call evaluate_lift(law, 0.0_wp, f)
      call check(error, abs(f(0) - height) < 1.0e-15_wp .and. abs(f(1)) < 1.0e-14_wp .and. f(2) < 0.0_wp, "full lift")
      if (allocated(error)) return
      highest = 0.0_wp
      do i = 1, 1439
         call evaluate_lift(law, first + 0.1_wp*i*degree - 1.0e-6_wp, f)
         call evaluate_lift(law, first + 0.1_wp*i*degree + 1.0e-6_wp, g)
         highest = max(highest, f(0))
         ! Lift and two derivatives change by no more than the next derivative times the distance
         call check(error, all(abs(g(:2) - f(:2)) < 2.0e-6_wp*1.0001_wp*max(abs(f(1:)), abs(g(1:))) + 1.0e-11_wp), "continuity")
         if (allocated(error)) return
      end do
      call check(error, highest <= height)
   end subroutine test_segments

   subroutine test_segment_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law
      real(wp), parameter :: angles(*) = [0.0_wp, 20.0_wp, 60.0_wp, 100.0_wp, 120.0_wp] ! [deg]

      call new_lift_law(law, segment_lift(angles, [0.0_wp, 1.0_wp, -1.0_wp, 1.0_wp]), failure)
      call expect_error(error, failure, kind_deck, "five angles or more, and as many accelerations")
      if (allocated(error)) return
      call new_lift_law(law, segment_lift(angles([1, 3, 2, 4, 5]), [0.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, 0.0_wp]), failure)
      call expect_error(error, failure, kind_deck, "start with 0 and increase")
      if (allocated(error)) return
      call new_lift_law(law, segment_lift(angles, [0.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, 0.1_wp]), failure)
      call expect_error(error, failure, kind_deck, "must be 0 at both ends")
      if (allocated(error)) return
      call new_lift_law(law, segment_lift(angles, [0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp]), failure)
      call expect_error(error, failure, kind_deck, "positive, then negative about full lift, then positive")
      if (allocated(error)) return
      call new_lift_law(law, segment_lift(angles, [0.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, 0.0_wp]), failure)
      call expect_error(error, failure, kind_deck, "positive, then negative about full lift, then positive")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("segments", height), failure)
      call expect_error(error, failure, kind_deck, "needs angles and accelerations")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("segments", 0.0_wp), failure)
      call expect_error(error, failure, kind_deck, "needs a maximum lift above zero")
   end subroutine test_segment_refusals

end module test_lift_segments
