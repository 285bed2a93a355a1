!> Has a lash adjuster pumped up?
!>
!> In: the turns of a train. Out: yes or no, and how high its plunger stands with the valve open. It pumps up where its check valve
!> opens in the event. Where it has come to its stop, or the oil it has taken in leaks out over many turns, the check valve may stay
!> shut: it is pumped up all the same where the valve does not close over a plunger above its rest.
module camroller_pump_up
   use camroller_flexible_measure_list, only : event_check_share, event_part, smallest_lift
   use camroller_flexible_measures, only : largest_lift
   use camroller_flexible_solution, only : flexible_solution_t
   use camroller_flexible_train, only : at_plunger
   use camroller_kinds, only : wp
   use camroller_kinematics, only : position_t
   use camroller_model, only : evaluate_geometry, model_t
   implicit none
   private

   public :: is_pumped_up, event_height

contains

   !> Has it, in some turn?
   function is_pumped_up(model, solution) result(verdict)
      !> Model of the lobe, with an adjuster
      type(model_t), intent(in) :: model
      !> Solution of its train
      type(flexible_solution_t), intent(in) :: solution
      !> Has it?
      logical :: verdict

      verdict = solution%highest(event_check_share) > 0.0_wp
      if (.not. verdict .and. solution%highest(smallest_lift) > 0.0_wp) verdict = event_height(model, solution) > 0.0_wp
   end function is_pumped_up

   !> Largest height of the plunger above its rest with the valve in the part of its lift that counts as the event.
   function event_height(model, solution) result(height)
      !> Model of the lobe, with an adjuster
      type(model_t), intent(in) :: model
      !> Solution of its train
      type(flexible_solution_t), intent(in) :: solution
      !> The height [m]
      real(wp) :: height

      type(position_t) :: position
      real(wp) :: least ! Lift of the event [m]
      integer :: turn, i, status

      height = -huge(1.0_wp)
      least = event_part*largest_lift(model)
      do turn = 1, size(solution%turns)
         associate (trajectory => solution%turns(turn))
            do i = 1, trajectory%count
               if (trajectory%state(at_plunger, i) - model%flexible%pivot_place <= height) cycle
               call evaluate_geometry(model, trajectory%time(i), position, status)
               if (status == 0 .and. position%lift >= least) height = trajectory%state(at_plunger, i) - model%flexible%pivot_place
            end do
         end associate
      end do
   end function event_height

end module camroller_pump_up
