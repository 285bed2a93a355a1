!> The files that a deck is read from: itself, and the tables that it or one of its cases names.
!>
!> In: a deck. Out: paths, so that no result replaces what it was computed from; names of the tables of cases, so that a result can
!> hold them.
module camroller_deck_files
   use camroller_deck, only : deck_t
   use camroller_deck_sweep, only : axis_of
   use camroller_deck_tables, only : find_table, table_groups
   use camroller_text_lines, only : add_line, line_t
   use camroller_quotes, only : without_quotes
   use camroller_settings, only : get_word
   use camroller_table_file, only : table_t
   use camroller_text_file, only : join_path
   use camroller_text_list, only : text_at
   implicit none
   private

   public :: list_deck_files, list_case_tables

   !> Groups with a key `table`
   character(len=*), parameter :: groups(*) = [table_groups, "sweep      "]

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
      ! The first of the files is the deck
      allocate (paths(count + max(0, size(deck%origins%files) - 1)))
      paths(1)%text = deck%name
      do i = 2, size(deck%origins%files)
         paths(count + i - 1)%text = deck%origins%files(i)%path
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

   !> Tables that a group names in cases of a deck and that the deck itself does not have at hand, each once.
   subroutine list_case_tables(deck, group, names)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> The group
      character(len=*), intent(in) :: group
      !> Their names in the deck
      type(line_t), allocatable, intent(out) :: names(:)

      type(table_t) :: own
      integer :: i, axis

      allocate (names(0))
      call find_table(deck%tables, group, own)
      if (axis_of(deck%sweep, group//".law") > 0) call add_name(get_word(deck%settings, group, "table"))
      axis = axis_of(deck%sweep, group//".table")
      if (axis == 0) return
      do i = 1, deck%sweep%axes(axis)%values%count
         call add_name(without_quotes(text_at(deck%sweep%axes(axis)%values, i)))
      end do

   contains

      !> Add the name of a table that is not at hand and not among the names.
      subroutine add_name(name)
         !> The name; blank where there is none
         character(len=*), intent(in) :: name

         integer :: k

         if (name == "") return
         if (allocated(own%path)) then
            if (own%path == join_path(deck%folder, name)) return
         end if
         do k = size(names), 1, -1
            if (names(k)%text == name) return
         end do
         call add_line(names, name)
      end subroutine add_name

   end subroutine list_case_tables

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
      type(deck_t), intent(in) :: deck
      !> Name of the file, in quotes or not; blank where there is none
      character(len=*), intent(in) :: name
      !> Its path, or blank
      character(len=:), allocatable, intent(out) :: path

      path = ""
      if (name == "") return
      path = join_path(deck%folder, without_quotes(name))
   end subroutine find_path

end module camroller_deck_files
