!> Remarks of many cases by kind: how many cases have one, and which has the worst.
!>
!> In: remarks of cases, one after the other. Out: one group for each kind. A remark's kind are its words before its
!> first number, behind the lobe that it may begin with; that number says how bad it is.
module camroller_remarks
   use camroller_kinds, only : wp
   use camroller_number_text, only : is_number, is_beyond_range
   implicit none
   private

   public :: remark_group_t, remarks_t, note_remarks

   !> Remarks of one kind
   type :: remark_group_t
      !> Words before the first number
      character(len=:), allocatable :: kind
      !> The worst remark
      character(len=:), allocatable :: worst
      !> Its number [any]
      real(wp) :: size = 0.0_wp
      !> Its case, from 1
      integer :: case_number = 0
      !> Cases with a remark of this kind, and the last of them
      integer :: cases = 0, last_case = 0
   end type remark_group_t

   !> Remarks of all cases
   type :: remarks_t
      !> In the order in which kinds were met
      type(remark_group_t), allocatable :: groups(:)
   end type remarks_t

   !> What begins a remark on one lobe of several
   character(len=*), parameter :: lobe = "lobe "

contains

   !> Take note of the remarks of a case.
   pure subroutine note_remarks(remarks, case_number, text)
      !> Remarks so far
      type(remarks_t), intent(inout) :: remarks
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> Its remarks, one per line; may be empty
      character(len=*), intent(in) :: text

      integer :: first, last

      if (.not. allocated(remarks%groups)) allocate (remarks%groups(0))
      first = 1
      do while (first <= len_trim(text))
         last = index(text(first:), new_line("a"))
         last = merge(len_trim(text), first + last - 2, last == 0)
         if (last >= first) call note_remark(remarks, case_number, text(first:last))
         first = last + 2
      end do
   end subroutine note_remarks

   !> Take note of one remark.
   pure subroutine note_remark(remarks, case_number, text)
      !> Remarks so far
      type(remarks_t), intent(inout) :: remarks
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> The remark
      character(len=*), intent(in) :: text

      ! Number of the remark [-]
      real(wp) :: size
      integer :: last, i

      call find_kind(text, last, size)
      do i = 1, ubound(remarks%groups, 1)
         if (remarks%groups(i)%kind == text(:last)) exit
      end do
      if (i > ubound(remarks%groups, 1)) then
         remarks%groups = [remarks%groups, remark_group_t(text(:last), text, size, case_number)]
      else if (size > remarks%groups(i)%size) then
         remarks%groups(i)%worst = text
         remarks%groups(i)%size = size
         remarks%groups(i)%case_number = case_number
      end if
      associate (group => remarks%groups(i))
         if (group%last_case /= case_number) group%cases = group%cases + 1
         group%last_case = case_number
      end associate
   end subroutine note_remark

   !> Kind and number of a remark.
   pure subroutine find_kind(text, last, size)
      !> The remark
      character(len=*), intent(in) :: text
      !> Where the words of its kind end
      integer, intent(out) :: last
      !> Its number; zero where it has none [-]
      real(wp), intent(out) :: size

      integer :: first, place, length

      first = 1
      if (index(text, lobe) == 1) first = max(1, index(text, ": ") + 2)
      size = 0.0_wp
      place = scan(text(first:), "0123456789")
      last = len(text)
      if (place == 0) return
      last = first + place - 2
      length = verify(text(last + 1:)//" ", "0123456789.eE+-") - 1
      if (text(last + length:last + length) == ".") length = length - 1
      associate (number => text(last + 1:last + length))
         if (.not. is_number(number)) return
         if (.not. is_beyond_range(number)) read (number, *) size
      end associate
   end subroutine find_kind

end module camroller_remarks
