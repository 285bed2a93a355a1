!> What a deck holds beside its case, for C: numbers that it gives, remarks on them, cases of its sweep. `include/camroller.h` says
!> what each call does.
!>
!> In: a case. Out: names, units, meanings, values; sentences; one case of the sweep.
module camroller_c_deck
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
   use camroller_error, only : error_t, raise, kind_internal, kind_usage, add_context
   use camroller_deck, only : deck_t, override_t, read_again, make_case, drop_sweep
   use camroller_deck_document, only : given_numbers
   use camroller_deck_remarks, only : list_deck_remarks
   use camroller_deck_text, only : to_lower
   use camroller_deck_sweep, only : sweep_size, sweep_overrides, get_sweep_value, case_in_words
   use camroller_text_lines, only : line_t
   use camroller_c_case, only : case_handle_t
   use camroller_c_structs, only : clear_place, give_address
   use camroller_c_texts, only : give_text, give_error, refuse_null, has_place
   implicit none
   private

contains

   !> A key that the deck gives with one number, by its place, from 0.
   function case_number(handle, number, texts, rooms, value, error) bind(C, name="camroller_case_number") result(code)
      !> The case
      type(c_ptr), value, intent(in) :: handle
      !> The place of the key
      integer(c_size_t), value, intent(in) :: number
      !> Buffers for name, unit and meaning; NULL, each or all, takes nothing
      type(c_ptr), intent(in), optional :: texts(3)
      !> Size of each
      integer(c_size_t), value, intent(in) :: rooms
      !> Gets the value in the unit of the key; NULL takes nothing
      type(c_ptr), value, intent(in) :: value
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      integer, allocatable :: positions(:)
      ! The caller's value [unit of the key]
      real(c_double), pointer :: found
      integer :: status

      call refuse_null(handle, "camroller_case", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call given_numbers(given%deck, positions)
         if (.not. has_place(number, size(positions))) call raise(failure, kind_usage, "the deck has no number of that place")
      end if
      if (.not. allocated(failure)) then
         associate (key => given%deck%schema%keys(positions(number + 1)), set => given%deck%settings%values(positions(number + 1)))
            if (present(texts)) then
               call give_text(trim(given%deck%schema%groups(key%group)%name)//"."//trim(key%name), texts(1), rooms)
               call give_text(trim(key%unit%symbol), texts(2), rooms)
               call give_text(key%meaning, texts(3), rooms)
            end if
            if (c_associated(value)) then
               call c_f_pointer(value, found)
               read (set%text, *, iostat=status) found
               if (status /= 0) call raise(failure, kind_internal, "the number of a key cannot be read")
            end if
         end associate
      end if
      call give_error(failure, error, code)
   end function case_number

   !> Remarks on the deck of a case, one per line; empty where there are none.
   subroutine case_remarks(handle, buffer, room) bind(C, name="camroller_case_remarks")
      !> The case
      type(c_ptr), value, intent(in) :: handle
      !> Buffer to fill
      type(c_ptr), value, intent(in) :: buffer
      !> Its size
      integer(c_size_t), value, intent(in) :: room

      type(case_handle_t), pointer :: given
      type(deck_t) :: deck
      type(line_t), allocatable :: remarks(:)
      character(len=:), allocatable :: text
      integer :: i

      text = ""
      if (c_associated(handle)) then
         call c_f_pointer(handle, given)
         deck = given%deck
         call drop_sweep(deck)
         call list_deck_remarks(deck, remarks, of_hosts=.true.)
         do i = 1, size(remarks)
            if (i > 1) text = text//new_line("a")
            text = text//remarks(i)%text
         end do
      end if
      call give_text(text, buffer, room)
   end subroutine case_remarks

   !> Copy of a case.
   function case_copy(handle, out, error) bind(C, name="camroller_case_copy") result(code)
      !> The case
      type(c_ptr), value, intent(in) :: handle
      !> Gets the copy, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given, made
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_case", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         allocate (made)
         made = given
         call give_address(out, c_loc(made))
      end if
      call give_error(failure, error, code)
   end function case_copy

   !> Number of cases of the deck's sweep: 1 without one, 0 for NULL.
   function case_sweep_size(handle) bind(C, name="camroller_case_sweep_size") result(cases)
      !> The case
      type(c_ptr), value, intent(in) :: handle
      !> The number
      integer(c_size_t) :: cases

      type(case_handle_t), pointer :: given

      cases = 0
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      cases = sweep_size(given%deck%sweep)
   end function case_sweep_size

   !> Name of a key that the sweep varies, and its value in a case.
   function case_sweep_value(handle, number, key, texts, rooms, error) bind(C, name="camroller_case_sweep_value") result(code)
      !> The case
      type(c_ptr), value, intent(in) :: handle
      !> Number of the case and of the key, from 0
      integer(c_size_t), value, intent(in) :: number, key
      !> Buffers for name and value; NULL, each or both, takes nothing
      type(c_ptr), intent(in), optional :: texts(2)
      !> Size of each
      integer(c_size_t), value, intent(in) :: rooms
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: text

      call refuse_null(handle, "camroller_case", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         if (.not. has_place(number, sweep_size(given%deck%sweep))) then
            call raise(failure, kind_usage, "the sweep has no case of that number")
         else if (.not. has_place(key, size(given%deck%sweep%axes))) then
            call raise(failure, kind_usage, "the sweep has no key of that number")
         end if
      end if
      if (.not. allocated(failure) .and. present(texts)) then
         call get_sweep_value(given%deck%sweep, int(key) + 1, int(number) + 1, text)
         call give_text(given%deck%sweep%axes(key + 1)%key, texts(1), rooms)
         call give_text(text, texts(2), rooms)
      end if
      call give_error(failure, error, code)
   end function case_sweep_value

   !> One case of the sweep, without a sweep of its own.
   function case_sweep_case(handle, number, out, error) bind(C, name="camroller_case_sweep_case") result(code)
      !> The case
      type(c_ptr), value, intent(in) :: handle
      !> Number of the case, from 0
      integer(c_size_t), value, intent(in) :: number
      !> Gets the case, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given, made
      type(deck_t) :: deck
      type(override_t), allocatable :: varied(:), overrides(:)
      type(override_t) :: none(0)
      type(error_t), allocatable :: failure
      integer :: count, i

      call refuse_null(handle, "camroller_case", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         if (.not. has_place(number, sweep_size(given%deck%sweep))) call raise(failure, kind_usage, &
            & "the sweep has no case of that number")
      end if
      if (.not. allocated(failure)) then
         deck = given%deck
         call sweep_overrides(deck%sweep, int(number) + 1, varied)
         call drop_sweep(deck)
         allocate (overrides(size(deck%overrides) + size(varied)))
         count = 0
         do i = 1, size(deck%overrides)
            ! Those of the sweep go with it
            if (index(to_lower(adjustl(deck%overrides(i)%text)), "sweep.") == 1) cycle
            count = count + 1
            overrides(count) = deck%overrides(i)
         end do
         overrides(count + 1:count + size(varied)) = varied
         overrides = overrides(:count + size(varied))
         allocate (made)
         call read_again(made%deck, deck, overrides, failure)
         if (.not. allocated(failure)) call make_case(made%deck, none, made%case, failure)
         if (allocated(failure)) then
            if (size(varied) > 0) call add_context(failure, case_in_words(given%deck%sweep, int(number) + 1))
            deallocate (made)
         else
            call give_address(out, c_loc(made))
         end if
      end if
      call give_error(failure, error, code)
   end function case_sweep_case

end module camroller_c_deck
