!> The table of a study in a result file.
!>
!> In: an open result file, a table. Out: `/study/<table>` with one dataset for each column; all share the dimension
!> `row`.
module camroller_study_file
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_hdf5_attribute, only : attach_scale, describe, make_scale, put_attribute
   use camroller_hdf5_file, only : close_object, create_group, create_integers, create_numbers, create_texts, reserve_file, &
      & write_integers, write_numbers, write_text
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_output_file, only : check_open, finish_file, abandon_output, number_size, object_size, output_t, text_size
   use camroller_study_table, only : study_table_t, word_length
   implicit none
   private

   public :: write_study, close_study

contains

   !> Write the table of a study.
   subroutine write_study(writer, name, title, table, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Name of the table below `/study`, and what it holds
      character(len=*), intent(in) :: name, title
      !> The table
      type(study_table_t), intent(in) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: study

      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, object_size, error)
      if (.not. allocated(error)) call create_group(writer%file, "study", study, error)
      if (.not. allocated(error)) call write_table(writer, study, name, title, table, error)
      call close_object(study)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_study

   !> Write one table.
   subroutine write_table(writer, study, name, title, table, error)
      type(output_t), intent(inout) :: writer
      !> Group of the study
      type(hdf5_object_t), intent(in) :: study
      !> Name of the table, and what it holds
      character(len=*), intent(in) :: name, title
      type(study_table_t), intent(in) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: group, axis
      integer :: i

      call reserve_file(writer%file, object_size*(4 + size(table%word_columns) + size(table%number_columns)) &
         & + table%rows*(number_size*size(table%number_columns) + (text_size + word_length)*size(table%word_columns)), error)
      if (.not. allocated(error)) call create_group(study, name, group, error)
      if (.not. allocated(error)) call put_attribute(group, "long_name", title, error)
      if (.not. allocated(error)) call create_integers(group, "row", [table%rows], axis, error)
      if (.not. allocated(error)) call describe(axis, "1", "row of the table", "study", error)
      if (.not. allocated(error)) call make_scale(axis, error)
      if (.not. allocated(error)) call write_integers(axis, [(i, i=0, table%rows - 1)], error)
      if (.not. allocated(error)) call write_words(group, axis, table, error)
      if (.not. allocated(error)) call write_columns(group, axis, table, error)
      call close_object(axis)
      call close_object(group)
   end subroutine write_table

   !> Columns with words.
   subroutine write_words(group, axis, table, error)
      !> Group of the table
      type(hdf5_object_t), intent(in) :: group
      !> Its rows
      type(hdf5_object_t), intent(in) :: axis
      type(study_table_t), intent(in) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      integer :: column, row

      do column = 1, size(table%word_columns)
         call create_texts(group, table%word_columns(column)%name, [table%rows], dataset, error)
         if (allocated(error)) return
         call put_attribute(dataset, "long_name", table%word_columns(column)%description, error)
         if (.not. allocated(error)) call attach_scale(dataset, axis, 1, 1, error)
         do row = 1, table%rows
            if (.not. allocated(error)) call write_text(dataset, [row - 1], trim(table%words(row, column)), error)
         end do
         call close_object(dataset)
         if (allocated(error)) return
      end do
   end subroutine write_words

   !> Columns with numbers.
   subroutine write_columns(group, axis, table, error)
      !> Group of the table
      type(hdf5_object_t), intent(in) :: group
      !> Its rows
      type(hdf5_object_t), intent(in) :: axis
      type(study_table_t), intent(in) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      ! Numbers of a column [unit of the column]
      real(wp), allocatable :: values(:)
      integer :: column

      do column = 1, size(table%number_columns)
         call create_numbers(group, table%number_columns(column)%name, [table%rows], [integer ::], 0, dataset, error)
         if (allocated(error)) return
         associate (quantity => table%number_columns(column))
            call describe(dataset, quantity%unit, quantity%description, quantity%source, error)
         end associate
         if (.not. allocated(error)) call attach_scale(dataset, axis, 1, 1, error)
         values = table%numbers(:table%rows, column)
         if (.not. allocated(error)) call write_numbers(dataset, 0, values, error)
         call close_object(dataset)
         if (allocated(error)) return
      end do
   end subroutine write_columns

   !> Finish the file of a study, which has tables in place of series and summary.
   subroutine close_study(writer, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call check_open(writer, error)
      if (.not. allocated(error)) call finish_file(writer, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine close_study

end module camroller_study_file
