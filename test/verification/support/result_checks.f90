!> What every result must be, whatever its case: numbers, possible ones, sums that are sums. And what two results of one case by
!> unlike methods may differ by. Each check gives a message, blank where all is well.
module result_checks
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp
   use camroller_accuracy, only : is_checked
   use camroller_case, only : case_t, energy_names
   use camroller_result, only : result_t, find_quantity
   implicit none
   private

   public :: check_result, compare_results, promised_error, series_of, scalar_of, words_of_difference

   !> Energy left over, over the sum of the sizes of all powers: see `cycle_checks`. A camshaft adds up to a handful of followers
   real(wp), parameter :: energy_tolerance = 1000.0_wp*epsilon(1.0_wp)
   !> Rounding of a sum of a few thousand numbers, over the largest of them [-]
   real(wp), parameter :: rounding = 1.0e-11_wp
   !> Part of the speed of pure rolling that counts as no slip [-]
   real(wp), parameter :: least_slip = 1.0e-5_wp
   !> Forces of friction, and asperities. Where the slip is held by a force that rises steeply with it, a rightful error of the slip
   !> is a large one of the force, as one of the film is of the asperities' load, and no estimate says so: differences beyond the
   !> promise are told apart from all others
   character(len=*), parameter :: steep(*) = [character(len=27) :: "friction_hydrodynamic", "friction_boundary_mobilised", &
      & "friction_boundary", "traction", "friction_contact", "asperity_friction_share", "asperity_load", "real_contact_area"]
   !> Load and friction of asperities over the mean load that count as none: with a thick film they are exponentials of it [-]
   real(wp), parameter :: least_part = 1.0e-6_wp
   !> Films by formula grow without limit as the load goes to zero: where contact is lost their means hang on how near they are met
   character(len=*), parameter :: films(*) = [character(len=22) :: "film_thickness_min", "film_thickness_central", "film_ratio"]
   !> Means that are judged by the mean of all losses
   character(len=*), parameter :: drives(*) = [character(len=21) :: "torque_drive", "torque_geometric", "torque_roller_inertia"]
   !> Extremes that are compared
   character(len=*), parameter :: extremes(*) = [character(len=26) :: "min_film_thickness_min", "min_film_thickness_central", &
      & "min_contact_load", "max_contact_load", "max_hertz_pressure"]

