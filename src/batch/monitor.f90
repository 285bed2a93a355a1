!> Somebody who follows a computation of many cases: hears of it, and may ask it to stop.
!>
!> In: cases done, remarks. Out: whether to stop. `monitor_t` itself is silent and stops nothing; a program that has something to
!> say extends it. All its procedures are called by one thread at a time.
module camroller_monitor
   implicit none
   private

   public :: monitor_t

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

   !> Hear that all cases are done or the computation was stopped: what follows is quick, and is not to be stopped.
   subroutine go_on(self)
      !> Who follows
      class(monitor_t), intent(inout) :: self

      associate (unused => self)
      end associate
   end subroutine go_on

end module camroller_monitor
