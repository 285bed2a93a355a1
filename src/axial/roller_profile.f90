!> Shape of the roller along its axis, and how it stands on the cam.
!>
!> In: what a case says, a place along the axis. Out: how far the unloaded roller is from the cam there.
module camroller_roller_profile
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_number_text, only : integer_text
   implicit none
   private

   public :: roller_profile_t, profile_names, profile_flat, profile_crowned, profile_logarithmic, coupling_names, &
      & coupling_half_space, coupling_none, fewest_slices, most_slices, check_roller_profile, profile_gap

   !> Shapes along the axis
   character(len=*), parameter :: profile_names(*) = [character(len=name_length) :: "flat", "crowned", "logarithmic"]
   !> Positions in it
   integer, parameter :: profile_flat = 1, profile_crowned = 2, profile_logarithmic = 3
   !> What a slice makes of the load of the others: they press its place down as on an elastic half space, or they do not count
   character(len=*), parameter :: coupling_names(*) = [character(len=name_length) :: "half_space", "none"]
   !> Positions in it
   integer, parameter :: coupling_half_space = 1, coupling_none = 2
   !> Bounds of the number of slices
   integer, parameter :: fewest_slices = 11, most_slices = 201

   !> What a case says about the roller along its axis
   type :: roller_profile_t
      !> One of `profile_names`
      character(len=name_length) :: profile = "flat"
      !> Radius of the crown, of a crowned roller [m]
      real(wp) :: crown_radius = 0.0_wp
      !> Load at which a logarithmic roller has the same load on all of its length [N]
      real(wp) :: design_load = 0.0_wp
      !> Drop of a logarithmic roller at its ends; zero: as the logarithm has it, infinite [m]
      real(wp) :: end_drop = 0.0_wp
      !> Angle between roller and cam in the plane of the contact's length and normal; positive presses the end at positive
      !> places [rad]
      real(wp) :: tilt = 0.0_wp
      !> One of `coupling_names`
      character(len=name_length) :: coupling = "half_space"
      !> Number of slices
      integer :: slices = 41
      !> Are loads of all slices reported over the cycle?
      logical :: slice_series = .false.
   end type roller_profile_t

contains

   !> Refuse what cannot be.
   subroutine check_roller_profile(profile, error)
      !> What is given
      type(roller_profile_t), intent(in) :: profile
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      integer :: shape, coupling

      call find_name("roller profile", profile%profile, profile_names, shape, error)
      if (.not. allocated(error)) call find_name("coupling of slices", profile%coupling, coupling_names, coupling, error)
      if (allocated(error)) return
      if (shape == profile_crowned .and. .not. profile%crown_radius > 0.0_wp) then
         call raise(error, kind_deck, "roller profile: a crowned roller needs the radius of its crown, above zero")
      else if (shape == profile_logarithmic .and. .not. profile%design_load > 0.0_wp) then
         call raise(error, kind_deck, "roller profile: a logarithmic roller needs a design load above zero")
      else if (.not. profile%end_drop >= 0.0_wp) then
         call raise(error, kind_deck, "roller profile: the drop at the ends must not be negative")
      else if (profile%slices < fewest_slices .or. profile%slices > most_slices) then
         call raise(error, kind_deck, "roller profile: from "//integer_text(fewest_slices)//" to "// &
            & integer_text(most_slices)//" slices")
      end if
   end subroutine check_roller_profile

   !> Gap of the unloaded roller over the cam, where it is zero in the middle.
   !>
   !>     crowned      y^2/(2 r)                                          a circle, for heights far below its radius
   !>     logarithmic  A ln(1/(1 - (1 - e^(-z/A)) (2 y/L)^2)),  A = 2 W_d/(pi E' L)
   !>
   !> The latter with z infinite is Lundberg's (1939); with z the drop at the ends it is that of Johns and Gohar (1981), who choose
   !> `e^(-z/A) = 0.3033 2 b/L`.
   elemental function profile_gap(profile, length, modulus, place) result(gap)
      !> What is given
      type(roller_profile_t), intent(in) :: profile
      !> Length of the roller, L [m], equivalent modulus, E' [Pa], place along the axis, y, from the middle [m]
      real(wp), intent(in) :: length, modulus, place
      !> The gap [m]
      real(wp) :: gap

      ! Height A of the logarithm [m]; 1 - e^(-z/A) [-]
      real(wp) :: height, fullness

      gap = -profile%tilt*place
      if (profile%profile == profile_names(profile_crowned)) then
         gap = gap + place**2/(2.0_wp*profile%crown_radius)
      else if (profile%profile == profile_names(profile_logarithmic)) then
         height = 2.0_wp*profile%design_load/(pi*modulus*length)
         fullness = 1.0_wp
         if (profile%end_drop > 0.0_wp) fullness = 1.0_wp - exp(-profile%end_drop/height)
         gap = gap - height*log(1.0_wp - fullness*(2.0_wp*place/length)**2)
      end if
   end function profile_gap

end module camroller_roller_profile
