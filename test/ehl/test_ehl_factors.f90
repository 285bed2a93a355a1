!> Rows of kept factors that are replaced give what new factors give.
module test_ehl_factors
   use testdrive, only : new_unittest, unittest_type, error_type, check
   use camroller_kinds, only : wp
   use camroller_ehl_factors, only : ehl_rows_t, ehl_factors_t, factorise, replace_rows, solve_changes
   use camroller_ehl_grid, only : ehl_grid_t, new_ehl_grid, deformation
   implicit none
   private

   public :: collect_ehl_factors

   !> Nodes; the last full one, and that when the factors were made
   integer, parameter :: nodes = 65, last = 50, last_before = 46

contains

   subroutine collect_ehl_factors(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("changes solve the equations of nodes that became full or dry", test_replaced), &
         new_unittest("rows go back to what they were when the factors were made", test_back), &
         new_unittest("too many new rows, or a node behind the unknowns, ask for new factors", test_refused)]
   end subroutine collect_ehl_factors

   !> Equations of any size, each of the nodes next to it: full nodes have them, dry nodes no pressure.
   subroutine make_rows(is_full, rows)
      logical, intent(in) :: is_full(:)
      type(ehl_rows_t), intent(out) :: rows
      integer :: i, k

      allocate (rows%by_pressure(nodes, 4), rows%by_film(nodes, 4), source=0.0_wp)
      do i = 2, nodes - 1
         rows%by_pressure(i, 3) = 1.0_wp
         if (.not. is_full(i)) cycle
         do k = max(1, 4 - i), 4
            rows%by_pressure(i, k) = cos(real(7*i + 3*k, wp)) + merge(8.0_wp, 0.0_wp, k == 3)
            rows%by_film(i, k) = sin(real(5*i + 11*k, wp))
         end do
      end do
   end subroutine make_rows

   !> A grid, full nodes up to one, and factors for those up to another.
   subroutine prepare(grid, is_full, rows, factors)
      type(ehl_grid_t), intent(out) :: grid
      logical, intent(out) :: is_full(nodes)
      type(ehl_rows_t), intent(out) :: rows
      type(ehl_factors_t), intent(out) :: factors
      integer :: i

      call new_ehl_grid(grid, nodes, 4.0_wp, 2.0_wp, 0.1_wp)
      is_full = [(i <= last_before, i=1, nodes)]
      call make_rows(is_full, rows)
      call factorise(factors, grid, rows, is_full, last)
      is_full = [(i <= last .and. i /= 20 .and. i /= last - 1, i=1, nodes)]
      call make_rows(is_full, rows)
   end subroutine prepare

   !> Largest residual of a solution in the rows as they are, over the size of the right-hand side [-].
   subroutine find_lack(grid, rows, factors, is_full, lack)
      type(ehl_grid_t), intent(in) :: grid
      type(ehl_rows_t), intent(in) :: rows
      type(ehl_factors_t), intent(in) :: factors
      logical, intent(in) :: is_full(nodes)
      real(wp), intent(out) :: lack
      real(wp) :: side(factors%unknowns + 1), pressure(nodes), level, film(nodes), value
      integer :: i, n

      n = factors%unknowns
      side = [(cos(0.1_wp*i), i=1, n + 1)]
      call solve_changes(factors, grid, rows, is_full, side, pressure, level, film)
      lack = maxval(abs(film - deformation(grid, pressure) - level))
      do i = 2, n + 1
         value = dot_product(rows%by_pressure(i, 2:4), pressure(i - 1:i + 1)) + dot_product(rows%by_film(i, 2:4), film(i - 1:i + 1))
         if (i > 2) value = value + rows%by_pressure(i, 1)*pressure(max(i - 2, 1)) + rows%by_film(i, 1)*film(max(i - 2, 1))
         lack = max(lack, abs(value - side(i - 1)))
      end do
      lack = max(lack, abs(dot_product(grid%weight, pressure) - side(n + 1)))
   end subroutine find_lack

   subroutine test_replaced(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_grid_t) :: grid
      type(ehl_rows_t) :: rows
      type(ehl_factors_t) :: factors
      logical :: is_full(nodes), is_kept
      real(wp) :: lack

      call prepare(grid, is_full, rows, factors)
      call replace_rows(factors, grid, is_full, last, is_kept)
      call check(error, is_kept .and. factors%columns == 4, "four rows differ")
      if (allocated(error)) return
      call find_lack(grid, rows, factors, is_full, lack)
      ! Round-off, which both systems raise by their condition, of the order of a thousand each
      call check(error, lack < 1.0e-10_wp, "the new equations do not hold")
   end subroutine test_replaced

   subroutine test_back(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_grid_t) :: grid
      type(ehl_rows_t) :: rows
      type(ehl_factors_t) :: factors
      logical :: is_full(nodes), is_kept
      real(wp) :: lack
      integer :: i

      call prepare(grid, is_full, rows, factors)
      call replace_rows(factors, grid, is_full, last, is_kept)
      is_full = [(i <= last_before, i=1, nodes)]
      call make_rows(is_full, rows)
      call replace_rows(factors, grid, is_full, last, is_kept)
      call check(error, is_kept .and. factors%columns == 4, "what is known of a row is kept")
      if (allocated(error)) return
      call find_lack(grid, rows, factors, is_full, lack)
      call check(error, lack < 1.0e-10_wp, "the equations of the factors do not hold")
   end subroutine test_back

   subroutine test_refused(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_grid_t) :: grid
      type(ehl_rows_t) :: rows
      type(ehl_factors_t) :: factors
      logical :: is_full(nodes), is_kept
      integer :: i

      call prepare(grid, is_full, rows, factors)
      call replace_rows(factors, grid, is_full, factors%unknowns + 2, is_kept)
      call check(error, .not. is_kept, "a node behind the unknowns")
      if (allocated(error)) return
      is_full = [(mod(i, 2) == 0, i=1, nodes)]
      call replace_rows(factors, grid, is_full, last, is_kept)
      call check(error, .not. is_kept, "half of the rows")
   end subroutine test_refused

end module test_ehl_factors
