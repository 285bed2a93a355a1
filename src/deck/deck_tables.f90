!> Tables that a deck names: read once, checked for what they are to be used for, handed over in SI.
!>
!> In: settings and the deck's folder. Out: lift or pressure over the cam angle from full lift.
module camroller_deck_tables
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, kind_file
   use camroller_units, only : unit_t, find_unit, from_si, to_si
   use camroller_number_text, only : number_text, integer_text
   use camroller_mistakes, only : mistakes_t, add_mistake
   use camroller_settings, only : settings_t, take, get_word, has_group
   use camroller_deck_complaint, only : complain
   use camroller_deck_mechanism, only : take_mechanism
   use camroller_deck_table_angles, only : ask_angles, ask_crank
   use camroller_deck_table_headings, only : check_heading, wanted_columns
   use camroller_kinematics, only : mechanism_t
   use camroller_lift, only : lift_t
   use camroller_lift_forms, only : closes_triangle, follow_table, kind_contour, kind_valve, table_kind_names, valve_lift_of
   use camroller_lift_table, only : find_event, find_gap, no_noise, noise_reach
   use camroller_text_file, only : join_path
   use camroller_table_file, only : check_spacing, columns_t, read_table, table_t
   implicit none
   private

   public :: deck_tables_t, kept_table_t, table_groups, find_table, obtain_tables, get_lift_table, get_pressure_table
   public :: wanted_columns

   !> Groups whose key `table` names a table of two columns
   character(len=*), parameter :: table_groups(*) = [character(len=11) :: "lift", "second_lift", "gas_force"]
   !> Fewest rows of a table
   integer, parameter :: fewest_rows = 8
   !> The largest lift must be so near to the nose [deg]
   real(wp), parameter :: nose_distance = 30.0_wp
   !> What counts as zero lift, relative to the largest lift [-]
   real(wp), parameter :: zero_lift = 1.0e-9_wp
   !> What counts as the base circle in a contour, relative to the largest height over it: radii are measured [-]
   real(wp), parameter :: zero_height = 1.0e-4_wp
   !> Difference of two pressures that are taken for the same, relative to the largest pressure [-]
   real(wp), parameter :: same_pressure = 1.0e-6_wp

   !> A table that cases name
   type :: kept_table_t
      !> Group that names it
      character(len=:), allocatable :: group
      !> The table
      type(table_t) :: table
   end type kept_table_t

   !> Tables of a deck; without a path where there is none
   type :: deck_tables_t
      !> Lift of the first and of the second lobe shape, cylinder pressure
      type(table_t) :: lift, second_lift, pressure
      !> Tables that its cases name, where they are at hand: then no other is read
      type(kept_table_t), allocatable :: kept(:)
   end type deck_tables_t

