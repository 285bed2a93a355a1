!> Curves of a follower that are good enough for many cams, and for bearings over a whole turn.
!>
!> In: model and cycle of a lobe shape, its curve so far. Out: the curve with more pieces, where the cycle was solved for them.
module camroller_refined_curve
   use camroller_kinds, only : two_pi, wp
   use camroller_cycle, only : cycle_t, state_at
   use camroller_error, only : error_t
   use camroller_lobe_curve, only : lobe_curve_t, add_piece, close_curve, contact_near, halve_pieces, keep_state, move_curve, &
      & piece_angle, start_curve
   use camroller_model, only : model_t
   use camroller_panels, only : panel_places, panel_points
   use camroller_state, only : state_t
   implicit none
   private

   public :: follow_steps, refine_curve

contains

   !> Make the curve of a flexible train, with a piece for each of its steps: no contact is lost or met within one.
   subroutine follow_steps(model, cycle, curve, error)
      !> Model of the lobe shape
      type(model_t), intent(in) :: model
      !> Its cycle
      type(cycle_t), intent(in) :: cycle
      !> Its curve
      type(lobe_curve_t), intent(out) :: curve
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      integer :: step, point, hint

      associate (path => cycle%trajectory)
         call start_curve(curve, path%time(1), path%count - 1, .true.)
         do step = 1, path%count - 1
            if (.not. path%time(step + 1) > path%time(step)) cycle
            do point = 1, panel_points
               hint = step
               call state_at(cycle, model, path%time(step) + panel_places(point)*(path%time(step + 1) - path%time(step)), hint, &
                  & state, error)
               if (allocated(error)) return
               call keep_state(curve, model, state, point)
            end do
            call add_piece(curve, path%time(step + 1))
         end do
      end associate
      call close_curve(curve, cycle%tolerance)
   end subroutine follow_steps

   !> Halve the pieces of a follower's curve that are not good enough. Where they stay so, states are solved in their place.
   subroutine refine_curve(model, cycle, curve, error)
      !> Model of the lobe shape
      type(model_t), intent(in) :: model
      !> Its cycle
      type(cycle_t), intent(in) :: cycle
      !> Its curve
      type(lobe_curve_t), intent(inout) :: curve
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Length below which a piece is not halved, so that what is left of a kink is a small part of the turn [rad]
      real(wp), parameter :: shortest = two_pi/3000.0_wp
      type(state_t) :: state
      type(lobe_curve_t) :: halved
      integer, allocatable :: halves(:)
      ! Cam angle from full lift [rad]
      real(wp) :: angle
      integer :: i, point, hint

      hint = 1
      do
         call halve_pieces(curve, shortest, halved, halves)
         if (size(halves) == 0) return
         do i = 1, size(halves)
            do point = 1, panel_points
               angle = piece_angle(halved, halves(i), point)
               call state_at(cycle, model, angle, hint, state, error, contact_near(curve, angle))
               if (allocated(error)) return
               call keep_state(halved, model, state, point, halves(i))
            end do
         end do
         call move_curve(halved, curve)
         call close_curve(curve, cycle%tolerance)
      end do
   end subroutine refine_curve

end module camroller_refined_curve
