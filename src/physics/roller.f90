module camroller_roller
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: roller_t, spin_names

   !> What counts as pure rolling: with the turning of the contact normal, or as the source takes it
   character(len=*), parameter :: spin_names(*) = [character(len=name_length) :: "exact", "thesis"]

   !> Roller as a spinning ring
   type :: roller_t
      !> Mass of the roller [kg]
      real(wp) :: mass = 0.0_wp
      !> Wall thickness of the ring [m]
      real(wp) :: wall_thickness = 0.0_wp
      !> One of `spin_names`
      character(len=name_length) :: spin = "exact"
   end type roller_t

end module camroller_roller
