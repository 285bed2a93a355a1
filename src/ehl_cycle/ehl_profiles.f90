!> Pressure and film profiles for a cycle that was computed with a film law: steady contacts at its loads and sliding speeds.
!>
!> In: case, its result. Out: `ehl_record_t` at the cam angles of the result, with the values of the film law and of the friction
!> formulas at the same loads and speeds for comparison. The result itself is not changed. At angles whose contact is not solved all
!> but load and sliding speed is no number.
module camroller_ehl_profiles
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp, pi, two_pi, degree, not_a_number
   use camroller_error, only : error_t, raise, add_context, kind_convergence
   use camroller_case, only : case_t
   use camroller_contact_heat, only : has_hot_contact
   use camroller_contact_traction, only : has_hot_boundary
   use camroller_dynamics, only : moments_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, prepare_march
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_record, only : column, ehl_record_t, list_ehl_quantities, make_ehl_record, profile_quantities
   use camroller_ehl_reynolds, only : new_ehl_fields
   use camroller_ehl_step, only : ehl_march_t, lost_part, moment_t, find_film, spin_excess
   use camroller_ehl_summary, only : mean_over_cycle
   use camroller_ehl_table, only : ehl_t
   use camroller_cam_check, only : check_geometry
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t, new_model
   use camroller_number_text, only : integer_text, number_text
   use camroller_remarks, only : add_remark, light_contact, missing_profiles, plain_contacts, remark_t
   use camroller_result, only : quantity_t, result_t, find_quantity
   use camroller_state, only : evaluate_loading
   implicit none
   private

   public :: find_profiles, judge_light, make_profiles, plain_model

   !> Nodes across a contact
   integer, parameter :: profile_nodes = 129

