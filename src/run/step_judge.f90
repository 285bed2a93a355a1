!> What a case forbids, looked for in the states of a host's step.
!>
!> In: states of a follower, with the policies of its case. Out: a domain error that names the first angle at which contact is lost
!> or the film law leaves its published range, where the case says `stop`. No state is changed, and where no policy is `stop`
!> nothing is evaluated.
module camroller_step_judge
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_cycle, only : cycle_t, state_at
   use camroller_engine, only : write_speed
   use camroller_film, only : groups_t, is_in_range
   use camroller_findings, only : range_groups
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_state, only : state_t
   use camroller_step_inputs, only : part_number
   use camroller_step_remarks, only : append_groups, append_lost, append_outside
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
      else if (model%stops_outside_range) then
         groups = range_groups(model, state)
         is_forbidden = .not. is_in_range(model%film_law, groups, model%film_table)
      end if
      if (.not. is_forbidden) return
      text = "advance: "
      call write_speed(model%speed, model%crank_turns, 6, speed)
      if (state%contact%is_touching) then
         call append_outside(text, model%film_law, angle)
         text = text//" at "//speed
         call append_groups(text, model%film_law, groups)
         text = text//" (range_policy = 'stop')"
      else
         call append_lost(text, angle)
         text = text//" at "//speed//" (contact_policy = 'stop')"
      end if
      call raise(error, kind_domain, text)
   end subroutine judge_state

end module camroller_step_judge
