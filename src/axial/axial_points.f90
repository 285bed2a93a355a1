!> Loads along the roller at the points of their table.
!>
!> In: roller profile, length, modulus, radii. Out: loads of the slices of the loaded part, and where that begins and ends, for some
!> loads equally spaced in their logarithm.
module camroller_axial_points
   use camroller_axial_window, only : blunt_ends, fit_window, loaded_ends, unclear_ends, window_t
   use camroller_error, only : error_t, raise, kind_convergence, kind_deck
   use camroller_hertz, only : half_width
   use camroller_kinds, only : wp
   use camroller_number_text, only : number_text
   use camroller_roller_profile, only : roller_profile_t
   implicit none
   private

   public :: group_step, solve_points

   !> Largest W/(E' R L), at the largest radius; steps of ln(load), their most [-]; the first is a peak
   !> pressure of about 4.5 GPa with steel
   real(wp), parameter :: largest_group = 2.5e-3_wp, group_step = 0.6_wp
   integer, parameter :: most_points = 24
   !> Fewest points, for cubic polynomials
   integer, parameter :: fewest_points = 4

contains

   !> Loads at all points of the table, from the largest load on down.
   subroutine solve_points(profile, length, modulus, log_radii, first, last, loads, bounds, error)
      !> What the case says
      type(roller_profile_t), intent(in) :: profile
      !> Length of the roller, L [m]; equivalent modulus, E' [Pa]; ln(R/L) of the radii [-]
      real(wp), intent(in) :: length, modulus, log_radii(:)
      !> ln(W/(E' L^2)) of the first and the last point [-]
      real(wp), intent(out) :: first, last
      !> Loads per length of the slices of a part of the roller over their mean, shape (slice, point, radius) [-]; where the part
      !> begins and ends, shape (2, point, radius) [L]
      real(wp), allocatable, intent(out) :: loads(:, :, :), bounds(:, :, :)
      !> Deck error; convergence error
      type(error_t), allocatable, intent(out) :: error

      type(window_t) :: window
      ! Load [N], radius [m]; least half width over half of the length of a contact [-]
      real(wp) :: load, radius, stoutness
      integer :: i, k, points, status

      allocate (loads(profile%slices, most_points, size(log_radii)), bounds(2, most_points, size(log_radii)))
      last = log(largest_group) + maxval(log_radii)
      points = most_points
      stoutness = huge(1.0_wp)
      do k = 1, size(log_radii)
         radius = length*exp(log_radii(k))
         window = window_t()
         allocate (window%loads(profile%slices), source=1.0_wp)
         do i = 1, points
            load = exp(last - group_step*(i - 1))*modulus*length**2
            if (i > 1) call foresee_loads(loads, i, k, window%loads)
            if (i > 1) call foresee_bounds(bounds, i, k, window%bounds)
            call fit_window(window, profile, length, modulus, load, radius, status)
            if (status /= 0 .and. i > fewest_points) then
               points = i - 1
               exit
            else if (status /= 0) then
               call raise(error, kind_convergence, "roller profile: no loads of the slices found for "//number_text(load, 4)//" N")
               return
            end if
            loads(:, i, k) = window%loads
            bounds(:, i, k) = window%bounds
            stoutness = min(stoutness, stoutness_of(window, length, modulus, load, radius))
         end do
      end do
      if (stoutness > 1.0_wp) then
         call raise(error, kind_deck, "roller profile: the contact is wider than it is long; take a larger radius of the "// &
            & "crown, or less tilt")
         return
      end if
      do k = 1, size(log_radii)
         radius = length*exp(log_radii(k))
         do i = 1, points
            load = exp(last - group_step*(i - 1))*modulus*length**2
            window%bounds = bounds(:, i, k)
            call blunt_ends(loads(:, i, k), unclear_ends(window, length, modulus, load, radius))
         end do
      end do
      loads = loads(:, points:1:-1, :)
      bounds = bounds(:, points:1:-1, :)
      first = last - group_step*(points - 1)
   end subroutine solve_points

   !> Half width of a contact where its load is largest over half of its length.
   pure function stoutness_of(window, length, modulus, load, radius) result(stoutness)
      !> The loaded part
      type(window_t), intent(in) :: window
      !> Length of the roller [m]; equivalent modulus [Pa]; load [N], equivalent radius [m]
      real(wp), intent(in) :: length, modulus, load, radius
      !> The ratio [-]
      real(wp) :: stoutness

      ! Where the load begins and ends [L]; largest load per length [N/m]
      real(wp) :: ends(2), most

      ends = loaded_ends(window)
      most = maxval(window%loads)*load/(length*(window%bounds(2) - window%bounds(1)))
      stoutness = 2.0_wp*half_width(most, radius, 1.0_wp, modulus)/(length*(ends(2) - ends(1)))
   end function stoutness_of

   !> Where to look for the loads at a point: those of the radius before, as far from its own as at the load before; at the first
   !> radius along a straight line through the two loads before.
   pure subroutine foresee_loads(all, point, radius, loads)
      !> Loads found so far, shape (slice, point, radius) [-]
      real(wp), intent(in) :: all(:, :, :)
      !> Which point after the first, which radius
      integer, intent(in) :: point, radius
      !> In: loads of the point before; out: loads to begin with [-]
      real(wp), intent(inout) :: loads(:)

      if (radius > 1) then
         loads = loads + (all(:, point, radius - 1) - all(:, point - 1, radius - 1))
      else if (point > 2) then
         loads = loads + (loads - all(:, point - 2, radius))
      end if
   end subroutine foresee_loads

   !> Where to look for the loaded part at a point: its ends move as at the radius before, at the first radius as between the two
   !> loads before, in the ratio of the lengths.
   pure subroutine foresee_bounds(all, point, radius, bounds)
      !> Where parts found so far begin and end, shape (2, point, radius) [L]
      real(wp), intent(in) :: all(:, :, :)
      !> Which point after the first, which radius
      integer, intent(in) :: point, radius
      !> In: those of the point before; out: where to look [L]
      real(wp), intent(inout) :: bounds(2)

      real(wp) :: known(2), next(2) ! [L]

      if (radius > 1) then
         known = all(:, point - 1, radius - 1)
         next = all(:, point, radius - 1)
      else
         known = all(:, max(point - 2, 1), radius)
         next = bounds
      end if
      bounds = bounds + (next - known)*(bounds(2) - bounds(1))/(known(2) - known(1))
      bounds = min(max(bounds, -0.5_wp), 0.5_wp)
   end subroutine foresee_bounds

end module camroller_axial_points
