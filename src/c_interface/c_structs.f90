!> Structs and buffers between C and Fortran: inputs of a host, what a step gives, names of quantities, saved states.
!>
!> In: structs of C, whose `size` the caller sets. Out: types of ours, and back.
module camroller_c_structs
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_null_ptr, c_ptr, &
      & c_size_t
   use, intrinsic :: iso_fortran_env, only : int8
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_remarks, only : remark_t, remark_names
   use camroller_result, only : quantity_t
   use camroller_simulation, only : outcome_t, inputs_t
   use camroller_torque_list, only : is_torque, of_bearings, of_contact, of_geometric, of_guide, of_needle, of_roller_inertia, &
      & of_shaft_drag, torque_count, torque_series
   use camroller_c_texts, only : give_text, has_place, refuse_null
   implicit none
   private

   public :: listed_torques, take_inputs, check_outcome, give_outcome, give_quantity, give_bytes, give_remark, &
      & other_torque, torque_row, refuse_size, give_address, clear_place

   !> Torques in the order of the structs
   integer, parameter :: listed_torques(*) = [of_geometric, of_contact, of_needle, of_guide, of_roller_inertia]

   !> Inputs as the header has them
   type, bind(C) :: c_inputs_t
      integer(c_size_t) :: size
      !> Cam speed [rad/s], oil temperature [K], gauge pressure [Pa]
      real(c_double) :: speed, oil_temperature, gas_pressure
      integer(c_int) :: has_pressure
      !> Is there a supply pressure?
      integer(c_int) :: has_supply
      !> Gauge pressure at the lash adjuster [Pa]
      real(c_double) :: supply_pressure
   end type c_inputs_t

   !> What a step gives, as the header has it
   type, bind(C) :: c_outcome_t
      integer(c_size_t) :: size
      !> Torques: mean over the step and at its end, all and for losses [N m]
      real(c_double) :: mean_torque_drive, torque_drive, mean_torque_friction, torque_friction
      !> By source: against spring, masses and gas; contact; roller bearing; guide; inertia of the roller [N m]
      real(c_double) :: mean_torques(5), torques(5)
      !> Force on the cam, x from pivot to cam centre [N]
      real(c_double) :: cam_force(2)
      !> Smallest and largest values: load [N], torque [N m], sliding speed [m/s]; largest pressure [Pa], smallest film [m]
      real(c_double) :: contact_load(2), extreme_torque(2), sliding_speed(2), largest_pressure, smallest_film
      !> Of the mean torque that drives [N m]
      real(c_double) :: estimated_error
      !> By all other sources together: mean over the step and at its end [N m]
      real(c_double) :: mean_torque_others, torque_others
   end type c_outcome_t

