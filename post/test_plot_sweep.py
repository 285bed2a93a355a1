"""Figures of a sweep: which one suits, what is drawn of many keys, what is refused."""

import h5py
import numpy as np
import pytest

from layout import chosen_cases
from plot_sweep import FIGURES, Sweep, draw_curves, draw_map, draw_parallel, draw_scatter, main, suitable_figure
from read import read_result


def write(path, columns, torque, status=None):
    """A file with these swept columns and this torque."""
    with h5py.File(path, "w") as file:
        file.attrs["complete"] = 1
        file.create_group("series")
        file["deck/text"] = "&sweep " + " ".join(columns)
        sweep = file.create_group("sweep")
        for key, (values, unit) in columns.items():
            data = sweep.create_dataset(key, data=values)
            data.attrs["units"] = unit
        file["summary/mean_torque_drive"] = torque
        file["summary/mean_torque_drive"].attrs["units"] = "N m"
        file["summary/status"] = np.zeros(len(torque), int) if status is None else status
    return path


@pytest.fixture(name="grid")
def a_grid(tmp_path):
    """A grid over speed, temperature and two laws, one case without a result."""
    speed, temperature, law = (a.ravel() for a in np.meshgrid(np.linspace(300, 900, 10), np.linspace(40, 120, 9), [0, 1],
                                                              indexing="ij"))
    torque = speed / temperature + 10 * law
    torque[4] = np.nan
    laws = np.array(["moes", "pan_hamrock"], dtype=h5py.string_dtype())[law]
    columns = {"operating_point.speed_rpm": (speed, "rpm"), "operating_point.oil_temperature_degC": (temperature, "degC"),
               "film.law": (laws.astype(object), "1")}
    return write(tmp_path / "grid.h5", columns, torque, np.isnan(torque).astype(int))


@pytest.fixture(name="sample")
def a_sample(tmp_path):
    """A sample over two keys."""
    points = np.random.default_rng(1).random((50, 2))
    return write(tmp_path / "sample.h5", {"a.x_mm": (points[:, 0], "mm"), "a.y": (points[:, 1], "1")}, points.sum(axis=1))


def test_a_figure_suits_the_sweep(grid, sample, tmp_path):
    assert suitable_figure(Sweep(grid, ["mean_torque_drive"])) == "map"
    assert suitable_figure(Sweep(sample, ["mean_torque_drive"])) == "scatter"
    one = write(tmp_path / "one.h5", {"a.x": ([1.0, 2.0, 3.0], "1")}, [1.0, 2.0, 3.0])
    assert suitable_figure(Sweep(one, ["mean_torque_drive"])) == "curves"


def test_a_map_shows_the_longest_keys(grid):
    figure = draw_map(Sweep(grid, ["mean_torque_drive"]))
    axes = figure.axes[0]
    assert axes.get_xlabel() == "speed [rev/min]" and axes.get_ylabel() == "oil temperature [°C]"
    table = axes.collections[0].get_array()
    assert table.shape == (9, 10) and np.ma.count_masked(table) == 1
    assert np.isclose(table[0, 0], 300 / 40) and np.isclose(table[8, 9], 900 / 120)
    assert figure.get_suptitle() == "grid\nfilm law = moes, 1 of 180 cases have no result"
    assert figure.axes[1].get_ylabel() == "mean torque drive [N m]"


def test_curves_have_the_values_of_the_file(grid):
    axes = draw_curves(Sweep(grid, ["mean_torque_drive"])).axes[0]
    assert len(axes.lines) == 9
    x, y = axes.lines[-1].get_data()
    assert np.allclose(x, np.linspace(300, 900, 10)) and np.allclose(y, x / 120)


def test_many_curves_have_a_colour_bar_and_words_a_legend(grid):
    figure = draw_curves(Sweep(grid, ["mean_torque_drive"]))
    assert figure.axes[1].get_ylabel() == "oil temperature [°C]" and figure.axes[1].get_ylim() == (40, 120)
    assert figure.axes[0].get_legend() is None


