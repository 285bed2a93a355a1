!> Cylinder pressure on the valves of an engine: what the follower of each lobe shape feels is the pressure of its cylinder at the
!> crank angle, on its own valve.
module test_gas_of_lobes
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, degree, pi, two_pi
   use camroller_case, only : case_t
   use camroller_engine, only : cam_phases_of, cam_turns, crank_angle_at_nose, engine_t
   use camroller_error, only : error_t, kind_usage
   use camroller_gas, only : gas_force
   use camroller_kept_models, only : kept_models_t
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : build_models, run_case, run_next_case
   use camroller_saved_simulation, only : restore_simulation, save_simulation
   use camroller_simulation, only : simulation_t, start_simulation
   use closeness, only : expect_error, has_failed
   use lobe_cases, only : two_lobes
   use reference_cases, only : skewed_case
   implicit none
   private

   public :: collect_gas_of_lobes

   !> Senses of rotation
   character(len=*), parameter :: senses(2) = [character(len=15) :: "away_from_pivot", "towards_pivot"]
   !> Areas of the valves of both lobe shapes [m^2]
   real(wp), parameter :: areas(2) = [7.0e-4_wp, 5.0e-4_wp]
   !> Largest pressure [Pa]
   real(wp), parameter :: largest = 3.0e5_wp

