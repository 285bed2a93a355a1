!> What a person wants to know of a case before many of them are run: oil, roughness, cam, event, margins, loads, film.
!>
!> In: a case. Out: lines of text.
module camroller_case_facts
   use camroller_kinds, only : wp, degree, two_pi, celsius_zero, per_minute
   use camroller_engine, only : write_speed
   use camroller_flexible_setup, only : seat_sink
   use camroller_error, only : error_t
   use camroller_cam_angle, only : file_angle
   use camroller_case, only : case_t
   use camroller_journal_range, only : compare_width
   use camroller_kinematics, only : position_t
   use camroller_lift, only : event_ends, lift_t
   use camroller_lift_noise, only : find_lift_noise, lift_noise_t
   use camroller_oil_checks, only : compare_hths
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_minimum, only : minimum_t, narrow_minimum, start_minimum
   use camroller_number_text, only : number_text, fixed_text
   use camroller_result, only : find_quantity, get_summary, result_t, severest
   use camroller_pivot, only : assumed_inertia
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

   !> What is looked for in a lobe where it is largest: curvature of the cam, curvature of its hollows [1/m]; pressure angle [rad];
   !> second derivative of the lift, up and down [m/rad^2]
   integer, parameter :: of_cam = 1, of_hollow = 2, of_pressure = 3, upwards = 4, downwards = 5, wanted = 5

   !> Shape of one lobe
   type :: shape_t
      !> The largest of what is looked for, and cam angles where it is, nose at 180 [deg]
      real(wp) :: largest(wanted) = 0.0_wp, angle(wanted) = 0.0_wp
      !> Largest slope of the lift on the ramps, opening and closing [m/rad]
      real(wp) :: ramp_slopes(2) = 0.0_wp
      !> Largest lift [m]
      real(wp) :: largest_lift = 0.0_wp
   end type shape_t

