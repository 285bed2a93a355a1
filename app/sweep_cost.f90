!> What a sweep will cost, from a few of its cases: time, memory, disk space.
!>
!> In: a deck with many cases. Out: lines of text. The cases tried lie evenly between the first and the last.
module camroller_sweep_cost
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_accuracy, only : resolve_numerics
   use camroller_case, only : case_t, numerics_t
   use camroller_case_facts, only : quick_case
   use camroller_case_loop, only : number_of_cores
   use camroller_case_record, only : case_words
   use camroller_deck, only : deck_t, make_sweep_case
   use camroller_deck_document, only : echo_t, get_echo
   use camroller_deck_sweep, only : sweep_size, sweep_t
   use camroller_deck_sweep_keys, only : series_all, series_choice, series_chosen, series_none
   use camroller_ehl_profiles, only : find_profiles
   use camroller_ehl_record, only : ehl_record_t
   use camroller_number_text, only : integer_text, number_text
   use camroller_console, only : time_in_words
   use camroller_remarks, only : remark_lines
   use camroller_result, only : result_t
   use camroller_run, only : run_case
   use camroller_settings, only : take
   implicit none
   private

   public :: cost_in_words, case_to_try

   !> Most cases that are tried
   integer, parameter :: most_trials = 9
   !> Time after which no further one is tried [s]
   real(wp), parameter :: longest_trial = 1.0_wp
   !> Number, megabyte, and what each thread keeps of cases that it has not handed over yet [byte]
   real(wp), parameter :: number_size = 8.0_wp, megabyte = 1.0e6_wp, thread_size = 8.0e6_wp
   !> Status and number of a case, and how often a value that varies is held when it is written [byte], [-]
   real(wp), parameter :: case_size = 8.0_wp, copies = 2.0_wp
   !> What a key of the deck, a scalar or a series takes in a result file besides its numbers [byte]
   real(wp), parameter :: entry_size = 740.0_wp

   !> Mean cost of a case
   type :: cost_t
      !> Cases tried, and those without a result
      integer :: trials = 0, failures = 0
      !> Processor time of a case [s]
      real(wp) :: time = 0.0_wp
      !> Memory before any case was tried, and what a case added to it at most [byte]
      real(wp) :: before = 0.0_wp, added = 0.0_wp
      !> Are time and memory those of larger tolerances, with the steps that the case's own take over theirs?
      logical :: is_estimated = .false.
      !> Numbers of a case with and without series and profiles
      integer :: words_with_series = 0, words = 0
      !> Scalars and series
      integer :: scalars = 0, series = 0
      !> Remarks of a case, in the mean [byte]
      real(wp) :: remarks = 0.0_wp
   end type cost_t

