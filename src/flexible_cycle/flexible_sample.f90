!> What a state of a turn of a flexible train has for the measures of the turn.
!>
!> In: a model, a state. Out: everything there; the quantities whose extremes are measures, and what opens and closes.
module camroller_flexible_sample
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_flexible_measure_list, only : measures, largest_load, smallest_event_load, event_pivot_force, &
      & least_lift_error, bounce_height, smallest_pivot_force, surge_force, coil_ratio, coil_compression, lowest_plunger, &
      & highest_plunger, largest_chamber_pressure, smallest_lift, closed_load, most_lift_error, event_part
   use camroller_flexible_geometry, only : dot
   use camroller_flexible_train, only : flexible_state_t, resolution_t, evaluate_train, first_mode, at_finger_rate, at_lift
   use camroller_kinds, only : wp, pi
   use camroller_kinematics, only : position_t
   use camroller_lash_adjuster, only : lash_adjuster_t, opening_pressure
   use camroller_lift, only : is_at_rest, is_tabulated
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_spring_modes, only : most_waves, wave_compression
   implicit none
   private

   public :: sample_t, look, is_closed, pivot_force, relieved_part

   !> Part of the largest lift below which a table's noise may be all that rises [-]
   real(wp), parameter :: noise_part = 1.0e-3_wp
   !> Part of a plunger's travel above its lower stop in which it counts as on it: it may tremble and bounce there [-]
   real(wp), parameter :: low_part = 0.05_wp

   !> What is kept of a point for the next ones
   type :: sample_t
      !> Cam angle; huge before the first point [rad]
      real(wp) :: angle = huge(1.0_wp)
      !> Rigid lift less that above which a load counts as one of the event [m], contact load [N]
      real(wp) :: height = -1.0_wp, load = 0.0_wp
      !> Force in the joint [N]; pressure above that at which the check valve opens [Pa]
      real(wp) :: joint = 0.0_wp, shut = 0.0_wp
      !> Do cam and roller touch? Does the rigid lift rise, above what is none of it? Is it at rest, or what of it may be noise of a
      !> table? Is the plunger on its lower stop?
      logical :: touches = .false., is_rising = .false., is_closed = .false., is_low = .false.
      !> Has the valve met its seat after the event?
      logical :: has_met = .false.
      !> What the measures that are extremes are extremes of, by number; zero for others [unit of the measure]
      real(wp) :: extremes(size(measures)) = 0.0_wp
   end type sample_t

