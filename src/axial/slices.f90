!> Load per length along a roller that is pressed on a cam: the contact in slices.
!>
!> In: gaps of the unloaded bodies in the middle of each slice, load. Out: load per length of each slice.
!>
!> A slice with the load per length w is a Hertzian line contact of half width `b = sqrt(8 w R/(pi E'))` in itself. Its pressure, a
!> semi-ellipse across, moves the surfaces in the middle of slice i, a distance s away along the axis, by
!>
!>     u_i = 2/(pi E') w (F((s + h/2)/b) - F((s - h/2)/b)),
!>
!> with the width h of a slice and the half space's F (`strip.f90`): what the line in the middle of the semi-ellipse is moved by.
!> For a uniform load in the middle of a long contact it gives Lundberg's approach `2 w/(pi E') (1 + 2 ln(2 L/b))`. In an ellipse of
!> Hertz the half width goes with the root of w as it does here, so that slices far narrower than b have its loads, too. Slices that
!> do not see each other have the approach of the middle of a roller each.
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
   use camroller_strip, only : strip_function
   implicit none
   private

   public :: slices_t, new_slices, load_slices, thin_line

   !> Distance of a line that moves the middle of a long contact as its semi-ellipse does, over the half width [-]
   real(wp), parameter :: thin_line = 0.5_wp*exp(-0.5_wp)
   !> Largest half width over that of the mean load of the slices that carry load: in an ellipse it is 1.2, at a sharp end it would
   !> grow, and with it the load that a wider slice takes, as long as slices get narrower [-]
   real(wp), parameter :: widest = 2.5_wp
   !> Load per length over its mean by which a slice joins, if it has to carry more: from below Newton's method does not make it
   !> negative again; change after which joins are looked for and derivatives stay; what a solution may be off by: next to nothing
   !> beside the 1e-4 of a table between its points [-]
   real(wp), parameter :: first_load = 1.0e-4_wp, small_change = 1.0e-2_wp, last_error = 1.0e-9_wp
   !> Steps at most
   integer, parameter :: max_steps = 200

   !> A contact in slices
   type :: slices_t
      !> Length, L [m]; equivalent modulus, E' [Pa]; length of the roller whose middle a slice approaches like, where slices do not
      !> move each other, over L [-]
      real(wp) :: length, modulus, whole
      !> Gaps without load, in the middle of each slice [m]
      real(wp), allocatable :: gaps(:)
      !> Do slices move each other?
      logical :: is_coupled
   end type slices_t

contains

   !> A contact.
   pure subroutine new_slices(slices, length, modulus, gaps, is_coupled, roller_length)
      !> The contact
      type(slices_t), intent(out) :: slices
      !> Length, L [m]; equivalent modulus, E' [Pa]
      real(wp), intent(in) :: length, modulus
      !> Gaps without load, in the middle of each slice; only their differences count [m]
      real(wp), intent(in) :: gaps(:)
      !> Do slices move each other?
      logical, intent(in) :: is_coupled
      !> Length of the roller, where slices are on a part of it [m]
      real(wp), intent(in), optional :: roller_length

      slices%length = length
      slices%modulus = modulus
      slices%whole = 1.0_wp
      if (present(roller_length)) slices%whole = roller_length/length
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

      ! Height 2 W/(pi E' L) that lengths are relative to [m]; gaps, approach, overlap of a slice that joins [heights]; half
      ! width at the mean load [L]
      real(wp) :: height, gaps(size(loads)), level, joining, width
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
      width = sqrt(8.0_wp*load*radius/(pi*slices%modulus*slices%length))/slices%length
      joining = 2.0_wp*first_load*asinh(0.5_wp*merge(1.0_wp/size(loads), slices%whole, slices%is_coupled) &
         & /(thin_line*width*sqrt(first_load)))
      is_loaded = loads > 0.0_wp
      level = 0.0_wp
      is_factored = .false.
      change = 1.0_wp
      do step = 1, max_steps
         n = count(is_loaded)
         list(:n) = pack([(j, j=1, size(loads))], is_loaded)
         where (.not. is_loaded) loads = 0.0_wp
         if (is_factored) then
            call find_influence(slices, width, loads, list(:n), influence)
         else
            call find_influence(slices, width, loads, list(:n), influence, slopes)
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
   pure subroutine find_influence(slices, width, loads, list, influence, slopes)
      !> The contact
      type(slices_t), intent(in) :: slices
      !> Half width of a slice with the mean load [L]
      real(wp), intent(in) :: width
      !> Loads per length over their mean [-]
      real(wp), intent(in) :: loads(:)
      !> Slices that count
      integer, intent(in) :: list(:)
      !> Approach of slice i by a unit load of slice j; derivative of the approach over the load of j, where wanted [-]
      real(wp), intent(out) :: influence(:, :)
      real(wp), intent(out), optional :: slopes(:, :)

      ! Half width, distance of its line, distances along the axis [L], their logarithms; function of the strip, and less half its
      ! slope over the logarithm of their ratio [-]
      real(wp) :: beta, ends(0:size(loads) - 1), logs(0:size(loads) - 1), angles(0:size(loads) - 1), falls(0:size(loads) - 1)
      ! Half width without limit over the limit, to its power; slope of ln(half width) over ln(load) [-]
      real(wp) :: excess, part
      ! Most slices between a slice and the one that moves it
      integer :: far
      integer :: j, k, n

      n = size(loads)
      if (.not. slices%is_coupled) then
         influence(:, list) = 0.0_wp
         if (present(slopes)) slopes(:, list) = 0.0_wp
         do k = 1, size(list)
            j = list(k)
            beta = thin_line*width*sqrt(loads(j))
            influence(j, j) = 2.0_wp*asinh(0.5_wp*slices%whole/beta)
            if (present(slopes)) slopes(j, j) = influence(j, j) - 0.5_wp/sqrt(0.25_wp + (beta/slices%whole)**2)
         end do
         return
      end if
      ends = [((k + 0.5_wp)/n, k=0, n - 1)]
      logs = log(ends)
      do k = 1, size(list)
         j = list(k)
         far = max(j - 1, n - j)
         ! A smooth limit, since Newton's method would go to and fro at a sharp one
         excess = (loads(j)*size(list)/(n*widest**2))**4
         part = 0.5_wp/(1.0_wp + excess)
         beta = width*sqrt(loads(j))/sqrt(sqrt(sqrt(1.0_wp + excess)))
         if (present(slopes)) then
            call strip_function(ends(:far), logs(:far), beta, angles(:far), falls(:far))
            falls(:far) = angles(:far) - part*falls(:far)
            call spread_column(falls, j, slopes(:, j))
         else
            call strip_function(ends(:far), logs(:far), beta, angles(:far))
         end if
         call spread_column(angles, j, influence(:, j))
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
