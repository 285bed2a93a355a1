!> What every cycle of solved contacts must be: finite, periodic, energy closed, load carried; and the few numbers by which two of
!> them are compared.
module ehl_checks
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_record, only : ehl_record_t, column, cycle_quantities, make_ehl_record
   use camroller_ehl_summary, only : ehl_summary_t, make_ehl_summary, mean_over_cycle
   use camroller_model, only : model_t
   implicit none
   private

   public :: cycle_facts_t, solve_and_check

   !> What two cycles of a deck have to agree in
   type :: cycle_facts_t
      !> Harmonic mean of the smallest film where there is contact: of the thin films, not of what a short loss leaves [m]
      real(wp) :: film = 0.0_wp
      !> Mean, largest size and total variation of the sliding speed [m/s]
      real(wp) :: slip = 0.0_wp, largest_slip = 0.0_wp, variation = 0.0_wp
      !> Accepted and refused steps
      integer :: steps = 0, refused = 0
   end type cycle_facts_t

   !> Energy left over, over the largest power: a sum of ten terms of which each has some roundings [-]
   real(wp), parameter :: energy_tolerance = 200.0_wp*epsilon(1.0_wp)
   !> What pressure may leave of the load [-]
   real(wp), parameter :: load_tolerance = 1.0e-5_wp

contains

   !> Solve a cycle and look at it.
   subroutine solve_and_check(model, node_count, step_error, facts, trouble, failure, summary)
      !> The model
      type(model_t), intent(in) :: model
      !> Nodes
      integer, intent(in) :: node_count
      !> Error of a step [-]
      real(wp), intent(in) :: step_error
      !> What was seen
      type(cycle_facts_t), intent(out) :: facts
      !> What is wrong; left alone where all is well
      character(len=:), allocatable, intent(inout) :: trouble
      !> Why there is no cycle
      type(error_t), allocatable, intent(out) :: failure
      !> What the grids of a case are compared by
      type(ehl_summary_t), intent(out), optional :: summary

      type(ehl_cycle_t) :: cycle
      type(ehl_record_t) :: record
      ! [m/s], [m]; largest power [W]
      real(wp), allocatable :: slip(:), film(:)
      real(wp) :: power

      call integrate_ehl_cycle(cycle, model, ehl_cycle_options_t(nodes=node_count, step_error=step_error), failure)
      facts%refused = cycle%refused
      if (allocated(failure)) return
      facts%steps = size(cycle%angle)
      if (present(summary)) summary = make_ehl_summary(model, cycle)
      call make_ehl_record(record, model, cycle, cycle_quantities)
      film = column(record, "film_min")
      slip = column(record, "sliding_speed")
      power = maxval(abs(column(record, "torque_drive")))*model%speed
      facts%largest_slip = maxval(abs(slip))
      associate (last => size(slip), moments => cycle%moments)
         if (.not. all(ieee_is_finite(record%values))) trouble = "a number that is none"
         if (any(moments%has_film .and. .not. film > 0.0_wp)) trouble = "contact without a film"
         if (maxval(abs(column(record, "energy_residual"))) > energy_tolerance*power) trouble = "energy does not close"
         if (any(moments%films%load_lack > load_tolerance)) trouble = "pressure does not carry the load"
         ! Three errors of a step are what the cycle itself asks for
         if (abs(film(last) - film(1)) > 3.0_wp*step_error*film(1) .or. abs(slip(last) - slip(1)) > 3.0_wp*step_error &
            & *facts%largest_slip) trouble = "the cycle is not periodic"
         facts%variation = sum(abs(slip(2:) - slip(:last - 1)))
         facts%slip = mean_over_cycle(record%angle, slip)
         facts%film = 1.0_wp/mean_over_cycle(record%angle, merge(1.0_wp/max(film, tiny(1.0_wp)), 0.0_wp, moments%has_film))
      end associate
   end subroutine solve_and_check

end module ehl_checks
