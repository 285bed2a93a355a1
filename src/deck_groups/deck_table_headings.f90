!> Headings of tables that a deck names: the columns that are wanted, and what a heading says that the deck does not.
!>
!> In: settings, a table with the names and units of its heading. Out: names of columns, or a mistake at the key that decides.
module camroller_deck_table_headings
   use camroller_deck_complaint, only : complain
   use camroller_lift_forms, only : table_kind_names
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : get_word, settings_t
   use camroller_table_file, only : columns_t, table_t
   use camroller_units, only : find_unit, unit_t
   implicit none
   private

   public :: wanted_columns, check_heading

   !> Names of the two columns of each kind of a table, and place of the kind that &gas_force has
   integer, parameter :: pressure_kind = size(table_kind_names) + 1
   character(len=*), parameter :: angle_names(*) = [character(len=16) :: "cam_angle", "cam_angle", "polar_angle", "cam_angle"]
   character(len=*), parameter :: value_names(*) = [character(len=16) :: "valve_lift", "roller_lift", "cam_radius", "pressure"]

contains

   !> Columns that a table is read from where its heading has their names, as that of `check --cam` does.
   function wanted_columns(settings, group) result(columns)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Group that names the table
      character(len=*), intent(in) :: group
      !> The columns, and the lobe shape; blank for a table of pressure, whose columns have no names
      type(columns_t) :: columns

      integer :: kind

      columns%key = "lobe"
      columns%number = merge(2, 1, group == "second_lift")
      if (group == "gas_force") return
      kind = findloc(table_kind_names, get_word(settings, group, "table_kind"), 1)
      if (kind > 0) columns%names = [angle_names(kind), value_names(kind)]
   end function wanted_columns

   !> Does the heading of a table, where it has one, say something else than what the table is taken for? Names and units that are
   !> not known say nothing.
   subroutine check_heading(settings, group, table, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Group that names the table
      character(len=*), intent(in) :: group
      !> The table
      type(table_t), intent(in) :: table
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=len(value_names)) :: wanted(2)
      character(len=:), allocatable :: unit_key, kind_key
      type(unit_t) :: unit
      logical :: is_known
      integer :: kind

      kind = pressure_kind
      unit_key = "pressure_unit"
      kind_key = "table"
      if (group /= "gas_force") then
         kind = max(1, findloc(table_kind_names, get_word(settings, group, "table_kind"), 1))
         unit_key = "table_unit"
         kind_key = "table_kind"
      end if
      wanted = [angle_names(kind), value_names(kind)]
      associate (names => table%names, units => table%units)
         call find_unit(units(1), unit, is_known)
         if (is_other(names(1), wanted(1))) then
            call complain_about(kind_key, trim(names(1)), trim(wanted(1))//" in its first column")
         else if (units(1) == "rad" .or. (is_known .and. units(1) /= "deg")) then
            call complain_about("table", trim(units(1)), "angles in degrees")
         else if (is_other(names(2), wanted(2))) then
            call complain_about(kind_key, trim(names(2)), trim(wanted(2))//" in its second column")
         else
            call find_unit(units(2), unit, is_known)
            if (is_known .and. units(2) /= get_word(settings, group, unit_key)) call complain_about(unit_key, trim(units(2)), &
               & "'"//get_word(settings, group, unit_key)//"'")
         end if
      end associate

   contains

      !> Is a name that of a quantity, but of another one?
      pure function is_other(name, wanted) result(verdict)
         !> The name in the heading, and the one that is wanted
         character(len=*), intent(in) :: name, wanted
         !> Is it?
         logical :: verdict

         verdict = name /= wanted .and. (any(angle_names == name) .or. any(value_names == name) .or. name == "crank_angle")
      end function is_other

      !> Take note of what the heading has in place of what the deck says.
      subroutine complain_about(key, found, wanted)
         !> Key of the deck that decides, what the heading has, what it should have
         character(len=*), intent(in) :: key, found, wanted

         call complain(mistakes, settings, group, key, "'"//table%path//"': the heading of the table has '"//found//"', not "// &
            & wanted)
      end subroutine complain_about

   end subroutine check_heading

end module camroller_deck_table_headings
