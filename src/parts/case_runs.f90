!> Runs of consecutive cases: which cases of a sweep are still to be computed, and the n-th of them.
!>
!> In: what part files hold. Out: runs, few integers however many cases there are.
module camroller_case_runs
   use camroller_kinds, only : wp
   use camroller_number_text, only : counted, integer_text
   use camroller_part_scan, only : entry_t, index_t
   use camroller_sorting, only : find_order
   implicit none
   private

   public :: runs_t, missing_runs, run_total, runs_in_words, piece_of, sort_entries

   !> Most runs that are named in words
   integer, parameter :: most_named = 20

   !> Runs in increasing order
   type :: runs_t
      !> First case of each, from 1, and number of cases
      integer, allocatable :: first(:), count(:)
   end type runs_t

contains

   !> Cases between two that are in no record. The entries get sorted by their first case.
   subroutine missing_runs(index, first, last, runs)
      !> What part files hold
      type(index_t), intent(inout) :: index
      !> First and last case that is wanted, from 1
      integer, intent(in) :: first, last
      !> Those of them that are missing
      type(runs_t), intent(out) :: runs

      integer, allocatable :: starts(:), counts(:)
      integer :: next, i, n

      if (allocated(index%entries)) call sort_entries(index%entries(:index%count))
      allocate (starts(index%count + 1), counts(index%count + 1))
      n = 0
      next = first
      do i = 1, index%count
         if (index%entries(i)%first > last) exit
         if (index%entries(i)%first > next) then
            n = n + 1
            starts(n) = next
            counts(n) = index%entries(i)%first - next
         end if
         next = max(next, index%entries(i)%first + index%entries(i)%count)
      end do
      if (next <= last) then
         n = n + 1
         starts(n) = next
         counts(n) = last - next + 1
      end if
      runs%first = starts(:n)
      runs%count = counts(:n)
   end subroutine missing_runs

   !> Number of cases in runs.
   pure function run_total(runs) result(total)
      !> The runs
      type(runs_t), intent(in) :: runs
      !> Number of cases
      integer :: total

      total = sum(runs%count)
   end function run_total

   !> Which cases are in runs, from 0 as in result files: `3 cases, 0 to 1, 7`.
   pure function runs_in_words(runs) result(words)
      !> The runs
      type(runs_t), intent(in) :: runs
      !> The words
      character(len=:), allocatable :: words

      integer :: i

      words = counted(run_total(runs), "case")
      do i = 1, min(size(runs%first), most_named)
         words = words//", "//integer_text(runs%first(i) - 1)
         if (runs%count(i) > 1) words = words//" to "//integer_text(runs%first(i) + runs%count(i) - 2)
      end do
      if (size(runs%first) > most_named) words = words//" and others"
   end function runs_in_words

   !> Consecutive cases from the n-th case of runs on.
   pure subroutine piece_of(runs, position, wanted, first, count)
      !> The runs
      type(runs_t), intent(in) :: runs
      !> Position of a case among those of the runs, from 1
      integer, intent(in) :: position
      !> How many cases are wanted
      integer, intent(in) :: wanted
      !> The case, and how many follow each other from it on; 0 beyond the end
      integer, intent(out) :: first, count

      integer :: before, i

      first = 0
      count = 0
      before = 0
      do i = 1, size(runs%first)
         if (position <= before + runs%count(i)) then
            first = runs%first(i) + position - before - 1
            count = min(wanted, before + runs%count(i) - position + 1)
            return
         end if
         before = before + runs%count(i)
      end do
   end subroutine piece_of

   !> Sort entries by their first case; of two with the same first case the longer one is first.
   subroutine sort_entries(entries)
      !> The entries
      type(entry_t), intent(inout) :: entries(:)

      integer, dimension(size(entries)) :: by_count, by_first

      call find_order(-real(entries%count, wp), by_count)
      call find_order(real(entries(by_count)%first, wp), by_first)
      entries = entries(by_count(by_first))
   end subroutine sort_entries

end module camroller_case_runs
