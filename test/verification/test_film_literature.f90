!> Film laws against published numbers and against each other.
module test_film_literature
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_film, only : groups_t, film_shape_t, film_shape, film_law_names, law_masjedi_khonsari, asperity_part, &
      & law_masjedi_khonsari_rough, law_dowson_higginson, law_pan_hamrock, law_moes
   use labelled_table, only : label_length, read_table
   use closeness, only : check_scaled
   implicit none
   private

   public :: collect_film_literature

contains

   subroutine collect_film_literature(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("regressions of Masjedi and Khonsari reproduce their printed columns for films and asperity load", &
         & test_masjedi_khonsari), &
         new_unittest("every film law is near the published numerical solutions of smooth contacts", test_laws_agree) &
         ]
   end subroutine collect_film_literature

   subroutine test_masjedi_khonsari(error)
      type(error_type), allocatable, intent(out) :: error
      ! Three digits are printed, half a unit of the last one in units of 1e-5 [-]
      real(wp), parameter :: printed = 0.005e-5_wp*(1.0_wp + 1.0e-9_wp)
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(film_shape_t) :: shape
      ! Part of the load on asperities, its slopes [-]
      real(wp) :: part, slopes(3)
      integer :: i, law

      call read_table("masjedi_khonsari.csv", 12, rows, error, names)
      if (allocated(error)) return
      if (size(names) /= 16) call test_failed(error, "16 rows are expected")
      do i = 1, size(names)
         if (allocated(error)) return
         law = merge(law_masjedi_khonsari_rough, law_masjedi_khonsari, rows(4, i) > 0.0_wp)
         call film_shape(law, groups_t(rows(2, i), rows(3, i), rows(1, i), rows(4, i), rows(5, i)), shape)
         call check_scaled(error, shape%central, rows(7, i), 1.0_wp, printed, trim(names(i))//": central film")
         if (allocated(error)) return
         call check_scaled(error, shape%minimum, rows(9, i), 1.0_wp, printed, trim(names(i))//": minimum film")
         if (allocated(error)) return
         if (.not. rows(4, i) > 0.0_wp) cycle
         call asperity_part(groups_t(rows(2, i), rows(3, i), rows(1, i), rows(4, i), rows(5, i)), part, slopes(1), &
            & slopes(2), slopes(3))
         ! per cent with two digits; the bend takes 2e-4 of the largest, 44 %
         call check_scaled(error, 100.0_wp*part, rows(11, i), 1.0_wp, 0.005_wp + 2.0e-4_wp*rows(11, i), &
            & trim(names(i))//": load of the asperities")
      end do
   end subroutine test_masjedi_khonsari

   subroutine test_laws_agree(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_shape_t) :: shape
      ! Numerical solution of the smooth row of the table, central and minimum film [-]
      real(wp), parameter :: central = 1.77e-5_wp, minimum = 1.55e-5_wp
      integer, parameter :: laws(4) = [law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari, law_moes]
      ! Half a unit of the last digit of a printed film, in the formula and in the solution [-]
      real(wp), parameter :: printed = 2.0_wp*0.005_wp/1.55_wp
      ! What a regression leaves: root mean square of the 16 differences between both columns of the table, central and minimum [-]
      real(wp), parameter :: central_fit = 0.037_wp, minimum_fit = 0.051_wp
      ! Density of oil at the peak of Hertz's pressure, sqrt(W/(2 pi)) E' = 0.8 to 0.92 GPa for E' of 200 to 230 GPa, relative to
      ! that at ambient pressure, after Dowson and Higginson: an incompressible film is thicker by no more [-]
      real(wp), parameter :: density = 1.215_wp
      ! Least and most ratio to the solution [-]. Masjedi and Khonsari print 1.76 and 1.55; Pan and Hamrock solved the same
      ! compressible problem; Dowson and Toyoda, and Moes, describe an incompressible film in the middle. The minimum is at the
      ! exit, where pressure has nearly gone, and compression shows in part; Moes' minimum is tied to his central film
      real(wp), parameter :: central_ratios(2, 4) = reshape([1.0_wp, density*(1.0_wp + central_fit), &
         & 1.0_wp - central_fit, 1.0_wp + central_fit, 1.76_wp/1.77_wp - printed, 1.76_wp/1.77_wp + printed, &
         & 1.0_wp, density*(1.0_wp + central_fit)], [2, 4])
      real(wp), parameter :: minimum_ratios(2, 4) = reshape([1.0_wp - minimum_fit, 1.10_wp, &
         & 1.0_wp - minimum_fit, 1.0_wp + minimum_fit, 1.0_wp - printed, 1.0_wp + printed, &
         & 1.0_wp, density*(1.0_wp + central_fit)], [2, 4])
      integer :: i

      do i = 1, 4
         call film_shape(laws(i), groups_t(1.0e-11_wp, 4500.0_wp, 1.0e-4_wp, 0.0_wp, 0.0_wp), shape)
         call check_between(error, shape%central/central, central_ratios(:, i), trim(film_law_names(laws(i)))//": central film")
         if (allocated(error)) return
         call check_between(error, shape%minimum/minimum, minimum_ratios(:, i), trim(film_law_names(laws(i)))//": minimum film")
         if (allocated(error)) return
      end do
   end subroutine test_laws_agree

   !> A ratio within its bounds.
   subroutine check_between(error, ratio, bounds, what)
      type(error_type), allocatable, intent(out) :: error
      ! [-]
      real(wp), intent(in) :: ratio, bounds(2)
      character(len=*), intent(in) :: what
      character(len=40) :: buffer

      write (buffer, "(3f9.4)") ratio, bounds
      if (.not. (ratio >= bounds(1) .and. ratio <= bounds(2))) call test_failed(error, what//trim(buffer))
   end subroutine check_between

end module test_film_literature
