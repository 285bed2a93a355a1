!> Tables of a random deck: valve lift and cylinder pressure, in every unit, with even and uneven steps, exact and with noise.
module wide_tables
   use camroller_kinds, only : wp, degree, pi
   use camroller_error, only : error_t
   use camroller_lift, only : lift_t, lift_law_t, lift_law_names, new_lift_law, evaluate_lift
   use camroller_table_file, only : table_t
   use camroller_units, only : unit_t, find_unit, from_si
   use random_decks, only : random_t, draw
   use wide_words, only : deck_word
   implicit none
   private

   public :: draw_lift_table, draw_pressure_table

contains

   !> A lift table that follows one of the analytic laws.
   subroutine draw_lift_table(random, group, text, table)
      !> The generator
      type(random_t), intent(inout) :: random
      !> Group that names the table
      character(len=*), intent(in) :: group
      !> The deck
      character(len=*), intent(in) :: text
      !> The table
      type(table_t), intent(out) :: table
      ! Rows of rest before and after the event, at most; laws without exponents
      integer, parameter :: most_rest = 3
      character(len=*), parameter :: laws(*) = lift_law_names(3:5)
      ! Lift of the roller and height of the cam over the lift of the valve, about [-]
      real(wp), parameter :: roller_share = 0.6_wp
      type(lift_t) :: shape
      type(lift_law_t) :: law
      type(error_t), allocatable :: error
      ! [-]; lift [m]; step, angle, place of the nose [deg]; noise, what the table counts lifts from [m]
      real(wp) :: number, lift(0:3), step, angle, nose, noise, base
      integer :: i, rows, rest
      character(len=:), allocatable :: kind
      type(unit_t) :: unit

      table%path = group//".txt"
      call draw(random, number)
      shape%law = laws(1 + int(number*size(laws)))
      shape%max_lift = between(2.0e-3_wp, 10.0e-3_wp)
      kind = deck_word(text, group, "table_kind")
      if (kind /= "" .and. kind /= "valve_lift") shape%max_lift = roller_share*shape%max_lift
      shape%opening_half_angle = between(45.0_wp, 110.0_wp)*degree
      shape%closing_half_angle = between(45.0_wp, 110.0_wp)*degree
      call new_lift_law(law, shape, error)
      noise = max(0.0_wp, between(-2.0_wp, 1.0_wp))*1.0e-7_wp
      rows = 20 + int(between(0.0_wp, 1.0_wp)**2*300.0_wp)
      rest = int(between(0.0_wp, most_rest + 1.0_wp))
      step = (shape%opening_half_angle + shape%closing_half_angle)/degree/rows
      rows = rows + 2*rest
      nose = nose_of(text, group)
      base = 0.0_wp
      if (kind == "cam_contour") base = base_radius(text)
      unit = unit_of(text, group, "table_unit", "mm")
      allocate (table%x(0), table%y(0))
      do i = 0, rows
         angle = -shape%opening_half_angle/degree + (i - rest)*step
         if (i > 0 .and. i < rows .and. noise > 0.0_wp) angle = angle + step*between(-0.3_wp, 0.3_wp)
         lift = 0.0_wp
         if (i > rest .and. i < rows - rest) call evaluate_lift(law, angle*degree, lift)
         if (i > rest .and. i < rows - rest) lift(0) = max(0.0_wp, lift(0) + between(-1.0_wp, 1.0_wp)*min(noise, 0.1_wp*lift(0)))
         table%x = [table%x, nose + angle]
         table%y = [table%y, from_si(unit, lift(0) + base)]
      end do
      table%line = [(i, i=1, size(table%x))]

   contains

      !> A number from a range, each as likely as another.
      function between(lowest, highest)
         !> The range [any]
         real(wp), intent(in) :: lowest, highest
         ! [any]
         real(wp) :: between

         call draw(random, number)
         between = lowest + number*(highest - lowest)
      end function between

   end subroutine draw_lift_table

   !> A pressure table over one turn: a bump on a constant.
   subroutine draw_pressure_table(random, text, table)
      !> The generator
      type(random_t), intent(inout) :: random
      !> The deck
      character(len=*), intent(in) :: text
      !> The table
      type(table_t), intent(out) :: table
      ! Rows of a turn that a table may have, last row that repeats the first or not
      integer, parameter :: rows(*) = [36, 72, 120, 360]
      ! [-]; height, level [Pa]; place, width, angle, distance [deg]
      real(wp) :: numbers(6), height, level, place, width, angle, distance
      integer :: i, count
      type(unit_t) :: unit

      table%path = "gas_force.txt"
      do i = 1, size(numbers)
         call draw(random, numbers(i))
      end do
      count = rows(1 + int(numbers(1)*size(rows)))
      height = 1.0e5_wp*80.0_wp**numbers(2)
      level = 1.0e5_wp*(numbers(3) - 0.5_wp)
      place = 360.0_wp*numbers(4)
      width = 12.0_wp + 40.0_wp*numbers(5)
      unit = unit_of(text, "gas_force", "pressure_unit", "bar")
      allocate (table%x(0), table%y(0))
      do i = 0, count - merge(1, 0, numbers(6) < 0.5_wp)
         angle = i*360.0_wp/count
         distance = modulo(angle - place + 180.0_wp, 360.0_wp) - 180.0_wp
         table%x = [table%x, angle]
         table%y = [table%y, from_si(unit, level + height/(1.0_wp + (distance/width)**2))]
      end do
      if (numbers(6) >= 0.5_wp) table%y(size(table%y)) = table%y(1)
      table%line = [(i, i=1, size(table%x))]
   end subroutine draw_pressure_table

   !> Angle of the nose in a table.
   function nose_of(text, group) result(nose)
      !> The deck
      character(len=*), intent(in) :: text
      !> Group that names the table
      character(len=*), intent(in) :: group
      ! [deg]
      real(wp) :: nose
      character(len=:), allocatable :: word

      nose = pi/degree
      word = deck_word(text, group, "table_nose_angle_deg")
      if (word /= "") read (word, *) nose
   end function nose_of

   !> Radius of the base circle.
   function base_radius(text) result(radius)
      !> The deck
      character(len=*), intent(in) :: text
      ! [m]
      real(wp) :: radius
      character(len=:), allocatable :: word

      word = deck_word(text, "mechanism", "base_radius_mm")
      read (word, *) radius
      radius = radius*1.0e-3_wp
   end function base_radius

   !> Unit of the second column of a table.
   function unit_of(text, group, key, usual) result(unit)
      !> The deck
      character(len=*), intent(in) :: text
      !> Group, key of the unit, unit where it is not given
      character(len=*), intent(in) :: group, key, usual
      type(unit_t) :: unit
      character(len=:), allocatable :: word
      logical :: is_known

      word = deck_word(text, group, key)
      if (word == "") word = usual
      call find_unit(word, unit, is_known)
   end function unit_of

end module wide_tables
