!> Load per length along a roller that is pressed on a cam: the contact in slices.
!>
!> In: gaps of the unloaded bodies in the middle of each slice, load. Out: load per length of each slice.
!>
!> A slice with the load per length w is a Hertzian line contact of half width `b = sqrt(8 w R/(pi E'))` in itself. Its pressure, a
!> semi-ellipse across, moves the surfaces in the middle of slice i, a distance s away along the axis, by
!>
!>     u_i = 2/(pi E') w (asinh((s + h/2)/beta) - asinh((s - h/2)/beta)),    beta = b/(2 sqrt(e)),
!>
!> with the width h of a slice: the half space's `w/(pi E*) int ds/sqrt(x^2 + s^2)`, whose mean over the semi-ellipse is that of a
!> line at the distance beta, exactly so for slices longer than b (the mean of ln|x| is ln(b/2) - 1/2) and to b^2/(8 s^2) far away.
!> For a uniform load in the middle of a long contact it gives Lundberg's approach `2 w/(pi E') (1 + 2 ln(2 L/b))`. Slices that do
!> not see each other have the approach of that middle each. A slice narrower than b/1.6 is no line contact of its own: there b
!> counts as 1.6 h (`1/b^4 + 1/(1.6 h)^4` in place of `1/b^4`), without which the loads of neighbours would not be determined: with
!> 4 h they go up and down from slice to slice, with 2 h they begin to at a sharp end. More slices make the contact softer.
!>
!> Loads are where `u_i + gap_i` is the approach of the bodies, zero where the gap stays open. Newton's method with its exact
!> derivatives (u is not linear in w, since b follows it), and slices taken out and in by the signs of load and gap. Behind a small
!> change the next ones take its derivatives again: each leaves a part of the error as large as that change was, for half the cost.
!>
!> Source: Kalker (1972), J. Applied Mechanics 39, 1125 (line contact by its asymptotics); de Mul, Kalker and Fredriksson (1986),
!> J. Tribology 108, 140 (slices with semi-elliptic pressure).
module camroller_slices
   use camroller_kinds, only : wp, pi
   use camroller_lapack, only : dgetrf, dgetrs
   implicit none
   private

   public :: slices_t, new_slices, load_slices, thin_line

   !> Half width over the distance of the line that stands for a slice [-]
   real(wp), parameter :: thin_line = 0.5_wp*exp(-0.5_wp)
   !> Largest half width of a slice over its width [-]
   real(wp), parameter :: widest_slice = 1.6_wp
   !> Load per length over its mean by which a slice joins, if it has to carry more: from below Newton's method does not make it
   !> negative again; change after which joins are looked for and derivatives stay; what a solution may be off by: next to nothing
   !> beside the 1e-4 of a table between its points [-]
   real(wp), parameter :: first_load = 1.0e-4_wp, small_change = 1.0e-2_wp, last_error = 1.0e-9_wp
   !> Steps at most
   integer, parameter :: max_steps = 200

   !> A contact in slices
   type :: slices_t
      !> Length, L [m]; equivalent modulus, E' [Pa]
      real(wp) :: length, modulus
      !> Gaps without load, in the middle of each slice [m]
      real(wp), allocatable :: gaps(:)
      !> Do slices move each other?
      logical :: is_coupled
   end type slices_t

contains

   !> A contact.
   pure subroutine new_slices(slices, length, modulus, gaps, is_coupled)
      !> The contact
      type(slices_t), intent(out) :: slices
      !> Length, L [m]; equivalent modulus, E' [Pa]
      real(wp), intent(in) :: length, modulus
      !> Gaps without load, in the middle of each slice; only their differences count [m]
      real(wp), intent(in) :: gaps(:)
      !> Do slices move each other?
      logical, intent(in) :: is_coupled

      slices%length = length
      slices%modulus = modulus
      slices%gaps = gaps - minval(gaps)
      slices%is_coupled = is_coupled
   end subroutine new_slices

   !> Loads of the slices.
   pure subroutine load_slices(slices, load, radius, loads, approach, status)
      !> The contact
      type(slices_t), intent(in) :: slices
      !> Load, W, above zero [N]; equivalent radius, R [m]
      real(wp), intent(in) :: load, radius
      !> Loads per length over W/L, zero where bodies do not touch; in: those of a contact nearby [-]
      real(wp), intent(inout) :: loads(:)
      !> Approach of the bodies from first touch [m]
      real(wp), intent(out) :: approach
      !> 0 fine, positive where no loads were found
      integer, intent(out) :: status

      ! Height 2 W/(pi E' L) that lengths are relative to [m]; gaps, approach, overlap of a slice that joins [heights]; distance of
      ! the line at the mean load [L]
      real(wp) :: height, gaps(size(loads)), level, joining, line
      ! Approach by all slices and their derivatives over the loads, bordered by the balance of the load; what is wrong [-]
      real(wp) :: influence(size(loads), size(loads)), slopes(size(loads), size(loads))
      real(wp) :: matrix(size(loads) + 1, size(loads) + 1), wrong(size(loads) + 1, 1)
      ! Largest change of a load in this step and in the one before [-]
      real(wp) :: change, change_before
      integer :: list(size(loads)), pivots(size(loads) + 1), n, step, j, info
      logical :: is_loaded(size(loads)), was_loaded(size(loads)), is_factored

      status = 0
      height = 2.0_wp*load/(pi*slices%modulus*slices%length)
      gaps = slices%gaps/height
      line = thin_line*sqrt(8.0_wp*load*radius/(pi*slices%modulus*slices%length))/slices%length
      joining = 2.0_wp*first_load*asinh(0.5_wp/(line*sqrt(first_load)*merge(size(loads), 1, slices%is_coupled)))
      is_loaded = loads > 0.0_wp
      level = 0.0_wp
      is_factored = .false.
      change = 1.0_wp
      do step = 1, max_steps
         n = count(is_loaded)
         list(:n) = pack([(j, j=1, size(loads))], is_loaded)
         where (.not. is_loaded) loads = 0.0_wp
         if (is_factored) then
            call find_influence(slices%is_coupled, line, loads, list(:n), influence)
         else
            call find_influence(slices%is_coupled, line, loads, list(:n), influence, slopes)
         end if
         wrong(:n, 1) = -gaps(list(:n)) - matmul(influence(list(:n), list(:n)), loads(list(:n)))
         wrong(n + 1, 1) = real(size(loads), wp) - sum(loads(list(:n)))
         if (.not. is_factored) then
            call factor_slopes(slopes, list(:n), matrix, pivots, info)
            if (info /= 0) exit
         end if
         call dgetrs("N", n + 1, 1, matrix, size(matrix, 1), pivots, wrong, size(wrong, 1), info)
         change_before = change
         change = maxval(abs(wrong(:n, 1)))
         loads(list(:n)) = loads(list(:n)) + wrong(:n, 1)
         level = wrong(n + 1, 1)
         was_loaded = is_loaded
         is_loaded = loads > 0.0_wp
         is_factored = .not. any(is_loaded .neqv. was_loaded) .and. change <= small_change
         if (.not. is_factored) cycle
         ! Where the bodies would overlap by more than the first load moves them
         is_loaded = is_loaded .or. gaps + matmul(influence(:, list(:n)), loads(list(:n))) < level - joining
         if (any(is_loaded .neqv. was_loaded)) then
            where (is_loaded .and. .not. was_loaded) loads = first_load
            is_factored = .false.
         else if (change*min(change/change_before, 1.0_wp) <= last_error*maxval(loads)) then
            ! Changes fall faster and faster, or alike with derivatives that stay
            approach = level*height
            return
         end if
      end do
      status = 1
      approach = 0.0_wp
   end subroutine load_slices

   !> Factors of the derivatives of the approach, bordered by the balance of the load.
   pure subroutine factor_slopes(slopes, list, matrix, pivots, info)
      !> Derivatives of the approach over the loads [-]
      real(wp), intent(in) :: slopes(:, :)
      !> Slices that count
      integer, intent(in) :: list(:)
      !> The factors, in its first rows and columns, one more than slices count [-]
      real(wp), intent(inout) :: matrix(:, :)
      !> Pivots
      integer, intent(out) :: pivots(:)
      !> 0 fine, other: the matrix is singular
      integer, intent(out) :: info

      integer :: n

      n = size(list)
      matrix(:n, :n) = slopes(list, list)
      matrix(:n, n + 1) = -1.0_wp
      matrix(n + 1, :n) = 1.0_wp
      matrix(n + 1, n + 1) = 0.0_wp
      call dgetrf(n + 1, n + 1, matrix, size(matrix, 1), pivots, info)
   end subroutine factor_slopes

   !> Approach of all slices by the load of some, and its derivative over that.
   pure subroutine find_influence(is_coupled, line, loads, list, influence, slopes)
      !> Do slices move each other?
      logical, intent(in) :: is_coupled
      !> Distance of the line that stands for a slice with the mean load [L]
      real(wp), intent(in) :: line
      !> Loads per length over their mean [-]
      real(wp), intent(in) :: loads(:)
      !> Slices that count
      integer, intent(in) :: list(:)
      !> Approach of slice i by a unit load of slice j; derivative of the approach over the load of j, where wanted [-]
      real(wp), intent(out) :: influence(:, :)
      real(wp), intent(out), optional :: slopes(:, :)

      ! Distance of the line, distances along the axis [L]; asinh of their ratio, and less half its derivative over ln(load) [-]
      real(wp) :: beta, ends(0:size(loads) - 1), angles(0:size(loads) - 1), falls(0:size(loads) - 1), roots(0:size(loads) - 1)
      ! Derivative of ln(b) over ln(load) [-]
      real(wp) :: part
      ! Most slices between a slice and the one that moves it
      integer :: far
      integer :: j, k, n

      n = size(loads)
      if (.not. is_coupled) then
         influence(:, list) = 0.0_wp
         if (present(slopes)) slopes(:, list) = 0.0_wp
      end if
      ends = [((k + 0.5_wp)/n, k=0, n - 1)]
      do k = 1, size(list)
         j = list(k)
         beta = line*sqrt(loads(j))
         if (is_coupled) then
            ! A smooth limit, since Newton's method would go to and fro at a sharp one
            part = 1.0_wp/(1.0_wp + (beta*n/(thin_line*widest_slice))**4)
            beta = beta*sqrt(sqrt(part))
            part = 0.5_wp*part
            far = max(j - 1, n - j)
            roots(:far) = sqrt(ends(:far)**2 + beta**2)
            angles(:far) = log((ends(:far) + roots(:far))/beta)
            call spread_column(angles, j, influence(:, j))
            if (present(slopes)) then
               falls(:far) = angles(:far) - part*ends(:far)/roots(:far)
               call spread_column(falls, j, slopes(:, j))
            end if
         else
            influence(j, j) = 2.0_wp*asinh(0.5_wp/beta)
            if (present(slopes)) slopes(j, j) = influence(j, j) - 0.5_wp/sqrt(0.25_wp + beta**2)
         end if
      end do
   end subroutine find_influence

   !> Differences of a function of the distance over each slice, from the one that moves them.
   pure subroutine spread_column(function_values, slice, column)
      !> The function at the ends of slices, half a width, one and a half ... away [-]
      real(wp), intent(in) :: function_values(0:)
      !> The slice that moves them
      integer, intent(in) :: slice
      !> Differences, for each slice [-]
      real(wp), intent(out) :: column(:)

      integer :: i

      do i = 1, slice - 1
         column(i) = function_values(slice - i) - function_values(slice - i - 1)
      end do
      column(slice) = 2.0_wp*function_values(0)
      do i = slice + 1, size(column)
         column(i) = function_values(i - slice) - function_values(i - slice - 1)
      end do
   end subroutine spread_column

end module camroller_slices
