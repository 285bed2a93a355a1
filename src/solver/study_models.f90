!> What simpler models change and what time they save: variants of a case, each against the case that it simplifies.
!>
!> Layer: solver. In: a case. Out: rows of `study_table_t`. A variant that cannot be built is a row with a message.
!>
!> Simplifications that a closed energy balance excludes are made on the case with the source's bookkeeping, and compared with
!> that.
module camroller_study_models
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   use camroller_asperity, only : boundary_names
   use camroller_case, only : case_t, energy_names
   use camroller_dynamics, only : load_arm_names, seating_names
   use camroller_effect_list, only : effect_asperity, effect_guide, effect_needle, effect_rolling, has_effect, leave_out
   use camroller_film, only : film_law_names
   use camroller_result, only : quantity_t
   use camroller_roller, only : spin_names
   use camroller_study_errors, only : largest_deviation
   use camroller_study_probe, only : probe_t, run_probe, loss_count
   use camroller_study_table, only : study_table_t, word_length, new_table, add_row
   use camroller_traction, only : cap_names, rolling_law_names
   implicit none
   private

   public :: variant_count, variant_names, make_variant, new_model_table, study_models

   !> Variants, the case itself first; film laws other than the case's come after these
   character(len=*), parameter :: plain_variants(*) = [character(len=name_length) :: "as given", "no asperities", &
      & "no rolling resistance", "other rolling law", "rolling not in balance", "sharp cap", "no needle friction", &
      & "no valve guide", "source", "source: thesis spin", "source: parallel arm", "source: full boundary", &
      & "source: maximum load", "source: all of these"]
   !> Position of the case in the source's bookkeeping
   integer, parameter :: source_variant = 9
   !> All variants
   character(len=name_length), parameter :: variant_names(*) = [plain_variants, film_law_names]
   !> Their number
   integer, parameter :: variant_count = size(variant_names)

