!> Remarks on heat that a case leaves out: oil that friction would warm in the bearings of the camshaft, between roller and pin, or
!> in the inlets of contacts, by so much that films and friction are other ones.
!>
!> In: a solved case, its summary, mean torques and films of its bearings. Out: remarks, one line of each kind. They are estimates
!> of what `&bearing_heat` and `&heat` compute, from one bearing and one contact for all.
module camroller_heat_remarks
   use camroller_kinds, only : wp, two_pi
   use camroller_bearing_heat, only : bearing_heat_t, flow_covers_width, oil_flow, temperature_rise
   use camroller_catalogue, only : lobe_prefix
   use camroller_error, only : error_t
   use camroller_journal, only : film_at, film_friction, find_tangent, journal_solved, journal_t, journal_without_film, &
      & with_shear
   use camroller_heat, only : heat_t, inlet_factor, inlet_murch_wilson
   use camroller_lubricant, only : density_at, get_oil, law_direct, oil_t, temperature_law_names
   use camroller_number_text, only : number_text
   use camroller_pin_film, only : pin_journal
   use camroller_remarks, only : add_remark, cool_bearings, cool_inlet, cool_pin
   use camroller_result, only : find_quantity, result_t
   use camroller_sampled_extremes, only : samples_t
   use camroller_shaft, only : bearing_number, solved_t
   implicit none
   private

   public :: judge_heat

   !> Part of the film, or of the friction of bearings, that is left with heat, from which on a remark is worth its line: film
   !> laws differ by no more from each other [-]
   real(wp), parameter :: worth_a_word = 0.7_wp
   !> Rise of the temperature over which the viscosity's fall is taken [K]
   real(wp), parameter :: fall_step = 5.0_wp