def test_the_title_of_the_deck_is_on_the_figure(grid):
    with h5py.File(grid, "r+") as file:
        file["deck/values/case.title"], file["deck/values/engine.given_speed"] = "One rig", "crankshaft"
    for draw in (draw_map, draw_curves, draw_scatter, draw_parallel):
        assert draw(Sweep(grid, ["mean_torque_drive"])).get_suptitle().startswith("One rig\n")
    assert draw_map(Sweep(grid, ["mean_torque_drive"])).axes[0].get_xlabel() == "crankshaft speed [rev/min]"


def test_a_quantity_over_decades_has_a_logarithmic_axis(tmp_path):
    speed, load = (a.ravel() for a in np.meshgrid(np.linspace(1, 9, 9), np.linspace(1, 9, 9), indexing="ij"))
    keys = {"a.x": (speed, "1"), "a.y": (load, "1")}
    wide = Sweep(write(tmp_path / "wide.h5", keys, 10.0 ** (speed / 3)), ["mean_torque_drive"])
    near = Sweep(write(tmp_path / "near.h5", keys, 10.0 ** (speed / 9)), ["mean_torque_drive"])
    for draw in (draw_curves, draw_scatter):
        assert [draw(sweep).axes[0].get_yscale() for sweep in (wide, near)] == ["log", "linear"]
    low, high = 10 ** (1 / 3), 1000
    for draw, axes in ((draw_map, 1), (draw_parallel, 1)):
        bar = draw(wide).axes[axes]
        assert bar.get_yscale() == "log" and bar.get_ylim() == pytest.approx((low, high)), draw
        assert draw(near).axes[axes].get_yscale() == "linear"


def test_operating_points_of_a_design_count_as_one(grid, capsys):
    """Speeds as operating points of designs, which differ in temperature and law here."""
    whole = Sweep(grid, ["mean_torque_drive"])
    for take, function in (("largest", np.max), ("smallest", np.min), ("mean", np.mean)):
        worst = Sweep(grid, ["mean_torque_drive"], [], ["speed_rpm"], take)
        assert list(worst.keys) == ["operating_point.oil_temperature_degC", "film.law"] and len(worst.failed) == 18
        values, label = worst.quantities["mean_torque_drive"]
        assert label == f"{take} mean torque drive [N m]"
        for value, temperature, law in zip(values, worst.keys["operating_point.oil_temperature_degC"][0], worst.keys["film.law"][0]):
            own = (whole.keys["operating_point.oil_temperature_degC"][0] == temperature) & (whole.keys["film.law"][0] == law)
            # a design of which one point has no result has no value
            assert np.array_equal(value, function(whole.quantities["mean_torque_drive"][0][own]), equal_nan=True)
        assert np.isnan(values).sum() == 1 and worst.is_grid() and worst.failed.sum() == 1
    bounded = Sweep(grid, ["mean_torque_drive"], ["mean_torque_drive < 12"], ["speed_rpm"], "largest")
    kept = np.isfinite(bounded.quantities["mean_torque_drive"][0])
    assert np.array_equal(kept, Sweep(grid, ["mean_torque_drive"], [], ["speed_rpm"]).quantities["mean_torque_drive"][0] < 12)
    assert "largest over speed_rpm, 180 cases make 18" in draw_scatter(bounded).get_suptitle().replace("\n", " ")
    assert main([str(grid), "--over", "sped_rpm"]) == 2
    assert "'sped_rpm' is not one of the swept keys" in capsys.readouterr().err


def test_scatter_and_parallel_show_every_case(sample):
    sweep = Sweep(sample, ["mean_torque_drive"])
    figure = draw_scatter(sweep)
    assert [axes.get_xlabel() for axes in figure.axes] == ["a x [mm]", "a y"]
    assert all(len(axes.collections[0].get_offsets()) == 50 for axes in figure.axes)
    lines = [line for line in draw_parallel(sweep).axes[0].lines if len(line.get_xdata()) == 3]
    assert len(lines) == 50


