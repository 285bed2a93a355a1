!> The camshaft: all followers together, and the bearings that carry them.
!>
!> In: case, models and cycles of the lobe shapes. Out: torques of the followers and bearings of each camshaft at a cam angle.
!> Each cam sees the cycle of its lobe shape at its own phase; without camshaft bearings in the case there is one cam.
module camroller_shaft
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_case, only : camshaft_number, case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t, cam_force
   use camroller_cycle, only : cycle_t, state_at
   use camroller_torque_list, only : of_bearings
   use camroller_journal, only : cam_bearings_t, journal_t, new_journal, journal_torque
   use camroller_camshaft, only : share_loads
   implicit none
   private

   public :: shaft_t, solved_t, new_shaft, set_journal, shaft_torques, in_common_frame, bearing_torques

   !> Cams of a shaft
   type :: shaft_t
      !> Lobe shape of each cam
      integer, allocatable :: lobes(:)
      !> Camshaft of each cam, and the number of camshafts
      integer, allocatable :: shafts(:)
      integer :: count = 1
      !> Angle by which each cam's event follows the first one's [rad]
      real(wp), allocatable :: phases(:)
      !> Cosine and sine of the angle at which each follower stands, shape (2, cam) [-]
      real(wp), allocatable :: directions(:, :)
      !> Interval of the cycle where each cam's search starts
      integer, allocatable :: hints(:)
      !> Bearings; allocated where the case has them
      type(cam_bearings_t), allocatable :: bearings
      type(journal_t), allocatable :: journal
   end type shaft_t

   !> A case that is solved: model and cycle of each lobe shape, and the camshafts that carry them
   type :: solved_t
      type(case_t), pointer :: case => null()
      type(model_t), pointer :: models(:) => null()
      type(cycle_t), pointer :: cycles(:) => null()
      type(shaft_t) :: shaft
   end type solved_t

