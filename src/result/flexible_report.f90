!> What a result has of a flexible train: means over its turns, scalars with their scatter, the turns one by one.
!>
!> In: the solution of a lobe's train. Out: means and rows of all series, as those of a rigid train; scalars for the summary, and
!> the same of each turn where there are several. Each step is integrated with its own curve; turns of a period, or those for
!> statistics where there is none, count alike.
module camroller_flexible_report
   use camroller_case, only : case_t
   use camroller_catalogue, only : lobe_prefix, series_values
   use camroller_cycle, only : cycle_t
   use camroller_error, only : error_t, kind_convergence, raise
   use camroller_sampled_extremes, only : add_sample, samples_t, start_samples
   use camroller_flexible_cycle, only : longest_period
   use camroller_flexible_follower, only : evaluate_follower
   use camroller_flexible_spikes, only : has_spikes, spike_angles
   use camroller_flexible_parts, only : damper_count, damper_series, dampers_without_adjuster
   use camroller_flexible_measure_list, only : largest_load_angle, measures
   use camroller_flexible_solution, only : error_share, flexible_solution_t, statistical_turns
   use camroller_flexible_train, only : resolution_t
   use camroller_cam_angle, only : file_angle
   use camroller_cycle_shares, only : add_shares, shares_t
   use camroller_kinds, only : two_pi, wp, not_a_number
   use camroller_lash_adjuster, only : relative_volume
   use camroller_model, only : model_t
   use camroller_number_text, only : integer_text
   use camroller_quadrature, only : gauss_legendre
   use camroller_result, only : append_history, append_quantity, find_quantity, is_film, lobe_scope, quantity_list_t, &
      & quantity_t, result_t
   use camroller_state, only : state_t
   use camroller_torque_list, only : is_loss, of_gas_damping, of_geometric, of_residual, of_roller_inertia, torque_count, &
      & torque_series
   use camroller_train_outlook, only : find_outlook, outlook_t
   use camroller_trajectory, only : interpolate_state, trajectory_t
   use camroller_turn_scatter, only : scatter_error
   implicit none
   private

   public :: flexible_means_t, integrate_turns, compare_turns, add_outlook, add_train_scalars, list_turns

   !> Turns that a result may list
   integer, parameter, public :: most_turns = max(longest_period, statistical_turns)
   !> Points of the rule for a step
   integer, parameter :: points = 3

   !> Means over all turns
   type, extends(shares_t) :: flexible_means_t
      !> Of each series of follower and camshaft, as if the follower were alone [unit of the series]
      real(wp), allocatable :: mean(:)
      !> Of the torques [N m], last the energy residual [W]
      real(wp) :: torques(torque_count) = 0.0_wp
      !> Series of the follower at the points evaluated
      type(samples_t) :: rows
      !> Series of the camshaft there, without its bearings
      type(samples_t) :: torque_rows
      !> Of the magnitude of each series [unit of the series]
      real(wp), allocatable :: size(:)
      !> Error of the mean of each series by the scatter of turns without a period, else zero [unit of the series]
      real(wp), allocatable :: scatter(:)
      !> Largest magnitude of the sliding speed evaluated [m/s]
      real(wp) :: largest_sliding = 0.0_wp
      !> Oil that enters the adjuster's chamber and that leaves it, at ambient density [m^3/s]
      real(wp) :: oil(2) = 0.0_wp
      !> Of turns before the last one, for each series the row of its smallest and of its largest value, in the last column that of
      !> the smallest load with the valve off its seat, shape (series, column) [unit of the series]
      real(wp), allocatable :: held(:, :)
      !> Their cam angles [rad], the values of the extremes, those of largest ones with the other sign [unit of the series]
      real(wp), allocatable :: held_angle(:), held_value(:)
      !> Is a series a film, whose smallest value is one with contact?
      logical, allocatable :: is_film(:)
   end type flexible_means_t

