"""Hours of running: what is in the file, the same from run, sweep and rerun, and decks that are refused."""

import h5py
import numpy
import pytest

from conftest import ROOT, done, run

DECK = ROOT / "decks/tribofilm.nml"
COARSE = ["--set", "output.angle_step_deg=10", "--set", "running_in.places=72", "--set", "sweep.values_1=300,900"]
DECK_ERROR, DIFFERENCE = 3, 7


@pytest.fixture(scope="module")
def folder(camroller, tmp_path_factory):
    path = tmp_path_factory.mktemp("hours")
    done(camroller, "run", DECK, *COARSE, "-o", "one.h5", "--quiet", folder=path)
    return path


def test_the_file_has_the_way_of_the_surfaces(folder):
    with h5py.File(folder / "one.h5") as file:
        group = file["running_in"]
        assert group["running_time_part"][...] == pytest.approx(numpy.linspace(0, 1, 41))
        for name, data in group.items():
            assert {"units", "long_name", "source", "scope"} <= set(data.attrs), name
            assert name == "running_time_part" or data.shape == (2, 41) and numpy.isfinite(data[...]).all(), name
        assert group["time"][:, -1] == pytest.approx(36000.0) and group["roller_film"].dims[1][0].name.endswith("running_time_part")
        assert group["roller_film"][:, -1] == pytest.approx(file["summary/roller_film_thickness"][...])
        assert group["roller_wear"][:, -1] == pytest.approx(file["summary/roller_wear_depth"][...])
        assert (file["summary/estimated_error_of_running_in"][...] <= 1e-3).all()
        # every angle of the series is a place, where the curve has its value, to round-off
        assert (file["series/cam_film_thickness"][...].max(axis=1) <= group["largest_cam_film"][:, -1] * (1 + 1e-12)).all()
        # the mean over the places; the angles of the series miss little of it
        mean = file["series/cam_film_thickness"][...].mean(axis=1)
        assert mean == pytest.approx(group["mean_cam_film"][:, -1], rel=1e-2)
        assert file["series/subsurface_shear_stress"][...] == pytest.approx(0.300283 * file["series/hertz_pressure"][...], rel=1e-5)


def test_a_sweep_and_a_rerun_have_the_same_bits(camroller, folder):
    done(camroller, "sweep", DECK, *COARSE, "-o", "two.h5", "--threads", 2, "--quiet", folder=folder)
    with h5py.File(folder / "one.h5") as one, h5py.File(folder / "two.h5") as two:
        for name, data in one["running_in"].items():
            assert (two["running_in"][name][...] == data[...]).all(), name
        assert (one["summary/max_cam_wear_depth"][...] == two["summary/max_cam_wear_depth"][...]).all()
    assert " 2 cases are the same to the last bit" in done(camroller, "rerun", "one.h5", folder=folder).stdout
    with h5py.File(folder / "two.h5", "r+") as file:
        file["running_in/roller_wear"][1, 7] *= 1 + 1e-15
    result = run(camroller, "rerun", "two.h5", folder=folder)
    assert result.returncode == DIFFERENCE and "running_in/roller_wear: in 1 case" in result.stderr


@pytest.mark.parametrize("leave, words", [
    (("running_in",), "&tribofilm needs the group &running_in"),
    (("asperity",), "&wear needs the group &asperity"),
    (("tribofilm", "wear"), "&running_in needs &tribofilm or &wear")])
def test_hours_need_what_changes_in_them(camroller, tmp_path, leave, words):
    text = DECK.read_text()
    for group in leave:
        first = text.index(f"&{group}\n")
        text = text[:first] + text[text.index("\n/\n", first) + 3:]
    (tmp_path / "deck.nml").write_text(text)
    result = run(camroller, "check", "deck.nml", folder=tmp_path)
    assert result.returncode == DECK_ERROR and words in result.stderr


