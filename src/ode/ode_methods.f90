!> List of all integration methods by name.
!>
!> In: a name. Out: a `method_t`. A new method takes one file and one line here.
module camroller_ode_methods
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_names, only : name_length, find_name
   use camroller_ode, only : method_t
   use camroller_ode_explicit, only : explicit_method_t, new_explicit_method
   use camroller_ode_rosenbrock, only : rosenbrock_method_t, new_rosenbrock_method
   use camroller_ode_implicit, only : radau_method_t, new_radau_method
   use camroller_ode_hermite, only : hermite_method_t, new_hermite_method
   implicit none
   private

   public :: method_facts, method_names, new_method

   !> What is known of a method beforehand
   type :: method_facts_t
      !> Its name
      character(len=name_length) :: name
      !> Order of the solution, order of its error estimate (0: none, the step is fixed)
      integer :: order, companion_order
      !> Components it can have at most
      integer :: max_components
      !> May there be integrals beside these components?
      logical :: takes_integrals = .false.
   end type method_facts_t

   !> No limit to the number of components
   integer, parameter :: unlimited = huge(1)

   !> All methods
   type(method_facts_t), parameter :: method_facts(*) = [ &
      & method_facts_t("rodas5p", 5, 4, unlimited), & ! Steinebach, BIT Numer. Math. 63 (2023) 27
      & method_facts_t("radau5", 5, 3, unlimited), & ! Hairer and Wanner, Solving ODEs II (1996), IV.8
      & method_facts_t("hermite", 6, 5, 1, takes_integrals=.true.), & ! Ours; see Hochbruck and Ostermann, BIT 51 (2011) 889
      & method_facts_t("dormand_prince", 5, 4, unlimited), & ! Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19
      & method_facts_t("euler", 1, 0, unlimited)] ! Euler (1768), as in the source thesis

   !> Their names
   character(len=name_length), parameter :: method_names(*) = method_facts%name

contains

   !> Make a method by its name.
   subroutine new_method(method, name, components, error, integrals)
      !> The method
      class(method_t), allocatable, intent(out) :: method
      !> One of `method_names`
      character(len=*), intent(in) :: name
      !> Number of components of the state
      integer, intent(in) :: components
      !> Deck error for an unknown name, with the list of the known ones; domain error for too many components
      type(error_t), allocatable, intent(out) :: error
      !> How many of the components, the last ones, are integrals: no rate depends on them; absent: none is known to be
      integer, intent(in), optional :: integrals

      type(explicit_method_t), allocatable :: explicit_method
      type(rosenbrock_method_t), allocatable :: rosenbrock_method
      type(radau_method_t), allocatable :: radau_method
      type(hermite_method_t), allocatable :: hermite_method
      integer :: choice, unknowns

      call find_name("integration method", name, method_names, choice, error)
      if (allocated(error)) return
      unknowns = components
      if (present(integrals) .and. method_facts(choice)%takes_integrals) unknowns = components - integrals
      if (unknowns > method_facts(choice)%max_components) then
         call raise(error, kind_domain, "integration method '"//trim(name)//"' is for a single unknown")
         return
      end if
      select case (name)
      case ("rodas5p")
         allocate (rosenbrock_method)
         call new_rosenbrock_method(rosenbrock_method, components)
         call move_alloc(rosenbrock_method, method)
      case ("radau5")
         allocate (radau_method)
         call new_radau_method(radau_method, components)
         call move_alloc(radau_method, method)
      case ("hermite")
         allocate (hermite_method)
         call new_hermite_method(hermite_method, components - 1)
         call move_alloc(hermite_method, method)
      case default
         allocate (explicit_method)
         call new_explicit_method(explicit_method, name, components)
         call move_alloc(explicit_method, method)
      end select
   end subroutine new_method

end module camroller_ode_methods
