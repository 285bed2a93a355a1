!> Load of a flexible train round the cycle, estimated without integrating its motion, and what differs between two trains.
!>
!> In: a model, rigid or flexible. Out: the load without friction at even angles, the amplitude of its vibration, the torque that
!> dampers and leak take. The bent train is in equilibrium under the inertia of a rigid one, its adjuster leaks and is filled again;
!> that load drives the train's lowest mode, and the rigid lift the modes of the spring, each as an oscillator with exact steps.
!> What parts or returns within the event is not estimated, nor a train that friction shakes because it falls with speed.
module camroller_effect_train
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_contact_compliance, only : series_approach
   use camroller_dynamics, only : moments_t
   use camroller_effect_grid, only : grid_t, points
   use camroller_error, only : error_t
   use camroller_flexible_parts, only : flexible_t
   use camroller_flexible_setup, only : find_rest, rest_t
   use camroller_joints, only : has_curves
   use camroller_kinematics, only : position_t
   use camroller_lash_adjuster, only : chamber_volume, relative_volume
   use camroller_lift, only : resolving_angles
   use camroller_model, only : model_t
   use camroller_pivot, only : pivot_force
   use camroller_roots, only : bracket_t, narrow_bracket, root_found, root_wanted, start_bracket
   use camroller_state, only : evaluate_loading
   use camroller_torque, only : normal_direction
   use camroller_train_outlook, only : find_modes, follow_oscillator, outlook_t
   implicit none
   private

   public :: train_load_t, train_change_t, estimate_train, compare_trains

   !> Smallest load over the largest one with the valve open, below which contact may be lost [-]
   real(wp), parameter :: smallest_load = 1.0e-2_wp

   !> A train round the cycle
   type :: train_load_t
      !> Why nothing can be said; not allocated where something can
      character(len=:), allocatable :: trouble
      !> At even angles: load and amplitude of the vibration about its mean course [N]; way of the roller off the rigid train over
      !> its distance from the cam's centre [-]; arm of the load about the pivot [m]
      real(wp), dimension(:), allocatable :: load, vibration, shift, arm
      !> Mean torque of the losses by vibration; of seat, spring, leak and check valve together [N m]
      real(wp) :: vibration_loss = 0.0_wp, other_loss = 0.0_wp
      !> Train frequency [Hz], largest force of the spring's modes [N], deepest place of the plunger below that at rest [m]
      real(wp) :: frequency = 0.0_wp, surge = 0.0_wp, sink = 0.0_wp
   end type train_load_t

   !> Difference of two trains at the angles of a survey
   type :: train_change_t
      !> Moments about the pivot by which the load differs in the part of the cycle about each angle: mean and largest [N m]
      real(wp) :: mean(points), largest(points)
      !> Mean torque of losses [N m]
      real(wp) :: loss
      !> Mean difference of the load in the cycle, over the mean load [-]
      real(wp) :: share
   end type train_change_t

   !> What the balance of a bent train at one angle is made of
   type :: balance_t
      type(position_t) :: position
      !> Force of the gas and of the valve's inertia on the valve [N], moment of the finger's inertia [N m]
      real(wp) :: gas, inertia, finger
      !> Direction of the load [-], lift over the way of the plunger [-]
      real(wp) :: normal(2), lever
      !> Approach of cam and roller at rest [m]
      real(wp) :: rest_approach
      !> Oil in the adjuster's chamber, as its volume at ambient pressure [m^3]
      real(wp) :: oil = 0.0_wp
      !> Load, force at the pad, force on the pivot [N]; place of the plunger from that at rest [m], pressure [Pa]
      real(wp) :: load, tip, axial, plunger = 0.0_wp, pressure = 0.0_wp
   end type balance_t

