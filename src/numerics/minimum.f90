!> Minimum of a function of one variable, bracketed by three points of which the middle one has the lowest value.
!>
!> In: three points with their values, then the value at each requested point. Out: the lowest value found. The caller evaluates
!> its own function between the calls, as with `roots`:
!>
!>     call start_minimum(search, points, values, tolerance)
!>     do while (search%is_wanted)
!>        call narrow_minimum(search, f(search%trial))
!>     end do
!>
!> then `search%point(2)` is the position and `search%value(2)` the value of the minimum, and `search%left` what may be left to
!> gain: what the last parabola, or at a kink the last two lines, missed or promised, or what the bracket may hide. For a maximum,
!> pass the values with opposite sign. A function that jumps at the middle point is looked at on one side of it only.
!>
!> Where the function is smooth a parabola through the bracket tells its lowest point. At a kink it does not, but may happen to tell
!> one value: it counts where it tells the points beside the bracket as well. Otherwise the next value is that where the lines cross
!> that continue both legs of the kink, each through an end of the bracket and the point beside it.
module camroller_minimum
   use camroller_kinds, only : wp
   implicit none
   private

   public :: minimum_t, start_minimum, narrow_minimum

   !> Values asked for at most, unless the caller has another number: a smooth function takes two to four, a kink some ten
   integer, parameter :: most_steps = 12
   !> Smallest distance of a trial from a point over the part of the bracket on that side [-]
   real(wp), parameter :: least_part = 0.05_wp
   !> The same where lines cross [-]
   real(wp), parameter :: least_leg = 1.0e-3_wp
   !> Part of its rise to which the parabola tells a point beside the bracket of a smooth function [-]
   real(wp), parameter :: well_told = 0.2_wp
   !> Part of the tolerance within which a parabola counts that no point beside the larger part of the bracket confirms [-]
   real(wp), parameter :: unconfirmed = 0.03_wp
   !> Where the larger part of a bracket is cut, from its middle point [-]: golden section
   real(wp), parameter :: golden = 0.5_wp*(3.0_wp - sqrt(5.0_wp))

   !> A search on its way
   type :: minimum_t
      !> Is the value at `trial` wanted?
      logical :: is_wanted = .false.
      !> Point where it is wanted [x]
      real(wp) :: trial = 0.0_wp
      !> Bracket: a point, the one with the smallest value so far, and one on its other side [x]; values there [f]
      real(wp) :: point(3) = 0.0_wp, value(3) = 0.0_wp
      !> Point beside the bracket on each side [x], value there [f], and is there one?
      real(wp), private :: outer(2) = 0.0_wp, outer_value(2) = 0.0_wp
      logical, private :: has_outer(2) = .false.
      !> Gain that is not worth a value [f]
      real(wp), private :: tolerance = 0.0_wp
      !> Values that the parabola and the lines have at the trial, and how far the last one was from them [f]
      real(wp), private :: expected(2) = 0.0_wp, missed(2) = huge(1.0_wp)
      !> What a lower value than the lowest so far may gain [f]
      real(wp) :: left = 0.0_wp
      !> Values asked for so far, and at most
      integer :: steps = 0
      integer, private :: limit = most_steps
      !> End of the bracket, 1 or 3, beyond a jump next to the middle point, or 0
      integer, private :: jump = 0
   end type minimum_t