contains

   !> A variant of a case.
   pure subroutine make_variant(case, number, variant, base, is_different)
      !> The case
      type(case_t), intent(in) :: case
      !> Position in `variant_names`
      integer, intent(in) :: number
      !> The variant
      type(case_t), intent(out) :: variant
      !> Position of the variant that it is compared with
      integer, intent(out) :: base
      !> Does it differ from that one?
      logical, intent(out) :: is_different

      base = 1
      is_different = .true.
      variant = case
      if (number > size(plain_variants)) then
         variant%film%law = film_law_names(number - size(plain_variants))
         is_different = variant%film%law /= case%film%law .or. allocated(case%ehl)
         if (allocated(variant%ehl)) deallocate (variant%ehl)
         return
      end if
      if (number >= source_variant) then
         is_different = number > source_variant .or. case%energy /= energy_names(2)
         variant%energy = energy_names(2)
         if (number > source_variant) base = source_variant
         call simplify_as_source(variant, variant_names(number), is_different)
         return
      end if
      call simplify(variant, variant_names(number), is_different)
   end subroutine make_variant

   !> Leave an effect out, or take a simpler law.
   pure subroutine simplify(variant, name, is_different)
      !> In: the case; out: the variant
      type(case_t), intent(inout) :: variant
      !> Name of the variant
      character(len=*), intent(in) :: name
      !> Does it differ from the case?
      logical, intent(inout) :: is_different

      select case (name)
      case ("no asperities")
         call without(variant, effect_asperity, is_different)
      case ("no rolling resistance")
         call without(variant, effect_rolling, is_different)
      case ("other rolling law")
         is_different = variant%traction%rolling_law /= rolling_law_names(2)
         variant%traction%rolling_law = rolling_law_names(2)
      case ("rolling not in balance")
         is_different = variant%traction%in_roller_balance .and. variant%energy == energy_names(2)
         variant%traction%in_roller_balance = .false.
      case ("sharp cap")
         is_different = variant%traction%cap /= cap_names(2)
         variant%traction%cap = cap_names(2)
      case ("no needle friction")
         call without(variant, effect_needle, is_different)
      case ("no valve guide")
         call without(variant, effect_guide, is_different)
      end select
   end subroutine simplify

   !> Leave an effect out.
   pure subroutine without(variant, effect, is_different)
      !> In: the case; out: the variant
      type(case_t), intent(inout) :: variant
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> Did the case have it?
      logical, intent(out) :: is_different

      is_different = has_effect(variant, effect)
      call leave_out(variant, effect)
   end subroutine without

   !> Simplify as the source does.
   pure subroutine simplify_as_source(variant, name, is_different)
      !> In: the case with the source's bookkeeping; out: the variant
      type(case_t), intent(inout) :: variant
      !> Name of the variant
      character(len=*), intent(in) :: name
      !> Does it differ from the case with the source's bookkeeping?
      logical, intent(inout) :: is_different

      logical :: all_of_them, was_source(4)

      all_of_them = name == "source: all of these"
      was_source = [variant%roller%spin == spin_names(2), variant%spring%load_arm == load_arm_names(2), .true., &
         & variant%spring%seating == seating_names(2)]
      if (allocated(variant%asperity)) was_source(3) = variant%asperity%boundary == boundary_names(2)
      if (name == "source: thesis spin" .or. all_of_them) variant%roller%spin = spin_names(2)
      if (name == "source: parallel arm" .or. all_of_them) variant%spring%load_arm = load_arm_names(2)
      if (name == "source: maximum load" .or. all_of_them) variant%spring%seating = seating_names(2)
      if (allocated(variant%asperity) .and. (name == "source: full boundary" .or. all_of_them)) then
         variant%asperity%boundary = boundary_names(2)
      end if
      select case (name)
      case ("source: thesis spin")
         is_different = .not. was_source(1)
      case ("source: parallel arm")
         is_different = .not. was_source(2)
      case ("source: full boundary")
         is_different = .not. was_source(3)
      case ("source: maximum load")
         is_different = .not. was_source(4)
      case ("source: all of these")
         is_different = .not. all(was_source)
      end select
   end subroutine simplify_as_source

   !> Table of models, one row a variant.
   subroutine new_model_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call new_table(table, [quantity_t("model", "", "what is simplified", "study"), &
         & quantity_t("base", "", "model that it is compared with", "study"), &
         & quantity_t("message", "", "what went wrong, or nothing", "study")], [ &
         & quantity_t("case", "1", "case of the sweep", "study"), &
         & quantity_t("status", "1", "0, or the kind of the error", "study"), &
         & quantity_t("mean_torque_friction", "N m", "mean torque for all losses", "torque"), &
         & quantity_t("revolution_slip", "1", "part of its turns that the roller loses per cam revolution", "roller"), &
         & quantity_t("min_film_thickness", "m", "smallest film", "film"), &
         & quantity_t("change_torque_friction", "1", "change of the mean torque for all losses over the base's", "study"), &
         & quantity_t("change_slip", "1", "change of the slip per revolution over the base's", "study"), &
         & quantity_t("change_film_min", "1", "change of the smallest film over the base's", "study"), &
         & quantity_t("change_sliding_speed", "1", "largest change of the sliding speed over the base's largest value", "study"), &
         & quantity_t("evaluations", "1", "evaluations of the roller equation", "study"), &
         & quantity_t("time", "s", "median time for the periodic cycle and its sliding speeds", "study"), &
         & quantity_t("time_saved", "1", "part of the base's time that it saves", "study")])
   end subroutine new_model_table

   !> Every variant of a case, integrated alike.
   subroutine study_models(table, position, case, repeats)
      !> Table of models
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Runs whose median time counts
      integer, intent(in) :: repeats

      type(case_t) :: variant
      type(probe_t) :: probe, bases(2)
      integer :: number, base
      logical :: is_different

      do number = 1, variant_count
         call make_variant(case, number, variant, base, is_different)
         if (.not. is_different .and. number /= source_variant) cycle
         call run_probe(variant, repeats, probe)
         if (number == 1) bases(1) = probe
         if (number == source_variant) bases(2) = probe
         if (is_different) call add_variant(table, position, number, base, bases(merge(2, 1, base == source_variant)), probe)
      end do
   end subroutine study_models

   !> Row of a variant.
   subroutine add_variant(table, position, number, base_number, base, probe)
      !> Table of models
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> Positions of variant and base in `variant_names`
      integer, intent(in) :: number, base_number
      !> What came of base and variant
      type(probe_t), intent(in) :: base, probe

      character(len=word_length) :: words(3)
      ! Numbers of the row [unit of the column]
      real(wp) :: numbers(12)

      words(1) = variant_names(number)
      words(2) = variant_names(base_number)
      words(3) = probe%message
      numbers = ieee_value(1.0_wp, ieee_quiet_nan)
      numbers(1:2) = [real(position - 1, wp), real(probe%status, wp)]
      if (probe%status == 0) then
         numbers(3:5) = [probe%losses(loss_count), probe%revolution_slip, probe%film_min]
         numbers(10:11) = [real(probe%counters%evaluations, wp), probe%time]
         if (base%status == 0) then
            numbers(6:9) = [change(probe%losses(loss_count), base%losses(loss_count)), &
               & change(probe%revolution_slip, base%revolution_slip), change(probe%film_min, base%film_min), &
               & largest_deviation(probe%sliding_speed, base%sliding_speed)]
            numbers(12) = 1.0_wp - probe%time/max(base%time, tiny(1.0_wp))
         end if
      end if
      call add_row(table, words, numbers)
   end subroutine add_variant

   !> Relative change with its sign.
   pure function change(value, base) result(relative)
      !> Value and what it is compared with [any]
      real(wp), intent(in) :: value, base
      !> Change over the size of the base [-]
      real(wp) :: relative

      relative = (value - base)/max(abs(base), tiny(1.0_wp))
   end function change

end module camroller_study_models
