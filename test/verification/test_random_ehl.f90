!> Decks drawn at random with a numerical film: as a film law, by two unlike methods and two accuracies of its table; and with
!> contacts solved over the cycle, on three grids with two step errors. Whatever runs agrees within what is promised, or words say
!> why there is no number.
!>
!> The environment variables RANDOM_EHL_CASES and RANDOM_EHL_SEED choose how many and which, on a finer grid too, and
!> RANDOM_EHL_TABLE has a line printed for each; `make random-ehl` sets them.
module test_random_ehl
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : error_unit
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_deck, kind_domain, kind_convergence
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_ehl_profiles, only : plain_model
   use camroller_ehl_summary, only : ehl_summary_t, compare_cycles, film_difference, slip_difference
   use camroller_model, only : model_t
   use camroller_result, only : result_t, get_series, get_summary
   use camroller_run, only : run_case
   use ehl_checks, only : cycle_facts_t, solve_and_check
   use random_decks, only : random_t, start_random, random_deck
   use run_settings, only : has_checks, number_from
   implicit none
   private

   public :: collect_random_ehl

   !> Seeds of a usual run, of which one with run-time checks: an ordinary case; a small slip that hardly anything damps;
   !> an oil so thick that the film is millimetres; a spike for which two grids differ by a fifth of the slip; a film of ten
   !> nanometres; one that asperities carry nearly all of
   integer, parameter :: usual_seeds(*) = [7, 9, 2, 5, 14, 17]
   !> Accuracies of the table [-]
   real(wp), parameter :: accuracies(2) = [0.03_wp, 0.01_wp]
   !> What two grids of a case that has numbers may differ by, hence what its numbers are good to; growth of the total variation of
   !> the slip with ten times smaller errors of a step [-]
   real(wp), parameter :: promised = 1.0e-2_wp, most_variation = 1.25_wp
   !> Part of the speed of pure rolling that counts as no slip [-]
   real(wp), parameter :: least_slip = 1.0e-5_wp

   !> What came of a case
   type :: outcome_t
      !> Does the deck describe a geometry; did it end with words?
      logical :: is_possible = .true., has_ended = .false.
      !> What is wrong, and the words or numbers that it ended with
      character(len=:), allocatable :: trouble, words
   end type outcome_t