contains

   !> Means over all turns.
   subroutine integrate_turns(case, model, solution, series, first_torque, means, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> Its solution
      type(flexible_solution_t), intent(in) :: solution
      !> Series of follower and camshaft, and the first of them that is a torque
      type(quantity_t), intent(in) :: series(:)
      integer, intent(in) :: first_torque
      !> The means
      type(flexible_means_t), intent(out) :: means
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Series, or their means so far; their means of each turn, shape (series, turn) [unit of the series]
      real(wp) :: values(size(series)), of_turns(size(series), size(solution%turns))
      integer :: turn

      call start_means(means, size(series), first_torque)
      means%is_film = is_film(series)
      do turn = 1, size(solution%turns)
         values = means%mean
         call add_turn(case, model, solution%turns(turn), solution%cycle%resolution, 1.0_wp/size(solution%turns), &
            & turn == size(solution%turns), .true., state, means, error)
         if (allocated(error)) return
         of_turns(:, turn) = (means%mean - values)*size(solution%turns)
      end do
      if (solution%cycle%period == 0) means%scatter = scatter_error(of_turns)
      call add_held(means)
      call series_values(case, model, state, means%torques, values)
      means%mean(first_torque:) = values(first_torque:)
   end subroutine integrate_turns

   !> Means of nothing so far.
   subroutine start_means(means, series_count, first_torque)
      type(flexible_means_t), intent(out) :: means
      !> Number of series of follower and camshaft, and the first of them that is a torque
      integer, intent(in) :: series_count, first_torque

      allocate (means%mean(series_count), means%size(series_count), means%scatter(series_count), source=0.0_wp)
      allocate (means%held(series_count, 2*series_count + 1), means%held_angle(2*series_count + 1), source=0.0_wp)
      allocate (means%held_value(2*series_count + 1), source=huge(1.0_wp))
      call start_samples(means%rows, first_torque - 1)
      call start_samples(means%torque_rows, series_count - first_torque + 1)
   end subroutine start_means

   !> Hold the row of a turn before the last one where it has an extreme: of these turns nothing is searched between points.
   pure subroutine hold_row(means, angle, values, is_touching, event_load)
      type(flexible_means_t), intent(inout) :: means
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> The row [unit of the series]
      real(wp), intent(in) :: values(:)
      !> Are cam and roller in contact?
      logical, intent(in) :: is_touching
      !> Contact load; huge with the valve on its seat [N]
      real(wp), intent(in) :: event_load

      integer :: i

      associate (ends => [merge(huge(1.0_wp), values, means%is_film .and. .not. is_touching), -values, event_load])
         do i = 1, size(ends)
            if (ends(i) >= means%held_value(i)) cycle
            means%held_value(i) = ends(i)
            means%held_angle(i) = angle
            means%held(:, i) = values
         end do
      end associate
   end subroutine hold_row

   !> Add the rows held to those of the last turn, each once.
   pure subroutine add_held(means)
      type(flexible_means_t), intent(inout) :: means

      integer :: i, k, followers

      followers = size(means%rows%values, 1)
      do i = 1, size(means%held_value)
         if (means%held_value(i) >= huge(1.0_wp)) cycle
         ! Turns may have points at the same angle
         if (any([(all(abs(means%held(:, k) - means%held(:, i)) <= 0.0_wp), k=1, i - 1)])) cycle
         call add_sample(means%rows, means%held_angle(i), means%held(:followers, i), .false.)
         call add_sample(means%torque_rows, means%held_angle(i), means%held(followers + 1:, i), .false.)
      end do
   end subroutine add_held

   !> Errors of the means of a turn: from the last turn and the one with a finer tolerance, each with points of its own. They are
   !> relative to the mean magnitude of their series, or to what counts as none of it, those of torques to the mean of all losses,
   !> those of powers of dampers to it at least. What the gas pays of the losses counts for the two torques that hold it.
   !>
   !> In a period the roller gains no energy: what it has gained or lost of it, where a disturbance hardly decays in a turn, counts
   !> as error of the drive torque, too. As much oil enters an adjuster as leaks. Both turns may lack the same of it: where little
   !> leaks, errors of the plunger's travel make up for it. Without a period turns are some of many, and their scatter counts.
   subroutine compare_turns(case, model, solution, series, first_torque, whole, mean_errors, missing_oil, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> Its solution
      type(flexible_solution_t), intent(in) :: solution
      !> Series of follower and camshaft, and the first of them that is a torque
      type(quantity_t), intent(in) :: series(:)
      integer, intent(in) :: first_torque
      !> Means over all turns; out: their sizes are what errors are relative to
      type(flexible_means_t), intent(inout) :: whole
      !> Errors of the means [-]
      real(wp), intent(out) :: mean_errors(:)
      !> Difference of the oil that enters an adjuster and the oil that leaks, over the larger; zero where turns are no period [-]
      real(wp), intent(out) :: missing_oil
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(flexible_means_t) :: means, finer
      type(state_t) :: state
      real(wp) :: gained ! Mean torque of the roller's inertia [N m]
      integer :: residual, place

      missing_oil = 0.0_wp
      call start_means(means, size(series), first_torque)
      call add_turn(case, model, solution%cycle%trajectory, solution%cycle%resolution, 1.0_wp, .true., .false., state, means, error)
      if (allocated(error)) return
      call start_means(finer, size(series), first_torque)
      call add_turn(case, model, solution%finer, solution%finer_resolution, 1.0_wp, .true., .false., state, finer, error)
      if (allocated(error)) return
      call set_scales(model, series, first_torque, means)
      call set_scales(model, series, first_torque, whole)
      mean_errors = 0.0_wp
      where (means%size > 0.0_wp) mean_errors = error_share*abs(means%mean - finer%mean)/max(means%size, series%least)
      where (whole%scatter > 0.0_wp) mean_errors = max(mean_errors, whole%scatter/max(whole%size, series%least))
      if (allocated(model%flexible%adjuster) .and. solution%cycle%period == 1) then
         missing_oil = abs(means%oil(1) - means%oil(2))/max(maxval(abs(means%oil)), tiny(1.0_wp))
         place = find_quantity(series, "check_valve_flow")
         mean_errors(place) = max(mean_errors(place), missing_oil)
      end if
      if (solution%cycle%period == 1) then
         gained = abs(means%torques(of_roller_inertia))
         call count_gain(trim(torque_series(of_roller_inertia)))
         call count_gain("torque_drive")
      end if
      residual = find_quantity(series, trim(torque_series(of_residual)))
      if (residual > 0) mean_errors(residual) = 0.0_wp
      if (max(means%lost_share, whole%lost_share) > 0.0_wp) mean_errors(find_quantity(series, "film_thickness_min") &
         & :find_quantity(series, "film_ratio")) = 0.0_wp

   contains

      !> Take what the roller gained as error of the mean of a torque.
      subroutine count_gain(name)
         !> Its series
         character(len=*), intent(in) :: name

         integer :: i

         i = find_quantity(series, name)
         if (i > 0) mean_errors(i) = max(mean_errors(i), gained/max(means%size(i), tiny(1.0_wp)))
      end subroutine count_gain

   end subroutine compare_turns

   !> Make the sizes of series what errors of their means are relative to.
   pure subroutine set_scales(model, series, first_torque, means)
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> Series of follower and camshaft, and the first of them that is a torque
      type(quantity_t), intent(in) :: series(:)
      integer, intent(in) :: first_torque
      !> In: mean magnitudes; out: scales
      type(flexible_means_t), intent(inout) :: means

      real(wp) :: losses ! Mean torque of all losses [N m]
      integer :: first_power, last_power, row, paid(2)

      losses = sum(means%torques, mask=is_loss)
      first_power = find_quantity(series, trim(damper_series(1)))
      last_power = first_power + merge(damper_count, dampers_without_adjuster, allocated(model%flexible%adjuster)) - 1
      associate (torques => means%size(first_torque:), powers => means%size(first_power:last_power))
         torques = losses
         powers = max(powers, model%speed*losses)
      end associate
      if (.not. allocated(model%gas)) return
      paid = [(find_quantity(series, trim(torque_series(row))), row=of_geometric, of_gas_damping, of_gas_damping - of_geometric)]
      means%size(paid) = losses + means%torques(of_gas_damping)
   end subroutine set_scales

   !> Take a turn into the means.
   subroutine add_turn(case, model, path, resolution, share, is_last, has_extremes, state, means, error)
      type(case_t), intent(in) :: case
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Its share of all turns [-]
      real(wp), intent(in) :: share
      !> Is it the last one, and are extremes looked for?
      logical, intent(in) :: is_last, has_extremes
      !> State at the last point
      type(state_t), intent(out) :: state
      type(flexible_means_t), intent(inout) :: means
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Places and weights of the rule on [-1, 1] [-]; length of a step and angle [rad], fraction of all turns [-]
      real(wp) :: places(points), weights(points), length, angle, weight
      ! State of the train [state], series [unit of the series]
      real(wp) :: train(size(path%state, 1)), values(size(means%mean))
      integer :: step, i, hint, status

      call gauss_legendre(places, weights)
      do step = 1, path%count - 1
         length = path%time(step + 1) - path%time(step)
         if (length <= 0.0_wp) cycle
         do i = 1, points
            angle = path%time(step) + 0.5_wp*length*(1.0_wp + places(i))
            weight = share*0.5_wp*length*weights(i)/two_pi
            hint = step
            call interpolate_state(path, angle, hint, train)
            call evaluate_follower(model, angle, train, resolution, state, status)
            if (status /= 0) then
               call raise(error, kind_convergence, "a state between the steps of the flexible train cannot be evaluated")
               return
            end if
            call series_values(case, model, state, state%torques, values)
            means%mean = means%mean + weight*values
            means%size = means%size + weight*abs(values)
            means%torques = means%torques + weight*state%torques
            means%largest_sliding = max(means%largest_sliding, abs(state%contact%sliding_speed))
            if (allocated(model%flexible%adjuster)) then
               associate (given => model%flexible%adjuster%given, train => state%flexible)
                  means%oil = means%oil + weight*[train%check_flow, train%leak_flow]/relative_volume(given, train%chamber_pressure)
               end associate
            end if
            if (has_extremes) call keep_row(means, model, angle, state, values, is_last)
            call add_shares(means, model, state, angle, state%position%lift > 0.0_wp, weight)
         end do
         if (has_extremes .and. has_spikes(model)) call add_spikes(case, model, path, resolution, step, is_last, means)
      end do
   end subroutine add_turn

   !> Add rows where the friction of joints has spikes that the points of a step miss.
   subroutine add_spikes(case, model, path, resolution, step, is_last, means)
      type(case_t), intent(in) :: case
      !> The model of the lobe, with such joints
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      integer, intent(in) :: step
      !> Is the turn the last one?
      logical, intent(in) :: is_last
      !> The means; out: with the rows
      type(flexible_means_t), intent(inout) :: means

      type(state_t) :: state
      ! Cam angles [rad]; state of the train [state], series [unit of the series]
      real(wp), allocatable :: angles(:)
      real(wp) :: train(size(path%state, 1)), values(size(means%mean))
      integer :: i, hint, status

      angles = spike_angles(model, path, resolution, step)
      do i = 1, size(angles)
         hint = step
         call interpolate_state(path, angles(i), hint, train)
         call evaluate_follower(model, angles(i), train, resolution, state, status)
         if (status /= 0) cycle
         call series_values(case, model, state, state%torques, values)
         call keep_row(means, model, angles(i), state, values, is_last)
      end do
   end subroutine add_spikes

   !> Keep a row for the extremes.
   pure subroutine keep_row(means, model, angle, state, values, is_last)
      !> The means; out: with the row
      type(flexible_means_t), intent(inout) :: means
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> State of the follower there
      type(state_t), intent(in) :: state
      !> Series [unit of the series]
      real(wp), intent(in) :: values(:)
      !> Is the turn the last one?
      logical, intent(in) :: is_last

      if (is_last) then
         call add_sample(means%rows, angle, values(:size(means%rows%values, 1)), .false.)
         call add_sample(means%torque_rows, angle, values(size(means%rows%values, 1) + 1:), .false.)
      else
         call hold_row(means, angle, values, state%contact%is_touching, merge(state%contact%load, huge(1.0_wp), &
            & state%position%lift > 0.0_wp .and. state%position%lift >= model%train%seat_lift))
      end if
   end subroutine keep_row

   !> Scalars of a train.
   subroutine add_train_scalars(list, model, solution, prefix, scope)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Solution of its train
      type(flexible_solution_t), intent(in) :: solution
      !> Beginning of the names, and what they belong to
      character(len=*), intent(in) :: prefix, scope

      integer :: i

      do i = 1, size(solution%mean)
         associate (measure => measures(i))
            if (i == largest_load_angle) then
               call add(trim(measure%name), "degree", "of all cycles: "//trim(measure%meaning), file_angle(solution%mean(i)))
               cycle
            end if
            call add(trim(measure%name), trim(measure%unit), "mean over the cycles: "//trim(measure%meaning), solution%mean(i))
            call add(trim(measure%name)//"_deviation", trim(measure%unit), "standard deviation from cycle to cycle: "// &
               & trim(measure%meaning), solution%deviation(i))
            call add(trim(measure%name)//"_lowest", trim(measure%unit), "smallest of all cycles: "//trim(measure%meaning), &
               & solution%lowest(i))
            call add(trim(measure%name)//"_highest", trim(measure%unit), "largest of all cycles: "//trim(measure%meaning), &
               & solution%highest(i))
         end associate
      end do
      call add("period_cycles", "1", "cycles after which the motion repeats; 0 where it is not periodic", &
         & real(solution%cycle%period, wp))
      call add("cycle_multiplier", "1", "largest fraction of a disturbance that remained after a cycle, or a period of several", &
         & solution%cycle%multiplier)
      call add("summary_cycles", "1", "cycles over which these values are taken", real(size(solution%turns), wp))
      if (allocated(model%flexible%adjuster)) then
         call add("plunger_spring_force", "N", "force of the plunger's spring in its middle position", &
            & model%flexible%adjuster%spring_force)
         call add("leak_conductance", "m3 s-1 Pa-1", "leak along the plunger per unit of pressure", &
            & model%flexible%adjuster%conductance)
      end if

   contains

      !> Append a scalar.
      subroutine add(name, unit, meaning, value)
         !> Its name, unit and meaning
         character(len=*), intent(in) :: name, unit, meaning
         !> Its value [unit of the scalar]
         real(wp), intent(in) :: value

         call append_quantity(list, prefix//name, unit, meaning, "dynamics", value, scope)
      end subroutine add

   end subroutine add_train_scalars

   !> List the turns of all trains one by one, where one of them does not repeat every turn; what another has fewer of is
   !> not-a-number.
   subroutine list_turns(cycles, result)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> Result; out: with the list
      type(result_t), intent(inout) :: result

      type(quantity_list_t) :: list
      ! The turns, shape (turn, measure) [unit of the measure]
      real(wp), allocatable :: rows(:, :)
      integer :: lobe, turns, first, i

      if (.not. allocated(cycles(1)%flexible)) return
      turns = maxval([(size(cycles(lobe)%flexible%turns), lobe=1, size(cycles))])
      if (turns == 1) return
      allocate (list%items(0), list%values(0))
      allocate (rows(turns, sum([(size(cycles(lobe)%flexible%values, 1), lobe=1, size(cycles))])), source=not_a_number())
      do lobe = 1, size(cycles)
         associate (values => cycles(lobe)%flexible%values)
            first = list%count
            do i = 1, size(values, 1)
               call append_quantity(list, trim(lobe_prefix(lobe))//trim(measures(i)%name), trim(merge("degree      ", &
                  & measures(i)%unit, i == largest_load_angle)), trim(measures(i)%meaning), "dynamics", 0.0_wp, lobe_scope(lobe))
            end do
            rows(:size(values, 2), first + 1:list%count) = transpose(values)
            rows(:size(values, 2), first + largest_load_angle) = file_angle(values(largest_load_angle, :))
         end associate
      end do
      call append_history(result, list%items(:list%count), rows)
   end subroutine list_turns

   !> Scalars of what a train's vibration is estimated to amount to, whether it is rigid or flexible.
   subroutine add_outlook(list, model, prefix, scope)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Beginning of the names, and what they belong to
      character(len=*), intent(in) :: prefix, scope

      type(outlook_t) :: outlook
      integer :: n

      call find_outlook(model, outlook)
      if (.not. outlook%is_known) return
      call append_quantity(list, prefix//"train_frequency", "Hz", "estimate: lowest natural frequency of the train with the "// &
         & "valve at full lift, with stiffness usual for its size where there is no &dynamics", "dynamics", &
         & outlook%frequencies(1)/two_pi, scope)
      call append_quantity(list, prefix//"load_factor", "1", "estimate: largest contact load of a train that vibrates at that "// &
         & "frequency over the largest of a rigid one, without friction of the joints and impacts that take up lash", "dynamics", &
         & outlook%load_factor, scope)
      do n = 1, size(outlook%surge)
         call append_quantity(list, prefix//"surge_estimate_"//integer_text(n), "N", "estimate: largest force of spring mode "// &
            & integer_text(n)//" with the lift of a rigid train", "dynamics", outlook%surge(n), scope)
      end do
   end subroutine add_outlook

end module camroller_flexible_report
