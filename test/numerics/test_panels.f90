!> Panels: exactness, error estimates that bound the errors of kinks and jumps, and the end of halving.
module test_panels
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_panels, only : sampled_t, panels_t, start_panels, sample_panel, add_trapezoid, refine_panels, split_at
   implicit none
   private

   public :: collect_panels

   !> Round-off allowed in values of order one [-]
   real(wp), parameter :: round_off = 100.0_wp*epsilon(1.0_wp)
   !> Number of functions in the family below
   integer, parameter :: shapes = 6

   !> Powers of x
   type, extends(sampled_t) :: powers_t
      !> Power of the first
      integer :: lowest = 0
   contains
      procedure :: sample => sample_powers
   end type powers_t

   !> Kink, jump, root, square and cube beyond a place, and a small kink on a large smooth part
   type, extends(sampled_t) :: shapes_t
      !> Place [-]
      real(wp) :: place
   contains
      procedure :: sample => sample_shapes
   end type shapes_t

contains

   subroutine collect_panels(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a panel is exact to degree 11 in all quantities, and its error estimate is zero to degree 4", test_exact), &
         new_unittest("error estimates bound the errors of kinks, jumps and roots, wherever they are", test_estimates), &
         new_unittest("halving ends within what is allowed, also with more panels than there was room for", test_halving), &
         new_unittest("two panels that meet at a kink have the integrals that one has not", test_split), &
         new_unittest("where the halvings do not suffice, none is left", test_not_reached), &
         new_unittest("the error estimate of a trapezoid bounds the error of what rises all the way", test_trapezoid) &
         ]
   end subroutine collect_panels

   subroutine sample_powers(self, x, values, error)
      class(powers_t), intent(inout) :: self
      real(wp), intent(in) :: x
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      values = [(x**(self%lowest + i - 1), i=1, size(values))]
   end subroutine sample_powers

   subroutine sample_shapes(self, x, values, error)
      class(shapes_t), intent(inout) :: self
      real(wp), intent(in) :: x
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error

      associate (beyond => max(x - self%place, 0.0_wp))
         values = [beyond, merge(1.0_wp, 0.0_wp, beyond > 0.0_wp), sqrt(beyond), beyond**2, beyond**3, 5.0_wp + 3.0_wp*x &
            & - 2.0_wp*x**2 + 1.0e-3_wp*beyond]
      end associate
   end subroutine sample_shapes

   !> Integrals of the shapes over [0, 1] in closed form.
   pure function right_integrals(place) result(integrals)
      real(wp), intent(in) :: place
      real(wp) :: integrals(shapes)

      associate (rest => 1.0_wp - place)
         integrals = [rest**2/2.0_wp, rest, rest**1.5_wp/1.5_wp, rest**3/3.0_wp, rest**4/4.0_wp, 5.0_wp + 3.0_wp/2.0_wp &
            & - 2.0_wp/3.0_wp + 1.0e-3_wp*rest**2/2.0_wp]
      end associate
   end function right_integrals

   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: highest = 12
      type(powers_t) :: powers
      type(panels_t) :: panels
      type(error_t), allocatable :: failure
      integer :: i

      call start_panels(panels, highest + 1, 1)
      call sample_panel(panels, powers, 0.0_wp, 1.0_wp, failure)
      do i = 0, highest - 1
         call check(error, panels%integrals(i + 1, 1), 1.0_wp/(i + 1), thr=round_off)
         if (allocated(error)) return
         call check(error, (panels%errors(i + 1, 1) <= round_off) .eqv. i < 5)
         if (allocated(error)) return
      end do
      call check(error, abs(panels%integrals(highest + 1, 1) - 1.0_wp/(highest + 1)) > round_off)
   end subroutine test_exact

   !> One panel each, at 997 places. Where the place is beyond the outermost point the panel sees nothing; the shapes are small
   !> there, and so is the error: the outermost point is at 0.02.
   subroutine test_estimates(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: places = 997
      type(shapes_t) :: sampled
      type(panels_t) :: panels
      type(error_t), allocatable :: failure
      ! Errors found, what no point sees [-]
      real(wp) :: errors(shapes), unseen(shapes)
      character(len=60) :: words
      integer :: i, j

      do i = 1, places
         sampled%place = (i - 0.5_wp)/places
         call start_panels(panels, shapes, 1)
         call sample_panel(panels, sampled, 0.0_wp, 1.0_wp, failure)
         errors = abs(panels%integrals(:, 1) - right_integrals(sampled%place))
         ! The largest error of a place outside all points, and for the smoothest shapes of one just inside
         unseen = [2.0e-4_wp, 2.0e-2_wp, 2.0e-3_wp, 1.0e-5_wp, 1.0e-6_wp, 2.0e-7_wp]
         do j = 1, shapes
            write (words, "(i2, f8.4, 2es12.3)") j, sampled%place, errors(j), panels%errors(j, 1)
            call check(error, errors(j) <= 1.1_wp*panels%errors(j, 1) + unseen(j), words)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_estimates

   subroutine test_halving(error)
      type(error_type), allocatable, intent(out) :: error
      type(shapes_t) :: sampled
      type(panels_t) :: panels
      type(error_t), allocatable :: failure
      ! Doubts allowed [-]
      real(wp) :: allowed(shapes)
      integer :: halvings, i

      sampled%place = 1.0_wp/sqrt(7.0_wp)
      allowed = [1.0e-10_wp, 1.0e-8_wp, 1.0e-9_wp, 1.0e-11_wp, 1.0e-12_wp, 1.0e-12_wp]
      call start_panels(panels, shapes, 2)
      call sample_panel(panels, sampled, 0.0_wp, 0.5_wp, failure)
      call sample_panel(panels, sampled, 0.5_wp, 1.0_wp, failure)
      halvings = 200
      call refine_panels(panels, sampled, allowed, halvings, failure)
      call check(error, halvings > 0 .and. panels%count == 202 - halvings)
      if (allocated(error)) return
      call check(error, all(sum(panels%errors(:, :panels%count), 2) <= allowed))
      if (allocated(error)) return
      call check(error, sum(panels%right(:panels%count) - panels%left(:panels%count)), 1.0_wp, thr=round_off)
      if (allocated(error)) return
      associate (errors => abs(sum(panels%integrals(:, :panels%count), 2) - right_integrals(sampled%place)))
         do i = 1, shapes
            call check(error, errors(i) <= allowed(i) + round_off)
            if (allocated(error)) return
         end do
      end associate
   end subroutine test_halving

   subroutine test_split(error)
      type(error_type), allocatable, intent(out) :: error
      ! Kink, jump, square, cube, small kink: without the root
      integer, parameter :: smooth(5) = [1, 2, 4, 5, 6]
      type(shapes_t) :: sampled
      type(panels_t) :: panels
      type(error_t), allocatable :: failure
      real(wp) :: expected(shapes)

      sampled%place = 1.0_wp/sqrt(7.0_wp)
      expected = right_integrals(sampled%place)
      call start_panels(panels, shapes, 1)
      call sample_panel(panels, sampled, 0.0_wp, 1.0_wp, failure)
      call check(error, all(abs(panels%integrals([1, 2], 1) - expected([1, 2])) > 1.0e-4_wp), "no error to mend")
      if (allocated(error)) return
      ! An end of a panel and a point outside of all change nothing
      call split_at(panels, sampled, 1.0_wp, failure)
      call split_at(panels, sampled, 2.0_wp, failure)
      call check(error, panels%count, 1)
      if (allocated(error)) return
      call split_at(panels, sampled, sampled%place, failure)
      call check(error, panels%count, 2)
      if (allocated(error)) return
      associate (errors => abs(sum(panels%integrals(:, :2), 2) - expected))
         call check(error, all(errors(smooth) <= round_off), "integrals")
      end associate
   end subroutine test_split

   subroutine test_not_reached(error)
      type(error_type), allocatable, intent(out) :: error
      type(shapes_t) :: sampled
      type(panels_t) :: panels
      type(error_t), allocatable :: failure
      integer :: halvings, i

      sampled%place = 1.0_wp/sqrt(7.0_wp)
      call start_panels(panels, shapes, 2)
      call sample_panel(panels, sampled, 0.0_wp, 1.0_wp, failure)
      halvings = 5
      call refine_panels(panels, sampled, [(1.0e-10_wp, i=1, shapes)], halvings, failure)
      call check(error, halvings == 0 .and. panels%count == 6)
      if (allocated(error)) return
      call check(error, any(sum(panels%errors(:, :6), 2) > 1.0e-10_wp))
   end subroutine test_not_reached

   subroutine test_trapezoid(error)
      type(error_type), allocatable, intent(out) :: error
      type(panels_t) :: panels

      call start_panels(panels, 2, 1)
      call add_trapezoid(panels, 1.0_wp, 3.0_wp, reshape([1.0_wp, -1.0_wp, 5.0_wp, -1.0_wp], [2, 2]))
      call check(error, panels%integrals(1, 1), 6.0_wp, thr=round_off)
      if (allocated(error)) return
      ! What stays at 1 and jumps to 5 at the end has the integral 2
      call check(error, panels%errors(1, 1), 4.0_wp, thr=round_off)
      if (allocated(error)) return
      call check(error, panels%errors(2, 1) <= 0.0_wp .and. abs(panels%sizes(2, 1) - 2.0_wp) <= round_off)
   end subroutine test_trapezoid

end module test_panels
