!> A whole case driven from outside: the followers of all cams with their phases, the camshafts and the bearings that carry them.
!>
!> In: a case, then cam angles with speed, oil temperature and, for each cam, gas pressure at both ends of each step. Out: torques
!> of all camshafts together by source, means over the step and values at its end, and what each follower gives. A step that fails
!> leaves everything as it was, to the last bit. Bits do not depend on the number of threads.
module camroller_shaft_simulation
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, add_context, kind_usage
   use camroller_number_text, only : integer_text
   use camroller_bearing_remarks, only : judge_step_bearings
   use camroller_cam_lists, only : check_cam_lists
   use camroller_case, only : case_t
   use camroller_catalogue, only : camshaft_columns, camshaft_count, camshaft_values, follower_count, list_series, lobe_columns
   use camroller_lubricant, only : oil_t, get_oil
   use camroller_follower_step, only : point_t, outcome_t
   use camroller_step_inputs, only : inputs_t
   use camroller_shaft, only : bearing_number, needs_turn, shaft_t, new_shaft
   use camroller_simulation, only : simulation_t, advance, halt, check_step, prepare_simulation, place_simulation, &
      & check_angle, has_films, get_mark, get_point, set_point, get_values, simulation_place, put_simulation_back, &
      & judge_common_inputs, judge_outcome
   use camroller_model_mark, only : mixed
   use camroller_remarks, only : remark_t
   use camroller_result, only : quantity_t
   use camroller_camshaft_step, only : shaft_outcome_t, step_room_t, make_room, add_up
   implicit none
   private

   public :: shaft_simulation_t, shaft_outcome_t, prepare_shaft, start_shaft, advance_shaft, halt_shaft
   public :: cam_number, cam_place, shaft_angle, shaft_series, shaft_values, list_shaft_remarks, get_shaft_mark, cam_point, &
      & set_shaft

   !> All followers of a case between two steps
   type :: shaft_simulation_t
      private
      type(case_t) :: case
      type(shaft_t) :: shaft
      !> Follower of each cam; not allocated before the start
      type(simulation_t), allocatable :: followers(:)
      !> Cam angle of the first cam [rad]
      real(wp) :: angle = 0.0_wp
      !> Threads that share the followers
      integer :: threads = 1
      !> Room of a step, kept for the next one
      type(step_room_t) :: room
   end type shaft_simulation_t

