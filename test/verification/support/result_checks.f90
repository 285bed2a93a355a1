!> What every result must be, whatever its case: numbers, possible ones, sums that are sums. And what two results of one case by
!> unlike methods may differ by. Each check gives a message, blank where all is well.
module result_checks
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : two_pi, wp
   use camroller_accuracy, only : is_checked
   use camroller_case, only : camshaft_number, case_t, energy_names
   use camroller_number_text, only : integer_text
   use camroller_remarks, only : film_without_limit, loose_tolerance, missed_extremes, missed_means
   use camroller_result, only : result_t, find_quantity, is_film
   use camroller_torque_list, only : is_loss, is_torque, torque_count, torque_series
   use result_values, only : lost_share, scalar_of, series_of
   implicit none
   private

   public :: check_result, check_numbers, check_sums, compare_results, promised_error, series_of, scalar_of, words_of_difference

   !> Energy left over, over the sum of the sizes of all powers: see `cycle_checks`. A camshaft adds up to a handful of followers
   real(wp), parameter :: energy_tolerance = 1000.0_wp*epsilon(1.0_wp)
   !> Rounding of a sum of a few thousand numbers, over the largest of them [-]
   real(wp), parameter :: rounding = 1.0e-11_wp
   !> Part of the speed of pure rolling that counts as no slip [-]
   real(wp), parameter :: least_slip = 1.0e-5_wp
   !> Films by formula grow without limit as the load goes to zero; where a remark says so, their means and largest values hang on
   !> how closely the loss is met
   character(len=*), parameter :: films(*) = [character(len=24) :: "film_thickness_min", "film_thickness_central", &
      & "film_thickness_axial_min", "film_ratio"]
   !> Parts of what friction there is: extremes may be those of next to none, as the same remark says
   character(len=*), parameter :: shares(*) = ["asperity_friction_share"]
   !> Beginning of the names of what dampers lose, less that of a lobe
   character(len=*), parameter :: damping_name = "damping_power_"
   !> Means that are judged by the mean of all losses
   character(len=*), parameter :: drives(*) = [character(len=21) :: "torque_drive", "torque_geometric", "torque_roller_inertia"]
   !> Those of them that hold what the gas pays of the losses
   character(len=*), parameter :: paid(*) = [character(len=18) :: "torque_geometric", "torque_gas_damping"]

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
      if (trouble == "") trouble = check_bearings(case, result)
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
      if (any(series_of(result, "film_thickness_min") > series_of(result, "film_thickness_central") &
         & *(1.0_wp + rounding))) trouble = trouble//" minimum film above central film;"
      if (any(series_of(result, "asperity_load") > maxval(series_of(result, "contact_load")) &
         & *(1.0_wp + rounding))) trouble = trouble//" asperities carry more than the load;"
      do i = 1, size(result%series)
         ! Extremes of the camshafts' torques are those of the reported angles
         if (index(result%series(i)%name, "torque_") == 1 .or. result%series(i)%name == "energy_residual") cycle
         if (index(result%series(i)%name, "camshaft_") == 1 .and. index(result%series(i)%name, "_torque_") > 0) cycle
         low = scalar_of(result, "min_"//result%series(i)%name)
         if (is_film(result%series(i))) low = low*(1.0_wp - lost_share(result))
         mean = scalar_of(result, "mean_"//result%series(i)%name)
         high = scalar_of(result, "max_"//result%series(i)%name)
         if (.not. (mean >= low - rounding*abs(low) .and. mean <= high + rounding*abs(high))) trouble = trouble//" mean "// &
            & result%series(i)%name//" outside its extremes;"
      end do
   end function check_limits

   !> Bearings that have series: their torques are those of all, their journals stay inside them, and boundary friction is part of
   !> the torque.
   function check_bearings(case, result) result(trouble)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble, name
      ! Torque of all bearings [N m]
      real(wp), allocatable :: whole(:)
      integer :: bearing, shaft

      trouble = ""
      if (.not. allocated(case%cam_bearings)) return
      if (.not. case%cam_bearings%by_bearing) return
      ! A choice of effects may have left the bearings out
      name = "bearing_1_torque"
      if (camshaft_number(case) > 1) name = "camshaft_1_"//name
      if (find_quantity(result%series, name) == 0) return
      whole = 0.0_wp*result%angle
      do shaft = 1, camshaft_number(case)
         do bearing = 1, size(case%cam_bearings%bearing_positions)
            name = "bearing_"//integer_text(bearing)//"_"
            if (camshaft_number(case) > 1) name = "camshaft_"//integer_text(shaft)//"_"//name
            whole = whole + series_of(result, name//"torque")
            if (any(series_of(result, name//"eccentricity") < 0.0_wp) .or. any(series_of(result, name//"eccentricity") > 1.0_wp) &
               & .or. any(series_of(result, name//"film_min") <= 0.0_wp)) trouble = trouble//" "//name//" is left by its journal;"
            if (.not. allocated(case%bearing_asperity)) cycle
            if (any(series_of(result, name//"torque_boundary") > series_of(result, name//"torque"))) trouble = trouble//" "//name &
               & //"torque is less than its part;"
            ! A journal that moves away from its bearing is held back by the film
            if (case%cam_bearings%journal_motion == "orbit") cycle
            if (any(series_of(result, name//"asperity_load") > series_of(result, name//"load")*(1.0_wp + rounding))) trouble = &
               & trouble//" "//name//"asperity_load is more than the load;"
         end do
      end do
      if (any(abs(whole - series_of(result, "torque_bearings")) > rounding*maxval(whole))) trouble = trouble// &
         & " torques of bearings do not add up;"
   end function check_bearings

   !> Sums of torques, at every angle and as means; powers are torques times speed.
   function check_sums(case, result) result(trouble)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble
      ! Torques [N m]
      real(wp), allocatable :: friction(:), drive(:)
      real(wp) :: means(2), scale
      integer :: i

      trouble = ""
      friction = 0.0_wp*result%angle
      means = 0.0_wp
      do i = 1, torque_count
         if (.not. is_loss(i)) cycle
         friction = friction + series_of(result, trim(torque_series(i)))
         means(1) = means(1) + scalar_of(result, "mean_"//trim(torque_series(i)))
      end do
      drive = friction
      means(2) = means(1)
      do i = 1, torque_count
         if (is_loss(i) .or. .not. is_torque(i)) cycle
         drive = drive + series_of(result, trim(torque_series(i)))
         means(2) = means(2) + scalar_of(result, "mean_"//trim(torque_series(i)))
      end do
      scale = maxval(abs(friction)) + maxval(abs(series_of(result, "torque_geometric"))) &
         & + maxval(abs(series_of(result, "torque_roller_inertia")))
      if (.not. all(abs(friction - series_of(result, "torque_friction")) <= rounding*scale)) trouble = trouble//" friction;"
      if (.not. all(abs(drive - series_of(result, "torque_drive")) <= rounding*scale)) trouble = trouble//" drive;"
      if (.not. abs(means(1) - scalar_of(result, "mean_torque_friction")) <= rounding*scale) trouble = trouble//" mean friction;"
      if (.not. abs(means(2) - scalar_of(result, "mean_torque_drive")) <= rounding*scale) trouble = trouble//" mean drive;"
      if (.not. abs(means(1)*case%operating_point%speed - scalar_of(result, "power_friction")) &
         & <= rounding*scale*case%operating_point%speed) trouble = trouble//" power;"
      if (allocated(case%dynamics)) then
         if (.not. abs(damping_work(case, result) - scalar_of(result, "work_damping") &
            & - two_pi*scalar_of(result, "mean_torque_gas_damping")) <= rounding*scale) trouble = trouble//" damping;"
      end if
      if (trouble /= "") trouble = "sums of torques:"//trouble
   end function check_sums

   !> Energy lost per turn in the dampers of all followers, one by one.
   function damping_work(case, result) result(work)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      ! [J]
      real(wp) :: work
      character(len=*), parameter :: dampers(*) = [character(len=11) :: "cam", "pad", "seat", "spring", "plunger", "stops", &
         & "leak", "check_valve"]
      ! Lobe shape of each cam
      integer, allocatable :: lobes(:)
      integer :: i

      lobes = [1]
      if (allocated(case%cam_bearings)) lobes = case%cam_bearings%cam_lobes
      work = 0.0_wp
      do i = 1, size(dampers)
         work = work + count(lobes == 1)*scalar_of(result, "damping_work_"//trim(dampers(i))) &
            & + count(lobes == 2)*scalar_of(result, "lobe_2_damping_work_"//trim(dampers(i)))
      end do
   end function damping_work

   !> Energy at every angle, to round-off; over a cycle without gas force and loss of contact, spring and masses give back what they
   !> took.
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
      if (.not. allocated(case%gas_force) .and. .not. lost_share(result) > 0.0_wp) then
         if (abs(scalar_of(result, "mean_torque_geometric")) > rounding*scalar_of(result, "max_torque_geometric")) then
            trouble = " the mean of the geometric torque is not zero;"
         end if
      end if
      power = abs(series_of(result, "torque_geometric")) + abs(series_of(result, "torque_friction")) &
         & + abs(series_of(result, "torque_roller_inertia"))
      power = power*case%operating_point%speed
      if (.not. all(abs(series_of(result, "energy_residual")) <= energy_tolerance*maxval(power))) trouble = &
         & trouble//" energy does not close"
   end function check_energy

   !> Two results of one case: sliding speed, means and extremes within what both promise. Each promises its own distance from the
   !> truth, so that both may be apart by the sum.
   subroutine compare_results(case, one, other, trouble)
      !> The case, but for its method
      type(case_t), intent(in) :: case
      !> The results
      type(result_t), intent(in) :: one, other
      !> What is wrong
      character(len=:), allocatable, intent(out) :: trouble
      ! Sliding speeds and their scale [m/s], difference over the scale, sum of what both promise [-]
      real(wp), allocatable :: first(:), second(:)
      real(wp) :: scale, found, allowed

      trouble = ""
      allowed = promised_error(case, one, "estimated_error") + promised_error(case, other, "estimated_error")
      first = series_of(one, "sliding_speed")
      second = series_of(other, "sliding_speed")
      ! Between the reported angles there may be more
      scale = max(scalar_of(one, "max_sliding_speed"), -scalar_of(one, "min_sliding_speed"), maxval(abs(second)), &
         & least_slip*maxval(abs(series_of(one, "rolling_speed"))))
      found = maxval(abs(first - second))/scale
      if (.not. found <= allowed) trouble = " sliding speeds"//words_of_difference(found, allowed)
      ! Each rise or fall of the calmer curve may be longer or shorter by the difference at both of its ends; what goes beyond are
      ! rises and falls that it does not have
      if (abs(variation(first) - variation(second)) > 2.0_wp*min(pieces(first), pieces(second))*scale &
         & *max(found, allowed)) trouble = trouble//" the sliding speed chatters;"
      call compare_means(one, other, promised_error(case, one, "estimated_error_of_means") + promised_error(case, other, &
         & "estimated_error_of_means"), allocated(case%dynamics), trouble)
      call compare_extremes(one, other, promised_error(case, one, "estimated_error_of_extremes") + promised_error(case, other, &
         & "estimated_error_of_extremes"), trouble)
   end subroutine compare_results

   !> Does a remark of one of two results take back what it promises of a quantity, which it names? All others are still within the
   !> estimate, which is that of the worst.
   pure function is_taken_back(one, other, kind, worst_of_one, worst_of_other, name) result(verdict)
      !> The results
      type(result_t), intent(in) :: one, other
      !> The kind of remark where an accuracy was given
      integer, intent(in) :: kind
      !> What remarks on one and the other name; the quantity
      character(len=*), intent(in) :: worst_of_one, worst_of_other, name
      logical :: verdict

      verdict = any(one%remarks%kind == kind .or. one%remarks%kind == loose_tolerance) .and. worst_of_one == name
      verdict = verdict .or. any(other%remarks%kind == kind .or. other%remarks%kind == loose_tolerance) .and. worst_of_other == name
   end function is_taken_back

   !> Means of all series, over the mean size of each; torques that store and give back, over the mean of all losses, and so all
   !> torques and the dampers of a flexible train.
   subroutine compare_means(one, other, allowed, is_flexible, trouble)
      !> The results
      type(result_t), intent(in) :: one, other
      !> Sum of what both promise of their means [-]
      real(wp), intent(in) :: allowed
      !> Is the train flexible?
      logical, intent(in) :: is_flexible
      !> What is wrong so far
      character(len=:), allocatable, intent(inout) :: trouble
      ! Difference of the means, their scale, what rounding leaves [unit of the series]; difference over scale
      real(wp) :: difference, scale, least, found
      integer :: i

      do i = 1, size(one%series)
         associate (name => one%series(i)%name)
            if (name == "energy_residual" .or. is_without_limit(one, other, name, films)) cycle
            if (is_taken_back(one, other, missed_means, one%worst_mean, other%worst_mean, name)) cycle
            difference = abs(scalar_of(one, "mean_"//name) - scalar_of(other, "mean_"//name))
            least = rounding*maxval(abs(one%series_values(:, i)))
            ! Between the reported angles there may be more
            scale = max(sum(abs(one%series_values(:, i)))/size(one%angle), abs(scalar_of(one, "mean_"//name)), &
               & abs(scalar_of(other, "mean_"//name)))
            if (any(drives == name) .or. (is_flexible .and. index(name, "torque_") == 1)) scale = abs(scalar_of(one, &
               & "mean_torque_friction"))
            if (any(paid == name)) scale = scale + abs(scalar_of(one, "mean_torque_gas_damping"))
            if (index(name, damping_name) > 0) scale = abs(scalar_of(one, "power_friction"))
            scale = max(scale, least_scale(one, name))
            found = max(0.0_wp, difference - least)/max(scale, tiny(1.0_wp))
            if (found > allowed) trouble = trouble//" mean_"//name//words_of_difference(found, allowed)
         end associate
      end do
   end subroutine compare_means

   !> What counts as none of a series: the program's own scale of errors.
   function least_scale(result, name) result(scale)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of a series
      character(len=*), intent(in) :: name
      ! [unit of the series]
      real(wp) :: scale
      character(len=:), allocatable :: lobe

      lobe = name(:merge(7, 0, index(name, "lobe_2_") > 0))
      scale = result%series(find_quantity(result%series, name))%least
      if (name == lobe//"sliding_speed") scale = least_slip*scalar_of(result, "max_"//lobe//"rolling_speed")
      if (name == lobe//"slip_ratio") scale = least_slip
   end function least_scale

   !> Is a series one of a list, and does a remark say that the load falls to next to nothing?
   function is_without_limit(one, other, name, list) result(verdict)
      !> The results
      type(result_t), intent(in) :: one, other
      !> Name of the series, names without that of a lobe
      character(len=*), intent(in) :: name, list(:)
      logical :: verdict
      integer :: lobe

      lobe = merge(2, 1, index(name, "lobe_2_") > 0)
      verdict = any(list == name(merge(8, 1, lobe == 2):))
      if (verdict) verdict = any(one%remarks%kind == film_without_limit .and. max(one%remarks%lobe, 1) == lobe) .or. &
         & any(other%remarks%kind == film_without_limit .and. max(other%remarks%lobe, 1) == lobe)
   end function is_without_limit

   !> Smallest and largest values of all series but torques, over the range of each, and the smallest film over itself.
   subroutine compare_extremes(one, other, allowed, trouble)
      !> The results
      type(result_t), intent(in) :: one, other
      !> Sum of what both promise [-]
      real(wp), intent(in) :: allowed
      !> What is wrong so far
      character(len=:), allocatable, intent(inout) :: trouble
      ! Smallest and largest value of both results, difference, range [unit of the series]
      real(wp) :: values(2, 2), difference, range, least
      integer :: i, k

      do i = 1, size(one%series)
         associate (name => one%series(i)%name)
            if (index(name, "torque_") == 1 .or. name == "energy_residual") cycle
            if (is_taken_back(one, other, missed_extremes, one%worst_extreme, other%worst_extreme, name)) cycle
            if (is_without_limit(one, other, name, shares)) cycle
            values(1, :) = [scalar_of(one, "min_"//name), scalar_of(one, "max_"//name)]
            values(2, :) = [scalar_of(other, "min_"//name), scalar_of(other, "max_"//name)]
            range = max(maxval(values) - minval(values), least_scale(one, name))
            if (index(name, damping_name) > 0) range = damping_range(one, name)
            ! Without a largest value, the smallest counts by itself
            if (is_without_limit(one, other, name, films)) then
               range = minval(values(:, 1))
               values(:, 2) = 0.0_wp
            end if
            least = rounding*maxval(abs(values))
            ! A series of one value for the whole turn is its mean, which is compared as such
            if (maxval(values(:, 2) - values(:, 1)) <= least) cycle
            do k = 1, 2
               difference = max(0.0_wp, abs(values(1, k) - values(2, k)) - least)
               if (difference > allowed*range) trouble = trouble//" "//merge("min_", "max_", k == 1)//name// &
                  & words_of_difference(difference/max(range, tiny(1.0_wp)), allowed)
               if (k == 1 .and. index(name, "film_thickness_min") > 0 .and. difference > allowed*minval(values(:, 1))) then
                  trouble = trouble//" min_"//name//" by itself"//words_of_difference(difference/max(maxval(values(:, 1)), &
                     & tiny(1.0_wp)), allowed)
               end if
            end do
            k = index(name, "contact_load", back=.true.)
            if (k == 0) cycle
            difference = abs(scalar_of(one, name(:k - 1)//"min_event_contact_load") &
               & - scalar_of(other, name(:k - 1)//"min_event_contact_load"))
            if (difference > allowed*range + least) trouble = trouble//" smallest "//name//" of the event" &
               & //words_of_difference(difference/range, allowed)
         end associate
      end do
   end subroutine compare_extremes

   !> Largest range of what a damper of a lobe loses: dampers are one loss together, as in the program's own estimate.
   function damping_range(result, name) result(range)
      !> A result
      type(result_t), intent(in) :: result
      !> Name of a series, with that of the lobe
      character(len=*), intent(in) :: name
      ! [W]
      real(wp) :: range
      integer :: i

      range = 0.0_wp
      do i = 1, size(result%series)
         associate (other => result%series(i)%name, prefix => name(:index(name, damping_name) - 1)//damping_name)
            if (index(other, prefix) == 1) range = max(range, scalar_of(result, "max_"//other) - scalar_of(result, "min_"//other))
         end associate
      end do
   end function damping_range

   !> Rises and falls of a curve.
   pure function pieces(values) result(number)
      !> The curve [any]
      real(wp), intent(in) :: values(:)
      integer :: number
      ! Last change that was one [any]
      real(wp) :: last
      integer :: i

      number = 1
      last = 0.0_wp
      do i = 2, size(values)
         if ((values(i) - values(i - 1))*last < 0.0_wp) number = number + 1
         if (abs(values(i) - values(i - 1)) > 0.0_wp) last = sign(1.0_wp, values(i) - values(i - 1))
      end do
   end function pieces

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
