!> Smallest film along the roller: that of the slice with the largest load.
!>
!> In: film law at the speed of the contact, loads. Out: the film. A film is thinner the larger its load is, and slices have the
!> same speeds; oil that leaves at the ends is left out (with an ellipse as slender as a line contact the formula of Hamrock and
!> Dowson (1977) for it, `1 - 0.61 exp(-0.73 k)`, is 1).
module camroller_axial_film
   use camroller_asperity, only : boundary_part_t
   use camroller_film, only : film_line_t
   use camroller_hertz, only : half_width
   use camroller_kinds, only : wp
   use camroller_load_share, only : share_load, share_t
   implicit none
   private

   public :: smallest_film

contains

   !> The film of the slice with the largest load.
   pure function smallest_film(line, load_per_length, radius, modulus, boundary) result(film)
      !> Film law at the speed of the contact
      type(film_line_t), intent(in) :: line
      !> Largest load per length [N/m], above zero; equivalent radius, R [m]; equivalent modulus, E' [Pa]
      real(wp), intent(in) :: load_per_length, radius, modulus
      !> Asperities, where the case has them
      type(boundary_part_t), allocatable, intent(in) :: boundary
      !> Minimum film [m]
      real(wp) :: film

      type(share_t) :: share
      ! Load over E' R L [-], area over that [1/Pa]
      real(wp) :: load, area

      load = load_per_length/(modulus*radius)
      if (allocated(boundary)) then
         area = 2.0_wp*half_width(load_per_length, radius, 1.0_wp, modulus)/(modulus*radius)
         call share_load(line, load, share, boundary%constants, area)
      else
         call share_load(line, load, share)
      end if
      film = share%film_min*radius
   end function smallest_film

end module camroller_axial_film
