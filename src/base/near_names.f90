!> The known name that a misspelt word was probably meant to be.
!>
!> In: a word, the known names. Out: the nearest of them by edits.
module camroller_near_names
   implicit none
   private

   public :: nearest_name

   !> Letters of a name that may be a misspelt one
   integer, parameter :: longest_name = 64

contains

   !> Length of the known name that a word was probably meant to be.
   pure function nearest_length(word, known) result(length)
      character(len=*), intent(in) :: word
      !> The known names
      character(len=*), intent(in) :: known(:)
      !> The length; 0 where none is near
      integer :: length

      integer :: position

      length = 0
      position = nearest_position(word, known)
      if (position > 0) length = len_trim(known(position))
   end function nearest_length

   !> The known name that a word was probably meant to be; blank where none is near.
   pure function nearest_name(word, known) result(nearest)
      !> The word
      character(len=*), intent(in) :: word
      !> The known names
      character(len=*), intent(in) :: known(:)
      !> The nearest of them, or nothing
      character(len=nearest_length(word, known)) :: nearest

      if (len(nearest) > 0) nearest = known(nearest_position(word, known))
   end function nearest_name

   !> Position of the known name that a word was probably meant to be; 0 where none is near.
   pure function nearest_position(word, known) result(nearest)
      character(len=*), intent(in) :: word
      !> The known names
      character(len=*), intent(in) :: known(:)
      !> The position, or 0
      integer :: nearest

      integer :: i, distance, smallest, shared, most_shared

      nearest = 0
      if (len_trim(word) > longest_name) return
      smallest = max(2, len_trim(word)/3)
      most_shared = -1
      do i = 1, size(known)
         distance = edit_distance(trim(word), trim(known(i)))
         if (index(known(i), trim(word)//"_") == 1) distance = 1
         shared = shared_letters(word, known(i))
         if (distance >= len_trim(known(i)) .or. distance > smallest) cycle
         if (distance == smallest .and. shared <= most_shared) cycle
         smallest = distance
         most_shared = shared
         nearest = i
      end do
   end function nearest_position

   !> Number of letters that two words begin with together.
   pure function shared_letters(one, other) result(number)
      !> The two words
      character(len=*), intent(in) :: one, other
      !> How many
      integer :: number

      do number = 0, min(len_trim(one), len_trim(other)) - 1
         if (one(number + 1:number + 1) /= other(number + 1:number + 1)) return
      end do
   end function shared_letters

   !> Number of letters to insert, delete, replace or swap to make one word the other.
   !>
   !> Source: Damerau (1964), Levenshtein (1966), in the restricted form (no edits between swapped letters).
   pure function edit_distance(one, other) result(distance)
      !> The two words
      character(len=*), intent(in) :: one, other
      !> Number of edits
      integer :: distance

      integer :: table(0:len(one), 0:len(other))
      integer :: i, j

      table(:, 0) = [(i, i=0, len(one))]
      table(0, :) = [(j, j=0, len(other))]
      do j = 1, len(other)
         do i = 1, len(one)
            table(i, j) = min(table(i - 1, j) + 1, table(i, j - 1) + 1, &
               & table(i - 1, j - 1) + merge(0, 1, one(i:i) == other(j:j)))
            if (i < 2 .or. j < 2) cycle
            if (one(i:i) == other(j - 1:j - 1) .and. one(i - 1:i - 1) == other(j:j)) then
               table(i, j) = min(table(i, j), table(max(i - 2, 0), max(j - 2, 0)) + 1)
            end if
         end do
      end do
      distance = table(len(one), len(other))
   end function edit_distance

end module camroller_near_names
