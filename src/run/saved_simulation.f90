!> A follower, or all of a case, between two steps as a block of bytes, and back: the same steps give the same bits, in another
!> process as well.
!>
!> In: a follower or a shaft. Out: a block with the number of its format, a mark of the case, and what the followers remember.
module camroller_saved_simulation
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_case, only : case_t
   use camroller_flexible_train, only : largest_state
   use camroller_number_text, only : integer_text
   use camroller_follower_step, only : point_t
   use camroller_model_mark, only : beginning, mixed
   use camroller_shaft_simulation, only : shaft_simulation_t, prepare_shaft, cam_number, cam_point, get_shaft_mark, set_shaft, &
      & shaft_angle
   use camroller_simulation, only : simulation_t, prepare_simulation, get_point, set_point, get_lobe, get_mark, is_started
   implicit none
   private

   public :: save_simulation, restore_simulation, block_size, save_shaft, restore_shaft, shaft_block_size

   !> Numbers of a point
   integer, parameter :: point_words = 11 + largest_state
   !> Words of a follower's block: beginning, format, mark of the case, lobe shape, point, checksum
   integer, parameter :: words = point_words + 5
   !> Words of a shaft's block without points: beginning, format, mark of the case, number of cams, cam angle, checksum
   integer, parameter :: shaft_words = 6
   !> Bytes of a follower's block
   integer, parameter :: block_size = 8*words
   !> Added to what a block begins with where it is that of a shaft
   integer(int64), parameter :: of_shaft = 1_int64
   !> The format that this version writes and reads
   integer(int64), parameter :: format_number = 5_int64

