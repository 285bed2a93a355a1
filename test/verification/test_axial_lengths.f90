!> Lengths of the one line contact that stands for a roller whose load is not the same all along it.
module test_axial_lengths
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_axial_loads, only : solved_loads
   use camroller_axial_table, only : axial_part_t, axial_state, axial_state_t, effective_lengths, new_axial_part, slice_loads, &
      & window_between
   use camroller_axial_window, only : load_window, spread_loads, window_t
   use camroller_error, only : error_t
   use camroller_kinds, only : wp, pi
   use camroller_roller_profile, only : roller_profile_t
   use camroller_traction, only : line_lengths_t, rolling_biboulet_houpert, rolling_resistance, same_lengths
   use closeness, only : check_close, check_scaled, expect_success, has_failed
   use roller_profiles, only : profiles
   implicit none
   private

   public :: collect_axial_lengths

   !> Length of the roller, radius [m]; modulus of steel on steel [Pa]
   real(wp), parameter :: roller_length = 13.7e-3_wp, radius = 6.0e-3_wp, modulus = 2.27e11_wp

contains

   subroutine collect_axial_lengths(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("slopes of the lengths are their difference quotients, inside and outside the table", test_slopes), &
         new_unittest("the lengths of Hertz' ellipse are those of a parabola", test_parabola), &
         new_unittest("no length exceeds that of the roller, however small the load is", test_small_loads), &
         new_unittest("what the slices of a roller resist to rolling adds up to what the roller resists", test_rolling), &
         new_unittest("solved loads of the slices are those found from even ones, where the table has others", test_solved) &
         ]
   end subroutine collect_axial_lengths

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      type(axial_part_t) :: part
      type(error_t), allocatable :: failure
      real(wp), parameter :: h = 1.0e-5_wp
      ! Lengths, their slopes, those beside
      type(line_lengths_t) :: middle, by_load, by_radius, low, high, unused(2)
      real(wp) :: load
      integer :: i, k

      do k = 1, 4
         call new_axial_part(part, profiles(k), roller_length, modulus, [5.0e-3_wp, 30.0e-3_wp], failure)
         if (has_failed(failure, error)) return
         do i = -10, 18
            load = 1.9_wp**i
            call effective_lengths(part, load, radius, middle, by_load, by_radius)
            call check(error, middle%mean > 0.0_wp .and. (by_load%mean > -0.5_wp .and. by_load%mean < 0.8_wp), "length")
            if (allocated(error)) return
            ! by Jensen's inequality
            call check(error, middle%loaded > 0.999_wp*middle%root .and. middle%root > 0.999_wp*middle%mean, &
               & "order of the lengths")
            if (allocated(error)) return
            call effective_lengths(part, load*exp(-h), radius, low, unused(1), unused(2))
            call effective_lengths(part, load*exp(h), radius, high, unused(1), unused(2))
            ! third derivatives of a few, times h squared, and rounding over h
            call check_all_close(error, by_load, quotients(low, high, 2.0_wp*h), "slope over the load")
            if (allocated(error)) return
            call effective_lengths(part, load, radius*exp(-h), low, unused(1), unused(2))
            call effective_lengths(part, load, radius*exp(h), high, unused(1), unused(2))
            call check_all_close(error, by_radius, quotients(low, high, 2.0_wp*h), "slope over the radius")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_slopes

   !> Differences of the logarithms of lengths over a distance.
   elemental function quotients(low, high, distance) result(slopes)
      type(line_lengths_t), intent(in) :: low, high
      real(wp), intent(in) :: distance
      type(line_lengths_t) :: slopes

      slopes = line_lengths_t(log(high%mean/low%mean)/distance, log(high%root/low%root)/distance, &
         & log(high%loaded/low%loaded)/distance)
   end function quotients

   !> Are slopes of lengths the same to 1e-8?
   subroutine check_all_close(error, found, expected, what)
      type(error_type), allocatable, intent(out) :: error
      type(line_lengths_t), intent(in) :: found, expected
      character(len=*), intent(in) :: what

      call check_scaled(error, found%mean, expected%mean, 1.0_wp, 1.0e-8_wp, what//", mean")
      if (.not. allocated(error)) call check_scaled(error, found%root, expected%root, 1.0_wp, 1.0e-8_wp, what//", root")
      if (.not. allocated(error)) call check_scaled(error, found%loaded, expected%loaded, 1.0_wp, 1.0e-8_wp, what//", loaded")
   end subroutine check_all_close

   !> By Schwarz' inequality `W^2 <= L int w^2 dy`. A flat roller carries all along; its ends carry the less of the load the
   !> narrower the contact is.
   subroutine test_small_loads(error)
      type(error_type), allocatable, intent(out) :: error
      type(axial_part_t) :: part
      type(error_t), allocatable :: failure
      type(roller_profile_t) :: profile
      type(line_lengths_t) :: lengths, unused(2)
      ! Length of the point before [m]
      real(wp) :: before
      integer :: i

      profile%profile = "flat"
      profile%coupling = "half_space"
      call new_axial_part(part, profile, roller_length, modulus, [5.0e-3_wp, 30.0e-3_wp], failure)
      call expect_success(error, failure)
      before = 0.0_wp
      do i = 3, -12, -1
         if (allocated(error)) return
         call effective_lengths(part, 10.0_wp**i, radius, lengths, unused(1), unused(2))
         call check(error, max(lengths%mean, lengths%root, lengths%loaded) <= roller_length .and. lengths%mean >= before, &
            & "a length over that of the roller, or one that falls with the load")
         before = lengths%mean
      end do
   end subroutine test_small_loads

   !> The load of Hertz' slender ellipse is a parabola along it, `w = (3 W/4 a)(1 - y^2/a^2)`: its lengths are 5/3, 3 pi^2/16 and 2
   !> times the half length; below the loads that slices resolve, as well.
   subroutine test_parabola(error)
      type(error_type), allocatable, intent(out) :: error
      type(axial_part_t) :: part
      type(axial_state_t) :: state
      type(roller_profile_t) :: profile
      type(error_t), allocatable :: failure
      type(line_lengths_t) :: lengths, unused(2)
      ! Load [N], half length [m], part of a slice in it [-]
      real(wp) :: load, a, slice
      integer :: i

      profile%profile = "crowned"
      profile%crown_radius = 3.0_wp
      call new_axial_part(part, profile, roller_length, modulus, [5.0e-3_wp, 30.0e-3_wp], failure)
      if (has_failed(failure, error)) return
      do i = -4, 5
         load = 2.0_wp*3.0_wp**i
         call effective_lengths(part, load, radius, lengths, unused(1), unused(2))
         a = 0.6_wp*lengths%mean
         ! what slices resolve where the table ends
         slice = max(roller_length/(profile%slices*a), 2.0_wp/7.0_wp)
         call check_close(error, lengths%root, 3.0_wp*pi**2/16.0_wp*a, 0.5_wp*slice**2, "length of the mean root")
         if (allocated(error)) return
         call check_close(error, lengths%loaded, 2.0_wp*a, slice**2, "loaded length")
         if (allocated(error)) return
         state = axial_state(part, load, radius)
         call check_close(error, state%peak*a/roller_length, 0.75_wp, slice**2, "largest load")
         if (allocated(error)) return
      end do
   end subroutine test_parabola

   !> The rolling resistance of a roller is the sum of its slices', which carry load or not as wholes: one more or less of ten to
   !> forty.
   subroutine test_rolling(error)
      type(error_type), allocatable, intent(out) :: error
      ! Difference of one contact, measured 0.10 at most; in the mean, measured 0.02, and 0.15 where the length of the mean load
      ! stands for all [-]
      real(wp), parameter :: largest = 0.12_wp, mean = 0.03_wp
      type(axial_part_t) :: part
      type(error_t), allocatable :: failure
      type(line_lengths_t) :: lengths, unused(2)
      real(wp), parameter :: alpha = 2.2e-8_wp
      ! Loads of the slices over their mean; load [N]; speed group [-]; force of the roller and its slope, of the slices [N]
      real(wp) :: loads(41), load, speed, whole, slope, parts(41), slopes(41)
      ! Difference, sum of their magnitudes [-]
      real(wp) :: difference, total
      integer :: i, j, k, contacts

      total = 0.0_wp
      contacts = 0
      do k = 1, 4
         call new_axial_part(part, profiles(k), roller_length, modulus, [5.0e-3_wp, 30.0e-3_wp], failure)
         if (has_failed(failure, error)) return
         do i = 1, 8
            load = 10.0_wp*2.1_wp**i
            call slice_loads(part, load, radius, loads)
            call effective_lengths(part, load, radius, lengths, unused(1), unused(2))
            ! Loads of single slices end where the table does
            if (41*lengths%loaded < 8.0_wp*roller_length) cycle
            do j = -12, -8
               speed = 10.0_wp**j
               call rolling_resistance(rolling_biboulet_houpert, speed, load/(modulus*radius*lengths%mean), modulus, radius, &
                  & lengths, alpha, whole, slope)
               call rolling_resistance(rolling_biboulet_houpert, speed, loads*load/(modulus*radius*roller_length), modulus, &
                  & radius, same_lengths(roller_length/41), alpha, parts, slopes)
               difference = abs(sum(parts)/whole - 1.0_wp)
               call check(error, difference < largest, "rolling resistance of a contact")
               if (allocated(error)) return
               total = total + difference
               contacts = contacts + 1
            end do
         end do
      end do
      call check(error, contacts > 100 .and. total < mean*contacts, "rolling resistance in the mean")
   end subroutine test_rolling

   !> Between the points of the table slices at the ends lift off: there cubics have loads that are not.
   subroutine test_solved(error)
      type(error_type), allocatable, intent(out) :: error
      type(axial_part_t) :: part
      type(window_t) :: window
      type(roller_profile_t) :: profile
      type(error_t), allocatable :: failure
      ! Loads over their mean: of the table, solved, found from even ones [-]; load [N]
      real(wp), dimension(41) :: table, solved, even
      real(wp) :: load
      integer :: i, k, status, others

      others = 0
      do k = 1, 4
         call new_axial_part(part, profiles(k), roller_length, modulus, [5.0e-3_wp, 30.0e-3_wp], failure)
         if (has_failed(failure, error)) return
         profile = profiles(k)
         do i = 1, 8
            load = 10.0_wp*2.1_wp**i
            call slice_loads(part, load, radius, table)
            call solved_loads(part, load, radius, solved)
            ! The same part of the roller, from even loads on it
            call window_between(part, load, radius, window)
            window%loads = 1.0_wp
            call load_window(window, profile, roller_length, modulus, load, radius, status)
            call spread_loads(window, [-0.5_wp, 0.5_wp], even)
            call check(error, status, 0)
            if (allocated(error)) return
            others = others + count((table > 0.0_wp) .neqv. (even > 0.0_wp))
            ! Below the table its shape stays
            if (load < modulus*roller_length**2*exp(part%first)) cycle
            call check(error, all(abs(solved - even) < 1.0e-8_wp), "loads")
            if (allocated(error)) return
         end do
      end do
      call check(error, others > 0, "the table's loads end where they should")
   end subroutine test_solved

end module test_axial_lengths
