!> Cases drawn at random over everything that a deck may hold: each has a result that is right by more than one measure, or words
!> say why there is none. How they end is counted and printed.
!>
!> The environment variables WIDE_CASES and WIDE_SEED choose how many and which; `make random-wide` sets them. WIDE_FOLDER names a
!> folder for decks and tables of cases that fail and of a case run alone, WIDE_TRACE=1 has each seed printed before its case is
!> run.
module test_random_wide
   use, intrinsic :: iso_fortran_env, only : error_unit
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_accuracy, only : is_checked, has_tolerance, resolve_numerics
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_remarks, only : missed_accuracy, missed_means, missed_extremes, missed_hours
   use camroller_result, only : result_t
   use camroller_run, only : build_models, run_case
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_deck_keys, only : check_case
   use camroller_deck_keys, only : new_schema
   use camroller_deck_schema, only : schema_t, key_t, add_group, add_key, group_effect, positive, type_integer, type_logical, &
      & type_name, type_number
   use case_twins, only : compare_twins, leave_constants_out, rescale_case
   use case_endings, only : tally_t, count_ending, count_error, count_remarks, endings_table, ending_count
   use enclosed_series, only : check_enclosed
   use result_checks, only : check_result, compare_results, promised_error, scalar_of
   use run_settings, only : has_checks, number_from
   use unit_systems, only : unit_systems_tried
   use wide_decks, only : wide_deck_t, draw_wide_deck, save_wide_deck, is_left_out, left_out_groups
   use wide_draft, only : style_t
   use wide_numbers, only : usual_t, find_range
   use wide_words, only : deck_group, deck_word
   implicit none
   private

   public :: collect_random_wide

   !> Cases of a test run with and without run-time checks, and the seed of the first
   integer, parameter :: usual_cases = 4, few_cases = 1, usual_seed = 1
   !> One deck of so many has numbers at the ends of their ranges, and their part of all numbers [-]
   integer, parameter :: ends_stride = 4
   real(wp), parameter :: ends_share = 0.03_wp
   !> Marks of a key in many decks: left out, given; then both ends or each choice, of which there are fewer than that
   integer, parameter :: mark_absent = 1, mark_given = 2, most_marks = 40
   !> Part of the decks drawn that must have a result, lest nothing is tested [-]
   real(wp), parameter :: least_share = 0.25_wp
   !> Words of the error of a contour with a hollow narrower than the roller, which may be drawn
   character(len=*), parameter :: hollow_words = "does not touch the contour"

