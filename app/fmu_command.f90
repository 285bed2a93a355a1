!> The command `fmu`: the valve trains of a deck as an FMU for co-simulation.
!>
!> In: the command line. Out: the file.
!>
!> The library that goes into it is that of the bundle of the CMake build. Where the program is installed it is in
!> `../lib/camroller/` of the program's folder; `make install PREFIX=build/release IO=OFF` puts it there for the program that fpm
!> builds. `--library` names another folder.
module camroller_fmu_command
   use camroller_error, only : error_t
   use camroller_cli, only : config_t
   use camroller_console, only : tell_deck_remarks
   use camroller_deck, only : deck_t, read_deck, drop_sweep
   use camroller_fmu_file, only : write_fmu
   use camroller_output_kind, only : fmu_kind
   use camroller_run_command, only : find_place
   use camroller_streams, only : print_lines
   use camroller_system_file, only : resolve_path
   use camroller_text_file, only : folder_of
   implicit none
   private

   public :: fmu_of_deck

   !> Where the library is, from the folder of the program
   character(len=*), parameter :: library_folder = "../lib/camroller/"
   !> The running program, as the system shows it
   character(len=*), parameter :: own_program = "/proc/self/exe"

contains

   !> Write the FMU of a deck.
   subroutine fmu_of_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> File, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(deck_t) :: deck
      character(len=:), allocatable :: path, library

      call read_deck(deck, config%subject, config%overrides, error)
      if (.not. allocated(error)) call find_place(config, deck, fmu_kind, ".fmu", path, error)
      if (allocated(error)) return
      call drop_sweep(deck)
      if (.not. config%is_quiet) call tell_deck_remarks(deck, of_hosts=.true.)
      library = config%library//"/"
      if (config%library == "") library = folder_of(resolve_path(own_program))//library_folder
      call write_fmu(deck, config%fmi_version, library, path, error)
      if (allocated(error) .or. config%is_quiet) return
      call print_lines("wrote "//path, error)
   end subroutine fmu_of_deck

end module camroller_fmu_command
