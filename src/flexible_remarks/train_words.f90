!> What a run and a host's step tell of a flexible train in the same words, each where the same limit is passed.
!>
!> In: model, a value, where it is met: the speed of a run, or the cam angle of a step. Out: a remark where there is need of one.
module camroller_train_words
   use camroller_kinds, only : wp
   use camroller_lash_adjuster, only : ambient_pressure
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text
   use camroller_remarks, only : add_remark, empty_chamber, open_pivot, open_valve, relieved_spring, remark_t, sinking_plunger, &
      & stopped_plunger
   implicit none
   private

   public :: tell_tension, tell_open_valve, tell_upper_stop, tell_lower_stop, tell_sinking, tell_suction, tell_relief

   !> Acceleration of free fall [m/s^2]
   real(wp), parameter :: gravity = 9.81_wp

contains

   !> Remark on a joint in tension.
   subroutine tell_tension(model, tension, place, remarks, share)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Largest tension [N]
      real(wp), intent(in) :: tension
      !> Where or when, in words
      character(len=*), intent(in) :: place
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Part of the cycle with tension [-]
      real(wp), intent(in), optional :: share

      character(len=:), allocatable :: text

      ! What its weight, which the model has not, would hold is no tension
      if (.not. tension > gravity*model%flexible%finger_mass) return
      text = "the joint of finger and pivot is in tension"
      ! A finger that is free in its lash is drawn by its drag alone
      if (present(share) .and. model%flexible%lash <= 0.0_wp) text = text//" for "//number_text(100.0_wp*share, 3)// &
         & " % of the cycle"
      call add_remark(remarks, open_pivot, text//", by up to "//number_text(tension, 3)//" N at "//place// &
         & "; the model keeps it closed, a real one opens", tension)
   end subroutine tell_tension

   !> Remark on a valve that does not close.
   subroutine tell_open_valve(least_lift, place, remarks, when)
      !> Smallest lift [m]
      real(wp), intent(in) :: least_lift
      !> Where or when, in words
      character(len=*), intent(in) :: place
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> In which cycles, in words that begin with a blank
      character(len=*), intent(in), optional :: when

      character(len=:), allocatable :: text

      if (.not. least_lift > 0.0_wp) return
      text = "the valve does not close"
      if (present(when)) text = text//when
      call add_remark(remarks, open_valve, text//": it stays open by at least "//number_text(1.0e3_wp*least_lift, 3)//" mm at "// &
         & place, least_lift)
   end subroutine tell_open_valve

   !> Remark on a plunger at its upper stop.
   subroutine tell_upper_stop(model, highest, place, remarks)
      !> Model of the lobe, with an adjuster
      type(model_t), intent(in) :: model
      !> Highest place of the plunger [m]
      real(wp), intent(in) :: highest
      !> Where or when, in words
      character(len=*), intent(in) :: place
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      associate (given => model%flexible%adjuster%given)
         if (highest > given%highest) call add_remark(remarks, stopped_plunger, "the plunger of the lash adjuster reaches its "// &
            & "upper stop at "//place//": it rises no further", highest - given%highest)
      end associate
   end subroutine tell_upper_stop

   !> Remark on a plunger at its lower stop.
   subroutine tell_lower_stop(model, lowest, place, remarks)
      !> Model of the lobe, with an adjuster
      type(model_t), intent(in) :: model
      !> Lowest place of the plunger [m]
      real(wp), intent(in) :: lowest
      !> Where or when, in words
      character(len=*), intent(in) :: place
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      associate (given => model%flexible%adjuster%given)
         if (lowest < given%lowest) call add_remark(remarks, stopped_plunger, "the plunger of the lash adjuster sinks onto its "// &
            & "lower stop at "//place//": the stop carries the train, and no longer the oil", given%lowest - lowest)
      end associate
   end subroutine tell_lower_stop

   !> Remark on a plunger that sinks far.
   subroutine tell_sinking(model, lowest, place, remarks)
      !> Model of the lobe, with an adjuster
      type(model_t), intent(in) :: model
      !> Lowest place of the plunger [m]
      real(wp), intent(in) :: lowest
      !> Where or when, in words
      character(len=*), intent(in) :: place
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      ! Way below its rest from which on it sinks far: as high as the closing ramps of cams for adjusters, beyond which the valve
      ! meets its seat at the speed of the flank [m]
      real(wp), parameter :: far = 1.0e-4_wp
      real(wp) :: sink ! Way below its rest [m]

      sink = model%flexible%pivot_place - lowest
      if (sink > far) call add_remark(remarks, sinking_plunger, "the plunger of the lash adjuster sinks by "// &
         & number_text(1.0e3_wp*sink, 3)//" mm below its rest at "//place//", more than a closing ramp is high: the valve "// &
         & "loses lift and meets its seat early", sink)
   end subroutine tell_sinking

   !> Remark on a chamber that is as good as empty.
   subroutine tell_suction(lowest, place, remarks)
      !> Smallest gauge pressure of the chamber [Pa]
      real(wp), intent(in) :: lowest
      !> Where or when, in words
      character(len=*), intent(in) :: place
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      ! Absolute pressure over that of the surroundings below which the chamber is as good as empty [-]
      real(wp), parameter :: vacuum = 0.2_wp

      if (lowest < (vacuum - 1.0_wp)*ambient_pressure) call add_remark(remarks, empty_chamber, "the chamber of the lash "// &
         & "adjuster is nearly at a vacuum, down to "//number_text(1.0e-2_wp*(ambient_pressure + lowest), 2)//" mbar, at "// &
         & place//": its oil gives off air, which is computed by the air's compression alone", -lowest)
   end subroutine tell_suction

   !> Remark on a spring whose waves take all compression from a part of it.
   subroutine tell_relief(ratio, remarks, place, compression)
      !> Largest part of the compression that waves take [-]
      real(wp), intent(in) :: ratio
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Where or when, in words
      character(len=*), intent(in), optional :: place
      !> Largest compression of a part of the spring, as of all of it [m]
      real(wp), intent(in), optional :: compression

      character(len=:), allocatable :: text

      if (.not. ratio > 1.0_wp) return
      text = "waves in the spring take all compression from a part of it, up to "//number_text(ratio, 3)//" times what there is"
      if (present(place)) text = text//", at "//place
      text = text//"; a real spring then leaves its seat or its retainer, which is not computed"
      if (present(compression)) text = text//". A part of it is compressed by up to "//number_text(1.0e3_wp*compression, 4)// &
         & " mm, as of the whole spring; with less than that to its solid length its coils clash"
      call add_remark(remarks, relieved_spring, text, ratio)
   end subroutine tell_relief

end module camroller_train_words
