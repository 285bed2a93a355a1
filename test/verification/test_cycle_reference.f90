!> Whole cycles against an independent solution.
!>
!> The tables are made by test/reference/cycle_reference.py, which shares no line with the solver: own laws, scipy's root finder,
!> Radau and LSODA. Its header says how far both integrators agree.
module test_cycle_reference
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_cycle, only : cycle_t, state_at
   use camroller_quadrature, only : gauss_legendre
   use camroller_torque_list, only : of_geometric, of_contact, of_needle, of_guide, of_roller_inertia
   use labelled_table, only : label_length, read_table
   use closeness, only : check_close, check_scaled
   use reference_cases, only : named_case, make_model, make_cycle
   implicit none
   private

   public :: collect_cycle_reference

   !> Numbers in a row of the tables
   integer, parameter :: columns = 19, mean_columns = 9
   !> Quantities of a row after the angle
   character(len=20), parameter :: quantity_names(18) = [character(len=20) :: "load", "sliding_speed", "roller_spin", "film_min", &
      "film_central", "asperity_load", "real_area", "film_traction", "boundary_friction", "traction", "rolling_resistance", &
      "needle_torque", "drive", "geometric", "contact", "needle", "guide", "inertia"]
   character(len=16), parameter :: case_names(5) = [character(len=16) :: "hot_slow", "warm", "cold_fast", "source_hot_slow", &
      "skewed_reversed"]
   !> Agreement of the state at a given sliding speed: 13 digits are printed, the asperity integrals are good to 1e-12 [-]
   real(wp), parameter :: state_tolerance = 1.0e-11_wp
   !> The same where the lift is a table: what its spline leaves of the second derivative [-]
   real(wp), parameter :: table_tolerance = 1.0e-8_wp
   !> Agreement of the integrated sliding speed: both references agree to 3e-9, our steps and the curve through them leave more [-]
   real(wp), parameter :: slip_tolerance = 2.0e-8_wp
   !> Agreement of mean torques: both references agree to 1e-7 of the mean drive torque [-]
   real(wp), parameter :: mean_tolerance = 2.0e-7_wp

