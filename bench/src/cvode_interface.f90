!> Interfaces of the C functions of SUNDIALS 6 that the comparison needs; Debian ships the library without Fortran modules.
module bench_cvode_interface
   use, intrinsic :: iso_c_binding, only : c_int, c_long, c_int64_t, c_double, c_ptr, c_funptr
   implicit none
   private

   public :: new_context, free_context, new_vector, free_vector, vector_data, new_matrix, free_matrix, matrix_data, &
      & new_dense_solver, free_dense_solver
   public :: cvode_create, cvode_init, cvode_reinit, cvode_free, cvode_set_user_data, cvode_set_tolerances, &
      & cvode_set_linear_solver, cvode_set_jacobian, cvode_set_stop_time, cvode_set_max_step, cvode_set_max_steps, &
      & cvode_set_error_file, &
      & cvode_step, cvode_get_rates, cvode_get_linear_rates, cvode_get_jacobians, cvode_get_steps, cvode_get_fails
   public :: bdf, normal, success, tstop_return

   !> Constants of cvode.h
   integer(c_int), parameter :: bdf = 2, normal = 1, success = 0, tstop_return = 1

   interface
      function new_context(communicator, context) bind(c, name="SUNContext_Create") result(flag)
         import :: c_int, c_ptr
         type(c_ptr), value :: communicator
         type(c_ptr), intent(out) :: context
         integer(c_int) :: flag
      end function new_context

      function free_context(context) bind(c, name="SUNContext_Free") result(flag)
         import :: c_int, c_ptr
         type(c_ptr), intent(inout) :: context
         integer(c_int) :: flag
      end function free_context

      function new_vector(length, values, context) bind(c, name="N_VMake_Serial") result(vector)
         import :: c_int64_t, c_double, c_ptr
         integer(c_int64_t), value :: length
         type(c_ptr), value :: values
         type(c_ptr), value :: context
         type(c_ptr) :: vector
      end function new_vector

      subroutine free_vector(vector) bind(c, name="N_VDestroy")
         import :: c_ptr
         type(c_ptr), value :: vector
      end subroutine free_vector

      function vector_data(vector) bind(c, name="N_VGetArrayPointer") result(values)
         import :: c_ptr
         type(c_ptr), value :: vector
         type(c_ptr) :: values
      end function vector_data

      function new_matrix(rows, columns, context) bind(c, name="SUNDenseMatrix") result(matrix)
         import :: c_int64_t, c_ptr
         integer(c_int64_t), value :: rows, columns
         type(c_ptr), value :: context
         type(c_ptr) :: matrix
      end function new_matrix

      subroutine free_matrix(matrix) bind(c, name="SUNMatDestroy")
         import :: c_ptr
         type(c_ptr), value :: matrix
      end subroutine free_matrix

      function matrix_data(matrix) bind(c, name="SUNDenseMatrix_Data") result(values)
         import :: c_ptr
         type(c_ptr), value :: matrix
         type(c_ptr) :: values
      end function matrix_data

      function new_dense_solver(vector, matrix, context) bind(c, name="SUNLinSol_Dense") result(solver)
         import :: c_ptr
         type(c_ptr), value :: vector, matrix, context
         type(c_ptr) :: solver
      end function new_dense_solver

      function free_dense_solver(solver) bind(c, name="SUNLinSolFree") result(flag)
         import :: c_int, c_ptr
         type(c_ptr), value :: solver
         integer(c_int) :: flag
      end function free_dense_solver

      function cvode_create(method, context) bind(c, name="CVodeCreate") result(memory)
         import :: c_int, c_ptr
         integer(c_int), value :: method
         type(c_ptr), value :: context
         type(c_ptr) :: memory
      end function cvode_create

      function cvode_init(memory, rate, time, state) bind(c, name="CVodeInit") result(flag)
         import :: c_int, c_double, c_ptr, c_funptr
         type(c_ptr), value :: memory
         type(c_funptr), value :: rate
         real(c_double), value :: time
         type(c_ptr), value :: state
         integer(c_int) :: flag
      end function cvode_init

      function cvode_reinit(memory, time, state) bind(c, name="CVodeReInit") result(flag)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: memory
         real(c_double), value :: time
         type(c_ptr), value :: state
         integer(c_int) :: flag
      end function cvode_reinit

      subroutine cvode_free(memory) bind(c, name="CVodeFree")
         import :: c_ptr
         type(c_ptr), intent(inout) :: memory
      end subroutine cvode_free

      function cvode_set_user_data(memory, user_data) bind(c, name="CVodeSetUserData") result(flag)
         import :: c_int, c_ptr
         type(c_ptr), value :: memory, user_data
         integer(c_int) :: flag
      end function cvode_set_user_data

      function cvode_set_tolerances(memory, relative, absolute) bind(c, name="CVodeSVtolerances") result(flag)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: memory
         real(c_double), value :: relative
         type(c_ptr), value :: absolute
         integer(c_int) :: flag
      end function cvode_set_tolerances

      function cvode_set_linear_solver(memory, solver, matrix) bind(c, name="CVodeSetLinearSolver") result(flag)
         import :: c_int, c_ptr
         type(c_ptr), value :: memory, solver, matrix
         integer(c_int) :: flag
      end function cvode_set_linear_solver

      function cvode_set_jacobian(memory, jacobian) bind(c, name="CVodeSetJacFn") result(flag)
         import :: c_int, c_ptr, c_funptr
         type(c_ptr), value :: memory
         type(c_funptr), value :: jacobian
         integer(c_int) :: flag
      end function cvode_set_jacobian

      function cvode_set_stop_time(memory, time) bind(c, name="CVodeSetStopTime") result(flag)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: memory
         real(c_double), value :: time
         integer(c_int) :: flag
      end function cvode_set_stop_time

      function cvode_set_max_step(memory, step) bind(c, name="CVodeSetMaxStep") result(flag)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: memory
         real(c_double), value :: step
         integer(c_int) :: flag
      end function cvode_set_max_step

      function cvode_set_max_steps(memory, steps) bind(c, name="CVodeSetMaxNumSteps") result(flag)
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: memory
         integer(c_long), value :: steps
         integer(c_int) :: flag
      end function cvode_set_max_steps

      function cvode_set_error_file(memory, file) bind(c, name="CVodeSetErrFile") result(flag)
         import :: c_int, c_ptr
         type(c_ptr), value :: memory, file
         integer(c_int) :: flag
      end function cvode_set_error_file

      function cvode_step(memory, target_time, state, time, task) bind(c, name="CVode") result(flag)
         import :: c_int, c_double, c_ptr
         type(c_ptr), value :: memory
         real(c_double), value :: target_time
         type(c_ptr), value :: state
         real(c_double), intent(out) :: time
         integer(c_int), value :: task
         integer(c_int) :: flag
      end function cvode_step

      function cvode_get_rates(memory, number) bind(c, name="CVodeGetNumRhsEvals") result(flag)
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: memory
         integer(c_long), intent(out) :: number
         integer(c_int) :: flag
      end function cvode_get_rates

      function cvode_get_linear_rates(memory, number) bind(c, name="CVodeGetNumLinRhsEvals") result(flag)
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: memory
         integer(c_long), intent(out) :: number
         integer(c_int) :: flag
      end function cvode_get_linear_rates

      function cvode_get_jacobians(memory, number) bind(c, name="CVodeGetNumJacEvals") result(flag)
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: memory
         integer(c_long), intent(out) :: number
         integer(c_int) :: flag
      end function cvode_get_jacobians

      function cvode_get_steps(memory, number) bind(c, name="CVodeGetNumSteps") result(flag)
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: memory
         integer(c_long), intent(out) :: number
         integer(c_int) :: flag
      end function cvode_get_steps

      function cvode_get_fails(memory, number) bind(c, name="CVodeGetNumErrTestFails") result(flag)
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: memory
         integer(c_long), intent(out) :: number
         integer(c_int) :: flag
      end function cvode_get_fails
   end interface

end module bench_cvode_interface