contains

   !> Estimate a train.
   subroutine estimate_train(model, train)
      !> The model
      type(model_t), intent(in) :: model
      !> What is found
      type(train_load_t), intent(out) :: train

      type(moments_t) :: moments
      type(position_t) :: position
      type(outlook_t) :: outlook
      ! Lift of the valve [m], acceleration of the rigid lift [m/s^2], force on the adjuster over that at rest [-]; gas force [N]
      real(wp), dimension(resolving_angles(model%lift_law)) :: lift, acceleration, press_ratio
      real(wp) :: force
      integer :: i, status

      allocate (train%load(size(lift)), train%vibration(size(lift)), train%shift(size(lift)), train%arm(size(lift)), &
         & source=0.0_wp)
      do i = 1, size(lift)
         call evaluate_loading(model, angle_of(i, size(lift)), position, force, moments, status)
         if (status /= 0) then
            train%trouble = "the finger does not reach the lift"
            return
         end if
         train%load(i) = moments%total/position%normal_arm
         train%arm(i) = position%normal_arm
         lift(i) = position%lift
         acceleration(i) = model%speed**2*position%lift_curvature
      end do
      if (.not. allocated(model%flexible)) return
      if (model%flexible%lash > 0.0_wp) then
         train%trouble = "the load of a train with lash on its base circle is not that of a rigid one"
         return
      end if
      if (allocated(model%joints)) then
         if (has_curves(model%joints)) then
            train%trouble = "friction that falls with speed at tip, guide or pivot may shake the train"
            return
         end if
      end if
      call find_modes(model, outlook)
      if (.not. outlook%load_shape**2 > 0.0_wp) then
         train%trouble = "the train has no natural frequency"
         return
      end if
      train%frequency = outlook%frequencies(1)/two_pi
      call bend(model, outlook, train, lift, press_ratio)
      if (allocated(train%trouble)) return
      call vibrate(model, outlook, lift, train)
      if (minval(train%load - train%vibration, mask=lift > 0.0_wp) < smallest_load*maxval(train%load)) then
         train%trouble = "cam and roller part, or nearly so"
      else if (allocated(model%flexible%adjuster)) then
         if (any(lift > 0.0_wp .and. press_ratio*(train%load - train%vibration) <= train%load)) train%trouble = &
            & "the lash adjuster pumps up, or nearly so"
      end if
      if (allocated(train%trouble)) return
      if (model%flexible%modes%count > 0) call surge(model, outlook, acceleration, lift, train)
   end subroutine estimate_train

   !> Cam angle of a point.
   elemental function angle_of(point, fine) result(angle)
      !> Its number, number of points
      integer, intent(in) :: point, fine
      !> From full lift [rad]
      real(wp) :: angle

      angle = two_pi*real(point - 1, wp)/fine - pi
   end function angle_of

   !> Load of the train that bends under its load, leaks and is filled again; losses at seat, leak and check valve.
   subroutine bend(model, outlook, train, lift, press_ratio)
      type(model_t), intent(in) :: model
      !> Its modes
      type(outlook_t), intent(in) :: outlook
      !> Gets load, shift, sink, losses
      type(train_load_t), intent(inout) :: train
      !> Lift of the valve; in: of the rigid train [m]
      real(wp), intent(inout) :: lift(:)
      !> Force on the adjuster over that at rest; zero without one [-]
      real(wp), intent(out) :: press_ratio(:)

      type(rest_t) :: rest
      type(balance_t) :: balance
      type(error_t), allocatable :: error
      ! Oil at rest [m^3]; time of a step [s]; works in a turn: seat, damping of the approach, leak [J]; load and force at the pad
      ! before [N]; rigid lift, lift before [m]
      real(wp) :: full, step, seat, approach, leak, before(2), rigid, lift_before
      integer :: i

      call find_rest(model%flexible, model%linkage, model%train, model%base_circle_load, rest, error)
      if (allocated(error)) then
         train%trouble = error%message
         return
      end if
      step = two_pi/(size(lift)*model%speed)
      seat = 0.0_wp
      approach = 0.0_wp
      leak = 0.0_wp
      press_ratio = 0.0_wp
      if (allocated(model%flexible%adjuster)) then
         associate (adjuster => model%flexible%adjuster)
            full = chamber_volume(adjuster, rest%pivot)/relative_volume(adjuster%given, adjuster%given%supply_pressure)
         end associate
         balance%oil = full
      end if
      before = [model%base_circle_load, rest%tip_force]
      lift_before = 0.0_wp
      do i = 1, size(lift)
         call start_balance(model, angle_of(i, size(lift)), balance)
         rigid = lift(i)
         call find_balance(model, rest, balance, lift(i), train%trouble)
         if (allocated(train%trouble)) return
         if (allocated(model%flexible%adjuster)) then
            ! At the force that it has at rest the adjuster is filled
            if (balance%axial <= rest%axial_force .and. balance%oil < full) then
               balance%oil = full
               call find_balance(model, rest, balance, lift(i), train%trouble)
               if (allocated(train%trouble)) return
            end if
            press_ratio(i) = balance%axial/rest%axial_force
            train%sink = max(train%sink, -balance%plunger)
            call let_leak(model, step, balance, leak)
         end if
         train%load(i) = balance%load
         train%shift(i) = abs(rigid - lift(i))*balance%position%normal_arm/(balance%position%valve_arm &
            & *abs(balance%position%surface_travel))
         associate (flexible => model%flexible)
            approach = approach + (flexible%contact_damping*balance%load*((balance%load - before(1))/outlook%contact_stiffness)**2 &
               & + flexible%pad_damping*balance%tip*((balance%tip - before(2))/flexible%pad_stiffness)**2)/step
         end associate
         before = [balance%load, balance%tip]
         if (lift(i)*lift_before < 0.0_wp) seat = seat + 0.5_wp*model%train%valve_mass*((lift(i) - lift_before)/step)**2
         lift_before = lift(i)
      end do
      train%other_loss = (seat + approach + leak)/two_pi
   end subroutine bend

   !> Let oil leak out of the adjuster's chamber; what leaks comes back through the check valve.
   subroutine let_leak(model, step, balance, work)
      type(model_t), intent(in) :: model
      !> Time [s]
      real(wp), intent(in) :: step
      !> The balance; its oil becomes less
      type(balance_t), intent(inout) :: balance
      !> Work lost in leak and check valve so far [J]
      real(wp), intent(inout) :: work

      ! Pressure over that at the leak's end [Pa], volume that leaks [m^3]
      real(wp) :: over, volume

      associate (adjuster => model%flexible%adjuster, given => model%flexible%adjuster%given)
         over = max(0.0_wp, balance%pressure - adjuster%end_pressure)
         volume = adjuster%conductance*over*step
         work = work + volume*(over + given%crack_pressure + given%full_pressure)
         balance%oil = balance%oil - volume/relative_volume(given, balance%pressure)
      end associate
   end subroutine let_leak

   !> What the balance at an angle is made of; the oil stays.
   subroutine start_balance(model, angle, balance)
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      type(balance_t), intent(inout) :: balance

      type(moments_t) :: moments
      ! Direction of the cam's surface [-]
      real(wp) :: tangent(2)
      integer :: status

      call evaluate_loading(model, angle, balance%position, balance%gas, moments, status)
      associate (position => balance%position, flexible => model%flexible)
         balance%inertia = moments%valve/position%valve_arm
         balance%finger = moments%finger
         call normal_direction(position%normal_arm, position%tangent_arm, model%linkage%a, position%arm_angle, &
            & model%linkage%sense, balance%normal, tangent)
         balance%lever = position%valve_arm/position%normal_arm*(balance%normal(1)*real(flexible%axis, wp) &
            & + balance%normal(2)*aimag(flexible%axis)) + flexible%tilt_cosine
         balance%rest_approach = approach_of(flexible, model%base_circle_load)
      end associate
   end subroutine start_balance

   !> Approach of cam and roller with the finger's bending.
   pure function approach_of(flexible, load) result(approach)
      !> The train
      type(flexible_t), intent(in) :: flexible
      !> Load [N]
      real(wp), intent(in) :: load
      !> Approach [m]
      real(wp) :: approach

      approach = series_approach(flexible%compliance, flexible%finger_stiffness, load)
   end function approach_of

   !> Lift of the bent train: the lift that its forces make is the lift that leaves these forces.
   subroutine find_balance(model, rest, balance, lift, trouble)
      type(model_t), intent(in) :: model
      !> The train at rest
      type(rest_t), intent(in) :: rest
      !> The balance; gets its forces
      type(balance_t), intent(inout) :: balance
      !> Lift of the valve; in: any [m]
      real(wp), intent(inout) :: lift
      !> Set where there is none
      character(len=:), allocatable, intent(inout) :: trouble

      ! Ways from the rigid lift within which the balance is sought, its accuracy, over the roller's radius [-]
      real(wp), parameter :: below = 0.35_wp, above = 0.12_wp, accuracy = 1.0e-9_wp
      type(bracket_t) :: bracket
      ! Lift over that which its forces leave, at both ends and at a trial [m]
      real(wp) :: ways(3)

      associate (rigid => balance%position%lift, radius => model%roller_radius)
         call try_lift(rigid - below*radius, ways(1))
         call try_lift(rigid + above*radius, ways(2))
         call start_bracket(bracket, rigid - below*radius, rigid + above*radius, ways(1), ways(2), accuracy*radius)
      end associate
      do while (bracket%status == root_wanted)
         call try_lift(bracket%trial, ways(3))
         call narrow_bracket(bracket, ways(3))
      end do
      if (bracket%status /= root_found) then
         trouble = "the train bends by millimetres"
         return
      end if
      lift = bracket%trial
      call try_lift(lift, ways(3))

   contains

      !> Forces at a lift, and how far it is above the lift that they leave.
      subroutine try_lift(trial, way)
         !> Lift [m]
         real(wp), intent(in) :: trial
         !> Difference [m]
         real(wp), intent(out) :: way

         ! Part of the valve's inertia that does not rest on the seat [-]
         real(wp) :: part

         associate (position => balance%position, flexible => model%flexible)
            part = 1.0_wp
            if (trial < 0.0_wp) part = max(0.0_wp, 1.0_wp + flexible%seat_stiffness*trial/model%train%closed_seat_force)
            balance%tip = max(0.0_wp, model%train%stiffness*(trial + model%train%precompression) + balance%gas &
               & + part*balance%inertia - flexible%seat_stiffness*max(0.0_wp, -trial))
            balance%load = max(0.0_wp, (balance%tip*position%valve_arm + balance%finger)/position%normal_arm)
            if (allocated(flexible%adjuster)) call press(model, rest, balance)
            way = trial - (rest%lift + position%lift - (approach_of(flexible, balance%load) - balance%rest_approach) &
               & *position%valve_arm/position%normal_arm - (balance%tip - rest%tip_force)/flexible%pad_stiffness &
               & - balance%lever*balance%plunger)
         end associate
      end subroutine try_lift

   end subroutine find_balance

   !> Press the plunger down onto its oil, under the force of the pivot.
   pure subroutine press(model, rest, balance)
      type(model_t), intent(in) :: model
      !> The train at rest
      type(rest_t), intent(in) :: rest
      !> In: load and force at the pad; out: with force on the pivot, pressure, place of the plunger
      type(balance_t), intent(inout) :: balance

      associate (position => balance%position, adjuster => model%flexible%adjuster)
         balance%axial = pivot_force(model%pivot, balance%load, balance%normal, balance%tip, position%arm_angle, &
            & position%finger_slope, position%finger_curvature, model%speed)
         balance%pressure = max(0.0_wp, (balance%axial - adjuster%spring_force + adjuster%given%spring_stiffness*rest%pivot) &
            & /adjuster%area)
         balance%plunger = (balance%oil*relative_volume(adjuster%given, balance%pressure) - adjuster%given%volume)/adjuster%area &
            & - rest%pivot
      end associate
   end subroutine press

   !> Let the load drive the lowest mode of the train.
   subroutine vibrate(model, outlook, lift, train)
      type(model_t), intent(in) :: model
      !> Its modes
      type(outlook_t), intent(in) :: outlook
      !> Lift of the valve [m]
      real(wp), intent(in) :: lift(:)
      !> In: load of the bent train; out: with its vibration
      type(train_load_t), intent(inout) :: train

      ! Load that vibrates and its rate [N], [N/s], rate of the load that drives it [N/s], amplitude [N]; time of a step [s]
      real(wp), dimension(size(lift)) :: load, rate, drive, amplitude
      real(wp) :: step

      step = two_pi/(size(lift)*model%speed)
      associate (pulse => outlook%frequencies(1), driving => train%load)
         call follow_oscillator(pulse**2*driving, pulse, outlook%damping_ratio, step, load, rate)
         drive = (cshift(driving, 1) - driving)/step
         amplitude = sqrt((load - driving)**2 + ((rate - drive)/pulse)**2)
         ! The closed valve rests on its seat, and its mass with it
         where (lift <= 0.0_wp) amplitude = min(amplitude, driving)
         train%vibration_loss = outlook%damping_ratio*pulse**3*sum(amplitude**2)/(size(lift)*outlook%load_shape**2*model%speed) &
            & + 0.5_wp*model%train%valve_mass*(pulse*outlook%lift_shape/outlook%load_shape)**2 &
            & *sum(amplitude**2, mask=lift*cshift(lift, 1) < 0.0_wp)/two_pi
         where (lift > 0.0_wp) driving = load
         train%vibration = amplitude
      end associate
   end subroutine vibrate

   !> Let the rigid lift drive the modes of the spring, and them the train.
   subroutine surge(model, outlook, acceleration, lift, train)
      type(model_t), intent(in) :: model
      !> Its modes
      type(outlook_t), intent(in) :: outlook
      !> Acceleration of the rigid lift [m/s^2], lift of the valve [m]
      real(wp), intent(in) :: acceleration(:), lift(:)
      !> Gets more vibration and losses
      type(train_load_t), intent(inout) :: train

      ! Amplitude of a mode at the angles [m], its rate [m/s], what drives it [m/s^2], force of all modes on the valve [N]
      real(wp), dimension(size(lift)) :: mode, rate, drive, force
      ! Frequency of the mode over the train's [-], force on the valve, as the train amplifies it, over what drives the mode [kg];
      ! time of a step [s]
      real(wp) :: ratio, factor, step
      integer :: n

      step = two_pi/(size(lift)*model%speed)
      force = 0.0_wp
      associate (modes => model%flexible%modes)
         do n = 1, modes%count
            drive = -2.0_wp*modes%share(n)*acceleration
            call follow_oscillator(drive, modes%frequency(n), modes%damping_ratio, step, mode, rate)
            train%other_loss = train%other_loss + modes%mass*modes%damping_ratio*modes%frequency(n)*sum(rate**2)/size(lift) &
               & /model%speed
            ratio = modes%frequency(n)/outlook%frequencies(1)
            factor = modes%mass*abs(modes%share(n))/sqrt((1.0_wp - ratio**2)**2 + (2.0_wp*outlook%damping_ratio*ratio)**2)
            force = force + factor*sqrt((modes%frequency(n)**2*mode - drive)**2 + (modes%frequency(n)*rate)**2)
         end do
      end associate
      train%surge = maxval(force)
      where (lift > 0.0_wp) train%vibration = train%vibration + force*train%load &
         & /max(model%train%stiffness*(lift + model%train%precompression), tiny(1.0_wp))
   end subroutine surge

   !> Difference of two trains. Vibrations of unlike frequency do not cancel; in the mean over what an angle stands for they change
   !> what follows the load by their square.
   pure subroutine compare_trains(train, other, grid, change)
      !> The trains, of the same lift
      type(train_load_t), intent(in) :: train, other
      !> Angles of the survey
      type(grid_t), intent(in) :: grid
      !> Their difference
      type(train_change_t), intent(out) :: change

      ! Differences of the loads, of their mean effect beside, of their peaks [N]; half the angle that one of the survey stands for
      ! and distance from it [rad]
      real(wp), dimension(size(train%load)) :: difference, beside, peak
      real(wp) :: half
      logical :: belongs(size(train%load))
      integer :: i, k, nearest, fine

      fine = size(train%load)
      difference = train%load - other%load
      beside = (train%vibration**2 + other%vibration**2)/max(train%load, tiny(1.0_wp)) &
         & + train%load*abs(train%shift - other%shift)
      peak = abs(difference) + train%vibration + other%vibration
      change%share = 0.0_wp
      do i = 1, points
         half = pi*grid%weights(i)
         belongs = [(abs(modulo(angle_of(k, fine) - grid%angles(i) + pi, two_pi) - pi) <= half, k=1, fine)]
         nearest = modulo(nint((grid%angles(i) + pi)/two_pi*fine), fine) + 1
         belongs(nearest) = .true.
         associate (mean => (abs(sum(difference, mask=belongs)) + sum(beside, mask=belongs))/count(belongs))
            change%mean(i) = mean*train%arm(nearest)
            change%share = change%share + grid%weights(i)*mean
         end associate
         change%largest(i) = maxval(peak, mask=belongs)*train%arm(nearest)
      end do
      change%share = change%share/(sum(train%load)/fine)
      change%loss = train%vibration_loss + other%vibration_loss + abs(train%other_loss - other%other_loss)
   end subroutine compare_trains

end module camroller_effect_train