contains

   !> Give a caller an address.
   subroutine give_address(place, address)
      !> Where the caller wants it
      type(c_ptr), intent(in) :: place
      !> The address
      type(c_ptr), intent(in) :: address

      type(c_ptr), pointer :: target_of_caller

      call c_f_pointer(place, target_of_caller)
      target_of_caller = address
   end subroutine give_address

   !> Refuse NULL for the place of a new handle; any other place holds NULL until there is one.
   subroutine clear_place(place, error)
      !> The argument `out` of the header
      type(c_ptr), intent(in) :: place
      !> Usage error; left alone where there is one
      type(error_t), allocatable, intent(inout) :: error

      call refuse_null(place, "out", error)
      if (c_associated(place)) call give_address(place, c_null_ptr)
   end subroutine clear_place

   !> Torque of all sources but the listed ones and the camshaft bearings.
   pure function other_torque(torques) result(torque)
      !> Torques, the rows of `torque_list` [N m]
      real(c_double), intent(in) :: torques(torque_count)
      !> Their sum [N m]
      real(c_double) :: torque

      integer :: row

      torque = 0.0_c_double
      do row = 1, torque_count
         if (is_torque(row) .and. row /= of_bearings .and. all(listed_torques /= row)) torque = torque + torques(row)
      end do
   end function other_torque

   !> Row of `torque_list` by the name of its series, for a torque that every follower has of its own; 0: there is none.
   pure function torque_row(name) result(row)
      !> The name
      character(len=*), intent(in) :: name
      !> The row
      integer :: row

      row = findloc(torque_series == name .and. is_torque, .true., 1)
      if (any(row == [of_bearings, of_shaft_drag])) row = 0
   end function torque_row

   !> Inputs from the caller's struct.
   subroutine take_inputs(address, inputs, error)
      !> The struct
      type(c_ptr), intent(in) :: address
      !> The inputs
      type(inputs_t), intent(out) :: inputs
      !> Usage error where the struct is not one of this version
      type(error_t), allocatable, intent(out) :: error

      type(c_inputs_t), pointer :: given

      call c_f_pointer(address, given)
      if (given%size /= storage_size(given)/8) then
         call refuse_size("camroller_inputs", error)
         return
      end if
      inputs%speed = given%speed
      inputs%oil_temperature = given%oil_temperature
      inputs%has_pressure = given%has_pressure /= 0
      inputs%gas_pressure = given%gas_pressure
      inputs%has_supply = given%has_supply /= 0
      inputs%supply_pressure = given%supply_pressure
   end subroutine take_inputs

   !> Refuse a struct for the outcome that is not one of this version.
   subroutine check_outcome(address, error)
      !> The struct; NULL is fine
      type(c_ptr), intent(in) :: address
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      type(c_outcome_t), pointer :: given

      if (.not. c_associated(address)) return
      call c_f_pointer(address, given)
      if (given%size /= storage_size(given)/8) call refuse_size("camroller_outcome", error)
   end subroutine check_outcome

   !> Refuse a struct of another version.
   subroutine refuse_size(name, error)
      !> Its name in the header
      character(len=*), intent(in) :: name
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      call raise(error, kind_usage, name//": set its size to sizeof("//name//"), of the header that belongs to this library")
   end subroutine refuse_size

   !> Fill the caller's struct.
   subroutine give_outcome(outcome, address)
      !> What the step gave
      type(outcome_t), intent(in) :: outcome
      !> The struct; NULL takes nothing
      type(c_ptr), intent(in) :: address

      type(c_outcome_t), pointer :: given

      if (.not. c_associated(address)) return
      call c_f_pointer(address, given)
      given%mean_torque_drive = outcome%mean_torque_drive
      given%torque_drive = outcome%torque_drive
      given%mean_torque_friction = outcome%mean_torque_friction
      given%torque_friction = outcome%torque_friction
      given%mean_torques = outcome%mean_torques(listed_torques)
      given%torques = outcome%torques(listed_torques)
      given%cam_force = outcome%cam_force
      given%contact_load = outcome%extremes%contact_load
      given%extreme_torque = outcome%extremes%torque_drive
      given%sliding_speed = outcome%extremes%sliding_speed
      given%largest_pressure = outcome%extremes%hertz_pressure
      given%smallest_film = outcome%extremes%film_min
      given%estimated_error = outcome%estimated_error
      given%mean_torque_others = other_torque(outcome%mean_torques)
      given%torque_others = other_torque(outcome%torques)
   end subroutine give_outcome

   !> Fill a caller's buffers with name, unit and meaning of a quantity.
   subroutine give_quantity(quantity, texts, room)
      !> The quantity
      type(quantity_t), intent(in) :: quantity
      !> Buffers for name, unit and meaning; NULL, each or all, takes nothing
      type(c_ptr), intent(in), optional :: texts(3)
      !> Size of each
      integer(c_size_t), intent(in) :: room

      if (.not. present(texts)) return
      call give_text(quantity%name, texts(1), room)
      call give_text(trim(quantity%unit), texts(2), room)
      call give_text(quantity%description, texts(3), room)
   end subroutine give_quantity

   !> Fill a caller's buffers with a remark on a step, by its number.
   subroutine give_remark(remarks, number, texts, room, error)
      !> All remarks on the step
      type(remark_t), intent(in) :: remarks(:)
      !> The number, from 0
      integer(c_size_t), intent(in) :: number
      !> Buffers for the name of its kind and its words; NULL, each or both, takes nothing
      type(c_ptr), intent(in), optional :: texts(2)
      !> Size of each
      integer(c_size_t), intent(in) :: room
      !> Usage error where there is none of that number
      type(error_t), allocatable, intent(out) :: error

      if (.not. has_place(number, size(remarks))) then
         call raise(error, kind_usage, "there is no remark of that number")
      else if (present(texts)) then
         associate (remark => remarks(number + 1))
            call give_text(trim(remark_names(remark%kind)), texts(1), room)
            call give_text(remark%text, texts(2), room)
         end associate
      end if
   end subroutine give_remark

   !> Fill a caller's buffer with what is saved.
   subroutine give_bytes(bytes, address, room, asked, error)
      !> What is saved
      integer(int8), intent(in) :: bytes(:)
      !> The buffer
      type(c_ptr), intent(in) :: address
      !> Its size
      integer(c_size_t), intent(in) :: room
      !> Call that tells the size needed
      character(len=*), intent(in) :: asked
      !> Usage error where the buffer is too small
      type(error_t), allocatable, intent(out) :: error

      integer(int8), pointer :: letters(:)

      if (room < size(bytes)) then
         call raise(error, kind_usage, "the buffer is too small; ask "//asked)
      else
         call c_f_pointer(address, letters, [size(bytes)])
         letters = bytes
      end if
   end subroutine give_bytes

end module camroller_c_structs
