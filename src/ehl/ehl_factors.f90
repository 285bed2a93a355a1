!> Linear equations of Newton's method for a line contact, solved with the LU factors of an earlier Jacobian.
!>
!> In: derivatives of the equations, full nodes, right-hand side. Out: change of pressure, level and film. Each equation depends
!> on pressure and film at four nodes, and the film on all pressures, so the matrix is dense, and factoring it dominates the cost
!> of large grids. A node that becomes full or dry changes its own row only, so rows can be replaced exactly without factoring
!> again (Sherman and Morrison 1950; Woodbury 1950): with `Z` the solutions for unit right-hand sides in the replaced rows, `y +
!> Z w` satisfies all other rows for any w, and the new rows determine w. The deformation caused by each column of `Z` is stored
!> with it, so that a new row, which needs film and pressure at four nodes only, costs no product with the influence matrix.
module camroller_ehl_factors
   use camroller_kinds, only : wp
   use camroller_lapack, only : dgesv, dgetrf, dgetrs
   use camroller_ehl_grid, only : ehl_grid_t, deformation
   implicit none
   private

   public :: ehl_rows_t, ehl_factors_t, factorise, replace_rows, solve_changes

   !> Derivatives of all equations
   type :: ehl_rows_t
      !> Of the equation of an inner node i over total pressure, then film, at the nodes i - 2 to i + 1 [-]
      real(wp), allocatable :: by_pressure(:, :), by_film(:, :)
   end type ehl_rows_t

   !> Factors, and what replaces some of their rows
   type :: ehl_factors_t
      !> Unknown pressures in the factors; zero: there are none
      integer :: unknowns = 0
      !> Contraction that they brought last [-]
      real(wp) :: rate = 0.0_wp
      !> Factors of the derivative, scaled by rows [-]; their rows' scales [-]; pivots
      real(wp), allocatable :: factors(:, :), scale(:)
      integer, allocatable :: pivots(:)
      !> Was a node full when they were made?
      logical, allocatable :: was_full(:)
      !> Rows that may be replaced; column of each node's row, or zero
      integer :: columns = 0
      integer, allocatable :: column_of(:)
      !> Solutions for a unit right-hand side in such a row, and the film that goes with them [-]
      real(wp), allocatable :: solution(:, :), film(:, :)
   end type ehl_factors_t

   !> Unknowns a row that may be replaced; new factors cost less than more. Dry nodes kept as unknowns behind the end of the
   !> film, at least, and unknowns for each more
   integer, parameter :: unknowns_a_row = 12, least_margin = 2, unknowns_a_margin = 48

