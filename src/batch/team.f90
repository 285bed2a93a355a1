!> Processes that share a sweep: who takes which cases, and what all of them know.
!>
!> In: nothing. Out: `team_t`, a team of one process; the program for MPI extends it. The only thing that processes
!> share while they compute is a counter of the cases given out.
module camroller_team
   use camroller_error, only : error_t
   implicit none
   private

   public :: team_t, agreed_code

   !> A team of one
   type :: team_t
      !> This process, from 0, and the number of processes
      integer :: rank = 0, ranks = 1
      !> Cases given out
      integer :: given = 0
   contains
      procedure :: reset => reset_alone
      procedure :: take => take_alone
      procedure :: share => share_alone
      procedure :: largest => largest_alone
   end type team_t

contains

   !> Begin to give cases out; all processes call it.
   subroutine reset_alone(self)
      class(team_t), intent(inout) :: self

      self%given = 0
   end subroutine reset_alone

   !> Take cases that no other process has.
   subroutine take_alone(self, wanted, position)
      class(team_t), intent(inout) :: self
      !> How many
      integer, intent(in) :: wanted
      !> Position of the first of them among the cases to be computed, from 1; may be beyond the last
      integer, intent(out) :: position

      position = self%given + 1
      if (self%given < huge(1) - 2*wanted) self%given = self%given + wanted
   end subroutine take_alone

   !> Give all processes what the first one has; all processes call it.
   subroutine share_alone(self, numbers)
      class(team_t), intent(inout) :: self
      !> Integers, those of the first process on return
      integer, allocatable, intent(inout) :: numbers(:)

      associate (alone => self, those_of_all => numbers)
      end associate
   end subroutine share_alone

   !> Largest number of all processes; all of them call it and wait for each other.
   subroutine largest_alone(self, number)
      class(team_t), intent(inout) :: self
      !> A number, the largest one on return
      integer, intent(inout) :: number

      associate (alone => self, largest => number)
      end associate
   end subroutine largest_alone

   !> Exit code that all processes have in common: 0 where none has an error. All of them call it.
   function agreed_code(team, error) result(code)
      !> The processes
      class(team_t), intent(inout) :: team
      !> Error of this process
      type(error_t), allocatable, intent(in) :: error
      !> The largest of their codes
      integer :: code

      code = 0
      if (allocated(error)) code = error%kind
      call team%largest(code)
   end function agreed_code

end module camroller_team
