#!/usr/bin/env python3
"""Draw solved contacts: pressure, film and, with heat, its temperature across the contact; film and friction over the cycle
beside the closed formulas.

Usage: post/ehl.py FILE.h5 [RUN.h5] --output FIGURE.png [--map MAP.png] [--case N] [--angles 125 150 180 205]
       FILE.h5 comes from `camroller ehl`, or from `camroller run` where the deck has `&ehl profiles = .true.`;
       RUN.h5 from `camroller run` on the same cases: its sliding speed is drawn beside that of the solved contacts.
       A second lobe shape gets figures of its own, with `_second_lift` in their names.
"""

from __future__ import annotations

import argparse
import pathlib
import sys
import textwrap

import h5py
import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False})

from matplotlib.colors import LogNorm  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
import numpy  # noqa: E402

from command import script, save_figure  # noqa: E402
from layout import POINT  # noqa: E402
from read import ResultError, opened, text_of  # noqa: E402
from units import key_words, unit_words  # noqa: E402

DEGREE = "\N{DEGREE SIGN}"
MICRO = "\N{MICRO SIGN}"
REACH = 2.5  # half widths of the widest contact that are shown on both sides, at least
LOADED = 0.03  # pressure over the largest shown from which on a place is shown: nearly rigid contacts carry load far outside
HEIGHT = 3.0  # largest film of the figures over the largest central film of the profiles
USUAL = 98  # percentile of films: a contact that is lost or regained has a thick one for a moment
CHARACTERS = 10  # of a title in an inch
ANGLE = f"cam angle, full lift at 180{DEGREE} [{DEGREE}]"


def read(path: str, case: int) -> dict[str, dict]:
    """Lobe shapes by name, each with its quantities of one case; where there is no contact, or it is not solved, numbers are NaN."""
    lobes = {}
    with opened(path, "a file of solved contacts") as file:
        if "ehl" not in file:
            raise ResultError(f"{path}: no solved contacts in it")
        for name, group in (("", file["ehl"]), ("second_lift", file["ehl"].get("second_lift"))):
            if group is None:
                continue
            if not 0 <= case < group["load"].shape[0]:
                raise ResultError(f"{path}: there is no case {case}; it has 0 to {group['load'].shape[0] - 1}")
            data = {key: item[case] if item.ndim > 1 else item[:] for key, item in group.items() if isinstance(item, h5py.Dataset)}
            lost = ~(data["film_min"] > 0)
            unsolved = numpy.isnan(data["film_min"]) & numpy.isfinite(data["load"])
            for key, values in data.items():
                if values.shape[:1] == lost.shape and key not in ("angle", "load", "sliding_speed"):
                    values[lost] = numpy.nan
            lobes[name] = data | {"unsolved": unsolved}
    return lobes


def shown(values: numpy.ndarray) -> numpy.ndarray:
    """Numbers for a logarithmic axis."""
    sizes = numpy.abs(values)
    return numpy.where(sizes > 0, sizes, numpy.nan)


def nearest(angles: numpy.ndarray, angle: float) -> int:
    """Place of the angle next to one; 360 degrees are 0 [deg]."""
    return int(numpy.argmin(numpy.abs((angles - angle + 180.0) % 360.0 - 180.0)))


def reach_of(data: dict, angles) -> float:
    """Distance from the middle that is shown of some angles [um]."""
    rows = [nearest(data["angle"], angle) for angle in angles]
    place = numpy.abs(data["x"] * data["half_width"][rows, None])
    pressure = numpy.nan_to_num(data["pressure"][rows])
    loaded = pressure > LOADED * pressure.max()
    return 1e6 * max(REACH * numpy.nanmax(data["half_width"]), 1.1 * place.max(where=loaded, initial=0.0))


def mean_over_dry_contact(place: numpy.ndarray, profiles: numpy.ndarray) -> numpy.ndarray:
    """Mean of each profile from -1 to 1 half widths, where nodes need not be: by trapezoids, as profiles are drawn."""
    nodes = numpy.concatenate(([-1.0], place[numpy.abs(place) < 1], [1.0]))
    return numpy.trapezoid([numpy.interp(nodes, place, profile) for profile in profiles], nodes, axis=1) / 2