def test_ranges_divided_by_equal_ratios_are_logarithmic(grid):
    with h5py.File(grid, "r+") as file:
        for place, key, scale in ((1, "film.law", "linear"), (2, "operating_point.speed_rpm", "logarithmic")):
            file[f"deck/values/sweep.key_{place}"], file[f"deck/values/sweep.scale_{place}"] = key, scale
    sweep = Sweep(grid, ["mean_torque_drive"])
    assert sweep.logarithmic == {"operating_point.speed_rpm"}
    axes = draw_map(sweep).axes[0]
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "linear")
    edges = axes.collections[0].get_coordinates()[0, :, 0]
    assert np.allclose(edges[1:-1] ** 2, np.linspace(300, 900, 10)[1:] * np.linspace(300, 900, 10)[:-1])
    assert draw_curves(sweep).axes[0].get_xscale() == "log"
    labels = [label.get_text() for label in draw_parallel(sweep).axes[0].get_xticklabels()]
    assert [label.startswith("speed") for label in labels] == ["\nlogarithmic" in label for label in labels]


def test_words_are_curves_or_stand_apart(tmp_path):
    """No line joins words; points of a scatter are beside the word they belong to."""
    laws = np.array(["b_b", "a"] * 4, dtype=h5py.string_dtype()).astype(object)
    columns = {"film.law": (laws, "1"), "a.long_key": (np.repeat([1.0, 2.0, 3.0, 4.0], 2), "1")}
    sweep = Sweep(write(tmp_path / "words.h5", columns, np.arange(8.0)), ["mean_torque_drive"])
    axes = draw_curves(sweep).axes[0]
    assert axes.get_xlabel() == "a long key"
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["a", "b b"]
    points = draw_scatter(sweep).axes[0].collections[0].get_offsets()[:, 0]
    assert (np.abs(points - np.array([1, 0] * 4)) < 0.2).all() and len(set(points)) == 8


@pytest.mark.parametrize("figure", FIGURES)
def test_every_figure_becomes_a_file(grid, tmp_path, figure, capsys):
    assert main([str(grid), "--figure", figure, "--output", str(tmp_path / "out"), "--dpi", "40"]) == 0
    assert capsys.readouterr().out.strip().endswith(f"grid_{figure}.png")
    assert (tmp_path / f"out/grid_{figure}.png").stat().st_size > 1000


def test_a_legend_has_tables_by_their_paths_and_only_those_with_a_result(tmp_path):
    tables = np.array(["tables/a_b.txt", "tables/none.txt", "c_d"], dtype=h5py.string_dtype()).repeat(2).astype(object)
    columns = {"lift.table": (tables, "1"), "operating_point.speed_rpm": ([600.0, 900.0] * 3, "rpm")}
    path = write(tmp_path / "tables.h5", columns, np.array([1.0, 2.0, np.nan, np.nan, 3.0, 4.0]), [0, 0, 3, 3, 0, 0])
    figure = draw_curves(Sweep(path, ["mean_torque_drive"]))
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["c_d", "tables/a_b.txt"]
    assert "no case of lift table = tables/none.txt has a result, 2 of 6 cases have no result" in figure.get_suptitle().replace("\n", " ")


@pytest.mark.parametrize(("arguments", "words"), [
    (["--quantity", "torque_drive"], "there is mean_torque_drive"),
    (["--figure", "map"], "a map needs a grid"),
])
def test_what_does_not_suit_is_told(sample, capsys, arguments, words):
    assert main([str(sample), *arguments]) == 2
    assert words in capsys.readouterr().err


def test_what_is_no_sweep_or_not_complete(grid, tmp_path, capsys):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1
    write(tmp_path / "one.h5", {}, [1.0])
    with h5py.File(grid, "a") as file:
        file.attrs["complete"] = 0
    for name, words in (("other.h5", "not a result file of camroller"), ("one.h5", "nothing varies"), ("grid.h5", "not complete")):
        assert main([str(tmp_path / name)]) == 2
        assert words in capsys.readouterr().err
    assert not list(tmp_path.glob("*.png"))


def test_a_valve_that_never_meets_its_seat_has_no_speed(grid):
    with h5py.File(grid, "a") as file:
        file["summary/seating_speed"] = np.where(np.arange(180) == 7, 0.0, 0.0659)
        file["summary/seating_speed"].attrs["units"] = "m s-1"
    values, label = Sweep(grid, ["seating_speed"]).quantities["seating_speed"]
    assert label == "seating speed [mm/s]" and np.flatnonzero(np.isnan(values)).tolist() == [7] and np.nanmin(values) == pytest.approx(65.9)


