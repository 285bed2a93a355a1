!> A follower driven step by step, for C: `include/camroller.h` says what each call does.
!>
!> In: a case, cam angles, inputs at both ends of a step. Out: torques, numbers by name, blocks of bytes.
module camroller_c_simulation
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int8
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_case, only : case_t
   use camroller_catalogue, only : follower_count, list_series
   use camroller_remarks, only : remark_t
   use camroller_result, only : quantity_t, find_quantity
   use camroller_simulation, only : simulation_t, outcome_t, inputs_t, start_simulation, advance, halt, get_values, &
      & list_step_remarks, angle_of => simulation_angle
   use camroller_saved_simulation, only : save_simulation, restore_simulation, block_size
   use camroller_c_case, only : case_handle_t
   use camroller_c_structs, only : clear_place, take_inputs, check_outcome, give_outcome, give_address, give_bytes, give_remark, &
      & torque_row
   use camroller_c_texts, only : take_text, give_error, refuse_null
   implicit none
   private

   !> A follower with its case and what its last step gave
   type :: simulation_handle_t
      type(simulation_t) :: simulation
      type(case_t) :: case
      type(outcome_t) :: outcome
      !> Has it made a step?
      logical :: has_outcome = .false.
      !> Remarks on the last step, once they have been asked for
      type(remark_t), allocatable :: remarks(:)
   end type simulation_handle_t