contains

   !> Collect the tests.
   subroutine collect_random_ehl(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("two methods and two accuracies agree for random cases with a numerical film law", test_law), &
         new_unittest("random cycles of solved contacts agree on three grids and for two step errors", test_cycle) &
         ]
   end subroutine collect_random_ehl

   subroutine test_law(error)
      type(error_type), allocatable, intent(out) :: error

      call test_cases(check_law, "law", error)
   end subroutine test_law

   subroutine test_cycle(error)
      type(error_type), allocatable, intent(out) :: error

      call test_cases(check_cycle, "cycle", error)
   end subroutine test_cycle

   !> Draw cases and check them.
   subroutine test_cases(check_case, kind, error)
      interface
         subroutine check_case(case, outcome)
            import :: case_t, outcome_t
            implicit none
            type(case_t), intent(in) :: case
            type(outcome_t), intent(inout) :: outcome
         end subroutine check_case
      end interface
      character(len=*), intent(in) :: kind
      type(error_type), allocatable, intent(out) :: error
      type(random_t) :: random
      type(outcome_t) :: outcome
      character(len=:), allocatable :: text, list
      character(len=80) :: buffer
      integer :: seed, last, drawn, tested, ended
      ! [s]
      real(wp) :: start, finish, longest

      last = number_from("RANDOM_EHL_CASES", merge(1, size(usual_seeds), has_checks()))
      list = ""
      tested = 0
      drawn = 0
      ended = 0
      longest = 0.0_wp
      do while (tested < last .and. drawn < 10*last + 10)
         drawn = drawn + 1
         seed = number_from("RANDOM_EHL_SEED", 1) + drawn - 1
         if (.not. is_long_draw()) seed = usual_seeds(drawn)
         call start_random(random, seed)
         call random_deck(random, text)
         text = text//ehl_group(seed)
         call cpu_time(start)
         call check_text(text, check_case, outcome)
         call cpu_time(finish)
         longest = max(longest, finish - start)
         if (outcome%is_possible) tested = tested + 1
         if (outcome%has_ended) ended = ended + 1
         write (buffer, "(a, i0, a, f0.1, a)") "RANDOM_EHL_SEED=", seed, " "//kind//" ", finish - start, " s: "
         if (outcome%trouble /= "") list = list//new_line("a")//trim(buffer)//" "//outcome%trouble//new_line("a")//text
         if (number_from("RANDOM_EHL_TABLE", 0) > 0 .and. outcome%is_possible) write (error_unit, "(5a)") trim(buffer), " ", &
            & outcome%trouble, " | ", outcome%words
      end do
      write (buffer, "(3(i0, a), f0.1, a)") tested, " cases of ", drawn, " decks: ", ended, " ended with words; longest: ", &
         & longest, " s"
      write (error_unit, "(2a)") "   ", trim(buffer)
      if (ended == tested) list = list//new_line("a")//"nothing was compared"
      if (list /= "") call test_failed(error, list)
   end subroutine test_cases

   !> Group `&ehl` of a deck: each key one way or the other.
   function ehl_group(seed) result(text)
      integer, intent(in) :: seed
      character(len=:), allocatable :: text

      text = "&ehl"//new_line("a")
      if (modulo(seed, 5) == 0) text = text//"   compressible = .false."//new_line("a")
      if (modulo(seed, 3) == 0) text = text//"   flow_factors = .true."//new_line("a")
      if (modulo(seed, 4) == 0) text = text//"   shear_thinning = .false."//new_line("a")
      text = text//"/"//new_line("a")
   end function ehl_group

   !> Make a case of a deck and check it.
   subroutine check_text(text, check_case, outcome)
      character(len=*), intent(in) :: text
      interface
         subroutine check_case(case, outcome)
            import :: case_t, outcome_t
            implicit none
            type(case_t), intent(in) :: case
            type(outcome_t), intent(inout) :: outcome
         end subroutine check_case
      end interface
      type(outcome_t), intent(out) :: outcome
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure

      outcome%trouble = ""
      outcome%words = ""
      call parse_deck(deck, text, "random deck", "", none, failure)
      if (.not. allocated(failure)) call make_case(deck, none, case, failure)
      if (allocated(failure)) then
         outcome%trouble = failure%message
         return
      end if
      call plain_model(model, case, .false., failure)
      outcome%is_possible = .not. allocated(failure)
      if (outcome%is_possible) call check_case(case, outcome)
   end subroutine check_text

   !> The numerical film as a law: two methods, then a finer table.
   subroutine check_law(case, outcome)
      type(case_t), intent(in) :: case
      type(outcome_t), intent(inout) :: outcome
      type(case_t) :: changed
      type(result_t) :: results(3)
      type(error_t), allocatable :: failure
      integer :: i

      changed = case
      do i = 1, 3
         changed%ehl%accuracy = accuracies(merge(2, 1, i == 3))
         changed%numerics%method = "automatic"
         if (i == 2) changed%numerics%method = "rodas5p"
         call run_case(changed, results(i), failure)
         if (allocated(failure)) then
            call end_with_words(failure, outcome)
            return
         end if
      end do
      call compare_methods(results(1), results(2), outcome)
      if (outcome%trouble == "") call compare_tables(results(1), results(3), outcome)
   end subroutine check_law

   !> An error: is it one that may be, and does it say where?
   subroutine end_with_words(failure, outcome)
      type(error_t), intent(in) :: failure
      type(outcome_t), intent(inout) :: outcome

      outcome%has_ended = .true.
      outcome%words = failure%message
      if (all(failure%kind /= [kind_deck, kind_domain, kind_convergence])) outcome%trouble = failure%message
   end subroutine end_with_words

   !> Do two results agree within what they promise?
   subroutine compare_methods(one, other, outcome)
      type(result_t), intent(in) :: one, other
      type(outcome_t), intent(inout) :: outcome
      type(error_t), allocatable :: error
      ! Sliding speeds and rolling speed [m/s]; errors estimated, scale [m/s], difference
      real(wp), allocatable :: first(:), second(:), rolling(:)
      real(wp) :: estimates(2), found, allowed
      character(len=100) :: buffer
      real(wp), parameter :: accuracy = 1.0e-3_wp

      call get_series(one, "sliding_speed", first, error)
      call get_series(other, "sliding_speed", second, error)
      call get_series(one, "rolling_speed", rolling, error)
      call get_summary(one, "estimated_error", estimates(1), error)
      call get_summary(other, "estimated_error", estimates(2), error)
      found = maxval(abs(first - second))/max(maxval(abs(first)), maxval(abs(second)), least_slip*maxval(abs(rolling)))
      allowed = sum(max(estimates, accuracy))
      write (buffer, "(2(a, es9.2))") "methods", found, " allowed", allowed
      outcome%words = trim(buffer)
      ! A largest value leaves out what is not a number
      if (.not. (found <= allowed .and. all(ieee_is_finite([first, second])))) outcome%trouble = "sliding speeds by two methods"
   end subroutine compare_methods

   !> Do films by a coarse and a fine table agree? They are judged at the speed that each run has.
   subroutine compare_tables(coarse, fine, outcome)
      type(result_t), intent(in) :: coarse, fine
      type(outcome_t), intent(inout) :: outcome
      character(len=*), parameter :: names(2) = [character(len=22) :: "film_thickness_min", "film_thickness_central"]
      type(error_t), allocatable :: error
      ! [m], [m/s]
      real(wp), allocatable :: one(:), other(:), speed(:), slip(:), slips(:), loads(:)
      ! Tables reach down to a thousandth of the largest load and speed in pure rolling [-]
      real(wp), parameter :: part = 2.0e-3_wp
      real(wp) :: found, outside
      character(len=100) :: buffer
      integer :: i

      ! Where nothing is compared, or what is not a number, the largest difference is no number to go by either
      call get_series(coarse, "entrainment_speed", speed, error)
      call get_series(coarse, "sliding_speed", slip, error)
      call get_series(fine, "sliding_speed", slips, error)
      call get_series(coarse, "contact_load", loads, error)
      call get_summary(coarse, "outside_film_range_share", outside, error)
      do i = 1, 2
         call get_series(coarse, trim(names(i)), one, error)
         call get_series(fine, trim(names(i)), other, error)
         ! A film grows with less than the first power of the speed, and each run has its own
         found = maxval(abs(one - other)/max(one, other, tiny(1.0_wp)) - 0.5_wp*abs(slip - slips)/max(abs(speed), tiny(1.0_wp)), &
            & mask=loads > part*maxval(loads) .and. abs(speed) > part*maxval(abs(speed)))
         write (buffer, "(a, f9.4, a, f6.3)") trim(names(i)), found, " outside", outside
         outcome%words = outcome%words//"; "//trim(buffer)
         if (.not. (found <= sum(accuracies) .and. found > -huge(1.0_wp) .and. all(ieee_is_finite([one, other])))) then
            outcome%trouble = outcome%trouble//" "//trim(names(i))//" by two tables"
         end if
      end do
   end subroutine compare_tables

   !> Contacts solved over the cycle: on two grids as the command does it, and with other steps and nodes.
   subroutine check_cycle(case, outcome)
      type(case_t), intent(in) :: case
      type(outcome_t), intent(inout) :: outcome
      ! Nodes and errors of a step: the two that the command compares, larger errors, a coarse grid, and a fine one in a long draw
      integer, parameter :: nodes(5) = [65, 129, 65, 33, 257]
      real(wp), parameter :: step_errors(5) = [1.0e-3_wp, 1.0e-3_wp, 1.0e-2_wp, 1.0e-2_wp, 1.0e-3_wp]
      type(model_t) :: model
      type(cycle_facts_t) :: facts(5)
      type(ehl_summary_t) :: summaries(5)
      type(error_t), allocatable :: failure
      character(len=80) :: buffer
      integer :: i

      call plain_model(model, case, .false., failure)
      do i = 1, merge(5, 4, is_long_draw())
         call solve_and_check(model, nodes(i), step_errors(i), facts(i), outcome%trouble, failure, summaries(i))
         write (buffer, "(i0, a, es8.1, 2(a, i0), a)") nodes(i), " nodes,", step_errors(i), ": ", facts(i)%steps, "-", &
            & facts(i)%refused, " steps; "
         outcome%words = outcome%words//trim(buffer)//" "
         if (.not. allocated(failure) .and. i == 2) call compare_cycles(summaries(1), summaries(2), promised, failure)
         ! The coarse grid is none that the command has
         if (allocated(failure) .and. i == 4) outcome%words = outcome%words//failure%message//"; "
         if (allocated(failure) .and. i /= 4) call end_with_words(failure, outcome)
         if (outcome%has_ended) return
         if (i == 3) call compare_summaries(summaries(3), summaries(1), "steps", 3.0_wp*step_errors(3), outcome)
         if (i == 3 .and. facts(1)%variation > most_variation*facts(3)%variation) outcome%trouble = outcome%trouble &
            & //" the slip chatters;"
         if (i == 4 .and. .not. allocated(failure)) then
            call compare_summaries(summaries(4), summaries(3), "33 nodes", huge(1.0_wp), outcome)
         end if
         if (i == 5) call compare_summaries(summaries(2), summaries(5), "257 nodes", promised, outcome)
      end do
   end subroutine check_cycle

   !> Is this a draw of many cases, which may take its time?
   function is_long_draw() result(is_long)
      logical :: is_long

      is_long = number_from("RANDOM_EHL_CASES", 0) > 0
   end function is_long_draw

   !> What two cycles differ by, and whether that is more than it may be.
   subroutine compare_summaries(one, other, what, allowed, outcome)
      type(ehl_summary_t), intent(in) :: one, other
      character(len=*), intent(in) :: what
      ! [-]
      real(wp), intent(in) :: allowed
      type(outcome_t), intent(inout) :: outcome
      ! Differences of films and mean slip [-]
      real(wp) :: found(2)
      character(len=80) :: buffer

      found = [film_difference(one, other), slip_difference(one, other)]
      write (buffer, "(a, 2(es8.1, a))") what//": film", found(1), " slip", found(2), ";"
      outcome%words = outcome%words//trim(buffer)//" "
      if (.not. maxval(found) <= allowed) outcome%trouble = outcome%trouble//" "//trim(buffer)
   end subroutine compare_summaries

end module test_random_ehl
