!> What a follower gives its camshaft, as a curve over the cam angle: torques and the force on the cam.
!>
!> In: the states at the points from which the means of a lobe shape are made. Out: the same quantities at any angle, by the
!> polynomial through the seven points of a panel, for every cam of the shape at its own phase. Where the two highest terms of a
!> polynomial are beyond five tolerances of the cycle the curve is not known, and the state has to be solved. Torques and force are
!> judged apart, and a camshaft without bearings asks for no force, so that bearings change no torque of a follower. It also has the
!> contacts from which those at other angles are looked for.
module camroller_lobe_curve
   use camroller_contact_forces, only : contact_t
   use camroller_kinds, only : wp, two_pi
   use camroller_model, only : model_t
   use camroller_panels, only : highest_terms, interpolation_weights, panel_places, panel_points
   use camroller_state, only : cam_force, state_t
   use camroller_torque_list, only : torque_count, of_residual
   implicit none
   private

   public :: lobe_curve_t, curve_values, start_curve, keep_state, add_piece, close_curve, halve_pieces, move_curve, piece_angle, &
      & curve_points, telling_points, curve_at, cam_values, contact_near

   !> Numbers of a state that a camshaft takes: torques, force on the cam, which is zero where no bearing asks for it
   integer, parameter :: curve_values = torque_count + 2

   !> The curve, in pieces without gaps
   type :: lobe_curve_t
      private
      integer :: count = 0
      !> Does a bearing ask for the force?
      logical :: has_force = .false.
      !> Ends of the pieces, one more than there are [rad]
      real(wp), allocatable :: ends(:)
      !> Torques [N m], last the energy residual [W], and force [N] at the points of each piece, shape (quantity, point, piece)
      real(wp), allocatable :: values(:, :, :)
      !> Contact at these points: tangential force [N], torque of the bearing [N m] and film ratio [-], which is zero for none,
      !> shape (3, point, piece)
      real(wp), allocatable :: contacts(:, :, :)
      !> Are the polynomials of the piece good enough: those of the torques, those of the force? Shape (2, piece)
      logical, allocatable :: is_smooth(:, :)
   end type lobe_curve_t

   !> Part of the sum of magnitudes of all torques below which one is rounding [-]
   real(wp), parameter :: rounding = 1.0e-12_wp
   !> Highest terms over what the polynomial misses where it is smooth, at least [-]
   real(wp), parameter :: terms_over_error = 5.0_wp

