! style: module because a program holds no procedures of a type, and an example is one file
!> Many cases from another program: the cases of a deck in threads, each handed over as soon as it is computed.
!>
!> The program picks two scalars of each case; no files are written. `run_sweep` instead of `sweep_cases` writes the result file
!> that the command `camroller sweep` writes. Run it from the project's folder, where `decks/` is.
module speeds_and_slips
   use camroller, only : wp, error_t, case_outcome_t, find_quantity, layout_t, sink_t
   implicit none
   private

   public :: collector_t

   !> What the program keeps of each case
   type, extends(sink_t) :: collector_t
      !> Mean friction torque [N m], mean slip ratio [-]
      real(wp), allocatable :: torque(:), slip(:)
   contains
      procedure :: take
   end type collector_t

contains

   !> Take a case.
   subroutine take(self, number, outcome, layout, error)
      !> The collector
      class(collector_t), intent(inout) :: self
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> What came of it
      type(case_outcome_t), intent(in) :: outcome
      !> Names and units of its numbers
      type(layout_t), intent(in) :: layout
      !> Not used: nothing can go wrong here
      type(error_t), allocatable, intent(out) :: error

      if (outcome%status /= 0) return
      self%torque(number) = outcome%summary(find_quantity(layout%summary, "mean_torque_friction"))
      self%slip(number) = outcome%summary(find_quantity(layout%summary, "mean_slip_ratio"))
   end subroutine take

end module speeds_and_slips

!> Compute the nine operating points of the reference deck.
program many_cases
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use camroller, only : deck_t, error_t, override_t, read_deck, sweep_cases, use_one_blas_thread
   use speeds_and_slips, only : collector_t
   implicit none

   call main()

contains

   !> Everything, so that the program unit holds no allocated memory at its end.
   subroutine main()
      type(deck_t) :: deck
      type(collector_t) :: collector
      type(override_t) :: nothing(0)
      type(error_t), allocatable :: error
      integer :: i

      call use_one_blas_thread()
      call read_deck(deck, "decks/thesis.nml", nothing, error)
      call stop_on(error)
      allocate (collector%torque(9), collector%slip(9))
      call sweep_cases(deck, collector, error, threads=2)
      call stop_on(error)
      do i = 1, size(collector%torque)
         write (output_unit, "(a, i0, a, f9.5, a, f8.5)") "case ", i - 1, ": mean friction torque ", collector%torque(i), &
            & " N m, mean slip ratio ", collector%slip(i)
      end do
   end subroutine main

   !> End the program where something went wrong.
   subroutine stop_on(error)
      !> What went wrong
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (error_unit, "(a)") error%message
      error stop
   end subroutine stop_on

end program many_cases
