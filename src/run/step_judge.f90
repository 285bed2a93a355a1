!> What a case forbids, looked for in the states of a host's step.
!>
!> In: states of a follower, with the policies of its case. Out: a domain error that names the first angle at which contact is lost
!> or the film law leaves its published range, where the case says `stop`. No state is changed, and where no policy is `stop`
!> nothing is evaluated.
module camroller_step_judge
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_cam_angle, only : append_cam_angle
   use camroller_contact_forces, only : film_groups
   use camroller_cycle, only : cycle_t, state_at
   use camroller_engine, only : write_speed
   use camroller_film, only : group_count, group_values, groups_t, is_in_range, law_table, published_range
   use camroller_film_range, only : group_names, outside_words
   use camroller_model, only : model_t
   use camroller_number_text, only : append_number
   use camroller_ramp, only : follow_ramp
   use camroller_state, only : state_t
   use camroller_step_inputs, only : part_number
   implicit none
   private

   public :: judge_state, judge_piece

contains

   !> Judge the states of a piece of a step: at its stops, between which contact is kept or lost all the way, and a degree apart
   !> at most.
   subroutine judge_piece(model, piece, stops, error)
      !> The model, which follows the inputs
      type(model_t), intent(inout) :: model
      !> The piece
      type(cycle_t), intent(in) :: piece
      !> Cam angles from full lift at which something changes, the ends of the piece included [rad]
      real(wp), intent(in) :: stops(:)
      !> Domain error where the case forbids a state; convergence error where there is none
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Cam angle from full lift [rad]
      real(wp) :: angle
      integer :: i, k, intervals, hint

      if (.not. (model%stops_without_contact .or. model%stops_outside_range)) return
      hint = 1
      do k = 1, size(stops) - 1
         ! an even number, so that the middle is one of the angles
         intervals = 2*part_number(stops(k + 1) - stops(k), 2.0_wp*degree)
         do i = 0, intervals
            angle = stops(k) + (stops(k + 1) - stops(k))*i/intervals
            call follow_ramp(model, angle)
            call state_at(piece, model, angle, hint, state, error)
            if (.not. allocated(error)) call judge_state(model, state, angle, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine judge_piece

   !> Judge one state.
   subroutine judge_state(model, state, angle, error)
      !> The model, set to the inputs at the angle
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Domain error where the case forbids it
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text, speed
      type(groups_t) :: groups
      logical :: is_forbidden

      is_forbidden = .false.
      if (.not. state%contact%is_touching) then
         is_forbidden = model%stops_without_contact
         ! with a lash there is no contact on the base circle
         if (is_forbidden .and. allocated(model%flexible)) is_forbidden = model%flexible%lash <= 0.0_wp
         if (is_forbidden) text = "contact is lost at "
      else if (model%stops_outside_range) then
         groups = film_groups(model, state%position, state%contact)
         is_forbidden = .not. is_in_range(model%film_law, groups, model%film_table)
         if (is_forbidden) text = trim(outside_words(model%film_law))//" at "
      end if
      if (.not. is_forbidden) return
      call append_cam_angle(text, angle, 3)
      call write_speed(model%speed, model%crank_turns, 6, speed)
      text = "advance: "//text//" at "//speed
      if (state%contact%is_touching) then
         call add_groups(model%film_law, groups, text)
         text = text//" (range_policy = 'stop')"
      else
         text = text//" (contact_policy = 'stop')"
      end if
      call raise(error, kind_domain, text)
   end subroutine judge_state

   !> Say which groups of a film are outside of the range that its law was published for.
   subroutine add_groups(law, groups, text)
      !> Position of the law in `film_law_names`
      integer, intent(in) :: law
      !> The groups
      type(groups_t), intent(in) :: groups
      !> Text to extend
      character(len=:), allocatable, intent(inout) :: text

      ! Published bounds of the groups, the groups [-]
      real(wp) :: bounds(2, group_count), values(group_count)
      integer :: i

      if (law == law_table) return
      bounds = published_range(law)
      values = group_values(groups)
      do i = 1, group_count
         if (values(i) >= bounds(1, i) .and. values(i) <= bounds(2, i)) cycle
         text = text//"; "//trim(group_names(i))//" is "
         call append_number(text, values(i), 3)
         text = text//", published for "
         call append_number(text, bounds(1, i), 3)
         text = text//" to "
         call append_number(text, bounds(2, i), 3)
      end do
   end subroutine add_groups

end module camroller_step_judge
