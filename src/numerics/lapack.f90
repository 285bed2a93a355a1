!> Interfaces of the LAPACK and BLAS routines in use, so that the compiler checks every call.
!>
!> The routines have no state, so they are declared pure; a positive `info` is the only way they fail.
module camroller_lapack
   use camroller_kinds, only : wp
   implicit none
   private

   public :: dgemv, dgbsv, dpbsv, dgesv, dgetrf, dgetrs, dsygv

   interface

      !> Product of a general matrix and a vector, `y = alpha a x + beta y`.
      pure subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: wp
         !> `N`: the matrix itself, not its transpose
         character(len=1), intent(in) :: trans
         !> Rows, columns, leading dimension of `a`, distances of neighbours in both vectors
         integer, intent(in) :: m, n, lda, incx, incy
         !> Factors of the product and of what `y` was [any]
         real(wp), intent(in) :: alpha, beta
         !> The matrix and the vector [any]
         real(wp), intent(in) :: a(lda, *), x(*)
         !> The product [any]
         real(wp), intent(inout) :: y(*)
      end subroutine dgemv

      !> Solve a general banded system; `ab` holds the band from row kl + 1 on and is overwritten by its factors.
      pure subroutine dgbsv(n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
         import :: wp
         !> Unknowns, subdiagonals, superdiagonals, right-hand sides, leading dimension of `ab`, of `b`
         integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb
         !> Entry (i, j) of the matrix at (kl + ku + 1 + i - j, j) [any]
         real(wp), intent(inout) :: ab(ldab, *)
         !> Pivots
         integer, intent(out) :: ipiv(*)
         !> Right-hand sides, then solutions [any]
         real(wp), intent(inout) :: b(ldb, *)
         !> 0, or the column of a zero pivot
         integer, intent(out) :: info
      end subroutine dgbsv

      !> Solve a symmetric positive definite banded system; `ab` is overwritten by its factor.
      pure subroutine dpbsv(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
         import :: wp
         !> `U`: the upper triangle is given
         character(len=1), intent(in) :: uplo
         !> Unknowns, superdiagonals, right-hand sides, leading dimension of `ab`, of `b`
         integer, intent(in) :: n, kd, nrhs, ldab, ldb
         !> Entry (i, j), i <= j, of the matrix at (kd + 1 + i - j, j) [any]
         real(wp), intent(inout) :: ab(ldab, *)
         !> Right-hand sides, then solutions [any]
         real(wp), intent(inout) :: b(ldb, *)
         !> 0, or the order of the minor that is not positive definite
         integer, intent(out) :: info
      end subroutine dpbsv

      !> Eigenvalues and vectors of `a x = lambda b x`, both symmetric and `b` positive definite; `a` becomes the vectors, of norm 1
      !> in `b`, and `b` its factor.
      pure subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
         import :: wp
         !> 1: the problem above; order, leading dimensions, size of the work space
         integer, intent(in) :: itype, n, lda, ldb, lwork
         !> `V`: vectors too; `U`: the upper triangles are given
         character(len=1), intent(in) :: jobz, uplo
         !> The matrices [any]
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         !> Eigenvalues in rising order, work space [any]
         real(wp), intent(out) :: w(*), work(*)
         !> 0, or where the method or the factorisation of `b` fails
         integer, intent(out) :: info
      end subroutine dsygv

      !> Solve a general system; `a` is overwritten by its factors.
      pure subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         !> Unknowns, right-hand sides, leading dimensions of `a` and `b`
         integer, intent(in) :: n, nrhs, lda, ldb
         !> The matrix, then its factors [any]
         real(wp), intent(inout) :: a(lda, *)
         !> Pivots
         integer, intent(out) :: ipiv(*)
         !> Right-hand sides, then solutions [any]
         real(wp), intent(inout) :: b(ldb, *)
         !> 0, or the column of a zero pivot
         integer, intent(out) :: info
      end subroutine dgesv

      !> Factors of a general matrix, which they overwrite.
      pure subroutine dgetrf(m, n, a, lda, ipiv, info)
         import :: wp
         !> Rows, columns, leading dimension of `a`
         integer, intent(in) :: m, n, lda
         !> The matrix, then its factors [any]
         real(wp), intent(inout) :: a(lda, *)
         !> Pivots
         integer, intent(out) :: ipiv(*)
         !> 0, or the column of a zero pivot
         integer, intent(out) :: info
      end subroutine dgetrf

      !> Solve a system with the factors of a general matrix.
      pure subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         !> `N`: the matrix itself, not its transpose
         character(len=1), intent(in) :: trans
         !> Unknowns, right-hand sides, leading dimension of `a`, of `b`
         integer, intent(in) :: n, nrhs, lda, ldb
         !> Factors [any]
         real(wp), intent(in) :: a(lda, *)
         !> Pivots
         integer, intent(in) :: ipiv(*)
         !> Right-hand sides, then solutions [any]
         real(wp), intent(inout) :: b(ldb, *)
         !> 0
         integer, intent(out) :: info
      end subroutine dgetrs

   end interface

end module camroller_lapack
