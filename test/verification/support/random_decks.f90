!> Decks drawn at random over wide ranges, the same on every machine and with every compiler.
module random_decks
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_film, only : film_law_names
   use camroller_kinematics, only : rotation_names
   use camroller_lift, only : lift_law_names
   use camroller_lubricant, only : pressure_law_names
   use camroller_traction, only : shear_law_names, cap_names, rolling_law_names
   implicit none
   private

   public :: random_t, start_random, draw, random_deck

   !> Generator of random numbers: xorshift with 32 bits; source: Marsaglia, J. Stat. Softw. 8 (2003) 14
   type :: random_t
      integer(int64) :: bits = 1_int64
   end type random_t

   character(len=*), parameter :: nl = new_line("a")

contains

   !> Start with a seed.
   pure subroutine start_random(random, seed)
      !> The generator
      type(random_t), intent(out) :: random
      !> Any number
      integer, intent(in) :: seed

      ! Neighbouring seeds are spread over all bits; zero would stay zero
      random%bits = modulo(2654435761_int64*(int(seed, int64) + 1_int64), 2_int64**32)
      if (random%bits == 0_int64) random%bits = 1_int64
   end subroutine start_random

   !> A number between 0 and 1.
   subroutine draw(random, number)
      !> The generator
      type(random_t), intent(inout) :: random
      !> The number [-]
      real(wp), intent(out) :: number
      integer(int64), parameter :: mask = 2_int64**32 - 1_int64

      random%bits = iand(ieor(random%bits, ishft(random%bits, 13)), mask)
      random%bits = ieor(random%bits, ishft(random%bits, -17))
      random%bits = iand(ieor(random%bits, ishft(random%bits, 5)), mask)
      number = real(random%bits, wp)/2.0_wp**32
   end subroutine draw

   !> A deck; its geometry may be impossible.
   subroutine random_deck(random, text)
      !> The generator
      type(random_t), intent(inout) :: random
      !> The deck
      character(len=:), allocatable, intent(out) :: text

      text = ""
      call begin("operating_point")
      call wide("speed_rpm", 1.0_wp, 4000.0_wp)
      text = text//"   oil_temperature_degC = 60"//nl
      call begin("mechanism")
      call even("pivot_to_roller_mm", 18.0_wp, 26.0_wp)
      call even("pivot_to_pad_mm", 30.0_wp, 45.0_wp)
      call even("pivot_to_cam_mm", 28.0_wp, 38.0_wp)
      call even("roller_arm_angle_deg", -8.0_wp, 8.0_wp)
      call even("valve_axis_angle_deg", 25.0_wp, 45.0_wp)
      call even("base_radius_mm", 14.0_wp, 20.0_wp)
      call wide("contact_width_mm", 3.0_wp, 30.0_wp)
      call name("rotation", rotation_names)
      call begin("roller")
      call even("radius_mm", 6.0_wp, 11.0_wp)
      call wide("mass_kg", 1.0e-3_wp, 0.05_wp)
      call even("wall_thickness_mm", 1.0_wp, 3.0_wp)
      call begin("lift")
      call draw_lift()
      call begin("masses")
      call wide("valve_kg", 0.01_wp, 0.15_wp)
      call wide("finger_kg", 0.01_wp, 0.15_wp)
      call begin("spring")
      call wide("stiffness_N_m", 1.0e4_wp, 1.0e5_wp)
      call even("precompression_mm", 5.0_wp, 15.0_wp)
      call wide("base_circle_load_N", 0.1_wp, 60.0_wp)
      call begin("materials")
      text = text//"   cam_modulus_GPa = 170, roller_modulus_GPa = 204, cam_poisson_ratio = 0.28"//nl// &
         "   roller_poisson_ratio = 0.29, hardness_GPa = 2"//nl
      call begin("surface")
      call wide("cam_roughness_um", 1.0e-3_wp, 2.0_wp)
      call wide("roller_roughness_um", 1.0e-3_wp, 2.0_wp)
      call begin("lubricant")
      text = text//"   temperature_law = 'direct'"//nl
      call wide("viscosity_Pa_s", 1.0e-3_wp, 10.0_wp)
      call name("pressure_law", pressure_law_names)
      call even("pressure_viscosity_coefficient_per_GPa", 8.0_wp, 30.0_wp)
      call begin("film")
      call name("law", film_law_names)
      call begin("traction")
      call name("shear_law", shear_law_names)
      call wide("eyring_stress_MPa", 1.0_wp, 20.0_wp)
      call even("limiting_coefficient", 0.02_wp, 0.12_wp)
      call name("cap", cap_names)
      call name("rolling_law", rolling_law_names)
      call draw_effects()
      text = text//"/"//nl

   contains

      !> Begin a group, and end the one before.
      subroutine begin(group)
         !> Its name
         character(len=*), intent(in) :: group

         if (text /= "") text = text//"/"//nl
         text = text//"&"//group//nl
      end subroutine begin

      !> A key with a number.
      subroutine put(key, value)
         !> Its name
         character(len=*), intent(in) :: key
         !> Its value [unit of the key]
         real(wp), intent(in) :: value
         character(len=16) :: buffer

         write (buffer, "(es12.5)") value
         text = text//"   "//key//" = "//trim(adjustl(buffer))//nl
      end subroutine put

      !> A key with a number from a range, each as likely as another.
      subroutine even(key, lowest, highest)
         !> Its name
         character(len=*), intent(in) :: key
         !> The range [unit of the key]
         real(wp), intent(in) :: lowest, highest
         ! [-]
         real(wp) :: number

         call draw(random, number)
         call put(key, lowest + number*(highest - lowest))
      end subroutine even

      !> A key with a number from a range, each ratio as likely as another.
      subroutine wide(key, lowest, highest)
         !> Its name
         character(len=*), intent(in) :: key
         !> The range [unit of the key]
         real(wp), intent(in) :: lowest, highest
         ! [-]
         real(wp) :: number

         call draw(random, number)
         call put(key, lowest*(highest/lowest)**number)
      end subroutine wide

      !> A key with one of several names.
      subroutine name(key, names)
         !> Its name
         character(len=*), intent(in) :: key
         !> Names to choose from
         character(len=*), intent(in) :: names(:)

         text = text//"   "//key//" = '"//trim(names(choice(size(names))))//"'"//nl
      end subroutine name

      !> A number from 1 to a largest one.
      function choice(largest)
         !> The largest
         integer, intent(in) :: largest
         !> The number
         integer :: choice
         ! [-]
         real(wp) :: number

         call draw(random, number)
         choice = min(largest, 1 + int(number*largest))
      end function choice

      !> A lift by one of the laws with a half angle: all but segments and tables, the last two.
      subroutine draw_lift()
         integer :: law
         character(len=8) :: buffer

         law = choice(size(lift_law_names) - 2)
         text = text//"   law = '"//trim(lift_law_names(law))//"'"//nl
         call even("max_lift_mm", 3.0_wp, 10.0_wp)
         call even("opening_half_angle_deg", 50.0_wp, 100.0_wp)
         if (lift_law_names(law) == "power") then
            write (buffer, "(i0)") 2 + choice(4)
            text = text//"   exponents = "//trim(buffer)//nl
         else if (lift_law_names(law) == "polydyne") then
            text = text//"   exponents = 6, 8, 10, 12"//nl
         else if (choice(2) == 1) then
            call even("closing_half_angle_deg", 50.0_wp, 100.0_wp)
         end if
      end subroutine draw_lift

      !> Effects, each there or not.
      subroutine draw_effects()
         if (choice(4) > 1) then
            call begin("asperity")
            call even("boundary_coefficient", 0.0_wp, 0.3_wp)
            call wide("mobilising_speed_m_s", 1.0e-6_wp, 1.0e-2_wp)
         end if
         if (choice(4) > 1) then
            call begin("needle_bearing")
            call wide("friction_coefficient", 1.0e-4_wp, 0.1_wp)
            text = text//"   needle_radius_mm = 0.9"//nl
         end if
         if (choice(4) > 1) then
            call begin("valve_guide")
            call even("length_mm", 20.0_wp, 50.0_wp)
            call even("stem_diameter_mm", 4.0_wp, 8.0_wp)
            call wide("radial_clearance_um", 10.0_wp, 50.0_wp)
         end if
      end subroutine draw_effects

   end subroutine random_deck

end module random_decks
