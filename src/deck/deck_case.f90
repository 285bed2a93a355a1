!> From settings to a case.
!>
!> In: settings that hold together, and the tables they name. Out: `case_t` in SI. A component whose key has no value keeps the
!> default of its type.
module camroller_deck_case
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t, taken_from
   use camroller_deck_engine, only : place_cams
   use camroller_deck_keys, only : bind_case
   use camroller_deck_tables, only : deck_tables_t, get_lift_table, get_pressure_table
   use camroller_settings, only : settings_t
   implicit none
   private

   public :: fill_case

contains

   !> Fill a case: what its keys give, then what follows from several of them and from tables.
   subroutine fill_case(settings, tables, case)
      !> The settings
      type(settings_t), intent(in), target :: settings
      !> Tables that they name
      type(deck_tables_t), intent(in) :: tables
      !> The case
      type(case_t), intent(out) :: case

      type(keys_t) :: keys

      keys = taken_from(settings)
      call bind_case(keys, case)
      if (case%lift%law == "table") call get_lift_table(settings, "lift", tables%lift, case%lift)
      if (allocated(case%second_lift)) then
         if (case%second_lift%law == "table") call get_lift_table(settings, "second_lift", tables%second_lift, case%second_lift)
      end if
      if (allocated(case%gas_force)) call get_pressure_table(settings, tables%pressure, case%gas_force%angle, &
         & case%gas_force%pressure)
      if (allocated(case%engine)) call place_cams(settings, case)
   end subroutine fill_case

end module camroller_deck_case
