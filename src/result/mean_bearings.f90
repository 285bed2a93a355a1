!> Mean torque of the camshaft bearings.
!>
!> In: the camshafts with the cycles of their lobe shapes. Out: the mean over a turn to the tolerance of the cycles, an estimate of
!> its error, and the series of the camshafts at the angles evaluated.
module camroller_mean_bearings
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_catalogue, only : camshaft_count, camshaft_values
   use camroller_events, only : cycle_stops
   use camroller_extremes, only : samples_t, start_samples, add_sample
   use camroller_means, only : mean_tolerance, most_halvings
   use camroller_panels, only : sampled_t, panels_t, start_panels, sample_panel, refine_panels
   use camroller_shaft, only : solved_t, shaft_torques
   use camroller_torque_list, only : torque_count, of_bearings
   implicit none
   private

   public :: mean_bearing_torque

   !> Longest panel [rad]
   real(wp), parameter :: longest_panel = 10.0_wp*degree

   !> Bearings of a camshaft on its turn
   type, extends(sampled_t) :: bearing_samples_t
      type(solved_t), pointer :: solved => null()
      !> Series of the camshaft at the angles evaluated, and their number
      type(samples_t) :: rows
      integer :: series = 0
   contains
      procedure :: sample => sample_bearings
   end type bearing_samples_t

contains

   !> Mean torque of the bearings of each camshaft, over panels that end at the stops of every cam.
   subroutine mean_bearing_torque(solved, mean, mean_error, rows, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout), target :: solved
      !> Mean torque of each camshaft [N m]
      real(wp), intent(out) :: mean(:)
      !> Largest estimate of the error relative to the mean [-]
      real(wp), intent(out) :: mean_error
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
      integer :: cam, segment, count, panel, halvings

      mean = 0.0_wp
      mean_error = 0.0_wp
      samples%solved => solved
      samples%series = camshaft_count(solved%case)
      call start_samples(samples%rows, samples%series)
      allocate (stops(0))
      do cam = 1, size(solved%shaft%lobes)
         stops = [stops, solved%cycles(solved%shaft%lobes(cam))%stops + solved%shaft%phases(cam)]
      end do
      stops = cycle_stops(stops, solved%cycles(solved%shaft%lobes(1))%start)
      call start_panels(panels, solved%shaft%count, 2*size(stops) + ceiling(two_pi/longest_panel))
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
      rows = samples%rows
      halvings = most_halvings
      call refine_panels(panels, samples, mean_tolerance(maxval(solved%cycles%tolerance)) &
         & *sum(panels%sizes(:, :panels%count), 2), halvings, error)
      if (allocated(error)) return
      mean = sum(panels%integrals(:, :panels%count), 2)/two_pi
      mean_error = maxval(sum(panels%errors(:, :panels%count), 2)/max(sum(panels%sizes(:, :panels%count), 2), tiny(1.0_wp)))
   end subroutine mean_bearing_torque

   !> Torque of the bearings of each camshaft at a cam angle.
   subroutine sample_bearings(self, x, values, error)
      !> The shaft with its cycles
      class(bearing_samples_t), intent(inout) :: self
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: x
      !> The torques [N m]
      real(wp), intent(out) :: values(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      ! Torques on each camshaft [N m]
      real(wp) :: torques(torque_count, self%solved%shaft%count)
      ! Series of the camshafts [unit of the series]
      real(wp) :: series(self%series)

      call shaft_torques(self%solved, x, torques, error)
      if (allocated(error)) return
      values = torques(of_bearings, :)
      call camshaft_values(self%solved%case, torques, series)
      call add_sample(self%rows, x, series, .false.)
   end subroutine sample_bearings

end module camroller_mean_bearings
