!> Version of camroller and facts of the build.
!>
!> In: nothing. Out: the version as text and as one number, the commit, compiler and options for the metadata of a result file.
module camroller_version
   use, intrinsic :: iso_fortran_env, only : compiler_version, compiler_options
   implicit none
   private

   public :: version_text, version_number, build_commit, compiler_facts

   !> Version as `major.minor.patch`
   character(len=*), parameter :: version_text = "0.2.0"
   !> Version as 10000*major + 100*minor + patch
   integer, parameter :: version_number = 200
   ! Commit of the sources, `build_commit`: known when built by make, "unknown" otherwise
   include "build_commit.inc"

contains

   !> Compiler and options that this library was built with.
   subroutine compiler_facts(compiler, options)
      !> Name and version of the compiler
      character(len=:), allocatable, intent(out) :: compiler
      !> Options it was given
      character(len=:), allocatable, intent(out) :: options

      compiler = compiler_version()
      options = compiler_options()
   end subroutine compiler_facts

end module camroller_version
