!> What the accuracy of a steady film costs: hard contacts of a cycle over the number of nodes.
!>
!> Layer: solver. In: a case. Out: rows of `study_table_t`: errors against 1025 nodes, times from nothing and from nearby.
!> A trial that fails is a row with a message. Times are medians of repeated trials.
module camroller_study_contact
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_case, only : case_t
   use camroller_dynamics, only : moments_t
   use camroller_ehl_films, only : ehl_films_t
   use camroller_ehl_grid, only : ehl_grid_t
   use camroller_ehl_newton, only : ehl_state_t, solve_newton
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem, in_range, range_text
   use camroller_ehl_profiles, only : plain_model
   use camroller_ehl_solution, only : ehl_options_t, solve_on_grid, solve_on_grids
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t
   use camroller_result, only : quantity_t
   use camroller_state, only : evaluate_loading
   use camroller_study_probe, only : median
   use camroller_study_table, only : study_table_t, new_table, add_row
   use camroller_study_trials, only : least_error, nothing, patience, seconds_since, words_of
   implicit none
   private

   public :: new_contact_table, study_contacts

   !> Nodes of the trials and of their reference
   integer, parameter :: steady_nodes(*) = [33, 65, 129, 257, 513], reference_nodes = 1025
   !> What Newton's method may leave over [-]; change of load and speed of a warm start [-]
   real(wp), parameter :: tolerance = 1.0e-9_wp, warm_change = 1.01_wp
   !> Nodes from which a solution from nothing begins on coarser grids
   integer, parameter :: nested_nodes = 65
   !> Iterations of a warm start
   integer, parameter :: warm_iterations = 60

