!> The engine that the camshafts belong to: what turns cam angles into crank angles, and torques into mean pressures.
!>
!> In: what a case says. Out: phases of cams, crank angles, the speed in words.
module camroller_engine
   use camroller_kinds, only : wp, pi, two_pi, per_minute
   use camroller_number_text, only : append_number
   implicit none
   private

   public :: engine_t, cam_turns, from_firing, lobe_lag, cam_phases_of, crank_angle_at_nose, speed_names, write_speed

   !> Whose speed a deck gives
   character(len=*), parameter :: speed_names(*) = [character(len=10) :: "crankshaft", "camshaft"]

   !> Engine
   type :: engine_t
      !> Cylinders, firing at equal distances
      integer :: cylinders = 1
      !> Volume displaced by all cylinders [m^3]
      real(wp) :: displacement = 0.0_wp
      !> Strokes of a working cycle, 2 or 4
      integer :: strokes = 4
      !> Camshafts, alike but for their lobes
      integer :: camshafts = 1
      !> Cylinders in the order in which they fire
      integer, allocatable :: firing_order(:)
      !> Crank angle from the firing dead centre of a cylinder to full lift, for each lobe shape [rad]
      real(wp), allocatable :: full_lift(:)
      !> Cylinder of each cam
      integer, allocatable :: cam_cylinders(:)
   end type engine_t

contains

   !> Turns of the crankshaft in one turn of the camshaft.
   elemental function cam_turns(engine) result(turns)
      !> The engine
      type(engine_t), intent(in) :: engine
      !> The turns [-]
      real(wp) :: turns

      turns = 0.5_wp*engine%strokes
   end function cam_turns

   !> Crank angle from the nearest firing dead centre of a cylinder.
   elemental function from_firing(angle, strokes) result(distance)
      !> Crank angle from any of its firing dead centres [rad]
      real(wp), intent(in) :: angle
      !> Strokes of a working cycle
      integer, intent(in) :: strokes
      !> The distance, negative before it [rad]
      real(wp) :: distance

      ! Crank angle of a working cycle [rad]
      real(wp) :: cycle_angle

      cycle_angle = pi*strokes
      distance = modulo(angle + 0.5_wp*cycle_angle, cycle_angle) - 0.5_wp*cycle_angle
   end function from_firing

   !> By how much full lift of a lobe shape follows that of the first on valves of the same cylinder. Cam angles grow with time for
   !> either sense of rotation, so that it does not matter here.
   pure function lobe_lag(engine, lobe) result(lag)
      !> The engine
      type(engine_t), intent(in) :: engine
      !> The lobe shape
      integer, intent(in) :: lobe
      !> The angle, of any turn [rad of cam angle]
      real(wp) :: lag

      lag = (engine%full_lift(lobe) - engine%full_lift(1))/cam_turns(engine)
   end function lobe_lag

   !> A speed in the words of messages: `3000 rev/min`, or `6000 rev/min of the crankshaft` where the engine is known.
   pure subroutine write_speed(speed, turns, digits, text)
      !> Speed of the camshaft [rad/s]
      real(wp), intent(in) :: speed
      !> Turns of the crankshaft in one of the camshaft, 0 without an engine [-]
      real(wp), intent(in) :: turns
      !> Significant digits
      integer, intent(in) :: digits
      !> The words
      character(len=:), allocatable, intent(out) :: text

      text = ""
      if (turns > 0.0_wp) then
         call append_number(text, turns*speed*per_minute, digits)
         text = text//" rev/min of the crankshaft"
      else
         call append_number(text, speed*per_minute, digits)
         text = text//" rev/min"
      end if
   end subroutine write_speed

   !> Crank angle from the firing dead centre of cylinder 1 to full lift of a cam, within one working cycle.
   pure function full_lift_angle(engine, cylinder, lobe) result(angle)
      type(engine_t), intent(in) :: engine
      !> Cylinder and lobe shape of the cam
      integer, intent(in) :: cylinder, lobe
      !> The angle [rad of crank angle]
      real(wp) :: angle

      ! Crank angle of a working cycle [rad]
      real(wp) :: cycle_angle

      cycle_angle = two_pi*cam_turns(engine)
      angle = modulo(cycle_angle*(findloc(engine%firing_order, cylinder, dim=1) - findloc(engine%firing_order, 1, dim=1)) &
         & /engine%cylinders + engine%full_lift(lobe), cycle_angle)
   end function full_lift_angle

   !> Angles by which the events of cams follow the first cam's.
   pure function cam_phases_of(engine, lobes) result(phases)
      !> The engine
      type(engine_t), intent(in) :: engine
      !> Lobe shape of each cam
      integer, intent(in) :: lobes(:)
      !> The angles, from 0 to a turn [rad of cam angle]
      real(wp) :: phases(size(lobes))

      integer :: cam

      do cam = 1, size(lobes)
         phases(cam) = modulo((full_lift_angle(engine, engine%cam_cylinders(cam), lobes(cam)) &
            & - full_lift_angle(engine, engine%cam_cylinders(1), lobes(1)))/cam_turns(engine), two_pi)
      end do
   end function cam_phases_of

   !> Crank angle from the firing dead centre of cylinder 1 at which the first cam is at full lift: at cam angle 180.
   pure function crank_angle_at_nose(engine, lobes) result(angle)
      !> The engine
      type(engine_t), intent(in) :: engine
      !> Lobe shape of each cam
      integer, intent(in) :: lobes(:)
      !> The angle [rad of crank angle]
      real(wp) :: angle

      angle = full_lift_angle(engine, engine%cam_cylinders(1), lobes(1))
   end function crank_angle_at_nose

end module camroller_engine
