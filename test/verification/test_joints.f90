!> Sliding joints of the train: kernels in closed form, forces against free bodies, energy, stops, refusals.
module test_joints
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, kind_deck
   use camroller_case, only : case_t
   use camroller_model, only : model_t, new_model, evaluate_geometry
   use camroller_kinematics, only : position_t, evaluate_position, rotation_names
   use camroller_dynamics, only : moments_t, evaluate_moments
   use camroller_dual, only : dual_t, operator(*)
   use camroller_sliding_friction, only : sliding_t, sliding_law_t, new_sliding_law, set_duty, friction_limit, direction_of
   use camroller_contact, only : solve_contact
   use camroller_contact_forces, only : contact_t
   use camroller_joint_forces, only : joint_values_t, evaluate_joints
   use camroller_state, only : state_t, evaluate_state
   use camroller, only : of_tip, of_seal, of_guide_side, of_pivot, of_needle_drag, of_geometric, of_residual
   use camroller_torque_list, only : torque_count, is_loss
   use camroller_means, only : integrate_torques
   use camroller_cycle, only : cycle_t
   use camroller_events, only : find_stops
   use camroller_traction, only : rolling_law_names, rolling_none
   use closeness, only : check_close, check_scaled, expect_error, roundings
   use labelled_table, only : label_length, read_table
   use energy_checks, only : check_energy
   use reference_cases, only : thesis_case, skewed_case, make_model, make_cycle, set_point, add_gas_force, add_joints, &
      point_speeds, point_viscosities
   implicit none
   private

   public :: collect_joints

   !> Columns of the table without the first
   integer, parameter :: columns = 17
   !> Laws that are tried
   character(len=*), parameter :: laws(2) = [character(len=8) :: "constant", "stribeck"]