contains

   subroutine collect_gas_of_lobes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("all valves of an engine feel the pressure of their cylinder at the crank angle", test_crank_angle), &
         new_unittest("the second of two equal lobes has the cycle of one lobe with a table turned by hand", test_turned_table), &
         new_unittest("without an engine each lobe shape has the table from its own nose", test_without_engine), &
         new_unittest("models kept for another pressure have the same bits as new ones, on both lobe shapes", test_kept), &
         new_unittest("a block of the second lobe shape with another valve or place that no state shows is refused", test_blocks) &
         ]
   end subroutine collect_gas_of_lobes

   !> Pressure of a cylinder, smooth and of the period of the engine's working cycle.
   elemental function pressure_at(engine, crank_angle) result(pressure)
      !> The engine
      type(engine_t), intent(in) :: engine
      !> Crank angle from the firing of the cylinder [rad]
      real(wp), intent(in) :: crank_angle
      !> Gauge pressure [Pa]
      real(wp) :: pressure

      pressure = largest*exp(2.0_wp*cos((crank_angle - 40.0_wp*degree)/cam_turns(engine)) - 2.0_wp)
   end function pressure_at

   !> Two equal lobes, one each for two cylinders out of three, which fire in the order 1, 3, 2.
   function engine_case(strokes, sense, full_lift) result(case)
      !> Strokes of a working cycle
      integer, intent(in) :: strokes
      !> Sense of rotation
      character(len=*), intent(in) :: sense
      !> Crank angles of full lift [degree]
      real(wp), intent(in) :: full_lift(2)
      !> The case
      type(case_t) :: case

      type(case_t) :: follower
      integer :: i

      follower = skewed_case(sense)
      case = two_lobes(follower%lift, follower%lift, [1, 2])
      case%mechanism = follower%mechanism
      case%masses = follower%masses
      case%spring = follower%spring
      allocate (case%engine, case%gas_force)
      case%engine%cylinders = 3
      case%engine%displacement = 1.0e-3_wp
      case%engine%strokes = strokes
      case%engine%firing_order = [1, 3, 2]
      case%engine%full_lift = full_lift*degree
      case%engine%cam_cylinders = [2, 3]
      case%cam_bearings%cam_phases = cam_phases_of(case%engine, case%cam_bearings%cam_lobes)
      case%gas_force%angle = [(i*degree, i=-180, 180)]
      case%gas_force%pressure = pressure_at(case%engine, case%engine%full_lift(1) + cam_turns(case%engine)*case%gas_force%angle)
      case%gas_force%pressure(361) = case%gas_force%pressure(1)
      case%gas_force%valve_area = areas(1)
      case%gas_force%second_valve_area = areas(2)
   end function engine_case

   !> Crank angles of the firing of each cylinder, and the phases of the cams, tell at which of its own angles each cam is.
   subroutine test_crank_angle(error)
      type(error_type), allocatable, intent(out) :: error
      ! The spline's error with a row for each degree: of the order of the sixth power of a degree, 3e-11, times the sixth
      ! derivative over the pressure, which is below 1e3 here, over 720 [-]
      real(wp), parameter :: allowed = 1.0e-10_wp
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: failure
      ! Crank angle from the firing of cylinder 1, from that of the cam's cylinder, cam angle from the cam's full lift [rad]
      real(wp) :: crank_angle, own_crank_angle, angle
      ! Force and what it has to be [N]
      real(wp) :: force, expected
      integer :: strokes, sense, cam, i

      do strokes = 2, 4, 2
         do sense = 1, 2
            case = engine_case(strokes, senses(sense), [470.0_wp, 250.0_wp])
            call build_models(case, models, failure)
            if (has_failed(failure, error)) return
            associate (engine => case%engine, bearings => case%cam_bearings, turns => cam_turns(case%engine))
               do cam = 1, 2
                  do i = 1, 72
                     crank_angle = 10.0_wp*i*degree
                     ! Cylinder 3 fires after a third of the working cycle, cylinder 2 after two thirds
                     own_crank_angle = crank_angle - merge(1, 2, engine%cam_cylinders(cam) == 3)*two_pi*turns/3.0_wp
                     angle = (crank_angle - crank_angle_at_nose(engine, bearings%cam_lobes))/turns - bearings%cam_phases(cam)
                     force = gas_force(models(bearings%cam_lobes(cam))%gas, angle)
                     expected = pressure_at(engine, own_crank_angle)*areas(bearings%cam_lobes(cam))
                     call check(error, abs(force - expected) <= allowed*largest*areas(1), &
                        & "off by "//number_text(force - expected, 6)//" N of "//number_text(expected, 6))
                     if (allocated(error)) return
                  end do
               end do
            end associate
         end do
      end do
   end subroutine test_crank_angle

   !> Full lift of the second lobe shape 220 degrees of crank angle before that of the first: 110 rows of a degree of cam angle.
   subroutine test_turned_table(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=18) :: "contact_load", "sliding_speed", &
         & "film_thickness_min", "friction_contact"]
      integer, parameter :: rows = 110
      ! Round-off of the splines, magnified by steps of other lengths within the tolerance of the integration [-]
      real(wp), parameter :: allowed = 1.0e-9_wp
      type(case_t) :: case, alone
      type(result_t) :: both, result
      type(error_t), allocatable :: failure
      ! Difference and largest value [unit of the series]
      real(wp) :: difference, size_of_series
      integer :: sense, i

      do sense = 1, 2
         case = engine_case(4, senses(sense), [470.0_wp, 250.0_wp])
         alone = case
         deallocate (alone%second_lift, alone%engine, alone%cam_bearings)
         alone%gas_force%valve_area = areas(2)
         ! The second lobe's nose is 110 degrees of cam angle before the first one's
         alone%gas_force%pressure(:360) = cshift(case%gas_force%pressure(:360), -rows)
         alone%gas_force%pressure(361) = alone%gas_force%pressure(1)
         call run_case(case, both, failure)
         if (.not. allocated(failure)) call run_case(alone, result, failure)
         if (has_failed(failure, error)) return
         do i = 1, size(names)
            associate (second => both%series_values(:, find_quantity(both%series, "lobe_2_"//trim(names(i)))), &
               & by_hand => result%series_values(:, find_quantity(result%series, trim(names(i)))))
               difference = maxval(abs(second - by_hand))
               size_of_series = maxval(abs(by_hand))
            end associate
            call check(error, difference <= allowed*size_of_series, trim(names(i))//": off by "// &
               & number_text(difference/size_of_series, 3)//" of its largest value")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_turned_table

   subroutine test_without_engine(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: failure
      real(wp) :: angle ! [rad]
      integer :: i

      case = engine_case(4, senses(1), [470.0_wp, 250.0_wp])
      deallocate (case%engine, case%gas_force%second_valve_area)
      call build_models(case, models, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      do i = 1, 36
         if (allocated(error)) return
         angle = 10.0_wp*i*degree
         call check(error, abs(gas_force(models(1)%gas, angle) - gas_force(models(2)%gas, angle)) <= 0.0_wp, &
            & "the lobes differ without an engine")
      end do
   end subroutine test_without_engine

   !> Kept models are of a case with half the pressure and other valves.
   subroutine test_kept(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, before
      type(kept_models_t) :: kept
      type(result_t) :: alone, after
      type(error_t), allocatable :: failure

      case = engine_case(4, senses(1), [470.0_wp, 250.0_wp])
      before = case
      before%gas_force%pressure = 0.5_wp*case%gas_force%pressure
      before%gas_force%second_valve_area = areas(1)
      call run_case(case, alone, failure)
      if (.not. allocated(failure)) call run_next_case(kept, "a", before, after, failure)
      if (.not. allocated(failure)) call run_next_case(kept, "a", case, after, failure)
      if (has_failed(failure, error)) return
      call check(error, all(transfer(after%summary_values, [0_int64]) == transfer(alone%summary_values, [0_int64])), &
         & "a bit differs")
   end subroutine test_kept

   !> The pressure acts on the closed valve alone, where the rigid train does not feel it.
   subroutine test_blocks(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, other
      type(simulation_t) :: simulation
      integer(int8), allocatable :: block(:)
      type(error_t), allocatable :: failure
      integer :: i

      case = engine_case(4, senses(1), [470.0_wp, 470.0_wp])
      where (abs(case%gas_force%angle) < 150.0_wp*degree) case%gas_force%pressure = 0.0_wp
      call start_simulation(simulation, case, pi, failure, lobe=2)
      if (.not. allocated(failure)) call save_simulation(simulation, block, failure)
      if (.not. allocated(failure)) call restore_simulation(simulation, case, block, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      do i = 1, 2
         if (allocated(error)) return
         other = case
         if (i == 1) other%gas_force%second_valve_area = nearest(areas(2), 1.0_wp)
         if (i == 2) other%engine%full_lift(2) = other%engine%full_lift(2) + 1.0e-9_wp
         call restore_simulation(simulation, other, block, failure)
         call expect_error(error, failure, kind_usage, "belongs to another case")
      end do
   end subroutine test_blocks

end module test_gas_of_lobes
