!> Integration with kinks that depend on the state, against closed forms.
module test_ode_switching
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, two_pi, pi
   use camroller_error, only : error_t, kind_convergence
   use camroller_contact_compliance, only : one_sided_force
   use camroller_ode_problem, only : counters_t, linear_t, words_length
   use camroller_ode_method, only : method_t, options_t
   use camroller_ode_methods, only : new_method
   use camroller_ode_switching, only : switching_problem_t, integrate_switching
   use camroller_trajectory, only : interpolate_state, trajectory_t
   implicit none
   private

   public :: collect_ode_switching

   !> A body on a spring behind a cycloidal rise, or one that falls on a damped seat under a steady force, or one that crosses
   !> ground whose slope rises and falls in a zigzag
   type, extends(switching_problem_t) :: body_t
      !> Time of the rise; 0 for the seat [s]
      real(wp) :: rise = 0.0_wp
      !> Mass [kg], stiffness [N/m], damping of the seat [s/m], force of the spring [N], its stiffness [N/m]
      real(wp) :: mass = 1.0_wp, stiffness = two_pi**2, damping = 0.0_wp, force = 0.0_wp, spring = 25.0e3_wp
      !> Is there another contact that rests at zero, but for rounding?
      logical :: hovers = .false.
      !> Is there the ground?
      logical :: has_ground = .false.
   contains
      procedure :: get_rate
      procedure :: get_decay_rate
      procedure :: get_switches
      procedure :: name_time
   end type body_t

   !> A slide that friction catches: `y' = drive - friction tanh(y/narrow)`. From far below zero the speed rises at `drive +
   !> friction` and comes to rest, without ever passing it, where both balance each other
   type, extends(switching_problem_t) :: slide_t
      !> Steady drive, largest friction [m/s^2]; speed within which friction changes its sign [m/s]
      real(wp) :: drive = 30.0_wp, friction = 330.0_wp, narrow = 8.0e-5_wp
   contains
      procedure :: get_rate => slide_rate
      procedure :: linearise => linearise_slide
      procedure :: get_switches => no_switches
      procedure :: name_time => name_slide
   end type slide_t

   !> Methods that are tried
   character(len=*), parameter :: methods(*) = [character(len=14) :: "rodas5p", "radau5", "dormand_prince"]

