!> Remarks on the tables of a deck: in another unit, over another angle, with noise, with a row that does not go with those beside
!> it.
!>
!> In: settings and a table. Out: sentences. Nothing is refused for them.
module camroller_deck_table_remarks
   use camroller_case, only : case_t, gas_force_of
   use camroller_case_columns, only : measured_prefix
   use camroller_deck_case, only : fill_case
   use camroller_deck_engine, only : strokes_of
   use camroller_deck_sweep, only : sweep_t
   use camroller_deck_tables, only : deck_tables_t, get_lift_table, get_pressure_table
   use camroller_deck_table_angles, only : ask_angles, ask_crank, usual_event
   use camroller_dynamics, only : gas_force_t
   use camroller_engine, only : from_firing
   use camroller_error, only : error_t
   use camroller_gas, only : usual_pressure, vacuum
   use camroller_kinds, only : degree, wp
   use camroller_lift, only : evaluate_lift, given_table, lift_law_t, lift_t, new_lift_law
   use camroller_lift_noise, only : find_lift_noise, find_outlier, find_sharp_ends, lift_noise_t
   use camroller_lift_table, only : find_event
   use camroller_text_lines, only : add_line, line_t
   use camroller_number_text, only : integer_text, number_text
   use camroller_settings, only : get_word, has_group, is_known, settings_t, take
   use camroller_spline, only : evaluate_spline, new_periodic_spline, spline_t
   use camroller_table_file, only : table_t
   use camroller_units, only : find_unit, pressure_unit_names, to_si, unit_of_key, unit_t
   implicit none
   private

   public :: remark_lift, remark_measured, remark_pressure, remark_rows

   !> Digits of numbers in sentences
   integer, parameter :: digits = 6
   !> Usual lifts [m]
   real(wp), parameter :: usual_lift(2) = [1.0e-3_wp, 25.0e-3_wp]
   !> Part of the largest lift below which a lift may be noise, and above which a valve is open [-]
   real(wp), parameter :: nearly_zero = 0.01_wp, open_part = 0.1_wp
   !> Part of the largest lift that counts as full lift, which a lift is near to for a degree or two [-]; distance of full lift from
   !> the nose beyond what cams and measurements are off by [deg]
   real(wp), parameter :: full_part = 0.999_wp, usual_offset = 5.0_wp
   !> Gauge pressure that only combustion has; smallest of a turn where absolute pressures are given, from a throttled to a
   !> supercharged engine [Pa]
   real(wp), parameter :: of_combustion = 1.0e6_wp, absolute(2) = [0.4e5_wp, 1.6e5_wp]
   !> Powers of ten between a table's unit and another one; nearer ones first
   integer, parameter :: slips(*) = [3, -3, 6, -6, 9, -9]

