!> The quasi-static limit of the roller's spin against the integration.
module test_quasi_static
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller, only : wp, pi, error_t, case_t, result_t, run_case, get_series, get_summary, kind_convergence
   use camroller_balance, only : find_balance
   use camroller_kinds, only : degree
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t, new_model
   use camroller_number_text, only : number_text
   use camroller_remarks, only : remark_lines
   use reference_cases, only : thesis_case, set_point, point_speeds, point_viscosities
   use closeness, only : expect_error, has_failed
   implicit none
   private

   public :: collect_quasi_static

contains

   subroutine collect_quasi_static(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the integration tends to the quasi-static limit as the roller's inertia vanishes", test_limit), &
         new_unittest("in hot oil the quasi-static slip is within one per cent of the integrated one", test_hot), &
         new_unittest("every sliding speed is that of a balance to the accuracy asked for, and the estimate is no less than its " &
            & //"error", test_curve), &
         new_unittest("means and extremes keep to the accuracy asked for", test_accuracy), &
         new_unittest("the balance takes about as many solutions of the contact as the integration", test_cost), &
         new_unittest("a remark says how far the inertia of the roller is from being negligible", test_inertia), &
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
      if (has_failed(failure, error)) return
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

   !> Balances searched for angle by angle, by other steps and without slopes, are what the curve has to pass through.
   subroutine test_curve(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model
      type(position_t) :: position
      type(result_t) :: result
      type(error_t), allocatable :: failure
      real(wp), allocatable :: speeds(:) ! [m/s]
      ! Accuracies asked for [-]
      real(wp), parameter :: accuracies(*) = [1.0e-2_wp, 1.0e-4_wp, 1.0e-6_wp]
      ! Sliding speed of a balance [m/s], decay rate [1/rad], largest error [m/s], estimate of it over the largest speed [-]
      real(wp) :: balance, decay_rate, largest, estimate
      logical :: is_found
      integer :: i, k, point

      do point = 1, size(point_speeds)
         the_case = thesis_case()
         call set_point(the_case, point_speeds(point), point_viscosities(4 - point))
         the_case%numerics%method = "quasi_static"
         call new_model(model, the_case, 1, failure)
         do i = 1, size(accuracies)
            the_case%numerics%accuracy = accuracies(i)
            if (.not. allocated(failure)) call run_case(the_case, result, failure)
            if (.not. allocated(failure)) call get_series(result, "sliding_speed", speeds, failure)
            if (.not. allocated(failure)) call get_summary(result, "estimated_error", estimate, failure)
            if (has_failed(failure, error)) return
            largest = 0.0_wp
            do k = 1, size(speeds)
               ! Files count cam angles from half a turn before full lift
               call find_balance(model, (k - 1)*360.0_wp/size(speeds)*degree - pi, 1.0e-12_wp, position, balance, decay_rate, &
                  & is_found)
               if (.not. is_found) call test_failed(error, "no balance")
               if (allocated(error)) return
               largest = max(largest, abs(speeds(k) - balance))
            end do
            largest = largest/maxval(abs(speeds))
            ! The error allowed for the curve is a hundredth of the accuracy. The smallest slips, 1e-4 of the speed in rolling, are
            ! searched for to 1e-8 of themselves, which is more than a hundredth of the last accuracy
            call check(error, largest <= 0.1_wp*accuracies(i) .and. largest <= estimate, number_text(largest, 3)//" at "// &
               & number_text(accuracies(i))//", estimated "//number_text(estimate, 3))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_curve

   subroutine test_accuracy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: rough, fine
      type(error_t), allocatable :: failure
      ! Accuracies asked for [-]
      real(wp), parameter :: accuracies(*) = [1.0e-2_wp, 1.0e-4_wp]
      character(len=*), parameter :: names(*) = [character(len=26) :: "mean_torque_drive", "mean_torque_friction", &
         & "mean_sliding_speed", "max_sliding_speed", "max_torque_friction", "min_film_thickness_min", "max_hertz_pressure"]
      ! A value of both results [unit of the value]
      real(wp) :: value, reference
      integer :: i, k, point

      do point = 1, size(point_speeds)
         the_case = thesis_case()
         call set_point(the_case, point_speeds(point), point_viscosities(4 - point))
         the_case%numerics%method = "quasi_static"
         ! A hundred times as many balances as at an accuracy of 1e-2
         the_case%numerics%tolerance = 1.0e-12_wp
         call run_case(the_case, fine, failure)
         the_case%numerics%tolerance = 0.0_wp
         do i = 1, size(accuracies)
            the_case%numerics%accuracy = accuracies(i)
            if (.not. allocated(failure)) call run_case(the_case, rough, failure)
            do k = 1, size(names)
               if (.not. allocated(failure)) call get_summary(rough, trim(names(k)), value, failure)
               if (.not. allocated(failure)) call get_summary(fine, trim(names(k)), reference, failure)
               if (has_failed(failure, error)) return
               call check(error, abs(value - reference) <= accuracies(i)*abs(reference), trim(names(k)))
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_accuracy

   subroutine test_cost(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Solutions of the contact, those of the integration [-]
      real(wp) :: evaluations(2)
      integer :: i, point

      do point = 1, size(point_speeds)
         the_case = thesis_case()
         call set_point(the_case, point_speeds(point), point_viscosities(2))
         do i = 1, 2
            the_case%numerics%method = merge("quasi_static", "automatic   ", i == 1)
            if (.not. allocated(failure)) call run_case(the_case, result, failure)
            if (.not. allocated(failure)) call get_summary(result, "counter_evaluations", evaluations(i), failure)
         end do
         if (has_failed(failure, error)) return
         ! One and a half times as many are measured, and thirty times with straight lines between balances
         call check(error, evaluations(1) <= 2.0_wp*evaluations(2))
         if (allocated(error)) return
      end do
   end subroutine test_cost

   subroutine test_inertia(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: i

      ! Cold oil, where the inertia carries the roller over the base circle, and hot oil
      do i = 1, 3, 2
         the_case = thesis_case()
         call set_point(the_case, point_speeds(1), point_viscosities(i))
         the_case%numerics%method = "quasi_static"
         call run_case(the_case, result, failure)
         if (has_failed(failure, error)) return
         call check(error, (index(remark_lines(result%remarks), "the inertia of the roller, which") > 0) .eqv. i == 1)
         if (allocated(error)) return
      end do
   end subroutine test_inertia

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
      if (has_failed(failure, error)) return
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
      call expect_error(error, failure, kind_convergence, "no quasi-static balance at cam angle")
   end subroutine test_lost

end module test_quasi_static
