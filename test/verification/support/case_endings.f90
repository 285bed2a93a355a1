!> How cases end: every class of ending by its words, counted.
module case_endings
   use camroller_error, only : error_t, kind_convergence, kind_deck, kind_domain
   use camroller_remarks, only : remark_names, remark_t
   implicit none
   private

   public :: tally_t, count_ending, count_error, count_remarks, endings_table, ending_count

   !> Counted classes
   type :: tally_t
      !> Names in the order of their first appearance
      character(len=72), allocatable :: names(:)
      integer, allocatable :: counts(:)
   end type tally_t

   !> What the message of an error of a run says, and its class
   character(len=*), parameter :: error_phrases(2, 18) = reshape([character(len=44) :: &
      & "at several loads", "several balances at once", &
      & "did not become periodic", "not periodic", &
      & "was not found", "estimate beyond the slip itself", &
      & "number of evaluations is reached", "evaluations used up", &
      & "number of steps is reached", "steps used up", &
      & "is explicit, and its steps", "explicit steps by the million", &
      & "step size fell below its minimum", "step too small", &
      & "right-hand side cannot be evaluated", "no value of the roller equation", &
      & "cannot be evaluated", "state that cannot be evaluated", &
      & "no load satisfies the equilibrium", "no common solution of the contact", &
      & "between sticking and sliding too often", "sticks and slides too often", &
      & "a fixed step failed", "fixed step failed", &
      & "quasi-static limit", "no quasi-static limit", &
      & "range_policy = 'stop'", "film law outside its range, which stops", &
      & "contact_policy = 'stop'", "contact lost, which stops", &
      & "bearing law has no solution", "camshaft bearing without solution", &
      & "thrown off", "finger thrown off", &
      & "ehl:", "numerical film"], [2, 18])

contains

   !> Count one ending.
   subroutine count_ending(tally, name)
      !> The counts
      type(tally_t), intent(inout) :: tally
      !> The class
      character(len=*), intent(in) :: name
      character(len=72), allocatable :: names(:)
      integer :: place, known

      known = 0
      if (allocated(tally%names)) known = size(tally%names)
      do place = 1, known
         if (tally%names(place) == name) exit
      end do
      if (place > known) then
         allocate (names(place))
         if (known > 0) names(:known) = tally%names
         names(place) = name
         call move_alloc(names, tally%names)
         if (known == 0) allocate (tally%counts(0))
         tally%counts = [tally%counts, 0]
      end if
      tally%counts(place) = tally%counts(place) + 1
   end subroutine count_ending

   !> Count an error of a run by its cause; trouble where it has no known cause.
   subroutine count_error(tally, error, prefix, trouble)
      !> The counts
      type(tally_t), intent(inout) :: tally
      !> The error
      type(error_t), intent(in) :: error
      !> What ended
      character(len=*), intent(in) :: prefix
      !> What is wrong with the error; blank where all is well
      character(len=:), allocatable, intent(inout) :: trouble
      character(len=:), allocatable :: kind
      integer :: i

      select case (error%kind)
      case (kind_convergence)
         kind = " convergence error: "
      case (kind_domain)
         kind = " domain error: "
      case (kind_deck)
         kind = " deck error: "
      case default
         kind = " other error: "
         trouble = trouble//" an error of a kind that no case may have: "//error%message
      end select
      do i = 1, size(error_phrases, 2)
         if (index(error%message, trim(error_phrases(1, i))) == 0) cycle
         call count_ending(tally, prefix//kind//trim(error_phrases(2, i)))
         return
      end do
      call count_ending(tally, prefix//kind//"of another cause")
      if (error%kind == kind_convergence) trouble = trouble//" an error without a known cause: "//error%message
   end subroutine count_error

   !> Count the remarks of a result.
   subroutine count_remarks(tally, remarks)
      !> The counts
      type(tally_t), intent(inout) :: tally
      !> The remarks
      type(remark_t), intent(in) :: remarks(:)
      integer :: i

      call count_ending(tally, trim(merge("result without a remark", "result with remarks    ", size(remarks) == 0)))
      do i = 1, size(remarks)
         call count_ending(tally, "  remark: "//trim(remark_names(remarks(i)%kind)))
      end do
   end subroutine count_remarks

   !> Cases that ended so.
   pure function ending_count(tally, name) result(count)
      !> The counts
      type(tally_t), intent(in) :: tally
      !> Beginning of the class
      character(len=*), intent(in) :: name
      integer :: count, i

      count = 0
      if (.not. allocated(tally%names)) return
      do i = 1, size(tally%names)
         if (index(tally%names(i), name) == 1) count = count + tally%counts(i)
      end do
   end function ending_count

   !> All classes with their counts, a line each.
   function endings_table(tally) result(table)
      !> The counts
      type(tally_t), intent(in) :: tally
      character(len=:), allocatable :: table
      character(len=88) :: line
      logical, allocatable :: is_open(:)
      integer :: i, k

      table = ""
      if (.not. allocated(tally%names)) return
      allocate (is_open(size(tally%names)))
      is_open = .true.
      do k = 1, size(tally%names)
         i = maxloc(tally%counts, 1, mask=is_open)
         is_open(i) = .false.
         write (line, "(i9, 2x, a)") tally%counts(i), trim(tally%names(i))
         table = table//trim(line)//new_line("a")
      end do
   end function endings_table

end module case_endings
