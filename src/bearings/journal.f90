!> Hydrodynamic journal bearings of the camshaft: friction under a steady load.
!>
!> In: bearing dimensions, viscosity, speed, load. Out: friction on the journal and eccentricity. Sources: Sommerfeld (1904) for
!> the long bearing with full film, Ocvirk (1952), NACA TN 2808, for the short bearing with half film, Butenschoen (1976),
!> thesis, University of Karlsruhe, for finite width; Islam (2019) eqs. (42)-(44), with the speed in revolutions and without the
!> factor 12.
!>
!> With e the ratio of eccentricity to radial clearance, each law is written as an increasing function of `t = e/sqrt(1 - e^2)`,
!> which is accurate from the unloaded bearing (t = 0, Petroff's friction) to e -> 1 (t unbounded).
module camroller_journal
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_deck, kind_domain
   use camroller_names, only : name_length, find_name
   implicit none
   private

   public :: cam_bearings_t, journal_t, journal_law_names, law_long, law_short, law_finite
   public :: new_journal, journal_at_speed, with_shear, law_covers_width, width_advice
   public :: journal_solved, journal_without_film, find_tangent, film_friction, film_t, film_at
   public :: journal_motion_names, motion_quasi_steady, motion_orbit, law_can_orbit, orbit_advice, moves_like_finite, &
      & is_short

   !> Journal bearing laws
   character(len=*), parameter :: journal_law_names(*) = [character(len=name_length) :: &
      "long_full_sommerfeld", "short_ocvirk", "finite"]
   !> Places in `journal_law_names`
   integer, parameter :: law_long = 1, law_short = 2, law_finite = 3

   !> How journals move: at each instant as under a steady load, or on their orbit
   character(len=*), parameter :: journal_motion_names(*) = [character(len=name_length) :: "quasi_steady", "orbit"]
   !> Places in `journal_motion_names`
   integer, parameter :: motion_quasi_steady = 1, motion_orbit = 2
   !> What to say where a law has no orbit
   character(len=*), parameter :: orbit_advice = "journal_motion = 'orbit' needs the law 'short_ocvirk' or 'finite': the "// &
      & "full film of 'long_full_sommerfeld' pulls the journal as hard as it pushes"

   !> Friction and eccentricity are known
   integer, parameter :: journal_solved = 0
   !> No viscosity, no speed or no finite load: no film to compute
   integer, parameter :: journal_without_film = 1

   !> Width over diameter for which the law of finite width is used [-]
   real(wp), parameter :: finite_range(2) = [0.1_wp, 1.0_wp]
   !> What to say where it is not
   character(len=*), parameter :: width_advice = "journal bearing law 'finite', the default, covers widths from 0.1 to 1 "// &
      & "diameter; 'short_ocvirk' is for narrower ones, 'long_full_sommerfeld' for camshaft bearings of twice that width "// &
      & "and more; between them none is near"

   !> Camshaft and its bearings
   type :: cam_bearings_t
      !> One of `journal_law_names`
      character(len=name_length) :: law = "finite"
      !> Diameter of the journals [m]
      real(wp) :: diameter = 0.0_wp
      !> Width of a bearing [m]
      real(wp) :: width = 0.0_wp
      !> Radial clearance [m]
      real(wp) :: radial_clearance = 0.0_wp
      !> Places of the bearings along the shaft, increasing [m]
      real(wp), allocatable :: bearing_positions(:)
      !> Places of the cams along the shaft, between the first and the last bearing [m]
      real(wp), allocatable :: cam_positions(:)
      !> Angle by which each cam's event follows the first cam's; this and the next lists have a value for each cam [rad]
      real(wp), allocatable :: cam_phases(:)
      !> Lobe shape of each cam: 1 is the case's lift, 2 its second lift, which must be there then
      integer, allocatable :: cam_lobes(:)
      !> Camshaft of each cam, from 1; not allocated where all are on one. Camshafts have the same bearings at the same places
      integer, allocatable :: cam_shafts(:)
      !> Angle about the shaft at which each follower stands from the first, positive the way a finger turns as it opens [rad]
      real(wp), allocatable :: follower_angles(:)
      !> One of `journal_motion_names`
      character(len=name_length) :: journal_motion = journal_motion_names(motion_quasi_steady)
      !> Does each bearing have series of its own?
      logical :: by_bearing = .false.
      !> Do they have friction? Where not, they are there for their cams alone
      logical :: has_friction = .true.
   end type cam_bearings_t

   !> A bearing at a speed, ready for any load
   type :: journal_t
      !> Place in `journal_law_names`
      integer :: law = law_long
      !> Radius of the journal [m]
      real(wp) :: radius = 0.0_wp
      !> Width over diameter [-]
      real(wp) :: width_ratio = 0.0_wp
      !> Radial clearance over radius [-]
      real(wp) :: clearance_ratio = 0.0_wp
      !> Load at which `W (c/r)^2/(eta omega r L)` is one [N]
      real(wp) :: unit_load = 0.0_wp
      !> Friction of the unloaded bearing, `2 pi eta omega r^2 L/c` [N]
      real(wp) :: petroff_friction = 0.0_wp
   end type journal_t

   !> Film of a bearing at an eccentricity, with slopes over ln t
   type :: film_t
      !> Load number `W (c/r)^2/(eta omega r L)`, and the slope of its logarithm [-]
      real(wp) :: number = 0.0_wp, number_slope = 0.0_wp
      !> Angle between its force and the line of centres, and the slope of that [rad]
      real(wp) :: angle = 0.0_wp, angle_slope = 0.0_wp
   end type film_t

contains

   !> Make the bearing of a camshaft at a speed.
   !>
   !> Errors: unknown law, or width out of the range of the law of finite width (deck); no viscosity or no speed (domain).
   subroutine new_journal(journal, bearings, viscosity, speed, error)
      !> The bearing
      type(journal_t), intent(out) :: journal
      !> What the case says about the bearings
      type(cam_bearings_t), intent(in) :: bearings
      !> Viscosity of the oil at ambient pressure [Pa s]
      real(wp), intent(in) :: viscosity
      !> Speed of the shaft [rad/s]
      real(wp), intent(in) :: speed
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      integer :: law, motion

      call find_name("journal bearing law", bearings%law, journal_law_names, law, error)
      if (.not. allocated(error)) call find_name("journal motion", bearings%journal_motion, journal_motion_names, motion, error)
      if (allocated(error)) return
      journal = journal_at_speed(law, bearings%diameter, bearings%width, bearings%radial_clearance, viscosity, speed)
      if (.not. journal%unit_load > 0.0_wp) then
         call raise(error, kind_domain, "journal bearings need viscosity, speed and dimensions above zero")
      else if (.not. law_covers_width(bearings%law, bearings%width, bearings%diameter)) then
         call raise(error, kind_deck, width_advice)
      else if (.not. law_can_orbit(bearings%law, bearings%journal_motion)) then
         call raise(error, kind_deck, orbit_advice)
      end if
   end subroutine new_journal

   !> Can journals of a law move as they are asked to?
   pure function law_can_orbit(law, motion) result(answer)
      !> One of `journal_law_names`, one of `journal_motion_names`
      character(len=*), intent(in) :: law, motion
      !> Can they?
      logical :: answer

      answer = motion /= journal_motion_names(motion_orbit) .or. law /= journal_law_names(law_long)
   end function law_can_orbit

   !> Is a bearing taken for a short one?
   pure function is_short(journal) result(answer)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Is it?
      logical :: answer

      answer = journal%law == law_short
   end function is_short

   !> Does a journal that moves feel the width of its bearing?
   pure function moves_like_finite(journal) result(answer)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Does it?
      logical :: answer

      answer = journal%law == law_finite
   end function moves_like_finite

   !> Is a bearing as wide as its law asks for?
   pure function law_covers_width(law, width, diameter) result(answer)
      !> One of `journal_law_names`
      character(len=*), intent(in) :: law
      !> Width and diameter [m]
      real(wp), intent(in) :: width, diameter
      !> Is it?
      logical :: answer

      answer = law /= journal_law_names(law_finite)
      if (.not. answer) answer = width/diameter >= finite_range(1) .and. width/diameter <= finite_range(2)
   end function law_covers_width

   !> Constants of a bearing at a speed.
   pure function journal_at_speed(law, diameter, width, radial_clearance, viscosity, speed) result(journal)
      !> Place in `journal_law_names`
      integer, intent(in) :: law
      !> Diameter of the journal [m]
      real(wp), intent(in) :: diameter
      !> Width of the bearing [m]
      real(wp), intent(in) :: width
      !> Radial clearance [m]
      real(wp), intent(in) :: radial_clearance
      !> Viscosity [Pa s]
      real(wp), intent(in) :: viscosity
      !> Speed of the shaft [rad/s]
      real(wp), intent(in) :: speed
      !> The constants; no unit load where there is no film
      type(journal_t) :: journal

      !> Shear force of the unloaded film over 2 pi [N]
      real(wp) :: shear

      journal%law = law
      journal%radius = 0.5_wp*diameter
      if (.not. min(diameter, width, radial_clearance, viscosity, abs(speed)) > 0.0_wp) return
      journal%width_ratio = width/diameter
      journal%clearance_ratio = radial_clearance/journal%radius
      shear = viscosity*abs(speed)*journal%radius*width/journal%clearance_ratio
      journal%unit_load = shear/journal%clearance_ratio
      journal%petroff_friction = 2.0_wp*pi*shear
   end function journal_at_speed

   !> A bearing where viscosity times speed is another.
   pure function with_shear(journal, ratio) result(other)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Viscosity times speed over those that it has [-]
      real(wp), intent(in) :: ratio
      !> With that
      type(journal_t) :: other

      other = journal
      other%unit_load = ratio*journal%unit_load
      other%petroff_friction = ratio*journal%petroff_friction
   end function with_shear

   !> Friction of the film on the journal: shear, and half of the moment of the load beside the centre, `1/2 W (c/r) e sin A` with
   !> the attitude angle A. The bearing has as much less, which the shaft does not feel.
   pure function film_friction(journal, load, t) result(friction)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Load that the film carries [N]
      real(wp), intent(in) :: load
      !> e/sqrt(1 - e^2) at that load [-]
      real(wp), intent(in) :: t
      !> Friction at the journal's surface, against the rotation [N]
      real(wp) :: friction

      !> sqrt(1 + t^2) [-], attitude angle and its slope [rad]
      real(wp) :: secant, angle, unused

      secant = sqrt(1.0_wp + t**2)
      friction = journal%petroff_friction*secant
      if (journal%law == law_long) then
         friction = friction*(2.0_wp + 6.0_wp*t**2)/(2.0_wp + 3.0_wp*t**2)
      else
         call find_attitude(journal, t, angle, unused)
         friction = friction + 0.5_wp*journal%clearance_ratio*abs(load)*(t/secant)*sin(angle)
      end if
   end function film_friction

   !> Film of a bearing at an eccentricity, with its slopes.
   pure function film_at(journal, t) result(film)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> e/sqrt(1 - e^2), positive [-]
      real(wp), intent(in) :: t
      !> The film
      type(film_t) :: film

      call load_number(journal, t, film%number, film%number_slope)
      call find_attitude(journal, t, film%angle, film%angle_slope)
   end function film_at

   !> Angle between load and line of centres, and its slope over ln t: a right angle in the long bearing with its full film, that of
   !> Ocvirk (1952) in the short one, Butenschoen's fit for finite width.
   pure subroutine find_attitude(journal, t, angle, slope)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(in) :: t
      !> Attitude angle and its slope [rad]
      real(wp), intent(out) :: angle, slope

      select case (journal%law)
      case (law_long)
         angle = 0.5_wp*pi
         slope = 0.0_wp
      case (law_short)
         angle = atan2(pi, 4.0_wp*t)
         slope = -4.0_wp*pi*t/(16.0_wp*t**2 + pi**2)
      case default
         call finite_angle(journal%width_ratio, t, angle, slope)
      end select
   end subroutine find_attitude

   !> e/sqrt(1 - e^2) under a load, by Newton's method on logarithms: there the load number rises with a slope between 1 and 4
   !> which changes little, so that two or three steps from a place near the root suffice.
   pure subroutine find_tangent(journal, load, t, status)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Load [N]
      real(wp), intent(in) :: load
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(out) :: t
      !> `journal_solved` or `journal_without_film`
      integer, intent(out) :: status

      !> Change of ln t whose square is round-off [-]
      real(wp), parameter :: last_change = sqrt(epsilon(1.0_wp))
      !> Steps at most
      integer, parameter :: most_steps = 50
      !> Load number, that at t and its slope, change of the logarithm of t [-]
      real(wp) :: number, value, slope, change
      integer :: step

      t = 0.0_wp
      status = journal_without_film
      if (.not. journal%unit_load > 0.0_wp) return
      number = abs(load)/journal%unit_load
      if (number > huge(number)) return
      status = journal_solved
      if (number <= tiny(1.0_wp)) return
      t = nearby_tangent(journal, number)
      do step = 1, most_steps
         call load_number(journal, t, value, slope)
         change = log(number/value)/slope
         t = t*exp(change)
         if (abs(change) <= last_change) return
      end do
      status = journal_without_film
   end subroutine find_tangent

   !> Load number `W (c/r)^2/(eta omega r L)` of a bearing, and its slope over t in logarithms; rises with t from 0.
   !>
   !> Long:   `12 pi e/((2 + e^2) sqrt(1 - e^2))`, from `S = (2 + e^2) sqrt(1 - e^2)/(12 pi^2 e)`, S = 1/(pi number).
   !> Short:  `(L/r)^2 e sqrt(16 e^2 + pi^2 (1 - e^2))/(4 (1 - e^2)^2)`.
   !> Finite: `(L/D)^2 e sqrt(16 e^2 + pi^2 (1 - e^2))/(1 - e^2)^2 a_1 (1 - e)/(-a_2 - e)`; at the loads of the numerical
   !>         solutions of Raimondi and Boyd (1958, L/D 1 and 1/4) e is within 0.01, the friction within 2 %.
   pure subroutine load_number(journal, t, number, slope)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> e/sqrt(1 - e^2), positive [-]
      real(wp), intent(in) :: t
      !> Load number [-]
      real(wp), intent(out) :: number
      !> Its slope, `d ln number/d ln t` [-]
      real(wp), intent(out) :: slope

      !> t^2, `16 t^2 + pi^2`, e, the pole [-]
      real(wp) :: square, under_root, e, pole

      square = t**2
      under_root = 16.0_wp*square + pi**2
      select case (journal%law)
      case (law_long)
         number = 12.0_wp*pi*t*(1.0_wp + square)/(2.0_wp + 3.0_wp*square)
         slope = 1.0_wp - 2.0_wp*square/((2.0_wp + 3.0_wp*square)*(1.0_wp + square))
      case (law_short)
         number = journal%width_ratio**2*(1.0_wp + square)*t*sqrt(under_root)
         slope = 1.0_wp + 2.0_wp*square/(1.0_wp + square) + 16.0_wp*square/under_root
      case default
         e = t/sqrt(1.0_wp + square)
         pole = finite_pole(journal%width_ratio)
         number = journal%width_ratio**2*t*sqrt(under_root)*finite_factor(journal%width_ratio)/((1.0_wp + e)*(pole - e))
         slope = 1.0_wp + 16.0_wp*square/under_root + e/(1.0_wp + square)*(1.0_wp/(pole - e) - 1.0_wp/(1.0_wp + e))
      end select
   end subroutine load_number

   !> t near that of a load number: from a bound above it, with the factors of the law that change little there put in again.
   pure function nearby_tangent(journal, number) result(t)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Load number, positive [-]
      real(wp), intent(in) :: number
      !> e/sqrt(1 - e^2) [-]
      real(wp) :: t

      !> Load number over the factors but `t sqrt(16 t^2 + pi^2)`, e, the pole [-]
      real(wp) :: reduced, e, pole
      integer :: i

      select case (journal%law)
      case (law_long)
         t = number/(4.0_wp*pi)
         do i = 1, 3
            t = number/(12.0_wp*pi)*(3.0_wp - 1.0_wp/(1.0_wp + t**2))
         end do
      case (law_short)
         reduced = number/journal%width_ratio**2
         t = min(reduced/pi, sqrt(sqrt(0.25_wp*reduced)))
      case default
         pole = finite_pole(journal%width_ratio)
         e = 0.5_wp*(pole - 1.0_wp)
         do i = 1, 3
            reduced = number*(1.0_wp + e)*(pole - e)/(journal%width_ratio**2*finite_factor(journal%width_ratio))
            t = reduced*sqrt(2.0_wp/(pi**2 + hypot(pi**2, 8.0_wp*reduced)))
            e = t/sqrt(1.0_wp + t**2)
         end do
      end select
   end function nearby_tangent

   !> Butenschoen's a_1: load over that of a short bearing.
   elemental function finite_factor(b) result(a_1)
      !> Width over diameter [-]
      real(wp), intent(in) :: b
      !> a_1 [-]
      real(wp) :: a_1

      a_1 = 1.1642_wp + b*(-1.9456_wp + b*(7.1161_wp + b*(-10.1073_wp + b*5.0141_wp)))
   end function finite_factor

   !> Butenschoen's -a_2: eccentricity, just above one, where the fit has its pole.
   elemental function finite_pole(b) result(pole)
      !> Width over diameter [-]
      real(wp), intent(in) :: b
      !> -a_2 [-]
      real(wp) :: pole

      pole = 1.000026_wp + b*(0.023634_wp + b*(0.4215_wp + b*(0.038817_wp + b*0.090551_wp)))
   end function finite_pole

   !> Butenschoen's fit of the attitude angle, with its slope over ln t.
   elemental subroutine finite_angle(b, t, angle, slope)
      !> Width over diameter [-]
      real(wp), intent(in) :: b
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(in) :: t
      !> Attitude angle and its slope [rad]
      real(wp), intent(out) :: angle, slope

      !> e, factor of the short bearing's form and its slope over e [-]; coefficients of its powers of e [-]
      real(wp) :: e, factor, growth, c(4)

      c = [-2.5905_wp + 0.798745_wp*b, 8.73393_wp - 2.3291_wp*b, -13.3414_wp + 3.424337_wp*b, 6.6294_wp - 1.591732_wp*b]
      e = t/sqrt(1.0_wp + t**2)
      factor = 1.152624_wp - 0.104565_wp*b + e*(c(1) + e*(c(2) + e*(c(3) + e*c(4))))
      growth = c(1) + e*(2.0_wp*c(2) + e*(3.0_wp*c(3) + e*4.0_wp*c(4)))
      angle = factor*atan2(pi, 2.0_wp*t)
      slope = growth*e/(1.0_wp + t**2)*atan2(pi, 2.0_wp*t) - factor*2.0_wp*pi*t/(4.0_wp*t**2 + pi**2)
   end subroutine finite_angle

end module camroller_journal
