!> One turn of a flexible train: what integrates it, and one integration.
!>
!> In: model, method, tolerance, state at the start. Out: the path over a turn and the state at its end, or words for a finger that
!> is thrown off.
module camroller_flexible_turn
   use camroller_kinds, only : wp, pi, degree
   use camroller_cam_angle, only : cam_angle_text
   use camroller_error, only : error_t, raise, kind_convergence, kind_domain
   use camroller_dynamics, only : evaluate_moments, moments_t
   use camroller_kinematics, only : position_t
   use camroller_model, only : evaluate_geometry, model_t
   use camroller_names, only : name_length
   use camroller_events, only : cycle_stops
   use camroller_ode_method, only : method_t, options_t
   use camroller_ode_problem, only : counters_t
   use camroller_ode_methods, only : new_method
   use camroller_ode_switching, only : integrate_switching
   use camroller_step_control, only : shortest_step
   use camroller_trajectory, only : trajectory_t
   use camroller_flexible_train, only : flexible_state_t, evaluate_train, state_size, at_finger, at_lift, at_sliding
   use camroller_lash_adjuster, only : bulk_modulus, evaluate_flows, flows_t
   use camroller_number_text, only : integer_text, millimetres_text, number_text
   use camroller_flexible_problem, only : flexible_problem_t, set_scales
   implicit none
   private

   public :: turn_t, start_turns, prepare, set_tolerance, set_sliding_tolerance, integrate_turn, find_fastest

   !> Step that an integration begins with [rad]
   real(wp), parameter :: first_step = 1.0e-3_wp
   !> Largest step [rad]
   real(wp), parameter :: largest_step = 10.0_wp*degree
   !> Part of the tolerance to which the contact's forces are found [-]
   real(wp), parameter :: contact_accuracy = 1.0e-3_wp
   !> Difference of sliding speeds that is not resolved, over the error allowed in a step: from 1 on the sliding speed sticks
   !> where a film is as good as solid; at 0.5 it takes four times the steps [-]
   real(wp), parameter :: unresolved = 2.0_wp
   !> Shortest steps in which friction may change the sliding speed by what is not resolved of it. With two of them no step is short
   !> enough to end where friction gives way on a film as good as solid, and the speed goes to and fro about it; four are enough [-]
   real(wp), parameter :: least_steps = 20.0_wp
   !> Sliding speed that is none, however slow the cam, over that of the surface of a roller that turns with it [-]
   real(wp), parameter :: no_slip = 1.0e-6_wp
   !> Error of the traction that one of the sliding speed makes in a step, over the largest traction and the tolerance of the step;
   !> the largest, over the first of these [-]. Default decks take as many steps as without it, but 6 % more where contacts open
   real(wp), parameter :: friction_ratio = 50.0_wp, largest_friction_error = 0.01_wp
   !> Steps of a cycle after which it is given up: a hundred times as many as usual
   integer, parameter :: most_steps = 400000

   !> What integrates one turn after another
   type :: turn_t
      type(flexible_problem_t) :: problem
      class(method_t), allocatable :: method
      !> Name of the method, and components of the state that it is made for
      character(len=name_length) :: method_name = ""
      integer :: components = 0
      type(options_t) :: options
      !> Angles at which a step must end, the first and the last among them [rad]
      real(wp), allocatable :: stops(:)
      !> Sizes of the components [state]
      real(wp), allocatable :: scales(:)
      !> Difference of sliding speeds that steps can resolve, whatever the tolerance [m/s]
      real(wp) :: least_sliding = 0.0_wp
      !> Steps of all turns together after which they are given up
      integer :: most_work = huge(1)
      !> Steps of all turns together after which no period is looked for any more
      integer :: most_search = huge(1)
   end type turn_t

