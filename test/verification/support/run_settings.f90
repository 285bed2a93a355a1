!> What a run of the tests is told by its environment and by its compiler.
module run_settings
   use, intrinsic :: iso_fortran_env, only : compiler_options
   use camroller_kinds, only : wp
   implicit none
   private

   public :: has_checks, number_from, value_from

contains

   !> Is this a build with run-time checks, in which a case takes ten times as long? The compiler's options say so.
   pure function has_checks()
      !> Is it?
      logical :: has_checks

      has_checks = index(compiler_options(), "-fcheck=all") > 0
   end function has_checks

   !> A whole number from the environment, or the usual one.
   function number_from(variable, usual) result(number)
      !> Name of the variable
      character(len=*), intent(in) :: variable
      !> The usual number
      integer, intent(in) :: usual
      !> The number
      integer :: number

      integer :: status
      character(len=12) :: buffer

      call get_environment_variable(variable, buffer, status=status)
      number = usual
      if (status == 0) read (buffer, *, iostat=status) number
      if (status /= 0) number = usual
   end function number_from

   !> A real number from the environment, or the usual one.
   function value_from(variable, usual) result(value)
      !> Name of the variable
      character(len=*), intent(in) :: variable
      !> The usual number [any]
      real(wp), intent(in) :: usual
      !> The number [any]
      real(wp) :: value

      integer :: status
      character(len=24) :: buffer

      call get_environment_variable(variable, buffer, status=status)
      value = usual
      if (status == 0) read (buffer, *, iostat=status) value
      if (status /= 0) value = usual
   end function value_from

end module run_settings
