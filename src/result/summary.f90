!> The summary of a case: means, extremes, losses, slip, margins, what the camshafts mean for their engine, work done by the
!> integration.
!>
!> In: statistics of the cycles. Out: the named scalars of `result_t`.
module camroller_summary
   use camroller_cam_angle, only : file_angle
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_case, only : case_t, energy_names, has_engine
   use camroller_model, only : model_t
   use camroller_cycle, only : cycle_t
   use camroller_flexible_report, only : add_outlook, add_train_scalars
   use camroller_catalogue, only : camshaft_columns, camshaft_values, lobe_columns, lobe_prefix
   use camroller_torque_list, only : torque_list, torque_count, is_loss, of_bearings, of_residual, of_shaft_drag, &
      & torque_series
   use camroller_engine, only : cam_turns, crank_angle_at_nose
   use camroller_margins, only : margin_t, margins_t
   use camroller_means, only : statistics_t
   use camroller_number_text, only : integer_text
   use camroller_result, only : result_t, quantity_list_t, add => append_quantity, find_quantity, is_film, lobe_scope, &
      & scope_camshaft, scope_engine, scope_length, take_quantities
   use camroller_series_extremes, only : series_extremes_t
   use camroller_shaft, only : solved_t
   implicit none
   private

   public :: make_summary, slip_meaning

   !> What slip over a turn is, in a summary and in the table of an audit
   character(len=*), parameter :: slip_meaning = "slip per cam revolution, relative to the turns of the roller in pure rolling"
   !> Harmonics of the drive torque that are listed
   integer, parameter :: most_harmonics = 12

