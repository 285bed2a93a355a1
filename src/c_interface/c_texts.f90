!> Texts and errors between C and Fortran.
!>
!> In: texts of C, errors of ours. Out: texts of Fortran, filled buffers, the caller's error struct.
module camroller_c_texts
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_f_pointer, c_int, c_null_char, c_ptr, c_size_t
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_system_file, only : text_at_address
   implicit none
   private

   public :: take_text, give_text, give_error, refuse_null, has_place

   !> Room for a message, as the header has it
   integer, parameter :: message_room = 4096

   !> The caller's error struct; `size` is set by the caller
   type, bind(C) :: c_error_t
      integer(c_size_t) :: size
      integer(c_int) :: code
      integer(c_int) :: cause
      character(kind=c_char) :: message(message_room)
   end type c_error_t

contains

   !> Text of Fortran from one of C; empty for NULL.
   subroutine take_text(address, text)
      !> Where the text of C is
      type(c_ptr), intent(in) :: address
      !> The same in Fortran
      character(len=:), allocatable, intent(out) :: text

      text = ""
      if (c_associated(address)) call text_at_address(address, text)
   end subroutine take_text

   !> Fill a caller's buffer with a text and a zero; what does not fit is cut.
   subroutine give_text(text, address, room)
      !> The text
      character(len=*), intent(in) :: text
      !> The buffer; NULL takes nothing
      type(c_ptr), intent(in) :: address
      !> Its size
      integer(c_size_t), intent(in) :: room

      character(kind=c_char), pointer :: letters(:)
      integer :: i, length

      if (.not. c_associated(address) .or. room < 1) return
      call c_f_pointer(address, letters, [room])
      length = int(min(int(len(text), c_size_t), room - 1))
      do i = 1, length
         letters(i) = text(i:i)
      end do
      letters(length + 1) = c_null_char
   end subroutine give_text

   !> Fill the caller's error struct; the code is 0 where there is no error.
   subroutine give_error(error, address, code)
      !> The error, if any
      type(error_t), allocatable, intent(in) :: error
      !> The caller's struct; NULL takes nothing
      type(c_ptr), intent(in) :: address
      !> What the call returns
      integer(c_int), intent(out) :: code

      type(c_error_t), pointer :: given
      integer :: i, length

      code = 0
      if (allocated(error)) code = int(error%kind, c_int)
      if (.not. c_associated(address)) return
      call c_f_pointer(address, given)
      ! A caller of an older header has a smaller struct, which is left alone but for what it has
      if (given%size < 16_c_size_t) return
      given%code = code
      given%cause = 0
      length = 0
      if (allocated(error)) then
         given%cause = int(error%cause, c_int)
         length = int(min(int(len(error%message), c_size_t), min(given%size - 16_c_size_t, int(message_room, c_size_t)) - 1))
         do i = 1, length
            given%message(i) = error%message(i:i)
         end do
      end if
      if (given%size > 16_c_size_t) given%message(max(length, 0) + 1) = c_null_char
   end subroutine give_error

   !> Refuse an argument that is NULL.
   subroutine refuse_null(address, name, error)
      !> The argument
      type(c_ptr), intent(in) :: address
      !> Its name in the header
      character(len=*), intent(in) :: name
      !> Usage error; left alone where there is one
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error) .or. c_associated(address)) return
      call raise(error, kind_usage, "the argument '"//name//"' is NULL")
   end subroutine refuse_null

   !> Is there something at a place? Sizes of C have no sign: the largest of them are negative here.
   pure function has_place(place, count) result(has)
      !> The place, from 0
      integer(c_size_t), intent(in) :: place
      !> How many there are
      integer, intent(in) :: count
      !> The answer
      logical :: has

      has = place >= 0 .and. place < count
   end function has_place

end module camroller_c_texts
