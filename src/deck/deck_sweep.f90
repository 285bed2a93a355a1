!> Cases of a sweep: which keys vary, over which values, and what each case has for them.
!>
!> In: a sweep as `camroller_deck_sweep_read` read it; the number of a case. Out: overrides, values, words. In a
!> grid the last key varies fastest; in lists and tables every key takes its next value from case to case; in a sample a point
!> of the unit cube is spread over the ranges. A deck without &sweep is a sweep of one case. Every case is found by its number
!> alone, and nothing is held for cases but the lists that the deck gives.
module camroller_deck_sweep
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_case_columns, only : nothing_measured
   use camroller_kinds, only : wp, not_a_number
   use camroller_names, only : name_length
   use camroller_quotes, only : without_quotes
   use camroller_number_text, only : append_number, integer_text
   use camroller_text_list, only : first_repeated, new_text_list, put_text_at, text_list_t, text_at
   use camroller_samples, only : sample_names, sample_sobol, sample_latin_hypercube, sample_independent
   use camroller_deck_matching, only : override_t
   implicit none
   private

   public :: sweep_t, sweep_axis_t, sweep_kind_names, scale_names, is_sample, most_cases
   public :: axis_of, sweep_size, axis_size, repeated_value, sweep_position, sweep_overrides, get_sweep_value, get_values_beside
   public :: sweep_numbers, sweep_words
   public :: measured_numbers
   public :: case_in_words, first_case

   !> Ways to make cases of values
   character(len=*), parameter :: sweep_kind_names(*) = [character(len=name_length) :: "grid", "zip", "table", sample_names]
   !> Ways to divide a range
   character(len=*), parameter :: scale_names(*) = [character(len=name_length) :: "linear", "logarithmic"]
   !> Most cases: they are counted in default integers
   integer, parameter :: most_cases = 2000000000
   !> Digits of a value from a range: fewer than a number holds, so that text and number are the same
   integer, parameter :: value_digits = 15
   !> Digits that tell any two numbers apart, and characters that take a number of so many
   integer, parameter :: all_digits = 17, number_width = 32

   !> One key that varies: a list of values, or a range
   type :: sweep_axis_t
      !> As `group.key`
      character(len=:), allocatable :: key
      !> Unit of its values; `1` for none
      character(len=name_length) :: unit = "1"
      !> Is the unit said, be it that there is none? A column of measured values may say nothing of it
      logical :: has_unit = .true.
      !> Are the values numbers, and whole ones?
      logical :: is_numeric = .false., is_whole = .false.
      !> Its values as text; none for a range
      type(text_list_t) :: values
      !> Ends of the range [unit of the key]
      real(wp) :: first = 0.0_wp, last = 0.0_wp
      !> Number of values in the range; 0 in a sample
      integer :: count = 0
      !> Is the range divided by equal ratios?
      logical :: is_logarithmic = .false.
   end type sweep_axis_t

   !> A sweep
   type :: sweep_t
      !> One of `sweep_kind_names`
      character(len=name_length) :: kind = "grid"
      !> Keys that vary
      type(sweep_axis_t), allocatable :: axes(:)
      !> Measured values of each case, which a table carries along; the key is the name of the column
      type(sweep_axis_t), allocatable :: measured(:)
      !> Number of points of a sample
      integer :: points = 0
      !> Seed of a sample
      integer :: seed = 0
   end type sweep_t