contains

   !> Evaluate a state, and what the measures that are extremes are extremes of.
   subroutine look(model, angle, state, resolution, top, now, position, sample, error)
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> State there [state]
      real(wp), intent(in) :: state(:)
      !> What the integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Largest lift of the rigid train [m]
      real(wp), intent(in) :: top
      !> Everything there, and the rigid train
      type(flexible_state_t), intent(out) :: now
      type(position_t), intent(out) :: position
      !> What is kept of the point
      type(sample_t), intent(out) :: sample
      !> Convergence error where the state cannot be evaluated
      type(error_t), allocatable, intent(out) :: error

      integer :: status

      call evaluate_train(model, angle, state, resolution, now, status)
      if (status == 0) call evaluate_geometry(model, angle, position, status)
      if (status /= 0) then
         call raise(error, kind_convergence, "a state between the steps of the flexible train cannot be evaluated")
         return
      end if
      sample%angle = angle
      sample%height = position%lift - event_part*top
      sample%load = now%contact%load
      sample%joint = pivot_force(model, state, now)
      sample%touches = now%contact%is_touching
      sample%is_rising = position%lift_slope > 0.0_wp .and. position%lift > noise_part*top
      sample%is_closed = is_closed(model, angle, position%lift, top)
      associate (sought => sample%extremes, lift => state(at_lift))
         sought([largest_load, smallest_event_load, closed_load]) = sample%load
         sought([smallest_pivot_force, event_pivot_force]) = sample%joint
         sought([least_lift_error, most_lift_error]) = lift - position%lift
         sought([smallest_lift, bounce_height]) = lift
         call look_at_spring(model, state, sought)
         if (.not. allocated(model%flexible%adjuster)) return
         sample%shut = now%pressure - opening_pressure(model%flexible%adjuster)
         sample%is_low = is_on_stop(model%flexible%adjuster%given, now%pivot)
         sought([lowest_plunger, highest_plunger]) = now%pivot
         sought(largest_chamber_pressure) = now%pressure
      end associate
   end subroutine look

   !> Is the rigid train's valve closed, but for what may be noise of a table?
   pure function is_closed(model, angle, lift, top)
      type(model_t), intent(in) :: model
      !> Cam angle [rad]; lift of the rigid train there, and its largest [m]
      real(wp), intent(in) :: angle, lift, top
      logical :: is_closed

      is_closed = is_at_rest(model%lift_law, angle) .or. (is_tabulated(model%lift_law) .and. lift <= noise_part*top)
   end function is_closed

   !> Is a plunger on its lower stop?
   pure function is_on_stop(given, place) result(is_low)
      type(lash_adjuster_t), intent(in) :: given
      !> Place of the plunger [m]
      real(wp), intent(in) :: place
      logical :: is_low

      is_low = place <= given%lowest + low_part*(given%highest - given%lowest)
   end function is_on_stop

   !> Force of the spring's first mode, and what its waves take from coils.
   pure subroutine look_at_spring(model, state, sought)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> By number of the measure [unit of the measure]
      real(wp), intent(inout) :: sought(:)

      integer :: first

      if (model%flexible%modes%count == 0) then
         sought(coil_compression) = state(at_lift) + model%train%precompression
         return
      end if
      first = first_mode(model)
      call compress_coils(model, state(at_lift), state(first:first + 2*model%flexible%modes%count - 2:2), sought(coil_ratio), &
         & sought(coil_compression))
      sought(surge_force) = model%train%stiffness*pi*abs(state(first))
   end subroutine look_at_spring

   !> What waves take from the compression of the spring's coils, and what they add to it.
   pure subroutine compress_coils(model, lift, amplitudes, ratio, most)
      !> The model, with modes of the spring
      type(model_t), intent(in) :: model
      !> Lift of the valve, amplitudes of the modes [m]
      real(wp), intent(in) :: lift, amplitudes(:)
      !> Largest part of the spring's compression that waves take from coils [-]
      real(wp), intent(out) :: ratio
      !> Largest compression of a part of the spring, as of all of it [m]
      real(wp), intent(out) :: most

      ! Compression of the whole spring; what waves add to it, at least and at most [m]
      real(wp) :: compression, added(2)

      compression = lift + model%train%precompression
      added = wave_compression(model%flexible%modes, amplitudes)
      ratio = -added(1)/compression
      most = max(compression, compression + added(2))
   end subroutine compress_coils

   !> Largest part of the spring's compression that waves take from coils; 0 where all modes together do not take all of it, which
   !> is known at once.
   pure function relieved_part(model, lift, amplitudes) result(part)
      !> The model, with modes of the spring
      type(model_t), intent(in) :: model
      !> Lift of the valve, amplitudes of the modes [m]
      real(wp), intent(in) :: lift, amplitudes(:)
      !> The part [-]
      real(wp) :: part

      real(wp) :: unused ! [m]

      part = 0.0_wp
      if (most_waves(model%flexible%modes, amplitudes) <= lift + model%train%precompression) return
      call compress_coils(model, lift, amplitudes, part, unused)
   end function relieved_part

   !> Force in the joint of finger and pivot along the adjuster's axis; negative where the socket would open.
   pure function pivot_force(model, state, now) result(force)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The force [N]
      real(wp) :: force

      associate (flexible => model%flexible, touch => now%touch)
         if (allocated(flexible%adjuster)) then
            force = now%hydraulic_force + now%stops(1)%force - now%stops(2)%force &
               & - flexible%adjuster%given%plunger_mass*now%pivot_acceleration
         else
            force = -dot(flexible%axis, now%contact%load*touch%normal &
               & - now%contact%tangential_force*touch%forward) - flexible%tilt_cosine*now%pad%force &
               & + flexible%tilt_sine*now%tip_friction &
               & + flexible%finger_mass*(now%centre_slope*now%finger_acceleration + now%centre_curvature*state(at_finger_rate)**2)
         end if
      end associate
   end function pivot_force

end module camroller_flexible_sample
