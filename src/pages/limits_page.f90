!> The table of limit speeds for the screen.
!>
!> In: a search that has ended. Out: text.
module camroller_limits_page
   use camroller_kinds, only : wp, per_minute
   use camroller_limit_speeds, only : adjuster_limit, closing_limit, contact_limit, joint_limit, limit_names, limits_t, &
      & seating_limit
   use camroller_number_text, only : integer_text, number_text, right_text
   implicit none
   private

   public :: write_limits_page, unseen_limit

   character(len=*), parameter :: n = new_line("a")
   !> What a search in steps may miss
   character(len=*), parameter :: unseen_limit = "a limit that is passed and regained within a step is not seen"
   !> What stands in the place of a limit that the masses do not give
   character(len=*), parameter :: unknown = "unknown"
   !> Widths of the columns
   integer, parameter :: first_width = 50, speed_width = 16

contains

   !> The page.
   subroutine write_limits_page(search, text)
      !> The search
      type(limits_t), intent(in) :: search
      !> Lines with a heading
      character(len=:), allocatable, intent(out) :: text

      character(len=first_width) :: name
      character(len=:), allocatable :: line, words
      integer :: limit, i
      logical :: has_unknown

      name = "Lowest speed of the camshaft found at which ..."
      text = name//right_text("rigid train", speed_width)
      if (search%is_flexible) text = text//right_text("flexible train", speed_width)
      has_unknown = .false.
      do limit = 1, size(search%rigid)
         name = limit_names(limit)
         if (limit == contact_limit .and. .not. search%is_flexible) name = "cam and roller part with the valve off its seat"
         if (limit == joint_limit .and. search%has_lash) name = trim(name)//" in the event"
         if (limit == seating_limit) name = trim(name)//" "//number_text(search%seating, 3)//" m/s"
         call rigid_text(search, limit, words)
         has_unknown = has_unknown .or. words == unknown
         line = name//right_text(words, speed_width)
         if (search%is_flexible) then
            call flexible_text(search, limit, words)
            line = line//right_text(words, speed_width)
            call comment_text(search, limit, words)
            line = line//words
         end if
         text = text//n//trim(line)
      end do
      if (search%is_flexible) then
         text = text//n//"speeds in rev/min; the flexible train was tried at "//integer_text(search%done)// &
            & " speeds, in steps of "//number_text(search%step*per_minute, 5)//" and then to 1; contact of the rigid "// &
            & "train with the valve off its seat"//n// &
            & unseen_limit//": try a smaller --step"
         if (any(search%period == 0 .and. search%above <= search%highest)) text = text//n//"about: the turns of a motion "// &
            & "without a period differ, and others may pass the limit some tens of rev/min away"
      else
         text = text//n//"speeds in rev/min; the rigid train by its forces without friction, which follow the "// &
            & "square of the speed"
      end if
      if (has_unknown) text = text//n//unknown//": limits of the rigid train's pivot need masses.finger_kg"
      do i = 1, size(search%remarks)
         text = text//n//"remark: "//search%remarks(i)%text
      end do
      if (search%failure /= "") text = text//n//"higher speeds were not tried: "//search%failure
   end subroutine write_limits_page

   !> A limit of the rigid train.
   subroutine rigid_text(search, limit, words)
      type(limits_t), intent(in) :: search
      !> Which limit
      integer, intent(in) :: limit
      character(len=:), allocatable, intent(out) :: words

      if (limit == seating_limit .or. limit == closing_limit) then
         words = "-"
      else if (search%rigid(limit) < 0.0_wp) then
         words = unknown
      else if (search%rigid(limit) > huge(1.0_wp)) then
         words = "never"
      else
         words = number_text(search%rigid(limit)*per_minute, 5)
      end if
      if (limit == adjuster_limit .and. search%is_flexible .and. .not. search%has_adjuster) words = "-"
   end subroutine rigid_text

   !> A limit of the flexible train.
   subroutine flexible_text(search, limit, words)
      type(limits_t), intent(in) :: search
      !> Which limit
      integer, intent(in) :: limit
      character(len=:), allocatable, intent(out) :: words

      if (limit == adjuster_limit .and. .not. search%has_adjuster) then
         words = "-"
      else if (search%above(limit) <= search%highest) then
         call passed_text(search, limit, words)
      else
         words = "above "//number_text(merge(min(search%below(limit), search%above(closing_limit)), search%below(limit), &
            & limit == seating_limit)*per_minute, 5)
      end if
   end subroutine flexible_text

   !> Speed at which a limit is passed: without a period about that one.
   subroutine passed_text(search, limit, words)
      type(limits_t), intent(in) :: search
      !> Which limit
      integer, intent(in) :: limit
      character(len=:), allocatable, intent(out) :: words

      if (search%period(limit) == 0) then
         words = "about "//number_text(search%above(limit)*per_minute, 3)
      else
         words = number_text(search%above(limit)*per_minute, 5)
      end if
   end subroutine passed_text

   !> What else there is to say of a limit: where the train does not repeat itself in each cycle, where it is regained, and where
   !> the valve has no speed of seating.
   subroutine comment_text(search, limit, words)
      type(limits_t), intent(in) :: search
      !> Which limit
      integer, intent(in) :: limit
      character(len=:), allocatable, intent(out) :: words

      words = ""
      if (limit == seating_limit .and. search%above(closing_limit) < min(search%highest, search%above(limit))) then
         call passed_text(search, closing_limit, words)
         words = "   from "//words//" on it does not close"
      end if
      if (.not. search%above(limit) <= search%highest) return
      if (.not. search%below(limit) > 0.0_wp) words = words//"   from the lowest speed tried on"
      if (search%period(limit) == 0) words = words//"   without a period"
      if (search%period(limit) > 1) words = words//"   with a period of "//integer_text(search%period(limit))//" cycles"
      if (search%regained(limit) <= search%highest) words = words//"   regained at "// &
         & number_text(search%regained(limit)*per_minute, 5)
   end subroutine comment_text

end module camroller_limits_page