def test_wear_is_next_to_nothing_in_the_deck_and_too_much_of_it_gives_a_remark(camroller, folder):
    """The depths that the deck's head states; rates of the wrong power of ten wear the cam away, which its geometry does not follow."""
    with h5py.File(folder / "one.h5") as file:
        depths = file["summary/max_cam_wear_depth"][...]
        assert depths == pytest.approx([1.0e-12, 4.1e-12], rel=0.05)
        assert not any("new parts" in line for line in file["run/warnings"].asstr()[...])
        # one hundredth of the lift of 9.5 mm
        rate = 1e-8 * 0.01 * 9.5e-3 / depths[0]
    for factor, count in ((1.2, 1), (0.8, 0)):
        words = ["--set", "sweep.values_1=300", "--set", f"wear.cam_rate_mm3_N_m={factor * rate}"]
        done(camroller, "run", DECK, *COARSE, *words, "-o", "worn.h5", "--quiet", folder=folder)
        with h5py.File(folder / "worn.h5") as file:
            lines = "\n".join(file["run/warnings"].asstr()[...]).splitlines()
        assert sum("mm away from the cam and" in line and "are those of new parts here" in line for line in lines) == count


def test_wear_by_creep_alone_has_a_remark(folder, camroller):
    """Asperities hold the roller at 300 rev/min and not at 900; with stick-slip it does not slide and does not wear."""
    with h5py.File(folder / "one.h5") as file:
        slow, fast = file["run/warnings"].asstr()[...]
        largest = file["summary/max_sliding_speed"][...]
    told = "asperities hold it, and their regularised friction lets it creep"
    assert told in slow and largest[0] < 1e-3 and told not in fast and largest[1] > 1e-3
    done(camroller, "run", DECK, *COARSE, "--set", "sweep.values_1=300", "--set", "asperity.mobilisation='stick_slip'", "-o", "stick.h5",
         "--quiet", folder=folder)
    with h5py.File(folder / "stick.h5") as file:
        assert (file["summary/max_cam_wear_depth"][...] == 0).all() and told not in file["run/warnings"].asstr()[...][0]


def test_a_creeping_roller_at_a_crawl_has_the_remark_without_wear(folder, camroller):
    done(camroller, "run", ROOT / "decks/thesis.nml", "--set", "sweep.values_1=0.1,300", "--set", "sweep.values_2=95", "-o", "crawl.h5",
         "--quiet", folder=folder)
    with h5py.File(folder / "crawl.h5") as file:
        crawling, rolling = file["run/warnings"].asstr()[...]
        slip = file["summary/mean_slip_ratio"][...].ravel()
    told = "asperities hold it"
    assert told in crawling and slip[0] > 0.05 and told not in rolling and slip[1] < 1e-3


def test_a_host_refuses_hours_of_running(folder, camroller):
    refused = run(camroller, "fmu", DECK, "-o", "hours.fmu", folder=folder)
    assert refused.returncode == 2 and not (folder / "hours.fmu").exists()
    assert "leave &running_in out, with &tribofilm" in refused.stderr


def test_a_film_without_asperities_has_a_remark(camroller, tmp_path):
    """Smooth surfaces, whose tribofilm is as smooth: the shear of the oil alone makes it grow."""
    words = "times as thick as the surfaces are rough, so that no asperities touch: the tribofilm grows by the shear of the oil alone"
    smooth = ["--set", "surface.cam_roughness_um=0.01", "--set", "surface.roller_roughness_um=0.01", "--set",
              "tribofilm.roughness_ratio=0", "--set", "operating_point.speed_rpm=900", "--no-sweep"]
    assert words in done(camroller, "run", DECK, *COARSE[:4], *smooth, "-o", "x.h5", folder=tmp_path).stderr
    assert words not in done(camroller, "run", DECK, *COARSE[:4], "--no-sweep", "-o", "y.h5", folder=tmp_path).stderr


