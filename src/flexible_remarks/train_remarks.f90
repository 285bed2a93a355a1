!> Remarks on the motion of a flexible train: contact, joint, seat, lift, plunger, period.
!>
!> In: the solution of a lobe's train. Out: remarks, or an error where the case forbids what happens.
module camroller_train_remarks
   use camroller_engine, only : write_speed
   use camroller_error, only : error_t, kind_domain, raise
   use camroller_flexible_measure_list, only : bounce_height, bounces, check_share, closed_load, coil_compression, &
      & coil_ratio, event_check_share, highest_plunger, largest_load, losses_of_contact, lowest_plunger, seating_speed, &
      & smallest_lift, smallest_pivot_force, tension_share
   use camroller_flexible_measures, only : largest_lift
   use camroller_flexible_setup, only : seat_sink
   use camroller_flexible_solution, only : flexible_solution_t
   use camroller_flexible_train, only : at_lift, at_plunger, at_pressure
   use camroller_gas, only : gas_force
   use camroller_kinds, only : two_pi, wp
   use camroller_lash_adjuster, only : ambient_pressure, opening_pressure
   use camroller_model, only : model_t
   use camroller_number_text, only : integer_text, number_text
   use camroller_ode_problem, only : counters_t
   use camroller_pump_up, only : event_height, is_pumped_up
   use camroller_remarks, only : add_remark, bouncing_valve, long_period, lost_contact, lost_lash, missing_lift, no_period, &
      & pressed_seat, remark_t, rising_plunger, shut_valve
   use camroller_train_outlook, only : gas_share
   use camroller_train_words, only : tell_lower_stop, tell_open_valve, tell_relief, tell_sinking, tell_suction, tell_tension, &
      & tell_upper_stop
   implicit none
   private

   public :: judge_train

