!> Rough contacts of Masjedi and Khonsari (2012): films and what asperities carry, with the law of theirs; a table of it and others.
!>
!> Their asperities are those of Zhao, Maietta and Chang, their flow that of Patir and Cheng. `ROUGH_TABLE=file` writes the table.
module test_ehl_rough
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_domain
   use camroller_asperity, only : asperity_t, asperity_law_names, law_zhao_maietta_chang, new_asperity_constants
   use camroller_ehl_films, only : ehl_films_t
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem, mean_gap
   use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
   use closeness, only : check_close, expect_success
   use ehl_contacts, only : contact_of_groups
   use labelled_table, only : label_length, read_table
   implicit none
   private

   public :: collect_ehl_rough

   !> Their asperities: product of density, tip radius and roughness, roughness over tip radius [-]
   real(wp), parameter :: roughness_product = 0.05_wp, roughness_over_radius = 0.01_wp
   !> E' [Pa] and viscosity [Pa s] that the paper does not give: the pair of all comparisons with it, and ends of plausible ones
   real(wp), parameter :: modulus = 2.28e11_wp, viscosity = 0.04_wp
   real(wp), parameter :: moduli(2) = [1.8e11_wp, 2.4e11_wp], viscosities(2) = [0.01_wp, 0.1_wp]
   !> Roughness: asperities of Greenwood and Tripp without and with flow factors; of Zhao, Maietta and Chang with flow factors, and
   !> as hard as never to yield
   integer, parameter :: way_both_open = 1, way_both = 2, way_yielding = 3, way_elastic = 4, way_yielding_open = 5, &
      & number_of_ways = 5

