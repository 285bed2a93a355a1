!> Values of options of the command line: numbers within bounds.
!>
!> In: a word. Out: numbers, or a usage error that says what the option takes.
module camroller_option_values
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_kinds, only : wp
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: read_positive, read_whole_number, read_shard

contains

   !> A speed above zero.
   subroutine read_positive(option, value, advice, number, error)
      !> The option, its word, where to read more
      character(len=*), intent(in) :: option, value, advice
      !> Gets the number [any]
      real(wp), intent(inout) :: number
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      ! Largest speed that is taken [any]
      real(wp), parameter :: largest = 1.0e5_wp
      ! The number read [any]
      real(wp) :: found
      integer :: status

      status = 1
      found = 0.0_wp
      if (verify(value, "0123456789.eE+-") == 0 .and. len(value) > 0) read (value, *, iostat=status) found
      if (status == 0 .and. found > 0.0_wp .and. found <= largest) then
         number = found
         return
      end if
      call raise(error, kind_usage, "option '"//option//"' takes a speed above 0 and up to "//number_text(largest)// &
         & ", not '"//value//"'"//advice)
   end subroutine read_positive

   !> A whole number within bounds.
   subroutine read_whole_number(option, value, meaning, advice, smallest, largest, number, error)
      !> The option, its word, what it takes, where to read more
      character(len=*), intent(in) :: option, value, meaning, advice
      !> Bounds
      integer, intent(in) :: smallest, largest
      !> Gets the number
      integer, intent(inout) :: number
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      integer :: status, found

      status = 1
      found = smallest
      if (verify(value, "0123456789") == 0 .and. len(value) > 0) read (value, *, iostat=status) found
      if (status == 0 .and. found >= smallest .and. found <= largest) then
         number = found
         return
      end if
      call raise(error, kind_usage, "option '"//option//"' takes "//meaning//", not '"//value//"'"//advice)
   end subroutine read_whole_number

   !> A part of a sweep, as `2/4`.
   subroutine read_shard(value, advice, shard, shards, error)
      !> The word
      character(len=*), intent(in) :: value
      !> Where to read more
      character(len=*), intent(in) :: advice
      !> Get the part, from 1, and the number of parts
      integer, intent(inout) :: shard, shards
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: meaning = "a shard and the number of shards, as 2/4"
      integer :: slash

      slash = index(value, "/")
      call read_whole_number("--shard", value(:max(slash - 1, 0)), meaning, advice, 1, huge(1), shard, error)
      if (.not. allocated(error)) then
         call read_whole_number("--shard", value(slash + 1:), meaning, advice, shard, huge(1), shards, error)
      end if
      if (allocated(error)) call raise(error, kind_usage, "option '--shard' takes "//meaning//", not '"//value//"'"//advice)
   end subroutine read_shard

end module camroller_option_values
