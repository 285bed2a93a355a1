!> A list of texts in one string, each in a field of the same width: a component that can be copied.
!>
!> Layer: io. In: texts. Out: the same by position. Arrays of texts whose length is found at run time do not survive the copy
!> of the object that they are a component of with every compiler; a single text does.
module camroller_text_list
   implicit none
   private

   public :: text_list_t, new_text_list, put_text_at, text_at

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

   !> Give a place a text.
   pure subroutine put_text_at(list, position, text)
      !> The list
      type(text_list_t), intent(inout) :: list
      !> Position, from 1
      integer, intent(in) :: position
      !> The text; what does not fit is cut
      character(len=*), intent(in) :: text

      list%fields((position - 1)*list%width + 1:position*list%width) = text
   end subroutine put_text_at

   !> Text at a place, without the blanks at its end.
   pure function text_at(list, position) result(text)
      !> The list
      type(text_list_t), intent(in) :: list
      !> Position, from 1
      integer, intent(in) :: position
      !> The text
      character(len=:), allocatable :: text

      text = trim(list%fields((position - 1)*list%width + 1:position*list%width))
   end function text_at

end module camroller_text_list
