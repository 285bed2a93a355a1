!> What a shaft has to say of its cams and of its last step, for C: `include/camroller.h` says what each call does.
!>
!> In: a shaft, a cam, names or places of numbers. Out: numbers, names, units, meanings, remarks.
module camroller_c_shaft_values
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_number_text, only : integer_text
   use camroller_result, only : quantity_t, find_quantity
   use camroller_shaft_simulation, only : cam_number, cam_place, list_shaft_remarks, shaft_values
   use camroller_c_shaft, only : shaft_handle_t
   use camroller_c_structs, only : check_outcome, give_outcome, give_quantity, give_remark, refuse_size, torque_row
   use camroller_c_texts, only : take_text, give_error, refuse_null, has_place
   implicit none
   private

   !> A cam, as the header has it
   type, bind(C) :: c_cam_t
      integer(c_size_t) :: size
      !> Lobe shape and camshaft, from 1
      integer(c_int) :: lobe, camshaft
      !> Angle by which its event follows the first cam's [rad]
      real(c_double) :: phase
   end type c_cam_t

contains

   !> Number of cams; 0 for NULL.
   function shaft_cams(handle) bind(C, name="camroller_shaft_cams") result(cams)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> The number
      integer(c_int) :: cams

      type(shaft_handle_t), pointer :: given

      cams = 0
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      cams = int(cam_number(given%shaft), c_int)
   end function shaft_cams

   !> Where a cam stands.
   function shaft_cam(handle, cam, facts, error) bind(C, name="camroller_shaft_cam") result(code)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> The cam, from 1
      integer(c_int), value, intent(in) :: cam
      !> Struct to fill
      type(c_ptr), value, intent(in) :: facts
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(c_cam_t), pointer :: filled
      type(error_t), allocatable :: failure
      integer :: lobe, camshaft
      ! Phase of the cam [rad]
      real(wp) :: phase

      call refuse_null(handle, "camroller_shaft", failure)
      call refuse_null(facts, "facts", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call c_f_pointer(facts, filled)
         call check_cam(given, int(cam), 1, failure)
         if (.not. allocated(failure) .and. filled%size /= storage_size(filled)/8) call refuse_size("camroller_cam", failure)
      end if
      if (.not. allocated(failure)) then
         call cam_place(given%shaft, int(cam), lobe, camshaft, phase)
         filled%lobe = int(lobe, c_int)
         filled%camshaft = int(camshaft, c_int)
         filled%phase = phase
      end if
      call give_error(failure, error, code)
   end function shaft_cam

   !> What the last step gave for the follower of a cam.
   function shaft_follower(handle, cam, outcome, error) bind(C, name="camroller_shaft_follower") result(code)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> The cam, from 1
      integer(c_int), value, intent(in) :: cam
      !> Struct to fill
      type(c_ptr), value, intent(in) :: outcome
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_shaft", failure)
      call refuse_null(outcome, "outcome", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call check_cam(given, int(cam), 1, failure)
         if (.not. allocated(failure)) call check_stepped(given, failure)
         if (.not. allocated(failure)) call check_outcome(outcome, failure)
         if (.not. allocated(failure)) call give_outcome(given%outcomes(given%last)%followers(cam), outcome)
      end if
      call give_error(failure, error, code)
   end function shaft_follower

   !> Numbers at the end of the last step, in the order of their names.
   function values_of_shaft(handle, cam, values, room, error) bind(C, name="camroller_shaft_values") result(code)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> The cam, from 1; 0 for the camshafts
      integer(c_int), value, intent(in) :: cam
      !> Gets the numbers
      type(c_ptr), value, intent(in) :: values
      !> Numbers that there is room for
      integer(c_size_t), value, intent(in) :: room
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      ! The caller's numbers, ours [unit of the series]
      real(c_double), pointer :: numbers(:)
      real(wp), allocatable :: found(:)

      call refuse_null(handle, "camroller_shaft", failure)
      call refuse_null(values, "values", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call check_cam(given, int(cam), 0, failure)
         if (.not. allocated(failure)) call check_stepped(given, failure)
      end if
      if (.not. allocated(failure)) then
         call shaft_values(given%shaft, int(cam), given%outcomes(given%last), found)
         if (room < size(found)) then
            call raise(failure, kind_usage, "there is room for fewer numbers than the "//integer_text(size(found))//" there are")
         else
            call c_f_pointer(values, numbers, [size(found)])
            numbers = found
         end if
      end if
      call give_error(failure, error, code)
   end function values_of_shaft

   !> Number at the end of the last step, by the name of a series, or of one of a follower's torques by source.
   function shaft_value(handle, cam, name, value, error) bind(C, name="camroller_shaft_value") result(code)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> The cam, from 1; 0 for the camshafts
      integer(c_int), value, intent(in) :: cam
      type(c_ptr), value, intent(in) :: name
      !> Gets the number
      type(c_ptr), value, intent(in) :: value
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: word
      ! The caller's number, all numbers of the cam [unit of the series]
      real(c_double), pointer :: number
      real(wp), allocatable :: found(:)
      integer :: position, row

      call refuse_null(handle, "camroller_shaft", failure)
      call refuse_null(name, "name", failure)
      call refuse_null(value, "value", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call check_cam(given, int(cam), 0, failure)
      end if
      if (.not. allocated(failure)) then
         call take_text(name, word)
         row = 0
         position = find_quantity(given%of_camshaft, word)
         if (cam > 0) then
            if (position > 0) row = torque_row(word)
            position = find_quantity(given%of_follower, word)
         end if
         if (position == 0 .and. row == 0) then
            call raise(failure, kind_usage, "there is no number '"//word//"'; camroller_shaft_quantity lists those of "// &
               & "a follower and of the camshafts")
         else
            call check_stepped(given, failure)
         end if
      end if
      if (.not. allocated(failure)) then
         call c_f_pointer(value, number)
         if (row > 0) then
            number = given%outcomes(given%last)%followers(cam)%torques(row)
         else
            call shaft_values(given%shaft, int(cam), given%outcomes(given%last), found)
            number = found(position)
         end if
      end if
      call give_error(failure, error, code)
   end function shaft_value

   !> Name, unit and meaning of a number of a follower or of the camshafts, by its place, from 0.
   function shaft_quantity(handle, cam, number, texts, rooms, error) bind(C, name="camroller_shaft_quantity") result(code)
      !> The shaft
      type(c_ptr), value, intent(in) :: handle
      !> The cam, from 1; 0 for the camshafts
      integer(c_int), value, intent(in) :: cam
      !> Its place
      integer(c_size_t), value, intent(in) :: number
      !> Buffers for name, unit and meaning; NULL, each or all, takes nothing
      type(c_ptr), intent(in), optional :: texts(3)
      !> Size of each
      integer(c_size_t), value, intent(in) :: rooms
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(shaft_handle_t), pointer :: given
      type(quantity_t) :: quantity
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_shaft", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call check_cam(given, int(cam), 0, failure)
      end if
      if (.not. allocated(failure)) then
         if (.not. has_place(number, merge(size(given%of_follower), size(given%of_camshaft), cam > 0))) then
            call raise(failure, kind_usage, "there is no quantity of that number")
         else if (cam > 0) then
            quantity = given%of_follower(number + 1)
         else
            quantity = given%of_camshaft(number + 1)
         end if
      end if
      if (.not. allocated(failure)) call give_quantity(quantity, texts, rooms)
      call give_error(failure, error, code)
   end function shaft_quantity

   !> Remark on the last step, by its number.
   function shaft_remark(handle, number, texts, room, error) bind(C, name="camroller_shaft_remark") result(code)
      !> The shaft
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

      type(shaft_handle_t), pointer :: given
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_shaft", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         if (.not. allocated(given%remarks)) call list_shaft_remarks(given%shaft, given%outcomes(max(1, given%last)), given%remarks)
         call give_remark(given%remarks, number, texts, room, failure)
      end if
      call give_error(failure, error, code)
   end function shaft_remark

   !> Refuse a cam that the shaft has not.
   subroutine check_cam(given, cam, smallest, error)
      type(shaft_handle_t), intent(in) :: given
      !> The cam, and the smallest number that is allowed
      integer, intent(in) :: cam, smallest
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (cam < smallest .or. cam > cam_number(given%shaft)) call raise(error, kind_usage, "there is no cam "//integer_text(cam)// &
         & "; the shaft has "//integer_text(cam_number(given%shaft)))
   end subroutine check_cam

   !> Refuse a shaft that has no step behind it.
   subroutine check_stepped(given, error)
      type(shaft_handle_t), intent(in) :: given
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (given%last == 0) call raise(error, kind_usage, "the shaft has made no step since it was started or restored")
   end subroutine check_stepped

end module camroller_c_shaft_values
