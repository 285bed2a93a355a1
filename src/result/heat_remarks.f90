!> Remarks on temperatures of the oil far from those at which its laws are given; on heat that a case leaves out: oil that friction
!> would warm in the bearings of the camshaft, between roller and pin, or in the inlets of contacts, by so much that films and
!> friction are other ones; on metal of bearings that is taken to pass none on.
!>
!> In: a solved case, its summary, mean torques and films of its bearings. Out: remarks, one line of each kind. They are estimates
!> of what `&bearing_heat` and `&heat` compute, from one bearing and one contact for all. The metal of a bearing takes what it
!> passes on at the least (`heat_by_housing`), and the oil the rest, or takes all that the film conducts into it.
module camroller_heat_remarks
   use camroller_kinds, only : wp, two_pi
   use camroller_bearing_heat, only : bearing_heat_t, flow_covers_width, heat_by_film, heat_by_housing, heat_by_oil, oil_flow
   use camroller_bearing_remarks, only : name_bearing
   use camroller_case, only : case_t
   use camroller_catalogue, only : lobe_prefix
   use camroller_error, only : error_t
   use camroller_journal, only : film_at, film_friction, find_tangent, journal_solved, journal_t, journal_without_film, &
      & with_shear
   use camroller_heat, only : heat_t, inlet_factor, inlet_murch_wilson
   use camroller_lubricant, only : density_at, get_oil, law_direct, oil_t, temperature_law_names
   use camroller_number_text, only : number_text
   use camroller_oil_checks, only : find_far_points, find_far_table, judge_estimate, rises_t
   use camroller_pin_film, only : pin_journal
   use camroller_remarks, only : add_remark, cold_estimate, cool_bearings, cool_inlet, cool_pin, far_table, far_temperature, &
      & insulated_metal, remark_t, rubbing_pin
   use camroller_result, only : find_quantity, result_t
   use camroller_sampled_extremes, only : samples_t
   use camroller_shaft, only : bearing_number, solved_t
   implicit none
   private

   public :: judge_heat, judge_oil

   !> Part of the film, or of the friction of bearings, that is left with heat, from which on a remark is worth its line: film
   !> laws differ by no more from each other [-]
   real(wp), parameter :: worth_a_word = 0.7_wp
   !> Part of the heat that is left to the oil by metal which passes on the least, from which down the metal decides how warm a
   !> bearing is, and not its oil: it takes more than the oil [-]
   real(wp), parameter :: enough_oil = 0.5_wp
   !> Rise of the temperature over which the viscosity's fall is taken [K]
   real(wp), parameter :: fall_step = 5.0_wp

