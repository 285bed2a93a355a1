!> Rough contacts of Masjedi and Khonsari (2012) with asperities of Greenwood and Tripp: what can be compared, and a table of it.
!>
!> Theirs are asperities of one surface against a plane, which yield (Zhao, Maietta and Chang, 2000), and carry some fifteen times
!> as much at the same film, so that no tolerance follows from theory for what asperities carry. The film depends on that little: it
!> is thickened by what roughness does to the flow. `ROUGH_TABLE=file` writes the table.
module test_ehl_rough
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_domain
   use camroller_asperity, only : asperity_t, new_asperity_constants
   use camroller_ehl_films, only : ehl_films_t
   use camroller_ehl_problem, only : ehl_contact_t
   use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
   use closeness, only : check_close, expect_success
   use ehl_contacts, only : contact_of_groups
   use labelled_table, only : label_length, read_labelled_table
   implicit none
   private

   public :: collect_ehl_rough

   !> Their asperities: product of density, tip radius and roughness, roughness over tip radius [-]
   real(wp), parameter :: roughness_product = 0.05_wp, roughness_over_radius = 0.01_wp
   !> E' [Pa] and viscosity [Pa s] that the paper does not give: the pair of all comparisons with it, and ends of plausible ones
   real(wp), parameter :: modulus = 2.28e11_wp, viscosity = 0.04_wp
   real(wp), parameter :: moduli(2) = [1.8e11_wp, 2.4e11_wp], viscosities(2) = [0.01_wp, 0.1_wp]
   !> Pressure of elastic asperities of one surface against a plane over that of both surfaces, at a film as thick as the roughness:
   !> (2/3) n beta sigma sqrt(sigma/beta) F_3/2(1) over (8 sqrt(2) pi/15) (n beta sigma)^2 sqrt(sigma/beta) F_5/2(1), with
   !> F_3/2(1) = 0.075668 and F_5/2(1) = 0.080562 [-]
   real(wp), parameter :: stiffness = 5.285_wp
   !> Hardness over E' of most rows [-]; share of asperities from which on it counts [%]
   real(wp), parameter :: usual_hardness = 0.01_wp, least_share = 1.0_wp

