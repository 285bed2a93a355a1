module camroller_journal
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: cam_bearings_t, journal_law_names

   !> Journal bearing laws
   character(len=*), parameter :: journal_law_names(*) = [character(len=name_length) :: &
      "long_full_sommerfeld", "short_ocvirk", "finite"]

   !> Camshaft and its bearings
   type :: cam_bearings_t
      !> One of `journal_law_names`
      character(len=name_length) :: law = "long_full_sommerfeld"
      !> Diameter of the journals [m]
      real(wp) :: diameter = 0.0_wp
      !> Width of a bearing [m]
      real(wp) :: width = 0.0_wp
      !> Radial clearance [m]
      real(wp) :: radial_clearance = 0.0_wp
      !> Places of the bearings along the shaft, increasing [m]
      real(wp), allocatable :: bearing_positions(:)
      !> Places of the cams along the shaft, between the first and the last bearing [m]
      real(wp), allocatable :: cam_positions(:)
      !> Angle by which each cam's event follows the first cam's [rad]
      real(wp), allocatable :: cam_phases(:)
      !> Lobe shape of each cam: 1 is the case's lift, 2 its second lift
      integer, allocatable :: cam_lobes(:)
      !> Direction from cam centre to the first cam's pivot is the x axis; each follower stands at this angle from it [rad]
      real(wp), allocatable :: follower_angles(:)
   end type cam_bearings_t

end module camroller_journal
