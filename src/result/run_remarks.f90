!> Remarks on a result as a whole: an accuracy that was not reached, a tolerance that says nothing of the error, a motion without a
!> period; a roller that does not turn, a contact of it that is short, a rigid train that would vibrate, slip that is the creep
!> of regularised friction.
!>
!> In: numerics as given, the result of a case. Out: remarks, or an error where nothing of the result can be right.
module camroller_run_remarks
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence, kind_internal
   use camroller_asperity, only : asperity_t, mobilisation_names
   use camroller_boundary_law, only : boundary_law_names, boundary_law_t, boundary_table
   use camroller_accuracy, only : is_checked, has_tolerance, far_beyond
   use camroller_case, only : case_t, numerics_t
   use camroller_number_text, only : fixed_text, number_text
   use camroller_catalogue, only : lobe_prefix
   use camroller_flexible_parts, only : usual_dynamics
   use camroller_remarks, only : add_remark, creeping_roller, foreign_speed, held_coefficient, idle_roller, loose_tolerance, &
      & missed_accuracy, missed_extremes, missed_means, no_period, shaken_train, short_contact
   use camroller_result, only : find_quantity, get_summary, lobe_scope, result_t
   implicit none
   private

   public :: judge, judge_assumptions, add_named, lobe_count, take_scalar

   !> Slip over a turn of the cam beyond which a roller does not roll: those of engines slip by some per cent, and by half on their
   !> base circle alone; one that makes less than a tenth of its turns is a sliding follower [-]
   real(wp), parameter :: idle_slip = 0.9_wp
   !> Half width of a contact over its effective length from where on its load along the roller is not that of a contact far longer
   !> than wide: for a crown with half the axes' ratio, whose effective length is 1.6 per cent below that of Hertz' ellipse [-]
   real(wp), parameter :: shortest_contact = 0.29_wp
   !> Largest load of a train that vibrates over that of a rigid one from where on the rigid one misleads, since friction goes with
   !> the load: twice what the estimate is off by where it is farthest off, 0.05 at 2500 rev/min (doc/dynamics.md) [-]
   real(wp), parameter :: shaken_factor = 1.1_wp
   !> Mean slip above which a creeping roller may be taken for one that slides: those of the reference train slip by 3 % and more
   !> where they do, and by less than 0.1 % where asperities hold them [-]
   real(wp), parameter :: notable_slip = 0.005_wp

