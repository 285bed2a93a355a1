!> The command `ehl`: the contact itself solved over the cycle, for every case of a deck.
!>
!> Layer: app. In: the command line. Out: a table on the output unit, pressure and film in a file. A case that cannot be solved
!> is named and does not end the others; the program still ends with its kind of error.
module camroller_ehl_command
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t, raise, add_context, kind_usage
   use camroller_case, only : case_t
   use camroller_cli, only : config_t
   use camroller_deck, only : deck_t, read_deck, make_sweep_case
   use camroller_deck_sweep, only : sweep_size, case_in_words
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_file, only : write_ehl
   use camroller_ehl_table, only : ehl_t
   use camroller_model, only : model_t, new_model
   use camroller_output, only : output_t, output_options_t, open_output, abandon_output
   use camroller_run_command, only : check_cases, output_path
   use camroller_run_facts, only : write_facts
   use camroller_study_file, only : close_study
   implicit none
   private

   public :: ehl_deck

   !> Nodes of both grids
   integer, parameter :: sizes(2) = [65, 129]

contains

   !> Solve the contacts of a deck.
   subroutine ehl_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong; the first case that was not solved where there are several
      type(error_t), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(output_t) :: writer
      type(ehl_cycle_t), allocatable :: cycles(:)
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: path

      call read_deck(deck, config%subject, config%overrides, error)
      if (.not. allocated(error)) call check_cases(deck, error)
      if (allocated(error)) return
      path = output_path(config, "_ehl.h5")
      if (path == config%subject) then
         call raise(error, kind_usage, "the result would replace the deck '"//path//"'")
         return
      end if
      call open_output(writer, path, sweep_size(deck%sweep), output_options_t(), error)
      if (.not. allocated(error)) call write_facts(writer, deck, error)
      if (allocated(error)) return
      call solve_cases(deck, config%is_quiet, cycles, failure)
      if (allocated(failure) .and. size(cycles) == 1) then
         call abandon_output(writer)
         call move_alloc(failure, error)
         return
      end if
      call write_ehl(writer, cycles, error)
      if (.not. allocated(error)) call close_study(writer, error)
      if (allocated(error)) return
      if (.not. config%is_quiet) write (output_unit, "(a)") path//": pressure and film in /ehl"
      if (allocated(failure)) call move_alloc(failure, error)
   end subroutine ehl_deck

   !> Solve and report every case.
   subroutine solve_cases(deck, is_quiet, cycles, failure)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Print nothing?
      logical, intent(in) :: is_quiet
      !> Cycles on the finer grid
      type(ehl_cycle_t), allocatable, intent(out) :: cycles(:)
      !> What went wrong with the first case that was not solved
      type(error_t), allocatable, intent(out) :: failure

      type(case_t) :: case
      type(error_t), allocatable :: error
      ! Smallest film, means of smallest and central film [m], mean sliding speed [m/s]: coarse, fine, steady; times [s]
      real(wp) :: numbers(4, 3), start, finish
      character(len=11) :: squeeze
      integer :: i

      allocate (cycles(sweep_size(deck%sweep)))
      if (.not. is_quiet) write (output_unit, "(a4, 2x, 4a13, 3a11, a8, a9)") "case", "smallest [um]", "mean min[um]", &
         & "central [um]", "slip [m/s]", "grid [%]", "slip [%]", "squeeze[%]", "steps", "time [s]"
      do i = 1, size(cycles)
         call cpu_time(start)
         call make_sweep_case(deck, i, case, error)
         if (.not. allocated(error)) call solve_case(case, cycles(i), numbers, error)
         call cpu_time(finish)
         if (allocated(error)) then
            if (size(deck%sweep%axes) > 0) call add_context(error, case_in_words(deck%sweep, i))
            if (.not. is_quiet .and. size(cycles) > 1) write (error_unit, "(a)") error%message
            if (.not. allocated(failure)) call move_alloc(error, failure)
            if (allocated(error)) deallocate (error)
         else if (.not. is_quiet) then
            squeeze = "-"
            if (numbers(1, 3) > 0.0_wp) write (squeeze, "(f11.3)") 100.0_wp*(numbers(1, 2)/numbers(1, 3) - 1.0_wp)
            write (output_unit, "(i4, 2x, 3f13.4, es13.3, 2f11.3, a11, i8, f9.2)") i - 1, 1.0e6_wp*numbers(:3, 2), numbers(4, 2), &
               & 100.0_wp*maxval(abs(numbers(:3, 1)/numbers(:3, 2) - 1.0_wp)), 100.0_wp*abs(numbers(4, 1)/numbers(4, 2) - 1.0_wp), &
               & adjustr(squeeze), size(cycles(i)%angle), finish - start
         end if
      end do
   end subroutine solve_cases

   !> One case on both grids, and with steady films.
   subroutine solve_case(case, cycle, numbers, error)
      !> The case
      type(case_t), intent(inout) :: case
      !> Cycle on the finer grid
      type(ehl_cycle_t), intent(out) :: cycle
      !> Smallest film, mean films [m], mean sliding speed [m/s]: coarse, fine, steady
      real(wp), intent(out) :: numbers(4, 3)
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(model_t) :: model
      type(ehl_cycle_t) :: other
      type(ehl_cycle_options_t) :: options
      type(ehl_t), allocatable :: setup

      call move_alloc(case%ehl, setup)
      call new_model(model, case, case%lift, error)
      if (allocated(error)) return
      if (allocated(setup)) model%ehl = setup
      options%nodes = sizes(1)
      call integrate_ehl_cycle(other, model, options, error)
      if (allocated(error)) return
      numbers(:, 1) = summary(other)
      options%nodes = sizes(2)
      options%is_transient = .false.
      ! Steady films may jump where the spike is not resolved, and then no step is short enough: nothing to compare with
      numbers(:, 3) = 0.0_wp
      call integrate_ehl_cycle(other, model, options, error)
      if (.not. allocated(error)) numbers(:, 3) = summary(other)
      options%is_transient = .true.
      options%keeps_profiles = .true.
      call integrate_ehl_cycle(cycle, model, options, error)
      if (allocated(error)) return
      numbers(:, 2) = summary(cycle)
   end subroutine solve_case

   !> What is printed of a cycle.
   pure function summary(cycle) result(numbers)
      !> The cycle
      type(ehl_cycle_t), intent(in) :: cycle
      !> Smallest film, mean films [m], mean sliding speed [m/s]
      real(wp) :: numbers(4)

      ! Weights of the angles [-]
      real(wp) :: weights(size(cycle%angle))
      integer :: n

      n = size(cycle%angle)
      weights = 0.0_wp
      weights(:n - 1) = 0.5_wp*(cycle%angle(2:) - cycle%angle(:n - 1))/two_pi
      weights(2:) = weights(2:) + 0.5_wp*(cycle%angle(2:) - cycle%angle(:n - 1))/two_pi
      numbers = [minval(cycle%moments%films%minimum, mask=cycle%moments%has_film), &
         & dot_product(weights, cycle%moments%films%minimum), dot_product(weights, cycle%moments%films%central), &
         & dot_product(weights, cycle%moments%sliding_speed)]
   end function summary

end module camroller_ehl_command
