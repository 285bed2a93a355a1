!> Loads that the cams put on the bearings of a camshaft.
!>
!> In: places of the bearings and of a cam, pull of a belt. Out: part of a force there that each bearing carries, loads by the pull.
!> The shaft is a row of beams from bearing to bearing, hinged at the bearings, so that a cam loads its two neighbours only.
!> Source: the usual static balance; Islam (2019), section on camshaft bearings.
module camroller_bearing_loads
   use camroller_kinds, only : wp
   implicit none
   private

   public :: belt_pull_t, bearing_shares, pull_loads, add_forces

   !> Constant force on a camshaft, of the belt or chain that drives it
   type :: belt_pull_t
      !> Force [N]
      real(wp) :: force = 0.0_wp
      !> Its direction, from the line from the first follower's pivot to the cam's centre, positive the way a finger turns as it
      !> opens its valve [rad]
      real(wp) :: angle = 0.0_wp
      !> Place of the wheel along the shaft, which may overhang the bearings [m]
      real(wp) :: position = 0.0_wp
   end type belt_pull_t

contains

   !> Parts of a force that each bearing carries, by the rule of the lever between the two beside it. Beyond the last bearing the
   !> beam that ends there is a lever: it presses on that bearing by more than the force, and lifts the next one. A cam there would
   !> need a moment: such a shaft is refused when the case is checked.
   pure function bearing_shares(bearing_positions, position) result(shares)
      !> Places of the bearings along the shaft, increasing, at least two [m]
      real(wp), intent(in) :: bearing_positions(:)
      !> Place of the force [m]
      real(wp), intent(in) :: position
      !> The parts [-]
      real(wp) :: shares(size(bearing_positions))

      integer :: left

      left = count(bearing_positions(2:size(bearing_positions) - 1) <= position) + 1
      shares = 0.0_wp
      shares(left + 1) = (position - bearing_positions(left))/(bearing_positions(left + 1) - bearing_positions(left))
      shares(left) = 1.0_wp - shares(left + 1)
   end function bearing_shares

   !> Loads of the bearings by the pull of a belt.
   pure function pull_loads(bearing_positions, pull) result(loads)
      !> Places of the bearings along the shaft, increasing, at least two [m]
      real(wp), intent(in) :: bearing_positions(:)
      !> The pull
      type(belt_pull_t), intent(in) :: pull
      !> Force of the shaft on each bearing, shape (2, bearing) [N]
      real(wp) :: loads(2, size(bearing_positions))

      associate (shares => bearing_shares(bearing_positions, pull%position))
         loads(1, :) = pull%force*cos(pull%angle)*shares
         loads(2, :) = pull%force*sin(pull%angle)*shares
      end associate
   end function pull_loads

   !> Add to the loads of the bearings of one camshaft what both beside each of its cams carry of the force there.
   pure subroutine add_forces(cams, bearings, shafts, shaft, left, shares, forces, loads)
      !> Number of cams of all camshafts, of bearings of one
      integer, intent(in) :: cams, bearings
      !> Camshaft of each cam; the one wanted
      integer, intent(in) :: shafts(cams), shaft
      !> The first of both bearings beside each cam
      integer, intent(in) :: left(cams)
      !> Part of each cam's force that each bearing carries [-]
      real(wp), intent(in) :: shares(bearings, cams)
      !> Forces on the cams [N]
      real(wp), intent(in) :: forces(2, cams)
      !> The loads [N]
      real(wp), intent(inout) :: loads(2, bearings)

      integer :: cam, bearing

      do cam = 1, cams
         if (shafts(cam) /= shaft) cycle
         do bearing = left(cam), left(cam) + 1
            loads(:, bearing) = loads(:, bearing) + shares(bearing, cam)*forces(:, cam)
         end do
      end do
   end subroutine add_forces

end module camroller_bearing_loads