contains

   !> Start a follower.
   function simulation_new(case, lobe, angle, out, error) bind(C, name="camroller_simulation_new") result(code)
      !> The case; its values are copied
      type(c_ptr), value, intent(in) :: case
      !> Lobe shape, 1 or 2
      integer(c_int), value, intent(in) :: lobe
      !> Cam angle, pi at full lift [rad]
      real(c_double), value, intent(in) :: angle
      !> Gets the follower, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(simulation_handle_t), pointer :: made
      type(error_t), allocatable :: failure

      call refuse_null(case, "camroller_case", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(case, given)
         allocate (made)
         made%case = given%case
         call start_simulation(made%simulation, made%case, angle, failure, int(lobe))
         call give_simulation(out, made, failure)
      end if
      call give_error(failure, error, code)
   end function simulation_new

   !> Give a caller a follower, or NULL where there is an error.
   subroutine give_simulation(place, made, error)
      !> Where the caller wants it
      type(c_ptr), intent(in) :: place
      !> The follower; freed where there is an error
      type(simulation_handle_t), pointer, intent(inout) :: made
      !> The error, if any
      type(error_t), allocatable, intent(in) :: error

      if (allocated(error)) then
         deallocate (made)
      else
         call give_address(place, c_loc(made))
      end if
   end subroutine give_simulation

   !> Copy of a follower.
   function simulation_copy(handle, out, error) bind(C, name="camroller_simulation_copy") result(code)
      !> The follower
      type(c_ptr), value, intent(in) :: handle
      !> Gets the copy, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(simulation_handle_t), pointer :: given, made
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_simulation", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         allocate (made)
         made = given
         call give_simulation(out, made, failure)
      end if
      call give_error(failure, error, code)
   end function simulation_copy

   !> Free a follower; NULL is nothing to free.
   subroutine simulation_free(handle) bind(C, name="camroller_simulation_free")
      !> The follower
      type(c_ptr), value, intent(in) :: handle

      type(simulation_handle_t), pointer :: given

      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      deallocate (given)
   end subroutine simulation_free

   !> Advance a follower to a cam angle.
   function simulation_step(handle, angle, start, finish, outcome, error) bind(C, name="camroller_simulation_step") result(code)
      !> The follower; left as it was where there is an error
      type(c_ptr), value, intent(in) :: handle
      !> Cam angle at the end of the step [rad]
      real(c_double), value, intent(in) :: angle
      !> Inputs at both ends
      type(c_ptr), value, intent(in) :: start, finish
      !> Gets what the step gives; NULL takes nothing
      type(c_ptr), value, intent(in) :: outcome
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(simulation_handle_t), pointer :: given
      type(outcome_t) :: made
      type(inputs_t) :: ends(2)
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_simulation", failure)
      call refuse_null(start, "start", failure)
      call refuse_null(finish, "finish", failure)
      if (.not. allocated(failure)) call take_inputs(start, ends(1), failure)
      if (.not. allocated(failure)) call take_inputs(finish, ends(2), failure)
      if (.not. allocated(failure)) call check_outcome(outcome, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call advance(given%simulation, angle, ends(1), ends(2), made, failure)
         if (.not. allocated(failure)) then
            given%outcome = made
            given%has_outcome = .true.
            if (allocated(given%remarks)) deallocate (given%remarks)
            call give_outcome(made, outcome)
         end if
      end if
      call give_error(failure, error, code)
   end function simulation_step

   !> Number of the follower at the end of its last step, by the name of a series of its own, or of one of its torques by source.
   function simulation_value(handle, name, value, error) bind(C, name="camroller_simulation_value") result(code)
      !> The follower, the name
      type(c_ptr), value, intent(in) :: handle, name
      !> Gets the number
      type(c_ptr), value, intent(in) :: value
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(simulation_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      type(quantity_t), allocatable :: series(:)
      character(len=:), allocatable :: word
      ! The caller's number, all numbers of the follower [unit of the series]
      real(c_double), pointer :: number
      real(wp), allocatable :: values(:)
      integer :: position, row

      call refuse_null(handle, "camroller_simulation", failure)
      call refuse_null(name, "name", failure)
      call refuse_null(value, "value", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call take_text(name, word)
         call list_series(given%case, series)
         position = find_quantity(series, word)
         allocate (values(follower_count(given%case)))
         row = 0
         if (position > size(values)) row = torque_row(word)
         if (position < 1 .or. (position > size(values) .and. row == 0)) then
            call raise(failure, kind_usage, "a follower has no number '"//word//"'; it has the series of a result that belong "// &
               & "to one follower, and its torques by source")
         else if (.not. given%has_outcome) then
            call raise(failure, kind_usage, "the follower has made no step since it was started or restored")
         else
            call get_values(given%simulation, given%case, given%outcome%state, values)
            call c_f_pointer(value, number)
            if (row > 0) then
               number = given%outcome%torques(row)
            else
               number = values(position)
            end if
         end if
      end if
      call give_error(failure, error, code)
   end function simulation_value

   !> Remark on the last step, by its number.
   function simulation_remark(handle, number, texts, room, error) bind(C, name="camroller_simulation_remark") result(code)
      !> The follower
      type(c_ptr), value, intent(in) :: handle
      !> The number, from 0
      integer(c_size_t), value, intent(in) :: number
      !> Buffers for the name of its kind and its words; NULL, each or both, takes nothing
      type(c_ptr), intent(in), optional :: texts(2)
      !> Size of each
      integer(c_size_t), value, intent(in) :: room
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(simulation_handle_t), pointer :: given
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_simulation", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         if (.not. allocated(given%remarks)) call list_step_remarks(given%simulation, given%case, given%outcome, given%remarks)
         call give_remark(given%remarks, number, texts, room, failure)
      end if
      call give_error(failure, error, code)
   end function simulation_remark

   !> Cam angle of a follower; 0 for NULL.
   function simulation_angle(handle) bind(C, name="camroller_simulation_angle") result(angle)
      !> The follower
      type(c_ptr), value, intent(in) :: handle
      !> Its cam angle [rad]
      real(c_double) :: angle

      type(simulation_handle_t), pointer :: given

      angle = 0.0_c_double
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      angle = angle_of(given%simulation)
   end function simulation_angle

   !> Bring the roller to rest.
   function simulation_halt(handle, error) bind(C, name="camroller_simulation_halt") result(code)
      !> The follower
      type(c_ptr), value, intent(in) :: handle
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(simulation_handle_t), pointer :: given
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_simulation", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call halt(given%simulation)
      end if
      call give_error(failure, error, code)
   end function simulation_halt

   !> Bytes that a saved follower takes.
   function simulation_save_size() bind(C, name="camroller_simulation_save_size") result(bytes)
      !> The number
      integer(c_size_t) :: bytes

      bytes = block_size
   end function simulation_save_size

   !> Save a follower.
   function simulation_save(handle, buffer, room, error) bind(C, name="camroller_simulation_save") result(code)
      !> The follower, the buffer
      type(c_ptr), value, intent(in) :: handle, buffer
      !> Size of the buffer
      integer(c_size_t), value, intent(in) :: room
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(simulation_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      integer(int8), allocatable :: bytes(:)

      call refuse_null(handle, "camroller_simulation", failure)
      call refuse_null(buffer, "buffer", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call save_simulation(given%simulation, bytes, failure)
      end if
      if (.not. allocated(failure)) call give_bytes(bytes, buffer, room, "camroller_simulation_save_size", failure)
      call give_error(failure, error, code)
   end function simulation_save

   !> Make a follower of what was saved.
   function simulation_restore(case, buffer, room, out, error) bind(C, name="camroller_simulation_restore") result(code)
      !> The case that the saved follower had, the buffer
      type(c_ptr), value, intent(in) :: case, buffer
      !> Bytes in it
      integer(c_size_t), value, intent(in) :: room
      !> Gets the follower, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(simulation_handle_t), pointer :: made
      type(error_t), allocatable :: failure
      integer(int8), pointer :: letters(:)

      call refuse_null(case, "camroller_case", failure)
      call refuse_null(buffer, "buffer", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(case, given)
         call c_f_pointer(buffer, letters, [room])
         allocate (made)
         made%case = given%case
         call restore_simulation(made%simulation, made%case, letters, failure)
         call give_simulation(out, made, failure)
      end if
      call give_error(failure, error, code)
   end function simulation_restore

end module camroller_c_simulation