contains

   !> Make a block of a follower.
   subroutine save_simulation(simulation, bytes, error)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The block
      integer(int8), allocatable, intent(out) :: bytes(:)
      !> Usage error where the follower has no start
      type(error_t), allocatable, intent(out) :: error

      integer(int64) :: block(words)

      if (.not. is_started(simulation)) then
         call raise(error, kind_usage, "save_simulation: the follower has not been started; call start_simulation first")
         return
      end if
      block(1:2) = [beginning, format_number]
      block(3) = get_mark(simulation)
      block(4) = get_lobe(simulation)
      block(5:4 + point_words) = words_of(get_point(simulation))
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

      type(simulation_t) :: prepared
      integer(int64), allocatable :: block(:)

      call take_block(bytes, "restore_simulation", words, 0_int64, block, error)
      if (allocated(error)) return
      call prepare_simulation("restore_simulation", prepared, case, int(block(4)), error)
      if (.not. allocated(error)) call compare_marks("restore_simulation", get_mark(prepared), block(3), error)
      if (.not. allocated(error)) call set_point(prepared, point_of(block(5:4 + point_words)), error)
      if (.not. allocated(error)) simulation = prepared
   end subroutine restore_simulation

   !> Bytes of the block of a shaft.
   pure function shaft_block_size(shaft) result(bytes)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The number
      integer :: bytes

      bytes = 8*(shaft_words + point_words*cam_number(shaft))
   end function shaft_block_size

   !> Make a block of a shaft.
   subroutine save_shaft(shaft, bytes, error)
      !> The shaft
      type(shaft_simulation_t), intent(in) :: shaft
      !> The block
      integer(int8), allocatable, intent(out) :: bytes(:)
      !> Usage error where the shaft has no start
      type(error_t), allocatable, intent(out) :: error

      integer(int64), allocatable :: block(:)
      integer :: cam, last

      if (cam_number(shaft) == 0) then
         call raise(error, kind_usage, "save_shaft: the shaft has not been started; call start_shaft first")
         return
      end if
      last = shaft_block_size(shaft)/8
      allocate (block(last))
      block(1:2) = [beginning + of_shaft, format_number]
      call get_shaft_mark(shaft, block(3))
      block(4) = cam_number(shaft)
      block(5) = transfer(shaft_angle(shaft), block(5))
      do cam = 1, cam_number(shaft)
         block(point_place(cam):point_place(cam + 1) - 1) = words_of(cam_point(shaft, cam))
      end do
      block(last) = mixed(block(:last - 1))
      bytes = transfer(block, bytes)
   end subroutine save_shaft

   !> Make a shaft of a block.
   subroutine restore_shaft(shaft, case, bytes, error, threads)
      !> The shaft; not to be advanced where there is an error
      type(shaft_simulation_t), intent(out) :: shaft
      !> The case that the block's shaft was started with
      type(case_t), intent(in) :: case
      !> The block
      integer(int8), intent(in) :: bytes(:)
      !> Usage error for a block that is none, is of another format or belongs to another case
      type(error_t), allocatable, intent(out) :: error
      !> Threads that share the followers in a step, 1 without it
      integer, intent(in), optional :: threads

      integer(int64), allocatable :: block(:)
      type(point_t), allocatable :: points(:)
      integer(int64) :: mark
      integer :: cam

      call take_block(bytes, "restore_shaft", max(size(bytes)/8, shaft_words), of_shaft, block, error)
      if (allocated(error)) return
      call prepare_shaft("restore_shaft", shaft, case, error, threads)
      if (allocated(error)) return
      call get_shaft_mark(shaft, mark)
      call compare_marks("restore_shaft", mark, block(3), error)
      if (allocated(error)) return
      if (block(4) /= cam_number(shaft) .or. size(bytes) /= shaft_block_size(shaft)) then
         call raise(error, kind_usage, "restore_shaft: the block is of another number of cams")
         return
      end if
      allocate (points(cam_number(shaft)))
      do cam = 1, size(points)
         points(cam) = point_of(block(point_place(cam):point_place(cam + 1) - 1))
      end do
      call set_shaft(shaft, transfer(block(5), 1.0_wp), points, error)
   end subroutine restore_shaft

   !> Place of a cam's point in the block of a shaft.
   pure function point_place(cam) result(place)
      integer, intent(in) :: cam
      !> Place of its first word
      integer :: place

      place = shaft_words + point_words*(cam - 1)
   end function point_place

   !> Words of a block, which is refused where it is none.
   subroutine take_block(bytes, caller, count, kind, block, error)
      !> The block
      integer(int8), intent(in) :: bytes(:)
      !> Who asks
      character(len=*), intent(in) :: caller
      !> Number of words
      integer, intent(in) :: count
      !> Added to what a block begins with
      integer(int64), intent(in) :: kind
      !> The words
      integer(int64), allocatable, intent(out) :: block(:)
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (size(bytes) /= 8*count) then
         call raise(error, kind_usage, caller//": the block has the wrong size; give all of it, as it was saved")
         return
      end if
      block = transfer(bytes, block)
      if (block(1) /= beginning + kind) then
         call raise(error, kind_usage, caller//": the block is not one that was saved for this on a machine of this kind")
      else if (block(2) /= format_number) then
         call raise(error, kind_usage, caller//": the block is of another format; this version reads format "// &
            & integer_text(int(format_number)))
      else if (block(count) /= mixed(block(:count - 1))) then
         call raise(error, kind_usage, caller//": the block is damaged")
      end if
   end subroutine take_block

   !> Refuse a block of another case.
   subroutine compare_marks(caller, present_mark, saved_mark, error)
      !> Who asks
      character(len=*), intent(in) :: caller
      !> Marks of the case and of the block
      integer(int64), intent(in) :: present_mark, saved_mark
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (present_mark /= saved_mark) call raise(error, kind_usage, caller//": the block belongs to another case, or to "// &
         & "another version of the program")
   end subroutine compare_marks

   !> What a follower remembers, as words.
   pure function words_of(point) result(block)
      type(point_t), intent(in) :: point
      !> The words
      integer(int64) :: block(point_words)

      block = transfer([point%angle, point%roller_spin, point%scale, point%film_temperature, point%film_speed, &
         & point%oil_temperature, point%contact, point%train_step, point%sliding_speed, point%train], block)
   end function words_of

   !> What a follower remembers, from words.
   pure function point_of(block) result(point)
      !> The words
      integer(int64), intent(in) :: block(point_words)
      !> The point
      type(point_t) :: point

      ! Its numbers [rad, rad/s, m/s, K, rad/s, K, N, N m, -, rad, m/s, state]
      real(wp) :: numbers(point_words)

      numbers = transfer(block, numbers)
      point%angle = numbers(1)
      point%roller_spin = numbers(2)
      point%scale = numbers(3)
      point%film_temperature = numbers(4)
      point%film_speed = numbers(5)
      point%oil_temperature = numbers(6)
      point%contact = numbers(7:9)
      point%train_step = numbers(10)
      point%sliding_speed = numbers(11)
      point%train = numbers(12:)
   end function point_of

end module camroller_saved_simulation
