!> Tests of sweeps by the library: to a file in both ways, to the caller's own sink, stopped and continued.
module test_sweep
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller, only : wp, error_t, case_t, deck_t, override_t, parse_deck, result_t, run_case, get_summary, &
      & case_outcome_t, layout_t, find_quantity, monitor_t, run_sweep, sink_t, sweep_cases, sweep_options_t, sweep_report_t
   use camroller_deck, only : make_sweep_case
   use camroller_deck_sweep, only : sweep_size
   use camroller_error, only : kind_unfinished
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : open_file, read_numbers
   use camroller_system_file, only : remove_file
   use camroller_text_file, only : read_text_file
   use sample_result, only : scratch_path
   implicit none
   private

   public :: collect_sweep

   character(len=*), parameter :: torque = "mean_torque_friction"

   !> Takes one scalar of each case
   type, extends(sink_t) :: torques_t
      !> The scalar [N m], how often each case came, and how many rows its series have
      real(wp) :: torques(6) = 0.0_wp
      integer :: times(6) = 0, rows(6) = 0
   contains
      procedure :: take => take_torque
   end type torques_t

   !> Stops a sweep after its first cases
   type, extends(monitor_t) :: impatient_t
      !> Cases done so far
      integer :: done = 0
   contains
      procedure :: wants_stop => wants_stop_soon
      procedure :: show => note_progress
   end type impatient_t

