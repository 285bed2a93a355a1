!> How surfaces change while they run: growth of tribofilms and wear by the periodic cycle, and what that makes of them.
!>
!> In: model, surfaces as they are. Out: growth, decay and wear of each place, surfaces after a time, differences of surfaces.
!> Within a turn surfaces are held. Each evaluation solves the periodic cycle and takes from it, for each place, the time in
!> contact, stress, temperature and wear while it is; these make `dh/dt = a - b h` for thicknesses and `dd/dt = w` for depths. A
!> place on the cam meets the roller once a turn: at its own cam angle, or near it where the train bends. The roller creeps relative
!> to the cam: a place on it has the mean over the turn. A flexible train that repeats itself after several turns has their mean.
module camroller_surface_change
   use camroller_kinds, only : wp, two_pi
   use camroller_cam_surface, only : cam_surface_t, place_angle, set_cam
   use camroller_case, only : numerics_t
   use camroller_contact_forces, only : contact_t
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_flexible_follower, only : follower_on_path, follower_over_place
   use camroller_flexible_solution, only : flexible_solution_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_tribofilm, only : growth_rate, running_in_t, thickness_after, tribofilm_t
   use camroller_wear, only : time_in_contact, wear_t, worn_per_second
   implicit none
   private

   public :: surfaces_t, rates_t, plan_t, change_rates, move_surfaces, set_surface, differences, missed_between, &
      & expected_scales, relative, solved_t

   !> Thicknesses and depths: places of the cam, then the roller
   type :: surfaces_t
      !> Thickness of film and worn depth [m]
      real(wp), allocatable :: film(:), wear(:)
   end type surfaces_t

   !> How surfaces change, in the same order
   type :: rates_t
      !> Growth of films, a [m/s], their decay, b [1/s], wear, w [m/s]
      real(wp), allocatable :: growth(:), decay(:), wear(:)
      !> Mean over the turn of friction torque [N m], of the slip ratio and of the coefficient of asperities [-]
      real(wp) :: means(3) = 0.0_wp
   end type rates_t

   !> What a running-in is made of
   type :: plan_t
      type(running_in_t) :: running
      !> The film; zero rates where none grows
      type(tribofilm_t) :: film
      type(wear_t) :: wear
      type(numerics_t) :: numerics
      !> Temperature of the oil [K]
      real(wp) :: temperature = 0.0_wp
   end type plan_t

   !> Cycles solved so far
   type :: solved_t
      !> How many
      integer :: count = 0
      !> Start of a turn of the last one, with a flexible train [state]
      real(wp), allocatable :: start(:)
   end type solved_t

