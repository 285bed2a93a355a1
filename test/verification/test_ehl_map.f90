!> Film formulas over numerical films across speeds and loads: the map of where each can be trusted, at some of its points.
module test_ehl_map
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_domain
   use camroller_film, only : groups_t, film_shape_t, film_shape, law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari, &
      & law_moes
   use camroller_ehl_films, only : ehl_films_t
   use camroller_ehl_problem, only : ehl_contact_t
   use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
   use closeness, only : expect_success
   use ehl_contacts, only : contact_of_groups
   implicit none
   private

   public :: collect_ehl_map

   integer, parameter :: laws(4) = [law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari, law_moes]
   character(len=*), parameter :: names(4) = [character(len=16) :: "dowson_higginson", "pan_hamrock", "masjedi_khonsari", "moes"]
   !> What the formulas differ by, least and most, smallest and central film, law by law, as `doc/ehl.md` states it: for Moes'
   !> number above 10, from 3 to 10, and on the rigid side for the law that keeps the right size there [%]
   real(wp), parameter :: elastic(2, 2, 4) = reshape(real([-3, 7, 0, 39, -11, 3, -15, 1, -28, 1, -17, 1, 17, 24, 7, 28], wp), &
      & [2, 2, 4])
   real(wp), parameter :: between(2, 2, 4) = reshape(real([-7, 5, -10, 15, -13, -2, -17, -2, -35, 3, -22, -3, 15, 18, 2, 20], wp), &
      & [2, 2, 4])
   real(wp), parameter :: rigid(2, 2) = reshape(real([16, 28, 1, 30], wp), [2, 2])
   !> What a film may be off by another grid [%]
   real(wp), parameter :: grid_error = 0.5_wp

contains

   subroutine collect_ehl_map(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("deviations of each formula from numerical films are those of the map in the documentation", test_map) &
         ]
   end subroutine collect_ehl_map

   subroutine test_map(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_films_t) :: films
      type(groups_t) :: groups
      type(error_t), allocatable :: failure
      integer :: i, j

      do j = 0, 6
         do i = 0, 6
            groups = groups_t(10.0_wp**(-13.0_wp + 4.0_wp*i/6.0_wp), 4500.0_wp, 10.0_wp**(-6.0_wp + 0.4_wp*j), 0.0_wp, 0.0_wp)
            contact = contact_of_groups(groups%load, groups%speed, groups%material)
            call solve_contact_film(contact, ehl_options_t(), films, failure)
            if (allocated(failure)) then
               if (failure%kind == kind_domain) cycle
            end if
            call expect_success(error, failure)
            if (.not. allocated(error)) call check_laws(groups, films%minimum/contact%radius, films%central/contact%radius, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_map

   !> Compare all laws with a numerical film.
   subroutine check_laws(groups, minimum, central, error)
      type(groups_t), intent(in) :: groups
      !> Numerical films over the radius [-]
      real(wp), intent(in) :: minimum, central
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: shape
      ! Moes' number [-], differences of smallest and central film [%]
      real(wp) :: number, differences(2), bounds(2, 2)
      integer :: law
      character(len=160) :: text

      number = groups%load/sqrt(2.0_wp*groups%speed)
      do law = 1, size(laws)
         call film_shape(laws(law), groups, shape)
         differences = 100.0_wp*([shape%minimum/minimum, shape%central/central] - 1.0_wp)
         bounds = between(:, :, law)
         if (number > 10.0_wp) bounds = elastic(:, :, law)
         if (number < 3.0_wp) then
            if (laws(law) /= law_moes) cycle
            bounds = rigid
         end if
         write (text, "(2a, 3es10.2, a, 2f8.2)") trim(names(law)), " at U, W*, M ", groups%speed, groups%load, number, &
            & " is off by per cent ", differences
         call check(error, all(differences > bounds(1, :) - grid_error .and. differences < bounds(2, :) + grid_error), &
            & trim(text))
         if (allocated(error)) return
      end do
   end subroutine check_laws

end module test_ehl_map
