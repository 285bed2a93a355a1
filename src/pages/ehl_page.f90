!> The tables of the command `ehl` as text.
!>
!> In: solved cycles. Out: lines.
module camroller_ehl_page
   use camroller_kinds, only : wp
   use camroller_ehl_record, only : ehl_record_t, column
   use camroller_ehl_summary, only : ehl_summary_t, mean_over_cycle, film_difference, slip_difference
   use camroller_number_text, only : fixed_text, scientific_text, integer_text, right_text
   implicit none
   private

   public :: ehl_line_t, write_head, write_line, write_friction

   character(len=*), parameter :: n = new_line("a")
   !> Longest line
   integer, parameter :: width = 128
   !> What is compared with closed formulas
   character(len=*), parameter :: compared(*) = [character(len=18) :: "film_min", "film_central", "rolling_resistance", "shear"]

   !> What is printed of a cycle
   type :: ehl_line_t
      !> Number of the case from 0, of the lobe shape from 1, steps of the cycle
      integer :: case_number = 0, lobe = 1, steps = 0
      !> The cycle on the coarser grid, on the finer one, with steady films
      type(ehl_summary_t) :: coarse, fine, steady
      !> Is there a cycle with steady films?
      logical :: has_steady = .false.
      !> Time [s]
      real(wp) :: time = 0.0_wp
      !> Means over the angles with a solved contact of what `compared` names, integrated and by the formula [m], [m], [N], [N]
      real(wp) :: friction(size(compared), 2) = 0.0_wp
   contains
      procedure :: set_friction
   end type ehl_line_t

contains

   !> Film and friction beside the closed formulas.
   subroutine set_friction(self, record)
      class(ehl_line_t), intent(inout) :: self
      !> Record of the cycle
      type(ehl_record_t), intent(in) :: record

      ! 1 where a contact was solved, else 0, and the mean of it [-]
      real(wp) :: is_solved(size(record%angle)), part
      integer :: i

      is_solved = merge(1.0_wp, 0.0_wp, column(record, "peak_pressure") > 0.0_wp)
      part = max(mean_over_cycle(record%angle, is_solved), tiny(1.0_wp))
      do i = 1, size(compared)
         self%friction(i, 1) = mean_over_cycle(record%angle, is_solved*abs(column(record, trim(compared(i)))))/part
         self%friction(i, 2) = mean_over_cycle(record%angle, is_solved*abs(column(record, trim(compared(i))//"_formula")))/part
      end do
   end subroutine set_friction

   !> Head of the table of cycles.
   pure subroutine write_head(text)
      !> Three lines
      character(len=:), allocatable, intent(out) :: text

      text = "Contacts solved over the cycle, on as many nodes as the accuracy requires"//n// &
         & "case lobe  smallest   mean of    mean of    mean slip  | half of the nodes   "// &
         & "| steady films  | nodes   steps    time"//n// &
         & "           film [um]  min. [um]  cent. [um] [m/s]      | film [%]   slip [%] "// &
         & "| differ by [%] |                  [s]"
   end subroutine write_head

   !> Line of the table of cycles.
   pure subroutine write_line(line, text)
      !> The cycle
      type(ehl_line_t), intent(in) :: line
      !> The line
      character(len=:), allocatable, intent(out) :: text

      character(len=width) :: buffer

      associate (fine => line%fine)
         buffer = right_text(integer_text(line%case_number), 4)//right_text(integer_text(line%lobe), 5)// &
            & right_text(fixed_text(1.0e6_wp*fine%smallest_film, 4), 11)//right_text(fixed_text(1.0e6_wp*fine%mean_film, 4), 11)// &
            & right_text(fixed_text(1.0e6_wp*fine%mean_central, 4), 11)//right_text(scientific_text(fine%mean_slip, 3), 12)// &
            & right_text(fixed_text(100.0_wp*film_difference(line%coarse, fine), 3), 12)// &
            & right_text(fixed_text(100.0_wp*slip_difference(line%coarse, fine), 3), 11)
      end associate
      if (line%has_steady) then
         buffer(79:) = right_text(fixed_text(100.0_wp*film_difference(line%steady, line%fine), 3), 14)
      else
         buffer(92:92) = "-"
      end if
      buffer(94:) = right_text(integer_text(line%fine%nodes), 7)//right_text(integer_text(line%steps), 8)// &
         & right_text(fixed_text(line%time, 2), 8)
      text = trim(buffer)
   end subroutine write_line

   !> Table of film and friction beside the closed formulas.
   pure subroutine write_friction(lines, text)
      !> The cycles
      type(ehl_line_t), intent(in) :: lines(:)
      !> The table
      character(len=:), allocatable, intent(out) :: text

      character(len=width) :: buffer
      integer :: i, k

      text = n//"Means over the angles with a film, and deviation of the closed formulas at the same load and slip"//n// &
         & "case lobe  smallest film        central film         rolling resistance   shear of the film"//n// &
         & "           [um]      formula    [um]      formula    [N]       formula    [N]       formula"
      do i = 1, size(lines)
         associate (f => lines(i)%friction)
            buffer = right_text(integer_text(lines(i)%case_number), 4)//right_text(integer_text(lines(i)%lobe), 5)
            do k = 1, 4
               buffer = buffer(:21*k - 12)//right_text(fixed_text(merge(1.0e6_wp, 1.0_wp, k <= 2)*f(k, 1), 4), 11)// &
                  & right_text(fixed_text(change(f(k, 1), f(k, 2)), 1), 8)//" %"
            end do
         end associate
         text = text//n//trim(buffer)
      end do
      text = text//n
   end subroutine write_friction

   !> Change from the first to the second number in percent.
   pure function change(first, second)
      !> Both numbers [any]
      real(wp), intent(in) :: first, second
      !> The change [%]
      real(wp) :: change

      change = 0.0_wp
      if (abs(first) > 0.0_wp) change = 100.0_wp*(second/first - 1.0_wp)
   end function change

end module camroller_ehl_page
