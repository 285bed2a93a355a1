!> Accelerations of a flexible train's finger and of the plunger under it, by a moment on the finger and a force along the axis.
!>
!> In: model, place of the finger's centre of mass. Out: both accelerations, or how they follow moment and force.
module camroller_flexible_inertia
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   implicit none
   private

   public :: solve_finger, invert_inertia

contains

   !> Accelerations of finger and plunger, which move as one along the axis.
   pure subroutine solve_finger(model, coupling, axial, moment, pivot, finger)
      !> The model, with an adjuster
      type(model_t), intent(in) :: model
      !> Inertia between both [kg m]
      real(wp), intent(in) :: coupling
      !> Force along the axis [N]
      real(wp), intent(in) :: axial
      !> Moment about the pivot [N m]
      real(wp), intent(in) :: moment
      !> Acceleration of the pivot [m/s^2]
      real(wp), intent(out) :: pivot
      !> Acceleration of the finger [rad/s^2]
      real(wp), intent(out) :: finger

      ! Mass that moves along the axis [kg], determinant [kg^2 m^2]
      real(wp) :: mass, determinant

      mass = model%flexible%finger_mass + model%flexible%adjuster%given%plunger_mass
      determinant = mass*model%train%finger_inertia - coupling**2
      pivot = (model%train%finger_inertia*axial - coupling*moment)/determinant
      finger = (mass*moment - coupling*axial)/determinant
   end subroutine solve_finger

   !> Accelerations of finger and pivot over moment and force along the axis.
   pure subroutine invert_inertia(model, centre_slope, inverse)
      !> The model
      type(model_t), intent(in) :: model
      !> Way of the finger's centre of mass along the adjuster's axis over the finger's angle [m]
      real(wp), intent(in) :: centre_slope
      !> Rows: finger, pivot; columns: moment, axial force [1/kg m^2], [1/kg m], [1/kg]
      real(wp), intent(out) :: inverse(2, 2)

      ! Mass along the axis [kg], inertia between both [kg m], determinant [kg^2 m^2]
      real(wp) :: mass, coupling, determinant

      inverse = 0.0_wp
      inverse(1, 1) = 1.0_wp/model%train%finger_inertia
      if (.not. allocated(model%flexible%adjuster)) return
      mass = model%flexible%finger_mass + model%flexible%adjuster%given%plunger_mass
      coupling = model%flexible%finger_mass*centre_slope
      determinant = mass*model%train%finger_inertia - coupling**2
      inverse = reshape([mass, -coupling, -coupling, model%train%finger_inertia], [2, 2])/determinant
   end subroutine invert_inertia

end module camroller_flexible_inertia