contains

   !> Measured values of a table of cases whose heading says nothing of their unit, but for the last words of a name: those are the
   !> unit of a key, and only a part of the name here.
   subroutine remark_measured(sweep, remarks)
      !> The sweep
      type(sweep_t), intent(in) :: sweep
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(unit_t) :: unit
      integer :: i

      do i = 1, size(sweep%measured)
         associate (column => sweep%measured(i))
            unit = unit_of_key(column%key)
            if (column%has_unit .or. unit%symbol == "1") cycle
            call add_line(remarks, measured_prefix//column%key//" counts as without a unit, whatever its name ends "// &
               & "with: a unit stands in brackets, as in 'measured.torque [N m]', and [1] for none")
         end associate
      end do
   end subroutine remark_measured

   !> A lift table in another unit, or over another angle.
   subroutine remark_lift(settings, group, table, remarks)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Group of the lift
      character(len=*), intent(in) :: group
      !> Its table
      type(table_t), intent(in) :: table
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(lift_t) :: lift
      ! Largest lift [m]; length of the event, middle of full lift from the nose [deg]
      real(wp) :: largest, length, full
      character(len=:), allocatable :: words
      integer :: i, first, last, low, high

      if (.not. allocated(table%x) .or. get_word(settings, group, "law") /= "table") return
      if (size(table%x) == 0) return
      call get_lift_table(settings, group, table, lift)
      largest = maxval(lift%table_lift)
      if (largest < usual_lift(1) .or. largest > usual_lift(2)) then
         words = ""
         do i = 1, size(slips)
            if (largest*10.0_wp**slips(i) < usual_lift(1) .or. largest*10.0_wp**slips(i) > usual_lift(2)) cycle
            words = "; is 'table_unit' right?"
         end do
         call add_line(remarks, table%path//": a largest lift of "//number_text(1.0e3_wp*largest, digits)// &
            & " mm is unusual: engines have 1 to 25 mm"//words)
      end if
      i = size(remarks)
      call remark_noise(group, table%path, lift, remarks)
      if (size(remarks) == i) call remark_ends(group, table%path, lift, remarks)
      first = findloc(lift%table_lift >= full_part*largest, .true., dim=1)
      last = findloc(lift%table_lift >= full_part*largest, .true., dim=1, back=.true.)
      full = 0.5_wp*(lift%table_angle(first) + lift%table_angle(last))/degree
      if (abs(full) > usual_offset) call add_line(remarks, table%path//": the largest lift is "//number_text(abs(full), 3)// &
         & " degrees "//trim(merge("before", "behind", full < 0.0_wp))//" the nose, from which phases, gas pressure and cam "// &
         & "angles count; is 'table_nose_angle_deg' of &"//group//" right?")
      call remark_event(settings, group, table%path, lift, low, high, remarks)
      length = (lift%table_angle(high) - lift%table_angle(low))/degree
      if (length >= usual_event(1) .and. length <= usual_event(2)) return
      call ask_angles(length, words)
      if (0.5_wp*length >= usual_event(1) .and. 0.5_wp*length <= usual_event(2)) words = ask_crank
      if (2*count(lift%table_lift(low:high) < nearly_zero*largest) > high - low + 1) words = "; most of its lifts are below "// &
         & number_text(100.0_wp*nearly_zero, digits)//" % of the largest: where they are noise on the base circle, set them to 0"
      call add_line(remarks, table%path//": an event of "//number_text(length, digits)// &
         & " degrees of cam angle is unusual: engines have "//number_text(usual_event(1), digits)//" to "// &
         & number_text(usual_event(2), digits)//words)
   end subroutine remark_lift

   !> The event of a lift table that has noise on the base circle.
   subroutine remark_event(settings, group, path, lift, low, high, remarks)
      type(settings_t), intent(in) :: settings
      !> Group of the lift, path of its table
      character(len=*), intent(in) :: group, path
      type(lift_t), intent(in) :: lift
      !> First and last row of the event in the lift of the valve
      integer, intent(out) :: low, high
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(lift_t) :: given
      ! Farthest row from zero beyond the event [m]; cam angle of the nose in the table [rad]
      real(wp) :: farthest, nose
      integer :: first, last

      given = given_table(lift)
      call find_event(given%table_angle, given%table_lift, given%smoothing, first, last)
      low = first
      high = last
      if (allocated(lift%given_lift)) then
         low = 1
         high = size(lift%table_lift)
      end if
      farthest = maxval(abs([0.0_wp, given%table_lift(:first), given%table_lift(last:)]))
      if (farthest <= 0.0_wp) return
      call take(settings, group, "table_nose_angle_deg", nose)
      call add_line(remarks, path//": the event is taken from "//number_text((given%table_angle(first) + nose)/degree, digits)// &
         & " to "//number_text((given%table_angle(last) + nose)/degree, digits)//" degrees; lifts beyond it, up to "// &
         & number_text(1.0e6_wp*farthest, 2)//" um from zero, count as noise on the base circle")
   end subroutine remark_event

   !> A lift table whose noise makes up the acceleration.
   subroutine remark_noise(group, path, lift, remarks)
      !> Group of the lift, path of its table
      character(len=*), intent(in) :: group, path
      type(lift_t), intent(in) :: lift
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Growth of the acceleration that is worth a word [-]
      real(wp), parameter :: large = 1.1_wp
      type(lift_noise_t) :: noise

      call find_lift_noise(lift, noise)
      if (.not. noise%is_known) return
      if (all(abs(noise%given) <= large*abs(noise%smoothed))) return
      call add_line(remarks, path//": the "//trim(merge("table", "lift ", allocated(lift%given_lift)))// &
         & " has noise of about "//number_text(1.0e6_wp*noise%noise, 2)// &
         & " um, which makes its second derivative "//number_text(1.0e3_wp*noise%given(1), 3)//" to "// &
         & number_text(1.0e3_wp*noise%given(2), 3)//" mm/rad^2; with smoothing_um = "//number_text(1.0e6_wp*noise%smoothing, 2)// &
         & " in &"//group//" it is "//number_text(1.0e3_wp*noise%smoothed(1), 3)//" to "// &
         & number_text(1.0e3_wp*noise%smoothed(2), 3)//". Loads and the speed at which contact is lost follow it")
   end subroutine remark_noise

   !> A lift that begins or ends with a slope.
   subroutine remark_ends(group, path, lift, remarks)
      !> Group of the lift, path of its table
      character(len=*), intent(in) :: group, path
      type(lift_t), intent(in) :: lift
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      logical :: is_sharp(2)
      ! Largest second derivative at both ends and elsewhere [m/rad^2], slope by the ends [m/rad]
      real(wp) :: acceleration(3), slope(2)
      character(len=:), allocatable :: words
      integer :: i

      call find_sharp_ends(lift, is_sharp, acceleration, slope)
      if (.not. any(is_sharp)) return
      words = path//": the lift of the valve"
      do i = 1, 2
         if (i == 2 .and. all(is_sharp)) words = words//" and"
         if (is_sharp(i)) words = words//trim(merge(" begins", " ends  ", i == 1))//" with a slope of "// &
            & number_text(1.0e6_wp*degree*slope(i), 3)//" um/deg"
      end do
      call add_line(remarks, words//"; the curve through the rows takes it up within two of them, with a second derivative of "// &
         & number_text(1.0e3_wp*maxval(acceleration(:2)), 3)//" mm/rad^2 (at most "//number_text(1.0e3_wp*acceleration(3), 3)// &
         & " elsewhere), and more where rows are closer. Loads and the speed at which contact is lost follow it, and are not "// &
         & "the cam's. Was a lash taken off? The table of &"//group//" takes the lift with its ramps")
   end subroutine remark_ends

   !> A row of a lift table that does not go with its neighbours.
   subroutine remark_rows(settings, group, table, remarks)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Group of the lift
      character(len=*), intent(in) :: group
      !> Its table
      type(table_t), intent(in) :: table
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      integer :: row
      ! How far it is off [unit of the table]
      real(wp) :: offset
      character(len=:), allocatable :: unit

      if (.not. allocated(table%x)) return
      if (size(table%x) == 0 .or. get_word(settings, group, "law") /= "table") return
      call find_outlier(table%x, table%y, row, offset)
      if (row == 0) return
      unit = " "//get_word(settings, group, "table_unit")
      call add_line(remarks, table%path//":"//integer_text(table%line(row))//": "//number_text(table%y(row), 8)//unit// &
         & " at "//number_text(table%x(row), digits)//" degrees does not go with the rows beside it, which lead to "// &
         & number_text(table%y(row) - offset, 8)//unit//": is it a slip? One such row changes acceleration, loads and "// &
         & "pressure, and bends the cam, up to an undercut")
   end subroutine remark_rows

   !> A table of cylinder pressure in another unit.
   subroutine remark_pressure(settings, tables, remarks)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Its tables
      type(deck_tables_t), intent(in) :: tables
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(table_t) :: table
      type(unit_t) :: unit
      logical :: is_there
      ! Largest magnitude [unit of the table]; it, and the smallest pressure [Pa]
      real(wp) :: largest, pressure, smallest
      character(len=:), allocatable :: words
      integer :: i, before

      table = tables%pressure
      if (.not. has_group(settings, "gas_force") .or. .not. allocated(table%y)) return
      if (size(table%x) == 0) return
      largest = maxval(abs(table%y))
      call find_unit(get_word(settings, "gas_force", "pressure_unit"), unit, is_there)
      smallest = to_si(unit, minval(table%y))
      if (smallest < vacuum) call add_line(remarks, table%path//": a gauge pressure of "// &
         & number_text(1.0e-6_wp*smallest, digits)//" MPa is below that of a vacuum, which only a higher "// &
         & "pressure in the port explains; positive pressures press the valve shut")
      pressure = to_si(unit, largest)
      if (is_usual_pressure(pressure) .and. pressure >= of_combustion .and. smallest >= absolute(1) .and. &
         & smallest <= absolute(2)) then
         call add_line(remarks, table%path//": no pressure of the turn is below "//number_text(1.0e-6_wp*smallest, digits)// &
            & " MPa; are these absolute pressures? The table takes gauge pressures")
      end if
      before = size(remarks)
      call remark_firing(settings, table, remarks)
      if (size(remarks) == before .and. is_usual_pressure(pressure)) call remark_open_valve(settings, tables, remarks)
      before = size(remarks)
      call remark_seam(table, remarks)
      if (size(remarks) == before) call remark_swing(table, remarks)
      if (is_usual_pressure(pressure) .or. .not. largest > 0.0_wp) return
      words = ""
      do i = 1, size(pressure_unit_names)
         call find_unit(trim(pressure_unit_names(i)), unit, is_there)
         if (.not. is_usual_pressure(to_si(unit, largest))) cycle
         if (words == "") words = "; is 'pressure_unit' right? Usual with '"//trim(pressure_unit_names(i))//"'"
         if (index(words, "'"//trim(pressure_unit_names(i))//"'") == 0) words = words//", '"//trim(pressure_unit_names(i))//"'"
      end do
      call add_line(remarks, table%path//": a largest pressure of "//number_text(1.0e-6_wp*pressure, digits)// &
         & " MPa is unusual: engines have 0.002 to 30 MPa"//words)
   end subroutine remark_pressure

   !> A pressure of combustion far from the crank angle at which the cylinder fires.
   subroutine remark_firing(settings, table, remarks)
      type(settings_t), intent(in) :: settings
      type(table_t), intent(in) :: table
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Crank angle from the dead centre of firing, within which the pressure is at its largest in any engine [rad]
      real(wp), parameter :: far = 60.0_wp*degree
      ! Cam angle from full lift [rad], pressure [Pa], crank angles of full lift, of the largest pressure [rad]
      real(wp), allocatable :: angle(:), pressure(:), full_lift(:)
      real(wp) :: place

      if (.not. is_known(settings, "engine", "full_lift_deg")) return
      call take(settings, "engine", "full_lift_deg", full_lift)
      call get_pressure_table(settings, table, angle, pressure)
      if (maxval(pressure) < of_combustion .or. size(full_lift) == 0) return
      place = from_firing(full_lift(1) + 0.5_wp*strokes_of(settings)*angle(maxloc(pressure, 1)), strokes_of(settings))
      if (abs(place) <= far) return
      call add_line(remarks, table%path//": the largest pressure, "//number_text(1.0e-6_wp*maxval(pressure), 4)//" MPa, is "// &
         & number_text(abs(place)/degree, 3)//" degrees of crank angle "//trim(merge("before", "behind", place < 0.0_wp))// &
         & " the firing of the cylinder, from which engine.full_lift_deg counts; is gas_force.table_nose_angle_deg right?")
   end subroutine remark_firing

   !> A pressure of combustion on an open valve.
   subroutine remark_open_valve(settings, tables, remarks)
      type(settings_t), intent(in) :: settings
      !> Their tables
      type(deck_tables_t), intent(in) :: tables
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(case_t) :: case
      type(lift_t), allocatable :: lift
      type(lift_law_t) :: law
      type(gas_force_t) :: gas
      type(error_t), allocatable :: error
      ! Lift and its derivatives [m/rad^n], lifts at the rows of the pressure, largest lift [m]; pressure on the open valve [Pa]
      real(wp) :: values(0:3), largest, pressure
      real(wp), allocatable :: lifts(:)
      integer :: lobe, i

      call fill_case(settings, tables, case)
      do lobe = 1, 2
         lift = case%lift
         if (lobe == 2) then
            if (.not. allocated(case%second_lift)) return
            lift = case%second_lift
         end if
         call gas_force_of(case, lobe, gas)
         call new_lift_law(law, lift, error)
         if (allocated(error)) return
         call evaluate_lift(law, 0.0_wp, values)
         largest = values(0)
         allocate (lifts(size(gas%angle)))
         do i = 1, size(lifts)
            call evaluate_lift(law, gas%angle(i), values)
            lifts(i) = values(0)
         end do
         i = maxloc(gas%pressure, dim=1, mask=lifts >= open_part*largest)
         deallocate (lifts)
         if (i == 0) cycle
         pressure = gas%pressure(i)
         if (pressure < of_combustion) cycle
         call evaluate_lift(law, gas%angle(i), values)
         call add_line(remarks, tables%pressure%path//": "//number_text(1.0e-6_wp*pressure, 4)//" MPa press on a valve open by "// &
            & number_text(1.0e3_wp*values(0), 3)//" mm, as no combustion does; is gas_force.table_nose_angle_deg right?")
         return
      end do
   end subroutine remark_open_valve

   !> A jump of the pressure from the last row of a turn to its first one.
   subroutine remark_seam(table, remarks)
      type(table_t), intent(in) :: table
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! A jump, over the largest step from row to row, and over the range of the pressure [-]
      real(wp), parameter :: over_step = 3.0_wp, over_range = 0.2_wp
      ! The jump, largest step, range [unit of the table]
      real(wp) :: jump, step, range
      integer :: n

      n = size(table%y)
      jump = abs(table%y(n) - table%y(1))
      step = maxval(abs(table%y(2:) - table%y(:n - 1)))
      range = maxval(table%y) - minval(table%y)
      if (jump <= over_step*step .or. jump <= over_range*range) return
      call add_line(remarks, table%path//": the pressure jumps from "//number_text(table%y(n), digits)//" in its last row to "// &
         & number_text(table%y(1), digits)//" in its first one, where the turn of the camshaft closes"//ask_crank)
   end subroutine remark_seam

   !> A curve that leaves the rows it goes through: beside a jump, for which there are too few rows.
   subroutine remark_swing(table, remarks)
      type(table_t), intent(in) :: table
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Part of the range of the pressure by which the curve may leave the four rows about a step: the peak of a smooth pressure
      ! between two rows does by less, a curve beside a jump by several times as much [-]
      real(wp), parameter :: small = 0.015_wp
      ! Places within a step at which it is looked for
      integer, parameter :: places = 8
      type(spline_t) :: curve
      type(error_t), allocatable :: error
      ! Pressure and its derivatives; by how much the curve leaves the rows, at most; pressure there [unit of the table]
      real(wp) :: values(0:3), swing, largest, extreme
      ! Cam angles of the rows, and of the first one a turn later [deg]
      real(wp), allocatable :: angle(:)
      integer :: i, k, n, row

      n = size(table%x)
      if (table%x(n) - table%x(1) >= 360.0_wp) n = n - 1
      angle = [table%x(:n), table%x(1) + 360.0_wp]
      call new_periodic_spline(curve, angle, [table%y(:n), table%y(1)], 0.0_wp, error)
      if (allocated(error)) return
      largest = small*(maxval(table%y) - minval(table%y))
      row = 0
      do i = 1, n
         associate (near => table%y(1 + modulo([i - 2, i - 1, i, i + 1], n)))
            do k = 1, places - 1
               call evaluate_spline(curve, angle(i) + (angle(i + 1) - angle(i))*real(k, wp)/places, values)
               swing = max(values(0) - maxval(near), minval(near) - values(0))
               if (swing <= largest) cycle
               largest = swing
               extreme = values(0)
               row = i
            end do
         end associate
      end do
      if (row == 0) return
      call add_line(remarks, table%path//": between its rows at "//number_text(angle(row), digits)//" and "// &
         & number_text(angle(row + 1), digits)//" degrees the curve through the rows comes to "//number_text(extreme, 3)//", "// &
         & number_text(largest, 3)//" beyond the rows about it; where the pressure jumps, more rows keep the curve beside them")
   end subroutine remark_swing

   !> Is a largest pressure usual?
   elemental function is_usual_pressure(pressure) result(verdict)
      !> The pressure [Pa]
      real(wp), intent(in) :: pressure
      !> Is it?
      logical :: verdict

      verdict = pressure >= usual_pressure(1) .and. pressure <= usual_pressure(2)
   end function is_usual_pressure

end module camroller_deck_table_remarks
