"""Spectra of a spring over speed, against made-up modes."""

import h5py
import numpy as np
import pytest

import campbell
from read import ResultError, read_result

SPEEDS = [600.0, 1200.0, 1800.0]
STIFFNESS, MASS = 25000.0, 0.036


def write_sweep(path, amplitudes, harmonic=10, points=720):
    """A file as of a sweep over the speed, whose modes move with one harmonic of the cam."""
    angle = np.arange(points) * 360.0 / points
    with h5py.File(path, "w") as file:
        file.attrs["complete"] = 1
        file["series/cam_angle"] = angle
        for mode, amplitude in enumerate(amplitudes, 1):
            wave = np.cos(np.radians(harmonic * angle))
            file[f"series/spring_mode_{mode}"] = np.outer(amplitude * np.arange(1, 4), wave)
        for name in ("surge_force", "surge_estimate_1", "seating_speed", "seating_speed_lowest", "seating_speed_highest", "bounces"):
            file[f"summary/{name}"] = [1.0, 2.0, 3.0]
        file["summary/status"] = [0, 0, 0]
        file["sweep/operating_point.speed_rpm"] = SPEEDS
        file["deck/values/spring.stiffness_N_m"] = STIFFNESS
        file["deck/values/spring_surge.mass_kg"] = MASS
        file["deck/values/case.title"] = "Made up"
        file["deck/text"] = "&sweep /"
    return path


def test_force_of_a_harmonic_is_found_at_its_order(tmp_path):
    result = read_result(write_sweep(tmp_path / "a.h5", [1e-5]))
    amplitude = campbell.spectrum(campbell.mode_force(result))
    # k pi q_1 with q_1 of 1e-5, 2e-5 and 3e-5 m, at the tenth harmonic and nowhere else
    assert amplitude[:, 9] == pytest.approx(STIFFNESS * np.pi * 1e-5 * np.arange(1, 4), rel=1e-12)
    assert np.delete(amplitude, 9, axis=1).max() < 1e-12


def test_even_modes_pull_the_other_way(tmp_path):
    result = read_result(write_sweep(tmp_path / "a.h5", [2e-5, 1e-5]))
    assert np.abs(campbell.mode_force(result)).max() < 1e-12


def test_frequencies_are_those_of_a_clamped_spring(tmp_path):
    result = read_result(write_sweep(tmp_path / "a.h5", [1e-5, 0.0, 0.0]))
    assert campbell.mode_frequencies(result) == pytest.approx([416.666667, 833.333333, 1250.0], rel=1e-8)


def test_a_long_title_stays_within_the_figure(tmp_path):
    path = write_sweep(tmp_path / "a.h5", [1e-5])
    with h5py.File(path, "a") as file:
        file["deck/values/case.title"][()] = "A title of many words " * 23
    figure = campbell.draw(read_result(path))
    figure.draw_without_rendering()
    box = figure._suptitle.get_window_extent()  # pylint: disable=protected-access
    assert box.x0 >= 0.0 and box.x1 <= figure.bbox.x1


def test_map_is_brightest_where_the_harmonic_is(tmp_path):
    result = read_result(write_sweep(tmp_path / "a.h5", [1e-5]))
    figure = campbell.draw(result)
    mesh = figure.axes[0].collections[0]
    image = mesh.get_array().reshape(400, 3)
    heights = np.linspace(0.0, 1.15 * 416.666667, 400)
    for case, speed in enumerate(SPEEDS):
        assert heights[image[:, case].argmax()] == pytest.approx(10 * speed / 60.0, abs=1.5)


@pytest.mark.parametrize("slowest", [600.0, 100.0])
def test_numbers_at_the_rays_do_not_stand_on_each_other(tmp_path, slowest):
    path = write_sweep(tmp_path / "a.h5", [1e-5] * 5)
    with h5py.File(path, "a") as file:
        file["sweep/operating_point.speed_rpm"][...] = [slowest, 2 * slowest, 3 * slowest]
    figure = campbell.draw(read_result(path))
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in figure.axes[0].texts if text.get_text().isdigit()]
    assert len(boxes) > 1 and all(lower.y1 <= upper.y0 for lower, upper in zip(boxes, boxes[1:]))


@pytest.mark.parametrize("cycles, words", [(None, ""), ([1.0, 1.0, 1.0], ""), ([1.0, 2.0, 40.0], ", mean of the turns")])
def test_means_of_several_turns_are_called_so(tmp_path, cycles, words):
    path = write_sweep(tmp_path / "a.h5", [1e-5])
    with h5py.File(path, "a") as file:
        if cycles:
            file["summary/summary_cycles"] = cycles
    _, middle, below, *_ = campbell.draw(read_result(path)).axes
    assert middle.lines[0].get_label() == f"largest force of mode 1{words}" and below.lines[0].get_label() == f"speed of seating{words}"


