!> The command `ehl`: the contact itself solved over the cycle, for every case of a deck and every lobe shape of its camshaft.
!>
!> In: the command line. Out: tables on the output unit, pressure and film in a file. A case that cannot be solved
!> is recorded and does not end the others; the program still ends with its kind of error.
module camroller_ehl_command
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_error, only : error_t, add_context
   use camroller_case, only : case_t
   use camroller_case_record, only : case_outcome_t
   use camroller_case_writer, only : abandon_cases, case_writer_t, close_cases, open_cases
   use camroller_cli, only : config_t
   use camroller_cycle, only : cycle_t
   use camroller_cycle_remarks, only : judge_lobe
   use camroller_hdf5_columns, only : hdf5_columns_t
   use camroller_console, only : tell_deck_remarks
   use camroller_deck, only : deck_t, read_deck, make_sweep_case
   use camroller_deck_sweep, only : sweep_size, case_in_words
   use camroller_ehl_converged, only : fewest_nodes, integrate_converged
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_file, only : ehl_file_t, open_ehl, write_ehl, close_ehl
   use camroller_ehl_page, only : ehl_line_t, write_friction, write_head, write_line
   use camroller_ehl_profiles, only : judge_light, plain_model
   use camroller_ehl_record, only : ehl_record_t, cycle_quantities, keep_nodes, make_ehl_record, solved_state
   use camroller_ehl_summary, only : make_ehl_summary
   use camroller_cycle_shares, only : add_shares
   use camroller_film_remarks, only : judge_films, judge_pressure, judge_traction, name_lobe
   use camroller_hertz, only : peak_pressure
   use camroller_state, only : state_t
   use camroller_events, only : contact_losses, cycle_stops, find_stops
   use camroller_layout, only : layout_t
   use camroller_margins, only : find_margins, margins_t
   use camroller_means, only : statistics_t
   use camroller_model, only : model_t
   use camroller_output, only : output_options_t
   use camroller_output_kind, only : result_kind
   use camroller_part_scan, only : study_facts_t
   use camroller_remarks, only : add_remark, plain_contacts, remark_lines, remark_t
   use camroller_run_command, only : check_cases, find_place, tell_remarks
   use camroller_run_facts, only : study_facts
   use camroller_streams, only : print_lines, tell
   use camroller_sweep_file, only : conclude
   implicit none
   private

   public :: ehl_deck, solve_case, angle_count

   !> Cam angles in the file
   integer, parameter :: angle_count = 720

