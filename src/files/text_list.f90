!> A list of texts stored in one string with fields of equal width, so that a type that contains it can be copied.
!>
!> In: texts. Out: the same by index. With some compilers, arrays of texts of deferred length do not survive the copy of the
!> object that they are a component of; a single string does.
module camroller_text_list
   implicit none
   private

   public :: text_list_t, new_text_list, put_text_at, text_at, first_repeated

   !> The list
   type :: text_list_t
      !> Number of texts
      integer :: count = 0
      !> Width of a field
      integer :: width = 1
      !> All fields
      character(len=:), allocatable :: fields
   end type text_list_t

contains

   !> A list of empty texts.
   pure subroutine new_text_list(list, count, width)
      !> The list
      type(text_list_t), intent(out) :: list
      !> Number of texts
      integer, intent(in) :: count
      !> Length of the longest one
      integer, intent(in) :: width

      list%count = count
      list%width = max(1, width)
      list%fields = repeat(" ", list%count*list%width)
   end subroutine new_text_list

   !> Set the text at an index.
   pure subroutine put_text_at(list, position, text)
      !> The list
      type(text_list_t), intent(inout) :: list
      !> Position, from 1
      integer, intent(in) :: position
      !> The text; what does not fit is cut
      character(len=*), intent(in) :: text

      list%fields((position - 1)*list%width + 1:position*list%width) = text
   end subroutine put_text_at

   !> Length of a text without the blanks at its end.
   pure function text_length(list, position) result(length)
      type(text_list_t), intent(in) :: list
      !> Position, from 1
      integer, intent(in) :: position
      !> Its length
      integer :: length

      length = len_trim(list%fields((position - 1)*list%width + 1:position*list%width))
   end function text_length

   !> Text at an index, without trailing blanks.
   pure function text_at(list, position) result(text)
      !> The list
      type(text_list_t), intent(in) :: list
      !> Position, from 1
      integer, intent(in) :: position
      !> The text
      character(len=text_length(list, position)) :: text

      text = list%fields((position - 1)*list%width + 1:position*list%width)
   end function text_at

   !> The first index whose text occurs at a lower index as well; 0 where there is none.
   pure function first_repeated(list) result(position)
      !> The list
      type(text_list_t), intent(in) :: list
      !> The index
      integer :: position

      integer :: order(list%count), i

      call put_in_order(list, order)
      position = 0
      do i = 2, list%count
         if (field(list, order(i)) /= field(list, order(i - 1))) cycle
         if (position == 0 .or. order(i) < position) position = order(i)
      end do
   end function first_repeated

   !> Order of the texts, equals as they stand; by merging runs, so that long lists take little longer than short ones.
   pure subroutine put_in_order(list, order)
      type(text_list_t), intent(in) :: list
      !> Places in order
      integer, intent(out) :: order(:)

      integer, allocatable :: before(:)
      integer :: length, start, middle, finish, i, j, k

      order = [(i, i=1, size(order))]
      length = 1
      do while (length < size(order))
         before = order
         do start = 1, size(order), 2*length
            middle = min(start + length, size(order) + 1)
            finish = min(start + 2*length, size(order) + 1)
            i = start
            j = middle
            do k = start, finish - 1
               if (takes_first(list, before, i, middle, j, finish)) then
                  order(k) = before(i)
                  i = i + 1
               else
                  order(k) = before(j)
                  j = j + 1
               end if
            end do
         end do
         length = 2*length
      end do
   end subroutine put_in_order

   !> Does the first of two runs that are merged give the next text?
   pure function takes_first(list, order, first, first_end, second, second_end) result(verdict)
      type(text_list_t), intent(in) :: list
      !> Order before the merge
      integer, intent(in) :: order(:)
      !> Next index of each run, and the index behind it
      integer, intent(in) :: first, first_end, second, second_end
      !> Does it?
      logical :: verdict

      verdict = first < first_end
      if (verdict .and. second < second_end) verdict = field(list, order(first)) <= field(list, order(second))
   end function takes_first

   !> The field at an index.
   pure function field(list, position) result(text)
      type(text_list_t), intent(in) :: list
      !> Position, from 1
      integer, intent(in) :: position
      !> Its characters, blanks at the end included
      character(len=list%width) :: text

      text = list%fields((position - 1)*list%width + 1:position*list%width)
   end function field

end module camroller_text_list
