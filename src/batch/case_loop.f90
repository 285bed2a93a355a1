!> The loop over the cases of a sweep: threads take runs of cases and hand records of them to a sink.
!>
!> In: a deck, the cases to be computed, a team, a sink. Out: every case in the sink once, in runs whose length
!> follows from the time that cases take; what ended the loop. Only one thread at a time takes cases and hands records over; a
!> case itself shares nothing with others, so its numbers do not depend on any of this. Texts are the exception: gfortran keeps
!> the length of a text that a function returns in a static variable of the caller, so one thread at a time turns a deck into
!> a case and a choice of effects into words; what integrates has no such functions. Built without OpenMP, the loop runs in one
!> thread.
module camroller_case_loop
   use, intrinsic :: iso_fortran_env, only : int64
!$ use omp_lib, only : omp_get_num_procs, omp_get_max_threads
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, add_context, raise, kind_unfinished, kind_usage
   use camroller_blas_threads, only : check_blas_memory
   use camroller_case, only : case_t
   use camroller_case_record, only : begin_cases, end_cases, put_failure, put_result
   use camroller_case_runs, only : piece_of, run_total, runs_t
   use camroller_case_sink, only : name_layout, sink_t
   use camroller_deck, only : deck_t, is_read, make_sweep_case
   use camroller_deck_sweep, only : case_in_words, sweep_size, get_values_beside
   use camroller_deck_sweep_keys, only : series_all, series_chosen, series_none
   use camroller_ehl_profiles, only : find_profiles
   use camroller_ehl_record, only : ehl_record_t
   use camroller_effect_words, only : choice_in_words
   use camroller_monitor, only : monitor_t
   use camroller_number_text, only : counted, integer_text
   use camroller_profile_remarks, only : judge_hot_profiles
   use camroller_record, only : record_t
   use camroller_result, only : result_t
   use camroller_run, only : run_next_case
   use camroller_kept_models, only : kept_models_t, revised_groups
   use camroller_team, only : team_t
   implicit none
   private

   public :: loop_t, compute_cases, number_of_cores, set_threads, sweep_cases
   public :: ended_all, ended_by_time

   !> What ended the loop
   integer, parameter :: ended_all = 0, ended_by_signal = 1, ended_by_time = 2, ended_by_error = 3
   !> Time that a run of cases should take [s]: many times what handing it over takes, little to lose, little to wait for
   real(wp), parameter :: time_of_run = 0.25_wp
   !> Most cases of a run, and words after which it is handed over
   integer, parameter :: longest_run = 256, largest_record = 524288
   !> Runs that are left for each thread when the length of runs begins to fall
   integer, parameter :: last_runs = 4

   !> Result of a case
   type :: computed_t
      type(result_t) :: result
      !> Why effects take part or not, where that was decided
      character(len=:), allocatable :: reasons
      !> Profiles across the contact, where they are wanted
      type(ehl_record_t), allocatable :: profiles
      !> What went wrong with it
      type(error_t), allocatable :: failure
   end type computed_t

   !> How the loop runs, and what it shares among its threads
   type :: loop_t
      !> Threads of this process
      integer :: threads = 1
      !> Series of which cases are kept: none, those listed, all
      integer :: series = series_none
      !> Profiles across the contact of which cases are kept, where they ask for them: none, those listed, all
      integer :: profiles = series_none
      !> Cases whose series and profiles are kept, from 0
      integer, allocatable :: series_cases(:)
      !> Clock at which the loop has to end; 0 for no limit
      integer(int64) :: deadline = 0
      !> What ended it
      integer :: ended = ended_all
      !> Cases handed over by this process, cases given out to all where there are several
      integer :: done = 0, given = 0
      !> Cases to be computed by all processes
      integer :: total = 0
      !> The error that ended it
      type(error_t), allocatable :: error
   end type loop_t

contains

   !> Threads of a loop, for which there has to be memory.
   subroutine set_threads(loop, wanted, error)
      !> The loop
      type(loop_t), intent(inout) :: loop
      !> How many; 0 for one on each core that this process may use
      integer, intent(in) :: wanted
      !> Too little memory for so many
      type(error_t), allocatable, intent(out) :: error

      loop%threads = wanted
      if (wanted == 0) loop%threads = number_of_cores()
      call check_blas_memory(loop%threads, error)
   end subroutine set_threads

   !> Cores that this process may use.
   function number_of_cores() result(cores)
      !> How many
      integer :: cores

      cores = 1
