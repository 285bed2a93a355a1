!> Loads that the cams put on the bearings of a camshaft.
!>
!> In: places of bearings and cams, force on each cam at one instant. Out: load vector of each bearing.
!> The shaft is a row of beams from bearing to bearing, hinged at the bearings, so that a cam loads its two neighbours only.
!> Source: the usual static balance; Islam (2019), section on camshaft bearings.
module camroller_camshaft
   use camroller_kinds, only : wp
   use camroller_journal, only : cam_bearings_t
   implicit none
   private

   public :: bearing_loads, share_loads, share_force

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

   !> Add the force of one cam to the loads of its two neighbouring bearings.
   pure subroutine share_force(bearing_positions, cam_position, force, loads)
      !> Places of the bearings along the shaft, increasing, at least two [m]
      real(wp), intent(in) :: bearing_positions(:)
      !> Place of the cam, between the first and the last bearing [m]
      real(wp), intent(in) :: cam_position
      !> Its force [N]
      real(wp), intent(in) :: force(2)
      !> Force of the shaft on each bearing, shape (2, bearing) [N]
      real(wp), intent(inout) :: loads(:, :)

      !> Part of the force that the right-hand bearing carries [-]
      real(wp) :: part
      integer :: left

      left = count(bearing_positions(2:size(bearing_positions) - 1) <= cam_position) + 1
      part = (cam_position - bearing_positions(left))/(bearing_positions(left + 1) - bearing_positions(left))
      loads(:, left) = loads(:, left) + (1.0_wp - part)*force
      loads(:, left + 1) = loads(:, left + 1) + part*force
   end subroutine share_force

end module camroller_camshaft
