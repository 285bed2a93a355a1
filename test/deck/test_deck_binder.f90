!> Tests of keys bound to components: what is declared is what is taken, in whatever order.
module test_deck_binder
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_deck_binder, only : declared_in, keys_t, taken_from
   use camroller_deck_matching, only : new_settings
   use camroller_deck_schema, only : anything, group_effect, group_standard, positive, schema_t
   use camroller_kinds, only : wp
   use camroller_settings, only : settings_t
   implicit none
   private

   public :: collect_deck_binder

   character(len=*), parameter :: shapes(*) = [character(len=6) :: "round", "square"]

   !> One component for each kind of key
   type :: part_t
      !> Length [m]
      real(wp) :: length = 0.25_wp
      !> Mass, which has no default [kg]
      real(wp) :: mass = 3.0_wp
      integer :: teeth = 7
      logical :: is_hollow = .true.
      character(len=6) :: shape = "square"
      character(len=:), allocatable :: label
      !> Places [m]
      real(wp), allocatable :: places(:)
      integer, allocatable :: counts(:)
   end type part_t

contains

   !> All tests of this suite.
   subroutine collect_deck_binder(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a key has the value of its variable as default, and gives it to a variable", default_is_taken), &
         new_unittest("a key without a value leaves its variable alone", no_value_changes_nothing), &
         new_unittest("keys and groups are found in another order than they were declared in", order_is_free), &
         new_unittest("an effect is wanted where it is declared, and where the deck has it", effect_is_wanted), &
         new_unittest("a choice without a variable has its first name as default", first_name_is_default), &
         new_unittest("usual ranges go with their keys", usual_is_declared) &
         ]
   end subroutine collect_deck_binder

   !> Keys of a part.
   subroutine bind_part(keys, part)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The part
      type(part_t), intent(inout) :: part

      call keys%group("part", group_standard, "a part")
      call keys%number("length_mm", positive, "its length", part%length, usual=[10.0_wp, 500.0_wp])
      call keys%number("mass_kg", positive, "its mass", part%mass, is_optional=.true.)
      call keys%whole_number("teeth", positive, "its teeth", part%teeth)
      call keys%choice("colour", shapes, "taken elsewhere")
      call keys%yes_or_no("is_hollow", "is it hollow?", part%is_hollow)
      call keys%choice("shape", shapes, "its shape", part%shape)
      call keys%text("label", "its label", part%label)
      call keys%numbers("places_mm", anything, "its places", part%places, is_optional=.true.)
      call keys%whole_numbers("counts", positive, "its counts", part%counts, is_optional=.true.)
      call keys%group("hole", group_effect, "a hole")
      call keys%number("length_mm", positive, "its length", part%length)
   end subroutine bind_part

   !> Schema of a part, and settings without a deck.
   subroutine declare(schema, settings)
      !> The schema
      type(schema_t), intent(out), target :: schema
      !> The settings, all of defaults
      type(settings_t), intent(out) :: settings

      type(keys_t) :: keys
      type(part_t) :: part

      part%label = "standard"
      keys = declared_in(schema)
      call bind_part(keys, part)
      call new_settings(schema, settings)
   end subroutine declare

   subroutine default_is_taken(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      type(settings_t), target :: settings
      type(keys_t) :: keys
      type(part_t) :: part

      call declare(schema, settings)
      settings%values(8)%numbers = [0.001_wp, 0.002_wp]
      settings%values(8)%is_known = .true.
      settings%values(9)%integers = [4, 5, 6]
      settings%values(9)%is_known = .true.
      part = part_t(0.0_wp, 0.0_wp, 0, .false., "round", "")
      keys = taken_from(settings)
      call bind_part(keys, part)
      ! a quarter of a metre is 250 mm without round-off, but for the factor of the unit
      call check(error, abs(part%length - 0.25_wp) <= epsilon(1.0_wp), "number")
      if (.not. allocated(error)) call check(error, part%teeth, 7)
      if (.not. allocated(error)) call check(error, part%is_hollow, "logical")
      if (.not. allocated(error)) call check(error, part%shape, "square")
      if (.not. allocated(error)) call check(error, part%label, "standard")
      if (.not. allocated(error)) call check(error, size(part%places) == 2 .and. size(part%counts) == 3, "lists")
      if (.not. allocated(error)) call check(error, sum(part%counts), 15)
   end subroutine default_is_taken

   subroutine no_value_changes_nothing(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      type(settings_t), target :: settings
      type(keys_t) :: keys
      type(part_t) :: part

      call declare(schema, settings)
      settings%values(3)%is_known = .false.
      part%teeth = 11
      keys = taken_from(settings)
      call bind_part(keys, part)
      call check(error, abs(part%mass - 3.0_wp) <= 0.0_wp .and. part%teeth == 11 .and. .not. allocated(part%places) &
         & .and. .not. allocated(part%counts))
   end subroutine no_value_changes_nothing

   subroutine order_is_free(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      type(settings_t), target :: settings
      type(keys_t) :: keys
      type(part_t) :: part
      ! Lengths of hole and part [m]
      real(wp) :: lengths(2)

      call declare(schema, settings)
      settings%values(1)%numbers = [0.5_wp]
      settings%groups(2)%is_present = .true.
      part = part_t(0.0_wp, 0.0_wp, 0, .false., "round", "")
      lengths = 0.0_wp
      keys = taken_from(settings)
      call keys%group("hole", group_effect, "a hole")
      call keys%number("length_mm", positive, "its length", lengths(1))
      call keys%group("part", group_standard, "a part")
      call keys%text("label", "its label", part%label)
      call keys%whole_number("teeth", positive, "its teeth", part%teeth)
      call keys%number("length_mm", positive, "its length", lengths(2))
      call keys%whole_number("teeth", positive, "its teeth", part%teeth)
      call check(error, part%label == "standard" .and. part%teeth == 7, "other kinds")
      if (.not. allocated(error)) call check(error, all(abs(lengths - [0.25_wp, 0.5_wp]) <= epsilon(1.0_wp)), "numbers")
   end subroutine order_is_free

   subroutine effect_is_wanted(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t), target :: schema
      type(settings_t), target :: settings
      type(keys_t) :: keys
      logical :: is_declared, is_there(2)
      integer :: i

      keys = declared_in(schema)
      call keys%group("hole", group_effect, "a hole")
      is_declared = keys%are_wanted(.false.)
      call new_settings(schema, settings)
      do i = 1, 2
         settings%groups(1)%is_present = i == 2
         keys = taken_from(settings)
         call keys%group("hole", group_effect, "a hole")
         is_there(i) = keys%are_wanted(.false.)
      end do
      call check(error, is_declared .and. is_there(2) .and. .not. is_there(1))
   end subroutine effect_is_wanted

   subroutine first_name_is_default(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      type(settings_t) :: settings

      call declare(schema, settings)
      call check(error, settings%values(4)%word, "round")
   end subroutine first_name_is_default

   subroutine usual_is_declared(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      type(settings_t) :: settings

      call declare(schema, settings)
      call check(error, schema%keys(1)%has_usual .and. .not. schema%keys(2)%has_usual .and. &
         & abs(schema%keys(1)%usual%smallest - 10.0_wp) + abs(schema%keys(1)%usual%largest - 500.0_wp) <= 0.0_wp)
   end subroutine usual_is_declared

end module test_deck_binder
