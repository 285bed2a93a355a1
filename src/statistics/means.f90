!> Means over the cycle: integrals of the solution with an error control of their own.
!>
!> In: cycles. Out: mean and extremes of the series and torques of a lobe shape's follower, and an estimate of the
!> largest error of a mean. Each interval between accepted points is a panel of `panels`, halved where the error estimate of a mean
!> is too large. A solution that is only linear between its points gets the trapezoidal rule.
!>
!> The torque against spring, seat and inertia and the one for the inertia of the roller are not integrated over the angle: over a
!> cycle or a piece of one they are differences of stored energy, `stored_work`.
module camroller_means
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_accuracy, only : quadrature_part
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_cycle, only : cycle_t
   use camroller_catalogue, only : series_values
   use camroller_torque_list, only : torque_count, is_loss, is_torque, of_geometric, of_roller_inertia, of_residual, torque_series
   use camroller_cycle_walk, only : walk_t, walk_round, trapezoid
   use camroller_error_estimate, only : estimated_error
   use camroller_sampled_extremes, only : samples_t, move_samples
   use camroller_cycle_shares, only : shares_t
   use camroller_follower_samples, only : follower_samples_t, start_samples, extremes_t
   use camroller_slip_errors, only : slip_errors_t, find_slip_errors
   use camroller_lobe_curve, only : lobe_curve_t, move_curve
   use camroller_panels, only : panels_t, panel_points, panel_places, start_panels, add_panel, add_trapezoid, &
      & refine_panels, total_of
   use camroller_result, only : quantity_t, find_quantity, series_name_length
   use camroller_standstills, only : add_rolling_points, add_standstills, add_surfaces_at_rest, split_at_changes
   use camroller_stored_work, only : stored_work_t, follow_contact, end_work, lost_angle, spin_work, split_at_losses
   implicit none
   private

   public :: statistics_t, find_thickest_film, has_film_limit, integrate_lobe, integrate_torques, mean_tolerance, &
      & stored_torques, mean_sizes

   !> Means over the cycle of one lobe shape
   type, extends(shares_t) :: statistics_t
      !> Mean of each series of the follower, as if it were alone [unit of the series]
      real(wp), allocatable :: mean(:)
      !> Series of the follower at the points evaluated; of the camshaft at those of a flexible train
      type(samples_t) :: rows, torque_rows
      !> Mean torques of the follower [N m], last the energy residual [W]
      real(wp) :: torques(torque_count) = 0.0_wp
      !> Largest magnitude of the sliding speed evaluated [m/s]
      real(wp) :: largest_sliding = 0.0_wp
      !> Estimate of the error of the sliding speed relative to its largest value [-]
      real(wp) :: error = 0.0_wp
      !> Cam angle from full lift at the end of the interval where that error is largest [rad]
      real(wp) :: error_angle = 0.0_wp
      !> Estimate of the largest error of a mean relative to the mean magnitude of its quantity [-]
      real(wp) :: mean_error = 0.0_wp
      !> The mean that has it
      character(len=series_name_length) :: worst_mean = ""
      !> Difference of the oil that enters an adjuster and the oil that leaks, over the larger [-]
      real(wp) :: missing_oil = 0.0_wp
      !> What the camshaft takes from the follower
      type(lobe_curve_t) :: curve
      !> Errors caused by the error of the sliding speed
      type(slip_errors_t) :: slip_errors
      !> Smallest and largest value of each series of the follower [unit of the series]
      real(wp), allocatable :: lowest(:), highest(:)
      !> Smallest contact load with the valve off its seat [N]
      real(wp) :: event_load = 0.0_wp
      !> Errors of the smallest and the largest value of each series [unit of the series]
      real(wp), allocatable :: extreme_errors(:, :)
      !> Estimate of the largest error of a smallest or largest value relative to the range of its series [-], and the series that
      !> has it
      real(wp) :: extreme_error = 0.0_wp
      character(len=series_name_length) :: worst_extreme = ""
      !> Largest central film over the equivalent radius [-], and its cam angle from full lift [rad]
      real(wp) :: thickest_film = 0.0_wp, thickest_angle = 0.0_wp
      !> Number of standstills of the contact, where nothing is entrained
      integer :: standstills = 0
      !> Cam angle from full lift of the first of them [rad]
      real(wp) :: first_standstill = 0.0_wp
   end type statistics_t

   !> Film over the equivalent radius beyond which formulas for films say nothing: they hold for gaps that are small against the
   !> radius, with errors of the order of this ratio [-]
   real(wp), parameter :: thickest_film = 0.01_wp
   !> Halvings of panels, at most
   integer, parameter, public :: most_halvings = 1000
   !> Times that what is allowed is taken anew from means that have become better
   integer, parameter :: most_passes = 5
   !> Least tolerance of a mean: below it rounding counts [-]
   real(wp), parameter :: least_tolerance = 1.0e-10_wp

