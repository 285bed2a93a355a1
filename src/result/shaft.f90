!> The camshaft: all followers together, and the bearings that carry them.
!>
!> In: case, models and cycles of the lobe shapes. Out: torques of the followers and bearings of each camshaft at a cam angle; the
!> series of single bearings, where a case asks for them.
!> Each cam sees the cycle of its lobe shape at its own phase, by the shape's curve where that is good enough; without camshaft
!> bearings in the case there is one cam.
module camroller_shaft
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_case, only : camshaft_number, case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_lobe_curve, only : lobe_curve_t, close_curve, curve_at, curve_values, cam_values, halve_pieces, &
      & keep_state, piece_angle
   use camroller_number_text, only : integer_text
   use camroller_panels, only : panel_points
   use camroller_result, only : quantity_list_t, add => append_quantity, scope_camshaft
   use camroller_torque_list, only : torque_count, of_bearings
   use camroller_journal, only : cam_bearings_t, journal_t, new_journal, journal_solved
   use camroller_bearing_asperity, only : touch_t, bearing_state_t, new_touch, carry_load
   use camroller_camshaft, only : belt_pull_t, share_force, share_pull
   implicit none
   private

   public :: shaft_t, solved_t, new_shaft, set_journal, refine_curves, shaft_torques, in_common_frame, bearing_torques
   public :: add_bearings, bearing_count, bearing_series_count

   !> Cams of a shaft
   type :: shaft_t
      !> Lobe shape of each cam
      integer, allocatable :: lobes(:)
      !> Camshaft of each cam, and the number of camshafts
      integer, allocatable :: shafts(:)
      integer :: count = 1
      !> Angle by which each cam's event follows the first one's [rad]
      real(wp), allocatable :: phases(:)
      !> Cosine and sine of the angle at which each follower stands, shape (2, cam) [-]
      real(wp), allocatable :: directions(:, :)
      !> Interval of the cycle where each cam's search starts
      integer, allocatable :: hints(:)
      !> Bearings; allocated where the case has them
      type(cam_bearings_t), allocatable :: bearings
      type(journal_t), allocatable :: journal
      !> Their surfaces, and the pull of belt or chain; allocated where the case has them
      type(touch_t), allocatable :: touch
      type(belt_pull_t), allocatable :: pull
   end type shaft_t

   !> A case that is solved: model and cycle of each lobe shape, and the camshafts that carry them
   type :: solved_t
      type(case_t), pointer :: case => null()
      type(model_t), pointer :: models(:) => null()
      type(cycle_t), pointer :: cycles(:) => null()
      !> What the camshaft takes from each follower, as a curve
      type(lobe_curve_t), pointer :: curves(:) => null()
      type(shaft_t) :: shaft
   end type solved_t

