!> Transient solution of the contact over a cycle, with as many nodes as its accuracy requires.
!>
!> In: model. Out: the cycle on the finer of two grids that agree, and their numbers of nodes; an error where no two agree.
module camroller_ehl_converged
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_convergence
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_summary, only : ehl_summary_t, make_ehl_summary, compare_cycles
   use camroller_ehl_table, only : ehl_t
   use camroller_model, only : model_t
   implicit none
   private

   public :: fewest_nodes, integrate_converged

   !> Nodes of the first pair of grids and of the last
   integer, parameter :: first_nodes = 65, fewest_nodes = 2*first_nodes - 1, most_nodes = 513
   !> Error of a step over the accuracy, and at most [-]: a step error of 1e-3 leaves 0.2 % of the smallest film and 0.02 % of the
   !> means at 300 rev/min and 25, 60 and 95 degC
   real(wp), parameter :: step_part = 0.1_wp, largest_step_error = 1.0e-3_wp

contains

   !> Cycle on 65 and 129 nodes, and on twice as many until films and mean slip of two grids differ by no more than the accuracy of
   !> the model's group `&ehl`, or 1 % without it.
   !>
   !> A grid on which no cycle is found counts as one that differs. All grids are nested.
   subroutine integrate_converged(cycle, model, coarse, fine, options, error, most)
      !> The cycle on the finer grid, with profiles
      type(ehl_cycle_t), intent(out) :: cycle
      !> The model
      type(model_t), intent(in) :: model
      !> Numbers of the cycle on the coarser and on the finer grid
      type(ehl_summary_t), intent(out) :: coarse, fine
      !> The options that the finer grid was solved with
      type(ehl_cycle_options_t), intent(out) :: options
      !> Domain error beyond the range of solutions; convergence error where no two grids agree, that of the finest
      type(error_t), allocatable, intent(out) :: error
      !> Most nodes; absent: 513
      integer, intent(in), optional :: most

      type(ehl_t) :: setup
      integer :: last
      logical :: has_coarse

      if (allocated(model%ehl)) setup = model%ehl
      last = most_nodes
      if (present(most)) last = most
      options%step_error = min(largest_step_error, step_part*setup%accuracy)
      options%nodes = first_nodes
      has_coarse = .false.
      do
         options%keeps_profiles = has_coarse
         call integrate_ehl_cycle(cycle, model, options, error)
         if (.not. allocated(error)) then
            fine = make_ehl_summary(model, cycle)
            if (has_coarse) then
               call compare_cycles(coarse, fine, setup%accuracy, error)
               if (.not. allocated(error)) return
            end if
            coarse = fine
            has_coarse = .true.
         else if (error%kind /= kind_convergence) then
            return
         else
            has_coarse = .false.
         end if
         if (options%nodes >= last) return
         options%nodes = 2*options%nodes - 1
      end do
   end subroutine integrate_converged

end module camroller_ehl_converged
