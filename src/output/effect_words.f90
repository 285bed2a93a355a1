!> A choice of effects in words.
!>
!> In: what was decided. Out: one line for each effect.
module camroller_effect_words
   use camroller_kinds, only : wp
   use camroller_effect_list, only : choice_t, effect_names
   use camroller_number_text, only : scientific_text, right_text
   implicit none
   private

   public :: choice_in_words

contains

   !> What was decided, one line for each effect.
   function choice_in_words(choice) result(text)
      !> What was decided
      type(choice_t), intent(in) :: choice
      !> The lines
      character(len=:), allocatable :: text

      character(len=12) :: estimate
      integer :: i

      text = ""
      do i = 1, size(choice%decisions)
         associate (decision => choice%decisions(i))
            estimate = " large"
            if (decision%estimates(choice%quantity) < sqrt(huge(1.0_wp))) then
               estimate = right_text(scientific_text(decision%estimates(choice%quantity), 1), 8)
            end if
            if (i > 1) text = text//new_line("a")
            text = text//effect_names(decision%effect) (:20)//merge("kept     ", "left out ", decision%is_used)// &
               & estimate(:8)//"  "//trim(decision%reason)
         end associate
      end do
   end function choice_in_words

end module camroller_effect_words
