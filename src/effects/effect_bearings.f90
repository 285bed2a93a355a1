!> Mean torque of camshaft bearings in a survey of the cycle.
!>
!> In: a case with one cam on its shaft, survey of its cycle. Out: mean torque of its bearings, seals and drive. What a bearing
!> takes from the whole turn, orbit and temperature, is found as in a run, with less accuracy and under a load that is linear
!> between the angles of the survey.
module camroller_effect_bearings
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_bearing_means, only : bearing_turn_t, choose_angles, mean_of_turn
   use camroller_bearing_turn, only : find_turn
   use camroller_case, only : case_t
   use camroller_effect_grid, only : points
   use camroller_effect_survey, only : survey_t
   use camroller_journal_orbit, only : bearing_load_t
   use camroller_model, only : model_t
   use camroller_shaft, only : bearing_number, bearing_torques, in_common_frame, new_shaft, shaft_t
   use camroller_state, only : cam_force
   implicit none
   private

   public :: mean_bearing_torque

   !> Error of what follows from a whole turn, see `bearing_turn_t` [-]
   real(wp), parameter :: turn_accuracy = 1.0e-2_wp

   !> Load on a bearing at the angles of a survey
   type, extends(bearing_load_t) :: surveyed_load_t
      !> Angles, increasing [rad], load there, shape (2, angle) [N]
      real(wp) :: angles(points) = 0.0_wp, loads(2, points) = 0.0_wp
   contains
      procedure :: get_load => load_between
   end type surveyed_load_t

contains

   !> Mean torque of the bearings of a single cam, and of seals and drive.
   subroutine mean_bearing_torque(case, model, survey, over_turn, mean, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its model
      type(model_t), intent(in) :: model
      !> The cycle
      type(survey_t), intent(in) :: survey
      !> Follow each bearing over the turn, as orbits and heat need it, and what is compared with them?
      logical, intent(in) :: over_turn
      !> Mean torque [N m]
      real(wp), intent(out) :: mean
      !> What the bearings have no solution for, of any kind
      type(error_t), allocatable, intent(out) :: error

      type(shaft_t) :: shaft
      type(bearing_state_t), allocatable :: states(:, :)
      type(surveyed_load_t), allocatable :: loads(:)
      ! Force on the cam in the frame of the first follower [N]; torque of the bearings, of one [N m]
      real(wp) :: forces(2, 1), torques(1), torque
      integer :: i, bearing

      mean = 0.0_wp
      call new_shaft(shaft, case, model%oil%viscosity, model%speed, error)
      if (allocated(error)) return
      allocate (states(bearing_number(shaft), 1), loads(bearing_number(shaft)))
      do i = 1, points
         forces(:, 1) = in_common_frame(shaft, 1, cam_force(model, survey%states(i)))
         call bearing_torques(shaft, forces, torques, error, states)
         if (allocated(error)) return
         mean = mean + survey%grid%weights(i)*torques(1)
         do bearing = 1, size(loads)
            loads(bearing)%loads(:, i) = states(bearing, 1)%load
         end do
      end do
      if (over_turn) mean = 0.0_wp
      do bearing = 1, merge(size(loads), 0, over_turn)
         loads(bearing)%angles = survey%grid%angles
         call follow_bearing(case, shaft, -model%linkage%sense, loads(bearing), torque, error)
         if (allocated(error)) return
         mean = mean + torque
      end do
      mean = mean + shaft%drag
   end subroutine mean_bearing_torque

   !> Mean torque of one bearing with the temperature and the orbit that the case asks for.
   subroutine follow_bearing(case, shaft, rotation, load, torque, error)
      type(case_t), intent(in) :: case
      type(shaft_t), intent(in) :: shaft
      !> Sense in which the shaft turns [-]
      real(wp), intent(in) :: rotation
      !> What loads the bearing
      type(surveyed_load_t), intent(in) :: load
      !> Mean torque [N m]
      real(wp), intent(out) :: torque
      !> What the bearing has no solution for, of any kind
      type(error_t), allocatable, intent(out) :: error

      type(bearing_turn_t) :: turn
      ! Mean flow of oil [m^3/s]
      real(wp) :: flow
      logical :: is_finer

      torque = 0.0_wp
      turn%stops = load%angles(1) + [0.0_wp, two_pi]
      turn%rotation = rotation
      turn%accuracy = turn_accuracy
      call find_turn(case, shaft, load, turn, error)
      if (.not. (allocated(error) .or. allocated(turn%angles))) call choose_angles(case, shaft, load, turn, is_finer, error)
      if (.not. allocated(error)) call mean_of_turn(case, shaft, turn, torque, flow, error)
   end subroutine follow_bearing

   !> Force of the shaft on a bearing, on the straight line between two angles of the survey.
   subroutine load_between(self, angle, load, status)
      !> What loads it
      class(surveyed_load_t), intent(in) :: self
      !> Angle of the shaft, any turn [rad]
      real(wp), intent(in) :: angle
      !> The force [N]
      real(wp), intent(out) :: load(2)
      !> 0
      integer, intent(out) :: status

      ! Way from the first angle, from the one before, length of the piece [rad]
      real(wp) :: way, part, length
      integer :: before, next

      status = 0
      way = modulo(angle - self%angles(1), two_pi)
      before = count(self%angles - self%angles(1) <= way)
      next = modulo(before, points) + 1
      length = self%angles(next) - self%angles(before)
      if (next == 1) length = length + two_pi
      part = (way - (self%angles(before) - self%angles(1)))/length
      load = (1.0_wp - part)*self%loads(:, before) + part*self%loads(:, next)
   end subroutine load_between

end module camroller_effect_bearings
