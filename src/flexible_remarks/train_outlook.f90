!> What a train's vibration will amount to, estimated before it is integrated.
!>
!> In: a model, rigid or flexible. Out: its lowest natural frequency with the valve at full lift, the largest load over that of the
!> rigid train, the force of the spring's surge. The train is linear there, with a massless spring and the check valve shut; the
!> rigid load drives its lowest mode, the rigid lift the modes of the spring, each as an oscillator with exact steps. A rigid train
!> takes stiffness and damping that are usual for its size. Sources: Koster, Vibrations of Cam Mechanisms (1974), for the
!> residual vibration behind a cam; Wahl, Mechanical Springs (1963), for surge.
module camroller_train_outlook
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_axial_setup, only : nose_length
   use camroller_contact_compliance, only : series_approach, series_load
   use camroller_dynamics, only : evaluate_moments, moments_t
   use camroller_error, only : error_t
   use camroller_flexible_parts, only : flexible_t, set_contacts, usual_dynamics
   use camroller_flexible_setup, only : find_rest, rest_t
   use camroller_kinematics, only : position_t
   use camroller_lapack, only : dsygv
   use camroller_lash_adjuster, only : bulk_modulus, chamber_volume, relative_volume
   use camroller_lift, only : is_at_rest, resolving_angles
   use camroller_model, only : evaluate_geometry, model_t
   use camroller_state, only : evaluate_loading
   use camroller_torque, only : normal_direction
   implicit none
   private

   public :: outlook_t, find_outlook, find_modes, follow_oscillator, gas_share, largest_response

   !> The estimates
   type :: outlook_t
      !> Are masses of valve and finger known?
      logical :: is_known = .false.
      !> Natural angular frequencies at full lift, in rising order, as many as the train has; zero where nothing holds it [rad/s]
      real(wp), allocatable :: frequencies(:)
      !> Damping ratio of the lowest [-]
      real(wp) :: damping_ratio = 0.0_wp
      !> Change of the contact load and of the lift with its coordinate, half the square of whose rate is its energy [N/(m kg^0.5)],
      !> [1/kg^0.5]
      real(wp) :: load_shape = 0.0_wp, lift_shape = 0.0_wp
      !> Stiffness of cam, roller and finger there [N/m]
      real(wp) :: contact_stiffness = 0.0_wp
      !> Largest load over that of the rigid train [-]
      real(wp) :: load_factor = 1.0_wp
      !> Largest force of the spring's modes, `k n pi q_n` [N]
      real(wp), allocatable :: surge(:)
   end type outlook_t

   !> Damping ratios between which an oscillator is followed: without damping its response at resonance has no bound, and where it
   !> does not vibrate it creeps no slower than at the limit; a spring of one wire has 0.003 [-]
   real(wp), parameter :: least_ratio = 1.0e-3_wp, most_ratio = 0.999_wp
   !> Places of finger, valve and plunger in the linear train
   integer, parameter :: finger = 1, valve = 2, plunger = 3

