!> Tests of the version and build facts.
module test_version
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_version, only : version_text, version_number, build_commit, compiler_facts, drop_repeats, names_sources
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
         new_unittest("the commit is a hash or said to be unknown, with a checksum of changed sources", commit_is_a_hash), &
         new_unittest("a commit names the sources but where it is unknown or they are changed, without a checksum", &
            & sources_are_named), &
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
      character(len=:), allocatable :: form
      integer :: i

      form = build_commit
      do i = 1, len(form)
         if (index(digits, form(i:i)) > 0) form(i:i) = "#"
      end do
      call check(error, any(form == [character(len=29) :: "############", "############-#h#ng##-########", "unknown-########", &
         & "unknown"]), "no hash: "//build_commit)
   end subroutine commit_is_a_hash

   subroutine sources_are_named(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, all([names_sources("0123456789ab"), names_sources("0123456789ab-changed-01234567"), &
         & names_sources("unknown-01234567")]), "sources are named, and said not to be")
      if (allocated(error)) return
      call check(error, any([names_sources("unknown"), names_sources("0123456789ab-changed")]), .false., &
         & "sources are not named, and said to be")
   end subroutine sources_are_named

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
