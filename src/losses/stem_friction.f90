!> Friction at the valve's end of the finger: pad on valve tip, stem seal, stem pressed against both ends of its guide.
!>
!> In: force that valve, spring and gas need along the valve's axis, place and speed of the pad on the tip, speed of the valve. Out:
!> force of the finger on the tip, friction at tip, seal and guide, with their derivatives in one direction. Source: equilibrium of
!> the valve, `doc/theory.md`.
!>
!> Along the axis, opening positive, `F_tip = F_v + (F_seal + F_guide) sgn(V_v)`; across it the tip's friction `S` and `F_tip` at
!> `d` from the stem's axis press the stem on the ends of its guide with `|(a + L_g) S + d F_tip|/L_g` and `|a S + d F_tip|/L_g`.
module camroller_stem_friction
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_dual, only : dual_t, constant_part, operator(-), operator(*), operator(/), operator(+), abs
   use camroller_names, only : name_length, find_name
   use camroller_number_text, only : number_text
   use camroller_sliding_friction, only : sliding_t, sliding_law_t, new_sliding_law, set_duty, friction_limit, direction_of
   implicit none
   private

   public :: valve_tip_t, stem_seal_t, guide_side_load_t, seal_drag_names
   public :: tip_part_t, seal_part_t, side_part_t, stem_motion_t, stem_t, new_tip_part, new_seal_part, new_side_part, &
      & set_stem_oil, find_stem_forces, rub_stem

   !> How the seal's viscous drag follows the oil: with its viscosity, or not
   character(len=*), parameter :: seal_drag_names(*) = [character(len=name_length) :: "viscosity", "constant"]

   !> Pad on valve tip
   type :: valve_tip_t
      !> Radius of the pad [m]
      real(wp) :: pad_radius = 0.0_wp
      type(sliding_t) :: sliding
   end type valve_tip_t

   !> Lip seal on the stem
   type :: stem_seal_t
      !> Friction of the lip, F_0 [N]
      real(wp) :: lip_force = 0.0_wp
      !> Drag per speed of the valve, c_seal, at the reference viscosity [N s/m]
      real(wp) :: viscous_drag = 0.0_wp
      !> One of `seal_drag_names`
      character(len=name_length) :: drag_follows = "viscosity"
      !> Viscosity that the drag is given for, eta_ref [Pa s]
      real(wp) :: reference_viscosity = 0.0_wp
      !> Speed of the valve over which the lip's friction reverses [m/s]; zero: it jumps
      real(wp) :: reversal_speed = 1.0e-3_wp
   end type stem_seal_t

   !> Stem pressed against its guide
   type :: guide_side_load_t
      !> Length of the guide, L_g [m]
      real(wp) :: guide_length = 0.0_wp
      !> Height of the tip above the guide's end with the valve closed, a [m]
      real(wp) :: tip_height = 0.0_wp
      !> Distance of the stem's axis from the pivot, across the axis [m]
      real(wp) :: stem_axis = 0.0_wp
      type(sliding_t) :: sliding
   end type guide_side_load_t

   !> Pad on valve tip, ready for evaluation
   type :: tip_part_t
      !> Radius of the pad [m]
      real(wp) :: pad_radius = 0.0_wp
      type(sliding_law_t) :: law
   end type tip_part_t

   !> Seal, ready for evaluation
   type :: seal_part_t
      !> Friction of the lip [N]
      real(wp) :: lip_force = 0.0_wp
      !> Drag per speed [N s/m]; at the reference viscosity, and at that of the oil
      real(wp) :: reference_drag = 0.0_wp, drag = 0.0_wp
      !> Reference viscosity; zero: the drag is constant [Pa s]
      real(wp) :: reference_viscosity = 0.0_wp
      !> Speed over which the lip's friction reverses [m/s]
      real(wp) :: reversal_speed = 0.0_wp
   end type seal_part_t

   !> Stem in its guide, ready for evaluation
   type :: side_part_t
      !> Length of the guide, height of the tip with the valve closed, place of the stem's axis [m]
      real(wp) :: guide_length = 0.0_wp, tip_height = 0.0_wp, stem_axis = 0.0_wp
      type(sliding_law_t) :: law
   end type side_part_t

   !> Motion and load of the valve's end of the finger
   type :: stem_motion_t
      !> Valve lift [m], speed of the valve, positive while it opens [m/s]
      type(dual_t) :: lift, valve_speed
      !> Angular speed of the finger, opening positive [rad/s]
      type(dual_t) :: finger_speed
      !> Place of the pad's centre of curvature from the pivot: along the valve's axis towards the cam, B cos(gamma + chi), and
      !> across it, B sin(gamma + chi) [m]
      type(dual_t) :: centre_height, arm
      !> Speed of the pivot across the valve's axis, the pad's way over the tip away from it positive [m/s]
      type(dual_t) :: pivot_speed
      !> Force that valve, spring, seat, gas and drag of the guide need at the tip, F_v; of a pad that bends: its own [N]
      type(dual_t) :: axial_force
   end type stem_motion_t

   !> Forces at the valve's end of the finger
   type :: stem_t
      !> Place of the contact of pad and tip from the pivot, along the valve's axis towards the cam, z [m]
      type(dual_t) :: height
      !> Sliding speed of the pad over the tip, away from the pivot positive, v_tip [m/s]
      type(dual_t) :: tip_speed
      !> Force of the finger on the tip along the axis, F_tip [N]
      type(dual_t) :: tip_force
      !> Friction on the valve's tip, across the axis, away from the pivot positive, S [N]
      type(dual_t) :: tip_friction
      !> Friction of seal and guide on the stem, with the sign of the valve's speed [N]
      type(dual_t) :: seal_friction, side_friction
      !> Forces of the guide's upper and lower end, sizes [N]
      real(wp) :: upper_force = 0.0_wp, lower_force = 0.0_wp
   end type stem_t

   !> Steps of Newton's method for the tip's force: each doubles the figures from about two
   integer, parameter :: most_steps = 20
   !> Relative change of the force whose square is rounding [-]
   real(wp), parameter :: last_change = 1.0e-8_wp
   !> Largest slope of the guide's friction over the tip's force: nearer to one the stem jams [-]
   real(wp), parameter :: largest_slope = 0.9_wp

