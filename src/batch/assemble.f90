!> One result file from part files: cases in their order, whoever computed them.
!>
!> In: an index of part files, an open result file. Out: every case written once, in order, from one record in
!> memory at a time; how many failed. Quantities stand in the order in which the cases bring them, so that the file depends on
!> the cases alone.
module camroller_assemble
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_internal
   use camroller_case_record, only : outcome_t, take_case, take_header
   use camroller_case_runs, only : sort_entries
   use camroller_layout, only : join_layouts, layout_t, places_of
   use camroller_mistakes, only : line_t
   use camroller_output, only : output_t, set_layout, write_outcome
   use camroller_output_file, only : not_computed
   use camroller_part_file, only : read_record
   use camroller_part_scan, only : entry_t, index_t
   use camroller_profile_file, only : profile_file_t, put_profiles, close_profiles
   use camroller_raw_file, only : close_raw, open_raw, raw_file_t
   use camroller_record, only : record_t
   use camroller_remarks, only : remarks_t, note_remarks
   implicit none
   private

   public :: tally_t, assemble

   !> What happened to the cases
   type :: tally_t
      !> Cases in all, without a result, not computed
      integer :: cases = 0, failed = 0, missing = 0
      !> First failure
      type(error_t), allocatable :: failure
      !> Remarks by kind
      type(remarks_t) :: remarks
   end type tally_t

