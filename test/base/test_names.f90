!> Tests of choices by name.
module test_names
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_error, only : error_t, kind_deck
   use camroller_names, only : name_length, are_same, index_of_name, find_name, write_names
   implicit none
   private

   public :: collect_names

   character(len=*), parameter :: known(*) = [character(len=name_length) :: "barus", "cameron", "roelands"]

contains

   !> All tests of this suite.
   subroutine collect_names(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a known name is found at its place", known_name_is_found), &
         new_unittest("a part of a known name is no known name", part_is_unknown), &
         new_unittest("names are the same whatever blanks are behind them", blanks_do_not_count), &
         new_unittest("an unknown name is a deck error that lists the known ones", unknown_name_is_an_error), &
         new_unittest("a list of names is quoted and separated", list_is_quoted) &
         ]
   end subroutine collect_names

   subroutine known_name_is_found(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      integer :: position

      call check(error, index_of_name("barus", known), 1)
      if (allocated(error)) return
      call find_name("law", "roelands", known, position, raised)
      call check(error, .not. allocated(raised), "a known name was refused")
      if (allocated(error)) return
      call check(error, position, 3)
   end subroutine known_name_is_found

   subroutine part_is_unknown(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, index_of_name("roel", known), 0)
      if (allocated(error)) return
      call check(error, index_of_name("", known), 0)
   end subroutine part_is_unknown

   subroutine blanks_do_not_count(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: names(*) = [character(len=8) :: "", "barus", "baru", " barus", "barus a"]
      integer :: i, k

      do i = 1, size(names)
         do k = 1, size(names)
            call check(error, are_same(trim(names(i)), names(k)) .and. are_same(names(k), trim(names(i))) .eqv. i == k, &
               & "'"//trim(names(i))//"' and '"//trim(names(k))//"'")
            if (allocated(error)) return
         end do
      end do
   end subroutine blanks_do_not_count

   subroutine unknown_name_is_an_error(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      integer :: position

      call find_name("viscosity law", "baruss", known, position, raised)
      call check(error, allocated(raised), "an unknown name was taken")
      if (allocated(error)) return
      call check(error, raised%kind, kind_deck)
      if (allocated(error)) return
      call check(error, raised%message, "unknown viscosity law 'baruss'; known are 'barus', 'cameron', 'roelands'")
      if (allocated(error)) return
      call check(error, position, 0)
   end subroutine unknown_name_is_an_error

   subroutine list_is_quoted(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: text

      call write_names(known(1:1), text)
      call check(error, text, "'barus'")
      if (allocated(error)) return
      call write_names(known, text)
      call check(error, text, "'barus', 'cameron', 'roelands'")
   end subroutine list_is_quoted

end module test_names
