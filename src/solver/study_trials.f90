!> What the trials of a study of films share: clock, places of a result, what stands where there is no number.
!>
!> Layer: solver. In: results. Out: numbers.
module camroller_study_trials
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_result, only : result_t, find_quantity
   use camroller_run, only : run_case
   use camroller_study_probe, only : median
   use camroller_study_table, only : word_length
   implicit none
   private

   public :: least_error, patience, time_run, largest_change, series_of, scalar_of, nothing, no_number, seconds_since, words_of

   !> Smallest error shown [-]
   real(wp), parameter :: least_error = 1.0e-8_wp
   !> Repetitions end after this time [s]
   real(wp), parameter :: patience = 0.5_wp

contains

   !> A run and the time it took.
   subroutine time_run(case, repeats, result, time, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Trials whose median time counts
      integer, intent(in) :: repeats
      !> Its result
      type(result_t), intent(out) :: result
      !> Time [s]
      real(wp), intent(out) :: time
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      ! Times of the trials [s]
      real(wp) :: times(max(repeats, 1))
      integer(int64) :: first, start
      integer :: i

      call system_clock(first)
      do i = 1, size(times)
         call system_clock(start)
         call run_case(case, result, error)
         times(i) = seconds_since(start)
         if (allocated(error)) exit
         if (seconds_since(first) > patience) exit
      end do
      time = median(times(:min(i, size(times))))
   end subroutine time_run

   !> Largest relative change where both are positive.
   pure function largest_change(values, right) result(change)
      !> Values, and what they are compared with [any]
      real(wp), intent(in) :: values(:), right(:)
      !> The change [-]
      real(wp) :: change

      change = maxval(abs(values/max(right, tiny(1.0_wp)) - 1.0_wp), mask=values > 0.0_wp .and. right > 0.0_wp)
   end function largest_change

   !> A series of a result.
   pure function series_of(result, name) result(values)
      !> The result
      type(result_t), intent(in) :: result
      !> Name of the series
      character(len=*), intent(in) :: name
      !> Its values [unit of the series]
      real(wp), allocatable :: values(:)

      values = result%series_values(:, find_quantity(result%series, name))
   end function series_of

   !> A scalar of a result.
   pure function scalar_of(result, name) result(value)
      !> The result
      type(result_t), intent(in) :: result
      !> Name of the scalar
      character(len=*), intent(in) :: name
      !> Its value [unit of the scalar]
      real(wp) :: value

      value = result%summary_values(find_quantity(result%summary, name))
   end function scalar_of

   !> Both words of a row.
   pure function words_of(first, second) result(words)
      !> The words
      character(len=*), intent(in) :: first, second
      !> Both
      character(len=word_length) :: words(2)

      words(1) = first
      words(2) = second
   end function words_of

   !> Numbers that are none.
   pure function nothing(count) result(numbers)
      !> How many
      integer, intent(in) :: count
      !> NaN [any]
      real(wp) :: numbers(count)

      numbers = no_number()
   end function nothing

   !> A number that is none.
   pure function no_number() result(number)
      !> NaN [any]
      real(wp) :: number

      number = ieee_value(number, ieee_quiet_nan)
   end function no_number

   !> Time since a reading of the clock.
   function seconds_since(start) result(seconds)
      !> The reading
      integer(int64), intent(in) :: start
      !> Time [s]
      real(wp) :: seconds

      integer(int64) :: now, rate

      call system_clock(now, rate)
      seconds = real(now - start, wp)/real(rate, wp)
   end function seconds_since

end module camroller_study_trials
