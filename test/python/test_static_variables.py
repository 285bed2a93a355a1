"""No code that threads run side by side keeps a variable between calls.

gfortran makes such variables without being asked, e.g. for the length of a text that a function returns; two threads that call
the function at once then get each other's length. The linked program lists them: every local object in a writable section,
by source file.
"""

from __future__ import annotations

import collections
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Folders that one thread at a time runs through: they write results and pages, with a library that is not made for threads.
ONE_THREAD = {"hdf5", "output", "parts", "batch", "look", "app"}
# What files are written by, beside them; the texts of signal handlers, set once; constants of the compiler's.
KNOWN = {
    "files/raw_file.f90": r"slen\.",
    "files/system_file.f90": r"slen\.",
    "files/new_file.f90": r"slen\.",
    "files/unfinished.f90": r"letters\.|lengths\.",
}
CONSTANTS = re.compile(r"jumptable\.|A\.\d|__vtab_|__def_init_|__camroller_.*_MOD___(?:vtab|def_init)_|options\.\d|print_warning\.|"
                       r"__camroller_phi_MOD_counter$")


def writable_objects(program: pathlib.Path) -> dict[str, list[str]]:
    """Local objects in writable sections, by name of the source file."""
    sections = subprocess.run(["readelf", "-SW", program], capture_output=True, text=True, check=True).stdout
    writable = {match[1] for match in re.finditer(r"\[\s*(\d+)\] \.(?:data|bss|tbss|tdata)\s", sections)}
    assert writable
    symbols = subprocess.run(["readelf", "-sW", program], capture_output=True, text=True, check=True).stdout
    found = collections.defaultdict(list)
    source = ""
    for line in symbols.splitlines():
        fields = line.split()
        if len(fields) < 8:
            continue
        kind, binding, section, name = fields[3], fields[4], fields[6], fields[7]
        if kind == "FILE":
            source = name
        elif kind == "OBJECT" and section in writable:
            found[source if binding == "LOCAL" else "global"].append(name)
    return found


def test_no_variable_is_kept_between_calls(camroller):
    folders = {path.name: f"{path.parent.name}/{path.name}" for top in ("src", "app") for path in (ROOT / top).rglob("*.f90")}
    found = writable_objects(pathlib.Path(camroller))
    assert "slen" in str(found), "the search finds none of the variables that are known to be there"
    faults = []
    for source, names in found.items():
        short = folders.get(pathlib.Path(source).name, "")
        if not short or short.split("/")[0] in ONE_THREAD:
            continue
        allowed = KNOWN.get(short)
        faults += [f"{short}: {name}" for name in names
                   if not CONSTANTS.match(name) and not (allowed and re.match(allowed, name))]
    ours = [name for name in found["global"] if name.startswith("__camroller_") and not CONSTANTS.match(name)
            and "_hdf5_" not in name]
    assert not faults + ours, "variables that outlive a call:\n" + "\n".join(sorted(set(faults + ours)))
