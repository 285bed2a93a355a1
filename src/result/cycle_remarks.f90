!> Remarks on the cycle of a lobe: lost contact, range of the film law, accuracy, standstills, the pivot's joint, its films.
!>
!> In: a cycle, its means and margins. Out: remarks, one per line, or an error where the case forbids what happens.
module camroller_cycle_remarks
   use camroller_cam_angle, only : append_cam_angle, cam_angle_text, file_angle
   use camroller_kinds, only : wp
   use camroller_engine, only : write_speed
   use camroller_error, only : error_t, raise, add_context, kind_domain
   use camroller_asperity, only : law_greenwood_tripp
   use camroller_cycle, only : cycle_t
   use camroller_events, only : contact_losses
   use camroller_film, only : law_masjedi_khonsari_rough
   use camroller_film_range, only : distance_outside, matters, outside_words, range_in_words
   use camroller_train_remarks, only : judge_train
   use camroller_margins, only : joint_rounding, margins_t
   use camroller_cycle_shares, only : shear_ratio_allowed
   use camroller_film_remarks, only : judge_traction, name_lobe, notable_share
   use camroller_means, only : statistics_t
   use camroller_model, only : model_t
   use camroller_number_text, only : append_number, number_text, fixed_text, integer_text
   use camroller_oil_checks, only : describe_hot_film
   use camroller_remarks, only : remark_t, add_remark, cut_off_contact, foreign_asperities, hot_film, hot_inlet, lifted_valve, &
      & lost_contact, open_pivot, outside_range, pumped_adjuster, oiled_slices, rigid_contact, rolling_out_of_range, &
      & standing_entrainment, unloaded_end, unresolved_slip
   use camroller_result, only : lobe_scope
   implicit none
   private

   public :: judge_laws, judge_lobe, no_rigid_contact

   !> What follows for a rigid train where cam and roller part
   character(len=*), parameter :: no_rigid_contact = "; rigid kinematics does not hold there, and computed loads and friction "// &
      & "are not realistic"
   !> Estimate of the error of the sliding speed, relative to the largest, beyond which a result is worth a warning [-]
   real(wp), parameter :: worth_a_warning = 0.1_wp
   !> Part of a cycle that is all of it but for rounding [-]
   real(wp), parameter :: all_of_it = 1.0_wp - 1.0e-9_wp
   !> Intervals without contact that a remark lists
   integer, parameter :: most_intervals = 4

