!> Check of a cam with its roller: can it be made, and does the finger reach every lift?
!>
!> In: model, radius of the grinding wheel. Out: an error that names the cam angle.
module camroller_cam_check
   use camroller_cam_angle, only : cam_angle_text
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_minimum, only : minimum_t, start_minimum, narrow_minimum
   use camroller_kinds, only : wp, degree, pi
   use camroller_lift, only : is_tabulated
   use camroller_kinematics, only : position_t
   use camroller_lift_pieces, only : find_edges, scan_t, start_scan, has_next, next_angle
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_number_text, only : number_text, in_mm => millimetres_text
   implicit none
   private

   public :: check_geometry

   !> Part of the bend that a path may have from which on the scan is refined [-]
   real(wp), parameter :: nearly_too_much = 0.5_wp

contains

   !> Refuse a cam that cannot be: lift out of reach, undercut, a hollow flank that the grinding wheel does not fit. Where the
   !> path of the roller's centre is bent most and nearly as much as it may be, that place is looked for between the steps.
   subroutine check_geometry(model, grinding_wheel_radius, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Radius of the grinding wheel, zero where not given [m]
      real(wp), intent(in) :: grinding_wheel_radius
      !> Domain error that names the cam angle
      type(error_t), allocatable, intent(out) :: error

      ! Ends of the pieces of the lift [rad]
      real(wp), allocatable :: edges(:)
      ! Three neighbouring angles of the scan [rad], how much the path is bent there, over what it may be [-]
      real(wp) :: angles(3), bends(3)
      type(scan_t) :: scan
      integer :: i

      call find_edges(model, -pi, pi, edges)
      call start_scan(scan, edges)
      angles = -pi
      bends = 0.0_wp
      i = 0
      do while (i == 0 .or. has_next(scan, edges))
         i = i + 1
         angles(:2) = angles(2:)
         if (i > 1) call next_angle(scan, edges, angles(3))
         bends(:2) = bends(2:)
         call check_position(model, grinding_wheel_radius, angles(3), bends(3), error)
         if (allocated(error)) return
         if (i < 3 .or. bends(2) < max(nearly_too_much, bends(1), bends(3))) cycle
         call check_summit(model, grinding_wheel_radius, angles, bends, error)
         if (allocated(error)) return
      end do
   end subroutine check_geometry

   !> Refuse a cam whose roller path bends too sharply at its sharpest point between two angles.
   subroutine check_summit(model, grinding_wheel_radius, angles, bends, error)
      type(model_t), intent(in) :: model
      !> Radius of the grinding wheel, zero where not given [m]
      real(wp), intent(in) :: grinding_wheel_radius
      !> Three angles of the scan [rad]
      real(wp), intent(in) :: angles(3)
      !> How much the path is bent there, over what it may be, the middle one largest [-]
      real(wp), intent(in) :: bends(3)
      !> Domain error that names the cam angle
      type(error_t), allocatable, intent(out) :: error

      type(minimum_t) :: search
      real(wp) :: bend ! [-]

      call start_minimum(search, angles, -bends, epsilon(1.0_wp))
      do while (search%is_wanted)
         call check_position(model, grinding_wheel_radius, search%trial, bend, error)
         if (allocated(error)) return
         call narrow_minimum(search, -bend)
      end do
   end subroutine check_summit

   !> Refuse a cam that cannot be at one angle.
   subroutine check_position(model, grinding_wheel_radius, angle, bend, error)
      type(model_t), intent(in) :: model
      !> Radius of the grinding wheel, zero where not given [m]
      real(wp), intent(in) :: grinding_wheel_radius
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Curvature of the path of the roller's centre over that at which it undercuts, or the wheel does not fit [-]
      real(wp), intent(out) :: bend
      !> Domain error that names the cam angle
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      character(len=:), allocatable :: advice
      integer :: status

      bend = 0.0_wp
      call evaluate_geometry(model, angle, position, status)
      if (status /= 0) then
         call raise(error, kind_domain, "the finger cannot reach the lift of "//in_mm(position%lift)//" mm at "// &
            & cam_angle_text(angle, 2)//": its pad stands at "//number_text(acos(model%linkage%base_cosine)/degree, 3)// &
            & " deg from the valve's axis on the base circle and can open the valve by "// &
            & in_mm(model%linkage%b*(1.0_wp + model%linkage%base_cosine))//" mm, until it lies along that axis; is one of "// &
            & "mechanism.pivot_to_pad_mm, mechanism.valve_axis_angle_deg, mechanism.roller_arm_angle_deg, "// &
            & "mechanism.base_radius_mm wrong, or the lift, as max_lift_mm?")
         return
      end if
      ! Hollow where the curvature is negative: |R_c| = -1/kappa + r_R
      bend = position%pitch_curvature*model%roller_radius
      if (grinding_wheel_radius > 0.0_wp) bend = max(bend, -position%pitch_curvature*(grinding_wheel_radius - model%roller_radius))
      if (position%normal_arm <= 0.0_wp) then
         call raise(error, kind_domain, "the roller passes the line from pivot to cam centre at "//cam_angle_text(angle, 2)// &
            & ", at a lift of "//in_mm(position%lift)//" mm, with mechanism.pivot_to_roller_mm = "//in_mm(model%linkage%a)// &
            & " and mechanism.pivot_to_cam_mm = "//in_mm(model%linkage%d))
      else if (position%equivalent_radius <= 0.0_wp) then
         advice = "a larger mechanism.base_radius_mm, a smaller roller or a longer or lower lift avoids it"
         if (is_tabulated(model%lift_law)) advice = "noise of a lift table, or a row that is off, bends the path so: "// &
            & "'smoothing_um' beside the table, or the right row, avoids it; else "//advice
         call raise(error, kind_domain, "cam undercut: the path of the roller's centre has a radius of curvature of "// &
            & in_mm(1.0_wp/position%pitch_curvature)//" mm at "//cam_angle_text(angle, 2)//", smaller than roller.radius_mm = "// &
            & in_mm(model%roller_radius)//"; "//advice)
      else if (bend > 1.0_wp) then
         call raise(error, kind_domain, "hollow flank: the cam's radius of curvature is "// &
            & in_mm(model%roller_radius - 1.0_wp/position%pitch_curvature)//" mm at "//cam_angle_text(angle, 2)// &
            & ", less than the grinding wheel's, mechanism.grinding_wheel_radius_mm = "//in_mm(grinding_wheel_radius))
      end if
   end subroutine check_position

end module camroller_cam_check
