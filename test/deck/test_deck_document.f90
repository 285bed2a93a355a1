!> Tests of decks described: the complete deck is a deck, what is echoed is what is used, every key says what it means.
module test_deck_document
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_error, only : error_t, kind_usage
   use camroller_deck, only : deck_t, override_t, read_deck
   use camroller_deck_document, only : echo_t, get_echo, write_defaults, write_page, write_resolved
   use camroller_deck_keys, only : new_schema
   use camroller_deck_schema, only : schema_t
   use deck_samples, only : parse_sample, sample_deck, changed_deck
   implicit none
   private

   public :: collect_deck_document

   character(len=*), parameter :: n = new_line("a")

contains

   !> All tests of this suite.
   subroutine collect_deck_document(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the complete deck is valid", complete_deck_is_valid), &
         new_unittest("each effect of the complete deck is valid", effects_are_valid), &
         new_unittest("one group can be had alone", one_group), &
         new_unittest("an unknown group is a usage error with advice", unknown_group), &
         new_unittest("the resolved deck comes to the same values", resolved_is_the_same), &
         new_unittest("the echo says what was given and what is a default", echo_tells_origin), &
         new_unittest("every key has a meaning, and a default or an example or neither", keys_have_meanings), &
         new_unittest("the page has a row for every key", page_is_complete), &
         new_unittest("a mark of UTF-8 at the start and blanks behind a path are none of a deck", mark_and_blanks_are_skipped) &
         ]
   end subroutine collect_deck_document

   subroutine complete_deck_is_valid(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: text

      call write_defaults("", text, raised)
      if (.not. allocated(raised)) call parse_sample(text, deck, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
   end subroutine complete_deck_is_valid

   subroutine effects_are_valid(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: groups(*) = [character(len=16) :: "asperity", "needle_bearing", "cam_bearings", &
         & "valve_guide"]
      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: text
      integer :: i

      do i = 1, size(groups)
         call write_defaults(trim(groups(i)), text, raised)
         call parse_sample(sample_deck()//text, deck, raised)
         if (allocated(raised)) call test_failed(error, raised%message)
         if (allocated(error)) return
      end do
   end subroutine effects_are_valid

   subroutine one_group(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      character(len=:), allocatable :: text

      call write_defaults("film", text, raised)
      call check(error, index(text, n//"&film"//n//"   law = 'dowson_higginson'") > 0 .and. index(text, "&case") == 0, text)
   end subroutine one_group

   subroutine unknown_group(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      character(len=:), allocatable :: text

      call write_defaults("flim", text, raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, raised%kind, kind_usage)
      if (allocated(error)) return
      call check(error, raised%message, "no group 'flim'; did you mean 'film'?")
   end subroutine unknown_group

   subroutine resolved_is_the_same(error)
      type(error_type), allocatable, intent(out) :: error

      type(override_t) :: none(0)
      type(deck_t) :: deck, again
      type(error_t), allocatable :: raised
      type(echo_t) :: echo, echo_again
      character(len=:), allocatable :: text
      integer :: i

      call read_deck(deck, "decks/thesis.nml", none, raised)
      if (.not. allocated(raised)) then
         call write_resolved(deck, text)
         call parse_sample(text, again, raised)
      end if
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call get_echo(deck, echo, .true.)
      call get_echo(again, echo_again, .true.)
      call check(error, size(echo_again%keys), size(echo%keys))
      if (allocated(error)) return
      call check(error, all(echo%keys == echo_again%keys) .and. &
         & all([(echo%values(i)%text == echo_again%values(i)%text, i=1, size(echo%keys))]))
   end subroutine resolved_is_the_same

   subroutine echo_tells_origin(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      type(echo_t) :: echo
      integer :: i

      call parse_sample(changed_deck("", "&film law = 'moes' /"), deck, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call get_echo(deck, echo, .true.)
      call check(error, .not. any(index(echo%keys, "asperity.") == 1), "an effect that is not in the deck")
      if (allocated(error)) return
      i = findloc(echo%keys, "film.law", dim=1)
      call check(error, echo%values(i)%text//" "//trim(echo%origins(i))//" "//trim(echo%units(i)), "'moes' given 1")
      if (allocated(error)) return
      call check(error, echo%is_used(i) .and. .not. echo%is_whole(i), "a film's law is a name that is used")
      if (allocated(error)) return
      i = findloc(echo%keys, "numerics.step_deg", dim=1)
      call check(error, .not. (echo%is_whole(i) .or. echo%is_used(i)), "a step of a method that has steps of its own")
      if (allocated(error)) return
      i = findloc(echo%keys, "numerics.max_cycles", dim=1)
      call check(error, echo%is_whole(i) .and. echo%is_used(i), "a whole number that is used")
      if (allocated(error)) return
      i = findloc(echo%keys, "spring.seat_stiffness_N_m", dim=1)
      call check(error, echo%values(i)%text//" "//trim(echo%origins(i))//" "//trim(echo%units(i)), "1e7 default N/m")
      if (allocated(error)) return
      i = findloc(echo%keys, "lift.closing_half_angle_deg", dim=1)
      call check(error, echo%values(i)%text//" "//trim(echo%origins(i)), "70 default")
   end subroutine echo_tells_origin

   subroutine keys_have_meanings(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      integer :: i

      call new_schema(schema)
      do i = 1, schema%key_count
         associate (key => schema%keys(i))
            call check(error, len(key%meaning) > 5, key%name)
            if (allocated(error)) return
            call check(error, .not. (allocated(key%default) .and. allocated(key%example)), key%name)
            if (allocated(error)) return
            call check(error, .not. key%is_required .or. allocated(key%example), "no example: "//key%name)
            if (allocated(error)) return
         end associate
      end do
   end subroutine keys_have_meanings

   subroutine page_is_complete(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: text
      integer :: i

      call new_schema(schema)
      call write_page("", text, raised)
      do i = 1, schema%key_count
         call check(error, index(text, "| `"//trim(schema%keys(i)%name)//"` |") > 0, schema%keys(i)%name)
         if (allocated(error)) return
      end do
   end subroutine page_is_complete

   subroutine mark_and_blanks_are_skipped(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      type(override_t) :: none(0)
      character(len=80) :: path

      call parse_sample(char(239)//char(187)//char(191)//sample_deck(), deck, raised)
      path = "decks/thesis.nml"
      if (.not. allocated(raised)) call read_deck(deck, path, none, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
   end subroutine mark_and_blanks_are_skipped

end module test_deck_document
