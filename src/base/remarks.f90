!> Remarks: what a reader should know of a result that is there; of one case, and of many by kind.
!>
!> In: kind, number and words, where a remark arises. Out: remarks of a case, their lines; groups of remarks of one
!> kind on one lobe shape: how many cases have one, and which has the worst.
module camroller_remarks
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: remark_t, remarks_t, add_remark, remark_lines, note_remarks
   public :: remark_names, lost_contact, outside_range, unresolved_slip, standing_entrainment, open_pivot, pumped_adjuster, &
      & missed_accuracy, missed_means, loose_tolerance, missing_profiles, missed_extremes, no_period, long_period, &
      & relieved_spring, film_without_limit, beyond_pressure_law, hot_inlet, bouncing_valve, rising_plunger, stopped_plunger, &
      & cut_off_contact, unloaded_end, rubbing_pin, rolling_out_of_range, rubbing_contact, yielding_surface, &
      & bearing_width, rubbing_bearing, orbit_out_of_range, foreign_asperities, hot_film, far_temperature, missing_lift, &
      & open_valve, sinking_plunger, pressed_seat, cold_estimate, idle_roller, deep_wear, lifted_valve, &
      & short_contact, shaken_train, creeping_roller, shut_valve, empty_chamber, rigid_contact, liquid_limit, backward_roller, &
      & foreign_speed, untouched_film, oiled_slices, lost_lash, plain_contacts, light_contact, &
      & few_places, held_coefficient, cool_bearings, cool_inlet, missed_hours, far_table, cool_pin, &
      & spent_friction, thick_seal_oil, outer_asperities, insulated_metal, unusual_supply, unusual_gas

   !> Kinds, in the order of `remark_names`. Their numbers: part of the cycle [%], part of the cycle [%], error [-], times [-],
   !> force [N], force [N], error [-], error [-], error [-], part of the angles [%], error [-], closure [-], cycles, travel over
   !> travel [-], film over radius [-], pressure over that of the law [-], part of the cycle [%], speed of seating [m/s], part of
   !> the cycle [%], way beyond the stop [m], pressure at the end over that of the mean load [-], part of the cycle [%], roughness
   !> over film [-], part of the cycle [%], part of the cycle [%], pressure over what is allowed [-], width over that of the law or
   !> the other way round [-], limit over film [-] for the next two, none, rise of the temperature [K], way beyond the points [K],
   !> part of the lift [%], smallest lift [m], way below its rest [m], force [N], way beyond the formula [K], slip [-], depth over
   !> lift [-], force [N], half width over length [-], load over that of a rigid train [-], slip [%], none, ambient pressure less
   !> that of the chamber [Pa], part of the cycle [%] for the next three, speed of the law over that of the roller [-], film over
   !> roughness [-], part of the cycle [%], part of the sinking that is more than the lash [-], none, part of the cycle [%], miss
   !> over the largest [-], none, viscosity over that of the warm oil [-], film over that with heat [-], error [-], way beyond the
   !> points [K], viscosity over that of the warm oil [-], part of the cycle [%], viscosity over that of the seal's drag [-], mean
   !> gain of a part of the load [-], friction with metal that passes heat on over that without [-], none for the last two
   integer, parameter :: lost_contact = 1, outside_range = 2, unresolved_slip = 3, standing_entrainment = 4, open_pivot = 5, &
      & pumped_adjuster = 6, missed_accuracy = 7, missed_means = 8, loose_tolerance = 9, missing_profiles = 10, &
      & missed_extremes = 11, no_period = 12, long_period = 13, relieved_spring = 14, film_without_limit = 15, &
      & beyond_pressure_law = 16, hot_inlet = 17, bouncing_valve = 18, rising_plunger = 19, stopped_plunger = 20, &
      & cut_off_contact = 21, unloaded_end = 22, rubbing_pin = 23, rolling_out_of_range = 24, &
      & rubbing_contact = 25, yielding_surface = 26, bearing_width = 27, rubbing_bearing = 28, orbit_out_of_range = 29, &
      & foreign_asperities = 30, hot_film = 31, far_temperature = 32, missing_lift = 33, open_valve = 34, sinking_plunger = 35, &
      & pressed_seat = 36, cold_estimate = 37, idle_roller = 38, deep_wear = 39, lifted_valve = 40, &
      & short_contact = 41, shaken_train = 42, creeping_roller = 43, shut_valve = 44, empty_chamber = 45, rigid_contact = 46, &
      & liquid_limit = 47, backward_roller = 48, foreign_speed = 49, untouched_film = 50, oiled_slices = 51, lost_lash = 52, &
      & plain_contacts = 53, light_contact = 54, few_places = 55, held_coefficient = 56, cool_bearings = 57, &
      & cool_inlet = 58, missed_hours = 59, far_table = 60, cool_pin = 61, spent_friction = 62, thick_seal_oil = 63, &
      & outer_asperities = 64, insulated_metal = 65, unusual_supply = 66, unusual_gas = 67
   !> What the kinds are called
   character(len=*), parameter :: remark_names(*) = [character(len=name_length) :: "contact lost", "film law out of range", &
      & "slip not resolved", "entrainment passes zero", "pivot joint opens", "adjuster pumps up", "accuracy not reached", &
      & "means not accurate", "tolerance too loose", "profiles not solved", "extremes not accurate", "not periodic", &
      & "period of several cycles", "waves relieve the spring", "film without limit", "pressure law out of range", &
      & "heat of the inlet out of range", "valve bounces", "plunger rises in the event", "plunger at its stop", &
      & "contact cut off by an end", "end of the roller unloaded", "film of the pin too thin", "rolling law out of range", &
      & "film of the contact too thin", "pressure beyond yield", "bearing law out of its width", "film of a bearing too thin", &
      & "orbit out of its fit", "asperity law of another film", "oil of a hot film out of range", "oil far from its points", &
      & "lift not reached", "valve does not close", "plunger sinks far", "gas presses the closed valve", &
      & "oil too cold for its estimate", "roller hardly turns", "wear changes the cam", "gas opens the closed valve", &
      & "contact as short as wide", "rigid train would vibrate", "slip is creep", "check valve stays shut", &
      & "adjuster's chamber empty", &
      & "shear of a rigid contact", "limit of a liquid film", "roller turns backwards", "speed below those of a law", &
      & "tribofilm without asperities", "oil beside the dry contact", "lash taken by the seat", &
      & "group left out of contacts", "film of a light load not solved", "places too far apart", &
      & "boundary law held at its bound", "heat left out of bearings", "heat left out of films", "hours not accurate", &
      & "boundary law far from its points", "heat left out of the pin", "friction of a joint is spent", &
      & "seal in far thicker oil", "asperities beside the strip", "metal passes no heat on", &
      & "supply pressure is unusual", "gas pressure is unusual"]

   !> One remark
   type :: remark_t
      !> One of the kinds above
      integer :: kind = 0
      !> The lobe shape that it names; 0 where it names none
      integer :: lobe = 0
      !> Severity: the larger the worse; zero where its kind has no number [unit of the kind]
      real(wp) :: size = 0.0_wp
      !> What decides between remarks of one size: the larger the worse [-]
      real(wp) :: excess = 0.0_wp
      !> In words, on one line
      character(len=:), allocatable :: text
   end type remark_t

   !> Remarks of one kind on one lobe shape
   type :: remark_group_t
      !> The worst
      type(remark_t) :: worst
      !> Its case, from 1
      integer :: case_number = 0
      !> Cases with such a remark, and the last of them
      integer :: cases = 0, last_case = 0
   end type remark_group_t

   !> Remarks of all cases
   type :: remarks_t
      !> In the order in which kinds were met
      type(remark_group_t), allocatable :: groups(:)
   end type remarks_t

