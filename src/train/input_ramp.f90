!> Inputs of a host program that change over a step: linear in the cam angle.
module camroller_input_ramp
   use camroller_kinds, only : wp
   implicit none
   private

   public :: ramp_t

   !> Speed, oil temperature and supply pressure over a step
   type :: ramp_t
      !> Does anything change? Without it the model stands at one speed and one temperature
      logical :: is_moving = .false.
      !> Cam angle from full lift in the middle of the step [rad]
      real(wp) :: angle = 0.0_wp
      !> Cam speed there [rad/s]; its change is the model's `speed_slope`
      real(wp) :: speed = 0.0_wp
      !> Temperature of the oil there [K], and its change with the cam angle [K/rad]
      real(wp) :: temperature = 0.0_wp, temperature_slope = 0.0_wp
      !> Supply pressure of a lash adjuster there [Pa], and its change with the cam angle [Pa/rad]
      real(wp) :: supply = 0.0_wp, supply_slope = 0.0_wp
   end type ramp_t

end module camroller_input_ramp