contains

   !> Is a sweep a sample?
   pure function is_sample(sweep) result(verdict)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Is it?
      logical :: verdict

      verdict = any(sweep%kind == sample_names)
   end function is_sample

   !> Position of a key among those that vary, 0 where it does not.
   pure function axis_of(sweep, key) result(position)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> The position
      integer :: position

      do position = size(sweep%axes), 1, -1
         if (sweep%axes(position)%key == key) return
      end do
   end function axis_of

   !> Number of values of a key.
   pure function axis_size(axis) result(values)
      !> The key
      type(sweep_axis_t), intent(in) :: axis
      !> Number of its values
      integer :: values

      values = axis%count
      if (axis%values%count > 0) values = axis%values%count
   end function axis_size

   !> The first value of a key that it has before; 0 where there is none. In a range of numbers that are not whole all differ where
   !> two do.
   pure function repeated_value(axis) result(position)
      !> The key
      type(sweep_axis_t), intent(in) :: axis
      !> The value, from 1
      integer :: position

      ! Each number as text in the same way, names without quotes
      type(text_list_t) :: values
      character(len=:), allocatable :: text, before
      real(wp) :: number ! [unit of the key]
      integer :: i, status

      if (axis%values%count == 0) then
         before = ""
         do position = 1, merge(axis%count, 2, axis%is_whole)
            call range_value(axis, real(position - 1, wp)/real(axis%count - 1, wp), text)
            if (text == before) return
            before = text
         end do
         position = 0
      else
         call new_text_list(values, axis%values%count, max(axis%values%width, number_width))
         do i = 1, values%count
            text = without_quotes(text_at(axis%values, i))
            status = 1
            if (axis%is_numeric) read (text, *, iostat=status) number
            if (status == 0) then
               text = ""
               call append_number(text, number, all_digits)
            end if
            call put_text_at(values, i, text)
         end do
         position = first_repeated(values)
      end if
   end function repeated_value

   !> Number of cases; 0 where there are too many.
   pure function sweep_size(sweep) result(cases)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of cases
      integer :: cases

      integer :: i

      cases = 1
      if (size(sweep%axes) == 0) return
      if (is_sample(sweep)) then
         cases = sweep%points
      else if (sweep%kind /= "grid") then
         cases = axis_size(sweep%axes(1))
      else
         do i = 1, size(sweep%axes)
            if (int(cases, int64)*axis_size(sweep%axes(i)) > most_cases) then
               cases = 0
               return
            end if
            cases = cases*axis_size(sweep%axes(i))
         end do
      end if
   end function sweep_size

   !> Place of a case along each key of a grid, of lists or of a table.
   pure function sweep_position(sweep, case_number) result(position)
      !> The sweep, no sample
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> Place among the values of each key, from 1
      integer :: position(size(sweep%axes))

      integer :: rest, i

      position = case_number
      if (sweep%kind /= "grid") return
      rest = case_number - 1
      do i = size(sweep%axes), 1, -1
         position(i) = modulo(rest, axis_size(sweep%axes(i))) + 1
         rest = rest/axis_size(sweep%axes(i))
      end do
   end function sweep_position

   !> Value of a key in a case, as text: a number, or a name in quotes where the deck has them.
   pure subroutine get_sweep_value(sweep, axis, case_number, text)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the key
      integer, intent(in) :: axis
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> The value
      character(len=:), allocatable, intent(out) :: text

      integer :: position(size(sweep%axes))

      if (is_sample(sweep)) then
         call spread_value(sweep%axes(axis), coordinate_of(sweep, axis, case_number), text)
      else
         position = sweep_position(sweep, case_number)
         if (sweep%axes(axis)%values%count > 0) then
            text = text_at(sweep%axes(axis)%values, position(axis))
         else
            call range_value(sweep%axes(axis), real(position(axis) - 1, wp)/real(sweep%axes(axis)%count - 1, wp), text)
         end if
      end if
   end subroutine get_sweep_value

   !> First case in which a key that is no number has a value; 0 where there is none.
   pure function first_case(sweep, axis, word) result(case_number)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the key
      integer, intent(in) :: axis
      !> The value, without quotes
      character(len=*), intent(in) :: word
      !> Number of the case, from 1
      integer :: case_number

      character(len=:), allocatable :: text
      integer :: stride, last, i

      stride = 1
      last = sweep_size(sweep)
      if (sweep%kind == "grid") then
         do i = axis + 1, size(sweep%axes)
            stride = stride*axis_size(sweep%axes(i))
         end do
         last = stride*axis_size(sweep%axes(axis))
      end if
      do case_number = 1, last, stride
         call get_sweep_value(sweep, axis, case_number, text)
         if (without_quotes(text) == word) return
      end do
      case_number = 0
   end function first_case

   !> Values of the keys that vary and are not in some groups: cases that have them in common differ in these groups alone.
   pure subroutine get_values_beside(sweep, case_number, groups, text)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> Names of the groups
      character(len=*), intent(in) :: groups(:)
      !> The values
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: value
      integer :: i

      text = ""
      do i = 1, size(sweep%axes)
         associate (key => sweep%axes(i)%key)
            if (any(key(:index(key, ".") - 1) == groups)) cycle
         end associate
         call get_sweep_value(sweep, i, case_number, value)
         text = text//value//new_line("a")
      end do
   end subroutine get_values_beside

   !> Coordinate of a case of a sample along a key.
   pure function coordinate_of(sweep, axis, case_number) result(coordinate)
      !> The sample
      type(sweep_t), intent(in) :: sweep
      !> Number of the key
      integer, intent(in) :: axis
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> From 0 to 1 [-]
      real(wp) :: coordinate

      select case (sweep%kind)
      case ("sobol")
         coordinate = sample_sobol(case_number - 1, axis, sweep%seed)
      case ("latin_hypercube")
         coordinate = sample_latin_hypercube(case_number - 1, sweep%points, axis, sweep%seed)
      case default
         coordinate = sample_independent(case_number - 1, axis, sweep%seed)
      end select
   end function coordinate_of

   !> Value of a key at a coordinate of the unit cube: lists and whole numbers have equal shares of it.
   pure subroutine spread_value(axis, coordinate, text)
      !> The key
      type(sweep_axis_t), intent(in) :: axis
      !> From 0 to 1 [-]
      real(wp), intent(in) :: coordinate
      !> The value
      character(len=:), allocatable, intent(out) :: text

      !> Ends of a range of whole numbers [-]
      real(wp) :: first, last

      if (axis%values%count > 0) then
         text = text_at(axis%values, 1 + min(axis%values%count - 1, int(coordinate*axis%values%count)))
      else if (axis%is_whole .and. .not. axis%is_logarithmic) then
         first = min(axis%first, axis%last)
         last = max(axis%first, axis%last)
         text = integer_text(int(min(last, first + aint(coordinate*(last - first + 1.0_wp)))))
      else
         call range_value(axis, coordinate, text)
      end if
   end subroutine spread_value

   !> Value at a part of a range.
   pure subroutine range_value(axis, part, text)
      !> The key
      type(sweep_axis_t), intent(in) :: axis
      !> From 0 at the first value to 1 at the last [-]
      real(wp), intent(in) :: part
      !> The value
      character(len=:), allocatable, intent(out) :: text

      !> The value [unit of the key]
      real(wp) :: value

      if (axis%is_logarithmic) then
         value = axis%first*(axis%last/axis%first)**part
      else
         value = axis%first + (axis%last - axis%first)*part
      end if
      if (axis%is_whole) then
         text = integer_text(nint(value))
      else
         text = ""
         call append_number(text, value, value_digits)
      end if
   end subroutine range_value

   !> What is different in a case.
   pure subroutine sweep_overrides(sweep, case_number, overrides)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> One override for each key that varies
      type(override_t), allocatable, intent(out) :: overrides(:)

      character(len=:), allocatable :: value
      integer :: i

      allocate (overrides(size(sweep%axes)))
      do i = 1, size(sweep%axes)
         call get_sweep_value(sweep, i, case_number, value)
         overrides(i)%text = sweep%axes(i)%key//"="//value
      end do
   end subroutine sweep_overrides

   !> Length of a case in words.
   pure function length_in_words(sweep, case_number) result(length)
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> The length
      integer :: length

      character(len=:), allocatable :: text

      call describe_case(sweep, case_number, text)
      length = len(text)
   end function length_in_words

   !> A case in words: its number as in result files, from 0, and what is different in it.
   pure function case_in_words(sweep, case_number) result(words)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> The words
      character(len=length_in_words(sweep, case_number)) :: words

      character(len=:), allocatable :: text

      call describe_case(sweep, case_number, text)
      words = text
   end function case_in_words

   !> Describe a case.
   pure subroutine describe_case(sweep, case_number, words)
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      character(len=:), allocatable, intent(out) :: words

      type(override_t), allocatable :: overrides(:)
      integer :: i

      words = "case "//integer_text(case_number - 1)
      call sweep_overrides(sweep, case_number, overrides)
      do i = 1, size(overrides)
         words = words//merge(" (", ", ", i == 1)//overrides(i)%text
      end do
      if (size(overrides) > 0) words = words//")"
   end subroutine describe_case

   !> Values of one key that varies, for every case.
   subroutine sweep_numbers(sweep, axis, numbers)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the key
      integer, intent(in) :: axis
      !> Its value in each case [unit of the key]
      real(wp), allocatable, intent(out) :: numbers(:)

      character(len=:), allocatable :: text
      integer :: i

      allocate (numbers(sweep_size(sweep)))
      do i = 1, size(numbers)
         call get_sweep_value(sweep, axis, i, text)
         read (text, *) numbers(i)
      end do
   end subroutine sweep_numbers

   !> Measured values of one kind, for every case.
   subroutine measured_numbers(sweep, column, numbers)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the column
      integer, intent(in) :: column
      !> Its value in each case, no number where nothing was measured [unit of the column]
      real(wp), allocatable, intent(out) :: numbers(:)

      character(len=:), allocatable :: text
      integer :: i

      associate (cells => sweep%measured(column)%values)
         allocate (numbers(cells%count), source=not_a_number())
         do i = 1, size(numbers)
            text = text_at(cells, i)
            if (text /= nothing_measured) read (text, *) numbers(i)
         end do
      end associate
   end subroutine measured_numbers

   !> Names of one key that varies, for every case, without quotes.
   subroutine sweep_words(sweep, axis, words)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Number of the key
      integer, intent(in) :: axis
      !> Its value in each case
      character(len=:), allocatable, intent(out) :: words(:)

      character(len=:), allocatable :: word
      integer :: i, length

      length = sweep%axes(axis)%values%width
      allocate (character(len=length) :: words(sweep_size(sweep)))
      do i = 1, size(words)
         call get_sweep_value(sweep, axis, i, word)
         words(i) = without_quotes(word)
      end do
   end subroutine sweep_words

end module camroller_deck_sweep