contains

   !> Cams and bearings of a case.
   subroutine new_shaft(shaft, case, viscosity, speed, error)
      !> The shaft
      type(shaft_t), intent(out) :: shaft
      !> The case
      type(case_t), intent(in) :: case
      !> Viscosity of the oil at ambient pressure [Pa s], cam speed [rad/s]
      real(wp), intent(in) :: viscosity, speed
      !> Deck or domain error of the bearings
      type(error_t), allocatable, intent(out) :: error

      integer :: cams

      if (.not. allocated(case%cam_bearings)) then
         shaft%lobes = [1]
         shaft%shafts = [1]
         shaft%phases = [0.0_wp]
         shaft%hints = [1]
         allocate (shaft%directions(2, 1))
         shaft%directions(:, 1) = [1.0_wp, 0.0_wp]
         return
      end if
      cams = size(case%cam_bearings%cam_positions)
      shaft%bearings = case%cam_bearings
      shaft%phases = case%cam_bearings%cam_phases
      shaft%lobes = case%cam_bearings%cam_lobes
      shaft%count = camshaft_number(case)
      allocate (shaft%shafts(cams))
      shaft%shafts = 1
      if (allocated(case%cam_bearings%cam_shafts)) shaft%shafts = case%cam_bearings%cam_shafts
      allocate (shaft%directions(2, cams), shaft%hints(cams))
      shaft%directions(1, :) = cos(case%cam_bearings%follower_angles)
      shaft%directions(2, :) = sin(case%cam_bearings%follower_angles)
      shaft%hints = 1
      allocate (shaft%journal)
      call set_journal(shaft, viscosity, speed, error)
   end subroutine new_shaft

   !> Set the bearings, where there are any, to another viscosity and speed.
   subroutine set_journal(shaft, viscosity, speed, error)
      !> The shaft
      type(shaft_t), intent(inout) :: shaft
      !> Viscosity of the oil at ambient pressure [Pa s], cam speed [rad/s]
      real(wp), intent(in) :: viscosity, speed
      !> Deck or domain error of the bearings
      type(error_t), allocatable, intent(out) :: error

      if (allocated(shaft%journal)) call new_journal(shaft%journal, shaft%bearings, viscosity, speed, error)
   end subroutine set_journal

   !> Torques at a cam angle, and the state of the first cam's follower.
   subroutine shaft_torques(solved, angle, first_state, torques, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> State of the first follower
      type(state_t), intent(out) :: first_state
      !> Torques of all followers and bearings of each camshaft, the rows of `torque_list` [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(:, :)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Force on each cam in the frame of the first follower [N]
      real(wp) :: forces(2, size(solved%shaft%lobes))
      integer :: cam

      torques = 0.0_wp
      associate (shaft => solved%shaft)
         do cam = 1, size(shaft%lobes)
            associate (model => solved%models(shaft%lobes(cam)), cycle => solved%cycles(shaft%lobes(cam)))
               call state_at(cycle, model, angle - shaft%phases(cam), shaft%hints(cam), state, error)
               if (allocated(error)) return
               if (cam == 1) first_state = state
               torques(:, shaft%shafts(cam)) = torques(:, shaft%shafts(cam)) + state%torques
               if (allocated(shaft%journal)) forces(:, cam) = in_common_frame(shaft, cam, cam_force(model, state))
            end associate
         end do
         call bearing_torques(shaft, forces, torques(of_bearings, :), error)
      end associate
   end subroutine shaft_torques

   !> Force on a cam in the frame of the first follower.
   pure function in_common_frame(shaft, cam, force) result(turned)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> The cam
      integer, intent(in) :: cam
      !> Force in the frame of its own follower [N]
      real(wp), intent(in) :: force(2)
      !> The same force [N]
      real(wp) :: turned(2)

      associate (c => shaft%directions(1, cam), s => shaft%directions(2, cam))
         turned = [c*force(1) - s*force(2), s*force(1) + c*force(2)]
      end associate
   end function in_common_frame

   !> Torque of all bearings of each camshaft; zero where the case has none.
   subroutine bearing_torques(shaft, forces, torques, error)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> Force on each cam in the frame of the first follower, shape (2, cam) [N]
      real(wp), intent(in) :: forces(:, :)
      !> The torques [N m]
      real(wp), intent(out) :: torques(:)
      !> Domain error where a bearing law has no solution
      type(error_t), allocatable, intent(out) :: error

      integer :: cam, k

      torques = 0.0_wp
      if (.not. allocated(shaft%journal)) return
      do k = 1, shaft%count
         call add_bearings(shaft, pack([(cam, cam=1, size(shaft%lobes))], shaft%shafts == k), forces, torques(k), error)
         if (allocated(error)) return
      end do
   end subroutine bearing_torques

   !> Torque of all bearings of a camshaft under the forces of its cams.
   subroutine add_bearings(shaft, cams, forces, bearing_torque, error)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> Cams of this camshaft
      integer, intent(in) :: cams(:)
      !> Force on each cam [N]
      real(wp), intent(in) :: forces(:, :)
      !> Torque of all bearings [N m]
      real(wp), intent(out) :: bearing_torque
      !> Domain error where a bearing law has no solution
      type(error_t), allocatable, intent(out) :: error

      ! Load vector of each bearing [N]; torque of one bearing [N m]
      real(wp) :: loads(2, size(shaft%bearings%bearing_positions)), torque
      integer :: bearing, status

      bearing_torque = 0.0_wp
      call share_loads(shaft%bearings%bearing_positions, shaft%bearings%cam_positions(cams), forces(:, cams), loads)
      do bearing = 1, size(loads, 2)
         call journal_torque(shaft%journal, norm2(loads(:, bearing)), torque, status)
         if (status /= 0) then
            call raise(error, kind_domain, "camshaft bearings: the bearing law has no solution for this load")
            return
         end if
         bearing_torque = bearing_torque + torque
      end do
   end subroutine add_bearings

end module camroller_shaft
