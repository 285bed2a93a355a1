!> Parts of a roller on which the gap between the unloaded bodies is no wider than a depth.
!>
!> In: gaps in the middle of slices of equal length, straight lines between them and on to the ends. Out: the part for a depth, and
!> the depth for a part. Both are exact for these lines, so that the number of slices hardly matters.
module camroller_axial_gaps
   use camroller_kinds, only : wp
   use camroller_sorting, only : sort
   implicit none
   private

   public :: axial_gaps_t, new_axial_gaps, depth_of, part_within

   !> The part of the roller over the depth, straight between the depths of the slices and of both ends
   type :: axial_gaps_t
      !> Depths, rising [m]
      real(wp), allocatable :: depths(:)
      !> Part of the roller where the gap is no wider [-]
      real(wp), allocatable :: parts(:)
   end type axial_gaps_t

contains

   !> Gaps of a roller.
   pure function new_axial_gaps(gaps) result(table)
      !> Gaps in the middle of the slices, two at least [m]
      real(wp), intent(in) :: gaps(:)
      !> Parts over depths
      type(axial_gaps_t) :: table

      ! Gaps in the middle of the slices and at both ends [m]; lengths between them over that of the roller [-]
      real(wp) :: corners(size(gaps) + 2), lengths(size(gaps) + 1)
      integer :: i, n

      n = size(gaps)
      corners = [1.5_wp*gaps(1) - 0.5_wp*gaps(2), gaps, 1.5_wp*gaps(n) - 0.5_wp*gaps(n - 1)]
      lengths = [0.5_wp, (1.0_wp, i=1, n - 1), 0.5_wp]/n
      table%depths = corners
      call sort(table%depths)
      table%parts = [(sum(lengths*part_of_line(corners(:n + 1), corners(2:), table%depths(i))), i=1, n + 2)]
   end function new_axial_gaps

   !> Part of a straight line that is not above a depth.
   elemental function part_of_line(from, to, depth) result(part)
      !> Gaps at its ends [m]
      real(wp), intent(in) :: from, to
      !> The depth [m]
      real(wp), intent(in) :: depth
      !> The part [-]
      real(wp) :: part

      associate (least => min(from, to), most => max(from, to))
         if (depth >= most) then
            part = 1.0_wp
         else if (depth <= least) then
            part = 0.0_wp
         else
            part = (depth - least)/(most - least)
         end if
      end associate
   end function part_of_line

   !> Depth that a part of the roller does not exceed: the least where several do.
   pure function depth_of(table, part) result(depth)
      !> Parts over depths
      type(axial_gaps_t), intent(in) :: table
      !> Part of the roller [-]
      real(wp), intent(in) :: part
      !> The depth [m]
      real(wp) :: depth

      integer :: i

      i = findloc(table%parts >= part, .true., 1)
      depth = table%depths(max(i, 1))
      if (i == 0) depth = table%depths(size(table%depths))
      if (i < 2) return
      associate (share => (part - table%parts(i - 1))/(table%parts(i) - table%parts(i - 1)))
         depth = table%depths(i - 1) + share*(table%depths(i) - table%depths(i - 1))
      end associate
   end function depth_of

   !> Part of the roller where the gap is no wider than a depth.
   pure function part_within(table, depth) result(part)
      !> Parts over depths
      type(axial_gaps_t), intent(in) :: table
      !> The depth [m]
      real(wp), intent(in) :: depth
      !> The part [-]
      real(wp) :: part

      integer :: i

      i = findloc(table%depths > depth, .true., 1)
      part = merge(1.0_wp, 0.0_wp, i == 0)
      if (i < 2) return
      associate (share => (depth - table%depths(i - 1))/(table%depths(i) - table%depths(i - 1)))
         part = table%parts(i - 1) + share*(table%parts(i) - table%parts(i - 1))
      end associate
   end function part_within

end module camroller_axial_gaps
