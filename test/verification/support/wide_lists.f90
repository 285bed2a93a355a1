!> Lists of numbers of a random deck: points of an oil, exponents of a lift, bearings and cams along a shaft.
module wide_lists
   use camroller_kinds, only : wp
   use random_decks, only : random_t, draw
   use wide_draft, only : draft_t
   use wide_words, only : deck_word, number_words
   implicit none
   private

   public :: list_of_numbers, list_of_integers

   !> Length of a shaft with two bearings [mm]
   real(wp), parameter :: spacing_of_bearings = 50.0_wp

contains

   !> A list of numbers; blank where the key is not known.
   subroutine list_of_numbers(random, draft, text, name, with_ends, words)
      !> The generator
      type(random_t), intent(inout) :: random
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> The deck so far
      character(len=*), intent(in) :: text
      !> Group and key
      character(len=*), intent(in) :: name
      !> May a number be at an end of its range?
      logical, intent(in) :: with_ends
      !> The list
      character(len=:), allocatable, intent(out) :: words
      ! [unit of the key]
      real(wp), allocatable :: values(:)
      ! [-]
      real(wp) :: number
      integer :: i, points

      points = merge(2, 3, index(text, "temperature_law = 'walther'") > 0)
      words = ""
      select case (name)
      case ("lubricant.temperature_points_degC")
         values = running_sum(points, -20.0_wp, 40.0_wp)
      case ("lubricant.viscosity_points_Pa_s")
         values = oil_points(points)
      case ("lubricant.pressure_viscosity_temperatures_degC")
         values = running_sum(3, -20.0_wp, 40.0_wp)
      case ("lubricant.pressure_viscosity_points_per_GPa")
         values = falling(running_sum(3, 8.0_wp, 5.0_wp))
      case ("boundary_law.speed_points_m_s", "boundary_law.temperature_points_degC", "boundary_law.coefficient_points", &
         & "shaft_drag.speed_points_rpm", "shaft_drag.temperature_points_degC", "shaft_drag.torque_points_Nm")
         call draw_table()
      case ("cam_bearings.bearing_positions_mm")
         values = running_sum(draft%bearings, -spacing_of_bearings, spacing_of_bearings)
      case ("cam_bearings.cam_positions_mm")
         values = places_between()
      case ("lift.segment_angles_deg", "second_lift.segment_angles_deg")
         ! Ten pieces of about fifteen degrees
         values = [0.0_wp, running_sum(10, 0.0_wp, 15.0_wp)]
      case ("lift.segment_accelerations", "second_lift.segment_accelerations")
         ! A ramp, a flank, the nose, a flank, a ramp
         values = [0.0_wp, 0.1_wp, 0.0_wp, 1.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp, 0.5_wp, 0.05_wp, 0.0_wp]
         do i = 2, 10
            call draw(random, number)
            values(i) = values(i)*(0.5_wp + number)
         end do
      case ("engine.full_lift_deg")
         allocate (values(merge(2, 1, draft%has_second)))
         do i = 1, size(values)
            call draw(random, number)
            values(i) = 720.0_wp*(2.0_wp*number - 1.0_wp)
            if (with_ends) values(i) = sign(720.0_wp, values(i))
         end do
      case ("cam_bearings.cam_phases_deg", "cam_bearings.follower_angles_deg")
         allocate (values(draft%cams))
         do i = 1, draft%cams
            call draw(random, number)
            values(i) = 360.0_wp*(2.0_wp*number - 1.0_wp)
            if (with_ends) values(i) = sign(360.0_wp, values(i))
            ! The first cam is what the others are counted from
            if (i == 1 .and. .not. with_ends) values(i) = 0.0_wp
         end do
      case default
         return
      end select
      do i = 1, size(values)
         words = words//number_words(values(i))
         if (i < size(values)) words = words//", "
      end do

   contains

      !> Points of a table over speed and temperature.
      subroutine draw_table()
         select case (name)
         case ("boundary_law.speed_points_m_s")
            values = 10.0_wp**running_sum(3, -4.0_wp, 1.0_wp)
         case ("boundary_law.temperature_points_degC")
            values = running_sum(2, 0.0_wp, 60.0_wp)
         case ("boundary_law.coefficient_points")
            values = running_sum(6, 0.0_wp, 0.03_wp)
         case ("shaft_drag.speed_points_rpm")
            ! Some of the fastest are beyond
            values = [0.0_wp, running_sum(2, 0.0_wp, 3000.0_wp)]
         case ("shaft_drag.temperature_points_degC")
            values = [-60.0_wp, running_sum(1, 90.0_wp, 100.0_wp)]
         case ("shaft_drag.torque_points_Nm")
            values = running_sum(6, 0.0_wp, 0.05_wp)
         end select
      end subroutine draw_table

      !> Numbers that grow by half a step to one and a half.
      function running_sum(count, start, step) result(sums)
         !> So many
         integer, intent(in) :: count
         !> Before the first; step [unit of the key]
         real(wp), intent(in) :: start, step
         real(wp) :: sums(count)
         integer :: k
         ! Sum so far [unit of the key]
         real(wp) :: so_far

         do k = 1, count
            call draw(random, number)
            if (k == 1) then
               so_far = start + step*(0.5_wp + number)
            else
               so_far = start + step*(0.5_wp + number) + so_far - start
            end if
            sums(k) = so_far
         end do
      end function running_sum

      !> Numbers from the last to the first.
      pure function falling(values) result(turned)
         ! [unit of the key]
         real(wp), intent(in) :: values(:)
         real(wp) :: turned(size(values))

         turned = values(size(values):1:-1)
      end function falling

      !> Viscosities at the temperatures of the deck by Vogel's law, with a constant and a pole like those of mineral oils.
      function oil_points(count) result(viscosities)
         !> So many
         integer, intent(in) :: count
         ! [Pa s]; [degC]
         real(wp) :: viscosities(count), temperatures(count)
         character(len=:), allocatable :: line

         line = deck_word(text, "lubricant", "temperature_points_degC")
         read (line, *) temperatures
         call draw(random, number)
         viscosities = 5.0e-5_wp*exp((700.0_wp + 600.0_wp*number)/(temperatures + 95.0_wp))
      end function oil_points

      !> Places of the cams between the bearings; at a bearing now and then.
      function places_between() result(places)
         ! [mm]
         real(wp) :: places(draft%cams), bearings(draft%bearings)
         character(len=:), allocatable :: line
         integer :: k

         line = deck_word(text, "cam_bearings", "bearing_positions_mm")
         read (line, *) bearings
         do k = 1, draft%cams
            call draw(random, number)
            places(k) = bearings(1) + number*(bearings(draft%bearings) - bearings(1))
            if (with_ends .and. number < 0.2_wp) places(k) = bearings(1)
         end do
      end function places_between

   end subroutine list_of_numbers

   !> A list of whole numbers; blank where the key is not known.
   subroutine list_of_integers(random, draft, text, name, with_ends, words)
      !> The generator
      type(random_t), intent(inout) :: random
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> The deck so far
      character(len=*), intent(in) :: text
      !> Group and key
      character(len=*), intent(in) :: name
      !> May a number be at an end of its range?
      logical, intent(in) :: with_ends
      !> The list
      character(len=:), allocatable, intent(out) :: words
      ! [-]
      real(wp) :: number
      character(len=60) :: buffer
      integer :: first

      words = ""
      call draw(random, number)
      select case (name)
      case ("lift.exponents", "second_lift.exponents")
         first = 3 + int(5.0_wp*number)
         if (with_ends .and. number < 0.1_wp) first = 200
         ! The law stands in the same group, which is the last so far
         if (index(text, "law = 'polydyne'", back=.true.) > index(text, "law = 'power'", back=.true.)) then
            write (buffer, "(3(i0, ', '), i0)") first + 1, first + 3, first + 6, first + 8 + modulo(int(50.0_wp*number), 10)
         else
            write (buffer, "(i0)") first
         end if
      case ("cam_bearings.cam_lobes")
         write (buffer, "(*(i0, :, ', '))") draft%lobes
      case ("cam_bearings.cam_cylinders")
         write (buffer, "(*(i0, :, ', '))") cylinders_of_cams()
      case ("engine.firing_order")
         write (buffer, "(*(i0, :, ', '))") firing_order()
      case default
         buffer = ""
      end select
      words = trim(buffer)

   contains

      !> A cylinder for each cam.
      function cylinders_of_cams() result(cylinders)
         integer :: cylinders(draft%cams), k

         do k = 1, draft%cams
            call draw(random, number)
            cylinders(k) = 1 + int(number*draft%cylinders)
         end do
      end function cylinders_of_cams

      !> All cylinders in any order.
      function firing_order() result(order)
         integer :: order(draft%cylinders), k, other

         order = [(k, k=1, draft%cylinders)]
         do k = draft%cylinders, 2, -1
            call draw(random, number)
            other = 1 + int(number*k)
            order([k, other]) = order([other, k])
         end do
      end function firing_order

   end subroutine list_of_integers

end module wide_lists
