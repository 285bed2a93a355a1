!> Load along the roller for a case: the table of slices over the radii of its cam.
!>
!> In: roller profile, linkage, lift. Out: the table; one that is there stays where it would be made of the same numbers again;
!> the length that carries the standing train's load at full lift.
module camroller_axial_setup
   use camroller_kinds, only : wp, degree
   use camroller_axial_table, only : axial_part_t, effective_lengths, is_same_axial_part, new_axial_part
   use camroller_dynamics, only : evaluate_moments, moments_t, train_t
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_kinematics, only : linkage_t, position_t, evaluate_position
   use camroller_lift, only : lift_law_t, evaluate_lift
   use camroller_materials, only : combined_modulus, materials_t
   use camroller_roller_profile, only : profile_gap, profile_logarithmic, profile_names, roller_profile_t
   use camroller_traction, only : line_lengths_t
   implicit none
   private

   public :: set_axial, last_drops, nose_length

   !> Largest equivalent radius over the length of the roller: beyond it the load is spread as there [-]
   real(wp), parameter :: largest_radius = 20.0_wp
   !> Degrees between two angles that are looked at
   integer, parameter :: step = 2

contains

   !> Make the table of a case, or none.
   subroutine set_axial(axial, profile, has_numerical_film, linkage, lift_law, length, modulus, error)
      !> The table; in: none, or that of a case with the same cam
      type(axial_part_t), allocatable, intent(inout) :: axial
      !> What the case says; not allocated: no table
      type(roller_profile_t), allocatable, intent(in) :: profile
      !> Has the case a numerical film, which knows no length?
      logical, intent(in) :: has_numerical_film
      !> Finger and lift
      type(linkage_t), intent(in) :: linkage
      type(lift_law_t), intent(in) :: lift_law
      !> Length of the contact [m], equivalent modulus [Pa]
      real(wp), intent(in) :: length, modulus
      !> Deck error; convergence error
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      ! Lift and its first three derivatives [m/rad^n]; smallest and largest equivalent radius [m]
      real(wp) :: lift(0:3), radii(2)
      integer :: i, status

      if (.not. allocated(profile)) then
         if (allocated(axial)) deallocate (axial)
         return
      end if
      if (has_numerical_film) then
         call raise(error, kind_deck, "the roller profile is not part of a numerical film, whose roller is a cylinder")
         return
      end if
      radii = [huge(1.0_wp), 0.0_wp]
      do i = 1, 360/step
         call evaluate_lift(lift_law, step*i*degree, lift)
         call evaluate_position(linkage, lift, position, status)
         if (status /= 0 .or. .not. position%equivalent_radius > 0.0_wp) cycle
         radii = [min(radii(1), position%equivalent_radius), max(radii(2), position%equivalent_radius)]
      end do
      radii = min(radii, largest_radius*length)
      if (.not. radii(2) > 0.0_wp) radii = length
      if (allocated(axial)) then
         if (is_same_axial_part(axial, profile, length, modulus, radii)) return
         deallocate (axial)
      end if
      allocate (axial)
      call new_axial_part(axial, profile, length, modulus, radii, error)
   end subroutine set_axial

   !> How far a logarithmic roller with a drop at its ends drops in the middle of its last slice, and how far without it; zero where
   !> it has none.
   pure function last_drops(profile, materials, length) result(drops)
      !> What the case says
      type(roller_profile_t), intent(in) :: profile
      !> Cam and roller
      type(materials_t), intent(in) :: materials
      !> Length of the contact [m]
      real(wp), intent(in) :: length
      !> Both drops [m]
      real(wp) :: drops(2)

      type(roller_profile_t) :: other
      real(wp) :: modulus, place ! [Pa], [m]

      drops = 0.0_wp
      if (profile%profile /= profile_names(profile_logarithmic) .or. .not. profile%end_drop > 0.0_wp) return
      modulus = combined_modulus(materials%cam_modulus, materials%cam_poisson_ratio, materials%roller_modulus, &
         & materials%roller_poisson_ratio)
      place = 0.5_wp*length*(1.0_wp - 1.0_wp/profile%slices)
      other = profile
      other%tilt = 0.0_wp
      drops(1) = profile_gap(other, length, modulus, place)
      other%end_drop = 0.0_wp
      drops(2) = profile_gap(other, length, modulus, place)
   end function last_drops

   !> Length of the line contact of cam and roller under the load at full lift of the rigid train at rest: all of the contact, or
   !> the effective length of a roller with a profile.
   function nose_length(width, linkage, lift_law, train, axial) result(length)
      !> Length of the contact [m]
      real(wp), intent(in) :: width
      !> Finger, lift, masses and spring
      type(linkage_t), intent(in) :: linkage
      type(lift_law_t), intent(in) :: lift_law
      type(train_t), intent(in) :: train
      !> The table, where the roller has a profile
      type(axial_part_t), intent(in), optional :: axial
      !> The length [m]
      real(wp) :: length

      type(position_t) :: position
      type(moments_t) :: moments
      ! Lengths, and derivatives of their logarithms [-]
      type(line_lengths_t) :: lengths, slopes(2)
      ! Lift and its first three derivatives [m/rad^n], load [N]
      real(wp) :: lift(0:3), load
      integer :: status

      length = width
      if (.not. present(axial)) return
      call evaluate_lift(lift_law, 0.0_wp, lift)
      call evaluate_position(linkage, lift, position, status)
      if (status /= 0) return
      call evaluate_moments(train, position, 0.0_wp, 0.0_wp, moments)
      load = moments%total/position%normal_arm
      if (.not. min(load, position%equivalent_radius) > 0.0_wp) return
      call effective_lengths(axial, load, position%equivalent_radius, lengths, slopes(1), slopes(2))
      length = lengths%mean
   end function nose_length

end module camroller_axial_setup
