!> Where a film law leaves its published range over a cycle: which group, how far, in the event or on the base circle, and how much
!> of the friction loss arises there.
!>
!> In: the dimensionless groups at points of a cycle. Out: shares, and a sentence.
module camroller_film_range
   use camroller_kinds, only : wp
   use camroller_film, only : film_law_names, group_count, group_values, groups_t, law_masjedi_khonsari_rough, law_table, &
      & published_range
   use camroller_number_text, only : append_number
   implicit none
   private

   public :: film_range_t, group_names, note_film, matters, outside_words, range_in_words, distance_outside

   !> Part of the friction loss that a film outside of its law's range may have on the base circle without a word [-]
   real(wp), parameter :: small_part = 0.01_wp
   !> Names of the groups; sigma is the composite roughness
   character(len=*), parameter :: group_names(group_count) = [character(len=11) :: "U", "G", "W*", "sigma/R", "hardness/E'"]

   !> Points outside of a range
   type :: film_range_t
      !> Parts of the cycle outside of it: in all, and with the valve off its seat [-]
      real(wp) :: share = 0.0_wp, event_share = 0.0_wp
      !> Sums of the friction torque, each weighted with its part of the cycle: outside, and all [N m]
      real(wp) :: outside_loss = 0.0_wp, loss = 0.0_wp
      !> Smallest and largest of each group outside [-]
      real(wp) :: smallest(group_count) = huge(1.0_wp), largest(group_count) = 0.0_wp
   end type film_range_t

contains

   !> Take note of a point.
   pure subroutine note_film(range, groups, is_inside, in_event, loss, weight)
      !> What is known so far
      type(film_range_t), intent(inout) :: range
      !> Groups at the point
      type(groups_t), intent(in) :: groups
      !> Is it inside of the range, or without a film? Is the valve off its seat?
      logical, intent(in) :: is_inside, in_event
      !> Friction torque of the follower [N m]
      real(wp), intent(in) :: loss
      !> Part of the cycle that it stands for [-]
      real(wp), intent(in) :: weight

      range%loss = range%loss + weight*abs(loss)
      if (is_inside) return
      range%share = range%share + weight
      if (in_event) range%event_share = range%event_share + weight
      range%outside_loss = range%outside_loss + weight*abs(loss)
      range%smallest = min(range%smallest, group_values(groups))
      range%largest = max(range%largest, group_values(groups))
   end subroutine note_film

   !> Is a word due? Not where the film of the base circle alone is outside and next to no loss arises there.
   pure function matters(range) result(verdict)
      !> What is known
      type(film_range_t), intent(in) :: range
      !> Is it?
      logical :: verdict

      verdict = range%share > 0.0_wp .and. (range%event_share > 0.0_wp .or. range%outside_loss > small_part*range%loss)
   end function matters

   !> What a film outside of its range is outside of.
   pure function outside_words(law) result(words)
      !> Position of the law in `film_law_names`
      integer, intent(in) :: law
      !> The beginning of a sentence, with blanks at its end
      character(len=56) :: words

      words = "the film law is outside its published range"
      if (law == law_table) words = "the film is beyond the table of solved contacts"
   end function outside_words

   !> How far the groups are outside: the sum over them of the logarithm of the factor between one and its bound.
   pure function distance_outside(range, law) result(distance)
      !> What is known
      type(film_range_t), intent(in) :: range
      !> Position of the law in `film_law_names`
      integer, intent(in) :: law
      !> The sum; zero where the law has no published range [-]
      real(wp) :: distance

      ! Published bounds of the groups [-]
      real(wp) :: bounds(2, group_count)

      distance = 0.0_wp
      if (law == law_table) return
      bounds = max(published_range(law), tiny(1.0_wp))
      distance = sum(max(0.0_wp, log(bounds(1, :)) - log(max(range%smallest, tiny(1.0_wp))))) &
         & + sum(max(0.0_wp, log(max(range%largest, tiny(1.0_wp))) - log(bounds(2, :))))
   end function distance_outside

   !> Where, which groups with their bounds, how much loss, and which laws cover it.
   pure subroutine range_in_words(range, law, words)
      !> What is known
      type(film_range_t), intent(in) :: range
      !> Position of the law in `film_law_names`
      integer, intent(in) :: law
      !> The words
      character(len=:), allocatable, intent(out) :: words

      ! Published bounds of the groups [-]
      real(wp) :: bounds(2, group_count)
      character(len=:), allocatable :: covering
      integer :: i, other, laws

      words = "in the event and on the base circle"
      if (range%event_share <= 0.0_wp) words = "on the base circle"
      if (range%share - range%event_share <= epsilon(1.0_wp)*range%share) words = "in the event"
      words = words//", where "
      call append_number(words, 100.0_wp*range%outside_loss/max(range%loss, tiny(1.0_wp)), 2)
      words = words//" % of the follower's friction arises"
      if (law == law_table) return
      bounds = published_range(law)
      do i = 1, group_count
         if (range%smallest(i) < bounds(1, i)) then
            words = words//"; "//trim(group_names(i))//" down to "
            call append_number(words, range%smallest(i), 3)
         end if
         if (range%largest(i) > bounds(2, i)) then
            words = words//"; "//trim(group_names(i))//" up to "
            call append_number(words, range%largest(i), 3)
         end if
         if (range%smallest(i) < bounds(1, i) .or. range%largest(i) > bounds(2, i)) then
            words = words//", published for "
            call append_number(words, bounds(1, i), 3)
            words = words//" to "
            call append_number(words, bounds(2, i), 3)
         end if
      end do
      ! Laws for smooth surfaces have no bounds of roughness and hardness since they know neither: they stand for none that does
      if (law == law_masjedi_khonsari_rough) return
      allocate (character(len=0) :: covering)
      laws = 0
      do other = 1, size(film_law_names)
         if (other == law .or. other == law_masjedi_khonsari_rough) cycle
         bounds = published_range(other)
         if (any(range%smallest < bounds(1, :)) .or. any(range%largest > bounds(2, :))) cycle
         if (laws > 0) covering = covering//" and"
         covering = covering//" '"//trim(film_law_names(other))//"'"
         laws = laws + 1
      end do
      if (laws > 0) words = words//"; film.law"//covering//trim(merge(" cover ", " covers", laws > 1))//" that"
   end subroutine range_in_words

end module camroller_film_range
