!> Somebody who follows a computation of many cases: hears of it, and may ask it to stop, up to the end of the result file.
!>
!> In: cases done, remarks. Out: whether to stop, also as an error of one who makes the file. `monitor_t` itself is silent and stops
!> nothing; a program that has something to say extends it. All its procedures are called by one thread at a time.
module camroller_monitor
   use camroller_error, only : error_t, raise, kind_unfinished
   implicit none
   private

   public :: monitor_t, heed_stop

   !> The silent one
   type :: monitor_t
   contains
      procedure :: wants_stop => never
      procedure :: show => hide_progress
      procedure :: say => drop_remark
      procedure :: end_cases => go_on
   end type monitor_t

contains

   !> Shall it stop, with what is done kept?
   function never(self) result(verdict)
      !> Who follows
      class(monitor_t), intent(inout) :: self
      !> Shall it?
      logical :: verdict

      verdict = .false.
      associate (unused => self)
      end associate
   end function never

   !> Hear how far it is.
   subroutine hide_progress(self, done, total)
      !> Who follows
      class(monitor_t), intent(inout) :: self
      !> Cases done, and all cases
      integer, intent(in) :: done, total

      associate (unused => self, unheard => [done, total])
      end associate
   end subroutine hide_progress

   !> Hear a remark.
   subroutine drop_remark(self, text, is_loss)
      !> Who follows
      class(monitor_t), intent(inout) :: self
      !> The remark, one or several lines without the end of the last one
      character(len=*), intent(in) :: text
      !> Is something lost?
      logical, intent(in) :: is_loss

      associate (unused => self, unheard => text, unheard_loss => is_loss)
      end associate
   end subroutine drop_remark

   !> Hear that no further case is computed, since all are done or the computation was stopped.
   subroutine go_on(self)
      !> Who follows
      class(monitor_t), intent(inout) :: self

      associate (unused => self)
      end associate
   end subroutine go_on

   !> An error where the making of the file of a sweep shall stop, with its part files kept.
   subroutine heed_stop(monitor, error)
      !> Who follows
      class(monitor_t), intent(inout) :: monitor
      !> What went wrong before; gets the stop where nothing did
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (monitor%wants_stop()) call raise(error, kind_unfinished, "the sweep was stopped with no case to do, before its file "// &
         & "was made; continue with --resume")
   end subroutine heed_stop

end module camroller_monitor
