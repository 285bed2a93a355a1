"""Tests of reading and drawing, on small made-up files in the layout that the solver writes."""

from pathlib import Path
import re
import subprocess
import sys

import h5py
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
import numpy as np
import pytest

import plot
import report
from figures import FIGURES, draw
from layout import Layout, chosen_cases, thin_out
from parts import closed, event_window, set_values_axis, suited
from plot import main
from quantities import CURVES, LARGEST_SHEAR, SOURCES, Missing, values_of
from read import ResultError, Series, _values, read_result
from table import COLUMNS

SPEED, OIL = "operating_point.speed_rpm", "operating_point.oil_temperature_degC"
UNITS = {SPEED: "rpm", OIL: "degC"}
HERE = Path(__file__).resolve().parent


SLICES = 11


def made_up_series(angle, speed, oil):
    """Curves with roughly the shapes and sizes of a roller valve train; no physics is claimed."""
    x = (angle - 180.0) / 70.0
    lift = np.where(np.abs(x) < 1, 9.5e-3 * np.clip(1 - x**2, 0, None) ** 4, 0.0)
    slope = np.gradient(lift, np.radians(angle))
    curvature = np.gradient(slope, np.radians(angle))
    omega, viscosity = speed * np.pi / 30, 0.15 * np.exp(-0.0395 * (oil - 25))
    load = 64 + np.where(lift > 0, 750 * lift / 9.5e-3 + 400 * np.clip(lift / 1e-4, 0, 1), 0) \
        + 0.1 * omega**2 * curvature
    load = np.clip(load, 5, None)
    entrainment = speed / 300 * (0.565 + 20 * np.abs(slope) - 0.35 * lift / 9.5e-3)
    film = 2.1e-7 * (viscosity / 0.01 * entrainment) ** 0.7 * (load / 64) ** -0.13
    share = np.exp(-film / 2e-7)
    slip = 1e-3 * speed / 300 * (viscosity / 0.01) ** 0.5 * (1 + 60 * slope) * 64 / load * 20
    rolling = 0.3 * (viscosity * entrainment / 0.0057) ** 0.65
    friction = 0.08 * load * np.tanh(np.abs(slip) * 30) + rolling
    geometric = load * slope * 1.2
    losses = {"contact": friction * 0.03 * np.abs(slip), "needle": 2e-5 * load,
              "guide": 1e-1 * viscosity * slope**2 * speed, "bearings": 2e-4 * viscosity * speed + 0 * angle}
    total = sum(losses.values())
    series = {"valve_lift": lift, "valve_velocity": slope * omega, "film_ratio": film / 2e-7, "asperity_load": 0.1 * share * load,
              "contact_load": load, "hertz_pressure": 2.1e7 * np.sqrt(load), "slip_ratio": slip,
              "sliding_speed": slip * entrainment, "cam_surface_speed": entrainment, "hertz_half_width": 2e-6 * np.sqrt(load),
              "entrainment_speed": entrainment, "film_thickness_min": film, "friction_rolling": rolling,
              "asperity_friction_share": share, "friction_contact": friction, "torque_geometric": geometric,
              "torque_friction": total, "torque_drive": geometric + total,
              "load_error": 20 * np.sin(x * speed / 10), "lift_error": -5e-8 * load,
              "axial_pressure_max": 2.5e7 * np.sqrt(load), "edge_pressure": 2e7 * np.sqrt(load),
              "cam_wear_depth": 1e-12 * load, "cam_film_thickness": 1e-10 * load, "boundary_coefficient": 0.1 + 1e-5 * load}
    for number in range(1, SLICES + 1):  # more load at the last slice than at the first
        series[f"line_load_{number}"] = load / 0.0137 * (1 + 0.2 * (2 * number - 1 - SLICES) / SLICES)
    return series | {f"torque_{name}": value for name, value in losses.items()}


def made_up_hours():
    """What surfaces go through in ten hours."""
    time = np.linspace(0.0, 36000.0, 41)
    grown = 1 - np.exp(-time / 9000)
    return {"time": time, "largest_cam_film": 9e-8 * grown, "mean_cam_film": 5e-8 * grown, "roller_film": 8e-8 * grown,
            "largest_cam_wear": 1e-16 * time, "mean_cam_wear": 5e-17 * time, "roller_wear": 4e-17 * time,
            "mean_boundary_coefficient": 0.2 - 1e-6 * time, "mean_friction_torque": 0.01 + 0 * time}


HOURS_UNITS = {"time": "s", "mean_boundary_coefficient": "1", "mean_friction_torque": "N m"}  # else m
# Energies lost in dampers [J] and turns of a train, for each case
LOST = {"damping_work_cam": 1e-3, "damping_work_seat": 5e-4, "damping_work_leak": 1e-4}
TURNS = {"valve_lift_at_nose": [9e-3, 9.002e-3, np.nan], "valve_velocity_at_nose": [0.1, -0.1, np.nan],
         "dynamic_load_max": [700.0, 800.0, np.nan], "seating_speed": [0.2, 0.3, np.nan]}
