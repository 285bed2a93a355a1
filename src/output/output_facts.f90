!> Facts of its run in a result file: the deck, the swept keys, who computed it and how.
!>
!> In: texts and numbers, nothing that knows decks. Out: groups `/deck`, `/sweep`, `/measured` and attributes of `/run`.
module camroller_output_facts
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : close_object, create_group, create_integers, create_numbers, create_texts, &
      & reserve_file, write_integers, write_numbers, write_text
   use camroller_hdf5_attribute, only : attach_scale, make_scale, put_attribute
   use camroller_output_file, only : abandon_output, check_open, number_size, object_size, output_t, text_size
   use camroller_number_text, only : is_number
   use camroller_quotes, only : without_quotes
   use camroller_remarks, only : remarks_t
   use camroller_text_lines, only : line_t
   implicit none
   private

   public :: write_deck, write_deck_lines, write_deck_table, write_table_count, write_sweep, write_measured, write_run, &
      & write_worst_remarks

   !> Values of a swept key: numbers or names
   interface write_sweep
      module procedure write_swept_numbers
      module procedure write_swept_names
   end interface write_sweep

contains

   !> Store the deck: the text as given, and each value that came of it.
   subroutine write_deck(writer, text, keys, values, is_whole, units, origins, is_used, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> The deck as given
      character(len=*), intent(in) :: text
      !> Keys, as `group.key`
      character(len=*), intent(in) :: keys(:)
      !> Their values: numbers as such, names plain or in quotes, lists separated by commas
      type(line_t), intent(in) :: values(:)
      !> Are they whole numbers?
      logical, intent(in) :: is_whole(:)
      !> Their units, blank where there is none
      character(len=*), intent(in) :: units(:)
      !> Where they come from: `given` or `default`
      character(len=*), intent(in) :: origins(:)
      !> May they change anything in a case?
      logical, intent(in) :: is_used(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: group, dataset
      integer :: i

      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, real(len(text), wp) + size(keys)*(object_size + len(units)) + &
         & sum([(len(values(i)%text), i=1, size(values))]), error)
      if (.not. allocated(error)) call create_texts(writer%deck, "text", [integer ::], dataset, error)
      if (.not. allocated(error)) call write_text(dataset, [integer ::], text, error)
      call close_object(dataset)
      if (.not. allocated(error)) call create_group(writer%deck, "values", group, error)
      do i = 1, size(keys)
         if (allocated(error)) exit
         call write_value(group, trim(keys(i)), values(i)%text, is_whole(i), dataset, error)
         if (.not. allocated(error)) call put_attribute(dataset, "units", units(i), error)
         if (.not. allocated(error)) call put_attribute(dataset, "given", origins(i), error)
         if (.not. allocated(error)) call put_attribute(dataset, "used", trim(merge("yes", "no ", is_used(i))), error)
         call close_object(dataset)
      end do
      call close_object(group)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_deck

   !> Store what belongs to the deck and is lines of text: values given beside it, as `group.key=value`, or remarks on it.
   subroutine write_deck_lines(writer, name, lines, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> What they are called in the file
      character(len=*), intent(in) :: name
      !> The lines
      character(len=*), intent(in) :: lines(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      integer :: i

      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, object_size + size(lines)*(text_size + len(lines)), error)
      if (.not. allocated(error)) call create_texts(writer%deck, name, shape(lines), dataset, error)
      do i = 1, size(lines)
         if (.not. allocated(error)) call write_text(dataset, [i - 1], lines(i), error)
      end do
      call close_object(dataset)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_deck_lines

   !> Store the worst remark of each kind, with its case and the number of cases that have one; nothing where no case has a remark.
   subroutine write_worst_remarks(writer, remarks, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Remarks of all cases
      type(remarks_t), intent(in) :: remarks
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: group, axis, dataset
      integer :: i

      call check_open(writer, error)
      if (allocated(error) .or. .not. allocated(remarks%groups)) return
      associate (groups => remarks%groups)
         if (size(groups) == 0) return
         call reserve_file(writer%file, 5*object_size + size(groups)*(text_size + 3*number_size) + &
            & sum([(len(groups(i)%worst%text), i=1, size(groups))]), error)
         if (.not. allocated(error)) call create_group(writer%run, "remarks", group, error)
         if (.not. allocated(error)) call create_integers(group, "remark", shape(groups), axis, error)
         if (.not. allocated(error)) call write_integers(axis, [(i - 1, i=1, size(groups))], error)
         if (.not. allocated(error)) call make_scale(axis, error)
         if (.not. allocated(error)) call create_texts(group, "worst", shape(groups), dataset, error)
         do i = 1, size(groups)
            if (.not. allocated(error)) call write_text(dataset, [i - 1], groups(i)%worst%text, error)
         end do
         call finish("the worst remark of the kind")
         if (.not. allocated(error)) call create_integers(group, "worst_case", shape(groups), dataset, error)
         if (.not. allocated(error)) call write_integers(dataset, [(groups(i)%case_number - 1, i=1, size(groups))], error)
         call finish("case of the worst remark, from 0")
         if (.not. allocated(error)) call create_integers(group, "cases", shape(groups), dataset, error)
         if (.not. allocated(error)) call write_integers(dataset, [(groups(i)%cases, i=1, size(groups))], error)
         call finish("number of cases with such a remark")
      end associate
      call close_object(axis)
      call close_object(group)
      if (allocated(error)) call abandon_output(writer)

   contains

      !> Give the dataset its axis, and close it.
      subroutine finish(meaning)
         !> What it is
         character(len=*), intent(in) :: meaning

         if (.not. allocated(error)) call put_attribute(dataset, "long_name", meaning, error)
         if (.not. allocated(error)) call attach_scale(dataset, axis, 1, 1, error)
         call close_object(dataset)
      end subroutine finish

   end subroutine write_worst_remarks

   !> Store a table that the deck names.
   subroutine write_deck_table(writer, group, path, heading, x, y, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Group of the deck that names it
      character(len=*), intent(in) :: group
      !> File it is from, and names and units of its columns; blank where it has none
      character(len=*), intent(in) :: path, heading
      !> Its columns [units of the file]
      real(wp), intent(in) :: x(:), y(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      real(wp), allocatable :: columns(:, :) ! [units of the file]

      call check_open(writer, error)
      if (allocated(error)) return
      columns = reshape([x, y], [size(x), 2])
      call reserve_file(writer%file, 2*object_size + number_size*size(columns), error)
      if (.not. allocated(error)) call create_numbers(writer%deck, "table_"//group, shape(columns), [integer ::], 0, &
         & dataset, error)
      if (.not. allocated(error)) call write_numbers(dataset, 0, columns, error)
      if (.not. allocated(error)) call put_attribute(dataset, "path", path, error)
      if (.not. allocated(error)) call put_attribute(dataset, "heading", heading, error)
      call close_object(dataset)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_deck_table

   !> Store how many tables of a group cases name that the deck itself does not; `write_deck_table` stores each.
   subroutine write_table_count(writer, group, tables, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Group of the deck that names them
      character(len=*), intent(in) :: group
      !> Their number
      integer, intent(in) :: tables
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, object_size, error)
      if (.not. allocated(error)) call put_attribute(writer%deck, "tables_"//group, tables, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_table_count

   !> Store facts of the run (program, version, commit, compiler, options, date, command ...) as attributes of `/run`.
   subroutine write_run(writer, names, values, study, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Names of the facts
      character(len=*), intent(in) :: names(:)
      !> What they are
      character(len=*), intent(in) :: values(:)
      !> What the cases follow from, a line for each value
      character(len=*), intent(in) :: study
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      integer :: i

      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, size(names)*(object_size + len(values)) + object_size + len(study), error)
      if (.not. allocated(error)) call create_texts(writer%run, "study_values", [integer ::], dataset, error)
      if (.not. allocated(error)) call write_text(dataset, [integer ::], study, error)
      call close_object(dataset)
      do i = 1, size(names)
         if (allocated(error)) exit
         call put_attribute(writer%run, trim(names(i)), values(i), error)
      end do
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_run

   !> Store the values of a swept key that is a number.
   subroutine write_swept_numbers(writer, key, unit, numbers, error)
      type(output_t), intent(inout) :: writer
      !> The key, as `group.key`
      character(len=*), intent(in) :: key
      !> Its unit, blank where there is none
      character(len=*), intent(in) :: unit
      !> Its value in each case [unit as given]
      real(wp), intent(in) :: numbers(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      real(wp), allocatable :: copy(:) ! [unit as given]

      call check_open(writer, error)
      if (allocated(error)) return
      allocate (copy, source=numbers)
      call reserve_file(writer%file, object_size + number_size*size(numbers), error)
      if (.not. allocated(error)) then
         call create_numbers(writer%sweep, key, shape(numbers), [integer ::], 0, dataset, error)
      end if
      if (.not. allocated(error)) call write_numbers(dataset, 0, copy, error)
      call finish_column(writer, dataset, key, unit, error)
   end subroutine write_swept_numbers

   !> Store measured values, which came with the cases.
   subroutine write_measured(writer, names, units, values, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> What was measured
      character(len=*), intent(in) :: names(:)
      !> Its units
      character(len=*), intent(in) :: units(:)
      !> Value of each case, a column for each name; no number where nothing was measured [units as given]
      real(wp), intent(in) :: values(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: group, dataset
      integer :: i

      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, (1 + size(names))*object_size + number_size*size(values), error)
      if (.not. allocated(error)) call create_group(writer%file, "measured", group, error)
      do i = 1, size(names)
         if (.not. allocated(error)) then
            call create_numbers(group, trim(names(i)), [size(values, 1)], [integer ::], 0, dataset, error)
         end if
         if (.not. allocated(error)) call write_numbers(dataset, 0, values(:, i), error)
         call finish_column(writer, dataset, trim(names(i)), trim(units(i)), error)
      end do
      call close_object(group)
   end subroutine write_measured

   !> Store the values of a swept key that is a name.
   subroutine write_swept_names(writer, key, unit, names, error)
      type(output_t), intent(inout) :: writer
      !> The key, as `group.key`
      character(len=*), intent(in) :: key
      !> Its unit, blank where there is none
      character(len=*), intent(in) :: unit
      !> Its value in each case
      character(len=*), intent(in) :: names(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      integer :: i

      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, object_size + size(names)*(text_size + len(names)), error)
      if (.not. allocated(error)) call create_texts(writer%sweep, key, shape(names), dataset, error)
      do i = 1, size(names)
         if (.not. allocated(error)) call write_text(dataset, [i - 1], names(i), error)
      end do
      call finish_column(writer, dataset, key, unit, error)
   end subroutine write_swept_names

   !> What all columns have in common.
   subroutine finish_column(writer, dataset, key, unit, error)
      type(output_t), intent(inout) :: writer
      !> The column
      type(hdf5_object_t), intent(inout) :: dataset
      !> Its name, of a swept key as `group.key`
      character(len=*), intent(in) :: key
      !> Its unit, blank where there is none
      character(len=*), intent(in) :: unit
      !> Error so far, or file error
      type(error_t), allocatable, intent(inout) :: error

      if (.not. allocated(error)) call put_attribute(dataset, "units", unit, error)
      if (.not. allocated(error)) call put_attribute(dataset, "long_name", key, error)
      if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 1, 1, error)
      call close_object(dataset)
      if (allocated(error)) call abandon_output(writer)
   end subroutine finish_column

   !> Write a value of the deck: a whole number or a number where it reads as one, else a text without its quotes.
   subroutine write_value(group, key, value, is_whole, dataset, error)
      !> Group of the values
      type(hdf5_object_t), intent(in) :: group
      character(len=*), intent(in) :: key
      !> Its value as text
      character(len=*), intent(in) :: value
      !> Is it a whole number?
      logical, intent(in) :: is_whole
      !> The open dataset
      type(hdf5_object_t), intent(out) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: number ! [unit of the key]
      integer :: whole, status

      status = 1
      if (is_whole) then
         read (value, *, iostat=status) whole
         if (status == 0) then
            call create_integers(group, key, [integer ::], dataset, error)
            if (.not. allocated(error)) call write_integers(dataset, whole, error)
            return
         end if
      end if
      if (is_number(value)) read (value, *, iostat=status) number
      if (status == 0) then
         call create_numbers(group, key, [integer ::], [integer ::], 0, dataset, error)
         if (.not. allocated(error)) call write_numbers(dataset, number, error)
         return
      end if
      call create_texts(group, key, [integer ::], dataset, error)
      if (allocated(error)) return
      call write_text(dataset, [integer ::], without_quotes(value), error)
   end subroutine write_value

end module camroller_output_facts