@pytest.mark.parametrize("zone, part", [("hertz", 0.0), ("rigid_to_elastic", 1.0144)])
def test_a_film_grows_by_the_stress_over_the_area_that_is_sheared(camroller, tmp_path, zone, part):
    """Its first second on the base circle at 25 degC: growth by the shear over the strip of the dry contact, or over one that is
    2 sqrt(b^2 + 1.0144 2 R h) wide (doc/theory.md, sections 8.4 and 10), while the place is in the dry contact."""
    volume, energy, rate, gas_constant, avogadro = 5e-27, 77e3, 5e5, 8.31446, 6.02214e23
    values = {"operating_point.speed_rpm": 900, "operating_point.oil_temperature_degC": 25, "film.law": "moes", "traction.sheared_zone": zone,
              "tribofilm.activation_volume_nm3": volume * 1e27, "tribofilm.growth_rate_nm_s": rate * 1e9,
              "tribofilm.removal_rate_per_s": 0, "tribofilm.roughness_ratio": 0, "running_in.duration_h": 1 / 3600}
    done(camroller, "run", DECK, *COARSE[:4], "--no-sweep", "-o", "x.h5", "--quiet",
         *(word for key, value in values.items() for word in ("--set", f"{key}={value}")), folder=tmp_path)
    with h5py.File(tmp_path / "x.h5") as file:
        base = numpy.abs(file["series/cam_angle"][:] - 180) > 100
        film, thickness, shear, half_width, radius, speed, asperities, flash = (file[f"series/{name}"][0][base] for name in (
            "film_thickness_central", "cam_film_thickness", "friction_hydrodynamic", "hertz_half_width", "equivalent_radius",
            "cam_surface_speed", "asperity_load", "flash_temperature_rise"))
    assert asperities.max() < 1e-3 and 1e-13 < thickness.min() and thickness.max() < 1e-9
    stress = numpy.abs(shear) / (2 * numpy.sqrt(half_width**2 + part * 2 * radius * film) * 13.7e-3)
    growth = rate * numpy.exp(-(energy - avogadro * volume * stress) / (gas_constant * (298.15 + flash)))
    # M is 0.2 here, so that the strip is 0.5 % narrower than in the rigid limit, of which an exponent of 0.3 makes 0.15 %
    assert thickness == pytest.approx(growth * 2 * half_width / speed * 900 / 60, rel=0.01)


@pytest.mark.once
def test_a_flexible_train_lists_hours_and_turns(camroller, tmp_path):
    """Two turns make a period at 3140 rev/min; so few places do not show what vibrates."""
    text = DECK.read_text().split("&sweep")[0].replace("speed_rpm = 300", "speed_rpm = 3140")
    (tmp_path / "flexible.nml").write_text(f"{text}&dynamics\n/\n&spring_surge mass_kg = 0.036 modes = 2\n/\n")
    settings = ["--set", "output.angle_step_deg=10", "--set", "running_in.places=36", "--set", "running_in.accuracy=0.05",
                "--set", "numerics.accuracy=1e-2"]
    words = done(camroller, "run", "flexible.nml", *settings, "-o", "hours.h5", folder=tmp_path).stderr
    assert "between the 36 places of the cam" in words and "take more running_in.places" in words
    with h5py.File(tmp_path / "hours.h5") as file:
        assert file["summary/period_cycles"][0] == 2
        assert numpy.isfinite(file["running_in/roller_wear"][0]).sum() == 41
        assert numpy.isfinite(file["turns/dynamic_load_max"][0]).sum() == 2
        assert file["summary/estimated_error_between_places"][0] > 0.1
    assert "same to the last bit" in done(camroller, "rerun", "hours.h5", folder=tmp_path).stdout


ROUGH = ["--no-sweep", "--quiet", "--set", "operating_point.speed_rpm=600", "--set", "tribofilm.roughness_ratio=3", "--set",
         "tribofilm.coefficient=0.5", "--set", "running_in.places=72"]


