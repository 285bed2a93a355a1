!> What a choice of effects adds to a result: its scalars, and why a film has a law that the deck does not name.
!>
!> In: a result, the choice. Out: the result with scalars of source `effects`.
module camroller_effect_report
   use camroller_kinds, only : infinite_if_huge, wp
   use camroller_case, only : quantity_names
   use camroller_effect_list, only : choice_t, effect_ehl, effect_film, effect_names
   use camroller_remarks, only : outside_range
   use camroller_result, only : append_quantity, quantity_list_t, result_t
   implicit none
   private

   public :: add_choice, choice_source

   !> Source of the scalars that tell about a choice
   character(len=*), parameter :: choice_source = "effects"

contains

   !> Add what was decided to the summary.
   subroutine add_choice(result, choice)
      !> The result of the case without what was left out
      type(result_t), intent(inout) :: result
      !> What was decided
      type(choice_t), intent(in) :: choice

      type(quantity_list_t) :: list
      character(len=:), allocatable :: name
      integer :: i, k

      list%count = size(result%summary)
      list%items = result%summary
      list%values = result%summary_values
      do i = 1, size(choice%decisions)
         name = trim(effect_names(choice%decisions(i)%effect))
         associate (decision => choice%decisions(i))
            if (any(decision%effect == [effect_ehl, effect_film]) .and. .not. decision%is_used) call excuse_law(result, name)
            call append_quantity(list, name//"_used", "1", "1 where the effect took part, 0 where it was left out", choice_source, &
               & merge(1.0_wp, 0.0_wp, decision%is_used))
            do k = 1, size(quantity_names)
               call append_quantity(list, name//"_estimate_"//trim(quantity_names(k)), "1", &
                  & "largest relative change expected without the effect; infinite where there is no bound", choice_source, &
                  & infinite_if_huge(decision%estimates(k)))
               list%items(list%count)%may_be_infinite = .true.
            end do
         end associate
      end do
      call append_quantity(list, "bound", "1", "sum of the estimates of what was left out, for "// &
         & trim(quantity_names(choice%quantity)), choice_source, choice%bound)
      call append_quantity(list, "evaluations", "1", "evaluations of the contact for the estimates", choice_source, &
         & real(choice%evaluations, wp))
      result%summary = list%items(:list%count)
      result%summary_values = list%values(:list%count)
      result%choice = choice
   end subroutine add_choice

   !> Say where a law is outside its range that it stands in the place of the deck's.
   subroutine excuse_law(result, name)
      type(result_t), intent(inout) :: result
      !> Name of the effect that was left out
      character(len=*), intent(in) :: name

      integer :: i

      do i = 1, size(result%remarks)
         if (result%remarks(i)%kind == outside_range) result%remarks(i)%text = result%remarks(i)%text// &
            & "; effects.select = 'needed' has put this law in the place of the deck's, since "//name//" matters little here"
      end do
   end subroutine excuse_law

end module camroller_effect_report