SERIES_UNITS = {"valve_lift": "m", "valve_velocity": "m/s", "film_ratio": "1", "asperity_load": "N",
                "contact_load": "N", "hertz_pressure": "Pa", "slip_ratio": "1", "sliding_speed": "m/s", "cam_surface_speed": "m/s", "hertz_half_width": "m",
                "entrainment_speed": "m/s", "film_thickness_min": "m", "friction_rolling": "N",
                "asperity_friction_share": "1", "friction_contact": "N", "load_error": "N", "lift_error": "m", "axial_pressure_max": "Pa",
                "edge_pressure": "Pa", "cam_wear_depth": "m", "cam_film_thickness": "m", "boundary_coefficient": "1",
                **{f"line_load_{number}": "N m-1" for number in range(1, SLICES + 1)}}


def test_wear_of_a_contact_is_archards(tmp_path):
    """By hand: 1000 N over 13.7 mm, half of it on asperities, sliding by 2 % of the speed over the cam, half width 50 um."""
    path = write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,))
    length, half, load = 13.7e-3, 50e-6, 1000.0
    steady = {"contact_load": load, "asperity_load": load / 2, "sliding_speed": -0.03, "cam_surface_speed": 1.5, "hertz_half_width": half,
              "hertz_pressure": 2 * load / (np.pi * half * length)}
    with h5py.File(path, "a") as file:
        for name, value in steady.items():
            file[f"series/{name}"][...] = value
    layout = Layout([read_result(path)])
    entry = layout.entries[0]
    # time of passage 2 b/V_c, distance in it, depth over the wear rate: mean pressure of the asperities times that distance
    passage = 2 * half / 1.5
    assert np.allclose(values_of(layout, entry, "sliding_distance", "um"), 1e6 * 0.03 * passage, rtol=1e-12)
    assert np.allclose(values_of(layout, entry, "wear_product", "N/m"), load / 2 / (2 * half * length) * 0.03 * passage, rtol=1e-12)


def test_the_largest_shear_below_a_line_contact_is_that_of_its_stresses(tmp_path):
    """Along the middle of a Hertzian line contact, depth z in half widths: McEwen (1949), Johnson (1985), equations 4.45."""
    depth = np.linspace(0.5, 1.2, 700001)
    root = np.sqrt(1 + depth**2)
    across, along = -((1 + 2 * depth**2) / root - 2 * depth), -1 / root
    shear = 0.5 * np.abs(along - across)
    assert abs(shear.max() - LARGEST_SHEAR) < 1e-6 and abs(depth[shear.argmax()] - 0.78615) < 1e-5
    layout = Layout([read_result(write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,)))])
    stress, peak = (values_of(layout, layout.entries[0], name, "MPa") for name in ("subsurface_shear_stress", "axial_pressure_max"))
    assert np.allclose(stress / peak, LARGEST_SHEAR)
    uniform = write_result(tmp_path / "uniform.h5", swept=(), speeds=(600.0,), oils=(60.0,), without=("axial_pressure_max",))
    layout = Layout([read_result(uniform)])
    stress, peak = (values_of(layout, layout.entries[0], name, "MPa") for name in ("subsurface_shear_stress", "hertz_pressure"))
    assert np.allclose(stress / peak, LARGEST_SHEAR)


@pytest.mark.parametrize("shaft, turns", [(None, 1.0), ("camshaft", 1.0), ("crankshaft", 2.0)])
def test_the_acceleration_of_a_rigid_train_is_at_the_speed_of_its_camshaft(tmp_path, shaft, turns):
    path = write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,))
    with h5py.File(path, "a") as file:
        file["series/valve_velocity"][...] = np.sin(np.radians(file["series/cam_angle"][:]))
        if shaft:
            file["deck/values/engine.given_speed"], file["summary/crank_turns"] = shaft, [2.0]
    layout = Layout([read_result(path)])
    values = values_of(layout, layout.entries[0], "valve_acceleration", "m/s2")
    assert values.max() == pytest.approx(600.0 * np.pi / 30 / turns, rel=2e-3)


def test_the_acceleration_of_a_flexible_train_is_that_of_its_file(tmp_path):
    path = write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,))
    with h5py.File(path, "a") as file:
        given = file.create_dataset("series/valve_acceleration", data=file["series/valve_velocity"][()] * 0.0 + 423.0)
        given.attrs["units"] = np.bytes_("m s-2")
    [axes] = draw("acceleration", Layout([read_result(path)])).axes
    assert axes.lines[0].get_ydata() == pytest.approx(423.0) and axes.get_ylabel() == "valve acceleration [m/s²]"


def given_by(path, shaft):
    """The file with an engine whose deck gives the speed of a shaft."""
    with h5py.File(path, "a") as file:
        file["deck/values/engine.given_speed"] = shaft
        file["summary/crank_turns"] = np.full(file["case"].size, 2.0)
    return path


def test_files_whose_speeds_are_of_different_shafts_say_so(tmp_path):
    engine, other = (write_result(tmp_path / f"{name}.h5", title=name, oils=(60.0,), swept=(SPEED,)) for name in ("engine", "rig"))
    layout = Layout([read_result(given_by(engine, "crankshaft")), read_result(other)])
    assert layout.titles == ["engine, speed of the crankshaft", "rig, speed of the camshaft"] and layout.short_names[SPEED] == "speed"
    layout = Layout([read_result(given_by(other, "crankshaft")), read_result(engine)])
    assert layout.titles == ["rig", "engine"] and layout.short_names[SPEED] == "crankshaft speed"


