!> Torques of a short piece of a host's step, one without stops: means from three or five angles, the ends among them, or from five
!> in each of up to four parts.
!>
!> In: model that follows the inputs, piece, the contacts that the integration has solved at its ends. Out: mean torques with
!> their error, extremes, states at the ends and in the middle.
!>
!> Simpson's rule is enough where its difference from the trapezoidal rule, which is far above its error, may count as error: on
!> the base circle and where torques change slowly. Elsewhere the rule is that of Lobatto with five points, exact for polynomials of
!> degree 7, which holds Simpson's with three. Its error estimate is the root of the sum of squares of two terms: the difference of
!> both rules, and the part of degree 3 that a parabola leaves, so that a kink at which one of them vanishes by chance is seen by
!> the other. Source of the rule: Abramowitz and Stegun (1964), 25.4.32.
!>
!> Where the host's speed is straight within each step, its slope jumps from one to the next, and the roller decays to the slow
!> motion of the new slope. What that layer adds to the means asks for parts. The torque against the gas needs no contact and has a
!> rule of its own.
module camroller_short_piece
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_dynamics, only : unseated_share
   use camroller_gas, only : gas_force
   use camroller_lift, only : evaluate_lift
   use camroller_panels, only : panel_points, panel_places, panel_weights, gauss_points, gauss_weights
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_state, only : state_t, evaluate_state, complete_state
   use camroller_cycle, only : cycle_t, settle_state
   use camroller_contact_forces, only : contact_t
   use camroller_follower_samples, only : follower_samples_t, start_samples, sampled_values, extremes_t, widen
   use camroller_spin, only : nearby_t, decay_rate_of
   use camroller_step_error, only : slip_error_t, judge_point, judge_curve
   use camroller_means, only : mean_tolerance, stored_torques
   use camroller_stored_work, only : stored_work_t, follow_contact
   use camroller_torque_list, only : torque_count, is_loss, is_torque, of_geometric
   use camroller_trajectory, only : interpolate_state
   implicit none
   private

   public :: integrate_short, places, lobatto_places, lobatto_weights, lobatto_error

   !> Number of places; those of Simpson's rule, those that the rule of Lobatto adds, and those inside, in the order of sampling
   integer, parameter :: places = 5, of_simpson(3) = [1, 5, 3], of_lobatto(2) = [2, 4], inside(3) = [3, 2, 4]
   !> Distance of the second and the fourth place from the middle, over half of the piece [-]
   real(wp), parameter :: inner = sqrt(3.0_wp/7.0_wp)
   !> Places in the piece; weights of the rules [-]
   real(wp), parameter :: lobatto_places(places) = 0.5_wp*(1.0_wp + [-1.0_wp, -inner, 0.0_wp, inner, 1.0_wp])
   real(wp), parameter :: lobatto_weights(places) = [9.0_wp, 49.0_wp, 64.0_wp, 49.0_wp, 9.0_wp]/180.0_wp
   real(wp), parameter :: simpson_weights(places) = [1.0_wp, 0.0_wp, 4.0_wp, 0.0_wp, 1.0_wp]/6.0_wp
   real(wp), parameter :: trapezoidal_weights(places) = [0.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.5_wp]
   !> Weights that leave nothing of a parabola: those of the rule, with the values at opposite places against each other [-]
   real(wp), parameter :: odd_weights(places) = lobatto_weights(2)*[inner, -1.0_wp, 0.0_wp, 1.0_wp, -inner]
   !> Accepted points of a piece that may be short. Fast slip near pure rolling takes many steps of the integration and hardly shows
   !> in the torques; what does show, the error estimate sees. Between the angles knots of a lift table may be missed by chance,
   !> which put friction off by 2.4 times the accuracy in a piece of 16 points: beyond the second number a tenth of the error is
   !> allowed. In the drives of `step_error` no such step was left
   integer, parameter :: most_points = 16, many_points = 8
   !> Parts that a piece is divided in at most
   integer, parameter :: most_parts = 4
   !> Lengths of decay that the first of them holds at least [-]
   real(wp), parameter :: decay_lengths = 4.0_wp
   !> Error of Simpson's rule over what is allowed up to which that of five points is tried on the whole [-]: in smooth pieces
   !> it leaves a hundredth of that error, where the roller decays to its slow motion a tenth or nothing
   real(wp), parameter :: most_excess = 30.0_wp
   !> Error estimate over the tolerance up to which the means serve [-]: a tenth of the accuracy. The estimate is that of Simpson's
   !> rule for the most part, and the rule of five points far better
   real(wp), parameter :: largest_error = 10.0_wp
   !> Error of load and forces over the tolerance, to which a state is solved that is no part of what a step returns [-]
   real(wp), parameter :: contact_part = 1.0e-3_wp
   !> The same of the state that a step returns [-]: what is left after it is round-off
   real(wp), parameter :: round_off = 4.0_wp*epsilon(1.0_wp)

   !> Contacts known at places of the piece, from which those between are looked for
   type :: known_t
      !> Are they known there?
      logical :: is_known(places) = .false.
      !> Tangential force [N], torque of the bearing [N m] and film ratio [-]
      real(wp) :: values(3, places) = 0.0_wp
   end type known_t

   !> A part of the piece, or the whole of it
   type :: part_t
      !> Its ends [rad]
      real(wp) :: ends(2) = 0.0_wp
      !> Torques at its places, last the energy residual [N m, W]
      real(wp) :: values(torque_count, places) = 0.0_wp
      !> Contacts there
      type(known_t) :: known
      !> Has a place of the piece been sampled? Is there contact at it?
      logical :: is_begun = .false., touches = .false.
   end type part_t

