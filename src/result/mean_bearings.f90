!> Mean torque of the camshaft bearings.
!>
!> In: the camshafts with the cycles of their lobe shapes. Out: the mean over a turn to the tolerance of the cycles, those of the
!> series of each bearing, an estimate of their error, and the series of the camshafts at the angles evaluated.
module camroller_mean_bearings
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_catalogue, only : camshaft_columns, camshaft_count, camshaft_values
   use camroller_extremes, only : samples_t, start_samples, add_sample, move_samples
   use camroller_means, only : mean_tolerance, most_halvings, quadrature_part
   use camroller_panels, only : sampled_t, panels_t, start_panels, sample_panel, refine_panels
   use camroller_result, only : quantity_t
   use camroller_part_series, only : bearing_count
   use camroller_shaft, only : shaft_stops, solved_t, shaft_torques
   use camroller_torque_list, only : torque_count, torque_series, of_bearings
   implicit none
   private

   public :: mean_bearing_torque

   !> Longest panel [rad]
   real(wp), parameter :: longest_panel = 15.0_wp*degree

   !> Bearings of a camshaft on its turn
   type, extends(sampled_t) :: bearing_samples_t
      type(solved_t), pointer :: solved => null()
      !> Series of the camshaft at the angles evaluated, and their number
      type(samples_t) :: rows
      integer :: series = 0
      !> Those of them that are of single bearings, the last ones
      integer :: of_bearings = 0
      logical :: keeps_rows = .true.
   contains
      procedure :: sample => sample_bearings
   end type bearing_samples_t

contains

   !> Mean torque of the bearings of each camshaft, and means of the series of single bearings, over panels that end at the stops
   !> of every cam.
   subroutine mean_bearing_torque(solved, series, single, mean, mean_error, worst, rows, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout), target :: solved
      !> All series of the case
      type(quantity_t), intent(in) :: series(:)
      !> Means of the series of single bearings, as many as there are [unit of the series]
      real(wp), intent(out) :: single(:)
      !> Mean torque of each camshaft [N m]
      real(wp), intent(out) :: mean(:)
      !> Largest estimate of the error relative to the mean magnitude [-]
      real(wp), intent(out) :: mean_error
      !> Name of the series that this is the error of
      character(len=*), intent(out) :: worst
      !> Series of the camshaft at the angles evaluated
      type(samples_t), intent(out) :: rows
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(bearing_samples_t) :: samples
      type(panels_t) :: panels
      ! Stops of all cams [rad]
      real(wp), allocatable :: stops(:)
      ! Length of a panel [rad]
      real(wp) :: length
      ! Error estimates allowed [unit of each times rad], errors relative to the mean magnitudes [-]
      real(wp), dimension(size(mean) + size(single)) :: allowed, errors
      integer :: segment, count, panel, halvings, columns(2), place

      mean = 0.0_wp
      mean_error = 0.0_wp
      samples%solved => solved
      samples%series = camshaft_count(solved%case)
      samples%of_bearings = size(single)
      call start_samples(samples%rows, samples%series)
      stops = shaft_stops(solved, spread(.true., 1, size(solved%shaft%lobes)))
      call start_panels(panels, size(allowed), 2*size(stops) + ceiling(two_pi/longest_panel))
      do segment = 1, size(stops) - 1
         count = ceiling((stops(segment + 1) - stops(segment))/longest_panel)
         if (count == 0) cycle
         length = (stops(segment + 1) - stops(segment))/count
         do panel = 1, count
            call sample_panel(panels, samples, stops(segment) + (panel - 1)*length, stops(segment) + panel*length, error)
            if (allocated(error)) return
         end do
      end do
      ! Not those of halved panels: what bearings ask for changes nothing but their own torque
      call move_samples(samples%rows, rows)
      samples%keeps_rows = .false.
      halvings = most_halvings
      allowed = max(quadrature_part*mean_tolerance(maxval(solved%cycles%tolerance))*sum(panels%sizes(:, :panels%count), 2), &
         & tiny(1.0_wp))
      ! First for the torque alone, which is the same whether or not single bearings have series
      call refine_panels(panels, samples, [allowed(:size(mean)), spread(huge(1.0_wp), 1, size(single))], halvings, error)
      if (allocated(error)) return
      mean = sum(panels%integrals(:size(mean), :panels%count), 2)/two_pi
      errors = sum(panels%errors(:, :panels%count), 2)/max(sum(panels%sizes(:, :panels%count), 2), tiny(1.0_wp))
      mean_error = maxval(errors(:size(mean)))
      worst = torque_series(of_bearings)
      if (size(single) == 0) return
      call refine_panels(panels, samples, allowed, halvings, error)
      if (allocated(error)) return
      single = sum(panels%integrals(size(mean) + 1:, :panels%count), 2)/two_pi
      errors = sum(panels%errors(:, :panels%count), 2)/max(sum(panels%sizes(:, :panels%count), 2), tiny(1.0_wp))
      if (maxval(errors(size(mean) + 1:)) <= mean_error) return
      columns = camshaft_columns(solved%case)
      place = maxloc(errors(size(mean) + 1:), 1)
      mean_error = errors(size(mean) + place)
      worst = series(columns(2) - size(single) + place)%name
   end subroutine mean_bearing_torque

   !> Torque of the bearings of each camshaft at a cam angle, and series of single bearings.
   subroutine sample_bearings(self, x, values, error)
      !> The shaft with its cycles
      class(bearing_samples_t), intent(inout) :: self
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: x
      !> The torques [N m], the series [unit of each]
      real(wp), intent(out) :: values(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      ! Torques on each camshaft [N m]
      real(wp) :: torques(torque_count, self%solved%shaft%count)
      ! Series of the camshafts [unit of the series]
      real(wp) :: series(self%series)
      type(bearing_state_t), allocatable :: bearings(:, :)

      if (self%of_bearings > 0) allocate (bearings(bearing_count(self%solved%case), self%solved%shaft%count))
      call shaft_torques(self%solved, x, torques, error, bearings=bearings)
      if (allocated(error)) return
      values(:size(torques, 2)) = torques(of_bearings, :)
      if (self%of_bearings == 0 .and. .not. self%keeps_rows) return
      call camshaft_values(self%solved%case, torques, series, bearings, self%solved%shaft%has_torque)
      values(size(torques, 2) + 1:) = series(self%series - self%of_bearings + 1:)
      if (self%keeps_rows) call add_sample(self%rows, x, series, .false.)
   end subroutine sample_bearings

end module camroller_mean_bearings
