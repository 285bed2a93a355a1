!> Torques of a short piece of a host's step, one without stops: means from three or five angles, the ends among them.
!>
!> In: model that follows the inputs, piece, the contacts that the integration has solved at its ends. Out: mean torques with
!> their error, extremes, states at the ends and in the middle.
!>
!> Simpson's rule is enough where its difference from the trapezoidal rule, which is far above its error, may count as error: on
!> the base circle and where torques change slowly. Elsewhere the rule is that of Lobatto with five points, exact for polynomials of
!> degree 7, which holds Simpson's with three. Its error estimate is the root of the sum of squares of two terms: the difference of
!> both rules, and the part of degree 3 that a parabola leaves, so that a kink at which one of them vanishes by chance is seen by
!> the other. Source of the rule: Abramowitz and Stegun (1964), 25.4.32.
module camroller_short_piece
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_state, only : state_t, evaluate_state, complete_state
   use camroller_cycle, only : cycle_t
   use camroller_contact_forces, only : contact_t
   use camroller_follower_samples, only : follower_samples_t, start_samples, sampled_values, extremes_t, widen
   use camroller_spin, only : nearby_t
   use camroller_step_error, only : slip_error_t, judge_point, judge_curve
   use camroller_means, only : mean_tolerance, stored_torques
   use camroller_stored_work, only : stored_work_t, follow_contact
   use camroller_torque_list, only : torque_count, is_loss, is_torque
   use camroller_trajectory, only : interpolate_state
   implicit none
   private

   public :: integrate_short, places, lobatto_places, lobatto_weights, simpson_weights, odd_weights

   !> Number of places; all of them, those of Simpson's rule first
   integer, parameter :: places = 5, in_order(places) = [1, 5, 3, 2, 4]
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
      type(known_t) :: known
      ! Values at the places [N m]; length of the piece [rad]; error that is allowed over the losses [-]
      real(wp) :: values(torque_count, places), length, allowed
      integer :: i, status

      associate (path => piece%trajectory)
         is_enough = path%count <= most_points .and. .not. (path%is_linear .or. allocated(piece%phases))
         if (.not. is_enough) return
         call start_samples(samples, model, piece)
         length = path%time(path%count) - path%time(1)
         allowed = largest_error*mean_tolerance(piece%tolerance)
         if (path%count > many_points) allowed = 0.1_wp*allowed
         if (nearby%has_first) then
            call keep_contact(known, 1, nearby%first)
            call keep_contact(known, places, nearby%last)
         end if
         values = 0.0_wp
         do i = 1, places
            associate (place => in_order(i))
               call sample_place(samples, path%time(1) + lobatto_places(place)*length, contact_at(known, place), place, nearby, &
                  & values(:, place), status)
               ! Where contact is lost or comes back on the way, the angle of that is for panels to find
               is_enough = status == 0
               if (is_enough .and. i > 1) is_enough = samples%state%contact%is_touching .eqv. states(1)%contact%is_touching
               if (.not. is_enough) return
               call keep_contact(known, place, samples%state%contact)
               if (i <= size(states)) states((place + 1)/2) = samples%state
               if (place == 1 .or. place == places) then
                  call judge_point(slip_errors, model, length, samples%state)
               else
                  call judge_curve(slip_errors, model, piece, path%time(1) + lobatto_places(place)*length, samples%hint, &
                     & samples%state)
               end if
            end associate
            if (i == size(states)) then
               call judge(values, simpson_weights, allowed, torques, drive_error, is_enough)
               if (is_enough) exit
            end if
         end do
         if (i > places) call judge(values, lobatto_weights, allowed, torques, drive_error, is_enough)
         call follow_contact(work, samples, path%time(path%count), path%time(1), error)
      end associate
      torques = torques + stored_torques(samples, work, length)
      extremes = samples%extremes
   end subroutine integrate_short

   !> Means by the rule of the weights, Simpson's or that of all places, and whether they are good enough.
   pure subroutine judge(values, weights, allowed, torques, drive_error, is_enough)
      !> Torques at the places [N m]
      real(wp), intent(in) :: values(torque_count, places)
      !> Weights of the rule [-], error that is allowed over the losses [-]
      real(wp), intent(in) :: weights(places), allowed
      !> Mean torques [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(torque_count)
      !> Estimate of the error of the mean torque that drives [N m]
      real(wp), intent(out) :: drive_error
      !> Are the means good enough?
      logical, intent(out) :: is_enough

      ! Mean magnitudes, error estimates; mean magnitude of all losses [N m]
      real(wp) :: sizes(torque_count), errors(torque_count), losses
      integer :: i

      do i = 1, torque_count
         torques(i) = sum(weights*values(i, :))
         sizes(i) = sum(weights*abs(values(i, :)))
         if (weights(2) > 0.0_wp) then
            errors(i) = sqrt((torques(i) - sum(simpson_weights*values(i, :)))**2 + sum(odd_weights*values(i, :))**2)
         else
            errors(i) = abs(torques(i) - sum(trapezoidal_weights*values(i, :)))
         end if
      end do
      ! What a torque adds to that of all losses counts: within a step one of them may be next to nothing
      losses = sum(sizes, mask=is_loss)
      is_enough = all(errors <= allowed*losses .or. .not. is_torque)
      drive_error = sum(errors, mask=is_torque)
   end subroutine judge

   !> Sample a place of the piece.
   subroutine sample_place(samples, angle, start, place, nearby, values, status)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Contact to start from, where it touches
      type(contact_t), intent(in) :: start
      !> The place: at the first the integration has solved the contact, and the state at the last is what a step returns
      integer, intent(in) :: place
      !> Contacts that the integration has solved
      type(nearby_t), intent(in) :: nearby
      !> Torques [N m], last the energy residual [W]
      real(wp), intent(out) :: values(:)
      !> 0 where there is a state
      integer, intent(out) :: status

      ! Sliding speed [m/s]
      real(wp) :: sliding_speed(1)

      call follow_ramp(samples%model, angle)
      if (place == 1 .and. nearby%has_first) then
         call complete_state(samples%model, angle, nearby%first, samples%state, status)
      else
         call interpolate_state(samples%cycle%trajectory, angle, samples%hint, sliding_speed)
         call evaluate_state(samples%model, angle, sliding_speed(1), samples%state, status, start=start, &
            & accuracy=merge(round_off, contact_part*samples%cycle%tolerance, place == places))
      end if
      if (status /= 0) return
      call sampled_values(samples, samples%state, values)
      call widen(samples%extremes, samples%model, samples%state)
   end subroutine sample_place

   !> Keep a contact that is known at a place; one that does not touch is none to start from.
   pure subroutine keep_contact(known, place, contact)
      !> The contacts
      type(known_t), intent(inout) :: known
      !> The place
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
      !> The place
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

end module camroller_short_piece
