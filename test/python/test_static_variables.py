"""No code that threads run side by side keeps a variable between calls.

gfortran makes such variables without being asked, e.g. for the length of a text that a function returns; two threads that call
the function at once then get each other's length. The objects in the library beside the program list them: every object in a
writable section. Those of -flto hold machine code as well (-ffat-lto-objects), while the linked program no longer says whose a variable is.
"""

from __future__ import annotations

import collections
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Folders that one thread at a time runs through: they write results and pages, with a library that is not made for threads.
ONE_THREAD = {"hdf5", "output", "parts", "batch", "look"}
# What files are written by, beside them; the texts of signal handlers, set once; constants of the compiler's.
KNOWN = {
    "files/raw_file.f90": r"slen\.",
    "files/system_file.f90": r"slen\.",
    "files/new_file.f90": r"slen\.",
    "files/unfinished.f90": r"letters\.|lengths\.",
}
CONSTANTS = re.compile(r"jumptable\.|A\.\d|__vtab_|__def_init_|__camroller_.*_MOD___(?:vtab|def_init)_|options\.\d|print_warning\.|"
                       r"__camroller_phi_MOD_counter$")


def writable_objects(library: pathlib.Path) -> dict[str, list[str]]:
    """Objects in writable sections by name of the member of a library."""
    listed = subprocess.run(["readelf", "-SsW", library], capture_output=True, text=True, check=True).stdout
    found = collections.defaultdict(list)
    member, writable = "", set()
    for line in listed.splitlines():
        fields = line.split()
        if line.startswith("File: "):
            member, writable = line[line.rindex("(") + 1:-1], {"COM"}
        elif match := re.match(r"\s*\[\s*(\d+)\] \.(?:data|data\.rel|data\.rel\.local|bss|tbss|tdata)\s", line):
            writable.add(match[1])
        elif len(fields) >= 8 and fields[3] in ("OBJECT", "TLS") and fields[6] in writable:
            found[member].append(fields[7])
    return found


@pytest.mark.parametrize("options", [[], ["-flto", "-ffat-lto-objects"]])
@pytest.mark.parametrize("declaration", ["integer, save :: kept = 3", "integer, save :: kept", "integer, private :: kept = 3"])
def test_a_variable_that_is_kept_is_found(tmp_path, options, declaration):
    parts = ["", declaration] if "private" in declaration else [declaration, ""]
    (tmp_path / "a.f90").write_text("module a\n  implicit none\n  {1}\ncontains\n  subroutine count(n)\n    integer, intent(out) :: n\n"
                                    "    {0}\n    kept = kept + 1\n    n = kept\n  end subroutine\nend module\n".format(*parts))
    subprocess.run(["gfortran", "-O3", "-g1", *options, "-c", "a.f90", "-o", "a.f90.o"], cwd=tmp_path, check=True)
    subprocess.run(["gcc-ar", "rc", "a.a", "a.f90.o"], cwd=tmp_path, check=True)
    found = writable_objects(tmp_path / "a.a")
    assert list(found) == ["a.f90.o"] and "kept" in found["a.f90.o"][0]


def test_no_variable_is_kept_between_calls(camroller):
    library = pathlib.Path(camroller).resolve().parents[1] / "lib/libcamroller.a"
    assert library.is_file(), f"{library} is missing, which `make build` puts beside the program"
    members = {str(path.relative_to(ROOT)).replace("/", "_") + ".o": f"{path.parent.name}/{path.name}"
               for path in (ROOT / "src").rglob("*.f90")}
    found = {member: names for member, names in writable_objects(library).items() if not member.startswith("build_dependencies_")}
    assert "slen" in str(found), "the search finds none of the variables that are known to be there"
    assert set(found) <= set(members)
    faults = []
    for member, names in found.items():
        short = members[member]
        if short.split("/")[0] in ONE_THREAD:
            continue
        allowed = KNOWN.get(short)
        faults += [f"{short}: {name}" for name in names
                   if not CONSTANTS.match(name) and not (allowed and re.match(allowed, name))]
    assert not faults, "variables that outlive a call:\n" + "\n".join(sorted(set(faults)))
