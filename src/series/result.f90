!> A result: named series over the cam angle and named scalars, each with unit, meaning and the effect it comes from.
!>
!> In: what `camroller_case_result` evaluated. Out: `result_t`, to be read by name or written to a file.
module camroller_result
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use camroller_kinds, only : wp, not_a_number
   use camroller_error, only : error_t, raise, kind_domain, kind_usage
   use camroller_effect_list, only : choice_t
   use camroller_names, only : name_length
   use camroller_number_text, only : fixed_text, integer_text
   use camroller_remarks, only : remark_t
   implicit none
   private

   public :: quantity_t, quantity_list_t, append_history, append_numbered, append_quantity, take_quantities, result_t, &
      & get_series, get_summary, find_quantity, check_numbers, is_film, lobe_scope, severest, worse_of
   public :: scope_length, series_name_length, scope_camshaft, scope_engine, scope_case

   !> Length of a scope, and of a unit
   integer, parameter :: scope_length = 28, unit_length = 16
   !> Length of the longest name of a series with room to spare: `camshaft_10_bearing_10_temperature_rise` has 39 letters
   integer, parameter :: series_name_length = 64
   !> Scopes beside those of `lobe_scope`: all followers and bearings of the camshaft, which has a number where there are several;
   !> all camshafts of the engine; the case as a whole
   character(len=*), parameter :: scope_camshaft = "camshaft", scope_engine = "engine  ", scope_case = "case"

   !> What a column of numbers means
   type :: quantity_t
      !> Name in files and in `get_series`, no blanks behind it
      character(len=:), allocatable :: name
      !> SI unit, `1` for none, `degree` for the cam angle
      character(len=unit_length) :: unit = "1"
      !> Meaning in a few words
      character(len=:), allocatable :: description
      !> Part of the model that it comes from, e.g. `asperity`
      character(len=name_length) :: source = ""
      !> What it belongs to: `lobe 1` or `lobe 2` for one follower of that lobe shape, `camshaft`, `camshaft 1`, `bearing 1`,
      !> `camshaft 1 bearing 1`, `engine`, or `case`
      character(len=scope_length) :: scope = scope_case
      !> Has infinity a meaning, as for the speed at which something that never happens would happen?
      logical :: may_be_infinite = .false.
      !> Magnitude below which it counts as none, so that errors are relative to that at least [unit of the quantity]
      real(wp) :: least = 0.0_wp
   end type quantity_t

   !> Quantities with a value each, as many as there are
   type :: quantity_list_t
      integer :: count = 0
      !> Values; those behind `count` are not set [unit of the quantity]
      real(wp), allocatable :: values(:)
      !> Their meaning; not allocated where values alone are wanted
      type(quantity_t), allocatable :: items(:)
      !> Room of the caller for values alone, as many as there are; without it the list has its own [unit of the quantity]
      real(wp), pointer, contiguous :: room(:) => null()
   end type quantity_list_t

   !> Result of one case
   type :: result_t
      !> Cam angle of each row, 0 to 360 with the nose at 180, end point left out [deg]
      real(wp), allocatable :: angle(:)
      !> Meaning of each series
      type(quantity_t), allocatable :: series(:)
      !> Values, shape (angle, series), units as in `series`
      real(wp), allocatable :: series_values(:, :)
      !> Meaning of each scalar
      type(quantity_t), allocatable :: summary(:)
      !> Values of the scalars, units as in `summary`
      real(wp), allocatable :: summary_values(:)
      !> Meaning of what is listed over hours of running, or over the turns of a flexible train that does not repeat every turn;
      !> allocated where the case has such a list
      type(quantity_t), allocatable :: history(:)
      !> Values, shape (row, quantity): rows evenly spaced in time, the first at the start, or turns; not-a-number after the last
      !> row of a list; units as in `history`
      real(wp), allocatable :: history_values(:, :)
      !> Remarks that do not make the result wrong
      type(remark_t), allocatable :: remarks(:)
      !> Name of the series whose mean has the largest estimated error; blank where means have none
      character(len=series_name_length) :: worst_mean = ""
      !> Name of the series of whose extremes one has the largest estimated error
      character(len=series_name_length) :: worst_extreme = ""
      !> Were profiles across the contact asked for that could not be solved? The reason is among the remarks
      logical :: lacks_profiles = .false.
      !> Which effects took part and why; allocated where the program chose them
      type(choice_t), allocatable :: choice
   end type result_t