contains

   !> Mean torques of a follower over a piece without stops that the integration has covered in a few steps.
   subroutine integrate_short(model, piece, nearby, states, torques, drive_error, extremes, slip_errors, is_enough, error)
      !> Model of the lobe, which follows the inputs
      type(model_t), intent(inout), target :: model
      !> The piece, without stops
      type(cycle_t), intent(in), target :: piece
      !> First and last contact that the integration has solved
      type(nearby_t), intent(in) :: nearby
      !> States at its start, in its middle and at its end
      type(state_t), intent(out) :: states(3)
      !> Mean torques [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(torque_count)
      !> Estimate of the error of the mean torque that drives [N m]
      real(wp), intent(out) :: drive_error
      !> Smallest and largest values at the points that the means are made of
      type(extremes_t), intent(out) :: extremes
      !> Errors by the sliding speed; in: with the tolerances alone
      type(slip_error_t), intent(inout) :: slip_errors
      !> Is the piece so short, and are the means good enough? If not, nothing else has a meaning
      logical, intent(out) :: is_enough
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(follower_samples_t) :: samples
      type(stored_work_t) :: work
      ! The whole piece, later its parts
      type(part_t) :: parts(most_parts)
      ! Length of the piece [rad]; error that is allowed over the losses, error of the torques over that [-]
      real(wp) :: length, allowed, excess
      ! Share of the allowed error that a rule over the whole piece may have [-]
      real(wp) :: whole_share
      ! Mean torque against the gas, its error [N m]
      real(wp) :: gas(2)

      associate (path => piece%trajectory, whole => parts(1))
         is_enough = path%count <= most_points .and. .not. (path%is_linear .or. allocated(piece%phases))
         if (.not. is_enough) return
         call start_samples(samples, model, piece)
         whole%ends = path%time([1, path%count])
         length = whole%ends(2) - whole%ends(1)
         allowed = largest_error*mean_tolerance(piece%tolerance)
         whole_share = merge(0.1_wp, 1.0_wp, path%count > many_points)
         if (nearby%has_first) then
            call keep_contact(whole%known, 1, nearby%first)
            call keep_contact(whole%known, places, nearby%last)
         end if
         call sample_part(samples, whole, of_simpson, nearby, slip_errors, is_enough, states)
         if (.not. is_enough) return
         gas = 0.0_wp
         if (allocated(model%gas) .and. whole%touches) gas = gas_torque(model, whole%ends)
         call judge(parts(:1), simpson_weights, gas, whole_share*allowed, torques, drive_error, excess)
         if (excess > 1.0_wp .and. excess <= most_excess) then
            call sample_part(samples, whole, of_lobatto, nearby, slip_errors, is_enough)
            if (.not. is_enough) return
            call judge(parts(:1), lobatto_weights, gas, whole_share*allowed, torques, drive_error, excess)
         end if
         if (excess > 1.0_wp) call integrate_parts(samples, parts, decay_rate_of(model, states(1)%contact), gas, allowed, nearby, &
            & slip_errors, torques, drive_error, excess)
         is_enough = excess <= 1.0_wp
         call follow_contact(work, samples, path%time(path%count), path%time(1), error)
      end associate
      torques = torques + stored_torques(samples, work, length)
      extremes = samples%extremes
   end subroutine integrate_short

   !> Sample places of a part.
   subroutine sample_part(samples, part, which, nearby, slip_errors, is_enough, states)
      type(follower_samples_t), intent(inout) :: samples
      !> The part; out: with values and contacts at these places
      type(part_t), intent(inout) :: part
      !> Places, in the order in which they are sampled
      integer, intent(in) :: which(:)
      !> Contacts that the integration has solved
      type(nearby_t), intent(in) :: nearby
      !> Errors by the sliding speed
      type(slip_error_t), intent(inout) :: slip_errors
      !> Is there a state at each, and contact at all or at none?
      logical, intent(out) :: is_enough
      !> The states at the first, the last and the middle place; without them the places are all inside or join two parts
      type(state_t), intent(inout), optional :: states(3)

      ! Cam angle from full lift [rad]; error of load and forces that is left [-]
      real(wp) :: angle, accuracy
      integer :: i, status

      associate (times => samples%cycle%trajectory%time(:samples%cycle%trajectory%count))
         do i = 1, size(which)
            associate (place => which(i))
               angle = part%ends(1) + lobatto_places(place)*(part%ends(2) - part%ends(1))
               if (place == places) angle = part%ends(2)
               accuracy = merge(round_off, contact_part*samples%cycle%tolerance, present(states) .and. place == places)
               if (place == 1 .and. nearby%has_first) then
                  call sample_place(samples, angle, nearby%first, .true., accuracy, status)
               else
                  call sample_place(samples, angle, contact_at(part%known, place), .false., accuracy, status)
               end if
               ! Where contact is lost or comes back on the way, the angle of that is for panels to find
               is_enough = status == 0
               if (is_enough .and. part%is_begun) is_enough = samples%state%contact%is_touching .eqv. part%touches
               if (.not. is_enough) return
               part%is_begun = .true.
               part%touches = samples%state%contact%is_touching
               call keep_contact(part%known, place, samples%state%contact)
               if (place == 1 .or. place == places) then
                  call judge_point(slip_errors, samples%model, times(size(times)) - times(1), samples%state)
               else
                  call judge_curve(slip_errors, samples%model, samples%cycle, angle, samples%hint, samples%state)
               end if
               ! What settles is judged as it was: the error of the curve decides about its traction
               call settle_state(samples%cycle, samples%model, angle, samples%hint, accuracy, samples%state, status)
               is_enough = status == 0
               if (.not. is_enough) return
               call sampled_values(samples, samples%state, part%values(:, place))
               if (part%touches) part%values(of_geometric, place) = 0.0_wp
               call widen(samples%extremes, samples%model, samples%state, angle)
               if (present(states)) states((place + 1)/2) = samples%state
            end associate
         end do
      end associate
   end subroutine sample_part

   !> Means of a piece in parts, each by the rule of five points.
   !>
   !> The integration begins a piece with short steps where the roller first decays to its slow motion. The first part holds some
   !> lengths of that decay; then the part with the largest error is divided in two.
   subroutine integrate_parts(samples, parts, decay_rate, gas, allowed, nearby, slip_errors, torques, drive_error, excess)
      type(follower_samples_t), intent(inout) :: samples
      !> The first: the piece with what is known at its ends; out: its parts
      type(part_t), intent(inout) :: parts(most_parts)
      !> Decay rate of the sliding speed at its start [1/rad]; mean torque against the gas and its error [N m]; error that is
      !> allowed over the losses [-]
      real(wp), intent(in) :: decay_rate, gas(2), allowed
      !> Contacts that the integration has solved
      type(nearby_t), intent(in) :: nearby
      !> Errors by the sliding speed
      type(slip_error_t), intent(inout) :: slip_errors
      !> Mean torques [N m], last the energy residual [W]; error of the mean torque that drives [N m]; largest error over what is
      !> allowed, above one where there are no means that are good enough [-]
      real(wp), intent(inout) :: torques(torque_count), drive_error, excess

      ! Length of the first part [rad]
      real(wp) :: length
      integer :: worst, number, point, first, last, i
      logical :: is_enough

      worst = 1
      associate (times => samples%cycle%trajectory%time(:samples%cycle%trajectory%count))
         length = 0.5_wp*(times(size(times)) - times(1))
         if (decay_rate*length > decay_lengths) length = decay_lengths/decay_rate
         do number = 2, most_parts
            first = count(times <= parts(worst)%ends(1))
            last = 1 + count(times < parts(worst)%ends(2))
            if (last - first < 2) return
            point = merge(1 + count(times < times(1) + length), (first + last + 1)/2, number == 2)
            point = max(first + 1, min(point, last - 1))
            do i = number, worst + 2, -1
               parts(i) = parts(i - 1)
            end do
            call divide(parts(worst), times(point), parts(worst + 1))
            call sample_part(samples, parts(worst), [places, inside], nearby, slip_errors, is_enough)
            if (is_enough) then
               call copy_place(parts(worst), places, parts(worst + 1), 1)
               call sample_part(samples, parts(worst + 1), inside, nearby, slip_errors, is_enough)
            end if
            if (.not. is_enough) return
            call judge(parts(:number), lobatto_weights, gas, allowed, torques, drive_error, excess, worst)
            if (excess <= 1.0_wp) return
         end do
      end associate
   end subroutine integrate_parts

   !> Divide a part in two, with what is known at its ends.
   pure subroutine divide(part, angle, next)
      !> The part; out: its first half
      type(part_t), intent(inout) :: part
      !> Cam angle of the division from full lift [rad]
      real(wp), intent(in) :: angle
      !> The rest
      type(part_t), intent(out) :: next

      type(part_t) :: first

      next%is_begun = .true.
      next%touches = part%touches
      first = next
      first%ends = [part%ends(1), angle]
      next%ends = [angle, part%ends(2)]
      call copy_place(part, 1, first, 1)
      call copy_place(part, places, next, places)
      part = first
   end subroutine divide

   !> Copy what is known at a place.
   pure subroutine copy_place(from, from_place, to, to_place)
      !> Part that has it
      type(part_t), intent(in) :: from
      !> Part that gets it
      type(part_t), intent(inout) :: to
      !> Places in both
      integer, intent(in) :: from_place, to_place

      to%values(:, to_place) = from%values(:, from_place)
      to%known%is_known(to_place) = from%known%is_known(from_place)
      to%known%values(:, to_place) = from%known%values(:, from_place)
   end subroutine copy_place

   !> Means by the rule of the weights, Simpson's or that of all places, and their error over what is allowed.
   pure subroutine judge(parts, weights, gas, allowed, torques, drive_error, excess, worst)
      !> The parts of the piece
      type(part_t), intent(in) :: parts(:)
      !> Weights of the rule [-]; mean torque against the gas with its error [N m]; error that is allowed over the losses [-]
      real(wp), intent(in) :: weights(places), gas(2), allowed
      !> Mean torques [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(torque_count)
      !> Estimate of the error of the mean torque that drives [N m]
      real(wp), intent(out) :: drive_error
      !> Largest error estimate over what is allowed [-]
      real(wp), intent(out) :: excess
      !> Part with the largest error
      integer, intent(out), optional :: worst

      ! Mean magnitudes, error estimates; mean magnitude of all losses; mean over a part [N m]
      real(wp) :: sizes(torque_count), errors(torque_count), losses, mean
      ! Errors of a part, largest of all parts [N m]; share of a part in the piece [-]
      real(wp) :: part_errors(torque_count), largest, share
      integer :: i, part

      torques = 0.0_wp
      sizes = 0.0_wp
      errors = 0.0_wp
      largest = -1.0_wp
      do part = 1, size(parts)
         share = (parts(part)%ends(2) - parts(part)%ends(1))/(parts(size(parts))%ends(2) - parts(1)%ends(1))
         do i = 1, torque_count
            associate (values => parts(part)%values(i, :))
               mean = sum(weights*values)
               torques(i) = torques(i) + share*mean
               sizes(i) = sizes(i) + share*sum(weights*abs(values))
               if (weights(2) > 0.0_wp) then
                  part_errors(i) = share*lobatto_error(values)
               else
                  part_errors(i) = share*abs(mean - sum(trapezoidal_weights*values))
               end if
            end associate
         end do
         errors = errors + part_errors
         if (maxval(part_errors, mask=is_torque) <= largest) cycle
         largest = maxval(part_errors, mask=is_torque)
         if (present(worst)) worst = part
      end do
      torques(of_geometric) = torques(of_geometric) + gas(1)
      errors(of_geometric) = errors(of_geometric) + gas(2)
      ! What a torque adds to that of all losses counts: within a step one of them may be next to nothing
      losses = sum(sizes, mask=is_loss)
      excess = 0.0_wp
      if (any(errors > allowed*losses .and. is_torque)) then
         excess = maxval(errors, mask=is_torque)
         excess = excess/max(allowed*losses, epsilon(1.0_wp)*excess)
      end if
      drive_error = sum(errors, mask=is_torque)
   end subroutine judge

   !> Mean torque against the gas with the error of that, both [N m]: the lift gives it without a contact, by the rule of seven
   !> points that panels have. The error is that of its rule of three. Where a table of pressures bends sharply there is a stop.
   pure function gas_torque(model, ends) result(gas)
      !> Model of the lobe, with gas force
      type(model_t), intent(in) :: model
      !> Ends of the piece, without a stop between them [rad]
      real(wp), intent(in) :: ends(2)
      !> Mean and error [N m]
      real(wp) :: gas(2)

      ! Lift and its derivatives [m/rad^n]; torque at the places [N m]; cam angle from full lift [rad]
      real(wp) :: lift(0:3), torques(panel_points), angle
      integer :: i

      do i = 1, panel_points
         angle = ends(1) + panel_places(i)*(ends(2) - ends(1))
         call evaluate_lift(model%lift_law, angle, lift)
         torques(i) = gas_force(model%gas, angle)*unseated_share(model%train, lift(0))*lift(1)
      end do
      gas(1) = sum(panel_weights*torques)
      gas(2) = abs(gas(1) - sum(gauss_weights*torques(gauss_points)))
   end function gas_torque

   !> Sample an angle of the piece.
   subroutine sample_place(samples, angle, contact, is_solved, accuracy, status)
      type(follower_samples_t), intent(inout) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Contact to start from, where it touches
      type(contact_t), intent(in) :: contact
      !> Is it the contact there?
      logical, intent(in) :: is_solved
      !> Relative error of load and forces up to which it is solved otherwise [-]
      real(wp), intent(in) :: accuracy
      !> 0 where there is a state
      integer, intent(out) :: status

      ! Sliding speed [m/s]
      real(wp) :: sliding_speed(1)

      call follow_ramp(samples%model, angle)
      if (is_solved) then
         call complete_state(samples%model, angle, contact, samples%state, status)
      else
         call interpolate_state(samples%cycle%trajectory, angle, samples%hint, sliding_speed)
         call evaluate_state(samples%model, angle, sliding_speed(1), samples%state, status, start=contact, accuracy=accuracy)
      end if
   end subroutine sample_place

   !> Keep a contact that is known at a place; one that does not touch is none to start from.
   pure subroutine keep_contact(known, place, contact)
      !> The contacts
      type(known_t), intent(inout) :: known
      integer, intent(in) :: place
      !> The contact there
      type(contact_t), intent(in) :: contact

      known%is_known(place) = contact%is_touching
      known%values(:, place) = [contact%tangential_force, contact%bearing_torque, contact%film_ratio]
   end subroutine keep_contact

   !> Contact to start from at a place: on the polynomial through all that are known.
   pure function contact_at(known, place) result(contact)
      !> The contacts
      type(known_t), intent(in) :: known
      integer, intent(in) :: place
      !> The contact
      type(contact_t) :: contact

      ! Values [N, N m, -]; share of a known one in them [-]
      real(wp) :: values(3), share
      integer :: i, k

      contact%is_touching = any(known%is_known)
      values = 0.0_wp
      do i = 1, places
         if (.not. known%is_known(i)) cycle
         share = 1.0_wp
         do k = 1, places
            if (k /= i .and. known%is_known(k)) share = share*(lobatto_places(place) - lobatto_places(k)) &
               & /(lobatto_places(i) - lobatto_places(k))
         end do
         values = values + share*known%values(:, i)
      end do
      contact%tangential_force = values(1)
      contact%bearing_torque = values(2)
      contact%film_ratio = values(3)
   end function contact_at

   !> Error estimate of the mean by the rule of Lobatto.
   pure function lobatto_error(values) result(error)
      !> Values at its places, of a row of others or not [any]
      real(wp), intent(in) :: values(:)
      !> The estimate [unit of the values]
      real(wp) :: error

      error = sqrt((sum(lobatto_weights*values) - sum(simpson_weights*values))**2 + sum(odd_weights*values)**2)
   end function lobatto_error

end module camroller_short_piece
