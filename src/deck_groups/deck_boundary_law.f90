!> Decks: the law of the boundary coefficient.
!>
!> In: schema, settings. Out: group and keys, the component of a case, and the rules that tie its keys to others.
module camroller_deck_boundary_law
   use camroller_boundary_law, only : boundary_law_names, boundary_law_t, boundary_logarithmic, boundary_table
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain, complain_about_group, demand
   use camroller_deck_schema, only : schema_t, add_group, add_name, add_number, add_numbers, anything, group_effect, not_negative, &
      & positive, above_absolute_zero
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_known, take
   implicit none
   private

   public :: add_boundary_law_keys, fill_boundary_law, check_boundary_law

   character(len=*), parameter :: group = "boundary_law"

contains

   !> Group and keys.
   subroutine add_boundary_law_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(boundary_law_t) :: standard

      call add_group(schema, "boundary_law", group_effect, &
         & "friction coefficient of touching asperities over sliding speed and temperature, in place of a constant one")
      call add_name(schema, "law", boundary_law_names, standard%law, &
         & "logarithm of the speed and straight line of the temperature, or a table over both")
      call add_number(schema, "reference_speed_m_s", positive, "sliding speed at which the coefficient is that of &asperity", &
         & is_optional=.true., example="0.1")
      call add_number(schema, "reference_temperature_degC", above_absolute_zero, "temperature at which it is", is_optional=.true., &
         & example="100")
      call add_number(schema, "change_per_decade", anything, "change of the coefficient where the sliding speed is ten times "// &
         & "as high", is_optional=.true., example="0.01")
      call add_number(schema, "change_per_K", anything, "change of the coefficient with the temperature", is_optional=.true., &
         & example="-0.0002")
      call add_number(schema, "lowest_speed_m_s", positive, "sliding speed below which the logarithm levels off", &
         & is_optional=.true., example="0.001")
      call add_number(schema, "smallest_coefficient", not_negative, "coefficient below which the law does not go", &
         & default=standard%smallest)
      call add_number(schema, "largest_coefficient", not_negative, "coefficient above which the law does not go", &
         & default=standard%largest)
      call add_numbers(schema, "speed_points_m_s", positive, "sliding speeds of a table, increasing", is_optional=.true., &
         & example="0.01, 0.1, 1")
      call add_numbers(schema, "temperature_points_degC", above_absolute_zero, "temperatures of a table, increasing", &
         & is_optional=.true., example="60, 120")
      call add_numbers(schema, "coefficient_points", not_negative, "coefficients of a table: those of all speeds at the first "// &
         & "temperature, then at the next", is_optional=.true., example="0.11, 0.12, 0.13, 0.10, 0.11, 0.12")
   end subroutine add_boundary_law_keys

   !> Fill the component of a case.
   subroutine fill_boundary_law(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (.not. has_group(settings, group)) return
      allocate (case%boundary_law)
      associate (law => case%boundary_law)
         call take(settings, "boundary_law", "law", law%law)
         call take(settings, "boundary_law", "reference_speed_m_s", law%reference_speed)
         call take(settings, "boundary_law", "reference_temperature_degC", law%reference_temperature)
         call take(settings, "boundary_law", "change_per_decade", law%change_per_decade)
         call take(settings, "boundary_law", "change_per_K", law%temperature_slope)
         call take(settings, "boundary_law", "lowest_speed_m_s", law%lowest_speed)
         call take(settings, "boundary_law", "smallest_coefficient", law%smallest)
         call take(settings, "boundary_law", "largest_coefficient", law%largest)
         call take(settings, "boundary_law", "speed_points_m_s", law%speed_points)
         call take(settings, "boundary_law", "temperature_points_degC", law%temperature_points)
         call take(settings, "boundary_law", "coefficient_points", law%coefficient_points)
      end associate
   end subroutine fill_boundary_law

   !> Rules: each law has its keys, and asperities that it is for.
   subroutine check_boundary_law(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(boundary_law_t) :: law
      logical :: has_points
      character(len=*), parameter :: logarithmic_keys(*) = [character(len=26) :: "reference_speed_m_s", &
         & "reference_temperature_degC", "change_per_decade", "change_per_K", "lowest_speed_m_s"]
      character(len=*), parameter :: table_keys(*) = [character(len=26) :: "speed_points_m_s", "temperature_points_degC", &
         & "coefficient_points"]

      if (.not. has_group(settings, group)) return
      if (.not. has_group(settings, "asperity")) call complain_about_group(mistakes, settings, group, &
         & "&boundary_law needs the group &asperity")
      if (get_word(settings, group, "law") == boundary_law_names(boundary_table)) then
         call demand_all(table_keys, boundary_table)
      else
         call demand_all(logarithmic_keys, boundary_logarithmic)
      end if
      call take(settings, group, "smallest_coefficient", law%smallest)
      call take(settings, group, "largest_coefficient", law%largest)
      if (law%largest < law%smallest) call complain(mistakes, settings, group, "largest_coefficient", &
         & "'largest_coefficient' is below 'smallest_coefficient'")
      has_points = is_known(settings, group, "speed_points_m_s") .and. is_known(settings, group, "temperature_points_degC") &
         & .and. is_known(settings, group, "coefficient_points")
      if (.not. has_points) return
      call take(settings, group, "speed_points_m_s", law%speed_points)
      call take(settings, group, "temperature_points_degC", law%temperature_points)
      call take(settings, group, "coefficient_points", law%coefficient_points)
      call check_rising("speed_points_m_s", law%speed_points)
      call check_rising("temperature_points_degC", law%temperature_points)
      if (size(law%coefficient_points) /= size(law%speed_points)*size(law%temperature_points)) call complain(mistakes, settings, &
         & group, "coefficient_points", "'coefficient_points' has one number for each speed at each temperature")

   contains

      !> What a law needs.
      subroutine demand_all(keys, law)
         !> Names of the keys
         character(len=*), intent(in) :: keys(:)
         !> Number of the law
         integer, intent(in) :: law

         integer :: i

         do i = 1, size(keys)
            call demand(settings, group, trim(keys(i)), "boundary law '"//trim(boundary_law_names(law))//"'", mistakes)
         end do
      end subroutine demand_all

      !> Points of a table increase.
      subroutine check_rising(key, points)
         !> Name of the key
         character(len=*), intent(in) :: key
         !> The points [any]
         real(wp), intent(in) :: points(:)

         if (any(points(2:) <= points(:size(points) - 1))) call complain(mistakes, settings, group, key, &
            & "the numbers of '"//key//"' must increase")
      end subroutine check_rising

   end subroutine check_boundary_law

end module camroller_deck_boundary_law
