!> Mistakes that belong to a key or a group of a deck: found their place by name.
!>
!> In: names and a sentence. Out: a mistake with the place where the key's value, or its group, stands.
module camroller_deck_complaint
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t, add_mistake, override_place
   use camroller_settings, only : settings_t, find_value, group_position, is_known, is_wrong, take
   implicit none
   private

   public :: complain, complain_about_group, demand, check_points

contains

   !> Take note of a mistake in the value of a key.
   subroutine complain(mistakes, settings, group, key, message)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What is wrong
      character(len=*), intent(in) :: message

      associate (value => settings%values(find_value(settings, group, key)))
         if (allocated(value%source)) then
            call add_mistake(mistakes, message, 0, 1, len(value%source), override_place, value%source)
         else if (value%line > 0) then
            call add_mistake(mistakes, message, value%line, value%column, value%width)
         else
            call complain_about_group(mistakes, settings, group, message)
         end if
      end associate
   end subroutine complain

   !> Take note of a mistake that belongs to a group as a whole.
   subroutine complain_about_group(mistakes, settings, group, message)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Name of the group
      character(len=*), intent(in) :: group
      !> What is wrong
      character(len=*), intent(in) :: message

      associate (section => settings%groups(group_position(settings, group)))
         call add_mistake(mistakes, message, section%line, section%column, merge(len(group) + 1, 0, section%line > 0))
      end associate
   end subroutine complain_about_group

   !> A key that a choice makes necessary.
   subroutine demand(settings, group, key, choice, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What needs it
      character(len=*), intent(in) :: choice
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (is_known(settings, group, key) .or. is_wrong(settings, group, key)) return
      call complain_about_group(mistakes, settings, group, choice//" needs '"//key//"' in &"//group)
   end subroutine demand

   !> A table over speed and temperature: both increase, and there is a number for each pair.
   subroutine check_points(settings, group, keys, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Names of the group, and of its keys with speeds, temperatures and numbers
      character(len=*), intent(in) :: group, keys(3)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      real(wp), allocatable :: numbers(:) ! [unit of the key]
      integer :: counts(3), i

      if (.not. all([(is_known(settings, group, trim(keys(i))), i=1, 3)])) return
      do i = 1, 3
         call take(settings, group, trim(keys(i)), numbers)
         counts(i) = size(numbers)
         if (i < 3 .and. any(numbers(2:) <= numbers(:counts(i) - 1))) call complain(mistakes, settings, group, trim(keys(i)), &
            & "the numbers of '"//trim(keys(i))//"' must increase")
      end do
      if (counts(3) /= counts(1)*counts(2)) call complain(mistakes, settings, group, trim(keys(3)), &
         & "'"//trim(keys(3))//"' has one number for each speed at each temperature")
   end subroutine check_points

end module camroller_deck_complaint
