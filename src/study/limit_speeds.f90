!> Speeds up to which a train does what its cam asks for: the first at which the pivot's joint unloads, the adjuster pumps up, cam
!> and roller part in the event, the valve meets its seat too fast, or no longer does.
!>
!> In: a case, the range of speeds. Out: those of the rigid train by the formulas of its margins; those of a flexible train by a
!> scan upwards in even steps and halving where one is passed, on periodic states, or on 40 cycles where there is none. What a train
!> does within less than a step of the scan may be missed.
module camroller_limit_speeds
   use camroller_kinds, only : wp, pi, per_minute
   use camroller_accuracy, only : resolve_numerics
   use camroller_case, only : case_t
   use camroller_error, only : error_t, add_context
   use camroller_events, only : cycle_stops, find_stops
   use camroller_flexible_measure_list, only : event_pivot_force, event_words, seating_speed, smallest_event_load, &
      & smallest_lift, smallest_pivot_force
   use camroller_flexible_solution, only : flexible_solution_t, solve_flexible
   use camroller_margins, only : find_margins, margins_t
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text
   use camroller_pump_up, only : is_pumped_up
   use camroller_remarks, only : missing_lift, remark_t, stopped_plunger
   use camroller_run, only : build_models
   use camroller_train_remarks, only : judge_train
   implicit none
   private

   public :: limits_t, limit_names, start_limits, try_speed, joint_limit, adjuster_limit, contact_limit, seating_limit, &
      & closing_limit

   !> Places of the limits
   integer, parameter :: joint_limit = 1, adjuster_limit = 2, contact_limit = 3, seating_limit = 4, closing_limit = 5, &
      & limit_count = 5
   !> What happens at them
   character(len=*), parameter :: limit_names(*) = [character(len=48) :: "the joint of the pivot unloads", &
      & "the lash adjuster pumps up", "cam and roller part in the "//event_words, "the valve meets its seat faster than", &
      & "the valve no longer closes"]
   !> Tolerance of the integration where the case gives none [-]
   real(wp), parameter :: usual_tolerance = 1.0e-4_wp
   !> Remarks on a train that none of the limits shows: its valve does not follow the cam at all, or its plunger is on a stop
   integer, parameter :: told_kinds(*) = [missing_lift, stopped_plunger]
   !> Width at which halving ends [rad/s]: 1 rev/min
   real(wp), parameter :: width = 1.0_wp/per_minute

   !> A search
   type :: limits_t
      type(case_t) :: case
      !> Speed of seating that counts as too fast [m/s]; highest speed and step of the scan [rad/s]
      real(wp) :: seating = 0.0_wp, highest = 0.0_wp, step = 0.0_wp
      !> Limits of the rigid train: infinite where it has none, negative where it is not known [rad/s]
      real(wp) :: rigid(limit_count) = -1.0_wp
      !> Is the train flexible, with an adjuster, with lash? Lash unloads the joint in each turn, at every speed: its limit is then
      !> that of the event
      logical :: is_flexible = .false., has_adjuster = .false., has_lash = .false.
      !> Highest speed that was tried and lies below a limit, lowest that lies above it, as far as there is one [rad/s]
      real(wp) :: below(limit_count) = 0.0_wp, above(limit_count) = huge(1.0_wp)
      !> Lowest speed tried above the latter at which the train is not beyond the limit, as far as there is one; not where a motion
      !> without a period, whose extremes scatter, is beyond it again within a step of the scan [rad/s]
      real(wp) :: regained(limit_count) = huge(1.0_wp)
      !> Cycles of the period at the latter; 0 where there is none
      integer :: period(limit_count) = 0
      !> Speeds that have been tried, and as many as there will be at most
      integer :: done = 0, total = 0
      !> Is there a speed left to try?
      logical :: is_open = .false.
      !> Why the scan ended early
      character(len=:), allocatable :: failure
      !> Remarks without which the limits mislead, each kind at the lowest speed that has it
      type(remark_t), allocatable :: remarks(:)
      !> These speeds [rad/s]
      real(wp), allocatable :: remark_speeds(:)
   end type limits_t