contains

   !> Have the tables at hand that the settings name; those already at hand are not read again.
   subroutine obtain_tables(settings, folder, tables, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Folder of the deck
      character(len=*), intent(in) :: folder
      !> Tables at hand
      type(deck_tables_t), intent(inout) :: tables
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (get_word(settings, "lift", "law") == "table") then
         call obtain(settings, "lift", folder, tables%kept, tables%lift, mistakes)
         call check_lift(settings, "lift", tables%lift, mistakes)
      end if
      if (has_group(settings, "second_lift") .and. get_word(settings, "second_lift", "law") == "table") then
         call obtain(settings, "second_lift", folder, tables%kept, tables%second_lift, mistakes)
         call check_lift(settings, "second_lift", tables%second_lift, mistakes)
      end if
      if (has_group(settings, "gas_force")) then
         call obtain(settings, "gas_force", folder, tables%kept, tables%pressure, mistakes)
         call check_pressure(tables%pressure, mistakes)
      end if
   end subroutine obtain_tables

   !> The table of a group that a deck has at hand; without a path where there is none.
   pure subroutine find_table(tables, group, table)
      !> Tables of the deck
      type(deck_tables_t), intent(in) :: tables
      !> One of `table_groups`
      character(len=*), intent(in) :: group
      !> The table
      type(table_t), intent(out) :: table

      select case (group)
      case ("lift")
         table = tables%lift
      case ("second_lift")
         table = tables%second_lift
      case default
         table = tables%pressure
      end select
   end subroutine find_table

   !> Have one table at hand.
   subroutine obtain(settings, group, folder, kept, table, mistakes)
      type(settings_t), intent(in) :: settings
      !> Group that names the table
      character(len=*), intent(in) :: group
      !> Folder of the deck
      character(len=*), intent(in) :: folder
      !> Tables that are at hand where no other is to be read
      type(kept_table_t), allocatable, intent(in) :: kept(:)
      type(table_t), intent(inout) :: table
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: path
      type(error_t), allocatable :: error
      type(columns_t) :: columns
      integer :: before

      columns = wanted_columns(settings, group)
      path = get_word(settings, group, "table")
      if (path == "") return
      path = join_path(folder, path)
      if (allocated(table%path)) then
         if (table%path == path .and. size(table%x) > 0) then
            if (.not. allocated(table%columns)) return
            if (all(table%columns%names == columns%names)) return
         end if
      end if
      before = mistakes%count
      if (allocated(kept)) then
         call take_kept(kept, group, path, table, error)
      else
         call read_table(path, table, mistakes, error, columns)
      end if
      if (allocated(error)) then
         if (index(get_word(settings, group, "table"), "/") /= 1) error%message = error%message// &
            & "; the path of a table starts at the folder of the deck, also where an included file gives it"
         call complain(mistakes, settings, group, "table", error%message)
      else if (mistakes%count == before .and. size(table%x) < fewest_rows) then
         call add_mistake(mistakes, "the table has "//integer_text(size(table%x))//" of at least "// &
            & integer_text(fewest_rows)//" rows", 0, 0, 0, path)
      else if (mistakes%count == before) then
         call check_spacing(table, mistakes)
      end if
      if (mistakes%count == before) call check_heading(settings, group, table, mistakes)
      if (mistakes%count > before) table%x = table%x(:0)
   end subroutine obtain

   !> A table among those at hand.
   subroutine take_kept(kept, group, path, table, error)
      !> Tables at hand
      type(kept_table_t), intent(in) :: kept(:)
      !> Group that names it, and its path
      character(len=*), intent(in) :: group, path
      type(table_t), intent(inout) :: table
      !> File error where it is not among them
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(kept)
         if (kept(i)%group /= group .or. kept(i)%table%path /= path) cycle
         table = kept(i)%table
         exit
      end do
      if (i > size(kept)) then
         call raise(error, kind_file, "the table '"//path//"' is not at hand")
      else if (size(table%x) == 0) then
         call raise(error, kind_file, "the table '"//path//"' could not be read")
      end if
   end subroutine take_kept

   !> Is a table a lift: from zero to zero, nowhere negative, around the nose, within one turn?
   subroutine check_lift(settings, group, table, mistakes)
      type(settings_t), intent(in) :: settings
      !> Group that names the table
      character(len=*), intent(in) :: group
      type(table_t), intent(in) :: table
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Largest lift [unit of the file], and lift, of a contour the height over the base circle [unit of the file]
      real(wp) :: largest
      real(wp), allocatable :: lift(:)
      !> Cam angle of the nose in the table [rad] and [deg]
      real(wp) :: nose, nose_degrees
      !> What counts as zero lift [unit of the file]; smoothing [m]
      real(wp) :: nothing, smoothing
      type(mechanism_t) :: mechanism
      type(unit_t) :: unit
      logical :: is_there
      integer :: kind, n, top, first, last

      if (.not. allocated(table%x)) return
      n = size(table%x)
      if (n == 0) return
      nose = pi
      call take(settings, group, "table_nose_angle_deg", nose)
      nose_degrees = nose/degree
      kind = findloc(table_kind_names, get_word(settings, group, "table_kind"), 1)
      call take_mechanism(settings, mechanism)
      call find_unit(get_word(settings, group, "table_unit"), unit, is_there)
      lift = table%y
      if (kind == kind_contour) lift = lift - from_si(unit, mechanism%base_radius)
      top = maxloc(lift, dim=1)
      largest = lift(top)
      smoothing = 0.0_wp
      call take(settings, group, "smoothing_um", smoothing)
      nothing = max(merge(zero_height, zero_lift, kind == kind_contour)*largest, from_si(unit, noise_reach*smoothing))
      if (largest <= 0.0_wp) then
         call row_mistake(table, top, trim(merge("no radius is above the base circle's", "the table has no lift above zero    ", &
            & kind == kind_contour)), mistakes)
         return
      end if
      if (runs_across(table%x, lift, nothing)) then
         first = findloc(lift <= nothing, .true., dim=1)
         last = findloc(lift <= nothing, .true., dim=1, back=.true.)
         call row_mistake(table, top, "the event runs across the end of the table: move the rows from "// &
            & number_text(table%x((first + last)/2), 6)//" degrees on before the others, at 360 degrees less"// &
            & trim(merge(", but for the last one, which is the first one again", repeat(" ", 52), &
            & table%x(n) - table%x(1) >= 360.0_wp)), mistakes)
         return
      end if
      call check_rest(group, table, lift, nothing, kind == kind_contour, mistakes)
      ! What is not lifted may be anywhere: a contour closes, wherever its polar angle begins
      first = findloc(lift > nothing, .true., dim=1)
      last = findloc(lift > nothing, .true., dim=1, back=.true.)
      call check_nose(group, table, top, first, last, nose_degrees, kind == kind_contour, mistakes)
      if (mistakes%count == 0) call check_form(settings, group, table, kind, mistakes)
   end subroutine check_lift

   !> Is the event where the nose is said to be, and not longer than a turn?
   subroutine check_nose(group, table, top, first, last, nose, is_contour, mistakes)
      !> Group that names the table
      character(len=*), intent(in) :: group
      type(table_t), intent(in) :: table
      !> Row of the largest lift, first and last row with a lift
      integer, intent(in) :: top, first, last
      !> Cam angle of the nose in the table [deg]
      real(wp), intent(in) :: nose
      !> Is it a contour?
      logical, intent(in) :: is_contour
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: advice
      !> Length of the table [deg]
      real(wp) :: length

      length = table%x(size(table%x)) - table%x(1)
      if (max(abs(table%x(top)), length) > 360.0_wp .and. .not. is_contour .and. abs(table%x(top) - nose) > nose_distance) then
         call row_mistake(table, top, "the largest lift is at "//number_text(table%x(top), 6)//" of "// &
            & number_text(table%x(1), 6)//" to "//number_text(table%x(size(table%x)), 6)//" degrees"//ask_crank, mistakes)
      else if (abs(table%x(top) - nose) > nose_distance) then
         call ask_angles(length, advice)
         if (advice == "" .or. length > 360.0_wp) advice = "; see 'table_nose_angle_deg' of &"//group
         call row_mistake(table, top, "the largest lift, at "//number_text(table%x(top), 6)//" degrees, is far from the "// &
            & "nose at "//number_text(nose, 6)//advice, mistakes)
      else if (table%x(first) < nose - 180.0_wp .or. table%x(last) > nose + 180.0_wp) then
         call row_mistake(table, merge(first, last, table%x(first) < nose - 180.0_wp), "the lift must lie within 180 "// &
            & "degrees of the nose at "//number_text(nose, 6), mistakes)
      end if
   end subroutine check_nose

   !> Does the event of a table of a turn begin before the turn's end, and end in the next turn?
   pure function runs_across(angle, lift, nothing) result(verdict)
      !> Cam angles, increasing [deg]
      real(wp), intent(in) :: angle(:)
      !> Lift, of a contour the height over the base circle; what counts as zero [any]
      real(wp), intent(in) :: lift(:), nothing
      !> Does it?
      logical :: verdict

      associate (n => size(lift))
         verdict = angle(n) - angle(1) >= 360.0_wp - 2.0_wp*maxval(angle(2:) - angle(:n - 1)) .and. &
            & min(lift(1), lift(n)) > max(nothing, no_noise*maxval(lift)) .and. any(lift <= nothing)
      end associate
   end function runs_across

   !> Does a table start and end at zero, and go nowhere below?
   subroutine check_rest(group, table, lift, nothing, is_contour, mistakes)
      !> Group that names the table
      character(len=*), intent(in) :: group
      type(table_t), intent(in) :: table
      !> Its lift, of a contour the height over the base circle; what counts as zero [unit of the file]
      real(wp), intent(in) :: lift(:), nothing
      !> Is it a contour?
      logical, intent(in) :: is_contour
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: advice
      integer :: n

      n = size(lift)
      advice = "; where rows on the base circle hold noise, set them to "//trim(merge("its radius", "0         ", is_contour))// &
         & ", or give 'smoothing_um' of &"//group
      if (abs(lift(1)) > nothing) call row_mistake(table, 1, trim(merge("the contour must start on the base circle", &
         & "the lift must start at zero              ", is_contour))//advice, mistakes)
      if (abs(lift(n)) > nothing) call row_mistake(table, n, trim(merge("the contour must end on the base circle", &
         & "the lift must end at zero              ", is_contour))//advice, mistakes)
      if (any(lift < -nothing)) call row_mistake(table, minloc(lift, dim=1), trim(merge("a radius below the base circle's", &
         & "negative lift                   ", is_contour))//advice, mistakes)
   end subroutine check_rest

   !> Has the event all rows? Can the roller follow a contour, or be where its lift has it?
   subroutine check_form(settings, group, table, kind, mistakes)
      type(settings_t), intent(in) :: settings
      !> Group that names the table
      character(len=*), intent(in) :: group
      type(table_t), intent(in) :: table
      !> What it holds
      integer, intent(in) :: kind
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(mechanism_t) :: mechanism
      type(lift_t) :: given
      ! [rad], [m]
      real(wp), allocatable :: angle(:), lift(:)
      type(error_t), allocatable :: error
      integer :: i, before, first, low, high

      call take_given(settings, group, table, given, before)
      call find_event(given%table_angle, given%table_lift, given%smoothing, low, high)
      i = find_gap(given%table_angle(low:high))
      if (i > 0) then
         i = before + low - 1 + i
         call row_mistake(table, i + 1, "the lift has a gap from "//number_text(table%x(i), 10)//" to "// &
            & number_text(table%x(i + 1), 10)//", much wider than the distances beside it", mistakes)
         return
      end if
      if (kind == kind_valve) return
      call take_mechanism(settings, mechanism)
      call follow_table(mechanism, kind, given, first, angle, lift, error)
      if (allocated(error)) then
         call complain(mistakes, settings, group, "table", error%message)
         return
      end if
      do i = 1, size(angle)
         if (i > 1) then
            if (angle(i) <= angle(i - 1)) then
               call row_mistake(table, before + first + i - 1, "the roller does not touch the contour here: a hollow narrower "// &
                  & "than the roller, a mistake in the row, or noise, which 'smoothing_um' of &"//group//" takes out; are "// &
                  & "'table_unit' and the roller's radius right?", mistakes)
               return
            end if
         end if
         if (.not. closes_triangle(mechanism, lift(i))) then
            call row_mistake(table, before + first + i - 1, "the roller cannot be so far from the cam: its arm is shorter; is "// &
               & "this a "//trim(merge("contour of the cam", "lift of the roller", kind == kind_contour))// &
               & " ('table_kind'), and is 'table_unit' right?", mistakes)
            return
         end if
      end do
   end subroutine check_form

   !> What a lift table gives, in SI over the angle from the nose, with its smoothing: lift of the valve or of the roller, or height
   !> of a contour over the base circle. Rows of zero before and after the event are left out but for one; of a contour, rows
   !> beyond those on the base circle next to the nose.
   subroutine take_given(settings, group, table, given, before)
      type(settings_t), intent(in) :: settings
      !> Group that names the table
      character(len=*), intent(in) :: group
      type(table_t), intent(in) :: table
      !> The values as a lift's table
      type(lift_t), intent(inout) :: given
      !> Rows left out before it
      integer, intent(out) :: before

      type(unit_t) :: unit
      type(mechanism_t) :: mechanism
      logical :: is_known
      real(wp) :: nose ! [rad]
      real(wp), allocatable :: lift(:) ! [m]
      integer :: top, first, last

      given%law = "table"
      call take(settings, group, "smoothing_um", given%smoothing)
      nose = pi
      call take(settings, group, "table_nose_angle_deg", nose)
      call find_unit(get_word(settings, group, "table_unit"), unit, is_known)
      lift = to_si(unit, table%y)
      if (get_word(settings, group, "table_kind") == table_kind_names(kind_contour)) then
         call take_mechanism(settings, mechanism)
         lift = lift - mechanism%base_radius
         top = maxloc(lift, dim=1)
         first = max(1, findloc(lift(:top) <= zero_lift*lift(top), .true., dim=1, back=.true.))
         last = min(size(lift), top - 1 + findloc(lift(top:) <= zero_lift*lift(top), .true., dim=1))
         if (last < top) last = size(lift)
         lift([first, last]) = 0.0_wp
      else
         first = max(1, findloc(table%y > 0.0_wp, .true., dim=1) - 1)
         last = min(size(table%y), findloc(table%y > 0.0_wp, .true., dim=1, back=.true.) + 1)
         where (lift < 0.0_wp .and. lift >= -zero_lift*maxval(lift)) lift = 0.0_wp
      end if
      before = first - 1
      given%table_angle = table%x(first:last)*degree - nose
      given%table_lift = lift(first:last)
   end subroutine take_given

   !> Is a table one turn of the cylinder pressure?
   subroutine check_pressure(table, mistakes)
      type(table_t), intent(in) :: table
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Length of the table, and the widest distance in it [deg]
      real(wp) :: length, widest
      character(len=:), allocatable :: advice
      integer :: n

      if (.not. allocated(table%x)) return
      n = size(table%x)
      if (n == 0) return
      length = table%x(n) - table%x(1)
      widest = maxval(table%x(2:) - table%x(:n - 1))
      if (length > 360.0_wp .or. length < 360.0_wp - 2.0_wp*widest) then
         call ask_angles(length, advice)
         call row_mistake(table, n, "the table must cover one turn of the camshaft, 360 degrees, not "// &
            & number_text(length, 6)//advice, mistakes)
      else if (length >= 360.0_wp .and. abs(table%y(n) - table%y(1)) > same_pressure*maxval(abs(table%y))) then
         call row_mistake(table, n, "the pressure must end as it begins, with "//number_text(table%y(1), 10), mistakes)
      end if
   end subroutine check_pressure

   !> Take note of a mistake in a row.
   subroutine row_mistake(table, row, message, mistakes)
      type(table_t), intent(in) :: table
      integer, intent(in) :: row
      !> What is wrong
      character(len=*), intent(in) :: message
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      call add_mistake(mistakes, message, table%line(row), 0, 0, table%path, &
         & number_text(table%x(row))//"  "//number_text(table%y(row)))
   end subroutine row_mistake

   !> Lift over the angle from full lift, with its smoothing. Where the table is of something else than the valve's lift, that is
   !> smoothed, and the lift made of it is not any more.
   subroutine get_lift_table(settings, group, table, lift)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Group that names the table
      character(len=*), intent(in) :: group
      !> The table
      type(table_t), intent(in) :: table
      !> The lift by a table
      type(lift_t), intent(inout) :: lift

      type(mechanism_t) :: mechanism
      type(error_t), allocatable :: error
      type(lift_t) :: given
      real(wp), allocatable :: roller_lift(:) ! [m]
      integer :: before, first, kind

      call take_given(settings, group, table, lift, before)
      kind = findloc(table_kind_names, get_word(settings, group, "table_kind"), 1)
      if (kind == kind_valve) return
      given = lift
      call take_mechanism(settings, mechanism)
      ! the table was checked: there is no error
      call follow_table(mechanism, kind, given, first, lift%table_angle, roller_lift, error)
      lift%table_lift = valve_lift_of(mechanism, roller_lift)
      lift%given_angle = given%table_angle
      lift%given_lift = given%table_lift
   end subroutine get_lift_table

   !> Pressure over one turn from half a turn before full lift, increasing; a last row that repeats the first is left out.
   subroutine get_pressure_table(settings, table, angle, pressure)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The table
      type(table_t), intent(in) :: table
      !> Cam angle from full lift, increasing [rad]
      real(wp), allocatable, intent(out) :: angle(:)
      !> Gauge pressure [Pa]
      real(wp), allocatable, intent(out) :: pressure(:)

      type(unit_t) :: unit
      logical :: is_known
      !> Cam angle of the nose in the table [rad]
      real(wp) :: nose
      integer :: n, first

      nose = pi
      call take(settings, "gas_force", "table_nose_angle_deg", nose)
      call find_unit(get_word(settings, "gas_force", "pressure_unit"), unit, is_known)
      n = size(table%x)
      if (table%x(n) - table%x(1) >= 360.0_wp) n = n - 1
      angle = modulo(table%x(:n)*degree - nose + pi, two_pi) - pi
      first = minloc(angle, dim=1)
      angle = [cshift(angle, first - 1), angle(first) + two_pi]
      pressure = to_si(unit, table%y(:n))
      pressure = [cshift(pressure, first - 1), pressure(first)]
   end subroutine get_pressure_table

end module camroller_deck_tables
