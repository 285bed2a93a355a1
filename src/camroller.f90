!> Everything public, under one name: no code.
module camroller
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t
   implicit none
   private

   public :: wp, pi, error_t

end module camroller