def test_curves_of_trains_without_a_period_are_of_one_turn_and_the_page_says_so(tmp_path):
    path = write_result(tmp_path / "two.h5", swept=(SPEED,), speeds=(300.0, 600.0), oils=(60.0,))
    with h5py.File(path, "a") as file:
        file["summary/period_cycles"] = [0.0, 0.0]
    words = "no period: curves are the last of 2 turns, means of all"
    for name in ("film", "drive_torque", "overview", "roller"):
        figure = draw(name, Layout([read_result(path)]))
        assert words in shown_title(figure.subfigs[0] if figure.subfigs else figure).replace("\n", " "), name
    for name in ("mean_torque", "turns"):
        assert "curves are" not in shown_title(draw(name, Layout([read_result(path)])))
    with h5py.File(path, "a") as file:
        file["summary/period_cycles"][...] = [1.0, 2.0]
    assert Layout([read_result(path)]).turn_words() == ["a period of several turns in 1 of 2 cases: curves are one of 2 turns, means of all"]
    with h5py.File(path, "a") as file:
        file["summary/period_cycles"][...] = [1.0, 1.0]
    assert not Layout([read_result(path)]).turn_words()
    with h5py.File(path, "a") as file:
        file["summary/lobe_2_period_cycles"] = [1.0, 0.0]
    assert Layout([read_result(path)]).turn_words() == ["no period in 1 of 2 cases: curves are the last of 2 turns, means of all"]


def test_turns_have_one_axis_in_all_panels(tmp_path):
    path = write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,))
    with h5py.File(path, "a") as file:
        file["turns/seating_speed"][:, 1] = np.nan
    panels = draw("turns", Layout([read_result(path)])).axes[:3]
    assert len({axes.get_xlim() for axes in panels}) == 1


def test_labels_of_many_bars_stand_at_even_distances_and_apart(tmp_path):
    speeds = tuple(500.0 + 100.0 * np.arange(41))
    path = write_result(tmp_path / "many.h5", speeds=speeds, oils=(60.0,), step=30.0, swept=(SPEED,))
    figure = draw("overview", Layout([read_result(path)]))
    figure.draw_without_rendering()
    for axes in figure.axes:
        if axes.get_xlabel() != "speed [rev/min]":
            continue
        boxes = [label.get_window_extent() for label in axes.get_xticklabels()]
        assert len(boxes) > 10 and len(set(np.diff(axes.get_xticks()))) == 1
        assert all(left.x1 < right.x0 for left, right in zip(boxes, boxes[1:]))


def test_bars_have_the_colours_of_the_curves_and_of_their_legend(tmp_path):
    results = [read_result(write_result(tmp_path / f"{name}.h5", title=name, swept=(), speeds=(600.0,), oils=(60.0,))) for name in "ab"]
    figure = draw("overview", Layout(results))
    curves = [to_hex(line.get_color()) for line in figure.subfigs[0].axes[0].lines if len(line.get_xdata()) > 2]
    slip = figure.subfigs[1].subfigs[0]
    assert curves == [to_hex(bar.get_facecolor()) for bar in slip.axes[0].patches]
    assert curves == [to_hex(handle.get_facecolor()) for handle in slip.legends[0].legend_handles]


@pytest.mark.parametrize("name", ["overview", "mean_torque"])
def test_a_long_legend_takes_no_height_from_the_bars(nine, name):
    """Of the friction of all sources that there are, as of a few of them."""
    heights = []
    for _ in range(2):
        figure = draw(name, Layout([read_result(nine)]))
        figure.draw_without_rendering()
        bars = next(axes for axes in figure.axes if axes.get_ylabel().startswith("mean friction"))
        heights.append(bars.get_window_extent().height / figure.dpi)
        with h5py.File(nine, "a") as file:
            for source, *_ in SOURCES:
                if source not in file["summary"]:
                    file[f"summary/{source}"] = np.full(9, 1e-3)
                    file[f"summary/{source}"].attrs["units"] = "N m"
    assert heights[1] > 0.9 * heights[0], heights


def test_surfaces_over_hours_are_those_of_the_file(tmp_path):
    path = write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,))
    columns = made_up_hours()
    panels = draw("running_in", Layout([read_result(path)])).axes
    assert [len(axes.lines) for axes in panels] == [3, 3, 1, 1]
    assert panels[0].get_ylabel() == "thickness of the tribofilm [nm]" and panels[0].lines[0].get_xdata()[-1] == pytest.approx(10.0)
    assert panels[0].lines[2].get_ydata() == pytest.approx(1e9 * columns["roller_film"])
    assert panels[1].get_ylabel() == "worn depth [pm]" and panels[1].lines[0].get_ydata()[-1] == pytest.approx(3.6)
    assert panels[3].lines[0].get_ydata() == pytest.approx(10.0 + 0 * columns["time"]) and panels[3].get_ylim()[1] > 10.2
    with h5py.File(path, "a") as file:
        del file["running_in"]
    with pytest.raises(Missing, match="running_in"):
        draw("running_in", Layout([read_result(path)]))


