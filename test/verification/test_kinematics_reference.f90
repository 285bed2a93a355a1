!> Kinematics against a direct geometric construction in high precision.
!>
!> The table is made by test/reference/kinematics_reference.py: position of the roller centre in the plane, differentiated
!> numerically with 50 digits, without any of the formulas under test.
module test_kinematics_reference
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_kinematics, only : linkage_t, position_t, rotation_names, new_linkage, evaluate_position
   use camroller_lift, only : lift_law_t, new_lift_law, evaluate_lift
   use labelled_table, only : label_length, read_table
   use closeness, only : check_scaled
   use reference_cases, only : thesis_case, skewed_case
   implicit none
   private

   public :: collect_kinematics_reference

   !> Numbers in a row of the table
   integer, parameter :: columns = 20
   !> Accuracy demanded against the construction [-]
   real(wp), parameter :: tolerance = 1.0e-10_wp
   !> Sizes that the quantities are judged by: a length and a speed per cam speed [m]
   real(wp), parameter :: length_scale = 1.0e-2_wp

contains

   subroutine collect_kinematics_reference(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("every quantity agrees with an independent construction, for two geometries and both senses of rotation", &
            & test_table), &
         new_unittest("the thesis's lift law agrees with the independent construction", test_lift_values), &
         new_unittest("slopes of surface and rolling travel agree with central differences", test_slopes) &
         ]
   end subroutine collect_kinematics_reference

   !> Geometry of a row of the table.
   subroutine make_linkage(name, sense, linkage)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: sense
      type(linkage_t), intent(out) :: linkage
      type(case_t) :: case
      type(error_t), allocatable :: failure

      case = thesis_case()
      if (name == "skewed") case = skewed_case(rotation_names(1))
      case%mechanism%rotation = rotation_names(merge(1, 2, sense > 0.0_wp))
      call new_linkage(linkage, case%mechanism, failure)
      if (allocated(failure)) error stop "a valid mechanism is refused"
   end subroutine make_linkage

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(linkage_t) :: linkage
      type(position_t) :: position
      integer :: i, status

      call read_table("kinematics_reference.csv", columns, rows, error, names)
      if (allocated(error)) return
      if (size(names) < 40) call test_failed(error, "rows are missing")
      if (allocated(error)) return
      do i = 1, size(names)
         call make_linkage(names(i), rows(1, i), linkage)
         call evaluate_position(linkage, [rows(3:5, i), 0.0_wp], position, status)
         call compare(linkage, position, rows(:, i), error)
         if (allocated(error)) then
            error%message = trim(names(i))//": "//error%message
            return
         end if
      end do
   end subroutine test_table

   !> All quantities of a row. Angles and slopes are of order one; curvatures are judged by the roller's, radii through them, since
   !> flanks are nearly straight in places.
   subroutine compare(linkage, position, row, error)
      type(linkage_t), intent(in) :: linkage
      type(position_t), intent(in) :: position
      real(wp), intent(in) :: row(:)
      type(error_type), allocatable, intent(out) :: error

      ! gamma [rad], curvature of the roller and of the cam [1/m]
      real(wp) :: gamma, roller_curvature, cam_curvature
      character(len=24), parameter :: names(14) = [character(len=24) :: "gamma", "gamma'", "gamma''", "pitch speed", &
         "pitch radius", "cam radius", "pitch curvature", "cam curvature", "equivalent radius", "contact speed", "rolling speed", &
         "its derivative", "normal arm", "friction arm"]
      ! Value and the size it is judged by, with the same for the tangent's arm last [unit of the quantity]
      real(wp) :: values(15), scales(15), expected(15)
      integer :: i

      roller_curvature = 1.0_wp/linkage%roller_radius
      gamma = position%arm_angle - linkage%arm_offset - linkage%valve_axis_angle
      cam_curvature = position%pitch_curvature/(1.0_wp - linkage%roller_radius*position%pitch_curvature)
      values = [gamma, position%finger_slope, position%finger_curvature, position%rolling_travel + linkage%roller_radius, &
         position%pitch_curvature, cam_curvature, position%pitch_curvature, cam_curvature, position%equivalent_radius, &
         position%surface_travel, position%rolling_travel, position%rolling_travel_slope, position%normal_arm, position%cam_arm, &
         position%tangent_arm]
      expected = row(6:20)
      expected(5:6) = 1.0_wp/expected(5:6)
      scales = length_scale
      scales(1:3) = 1.0_wp
      scales(5:8) = roller_curvature
      do i = 1, size(values)
         call check_scaled(error, values(i), expected(i), scales(i), tolerance, trim(names(min(i, 14))))
         if (allocated(error)) return
      end do
   end subroutine compare

   subroutine test_lift_values(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(case_t) :: case
      type(lift_law_t) :: law
      type(error_t), allocatable :: failure
      ! Lift and derivatives [m/rad^n]
      real(wp) :: lift(0:3)
      integer :: i, k

      call read_table("kinematics_reference.csv", columns, rows, error, names)
      if (allocated(error)) return
      case = thesis_case()
      call new_lift_law(law, case%lift, failure)
      do i = 1, size(names)
         if (names(i) /= "thesis") cycle
         call evaluate_lift(law, rows(2, i)*degree, lift)
         do k = 0, 2
            ! the angle is read in degrees and converted: a rounding or two of an angle up to 1.2 rad
            call check_scaled(error, lift(k), rows(3 + k, i), length_scale, 1.0e-14_wp, "lift or a derivative")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_lift_values

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(error_t), allocatable :: failure
      type(position_t) :: here, before, after
      ! Step, angle [rad]; lift and derivatives [m/rad^n]
      real(wp), parameter :: step = 2.0e-6_wp
      real(wp) :: angle, lift(0:3)
      integer :: i, sense, status

      case = thesis_case()
      case%lift%law = "polynomial_4567"
      case%lift%closing_half_angle = 60.0_wp*degree
      call new_lift_law(law, case%lift, failure)
      do sense = -1, 1, 2
         call make_linkage("thesis", real(sense, wp), linkage)
         do i = -12, 11
            angle = (5.0_wp*i + 1.0_wp)*degree
            call evaluate_lift(law, angle - step, lift)
            call evaluate_position(linkage, lift, before, status)
            call evaluate_lift(law, angle + step, lift)
            call evaluate_position(linkage, lift, after, status)
            call evaluate_lift(law, angle, lift)
            call evaluate_position(linkage, lift, here, status)
            ! truncation step^2/6 of a third derivative up to 1e3 of the scale, round-off epsilon/step: both below 1e-9
            call check_scaled(error, (after%surface_travel - before%surface_travel)/(2.0_wp*step), here%surface_travel_slope, &
               length_scale, sqrt(epsilon(1.0_wp)), "slope of the surface travel")
            if (allocated(error)) return
            call check_scaled(error, (after%rolling_travel - before%rolling_travel)/(2.0_wp*step), here%rolling_travel_slope, &
               length_scale, sqrt(epsilon(1.0_wp)), "slope of the rolling travel")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_slopes

end module test_kinematics_reference
