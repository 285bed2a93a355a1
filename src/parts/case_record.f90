!> Cases in records: a run of consecutive cases, each with its status, its remark or message, its numbers, and its
!> profiles across the contact where they are kept.
!>
!> In: results and failures. Out: records of part files, and cases from them. A record holds the first case, the
!> number of cases and their layout, then the cases one after the other.
module camroller_case_record
   use camroller_kinds, only : wp
   use camroller_ehl_record, only : ehl_record_t, profile_quantities
   use camroller_error, only : error_t
   use camroller_layout, only : layout_t
   use camroller_remarks, only : remark_t, remark_lines
   use camroller_result, only : result_t
   use camroller_record, only : record_t, clear_record, put_integer, put_numbers, put_text, set_integer, take_integer, &
      & take_numbers, take_text
   implicit none
   private

   public :: case_outcome_t, begin_cases, put_result, put_failure, end_cases, take_header, take_case, case_words

   !> Where count and layout stand among the words
   integer, parameter :: count_place = 2, layout_place = 3
   !> In the place of the number of nodes: profiles were asked for and could not be solved
   integer, parameter :: unsolved = -1
   !> Words of a case besides its numbers, with a remark of the usual length
   integer, parameter :: words_of_case = 27

   !> One case
   type :: case_outcome_t
      !> 0, or the kind of the error
      integer :: status = 0
      !> Message of the error, or the lines of the remarks
      character(len=:), allocatable :: text
      !> Remarks on a result
      type(remark_t), allocatable :: remarks(:)
      !> Why effects take part or not, where that was decided
      character(len=:), allocatable :: reasons
      !> Scalars [unit of the scalar]; none where there is no result
      real(wp), allocatable :: summary(:)
      !> Series, shape (angle, series) [unit of the series]; none where they are not kept
      real(wp), allocatable :: series(:, :)
      !> What is listed over hours of running or turns, shape (row, quantity) [unit of the quantity]; none where the case has none
      real(wp), allocatable :: history(:, :)
      !> Profiles across the contact; none where they are not kept
      type(ehl_record_t), allocatable :: profiles
      !> Were they asked for, and could not be solved?
      logical :: lacks_profiles = .false.
   end type case_outcome_t

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
   pure subroutine put_result(record, result, reasons, with_series, profiles)
      !> The record
      type(record_t), intent(inout) :: record
      !> The result
      type(result_t), intent(in) :: result
      !> Why effects take part or not, where that was decided; may be empty
      character(len=*), intent(in) :: reasons
      !> Are its series kept?
      logical, intent(in) :: with_series
      !> Profiles at the angles of the result, where they are kept
      type(ehl_record_t), intent(in), optional :: profiles

      integer :: i

      call put_integer(record, 0)
      call put_integer(record, merge(1, 0, with_series))
      if (present(profiles)) then
         call put_integer(record, size(profiles%nodes))
      else
         call put_integer(record, merge(unsolved, 0, result%lacks_profiles))
      end if
      call put_integer(record, size(result%remarks))
      do i = 1, size(result%remarks)
         call put_integer(record, result%remarks(i)%kind)
         call put_integer(record, result%remarks(i)%lobe)
         call put_numbers(record, [result%remarks(i)%size, result%remarks(i)%excess])
         call put_text(record, result%remarks(i)%text)
      end do
      call put_text(record, reasons)
      call put_numbers(record, result%summary_values)
      if (allocated(result%history_values)) then
         call put_integer(record, size(result%history_values, 1))
         do i = 1, size(result%history_values, 2)
            call put_numbers(record, result%history_values(:, i))
         end do
      else
         call put_integer(record, 0)
      end if
      if (with_series) then
         do i = 1, size(result%series_values, 2)
            call put_numbers(record, result%series_values(:, i))
         end do
      end if
      if (present(profiles)) call put_profiles(record, profiles)
   end subroutine put_result

   !> Add profiles.
   pure subroutine put_profiles(record, profiles)
      type(record_t), intent(inout) :: record
      type(ehl_record_t), intent(in) :: profiles

      integer :: i

      call put_integer(record, merge(1, 0, allocated(profiles%film_rise)))
      call put_numbers(record, profiles%angle)
      call put_numbers(record, profiles%nodes)
      do i = 1, profile_quantities
         call put_numbers(record, profiles%values(:, i))
      end do
      do i = 1, size(profiles%angle)
         call put_numbers(record, profiles%pressure(:, i))
         call put_numbers(record, profiles%film(:, i))
         if (allocated(profiles%film_rise)) call put_numbers(record, profiles%film_rise(:, i))
      end do
   end subroutine put_profiles

   !> Add a failure.
   pure subroutine put_failure(record, failure)
      !> The record
      type(record_t), intent(inout) :: record
      !> What went wrong
      type(error_t), intent(in) :: failure

      call put_integer(record, failure%kind)
      call put_integer(record, 0)
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
      type(case_outcome_t), intent(inout) :: outcome

      ! Size of a remark [unit of its kind], and what decides between equal ones [-]
      real(wp) :: numbers(2)
      integer :: has_series, nodes, count, i

      call take_integer(record, outcome%status)
      call take_integer(record, has_series)
      call take_integer(record, nodes)
      if (outcome%status /= 0) call take_text(record, outcome%text)
      if (allocated(outcome%series)) deallocate (outcome%series)
      if (allocated(outcome%history)) deallocate (outcome%history)
      if (allocated(outcome%profiles)) deallocate (outcome%profiles)
      outcome%lacks_profiles = nodes == unsolved
      outcome%reasons = ""
      if (outcome%status /= 0) return
      call take_integer(record, count)
      if (allocated(outcome%remarks)) deallocate (outcome%remarks)
      allocate (outcome%remarks(count))
      do i = 1, count
         call take_integer(record, outcome%remarks(i)%kind)
         call take_integer(record, outcome%remarks(i)%lobe)
         call take_numbers(record, numbers)
         outcome%remarks(i)%size = numbers(1)
         outcome%remarks(i)%excess = numbers(2)
         call take_text(record, outcome%remarks(i)%text)
      end do
      outcome%text = remark_lines(outcome%remarks)
      call take_text(record, outcome%reasons)
      if (allocated(outcome%summary)) then
         if (size(outcome%summary) /= size(layout%summary)) deallocate (outcome%summary)
      end if
      if (.not. allocated(outcome%summary)) allocate (outcome%summary(size(layout%summary)))
      call take_numbers(record, outcome%summary)
      call take_integer(record, count)
      if (count > 0) then
         allocate (outcome%history(count, size(layout%history)))
         do i = 1, size(layout%history)
            call take_numbers(record, outcome%history(:, i))
         end do
      end if
      if (has_series > 0) then
         allocate (outcome%series(size(layout%angle), size(layout%series)))
         do i = 1, size(layout%series)
            call take_numbers(record, outcome%series(:, i))
         end do
      end if
      if (nodes <= 0) return
      allocate (outcome%profiles)
      call take_profiles(record, nodes, size(layout%angle), outcome%profiles)
   end subroutine take_case

   !> Take profiles.
   pure subroutine take_profiles(record, nodes, angles, profiles)
      type(record_t), intent(inout) :: record
      !> Nodes across the contact, cam angles
      integer, intent(in) :: nodes, angles
      type(ehl_record_t), intent(inout) :: profiles

      integer :: i, has_rise

      call take_integer(record, has_rise)
      allocate (profiles%angle(angles), profiles%nodes(nodes), profiles%values(angles, profile_quantities))
      allocate (profiles%pressure(nodes, angles), profiles%film(nodes, angles))
      if (has_rise > 0) allocate (profiles%film_rise(nodes, angles))
      call take_numbers(record, profiles%angle)
      call take_numbers(record, profiles%nodes)
      do i = 1, profile_quantities
         call take_numbers(record, profiles%values(:, i))
      end do
      do i = 1, angles
         call take_numbers(record, profiles%pressure(:, i))
         call take_numbers(record, profiles%film(:, i))
         if (has_rise > 0) call take_numbers(record, profiles%film_rise(:, i))
      end do
   end subroutine take_profiles

   !> Words that a case takes.
   pure function case_words(result, with_series, profiles) result(words)
      !> A result
      type(result_t), intent(in) :: result
      !> Are its series kept?
      logical, intent(in) :: with_series
      !> Its profiles, where they are kept
      type(ehl_record_t), intent(in), optional :: profiles
      !> Number of words
      integer :: words

      words = words_of_case + size(result%summary_values)
      if (allocated(result%history_values)) words = words + size(result%history_values)
      if (with_series) words = words + size(result%series_values)
      if (.not. present(profiles)) return
      words = words + 1 + size(profiles%angle) + size(profiles%nodes) + size(profiles%values) + 2*size(profiles%pressure)
      if (allocated(profiles%film_rise)) words = words + size(profiles%film_rise)
   end function case_words

end module camroller_case_record
