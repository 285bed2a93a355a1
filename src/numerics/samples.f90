!> Sample points in the unit cube: Sobol sequence, Latin hypercube, independent random points; each computed from its index
!> alone.
!>
!> In: index of a point, axis, seed. Out: a coordinate in [0, 1). Nothing is stored, and no random numbers are drawn in sequence,
!> so any process can compute any point, and memory does not depend on the number of points. Integers of 32 bits are held in 64
!> bits, so that their products do not overflow.
!>
!> Sources: Sobol (1967), doi 10.1016/0041-5553(67)90144-9; Antonov and Saleev (1979), doi 10.1016/0041-5553(79)90085-5, for the
!> order in Gray code; Joe and Kuo (2008), doi 10.1137/070709359, for the direction numbers; McKay, Beckman and Conover (1979),
!> doi 10.2307/1268522, for the Latin hypercube; Luby and Rackoff (1988), doi 10.1137/0217022, for permutations by Feistel
!> rounds.
module camroller_samples
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: sample_names, sobol_axes, sample_sobol, sample_latin_hypercube, sample_independent

   !> Kinds of samples
   character(len=*), parameter :: sample_names(*) = [character(len=name_length) :: "latin_hypercube", "sobol", "random"]
   !> Axes of the Sobol sequence
   integer, parameter :: sobol_axes = 8
   !> Binary digits of a point
   integer, parameter :: digits = 32
   !> 32 and 16 bits that are set
   integer(int64), parameter :: low_32 = 4294967295_int64, low_16 = 65535_int64
   !> Highest degree of a polynomial of the sequence
   integer, parameter :: highest_degree = 5
   !> Primitive polynomials of axes 2 to 8, after Joe and Kuo: degree, inner coefficients as binary digits, first numbers
   integer, parameter :: degrees(2:sobol_axes) = [1, 2, 3, 3, 4, 4, 5]
   integer, parameter :: coefficients(2:sobol_axes) = [0, 1, 1, 2, 1, 4, 2]
   integer, parameter :: first_numbers(highest_degree, 2:sobol_axes) = reshape([ &
      & 1, 0, 0, 0, 0, &
      & 1, 3, 0, 0, 0, &
      & 1, 3, 1, 0, 0, &
      & 1, 1, 1, 0, 0, &
      & 1, 1, 3, 3, 0, &
      & 1, 3, 5, 13, 0, &
      & 1, 1, 5, 5, 17], [highest_degree, sobol_axes - 1])
   !> Rounds of a permutation
   integer, parameter :: rounds = 6

