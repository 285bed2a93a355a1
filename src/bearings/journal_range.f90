!> Which widths of a journal bearing its law is for.
!>
!> In: name of a law, width and diameter. Out: how far the width is outside, in numbers and words.
module camroller_journal_range
   use camroller_kinds, only : wp
   use camroller_journal, only : journal_law_names, law_covers_width, law_finite, law_long, law_short
   use camroller_number_text, only : append_number
   implicit none
   private

   public :: compare_width

   !> Width over diameter to which a bearing counts as short, the usual limit: there the law carries 1.6 times the load of `finite`
   !> at an eccentricity of 0.8; and from which on as long, Cameron (1966), The Principles of Lubrication [-]
   real(wp), parameter :: short_width = 0.5_wp, long_width = 2.0_wp

contains

   !> Compare the width of a bearing with those that its law is for.
   pure subroutine compare_width(law, width, diameter, excess, words)
      !> One of `journal_law_names`
      character(len=*), intent(in) :: law
      !> Width and diameter [m]
      real(wp), intent(in) :: width, diameter
      !> By which factor it is too wide or too narrow; 0 where it is neither [-]
      real(wp), intent(out) :: excess
      !> "is for ...; ... covers ..."; empty where it is neither
      character(len=:), allocatable, intent(out) :: words

      associate (ratio => width/diameter)
         excess = 0.0_wp
         if (law == journal_law_names(law_short)) excess = ratio/short_width
         if (law == journal_law_names(law_long)) excess = long_width/ratio
         words = ""
         if (excess <= 1.0_wp) then
            excess = 0.0_wp
            return
         end if
         if (law == journal_law_names(law_short)) then
            words = "is for bearings narrower than "
            call append_number(words, short_width)
         else
            words = "is for bearings wider than "
            call append_number(words, long_width)
         end if
         words = words//" diameters; "
         if (law_covers_width(journal_law_names(law_finite), width, diameter)) then
            words = words//"'"//trim(journal_law_names(law_finite))//"' covers 0.1 to 1"
         else if (ratio <= short_width) then
            words = words//"'"//trim(journal_law_names(law_short))//"' covers these"
         else if (ratio >= long_width) then
            words = words//"'"//trim(journal_law_names(law_long))//"' covers these"
         else
            words = words//"no law here covers 1 to "
            call append_number(words, long_width)
         end if
      end associate
   end subroutine compare_width

end module camroller_journal_range
