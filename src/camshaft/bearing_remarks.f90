!> Remarks on the bearings of a camshaft: widths that their law is not for, films too thin for it, orbits beyond its fit; on the
!> width of a roller's bearing on its pin.
!>
!> In: a solved case, the smallest film of each bearing at the angles of the means; or the bearings at the end of a host's step.
!> Out: remarks, one line of each kind.
module camroller_bearing_remarks
   use camroller_kinds, only : wp, two_pi
   use camroller_bearing_asperity, only : bearing_state_t, thinnest_smooth_film
   use camroller_error, only : error_t
   use camroller_sampled_extremes, only : samples_t
   use camroller_journal, only : moves_like_finite
   use camroller_journal_motion, only : largest_fitted
   use camroller_journal_range, only : compare_width
   use camroller_needle, only : kind_journal, roller_bearing_names
   use camroller_number_text, only : append_number, counted, integer_text, number_text
   use camroller_remarks, only : remark_t, add_remark, bearing_width, orbit_out_of_range, rubbing_bearing
   use camroller_shaft, only : bearing_number, has_orbits, shaft_t, shaft_torques, solved_t
   use camroller_torque_list, only : torque_count
   implicit none
   private

   public :: judge_bearings, judge_step_bearings, name_bearing, smooth_law_fails

   !> What a film means that is thin beside the roughness, where no law of asperities takes the load from it
   character(len=*), parameter :: smooth_law_fails = "the law for smooth surfaces leaves the film load that asperities would "// &
      & "carry, and the friction stated is too small"
   !> Film below which usual surfaces touch: the roughness of a ground journal, 0.2 um, and of a bored bearing, 0.4 um, together [m]
   real(wp), parameter :: usual_roughness = 0.5e-6_wp
   !> Films are looked at closely from so far above a limit on: the angles of the means lie up to three degrees apart, or ten where
   !> all valves rest and loads hardly change [-]
   real(wp), parameter :: near = 1.25_wp
   !> Angles of the close look in a turn; those are taken that lie beside an angle of the means where a film is near a limit
   integer, parameter :: angles = 240

   !> Films of all bearings below a limit
   type :: thin_films_t
      !> The limit, zero where there is none, and the smallest film [m]
      real(wp) :: limit = 0.0_wp, smallest = huge(1.0_wp)
      !> Part of the turn for which the bearing with the smallest film is below the limit; zero where there is one angle alone [-]
      real(wp) :: share = 0.0_wp
      !> That bearing, in words, and how many others are below as well
      character(len=:), allocatable :: bearing
      integer :: others = 0
   end type thin_films_t

