"""The style check finds what it is there to find, and nothing in good code."""

import pytest
from check_style import main

GOOD = """\
!> A sentence.
module camroller_sample
   use camroller_kinds, only : wp
   implicit none
   private

   public :: half

   !> Not a real number: print, stop
   character(len=*), parameter :: words = "print *, stop [m] use camroller_deck"

contains

   !> Half of a length.
   pure function half(length) result(answer)
      !> A length [m]
      real(wp), intent(in) :: length
      !> Half of it [m]
      real(wp) :: answer

      real(wp) :: stop_length ! [m]

      stop_length = length
      answer = 0.5_wp*stop_length
   end function half

end module camroller_sample
"""


def faults(root, capsys, text, path="src/base/sample.f90"):
    """Names of the broken rules in one file."""
    target = root / path
    target.parent.mkdir(parents=True)
    target.write_text(text, encoding="utf-8")
    code = main(["--root", str(root)])
    lines = capsys.readouterr().err.splitlines()
    assert code == (1 if lines else 0)
    return [line[line.rindex("[") + 1:-1] for line in lines]


def test_good_code_passes(tmp_path, capsys):
    assert faults(tmp_path, capsys, GOOD) == []


@pytest.mark.parametrize(("comment", "name", "is_fault"), [
    ("The sample", "sample", True), ("Its samples", "sample", True), ("The sample", "where", True),
    ("The sample, from 1", "sample", False), ("Where it begins", "sample", False), ("Sample [m]", "where", False)])
def test_comments_on_arguments_say_more_than_their_declaration(tmp_path, capsys, comment, name, is_fault):
    """Of private procedures; what is public has its docstring."""
    for place, inner in enumerate(("public", "private")):
        procedure = f"""   subroutine {'half' if inner == 'public' else 'inner'}({name})
      !> {comment}
      type(sample_t), intent(in) :: {name}
   end subroutine

end module"""
        text = GOOD.replace("   pure function half", "   pure function whole").replace("   end function half", "   end function whole")
        text = text.replace("end module", procedure).replace("real(wp) :: stop_length ! [m]\n\n      stop_length", "real(wp) :: other ! [m]\n\n      other")
        found = faults(tmp_path / str(place), capsys, text.replace("0.5_wp*stop_length", "0.5_wp*other"))
        assert found == (["echo"] if is_fault and inner == "private" else [])


@pytest.mark.parametrize(("old", "new", "rule"), [
    (", only : wp", ", only : wp, pi", "import"),
    (", only : wp", ", only : wp, circle => pi", "import"),
    ("   private\n", "", "private"),
    ("! [m]", "! m", "unit"),
    ("Half of it [m]", "Half of it", "unit"),
    ("      !> Half of it [m]\n      real(wp) :: answer", "      !> Half of it\n      character(len=:), allocatable :: answer", "text"),
    ("      answer =", "      print *, length\n      answer =", "print"),
    ("      answer =", "      if (length < 0) write (*, *) length\n      answer =", "print"),
    ("      answer =", "      write (output_unit, '(a)') words\n      answer =", "output"),
    ("module camroller_sample", "module camroller_sample\n   use, intrinsic :: iso_fortran_env, only : error_unit", "output"),
    ("      answer =", "      error stop 1\n      answer =", "stop"),
    ("      answer =", "      if (length < 0) stop\n      answer =", "stop"),
    ("      answer =", "      write (buffer, '(f0.1)') length\n      answer =", "write"),
    ("      answer =", "      if (length < 0) write (line(20:), *) length\n      answer =", "write"),
    ("      answer =", "      write (unit=self%text, fmt=*) length\n      answer =", "write"),
    ("camroller_sample", "camroller_simple", "name"),
    ("      answer =", "      stop_length = length\n"*60 + "      answer =", "procedure"),
    ("!> A sentence.\n", "!> A sentence.\n"*500, "length"),
    ("!> A sentence.\n", "module camroller_second\nend module\n", "module"),
])
def test_each_rule_finds_its_violation(tmp_path, capsys, old, new, rule):
    assert old in GOOD
    assert rule in faults(tmp_path, capsys, GOOD.replace(old, new))


def test_a_rule_is_excused_with_a_reason(tmp_path, capsys):
    excused = "      ! style: unit because it is a number of the caller's\n      real(wp) :: answer"
    assert faults(tmp_path, capsys, GOOD.replace("      !> Half of it [m]\n      real(wp) :: answer", excused)) == []


def test_an_excuse_without_a_reason_does_not_count(tmp_path, capsys):
    unexcused = "      ! style: unit because\n      real(wp) :: answer"
    assert faults(tmp_path, capsys, GOOD.replace("      !> Half of it [m]\n      real(wp) :: answer", unexcused)) == ["unit"]


@pytest.mark.parametrize("names", ["wp, operator(+)", "wp, length => pi", "wp, &\n      & stop_length, &\n      & answer", "wp, kind_8"])
def test_names_that_are_used_may_be_imported(tmp_path, capsys, names):
    text = GOOD.replace("only : wp", f"only : {names}").replace("0.5_wp*", "0.5_wp*1_kind_8*")
    assert faults(tmp_path, capsys, text) == []


def test_a_module_that_is_public_gives_on_what_it_uses(tmp_path, capsys):
    text = GOOD.replace("only : wp", "only : wp, pi")
    assert faults(tmp_path, capsys, text) == ["import"]
    (tmp_path / "other").mkdir()
    assert faults(tmp_path / "other", capsys, text.replace("   private\n", "   public\n")) == ["private"]


def test_one_unit_comment_covers_consecutive_declarations(tmp_path, capsys):
    line = "      real(wp) :: stop_length ! [m]"
    assert line in GOOD
    pair = "      !> Both [m]\n      real(wp) :: a\n      real(wp) :: b\n"
    assert faults(tmp_path, capsys, GOOD.replace(line, pair)) == []
    apart = pair.replace("a\n", "a\n      integer :: i\n")
    (tmp_path / "other").mkdir()
    assert faults(tmp_path / "other", capsys, GOOD.replace(line, apart)) == ["unit"]


def test_stop_and_print_are_allowed_in_programs_only(tmp_path, capsys):
    text = "program main\n   implicit none\n   print *, 1\n   stop\nend program\n"
    assert faults(tmp_path, capsys, text, "app/main.f90") == ["print"]


def test_write_to_a_unit_is_allowed(tmp_path, capsys):
    lines = "".join(f"      write ({unit}, '(a)') words\n" for unit in ("unit", "self%unit", "unit=file_unit"))
    assert faults(tmp_path, capsys, GOOD.replace("      answer =", lines + "      answer =")) == []


def test_lines_of_inner_procedures_are_counted_separately(tmp_path, capsys):
    body = "         x = 1\n"*40
    inner = "".join(f"      subroutine s{i}()\n{body}      end subroutine s{i}\n" for i in range(3))
    text = f"module camroller_sample\n   implicit none\n   private\ncontains\n   subroutine s()\n   contains\n{inner}" \
           "   end subroutine s\nend module\n"
    assert faults(tmp_path, capsys, text) == []
