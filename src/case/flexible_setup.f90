!> A flexible train made ready: constants, and its rest on the base circle.
!>
!> In: case, linkage, rigid train, joint of the pivot. Out: `flexible_t`, or what keeps the case from having one.
module camroller_flexible_setup
   use camroller_kinds, only : wp, degree, pi
   use camroller_error, only : error_t, raise, kind_deck, kind_convergence
   use camroller_contact_compliance, only : line_approach
   use camroller_case, only : case_t, energy_names
   use camroller_asperity, only : mobilisation_names
   use camroller_kinematics, only : linkage_t, mechanism_t, position_t, evaluate_position
   use camroller_dynamics, only : train_t
   use camroller_lift, only : highest_lift, lift_law_t
   use camroller_pivot, only : pivot_t
   use camroller_pivot_friction, only : largest_slope, pivot_part_t
   use camroller_torque, only : normal_direction
   use camroller_spring_modes, only : new_spring_modes, effective_mass, most_modes
   use camroller_lash_adjuster, only : new_adjuster
   use camroller_flexible_parts, only : flexible_t, set_contacts
   use camroller_number_text, only : fixed_text, integer_text, number_text
   implicit none
   private

   public :: rest_t, set_flexible, check_ball, find_rest, base_load, pivot_share, say_pulled_off, seat_sink

   !> The train at rest on the base circle
   type :: rest_t
      !> Angle of the finger [rad], lift of the valve [m], place of the pivot [m]
      real(wp) :: finger, lift, pivot
      !> Force at the valve's tip and of the adjuster or pivot along its axis [N]
      real(wp) :: tip_force, axial_force
   end type rest_t

