!> The study that a sweep computes: its deck, the path of its result, what part files of it must agree on.
!>
!> In: the command line. Out: `sweep_run_t`, and what the deck says of series and profiles; part files read.
module camroller_sweep_study
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_case_runs, only : runs_t
   use camroller_cli, only : config_t
   use camroller_deck, only : deck_t, read_deck
   use camroller_mistakes, only : line_t
   use camroller_part_file, only : scan_part
   use camroller_part_scan, only : index_t, study_facts_t
   use camroller_run_command, only : find_place
   use camroller_run_facts, only : study_facts
   use camroller_settings, only : get_word, take
   use camroller_streams, only : tell
   implicit none
   private

   public :: sweep_run_t, begin_study, series_choice, scan_all, tell_damages

   !> A sweep being run
   type :: sweep_run_t
      type(deck_t) :: deck
      type(study_facts_t) :: facts
      !> Path of the result file
      character(len=:), allocatable :: path
      !> First and last case of this shard, from 1
      integer :: first = 1, last = 0
      !> Cases still to be computed
      type(runs_t) :: runs
      !> Is the result file there, with everything in it?
      logical :: is_complete = .false.
      !> The error that its cases ended with, where some failed
      type(error_t), allocatable :: failure
   end type sweep_run_t

contains

   !> The deck and the path of its result.
   subroutine begin_study(config, run, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(inout) :: run
      !> Deck or usage error
      type(error_t), allocatable, intent(out) :: error

      call read_deck(run%deck, config%subject, config%overrides, error)
      if (allocated(error)) return
      call study_facts(run%deck, run%facts)
      call find_place(config, run%deck, ".h5", run%path, error)
      if (allocated(error)) return
      if (wants_profiles(run%deck) .and. series_choice(run%deck) == "none") then
         call raise(error, kind_deck, "'ehl.profiles' has no cases: a sweep keeps profiles of the cases whose series it keeps, "// &
            & "1.6 MB each at 720 cam angles; choose them by 'sweep.series', or leave 'ehl.profiles' out")
      end if
   end subroutine begin_study

   !> Does a deck ask for profiles across the contact?
   function wants_profiles(deck) result(answer)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Does it?
      logical :: answer

      answer = .false.
      call take(deck%settings, "ehl", "profiles", answer)
   end function wants_profiles

   !> Series of which cases are kept.
   function series_choice(deck) result(choice)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> One of the names of the key
      character(len=:), allocatable :: choice

      choice = get_word(deck%settings, "sweep", "series")
      if (choice == "") choice = "none"
   end function series_choice

   !> Index of all part files.
   subroutine scan_all(paths, facts, index, error)
      !> Their paths
      type(line_t), intent(in) :: paths(:)
      !> The sweep they must belong to
      type(study_facts_t), intent(in) :: facts
      !> The index
      type(index_t), intent(inout) :: index
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      if (.not. allocated(index%entries)) allocate (index%entries(64), index%damages(0))
      do i = 1, size(paths)
         call scan_part(paths(i)%text, facts, index, error)
         if (allocated(error)) return
      end do
   end subroutine scan_all

   !> Say what of the part files is damaged.
   subroutine tell_damages(index)
      !> What they hold
      type(index_t), intent(in) :: index

      integer :: i

      do i = 1, size(index%damages)
         call tell("remark: "//index%damages(i)%text//"; its cases have to be computed again"//new_line("a"))
      end do
   end subroutine tell_damages

end module camroller_sweep_study
