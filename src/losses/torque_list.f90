!> The torques on a camshaft by source: one list with the name, the meaning and the kind of each.
!>
!> A loss has one row here and one line in `camroller_state` that calls its formula. Its series, its mean and extremes, its power
!> and work, its part of the friction mean effective pressure and its term of the energy balance follow from the row.
!>
!> What gas on a closed valve loses in dampers comes back in the torque against gas force with the other sign: both are part of what
!> drives the camshaft, where they cancel, and neither is friction.
!>
!> A vector of torques holds one value for each row, in this order; last stands the energy residual, in watts.
module camroller_torque_list
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: torque_list, torque_count, is_loss, is_torque, torque_series, sum_of_losses, sum_of_torques
   public :: of_geometric, of_contact, of_needle, of_guide, of_roller_inertia, of_damping, of_bearings, &
      & of_tip, of_seal, of_guide_side, of_pivot, of_needle_drag, of_shaft_drag, of_gas_damping, of_residual

   !> Rows of the list
   enum, bind(C)
      enumerator :: of_geometric = 1, of_contact, of_needle, of_guide, of_roller_inertia, of_damping, of_bearings, &
         & of_tip, of_seal, of_guide_side, of_pivot, of_needle_drag, of_shaft_drag, of_gas_damping, of_residual
   end enum

   !> Kinds of rows: energy that comes back, energy that is lost, energy lost that the gas in the cylinder pays and no camshaft,
   !> the error of the energy balance
   enum, bind(C)
      enumerator :: kind_stored = 1, kind_loss, kind_gas_loss, kind_residual
   end enum

   !> One row
   type :: torque_row_t
      !> Short name; the series is called `torque_` and this name
      character(len=name_length) :: name
      !> Meaning of the series
      character(len=56) :: meaning
      !> Part of the model that it comes from, without which a case has no such torque: a group of the deck, `roller` for the
      !> consistent bookkeeping, `torque` for what every case has
      character(len=name_length) :: source
      !> One of the kinds
      integer :: kind
      !> Heading in tables; blank: not in tables
      character(len=14) :: heading
   end type torque_row_t

   !> The list
   type(torque_row_t), parameter :: torque_list(*) = [ &
      torque_row_t("geometric", "torque against spring, inertia and gas force", "torque", kind_stored, ""), &
      torque_row_t("contact", "torque for the losses of the contact", "torque", kind_loss, "contact"), &
      torque_row_t("needle", "torque for the roller's bearing", "needle_bearing", kind_loss, "roller bearing"), &
      torque_row_t("guide", "torque for the valve guide", "valve_guide", kind_loss, "guide"), &
      torque_row_t("roller_inertia", "torque for the inertia of the roller", "roller", kind_stored, ""), &
      torque_row_t("damping", "torque for the losses in dampers, leak and check valve", "dynamics", kind_loss, "damping"), &
      torque_row_t("bearings", "torque for the camshaft bearings", "cam_bearings", kind_loss, "cam bearings"), &
      torque_row_t("tip", "torque for friction at the valve's tip", "valve_tip", kind_loss, "valve tip"), &
      torque_row_t("seal", "torque for the stem seal", "stem_seal", kind_loss, "stem seal"), &
      torque_row_t("guide_side", "torque for friction at the ends of the guide", "guide_side_load", kind_loss, "guide ends"), &
      torque_row_t("pivot", "torque for friction at the finger's pivot", "finger_pivot", kind_loss, "pivot"), &
      torque_row_t("needle_drag", "torque for the oil in the roller's bearing", "needle_drag", kind_loss, "needle drag"), &
      torque_row_t("shaft_drag", "torque for the seals and the drive of the camshaft", "shaft_drag", kind_loss, "seals, drive"), &
      torque_row_t("gas_damping", "torque for what dampers take from gas on a closed valve", "dynamics", kind_gas_loss, &
      & "gas damping"), &
      torque_row_t("residual", "drive power less losses less stored power", "torque", kind_residual, "")]

   !> Number of rows
   integer, parameter :: torque_count = size(torque_list)
   !> Name of the series of each row
   character(len=*), parameter :: torque_series(*) = [character(len=name_length) :: &
      & "torque_"//torque_list(:torque_count - 1)%name(:name_length - 7), "energy_residual"]
   !> Which rows are losses, and which are torques
   logical, parameter :: is_loss(torque_count) = torque_list%kind == kind_loss, &
      & is_torque(torque_count) = torque_list%kind /= kind_residual

contains

   !> Torque for all losses.
   pure function sum_of_losses(values) result(total)
      !> Value of each row [N m]
      real(wp), intent(in) :: values(torque_count)
      !> The sum [N m]
      real(wp) :: total

      integer :: i
      ! Places of the losses
      integer, parameter :: losses(*) = pack([(i, i=1, torque_count)], is_loss)

      total = sum(values(losses))
   end function sum_of_losses

   !> Torque that drives the camshaft.
   pure function sum_of_torques(values) result(total)
      !> Value of each row [N m]
      real(wp), intent(in) :: values(torque_count)
      !> The sum [N m]
      real(wp) :: total

      integer :: i
      ! Places of the torques
      integer, parameter :: torques(*) = pack([(i, i=1, torque_count)], is_torque)

      total = sum(values(torques))
   end function sum_of_torques

end module camroller_torque_list