contains

   !> Remarks on a temperature of oil or surfaces far from all at which their laws are given, or beyond what they are estimated for.
   subroutine judge_oil(case, temperature, rises, remarks)
      !> The case
      type(case_t), intent(in) :: case
      !> Temperature of its oil [K]
      real(wp), intent(in) :: temperature
      !> Rises above it
      type(rises_t), intent(in) :: rises
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      real(wp) :: distance ! way beyond the points [K]
      character(len=:), allocatable :: words

      call find_far_points(case, temperature, rises, distance, words)
      if (distance > 0.0_wp) call add_remark(remarks, far_temperature, words, distance)
      call find_far_table(case, temperature, rises%surface, distance, words)
      if (distance > 0.0_wp) call add_remark(remarks, far_table, words, distance)
      call judge_estimate(case, temperature, distance, words)
      if (distance > 0.0_wp) call add_remark(remarks, cold_estimate, words, distance)
   end subroutine judge_oil

   !> Remarks on heat that a case leaves out.
   subroutine judge_heat(solved, films, torques, result)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Smallest film of each bearing of each camshaft at the angles of the means, in order round a turn; empty without bearings
      !> [m]
      type(samples_t), intent(in) :: films
      !> Mean torque of the bearings of each camshaft [N m]
      real(wp), intent(in) :: torques(:)
      !> Gets the remarks; has its summary
      type(result_t), intent(inout) :: result

      if (solved%case%lubricant%temperature_law == temperature_law_names(law_direct)) return
      if (allocated(solved%shaft%bearings) .and. .not. allocated(solved%case%bearing_heat)) call judge_bearing_oil(solved, films, &
         & torques, result)
      if (allocated(solved%shaft%rises) .and. allocated(solved%case%bearing_heat)) call judge_metal(solved, films, result)
      if (allocated(solved%models(1)%bearing)) then
         if (allocated(solved%models(1)%bearing%film)) call judge_pins(solved, result)
      end if
      if (.not. allocated(solved%case%heat)) call judge_inlets(solved, result)
   end subroutine judge_heat

   !> Oil of the bearings of the camshaft whose oil would warm the most: all its bearings together, by their mean torque and their
   !> flow at the mean of their eccentricities. How friction and flow change as the oil thins is that of a bearing with this
   !> eccentricity under a constant load.
   subroutine judge_bearing_oil(solved, films, torques, result)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> As of `judge_heat` [m]
      type(samples_t), intent(in) :: films
      !> As of `judge_heat` [N m]
      real(wp), intent(in) :: torques(:)
      !> Gets the remark
      type(result_t), intent(inout) :: result

      character(len=*), parameter :: metals(2) = [character(len=31) :: "for metal as cold as the supply", &
         & "beside a housing in still air"]
      ! Mean eccentricity of each bearing of each camshaft [-]
      real(wp) :: each(bearing_number(solved%shaft), size(torques))
      ! Rise [K]; part of the heat that the oil carries away, friction over that with the oil of the supply; those of the bearings
      ! that warm the most [-]
      real(wp) :: rise, share, part, largest, share_there, smallest
      integer :: k

      smallest = worth_a_word
      associate (bearings => solved%shaft%bearings, shaft => solved%shaft)
         if (films%count < 2 .or. .not. flow_covers_width(bearings%law, bearings%width, bearings%diameter)) return
         each = mean_eccentricities(films, bearings%radial_clearance, size(torques))
         do k = 1, size(torques)
            call expect_warming(solved, shaft%journal, shaft%speed, sum(each(:, k))/size(each, 1), &
               & torques(k)*abs(shaft%speed)/size(each, 1), rise, share, part)
            if (part >= smallest) cycle
            smallest = part
            largest = rise
            share_there = share
         end do
         if (.not. smallest < worth_a_word) return
         call add_remark(result%remarks, cool_bearings, "the oil in the bearings of the camshaft is taken at the temperature "// &
            & "of the supply; friction would warm it by about "//number_text(largest, 2)//" K, and that of "// &
            & "the film be about "//number_text(smallest, 2)//" of what it is; &bearing_heat with oil_share = "// &
            & number_text(share_there, 2)//" computes it "//trim(metals(merge(1, 2, share_there < enough_oil))), 1.0_wp/smallest)
      end associate
   end subroutine judge_bearing_oil

   !> Mean eccentricity over the turn of each bearing of each camshaft.
   pure function mean_eccentricities(films, clearance, camshafts) result(means)
      !> As of `judge_heat` [m]
      type(samples_t), intent(in) :: films
      !> Radial clearance [m]
      real(wp), intent(in) :: clearance
      !> Number of camshafts
      integer, intent(in) :: camshafts
      !> The means, shape (bearing, camshaft) [-]
      real(wp) :: means(size(films%values, 1)/camshafts, camshafts)

      real(wp) :: parts(films%count) ! of a turn that the angles stand for [-]

      associate (n => films%count)
         parts = modulo(cshift(films%angle(:n), 1) - cshift(films%angle(:n), -1), two_pi)/(2.0_wp*two_pi)
         means = 1.0_wp - reshape(matmul(films%values(:, :n), parts), shape(means))/clearance
      end associate
   end function mean_eccentricities

   !> Rise of the temperature that friction would make in a bearing. Its metal passes on what it does at the least; where this is
   !> more than the oil carries away, the metal decides, and is taken as cold as the oil supplied: the bearing is no colder then.
   subroutine expect_warming(solved, journal, speed, eccentricity, power, rise, share, part)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The bearing with the oil of the supply
      type(journal_t), intent(in) :: journal
      !> Its speed [rad/s]; eccentricity [-] and mean power of friction [W] with that oil
      real(wp), intent(in) :: speed, eccentricity, power
      !> The rise [K]; part of the heat that the oil carries away, friction over that with the oil of the supply [-]
      real(wp), intent(out) :: rise, share, part

      real(wp) :: by_metal(2) ! [W/K]
      integer :: i

      associate (case => solved%case)
         by_metal = [heat_by_housing(journal), heat_by_film(journal, oil_conductivity(case))]
         associate (by_oil => heat_by_oil(bearing_heat_t(), density_at(case%lubricant, case%operating_point%oil_temperature), &
               & oil_flow(journal, speed, eccentricity)))
            do i = 1, size(by_metal)
               call warm_bearing(solved, journal, 0.0_wp, eccentricity, power, by_oil, by_metal(i), rise, share, part)
               if (share >= enough_oil) exit
            end do
         end associate
      end associate
   end subroutine expect_warming

   !> Thermal conductivity of the oil: that of the case, or a usual one.
   pure function oil_conductivity(case) result(conductivity)
      type(case_t), intent(in) :: case
      !> The conductivity [W/(m K)]
      real(wp) :: conductivity

      type(heat_t) :: heat

      if (allocated(case%heat)) heat = case%heat
      conductivity = heat%oil_conductivity
   end function oil_conductivity

   !> Bearings of the camshaft whose heat goes into the oil, by `oil_share`, where metal cannot but take most of it: the one whose
   !> friction grows the most with the part that a housing in still air takes.
   subroutine judge_metal(solved, films, result)
      !> The solved case, with temperatures of its bearings
      type(solved_t), intent(in) :: solved
      !> As of `judge_heat` [m]
      type(samples_t), intent(in) :: films
      !> Gets the remark
      type(result_t), intent(inout) :: result

      real(wp) :: each(size(solved%shaft%rises, 1), size(solved%shaft%rises, 2)) ! mean eccentricities [-]
      ! Friction over that with the metal's least part, the smallest of all bearings; of a housing in still air and of metal as cold
      ! as the supply: what it takes [W/K], rise [K], part of the heat left to the oil, friction over that of the case [-], those of
      ! the bearing told of; conduction by the film over what the oil carries, there [-]
      real(wp) :: smallest, times
      real(wp), dimension(2) :: by_metal, rises, left, parts, left_there
      integer :: bearing, i, k, place(2)
      character(len=:), allocatable :: name

      smallest = worth_a_word
      times = 0.0_wp
      associate (case => solved%case, shaft => solved%shaft, heat => solved%case%bearing_heat)
         if (films%count < 2) return
         each = mean_eccentricities(films, shaft%bearings%radial_clearance, size(each, 2))
         do k = 1, size(each, 2)
            do bearing = 1, size(each, 1)
               associate (journal => shaft%warm(bearing, k), rise => shaft%rises(bearing, k), &
                     & carried => max(tiny(1.0_wp), heat_by_oil(heat, density_at(case%lubricant, &
                     & case%operating_point%oil_temperature), oil_flow(shaft%journal, shaft%speed, each(bearing, k)))))
                  by_metal = [heat_by_housing(journal), heat_by_film(journal, oil_conductivity(case))]
                  if (carried > enough_oil*heat%oil_share*(carried + by_metal(1))) cycle
                  do i = 1, 2
                     call warm_bearing(solved, journal, rise, each(bearing, k), rise*carried/heat%oil_share, carried, &
                        & by_metal(i), rises(i), left(i), parts(i))
                  end do
                  if (parts(1)*smallest <= 1.0_wp) cycle
                  smallest = 1.0_wp/parts(1)
                  left_there = left
                  times = by_metal(2)/carried
                  place = [bearing, k]
               end associate
            end do
         end do
         if (.not. times > 0.0_wp) return
         call name_bearing(place(1), place(2), size(each, 2), name)
         call add_remark(result%remarks, insulated_metal, "with bearing_heat.oil_share = "//number_text(heat%oil_share, 3)// &
            & " the oil of "//name//" is "//number_text(shaft%rises(place(1), place(2)), 3)//" K warmer than the supply; "// &
            & "its film conducts "//number_text(times, 2)//" times as much heat into the metal as the oil carries away: "// &
            & "beside a housing in still air the oil has "//number_text(left_there(1), 2)//" of the heat left, beside metal "// &
            & "as cold as the supply "//number_text(left_there(2), 2)//"; an oil_share between these is right, and friction "// &
            & "larger", 1.0_wp/smallest)
      end associate
   end subroutine judge_metal

   !> Viscosity of the oil at a rise of its temperature above that of the supply; that of the supply where the oil has none there.
   function viscosity_at(solved, rise) result(viscosity)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The rise [K]
      real(wp), intent(in) :: rise
      !> The viscosity [Pa s]
      real(wp) :: viscosity

      type(oil_t) :: oil
      type(error_t), allocatable :: error

      call get_oil(solved%case%lubricant, solved%case%operating_point%oil_temperature + rise, oil, error)
      viscosity = solved%models(1)%oil%viscosity
      if (.not. allocated(error)) viscosity = oil%viscosity
   end function viscosity_at

   !> Oil between a roller and its plain pin, of the lobe shape where it would warm the most: by mean torque, spin and eccentricity,
   !> as for bearings of the camshaft.
   subroutine judge_pins(solved, result)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Gets the remark; has its summary
      type(result_t), intent(inout) :: result

      type(journal_t) :: journal
      ! Mean spin [rad/s] and eccentricity [-]; rise, the largest [K]; part of the heat that the oil carries away, friction over
      ! that with the oil around, that of the largest rise [-]
      real(wp) :: spin, eccentricity, rise, largest, share, part, left
      character(len=:), allocatable :: verdict
      integer :: lobe

      largest = 0.0_wp
      left = 1.0_wp
      associate (case => solved%case, pin => solved%case%needle_bearing%film)
         if (.not. flow_covers_width(pin%law, pin%width, 2.0_wp*solved%models(1)%bearing%radius)) return
         do lobe = 1, size(solved%models)
            spin = mean_of("roller_spin")
            eccentricity = mean_of("pin_eccentricity")
            journal = pin_journal(solved%models(lobe)%bearing%film, spin)
            call expect_warming(solved, journal, spin, eccentricity, mean_of("torque_needle")*case%operating_point%speed, rise, &
               & share, part)
            if (rise <= largest) cycle
            largest = rise
            left = part
         end do
      end associate
      if (left > worth_a_word) return
      ! What warm oil takes off the film's friction, asperities add where its film is too thin already
      verdict = "the pin's friction stated is too large"
      if (any(result%remarks%kind == rubbing_pin)) verdict = "the thinnest films of the pin are still thinner"
      call add_remark(result%remarks, cool_pin, "the oil between roller and pin is taken as cold as the oil around; friction "// &
         & "would warm it by about "//number_text(largest, 2)//" K, and that of the film be about "//number_text(left, 2)// &
         & " of what it is; no group computes it, and "//verdict, 1.0_wp/left)

   contains

      !> Mean of a quantity of the lobe shape; zero where there is none.
      function mean_of(name) result(mean)
         character(len=*), intent(in) :: name
         !> The mean [unit of the quantity]
         real(wp) :: mean

         integer :: place

         mean = 0.0_wp
         place = find_quantity(result%summary, "mean_"//trim(lobe_prefix(lobe))//name)
         if (place > 0) mean = result%summary_values(place)
      end function mean_of

   end subroutine judge_pins

   !> Temperature at which oil and metal carry the friction of a bearing off, by bisection, from a state of the bearing: that with
   !> the oil of the supply, or one that is too warm.
   subroutine warm_bearing(solved, journal, start, eccentricity, power, by_oil, by_metal, rise, share, part)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The bearing as it is
      type(journal_t), intent(in) :: journal
      !> Rise of its temperature above that of the supply [K], its eccentricity [-], mean power of its friction [W]
      real(wp), intent(in) :: start, eccentricity, power
      !> Heat that its oil carries away, and that its metal takes [W/K]
      real(wp), intent(in) :: by_oil, by_metal
      !> Rise that goes with friction and flow at its temperature [K]
      real(wp), intent(out) :: rise
      !> Part of the heat that the oil carries away there, friction over that of the bearing as it is [-]
      real(wp), intent(out) :: share, part

      ! No oil is so much warmer than its supply, and a rise below the least changes nothing worth a word [K]; steps, of which each
      ! halves what may be off: to 0.2 K
      real(wp), parameter :: largest = 200.0_wp, least = 2.0_wp
      integer, parameter :: steps = 10
      type(oil_t) :: oil
      type(journal_t) :: other
      type(error_t), allocatable :: error
      ! Bounds of the rise [K]; e/sqrt(1 - e^2) [-]; load, friction of the bearing as it is [N]; its viscosity [Pa s]; heat that the
      ! oil carries away for each kelvin [W/K]
      real(wp) :: low, high, t, load, friction, viscosity, carried
      integer :: i, status

      rise = start
      part = 1.0_wp
      share = by_oil/(by_oil + by_metal)
      high = power/(by_oil + by_metal)
      if (start > 0.0_wp) high = start
      if (high < least .or. .not. (eccentricity > 0.0_wp .and. eccentricity < 1.0_wp)) return
      t = eccentricity/sqrt((1.0_wp - eccentricity)*(1.0_wp + eccentricity))
      associate (film => film_at(journal, t))
         load = journal%unit_load*film%number
      end associate
      friction = film_friction(journal, load, t)
      viscosity = viscosity_at(solved, start)
      low = 0.0_wp
      high = min(high, largest)
      carried = by_oil
      do i = 1, steps
         rise = 0.5_wp*(low + high)
         call get_oil(solved%case%lubricant, solved%case%operating_point%oil_temperature + rise, oil, error)
         status = journal_without_film
         if (.not. allocated(error)) then
            other = with_shear(journal, oil%viscosity/viscosity)
            call find_tangent(other, load, t, status)
         end if
         ! Hotter than laws of the oil or the bearing go
         if (status /= journal_solved) then
            high = rise
            cycle
         end if
         part = film_friction(other, load, t)/friction
         carried = by_oil*t/sqrt(1.0_wp + t**2)/eccentricity
         if (rise*(carried + by_metal) < power*part) low = rise
         if (rise*(carried + by_metal) >= power*part) high = rise
      end do
      share = carried/(carried + by_metal)
   end subroutine warm_bearing

   !> Films of the lobe shape whose inlet would be heated the most: by the factor of Murch and Wilson (1975) for pure rolling at the
   !> largest speed of entrainment.
   subroutine judge_inlets(solved, result)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Gets the remark; has its summary
      type(result_t), intent(inout) :: result

      type(oil_t) :: oil
      type(error_t), allocatable :: error
      type(heat_t) :: usual
      ! Speed of entrainment [m/s]; fall of ln(viscosity) [1/K]; ln of the factor [-], its slopes, not used
      real(wp) :: speed, fall, log_factor, slopes(3)
      integer :: lobe, place

      associate (case => solved%case, model => solved%models(1))
         call get_oil(case%lubricant, case%operating_point%oil_temperature + fall_step, oil, error)
         if (allocated(error)) return
         fall = log(model%oil%viscosity/oil%viscosity)/fall_step
         speed = 0.0_wp
         do lobe = 1, size(solved%models)
            place = find_quantity(result%summary, "max_"//trim(lobe_prefix(lobe))//"entrainment_speed")
            if (place > 0) speed = max(speed, result%summary_values(place))
         end do
         call inlet_factor(inlet_murch_wilson, fall*model%oil%viscosity/usual%oil_conductivity, speed, 0.0_wp, 0.0_wp, log_factor, &
            & slopes(1), slopes(2), slopes(3))
         if (log_factor > log(worth_a_word)) return
         call add_remark(result%remarks, cool_inlet, "films are those of oil as cold as around them; its heating in the inlet "// &
            & "would leave about "//number_text(exp(log_factor), 2)//" of the film at the largest speed of entrainment, "// &
            & number_text(speed, 3)//" m/s; &heat computes it", exp(-log_factor))
      end associate
   end subroutine judge_inlets

end module camroller_heat_remarks