contains

   !> Estimates for a model.
   subroutine find_outlook(model, outlook)
      !> The model
      type(model_t), intent(in) :: model
      !> The estimates
      type(outlook_t), intent(out) :: outlook

      type(position_t) :: position
      type(moments_t) :: moments
      ! At even angles: load of the rigid train [N], second derivative of its lift over time [m/s^2], gas force where the valve is
      ! closed [N]
      real(wp), allocatable :: load(:), lift(:), gas(:)
      ! Cam angle [rad], gas force, largest load of the rigid train [N]
      real(wp) :: angle, force, largest
      integer :: i, n, points, status
      ! Does the valve rest here, and did it at the angle before? Without gas force nothing changes then
      logical :: rests, rested

      allocate (outlook%frequencies(0), outlook%surge(0))
      outlook%is_known = allocated(model%pivot) .and. model%train%valve_mass > 0.0_wp
      if (.not. outlook%is_known) return
      call find_modes(model, outlook)
      if (.not. minval(outlook%frequencies) > 0.0_wp) return
      points = resolving_angles(model%lift_law)
      allocate (load(points), lift(points), gas(points))
      rests = .false.
      force = 0.0_wp
      do i = 1, points
         rested = rests
         angle = two_pi*real(i - 1, wp)/points - pi
         rests = is_at_rest(model%lift_law, angle)
         if (.not. (rests .and. rested) .or. allocated(model%gas)) call evaluate_loading(model, angle, position, force, moments, &
            & status, moments_only=.true.)
         if (status /= 0) return
         load(i) = moments%total/position%normal_arm
         lift(i) = model%speed**2*position%lift_curvature
         gas(i) = merge(force, 0.0_wp, rests)
      end do
      largest = maxval(load)
      if (maxval(gas) > 0.0_wp) load = load + gas*gas_share(model, maxval(gas))
      associate (step => two_pi/(points*model%speed), pulse => outlook%frequencies(1))
         outlook%load_factor = largest_response(pulse**2*load, pulse, outlook%damping_ratio, step, is_either_side=.false.)/largest
         if (.not. allocated(model%flexible)) return
         associate (modes => model%flexible%modes)
            outlook%surge = [(modes%stiffness*n*pi*largest_response(2.0_wp*modes%share(n)*lift, modes%frequency(n), &
               & modes%damping_ratio, step, is_either_side=.true.), n=1, modes%count)]
         end associate
      end associate
   end subroutine find_outlook

   !> Contact load that a gas force on the closed valve adds, over that force: it presses the valve into its seat, and its stem the
   !> finger onto the cam, or the plunger into its oil. Balance of the valve's lift, which both share, by halving.
   function gas_share(model, gas) result(share)
      !> The model
      type(model_t), intent(in) :: model
      !> The force, above 0 [N]
      real(wp), intent(in) :: gas
      !> The share [-]
      real(wp) :: share

      type(flexible_t) :: flexible
      type(rest_t) :: rest
      type(position_t) :: closed
      type(error_t), allocatable :: error
      ! Forces at the pad between which that of the balance is, and their middle [N]; normal and tangent [-]; lever of load and pad,
      ! load along the adjuster's axis over the load [-]
      real(wp) :: least, most, middle, normal(2), tangent(2), lever, along
      integer :: i, status

      share = 0.0_wp
      flexible = train_of(model)
      if (flexible%lash > 0.0_wp) return
      call find_rest(flexible, model%linkage, model%train, model%base_circle_load, rest, error)
      if (.not. allocated(error)) call evaluate_geometry(model, -pi, closed, status)
      if (allocated(error)) return
      if (status /= 0) return
      call normal_direction(closed%normal_arm, closed%tangent_arm, model%linkage%a, closed%arm_angle, model%linkage%sense, normal, &
         & tangent)
      lever = closed%valve_arm/closed%normal_arm
      along = normal(1)*real(flexible%axis, wp) + normal(2)*aimag(flexible%axis)
      least = rest%tip_force
      most = rest%tip_force + gas
      do i = 1, 40
         middle = 0.5_wp*(least + most)
         if (sunk(middle) < 0.0_wp) then
            least = middle
         else
            most = middle
         end if
      end do
      share = (middle - rest%tip_force)*lever/gas

   contains

      !> Lift of the valve with a force at the pad less the lift that the finger leaves it.
      function sunk(tip) result(way)
         !> The force [N]
         real(wp), intent(in) :: tip
         !> Difference [m]
         real(wp) :: way

         ! Way of the plunger [m], pressure [Pa]
         real(wp) :: plunger, pressure

         plunger = 0.0_wp
         if (allocated(flexible%adjuster)) then
            associate (adjuster => flexible%adjuster, given => flexible%adjuster%given)
               pressure = max(0.0_wp, given%supply_pressure - (along*lever + flexible%tilt_cosine)*(tip - rest%tip_force) &
                  & /adjuster%area)
               plunger = chamber_volume(adjuster, rest%pivot)/adjuster%area*(relative_volume(given, pressure) &
                  & /relative_volume(given, given%supply_pressure) - 1.0_wp)
            end associate
         end if
         way = (tip - rest%tip_force - gas)/(flexible%seat_stiffness + model%train%stiffness) &
            & + (tip - rest%tip_force)/flexible%pad_stiffness + (along*lever + flexible%tilt_cosine)*plunger &
            & + lever*(approach(tip*lever) - approach(model%base_circle_load))
      end function sunk

      !> Approach of cam and roller with the finger's bending.
      function approach(load) result(way)
         !> The load [N]
         real(wp), intent(in) :: load
         !> The approach [m]
         real(wp) :: way

         way = series_approach(flexible%compliance, flexible%finger_stiffness, load)
      end function approach

   end function gas_share

   !> The model's train where it is flexible, or one with a fixed pivot and contacts usual for its size.
   function train_of(model) result(flexible)
      !> The model, with a pivot
      type(model_t), intent(in) :: model
      !> Its train
      type(flexible_t) :: flexible

      if (allocated(model%flexible)) then
         flexible = model%flexible
         return
      end if
      call set_contacts(flexible, usual_dynamics(model%linkage%a), model%modulus, nose_length(model%contact_width, model%linkage, &
         & model%lift_law, model%train, model%axial))
      flexible%axis = exp(cmplx(0.0_wp, -model%pivot%axis_angle, wp))
      flexible%tilt_cosine = model%pivot%tilt_cosine
   end function train_of

   !> Natural frequencies of the linear train at full lift, and the damping ratio of the lowest.
   subroutine find_modes(model, outlook)
      !> The model, with the finger's mass
      type(model_t), intent(in) :: model
      !> Gets them
      type(outlook_t), intent(inout) :: outlook

      type(flexible_t) :: flexible
      type(position_t) :: position
      type(moments_t) :: moments
      ! Stiffness [N/m], mass [kg] and damping [N s/m] over the coordinates, with angles times 1 m; work space [any]
      real(wp) :: stiffness(3, 3), mass(3, 3), damping(3, 3), work(64), squares(3)
      ! Change of the approach of cam and roller and of the pad with the coordinates [m]; normal, tangent, adjuster's axis [-]
      real(wp) :: approach(3), pad(3), normal(2), tangent(2), axis(2)
      ! Contact load without inertia and the pad's [N]; centre of mass of the finger along the axis over gamma [m]
      real(wp) :: load, tip, centre
      ! Stiffness of cam, roller and finger [N/m]
      real(wp) :: contact_stiffness
      integer :: n, i, status

      flexible = train_of(model)
      n = merge(plunger, valve, allocated(flexible%adjuster))
      outlook%frequencies = spread(0.0_wp, 1, n)
      call evaluate_geometry(model, 0.0_wp, position, status)
      if (status /= 0) return
      call evaluate_moments(model%train, position, 0.0_wp, 0.0_wp, moments)
      load = moments%total/position%normal_arm
      tip = moments%total/position%valve_arm
      if (.not. load > 0.0_wp) return
      call normal_direction(position%normal_arm, position%tangent_arm, model%linkage%a, position%arm_angle, model%linkage%sense, &
         & normal, tangent)
      axis = [cos(model%pivot%axis_angle), -sin(model%pivot%axis_angle)]
      centre = -model%pivot%centre*sin(position%arm_angle + model%pivot%axis_angle)
      approach = [-position%normal_arm, 0.0_wp, -dot_product(normal, axis)]
      pad = [position%valve_arm, -1.0_wp, -cos(model%pivot%tilt)]

      call series_load(flexible%compliance, flexible%finger_stiffness, series_approach(flexible%compliance, &
         & flexible%finger_stiffness, load), load, contact_stiffness)
      stiffness = contact_stiffness*outer(approach) + flexible%pad_stiffness*outer(pad)
      stiffness(valve, valve) = stiffness(valve, valve) + model%train%stiffness
      damping = flexible%contact_damping*load*outer(approach) + flexible%pad_damping*tip*outer(pad)
      mass = 0.0_wp
      mass(finger, finger) = model%train%finger_inertia
      mass(valve, valve) = model%train%valve_mass
      if (allocated(flexible%adjuster)) then
         mass(finger, plunger) = model%pivot%mass*centre
         mass(plunger, finger) = mass(finger, plunger)
         mass(plunger, plunger) = model%pivot%mass + flexible%adjuster%given%plunger_mass
         stiffness(plunger, plunger) = stiffness(plunger, plunger) + oil_stiffness(-load*dot_product(normal, axis) &
            & - cos(model%pivot%tilt)*tip)
         damping(plunger, plunger) = damping(plunger, plunger) + flexible%adjuster%drag
      end if
      call dsygv(1, "V", "U", n, stiffness, 3, mass, 3, squares, work, size(work), status)
      if (status /= 0 .or. .not. squares(1) > 0.0_wp) return
      outlook%frequencies = [(sqrt(squares(i)), i=1, n)]
      outlook%contact_stiffness = contact_stiffness
      associate (shape => stiffness(:n, 1))
         outlook%damping_ratio = dot_product(shape, matmul(damping(:n, :n), shape))/(2.0_wp*outlook%frequencies(1))
         outlook%load_shape = contact_stiffness*dot_product(approach(:n), shape)
         outlook%lift_shape = shape(valve)
      end associate

   contains

      !> Stiffness of plunger spring and chamber under a force.
      function oil_stiffness(force) result(stiff)
         !> Force of the joint [N]
         real(wp), intent(in) :: force
         !> The stiffness [N/m]
         real(wp) :: stiff

         ! Bulk modulus [Pa], its slope over the pressure [-]
         real(wp) :: modulus, slope

         associate (adjuster => flexible%adjuster)
            call bulk_modulus(adjuster%given, max(0.0_wp, (force - adjuster%spring_force)/adjuster%area), modulus, slope)
            stiff = adjuster%given%spring_stiffness + modulus*adjuster%area**2/chamber_volume(adjuster, flexible%pivot_place)
         end associate
      end function oil_stiffness

   end subroutine find_modes

   !> Matrix of the products of a vector's components.
   pure function outer(vector) result(matrix)
      !> The vector [any]
      real(wp), intent(in) :: vector(:)
      !> The matrix [any]
      real(wp) :: matrix(size(vector), size(vector))

      matrix = spread(vector, 2, size(vector))*spread(vector, 1, size(vector))
   end function outer

   !> Largest displacement of an oscillator under a force that repeats itself.
   pure function largest_response(force, frequency, damping_ratio, step, is_either_side) result(largest)
      !> f at the ends of the steps [any/s^2]
      real(wp), intent(in) :: force(:)
      !> omega [rad/s], zeta below 1 [-], time between two points [s]
      real(wp), intent(in) :: frequency, damping_ratio, step
      !> Do displacements below zero count as well?
      logical, intent(in) :: is_either_side
      !> Largest x [any]
      real(wp) :: largest

      ! Displacements and rates at the points [any], [any/s]
      real(wp) :: displacement(size(force)), rate(size(force))

      call follow_oscillator(force, frequency, damping_ratio, step, displacement, rate)
      if (is_either_side) displacement = abs(displacement)
      largest = maxval(displacement)
   end function largest_response

   !> Motion of an oscillator, `x'' + 2 zeta omega x' + omega^2 x = f`, under a force that repeats itself, linear between its
   !> points: steps are exact, and the start is the one that the cycle comes back to.
   pure subroutine follow_oscillator(force, frequency, damping_ratio, step, displacement, rate)
      !> f at the ends of the steps [any/s^2]
      real(wp), intent(in) :: force(:)
      !> omega [rad/s], zeta, taken within `least_ratio` and `most_ratio` [-], time between two points [s]
      real(wp), intent(in) :: frequency, damping_ratio, step
      !> x [any] and its rate [any/s] at the same points
      real(wp), intent(out) :: displacement(:), rate(:)

      ! The root p = -zeta omega + i omega_d and its exponential, integrals over a step, the state z = x' - conj(p) x with
      ! z' = p z + f and x = Im(z)/omega_d [any]
      complex(wp) :: pole, factor, by_start, by_slope, state
      ! omega_d [rad/s], zeta in use [-]
      real(wp) :: damped, ratio
      integer :: pass, i, next

      ratio = min(max(damping_ratio, least_ratio), most_ratio)
      damped = frequency*sqrt(1.0_wp - ratio**2)
      pole = cmplx(-ratio*frequency, damped, wp)
      factor = exp(pole*step)
      ! Integrals of exp(p (h - s)) and of the same times s/h over the step
      by_start = (factor - 1.0_wp)/pole
      by_slope = (by_start/step - 1.0_wp)/pole
      state = (0.0_wp, 0.0_wp)
      do pass = 1, 2
         do i = 1, size(force)
            next = modulo(i, size(force)) + 1
            state = factor*state + by_start*force(i) + by_slope*(force(next) - force(i))
            displacement(next) = aimag(state)/damped
            rate(next) = real(state + conjg(pole)*displacement(next), wp)
         end do
         if (pass == 1) state = state/(1.0_wp - exp(pole*step*size(force)))
      end do
   end subroutine follow_oscillator

end module camroller_train_outlook