def test_conditions_leave_out_cases_and_are_told(grid, capsys):
    whole, fast = Sweep(grid, ["mean_torque_drive"]), Sweep(grid, ["mean_torque_drive"], ["speed_rpm >= 600", "mean_torque_drive<12"])
    values = {name: sweep.quantities["mean_torque_drive"][0] for name, sweep in (("whole", whole), ("fast", fast))}
    kept = (whole.keys["operating_point.speed_rpm"][0] >= 600) & (values["whole"] < 12)
    assert 0 < kept.sum() < len(kept)
    assert np.array_equal(np.isfinite(values["fast"]), kept) and np.array_equal(values["fast"][kept], values["whole"][kept])
    assert f"{kept.sum()} of 180 cases have speed_rpm >= 600 and mean_torque_drive<12" in draw_scatter(fast).get_suptitle().replace("\n", " ")
    for wrong, words in (("speed_rpm", "takes NAME < NUMBER"), ("sped_rpm > 3", "no summary and no key 'sped_rpm'"),
                         ("speed_rpm > 1e9", "no case has"), ("law > 3", "law=WORD"), ("law=moss", "no case has")):
        assert main([str(grid), "--where", wrong]) == 2
        assert words in capsys.readouterr().err


@pytest.mark.parametrize("condition", ["law=pan_hamrock", "film.law = Pan_Hamrock", "speed_rpm=300,900", "speed=300:500"])
def test_values_of_swept_keys_choose_as_in_tables(grid, condition):
    kept = np.isfinite(Sweep(grid, ["mean_torque_drive"], [condition]).quantities["mean_torque_drive"][0])
    chosen = set(chosen_cases(read_result(grid), [condition]))
    assert 0 < len(chosen) < 180 and set(np.flatnonzero(kept)) == chosen - {4}  # which has no result


def test_words_choose_designs_and_none_is_taken_of_several(grid, capsys):
    bounded = Sweep(grid, ["mean_torque_drive"], ["law=moes"], ["speed_rpm"])
    kept = np.isfinite(bounded.quantities["mean_torque_drive"][0])
    assert set(bounded.words["film.law"][bounded.keys["film.law"][0][kept].astype(int)]) == {"moes"}
    assert main([str(grid), "--over", "speed_rpm,oil_temperature_degC,law"]) == 2
    assert "nothing else varies" in capsys.readouterr().err
    assert main([str(grid), "--where", "law=moes", "--over", "law"]) == 2
    assert "law holds words, of which --over can take no largest one" in capsys.readouterr().err


def test_a_film_that_is_not_there_is_not_drawn_as_a_thin_one(grid):
    with h5py.File(grid, "a") as file:
        file["summary/min_film_thickness_min"] = np.where(np.arange(180) < 3, 0.0, 2.5e-7)
        file["summary/min_film_thickness_min"].attrs["units"] = "m"
    values = Sweep(grid, ["min_film_thickness_min"]).quantities["min_film_thickness_min"][0]
    assert np.isnan(values[:3]).all() and np.allclose(values[3:], 0.25)
    smallest = Sweep(grid, ["min_film_thickness_min"], over=["speed_rpm"], take="smallest").quantities["min_film_thickness_min"][0]
    assert np.isnan(smallest[:3]).all() and np.allclose(smallest[3:], 0.25)


def test_cases_that_lose_contact_are_marked_and_counted(grid):
    """Nine of the cases of the law that is drawn, one of the other."""
    lost = np.zeros(180)
    lost[160:178:2], lost[1] = 0.1, 0.2
    with h5py.File(grid, "r+") as file:
        file["summary/lost_contact_share"] = lost
    sweep = Sweep(grid, ["mean_torque_drive"])
    for draw, words in ((draw_map, "9 of 90 cases (crosses)"), (draw_curves, "9 of 90 cases (open circles)"),
                        (draw_scatter, "10 of 180 cases (circles)"), (draw_parallel, "10 of 180 cases")):
        assert f"contact is lost in {words}" in draw(sweep).get_suptitle().replace("\n", " ")
    crosses, = draw_map(sweep).axes[0].lines
    assert np.array_equal(crosses.get_xdata(), sweep.keys["operating_point.speed_rpm"][0][160:178:2])
    circles = [line for line in draw_curves(sweep).axes[0].lines if line.get_markerfacecolor() == "white"]
    assert sum(len(line.get_xdata()) for line in circles) == 9
    assert len(draw_scatter(sweep).axes[0].collections[1].get_offsets()) == 10
    assert "lost" not in draw_map(Sweep(grid, ["mean_torque_drive"], ["speed_rpm < 800"])).get_suptitle()