contains

   !> Add a remark to those of a case.
   pure subroutine add_remark(remarks, kind, text, size, excess)
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> One of the kinds of this module
      integer, intent(in) :: kind
      !> In words, on one line
      character(len=*), intent(in) :: text
      !> Severity, where its kind has a number [unit of the kind]
      real(wp), intent(in), optional :: size
      !> What decides between remarks of one size [-]
      real(wp), intent(in), optional :: excess

      type(remark_t) :: remark

      if (.not. allocated(remarks)) allocate (remarks(0))
      remark%kind = kind
      remark%text = text
      if (present(size)) remark%size = size
      if (present(excess)) remark%excess = excess
      remarks = [remarks, remark]
   end subroutine add_remark

   !> Length of the lines of remarks.
   pure function lines_length(remarks) result(length)
      type(remark_t), intent(in) :: remarks(:)
      !> The length, with what is between them
      integer :: length

      integer :: i

      length = max(0, size(remarks) - 1)
      do i = 1, size(remarks)
         length = length + len(remarks(i)%text)
      end do
   end function lines_length

   !> Remarks of a case as text, one per line; empty where there are none.
   pure function remark_lines(remarks) result(lines)
      !> The remarks
      type(remark_t), intent(in) :: remarks(:)
      !> The lines
      character(len=lines_length(remarks)) :: lines

      integer :: place, i

      place = 0
      do i = 1, size(remarks)
         lines(place + 1:) = remarks(i)%text//new_line("a")
         place = place + len(remarks(i)%text) + 1
      end do
   end function remark_lines

   !> Take note of the remarks of a case.
   pure subroutine note_remarks(remarks, case_number, of_case)
      !> Remarks so far
      type(remarks_t), intent(inout) :: remarks
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> Its remarks
      type(remark_t), intent(in) :: of_case(:)

      type(remark_group_t) :: fresh
      integer :: i, k

      if (.not. allocated(remarks%groups)) allocate (remarks%groups(0))
      do k = 1, size(of_case)
         do i = 1, size(remarks%groups)
            if (remarks%groups(i)%worst%kind == of_case(k)%kind .and. remarks%groups(i)%worst%lobe == of_case(k)%lobe) exit
         end do
         if (i > size(remarks%groups)) remarks%groups = [remarks%groups, fresh]
         associate (group => remarks%groups(i))
            if (group%cases == 0 .or. is_worse(of_case(k), group%worst)) then
               group%worst = of_case(k)
               group%case_number = case_number
            end if
            if (group%last_case /= case_number) group%cases = group%cases + 1
            group%last_case = case_number
         end associate
      end do
   end subroutine note_remarks

   !> Is a remark worse than another of its kind? Sizes that differ by rounding count as equal.
   pure function is_worse(one, other) result(verdict)
      !> Both remarks
      type(remark_t), intent(in) :: one, other
      !> Is the first one worse?
      logical :: verdict

      real(wp), parameter :: rounding = sqrt(epsilon(1.0_wp)) ! [-]

      if (abs(one%size - other%size) <= rounding*abs(other%size)) then
         verdict = one%excess > other%excess
      else
         verdict = one%size > other%size
      end if
   end function is_worse

end module camroller_remarks
