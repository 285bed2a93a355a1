!> Cases, runs and results for C: `include/camroller.h` says what each call does.
!>
!> In: decks as text or file, values for keys. Out: opaque handles, numbers by name, codes.
module camroller_c_case
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_loc, c_ptr, c_size_t
   use camroller_kinds, only : degree, wp
   use camroller_blas_threads, only : use_one_blas_thread
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_version, only : version_number, version_text
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_text_file, only : folder_of, read_text_file
   use camroller_deck, only : deck_t, override_t, parse_deck, read_again, make_case, add_places
   use camroller_run, only : run_case, build_models
   use camroller_result, only : result_t, find_quantity, get_series, get_summary
   use camroller_remarks, only : remark_lines
   use camroller_c_structs, only : clear_place, give_address, give_quantity
   use camroller_c_texts, only : take_text, give_text, give_error, refuse_null, has_place
   implicit none
   private

   public :: case_handle_t

   !> A deck with its case
   type :: case_handle_t
      type(deck_t) :: deck
      type(case_t) :: case
   end type case_handle_t

   !> A result
   type :: result_handle_t
      type(result_t) :: result
   end type result_handle_t

contains

   !> Version of the library as one number.
   function library_version() bind(C, name="camroller_library_version") result(version)
      !> 10000*major + 100*minor + patch
      integer(c_int) :: version

      version = int(version_number, c_int)
   end function library_version

   !> Version of the library as text.
   subroutine library_version_text(buffer, room) bind(C, name="camroller_library_version_text")
      !> Buffer to fill
      type(c_ptr), value, intent(in) :: buffer
      !> Its size
      integer(c_size_t), value, intent(in) :: room

      call give_text(version_text, buffer, room)
   end subroutine library_version_text

   !> One thread for OpenBLAS.
   function use_one_thread() bind(C, name="camroller_use_one_blas_thread") result(is_done)
      !> 1 where the library of linear algebra is OpenBLAS, 0 where it is another one or is not found, and nothing is changed
      integer(c_int) :: is_done

      logical :: is_found

      call use_one_blas_thread(is_found)
      is_done = merge(1_c_int, 0_c_int, is_found)
   end function use_one_thread

   !> Case from the text of a deck.
   function case_from_text(text, folder, handle, error) bind(C, name="camroller_case_from_text") result(code)
      !> Text of the deck; folder that paths in it start at, NULL for the present one
      type(c_ptr), value, intent(in) :: text, folder
      !> Gets the case, NULL where there is an error
      type(c_ptr), value, intent(in) :: handle
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(error_t), allocatable :: failure
      character(len=:), allocatable :: deck, place

      call refuse_null(text, "text", failure)
      call clear_place(handle, failure)
      if (.not. allocated(failure)) then
         call take_text(text, deck)
         call take_text(folder, place)
         if (len(place) > 0) place = place//"/"
         call new_case(deck, "text", place, handle, failure)
      end if
      call give_error(failure, error, code)
   end function case_from_text

   !> Case from the file of a deck.
   function case_from_file(path, handle, error) bind(C, name="camroller_case_from_file") result(code)
      !> Path of the deck
      type(c_ptr), value, intent(in) :: path
      !> Gets the case, NULL where there is an error
      type(c_ptr), value, intent(in) :: handle
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(error_t), allocatable :: failure
      character(len=:), allocatable :: name, deck

      call refuse_null(path, "path", failure)
      call clear_place(handle, failure)
      if (.not. allocated(failure)) then
         call take_text(path, name)
         call read_text_file(name, deck, failure)
         if (.not. allocated(failure)) call new_case(deck, name, folder_of(name), handle, failure)
      end if
      call give_error(failure, error, code)
   end function case_from_file

   !> Read a deck and make its case.
   subroutine new_case(text, name, folder, handle, error)
      !> Text, name for messages, folder of the deck
      character(len=*), intent(in) :: text, name, folder
      !> Gets the case
      type(c_ptr), intent(in) :: handle
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(case_handle_t), pointer :: made
      type(override_t) :: none(0)

      allocate (made)
      call parse_deck(made%deck, text, name, folder, none, error)
      if (.not. allocated(error)) call make_case(made%deck, none, made%case, error)
      if (allocated(error)) then
         deallocate (made)
         return
      end if
      call give_address(handle, c_loc(made))
   end subroutine new_case

   !> Give a key another value, in the unit of the deck.
   function case_set(handle, key, value, error) bind(C, name="camroller_case_set") result(code)
      !> The case; left as it was where there is an error
      type(c_ptr), value, intent(in) :: handle
      !> `group.key`, and its value as a deck has it
      type(c_ptr), value, intent(in) :: key, value
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_case", failure)
      call refuse_null(key, "key", failure)
      call refuse_null(value, "value", failure)
      if (.not. allocated(failure)) call set_values(handle, [key], [value], failure)
      call give_error(failure, error, code)
   end function case_set

   !> Give several keys other values together.
   function case_set_all(handle, count, keys, values, error) bind(C, name="camroller_case_set_all") result(code)
      !> The case; left as it was where there is an error
      type(c_ptr), value, intent(in) :: handle
      !> Number of keys
      integer(c_size_t), value, intent(in) :: count
      !> Keys and values, as for `case_set`
      type(c_ptr), value, intent(in) :: keys, values
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(c_ptr), pointer :: names(:), texts(:)
      type(error_t), allocatable :: failure
      integer(c_size_t) :: i

      call refuse_null(handle, "camroller_case", failure)
      call refuse_null(keys, "keys", failure)
      call refuse_null(values, "values", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(keys, names, [count])
         call c_f_pointer(values, texts, [count])
         do i = 1, count
            call refuse_null(names(i), "key", failure)
            call refuse_null(texts(i), "value", failure)
         end do
      end if
      if (.not. allocated(failure)) call set_values(handle, names, texts, failure)
      call give_error(failure, error, code)
   end function case_set_all

   !> Give keys of a case other values, as a deck would that has all of them.
   subroutine set_values(handle, keys, values, error)
      !> The case; left as it was where there is an error
      type(c_ptr), intent(in) :: handle
      !> Texts of C, none of them NULL
      type(c_ptr), intent(in) :: keys(:), values(:)
      !> Deck error with all mistakes
      type(error_t), allocatable, intent(out) :: error

      type(case_handle_t), pointer :: given
      type(deck_t) :: deck
      type(case_t) :: case
      type(override_t) :: none(0)
      type(override_t), allocatable :: overrides(:)
      character(len=:), allocatable :: name, text
      integer :: count, i

      if (size(keys) == 0) return
      call c_f_pointer(handle, given)
      count = size(given%deck%overrides)
      allocate (overrides(count + size(keys)))
      overrides(:count) = given%deck%overrides
      do i = 1, size(keys)
         call take_text(keys(i), name)
         call take_text(values(i), text)
         overrides(count + i)%text = name//"="//text
      end do
      call read_again(deck, given%deck, overrides, error)
      if (.not. allocated(error)) call make_case(deck, none, case, error)
      if (allocated(error)) return
      given%deck = deck
      given%case = case
   end subroutine set_values

   !> Check a case without running it: laws, geometry, oil.
   function case_check(handle, error) bind(C, name="camroller_case_check") result(code)
      !> The case
      type(c_ptr), value, intent(in) :: handle
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_case", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call build_models(given%case, models, failure)
         call add_places(given%deck, failure)
      end if
      call give_error(failure, error, code)
   end function case_check

   !> Free a case; NULL is nothing to free.
   subroutine case_free(handle) bind(C, name="camroller_case_free")
      !> The case
      type(c_ptr), value, intent(in) :: handle

      type(case_handle_t), pointer :: given

      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      deallocate (given)
   end subroutine case_free

   !> Run a case.
   function run(handle, out, error) bind(C, name="camroller_case_run") result(code)
      !> The case; read only, so that threads may share it
      type(c_ptr), value, intent(in) :: handle
      !> Gets the result, NULL where there is an error
      type(c_ptr), value, intent(in) :: out
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(case_handle_t), pointer :: given
      type(result_handle_t), pointer :: made
      type(error_t), allocatable :: failure

      call refuse_null(handle, "camroller_case", failure)
      call clear_place(out, failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         allocate (made)
         call run_case(given%case, made%result, failure)
         call add_places(given%deck, failure)
         if (allocated(failure)) then
            deallocate (made)
         else
            call give_address(out, c_loc(made))
         end if
      end if
      call give_error(failure, error, code)
   end function run

   !> Free a result; NULL is nothing to free.
   subroutine result_free(handle) bind(C, name="camroller_result_free")
      !> The result
      type(c_ptr), value, intent(in) :: handle

      type(result_handle_t), pointer :: given

      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      deallocate (given)
   end subroutine result_free

   !> Scalar of a result by name.
   function result_scalar(handle, name, value, error) bind(C, name="camroller_result_scalar") result(code)
      !> The result, the name
      type(c_ptr), value, intent(in) :: handle, name
      !> Gets the value
      type(c_ptr), value, intent(in) :: value
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(result_handle_t), pointer :: given
      ! The caller's value, ours [unit of the scalar]
      real(c_double), pointer :: number
      real(wp) :: found
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: word

      call refuse_null(handle, "camroller_result", failure)
      call refuse_null(name, "name", failure)
      call refuse_null(value, "value", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call c_f_pointer(value, number)
         call take_text(name, word)
         call get_summary(given%result, word, found, failure)
         if (.not. allocated(failure)) number = found
      end if
      call give_error(failure, error, code)
   end function result_scalar

   !> Number of rows of the series of a result; 0 for NULL.
   function result_rows(handle) bind(C, name="camroller_result_rows") result(rows)
      !> The result
      type(c_ptr), value, intent(in) :: handle
      !> Cam angles of a series
      integer(c_size_t) :: rows

      type(result_handle_t), pointer :: given

      rows = 0
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      rows = size(given%result%angle, kind=c_size_t)
   end function result_rows

   !> Series of a result by name; `cam_angle` is the angle of each row.
   function result_series(handle, name, values, room, error) bind(C, name="camroller_result_series") result(code)
      !> The result, the name
      type(c_ptr), value, intent(in) :: handle, name
      !> Gets the values
      type(c_ptr), value, intent(in) :: values
      !> Numbers that there is room for
      integer(c_size_t), value, intent(in) :: room
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(result_handle_t), pointer :: given
      ! The caller's numbers, ours [unit of the series]
      real(c_double), pointer :: numbers(:)
      real(wp), allocatable :: series(:)
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: word

      call refuse_null(handle, "camroller_result", failure)
      call refuse_null(name, "name", failure)
      call refuse_null(values, "values", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call take_text(name, word)
         if (word == "cam_angle") then
            series = given%result%angle*degree
         else
            call get_series(given%result, word, series, failure)
         end if
      end if
      if (.not. allocated(failure)) then
         if (room < size(series)) then
            call raise(failure, kind_usage, "there is room for fewer numbers than the series has; ask camroller_result_rows")
         else
            call c_f_pointer(values, numbers, [room])
            numbers(:size(series)) = series
         end if
      end if
      call give_error(failure, error, code)
   end function result_series

   !> Name, unit and meaning of a series or a scalar by its number, from 0.
   function result_quantity(handle, kind, number, texts, rooms, error) bind(C, name="camroller_result_quantity") result(code)
      !> The result
      type(c_ptr), value, intent(in) :: handle
      !> 0 for series, 1 for scalars
      integer(c_int), value, intent(in) :: kind
      integer(c_size_t), value, intent(in) :: number
      !> Buffers for name, unit and meaning; NULL, each or all, takes nothing
      type(c_ptr), intent(in), optional :: texts(3)
      !> Size of each
      integer(c_size_t), value, intent(in) :: rooms
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(result_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      integer :: count

      call refuse_null(handle, "camroller_result", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         count = merge(size(given%result%series), size(given%result%summary), kind == 0)
         if (.not. has_place(number, count) .or. kind < 0 .or. kind > 1) then
            call raise(failure, kind_usage, "the result has no quantity of that number")
         else if (kind == 0) then
            call give_quantity(given%result%series(number + 1), texts, rooms)
         else
            call give_quantity(given%result%summary(number + 1), texts, rooms)
         end if
      end if
      call give_error(failure, error, code)
   end function result_quantity

   !> Unit of a series or a scalar by name.
   function result_unit(handle, name, buffer, room, error) bind(C, name="camroller_result_unit") result(code)
      !> The result, the name
      type(c_ptr), value, intent(in) :: handle, name
      !> Buffer for the unit
      type(c_ptr), value, intent(in) :: buffer
      !> Its size
      integer(c_size_t), value, intent(in) :: room
      !> Error struct or NULL
      type(c_ptr), value, intent(in) :: error
      !> 0 or the kind of the error
      integer(c_int) :: code

      type(result_handle_t), pointer :: given
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: word
      integer :: series, scalar

      call refuse_null(handle, "camroller_result", failure)
      call refuse_null(name, "name", failure)
      call refuse_null(buffer, "buffer", failure)
      if (.not. allocated(failure)) then
         call c_f_pointer(handle, given)
         call take_text(name, word)
         series = find_quantity(given%result%series, word)
         scalar = find_quantity(given%result%summary, word)
         if (word == "cam_angle") then
            call give_text("rad", buffer, room)
         else if (series > 0) then
            call give_text(trim(given%result%series(series)%unit), buffer, room)
         else if (scalar > 0) then
            call give_text(trim(given%result%summary(scalar)%unit), buffer, room)
         else
            call raise(failure, kind_usage, "the result has no series and no scalar '"//word//"'")
         end if
      end if
      call give_error(failure, error, code)
   end function result_unit

   !> Remarks of a result, one per line; empty where there are none.
   subroutine result_remarks(handle, buffer, room) bind(C, name="camroller_result_remarks")
      !> The result
      type(c_ptr), value, intent(in) :: handle
      !> Buffer to fill
      type(c_ptr), value, intent(in) :: buffer
      !> Its size
      integer(c_size_t), value, intent(in) :: room

      type(result_handle_t), pointer :: given

      call give_text("", buffer, room)
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, given)
      call give_text(remark_lines(given%result%remarks), buffer, room)
   end subroutine result_remarks

end module camroller_c_case