contains

   !> Begin with three points in order; without a lowest one in the middle nothing is wanted.
   pure subroutine start_minimum(search, points, values, tolerance, most, jump, outer)
      !> The search
      type(minimum_t), intent(out) :: search
      !> Three points, increasing [x]
      real(wp), intent(in) :: points(3)
      !> Values there [f]
      real(wp), intent(in) :: values(3)
      !> Gain that is not worth a value [f]
      real(wp), intent(in) :: tolerance
      !> Values asked for at most
      integer, intent(in), optional :: most
      !> End, 1 or 3, from which the function jumps to the middle point, so that nothing is looked for between them; 0 for none
      integer, intent(in), optional :: jump
      !> Point beside the other end [x], value there [f]
      real(wp), intent(in), optional :: outer(2)

      if (present(most)) search%limit = most
      if (present(jump)) search%jump = jump
      search%point = points
      search%value = values
      search%tolerance = tolerance
      search%trial = points(2)
      if (search%jump > 0 .and. present(outer)) then
         associate (beside => (5 - search%jump)/2)
            search%has_outer(beside) = .true.
            search%outer(beside) = outer(1)
            search%outer_value(beside) = outer(2)
         end associate
      end if
      search%is_wanted = values(2) <= min(values(1), values(3)) .and. max(values(1), values(3)) > values(2)
      if (search%is_wanted) call choose_trial(search)
   end subroutine start_minimum

   !> Take the value at the trial point.
   pure subroutine narrow_minimum(search, value)
      !> The search
      type(minimum_t), intent(inout) :: search
      !> Value at `search%trial` [f]
      real(wp), intent(in) :: value

      integer :: side

      search%steps = search%steps + 1
      search%missed = abs(value - search%expected)
      side = merge(1, 3, search%trial < search%point(2))
      if (value < search%value(2)) then
         call replace_end(search, 4 - side, search%point(2), search%value(2))
         if (search%jump > 0) search%has_outer((search%jump + 1)/2) = .false.
         search%jump = 0
         search%point(2) = search%trial
         search%value(2) = value
      else
         call replace_end(search, side, search%trial, value)
      end if
      call choose_trial(search)
   end subroutine narrow_minimum

   !> Put a point in the place of an end of the bracket, which is beside it then.
   pure subroutine replace_end(search, side, point, value)
      type(minimum_t), intent(inout) :: search
      !> The end, 1 or 3
      integer, intent(in) :: side
      !> The point [x], value there [f]
      real(wp), intent(in) :: point, value

      associate (beside => (side + 1)/2)
         search%has_outer(beside) = .true.
         search%outer(beside) = search%point(side)
         search%outer_value(beside) = search%value(side)
      end associate
      search%point(side) = point
      search%value(side) = value
   end subroutine replace_end

   !> Next trial: the lowest point of the parabola, or a cut of the larger part where that is too close to a point; at a kink where
   !> the lines of its legs cross. Nothing is wanted any more where parabola or lines have told the last value and gain next to
   !> nothing.
   pure subroutine choose_trial(search)
      type(minimum_t), intent(inout) :: search

      ! Parts of the bracket [x], rises of the value over them [f], slopes [f/x]
      real(wp) :: parts(2), rises(2), slopes(2)
      ! Shift of the lowest point from the middle one [x], what it gains [f]; where the lines cross [x], value there [f]
      real(wp) :: shift, gain, crossing, lowest
      logical :: is_smooth, has_crossing

      if (search%jump > 0) then
         call choose_beside_jump(search)
         return
      end if
      parts = search%point(2:3) - search%point(1:2)
      rises = search%value([1, 3]) - search%value(2)
      search%left = maxval(rises)
      search%is_wanted = .false.
      if (.not. minval(parts) > 0.0_wp) return
      slopes = rises/parts
      ! A curve bent to one side is nowhere below the lines through its middle point, continued to the other side
      search%left = max(slopes(1)*parts(2), slopes(2)*parts(1))
      search%is_wanted = search%steps < search%limit .and. search%left > search%tolerance &
         & .and. minval(parts) > 16.0_wp*spacing(search%point(2))
      if (.not. search%is_wanted) return
      shift = 0.5_wp*(slopes(1)*parts(2) - slopes(2)*parts(1))/sum(slopes)
      gain = shift**2*sum(slopes)/sum(parts)
      call confirm_parabola(search, parts, slopes, gain, is_smooth)
      call cross_legs(search, has_crossing, crossing, lowest)
      if (max(gain, search%missed(1)) <= search%tolerance .and. is_smooth) then
         search%is_wanted = .false.
         search%left = max(gain, search%missed(1))
      else if (has_crossing .and. max(search%value(2) - lowest, search%missed(2)) <= search%tolerance) then
         search%is_wanted = .false.
         search%left = max(search%value(2) - lowest, search%missed(2))
      end if
      if (.not. search%is_wanted) return
      is_smooth = is_smooth .or. .not. has_crossing
      if (is_smooth) then
         if (abs(shift) < least_part*minval(parts)) shift = golden*merge(parts(2), -parts(1), parts(2) > parts(1))
      else
         shift = crossing - search%point(2)
         if (abs(shift) < least_leg*maxval(parts)) shift = least_leg*merge(maxval(parts), -maxval(parts), parts(2) > parts(1))
      end if
      associate (least => merge(least_part, least_leg, is_smooth))
         shift = min(max(shift, -(1.0_wp - least)*parts(1)), (1.0_wp - least)*parts(2))
      end associate
      search%trial = search%point(2) + shift
      search%expected = [parabola_at(search, parts, slopes, search%trial), huge(1.0_wp)]
      if (has_crossing) search%expected(2) = lowest + leg_slope(search, merge(1, 2, search%trial <= crossing)) &
         & *(search%trial - crossing)
   end subroutine choose_trial

   !> Next trial beside a jump: a cut of the part on this side of it. A curve bent to one side is nowhere below the line through the
   !> end of that part and the point beside it, continued to the jump.
   pure subroutine choose_beside_jump(search)
      type(minimum_t), intent(inout) :: search

      ! From the middle point to the end [x], rise of the value over it [f]
      real(wp) :: part, rise

      associate (side => 4 - search%jump)
         part = search%point(side) - search%point(2)
         rise = search%value(side) - search%value(2)
         search%left = rise
         if (search%has_outer((side + 1)/2)) search%left = max(leg_slope(search, (side + 1)/2)*part - rise, 0.0_wp)
      end associate
      search%is_wanted = search%steps < search%limit .and. search%left > search%tolerance &
         & .and. abs(part) > 16.0_wp*spacing(search%point(2))
      search%trial = search%point(2) + golden*part
      search%expected = huge(1.0_wp)
   end subroutine choose_beside_jump

   !> Value of the parabola through the bracket.
   pure function parabola_at(search, parts, slopes, point) result(value)
      type(minimum_t), intent(in) :: search
      !> Parts of the bracket [x], slopes of the value over them, both positive [f/x], point [x]
      real(wp), intent(in) :: parts(2), slopes(2), point
      !> The value [f]
      real(wp) :: value

      associate (shift => point - search%point(2))
         value = search%value(2) + shift*(shift*sum(slopes) + slopes(2)*parts(1) - slopes(1)*parts(2))/sum(parts)
      end associate
   end function parabola_at

   !> Does the parabola through the bracket tell the points beside it? Without one beside the larger part it has to tell the last
   !> value, and to gain, all the less.
   pure subroutine confirm_parabola(search, parts, slopes, gain, is_smooth)
      type(minimum_t), intent(in) :: search
      !> Parts of the bracket [x], slopes of the value over them [f/x], what the parabola gains [f]
      real(wp), intent(in) :: parts(2), slopes(2), gain
      !> Does it?
      logical, intent(out) :: is_smooth

      integer :: side

      is_smooth = search%has_outer(merge(1, 2, parts(1) > parts(2))) .or. search%missed(1) + gain <= unconfirmed*search%tolerance &
         & .or. max(gain, search%missed(1)) > search%tolerance
      do side = 1, 2
         if (.not. search%has_outer(side)) cycle
         if (abs(parabola_at(search, parts, slopes, search%outer(side)) - search%outer_value(side)) > &
            & well_told*(search%outer_value(side) - search%value(2)) + search%tolerance) is_smooth = .false.
      end do
   end subroutine confirm_parabola

   !> Slope of the line through an end of the bracket and the point beside it.
   pure function leg_slope(search, side) result(slope)
      type(minimum_t), intent(in) :: search
      !> 1 or 2
      integer, intent(in) :: side
      !> The slope [f/x]
      real(wp) :: slope

      slope = (search%outer_value(side) - search%value(2*side - 1))/(search%outer(side) - search%point(2*side - 1))
   end function leg_slope

   !> Where the lines of both legs cross, if that is in the bracket and not above its middle point.
   pure subroutine cross_legs(search, has_crossing, crossing, lowest)
      type(minimum_t), intent(in) :: search
      !> Do they?
      logical, intent(out) :: has_crossing
      !> Where [x], value there [f]
      real(wp), intent(out) :: crossing, lowest

      ! Slopes of the legs [f/x]
      real(wp) :: slopes(2)

      crossing = search%point(2)
      lowest = search%value(2)
      has_crossing = .false.
      if (.not. all(search%has_outer)) return
      if (.not. (search%outer(1) < search%point(1) .and. search%outer(2) > search%point(3))) return
      slopes = [leg_slope(search, 1), leg_slope(search, 2)]
      if (.not. (slopes(1) < 0.0_wp .and. slopes(2) > 0.0_wp)) return
      associate (p => search%point, v => search%value)
         crossing = p(1) + (v(3) - v(1) - slopes(2)*(p(3) - p(1)))/(slopes(1) - slopes(2))
         lowest = v(1) + slopes(1)*(crossing - p(1))
         has_crossing = crossing > p(1) .and. crossing < p(3) .and. lowest <= v(2)
      end associate
   end subroutine cross_legs

end module camroller_minimum