contains

   !> Profiles of a case that requests them; a remark on the result where some or all cannot be solved.
   subroutine find_profiles(record, case, result)
      !> The record; not allocated where there is none
      type(ehl_record_t), allocatable, intent(out) :: record
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(inout) :: result

      type(error_t), allocatable :: error
      character(len=:), allocatable :: gaps

      if (.not. allocated(case%ehl)) return
      if (.not. case%ehl%profiles) return
      allocate (record)
      call make_profiles(record, case, result, gaps, error)
      if (.not. allocated(error)) then
         if (len(gaps) > 0) call add_remark(result%remarks, missing_profiles, "profiles have no numbers at some angles: "// &
            & gaps, 100.0_wp*count(ieee_is_nan(column(record, "peak_pressure")))/size(record%angle))
         if (allocated(case%dynamics)) call add_remark(result%remarks, plain_contacts, "profiles are solved at load and "// &
            & "slip of the flexible train and at the speeds of a rigid one")
         if (allocated(case%running_in)) call add_remark(result%remarks, plain_contacts, "profiles are solved between new "// &
            & "surfaces, at load and slip of those that &running_in leaves")
         call judge_light(record, result%remarks)
         return
      end if
      deallocate (record)
      call add_remark(result%remarks, missing_profiles, "no profiles: "//error%message, 100.0_wp)
      result%lacks_profiles = .true.
   end subroutine find_profiles

   !> Profiles of a result.
   subroutine make_profiles(record, case, result, gaps, error)
      !> The record
      type(ehl_record_t), intent(out) :: record
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(in) :: result
      !> At how many angles the contact is not solved, and the first of them; empty where all are
      character(len=:), allocatable, intent(out) :: gaps
      !> Domain error beyond the range of solutions, convergence error where no contact is solved
      type(error_t), allocatable, intent(out) :: error

      type(model_t) :: model
      type(ehl_cycle_t) :: cycle
      logical, allocatable :: is_solved(:)

      gaps = ""
      call plain_model(model, case, .false., error)
      if (.not. allocated(error)) call steady_contacts(cycle, is_solved, model, result%angle*degree - pi, &
         & result%series_values(:, find_quantity(result%series, "contact_load")), &
         & result%series_values(:, find_quantity(result%series, "sliding_speed")), error)
      if (allocated(error)) return
      call make_ehl_record(record, model, cycle, profile_quantities)
      if (all(is_solved)) return
      call describe_gaps(has_hot_contact(model), is_solved, cycle%angle, gaps)
      if (any(is_solved .and. cycle%moments%has_film)) then
         call blank_unsolved(record, is_solved)
      else
         call raise(error, kind_convergence, gaps)
      end if
   end subroutine make_profiles

   !> No number where a contact is not solved, but for load and sliding speed.
   subroutine blank_unsolved(record, is_solved)
      !> Profiles with all angles
      type(ehl_record_t), intent(inout) :: record
      !> Is the contact solved? At each angle
      logical, intent(in) :: is_solved(:)

      type(quantity_t), allocatable :: list(:)
      integer :: i

      call list_ehl_quantities(size(record%values, 2), list)
      do i = 1, size(list)
         if (list(i)%name == "load" .or. list(i)%name == "sliding_speed") cycle
         where (.not. is_solved) record%values(:, i) = not_a_number()
      end do
      do i = 1, size(is_solved)
         if (is_solved(i)) cycle
         record%pressure(:, i) = not_a_number()
         record%film(:, i) = not_a_number()
         if (allocated(record%film_rise)) record%film_rise(:, i) = not_a_number()
      end do
   end subroutine blank_unsolved

   !> A remark where solved contacts have no film under a load: it is below the part of the largest from which films are solved.
   subroutine judge_light(record, remarks)
      !> The solved contacts
      type(ehl_record_t), intent(in) :: record
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      ! 1 where there is a load without a film, else 0; part of the cycle [-]
      real(wp) :: is_light(size(record%angle)), part
      ! Largest pressure; that of a contact that is not solved is none to compare [Pa]
      real(wp) :: peak(size(record%angle))

      peak = column(record, "peak_pressure")
      where (ieee_is_nan(peak)) peak = huge(1.0_wp)
      is_light = merge(1.0_wp, 0.0_wp, column(record, "load") > 0.0_wp .and. .not. peak > 0.0_wp)
      part = mean_over_cycle([record%angle, record%angle(1) + two_pi], [is_light, is_light(1)])
      if (part > 0.0_wp) call add_remark(remarks, light_contact, "the film is not solved for "//number_text(100.0_wp*part, 3)// &
         & " % of the cycle, where the load is below "//number_text(100.0_wp*lost_part, 2)// &
         & " % of the largest: film, pressure and friction are zero there, and mean films are without these angles", 100.0_wp*part)
   end subroutine judge_light

   !> Model of a case with the film law of the deck, without a table of numerical films, for solved contacts.
   subroutine plain_model(model, case, is_second, error)
      !> The model; it knows how contacts are to be solved
      type(model_t), intent(out) :: model
      !> The case
      type(case_t), intent(in) :: case
      !> The second lobe shape?
      logical, intent(in) :: is_second
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: plain
      type(ehl_t), allocatable :: setup

      plain = case
      call move_alloc(plain%ehl, setup)
      call new_model(model, plain, merge(2, 1, is_second), error)
      if (.not. allocated(error)) call check_geometry(model, plain%mechanism%grinding_wheel_radius, error)
      if (allocated(error) .and. is_second) call add_context(error, "second lift")
      if (allocated(setup)) call move_alloc(setup, model%ehl)
   end subroutine plain_model

   !> Steady contacts at given loads and sliding speeds, each from the last that was solved.
   subroutine steady_contacts(cycle, is_solved, model, angles, loads, speeds, error)
      !> The contacts
      type(ehl_cycle_t), intent(out) :: cycle
      !> Was a solution found? At each angle
      logical, allocatable, intent(out) :: is_solved(:)
      type(model_t), intent(in) :: model
      !> Cam angles from full lift [rad], loads [N], sliding speeds [m/s]
      real(wp), intent(in) :: angles(:), loads(:), speeds(:)
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_march_t) :: march
      type(ehl_state_t) :: state, last
      type(moment_t) :: before(1)
      integer :: i

      call prepare_march(march, model, ehl_cycle_options_t(nodes=profile_nodes, is_transient=.false.), error)
      if (allocated(error)) return
      march%is_warm = .true.
      call new_ehl_fields(state%fields, march%grid%size)
      cycle%angle = angles
      cycle%nodes = march%grid%x
      allocate (cycle%moments(size(angles)), is_solved(size(angles)))
      allocate (cycle%pressure(march%grid%size, size(angles)), cycle%film(march%grid%size, size(angles)), source=0.0_wp)
      if (allocated(model%heat)) allocate (cycle%film_rise(march%grid%size, size(angles)), source=0.0_wp)
      do i = 1, size(angles)
         cycle%moments(i)%angle = angles(i)
         cycle%moments(i)%load = loads(i)
         cycle%moments(i)%sliding_speed = speeds(i)
         last = state
         call solve_at(model, march, before, state, cycle%moments(i), is_solved(i))
         if (.not. is_solved(i)) then
            state = last
            cycle%moments(i) = moment_t(angle=angles(i), load=loads(i), sliding_speed=speeds(i))
            cycle
         end if
         before(1) = cycle%moments(i)
         if (.not. before(1)%has_film) cycle
         cycle%pressure(:, i) = state%total*before(1)%pressure_scale
         cycle%film(:, i) = state%fields%film*before(1)%film_scale
         if (allocated(state%fields%rise)) cycle%film_rise(:, i) = state%fields%rise
      end do
   end subroutine steady_contacts

   !> Words where contacts are not solved: of the iteration, which says nothing of the film itself.
   subroutine describe_gaps(is_hot, is_solved, angles, words)
      !> Is the temperature solved for, too?
      logical, intent(in) :: is_hot
      !> Is the contact solved? At each angle
      logical, intent(in) :: is_solved(:)
      !> Cam angles from full lift [rad]
      real(wp), intent(in) :: angles(:)
      !> For a remark or an error
      character(len=:), allocatable, intent(out) :: words

      character(len=:), allocatable :: unknowns, advice

      unknowns = "film and pressure"
      advice = ""
      if (is_hot) then
         unknowns = "film, pressure and temperature"
         advice = "; isothermal profiles, with inlet_law = 'none' and contact = 'none' in &heat, need that of film and "// &
            & "pressure alone"
      end if
      words = "the iteration of "//unknowns//" did not end at "//integer_text(count(.not. is_solved))//" of "// &
         & integer_text(size(angles))//" angles, first at "//cam_angle_text(angles(findloc(is_solved, .false., 1)), 3)// &
         & advice
   end subroutine describe_gaps

   !> Film and friction at one angle. Where the coefficient of boundary friction follows the temperature of the surfaces, both are
   !> solved for by turns: the heat of boundary friction is a part of all heat, and the coefficient a weak function of it.
   subroutine solve_at(model, march, before, state, now, converged)
      type(model_t), intent(in) :: model
      !> Nodes
      type(ehl_march_t), intent(in) :: march
      !> The contact before
      type(moment_t), intent(in) :: before(1)
      !> Its pressure, then that at the angle
      type(ehl_state_t), intent(inout) :: state
      !> The contact; angle, load and sliding speed are set
      type(moment_t), intent(inout) :: now
      !> Was a solution found?
      logical, intent(out) :: converged

      type(position_t) :: position
      type(moments_t) :: moments
      ! Change of the surfaces' temperature that may be left [K], and turns at most
      real(wp), parameter :: last_change = 1.0e-3_wp
      integer, parameter :: most_turns = 20
      ! Gas force [N]; what the roller's equation would need, not used [m/s^2], [1/s]; rise of the surfaces before [K]
      real(wp) :: force, excess, slope, rise
      integer :: status, turn

      call evaluate_loading(model, now%angle, position, force, moments, status)
      converged = status == 0
      if (.not. converged) return
      now%films%asperity_rise = before(1)%films%asperity_rise
      do turn = 1, most_turns
         rise = now%films%asperity_rise
         call find_film(model, march, position, before, [0.0_wp, 0.0_wp, 0.0_wp], state, now, converged)
         if (.not. converged) return
         if (.not. has_hot_boundary(model)) exit
         converged = abs(now%films%asperity_rise - rise) <= last_change
         if (converged) exit
      end do
      if (.not. converged) return
      if (allocated(now%mass)) deallocate (now%mass)
      call spin_excess(model, position, now, now%sliding_speed, 0.0_wp, excess, slope)
      if (allocated(now%films%cells)) deallocate (now%films%cells)
   end subroutine solve_at

end module camroller_ehl_profiles
