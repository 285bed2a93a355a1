!> What already has the name of a result.
!>
!> In: a path, the study that is to be written there. Out: whether a file is there, and whether it is a result of this
!> very study, complete or partial; how its study ended. What a file is follows from what it says of itself, not from its name.
module camroller_earlier_result
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : has_member, open_file, read_extents, read_numbers, read_text, &
      & read_text_attribute
   use camroller_number_text, only : agreeing, counted, integer_text
   use camroller_output, only : not_computed, result_format
   use camroller_part_scan, only : difference, study_facts_t
   use camroller_result_columns, only : holds_contacts_alone
   use camroller_run_facts, only : find_other_build, study_digest
   implicit none
   private

   public :: earlier_t, look_at_earlier, failures_in_words, complete_there, partial_there, other_there

   !> Nothing is there; all cases of this study are; some are; something else is
   integer, parameter :: nothing_there = 0, complete_there = 1, partial_there = 2, other_there = 3

   !> What is there
   type :: earlier_t
      !> One of the above
      integer :: state = nothing_there
      !> Cases that were computed
      integer :: computed = 0
      !> Difference from a result of this study
      character(len=:), allocatable :: reason
      !> The error that its study ended with, where cases failed
      type(error_t), allocatable :: failure
   end type earlier_t

contains

   !> Examine the file that has the name.
   subroutine look_at_earlier(earlier, path, facts)
      !> What is there
      type(earlier_t), intent(out) :: earlier
      !> Path of the result
      character(len=*), intent(in) :: path
      !> The study
      type(study_facts_t), intent(in) :: facts

      type(hdf5_object_t) :: file
      type(error_t), allocatable :: error
      logical :: is_there

      inquire (file=path, exist=is_there)
      if (.not. is_there) return
      earlier%state = other_there
      earlier%reason = "it is not a result file of camroller"
      call open_file(file, path, error)
      if (.not. allocated(error)) call compare_study(file, facts, earlier, error)
      if (.not. allocated(error) .and. earlier%reason == "") call read_outcome(file, facts%cases, earlier, error)
      if (allocated(error)) earlier%state = other_there
      call discard_file(file)
   end subroutine look_at_earlier

   !> Does a file say that it is of this study?
   subroutine compare_study(file, facts, earlier, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      type(study_facts_t), intent(in) :: facts
      !> Gets the difference from a result of this study; empty where there is none
      type(earlier_t), intent(inout) :: earlier
      !> File error where it is no result file
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: format, digest, builds, values

      call read_text_attribute(file, "/", "format", format, error)
      if (.not. allocated(error)) call read_text_attribute(file, "/run", "study", digest, error)
      if (.not. allocated(error)) call find_other_build(file, builds, error)
      if (allocated(error)) return
      if (format /= result_format) return
      if (digest == study_digest(facts)) then
         earlier%reason = ""
      else if (builds /= "") then
         earlier%reason = "another build made it"//builds
      else
         earlier%reason = "its deck, a table or a value of --set differs"
         if (.not. has_member(file, "/run/study_values")) return
         call read_text(file, "/run/study_values", [integer ::], values, error)
         if (.not. allocated(error)) earlier%reason = earlier%reason//": "//difference(values, facts%deck)
      end if
   end subroutine compare_study

   !> How the cases of a result ended.
   subroutine read_outcome(file, cases, earlier, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> Number of cases
      integer, intent(in) :: cases
      !> Gets the state, the cases that were computed, the first failure
      type(earlier_t), intent(inout) :: earlier
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: status(:) ! [-]
      integer, allocatable :: extents(:)
      character(len=:), allocatable :: message
      integer :: failed, first

      earlier%reason = "it holds the solved contacts of 'camroller ehl'"
      if (holds_contacts_alone(file)) return
      earlier%reason = "it has no status of each case"
      if (.not. has_member(file, "/summary")) return
      if (.not. has_member(file, "/summary/status")) return
      call read_extents(file, "/summary/status", 1, extents, error)
      if (allocated(error)) return
      if (extents(1) /= cases) return
      call read_numbers(file, "/summary/status", [0], extents, status, error)
      if (allocated(error)) return
      earlier%computed = cases - count(nint(status) == not_computed)
      earlier%state = merge(complete_there, partial_there, earlier%computed == cases)
      failed = count(status > 0.5_wp)
      if (failed == 0 .or. earlier%state == partial_there) return
      first = findloc(status > 0.5_wp, .true., dim=1)
      call read_text(file, "/run/messages", [first - 1], message, error)
      if (.not. allocated(error)) call raise(earlier%failure, nint(status(first)), failures_in_words(failed, cases, message))
   end subroutine read_outcome

   !> How many cases failed, and the first of them.
   pure function failures_in_words(failed, cases, message) result(words)
      !> Cases without a result, and all cases
      integer, intent(in) :: failed, cases
      !> Message of the first failure
      character(len=*), intent(in) :: message
      !> The words
      character(len=:), allocatable :: words

      words = integer_text(failed)//" of "//counted(cases, "case")//agreeing(failed, " has no result: ", &
         & " have no result; the first is ")//message
   end function failures_in_words

end module camroller_earlier_result
