!> The library from another program: two cases side by side in memory, then a follower driven angle by angle.
!>
!> The first case comes from a deck, the second is the first with another oil temperature: no files are written and nothing is
!> shared between the two. Run it from the project's folder, where `decks/` is.
program two_cases
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use camroller, only : wp, error_t, deck_t, override_t, case_t, result_t, read_deck, make_case, run_case, get_summary, &
      & simulation_t, outcome_t, start_simulation, advance, degree, use_one_blas_thread
   implicit none

   call main()

contains

   !> Everything, so that the program unit holds no allocated memory at its end.
   subroutine main()
      type(deck_t) :: deck
      type(case_t) :: cool, hot
      type(result_t) :: cool_result, hot_result
      type(error_t), allocatable :: error
      type(override_t) :: nothing(0)

      ! With a numerical film (`&ehl`), last digits would change with the number of threads that OpenBLAS takes
      call use_one_blas_thread()
      call read_deck(deck, "decks/thesis.nml", nothing, error)
      call stop_on(error)
      call make_case(deck, nothing, cool, error)
      call stop_on(error)
      hot = cool
      hot%operating_point%oil_temperature = cool%operating_point%oil_temperature + 70.0_wp

      call run_case(cool, cool_result, error)
      call stop_on(error)
      call run_case(hot, hot_result, error)
      call stop_on(error)
      call show("cool oil", cool_result)
      call show("hot oil", hot_result)
      call drive(hot)
   end subroutine main

   !> Print two scalars of a result.
   subroutine show(name, result)
      !> Name of the case
      character(len=*), intent(in) :: name
      !> Its result
      type(result_t), intent(in) :: result

      ! Mean friction torque [N m], mean slip ratio [-]
      real(wp) :: torque, slip
      type(error_t), allocatable :: error

      call get_summary(result, "mean_torque_friction", torque, error)
      call stop_on(error)
      call get_summary(result, "mean_slip_ratio", slip, error)
      call stop_on(error)
      write (output_unit, "(a, f9.5, a, f7.4)") name//": mean friction torque ", torque, " N m, mean slip ratio ", slip
   end subroutine show

   !> Drive a follower through one turn in steps of ten degrees while the speed rises, as an engine program would.
   subroutine drive(case)
      !> The case to start from
      type(case_t), intent(in) :: case

      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: error
      ! Cam speed [rad/s]; mean drive torque over the turn [N m]
      real(wp) :: speed, torque
      integer :: step

      call start_simulation(simulation, case, 0.0_wp, error)
      call stop_on(error)
      torque = 0.0_wp
      do step = 1, 36
         speed = case%operating_point%speed*(1.0_wp + 0.01_wp*step)
         call advance(simulation, step*10.0_wp*degree, speed, case%operating_point%oil_temperature, outcome, error)
         call stop_on(error)
         torque = torque + outcome%mean_torque_drive/36.0_wp
      end do
      write (output_unit, "(a, f9.5, a)") "driven with rising speed: mean drive torque of the follower ", torque, " N m"
   end subroutine drive

   !> End with the message of an error, if there is one.
   subroutine stop_on(error)
      !> What went wrong, if anything
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (error_unit, "(a)") error%message
      stop 1
   end subroutine stop_on

end program two_cases