contains

   !> Solve the contacts of a deck.
   subroutine ehl_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong; the first case that was not solved where there are several
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns

      type(deck_t) :: deck
      type(study_facts_t) :: facts
      type(case_writer_t) :: writer
      type(ehl_file_t) :: file
      type(case_t) :: case
      type(ehl_line_t), allocatable :: lines(:)
      type(error_t), allocatable :: unheard
      character(len=:), allocatable :: path, text
      integer :: i

      call read_deck(deck, config%subject, config%overrides, error, columns)
      if (.not. allocated(error)) call check_cases(deck, error)
      if (allocated(error)) return
      if (.not. config%is_quiet) call tell_deck_remarks(deck)
      call find_place(config, deck, result_kind, "_ehl.h5", path, error)
      if (allocated(error)) return
      do i = 1, size(config%overrides)
         if (is_of_runs(config%overrides(i)%text) .and. .not. config%is_quiet) call tell("remark: "//config%overrides(i)%text// &
            & " has no effect on solved contacts: it is used by runs"//new_line("a"))
      end do
      call study_facts(deck, facts)
      call make_sweep_case(deck, 1, case, error)
      if (.not. allocated(error)) call open_cases(writer, path, deck, facts, output_options_t(), .false., .false., error)
      if (.not. allocated(error)) call open_ehl(file, writer%file, merge(2, 1, allocated(case%second_lift)), angle_count, &
         & fewest_nodes, cycle_quantities, .false., error)
      if (allocated(error)) return
      call solve_cases(deck, config%is_quiet, writer, file, lines, unheard, error)
      call close_ehl(file)
      if (.not. allocated(error) .and. size(lines) == 0) error = writer%tally%failure
      if (allocated(error)) then
         call abandon_cases(writer)
         return
      end if
      call close_cases(writer, error)
      if (allocated(error)) return
      call write_friction(lines, text)
      if (.not. (config%is_quiet .or. allocated(unheard))) call print_lines(text//new_line("a")//path// &
         & ": pressure, film and friction in /ehl", unheard)
      if (.not. config%is_quiet) call tell_remarks(writer%tally, deck, .true.)
      if (allocated(unheard)) call move_alloc(unheard, error)
      if (.not. allocated(error)) call conclude(writer%tally, error)
   end subroutine ehl_deck

   !> Is a value that is given beside the deck for runs alone? Contacts are solved to `ehl.accuracy` at `angle_count` angles.
   pure function is_of_runs(override) result(verdict)
      !> As `group.key=value`
      character(len=*), intent(in) :: override
      !> Is it?
      logical :: verdict

      character(len=*), parameter :: of_runs(*) = [character(len=22) :: "numerics.", "effects.", "output.angle_step_deg=", &
         & "output.series=", "film.range_policy="]
      integer :: i

      verdict = .false.
      do i = 1, size(of_runs)
         verdict = verdict .or. index(override, trim(of_runs(i))) == 1
      end do
   end function is_of_runs

   !> Solve, write and report every case.
   subroutine solve_cases(deck, is_quiet, writer, file, lines, unheard, error)
      type(deck_t), intent(in) :: deck
      !> Print nothing?
      logical, intent(in) :: is_quiet
      !> The result file
      type(case_writer_t), intent(inout) :: writer
      !> Where solved contacts go
      type(ehl_file_t), intent(in) :: file
      !> What is printed of each cycle that was solved
      type(ehl_line_t), allocatable, intent(out) :: lines(:)
      !> Error of the output unit: the cases go into the file all the same
      type(error_t), allocatable, intent(out) :: unheard
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      type(case_outcome_t) :: outcome
      type(layout_t) :: nothing
      type(ehl_record_t) :: record
      type(ehl_line_t) :: line
      type(error_t), allocatable :: trouble, without_steady
      character(len=:), allocatable :: text
      integer :: i, lobe

      allocate (lines(0), nothing%summary(0), nothing%series(0), nothing%history(0), nothing%angle(0), &
         & outcome%summary(0))
      outcome%reasons = ""
      call write_head(text)
      if (.not. is_quiet) call print_lines(text, unheard)
      do i = 1, sweep_size(deck%sweep)
         outcome%status = 0
         outcome%remarks = [remark_t ::]
         call make_sweep_case(deck, i, case, trouble)
         if (.not. allocated(trouble)) call judge_parts(case, outcome%remarks)
         do lobe = 1, size(file%lobes)
            call make_sweep_case(deck, i, case, trouble)
            ! Formulas beside the film are without it as well
            if (allocated(case%heat)) deallocate (case%heat)
            if (.not. allocated(trouble)) call solve_case(case, lobe == 2, outcome%remarks, record, line, trouble, without_steady)
            if (allocated(without_steady) .and. .not. is_quiet) call tell("remark: "//case_in_words(deck%sweep, i)// &
               & " has no cycle with steady films to compare with: "//without_steady%message//new_line("a"))
            if (allocated(trouble)) then
               if (size(deck%sweep%axes) > 0) call add_context(trouble, case_in_words(deck%sweep, i))
               if (outcome%status == 0) outcome%text = trouble%message
               if (outcome%status == 0) outcome%status = trouble%kind
               cycle
            end if
            call write_ehl(file, writer%file, i, lobe, record, error)
            if (allocated(error)) return
            line%case_number = i - 1
            line%lobe = lobe
            lines = [lines, line]
            call write_line(line, text)
            if (.not. (is_quiet .or. allocated(unheard))) call print_lines(text, unheard)
         end do
         if (outcome%status == 0) outcome%text = remark_lines(outcome%remarks)
         call writer%take(i, outcome, nothing, error)
         if (allocated(error)) return
      end do
   end subroutine solve_cases

   !> One case and lobe shape on two grids that agree, and with steady films.
   subroutine solve_case(case, is_second, remarks, record, line, error, without_steady)
      !> The case
      type(case_t), intent(in) :: case
      !> The second lobe shape?
      logical, intent(in) :: is_second
      !> Remarks on the case so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Cycle on the finer grid, its profiles at the nodes of the file
      type(ehl_record_t), intent(out) :: record
      !> What is printed of it
      type(ehl_line_t), intent(out) :: line
      !> What went wrong, also where no two grids agree; and with steady films, which the others are compared with
      type(error_t), allocatable, intent(out) :: error, without_steady

      type(model_t) :: model
      type(ehl_cycle_t) :: cycle
      type(ehl_cycle_options_t) :: options
      ! Time [s]
      real(wp) :: start, finish
      integer :: lobe

      call cpu_time(start)
      lobe = merge(merge(2, 1, is_second), 0, allocated(case%second_lift))
      call plain_model(model, case, is_second, error)
      if (.not. allocated(error)) call judge_forces(model, lobe, remarks, error)
      if (allocated(error)) return
      call integrate_converged(cycle, model, line%coarse, line%fine, options, error)
      if (allocated(error)) return
      line%steps = size(cycle%angle)
      call make_ehl_record(record, model, cycle, cycle_quantities)
      call judge_light(record, remarks)
      call judge_solution(model, cycle, lobe, remarks)
      call keep_nodes(record, fewest_nodes)
      call line%set_friction(record)
      options%is_transient = .false.
      options%keeps_profiles = .false.
      call integrate_ehl_cycle(cycle, model, options, without_steady)
      line%has_steady = .not. allocated(without_steady)
      if (line%has_steady) line%steady = make_ehl_summary(model, cycle)
      call cpu_time(finish)
      line%time = finish - start
   end subroutine solve_case

   !> Remarks on groups of a case that solved contacts leave out.
   subroutine judge_parts(case, remarks)
      type(case_t), intent(in) :: case
      !> Remarks on it so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (allocated(case%dynamics)) call add_remark(remarks, plain_contacts, "&dynamics is left out: load and slip are those "// &
         & "of a rigid train; profiles of a run have the load of the flexible one (ehl.profiles = .true.)")
      if (allocated(case%running_in)) call add_remark(remarks, plain_contacts, "&running_in is left out: the surfaces are new")
      if (allocated(case%heat)) call add_remark(remarks, plain_contacts, "&heat is left out: over the cycle the film has one "// &
         & "temperature; profiles of a run have heat (ehl.profiles = .true.)")
   end subroutine judge_parts

   !> Remarks on what the film has no part in: contact, the pivot's joint, the valve's seat.
   subroutine judge_forces(model, lobe, remarks, error)
      type(model_t), intent(in) :: model
      !> Lobe shape to be named; 0 where there is one alone
      integer, intent(in) :: lobe
      !> Remarks on the case so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Domain error where the case forbids what happens
      type(error_t), allocatable, intent(out) :: error

      type(cycle_t) :: cycle
      type(margins_t) :: margins
      type(statistics_t) :: statistics
      ! Angles at which something changes [rad]; intervals without contact [rad]
      real(wp), allocatable :: stops(:), intervals(:, :)

      call find_stops(model, stops)
      cycle%stops = cycle_stops(stops, -pi)
      call find_margins(model, cycle%stops, margins)
      intervals = contact_losses(model, cycle%stops)
      statistics%lost_share = sum(intervals(2, :) - intervals(1, :))/two_pi
      call judge_lobe(model, cycle, statistics, margins, lobe, remarks, error)
   end subroutine judge_forces

   !> Remarks on the solved film: its pressure, its thickness beside the roughness, its traction.
   subroutine judge_solution(model, cycle, lobe, remarks)
      type(model_t), intent(in) :: model
      type(ehl_cycle_t), intent(in) :: cycle
      !> Lobe shape to be named; 0 where there is one alone
      integer, intent(in) :: lobe
      !> Remarks on the case so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      type(statistics_t) :: statistics
      type(state_t) :: state
      ! Largest pressure of the dry contact [Pa]; film over the equivalent radius, half of an interval as part of the turn [-]
      real(wp) :: pressure, film, half
      integer :: i, k, first

      pressure = 0.0_wp
      do i = 2, size(cycle%moments)
         half = 0.5_wp*(cycle%angle(i) - cycle%angle(i - 1))/two_pi
         do k = i - 1, i
            if (.not. cycle%moments(k)%has_film) cycle
            call solved_state(model, cycle%moments(k), state)
            call add_shares(statistics, model, state, cycle%angle(k), .false., half)
         end do
         if (.not. cycle%moments(i)%has_film) cycle
         pressure = max(pressure, peak_pressure(state%contact%load, state%position%equivalent_radius, model%contact_width, &
            & model%modulus))
         film = state%contact%film_central/state%position%equivalent_radius
         if (film <= statistics%thickest_film) cycle
         statistics%thickest_film = film
         statistics%thickest_angle = cycle%angle(i)
      end do
      first = size(remarks) + 1
      call judge_pressure(model, pressure, remarks)
      call judge_traction(model, statistics, remarks)
      call judge_films(statistics, .false., remarks)
      call name_lobe(remarks, first, lobe)
   end subroutine judge_solution

end module camroller_ehl_command