contains

   !> How surfaces change, from the periodic cycle with them.
   subroutine change_rates(plan, model, now, rates, solved, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; out: with these surfaces
      type(model_t), intent(inout) :: model
      !> The surfaces
      type(surfaces_t), intent(in) :: now
      !> Their rates
      type(rates_t), intent(out) :: rates
      !> Cycles solved before; out: with this one
      type(solved_t), intent(inout) :: solved
      !> Convergence error; domain error for a flexible train that does not repeat itself
      type(error_t), allocatable, intent(out) :: error

      type(cycle_t) :: cycle
      integer :: i, n

      n = plan%running%places
      call set_surface(model%surface, now)
      call integrate_cycle(cycle, model, plan%numerics, error, solved%start)
      solved%count = solved%count + 1
      if (allocated(error)) return
      allocate (rates%growth(n + 1), rates%decay(n + 1), rates%wear(n + 1), source=0.0_wp)
      if (.not. allocated(cycle%flexible)) then
         call add_turn(plan, model, cycle, rates, error)
         return
      end if
      associate (turns => cycle%flexible%turns)
         if (cycle%flexible%cycle%period == 0) then
            call raise(error, kind_domain, "hours of running are those of a train that repeats itself, which this one does not "// &
               & "at this speed; leave &running_in out, or &dynamics")
            return
         end if
         solved%start = turns(size(turns))%state(:, turns(size(turns))%count)
         do i = 1, size(turns)
            call add_flexible_turn(plan, model, cycle%flexible, i, rates, error)
            if (allocated(error)) return
         end do
      end associate
   end subroutine change_rates

   !> What a turn of a rigid train does.
   subroutine add_turn(plan, model, cycle, rates, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      !> Rates; out: with these
      type(rates_t), intent(inout) :: rates
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      integer :: i, hint

      hint = 1
      do i = 1, plan%running%places
         call state_at(cycle, model, place_angle(i, plan%running%places), hint, state, error)
         if (allocated(error)) return
         call add_to_means(state, plan%running%places, rates)
         call add_to_roller(plan, model, state%contact, plan%running%places, rates)
         call add_to_cam(plan, model, state%contact, i, 1, rates)
      end do
   end subroutine add_turn

   !> What one of the turns of a flexible train does.
   subroutine add_flexible_turn(plan, model, solution, turn, rates, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      type(model_t), intent(in) :: model
      !> All turns of a period
      type(flexible_solution_t), intent(in) :: solution
      !> Which of them
      integer, intent(in) :: turn
      !> Rates; out: with these
      type(rates_t), intent(inout) :: rates
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      integer :: i, turns, hint(2)

      turns = size(solution%turns)
      hint = 1
      associate (path => solution%turns(turn), resolution => solution%cycle%resolution, n => plan%running%places)
         do i = 1, n
            call follower_on_path(model, path, resolution, place_angle(i, n), hint(1), state, error)
            if (allocated(error)) return
            call add_to_means(state, n*turns, rates)
            call add_to_roller(plan, model, state%contact, n*turns, rates)
            call follower_over_place(model, path, resolution, place_angle(i, n), hint(2), state, error)
            if (allocated(error)) return
            call add_to_cam(plan, model, state%contact, i, turns, rates)
         end do
      end associate
   end subroutine add_flexible_turn

   !> Means over the turn.
   pure subroutine add_to_means(state, times, rates)
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Number of times, of which this is one
      integer, intent(in) :: times
      !> Rates; out: with its part in the means
      type(rates_t), intent(inout) :: rates

      rates%means(1) = rates%means(1) + state%torque_friction/times
      if (abs(state%contact%rolling_speed) > 0.0_wp) rates%means(2) = rates%means(2) + state%contact%sliding_speed &
         & /state%contact%rolling_speed/times
      rates%means(3) = rates%means(3) + state%contact%boundary_coefficient/times
   end subroutine add_to_means

   !> What the contact does to a place of the cam when it is there.
   pure subroutine add_to_cam(plan, model, contact, place, turns, rates)
      !> What is given
      type(plan_t), intent(in) :: plan
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Number of the place
      integer, intent(in) :: place
      !> Number of turns, of which this is one
      integer, intent(in) :: turns
      !> Rates; out: with these
      type(rates_t), intent(inout) :: rates

      ! Part of the time in contact [-]
      real(wp) :: time

      if (.not. contact%is_touching) return
      time = time_in_contact(contact%half_width, contact%cam_surface_speed, two_pi/model%speed)/turns
      call add_to_place(plan, contact, plan%wear%cam_rate, place, time, rates)
   end subroutine add_to_cam

   !> What the contact at a time does to the roller, all round.
   pure subroutine add_to_roller(plan, model, contact, times, rates)
      !> What is given
      type(plan_t), intent(in) :: plan
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Number of times, of which this is one
      integer, intent(in) :: times
      !> Rates; out: with these
      type(rates_t), intent(inout) :: rates

      if (.not. contact%is_touching) return
      call add_to_place(plan, contact, plan%wear%roller_rate, plan%running%places + 1, 2.0_wp*contact%half_width &
         & /(two_pi*model%roller_radius)/times, rates)
   end subroutine add_to_roller

   !> What the contact does to a place that is in it for a part of the time.
   pure subroutine add_to_place(plan, contact, wear_rate, place, time, rates)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Wear rate of the surface [m^3/(N m)]
      real(wp), intent(in) :: wear_rate
      !> Number of the place; after those of the cam, the roller
      integer, intent(in) :: place
      !> Part of the time [-]
      real(wp), intent(in) :: time
      !> Rates; out: with these
      type(rates_t), intent(inout) :: rates

      ! Growth and decay in contact [m/s], [1/s]; stress along the surfaces there [Pa]
      real(wp) :: growth, decay, stress

      rates%wear(place) = rates%wear(place) + time*worn_per_second(wear_rate, contact%asperity_load, contact%apparent_area, &
         & contact%sliding_speed)
      if (.not. plan%film%largest_thickness > 0.0_wp) return
      ! the film's shear is spread over the area that is sheared
      stress = (contact%traction - contact%shear*(1.0_wp - contact%apparent_area/contact%sheared_area))/contact%apparent_area
      growth = growth_rate(plan%film, stress, plan%temperature + contact%flash_rise)
      decay = growth/plan%film%largest_thickness + plan%film%removal_rate
      rates%growth(place) = rates%growth(place) + time*growth
      rates%decay(place) = rates%decay(place) + time*decay
   end subroutine add_to_place

   !> Give surfaces to a model.
   pure subroutine set_surface(surface, now)
      !> Those of the model
      type(cam_surface_t), intent(inout) :: surface
      !> The surfaces
      type(surfaces_t), intent(in) :: now

      integer :: n

      n = size(now%film) - 1
      call set_cam(surface, now%film(:n), now%wear(:n))
      surface%roller_film = now%film(n + 1)
      surface%roller_wear = now%wear(n + 1)
   end subroutine set_surface

   !> Surfaces after a time with the means of two rates.
   pure subroutine move_surfaces(now, first, last, time, next)
      !> Surfaces at the start
      type(surfaces_t), intent(in) :: now
      !> The rates
      type(rates_t), intent(in) :: first, last
      !> The time [s]
      real(wp), intent(in) :: time
      !> Surfaces at the end
      type(surfaces_t), intent(out) :: next

      next%film = thickness_after(now%film, 0.5_wp*(first%growth + last%growth), 0.5_wp*(first%decay + last%decay), time)
      next%wear = now%wear + 0.5_wp*(first%wear + last%wear)*time
   end subroutine move_surfaces

   !> Largest differences of thicknesses, of depths of the cam, and of the roller's depth.
   pure function differences(one, other) result(largest)
      !> The surfaces
      type(surfaces_t), intent(in) :: one, other
      !> The differences [m]
      real(wp) :: largest(3)

      associate (n => size(one%film))
         largest = [maxval(abs(one%film - other%film)), maxval(abs(one%wear(:n - 1) - other%wear(:n - 1))), &
            & abs(one%wear(n) - other%wear(n))]
      end associate
   end function differences

   !> What may be missed between the places of the cam: a cubic through two places on either side, every other one, misses this at
   !> the place between them. Curves through all places miss less, as their places are half as far from each other.
   pure function missed_between(now) result(largest)
      !> The surfaces
      type(surfaces_t), intent(in) :: now
      !> Of thicknesses and depths of the cam; none on the roller [m]
      real(wp) :: largest(3)

      associate (n => size(now%film) - 1)
         largest = [missed(now%film(:n)), missed(now%wear(:n)), 0.0_wp]
      end associate

   contains

      !> Of thicknesses or depths.
      pure function missed(values) result(most)
         !> At the places [m]
         real(wp), intent(in) :: values(:)
         !> The most [m]
         real(wp) :: most

         most = maxval(abs((9.0_wp*(cshift(values, 1) + cshift(values, -1)) - cshift(values, 3) - cshift(values, -3))/16.0_wp &
            & - values))
      end function missed

   end function missed_between

   !> Largest possible thickness, largest depth of the cam, and depth of the roller after a time at the same rates.
   pure function expected_scales(plan, now, rates, time) result(scales)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> Surfaces and rates
      type(surfaces_t), intent(in) :: now
      type(rates_t), intent(in) :: rates
      !> The time [s]
      real(wp), intent(in) :: time
      !> Thickness and depths [m]
      real(wp) :: scales(3)

      associate (depths => now%wear + rates%wear*time, n => size(now%wear))
         scales = [plan%film%largest_thickness, maxval(depths(:n - 1)), depths(n)]
      end associate
   end function expected_scales

   !> Largest of errors relative to what they are errors of; none where there is nothing.
   pure function relative(mistakes, scales) result(largest)
      !> Errors, and what they are errors of [m]
      real(wp), intent(in) :: mistakes(3), scales(3)
      !> The largest [-]
      real(wp) :: largest

      integer :: i

      largest = 0.0_wp
      do i = 1, size(scales)
         if (scales(i) > 0.0_wp) largest = max(largest, mistakes(i)/scales(i))
      end do
   end function relative

end module camroller_surface_change
