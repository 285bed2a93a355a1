!> Where cam and roller are nearest when the roller's centre is off the path that a rigid train gives it.
!>
!> In: model, cam angle, place and speed of the pivot and of the finger. Out: the nearest point of the pitch
!> curve, normal, approach and its rate, speed of the roller's centre over the cam.
!>
!> Complex plane with the pivot at rest at zero and the cam's centre at D. The roller's centre is z from the cam's centre. The pitch
!> curve is `p(phi) = exp(i eps phi) (A exp(i s(phi)) - D)` on the cam, where s is that of the rigid train at the cam angle phi;
!> `p' . (exp(i eps theta) z - p) = 0` at the nearest point.
module camroller_flexible_geometry
   use camroller_kinds, only : wp
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t, evaluate_geometry
   implicit none
   private

   public :: touch_t, find_touch, dot, cross, imaginary

   !> Geometry of cam and roller
   type :: touch_t
      !> Rigid train at the nearest point: curvature, equivalent radius and their slopes are the cam's there
      type(position_t) :: position
      !> Cam angle at which a rigid train touches that point, phi [rad]
      real(wp) :: angle
      !> Roller arm from pivot to roller centre, A exp(i s) [m]
      complex(wp) :: arm
      !> Roller centre from the cam's centre, z [m], and its speed [m/s]
      complex(wp) :: centre, velocity
      !> Its velocity seen from the cam, w [m/s]
      complex(wp) :: relative
      !> Outward normal n and direction of the roller's way over the cam, -t [-]
      complex(wp) :: normal, forward
      !> Approach, delta [m]; negative where there is a gap
      real(wp) :: approach
      !> Its rate [m/s]
      real(wp) :: approach_rate
      !> Speed of the roller's centre over the cam, S [m/s]
      real(wp) :: travel_speed
      !> 1 - kappa delta, positive where the nearest point is unique [-]
      real(wp) :: uniqueness
      !> Arms of normal and tangent about the cam's centre, h_N and h_F [m]
      real(wp) :: normal_arm, tangent_arm
   end type touch_t

   !> Imaginary unit [-]
   complex(wp), parameter :: imaginary = (0.0_wp, 1.0_wp)
   !> Last change of phi that counts [rad]
   real(wp), parameter :: angle_tolerance = 1.0e-9_wp
   !> Newton steps at most
   integer, parameter :: most_steps = 30
   !> Largest of them [rad]
   real(wp), parameter :: largest_step = 0.2_wp

contains

   !> Find the nearest point and everything about it.
   pure subroutine find_touch(model, angle, finger, finger_rate, pivot, pivot_rate, touch, status)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> Cam angle, theta [rad]
      real(wp), intent(in) :: angle
      !> Finger's angle gamma [rad] and its rate [rad/s]
      real(wp), intent(in) :: finger, finger_rate
      !> Place of the pivot along the adjuster's axis, y [m], and its rate [m/s]
      real(wp), intent(in) :: pivot, pivot_rate
      !> The geometry
      type(touch_t), intent(out) :: touch
      !> 0 fine, positive where there is no unique nearest point, negative where the rigid train is impossible
      integer, intent(out) :: status

      ! Turn from theta to phi [-], rigid roller arm A exp(i s) [m], its place from the cam's centre, turned to where it is [m]
      complex(wp) :: turn, rigid_arm, place
      ! Angle of the roller arm [rad]; speed of the rigid train over the cam, M [m]; 1 + eps gamma' [-]; way left along the tangent
      ! [m]; change of phi [rad]
      real(wp) :: arm_angle, speed, factor, way, change
      integer :: i

      associate (linkage => model%linkage, eps => model%linkage%sense, position => touch%position)
         arm_angle = finger + linkage%arm_offset + linkage%valve_axis_angle
         touch%arm = linkage%a*cmplx(cos(arm_angle), sin(arm_angle), wp)
         touch%centre = pivot*model%flexible%axis + touch%arm - linkage%d
         touch%velocity = pivot_rate*model%flexible%axis + imaginary*finger_rate*touch%arm
         touch%angle = angle
         turn = 1.0_wp
         do i = 1, most_steps
            ! The first point is nearly never the last
            call evaluate_geometry(model, touch%angle, position, status, i == 1)
            if (status /= 0) return
            speed = position%rolling_travel + linkage%roller_radius
            factor = 1.0_wp + eps*position%finger_slope
            ! its arms about the pivot hold the angle s
            rigid_arm = cmplx((position%tangent_arm*speed + linkage%a**2*factor)/linkage%d, position%normal_arm*speed/linkage%d, wp)
            place = turn*(rigid_arm - linkage%d)
            ! Real factors and divisors by components: the compiler takes them for complex numbers
            touch%normal = turn*cmplx((factor*real(rigid_arm, wp) - linkage%d)/speed, factor*aimag(rigid_arm)/speed, wp)
            touch%forward = cmplx(-eps*aimag(touch%normal), eps*real(touch%normal, wp), wp)
            way = dot(touch%forward, touch%centre - place)
            touch%approach = -dot(touch%normal, touch%centre - place)
            touch%uniqueness = 1.0_wp - position%pitch_curvature*touch%approach
            status = 1
            if (.not. touch%uniqueness > 0.0_wp) return
            change = way/(speed*touch%uniqueness)
            status = 0
            if (abs(change) <= angle_tolerance .and. i > 1) exit
            if (i == most_steps) status = 1
            touch%angle = touch%angle + sign(min(abs(change), largest_step), change)
            turn = cmplx(cos(touch%angle - angle), eps*sin(touch%angle - angle), wp)
         end do
         touch%relative = touch%velocity + imaginary*eps*model%speed*touch%centre
         touch%approach_rate = -dot(touch%normal, touch%relative)
         touch%travel_speed = dot(touch%forward, touch%relative)
         touch%normal_arm = eps*cross(touch%normal, touch%centre)
         touch%tangent_arm = dot(touch%normal, touch%centre) - linkage%roller_radius
      end associate
   end subroutine find_touch

   !> Dot product of two vectors.
   elemental function dot(a, b) result(product)
      !> The vectors [any]
      complex(wp), intent(in) :: a, b
      !> Their product [any]
      real(wp) :: product

      product = real(a, wp)*real(b, wp) + aimag(a)*aimag(b)
   end function dot

   !> Cross product of two vectors.
   elemental function cross(a, b) result(product)
      !> The vectors [any]
      complex(wp), intent(in) :: a, b
      !> Their product [any]
      real(wp) :: product

      product = real(a, wp)*aimag(b) - aimag(a)*real(b, wp)
   end function cross

end module camroller_flexible_geometry
