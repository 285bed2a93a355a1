!> Cases with a flexible train that a host drives, and the inputs that it gives.
module driven_trains
   use camroller, only : wp, pi, case_t, numerics_t, inputs_t
   use flexible_cases, only : add_dynamics, add_joints, choose_roller_bearing
   use reference_cases, only : thesis_case, set_point, add_gas_force
   implicit none
   private

   public :: train, steady, inputs_at, engine_case

contains

   !> A case of the reference train.
   function train(speed, modes, has_adjuster, accuracy) result(the_case)
      !> Speed [rev/min]
      real(wp), intent(in) :: speed
      integer, intent(in) :: modes
      logical, intent(in) :: has_adjuster
      !> Accuracy [-]
      real(wp), intent(in) :: accuracy
      type(case_t) :: the_case

      the_case = thesis_case()
      call set_point(the_case, speed*pi/30.0_wp, 0.01_wp)
      call add_dynamics(the_case, modes, has_adjuster)
      the_case%numerics = numerics_t(accuracy=accuracy)
   end function train

   !> Steady inputs of a case.
   function steady(the_case) result(inputs)
      type(case_t), intent(in) :: the_case
      type(inputs_t) :: inputs

      inputs%speed = the_case%operating_point%speed
      inputs%oil_temperature = the_case%operating_point%oil_temperature
   end function steady

   !> Inputs of an engine whose speed, oil, gas and supply pressure go round with the cam.
   pure function inputs_at(angle) result(inputs)
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      type(inputs_t) :: inputs

      inputs%speed = 90.0_wp*(1.0_wp + 0.05_wp*sin(4.0_wp*angle))
      inputs%oil_temperature = 350.0_wp + 4.0_wp*cos(angle)
      inputs%has_pressure = .true.
      inputs%gas_pressure = 1.0e5_wp*(1.0_wp + sin(2.0_wp*angle))
      inputs%has_supply = .true.
      inputs%supply_pressure = 2.0e5_wp*(1.0_wp + 0.3_wp*sin(3.0_wp*angle))
   end function inputs_at

   !> Case that follows such inputs.
   function engine_case(tolerance) result(the_case)
      !> Tolerance [-]
      real(wp), intent(in) :: tolerance
      type(case_t) :: the_case

      the_case = train(860.0_wp, 1, .true., 1.0e-3_wp)
      the_case%lubricant%temperature_law = "vogel"
      the_case%lubricant%temperature_points = [313.15_wp, 343.15_wp, 373.15_wp]
      the_case%lubricant%viscosity_points = [0.08_wp, 0.025_wp, 0.011_wp]
      the_case%operating_point%oil_temperature = 350.0_wp
      the_case%numerics%tolerance = tolerance
      call add_gas_force(the_case)
      call choose_roller_bearing(the_case, 2)
      call add_joints(the_case, 4)
   end function engine_case

end module driven_trains
