!> Loads along the part of a roller that carries them, in slices of that part.
!>
!> In: roller profile, load, radius. Out: where the loaded part, with a slice without load beside it, begins and ends; loads of its
!> slices; loads of slices of the whole roller.
!>
!> A contact far shorter than the roller has as many slices as one that is as long. Where it ends on the roller, it ends at the same
!> place among its slices for every load, nearly so: what slices make of it goes on smoothly with the load, and its
!> loads keep their shape where those of the roller do.
module camroller_axial_window
   use camroller_hertz, only : half_width
   use camroller_kinds, only : wp
   use camroller_roller_profile, only : roller_profile_t, coupling_half_space, coupling_names, profile_gap
   use camroller_slices, only : load_slices, new_slices, slices_t
   implicit none
   private

   public :: window_t, blunt_ends, fit_window, load_up_to, load_window, loaded_ends, spread_loads, unclear_ends

   !> Slices without load beside a loaded part that ends on the roller; how many they may be less and more [slices]
   real(wp), parameter :: margin = 1.0_wp, less = 0.5_wp, more = 1.5_wp
   !> Part of the length that is added where a contact is cut off [-]
   real(wp), parameter :: wider = 0.1_wp
   !> Solutions at most, until the loaded part fits
   integer, parameter :: max_fits = 12
   !> Part of the mean at an end that replaces its loads, over how much that exceeds the load behind, until it does entirely [-]
   real(wp), parameter :: full_growth = 4.0_wp

   !> A part of the roller
   type :: window_t
      !> Where it begins and ends, from -1/2 to 1/2 [L]
      real(wp) :: bounds(2) = [-0.5_wp, 0.5_wp]
      !> Loads per length of its slices over the mean of the part [-]
      real(wp), allocatable :: loads(:)
   end type window_t

