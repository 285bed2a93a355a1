!> Scalars of a cycle of solved contacts, and the comparison of two grids.
!>
!> In: cycles on two grids. Out: their scalars and the differences; an error where a difference exceeds the accuracy.
module camroller_ehl_summary
   use camroller_balance, only : least_slip
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_ehl_cycle, only : ehl_cycle_t
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_number_text, only : number_text, integer_text
   use camroller_spin, only : rolling_speed_at
   implicit none
   private

   public :: ehl_summary_t, make_ehl_summary, mean_over_cycle, film_difference, slip_difference, &
      & compare_cycles

   !> A cycle in a few numbers
   type :: ehl_summary_t
      !> Nodes
      integer :: nodes = 0
      !> Smallest film, mean of the smallest and of the central film over the angles that have one [m]
      real(wp) :: smallest_film = 0.0_wp, mean_film = 0.0_wp, mean_central = 0.0_wp
      !> Mean of the sliding speed, of its size, of the rolling speed's size [m/s]
      real(wp) :: mean_slip = 0.0_wp, mean_size = 0.0_wp, mean_rolling = 0.0_wp
   end type ehl_summary_t

contains

   !> Numbers of a cycle.
   pure function make_ehl_summary(model, cycle) result(summary)
      !> The model
      type(model_t), intent(in) :: model
      !> Its cycle
      type(ehl_cycle_t), intent(in) :: cycle
      !> Its numbers
      type(ehl_summary_t) :: summary

      type(position_t) :: position
      ! Size of the rolling speed, sliding speed [m/s]; smallest and central films [m]; 1 where there is a film [-]
      real(wp) :: rolling(size(cycle%angle)), slip(size(cycle%angle)), films(size(cycle%angle), 2), with_film(size(cycle%angle))
      integer :: i, status

      do i = 1, size(cycle%angle)
         call evaluate_geometry(model, cycle%angle(i), position, status)
         rolling(i) = abs(rolling_speed_at(model, position))
      end do
      summary%nodes = size(cycle%nodes)
      associate (moments => cycle%moments)
         summary%smallest_film = minval(moments%films%minimum, mask=moments%has_film)
         films(:, 1) = moments%films%minimum
         films(:, 2) = moments%films%central
         slip = moments%sliding_speed
         with_film = merge(1.0_wp, 0.0_wp, moments%has_film)
      end associate
      associate (part => max(mean_over_cycle(cycle%angle, with_film), tiny(1.0_wp)))
         summary%mean_film = mean_over_cycle(cycle%angle, films(:, 1)*with_film)/part
         summary%mean_central = mean_over_cycle(cycle%angle, films(:, 2)*with_film)/part
      end associate
      summary%mean_slip = mean_over_cycle(cycle%angle, slip)
      summary%mean_size = mean_over_cycle(cycle%angle, abs(slip))
      summary%mean_rolling = mean_over_cycle(cycle%angle, rolling)
   end function make_ehl_summary

   !> Mean over the cycle by the trapezoidal rule.
   pure function mean_over_cycle(angles, values) result(mean)
      !> Angles of one cycle, increasing, both ends included [rad]
      real(wp), intent(in) :: angles(:)
      !> Values there [any]
      real(wp), intent(in) :: values(:)
      !> Their mean [any]
      real(wp) :: mean

      associate (last => size(angles))
         mean = 0.5_wp*dot_product(values(2:) + values(:last - 1), angles(2:) - angles(:last - 1))/two_pi
      end associate
   end function mean_over_cycle

   !> What two cycles differ by in their films.
   pure function film_difference(one, other) result(difference)
      !> Both; the second is the better one
      type(ehl_summary_t), intent(in) :: one, other
      !> Largest relative difference of smallest film and mean films [-]
      real(wp) :: difference

      difference = maxval(abs([one%smallest_film/other%smallest_film, one%mean_film/other%mean_film, &
         & one%mean_central/other%mean_central] - 1.0_wp))
   end function film_difference

   !> What two cycles differ by in their mean sliding speed.
   pure function slip_difference(one, other) result(difference)
      !> Both; the second is the better one
      type(ehl_summary_t), intent(in) :: one, other
      !> Difference over the mean size [-]
      real(wp) :: difference

      difference = abs(one%mean_slip - other%mean_slip)/max(other%mean_size, least_slip*other%mean_rolling)
   end function slip_difference

   !> No result where two grids differ by more than is allowed.
   subroutine compare_cycles(coarse, fine, accuracy, error)
      !> Cycles on a coarser and a finer grid
      type(ehl_summary_t), intent(in) :: coarse, fine
      !> Largest difference of films and mean slip [-]
      real(wp), intent(in) :: accuracy
      !> Convergence error that says by how much they differ
      type(error_t), allocatable, intent(out) :: error

      if (max(film_difference(coarse, fine), slip_difference(coarse, fine)) <= accuracy) return
      call raise(error, kind_convergence, "ehl: "//integer_text(coarse%nodes)//" and "//integer_text(fine%nodes)// &
         & " nodes differ by "//number_text(film_difference(coarse, fine), 2)//" in the film and by "// &
         & number_text(slip_difference(coarse, fine), 2)//" in the mean slip; the largest allowed (ehl.accuracy) is "// &
         & number_text(accuracy, 2))
   end subroutine compare_cycles

end module camroller_ehl_summary