contains

   !> Of a scalar of two lobe shapes the worse one: the smaller of what is smallest, else the larger in magnitude.
   elemental function worse_of(statistic, one, other) result(worse)
      !> What of a series the scalar is: `min_`, `max_`, `mean_`, or blank
      character(len=*), intent(in) :: statistic
      !> Its values [unit of the scalar]
      real(wp), intent(in) :: one, other
      !> The worse value [unit of the scalar]
      real(wp) :: worse

      if (statistic == "min_") then
         worse = min(one, other)
      else
         worse = merge(other, one, abs(other) > abs(one))
      end if
   end function worse_of

   !> Series of the severest pressure or film in a contact: where the case has the roller's profile, that of the severest place.
   elemental function severest(series, has_profile) result(name)
      !> Series of the line contact as a whole
      character(len=*), intent(in) :: series
      !> Are there series of places along the roller?
      logical, intent(in) :: has_profile
      !> The series; others than pressure and smallest film stay as they are
      character(len=name_length) :: name

      name = series
      if (.not. has_profile) return
      if (series == "hertz_pressure") name = "axial_pressure_max"
      if (series == "film_thickness_min") name = "film_thickness_axial_min"
   end function severest

   !> Is a series a film of cam and roller? It is zero without contact, and its smallest value that of the angles in contact.
   elemental function is_film(quantity) result(verdict)
      !> The series
      type(quantity_t), intent(in) :: quantity
      !> Is it?
      logical :: verdict

      verdict = index(quantity%name, "film_thickness_") > 0 .or. (index(quantity%name, "film_ratio") > 0 .and. &
         & quantity%source == "film")
   end function is_film

   !> Append a list over hours or turns to those that a result has. Shorter lists are filled up with not-a-number.
   pure subroutine append_history(result, quantities, rows)
      !> The result
      type(result_t), intent(inout) :: result
      !> What the columns mean
      type(quantity_t), intent(in) :: quantities(:)
      !> The rows, shape (row, quantity) [unit of each quantity]
      real(wp), intent(in) :: rows(:, :)

      ! All lists [unit of each quantity]
      real(wp), allocatable :: joined(:, :)
      integer :: before

      if (.not. allocated(result%history)) allocate (result%history(0), result%history_values(0, 0))
      before = size(result%history)
      allocate (joined(max(size(result%history_values, 1), size(rows, 1)), before + size(rows, 2)), source=not_a_number())
      joined(:size(result%history_values, 1), :before) = result%history_values
      joined(:size(rows, 1), before + 1:) = rows
      call move_alloc(joined, result%history_values)
      result%history = [result%history, quantities]
   end subroutine append_history

   !> Append a quantity to a list, which grows as it has to.
   pure subroutine append_quantity(list, name, unit, description, source, value, scope, least)
      !> The list; it has room of the caller, or some of its own, and items where names are wanted
      type(quantity_list_t), intent(inout) :: list
      !> Name, unit, meaning, part of the model
      character(len=*), intent(in) :: name, unit, description, source
      !> Value [unit of the quantity]
      real(wp), intent(in) :: value
      !> What it belongs to; the case as a whole where absent
      character(len=*), intent(in), optional :: scope
      !> Magnitude below which it counts as none; 0 where absent [unit of the quantity]
      real(wp), intent(in), optional :: least

      type(quantity_t), allocatable :: items(:)
      ! Longer list of values [unit of each]
      real(wp), allocatable :: values(:)

      if (associated(list%room)) then
         list%count = list%count + 1
         list%room(list%count) = value
         return
      end if
      if (list%count == size(list%values)) then
         allocate (values(2*list%count + 16))
         values(:list%count) = list%values(:list%count)
         call move_alloc(values, list%values)
      end if
      list%count = list%count + 1
      list%values(list%count) = value
      if (.not. allocated(list%items)) return
      if (list%count > size(list%items)) then
         allocate (items(size(list%values)))
         call move_quantities(list%items(:list%count - 1), items)
         call move_alloc(items, list%items)
      end if
      associate (item => list%items(list%count))
         item%name = trim(name)
         item%unit = unit
         item%description = trim(description)
         item%source = source
         if (present(scope)) item%scope = scope
         if (present(least)) item%least = least
      end associate
   end subroutine append_quantity

   !> Append a quantity with a number in its name, which also ends its meaning. Words are made only where names are wanted: rows of
   !> values are many.
   pure subroutine append_numbered(list, before, number, after, unit, description, source, value)
      !> The list, as for `append_quantity`
      type(quantity_list_t), intent(inout) :: list
      !> Name before the number and after it
      character(len=*), intent(in) :: before, after
      !> The number
      integer, intent(in) :: number
      !> Unit, meaning without the number, part of the model
      character(len=*), intent(in) :: unit, description, source
      !> Value [unit of the quantity]
      real(wp), intent(in) :: value

      if (allocated(list%items)) then
         call append_quantity(list, before//integer_text(number)//after, unit, description//" "//integer_text(number), source, &
            & value)
      else
         call append_quantity(list, "", "", "", "", value)
      end if
   end subroutine append_numbered

   !> Move quantities to other places, without copies of their texts.
   pure subroutine move_quantities(from, to)
      !> The quantities; out: without texts
      type(quantity_t), intent(inout) :: from(:)
      !> Their places, the first of as many or more
      type(quantity_t), intent(inout) :: to(:)

      integer :: i

      do i = 1, size(from)
         call move_alloc(from(i)%name, to(i)%name)
         to(i)%unit = from(i)%unit
         call move_alloc(from(i)%description, to(i)%description)
         to(i)%source = from(i)%source
         to(i)%scope = from(i)%scope
         to(i)%may_be_infinite = from(i)%may_be_infinite
         to(i)%least = from(i)%least
      end do
   end subroutine move_quantities

   !> Take the quantities out of a list, as many as there are.
   pure subroutine take_quantities(list, quantities)
      !> The list; out: without quantities
      type(quantity_list_t), intent(inout) :: list
      !> The quantities
      type(quantity_t), allocatable, intent(out) :: quantities(:)

      allocate (quantities(list%count))
      call move_quantities(list%items(:list%count), quantities)
      deallocate (list%items)
   end subroutine take_quantities

   !> Position of a quantity in a list, 0 where it is not there.
   pure function find_quantity(quantities, name) result(position)
      !> List to look in
      type(quantity_t), intent(in) :: quantities(:)
      !> Name looked for
      character(len=*), intent(in) :: name
      !> Position, or 0
      integer :: position

      integer :: length

      length = len_trim(name)
      do position = 1, size(quantities)
         ! Most names differ in length, which is told faster than whether texts are the same
         if (len(quantities(position)%name) /= length) cycle
         if (quantities(position)%name == name) return
      end do
      position = 0
   end function find_quantity

   !> Scope of what belongs to one follower.
   pure function lobe_scope(lobe) result(scope)
      !> Its lobe shape, from 1
      integer, intent(in) :: lobe
      !> The scope
      character(len=scope_length) :: scope

      scope = "lobe "//integer_text(lobe)
   end function lobe_scope

   !> Refuse a result that holds what is not a finite number, unless infinity has a meaning there.
   subroutine check_numbers(result, error)
      !> A result
      type(result_t), intent(in) :: result
      !> Domain error that names the first series or scalar, its cam angle and its value
      type(error_t), allocatable, intent(out) :: error

      integer :: i, row

      do i = 1, size(result%series)
         if (all(ieee_is_finite(result%series_values(:, i)))) cycle
         row = findloc(ieee_is_finite(result%series_values(:, i)), .false., 1)
         call refuse(result%series(i)%name, result%series_values(row, i), error, result%angle(row))
         return
      end do
      do i = 1, size(result%summary)
         if (ieee_is_finite(result%summary_values(i))) cycle
         if (result%summary(i)%may_be_infinite .and. .not. ieee_is_nan(result%summary_values(i))) cycle
         call refuse(result%summary(i)%name, result%summary_values(i), error)
         return
      end do
   end subroutine check_numbers

   !> Refuse a value that is not a finite number.
   subroutine refuse(name, value, error, angle)
      !> Name of the quantity
      character(len=*), intent(in) :: name
      !> The value [any]
      real(wp), intent(in) :: value
      !> Domain error
      type(error_t), allocatable, intent(out) :: error
      !> Cam angle, for a series [deg]
      real(wp), intent(in), optional :: angle

      character(len=:), allocatable :: words

      words = name
      if (present(angle)) words = words//" at cam angle "//fixed_text(angle, 3)//" deg"
      if (ieee_is_nan(value)) then
         words = words//" is not a number (NaN)"
      else
         words = words//" is infinite"
      end if
      call raise(error, kind_domain, words//": values of the case are so large or so small that its formulas cannot be "// &
         & "evaluated; bring them into a physical range")
   end subroutine refuse

   !> Copy of one series.
   subroutine get_series(result, name, values, error)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of the series
      character(len=*), intent(in) :: name
      !> One value for each angle [unit of the series]
      real(wp), allocatable, intent(out) :: values(:)
      !> Usage error where the result has no such series
      type(error_t), allocatable, intent(out) :: error

      integer :: position

      position = find_quantity(result%series, name)
      if (position == 0) then
         call raise(error, kind_usage, "the result has no series '"//name//"'")
         return
      end if
      values = result%series_values(:, position)
   end subroutine get_series

   !> One scalar.
   subroutine get_summary(result, name, value, error)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of the scalar
      character(len=*), intent(in) :: name
      !> Its value [unit of the scalar]
      real(wp), intent(out) :: value
      !> Usage error where the result has no such scalar
      type(error_t), allocatable, intent(out) :: error

      integer :: position

      value = 0.0_wp
      position = find_quantity(result%summary, name)
      if (position == 0) then
         call raise(error, kind_usage, "the result has no scalar '"//name//"'")
         return
      end if
      value = result%summary_values(position)
   end subroutine get_summary

end module camroller_result
