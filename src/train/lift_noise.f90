!> Noise of a lift table, and what it does to the acceleration.
!>
!> In: a table of lift over cam angle. Out: an estimate of the noise, and the acceleration with and without smoothing by as much.
!> The estimate takes sixth differences, in which a smooth lift cancels: uncorrelated noise of standard deviation s has differences
!> of s sqrt(924). Their median is taken, so that the ends of the event and single bad rows do not count.
module camroller_lift_noise
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_lift, only : evaluate_lift, lift_law_t, lift_t, new_lift_law
   implicit none
   private

   public :: lift_noise_t, find_lift_noise

   !> What is known of the noise of a table
   type :: lift_noise_t
      !> Is it known? Not for tables of few rows or of uneven steps
      logical :: is_known = .false.
      !> Its root mean square [m]
      real(wp) :: noise = 0.0_wp
      !> Smallest and largest second derivative of the lift as the case has it, and with smoothing by the noise [m/rad^2]
      real(wp) :: given(2) = 0.0_wp, smoothed(2) = 0.0_wp
      !> Root mean square distance of that smoothed curve from the table [m]
      real(wp) :: residual = 0.0_wp
   end type lift_noise_t

   !> Fewest rows
   integer, parameter :: fewest_rows = 24
   !> Largest step over the smallest [-]
   real(wp), parameter :: most_uneven = 1.01_wp
   !> Order of the differences
   integer, parameter :: order = 6
   !> Sum of their squared coefficients; median of the size of a normal deviate [-]
   real(wp), parameter :: squares = 924.0_wp, median_deviate = 0.6745_wp
   !> Step in which the acceleration is looked at [rad]
   real(wp), parameter :: step = 0.25_wp*degree

contains

   !> Find the noise of a lift's table.
   subroutine find_lift_noise(lift, noise)
      !> The lift
      type(lift_t), intent(in) :: lift
      !> What is known of its noise
      type(lift_noise_t), intent(out) :: noise

      type(lift_law_t) :: law
      type(lift_t) :: other
      type(error_t), allocatable :: error
      ! Differences [m]; lift and its derivatives [m, m/rad, ...]
      real(wp), allocatable :: differences(:)
      real(wp) :: values(0:3)
      integer :: i, n

      if (.not. allocated(lift%table_lift)) return
      n = size(lift%table_lift)
      if (n < fewest_rows) return
      associate (steps => lift%table_angle(2:) - lift%table_angle(:n - 1))
         if (maxval(steps) > most_uneven*minval(steps)) return
      end associate
      differences = lift%table_lift
      do i = 1, order
         differences = differences(2:) - differences(:size(differences) - 1)
      end do
      noise%noise = median(abs(differences))/(median_deviate*sqrt(squares))
      call new_lift_law(law, lift, error)
      if (allocated(error)) return
      call find_range(law, lift, noise%given)
      other = lift
      other%smoothing = noise%noise
      call new_lift_law(law, other, error)
      if (allocated(error)) return
      call find_range(law, lift, noise%smoothed)
      do i = 1, n
         call evaluate_lift(law, lift%table_angle(i), values)
         noise%residual = noise%residual + (values(0) - lift%table_lift(i))**2/n
      end do
      noise%residual = sqrt(noise%residual)
      noise%is_known = .true.
   end subroutine find_lift_noise

   !> Smallest and largest second derivative of a lift over its table.
   subroutine find_range(law, lift, range)
      !> The law
      type(lift_law_t), intent(in) :: law
      !> The lift that it was made of
      type(lift_t), intent(in) :: lift
      !> The derivatives [m/rad^2]
      real(wp), intent(out) :: range(2)

      ! Lift and its derivatives [m, m/rad, ...]
      real(wp) :: values(0:3)
      integer :: i, n

      range = 0.0_wp
      n = size(lift%table_angle)
      do i = 0, ceiling((lift%table_angle(n) - lift%table_angle(1))/step)
         call evaluate_lift(law, lift%table_angle(1) + i*step, values)
         range = [min(range(1), values(2)), max(range(2), values(2))]
      end do
   end subroutine find_range

   !> Median of some numbers.
   pure function median(numbers)
      !> The numbers [any]
      real(wp), intent(in) :: numbers(:)
      !> Their median [any]
      real(wp) :: median

      integer :: i, rank, below

      median = 0.0_wp
      rank = (size(numbers) + 1)/2
      do i = 1, size(numbers)
         below = count(numbers < numbers(i))
         if (below < rank .and. below + count(abs(numbers - numbers(i)) <= 0.0_wp) >= rank) median = numbers(i)
      end do
   end function median

end module camroller_lift_noise
