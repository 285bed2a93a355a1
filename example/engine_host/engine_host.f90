!> An engine that drives its valve trains: four cylinders, sixteen followers on two camshafts, one step for each degree of crank
!> angle.
!>
!> The host gives speed, oil temperature and the pressure in the cylinders; the library gives the torque that the camshafts take,
!> with the followers shared out to the threads of OpenMP. Usage: engine_host DECK [CYCLES [THREADS]]
program engine_host
   use, intrinsic :: iso_fortran_env, only : int64, error_unit
   use camroller_core, only : wp, pi, degree, error_t, deck_t, override_t, case_t, inputs_t, shaft_simulation_t, shaft_outcome_t, &
      & read_deck, make_case, start_shaft, advance_shaft, cam_number, of_bearings, use_one_blas_thread
   implicit none

   !> Cylinders in the order in which they fire; cams of a camshaft for each cylinder
   integer, parameter :: firing_order(4) = [1, 3, 4, 2], cams_of_cylinder = 2
   !> Crank angle after the firing dead centre of cylinder 1 where the first cam is at full lift [rad]
   real(wp), parameter :: crank_at_nose = 470.0_wp*degree
   !> Crank angle of a step, and of a working cycle [rad]
   real(wp), parameter :: step = degree, cycle_angle = 720.0_wp*degree

   call main()

contains

   !> Everything, so that the program unit holds no allocated memory at its end.
   subroutine main()
      type(deck_t) :: deck
      type(case_t) :: case
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(inputs_t) :: ends(2)
      type(override_t) :: none(0)
      type(error_t), allocatable :: error
      ! Gauge pressure of the cams at both ends of a step [Pa]; crank angles there [rad]; mean torques of a cycle [N m]
      real(wp), allocatable :: pressures(:, :)
      real(wp) :: crank(2), torques(3)
      integer(int64) :: begin, finish, rate
      integer :: cycles, threads, cycle, i, k

      cycles = number_at(2, 3)
      threads = number_at(3, 1)
      call use_one_blas_thread()
      call read_deck(deck, word_at(1), none, error)
      if (.not. allocated(error)) call make_case(deck, none, case, error)
      if (.not. allocated(error)) call start_shaft(shaft, case, cam_angle(0.0_wp), error, threads)
      call stop_on(error)
      allocate (pressures(cam_number(shaft), 2))
      do cycle = 1, cycles
         torques = 0.0_wp
         call system_clock(begin, rate)
         do i = 1, nint(cycle_angle/step)
            crank = (cycle - 1)*cycle_angle + [i - 1, i]*step
            do k = 1, 2
               ends(k) = inputs_t(speed_at(crank(k)), 363.15_wp)
               pressures(:, k) = pressures_at(crank(k), size(pressures, 1))
            end do
            call advance_shaft(shaft, cam_angle(crank(2)), ends(1), ends(2), outcome, error, pressures)
            call stop_on(error)
            torques = torques + [outcome%mean_torque_drive, outcome%mean_torque_friction, &
               & outcome%mean_torques(of_bearings)]*step/cycle_angle
         end do
         call system_clock(finish)
         print '(a, i0, 3(a, es19.12))', "cycle ", cycle, " drive ", torques(1), " friction ", torques(2), " bearings ", &
            & torques(3)
         write (error_unit, '(a, i0, a, f0.3, a)') "cycle ", cycle, " took ", real(finish - begin, wp)/rate, " s"
      end do
   end subroutine main

   !> Cam angle at a crank angle [rad]: the camshafts turn half as fast.
   pure function cam_angle(crank) result(angle)
      real(wp), intent(in) :: crank
      real(wp) :: angle

      angle = pi + 0.5_wp*(crank - crank_at_nose)
   end function cam_angle

   !> Speed of the camshafts [rad/s] at a crank angle [rad]: 2000 rev/min of the crank with the ripple of four cylinders.
   pure function speed_at(crank) result(speed)
      real(wp), intent(in) :: crank
      real(wp) :: speed

      speed = 2000.0_wp*pi/60.0_wp*(1.0_wp - 0.02_wp*cos(2.0_wp*crank))
   end function speed_at

   !> Gauge pressure at the valve of each cam [Pa] at a crank angle [rad].
   pure function pressures_at(crank, cams) result(pressures)
      real(wp), intent(in) :: crank
      integer, intent(in) :: cams
      real(wp) :: pressures(cams)

      integer :: cam, cylinder

      do cam = 1, cams
         cylinder = modulo((cam - 1)/cams_of_cylinder, 4) + 1
         pressures(cam) = cylinder_pressure(crank - (findloc(firing_order, cylinder, dim=1) - 1)*0.25_wp*cycle_angle)
      end do
   end function pressures_at

   !> Gauge pressure in a cylinder [Pa] at the crank angle after its firing dead centre [rad]: compression and expansion of a charge
   !> that burns, and outside them nothing.
   pure function cylinder_pressure(crank) result(pressure)
      real(wp), intent(in) :: crank
      real(wp) :: pressure

      ! Crank angle within a cycle [rad]; volume over that at bottom dead centre, burnt part of the charge [-]
      real(wp) :: angle, volume, burnt

      angle = modulo(crank + 0.5_wp*cycle_angle, cycle_angle) - 0.5_wp*cycle_angle
      pressure = 0.0_wp
      if (abs(angle) >= pi) return
      volume = 0.1_wp + 0.45_wp*(1.0_wp - cos(angle))
      burnt = 0.5_wp*(1.0_wp + tanh((angle - 12.0_wp*degree)/(10.0_wp*degree)))
      pressure = 1.0e5_wp*(volume**(-1.32_wp)*(1.0_wp + 1.5_wp*burnt*(1.0_wp + cos(angle))) - 1.0_wp)
   end function cylinder_pressure

   !> Word of the command line.
   function word_at(place) result(word)
      integer, intent(in) :: place
      character(len=:), allocatable :: word

      integer :: length

      call get_command_argument(place, length=length)
      allocate (character(len=length) :: word)
      call get_command_argument(place, word)
   end function word_at

   !> Number of the command line, or another where there is none.
   function number_at(place, otherwise) result(number)
      integer, intent(in) :: place, otherwise
      integer :: number

      character(len=:), allocatable :: word
      integer :: status

      number = otherwise
      word = word_at(place)
      read (word, *, iostat=status) number
      if (status /= 0) number = otherwise
   end function number_at

   !> End the program where something went wrong.
   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (error_unit, '(a)') error%message
      stop 1
   end subroutine stop_on

end program engine_host