contains

   !> Begin: limits of the rigid train, and what there is to search.
   subroutine start_limits(search, case, seating, highest, step, error)
      !> The search
      type(limits_t), intent(out) :: search
      !> The case; its speed does not matter
      type(case_t), intent(in) :: case
      !> Speed of seating that counts as too fast [m/s]; highest speed and step of the scan [rad/s]
      real(wp), intent(in) :: seating, highest, step
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable :: models(:)
      type(margins_t) :: margins
      ! Stops of a cycle [rad]
      real(wp), allocatable :: stops(:)
      integer :: lobe

      search%case = case
      search%seating = seating
      search%highest = highest
      search%step = step
      search%failure = ""
      allocate (search%remarks(0), search%remark_speeds(0))
      if (.not. case%numerics%tolerance > 0.0_wp) search%case%numerics%tolerance = usual_tolerance
      call build_models(case, models, error)
      if (allocated(error)) return
      search%is_flexible = allocated(case%dynamics)
      if (search%is_flexible) search%has_lash = case%dynamics%lash > 0.0_wp
      search%has_adjuster = allocated(case%lash_adjuster)
      do lobe = 1, size(models)
         call find_stops(models(lobe), stops)
         call find_margins(models(lobe), cycle_stops(stops, -pi), margins)
         call lower(contact_limit, margins%event%speed)
         if (.not. allocated(margins%pivot)) cycle
         call lower(joint_limit, margins%pivot%speed)
         call lower(adjuster_limit, margins%pump_up_speed)
      end do
      search%is_open = search%is_flexible
      search%total = ceiling(highest/step) + limit_count*max(0, ceiling(log(step/width)/log(2.0_wp)))

   contains

      !> Take a lobe's limit.
      subroutine lower(limit, speed)
         !> Which
         integer, intent(in) :: limit
         !> The speed [rad/s]
         real(wp), intent(in) :: speed

         if (search%rigid(limit) < 0.0_wp .or. speed < search%rigid(limit)) search%rigid(limit) = speed
      end subroutine lower

   end subroutine start_limits

   !> Try the next speed of a search that is open. A case that cannot be computed ends the scan at the speeds before.
   subroutine try_speed(search)
      !> The search
      type(limits_t), intent(inout) :: search

      type(error_t), allocatable :: error
      ! Speed to try [rad/s]
      real(wp) :: speed
      type(remark_t), allocatable :: remarks(:)
      logical :: is_passed(limit_count)
      integer :: period, limit

      speed = next_speed(search)
      call judge_speed(search, speed, is_passed, period, remarks, error)
      search%done = search%done + 1
      if (allocated(error)) then
         search%failure = "at "//number_text(speed*per_minute, 6)//" rev/min: "//error%message
         search%is_open = .false.
         return
      end if
      call note_first(search, speed, remarks)
      do limit = 1, limit_count
         if (speed > search%above(limit) .and. .not. is_passed(limit)) search%regained(limit) = min(search%regained(limit), speed)
         if (is_passed(limit) .and. period == 0 .and. speed > search%regained(limit) .and. &
            & speed - search%regained(limit) < 1.5_wp*search%step) search%regained(limit) = huge(1.0_wp)
         if (speed <= search%below(limit) .or. speed >= search%above(limit)) cycle
         if (is_passed(limit)) then
            search%above(limit) = speed
            search%period(limit) = period
         else
            search%below(limit) = speed
         end if
      end do
      search%is_open = next_speed(search) > 0.0_wp
   end subroutine try_speed

   !> Keep what remarks of a speed have to be told, at the lowest speed of each kind.
   pure subroutine note_first(search, speed, remarks)
      type(limits_t), intent(inout) :: search
      !> The speed [rad/s]
      real(wp), intent(in) :: speed
      type(remark_t), intent(in) :: remarks(:)

      integer :: i, k

      do i = 1, size(remarks)
         if (.not. any(remarks(i)%kind == told_kinds)) cycle
         k = findloc(search%remarks%kind, remarks(i)%kind, 1)
         if (k == 0) then
            search%remarks = [search%remarks, remarks(i)]
            search%remark_speeds = [search%remark_speeds, speed]
         else if (speed < search%remark_speeds(k)) then
            search%remarks(k) = remarks(i)
            search%remark_speeds(k) = speed
         end if
      end do
   end subroutine note_first

   !> The speed to try next: the middle of a limit's bracket, or where all that have one are narrow the next of the scan.
   pure function next_speed(search) result(speed)
      type(limits_t), intent(in) :: search
      !> The speed; zero where the search is at its end [rad/s]
      real(wp) :: speed

      integer :: limit

      do limit = 1, limit_count
         speed = 0.5_wp*(search%below(limit) + search%above(limit))
         if (search%above(limit) <= search%highest .and. search%above(limit) - search%below(limit) > width) return
      end do
      ! The scan goes on from the highest speed that is below a limit
      speed = maxval(search%below, mask=.not. search%above <= search%highest .and. (search%has_adjuster .or. &
         & [(limit, limit=1, limit_count)] /= adjuster_limit))
      if (speed < search%highest .and. speed >= 0.0_wp) then
         speed = min(search%step*(nint(speed/search%step) + 1), search%highest)
      else
         speed = 0.0_wp
      end if
   end function next_speed

   !> What the train does at a speed.
   subroutine judge_speed(search, speed, is_passed, period, remarks, error)
      type(limits_t), intent(in) :: search
      !> The speed [rad/s]
      real(wp), intent(in) :: speed
      !> Is it above each limit?
      logical, intent(out) :: is_passed(limit_count)
      !> Cycles of the period; 0 where there is none
      integer, intent(out) :: period
      !> Remarks on the trains of all lobes
      type(remark_t), allocatable, intent(out) :: remarks(:)
      !> Domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      type(model_t), allocatable, target :: models(:)
      type(flexible_solution_t) :: solution
      integer :: lobe

      allocate (remarks(0))
      is_passed = .false.
      period = 1
      case = search%case
      case%operating_point%speed = speed
      call build_models(case, models, error)
      if (allocated(error)) return
      do lobe = 1, size(models)
         call solve_flexible(solution, models(lobe), resolve_numerics(case%numerics), error)
         if (lobe > 1) call add_context(error, "second lift")
         if (allocated(error)) return
         is_passed(joint_limit) = is_passed(joint_limit) .or. solution%lowest(merge(event_pivot_force, smallest_pivot_force, &
            & search%has_lash)) < 0.0_wp
         is_passed(contact_limit) = is_passed(contact_limit) .or. .not. solution%lowest(smallest_event_load) > 0.0_wp
         is_passed(seating_limit) = is_passed(seating_limit) .or. solution%highest(seating_speed) > search%seating
         is_passed(closing_limit) = is_passed(closing_limit) .or. solution%highest(smallest_lift) > 0.0_wp
         if (search%has_adjuster) is_passed(adjuster_limit) = is_passed(adjuster_limit) .or. is_pumped_up(models(lobe), solution)
         ! Contact that is lost has limits of its own
         call judge_train(models(lobe), solution, 0.0_wp, remarks, error)
         if (allocated(error)) return
         if (solution%cycle%period /= 1 .and. period > 0) period = solution%cycle%period
      end do
   end subroutine judge_speed

end module camroller_limit_speeds
