!> Valve lift over cam angle: analytic laws and tables, with three derivatives.
module camroller_lift
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: lift_t, lift_law_names

   !> Lift laws that can be chosen by name
   character(len=*), parameter :: lift_law_names(*) = [character(len=name_length) :: &
      "power", "polydyne", "polynomial_345", "polynomial_4567", "cycloidal", "table"]

   !> What a case says about its lift; angles are cam angles from full lift, in the order of time
   type :: lift_t
      !> One of `lift_law_names`
      character(len=name_length) :: law = "power"
      !> Maximum lift of the valve [m]; analytic laws only
      real(wp) :: max_lift = 0.0_wp
      !> Angle from the start of lift to full lift [rad]; analytic laws only
      real(wp) :: opening_half_angle = 0.0_wp
      !> Angle from full lift to the end of lift [rad]; analytic laws only
      real(wp) :: closing_half_angle = 0.0_wp
      !> `power`: one exponent n of (1 - x^2)^n; `polydyne`: four exponents of x
      integer, allocatable :: exponents(:)
      !> Table: cam angle from full lift [rad], increasing
      real(wp), allocatable :: table_angle(:)
      !> Table: lift of the valve [m]
      real(wp), allocatable :: table_lift(:)
      !> Root mean square distance allowed between a smoothed curve and the table [m]; zero interpolates
      real(wp) :: smoothing = 0.0_wp
   end type lift_t

end module camroller_lift
