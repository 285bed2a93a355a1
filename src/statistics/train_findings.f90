!> What a host should know of a step of a flexible train: where the model is no longer valid, or the train fails.
!>
!> In: model, states at the points that the means of a step are made of. Out: `train_findings_t`, from which `step_remarks` makes
!> words.
module camroller_train_findings
   use camroller_flexible_sample, only : relieved_part
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   implicit none
   private

   public :: train_findings_t, worst_t, note_train, join_trains

   !> The largest of the values met, and where
   type :: worst_t
      !> The value [unit of the value]
      real(wp) :: value = -huge(1.0_wp)
      !> Its cam angle from full lift [rad]
      real(wp) :: angle = 0.0_wp
   end type worst_t

   !> Findings at the points evaluated
   type :: train_findings_t
      !> Tension in the joint of finger and pivot [N]
      type(worst_t) :: tension
      !> Place of an adjuster's plunger along its axis, and against it [m]
      type(worst_t) :: rise, fall
      !> Pressure of its chamber below that of the surroundings [Pa]
      type(worst_t) :: suction
      !> Part of the spring's compression that waves take from coils, as `relieved_part` has it [-]
      type(worst_t) :: relief
      !> Valve's lift, with its sign turned, opposite full lift, and the largest lift of a rigid train there [m]
      type(worst_t) :: closing, cam_lift
   end type train_findings_t

   !> Part of the turn, about the angle opposite full lift, in which a valve is looked at: bounces of one that does close are over
   !> by then, but at speeds at which it hardly closes at all [-]
   real(wp), parameter :: opposite_part = 0.125_wp

contains

   !> Add a state to the findings.
   pure subroutine note_train(findings, model, state, angle)
      !> The findings
      type(train_findings_t), intent(inout) :: findings
      !> Model of the lobe, with a flexible train
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle

      associate (values => state%flexible, lift => state%position%lift, modes => model%flexible%modes%count)
         call note_worst(findings%tension, -values%joint_force, angle)
         if (abs(modulo(angle, two_pi) - pi) <= pi*opposite_part) then
            call note_worst(findings%closing, -lift, angle)
            call note_worst(findings%cam_lift, lift - values%lift_error, angle)
         end if
         if (allocated(model%flexible%adjuster)) then
            call note_worst(findings%rise, values%plunger_travel, angle)
            call note_worst(findings%fall, -values%plunger_travel, angle)
            call note_worst(findings%suction, -values%chamber_pressure, angle)
         end if
         if (modes > 0) call note_worst(findings%relief, relieved_part(model, lift, values%modes(:modes)), angle)
      end associate
   end subroutine note_train

   !> Let the worst take in a value.
   pure subroutine note_worst(worst, value, angle)
      !> The worst so far
      type(worst_t), intent(inout) :: worst
      !> The value [unit of the value]
      real(wp), intent(in) :: value
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle

      if (value <= worst%value) return
      worst%value = value
      worst%angle = angle
   end subroutine note_worst

   !> Findings of one part of a step and of the next.
   elemental function join_trains(one, next) result(both)
      !> Findings of each
      type(train_findings_t), intent(in) :: one, next
      !> Of both
      type(train_findings_t) :: both

      both%tension = worse(one%tension, next%tension)
      both%rise = worse(one%rise, next%rise)
      both%fall = worse(one%fall, next%fall)
      both%suction = worse(one%suction, next%suction)
      both%relief = worse(one%relief, next%relief)
      both%closing = worse(one%closing, next%closing)
      both%cam_lift = worse(one%cam_lift, next%cam_lift)
   end function join_trains

   !> The worse of two.
   elemental function worse(one, next) result(worst)
      !> Both
      type(worst_t), intent(in) :: one, next
      !> The first of them where they are equal
      type(worst_t) :: worst

      worst = one
      if (next%value > one%value) worst = next
   end function worse

end module camroller_train_findings
