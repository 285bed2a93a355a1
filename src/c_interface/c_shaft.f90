!> All followers of a case with their camshafts and bearings, driven step by step, for C: `include/camroller.h` says what each call
!> does.
!>
!> In: a case, cam angles, inputs at both ends of a step, gas pressures of the cams. Out: torques, numbers by name, blocks of bytes.
module camroller_c_shaft
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int8
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_remarks, only : remark_t
   use camroller_result, only : quantity_t
   use camroller_simulation, only : inputs_t
   use camroller_shaft_simulation, only : shaft_simulation_t, shaft_outcome_t, start_shaft, advance_shaft, halt_shaft, cam_number, &
      & shaft_angle, shaft_series
   use camroller_saved_simulation, only : save_shaft, restore_shaft, shaft_block_size
   use camroller_torque_list, only : of_bearings
   use camroller_c_case, only : case_handle_t
   use camroller_c_structs, only : clear_place, give_address, give_bytes, listed_torques, other_torque, refuse_size, &
      & take_inputs
   use camroller_c_texts, only : give_error, refuse_null
   implicit none
   private

   public :: shaft_handle_t

   !> A shaft, what its series are called, and what its last step gave
   type :: shaft_handle_t
      type(shaft_simulation_t) :: shaft
      !> Series of the camshafts and of a cam's follower
      type(quantity_t), allocatable :: of_camshaft(:), of_follower(:)
      !> What the last step gave, and room for the next one, which may fail
      type(shaft_outcome_t) :: outcomes(2)
      !> Place of the former; 0 before the first step
      integer :: last = 0
      !> Remarks on it, once they have been asked for
      type(remark_t), allocatable :: remarks(:)
   end type shaft_handle_t

   !> What a step gives, as the header has it
   type, bind(C) :: c_shaft_outcome_t
      integer(c_size_t) :: size
      !> Torques: mean over the step and at its end; all, for losses, for the bearings [N m]
      real(c_double) :: mean_torque_drive, torque_drive, mean_torque_friction, torque_friction
      real(c_double) :: mean_torque_bearings, torque_bearings
      !> Of all followers by source: against spring, masses and gas; contact; roller bearing; guide; inertia of the rollers [N m]
      real(c_double) :: mean_torques(5), torques(5)
      !> Smallest and largest torque that drives, error of the mean torque that drives [N m]
      real(c_double) :: extreme_torque(2), estimated_error
      !> Of all followers by all other sources together: mean over the step and at its end [N m]
      real(c_double) :: mean_torque_others, torque_others
   end type c_shaft_outcome_t