contains

   !> Remarks on all bearings of a case.
   subroutine judge_bearings(solved, samples, remarks, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Smallest film of each bearing of each camshaft at the angles of the means, in order round a turn; empty without bearings
      !> [m]
      type(samples_t), intent(in) :: samples
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      ! For smooth surfaces, for the fit of orbits
      type(thin_films_t) :: films(2)

      call judge_widths(solved, remarks)
      if (.not. allocated(solved%shaft%bearings)) return
      associate (bearings => solved%shaft%bearings, shaft => solved%shaft)
         films(1)%limit = smooth_limit(shaft)
         if (has_orbits(solved%case) .and. moves_like_finite(shaft%journal)) films(2)%limit = (1.0_wp - largest_fitted) &
            & *bearings%radial_clearance
         if (.not. any(samples%values(:, :samples%count) < near*maxval(films%limit))) return
         call look_closely(solved, samples, films, error)
         if (allocated(error)) return
         if (films(1)%smallest < films(1)%limit) call add_rubbing(films(1), allocated(shaft%touch), remarks)
         if (films(2)%smallest < films(2)%limit) call add_remark(remarks, orbit_out_of_range, "the orbit of the journal in "// &
            & films(2)%bearing//" goes to an eccentricity of "//number_text(1.0_wp - films(2)%smallest/bearings%radial_clearance, &
            & 4)//", beyond "//number_text(largest_fitted, 2)//" for "//number_text(100.0_wp*films(2)%share, 2)// &
            & " % of the turn; its velocities are a fit of numerical solutions up to there"//others_in_words(films(2)), &
            & films(2)%limit/films(2)%smallest)
      end associate
   end subroutine judge_bearings

   !> Remark on the thinnest film of all bearings at the end of a step.
   subroutine judge_step_bearings(shaft, bearings, remarks)
      !> The camshafts
      type(shaft_t), intent(in) :: shaft
      !> Their bearings at the end of the step, shape (bearing, camshaft)
      type(bearing_state_t), intent(in) :: bearings(:, :)
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      type(thin_films_t) :: films
      real(wp) :: each(size(bearings, 1), size(bearings, 2)) ! [m]
      integer :: place(2)

      each = bearings%film
      films%limit = smooth_limit(shaft)
      films%smallest = minval(each)
      if (films%smallest >= films%limit) return
      place = minloc(each)
      films%others = count(each < films%limit) - 1
      call name_bearing(place(1), place(2), size(bearings, 2), films%bearing)
      call add_rubbing(films, allocated(shaft%touch), remarks)
   end subroutine judge_step_bearings

   !> Film below which the law of the bearings leaves out what asperities carry.
   pure function smooth_limit(shaft) result(limit)
      !> The camshafts
      type(shaft_t), intent(in) :: shaft
      !> The limit [m]
      real(wp) :: limit

      limit = usual_roughness
      if (allocated(shaft%touch)) limit = thinnest_smooth_film*shaft%touch%roughness
   end function smooth_limit

   !> Say which bearings of a case, those of its camshaft or the pin of its roller, have a width that their law is not for.
   subroutine judge_widths(solved, remarks)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (allocated(solved%shaft%bearings)) then
         associate (bearings => solved%shaft%bearings)
            call judge("cam_bearings.law", bearings%law, bearings%width, bearings%diameter, "these have")
         end associate
      end if
      if (.not. allocated(solved%case%needle_bearing)) return
      associate (bearing => solved%case%needle_bearing)
         if (bearing%kind == roller_bearing_names(kind_journal)) call judge("needle_bearing.pin_law", bearing%film%law, &
            & bearing%film%width, 2.0_wp*solved%models(1)%bearing%radius, "the pin has")
      end associate

   contains

      !> The remark on one kind of bearing.
      subroutine judge(key, law, width, diameter, holder)
         !> Key of its law, the law
         character(len=*), intent(in) :: key, law
         !> Width, diameter [m]
         real(wp), intent(in) :: width, diameter
         !> What has the width, as a subject with its verb
         character(len=*), intent(in) :: holder

         character(len=:), allocatable :: words
         real(wp) :: excess ! by which factor [-]

         call compare_width(law, width, diameter, excess, words)
         if (.not. excess > 0.0_wp) return
         words = key//" '"//trim(law)//"' "//words//"; "//holder//" "
         call append_number(words, width/diameter, 3)
         call add_remark(remarks, bearing_width, words, excess)
      end subroutine judge

   end subroutine judge_widths

   !> Say that a film is too thin for smooth surfaces.
   subroutine add_rubbing(films, has_asperities, remarks)
      type(thin_films_t), intent(in) :: films
      !> Do asperities share the load?
      logical, intent(in) :: has_asperities
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: unit, consequence, share
      ! What films are stated in [m]
      real(wp) :: scale

      if (has_asperities) then
         scale = films%limit/thinnest_smooth_film
         unit = " of the roughness"
         consequence = "; there "//smooth_law_fails
      else
         scale = 1.0e-6_wp
         unit = " um"
         consequence = "; usual surfaces touch there, which &bearing_asperity would count"
      end if
      share = ""
      if (films%share > 0.0_wp) share = " for "//number_text(100.0_wp*films%share, 2)//" % of the turn"
      call add_remark(remarks, rubbing_bearing, "the film of "//films%bearing//" goes down to "// &
         & number_text(films%smallest/scale, 2)//unit//", below "//number_text(films%limit/scale, 2)//share//consequence// &
         & others_in_words(films), films%limit/films%smallest)
   end subroutine add_rubbing

   !> Which films are below limits, and for how long.
   subroutine look_closely(solved, samples, films, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Smallest film of each bearing of each camshaft at the angles of the means, in order round a turn [m]
      type(samples_t), intent(in) :: samples
      !> In: with limits; out: with what is below them
      type(thin_films_t), intent(inout) :: films(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      ! Films of all bearings at an angle, the smallest of each [m]
      real(wp), dimension(bearing_number(solved%shaft), solved%shaft%count) :: here, smallest
      ! Angles below each limit
      integer :: below(size(here, 1), size(here, 2), size(films))
      ! Angles of the means from the first on, that one again last [rad]; is a film near a limit there?
      real(wp) :: places(samples%count + 1)
      logical :: is_near(samples%count + 1)
      integer :: first, gap, i, k, worst(2)

      places = [modulo(samples%angle(:samples%count) - samples%angle(1), two_pi), two_pi]
      is_near(:samples%count) = any(samples%values(:, :samples%count) < near*maxval(films%limit), 1)
      is_near(samples%count + 1) = is_near(1)
      smallest = huge(1.0_wp)
      below = 0
      gap = 1
      first = ceiling(angles*samples%angle(1)/two_pi)
      do i = first, first + angles - 1
         do while (gap < samples%count .and. two_pi*i/angles - samples%angle(1) > places(gap + 1))
            gap = gap + 1
         end do
         if (.not. any(is_near(gap:gap + 1))) cycle
         call take_films(solved, i, here, error)
         if (allocated(error)) return
         smallest = min(smallest, here)
         do k = 1, size(films)
            where (here < films(k)%limit) below(:, :, k) = below(:, :, k) + 1
         end do
      end do
      worst = minloc(smallest)
      films%smallest = smallest(worst(1), worst(2))
      do k = 1, size(films)
         films(k)%share = real(below(worst(1), worst(2), k), wp)/angles
         films(k)%others = count(below(:, :, k) > 0) - 1
         call name_bearing(worst(1), worst(2), solved%shaft%count, films(k)%bearing)
      end do
   end subroutine look_closely

   !> Name a bearing of a camshaft.
   pure subroutine name_bearing(bearing, camshaft, camshafts, name)
      !> Number of the bearing, of its camshaft, and how many camshafts there are
      integer, intent(in) :: bearing, camshaft, camshafts
      !> In words
      character(len=:), allocatable, intent(out) :: name

      name = "camshaft bearing "//integer_text(bearing)
      if (camshafts > 1) name = "bearing "//integer_text(bearing)//" of camshaft "//integer_text(camshaft)
   end subroutine name_bearing

   !> Smallest films of all bearings at one of the angles.
   subroutine take_films(solved, number, films, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Number of the angle
      integer, intent(in) :: number
      !> The films, shape (bearing, camshaft) [m]
      real(wp), intent(out) :: films(:, :)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(bearing_state_t), allocatable :: states(:, :)
      real(wp) :: torques(torque_count, size(films, 2)) ! [N m]

      allocate (states(size(films, 1), size(films, 2)))
      call shaft_torques(solved, two_pi*number/angles, torques, error, bearings=states)
      if (.not. allocated(error)) films = states%film
   end subroutine take_films

   !> Length of the words on others.
   pure function others_length(films) result(length)
      type(thin_films_t), intent(in) :: films
      !> The length
      integer :: length

      length = 0
      if (films%others > 0) length = 2 + len(counted(films%others, "other bearing")) + len(" too")
   end function others_length

   !> Words on other bearings that are below a limit as well.
   pure function others_in_words(films) result(words)
      type(thin_films_t), intent(in) :: films
      !> The words, to follow others
      character(len=others_length(films)) :: words

      words = ""
      if (films%others > 0) words = "; "//counted(films%others, "other bearing")//" too"
   end function others_in_words

end module camroller_bearing_remarks