contains

   !> Fill the summary of a result whose series are there.
   subroutine make_summary(solved, statistics, bearing_torque, of_bearings, margins, extremes, result)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Means over the cycle of each lobe shape
      type(statistics_t), intent(in) :: statistics(:)
      !> Mean torque of the bearings of each camshaft [N m]
      real(wp), intent(in) :: bearing_torque(:)
      !> Means of the series of single bearings [unit of each]
      real(wp), intent(in) :: of_bearings(:)
      !> Margins of each lobe shape
      type(margins_t), intent(in) :: margins(:)
      !> Extremes of the series
      type(series_extremes_t), intent(in) :: extremes
      !> In: series; out: with the summary
      type(result_t), intent(inout) :: result

      type(quantity_list_t) :: list
      ! Means of the series [unit of the series]
      real(wp), allocatable :: means(:)
      integer :: columns(2), worst, lobe

      allocate (list%items(0), list%values(0))
      means = all_means(solved, result, statistics, bearing_torque)
      columns = camshaft_columns(solved%case)
      means(columns(2) - size(of_bearings) + 1:columns(2)) = of_bearings
      call add_series_statistics(result, extremes, means, list)
      call add_losses(solved%case, result, means, extremes, list)
      call add_engine_scalars(list, solved%case, result, means)
      do lobe = 1, size(solved%models)
         call add_slip(lobe, result, means, statistics(lobe), list)
         call add_margins(lobe, margins(lobe), extremes%event_load(lobe), list)
         call add_outlook(list, solved%models(lobe), trim(lobe_prefix(lobe)), lobe_scope(lobe))
         call add_shares(lobe, solved%models(lobe), statistics(lobe), list)
         if (allocated(solved%cycles(lobe)%flexible)) call add_train_scalars(list, solved%models(lobe), &
            & solved%cycles(lobe)%flexible, trim(lobe_prefix(lobe)), lobe_scope(lobe))
      end do
      call add(list, "estimated_error", "1", &
         & "estimate of the largest error of the sliding speed relative to its largest value (at least 1e-5 of the largest "// &
         & "speed in pure rolling)", "numerics", maxval(statistics%error))
      worst = maxloc(statistics%error, 1)
      call add(list, "estimated_error_angle", "degree", "cam angle where the estimated error is largest", &
         & "numerics", file_angle(statistics(worst)%error_angle))
      call add(list, "estimated_error_of_means", "1", "estimate of the largest error of a mean relative "// &
         & "to the mean magnitude of its quantity, of geometric and drive torque relative to the mean friction torque; "// &
         & "without films where contact is lost; without a period also what other turns would change", "numerics", &
         & maxval(statistics%mean_error))
      call add(list, "estimated_error_of_extremes", "1", "estimate of the largest error of a smallest or "// &
         & "largest value, of the smallest contact load of the event too, relative to the range of its series, of a torque "// &
         & "to that of the friction torque where it is larger, "// &
         & "of the smallest film relative to itself; without films where contact is lost", "numerics", &
         & maxval(statistics%extreme_error))
      call add_counters(solved%cycles, list)
      result%summary_values = list%values(:list%count)
      call take_quantities(list, result%summary)
   end subroutine make_summary

   !> Means of all series: those of each lobe's follower, and the torques of the whole camshaft.
   pure function all_means(solved, result, statistics, bearing_torque) result(means)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Series
      type(result_t), intent(in) :: result
      !> Means over the cycle of each lobe shape
      type(statistics_t), intent(in) :: statistics(:)
      !> Mean torque of the bearings of each camshaft [N m]
      real(wp), intent(in) :: bearing_torque(:)
      !> Means [unit of the series]
      real(wp) :: means(size(result%series))

      ! Mean torques on each camshaft, and those of the first follower alone [N m]; the camshafts' series with each
      real(wp), dimension(torque_count, solved%shaft%count) :: torques, first
      real(wp), allocatable :: with_all(:), with_first(:)
      integer :: cam, lobe, columns(2)

      torques = 0.0_wp
      do cam = 1, size(solved%shaft%lobes)
         torques(:, solved%shaft%shafts(cam)) = torques(:, solved%shaft%shafts(cam)) + statistics(solved%shaft%lobes(cam))%torques
      end do
      first = 0.0_wp
      first(:, 1) = statistics(1)%torques
      do lobe = 1, size(statistics)
         columns = lobe_columns(solved%case, lobe)
         means(columns(1):columns(2)) = statistics(lobe)%mean(:columns(2) - columns(1) + 1)
      end do
      columns = camshaft_columns(solved%case)
      allocate (with_all(columns(2) - columns(1) + 1), with_first(columns(2) - columns(1) + 1))
      torques(of_bearings, :) = bearing_torque
      torques(of_shaft_drag, :) = solved%shaft%drag
      call camshaft_values(solved%case, torques, with_all)
      call camshaft_values(solved%case, first, with_first)
      means(columns(1):columns(2)) = statistics(1)%mean(columns(1):columns(2)) + (with_all - with_first)
   end function all_means

   !> Mean, smallest and largest value of every series.
   subroutine add_series_statistics(result, extremes, means, list)
      !> Series
      type(result_t), intent(in) :: result
      !> Extremes of the series
      type(series_extremes_t), intent(in) :: extremes
      !> Means [unit of the series]
      real(wp), intent(in) :: means(:)
      !> List of scalars
      type(quantity_list_t), intent(inout) :: list

      integer :: i

      do i = 1, size(result%series)
         associate (series => result%series(i))
            call add(list, "mean_"//series%name, series%unit, "mean over the cycle: "// &
               & series%description, series%source, means(i), series%scope)
            call add(list, "min_"//series%name, series%unit, "smallest value"//trim(merge(" with contact: ", &
               & ":              ", is_film(series)))//" "//series%description, series%source, extremes%lowest(i), series%scope)
            call add(list, "max_"//series%name, series%unit, "largest value: "//series%description, &
               & series%source, extremes%highest(i), series%scope)
         end associate
      end do
   end subroutine add_series_statistics

   !> Loss of each source as power and as energy per cam revolution.
   subroutine add_losses(case, result, means, extremes, list)
      type(case_t), intent(in) :: case
      !> Series
      type(result_t), intent(in) :: result
      !> Means [unit of the series]
      real(wp), intent(in) :: means(:)
      !> Smallest and largest value of each series
      type(series_extremes_t), intent(in) :: extremes
      !> List of scalars
      type(quantity_list_t), intent(inout) :: list

      character(len=scope_length) :: scope
      integer :: i, series

      scope = merge(scope_engine, scope_camshaft, has_engine(case))
      do i = 1, torque_count
         if (is_loss(i)) call add_loss(trim(torque_list(i)%name))
      end do
      call add_loss("friction")
      if (case%energy /= energy_names(1)) return
      series = find_quantity(result%series, trim(torque_series(of_residual)))
      call add(list, "relative_energy_residual", "1", &
         & "largest energy residual relative to the mean power lost", "torque", &
         & max(-extremes%lowest(series), extremes%highest(series)) &
         & /max(tiny(1.0_wp), case%operating_point%speed*means(find_quantity(result%series, "torque_friction"))), &
         & scope)

   contains

      !> Power and energy of a loss, where the case has it.
      subroutine add_loss(loss)
         !> Its name
         character(len=*), intent(in) :: loss

         series = find_quantity(result%series, "torque_"//loss)
         if (series == 0) return
         associate (source => result%series(series)%source)
            call add(list, "power_"//loss, "W", "mean power lost, "//loss, source, means(series)*case%operating_point%speed, &
               & scope)
            call add(list, "work_"//loss, "J", "energy lost per cam revolution, "//loss, source, means(series)*two_pi, &
               & scope)
         end associate
      end subroutine add_loss

   end subroutine add_losses

   !> Scalars of the engine; none where the case has no engine or no camshaft bearings, without which it has one cam only.
   subroutine add_engine_scalars(list, case, result, means)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      !> Series
      type(result_t), intent(in) :: result
      !> Means of the series [unit of the series]
      real(wp), intent(in) :: means(:)

      ! Amplitude of a harmonic [N m]
      real(wp) :: amplitude
      integer :: i, series

      if (.not. allocated(case%engine) .or. .not. allocated(case%cam_bearings)) return
      do i = 1, torque_count
         if (is_loss(i)) call add_pressure(trim(torque_list(i)%name))
      end do
      call add_pressure("friction")
      series = find_quantity(result%series, "torque_drive")
      do i = 1, most_harmonics
         if (2*i >= size(result%angle)) exit
         call get_amplitude(result%series_values(:, series), i, amplitude)
         call add_scalar("torque_drive_harmonic_"//integer_text(i), "N m", "amplitude of harmonic "//integer_text(i)// &
            & " of the turn of the camshaft in the drive torque", "torque", amplitude)
      end do
      call add_scalar("crank_turns", "1", "turns of the crankshaft in one of the camshaft", "engine", cam_turns(case%engine))
      call add_scalar("crank_angle_at_nose", "degree", "crank angle after the firing dead centre of cylinder 1 at cam angle "// &
         & "180, where the first cam is at full lift", "engine", &
         & crank_angle_at_nose(case%engine, case%cam_bearings%cam_lobes)/degree)

   contains

      !> Friction mean effective pressure of a loss, where the case has it.
      subroutine add_pressure(loss)
         !> Name of the loss
         character(len=*), intent(in) :: loss

         series = find_quantity(result%series, "torque_"//loss)
         if (series > 0) call add_scalar("fmep_"//loss, "Pa", "friction mean effective pressure of the valve trains, "//loss, &
            & result%series(series)%source, two_pi*means(series)/case%engine%displacement)
      end subroutine add_pressure

      !> Add a scalar.
      subroutine add_scalar(name, unit, description, source, value)
         !> Name, unit, meaning, part of the model
         character(len=*), intent(in) :: name, unit, description, source
         !> Its value [unit of the scalar]
         real(wp), intent(in) :: value

         call add(list, name, unit, description, source, value, scope_engine)
      end subroutine add_scalar

   end subroutine add_engine_scalars

   !> Amplitude of a harmonic of what is sampled at equal distances over one turn.
   pure subroutine get_amplitude(samples, harmonic, amplitude)
      !> The samples [any]
      real(wp), intent(in) :: samples(:)
      !> The harmonic, from 1, fewer than half the samples
      integer, intent(in) :: harmonic
      !> Its amplitude [any]
      real(wp), intent(out) :: amplitude

      ! Angles of the harmonic [rad]
      real(wp) :: angles(size(samples))
      integer :: i

      angles = [(two_pi*modulo(real(harmonic, wp)*(i - 1), real(size(samples), wp))/size(samples), i=1, size(samples))]
      amplitude = 2.0_wp/size(samples)*hypot(sum(samples*cos(angles)), sum(samples*sin(angles)))
   end subroutine get_amplitude

   !> Slip of a lobe's follower over the whole revolution.
   subroutine add_slip(lobe, result, means, statistics, list)
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> Series
      type(result_t), intent(in) :: result
      !> Means [unit of the series]
      real(wp), intent(in) :: means(:)
      !> Means over the lobe's cycle
      type(statistics_t), intent(in) :: statistics
      !> List of scalars
      type(quantity_list_t), intent(inout) :: list

      ! Means of sliding speed and speed of pure rolling [m/s]
      real(wp) :: sliding, rolling

      sliding = means(find_quantity(result%series, trim(lobe_prefix(lobe))//"sliding_speed"))
      rolling = means(find_quantity(result%series, trim(lobe_prefix(lobe))//"rolling_speed"))
      call add(list, trim(lobe_prefix(lobe))//"revolution_slip", "1", slip_meaning, "roller", sliding/rolling, lobe_scope(lobe))
      call add(list, trim(lobe_prefix(lobe))//"entrainment_reversals", "1", &
         & "times per cam revolution that the entrainment speed passes through zero in contact or stays there; the smallest "// &
         & "film is then that of a standstill", "film", real(statistics%standstills, wp), lobe_scope(lobe))
   end subroutine add_slip

   !> Margins of a lobe against loss of contact and opening of the pivot's joint.
   subroutine add_margins(lobe, margins, event_load, list)
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      type(margins_t), intent(in) :: margins
      !> Smallest contact load with the valve off its seat [N]
      real(wp), intent(in) :: event_load
      !> List of scalars
      type(quantity_list_t), intent(inout) :: list

      integer :: first, i

      first = list%count + 1
      call add(list, "spring_margin", "N", &
         & "smaller of margin_event and margin_base_circle; negative where contact is lost", "dynamics", &
         & min(margins%event%force, margins%base_circle%force))
      call add(list, "contact_loss_speed", "rad s-1", &
         & "cam speed at which contact is first lost, without friction; infinite if never", "dynamics", &
         & min(margins%event%speed, margins%base_circle%speed))
      call add_margin("event", "contact load with the valve off its seat", margins%event)
      call add(list, "min_event_contact_load", "N", &
         & "smallest contact load with the valve off its seat, with friction; zero where contact is lost", "dynamics", event_load)
      call add_margin("base_circle", "contact load with the valve on its seat or about to leave or reach it", margins%base_circle)
      if (allocated(margins%pivot)) then
         call add_margin("pivot", "force in the joint of finger and pivot with the valve off its seat", margins%pivot)
         if (margins%may_have_adjuster) then
            call add(list, "adjuster_force", "N", &
               & "force of the lash adjuster that makes the base circle load", "dynamics", margins%adjuster_force)
            call add(list, "pump_up_speed", "rad s-1", "cam speed at which the force in the pivot's joint "// &
               & "first falls to the adjuster's, which then follows; without friction, infinite if never", "dynamics", &
               & margins%pump_up_speed)
         end if
      end if
      if (allocated(margins%seat)) call add(list, "margin_seat", "N", "smallest force between the valve and its seat on the "// &
         & "base circle; negative where gas lifts it off", "gas_force", margins%seat%force)
      do i = first, list%count
         list%items(i)%name = trim(lobe_prefix(lobe))//list%items(i)%name
         list%items(i)%scope = lobe_scope(lobe)
         list%items(i)%may_be_infinite = list%items(i)%unit == "rad s-1"
      end do

   contains

      !> Force, angle and speed of one margin.
      subroutine add_margin(name, force, margin)
         !> What the margin is of, and its force in words
         character(len=*), intent(in) :: name, force
         type(margin_t), intent(in) :: margin

         call add(list, "margin_"//name, "N", "smallest "//force//", without friction", "dynamics", &
            & margin%force)
         call add(list, "margin_"//name//"_angle", "degree", "cam angle of margin_"//name, "dynamics", &
            & file_angle(margin%angle))
         call add(list, "margin_"//name//"_speed", "rad s-1", "cam speed at which margin_"//name// &
            & " is zero; infinite if never", "dynamics", margin%speed)
      end subroutine add_margin

   end subroutine add_margins

   !> Fractions of the cycle without contact and outside the film law's range, and the error of the film table.
   subroutine add_shares(lobe, model, statistics, list)
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      type(model_t), intent(in) :: model
      !> Means over its cycle
      type(statistics_t), intent(in) :: statistics
      !> List of scalars
      type(quantity_list_t), intent(inout) :: list

      call add(list, trim(lobe_prefix(lobe))//"lost_contact_share", "1", &
         & "fraction of the cycle without contact", "dynamics", statistics%lost_share, lobe_scope(lobe))
      call add(list, trim(lobe_prefix(lobe))//"outside_film_range_share", "1", &
         & "fraction of the cycle outside the film law's published range", "film", statistics%film_range%share, lobe_scope(lobe))
      if (.not. allocated(model%film_table)) return
      call add(list, trim(lobe_prefix(lobe))//"film_table_error", "1", &
         & "largest error of the film: of the polynomials of its table, and of the solutions at its points", "film", &
         & model%film_table%error, lobe_scope(lobe))
   end subroutine add_shares

   !> Work done by the integration, all lobe shapes together.
   subroutine add_counters(cycles, list)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> List of scalars
      type(quantity_list_t), intent(inout) :: list

      call add(list, "counter_evaluations", "1", "evaluations of the roller equation", "numerics", &
         & real(sum(cycles%counters%evaluations), wp))
      call add(list, "counter_jacobians", "1", "Jacobians of the roller equation", "numerics", &
         & real(sum(cycles%counters%jacobians), wp))
      call add(list, "counter_steps", "1", "accepted steps", "numerics", &
         & real(sum(cycles%counters%accepted), wp))
      call add(list, "counter_rejected", "1", "rejected steps", "numerics", &
         & real(sum(cycles%counters%rejected), wp))
      call add(list, "counter_cycles", "1", "cycles integrated until periodic", "numerics", &
         & real(maxval(cycles%cycles), wp))
      call add(list, "periodicity", "1", &
         & "difference of the sliding speed between end and start, relative to the largest", "numerics", maxval(cycles%closure))
   end subroutine add_counters

end module camroller_summary