contains

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

      ! Parts of a turn that the angles stand for, mean eccentricity of each camshaft [-]
      real(wp) :: parts(films%count), eccentricities(size(torques))
      ! Rise with the viscosity at the temperature of the supply, that with its own [K]; friction over that of the supply's [-]
      real(wp) :: rises(size(torques)), rise, part
      integer :: n, k

      associate (bearings => solved%shaft%bearings, shaft => solved%shaft, case => solved%case)
         n = films%count
         if (n < 2 .or. .not. flow_covers_width(bearings%law, bearings%width, bearings%diameter)) return
         parts = modulo(cshift(films%angle(:n), 1) - cshift(films%angle(:n), -1), two_pi)/(2.0_wp*two_pi)
         associate (number => bearing_number(shaft))
            do k = 1, size(torques)
               eccentricities(k) = 1.0_wp - sum(matmul(films%values((k - 1)*number + 1:k*number, :n), parts)) &
                  & /(number*bearings%radial_clearance)
               rises(k) = temperature_rise(bearing_heat_t(), density_at(case%lubricant, case%operating_point%oil_temperature), &
                  & torques(k)*abs(shaft%speed), number*oil_flow(shaft%journal, shaft%speed, eccentricities(k)))
            end do
         end associate
         call warm_bearing(solved, shaft%journal, eccentricities(maxloc(rises, 1)), maxval(rises), rise, part)
         if (part > worth_a_word) return
         call add_remark(result%remarks, cool_bearings, "the oil in the bearings of the camshaft is taken at the temperature "// &
            & "of the supply; friction would warm it by about "//number_text(rise, 2)//" K, and that of "// &
            & "the film be about "//number_text(part, 2)//" of what it is; &bearing_heat computes it", 1.0_wp/part)
      end associate
   end subroutine judge_bearing_oil

   !> Oil between a roller and its plain pin, of the lobe shape where it would warm the most: by mean torque, spin and eccentricity,
   !> as for bearings of the camshaft.
   subroutine judge_pins(solved, result)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Gets the remark; has its summary
      type(result_t), intent(inout) :: result

      type(journal_t) :: journal
      ! Mean torque [N m], spin [rad/s] and eccentricity [-]; rise with the viscosity of the oil around, with its own, the largest
      ! [K]; friction over that with the oil around, that of the largest rise [-]
      real(wp) :: torque, spin, eccentricity, cold, rise, largest, part, left
      integer :: lobe

      largest = 0.0_wp
      left = 1.0_wp
      associate (case => solved%case, pin => solved%case%needle_bearing%film)
         if (.not. flow_covers_width(pin%law, pin%width, 2.0_wp*solved%models(1)%bearing%radius)) return
         do lobe = 1, size(solved%models)
            torque = mean_of("torque_needle")
            spin = mean_of("roller_spin")
            eccentricity = mean_of("pin_eccentricity")
            journal = pin_journal(solved%models(lobe)%bearing%film, spin)
            cold = temperature_rise(bearing_heat_t(), density_at(case%lubricant, case%operating_point%oil_temperature), &
               & torque*case%operating_point%speed, oil_flow(journal, spin, eccentricity))
            call warm_bearing(solved, journal, eccentricity, cold, rise, part)
            if (rise <= largest) cycle
            largest = rise
            left = part
         end do
      end associate
      if (left > worth_a_word) return
      call add_remark(result%remarks, cool_pin, "the oil between roller and pin is taken as cold as the oil around; friction "// &
         & "would warm it by about "//number_text(largest, 2)//" K, and that of the film be about "//number_text(left, 2)// &
         & " of what it is; no group computes it, and the pin's friction stated is too large", 1.0_wp/left)

   contains

      !> Mean of a quantity of the lobe shape; zero where there is none.
      function mean_of(name) result(mean)
         !> Its name
         character(len=*), intent(in) :: name
         !> The mean [unit of the quantity]
         real(wp) :: mean

         integer :: place

         mean = 0.0_wp
         place = find_quantity(result%summary, "mean_"//trim(lobe_prefix(lobe))//name)
         if (place > 0) mean = result%summary_values(place)
      end function mean_of

   end subroutine judge_pins

   !> Temperature at which the oil carries the friction of a bearing off, by bisection.
   subroutine warm_bearing(solved, cold_journal, eccentricity, cold, rise, part)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The bearing with the oil of the supply
      type(journal_t), intent(in) :: cold_journal
      !> Its eccentricity [-]; rise of the temperature with friction and flow there [K]
      real(wp), intent(in) :: eccentricity, cold
      !> Rise that goes with friction and flow at its temperature [K]
      real(wp), intent(out) :: rise
      !> Friction there over that with the oil of the supply [-]
      real(wp), intent(out) :: part

      ! No oil is so much warmer than its supply, a rise below the least changes nothing worth a word, and one beyond the farthest,
      ! where no oil leaves, is as good as that [K]; steps, of which each halves what may be off: to 0.2 K
      real(wp), parameter :: largest = 200.0_wp, least = 2.0_wp, farthest = 1.0e6_wp
      integer, parameter :: steps = 10
      type(oil_t) :: oil
      type(journal_t) :: journal
      type(error_t), allocatable :: error
      ! Bounds of the rise [K]; e/sqrt(1 - e^2) [-]; load, friction with the oil of the supply [N]; flow over that with it [-]
      real(wp) :: low, high, t, load, friction, flow
      integer :: i, status

      rise = 0.0_wp
      part = 1.0_wp
      if (cold < least .or. .not. (eccentricity > 0.0_wp .and. eccentricity < 1.0_wp)) return
      associate (case => solved%case)
         t = eccentricity/sqrt((1.0_wp - eccentricity)*(1.0_wp + eccentricity))
         associate (film => film_at(cold_journal, t))
            load = cold_journal%unit_load*film%number
         end associate
         friction = film_friction(cold_journal, load, t)
         low = 0.0_wp
         high = min(cold, largest)
         do i = 1, steps
            rise = 0.5_wp*(low + high)
            call get_oil(case%lubricant, case%operating_point%oil_temperature + rise, oil, error)
            status = journal_without_film
            if (.not. allocated(error)) then
               journal = with_shear(cold_journal, oil%viscosity/solved%models(1)%oil%viscosity)
               call find_tangent(journal, load, t, status)
            end if
            ! Hotter than laws of the oil or the bearing go
            if (status /= journal_solved) then
               high = rise
               cycle
            end if
            part = film_friction(journal, load, t)/friction
            flow = t/sqrt(1.0_wp + t**2)/eccentricity
            if (rise*flow < min(cold, farthest)*part) low = rise
            if (rise*flow >= min(cold, farthest)*part) high = rise
         end do
      end associate
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