contains

   !> All tests of this suite.
   subroutine collect_sweep(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a sink of the caller has every case once, with the bits of a case alone", sink_has_every_case), &
         new_unittest("a sink of the caller has series where they are asked for, until its monitor stops", series_until_stopped), &
         new_unittest("a file made directly and one of part files hold the same", both_ways_agree), &
         new_unittest("a sweep that was stopped is continued", stopped_and_continued) &
         ]
   end subroutine collect_sweep

   !> Six cases, one of which has no closed triangle.
   subroutine get_deck(deck, error)
      !> The deck
      type(deck_t), intent(out) :: deck
      !> File or deck error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      type(override_t) :: none(0)

      call read_text_file("decks/thesis.nml", text, error)
      if (allocated(error)) return
      text = text(:index(text, "&sweep") - 1)//"&output angle_step_deg = 10 / &numerics accuracy = 1e-3 / "// &
         & "&sweep key_1 = 'case.energy' values_1 = 'source', 'consistent' key_2 = 'mechanism.pivot_to_cam_mm' "// &
         & "values_2 = 31, 31.5, 60 /"
      call parse_deck(deck, text, "test deck", "decks/", none, error)
   end subroutine get_deck

   subroutine take_torque(self, number, outcome, layout, error)
      class(torques_t), intent(inout) :: self
      integer, intent(in) :: number
      type(case_outcome_t), intent(in) :: outcome
      type(layout_t), intent(in) :: layout
      type(error_t), allocatable, intent(out) :: error

      self%times(number) = self%times(number) + 1
      if (outcome%status /= 0) return
      if (allocated(outcome%series)) self%rows(number) = size(outcome%series, 1)
      self%torques(number) = outcome%summary(find_quantity(layout%summary, torque))
   end subroutine take_torque

   function wants_stop_soon(self) result(verdict)
      class(impatient_t), intent(inout) :: self
      logical :: verdict

      verdict = self%done > 0
   end function wants_stop_soon

   subroutine note_progress(self, done, total)
      class(impatient_t), intent(inout) :: self
      integer, intent(in) :: done, total

      self%done = min(done, total)
   end subroutine note_progress

   subroutine sink_has_every_case(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(torques_t) :: sink
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      real(wp) :: alone ! [N m]
      integer :: i

      call get_deck(deck, failure)
      if (.not. allocated(failure)) call sweep_cases(deck, sink, failure, threads=2)
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      call check(error, all(sink%times == 1) .and. all(sink%rows == 0), "a case came not once, or with series")
      do i = 1, sweep_size(deck%sweep)
         if (allocated(error)) return
         call make_sweep_case(deck, i, case, failure)
         call run_case(case, result, failure)
         alone = 0.0_wp
         if (.not. allocated(failure)) call get_summary(result, torque, alone, failure)
         call check(error, sink%torques(i), alone, thr=0.0_wp)
      end do
      if (.not. allocated(error)) call check(error, count(abs(sink%torques) > 0.0_wp), 4)
   end subroutine sink_has_every_case

   subroutine series_until_stopped(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(torques_t) :: sink
      type(impatient_t) :: monitor
      type(error_t), allocatable :: failure

      call get_deck(deck, failure)
      if (.not. allocated(failure)) call sweep_cases(deck, sink, failure, threads=1, with_series=.true., monitor=monitor)
      call check(error, allocated(failure), "it was not stopped")
      if (allocated(error)) return
      call check(error, failure%kind, kind_unfinished)
      if (allocated(error)) return
      ! Ten degrees from row to row
      call check(error, sum(sink%times) == monitor%done .and. monitor%done < 6 .and. count(sink%rows == 36) > 0, "no series")
   end subroutine series_until_stopped

   !> Torques of the cases of a file, which is removed.
   subroutine read_torques(path, torques, failure)
      !> Its path
      character(len=*), intent(in) :: path
      !> Torques; -1 in the place of not-a-number [N m]
      real(wp), allocatable, intent(out) :: torques(:)
      !> File error
      type(error_t), allocatable, intent(out) :: failure

      type(hdf5_object_t) :: file

      call open_file(file, path, failure)
      if (.not. allocated(failure)) call read_numbers(file, "/summary/"//torque, [0], [6], torques, failure)
      call discard_file(file)
      call remove_file(path)
      if (allocated(failure)) return
      where (ieee_is_nan(torques)) torques = -1.0_wp
   end subroutine read_torques

   subroutine both_ways_agree(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(sweep_options_t) :: options
      type(sweep_report_t) :: report
      type(error_t), allocatable :: failure
      real(wp), allocatable :: directly(:), in_parts(:) ! [N m]

      call get_deck(deck, failure)
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      options%is_direct = .true.
      call run_sweep(deck, scratch_path("directly.h5"), options, report, failure)
      call check(error, allocated(failure) .and. report%tally%failed == 2, "the cases without a triangle are not told")
      if (allocated(error)) return
      options = sweep_options_t(threads=2)
      call run_sweep(deck, scratch_path("parts.h5"), options, report, failure)
      call check(error, allocated(failure) .and. report%tally%failed == 2, "the cases without a triangle are not told")
      if (allocated(error)) return
      call read_torques(scratch_path("directly.h5"), directly, failure)
      if (.not. allocated(failure)) call read_torques(scratch_path("parts.h5"), in_parts, failure)
      call check(error, .not. allocated(failure), "a file cannot be read")
      if (.not. allocated(error)) call check(error, maxval(abs(directly - in_parts)), 0.0_wp, thr=0.0_wp)
      if (.not. allocated(error)) call check(error, count(directly < 0.0_wp), 2)
   end subroutine both_ways_agree

   subroutine stopped_and_continued(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(impatient_t) :: monitor
      type(sweep_report_t) :: report
      type(error_t), allocatable :: failure
      real(wp), allocatable :: torques(:) ! [N m]
      character(len=:), allocatable :: path

      path = scratch_path("stopped.h5")
      call get_deck(deck, failure)
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      call run_sweep(deck, path, sweep_options_t(threads=1), report, failure, monitor)
      call check(error, allocated(failure), "it was not stopped")
      if (allocated(error)) return
      call check(error, failure%kind, kind_unfinished)
      if (allocated(error)) return
      call run_sweep(deck, path, sweep_options_t(threads=1, is_resumed=.true.), report, failure)
      call check(error, report%tally%cases == 6 .and. report%tally%missing == 0, "cases are missing")
      if (allocated(error)) return
      call read_torques(path, torques, failure)
      call check(error, .not. allocated(failure), "the file cannot be read")
      if (.not. allocated(error)) call check(error, count(torques > 0.0_wp), 4)
   end subroutine stopped_and_continued

end module test_sweep
