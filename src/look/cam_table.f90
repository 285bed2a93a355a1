!> The cams of a case as a table: contour, radius of curvature, pressure angle.
!>
!> In: a case. Out: lines of comma-separated values, half a degree of cam angle apart.
!> Source: the contour is the envelope of the roller, on the parallel curve of its centre's path, Norton (2009), Cam Design and
!> Manufacturing Handbook, chapter 13.
module camroller_cam_table
   use camroller_kinds, only : wp, degree, pi, two_pi
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_kinematics, only : position_t
   use camroller_model, only : evaluate_geometry, model_t
   use camroller_number_text, only : integer_text, number_text
   use camroller_run, only : build_models
   implicit none
   private

   public :: write_cam_table

   !> Step of the cam angle [rad]
   real(wp), parameter :: step = 0.5_wp*degree
   !> Digits of numbers: a table of lift or contour is differentiated twice
   integer, parameter :: digits = 12
   character(len=*), parameter :: heading = "lobe,cam_angle [deg],valve_lift [mm],polar_angle [deg],cam_radius [mm],cam_x [mm],"// &
      & "cam_y [mm],curvature_radius [mm],pressure_angle [deg]"

contains

   !> Write the table: of each lobe a row for each cam angle, the nose at 180 degrees of cam angle and polar angle, on the axis y.
   subroutine write_cam_table(case, text, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The table
      character(len=:), allocatable, intent(out) :: text
      !> Deck or domain error of its models
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable :: models(:)
      integer :: lobe, i

      text = heading//new_line("a")
      call build_models(case, models, error)
      if (allocated(error)) return
      do lobe = 1, size(models)
         do i = 0, nint(two_pi/step) - 1
            text = text//integer_text(lobe)
            call add_row(models(lobe), i*step - pi, text)
         end do
      end do
   end subroutine write_cam_table

   !> One row behind the number of its lobe.
   subroutine add_row(model, angle, text)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Table so far
      character(len=:), allocatable, intent(inout) :: text

      type(position_t) :: position
      ! Points of the contour here and at the nose, seen from the cam's centre in the cam's frame [m]
      complex(wp) :: point, nose
      ! Curvature of the cam [1/m]; polar angle from the nose [rad]
      real(wp) :: curvature, polar
      character(len=:), allocatable :: radius
      integer :: status

      call evaluate_geometry(model, 0.0_wp, position, status)
      nose = contour_point(model, position, 0.0_wp)
      call evaluate_geometry(model, angle, position, status)
      point = contour_point(model, position, angle)
      ! The polar angle is less than a quarter turn from the cam angle, which tells the turn that it is in
      point = point/(nose/abs(nose))
      polar = angle + model%linkage%sense*phase(point*exp(cmplx(0.0_wp, -model%linkage%sense*angle, wp)))
      curvature = 1.0_wp/position%equivalent_radius - 1.0_wp/model%linkage%roller_radius
      radius = "inf"
      if (abs(curvature)*model%linkage%d > epsilon(1.0_wp)) radius = number_text(1.0e3_wp/curvature, digits)
      call add(180.0_wp + angle/degree)
      call add(1.0e3_wp*position%lift)
      call add(180.0_wp + polar/degree)
      call add(1.0e3_wp*abs(point))
      call add(1.0e3_wp*abs(point)*sin(polar))
      call add(1.0e3_wp*abs(point)*cos(polar))
      text = text//","//radius
      call add(acos(min(1.0_wp, abs(position%normal_arm)/model%linkage%a))/degree)
      text = text//new_line("a")

   contains

      !> Add a number.
      subroutine add(number)
         !> The number [any]
         real(wp), intent(in) :: number

         text = text//","//number_text(number, digits)
      end subroutine add

   end subroutine add_row

   !> The point where the roller touches the cam, from the cam's centre: first axis away from the pivot, second the way the finger
   !> opens, both turned with the cam.
   pure function contour_point(model, position, angle) result(point)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Geometry at the cam angle
      type(position_t), intent(in) :: position
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The point [m]
      complex(wp) :: point

      ! Roller's arm and its centre from the cam's [m]; how the centre moves over the cam [m/rad]; outward normal [-]
      complex(wp) :: arm, centre, travel, outward

      associate (linkage => model%linkage)
         arm = linkage%a*exp(cmplx(0.0_wp, position%arm_angle, wp))
         centre = arm - linkage%d
         travel = cmplx(0.0_wp, 1.0_wp, wp)*(linkage%sense*centre + position%finger_slope*arm)
         outward = -linkage%sense*cmplx(0.0_wp, 1.0_wp, wp)*travel/abs(travel)
         point = (centre - linkage%roller_radius*outward)*exp(cmplx(0.0_wp, linkage%sense*angle, wp))
      end associate
   end function contour_point

   !> Angle of a complex number.
   pure function phase(number) result(angle)
      !> The number [any]
      complex(wp), intent(in) :: number
      !> Its angle [rad]
      real(wp) :: angle

      angle = atan2(aimag(number), real(number, wp))
   end function phase

end module camroller_cam_table
