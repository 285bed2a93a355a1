!> Film thickness of an elastohydrodynamic line contact: published regressions with one interface.
!>
!> In: the dimensionless groups. Out: central and minimum film relative to the equivalent radius, with their logarithmic
!> slopes. Groups: U = eta0 |V_e|/(E' R), G = alpha E', W* = w/(E' R L) with w the load carried by the film, V_e
!> the mean surface speed; H = h/R.
!>
!> | law | sources |
!> |---|---|
!> | `dowson_higginson` | minimum: Dowson and Higginson (1966); central: Dowson and Toyoda (1978); Islam (2019) eqs. (29), (30) |
!> | `pan_hamrock` | Pan and Hamrock, J. Tribol. 111 (1989) 246 |
!> | `masjedi_khonsari` | Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, smooth surfaces |
!> | `masjedi_khonsari_rough` | the same, with its roughness factors; takes the whole load; their part of the load on asperities
!> goes with it |
!> | `moes` | Moes, Lubrication and Beyond (2000): joins rigid and elastic, isoviscous and piezoviscous asymptotes |
module camroller_film
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   use camroller_film_table, only : film_table_t, film_series_t, table_series, series_films, is_in_table
   implicit none
   private

   public :: film_t, groups_t, film_shape_t, film_line_t, film_law_names, range_policy_names, range_stop
   public :: film_shape, new_film_line, film_at_load, log_films_at_load, is_in_range, takes_whole_load, published_range, &
      & asperity_part, group_count, group_values, warm_speed, speed_by_factor
   public :: law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari, law_masjedi_khonsari_rough, law_moes, law_table

   !> Film-thickness laws
   character(len=*), parameter :: film_law_names(*) = [character(len=name_length) :: &
      "dowson_higginson", "pan_hamrock", "masjedi_khonsari", "masjedi_khonsari_rough", "moes"]
   !> Positions in `film_law_names`, power laws first: rows of `power_laws`
   integer, parameter :: law_dowson_higginson = 1, law_pan_hamrock = 2, law_masjedi_khonsari = 3, &
      & law_masjedi_khonsari_rough = 4, law_moes = 5
   !> Law that has no name: a table of numerical solutions
   integer, parameter :: law_table = size(film_law_names) + 1
   !> What to do where a law is used outside its published range
   character(len=*), parameter :: range_policy_names(*) = [character(len=name_length) :: "warn", "stop"]
   !> Position in `range_policy_names`
   integer, parameter :: range_stop = 2

   !> Choice of the film law
   type :: film_t
      !> One of `film_law_names`
      character(len=name_length) :: law = "dowson_higginson"
      !> One of `range_policy_names`
      character(len=name_length) :: range_policy = "warn"
   end type film_t

   !> How many groups a contact has
   integer, parameter :: group_count = 5
   !> Dimensionless groups of a line contact
   type :: groups_t
      !> Speed, U [-]
      real(wp) :: speed
      !> Material, G [-]
      real(wp) :: material
      !> Load, W* [-]
      real(wp) :: load
      !> Composite roughness over equivalent radius [-]; rough law
      real(wp) :: roughness
      !> Hardness over equivalent modulus [-]; rough law
      real(wp) :: hardness
   end type groups_t

   !> Film thickness over equivalent radius, and how it follows speed and load
   type :: film_shape_t
      !> Central and minimum film [-]
      real(wp) :: central, minimum
      !> d ln(film)/d ln(W*) [-]
      real(wp) :: central_load_slope, minimum_load_slope
      !> d ln(film)/d ln(U) [-]
      real(wp) :: central_speed_slope, minimum_speed_slope
      !> d ln(film)/d ln(roughness over radius) [-]
      real(wp) :: central_roughness_slope, minimum_roughness_slope
   end type film_shape_t

   !> Film over the load at one speed: what does not change with the load is worked out once
   type :: film_line_t
      !> Position in `film_law_names`
      integer :: law
      !> Is it a power law?
      logical :: is_power
      !> Groups; the load is that of the contact
      type(groups_t) :: groups
      !> Power laws: logarithm of the minimum and the central film at unit load [-]
      real(wp) :: unit_logs(2)
      !> ln of a factor on both films: heat in the inlet; the rough regression takes it as less speed [-]
      real(wp) :: log_factor = 0.0_wp
      !> Table: films over the load
      type(film_series_t) :: series
   end type film_line_t

   !> Power laws `H = factor U^speed G^material W*^load`, columns: factor, speed, material, load [-]
   !> rows: minimum and central film of Dowson, Pan, Masjedi
   real(wp), parameter :: power_laws(4, 2, 3) = reshape([ &
      2.65_wp, 0.70_wp, 0.54_wp, -0.13_wp, 3.06_wp, 0.69_wp, 0.56_wp, -0.10_wp, &
      1.714_wp, 0.694_wp, 0.568_wp, -0.128_wp, 2.922_wp, 0.692_wp, 0.470_wp, -0.166_wp, &
      1.652_wp, 0.716_wp, 0.695_wp, -0.077_wp, 2.691_wp, 0.705_wp, 0.556_wp, -0.135_wp], [4, 2, 3])
   !> Logarithms of the factors [-]
   real(wp), parameter :: log_factors(2, 3) = log(power_laws(1, :, :))
   !> Roughness factors of Masjedi and Khonsari, `1 + factor s^a v^b W*^c U^d G^e`: factor, a, b, c, d, e [-];
   !> first minimum, second central film
   real(wp), parameter :: rough_factors(6, 2) = reshape([ &
      0.026_wp, 1.120_wp, 0.185_wp, -0.312_wp, -0.809_wp, -0.977_wp, &
      0.2_wp, 1.222_wp, 0.223_wp, -0.229_wp, -0.748_wp, -0.842_wp], [6, 2])
   !> Most that asperities carry of a load: the regression goes beyond all of it outside its range, and a film has to be left [-]
   real(wp), parameter :: largest_part = 0.999_wp
   !> Sharpness of the bend towards it [-]: half of the load changes by 0.05 %
   integer, parameter :: bend = 8

   !> Part by which the minimum film lies below Moes' central film in the elastic regime: the 1.55/1.77 of the numerical
   !> solution at U 1e-11, W* 1e-4, G 4500 in Masjedi and Khonsari (2012); ours, since Moes gives no minimum [-]
   real(wp), parameter :: moes_elastic_dip = 0.124_wp

   !> No bound [-]
   real(wp), parameter :: open_end = huge(1.0_wp)
   !> Ranges of roughness and hardness of a law that takes neither, lower and upper [-]
   real(wp), parameter :: smooth(4) = [0.0_wp, open_end, 0.0_wp, open_end]
   !> Published ranges of U, G, W*, sigma/R and hardness/E', lower and upper, one row a law [-]. Dowson and Higginson solved 1e-13 <
   !> U < 1e-10, 2500 < G < 5000, 1.5e-5 < W* < 3e-4; Pan and Hamrock, and Masjedi and Khonsari in the first three, as they are
   !> commonly quoted, not compared with the papers; the last two are those of Masjedi and Khonsari's table of solutions; Moes'
   !> formula has the four asymptotes as its limits and so no outer range.
   real(wp), parameter :: ranges(2, group_count, size(film_law_names)) = reshape([ &
      1.0e-13_wp, 1.0e-10_wp, 2.5e3_wp, 5.0e3_wp, 1.5e-5_wp, 3.0e-4_wp, smooth, &
      1.0e-13_wp, 1.0e-8_wp, 2.0e3_wp, 1.0e4_wp, 2.0e-5_wp, 5.0e-4_wp, smooth, &
      1.0e-12_wp, 1.0e-10_wp, 2.5e3_wp, 7.5e3_wp, 2.0e-5_wp, 5.0e-4_wp, smooth, &
      1.0e-12_wp, 1.0e-10_wp, 2.5e3_wp, 7.5e3_wp, 2.0e-5_wp, 5.0e-4_wp, 0.0_wp, 4.0e-5_wp, 5.0e-3_wp, 3.0e-2_wp, &
      0.0_wp, open_end, 0.0_wp, open_end, 0.0_wp, open_end, smooth], [2, group_count, size(film_law_names)])
   !> Least U for which the roughness factors were published; at less they stay as they are there [-]
   real(wp), parameter :: least_rough_speed = ranges(1, 1, law_masjedi_khonsari_rough)
   !> Change of ln U in a rough contact with ln of a factor on films by heat in the inlet: that of an oil with which the smooth
   !> minimum film is as much thinner [-]
   real(wp), parameter :: speed_by_factor = 1.0_wp/power_laws(2, 1, law_masjedi_khonsari)

contains

   !> Film thickness over equivalent radius by a law.
   !>
   !> Speed and load must be positive; the limits at standstill and at zero film load belong to the caller.
   pure subroutine film_shape(law, groups, shape)
      !> Position in `film_law_names`
      integer, intent(in) :: law
      !> Dimensionless groups
      type(groups_t), intent(in) :: groups
      !> Film thickness and its slopes
      type(film_shape_t), intent(out) :: shape

      type(film_line_t) :: line

      select case (law)
      case (:law_masjedi_khonsari)
         call new_film_line(line, law, groups)
         call power_at_load(line, groups%load, shape)
      case (law_masjedi_khonsari_rough)
         call new_film_line(line, law_masjedi_khonsari, groups)
         call power_at_load(line, groups%load, shape)
         call roughen(groups, shape)
      case (law_moes)
         call moes_shape(groups, shape)
      end select
   end subroutine film_shape

   !> Film over the load at the speed of the groups; at standstill there is no film to evaluate.
   pure subroutine new_film_line(line, law, groups, table)
      !> Film over the load
      type(film_line_t), intent(out) :: line
      !> Position in `film_law_names`
      integer, intent(in) :: law
      !> Dimensionless groups
      type(groups_t), intent(in) :: groups
      !> Films of numerical solutions, to go with `law_table`
      type(film_table_t), intent(in), optional :: table

      ! Logarithms of U and G [-]
      real(wp) :: logs(2)

      line%law = law
      line%groups = groups
      line%is_power = law <= law_masjedi_khonsari
      line%unit_logs = 0.0_wp
      if (present(table) .and. groups%speed > 0.0_wp) call table_series(table, log(groups%speed), line%series)
      if (.not. line%is_power .or. groups%speed <= 0.0_wp) return
      logs = [log(groups%speed), log(groups%material)]
      line%unit_logs = log_factors(:, law) + power_laws(2, :, law)*logs(1) + power_laws(3, :, law)*logs(2)
   end subroutine new_film_line

   !> Film at a load that the film carries.
   pure subroutine film_at_load(line, load, shape)
      !> Film over the load
      type(film_line_t), intent(in) :: line
      !> Load group W*, positive [-]
      real(wp), intent(in) :: load
      !> Film thickness and its slopes
      type(film_shape_t), intent(out) :: shape

      type(groups_t) :: groups

      if (line%is_power) then
         call power_at_load(line, load, shape)
      else if (line%law == law_table) then
         call table_at_load(line, load, shape)
      else
         groups = line%groups
         groups%load = load
         if (takes_whole_load(line%law)) groups%speed = warm_speed(line)
         call film_shape(line%law, groups, shape)
      end if
      if (line%is_power .or. takes_whole_load(line%law) .or. .not. abs(line%log_factor) > 0.0_wp) return
      shape%minimum = shape%minimum*exp(line%log_factor)
      shape%central = shape%central*exp(line%log_factor)
   end subroutine film_at_load

   !> U of a rough contact with the oil of a warm inlet: films and what asperities carry are those at this speed.
   elemental function warm_speed(line) result(speed)
      !> Film over the load, of a rough contact
      type(film_line_t), intent(in) :: line
      !> U [-]
      real(wp) :: speed

      speed = line%groups%speed
      if (abs(line%log_factor) > 0.0_wp) speed = speed*exp(speed_by_factor*line%log_factor)
   end function warm_speed

   !> Logarithms of both films at a load that the film carries, and the slopes; the films themselves are left to the caller.
   pure subroutine log_films_at_load(line, load, logs, shape)
      !> Film over the load
      type(film_line_t), intent(in) :: line
      !> Load group W*, positive [-]
      real(wp), intent(in) :: load
      !> Logarithms of minimum and central film [-]
      real(wp), intent(out) :: logs(2)
      !> Slopes
      type(film_shape_t), intent(inout) :: shape

      if (line%is_power) then
         call power_slopes(line%law, shape)
         logs = line%unit_logs + power_laws(4, :, line%law)*log(load) + line%log_factor
      else
         call film_at_load(line, load, shape)
         logs = log([shape%minimum, shape%central])
      end if
   end subroutine log_films_at_load

   !> Does the law take the whole load instead of the part that the film carries?
   elemental function takes_whole_load(law) result(whole)
      !> Position in `film_law_names`
      integer, intent(in) :: law
      !> True for the rough regression
      logical :: whole

      whole = law == law_masjedi_khonsari_rough
   end function takes_whole_load

   !> Are the groups inside the published range of a law?
   pure function is_in_range(law, groups, table) result(inside)
      !> Position in `film_law_names`
      integer, intent(in) :: law
      !> Dimensionless groups
      type(groups_t), intent(in) :: groups
      !> Films of numerical solutions, to go with `law_table`
      type(film_table_t), intent(in), optional :: table
      !> True inside
      logical :: inside

      ! The groups [-]
      real(wp) :: values(group_count)

      if (present(table)) then
         inside = is_in_table(table, groups%speed, groups%load)
         return
      end if
      values = group_values(groups)
      inside = all(values >= ranges(1, :, law) .and. values <= ranges(2, :, law))
   end function is_in_range

   !> The groups in the order of their ranges: U, G, W*, sigma/R, hardness/E'.
   pure function group_values(groups) result(values)
      !> The groups
      type(groups_t), intent(in) :: groups
      !> Their values [-]
      real(wp) :: values(group_count)

      values = [groups%speed, groups%material, groups%load, groups%roughness, groups%hardness]
   end function group_values

   !> Bounds of the groups for which a law was published.
   pure function published_range(law) result(bounds)
      !> Position in `film_law_names`
      integer, intent(in) :: law
      !> Smallest and largest of each [-]
      real(wp) :: bounds(2, group_count)

      bounds = ranges(:, :, law)
   end function published_range

   !> Both films of a table.
   pure subroutine table_at_load(line, load, shape)
      !> Film over the load
      type(film_line_t), intent(in) :: line
      !> Load group W*, positive [-]
      real(wp), intent(in) :: load
      !> Film thickness and its slopes
      type(film_shape_t), intent(out) :: shape

      ! Logarithms of minimum and central film; their slopes over the logarithms of load and speed [-]
      real(wp) :: films(2), load_slopes(2), speed_slopes(2)

      call series_films(line%series, log(load), films, load_slopes, speed_slopes)
      shape%minimum = exp(films(1))
      shape%central = exp(films(2))
      shape%minimum_load_slope = load_slopes(1)
      shape%central_load_slope = load_slopes(2)
      shape%minimum_speed_slope = speed_slopes(1)
      shape%central_speed_slope = speed_slopes(2)
      shape%minimum_roughness_slope = 0.0_wp
      shape%central_roughness_slope = 0.0_wp
   end subroutine table_at_load

   !> Both films of a pair of power laws.
   pure subroutine power_at_load(line, load, shape)
      !> Film over the load
      type(film_line_t), intent(in) :: line
      !> Load group W*, positive [-]
      real(wp), intent(in) :: load
      !> Film thickness and its slopes
      type(film_shape_t), intent(out) :: shape

      ! ln W* [-]
      real(wp) :: log_load

      log_load = log(load)
      call power_slopes(line%law, shape)
      shape%minimum = exp(line%unit_logs(1) + shape%minimum_load_slope*log_load + line%log_factor)
      shape%central = exp(line%unit_logs(2) + shape%central_load_slope*log_load + line%log_factor)
   end subroutine power_at_load

   !> Slopes of a pair of power laws.
   pure subroutine power_slopes(law, shape)
      !> Position in `film_law_names`
      integer, intent(in) :: law
      !> Its slopes are set
      type(film_shape_t), intent(inout) :: shape

      shape%minimum_load_slope = power_laws(4, 1, law)
      shape%central_load_slope = power_laws(4, 2, law)
      shape%minimum_speed_slope = power_laws(2, 1, law)
      shape%central_speed_slope = power_laws(2, 2, law)
      shape%minimum_roughness_slope = 0.0_wp
      shape%central_roughness_slope = 0.0_wp
   end subroutine power_slopes

   !> Multiply both films by the roughness factors of Masjedi and Khonsari.
   !>
   !> The factors grow as the speed falls, and faster than the smooth film falls where they are large. Below the least published
   !> speed they are those of that speed, so that the film falls with the speed and goes to zero.
   pure subroutine roughen(groups, shape)
      !> Dimensionless groups
      type(groups_t), intent(in) :: groups
      !> In: smooth film; out: rough film
      type(film_shape_t), intent(inout) :: shape

      ! Rise of minimum and central film by roughness; U that it is taken at [-]
      real(wp) :: rise(2), speed
      integer :: i

      speed = max(groups%speed, least_rough_speed)
      do i = 1, 2
         rise(i) = rough_factors(1, i)*groups%roughness**rough_factors(2, i)*groups%hardness**rough_factors(3, i) &
            & *groups%load**rough_factors(4, i)*speed**rough_factors(5, i)*groups%material**rough_factors(6, i)
      end do
      shape%minimum = shape%minimum*(1.0_wp + rise(1))
      shape%central = shape%central*(1.0_wp + rise(2))
      rise = rise/(1.0_wp + rise)
      shape%minimum_load_slope = shape%minimum_load_slope + rise(1)*rough_factors(4, 1)
      shape%central_load_slope = shape%central_load_slope + rise(2)*rough_factors(4, 2)
      shape%minimum_roughness_slope = rise(1)*rough_factors(2, 1)
      shape%central_roughness_slope = rise(2)*rough_factors(2, 2)
      if (groups%speed < least_rough_speed) return
      shape%minimum_speed_slope = shape%minimum_speed_slope + rise(1)*rough_factors(5, 1)
      shape%central_speed_slope = shape%central_speed_slope + rise(2)*rough_factors(5, 2)
   end subroutine roughen

   !> Part of the load that asperities carry by the regression of Masjedi and Khonsari (2012), with its logarithmic slopes.
   !>
   !> `0.005 W*^-0.408 U^-0.088 G^0.103 ln(1 + 4470 s^6.015 v^1.168 W*^0.485 U^-3.741 G^-2.898)` per cent of the whole load, for
   !> asperities of Zhao, Maietta and Chang with eta beta sigma = 0.05 and sigma/beta = 0.01; bent towards `largest_part`.
   pure subroutine asperity_part(groups, part, load_slope, speed_slope, roughness_slope)
      !> Groups with the whole load
      type(groups_t), intent(in) :: groups
      !> Part of the load [-]
      real(wp), intent(out) :: part
      !> d ln(part) over the logarithms of load, speed and roughness over radius [-]
      real(wp), intent(out) :: load_slope, speed_slope, roughness_slope

      ! Logarithm of what is added to one, above underflow; logarithm of the sum; its slope over the first [-]
      real(wp) :: exponent, whole, slope
      real(wp), parameter :: least_exponent = -600.0_wp

      part = largest_part
      load_slope = 0.0_wp
      speed_slope = 0.0_wp
      roughness_slope = 0.0_wp
      if (.not. groups%speed > 0.0_wp) return
      exponent = max(log(4470.0_wp) + 6.015_wp*log(groups%roughness) + 1.168_wp*log(groups%hardness) &
         & + 0.485_wp*log(groups%load) - 3.741_wp*log(groups%speed) - 2.898_wp*log(groups%material), least_exponent)
      if (exponent > 0.0_wp) then
         whole = exponent + log(1.0_wp + exp(-exponent))
         slope = 1.0_wp/(1.0_wp + exp(-exponent))/whole
      else
         ! ln(1 + x) loses the figures of a small x
         slope = exp(exponent)
         whole = log(1.0_wp + slope)
         if (slope < 1.0e-5_wp) whole = slope*(1.0_wp - 0.5_wp*slope*(1.0_wp - 2.0_wp/3.0_wp*slope))
         slope = slope/(1.0_wp + slope)/whole
      end if
      part = 5.0e-5_wp*groups%load**(-0.408_wp)*groups%speed**(-0.088_wp)*groups%material**0.103_wp*whole/largest_part
      load_slope = 0.485_wp*slope - 0.408_wp
      speed_slope = -3.741_wp*slope - 0.088_wp
      roughness_slope = 6.015_wp*slope
      ! part/(1 + part^8)^(1/8)
      if (part > 1.0_wp) then
         whole = 1.0_wp + part**(-bend)
         slope = part**(-bend)/whole
         part = largest_part*whole**(-1.0_wp/bend)
      else
         whole = 1.0_wp + part**bend
         slope = 1.0_wp/whole
         part = largest_part*part*whole**(-1.0_wp/bend)
      end if
      load_slope = load_slope*slope
      speed_slope = speed_slope*slope
      roughness_slope = roughness_slope*slope
   end subroutine asperity_part

   !> Moes' formula for the central film; the minimum lies below it by `moes_elastic_dip` where elastic deformation rules.
   !>
   !> `H/sqrt(2U) = [(R^(7/3) + E^(7/3))^(3s/7) + (P^(-7/2) + Q^(-7/2))^(-2s/7)]^(1/s)`, `s = (7 + 8 exp(-2 E/R))/5`,
   !> R = 3/M, E = 2.621 M^(-1/5), P = 1.287 L^(2/3), Q = 1.311 M^(-1/8) L^(3/4), M = W*/sqrt(2U), L = G (2U)^(1/4).
   pure subroutine moes_shape(groups, shape)
      !> Dimensionless groups
      type(groups_t), intent(in) :: groups
      !> Film thickness and its slopes
      type(film_shape_t), intent(out) :: shape

      ! Logarithms of M and L, of the asymptotes R and Q, of E/R and Q/P [-]
      real(wp) :: log_m, log_l, log_rigid, log_elastic_piezo, log_ratio, log_piezo_ratio
      ! Exponent s; E/R, also to the power 7/3 [-]
      real(wp) :: s, ratio, power
      ! Logarithms of the isoviscous and the piezoviscous branch, each to the power 1 in H [-]
      real(wp) :: log_iso, log_piezo
      ! Shares of the branches and of the asymptotes in them [-]
      real(wp) :: iso_share, elastic_share, elastic_piezo_share
      ! d ln/d ln M and d ln/d ln L of the film; d s/d ln M [-]
      real(wp) :: slope_m, slope_l, s_slope
      ! Logarithm of the film in Moes' units [-]
      real(wp) :: log_film
      ! Dip of the minimum film and its slope with ln M [-]
      real(wp) :: dip, dip_slope

      log_m = log(groups%load/sqrt(2.0_wp*groups%speed))
      log_l = log(groups%material*sqrt(sqrt(2.0_wp*groups%speed)))
      log_rigid = log(3.0_wp) - log_m
      log_elastic_piezo = log(1.311_wp) - 0.125_wp*log_m + 0.75_wp*log_l
      log_ratio = log(2.621_wp/3.0_wp) + 0.8_wp*log_m
      log_piezo_ratio = log_elastic_piezo - log(1.287_wp) - 2.0_wp/3.0_wp*log_l
      ratio = exp(log_ratio)
      power = exp(7.0_wp/3.0_wp*log_ratio)
      s = 0.2_wp*(7.0_wp + 8.0_wp*exp(-2.0_wp*ratio))
      s_slope = -1.6_wp*exp(-2.0_wp*ratio)*2.0_wp*0.8_wp*ratio

      elastic_share = power/(1.0_wp + power)
      log_iso = log_rigid + 3.0_wp/7.0_wp*log(1.0_wp + power)
      elastic_piezo_share = 1.0_wp/(1.0_wp + exp(3.5_wp*log_piezo_ratio))
      log_piezo = log_elastic_piezo + 2.0_wp/7.0_wp*log(elastic_piezo_share)
      iso_share = 1.0_wp/(1.0_wp + exp(s*(log_piezo - log_iso)))
      log_film = log_iso - log(iso_share)/s

      slope_m = iso_share*(-1.0_wp + 0.8_wp*elastic_share) + (1.0_wp - iso_share)*(-0.125_wp*elastic_piezo_share) &
         & + s_slope/s*(iso_share*log_iso + (1.0_wp - iso_share)*log_piezo - log_film)
      slope_l = (1.0_wp - iso_share)*(0.75_wp*elastic_piezo_share + 2.0_wp/3.0_wp*(1.0_wp - elastic_piezo_share))
      shape%central = exp(log_film)*sqrt(2.0_wp*groups%speed)
      shape%central_load_slope = slope_m
      shape%central_speed_slope = 0.5_wp - 0.5_wp*slope_m + 0.25_wp*slope_l

      dip = moes_elastic_dip*elastic_share
      dip_slope = dip*(1.0_wp - elastic_share)*0.8_wp*7.0_wp/3.0_wp
      shape%minimum = (1.0_wp - dip)*shape%central
      shape%minimum_load_slope = slope_m - dip_slope/(1.0_wp - dip)
      shape%minimum_speed_slope = shape%central_speed_slope + 0.5_wp*dip_slope/(1.0_wp - dip)
      shape%central_roughness_slope = 0.0_wp
      shape%minimum_roughness_slope = 0.0_wp
   end subroutine moes_shape

end module camroller_film
