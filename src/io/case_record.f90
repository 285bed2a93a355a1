!> Cases in records: a run of consecutive cases, each with its status, its remark or message and its numbers.
!>
!> Layer: io. In: results and failures. Out: records of part files, and cases from them. A record holds the first case, the
!> number of cases and their layout, then the cases one after the other.
module camroller_case_record
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_layout, only : layout_t
   use camroller_result, only : result_t
   use camroller_record, only : record_t, clear_record, put_integer, put_numbers, put_text, set_integer, take_integer, &
      & take_numbers, take_text
   implicit none
   private

   public :: outcome_t, begin_cases, put_result, put_failure, end_cases, take_header, take_case, case_words

   !> Where count and layout stand among the words
   integer, parameter :: count_place = 2, layout_place = 3
   !> Words of a case besides its numbers, with a remark of the usual length
   integer, parameter :: words_of_case = 24

   !> One case
   type :: outcome_t
      !> 0, or the kind of the error
      integer :: status = 0
      !> Message of the error, or remarks
      character(len=:), allocatable :: text
      !> Scalars [unit of the scalar]; none where there is no result
      real(wp), allocatable :: summary(:)
      !> Series, shape (angle, series) [unit of the series]; none where they are not kept
      real(wp), allocatable :: series(:, :)
   end type outcome_t

contains

   !> Begin a run of cases.
   pure subroutine begin_cases(record, first)
      !> The record
      type(record_t), intent(inout) :: record
      !> First case, from 1
      integer, intent(in) :: first

      call clear_record(record)
      call put_integer(record, first)
      call put_integer(record, 0)
      call put_integer(record, 0)
   end subroutine begin_cases

   !> Add a result.
   pure subroutine put_result(record, result, with_series)
      !> The record
      type(record_t), intent(inout) :: record
      !> The result
      type(result_t), intent(in) :: result
      !> Are its series kept?
      logical, intent(in) :: with_series

      integer :: i

      call put_integer(record, 0)
      call put_integer(record, merge(1, 0, with_series))
      if (allocated(result%warnings)) then
         call put_text(record, result%warnings)
      else
         call put_text(record, "")
      end if
      call put_numbers(record, result%summary_values)
      if (.not. with_series) return
      do i = 1, size(result%series_values, 2)
         call put_numbers(record, result%series_values(:, i))
      end do
   end subroutine put_result

   !> Add a failure.
   pure subroutine put_failure(record, failure)
      !> The record
      type(record_t), intent(inout) :: record
      !> What went wrong
      type(error_t), intent(in) :: failure

      call put_integer(record, failure%kind)
      call put_integer(record, 0)
      call put_text(record, failure%message)
   end subroutine put_failure

   !> End a run of cases.
   pure subroutine end_cases(record, count, layout)
      !> The record
      type(record_t), intent(inout) :: record
      !> Number of cases in it
      integer, intent(in) :: count
      !> Their layout; 0 where none has a result
      integer, intent(in) :: layout

      call set_integer(record, count_place, count)
      call set_integer(record, layout_place, layout)
   end subroutine end_cases

   !> Take what a record says of its cases.
   pure subroutine take_header(record, first, count, layout)
      !> The record
      type(record_t), intent(inout) :: record
      !> First case, from 1; number of cases; their layout
      integer, intent(out) :: first, count, layout

      record%position = 0
      call take_integer(record, first)
      call take_integer(record, count)
      call take_integer(record, layout)
   end subroutine take_header

   !> Take the next case.
   pure subroutine take_case(record, layout, outcome)
      !> The record
      type(record_t), intent(inout) :: record
      !> Layout of its cases
      type(layout_t), intent(in) :: layout
      !> The case
      type(outcome_t), intent(inout) :: outcome

      integer :: has_series, i

      call take_integer(record, outcome%status)
      call take_integer(record, has_series)
      call take_text(record, outcome%text)
      if (allocated(outcome%series)) deallocate (outcome%series)
      if (outcome%status /= 0) return
      if (allocated(outcome%summary)) then
         if (size(outcome%summary) /= size(layout%summary)) deallocate (outcome%summary)
      end if
      if (.not. allocated(outcome%summary)) allocate (outcome%summary(size(layout%summary)))
      call take_numbers(record, outcome%summary)
      if (has_series == 0) return
      allocate (outcome%series(size(layout%angle), size(layout%series)))
      do i = 1, size(layout%series)
         call take_numbers(record, outcome%series(:, i))
      end do
   end subroutine take_case

   !> Words that a case takes.
   pure function case_words(result, with_series) result(words)
      !> A result
      type(result_t), intent(in) :: result
      !> Are its series kept?
      logical, intent(in) :: with_series
      !> Number of words
      integer :: words

      words = words_of_case + size(result%summary_values)
      if (with_series) words = words + size(result%series_values)
   end function case_words

end module camroller_case_record
