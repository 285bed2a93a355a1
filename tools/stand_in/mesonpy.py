"""Stand-in for a build backend, for downloading a source archive only.

`pip download` wants the metadata of what it downloads, and asks the archive's build backend for them; the real one configures
the whole project with a compiler first. setup.sh only wants the files in the archive, so this answers with the name and the
version from the archive's own PKG-INFO and builds nothing.
"""

import pathlib


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Copy PKG-INFO, where metadata of a source archive stand, to the place where pip looks for them."""
    text = pathlib.Path("PKG-INFO").read_text(encoding="utf-8")
    fields = dict(line.split(": ", 1) for line in text.split("\n\n")[0].splitlines() if ": " in line)
    folder = pathlib.Path(metadata_directory) / f"{fields['Name'].replace('-', '_')}-{fields['Version']}.dist-info"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "METADATA").write_text(text, encoding="utf-8")
    (folder / "WHEEL").write_text("Wheel-Version: 1.0\nRoot-Is-Purelib: false\nTag: py3-none-any\n", encoding="utf-8")
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Refuse: nothing can be built with a stand-in."""
    raise RuntimeError("a stand-in builds nothing")