contains

   !> Means and extremes over the cycle of one lobe shape.
   subroutine integrate_lobe(case, series, model, cycle, statistics, error)
      !> The case
      type(case_t), intent(in), target :: case
      !> Its series: those of one follower and of the camshaft
      type(quantity_t), intent(in) :: series(:)
      !> Model of the lobe
      type(model_t), intent(in), target :: model
      !> Cycle of the lobe
      type(cycle_t), intent(in), target :: cycle
      !> Means and extremes
      type(statistics_t), intent(out) :: statistics
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(follower_samples_t) :: samples
      type(walk_t) :: walk
      ! Length of the cycle [rad]
      real(wp) :: span
      ! First and last series that is a film without a mean
      integer :: films(2)

      call start_samples(samples, model, cycle, case, size(series), find_quantity(series, "torque_geometric"))
      call walk_round(samples, walk, error)
      if (allocated(error)) return
      span = cycle%trajectory%time(cycle%trajectory%count) - cycle%trajectory%time(1)
      statistics%shares_t = walk%shares
      ! By the angles themselves, not by how many points are without contact
      statistics%lost_share = lost_angle(walk%work, span)/span
      statistics%error_angle = walk%error_angle
      call move_curve(walk%curve, statistics%curve)
      films = [1, 0]
      if (statistics%lost_share > 0.0_wp) films = [find_quantity(series, "film_thickness_min"), find_quantity(series, "film_ratio")]
      if (.not. cycle%is_linear) then
         call split_at_losses(walk%panels, samples, walk%work, error)
         if (.not. allocated(error) .and. allocated(model%axial)) call split_at_changes(walk%panels, samples, &
            & walk%speeds(:walk%count), error)
         if (allocated(error)) return
         call refine_means(walk%panels, samples, quadrature_part*mean_tolerance(cycle%tolerance), &
            & series%least*span, films, error)
         if (.not. allocated(error)) call add_standstills(samples, walk%speeds(:walk%count), statistics%standstills, &
            & statistics%first_standstill, error)
         if (.not. allocated(error)) call add_rolling_points(samples, walk%speeds(:walk%count), error)
         if (.not. allocated(error)) call add_surfaces_at_rest(samples, walk%speeds(:walk%count), error)
         if (allocated(error)) return
      end if
      statistics%largest_sliding = samples%largest_sliding
      call take_means(walk%panels, samples, walk%work, span, statistics)
      call find_slip_errors(walk%slips, samples, walk%estimate, statistics%slip_errors)
      call judge_means(walk%panels, statistics%slip_errors%integrals, span, series, films, statistics)
      ! The difference between start and end is repeated in each cycle until the periodic one is reached
      statistics%error = cycle%closure/max(1.0_wp - walk%estimate%contraction, epsilon(1.0_wp)) &
         & + estimated_error(walk%estimate)/max(statistics%largest_sliding, cycle%scale, tiny(1.0_wp))
      call move_samples(samples%rows, statistics%rows)
   end subroutine integrate_lobe

   !> Halve panels until the means are within the tolerance.
   subroutine refine_means(panels, samples, tolerance, least, films, error)
      type(panels_t), intent(inout) :: panels
      type(follower_samples_t), intent(inout) :: samples
      !> Error allowed, relative to the mean magnitude of each quantity [-]; what counts as none of each series [unit times rad]
      real(wp), intent(in) :: tolerance, least(:)
      !> First and last series that is a film without a mean
      integer, intent(in) :: films(2)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Error estimates allowed [unit of each times rad]
      real(wp) :: allowed(size(least) + torque_count)
      integer :: pass, halvings

      halvings = most_halvings
      do pass = 1, most_passes
         allowed = tolerance*mean_sizes(panels, least, films)
         if (all(total_of(panels%errors(:, :panels%count)) <= allowed)) return
         call refine_panels(panels, samples, allowed, halvings, error)
         if (allocated(error) .or. halvings == 0) return
      end do
   end subroutine refine_means

   !> Error of a mean that is aimed at, relative to the mean magnitude of its quantity.
   elemental function mean_tolerance(tolerance) result(error)
      !> Tolerance of the integration of the cycle [-]
      real(wp), intent(in) :: tolerance
      !> Error of a mean [-]
      real(wp) :: error

      error = max(tolerance, least_tolerance)
   end function mean_tolerance

   !> What the errors of the integrals are relative to: the integrals of the sizes, and for the torque against gas, which adds to
   !> what drives the camshaft, that of all losses. The energy residual is a matter of rounding. Films grow without bound where
   !> contact is lost, and have no mean then.
   pure function mean_sizes(panels, least, films) result(sizes)
      !> The panels
      type(panels_t), intent(in) :: panels
      !> What counts as none of each series that stands before the torques [unit of each times rad]
      real(wp), intent(in) :: least(:)
      !> First and last series that is a film without a mean; the second is less where there is none
      integer, intent(in) :: films(2)
      !> Sizes, positive [unit of each times rad]
      real(wp) :: sizes(size(least) + torque_count)

      sizes = max(total_of(panels%sizes(:, :panels%count)), tiny(1.0_wp)/least_tolerance)
      sizes(:size(least)) = max(sizes(:size(least)), least)
      associate (torques => sizes(size(least) + 1:))
         torques(of_geometric) = sum(torques, mask=is_loss)
         torques(of_residual) = huge(1.0_wp)
      end associate
      sizes(films(1):films(2)) = huge(1.0_wp)
   end function mean_sizes

   !> Means of series and torques from the integrals and the stored energy.
   subroutine take_means(panels, samples, work, span, statistics)
      type(panels_t), intent(in) :: panels
      type(follower_samples_t), intent(in) :: samples
      !> Work of what is stored
      type(stored_work_t), intent(inout) :: work
      !> Length of the cycle [rad]
      real(wp), intent(in) :: span
      !> The means
      type(statistics_t), intent(inout) :: statistics

      ! Means [unit of each]; series of the last state with the mean torques
      real(wp) :: means(samples%series + torque_count), series(samples%series)

      means = total_of(panels%integrals(:, :panels%count))/span
      statistics%torques = means(samples%series + 1:) + stored_torques(samples, work, span)
      call series_values(samples%case, samples%model, samples%state, statistics%torques, series)
      statistics%mean = [means(:samples%first_torque - 1), series(samples%first_torque:)]
   end subroutine take_means

   !> Mean torques that follow from stored energy.
   function stored_torques(samples, work, span) result(torques)
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Work of what is stored
      type(stored_work_t), intent(in) :: work
      !> Length of the cycle or the piece [rad]
      real(wp), intent(in) :: span
      !> The torques [N m]
      real(wp) :: torques(torque_count)

      torques = 0.0_wp
      torques(of_geometric) = end_work(work, samples)/span
      if (samples%model%is_consistent) torques(of_roller_inertia) = spin_work(samples)/span
   end function stored_torques

   !> Largest error of a mean, relative to the mean magnitude of its quantity.
   subroutine judge_means(panels, slip_errors, span, series, films, statistics)
      type(panels_t), intent(in) :: panels
      !> Errors of the integrals caused by the error of the sliding speed [unit of each times rad]
      real(wp), intent(in) :: slip_errors(:)
      !> Length of the cycle [rad]
      real(wp), intent(in) :: span
      type(quantity_t), intent(in) :: series(:)
      !> First and last series that is a film without a mean
      integer, intent(in) :: films(2)
      !> The means; out: with the largest error
      type(statistics_t), intent(inout) :: statistics

      ! Errors of the integrals [unit of each times rad], over the sizes [-]
      real(wp) :: errors(size(panels%integrals, 1)), relative(size(panels%integrals, 1))
      integer :: worst

      errors = total_of(panels%errors(:, :panels%count)) + slip_errors
      associate (torques => errors(size(series) + 1:))
         ! The drive torque has the errors of all losses, and the difference in spin between start and end
         torques(of_geometric) = torques(of_geometric) + sum(torques, mask=is_loss) &
            & + abs(statistics%torques(of_roller_inertia))*span
      end associate
      relative = errors/mean_sizes(panels, series%least*span, films)
      ! A quantity that is zero throughout has no error
      where (errors <= 0.0_wp) relative = 0.0_wp
      worst = maxloc(relative, 1)
      statistics%mean_error = relative(worst)
      if (worst <= size(series)) then
         statistics%worst_mean = series(worst)%name
      else if (worst == size(series) + of_geometric) then
         statistics%worst_mean = "torque_drive"
      else
         statistics%worst_mean = torque_series(worst - size(series))
      end if
   end subroutine judge_means

   !> Mean torques of a follower over a cycle or a piece of one.
   subroutine integrate_torques(model, cycle, torques, error, extremes, drive_error)
      !> Model of the lobe
      type(model_t), intent(in), target :: model
      !> Cycle or a piece of one
      type(cycle_t), intent(in), target :: cycle
      !> Mean torques [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(torque_count)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Smallest and largest values at the points that the means are made of
      type(extremes_t), intent(out), optional :: extremes
      !> Estimate of the error of the mean torque that drives, by the integration [N m]
      real(wp), intent(out), optional :: drive_error

      type(follower_samples_t) :: samples
      type(panels_t) :: panels
      type(stored_work_t) :: work
      ! Length [rad]
      real(wp) :: span

      torques = 0.0_wp
      call start_samples(samples, model, cycle)
      call walk_along(samples, panels, work, error)
      if (.not. (allocated(error) .or. cycle%is_linear)) call split_at_losses(panels, samples, work, error)
      if (.not. (allocated(error) .or. cycle%is_linear)) call refine_means(panels, samples, mean_tolerance(cycle%tolerance), &
         & [real(wp) ::], [1, 0], error)
      if (allocated(error)) return
      span = cycle%trajectory%time(cycle%trajectory%count) - cycle%trajectory%time(1)
      torques = total_of(panels%integrals(:, :panels%count))/span + stored_torques(samples, work, span)
      if (present(extremes)) extremes = samples%extremes
      if (present(drive_error)) drive_error = sum(total_of(panels%errors(:, :panels%count)), mask=is_torque)/span
   end subroutine integrate_torques

   !> Sample a cycle or a piece of one for its torques alone, two intervals a panel where no stop parts them.
   subroutine walk_along(samples, panels, work, error)
      type(follower_samples_t), intent(inout) :: samples
      type(panels_t), intent(out) :: panels
      !> Work of what is stored
      type(stored_work_t), intent(inout) :: work
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Places in a panel [-]; values there [unit of each]; ends of a panel, angle [rad]
      real(wp), allocatable :: places(:)
      real(wp) :: values(torque_count, panel_points), left, right, angle
      integer :: interval, next, point

      places = panel_places
      if (samples%cycle%is_linear) places = trapezoid
      associate (times => samples%cycle%trajectory%time(:samples%cycle%trajectory%count))
         call start_panels(panels, torque_count, size(times))
         interval = 1
         do while (interval < size(times))
            next = interval + 1
            left = times(interval)
            if (next < size(times) .and. times(next) > left .and. .not. samples%cycle%is_linear) then
               if (times(next + 1) > times(next)) next = next + 1
            end if
            right = times(next)
            interval = next
            if (.not. right > left) cycle
            do point = 1, size(places)
               angle = left + places(point)*(right - left)
               call samples%sample(angle, values(:, point), error)
               if (.not. allocated(error)) call follow_contact(work, samples, angle, left, error)
               if (allocated(error)) return
            end do
            if (samples%cycle%is_linear) call add_trapezoid(panels, left, right, values(:, :2))
            if (.not. samples%cycle%is_linear) call add_panel(panels, left, right, values)
         end do
      end associate
   end subroutine walk_along

   !> Largest central film among the rows of a lobe, over the equivalent radius there.
   pure subroutine find_thickest_film(series, statistics)
      !> List of series, of which the first lobe's stand in the order of every lobe's
      type(quantity_t), intent(in) :: series(:)
      !> Statistics of the lobe, with the rows; out: with the film
      type(statistics_t), intent(inout) :: statistics

      integer :: row

      associate (rows => statistics%rows)
         associate (films => rows%values(find_quantity(series, "film_thickness_central"), :rows%count) &
            & /rows%values(find_quantity(series, "equivalent_radius"), :rows%count))
            row = maxloc(films, 1)
            statistics%thickest_film = films(row)
            statistics%thickest_angle = rows%angle(row)
         end associate
      end associate
   end subroutine find_thickest_film

   !> Have mean and largest film of a lobe a limit?
   elemental function has_film_limit(statistics) result(verdict)
      !> Statistics of the lobe
      type(statistics_t), intent(in) :: statistics
      !> True where they have
      logical :: verdict

      verdict = statistics%thickest_film <= thickest_film .and. statistics%lost_share <= 0.0_wp
   end function has_film_limit

end module camroller_means