contains

   !> Collect the tests.
   subroutine collect_random_wide(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("random decks draw every choice of every key, each key given and left out, and both ends of every range", &
         test_coverage), &
         new_unittest("a new choice or group of the schema is drawn, and a new number without a range is a failure", &
            & test_new_keys), &
         new_unittest("groups that are not drawn exist in the schema, are few, and have a reason", test_exceptions), &
         new_unittest("no deck is drawn that contradicts itself: none is refused but for a contour that its roller does not fit", &
            & test_refusals), &
         new_unittest("random cases give the same results in other units, converted by the units in the results", test_units), &
         new_unittest("random cases with every option end with results that agree between methods, or with an error message", &
            & test_wide) &
         ]
   end subroutine collect_random_wide

   subroutine test_coverage(error)
      type(error_type), allocatable, intent(out) :: error
      ! Decks that are drawn; the rarest choice is in one of five hundred
      integer, parameter :: decks = 3000
      type(schema_t) :: schema
      character(len=:), allocatable :: missing

      if (has_checks()) return ! the same decks would be drawn again, 13 s long
      call new_schema(schema)
      call draw_missing(schema, decks, missing)
      if (missing /= "") call test_failed(error, "never drawn:"//missing)
   end subroutine test_coverage

   subroutine test_new_keys(error)
      type(error_type), allocatable, intent(out) :: error
      type(schema_t) :: schema
      character(len=:), allocatable :: missing
      integer :: i

      call new_schema(schema)
      do i = 1, schema%key_count
         associate (key => schema%keys(i))
            if (key%name == "shear_law") key%choices = [key%choices, [character(len=len(key%choices)) :: "of_tomorrow"]]
            if (key%name == "limiting_coefficient") key%name = "coefficient_of_tomorrow"
         end associate
      end do
      call add_group(schema, "group_of_tomorrow", group_effect, "")
      call add_key(schema, "number_of_tomorrow", type_number, "", positive, is_optional=.true.)
      schema%groups = schema%groups(:schema%group_count)
      schema%keys = schema%keys(:schema%key_count)
      call draw_missing(schema, 30, missing)
      if (index(missing, "shear_law 'of_tomorrow'") > 0) call test_failed(error, "a new choice is not drawn")
      if (index(missing, "traction.coefficient_of_tomorrow has no usual range") == 0) call test_failed(error, &
         & "a new number is not missed: "//missing)
      if (index(missing, "group_of_tomorrow.number_of_tomorrow has no usual range") == 0) call test_failed(error, &
         & "a new group is not missed: "//missing)
   end subroutine test_new_keys

   subroutine test_exceptions(error)
      type(error_type), allocatable, intent(out) :: error
      ! As many as there are good reasons for
      integer, parameter :: most = 1
      type(schema_t) :: schema
      integer :: i

      call new_schema(schema)
      if (size(left_out_groups, 2) > most) call test_failed(error, "more groups than one are not drawn")
      do i = 1, size(left_out_groups, 2)
         if (all(schema%groups%name /= left_out_groups(1, i))) call test_failed(error, "no group "//left_out_groups(1, i))
         if (left_out_groups(2, i) == "") call test_failed(error, "no reason for "//left_out_groups(1, i))
      end do
   end subroutine test_exceptions

   !> Draw decks and list what none of them has.
   subroutine draw_missing(schema, decks, missing)
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: decks
      character(len=:), allocatable, intent(out) :: missing
      ! Every deck has much of what is rare
      type(style_t), parameter :: style = style_t(ends_share=0.3_wp, ehl_share=0.3_wp, method_share=0.5_wp, dynamics_share=0.3_wp, &
         & hours_share=0.3_wp)
      type(wide_deck_t) :: deck
      character(len=:), allocatable :: word, lines
      logical :: is_seen(size(schema%keys), most_marks)
      integer :: seed, group, key

      missing = ""
      is_seen = .false.
      do seed = 1, decks
         call draw_wide_deck(seed, schema, style, deck)
         if (deck%unknown /= "" .and. index(missing, deck%unknown//" has no usual range") == 0) missing = missing//deck%unknown &
            & //" has no usual range in wide_numbers or wide_lists;"
         do group = 1, schema%group_count
            lines = deck_group(deck%text, trim(schema%groups(group)%name))
            do key = schema%groups(group)%first, schema%groups(group)%last
               word = deck_word(lines, trim(schema%groups(group)%name), trim(schema%keys(key)%name))
               call mark(schema%keys(key), trim(schema%groups(group)%name), word, is_seen(key, :))
            end do
         end do
      end do
      do group = 1, schema%group_count
         if (is_left_out(schema%groups(group)%name)) cycle
         do key = schema%groups(group)%first, schema%groups(group)%last
            call list_missing(schema%keys(key), trim(schema%groups(group)%name), is_seen(key, :), missing)
         end do
      end do
   end subroutine draw_missing

   !> Note what a deck has of a key: left out, given, near the lower and the upper end; or each choice.
   subroutine mark(key, group, word, is_seen)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: group, word
      logical, intent(inout) :: is_seen(:)
      type(usual_t) :: usual
      ! [unit of the key]
      real(wp) :: value
      logical :: is_known

      is_seen(merge(mark_absent, mark_given, word == "")) = .true.
      if (word == "") return
      select case (key%type)
      case (type_name)
         where (key%choices == word) is_seen(mark_given + 1:mark_given + size(key%choices)) = .true.
      case (type_logical)
         is_seen(mark_given + merge(1, 2, word == ".true.")) = .true.
      case (type_number, type_integer)
         read (word, *) value
         call find_range(group//"."//trim(key%name), usual, is_known)
         if (value < usual%lowest .or. value <= key%range%smallest) is_seen(mark_given + 1) = .true.
         if (value > usual%highest .or. value >= key%range%largest) is_seen(mark_given + 2) = .true.
      end select
   end subroutine mark

   !> Words for what was not seen of a key.
   subroutine list_missing(key, group, is_seen, missing)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: group
      logical, intent(in) :: is_seen(:)
      character(len=:), allocatable, intent(inout) :: missing
      character(len=:), allocatable :: name
      integer :: i

      name = " "//group//"."//trim(key%name)
      if (.not. is_seen(mark_given)) missing = missing//name//";"
      if (.not. (is_seen(mark_absent) .or. key%is_required .or. key%type == type_name)) missing = missing//name//" left out;"
      select case (key%type)
      case (type_name)
         do i = 1, size(key%choices)
            if (.not. is_seen(mark_given + i)) missing = missing//name//" '"//trim(key%choices(i))//"';"
         end do
      case (type_logical)
         if (.not. all(is_seen(mark_given + 1:mark_given + 2))) missing = missing//name//" both ways;"
      case (type_number, type_integer)
         if (.not. is_seen(mark_given + 1)) missing = missing//name//" at its lower end;"
         if (.not. is_seen(mark_given + 2)) missing = missing//name//" at its upper end;"
      end select
   end subroutine list_missing

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      ! Seeds among which the rarest contradictions were: a grade of oil that is not given, a pin wider than its law covers
      integer, parameter :: first = 920001, decks = 300
      type(schema_t) :: schema
      type(wide_deck_t) :: deck
      type(case_t) :: case
      character(len=:), allocatable :: trouble
      character(len=12) :: buffer
      integer :: seed

      call new_schema(schema)
      do seed = number_from("WIDE_SEED", first), number_from("WIDE_SEED", first) + decks - 1
         call draw_wide_deck(seed, schema, style_t(dynamics_share=0.5_wp), deck)
         call make_wide_case(deck, case, trouble)
         if (trouble == "" .or. index(trouble, hollow_words) > 0) cycle
         write (buffer, "(i0)") seed
         call test_failed(error, "seed "//trim(buffer)//": "//trouble)
         return
      end do
   end subroutine test_refusals

   subroutine test_units(error)
      type(error_type), allocatable, intent(out) :: error
      ! Cases with and without run-time checks; decks that are drawn for each at most
      integer, parameter :: usual = 20, few = 4, most_tries = 5
      ! Numbers agree to the last bit but where a power is not one of two: then rounding takes other steps, whose errors are within
      ! what is promised. A series follows the slip and is off by what the slip's error makes of it, which is what the estimate for
      ! extremes tells: the error of the slip alone says nothing of a force that grows steeply with it
      real(wp), parameter :: allowed = 2.0_wp
      type(schema_t) :: schema
      type(wide_deck_t) :: deck
      type(case_t) :: case
      character(len=:), allocatable :: list, trouble
      character(len=12) :: buffer
      integer :: seed, tested, wanted
      logical :: is_tested

      call new_schema(schema)
      wanted = number_from("WIDE_TWINS", merge(few, usual, has_checks()))
      list = ""
      tested = 0
      seed = number_from("WIDE_SEED", usual_seed) - 1
      do while (tested < wanted)
         seed = seed + 1
         if (seed > most_tries*(wanted + few) + number_from("WIDE_SEED", usual_seed)) exit
         call draw_wide_deck(seed, schema, style_t(ehl_share=0.0_wp, method_share=0.0_wp), deck)
         call make_wide_case(deck, case, trouble)
         if (trouble /= "") cycle
         call compare_units(case, allowed, is_tested, trouble)
         if (is_tested) tested = tested + 1
         write (buffer, "(i0)") seed
         if (trouble == "") cycle
         list = list//new_line("a")//"WIDE_SEED="//trim(buffer)//":"//trouble
         call save_wide_deck(deck, "units-"//trim(buffer), trouble)
      end do
      if (tested < wanted) list = list//new_line("a")//"too few decks have a result"
      if (list /= "") call test_failed(error, list)
   end subroutine test_units

   !> Case of a deck, or why there is none.
   subroutine make_wide_case(deck, case, trouble)
      type(wide_deck_t), intent(in) :: deck
      type(case_t), intent(out) :: case
      character(len=:), allocatable, intent(out) :: trouble
      type(deck_t) :: parsed
      type(override_t) :: none(0)
      type(error_t), allocatable :: error

      trouble = ""
      call parse_deck(parsed, deck%text, "random deck", "", none, error, deck%tables)
      if (.not. allocated(error)) call make_case(parsed, none, case, error)
      ! A case that is made so has no number outside of the range of its key
      if (.not. allocated(error)) call check_case(case, error)
      if (allocated(error)) trouble = error%message
   end subroutine make_wide_case

   !> A case in SI and in other units.
   subroutine compare_units(case, allowed, is_tested, trouble)
      type(case_t), intent(inout) :: case
      ! Difference, over what is promised [-]
      real(wp), intent(in) :: allowed
      logical, intent(out) :: is_tested
      character(len=:), allocatable, intent(out) :: trouble
      type(case_t) :: twin
      type(result_t) :: one, other
      type(error_t), allocatable :: error, twin_error
      ! Accuracy that the deck promises [-]
      real(wp) :: promised

      trouble = ""
      call leave_constants_out(case)
      ! An accuracy may have one of the two integrated again where its estimate is just above it
      promised = 0.0_wp
      if (is_checked(case%numerics)) then
         promised = case%numerics%accuracy
         case%numerics = resolve_numerics(case%numerics)
      end if
      twin = case
      call rescale_case(twin, unit_systems_tried(size(unit_systems_tried)))
      call run_case(case, one, error)
      call run_case(twin, other, twin_error)
      is_tested = .not. (allocated(error) .or. allocated(twin_error))
      if (allocated(error) .neqv. allocated(twin_error)) then
         if (allocated(error)) trouble = " an error in SI and no other units: "//error%message
         if (allocated(twin_error)) trouble = " an error in other units and not in SI: "//twin_error%message
      else if (is_tested) then
         trouble = compare_twins(one, other, unit_systems_tried(size(unit_systems_tried)), &
            & allowed*max(promised, promised_error(case, one, "estimated_error"), promised_error(case, one, &
            & "estimated_error_of_extremes"), promised_error(case, other, "estimated_error_of_extremes")))
      end if
   end subroutine compare_units

   subroutine test_wide(error)
      type(error_type), allocatable, intent(out) :: error
      ! Failures after which a run ends
      integer, parameter :: most_shown = 1000
      type(schema_t) :: schema
      type(wide_deck_t) :: deck
      type(style_t) :: style
      type(tally_t) :: tally
      character(len=:), allocatable :: list, trouble
      character(len=40) :: buffer
      integer :: seed, i, cases, failures
      ! [s]
      real(wp) :: start, finish

      call new_schema(schema)
      cases = number_from("WIDE_CASES", merge(few_cases, usual_cases, has_checks()))
      list = ""
      failures = 0
      do i = 1, cases
         seed = number_from("WIDE_SEED", usual_seed) + i - 1
         style%ends_share = merge(ends_share, 0.0_wp, modulo(seed, ends_stride) == 0)
         call draw_wide_deck(seed, schema, style, deck)
         write (buffer, "(a, i0)") "WIDE_SEED=", seed
         if (number_from("WIDE_TRACE", 0) > 0) write (error_unit, "(a)") trim(buffer)
         ! One deck is kept however it ends, also where it is stopped
         if (cases == 1) call save_wide_deck(deck, trim(buffer(11:)), "")
         call cpu_time(start)
         call check_deck(deck, style%ends_share > 0.0_wp, tally, trouble)
         call cpu_time(finish)
         if (finish - start > 20.0_wp .and. cases > usual_cases) write (error_unit, "(a, f7.1, a)") trim(buffer), finish - start, &
            & " s"
         if (trouble /= "") call save_wide_deck(deck, trim(buffer(11:)), trouble)
         if (trouble == "") cycle
         failures = failures + 1
         list = list//new_line("a")//trim(buffer)//":"//trouble
         if (cases > usual_cases) write (error_unit, "(2a)") trim(buffer)//":", trouble
         if (failures >= most_shown) exit
      end do
      write (error_unit, "(a)") endings_table(tally)
      if (cases >= few_cases .and. ending_count(tally, "result") < least_share*cases) list = list &
         & //new_line("a")//"too few decks have a result"
      if (list /= "") call test_failed(error, list)
   end subroutine test_wide

   !> One deck: read, built, run by its own and by an unlike method.
   subroutine check_deck(deck, with_ends, tally, trouble)
      type(wide_deck_t), intent(in) :: deck
      logical, intent(in) :: with_ends
      type(tally_t), intent(inout) :: tally
      character(len=:), allocatable, intent(out) :: trouble
      type(case_t) :: case
      ! Widest step of rows, which give means their scales: of four, all may have the second lobe at rest [rad]
      real(wp), parameter :: widest_step = 5.0_wp*degree
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: error
      type(result_t) :: result

      call make_wide_case(deck, case, trouble)
      case%numerics%output_step = min(case%numerics%output_step, widest_step)
      if (trouble /= "") then
         call count_ending(tally, "deck refused")
         trouble = " a deck within all ranges is refused: "//trouble
         if (with_ends .or. index(trouble, hollow_words) > 0) trouble = ""
         return
      end if
      call build_models(case, models, error)
      if (allocated(error)) then
         call count_error(tally, error, "no model:", trouble)
         return
      end if
      call run_case(case, result, error)
      if (allocated(error)) then
         call count_error(tally, error, "no result:", trouble)
         return
      end if
      call count_remarks(tally, result%remarks)
      trouble = trouble//check_result(case, result)//check_enclosed(case, result)
      if (is_checked(case%numerics)) trouble = trouble//missing_remarks(case, result)
      if (trouble == "") call compare_methods(case, result, tally, trouble)
      if (trouble /= "") call count_ending(tally, "SILENT: a result that is not right")
   end subroutine check_deck

   !> Estimates above the accuracy without a remark that says so. With hours of running those of means and extremes have the error
   !> over the hours in them, which has a remark of its own.
   function missing_remarks(case, result) result(trouble)
      type(case_t), intent(in) :: case
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble
      character(len=*), parameter :: estimates(*) = [character(len=27) :: "estimated_error", "estimated_error_of_means", &
         & "estimated_error_of_extremes"]
      integer, parameter :: kinds(*) = [missed_accuracy, missed_means, missed_extremes]
      integer :: i

      trouble = ""
      if (allocated(case%running_in)) then
         if (scalar_of(result, "estimated_error_of_running_in") > case%running_in%accuracy .and. all(result%remarks%kind &
            & /= missed_hours)) trouble = " the error over the hours above their accuracy without a remark;"
      end if
      do i = 1, merge(1, size(estimates), allocated(case%running_in))
         if (scalar_of(result, trim(estimates(i))) > case%numerics%accuracy .and. all(result%remarks%kind /= kinds(i))) then
            trouble = trouble//" "//trim(estimates(i))//" above the accuracy without a remark;"
         end if
      end do
   end function missing_remarks

   !> The same case by another method.
   subroutine compare_methods(case, one, tally, trouble)
      type(case_t), intent(in) :: case
      type(result_t), intent(in) :: one
      type(tally_t), intent(inout) :: tally
      character(len=:), allocatable, intent(inout) :: trouble
      type(case_t) :: changed
      type(result_t) :: other
      type(error_t), allocatable :: error

      ! Euler's steps and the quasi-static limit promise nothing
      if (.not. (is_checked(case%numerics) .or. has_tolerance(case%numerics))) return
      changed = case
      changed%numerics%method = "rodas5p"
      if (case%numerics%method == "rodas5p") changed%numerics%method = "radau5"
      call run_case(changed, other, error)
      if (allocated(error)) then
         call count_error(tally, error, "  no second result:", trouble)
         return
      end if
      trouble = trouble//check_result(changed, other)
      if (trouble /= "") return
      call compare_results(case, one, other, trouble)
   end subroutine compare_methods

end module test_random_wide