contains

   !> Remarks on errors that are too large.
   subroutine judge(numerics, result, error)
      !> Numerics as given
      type(numerics_t), intent(in) :: numerics
      !> The result
      type(result_t), intent(inout) :: result
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Estimated errors of sliding speed, means and extremes [-]
      real(wp) :: estimates(3)

      call get_estimates(result, estimates, error)
      if (allocated(error)) return
      if (is_checked(numerics)) call judge_accuracy(result, numerics%accuracy, estimates, error)
      if (has_tolerance(numerics)) call judge_tolerance(numerics, result, estimates)
      call judge_turns(result)
   end subroutine judge

   !> Remarks on what the model takes for granted and a result contradicts.
   subroutine judge_assumptions(case, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The result
      type(result_t), intent(inout) :: result
      !> Internal error where the result lacks what it should have
      type(error_t), allocatable, intent(out) :: error

      if (allocated(case%roller_profile)) call judge_length(result)
      call judge_stiffness(case%mechanism%pivot_to_roller, result, error)
      if (.not. allocated(error)) call judge_creep(case%asperity, allocated(case%wear), result, error)
      if (.not. allocated(case%boundary_law) .or. allocated(error)) return
      call judge_speed(case%boundary_law, result, error)
      ! A modifier or film has a coefficient of its own
      if (allocated(case%friction_modifier) .or. allocated(case%tribofilm) .or. allocated(error)) return
      call judge_bounds(case%boundary_law, result, error)
   end subroutine judge_assumptions

   !> Say that a boundary law would go below its smallest or above its largest coefficient; points of a table tell with the deck.
   subroutine judge_bounds(law, result, error)
      type(boundary_law_t), intent(in) :: law
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: values(3) ! Smallest and largest coefficient [-], smallest load [N]
      character(len=:), allocatable :: prefix, text
      integer :: lobe

      if (law%law == boundary_law_names(boundary_table)) return
      do lobe = 1, lobe_count(result)
         prefix = trim(lobe_prefix(lobe))
         call take_scalar(result, "min_"//prefix//"boundary_coefficient", values(1), error)
         call take_scalar(result, "max_"//prefix//"boundary_coefficient", values(2), error)
         call take_scalar(result, "min_"//prefix//"contact_load", values(3), error)
         if (allocated(error)) return
         text = "" ! Without contact there is no smallest one
         if (values(1) <= law%smallest .and. values(3) > 0.0_wp) text = "smallest_coefficient = "//number_text(law%smallest, 3)
         if (values(2) >= law%largest .and. text /= "") text = text//" and "
         if (values(2) >= law%largest) text = text//"largest_coefficient = "//number_text(law%largest, 3)
         if (text /= "") call add_named(result, lobe, held_coefficient, "the law of &boundary_law goes beyond boundary_law."// &
            & text//", at which it is held for a part of the cycle: it is far from its reference", 0.0_wp)
      end do
   end subroutine judge_bounds

   !> Say that a roller hardly turns.
   subroutine judge_turns(result)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result

      integer :: lobe, place

      do lobe = 1, lobe_count(result)
         place = find_quantity(result%summary, trim(lobe_prefix(lobe))//"revolution_slip")
         if (place == 0) exit
         associate (slip => result%summary_values(place))
            if (slip < idle_slip .or. slip > 2.0_wp - idle_slip) cycle
            call add_named(result, lobe, idle_roller, "the roller hardly turns: in a turn of the cam it slips by "// &
               & number_text(100.0_wp*slip, 3)//" % of the turns of pure rolling; it is a sliding follower, which heats and "// &
               & "wears its ring at one place, where this is the state of the engine at all", slip)
         end associate
      end do
   end subroutine judge_turns

   !> Say that a contact is so short for its width that it is hardly a line contact.
   subroutine judge_length(result)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result

      ! Half width over effective length, zero without contact [-]
      real(wp), allocatable :: ratio(:)
      integer :: lobe, half, whole, i

      allocate (ratio(size(result%series_values, 1)))
      do lobe = 1, lobe_count(result)
         half = find_quantity(result%series, trim(lobe_prefix(lobe))//"hertz_half_width")
         whole = find_quantity(result%series, trim(lobe_prefix(lobe))//"effective_contact_length")
         if (min(half, whole) == 0) exit
         associate (lengths => result%series_values(:, whole))
            ratio = 0.0_wp
            where (lengths > 0.0_wp) ratio = result%series_values(:, half)/max(lengths, tiny(1.0_wp))
            i = maxloc(ratio, 1)
            if (.not. ratio(i) > shortest_contact) cycle
            call add_named(result, lobe, short_contact, "the contact is as short as "//number_text(1.0e3_wp*lengths(i), 3)// &
               & " mm (effective length) where it is "//number_text(2.0e3_wp*result%series_values(i, half), 3)//" mm wide, at "// &
               & number_text(result%angle(i), 3)//" deg: no line contact any more, which load along the roller, film and "// &
               & "friction take it for; a crown's is 1.6 % too short at "//number_text(2.0_wp*shortest_contact, 2)// &
               & " of its length, 4 % at all of it", ratio(i))
         end associate
      end do
   end subroutine judge_length

   !> Say that a train which is computed as a rigid one would vibrate.
   subroutine judge_stiffness(arm, result, error)
      !> Distance from the finger's pivot to the roller's centre [m]
      real(wp), intent(in) :: arm
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      ! Estimated largest load over that of a rigid train [-], natural frequency [Hz]
      real(wp) :: factor, frequency
      character(len=:), allocatable :: prefix
      integer :: lobe

      do lobe = 1, lobe_count(result)
         prefix = trim(lobe_prefix(lobe))
         if (find_quantity(result%summary, prefix//"dynamic_load_max") > 0) exit
         if (find_quantity(result%summary, prefix//"load_factor") == 0) exit
         call take_scalar(result, prefix//"load_factor", factor, error)
         call take_scalar(result, prefix//"train_frequency", frequency, error)
         if (allocated(error)) return
         if (.not. factor > shaken_factor) cycle
         associate (usual => usual_dynamics(arm))
            call add_named(result, lobe, shaken_train, "the train is computed as a rigid one; with stiffness usual for its "// &
               & "size, "//number_text(usual%finger_stiffness, 2)//" N/m of the finger and "// &
               & number_text(usual%pad_stiffness, 2)//" of its pad, its natural frequency is about "// &
               & number_text(frequency, 2)//" Hz, and its largest contact load an estimated "//number_text(factor, 3)// &
               & " times that of the rigid one; &dynamics with that stiffness computes it", factor)
         end associate
      end do
   end subroutine judge_stiffness

   !> Say that all slip is what regularised friction lets a roller creep, which it holds.
   subroutine judge_creep(asperity, has_wear, result, error)
      !> Asperities of the case
      type(asperity_t), intent(in), allocatable :: asperity
      !> Does the case have wear, which goes with the slip however small it is?
      logical, intent(in) :: has_wear
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      ! Sliding speed, smallest and largest [m/s]; mean slip [-]
      real(wp) :: speeds(2), slip
      character(len=:), allocatable :: prefix
      integer :: lobe

      if (.not. allocated(asperity)) return
      if (asperity%mobilisation /= mobilisation_names(1)) return
      do lobe = 1, lobe_count(result)
         prefix = trim(lobe_prefix(lobe))
         if (find_quantity(result%summary, "max_"//prefix//"sliding_speed") == 0) exit
         call take_scalar(result, "min_"//prefix//"sliding_speed", speeds(1), error)
         call take_scalar(result, "max_"//prefix//"sliding_speed", speeds(2), error)
         call take_scalar(result, "mean_"//prefix//"slip_ratio", slip, error)
         if (allocated(error)) return
         if (.not. (maxval(abs(speeds)) < asperity%mobilising_speed .and. (has_wear .or. abs(slip) > notable_slip))) cycle
         call add_named(result, lobe, creeping_roller, "the roller slides by less than asperity.mobilising_speed_m_s ("// &
            & number_text(asperity%mobilising_speed, 3)//") all round the cam, up to "//number_text(maxval(abs(speeds)), 3)// &
            & " m/s: asperities hold it, and their regularised friction lets it creep; slip, sliding distance and wear go with "// &
            & "that speed, and with mobilisation = 'stick_slip' there are none", 100.0_wp*abs(slip))
      end do
   end subroutine judge_creep

   !> Say that the roller slides all round so slowly that a law of boundary friction does not depend on the speed.
   subroutine judge_speed(law, result, error)
      type(boundary_law_t), intent(in) :: law
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      ! Sliding speed, smallest and largest, lowest of the law [m/s]
      real(wp) :: speeds(2), lowest
      character(len=:), allocatable :: prefix, words
      integer :: lobe

      lowest = law%lowest_speed
      words = "boundary_law.lowest_speed_m_s"
      if (law%law == boundary_law_names(boundary_table)) then
         lowest = law%speed_points(1)
         words = "the first speed of the table of &boundary_law"
      end if
      do lobe = 1, lobe_count(result)
         prefix = trim(lobe_prefix(lobe))
         if (find_quantity(result%summary, "max_"//prefix//"sliding_speed") == 0) exit
         call take_scalar(result, "min_"//prefix//"sliding_speed", speeds(1), error)
         call take_scalar(result, "max_"//prefix//"sliding_speed", speeds(2), error)
         if (allocated(error)) return
         if (maxval(abs(speeds)) >= lowest) cycle
         call add_named(result, lobe, foreign_speed, "the roller slides by "//number_text(maxval(abs(speeds)), 3)// &
            & " m/s at most, all round below "//words//" ("//number_text(lowest, 3)//"): the boundary coefficient does not "// &
            & "depend on the speed there, it is that of the law at its lowest speed", &
            & lowest/max(maxval(abs(speeds)), tiny(lowest)))
      end do
   end subroutine judge_speed

   !> Add a remark, with the name of its lobe shape where there are several.
   subroutine add_named(result, lobe, kind, text, size)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Lobe shape, from 1
      integer, intent(in) :: lobe
      !> Kind of the remark
      integer, intent(in) :: kind
      !> In words, on one line
      character(len=*), intent(in) :: text
      !> Severity [-]
      real(wp), intent(in) :: size

      if (lobe_count(result) > 1) then
         call add_remark(result%remarks, kind, trim(lobe_scope(lobe))//": "//text, size)
         result%remarks(ubound(result%remarks, 1))%lobe = lobe
      else
         call add_remark(result%remarks, kind, text, size)
      end if
   end subroutine add_named

   !> Number of lobe shapes of a result.
   pure function lobe_count(result) result(lobes)
      !> The result
      type(result_t), intent(in) :: result
      !> The number
      integer :: lobes

      lobes = 0
      do while (find_quantity(result%summary, trim(lobe_prefix(lobes + 1))//"revolution_slip") > 0)
         lobes = lobes + 1
      end do
   end function lobe_count

   !> A scalar that a result should have.
   subroutine take_scalar(result, name, value, error)
      !> The result
      type(result_t), intent(in) :: result
      !> Name of the scalar
      character(len=*), intent(in) :: name
      !> Its value [unit of the scalar]
      real(wp), intent(out) :: value
      !> Internal error where the result lacks it, or one that is there already
      type(error_t), allocatable, intent(inout) :: error

      value = 0.0_wp
      if (allocated(error)) return
      call get_summary(result, name, value, error)
      if (allocated(error)) error%kind = kind_internal
   end subroutine take_scalar

   !> Remarks on an accuracy that was not reached, or an error where nothing of the result can be right.
   subroutine judge_accuracy(result, accuracy, estimates, error)
      type(result_t), intent(inout) :: result
      !> Accuracy wanted [-]
      real(wp), intent(in) :: accuracy
      !> Estimated errors of sliding speed, means and extremes [-]
      real(wp), intent(in) :: estimates(3)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Cam angle where the estimate is largest [deg]
      real(wp) :: angle

      if (estimates(1) >= 1.0_wp .and. .not. lacks_period(result)) then
         call get_summary(result, "estimated_error_angle", angle, error)
         if (allocated(error)) return
         call raise(error, kind_convergence, "the cycle was not found: its estimated error is "//number_text(estimates(1), 2)// &
            & " of the sliding speed, largest at cam angle "//fixed_text(angle, 3)//" deg; the spin is hardly damped there, or "// &
            & "friction reaches its limit abruptly")
         return
      end if
      if (estimates(1) > accuracy .and. lacks_period(result)) then
         call say_scatter(result, estimates(1))
      else if (estimates(1) > accuracy) then
         call add_remark(result%remarks, missed_accuracy, "the accuracy asked for was not reached; the estimated error is "// &
            & number_text(estimates(1), 2), estimates(1))
      end if
      if (estimates(2) > accuracy) call add_remark(result%remarks, missed_means, &
         & "the means did not reach the accuracy asked for; the largest estimated error, of mean_"//trim(result%worst_mean)// &
         & ", is "//number_text(estimates(2), 2), estimates(2))
      if (lacks_period(result)) then
         call say_no_period(result)
      else if (estimates(3) > accuracy) then
         call add_remark(result%remarks, missed_extremes, "the extremes did not reach the accuracy asked for; the largest "// &
            & "estimated error, of "//trim(result%worst_extreme)//", is "//number_text(estimates(3), 2)//" of its range", &
            & estimates(3))
      end if
   end subroutine judge_accuracy

   !> Is a train of the case without a period?
   pure function lacks_period(result) result(verdict)
      type(result_t), intent(in) :: result
      !> Is one?
      logical :: verdict

      integer :: i

      verdict = any([(result%remarks(i)%kind == no_period, i=1, size(result%remarks))])
   end function lacks_period

   !> Remark on the error of a motion without a period.
   subroutine say_scatter(result, estimate)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Error estimated [-]
      real(wp), intent(in) :: estimate

      call add_remark(result%remarks, missed_accuracy, "the motion without a period is known by its statistics alone: within a "// &
         & "turn errors of steps grow to an estimated "//number_text(estimate, 2)//" of the largest load or sliding speed, and "// &
         & "a smaller tolerance leads along other turns; go by the summary and its scatter over the cycles, not by the series", &
         & estimate)
   end subroutine say_scatter

   !> Remark on extremes of a motion without a period: a smaller tolerance leads along other turns, and no accuracy changes that.
   subroutine say_no_period(result)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result

      call add_remark(result%remarks, missed_extremes, "smallest and largest values are those of the turns computed: without a "// &
         & "period they have no error that could be estimated")
   end subroutine say_no_period

   !> Remark on a tolerance given by hand that says nothing of the error: steps keep to it and the curve between them does not, or
   !> errors of steps pile up where hardly anything damps, or means follow the sliding speed too strongly.
   subroutine judge_tolerance(numerics, result, estimates)
      !> Numerics as given
      type(numerics_t), intent(in) :: numerics
      type(result_t), intent(inout) :: result
      !> Estimated errors of sliding speed, means and extremes [-]
      real(wp), intent(in) :: estimates(3)

      if (estimates(1) > numerics%tolerance*far_beyond .and. lacks_period(result)) then
         call say_scatter(result, estimates(1))
      else if (estimates(1) > numerics%tolerance*far_beyond) then
         call say_far("the error", estimates(1))
      end if
      if (estimates(2) > numerics%tolerance*far_beyond) call say_far("the error of mean_"//trim(result%worst_mean), estimates(2))
      if (lacks_period(result)) then
         call say_no_period(result)
      else if (estimates(3) > numerics%tolerance*far_beyond) then
         call say_far("the error of the extremes of "//trim(result%worst_extreme), estimates(3))
      end if

   contains

      !> The remark on one of the errors.
      subroutine say_far(what, estimate)
         !> The error in words
         character(len=*), intent(in) :: what
         !> Its estimate [-]
         real(wp), intent(in) :: estimate

         call add_remark(result%remarks, loose_tolerance, "the tolerance "//number_text(numerics%tolerance, 2)// &
            & " does not control "//what//": its estimate is "//number_text(estimate, 2)// &
            & "; give 'accuracy' instead of 'tolerance'", estimate)
      end subroutine say_far

   end subroutine judge_tolerance

   !> Estimated errors of a result: of the sliding speed, of the means, of the extremes.
   subroutine get_estimates(result, estimates, error)
      type(result_t), intent(in) :: result
      !> Errors [-]
      real(wp), intent(out) :: estimates(3)
      !> Usage error where they are not in the summary
      type(error_t), allocatable, intent(out) :: error

      call get_summary(result, "estimated_error", estimates(1), error)
      if (.not. allocated(error)) call get_summary(result, "estimated_error_of_means", estimates(2), error)
      if (.not. allocated(error)) call get_summary(result, "estimated_error_of_extremes", estimates(3), error)
   end subroutine get_estimates

end module camroller_run_remarks
