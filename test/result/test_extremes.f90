!> Extremes of series sampled at angles in any order.
module test_extremes
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_sampled_extremes, only : samples_t, search_t, start_samples, add_sample, start_search, narrow_search
   implicit none
   private

   public :: collect_extremes

contains

   subroutine collect_extremes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("extremes between samples are found", test_between), &
         new_unittest("an extreme at the seam of the turn is found", test_seam), &
         new_unittest("a kink that is sampled stays the extreme", test_kink), &
         new_unittest("of two summits the higher one is found, though rows show it lower", test_summits), &
         new_unittest("a kink between rows is approached to the tolerance, and what is left is known", test_kink_between), &
         new_unittest("beside a jump extremes are looked for, and what is left is told, from one side", test_jump), &
         new_unittest("rows that share an angle but for rounding are no jump", test_twins), &
         new_unittest("of many summits those that are not looked near count as what may be left", test_many), &
         new_unittest("a row that cannot have the extreme is left as soon as that shows", test_no_gain), &
         new_unittest("rows beyond the room at first are kept", test_room), &
         new_unittest("in a part of the turn its own smallest value is found, and none is looked for outside", test_part) &
         ]
   end subroutine collect_extremes

   !> Two waves with extremes 1 and -1 at places of their own, and a constant.
   pure function row(angle, shift) result(values)
      real(wp), intent(in) :: angle, shift
      real(wp) :: values(3)

      values = [cos(angle - shift), sin(2.0_wp*angle + shift), 4.0_wp]
   end function row

   !> Sample at even steps in two passes, then search; the searches' values.
   subroutine sample(samples, steps, shift, lowest, highest, evaluations)
      type(samples_t), intent(out) :: samples
      integer, intent(in) :: steps
      real(wp), intent(in) :: shift
      real(wp), intent(out) :: lowest(3), highest(3)
      integer, intent(out) :: evaluations
      type(search_t) :: search
      real(wp) :: angle, values(3)
      integer :: i, half, series, sense

      call start_samples(samples, 3)
      do half = 0, 1
         do i = half, steps - 1, 2
            angle = two_pi*i/steps - pi
            call add_sample(samples, angle, row(angle, shift), .false.)
         end do
      end do
      evaluations = 0
      do series = 1, 3
         do sense = -1, 1, 2
            call start_search(samples, series, sense, 0.0_wp, search)
            do while (search%is_wanted)
               values = row(search%trial, shift)
               call narrow_search(samples, search, values(series))
               evaluations = evaluations + 1
            end do
            if (sense > 0) lowest(series) = search%value
            if (sense < 0) highest(series) = -search%value
         end do
      end do
   end subroutine sample

   subroutine test_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: lowest(3), highest(3)
      integer :: i, evaluations

      do i = 1, 20
         call sample(samples, 120, 0.1_wp*i, lowest, highest, evaluations)
         ! a gain of 1e-7 of the extent of 2 is not worth a value, a tenth of an accuracy of 1e-6; the samples
         ! alone miss up to 1e-3
         call check(error, maxval(abs(lowest - [-1.0_wp, -1.0_wp, 4.0_wp])) <= 2.0e-7_wp, "smallest")
         if (allocated(error)) return
         call check(error, maxval(abs(highest - [1.0_wp, 1.0_wp, 4.0_wp])) <= 2.0e-7_wp, "largest")
         if (allocated(error)) return
         ! four extremes with a few values each, none for the constant
         call check(error, evaluations <= 4*5, "too many values")
         if (allocated(error)) return
      end do
   end subroutine test_between

   subroutine test_seam(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: lowest(3), highest(3)
      integer :: evaluations

      ! the first wave is highest at a thousandth before the angle where rows of one turn begin
      call sample(samples, 119, -1.0e-3_wp, lowest, highest, evaluations)
      call check(error, highest(1), 1.0_wp, thr=2.0e-6_wp)
   end subroutine test_seam

   subroutine test_kink(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(search_t) :: search
      real(wp) :: angle
      integer :: i

      call start_samples(samples, 1)
      do i = 0, 359
         angle = two_pi*i/360
         call add_sample(samples, angle, [abs(angle - 1.0_wp)*merge(5.0_wp, 1.0_wp, angle > 1.0_wp)], .false.)
      end do
      call add_sample(samples, 1.0_wp, [0.0_wp], .true.)
      call start_search(samples, 1, 1, 0.0_wp, search)
      call check(error, .not. search%is_wanted, "a value beside a kink is wanted")
      if (allocated(error)) return
      call check(error, search%value, 0.0_wp, thr=0.0_wp)
   end subroutine test_kink

   !> Parabolas of heights 1 and 1.001; a row is on top of the lower one, and both rows of the higher one are off its top by half a
   !> step.
   subroutine test_summits(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(search_t) :: search
      ! Step of the rows [rad]
      real(wp), parameter :: step = two_pi/36.0_wp
      real(wp) :: angle
      integer :: i, sense

      do sense = -1, 1, 2
         call start_samples(samples, 1)
         do i = 0, 35
            angle = i*step
            call add_sample(samples, angle, [-sense*summits(angle)], .false.)
         end do
         call start_search(samples, 1, sense, 0.0_wp, search)
         do while (search%is_wanted)
            call narrow_search(samples, search, -sense*summits(search%trial))
         end do
         call check(error, -search%value, 1.001_wp, thr=1.0e-6_wp)
         if (allocated(error)) return
         call check(error, abs(search%point - 20.5_wp*step) < 1.0e-2_wp)
         if (allocated(error)) return
      end do

   contains

      pure function summits(x) result(height)
         real(wp), intent(in) :: x
         real(wp) :: height

         height = max(0.0_wp, 1.0_wp - (x - 6.0_wp*step)**2, 1.001_wp - (x - 20.5_wp*step)**2)
      end function summits

   end subroutine test_summits

   !> What is left bounds the error, is at most the tolerance of the extent, and takes more values the smaller it is.
   subroutine test_kink_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(search_t) :: search
      real(wp) :: angle, tolerance
      integer :: i, power, values, values_before

      values_before = 0
      do power = 2, 5
         call start_samples(samples, 1)
         do i = 0, 35
            angle = two_pi*i/36
            call add_sample(samples, angle, [peak(angle)], .false.)
         end do
         tolerance = 10.0_wp**(-power)
         call start_search(samples, 1, -1, tolerance, search)
         values = 0
         do while (search%is_wanted)
            call narrow_search(samples, search, peak(search%trial))
            values = values + 1
         end do
         call check(error, search%left <= tolerance*(maxval(samples%values(1, :36)) - minval(samples%values(1, :36))))
         if (allocated(error)) return
         ! Straight legs are told by their lines to rounding
         call check(error, 2.0_wp + search%value <= search%left + 10.0_wp*epsilon(1.0_wp) .and. 2.0_wp + search%value >= 0.0_wp)
         if (allocated(error)) return
         call check(error, values >= values_before .and. values <= 20)
         if (allocated(error)) return
         values_before = values
      end do

   contains

      !> Highest at 3.01, where it is 2, steeper after it than before.
      pure function peak(x) result(height)
         real(wp), intent(in) :: x
         real(wp) :: height

         height = 2.0_wp - abs(x - 3.01_wp) - 2.0_wp*max(0.0_wp, x - 3.01_wp)
      end function peak

   end subroutine test_kink_between

   !> A wave that jumps down at 3 rad, or up; its summit is 0.02 rad beyond the jump, so that the row beside it is highest, or 0.02
   !> rad before, between two rows that are 0.07 and 1e-9 rad from the jump.
   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(search_t) :: search
      real(wp), parameter :: place = 3.0_wp
      integer :: i, values, side, hidden

      do side = -1, 1, 2
         do hidden = 0, 1
            call start_samples(samples, 1)
            do i = 0, 43
               call add_sample(samples, two_pi*i/43, [jumping(two_pi*i/43)], .false.)
            end do
            do i = -1, 1
               call add_sample(samples, place + i*1.0e-9_wp, [jumping(place + i*1.0e-9_wp)], .false.)
            end do
            call start_search(samples, 1, -1, 1.0e-6_wp, search)
            values = 0
            do while (search%is_wanted)
               call narrow_search(samples, search, jumping(search%trial))
               values = values + 1
            end do
            ! A gain of 3e-6 of the extent of 2 is not worth a value
            associate (highest => merge(1.0_wp, cos(0.02_wp), hidden == 1))
               call check(error, abs(-search%value - highest) <= 6.0e-6_wp, "the largest value")
               if (allocated(error)) return
               call check(error, highest + search%value <= search%left + 2.0e-9_wp .and. search%left <= 6.0e-6_wp, "what is left")
               if (allocated(error)) return
            end associate
            call check(error, values <= 16, "too many values")
            if (allocated(error)) return
         end do
      end do

   contains

      pure function jumping(x) result(height)
         real(wp), intent(in) :: x
         real(wp) :: height

         height = cos(side*(x - place) + merge(0.02_wp, -0.02_wp, hidden == 1))
         if (side*(x - place) > 0.5e-9_wp) height = height - 1.0e-3_wp
      end function jumping

   end subroutine test_jump

   !> Rows of two cams that do the same, a whole turn apart: the same angles and values, but for rounding.
   subroutine test_twins(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(search_t) :: search
      real(wp), parameter :: rounding = 5.0e-14_wp, place = 3.03_wp
      real(wp) :: angle
      integer :: i, twin, side, behind

      do side = -1, 1, 2
         do behind = -1, 1, 2
            call start_samples(samples, 1)
            do twin = 0, 1
               do i = 0, 43
                  angle = two_pi*i/43
                  call add_sample(samples, angle + side*twin*rounding, [cos(angle - place + behind*0.03_wp) - twin*1.0e-16_wp], &
                     & .false.)
               end do
            end do
            call start_search(samples, 1, -1, 1.0e-6_wp, search)
            do while (search%is_wanted)
               call narrow_search(samples, search, cos(search%trial - place + behind*0.03_wp))
            end do
            ! A gain of 3e-6 of the extent of 2 is not worth a value
            call check(error, -search%value, 1.0_wp, thr=6.0e-6_wp)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_twins

   !> A comb with 180 teeth of one height, rows at the same places of each.
   subroutine test_many(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(search_t) :: search
      real(wp) :: angle
      integer :: i, values

      call start_samples(samples, 1)
      do i = 0, 719
         angle = two_pi*(i + 0.2_wp)/720
         call add_sample(samples, angle, [comb(angle)], .false.)
      end do
      call start_search(samples, 1, -1, 0.0_wp, search)
      values = 0
      do while (search%is_wanted)
         call narrow_search(samples, search, comb(search%trial))
         values = values + 1
      end do
      call check(error, values <= 32*8)
      if (allocated(error)) return
      call check(error, search%left > 1.0e-3_wp .and. 1.0_wp + search%value <= search%left)

   contains

      pure function comb(x) result(height)
         real(wp), intent(in) :: x
         real(wp) :: height

         height = cos(180.0_wp*x)
      end function comb

   end subroutine test_many

   !> Sixteen valleys alike, as of cylinders that do the same, each with a kink close to a row and the next row far off, so that its
   !> lines promise 0.2 below the lowest value, which is elsewhere.
   subroutine test_no_gain(error)
      type(error_type), allocatable, intent(out) :: error
      ! Distance of the valleys, of the rows beside a kink [rad]; depth of a kink [-]
      real(wp), parameter :: period = two_pi/16.0_wp, beside(3) = [-1.0e-3_wp, 2.0e-4_wp, 0.15_wp], depth = 0.8_wp
      type(samples_t) :: samples
      type(search_t) :: search
      real(wp) :: angle
      integer :: i, k, values

      call start_samples(samples, 1)
      do i = 0, 15
         do k = 1, size(beside)
            angle = i*period + beside(k)
            call add_sample(samples, angle, [valleys(angle)], .false.)
         end do
      end do
      angle = 0.5_wp*period
      call add_sample(samples, angle, [valleys(angle)], .false.)
      call start_search(samples, 1, 1, 1.0e-6_wp, search)
      values = 0
      do while (search%is_wanted)
         call narrow_search(samples, search, valleys(search%trial))
         values = values + 1
      end do
      call check(error, search%value, -1.0_wp, thr=1.0e-5_wp)
      if (allocated(error)) return
      ! A gain of 3e-6 of the extent is not worth a value
      call check(error, search%left <= 1.0e-5_wp, "something left")
      if (allocated(error)) return
      ! The lines through a kink are as far below it as their angle to the next row: a value or two of each valley say so
      call check(error, values <= 16*3, "too many values")

   contains

      !> Kinks at multiples of the period, in between a smooth valley half a period after the first one.
      pure function valleys(x) result(height)
         real(wp), intent(in) :: x
         real(wp) :: height

         real(wp) :: offset ! [rad]

         offset = modulo(x + 0.5_wp*period, period) - 0.5_wp*period
         height = -depth + 3.0_wp*abs(offset)
         if (abs(modulo(x, two_pi)/period - 0.5_wp) < 0.2_wp) height = -1.0_wp + (x - 0.5_wp*period)**2
      end function valleys

   end subroutine test_no_gain

   !> Two valleys, of which the part has the shallower one, or ends on the slope of the deeper one.
   subroutine test_part(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(search_t) :: search
      integer, parameter :: rows = 72
      ! Ends of the part [rad]: the end of the second is half a step before its next row
      real(wp), parameter :: ends(2, 2) = reshape([0.5_wp, 2.5_wp, 0.5_wp, two_pi*51.5_wp/rows], [2, 2])
      real(wp) :: angles(rows)
      integer :: i, part

      angles = [(two_pi*(i - 1)/rows, i=1, rows)]
      do part = 1, 2
         call start_samples(samples, 1)
         do i = 1, rows
            call add_sample(samples, angles(i), [valleys(angles(i))], .false.)
         end do
         call start_search(samples, 1, 1, 0.0_wp, search, among=angles > ends(1, part) .and. angles < ends(2, part))
         do while (search%is_wanted)
            call check(error, search%trial > ends(1, part) .and. search%trial < ends(2, part), "a value outside is wanted")
            if (allocated(error)) return
            call narrow_search(samples, search, valleys(search%trial))
         end do
         ! A gain of 1e-7 of the extent of 3 is not worth a value
         if (part == 1) call check(error, search%value, -1.0_wp, thr=3.0e-7_wp)
         if (part == 2) call check(error, search%value, valleys(angles(52)), thr=0.0_wp)
         if (allocated(error)) return
      end do

   contains

      !> Lowest at 1.63, where it is -1, and at 4.48, where it is -2.
      pure function valleys(x) result(height)
         real(wp), intent(in) :: x
         real(wp) :: height

         height = min(1.0_wp, 2.0_wp*(x - 1.63_wp)**2 - 1.0_wp, 3.0_wp*(x - 4.48_wp)**2 - 2.0_wp)
      end function valleys

   end subroutine test_part

   subroutine test_room(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: lowest(3), highest(3)
      integer :: evaluations

      call sample(samples, 5000, 0.3_wp, lowest, highest, evaluations)
      call check(error, samples%count, 5000)
      if (allocated(error)) return
      call check(error, lowest(1), -1.0_wp, thr=2.0e-6_wp)
   end subroutine test_room

end module test_extremes
