!> The same cases with each film law: how far results depend on a choice that no measurement has made.
!>
!> In: a case. Out: a table with a line for each law and one with the range over all of them.
module camroller_laws_page
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_film, only : film_law_names, law_masjedi_khonsari_rough
   use camroller_number_text, only : integer_text, number_text, right_text
   use camroller_result, only : get_summary, result_t
   use camroller_run, only : run_case
   implicit none
   private

   public :: add_laws_table

   !> One column of the table
   type :: column_t
      !> Scalar of the summary, heading with unit
      character(len=24) :: scalar, heading
      !> What the value is multiplied with [unit/SI unit]
      real(wp) :: factor
   end type column_t

   type(column_t), parameter :: columns(*) = [ &
      column_t("outside_film_range_share", "outside its range [%]", 1.0e2_wp), &
      column_t("mean_torque_contact", "contact [N mm]", 1.0e3_wp), &
      column_t("mean_torque_friction", "all friction [N mm]", 1.0e3_wp), &
      column_t("mean_slip_ratio", "mean slip [%]", 1.0e2_wp), &
      column_t("min_film_thickness_min", "smallest film [um]", 1.0e6_wp), &
      column_t("min_film_ratio", "film ratio", 1.0_wp)]
   !> Digits of numbers; width of the first column, room between columns and their least width
   integer, parameter :: digits = 3, first_width = 22, gap = 2, least_width = 16
   character(len=*), parameter :: n = new_line("a")

contains

   !> Table of one case; a law that the case cannot be run with is told in its line.
   subroutine add_laws_table(case, text)
      !> The case
      type(case_t), intent(in) :: case
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      type(case_t) :: variant
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Values of the laws [unit of the column]
      real(wp) :: values(size(columns)), smallest(size(columns)), largest(size(columns))
      character(len=:), allocatable :: line
      integer :: law, i, laws

      line = repeat(" ", first_width)
      do i = 1, size(columns)
         line = line//right_text(trim(columns(i)%heading), max(least_width, len_trim(columns(i)%heading)) + gap)
      end do
      text = text//n//line
      smallest = huge(1.0_wp)
      largest = -huge(1.0_wp)
      laws = 0
      do law = 1, size(film_law_names)
         if (law == law_masjedi_khonsari_rough .and. .not. case%materials%hardness > 0.0_wp) cycle
         variant = case
         variant%film%law = film_law_names(law)
         variant%film%range_policy = "warn"
         if (allocated(variant%ehl)) deallocate (variant%ehl)
         call run_case(variant, result, failure)
         line = merge("> ", "  ", film_law_names(law) == case%film%law .and. .not. allocated(case%ehl))//film_law_names(law)
         line = line//repeat(" ", max(0, first_width - len(line)))
         if (allocated(failure)) then
            text = text//n//line(:first_width)//"  "//failure%message
            cycle
         end if
         laws = laws + 1
         call get_values(result, values)
         smallest = min(smallest, values)
         largest = max(largest, values)
         line = line(:first_width)
         do i = 1, size(columns)
            line = line//right_text(number_text(values(i), digits), max(least_width, len_trim(columns(i)%heading)) + gap)
         end do
         text = text//n//line
      end do
      if (laws < 2) return
      line = "  range of "//integer_text(laws)//" laws"
      line = line//repeat(" ", max(0, first_width - len(line)))
      do i = 1, size(columns)
         line = line//right_text(number_text(smallest(i), digits)//" to "//number_text(largest(i), digits), &
            & max(least_width, len_trim(columns(i)%heading)) + gap)
      end do
      text = text//n//line
   end subroutine add_laws_table

   !> Values of the columns.
   subroutine get_values(result, values)
      !> Result of a case
      type(result_t), intent(in) :: result
      !> The values [unit of the column]
      real(wp), intent(out) :: values(:)

      type(error_t), allocatable :: error
      integer :: i

      do i = 1, size(columns)
         call get_summary(result, trim(columns(i)%scalar), values(i), error)
         values(i) = columns(i)%factor*values(i)
      end do
   end subroutine get_values

end module camroller_laws_page
