!> The table of commands in the forms that other programs read: a manual page, completion for shells.
!>
!> In: the table. Out: text.
module camroller_help_pages
   use camroller_command_table, only : command_t, exit_codes
   use camroller_version, only : version_text
   implicit none
   private

   public :: manual_page, bash_completion

   character(len=*), parameter :: n = new_line("a")
   !> Where files are expected: subjects and values that begin so
   character(len=*), parameter :: deck_subject = "DECK", file_word = "FILE", folder_word = "FOLDER"

contains

   !> Manual page, as `man` reads it.
   subroutine manual_page(commands, text)
      !> The commands
      type(command_t), intent(in) :: commands(:)
      !> The page
      character(len=:), allocatable, intent(out) :: text

      integer :: i, k

      text = '.TH CAMROLLER 1 "" "camroller '//version_text//'"'//n//".SH NAME"//n// &
         & "camroller \- friction, slip and drive torque of roller\-finger\-follower valve trains"//n//".SH SYNOPSIS"//n// &
         & ".B camroller"//n//".I command"//n//"[subject] [options]"//n//".SH COMMANDS"//n
      do i = 1, size(commands)
         associate (command => commands(i))
            text = text//".SS "//escaped(trim(trim(command%name)//" "//command%subject))//n//escaped(command%description)//n
            do k = 2, size(command%options)
               associate (option => command%options(k))
                  text = text//".TP"//n//".B "
                  if (option%short /= "") text = text//escaped(option%short)//", "
                  text = text//escaped(trim(trim(option%name)//" "//option%value))//n//escaped(option%meaning)//n
               end associate
            end do
         end associate
      end do
      text = text//".SH EXIT STATUS"//n//trim(exit_codes(1))//" "//trim(exit_codes(2))//" "//trim(exit_codes(3))
   end subroutine manual_page

   !> A text for a manual page: no line of it is taken for an instruction, and dashes stay dashes.
   pure function escaped(text) result(page)
      character(len=*), intent(in) :: text
      !> The same for `man`
      character(len=:), allocatable :: page

      integer :: i

      page = ""
      do i = 1, len(text)
         if (scan(text(i:i), ".'") == 1 .and. (i == 1 .or. index(n, text(max(i - 1, 1):max(i - 1, 1))) == 1)) page = page//"\&"
         select case (text(i:i))
         case ("\")
            page = page//"\e"
         case ("-")
            page = page//"\-"
         case default
            page = page//text(i:i)
         end select
      end do
   end function escaped

   !> Completion for bash: commands, options of a command, files.
   subroutine bash_completion(commands, text)
      !> The commands
      type(command_t), intent(in) :: commands(:)
      !> What bash reads
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: names, cases, options, with_file
      integer :: i, k

      names = ""
      cases = ""
      with_file = ""
      do i = 1, size(commands)
         names = names//" "//trim(commands(i)%name)
         options = ""
         do k = 1, size(commands(i)%options)
            associate (option => commands(i)%options(k))
               options = options//" "//trim(option%name)
               if (index(option%value, file_word) /= 1 .and. index(option%value, folder_word) /= 1) cycle
               if (index(with_file//"|", trim(option%name)//"|") > 0) cycle
               with_file = with_file//"|"//trim(option%name)
               if (option%short /= "") with_file = with_file//"|"//option%short
            end associate
         end do
         cases = cases//"    "//trim(commands(i)%name)//") options="""//options(2:)//""" subject="""
         if (index(commands(i)%subject, deck_subject) == 1 .or. index(commands(i)%subject, file_word) == 1) cases = cases//"file"
         if (commands(i)%name == "help") cases = cases//"command"
         cases = cases//""" ;;"//n
      end do
      text = "# Completion of camroller for bash, made by 'camroller help --completion'"//n//"_camroller() {"//n// &
         & "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options='' subject='' commands="""// &
         & names(2:)//""""//n//"  COMPREPLY=()"//n// &
         & "  if [ ""$COMP_CWORD"" = 1 ]; then COMPREPLY=($(compgen -W ""$commands"" -- ""$word"")); return; fi"//n// &
         & "  case ${COMP_WORDS[1]} in"//n//cases//"  esac"//n//"  case $before in"//n//"    "//with_file(2:)// &
         & ") compopt -o filenames; COMPREPLY=($(compgen -f -- ""$word"")); return ;;"//n//"  esac"//n// &
         & "  case $word in"//n//"    -*) COMPREPLY=($(compgen -W ""$options"" -- ""$word"")) ;;"//n// &
         & "    *) [ ""$subject"" = command ] && COMPREPLY=($(compgen -W ""$commands"" -- ""$word""))"//n// &
         & "      [ ""$subject"" = file ] && { compopt -o filenames; COMPREPLY=($(compgen -f -- ""$word"")); } ;;"//n// &
         & "  esac"//n//"}"//n//"complete -F _camroller camroller"
   end subroutine bash_completion

end module camroller_help_pages