contains

   !> Make ready to integrate turns.
   subroutine start_turns(turn, model, method, tolerance, error)
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> The model, with a flexible train
      type(model_t), intent(in), target :: model
      !> Name of the method
      character(len=*), intent(in) :: method
      !> Error allowed per step, in units of the scales [-]
      real(wp), intent(in) :: tolerance
      !> Deck error for an unknown method
      type(error_t), allocatable, intent(out) :: error

      call prepare(turn, model, method, tolerance, error)
      if (allocated(error)) return
      turn%stops = [-pi, pi]
      if (allocated(model%gas)) turn%stops = cycle_stops(model%gas%sharp_angles, -pi)
   end subroutine start_turns

   !> Make ready to integrate, over whatever angles. The room of an earlier integration is used again where it is right.
   subroutine prepare(turn, model, method, tolerance, error)
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> The model, with a flexible train
      type(model_t), intent(in), target :: model
      !> Name of the method
      character(len=*), intent(in) :: method
      !> Error allowed per step, in units of the scales [-]
      real(wp), intent(in) :: tolerance
      !> Deck error for an unknown method
      type(error_t), allocatable, intent(out) :: error

      if (turn%method_name /= method .or. turn%components /= state_size(model)) then
         call new_method(turn%method, method, state_size(model), error)
         if (allocated(error)) return
         turn%method_name = method
         turn%components = state_size(model)
      end if
      call turn%method%forget()
      turn%problem%model => model
      turn%problem%switches = 3
      turn%problem%markers = 1
      turn%problem%resolution%forces = contact_accuracy*tolerance
      turn%problem%friction_error = friction_error_for(tolerance)
      if (allocated(turn%scales)) then
         if (size(turn%scales) /= turn%components) deallocate (turn%scales)
      end if
      if (.not. allocated(turn%scales)) allocate (turn%scales(turn%components))
      call set_scales(model, turn%scales)
      turn%problem%small_state = turn%scales
      turn%options%tolerance = tolerance*turn%scales
      turn%least_sliding = min(least_steps*shortest_step*spacing(pi)*sliding_rate(model), &
         & no_slip*model%speed*model%roller_radius)
      call set_sliding_tolerance(turn, turn%options%tolerance(at_sliding))
      turn%options%step = first_step
      turn%options%max_step = largest_step
      turn%options%max_steps = most_steps
   end subroutine prepare

   !> Set the errors allowed in a step.
   pure subroutine set_tolerance(turn, tolerance)
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> The errors allowed [state]
      real(wp), intent(in) :: tolerance(:)

      turn%options%tolerance = tolerance
      turn%problem%friction_error = friction_error_for(tolerance(at_lift)/turn%scales(at_lift))
      call set_sliding_tolerance(turn, tolerance(at_sliding))
   end subroutine set_tolerance

   !> Error of the traction that is allowed for one of the sliding speed.
   pure function friction_error_for(tolerance) result(error)
      !> Error allowed per step, in units of the scales [-]
      real(wp), intent(in) :: tolerance
      !> The error, over the largest traction [-]
      real(wp) :: error

      error = min(friction_ratio*tolerance, largest_friction_error)
   end function friction_error_for

   !> Set the error of the sliding speed that is allowed in a step, and with it what is not resolved of that speed.
   pure subroutine set_sliding_tolerance(turn, tolerance)
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> The error allowed [m/s]
      real(wp), intent(in) :: tolerance

      turn%options%tolerance(at_sliding) = tolerance
      turn%problem%resolution%sliding_speed = max(unresolved*tolerance, turn%least_sliding)
   end subroutine set_sliding_tolerance

   !> Rate of the sliding speed that friction gives to a roller at most: by the load at full lift without inertia.
   function sliding_rate(model) result(rate)
      type(model_t), intent(in) :: model
      !> The rate [m/s per rad]
      real(wp) :: rate

      type(position_t) :: position
      type(moments_t) :: moments
      integer :: status

      rate = 0.0_wp
      call evaluate_geometry(model, 0.0_wp, position, status)
      if (status /= 0) return
      call evaluate_moments(model%train, position, 0.0_wp, 0.0_wp, moments)
      rate = model%limiting_coefficient*abs(moments%total/position%normal_arm)*model%roller_radius**2 &
         & /(model%roller_inertia*model%speed)
   end function sliding_rate

   !> One turn.
   subroutine integrate_turn(turn, state, trajectory, counters, error)
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> State, from start to end [state]
      real(wp), intent(inout) :: state(:)
      !> The turn
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error; domain error where the finger is thrown off
      type(error_t), allocatable, intent(out) :: error

      type(options_t) :: options
      character(len=:), allocatable :: cause
      ! Steps before and after
      integer :: before, taken

      options = turn%options
      before = counters%accepted + counters%rejected
      options%max_steps = min(options%max_steps + before, turn%most_work)
      call integrate_switching(turn%problem, turn%method, options, turn%stops, state, trajectory, counters, error)
      if (.not. allocated(error)) return
      taken = counters%accepted + counters%rejected
      if (taken > options%max_steps) then
         deallocate (error)
         call find_cause(turn, trajectory, cause)
         if (taken > turn%most_work) then
            call raise(error, kind_domain, "its turns take more than "//integer_text(turn%most_work)//" steps; "//cause)
         else
            call raise(error, kind_convergence, "the number of steps is used up, "//integer_text(turn%options%max_steps)// &
               & " in a turn; "//cause)
         end if
      else
         call explain_end(turn, trajectory, error)
      end if
   end subroutine integrate_turn

   !> What takes the steps of a train, in words: a roller that friction holds where nothing is entrained, or the part that changes
   !> fastest. Films by formula go to nothing with the entrainment: within less of it than a step resolves the traction rises to a
   !> crest and falls again, and a roller that is held there keeps to it.
   subroutine find_cause(turn, trajectory, text)
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> The turn up to its end
      type(trajectory_t), intent(in) :: trajectory
      !> The words
      character(len=:), allocatable, intent(out) :: text

      type(flexible_state_t) :: now
      integer :: status

      call find_fastest(turn%problem%model, text)
      if (trajectory%count == 0) return
      associate (angle => trajectory%time(trajectory%count), problem => turn%problem)
         call evaluate_train(problem%model, angle, trajectory%state(:, trajectory%count), problem%resolution, now, status)
         if (status /= 0 .or. .not. now%contact%is_touching) return
         if (abs(now%contact%entrainment_speed) > problem%resolution%sliding_speed) return
         text = "friction holds the roller at "//cam_angle_text(angle, 3)//", where the surfaces of cam and roller move in "// &
            & "opposite directions at one speed: no oil is entrained, and traction changes within less than a step resolves; "// &
            & "try another numerics.accuracy or numerics.method"
      end associate
   end subroutine find_cause

   !> The part of a train that changes fastest, in words.
   subroutine find_fastest(model, text)
      !> The model
      type(model_t), intent(in) :: model
      !> The words
      character(len=:), allocatable, intent(out) :: text

      character(len=*), parameter :: keys(*) = [character(len=38) :: "dynamics.finger_stiffness_N_m", &
         & "dynamics.pad_stiffness_N_m", "dynamics.seat_stiffness_N_m", "lash_adjuster.stop_stiffness_N_m", &
         & "lash_adjuster.gap_um", "lash_adjuster.check_area_mm2", "valve_tip.reversal_speed_m_s", &
         & "stem_seal.reversal_speed_m_s", "guide_side_load.reversal_speed_m_s", "finger_pivot.reversal_speed_m_s"]
      type(flows_t) :: flows
      ! Natural frequencies of parts, decay of pressure by leak and check valve [1/s]; bulk modulus [Pa], its slope [-]
      real(wp) :: rates(size(keys)), modulus, slope

      associate (flexible => model%flexible)
         rates = 0.0_wp
         rates(:3) = sqrt([flexible%finger_stiffness*model%linkage%a**2/model%train%finger_inertia, &
            & flexible%pad_stiffness/flexible%effective_mass, flexible%seat_stiffness/flexible%effective_mass])
         if (allocated(flexible%adjuster)) then
            associate (adjuster => flexible%adjuster, given => flexible%adjuster%given)
               call bulk_modulus(given, adjuster%supply_pressure, modulus, slope)
               call evaluate_flows(adjuster, adjuster%supply_pressure - given%crack_pressure - given%full_pressure, flows)
               rates(4) = sqrt(given%stop_stiffness/given%plunger_mass)
               rates(5:6) = modulus/given%volume*[flows%leak_slope, abs(flows%check_slope)]
            end associate
         end if
         if (allocated(model%joints)) rates(7:) = reversal_rates(model)
      end associate
      text = "the fastest part of the train, with "//number_text(maxval(rates), 2)//" 1/s, is that of "// &
         & trim(keys(maxloc(rates, 1)))//": look there, and for a damping of 0"
   end subroutine find_fastest

   !> Rates at which joints brake what slides in them while their friction reverses, by forces at full lift without inertia.
   function reversal_rates(model) result(rates)
      !> The model, with joints
      type(model_t), intent(in) :: model
      !> Tip, seal, guide's ends, pivot; zero for those that are not there [1/s]
      real(wp) :: rates(4)

      type(position_t) :: position
      type(moments_t) :: moments
      real(wp) :: load ! [N]
      integer :: status

      rates = 0.0_wp
      call evaluate_geometry(model, 0.0_wp, position, status)
      if (status /= 0) return
      call evaluate_moments(model%train, position, 0.0_wp, 0.0_wp, moments)
      load = abs(moments%total/position%normal_arm)
      associate (joints => model%joints, mass => model%flexible%effective_mass)
         if (allocated(joints%tip)) rates(1) = joints%tip%law%coefficient*load/(mass*joints%tip%law%reversal_speed)
         if (allocated(joints%seal)) rates(2) = joints%seal%lip_force/(mass*joints%seal%reversal_speed)
         if (allocated(joints%side)) rates(3) = joints%side%law%coefficient*load/(mass*joints%side%law%reversal_speed)
         if (allocated(joints%pivot)) rates(4) = joints%pivot%law%coefficient*load*joints%pivot%ball_radius**2 &
            & /(model%train%finger_inertia*joints%pivot%law%reversal_speed)
      end associate
   end function reversal_rates

   !> Say so where an integration ended because the roller has left the cam and no state follows: the finger has turned over, or no
   !> point of the cam is nearest.
   subroutine explain_end(turn, trajectory, error)
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> The turn up to its end
      type(trajectory_t), intent(in) :: trajectory
      !> In: what the integration says; out: a domain error where the finger is thrown off
      type(error_t), allocatable, intent(inout) :: error

      ! A step beyond the end [rad]
      real(wp), parameter :: beyond = 1.0e-9_wp
      type(flexible_state_t) :: now, next
      ! Rate at the end [state/rad]
      real(wp) :: rate(size(turn%scales))
      integer :: status

      if (trajectory%count == 0) return
      associate (angle => trajectory%time(trajectory%count), state => trajectory%state(:, trajectory%count), &
         & problem => turn%problem)
         call evaluate_train(problem%model, angle, state, problem%resolution, now, status)
         if (status /= 0 .or. now%cam%approach >= 0.0_wp) return
         call problem%get_rate(angle, state, rate, status)
         call evaluate_train(problem%model, angle, state + beyond*rate, problem%resolution, next, status)
         if (status <= 0) return
         deallocate (error)
         call raise(error, kind_domain, "the finger is thrown off: at "//cam_angle_text(angle, 3)//" the roller is "// &
            & millimetres_text(-now%cam%approach)//" mm from the cam and the finger has turned by "// &
            & number_text((state(at_finger) - problem%model%linkage%base_angle)/degree, 3)//" deg from its place on the base "// &
            & "circle; check base circle load, masses and speed")
      end associate
   end subroutine explain_end

end module camroller_flexible_turn
