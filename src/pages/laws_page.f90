!> The same cases with each film law: how far results depend on a choice that no measurement has made.
!>
!> In: a case. Out: a table with a line for each law and one with the range over those that go together with the case's asperities;
!> laws that a remark of `run` would tell to be outside of their range, or not to go together, are marked. What several lobe shapes
!> have each is that of the worst one, as in the table of `run`.
module camroller_laws_page
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t, select_listed, select_names
   use camroller_catalogue, only : lobe_prefix
   use camroller_film, only : film_law_names, law_masjedi_khonsari_rough
   use camroller_names, only : name_length
   use camroller_number_text, only : integer_text, number_text, right_text
   use camroller_remarks, only : foreign_asperities, outside_range
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
   !> Marks of a law: outside of its range; with asperities that do not go with its film
   character(len=*), parameter :: outside_mark = "*", foreign_mark = "+"
   !> Digits of numbers; width of the first column, which has two letters before and two marks behind a name; room between columns
   !> and their least width
   integer, parameter :: digits = 3, first_width = 2 + maxval(len_trim(film_law_names)) + 2, gap = 2, least_width = 16
   character(len=*), parameter :: n = new_line("a")

   !> What is known of all laws
   type :: found_t
      !> Laws with a result, and those of them that the range is of
      integer :: results = 0, laws = 0
      !> That range [unit of the column]
      real(wp) :: smallest(size(columns)) = huge(1.0_wp), largest(size(columns)) = -huge(1.0_wp)
      !> Is one outside of its published range?
      logical :: is_outside = .false.
      !> Why one does not go together with the asperities
      character(len=:), allocatable :: foreign
      !> Headings of what is the worst of several lobe shapes, parted by commas
      character(len=:), allocatable :: worst
      !> Why the last law has no result, and why the case's own law has none
      type(error_t), allocatable :: failure, of_own
   end type found_t

contains

   !> Table of one case; a law that the case cannot be run with is told in its line.
   subroutine add_laws_table(case, text, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text
      !> Why the case has no result with its own law, or, where its own film is solved numerically, with any
      type(error_t), allocatable, intent(out) :: error

      type(found_t) :: found
      character(len=:), allocatable :: line
      integer :: law, i

      found%worst = ""
      line = repeat(" ", first_width)
      do i = 1, size(columns)
         line = line//right_text(trim(columns(i)%heading), max(least_width, len_trim(columns(i)%heading)) + gap)
      end do
      text = text//n//line
      do law = 1, size(film_law_names)
         if (law == law_masjedi_khonsari_rough .and. .not. case%materials%hardness > 0.0_wp) cycle
         call add_law(case, law, found, text, error)
         if (allocated(error)) return
      end do
      if (found%laws >= 2) then
         line = padded("  range of "//integer_text(found%laws)//" laws")
         do i = 1, size(columns)
            line = line//right_text(number_text(found%smallest(i), digits)//" to "//number_text(found%largest(i), digits), &
               & max(least_width, len_trim(columns(i)%heading)) + gap)
         end do
         text = text//n//line
      end if
      if (found%is_outside) text = text//n//"  "//outside_mark//" outside its published range; a remark of 'camroller run' "// &
         & "with it says how far"
      if (allocated(found%foreign)) text = text//n//"  "//foreign_mark//" left out of the range: "//found%foreign
      if (found%worst /= "") text = text//n//"  "//found%worst//": the worst of all lobe shapes"
      if (allocated(case%ehl)) text = text//n//"  the film of the deck itself is solved, by &ehl, and follows none of these laws"
      if (found%results == 0 .and. .not. allocated(found%of_own)) call move_alloc(found%failure, found%of_own)
      call move_alloc(found%of_own, error)
   end subroutine add_laws_table

   !> Line of a law.
   subroutine add_law(case, law, found, text, error)
      type(case_t), intent(in) :: case
      !> Position of the law in `film_law_names`
      integer, intent(in) :: law
      !> What is known of all laws so far
      type(found_t), intent(inout) :: found
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text
      !> Usage error where a result lacks a column
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: variant
      type(result_t) :: result
      real(wp) :: values(size(columns)) ! [unit of the column]
      character(len=:), allocatable :: name
      integer :: i

      variant = case
      variant%effects%select = select_names(select_listed)
      variant%film%law = film_law_names(law)
      variant%film%range_policy = "warn"
      if (allocated(variant%ehl)) deallocate (variant%ehl)
      call run_case(variant, result, found%failure)
      name = merge("> ", "  ", film_law_names(law) == case%film%law .and. .not. allocated(case%ehl))//trim(film_law_names(law))
      if (allocated(found%failure)) then
         text = text//n//padded(name)//"  "//found%failure%message
         if (name(:1) == ">") found%of_own = found%failure
         return
      end if
      found%results = found%results + 1
      call get_values(result, values, found%worst, error)
      if (allocated(error)) return
      if (any(result%remarks%kind == outside_range)) then
         found%is_outside = .true.
         name = name//outside_mark
      end if
      i = findloc(result%remarks%kind, foreign_asperities, dim=1)
      if (i > 0) then
         found%foreign = result%remarks(i)%text
         name = name//foreign_mark
      else
         found%laws = found%laws + 1
         found%smallest = min(found%smallest, values)
         found%largest = max(found%largest, values)
      end if
      text = text//n//padded(name)
      do i = 1, size(columns)
         text = text//right_text(number_text(values(i), digits), max(least_width, len_trim(columns(i)%heading)) + gap)
      end do
   end subroutine add_law

   !> A text as wide as the first column.
   pure function padded(words)
      !> The text
      character(len=*), intent(in) :: words
      !> It with blanks behind it
      character(len=max(first_width, len(words))) :: padded

      padded = words
   end function padded

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
            if (lobe == 2) worst = worst//trim(shown(i)%heading(:index(shown(i)%heading//"[", "[") - 1))
            lobe = lobe + 1
         end do
         values(i) = shown(i)%factor*values(i)
      end do
   end subroutine get_values

   !> Name of a scalar.
   pure function name_of(column, lobe) result(name)
      type(column_t), intent(in) :: column
      !> Lobe shape, from 1; what is of the camshaft counts as the first's
      integer, intent(in) :: lobe
      !> The name
      character(len=len_trim(column%statistic) + len_trim(lobe_prefix(lobe)) + len_trim(column%series)) :: name

      name = trim(column%statistic)//trim(lobe_prefix(lobe))//trim(column%series)
   end function name_of

end module camroller_laws_page