def test_worn_depths_have_the_unit_that_suits_them_and_a_logarithmic_axis_where_cases_differ_much(tmp_path):
    path = write_result(tmp_path / "two.h5", swept=(SPEED,), speeds=(300.0, 600.0), oils=(60.0,))
    for factor, unit, scale in ((1.0, "pm", "linear"), (20.0, "pm", "linear"), (99.0, "nm", "linear"), (101.0, "nm", "log"), (1e9, "mm", "log")):
        with h5py.File(path, "a") as file:
            for name in ("largest_cam_wear", "mean_cam_wear", "roller_wear"):
                file[f"running_in/{name}"][1] = factor * made_up_hours()[name]
            depth = file["series/cam_wear_depth"]
            depth[0] = 1e-15 * file["series/contact_load"][0]
            depth[0, :10] = 0.0  # contact is lost
            depth[1] = factor * depth[0].max() * np.linspace(0.0, 1.0, depth.shape[1])
        layout = Layout([read_result(path)])
        axes = draw("running_in", layout).axes[1]
        scales = {"pm": 1e12, "nm": 1e9, "mm": 1e3}
        assert axes.get_ylabel() == f"worn depth [{unit}]" and axes.get_yscale() == scale
        assert axes.lines[3].get_ydata()[-1] == pytest.approx(3.6e-12 * factor * scales[unit])
        assert scale == "linear" or 0.0 < axes.get_ylim()[0] < 3.6e-14 * scales[unit]
        axes = draw("wear_depth", layout).axes[0]
        top = max(line.get_ydata().max() for line in axes.lines if len(line.get_xdata()) > 2)
        assert axes.get_yscale() == scale and 0.1 <= top <= 1000.0 and axes.get_ylim()[1] > top
        assert top == pytest.approx(factor * depth_of(layout) * scales[axes.get_ylabel()[-3:-1]])


def depth_of(layout):
    """Largest depth worn away in the first case [m]."""
    return layout.results[0].series["cam_wear_depth"].values[0].max()


def test_load_along_the_roller_is_that_of_its_slices_in_their_order(tmp_path):
    layout = Layout([read_result(write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,)))])
    result = layout.results[0]
    [axes] = draw("roller", layout).axes
    assert axes.get_ylabel() == "load per length [N/mm]" and len(axes.lines) >= 3
    for line in axes.lines:
        at = list(result.cam_angle).index(float(line.get_label().rstrip("°")))
        places, loads = line.get_xdata(), line.get_ydata()
        assert places == pytest.approx((np.arange(SLICES) + 0.5) / SLICES - 0.5)
        # a straight line, whose mean is the load over the length
        assert np.diff(loads) == pytest.approx(0.4 / SLICES * loads.mean())
        assert loads.mean() == pytest.approx(result.series["contact_load"].values[0, at] / 13.7)
    path = write_result(tmp_path / "without.h5", without=[f"line_load_{number}" for number in range(1, SLICES + 1)])
    with pytest.raises(Missing, match="slice_series"):
        draw("roller", Layout([read_result(path)]))


def test_a_flexible_train_is_a_page_of_what_its_file_has(tmp_path):
    figure = draw("train", Layout([read_result(write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,)))]))
    labels = [axes.get_ylabel().split("\n")[0] for axes in figure.axes]
    assert labels == ["contact load", "load less rigid load", "lift less rigid lift", "valve's speed"]
    path = write_result(tmp_path / "rigid.h5", without=("load_error",))
    with pytest.raises(Missing, match="load_error"):
        draw("train", Layout([read_result(path)]))


def test_on_a_page_with_an_odd_number_of_curves_cam_angles_stand_below_each_other(tmp_path):
    path = write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,))
    assert len(draw("train", Layout([read_result(path)])).axes) == 4
    with h5py.File(path, "a") as file:
        del file["series/lift_error"]
    drawn = draw("train", Layout([read_result(path)])).axes
    spans = [axes.get_subplotspec().colspan for axes in drawn]
    assert [(span.start, span.stop) for span in spans] == [(0, 1), (1, 2), (0, 1)]
    assert [axes.xaxis.get_tick_params()["labelbottom"] for axes in drawn] == [False, True, True]


def test_energy_lost_by_damper_has_a_bar_for_each_number_of_the_file(tmp_path):
    path = write_result(tmp_path / "two.h5", swept=(SPEED,), speeds=(300.0, 600.0), oils=(60.0,))
    figure = draw("dampers", Layout([read_result(path)]))
    [axes] = figure.axes
    assert axes.get_xlabel() == "energy lost in a turn [mJ]"
    assert [text.get_text() for text in axes.get_yticklabels()] == ["cam and roller", "valve seat", "leak of the adjuster"]
    # For each damper the bars of both cases, around its name
    for place, value in enumerate(LOST.values()):
        bars = [bar for bar in axes.patches if abs(bar.get_y() + 0.5 * bar.get_height() - place) < 0.5]
        assert [bar.get_width() for bar in bars] == pytest.approx([1e3 * value, 2e3 * value])
    # The legend shows bars
    [shown] = figure.legends
    assert [text.get_text() for text in shown.get_texts()] == ["300 rev/min", "600 rev/min"]
    assert [handle.get_facecolor() for handle in shown.legend_handles] == [bar.get_facecolor() for bar in axes.patches[::3]]
    with h5py.File(path, "a") as file:
        for name in LOST:
            del file[f"summary/{name}"]
    with pytest.raises(Missing):
        draw("dampers", Layout([read_result(path)]))


