!> Load along the roller for every load and radius of a cycle, tabulated, and the length that stands for it in a line contact.
!>
!> In: roller profile, length, modulus, range of the equivalent radius. Out: effective length with its derivatives; loads of all
!> slices.
!>
!> What acts on the roller as a whole follows from one line contact of the effective length `L_e = W^2/int w^2 dy`: its load per
!> length is the mean of w weighted with the load, so that a friction `mu(w) w` of the slices adds up to `mu(W/L_e) W` to first
!> order in the differences of w. Rolling resistance does not go with the load: two further lengths stand for it.
!>
!> Loads are solved at points equally spaced in the logarithm of the load, for some radii, in slices of the part of the roller that
!> carries load there; the logarithms of the lengths between them are cubics of that logarithm and polynomials of ln R, and so are
!> the loads of the slices and where their part begins and ends. Below the smallest load the lengths are powers of the load, and the
!> loads keep their shape on a part of the roller that is shorter as they are. Where the roller still carries all along at the
!> smallest load of the table, lengths stay as they are there.
module camroller_axial_table
   use camroller_kinds, only : wp, pi
   use camroller_axial_gaps, only : axial_gaps_t, depth_of, new_axial_gaps, part_within
   use camroller_axial_points, only : group_step, solve_points
   use camroller_axial_window, only : blunt_ends, load_up_to, loaded_ends, spread_loads, window_t
   use camroller_error, only : error_t
   use camroller_roller_profile, only : roller_profile_t, check_roller_profile, profile_gap
   use camroller_traction, only : line_lengths_t
   implicit none
   private

   public :: axial_part_t, axial_state_t, new_axial_part, is_same_axial_part, effective_lengths, slice_loads, &
      & slice_width, axial_state, oiled_parts, window_between

   !> Most radii
   integer, parameter :: most_radii = 4
   !> Logarithm of the range that each radius more covers, and of that beyond the range [-]
   real(wp), parameter :: radius_step = 1.5_wp, radius_margin = 0.05_wp
   !> Logarithm of a length over L, and a load over the mean less one, that is rounding [-]
   real(wp), parameter :: rounding = 1.0e-10_wp

   !> Loads along the roller, ready for use
   type :: axial_part_t
      !> What they were made of: profile; length L [m], modulus E' [Pa], smallest and largest radius R [m]
      type(roller_profile_t) :: profile
      !> The numbers [m], [Pa], [m]
      real(wp) :: length, modulus, radii(2)
      !> Parts of the roller where the unloaded bodies are within a gap
      type(axial_gaps_t) :: parts_within
      !> ln(W/(E' L^2)) of the first and the last point, ln(R/L) of the radii [-]
      real(wp) :: first, last
      real(wp), allocatable :: log_radii(:)
      !> Logarithms of the lengths over L, in the order of `line_lengths_t`, and their slopes over ln(W/(E' L^2)), shape (length, 2,
      !> point, radius) [-]
      real(wp), allocatable :: log_lengths(:, :, :, :)
      !> Loads per length of the slices of a part of the roller over their mean, shape (slice, point, radius) [-]; where the part
      !> begins and ends, shape (2, point, radius) [L]
      real(wp), allocatable :: loads(:, :, :), bounds(:, :, :)
   end type axial_part_t

   !> What matters of the loads at one state
   type :: axial_state_t
      !> Largest load per length over its mean [-] and where it is [m]
      real(wp) :: peak, place
      !> Loads per length at both ends over the mean [-]
      real(wp) :: ends(2)
   end type axial_state_t

contains

   !> Solve the table.
   subroutine new_axial_part(part, profile, length, modulus, radii, error)
      !> The table
      type(axial_part_t), intent(out) :: part
      !> What the case says
      type(roller_profile_t), intent(in) :: profile
      !> Length, L [m]; equivalent modulus, E' [Pa]; smallest and largest equivalent radius of the cycle [m]
      real(wp), intent(in) :: length, modulus, radii(2)
      !> Deck error; convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Middle of the ln(R/L), half of their range [-]; places of slices, gaps there, zero where the bodies touch first [m]
      real(wp) :: middle, reach, places(profile%slices), gaps(profile%slices)
      integer :: i, count

      call check_roller_profile(profile, error)
      if (allocated(error)) return
      part%profile = profile
      part%length = length
      part%modulus = modulus
      part%radii = radii
      places = slice_place([(i, i=1, profile%slices)], profile%slices, length)
      gaps = profile_gap(profile, length, modulus, places)
      part%parts_within = new_axial_gaps(gaps - minval(gaps))
      middle = 0.5_wp*log(radii(1)*radii(2)/length**2)
      reach = 0.5_wp*log(radii(2)/radii(1)) + radius_margin
      count = min(most_radii, 2 + int(2.0_wp*reach/radius_step))
      allocate (part%log_radii(count))
      do i = 1, count
         part%log_radii(i) = middle + reach*cos(pi*(i - 0.5_wp)/count)/cos(0.5_wp*pi/count)
      end do
      call solve_points(profile, length, modulus, part%log_radii, part%first, part%last, part%loads, part%bounds, error)
      if (allocated(error)) return
      call fit_lengths(part)
   end subroutine new_axial_part

   !> Lengths at the points, with slopes by which no cubic between two of them leaves their range.
   !>
   !> The slope is the harmonic mean of the slopes of both neighbouring stretches, zero where these differ in sign (Fritsch and
   !> Butland 1984); at the ends that of the last stretch. Contacts of few slices make small steps in the values, which a curve with
   !> more continuous derivatives would overshoot.
   subroutine fit_lengths(part)
      !> The table, with its loads
      type(axial_part_t), intent(inout) :: part

      ! Logarithms of the lengths over L at the points, slopes of one between them [-]
      real(wp) :: values(3, size(part%loads, 2)), rises(size(part%loads, 2) - 1)
      integer :: i, k, n

      n = size(values, 2)
      allocate (part%log_lengths(3, 2, n, size(part%log_radii)))
      do k = 1, size(part%log_radii)
         do i = 1, n
            values(:, i) = log_lengths_of(window_t(part%bounds(:, i, k), part%loads(:, i, k)))
         end do
         part%log_lengths(:, 1, :, k) = values
         do i = 1, 3
            rises = (values(i, 2:) - values(i, :n - 1))/group_step
            part%log_lengths(i, 2, [1, n], k) = rises([1, n - 1])
            part%log_lengths(i, 2, 2:n - 1, k) = 0.0_wp
            where (rises(2:)*rises(:n - 2) > 0.0_wp) part%log_lengths(i, 2, 2:n - 1, k) = 2.0_wp*rises(2:)*rises(:n - 2) &
               & /(rises(2:) + rises(:n - 2))
         end do
         ! Below the first point loads keep their shape, so that all lengths go with the same power. A length that grows as the load
         ! falls is that of a roller that carries all along, and nearly the roller's, which it cannot exceed
         part%log_lengths(:, 2, 1, k) = max(part%log_lengths(1, 2, 1, k), 0.0_wp)
      end do
   end subroutine fit_lengths

   !> Lengths of some loads.
   pure function log_lengths_of(window) result(logs)
      !> Loads of slices
      type(window_t), intent(in) :: window
      !> Logarithms of the lengths over L, in the order of `line_lengths_t` [-]
      real(wp) :: logs(3)

      real(wp) :: ends(2) ! where the load begins and ends [L]

      ends = loaded_ends(window)
      associate (loads => window%loads, length => window%bounds(2) - window%bounds(1))
         logs = [-log(sum(loads**2)/(size(loads)*length)), log(length*(sum(sqrt(loads))/size(loads))**2), log(ends(2) - ends(1))]
      end associate
      ! The same load everywhere has the length of the roller to the last digit
      where (abs(logs) < rounding) logs = 0.0_wp
   end function log_lengths_of

   !> Weights of the values and slopes at two neighbouring points, for the values between them and their slopes; beyond all points
   !> along a straight line.
   pure subroutine weigh_points(points, place, first, weights)
      !> Number of points
      integer, intent(in) :: points
      !> ln(W/(E' L^2)) from the first point on [-]
      real(wp), intent(in) :: place
      !> The point on the left
      integer, intent(out) :: first
      !> Weights of value and slope on the left, value and slope on the right, shape (4, value or slope) [-]
      real(wp), intent(out) :: weights(4, 2)

      ! Part of the stretch [-]
      real(wp) :: t

      weights = 0.0_wp
      if (place <= 0.0_wp) then
         first = 1
         weights(1:2, 1) = [1.0_wp, place]
         weights(2, 2) = 1.0_wp
      else if (place >= group_step*(points - 1)) then
         first = points - 1
         weights(3:4, 1) = [1.0_wp, place - group_step*(points - 1)]
         weights(4, 2) = 1.0_wp
      else
         first = min(1 + int(place/group_step), points - 1)
         t = place/group_step - (first - 1)
         weights(3, :) = [t**2*(3.0_wp - 2.0_wp*t), 6.0_wp*t*(1.0_wp - t)/group_step]
         weights(1, :) = [1.0_wp - weights(3, 1), -weights(3, 2)]
         weights(2, :) = [group_step*t*(1.0_wp - t)**2, (1.0_wp - t)*(1.0_wp - 3.0_wp*t)]
         weights(4, :) = [-group_step*t**2*(1.0_wp - t), t*(3.0_wp*t - 2.0_wp)]
      end if
   end subroutine weigh_points

   !> Would a table made of these be the same?
   pure function is_same_axial_part(part, profile, length, modulus, radii) result(is_same)
      !> A table
      type(axial_part_t), intent(in) :: part
      !> What another one would be made of
      type(roller_profile_t), intent(in) :: profile
      !> The same, as for `new_axial_part` [m], [Pa], [m]
      real(wp), intent(in) :: length, modulus, radii(2)
      logical :: is_same

      associate (own => part%profile)
         is_same = own%profile == profile%profile .and. own%coupling == profile%coupling .and. own%slices == profile%slices
         is_same = is_same .and. all(abs([part%length - length, part%modulus - modulus, part%radii - radii, &
            & own%crown_radius - profile%crown_radius, own%design_load - profile%design_load, own%end_drop - profile%end_drop, &
            & own%tilt - profile%tilt]) <= 0.0_wp)
      end associate
   end function is_same_axial_part

   !> Middle of a slice.
   elemental function slice_place(slice, count, length) result(place)
      !> Which slice, their number
      integer, intent(in) :: slice, count
      !> Length of the roller [m]
      real(wp), intent(in) :: length
      !> Place from the middle of the roller [m]
      real(wp) :: place

      place = length*((slice - 0.5_wp)/count - 0.5_wp)
   end function slice_place

   !> Lengths of the line contact that stands for the roller, with their derivatives.
   pure subroutine effective_lengths(part, load, radius, lengths, by_load, by_radius)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Load, W, above zero [N]; equivalent radius, R [m]
      real(wp), intent(in) :: load, radius
      !> The lengths [m]
      type(line_lengths_t), intent(out) :: lengths
      !> Derivatives of their logarithms over ln(W) and ln(R) [-]
      type(line_lengths_t), intent(out) :: by_load, by_radius

      ! ln(W/(E' L^2)) from the first point on, weights of the radii and their slopes, weights of the points [-]
      real(wp) :: place, weights(size(part%log_radii)), slopes(size(part%log_radii)), points(4, 2)
      ! Logarithms of the lengths over L: of one radius, of all, their slopes over ln(W) and ln(R) [-]
      real(wp) :: values(3), total(3), along_load(3), along_radius(3)
      integer :: k, first

      place = log(load/(part%modulus*part%length**2)) - part%first
      call radius_weights(part, radius, weights, slopes)
      call weigh_points(size(part%loads, 2), place, first, points)
      total = 0.0_wp
      along_load = 0.0_wp
      along_radius = 0.0_wp
      do k = 1, size(weights)
         associate (left => part%log_lengths(:, :, first, k), right => part%log_lengths(:, :, first + 1, k))
            values = points(1, 1)*left(:, 1) + points(2, 1)*left(:, 2) + points(3, 1)*right(:, 1) + points(4, 1)*right(:, 2)
            total = total + weights(k)*values
            along_radius = along_radius + slopes(k)*values
            along_load = along_load + weights(k)*(points(1, 2)*left(:, 1) + points(2, 2)*left(:, 2) + points(3, 2)*right(:, 1) &
               & + points(4, 2)*right(:, 2))
         end associate
      end do
      total = part%length*exp(total)
      lengths = line_lengths_t(total(1), total(2), total(3))
      by_load = line_lengths_t(along_load(1), along_load(2), along_load(3))
      by_radius = line_lengths_t(along_radius(1), along_radius(2), along_radius(3))
   end subroutine effective_lengths

   !> Lagrange's weights of the radii, and their derivatives over ln(R); beyond the radii those at their end.
   pure subroutine radius_weights(part, radius, weights, slopes)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Equivalent radius [m]
      real(wp), intent(in) :: radius
      !> The weights, and their derivatives [-]
      real(wp), intent(out) :: weights(:), slopes(:)

      ! ln(R/L), within the radii; quotient, its derivative [-]
      real(wp) :: x, factor
      integer :: i, k
      logical :: is_inside

      x = log(radius/part%length)
      associate (points => part%log_radii)
         is_inside = x <= points(1) .and. x >= points(size(points))
         x = min(max(x, points(size(points))), points(1))
         do k = 1, size(points)
            weights(k) = 1.0_wp
            slopes(k) = 0.0_wp
            do i = 1, size(points)
               if (i == k) cycle
               factor = 1.0_wp/(points(k) - points(i))
               slopes(k) = slopes(k)*(x - points(i))*factor + weights(k)*factor
               weights(k) = weights(k)*(x - points(i))*factor
            end do
         end do
         if (.not. is_inside) slopes = 0.0_wp
      end associate
   end subroutine radius_weights

   !> Loads of slices of the loaded part, and where that begins and ends: between the points of the table along cubic polynomials,
   !> below them with the shape of the first point on a part as much shorter as the lengths are, above them as at the last point.
   pure subroutine find_window(part, load, radius, bounds, loads)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Load, W, above zero [N]; equivalent radius, R [m]
      real(wp), intent(in) :: load, radius
      !> Where the part begins and ends [L]
      real(wp), intent(out) :: bounds(2)
      !> Loads per length over their mean [-]
      real(wp), intent(out) :: loads(:)

      ! Weights of the radii, of four points; place among the points; ln of the lengths over those of the first point [-]
      real(wp) :: weights(size(part%log_radii)), unused(size(part%log_radii)), cubic(0:3), t, shrinking
      integer :: i, k, n, first

      n = size(part%loads, 2)
      t = (log(load/(part%modulus*part%length**2)) - part%first)/group_step
      shrinking = group_step*min(t, 0.0_wp)
      t = min(max(t, 0.0_wp), n - 1.0_wp)
      first = min(max(int(t), 1), n - 3)
      t = t - (first - 1)
      cubic = [-(t - 1.0_wp)*(t - 2.0_wp)*(t - 3.0_wp)/6.0_wp, t*(t - 2.0_wp)*(t - 3.0_wp)/2.0_wp, &
         & -t*(t - 1.0_wp)*(t - 3.0_wp)/2.0_wp, t*(t - 1.0_wp)*(t - 2.0_wp)/6.0_wp]
      call radius_weights(part, radius, weights, unused)
      loads = 0.0_wp
      bounds = 0.0_wp
      do k = 1, size(weights)
         do i = 0, 3
            loads = loads + weights(k)*cubic(i)*part%loads(:, first + i, k)
            bounds = bounds + weights(k)*cubic(i)*part%bounds(:, first + i, k)
         end do
      end do
      loads = max(loads, 0.0_wp)
      loads = loads*(size(loads)/sum(loads))
      ! The same load everywhere has no rounding whose extremes could be looked for
      where (abs(loads - 1.0_wp) < rounding) loads = 1.0_wp
      bounds = min(max(bounds, -0.5_wp), 0.5_wp)
      if (shrinking < 0.0_wp) bounds = shrunk(bounds, exp(shrinking*sum(weights*part%log_lengths(1, 2, 1, :))), matmul( &
         & part%bounds(:, 2, :), weights))
   end subroutine find_window

   !> A part of the roller that is shorter, about the place that has the same place in a longer part.
   pure function shrunk(bounds, factor, longer) result(shorter)
      !> Where it begins and ends [L]
      real(wp), intent(in) :: bounds(2)
      !> Its new length over its own [-]
      real(wp), intent(in) :: factor
      !> Where the longer part does [L]
      real(wp), intent(in) :: longer(2)
      !> The part [L]
      real(wp) :: shorter(2)

      ! How much longer the longer part is, the place [L]
      real(wp) :: more, place

      more = (longer(2) - longer(1)) - (bounds(2) - bounds(1))
      place = 0.5_wp*(bounds(1) + bounds(2))
      if (more > rounding) place = min(max((bounds(1)*(longer(2) - longer(1)) - longer(1)*(bounds(2) - bounds(1)))/more, &
         & bounds(1)), bounds(2))
      shorter = place + factor*(bounds - place)
   end function shrunk

   !> The loaded part at a load and radius.
   pure subroutine window_between(part, load, radius, window)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Load, W, above zero [N]; equivalent radius, R [m]
      real(wp), intent(in) :: load, radius
      !> The loaded part
      type(window_t), intent(out) :: window

      allocate (window%loads(size(part%loads, 1)))
      call find_window(part, load, radius, window%bounds, window%loads)
   end subroutine window_between

   !> Loads of the slices of the roller.
   pure subroutine slice_loads(part, load, radius, loads)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Load, W [N]; equivalent radius, R [m]
      real(wp), intent(in) :: load, radius
      !> Loads per length over W/L; zero without a load [-]
      real(wp), intent(out) :: loads(:)

      type(window_t) :: window

      loads = 0.0_wp
      if (.not. load > 0.0_wp) return
      call window_between(part, load, radius, window)
      call spread_loads(window, [-0.5_wp, 0.5_wp], loads)
   end subroutine slice_loads

   !> Width of a slice of the roller.
   pure function slice_width(part) result(width)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Width [m]
      real(wp) :: width

      width = part%length/size(part%loads, 1)
   end function slice_width

   !> Largest load along the roller and at its ends. The load at an end is the mean over the last slice of the roller, and where
   !> load grows towards an end, no more than that is its largest.
   pure function axial_state(part, load, radius) result(state)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Load, W [N]; equivalent radius, R [m]
      real(wp), intent(in) :: load, radius
      !> What matters
      type(axial_state_t) :: state

      ! Loads of the slices of the part; largest load between three slices, as a parabola has it: its place among them [-]
      real(wp) :: loads(size(part%loads, 1)), bend, offset
      ! Where the part begins and ends, its length [L]; how far the last slices of the roller reach into it [slices]
      real(wp) :: bounds(2), length, reach(2)
      integer :: n, top

      n = size(loads)
      call find_window(part, load, radius, bounds, loads)
      length = bounds(2) - bounds(1)
      reach = max(1.0_wp - n*(0.5_wp + [1.0_wp, -1.0_wp]*bounds), 0.0_wp)/length
      state%ends = [load_up_to(loads, reach(1)), load_up_to(loads(n:1:-1), reach(2))]
      call blunt_ends(loads, min(reach, 0.5_wp*n))
      loads = loads/length
      top = maxloc(loads, 1, back=.true.)
      state%peak = loads(top)
      offset = 0.0_wp
      if (top > 1 .and. top < n) then
         ! Below zero, as the slice behind has less than the largest load
         bend = loads(top - 1) - 2.0_wp*loads(top) + loads(top + 1)
         offset = 0.5_wp*(loads(top - 1) - loads(top + 1))/bend
         state%peak = state%peak - 0.5_wp*bend*offset**2
      end if
      state%place = part%length*(bounds(1) + length*(top - 0.5_wp + offset)/n)
      if (maxval(state%ends)*(1.0_wp + rounding) >= state%peak .and. maxval(state%ends) > 1.0_wp + rounding) then
         state%peak = maxval(state%ends)
         state%place = 0.5_wp*part%length*(1.0_wp - 1.0_wp/n)*merge(1.0_wp, -1.0_wp, state%ends(2) >= state%ends(1))
      end if
      ! The middle has no rounding whose mean could be looked for
      if (abs(state%place) < sqrt(epsilon(1.0_wp))*part%length) state%place = 0.0_wp
   end function axial_state

   !> Parts of the roller that the dry contact loads, and on which the gap is wider by no more than a film than the widest on a part
   !> so long. In a rigid contact of constant viscosity the load goes with one over the film, so that there the load per length is
   !> at least half as large as where the dry contact ends.
   pure function oiled_parts(part, load, radius, film) result(parts)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Load, W [N]; equivalent radius, R [m]; central film [m]
      real(wp), intent(in) :: load, radius, film
      !> Both parts [-]
      real(wp) :: parts(2)

      ! Lengths and their slopes
      type(line_lengths_t) :: lengths, slopes(2)

      call effective_lengths(part, load, radius, lengths, slopes(1), slopes(2))
      parts(1) = lengths%loaded/part%length
      parts(2) = max(parts(1), part_within(part%parts_within, depth_of(part%parts_within, parts(1)) + film))
   end function oiled_parts

end module camroller_axial_table