contains

   subroutine collect_ehl_rough(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("Masjedi and Khonsari's rough contacts: films agree within 5 %, asperity shares within 9 %", test_rows), &
         new_unittest("the mean gap of rough surfaces exceeds the distance of their mean planes where they nearly touch", &
            & test_gap) &
         ]
   end subroutine collect_ehl_rough

   subroutine test_rows(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: labels(:)
      real(wp), allocatable :: rows(:, :)
      type(ehl_films_t) :: films(number_of_ways)
      ! Smallest and largest central film over the radius, and asperity share, of plausible pairs [-]
      real(wp) :: band(2, 2)
      integer :: unit, i, way
      logical :: is_outside

      call read_table("masjedi_khonsari.csv", 12, rows, error, labels)
      if (allocated(error)) return
      call open_table(unit)
      do i = 1, size(labels)
         call solve_row(rows(:, i), way_yielding, modulus, viscosity, films(way_yielding), error, is_outside)
         if (is_outside) then
            if (unit /= 0) write (unit, "(a8, 2es8.0, f6.0, es8.0, f7.4, a)") labels(i), rows(1:5, i), &
               & " | a dry contact above 1.5 GPa"
            cycle
         end if
         if (allocated(error)) exit
         if (unit /= 0) then
            do way = 1, number_of_ways
               if (way /= way_yielding) call solve_row(rows(:, i), way, modulus, viscosity, films(way), error)
               if (allocated(error)) exit
            end do
            if (.not. allocated(error)) call find_band(rows(:, i), band, error)
            if (allocated(error)) exit
            call write_row(unit, labels(i), rows(:, i), films, band)
         end if
         call check_row(labels(i), rows(:, i), films(way_yielding), error)
         if (allocated(error)) exit
      end do
      if (unit /= 0) close (unit)
   end subroutine test_rows

   !> The room is the distance where that is 8.5 roughnesses or more, 1/sqrt(2 pi) of the roughness where it is zero, 1.0833 of
   !> it at one roughness; its slope is the part of the surface that is below the other.
   subroutine test_gap(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      real(wp), parameter :: ratios(3) = [0.0_wp, 1.0_wp, 8.6_wp], rooms(3) = [0.398942280401433_wp, 1.083315470587686_wp, 8.6_wp]
      ! Step of the difference quotients over the roughness [-]
      real(wp), parameter :: h = 1.0e-5_wp
      real(wp) :: gap, slope, low, high, unused
      integer :: i, status

      contact = contact_of_groups(1.0e-4_wp, 1.0e-11_wp, 4500.0_wp)
      contact%roughness = 2.0e-5_wp*contact%radius
      contact%has_flow_factors = .true.
      call new_ehl_problem(problem, contact, status)
      call check(error, status, 0)
      do i = 1, 3
         if (allocated(error)) return
         call mean_gap(problem, ratios(i)*problem%roughness, gap, slope)
         call check_close(error, gap/problem%roughness, rooms(i), 1.0e-14_wp, "room")
      end do
      do i = -20, 90
         if (allocated(error)) return
         call mean_gap(problem, 0.1_wp*i*problem%roughness, gap, slope)
         call mean_gap(problem, (0.1_wp*i - h)*problem%roughness, low, unused)
         call mean_gap(problem, (0.1_wp*i + h)*problem%roughness, high, unused)
         call check(error, (high - low)/(2.0_wp*h*problem%roughness), slope, thr=10.0_wp*sqrt(epsilon(h)))
      end do
      problem%has_flow_factors = .false.
      call mean_gap(problem, 0.5_wp*problem%roughness, gap, slope)
      if (.not. allocated(error)) call check_close(error, gap, 0.5_wp*problem%roughness, epsilon(h), "without flow factors")
   end subroutine test_gap

   !> Films and share near theirs.
   subroutine check_row(label, row, films, error)
      character(len=*), intent(in) :: label
      real(wp), intent(in) :: row(:)
      type(ehl_films_t), intent(in) :: films
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      ! Of central and smallest film, of the share. No theory gives them: theirs are numerical solutions with a modulus and a
      ! viscosity that the paper does not give. Without roughness 4.1 and 3.3 % remain; with it 4.5, 3.3 and 8.3 % are the
      ! largest [-]
      real(wp), parameter :: differences(3) = [0.05_wp, 0.04_wp, 0.09_wp]

      contact = contact_of_groups(row(1), row(2), row(3))
      call check_close(error, films%central/contact%radius, row(6), differences(1), trim(label)//": central film")
      if (allocated(error)) return
      call check_close(error, films%minimum/contact%radius, row(8), differences(2), trim(label)//": smallest film")
      if (allocated(error)) return
      if (row(10) > 0.0_wp) then
         call check_close(error, 100.0_wp*films%asperity_share, row(10), differences(3), trim(label)//": share")
      else
         ! They print hundredths of a per cent
         call check(error, 100.0_wp*films%asperity_share < 0.01_wp, trim(label)//": share")
      end if
   end subroutine check_row

   !> Solve a row.
   subroutine solve_row(row, way, e, eta, films, error, is_outside)
      !> W*, U, G, sigma/R, hardness/E', ...
      real(wp), intent(in) :: row(:)
      !> One of the ways of roughness
      integer, intent(in) :: way
      !> E' [Pa], viscosity [Pa s]
      real(wp), intent(in) :: e, eta
      type(ehl_films_t), intent(out) :: films
      type(error_type), allocatable, intent(out) :: error
      !> Is the row beyond what solutions are given for? Absent: it is not
      logical, intent(out), optional :: is_outside
      type(ehl_contact_t) :: contact
      type(asperity_t) :: asperity
      type(error_t), allocatable :: failure

      contact = contact_of_groups(row(1), row(2), row(3), e, eta)
      asperity%roughness_product = roughness_product
      asperity%roughness_over_tip_radius = roughness_over_radius
      if (way >= way_yielding) asperity%law = asperity_law_names(law_zhao_maietta_chang)
      if (row(4) > 0.0_wp) then
         contact%roughness = row(4)*contact%radius
         contact%has_flow_factors = all(way /= [way_both_open, way_yielding_open])
         call new_asperity_constants(contact%asperity, asperity, e, merge(row(5), 1.0_wp, way /= way_elastic)*e)
      end if
      call solve_contact_film(contact, ehl_options_t(), films, failure)
      if (present(is_outside)) then
         is_outside = .false.
         if (allocated(failure)) is_outside = failure%kind == kind_domain
         if (is_outside) return
      end if
      call expect_success(error, failure)
   end subroutine solve_row

   !> Central film and asperity share over the pairs of E' and viscosity that are plausible.
   subroutine find_band(row, band, error)
      real(wp), intent(in) :: row(:)
      !> Smallest and largest of the film over the radius, of the share [-]
      real(wp), intent(out) :: band(2, 2)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_films_t) :: films
      type(ehl_contact_t) :: contact
      integer :: i, k

      contact = contact_of_groups(row(1), row(2), row(3))
      band(1, :) = huge(1.0_wp)
      band(2, :) = 0.0_wp
      do i = 1, 2
         do k = 1, 2
            call solve_row(row, way_yielding, moduli(i), viscosities(k), films, error)
            if (allocated(error)) return
            band(1, :) = min(band(1, :), [films%central/contact%radius, films%asperity_share])
            band(2, :) = max(band(2, :), [films%central/contact%radius, films%asperity_share])
         end do
      end do
   end subroutine find_band

   !> Open the table where it is asked for.
   subroutine open_table(unit)
      !> Its unit; 0 where it is not
      integer, intent(out) :: unit
      character(len=256) :: path
      integer :: length

      unit = 0
      call get_environment_variable("ROUGH_TABLE", path, length)
      if (length < 1) return
      open (newunit=unit, file=trim(path), status="replace", action="write")
      write (unit, "(a)") "# Line contacts of Masjedi and Khonsari (2012), J. Tribol. 134, 011503, and the same solved here", &
         & "# n beta sigma 0.05, sigma/beta 0.01, E' 228 GPa, 0.04 Pa s; films in 1e-5 R, shares of asperities in the load in %", &
         & "# paper: published. zmc: asperities of Zhao, Maietta and Chang, flow factors of Patir and Cheng; band: of zmc, "// &
         & "over E' 180 to 240 GPa", &
         & "# and 0.01 to 0.1 Pa s. zmco: zmc without flow factors. hard: zmc without "// &
         & "yield.", "# gt: asperities of Greenwood and Tripp, flow factors. gto: gt without flow factors", &
         & "#                                           | central film"// &
         & "                                         | smallest film                       | share", &
         & "# row      W*      U       G sigma/R hardn. | paper   zmc  band          zmco    hard    gt   gto   | paper   zmc  "// &
         & "zmco  hard    gt   gto | paper  zmc  band          zmco   hard   gt   gto"
   end subroutine open_table

   !> A line of the table.
   subroutine write_row(unit, label, row, films, band)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: label
      real(wp), intent(in) :: row(:)
      type(ehl_films_t), intent(in) :: films(:)
      !> Of central film over radius, of share [-]
      real(wp), intent(in) :: band(2, 2)
      type(ehl_contact_t) :: contact
      real(wp) :: scale ! [1/m]
      integer, parameter :: order(5) = [way_yielding, way_yielding_open, way_elastic, way_both, way_both_open]

      character(len=*), parameter :: edit = "(a8, 2es8.0, f6.0, es8.0, f7.4, ' |', 2f6.2, f6.2, ' to', f5.2, f8.2, 3f6.2, "// &
         & "'   |', 6f6.2, ' |', 2f6.1, f6.1, ' to', f5.1, f7.1, 3f6.1)"

      contact = contact_of_groups(row(1), row(2), row(3))
      scale = 1.0e5_wp/contact%radius
      write (unit, edit) label, row(1:5), &
         & row(6)*1.0e5_wp, films(order(1))%central*scale, band(:, 1)*1.0e5_wp, films(order(2:))%central*scale, &
         & row(8)*1.0e5_wp, films(order)%minimum*scale, &
         & row(10), 100.0_wp*films(order(1))%asperity_share, 100.0_wp*band(:, 2), 100.0_wp*films(order(2:))%asperity_share
   end subroutine write_row

end module test_ehl_rough
