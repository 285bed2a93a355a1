!> Friction of a sliding joint of the train: coefficient by a law, direction with a reversal that is spread or sharp.
!>
!> In: law, force between the surfaces, sliding speed, viscosity. Out: friction, with its derivative in one direction. Sources:
!> Coulomb's law; Stribeck's curve in the exponential form of Bo and Pavelescu (1982) with the duty parameter, viscosity times speed
!> over load, in the place of the speed. The spread reversal is ours.
module camroller_sliding_friction
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_dual, only : dual_t, operator(/), abs, tanh
   implicit none
   private

   public :: sliding_t, sliding_law_t, sliding_law_names, new_sliding_law, set_duty, friction_limit, place_on_curve, &
      & speed_of_peak, direction_of

   !> Coefficients of friction: constant, or falling from boundary to mixed friction and rising with the viscous part
   character(len=*), parameter :: sliding_law_names(*) = [character(len=name_length) :: "constant", "stribeck"]

   !> Friction of a joint, as a deck has it
   type :: sliding_t
      !> One of `sliding_law_names`
      character(len=name_length) :: law = "constant"
      !> Friction coefficient, mu; of law `stribeck` that at standstill [-]
      real(wp) :: friction_coefficient = 0.0_wp
      !> Sliding speed at which that has fallen to 1/e, v_d, at the reference viscosity and load [m/s]; law `stribeck`
      real(wp) :: decay_speed = 0.0_wp
      !> Viscous part of the coefficient per sliding speed, c_v, at the reference viscosity and load [s/m]; law `stribeck`
      real(wp) :: viscous_part = 0.0_wp
      !> Reference viscosity, eta_ref [Pa s], and load, F_ref [N]; law `stribeck`
      real(wp) :: reference_viscosity = 0.0_wp, reference_load = 0.0_wp
      !> Sliding speed over which friction reverses [m/s]; zero: it jumps
      real(wp) :: reversal_speed = 1.0e-3_wp
   end type sliding_t

   !> The same ready for evaluation
   type :: sliding_law_t
      !> Does the coefficient follow Stribeck's curve?
      logical :: has_curve = .false.
      !> Friction coefficient [-]
      real(wp) :: coefficient = 0.0_wp
      !> Decay speed [m/s], viscous part [s/m]
      real(wp) :: decay_speed = 0.0_wp, viscous_part = 0.0_wp
      !> Reference load over reference viscosity [N/(Pa s)], and that times the viscosity [N]
      real(wp) :: reference = 0.0_wp, duty = 0.0_wp
      !> Speed over which friction reverses; zero: it jumps [m/s]
      real(wp) :: reversal_speed = 0.0_wp
   end type sliding_law_t

