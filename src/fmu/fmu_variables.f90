!> The variables of an FMU: inputs and parameters, outputs of the camshafts and of every cam's follower.
!>
!> In: a deck and its case. Out: the list, with names, units, meanings; a table by which the library of the FMU knows what the
!> numbers of its variables mean: their places in the list, from 0.
module camroller_fmu_variables
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_catalogue, only : list_series, lobe_columns, camshaft_columns
   use camroller_deck, only : deck_t
   use camroller_deck_document, only : given_numbers
   use camroller_number_text, only : integer_text, number_text
   use camroller_result, only : quantity_t
   implicit none
   private

   public :: variable_t, list_variables, write_variables
   public :: role_time, role_parameter, role_input, role_output

   !> What a variable is for
   integer, parameter :: role_time = 1, role_parameter = 2, role_input = 3, role_output = 4

   !> Where extremes of the torque are looked for
   character(len=*), parameter :: torque_places = "at angles a degree apart or less; of one cam without bearings, seals and "// &
      & "drive also between them"

   !> A variable
   type :: variable_t
      !> One of the roles
      integer :: role = role_output
      !> Name, unit and meaning
      character(len=:), allocatable :: name, unit, meaning
      !> Is it true or false?
      logical :: is_logical = .false.
      !> Value at the start [unit of the variable]
      real(wp) :: start = 0.0_wp
      !> Its kind, as the library of an FMU calls it
      character(len=:), allocatable :: kind
      !> Cam, from 1, or 0; place among the numbers of that cam, from 0
      integer :: cam = 0, place = 0
      !> Key of the deck that it gives a value to, or name of the number of a series
      character(len=:), allocatable :: key
   end type variable_t