contains

   !> Say that laws of a case do not go together: a film that has asperities in its fit, and asperities of another law.
   pure subroutine judge_laws(model, remarks)
      !> Model of a lobe
      type(model_t), intent(in) :: model
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (.not. allocated(model%boundary) .or. model%film_law /= law_masjedi_khonsari_rough) return
      if (model%boundary%constants%law /= law_greenwood_tripp) return
      call add_remark(remarks, foreign_asperities, "film.law 'masjedi_khonsari_rough' and asperity.law 'greenwood_tripp' do "// &
         & "not go together: asperities that lift the film by as much carry 21 % of the load in a contact of the film's paper, "// &
         & "and 1.4 % by this law; asperity.law = 'masjedi_khonsari' goes with the film")
   end subroutine judge_laws

   !> Remarks on a lobe: contact, range of the film law, accuracy.
   subroutine judge_lobe(model, cycle, statistics, margins, lobe, remarks, error)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Its cycle
      type(cycle_t), intent(in) :: cycle
      !> Means over the cycle
      type(statistics_t), intent(in) :: statistics
      !> Its margins
      type(margins_t), intent(in) :: margins
      !> Lobe shape to be named; 0 where there is one alone
      integer, intent(in) :: lobe
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Domain error where the case forbids what happens
      type(error_t), allocatable, intent(out) :: error

      integer :: first

      first = size(remarks) + 1
      if (allocated(cycle%flexible)) then
         call judge_train(model, cycle%flexible, statistics%lost_share, remarks, error)
      else
         call check_contact(model, cycle, statistics, margins, remarks, error)
      end if
      if (.not. allocated(error)) call check_range(model, statistics, remarks, error)
      call check_error(cycle, statistics, remarks)
      call check_entrainment(statistics, remarks)
      call check_ends(statistics, remarks)
      if (.not. allocated(cycle%flexible)) call check_pivot(model, margins, remarks)
      if (allocated(margins%seat)) then
         if (margins%seat%force < 0.0_wp) call add_remark(remarks, lifted_valve, "the gas lifts the closed valve off its seat: "// &
            & number_text(-margins%seat%force, 3)//" N are missing at "//cam_angle_text(margins%seat%angle, 1)//" to hold it, "// &
            & "and the rigid train keeps it shut; &dynamics lets it open", -margins%seat%force)
      end if
      if (lobe > 0) call add_context(error, trim(lobe_scope(lobe)))
      call name_lobe(remarks, first, lobe)
   end subroutine judge_lobe

   !> Warn or stop where contact is lost.
   subroutine check_contact(model, cycle, statistics, margins, remarks, error)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      !> Means over the cycle
      type(statistics_t), intent(in) :: statistics
      type(margins_t), intent(in) :: margins
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Domain error where the case forbids it
      type(error_t), allocatable, intent(out) :: error

      ! First and last angle of each interval without contact [rad]; speed at which it is first lost [rad/s]
      real(wp), allocatable :: intervals(:, :)
      real(wp) :: speed
      character(len=:), allocatable :: text, turns
      integer :: i

      if (statistics%lost_share <= 0.0_wp) return
      call write_speed(model%speed, model%crank_turns, 6, turns)
      text = "contact is lost for "//number_text(100.0_wp*statistics%lost_share, 3)//" % of the cycle at "//turns
      intervals = contact_losses(model, cycle%stops)
      do i = 1, min(size(intervals, 2), most_intervals)
         if (i == 1) text = text//", at cam angles"
         if (i > 1) text = text//","
         text = text//" "//fixed_text(file_angle(intervals(1, i)), 1)//" to "//fixed_text(file_angle(intervals(2, i)), 1)
      end do
      if (size(intervals, 2) > 0) text = text//" deg"
      if (size(intervals, 2) > most_intervals) text = text//" and others"
      speed = min(margins%event%speed, margins%base_circle%speed)
      if (speed < model%speed) then
         call write_speed(speed, model%crank_turns, 4, turns)
         text = text//"; it is lost above "//turns
      end if
      text = text//no_rigid_contact
      if (model%stops_without_contact) then
         call raise(error, kind_domain, text//" (contact_policy = 'stop')")
      else
         call add_remark(remarks, lost_contact, text, 100.0_wp*statistics%lost_share)
      end if
   end subroutine check_contact

   !> Warn where the sliding speed is no answer, as with explicit steps beyond the stability limit, or without the roller's inertia
   !> where it matters.
   subroutine check_error(cycle, statistics, remarks)
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> Means over the cycle of the lobe, with the estimate of its error
      type(statistics_t), intent(in) :: statistics
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (statistics%error <= worth_a_warning) return
      ! A motion without a period has a remark of its own, and no method that resolves it
      if (allocated(cycle%flexible)) then
         if (cycle%flexible%cycle%period == 0) return
      end if
      if (cycle%is_quasi_static) then
         call add_remark(remarks, unresolved_slip, "the sliding speed is that of the quasi-static balance: the inertia of the "// &
            & "roller, which numerics.method 'quasi_static' leaves out, makes an estimated difference of "// &
            & number_text(statistics%error, 2)//" of the largest; other methods include it", statistics%error)
      else
         call add_remark(remarks, unresolved_slip, "the sliding speed is not resolved: the estimate of its error is "// &
            & number_text(statistics%error, 2)//" of the largest; take another method, a smaller tolerance or smaller steps", &
            & statistics%error)
      end if
   end subroutine check_error

   !> Say where the entrainment passes through zero: the smallest film is that of a standstill.
   subroutine check_entrainment(statistics, remarks)
      !> Means over the cycle of a lobe
      type(statistics_t), intent(in) :: statistics
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (statistics%standstills == 0) return
      call add_remark(remarks, standing_entrainment, "the entrainment speed passes through zero "// &
         & integer_text(statistics%standstills)//" times in contact, first at "// &
         & cam_angle_text(statistics%first_standstill, 1)// &
         & "; the smallest film is that at standstill there, without a squeeze film", real(statistics%standstills, wp))
   end subroutine check_entrainment

   !> Say where the end of the roller cuts the contact off, and where tilt takes the load from one end.
   subroutine check_ends(statistics, remarks)
      !> Means over the cycle of a lobe
      type(statistics_t), intent(in) :: statistics
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (statistics%edge_factor > 0.0_wp) call add_remark(remarks, cut_off_contact, "the end of the roller cuts the contact "// &
         & "off: its pressure is largest there, up to "//number_text(1.0e-9_wp*statistics%edge_pressure, 3)//" GPa at "// &
         & cam_angle_text(statistics%edge_angle, 1)//", "//number_text(statistics%edge_factor, 3)//" times that of the same "// &
         & "load all along the roller; a sharp edge has more in a strip narrower than a slice", statistics%edge_factor)
      if (statistics%one_end_share > 0.0_wp) call add_remark(remarks, unloaded_end, "tilt takes all load from one end of the "// &
         & "roller for "//number_text(100.0_wp*statistics%one_end_share, 3)//" % of the cycle", &
         & 100.0_wp*statistics%one_end_share)
      if (statistics%oiled_share > notable_share) call add_remark(remarks, oiled_slices, "for "// &
         & number_text(100.0_wp*statistics%oiled_share, 3)//" % of the cycle the contact is nearly rigid and its film thick "// &
         & "beside the depth of the profile: the dry contact loads as little as "//number_text(100.0_wp*statistics%oiled_parts(1), &
         & 2)//" % of the roller, at "//cam_angle_text(statistics%oiled_angle, 1)//", and oil would carry on "// &
         & number_text(100.0_wp*statistics%oiled_parts(2), 2)//" %; rolling resistance, which goes by the dry contact, is "// &
         & "too small there, and slip is off with it", 100.0_wp*statistics%oiled_share)
   end subroutine check_ends

   !> Say that the lash adjuster pumps up or its joint opens, which the model leaves out.
   subroutine check_pivot(model, margins, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      type(margins_t), intent(in) :: margins
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: text, turns
      ! Force that the joint lacks [N], speed at which that begins [rad/s]
      real(wp) :: lack, speed

      if (.not. allocated(margins%pivot)) return
      lack = margins%adjuster_force - margins%pivot%force
      if (margins%pivot%force < 0.0_wp) then
         text = "the joint of finger and lash adjuster opens: it lacks "
         lack = -margins%pivot%force
         speed = margins%pivot%speed
      else if (lack > joint_rounding*margins%adjuster_force) then
         text = "a hydraulic lash adjuster pumps up: the force in its joint is below its own by "
         speed = margins%pump_up_speed
      else
         return
      end if
      call append_number(text, lack, 3)
      text = text//" N at "
      call append_cam_angle(text, margins%pivot%angle, 1)
      call write_speed(model%speed, model%crank_turns, 6, turns)
      text = text//" at "//turns//"; this begins at "
      call write_speed(speed, model%crank_turns, 4, turns)
      call add_remark(remarks, merge(open_pivot, pumped_adjuster, margins%pivot%force < 0.0_wp), text//turns, lack)
   end subroutine check_pivot

   !> Warn or stop where the film law was used outside its range.
   subroutine check_range(model, statistics, remarks, error)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Means over its cycle
      type(statistics_t), intent(in) :: statistics
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Domain error where the case forbids it
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text, words

      if (statistics%inlet_share > 0.0_wp) call add_remark(remarks, hot_inlet, "heat in the inlet is beyond what the factor of "// &
         & "Gupta and others can tell for "//number_text(100.0_wp*statistics%inlet_share, 3)//" % of the cycle: the pressure's "// &
         & "part alone would halve the film; a continuation stands for it", 100.0_wp*statistics%inlet_share)
      if (statistics%hot_film%share > 0.0_wp) then
         call describe_hot_film(statistics%hot_film, model%heat, model%lubricant, model%oil, "the film", text)
         call add_remark(remarks, hot_film, text, statistics%hot_film%rise)
      end if
      if (statistics%rolling_share > 0.0_wp) call check_rolling(statistics, remarks)
      if (statistics%rigid_share > notable_share) call check_rigid(statistics, remarks)
      call judge_traction(model, statistics, remarks)
      if (statistics%film_range%share <= 0.0_wp) return
      call range_in_words(statistics%film_range, model%film_law, words)
      text = trim(outside_words(model%film_law))//" for "
      call append_number(text, 100.0_wp*statistics%film_range%share, 3)
      text = text//" % of the cycle"
      if (statistics%film_range%share < all_of_it) then
         text = text//", first at "
         call append_cam_angle(text, statistics%first_outside, 1)
      end if
      text = text//", "//words
      if (model%stops_outside_range) then
         call raise(error, kind_domain, text//" (range_policy = 'stop')")
      else if (matters(statistics%film_range)) then
         call add_remark(remarks, outside_range, text, 100.0_wp*statistics%film_range%share, &
            & distance_outside(statistics%film_range, model%film_law))
      end if
   end subroutine check_range

   !> Warn where the law of rolling resistance was used for contacts that it does not describe.
   pure subroutine check_rolling(statistics, remarks)
      !> Means over the cycle of a lobe
      type(statistics_t), intent(in) :: statistics
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: text

      text = "traction.rolling_law = 'goksem_hargreaves' is a fit to elastic contacts and hardly falls with the load: for "
      call append_number(text, 100.0_wp*statistics%rolling_share, 3)
      text = text//" % of the cycle it is more than twice the rolling resistance by 'biboulet_houpert', which describes rigid "// &
         & "contacts too, up to "
      call append_number(text, statistics%rolling_excess, 3)
      text = text//" times at "
      call append_cam_angle(text, statistics%rolling_angle, 1)
      call add_remark(remarks, rolling_out_of_range, text, 100.0_wp*statistics%rolling_share)
   end subroutine check_rolling

   !> Say that the dry contact's strip is used for the shear of a film that is hardly pressed together.
   subroutine check_rigid(statistics, remarks)
      !> Means over the cycle of a lobe
      type(statistics_t), intent(in) :: statistics
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: text
      ! Mean of the logarithm of the shear's factor there, over time [-]
      real(wp) :: excess

      excess = statistics%rigid_excess/statistics%rigid_share
      text = "the roller slips for "
      call append_number(text, 100.0_wp*statistics%rigid_share, 3)
      text = text//" % of the cycle where the contact is nearly rigid: the shear of the film over the strip of the dry contact is "
      if (abs(excess) < log(shear_ratio_allowed)) then
         text = text//"too small in some places and too large in others"
      else
         text = text//"there, on average, about "
         call append_number(text, exp(abs(excess)), 2)
         text = text//" times too "//merge("large", "small", excess > 0.0_wp)
      end if
      call add_remark(remarks, rigid_contact, text//", and slip is off with it; traction.sheared_zone = 'rigid_to_elastic' is "// &
         & "for such contacts", 100.0_wp*statistics%rigid_share)
   end subroutine check_rigid

end module camroller_cycle_remarks