def shown_title(figure):
    """What stands above a figure: the title of its legend."""
    return figure.legends[0].get_title().get_text()


def test_every_energy_lost_has_a_bar_or_a_word(tmp_path):
    path = write_result(tmp_path / "two.h5", swept=(SPEED,), speeds=(300.0, 600.0), oils=(60.0,))
    with h5py.File(path, "a") as file:
        file["summary/damping_work_cam"][...] = [1e-9, 1e-3]
    figure = draw("dampers", Layout([read_result(path)]))
    [axes] = figure.axes
    assert all(bar.get_width() >= 1.5 * axes.get_xlim()[0] for bar in axes.patches) and "no bar" not in shown_title(figure)
    with h5py.File(path, "a") as file:
        file["summary/damping_work_cam"][0] = 1e-18
    figure = draw("dampers", Layout([read_result(path)]))
    assert figure.axes[0].get_xlim()[0] == pytest.approx(1e-9) and "energies below 1.00e-09 mJ have no bar" in shown_title(figure)


def test_turns_of_a_train_that_does_not_repeat_are_drawn_one_by_one(tmp_path):
    path = write_result(tmp_path / "two.h5", swept=(SPEED,), speeds=(300.0, 600.0), oils=(60.0,))
    with h5py.File(path, "a") as file:
        for data in file["turns"].values():  # the first case repeats every turn
            data[0] = np.nan
        file["summary/period_cycles"] = [1.0, 2.0]
    lift, load, seating, section = draw("turns", Layout([read_result(path)])).axes
    assert [len(axes.lines) for axes in (lift, load, seating, section)] == [1, 1, 1, 1]
    assert lift.lines[0].get_ydata() == pytest.approx([-1.0, 1.0]) and list(load.lines[0].get_xdata()) == [1, 2]
    assert list(seating.lines[0].get_ydata()) == [0.2, 0.3] and list(section.lines[0].get_ydata()) == [0.1, -0.1]
    assert section.lines[0].get_label().endswith("repeats after 2 turns")
    with h5py.File(path, "a") as file:  # the valve does not close in the first turn, and the second stays the second
        file["turns/seating_speed"][1, 0] = 0.0
    seating = draw("turns", Layout([read_result(path)])).axes[2].lines[0]
    assert list(seating.get_xdata()) == [1, 2] and list(seating.get_ydata()) == pytest.approx([np.nan, 0.3], nan_ok=True)
    with h5py.File(path, "a") as file:
        del file["turns"]
    with pytest.raises(Missing, match="repeat every turn"):
        draw("turns", Layout([read_result(path)]))


WRITTEN = {}  # contents of made-up files by what they are of


def write_result(path, **options):
    """A made-up result file, see `written_anew`; one of what has been written before has the same bytes."""
    of_what = repr(sorted(options.items()))
    if of_what not in WRITTEN:
        WRITTEN[of_what] = written_anew(path, **options).read_bytes()
    path.write_bytes(WRITTEN[of_what])
    return path


def written_anew(path, speeds=(300.0, 600.0, 900.0), oils=(25.0, 60.0, 95.0), step=5.0, title="made up", factor=1.0,
                 swept=(SPEED, OIL), without=(), complete=1, points=None):
    """A result file of a grid or of points; keys that are not swept have one value and stand with the other deck values."""
    angle = np.arange(0.0, 360.0, step)
    points = points or [(speed, oil) for speed in speeds for oil in oils]
    rows = [made_up_series(angle, *point) for point in points]
    with h5py.File(path, "w") as file:
        file["case"] = np.arange(len(points))
        file["case"].make_scale("case")
        file["series/cam_angle"] = angle
        file["series/cam_angle"].attrs["units"] = "degree"
        file["series/cam_angle"].make_scale("cam_angle")
        for name in set(rows[0]) - set(without):
            values = np.array([row[name] for row in rows]) * factor
            unit = SERIES_UNITS.get(name, "N m")
            data = file.create_dataset(f"series/{name}", data=values)
            data.attrs.update({"units": np.bytes_(unit), "long_name": name.replace("_", " "), "source": "test"})
            data.dims[0].attach_scale(file["case"])
            data.dims[1].attach_scale(file["series/cam_angle"])
            file[f"summary/mean_{name}"] = values.mean(axis=1)
            file[f"summary/mean_{name}"].attrs["units"] = unit
        for name, values in made_up_hours().items():
            file[f"running_in/{name}"] = np.tile(values, (len(points), 1))
            file[f"running_in/{name}"].attrs["units"] = HOURS_UNITS.get(name, "m")
        for name, values in TURNS.items():
            file[f"turns/{name}"] = np.tile(values, (len(points), 1))
        file["turns/turn"] = np.arange(1.0, 4.0)
        for name, value in LOST.items():
            file[f"summary/{name}"] = value * (1.0 + np.arange(len(points)))
            file[f"summary/{name}"].attrs["units"] = "J"
        if "torque_friction" not in without:
            power = [row["torque_friction"].mean() * factor * speed * np.pi / 30 for row, (speed, _) in zip(rows, points)]
            file["summary/power_friction"] = power
            file["summary/power_friction"].attrs["units"] = "W"
        names = ", ".join(f"'{key}'" for key in swept)
        file["deck/text"] = np.bytes_(f"&case\n  title = '{title}' ! of a test\n/\n&sweep keys = {names} /\n")
        for key, values in zip((SPEED, OIL), np.array(points).T):
            given = file.create_dataset(("sweep/" if key in swept else "deck/values/") + key,
                                        data=values if key in swept else values[0])
            given.attrs["units"] = UNITS[key]
        file.create_group("run").attrs["program"] = np.bytes_("camroller ")
        if complete is not None:
            file.attrs["complete"] = complete
    return path