contains

   !> The variables of a deck.
   subroutine list_variables(deck, case, variables)
      !> The deck, without its sweep
      type(deck_t), intent(in) :: deck
      !> Its case
      type(case_t), intent(in) :: case
      !> The variables in order
      type(variable_t), allocatable, intent(out) :: variables(:)

      integer :: cam, cams

      allocate (variables(0))
      cams = 1
      if (allocated(case%cam_bearings)) cams = size(case%cam_bearings%cam_positions)
      call add(role_time, "time", "s", "time", "time")
      call add(role_parameter, "start_angle", "rad", "cam angle of the first cam at the start, pi at full lift", "start_angle")
      call add_keys(deck, variables)
      call add(role_input, "speed", "rad s-1", "cam speed at the start of a step, above zero", "speed", &
         & case%operating_point%speed)
      call add(role_input, "speed_slope", "rad s-2", "change of the cam speed with time over a step", "speed_slope")
      call add(role_input, "oil_temperature", "K", "temperature of the oil at the start of a step", "oil_temperature", &
         & case%operating_point%oil_temperature)
      call add(role_input, "oil_temperature_slope", "K s-1", "change of the oil temperature with time over a step", &
         & "oil_temperature_slope")
      if (allocated(case%gas_force)) then
         call add(role_parameter, "gas_pressure_is_input", "1", "do the inputs give the gas pressure, not the table of the "// &
            & "deck?", "has_pressure")
         variables(size(variables))%is_logical = .true.
         do cam = 1, cams
            call add(role_input, "cam["//integer_text(cam)//"].gas_pressure", "Pa", "gauge pressure that presses the valve "// &
               & "shut at the start of a step, used where gas_pressure_is_input is true", "gas_pressure", 0.0_wp, cam)
            call add(role_input, "cam["//integer_text(cam)//"].gas_pressure_slope", "Pa s-1", "change of the gas pressure with "// &
               & "time over a step, used where gas_pressure_is_input is true", "gas_pressure_slope", 0.0_wp, cam)
         end do
      end if
      if (allocated(case%dynamics) .and. allocated(case%lash_adjuster)) then
         call add(role_parameter, "supply_pressure_is_input", "1", "does an input give the supply pressure of the lash "// &
            & "adjuster, not the deck?", "has_supply")
         variables(size(variables))%is_logical = .true.
         call add(role_input, "supply_pressure", "Pa", "gauge pressure of the oil at the lash adjuster at the start of a "// &
            & "step, used where supply_pressure_is_input is true", "supply_pressure", case%lash_adjuster%supply_pressure)
         call add(role_input, "supply_pressure_slope", "Pa s-1", "change of the supply pressure with time over a step, used "// &
            & "where supply_pressure_is_input is true", "supply_pressure_slope")
      end if
      call add(role_output, "cam_angle", "rad", "cam angle of the first cam", "cam_angle")
      call add(role_output, "mean_torque_drive", "N m", "torque that drives all camshafts, mean over the step", &
         & "mean_torque_drive")
      call add(role_output, "mean_torque_friction", "N m", "torque for all losses, mean over the step", "mean_torque_friction")
      call add(role_output, "mean_torque_bearings", "N m", "torque for the camshaft bearings, mean over the step", &
         & "mean_torque_bearings")
      call add(role_output, "smallest_torque_drive", "N m", "smallest torque that drives in the step, "//torque_places, &
         & "smallest_torque_drive")
      call add(role_output, "largest_torque_drive", "N m", "largest torque that drives in the step, "//torque_places, &
         & "largest_torque_drive")
      call add(role_output, "estimated_error", "N m", "estimate of the error of mean_torque_drive", "estimated_error")
      do cam = 0, cams
         call add_series(case, cam, variables)
      end do

   contains

      !> Append a variable.
      subroutine add(role, name, unit, meaning, kind, start, of_cam)
         !> What it is for
         integer, intent(in) :: role
         !> Name, unit, meaning, kind
         character(len=*), intent(in) :: name, unit, meaning, kind
         !> Value at the start, zero without it [unit of the variable]
         real(wp), intent(in), optional :: start
         !> Its cam
         integer, intent(in), optional :: of_cam

         type(variable_t) :: one

         one%role = role
         one%name = name
         one%unit = unit
         one%meaning = meaning
         one%kind = kind
         one%key = "-"
         if (present(start)) one%start = start
         if (present(of_cam)) one%cam = of_cam
         variables = [variables, one]
      end subroutine add

   end subroutine list_variables

   !> Parameters: the numbers that the deck gives, but for its operating point.
   subroutine add_keys(deck, variables)
      type(deck_t), intent(in) :: deck
      !> List to extend
      type(variable_t), allocatable, intent(inout) :: variables(:)

      type(variable_t) :: one
      integer, allocatable :: positions(:)
      integer :: i, status

      call given_numbers(deck, positions)
      do i = 1, size(positions)
         associate (key => deck%schema%keys(positions(i)))
            ! speed and oil temperature are inputs
            if (deck%schema%groups(key%group)%name == "operating_point") cycle
            one%role = role_parameter
            one%key = trim(deck%schema%groups(key%group)%name)//"."//trim(key%name)
            one%name = one%key
            one%unit = trim(key%unit%symbol)
            one%meaning = key%meaning
            one%kind = "key"
            read (deck%settings%values(positions(i))%text, *, iostat=status) one%start
            if (status == 0) variables = [variables, one]
         end associate
      end do
   end subroutine add_keys

   !> Outputs: what the camshafts, or the follower of a cam, come to at the end of a step.
   subroutine add_series(case, cam, variables)
      type(case_t), intent(in) :: case
      !> The cam, 0 for the camshafts
      integer, intent(in) :: cam
      !> List to extend
      type(variable_t), allocatable, intent(inout) :: variables(:)

      type(quantity_t), allocatable :: series(:)
      type(variable_t) :: one
      integer :: columns(2), i

      call list_series(case, series)
      if (cam == 0) then
         columns = camshaft_columns(case)
      else
         columns = lobe_columns(case, 1)
      end if
      one%role = role_output
      one%kind = "series"
      one%cam = cam
      do i = columns(1), columns(2)
         one%place = i - columns(1)
         one%key = series(i)%name
         one%name = one%key
         if (cam > 0) one%name = "cam["//integer_text(cam)//"]."//one%name
         one%unit = trim(series(i)%unit)
         one%meaning = series(i)%description
         variables = [variables, one]
      end do
   end subroutine add_series

   !> The table for the library of an FMU: a line for each variable.
   pure subroutine write_variables(variables, text)
      !> The variables
      type(variable_t), intent(in) :: variables(:)
      !> The table
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = ""
      do i = 1, size(variables)
         associate (one => variables(i))
            text = text//one%kind//" "//integer_text(one%cam)//" "//integer_text(one%place)//" "//one%key//" "// &
               & number_text(one%start)//new_line("a")
         end associate
      end do
   end subroutine write_variables

end module camroller_fmu_variables
