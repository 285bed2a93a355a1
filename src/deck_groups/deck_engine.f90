!> The engine of a deck: its keys, the rules between them, and what they come to.
!>
!> In: keys, settings. Out: mistakes; the engine of a case, with every cam of every camshaft in its place and phase.
module camroller_deck_engine
   use camroller_deck_binder, only : keys_t
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : group_effect, positive, from_to, one_or_more
   use camroller_engine, only : engine_t, cam_phases_of, cam_turns, speed_names
   use camroller_mistakes, only : mistakes_t
   use camroller_number_text, only : counted, integer_text
   use camroller_settings, only : settings_t, find_value, get_word, has_group, is_known, is_wrong, take
   implicit none
   private

   public :: bind_engine, check_engine, place_cams, strokes_of

   character(len=*), parameter :: group = "engine", bearings = "cam_bearings"

contains

   !> Group and keys, and the component of a case.
   subroutine bind_engine(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group(group, group_effect, "engine that the camshafts belong to: phases from the firing order, mean "// &
         & "pressures, harmonics of the drive torque")
      if (.not. keys%are_wanted(allocated(case%engine))) return
      if (.not. allocated(case%engine)) allocate (case%engine)
      call keys%whole_number("cylinders", one_or_more, "number of cylinders, which fire at equal distances", &
         & case%engine%cylinders, example="4")
      ! From a moped's cylinder to a truck's engine of six
      call keys%number("displacement_cm3", positive, "volume displaced by all cylinders", case%engine%displacement, &
         & example="1998", usual=[40.0_wp, 2.0e4_wp])
      call keys%whole_number("strokes", from_to(2.0_wp, 4.0_wp), "strokes of a working cycle: 2 or 4", case%engine%strokes)
      call keys%whole_numbers("firing_order", one_or_more, "cylinders in the order in which they fire", case%engine%firing_order, &
         & example="1, 3, 4, 2")
      call keys%choice("given_speed", speed_names, "whose speed operating_point.speed_rpm is")
      call keys%whole_number("camshafts", from_to(1.0_wp, 2.0_wp), "camshafts: with 2, each has all the cams of "// &
         & "cam_bearings.cam_positions_mm, the first one with the lobe shape of &lift, the second one with that of &second_lift", &
         & case%engine%camshafts)
      call keys%numbers("full_lift_deg", from_to(-720.0_wp, 720.0_wp), &
         & "crank angle from the firing dead centre of a cylinder to full lift of its valves, for each lobe shape", &
         & case%engine%full_lift, example="470, 250")
   end subroutine bind_engine

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

   !> Speed of the camshaft by that of the engine, and all cams of all camshafts.
   subroutine place_cams(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      integer :: i

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
   end subroutine place_cams

end module camroller_deck_engine
