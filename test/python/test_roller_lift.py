"""A lift of the roller, or the contour of the cam, in the place of the valve's lift: tables of one cam come to the same results."""

import pathlib
import re
import subprocess

import h5py
import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

ROOT = pathlib.Path(__file__).resolve().parents[2]
# decks/tabulated_lift.nml [mm, rad]
ARM, PAD, CAM, BASE, ROLLER = 20.8, 35.5, 31.5, 18.0, 8.5
ARM_ANGLE, AXIS = np.radians(-3.5), np.radians(37.5)


def roller_lift(valve_lift):
    """Distance of the roller's centre from the cam's beyond that on the base circle, by the law of cosines."""
    closed = np.arccos((ARM**2 + CAM**2 - (BASE + ROLLER) ** 2) / (2 * ARM * CAM))
    pad = np.arccos(np.cos(closed - ARM_ANGLE + AXIS) - valve_lift / PAD)
    angle = pad - AXIS + ARM_ANGLE
    return np.sqrt(ARM**2 + CAM**2 - 2 * ARM * CAM * np.cos(angle)) - BASE - ROLLER


def write_table(path, change):
    angle, lift = np.loadtxt(ROOT / "decks/tables/polynomial_lift.txt").T
    values = change(lift)
    values[[0, -1]] = 0.0
    np.savetxt(path, np.column_stack([angle, values]), fmt="%.12f")
    return path


def summary(camroller, folder, *values):
    target = folder / "a.h5"
    words = [camroller, "run", "decks/tabulated_lift.nml", "-o", str(target), "--quiet", *(w for v in values for w in ("--set", v))]
    result = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 0, result.stderr
    with h5py.File(target) as file:
        return {name: data[0] for name, data in file["summary"].items() if data.dtype.kind == "f"}


def test_valve_lift_and_roller_lift_of_a_cam_give_the_same_results(camroller, tmp_path):
    valve = write_table(tmp_path / "valve.txt", lambda lift: lift)
    roller = write_table(tmp_path / "roller.txt", roller_lift)
    first = summary(camroller, tmp_path, f"lift.table={valve}")
    second = summary(camroller, tmp_path, f"lift.table={roller}", "lift.table_kind=roller_lift")
    # twelve decimals of a millimetre are written: the second derivative knows them to 1e-8
    for name in ("max_valve_lift", "max_contact_load", "mean_torque_friction", "max_hertz_pressure", "contact_loss_speed"):
        assert second[name] == pytest.approx(first[name], rel=1e-6), name
    assert second["max_valve_lift"] == pytest.approx(9.2e-3, rel=1e-6)


