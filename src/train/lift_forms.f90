!> Lift as people have it: the roller's instead of the valve's, or the contour of the cam.
!>
!> In: how far the roller's centre is from the cam's, beyond the base circle; or radii of the cam over the polar angle. Out: the
!> lift of the valve over the cam angle. Sources: the triangle of pivot, cam and roller, Islam (2019) eqs. (6), (8) and (9); the
!> roller's centre is on the contour's parallel curve, Norton (2009), Cam Design and Manufacturing Handbook, chapter 13.
module camroller_lift_forms
   use camroller_error, only : error_t
   use camroller_kinds, only : wp
   use camroller_kinematics, only : mechanism_t, rotation_names
   use camroller_lift, only : evaluate_lift, lift_law_t, lift_t, new_lift_law, stop_angles
   use camroller_lift_table, only : find_event
   implicit none
   private

   public :: table_kind_names, kind_valve, kind_roller, kind_contour, valve_lift_of, closes_triangle, follow_table

   !> What a lift table holds: lift of the valve, or of the roller's centre away from the cam's, or radii of the cam
   character(len=*), parameter :: table_kind_names(*) = [character(len=11) :: "valve_lift", "roller_lift", "cam_contour"]
   !> Positions in `table_kind_names`
   integer, parameter :: kind_valve = 1, kind_roller = 2, kind_contour = 3

