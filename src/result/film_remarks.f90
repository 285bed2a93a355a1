!> Remarks on the film of cam and roller, whether by a law or solved, and on that of the roller's pin.
!>
!> In: fractions of a cycle, largest pressure, smallest film. Out: remarks, one per line.
module camroller_film_remarks
   use camroller_bearing_asperity, only : thinnest_smooth_film
   use camroller_bearing_remarks, only : smooth_law_fails
   use camroller_cam_angle, only : append_cam_angle, file_angle
   use camroller_cycle_shares, only : liquid_stress, shares_t, thinnest_ratio_allowed
   use camroller_kinds, only : wp
   use camroller_lubricant, only : pressure_limit
   use camroller_means, only : has_film_limit, statistics_t
   use camroller_model, only : model_t
   use camroller_number_text, only : append_number, fixed_text, integer_text, number_text
   use camroller_remarks, only : remark_t, add_remark, backward_roller, beyond_pressure_law, film_without_limit, liquid_limit, &
      & outer_asperities, rubbing_contact, rubbing_pin, yielding_surface
   use camroller_result, only : lobe_scope
   implicit none
   private

   public :: judge_films, judge_pin, judge_pressure, judge_traction, name_lobe, notable_share

   !> Pressure over hardness at which a line contact yields below its surface: 1.8 yield stresses, of which hardness is about three
   !> (Johnson 1985, sections 4.5 and 6.3) [-]; contact stress that the static load rating of roller bearings allows (ISO 76:2006)
   !> [Pa]
   real(wp), parameter :: yield_part = 0.6_wp, static_limit = 4.0e9_wp
   !> Part of a cycle from which on shear of the film, or oil beside the dry contact, is worth a word: moments beside a lost contact
   !> are less [-]
   real(wp), parameter :: notable_share = 0.01_wp
   !> The same of asperities beside the dry contact, whose load counts in the mean [-]
   real(wp), parameter :: notable_outer = 0.1_wp