contains

   !> Table of steady films, one row a trial.
   subroutine new_contact_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call new_table(table, [quantity_t("contact", "", "which contact of the cycle", "study"), &
         & quantity_t("message", "", "what went wrong, or nothing", "study")], [ &
         & quantity_t("case", "1", "case of the sweep", "study"), &
         & quantity_t("cam_angle", "degree", "cam angle, full lift at 180", "study"), &
         & quantity_t("nodes", "1", "nodes across the contact", "study"), &
         & quantity_t("error_film_min", "1", "error of the smallest film over its value", "study"), &
         & quantity_t("error_film_central", "1", "error of the central film over its value", "study"), &
         & quantity_t("cold_time", "s", "median time from nothing", "study"), &
         & quantity_t("warm_time", "s", "median time from the solution at 1 % less load and speed", "study")])
   end subroutine new_contact_table

   !> Steady films at the angles where the load is largest and smallest, and where the film is thinnest.
   subroutine study_contacts(table, position, case, repeats)
      !> Table of steady films
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Trials whose median time counts
      integer, intent(in) :: repeats

      character(len=*), parameter :: names(*) = [character(len=13) :: "largest load", "smallest load", "thinnest film"]
      type(model_t) :: model
      type(ehl_contact_t) :: contact
      type(error_t), allocatable :: error
      ! Cam angles of the contacts [rad]
      real(wp) :: angles(size(names))
      integer :: i

      call plain_model(model, case, .false., error)
      if (.not. allocated(error)) call find_angles(model, angles, error)
      if (allocated(error)) then
         call add_row(table, words_of("", error%message), [real(position - 1, wp), nothing(6)])
         return
      end if
      do i = 1, size(names)
         contact = contact_there(model, angles(i))
         call study_contact(table, [real(position - 1, wp), modulo(180.0_wp + angles(i)/degree, 360.0_wp)], names(i), contact, &
            & repeats)
      end do
   end subroutine study_contacts

   !> Angles of the contacts of a cycle that are harder than others, in pure rolling and without friction.
   subroutine find_angles(model, angles, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Angle of the largest load, the smallest load, the thinnest expected film [rad]
      real(wp), intent(out) :: angles(3)
      !> Domain error where no angle has contact, or the contact is beyond the range of solutions
      type(error_t), allocatable, intent(out) :: error

      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      ! Extremes so far: loads [N/m], film [m]; angle [rad]
      real(wp) :: extremes(3), angle
      integer :: i, status

      extremes = [0.0_wp, huge(1.0_wp), huge(1.0_wp)]
      angles = 0.0_wp
      do i = 0, 359
         angle = i*degree - pi
         contact = contact_there(model, angle)
         if (contact%line_load <= 0.0_wp) cycle
         call new_ehl_problem(problem, contact, status)
         if (status /= in_range) then
            call raise_range(error, status)
            return
         end if
         call take(contact%line_load > extremes(1), 1, contact%line_load)
         call take(contact%line_load < extremes(2)*(1.0_wp - 1.0e-6_wp), 2, contact%line_load)
         call take(problem%expected_film*problem%film_scale < extremes(3), 3, problem%expected_film*problem%film_scale)
      end do

   contains

      !> A new extreme.
      subroutine take(is_new, number, value)
         !> Is it one?
         logical, intent(in) :: is_new
         !> Its number
         integer, intent(in) :: number
         !> Its value [unit of the extreme]
         real(wp), intent(in) :: value

         if (.not. is_new) return
         extremes(number) = value
         angles(number) = angle
      end subroutine take
   end subroutine find_angles

   !> An error for a contact that is out of range.
   subroutine raise_range(error, status)
      !> The error
      type(error_t), allocatable, intent(out) :: error
      !> What is out of range
      integer, intent(in) :: status

      call raise(error, kind_domain, "ehl: "//trim(range_text(status)))
   end subroutine raise_range

   !> Contact at a cam angle in pure rolling, smooth, under the load without friction; none where it is lost.
   function contact_there(model, angle) result(contact)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The contact
      type(ehl_contact_t) :: contact

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]
      real(wp) :: force
      integer :: status

      call evaluate_loading(model, angle, position, force, moments, status)
      contact%line_load = moments%total/position%normal_arm/model%contact_width
      contact%radius = position%equivalent_radius
      contact%modulus = model%modulus
      contact%entrainment_speed = abs(model%speed*position%surface_travel)
      contact%oil = model%oil
      if (allocated(model%ehl)) contact%is_compressible = model%ehl%compressible
   end function contact_there

   !> One contact on every grid.
   subroutine study_contact(table, place, name, contact, repeats)
      !> Table of steady films
      type(study_table_t), intent(inout) :: table
      !> Number of the case from 0 [-], cam angle [deg]
      real(wp), intent(in) :: place(2)
      !> Which contact it is
      character(len=*), intent(in) :: name
      !> The contact
      type(ehl_contact_t), intent(in) :: contact
      !> Trials whose median time counts
      integer, intent(in) :: repeats

      type(ehl_films_t) :: right, films
      ! Times from nothing and from a solution nearby [s]
      real(wp) :: times(2)
      integer :: i
      logical :: converged

      call time_contact(contact, reference_nodes, 1, right, times, converged)
      if (.not. converged) then
         call add_row(table, words_of(name, "no reference"), [place, nothing(5)])
         return
      end if
      do i = 1, size(steady_nodes)
         call time_contact(contact, steady_nodes(i), repeats, films, times, converged)
         if (converged) then
            call add_row(table, words_of(name, ""), [place, real(steady_nodes(i), wp), &
               & max(least_error, abs([films%minimum/right%minimum, films%central/right%central] - 1.0_wp)), times])
         else
            call add_row(table, words_of(name, "no solution"), [place, real(steady_nodes(i), wp), nothing(4)])
         end if
      end do
   end subroutine study_contact

   !> Films of a contact on one grid, and the times it took.
   subroutine time_contact(contact, nodes, repeats, films, times, converged)
      !> The contact
      type(ehl_contact_t), intent(in) :: contact
      !> Nodes
      integer, intent(in) :: nodes
      !> Trials whose median time counts
      integer, intent(in) :: repeats
      !> Films
      type(ehl_films_t), intent(out) :: films
      !> Time from nothing, and from a solution nearby [s]
      real(wp), intent(out) :: times(2)
      !> Was a solution found?
      logical, intent(out) :: converged

      type(ehl_contact_t) :: other
      type(ehl_problem_t) :: problem, nearby
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: coarse
      ! Times of the trials [s]
      real(wp) :: cold(max(repeats, 1)), warm(max(repeats, 1))
      integer(int64) :: first, start
      integer :: i, status

      call new_ehl_problem(problem, contact, status)
      other = contact
      other%line_load = contact%line_load/warm_change
      other%entrainment_speed = contact%entrainment_speed/warm_change
      call new_ehl_problem(nearby, other, status)
      call system_clock(first)
      do i = 1, size(cold)
         call system_clock(start)
         if (nodes < nested_nodes) then
            call solve_on_grid(problem, ehl_options_t(tolerance=tolerance), nodes, grid, state, films, converged)
         else
            call solve_on_grids(problem, ehl_options_t(nodes=nodes, tolerance=tolerance), grid, state, films, coarse, converged)
         end if
         cold(i) = seconds_since(start)
         if (.not. converged) return
         call solve_newton(nearby, grid, state, tolerance, warm_iterations, converged)
         call system_clock(start)
         if (converged) call solve_newton(problem, grid, state, tolerance, warm_iterations, converged)
         warm(i) = seconds_since(start)
         if (.not. converged) return
         if (seconds_since(first) > patience) exit
      end do
      i = min(i, size(cold))
      times = [median(cold(:i)), median(warm(:i))]
   end subroutine time_contact

end module camroller_study_contact