contains

   !> Cost of all cases in words, each line a comment of a deck.
   subroutine cost_in_words(deck, text)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Lines
      character(len=:), allocatable, intent(out) :: text

      type(cost_t) :: cost
      integer, allocatable :: chosen(:)
      integer :: series, cases, cores
      type(echo_t) :: echo
      ! Of the sweep, with the series of every case; what a file of either has whatever the number of cases [byte]
      real(wp) :: space, space_with_series, fixed, fixed_with_series, memory

      series = series_choice(deck%settings)
      call try_cases(deck, series /= series_none, cost)
      cases = sweep_size(deck%sweep)
      cores = number_of_cores()
      text = "! tried "//integer_text(cost%trials)//" of the cases"
      if (cost%failures > 0) text = text//", "//integer_text(cost%failures)//" of them without a result"
      if (cost%is_estimated) text = text//", with a larger tolerance"
      text = text//": "//number_text(1.0e3_wp*cost%time, 3)//" ms each, "//time_in_words(cost%time*cases)// &
         & " for all in one thread, "//time_in_words(cost%time*cases/cores)//" in "//integer_text(cores)//new_line("a")
      space = (number_size*cost%words + cost%remarks)*cases
      space_with_series = (number_size*cost%words_with_series + cost%remarks)*cases
      if (series == series_all) space = space_with_series
      if (series == series_chosen) then
         allocate (chosen(0))
         call take(deck%settings, "sweep", "series_cases", chosen)
         space = space + number_size*real(cost%words_with_series - cost%words, wp)*size(chosen)
      end if
      call get_echo(deck, echo, .true.)
      fixed = entry_size*(size(echo%keys) + cost%scalars) + len(deck%text)
      fixed_with_series = fixed + entry_size*cost%series
      if (series /= series_none) fixed = fixed_with_series
      memory = cost%before + min(cores, cases)*(cost%added + thread_size) + cases*(case_size + copies*widest_value(deck%sweep))
      text = text//"! memory about "//megabytes(memory)//"; on disk about "// &
         & megabytes(space)//" in parts while it runs, and "//megabytes(space + fixed)//" more for the result file at the end"// &
         & new_line("a")
      text = text//"! 'camroller run' writes about "//megabytes(space_with_series + fixed_with_series)// &
         & " with the series of every case, 'camroller sweep' about "//megabytes(space + fixed)//new_line("a")
   end subroutine cost_in_words

   !> Memory of the longest value that varies, which the result file has for all cases in one piece.
   pure function widest_value(sweep) result(bytes)
      type(sweep_t), intent(in) :: sweep
      !> Memory [byte]
      real(wp) :: bytes

      integer :: i

      bytes = number_size
      do i = 1, size(sweep%axes)
         if (.not. sweep%axes(i)%is_numeric) bytes = max(bytes, real(sweep%axes(i)%values%width, wp))
      end do
   end function widest_value

   !> The n-th case of the sample that stands for all.
   pure function case_to_try(position, trials, cases) result(number)
      !> Position, from 1; how many are tried; number of cases
      integer, intent(in) :: position, trials, cases
      !> Number of the case, from 1
      integer :: number

      number = 1
      if (trials > 1) number = 1 + int(int(position - 1, int64)*int(cases - 1, int64)/int(trials - 1, int64))
   end function case_to_try

   !> Run a few cases. A flexible train may take a minute where it has no period or a part of no engine: it is run with a larger
   !> tolerance, whose steps are fewer by the fifth root of it.
   subroutine try_cases(deck, with_profiles, cost)
      type(deck_t), intent(in) :: deck
      !> Are profiles kept, where a case asks for them?
      logical, intent(in) :: with_profiles
      !> What they cost
      type(cost_t), intent(out) :: cost

      ! Order of the method that integrates a flexible train [-]
      real(wp), parameter :: order = 5.0_wp
      type(case_t) :: case, quick
      type(result_t) :: result
      type(ehl_record_t), allocatable :: profiles
      type(error_t), allocatable :: error
      real(wp) :: start, before, now ! [s]
      real(wp) :: ratio ! of the steps of the case itself to those it is tried with [-]
      ! Of the case as it is run, of the case itself
      type(numerics_t) :: resolved(2)
      integer :: i, trials

      trials = min(most_trials, sweep_size(deck%sweep))
      resolved%tolerance = 1.0_wp
      cost%before = peak_memory()
      call cpu_time(start)
      do i = 1, trials
         call make_sweep_case(deck, case_to_try(i, trials, sweep_size(deck%sweep)), case, error)
         call cpu_time(before)
         if (.not. allocated(error)) then
            quick = quick_case(case)
            resolved = [resolve_numerics(quick%numerics), resolve_numerics(case%numerics)]
            cost%is_estimated = cost%is_estimated .or. resolved(1)%tolerance > resolved(2)%tolerance
            call run_case(quick, result, error)
         end if
         if (with_profiles .and. .not. allocated(error)) call find_profiles(profiles, case, result)
         cost%trials = i
         if (allocated(error)) then
            cost%failures = cost%failures + 1
         else
            cost%words = case_words(result, .false.)
            cost%words_with_series = case_words(result, .true., profiles)
            cost%scalars = size(result%summary)
            cost%series = size(result%series)
            cost%remarks = cost%remarks + len(remark_lines(result%remarks))
         end if
         call cpu_time(now)
         ratio = (resolved(1)%tolerance/resolved(2)%tolerance)**(1.0_wp/order)
         cost%time = cost%time + ratio*(now - before)
         cost%added = max(cost%added, ratio*(peak_memory() - cost%before))
         if (now - start > longest_trial) exit
      end do
      cost%time = cost%time/cost%trials
      cost%remarks = cost%remarks/cost%trials
   end subroutine try_cases

   !> Most memory that this process has had so far, where the system tells.
   function peak_memory() result(bytes)
      !> Memory [byte]
      real(wp) :: bytes

      character(len=200) :: line
      integer :: unit, status

      bytes = 0.0_wp
      open (newunit=unit, file="/proc/self/status", action="read", status="old", iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (line(:6) /= "VmHWM:") cycle
         read (line(7:), *, iostat=status) bytes
         if (status == 0) bytes = 1024.0_wp*bytes
         exit
      end do
      close (unit)
   end function peak_memory

   !> Bytes in words.
   function megabytes(bytes) result(words)
      !> How many [byte]
      real(wp), intent(in) :: bytes
      !> The words
      character(len=:), allocatable :: words

      words = number_text(max(bytes/megabyte, 0.01_wp), 2)//" MB"
      if (bytes > 1.0e3_wp*megabyte) words = number_text(bytes/megabyte/1.0e3_wp, 2)//" GB"
   end function megabytes

end module camroller_sweep_cost
