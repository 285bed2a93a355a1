!> Loads of all slices at one state, solved.
!>
!> In: table of loads, load, radius. Out: load per length of each slice. Between the points of the table loads are cubics of the
!> logarithm of the load, which slices where the load begins and ends do not follow: they lift off. From there the equations of the
!> slices of the loaded part are solved, and the slices of the roller have their means.
module camroller_axial_loads
   use camroller_axial_table, only : axial_part_t, window_between
   use camroller_axial_window, only : load_window, spread_loads, window_t
   use camroller_kinds, only : wp
   implicit none
   private

   public :: solved_loads

contains

   !> Loads of the slices.
   pure subroutine solved_loads(part, load, radius, loads)
      !> The table
      type(axial_part_t), intent(in) :: part
      !> Load, W [N]; equivalent radius, R [m]
      real(wp), intent(in) :: load, radius
      !> Loads per length over W/L; zero without a load [-]
      real(wp), intent(out) :: loads(:)

      type(window_t) :: solution, known
      integer :: status

      loads = 0.0_wp
      if (.not. load > 0.0_wp) return
      call window_between(part, load, radius, known)
      solution = known
      status = 1
      if (load > part%modulus*part%length**2*exp(part%first)) call load_window(solution, part%profile, part%length, part%modulus, &
         & load, radius, status)
      if (status /= 0) solution = known
      call spread_loads(solution, [-0.5_wp, 0.5_wp], loads)
   end subroutine solved_loads

end module camroller_axial_loads
