!> What a host gives for a step, and the equal parts that the step is divided into.
!>
!> In: inputs at both ends of a step. Out: whether they can be, as an error that says what is allowed; inputs between, linear in the
!> cam angle; the number of parts, the same for steps that differ by rounding alone.
module camroller_step_inputs
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_accuracy, only : is_within, above_zero
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_kinds, only : wp
   use camroller_lubricant, only : get_oil, oil_t
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: inputs_t, check_inputs, inputs_between, part_number

   !> What a host program gives at an end of a step
   type :: inputs_t
      !> Cam speed, above zero [rad/s]
      real(wp) :: speed = 0.0_wp
      !> Temperature of the oil [K]
      real(wp) :: oil_temperature = 0.0_wp
      !> Does the host give the gas pressure? At both ends of a step or at none; without it that of the case counts
      logical :: has_pressure = .false.
      !> Gauge pressure that presses the valve shut [Pa]
      real(wp) :: gas_pressure = 0.0_wp
      !> Does the host give the supply pressure of the lash adjuster? As for the gas pressure
      logical :: has_supply = .false.
      !> Gauge pressure of the oil at the adjuster [Pa]
      real(wp) :: supply_pressure = 0.0_wp
   end type inputs_t

   !> Part by which one may be longer than the longest [-]: a step is the difference of two angles within 1e6 turns, rounded to 1e-9
   !> rad, so that a degree is off by 1e-7 of itself at most. Equal steps have equal parts, wherever they are
   real(wp), parameter :: slack = 1.0e-6_wp

