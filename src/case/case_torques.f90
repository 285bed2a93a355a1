!> Which of the torques on a camshaft a case has.
!>
!> In: a case. Out: a mark for each row of `torque_list`.
module camroller_case_torques
   use camroller_case, only : case_t, energy_names
   use camroller_effect_list, only : effect_names, has_effect
   use camroller_torque_list, only : torque_count, torque_list, is_torque, of_gas_damping
   implicit none
   private

   public :: torque_rows

contains

   !> Which torques of the list a case has.
   pure function torque_rows(case) result(has)
      !> The case
      type(case_t), intent(in) :: case
      !> True where the result has a series of it
      logical :: has(torque_count)

      integer :: row

      has = [(has_torque(case, row), row=1, torque_count)]
   end function torque_rows

   !> Does a case have a torque of the list? It follows from the part of the model that the torque comes from.
   pure function has_torque(case, row) result(has)
      type(case_t), intent(in) :: case
      !> Row of `torque_list`
      integer, intent(in) :: row
      !> True where the result has a series of it
      logical :: has

      integer :: i
      ! Effect without which a case has no such torque, by its place in `effect_names`; 0 where there is none to leave out
      integer, parameter :: effect_of(*) = [(findloc(effect_names, torque_list(i)%source, 1), i=1, torque_count)]
      logical, parameter :: is_consistent(*) = torque_list%source == "roller" .or. .not. is_torque

      has = .true.
      if (effect_of(row) > 0) then
         has = has_effect(case, effect_of(row))
      else if (is_consistent(row)) then
         has = case%energy == energy_names(1)
      end if
      if (row == of_gas_damping) has = has .and. allocated(case%gas_force)
   end function has_torque

end module camroller_case_torques
