!> What the camshafts mean for their engine: friction mean effective pressures, harmonics of the drive torque, crank angles.
!>
!> In: mean torques, and the drive torque over one turn of the camshaft, which is one working cycle. Out: scalars of the summary.
module camroller_engine_summary
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_case, only : case_t
   use camroller_engine, only : cam_turns, crank_angle_at_nose
   use camroller_number_text, only : integer_text
   use camroller_result, only : result_t, quantity_list_t, append_quantity, find_quantity, scope_engine
   use camroller_torque_list, only : torque_list, torque_count, is_loss
   implicit none
   private

   public :: add_engine_scalars

   !> Harmonics of the drive torque that are listed
   integer, parameter :: most_harmonics = 12
contains

   !> Scalars of the engine; none where the case has no engine or no camshaft bearings, without which it has one cam only.
   subroutine add_engine_scalars(list, case, result, means)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case
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
         call add("torque_drive_harmonic_"//integer_text(i), "N m", "amplitude of harmonic "//integer_text(i)// &
            & " of the turn of the camshaft in the drive torque", "torque", amplitude)
      end do
      call add("crank_turns", "1", "turns of the crankshaft in one of the camshaft", "engine", cam_turns(case%engine))
      call add("crank_angle_at_nose", "degree", "crank angle after the firing dead centre of cylinder 1 at cam angle 180, "// &
         & "where the first cam is at full lift", "engine", crank_angle_at_nose(case%engine, case%cam_bearings%cam_lobes)/degree)

   contains

      !> Friction mean effective pressure of a loss, where the case has it.
      subroutine add_pressure(loss)
         !> Name of the loss
         character(len=*), intent(in) :: loss

         series = find_quantity(result%series, "torque_"//loss)
         if (series > 0) call add("fmep_"//loss, "Pa", "friction mean effective pressure of the valve trains, "//loss, &
            & result%series(series)%source, two_pi*means(series)/case%engine%displacement)
      end subroutine add_pressure

      !> Add a scalar.
      subroutine add(name, unit, description, source, value)
         !> Name, unit, meaning, part of the model
         character(len=*), intent(in) :: name, unit, description, source
         !> Its value [unit of the scalar]
         real(wp), intent(in) :: value

         call append_quantity(list, name, unit, description, source, value, scope_engine)
      end subroutine add

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

end module camroller_engine_summary
