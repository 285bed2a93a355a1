!> Do turns without a period still change in one direction? What they say is then of a transient.
!>
!> In: the starts of some turns in a row. Out: `trend_t`. A component drifts where its ranks follow the number of the turn, whatever
!> the size of single steps; turns approach a period where their distance from those a period before falls throughout.
module camroller_flexible_trend
   use camroller_kinds, only : wp
   implicit none
   private

   public :: trend_t, find_trend

   !> Correlation of a component's ranks with the number of the turn above which it drifts: of 40 independent numbers one in a
   !> million has as much by chance [-]
   real(wp), parameter :: steady = 0.7_wp
   !> Part of the smallest distance between turns at the beginning below which the largest at the end must be [-]
   real(wp), parameter :: nearer = 0.5_wp
   !> Longest period that is looked for, and part of the turns that beginning and end are
   integer, parameter :: longest = 8, parts = 4

   !> How turns change
   type :: trend_t
      !> Does a component drift?
      logical :: drifts = .false.
      !> Period that the turns approach; 0 where there is none
      integer :: approached = 0
   end type trend_t

contains

   !> Look for a trend.
   pure subroutine find_trend(starts, trend)
      !> Starts of turns in units of their scales, shape (component, turn), the newest last [-]
      real(wp), intent(in) :: starts(:, :)
      !> What is found
      type(trend_t), intent(out) :: trend

      ! Distance of each turn from the one a period before [-]
      real(wp) :: distances(size(starts, 2))
      integer :: i, k, part

      do i = 1, size(starts, 1)
         trend%drifts = trend%drifts .or. abs(correlation(starts(i, :))) > steady
      end do
      do k = 1, longest
         associate (n => size(starts, 2) - k)
            part = n/parts
            if (part < 1) return
            distances(:n) = maxval(abs(starts(:, k + 1:) - starts(:, :n)), 1)
            if (maxval(distances(n - part + 1:n)) > nearer*minval(distances(:part))) cycle
            trend%approached = k
            return
         end associate
      end do
   end subroutine find_trend

   !> Correlation of the ranks of numbers with their places (Spearman).
   pure function correlation(values) result(coefficient)
      !> The numbers [any]
      real(wp), intent(in) :: values(:)
      !> From -1 to 1 [-]
      real(wp) :: coefficient

      ! Places and ranks less their means; equal numbers share a rank [-]
      real(wp), dimension(size(values)) :: places, ranks
      integer :: i

      places = [(i - 0.5_wp*(size(values) + 1), i=1, size(values))]
      ranks = [(0.5_wp*(count(values < values(i)) - count(values > values(i))), i=1, size(values))]
      coefficient = dot_product(places, ranks)/max(norm2(places)*norm2(ranks), tiny(1.0_wp))
   end function correlation

end module camroller_flexible_trend
