!> A piece of a host's step: its integration, its means, the forces on the cam within it.
!>
!> In: a follower whose model follows the inputs, with the stops of the piece. Out: means with their error, extremes, states, the
!> roller's spin at the end.
!>
!> A curve that misses the equation by more than the tolerance allows is integrated again with shorter steps, see `step_error`.
module camroller_follower_piece
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_convergence
   use camroller_case, only : numerics_t
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_flexible_train, only : largest_state
   use camroller_state, only : state_t, cam_force
   use camroller_torque_list, only : torque_count
   use camroller_follower_samples, only : extremes_t
   use camroller_spin, only : nearby_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_flexible_drive, only : drive_t
   use camroller_spin_piece, only : spin_piece_t, integrate_between, longest_first_step
   use camroller_means, only : integrate_torques
   use camroller_run, only : take_way_out
   use camroller_short_piece, only : integrate_short
   use camroller_step_judge, only : judge_piece
   use camroller_step_error, only : slip_error_t, judge_intervals, is_good, spin_error
   implicit none
   private

   public :: follower_t, point_t, piece_means_t, cover_piece, fill_nodes, slip_tolerance, most_tries

   !> What is remembered between steps
   type :: point_t
      !> Cam angle, pi at full lift, growing with the turns [rad]
      real(wp) :: angle = 0.0_wp
      !> Spin of the roller [rad/s]
      real(wp) :: roller_spin = 0.0_wp
      !> Sliding speed that belongs to it, which the spin alone would round off [m/s]
      real(wp) :: sliding_speed = 0.0_wp
      !> Scale of the sliding speed, to which the tolerance is relative; zero before the start [m/s]
      real(wp) :: scale = 0.0_wp
      !> Temperature of the oil at the end of the last step, and that of the films solved beforehand [K]
      real(wp) :: oil_temperature = 0.0_wp, film_temperature = 0.0_wp
      !> Cam speed of the films solved beforehand [rad/s]
      real(wp) :: film_speed = 0.0_wp
      !> Contact from which the next one is looked for: tangential force [N], torque of the bearing [N m] and film ratio [-], which
      !> is zero for none
      real(wp) :: contact(3) = 0.0_wp
      !> Step that the integration of a flexible train begins with; zero before its first [rad]
      real(wp) :: train_step = 0.0_wp
      !> State of a flexible train, the rest zero [state]; the roller's spin stands for its sliding speed
      real(wp) :: train(largest_state) = 0.0_wp
   end type point_t

   !> A follower between two steps
   type :: follower_t
      type(model_t) :: model
      !> As given, and with method and tolerance
      type(numerics_t) :: given, numerics
      type(point_t) :: point
      !> Is the oil of the model another one than that of the point? The next step sets it anew
      logical :: is_to_be_set = .false.
      !> Mark of the model at the start
      integer(int64) :: mark = 0_int64
      !> The last piece of the last step; no step depends on it, but the next one uses its room
      type(spin_piece_t) :: piece
      !> The same of a flexible train
      type(drive_t) :: drive
   end type follower_t

   !> Means of a piece
   type :: piece_means_t
      !> Mean torques [N m], last the energy residual [W]; error of the mean torque that drives [N m]
      real(wp) :: torques(torque_count), error
      type(extremes_t) :: extremes
      !> States at the start, in the middle and at the end of a short piece; have they been evaluated?
      type(state_t) :: states(3)
      logical :: has_states
   end type piece_means_t

   !> Fewest steps of the integration between two stops, at the first try and where its curve then misses the equation
   integer, parameter :: fewest_steps(*) = [1, 4, 16]
   !> Longest piece whose curve is looked at in every interval [rad]: in longer ones a single interval counts little
   real(wp), parameter :: longest_checked = 2.0_wp*longest_first_step
   !> Tries of a piece with other methods and tolerances
   integer, parameter :: most_tries = 3

