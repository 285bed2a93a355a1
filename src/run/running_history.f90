!> The way of surfaces over hours of running: what is listed at evenly spaced times.
!>
!> In: time, surfaces, means of the cycle with them. Out: a row, and what its numbers mean.
module camroller_running_history
   use camroller_kinds, only : wp
   use camroller_cam_surface, only : cam_surface_t
   use camroller_result, only : quantity_list_t, quantity_t, append_quantity
   implicit none
   private

   public :: history_rows, history_row, list_history

   !> Times, the first and the last included
   integer, parameter :: history_rows = 41

contains

   !> What the numbers of a row mean.
   subroutine list_history(quantities)
      !> The quantities
      type(quantity_t), allocatable, intent(out) :: quantities(:)

      type(quantity_list_t) :: list
      type(cam_surface_t) :: surface

      allocate (list%items(0), list%values(0))
      allocate (surface%cam_film(1), surface%cam_wear(1), source=0.0_wp)
      call add_all(list, 0.0_wp, surface, [0.0_wp, 0.0_wp, 0.0_wp])
      quantities = list%items(:list%count)
   end subroutine list_history

   !> A row.
   pure function history_row(time, surface, means) result(row)
      !> Time since the start [s]
      real(wp), intent(in) :: time
      !> Surfaces then
      type(cam_surface_t), intent(in) :: surface
      !> Means over the turn of friction torque [N m], of slip ratio and of coefficient [-]
      real(wp), intent(in) :: means(3)
      !> Numbers, in the order of `list_history` [unit of each]
      real(wp), allocatable :: row(:)

      type(quantity_list_t) :: list

      allocate (list%values(0))
      call add_all(list, time, surface, means)
      row = list%values(:list%count)
   end function history_row

   !> Numbers with their meaning.
   pure subroutine add_all(list, time, surface, means)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> Time since the start [s]
      real(wp), intent(in) :: time
      !> Surfaces then
      type(cam_surface_t), intent(in) :: surface
      !> Means over the turn of friction torque [N m], of slip ratio and of coefficient [-]
      real(wp), intent(in) :: means(3)

      associate (n => size(surface%cam_film))
         call append_quantity(list, "time", "s", "running time", "running_in", time)
         call append_quantity(list, "largest_cam_film", "m", "largest thickness of the tribofilm on the cam", "running_in", &
            & maxval(surface%cam_film))
         call append_quantity(list, "mean_cam_film", "m", "its mean over the cam angle", "running_in", sum(surface%cam_film)/n)
         call append_quantity(list, "roller_film", "m", "thickness of the tribofilm on the roller", "running_in", &
            & surface%roller_film)
         call append_quantity(list, "largest_cam_wear", "m", "largest depth worn away from the cam", "running_in", &
            & maxval(surface%cam_wear))
         call append_quantity(list, "mean_cam_wear", "m", "its mean over the cam angle", "running_in", sum(surface%cam_wear)/n)
         call append_quantity(list, "roller_wear", "m", "depth worn away from the roller", "running_in", surface%roller_wear)
         call append_quantity(list, "mean_friction_torque", "N m", "friction torque of the follower, mean over the turn", &
            & "running_in", means(1))
         call append_quantity(list, "mean_slip_ratio", "1", "slip ratio, mean over the turn", "running_in", means(2))
         call append_quantity(list, "mean_boundary_coefficient", "1", "friction coefficient of the asperities, mean over the "// &
            & "turn", "running_in", means(3))
      end associate
   end subroutine add_all

end module camroller_running_history
