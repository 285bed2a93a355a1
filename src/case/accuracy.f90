!> Choice of method and tolerance for a requested accuracy.
!>
!> In: numerics as given. Out: an error where they are not valid; numerics with a method and, unless the step is fixed, a
!> tolerance.
!>
!> The constants come from `camroller study`; `doc/accuracy_and_cost.md` has the results.
module camroller_accuracy
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : find_name
   use camroller_number_text, only : number_text
   use camroller_ode_methods, only : method_facts
   use camroller_case, only : numerics_t, automatic_method, quasi_static, method_choices
   implicit none
   private

   public :: check_numerics, is_within, above_zero, divides_turn, resolve_numerics, first_numerics, has_error_control, is_checked, &
      & has_tolerance, refine_tolerance, way_out, most_refinements, second_method, far_beyond, evaluations_allowed, &
      & largest_accuracy, largest_periodicity, largest_step, quadrature_part

   !> Method with the least work for errors from 1e-2 to 1e-8, or near it
   character(len=*), parameter :: chosen_method = "hermite"
   !> Method that takes over where that one fails and none is named: slower, and hardly ever at a loss
   character(len=*), parameter :: second_method = "rodas5p"
   !> Tolerance over accuracy: errors of the sliding speed stay within twice the tolerance with the chosen method, but extremes and
   !> means of steep forces are estimated at up to a hundred times it [-]
   real(wp), parameter :: tolerance_share = 0.01_wp
   !> Error of a mean over the tolerance of its cycle, for a whole cycle [-]: a twentieth of the accuracy
   real(wp), parameter :: quadrature_part = 15.0_wp
   !> Tolerance of the first try of a rigid train's result over that: a seventh more steps spare most cases a second try, which
   !> costs as much as the first [-]
   real(wp), parameter :: first_part = 0.3_wp
   !> Smallest tolerance that rounding leaves a meaning [-]
   real(wp), parameter :: least_tolerance = 1.0e-12_wp
   !> Part of the reduction asked for by the estimate that is taken beyond it; strongest reduction at once [-]
   real(wp), parameter :: refinement = 0.3_wp, strongest_refinement = 1.0e-3_wp
   !> Tolerance below which rounding is the likely reason why a cycle cannot be integrated [-]
   real(wp), parameter :: near_rounding = 1.0e-9_wp
   !> Periodicity over accuracy: where the spin is hardly damped, what is left comes again in each of many cycles [-]
   real(wp), parameter :: periodicity_share = 0.01_wp
   !> Least periodicity over a tolerance given by hand: a cycle that is begun a little differently takes other steps, which moves
   !> its end by some hundredths of the tolerance, so that no cycle need ever close more closely [-]
   real(wp), parameter :: least_periodicity_share = 0.1_wp
   !> Estimated error over a tolerance given by hand, from which on the tolerance says nothing of the error: estimates stay within
   !> 25 tolerances on all ordinary decks at tolerances of 1e-3 to 1e-6 [-]
   real(wp), parameter :: far_beyond = 100.0_wp
   !> Evaluations of a turn after which an implicit method is given up, at the tolerance below or a larger one. Hard decks take a
   !> tenth of that, and a table of thousands of rows half of it
   integer, parameter :: most_evaluations = 100000
   !> That tolerance [-]; exponent with which evaluations grow as it falls [-]
   real(wp), parameter :: usual_tolerance = 1.0e-4_wp, evaluations_exponent = 0.2_wp
   !> Times that a cycle is integrated again
   integer, parameter :: most_refinements = 4
   !> Smallest number above zero [any]
   real(wp), parameter :: above_zero = tiny(1.0_wp)
   !> Largest accuracy, tolerance and periodicity [-]: beyond them nothing is left of a sliding speed
   real(wp), parameter :: largest_accuracy = 0.1_wp, largest_periodicity = 1.0_wp
   !> Largest step of a method or between reported points [rad]
   real(wp), parameter :: largest_step = 90.0_wp*degree
   !> More reported points than a turn may have [-]
   real(wp), parameter :: too_many_points = 1.0e6_wp

