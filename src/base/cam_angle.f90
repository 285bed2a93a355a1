!> Cam angles as files and messages count them: from 0 to 360 deg, the nose at 180.
!>
!> In: an angle from full lift, as the solver counts it. Out: the angle in degrees, or in words.
module camroller_cam_angle
   use camroller_kinds, only : wp, degree
   use camroller_number_text, only : fixed_text, number_length, write_number
   implicit none
   private

   public :: file_angle, cam_angle_text, append_cam_angle

contains

   !> Cam angle as in files.
   elemental function file_angle(angle) result(degrees)
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The same from 0 to 360 [deg]
      real(wp) :: degrees

      degrees = modulo(180.0_wp + angle/degree, 360.0_wp)
   end function file_angle

   !> Cam angle in the words of messages, as `cam angle 183.250 deg`.
   pure function cam_angle_text(angle, decimals) result(text)
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Digits behind the point
      integer, intent(in) :: decimals
      !> The words
      character(len=len(fixed_text(file_angle(angle), decimals)) + 14) :: text

      text = "cam angle "//fixed_text(file_angle(angle), decimals)//" deg"
   end function cam_angle_text

   !> Append a cam angle in these words to a text.
   pure subroutine append_cam_angle(text, angle, decimals)
      !> The text
      character(len=:), allocatable, intent(inout) :: text
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Digits behind the point
      integer, intent(in) :: decimals

      character(len=number_length) :: buffer

      call write_number(file_angle(angle), "f", decimals, buffer)
      text = text//"cam angle "//trim(adjustl(buffer))//" deg"
   end subroutine append_cam_angle

end module camroller_cam_angle