contains

   !> Solve the loads of a part, and take another one until the loaded part fits.
   pure subroutine fit_window(window, profile, length, modulus, load, radius, status)
      !> The part; in: where to begin
      type(window_t), intent(inout) :: window
      !> What the case says
      type(roller_profile_t), intent(in) :: profile
      !> Length of the roller, L [m]; equivalent modulus, E' [Pa]; load, W [N]; equivalent radius, R [m]
      real(wp), intent(in) :: length, modulus, load, radius
      !> 0 fine, positive where no loads were found
      integer, intent(out) :: status

      ! Where the part that would fit begins and ends [L], loads of its slices over their mean [-]; slices that are too many at its
      ! ends
      real(wp) :: bounds(2), loads(size(window%loads)), shifts(2)
      integer :: i

      do i = 1, max_fits
         call solve_window(window, profile, length, modulus, load, radius, status)
         if (status /= 0) return
         bounds = fitting_bounds(window)
         shifts = (window%bounds - bounds)*[-1.0_wp, 1.0_wp]*size(window%loads)/(window%bounds(2) - window%bounds(1))
         if (all(shifts >= -less .and. shifts <= more) .and. .not. any(cut_ends(window))) return
         if (i == max_fits) exit
         call spread_loads(window, bounds, loads)
         window%bounds = bounds
         window%loads = loads
      end do
      ! A part with more or fewer slices beside the load is right, too, but not one that cuts the contact off
      if (any(cut_ends(window))) status = 1
   end subroutine fit_window

   !> Solve the loads of a part, which gets wider where the contact would be cut off.
   pure subroutine load_window(window, profile, length, modulus, load, radius, status)
      !> The part; in: loads nearby
      type(window_t), intent(inout) :: window
      !> What the case says
      type(roller_profile_t), intent(in) :: profile
      !> Length of the roller, L [m]; equivalent modulus, E' [Pa]; load, W [N]; equivalent radius, R [m]
      real(wp), intent(in) :: length, modulus, load, radius
      !> 0 fine, positive where no loads were found
      integer, intent(out) :: status

      logical :: is_cut(2)
      integer :: i

      do i = 1, max_fits
         call solve_window(window, profile, length, modulus, load, radius, status)
         is_cut = cut_ends(window)
         if (status /= 0 .or. .not. any(is_cut)) return
         window%bounds = wider_bounds(window%bounds, is_cut)
      end do
      status = 1
   end subroutine load_window

   !> Solve the loads of a part.
   pure subroutine solve_window(window, profile, length, modulus, load, radius, status)
      !> The part; in: loads nearby
      type(window_t), intent(inout) :: window
      !> What the case says
      type(roller_profile_t), intent(in) :: profile
      !> Length of the roller, L [m]; equivalent modulus, E' [Pa]; load, W [N]; equivalent radius, R [m]
      real(wp), intent(in) :: length, modulus, load, radius
      !> 0 fine, positive where no loads were found
      integer, intent(out) :: status

      type(slices_t) :: slices
      real(wp) :: places(size(window%loads)), approach ! [m]
      integer :: i, n

      n = size(places)
      associate (part => window%bounds(2) - window%bounds(1))
         places = length*[(window%bounds(1) + part*(i - 0.5_wp)/n, i=1, n)]
         call new_slices(slices, length*part, modulus, profile_gap(profile, length, modulus, places), &
            & profile%coupling == coupling_names(coupling_half_space), length)
      end associate
      call load_slices(slices, load, radius, window%loads, approach, status)
      ! Without tilt both sides have the same loads, whose rounding is not to choose between them
      if (abs(profile%tilt) <= 0.0_wp) window%loads = 0.5_wp*(window%loads + window%loads(n:1:-1))
   end subroutine solve_window

   !> Slices of a part over which the loads at its ends mean nothing, since the contact is wider than they are long: the width of
   !> the mean load, at most half of the part; zero where the part does not end with the roller.
   pure function unclear_ends(window, length, modulus, load, radius) result(reach)
      !> The part
      type(window_t), intent(in) :: window
      !> Length of the roller, L [m]; equivalent modulus, E' [Pa]; load, W [N]; equivalent radius, R [m]
      real(wp), intent(in) :: length, modulus, load, radius
      !> How many at its beginning and end [slices]
      real(wp) :: reach(2)

      real(wp) :: part ! its length [m]

      part = length*(window%bounds(2) - window%bounds(1))
      reach = min(2.0_wp*half_width(load, radius, part, modulus)/part, 0.5_wp)*size(window%loads)
      where (abs(window%bounds) < 0.5_wp) reach = 0.0_wp
   end function unclear_ends

   !> Take the means of the loads at the ends of a part where slices are more than one and the load grows towards the end: at a
   !> sharp end of a roller it has no limit.
   pure subroutine blunt_ends(loads, reach)
      !> Loads over their mean [-]
      real(wp), intent(inout) :: loads(:)
      !> How far the means go at the beginning and at the end [slices]
      real(wp), intent(in) :: reach(2)

      if (reach(1) > 1.0_wp) call blunt_end(loads, reach(1))
      if (.not. reach(2) > 1.0_wp) return
      loads = loads(size(loads):1:-1)
      call blunt_end(loads, reach(2))
      loads = loads(size(loads):1:-1)
   end subroutine blunt_ends

   !> The same for the first loads.
   pure subroutine blunt_end(loads, reach)
      !> Loads over their mean [-]
      real(wp), intent(inout) :: loads(:)
      !> How far the mean goes [slices]
      real(wp), intent(in) :: reach

      ! Mean; part of the mean in the loads, which begins where the load does not fall towards the end [-]
      real(wp) :: mean, part
      integer :: whole

      whole = min(int(reach), size(loads) - 1)
      mean = load_up_to(loads, reach)/reach
      if (.not. mean > loads(whole + 1)) return
      part = min(full_growth*(1.0_wp - loads(whole + 1)/mean), 1.0_wp)
      loads(whole + 1) = loads(whole + 1) + part*(reach - whole)*(mean - loads(whole + 1))
      loads(:whole) = loads(:whole) + part*(mean - loads(:whole))
   end subroutine blunt_end

   !> Load up to a place.
   pure function load_up_to(loads, place) result(load)
      !> Loads of slices over their mean [-]
      real(wp), intent(in) :: loads(:)
      !> The place, from zero on [slices]
      real(wp), intent(in) :: place
      !> The load over the mean one of a slice [-]
      real(wp) :: load

      integer :: whole

      whole = min(max(int(place), 0), size(loads))
      load = sum(loads(:whole))
      if (whole < size(loads)) load = load + loads(whole + 1)*max(place - whole, 0.0_wp)
   end function load_up_to

   !> Does a contact go beyond a part, at its beginning or end, though not beyond the roller?
   pure function cut_ends(window) result(is_cut)
      !> The part
      type(window_t), intent(in) :: window
      logical :: is_cut(2)

      is_cut = window%loads([1, size(window%loads)]) > 0.0_wp .and. abs(window%bounds) < 0.5_wp
   end function cut_ends

   !> A part that begins or ends farther out.
   pure function wider_bounds(bounds, is_cut) result(others)
      !> Where it begins and ends [L]
      real(wp), intent(in) :: bounds(2)
      !> Does it begin, does it end farther out?
      logical, intent(in) :: is_cut(2)
      !> Where it is to [L]
      real(wp) :: others(2)

      others = bounds + merge([-wider, wider]*(bounds(2) - bounds(1)), [0.0_wp, 0.0_wp], is_cut)
      others = min(max(others, -0.5_wp), 0.5_wp)
   end function wider_bounds

   !> Where the part would begin and end that has its margin of slices without load.
   pure function fitting_bounds(window) result(bounds)
      !> The part
      type(window_t), intent(in) :: window
      !> The bounds [L]
      real(wp) :: bounds(2)

      ! Width of a slice [L]
      real(wp) :: width
      logical :: is_cut(2)

      is_cut = cut_ends(window)
      if (any(is_cut)) then
         bounds = wider_bounds(window%bounds, is_cut)
         return
      end if
      bounds = loaded_ends(window)
      width = (bounds(2) - bounds(1))/(size(window%loads) - 2.0_wp*margin)
      bounds = min(max(bounds + width*[-margin, margin], -0.5_wp), 0.5_wp)
   end function fitting_bounds

   !> Where the load begins and ends. Where it ends inside of the roller, it falls to zero along a straight line.
   pure function loaded_ends(window) result(ends)
      !> The part
      type(window_t), intent(in) :: window
      !> The places [L]
      real(wp) :: ends(2)

      integer :: first, last, n

      n = size(window%loads)
      first = findloc(window%loads > 0.0_wp, .true., 1)
      last = findloc(window%loads > 0.0_wp, .true., 1, back=.true.)
      associate (loads => window%loads, bounds => window%bounds)
         ends = bounds
         if (first > 1) ends(1) = bounds(1) + (bounds(2) - bounds(1))/n*(first - 0.5_wp - way_out(loads(first), &
            & loads(min(first + 1, n))))
         if (last < n) ends(2) = bounds(1) + (bounds(2) - bounds(1))/n*(last - 0.5_wp + way_out(loads(last), &
            & loads(max(last - 1, 1))))
      end associate
   end function loaded_ends

   !> Way from the middle of the last slice with a load to where the load ends.
   pure function way_out(outer, inner) result(way)
      !> Loads of that slice and of the one before [any]
      real(wp), intent(in) :: outer, inner
      !> The way, over the width of a slice [-]
      real(wp) :: way

      way = 1.0_wp
      if (inner > outer) way = min(way, outer/(inner - outer))
   end function way_out

   !> Loads of slices of another part: means over each, a slice of this part having the same load all along it.
   pure subroutine spread_loads(window, bounds, loads)
      !> This part
      type(window_t), intent(in) :: window
      !> Where the other one begins and ends [L]
      real(wp), intent(in) :: bounds(2)
      !> Loads per length over the mean of the other part, with all the load on it [-]
      real(wp), intent(out) :: loads(:)

      ! Load up to a place, before and behind a slice, over the mean of this part [slices]
      real(wp) :: before, behind
      integer :: i, n

      n = size(window%loads)
      if (all(abs(window%bounds - bounds) <= 0.0_wp) .and. n == size(loads)) then
         loads = window%loads
         return
      end if
      before = load_up_to(window%loads, place_of(0))
      do i = 1, size(loads)
         behind = load_up_to(window%loads, place_of(i))
         loads(i) = (behind - before)*size(loads)/n
         before = behind
      end do
   contains
      !> Where, among the slices of this part, the first `i` slices of the other one end [slices].
      pure real(wp) function place_of(i) result(place)
         integer, intent(in) :: i

         place = (bounds(1) + (bounds(2) - bounds(1))*i/size(loads) - window%bounds(1))/(window%bounds(2) - window%bounds(1))*n
      end function place_of
   end subroutine spread_loads

end module camroller_axial_window
