!> Cases that are compared with those of a result file, bit by bit.
!>
!> In: records, a result file and its sweep. Out: which quantities differ, in how many cases, by how much. Compared are number and
!> swept values of each case, what became of it and in which words, all scalars with their units, and series, histories and profiles
!> of the cases that have them. A case without a result must have neither scalars nor series in the file.
module camroller_comparison_sink
   use camroller_kinds, only : wp, not_a_number
   use camroller_deck_sweep, only : sweep_t
   use camroller_differences, only : compare, difference_t
   use camroller_error, only : error_t, raise, kind_deck, kind_file, kind_usage
   use camroller_case_record, only : case_outcome_t, take_case, take_header
   use camroller_case_sink, only : sink_t
   use camroller_ehl_file, only : sample_record
   use camroller_ehl_record, only : ehl_record_t, list_ehl_quantities
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : has_member, is_text_dataset, list_members, member_length, read_extents, read_numbers, &
      & read_text, read_text_attribute
   use camroller_history_file, only : history_group, rows_in_list
   use camroller_input_comparison, only : compare_inputs
   use camroller_layout, only : layout_t
   use camroller_output_cases, only : choice_source, group_of_source
   use camroller_record, only : record_t
   use camroller_result, only : quantity_t
   implicit none
   private

   public :: comparison_sink_t, compare_record, compare_missing

   !> A dataset of the file: its name from the root, and its unit
   type :: stored_t
      character(len=2*member_length) :: name = ""
      character(len=:), allocatable :: unit
   end type stored_t

   !> The sink
   type, extends(sink_t) :: comparison_sink_t
      !> The result file
      type(hdf5_object_t) :: file
      !> What varies in its deck
      type(sweep_t) :: sweep
      !> Its scalars and its series, once they are listed, and the number of its cam angles
      type(stored_t), allocatable :: scalars(:), series(:)
      integer :: angles = 0
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
      class(comparison_sink_t), intent(inout) :: self
      type(layout_t), intent(in) :: layout
      !> Usage error where the file has other quantities
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(layout%summary)
         call demand(place_of(layout%summary(i)))
      end do
      if (.not. has_member(self%file, "/series/cam_angle")) return
      do i = 1, size(layout%series)
         call demand("series/"//layout%series(i)%name)
      end do

   contains

      !> An error where the file does not have a quantity.
      subroutine demand(name)
         character(len=*), intent(in) :: name

         if (allocated(error)) return
         if (.not. has_member(self%file, "/"//name)) call raise(error, kind_usage, "'"//self%file%file//"' has no '/"//name// &
            & "': it is from another version, and its cases cannot be compared")
      end subroutine demand

   end subroutine announce

   !> Compare a run of cases.
   subroutine keep(self, record, error)
      class(comparison_sink_t), intent(inout) :: self
      !> The cases
      type(record_t), intent(inout) :: record
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(case_outcome_t), allocatable :: outcomes(:)
      type(layout_t) :: own
      logical, allocatable :: differs(:), agrees(:), is_another(:)
      integer :: first, cases, layout, i

      call take_header(record, first, cases, layout)
      allocate (own%summary(0), own%series(0), own%angle(0))
      if (layout > 0) own = self%layouts%items(layout)
      allocate (outcomes(cases))
      allocate (differs(cases), is_another(cases), source=.false.)
      do i = 1, cases
         call take_case(record, own, outcomes(i))
      end do
      if (.not. allocated(self%scalars)) call list_stored(self, error)
      if (.not. allocated(error)) call compare_inputs(self%differences, self%file, self%sweep, first, differs, error)
      if (.not. allocated(error)) call compare_statuses(self, first, outcomes, is_another, error)
      agrees = .not. is_another
      if (.not. allocated(error)) call compare_words(self, first, outcomes, agrees, differs, error)
      if (.not. allocated(error)) call compare_summaries(self, first, outcomes, own%summary, agrees, differs, error)
      if (.not. allocated(error)) call compare_series(self, first, outcomes, own, agrees, differs, error)
      if (.not. allocated(error) .and. layout > 0) then
         call compare_histories(self, first, outcomes, own, differs, error)
         if (.not. allocated(error)) call compare_profiles(self, first, outcomes, differs, error)
      end if
      self%cases = self%cases + size(outcomes)
      self%differing = self%differing + count(differs .or. is_another)
   end subroutine keep

   !> Compare what became of the cases.
   subroutine compare_statuses(self, first, outcomes, differs, error)
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
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
         call compare(self%differences, "summary/status", first + i - 2, stored(i), real(outcomes(i)%status, wp), differs(i))
         if (outcomes(i)%status == 0 .or. nint(stored(i)) /= 0) cycle
         self%failing = self%failing + 1
         ! Threads bring cases in any order
         if (self%failing > 1 .and. first + i - 2 > self%first_failing) cycle
         self%first_failing = first + i - 2
         self%message = outcomes(i)%text
      end do
   end subroutine compare_statuses

   !> List the scalars and the series that the file has.
   subroutine list_stored(self, error)
      class(comparison_sink_t), intent(inout) :: self
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer, allocatable :: extents(:)

      allocate (self%scalars(0), self%series(0))
      call list_group(self%file, "summary", self%scalars, error)
      if (.not. allocated(error)) call list_group(self%file, choice_source, self%scalars, error)
      if (.not. allocated(error)) call list_group(self%file, "series", self%series, error)
      if (allocated(error) .or. size(self%series) == 0) return
      call read_extents(self%file, "/series/cam_angle", 1, extents, error)
      if (.not. allocated(error)) self%angles = extents(1)
   end subroutine list_stored

   !> Add what a group has of numbers of each case.
   subroutine list_group(file, group, list, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> Name of the group
      character(len=*), intent(in) :: group
      !> The list so far
      type(stored_t), allocatable, intent(inout) :: list(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=member_length), allocatable :: names(:)
      type(error_t), allocatable :: ignored
      type(stored_t) :: new
      integer :: i

      if (.not. has_member(file, "/"//group)) return
      call list_members(file, "/"//group, names, error)
      if (allocated(error)) return
      do i = 1, size(names)
         if (any(names(i) == [character(len=9) :: "status", "cam_angle"])) cycle
         if (is_text_dataset(file, "/"//group//"/"//trim(names(i)))) cycle
         new%name = group//"/"//names(i)
         call read_text_attribute(file, "/"//trim(new%name), "units", new%unit, ignored)
         list = [list, new]
      end do
   end subroutine list_group

   !> Compare messages of cases without a result, remarks of the others, and why effects take part in them or not.
   subroutine compare_words(self, first, outcomes, agrees, differs, error)
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Cases whose status is that in the file, which alone are compared
      logical, intent(in) :: agrees(:)
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(outcomes)
         ! Words on files name them from where the deck was, which does not matter
         if (.not. agrees(i) .or. any(outcomes(i)%status == [kind_deck, kind_file])) cycle
         call compare_one("run/warnings", merge(outcomes(i)%text, repeat(" ", len(outcomes(i)%text)), outcomes(i)%status == 0))
         call compare_one("run/messages", merge(outcomes(i)%text, repeat(" ", len(outcomes(i)%text)), outcomes(i)%status /= 0))
         call compare_one(choice_source//"/reasons", outcomes(i)%reasons)
         if (allocated(error)) return
      end do

   contains

      !> Compare one text of the case.
      subroutine compare_one(name, computed)
         !> Name of the texts in the file
         character(len=*), intent(in) :: name
         !> The text that there is now
         character(len=*), intent(in) :: computed

         character(len=:), allocatable :: stored

         if (allocated(error)) return
         stored = ""
         if (has_member(self%file, "/"//name)) call read_text(self%file, "/"//name, [first + i - 2], stored, error)
         if (.not. allocated(error)) call compare(self%differences, name, first + i - 2, stored, computed, differs(i))
      end subroutine compare_one

   end subroutine compare_words

   !> Compare scalars: those of the file, which has all that are computed.
   subroutine compare_summaries(self, first, outcomes, quantities, agrees, differs, error)
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Their scalars
      type(quantity_t), intent(in) :: quantities(:)
      !> Cases whose status is that in the file, which alone are compared
      logical, intent(in) :: agrees(:)
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:) ! [unit of the scalar]
      real(wp) :: computed ! [unit of the scalar]
      integer :: i, k, place

      do k = 1, size(self%scalars)
         associate (scalar => self%scalars(k))
            call read_numbers(self%file, "/"//trim(scalar%name), [first - 1], shape(outcomes), stored, error)
            if (allocated(error)) return
            do place = size(quantities), 1, -1
               if (place_of(quantities(place)) == scalar%name) exit
            end do
            do i = 1, size(outcomes)
               if (.not. agrees(i)) cycle
               computed = not_a_number()
               if (place > 0 .and. outcomes(i)%status == 0) then
                  computed = outcomes(i)%summary(place)
                  call compare(self%differences, trim(scalar%name)//" (unit)", first + i - 2, scalar%unit, &
                     & quantities(place)%unit, differs(i))
               end if
               call compare(self%differences, trim(scalar%name), first + i - 2, stored(i), computed, differs(i))
            end do
         end associate
      end do
   end subroutine compare_summaries

   !> Where a scalar is in a result file.
   pure function place_of(scalar) result(place)
      type(quantity_t), intent(in) :: scalar
      !> Its name with its group
      character(len=:), allocatable :: place

      place = group_of_source(scalar%source)//"/"//scalar%name
   end function place_of

   !> Compare series, of cases that have some and of cases without a result, which must have none.
   subroutine compare_series(self, first, outcomes, layout, agrees, differs, error)
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Their layout
      type(layout_t), intent(in) :: layout
      !> Cases whose status is that in the file, which alone are compared
      logical, intent(in) :: agrees(:)
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:), computed(:) ! [unit of the series]
      character(len=:), allocatable :: name
      logical :: has_series(size(outcomes)), is_compared(size(outcomes))
      integer :: i, k, place, rows

      has_series = [(allocated(outcomes(i)%series), i=1, size(outcomes))]
      is_compared = agrees .and. (has_series .or. outcomes%status /= 0)
      if (.not. any(is_compared)) return
      rows = self%angles
      if (any(has_series)) then
         rows = size(layout%angle)
         call read_numbers(self%file, "/series/cam_angle", [0], [rows], stored, error)
         if (allocated(error)) return
         do i = 1, size(outcomes)
            if (is_compared(i) .and. has_series(i)) call compare(self%differences, "series/cam_angle", first + i - 2, stored, &
               & layout%angle, differs(i))
         end do
      end if
      ! All cases at once: a case alone would have the chunks of all its neighbours decompressed
      do k = 1, size(self%series)
         name = trim(self%series(k)%name)
         call read_numbers(self%file, "/"//name, [0, first - 1], [rows, size(outcomes)], stored, error)
         if (allocated(error)) return
         do place = size(layout%series), 1, -1
            if ("series/"//layout%series(place)%name == name) exit
         end do
         do i = 1, size(outcomes)
            if (.not. is_compared(i)) cycle
            computed = spread(not_a_number(), 1, rows)
            if (place > 0 .and. has_series(i)) then
               computed = outcomes(i)%series(:, place)
               call compare(self%differences, name//" (unit)", first + i - 2, self%series(k)%unit, &
                  & layout%series(place)%unit, differs(i))
            end if
            call compare(self%differences, name, first + i - 2, stored(rows*(i - 1) + 1:rows*i), computed, differs(i))
         end do
      end do
   end subroutine compare_series

   !> Compare what is listed over hours of running or turns.
   subroutine compare_histories(self, first, outcomes, layout, differs, error)
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
      type(case_outcome_t), intent(in) :: outcomes(:)
      !> Their layout
      type(layout_t), intent(in) :: layout
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: stored(:) ! [unit of the quantity]
      character(len=:), allocatable :: name
      integer :: i, k, rows

      do i = 1, size(outcomes)
         if (.not. allocated(outcomes(i)%history)) cycle
         do k = 1, size(layout%history)
            rows = rows_in_list(layout%history, outcomes(i)%history, k)
            name = trim(history_group(layout%history(k)))//"/"//layout%history(k)%name
            call read_numbers(self%file, "/"//name, [0, first + i - 2], [rows, 1], stored, error)
            if (allocated(error)) return
            call compare(self%differences, name, first + i - 2, stored, outcomes(i)%history(:rows, k), differs(i))
         end do
      end do
   end subroutine compare_histories

   !> Compare profiles across the contact, of cases that have some or should have some.
   subroutine compare_profiles(self, first, outcomes, differs, error)
      class(comparison_sink_t), intent(inout) :: self
      !> First case, from 1
      integer, intent(in) :: first
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
               call compare(self%differences, "ehl", number, not_a_number(), 1.0_wp, differs(i))
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
      if (.not. allocated(error)) call compare(self%differences, group, number, stored(1), not_a_number(), differs)
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

      call list_ehl_quantities(size(record%values, 2), list)
      do i = 1, size(list)
         call read_numbers(self%file, "/"//group//"/"//list(i)%name, [0, number], [size(record%angle), 1], stored, error)
         if (allocated(error)) return
         call compare(self%differences, group//"/"//list(i)%name, number, stored, record%values(:, i), differs)
      end do
      call read_numbers(self%file, "/"//group//"/x", [0, number], [size(record%nodes), 1], stored, error)
      if (allocated(error)) return
      call compare(self%differences, group//"/x", number, stored, record%nodes, differs)
      call read_numbers(self%file, "/"//group//"/pressure", [0, 0, number], [shape(record%pressure), 1], stored, error)
      if (allocated(error)) return
      call compare(self%differences, group//"/pressure", number, stored, reshape(record%pressure, [size(record%pressure)]), differs)
      call read_numbers(self%file, "/"//group//"/film", [0, 0, number], [shape(record%film), 1], stored, error)
      if (allocated(error)) return
      call compare(self%differences, group//"/film", number, stored, reshape(record%film, [size(record%film)]), differs)
      if (.not. allocated(record%film_rise)) return
      call read_numbers(self%file, "/"//group//"/film_rise", [0, 0, number], [shape(record%film_rise), 1], stored, error)
      if (allocated(error)) return
      call compare(self%differences, group//"/film_rise", number, stored, reshape(record%film_rise, [size(record%film_rise)]), &
         & differs)
   end subroutine compare_record

end module camroller_comparison_sink