@pytest.fixture(name="nine")
def fixture_nine(tmp_path):
    return write_result(tmp_path / "nine.h5")


def drawn_files(folder):
    return sorted(path.name for path in folder.glob("*.*") if path.suffix != ".h5")


def test_everything_in_a_file_is_read(nine):
    result = read_result(nine)
    assert result.cases == 9 and result.cam_angle.size == 72
    assert result.series["contact_load"].units == "N"
    assert result.series["contact_load"].values.shape == (9, 72)
    assert result.summary["mean_slip_ratio"].values.shape == (9,)
    assert result.title == "made up"
    assert result.run["program"] == "camroller"


def test_swept_keys_come_in_the_order_of_the_deck_not_of_the_alphabet(nine):
    assert list(read_result(nine).sweep) == [SPEED, OIL]


def test_a_value_is_found_whether_swept_or_fixed(tmp_path):
    result = read_result(write_result(tmp_path / "one.h5", oils=(60.0,), swept=(SPEED,)))
    assert [result.value_of(SPEED, case) for case in range(3)] == [300.0, 600.0, 900.0]
    assert result.value_of(OIL, 2) == 60.0
    assert result.value_of("spring.rate", 0) is None


def test_a_list_in_the_deck_is_not_taken_for_values_of_cases(nine):
    with h5py.File(nine, "a") as file:
        file["deck/values/camshaft.phases_deg"] = np.arange(9.0)
    assert read_result(nine).value_of("camshaft.phases_deg", 0) is None


def test_a_quantity_that_does_not_change_between_panels_is_drawn_once(nine):
    layout = Layout([read_result(nine)])
    assert len(draw("lift", layout).axes) == 1
    assert len(draw("film", layout).axes) == 3


def test_quotes_in_a_title_are_kept(tmp_path):
    assert read_result(write_result(tmp_path / "one.h5", title="the source''s way")).title == "the source's way"


def test_a_resolved_title_goes_before_the_deck_text(nine):
    with h5py.File(nine, "a") as file:
        file["deck/values/case.title"] = np.bytes_("resolved   ")
    assert read_result(nine).title == "resolved"


@pytest.mark.parametrize("spoil, expected", [
    (lambda path: path.unlink(), "no such file"),
    (lambda path: path.write_text("cam_angle,load\n"), "not an HDF5 file"),
    (lambda path: h5py.File(path, "w").close(), "not a result file of camroller"),
    (lambda path: write_result(path, complete=None), "not complete"),
    (lambda path: write_result(path, complete=0), "not complete"),
])
def test_a_file_that_cannot_be_used_gives_one_line_and_code_2(nine, capsys, spoil, expected):
    spoil(nine)
    assert main([str(nine)]) == 2
    message = capsys.readouterr().err
    assert expected in message and str(nine) in message and message.count("\n") == 1


@pytest.mark.parametrize("group, words", [
    ("study/study", "`camroller study` has measured, not the results of a run; post/plot_study.py draws it"),
    ("study/audit", "`camroller audit` has measured, not"),
    ("ehl", "post/ehl.py draws it"),
])
def test_a_file_of_another_command_names_its_script(tmp_path, capsys, group, words):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file.create_group(group)
        if group == "ehl":
            file.create_group("series")
            file["summary/status"] = np.zeros(2)
    assert main([str(tmp_path / "other.h5")]) == 2
    assert words in capsys.readouterr().err


def test_only_series_that_are_drawn_are_read_and_few_are_held(tmp_path, monkeypatch):
    few = write_result(tmp_path / "few.h5", oils=(60.0,), swept=(SPEED,), step=15.0)
    whole, read = plot_bytes(few, tmp_path), []
    monkeypatch.setattr("read.MOST_HELD", 0)
    values_in = _values
    monkeypatch.setattr("read._values", lambda path, name: read.append(name) or values_in(path, name))
    assert plot_bytes(few, tmp_path) == whole
    assert len(Series._held) == 1
    del read[:]
    assert main([str(few), "--figure", "load", "--cases", "1,2"]) == 0
    with h5py.File(few) as file:
        assert {"/series/contact_load", "/series/valve_lift"} <= set(read) and len(set(read)) <= 3 < len(file["series"])


def plot_bytes(path, folder):
    """Contents of two figures of a file."""
    for name in ("overview", "friction_coefficient"):
        assert main([str(path), "--figure", name, "--output", str(folder)]) == 0
    return [drawn.read_bytes() for drawn in sorted(folder.glob("few_*.png"))]


@pytest.mark.parametrize("script", [main, report.main])
def test_a_damaged_series_is_told_and_not_left_out(tmp_path, capsys, script):
    path = write_result(tmp_path / "nine.h5")
    with h5py.File(path, "a") as file:
        values = file["series/slip_ratio"][()]
        del file["series/slip_ratio"]
        data = file.create_dataset("series/slip_ratio", data=values, chunks=values.shape, compression="gzip")
        data.attrs["units"] = "1"
        place = data.id.get_chunk_info(0).byte_offset
    with path.open("r+b") as file:
        file.seek(place)
        file.write(b"?" * 40)
    assert script([str(path)]) == 2
    assert f"{path}: cannot be read: " in capsys.readouterr().err
    assert not path.with_suffix(".html").exists()


