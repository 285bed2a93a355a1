!> Boundary friction in solved contacts with heat.
module test_ehl_boundary
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, two_pi
   use camroller_case, only : case_t
   use camroller_ehl_profiles, only : make_profiles
   use camroller_ehl_record, only : column, ehl_record_t
   use camroller_error, only : error_t
   use camroller_result, only : result_t
   use closeness, only : expect_success
   use lobe_cases, only : run
   use reference_cases, only : add_heat, point_viscosities, set_point, thesis_case
   implicit none
   private

   public :: collect_ehl_boundary

contains

   subroutine collect_ehl_boundary(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a boundary coefficient that follows the temperature is that of the surfaces", test_boundary) &
         ]
   end subroutine collect_ehl_boundary

   !> Asperities that touch in warm contacts at 3000 rev/min in hot oil: their friction tells the coefficient, and this the
   !> temperature at which the law has it. With this coefficient at every temperature the contact is as warm all along, and not with
   !> that of the oil's temperature.
   subroutine test_boundary(error)
      type(error_type), allocatable, intent(out) :: error
      ! Coefficient at the oil's temperature [-], its fall with the temperature [1/K]; slip at which friction warms a contact [m/s]
      real(wp), parameter :: coefficient = 0.2_wp, fall = 4.0e-3_wp, much = 0.3_wp
      type(case_t) :: case
      type(result_t) :: result
      type(ehl_record_t) :: record, same, cold
      ! Coefficients that the friction tells [-]; rise of the surfaces that goes with one [K]
      real(wp), allocatable :: coefficients(:)
      real(wp) :: rise
      integer :: i, found

      case = thesis_case()
      call set_point(case, 3000.0_wp*two_pi/60.0_wp, point_viscosities(3))
      case%surface%cam_roughness = 0.4e-6_wp
      case%surface%roller_roughness = 0.4e-6_wp
      case%asperity%film_shear_strength = 0.0_wp
      case%asperity%boundary_coefficient = coefficient
      call add_heat(case)
      call run(case, result, error)
      if (allocated(error)) return
      result%angle = result%angle(::20)
      result%series_values = result%series_values(::20, :)
      allocate (case%boundary_law)
      case%boundary_law%reference_speed = 0.1_wp
      case%boundary_law%lowest_speed = 1.0e-3_wp
      case%boundary_law%reference_temperature = case%operating_point%oil_temperature
      case%boundary_law%temperature_slope = -fall
      call solve_profiles(case, record)
      if (allocated(error)) return
      coefficients = abs(column(record, "boundary_friction"))/max(column(record, "asperity_share")*column(record, "load"), &
         & tiny(1.0_wp))
      deallocate (case%boundary_law)
      call solve_profiles(case, cold)
      if (allocated(error)) return
      found = 0
      do i = 1, size(record%angle)
         if (.not. abs(column_at(record, "sliding_speed", i)) > much) cycle
         if (.not. column_at(record, "asperity_share", i) > 0.01_wp) cycle
         found = found + 1
         rise = (coefficient - coefficients(i))/fall
         case%asperity%boundary_coefficient = coefficients(i)
         call solve_profiles(case, same)
         if (allocated(error)) return
         call check(error, rise > 0.05_wp*maxval(record%film_rise(:, i)) .and. rise < maxval(record%film_rise(:, i)), &
            & "rise of the surfaces")
         if (allocated(error)) return
         ! A thousandth of a kelvin may be left of a rise of some tenths
         call check(error, maxval(abs(record%film_rise(:, i) - same%film_rise(:, i))) < 0.01_wp* &
            & maxval(abs(record%film_rise(:, i) - cold%film_rise(:, i))), "not as warm as with the coefficient that friction tells")
         if (allocated(error)) return
      end do
      call check(error, found >= 2, "angles with slip and touching asperities")

   contains

      !> Solved contacts of the case at the load and the slip of the result.
      subroutine solve_profiles(case, profiles)
         type(case_t), intent(in) :: case
         type(ehl_record_t), intent(out) :: profiles

         type(error_t), allocatable :: failure
         character(len=:), allocatable :: gaps

         call make_profiles(profiles, case, result, gaps, failure)
         call expect_success(error, failure)
      end subroutine solve_profiles

      !> A quantity at an angle.
      function column_at(profiles, name, place) result(value)
         type(ehl_record_t), intent(in) :: profiles
         character(len=*), intent(in) :: name
         integer, intent(in) :: place
         real(wp) :: value

         associate (values => column(profiles, name))
            value = values(place)
         end associate
      end function column_at

   end subroutine test_boundary

end module test_ehl_boundary