def test_every_turn_of_a_motion_that_does_not_repeat_has_its_dot(tmp_path):
    path = write_sweep(tmp_path / "a.h5", [1e-5])
    with h5py.File(path, "a") as file:
        file["turns/seating_speed"] = [[np.nan] * 3, [0.1, 0.3, np.nan], [0.5, 0.6, 0.7]]
    below = campbell.draw(read_result(path)).axes[2]
    dots = {line.get_xdata()[0]: list(line.get_ydata()) for line in below.lines if line.get_marker() == "o" and line.get_xdata().size}
    assert dots == {1200.0: [0.1, 0.3], 1800.0: [0.5, 0.6, 0.7]}


def test_a_valve_that_never_meets_its_seat_has_no_speed_of_seating(tmp_path):
    """Files state it as 0: a logarithmic axis would draw that as a fall to its lower end, and a table as a speed."""
    path = write_sweep(tmp_path / "a.h5", [1e-5])
    with h5py.File(path, "a") as file:
        for name in ("seating_speed", "seating_speed_lowest", "seating_speed_highest"):
            file[f"summary/{name}"][2] = 0.0
        file["summary/seating_speed_deviation"] = [0.0, 0.1, 0.0]
        file["turns/seating_speed"] = [[np.nan] * 3, [0.1, 0.0, 0.3], [0.0] * 3]
    result = read_result(path)
    for name in ("seating_speed", "seating_speed_lowest", "seating_speed_highest", "seating_speed_deviation"):
        values = result.summary[name].values
        assert np.isnan(values[2]) and np.isfinite(values[:2]).all(), name
    below = campbell.draw(result).axes[2]
    assert not any((np.asarray(line.get_ydata()) == 0).any() for line in below.lines)
    dots = {line.get_xdata()[0]: list(line.get_ydata()) for line in below.lines if line.get_marker() == "o" and line.get_xdata().size}
    assert dots[1200.0] == pytest.approx([0.1, np.nan, 0.3], nan_ok=True)
    campbell.main([str(path)])


def test_harmonics_are_those_of_the_camshaft_where_the_deck_gives_the_speed_of_the_crankshaft(tmp_path):
    path = write_sweep(tmp_path / "a.h5", [1e-5])
    with h5py.File(path, "a") as file:
        file["deck/values/engine.given_speed"], file["summary/crank_turns"] = "crankshaft", [2.0] * 3
    figure = campbell.draw(read_result(path))
    image, heights = figure.axes[0].collections[0].get_array().reshape(400, 3), np.linspace(0.0, 1.15 * 416.666667, 400)
    for case, speed in enumerate(SPEEDS):
        assert heights[image[:, case].argmax()] == pytest.approx(10 * speed / 2 / 60.0, abs=1.5)
    assert figure.axes[2].get_xlim() == (300.0, 900.0) and figure.axes[2].get_xlabel() == "speed of the camshaft [rev/min]"


def test_cases_without_series_are_left_out_and_counted(tmp_path, capsys):
    path = write_sweep(tmp_path / "a.h5", [1e-5])
    with h5py.File(path, "a") as file:
        file["series/spring_mode_1"][1] = np.nan
    assert campbell.draw(read_result(path)).get_suptitle() == "Made up\n1 of 3 cases have no series"
    with h5py.File(path, "a") as file:
        file["summary/status"][1] = 5
    figure = campbell.draw(read_result(path))
    assert figure.get_suptitle() == "Made up\n1 of 3 cases have no result" and list(figure.axes[1].lines[0].get_xdata()) == [600.0, 1800.0]
    with h5py.File(path, "a") as file:
        file["summary/status"][1:] = -1
        file["series/spring_mode_1"][2] = np.nan
    assert campbell.main([str(path)]) == 2
    assert "1 of 3 cases has series of the spring's modes; a map needs two" in capsys.readouterr().err


def test_figure_is_written_and_other_sweeps_are_refused(tmp_path, capsys):
    path = write_sweep(tmp_path / "a.h5", [1e-5])
    assert campbell.main([str(path)]) == 0 and (tmp_path / "a_campbell.png").stat().st_size > 10_000
    assert campbell.main([str(path), "--output", str(tmp_path / "figures"), "--name", "map"]) == 0
    assert (tmp_path / "figures/map.png").stat().st_size > 10_000
    with h5py.File(path, "a") as file:
        file.move("sweep/operating_point.speed_rpm", "sweep/roller.radius_mm")
    assert campbell.main([str(path)]) == 2
    assert "not a sweep over operating_point.speed_rpm alone" in capsys.readouterr().err
    with pytest.raises(ResultError):
        campbell.draw(read_result(path))
