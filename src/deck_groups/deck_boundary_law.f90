!> Decks: the law of the boundary coefficient.
!>
!> In: keys, settings. Out: the group, the component of a case, and the rules that tie its keys to others.
module camroller_deck_boundary_law
   use camroller_boundary_law, only : boundary_law_names, boundary_law_t, boundary_logarithmic, boundary_table
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : check_points, complain, complain_about_group, demand
   use camroller_deck_schema, only : group_effect, anything, positive, not_negative, above_absolute_zero
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, take
   implicit none
   private

   public :: bind_boundary_law, check_boundary_law

   character(len=*), parameter :: group = "boundary_law"

contains

   !> Group and keys, and the component of a case.
   subroutine bind_boundary_law(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group(group, group_effect, "friction coefficient of touching asperities over sliding speed and "// &
         & "temperature, in place of a constant one")
      if (.not. keys%are_wanted(allocated(case%boundary_law))) return
      if (.not. allocated(case%boundary_law)) allocate (case%boundary_law)
      associate (law => case%boundary_law)
         call keys%choice("law", boundary_law_names, "logarithm of the speed and straight line of the temperature, or a table "// &
            & "over both", law%law)
         call keys%number("reference_speed_m_s", positive, "sliding speed at which the coefficient is that of &asperity", &
            & law%reference_speed, example="0.1", is_optional=.true., usual=[1.0e-4_wp, 20.0_wp])
         call keys%number("reference_temperature_degC", above_absolute_zero, "temperature at which it is", &
            & law%reference_temperature, example="100", is_optional=.true., usual=[-40.0_wp, 250.0_wp])
         call keys%number("change_per_decade", anything, "change of the coefficient where the sliding speed is ten times as high", &
            & law%change_per_decade, example="0.01", is_optional=.true., usual=[-0.05_wp, 0.05_wp])
         call keys%number("change_per_K", anything, "change of the coefficient with the temperature", law%temperature_slope, &
            & example="-0.0002", is_optional=.true., usual=[-2.0e-3_wp, 2.0e-3_wp])
         call keys%number("lowest_speed_m_s", positive, "sliding speed below which the logarithm levels off", law%lowest_speed, &
            & example="0.001", is_optional=.true., usual=[1.0e-6_wp, 0.1_wp])
         call keys%number("smallest_coefficient", not_negative, "coefficient below which the law does not go", law%smallest, &
            & usual=[0.0_wp, 0.2_wp])
         call keys%number("largest_coefficient", not_negative, "coefficient above which the law does not go", law%largest, &
            & usual=[0.05_wp, 1.0_wp])
         call keys%numbers("speed_points_m_s", positive, "sliding speeds of a table, increasing", law%speed_points, &
            & example="0.01, 0.1, 1", is_optional=.true., usual=[1.0e-5_wp, 20.0_wp])
         call keys%numbers("temperature_points_degC", above_absolute_zero, "temperatures of a table, increasing", &
            & law%temperature_points, example="60, 120", is_optional=.true., usual=[-40.0_wp, 250.0_wp])
         call keys%numbers("coefficient_points", not_negative, &
            & "coefficients of a table: those of all speeds at the first temperature, then at the next", law%coefficient_points, &
            & example="0.11, 0.12, 0.13, 0.10, 0.11, 0.12", is_optional=.true., usual=[0.01_wp, 0.5_wp])
      end associate
   end subroutine bind_boundary_law

   !> Rules: each law has its keys, and asperities that it is for.
   subroutine check_boundary_law(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(boundary_law_t) :: law
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
      call check_points(settings, group, table_keys, mistakes)

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

   end subroutine check_boundary_law

end module camroller_deck_boundary_law
