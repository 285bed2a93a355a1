!> Film formulas over numerical films, across the range of speeds and loads: where each can be trusted.
!>
!> Usage: ehl_map       lines of a table on the output, a few seconds
program ehl_map
   implicit none

   call main()

contains

   !> Solve a grid of contacts of steel with an ordinary oil.
   subroutine main()
      use, intrinsic :: iso_fortran_env, only : output_unit
      use camroller_kinds, only : wp
      use camroller_error, only : error_t
      use camroller_lubricant, only : law_roelands
      use camroller_film, only : groups_t, film_shape_t, film_shape, law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari, &
         & law_moes
      use camroller_ehl_problem, only : ehl_contact_t
      use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
      use camroller_ehl_films, only : ehl_films_t
      use bench_circumstances, only : print_circumstances

      integer, parameter :: laws(4) = [law_dowson_higginson, law_pan_hamrock, law_masjedi_khonsari, law_moes]
      type(ehl_contact_t) :: contact
      type(ehl_films_t) :: films
      type(groups_t) :: groups
      type(film_shape_t) :: shape
      type(error_t), allocatable :: error
      ! Formula over numerical film, minimum then central, law by law [-]
      real(wp) :: ratios(2, 4)
      integer :: i, j, k

      call print_circumstances("Film formulas over numerical films: G 4500, E' 220 GPa, Roelands, 0.04 Pa s")
      write (output_unit, "(a)") "# columns: U, W*, numerical minimum and central film over the radius, then minimum and "// &
         & "central film of dowson_higginson, pan_hamrock, masjedi_khonsari, moes over the numerical ones"
      do j = 0, 24
         do i = 0, 24
            groups = groups_t(10.0_wp**(-13.0_wp + 4.0_wp*i/24.0_wp), 4500.0_wp, 10.0_wp**(-6.0_wp + 2.4_wp*j/24.0_wp), 0.0_wp, &
               & 0.0_wp)
            contact%modulus = 2.2e11_wp
            contact%radius = 0.01_wp
            contact%oil%viscosity = 0.04_wp
            contact%oil%pressure_law = law_roelands
            contact%oil%pressure_viscosity = groups%material/contact%modulus
            contact%oil%roelands_exponent = log(contact%oil%viscosity) + 9.67_wp
            contact%oil%roelands_index = contact%oil%pressure_viscosity/(5.1e-9_wp*contact%oil%roelands_exponent)
            contact%line_load = groups%load*contact%modulus*contact%radius
            contact%entrainment_speed = groups%speed*contact%modulus*contact%radius/contact%oil%viscosity
            call solve_contact_film(contact, ehl_options_t(), films, error)
            if (allocated(error)) cycle
            do k = 1, 4
               call film_shape(laws(k), groups, shape)
               ratios(:, k) = [shape%minimum/films%minimum, shape%central/films%central]*contact%radius
            end do
            write (output_unit, "(4es12.4, 8f9.4)") groups%speed, groups%load, films%minimum/contact%radius, &
               & films%central/contact%radius, ratios
         end do
      end do
   end subroutine main

end program ehl_map
