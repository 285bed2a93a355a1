!> Load along the roller: slices against closed forms, the table made of them.
module test_axial
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_axial_gaps, only : axial_gaps_t, depth_of, new_axial_gaps, part_within
   use camroller_axial_table, only : axial_part_t, axial_state, axial_state_t, effective_lengths, new_axial_part, slice_loads
   use camroller_error, only : error_t, kind_deck
   use camroller_kinds, only : wp, pi
   use camroller_roller_profile, only : roller_profile_t, profile_gap, profile_names
   use camroller_slices, only : slices_t, new_slices, load_slices, thin_line
   use camroller_strip, only : strip_function
   use camroller_traction, only : line_lengths_t
   use closeness, only : check_close, check_scaled, expect_error, has_failed
   use hertz_ellipse, only : find_ellipse
   use random_decks, only : random_t, start_random, draw
   use roller_profiles, only : profiles
   implicit none
   private

   public :: collect_axial

   !> Length of the roller, radius [m]; modulus of steel on steel [Pa]
   real(wp), parameter :: roller_length = 13.7e-3_wp, radius = 6.0e-3_wp, modulus = 2.27e11_wp

contains

   subroutine collect_axial(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the approach under the same load all along is Lundberg's", test_approach), &
         new_unittest("Lundberg's profile has the same load all along it at its load", test_lundberg), &
         new_unittest("a crown that is not cut off is Hertz' ellipse", test_ellipse), &
         new_unittest("slices far narrower than the contact have the load of Hertz' ellipse", test_narrow_slices), &
         new_unittest("a load that rises along the roller has the gap of Legendre's polynomials", test_legendre), &
         new_unittest("slices that do not see each other have a small tilt's load in closed form", test_small_tilt), &
         new_unittest("a tilted crown is the crown at another place", test_tilted_crown), &
         new_unittest("loads add up, and turning the roller round mirrors them", test_sum), &
         new_unittest("the table has the loads and the lengths of the slices between its points", test_table), &
         new_unittest("the largest load of a profile without tilt is in the middle, or always on the same side", test_sides), &
         new_unittest("loads are found for any profile, tilt, load and number of slices", test_all), &
         new_unittest("the part of a roller within a depth is that of a parabola, whatever the number of slices", test_gaps), &
         new_unittest("impossible profiles are refused with a message", test_refusals) &
         ]
   end subroutine collect_axial

   !> Loads of a profile from those all along.
   subroutine solve(error, gaps, is_coupled, load, loads, approach)
      type(error_type), allocatable, intent(out) :: error
      !> Gaps [m]
      real(wp), intent(in) :: gaps(:)
      !> Do slices move each other?
      logical, intent(in) :: is_coupled
      !> Load [N], loads over their mean [-], approach [m]
      real(wp), intent(in) :: load
      real(wp), intent(out) :: loads(:), approach
      type(slices_t) :: slices
      integer :: status

      call new_slices(slices, roller_length, modulus, gaps, is_coupled)
      loads = 1.0_wp
      call load_slices(slices, load, radius, loads, approach, status)
      call check(error, status, 0, "no loads found")
   end subroutine solve

   !> Middles of slices over the length of the roller [-].
   pure function middles(count) result(x)
      integer, intent(in) :: count
      real(wp) :: x(count)
      integer :: i

      x = [((i - 0.5_wp)/count - 0.5_wp, i=1, count)]
   end function middles

   !> Gaps of a profile in the middles of slices [m].
   pure function gaps_of(profile, count) result(gaps)
      type(roller_profile_t), intent(in) :: profile
      integer, intent(in) :: count
      real(wp) :: gaps(count)

      gaps = profile_gap(profile, roller_length, modulus, roller_length*middles(count))
   end function gaps_of

   !> Half width at the mean load [m].
   pure function mean_half_width(load) result(b)
      real(wp), intent(in) :: load
      real(wp) :: b

      b = sqrt(8.0_wp*load*radius/(pi*modulus*roller_length))
   end function mean_half_width

   !> Function of a strip.
   elemental function strip(ratio) result(f)
      !> Length over half width [-]
      real(wp), intent(in) :: ratio
      real(wp) :: f
      real(wp) :: values(1)

      call strip_function([ratio], log([ratio]), 1.0_wp, values)
      f = values(1)
   end function strip

   !> `2 w/(pi E') (1.1932 + ln(L/(2 b')))`, b' the width: Lundberg's number is 1/2 + ln 2 (Harris 2001, eq. 6.49 has 1.1932)
   subroutine test_approach(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: loads(41), approach, b, gap(41), height
      real(wp), parameter :: load = 500.0_wp

      b = mean_half_width(load)
      height = 2.0_wp*load/(pi*modulus*roller_length)
      ! the gap under which the load is the same everywhere: what it moves in the middle less than at a place
      associate (y => roller_length*middles(41))
         gap = height*(2.0_wp*strip(0.5_wp*roller_length/b) - strip((0.5_wp*roller_length - y)/b) &
            & - strip((0.5_wp*roller_length + y)/b))
      end associate
      call solve(error, gap, .true., load, loads, approach)
      if (allocated(error)) return
      ! the limit of the half width changes it by an eighth of 2.5^-8; the solver's last step is 1e-9
      call check_scaled(error, maxval(abs(loads - 1.0_wp)), 0.0_wp, 1.0_wp, 1.0e-4_wp, "loads")
      if (allocated(error)) return
      ! half width over the length, squared, is what the logarithm leaves out; four digits of the number
      call check_close(error, approach, height*2.0_wp*(1.1932_wp + log(roller_length/b)), 5.0e-5_wp/1.2_wp, "approach")
   end subroutine test_approach

   subroutine test_lundberg(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      real(wp) :: approach, end_error
      real(wp), allocatable :: loads(:)
      real(wp), parameter :: load = 500.0_wp
      integer :: n

      profile%profile = "logarithmic"
      profile%design_load = load
      do n = 21, 61, 20
         allocate (loads(n))
         call solve(error, gaps_of(profile, n), .true., load, loads, approach)
         if (allocated(error)) return
         ! half a slice from the end the strip's function is a logarithm and 1/(16 t^2); a load answers to a gap by less than one
         end_error = (mean_half_width(load)*2.0_wp*n/roller_length)**2/16.0_wp
         call check_scaled(error, maxval(abs(loads - 1.0_wp)), 0.0_wp, 1.0_wp, end_error, "loads")
         if (allocated(error)) return
         deallocate (loads)
      end do
      ! at half of that load the ends carry less than the middle, at twice that load they carry most
      allocate (loads(41))
      call solve(error, gaps_of(profile, 41), .true., 0.5_wp*load, loads, approach)
      if (allocated(error)) return
      call check(error, loads(1) < 0.9_wp .and. loads(1) < loads(2) .and. loads(21) > 1.0_wp, "half of the load")
      if (allocated(error)) return
      call solve(error, gaps_of(profile, 41), .true., 2.0_wp*load, loads, approach)
      if (allocated(error)) return
      call check(error, maxloc(loads, 1) == 1 .or. maxloc(loads, 1) == 41, "twice the load")
   end subroutine test_lundberg

   !> Half axes a along the roller, b across: `1/(2 r) = (p0/E*) b/(e^2 a^2) (K - E)`, `1/(2 R) = (p0/E*) b/(e^2 a^2)
   !> (E a^2/b^2 - K)`, with `e^2 = 1 - b^2/a^2`, `p0 = 3 W/(2 pi a b)` and `E* = E'/2` (Johnson 1985, eq. 4.26); the load per
   !> length in the middle is `3 W/(4 a)`.
   subroutine test_ellipse(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      ! Axes' ratio [-]; half length [m]; largest load over the mean [-]
      real(wp) :: ratio, a, largest, approach
      real(wp), allocatable :: loads(:)
      real(wp), parameter :: crown = 3.0_wp
      integer :: n

      call find_ellipse(crown, 50.0_wp, radius, modulus, a, ratio)
      profile%profile = "crowned"
      profile%crown_radius = crown
      do n = 41, 161, 60
         allocate (loads(n))
         call solve(error, gaps_of(profile, n), .true., 50.0_wp, loads, approach)
         if (allocated(error)) return
         largest = 0.75_wp*roller_length/a
         ! the square of a slice's part of the half length; what is left out across, the square of the axes' ratio by a logarithm
         call check_close(error, maxval(loads), largest, (roller_length/(n*a))**2 + 10.0_wp*ratio**2, "largest load")
         if (allocated(error)) return
         call check_scaled(error, count(loads > 0.0_wp)*roller_length/n, 2.0_wp*a, roller_length/n, 2.0_wp, "length")
         if (allocated(error)) return
         deallocate (loads)
      end do
   end subroutine test_ellipse

   !> Slices five times narrower than the contact is half wide. With a thin line in place of a slice's semi-ellipse the largest load
   !> is 20 % below that of Hertz.
   subroutine test_narrow_slices(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      ! Radii of the crown [m], load [N]
      real(wp), parameter :: crowns(3) = [0.15_wp, 0.3_wp, 0.5_wp], load = 741.0_wp
      ! Half length [m], axes' ratio [-], approach [m]
      real(wp) :: a, ratio, approach
      real(wp), allocatable :: loads(:)
      integer :: i

      profile%profile = "crowned"
      do i = 1, size(crowns)
         profile%crown_radius = crowns(i)
         call find_ellipse(crowns(i), load, radius, modulus, a, ratio)
         allocate (loads(nint(5.0_wp*roller_length/(ratio*a))))
         call solve(error, gaps_of(profile, size(loads)), .true., load, loads, approach)
         if (allocated(error)) return
         call check_close(error, maxval(loads), 0.75_wp*roller_length/a, ratio**2 + 1.0e-3_wp, "largest load")
         if (allocated(error)) return
         deallocate (loads)
      end do
   end subroutine test_narrow_slices

   !> A load w = 1 + e x moves the half space by `w ln((1 - x^2) L^2/beta^2) - 2 e x`, since Legendre's polynomials are the
   !> eigenfunctions of `int (w(t) - w(x))/|t - x| dt` with `-2 (1 + 1/2 + ... + 1/n)` (Tuck 1964).
   subroutine test_legendre(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: rise = 0.4_wp, load = 500.0_wp
      ! Approach, height of the logarithm [m]; places over half of the length, loads expected and found, half width over half of the
      ! length [-]
      real(wp) :: approach, height
      real(wp), allocatable :: x(:), expected(:), loads(:), half(:)
      integer :: n

      height = 2.0_wp*load/(pi*modulus*roller_length)
      do n = 21, 61, 20
         allocate (loads(n))
         x = 2.0_wp*middles(n)
         expected = 1.0_wp + rise*x
         half = 2.0_wp*mean_half_width(load)/roller_length*sqrt(expected)
         call solve(error, -height*(expected*(strip((1.0_wp - x)/half) + strip((1.0_wp + x)/half)) - 2.0_wp*rise*x), .true., load, &
            & loads, approach)
         if (allocated(error)) return
         ! the load rises by 2 rise/n over a slice, which is taken as constant
         call check_scaled(error, maxval(abs(loads - expected)), 0.0_wp, 1.0_wp, rise/n, "loads")
         if (allocated(error)) return
         deallocate (loads)
      end do
   end subroutine test_legendre

   !> Each slice yields by `D = 2 asinh(L/(2 beta)) - 1` of 2 W/(pi E' L) per part of its load, so that the load of a small tilt phi
   !> is `1 + e x`, `e = phi L/2/(height D)`, and the effective length L/(1 + e^2/3).
   subroutine test_small_tilt(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: load = 500.0_wp, rise = 1.0e-2_wp
      type(roller_profile_t) :: profile
      real(wp) :: beta, height, yielding, loads(41), approach

      height = 2.0_wp*load/(pi*modulus*roller_length)
      beta = thin_line*mean_half_width(load)
      yielding = 2.0_wp*asinh(0.5_wp*roller_length/beta) - 0.5_wp*roller_length/hypot(0.5_wp*roller_length, beta)
      profile%tilt = rise*height*yielding/(0.5_wp*roller_length)
      call solve(error, gaps_of(profile, 41), .false., load, loads, approach)
      if (allocated(error)) return
      ! the square of the rise over D is left out
      call check_scaled(error, maxval(abs(loads - 1.0_wp - rise*2.0_wp*middles(41))), 0.0_wp, 1.0_wp, rise**2/yielding, "loads")
      if (allocated(error)) return
      call check_scaled(error, sum(loads**2)/41, 1.0_wp + rise**2/3.0_wp*(1.0_wp - 1.0_wp/41.0_wp**2), rise**2, rise, "length")
   end subroutine test_small_tilt

   !> `y^2/(2 r) - phi y` is the crown about the place r phi: loads move by whole slices where that is so many.
   subroutine test_tilted_crown(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      real(wp) :: straight(61), tilted(61), approach
      integer, parameter :: shift = 9

      profile%profile = "crowned"
      profile%crown_radius = 2.0_wp
      call solve(error, gaps_of(profile, 61), .true., 30.0_wp, straight, approach)
      if (allocated(error)) return
      profile%tilt = shift*roller_length/61/profile%crown_radius
      call solve(error, gaps_of(profile, 61), .true., 30.0_wp, tilted, approach)
      if (allocated(error)) return
      call check(error, straight(1) <= 0.0_wp .and. tilted(61) <= 0.0_wp, "the crown is cut off")
      if (allocated(error)) return
      ! the solver's last step is 1e-9 of the load
      call check_scaled(error, maxval(abs(tilted(shift + 1:) - straight(:61 - shift))), 0.0_wp, 1.0_wp, 1.0e-7_wp, "loads")
   end subroutine test_tilted_crown

   subroutine test_sum(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      type(axial_part_t) :: part, turned
      type(error_t), allocatable :: failure
      real(wp) :: loads(41), others(41)
      integer :: i

      profile = profiles(3)
      call new_axial_part(part, profile, roller_length, modulus, [5.0e-3_wp, 9.0e-3_wp], failure)
      profile%tilt = -profile%tilt
      if (.not. allocated(failure)) call new_axial_part(turned, profile, roller_length, modulus, [5.0e-3_wp, 9.0e-3_wp], failure)
      if (has_failed(failure, error)) return
      do i = -2, 12
         call slice_loads(part, 2.0_wp**i, radius, loads)
         call slice_loads(turned, 2.0_wp**i, radius, others)
         call check_close(error, sum(loads)/41, 1.0_wp, 1.0e-13_wp, "sum of the loads")
         if (allocated(error)) return
         call check_scaled(error, maxval(abs(loads - others(41:1:-1))), 0.0_wp, maxval(loads), 1.0e-7_wp, "mirrored loads")
         if (allocated(error)) return
      end do
   end subroutine test_sum

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(axial_part_t) :: part
      type(axial_state_t) :: state
      type(error_t), allocatable :: failure
      type(line_lengths_t) :: lengths, unused(2)
      real(wp) :: loads(41), solved(41), approach, load
      integer :: i, k

      do k = 1, 4
         call new_axial_part(part, profiles(k), roller_length, modulus, [5.0e-3_wp, 30.0e-3_wp], failure)
         if (has_failed(failure, error)) return
         do i = 1, 8
            load = 10.0_wp*2.1_wp**i
            call solve(error, gaps_of(profiles(k), 41), k < 4, load, solved, approach)
            if (allocated(error)) return
            call effective_lengths(part, load, radius, lengths, unused(1), unused(2))
            ! a point for each factor 1.8 of the load, less where the ends begin to carry; what slices make of a contact as narrow:
            ! the square of their part of it
            call check_close(error, lengths%mean, roller_length*41/sum(solved**2), 8.0e-3_wp &
               & + (roller_length/(41*lengths%mean))**2, "effective length")
            if (allocated(error)) return
            call slice_loads(part, load, radius, loads)
            ! a slice at the end of the contact comes in between two points
            call check_scaled(error, maxval(abs(loads - solved)), 0.0_wp, maxval(solved), 2.0e-2_wp &
               & + roller_length/(41*lengths%mean), "loads")
            if (allocated(error)) return
            state = axial_state(part, load, radius)
            call check_close(error, state%peak, maxval(solved), 2.0e-2_wp + roller_length/(41*lengths%mean), &
               & "largest load")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_table

   !> Both sides of a profile without tilt have the same loads: the mean of the place is that of a jump where rounding chooses.
   subroutine test_sides(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      type(axial_part_t) :: part
      type(axial_state_t) :: state
      type(error_t), allocatable :: failure
      real(wp) :: load
      integer :: i, k, slices

      do k = 1, 2
         do slices = 40, 41
            profile = profiles(k)
            profile%slices = slices
            call new_axial_part(part, profile, roller_length, modulus, [5.0e-3_wp, 9.0e-3_wp], failure)
            if (has_failed(failure, error)) return
            do i = 0, 100
               load = 5.0_wp*1.08_wp**i
               state = axial_state(part, load, radius)
               call check(error, state%place >= 0.0_wp, "the largest load is once on the other side")
               if (allocated(error)) return
               ! Pressed hard, a roller has more load at its ends than in the middle of its crown
               if (k == 1 .and. state%peak > state%ends(1)) call check(error, state%place <= 0.0_wp, "a crown without tilt")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_sides

   subroutine test_all(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      type(axial_part_t) :: part
      type(error_t), allocatable :: failure
      type(random_t) :: random
      type(line_lengths_t) :: lengths, unused(2)
      ! Numbers from 0 to 1 [-]
      real(wp) :: x(8)
      integer :: i, k

      call start_random(random, 5)
      do i = 1, 100
         do k = 1, size(x)
            call draw(random, x(k))
         end do
         profile%profile = profile_names(1 + int(3*x(1)))
         profile%crown_radius = 0.3_wp*100.0_wp**x(2)
         profile%design_load = 10.0_wp*500.0_wp**x(3)
         profile%end_drop = 2.0e-5_wp*x(4)
         profile%tilt = 1.0e-3_wp*(2.0_wp*x(5) - 1.0_wp)
         profile%slices = 11 + int(50*x(6))
         call new_axial_part(part, profile, 5.0e-3_wp + 20.0e-3_wp*x(7), modulus, 4.0e-3_wp*[1.0_wp, 1.0_wp + 5.0_wp*x(8)], failure)
         if (allocated(failure)) then
            call expect_error(error, failure, kind_deck, "wider than")
            if (allocated(error)) return
            cycle
         end if
         call effective_lengths(part, 100.0_wp, 5.0e-3_wp, lengths, unused(1), unused(2))
         call check(error, lengths%mean > 0.0_wp .and. lengths%mean <= 1.05_wp*part%length, "length")
         if (allocated(error)) return
      end do
   end subroutine test_all

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t) :: profile
      type(axial_part_t) :: part
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, 7
         profile = profiles(2)
         if (i == 1) profile%profile = "conical"
         if (i == 2) profile%profile = "crowned"
         if (i == 3) profile%design_load = 0.0_wp
         if (i == 4) profile%end_drop = -1.0e-6_wp
         if (i == 5) profile%slices = 10
         if (i == 6) profile%coupling = "all"
         if (i == 7) profile = roller_profile_t(profile="crowned", crown_radius=1.0e-4_wp)
         call new_axial_part(part, profile, roller_length, modulus, [5.0e-3_wp, 9.0e-3_wp], failure)
         call expect_error(error, failure, kind_deck, trim(merge("coupling of slices", "roller profile    ", i == 6)))
         if (allocated(error)) return
      end do
   end subroutine test_refusals

   !> A tilted parabola, which a depth cuts at two places, one or both of them on the roller, and a roller without gaps.
   subroutine test_gaps(error)
      type(error_type), allocatable, intent(out) :: error

      ! Lowest place from the middle [lengths of the roller]; depths over the gap at half a length from it [-]
      real(wp), parameter :: lowest = 0.2_wp, depths(*) = [0.01_wp, 0.1_wp, 0.36_wp, 1.0_wp, 1.9_wp]
      integer, parameter :: counts(*) = [11, 31, 41, 61, 201]
      type(axial_gaps_t) :: table
      ! Place on the parabola [lengths], part of the roller [-]
      real(wp) :: half, part
      integer :: i, k, n

      do k = 1, size(counts)
         n = counts(k)
         table = new_axial_gaps([((2.0_wp*((i - 0.5_wp)/n - 0.5_wp - lowest))**2, i=1, n)])
         do i = 1, size(depths)
            half = 0.5_wp*sqrt(depths(i))
            part = min(lowest + half, 0.5_wp) - max(lowest - half, -0.5_wp)
            ! A line between two slices is above the parabola by 1/n^2 at most, one beyond the last by 3/n^2, over their slopes
            call check(error, part_within(table, depths(i)), part, thr=(0.25_wp/half + 1.25_wp)/n**2, message="part within a depth")
            if (allocated(error)) return
            call check(error, part_within(table, depth_of(table, part)), part, thr=1.0e-12_wp, message="depth of a part")
            if (allocated(error)) return
         end do
      end do
      table = new_axial_gaps(spread(0.0_wp, 1, 21))
      call check(error, part_within(table, depth_of(table, 0.5_wp) + 1.0e-7_wp), 1.0_wp, thr=0.0_wp, message="a cylinder")
   end subroutine test_gaps

end module test_axial