contains

   subroutine collect_joints(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("Stribeck's curve: standstill, 1/e at the decay speed, viscous part, no load", test_curve), &
         new_unittest("forces and torques agree with the equilibrium of two free bodies", test_bodies), &
         new_unittest("the sliding of the pad over the tip follows from the changes of position and angle", test_sliding_speed), &
         new_unittest("the pad of the reference train slides 9.732 mm in a turn", test_sliding_distance), &
         new_unittest("a seal of 8 N with friction that jumps takes 0.152 J a turn", test_seal_work), &
         new_unittest("friction of the guide in closed form, with and without friction at the tip", test_guide_side), &
         new_unittest("energy closes at 720 angles with all joints, needle drag and gas force, both laws, both senses", &
            & test_energy), &
         new_unittest("energy closes at any sliding speed", test_any_slip), &
         new_unittest("friction that jumps has a stop on both sides of each jump and none inside a dwell", test_stops), &
         new_unittest("friction that reverses over a small speed tends to friction that jumps", test_limit), &
         new_unittest("joints with zero friction change no result", test_no_friction), &
         new_unittest("a jammed stem, energy 'source', a jump in a flexible train, a missing finger mass are refused", &
            & test_refusals) &
         ]
   end subroutine collect_joints

   subroutine test_curve(error)
      type(error_type), allocatable, intent(out) :: error
      type(sliding_law_t) :: law
      type(error_t), allocatable :: failure
      type(dual_t) :: limit
      ! Viscosity twice the reference, load three times: the joint's speed counts two thirds
      real(wp), parameter :: load = 600.0_wp, speed = 0.3_wp

      call new_sliding_law(law, sliding_t("stribeck", 0.12_wp, 0.2_wp, 0.05_wp, 0.01_wp, 200.0_wp), "joint", failure)
      call set_duty(law, 0.02_wp)
      limit = friction_limit(law, dual_t(load, 0.0_wp), dual_t(0.0_wp, 0.0_wp))
      call check_close(error, limit%value, 0.12_wp*load, roundings, "at standstill")
      if (allocated(error)) return
      limit = friction_limit(law, dual_t(load, 1.0_wp), dual_t(-speed, 0.0_wp))
      call check_close(error, limit%value, load*(0.12_wp*exp(-1.0_wp) + 0.05_wp*0.2_wp), roundings, "at the decay speed")
      if (allocated(error)) return
      call check_close(error, limit%slope, 0.12_wp*2.0_wp*exp(-1.0_wp), roundings, "slope over the load")
      if (allocated(error)) return
      limit = friction_limit(law, dual_t(0.0_wp, 0.0_wp), dual_t(speed, 0.0_wp))
      call check_close(error, limit%value, 0.05_wp*speed*2.0_wp*200.0_wp, roundings, "without load: shear of the oil")
      if (allocated(error)) return
      limit = direction_of(dual_t(-1.0e-3_wp, 1.0_wp), 1.0e-3_wp)
      call check_close(error, limit%value, -tanh(1.0_wp), roundings, "direction")
      if (allocated(error)) return
      limit = direction_of(dual_t(-1.0e-9_wp, 1.0_wp), 0.0_wp)
      call check_close(error, limit%value, -1.0_wp, 0.0_wp, "direction where it jumps")
   end subroutine test_curve

   !> A case of the table: no friction in the contact of cam and roller.
   function table_case(label) result(case)
      character(len=*), intent(in) :: label
      type(case_t) :: case

      case = thesis_case()
      if (index(label, "skewed") == 1) case = skewed_case(rotation_names(merge(2, 1, index(label, "reversed") > 0)))
      deallocate (case%asperity, case%needle_bearing, case%valve_guide)
      case%traction%rolling_law = rolling_law_names(rolling_none)
      case%masses%finger_centre = 20.0e-3_wp
      call set_point(case, point_speeds(2), point_viscosities(2))
      call add_joints(case, "constant")
   end function table_case

   subroutine test_bodies(error)
      type(error_type), allocatable, intent(out) :: error
      ! The table has 13 digits, and forces are sums of terms up to ten times larger [-]
      real(wp), parameter :: tolerance = 1.0e-11_wp
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(model_t) :: model
      type(position_t) :: position
      type(moments_t) :: moments
      type(contact_t) :: contact
      type(joint_values_t) :: values
      ! As the columns of the table [unit of each], and their sizes
      real(wp) :: found(13), sizes(13)
      integer :: i, k, status

      call read_table("joint_reference.csv", columns, rows, error, names)
      if (allocated(error)) return
      call check(error, size(names) > 50, "rows are missing")
      if (allocated(error)) return
      sizes = [1.0e2_wp, 1.0e2_wp, 1.0_wp, 1.0e1_wp, 1.0e1_wp, 1.0e1_wp, 1.0e1_wp, 1.0e1_wp, 1.0e2_wp, spread(1.0e-1_wp, 1, 4)]
      do i = 1, size(names)
         call make_model(table_case(names(i)), model, error)
         if (allocated(error)) return
         call evaluate_position(model%linkage, [rows(2:4, i), 0.0_wp], position, status)
         call evaluate_moments(model%train, position, model%speed, 0.0_wp, moments)
         call solve_contact(model, position, moments, 0.0_wp, contact, status)
         call evaluate_joints(model, position, moments, contact%load, contact%tangential_force, values)
         found = [contact%load, values%tip_force, values%tip_speed, values%tip_friction, values%upper_force, values%lower_force, &
            & values%seal_friction, values%side_friction, values%pivot_force, values%torque_tip, values%torque_seal, &
            & values%torque_side, values%torque_pivot]
         do k = 1, size(found)
            call check_scaled(error, found(k), rows(4 + k, i), max(abs(rows(4 + k, i)), sizes(k)), tolerance, "column of "// &
               & trim(names(i)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_bodies

   subroutine test_sliding_speed(error)
      type(error_type), allocatable, intent(out) :: error
      ! Step of the differences [rad]: the cube root of round-off; what they leave of speeds of 1 m/s [-]
      real(wp), parameter :: h = 6.0e-6_wp, tolerance = 1.0e-9_wp
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      type(position_t) :: before, after
      ! Speed of the contact over the tip, of the contact over the pad's arc [m/s]
      real(wp) :: over_tip, over_pad
      integer :: i, sense, status

      do sense = 1, 2
         case = skewed_case(rotation_names(sense))
         call add_joints(case, "constant")
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -50, 50
            call evaluate_state(model, i*degree, 0.0_wp, state, status)
            call evaluate_geometry(model, i*degree - h, before, status)
            call evaluate_geometry(model, i*degree + h, after, status)
            ! The tip is flat, so the contact is where the pad's centre is; the pad's normal turns with the finger
            over_tip = (after%valve_arm - before%valve_arm)/(2.0_wp*h)*model%speed
            over_pad = case%valve_tip%pad_radius*(after%arm_angle - before%arm_angle)/(2.0_wp*h)*model%speed
            call check_scaled(error, state%joints%tip_speed, over_tip - over_pad, 1.0_wp, tolerance, "sliding speed")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_sliding_speed

   subroutine test_sliding_distance(error)
      type(error_type), allocatable, intent(out) :: error
      ! Points of the midpoint rule over the event, whose error falls with their square from 1 at one point [-]
      integer, parameter :: points = 20000
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Distance and what it is in closed form [m]; gamma + chi on the base circle and at full lift [rad]
      real(wp) :: distance, expected, closed, open
      integer :: i, status

      case = thesis_case()
      call add_joints(case, "constant")
      call make_model(case, model, error)
      if (allocated(error)) return
      distance = 0.0_wp
      do i = 1, points
         call evaluate_state(model, ((i - 0.5_wp)/points*2.0_wp - 1.0_wp)*70.0_wp*degree, 0.0_wp, state, status)
         distance = distance + abs(state%joints%tip_speed)/model%speed*140.0_wp*degree/points
      end do
      closed = acos(model%linkage%base_cosine)
      open = acos(model%linkage%base_cosine - 9.5e-3_wp/model%linkage%b)
      expected = 2.0_wp*abs(model%linkage%b*(sin(open) - sin(closed)) - 8.0e-3_wp*(open - closed))
      call check_close(error, distance, expected, 1.0e-7_wp, "sliding distance")
      if (allocated(error)) return
      call check_scaled(error, distance, 9.7323e-3_wp, 1.0_wp, 0.5e-7_wp, "sliding distance in millimetres")
   end subroutine test_sliding_distance

   subroutine test_seal_work(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: points = 20000
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Work a turn [J]
      real(wp) :: work
      integer :: i, status

      case = thesis_case()
      call add_joints(case, "constant")
      case%stem_seal%reversal_speed = 0.0_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      work = 0.0_wp
      do i = 1, points
         call evaluate_state(model, ((i - 0.5_wp)/points*2.0_wp - 1.0_wp)*70.0_wp*degree, 0.0_wp, state, status)
         work = work + state%torques(of_seal)*140.0_wp*degree/points
      end do
      call check_close(error, work, 2.0_wp*8.0_wp*9.5e-3_wp, 1.0e-7_wp, "work of the seal")
   end subroutine test_seal_work

   subroutine test_guide_side(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      type(position_t) :: position
      ! Directions of tip and valve, friction of the guide over the force of the tip [-]; offset, height [m]; expected force [N]
      real(wp) :: tip, valve, part, offset, height, force
      logical :: has_tip
      integer :: i, k, status

      do k = 1, 2
         has_tip = k == 1
         case = thesis_case()
         call add_joints(case, "constant")
         if (.not. has_tip) deallocate (case%valve_tip)
         deallocate (case%stem_seal, case%finger_pivot, case%valve_guide)
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -69, 69
            call evaluate_state(model, i*degree, 0.0_wp, state, status)
            position = state%position
            valve = tanh(model%speed*position%lift_slope/1.0e-3_wp)
            tip = 0.0_wp
            if (has_tip) tip = 0.1_wp*tanh(state%joints%tip_speed/1.0e-3_wp)
            offset = position%valve_arm - 34.0e-3_wp
            height = 25.0e-3_wp - position%lift
            part = valve*0.08_wp*(abs((height + 36.0e-3_wp)*tip + offset) + abs(height*tip + offset))/36.0e-3_wp
            associate (m => state%moments)
               force = (m%spring - m%seat + m%valve)/position%valve_arm/(1.0_wp - part)
            end associate
            call check_close(error, state%joints%tip_force, force, roundings, "force of the tip")
            if (allocated(error)) return
            call check_scaled(error, state%joints%side_friction, part*force, force, roundings, "friction of the guide")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_guide_side

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: joints(*) = [of_tip, of_seal, of_guide_side, of_pivot, of_needle_drag]
      type(case_t) :: case
      type(state_t), allocatable :: states(:)
      integer :: i, law, sense

      do law = 1, size(laws)
         do sense = 1, 2
            case = skewed_case(rotation_names(sense))
            call add_gas_force(case)
            call add_joints(case, laws(law))
            allocate (case%needle_drag)
            case%needle_drag%pitch_diameter = 10.22e-3_wp
            call check_energy(case, states, error)
            if (allocated(error)) return
            call check(error, all([(states(i)%torques(joints) >= 0.0_wp, i=1, size(states))]), "friction drives, "//trim(laws(law)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_energy

   subroutine test_any_slip(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Sliding speeds over the cam speed [m]
      real(wp), parameter :: slides(5) = [0.0_wp, 1.0e-6_wp, -1.0e-3_wp, 2.0e-2_wp, -5.0e-2_wp]
      integer :: i, k, law, status

      do law = 1, size(laws)
         case = skewed_case(rotation_names(law))
         call add_joints(case, laws(law))
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -54, 54, 3
            do k = 1, size(slides)
               call evaluate_state(model, i*degree, slides(k)*model%speed, state, status)
               call check(error, status, 0)
               if (allocated(error)) return
               call check_scaled(error, state%torques(of_residual), 0.0_wp, model%speed*(abs(state%torques(of_geometric)) &
                  & + state%torque_friction), 1000*epsilon(1.0_wp), "energy residual")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_any_slip

   subroutine test_stops(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      real(wp), allocatable :: stops(:), before(:)
      ! Places where the valve sets off, turns round and comes to rest, and where the tip's contact passes the pivot [rad]
      real(wp) :: expected(5)
      integer :: i

      case = thesis_case()
      call add_joints(case, "constant")
      call make_model(case, model, error)
      if (allocated(error)) return
      call find_stops(model, before)
      call check(error, size(before), 4, "stops of friction that does not jump")
      if (allocated(error)) return
      ! z = 0 at half lift
      case%valve_tip%sliding%reversal_speed = 0.0_wp
      case%valve_tip%pad_radius = model%linkage%b*model%linkage%base_cosine - 0.5_wp*9.5e-3_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call find_stops(model, stops)
      expected(1:3) = [-70.0_wp, 0.0_wp, 70.0_wp]*degree
      expected(4) = 70.0_wp*degree*sqrt(1.0_wp - 0.5_wp**0.25_wp)
      expected(5) = -expected(4)
      do i = 1, size(expected)
         call check(error, any(stops < expected(i) .and. stops > expected(i) - 1.0e-12_wp), "a stop before a jump")
         if (allocated(error)) return
         call check(error, any(stops > expected(i) .and. stops < expected(i) + 1.0e-12_wp), "a stop behind a jump")
         if (allocated(error)) return
      end do
      call check(error, all(abs(stops) <= 70.0_wp*degree + 1.0e-12_wp), "no stop in the dwell")
   end subroutine test_stops

   subroutine test_limit(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      ! Mean torque of all losses for reversal over a speed, and for a jump [N m]
      real(wp) :: torques(3)
      integer :: i

      do i = 1, 3
         case = thesis_case()
         call add_joints(case, "constant")
         case%numerics%tolerance = 1.0e-7_wp
         case%numerics%method = "rodas5p"
         associate (speed => merge(0.0_wp, 10.0_wp**(2 - 5*i), i == 3))
            case%valve_tip%sliding%reversal_speed = speed
            case%stem_seal%reversal_speed = speed
            case%guide_side_load%sliding%reversal_speed = speed
            case%finger_pivot%sliding%reversal_speed = speed
         end associate
         call mean_friction(case, torques(i), error)
         if (allocated(error)) return
      end do
      ! The valve is slow over an angle that goes with the cube root of the speed: 1e-3 and 1e-8 m/s, so a fiftieth is left
      call check(error, abs(torques(2) - torques(3)) < 0.1_wp*abs(torques(1) - torques(3)), &
         & "the limit is another one")
      if (allocated(error)) return
      call check(error, abs(torques(1) - torques(3)) > 1.0e-5_wp*torques(3), "the reversal's speed makes no difference")
   end subroutine test_limit

   !> Mean torque of the losses.
   subroutine mean_friction(case, torque, error)
      type(case_t), intent(in) :: case
      real(wp), intent(out) :: torque
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(error_t), allocatable :: failure
      ! Mean torques [N m]
      real(wp) :: torques(torque_count)

      torque = 0.0_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      call integrate_torques(model, cycle, torques, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      torque = sum(torques, mask=is_loss)
   end subroutine mean_friction

   subroutine test_no_friction(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: with, without
      type(state_t) :: state, plain
      integer :: i, status

      case = skewed_case(rotation_names(1))
      call make_model(case, without, error)
      if (allocated(error)) return
      call add_joints(case, "constant")
      case%valve_tip%sliding%friction_coefficient = 0.0_wp
      case%guide_side_load%sliding%friction_coefficient = 0.0_wp
      case%finger_pivot%sliding%friction_coefficient = 0.0_wp
      case%stem_seal%lip_force = 0.0_wp
      call make_model(case, with, error)
      if (allocated(error)) return
      do i = -60, 60, 3
         call evaluate_state(with, i*degree, 0.02_wp, state, status)
         call evaluate_state(without, i*degree, 0.02_wp, plain, status)
         call check_close(error, state%contact%load, plain%contact%load, 0.0_wp, "load")
         if (allocated(error)) return
         call check_close(error, state%torque_friction, plain%torque_friction, 0.0_wp, "torque")
         if (allocated(error)) return
      end do
   end subroutine test_no_friction

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure
      integer :: i
      character(len=*), parameter :: words(5) = [character(len=32) :: "jams in its guide", "energy = 'consistent'", &
         & "reversal speeds above", "masses.finger_kg", "positive decay speed"]

      do i = 1, size(words)
         call impossible_joints(i, case)
         call new_model(model, case, 1, failure)
         call expect_error(error, failure, kind_deck, trim(words(i)))
         if (allocated(error)) return
      end do
   end subroutine test_refusals

   !> One of the five mistakes of `test_refusals`.
   subroutine impossible_joints(number, joined)
      integer, intent(in) :: number
      type(case_t), intent(out) :: joined

      joined = thesis_case()
      call add_joints(joined, "constant")
      select case (number)
      case (1)
         ! both coefficients at 0.8, the tip three guides above the guide: 0.8^2 (2 3 + 1)
         joined%valve_tip%sliding%friction_coefficient = 0.8_wp
         joined%guide_side_load%sliding%friction_coefficient = 0.8_wp
         joined%guide_side_load%tip_height = 3.0_wp*joined%guide_side_load%guide_length
      case (2)
         joined%energy = "source"
      case (3)
         allocate (joined%dynamics)
         joined%finger_pivot%sliding%reversal_speed = 0.0_wp
      case (4)
         joined%masses%finger_inertia = 1.0e-5_wp
         joined%masses%finger = 0.0_wp
      case (5)
         joined%valve_tip%sliding%law = "stribeck"
         joined%valve_tip%sliding%decay_speed = 0.0_wp
      end select
   end subroutine impossible_joints

end module test_joints
