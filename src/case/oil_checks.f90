!> Checks of what is given about the oil: its viscosity at high temperature and high shear rate (HTHS), as on its data sheet, beside
!> the law of viscosity; its temperature, beside those at which something is known of it; the oil of a film that is hotter than the
!> oil around, beside the lubricant.
!>
!> In: what is given about the oil; rises of the temperature. Out: how much of its viscosity is left under shear; how far its
!> temperature is from all points, and from where its pressure-viscosity coefficient can be estimated; how hot a film is over a
!> cycle, and for how long hotter than its oil is good for.
!> One number for one temperature and shear rate makes no law of shear thinning, which takes the rate at which it begins and the
!> viscosity that it ends at, both over temperature (Marx, Fernandez, Barcelo and Spikes 2018, Tribology Letters 66, 92): no result
!> follows from it.
module camroller_oil_checks
   use camroller_cam_angle, only : append_cam_angle
   use camroller_boundary_law, only : boundary_law_names, boundary_table
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_heat, only : exponential_range, heat_part_t, hot_oil_range, largest_hot_oil_errors
   use camroller_kinds, only : wp, celsius_zero
   use camroller_lubricant, only : get_oil, law_barus, law_direct, lubricant_t, oil_t, pressure_law_names, sheet_temperatures, &
      & temperature_law_names
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: rises_t, compare_hths, find_far_points, find_far_table, judge_estimate
   public :: hot_film_t, note_hot_film, describe_hot_film

   !> Largest rises of the oil's temperature above that around; zero where there are none or they are not known
   type :: rises_t
      !> In a camshaft bearing, between cam and roller [K]
      real(wp) :: bearing = 0.0_wp, film = 0.0_wp
      !> Of the surfaces of cam and roller where asperities touch [K]
      real(wp) :: surface = 0.0_wp
   end type rises_t

   !> Film and surfaces over a cycle
   type :: hot_film_t
      !> Rise of the film's temperature that its oil is good for; negative: not asked for yet [K]
      real(wp) :: good_rise = -1.0_wp
      !> Fraction of the cycle with a larger one [-]
      real(wp) :: share = 0.0_wp
      !> Largest rise of the film's temperature [K], and its cam angle from full lift [rad]
      real(wp) :: rise = 0.0_wp, angle = 0.0_wp
      !> Largest rise of the surfaces' temperature where asperities touch [K]
      real(wp) :: surface_rise = 0.0_wp
   end type hot_film_t

   !> Temperature of HTHS [K]; its shear rate is 1e6 1/s: ASTM D4683
   real(wp), parameter :: hths_temperature = 423.15_wp

   !> Way beyond points up to which a law through them is taken for good: three points 35 K apart, as data sheets have them, pass
   !> four times their own errors on at 20 K beyond the last [K]
   real(wp), parameter :: far_from_points = 20.0_wp
   !> The same for a data sheet, with two points 60 K apart and Walther's straight line, which passes less than three times their
   !> errors on at 50 K beyond them [K]
   real(wp), parameter :: far_from_sheet = 50.0_wp

