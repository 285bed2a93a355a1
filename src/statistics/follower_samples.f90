!> What is sampled of a cycle: series and torques of a follower.
!>
!> In: case, model, cycle, then angles. Out: values to be integrated, and the extremes found on the way. The torque against
!> spring, seat and inertia and the one that spins the roller up are left out of what is integrated: their integrals are differences
!> of stored energy, which `stored_work` takes.
module camroller_follower_samples
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_state, only : state_t, flight_torque
   use camroller_cycle, only : cycle_t, state_at
   use camroller_catalogue, only : follower_values
   use camroller_torque_list, only : torque_count, of_geometric, of_roller_inertia
   use camroller_contact_forces, only : contact_t
   use camroller_findings, only : findings_t, note_findings
   use camroller_axial_table, only : slice_width
   use camroller_part_series, only : largest_pressure, thinnest_film
   use camroller_sampled_extremes, only : samples_t, add_sample, start_rows => start_samples
   use camroller_panels, only : sampled_t
   implicit none
   private

   public :: follower_samples_t, start_samples, sampled_values, entrainment_t, entrainment_of, extremes_t, widen, trail_t, &
      & contact_ahead, extend_trail

   !> One point of a cycle, for the search of standstills, of pure rolling, and of ends of the roller that begin to carry load
   type :: entrainment_t
      !> Cam angle from full lift [rad]
      real(wp) :: angle = 0.0_wp
      !> Mean surface speed, sliding speed [m/s]
      real(wp) :: entrainment_speed = 0.0_wp, sliding_speed = 0.0_wp
      logical :: is_touching = .false.
      !> How many ends of the roller carry load, where the case has its profile
      integer :: loaded_ends = 0
      !> Where the pressure along it is largest, from the middle in widths of a slice [-]
      real(wp) :: peak_slice = 0.0_wp
   end type entrainment_t

   !> Smallest and largest values of a follower at the points evaluated
   type :: extremes_t
      !> Normal load [N], torque that drives this follower [N m]
      real(wp) :: contact_load(2) = [huge(1.0_wp), -huge(1.0_wp)], torque_drive(2) = [huge(1.0_wp), -huge(1.0_wp)]
      !> Sliding speed [m/s]
      real(wp) :: sliding_speed(2) = [huge(1.0_wp), -huge(1.0_wp)]
      !> Largest pressure of the dry contact, anywhere along the roller [Pa]
      real(wp) :: hertz_pressure = 0.0_wp
      !> Smallest film along the roller where there is contact; huge where there is none [m]
      real(wp) :: film_min = huge(1.0_wp)
      !> What a host should know beside
      type(findings_t) :: findings
   end type extremes_t

   !> Contacts that were solved last, one behind the other, from which the next one is looked for
   type :: trail_t
      !> How many of them there are, none without contact
      integer :: count = 0
      !> Their cam angles, rising [rad]; tangential force [N], torque of the bearing [N m] and film ratio [-], shape (3, point)
      real(wp) :: angles(3), values(3, 3)
   end type trail_t

   !> A follower on its cycle
   type, extends(sampled_t) :: follower_samples_t
      !> The case; without it, torques are sampled and no series
      type(case_t), pointer :: case => null()
      type(model_t), pointer :: model => null()
      type(cycle_t), pointer :: cycle => null()
      !> Interval of the trajectory where the search starts
      integer :: hint = 1
      !> Number of series, and the first of them that is a torque
      integer :: series = 0, first_torque = 1
      !> State at the point that was sampled last
      type(state_t) :: state
      !> Contacts up to there
      type(trail_t) :: trail
      !> Series of the follower at the points evaluated
      type(samples_t) :: rows
      !> Largest magnitude of the sliding speed evaluated [m/s]
      real(wp) :: largest_sliding = 0.0_wp
      !> Extremes at the points evaluated, without a case
      type(extremes_t) :: extremes
   contains
      procedure :: sample
   end type follower_samples_t

