!> The tables of a study as text.
!>
!> Layer: app. In: tables. Out: lines; of many cases the largest error and the geometric mean of the times.
module camroller_study_page
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp, pi
   use camroller_number_text, only : fixed_text, scientific_text, integer_text, right_text
   use camroller_study_table, only : study_table_t, column_of, word_length
   implicit none
   private

   public :: reference_page, method_page, accuracy_page, model_page

   character(len=*), parameter :: n = new_line("a")
   !> Longest line
   integer, parameter :: width = 128

contains

   !> One line for each reference.
   function reference_page(table) result(text)
      !> Table of references
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      character(len=width) :: line
      integer :: row

      text = "References"//n//"case  speed  oil    agreement  fastest    slip per    friction   smallest"//n// &
         & "      rpm    degC   of two     decay      revolution  torque     film"//n// &
         & "                               [1/rad]    [-]         [N m]      [um]"
      do row = 1, table%rows
         associate (v => table%numbers(row, :))
            line = right_text(integer_text(nint(v(1))), 4)//right_text(fixed_text(v(3)*30.0_wp/pi, 1), 8)// &
               & right_text(fixed_text(v(4) - 273.15_wp, 1), 7)
            if (nint(v(2)) == 0) then
               line(20:) = right_text(scientific_text(v(5), 1), 10)//right_text(scientific_text(v(6), 2), 11)// &
                  & right_text(scientific_text(v(8), 3), 12)//right_text(scientific_text(v(9), 3), 11)// &
                  & right_text(fixed_text(v(10)*1.0e6_wp, 4), 9)
            else
               line(21:) = table%words(row, 1)
            end if
         end associate
         text = text//n//trim(line)
      end do
      text = text//n
   end function reference_page

   !> One line for each method and rung: worst case of each error, mean work and time.
   function method_page(table) result(text)
      !> Table of methods
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      logical :: is_same(table%rows)
      logical :: is_done(table%rows)
      integer :: row

      text = "Methods, all cases: largest errors; means of work, geometric mean of time"//n// &
         & "method            tolerance  step   error of   of mean    of film    estimated  evalua-  steps   rejected  "// &
         & "time    failed"//n// &
         & "                             [deg]  sliding    friction   minimum    error      tions                      "// &
         & "[ms]"
      is_done = .false.
      do row = 1, table%rows
         if (is_done(row)) cycle
         is_same = table%words(:table%rows, 1) == table%words(row, 1) &
            & .and. same(column_of(table, "tolerance"), row) .and. same(column_of(table, "step"), row)
         is_done = is_done .or. is_same
         text = text//n//method_line(table, row, is_same)
      end do
      text = text//n
   end function method_page

   !> Line for a method and rung.
   function method_line(table, row, is_same) result(text)
      !> Table of methods
      type(study_table_t), intent(in) :: table
      !> First of its rows
      integer, intent(in) :: row
      !> All of its rows
      logical, intent(in) :: is_same(:)
      !> The line
      character(len=:), allocatable :: text

      character(len=width) :: line
      ! Numbers of a column [unit of the column]
      real(wp), allocatable :: rung(:)
      logical :: fine(size(is_same))

      line = table%words(row, 1) (:width)
      rung = column_of(table, "tolerance")
      if (.not. ieee_is_nan(rung(row))) line(18:) = right_text(scientific_text(rung(row), 0), 9)
      rung = column_of(table, "step")
      if (.not. ieee_is_nan(rung(row))) line(28:) = right_text(fixed_text(rung(row), 3), 7)
      fine = is_same .and. column_of(table, "status") <= 0.0_wp
      if (any(fine)) then
         line(36:) = right_text(scientific_text(worst("error_sliding_speed"), 1), 11)// &
            & right_text(scientific_text(worst("error_torque_friction"), 1), 11)// &
            & right_text(scientific_text(worst("error_film_min"), 1), 11)// &
            & right_text(scientific_text(worst("estimated_error"), 1), 11)// &
            & right_text(fixed_text(mean("evaluations"), 0), 10)//right_text(fixed_text(mean("steps"), 0), 9)// &
            & right_text(fixed_text(mean("rejected"), 1), 8)// &
            & right_text(fixed_text(1.0e3_wp*geometric_mean(pack(column_of(table, "time"), fine)), 3), 11)
      end if
      if (count(fine) < count(is_same)) line(119:) = right_text(integer_text(count(is_same) - count(fine)), 4)
      text = trim(line)

   contains

      !> Largest number of a column.
      function worst(name) result(value)
         !> Its name
         character(len=*), intent(in) :: name
         !> The number [unit of the column]
         real(wp) :: value

         value = maxval(pack(column_of(table, name), fine))
      end function worst

      !> Mean of a column.
      function mean(name) result(value)
         !> Its name
         character(len=*), intent(in) :: name
         !> The mean [unit of the column]
         real(wp) :: value

         value = sum(pack(column_of(table, name), fine))/count(fine)
      end function mean
   end function method_line

   !> Geometric mean.
   pure function geometric_mean(values) result(mean)
      !> Positive numbers [any]
      real(wp), intent(in) :: values(:)
      !> Their geometric mean [any]
      real(wp) :: mean

      mean = exp(sum(log(max(values, tiny(1.0_wp))))/size(values))
   end function geometric_mean

   !> Rows with the same number as a row, none counting as a number of its own.
   pure function same(values, row) result(answer)
      !> Numbers of a column [unit of the column]
      real(wp), intent(in) :: values(:)
      !> The row
      integer, intent(in) :: row
      !> The answer for each row
      logical :: answer(size(values))

      if (ieee_is_nan(values(row))) then
         answer = ieee_is_nan(values)
      else
         answer = .not. ieee_is_nan(values)
         where (answer) answer = .not. abs(values - values(row)) > 0.0_wp
      end if
   end function same

   !> One line for each accuracy: worst case of each error, mean work and time.
   function accuracy_page(table) result(text)
      !> Table of accuracies
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      character(len=width) :: line
      logical :: is_done(table%rows), is_same(table%rows), fine(table%rows)
      ! Accuracies asked for [-]
      real(wp), allocatable :: accuracies(:)
      integer :: row

      text = "Accuracy asked for, all cases: largest errors; means of work, geometric mean of time of whole runs"//n// &
         & "accuracy   error of   of mean    estimated  evalua-  steps       time    failed"//n// &
         & "           sliding    losses     error      tions                [ms]"
      accuracies = column_of(table, "accuracy")
      is_done = .false.
      do row = 1, table%rows
         if (is_done(row)) cycle
         is_same = same(accuracies, row)
         is_done = is_done .or. is_same
         fine = is_same .and. column_of(table, "status") <= 0.0_wp
         line = right_text(scientific_text(accuracies(row), 0), 8)
         if (any(fine)) then
            line(9:) = right_text(scientific_text(maxval(pack(column_of(table, "error_sliding_speed"), fine)), 1), 11)// &
               & right_text(scientific_text(maxval(pack(column_of(table, "error_losses"), fine)), 1), 11)// &
               & right_text(scientific_text(maxval(pack(column_of(table, "estimated_error"), fine)), 1), 11)// &
               & right_text(fixed_text(mean_of("evaluations"), 0), 10)//right_text(fixed_text(mean_of("steps"), 0), 9)// &
               & right_text(fixed_text(1.0e3_wp*geometric_mean(pack(column_of(table, "time"), fine)), 3), 11)
         end if
         if (count(fine) < count(is_same)) line(73:) = right_text(integer_text(count(is_same) - count(fine)), 4)
         text = text//n//trim(line)
      end do
      text = text//n

   contains

      !> Mean of a column.
      function mean_of(name) result(value)
         !> Its name
         character(len=*), intent(in) :: name
         !> The mean [unit of the column]
         real(wp) :: value

         value = sum(pack(column_of(table, name), fine))/count(fine)
      end function mean_of
   end function accuracy_page

   !> One line for each model: largest changes over all cases.
   function model_page(table) result(text)
      !> Table of models
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      character(len=width) :: line
      logical :: is_done(table%rows), is_same(table%rows), fine(table%rows)
      integer :: row

      text = "Models, all cases: largest changes in size, with their sign; geometric mean of time"//n// &
         & "model                    compared with   friction   slip       film       time    time saved  failed"//n// &
         & "                                         torque     per turn   minimum    [ms]    [%]"
      is_done = .false.
      do row = 1, table%rows
         if (is_done(row)) cycle
         is_same = table%words(:table%rows, 1) == table%words(row, 1)
         is_done = is_done .or. is_same
         fine = is_same .and. column_of(table, "status") <= 0.0_wp .and. .not. ieee_is_nan(column_of(table, "time_saved"))
         line(:24) = table%words(row, 1) (:24)
         line(25:) = " "//table%words(row, 2) (:13)
         if (any(fine)) then
            line(39:) = right_text(fixed_text(100.0_wp*extreme("change_torque_friction"), 2), 10)// &
               & right_text(fixed_text(100.0_wp*extreme("change_slip"), 2), 10)// &
               & right_text(fixed_text(100.0_wp*extreme("change_film_min"), 2), 10)//" %"// &
               & right_text(fixed_text(1.0e3_wp*geometric_mean(pack(column_of(table, "time"), fine)), 3), 9)//right_text( &
               & fixed_text(100.0_wp*(1.0_wp - geometric_mean(1.0_wp - pack(column_of(table, "time_saved"), fine))), 0), 10)
         end if
         if (count(fine) < count(is_same)) line(93:) = right_text(integer_text(count(is_same) - count(fine)), 4)
         text = text//n//trim(line)
      end do
      text = text//n

   contains

      !> Number of a column that is largest in size.
      function extreme(name) result(value)
         !> Name of the column
         character(len=*), intent(in) :: name
         !> The number [unit of the column]
         real(wp) :: value

         ! Numbers of the column [unit of the column]
         real(wp), allocatable :: values(:)

         values = pack(column_of(table, name), fine)
         value = values(maxloc(abs(values), 1))
      end function extreme
   end function model_page

end module camroller_study_page