contains

   !> Make the tip ready.
   subroutine new_tip_part(part, tip, error)
      !> Ready for evaluation
      type(tip_part_t), intent(out) :: part
      !> As a deck has it
      type(valve_tip_t), intent(in) :: tip
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      part%pad_radius = tip%pad_radius
      call new_sliding_law(part%law, tip%sliding, "valve_tip", error)
   end subroutine new_tip_part

   !> Make the seal ready.
   subroutine new_seal_part(part, seal, error)
      !> Ready for evaluation
      type(seal_part_t), intent(out) :: part
      !> As a deck has it
      type(stem_seal_t), intent(in) :: seal
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      integer :: choice

      call find_name("drag of the stem seal", seal%drag_follows, seal_drag_names, choice, error)
      if (allocated(error)) return
      if (.not. (min(seal%lip_force, seal%viscous_drag, seal%reversal_speed) >= 0.0_wp)) then
         call raise(error, kind_deck, "stem_seal: lip force, viscous drag and reversal speed must not be negative")
      else if (choice == 1 .and. seal%viscous_drag > 0.0_wp .and. .not. seal%reference_viscosity > 0.0_wp) then
         call raise(error, kind_deck, "stem_seal: a viscous drag that follows the viscosity needs a positive reference viscosity")
      end if
      if (allocated(error)) return
      part%lip_force = seal%lip_force
      part%reference_drag = seal%viscous_drag
      part%drag = seal%viscous_drag
      part%reversal_speed = seal%reversal_speed
      if (choice == 1 .and. seal%viscous_drag > 0.0_wp) part%reference_viscosity = seal%reference_viscosity
   end subroutine new_seal_part

   !> Make the guide ready; refuses one in which the stem jams.
   subroutine new_side_part(part, side, tip, offset, error)
      !> Ready for evaluation
      type(side_part_t), intent(out) :: part
      !> As a deck has it
      type(guide_side_load_t), intent(in) :: side
      !> The tip; not allocated where it has no friction
      type(tip_part_t), allocatable, intent(in) :: tip
      !> Largest distance of the tip's contact from the stem's axis [m]
      real(wp), intent(in) :: offset
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      ! Friction coefficient of the tip [-], steepest growth of the guide's friction with the tip's force [-]
      real(wp) :: coefficient, slope

      call new_sliding_law(part%law, side%sliding, "guide_side_load", error)
      if (allocated(error)) return
      part%guide_length = side%guide_length
      part%tip_height = side%tip_height
      part%stem_axis = side%stem_axis
      if (.not. (part%guide_length > 0.0_wp .and. part%tip_height >= 0.0_wp)) then
         call raise(error, kind_deck, "guide_side_load: the guide's length must be positive and the tip's height not negative")
         return
      end if
      coefficient = 0.0_wp
      if (allocated(tip)) coefficient = tip%law%coefficient
      slope = part%law%coefficient*(coefficient*(2.0_wp*part%tip_height + part%guide_length) + 2.0_wp*offset)/part%guide_length
      if (slope > largest_slope) call raise(error, kind_deck, "guide_side_load: the stem jams in its guide, whose friction "// &
         & "would grow by up to "//number_text(slope, 3)//" N for each newton at the tip; lower guide_side_load.tip_height_mm "// &
         & "or a friction coefficient, move guide_side_load.stem_axis_mm, or raise guide_side_load.guide_length_mm")
   end subroutine new_side_part

   !> Give all parts the oil's viscosity.
   pure subroutine set_stem_oil(tip, seal, side, viscosity)
      !> The parts, allocated where the case has them
      type(tip_part_t), allocatable, intent(inout) :: tip
      type(seal_part_t), allocatable, intent(inout) :: seal
      type(side_part_t), allocatable, intent(inout) :: side
      !> Viscosity of the oil at ambient pressure [Pa s]
      real(wp), intent(in) :: viscosity

      if (allocated(tip)) call set_duty(tip%law, viscosity)
      if (allocated(side)) call set_duty(side%law, viscosity)
      if (.not. allocated(seal)) return
      if (seal%reference_viscosity > 0.0_wp) seal%drag = seal%reference_drag*viscosity/seal%reference_viscosity
   end subroutine set_stem_oil

   !> Forces at the valve's end of the finger.
   pure subroutine find_stem_forces(tip, seal, side, motion, stem)
      !> The parts, allocated where the case has them
      type(tip_part_t), allocatable, intent(in) :: tip
      type(seal_part_t), allocatable, intent(in) :: seal
      type(side_part_t), allocatable, intent(in) :: side
      !> Motion and load
      type(stem_motion_t), intent(in) :: motion
      !> The forces
      type(stem_t), intent(out) :: stem

      ! Direction of the tip's sliding [-]
      type(dual_t) :: direction

      call move_stem(tip, seal, motion, direction, stem)
      stem%tip_force = motion%axial_force + stem%seal_friction
      if (allocated(side)) call balance_stem(tip, side, motion, direction, stem)
      if (allocated(tip)) stem%tip_friction = direction*friction_limit(tip%law, stem%tip_force, stem%tip_speed)
   end subroutine find_stem_forces

   !> Friction at the valve's end of a finger whose pad bends: the force of the tip is the pad's, whatever the friction.
   pure subroutine rub_stem(tip, seal, side, motion, stem)
      !> The parts, allocated where the case has them
      type(tip_part_t), allocatable, intent(in) :: tip
      type(seal_part_t), allocatable, intent(in) :: seal
      type(side_part_t), allocatable, intent(in) :: side
      !> Motion, and force of the pad
      type(stem_motion_t), intent(in) :: motion
      !> The forces
      type(stem_t), intent(out) :: stem

      ! Direction of the tip's sliding [-]
      type(dual_t) :: direction

      call move_stem(tip, seal, motion, direction, stem)
      stem%tip_force = motion%axial_force
      if (allocated(side)) call press_stem(tip, side, motion, direction, direction_of(motion%valve_speed, &
         & side%law%reversal_speed), stem)
      if (allocated(tip)) stem%tip_friction = direction*friction_limit(tip%law, stem%tip_force, stem%tip_speed)
   end subroutine rub_stem

   !> Sliding of pad and stem, and what follows from it alone.
   pure subroutine move_stem(tip, seal, motion, direction, stem)
      !> The parts, allocated where the case has them
      type(tip_part_t), allocatable, intent(in) :: tip
      type(seal_part_t), allocatable, intent(in) :: seal
      type(stem_motion_t), intent(in) :: motion
      !> Direction of the tip's sliding [-]
      type(dual_t), intent(out) :: direction
      !> Its speed, and friction of the seal
      type(stem_t), intent(inout) :: stem

      stem%height = motion%centre_height
      if (allocated(tip)) stem%height = stem%height + (-tip%pad_radius)
      stem%tip_speed = motion%finger_speed*stem%height + motion%pivot_speed
      if (allocated(tip)) direction = direction_of(stem%tip_speed, tip%law%reversal_speed)
      if (allocated(seal)) stem%seal_friction = seal%lip_force*direction_of(motion%valve_speed, seal%reversal_speed) &
         & + seal%drag*motion%valve_speed
   end subroutine move_stem

   !> Force of the tip with the guide's friction, which depends on it: Newton's method with the slope over the force.
   pure subroutine balance_stem(tip, side, motion, direction, stem)
      !> The tip; not allocated where it has no friction
      type(tip_part_t), allocatable, intent(in) :: tip
      !> The guide
      type(side_part_t), intent(in) :: side
      !> Motion and load
      type(stem_motion_t), intent(in) :: motion
      !> Direction of the tip's sliding [-]
      type(dual_t), intent(in) :: direction
      !> In: the tip's force without the guide's friction; out: with it
      type(stem_t), intent(inout) :: stem

      type(stem_motion_t) :: frozen
      type(stem_t) :: trial
      ! Force without the guide's friction [N]; direction of the stem's sliding in its guide [-]
      type(dual_t) :: start, reversal
      ! Force of the tip and its change in a step [N]; slope of the guide's friction over it [-]
      real(wp) :: force, change, rate
      integer :: i

      start = stem%tip_force
      reversal = direction_of(motion%valve_speed, side%law%reversal_speed)
      frozen = motion
      frozen%lift = constant_part(motion%lift)
      frozen%arm = constant_part(motion%arm)
      frozen%valve_speed = constant_part(motion%valve_speed)
      trial%tip_speed = constant_part(stem%tip_speed)
      force = start%value
      rate = 0.0_wp
      do i = 1, most_steps
         trial%tip_force = dual_t(force, 1.0_wp)
         call press_stem(tip, side, frozen, constant_part(direction), constant_part(reversal), trial)
         rate = trial%side_friction%slope
         change = (start%value + trial%side_friction%value - force)/(1.0_wp - rate)
         force = force + change
         if (abs(change) <= last_change*abs(force)) exit
      end do
      ! What follows at a constant force, then what its change adds; forces balance to rounding
      stem%tip_force = dual_t(force, 0.0_wp)
      call press_stem(tip, side, motion, direction, reversal, stem)
      stem%tip_force%value = start%value + stem%side_friction%value
      stem%tip_force%slope = (start%slope + stem%side_friction%slope)/(1.0_wp - rate)
      stem%side_friction%slope = stem%side_friction%slope + rate*stem%tip_force%slope
   end subroutine balance_stem

   !> How a force of the tip presses the stem on its guide, and what friction that makes.
   pure subroutine press_stem(tip, side, motion, direction, reversal, stem)
      !> The tip; not allocated where it has no friction
      type(tip_part_t), allocatable, intent(in) :: tip
      !> The guide
      type(side_part_t), intent(in) :: side
      !> Motion and load
      type(stem_motion_t), intent(in) :: motion
      !> Directions of the tip's sliding and of the stem's in its guide [-]
      type(dual_t), intent(in) :: direction, reversal
      !> In: force and sliding speed of the tip; out: forces of the guide
      type(stem_t), intent(inout) :: stem

      ! Height of the tip above the guide [m]; side force [N]; moment of the tip's force about the stem [N m]
      type(dual_t) :: height, side_force, moment
      ! Forces of the guide's upper and lower end, sizes [N]
      type(dual_t) :: upper, lower

      if (allocated(tip)) side_force = direction*friction_limit(tip%law, stem%tip_force, stem%tip_speed)
      height = side%tip_height - motion%lift
      moment = (motion%arm + (-side%stem_axis))*stem%tip_force
      lower = abs(height*side_force + moment)/side%guide_length
      upper = abs((height + side%guide_length)*side_force + moment)/side%guide_length
      stem%lower_force = lower%value
      stem%upper_force = upper%value
      stem%side_friction = reversal*(friction_limit(side%law, lower, motion%valve_speed) &
         & + friction_limit(side%law, upper, motion%valve_speed))
   end subroutine press_stem

end module camroller_stem_friction
