!> Remarks on what hours of running leave: an accuracy that was not reached, places that are too few, a film that grows on surfaces
!> which do not touch, wear that would change the cam.
!>
!> In: the case, its result with what became of the surfaces. Out: remarks.
module camroller_running_in_remarks
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_catalogue, only : lobe_prefix
   use camroller_error, only : error_t
   use camroller_number_text, only : integer_text, number_text
   use camroller_remarks, only : deep_wear, few_places, missed_hours, untouched_film
   use camroller_result, only : find_quantity, result_t
   use camroller_run_remarks, only : add_named, lobe_count, take_scalar
   use camroller_tribofilm, only : running_in_t
   implicit none
   private

   public :: judge_running_in

   !> Wear over the largest lift of the valve that is none of a surface any more: a hundredth is about the 0.09 mm that
   !> oils for gasoline engines may let a cam lose in the Sequence IVA test (ASTM D6891, ILSAC GF-5) [-]
   real(wp), parameter :: deep_part = 0.01_wp
   !> Smallest film over composite roughness from which on asperities do not touch: the usual limit of full films (Hamrock and
   !> others 2004, Fundamentals of fluid film lubrication, section 3.5) [-]
   real(wp), parameter :: parted_ratio = 3.0_wp
   !> Part of the largest film or depth that may be missed between places, as estimated: a figure of the depth still shows its shape
   !> then [-]
   real(wp), parameter :: largest_miss = 0.1_wp

contains

   !> All remarks on hours of running.
   subroutine judge_running_in(case, result, error)
      !> The case, with hours of running
      type(case_t), intent(in) :: case
      !> The result; gets the remarks
      type(result_t), intent(inout) :: result
      !> Internal error where the result lacks what it should have
      type(error_t), allocatable, intent(out) :: error

      call judge_hours(case%running_in, result, error)
      if (.not. allocated(error)) call judge_places(case%running_in%places, result, error)
      if (allocated(case%wear) .and. .not. allocated(error)) call judge_wear(result, error)
      if (allocated(case%tribofilm) .and. .not. allocated(error)) call judge_growth(result)
   end subroutine judge_running_in

   !> Say that a tribofilm grows on surfaces that touch nowhere.
   subroutine judge_growth(result)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result

      integer :: lobe, place

      do lobe = 1, lobe_count(result)
         place = find_quantity(result%summary, "min_"//trim(lobe_prefix(lobe))//"film_ratio")
         if (place == 0) exit
         associate (ratio => result%summary_values(place))
            if (ratio < parted_ratio) cycle
            call add_named(result, lobe, untouched_film, "the film is all round at least "//number_text(ratio, 3)// &
               & " times as thick as the surfaces are rough, so that no asperities touch: the tribofilm grows by the shear of "// &
               & "the oil alone, and its removal_rate_per_s counts all the same", ratio)
         end associate
      end do
   end subroutine judge_growth

   !> Say that the error of the hours is larger than it may be: steps over the hours keep to the accuracy, the error of the slip and
   !> depths that end smaller than was foreseen come on top.
   subroutine judge_hours(running, result, error)
      !> What was asked for
      type(running_in_t), intent(in) :: running
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: estimate ! [-]
      integer :: lobe

      do lobe = 1, lobe_count(result)
         call take_scalar(result, trim(lobe_prefix(lobe))//"estimated_error_of_running_in", estimate, error)
         if (allocated(error)) return
         if (estimate <= running%accuracy) cycle
         call add_named(result, lobe, missed_hours, "the hours of running did not reach running_in.accuracy = "// &
            & number_text(running%accuracy, 3)//": the estimated error of films or depths is "//number_text(estimate, 3)// &
            & " of the largest; what the error of the slip has in it falls with numerics.accuracy, or tolerance where that is "// &
            & "given", estimate)
      end do
   end subroutine judge_hours

   !> Say that depth or film between the places of the cam is not known.
   subroutine judge_places(places, result, error)
      !> Number of places
      integer, intent(in) :: places
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: missed ! [-]
      integer :: lobe

      do lobe = 1, lobe_count(result)
         call take_scalar(result, trim(lobe_prefix(lobe))//"estimated_error_between_places", missed, error)
         if (allocated(error)) return
         if (missed <= largest_miss) cycle
         call add_named(result, lobe, few_places, "between the "//integer_text(places)//" places of the cam, "// &
            & "films or depths that the hours of running leave may be off by up to "// &
            & number_text(1.0e2_wp*missed, 2)//" % of the largest: they change abruptly from place to place, as where a "// &
            & "flexible train vibrates; take more running_in.places", missed)
      end do
   end subroutine judge_places

   !> Say that so much has worn away that cam or roller would have another shape, which the model keeps.
   subroutine judge_wear(result, error)
      !> The result, with what hours of running have worn away; gets the remark
      type(result_t), intent(inout) :: result
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      ! Lift of the valve, depths worn away from cam and roller [m]
      real(wp) :: values(3)
      character(len=:), allocatable :: prefix
      integer :: lobe

      do lobe = 1, lobe_count(result)
         prefix = trim(lobe_prefix(lobe))
         if (find_quantity(result%summary, "max_"//prefix//"cam_wear_depth") == 0) exit
         call take_scalar(result, "max_"//prefix//"valve_lift", values(1), error)
         call take_scalar(result, "max_"//prefix//"cam_wear_depth", values(2), error)
         call take_scalar(result, prefix//"roller_wear_depth", values(3), error)
         if (allocated(error)) return
         if (maxval(values(2:)) <= deep_part*values(1)) cycle
         call add_named(result, lobe, deep_wear, "the hours of running wear up to "//number_text(1.0e3_wp*values(2), 3)// &
            & " mm away from the cam and "//number_text(1.0e3_wp*values(3), 3)//" mm from the roller, which lift the valve by "// &
            & number_text(1.0e3_wp*values(1), 3)//" mm; lift and radii are those of new parts here, and loads are not those of "// &
            & "worn ones; are wear rates, in mm^3/(N m), and hours right?", maxval(values(2:))/values(1))
      end do
   end subroutine judge_wear

end module camroller_running_in_remarks
