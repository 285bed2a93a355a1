!> What a choice of effects adds to a result: its scalars, and places for what was left out.
!>
!> In: a result, the choice. Out: the result with scalars of source `effects`; on request with the series and scalars
!> of everything that is listed, so that the cases of a sweep have the same quantities whatever each of them needed.
module camroller_effect_report
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   use camroller_case, only : case_t, quantity_names
   use camroller_catalogue, only : list_series
   use camroller_effect_list, only : choice_t, effect_names
   use camroller_result, only : result_t, quantity_t, find_quantity
   implicit none
   private

   public :: add_choice, complete_result, choice_source

   !> Source of the scalars that tell about a choice
   character(len=*), parameter :: choice_source = "effects"
   !> Scalars of a series
   character(len=*), parameter :: statistics(*) = [character(len=5) :: "mean_", "min_", "max_"]
   !> Scalars of a torque that is a loss
   character(len=*), parameter :: losses(*) = [character(len=6) :: "power_", "work_"]
   !> Beginning of the names of torques
   character(len=*), parameter :: torque = "torque_"

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

   !> Give a result a place for every series and scalar of the case with all its effects; those left out are not a number.
   subroutine complete_result(listed, result)
      !> The case with all its effects
      type(case_t), intent(in) :: listed
      !> The result of the case with some of them
      type(result_t), intent(inout) :: result

      type(quantity_t), allocatable :: series(:)
      ! [unit of the series]
      real(wp), allocatable :: values(:, :)
      type(list_t) :: list
      integer :: i, k, position

      if (.not. allocated(result%choice)) return
      call list_series(listed, series)
      allocate (values(size(result%series_values, 1), size(series)))
      call start_list(list, size(result%summary) + (size(statistics) + size(losses))*size(series))
      values = ieee_value(1.0_wp, ieee_quiet_nan)
      do i = 1, size(series)
         position = find_quantity(result%series, series(i)%name)
         if (position > 0) values(:, i) = result%series_values(:, position)
         do k = 1, size(statistics)
            call take(list, result, trim(statistics(k))//series(i)%name, series(i)%unit, series(i)%source)
         end do
      end do
      do i = 1, size(series)
         if (index(series(i)%name, torque) /= 1 .or. find_quantity(result%summary, "power_"//trim(loss_name(series(i)))) == 0 &
            & .and. find_quantity(result%series, series(i)%name) > 0) cycle
         call take(list, result, trim(losses(1))//trim(loss_name(series(i))), "W", series(i)%source)
         call take(list, result, trim(losses(2))//trim(loss_name(series(i))), "J", series(i)%source)
      end do
      do i = 1, size(result%summary)
         if (find_quantity(list%quantities(:list%count), result%summary(i)%name) > 0) cycle
         call copy_scalar(list, result, i)
      end do
      call move_alloc(series, result%series)
      call move_alloc(values, result%series_values)
      call end_list(list, result)
   end subroutine complete_result

   !> What follows the beginning of a torque's name.
   pure function loss_name(series) result(name)
      !> A torque
      type(quantity_t), intent(in) :: series
      !> Name of the loss
      character(len=name_length) :: name

      name = series%name(len(torque) + 1:)
   end function loss_name

   !> Take a scalar from a result into a list, or a place for it.
   subroutine take(list, result, name, unit, source)
      !> The list
      type(list_t), intent(inout) :: list
      !> The result
      type(result_t), intent(in) :: result
      !> Name, unit, part of the model
      character(len=*), intent(in) :: name, unit, source

      integer :: position

      position = find_quantity(result%summary, name)
      if (position > 0) then
         call copy_scalar(list, result, position)
      else
         call append(list, name, unit, "left out in some cases", source, ieee_value(1.0_wp, ieee_quiet_nan))
      end if
   end subroutine take

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