contains

   !> Refuse numerics that mean nothing: those of a case that was made by hand, since decks are checked key by key.
   subroutine check_numerics(numerics, error)
      !> As given
      type(numerics_t), intent(in) :: numerics
      !> Deck error that names the component
      type(error_t), allocatable, intent(out) :: error

      integer :: position

      call find_name("integration method", numerics%method, method_choices, position, error)
      if (allocated(error)) return
      if (.not. is_within(numerics%accuracy, above_zero, largest_accuracy)) then
         call raise(error, kind_deck, "numerics: the accuracy must be above 0, and "//number_text(largest_accuracy)// &
            & " at most")
      else if (.not. is_within(numerics%tolerance, 0.0_wp, largest_accuracy)) then
         call raise(error, kind_deck, "numerics: the tolerance must be 0 (the accuracy decides), or above 0 and "// &
            & number_text(largest_accuracy)//" at most")
      else if (.not. is_within(numerics%step, above_zero, largest_step)) then
         call raise(error, kind_deck, "numerics: the step must be above 0, and "//number_text(largest_step/degree, 3)// &
            & " degrees (in radians) at most")
      else if (.not. is_within(numerics%periodicity, above_zero, largest_periodicity)) then
         call raise(error, kind_deck, "numerics: the periodicity must be above 0, and "// &
            & number_text(largest_periodicity)//" at most")
      else if (numerics%max_cycles < 1) then
         call raise(error, kind_deck, "numerics: max_cycles must be 1 or more")
      else if (.not. (is_within(numerics%output_step, above_zero, largest_step) .and. divides_turn(numerics%output_step))) then
         call raise(error, kind_deck, "numerics: output_step must be "//number_text(largest_step/degree, 3)// &
            & " degrees (in radians) at most, and a turn a whole "// &
            & "multiple of it, with fewer than a million points")
      end if
   end subroutine check_numerics

   !> Is a number finite and in a range?
   elemental function is_within(value, smallest, largest) result(verdict)
      !> The number, its smallest and its largest value [any]
      real(wp), intent(in) :: value, smallest, largest
      !> True where it is
      logical :: verdict

      verdict = ieee_is_finite(value)
      if (verdict) verdict = value >= smallest .and. value <= largest
   end function is_within

   !> Is a turn a whole multiple of a step between reported points?
   pure function divides_turn(step) result(verdict)
      !> Cam angle between reported points [rad]
      real(wp), intent(in) :: step
      !> True where it is, with fewer than a million points
      logical :: verdict

      ! Distance from a whole number that is taken for round-off, in steps [-]
      real(wp), parameter :: allowed = 1.0e-9_wp

      verdict = ieee_is_finite(step)
      if (verdict) verdict = step > two_pi/too_many_points
      if (verdict) verdict = abs(two_pi/step - anint(two_pi/step)) <= allowed*two_pi/step
   end function divides_turn

   !> Method, tolerance and periodicity where they are not given.
   pure function resolve_numerics(numerics) result(resolved)
      !> As given
      type(numerics_t), intent(in) :: numerics
      !> With all of them
      type(numerics_t) :: resolved

      resolved = numerics
      if (resolved%method == automatic_method) resolved%method = chosen_method
      if (.not. numerics%tolerance > 0.0_wp) resolved%tolerance = max(least_tolerance, tolerance_share*numerics%accuracy)
      if (is_checked(numerics)) then
         resolved%periodicity = max(least_tolerance, periodicity_share*numerics%accuracy)
      else
         resolved%periodicity = max(numerics%periodicity, least_periodicity_share*numerics%tolerance)
      end if
   end function resolve_numerics

   !> Numerics of the first try of a result whose means and extremes are to be as accurate as the sliding speed.
   pure function first_numerics(numerics) result(first)
      !> As given
      type(numerics_t), intent(in) :: numerics
      !> With method, tolerance and periodicity
      type(numerics_t) :: first

      first = resolve_numerics(numerics)
      if (is_checked(numerics)) first%tolerance = max(least_tolerance, first_part*first%tolerance)
   end function first_numerics

   !> Is the error to be held below the accuracy? Not where tolerance or step are given by hand.
   pure function is_checked(numerics) result(verdict)
      !> As given
      type(numerics_t), intent(in) :: numerics
      !> True where the accuracy is a promise
      logical :: verdict

      verdict = .not. numerics%tolerance > 0.0_wp .and. has_error_control(numerics%method)
   end function is_checked

   !> Is the tolerance given by hand, to a method that keeps to one?
   pure function has_tolerance(numerics) result(verdict)
      !> As given
      type(numerics_t), intent(in) :: numerics
      !> True where it is
      logical :: verdict

      verdict = numerics%tolerance > 0.0_wp .and. has_error_control(numerics%method)
   end function has_tolerance

   !> Does the method choose its steps by an error?
   pure function has_error_control(method) result(verdict)
      !> Its name, or that of the program's choice
      character(len=*), intent(in) :: method
      !> True where it does
      logical :: verdict

      verdict = method /= quasi_static .and. .not. any(method_facts%name == method .and. method_facts%companion_order == 0)
   end function has_error_control

   !> Evaluations that a turn may take with an implicit method.
   pure function evaluations_allowed(tolerance) result(evaluations)
      !> Tolerance, positive [-]
      real(wp), intent(in) :: tolerance
      !> So many
      integer :: evaluations

      evaluations = int(most_evaluations*max(1.0_wp, usual_tolerance/tolerance)**evaluations_exponent)
   end function evaluations_allowed

   !> Smaller tolerance for a cycle whose estimated error is above the accuracy.
   pure function refine_tolerance(tolerance, accuracy, estimated_error, least) result(finer)
      !> Tolerance of the last try, accuracy wanted, error estimated, smallest tolerance that makes sense here [-]
      real(wp), intent(in) :: tolerance, accuracy, estimated_error, least
      !> Tolerance of the next try [-]
      real(wp) :: finer

      ! Reductions in a decade [-]
      real(wp), parameter :: quarters = 4.0_wp

      finer = max(strongest_refinement, refinement*accuracy/estimated_error)
      ! Whole quarters of a decade: the rounding of an estimate does not change the steps that are taken
      if (finer < 1.0_wp) finer = 10.0_wp**(real(floor(quarters*log10(finer)), wp)/quarters)
      finer = tolerance*finer
      finer = max(finer, least, least_tolerance)
   end function refine_tolerance

   !> Other tolerance for a cycle that could not be integrated: a smaller one, since errors may keep a cycle from closing, or a
   !> larger one where rounding is in the way.
   pure function way_out(tolerance) result(other)
      !> Tolerance of the try that failed [-]
      real(wp), intent(in) :: tolerance
      !> Tolerance of the next try [-]
      real(wp) :: other

      if (tolerance < near_rounding) then
         other = tolerance/strongest_refinement
      else
         other = max(least_tolerance, tolerance*strongest_refinement)
      end if
   end function way_out

end module camroller_accuracy
