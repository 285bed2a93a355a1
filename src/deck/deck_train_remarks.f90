!> Remarks on the joints of a deck, sliding ones and the finger's pivot, and on its roller: they take the geometry of its train.
!>
!> In: a deck. Out: sentences. Nothing is refused for them.
module camroller_deck_train_remarks
   use camroller_axial_setup, only : last_drops
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, make_case, override_t
   use camroller_error, only : error_t
   use camroller_flexible_setup, only : pivot_share, say_pulled_off
   use camroller_joint_setup, only : find_arms
   use camroller_kinds, only : degree, wp
   use camroller_kinematics, only : evaluate_position, linkage_t, new_linkage, position_t
   use camroller_lift, only : evaluate_lift, lift_law_t, new_lift_law
   use camroller_number_text, only : number_text
   use camroller_text_lines, only : add_line, line_t
   implicit none
   private

   public :: remark_end_drop, remark_stem_axis, remark_pivot

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

   !> A mechanism whose cam and valve pull the finger off its pivot at rest: no other force holds it there.
   subroutine remark_pivot(deck, left_out, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(override_t) :: none(0)
      type(case_t) :: case
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(position_t) :: position
      type(error_t), allocatable :: failure
      ! Lift and its derivatives [m/rad^n]; smallest force on the pivot over the contact load so far, and one of them [-]
      real(wp) :: lift(0:3), least, share
      character(len=:), allocatable :: where, text
      integer :: i, status

      if (any(index(left_out, "mechanism.") == 1)) return
      call make_case(deck, none, case, failure)
      if (.not. allocated(failure)) call new_linkage(linkage, case%mechanism, failure)
      if (.not. allocated(failure)) call new_lift_law(law, case%lift, failure)
      if (allocated(failure)) return
      least = 0.0_wp
      do i = -180, 179
         call evaluate_lift(law, i*degree, lift)
         call evaluate_position(linkage, lift, position, status)
         ! Where the roller passes the line from pivot to cam centre the case is refused
         if (status /= 0 .or. position%normal_arm <= 0.0_wp) cycle
         share = pivot_share(linkage, position, case%mechanism%adjuster_tilt)
         if (share >= least) cycle
         least = share
         where = "most of all at a lift of "//number_text(1.0e3_wp*lift(0), 3)//" mm, by "// &
            & number_text(-100.0_wp*share, 2)//" % of the contact load"
      end do
      if (.not. allocated(where)) return
      call say_pulled_off(case%mechanism, where, text)
      call add_line(remarks, text)
   end subroutine remark_pivot

   !> A drop at the ends of a logarithmic roller that its logarithm reaches within a part of the last slice alone.
   subroutine remark_end_drop(deck, left_out, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: key = "roller_profile.end_drop_um"
      ! Difference in the middle of the last slice of which nothing is seen [-]; micrometres of a metre [um/m]
      real(wp), parameter :: unseen = 0.01_wp, um = 1.0e6_wp
      type(override_t) :: none(0)
      type(case_t) :: case
      type(error_t), allocatable :: failure
      real(wp) :: drops(2) ! in the middle of the last slice, and without a drop at the end [m]

      if (any(left_out == key) .or. any(left_out == "roller_profile.design_load_N")) return
      call make_case(deck, none, case, failure)
      if (allocated(failure)) return
      if (.not. allocated(case%roller_profile)) return
      drops = last_drops(case%roller_profile, case%materials, case%mechanism%contact_width)
      if (.not. drops(2) > 0.0_wp .or. drops(2) - drops(1) > unseen*drops(2)) return
      associate (profile => case%roller_profile)
         call add_line(remarks, key//" = "//number_text(um*profile%end_drop, 4)//" changes next to nothing: the logarithm for "// &
            & "roller_profile.design_load_N = "//number_text(profile%design_load, 4)//" drops by "//number_text(um*drops(2), 3)// &
            & " um in the middle of the last slice, with that drop at the very end or without; a roller that drops farther is "// &
            & "made for a larger load")
      end associate
   end subroutine remark_end_drop

end module camroller_deck_train_remarks
