!> Time that this process has used.
module bench_clock
   use, intrinsic :: iso_c_binding, only : c_int, c_long
   use camroller_kinds, only : wp
   implicit none
   private

   public :: seconds_used

   !> As POSIX has it
   type, bind(c) :: timespec_t
      integer(c_long) :: seconds
      integer(c_long) :: nanoseconds
   end type timespec_t

   !> CLOCK_PROCESS_CPUTIME_ID of Linux: others on the same machine do not count
   integer(c_int), parameter :: process_clock = 2_c_int

   interface
      !> Read a clock of the operating system
      function clock_gettime(clock, time) bind(c, name="clock_gettime") result(status)
         import :: c_int, timespec_t
         !> Which one
         integer(c_int), value :: clock
         !> Its time
         type(timespec_t), intent(out) :: time
         !> 0 fine
         integer(c_int) :: status
      end function clock_gettime
   end interface

contains

   !> Processor time of this process [s].
   function seconds_used() result(seconds)
      !> Processor time [s]
      real(wp) :: seconds

      type(timespec_t) :: time
      integer(c_int) :: status

      status = clock_gettime(process_clock, time)
      seconds = real(time%seconds, wp) + 1.0e-9_wp*real(time%nanoseconds, wp)
   end function seconds_used

end module bench_clock