contains

   !> Shape of the cam of a model, looked at a quarter of a degree apart, and beside the largest of what is looked for between them.
   subroutine get_shape(model, shape)
      type(model_t), intent(in) :: model
      type(shape_t), intent(out) :: shape

      type(position_t) :: position
      ! Three neighbouring cam angles from full lift, those about what is largest [rad]; what is looked for there [see there]
      real(wp) :: angles(3), about(3, wanted), values(wanted, 3), summits(3, wanted)
      integer :: i, j, n

      n = nint(two_pi/step)
      values = 0.0_wp
      summits = -huge(1.0_wp)
      about = 0.0_wp
      do i = -1, n
         angles = (i + [-2, -1, 0])*step - 0.5_wp*two_pi
         values(:, :2) = values(:, 2:)
         call look(model, angles(3), position, values(:, 3))
         do j = 1, wanted
            if (i < 1) exit
            if (values(j, 2) <= summits(2, j)) cycle
            about(:, j) = angles
            summits(:, j) = values(j, :)
         end do
         if (i < 0 .or. i == n .or. position%lift <= 0.0_wp) cycle
         shape%largest_lift = max(shape%largest_lift, position%lift)
         if (position%lift > ramp_height) cycle
         associate (ramp => shape%ramp_slopes(merge(1, 2, angles(3) < 0.0_wp)))
            ramp = max(ramp, abs(position%lift_slope))
         end associate
      end do
      do j = 1, wanted
         call narrow(model, j, about(:, j), summits(:, j), shape%largest(j), shape%angle(j))
      end do
   end subroutine get_shape

   !> What is looked for in a lobe, at one angle.
   subroutine look(model, angle, position, values)
      !> The model, whose geometry was checked
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The geometry there
      type(position_t), intent(out) :: position
      !> What is looked for [see there]
      real(wp), intent(out) :: values(wanted)

      integer :: status

      call evaluate_geometry(model, angle, position, status)
      values = 0.0_wp
      if (status /= 0) return
      values(of_cam) = 1.0_wp/position%equivalent_radius - 1.0_wp/model%linkage%roller_radius
      values(of_hollow) = -values(of_cam)
      values(of_pressure) = acos(min(1.0_wp, abs(position%normal_arm)/model%linkage%a))
      values(upwards) = position%lift_curvature
      values(downwards) = -values(upwards)
   end subroutine look

   !> Look for the largest value of one of these between the angles about the largest so far.
   subroutine narrow(model, which, angles, values, largest, place)
      type(model_t), intent(in) :: model
      integer, intent(in) :: which
      !> Three cam angles from full lift [rad], and values there, the middle one largest [see there]
      real(wp), intent(in) :: angles(3), values(3)
      !> The largest value [see there], and its cam angle, nose at 180 [deg]
      real(wp), intent(out) :: largest, place

      ! Gain that no digit shows, over the value [-]
      real(wp), parameter :: little = 1.0e-6_wp
      type(minimum_t) :: search
      type(position_t) :: position
      real(wp) :: trial(wanted) ! [see there]

      call start_minimum(search, angles, -values, little*abs(values(2)))
      do while (search%is_wanted)
         call look(model, search%trial, position, trial)
         call narrow_minimum(search, -trial(which))
      end do
      largest = -search%value(2)
      place = file_angle(search%point(2))
   end subroutine narrow

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
      call describe_finger(case, models(1), text)
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

   !> Inertia of the finger, by which limits of contact and joint go, and whether it is that of no finger in particular.
   subroutine describe_finger(case, model, text)
      type(case_t), intent(in) :: case
      !> Its first model
      type(model_t), intent(in) :: model
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      text = text//"finger: inertia about its pivot "//number_text(model%train%finger_inertia, digits)//" kg m2"
      if (.not. abs(model%train%finger_inertia - assumed_inertia(case%masses%finger, case%mechanism%pivot_to_pad)) > 0.0_wp) then
         text = text//", as if all of its mass were at the pad; real ones have less (masses.finger_inertia_kg_m2), which lifts "// &
            & "the speeds at which contact is lost and the joint unloads"
      end if
      if (allocated(model%pivot)) text = text//"; centre of mass "//number_text(1.0e3_wp*model%pivot%centre, digits)// &
         & " mm from it"
      text = text//new_line("a")
   end subroutine describe_finger

   !> Oil and surfaces.
   subroutine describe_oil(case, model, text)
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
         & " mm/rad^2, with smoothing_um = "//number_text(1.0e6_wp*noise%smoothing, 2)//" "// &
         & number_text(1.0e3_wp*noise%smoothed(1), digits)//" to "//number_text(1.0e3_wp*noise%smoothed(2), digits)//new_line("a")
   end subroutine describe_table

   !> One lobe.
   subroutine describe_cam(model, name, text)
      type(model_t), intent(in) :: model
      !> What it is called
      character(len=*), intent(in) :: name
      !> Lines so far
      character(len=:), allocatable, intent(inout) :: text

      character(len=*), parameter :: n = new_line("a")
      type(shape_t) :: shape
      real(wp) :: ends(2) ! [deg]

      call get_shape(model, shape)
      ends = 180.0_wp + event_ends(model%lift_law)/degree
      text = text//name//" event from "//fixed_text(ends(1), 1)//" to "//fixed_text(ends(2), 1)//" deg, lift "// &
         & number_text(1.0e3_wp*shape%largest_lift, 4)//" mm; smallest cam radius "// &
         & number_text(1.0e3_wp/shape%largest(of_cam), digits)//" mm at "//fixed_text(shape%angle(of_cam), 1)//" deg"
      if (shape%largest(of_hollow) > 0.0_wp) text = text//", hollow flanks of "// &
         & number_text(1.0e3_wp/shape%largest(of_hollow), digits)//" mm"
      text = text//"; largest pressure angle "//fixed_text(shape%largest(of_pressure)/degree, 1)//" deg at "// &
         & fixed_text(shape%angle(of_pressure), 1)//" deg"//n//name//" ramps below "//number_text(1.0e3_wp*ramp_height)// &
         & " mm of lift up to "//number_text(1.0e6_wp*degree*shape%ramp_slopes(1), digits)//" and "// &
         & number_text(1.0e6_wp*degree*shape%ramp_slopes(2), digits)//" um/deg, "// &
         & number_text(model%speed*shape%ramp_slopes(1), digits)//" and "// &
         & number_text(model%speed*shape%ramp_slopes(2), digits)//" m/s; acceleration "// &
         & number_text(-1.0e3_wp*shape%largest(downwards), digits)//" to "// &
         & number_text(1.0e3_wp*shape%largest(upwards), digits)//" mm/rad^2"//n
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
      ! Of the speeds that are shown [rev/min over rad/s]; part of the cycle without contact [-]
      real(wp) :: speed_factor, lost_share
      character(len=:), allocatable :: unit
      logical :: has_lash, has_profile
      type(error_t), allocatable :: missing

      call get_summary(result, prefix//"lost_contact_share", lost_share, missing)
      if (allocated(missing)) lost_share = 0.0_wp
      has_profile = find_quantity(result%summary, "max_axial_pressure_max") > 0
      associate (turns => model%crank_turns)
         speed_factor = per_minute*merge(turns, 1.0_wp, turns > 0.0_wp)
         unit = " rev/min of the "//trim(merge("crankshaft", "camshaft  ", turns > 0.0_wp))
      end associate
      call add_value(name//" contact load up to ", "max_contact_load", 1.0_wp)
      call add_value(" N, pressure up to ", "max_"//trim(severest("hertz_pressure", has_profile)), 1.0e-9_wp)
      call add_value(" GPa, film ratio ", "min_film_ratio", 1.0_wp)
      if (lost_share > 0.0_wp) then
         text = text//" and more, without contact for "//number_text(100.0_wp*lost_share, digits)//" % of the cycle"
      else
         call add_value(" to ", "max_film_ratio", 1.0_wp)
      end if
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
      if (find_quantity(result%summary, prefix//"pump_up_speed") > 0) then
         call add_value(unit//", a lash adjuster pumps up above ", "pump_up_speed", speed_factor)
      end if
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