def test_a_map_ends_where_the_results_do(grid):
    axes = draw_map(Sweep(grid, ["mean_torque_drive"])).axes[0]
    assert axes.get_xlim() == (300, 900) and axes.get_ylim() == (40, 120)


def test_numbers_along_the_lower_axis_tell_close_values_apart(tmp_path):
    path = write(tmp_path / "near.h5", {"a.x": ([1.2345678e-3, 1.2345679e-3, 1.234568e-3], "1")}, [1.0, 2.0, 3.0])
    for draw in (draw_curves, draw_scatter):
        figure = draw(Sweep(path, ["mean_torque_drive"]))
        figure.draw_without_rendering()
        axis = figure.axes[0].xaxis
        assert [text.get_text() for text in axis.get_ticklabels()] == ["0.0012345678", "0.001234568"]
        assert not axis.get_offset_text().get_text()


def test_a_limit_that_is_never_reached_is_told_from_no_result(grid, capsys):
    with h5py.File(grid, "r+") as file:
        file["summary/margin"], file["summary/nothing"] = np.full(180, np.inf), np.full(180, np.nan)
    assert main([str(grid), "--quantity", "margin"]) == 2
    assert "no case has a finite value of margin; infinity stands for a limit" in capsys.readouterr().err
    assert main([str(grid), "--quantity", "nothing"]) == 2
    assert "no case has a value of nothing\n" in capsys.readouterr().err


def test_keys_that_are_not_shown_have_a_value_that_the_conditions_leave(grid):
    """The first value of the file is that of another law, which the condition leaves out."""
    sweep = Sweep(grid, ["mean_torque_drive"], ["law=pan_hamrock"])
    for draw in (draw_map, draw_curves):
        figure = draw(sweep)
        assert "film law = pan hamrock" in figure.get_suptitle().replace("\n", " ")
    assert np.ma.count(draw_map(sweep).axes[0].collections[0].get_array()) == 90
    assert all(np.isfinite(line.get_ydata()).any() for line in draw_curves(sweep).axes[0].lines)


def test_a_partial_sweep_says_what_was_not_computed(grid):
    with h5py.File(grid, "a") as file:
        file["summary/status"][6:10] = -1
        file["summary/mean_torque_drive"][6:10] = np.nan
    words = draw_map(Sweep(grid, ["mean_torque_drive"])).get_suptitle().replace("\n", " ")
    assert "4 of 180 cases were not computed, 1 of 180 cases have no result" in words


def test_an_axis_of_words_names_all_of_them(tmp_path):
    laws = ["dowson_higginson", "masjedi_khonsari", "moes", "pan_hamrock"]
    path = write(tmp_path / "laws.h5", {"film.law": (np.array(laws, dtype=h5py.string_dtype()).astype(object), "1")}, [1.0, 2.0, 3.0, 4.0])
    texts = {text.get_text(): text for text in draw_parallel(Sweep(path, ["mean_torque_drive"])).axes[0].texts}
    assert {law.replace("_", " ") for law in laws} <= set(texts)
    assert [texts[law].xy[1] for law in ("masjedi khonsari", "moes")] == pytest.approx([1 / 3, 2 / 3])


def test_values_that_are_the_same_but_for_rounding_have_an_axis_about_them(tmp_path):
    sweep = Sweep(write(tmp_path / "one.h5", {"a.x": ([1.0, 2.0, 3.0], "1")}, [64.0, 64.0 + 6e-11, 64.0 - 6e-11]), ["mean_torque_drive"])
    low, high = draw_curves(sweep).axes[0].get_ylim()
    assert low < 61 and high > 67


def test_what_to_take_needs_cases_that_count_as_one(grid, capsys):
    assert main([str(grid), "--take", "mean"]) == 2
    assert "give with --over the keys that they differ in" in capsys.readouterr().err
