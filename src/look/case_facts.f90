!> What a person wants to know of a case before many of them are run: oil, roughness, cam, event, margins, loads, film.
!>
!> In: a case. Out: lines of text.
module camroller_case_facts
   use camroller_kinds, only : wp, degree, two_pi, celsius_zero, per_minute
   use camroller_engine, only : write_speed
   use camroller_flexible_setup, only : seat_sink
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_journal_range, only : compare_width
   use camroller_kinematics, only : position_t
   use camroller_lift, only : lift_t
   use camroller_lift_noise, only : find_lift_noise, lift_noise_t
   use camroller_oil_checks, only : compare_hths
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_number_text, only : number_text, fixed_text
   use camroller_result, only : find_quantity, get_summary, result_t, severest
   use camroller_run, only : build_models, run_case
   implicit none
   private

   public :: describe_case, quick_case

   !> Step of the cam angle in which geometry is looked at [rad]
   real(wp), parameter :: step = 0.25_wp*degree
   !> Lift up to which an event is on its ramp [m]
   real(wp), parameter :: ramp_height = 1.0e-4_wp
   !> Digits of numbers
   integer, parameter :: digits = 3

   !> Shape of one lobe
   type :: shape_t
      !> Smallest radius of curvature of the convex parts of the cam [m] and its cam angle, nose at 180 [deg]
      real(wp) :: smallest_radius = huge(1.0_wp), radius_angle = 0.0_wp
      !> Smallest radius of its hollow parts, zero where there are none [m]
      real(wp) :: hollow_radius = 0.0_wp
      !> Largest pressure angle [rad] and its cam angle [deg]
      real(wp) :: pressure_angle = 0.0_wp, pressure_angle_angle = 0.0_wp
      !> First and last cam angle with lift [deg]
      real(wp) :: first = 360.0_wp, last = 0.0_wp
      !> Largest slope of the lift on the ramps, opening and closing, and anywhere [m/rad]
      real(wp) :: ramp_slopes(2) = 0.0_wp, largest_slope = 0.0_wp
      !> Smallest and largest second derivative of the lift [m/rad^2]
      real(wp) :: smallest_curvature = 0.0_wp, largest_curvature = 0.0_wp
      !> Largest lift [m]
      real(wp) :: largest_lift = 0.0_wp
   end type shape_t

