!> Force of the cylinder pressure on the valve as a function of the cam angle.
!>
!> In: a table over one cycle and the area of the valve head. Out: force in the direction that closes the valve.
module camroller_gas
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t, add_context, raise, kind_deck
   use camroller_dynamics, only : gas_force_t
   use camroller_spline, only : spline_t, new_periodic_spline, evaluate_spline, sharp_points
   implicit none
   private

   public :: gas_law_t, new_gas_law, give_pressure, gas_force, gas_force_slope

   !> Usual largest magnitudes of a gauge pressure: from pulses in a manifold to a truck's engine under full load [Pa]
   real(wp), parameter, public :: usual_pressure(2) = [2.0e3_wp, 3.0e7_wp]
   !> Gauge pressure that nothing is below: a vacuum, and some high weather [Pa]
   real(wp), parameter, public :: vacuum = -1.1e5_wp

   !> Pressure table ready for evaluation
   type :: gas_law_t
      !> Pressure over the cam angle [Pa over rad]
      type(spline_t) :: pressure
      !> First angle of the table [rad]
      real(wp) :: first_angle = 0.0_wp
      !> Cam angles from full lift, of any turn, where the table bends sharply [rad]
      real(wp), allocatable :: sharp_angles(:)
      !> Area of the valve head [m^2]
      real(wp) :: valve_area = 0.0_wp
      !> Does a host program give the pressure in the place of the table?
      logical :: is_given = .false.
      !> Cam angle from full lift that its pressure counts from [rad]
      real(wp) :: given_angle = 0.0_wp
      !> Pressure there [Pa] and its change with the cam angle [Pa/rad]
      real(wp) :: given_pressure = 0.0_wp, given_slope = 0.0_wp
   end type gas_law_t

   !> Part of the largest pressure by which neighbouring pieces of the curve differ where it bends sharply [-]
   real(wp), parameter :: sharp = 1.0e-5_wp

contains

   !> Put a periodic spline through the pressure table.
   subroutine new_gas_law(law, gas, error)
      !> The law
      type(gas_law_t), intent(out) :: law
      !> Table and area
      type(gas_force_t), intent(in) :: gas
      !> Deck error for a table that does not span one turn, domain error for one that no spline fits
      type(error_t), allocatable, intent(out) :: error

      ! Largest mismatch of the table's span with a turn [rad]: tables are written in degrees with some figures
      real(wp), parameter :: span_tolerance = 1.0e-6_wp
      integer :: last

      last = 0
      if (allocated(gas%angle) .and. allocated(gas%pressure)) then
         if (size(gas%angle) == size(gas%pressure)) last = size(gas%angle)
      end if
      if (last < 2) then
         call raise(error, kind_deck, "gas force: the table needs as many pressures as angles, two at least")
         return
      end if
      if (abs(gas%angle(last) - gas%angle(1) - two_pi) > span_tolerance) then
         call raise(error, kind_deck, "gas force: the table must span one turn of the camshaft, first and last point included")
         return
      end if
      call new_periodic_spline(law%pressure, [gas%angle(:last - 1), gas%angle(1) + two_pi], gas%pressure, 0.0_wp, error)
      call add_context(error, "gas force")
      if (allocated(error)) return
      law%first_angle = gas%angle(1)
      law%sharp_angles = sharp_points(law%pressure, sharp*maxval(abs(gas%pressure)))
      law%valve_area = gas%valve_area
   end subroutine new_gas_law

   !> Take a pressure that changes linearly between two cam angles in the place of the table.
   pure subroutine give_pressure(law, angles, pressures)
      !> The law
      type(gas_law_t), intent(inout) :: law
      !> Two cam angles from full lift, increasing [rad]
      real(wp), intent(in) :: angles(2)
      !> Gauge pressure there, positive where it presses the valve shut [Pa]
      real(wp), intent(in) :: pressures(2)

      law%is_given = .true.
      law%given_angle = angles(1)
      law%given_pressure = pressures(1)
      law%given_slope = (pressures(2) - pressures(1))/(angles(2) - angles(1))
   end subroutine give_pressure

   !> Cylinder pressure times valve area, positive where it presses the valve shut.
   pure function gas_force(law, angle) result(force)
      !> The law
      type(gas_law_t), intent(in) :: law
      !> Cam angle from full lift, any turn [rad]
      real(wp), intent(in) :: angle
      !> Force [N]
      real(wp) :: force

      ! Pressure and its derivatives [Pa/rad^n]
      real(wp) :: values(0:3)

      if (law%is_given) then
         force = (law%given_pressure + law%given_slope*(angle - law%given_angle))*law%valve_area
         return
      end if
      call evaluate_spline(law%pressure, law%first_angle + modulo(angle - law%first_angle, two_pi), values)
      force = values(0)*law%valve_area
   end function gas_force

   !> Derivative of that force with respect to the cam angle.
   pure function gas_force_slope(law, angle) result(slope)
      !> The law
      type(gas_law_t), intent(in) :: law
      !> Cam angle from full lift, any turn [rad]
      real(wp), intent(in) :: angle
      !> Derivative [N/rad]
      real(wp) :: slope

      ! Pressure and its derivatives [Pa/rad^n]
      real(wp) :: values(0:3)

      slope = law%given_slope*law%valve_area
      if (law%is_given) return
      call evaluate_spline(law%pressure, law%first_angle + modulo(angle - law%first_angle, two_pi), values)
      slope = values(1)*law%valve_area
   end function gas_force_slope

end module camroller_gas
