!> A follower between two steps as a block of bytes, and back: the same steps give the same bits, in another process as well.
!>
!> In: a follower. Out: a block with the number of its format, a mark of the case, and what the follower remembers.
module camroller_saved_simulation
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_case, only : case_t
   use camroller_follower_step, only : point_t
   use camroller_model, only : model_t
   use camroller_run, only : build_model
   use camroller_simulation, only : simulation_t, start_simulation, get_point, set_point, get_lobe, is_started
   use camroller_state, only : state_t, evaluate_state
   implicit none
   private

   public :: save_simulation, restore_simulation, block_size

   !> Words of a block: mark, format, mark of the case, lobe shape, six numbers of the point, checksum
   integer, parameter :: words = 11
   !> Bytes of a block
   integer, parameter :: block_size = 8*words
   !> What a block begins with, and the format that this version writes and reads
   integer(int64), parameter :: beginning = 7237970109966541155_int64, format_number = 1_int64
   !> Cam angles at which states make up the mark of a case
   integer, parameter :: places = 36

contains

   !> Make a block of a follower.
   subroutine save_simulation(simulation, case, bytes, error)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The case that it was started with
      type(case_t), intent(in) :: case
      !> The block
      integer(int8), allocatable, intent(out) :: bytes(:)
      !> Usage error where the follower has no start
      type(error_t), allocatable, intent(out) :: error

      type(point_t) :: point
      integer(int64) :: block(words)

      if (.not. is_started(simulation)) then
         call raise(error, kind_usage, "save_simulation: the follower has no start; call start_simulation first")
         return
      end if
      point = get_point(simulation)
      block(1:2) = [beginning, format_number]
      call mark_case(case, get_lobe(simulation), block(3), error)
      if (allocated(error)) return
      block(4) = get_lobe(simulation)
      block(5:10) = transfer([point%angle, point%roller_spin, point%scale, point%film_temperature, point%film_speed, &
         & point%oil_temperature], block)
      block(words) = mixed(block(:words - 1))
      bytes = transfer(block, bytes)
   end subroutine save_simulation

   !> Make a follower of a block.
   subroutine restore_simulation(simulation, case, bytes, error)
      !> The follower; not to be advanced where there is an error
      type(simulation_t), intent(out) :: simulation
      !> The case that the block's follower was started with
      type(case_t), intent(in) :: case
      !> The block
      integer(int8), intent(in) :: bytes(:)
      !> Usage error for a block that is none, is of another format or belongs to another case
      type(error_t), allocatable, intent(out) :: error

      type(point_t) :: point
      integer(int64) :: block(words), mark
      ! The six numbers of the point [rad, rad/s, m/s, K, rad/s, K]
      real(wp) :: numbers(6)

      if (size(bytes) /= block_size) then
         call raise(error, kind_usage, "restore_simulation: the block has the wrong size; give all of it, as it was saved")
         return
      end if
      block = transfer(bytes, block)
      if (block(1) /= beginning) then
         call raise(error, kind_usage, "restore_simulation: the block is not one that save_simulation made on "// &
            & "a machine of this kind")
      else if (block(2) /= format_number) then
         call raise(error, kind_usage, "restore_simulation: the block is of another format; this version reads format 1")
      else if (block(words) /= mixed(block(:words - 1))) then
         call raise(error, kind_usage, "restore_simulation: the block is damaged")
      end if
      if (allocated(error)) return
      call mark_case(case, int(block(4)), mark, error)
      if (allocated(error)) return
      if (mark /= block(3)) then
         call raise(error, kind_usage, "restore_simulation: the block belongs to another case, or to another version of "// &
            & "the program")
         return
      end if
      numbers = transfer(block(5:10), numbers)
      call start_simulation(simulation, case, numbers(1), error, int(block(4)))
      if (allocated(error)) return
      point%angle = numbers(1)
      point%roller_spin = numbers(2)
      point%scale = numbers(3)
      point%film_temperature = numbers(4)
      point%film_speed = numbers(5)
      point%oil_temperature = numbers(6)
      call set_point(simulation, point, error)
   end subroutine restore_simulation

   !> Mark of a case and one of its lobe shapes: states over the turn, and how it is integrated. What no state follows is not in it.
   subroutine mark_case(case, lobe, mark, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its lobe shape
      integer, intent(in) :: lobe
      !> The mark
      integer(int64), intent(out) :: mark
      !> Usage, deck or domain error of the case
      type(error_t), allocatable, intent(out) :: error

      type(model_t) :: model
      type(state_t) :: state
      ! Cam angle from full lift [rad]; sliding speed [m/s]
      real(wp) :: angle, sliding_speed
      integer(int64) :: parts(5*places)
      integer :: i, status

      mark = 0_int64
      if (lobe < 1 .or. lobe > 2 .or. (lobe == 2 .and. .not. allocated(case%second_lift))) then
         call raise(error, kind_usage, "the case has no such lobe shape")
         return
      end if
      call build_model(case, lobe, model, error)
      if (allocated(error)) return
      parts = 0_int64
      do i = 1, places
         angle = -pi + (i - 0.37_wp)*two_pi/places
         sliding_speed = 0.02_wp*modulo(i, 3)*model%speed*model%roller_radius
         call evaluate_state(model, angle, sliding_speed, state, status)
         if (status /= 0) cycle
         parts(5*i - 4:5*i) = transfer([state%contact%load, state%contact%traction, state%spin_acceleration, &
            & state%torque_friction, state%torque_drive], parts)
      end do
      mark = mixed([parts, transfer([case%numerics%accuracy, case%numerics%tolerance], parts), &
         & transfer(case%numerics%method, parts)])
   end subroutine mark_case

   !> A number that changes with every bit of others and with their order.
   pure function mixed(list) result(mix)
      !> The others
      integer(int64), intent(in) :: list(:)
      !> The number
      integer(int64) :: mix

      integer :: i, turn

      mix = beginning
      do i = 1, size(list)
         mix = ieor(ishftc(mix, 9), list(i))
         do turn = 1, 3
            mix = ieor(mix, ieor(ishftc(mix, 23), ishftc(mix, 47)))
            mix = ieor(mix, iand(ishftc(mix, 7), not(ishftc(mix, 1))))
         end do
      end do
   end function mixed

end module camroller_saved_simulation
