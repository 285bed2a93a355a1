!> The files that a deck is read from: itself, and the tables that it or one of its cases names.
!>
!> In: a deck. Out: paths, so that no result replaces what it was computed from.
module camroller_deck_files
   use camroller_deck, only : deck_t
   use camroller_mistakes, only : line_t
   use camroller_settings, only : get_word
   use camroller_text_file, only : join_path
   use camroller_text_list, only : text_at
   implicit none
   private

   public :: list_deck_files

   !> Groups with a key `table`
   character(len=*), parameter :: groups(*) = [character(len=11) :: "lift", "second_lift", "gas_force", "sweep"]

contains

   !> Paths of all files that a deck is read from; some may be blank.
   subroutine list_deck_files(deck, paths)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> The paths
      type(line_t), allocatable, intent(out) :: paths(:)

      integer :: i, k, place, count

      count = 1 + size(groups)
      do k = 1, size(deck%sweep%axes)
         if (names_files(deck%sweep%axes(k)%key)) count = count + deck%sweep%axes(k)%values%count
      end do
      allocate (paths(count + size(deck%origins%files)))
      paths(1)%text = deck%name
      do i = 1, size(deck%origins%files)
         paths(count + i)%text = deck%origins%files(i)%text
      end do
      do i = 1, size(groups)
         call find_path(deck, get_word(deck%settings, trim(groups(i)), "table"), paths(1 + i)%text)
      end do
      count = 1 + size(groups)
      do k = 1, size(deck%sweep%axes)
         if (.not. names_files(deck%sweep%axes(k)%key)) cycle
         do place = 1, deck%sweep%axes(k)%values%count
            count = count + 1
            call find_path(deck, text_at(deck%sweep%axes(k)%values, place), paths(count)%text)
         end do
      end do
   end subroutine list_deck_files

   !> Is a key the name of a file?
   pure function names_files(key) result(verdict)
      !> The key, as `group.key`
      character(len=*), intent(in) :: key
      !> Is it?
      logical :: verdict

      integer :: point

      point = index(key, ".table", back=.true.)
      verdict = .false.
      if (point > 0) verdict = any(groups == key(:point - 1)) .and. key(point:) == ".table"
   end function names_files

   !> Path of a file that a deck names.
   pure subroutine find_path(deck, name, path)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Name of the file, in quotes or not; blank where there is none
      character(len=*), intent(in) :: name
      !> Its path, or blank
      character(len=:), allocatable, intent(out) :: path

      path = ""
      if (name == "") return
      if (scan(name, "'""") == 1) then
         path = join_path(deck%folder, name(2:len(name) - 1))
      else
         path = join_path(deck%folder, name)
      end if
   end subroutine find_path

end module camroller_deck_files