contains

   !> Start a shaft.
   function shaft_new(case, angle, threads, out, error) bind(C, name="camroller_shaft_new") result(code)
      !> The case; its values are copied
      type(c_ptr), value, intent(in) :: case
      !> Cam angle of the first cam, pi at full lift [rad]
      real(c_double), value, intent(in) :: angle
      !> Threads that share the followers in a step
      integer(c_int), value, intent(in) :: threads
      !> Gets the shaft, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(shaft_handle_t), pointer :: made
      type(error_t), allocatable :: failure

      call refuse_null(case, "camroller_case", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(case, given)
         allocate (made)
         call start_shaft(made%shaft, given%case, angle, failure, int(threads))
         call give_shaft(out, made, given%case, failure)
      end if
      call give_error(failure, error, code)
   end function shaft_new

   !> Give a caller a shaft with its names, or NULL where there is an error.
   subroutine give_shaft(place, made, case, error)
      !> Where the caller wants it
      type(c_ptr), intent(in) :: place
      !> The shaft; freed where there is an error
      type(shaft_handle_t), pointer, intent(inout) :: made
      type(case_t), intent(in) :: case
      !> The error, if any
      type(error_t), allocatable, intent(in) :: error

      if (allocated(error)) then
         deallocate (made)
         return
      end if
      call shaft_series(case, 1, made%of_follower)
      call shaft_series(case, 0, made%of_camshaft)
      call give_address(place, c_loc(made))
   end subroutine give_shaft

   !> Copy of a shaft.
   function shaft_copy(handle, out, error) bind(C, name="camroller_shaft_copy") result(code)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> Gets the copy, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given, made
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_shaft", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         allocate (made)
         made = given
         call give_address(out, c_loc(made))
      end if
      call give_error(failure, error, code)
   end function shaft_copy

   !> Free a shaft; NULL is nothing to free.
   subroutine shaft_free(handle) bind(C, name="camroller_shaft_free")
      !> The shaft
      type(c_ptr), value, intent(in) :: handle

      type(shaft_handle_t), pointer :: given

      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      deallocate (given)
   end subroutine shaft_free

   !> Advance a shaft to a cam angle of its first cam.
   function shaft_step(handle, angle, start, finish, pressures, outcome, error) bind(C, name="camroller_shaft_step") result(code)
      !> The shaft; left as it was where there is an error
      type(c_ptr), value, intent(in) :: handle
      !> Cam angle at the end of the step [rad]
      real(c_double), value, intent(in) :: angle
      !> Inputs at both ends
      type(c_ptr), value, intent(in) :: start, finish
      !> Gas pressures of all cams at the start, then at the end; NULL for those of the inputs or of the case
      type(c_ptr), value, intent(in) :: pressures
      !> Gets what the step gives; NULL takes nothing
      type(c_ptr), value, intent(in) :: outcome
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(c_shaft_outcome_t), pointer :: filled
      type(inputs_t) :: ends(2)
      type(error_t), allocatable :: failure
      ! The caller's pressures [Pa]
      real(c_double), pointer :: numbers(:, :)
      ! Where the outcome goes
      integer :: next

      call refuse_null(handle, "camroller_shaft", failure)
      call refuse_null(start, "start", failure)
      call refuse_null(finish, "finish", failure)
      if (.not. allocated(failure)) call take_inputs(start, ends(1), failure)
      if (.not. allocated(failure)) call take_inputs(finish, ends(2), failure)
      if (.not. allocated(failure) .and. c_associated(outcome)) then
         call c_f_pointer(outcome, filled)
         if (filled%size /= storage_size(filled)/8) call refuse_size("camroller_shaft_outcome", failure)
      end if
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         next = merge(2, 1, given%last == 1)
         if (c_associated(pressures)) then
            call c_f_pointer(pressures, numbers, [cam_number(given%shaft), 2])
            call advance_shaft(given%shaft, angle, ends(1), ends(2), given%outcomes(next), failure, numbers)
         else
            call advance_shaft(given%shaft, angle, ends(1), ends(2), given%outcomes(next), failure)
         end if
      end if
      if (.not. allocated(failure)) then
         given%last = next
         if (allocated(given%remarks)) deallocate (given%remarks)
         if (c_associated(outcome)) call fill_outcome(given%outcomes(next), filled)
      end if
      call give_error(failure, error, code)
   end function shaft_step

   !> Fill the caller's struct.
   subroutine fill_outcome(outcome, given)
      !> What the step gave
      type(shaft_outcome_t), intent(in) :: outcome
      !> The struct
      type(c_shaft_outcome_t), intent(inout) :: given

      given%mean_torque_drive = outcome%mean_torque_drive
      given%torque_drive = outcome%torque_drive
      given%mean_torque_friction = outcome%mean_torque_friction
      given%torque_friction = outcome%torque_friction
      given%mean_torque_bearings = outcome%mean_torques(of_bearings)
      given%torque_bearings = outcome%torques(of_bearings)
      given%mean_torques = outcome%mean_torques(listed_torques)
      given%torques = outcome%torques(listed_torques)
      given%extreme_torque = outcome%extreme_torque
      given%estimated_error = outcome%estimated_error
      given%mean_torque_others = other_torque(outcome%mean_torques)
      given%torque_others = other_torque(outcome%torques)
   end subroutine fill_outcome

   !> Cam angle of the first cam; 0 for NULL.
   function angle_of_shaft(handle) bind(C, name="camroller_shaft_angle") result(angle)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> Its cam angle [rad]
      real(c_double) :: angle

      type(shaft_handle_t), pointer :: given

      angle = 0.0_c_double
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      angle = shaft_angle(given%shaft)
   end function angle_of_shaft

   !> Bring all rollers to rest.
   function shaft_halt(handle, error) bind(C, name="camroller_shaft_halt") result(code)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_shaft", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call halt_shaft(given%shaft)
      end if
      call give_error(failure, error, code)
   end function shaft_halt

   !> Bytes that a saved shaft takes; 0 for NULL.
   function shaft_save_size(handle) bind(C, name="camroller_shaft_save_size") result(bytes)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> The number
      integer(c_size_t) :: bytes

      type(shaft_handle_t), pointer :: given

      bytes = 0
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      bytes = shaft_block_size(given%shaft)
   end function shaft_save_size

   !> Save a shaft.
   function shaft_save(handle, buffer, room, error) bind(C, name="camroller_shaft_save") result(code)
      !> The shaft, the buffer
      type(c_ptr), value, intent(in) :: handle, buffer
      !> Size of the buffer
      integer(c_size_t), value, intent(in) :: room
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      integer(int8), allocatable :: bytes(:)

      call refuse_null(handle, "camroller_shaft", failure)
      call refuse_null(buffer, "buffer", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call save_shaft(given%shaft, bytes, failure)
      end if
      if (.not. allocated(failure)) call give_bytes(bytes, buffer, room, "camroller_shaft_save_size", failure)
      call give_error(failure, error, code)
   end function shaft_save

   !> Make a shaft of what was saved.
   function shaft_restore(case, buffer, room, threads, out, error) bind(C, name="camroller_shaft_restore") result(code)
      !> The case that the saved shaft had, the buffer
      type(c_ptr), value, intent(in) :: case, buffer
      !> Bytes in it
      integer(c_size_t), value, intent(in) :: room
      !> Threads that share the followers in a step
      integer(c_int), value, intent(in) :: threads
      !> Gets the shaft, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(shaft_handle_t), pointer :: made
      type(error_t), allocatable :: failure
      integer(int8), pointer :: letters(:)

      call refuse_null(case, "camroller_case", failure)
      call refuse_null(buffer, "buffer", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(case, given)
         call c_f_pointer(buffer, letters, [room])
         allocate (made)
         call restore_shaft(made%shaft, given%case, letters, failure, int(threads))
         call give_shaft(out, made, given%case, failure)
      end if
      call give_error(failure, error, code)
   end function shaft_restore

end module camroller_c_shaft