contains

   !> One result by itself.
   function check_result(case, result) result(trouble)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      !> What is wrong
      character(len=:), allocatable :: trouble

      trouble = check_numbers(result)
      if (trouble == "") trouble = check_limits(case, result)
      if (trouble == "") trouble = check_sums(case, result)
      if (trouble == "") trouble = check_energy(case, result)
   end function check_result

   !> Are all numbers numbers? Some may be beyond every limit, and say so.
   function check_numbers(result) result(trouble)
      !> The result
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble
      integer :: i

      trouble = ""
      do i = 1, size(result%series)
         if (.not. all(ieee_is_finite(result%series_values(:, i)))) trouble = trouble//" "//result%series(i)%name
      end do
      do i = 1, size(result%summary)
         if (result%summary(i)%may_be_infinite .and. result%summary_values(i) > 0.0_wp) cycle
         if (.not. ieee_is_finite(result%summary_values(i))) trouble = trouble//" "//result%summary(i)%name
      end do
      if (trouble /= "") trouble = "not a number:"//trouble
   end function check_numbers

   !> What cannot be negative, what cannot be more than something else, and means between the extremes.
   function check_limits(case, result) result(trouble)
      !> The case
      type(case_t), intent(in) :: case
      !> The result
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble
      character(len=*), parameter :: not_negative(*) = [character(len=24) :: "valve_lift", "contact_load", "hertz_half_width", &
         & "hertz_pressure", "film_thickness_min", "film_ratio", "asperity_load", "real_contact_area", "friction_contact", &
         & "friction_boundary", "torque_contact", "torque_needle", "torque_guide", "torque_bearings", "torque_friction"]
      ! A spline through a table with noise dips below zero by as much, over the largest lift [-]
      real(wp), parameter :: noise = 1.0e-3_wp
      ! Smallest, mean, largest [unit of the series]
      real(wp) :: low, mean, high
      integer :: i

      trouble = ""
      do i = 1, size(result%series)
         associate (name => result%series(i)%name)
            if (.not. any(not_negative == name(index(name, "lobe_2_") + merge(7, 1, index(name, "lobe_2_") > 0):))) cycle
            ! The source multiplies the bearing's torque by the roller's own spin, which may have the other sign
            if (case%energy /= energy_names(1) .and. (name == "torque_needle" .or. name == "torque_friction")) cycle
            if (any(result%series_values(:, i) < -merge(noise, rounding, index(name, "valve_lift") > 0)*scalar_of(result, &
               & "max_"//name))) trouble = trouble//" "//name &
               & //" is negative;"
         end associate
      end do
      if (any(series_of(result, "film_thickness_min") > series_of(result, "film_thickness_central")*(1.0_wp + rounding))) then
         trouble = trouble//" minimum film above central film;"
      end if
      if (any(series_of(result, "asperity_load") > maxval(series_of(result, "contact_load"))*(1.0_wp + rounding))) then
         trouble = trouble//" asperities carry more than the load;"
      end if
      do i = 1, size(result%series)
         ! Extremes of the camshaft's torques are those of the reported angles
         if (index(result%series(i)%name, "torque_") == 1 .or. result%series(i)%name == "energy_residual") cycle
         low = scalar_of(result, "min_"//result%series(i)%name)
         mean = scalar_of(result, "mean_"//result%series(i)%name)
         high = scalar_of(result, "max_"//result%series(i)%name)
         if (.not. (mean >= low - rounding*abs(low) .and. mean <= high + rounding*abs(high))) trouble = trouble//" mean "// &
            & result%series(i)%name//" outside its extremes;"
      end do
   end function check_limits

   !> Sums of torques, at every angle and as means; powers are torques times speed.
   function check_sums(case, result) result(trouble)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble
      character(len=*), parameter :: parts(*) = [character(len=8) :: "contact", "needle", "guide", "bearings"]
      ! Torques [N m]
      real(wp), allocatable :: friction(:), drive(:)
      real(wp) :: means(2), scale
      integer :: i

      trouble = ""
      friction = 0.0_wp*result%angle
      means = 0.0_wp
      do i = 1, size(parts)
         friction = friction + series_of(result, "torque_"//parts(i))
         means(1) = means(1) + scalar_of(result, "mean_torque_"//parts(i))
      end do
      drive = friction + series_of(result, "torque_geometric") + series_of(result, "torque_roller_inertia")
      means(2) = means(1) + scalar_of(result, "mean_torque_geometric") + scalar_of(result, "mean_torque_roller_inertia")
      scale = maxval(abs(friction)) + maxval(abs(series_of(result, "torque_geometric"))) &
         & + maxval(abs(series_of(result, "torque_roller_inertia")))
      if (.not. all(abs(friction - series_of(result, "torque_friction")) <= rounding*scale)) trouble = trouble//" friction;"
      if (.not. all(abs(drive - series_of(result, "torque_drive")) <= rounding*scale)) trouble = trouble//" drive;"
      if (.not. abs(means(1) - scalar_of(result, "mean_torque_friction")) <= rounding*scale) trouble = trouble//" mean friction;"
      if (.not. abs(means(2) - scalar_of(result, "mean_torque_drive")) <= rounding*scale) trouble = trouble//" mean drive;"
      if (.not. abs(means(1)*case%operating_point%speed - scalar_of(result, "power_friction")) &
         & <= rounding*scale*case%operating_point%speed) trouble = trouble//" power;"
      if (trouble /= "") trouble = "sums of torques:"//trouble
   end function check_sums

   !> Energy at every angle, to round-off; over a cycle without gas force nothing is stored.
   function check_energy(case, result) result(trouble)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble
      ! Sum of the sizes of all powers [W]
      real(wp), allocatable :: power(:)

      trouble = ""
      if (case%energy /= energy_names(1)) return
      power = abs(series_of(result, "torque_geometric")) + abs(series_of(result, "torque_friction")) &
         & + abs(series_of(result, "torque_roller_inertia"))
      power = power*case%operating_point%speed
      if (.not. all(abs(series_of(result, "energy_residual")) <= energy_tolerance*maxval(power))) trouble = &
         & "energy does not close"
   end function check_energy

   !> Two results of one case: sliding speed, means and extremes within what both promise.
   subroutine compare_results(case, one, other, trouble, open)
      !> The case, but for its method
      type(case_t), intent(in) :: case
      !> The results
      type(result_t), intent(in) :: one, other
      !> What is wrong; what no result promises yet
      character(len=:), allocatable, intent(out) :: trouble, open
      ! Sliding speeds and their scale [m/s], difference over the scale, sum of what both promise [-]
      real(wp), allocatable :: first(:), second(:)
      real(wp) :: scale, found, allowed

      trouble = ""
      open = ""
      allowed = promised_error(case, one, "estimated_error") + promised_error(case, other, "estimated_error")
      first = series_of(one, "sliding_speed")
      second = series_of(other, "sliding_speed")
      scale = max(maxval(abs(first)), maxval(abs(second)), least_slip*maxval(abs(series_of(one, "rolling_speed"))))
      found = maxval(abs(first - second))/scale
      if (.not. found <= allowed) trouble = " sliding speeds"//words_of_difference(found, allowed)
      if (abs(variation(first) - variation(second)) > 2.0_wp*scale*allowed) trouble = trouble//" the sliding speed chatters;"
      call compare_means(one, other, promised_error(case, one, "estimated_error_of_means") &
         & + promised_error(case, other, "estimated_error_of_means"), trouble, open)
      if (scalar_of(one, "entrainment_reversals") + scalar_of(other, "entrainment_reversals") > 0.0_wp) then
         call compare_extremes(one, other, allowed, open)
      else
         call compare_extremes(one, other, allowed, trouble)
      end if
   end subroutine compare_results

   !> Means of all series, over the mean size of each; torques that store and give back, over the mean of all losses.
   subroutine compare_means(one, other, allowed, trouble, open)
      !> The results
      type(result_t), intent(in) :: one, other
      !> Sum of what both promise of their means [-]
      real(wp), intent(in) :: allowed
      !> What is wrong so far, what no result promises yet
      character(len=:), allocatable, intent(inout) :: trouble, open
      ! Difference of the means, their scale, what rounding leaves [unit of the series]; difference over scale
      real(wp) :: difference, scale, least, found
      integer :: i

      do i = 1, size(one%series)
         associate (name => one%series(i)%name)
            if (name == "energy_residual") cycle
            difference = abs(scalar_of(one, "mean_"//name) - scalar_of(other, "mean_"//name))
            least = rounding*maxval(abs(one%series_values(:, i)))
            ! Between the reported angles there may be more
            scale = max(sum(abs(one%series_values(:, i)))/size(one%angle), abs(scalar_of(one, "mean_"//name)), &
               & abs(scalar_of(other, "mean_"//name)), least_scale(one, name))
            if (any(drives == name)) scale = abs(scalar_of(one, "mean_torque_friction"))
            ! A slip of next to nothing is as good as none
            if (name == "sliding_speed") scale = max(scale, least_slip*maxval(abs(series_of(one, "rolling_speed"))))
            if (name == "slip_ratio") scale = max(scale, least_slip)
            found = max(0.0_wp, difference - least)/max(scale, tiny(1.0_wp))
            if (found <= allowed) cycle
            if (is_open(one, name)) then
               open = open//" mean_"//name//words_of_difference(found, allowed)
            else
               trouble = trouble//" mean_"//name//words_of_difference(found, allowed)
            end if
         end associate
      end do
   end subroutine compare_means

   !> Does no result promise a mean?
   function is_open(result, name)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of a series
      character(len=*), intent(in) :: name
      logical :: is_open
      integer :: first

      first = merge(8, 1, index(name, "lobe_2_") > 0)
      is_open = any(steep == name(first:))
      if (any(films == name(first:))) is_open = scalar_of(result, name(:first - 1)//"lost_contact_share") > 0.0_wp
   end function is_open

   !> What counts as none of a quantity of the asperities.
   function least_scale(result, name) result(scale)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of a series
      character(len=*), intent(in) :: name
      ! [unit of the series]
      real(wp) :: scale
      ! Load that counts as none, largest load of the asperities [N]
      real(wp) :: least, largest
      character(len=:), allocatable :: lobe

      lobe = name(:merge(7, 0, index(name, "lobe_2_") > 0))
      least = least_part*scalar_of(result, "mean_"//lobe//"contact_load")
      largest = max(scalar_of(result, "max_"//lobe//"asperity_load"), least, tiny(1.0_wp))
      select case (name(len(lobe) + 1:))
      case ("asperity_load", "friction_boundary")
         scale = least
      case ("real_contact_area")
         scale = least/largest*scalar_of(result, "max_"//name)
      case default
         scale = 0.0_wp
      end select
   end function least_scale

   !> Extremes: within the promise, and what may be missed between two points.
   subroutine compare_extremes(one, other, allowed, trouble)
      !> The results
      type(result_t), intent(in) :: one, other
      !> Sum of what both promise [-]
      real(wp), intent(in) :: allowed
      !> What is wrong so far
      character(len=:), allocatable, intent(inout) :: trouble
      ! Extremes, change from point to point beside them, scale [unit of the series]
      real(wp) :: first, second, missed, scale
      character(len=:), allocatable :: name
      integer :: i

      do i = 1, size(extremes)
         name = trim(extremes(i))
         first = scalar_of(one, name)
         second = scalar_of(other, name)
         missed = change_beside(series_of(one, name(5:)), name(:3) == "min")
         scale = max(abs(first), abs(second))
         ! The load is a difference of moments of the size of the largest
         if (name == "min_contact_load") scale = scalar_of(one, "max_contact_load")
         if (abs(first - second) <= allowed*scale + missed) cycle
         trouble = trouble//" "//name//words_of_difference((abs(first - second) - missed)/scale, allowed)
      end do
   end subroutine compare_extremes

   !> Largest change to a point beside an extreme.
   pure function change_beside(values, is_smallest) result(change)
      !> A series
      real(wp), intent(in) :: values(:)
      !> Beside the smallest or the largest value?
      logical, intent(in) :: is_smallest
      ! [unit of the series]
      real(wp) :: change
      integer :: place, n

      n = size(values)
      place = merge(minloc(values, 1), maxloc(values, 1), is_smallest)
      change = max(abs(values(place) - values(modulo(place, n) + 1)), abs(values(place) - values(modulo(place - 2, n) + 1)))
   end function change_beside

   !> Sum of all changes.
   pure function variation(values)
      ! [m/s]
      real(wp), intent(in) :: values(:)
      real(wp) :: variation

      variation = sum(abs(values(2:) - values(:size(values) - 1)))
   end function variation

   !> What a result promises of its sliding speed or of its means.
   function promised_error(case, result, estimate) result(promised)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      !> Name of its estimate
      character(len=*), intent(in) :: estimate
      ! [-]
      real(wp) :: promised

      promised = max(scalar_of(result, estimate), case%numerics%tolerance)
      if (is_checked(case%numerics)) promised = max(promised, case%numerics%accuracy)
   end function promised_error

   !> A series; zeros where the result does not have it.
   function series_of(result, name) result(values)
      !> The result
      type(result_t), intent(in) :: result
      !> Its name
      character(len=*), intent(in) :: name
      ! [unit of the series]
      real(wp), allocatable :: values(:)
      integer :: place

      place = find_quantity(result%series, trim(name))
      if (place == 0) then
         values = 0.0_wp*result%angle
      else
         values = result%series_values(:, place)
      end if
   end function series_of

   !> A scalar; zero where the result does not have it.
   function scalar_of(result, name) result(value)
      !> The result
      type(result_t), intent(in) :: result
      !> Its name
      character(len=*), intent(in) :: name
      ! [unit of the scalar]
      real(wp) :: value
      integer :: place

      value = 0.0_wp
      place = find_quantity(result%summary, trim(name))
      if (place > 0) value = result%summary_values(place)
   end function scalar_of

   !> A difference beside what is allowed, in words.
   function words_of_difference(found, allowed) result(words)
      ! [-]
      real(wp), intent(in) :: found, allowed
      character(len=:), allocatable :: words
      character(len=40) :: buffer

      write (buffer, "(a, es9.2, a, es9.2, a)") " differ by", found, " of", allowed, ";"
      words = trim(buffer)
   end function words_of_difference

end module result_checks