contains

   !> HTHS of the data sheet relative to what the law of viscosity gives at its temperature, without shear.
   subroutine compare_hths(lubricant, viscosity, ratio)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Viscosity by the law at 150 degC; zero where HTHS is not given or the law has none there [Pa s]
      real(wp), intent(out) :: viscosity
      !> HTHS over it; zero where it is [-]
      real(wp), intent(out) :: ratio

      type(lubricant_t) :: plain
      type(oil_t) :: oil
      type(error_t), allocatable :: failure

      viscosity = 0.0_wp
      ratio = 0.0_wp
      if (.not. lubricant%hths_viscosity > 0.0_wp .or. lubricant%temperature_law == temperature_law_names(law_direct)) return
      ! Pressure plays no part here, and its laws may have no constants at this temperature
      plain = lubricant
      plain%pressure_law = pressure_law_names(law_barus)
      plain%pressure_viscosity = 1.0e-8_wp
      plain%roelands_index = 0.0_wp
      if (allocated(plain%pressure_viscosity_points)) deallocate (plain%pressure_viscosity_points)
      call get_oil(plain, hths_temperature, oil, failure)
      if (allocated(failure)) return
      viscosity = oil%viscosity
      ratio = lubricant%hths_viscosity/viscosity
   end subroutine compare_hths

   !> How far temperatures of a case's oil are beyond those at which its laws are given, and which of them is the farthest off.
   subroutine find_far_points(case, temperature, rises, distance, words)
      !> The case
      type(case_t), intent(in) :: case
      !> Temperature of its oil [K]
      real(wp), intent(in) :: temperature
      !> Rises above the temperature of its oil
      type(rises_t), intent(in) :: rises
      !> Way beyond the points, 0 where none is far [K]
      real(wp), intent(out) :: distance
      !> The same in words; blank where none is far
      character(len=:), allocatable, intent(out) :: words

      character(len=*), parameter :: around = "the oil temperature", bearing = "the oil temperature in a camshaft bearing", &
         & film = "the oil temperature between cam and roller", passing = " is that of a law that passes through its points", &
         & straight = " is that of a straight line through its points"

      distance = 0.0_wp
      words = ""
      associate (lubricant => case%lubricant)
         if (lubricant%temperature_law == "data_sheet") then
            call look_at_viscosity(sheet_temperatures, far_from_sheet)
         else if (lubricant%temperature_law /= temperature_law_names(law_direct) .and. allocated(lubricant%temperature_points)) then
            call look_at_viscosity(lubricant%temperature_points, far_from_points)
         end if
         if (allocated(lubricant%pressure_viscosity_temperatures)) then
            call look_at(lubricant%pressure_viscosity_temperatures, far_from_points, temperature, around, &
               & "the pressure-viscosity coefficient"//straight, distance, words)
            call look_at(lubricant%pressure_viscosity_temperatures, far_from_points, temperature + rises%film, film, &
               & "the pressure-viscosity coefficient there"//straight, distance, words)
         end if
      end associate

   contains

      !> Compare temperatures with those at which viscosity is given.
      subroutine look_at_viscosity(points, far)
         !> Temperatures of the points, increasing; way beyond them that is far [K]
         real(wp), intent(in) :: points(:), far

         type(oil_t) :: oil
         type(error_t), allocatable :: failure
         character(len=:), allocatable :: viscosity

         ! What the law makes of it is asked for where it will be told
         if (way_beyond(points, temperature) > far) then
            viscosity = "the viscosity"
            call get_oil(case%lubricant, temperature, oil, failure)
            if (.not. allocated(failure)) viscosity = viscosity//", "//number_text(1.0e3_wp*oil%viscosity, 3)//" mPa s,"
            call look_at(points, far, temperature, around, viscosity//passing, distance, words)
         end if
         call look_at(points, far, temperature + rises%bearing, bearing, "the viscosity there"//passing, distance, words)
         call look_at(points, far, temperature + rises%film, film, "the viscosity there"//passing, distance, words)
      end subroutine look_at_viscosity

   end subroutine find_far_points

   !> How far the temperature of a case's oil, or of its surfaces, is beyond the table of the boundary coefficient.
   subroutine find_far_table(case, temperature, rise, distance, words)
      !> The case
      type(case_t), intent(in) :: case
      !> Temperature of its oil [K]
      real(wp), intent(in) :: temperature
      !> Largest rise of the surfaces' temperature above that of the oil where asperities touch; zero where it is not known [K]
      real(wp), intent(in) :: rise
      !> Way beyond the table, 0 where it is not far [K]
      real(wp), intent(out) :: distance
      !> The same in words; blank where it is not far
      character(len=:), allocatable, intent(out) :: words

      character(len=*), parameter :: nearest = "the coefficient of touching asperities is that of the nearest temperature in "// &
         & "the table of &boundary_law"

      distance = 0.0_wp
      words = ""
      if (.not. allocated(case%boundary_law)) return
      associate (law => case%boundary_law)
         if (law%law /= boundary_law_names(boundary_table) .or. .not. allocated(law%temperature_points)) return
         call look_at(law%temperature_points, far_from_points, temperature, "the oil temperature", nearest, distance, words)
         call look_at(law%temperature_points, far_from_points, temperature + rise, "the temperature of cam and roller where "// &
            & "they touch", nearest, distance, words)
      end associate
   end subroutine find_far_table

   !> How far a temperature is beyond those of points.
   pure function way_beyond(points, temperature) result(beyond)
      !> Temperatures of the points, increasing; the temperature [K]
      real(wp), intent(in) :: points(:), temperature
      !> Way beyond the points; below zero between them, and where there are none [K]
      real(wp) :: beyond

      beyond = -huge(1.0_wp)
      if (size(points) > 0) beyond = max(points(1) - temperature, temperature - points(size(points)))
   end function way_beyond

   !> Compare a temperature with those of points, and keep it where it is the farthest off so far.
   subroutine look_at(points, far, temperature, name, meaning, distance, words)
      !> Temperatures of the points, increasing; way beyond them that is far; the temperature [K]
      real(wp), intent(in) :: points(:), far, temperature
      !> Name of the temperature, and what is taken from the points
      character(len=*), intent(in) :: name, meaning
      !> Way beyond the points so far [K]
      real(wp), intent(inout) :: distance
      !> The same in words
      character(len=:), allocatable, intent(inout) :: words

      real(wp) :: beyond ! way beyond the points [K]

      beyond = way_beyond(points, temperature)
      if (beyond <= max(far, distance)) return
      distance = beyond
      words = name//", "//number_text(temperature - celsius_zero, 5)//" degC, is "//number_text(beyond, 4)// &
         & " K "//trim(merge("below", "above", temperature < points(1)))//" all points that are given, "// &
         & number_text(points(1) - celsius_zero, 5)//" to "//number_text(points(size(points)) - celsius_zero, 5)//" degC: "// &
         & meaning//", and may be far off"
   end subroutine look_at

   !> Say that a pressure-viscosity coefficient is estimated where the formula has no sense left: that of an oil falls as its
   !> temperature rises, and the formula's has a largest value somewhere in the cold, below which it falls as the oil gets colder.
   subroutine judge_estimate(case, temperature, distance, words)
      !> The case
      type(case_t), intent(in) :: case
      !> Temperature of its oil [K]
      real(wp), intent(in) :: temperature
      !> How far the oil is colder than where the estimate is largest, 0 where it is not colder [K]
      real(wp), intent(out) :: distance
      !> The same in words; blank where it is not
      character(len=:), allocatable, intent(out) :: words

      ! Temperatures that are compared are so far apart, and at most so many [K]
      real(wp), parameter :: step = 1.0_wp
      integer, parameter :: most = 100
      real(wp) :: last ! coefficient one step before [1/Pa]
      type(oil_t) :: oil, warmer
      type(error_t), allocatable :: failure
      integer :: i

      distance = 0.0_wp
      words = ""
      call get_oil(case%lubricant, temperature, oil, failure)
      if (allocated(failure)) return
      if (.not. oil%is_estimated) return
      warmer = oil
      do i = 1, most
         last = warmer%pressure_viscosity
         call get_oil(case%lubricant, temperature + i*step, warmer, failure)
         if (allocated(failure)) exit
         if (.not. warmer%pressure_viscosity > last) exit
         distance = i*step
      end do
      if (distance <= 0.0_wp) return
      words = "the pressure-viscosity coefficient, "//number_text(1.0e9_wp*oil%pressure_viscosity, 3)//" 1/GPa at "// &
         & number_text(temperature - celsius_zero, 5)//" degC, is estimated by the formula of So and Klaus, which makes it "// &
         & "fall with the cold below "//number_text(temperature + distance - celsius_zero, 3)//" degC, where that of oils "// &
         & "rises; give lubricant.pressure_viscosity_points_per_GPa"
   end subroutine judge_estimate

   !> Add a state.
   subroutine note_hot_film(hot, part, lubricant, oil, rise, surface_rise, angle, weight)
      !> The cycle so far
      type(hot_film_t), intent(inout) :: hot
      !> Heat of the contact
      type(heat_part_t), intent(in) :: part
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> Rises of the temperatures of film and surfaces, the latter zero where nothing touches [K]; cam angle from full lift [rad]
      real(wp), intent(in) :: rise, surface_rise, angle
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      hot%surface_rise = max(hot%surface_rise, surface_rise)
      if (rise <= 0.0_wp) return
      if (hot%good_rise < 0.0_wp) hot%good_rise = hot_oil_range(part, lubricant, oil)
      if (rise > hot%good_rise) hot%share = hot%share + weight
      if (rise <= hot%rise) return
      hot%rise = rise
      hot%angle = angle
   end subroutine note_hot_film

   !> Say how hot a film is whose oil is not the lubricant any more, and what it is instead.
   subroutine describe_hot_film(hot, part, lubricant, oil, film, words)
      !> The cycle, with a part in which the film is hotter than its oil is good for
      type(hot_film_t), intent(in) :: hot
      !> Heat of the contact
      type(heat_part_t), intent(in) :: part
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> What the film is called
      character(len=*), intent(in) :: film
      !> In words, on one line
      character(len=:), allocatable, intent(out) :: words

      ! Largest relative errors of the viscosity and of the pressure-viscosity coefficient; one that is none [-]
      real(wp) :: errors(2)
      real(wp), parameter :: no_error = 1.0e-3_wp
      character(len=*), parameter :: side(2) = ["below", "above"]
      logical :: has_law, is_exponential, is_said(2)

      is_exponential = lubricant%temperature_law == temperature_law_names(law_direct) .and. hot%rise > exponential_range
      words = film//" is up to "//number_text(hot%rise, 3)//" K warmer than the oil, at "
      call append_cam_angle(words, hot%angle, 1)
      call largest_hot_oil_errors(part, lubricant, oil, hot%rise, errors, has_law)
      is_said = abs(errors) > no_error
      if (.not. has_law) then
         words = words//", where the lubricant's own laws have no value"
      else if (any(is_said)) then
         words = words//"; up to there "
         if (is_said(1)) words = words//"its viscosity without pressure is as much as "//number_text(100.0_wp*abs(errors(1)), 2) &
            & //" % "//side(merge(1, 2, errors(1) < 0.0_wp))
         if (all(is_said)) words = words//" and "
         if (is_said(2)) words = words//"its pressure-viscosity coefficient is as much as "// &
            & number_text(100.0_wp*abs(errors(2)), 2)//" % "//side(merge(1, 2, errors(2) < 0.0_wp))
         words = words//" what the lubricant has"
      end if
      if (is_exponential) words = words//"; its viscosity falls exponentially, by heat.viscosity_fall_per_K, that of oils ever "// &
         & "less: engine oils of 25 to 95 degC are 1.1 to 1.5 times as thick at 30 K and 1.3 to 4 times at 60 K"
      if (is_exponential .and. hot%good_rise >= exponential_range) then
         words = words//"; it will do"
      else
         words = words//"; the oil of a hot film is within 1 %"
      end if
      words = words//" up to "//number_text(hot%good_rise, 2)//" K, and the film is hotter for "// &
         & number_text(100.0_wp*hot%share, 3)//" % of the cycle"
   end subroutine describe_hot_film

end module camroller_oil_checks
