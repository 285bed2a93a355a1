!> Cases that are compared with those of a result file, bit by bit.
!>
!> In: records, a result file. Out: which quantities differ, in how many cases, by how much.
module camroller_comparison_sink
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, not_a_number
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_case_record, only : case_outcome_t, take_case, take_header
   use camroller_case_sink, only : sink_t
   use camroller_ehl_file, only : sample_record
   use camroller_ehl_record, only : ehl_record_t, list_ehl_quantities
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : has_member, read_numbers
   use camroller_history_file, only : history_group
   use camroller_layout, only : layout_t
   use camroller_output_cases, only : group_of_source
   use camroller_record, only : record_t
   use camroller_result, only : quantity_t
   implicit none
   private

   public :: comparison_sink_t, difference_t, compare_record, compare_missing

   !> How a quantity differs
   type :: difference_t
      !> Its name in the file, e.g. `summary/mean_torque_drive`
      character(len=:), allocatable :: name
      !> Cases in which it does
      integer :: cases = 0
      !> Largest difference relative to the larger of both values [-]; huge where one of them is no number
      real(wp) :: largest = 0.0_wp
      !> Case of the largest difference, from 0; the first of several
      integer :: case_number = 0
   end type difference_t

   !> The sink
   type, extends(sink_t) :: comparison_sink_t
      !> The result file
      type(hdf5_object_t) :: file
      !> Quantities that differ, by name
      type(difference_t), allocatable :: differences(:)
      !> Cases compared, cases that differ
      integer :: cases = 0, differing = 0
      !> Cases without a result now that have one in the file, the first of them from 0, and what went wrong with it
      integer :: failing = 0, first_failing = 0
      character(len=:), allocatable :: message
   contains
      procedure :: announce
      procedure :: keep
   end type comparison_sink_t

