module camroller_film
   use camroller_names, only : name_length
   implicit none
   private

   public :: film_t, film_law_names, range_policy_names

   !> Film-thickness laws
   character(len=*), parameter :: film_law_names(*) = [character(len=name_length) :: &
      "dowson_higginson", "pan_hamrock", "masjedi_khonsari", "masjedi_khonsari_rough", "moes"]
   !> What to do where a law is used outside its published range
   character(len=*), parameter :: range_policy_names(*) = [character(len=name_length) :: "warn", "stop"]

   !> Choice of the film law
   type :: film_t
      !> One of `film_law_names`
      character(len=name_length) :: law = "dowson_higginson"
      !> One of `range_policy_names`
      character(len=name_length) :: range_policy = "warn"
   end type film_t

end module camroller_film