contains

   subroutine collect_ehl_rough(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("rough rows of Masjedi and Khonsari: films as flow factors have them, shares in their order", test_rows) &
         ]
   end subroutine collect_ehl_rough

   subroutine test_rows(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: labels(:)
      real(wp), allocatable :: rows(:, :)
      type(ehl_films_t) :: soft, hindered, stiff
      ! Smallest and largest central film over the radius, and asperity share, of plausible pairs [-]
      real(wp) :: band(2, 2)
      ! Shares of rows of one hardness: theirs and ours [-]
      real(wp), allocatable :: shares(:, :)
      integer :: unit, i
      logical :: is_outside

      allocate (shares(2, 0))
      call read_labelled_table("masjedi_khonsari.csv", 12, labels, rows, error)
      if (allocated(error)) return
      call open_table(unit)
      do i = 1, size(labels)
         call solve_row(rows(:, i), 1.0_wp, .false., modulus, viscosity, soft, error, is_outside)
         if (is_outside) then
            if (unit /= 0) write (unit, "(a8, 2es8.0, f6.0, es8.0, a)") labels(i), rows(1:4, i), " | a dry contact above 1.5 GPa"
            cycle
         end if
         if (.not. allocated(error)) call solve_row(rows(:, i), 1.0_wp, .true., modulus, viscosity, hindered, error)
         if (allocated(error)) exit
         if (unit /= 0) then
            call solve_row(rows(:, i), stiffness, .true., modulus, viscosity, stiff, error)
            if (.not. allocated(error)) call find_band(rows(:, i), band, error)
            if (allocated(error)) exit
            call write_row(unit, labels(i), rows(:, i), soft, hindered, stiff, band)
         end if
         call check_films(labels(i), rows(:, i), hindered, error)
         if (allocated(error)) exit
         if (abs(rows(5, i) - usual_hardness) > 0.0_wp .or. rows(10, i) < least_share) cycle
         shares = reshape([shares, [rows(10, i), hindered%asperity_share]], [2, size(shares, 2) + 1])
      end do
      if (unit /= 0) close (unit)
      if (.not. allocated(error)) call check_order(shares, error)
   end subroutine test_rows

   !> Films near theirs, which depend on the hardness too.
   subroutine check_films(label, row, films, error)
      character(len=*), intent(in) :: label
      real(wp), intent(in) :: row(:)
      type(ehl_films_t), intent(in) :: films
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      ! Differences of central and smallest film, none by theory: 12 % where the hardness is least, else 7 %; 6 % [-]
      real(wp), parameter :: differences(2) = [0.13_wp, 0.06_wp]

      contact = contact_of_groups(row(1), row(2), row(3))
      call check_close(error, films%central/contact%radius, row(6), differences(1), trim(label)//": central film")
      if (allocated(error)) return
      call check_close(error, films%minimum/contact%radius, row(8), differences(2), trim(label)//": smallest film")
   end subroutine check_films

   !> A row whose asperities carry more by their model carries more by ours.
   subroutine check_order(shares, error)
      real(wp), intent(in) :: shares(:, :)
      type(error_type), allocatable, intent(out) :: error
      integer :: i, k

      call check(error, size(shares, 2) >= 7, "rows of one hardness")
      do i = 1, size(shares, 2)
         do k = 1, size(shares, 2)
            if (allocated(error)) return
            call check(error, shares(2, i) > shares(2, k) .eqv. shares(1, i) > shares(1, k), "order of the shares")
         end do
      end do
   end subroutine check_order

   !> Solve a row.
   subroutine solve_row(row, factor, has_flow_factors, e, eta, films, error, is_outside)
      !> W*, U, G, sigma/R, ...
      real(wp), intent(in) :: row(:)
      !> Stiffness of the asperities over that of Greenwood and Tripp [-]
      real(wp), intent(in) :: factor
      !> Does roughness hinder the flow?
      logical, intent(in) :: has_flow_factors
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
      if (row(4) > 0.0_wp) then
         contact%roughness = row(4)*contact%radius
         contact%has_flow_factors = has_flow_factors
         call new_asperity_constants(contact%asperity, asperity, e)
         contact%asperity%load_factor = factor*contact%asperity%load_factor
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
            call solve_row(row, 1.0_wp, .true., moduli(i), viscosities(k), films, error)
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
      write (unit, "(a)") "# Line contacts of Masjedi and Khonsari (2012), J. Tribol. 134, 011503, and the same with "// &
         & "asperities of Greenwood and Tripp", &
         & "# n beta sigma 0.05, sigma/beta 0.01, E' 228 GPa, 0.04 Pa s; films in 1e-5 R, shares of asperities in the load in %", &
         & "# paper: published. soft: Greenwood and Tripp. flow: with Patir and Cheng's flow factor too. stiff: flow, "// &
         & "asperities 5.3 times as stiff", &
         & "# band: of flow, over E' 180 to 240 GPa and 0.01 to 0.1 Pa s", &
         & "#                                    | central film                             | smallest film"// &
         & "            | share", &
         & "# row      W*      U       G sigma/R | paper soft  flow  band          stiff    | paper soft  flow  stiff"// &
         & "   | paper soft flow band        stiff"
   end subroutine open_table

   !> A line of the table.
   subroutine write_row(unit, label, row, soft, hindered, stiff, band)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: label
      real(wp), intent(in) :: row(:)
      type(ehl_films_t), intent(in) :: soft, hindered, stiff
      !> Of central film over radius, of share [-]
      real(wp), intent(in) :: band(2, 2)
      type(ehl_contact_t) :: contact
      real(wp) :: scale ! [1/m]

      character(len=*), parameter :: edit = "(a8, 2es8.0, f6.0, es8.0, ' |', 3f6.2, f6.2, ' to', f5.2, f7.2, ' |', 4f6.2, "// &
         & "'   |', 3f6.1, f6.1, ' to', f5.1, f7.1)"

      contact = contact_of_groups(row(1), row(2), row(3))
      scale = 1.0e5_wp/contact%radius
      write (unit, edit) &
         & label, row(1:4), row(6)*1.0e5_wp, soft%central*scale, hindered%central*scale, band(:, 1)*1.0e5_wp, stiff%central*scale, &
         & row(8)*1.0e5_wp, soft%minimum*scale, hindered%minimum*scale, stiff%minimum*scale, row(10), &
         & 100.0_wp*soft%asperity_share, 100.0_wp*hindered%asperity_share, 100.0_wp*band(:, 2), 100.0_wp*stiff%asperity_share
   end subroutine write_row

end module test_ehl_rough
