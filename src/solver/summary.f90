!> The summary of a case: means, extremes, losses, slip, margins, work done by the integration.
!>
!> Layer: solver. In: statistics of the cycles. Out: the named scalars of `result_t`.
module camroller_summary
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_case, only : case_t, energy_names
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_cycle, only : cycle_t
   use camroller_catalogue, only : series_values, torque_count
   use camroller_events, only : margin_t, find_margin
   use camroller_means, only : statistics_t
   use camroller_result, only : result_t, quantity_t, find_quantity
   use camroller_shaft, only : shaft_t
   implicit none
   private

   public :: make_summary

   !> Scalars that do not belong to a series: room for them
   integer, parameter :: more_scalars = 43

contains

   !> Fill the summary of a result whose series are there.
   subroutine make_summary(case, models, cycles, shaft, statistics, bearing_torque, result)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> The camshaft
      type(shaft_t), intent(in) :: shaft
      !> Means over the cycle of each lobe shape
      type(statistics_t), intent(in) :: statistics(:)
      !> Mean torque of the camshaft bearings [N m]
      real(wp), intent(in) :: bearing_torque
      !> In: series; out: with the summary
      type(result_t), intent(inout) :: result

      type(quantity_t), allocatable :: quantities(:)
      ! Values of the scalars [unit of the scalar]; means of the series [unit of the series]
      real(wp), allocatable :: values(:), means(:)
      integer :: count, worst

      allocate (quantities(3*size(result%series) + more_scalars), values(3*size(result%series) + more_scalars))
      count = 0
      means = all_means(case, models, shaft, statistics, bearing_torque)
      call add_series_statistics(result, statistics(1), means, quantities, values, count)
      call add_losses(case, result, means, quantities, values, count)
      call add_slip(statistics(1), result, quantities, values, count)
      call add_margins(models(1), statistics(1), result, quantities, values, count)
      call add(quantities, values, count, "estimated_error", "1", &
         & "estimate of the largest error of the sliding speed over its largest value", "numerics", maxval(statistics%error))
      worst = maxloc(statistics%error, 1)
      call add(quantities, values, count, "estimated_error_angle", "deg", "cam angle where the estimated error is largest", &
         & "numerics", modulo(180.0_wp + statistics(worst)%error_angle/degree, 360.0_wp))
      call add(quantities, values, count, "estimated_error_of_means", "1", "estimate of the largest error of a mean over the "// &
         & "mean size of its quantity; of geometric and drive torque, over the mean friction torque", "numerics", &
         & maxval(statistics%mean_error))
      call add_counters(cycles, quantities, values, count)
      result%summary = quantities(:count)
      result%summary_values = values(:count)
   end subroutine make_summary

   !> Means of all series: those of the first follower, with the torques of the whole camshaft.
   pure function all_means(case, models, shaft, statistics, bearing_torque) result(means)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> The camshaft
      type(shaft_t), intent(in) :: shaft
      !> Means over the cycle of each lobe shape
      type(statistics_t), intent(in) :: statistics(:)
      !> Mean torque of the camshaft bearings [N m]
      real(wp), intent(in) :: bearing_torque
      !> Means [unit of the series]
      real(wp), allocatable :: means(:)

      type(state_t) :: nothing
      ! Mean torques of all followers [N m]; series with these torques and nothing else; those of the first follower alone
      real(wp) :: torques(torque_count), with_all(size(statistics(1)%mean)), with_first(size(statistics(1)%mean))
      integer :: cam

      torques = 0.0_wp
      do cam = 1, size(shaft%lobes)
         torques = torques + statistics(shaft%lobes(cam))%torques
      end do
      call clear(nothing)
      call series_values(case, models(1), nothing, torques, bearing_torque, with_all)
      call series_values(case, models(1), nothing, statistics(1)%torques, 0.0_wp, with_first)
      means = statistics(1)%mean + (with_all - with_first)
   end function all_means

   !> A state whose series are all zero.
   pure subroutine clear(state)
      !> The state
      type(state_t), intent(out) :: state

      state%position%lift = 0.0_wp
      state%position%lift_slope = 0.0_wp
      state%position%equivalent_radius = 1.0_wp
      state%contact%load = 0.0_wp
      state%contact%cam_surface_speed = 0.0_wp
      state%contact%rolling_speed = 0.0_wp
      state%contact%roller_surface_speed = 0.0_wp
      state%contact%roller_spin = 0.0_wp
      state%contact%sliding_speed = 0.0_wp
      state%contact%entrainment_speed = 0.0_wp
      state%contact%half_width = 0.0_wp
      state%contact%film_min = 0.0_wp
      state%contact%film_central = 0.0_wp
      state%contact%film_ratio = 0.0_wp
      state%contact%asperity_load = 0.0_wp
      state%contact%real_area = 0.0_wp
      state%contact%shear = 0.0_wp
      state%contact%boundary_capacity = 0.0_wp
      state%contact%boundary_mobilised = 0.0_wp
      state%contact%rolling_resistance = 0.0_wp
      state%contact%traction = 0.0_wp
      state%contact_friction = 0.0_wp
      state%boundary_friction = 0.0_wp
   end subroutine clear

   !> Mean, smallest and largest value of every series.
   subroutine add_series_statistics(result, statistics, means, quantities, values, count)
      !> Series
      type(result_t), intent(in) :: result
      !> Extremes met while integrating
      type(statistics_t), intent(in) :: statistics
      !> Means [unit of the series]
      real(wp), intent(in) :: means(:)
      !> List of scalars
      type(quantity_t), intent(inout) :: quantities(:)
      !> Their values [unit of the scalar]
      real(wp), intent(inout) :: values(:)
      !> Scalars so far
      integer, intent(inout) :: count

      ! Smallest and largest value [unit of the series]
      real(wp) :: lowest, highest
      integer :: i, first_torque

      first_torque = find_quantity(result%series, "torque_geometric")
      do i = 1, size(result%series)
         lowest = minval(result%series_values(:, i))
         highest = maxval(result%series_values(:, i))
         if (i < first_torque) then
            lowest = min(lowest, statistics%lowest(i))
            highest = max(highest, statistics%highest(i))
         end if
         associate (series => result%series(i))
            call add(quantities, values, count, "mean_"//series%name, series%unit, "mean over the cycle: "// &
               & series%description, series%source, means(i))
            call add(quantities, values, count, "min_"//series%name, series%unit, "smallest value: "//series%description, &
               & series%source, lowest)
            call add(quantities, values, count, "max_"//series%name, series%unit, "largest value: "//series%description, &
               & series%source, highest)
         end associate
      end do
   end subroutine add_series_statistics

   !> Loss of each source as power and as energy per cam revolution.
   subroutine add_losses(case, result, means, quantities, values, count)
      !> The case
      type(case_t), intent(in) :: case
      !> Series
      type(result_t), intent(in) :: result
      !> Means [unit of the series]
      real(wp), intent(in) :: means(:)
      !> List of scalars
      type(quantity_t), intent(inout) :: quantities(:)
      !> Their values [unit of the scalar]
      real(wp), intent(inout) :: values(:)
      !> Scalars so far
      integer, intent(inout) :: count

      character(len=*), parameter :: sources(*) = [character(len=8) :: "contact", "needle", "guide", "bearings", "friction"]
      integer :: i, series

      do i = 1, size(sources)
         series = find_quantity(result%series, "torque_"//trim(sources(i)))
         if (series == 0) cycle
         associate (source => result%series(series)%source)
            call add(quantities, values, count, "power_"//trim(sources(i)), "W", "mean power lost, "//trim(sources(i)), source, &
               & means(series)*case%operating_point%speed)
            call add(quantities, values, count, "work_"//trim(sources(i)), "J", "energy lost per cam revolution, "// &
               & trim(sources(i)), source, means(series)*two_pi)
         end associate
      end do
      if (case%energy /= energy_names(1)) return
      series = find_quantity(result%series, "energy_residual")
      call add(quantities, values, count, "relative_energy_residual", "1", &
         & "largest energy residual over mean power lost", "torque", maxval(abs(result%series_values(:, series))) &
         & /max(tiny(1.0_wp), case%operating_point%speed*means(find_quantity(result%series, "torque_friction"))))
   end subroutine add_losses

   !> Slip over the whole revolution.
   subroutine add_slip(statistics, result, quantities, values, count)
      !> Means over the cycle of the first follower
      type(statistics_t), intent(in) :: statistics
      !> Series
      type(result_t), intent(in) :: result
      !> List of scalars
      type(quantity_t), intent(inout) :: quantities(:)
      !> Their values [unit of the scalar]
      real(wp), intent(inout) :: values(:)
      !> Scalars so far
      integer, intent(inout) :: count

      ! Means of sliding speed and speed of pure rolling [m/s]
      real(wp) :: sliding, rolling

      sliding = statistics%mean(find_quantity(result%series, "sliding_speed"))
      rolling = statistics%mean(find_quantity(result%series, "rolling_speed"))
      call add(quantities, values, count, "revolution_slip", "1", &
         & "part of its turns in pure rolling that the roller loses per cam revolution", "roller", sliding/rolling)
      call add(quantities, values, count, "entrainment_reversals", "1", &
         & "times per cam revolution that the entrainment speed changes its sign in contact; the smallest film is that of the "// &
         & "standstill there", "film", real(statistics%standstills, wp))
   end subroutine add_slip

   !> Margins: contact, range of the film law.
   subroutine add_margins(model, statistics, result, quantities, values, count)
      !> Model of the first lobe
      type(model_t), intent(in) :: model
      !> Means over the cycle of the first follower
      type(statistics_t), intent(in) :: statistics
      !> Series
      type(result_t), intent(in) :: result
      !> List of scalars
      type(quantity_t), intent(inout) :: quantities(:)
      !> Their values [unit of the scalar]
      real(wp), intent(inout) :: values(:)
      !> Scalars so far
      integer, intent(inout) :: count

      type(margin_t) :: margin

      if (size(result%angle) == 0) return
      call find_margin(model, margin)
      call add(quantities, values, count, "spring_margin", "N", &
         & "smallest contact load without friction; negative where contact is lost", "dynamics", margin%smallest_load)
      call add(quantities, values, count, "contact_loss_speed", "rad s-1", &
         & "cam speed at which contact is first lost, without friction; infinite if never", "dynamics", margin%contact_loss_speed)
      call add(quantities, values, count, "lost_contact_share", "1", "part of the cycle without contact", "dynamics", &
         & statistics%lost_share)
      call add(quantities, values, count, "outside_film_range_share", "1", &
         & "part of the cycle outside the film law's published range", "film", statistics%outside_share)
      if (.not. allocated(model%film_table)) return
      call add(quantities, values, count, "film_table_error", "1", &
         & "largest error of the film: of the polynomials of its table, and of the solutions at its points", "film", &
         & model%film_table%error)
   end subroutine add_margins

   !> Work done by the integration, all lobe shapes together.
   subroutine add_counters(cycles, quantities, values, count)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> List of scalars
      type(quantity_t), intent(inout) :: quantities(:)
      !> Their values [unit of the scalar]
      real(wp), intent(inout) :: values(:)
      !> Scalars so far
      integer, intent(inout) :: count

      call add(quantities, values, count, "counter_evaluations", "1", "evaluations of the roller equation", "numerics", &
         & real(sum(cycles%counters%evaluations), wp))
      call add(quantities, values, count, "counter_jacobians", "1", "Jacobians of the roller equation", "numerics", &
         & real(sum(cycles%counters%jacobians), wp))
      call add(quantities, values, count, "counter_steps", "1", "accepted steps", "numerics", &
         & real(sum(cycles%counters%accepted), wp))
      call add(quantities, values, count, "counter_rejected", "1", "rejected steps", "numerics", &
         & real(sum(cycles%counters%rejected), wp))
      call add(quantities, values, count, "counter_cycles", "1", "cycles integrated until periodic", "numerics", &
         & real(maxval(cycles%cycles), wp))
      call add(quantities, values, count, "periodicity", "1", &
         & "difference of the sliding speed between end and start over its largest value", "numerics", maxval(cycles%closure))
   end subroutine add_counters

   !> Append a scalar.
   subroutine add(quantities, values, count, name, unit, description, source, value)
      !> List of scalars
      type(quantity_t), intent(inout) :: quantities(:)
      !> Their values [unit of the scalar]
      real(wp), intent(inout) :: values(:)
      !> Scalars so far
      integer, intent(inout) :: count
      !> Name, unit, meaning, part of the model
      character(len=*), intent(in) :: name, unit, description, source
      !> Value [unit of the scalar]
      real(wp), intent(in) :: value

      count = count + 1
      quantities(count)%name = name
      quantities(count)%unit = unit
      quantities(count)%description = description
      quantities(count)%source = source
      values(count) = value
   end subroutine add

end module camroller_summary
