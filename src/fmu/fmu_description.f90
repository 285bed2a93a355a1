!> The model description of an FMU, in FMI 2.0 or 3.0.
!>
!> In: the variables, names. Out: the text of `modelDescription.xml`. Source: Modelica Association, Functional Mock-up Interface,
!> version 2.0 (2014) section 2.2 and 4.3, version 3.0 (2022) section 2.4 and 4.3.
module camroller_fmu_description
   use camroller_kinds, only : wp
   use camroller_fmu_variables, only : variable_t, role_time, role_parameter, role_input, role_output
   use camroller_number_text, only : integer_text, number_text
   use camroller_quotes, only : occurrences, replaced, xml_length, xml_text
   use camroller_unit_dimensions, only : base_names, dimension_t, find_dimension
   use camroller_version, only : version_text
   implicit none
   private

   public :: describe_fmu

   character(len=*), parameter :: n = new_line("a")

contains

   !> The model description.
   subroutine describe_fmu(version, identifier, title, token, turn, variables, text)
      !> Version of FMI, 2 or 3
      integer, intent(in) :: version
      !> Name of the library, title of the case, mark by which library and description know each other
      character(len=*), intent(in) :: identifier, title, token
      !> Time of a turn of the camshaft [s]
      real(wp), intent(in) :: turn
      !> The variables
      type(variable_t), intent(in) :: variables(:)
      !> The text
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = '<?xml version="1.0" encoding="UTF-8"?>'//n//'<fmiModelDescription'//attribute("fmiVersion", integer_text(version)// &
         & ".0")//attribute("modelName", identifier)//attribute(merge("instantiationToken", "guid              ", version == 3), &
         & token)//attribute("description", title)//attribute("version", version_text)//attribute("generationTool", "camroller "// &
         & version_text)//attribute("variableNamingConvention", "structured")//">"//n
      text = text//'  <CoSimulation'//attribute("modelIdentifier", identifier)// &
         & attribute("canHandleVariableCommunicationStepSize", "true")//attribute(merge("canGetAndSetFMUState", &
         & "canGetAndSetFMUstate", version == 3), "true")//attribute(merge("canSerializeFMUState", "canSerializeFMUstate", &
         & version == 3), "true")//"/>"//n
      call add_units(variables, text)
      text = text//'  <LogCategories>'//n//'    <Category name="logStatusError"/>'//n//'    <Category name="logStatusWarning"/>'// &
         & n//'  </LogCategories>'//n
      text = text//'  <DefaultExperiment startTime="0"'//attribute("stopTime", number_text(turn))//attribute("stepSize", &
         & number_text(turn/360.0_wp))//"/>"//n//"  <ModelVariables>"//n
      do i = 1, size(variables)
         call add_variable(version, i - 1, variables(i), text)
      end do
      text = text//"  </ModelVariables>"//n//"  <ModelStructure>"//n
      call add_outputs(version, "Output", variables, text)
      ! All outputs are calculated from the start on: no importer gives them a value
      call add_outputs(version, "InitialUnknown", variables, text)
      text = text//"  </ModelStructure>"//n//"</fmiModelDescription>"//n
   end subroutine describe_fmu

   !> All outputs as part of the model's structure.
   subroutine add_outputs(version, part, variables, text)
      !> Version of FMI
      integer, intent(in) :: version
      !> What they are: the name of an element of FMI 3.0, in the plural one of 2.0
      character(len=*), intent(in) :: part
      type(variable_t), intent(in) :: variables(:)
      !> Text to extend
      character(len=:), allocatable, intent(inout) :: text

      integer :: i

      if (version == 2) text = text//"    <"//part//"s>"//n
      do i = 1, size(variables)
         if (variables(i)%role /= role_output) cycle
         if (version == 3) text = text//"    <"//part//attribute("valueReference", integer_text(i - 1))//"/>"//n
         if (version == 2) text = text//"      <Unknown"//attribute("index", integer_text(i))//"/>"//n
      end do
      if (version == 2) text = text//"    </"//part//"s>"//n
   end subroutine add_outputs

   !> All units, each once.
   subroutine add_units(variables, text)
      type(variable_t), intent(in) :: variables(:)
      !> Text to extend
      character(len=:), allocatable, intent(inout) :: text

      integer :: i, k
      logical :: is_new

      text = text//"  <UnitDefinitions>"//n
      do i = 1, size(variables)
         is_new = variables(i)%unit /= "1" .and. .not. variables(i)%is_logical
         do k = 1, i - 1
            is_new = is_new .and. variables(k)%unit /= variables(i)%unit
         end do
         if (is_new) call add_unit(variables(i)%unit, text)
      end do
      text = text//"  </UnitDefinitions>"//n
   end subroutine add_units

   !> One unit and what it is in the base units of the SI, by which tools convert values and tell units that do not fit.
   subroutine add_unit(unit, text)
      character(len=*), intent(in) :: unit
      !> Text to extend
      character(len=:), allocatable, intent(inout) :: text

      type(dimension_t) :: dimension
      integer :: i
      logical :: is_known

      text = text//"    <Unit"//attribute("name", unit)//">"
      call find_dimension(unit, dimension, is_known)
      if (is_known) then
         text = text//"<BaseUnit"
         do i = 1, size(base_names)
            if (dimension%exponents(i) /= 0) text = text//attribute(base_names(i), integer_text(dimension%exponents(i)))
         end do
         text = text//attribute("factor", number_text(dimension%factor))//attribute("offset", number_text(dimension%offset))//"/>"
      end if
      text = text//"</Unit>"//n
   end subroutine add_unit

   !> One variable.
   subroutine add_variable(version, number, variable, text)
      !> Version of FMI, number of the variable
      integer, intent(in) :: version, number
      type(variable_t), intent(in) :: variable
      !> Text to extend
      character(len=:), allocatable, intent(inout) :: text

      character(len=:), allocatable :: facts, values, element

      facts = attribute("name", variable%name)//attribute("valueReference", integer_text(number))//attribute("description", &
         & variable%meaning)
      values = ""
      if (variable%is_logical) then
         values = attribute("start", merge("true ", "false", abs(variable%start) > 0.0_wp))
      else if (variable%role == role_parameter .or. variable%role == role_input) then
         values = attribute("start", number_text(variable%start))
      end if
      if (variable%unit /= "1") values = values//attribute("unit", variable%unit)
      select case (variable%role)
      case (role_time)
         facts = facts//attribute("causality", "independent")//attribute("variability", "continuous")
      case (role_parameter)
         facts = facts//attribute("causality", "parameter")//attribute("variability", "fixed")//attribute("initial", "exact")
      case (role_input)
         facts = facts//attribute("causality", "input")//attribute("variability", "continuous")
      case default
         facts = facts//attribute("causality", "output")//attribute("variability", "continuous")// &
            & attribute("initial", "calculated")
      end select
      if (version == 3) then
         element = "Float64"
         if (variable%is_logical) element = "Boolean"
         text = text//"    <"//element//facts//values//"/>"//n
      else
         element = "Real"
         if (variable%is_logical) element = "Boolean"
         text = text//"    <ScalarVariable"//facts//"><"//element//values//"/></ScalarVariable>"//n
      end if
   end subroutine add_variable

   !> An attribute with a blank before it; blanks at the ends of its name and value are left out.
   pure function attribute(name, value) result(text)
      !> Its name and value
      character(len=*), intent(in) :: name, value
      !> The attribute
      character(len=len_trim(name) + xml_length(trim(value)) + 5*occurrences(value, '"') + 4) :: text

      text = " "//trim(name)//'="'//replaced(xml_text(trim(value)), '"', "&quot;")//'"'
   end function attribute

end module camroller_fmu_description