contains

   !> Cams and bearings of a case.
   subroutine new_shaft(shaft, case, viscosity, speed, error)
      !> The shaft
      type(shaft_t), intent(out) :: shaft
      !> The case
      type(case_t), intent(in) :: case
      !> Viscosity of the oil at ambient pressure [Pa s], cam speed [rad/s]
      real(wp), intent(in) :: viscosity, speed
      !> Deck or domain error of the bearings
      type(error_t), allocatable, intent(out) :: error

      integer :: cams

      if (.not. allocated(case%cam_bearings)) then
         shaft%lobes = [1]
         shaft%shafts = [1]
         shaft%phases = [0.0_wp]
         shaft%hints = [1]
         allocate (shaft%directions(2, 1))
         shaft%directions(:, 1) = [1.0_wp, 0.0_wp]
         return
      end if
      cams = size(case%cam_bearings%cam_positions)
      shaft%bearings = case%cam_bearings
      shaft%phases = case%cam_bearings%cam_phases
      shaft%lobes = case%cam_bearings%cam_lobes
      shaft%count = camshaft_number(case)
      allocate (shaft%shafts(cams))
      shaft%shafts = 1
      if (allocated(case%cam_bearings%cam_shafts)) shaft%shafts = case%cam_bearings%cam_shafts
      allocate (shaft%directions(2, cams), shaft%hints(cams))
      shaft%directions(1, :) = cos(case%cam_bearings%follower_angles)
      shaft%directions(2, :) = sin(case%cam_bearings%follower_angles)
      shaft%hints = 1
      allocate (shaft%journal)
      call set_journal(shaft, viscosity, speed, error)
      if (allocated(error)) return
      if (allocated(case%belt_pull)) shaft%pull = case%belt_pull
      if (.not. allocated(case%bearing_asperity)) return
      allocate (shaft%touch)
      call new_touch(shaft%touch, case%bearing_asperity, case%cam_bearings%radial_clearance, error)
   end subroutine new_shaft

   !> Set the bearings, where there are any, to another viscosity and speed.
   subroutine set_journal(shaft, viscosity, speed, error)
      !> The shaft
      type(shaft_t), intent(inout) :: shaft
      !> Viscosity of the oil at ambient pressure [Pa s], cam speed [rad/s]
      real(wp), intent(in) :: viscosity, speed
      !> Deck or domain error of the bearings
      type(error_t), allocatable, intent(out) :: error

      if (allocated(shaft%journal)) call new_journal(shaft%journal, shaft%bearings, viscosity, speed, error)
   end subroutine set_journal

   !> Make the curves better of shapes that several cams have, so that it pays.
   subroutine refine_curves(solved, error)
      !> The solved case
      type(solved_t), intent(inout) :: solved
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      do lobe = 1, size(solved%models)
         if (count(solved%shaft%lobes == lobe) < 2) cycle
         call refine_curve(solved%models(lobe), solved%cycles(lobe), solved%curves(lobe), error)
         if (allocated(error)) return
      end do
   end subroutine refine_curves

   !> Halve the pieces of a follower's curve that are not good enough.
   subroutine refine_curve(model, cycle, curve, error)
      !> Model of the lobe shape
      type(model_t), intent(in) :: model
      !> Its cycle
      type(cycle_t), intent(in) :: cycle
      !> Its curve
      type(lobe_curve_t), intent(inout) :: curve
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Times that a piece is halved: what is left of a kink is a small part of the turn
      integer, parameter :: most_halvings = 6
      type(state_t) :: state
      integer, allocatable :: halves(:)
      integer :: pass, i, point, hint

      hint = 1
      do pass = 1, most_halvings
         call halve_pieces(curve, halves)
         if (size(halves) == 0) return
         do i = 1, size(halves)
            do point = 1, panel_points
               call state_at(cycle, model, piece_angle(curve, halves(i), point), hint, state, error)
               if (allocated(error)) return
               call keep_state(curve, model, state, point, halves(i))
            end do
         end do
         call close_curve(curve, cycle%tolerance)
      end do
   end subroutine refine_curve

   !> Torques at a cam angle.
   subroutine shaft_torques(solved, angle, torques, error, first_state, bearings)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> Torques of all followers and bearings of each camshaft, the rows of `torque_list` [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(:, :)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error
      !> State of the first cam's follower there; with it all others are solved as well, and no curve is taken for them
      type(state_t), intent(in), optional :: first_state
      !> States of the bearings, shape (bearing, camshaft)
      type(bearing_state_t), intent(out), optional :: bearings(:, :)

      type(state_t) :: state
      ! Torques and force of a cam [N m, N]; force on each cam in the frame of the first follower [N]
      real(wp) :: values(curve_values), forces(2, size(solved%shaft%lobes))
      integer :: cam
      logical :: is_known

      torques = 0.0_wp
      associate (shaft => solved%shaft)
         do cam = 1, size(shaft%lobes)
            associate (model => solved%models(shaft%lobes(cam)), place => angle - shaft%phases(cam))
               is_known = cam == 1 .and. present(first_state)
               if (is_known) then
                  values = cam_values(model, first_state)
               else if (.not. present(first_state)) then
                  call curve_at(solved%curves(shaft%lobes(cam)), place, values, is_known)
               end if
               if (.not. is_known) then
                  call state_at(solved%cycles(shaft%lobes(cam)), model, place, shaft%hints(cam), state, error)
                  if (allocated(error)) return
                  values = cam_values(model, state)
               end if
            end associate
            torques(:, shaft%shafts(cam)) = torques(:, shaft%shafts(cam)) + values(:torque_count)
            forces(:, cam) = in_common_frame(shaft, cam, values(torque_count + 1:))
         end do
         call bearing_torques(shaft, forces, torques(of_bearings, :), error, bearings)
      end associate
   end subroutine shaft_torques

   !> Force on a cam in the frame of the first follower.
   pure function in_common_frame(shaft, cam, force) result(turned)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> The cam
      integer, intent(in) :: cam
      !> Force in the frame of its own follower [N]
      real(wp), intent(in) :: force(2)
      !> The same force [N]
      real(wp) :: turned(2)

      associate (c => shaft%directions(1, cam), s => shaft%directions(2, cam))
         turned = [c*force(1) - s*force(2), s*force(1) + c*force(2)]
      end associate
   end function in_common_frame

   !> Torque of all bearings of each camshaft; zero where the case has none.
   subroutine bearing_torques(shaft, forces, torques, error, bearings)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> Force on each cam in the frame of the first follower, shape (2, cam) [N]
      real(wp), intent(in) :: forces(:, :)
      !> The torques [N m]
      real(wp), intent(out) :: torques(:)
      !> Domain error where a bearing law has no solution
      type(error_t), allocatable, intent(out) :: error
      !> States of the bearings, shape (bearing, camshaft)
      type(bearing_state_t), intent(out), optional :: bearings(:, :)

      ! Load vector of each bearing [N]
      real(wp) :: loads(2, bearing_number(shaft))
      type(bearing_state_t) :: state
      integer :: cam, k, bearing, status

      torques = 0.0_wp
      if (.not. allocated(shaft%journal)) return
      associate (places => shaft%bearings%bearing_positions)
         do k = 1, shaft%count
            loads = 0.0_wp
            do cam = 1, size(shaft%lobes)
               if (shaft%shafts(cam) == k) call share_force(places, shaft%bearings%cam_positions(cam), forces(:, cam), loads)
            end do
            if (allocated(shaft%pull)) call share_pull(places, shaft%pull, loads)
            do bearing = 1, size(places)
               call carry_load(shaft%journal, loads(:, bearing), state, status, shaft%touch)
               if (status /= journal_solved) then
                  call raise(error, kind_domain, "camshaft bearings: the bearing law has no solution for this load")
                  return
               end if
               torques(k) = torques(k) + state%torque
               if (present(bearings)) bearings(bearing, k) = state
            end do
         end do
      end associate
   end subroutine bearing_torques

   !> Number of bearings of a camshaft; none where the case has no such bearings.
   pure function bearing_number(shaft) result(number)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> The number
      integer :: number

      number = 0
      if (allocated(shaft%journal)) number = size(shaft%bearings%bearing_positions)
   end function bearing_number

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
      call append(list, "film_min", "m", "smallest film", "cam_bearings", state%film)
      call append(list, "torque", "N m", "friction torque", "cam_bearings", state%torque)
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

end module camroller_shaft
