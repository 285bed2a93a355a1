!> Machine, compiler and flags, as comment lines at the head of a table.
module bench_circumstances
   use, intrinsic :: iso_fortran_env, only : output_unit, compiler_version, compiler_options
   use camroller_version, only : version_text, build_commit
   implicit none
   private

   public :: print_circumstances

contains

   !> Print them.
   subroutine print_circumstances(title)
      !> What the table holds
      character(len=*), intent(in) :: title

      write (output_unit, "(2a)") "# ", title
      write (output_unit, "(4a)") "# program:  camroller ", version_text, ", commit ", build_commit
      write (output_unit, "(2a)") "# machine:  one core of ", machine()
      write (output_unit, "(2a)") "# compiler: ", compiler_version()
      write (output_unit, "(2a)") "# flags:    ", flags()
   end subroutine print_circumstances

   !> Class of machine, as Linux names the processor.
   function machine() result(name)
      !> Name
      character(len=:), allocatable :: name

      character(len=200) :: line
      integer :: unit, status

      name = "an unknown processor"
      open (newunit=unit, file="/proc/cpuinfo", action="read", status="old", iostat=status)
      if (status /= 0) return
      do
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (index(line, "model name") /= 1) cycle
         name = trim(adjustl(line(index(line, ":") + 1:)))
         exit
      end do
      close (unit)
   end function machine

   !> Flags of the compiler that matter for speed: those that begin with -O, -f, -m or -s, without folders.
   function flags() result(text)
      !> Flags, one blank between them
      character(len=:), allocatable :: text

      character(len=:), allocatable :: rest, word
      integer :: blank

      text = ""
      rest = compiler_options()//" "
      do while (len(rest) > 0)
         blank = index(rest, " ")
         word = rest(:blank - 1)
         rest = rest(blank + 1:)
         if (len(word) < 2 .or. index(word, "/") > 0) cycle
         if (word(1:1) /= "-" .or. scan(word(2:2), "Ofms") /= 1) cycle
         if (index(" "//text, " "//word//" ") == 0) text = text//word//" "
      end do
      text = trim(text)
   end function flags

end module bench_circumstances