contains

   !> Make a law ready.
   subroutine new_sliding_law(law, sliding, group, error)
      !> The law
      type(sliding_law_t), intent(out) :: law
      !> As a deck has it
      type(sliding_t), intent(in) :: sliding
      !> Group of the deck, for the message
      character(len=*), intent(in) :: group
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      integer :: choice

      call find_name("friction law", sliding%law, sliding_law_names, choice, error)
      if (allocated(error)) return
      law%has_curve = choice == 2
      law%coefficient = sliding%friction_coefficient
      law%reversal_speed = sliding%reversal_speed
      if (.not. (law%coefficient >= 0.0_wp .and. law%reversal_speed >= 0.0_wp)) then
         call raise(error, kind_deck, group//": friction coefficient and reversal speed must not be negative")
      end if
      if (allocated(error) .or. .not. law%has_curve) return
      if (.not. min(sliding%decay_speed, sliding%reference_viscosity, sliding%reference_load) > 0.0_wp) then
         call raise(error, kind_deck, group//": law 'stribeck' needs a positive decay speed, reference viscosity and "// &
            & "reference load")
      else if (.not. sliding%viscous_part >= 0.0_wp) then
         call raise(error, kind_deck, group//": the viscous part must not be negative")
      end if
      if (allocated(error)) return
      law%decay_speed = sliding%decay_speed
      law%viscous_part = sliding%viscous_part
      law%reference = sliding%reference_load/sliding%reference_viscosity
   end subroutine new_sliding_law

   !> Give a law the oil's viscosity.
   pure subroutine set_duty(law, viscosity)
      !> The law
      type(sliding_law_t), intent(inout) :: law
      !> Viscosity of the oil at ambient pressure [Pa s]
      real(wp), intent(in) :: viscosity

      law%duty = law%reference*viscosity
   end subroutine set_duty

   !> Friction of a joint that slides, `mu F`, or by Stribeck's curve `mu F exp(-x/v_d) + c_v x F` with
   !> `x = |v| (eta/eta_ref) (F_ref/F)`, the speed that the joint would have at reference viscosity and load.
   !>
   !> It grows with the force, no more steeply than `mu`; the viscous part, `c_v |v| eta F_ref/eta_ref`, does not depend on it.
   elemental function friction_limit(law, force, speed) result(limit)
      !> The law
      type(sliding_law_t), intent(in) :: law
      !> Force between the surfaces; none where it is negative [N]
      type(dual_t), intent(in) :: force
      !> Sliding speed, of either sign [m/s]
      type(dual_t), intent(in) :: speed
      !> Friction, not negative [N]
      type(dual_t) :: limit

      ! Sliding speed without its sign [m/s]
      type(dual_t) :: size
      ! x/v_d, and mu exp(-x/v_d) [-]
      real(wp) :: exponent, coefficient

      ! Written out, since a case spends much of its time here
      limit = dual_t(0.0_wp, 0.0_wp)
      if (law%has_curve) then
         size = abs(speed)
         limit = dual_t(law%viscous_part*law%duty*size%value, law%viscous_part*law%duty*size%slope)
         if (.not. force%value > 0.0_wp) return
         exponent = law%duty*size%value/(law%decay_speed*force%value)
         coefficient = law%coefficient*exp(-exponent)
         limit%value = limit%value + coefficient*force%value
         limit%slope = limit%slope + coefficient*((1.0_wp + exponent)*force%slope - law%duty*size%slope/law%decay_speed)
      else if (force%value > 0.0_wp) then
         limit = dual_t(law%coefficient*force%value, law%coefficient*force%slope)
      end if
   end function friction_limit

   !> Where a joint that sets off is on Stribeck's curve: logarithms of its speed over that of the largest friction, where reversal
   !> and curve meet at `sinh(2 v/v_r) = 2 v_d/(v_r x/|v|)`, and over that at which nothing is left of it. Above zero: beyond.
   pure function place_on_curve(law, force, speed) result(place)
      !> The law
      type(sliding_law_t), intent(in) :: law
      !> Force between the surfaces [N]
      real(wp), intent(in) :: force
      !> Sliding speed, of either sign [m/s]
      real(wp), intent(in) :: speed
      !> Both logarithms; below zero where there is no such speed [-]
      real(wp) :: place(2)

      real(wp) :: decay, top ! speed in which the friction falls to 1/e; speed of the largest friction [m/s]

      place = -1.0_wp
      if (.not. (law%has_curve .and. force > 0.0_wp .and. law%duty > 0.0_wp)) return
      decay = law%decay_speed*force/law%duty
      place(2) = log(max(abs(speed), tiny(1.0_wp))/(-log(epsilon(1.0_wp))*decay))
      top = speed_of_peak(law, force)
      if (.not. top > 0.0_wp) return
      place(1) = log(max(abs(speed), tiny(1.0_wp))/top)
   end function place_on_curve

   !> Sliding speed at which friction by Stribeck's curve is largest, where the spread of its reversal has ended and its fall
   !> begins; zero where there is no such speed.
   pure function speed_of_peak(law, force) result(speed)
      !> The law
      type(sliding_law_t), intent(in) :: law
      !> Force between the surfaces [N]
      real(wp), intent(in) :: force
      !> The speed [m/s]
      real(wp) :: speed

      speed = 0.0_wp
      if (.not. (law%has_curve .and. min(force, law%duty, law%reversal_speed) > 0.0_wp)) return
      speed = 0.5_wp*law%reversal_speed*asinh(2.0_wp*law%decay_speed*force/(law%duty*law%reversal_speed))
   end function speed_of_peak

   !> Direction of sliding, from -1 to 1: `tanh(v/v_r)`, or the sign where the reversal is sharp.
   elemental function direction_of(speed, reversal_speed) result(direction)
      !> Sliding speed [m/s]
      type(dual_t), intent(in) :: speed
      !> Speed over which friction reverses; zero: it jumps [m/s]
      real(wp), intent(in) :: reversal_speed
      !> Direction [-]
      type(dual_t) :: direction

      if (reversal_speed > 0.0_wp) then
         direction = tanh(speed/reversal_speed)
      else
         direction = dual_t(0.0_wp, 0.0_wp)
         if (abs(speed%value) > 0.0_wp) direction%value = sign(1.0_wp, speed%value)
      end if
   end function direction_of

end module camroller_sliding_friction