def test_a_series_of_another_shape_is_refused(nine):
    with h5py.File(nine, "a") as file:
        file["series/odd"] = np.zeros((9, 3))
    with pytest.raises(ResultError, match="odd"):
        read_result(nine)


@pytest.mark.parametrize("selection, expected", [
    (["0,2-4"], [0, 2, 3, 4]), (["speed_rpm=300"], [0, 1, 2]), (["speed=600,900", "oil_temperature=95"], [5, 8]),
    ([f"{OIL}=25"], [0, 3, 6]), (["1-5", "speed=300"], [1, 2]),
])
def test_cases_are_chosen_by_number_and_by_value(nine, selection, expected):
    assert chosen_cases(read_result(nine), selection) == expected


@pytest.mark.parametrize("selection", ["9", "3-2", "x", "colour=3", "speed=5"])
def test_a_selection_that_fits_nothing_is_an_error(nine, capsys, selection):
    assert main([str(nine), "--cases", selection]) == 2
    assert "--cases" in capsys.readouterr().err


def test_values_are_drawn_in_units_for_people(nine):
    layout = Layout([read_result(nine)])
    entry = layout.entries[4]
    lift = values_of(layout, entry, "valve_lift", "mm")
    assert lift.max() == pytest.approx(9.5)
    assert values_of(layout, entry, "not_there", "mm") is None
    with pytest.raises(ResultError, match="'m'"):
        values_of(layout, entry, "valve_lift", "N")


def test_every_curve_finds_its_unit(nine):
    layout = Layout([read_result(nine)])
    for curve in (suited(layout, curve) for curve in CURVES.values()):
        assert values_of(layout, layout.entries[0], curve.series, curve.unit).shape == (72,)


def test_first_key_goes_to_colours_and_second_to_panels(nine):
    layout = Layout([read_result(nine)])
    assert layout.colours == [300.0, 600.0, 900.0]
    assert [layout.panel_name(panel) for panel in layout.panels] == ["25 °C", "60 °C", "95 °C"]
    assert layout.name(SPEED, 300.0) == "300 rev/min"
    styles = [layout.style(entry) for entry in layout.entries_of((25.0,))]
    assert len({str(style["color"]) for style in styles}) == 3
    assert len({str(style["linestyle"]) for style in styles}) == 3


def test_files_with_and_without_a_sweep_meet_in_the_right_panel(tmp_path):
    nine = read_result(write_result(tmp_path / "nine.h5"))
    one = read_result(write_result(tmp_path / "one.h5", speeds=(600.0,), oils=(60.0,), swept=()))
    layout = Layout([nine, one])
    assert [(entry.colour, entry.panel) for entry in layout.entries if entry.file == 1] == [(600.0, (60.0,))]
    assert layout.titles == ["made up (nine.h5)", "made up (one.h5)"]


def test_thinning_keeps_both_ends():
    assert thin_out(list(range(50)), 7)[0] == 0 and thin_out(list(range(50)), 7)[-1] == 49
    assert thin_out([1, 2], 7) == [1, 2]
    assert thin_out(list(range(41)), 40) == list(range(0, 41, 2)) and len(thin_out(list(range(41)), 7)) == 7


def test_the_cycle_is_closed_and_the_event_is_in_the_window(nine):
    angle, values = closed(np.array([0.0, 120.0, 240.0]), np.array([1.0, 2.0, 3.0]))
    assert list(angle) == [0.0, 120.0, 240.0, 360.0] and values[-1] == 1.0
    first, last = event_window(Layout([read_result(nine)]))
    assert 60.0 <= first <= 110.0 and 250.0 <= last <= 300.0


@pytest.mark.parametrize("limits, scale", [((0.05, 1.3), "log"), ((1.0, 1.3), "linear"), ((-2.0, 60.0), "linear"),
                                           ((0.0, 60.0), "linear"), ((0.0, 0.0), "linear")])
def test_slip_and_film_have_logarithmic_axes_where_values_differ_much(limits, scale):
    axes = Figure().subplots()
    set_values_axis(axes, CURVES["slip"], limits)
    assert axes.get_yscale() == scale
    assert axes.get_ylim()[0] <= limits[0] and axes.get_ylim()[1] >= limits[1]


def test_shares_have_one_scale_and_the_film_ratio_its_lines(nine):
    layout = Layout([read_result(nine)])
    for name in ("load_share", "boundary_share"):
        limits = {axes.get_ylim() for axes in draw(name, layout).axes}
        # though the shares of the panels differ by more than a factor of ten
        assert len(limits) == 1 and limits.pop()[1] == pytest.approx(105.0)
    for axes in draw("film_ratio", layout).axes:
        lines = [line.get_ydata()[0] for line in axes.lines if len(set(line.get_ydata())) == 1]
        low, high = axes.get_ylim()
        assert lines == [value for value in (1.0, 3.0) if low < value < high]