contains

   !> Put all followers of a case at the cam angle of the first one.
   subroutine start_shaft(shaft, case, cam_angle, error, threads)
      !> The shaft; not to be advanced where there is an error
      type(shaft_simulation_t), intent(out) :: shaft
      !> A case; its operating point is that of the start. Without camshaft bearings it has one cam
      type(case_t), intent(in) :: case
      !> Cam angle, pi where the first cam has full lift [rad]
      real(wp), intent(in) :: cam_angle
      !> Usage, deck or domain error
      type(error_t), allocatable, intent(out) :: error
      !> Threads that share the followers in a step, 1 without it
      integer, intent(in), optional :: threads

      integer :: cam

      call prepare_shaft("start_shaft", shaft, case, error, threads)
      if (.not. allocated(error)) call check_angle("start_shaft", cam_angle, error)
      if (.not. allocated(error)) then
         shaft%angle = cam_angle
         do cam = 1, size(shaft%followers)
            call place_simulation(shaft%followers(cam), cam_angle - shaft%shaft%phases(cam), error)
            if (allocated(error)) exit
         end do
      end if
      if (allocated(error) .and. allocated(shaft%followers)) deallocate (shaft%followers)
   end subroutine start_shaft

   !> Make the models of a shaft, whose followers are still to be placed.
   subroutine prepare_shaft(caller, shaft, case, error, threads)
      !> Who asks
      character(len=*), intent(in) :: caller
      !> The shaft; without followers where there is an error
      type(shaft_simulation_t), intent(out) :: shaft
      !> A case
      type(case_t), intent(in) :: case
      !> Usage, deck or domain error
      type(error_t), allocatable, intent(out) :: error
      !> Threads that share the followers in a step, 1 without it
      integer, intent(in), optional :: threads

      type(oil_t) :: oil
      integer :: cam, first

      if (present(threads)) shaft%threads = threads
      if (shaft%threads < 1) then
         call raise(error, kind_usage, caller//": the number of threads must be 1 or more")
         return
      end if
      if (needs_turn(case)) then
         call raise(error, kind_usage, caller//": orbits of journals and heat of camshaft bearings follow from a "// &
            & "whole turn, not step by step; set journal_motion = 'quasi_steady' in &cam_bearings and leave &bearing_heat out")
         return
      end if
      if (allocated(case%cam_bearings)) call check_cam_lists(case%cam_bearings, allocated(case%second_lift), error)
      if (.not. allocated(error)) call get_oil(case%lubricant, case%operating_point%oil_temperature, oil, error)
      if (.not. allocated(error)) call new_shaft(shaft%shaft, case, oil%viscosity, case%operating_point%speed, error)
      if (allocated(error)) return
      shaft%case = case
      associate (lobes => shaft%shaft%lobes)
         allocate (shaft%followers(size(lobes)))
         do cam = 1, size(lobes)
            ! A shape is prepared once
            first = findloc(lobes, lobes(cam), 1)
            if (first < cam) shaft%followers(cam) = shaft%followers(first)
            if (first == cam) call prepare_simulation(caller, shaft%followers(cam), case, lobes(cam), error)
            if (allocated(error)) exit
         end do
      end associate
      if (allocated(error)) deallocate (shaft%followers)
   end subroutine prepare_shaft

   !> Advance all followers to a cam angle, with inputs at both ends of the step, linear in the cam angle between.
   subroutine advance_shaft(shaft, cam_angle, start, finish, outcome, error, pressures)
      !> The shaft; left as it was where there is an error
      type(shaft_simulation_t), intent(inout) :: shaft
      !> Cam angle of the first cam at the end of the step, beyond the present one [rad]
      real(wp), intent(in) :: cam_angle
      !> Speed and oil temperature at the start and at the end of the step; their gas pressure is that of every cam
      type(inputs_t), intent(in) :: start, finish
      !> Torques and states; of no meaning where there is an error. One that an earlier step has filled is not allocated again
      type(shaft_outcome_t), intent(inout) :: outcome
      !> Usage, deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Gauge pressure of each cam's valve, in the place of that of the inputs, shape (cam, 2) for both ends [Pa]
      real(wp), intent(in), optional :: pressures(:, :)

      type(simulation_t), allocatable :: kept(:)
      integer :: cam

      if (.not. allocated(shaft%followers)) then
         call raise(error, kind_usage, "advance_shaft: the shaft has not been started; call start_shaft first")
         return
      end if
      call check_shaft_step(shaft, cam_angle, pressures, error)
      if (allocated(error)) return
      call make_room(shaft%room, cam_angle - shaft%angle, allocated(shaft%case%dynamics), &
         & size(shaft%followers), shaft%shaft%count)
      if (has_films(shaft%followers(1))) kept = shaft%followers
      if (allocated(outcome%followers)) then
         if (size(outcome%followers) /= size(shaft%followers)) deallocate (outcome%followers)
      end if
      if (.not. allocated(outcome%followers)) allocate (outcome%followers(size(shaft%followers)))
      associate (room => shaft%room)
         do cam = 1, size(shaft%followers)
            room%before(cam) = simulation_place(shaft%followers(cam))
         end do
         if (shaft%threads == 1) then
            do cam = 1, size(shaft%followers)
               call advance_cam(shaft%followers(cam), cam, cam_angle - shaft%shaft%phases(cam), [start, finish], &
                  & outcome%followers(cam), room%nodes(:, :, cam), room%failures(cam)%error, pressures)
            end do
         else
            !$omp parallel do num_threads(min(shaft%threads, size(shaft%followers))) schedule(static, 1)
            do cam = 1, size(shaft%followers)
               call advance_cam(shaft%followers(cam), cam, cam_angle - shaft%shaft%phases(cam), [start, finish], &
                  & outcome%followers(cam), room%nodes(:, :, cam), room%failures(cam)%error, pressures)
            end do
            !$omp end parallel do
         end if
         do cam = 1, size(shaft%followers)
            if (.not. allocated(room%failures(cam)%error)) cycle
            if (.not. allocated(error)) then
               call move_alloc(room%failures(cam)%error, error)
               if (size(shaft%followers) > 1) call add_context(error, "cam "//integer_text(cam))
            else
               deallocate (room%failures(cam)%error)
            end if
         end do
      end associate
      if (.not. allocated(error)) call add_up(shaft%case, shaft%shaft, shaft%room, start, finish, outcome, error)
      if (.not. allocated(error)) then
         shaft%angle = cam_angle
      else if (allocated(kept)) then
         call move_alloc(kept, shaft%followers)
      else
         do cam = 1, size(shaft%followers)
            call put_simulation_back(shaft%followers(cam), shaft%room%before(cam))
         end do
      end if
   end subroutine advance_shaft

   !> Refuse a step that cannot be.
   subroutine check_shaft_step(shaft, cam_angle, pressures, error)
      type(shaft_simulation_t), intent(in) :: shaft
      !> Cam angle at the end of the step [rad]
      real(wp), intent(in) :: cam_angle
      !> Pressures of the cams, if any [Pa]
      real(wp), intent(in), optional :: pressures(:, :)
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      call check_step(shaft%angle, cam_angle, error)
      if (allocated(error) .or. .not. present(pressures)) return
      if (any(shape(pressures) /= [size(shaft%followers), 2])) call raise(error, kind_usage, "advance_shaft: give a gas "// &
         & "pressure for each of the "//integer_text(size(shaft%followers))//" cams at both ends of the step")
   end subroutine check_shaft_step

   !> Advance the follower of one cam.
   subroutine advance_cam(follower, cam, cam_angle, inputs, outcome, nodes, error, pressures)
      type(simulation_t), intent(inout) :: follower
      integer, intent(in) :: cam
      !> Its angle at the end of the step [rad]
      real(wp), intent(in) :: cam_angle
      !> Inputs at both ends
      type(inputs_t), intent(in) :: inputs(2)
      !> What the follower gives
      type(outcome_t), intent(out) :: outcome
      !> Force on the cam [N] and torque [N m]
      real(wp), intent(out) :: nodes(:, :)
      !> Usage, deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Pressures of the cams [Pa]
      real(wp), intent(in), optional :: pressures(:, :)

      type(inputs_t) :: ends(2)

      ends = inputs
      if (present(pressures)) then
         ends%has_pressure = .true.
         ends%gas_pressure = pressures(cam, :)
      end if
      call advance(follower, cam_angle, ends(1), ends(2), outcome, error, nodes)
   end subroutine advance_cam

   !> Bring all rollers to rest, as in an engine that has stopped: the next step starts without spin.
   pure subroutine halt_shaft(shaft)
      !> The shaft
      type(shaft_simulation_t), intent(inout) :: shaft

      integer :: cam

      if (.not. allocated(shaft%followers)) return
      do cam = 1, size(shaft%followers)
         call halt(shaft%followers(cam))
      end do
   end subroutine halt_shaft

   !> Number of cams; 0 before the start.
   pure function cam_number(shaft) result(cams)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The number
      integer :: cams

      cams = 0
      if (allocated(shaft%followers)) cams = size(shaft%followers)
   end function cam_number

   !> Lobe shape, camshaft and phase of a cam; zeros where there is none of that number.
   subroutine cam_place(shaft, cam, lobe, camshaft, phase, error)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The cam, from 1
      integer, intent(in) :: cam
      !> Lobe shape, 1 or 2; camshaft, from 1
      integer, intent(out) :: lobe, camshaft
      !> Angle by which the cam's event follows that of the first cam [rad]
      real(wp), intent(out) :: phase
      !> Usage error where the shaft has no cam of that number
      type(error_t), allocatable, intent(out), optional :: error

      type(error_t), allocatable :: failure

      lobe = 0
      camshaft = 0
      phase = 0.0_wp
      call check_cam(shaft, cam, 1, "cam_place", failure)
      if (present(error) .and. allocated(failure)) error = failure
      if (allocated(failure)) return
      lobe = shaft%shaft%lobes(cam)
      camshaft = shaft%shaft%shafts(cam)
      phase = shaft%shaft%phases(cam)
   end subroutine cam_place

   !> Cam angle of the first cam.
   pure function shaft_angle(shaft) result(angle)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The angle [rad]
      real(wp) :: angle

      angle = shaft%angle
   end function shaft_angle

   !> Refuse a cam that a shaft has not.
   subroutine check_cam(shaft, cam, smallest, caller, error)
      type(shaft_simulation_t), intent(in) :: shaft
      !> The cam, and the smallest number that is allowed
      integer, intent(in) :: cam, smallest
      !> Who asks
      character(len=*), intent(in) :: caller
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (.not. allocated(shaft%followers)) then
         call raise(error, kind_usage, caller//": the shaft has not been started; call start_shaft first")
      else if (cam < smallest .or. cam > size(shaft%followers)) then
         call raise(error, kind_usage, caller//": there is no cam "//integer_text(cam)//"; the shaft has "// &
            & integer_text(size(shaft%followers)))
      end if
   end subroutine check_cam

   !> Names, units and meanings of the values of a follower or of the camshafts.
   subroutine shaft_series(case, cam, series)
      !> The case that the shaft is started with
      type(case_t), intent(in) :: case
      !> Any cam, from 1; 0 for the camshafts
      integer, intent(in) :: cam
      !> The series in the order of `shaft_values`
      type(quantity_t), allocatable, intent(out) :: series(:)

      integer :: columns(2)

      call list_series(case, series)
      columns = camshaft_columns(case)
      if (cam > 0) columns = lobe_columns(case, 1)
      series = series(columns(1):columns(2))
   end subroutine shaft_series

   !> Values of the series of one cam's follower, or of all camshafts, at the end of the last step.
   subroutine shaft_values(shaft, cam, outcome, values, error)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The cam, from 1; 0 for the camshafts
      integer, intent(in) :: cam
      !> What its last step gave
      type(shaft_outcome_t), intent(in) :: outcome
      !> Values in the order of `shaft_series`; none where there is an error [unit of the series]
      real(wp), allocatable, intent(out) :: values(:)
      !> Usage error where there is no such cam, or the outcome is not that of a step of the shaft
      type(error_t), allocatable, intent(out), optional :: error

      type(error_t), allocatable :: failure

      call check_cam(shaft, cam, 0, "shaft_values", failure)
      if (.not. allocated(failure)) call check_outcome(shaft, outcome, failure)
      if (present(error) .and. allocated(failure)) error = failure
      if (allocated(failure)) then
         allocate (values(0))
      else if (cam > 0) then
         allocate (values(follower_count(shaft%case)))
         call get_values(shaft%followers(cam), shaft%case, outcome%followers(cam)%state, values)
      else
         allocate (values(camshaft_count(shaft%case)))
         call camshaft_values(shaft%case, outcome%by_camshaft, values, outcome%bearings)
      end if
   end subroutine shaft_values

   !> Remarks on the last step of a shaft: what its numbers do not tell, of each cam and of the bearings at its end.
   subroutine list_shaft_remarks(shaft, outcome, remarks)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> What its last step gave; without a step of this shaft there are no remarks
      type(shaft_outcome_t), intent(in) :: outcome
      !> The remarks; those on one cam begin with its number
      type(remark_t), allocatable, intent(out) :: remarks(:)

      type(error_t), allocatable :: failure
      type(remark_t), allocatable :: of_cam(:)
      integer :: cam, i

      allocate (remarks(0))
      if (.not. allocated(shaft%followers)) return
      call check_outcome(shaft, outcome, failure)
      if (allocated(failure)) return
      do cam = 1, size(shaft%followers)
         allocate (of_cam(0))
         call judge_outcome(shaft%followers(cam), outcome%followers(cam), of_cam)
         do i = 1, size(of_cam)
            of_cam(i)%text = "cam "//integer_text(cam)//": "//of_cam(i)%text
         end do
         remarks = [remarks, of_cam]
         deallocate (of_cam)
      end do
      call judge_common_inputs(shaft%case, outcome%followers(1), remarks)
      if (allocated(outcome%bearings)) call judge_step_bearings(shaft%shaft, outcome%bearings, remarks)
   end subroutine list_shaft_remarks

   !> Refuse an outcome that no step of a shaft has filled.
   subroutine check_outcome(shaft, outcome, error)
      type(shaft_simulation_t), intent(in) :: shaft
      type(shaft_outcome_t), intent(in) :: outcome
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      logical :: fits

      fits = allocated(outcome%followers) .and. allocated(outcome%by_camshaft)
      if (fits) fits = size(outcome%followers) == size(shaft%followers) .and. size(outcome%by_camshaft, 2) == shaft%shaft%count &
         & .and. (allocated(outcome%bearings) .eqv. bearing_number(shaft%shaft) > 0)
      if (fits .and. allocated(outcome%bearings)) fits = size(outcome%bearings, 1) == bearing_number(shaft%shaft)
      if (.not. fits) call raise(error, kind_usage, "shaft_values: the outcome is not that of a step of this shaft; call "// &
         & "advance_shaft first")
   end subroutine check_outcome

   !> Mark of a shaft: of its followers, where they stand, and of the bearings.
   subroutine get_shaft_mark(shaft, mark)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The mark
      integer(int64), intent(out) :: mark

      integer(int64), allocatable :: parts(:)
      integer :: cam

      parts = [(get_mark(shaft%followers(cam)), cam=1, size(shaft%followers))]
      parts = [parts, transfer(shaft%shaft%phases, parts), transfer(shaft%shaft%directions, parts)]
      if (allocated(shaft%shaft%bearings)) then
         associate (bearings => shaft%shaft%bearings)
            parts = [parts, transfer(bearings%law, parts), transfer([bearings%diameter, bearings%width, &
               & bearings%radial_clearance, bearings%bearing_positions, bearings%cam_positions], parts)]
         end associate
      end if
      if (allocated(shaft%shaft%touch)) parts = [parts, transfer([shaft%shaft%touch%roughness, shaft%shaft%touch%pressure, &
         & shaft%shaft%touch%boundary_coefficient], parts)]
      if (allocated(shaft%case%belt_pull)) parts = [parts, transfer([shaft%case%belt_pull%force, shaft%case%belt_pull%angle, &
         & shaft%case%belt_pull%position], parts)]
      if (allocated(shaft%shaft%drag_table)) parts = [parts, transfer([shaft%shaft%drag_table%speed_points, &
         & shaft%shaft%drag_table%temperature_points, shaft%shaft%drag_table%torque_points], parts)]
      mark = mixed(parts)
   end subroutine get_shaft_mark

   !> What the follower of a cam remembers.
   pure function cam_point(shaft, cam) result(point)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The cam
      integer, intent(in) :: cam
      !> Angle, spin, scale, temperatures
      type(point_t) :: point

      point = get_point(shaft%followers(cam))
   end function cam_point

   !> Put a shaft that has been started where another one of the same case was.
   subroutine set_shaft(shaft, angle, points, error)
      !> The shaft
      type(shaft_simulation_t), intent(inout) :: shaft
      !> Cam angle of the first cam [rad]
      real(wp), intent(in) :: angle
      !> What the other one's followers remembered
      type(point_t), intent(in) :: points(:)
      !> Deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: cam

      shaft%angle = angle
      do cam = 1, size(points)
         call set_point(shaft%followers(cam), points(cam), error)
         if (allocated(error)) return
      end do
   end subroutine set_shaft

end module camroller_shaft_simulation
