!> Everything public, under one name: no code.
!>
!> A program that links the library needs this module alone: a deck or the components of a case, `run_case`, and the series and
!> scalars of the result by name; or `start_simulation` and `advance` to drive a follower from outside, angle by angle; or
!> `run_sweep` for all cases of a deck into one file, `sweep_cases` to have them handed over to an extension of `sink_t`. Where
!> cases have a numerical film, it calls `use_one_blas_thread` first, or its last digits depend on how many threads OpenBLAS takes.
module camroller ! style: private because it gives on all that it uses
   use camroller_core
   use camroller_case_loop, only : sweep_cases
   use camroller_case_record, only : case_outcome_t
   use camroller_case_sink, only : sink_t
   use camroller_layout, only : layout_t
   use camroller_monitor, only : monitor_t
   use camroller_sweep, only : run_sweep
   use camroller_sweep_file, only : sweep_made, sweep_options_t, sweep_report_t, sweep_shard_done, sweep_unfinished, &
      & sweep_was_complete
   implicit none
   public

end module camroller
