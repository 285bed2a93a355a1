!> Memory that a case has freed is kept for the next one.
!>
!> In: nothing. Out: a C library that keeps it. By default the GNU C library gives what is free at the end of its memory back to the
!> system once it exceeds a few hundred kB, and asks for it again: with 1.3 MB a case that takes a fifth of the time of a sweep, in
!> which the system clears the same pages for each case. A host of the library decides about its own memory.
module camroller_freed_memory
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private

   public :: keep_freed_memory

   !> Parameters of `mallopt`: free memory that is given back, and requests that the system is asked for one by one
   integer(c_int), parameter :: trim_threshold = -1_c_int, map_threshold = -3_c_int
   !> Their values [B]: the most that a request may have, and several times that
   integer(c_int), parameter :: largest_kept = 33554432_c_int, most_free = 8_c_int*largest_kept

   interface
      function c_mallopt(parameter, value) bind(C, name="mallopt") result(is_set)
         import :: c_int
         integer(c_int), value :: parameter, value
         integer(c_int) :: is_set
      end function c_mallopt
   end interface

contains

   !> Keep freed memory in this process, up to 256 MB in each pool that the C library has for its threads: never more than was in
   !> use at one time.
   subroutine keep_freed_memory()
      integer(c_int) :: status

      ! Where it cannot be set, only time is lost
      status = c_mallopt(map_threshold, largest_kept)
      if (status /= 0) status = c_mallopt(trim_threshold, most_free)
   end subroutine keep_freed_memory

end module camroller_freed_memory