def test_no_swept_value_has_the_colour_of_a_source_beside_it(nine):
    layout = Layout([read_result(nine)])
    values = {to_hex(layout.style(entry)["color"]) for entry in layout.entries}
    sources = [colour for *_, colour, _ in SOURCES]
    assert len(values) == 3 and len(set(sources)) == len(sources) and not values & set(sources)


def test_all_figures_are_drawn_beside_the_file(tmp_path):
    path = write_result(tmp_path / "four.h5", speeds=(300.0, 900.0), oils=(25.0, 95.0), step=15.0)
    assert main([str(path)]) == 0
    assert drawn_files(tmp_path) == sorted(f"four_{name}.png" for name in FIGURES)


@pytest.mark.parametrize("kind, start", [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_each_format_is_written_and_the_same_twice(nine, tmp_path, kind, start):
    folders = [tmp_path / "new" / "first", tmp_path / "second"]
    for folder in folders:
        assert main([str(nine), "--figure", "slip", "--format", kind, "--output", str(folder)]) == 0
    first, second = ((folder / f"nine_slip.{kind}").read_bytes() for folder in folders)
    assert first.startswith(start) and first == second


def test_figures_without_their_series_are_skipped_and_named(tmp_path, capsys, monkeypatch):
    path = write_result(tmp_path / "smooth.h5", without=("asperity_friction_share", "torque_guide"))
    monkeypatch.setattr(plot, "FIGURES", ["overview", "boundary_share", "mean_torque"])
    assert main([str(path)]) == 0
    assert "boundary_share: skipped, no asperity_friction_share in the file" in capsys.readouterr().out
    assert drawn_files(tmp_path) == ["smooth_mean_torque.png", "smooth_overview.png"]


def test_nothing_to_draw_is_an_error(tmp_path, capsys):
    path = write_result(tmp_path / "smooth.h5", without=("slip_ratio",))
    assert main([str(path), "--figure", "slip"]) == 2
    assert "nothing to draw" in capsys.readouterr().err


@pytest.mark.parametrize("options", [
    {"speeds": (600.0,), "oils": (60.0,), "swept": ()},
    {"oils": (60.0,), "swept": (SPEED,)},
    {"speeds": tuple(np.linspace(200.0, 1200.0, 12)), "oils": (60.0,), "swept": (SPEED,)},
    {"speeds": (300.0, 900.0), "oils": tuple(np.linspace(20.0, 120.0, 11))},
    {"speeds": (300.0,), "oils": (25.0, 95.0)},
], ids=["no sweep", "one key", "many of the first", "many of the second", "one of the first"])
def test_other_sweeps_draw_too(tmp_path, options):
    path = write_result(tmp_path / "other.h5", step=15.0, **options)
    names = ["overview", "slip", "drive_torque", "mean_slip", "mean_torque"]
    for name in names:
        assert main([str(path), "--figure", name]) == 0
    assert len(drawn_files(tmp_path)) == len(names)


def test_cases_without_a_solution_leave_gaps_and_are_named(nine, capsys):
    with h5py.File(nine, "a") as file:
        for data in [*file["series"].values(), *file["summary"].values()]:
            if data.name != "/series/cam_angle":
                data[0] = np.nan
        file["summary/status"] = np.array([3] + 8 * [0])
        file["run/messages"] = np.array(["no periodic state"] + 8 * [""], dtype="S20")
    assert main([str(nine), "--figure", "overview"]) == 0
    assert f"{nine}: case 0 has no result: no periodic state" in capsys.readouterr().out


def test_two_files_are_drawn_over_each_other(tmp_path, monkeypatch):
    paths = [str(write_result(tmp_path / f"{name}.h5", title=name, factor=factor, step=15.0))
             for name, factor in (("a", 1.0), ("b", 1.1))]
    names = ["overview", "load", "drive_torque", "mean_slip"]
    monkeypatch.setattr(plot, "FIGURES", names)
    assert main(paths) == 0
    assert drawn_files(tmp_path) == sorted(f"a_vs_b_{name}.png" for name in names)


def test_a_folder_that_cannot_be_written_is_an_error(nine, tmp_path, capsys):
    (tmp_path / "taken").write_text("")
    assert main([str(nine), "--figure", "load", "--output", str(tmp_path / "taken")]) == 2
    assert "cannot be written" in capsys.readouterr().err


def test_it_runs_from_anywhere_without_a_display(nine, tmp_path):
    codes = []
    for figure in ("load", "colours"):
        done = subprocess.run([sys.executable, str(HERE / "plot.py"), nine.name, "--figure", figure], cwd=tmp_path,
                              env={"PATH": "", "MPLCONFIGDIR": str(tmp_path / "config")}, check=False)
        codes.append(done.returncode)
    assert codes == [0, 2]
    assert drawn_files(tmp_path) == ["nine_load.png"]


def test_every_loss_of_the_program_has_a_colour_and_a_column():
    """Figures and tables know each loss that the program's list of torques names."""
    rows = (Path(__file__).parent.parent / "src/losses/torque_list.f90").read_text(encoding="utf-8")
    losses = {f"mean_torque_{name}" for name in re.findall(r'torque_row_t\("(\w+)".*kind_loss', rows)}
    assert len(losses) >= 5
    assert losses == {name for name, *_ in SOURCES}
    assert losses <= {name for name, *_ in COLUMNS}
