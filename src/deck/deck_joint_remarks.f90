!> Remarks on the sliding joints of a deck, which take the geometry of its train.
!>
!> In: a deck. Out: sentences. Nothing is refused for them.
module camroller_deck_joint_remarks
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, make_case, override_t
   use camroller_error, only : error_t
   use camroller_joint_setup, only : find_arms
   use camroller_kinds, only : wp
   use camroller_kinematics, only : linkage_t, new_linkage
   use camroller_lift, only : lift_law_t, new_lift_law
   use camroller_number_text, only : number_text
   use camroller_text_lines, only : add_line, line_t
   implicit none
   private

   public :: remark_stem_axis

contains

   !> A stem beside the places where the pad touches its tip, by more than it is wide.
   subroutine remark_stem_axis(deck, left_out, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: key = "guide_side_load.stem_axis_mm"
      ! Width of a stem where none is given [m]; millimetres of a metre [mm/m]
      real(wp), parameter :: usual_stem = 8.0e-3_wp, mm = 1.0e3_wp
      type(override_t) :: none(0)
      type(case_t) :: case
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(error_t), allocatable :: failure
      ! Smallest and largest arm of the pad, width of the stem [m]
      real(wp) :: arms(2), width

      if (any(left_out == key)) return
      call make_case(deck, none, case, failure)
      if (allocated(failure)) return
      if (.not. allocated(case%guide_side_load)) return
      call new_linkage(linkage, case%mechanism, failure)
      if (allocated(failure)) return
      call new_lift_law(law, case%lift, failure)
      if (allocated(failure)) return
      arms = find_arms(linkage, law)
      width = usual_stem
      if (allocated(case%valve_guide)) width = case%valve_guide%stem_diameter
      if (maxval(abs(arms - case%guide_side_load%stem_axis)) <= width) return
      call add_line(remarks, key//" = "//number_text(mm*case%guide_side_load%stem_axis, 4)//": the pad touches the valve's tip "// &
         & number_text(mm*arms(1), 4)//" to "//number_text(mm*arms(2), 4)//" mm from the pivot, beside a stem of "// &
         & number_text(mm*width, 3)//" mm")
   end subroutine remark_stem_axis

end module camroller_deck_joint_remarks