def test_an_impossible_roller_lift_is_refused(camroller, tmp_path):
    table = write_table(tmp_path / "far.txt", lambda lift: 4.0 * lift)
    result = subprocess.run([camroller, "check", "decks/tabulated_lift.nml", "--set", f"lift.table={table}", "--set",
                             "lift.table_kind=roller_lift"], capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 3 and "the roller cannot be so far from the cam" in result.stderr


def noise_of(rows):
    """Deviates of a mean square of one, always the same ones."""
    return np.random.default_rng(11).normal(size=rows)


def test_smoothing_counts_in_the_lift_that_the_table_holds(camroller, tmp_path):
    angle, lift = np.loadtxt(ROOT / "decks/tables/polynomial_lift.txt").T
    inside = lift > 1e-3
    given = np.where(inside, roller_lift(lift) + 1e-3 * noise_of(lift.size), 0)
    np.savetxt(tmp_path / "roller.txt", np.column_stack([angle, given]), fmt="%.9f")
    values = [f"lift.table={tmp_path / 'roller.txt'}", "lift.table_kind=roller_lift", "lift.smoothing_um=1"]
    after = summary(camroller, tmp_path, *values)
    with h5py.File(tmp_path / "a.h5") as file:
        places, first = np.unique(file["series/cam_angle"][:], return_index=True)
        curve = make_interp_spline(places, file["series/valve_lift"][0][first] * 1e3, k=5)(angle)
    event = slice(np.argmax(inside) - 1, inside.size - np.argmax(inside[::-1]) + 1)
    assert np.sqrt(np.mean((roller_lift(curve) - given)[event] ** 2)) == pytest.approx(1e-3, rel=0.02)
    exact = summary(camroller, tmp_path)
    assert after["max_hertz_pressure"] == pytest.approx(exact["max_hertz_pressure"], rel=0.02)
    told = subprocess.run([camroller, "check", "decks/tabulated_lift.nml", "--no-sweep", *(w for v in values for w in ("--set", v))],
                          capture_output=True, text=True, cwd=ROOT, check=True).stdout
    noise = float(re.search(r"lift table: noise of about ([\d.]+) um, smoothing_um = 1; second derivative of its values", told)[1])
    assert noise == pytest.approx(1, rel=0.3)


def contour(sense):
    """Radii [mm] over the polar angle [deg] of the cam whose valve lift is the table's, as the envelope of the roller.

    The finger goes round the cam; the roller's centre draws a curve, of which the contour is the parallel one roller radius inside.
    Complex numbers, first axis from the pivot to the cam's centre, second the way the finger opens.
    """
    degrees, lift = np.loadtxt(ROOT / "decks/tables/polynomial_lift.txt").T
    spline = make_interp_spline(np.radians(degrees), np.where(np.abs(lift) < 1e-9, 0, lift), k=5)
    angle = np.radians(np.linspace(degrees[0], degrees[-1], 40001))
    closed = np.arccos((ARM**2 + CAM**2 - (BASE + ROLLER) ** 2) / (2 * ARM * CAM))
    arm = np.arccos(np.cos(closed - ARM_ANGLE + AXIS) - spline(angle) / PAD) - AXIS + ARM_ANGLE
    centre = (ARM * np.exp(1j * arm) - CAM) * np.exp(1j * sense * angle)
    along = np.gradient(centre, angle)
    outward = -1j * sense * along / np.abs(along)
    surface = centre - ROLLER * outward
    assert (np.abs(surface[1:-1]) > BASE - 1e-5).all()
    polar = np.unwrap(sense * np.angle(surface))
    # the nose, where full lift is, at 180 degrees; the ends are on the base circle
    nose = polar[np.argmin(np.abs(angle - np.pi))]
    rows = np.radians(np.arange(-85, 85.01, 0.5))
    radius = np.interp(rows, polar - nose, np.abs(surface))
    return np.degrees(rows) + 180, np.maximum(radius, BASE)


@pytest.mark.parametrize("rotation, sense", [("away_from_pivot", 1), ("towards_pivot", -1)])
def test_the_contour_of_the_cam_gives_the_lift_that_it_was_made_of(camroller, tmp_path, rotation, sense):
    polar, radius = contour(sense)
    path = tmp_path / "contour.txt"
    np.savetxt(path, np.column_stack([polar, radius]), fmt="%.9f")
    valve = write_table(tmp_path / "valve.txt", lambda lift: lift)
    first = summary(camroller, tmp_path, f"lift.table={valve}", f"mechanism.rotation={rotation}")
    second = summary(camroller, tmp_path, f"lift.table={path}", "lift.table_kind=cam_contour", f"mechanism.rotation={rotation}")
    # radii every half degree, interpolated: loads follow the second derivative
    for name, share in (("max_valve_lift", 1e-5), ("max_contact_load", 1e-3), ("mean_torque_friction", 1e-3), ("max_hertz_pressure", 1e-3),
                        ("contact_loss_speed", 3e-3)):
        assert second[name] == pytest.approx(first[name], rel=share), name


def noisy_contour(camroller, folder, is_even, size):
    """A contour with noise of a size [um] on the whole turn: at even polar angles, or at those of even cam angles."""
    if is_even:
        polar, radius = contour(1)
        rest = np.arange(0.5, 60, 0.5)
        polar = np.concatenate([polar[0] - rest[::-1], polar, polar[-1] + rest])
        radius = np.pad(radius, rest.size, constant_values=BASE)
    else:
        table = cam_table(camroller, folder, "decks/tabulated_lift.nml")
        polar, radius = table["polar_angle [deg]"], table["cam_radius [mm]"]
    np.savetxt(folder / "contour.txt", np.column_stack([polar, radius + 1e-3 * size * noise_of(radius.size)]), fmt="%.9f")
    return [f"lift.table={folder / 'contour.txt'}", "lift.table_kind=cam_contour"]


@pytest.mark.parametrize("is_even", [True, False])
def test_noise_of_a_contour_is_told_and_smoothed(camroller, tmp_path, is_even):
    exact = summary(camroller, tmp_path)["max_hertz_pressure"]
    values = noisy_contour(camroller, tmp_path, is_even, 0.1)
    words = [camroller, "check", "decks/tabulated_lift.nml", "--no-sweep", *(w for v in values for w in ("--set", v))]
    told = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=True)
    noise = re.search(r"contour.txt: the table has noise of about ([\d.]+) um, which makes its second derivative", told.stderr)
    assert float(noise[1]) == pytest.approx(0.1, rel=0.3)
    assert f"lift table: noise of about {noise[1]} um, smoothing_um = 0; second derivative of its values" in told.stdout
    for size in (0.1, 1):
        values = noisy_contour(camroller, tmp_path, is_even, size)
        after = summary(camroller, tmp_path, *values, f"lift.smoothing_um={size}")
        assert after["max_hertz_pressure"] == pytest.approx(exact, rel=0.01), size


