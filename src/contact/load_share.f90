!> Load sharing between film and asperities: the film ratio at which both together carry the load.
!>
!> In: dimensionless groups of the contact, film law, asperity constants. Out: film, asperity load, real area; dimensionless.
!> With `h(w)` the film thickness at a film load w and `w_a(h)` the asperity load at a film thickness h, the equation is `h =
!> h(W* - w_a(h))`. Its left side rises and its right side falls with h, so there is one root. As the speed tends to zero the
!> root tends to the dry gap, `w_a(h_dry) = W*`, or to zero where the asperities alone cannot carry the load.
module camroller_load_share
   use camroller_kinds, only : wp
   use camroller_film, only : film_line_t, film_shape_t, film_at_load, log_films_at_load, takes_whole_load, asperity_part, &
      & groups_t, warm_speed, speed_by_factor
   use camroller_asperity, only : asperity_constants_t, asperity_load_function, asperity_area_function, &
      & law_masjedi_khonsari_asperities
   implicit none
   private

   public :: share_t, share_change_t, share_load, improve_share, share_change

   !> How film and load share follow a change of load, speed or radius
   type :: share_change_t
      !> Minimum film and central film over equivalent radius, their logarithms [-]
      real(wp) :: film_min, film_central
      !> Load of the film, its logarithm [-]
      real(wp) :: film_load
      !> Asperity load over E' R L [-]
      real(wp) :: asperity_load
      !> Real over apparent contact area [-]
      real(wp) :: real_area_ratio
   end type share_change_t

   !> Film and load share
   type :: share_t
      !> Minimum and central film over equivalent radius [-]
      real(wp) :: film_min, film_central
      !> Asperity load over E' R L [-]
      real(wp) :: asperity_load
      !> Real over apparent contact area [-]
      real(wp) :: real_area_ratio
      !> Load of the film over E' R L [-]
      real(wp) :: film_load
      !> Do asperities carry part of the load? Is the central film that of the law?
      logical :: has_asperities, has_own_central
      !> Change of asperity load over E' R L and of the real area ratio with the logarithm of the film ratio [-]
      real(wp) :: stiffness, area_stiffness
      !> Is the asperity load that of a regression over the groups?
      logical :: is_regressed
      !> Its logarithmic slopes over load, speed and roughness [-]
      real(wp) :: by_groups(3)
      !> Film with its slopes at the load of the film
      type(film_shape_t) :: shape
   end type share_t

   !> Smallest central film over equivalent radius [-]: far below a molecule, it keeps the traction slope finite at standstill
   real(wp), parameter :: smallest_film = 1.0e-10_wp
   !> Change of the film ratio, relative, at which the iteration ends [-]: the step after it would be below round-off
   real(wp), parameter :: tolerance = 1.0e-9_wp
   !> A single step is trusted where the film carries at least this part of the load and its change is not larger [-]
   real(wp), parameter :: smallest_film_part = 0.05_wp, largest_change = 0.1_wp
   !> Part of the load below which the load of the film is a small difference of large ones, and the film ratio has to be as much
   !> more accurate [-]
   real(wp), parameter :: ample_film_part = 0.1_wp
   !> Part of the load below which that difference is mostly rounding, and the film ratio tells the load of the film better [-]
   real(wp), parameter :: scant_film_part = 1.0e-4_wp
   !> Iterations: bisection from the widest bracket would need about 60
   integer, parameter :: max_iterations = 100