contains

   subroutine collect_cycle_reference(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("at the reference's sliding speed every force and torque agrees", test_states), &
         new_unittest("hot and slow: the integrated cycle agrees", test_hot_slow), &
         new_unittest("warm: the integrated cycle agrees", test_warm), &
         new_unittest("cold and fast: the integrated cycle agrees", test_cold_fast), &
         new_unittest("the source's bookkeeping: the integrated cycle agrees", test_source), &
         new_unittest("another geometry that turns the other way: the integrated cycle agrees", test_skewed) &
         ]
   end subroutine collect_cycle_reference

   !> Quantities of a state in the order of the table.
   pure function quantities(state) result(values)
      type(state_t), intent(in) :: state
      real(wp) :: values(18)

      values = [state%contact%load, state%contact%sliding_speed, state%contact%roller_spin, state%contact%film_min, &
         state%contact%film_central, state%contact%asperity_load, state%contact%real_area, &
         state%contact%shear/(1.0_wp - state%contact%real_area/state%contact%apparent_area), state%contact%boundary_capacity, &
         state%contact%traction, state%contact%rolling_resistance, state%contact%bearing_torque, state%torque_drive, &
         state%torques([of_geometric, of_contact, of_needle, of_guide, of_roller_inertia])]
   end function quantities

   !> What a difference of each quantity is judged by: its own size; what asperities carry by the load, of which it is a part that
   !> may be left over by a subtraction; torques by the largest of them, since they pass through zero.
   pure function scales(row) result(sizes)
      real(wp), intent(in) :: row(:)
      real(wp) :: sizes(18)

      sizes = abs(row(2:19))
      sizes([6, 9]) = sizes(1)
      sizes(13:18) = max(maxval(sizes(13:18)), 1.0e-2_wp)
   end function scales

   subroutine test_states(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      real(wp) :: values(18), sizes(18)
      integer :: i, k, status

      call read_table("cycle_reference.csv", columns, rows, error, names)
      if (allocated(error)) return
      if (size(names) < 100) call test_failed(error, "rows are missing")
      if (allocated(error)) return
      do i = 1, size(names)
         case = named_case(names(i))
         call make_model(case, model, error)
         if (allocated(error)) return
         call evaluate_state(model, rows(1, i)*degree, rows(3, i), state, status)
         if (status /= 0) call test_failed(error, "no state")
         if (allocated(error)) return
         values = quantities(state)
         sizes = scales(rows(:, i))
         do k = 1, 18
            call check_scaled(error, values(k), rows(1 + k, i), sizes(k), &
               merge(table_tolerance, state_tolerance, names(i) == "skewed_reversed"), trim(quantity_names(k)))
            if (allocated(error)) then
               call add_place(names(i), rows(1, i), error)
               return
            end if
         end do
      end do
   end subroutine test_states

   !> Say where a comparison failed.
   subroutine add_place(name, angle, error)
      character(len=*), intent(in) :: name
      ! Cam angle from full lift [deg]
      real(wp), intent(in) :: angle
      type(error_type), intent(inout) :: error
      character(len=12) :: text

      write (text, "(f0.1)") angle
      error%message = trim(name)//" at "//trim(text)//" deg: "//error%message
   end subroutine add_place

   subroutine test_hot_slow(error)
      type(error_type), allocatable, intent(out) :: error
      call compare_cycle(case_names(1), error)
   end subroutine test_hot_slow

   subroutine test_warm(error)
      type(error_type), allocatable, intent(out) :: error
      call compare_cycle(case_names(2), error)
   end subroutine test_warm

   subroutine test_cold_fast(error)
      type(error_type), allocatable, intent(out) :: error
      call compare_cycle(case_names(3), error)
   end subroutine test_cold_fast

   subroutine test_source(error)
      type(error_type), allocatable, intent(out) :: error
      call compare_cycle(case_names(4), error)
   end subroutine test_source

   subroutine test_skewed(error)
      type(error_type), allocatable, intent(out) :: error
      call compare_cycle(case_names(5), error)
   end subroutine test_skewed

   !> Sliding speed at the reference's angles, and means over the cycle.
   subroutine compare_cycle(name, error)
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(state_t) :: state
      type(error_t), allocatable :: failure
      integer :: i, hint

      call read_table("cycle_reference.csv", columns, rows, error, names)
      if (allocated(error)) return
      case = named_case(name)
      case%numerics%method = "dormand_prince"
      ! of the largest sliding speed; the smallest are three to four decades below
      case%numerics%tolerance = 1.0e-11_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      hint = 1
      do i = 1, size(names)
         if (names(i) /= name) cycle
         call state_at(cycle, model, rows(1, i)*degree, hint, state, failure)
         call check_close(error, state%contact%sliding_speed, rows(3, i), slip_tolerance, "sliding speed")
         if (allocated(error)) then
            call add_place(name, rows(1, i), error)
            return
         end if
      end do
      call compare_means(name, model, cycle, error)
   end subroutine compare_cycle

   !> Means over the cycle by quadrature over each piece between two stops.
   subroutine compare_means(name, model, cycle, error)
      character(len=*), intent(in) :: name
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      real(wp) :: means(mean_columns)
      integer :: i, k

      call read_table("cycle_reference_means.csv", mean_columns, rows, error, names)
      if (allocated(error)) return
      means = cycle_means(model, cycle)
      do i = 1, size(names)
         if (names(i) /= name) cycle
         do k = 1, 6
            call check_scaled(error, means(k), rows(k, i), rows(1, i), mean_tolerance, "a mean torque")
            if (allocated(error)) return
         end do
         do k = 7, mean_columns
            call check_close(error, means(k), rows(k, i), slip_tolerance, "mean slip or mean roller speed")
            if (allocated(error)) return
         end do
      end do
   end subroutine compare_means

   !> Means in the order of the table: Gauss-Legendre quadrature over pieces of a degree, cut at the stops.
   function cycle_means(model, cycle) result(means)
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      real(wp) :: means(mean_columns)
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Places and weights [-], start and width of a piece [rad]
      real(wp) :: places(6), weights(6), start, width
      integer :: segment, pieces, piece, i, hint

      call gauss_legendre(places, weights)
      means = 0.0_wp
      hint = 1
      do segment = 1, size(cycle%stops) - 1
         pieces = ceiling((cycle%stops(segment + 1) - cycle%stops(segment))/degree)
         width = (cycle%stops(segment + 1) - cycle%stops(segment))/pieces
         do piece = 1, pieces
            start = cycle%stops(segment) + (piece - 1)*width
            do i = 1, size(places)
               call state_at(cycle, model, start + 0.5_wp*width*(1.0_wp + places(i)), hint, state, failure)
               means = means + 0.5_wp*width*weights(i)/two_pi*[state%torque_drive, &
                  state%torques([of_geometric, of_contact, of_needle, of_guide, of_roller_inertia]), &
                  state%contact%sliding_speed/state%contact%cam_surface_speed, &
                  state%contact%sliding_speed/state%contact%rolling_speed, state%contact%roller_spin]
            end do
         end do
      end do
   end function cycle_means

end module test_cycle_reference