contains

   !> Coordinate of a point of the Sobol sequence; seeds other than 0 shift its binary digits, which keeps its evenness.
   pure function sample_sobol(point, axis, seed) result(coordinate)
      !> Number of the point, from 0
      integer, intent(in) :: point
      !> Number of the axis, from 1 to `sobol_axes`
      integer, intent(in) :: axis
      !> Seed; 0 for the sequence as published
      integer, intent(in) :: seed
      !> Coordinate [-]
      real(wp) :: coordinate

      integer(int64) :: directions(digits), gray, sum
      integer :: i

      call find_directions(axis, directions)
      gray = ieor(int(point, int64), shiftr(int(point, int64), 1))
      sum = 0
      if (seed /= 0) sum = scramble(seed, axis, 0, 0)
      do i = 1, digits
         if (btest(gray, i - 1)) sum = ieor(sum, directions(i))
      end do
      coordinate = real(sum, wp)/real(low_32 + 1, wp)
   end function sample_sobol

   !> Direction numbers of an axis, as integers of 32 binary digits.
   pure subroutine find_directions(axis, directions)
      !> Number of the axis
      integer, intent(in) :: axis
      !> Direction numbers
      integer(int64), intent(out) :: directions(digits)

      integer :: i, j, degree

      if (axis == 1) then
         directions = [(shiftl(1_int64, digits - i), i=1, digits)]
         return
      end if
      degree = degrees(axis)
      do i = 1, degree
         directions(i) = shiftl(int(first_numbers(i, axis), int64), digits - i)
      end do
      do i = degree + 1, digits
         directions(i) = ieor(directions(i - degree), shiftr(directions(i - degree), degree))
         do j = 1, degree - 1
            if (btest(coefficients(axis), degree - 1 - j)) directions(i) = ieor(directions(i), directions(i - j))
         end do
      end do
   end subroutine find_directions

   !> Coordinate of a point of a Latin hypercube: each of as many slices as there are points holds one.
   pure function sample_latin_hypercube(point, points, axis, seed) result(coordinate)
      !> Number of the point, from 0
      integer, intent(in) :: point
      !> Number of points
      integer, intent(in) :: points
      !> Number of the axis, from 1
      integer, intent(in) :: axis
      !> Seed
      integer, intent(in) :: seed
      !> Coordinate [-]
      real(wp) :: coordinate

      coordinate = (real(place_in_permutation(point, points, axis, seed), wp) + sample_independent(point, axis, seed))/ &
         & real(points, wp)
      coordinate = min(coordinate, 1.0_wp - epsilon(1.0_wp))
   end function sample_latin_hypercube

   !> Coordinate of a point that is independent of all others.
   pure function sample_independent(point, axis, seed) result(coordinate)
      !> Number of the point, from 0
      integer, intent(in) :: point
      !> Number of the axis, from 1
      integer, intent(in) :: axis
      !> Seed
      integer, intent(in) :: seed
      !> Coordinate [-]
      real(wp) :: coordinate

      integer(int64) :: high, low

      high = scramble(seed, axis, point, 1)
      low = shiftr(scramble(seed, axis, point, 2), 11)
      coordinate = (real(high, wp)*2097152.0_wp + real(low, wp))/9007199254740992.0_wp
   end function sample_independent

   !> Place of a point in a permutation that belongs to an axis and a seed: halves of its binary digits are mixed in rounds;
   !> a place beyond the last is sent through again.
   pure function place_in_permutation(point, points, axis, seed) result(place)
      !> Number of the point, from 0
      integer, intent(in) :: point
      !> Number of points
      integer, intent(in) :: points
      !> Number of the axis
      integer, intent(in) :: axis
      integer, intent(in) :: seed
      !> Place, from 0 to `points - 1`
      integer(int64) :: place

      integer(int64) :: left, right, former, mask
      integer :: half, i

      half = 1
      do while (shiftl(1_int64, 2*half) < points)
         half = half + 1
      end do
      mask = shiftl(1_int64, half) - 1
      place = point
      do
         left = shiftr(place, half)
         right = iand(place, mask)
         do i = 1, rounds
            former = right
            right = ieor(left, iand(scramble(seed, axis, int(right), 2 + i), mask))
            left = former
         end do
         place = ior(shiftl(left, half), right)
         if (place < points) return
      end do
   end function place_in_permutation

   !> 32 bits that look random and follow from four numbers.
   pure function scramble(seed, axis, point, use) result(bits)
      !> Numbers that they follow from
      integer, intent(in) :: seed, axis, point, use
      !> The bits
      integer(int64) :: bits

      bits = mix(iand(int(seed, int64), low_32))
      bits = mix(ieor(bits, int(64*axis + use, int64)))
      bits = mix(ieor(bits, int(point, int64)))
   end function scramble

   !> Spread every bit of a number over all of its bits; one to one.
   pure function mix(number) result(mixed)
      !> A number of 32 bits
      integer(int64), intent(in) :: number
      !> Another
      integer(int64) :: mixed

      mixed = product_32(ieor(number, shiftr(number, 16)), 2146121005_int64)
      mixed = product_32(ieor(mixed, shiftr(mixed, 15)), 2221713035_int64)
      mixed = iand(ieor(mixed, shiftr(mixed, 16)) + 1831565813_int64, low_32)
   end function mix

   !> Last 32 bits of a product.
   pure function product_32(some, other) result(bits)
      !> Two numbers of 32 bits
      integer(int64), intent(in) :: some, other
      !> The last 32 bits of their product
      integer(int64) :: bits

      bits = iand(some, low_16)*other + shiftl(iand(shiftr(some, 16)*other, low_16), 16)
      bits = iand(bits, low_32)
   end function product_32

end module camroller_samples