contains

   !> Remarks on a train.
   subroutine judge_train(model, solution, lost_share, remarks, error)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Solution of its train
      type(flexible_solution_t), intent(in) :: solution
      !> Fraction of the cycle without contact [-]
      real(wp), intent(in) :: lost_share
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Domain error where the case forbids what happens
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text, speed

      call write_speed(model%speed, model%crank_turns, 6, speed)
      call judge_period(model, solution, speed, remarks)
      call judge_lash(model, remarks)
      call judge_lift(model, solution, speed, remarks)
      if (lost_share > 0.0_wp) then
         text = "cam and roller lose contact "//trim(times_text(solution%mean(losses_of_contact)))//" per cycle, for "// &
            & number_text(100.0_wp*lost_share, 3)//" % of it, at "//speed
         if (model%stops_without_contact) then
            call raise(error, kind_domain, text//" (contact_policy = 'stop')")
            return
         end if
         if (model%flexible%lash > 0.0_wp) text = text//"; load_factor leaves out the impact that takes up the lash"
         call add_remark(remarks, lost_contact, text, 100.0_wp*lost_share)
      end if
      call tell_tension(model, -solution%lowest(smallest_pivot_force), speed, remarks, solution%mean(tension_share))
      if (solution%highest(bounces) > 0.0_wp) then
         call add_remark(remarks, bouncing_valve, "the valve bounces "//trim(times_text(solution%mean(bounces)))// &
            & " per cycle, by up to "//number_text(1.0e6_wp*solution%highest(bounce_height), 3)//" um, after meeting its "// &
            & "seat at up to "//number_text(solution%highest(seating_speed), 3)//" m/s, at "//speed, &
            & solution%highest(seating_speed))
      end if
      call judge_seat(model, solution, speed, remarks)
      if (allocated(model%flexible%adjuster)) then
         call judge_plunger(model, solution, speed, remarks)
         call judge_oil(model, solution, speed, remarks)
      end if
      call tell_relief(solution%highest(coil_ratio), remarks, compression=solution%highest(coil_compression))
   end subroutine judge_train

   !> Remark on a lash of which nothing is left, since the closed valve sinks into its seat.
   subroutine judge_lash(model, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      associate (lash => model%flexible%lash, sink => seat_sink(model%flexible, model%train))
         if (.not. lash > 0.0_wp .or. lash >= sink) return
         call add_remark(remarks, lost_lash, "nothing is left of dynamics.lash_mm = "//number_text(1.0e3_wp*lash, 3)// &
            & ": the valve spring presses the closed valve "//number_text(1.0e3_wp*sink, 3)//" mm into its seat, and so the "// &
            & "roller onto the base circle; dynamics.seat_stiffness_N_m decides how far", 1.0_wp - lash/sink)
      end associate
   end subroutine judge_lash

   !> Remark on a valve that opens by much less than its cam would lift it.
   subroutine judge_lift(model, solution, speed, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Solution of its train
      type(flexible_solution_t), intent(in) :: solution
      !> Its speed in words
      character(len=*), intent(in) :: speed
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      ! Part of the largest lift that may be missing [-]: compliance, lash and leak together take less
      real(wp), parameter :: most_missing = 0.1_wp
      ! Part of what is missing from which on one cause is named for it [-]
      real(wp), parameter :: most_of_it = 0.5_wp
      ! Largest lift of a rigid train, and of the turn that has least, what is missing, way of the plunger below its rest there [m]
      real(wp) :: wanted, reached, missing, sink
      character(len=:), allocatable :: cause
      integer :: turn, place

      wanted = largest_lift(model)
      reached = wanted
      sink = 0.0_wp
      do turn = 1, size(solution%turns)
         associate (trajectory => solution%turns(turn))
            place = maxloc(trajectory%state(at_lift, :trajectory%count), 1)
            if (trajectory%state(at_lift, place) >= reached) cycle
            reached = trajectory%state(at_lift, place)
            if (allocated(model%flexible%adjuster)) sink = model%flexible%pivot_place - trajectory%state(at_plunger, place)
         end associate
      end do
      missing = wanted - max(0.0_wp, reached)
      if (reached >= (1.0_wp - most_missing)*wanted) return
      if (model%flexible%lash > most_of_it*missing) then
         cause = "dynamics.lash_mm = "//number_text(1.0e3_wp*model%flexible%lash, 3)//" takes it"
      else if (sink > most_of_it*missing) then
         cause = "the plunger of the lash adjuster, which has sunk by "//number_text(1.0e3_wp*sink, 3)//" mm there, takes it"
      else
         cause = "the finger yields by what is missing: are the stiffnesses of &dynamics, in N/m, right?"
      end if
      call add_remark(remarks, missing_lift, "the valve opens by "//number_text(1.0e3_wp*max(0.0_wp, reached), 3)//" mm at "// &
         & speed//", where its cam would lift it by "//number_text(1.0e3_wp*wanted, 3)//" mm; "//cause, &
         & 100.0_wp*(1.0_wp - reached/wanted))
   end subroutine judge_lift

   !> Remarks on the seat: the valve stays off it, or gas presses the valve into it.
   subroutine judge_seat(model, solution, speed, remarks)
      type(model_t), intent(in) :: model
      !> Solution of its train
      type(flexible_solution_t), intent(in) :: solution
      !> Its speed in words
      character(len=*), intent(in) :: speed
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      ! Load over that of the gas at rest above which something else makes it [-]; angles of a turn that are looked at
      real(wp), parameter :: impact_factor = 1.5_wp
      integer, parameter :: turn_samples = 720
      ! Largest force of the gas [N]
      real(wp) :: gas
      integer :: i

      if (solution%lowest(smallest_lift) > 0.0_wp) then
         call tell_open_valve(solution%highest(smallest_lift), speed, remarks)
      else
         call tell_open_valve(solution%highest(smallest_lift), speed, remarks, " in some cycles")
      end if
      if (.not. allocated(model%gas)) return
      if (solution%highest(closed_load) < solution%highest(largest_load)) return
      gas = 0.0_wp
      do i = 0, turn_samples - 1
         gas = max(gas, gas_force(model%gas, two_pi*i/turn_samples))
      end do
      if (.not. gas > 0.0_wp) return
      ! An impact of the valve is larger than what gas at rest explains
      if (solution%highest(closed_load) > impact_factor*(model%base_circle_load + gas_share(model, gas)*gas)) return
      call add_remark(remarks, pressed_seat, "the gas presses the closed valve into its seat and the finger onto the cam: up "// &
         & "to "//number_text(solution%highest(closed_load), 4)//" N there, the largest load of the cycle, at "//speed// &
         & "; dynamics.seat_stiffness_N_m decides how much", solution%highest(closed_load))
   end subroutine judge_seat

   !> Remarks on the plunger of a lash adjuster.
   subroutine judge_plunger(model, solution, speed, remarks)
      !> Model of the lobe, with an adjuster
      type(model_t), intent(in) :: model
      !> Solution of the train of a lobe
      type(flexible_solution_t), intent(in) :: solution
      !> Its speed in words
      character(len=*), intent(in) :: speed
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      real(wp) :: height ! Largest height above its rest in the event [m]
      character(len=:), allocatable :: text

      height = event_height(model, solution)
      associate (highest => solution%highest(highest_plunger), lowest => solution%lowest(lowest_plunger))
         if (is_pumped_up(model, solution)) then
            text = "the lash adjuster pumps up: its check valve opens for "// &
               & number_text(100.0_wp*solution%mean(event_check_share), 3)//" % of the cycle while the valve is open, and the "// &
               & "plunger stands"
            if (.not. solution%highest(event_check_share) > 0.0_wp) text = "the lash adjuster pumps up, and has pumped up so "// &
               & "far that its check valve stays shut while the valve is open: the plunger stands"
            call add_remark(remarks, rising_plunger, text//" up to "//number_text(1.0e3_wp*abs(height), 3)//" mm "// &
               & trim(merge("above", "below", height >= 0.0_wp))//" its rest then, at "//speed, &
               & 100.0_wp*solution%mean(event_check_share))
         end if
         call tell_upper_stop(model, highest, speed, remarks)
         call tell_lower_stop(model, lowest, speed, remarks)
         call tell_sinking(model, lowest, speed, remarks)
      end associate
   end subroutine judge_plunger

   !> Remarks on the oil of a lash adjuster: a check valve that stays shut, a chamber that is as good as empty.
   subroutine judge_oil(model, solution, speed, remarks)
      !> Model of the lobe, with an adjuster
      type(model_t), intent(in) :: model
      !> Solution of its train
      type(flexible_solution_t), intent(in) :: solution
      !> Its speed in words
      character(len=*), intent(in) :: speed
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: text
      real(wp) :: lowest ! Gauge pressure [Pa]
      integer :: turn

      if (.not. solution%highest(check_share) > 0.0_wp) then
         associate (opens => opening_pressure(model%flexible%adjuster))
            text = "the check valve of the lash adjuster opens in no cycle at "//speed
            if (opens <= -ambient_pressure) text = "the check valve of the lash adjuster can never open: lash_adjuster.supply_"// &
               & "pressure_MPa less crack_pressure_kPa is "//number_text(1.0e-5_wp*opens, 3)//" bar, below a vacuum"
            call add_remark(remarks, shut_valve, text//"; what leaks along the plunger comes back along it alone, or not at all")
         end associate
      end if
      lowest = huge(1.0_wp)
      do turn = 1, size(solution%turns)
         associate (trajectory => solution%turns(turn))
            lowest = min(lowest, minval(trajectory%state(at_pressure, :trajectory%count)))
         end associate
      end do
      call tell_suction(lowest, speed, remarks)
   end subroutine judge_oil

   !> How often something happens, in words.
   pure function times_text(count) result(text)
      !> Mean number of times [-]
      real(wp), intent(in) :: count
      !> The words
      character(len=20) :: text

      text = number_text(count, 3)//" times"
      if (text == "1 times") text = "once"
   end function times_text

   !> Remark on a cycle that does not repeat itself, or only after several turns.
   subroutine judge_period(model, solution, speed, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Solution of the train of a lobe
      type(flexible_solution_t), intent(in) :: solution
      !> Its speed in words
      character(len=*), intent(in) :: speed
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: text
      type(counters_t) :: counters
      real(wp) :: partings ! In a cycle [-]

      if (solution%cycle%period == 1) return
      partings = solution%mean(losses_of_contact) + solution%mean(bounces)
      counters = solution%cycle%counters
      if (solution%cycle%period > 1) then
         call add_remark(remarks, long_period, "the motion of the train repeats after "//integer_text(solution%cycle%period)// &
            & " cycles at "//speed//"; the summary covers all of them, the series "// &
            & "show the last", real(solution%cycle%period, wp))
      else
         text = "the motion of the train did not become periodic within "//integer_text(solution%tried)//" cycles at "// &
            & speed
         if (solution%is_cut_short) then
            text = text//", and no more are tried: "
            ! Fewer explain no step
            if (partings >= 1.0_wp) text = text//"in each cam and roller, or valve and seat, part "//number_text(partings, 2)// &
               & " times, and "
            text = text//"a cycle takes "// &
               & integer_text((counters%accepted + counters%rejected)/(solution%cycle%cycles + size(solution%turns)))// &
               & " steps, where usual ones take some hundreds to 3000"
         end if
         text = text//": the summary covers "//integer_text(size(solution%turns))//" further cycles, and the series show the "// &
            & "last of them as an example"
         if (solution%trend%approached > 0) then
            text = text//"; they still approach a period"
            if (solution%trend%approached > 1) text = text//" of "//integer_text(solution%trend%approached)//" cycles"
         else if (solution%trend%drifts) then
            text = text//"; they still drift in one direction"
            if (allocated(model%flexible%adjuster)) then
               associate (first => solution%values(highest_plunger, 1), last => solution%values(highest_plunger, &
                  & size(solution%turns)))
                  text = text//" (the plunger's highest place by "//number_text(1.0e6_wp*(last - first), 3)//" um, to "// &
                     & number_text(1.0e3_wp*last, 4)//" mm)"
               end associate
            end if
         end if
         if (solution%trend%approached > 0 .or. solution%trend%drifts) text = text//": these numbers are those of a "// &
            & "transient; raise numerics.max_cycles"
         call add_remark(remarks, no_period, text, solution%cycle%closure)
      end if
   end subroutine judge_period

end module camroller_train_remarks