contains

   !> Write all cases of part files.
   subroutine assemble(index, paths, cases, is_sparse, writer, tally, error)
      !> What the files hold; gets sorted
      type(index_t), intent(inout) :: index
      !> Their paths
      type(line_t), intent(in) :: paths(:)
      !> Number of cases
      integer, intent(in) :: cases
      !> Do only few cases have series?
      logical, intent(in) :: is_sparse
      !> The result file, without a layout
      type(output_t), intent(inout) :: writer
      !> What happened to the cases
      type(tally_t), intent(out) :: tally
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t), allocatable :: files(:)
      type(profile_file_t) :: profiles
      type(layout_t) :: joint
      integer :: i, next

      tally%cases = cases
      call sort_entries(index%entries(:index%count))
      allocate (files(size(paths)))
      do i = 1, size(paths)
         if (.not. allocated(error)) call open_raw(files(i), paths(i)%text, .false., error)
      end do
      call find_joint(index, joint)
      if (.not. allocated(error)) call set_layout(writer, joint, is_sparse, error)
      next = 1
      do i = 1, index%count
         if (allocated(error)) exit
         associate (entry => index%entries(i))
            if (entry%first + entry%count <= next) cycle
            call write_missing(writer, profiles, joint, next, entry%first - 1, tally, error)
            if (allocated(error)) exit
            call write_entry(index, entry, files(entry%part), joint, writer, profiles, next, tally, error)
         end associate
      end do
      if (.not. allocated(error)) call write_missing(writer, profiles, joint, next, cases, tally, error)
      call close_profiles(profiles)
      do i = 1, size(files)
         call close_raw(files(i))
      end do
   end subroutine assemble

   !> Layout of all cases.
   subroutine find_joint(index, joint)
      !> What the files hold, sorted
      type(index_t), intent(in) :: index
      !> Layout with every quantity
      type(layout_t), intent(out) :: joint

      logical :: is_joined(index%layouts%count)
      integer :: i

      is_joined = .false.
      do i = 1, index%count
         if (index%entries(i)%layout == 0) cycle
         if (is_joined(index%entries(i)%layout)) cycle
         is_joined(index%entries(i)%layout) = .true.
         call join_layouts(joint, index%layouts%items(index%entries(i)%layout))
      end do
      if (.not. allocated(joint%summary)) allocate (joint%summary(0), joint%series(0), joint%angle(0))
   end subroutine find_joint

   !> Write the cases of a record, from the next one that is wanted on.
   subroutine write_entry(index, entry, file, joint, writer, profiles, next, tally, error)
      !> What the files hold
      type(index_t), intent(in) :: index
      !> The record
      type(entry_t), intent(in) :: entry
      !> The file it is in
      type(raw_file_t), intent(in) :: file
      !> Layout of all cases
      type(layout_t), intent(in) :: joint
      !> The result file, and profiles in it
      type(output_t), intent(inout) :: writer
      type(profile_file_t), intent(inout) :: profiles
      !> Next case that is wanted, from 1
      integer, intent(inout) :: next
      !> What happened to the cases
      type(tally_t), intent(inout) :: tally
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(layout_t) :: layout
      type(record_t) :: record
      type(outcome_t) :: outcome
      integer, allocatable :: summary_places(:), series_places(:)
      integer :: first, count, unused, i

      call read_record(file, entry, record, error)
      if (allocated(error)) return
      call take_header(record, first, count, unused)
      allocate (layout%summary(0), layout%series(0), layout%angle(0))
      if (entry%layout > 0) layout = index%layouts%items(entry%layout)
      summary_places = places_of(layout%summary, joint%summary)
      series_places = places_of(layout%series, joint%series)
      do i = first, first + count - 1
         call take_case(record, layout, outcome)
         if (i < next) cycle
         call count_case(i, outcome, tally)
         call write_one(writer, profiles, i, outcome, joint, summary_places, series_places, error)
         if (allocated(error)) return
      end do
      next = first + count
      if (record%is_short) call raise(error, kind_internal, "'"//file%path//"' holds a record shorter than its stated length")
   end subroutine write_entry

   !> Write one case, its quantities at their places among those of all cases.
   subroutine write_one(writer, profiles, position, outcome, joint, summary_places, series_places, error)
      !> The result file, and profiles in it
      type(output_t), intent(inout) :: writer
      type(profile_file_t), intent(inout) :: profiles
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> The case
      type(outcome_t), intent(in) :: outcome
      !> Layout of all cases
      type(layout_t), intent(in) :: joint
      !> Places of its scalars and series
      integer, intent(in) :: summary_places(:), series_places(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! Scalars and series of all layouts [units as in the layout]
      real(wp), allocatable :: summary(:), series(:, :)

      allocate (summary(size(joint%summary)), source=not_a_number())
      if (outcome%status == 0) summary(summary_places) = outcome%summary
      if (allocated(outcome%series)) then
         allocate (series(size(joint%angle), size(joint%series)), source=not_a_number())
         series(:, series_places) = outcome%series
      else
         allocate (series(0, 0))
      end if
      call write_outcome(writer, position, outcome%status, outcome%text, summary, series, error)
      if (.not. allocated(error)) call put_profiles(profiles, writer, position, outcome%profiles, error)
   end subroutine write_one

   !> Write cases that no part file has.
   subroutine write_missing(writer, profiles, joint, first, last, tally, error)
      !> The result file, and profiles in it
      type(output_t), intent(inout) :: writer
      type(profile_file_t), intent(inout) :: profiles
      !> Layout of all cases
      type(layout_t), intent(in) :: joint
      !> First and last of them, from 1; none where the last comes before the first
      integer, intent(in) :: first, last
      !> What happened to the cases
      type(tally_t), intent(inout) :: tally
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(outcome_t) :: outcome
      integer :: i

      outcome%status = not_computed
      outcome%text = ""
      do i = first, last
         tally%missing = tally%missing + 1
         call write_one(writer, profiles, i, outcome, joint, [integer ::], [integer ::], error)
         if (allocated(error)) return
      end do
   end subroutine write_missing

   !> Count a case.
   subroutine count_case(number, outcome, tally)
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> The case
      type(outcome_t), intent(in) :: outcome
      !> What happened to the cases
      type(tally_t), intent(inout) :: tally

      if (outcome%status /= 0) then
         tally%failed = tally%failed + 1
         if (tally%failed == 1) call raise(tally%failure, outcome%status, outcome%text)
      else
         call note_remarks(tally%remarks, number, outcome%remarks)
      end if
   end subroutine count_case

   !> Not-a-number.
   pure function not_a_number() result(number)
      !> The number [-]
      real(wp) :: number

      number = ieee_value(1.0_wp, ieee_quiet_nan)
   end function not_a_number

end module camroller_assemble