contains

   !> Inputs at a part of a step.
   pure function inputs_between(start, finish, part) result(inputs)
      !> Inputs at its ends
      type(inputs_t), intent(in) :: start, finish
      !> Part of the step, from 0 to 1 [-]
      real(wp), intent(in) :: part
      !> Inputs there
      type(inputs_t) :: inputs

      inputs = start
      inputs%speed = start%speed + (finish%speed - start%speed)*part
      inputs%oil_temperature = start%oil_temperature + (finish%oil_temperature - start%oil_temperature)*part
      inputs%gas_pressure = start%gas_pressure + (finish%gas_pressure - start%gas_pressure)*part
      inputs%supply_pressure = start%supply_pressure + (finish%supply_pressure - start%supply_pressure)*part
   end function inputs_between

   !> Refuse inputs that cannot be at an end of a step; their middle is checked where the model takes it.
   subroutine check_inputs(model, oil_temperature, start, finish, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Temperature of the oil where the step begins [K]
      real(wp), intent(in) :: oil_temperature
      !> Inputs at both ends
      type(inputs_t), intent(in) :: start, finish
      !> Usage, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      ! Temperature that no oil in an engine has: all degrees Celsius of hot oil, up to 180, taken for kelvins are below it, and the
      ! coldest starts, at -40 degC, above [K]
      real(wp), parameter :: coldest = 210.0_wp
      type(oil_t) :: oil
      ! At both ends [K]
      real(wp) :: temperatures(2)
      integer :: i

      temperatures = [start%oil_temperature, finish%oil_temperature]
      if (.not. all(is_within([start%speed, finish%speed], above_zero, huge(1.0_wp)))) then
         call raise(error, kind_usage, "advance: the speed must be positive and finite at both ends of a step; where an engine "// &
            & "stops, end the step before and call halt")
      else if (.not. all(is_within(temperatures, above_zero, huge(1.0_wp)))) then
         call raise(error, kind_usage, "advance: the oil temperature must be above 0 K and finite at both ends of a step")
      else if (any(temperatures < coldest)) then
         call raise(error, kind_usage, "advance: an oil temperature of "//number_text(minval(temperatures), 6)//" K is below "// &
            & "what any oil in an engine has; it is given in kelvin, 363.15 for 90 degC")
      else
         call check_gas(model, start, finish, error)
         if (.not. allocated(error)) call check_supply(model, start, finish, error)
      end if
      ! Where the oil has no viscosity is found before the step goes near it
      do i = 1, 2
         if (allocated(error)) return
         if (abs(temperatures(i) - oil_temperature) <= 0.0_wp) cycle
         call get_oil(model%lubricant, temperatures(i), oil, error)
      end do
   end subroutine check_inputs

   !> Refuse gas pressures that cannot be.
   subroutine check_gas(model, start, finish, error)
      type(model_t), intent(in) :: model
      !> Inputs at both ends of a step
      type(inputs_t), intent(in) :: start, finish
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      call check_given("gas", "has_pressure", [start%has_pressure, finish%has_pressure], [start%gas_pressure, &
         & finish%gas_pressure], error)
      if (allocated(error) .or. .not. start%has_pressure) return
      if (.not. allocated(model%gas)) then
         call raise(error, kind_usage, "advance: a gas pressure needs the valve's area; give the case a gas force, in a deck "// &
            & "the group &gas_force")
      else if (.not. all(ieee_is_finite([start%gas_pressure, finish%gas_pressure]))) then
         call raise(error, kind_usage, "advance: the gas pressure must be finite at both ends of a step")
      end if
   end subroutine check_gas

   !> Refuse a pressure that is given at one end of a step alone, or against what its flag says.
   subroutine check_given(kind, flag, is_flagged, pressures, error)
      !> Which pressure, as its name begins, and the name of its flag
      character(len=*), intent(in) :: kind, flag
      !> The flag at both ends
      logical, intent(in) :: is_flagged(2)
      !> The pressure there [Pa]
      real(wp), intent(in) :: pressures(2)
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (is_flagged(1) .neqv. is_flagged(2)) then
         call raise(error, kind_usage, "advance: the "//kind//" pressure must be given at both ends of a step or at none")
      else if (.not. is_flagged(1) .and. any(is_given(pressures))) then
         call raise(error, kind_usage, "advance: a "//kind//"_pressure is given and "//flag//" says that it is not; set "// &
            & flag//" at both ends, or leave "//kind//"_pressure at 0, and that of the case counts")
      end if
   end subroutine check_given

   !> Is a pressure other than the zero that it has by default?
   elemental function is_given(pressure) result(given)
      !> The pressure [Pa]
      real(wp), intent(in) :: pressure
      !> The answer; true for what is no number
      logical :: given

      given = .not. abs(pressure) <= 0.0_wp
   end function is_given

   !> Refuse supply pressures that cannot be.
   subroutine check_supply(model, start, finish, error)
      type(model_t), intent(in) :: model
      !> Inputs at both ends of a step
      type(inputs_t), intent(in) :: start, finish
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      logical :: has_adjuster

      call check_given("supply", "has_supply", [start%has_supply, finish%has_supply], [start%supply_pressure, &
         & finish%supply_pressure], error)
      if (allocated(error) .or. .not. start%has_supply) return
      has_adjuster = .false.
      if (allocated(model%flexible)) has_adjuster = allocated(model%flexible%adjuster)
      if (.not. has_adjuster) then
         call raise(error, kind_usage, "advance: a supply pressure needs a hydraulic lash adjuster; give the case one, in a "// &
            & "deck the groups &dynamics and &lash_adjuster")
      else if (.not. all(is_within([start%supply_pressure, finish%supply_pressure], 0.0_wp, huge(1.0_wp)))) then
         call raise(error, kind_usage, "advance: the supply pressure, above ambient, must be 0 or more and finite at both ends "// &
            & "of a step")
      end if
   end subroutine check_supply

   !> Fewest equal parts that are not longer than the longest, but for rounding.
   elemental function part_number(span, longest) result(parts)
      !> Cam angle of the step, and of its longest part [rad]
      real(wp), intent(in) :: span, longest
      !> The number, 1 at least
      integer :: parts

      parts = max(1, ceiling(span/longest*(1.0_wp - slack)))
   end function part_number

end module camroller_step_inputs
