!> What a choice of effects adds to a result: its scalars, and why a film has a law that the deck does not name.
!>
!> In: a result, the choice. Out: the result with scalars of source `effects`.
module camroller_effect_report
   use camroller_kinds, only : wp
   use camroller_case, only : quantity_names
   use camroller_effect_list, only : choice_t, effect_ehl, effect_film, effect_names
   use camroller_remarks, only : outside_range
   use camroller_result, only : result_t, quantity_t
   implicit none
   private

   public :: add_choice, choice_source

   !> Source of the scalars that tell about a choice
   character(len=*), parameter :: choice_source = "effects"
   !> Quantities with their values
   type :: list_t
      !> Those so far
      integer :: count = 0
      !> Room for all that may come
      type(quantity_t), allocatable :: quantities(:)
      !> [unit of the quantity]
      real(wp), allocatable :: values(:)
   end type list_t

contains

   !> Add what was decided to the summary.
   subroutine add_choice(result, choice)
      !> The result of the case without what was left out
      type(result_t), intent(inout) :: result
      !> What was decided
      type(choice_t), intent(in) :: choice

      type(list_t) :: list
      character(len=:), allocatable :: name
      integer :: i, k

      call start_list(list, size(result%summary) + (1 + size(quantity_names))*size(choice%decisions) + 2)
      do i = 1, size(result%summary)
         call copy_scalar(list, result, i)
      end do
      do i = 1, size(choice%decisions)
         name = trim(effect_names(choice%decisions(i)%effect))
         associate (decision => choice%decisions(i))
            if (any(decision%effect == [effect_ehl, effect_film]) .and. .not. decision%is_used) call excuse_law(result, name)
            call append(list, name//"_used", "1", "1 where the effect took part, 0 where it was left out", choice_source, &
               & merge(1.0_wp, 0.0_wp, decision%is_used))
            do k = 1, size(quantity_names)
               call append(list, name//"_estimate_"//trim(quantity_names(k)), "1", &
                  & "largest relative change expected without the effect; huge where there is no estimate", choice_source, &
                  & decision%estimates(k))
            end do
         end associate
      end do
      call append(list, "bound", "1", "sum of the estimates of what was left out, for "// &
         & trim(quantity_names(choice%quantity)), choice_source, choice%bound)
      call append(list, "evaluations", "1", "evaluations of the contact for the estimates", choice_source, &
         & real(choice%evaluations, wp))
      call end_list(list, result)
      result%choice = choice
   end subroutine add_choice

   !> Say where a law is outside its range that it stands in the place of the deck's.
   subroutine excuse_law(result, name)
      !> The result
      type(result_t), intent(inout) :: result
      !> Name of the effect that was left out
      character(len=*), intent(in) :: name

      integer :: i

      do i = 1, size(result%remarks)
         if (result%remarks(i)%kind == outside_range) result%remarks(i)%text = result%remarks(i)%text// &
            & "; effects.select = 'needed' has put this law in the place of the deck's, since "//name//" matters little here"
      end do
   end subroutine excuse_law

   !> An empty list.
   subroutine start_list(list, room)
      !> The list
      type(list_t), intent(out) :: list
      !> Most quantities
      integer, intent(in) :: room

      allocate (list%quantities(room), list%values(room))
   end subroutine start_list

   !> Make a list the scalars of a result.
   subroutine end_list(list, result)
      !> The list
      type(list_t), intent(inout) :: list
      !> The result
      type(result_t), intent(inout) :: result

      result%summary = list%quantities(:list%count)
      result%summary_values = list%values(:list%count)
   end subroutine end_list

   !> Copy a scalar of a result into a list.
   subroutine copy_scalar(list, result, position)
      !> The list
      type(list_t), intent(inout) :: list
      !> The result
      type(result_t), intent(in) :: result
      !> Position of the scalar
      integer, intent(in) :: position

      list%count = list%count + 1
      list%quantities(list%count) = result%summary(position)
      list%values(list%count) = result%summary_values(position)
   end subroutine copy_scalar

   !> Append a scalar.
   subroutine append(list, name, unit, description, source, value)
      !> The list
      type(list_t), intent(inout) :: list
      !> Name, unit, meaning, part of the model
      character(len=*), intent(in) :: name, unit, description, source
      !> Value [unit of the scalar]
      real(wp), intent(in) :: value

      list%count = list%count + 1
      list%values(list%count) = value
      associate (quantity => list%quantities(list%count))
         quantity%name = name
         quantity%unit = unit
         quantity%description = description
         quantity%source = source
      end associate
   end subroutine append

end module camroller_effect_report
