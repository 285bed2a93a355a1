!> Time that LAPACK's dense factors, the solutions with them and BLAS' products with a matrix take: every call in a program passes
!> here.
!>
!> The linker puts these procedures in the place of LAPACK's, `-Wl,--wrap=dgetrf_,--wrap=dgetrs_,--wrap=dgemv_`. Nothing is timed
!> unless asked for.
module bench_lapack_clock
   use, intrinsic :: iso_c_binding, only : c_int, c_double, c_char, c_size_t
   use camroller_kinds, only : wp
   use bench_clock, only : seconds_used
   implicit none
   private

   public :: lapack_t, start_lapack_clock, read_lapack_clock

   !> Seconds and calls since the start: factors; solutions; products
   type :: lapack_t
      !> [s]
      real(wp) :: factors = 0.0_wp, solutions = 0.0_wp, products = 0.0_wp
      !> Calls
      integer :: factors_made = 0, solutions_made = 0, products_made = 0
   end type lapack_t

   ! style: module because the procedures are called by LAPACK's names and have nowhere else to put what they count
   type(lapack_t), save :: clock
   logical, save :: is_on = .false.

   interface
      !> LAPACK's own dgetrf
      subroutine real_dgetrf(m, n, a, lda, pivots, info) bind(c, name="__real_dgetrf_")
         import :: c_int, c_double
         !> Rows, columns, leading dimension
         integer(c_int), intent(in) :: m, n, lda
         !> The matrix, then its factors [any]
         real(c_double), intent(inout) :: a(*)
         !> Pivots
         integer(c_int), intent(out) :: pivots(*)
         !> 0, or the column of a zero pivot
         integer(c_int), intent(out) :: info
      end subroutine real_dgetrf

      !> LAPACK's own dgetrs
      subroutine real_dgetrs(trans, n, sides, a, lda, pivots, b, ldb, info, length) bind(c, name="__real_dgetrs_")
         import :: c_int, c_double, c_char, c_size_t
         !> Transposed or not
         character(kind=c_char), intent(in) :: trans(*)
         !> Unknowns, right-hand sides, leading dimensions
         integer(c_int), intent(in) :: n, sides, lda, ldb
         !> Factors [any]
         real(c_double), intent(in) :: a(*)
         !> Pivots
         integer(c_int), intent(in) :: pivots(*)
         !> Right-hand sides, then solutions [any]
         real(c_double), intent(inout) :: b(*)
         !> 0
         integer(c_int), intent(out) :: info
         !> Length of `trans`
         integer(c_size_t), value :: length
      end subroutine real_dgetrs

      !> BLAS' own dgemv
      subroutine real_dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy, length) bind(c, name="__real_dgemv_")
         import :: c_int, c_double, c_char, c_size_t
         !> Transposed or not
         character(kind=c_char), intent(in) :: trans(*)
         !> Rows, columns, leading dimension, distances of neighbours
         integer(c_int), intent(in) :: m, n, lda, incx, incy
         !> Factors of the product and of what y was; the matrix; the vector [any]
         real(c_double), intent(in) :: alpha, beta, a(*), x(*)
         !> The product [any]
         real(c_double), intent(inout) :: y(*)
         !> Length of `trans`
         integer(c_size_t), value :: length
      end subroutine real_dgemv
   end interface

contains

   !> Begin to count.
   subroutine start_lapack_clock()
      clock = lapack_t()
      is_on = .true.
   end subroutine start_lapack_clock

   !> End counting and say what was counted.
   function read_lapack_clock() result(read)
      !> Since the start
      type(lapack_t) :: read

      is_on = .false.
      read = clock
   end function read_lapack_clock

   !> In the place of dgetrf.
   subroutine wrapped_dgetrf(m, n, a, lda, pivots, info) bind(c, name="__wrap_dgetrf_")
      !> As LAPACK has it
      integer(c_int), intent(in) :: m, n, lda
      real(c_double), intent(inout) :: a(*)
      integer(c_int), intent(out) :: pivots(*), info

      real(wp) :: start

      if (is_on) start = seconds_used()
      call real_dgetrf(m, n, a, lda, pivots, info)
      if (.not. is_on) return
      clock%factors = clock%factors + seconds_used() - start
      clock%factors_made = clock%factors_made + 1
   end subroutine wrapped_dgetrf

   !> In the place of dgetrs.
   subroutine wrapped_dgetrs(trans, n, sides, a, lda, pivots, b, ldb, info, length) bind(c, name="__wrap_dgetrs_")
      !> As LAPACK has it
      character(kind=c_char), intent(in) :: trans(*)
      integer(c_int), intent(in) :: n, sides, lda, ldb
      real(c_double), intent(in) :: a(*)
      integer(c_int), intent(in) :: pivots(*)
      real(c_double), intent(inout) :: b(*)
      integer(c_int), intent(out) :: info
      integer(c_size_t), value :: length

      real(wp) :: start

      if (is_on) start = seconds_used()
      call real_dgetrs(trans, n, sides, a, lda, pivots, b, ldb, info, length)
      if (.not. is_on) return
      clock%solutions = clock%solutions + seconds_used() - start
      clock%solutions_made = clock%solutions_made + 1
   end subroutine wrapped_dgetrs

   !> In the place of dgemv.
   subroutine wrapped_dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy, length) bind(c, name="__wrap_dgemv_")
      !> As BLAS has it
      character(kind=c_char), intent(in) :: trans(*)
      integer(c_int), intent(in) :: m, n, lda, incx, incy
      real(c_double), intent(in) :: alpha, beta, a(*), x(*)
      real(c_double), intent(inout) :: y(*)
      integer(c_size_t), value :: length

      real(wp) :: start

      if (is_on) start = seconds_used()
      call real_dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy, length)
      if (.not. is_on) return
      clock%products = clock%products + seconds_used() - start
      clock%products_made = clock%products_made + 1
   end subroutine wrapped_dgemv

end module bench_lapack_clock
