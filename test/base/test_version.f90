!> Tests of the version and build facts.
module test_version
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_version, only : version_text, version_number, build_commit, compiler_facts, drop_repeats
   implicit none
   private

   public :: collect_version

contains

   !> All tests of this suite.
   subroutine collect_version(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the manifest carries the version of the library", manifest_agrees), &
         new_unittest("the version number is the version text", number_agrees), &
         new_unittest("the commit is a hash or said to be unknown", commit_is_a_hash), &
         new_unittest("compiler and options are known", facts_are_given), &
         new_unittest("options that the compiler repeats for each file are given once, with their values", options_once) &
         ]
   end subroutine collect_version

   !> The first `version = "..."` of fpm.toml; the tests run in the folder of the manifest.
   subroutine manifest_agrees(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=256) :: line
      integer :: unit, status

      open (newunit=unit, file="fpm.toml", status="old", action="read", iostat=status)
      if (status /= 0) then
         call test_failed(error, "cannot open fpm.toml: run the tests from the top folder")
         return
      end if
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, "version = ") == 1) exit
      end do
      close (unit)
      call check(error, status, 0, "fpm.toml has no version")
      if (allocated(error)) return
      call check(error, trim(line), 'version = "'//version_text//'"')
   end subroutine manifest_agrees

   subroutine number_agrees(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=len(version_text)) :: text
      integer :: part(3), i

      text = version_text
      do i = 1, len(text)
         if (text(i:i) == ".") text(i:i) = " "
      end do
      read (text, *) part
      call check(error, version_number, 10000*part(1) + 100*part(2) + part(3))
   end subroutine number_agrees

   subroutine commit_is_a_hash(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: digits = "0123456789abcdef"

      if (build_commit == "unknown") return
      call check(error, len(build_commit) >= 12, "too short for a hash: "//build_commit)
      if (allocated(error)) return
      call check(error, verify(build_commit(:min(12, len(build_commit))), digits), 0, "no hash: "//build_commit)
   end subroutine commit_is_a_hash

   subroutine facts_are_given(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: compiler, options

      call compiler_facts(compiler, options)
      call check(error, len_trim(compiler) > 0, "the compiler has no name")
      if (allocated(error)) return
      call check(error, len_trim(options) > 0, "the compiler knows no options")
   end subroutine facts_are_given

   subroutine options_once(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: options

      call drop_repeats("-I a -O3 -Ib -fopenmp -I a  -O3 -J b -I b -O -Ib", options)
      call check(error, options, "-I a -O3 -Ib -fopenmp -J b -I b -O")
      if (allocated(error)) return
      call drop_repeats("", options)
      call check(error, options, "")
   end subroutine options_once

end module test_version
