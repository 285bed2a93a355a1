!> Load along a loaded part of the roller: lengths against Hertz' ellipse and over sweeps, the function of a strip.
module test_axial_window
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_axial_loads, only : solved_loads
   use camroller_axial_window, only : fit_window, window_t
   use camroller_axial_table, only : axial_part_t, axial_state, axial_state_t, effective_lengths, new_axial_part, slice_loads
   use camroller_error, only : error_t
   use camroller_kinds, only : wp
   use camroller_roller_profile, only : roller_profile_t
   use camroller_strip, only : strip_function
   use camroller_traction, only : line_lengths_t
   use closeness, only : check_close, check_scaled, expect_success
   use hertz_ellipse, only : find_ellipse
   implicit none
   private

   public :: collect_axial_window

   !> Length of the roller, radius [m]; modulus of steel on steel [Pa]
   real(wp), parameter :: roller_length = 13.7e-3_wp, radius = 6.0e-3_wp, modulus = 2.27e11_wp

contains

   subroutine collect_axial_window(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the function of a strip is the mean over its semi-ellipse, and its slope", test_strip), &
         new_unittest("lengths of crowned rollers are those of Hertz' ellipse at any load and number of slices", test_crowns), &
         new_unittest("a flatter crown has a longer contact", test_flatter), &
         new_unittest("a larger tilt has a shorter contact, and more load at the end", test_tilts), &
         new_unittest("slices of the roller carry the load of a contact shorter than one of them", test_short), &
         new_unittest("a part far shorter than the contact has no loads", test_cut_off) &
         ]
   end subroutine collect_axial_window

   !> `4/pi int_0^1 sqrt(1 - x^2) asinh(t/x) dx`, integrated with 25 digits and more by `tools/strip_function_fit.py`.
   subroutine test_strip(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: ratios(*) = [0.02_wp, 0.2_wp, 0.7_wp, 0.999_wp, 1.001_wp, 1.5_wp, 4.0_wp, 30.0_wp], h = 1.0e-4_wp
      ! F at these ratios [-]
      real(wp), parameter :: expected(*) = [0.1349253239483335_wp, 0.7656738284075569_wp, 1.627002882577419_wp, &
         & 1.939006577707757_wp, 1.940819565952785_wp, 2.317520589906749_wp, 3.276450161689485_wp, 5.287561172764477_wp]
      real(wp), dimension(size(ratios)) :: values, slopes, low, high

      call strip_function(ratios, log(ratios), 1.0_wp, values, slopes)
      call check_scaled(error, maxval(abs(values - expected)), 0.0_wp, 1.0_wp, 1.0e-12_wp, "the function")
      if (allocated(error)) return
      call strip_function(3.0_wp*ratios*exp(-h), log(3.0_wp*ratios*exp(-h)), 3.0_wp, low)
      call strip_function(3.0_wp*ratios*exp(h), log(3.0_wp*ratios*exp(h)), 3.0_wp, high)
      ! Third derivatives of about one, times h squared over 6
      call check_scaled(error, maxval(abs(slopes - (high - low)/(2.0_wp*h))), 0.0_wp, 1.0_wp, 1.0e-6_wp, "its slope")
   end subroutine test_strip

   subroutine make_part(part, error, profile)
      type(axial_part_t), intent(out) :: part
      type(error_type), allocatable, intent(out) :: error
      type(roller_profile_t), intent(in) :: profile
      type(error_t), allocatable :: failure

      call new_axial_part(part, profile, roller_length, modulus, [5.0e-3_wp, 30.0e-3_wp], failure)
      call expect_success(error, failure)
   end subroutine make_part

   !> The effective length of a parabola is 5/3 of its half length, the loaded one twice that, and the largest load 3/(4 a) of all.
   subroutine test_crowns(error)
      type(error_type), allocatable, intent(out) :: error
      ! Radii of the crown [m], loads [N]
      real(wp), parameter :: crowns(*) = [0.05_wp, 0.1_wp, 0.268_wp, 0.5_wp, 1.0_wp, 1.5_wp], loads(*) = [4.0_wp, 16.0_wp, 64.0_wp]
      ! What n slices leave: 2/n^2, measured 0.004 with 21 of them at most, 0.001 with 41 (0.1 with powers of the load below seven
      ! slices), and 8 b^2/a^2 per cent where the ellipse is not slender [-]
      real(wp), parameter :: close = 2.0_wp, stout = 0.08_wp
      integer, parameter :: counts(*) = [21, 41, 81]
      type(axial_part_t) :: part
      type(roller_profile_t) :: profile
      type(line_lengths_t) :: lengths, by_load, by_radius
      type(axial_state_t) :: state
      real(wp) :: a, ratio, allowed ! half length [m], axes' ratio, error [-]
      integer :: i, k, n

      profile%profile = "crowned"
      do n = 1, size(counts)
         profile%slices = counts(n)
         do i = 1, size(crowns)
            profile%crown_radius = crowns(i)
            call make_part(part, error, profile)
            do k = 1, size(loads)
               if (allocated(error)) return
               call find_ellipse(crowns(i), loads(k), radius, modulus, a, ratio)
               allowed = close/counts(n)**2 + stout*ratio**2
               call effective_lengths(part, loads(k), radius, lengths, by_load, by_radius)
               call check_close(error, lengths%mean, 5.0_wp/3.0_wp*a, allowed, "effective length")
               if (.not. allocated(error)) call check_close(error, lengths%loaded, 2.0_wp*a, 10.0_wp*allowed, "loaded length")
               if (.not. allocated(error)) call check_scaled(error, by_load%mean, 1.0_wp/3.0_wp, 1.0_wp, 0.01_wp, "power")
               state = axial_state(part, loads(k), radius)
               if (.not. allocated(error)) call check_close(error, state%peak, 0.75_wp*roller_length/a, allowed &
                  & + (4.0_wp/counts(n))**2, "peak")
               if (.not. allocated(error)) call check(error, all(abs([state%place, state%ends]) <= 0.0_wp), "place, ends")
            end do
         end do
      end do
   end subroutine test_crowns

   !> Steps of half a per cent in the radius of the crown, with which the length goes as its root or so.
   subroutine test_flatter(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: first = 0.2_wp, step = 1.005_wp ! [m], [-]
      type(axial_part_t) :: part
      type(roller_profile_t) :: profile
      type(line_lengths_t) :: lengths, unused(2)
      real(wp) :: before ! [m]
      integer :: i

      profile%profile = "crowned"
      before = 0.0_wp
      do i = 0, 100
         profile%crown_radius = first*step**i
         call make_part(part, error, profile)
         if (allocated(error)) return
         call effective_lengths(part, 64.0_wp, radius, lengths, unused(1), unused(2))
         call check(error, lengths%mean > before, "a flatter crown has a shorter contact")
         if (allocated(error)) return
         if (i > 0) call check(error, lengths%mean < before*step, "a jump of the length")
         if (allocated(error)) return
         before = lengths%mean
      end do
   end subroutine test_flatter

   !> Logarithmic rollers, the end of which carries load at some tilts.
   subroutine test_tilts(error)
      type(error_type), allocatable, intent(out) :: error
      ! Largest step of a length: 1.5 times that of a tilt; before, lengths jumped by 6 % [-]; steps of the tilt
      real(wp), parameter :: largest = 0.03_wp
      integer, parameter :: steps = 60
      real(wp), parameter :: loads(*) = [16.0_wp, 64.0_wp, 300.0_wp] ! [N]
      type(axial_part_t) :: part
      type(roller_profile_t) :: profile
      type(line_lengths_t) :: lengths, unused(2)
      real(wp) :: before(size(loads)) ! [m]
      integer :: i, k

      profile%profile = "logarithmic"
      profile%design_load = 1.0e3_wp
      profile%end_drop = 8.0e-6_wp
      before = 0.0_wp
      do i = 0, steps
         profile%tilt = 1.0e-3_wp*(0.5_wp + real(i, wp)/steps)
         call make_part(part, error, profile)
         if (allocated(error)) return
         do k = 1, size(loads)
            call effective_lengths(part, loads(k), radius, lengths, unused(1), unused(2))
            if (i > 0) call check(error, lengths%mean < before(k) .and. lengths%mean > before(k)*(1.0_wp - largest), "a jump")
            if (allocated(error)) return
            before(k) = lengths%mean
         end do
      end do
   end subroutine test_tilts

   !> A crown's contact under 0.5 N, within the slice in the middle: that carries all.
   subroutine test_short(error)
      type(error_type), allocatable, intent(out) :: error
      type(axial_part_t) :: part
      type(roller_profile_t) :: profile
      real(wp) :: table(41), solved(41)

      profile%profile = "crowned"
      profile%crown_radius = 0.1_wp
      call make_part(part, error, profile)
      if (allocated(error)) return
      call slice_loads(part, 0.5_wp, radius, table)
      call solved_loads(part, 0.5_wp, radius, solved)
      call check_close(error, table(21), 41.0_wp, 1.0e-12_wp, "load of the slice in the middle")
      if (.not. allocated(error)) call check_close(error, solved(21), 41.0_wp, 1.0e-12_wp, "solved load")
      if (.not. allocated(error)) call check_close(error, sum(table)/41, 1.0_wp, 1.0e-12_wp, "sum")
   end subroutine test_short

   !> A part of a thousandth of the roller amid a contact all along it: a fifth longer twelve times, it still cuts the contact off.
   subroutine test_cut_off(error)
      type(error_type), allocatable, intent(out) :: error
      type(window_t) :: window
      type(roller_profile_t) :: profile
      integer :: status

      profile%profile = "crowned"
      profile%crown_radius = 1.0_wp
      window%bounds = [-0.5e-3_wp, 0.5e-3_wp]
      allocate (window%loads(41), source=1.0_wp)
      call fit_window(window, profile, roller_length, modulus, 300.0_wp, radius, status)
      call check(error, status > 0, "loads of a contact that is cut off")
      if (allocated(error)) return
      window%bounds = [-0.5_wp, 0.5_wp]
      window%loads = 1.0_wp
      call fit_window(window, profile, roller_length, modulus, 300.0_wp, radius, status)
      call check(error, status == 0, "no loads from the whole roller on")
   end subroutine test_cut_off

end module test_axial_window
