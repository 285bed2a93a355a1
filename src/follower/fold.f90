!> Diagnosis of a cycle that could not be integrated: cam angles at which the equilibrium of the finger has several loads for one
!> sliding speed (a fold).
!>
!> In: model, cam angle. Out: whether there are such sliding speeds, and a sentence for the error message. Where friction presses
!> the roller onto the cam, friction raises the load, the load raises the oil's viscosity, and the viscosity raises friction.
!> Where this feedback exceeds one, load and traction jump from one equilibrium to another, and no continuous solution for the
!> spin exists.
module camroller_fold
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_convergence, cause_several_balances
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_dual, only : dual_t
   use camroller_joint_forces, only : finger_moment, contact_moment, has_pivot_friction, set_pivot_forces
   use camroller_pivot_friction, only : pivot_forces_t, pivot_moment
   use camroller_contact_forces, only : contact_t, setting_t, parts_t, set_speeds, prepare_contact, evaluate_contact
   use camroller_state, only : evaluate_loading
   implicit none
   private

   public :: has_fold, explain_end

   !> Sliding speeds that are tried in each direction: down to 1e-36 of the largest
   integer, parameter :: speeds = 120
   !> Ratio of one to the next [-]
   real(wp), parameter :: speed_ratio = 0.5_wp
   !> Loads that are tried
   integer, parameter :: loads = 100
   !> Ratio of the largest to that without friction, and of that to the smallest [-]
   real(wp), parameter :: load_range = 3.0_wp
   !> Fall of the moment between two loads over the moment to be balanced, below which it may be rounding [-]
   real(wp), parameter :: least_fall = 1.0e-6_wp

contains

   !> Add to an error of an integration why it came to its end there, where the reason can be seen.
   subroutine explain_end(model, angle, largest, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle at which the integration came to its end [rad]
      real(wp), intent(in) :: angle
      !> Largest sliding speed [m/s]
      real(wp), intent(in) :: largest
      !> The error; left alone where not allocated
      type(error_t), allocatable, intent(inout) :: error

      if (.not. allocated(error)) return
      if (error%kind /= kind_convergence) return
      if (has_fold(model, angle, largest)) then
         error%cause = cause_several_balances
         error%message = error%message//"; for one sliding speed the finger is in balance there at several loads: friction "// &
            & "raises the load, the load the oil's viscosity, and that the friction"
      end if
   end subroutine explain_end

   !> Is there a sliding speed at which the finger is in balance at several loads?
   function has_fold(model, angle, largest) result(verdict)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Largest sliding speed [m/s]
      real(wp), intent(in) :: largest
      !> Is there one?
      logical :: verdict

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]; sliding speed [m/s]
      real(wp) :: force, sliding_speed
      integer :: i, status

      verdict = .false.
      if (.not. model%is_consistent) return
      call evaluate_loading(model, angle, position, force, moments, status)
      if (status /= 0) return
      if (.not. contact_moment(model, position, moments) > 0.0_wp) return
      do i = 0, speeds - 1
         sliding_speed = largest*speed_ratio**i
         verdict = has_several_loads(model, position, moments, sliding_speed)
         if (.not. verdict) verdict = has_several_loads(model, position, moments, -sliding_speed)
         if (verdict) return
      end do
   end function has_fold

   !> Is the finger in balance at several loads for one sliding speed?
   pure function has_several_loads(model, position, moments, sliding_speed) result(verdict)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Is it?
      logical :: verdict

      type(contact_t) :: contact
      type(setting_t) :: setting
      type(parts_t) :: parts
      type(pivot_forces_t) :: forces
      ! Friction of the pivot [N m]
      type(dual_t) :: friction
      ! Moment that keeps contact [N m]
      real(wp) :: kept
      ! Moment to be balanced, moment too much, the largest of it at smaller loads [N m]; load without friction, load [N]
      real(wp) :: moment, excess, highest, free_load, load
      ! Change of the film ratio [-]
      real(wp) :: change
      integer :: i

      verdict = .false.
      call set_speeds(model, position, sliding_speed, contact)
      moment = finger_moment(model, position, moments)
      kept = contact_moment(model, position, moments)
      free_load = kept/position%normal_arm
      if (has_pivot_friction(model)) call set_pivot_forces(model, position, moments, 0.0_wp, forces, 0.0_wp)
      contact%load = free_load
      contact%film_ratio = 0.0_wp
      call prepare_contact(model, position, contact, 0.0_wp, setting)
      highest = -huge(1.0_wp)
      do i = 0, loads
         load = free_load*load_range**(2.0_wp*i/loads - 1.0_wp)
         contact%film_ratio = 0.0_wp
         call evaluate_contact(model, position, setting, load, contact, parts, change)
         excess = load*position%normal_arm - moment &
            & + model%linkage%sense*(contact%tangential_force*position%tangent_arm + contact%bearing_torque)
         if (has_pivot_friction(model)) then
            friction = pivot_moment(model%joints%pivot, forces, dual_t(load, 0.0_wp), dual_t(contact%tangential_force, 0.0_wp))
            excess = excess - friction%value
         end if
         ! What was too much and is too little at a larger load passes zero twice more
         verdict = highest > 0.0_wp .and. excess < -least_fall*kept
         if (verdict) return
         highest = max(highest, excess)
      end do
   end function has_several_loads

end module camroller_fold
