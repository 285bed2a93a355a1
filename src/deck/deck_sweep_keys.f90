!> Keys of the group &sweep: what a study varies, and how it is run.
!>
!> In: a schema. Out: the same with the group in it. In: settings and the sweep. Out: mistakes in its choice of series.
module camroller_deck_sweep_keys
   use camroller_kinds, only : wp
   use camroller_deck_complaint, only : complain, demand
   use camroller_mistakes, only : mistakes_t
   use camroller_names, only : name_length
   use camroller_deck_schema, only : schema_t, add_group, add_key, anything, from_to, group_effect, not_negative, positive, &
      & type_integer, type_integers, type_name, type_number, type_text, type_words
   use camroller_deck_sweep, only : most_cases, scale_names, sweep_kind_names, sweep_size, sweep_t
   use camroller_number_text, only : counted, integer_text
   use camroller_settings, only : get_word, settings_t, take
   implicit none
   private

   public :: add_sweep_keys, check_series, series_choice, series_choice_name, sweep_key_count
   public :: series_none, series_chosen, series_all

   !> Keys that one sweep can vary without a table
   integer, parameter :: sweep_key_count = 8
   !> Cases whose series the command `sweep` writes
   character(len=*), parameter :: series_choice_names(*) = [character(len=name_length) :: "none", "chosen", "all"]
   !> Places in `series_choice_names`
   integer, parameter :: series_none = 1, series_chosen = 2, series_all = 3

contains

   !> Add the group.
   subroutine add_sweep_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      call add_group(schema, "sweep", group_effect, "many cases in one run, over up to eight keys or the columns of a table")
      call add_key(schema, "kind", type_name, "how cases are made: all combinations, the last key fastest; lists side by side; "// &
         & "rows of a table; samples", choices=sweep_kind_names, default=trim(sweep_kind_names(1)))
      call add_key(schema, "cases", type_integer, "number of cases of a sample", from_to(1.0_wp, real(most_cases, wp)), &
         & is_optional=.true.)
      call add_key(schema, "seed", type_integer, "seed of a sample; with 0 the Sobol sequence is as published", not_negative, &
         & default="1")
      call add_key(schema, "table", type_text, "file with a column for each key, named 'group.key', and a row for each case; "// &
         & "text or HDF5; kind 'table'", is_optional=.true.)
      call add_axis_keys(schema)
      call add_key(schema, "series", type_name, "cases whose series over the cam angle 'camroller sweep' writes; the summary "// &
         & "is written for every case", choices=series_choice_names, default=trim(series_choice_names(series_none)))
      call add_key(schema, "series_cases", type_integers, "numbers of these cases, from 0; series 'chosen'", not_negative, &
         & is_optional=.true.)
      call add_key(schema, "wall_time_limit_s", type_number, "time after which 'camroller sweep' stops, to be continued with "// &
         & "--resume", positive, is_optional=.true.)
      call add_key(schema, "checkpoint_s", type_number, "interval at which 'camroller sweep' flushes its results to disk", &
         & not_negative, default="30")
   end subroutine add_sweep_keys

   !> Series of which cases the command `sweep` writes.
   pure function series_choice(settings) result(choice)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Place in `series_choice_names`; none without the group
      integer :: choice

      choice = max(series_none, findloc(series_choice_names == get_word(settings, "sweep", "series"), .true., 1))
   end function series_choice

   !> The same in words.
   pure function series_choice_name(settings) result(name)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> One of `series_choice_names`
      character(len=len_trim(series_choice_names(series_choice(settings)))) :: name

      name = series_choice_names(series_choice(settings))
   end function series_choice_name

   !> Are there the cases whose series are wanted?
   subroutine check_series(settings, sweep, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer, allocatable :: cases(:)
      integer :: i

      if (series_choice(settings) /= series_chosen) return
      call demand(settings, "sweep", "series_cases", "series = 'chosen'", mistakes)
      allocate (cases(0))
      call take(settings, "sweep", "series_cases", cases)
      do i = 1, size(cases)
         if (cases(i) < sweep_size(sweep)) cycle
         call complain(mistakes, settings, "sweep", "series_cases", "there is no case "//integer_text(cases(i))// &
            & ": the sweep has "//counted(sweep_size(sweep), "case")//", the first is 0")
         return
      end do
   end subroutine check_series

   !> Keys that vary, and their values.
   subroutine add_axis_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      character(len=1) :: digit
      integer :: i

      do i = 1, sweep_key_count
         digit = integer_text(i)
         call add_key(schema, "key_"//digit, type_text, "key that is varied, as 'group.key'", is_optional=.true.)
         call add_key(schema, "values_"//digit, type_words, "its values; or give from, to and count (no count for samples)", &
            & is_optional=.true.)
         call add_key(schema, "from_"//digit, type_number, "its first value", anything, is_optional=.true.)
         call add_key(schema, "to_"//digit, type_number, "its last value", anything, is_optional=.true.)
         call add_key(schema, "count_"//digit, type_integer, "number of values at equal distances", from_to(2.0_wp, 1.0e6_wp), &
            & is_optional=.true.)
         call add_key(schema, "scale_"//digit, type_name, "equal differences or equal ratios", choices=scale_names, &
            & default=trim(scale_names(1)))
      end do
   end subroutine add_axis_keys

end module camroller_deck_sweep_keys