contains

   !> Factors of the derivative of all equations over all unknowns: pressures up to `last`, the last node whose pressure is not
   !> known to be zero, and a few more, and the level.
   pure subroutine factorise(factors, grid, rows, is_full, last)
      !> The factors
      type(ehl_factors_t), intent(inout) :: factors
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Derivatives
      type(ehl_rows_t), intent(in) :: rows
      !> Which nodes are full?
      logical, intent(in) :: is_full(:)
      !> Last node whose pressure is unknown
      integer, intent(in) :: last

      integer :: i, j, n, info

      n = min(last - 1 + least_margin + last/unknowns_a_margin, grid%size - 2)
      factors%unknowns = 0
      call make_room(factors, n, grid%size)
      associate (a => factors%factors, scale => factors%scale, by_film => rows%by_film, kernel => grid%kernel)
         do j = 2, n + 1
            a(1, j - 1) = sum(by_film(2, 2:4)*kernel(1:3, j))
            do i = 3, n + 1
               a(i - 1, j - 1) = by_film(i, 1)*kernel(i - 2, j) + by_film(i, 2)*kernel(i - 1, j) &
                  & + by_film(i, 3)*kernel(i, j) + by_film(i, 4)*kernel(i + 1, j)
            end do
            do i = max(2, j - 1), min(n + 1, j + 2)
               a(i - 1, j - 1) = a(i - 1, j - 1) + rows%by_pressure(i, j - i + 3)
            end do
         end do
         a(:n, n + 1) = sum(by_film(2:n + 1, :), dim=2)
         a(n + 1, :n) = grid%weight(2:n + 1)
         a(n + 1, n + 1) = 0.0_wp
         scale = 0.0_wp
         do j = 1, n + 1
            scale = max(scale, abs(a(:, j)))
         end do
         if (.not. all(scale > 0.0_wp .and. scale < huge(1.0_wp))) return
         scale = 1.0_wp/scale
         do j = 1, n + 1
            a(:, j) = a(:, j)*scale
         end do
         call dgetrf(n + 1, n + 1, a, n + 1, factors%pivots, info)
      end associate
      factors%was_full = is_full
      factors%columns = 0
      factors%column_of = 0
      if (info == 0) factors%unknowns = n
   end subroutine factorise

   !> Allocate factors for a number of unknown pressures.
   pure subroutine make_room(factors, unknowns, nodes)
      type(ehl_factors_t), intent(inout) :: factors
      !> Unknown pressures, nodes
      integer, intent(in) :: unknowns, nodes

      if (allocated(factors%factors)) then
         if (size(factors%scale) == unknowns + 1 .and. size(factors%column_of) == nodes) return
         deallocate (factors%factors, factors%scale, factors%pivots, factors%column_of, factors%solution, factors%film)
      end if
      allocate (factors%factors(unknowns + 1, unknowns + 1), factors%scale(unknowns + 1), factors%pivots(unknowns + 1), &
         & factors%column_of(nodes), factors%solution(unknowns + 1, unknowns/unknowns_a_row), &
         & factors%film(nodes, unknowns/unknowns_a_row))
   end subroutine make_room

   !> Make kept factors serve these full nodes, where fewer rows are to be replaced than new factors would cost.
   pure subroutine replace_rows(factors, grid, is_full, last, is_kept)
      !> The factors
      type(ehl_factors_t), intent(inout) :: factors
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Which nodes are full?
      logical, intent(in) :: is_full(:)
      !> Last node whose pressure is unknown
      integer, intent(in) :: last
      !> Do they?
      logical, intent(out) :: is_kept

      ! Solution at all nodes [-]
      real(wp) :: pressure(grid%size)
      integer :: i, k, n, info

      n = factors%unknowns
      is_kept = n > 0 .and. last <= n + 1
      if (.not. is_kept) return
      is_kept = factors%columns + count((is_full .neqv. factors%was_full) .and. factors%column_of == 0) <= size(factors%solution, 2)
      if (.not. is_kept) return
      do i = 2, n + 1
         if ((is_full(i) .eqv. factors%was_full(i)) .or. factors%column_of(i) > 0) cycle
         k = factors%columns + 1
         factors%columns = k
         factors%column_of(i) = k
         factors%solution(:, k) = 0.0_wp
         factors%solution(i - 1, k) = factors%scale(i - 1)
         call dgetrs("N", n + 1, 1, factors%factors, n + 1, factors%pivots, factors%solution(:, k), n + 1, info)
         pressure = 0.0_wp
         pressure(2:n + 1) = factors%solution(:n, k)
         factors%film(:, k) = deformation(grid, pressure) + factors%solution(n + 1, k)
      end do
   end subroutine replace_rows

   !> Changes of pressure, level and film for a right-hand side; the largest number as level where there is no solution.
   pure subroutine solve_changes(factors, grid, rows, is_full, side, pressure, level, film)
      !> The factors; rows that differ are prepared
      type(ehl_factors_t), intent(in) :: factors
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Derivatives now
      type(ehl_rows_t), intent(in) :: rows
      !> Which nodes are full now?
      logical, intent(in) :: is_full(:)
      !> Right-hand side: inner nodes, load [-]
      real(wp), intent(in) :: side(factors%unknowns + 1)
      !> Changes of the total pressure at the nodes, of the level, of the film [-]
      real(wp), intent(out) :: pressure(grid%size), level, film(grid%size)

      ! Solution for the rows as they were, then for all; parts of the columns [-]
      real(wp) :: solution(factors%unknowns + 1)
      real(wp), allocatable :: parts(:)
      integer, allocatable :: nodes(:)
      integer :: i, k, n, info

      n = factors%unknowns
      solution = side*factors%scale
      call dgetrs("N", n + 1, 1, factors%factors, n + 1, factors%pivots, solution, n + 1, info)
      pressure = 0.0_wp
      pressure(2:n + 1) = solution(:n)
      level = solution(n + 1)
      film = deformation(grid, pressure) + level
      nodes = pack([(i, i=2, n + 1)], is_full(2:n + 1) .neqv. factors%was_full(2:n + 1))
      if (size(nodes) == 0) return
      parts = [(side(nodes(k) - 1) - row_times(rows, nodes(k), pressure, film), k=1, size(nodes))]
      call find_parts(factors, rows, nodes, parts, info)
      if (info /= 0) level = huge(1.0_wp)
      if (info /= 0) return
      do k = 1, size(nodes)
         i = factors%column_of(nodes(k))
         pressure(2:n + 1) = pressure(2:n + 1) + parts(k)*factors%solution(:n, i)
         level = level + parts(k)*factors%solution(n + 1, i)
         film = film + parts(k)*factors%film(:, i)
      end do
   end subroutine solve_changes

   !> Parts of the columns with which the new rows hold.
   pure subroutine find_parts(factors, rows, nodes, parts, info)
      type(ehl_factors_t), intent(in) :: factors
      !> Derivatives now
      type(ehl_rows_t), intent(in) :: rows
      !> Nodes whose rows are new
      integer, intent(in) :: nodes(:)
      !> In: what the rows lack; out: parts [-]
      real(wp), intent(inout) :: parts(:)
      !> 0 where there are such parts
      integer, intent(out) :: info

      ! New rows times the columns; a column's pressure at all nodes, size of a row [-]
      real(wp) :: matrix(size(nodes), size(nodes)), pressure(size(rows%by_film, 1)), row_size
      integer :: pivots(size(nodes)), i, k, column

      info = 1
      pressure = 0.0_wp
      do k = 1, size(nodes)
         column = factors%column_of(nodes(k))
         pressure(2:factors%unknowns + 1) = factors%solution(:factors%unknowns, column)
         do i = 1, size(nodes)
            matrix(i, k) = row_times(rows, nodes(i), pressure, factors%film(:, column))
         end do
      end do
      do i = 1, size(nodes)
         row_size = maxval(abs(matrix(i, :)))
         if (.not. (row_size > 0.0_wp .and. row_size < huge(1.0_wp))) return
         matrix(i, :) = matrix(i, :)/row_size
         parts(i) = parts(i)/row_size
      end do
      call dgesv(size(nodes), 1, matrix, size(nodes), pivots, parts, size(nodes), info)
   end subroutine find_parts

   !> Row of the derivative times a change.
   pure function row_times(rows, i, pressure, film) result(value)
      !> Derivatives
      type(ehl_rows_t), intent(in) :: rows
      !> The row's node
      integer, intent(in) :: i
      !> Change of pressure and film at the nodes [-]
      real(wp), intent(in) :: pressure(:), film(:)
      !> The product [-]
      real(wp) :: value

      integer :: k

      value = 0.0_wp
      do k = max(1, 4 - i), 4
         value = value + rows%by_pressure(i, k)*pressure(i - 3 + k) + rows%by_film(i, k)*film(i - 3 + k)
      end do
   end function row_times

end module camroller_ehl_factors