def profiles(pressure, film, data: dict, angles: list[float]) -> None:
    """Pressure and film across the contact at some angles."""
    top = 0.0
    for number, angle in enumerate(angles):
        i = nearest(data["angle"], angle)
        lack = ", not solved" if data["unsolved"][i] else ", no contact"
        label = f"{data['angle'][i]:.0f}{DEGREE}" + ("" if data["film_min"][i] > 0 else lack)
        place = 1e6 * data["x"] * data["half_width"][i]
        pressure.plot(place, data["pressure"][i] / 1e6, color=f"C{number}", label=label)
        film.plot(place, 1e6 * data["film"][i], color=f"C{number}", label=label)
        top = numpy.nanmax([top, HEIGHT * 1e6 * data["film_central"][i]])
    reach = reach_of(data, angles)
    pressure.set(ylabel="pressure [MPa]", xlim=(-reach, reach))
    pressure.set_ylim(bottom=0)
    film.set(ylabel=f"film [{MICRO}m]", xlabel=f"place across the contact, inlet on the left [{MICRO}m]", xlim=(-reach, reach),
             ylim=(0, top or None))
    pressure.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)


def temperatures(across, turning, data: dict, angles: list[float]) -> None:
    """Rise of the film's temperature across the contact at some angles, and its largest over the cycle."""
    for number, angle in enumerate(angles):
        i = nearest(data["angle"], angle)
        across.plot(1e6 * data["x"] * data["half_width"][i], data["film_rise"][i], color=f"C{number}")
    reach = reach_of(data, angles)
    across.set(ylabel="rise of the film's temperature [K]", xlim=(-reach, reach),
               xlabel=f"place across the contact, inlet on the left [{MICRO}m]")
    turning.plot(data["angle"], data["film_rise"].max(axis=1), "k", label="largest across the contact")
    turning.plot(data["angle"], mean_over_dry_contact(data["x"], data["film_rise"]), "k--", label="mean over the dry contact")
    turning.set(ylabel="rise of the film's temperature [K]", xlabel=ANGLE)