contains

   !> Tolerances of a follower for the errors of its sliding speed.
   pure function slip_tolerance(follower) result(errors)
      !> The follower
      type(follower_t), intent(in) :: follower
      !> No errors yet
      type(slip_error_t) :: errors

      errors%tolerance = follower%numerics%tolerance
      errors%allowed = follower%numerics%tolerance*follower%point%scale
   end function slip_tolerance

   !> Integrate a piece and take its means; again with shorter steps where its curve misses the equation.
   subroutine cover_piece(follower, means, error)
      !> The follower, with the stops of its piece and a model that follows the inputs; its roller's spin is moved
      type(follower_t), intent(inout) :: follower
      !> The means
      type(piece_means_t), intent(out) :: means
      !> Convergence error; domain error of `judge_piece`
      type(error_t), allocatable, intent(out) :: error

      type(nearby_t) :: nearby
      type(slip_error_t) :: errors
      ! Spin [rad/s] and sliding speed [m/s] at the start
      real(wp) :: spin, sliding_speed
      logical :: is_checked
      integer :: i

      spin = follower%point%roller_spin
      sliding_speed = follower%point%sliding_speed
      associate (model => follower%model, path => follower%piece%path, stops => follower%piece%stops)
         do i = 1, size(fewest_steps)
            if (i > 1) call follow_ramp(model, model%ramp%angle)
            follower%point%roller_spin = spin
            follower%point%sliding_speed = sliding_speed
            call integrate_piece(follower, fewest_steps(i), nearby, error)
            if (allocated(error)) return
            means%has_states = .false.
            errors = slip_tolerance(follower)
            if (size(stops) == 2) call integrate_short(model, path, nearby, means%states, means%torques, means%error, &
               & means%extremes, errors, means%has_states, error)
            if (.not. (allocated(error) .or. means%has_states)) then
               errors = slip_tolerance(follower)
               is_checked = stops(size(stops)) - stops(1) <= longest_checked .and. .not. allocated(path%phases)
               if (is_checked) call judge_intervals(errors, model, path, error)
            end if
            if (allocated(error)) return
            if (is_good(errors)) exit
         end do
         if (.not. means%has_states) call integrate_torques(model, path, means%torques, error, means%extremes, means%error)
         if (allocated(error)) return
         means%error = means%error + errors%torque + spin_error(errors, model, path, spin)
         call judge_piece(model, path, stops, error)
      end associate
   end subroutine cover_piece

   !> Force on the cam and torque at equally spaced angles of a piece, without its end: from its states where they are these.
   subroutine fill_nodes(model, piece, means, ends, nodes, error)
      !> The model, which follows the inputs
      type(model_t), intent(inout) :: model
      !> The piece, its means
      type(cycle_t), intent(in) :: piece
      type(piece_means_t), intent(in) :: means
      !> Its first and last angle from full lift [rad]
      real(wp), intent(in) :: ends(2)
      !> Force [N] and torque [N m]
      real(wp), intent(out) :: nodes(:, :)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      if (.not. (means%has_states .and. size(nodes, 2) == 2)) then
         call sample_nodes(model, piece, ends, nodes, error)
         return
      end if
      do i = 1, 2
         nodes(:2, i) = cam_force(model, means%states(i))
         nodes(3, i) = means%states(i)%torque_drive
      end do
   end subroutine fill_nodes

   !> Force on the cam and torque at equally spaced angles of a piece, without its end.
   subroutine sample_nodes(model, piece, ends, nodes, error)
      !> The model, which follows the inputs
      type(model_t), intent(inout) :: model
      type(cycle_t), intent(in) :: piece
      !> Its first and last angle from full lift [rad]
      real(wp), intent(in) :: ends(2)
      !> Force [N] and torque [N m]
      real(wp), intent(out) :: nodes(:, :)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Cam angle from full lift [rad]
      real(wp) :: angle
      integer :: i, hint

      hint = 1
      do i = 1, size(nodes, 2)
         angle = ends(1) + (ends(2) - ends(1))*(i - 1)/size(nodes, 2)
         call follow_ramp(model, angle)
         call state_at(piece, model, angle, hint, state, error)
         if (allocated(error)) return
         nodes(:2, i) = cam_force(model, state)
         nodes(3, i) = state%torque_drive
      end do
   end subroutine sample_nodes

   !> Integrate a piece; where that fails, once more with the method and the tolerances that `run_case` falls back on.
   subroutine integrate_piece(follower, steps, nearby, error)
      !> The follower, with the stops of its piece; its roller's spin is moved
      type(follower_t), intent(inout) :: follower
      !> Fewest steps between two stops
      integer, intent(in) :: steps
      !> First and last contact that the integration has solved
      type(nearby_t), intent(out) :: nearby
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(numerics_t) :: numerics
      ! Spin [rad/s] and sliding speed [m/s], from start to end; smallest tolerance that may work [-]
      real(wp) :: spin, sliding_speed, least
      integer :: try
      logical :: has_way_out

      numerics = follower%numerics
      least = 0.0_wp
      has_way_out = .false.
      do try = 1, most_tries
         spin = follower%point%roller_spin
         sliding_speed = follower%point%sliding_speed
         nearby%has_first = .false.
         associate (start => nearby%last, kept => follower%point%contact)
            start%is_touching = kept(3) > 0.0_wp
            start%tangential_force = kept(1)
            start%bearing_torque = kept(2)
            start%film_ratio = kept(3)
         end associate
         call integrate_between(follower%piece, follower%model, numerics, follower%point%scale, spin, error, nearby, steps, &
            & sliding_speed)
         if (.not. allocated(error)) exit
         if (has_way_out .or. error%kind /= kind_convergence .or. try == most_tries) return
         call take_way_out(follower%given, numerics, least, has_way_out)
      end do
      follower%point%roller_spin = spin
      follower%point%sliding_speed = sliding_speed
   end subroutine integrate_piece

end module camroller_follower_piece
