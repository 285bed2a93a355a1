!> Loads that the cams put on the bearings of a camshaft.
!>
!> In: places of bearings and cams, force on each cam at one instant, pull of a belt. Out: load vector of each bearing.
!> The shaft is a row of beams from bearing to bearing, hinged at the bearings, so that a cam loads its two neighbours only.
!> Source: the usual static balance; Islam (2019), section on camshaft bearings.
module camroller_camshaft
   use camroller_kinds, only : wp
   use camroller_journal, only : cam_bearings_t
   implicit none
   private

   public :: belt_pull_t, bearing_loads, share_loads, share_force, share_pull

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

   !> Load vector of each bearing of a camshaft.
   pure subroutine bearing_loads(bearings, forces, loads)
      !> Camshaft and its bearings
      type(cam_bearings_t), intent(in) :: bearings
      !> Force on each cam, shape (2, cam), in any fixed frame [N]
      real(wp), intent(in) :: forces(:, :)
      !> Force of the shaft on each bearing, shape (2, bearing) [N]
      real(wp), intent(out) :: loads(:, :)

      call share_loads(bearings%bearing_positions, bearings%cam_positions, forces, loads)
   end subroutine bearing_loads

   !> Share each cam's force between its two neighbouring bearings by the rule of the lever.
   !>
   !> A cam beyond the last bearing would need a moment there: such a shaft is refused when the case is checked.
   pure subroutine share_loads(bearing_positions, cam_positions, forces, loads)
      !> Places of the bearings along the shaft, increasing, at least two [m]
      real(wp), intent(in) :: bearing_positions(:)
      !> Places of the cams along the shaft, between the first and the last bearing [m]
      real(wp), intent(in) :: cam_positions(:)
      !> Force on each cam, shape (2, cam) [N]
      real(wp), intent(in) :: forces(:, :)
      !> Force of the shaft on each bearing, shape (2, bearing) [N]
      real(wp), intent(out) :: loads(:, :)

      integer :: cam

      loads = 0.0_wp
      do cam = 1, size(cam_positions)
         call share_force(bearing_positions, cam_positions(cam), forces(:, cam), loads)
      end do
   end subroutine share_loads

   !> Add the pull of a belt to the loads of the two bearings beside it.
   pure subroutine share_pull(bearing_positions, pull, loads)
      !> Places of the bearings along the shaft, increasing, at least two [m]
      real(wp), intent(in) :: bearing_positions(:)
      !> The pull
      type(belt_pull_t), intent(in) :: pull
      !> Force of the shaft on each bearing, shape (2, bearing) [N]
      real(wp), intent(inout) :: loads(:, :)

      call share_force(bearing_positions, pull%position, pull%force*[cos(pull%angle), sin(pull%angle)], loads)
   end subroutine share_pull

   !> Add a force to the loads of its two neighbouring bearings. Beyond the last bearing the beam that ends there is a lever: it
   !> presses on that bearing by more than the force, and lifts the next one.
   pure subroutine share_force(bearing_positions, position, force, loads)
      !> Places of the bearings along the shaft, increasing, at least two [m]
      real(wp), intent(in) :: bearing_positions(:)
      !> Place of the force [m]
      real(wp), intent(in) :: position
      !> The force [N]
      real(wp), intent(in) :: force(2)
      !> Force of the shaft on each bearing, shape (2, bearing) [N]
      real(wp), intent(inout) :: loads(:, :)

      !> Part of the force that the right-hand bearing carries [-]
      real(wp) :: part
      integer :: left

      left = count(bearing_positions(2:size(bearing_positions) - 1) <= position) + 1
      part = (position - bearing_positions(left))/(bearing_positions(left + 1) - bearing_positions(left))
      loads(:, left) = loads(:, left) + (1.0_wp - part)*force
      loads(:, left + 1) = loads(:, left + 1) + part*force
   end subroutine share_force

end module camroller_camshaft
