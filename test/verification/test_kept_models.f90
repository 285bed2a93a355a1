!> Tests of models kept from one case of a sweep to the next: whatever key varies, no bit changes. The deck has all groups but the
!> numerical film, whose tables are never kept.
module test_kept_models
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_case_loop, only : sweep_cases
   use camroller_case_record, only : case_outcome_t
   use camroller_case_sink, only : sink_t
   use camroller_deck, only : deck_t, override_t, parse_deck, make_sweep_case
   use camroller_deck_document, only : echo_t, get_echo
   use camroller_deck_schema, only : key_t, find_group, type_integer, type_logical, type_name, type_number
   use camroller_error, only : error_t
   use camroller_layout, only : layout_t
   use camroller_number_text, only : integer_text, number_text
   use camroller_result, only : result_t
   use camroller_run, only : run_case
   use camroller_text_file, only : read_text_file
   use closeness, only : has_failed
   use run_settings, only : has_checks
   implicit none
   private

   public :: collect_kept_models

   !> Keys that have to vary, at least: fewer mean that their values are not found; with run-time checks one key of so many varies
   integer, parameter :: least_keys = 60, checked_stride = 3

   !> Keeps the cases
   type, extends(sink_t) :: keeper_t
      type(case_outcome_t) :: outcomes(3)
   contains
      procedure :: take
   end type keeper_t

contains

   !> All tests of this suite.
   subroutine collect_kept_models(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("models kept from case to case give the same bits as new ones, whichever key varies", every_key) &
         ]
   end subroutine collect_kept_models

   subroutine take(self, number, outcome, layout, error)
      class(keeper_t), intent(inout) :: self
      integer, intent(in) :: number
      type(case_outcome_t), intent(in) :: outcome
      type(layout_t), intent(in) :: layout
      type(error_t), allocatable, intent(out) :: error

      self%outcomes(number) = outcome
      if (outcome%status == 0 .and. size(layout%summary) == 0) self%outcomes(number)%status = -1
   end subroutine take

   subroutine every_key(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(echo_t) :: echo
      type(error_t), allocatable :: failure
      type(override_t) :: none(0)
      character(len=:), allocatable :: text, values
      integer :: i, point, position, count, stride

      call read_text_file("decks/three_cam_head.nml", text, failure)
      if (.not. allocated(failure)) then
         text = text(:index(text, "&sweep") - 1)
         call parse_deck(deck, text, "deck", "decks/", none, failure)
      end if
      if (has_failed(failure, error)) return
      call get_echo(deck, echo, .true.)
      count = 0
      stride = merge(checked_stride, 1, has_checks())
      do i = 1, size(echo%keys), stride
         point = index(echo%keys(i), ".")
         position = findloc(deck%schema%keys%group == find_group(deck%schema, echo%keys(i) (:point - 1)) .and. &
            & deck%schema%keys%name == echo%keys(i) (point + 1:), .true., 1)
         values = ""
         if (position > 0) values = other_values(deck%schema%keys(position), echo%values(i)%text)
         if (values == "" .or. index(echo%keys(i), "output.") == 1 .or. index(echo%keys(i), "numerics.") == 1) cycle
         call vary_key(error, text, trim(echo%keys(i)), values, count)
         if (allocated(error)) return
      end do
      call check(error, count >= least_keys/stride, "only "//integer_text(count)//" keys could be varied")
   end subroutine every_key

   !> A value of a key and others beside it, as a sweep takes them; empty where the key cannot vary.
   function other_values(key, value) result(values)
      !> The key
      type(key_t), intent(in) :: key
      !> Its value
      character(len=*), intent(in) :: value
      !> The values
      character(len=:), allocatable :: values

      real(wp) :: number ! [unit of the key]
      integer :: status, i

      values = ""
      select case (key%type)
      case (type_number)
         read (value, *, iostat=status) number
         if (status /= 0) return
         values = value//", "//number_text(merge(0.98_wp*number, 0.01_wp, abs(number) > 0.0_wp), 15)
      case (type_integer)
         read (value, *, iostat=status) i
         if (status == 0) values = value//", "//integer_text(i + 1)
      case (type_logical)
         values = ".true., .false."
      case (type_name)
         values = value
         do i = 1, size(key%choices)
            if (index(value, "'"//trim(key%choices(i))//"'") == 0) exit
         end do
         if (i <= size(key%choices)) values = value//", '"//trim(key%choices(i))//"'"
      end select
   end function other_values

   !> Compute the cases of a sweep over one key one after the other, and each alone.
   subroutine vary_key(error, text, name, values, count)
      type(error_type), allocatable, intent(out) :: error
      !> Deck without a sweep
      character(len=*), intent(in) :: text
      !> The key, as `group.key`, and its values
      character(len=*), intent(in) :: name, values
      !> Keys varied so far
      integer, intent(inout) :: count

      type(deck_t) :: deck
      type(keeper_t) :: keeper
      type(case_t) :: case
      type(result_t) :: alone
      type(error_t), allocatable :: failure
      type(override_t) :: none(0)
      character(len=:), allocatable :: coarse
      integer :: i

      coarse = "&output angle_step_deg = 30 / "
      if (index(text, "&numerics") == 0) coarse = coarse//"&numerics accuracy = 1e-2 / "
      call parse_deck(deck, text//coarse//"&sweep key_1 = '"//name//"' values_1 = "//values//" /", "deck", "decks/", none, failure)
      ! values that do not go with the deck, or a key that cannot vary
      if (allocated(failure)) return
      call sweep_cases(deck, keeper, failure, threads=1)
      do i = 1, 2
         call make_sweep_case(deck, i, case, failure)
         if (.not. allocated(failure)) call run_case(case, alone, failure)
         call check(error, allocated(failure) .neqv. keeper%outcomes(i)%status == 0, name//": one fails and the other does not")
         if (allocated(error)) return
         if (allocated(failure)) cycle
         call check(error, size(alone%summary_values), size(keeper%outcomes(i)%summary))
         if (allocated(error)) return
         call check(error, all(transfer(alone%summary_values, [0_int64]) == transfer(keeper%outcomes(i)%summary, [0_int64])), &
            & name//" = "//values//": a bit differs")
         if (allocated(error)) return
      end do
      if (keeper%outcomes(1)%status == 0 .or. keeper%outcomes(2)%status == 0) count = count + 1
   end subroutine vary_key

end module test_kept_models
