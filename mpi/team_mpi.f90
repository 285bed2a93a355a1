!> Processes that share a sweep by MPI.
!>
!> In: a started MPI. Out: a team whose counter of cases given out lies with the first process. Any process takes from it without
!> the first one having to answer, so that no process waits for a slow case. All other messages are exchanged before and
!> after the computation.
module camroller_team_mpi
   use mpi_f08, only : mpi_address_kind, mpi_allreduce, mpi_bcast, mpi_comm_rank, mpi_comm_size, mpi_comm_world, &
      & mpi_fetch_and_op, mpi_finalize, mpi_info_null, mpi_init_thread, mpi_integer, mpi_iprobe, mpi_any_source, mpi_any_tag, &
      & mpi_max, mpi_status_ignore, mpi_sum, mpi_thread_serialized, mpi_win, mpi_win_allocate, mpi_win_flush, &
      & mpi_win_free, mpi_win_lock_all, mpi_win_unlock_all, mpi_barrier, mpi_win_sync
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_int, c_ptr, c_sizeof
   use camroller_error, only : error_t, kind_usage, raise
   use camroller_team, only : team_t
   implicit none
   private

   public :: team_mpi_t, start_team, end_team

   !> A team of several processes
   type, extends(team_t) :: team_mpi_t
      !> The counter, in the memory of the first process
      type(mpi_win) :: window
      integer(c_int), pointer :: counter => null()
   contains
      procedure :: reset => reset_window
      procedure :: take => take_from_window
      procedure :: share => share_all
      procedure :: largest => largest_of_all
   end type team_mpi_t

contains

   !> Start MPI and the team.
   subroutine start_team(team, error)
      !> The team
      type(team_mpi_t), intent(out) :: team
      !> Usage error where MPI does not let threads call it in turn, as those of a process do; MPI has ended then
      type(error_t), allocatable, intent(out) :: error

      integer(mpi_address_kind) :: bytes
      type(c_ptr) :: address
      integer :: provided

      call mpi_init_thread(mpi_thread_serialized, provided)
      call mpi_comm_rank(mpi_comm_world, team%rank)
      call mpi_comm_size(mpi_comm_world, team%ranks)
      if (provided < mpi_thread_serialized) then
         call raise(error, kind_usage, "this MPI does not let threads call it in turn; one with MPI_THREAD_SERIALIZED is needed")
         call mpi_finalize()
         return
      end if
      bytes = c_sizeof(1_c_int)
      call mpi_win_allocate(bytes, int(bytes), mpi_info_null, mpi_comm_world, address, team%window)
      call c_f_pointer(address, team%counter)
      team%counter = 0
      call mpi_win_lock_all(0, team%window)
      call mpi_barrier(mpi_comm_world)
   end subroutine start_team

   !> End MPI.
   subroutine end_team(team)
      !> The team
      type(team_mpi_t), intent(inout) :: team

      call mpi_win_unlock_all(team%window)
      call mpi_win_free(team%window)
      call mpi_finalize()
   end subroutine end_team

   !> Set the counter back; all processes call it.
   subroutine reset_window(self)
      !> The team
      class(team_mpi_t), intent(inout) :: self

      call mpi_barrier(mpi_comm_world)
      self%given = 0
      if (self%rank == 0) self%counter = 0
      call mpi_win_sync(self%window)
      call mpi_barrier(mpi_comm_world)
   end subroutine reset_window

   !> Take cases that no other process has.
   subroutine take_from_window(self, wanted, position)
      !> The team
      class(team_mpi_t), intent(inout) :: self
      !> How many
      integer, intent(in) :: wanted
      !> Position of the first of them, from 1
      integer, intent(out) :: position

      integer, asynchronous :: before, more
      logical :: unused

      ! lets the first process answer others where the network needs it to
      call mpi_iprobe(mpi_any_source, mpi_any_tag, mpi_comm_world, unused, mpi_status_ignore)
      more = wanted
      before = 0
      call mpi_fetch_and_op(more, before, mpi_integer, 0, 0_mpi_address_kind, mpi_sum, self%window)
      call mpi_win_flush(0, self%window)
      position = before + 1
      self%given = before + wanted
   end subroutine take_from_window

   !> Give all processes what the first one has.
   subroutine share_all(self, numbers)
      !> The team
      class(team_mpi_t), intent(inout) :: self
      !> Integers, those of the first process on return
      integer, allocatable, intent(inout) :: numbers(:)

      integer :: length

      length = size(numbers)
      call mpi_bcast(length, 1, mpi_integer, 0, mpi_comm_world)
      if (self%rank /= 0) then
         if (allocated(numbers)) deallocate (numbers)
         allocate (numbers(length))
      end if
      if (length > 0) call mpi_bcast(numbers, length, mpi_integer, 0, mpi_comm_world)
   end subroutine share_all

   !> Largest number of all processes.
   subroutine largest_of_all(self, number)
      !> The team
      class(team_mpi_t), intent(inout) :: self
      !> A number, the largest one on return
      integer, intent(inout) :: number

      integer :: own

      own = number
      if (self%ranks > 1) call mpi_allreduce(own, number, 1, mpi_integer, mpi_max, mpi_comm_world)
   end subroutine largest_of_all

end module camroller_team_mpi
