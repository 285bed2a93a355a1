!> The engine of a deck: its keys, the rules between them, and what they come to.
!>
!> In: settings. Out: mistakes; the engine of a case, with every cam of every camshaft in its place and phase.
module camroller_deck_engine
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : schema_t, add_group, add_number, add_integer, add_integers, add_name, add_numbers, &
      & from_to, group_effect, one_or_more, positive
   use camroller_engine, only : engine_t, cam_phases_of, cam_turns, speed_names
   use camroller_mistakes, only : mistakes_t
   use camroller_number_text, only : counted, integer_text
   use camroller_settings, only : settings_t, find_value, get_word, has_group, is_known, is_wrong, take
   implicit none
   private

   public :: add_engine_keys, check_engine, fill_engine, strokes_of

   character(len=*), parameter :: group = "engine", bearings = "cam_bearings"

contains

   !> Keys of the engine.
   subroutine add_engine_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(engine_t) :: standard

      call add_group(schema, group, group_effect, &
         & "engine that the camshafts belong to: phases from the firing order, mean pressures, harmonics of the drive torque")
      call add_integer(schema, "cylinders", one_or_more, "number of cylinders, which fire at equal distances", example="4")
      call add_number(schema, "displacement_cm3", positive, "volume displaced by all cylinders", example="1998")
      call add_integer(schema, "strokes", from_to(2.0_wp, 4.0_wp), "strokes of a working cycle: 2 or 4", default=standard%strokes)
      call add_integers(schema, "firing_order", one_or_more, "cylinders in the order in which they fire", example="1, 3, 4, 2")
      call add_name(schema, "given_speed", speed_names, speed_names(1), "whose speed operating_point.speed_rpm is")
      call add_integer(schema, "camshafts", from_to(1.0_wp, 2.0_wp), &
         & "camshafts: with 2, each has all the cams of cam_bearings.cam_positions_mm, the first one with the lobe shape of "// &
         & "&lift, the second one with that of &second_lift", default=standard%camshafts)
      call add_numbers(schema, "full_lift_deg", from_to(-720.0_wp, 720.0_wp), &
         & "crank angle from the firing dead centre of a cylinder to full lift of its valves, for each lobe shape", &
         & example="470, 250")
   end subroutine add_engine_keys

   !> Strokes of a working cycle.
   function strokes_of(settings) result(strokes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> So many
      integer :: strokes

      type(engine_t) :: standard

      strokes = standard%strokes
      call take(settings, group, "strokes", strokes)
   end function strokes_of

   !> Rules that tie the engine to its camshafts.
   subroutine check_engine(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer, allocatable :: order(:), cylinders_of_cams(:)
      ! [rad]
      real(wp), allocatable :: full_lift(:)
      ! [m]
      real(wp), allocatable :: positions(:)
      integer :: cylinders, camshafts, shapes, i

      if (.not. has_group(settings, group)) then
         if (is_known(settings, bearings, "cam_cylinders")) call complain(mistakes, settings, bearings, "cam_cylinders", &
            & "'cam_cylinders' needs the group &engine")
         return
      end if
      if (.not. has_group(settings, bearings)) then
         call complain_about_group(mistakes, settings, group, "&engine needs the group &cam_bearings")
         return
      end if
      if (has_no([character(len=13) :: "cylinders", "firing_order", "full_lift_deg"])) return
      camshafts = 1
      call take(settings, group, "camshafts", camshafts)
      call take(settings, group, "cylinders", cylinders)
      call take(settings, group, "firing_order", order)
      call take(settings, group, "full_lift_deg", full_lift)
      if (strokes_of(settings) == 3) call complain(mistakes, settings, group, "strokes", "'strokes' is 2 or 4")
      if (size(order) /= cylinders) then
         call complain(mistakes, settings, group, "firing_order", "'firing_order' has "//integer_text(size(order))// &
            & " entries for "//counted(cylinders, "cylinder"))
      else if (any([(count(order == i) /= 1, i=1, cylinders)])) then
         call complain(mistakes, settings, group, "firing_order", "'firing_order' must name every cylinder once")
      end if
      shapes = merge(2, 1, has_group(settings, "second_lift"))
      if (camshafts == 2 .and. shapes == 1) then
         call complain(mistakes, settings, group, "camshafts", "two camshafts need the group &second_lift")
      else if (size(full_lift) /= shapes) then
         call complain(mistakes, settings, group, "full_lift_deg", "'full_lift_deg' has "//integer_text(size(full_lift))// &
            & " entries for "//counted(shapes, "lobe shape"))
      end if
      if (settings%values(find_value(settings, bearings, "cam_phases_deg"))%is_given) call complain(mistakes, settings, &
         & bearings, "cam_phases_deg", "'cam_phases_deg' follows from the firing order of &engine; leave it out")
      if (camshafts == 2 .and. settings%values(find_value(settings, bearings, "cam_lobes"))%is_given) call complain(mistakes, &
         & settings, bearings, "cam_lobes", "with two camshafts each has one lobe shape; leave 'cam_lobes' out")
      if (.not. is_known(settings, bearings, "cam_cylinders")) then
         if (.not. is_wrong(settings, bearings, "cam_cylinders")) call complain_about_group(mistakes, settings, bearings, &
            & "&engine needs 'cam_cylinders' in &cam_bearings, the cylinder of each cam")
         return
      end if
      call take(settings, bearings, "cam_cylinders", cylinders_of_cams)
      if (any(cylinders_of_cams > cylinders)) call complain(mistakes, settings, bearings, "cam_cylinders", &
         & "the engine has "//counted(cylinders, "cylinder"))
      if (.not. is_known(settings, bearings, "cam_positions_mm")) return
      call take(settings, bearings, "cam_positions_mm", positions)
      if (size(positions) /= size(cylinders_of_cams)) call complain(mistakes, settings, bearings, "cam_cylinders", &
         & "'cam_cylinders' has "//integer_text(size(cylinders_of_cams))//" entries for "//integer_text(size(positions))// &
         & " cams of 'cam_positions_mm'")

   contains

      !> Is one of the engine's keys not there? It has its own message.
      function has_no(keys) result(verdict)
         !> The keys
         character(len=*), intent(in) :: keys(:)
         !> Is one not there?
         logical :: verdict

         integer :: k

         verdict = .false.
         do k = 1, size(keys)
            verdict = verdict .or. .not. is_known(settings, group, trim(keys(k)))
         end do
      end function has_no

   end subroutine check_engine

   !> The engine of a case whose camshaft is there: speed of the camshaft, and all cams of all camshafts.
   subroutine fill_engine(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      integer :: i

      if (.not. has_group(settings, group)) return
      allocate (case%engine)
      call take(settings, group, "cylinders", case%engine%cylinders)
      call take(settings, group, "displacement_cm3", case%engine%displacement)
      call take(settings, group, "strokes", case%engine%strokes)
      call take(settings, group, "camshafts", case%engine%camshafts)
      call take(settings, group, "firing_order", case%engine%firing_order)
      call take(settings, group, "full_lift_deg", case%engine%full_lift)
      call take(settings, bearings, "cam_cylinders", case%engine%cam_cylinders)
      if (get_word(settings, group, "given_speed") == speed_names(1)) then
         case%operating_point%speed = case%operating_point%speed/cam_turns(case%engine)
      end if
      associate (cams => case%cam_bearings, number => size(case%cam_bearings%cam_positions))
         if (case%engine%camshafts == 2) then
            cams%cam_lobes = [(1, i=1, number), (2, i=1, number)]
            cams%cam_shafts = cams%cam_lobes
            case%engine%cam_cylinders = [case%engine%cam_cylinders, case%engine%cam_cylinders]
            cams%follower_angles = [cams%follower_angles, cams%follower_angles]
            cams%cam_positions = [cams%cam_positions, cams%cam_positions]
         end if
         cams%cam_phases = cam_phases_of(case%engine, cams%cam_lobes)
      end associate
   end subroutine fill_engine

end module camroller_deck_engine