contains

   !> Name the lobe shape in the remarks on it.
   subroutine name_lobe(remarks, first, lobe)
      !> Remarks
      type(remark_t), intent(inout) :: remarks(:)
      !> The first of those on the lobe shape, which are the last
      integer, intent(in) :: first
      !> The lobe shape; 0 where there is one alone, which has no name
      integer, intent(in) :: lobe

      integer :: i

      if (lobe == 0) return
      do i = first, size(remarks)
         remarks(i)%lobe = lobe
         remarks(i)%text = trim(lobe_scope(lobe))//": "//remarks(i)%text
      end do
   end subroutine name_lobe

   !> Say that films have no mean and no largest value: formulas let them grow without limit as the load goes to zero, and how far
   !> they get hangs on how closely a loss of contact is met. So do the parts of what friction there is.
   subroutine judge_films(statistics, has_asperities, remarks)
      !> Statistics of the lobe
      type(statistics_t), intent(in) :: statistics
      !> Do asperities have a part of the friction?
      logical, intent(in) :: has_asperities
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: of_share = "; smallest and largest asperity_friction_share may be those of next to no "// &
         & "friction there"

      if (has_film_limit(statistics)) return
      call add_remark(remarks, film_without_limit, "mean and largest value of film thicknesses and of film_ratio have "// &
         & "no limit: the load falls to next to nothing, where formulas let the film grow; at cam angle "// &
         & fixed_text(file_angle(statistics%thickest_angle), 1)//" deg it is "//number_text(statistics%thickest_film, 2)// &
         & " of the equivalent radius, and formulas hold for a small part of it"// &
         & of_share(:merge(len(of_share), 0, has_asperities)), statistics%thickest_film)
   end subroutine judge_films

   !> Say that the contact's pressure is above that to which the law of viscosity over pressure holds, or what its surfaces stand.
   subroutine judge_pressure(model, largest, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Its largest pressure, of the dry contact [Pa]
      real(wp), intent(in) :: largest
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      real(wp) :: limit ! [Pa]
      character(len=:), allocatable :: reached

      limit = pressure_limit(model%lubricant)
      reached = "the pressure goes up to "
      call append_number(reached, 1.0e-9_wp*largest, 3)
      reached = reached//" GPa; "
      if (largest > limit) call add_remark(remarks, beyond_pressure_law, reached//"the law '"// &
         & trim(model%lubricant%pressure_law)//"' of viscosity over pressure holds to about "//number_text(1.0e-9_wp*limit, 2)// &
         & " GPa, and traction and slip follow it (pressure_law = 'roelands' is used above that, too, "// &
         & "where it extrapolates from measurements)", largest/limit)
      limit = static_limit
      if (model%hardness > 0.0_wp) limit = yield_part*model%hardness
      if (largest > limit .and. model%hardness > 0.0_wp) then
         call add_remark(remarks, yielding_surface, reached//"from "//number_text(1.0e-9_wp*limit, 2)//" GPa on, "// &
            & number_text(yield_part, 1)//" of materials.hardness_GPa, the softer body yields below its surface, which is "// &
            & "elastic here", largest/limit)
      else if (largest > limit) then
         call add_remark(remarks, yielding_surface, reached//"even the hard steel of roller bearings stands "// &
            & number_text(1.0e-9_wp*limit, 2)//" GPa (ISO 76), and bodies are elastic here", largest/limit)
      end if
   end subroutine judge_pressure

   !> Say that the film on the roller's pin is too thin for its law.
   subroutine judge_pin(roughness, smallest, remarks)
      !> Roughness of roller and pin, smallest film of the cycle between them [m]
      real(wp), intent(in) :: roughness, smallest
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (smallest >= thinnest_smooth_film*roughness) return
      call add_remark(remarks, rubbing_pin, "the film between roller and pin goes down to "//number_text(smallest/roughness, 2)// &
         & " of their roughness; below about "//number_text(thinnest_smooth_film, 2)//" "//smooth_law_fails, &
         & roughness/max(smallest, tiny(smallest)))
   end subroutine judge_pin

   !> Say that the film is next to nothing beside the roughness, that asperities touch beside the dry contact, that the film's shear
   !> is limited where it is a liquid, and that the roller turns backwards.
   subroutine judge_traction(model, shares, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Fractions of its cycle
      class(shares_t), intent(in) :: shares
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      if (shares%thin_share > 0.0_wp) call check_thin_film(allocated(model%boundary), shares, remarks)
      if (shares%outer_share > notable_outer) call check_outer(shares, remarks)
      if (shares%liquid_share > notable_share) call check_liquid(model, shares, remarks)
      if (shares%backward_share > notable_share) call add_remark(remarks, backward_roller, "the roller turns backwards in "// &
         & "its finger for "//number_text(100.0_wp*shares%backward_share, 3)//" % of the cycle: rolling resistance is "// &
         & "larger there than the shear of the film, which tells of laws beyond what they describe", &
         & 100.0_wp*shares%backward_share)
   end subroutine judge_traction

   !> Say that the film is next to nothing beside the roughness.
   pure subroutine check_thin_film(has_asperities, shares, remarks)
      !> Does the case have asperities?
      logical, intent(in) :: has_asperities
      !> Fractions of the cycle
      class(shares_t), intent(in) :: shares
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: text

      text = "the film between cam and roller is below "
      call append_number(text, thinnest_ratio_allowed, 2)
      text = text//" of the roughness for "
      call append_number(text, 100.0_wp*shares%thin_share, 3)
      text = text//" % of the cycle, down to "
      call append_number(text, shares%thinnest_ratio, 2)
      text = text//" at "
      call append_cam_angle(text, shares%thinnest_angle, 1)
      text = text//"; laws for smooth surfaces leave the film load there that asperities would carry, and friction may be far "// &
         & "too small"
      if (.not. has_asperities) text = text//"; without &asperity none is counted"
      call add_remark(remarks, rubbing_contact, text, 100.0_wp*shares%thin_share)
   end subroutine check_thin_film

   !> Say that asperities touch beside the strip of the dry contact as well.
   pure subroutine check_outer(shares, remarks)
      !> Fractions of the cycle
      class(shares_t), intent(in) :: shares
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      integer :: percents(3) ! of the cycle, of the load with those beside the strip and without them

      percents = nint(100.0_wp*[shares%outer_share, [shares%inner_part + shares%outer_gain, shares%inner_part]/shares%outer_share])
      call add_remark(remarks, outer_asperities, "asperities are counted in the strip of the dry contact alone: for "// &
         & integer_text(percents(1))//" % of the cycle those beside it would carry load too, and all of them about "// &
         & integer_text(percents(2))//" % of it at the same film, in the place of "//integer_text(percents(3))// &
         & " %, by which boundary friction and wear go; 'camroller ehl' solves the contact with asperities at each place", &
         & shares%outer_gain)
   end subroutine check_outer

   !> Say that the traction of a film is limited whose pressure does not make its oil solid.
   subroutine check_liquid(model, shares, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Fractions of its cycle
      class(shares_t), intent(in) :: shares
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      call add_remark(remarks, liquid_limit, "traction.limit = 'mean' holds the shear of the film to "// &
         & number_text(model%limiting_coefficient, 3)//" of the load for "//number_text(100.0_wp*shares%liquid_share, 3)// &
         & " % of the cycle at mean stresses below "//number_text(1.0e-6_wp*liquid_stress, 2)//" MPa, down to "// &
         & number_text(1.0e-6_wp*shares%least_limit, 2)//" MPa, where oil is liquid and has no such limit, and the roller "// &
         & "slips too much; 'local' with a limiting_stress_MPa, of some MPa for most oils, has none there", &
         & 100.0_wp*shares%liquid_share)
   end subroutine check_liquid

end module camroller_film_remarks
