!> Lists of a camshaft that was made by hand: each is there, has a value for each cam, and nothing that is no number; each cam is
!> between two bearings. Those of decks are checked key by key.
!>
!> In: camshaft and bearings. Out: an error that names the list.
module camroller_cam_lists
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_journal, only : cam_bearings_t
   use camroller_kinds, only : wp
   use camroller_number_text, only : integer_text
   implicit none
   private

   public :: check_cam_lists

contains

   !> Refuse lists that do not fit each other.
   subroutine check_cam_lists(shaft, has_second, error)
      !> Camshaft and bearings
      type(cam_bearings_t), intent(in) :: shaft
      !> Is there a second lobe shape?
      logical, intent(in) :: has_second
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      integer :: cams, bearings

      if (.not. allocated(shaft%bearing_positions) .or. .not. allocated(shaft%cam_positions)) then
         call raise(error, kind_deck, "cam_bearings: bearing_positions and cam_positions must be given")
         return
      end if
      cams = size(shaft%cam_positions)
      bearings = size(shaft%bearing_positions)
      if (bearings < 2 .or. cams < 1) then
         call raise(error, kind_deck, "cam_bearings: there must be two bearings or more, and a cam")
      else if (.not. all(ieee_is_finite(shaft%bearing_positions)) .or. .not. all(ieee_is_finite(shaft%cam_positions))) then
         call raise(error, kind_deck, "cam_bearings: bearing_positions and cam_positions must be numbers")
      else if (any(shaft%bearing_positions(2:) <= shaft%bearing_positions(:bearings - 1))) then
         call raise(error, kind_deck, "cam_bearings: bearing_positions must increase")
      else if (any(shaft%cam_positions < shaft%bearing_positions(1) .or. &
         & shaft%cam_positions > shaft%bearing_positions(bearings))) then
         call raise(error, kind_deck, "cam_bearings: each cam must stand between the first and the last bearing")
      end if
      if (allocated(error)) return
      call check_reals("cam_phases", shaft%cam_phases, cams, error)
      if (.not. allocated(error)) call check_reals("follower_angles", shaft%follower_angles, cams, error)
      if (.not. allocated(error)) call check_integers("cam_lobes", shaft%cam_lobes, cams, merge(2, 1, has_second), error)
      if (allocated(error) .or. .not. allocated(shaft%cam_shafts)) return
      call check_integers("cam_shafts", shaft%cam_shafts, cams, cams, error)
   end subroutine check_cam_lists

   !> Refuse a list of numbers that is not one for each cam.
   subroutine check_reals(name, list, cams, error)
      !> What it is called
      character(len=*), intent(in) :: name
      !> Its numbers [rad]
      real(wp), allocatable, intent(in) :: list(:)
      !> Number of cams
      integer, intent(in) :: cams
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      logical :: is_good

      is_good = allocated(list)
      if (is_good) is_good = size(list) == cams
      if (is_good) is_good = all(ieee_is_finite(list))
      if (.not. is_good) call raise(error, kind_deck, "cam_bearings: "//name//" must have a number for each of the "// &
         & integer_text(cams)//" cams")
   end subroutine check_reals

   !> Refuse a list of whole numbers that is not one for each cam.
   subroutine check_integers(name, list, cams, most, error)
      !> What it is called
      character(len=*), intent(in) :: name
      !> Whole numbers
      integer, allocatable, intent(in) :: list(:)
      !> Number of cams, largest number that there is
      integer, intent(in) :: cams, most
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      logical :: is_good

      is_good = allocated(list)
      if (is_good) is_good = size(list) == cams
      if (is_good) is_good = all(list >= 1 .and. list <= most)
      if (.not. is_good) call raise(error, kind_deck, "cam_bearings: "//name//" must have a number from 1 to "// &
         & integer_text(most)//" for each of the "//integer_text(cams)//" cams")
   end subroutine check_integers

end module camroller_cam_lists