contains

   !> Take a layout; its quantities have to be in the file.
   subroutine announce(self, layout, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> The layout
      type(layout_t), intent(in) :: layout
      !> Usage error where the file has other quantities
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(layout%summary)
         if (has_member(self%file, "/"//place_of(layout%summary(i)))) cycle
         call raise(error, kind_usage, "'"//self%file%file//"' has no '/"//place_of(layout%summary(i))// &
            & "': it is from another version, and its cases cannot be compared")
         return
      end do
   end subroutine announce

   !> Compare a run of cases.
   subroutine keep(self, record, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> The cases
      type(record_t), intent(inout) :: record
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(case_outcome_t), allocatable :: outcomes(:)
      type(layout_t) :: own
      logical, allocatable :: differs(:)
      integer :: first, count, layout, i

      call take_header(record, first, count, layout)
      if (layout > 0) own = self%layouts%items(layout)
      allocate (outcomes(count), differs(count))
      differs = .false.
      do i = 1, count
         call take_case(record, own, outcomes(i))
      end do
      call compare_statuses(self, first, outcomes, differs, error)
      if (.not. allocated(error) .and. layout > 0) then
         call compare_summaries(self, first, outcomes, own%summary, differs, error)
         if (.not. allocated(error)) call compare_series(self, first, outcomes, own, differs, error)
         if (.not. allocated(error)) call compare_histories(self, first, outcomes, own, differs, error)
         if (.not. allocated(error)) call compare_profiles(self, first, outcomes, differs, error)
      end if
      self%cases = self%cases + size(outcomes)
      self%differing = self%differing + count_true(differs)
   end subroutine keep

   !> Number of true values.
   pure function count_true(values) result(number)
      !> The values
      logical, intent(in) :: values(:)
      !> How many are true
      integer :: number

      number = count(values)
   end function count_true

   !> Compare what became of the cases.
   subroutine compare_statuses(self, first, outcomes, differs, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      !> The cases
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:) ! [-]
      integer :: i

      call read_numbers(self%file, "/summary/status", [first - 1], shape(outcomes), stored, error)
      if (allocated(error)) return
      do i = 1, size(outcomes)
         call compare(self, "summary/status", first + i - 2, stored(i), real(outcomes(i)%status, wp), differs(i))
         if (outcomes(i)%status == 0 .or. nint(stored(i)) /= 0) cycle
         self%failing = self%failing + 1
         ! Threads bring cases in any order
         if (self%failing > 1 .and. first + i - 2 > self%first_failing) cycle
         self%first_failing = first + i - 2
         self%message = outcomes(i)%text
      end do
   end subroutine compare_statuses

   !> Compare scalars.
   subroutine compare_summaries(self, first, outcomes, quantities, differs, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      !> The cases
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Their scalars
      type(quantity_t), intent(in) :: quantities(:)
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:) ! [unit of the scalar]
      integer :: i, k

      do k = 1, size(quantities)
         call read_numbers(self%file, "/"//place_of(quantities(k)), [first - 1], shape(outcomes), stored, error)
         if (allocated(error)) return
         do i = 1, size(outcomes)
            if (outcomes(i)%status /= 0) cycle
            call compare(self, place_of(quantities(k)), first + i - 2, stored(i), outcomes(i)%summary(k), differs(i))
         end do
      end do
   end subroutine compare_summaries

   !> Where a scalar is in a result file.
   pure function place_of(scalar) result(place)
      !> The scalar
      type(quantity_t), intent(in) :: scalar
      !> Its name with its group
      character(len=:), allocatable :: place

      place = group_of_source(scalar%source)//"/"//scalar%name
   end function place_of

   !> Compare series, of cases that have some.
   subroutine compare_series(self, first, outcomes, layout, differs, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      !> The cases
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Their layout
      type(layout_t), intent(in) :: layout
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:) ! [unit of the series]
      integer :: i, k

      do i = 1, size(outcomes)
         if (.not. allocated(outcomes(i)%series)) cycle
         call read_numbers(self%file, "/series/cam_angle", [0], shape(layout%angle), stored, error)
         if (allocated(error)) return
         call compare_row(self, "series/cam_angle", first + i - 2, stored, layout%angle, differs(i))
         do k = 1, size(layout%series)
            call read_numbers(self%file, "/series/"//layout%series(k)%name, [0, first + i - 2], [size(layout%angle), 1], &
               & stored, error)
            if (allocated(error)) return
            call compare_row(self, "series/"//layout%series(k)%name, first + i - 2, stored, outcomes(i)%series(:, k), differs(i))
         end do
      end do
   end subroutine compare_series

   !> Compare what is listed over hours of running or turns.
   subroutine compare_histories(self, first, outcomes, layout, differs, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      !> The cases
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Their layout
      type(layout_t), intent(in) :: layout
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:) ! [unit of the quantity]
      character(len=:), allocatable :: name
      integer :: i, k

      do i = 1, size(outcomes)
         if (.not. allocated(outcomes(i)%history)) cycle
         do k = 1, size(layout%history)
            name = trim(history_group(layout%history))//"/"//layout%history(k)%name
            call read_numbers(self%file, "/"//name, [0, first + i - 2], [size(outcomes(i)%history, 1), 1], stored, error)
            if (allocated(error)) return
            call compare_row(self, name, first + i - 2, stored, outcomes(i)%history(:, k), differs(i))
         end do
      end do
   end subroutine compare_histories

   !> Compare profiles across the contact, of cases that have some or should have some.
   subroutine compare_profiles(self, first, outcomes, differs, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      !> The cases
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_record_t) :: sampled
      integer :: i, number

      do i = 1, size(outcomes)
         number = first + i - 2
         if (allocated(outcomes(i)%profiles)) then
            if (has_member(self%file, "/ehl")) then
               call sample_record(outcomes(i)%profiles, size(outcomes(i)%profiles%angle), sampled)
               call compare_record(self, "ehl", number, sampled, differs(i), error)
            else
               call compare(self, "ehl", number, not_a_number(), 1.0_wp, differs(i))
            end if
         else if (outcomes(i)%lacks_profiles) then
            if (has_member(self%file, "/ehl")) call compare_missing(self, "ehl", number, differs(i), error)
         end if
         if (allocated(error)) return
      end do
   end subroutine compare_profiles

   !> Compare profiles that could not be solved: the file must have none.
   subroutine compare_missing(self, group, number, differs, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> Group of the file that profiles are in
      character(len=*), intent(in) :: group
      !> Number of the case, from 0
      integer, intent(in) :: number
      !> Does the case differ?
      logical, intent(inout) :: differs
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:) ! [m]

      call read_numbers(self%file, "/"//group//"/half_width", [0, number], [1, 1], stored, error)
      if (.not. allocated(error)) call compare(self, group, number, stored(1), not_a_number(), differs)
   end subroutine compare_missing

   !> Compare the profiles of a case.
   subroutine compare_record(self, group, number, record, differs, error)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> Group of the file that they are in
      character(len=*), intent(in) :: group
      !> Number of the case, from 0
      integer, intent(in) :: number
      !> Its profiles, at the angles of the file
      type(ehl_record_t), intent(in) :: record
      !> Does the case differ?
      logical, intent(inout) :: differs
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(quantity_t), allocatable :: list(:)
      real(wp), allocatable :: stored(:) ! [unit of the dataset]
      integer :: i

      call list_ehl_quantities(list)
      do i = 1, size(list)
         call read_numbers(self%file, "/"//group//"/"//list(i)%name, [0, number], [size(record%angle), 1], stored, error)
         if (allocated(error)) return
         call compare_row(self, group//"/"//list(i)%name, number, stored, record%values(:, i), differs)
      end do
      call read_numbers(self%file, "/"//group//"/x", [0, number], [size(record%nodes), 1], stored, error)
      if (allocated(error)) return
      call compare_row(self, group//"/x", number, stored, record%nodes, differs)
      call read_numbers(self%file, "/"//group//"/pressure", [0, 0, number], [shape(record%pressure), 1], stored, error)
      if (allocated(error)) return
      call compare_row(self, group//"/pressure", number, stored, reshape(record%pressure, [size(record%pressure)]), differs)
      call read_numbers(self%file, "/"//group//"/film", [0, 0, number], [shape(record%film), 1], stored, error)
      if (allocated(error)) return
      call compare_row(self, group//"/film", number, stored, reshape(record%film, [size(record%film)]), differs)
      if (.not. allocated(record%film_rise)) return
      call read_numbers(self%file, "/"//group//"/film_rise", [0, 0, number], [shape(record%film_rise), 1], stored, error)
      if (allocated(error)) return
      call compare_row(self, group//"/film_rise", number, stored, reshape(record%film_rise, [size(record%film_rise)]), differs)
   end subroutine compare_record

   !> Compare the numbers of a case; what is kept is the one that differs most.
   subroutine compare_row(self, name, number, stored, computed, differs)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> Name of the quantity in the file
      character(len=*), intent(in) :: name
      !> Number of the case, from 0
      integer, intent(in) :: number
      !> The numbers in the file and those computed now [unit of the quantity]
      real(wp), intent(in) :: stored(:), computed(:)
      !> Does the case differ?
      logical, intent(inout) :: differs

      integer :: i, worst

      worst = 0
      do i = 1, size(stored)
         if (transfer(stored(i), 0_int64) == transfer(computed(i), 0_int64)) cycle
         if (worst == 0) worst = i
         if (relative_difference(stored(i), computed(i)) > relative_difference(stored(worst), computed(worst))) worst = i
      end do
      if (worst > 0) call compare(self, name, number, stored(worst), computed(worst), differs)
   end subroutine compare_row

   !> Compare two numbers bit by bit.
   subroutine compare(self, name, case_number, stored, computed, differs)
      !> The sink
      class(comparison_sink_t), intent(inout) :: self
      !> Name of the quantity in the file
      character(len=*), intent(in) :: name
      !> Number of the case, from 0
      integer, intent(in) :: case_number
      !> The number in the file and the one computed now [unit of the quantity]
      real(wp), intent(in) :: stored, computed
      !> Does the case differ?
      logical, intent(inout) :: differs

      type(difference_t), allocatable :: longer(:)
      real(wp) :: relative ! [-]
      integer :: place
      logical :: is_new

      if (transfer(stored, 0_int64) == transfer(computed, 0_int64)) return
      differs = .true.
      if (.not. allocated(self%differences)) allocate (self%differences(0))
      place = 1
      do while (place <= size(self%differences))
         if (self%differences(place)%name >= name) exit
         place = place + 1
      end do
      is_new = place > size(self%differences)
      if (.not. is_new) is_new = self%differences(place)%name /= name
      if (is_new) then
         allocate (longer(size(self%differences) + 1))
         longer(:place - 1) = self%differences(:place - 1)
         longer(place)%name = name
         longer(place + 1:) = self%differences(place:)
         call move_alloc(longer, self%differences)
      end if
      relative = relative_difference(stored, computed)
      associate (difference => self%differences(place))
         difference%cases = difference%cases + 1
         ! Of equal differences that of the first case, since threads bring cases in any order
         if (difference%cases > 1 .and. (relative < difference%largest .or. &
            & .not. relative > difference%largest .and. case_number > difference%case_number)) return
         difference%largest = relative
         difference%case_number = case_number
      end associate
   end subroutine compare

   !> Difference of two numbers relative to the larger one.
   pure function relative_difference(some, other) result(difference)
      !> Two numbers [any unit]
      real(wp), intent(in) :: some, other
      !> Their difference [-]; huge where one of them is no finite number
      real(wp) :: difference

      ! Bits of the exponent, all of which are set where a number is not finite, and those of the fraction, which tell not-a-number
      ! from infinity
      integer(int64), parameter :: of_exponent = shiftl(2047_int64, 52), of_fraction = not(shiftl(4095_int64, 52))
      integer(int64) :: bits(2)
      real(wp) :: larger ! [any unit]

      ! A damaged file may hold a signalling not-a-number, which even `ieee_is_nan` of gfortran compares and thereby traps
      bits = transfer([some, other], bits)
      difference = 0.0_wp
      if (all(iand(bits, of_exponent) == of_exponent .and. iand(bits, of_fraction) /= 0_int64)) return
      difference = huge(1.0_wp)
      if (any(iand(bits, of_exponent) == of_exponent)) return
      ! Divided first, since the difference may overflow
      larger = max(abs(some), abs(other), tiny(1.0_wp))
      difference = abs(some/larger - other/larger)
   end function relative_difference

end module camroller_comparison_sink