contains

   !> Refuse a finger that jams on its ball: friction slows the finger, which changes the force of the ball and by that the friction
   !> again, by nearly as much.
   subroutine check_ball(flexible, train, ball, error)
      !> The train
      type(flexible_t), intent(in) :: flexible
      !> Its masses
      type(train_t), intent(in) :: train
      !> Friction of the finger on its ball; not allocated without any
      type(pivot_part_t), allocatable, intent(in) :: ball
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      ! Change of the ball's force by a moment on the finger, at most [1/m]; mass that moves with the pivot [kg]
      real(wp) :: gain, mass

      if (.not. allocated(ball)) return
      associate (moment => flexible%finger_mass*flexible%finger_centre)
         gain = moment/train%finger_inertia
         if (allocated(flexible%adjuster)) then
            mass = flexible%finger_mass + flexible%adjuster%given%plunger_mass
            gain = moment*(mass + flexible%finger_mass)/(mass*train%finger_inertia - moment**2)
         end if
      end associate
      gain = gain*ball%law%coefficient*ball%ball_radius
      if (gain > largest_slope) call raise(error, kind_deck, "finger_pivot: the finger jams on its ball, since friction "// &
         & "there would add up to "//number_text(gain, 3)//" N m for each newton metre of itself; lower "// &
         & "finger_pivot.friction_coefficient or finger_pivot.ball_radius_mm")
   end subroutine check_ball

   !> Constants of a case's flexible train.
   subroutine set_flexible(flexible, case, lift_law, linkage, train, pivot, modulus, length, load, error)
      !> The train
      type(flexible_t), intent(out) :: flexible
      !> The case, with a flexible train
      type(case_t), intent(in) :: case
      !> Its lift, its linkage
      type(lift_law_t), intent(in) :: lift_law
      type(linkage_t), intent(in) :: linkage
      !> Its masses and spring
      type(train_t), intent(in) :: train
      !> Its joint between finger and pivot; without it there is an error
      type(pivot_t), intent(in), optional :: pivot
      !> Equivalent modulus of cam and roller [Pa], length of their contact that gives way [m], base circle load [N]
      real(wp), intent(in) :: modulus, length, load
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      call check_company(case, error)
      if (allocated(error)) return
      if (.not. present(pivot)) then
         call raise(error, kind_deck, "dynamics: the finger's mass is needed, masses.finger_kg above 0")
         return
      end if
      call check_contacts(case, highest_lift(lift_law), error)
      if (allocated(error)) return
      call set_contacts(flexible, case%dynamics, modulus, length)
      flexible%finger_mass = pivot%mass
      flexible%finger_centre = pivot%centre
      flexible%axis = exp(cmplx(0.0_wp, -pivot%axis_angle, wp))
      flexible%tilt_cosine = cos(pivot%tilt)
      flexible%tilt_sine = -sin(pivot%tilt)
      call set_spring(flexible, case, error)
      if (allocated(error)) return
      call set_rest(flexible, case, linkage, train, load, error)
   end subroutine set_flexible

   !> Refuse what a flexible train cannot go with.
   subroutine check_company(case, error)
      type(case_t), intent(in) :: case
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      if (case%energy /= energy_names(1)) then
         call raise(error, kind_deck, "dynamics: a flexible train needs case.energy = '"//trim(energy_names(1))//"'")
      else if (allocated(case%asperity)) then
         if (case%asperity%mobilisation == mobilisation_names(2)) call raise(error, kind_deck, "dynamics: a flexible train "// &
            & "needs asperity.mobilisation = '"//trim(mobilisation_names(1))//"'")
      end if
   end subroutine check_company

   !> Refuse contacts that cannot carry.
   subroutine check_contacts(case, lift, error)
      type(case_t), intent(in) :: case
      !> Largest lift of the lobe shape [m]
      real(wp), intent(in) :: lift
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      ! Part of the lift that a closed valve may sink into its seat [-]
      real(wp), parameter :: deepest = 0.05_wp
      ! How far it sinks [m]
      real(wp) :: sink

      associate (dynamics => case%dynamics)
         if (.not. min(dynamics%finger_stiffness, dynamics%pad_stiffness, dynamics%seat_stiffness) > 0.0_wp) then
            call raise(error, kind_deck, "dynamics: every stiffness must be above 0")
         else if (min(dynamics%contact_damping, dynamics%pad_damping, dynamics%seat_damping, dynamics%lash) < 0.0_wp) then
            call raise(error, kind_deck, "dynamics: damping and lash must be 0 or more")
         end if
         if (allocated(error)) return
         sink = case%spring%stiffness*case%spring%precompression/dynamics%seat_stiffness
         if (sink <= deepest*lift) return
         call raise(error, kind_deck, "dynamics: the seat is too soft for the spring: the closed valve sinks "// &
            & fixed_text(1.0e3_wp*sink, 3)//" mm into it, more than a twentieth of the lift; raise dynamics.seat_stiffness_N_m "// &
            & "above "//number_text(case%spring%stiffness*case%spring%precompression/(deepest*lift), 3))
      end associate
   end subroutine check_contacts

   !> Modes of the spring and the mass that is left to the valve.
   subroutine set_spring(flexible, case, error)
      !> The train
      type(flexible_t), intent(inout) :: flexible
      type(case_t), intent(in) :: case
      !> Deck error where the spring's third is more than the mass that holds it
      type(error_t), allocatable, intent(out) :: error

      flexible%effective_mass = case%masses%valve
      if (.not. flexible%effective_mass > 0.0_wp) then
         call raise(error, kind_deck, "dynamics: the valve's mass is needed, masses.valve_kg above 0")
         return
      end if
      if (.not. allocated(case%spring_surge)) return
      if (.not. case%spring_surge%mass > 0.0_wp .or. .not. case%spring%stiffness > 0.0_wp) then
         call raise(error, kind_deck, "spring_surge: the spring's mass and stiffness must be above 0")
      else if (case%spring_surge%modes < 1 .or. case%spring_surge%modes > most_modes) then
         call raise(error, kind_deck, "spring_surge: the number of modes must be from 1 to "//integer_text(most_modes))
      else if (case%spring_surge%mass >= 3.0_wp*case%masses%valve) then
         call raise(error, kind_deck, "spring_surge: a third of spring_surge.mass_kg = "// &
            & number_text(case%spring_surge%mass, 4)//" is more than masses.valve_kg = "//number_text(case%masses%valve, 4)// &
            & ", which holds it beside the valve")
      else
         call new_spring_modes(flexible%modes, case%spring_surge, case%spring%stiffness)
         flexible%effective_mass = effective_mass(flexible%modes, case%masses%valve)
      end if
   end subroutine set_spring

   !> Adjuster and the place of the pivot at rest.
   subroutine set_rest(flexible, case, linkage, train, load, error)
      !> The train
      type(flexible_t), intent(inout) :: flexible
      type(case_t), intent(in) :: case
      type(linkage_t), intent(in) :: linkage
      !> Its masses and spring
      type(train_t), intent(in) :: train
      !> Base circle load [N]
      real(wp), intent(in) :: load
      !> Deck error where the adjuster has no force for its load; convergence error
      type(error_t), allocatable, intent(out) :: error

      type(rest_t) :: rest
      character(len=:), allocatable :: text

      if (allocated(case%lash_adjuster)) then
         if (.not. load > 0.0_wp) then
            call say_pulled_off(case%mechanism, "on the base circle", text)
            call raise(error, kind_deck, "lash_adjuster: "//text)
            return
         end if
         allocate (flexible%adjuster)
         call new_adjuster(flexible%adjuster, case%lash_adjuster)
      end if
      if (case%dynamics%lash > 0.0_wp) then
         if (.not. allocated(flexible%adjuster)) return
         call raise(error, kind_deck, "dynamics: a lash adjuster leaves no lash; its lash must be 0")
         return
      end if
      call find_rest(flexible, linkage, train, load, rest, error)
      if (allocated(error)) return
      flexible%pivot_place = rest%pivot
      if (.not. allocated(flexible%adjuster)) return
      associate (adjuster => flexible%adjuster)
         if (adjuster%spring_force > 0.0_wp) return
         adjuster%spring_force = rest%axial_force - adjuster%given%supply_pressure*adjuster%area
         if (adjuster%spring_force >= 0.0_wp) return
         call raise(error, kind_deck, "lash_adjuster: the supply pressure alone presses the plunger with "// &
            & number_text(adjuster%given%supply_pressure*adjuster%area, 4)//" N, more than spring.base_circle_load_N = "// &
            & number_text(case%spring%base_circle_load, 4)//" leaves it, "//number_text(rest%axial_force, 4)// &
            & " N; raise that load, or lower lash_adjuster.supply_pressure_MPa or lash_adjuster.diameter_mm")
      end associate
   end subroutine set_rest

   !> Load on the base circle: as given, or what an adjuster makes of its pressure and its plunger's spring.
   pure function base_load(case, linkage, closed) result(load)
      !> The case
      type(case_t), intent(in) :: case
      !> Its linkage
      type(linkage_t), intent(in) :: linkage
      !> Geometry on the base circle
      type(position_t), intent(in) :: closed
      !> W [N]
      real(wp) :: load

      real(wp) :: area ! [m^2]

      load = case%spring%base_circle_load
      if (.not. (allocated(case%dynamics) .and. allocated(case%lash_adjuster))) return
      if (.not. case%lash_adjuster%spring_force > 0.0_wp) return
      area = 0.25_wp*pi*case%lash_adjuster%diameter**2
      load = (case%lash_adjuster%supply_pressure*area + case%lash_adjuster%spring_force) &
         & /pivot_share(linkage, closed, case%mechanism%adjuster_tilt)
   end function base_load

   !> Force that presses a finger at rest onto its pivot, along the adjuster's axis and without friction, over the contact load;
   !> negative where cam and valve pull the finger off.
   pure function pivot_share(linkage, position, tilt) result(share)
      !> The linkage
      type(linkage_t), intent(in) :: linkage
      !> Geometry at a cam angle
      type(position_t), intent(in) :: position
      !> Angle from the valve's axis to the adjuster's [rad]
      real(wp), intent(in) :: tilt
      !> The force over the load [-]
      real(wp) :: share

      ! Normal and tangent of the contact [-], angle of the adjuster's axis [rad]
      real(wp) :: normal(2), tangent(2), axis

      call normal_direction(position%normal_arm, position%tangent_arm, linkage%a, position%arm_angle, linkage%sense, normal, &
         & tangent)
      axis = linkage%valve_axis_angle + tilt
      share = -(normal(1)*cos(axis) - normal(2)*sin(axis) + cos(tilt)*position%normal_arm/position%valve_arm)
   end function pivot_share

   !> That cam and valve pull a finger off its pivot, in words that name the keys which decide it.
   pure subroutine say_pulled_off(mechanism, where, text)
      !> The mechanism
      type(mechanism_t), intent(in) :: mechanism
      !> Where that is so
      character(len=*), intent(in) :: where
      !> The words
      character(len=:), allocatable, intent(out) :: text

      text = "cam and valve pull the finger off its pivot even at rest, "//where//", with mechanism.valve_axis_angle_deg = "// &
         & number_text(mechanism%valve_axis_angle/degree, 6)
      if (abs(mechanism%adjuster_tilt) > 0.0_wp) text = text//" and mechanism.adjuster_tilt_deg = "// &
         & number_text(mechanism%adjuster_tilt/degree, 6)
      text = text//"; no train works so: are the dimensions of &mechanism right, angles in degrees and with their signs?"
   end subroutine say_pulled_off

   !> How far the spring alone presses the closed valve into its seat: by that a lash is less, and of a smaller one nothing is left.
   pure function seat_sink(flexible, train) result(sink)
      !> The train
      type(flexible_t), intent(in) :: flexible
      !> Its masses and spring
      type(train_t), intent(in) :: train
      !> Way of the valve at rest [m]
      real(wp) :: sink

      sink = train%stiffness*train%precompression/(flexible%seat_stiffness + train%stiffness)
   end function seat_sink

   !> The train at rest on the base circle under a given contact load, without friction: `W n + F_p u_v + F_A u_h + side = 0`.
   !>
   !> Finger's angle and pivot's place follow from the distance between cam and roller and from the gap at the pad, by Newton's
   !> method; the forces follow from them and change little.
   subroutine find_rest(flexible, linkage, train, load, rest, error)
      !> The train
      type(flexible_t), intent(in) :: flexible
      !> Its linkage
      type(linkage_t), intent(in) :: linkage
      !> Its masses and spring
      type(train_t), intent(in) :: train
      !> Contact load, W [N]
      real(wp), intent(in) :: load
      !> The train at rest
      type(rest_t), intent(out) :: rest
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: closed
      ! Distance of the roller's centre from the cam's, as it has to be [m]
      real(wp) :: distance
      ! Roller centre from the cam's centre [m], roller arm [m], adjuster's axis, normal [-]
      complex(wp) :: centre, arm, axis, normal
      ! Way too far [m], gap too wide at the pad [m]; their derivatives over gamma [m] and y [-]; changes of both [rad], [m]
      real(wp) :: excess, gap, by_finger(2), by_pivot(2), change(2), determinant
      ! Way that a change moves roller and pivot, and that of the one before [m]
      real(wp) :: way, last_way
      ! Changes below which rounding may keep them from falling, over the roller arm [-]
      real(wp), parameter :: smallest = 1.0e-10_wp
      integer :: i, status

      call evaluate_position(linkage, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], closed, status)
      distance = closed%rolling_travel + linkage%roller_radius - line_approach(flexible%compliance, load) &
         & - load/flexible%finger_stiffness
      rest%finger = linkage%base_angle
      rest%pivot = 0.0_wp
      last_way = huge(1.0_wp)
      axis = flexible%axis
      do i = 1, 50
         arm = linkage%a*exp(cmplx(0.0_wp, rest%finger + linkage%arm_offset + linkage%valve_axis_angle, wp))
         centre = rest%pivot*axis + arm - linkage%d
         normal = centre/abs(centre)
         associate (sine => sin(rest%finger + linkage%valve_axis_angle), cosine => cos(rest%finger + linkage%valve_axis_angle))
            rest%tip_force = load*aimag(conjg(arm)*normal)/(linkage%b*sine)
            rest%axial_force = -load*real(conjg(axis)*normal, wp) - flexible%tilt_cosine*rest%tip_force
            rest%lift = (rest%tip_force - train%stiffness*train%precompression)/(flexible%seat_stiffness + train%stiffness)
            excess = abs(centre) - distance
            gap = linkage%b*(linkage%base_cosine - cosine) - rest%pivot*flexible%tilt_cosine - rest%lift &
               & - rest%tip_force/flexible%pad_stiffness
            by_finger = [-aimag(conjg(normal)*arm), linkage%b*sine]
         end associate
         by_pivot = [real(conjg(normal)*axis, wp), -flexible%tilt_cosine]
         determinant = by_finger(1)*by_pivot(2) - by_finger(2)*by_pivot(1)
         change = [gap*by_pivot(1) - excess*by_pivot(2), excess*by_finger(2) - gap*by_finger(1)]/determinant
         rest%finger = rest%finger + change(1)
         rest%pivot = rest%pivot + change(2)
         way = abs(change(1))*linkage%a + abs(change(2))
         ! An adjuster that is nearly along the finger multiplies rounding
         if (way <= 1.0e-15_wp*linkage%a .or. (way >= last_way .and. way <= smallest*linkage%a)) return
         last_way = way
      end do
      call raise(error, kind_convergence, "the flexible train finds no rest on the base circle under "//number_text(load, 4)//" N")
   end subroutine find_rest

end module camroller_flexible_setup