contains

   !> Shape of the cam of a model, looked at a quarter of a degree apart.
   subroutine get_shape(model, shape)
      !> The model
      type(model_t), intent(in) :: model
      !> The shape
      type(shape_t), intent(out) :: shape

      type(position_t) :: position
      ! Cam angle from full lift [rad], and with the nose at 180 [deg]; curvature of the cam [1/m]; pressure angle [rad]
      real(wp) :: angle, shown, curvature, pressure_angle
      integer :: i, status

      do i = 0, nint(two_pi/step) - 1
         angle = i*step - 0.5_wp*two_pi
         shown = 180.0_wp + angle/degree
         call evaluate_geometry(model, angle, position, status)
         if (status /= 0) cycle
         curvature = 1.0_wp/position%equivalent_radius - 1.0_wp/model%linkage%roller_radius
         if (curvature > 1.0_wp/shape%smallest_radius) then
            shape%smallest_radius = 1.0_wp/curvature
            shape%radius_angle = shown
         else if (curvature < 0.0_wp .and. (-1.0_wp/curvature < shape%hollow_radius .or. shape%hollow_radius <= 0.0_wp)) then
            shape%hollow_radius = -1.0_wp/curvature
         end if
         pressure_angle = acos(min(1.0_wp, abs(position%normal_arm)/model%linkage%a))
         if (pressure_angle > shape%pressure_angle) then
            shape%pressure_angle = pressure_angle
            shape%pressure_angle_angle = shown
         end if
         if (position%lift <= 0.0_wp) cycle
         shape%first = min(shape%first, shown)
         shape%last = max(shape%last, shown)
         shape%largest_lift = max(shape%largest_lift, position%lift)
         shape%largest_slope = max(shape%largest_slope, abs(position%lift_slope))
         shape%smallest_curvature = min(shape%smallest_curvature, position%lift_curvature)
         shape%largest_curvature = max(shape%largest_curvature, position%lift_curvature)
         if (position%lift > ramp_height) cycle
         associate (ramp => shape%ramp_slopes(merge(1, 2, angle < 0.0_wp)))
            ramp = max(ramp, abs(position%lift_slope))
         end associate
      end do
   end subroutine get_shape

   !> A case in words: what follows from the deck at once, and what one run of it says.
   subroutine describe_case(case, text, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Lines
      character(len=:), allocatable, intent(out) :: text
      !> Deck or domain error of the case's models; a run that fails is told among the lines
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable :: models(:)
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: lobe

      text = ""
      call build_models(case, models, error)
      if (allocated(error)) return
      call describe_oil(case, models(1), text)
      do lobe = 1, size(models)
         if (lobe == 1) call describe_table(case%lift, text)
         if (lobe == 2) call describe_table(case%second_lift, text)
         call describe_cam(models(lobe), trim(merge("second lobe:", "lobe:       ", lobe == 2)), text)
      end do
      call run_case(quick_case(case), result, failure)
      if (allocated(failure)) then
         text = text//"run: "//failure%message//new_line("a")
         return
      end if
      do lobe = 1, size(models)
         call describe_results(result, models(lobe), trim(merge("lobe_2_", "       ", lobe == 2)), &
            & trim(merge("second lobe:", "lobe:       ", lobe == 2)), text)
      end do
   end subroutine describe_case

   !> A case to be run at once: a flexible train, whose turns are not integrated again for the accuracy of a deck, with a tolerance
   !> that is enough for three digits.
   function quick_case(case) result(quick)
      !> The case
      type(case_t), intent(in) :: case
      !> The same with that tolerance, unless its own is given
      type(case_t) :: quick

      ! The tolerance [-]
      real(wp), parameter :: quick_tolerance = 1.0e-3_wp

      quick = case
      if (allocated(case%dynamics) .and. .not. case%numerics%tolerance > 0.0_wp) quick%numerics%tolerance = quick_tolerance
   end function quick_case

   !> Oil and surfaces.
   subroutine describe_oil(case, model, text)
      !> The case
      type(case_t), intent(in) :: case
      !> Its first model
      type(model_t), intent(in) :: model
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      character(len=*), parameter :: n = new_line("a")
      character(len=:), allocatable :: speed, words
      ! By which factor bearings are too wide or too narrow for their law [-]
      real(wp) :: excess

      text = text//"oil at "//number_text(case%operating_point%oil_temperature - celsius_zero, 4)//" degC: "// &
         & number_text(1.0e3_wp*model%oil%viscosity, digits)//" mPa s, pressure-viscosity coefficient "// &
         & number_text(1.0e9_wp*model%oil%pressure_viscosity, digits)//" 1/GPa"
      if (model%oil%is_estimated) text = text//" (estimated by So and Klaus 1980, since the deck gives none)"
      call describe_hths(case, text)
      text = text//n//"composite roughness: "//number_text(1.0e6_wp*model%roughness, digits)//" um; cam speed "// &
         & number_text(case%operating_point%speed*per_minute, 4)//" rev/min"
      if (allocated(case%engine)) then
         call write_speed(case%operating_point%speed, model%crank_turns, 4, speed)
         text = text//" ("//speed//")"
      end if
      text = text//n
      if (.not. allocated(case%cam_bearings)) return
      text = text//"camshaft bearings: width over diameter "// &
         & number_text(case%cam_bearings%width/case%cam_bearings%diameter, digits)//", law '"//trim(case%cam_bearings%law)//"'"
      call compare_width(case%cam_bearings%law, case%cam_bearings%width, case%cam_bearings%diameter, excess, words)
      if (excess > 0.0_wp) text = text//", which "//words
      text = text//n
   end subroutine describe_oil

   !> What shear takes of the oil's viscosity, which no law of the model knows, where its data sheet says so.
   subroutine describe_hths(case, text)
      !> The case
      type(case_t), intent(in) :: case
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      ! Viscosity at 150 degC without shear [Pa s]; HTHS over it [-]; largest shear rate in the camshaft bearings [1/s]
      real(wp) :: viscosity, ratio, rate

      call compare_hths(case%lubricant, viscosity, ratio)
      if (viscosity <= 0.0_wp) return
      text = text//new_line("a")//"oil at 150 degC: "//number_text(1.0e3_wp*viscosity, digits)//" mPa s without shear, "// &
         & "HTHS is "//number_text(ratio, digits)//" of it; films, guide and bearings have the viscosity without shear"
      if (.not. allocated(case%cam_bearings)) return
      rate = 0.5_wp*case%cam_bearings%diameter*case%operating_point%speed/case%cam_bearings%radial_clearance
      text = text//", which centred camshaft bearings shear at "//number_text(rate, 2)//" 1/s, HTHS at 1e6"
   end subroutine describe_hths

   !> Noise of a lift table and what smoothing does to it.
   subroutine describe_table(lift, text)
      !> The lift
      type(lift_t), intent(in) :: lift
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      type(lift_noise_t) :: noise

      if (lift%law /= "table") return
      call find_lift_noise(lift, noise)
      if (.not. noise%is_known) return
      text = text//"lift table: noise of about "//number_text(1.0e6_wp*noise%noise, 2)//" um, smoothing_um = "// &
         & number_text(1.0e6_wp*lift%smoothing, 3)//"; second derivative"// &
         & trim(merge(" of its values", "              ", allocated(lift%given_lift)))//" "// &
         & number_text(1.0e3_wp*noise%given(1), digits)//" to "//number_text(1.0e3_wp*noise%given(2), digits)// &
         & " mm/rad^2, with smoothing by the noise "//number_text(1.0e3_wp*noise%smoothed(1), digits)//" to "// &
         & number_text(1.0e3_wp*noise%smoothed(2), digits)//" (residual "//number_text(1.0e6_wp*noise%residual, 2)//" um)"// &
         & new_line("a")
   end subroutine describe_table

   !> One lobe.
   subroutine describe_cam(model, name, text)
      !> Its model
      type(model_t), intent(in) :: model
      !> What it is called
      character(len=*), intent(in) :: name
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      character(len=*), parameter :: n = new_line("a")
      type(shape_t) :: shape

      call get_shape(model, shape)
      text = text//name//" event from "//fixed_text(shape%first, 1)//" to "//fixed_text(shape%last, 1)//" deg, lift "// &
         & number_text(1.0e3_wp*shape%largest_lift, 4)//" mm; smallest cam radius "// &
         & number_text(1.0e3_wp*shape%smallest_radius, digits)//" mm at "//fixed_text(shape%radius_angle, 1)//" deg"
      if (shape%hollow_radius > 0.0_wp) text = text//", hollow flanks of "//number_text(1.0e3_wp*shape%hollow_radius, digits)// &
         & " mm"
      text = text//"; largest pressure angle "//fixed_text(shape%pressure_angle/degree, 1)//" deg at "// &
         & fixed_text(shape%pressure_angle_angle, 1)//" deg"//n//name//" ramps below "//number_text(1.0e3_wp*ramp_height)// &
         & " mm of lift up to "//number_text(1.0e6_wp*degree*shape%ramp_slopes(1), digits)//" and "// &
         & number_text(1.0e6_wp*degree*shape%ramp_slopes(2), digits)//" um/deg, "// &
         & number_text(model%speed*shape%ramp_slopes(1), digits)//" and "// &
         & number_text(model%speed*shape%ramp_slopes(2), digits)//" m/s; acceleration "// &
         & number_text(1.0e3_wp*shape%smallest_curvature, digits)//" to "// &
         & number_text(1.0e3_wp*shape%largest_curvature, digits)//" mm/rad^2"//n
   end subroutine describe_cam

   !> What one run says of a lobe.
   subroutine describe_results(result, model, prefix, name, text)
      !> Result of the case
      type(result_t), intent(in) :: result
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Beginning of the names of its scalars
      character(len=*), intent(in) :: prefix
      !> What the lobe is called
      character(len=*), intent(in) :: name
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      ! The one scalar of these that is no smallest value of a series
      character(len=*), parameter :: n = new_line("a"), event_load = "min_event_contact_load"
      ! Of the speeds that are shown [rev/min over rad/s]
      real(wp) :: speed_factor
      character(len=:), allocatable :: unit
      logical :: has_lash, has_profile

      has_profile = find_quantity(result%summary, "max_axial_pressure_max") > 0
      associate (turns => model%crank_turns)
         speed_factor = per_minute*merge(turns, 1.0_wp, turns > 0.0_wp)
         unit = " rev/min of the "//trim(merge("crankshaft", "camshaft  ", turns > 0.0_wp))
      end associate
      call add_value(name//" contact load up to ", "max_contact_load", 1.0_wp)
      call add_value(" N, pressure up to ", "max_"//trim(severest("hertz_pressure", has_profile)), 1.0e-9_wp)
      call add_value(" GPa, film ratio ", "min_film_ratio", 1.0_wp)
      call add_value(" to ", "max_film_ratio", 1.0_wp)
      call add_value(n//name//" smallest load of the event ", "margin_event", 1.0_wp)
      has_lash = .false.
      if (allocated(model%flexible)) has_lash = model%flexible%lash > 0.0_wp
      if (has_lash) then
         call add_value(" N, contact is lost in it above ", "margin_event_speed", speed_factor)
      else
         call add_value(" N, on the base circle ", "margin_base_circle", 1.0_wp)
         call add_value(" N; contact is lost above ", "contact_loss_speed", speed_factor)
      end if
      text = text//unit//", all without friction"
      if (find_quantity(result%summary, prefix//event_load) > 0) then
         call add_value("; smallest load of the event with friction ", event_load, 1.0_wp)
         text = text//" N"
      end if
      text = text//n
      if (has_lash) call describe_lash(model, name, text)
      if (find_quantity(result%summary, prefix//"train_frequency") == 0) return
      call add_value(name//" pivot's joint unloads above ", "margin_pivot_speed", speed_factor)
      if (.not. has_lash) call add_value(unit//", a lash adjuster pumps up above ", "pump_up_speed", speed_factor)
      call add_value(unit//"; natural frequency of the train ", "train_frequency", 1.0_wp)
      call add_value(" Hz, load of a train that vibrates over a rigid one's ", "load_factor", 1.0_wp)
      if (has_lash) text = text//" without the impact that takes up the lash"
      if (find_quantity(result%summary, prefix//"surge_estimate_1") > 0) then
         call add_value(", surge of the spring in its first mode ", "surge_estimate_1", 1.0_wp)
         text = text//" N"
      end if
      text = text//n

   contains

      !> Add words and a scalar.
      subroutine add_value(introduction, scalar, factor)
         !> The words, and the scalar's name without the lobe's prefix
         character(len=*), intent(in) :: introduction, scalar
         !> What it is multiplied with [unit/SI unit]
         real(wp), intent(in) :: factor

         type(error_t), allocatable :: error
         ! [SI unit]
         real(wp) :: value
         ! Letters before the lobe's prefix
         integer :: place

         place = 0
         if (index(scalar, "max_") == 1 .or. index(scalar, "min_") == 1) place = 4
         if (scalar == event_load) place = 0
         call get_summary(result, scalar(:place)//prefix//scalar(place + 1:), value, error)
         text = text//introduction
         if (allocated(error)) then
            text = text//"?"
         else if (value < huge(value)) then
            text = text//number_text(factor*value, digits)
         else
            text = text//"any number of"
         end if
      end subroutine add_value

   end subroutine describe_results

   !> What is left of the lash of a lobe's train.
   subroutine describe_lash(model, name, text)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> What the lobe is called
      character(len=*), intent(in) :: name
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      ! How far the valve sinks, clearance at rest [m]
      real(wp) :: sink, clearance

      sink = seat_sink(model%flexible, model%train)
      clearance = model%flexible%lash - sink
      text = text//name//" closed valve "//number_text(1.0e3_wp*sink, digits)//" mm in its seat: "
      if (clearance >= 0.0_wp) then
         text = text//"a clearance of "//number_text(1.0e3_wp*clearance, digits)//" mm is left on the base circle"//new_line("a")
      else
         text = text//"nothing is left of the lash, and the spring presses the roller onto the base circle"//new_line("a")
      end if
   end subroutine describe_lash

end module camroller_case_facts