contains

   !> No pieces yet.
   pure subroutine start_curve(curve, start, pieces, has_force)
      !> The curve
      type(lobe_curve_t), intent(out) :: curve
      !> Cam angle from full lift where it starts [rad]
      real(wp), intent(in) :: start
      !> Number of pieces at most
      integer, intent(in) :: pieces
      !> Does a bearing ask for the force?
      logical, intent(in) :: has_force

      allocate (curve%ends(pieces + 1), curve%values(curve_values, panel_points, pieces), &
         & curve%contacts(3, panel_points, pieces), curve%is_smooth(2, pieces))
      curve%ends(1) = start
      curve%has_force = has_force
   end subroutine start_curve

   !> Keep the state at a point of a piece: of the one that is added next, unless another is named.
   pure subroutine keep_state(curve, model, state, point, piece)
      !> The curve
      type(lobe_curve_t), intent(inout) :: curve
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> The state
      type(state_t), intent(in) :: state
      !> Which of the points
      integer, intent(in) :: point
      !> The piece
      integer, intent(in), optional :: piece

      integer :: place

      place = curve%count + 1
      if (present(piece)) place = piece
      curve%values(:, point, place) = cam_values(model, state)
      curve%contacts(:, point, place) = 0.0_wp
      associate (contact => state%contact)
         if (contact%is_touching) curve%contacts(:, point, place) = [contact%tangential_force, contact%bearing_torque, &
            & contact%film_ratio]
      end associate
   end subroutine keep_state

   !> Add the piece up to an angle whose states are kept.
   pure subroutine add_piece(curve, right)
      !> The curve
      type(lobe_curve_t), intent(inout) :: curve
      !> Cam angle from full lift where the piece ends [rad]
      real(wp), intent(in) :: right

      curve%count = curve%count + 1
      curve%ends(curve%count + 1) = right
   end subroutine add_piece

   !> Decide of each piece whether its polynomial is good enough: for each quantity, against its largest magnitude in the cycle. The
   !> energy residual is rounding, and not judged.
   pure subroutine close_curve(curve, tolerance)
      !> The curve
      type(lobe_curve_t), intent(inout) :: curve
      !> Error allowed, relative to the largest magnitude [-]
      real(wp), intent(in) :: tolerance

      ! Error allowed of each quantity [unit of each]
      real(wp) :: allowed(curve_values)
      integer :: i, piece

      associate (values => curve%values(:, :, :curve%count))
         allowed = 0.0_wp
         do piece = 1, curve%count
            do i = 1, panel_points
               allowed = max(allowed, abs(values(:, i, piece)))
            end do
         end do
         allowed(:torque_count) = terms_over_error*tolerance*allowed(:torque_count) + rounding*sum(allowed(:torque_count))
         allowed(torque_count + 1:) = terms_over_error*tolerance*allowed(torque_count + 1:)
         allowed(of_residual) = huge(1.0_wp)
         do piece = 1, curve%count
            associate (within => highest_terms(values(:, :, piece)) <= allowed)
               curve%is_smooth(:, piece) = [all(within(:torque_count)), all(within(torque_count + 1:)) .or. .not. curve%has_force]
            end associate
         end do
      end associate
   end subroutine close_curve

   !> Halve the pieces whose polynomials are not good enough, but for short ones. `close_curve` has to judge the halves before a
   !> value is taken of them.
   pure subroutine halve_pieces(curve, shortest, halved, halves)
      !> The curve
      type(lobe_curve_t), intent(in) :: curve
      !> Length below which a piece stays whole [rad]
      real(wp), intent(in) :: shortest
      !> The same with these pieces halved; nothing where there are none
      type(lobe_curve_t), intent(out) :: halved
      !> Pieces of it of which no states are kept yet
      integer, allocatable, intent(out) :: halves(:)

      logical :: is_whole(curve%count)
      integer :: piece

      allocate (halves(0))
      is_whole = [(all(curve%is_smooth(:, piece)) .or. curve%ends(piece + 1) - curve%ends(piece) < shortest, piece=1, curve%count)]
      if (all(is_whole)) return
      call start_curve(halved, curve%ends(1), curve%count + count(.not. is_whole), curve%has_force)
      do piece = 1, curve%count
         if (is_whole(piece)) then
            halved%values(:, :, halved%count + 1) = curve%values(:, :, piece)
            halved%contacts(:, :, halved%count + 1) = curve%contacts(:, :, piece)
         else
            halves = [halves, halved%count + 1, halved%count + 2]
            call add_piece(halved, 0.5_wp*(curve%ends(piece) + curve%ends(piece + 1)))
         end if
         call add_piece(halved, curve%ends(piece + 1))
      end do
   end subroutine halve_pieces

   !> Hand a curve over without a copy.
   pure subroutine move_curve(from, to)
      !> The curve; out: without pieces
      type(lobe_curve_t), intent(inout) :: from
      !> The same curve
      type(lobe_curve_t), intent(out) :: to

      to%count = from%count
      to%has_force = from%has_force
      from%count = 0
      call move_alloc(from%ends, to%ends)
      call move_alloc(from%values, to%values)
      call move_alloc(from%contacts, to%contacts)
      call move_alloc(from%is_smooth, to%is_smooth)
   end subroutine move_curve

   !> Cam angle of a point of a piece.
   pure function piece_angle(curve, piece, point) result(angle)
      !> The curve
      type(lobe_curve_t), intent(in) :: curve
      !> The piece and the point
      integer, intent(in) :: piece, point
      !> Cam angle from full lift [rad]
      real(wp) :: angle

      angle = curve%ends(piece) + panel_places(point)*(curve%ends(piece + 1) - curve%ends(piece))
   end function piece_angle

   !> Cam angles, torques and force of all points, in order.
   pure subroutine curve_points(curve, angles, values)
      !> The curve
      type(lobe_curve_t), intent(in) :: curve
      !> The angles from full lift [rad]
      real(wp), allocatable, intent(out) :: angles(:)
      !> Torques [N m], after them the energy residual [W], last the force on the cam [N], shape (quantity, point)
      real(wp), allocatable, intent(out) :: values(:, :)

      integer :: point, piece

      angles = [((piece_angle(curve, piece, point), point=1, panel_points), piece=1, curve%count)]
      allocate (values(curve_values, size(angles)))
      do piece = 1, curve%count
         values(:, panel_points*(piece - 1) + 1:panel_points*piece) = curve%values(:, :, piece)
      end do
   end subroutine curve_points

   !> Points that tell how quantities run along a curve: those between which all others lie on straight lines, or nearly, and those
   !> at which a quantity turns. On both sides of a jump there is one.
   !>
   !> A line from one of these points stays near the points behind it as long as its slope is within bounds, which each of them
   !> narrows (Williams, Comput. Graph. Image Process. 8 (1978) 286).
   pure function telling_points(angles, values) result(is_telling)
      !> The points, in order [rad]
      real(wp), intent(in) :: angles(:)
      !> Quantities there, shape (quantity, point) [unit of each]
      real(wp), intent(in), contiguous :: values(:, :)
      !> Does the point tell?
      logical :: is_telling(size(angles))

      ! Way from a line, change that is a turn, over the extent of a quantity; extent that is rounding, over the size [-]
      real(wp), parameter :: bend = 0.02_wp, little = 1.0e-4_wp, rounding = 1.0e-9_wp
      ! Angles that are the same but for rounding [rad]
      real(wp), parameter :: same = 1.0e-12_wp
      ! Smallest and largest values [unit of each]; values over the extent of the quantities that have any [-], this [unit of each]
      real(wp), dimension(size(values, 1)) :: lowest, highest
      real(wp), allocatable :: scaled(:, :), extents(:)
      ! Slopes of lines from the last telling point, at least and at most [1/rad]; way from it [rad], change of a quantity [-]
      real(wp), dimension(size(values, 1)) :: least, most
      real(wp) :: way, change
      integer, allocatable :: used(:)
      integer :: last, begun, i, quantity
      logical :: is_bent, has_turn

      is_telling = .false.
      lowest = values(:, 1)
      highest = values(:, 1)
      do i = 2, size(angles)
         lowest = min(lowest, values(:, i))
         highest = max(highest, values(:, i))
      end do
      used = pack([(i, i=1, size(lowest))], highest - lowest > rounding*max(abs(lowest), abs(highest)))
      extents = highest(used) - lowest(used)
      allocate (scaled(size(used), size(angles)))
      do i = 1, size(angles)
         scaled(:, i) = values(used, i)/extents
      end do
      begun = 0
      last = 1
      i = 2
      do while (i < size(angles))
         if (begun /= last) then
            least = -huge(1.0_wp)
            most = huge(1.0_wp)
            begun = last
         end if
         way = max(angles(i) - angles(last), same)
         is_bent = .false.
         has_turn = .false.
         do quantity = 1, size(used)
            change = scaled(quantity, i) - scaled(quantity, last)
            is_bent = is_bent .or. change/way < least(quantity) .or. change/way > most(quantity)
            least(quantity) = max(least(quantity), (change - bend)/way)
            most(quantity) = min(most(quantity), (change + bend)/way)
            if (abs(change) > little) has_turn = has_turn .or. (scaled(quantity, i) > scaled(quantity, i - 1) .neqv. &
               & scaled(quantity, i + 1) > scaled(quantity, i))
         end do
         ! The point before is on the line, and this one is looked at again from there
         if (is_bent) last = i - 1
         if (has_turn .and. .not. is_bent) last = i
         is_telling(last) = is_telling(last) .or. last > 1
         if (.not. is_bent) i = i + 1
      end do
   end function telling_points

   !> Torques and force at a cam angle.
   pure subroutine curve_at(curve, angle, values, is_known)
      !> The curve
      type(lobe_curve_t), intent(in) :: curve
      !> Cam angle from full lift, of any turn [rad]
      real(wp), intent(in) :: angle
      !> Torques [N m], last the energy residual [W], and force on the cam [N]
      real(wp), intent(out) :: values(curve_values)
      !> Are they known: the torques, the force? A force that no bearing asks for is
      logical, intent(out) :: is_known(2)

      ! Shares of the points [-]
      real(wp) :: shares(panel_points)
      integer :: piece

      is_known = .false.
      call find_piece(curve, angle, piece, shares)
      if (piece > 0) is_known = curve%is_smooth(:, piece)
      if (.not. any(is_known)) then
         values = 0.0_wp
         return
      end if
      call interpolate(curve%values(:, :, piece), shares, values)
   end subroutine curve_at

   !> Values on the polynomial of a piece: `matmul(points, s)`, several sums at once.
   pure subroutine interpolate(points, s, values)
      !> Values at the points of the piece [unit of each]
      real(wp), intent(in) :: points(curve_values, panel_points)
      !> Shares of the points [-]
      real(wp), intent(in) :: s(panel_points)
      !> The values [unit of each]
      real(wp), intent(out) :: values(curve_values)

      integer :: i, point

      do i = 1, curve_values
         values(i) = 0.0_wp
         do point = 1, panel_points
            values(i) = values(i) + points(i, point)*s(point)
         end do
      end do
   end subroutine interpolate

   !> Contact to start from at a cam angle: on the polynomial of its piece, whether or not that is good enough for anything else.
   pure function contact_near(curve, angle) result(nearby)
      !> The curve
      type(lobe_curve_t), intent(in) :: curve
      !> Cam angle from full lift, of any turn [rad]
      real(wp), intent(in) :: angle
      !> Touches where all points of the piece do; has what a contact is started from
      type(contact_t) :: nearby

      ! Shares of the points [-]; forces, torque and film ratio [unit of each]
      real(wp) :: shares(panel_points), values(3)
      integer :: piece

      nearby%is_touching = .false.
      call find_piece(curve, angle, piece, shares)
      if (piece == 0) return
      nearby%is_touching = all(curve%contacts(3, :, piece) > 0.0_wp)
      if (.not. nearby%is_touching) return
      values = matmul(curve%contacts(:, :, piece), shares)
      nearby%tangential_force = values(1)
      nearby%bearing_torque = values(2)
      nearby%film_ratio = max(values(3), 0.0_wp)
   end function contact_near

   !> Piece that holds a cam angle, and the shares of its points in the polynomial there.
   pure subroutine find_piece(curve, angle, piece, shares)
      type(lobe_curve_t), intent(in) :: curve
      !> Cam angle from full lift, of any turn [rad]
      real(wp), intent(in) :: angle
      !> The piece, 0 where there is none
      integer, intent(out) :: piece
      !> The shares [-]
      real(wp), intent(out) :: shares(panel_points)

      ! Angle within the curve [rad], distances from the points [-]
      real(wp) :: inside, distances(panel_points)
      integer :: last, middle, point

      piece = 0
      shares = 0.0_wp
      if (curve%count == 0) return
      ! What `modulo` gives, without its call of `fmod` for an angle of this turn or of the one before
      inside = angle - curve%ends(1)
      if (inside < 0.0_wp) inside = inside + two_pi
      if (.not. (inside >= 0.0_wp .and. inside < two_pi)) inside = modulo(angle - curve%ends(1), two_pi)
      inside = curve%ends(1) + inside
      if (inside > curve%ends(curve%count + 1)) return
      piece = 1
      last = curve%count + 1
      do while (last - piece > 1)
         middle = shiftr(piece + last, 1)
         if (curve%ends(middle) <= inside) then
            piece = middle
         else
            last = middle
         end if
      end do
      distances = (inside - curve%ends(piece))/(curve%ends(piece + 1) - curve%ends(piece)) - panel_places
      do point = 1, panel_points
         if (abs(distances(point)) > epsilon(1.0_wp)) cycle
         shares(point) = 1.0_wp
         return
      end do
      shares = interpolation_weights/distances
      shares = shares/sum(shares)
   end subroutine find_piece

   !> What a camshaft takes from a state.
   pure function cam_values(model, state) result(values)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> The state
      type(state_t), intent(in) :: state
      !> Torques [N m], last the energy residual [W], and force on the cam [N]
      real(wp) :: values(curve_values)

      values(:torque_count) = state%torques
      values(torque_count + 1:) = cam_force(model, state)
   end function cam_values

end module camroller_lobe_curve