contains

   !> Cosine of the angle between the lines from the pivot to the roller and to the cam.
   elemental function arm_cosine(mechanism, roller_lift) result(cosine)
      !> Dimensions
      type(mechanism_t), intent(in) :: mechanism
      !> Distance of the roller's centre from the cam's, less that on the base circle [m]
      real(wp), intent(in) :: roller_lift
      !> The cosine; beyond one where no triangle closes [-]
      real(wp) :: cosine

      associate (a => mechanism%pivot_to_roller, d => mechanism%pivot_to_cam, m => mechanism)
         cosine = (a**2 + d**2 - (m%base_radius + m%roller_radius + roller_lift)**2)/(2.0_wp*a*d)
      end associate
   end function arm_cosine

   !> Can the roller be there?
   elemental function closes_triangle(mechanism, roller_lift) result(verdict)
      !> Dimensions
      type(mechanism_t), intent(in) :: mechanism
      !> Lift of the roller [m]
      real(wp), intent(in) :: roller_lift
      !> Can it?
      logical :: verdict

      verdict = .false.
      if (min(mechanism%pivot_to_roller, mechanism%pivot_to_cam) <= 0.0_wp) return
      verdict = abs(arm_cosine(mechanism, roller_lift)) <= 1.0_wp .and. abs(arm_cosine(mechanism, 0.0_wp)) <= 1.0_wp
   end function closes_triangle

   !> Lift of the valve where the roller has a lift.
   elemental function valve_lift_of(mechanism, roller_lift) result(lift)
      !> Dimensions, with which the triangle closes
      type(mechanism_t), intent(in) :: mechanism
      !> Lift of the roller [m]
      real(wp), intent(in) :: roller_lift
      !> Lift of the valve; zero for none [m]
      real(wp) :: lift

      ! Angles of the pad's arm from the valve's axis, on the base circle and now [rad]
      real(wp) :: closed, open

      associate (m => mechanism)
         closed = acos(arm_cosine(m, 0.0_wp)) - m%roller_arm_angle + m%valve_axis_angle
         open = acos(arm_cosine(m, roller_lift)) - m%roller_arm_angle + m%valve_axis_angle
         lift = m%pivot_to_pad*(cos(closed) - cos(open))
      end associate
   end function valve_lift_of

   !> Cam angle and lift of the roller at the rows of a table's event: lifts of the roller, or each point of a cam's contour at the
   !> roller. What is smoothed is the table, before anything follows from it.
   !>
   !> Errors (deck): what `new_lift_law` refuses.
   subroutine follow_table(mechanism, kind, given, first, cam_angle, roller_lift, error)
      !> Dimensions and sense of rotation
      type(mechanism_t), intent(in) :: mechanism
      !> `kind_roller` or `kind_contour`
      integer, intent(in) :: kind
      !> The table with its smoothing: lift of the roller over the cam angle; or radius of the cam less that of the base circle over
      !> the polar angle on the cam, increasing in the order in which points pass the roller; both angles from the nose
      type(lift_t), intent(in) :: given
      !> Its first row that belongs to the event
      integer, intent(out) :: first
      !> Cam angle from that where the roller touches the nose [rad]
      real(wp), allocatable, intent(out) :: cam_angle(:)
      !> Distance of the roller's centre from the cam's, less that on the base circle [m]
      real(wp), allocatable, intent(out) :: roller_lift(:)
      !> Deck error of the table
      type(error_t), allocatable, intent(out) :: error

      type(lift_law_t) :: law
      ! Value of the table and its derivatives [m, m/rad, ...]
      real(wp) :: values(0:3)
      ! Angle of a row, cam angle of the nose [rad]
      real(wp) :: place, nose
      integer :: i, last

      first = 1
      call new_lift_law(law, given, error)
      if (allocated(error)) return
      call find_event(given%table_angle, given%table_lift, given%smoothing, first, last)
      cam_angle = given%table_angle(first:last)
      allocate (roller_lift(size(cam_angle)))
      do i = 1, size(cam_angle)
         ! the last row of a full turn is the first one of the next
         place = given%table_angle(merge(first, first + i - 1, i == size(cam_angle) .and. size(stop_angles(law)) == 0))
         call evaluate_lift(law, place, values)
         roller_lift(i) = values(0)
         if (kind == kind_contour) call touch(mechanism, given%table_angle(first + i - 1), values(:1), cam_angle(i), roller_lift(i))
      end do
      if (kind /= kind_contour) return
      call evaluate_lift(law, 0.0_wp, values)
      call touch(mechanism, 0.0_wp, values(:1), nose, values(3))
      cam_angle = cam_angle - nose
   end subroutine follow_table

   !> The roller at one point of the contour: its centre is a roller's radius away along the normal.
   pure subroutine touch(mechanism, polar, height, cam_angle, roller_lift)
      !> Dimensions and sense of rotation
      type(mechanism_t), intent(in) :: mechanism
      !> Polar angle [rad]
      real(wp), intent(in) :: polar
      !> Height over the base circle and its slope [m, m/rad]
      real(wp), intent(in) :: height(0:1)
      !> Cam angle, from a constant [rad]
      real(wp), intent(out) :: cam_angle
      !> Lift of the roller's centre [m]
      real(wp), intent(out) :: roller_lift

      ! Radius of the contour [m]; outward normal, along the radius and along growing angle [-]; centre of the roller [m]; angle at
      ! the cam's centre between pivot and roller [rad]
      real(wp) :: radius, normal(2), centre(2), opening
      ! Distance of the roller's centre from the cam's [m]; sense of rotation [-]
      real(wp) :: distance, sense

      radius = mechanism%base_radius + height(0)
      normal = [radius, -height(1)]/hypot(radius, height(1))
      centre = [radius, 0.0_wp] + mechanism%roller_radius*normal
      distance = norm2(centre)
      associate (a => mechanism%pivot_to_roller, d => mechanism%pivot_to_cam)
         opening = acos(max(-1.0_wp, min(1.0_wp, (d**2 + distance**2 - a**2)/(2.0_wp*d*distance))))
      end associate
      sense = merge(1.0_wp, -1.0_wp, mechanism%rotation == rotation_names(1))
      cam_angle = polar + atan2(centre(2), centre(1)) + sense*opening
      roller_lift = distance - mechanism%base_radius - mechanism%roller_radius
   end subroutine touch

end module camroller_lift_forms
