!> The quasi-static limit of the roller's spin against the integration.
module test_quasi_static
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller, only : wp, pi, error_t, case_t, result_t, run_case, get_series, get_summary, kind_convergence
   use reference_cases, only : thesis_case, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_quasi_static

contains

   subroutine collect_quasi_static(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the integration tends to the quasi-static limit as the roller's inertia vanishes", test_limit), &
         new_unittest("in hot oil the quasi-static slip is within one per cent of the integrated one", test_hot), &
         new_unittest("the energy balance closes in the quasi-static limit", test_energy), &
         new_unittest("loss of contact ends the quasi-static method with an error that names the angle", test_lost) &
         ]
   end subroutine collect_quasi_static

   !> Largest difference of the sliding speed over its largest value.
   subroutine compare(the_case, difference, error)
      type(case_t), intent(in) :: the_case
      !> Difference [-]
      real(wp), intent(out) :: difference
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: other
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Sliding speeds [m/s]
      real(wp), allocatable :: limit(:), integrated(:)

      other = the_case
      other%numerics%method = "quasi_static"
      other%numerics%tolerance = 1.0e-5_wp
      call run_case(other, result, failure)
      if (.not. allocated(failure)) call get_series(result, "sliding_speed", limit, failure)
      other%numerics%method = "rodas5p"
      other%numerics%tolerance = 1.0e-6_wp
      if (.not. allocated(failure)) call run_case(other, result, failure)
      if (.not. allocated(failure)) call get_series(result, "sliding_speed", integrated, failure)
      difference = huge(1.0_wp)
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      difference = maxval(abs(limit - integrated))/maxval(abs(integrated))
   end subroutine compare

   subroutine test_limit(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      ! Differences with the roller's mass falling tenfold twice [-]
      real(wp) :: differences(3)
      integer :: i

      the_case = thesis_case()
      call set_point(the_case, point_speeds(2), point_viscosities(2))
      do i = 1, 3
         the_case%roller%mass = 1.0e-3_wp*0.1_wp**i
         call compare(the_case, differences(i), error)
         if (allocated(error)) return
      end do
      ! the lag behind the balance is the change of the balance over the decay rate: proportional to the inertia
      call check(error, differences(2) < 0.3_wp*differences(1) .and. differences(3) < 0.3_wp*differences(2))
   end subroutine test_limit

   subroutine test_hot(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      ! Difference [-]
      real(wp) :: difference
      integer :: i

      do i = 1, size(point_speeds)
         the_case = thesis_case()
         call set_point(the_case, point_speeds(i), point_viscosities(3))
         call compare(the_case, difference, error)
         if (allocated(error)) return
         call check(error, difference < 1.0e-2_wp)
         if (allocated(error)) return
      end do
   end subroutine test_hot

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Largest residual over mean power lost [-]
      real(wp) :: residual

      the_case = thesis_case()
      the_case%numerics%method = "quasi_static"
      call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call get_summary(result, "relative_energy_residual", residual, failure)
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      call check(error, residual < 1.0e-10_wp)
   end subroutine test_energy

   subroutine test_lost(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      call set_point(the_case, 4000.0_wp*pi/30.0_wp, point_viscosities(2))
      the_case%numerics%method = "quasi_static"
      call run_case(the_case, result, failure)
      call check(error, allocated(failure), "no error")
      if (allocated(error)) return
      call check(error, failure%kind, kind_convergence)
      if (allocated(error)) return
      call check(error, index(failure%message, "no quasi-static balance at cam angle") > 0, failure%message)
   end subroutine test_lost

end module test_quasi_static