def test_a_film_whose_friction_takes_many_steps_has_a_result_within_its_accuracy(camroller, tmp_path):
    """A film twenty times as rough as it is usual: each step over the hours changes friction by much."""
    found = []
    for accuracy in (3e-5, 1e-3):
        done(camroller, "run", DECK, *ROUGH, "--set", f"running_in.accuracy={accuracy}", "-o", "x.h5", folder=tmp_path)
        with h5py.File(tmp_path / "x.h5") as file:
            summary = {name: file[f"summary/{name}"][...].item() for name in (
                "roller_film_thickness", "estimated_error_of_running_in", "running_in_cycles")}
            found.append((file["series/cam_film_thickness"][0] / 120e-9, summary))
    (fine, first), (coarse, second) = found
    stated = first["estimated_error_of_running_in"] + second["estimated_error_of_running_in"]
    assert abs(fine - coarse).max() <= stated and first["estimated_error_of_running_in"] < 3.6e-5
    assert abs(first["roller_film_thickness"] - second["roller_film_thickness"]) <= stated * 120e-9
    assert first["running_in_cycles"] < 1000


def test_an_accuracy_of_the_hours_that_is_not_reached_has_a_remark(camroller, tmp_path):
    """Steps keep to the accuracy; the error of the slip, by a loose tolerance, comes on top."""
    words = "the hours of running did not reach running_in.accuracy = 0.001: the estimated error of films or depths is "
    loose = ["--no-sweep", *COARSE[:4], "--set", "numerics.tolerance=0.01"]
    told = done(camroller, "run", DECK, *loose, "-o", "x.h5", folder=tmp_path).stderr
    with h5py.File(tmp_path / "x.h5") as file:
        stated = file["summary/estimated_error_of_running_in"][...].item()
    assert stated > 1e-3 and f"{words}{stated:.3g}"[:-1] in told
    assert words[:45] not in done(camroller, "run", DECK, "--no-sweep", *COARSE[:4], "-o", "y.h5", folder=tmp_path).stderr


def test_stated_errors_of_means_and_extremes_have_those_of_the_hours(camroller, tmp_path):
    """Films and depths after hours of steps: against hours that are a hundred times as accurate, in each mean and extreme."""
    found = []
    for accuracy, of_cycle in ((1e-3, 1e-4), (1e-5, 1e-6)):
        told = done(camroller, "run", DECK, "--no-sweep", *COARSE[:4], "--set", "operating_point.speed_rpm=600", "--set",
                    f"running_in.accuracy={accuracy}", "--set", f"numerics.accuracy={of_cycle}", "-o", "x.h5", folder=tmp_path).stderr
        with h5py.File(tmp_path / "x.h5") as file:
            found.append({name: data[...].item() for name, data in file["summary"].items()})
            stated = [file[f"summary/estimated_error_of_{kind}"].attrs["long_name"] for kind in ("means", "extremes")]
        # the cycle keeps to its accuracy, and the hours to theirs
        assert "did not reach" not in told and all("error over hours of running" in str(words) for words in stated)
    coarse, fine = found
    errors = []
    for series, least in (("cam_wear_depth", 0.0), ("cam_film_thickness", 120e-9)):
        size, extent = fine[f"mean_{series}"], fine[f"max_{series}"] - fine[f"min_{series}"]
        for name, scale in (("mean", size), ("min", extent), ("max", extent)):
            allowed = sum(numbers[f"estimated_error_of_{'means' if name == 'mean' else 'extremes'}"] for numbers in found)
            errors.append(abs(coarse[f"{name}_{series}"] - fine[f"{name}_{series}"]) / max(scale, least))
            assert errors[-1] <= allowed, (name, series)
    # and they are there: the cycle alone is right to 1e-6
    assert max(errors) > 3e-5 and coarse["estimated_error_of_means"] < 3 * coarse["estimated_error_of_running_in"] + 1e-4
