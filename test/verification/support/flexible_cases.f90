!> Cases with a flexible train, and states of it drawn at random.
module flexible_cases
   use camroller_kinds, only : wp, pi
   use camroller_cam_surface, only : set_cam
   use camroller_case, only : case_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_needle, only : kind_journal, kind_skf, roller_bearing_names
   use camroller_samples, only : sample_independent
   use camroller_sliding_friction, only : sliding_t
   use camroller_flexible_train, only : first_mode, at_finger, at_finger_rate, at_lift, at_speed, at_sliding, &
      & at_plunger, at_plunger_rate, at_pressure
   use reference_cases, only : set_point, thesis_case
   implicit none
   private

   public :: add_dynamics, add_joints, choose_roller_bearing, coat_cam, random_state, stiff_case, take_friction, largest_way

   !> Way off the rigid train that random states go to [m]: contacts are closed in some and open in others
   real(wp), parameter :: largest_way = 3.0e-5_wp

contains

   !> Make a case's train flexible.
   subroutine add_dynamics(the_case, modes, has_adjuster)
      !> The case
      type(case_t), intent(inout) :: the_case
      !> Modes of the spring; its mass moves with the valve where there are none
      integer, intent(in) :: modes
      !> Has it a lash adjuster?
      logical, intent(in) :: has_adjuster

      allocate (the_case%dynamics)
      if (modes > 0) then
         allocate (the_case%spring_surge)
         the_case%spring_surge%mass = 0.036_wp
         the_case%spring_surge%modes = modes
      end if
      if (has_adjuster) allocate (the_case%lash_adjuster)
   end subroutine add_dynamics

   !> A train at 300 rev/min with more stiffness; a root of that keeps the damping ratio.
   function stiff_case(factor, modes) result(the_case)
      !> Stiffness over the usual [-]
      real(wp), intent(in) :: factor
      !> Modes of the spring
      integer, intent(in) :: modes
      !> The case
      type(case_t) :: the_case

      the_case = thesis_case()
      call set_point(the_case, 10.0_wp*pi, 0.01_wp)
      call add_dynamics(the_case, modes, .false.)
      associate (dynamics => the_case%dynamics)
         dynamics%finger_stiffness = factor*dynamics%finger_stiffness
         dynamics%pad_stiffness = factor*dynamics%pad_stiffness
         dynamics%seat_stiffness = factor*dynamics%seat_stiffness
         dynamics%contact_damping = sqrt(factor)*dynamics%contact_damping
         dynamics%pad_damping = sqrt(factor)*dynamics%pad_damping
         dynamics%seat_damping = sqrt(factor)*dynamics%seat_damping
      end associate
      ! Cam and roller give way as Palmgren says whatever the finger: with twice the length they do by 2^0.8 less, and so on
      the_case%materials%cam_modulus = factor**(1.0_wp/0.9_wp)*the_case%materials%cam_modulus
      the_case%materials%roller_modulus = factor**(1.0_wp/0.9_wp)*the_case%materials%roller_modulus
   end function stiff_case

   !> Give the train friction at tip, stem and pivot by one of five choices, 0 for none.
   subroutine add_joints(the_case, number)
      !> The case
      type(case_t), intent(inout) :: the_case
      !> Which, from 0: none; tip and seal; tip and ends of the guide; pivot; all by Stribeck's law
      integer, intent(in) :: number

      if (any(number == [1, 2, 4])) then
         allocate (the_case%valve_tip)
         the_case%valve_tip%pad_radius = 8.0e-3_wp
         call set_sliding(the_case%valve_tip%sliding, number == 4)
      end if
      if (any(number == [1, 4])) then
         allocate (the_case%stem_seal)
         the_case%stem_seal%lip_force = 8.0_wp
         the_case%stem_seal%viscous_drag = 5.0_wp
         the_case%stem_seal%reference_viscosity = 0.02_wp
      end if
      if (any(number == [2, 4])) then
         allocate (the_case%guide_side_load)
         the_case%guide_side_load%guide_length = 0.04_wp
         the_case%guide_side_load%tip_height = 0.03_wp
         the_case%guide_side_load%stem_axis = 0.034_wp
         call set_sliding(the_case%guide_side_load%sliding, number == 4)
      end if
      if (number >= 3) then
         allocate (the_case%finger_pivot)
         the_case%finger_pivot%ball_radius = 5.0e-3_wp
         call set_sliding(the_case%finger_pivot%sliding, number == 4)
      end if
   end subroutine add_joints

   !> Coefficient of a joint.
   subroutine set_sliding(sliding, has_curve)
      !> What it is set of
      type(sliding_t), intent(inout) :: sliding
      !> By Stribeck's law?
      logical, intent(in) :: has_curve

      sliding%friction_coefficient = 0.1_wp
      if (.not. has_curve) return
      sliding%law = "stribeck"
      sliding%decay_speed = 0.3_wp
      sliding%viscous_part = 0.02_wp
      sliding%reference_viscosity = 0.02_wp
      sliding%reference_load = 300.0_wp
   end subroutine set_sliding

   !> Give the roller one of four bearings: needles, the same with their oil's drag, needles by SKF's model, a pin with a film.
   subroutine choose_roller_bearing(the_case, number)
      !> The case, with needles
      type(case_t), intent(inout) :: the_case
      !> Which, from 0
      integer, intent(in) :: number

      associate (bearing => the_case%needle_bearing)
         select case (number)
         case (1)
            allocate (the_case%needle_drag)
            the_case%needle_drag%factor = 12.0_wp
            the_case%needle_drag%pitch_diameter = 10.22e-3_wp
         case (2)
            bearing%kind = roller_bearing_names(kind_skf)
            bearing%friction_coefficient = 0.15_wp
            bearing%skf%rolling = 1.2e-6_wp
            bearing%skf%sliding = 1.5e-3_wp
            bearing%skf%geometry = 5.0_wp
         case (3)
            bearing%kind = roller_bearing_names(kind_journal)
            bearing%friction_coefficient = 0.1_wp
            bearing%film%width = 9.0e-3_wp
            bearing%film%radial_clearance = 20.0e-6_wp
            bearing%film%roughness = 0.3e-6_wp
            bearing%film%modulus = 180.0e9_wp
         end select
      end associate
   end subroutine choose_roller_bearing

   !> Grow a film on the cam, from nothing to 0.2 um within degrees.
   subroutine coat_cam(model)
      !> The model
      type(model_t), intent(inout) :: model

      real(wp), parameter :: thickness = 2.0e-7_wp ! [m]
      integer :: i

      allocate (model%surface)
      model%surface%roughness_ratio = 1.0_wp
      model%surface%largest_thickness = thickness
      if (allocated(model%boundary)) model%boundary%film_coefficient = 0.02_wp
      call set_cam(model%surface, [(thickness*modulo(i, 2), i=1, 72)], [(0.0_wp, i=1, 72)])
   end subroutine coat_cam

   !> Take friction out of a case, and dampers where that is asked for.
   subroutine take_friction(the_case, has_dampers)
      !> The case
      type(case_t), intent(inout) :: the_case
      !> Do they stay?
      logical, intent(in) :: has_dampers

      if (allocated(the_case%asperity)) deallocate (the_case%asperity)
      if (allocated(the_case%needle_bearing)) deallocate (the_case%needle_bearing)
      if (allocated(the_case%valve_guide)) deallocate (the_case%valve_guide)
      the_case%traction%rolling_law = "none"
      ! the film's traction cannot be left out; this much of it is below round-off
      the_case%traction%limiting_coefficient = 1.0e-15_wp
      if (has_dampers) return
      the_case%dynamics%contact_damping = 0.0_wp
      the_case%dynamics%pad_damping = 0.0_wp
      the_case%dynamics%seat_damping = 0.0_wp
      if (allocated(the_case%spring_surge)) the_case%spring_surge%damping_ratio = 0.0_wp
   end subroutine take_friction

   !> A state near the rigid train's, by its number.
   subroutine random_state(model, number, angle, state)
      !> The model
      type(model_t), intent(in) :: model
      !> Number of the state
      integer, intent(in) :: number
      !> Cam angle [rad]
      real(wp), intent(out) :: angle
      !> The state [state]
      real(wp), intent(out) :: state(:)

      type(position_t) :: position
      ! Coordinates of the state, from -1 to 1 [-]
      real(wp) :: x(size(state) + 1)
      integer :: i, status, first

      x = [(2.0_wp*sample_independent(number, i, 7) - 1.0_wp, i=1, size(x))]
      angle = pi*x(size(x))
      call evaluate_geometry(model, angle, position, status)
      first = first_mode(model)
      state(at_finger) = position%arm_angle - model%linkage%arm_offset - model%linkage%valve_axis_angle &
         & + x(1)*largest_way/model%linkage%a
      state(at_finger_rate) = model%speed*position%finger_slope + 0.3_wp*x(2)/model%linkage%a
      state(at_lift) = position%lift + largest_way*x(3)
      state(at_speed) = model%speed*position%lift_slope + 0.3_wp*x(4)
      state(at_sliding) = 0.3_wp*x(5)*abs(x(5))**3*model%speed*model%roller_radius
      if (allocated(model%flexible%adjuster)) then
         state(at_plunger) = largest_way*x(6)
         if (modulo(number, 5) == 0) state(at_plunger) = model%flexible%adjuster%given%highest + largest_way*x(6)
         if (modulo(number, 5) == 1) state(at_plunger) = model%flexible%adjuster%given%lowest + largest_way*x(6)
         if (modulo(number, 5) < 2) state(at_finger) = state(at_finger) + state(at_plunger)/model%linkage%a
         state(at_plunger_rate) = 0.1_wp*x(7)
         state(at_pressure) = 1.0e5_wp*(1.5_wp + 2.4_wp*x(8) + 20.0_wp*max(0.0_wp, x(8)))
      end if
      state(first::2) = 1.0e-4_wp*x(first:size(state):2)
      state(first + 1::2) = 0.3_wp*x(first + 1:size(state):2)
   end subroutine random_state

end module flexible_cases
