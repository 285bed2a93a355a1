!> Errors as values: kind and message.
!>
!> A procedure that can fail has `type(error_t), allocatable, intent(out) :: error` as its last argument; not allocated means
!> success. The caller tests `allocated(error)` directly after the call and returns; it may add context with `add_context`. The
!> kind is also the exit code of the program.
module camroller_error
   implicit none
   private

   public :: error_t, raise, add_context
   public :: cause_unknown, cause_several_balances
   public :: kind_usage, kind_deck, kind_domain, kind_convergence, kind_file, kind_difference, kind_unfinished, &
      & kind_memory, kind_internal

   !> Wrong words on the command line
   integer, parameter :: kind_usage = 2
   !> A mistake in a deck or in a table that a deck names
   integer, parameter :: kind_deck = 3
   !> Valid numbers that describe something impossible, or a law used outside its range where that is forbidden
   integer, parameter :: kind_domain = 4
   !> An iteration or an integration that did not reach its tolerance
   integer, parameter :: kind_convergence = 5
   !> A file that cannot be read or written
   integer, parameter :: kind_file = 6
   !> A run that was repeated and came out differently
   integer, parameter :: kind_difference = 7
   !> A run that was stopped and can be continued
   integer, parameter :: kind_unfinished = 8
   !> Less memory than a computation needs
   integer, parameter :: kind_memory = 9
   !> A broken promise inside the program
   integer, parameter :: kind_internal = 70

   !> Nothing that a caller acts upon
   integer, parameter :: cause_unknown = 0
   !> A cycle passes a place where the finger is in balance at several loads for one sliding speed
   integer, parameter :: cause_several_balances = 1

   !> One error: allocated only where something went wrong
   type :: error_t
      !> One of the kinds above
      integer :: kind = kind_internal
      !> One of the causes above, for callers that act upon it
      integer :: cause = cause_unknown
      !> What went wrong, in one sentence or one line per mistake
      character(len=:), allocatable :: message
   end type error_t

contains

   !> Make an error.
   subroutine raise(error, kind, message)
      !> The error to allocate
      type(error_t), allocatable, intent(out) :: error
      !> One of the kinds of this module
      integer, intent(in) :: kind
      !> What went wrong
      character(len=*), intent(in) :: message

      allocate (error)
      error%kind = kind
      error%message = message
   end subroutine raise

   !> Put what the caller knows in front of the message, e.g. `while integrating case 12: ...`.
   subroutine add_context(error, context)
      !> An error on its way up; left alone where not allocated
      type(error_t), allocatable, intent(inout) :: error
      !> What the caller was doing
      character(len=*), intent(in) :: context

      if (.not. allocated(error)) return
      error%message = context//": "//error%message
   end subroutine add_context

end module camroller_error