contains

   !> Begin with a cycle; with the case, its series are sampled too.
   subroutine start_samples(samples, model, cycle, case, series, first_torque)
      !> The samples
      type(follower_samples_t), intent(out) :: samples
      !> Model of the lobe
      type(model_t), intent(in), target :: model
      !> Cycle of the lobe
      type(cycle_t), intent(in), target :: cycle
      !> The case
      type(case_t), intent(in), target, optional :: case
      !> Number of series of the case, and the first of them that is a torque
      integer, intent(in), optional :: series, first_torque

      samples%state%contact%is_touching = .false.
      samples%model => model
      samples%cycle => cycle
      if (present(case)) then
         samples%case => case
         samples%series = series
         samples%first_torque = first_torque
         call start_rows(samples%rows, samples%first_torque - 1)
      end if
   end subroutine start_samples

   !> Series and torques at a cam angle, with zero for torques among the series and for what follows from stored energy.
   subroutine sample(self, x, values, error)
      class(follower_samples_t), intent(inout) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: x
      !> Values of the series [unit of the series], then the torques [N m], last the energy residual [W]
      real(wp), intent(out), contiguous :: values(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(contact_t) :: nearby

      call follow_ramp(self%model, x)
      nearby = contact_ahead(self%trail, x, self%state%contact)
      call state_at(self%cycle, self%model, x, self%hint, self%state, error, nearby)
      if (allocated(error)) return
      call extend_trail(self%trail, x, self%state%contact)
      self%largest_sliding = max(self%largest_sliding, abs(self%state%contact%sliding_speed))
      call sampled_values(self, self%state, values)
      if (associated(self%case)) then
         call add_sample(self%rows, x, values(:self%first_torque - 1), .false.)
      else
         call widen(self%extremes, self%model, self%state, x)
      end if
   end subroutine sample

   !> Contact to start from at an angle: the last one, with what is not known before it is solved on the parabola through three.
   pure function contact_ahead(trail, angle, last) result(nearby)
      !> Contacts that were solved last
      type(trail_t), intent(in) :: trail
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The last of them
      type(contact_t), intent(in) :: last
      !> What to start from
      type(contact_t) :: nearby

      ! Values at the angle [unit of each]; distances of the angle from those of the trail [rad]
      real(wp) :: values(3), ahead(3)

      nearby = last
      if (trail%count < 2) return
      associate (x => trail%angles, y => trail%values, n => trail%count)
         ahead(:n) = angle - x(:n)
         ! No further than the trail is long
         if (.not. (ahead(n) > 0.0_wp .and. ahead(n) <= x(n) - x(1))) return
         values = y(:, n) + (y(:, n) - y(:, n - 1))*(ahead(n)/(x(n) - x(n - 1)))
         if (n == 3) values = values + ahead(3)*ahead(2)/(x(3) - x(1)) &
            & *((y(:, 3) - y(:, 2))/(x(3) - x(2)) - (y(:, 2) - y(:, 1))/(x(2) - x(1)))
      end associate
      nearby%tangential_force = values(1)
      nearby%bearing_torque = values(2)
      nearby%film_ratio = values(3)
   end function contact_ahead

   !> Take a contact into the trail; one behind the last, or none, begins anew.
   pure subroutine extend_trail(trail, angle, contact)
      !> The trail
      type(trail_t), intent(inout) :: trail
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The contact there
      type(contact_t), intent(in) :: contact

      if (trail%count > 0) then
         if (angle <= trail%angles(trail%count)) trail%count = 0
      end if
      if (.not. contact%is_touching) trail%count = 0
      if (.not. contact%is_touching) return
      if (trail%count == 3) then
         trail%angles(:2) = trail%angles(2:)
         trail%values(:, :2) = trail%values(:, 2:)
         trail%count = 2
      end if
      trail%count = trail%count + 1
      trail%angles(trail%count) = angle
      trail%values(:, trail%count) = [contact%tangential_force, contact%bearing_torque, contact%film_ratio]
   end subroutine extend_trail

   !> Values of a state of the follower, in the order of `sample`.
   pure subroutine sampled_values(samples, state, values)
      !> The samples
      class(follower_samples_t), intent(in) :: samples
      !> The state
      type(state_t), intent(in) :: state
      !> Values of the series [unit of the series], then the torques [N m], last the energy residual [W]
      real(wp), intent(out), contiguous :: values(:)

      ! Torques of the follower [N m]
      real(wp) :: torques(torque_count)

      torques = state%torques
      if (associated(samples%case)) then
         call follower_values(samples%case, samples%model, state, values(:samples%first_torque - 1))
         values(samples%first_torque:samples%series) = 0.0_wp
      end if
      torques(of_geometric) = merge(state%moments%gas*state%position%finger_slope, flight_torque(samples%model, state), &
         & state%contact%is_touching)
      torques(of_roller_inertia) = 0.0_wp
      values(samples%series + 1:) = torques
   end subroutine sampled_values

   !> Let extremes take in a state.
   pure subroutine widen(extremes, model, state, angle)
      !> The extremes
      type(extremes_t), intent(inout) :: extremes
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle

      call note_findings(extremes%findings, model, state, angle)
      call widen_range(extremes%contact_load, state%contact%load)
      call widen_range(extremes%torque_drive, state%torque_drive)
      call widen_range(extremes%sliding_speed, state%contact%sliding_speed)
      if (.not. state%contact%is_touching) return
      extremes%hertz_pressure = max(extremes%hertz_pressure, largest_pressure(model, state))
      extremes%film_min = min(extremes%film_min, thinnest_film(model, state))
   end subroutine widen

   !> Let a range take in a value.
   pure subroutine widen_range(range, value)
      !> Smallest and largest [any]
      real(wp), intent(inout) :: range(2)
      !> The value [any]
      real(wp), intent(in) :: value

      range = [min(range(1), value), max(range(2), value)]
   end subroutine widen_range

   !> The point that was sampled last, as these searches need it.
   pure function entrainment_of(samples, angle) result(speed)
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> What it is like
      type(entrainment_t) :: speed

      speed%angle = angle
      speed%entrainment_speed = samples%state%contact%entrainment_speed
      speed%sliding_speed = samples%state%contact%sliding_speed
      speed%is_touching = samples%state%contact%is_touching
      if (.not. (allocated(samples%model%axial) .and. speed%is_touching)) return
      speed%loaded_ends = count(samples%state%along%ends > 0.0_wp)
      speed%peak_slice = samples%state%along%place/slice_width(samples%model%axial)
   end function entrainment_of

end module camroller_follower_samples