!$ cores = min(omp_get_num_procs(), omp_get_max_threads())
   end function number_of_cores

   !> Compute all cases of a deck; each goes to a sink, with its series where the sink wants them.
   subroutine sweep_cases(deck, sink, error, threads, with_series, monitor)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Where the cases go
      class(sink_t), intent(inout), target :: sink
      !> Error of the sink; or unfinished, where the monitor stopped it
      type(error_t), allocatable, intent(out) :: error
      !> Threads; without it one on each core
      integer, intent(in), optional :: threads
      !> Are series handed over? Without it they are not
      logical, intent(in), optional :: with_series
      !> Who follows it
      class(monitor_t), intent(inout), target, optional :: monitor

      type(loop_t), target :: loop
      type(monitor_t), target :: nobody
      type(team_t), target :: alone
      class(monitor_t), pointer :: follower
      type(runs_t) :: runs

      if (.not. is_read(deck)) then
         call raise(error, kind_usage, "sweep_cases: the deck has not been read; call read_deck or parse_deck first")
         return
      end if
      follower => nobody
      if (present(monitor)) follower => monitor
      loop%threads = 0
      if (present(threads)) loop%threads = threads
      call set_threads(loop, loop%threads, error)
      if (allocated(error)) return
      if (present(with_series)) loop%series = merge(series_all, series_none, with_series)
      runs%first = [1]
      runs%count = [sweep_size(deck%sweep)]
      call compute_cases(loop, deck, runs, sink, alone, follower, error)
      if (allocated(error) .or. loop%ended == ended_all) return
      call raise(error, kind_unfinished, "stopped after "//integer_text(loop%done)//" of "//counted(loop%total, "case"))
   end subroutine sweep_cases

   !> Compute cases.
   subroutine compute_cases(loop, deck, runs, sink, team, monitor, error)
      !> How; gets what came of it
      type(loop_t), intent(inout), target :: loop
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Cases to be computed
      type(runs_t), intent(in) :: runs
      !> Where they go
      class(sink_t), intent(inout), target :: sink
      !> Processes that share them
      class(team_t), intent(inout), target :: team
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> Error of the sink
      type(error_t), allocatable, intent(out) :: error

      if (.not. allocated(loop%series_cases)) allocate (loop%series_cases(0))
      loop%total = run_total(runs)
      loop%ended = ended_all
      !$omp parallel num_threads(loop%threads) default(shared)
      call work(loop, deck, runs, sink, team, monitor)
      !$omp end parallel
      if (allocated(loop%error)) call move_alloc(loop%error, error)
   end subroutine compute_cases

   !> What each thread does.
   subroutine work(loop, deck, runs, sink, team, monitor)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      type(deck_t), intent(in) :: deck
      !> Cases to be computed
      type(runs_t), intent(in) :: runs
      !> Where they go
      class(sink_t), intent(inout), target :: sink
      !> Processes that share them
      class(team_t), intent(inout), target :: team
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor

      type(kept_models_t) :: kept
      integer(int64) :: before, after, rate
      integer :: wanted, position, first, count, left
      logical :: is_over

      wanted = 1
      call system_clock(before, rate)
      do
         call take_cases(loop, team, monitor, wanted, position, left, is_over)
         if (is_over) exit
         do while (left > 0)
            call piece_of(runs, position, left, first, count)
            if (count == 0) exit
            call compute_run(loop, deck, first, count, kept, sink, monitor, is_over)
            if (is_over) return
            position = position + count
            left = left - count
         end do
         call system_clock(after)
         wanted = length_of_run(wanted, real(after - before, wp)/real(rate, wp))
         before = after
      end do
   end subroutine work

   !> Cases of the next run, from the time that the last one took.
   pure function length_of_run(last, time) result(length)
      !> Cases of the last run
      integer, intent(in) :: last
      !> Time it took [s]
      real(wp), intent(in) :: time
      !> Cases of the next one
      integer :: length

      length = min(longest_run, 8*last, int(1.0_wp + real(last, wp)*min(8.0_wp, time_of_run/max(time, 1.0e-9_wp))))
   end function length_of_run

   !> Take cases, fewer than wanted near the end, so that all threads end at the same time.
   subroutine take_cases(loop, team, monitor, wanted, position, count, is_over)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      !> Processes that share the cases
      class(team_t), intent(inout), target :: team
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> How many are wanted
      integer, intent(in) :: wanted
      !> Position of the first one among the cases to be computed, from 1
      integer, intent(out) :: position
      !> How many there are
      integer, intent(out) :: count
      !> Is there nothing more to do?
      logical, intent(out) :: is_over

      position = 0
      count = 0
      !$omp critical (camroller_desk)
      call note_limits(loop, monitor)
      is_over = loop%ended /= ended_all
      if (.not. is_over) then
         count = max(1, min(wanted, (loop%total - team%given)/(last_runs*loop%threads*team%ranks)))
         call team%take(count, position)
         is_over = position > loop%total
         count = min(count, loop%total - position + 1)
         if (team%ranks > 1) loop%given = min(team%given, loop%total)
      end if
      !$omp end critical (camroller_desk)
   end subroutine take_cases

   !> Has the time come to an end, or somebody asked for it? Time ends nothing before a case is done, so that a sweep that is
   !> begun again and again gets to its end however short its time is.
   subroutine note_limits(loop, monitor)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor

      if (loop%ended /= ended_all) return
      if (monitor%wants_stop()) then
         loop%ended = ended_by_signal
      else if (loop%done > 0 .and. is_late(loop%deadline)) then
         loop%ended = ended_by_time
      end if
   end subroutine note_limits

   !> Is a time in the past?
   function is_late(deadline) result(verdict)
      !> Clock; 0 for no time
      integer(int64), intent(in) :: deadline
      !> Is it?
      logical :: verdict

      integer(int64) :: now

      verdict = .false.
      if (deadline == 0) return
      call system_clock(now)
      verdict = now > deadline
   end function is_late

   !> Compute a run of cases and hand it over; where the loop has to end, what is done of it.
   subroutine compute_run(loop, deck, first, count, kept, sink, monitor, is_over)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      type(deck_t), intent(in) :: deck
      !> First case, from 1, and number of cases
      integer, intent(in) :: first, count
      !> Models of the cases that this thread has had before
      type(kept_models_t), intent(inout) :: kept
      !> Where they go
      class(sink_t), intent(inout), target :: sink
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> Does the loop have to end?
      logical, intent(out) :: is_over

      type(record_t) :: record
      type(computed_t) :: computed
      integer :: i, n, layout, of_case

      call begin_cases(record, first)
      n = 0
      layout = 0
      is_over = .false.
      do i = first, first + count - 1
         call compute_case(deck, i, is_kept(loop, loop%series, i - 1), is_kept(loop, loop%profiles, i - 1), kept, computed)
         if (allocated(computed%failure)) then
            call put_failure(record, computed%failure)
         else
            call ask_layout(loop, sink, computed%result, of_case)
            if (layout /= 0 .and. of_case /= layout) then
               call hand_over(loop, sink, monitor, record, n, layout)
               call begin_cases(record, i)
               n = 0
            end if
            layout = of_case
            call put_result(record, computed%result, computed%reasons, is_kept(loop, loop%series, i - 1), computed%profiles)
         end if
         n = n + 1
         is_over = is_stopped(loop, monitor)
         if (is_over) exit
         if (record%length < largest_record .or. i == first + count - 1) cycle
         call hand_over(loop, sink, monitor, record, n, layout)
         call begin_cases(record, i + 1)
         n = 0
         layout = 0
      end do
      if (n > 0) call hand_over(loop, sink, monitor, record, n, layout)
      if (is_ended(loop, monitor)) is_over = .true.
   end subroutine compute_run

   !> Compute one case.
   subroutine compute_case(deck, number, with_series, with_profiles, kept, computed)
      type(deck_t), intent(in) :: deck
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> Are its series kept, and its profiles, where it asks for them?
      logical, intent(in) :: with_series, with_profiles
      !> Models of the cases before
      type(kept_models_t), intent(inout) :: kept
      !> What it results in
      type(computed_t), intent(out) :: computed

      type(case_t) :: case
      character(len=:), allocatable :: train

      !$omp critical (camroller_texts)
      call make_sweep_case(deck, number, case, computed%failure)
      call get_values_beside(deck%sweep, number, revised_groups, train)
      !$omp end critical (camroller_texts)
      if (allocated(computed%failure)) return
      ! Profiles of the pressure are found from the series
      call run_next_case(kept, train, case, computed%result, computed%failure, with_series .or. allocated(case%ehl))
      !$omp critical (camroller_texts)
      computed%reasons = ""
      if (allocated(computed%result%choice)) computed%reasons = choice_in_words(computed%result%choice)
      if (allocated(computed%failure) .and. size(deck%sweep%axes) > 0) call add_context(computed%failure, &
         & case_in_words(deck%sweep, number))
      !$omp end critical (camroller_texts)
      if (.not. with_profiles .or. allocated(computed%failure)) return
      call find_profiles(computed%profiles, case, computed%result)
      if (allocated(computed%profiles)) call judge_hot_profiles(computed%profiles, case, computed%result%remarks)
   end subroutine compute_case

   !> Has the loop to end before its next case?
   function is_stopped(loop, monitor) result(verdict)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> Has it?
      logical :: verdict

      !$omp critical (camroller_desk)
      verdict = monitor%wants_stop()
      !$omp end critical (camroller_desk)
      if (.not. verdict) verdict = is_late(loop%deadline)
   end function is_stopped

   !> Are the series or the profiles of a case kept?
   pure function is_kept(loop, choice, number) result(verdict)
      !> How the loop runs
      type(loop_t), intent(in) :: loop
      !> Of which cases they are kept
      integer, intent(in) :: choice
      !> Number of the case, from 0
      integer, intent(in) :: number
      !> Are they?
      logical :: verdict

      verdict = choice == series_all
      if (choice == series_chosen) verdict = any(loop%series_cases == number)
   end function is_kept

   !> Number of the layout of a result.
   subroutine ask_layout(loop, sink, result, layout)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      !> Where the cases go
      class(sink_t), intent(inout), target :: sink
      type(result_t), intent(in) :: result
      !> The number
      integer, intent(out) :: layout

      type(error_t), allocatable :: error

      !$omp critical (camroller_desk)
      call name_layout(sink, result, layout, error)
      if (allocated(error)) call note_error(loop, error)
      !$omp end critical (camroller_desk)
   end subroutine ask_layout

   !> Hand a record over.
   subroutine hand_over(loop, sink, monitor, record, count, layout)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      !> Where it goes
      class(sink_t), intent(inout), target :: sink
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      type(record_t), intent(inout) :: record
      !> Number of cases in it, and their layout
      integer, intent(in) :: count, layout

      type(error_t), allocatable :: error

      call end_cases(record, count, layout)
      !$omp critical (camroller_desk)
      if (.not. allocated(loop%error)) then
         call sink%keep(record, error)
         if (allocated(error)) call note_error(loop, error)
         if (.not. allocated(error)) loop%done = loop%done + count
      end if
      !$omp critical (camroller_texts)
      call monitor%show(max(loop%done, loop%given), loop%total)
      !$omp end critical (camroller_texts)
      !$omp end critical (camroller_desk)
   end subroutine hand_over

   !> Take note of an error: the loop ends.
   subroutine note_error(loop, error)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      type(error_t), intent(in) :: error

      if (.not. allocated(loop%error)) loop%error = error
      loop%ended = ended_by_error
   end subroutine note_error

   !> Has the loop come to an end?
   function is_ended(loop, monitor) result(verdict)
      !> Shared by all threads
      type(loop_t), intent(inout), target :: loop
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> Has it?
      logical :: verdict

      !$omp critical (camroller_desk)
      call note_limits(loop, monitor)
      verdict = loop%ended /= ended_all
      !$omp end critical (camroller_desk)
   end function is_ended

end module camroller_case_loop