def draw(data: dict, run: dict | None, angles: list[float], title: str) -> Figure:
    """Profiles on the left, film and slip in the middle, friction on the right."""
    has_heat = "film_rise" in data
    figure = Figure(figsize=(14, 10.5 if has_heat else 7), layout="constrained")
    axes = figure.subplots(3 if has_heat else 2, 3)
    if has_heat:
        temperatures(axes[2, 0], axes[2, 1], data, angles)
        axes[2, 2].remove()
    profiles(axes[0, 0], axes[1, 0], data, angles)
    turn = data["angle"]
    for name, style, words in (("film_min", "-", "smallest"), ("film_central", "--", "central")):
        axes[0, 1].plot(turn, 1e6 * data[name], "k" + style, label=f"{words}, solved")
        axes[0, 1].plot(turn, 1e6 * data[name + "_formula"], "C3" + style, label=f"{words}, film law")
    usual = max(1e6 * numpy.nanpercentile(data[name], USUAL) for name in ("film_central", "film_central_formula"))
    axes[0, 1].set(ylabel=f"film [{MICRO}m]", ylim=(0, 1.2 * usual))
    # Profiles of a run have its sliding speed, and no torques
    is_own = "torque_drive" not in data
    axes[1, 1].plot(turn, shown(data["sliding_speed"]), "k", label="of the run" if is_own else "solved contact")
    if run and not is_own:
        axes[1, 1].plot(run["angle"], shown(run["sliding_speed"]), "C3", label="run with a film law")
    axes[1, 1].set(ylabel="sliding speed, its size [m/s]", xlabel=ANGLE, yscale="log")
    for axis, name, words in ((axes[0, 2], "rolling_resistance", "rolling resistance [N]"),
                              (axes[1, 2], "shear", "shear of the film, its size [N]")):
        axis.plot(turn, shown(data[name]), "k", label="integrated over the contact")
        axis.plot(turn, shown(data[name + "_formula"]), "C3", label="closed formula, same load and slip")
        axis.set(ylabel=words, yscale="log" if name == "shear" else "linear")
    axes[0, 2].set_ylim(bottom=0)
    axes[1, 2].set(xlabel=ANGLE)
    for axis in (axis for axis in axes[:, 1:].flat if axis in figure.axes):
        axis.set(xlim=(0, 360), xticks=range(0, 361, 60))
        handles, labels = axis.get_legend_handles_labels()
        axis.legend(handles, labels, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    for axis in figure.axes:
        axis.grid(alpha=0.3)
    figure.suptitle(textwrap.fill(title, int(CHARACTERS * figure.get_figwidth())), fontsize="medium")
    return figure


def draw_map(data: dict, title: str) -> Figure:
    """Pressure and film over cam angle and place."""
    figure = Figure(figsize=(11, 4.5), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    reach = REACH * 1e6 * numpy.nanmax(data["half_width"])
    place = numpy.linspace(-reach, reach, 401)
    pressure, film = (numpy.array([numpy.interp(place, 1e6 * width * data["x"], row) for width, row in
                                   zip(data["half_width"], data[name])]).T for name in ("pressure", "film"))
    limits = LogNorm(1e6 * numpy.nanmin(data["film_min"]), HEIGHT * 1e6 * numpy.nanpercentile(data["film_central"], USUAL))
    pictures = (panels[0].pcolormesh(data["angle"], place, pressure / 1e6, cmap="viridis", rasterized=True),
                panels[1].pcolormesh(data["angle"], place, 1e6 * film, cmap="cividis", rasterized=True, norm=limits))
    for panel, picture, words in zip(panels, pictures, ("pressure [MPa]", f"film [{MICRO}m]")):
        figure.colorbar(picture, ax=panel, label=words, extend="max" if words.startswith("film") else "neither")
        panel.set(xlabel=ANGLE, xlim=(0, 360), xticks=range(0, 361, 60))
    panels[0].set_ylabel(f"place across the contact, inlet below [{MICRO}m]")
    figure.suptitle(textwrap.fill(title, int(CHARACTERS * figure.get_figwidth())), fontsize="medium")
    return figure


def read_point(path: str, case: int) -> str:
    """Speed and oil temperature, and what a sweep varies, with their values in one case."""
    with opened(path) as file:
        swept, values = file.get("sweep", {}), file.get("deck/values", {})
        words = []
        for key in (*(key for key in POINT if key in swept or key in values), *(key for key in swept if key not in POINT)):
            data = swept[key] if key in swept else values[key]
            value = data[case] if data.ndim else data[()]
            unit = text_of(data.attrs.get("units", "1"))
            shown = f"{value:.6g}" if data.dtype.kind == "f" else text_of(value)
            words.append(f"{key_words(key, unit)} {shown}" + ("" if unit == "1" else f" {unit_words(unit)}"))
        return ", ".join(words)


def read_title(path: str) -> str:
    """Title of the deck; empty where it gives none."""
    with opened(path) as file:
        return text_of(file["deck/values/case.title"][()]).strip(" '\"") if "deck/values/case.title" in file else ""


def has_second(path: str) -> bool:
    """Is there a second lobe shape in the file, or in the run that it is of?"""
    with opened(path) as file:
        return "second_lift" in file.get("ehl", {}) or any(name.startswith("lobe_2_") for name in file.get("series", {}))


def read_run(path: str, case: int) -> dict:
    """Cam angle and sliding speed of a run."""
    with opened(path, "a result of a run with series") as file:
        cases = file["series/sliding_speed"].shape[0]
        if case >= cases:
            raise ResultError(f"{path}: there is no case {case}; it has 0 to {cases - 1}")
        return {"angle": file["series/cam_angle"][:], "sliding_speed": file["series/sliding_speed"][case]}


def angle_of_a_turn(text: str) -> float:
    """Type of an option that takes a cam angle."""
    try:
        angle = float(text)
    except ValueError:
        angle = numpy.nan
    if not 0.0 <= angle <= 360.0:
        raise argparse.ArgumentTypeError(f"'{text}' is not an angle of one turn, 0 to 360 degrees")
    return angle


@script
def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="ehl.py", description="draw solved contacts over the cycle")
    parser.add_argument("file")
    parser.add_argument("run", nargs="?")
    parser.add_argument("--output", required=True)
    parser.add_argument("--map", help="a second figure: pressure and film over cam angle and place")
    parser.add_argument("--case", type=int, default=0)
    parser.add_argument("--angles", type=angle_of_a_turn, nargs="+", default=[90.0, 125.0, 150.0, 180.0, 205.0],
                        help="cam angles of the profiles, 0 to 360 degrees")
    options = parser.parse_args(arguments)
    lobes = read(options.file, options.case)
    point = read_point(options.file, options.case)
    run_beside = read_run(options.run, options.case) if options.run else None
    if options.run and read_point(options.run, options.case) != point:
        raise ResultError(f"case {options.case} is of {point or 'no known point'} in {options.file}, and of "
                          f"{read_point(options.run, options.case) or 'no known point'} in {options.run}")
    for name, data in lobes.items():
        if numpy.isnan(data["load"]).all():
            raise ResultError(f"case {options.case} has no solved contacts")
        lobe = "second lobe shape" if name else "first lobe shape" if has_second(options.file) else ""
        title = ", ".join(filter(None, [read_title(options.file), f"case {options.case}", point, lobe]))
        for target, make in ((options.output, lambda: draw(data, None if name else run_beside, options.angles, title)),
                             (options.map, lambda: draw_map(data, title))):
            if target:
                path = pathlib.Path(target)
                save_figure(made(make, options.file), path.with_stem(path.stem + ("_" + name if name else "")), dpi=90)
    return 0


def made(make, path: str) -> Figure:
    """A figure; ResultError where quantities are missing, or of lengths that do not fit."""
    try:
        return make()
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise ResultError(f"{path}: not solved contacts that can be drawn: {error}") from None


if __name__ == "__main__":
    sys.exit(main())
