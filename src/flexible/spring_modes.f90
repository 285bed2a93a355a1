!> A valve spring with mass: a bar whose lower end is fixed and whose upper end moves with the valve, as its static shape and the
!> modes of a bar with both ends held.
!>
!> In: stiffness, mass, number of modes. Out: constants, forces at both ends, energies. Source: Wahl, Mechanical
!> Springs (1963), for the surge of helical springs; projection of the wave equation on `u = xi x + sum q_n sin(n pi xi)`.
module camroller_spring_modes
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: spring_surge_t, spring_modes_t, most_modes, new_spring_modes, effective_mass, valve_pull, wave_compression, &
      & most_waves, mode_energy

   !> Modes that a spring can have
   integer, parameter :: most_modes = 20

   !> Spring with mass, as a deck has it
   type :: spring_surge_t
      !> Mass of the active coils [kg]
      real(wp) :: mass = 0.0_wp
      !> Number of modes
      integer :: modes = 5
      !> Damping ratio of each mode [-]
      real(wp) :: damping_ratio = 0.01_wp
   end type spring_surge_t

   !> Modes ready for evaluation
   type :: spring_modes_t
      !> Number of modes
      integer :: count = 0
      !> Mass, m_s [kg]
      real(wp) :: mass = 0.0_wp
      !> Stiffness, k [N/m]
      real(wp) :: stiffness = 0.0_wp
      !> Damping ratio, zeta [-]
      real(wp) :: damping_ratio = 0.0_wp
      !> Angular frequency of each mode with both ends held, omega_n [rad/s]
      real(wp), allocatable :: frequency(:)
      !> s_n = (-1)^(n+1)/(n pi) [-]
      real(wp), allocatable :: share(:)
      !> Slopes of the modes along the spring, `n pi cos(n pi xi)`, at places an eighth of the shortest half wave apart, shape
      !> (mode, place) [-]
      real(wp), allocatable :: slopes(:, :)
   end type spring_modes_t

contains

   !> Constants of the modes.
   subroutine new_spring_modes(modes, surge, stiffness)
      !> The modes
      type(spring_modes_t), intent(out) :: modes
      !> The spring's mass
      type(spring_surge_t), intent(in) :: surge
      !> The spring's stiffness [N/m]
      real(wp), intent(in) :: stiffness

      ! Places within the shortest half wave
      integer, parameter :: density = 8
      integer :: n, i

      modes%count = surge%modes
      modes%mass = surge%mass
      modes%stiffness = stiffness
      modes%damping_ratio = surge%damping_ratio
      allocate (modes%frequency(modes%count), modes%share(modes%count))
      do n = 1, modes%count
         modes%frequency(n) = mode_frequency(n, stiffness, surge%mass)
         modes%share(n) = merge(1.0_wp, -1.0_wp, modulo(n, 2) == 1)/(n*pi)
      end do
      allocate (modes%slopes(modes%count, density*modes%count + 1))
      do i = 0, density*modes%count
         modes%slopes(:, i + 1) = [(n*pi*cos(n*pi*i/(density*modes%count)), n=1, modes%count)]
      end do
   end subroutine new_spring_modes

   !> What waves take from the compression of the coils where they take most, and add where they add most, as of the whole spring:
   !> with the whole spring's, a part has none left where the sum is zero, and coils touch where it is the travel from free to solid
   !> length.
   pure function wave_compression(modes, amplitudes) result(ends)
      !> The modes
      type(spring_modes_t), intent(in) :: modes
      !> q_n [m]
      real(wp), intent(in) :: amplitudes(:)
      !> Smallest and largest of `sum n pi q_n cos(n pi xi)`, at most and at least zero [m]
      real(wp) :: ends(2)

      real(wp) :: added ! at one place [m]
      integer :: i

      ends = 0.0_wp
      do i = 1, size(modes%slopes, 2)
         added = dot_product(modes%slopes(:, i), amplitudes)
         ends = [min(ends(1), added), max(ends(2), added)]
      end do
   end function wave_compression

   !> What waves take at most, wherever: all modes together, as at the spring's fixed end.
   pure function most_waves(modes, amplitudes) result(most)
      !> The modes, one at least
      type(spring_modes_t), intent(in) :: modes
      !> q_n [m]
      real(wp), intent(in) :: amplitudes(:)
      !> `sum n pi |q_n|` [m]
      real(wp) :: most

      most = dot_product(modes%slopes(:, 1), abs(amplitudes))
   end function most_waves

   !> Angular frequency of a mode with both ends held.
   elemental function mode_frequency(n, stiffness, mass) result(frequency)
      !> Number of the mode, from 1
      integer, intent(in) :: n
      !> Stiffness [N/m]
      real(wp), intent(in) :: stiffness
      !> Mass [kg]
      real(wp), intent(in) :: mass
      !> omega_n [rad/s]
      real(wp) :: frequency

      frequency = n*pi*sqrt(stiffness/mass)
   end function mode_frequency

   !> Mass that the valve's own equation has, `m_v - sum 2 m_s/(n pi)^2`, with a third of the spring in m_v.
   pure function effective_mass(modes, valve_mass) result(mass)
      !> The modes
      type(spring_modes_t), intent(in) :: modes
      !> Valve with a third of the spring [kg]
      real(wp), intent(in) :: valve_mass
      !> m_N [kg]
      real(wp) :: mass

      mass = valve_mass
      if (modes%count > 0) mass = mass - 2.0_wp*modes%mass*sum(modes%share**2)
   end function effective_mass

   !> Force of the modes on the valve beside its effective mass, `m_s sum s_n (omega_n^2 q_n + 2 zeta omega_n qd_n)`.
   pure function valve_pull(modes, amplitudes, rates) result(force)
      !> The modes
      type(spring_modes_t), intent(in) :: modes
      !> q_n [m] and their rates [m/s]
      real(wp), intent(in) :: amplitudes(:), rates(:)
      !> Force [N]
      real(wp) :: force

      integer :: n

      force = 0.0_wp
      do n = 1, modes%count
         force = force + modes%share(n)*modes%frequency(n)*(modes%frequency(n)*amplitudes(n) &
            & + 2.0_wp*modes%damping_ratio*rates(n))
      end do
      force = modes%mass*force
   end function valve_pull

   !> Energy of the modes: of their coils beside each other and of their motion, with the part that they share with the valve.
   pure function mode_energy(modes, amplitudes, rates, valve_speed) result(energy)
      !> The modes
      type(spring_modes_t), intent(in) :: modes
      !> q_n [m] and their rates [m/s]
      real(wp), intent(in) :: amplitudes(:), rates(:)
      !> Speed of the valve [m/s]
      real(wp), intent(in) :: valve_speed
      !> Energy [J]
      real(wp) :: energy

      integer :: n

      energy = 0.0_wp
      do n = 1, modes%count
         energy = energy + modes%mass*(modes%share(n)*valve_speed*rates(n) + 0.25_wp*rates(n)**2 &
            & + 0.25_wp*(modes%frequency(n)*amplitudes(n))**2)
      end do
   end function mode_energy

end module camroller_spring_modes
