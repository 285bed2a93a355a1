!> A piece of a cycle, integrated from a given spin of the roller: what a host's step is made of.
!>
!> In: model, stops, spin at the first of them. Out: the piece and the spin at the last. What an integration needs, method, room of
!> steps and of points, is kept for the next piece, so that nothing is allocated or made again; results depend on nothing of it.
module camroller_spin_piece
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : numerics_t
   use camroller_model, only : model_t
   use camroller_cycle, only : cycle_t, choose_method, integrate_spin
   use camroller_cycle_start, only : rolling_speed_at_angle
   use camroller_ode, only : method_t, options_t, counters_t
   use camroller_spin, only : spin_problem_t, nearby_t
   implicit none
   private

   public :: spin_piece_t, integrate_between, sliding_speed_of, longest_first_step

   !> A piece, and what is kept for the next one
   type :: spin_piece_t
      !> The piece, to be read as a cycle
      type(cycle_t) :: path
      !> Stops of the piece: first angle, those between, last angle [rad]
      real(wp), allocatable :: stops(:)
      !> Numerics that method and options are made for
      type(numerics_t), private :: numerics
      !> Scale of the sliding speed that they are made for [m/s]
      real(wp), private :: scale = 0.0_wp
      type(spin_problem_t), private :: problem
      class(method_t), allocatable, private :: method
      !> Options for a whole turn, and for the piece
      type(options_t), private :: options
      !> Fewest steps of a turn
      integer, private :: fewest_steps = 0
   end type spin_piece_t

   !> Most of the first step of a method with error control [rad]
   real(wp), parameter :: longest_first_step = 1.0_wp*degree

contains

   !> Integrate from one angle to another, less than a turn ahead, with the roller's spin given at the first.
   subroutine integrate_between(piece, model, numerics, scale, roller_spin, error, nearby, steps, sliding_speed)
      !> The piece, with its stops
      type(spin_piece_t), intent(inout), target :: piece
      !> The model
      type(model_t), intent(in), target :: model
      !> Method and tolerance
      type(numerics_t), intent(in) :: numerics
      !> Scale of the sliding speed, to which the tolerance is relative [m/s]
      real(wp), intent(in) :: scale
      !> Spin of the roller, from first to last angle [rad/s]
      real(wp), intent(inout) :: roller_spin
      !> Deck error for an unknown method, convergence error
      type(error_t), allocatable, intent(out) :: error
      !> In: with the contact to start from; out: with the first and the last one of the piece
      type(nearby_t), intent(inout), target, optional :: nearby
      !> Fewest steps between two stops; one without it
      integer, intent(in), optional :: steps
      !> Sliding speed that belongs to the spin, at the first and at the last angle [m/s]
      real(wp), intent(inout), optional :: sliding_speed

      ! Sliding speed or surface speed, that known at the start [m/s]; length of the piece [rad]
      real(wp) :: state(1), known, length
      integer :: last

      call make_ready(piece, model, numerics, scale, error)
      if (allocated(error)) return
      piece%problem%nearby => null()
      if (present(nearby)) piece%problem%nearby => nearby
      last = size(piece%stops)
      length = piece%stops(last) - piece%stops(1)
      associate (path => piece%path, stops => piece%stops)
         path%start = stops(1)
         piece%options%fewest_steps = ceiling(piece%fewest_steps*length/two_pi)
         if (present(steps)) piece%options%fewest_steps = max(piece%options%fewest_steps, steps*(last - 1))
         if (.not. path%is_linear) piece%options%step = min(length, longest_first_step)
         known = 0.0_wp
         if (present(sliding_speed)) known = sliding_speed
         state = roller_spin*model%roller_radius
         if (.not. path%has_surface_speed) state = sliding_speed_of(state(1), known, rolling_speed_at_angle(model, stops(1)))
         call integrate_spin(path, piece%problem, piece%method, piece%options, stops, state, error)
         if (allocated(error)) return
         known = state(1)
         if (path%has_surface_speed) known = 0.0_wp
         if (.not. path%has_surface_speed) state = rolling_speed_at_angle(model, stops(last)) - state
      end associate
      if (present(sliding_speed)) sliding_speed = known
      roller_spin = state(1)/model%roller_radius
   end subroutine integrate_between

   !> Sliding speed by the roller's surface speed: the one that is known where both are alike but for rounding. On nearly solid oil
   !> it is far below the last digit of the surface speed, and what traction there is follows from it.
   elemental function sliding_speed_of(surface_speed, known, rolling_speed) result(sliding_speed)
      !> Surface speed of the roller, sliding speed that may belong to it, speed in pure rolling [m/s]
      real(wp), intent(in) :: surface_speed, known, rolling_speed
      !> Sliding speed [m/s]
      real(wp) :: sliding_speed

      ! Roundings of a spin that was divided and multiplied by the radius [-]
      real(wp), parameter :: roundings = 4.0_wp

      sliding_speed = rolling_speed - surface_speed
      if (abs(sliding_speed - known) <= roundings*spacing(max(abs(rolling_speed), abs(surface_speed)))) sliding_speed = known
   end function sliding_speed_of

   !> Make method and options where they are not there from an earlier piece, and forget what happened in that.
   subroutine make_ready(piece, model, numerics, scale, error)
      type(spin_piece_t), intent(inout) :: piece
      type(model_t), intent(in), target :: model
      !> Method and tolerance
      type(numerics_t), intent(in) :: numerics
      !> Scale of the sliding speed [m/s]
      real(wp), intent(in) :: scale
      !> Deck error for an unknown method
      type(error_t), allocatable, intent(out) :: error

      logical :: is_ready

      is_ready = .false.
      if (allocated(piece%method)) is_ready = .not. (abs(piece%scale - scale) > 0.0_wp .or. is_other(piece%numerics, numerics))
      if (is_ready) then
         call piece%method%forget()
         if (allocated(piece%problem%mobilised)) deallocate (piece%problem%mobilised)
         piece%problem%model => model
      else
         call choose_method(piece%path, model, numerics, scale, piece%problem, piece%method, piece%options, error)
         if (allocated(error)) return
         piece%numerics = numerics
         piece%scale = scale
         piece%fewest_steps = piece%options%fewest_steps
         if (.not. piece%path%is_linear) piece%path%step_error = piece%options%tolerance(1)
      end if
      if (allocated(piece%path%phases)) deallocate (piece%path%phases)
      piece%path%counters = counters_t()
   end subroutine make_ready

   !> Do numerics differ in what method and options follow from?
   pure function is_other(one, other) result(verdict)
      !> The numerics
      type(numerics_t), intent(in) :: one, other
      !> Do they?
      logical :: verdict

      verdict = one%method /= other%method .or. abs(one%tolerance - other%tolerance) > 0.0_wp &
         & .or. abs(one%accuracy - other%accuracy) > 0.0_wp .or. abs(one%step - other%step) > 0.0_wp
   end function is_other

end module camroller_spin_piece