contains

   !> Share a load between film and asperities: converged to round-off, or to less where less is good enough.
   pure subroutine share_load(line, load, share, asperity, area, coarse, change)
      !> Film over the load at the speed of the contact
      type(film_line_t), intent(in) :: line
      !> Whole load over E' R L, positive [-]
      real(wp), intent(in) :: load
      !> Film and load share
      type(share_t), intent(out) :: share
      !> Asperities; absent: the film carries everything
      type(asperity_constants_t), intent(in), optional :: asperity
      !> Apparent area over E' R L, to go with `asperity` [1/Pa]
      real(wp), intent(in), optional :: area
      !> Relative change of the film ratio that may be the last; absent: one whose square is round-off [-]
      real(wp), intent(in), optional :: coarse
      !> The last change that was made; its square is about the error left [-]
      real(wp), intent(out), optional :: change

      type(film_shape_t) :: shape
      ! Film ratio [-]
      real(wp) :: film_ratio
      ! Change that may be the last, the last change [-]
      real(wp) :: last_allowed, last
      logical :: touches, is_part

      shape = film_shape_t(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
      if (line%groups%speed > 0.0_wp) call film_at_load(line, load, shape)
      film_ratio = shape%minimum/line%groups%roughness
      last_allowed = tolerance
      if (present(coarse)) last_allowed = max(tolerance, coarse)
      last = 0.0_wp
      if (present(asperity)) then
         touches = film_ratio < asperity%reach
      else
         touches = .false.
      end if
      is_part = .false.
      if (touches) is_part = takes_part(asperity)
      if (is_part) then
         call share_by_regression(line, load, shape, share)
      else if (touches) then
         share%shape = shape
         call share_with_asperities(line, load, asperity, area, last_allowed, film_ratio, share, last)
         call complete_share(line, asperity, film_ratio, share)
      else
         call film_alone(shape, load, share)
      end if
      if (present(change)) change = last
   end subroutine share_load

   !> Is the asperity load a part of the load by regression?
   elemental function takes_part(asperity)
      !> Asperities
      type(asperity_constants_t), intent(in) :: asperity
      !> Is it?
      logical :: takes_part

      takes_part = asperity%law == law_masjedi_khonsari_asperities
   end function takes_part

   !> Load share of a regression; it has no real area.
   pure subroutine share_by_regression(line, load, shape, share)
      !> Film over the load at the speed of the contact
      type(film_line_t), intent(in) :: line
      !> Whole load over E' R L [-]
      real(wp), intent(in) :: load
      !> Film of the whole load
      type(film_shape_t), intent(in) :: shape
      !> Film and load share
      type(share_t), intent(out) :: share

      type(groups_t) :: groups
      ! Part of the load [-]
      real(wp) :: part

      call film_alone(shape, load, share)
      groups = line%groups
      groups%load = load
      groups%speed = warm_speed(line)
      call asperity_part(groups, part, share%by_groups(1), share%by_groups(2), share%by_groups(3))
      share%has_asperities = .true.
      share%is_regressed = .true.
      share%asperity_load = part*load
      share%film_load = (1.0_wp - part)*load
   end subroutine share_by_regression

   !> One step of Newton's method from a film ratio nearby: as good as `share_load` to the square of the change it makes.
   !>
   !> For callers that iterate on the load as well and would throw a fully converged share away. Where the film ratio
   !> lies beyond the reach of asperities or a step cannot be made, the share is found by `share_load`.
   pure subroutine improve_share(line, load, share, asperity, area, start, change, coarse)
      !> Film over the load at the speed of the contact
      type(film_line_t), intent(in) :: line
      !> Whole load over E' R L, positive [-]
      real(wp), intent(in) :: load
      !> Film and load share
      type(share_t), intent(out) :: share
      !> Asperities
      type(asperity_constants_t), intent(in) :: asperity
      !> Apparent area over E' R L [1/Pa]
      real(wp), intent(in) :: area
      !> Film ratio to start from; zero where none is known [-]
      real(wp), intent(in) :: start
      !> Relative change of the film ratio that was made; its square is about the error left [-]
      real(wp), intent(out) :: change
      !> Relative change that may be the last where none is known; absent: one whose square is round-off [-]
      real(wp), intent(in), optional :: coarse

      type(film_shape_t) :: shape
      ! The asperities' function of the film ratio, its derivative; film load over E' R L and its derivative over ln H; logarithms
      ! of the films [-]
      real(wp) :: value, slope, film_load, film_load_slope, logs(2)

      change = 0.0_wp
      film_load = 0.0_wp
      if (start > 0.0_wp .and. start < asperity%reach .and. line%groups%speed > 0.0_wp &
         & .and. .not. takes_whole_load(line%law)) then
         call asperity_load_function(asperity, start, value, slope)
         film_load = load - asperity%load_factor*area*value
      end if
      if (film_load > smallest_film_part*load) then
         call log_films_at_load(line, film_load, logs, shape)
         film_load_slope = -asperity%load_factor*area*slope*start
         change = (logs(1) - log(start*line%groups%roughness))/(1.0_wp - shape%minimum_load_slope*film_load_slope/film_load)
      end if
      if (film_load <= smallest_film_part*load .or. abs(change) > largest_change) then
         call share_load(line, load, share, asperity, area, coarse, change)
         return
      end if
      shape%central = exp(logs(2))*(1.0_wp + shape%central_load_slope*film_load_slope/film_load*change)
      share%asperity_load = max(0.0_wp, min(asperity%load_factor*area*value - film_load_slope*change, load))
      share%film_load = load - share%asperity_load
      share%stiffness = -film_load_slope
      share%shape = shape
      call complete_share(line, asperity, start*(1.0_wp + change), share)
   end subroutine improve_share

   !> Load share without asperities within reach.
   pure subroutine film_alone(shape, load, share)
      !> Film that carries everything
      type(film_shape_t), intent(in) :: shape
      !> Whole load over E' R L [-]
      real(wp), intent(in) :: load
      !> Film and load share
      type(share_t), intent(out) :: share

      share%film_min = shape%minimum
      share%film_central = max(shape%central, shape%minimum, smallest_film)
      share%asperity_load = 0.0_wp
      share%real_area_ratio = 0.0_wp
      share%film_load = load
      share%has_asperities = .false.
      share%is_regressed = .false.
      share%by_groups = 0.0_wp
      share%has_own_central = shape%central >= max(shape%minimum, smallest_film)
      share%stiffness = 0.0_wp
      share%area_stiffness = 0.0_wp
      share%shape = shape
   end subroutine film_alone

   !> Load share with asperities whose loads are found: films, real area and what the slopes need.
   pure subroutine complete_share(line, asperity, film_ratio, share)
      !> Film over the load at the speed of the contact
      type(film_line_t), intent(in) :: line
      !> Asperities
      type(asperity_constants_t), intent(in) :: asperity
      !> Film ratio [-]
      real(wp), intent(in) :: film_ratio
      !> In: loads of asperities and film, stiffness and shape; out: everything
      type(share_t), intent(inout) :: share

      ! The area's function of the film ratio with its derivative [-]
      real(wp) :: area_value, area_slope

      call asperity_area_function(asperity, film_ratio, area_value, area_slope)
      share%film_min = film_ratio*line%groups%roughness
      share%film_central = max(share%shape%central, share%film_min, smallest_film)
      share%real_area_ratio = asperity%area_factor*area_value
      share%has_asperities = .true.
      share%is_regressed = .false.
      share%by_groups = 0.0_wp
      share%has_own_central = share%shape%central >= max(share%film_min, smallest_film)
      share%area_stiffness = asperity%area_factor*area_slope*film_ratio
   end subroutine complete_share

   !> How the share follows changes of load over radius, speed and radius; the apparent area is that of a line contact.
   !>
   !> With q = d ln(W/R), u = d ln U and r = d ln R, load groups follow q, the area over E' R L follows q/2 and the roughness
   !> over the radius -r; `h = f h(W* - w_a(h))` is differentiated as it stands. A law of the whole load has f as a change of U.
   pure function share_change(line, load, share, q, u, r, f) result(change)
      !> Film over the load at the speed of the contact
      type(film_line_t), intent(in) :: line
      !> Whole load over E' R L [-]
      real(wp), intent(in) :: load
      !> Film and load share
      type(share_t), intent(in) :: share
      !> Changes of load over radius, of the speed group and of the radius, their logarithms [-]
      real(wp), intent(in) :: q, u, r
      !> Change of the factor on both films, its logarithm; absent: none [-]
      real(wp), intent(in), optional :: f
      !> What follows
      type(share_change_t) :: change

      ! Changes of minimum and central film over radius that speed and roughness make at constant load, and of the film ratio [-]
      real(wp) :: own, own_central, film_ratio
      ! Denominator of the slope of the film ratio; change of ln U with that by heat in the inlet [-]
      real(wp) :: give, speed

      speed = u
      if (present(f) .and. takes_whole_load(line%law)) speed = u + speed_by_factor*f
      associate (shape => share%shape)
         own = shape%minimum_speed_slope*speed - shape%minimum_roughness_slope*r
         own_central = shape%central_speed_slope*speed - shape%central_roughness_slope*r
         if (present(f) .and. .not. takes_whole_load(line%law)) then
            own = own + f
            own_central = own_central + f
         end if
         change%film_load = q
         if (.not. share%has_asperities .or. takes_whole_load(line%law)) then
            film_ratio = own + shape%minimum_load_slope*q + r
         else
            give = share%film_load + shape%minimum_load_slope*share%stiffness
            film_ratio = 0.0_wp
            if (give > 0.0_wp) then
               film_ratio = (share%film_load*(own + r) + shape%minimum_load_slope*(load - 0.5_wp*share%asperity_load)*q)/give
            end if
            ! By the film law, since the difference of both loads may be next to nothing
            if (shape%minimum_load_slope < 0.0_wp) change%film_load = (film_ratio - own - r)/shape%minimum_load_slope
         end if
         change%film_min = film_ratio - r
         change%asperity_load = 0.5_wp*share%asperity_load*q + share%stiffness*film_ratio
         if (share%is_regressed) change%asperity_load = share%asperity_load*((1.0_wp + share%by_groups(1))*q &
            & + share%by_groups(2)*speed - share%by_groups(3)*r)
         change%real_area_ratio = share%area_stiffness*film_ratio
         change%film_central = own_central + shape%central_load_slope*change%film_load
      end associate
      if (takes_whole_load(line%law)) change%film_load = (load*q - change%asperity_load)/max(share%film_load, &
         & epsilon(load)*load)
      if (share%has_own_central) return
      change%film_central = 0.0_wp
      if (share%film_central > smallest_film) change%film_central = change%film_min
   end function share_change

   !> Film ratio at which the asperities carry what the film does not, by Newton's method on logarithms inside a bracket.
   pure subroutine share_with_asperities(line, load, asperity, area, last_allowed, film_ratio, share, change)
      !> Film over the load at the speed of the contact
      type(film_line_t), intent(in) :: line
      !> Whole load over E' R L, relative change of the film ratio that may be the last [-]
      real(wp), intent(in) :: load, last_allowed
      !> Asperities
      type(asperity_constants_t), intent(in) :: asperity
      !> Apparent area over E' R L [1/Pa]
      real(wp), intent(in) :: area
      !> In: film ratio to start from, that with the film carrying everything for laws that take the whole load; out: film
      !> ratio [-]
      real(wp), intent(inout) :: film_ratio
      !> In: shape of the film that carries everything; out: loads of asperities and film, stiffness and shape of the film
      type(share_t), intent(inout) :: share
      !> Last relative change of the film ratio [-]
      real(wp), intent(out) :: change

      ! Bracket of the film ratio; logarithms of film ratio, films and roughness [-]
      real(wp) :: low, high, log_ratio, logs(2), log_roughness
      ! Asperity load over E' R L and over the law's function of the film ratio; that function, its derivative; derivative of the
      ! film load over ln H [-]
      real(wp) :: capacity, value, slope, film_load_slope
      integer :: iteration
      logical :: has_film

      associate (film_load => share%film_load, asperity_load => share%asperity_load, shape => share%shape)
         change = 0.0_wp
         capacity = asperity%load_factor*area
         call carry_load(load, asperity, area, film_ratio, asperity_load, film_load, value, slope)
         share%stiffness = capacity*slope*film_ratio
         if (takes_whole_load(line%law)) return
         if (line%groups%speed <= 0.0_wp .and. asperity_load < load) return

         low = 0.0_wp
         high = asperity%reach
         log_ratio = log(max(film_ratio, tiny(film_ratio)))
         log_roughness = log(line%groups%roughness)
         do iteration = 1, max_iterations
            film_load = load - capacity*value
            change = 0.0_wp
            has_film = film_load > 0.0_wp .and. line%groups%speed > 0.0_wp
            if (has_film) then
               call log_films_at_load(line, film_load, logs, shape)
               film_load_slope = -capacity*slope*film_ratio
               share%stiffness = -film_load_slope
               change = (logs(1) - log_ratio - log_roughness)/(1.0_wp - shape%minimum_load_slope*film_load_slope/film_load)
               if (abs(change) <= max(tolerance, last_allowed*min(1.0_wp, film_load/(ample_film_part*load)))) then
                  film_ratio = film_ratio*(1.0_wp + change)
                  asperity_load = capacity*value - film_load_slope*change
                  call split_load(load, log_ratio + change + log_roughness - logs(1), shape, film_load, asperity_load)
                  shape%central = central_at(logs, log_ratio + change + log_roughness, shape)
                  return
               end if
            end if
            ! Without a positive film load the film ratio is below the root; at standstill it is above it otherwise
            if (film_load <= 0.0_wp .or. change > 0.0_wp) then
               low = max(low, film_ratio)
            else
               high = min(high, film_ratio)
            end if
            if (high - low <= 4.0_wp*epsilon(1.0_wp)*high) exit
            log_ratio = log_ratio + change
            film_ratio = exp(log_ratio)
            if (.not. has_film .or. film_ratio <= low .or. film_ratio >= high) then
               film_ratio = low + 0.5_wp*(high - low)
               log_ratio = log(film_ratio)
            end if
            call asperity_load_function(asperity, film_ratio, value, slope)
         end do
         change = 0.0_wp
         film_ratio = high
         if (has_film) shape%central = central_at(logs, log(film_ratio) + log_roughness, shape)
         call carry_load(load, asperity, area, film_ratio, asperity_load, film_load, value, slope)
      end associate
   end subroutine share_with_asperities

   !> Load of the asperities at a film ratio, no more than the whole, and what is left to the film.
   pure subroutine carry_load(load, asperity, area, film_ratio, asperity_load, film_load, value, slope)
      !> Whole load over E' R L; film ratio [-]
      real(wp), intent(in) :: load, film_ratio
      !> Asperities
      type(asperity_constants_t), intent(in) :: asperity
      !> Apparent area over E' R L [1/Pa]
      real(wp), intent(in) :: area
      !> Asperity load and film load over E' R L [-]
      real(wp), intent(out) :: asperity_load, film_load
      !> The law's function of the film ratio, and its derivative [-]
      real(wp), intent(out) :: value, slope

      call asperity_load_function(asperity, film_ratio, value, slope)
      asperity_load = max(0.0_wp, min(asperity%load_factor*area*value, load))
      film_load = load - asperity_load
   end subroutine carry_load

   !> Load of film and asperities after the last step of the film ratio.
   !>
   !> Where asperities carry nearly all, the load of the film as what they leave is mostly rounding, and rolling resistance with it;
   !> the film itself is not, and tells by its law what it carries. Where asperities carry next to nothing, what the film leaves to
   !> them is rounding: theirs follows from their own law.
   pure subroutine split_load(load, log_shift, shape, film_load, asperity_load)
      !> Whole load over E' R L [-]
      real(wp), intent(in) :: load
      !> Logarithm of the film after the step over that of the law at the film load before [-]
      real(wp), intent(in) :: log_shift
      !> Film at the film load before
      type(film_shape_t), intent(in) :: shape
      !> Load of the film, before and after the step [-]
      real(wp), intent(inout) :: film_load
      !> Load of the asperities after the step: in by their law, out as the film leaves it where that tells it better [-]
      real(wp), intent(inout) :: asperity_load

      ! Logarithm of the growth of the film's load that is believed [-]
      real(wp), parameter :: most = 30.0_wp

      if (film_load < scant_film_part*load .and. abs(shape%minimum_load_slope) > 0.0_wp) then
         film_load = min(film_load*exp(max(-most, min(most, log_shift/shape%minimum_load_slope))), load)
         asperity_load = load - film_load
      else
         ! A film that carries next to nothing must not come out as carrying less
         asperity_load = max(0.0_wp, min(asperity_load, load))
         film_load = load - asperity_load
      end if
   end subroutine split_load

   !> Central film that goes with a minimum film.
   !>
   !> Where asperities carry nearly all, the load of the film is a difference of two large numbers and mostly rounding; the minimum
   !> film is not, and it holds the same load.
   pure function central_at(logs, log_minimum, shape) result(central)
      !> Logarithms of minimum and central film at a load nearby, of the minimum film in question [-]
      real(wp), intent(in) :: logs(2), log_minimum
      !> Slopes at that load
      type(film_shape_t), intent(in) :: shape
      !> Central film over equivalent radius [-]
      real(wp) :: central

      central = logs(2)
      if (abs(shape%minimum_load_slope) > 0.0_wp) then
         central = central + shape%central_load_slope/shape%minimum_load_slope*(log_minimum - logs(1))
      end if
      central = exp(central)
   end function central_at

end module camroller_load_share