@pytest.mark.parametrize("change, words", [
    (lambda radius: radius + 2e-3 * (radius > BASE + 1e-4) * abs(noise_of(radius.size)), "or noise, which 'smoothing_um' of &lift takes out"),
    (lambda radius: radius + 2e-3 * noise_of(radius.size), "set them to its radius, or give 'smoothing_um' of &lift"),
    (lambda radius: radius - 17, "no radius is above the base circle's"),
    (lambda radius: radius + 0.5, "the contour must start on the base circle"),
    (lambda radius: 18 + (radius - 18) * (1 + 0.3 * (np.arange(radius.size) % 40 == 20)), "the roller does not touch the contour here"),
])
def test_a_contour_that_no_roller_can_follow_is_refused(camroller, tmp_path, change, words):
    polar, radius = contour(1)
    path = tmp_path / "contour.txt"
    np.savetxt(path, np.column_stack([polar, change(radius)]), fmt="%.9f")
    result = subprocess.run([camroller, "check", "decks/tabulated_lift.nml", "--set", f"lift.table={path}", "--set",
                             "lift.table_kind=cam_contour"], capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 3 and words in result.stderr


def cam_table(camroller, folder, deck, *values):
    """Columns of the table of a cam by their names."""
    path = folder / "cam.csv"
    path.unlink(missing_ok=True)
    words = [camroller, "check", str(deck), "--cam", str(path), *(w for v in values for w in ("--set", v))]
    result = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 0, result.stderr
    names = path.read_text(encoding="utf-8").splitlines()[0].split(",")
    return dict(zip(names, np.loadtxt(path, delimiter=",", skiprows=1).T, strict=True))


@pytest.mark.parametrize("rotation, sense", [("away_from_pivot", 1), ("towards_pivot", -1)])
def test_the_table_of_the_cam_is_the_envelope_of_the_roller_and_a_lift_again(camroller, tmp_path, rotation, sense):
    table = cam_table(camroller, tmp_path, "decks/tabulated_lift.nml", f"mechanism.rotation={rotation}")
    assert len(table["lobe"]) == 720 and table["valve_lift [mm]"].max() == pytest.approx(9.2, rel=1e-6)
    polar, radius = contour(sense)
    found = make_interp_spline(table["polar_angle [deg]"], table["cam_radius [mm]"], k=3)(polar)
    # the envelope knows its nose to half of its step, 0.002 degrees, and rises by up to 0.15 mm a degree
    assert found == pytest.approx(radius, abs=3e-4)
    assert np.hypot(table["cam_x [mm]"], table["cam_y [mm]"]) == pytest.approx(table["cam_radius [mm]"], rel=1e-10)
    # the file taken for a lift table gives the results of the valve's lift, by its contour and by its lift
    before = summary(camroller, tmp_path, f"mechanism.rotation={rotation}")
    for kind in ("cam_contour", "valve_lift"):
        after = summary(camroller, tmp_path, f"lift.table={tmp_path / 'cam.csv'}", f"lift.table_kind={kind}", f"mechanism.rotation={rotation}")
        for name, share in (("max_valve_lift", 1e-5), ("max_contact_load", 1e-3), ("mean_torque_friction", 1e-3),
                            ("max_hertz_pressure", 1e-3), ("contact_loss_speed", 3e-3)):
            assert after[name] == pytest.approx(before[name], rel=share), (kind, name)


def table_words(deck, path, kind):
    """Values by which the lifts of a deck are those of a table."""
    groups = ("lift", "second_lift") if "&second_lift" in (ROOT / deck).read_text() else ("lift",)
    return [f"{group}.{word}" for group in groups for word in ("law=table", f"table={path}", f"table_kind={kind}")]


def check_with(camroller, deck, path, kind, *values):
    """What `check` says of a deck with the table of a cam for its lifts."""
    words = [word for value in [*table_words(deck, path, kind), *values] for word in ("--set", value)]
    return subprocess.run([camroller, "check", deck, *words], cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("deck", ["decks/thesis.nml", "decks/four_cylinder.nml", "decks/three_cam_head.nml"])
@pytest.mark.once
def test_every_lobe_of_the_table_of_the_cams_is_a_lift_of_a_deck(camroller, tmp_path, deck):
    """Lifts come back within 1e-5 of the largest, where the contour says what they are; nothing is remarked on them."""
    before = cam_table(camroller, tmp_path, deck)
    path = (tmp_path / "cam.csv").rename(tmp_path / "first.csv")
    for kind in ("cam_contour", "valve_lift"):
        result = check_with(camroller, deck, path, kind)
        assert result.returncode == 0 and str(path) not in result.stderr, result.stderr
        after = cam_table(camroller, tmp_path, deck, *table_words(deck, path, kind))
        largest = before["valve_lift [mm]"].max()
        assert after["valve_lift [mm]"] == pytest.approx(before["valve_lift [mm]"], abs=1e-5 * largest), kind
        assert after["cam_radius [mm]"] == pytest.approx(before["cam_radius [mm]"], abs=1e-4 * largest), kind


@pytest.mark.parametrize("change, values, words", [
    (lambda text: text, ["lift.table_unit=m"], "the heading of the table has 'mm', not 'm'"),
    (lambda text: text.replace("1,180,", "1,180,7,"), [], "a row has as many columns as its heading, 9, not 10"),
    (lambda text: text.replace("cam_radius", "radius"), [], "a row has two columns, not 9"),
    (lambda text: text.replace("\n1,", "\n2,"), [], "the table has 0 of at least 8 rows"),
])
def test_a_table_with_names_is_read_by_them(camroller, tmp_path, change, values, words):
    cam_table(camroller, tmp_path, "decks/thesis.nml")
    path = tmp_path / "cam.csv"
    path.write_text(change(path.read_text()))
    result = check_with(camroller, "decks/thesis.nml", path, "cam_contour", *values)
    assert result.returncode == 3 and words in result.stderr, result.stderr


def test_the_table_of_the_cam_has_its_radii_of_curvature_and_pressure_angles(camroller, tmp_path):
    table = cam_table(camroller, tmp_path, "decks/four_cylinder.nml", "lift.max_lift_mm=9.5")
    assert list(np.unique(table["lobe"])) == [1, 2]
    facts = subprocess.run([camroller, "check", "decks/four_cylinder.nml", "--no-sweep", "--set", "lift.max_lift_mm=9.5"], cwd=ROOT,
                           capture_output=True, text=True, check=True).stdout
    for lobe, name in ((1, "lobe"), (2, "second lobe")):
        own = table["lobe"] == lobe
        radius, pressure = table["curvature_radius [mm]"][own], table["pressure_angle [deg]"][own]
        told = re.search(rf"^! {name}: .* smallest cam radius ([\d.]+) mm at .* largest pressure angle ([\d.]+) deg", facts, re.M)
        # three digits are printed, of points a quarter of a degree apart
        assert radius[radius > 0].min() == pytest.approx(float(told[1]), rel=1e-2)
        assert pressure.max() == pytest.approx(float(told[2]), abs=0.1)
        # the circle through three points of the contour: second order in their distance of half a degree
        x, y = (np.column_stack([np.roll(table[f"cam_{axis} [mm]"][own], shift) for shift in (1, 0, -1)]) for axis in "xy")
        chords = [np.hypot(x[:, i] - x[:, j], y[:, i] - y[:, j]) for i, j in ((0, 1), (1, 2), (0, 2))]
        area = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (y[:, 1] - y[:, 0]) * (x[:, 2] - x[:, 0])
        curvature = -2 * area / np.prod(chords, axis=0)
        inside = np.abs(np.abs(table["cam_angle [deg]"][own] - 180) - 72.5) > 2  # the curvature has a kink at the ends of the event
        assert curvature[inside] == pytest.approx(1 / radius[inside], abs=1e-3 / 17)


def test_the_table_of_the_cam_replaces_no_file_that_was_read(camroller, tmp_path):
    deck = tmp_path / "mine.nml"
    deck.write_text((ROOT / "decks/thesis.nml").read_text(encoding="utf-8"), encoding="utf-8")
    result = subprocess.run([camroller, "check", str(deck), "--cam", str(deck)], capture_output=True, text=True, check=False)
    assert result.returncode != 0 and deck.read_text(encoding="utf-8").startswith((ROOT / "decks/thesis.nml").read_text(encoding="utf-8")[:40])


def test_the_table_of_the_cam_replaces_no_other_cam(camroller, tmp_path):
    """A contour that was changed by hand looks like one that was not."""
    words = [camroller, "check", "decks/thesis.nml", "--no-sweep", "--cam", str(tmp_path / "cam.csv")]
    for _ in range(2):
        assert subprocess.run(words, capture_output=True, cwd=ROOT, check=False).returncode == 0
    text = (tmp_path / "cam.csv").read_text(encoding="utf-8").replace(",18,", ",18.01,", 1)
    (tmp_path / "cam.csv").write_text(text, encoding="utf-8")
    result = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 6 and "cam.csv' exists and holds another cam, which may have been changed by hand" in result.stderr
    assert (tmp_path / "cam.csv").read_text(encoding="utf-8") == text
