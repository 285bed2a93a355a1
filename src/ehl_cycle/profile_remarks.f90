!> Remarks on the heat of profiles: places of the contact that are warmer than the formulas' mean, and than the oil is good for.
!>
!> In: profiles, their case. Out: remarks.
module camroller_profile_remarks
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_case, only : case_t
   use camroller_ehl_record, only : ehl_record_t
   use camroller_error, only : error_t
   use camroller_heat, only : heat_part_t, new_heat_part, set_heat_oil
   use camroller_kinds, only : wp
   use camroller_lubricant, only : get_oil, oil_t
   use camroller_oil_checks, only : describe_hot_film, find_far_points, hot_film_t, note_hot_film, rises_t
   use camroller_remarks, only : add_remark, far_temperature, hot_film, remark_t
   implicit none
   private

   public :: judge_hot_profiles

contains

   !> Remarks on the largest rise across the contact: oil that is not the lubricant's any more, and oil far from its points, where
   !> no other remark has it farther.
   subroutine judge_hot_profiles(record, case, remarks)
      !> The profiles
      type(ehl_record_t), intent(in) :: record
      !> Their case
      type(case_t), intent(in) :: case
      !> Get the remarks
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      type(heat_part_t) :: part
      type(oil_t) :: oil
      type(hot_film_t) :: hot
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: words
      real(wp) :: distance ! way beyond the points [K]
      integer :: i

      if (.not. allocated(record%film_rise)) return
      call get_oil(case%lubricant, case%operating_point%oil_temperature, oil, failure)
      if (.not. allocated(failure)) call new_heat_part(part, case%heat, failure)
      if (.not. allocated(failure)) call set_heat_oil(part, case%lubricant, case%operating_point%oil_temperature, oil, failure)
      if (allocated(failure)) return
      associate (angles => size(record%angle))
         do i = 1, angles
            if (ieee_is_nan(record%film_rise(1, i))) cycle
            call note_hot_film(hot, part, case%lubricant, oil, maxval(record%film_rise(:, i)), 0.0_wp, record%angle(i), &
               & 1.0_wp/angles)
         end do
      end associate
      if (hot%share > 0.0_wp) then
         call describe_hot_film(hot, part, case%lubricant, oil, "the film of the profiles", words)
         call add_remark(remarks, hot_film, words, hot%rise)
      end if
      call find_far_points(case, case%operating_point%oil_temperature, rises_t(film=hot%rise), distance, words)
      if (distance > max(0.0_wp, maxval(remarks%size, mask=remarks%kind == far_temperature))) call add_remark(remarks, &
         & far_temperature, "in the profiles "//words, distance)
   end subroutine judge_hot_profiles

end module camroller_profile_remarks
