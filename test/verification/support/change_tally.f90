!> Changes of results by leaving effects out, compared with their estimates.
module change_tally
   use, intrinsic :: iso_fortran_env, only : output_unit
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_audit, only : new_audit_table, audit_case, judged
   use camroller_balance, only : least_slip
   use camroller_case, only : case_t, quantity_names, quantity_slip
   use camroller_effect_list, only : effect_names, effect_count
   use camroller_error, only : error_t
   use camroller_study_table, only : study_table_t, word_length, column_of, words_of
   implicit none
   private

   public :: tally_t, start_tally, audit, compare, print_tally

   !> What an accuracy leaves of a change, over the accuracy; and at least, of a mean torque: runs of one deck to 1e-9 and to
   !> 1e-10 differ by up to 9e-8 [-]
   real(wp), parameter :: rest_share = 3.0_wp, least_rest = 1.0e-7_wp
   !> Accuracy of runs that are accurate to a part of the slip that counts as none [-]
   real(wp), parameter :: high_accuracy = 1.0e-10_wp

   !> What came of many audits, by effect and quantity; the last row is everything that a case does not need, left out at once
   type :: tally_t
      character(len=:), allocatable :: misses
      !> Changes; those with an estimate; those whose estimate is small
      integer, dimension(effect_count + 1, size(quantity_names)) :: changes = 0, known = 0, small = 0
      !> Cases that took runs of high accuracy
      integer :: repeated = 0
      !> Changes over their estimates, in the order met [-]
      real(wp), allocatable :: ratios(:)
      !> Largest of them, by effect and quantity [-]
      real(wp) :: largest(effect_count + 1, size(quantity_names)) = 0.0_wp
   end type tally_t

contains

   !> Audit a case once.
   subroutine audit(case, run_accuracy, table)
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: run_accuracy
      type(study_table_t), intent(out) :: table
      type(case_t) :: precise
      type(error_t), allocatable :: failure

      precise = case
      precise%numerics%accuracy = run_accuracy
      call new_audit_table(table)
      call audit_case(table, 1, precise, 1, .false., failure)
   end subroutine audit

   !> Nothing compared yet.
   subroutine start_tally(tally)
      type(tally_t), intent(out) :: tally

      tally%misses = ""
      allocate (tally%ratios(0))
   end subroutine start_tally

   !> Compare the changes of an audit with their estimates.
   subroutine compare(table, what, run_accuracy, tally)
      type(study_table_t), intent(in) :: table
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: run_accuracy
      type(tally_t), intent(inout) :: tally
      character(len=24) :: buffer
      ! What the runs leave of a change; change beyond that, over its estimate [-]
      real(wp) :: rest, ratio
      ! Changes, their estimates, slip with all effects [-]
      real(wp), dimension(table%rows, size(quantity_names)) :: changes, estimates
      real(wp) :: slip(table%rows)
      character(len=word_length), dimension(table%rows) :: effects, runs
      integer :: row, effect, k

      effects = words_of(table, "effect")
      runs = words_of(table, "run")
      slip = column_of(table, "slip")
      do k = 1, size(judged)
         changes(:, k) = column_of(table, "change_"//trim(judged(k)))
         estimates(:, k) = column_of(table, "estimate_"//trim(judged(k)))
      end do
      do row = 1, table%rows
         effect = findloc(effect_names, effects(row), 1)
         if (effect == 0) effect = effect_count + 1
         do k = 1, size(quantity_names)
            associate (change => changes(row, k), estimate => estimates(row, k))
               if (ieee_is_nan(change) .or. ieee_is_nan(estimate)) cycle
               tally%changes(effect, k) = tally%changes(effect, k) + 1
               if (estimate > 1.0e300_wp) cycle
               tally%known(effect, k) = tally%known(effect, k) + 1
               if (estimate < 1.0e-3_wp) tally%small(effect, k) = tally%small(effect, k) + 1
               rest = max(rest_share*run_accuracy, least_rest)
               ! Runs are accurate to a part of the slip that counts as none; what that hides is left to the more accurate ones
               if (k == quantity_slip .and. run_accuracy <= high_accuracy) rest = rest*max(1.0_wp, least_slip &
                  /max(abs(slip(1)), tiny(1.0_wp)**0.5_wp))
               ratio = max(abs(change) - rest, 0.0_wp)/max(estimate, tiny(1.0_wp)**0.5_wp)
               tally%ratios = [tally%ratios, ratio]
               tally%largest(effect, k) = max(tally%largest(effect, k), ratio)
               if (abs(change) <= estimate + rest) cycle
               write (buffer, "(2es12.3)") change, estimate
               tally%misses = tally%misses//new_line("a")//what//": "//trim(effects(row))//" "// &
                  trim(runs(row))//" "//trim(quantity_names(k))//buffer
            end associate
         end do
      end do
   end subroutine compare

   !> Print how far below their estimates the changes are.
   subroutine print_tally(tally, cases, seed)
      type(tally_t), intent(in) :: tally
      integer, intent(in) :: cases, seed
      ! Ratios that are counted [-]
      real(wp), parameter :: steps(*) = [0.0_wp, 0.05_wp, 0.1_wp, 0.15_wp, 0.2_wp, 0.25_wp, 0.3_wp, 0.5_wp, 1.0_wp]
      integer :: effect, k

      write (output_unit, "(i0, a, i0, a, i0)") cases, " cases, ", tally%repeated, &
         " of them run again with high accuracy, next seed ", seed
      write (output_unit, "(a20, a14, 3a9, a15)") "without", "quantity", "changes", "bounded", "small", "largest ratio"
      do effect = 1, effect_count
         call print_rows(trim(effect_names(effect)), effect)
      end do
      call print_rows("all left out", effect_count + 1)
      do k = 1, size(steps)
         write (output_unit, "(a, f5.2, a, i0)") "ratio above", steps(k), ": ", count(tally%ratios > steps(k))
      end do
      write (output_unit, "(a, i0)") "all ratios: ", size(tally%ratios)

   contains

      subroutine print_rows(name, row)
         character(len=*), intent(in) :: name
         integer, intent(in) :: row
         integer :: quantity

         do quantity = 1, size(quantity_names)
            if (tally%changes(row, quantity) == 0) cycle
            write (output_unit, "(a20, a14, 3i9, f15.3)") name, quantity_names(quantity), tally%changes(row, quantity), &
               tally%known(row, quantity), tally%small(row, quantity), tally%largest(row, quantity)
         end do
      end subroutine print_rows

   end subroutine print_tally

end module change_tally
