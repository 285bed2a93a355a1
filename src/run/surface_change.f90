!> How surfaces change while they run: growth of tribofilms and wear by the periodic cycle, and what that makes of them.
!>
!> In: model, surfaces as they are. Out: growth, decay and wear of each place, surfaces after a time, differences of surfaces.
!> Within a turn surfaces are held. Each evaluation solves the periodic cycle and takes from it, for each place, the time in
!> contact, stress, temperature and wear while it is; these make `dh/dt = a - b h` for thicknesses and `dd/dt = w` for depths. A
!> place on the cam meets the roller at its own cam angle alone. The roller creeps relative to the cam: a place on it has the mean
!> over the turn.
module camroller_surface_change
   use camroller_kinds, only : wp, two_pi
   use camroller_cam_surface, only : cam_surface_t, place_angle, set_cam
   use camroller_case, only : numerics_t
   use camroller_contact_forces, only : contact_t
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_tribofilm, only : growth_rate, running_in_t, thickness_after, tribofilm_t
   use camroller_wear, only : time_in_contact, wear_t, worn_per_second
   implicit none
   private

   public :: surfaces_t, rates_t, plan_t, change_rates, move_surfaces, set_surface, differences, missed_between, &
      & expected_scales, relative

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

contains

   !> How surfaces change, from the periodic cycle with them.
   subroutine change_rates(plan, model, now, rates, cycles, error)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model; out: with these surfaces
      type(model_t), intent(inout) :: model
      !> The surfaces
      type(surfaces_t), intent(in) :: now
      !> Their rates
      type(rates_t), intent(out) :: rates
      !> Cycles solved, counted on
      integer, intent(inout) :: cycles
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(cycle_t) :: cycle
      type(state_t) :: state
      integer :: i, n, hint

      n = plan%running%places
      call set_surface(model%surface, now)
      call integrate_cycle(cycle, model, plan%numerics, error)
      cycles = cycles + 1
      if (allocated(error)) return
      allocate (rates%growth(n + 1), rates%decay(n + 1), rates%wear(n + 1), source=0.0_wp)
      hint = 1
      do i = 1, n
         call state_at(cycle, model, place_angle(i, n), hint, state, error)
         if (allocated(error)) return
         rates%means(1) = rates%means(1) + state%torque_friction/n
         if (abs(state%contact%rolling_speed) > 0.0_wp) rates%means(2) = rates%means(2) + state%contact%sliding_speed &
            & /state%contact%rolling_speed/n
         rates%means(3) = rates%means(3) + state%contact%boundary_coefficient/n
         if (state%contact%is_touching) call add_place(plan, model, state%contact, i, rates)
      end do
   end subroutine change_rates

   !> What the contact at a cam angle does to its place on the cam, and its part in what the roller gets.
   pure subroutine add_place(plan, model, contact, place, rates)
      !> What is given
      type(plan_t), intent(in) :: plan
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Number of the place
      integer, intent(in) :: place
      !> Rates; out: with these
      type(rates_t), intent(inout) :: rates

      ! Parts of the time in contact, of the place on the cam and of any place of the roller [-]; turn of the cam [s]; growth and
      ! decay in contact [m/s], [1/s]; stress along the surfaces there [Pa]
      real(wp) :: on_cam, on_roller, period, growth, decay, stress

      associate (n => plan%running%places)
         period = two_pi/model%speed
         on_cam = time_in_contact(contact%half_width, contact%cam_surface_speed, period)
         on_roller = 2.0_wp*contact%half_width/(two_pi*model%roller_radius)/n
         rates%wear(place) = on_cam*worn_per_second(plan%wear%cam_rate, contact%asperity_load, contact%apparent_area, &
            & contact%sliding_speed)
         rates%wear(n + 1) = rates%wear(n + 1) + on_roller*worn_per_second(plan%wear%roller_rate, contact%asperity_load, &
            & contact%apparent_area, contact%sliding_speed)
         if (.not. plan%film%largest_thickness > 0.0_wp) return
         ! the film's shear is spread over the area that is sheared
         stress = (contact%traction - contact%shear*(1.0_wp - contact%apparent_area/contact%sheared_area))/contact%apparent_area
         growth = growth_rate(plan%film, stress, plan%temperature + contact%flash_rise)
         decay = growth/plan%film%largest_thickness + plan%film%removal_rate
         rates%growth(place) = on_cam*growth
         rates%decay(place) = on_cam*decay
         rates%growth(n + 1) = rates%growth(n + 1) + on_roller*growth
         rates%decay(n + 1) = rates%decay(n + 1) + on_roller*decay
      end associate
   end subroutine add_place

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
