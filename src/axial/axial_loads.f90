!> Loads of all slices at one state, solved.
!>
!> In: table of loads, load, radius. Out: load per length of each slice. Between the points of the table loads are cubics of the
!> logarithm of the load, which slices where the load begins and ends do not follow: they lift off. From there the equations of the
!> slices are solved, where the slices resolve the contact.
module camroller_axial_loads
   use camroller_kinds, only : wp
   use camroller_axial_table, only : axial_part_t, slice_loads
   use camroller_roller_profile, only : coupling_half_space, coupling_names
   use camroller_slices, only : load_slices, new_slices, slices_t
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

      type(slices_t) :: slices
      real(wp) :: solution(size(loads)), approach ! [-], [m]
      integer :: status

      call slice_loads(part, load, radius, loads)
      if (.not. load > part%modulus*part%length**2*exp(part%first)) return
      call new_slices(slices, part%length, part%modulus, part%gaps, part%profile%coupling == coupling_names(coupling_half_space))
      solution = loads
      call load_slices(slices, load, radius, solution, approach, status)
      if (status == 0) loads = solution
   end subroutine solved_loads

end module camroller_axial_loads
