!> Where a film law is outside its range: when a word is due, and what it says.
module test_film_range
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_film, only : groups_t, law_dowson_higginson, law_masjedi_khonsari, law_masjedi_khonsari_rough, law_table
   use camroller_film_range, only : distance_outside, film_range_t, matters, note_film, range_in_words
   implicit none
   private

   public :: collect_film_range

contains

   subroutine collect_film_range(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a film inside its range everywhere asks for no word", test_inside), &
         new_unittest("a base circle without a loss that counts asks for no word", test_base_circle), &
         new_unittest("the event, or a base circle with a loss, asks for one", test_event), &
         new_unittest("words name group, value, bounds, place, loss and the law that covers it", test_words), &
         new_unittest("a table of solutions has no published bounds to tell", test_table), &
         new_unittest("how far a range is left counts every group, on either side", test_distance) &
         ]
   end subroutine collect_film_range

   !> Groups of a contact.
   pure function groups(speed, load) result(made)
      real(wp), intent(in) :: speed, load
      type(groups_t) :: made

      made = groups_t(speed, 4400.0_wp, load, 0.0_wp, 0.0_wp)
   end function groups

   !> Dowson and Higginson: U from 1e-13 to 1e-10, W* from 1.5e-5 to 3e-4.
   subroutine test_distance(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_range_t) :: range

      call note_film(range, groups(3.0e-10_wp, 1.0e-4_wp), .false., .true., 0.1_wp, 0.5_wp)
      call check(error, distance_outside(range, law_dowson_higginson), log(3.0_wp), thr=1.0e-12_wp)
      if (allocated(error)) return
      call note_film(range, groups(1.0e-11_wp, 3.0e-6_wp), .false., .true., 0.1_wp, 0.5_wp)
      call check(error, distance_outside(range, law_dowson_higginson), log(15.0_wp), thr=1.0e-12_wp)
      if (allocated(error)) return
      call check(error, distance_outside(range, law_table), 0.0_wp)
   end subroutine test_distance

   subroutine test_inside(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_range_t) :: range

      call note_film(range, groups(1.0e-11_wp, 1.0e-4_wp), .true., .true., 0.05_wp, 1.0_wp)
      call check(error, .not. matters(range) .and. .not. range%share > 0.0_wp)
   end subroutine test_inside

   subroutine test_base_circle(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_range_t) :: range

      call note_film(range, groups(1.0e-11_wp, 1.0e-4_wp), .true., .true., 0.1_wp, 0.4_wp)
      call note_film(range, groups(1.0e-11_wp, 4.0e-6_wp), .false., .false., 0.0005_wp, 0.6_wp)
      call check(error, .not. matters(range) .and. range%share > 0.5_wp)
   end subroutine test_base_circle

   subroutine test_event(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_range_t) :: range

      call note_film(range, groups(1.0e-11_wp, 1.0e-4_wp), .true., .true., 0.1_wp, 0.4_wp)
      call note_film(range, groups(1.0e-11_wp, 4.0e-6_wp), .false., .false., 0.01_wp, 0.6_wp)
      call check(error, matters(range), "a loss on the base circle")
      if (allocated(error)) return
      range = film_range_t()
      call note_film(range, groups(2.0e-10_wp, 1.0e-4_wp), .false., .true., 0.0_wp, 0.4_wp)
      call check(error, matters(range), "the event")
   end subroutine test_event

   subroutine test_words(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_range_t) :: range
      character(len=:), allocatable :: words

      call note_film(range, groups(1.0e-11_wp, 1.0e-4_wp), .true., .true., 0.1_wp, 0.5_wp)
      call note_film(range, groups(1.0e-11_wp, 4.0e-6_wp), .false., .false., 0.1_wp, 0.5_wp)
      call range_in_words(range, law_dowson_higginson, words)
      call check(error, words, "on the base circle, where 50 % of the follower's friction arises; W* down to 4e-6, published "// &
         & "for 1.5e-5 to 0.0003; film.law 'moes' covers that")
      if (allocated(error)) return
      ! Beyond the speeds of Dowson and Higginson, but not of Pan and Hamrock
      range = film_range_t()
      call note_film(range, groups(2.0e-10_wp, 1.0e-4_wp), .false., .true., 0.1_wp, 1.0_wp)
      call range_in_words(range, law_masjedi_khonsari, words)
      call check(error, words, "in the event, where 100 % of the follower's friction arises; U up to 2e-10, published for "// &
         & "1e-12 to 1e-10; film.law 'pan_hamrock' and 'moes' cover that")
      if (allocated(error)) return
      range = film_range_t()
      call note_film(range, groups_t(1.0e-11_wp, 6000.0_wp, 4.0e-4_wp, 2.0e-4_wp, 0.1_wp), .false., .true., 0.1_wp, 1.0_wp)
      call range_in_words(range, law_masjedi_khonsari_rough, words)
      ! Laws that know neither roughness nor hardness do not stand for one that does
      call check(error, words, "in the event, where 100 % of the follower's friction arises; sigma/R up to 0.0002, "// &
         & "published for 0 to 4e-5; hardness/E' up to 0.1, published for 0.005 to 0.03")
   end subroutine test_words

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_range_t) :: range
      character(len=:), allocatable :: words

      call note_film(range, groups(1.0e-11_wp, 4.0e-6_wp), .false., .false., 0.1_wp, 1.0_wp)
      call range_in_words(range, law_table, words)
      call check(error, words, "on the base circle, where 100 % of the follower's friction arises")
   end subroutine test_table

end module test_film_range
