!> All integration methods by name.
!>
!> Layer: numerics. In: a name. Out: a `method_t`. A new method is a file and a line here.
module camroller_ode_methods
   use camroller_error, only : error_t
   use camroller_names, only : name_length, find_name
   use camroller_ode, only : method_t
   use camroller_ode_explicit, only : explicit_method_t, new_explicit_method
   use camroller_ode_rosenbrock, only : rosenbrock_method_t, new_rosenbrock_method
   implicit none
   private

   public :: method_facts_t, method_facts, method_names, new_method

   !> What is known of a method beforehand
   type :: method_facts_t
      !> Its name
      character(len=name_length) :: name
      !> Order of the solution, order of its error estimate (0: none, the step is fixed)
      integer :: order, companion_order
      !> Is it stable for every decay rate, whatever the step?
      logical :: is_stiffly_stable
      !> Where it is from
      character(len=80) :: source
   end type method_facts_t

   !> All methods
   type(method_facts_t), parameter :: method_facts(*) = [ &
      & method_facts_t("rodas3", 3, 2, .true., "Sandu et al., Atmos. Environ. 31 (1997) 3459"), &
      & method_facts_t("rodas4", 4, 3, .true., "Hairer and Wanner, Solving ODEs II (1996), VI.4"), &
      & method_facts_t("rodas4p", 4, 3, .true., "Steinebach, TH Darmstadt, preprint 1741 (1995)"), &
      & method_facts_t("rodas5p", 5, 4, .true., "Steinebach, BIT Numer. Math. 63 (2023) 27"), &
      & method_facts_t("bogacki_shampine", 3, 2, .false., "Bogacki and Shampine, Appl. Math. Lett. 2 (1989) 321"), &
      & method_facts_t("dormand_prince", 5, 4, .false., "Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19"), &
      & method_facts_t("euler", 1, 0, .false., "Euler (1768), as in the source thesis")]

   !> Their names
   character(len=name_length), parameter :: method_names(*) = method_facts%name

contains

   !> Make a method by its name.
   subroutine new_method(method, name, components, error)
      !> The method
      class(method_t), allocatable, intent(out) :: method
      !> One of `method_names`
      character(len=*), intent(in) :: name
      !> Number of components of the state
      integer, intent(in) :: components
      !> Deck error for an unknown name, with the list of the known ones
      type(error_t), allocatable, intent(out) :: error

      type(explicit_method_t), allocatable :: explicit_method
      type(rosenbrock_method_t), allocatable :: rosenbrock_method
      integer :: choice

      call find_name("integration method", name, method_names, choice, error)
      if (allocated(error)) return
      select case (name)
      case ("rodas3", "rodas4", "rodas4p", "rodas5p")
         allocate (rosenbrock_method)
         call new_rosenbrock_method(rosenbrock_method, name, components)
         call move_alloc(rosenbrock_method, method)
      case default
         allocate (explicit_method)
         call new_explicit_method(explicit_method, name, components)
         call move_alloc(explicit_method, method)
      end select
   end subroutine new_method

end module camroller_ode_methods
