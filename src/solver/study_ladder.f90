!> The ways to integrate that a study compares: every method over a ladder of tolerances or steps.
!>
!> Layer: solver. In: nothing. Out: rungs, each of which sets the numerics of a case.
module camroller_study_ladder
   use camroller_kinds, only : wp, degree
   use camroller_names, only : name_length
   use camroller_case, only : numerics_t, quasi_static
   use camroller_ode_methods, only : method_facts
   implicit none
   private

   public :: rung_t, make_ladder, numerics_of, fixed_steps

   !> One way to integrate
   type :: rung_t
      !> One of the methods
      character(len=name_length) :: method
      !> Tolerance of the sliding speed over a step; zero for a fixed step [-]
      real(wp) :: tolerance = 0.0_wp
      !> Fixed step; zero for a method that controls its error [rad]
      real(wp) :: step = 0.0_wp
   end type rung_t

   !> Powers of ten of the tolerances
   integer, parameter :: first_power = 1, last_power = 9
   !> Fixed steps, the printed one of one degree among them [deg]
   real(wp), parameter :: fixed_steps(*) = [2.0_wp, 1.0_wp, 0.5_wp, 0.2_wp, 0.1_wp, 0.05_wp, 0.02_wp, 0.01_wp, &
      & 0.005_wp, 0.002_wp, 0.001_wp]
   !> Rungs of the quasi-static limit
   integer, parameter :: most_quasi_static = 3
   !> Those of a quick study [deg]
   real(wp), parameter :: few_steps(*) = [1.0_wp, 0.1_wp]
   !> Powers of ten of its tolerances
   integer, parameter :: few_powers(*) = [2, 4, 6]

contains

   !> All rungs, method by method; last the quasi-static limit, a model whose error does not go away with its tolerance.
   subroutine make_ladder(rungs, is_quick)
      !> The rungs
      type(rung_t), allocatable, intent(out) :: rungs(:)
      !> A few of each method only?
      logical, intent(in) :: is_quick

      integer, allocatable :: powers(:)
      ! Fixed steps [deg]
      real(wp), allocatable :: steps(:)
      integer :: method, i

      powers = [(i, i=first_power, last_power)]
      steps = fixed_steps
      if (is_quick) then
         powers = few_powers
         steps = few_steps
      end if
      allocate (rungs(0))
      do method = 1, size(method_facts)
         if (method_facts(method)%companion_order > 0) then
            rungs = [rungs, (rung_t(method_facts(method)%name, tolerance=10.0_wp**(-powers(i))), i=1, size(powers))]
         else
            rungs = [rungs, (rung_t(method_facts(method)%name, step=steps(i)*degree), i=1, size(steps))]
         end if
      end do
      rungs = [rungs, (rung_t(quasi_static, tolerance=10.0_wp**(-powers(i))), i=1, min(size(powers), most_quasi_static))]
   end subroutine make_ladder

   !> Numerics of a case with one way to integrate.
   pure function numerics_of(rung, standard) result(numerics)
      !> The way to integrate
      type(rung_t), intent(in) :: rung
      !> Everything else
      type(numerics_t), intent(in) :: standard
      !> The numerics
      type(numerics_t) :: numerics

      numerics = standard
      numerics%method = rung%method
      if (rung%tolerance > 0.0_wp) numerics%tolerance = rung%tolerance
      if (rung%step > 0.0_wp) numerics%step = rung%step
   end function numerics_of

end module camroller_study_ladder