contains

   subroutine collect_ode_switching(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("what a cycloidal rise leaves an oscillator with", test_rise), &
         new_unittest("a valve bounces under its spring", test_bounce), &
         new_unittest("steps end where contacts are lost and return", test_kinks), &
         new_unittest("a contact that rests at zero but for rounding ends few steps", test_hovering), &
         new_unittest("friction that catches a slide is at no time and no place larger than what holds it", test_catch), &
         new_unittest("steps end where a marker passes whole numbers, forwards and backwards", test_markers), &
         new_unittest("an integration that takes too much, or too short steps, ends with that reason", test_endings) &
         ]
   end subroutine collect_ode_switching

   subroutine run(body, method_name, stops, tolerance, state, trajectory, error)
      type(body_t), intent(in) :: body
      character(len=*), intent(in) :: method_name
      !> Stops [s], tolerance [state], state [m], [m/s]
      real(wp), intent(in) :: stops(:), tolerance(2)
      real(wp), intent(inout) :: state(2)
      type(trajectory_t), intent(inout) :: trajectory
      type(error_type), allocatable, intent(out) :: error
      class(method_t), allocatable :: method
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure

      call new_method(method, method_name, 2, failure)
      options%tolerance = tolerance
      options%step = 1.0e-4_wp*(stops(size(stops)) - stops(1))
      if (.not. allocated(failure)) call integrate_switching(body, method, options, stops, state, trajectory, counters, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine run

   subroutine test_rise(error)
      type(error_type), allocatable, intent(out) :: error
      ! Rise time over the natural period [-]; what is left over the rise, abs(sin pi r)/(pi r abs(1 - r^2)) [-]
      real(wp), parameter :: ratios(5) = [0.5_wp, 1.0_wp, 1.5_wp, 2.5_wp, 3.3_wp]
      real(wp), parameter :: left(5) = [0.848826363_wp, 0.5_wp, 0.169765273_wp, 0.024252182_wp, 0.007890373_wp]
      type(body_t) :: body
      type(trajectory_t) :: trajectory
      real(wp) :: state(2)
      integer :: i, k

      body%switches = 1
      do k = 1, size(methods)
         do i = 1, 5
            body%rise = ratios(i)
            state = 0.0_wp
            call run(body, methods(k), [0.0_wp, ratios(i), ratios(i) + 0.3_wp], [1.0e-10_wp, 1.0e-9_wp], state, trajectory, error)
            if (allocated(error)) return
            call check(error, hypot(state(1) - 1.0_wp, state(2)/two_pi), left(i), thr=2.0e-8_wp)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_rise

   subroutine test_bounce(error)
      type(error_type), allocatable, intent(out) :: error
      ! Stiffness of the seat [N/m], height after a meeting at 0.3 m/s [m]: D 0.3, 210 N, 43.2 g; that of a rigid seat follows
      ! from the speed after the meeting, 0.832869792 times that before, and the energy in force and spring
      real(wp), parameter :: stiffness(2) = [5.0e9_wp, 5.0e7_wp], heights(2) = [6.1402e-6_wp, 2.2372e-6_wp], rigid = 6.4190e-6_wp
      type(body_t) :: body
      type(trajectory_t) :: trajectory
      real(wp) :: state(2)
      integer :: i

      do i = 1, 2
         body = body_t(mass=0.0432_wp, stiffness=stiffness(i), damping=1.0_wp, force=210.0_wp)
         body%switches = 1
         state = [0.0_wp, -0.3_wp]
         call run(body, "rodas5p", [0.0_wp, 1.5e-4_wp], [1.0e-13_wp, 1.0e-8_wp], state, trajectory, error)
         if (allocated(error)) return
         call check(error, top(trajectory), heights(i), thr=3.0e-5_wp*heights(i))
         if (allocated(error)) return
      end do
      associate (energy => 0.5_wp*0.0432_wp*(0.832869792_wp*0.3_wp)**2)
         call check(error, (sqrt(210.0_wp**2 + 2.0_wp*25.0e3_wp*energy) - 210.0_wp)/25.0e3_wp, rigid, thr=1.0e-5_wp*rigid)
      end associate
   end subroutine test_bounce

   !> Largest place of a body of 43.2 g that flies under a spring of 210 N and 25 kN/m, from the first free point: its energy there.
   function top(trajectory) result(height)
      type(trajectory_t), intent(in) :: trajectory
      real(wp) :: height
      integer :: i

      height = 0.0_wp
      do i = 1, trajectory%count
         if (trajectory%state(1, i) < 0.0_wp .or. trajectory%state(2, i) <= 0.0_wp) cycle
         height = sqrt((trajectory%state(1, i) + 8.4e-3_wp)**2 + trajectory%state(2, i)**2*0.0432_wp/25.0e3_wp) - 8.4e-3_wp
         return
      end do
   end function top

   subroutine test_kinks(error)
      type(error_type), allocatable, intent(out) :: error
      type(body_t) :: body
      type(trajectory_t) :: trajectory
      real(wp) :: state(2)
      integer :: i, found

      body = body_t(mass=0.0432_wp, stiffness=5.0e7_wp, damping=1.0_wp, force=210.0_wp)
      body%switches = 1
      state = [1.0e-4_wp, 0.0_wp]
      call run(body, "rodas5p", [0.0_wp, 1.0e-3_wp], [1.0e-11_wp, 1.0e-7_wp], state, trajectory, error)
      if (allocated(error)) return
      found = 0
      do i = 2, trajectory%count - 1
         if (trajectory%state(1, i - 1)*trajectory%state(1, i + 1) > 0.0_wp) cycle
         if (abs(trajectory%state(1, i)) < 1.0e-3_wp*maxval(abs(trajectory%state(1, i - 1:i + 1:2)))) found = found + 1
      end do
      call check(error, found >= 2, "no step ends where the body meets or leaves its seat")
   end subroutine test_kinks

   subroutine test_hovering(error)
      type(error_type), allocatable, intent(out) :: error
      type(body_t) :: body
      type(trajectory_t) :: trajectory
      real(wp) :: state(2)
      integer :: i

      do i = 1, size(methods)
         ! Behind the rise nothing moves
         body = body_t(rise=1.0_wp, stiffness=0.0_wp, hovers=.true.)
         body%switches = 1
         state = 0.0_wp
         call run(body, methods(i), [0.0_wp, 2.0_wp], [1.0e-10_wp, 1.0e-9_wp], state, trajectory, error)
         if (allocated(error)) return
         ! 15; 20 000 where every change of the sign ends a step
         call check(error, trajectory%count < 100, "steps of a body at rest: "//methods(i))
         if (allocated(error)) return
      end do
   end subroutine test_hovering

   !> Ground whose slope has kinks at whole places: four are passed in one direction or the other.
   subroutine test_markers(error)
      type(error_type), allocatable, intent(out) :: error
      type(body_t) :: body
      type(trajectory_t) :: trajectory
      real(wp) :: state(2)
      integer :: i, k, direction, found

      body = body_t(has_ground=.true.)
      body%markers = 1
      do k = 1, size(methods)
         do direction = -1, 1, 2
            state = [0.5_wp + 1.8_wp*direction, -2.0_wp*direction]
            call run(body, methods(k), [0.0_wp, 2.0_wp], [1.0e-6_wp, 1.0e-6_wp], state, trajectory, error)
            if (allocated(error)) return
            found = 0
            do i = 2, trajectory%count - 1
               associate (places => trajectory%state(1, i - 1:i + 1))
                  if (abs(places(2) - anint(places(2))) < 1.0e-3_wp*maxval(abs(places([1, 3]) - places(2)))) found = found + 1
               end associate
            end do
            call check(error, found >= 4, "no step ends at a whole place: "//methods(k))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_markers

   subroutine test_endings(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: words(*) = [character(len=48) :: "largest number of steps is reached at seat", &
         & "largest number of evaluations is reached at seat", "step size fell below its minimum at seat"]
      type(body_t) :: body
      class(method_t), allocatable :: method
      type(options_t) :: options
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(2)
      integer :: i

      body = body_t(mass=0.0432_wp, stiffness=5.0e7_wp, damping=1.0_wp, force=210.0_wp)
      body%switches = 1
      do i = 1, size(words)
         options = options_t(tolerance=[1.0e-13_wp, 1.0e-8_wp], step=1.0e-7_wp)
         if (i == 1) options%max_steps = 3
         if (i == 2) options%max_evaluations = 3
         if (i == 3) options%step = 1.0e-16_wp
         state = [0.0_wp, -0.3_wp]
         counters = counters_t()
         call new_method(method, "rodas5p", 2, failure)
         if (.not. allocated(failure)) call integrate_switching(body, method, options, [1.0_wp, 1.1_wp], state, trajectory, &
            & counters, failure)
         call check(error, allocated(failure), "no end by: "//words(i))
         if (allocated(error)) return
         call check(error, failure%kind == kind_convergence .and. index(failure%message, trim(words(i))) > 0, failure%message)
         if (allocated(error)) return
      end do
   end subroutine test_endings

   subroutine test_catch(error)
      type(error_type), allocatable, intent(out) :: error
      ! Starts, parts of a step that are looked at; steps tried at most, of which 20 to 50 are taken
      integer, parameter :: starts = 1000, parts = 16, most = 100
      ! Error of friction over the largest one: the slide may be told apart no better than by half of the speed within which it
      ! changes its sign, but steps are shortened to this error of friction; the curves between may have as much again [-]
      real(wp), parameter :: allowed = 0.02_wp
      type(slide_t) :: slide
      class(method_t), allocatable :: method
      type(options_t) :: options
      type(counters_t) :: counters
      type(trajectory_t) :: path
      type(error_t), allocatable :: failure
      ! Speed [m/s], time [s], friction over its largest value [-]
      real(wp) :: state(1), time, largest
      integer :: i, k, step, part, hint

      options%tolerance = [0.5_wp*slide%narrow]
      do k = 1, 2
         call new_method(method, methods(k), 1, failure)
         do i = 1, starts
            state = -slide%narrow*10.0_wp**(1.0_wp + 3.0_wp*i/starts)
            options%step = 1.0e-5_wp
            counters = counters_t()
            call integrate_switching(slide, method, options, [0.0_wp, 5.0e-3_wp], state, path, counters, failure)
            if (allocated(failure)) then
               call test_failed(error, failure%message)
               return
            end if
            largest = 0.0_wp
            do step = 1, path%count - 1
               do part = 0, parts
                  hint = step
                  time = path%time(step) + (path%time(step + 1) - path%time(step))*part/parts
                  call interpolate_state(path, time, hint, state)
                  largest = max(largest, tanh(state(1)/slide%narrow))
               end do
            end do
            call check(error, largest <= slide%drive/slide%friction + allowed, "friction passes what holds the slide, by "// &
               & trim(methods(k)))
            if (.not. allocated(error)) call check(error, counters%accepted + counters%rejected <= most, "too many steps")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_catch

   !> Rate of the speed of a slide.
   subroutine slide_rate(self, time, state, rate, status)
      class(slide_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      status = merge(0, 1, time >= 0.0_wp)
      rate = self%drive - self%friction*tanh(state/self%narrow)
   end subroutine slide_rate

   !> The same with its derivative, and with what saturates as a train has it.
   subroutine linearise_slide(self, time, state, horizon, linear, counters, status)
      class(slide_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(in) :: horizon
      type(linear_t), intent(inout) :: linear
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      call self%get_rate(min(time, horizon), state, linear%rate, status)
      counters%evaluations = counters%evaluations + 1
      linear%jacobian(1, 1) = -self%friction/self%narrow/cosh(min(abs(state(1)/self%narrow), 300.0_wp))**2
      linear%time_slope = 0.0_wp
      linear%span = self%friction
      linear%width = 2.5_wp*self%narrow
      linear%resolution = 0.01_wp
   end subroutine linearise_slide

   !> A slide has no switches.
   subroutine no_switches(self, time, state, switches, status)
      class(slide_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: switches(:)
      integer, intent(out) :: status

      status = merge(0, 1, time >= 0.0_wp .and. size(state) > self%switches)
      switches = 0.0_wp
   end subroutine no_switches

   function name_slide(self, time) result(text)
      class(slide_t), intent(in) :: self
      real(wp), intent(in) :: time
      character(len=words_length) :: text

      text = merge("slide ", "before", time >= 0.0_wp .and. self%switches == 0)
   end function name_slide

   !> Rate of place and speed.
   subroutine get_rate(self, time, state, rate, status)
      class(body_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status
      ! Place of the rise [m]; force and its elastic part [N], slopes [N/m], [N s/m]
      real(wp) :: place, force, elastic, slopes(2)

      status = 0
      rate(1) = state(2)
      if (self%has_ground) then
         rate(2) = abs(modulo(state(1), 2.0_wp) - 1.0_wp) - 0.5_wp
      else if (self%rise > 0.0_wp) then
         place = 1.0_wp
         if (time < self%rise) place = time/self%rise - sin(two_pi*time/self%rise)/two_pi
         rate(2) = self%stiffness*(place - state(1))/self%mass
      else
         call one_sided_force(self%stiffness, self%damping, -state(1), -state(2), force, elastic, slopes(1), slopes(2))
         rate(2) = (force - self%force - self%spring*state(1))/self%mass
      end if
   end subroutine get_rate

   !> Fastest rate.
   subroutine get_decay_rate(self, time, state, decay_rate)
      class(body_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate

      decay_rate = sqrt(self%stiffness/self%mass)
      if (size(state) == 0 .or. time < -pi) decay_rate = 0.0_wp
   end subroutine get_decay_rate

   !> The seat is met where the place is zero; the ground's slope bends at whole places.
   subroutine get_switches(self, time, state, switches, status)
      class(body_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: switches(:)
      integer, intent(out) :: status

      status = 0
      switches = 1.0_wp
      if (self%rise <= 0.0_wp .and. time > -pi) switches = -state(1)
      if (self%hovers) switches = 1.0e-18_wp*sin(1.0e4_wp*time)
      if (self%has_ground) switches = state(1)
   end subroutine get_switches

   function name_time(self, time) result(text)
      class(body_t), intent(in) :: self
      real(wp), intent(in) :: time
      character(len=words_length) :: text

      text = merge("seat", "rise", self%rise <= 0.0_wp)
      if (time < 0.0_wp) text = "before"
   end function name_time

end module test_ode_switching
