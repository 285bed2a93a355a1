!> Series of single camshaft bearings.
!>
!> In: a case, states of its bearings. Out: how many series there are, and the series.
module camroller_bearing_series
   use camroller_kinds, only : wp
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_case, only : camshaft_number, case_t
   use camroller_number_text, only : integer_text
   use camroller_result, only : quantity_list_t, add => append_quantity, scope_camshaft
   use camroller_shaft, only : has_orbits
   implicit none
   private

   public :: add_bearings, bearing_count, bearing_series_count

contains

   !> Number of bearings of each camshaft that have series of their own.
   pure function bearing_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      count = 0
      if (.not. allocated(case%cam_bearings)) return
      if (case%cam_bearings%by_bearing) count = size(case%cam_bearings%bearing_positions)
   end function bearing_count

   !> Number of series of single bearings: the last ones of the camshafts.
   pure function bearing_series_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      type(quantity_list_t) :: list

      count = 0
      if (bearing_count(case) == 0) return
      allocate (list%values(0))
      call add_bearings(list, case)
      count = list%count
   end function bearing_series_count

   !> Series of all bearings, one camshaft after the other.
   pure subroutine add_bearings(list, case, states)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> State of each, shape (bearing, camshaft); zero all over where it is not given
      type(bearing_state_t), intent(in), optional :: states(:, :)

      type(bearing_state_t) :: state
      integer :: bearing, shaft

      do shaft = 1, camshaft_number(case)
         do bearing = 1, bearing_count(case)
            if (present(states)) state = states(bearing, shaft)
            if (camshaft_number(case) > 1) then
               call add_bearing(list, case, state, bearing, shaft)
            else
               call add_bearing(list, case, state, bearing)
            end if
         end do
      end do
   end subroutine add_bearings

   !> Series of one bearing.
   pure subroutine add_bearing(list, case, state, bearing, shaft)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> State of the bearing
      type(bearing_state_t), intent(in) :: state
      !> Its number on the shaft, from 1
      integer, intent(in) :: bearing
      !> Camshaft, where there are several
      integer, intent(in), optional :: shaft

      character(len=:), allocatable :: name, words, scope

      name = ""
      words = ""
      scope = ""
      if (allocated(list%items)) then
         scope = "bearing "//integer_text(bearing)
         name = "bearing_"//integer_text(bearing)//"_"
         words = ", bearing "//integer_text(bearing)
         if (present(shaft)) then
            scope = scope_camshaft//" "//integer_text(shaft)//" "//scope
            name = "camshaft_"//integer_text(shaft)//"_"//name
            words = words//" of camshaft "//integer_text(shaft)
         end if
      end if
      call append(list, "load", "N", "force of the shaft", "cam_bearings", norm2(state%load))
      call append(list, "load_x", "N", "part of the force along the line from the first follower's pivot to the cam's centre", &
         & "cam_bearings", state%load(1))
      call append(list, "load_y", "N", "part of the force across that, positive the way a finger turns as it opens its valve", &
         & "cam_bearings", state%load(2))
      call append(list, "eccentricity", "1", "eccentricity of the journal relative to the radial clearance", "cam_bearings", &
         & state%eccentricity)
      if (has_orbits(case)) then
         call append(list, "eccentricity_x", "1", "part of the eccentricity along the line from the first follower's pivot to "// &
            & "the cam's centre", "cam_bearings", state%place(1))
         call append(list, "eccentricity_y", "1", "part of the eccentricity across that, positive the way a finger turns as it "// &
            & "opens its valve", "cam_bearings", state%place(2))
      end if
      call append(list, "film_min", "m", "smallest film", "cam_bearings", state%film)
      call append(list, "torque", "N m", "friction torque", "cam_bearings", state%torque)
      if (allocated(case%bearing_heat)) then
         call append(list, "temperature_rise", "K", "mean temperature of the oil above that supplied", "bearing_heat", &
            & state%temperature_rise)
         call append(list, "oil_flow", "m3 s-1", "oil that leaves at the sides", "bearing_heat", state%oil_flow)
      end if
      if (.not. allocated(case%bearing_asperity)) return
      call append(list, "film_ratio", "1", "smallest film relative to roughness", "bearing_asperity", &
         & state%film/case%bearing_asperity%roughness)
      call append(list, "asperity_load", "N", "part of the load carried by asperities along the line of centres", &
         & "bearing_asperity", state%asperity_load)
      call append(list, "torque_boundary", "N m", "part of the friction torque due to asperities", "bearing_asperity", &
         & state%boundary_torque)

   contains

      !> Append a series.
      pure subroutine append(list, quantity, unit, meaning, source, value)
         !> List to extend
         type(quantity_list_t), intent(inout) :: list
         !> What it is of the bearing, its unit, meaning, part of the model
         character(len=*), intent(in) :: quantity, unit, meaning, source
         !> Value [unit of the series]
         real(wp), intent(in) :: value

         call add(list, name//quantity, unit, meaning//words, source, value, scope)
      end subroutine append

   end subroutine add_bearing

end module camroller_bearing_series
