!> A small valid deck for tests, and what is said about it after a change.
module deck_samples
   use testdrive, only : error_type, test_failed
   use camroller_error, only : error_t, kind_deck
   use camroller_deck, only : deck_t, override_t, parse_deck
   implicit none
   private

   public :: sample_deck, changed_deck, parse_sample, expect_mistake, expect_valid

   character(len=*), parameter :: n = new_line("a")

contains

   !> A valid deck of ten lines with as few keys as there may be.
   pure function sample_deck() result(text)
      !> The deck
      character(len=:), allocatable :: text

      text = "&operating_point speed_rpm = 600 oil_temperature_degC = 60 /"//n// &
         & "&mechanism pivot_to_roller_mm = 20.8 pivot_to_pad_mm = 35.5 pivot_to_cam_mm = 31.5 "// &
         & "roller_arm_angle_deg = -3.5"//n//"   valve_axis_angle_deg = 37.5 base_radius_mm = 18 contact_width_mm = 13.7 /"//n// &
         & "&roller radius_mm = 8.5 mass_kg = 0.0088 wall_thickness_mm = 2.4 /"//n// &
         & "&lift max_lift_mm = 9.5 opening_half_angle_deg = 70 exponents = 4 /"//n// &
         & "&masses valve_kg = 0.0432 finger_kg = 0.0418 /"//n// &
         & "&spring stiffness_N_m = 25000 precompression_mm = 8.4 base_circle_load_N = 64 /"//n// &
         & "&materials cam_modulus_GPa = 170 roller_modulus_GPa = 204 cam_poisson_ratio = 0.28 "// &
         & "roller_poisson_ratio = 0.29 /"//n//"&surface cam_roughness_um = 0.1 roller_roughness_um = 0.1 /"//n// &
         & "&lubricant viscosity_Pa_s = 0.0305 pressure_viscosity_coefficient_per_GPa = 22 /"//n
   end function sample_deck

   !> The sample with one piece of text replaced by another.
   pure function changed_deck(old, new) result(text)
      !> What stands in the sample
      character(len=*), intent(in) :: old
      !> What to put there; where the old text is blank, what to add at the end
      character(len=*), intent(in) :: new
      !> The deck
      character(len=:), allocatable :: text

      integer :: place

      text = sample_deck()
      if (old == "") then
         text = text//new//n
         return
      end if
      place = index(text, old)
      text = text(:place - 1)//new//text(place + len(old):)
   end function changed_deck

   !> Read a text as a deck called `sample.nml`.
   subroutine parse_sample(text, deck, raised)
      !> The text
      character(len=*), intent(in) :: text
      !> The deck
      type(deck_t), intent(out) :: deck
      !> What the reader says
      type(error_t), allocatable, intent(out) :: raised

      type(override_t) :: none(0)

      call parse_deck(deck, text, "sample.nml", "test/data/", none, raised)
   end subroutine parse_sample

   !> After a change the deck has one mistake, and its message begins with some words.
   subroutine expect_mistake(error, old, new, message)
      !> Outcome of the test; nothing is tried where it is known already
      type(error_type), allocatable, intent(inout) :: error
      !> What stands in the sample
      character(len=*), intent(in) :: old
      !> What to put there; added at the end where the old text is blank
      character(len=*), intent(in) :: new
      !> How the message begins, without the name of the deck
      character(len=*), intent(in) :: message

      type(deck_t) :: deck
      type(error_t), allocatable :: raised

      if (allocated(error)) return
      call parse_sample(changed_deck(old, new), deck, raised)
      if (.not. allocated(raised)) then
         call test_failed(error, "accepted: "//new)
      else if (index(raised%message, "sample.nml:"//message) /= 1) then
         call test_failed(error, "expected '"//message//"', got '"//raised%message//"'")
      else if (raised%kind /= kind_deck) then
         call test_failed(error, "not a deck error: "//message)
      end if
   end subroutine expect_mistake

   !> After a change the deck is still valid.
   subroutine expect_valid(error, old, new)
      !> Outcome of the test; nothing is tried where it is known already
      type(error_type), allocatable, intent(inout) :: error
      !> What stands in the sample
      character(len=*), intent(in) :: old
      !> What to put there; added at the end where the old text is blank
      character(len=*), intent(in) :: new

      type(deck_t) :: deck
      type(error_t), allocatable :: raised

      if (allocated(error)) return
      call parse_sample(changed_deck(old, new), deck, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
   end subroutine expect_valid

end module deck_samples
