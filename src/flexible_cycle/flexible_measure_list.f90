!> The list of what a turn of a flexible train is judged by.
!>
!> In: nothing. Out: a number for each measure, by which its value stands in a list of them; its name, unit and meaning.
module camroller_flexible_measure_list
   use camroller_kinds, only : wp
   use camroller_flexible_parts, only : damper_count
   use camroller_names, only : name_length
   implicit none
   private

   public :: measures, measure_count, largest_load, largest_load_angle, smallest_event_load, event_pivot_force, &
      & least_lift_error, seating_speed, bounce_height, bounces, losses_of_contact, drive_torque, loss_torque, &
      & damping_torque, smallest_pivot_force, tension_share, surge_force, coil_ratio, coil_compression, lowest_plunger, &
      & highest_plunger, largest_chamber_pressure, leak_volume, check_share, residual_work, gallery_torque, &
      & event_check_share, damper_works, lift_at_nose, speed_at_nose, smallest_lift, closed_load, extremes, smallest, &
      & most_lift_error, float_share, seated_share, event_part, event_words

   !> A measure: its name, unit and meaning
   type :: measure_t
      character(len=name_length) :: name
      character(len=12) :: unit
      character(len=100) :: meaning
   end type measure_t

   !> Places in the list
   integer, parameter :: largest_load = 1, largest_load_angle = 2, smallest_event_load = 3, least_lift_error = 4, &
      & most_lift_error = 5, seating_speed = 6, bounce_height = 7, bounces = 8, float_share = 9, losses_of_contact = 10, &
      & drive_torque = 11, loss_torque = 12, damping_torque = 13, smallest_pivot_force = 14, tension_share = 15, &
      & surge_force = 16, coil_ratio = 17, event_pivot_force = 18, lift_at_nose = 19, speed_at_nose = 20, smallest_lift = 25, &
      & seated_share = 26, closed_load = 27, coil_compression = 28, residual_work = 29, lowest_plunger = 30, highest_plunger = 31, &
      & largest_chamber_pressure = 32, leak_volume = 33, check_share = 34, gallery_torque = 35, event_check_share = 36
   !> Places of the energies lost in the dampers, in the order of `powers_t`; the last four are of the adjuster
   integer, parameter :: damper_works(damper_count) = [21, 22, 23, 24, 37, 38, 39, 40]

   !> The measures; those of the adjuster last
   type(measure_t), parameter :: measures(*) = [ &
      & measure_t("dynamic_load_max", "N", "largest contact load"), &
      & measure_t("dynamic_load_max_angle", "rad", "cam angle of the largest contact load; full lift is at 180 deg"), &
      & measure_t("dynamic_load_min", "N", "smallest contact load with the valve in the upper three quarters of its lift"), &
      & measure_t("lift_error_min", "m", "smallest lift less that of a rigid train"), &
      & measure_t("lift_error_max", "m", "largest lift less that of a rigid train"), &
      & measure_t("seating_speed", "m s-1", "largest speed at which the valve meets its seat; 0 where it does not close"), &
      & measure_t("bounce_height", "m", "largest lift after the valve has first met its seat"), &
      & measure_t("bounces", "1", "times that the valve leaves its seat after it has first met it"), &
      & measure_t("float_share", "1", "part of the cycle with the rigid train in its event and no load between cam and roller"), &
      & measure_t("losses_of_contact", "1", "times that cam and roller part"), &
      & measure_t("dynamic_torque", "N m", "mean torque of cam and follower"), &
      & measure_t("dynamic_loss_torque", "N m", "mean torque of all losses of cam and follower, but those that the gas pays"), &
      & measure_t("damping_torque", "N m", "mean torque of the losses in dampers, leak and check valve, but those that the "// &
      & "gas pays"), &
      & measure_t("joint_force_min", "N", "smallest force in the joint of finger and pivot; negative: the socket would open"), &
      & measure_t("joint_tension_share", "1", "part of the cycle with tension in that joint"), &
      & measure_t("surge_force", "N", "largest force of the spring's first mode"), &
      & measure_t("coil_ratio", "1", "largest part of the spring's compression that waves take from coils; at 1 none is left"), &
      & measure_t("joint_force_min_event", "N", "smallest force in that joint in the upper three quarters of the lift"), &
      & measure_t("valve_lift_at_nose", "m", "lift at the cam angle of full lift"), &
      & measure_t("valve_velocity_at_nose", "m s-1", "speed of the valve at the cam angle of full lift"), &
      & measure_t("damping_work_cam", "J", "energy lost per turn in the damping of cam and roller"), &
      & measure_t("damping_work_pad", "J", "energy lost per turn in the damping of the pad at the valve"), &
      & measure_t("damping_work_seat", "J", "energy lost per turn in the damping of the valve seat"), &
      & measure_t("damping_work_spring", "J", "energy lost per turn in the damping of the spring's modes"), &
      & measure_t("least_valve_lift", "m", "smallest lift of the turn; above 0 where the valve does not close"), &
      & measure_t("seated_share", "1", "part of the cycle with the valve on its seat"), &
      & measure_t("closed_load_max", "N", "largest contact load with the rigid train's valve closed"), &
      & measure_t("coil_compression_max", "m", "largest compression of a part of the spring from free length, as of all of it"), &
      & measure_t("energy_residual_work", "J", "drive less losses less stored energy over the turn, and gallery"), &
      & measure_t("plunger_lowest", "m", "lowest place of the plunger"), &
      & measure_t("plunger_highest", "m", "highest place of the plunger"), &
      & measure_t("chamber_pressure_max", "Pa", "largest pressure in the adjuster's chamber"), &
      & measure_t("leak_volume", "m3", "oil that leaks along the plunger in a turn"), &
      & measure_t("check_valve_share", "1", "part of the cycle with the check valve open"), &
      & measure_t("gallery_torque", "N m", "mean power from the oil gallery over the cam's speed"), &
      & measure_t("pump_up_share", "1", "part of the cycle with the check valve open and the plunger off its lower stop in the "// &
      & "event"), &
      & measure_t("damping_work_plunger", "J", "energy lost per turn in the oil film between plunger and bore"), &
      & measure_t("damping_work_stops", "J", "energy lost per turn in the damping of the plunger's stops"), &
      & measure_t("damping_work_leak", "J", "energy lost per turn by the oil that leaks along the plunger"), &
      & measure_t("damping_work_check_valve", "J", "energy lost per turn by the oil that passes the check valve")]
   !> How many there are without an adjuster, and with one
   integer, parameter :: measure_count(2) = [residual_work, size(measures)]
   !> Measures that are extremes, those of the adjuster last
   integer, parameter :: extremes(*) = [largest_load, smallest_event_load, least_lift_error, most_lift_error, bounce_height, &
      & smallest_pivot_force, surge_force, coil_ratio, event_pivot_force, smallest_lift, closed_load, coil_compression, &
      & lowest_plunger, highest_plunger, largest_chamber_pressure]
   !> Those of them that are smallest values
   integer, parameter :: smallest(*) = [smallest_event_load, least_lift_error, smallest_pivot_force, event_pivot_force, &
      & smallest_lift, lowest_plunger]
   !> Part of the largest lift above which a load counts as one of the event [-]
   real(wp), parameter :: event_part = 0.25_wp
   !> What is above it, in words
   character(len=*), parameter :: event_words = "upper 3/4 of the lift"

end module camroller_flexible_measure_list
