!> Version of camroller and facts of the build.
!>
!> In: nothing. Out: the version as text and as one number, the commit, compiler and options for the metadata of a result file.
module camroller_version
   use, intrinsic :: iso_fortran_env, only : compiler_version, compiler_options
   implicit none
   private

   public :: version_text, version_number, build_commit, compiler_facts, drop_repeats, names_sources

   !> Version as `major.minor.patch`
   character(len=*), parameter :: version_text = "0.2.0"
   !> Version as 10000*major + 100*minor + patch
   integer, parameter :: version_number = 200
   ! What was built, `build_commit`: the commit of the sources; a checksum of them where they differ from it or are of no commit;
   ! "unknown" alone where nothing was found out, see tools/write_commit.sh
   include "build_commit.inc"

contains

   !> Were two builds with this same commit made of the same sources? Not known where it is "unknown" or ends with "changed",
   !> without a checksum.
   pure function names_sources(commit) result(verdict)
      !> Commit of a build
      character(len=*), intent(in) :: commit
      !> Were they?
      logical :: verdict

      character(len=*), parameter :: unsaid(*) = [character(len=7) :: "unknown", "changed"]

      verdict = all(unsaid /= commit(index(commit, "-", back=.true.) + 1:))
   end function names_sources

   !> Compiler and options that this library was built with.
   subroutine compiler_facts(compiler, options)
      !> Name and version of the compiler
      character(len=:), allocatable, intent(out) :: compiler
      !> Options it was given
      character(len=:), allocatable, intent(out) :: options

      compiler = compiler_version()
      call drop_repeats(compiler_options(), options)
   end subroutine compiler_facts

   !> Each option once, where it first stands: after optimisation at link time the compiler lists them for each file. An option ends
   !> before the next word that begins with a minus sign, so that it keeps a value that is a word of its own.
   subroutine drop_repeats(options, distinct)
      !> Options, separated by blanks
      character(len=*), intent(in) :: options
      !> The same without repeated ones
      character(len=:), allocatable, intent(out) :: distinct

      ! First character of an option, and the last before the next one
      integer :: first, last

      distinct = ""
      last = 0
      do while (last < len(options))
         first = last + 1
         last = index(options(first:), " -") + first - 1
         if (last < first) last = len(options)
         associate (option => " "//trim(adjustl(options(first:last))))
            if (index(distinct//" ", option//" ") == 0) distinct = distinct//option
         end associate
      end do
      distinct = trim(adjustl(distinct))
   end subroutine drop_repeats

end module camroller_version
