!> The same cases with each film law: how far results depend on a choice that no measurement has made.
!>
!> In: a case. Out: a table with a line for each law and one with the range over all of them. What several lobe shapes have each is
!> that of the worst one, as in the table of `run`.
module camroller_laws_page
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t, select_listed, select_names
   use camroller_catalogue, only : lobe_prefix
   use camroller_film, only : film_law_names, law_masjedi_khonsari_rough
   use camroller_names, only : name_length
   use camroller_number_text, only : integer_text, number_text, right_text
   use camroller_result, only : find_quantity, get_summary, result_t, severest, worse_of
   use camroller_run, only : run_case
   implicit none
   private

   public :: add_laws_table

   !> One column of the table
   type :: column_t
      !> Scalar of the summary: what of a series, its name
      character(len=5) :: statistic
      character(len=name_length) :: series
      !> Heading with unit
      character(len=24) :: heading
      !> What the value is multiplied with [unit/SI unit]
      real(wp) :: factor
   end type column_t

   type(column_t), parameter :: columns(*) = [ &
      column_t("", "outside_film_range_share", "outside its range [%]", 1.0e2_wp), &
      column_t("mean_", "torque_contact", "contact [N mm]", 1.0e3_wp), &
      column_t("mean_", "torque_friction", "all friction [N mm]", 1.0e3_wp), &
      column_t("mean_", "slip_ratio", "mean slip [%]", 1.0e2_wp), &
      column_t("min_", "film_thickness_min", "smallest film [um]", 1.0e6_wp), &
      column_t("min_", "film_ratio", "film ratio", 1.0_wp)]
   !> Digits of numbers; width of the first column, room between columns and their least width
   integer, parameter :: digits = 3, first_width = 22, gap = 2, least_width = 16
   character(len=*), parameter :: n = new_line("a")

contains

   !> Table of one case; a law that the case cannot be run with is told in its line.
   subroutine add_laws_table(case, text, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text
      !> Why the case has no result with its own law, or, where its own film is solved numerically, with any
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: variant
      type(result_t) :: result
      ! Why the law of a line has no result, and why the case's own law has none
      type(error_t), allocatable :: failure, of_own
      ! Values of the laws [unit of the column]
      real(wp) :: values(size(columns)), smallest(size(columns)), largest(size(columns))
      character(len=:), allocatable :: line, worst
      integer :: law, i, laws

      line = repeat(" ", first_width)
      do i = 1, size(columns)
         line = line//right_text(trim(columns(i)%heading), max(least_width, len_trim(columns(i)%heading)) + gap)
      end do
      text = text//n//line
      smallest = huge(1.0_wp)
      largest = -huge(1.0_wp)
      laws = 0
      worst = ""
      do law = 1, size(film_law_names)
         if (law == law_masjedi_khonsari_rough .and. .not. case%materials%hardness > 0.0_wp) cycle
         variant = case
         variant%effects%select = select_names(select_listed)
         variant%film%law = film_law_names(law)
         variant%film%range_policy = "warn"
         if (allocated(variant%ehl)) deallocate (variant%ehl)
         call run_case(variant, result, failure)
         line = merge("> ", "  ", film_law_names(law) == case%film%law .and. .not. allocated(case%ehl))//film_law_names(law)
         line = line//repeat(" ", max(0, first_width - len(line)))
         if (allocated(failure)) then
            text = text//n//line(:first_width)//"  "//failure%message
            if (line(:1) == ">") of_own = failure
            cycle
         end if
         laws = laws + 1
         call get_values(result, values, worst, error)
         if (allocated(error)) return
         smallest = min(smallest, values)
         largest = max(largest, values)
         line = line(:first_width)
         do i = 1, size(columns)
            line = line//right_text(number_text(values(i), digits), max(least_width, len_trim(columns(i)%heading)) + gap)
         end do
         text = text//n//line
      end do
      if (laws >= 2) then
         line = "  range of "//integer_text(laws)//" laws"
         line = line//repeat(" ", max(0, first_width - len(line)))
         do i = 1, size(columns)
            line = line//right_text(number_text(smallest(i), digits)//" to "//number_text(largest(i), digits), &
               & max(least_width, len_trim(columns(i)%heading)) + gap)
         end do
         text = text//n//line
      end if
      if (worst /= "") text = text//n//"  "//worst//": the worst of all lobe shapes"
      if (allocated(case%ehl)) text = text//n//"  the film of the deck itself is solved, by &ehl, and follows none of these laws"
      if (laws == 0 .and. .not. allocated(of_own)) call move_alloc(failure, of_own)
      call move_alloc(of_own, error)
   end subroutine add_laws_table

   !> Values of the columns.
   subroutine get_values(result, values, worst, error)
      !> Result of a case
      type(result_t), intent(in) :: result
      !> The values [unit of the column]
      real(wp), intent(out) :: values(:)
      !> Headings of those that are the worst of several lobe shapes, parted by commas
      character(len=:), allocatable, intent(out) :: worst
      !> Usage error where the result lacks one
      type(error_t), allocatable, intent(out) :: error

      type(column_t) :: shown(size(columns))
      ! Value of another lobe shape [unit of the column]
      real(wp) :: other
      integer :: i, lobe

      worst = ""
      shown = columns
      shown%series = severest(columns%series, find_quantity(result%summary, "max_axial_pressure_max") > 0)
      do i = 1, size(shown)
         call get_summary(result, name_of(shown(i), 1), values(i), error)
         if (allocated(error)) return
         lobe = 2
         do while (find_quantity(result%summary, name_of(shown(i), lobe)) > 0)
            call get_summary(result, name_of(shown(i), lobe), other, error)
            if (allocated(error)) return
            values(i) = worse_of(shown(i)%statistic, values(i), other)
            if (lobe == 2 .and. worst /= "") worst = worst//", "
            if (lobe == 2) worst = worst//heading_of(shown(i))
            lobe = lobe + 1
         end do
         values(i) = shown(i)%factor*values(i)
      end do
   end subroutine get_values

   !> Name of a scalar.
   pure function name_of(column, lobe) result(name)
      !> Its column
      type(column_t), intent(in) :: column
      !> Lobe shape, from 1; what is of the camshaft counts as the first's
      integer, intent(in) :: lobe
      !> The name
      character(len=len_trim(column%statistic) + len_trim(lobe_prefix(lobe)) + len_trim(column%series)) :: name

      name = trim(column%statistic)//trim(lobe_prefix(lobe))//trim(column%series)
   end function name_of

   !> Heading of a column without its unit.
   pure function heading_of(column) result(heading)
      !> The column
      type(column_t), intent(in) :: column
      !> The heading
      character(len=len_trim(column%heading(:index(column%heading//"[", "[") - 1))) :: heading

      heading = column%heading
   end function heading_of

end module camroller_laws_page
