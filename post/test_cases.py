"""Any set of cases is drawn, each with a label of its own, or a choice is asked for: grids, lists, samples, files of sweeps."""

import h5py
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
import numpy as np
import pytest

import figures
from figures import FIGURES, WITHOUT_SERIES, draw
from layout import MOST_LISTED, Layout, thin_out, wrapped
from parts import event_window
from plot import main
import plot_sweep
from quantities import CURVES, Missing
from read import ResultError, read_result
import report
import table
from test_post import OIL, SPEED, write_result

ZIP = [(300.0, 25.0), (600.0, 60.0), (900.0, 95.0)]
LABELS = ["300 rev/min, 25 °C", "600 rev/min, 60 °C", "900 rev/min, 95 °C"]
SINGLE = [name for name in CURVES if name != "total_torque"]


def hypercube(count):
    """Points of a Latin hypercube, no value twice."""
    places = np.random.default_rng(1).permuted(np.tile(np.arange(count), (2, 1)), axis=1)
    return [(300.0 + 1000.0 * speed / count, 20.0 + 80.0 * oil / count) for speed, oil in places.T]


def without_series(path, kept=()):
    """The file as a sweep writes it: a status, and series of the cases kept or none at all."""
    with h5py.File(path, "a") as file:
        count = file["case"].size
        file["summary/status"] = np.zeros(count, dtype="i4")
        if not kept:
            del file["series"]
            file.create_group("series")
        for name, data in file["series"].items():
            if name != "cam_angle":
                blank(data, ~np.isin(np.arange(count), kept))
    return path


def blank(data, rows):
    """No numbers in these rows of a dataset."""
    values = data[()]
    values[rows] = np.nan
    data[...] = values


def curves(axes):
    """Curves in axes, without the line at the nose and that at zero."""
    return [line for line in axes.lines if len(line.get_xdata()) > 2]


def legend(figure):
    """Labels of the legends of a page."""
    return [text.get_text() for page in (figure, *figure.subfigs) for made in page.legends for text in made.get_texts()]


def title(figure):
    """Words above a page."""
    page = figure.subfigs[0] if figure.subfigs else figure
    return "".join(made.get_title().get_text() for made in page.legends)


@pytest.fixture(name="zipped")
def fixture_zipped(tmp_path):
    return write_result(tmp_path / "zip.h5", points=ZIP, step=15.0)


@pytest.mark.parametrize("name", SINGLE)
def test_lists_side_by_side_have_a_curve_and_a_label_for_each_case(zipped, name):
    figure = draw(name, Layout([read_result(zipped)]))
    assert len(figure.axes) == 1 and len(curves(figure.axes[0])) == 3
    assert legend(figure) == LABELS
    assert "the same at each" not in title(figure)
    drawn = [(str(line.get_color()), str(line.get_linestyle())) for line in curves(figure.axes[0])]
    assert len(set(drawn)) == 3


THIRD = "film.law"


def test_figures_of_several_keys_are_thinned_out_key_by_key():
    """With five temperatures and two laws, laws stay together at each temperature that is left."""
    layout = object.__new__(Layout)
    layout.colour_key, layout.colours, layout.panel_keys = SPEED, [300.0, 600.0], [OIL, THIRD]
    layout.short_names = {SPEED: "speed", OIL: "oil temperature", THIRD: "film law"}
    layout.panels = [(oil, law) for oil in (25.0, 40.0, 60.0, 80.0, 95.0) for law in ("moes", "pan_hamrock")]
    layout.entries, layout.files = [], []
    assert layout.shown_panels(4) == [(25.0, "moes"), (25.0, "pan_hamrock"), (95.0, "moes"), (95.0, "pan_hamrock")]
    assert len(layout.shown_panels(9)) == 8 and layout.shown_panels(10) == layout.panels
    # with one panel left of two laws, the title says so, and it counts values of each key
    assert layout.shown_panels(3) == [(25.0, "moes"), (25.0, "pan_hamrock")]
    assert layout.shown_words([300.0], layout.shown_panels(4)) == ["1 of 2 values of speed shown", "2 of 5 values of oil temperature shown"]
    assert layout.shown_words([300.0, 600.0], layout.panels) == []
    # panels that are not each value with each other are spread as they come
    layout.panels = layout.panels[::3]
    assert layout.shown_panels(2) == [layout.panels[0], layout.panels[-1]]
    assert layout.shown_words([300.0, 600.0], layout.panels[:2]) == ["2 of 4 pairs of oil temperature and film law shown"]


def test_an_overview_says_what_curves_and_bars_leave_out(tmp_path):
    figure = draw("overview", Layout([read_result(write_result(tmp_path / "ten.h5", oils=tuple(range(20, 120, 10)), step=15.0))]))
    assert "in the curves 4 of 10 values of oil temperature shown, in the bars 9 of 10 values of oil temperature shown" in title(figure)


def test_labels_are_cut_between_words():
    assert wrapped("25 °C, masjedi_khonsari_rough", 18) == "25 °C, masjedi_\nkhonsari_rough"
    assert wrapped("dowson_higginson", 8) == "dowson_\nhigginson" and wrapped("moes", 2) == "moes"


def test_a_sweep_without_series_says_how_to_keep_them(tmp_path):
    path = without_series(write_result(tmp_path / "bare.h5", step=15.0))
    with pytest.raises(Missing, match="load_error.*only with series = 'all' or 'chosen' in &sweep"):
        draw("train", Layout([read_result(path)]))
    with pytest.raises(Missing, match="no load_error in the file$"):
        draw("train", Layout([read_result(write_result(tmp_path / "rigid.h5", without=("load_error",), step=15.0))]))


def test_an_overview_of_lists_has_every_case_in_every_panel(zipped):
    figure = draw("overview", Layout([read_result(zipped)]))
    panels, bars = figure.subfigs[0].axes, figure.subfigs[1].axes
    assert len(panels) == 8 and all(len(curves(axes)) == 3 for axes in panels)
    assert legend(figure)[:3] == LABELS
    assert [text.get_text() for text in bars[0].get_yticklabels()] == LABELS
    assert len(bars[0].patches) == 3 and len(bars[1].patches) == 3 * 4
    # both charts have the labels of the left one, so their bars are at the same heights
    assert bars[0].get_ylim() == bars[1].get_ylim()


def test_parts_of_the_torque_of_lists_have_a_panel_for_each_case(zipped):
    figure = draw("drive_torque", Layout([read_result(zipped)]))
    assert [axes.get_title() for axes in figure.axes] == LABELS
    assert all(len(curves(axes)) == 3 for axes in figure.axes)


def test_a_hypercube_is_drawn_case_by_case(tmp_path):
    result = read_result(write_result(tmp_path / "cube.h5", points=hypercube(MOST_LISTED), step=15.0))
    for name in ("film", "slip", "overview"):
        figure = draw(name, Layout([result]))
        panels = figure.subfigs[0].axes if figure.subfigs else figure.axes
        assert all(len(curves(axes)) == MOST_LISTED for axes in panels)
        assert len(set(legend(figure)[:MOST_LISTED])) == MOST_LISTED
    drawn = [(str(line.get_color()), str(line.get_linestyle())) for line in curves(panels[0])]
    assert len(set(drawn)) == MOST_LISTED


@pytest.mark.parametrize("figure", ["all", "film", "drive_torque", "overview"])
def test_too_many_cases_that_are_no_grid_have_to_be_chosen(tmp_path, capsys, figure):
    path = write_result(tmp_path / "cube.h5", points=hypercube(MOST_LISTED + 1), step=30.0)
    assert main([str(path), "--figure", figure]) == 2
    message = capsys.readouterr().err
    assert message.count("\n") == 1 and f"{MOST_LISTED + 1} cases" in message and "--cases" in message
    assert not list(tmp_path.glob("*.png"))


def test_the_choice_that_the_message_shows_works(tmp_path, capsys):
    path = write_result(tmp_path / "cube.h5", points=hypercube(40), step=30.0)
    assert main([str(path), "--figure", "film"]) == 2
    example = capsys.readouterr().err.split(" or --cases ")[1].split(";")[0]
    assert main([str(path), "--figure", "film", "--cases", example]) == 0
    figure = draw("film", Layout([read_result(path)], [example]))
    assert 1 < len(curves(figure.axes[0])) <= MOST_LISTED


def test_bars_hold_more_cases_than_curves(tmp_path):
    result = read_result(write_result(tmp_path / "cube.h5", points=hypercube(30), step=30.0))
    figure = draw("mean_torque", Layout([result]))
    assert len(figure.axes[0].get_yticklabels()) == 30 and len(figure.axes[0].patches) == 30 * 4
    with pytest.raises(ResultError, match="too many"):
        draw("mean_torque", Layout([read_result(write_result(tmp_path / "big.h5", points=hypercube(60), step=90.0))]))


def test_a_part_of_a_grid_that_is_none_is_a_list(tmp_path):
    result = read_result(write_result(tmp_path / "nine.h5", step=15.0))
    assert Layout([result], ["speed=300"]).is_list is False
    layout = Layout([result], ["0,4,8"])
    assert layout.is_list and layout.colours == LABELS
    assert len(curves(draw("film", layout).axes[0])) == 3


def test_cases_alike_are_told_apart_by_their_numbers(tmp_path):
    result = read_result(write_result(tmp_path / "twice.h5", points=[ZIP[0], ZIP[0], ZIP[1]], step=15.0))
    assert Layout([result]).colours == ["case 0, 300 rev/min, 25 °C", "case 1, 300 rev/min, 25 °C", "case 2, 600 rev/min, 60 °C"]


def test_near_values_are_told_apart_by_their_digits(tmp_path):
    points = [(1000.01, 25.0), (1000.02, 60.0), (25000.0, 95.0)]
    result = read_result(write_result(tmp_path / "near.h5", points=points, step=15.0))
    assert Layout([result]).colours == ["1000.01 rev/min, 25 °C", "1000.02 rev/min, 60 °C", "25000 rev/min, 95 °C"]


def test_a_range_chooses_cases(zipped):
    result = read_result(zipped)
    assert [entry.case for entry in Layout([result], ["speed=400:"]).entries] == [1, 2]
    assert [entry.case for entry in Layout([result], ["speed_rpm=300:600"]).entries] == [0, 1]


def test_failed_cases_of_a_list_have_no_label_and_those_of_a_grid_no_curve(tmp_path):
    for name, points in (("zip", ZIP), ("grid", None)):
        path = write_result(tmp_path / f"{name}.h5", points=points, step=15.0)
        with h5py.File(path, "a") as file:
            file["summary/status"] = np.array([0, 3, 0] * (file["case"].size // 3))
            for group in ("series", "summary"):
                for data in file[group].values():
                    if data.name not in ("/series/cam_angle", "/summary/status"):
                        blank(data, file["summary/status"][()] == 3)
    assert Layout([read_result(tmp_path / "zip.h5")]).colours == [LABELS[0], LABELS[2]]
    figure = draw("film", Layout([read_result(tmp_path / "grid.h5")]))
    words = [[text.get_text() for text in axes.texts] for axes in figure.axes]
    assert words == [[], ["no result"], []]
    bars = draw("mean_torque", Layout([read_result(tmp_path / "grid.h5")])).axes[0]
    assert [text.get_text() for text in bars.texts].count("no result") == 3


def test_no_case_with_a_result_is_an_error(zipped, capsys):
    with h5py.File(zipped, "a") as file:
        file["summary/status"] = np.array([3, 3, 3])
        file["run/messages"] = ["nothing converges"] * 3
    for script, arguments in ((main, []), (report.main, []), (table.main, []), (table.main, ["--columns", "none_of_it"]),
                              (plot_sweep.main, [])):
        assert script([str(zipped), *arguments]) == 2
        assert "no case has a result: nothing converges\n" in capsys.readouterr().err


def test_of_chosen_cases_the_failed_ones_are_told(tmp_path, capsys):
    path = write_result(tmp_path / "nine.h5", step=15.0)
    with h5py.File(path, "a") as file:
        file["summary/status"] = [0, 3, 0, 0, 0, 0, 0, 0, 3]
        file["run/messages"] = ["", "case 1 (a.x=2, a.y=3): no balance", *[""] * 7]
    assert main([str(path), "--cases", "0-3", "--figure", "load"]) == 0
    words = capsys.readouterr().out
    assert "nine.h5: case 1 has no result: a.x=2, a.y=3: no balance\n" in words and "case 8" not in words


def test_a_sweep_without_series_has_all_drawn_that_needs_none(tmp_path, capsys):
    path = without_series(write_result(tmp_path / "sweep.h5", points=ZIP, step=15.0))
    assert main([str(path)]) == 0
    said = capsys.readouterr().out
    assert said.count("no series in") == 1 and "plot_sweep.py" in said
    assert sorted(made.name for made in tmp_path.glob("*.png")) == sorted(f"sweep_{name}.png" for name in WITHOUT_SERIES)
    assert {"dampers", "turns", "running_in"} < set(WITHOUT_SERIES)
    assert main([str(path), "--figure", "film"]) == 2
    figure = draw("mean_torque", Layout([read_result(path)]))
    assert len(figure.axes[0].patches) == 3 * 4


def test_of_a_sweep_with_few_series_these_are_drawn(tmp_path, capsys):
    path = without_series(write_result(tmp_path / "sweep.h5", step=15.0), kept=(1, 5))
    layout = Layout([read_result(path)])
    assert [entry.case for entry in layout.entries] == [1, 5]
    assert len(curves(draw("film", layout).axes[0])) == 2
    assert main([str(path), "--figure", "film"]) == 0
    assert "series of 2 of 9 cases" in capsys.readouterr().out
    assert main([str(path), "--figure", "film", "--cases", "2"]) == 2
    assert "no series of these cases in the file; it has those of 1, 5" in capsys.readouterr().err
    with h5py.File(path, "a") as file:
        file["summary/status"][...] = [0, 0, 0, 3, 0, 0, 0, 3, -1]
        file["run/messages"] = ["", "", "", "case 3: no balance", "", "", "", "case 7: no film", "case 8: not computed"]
    failed = "sweep.h5: 1 of {} cases was not computed; case 3 has no result: no balance; case 7 has no result: no film"
    for cases, words in (("3,7,8", failed.format(3) + "\n"),
                         ("2,3,7,8", failed.format(4) + "; no series of the other chosen cases in the file; it has those of 1, 5")):
        assert main([str(path), "--figure", "film", "--cases", cases]) == 2
        assert words in capsys.readouterr().err


@pytest.mark.parametrize("name, count", [("film", 3), ("overview", 24), ("drive_torque", 9)])
def test_a_grid_has_a_panel_for_each_value_of_the_second_key(tmp_path, name, count):
    figure = draw(name, Layout([read_result(write_result(tmp_path / "nine.h5", step=15.0))]))
    panels = figure.subfigs[0].axes if figure.subfigs else figure.axes
    assert len(panels) == count and all(len(curves(axes)) == 3 for axes in panels)


def test_upright_values_of_short_bars_stay_within_the_axes(tmp_path):
    """A small negative slip between large ones."""
    path = write_result(tmp_path / "grid.h5", oils=(25.0, 60.0, 95.0))
    with h5py.File(path, "a") as file:
        file["summary/mean_slip_ratio"][...] = [0.144, 0.293, 0.2, 0.31, -0.00112, 0.223, np.nan, 0.0401, -0.00456]
    for name in ("mean_slip", "overview"):
        figure = draw(name, Layout([read_result(path)]))
        figure.canvas.draw()
        axes = next(axes for part in (figure, *figure.subfigs) for axes in part.axes if axes.get_ylabel() == "mean slip ratio [%]")
        texts = [text for text in axes.texts if text.get_rotation() == 90]
        assert len(texts) == 9 and {"-0.112", "-0.456"} <= {text.get_text() for text in texts}
        for box in (text.get_window_extent() for text in texts):
            assert axes.bbox.y0 <= box.y0 and box.y1 <= axes.bbox.y1, name


def test_bars_of_a_grid_have_values_that_do_not_overlap(tmp_path):
    """Values stand above the bars where they fit beside each other, else upright."""
    for speeds, turn in (((300.0, 900.0), 0.0), (tuple(np.linspace(310, 890, 12)), 90.0)):
        result = read_result(write_result(tmp_path / f"{len(speeds)}.h5", speeds=speeds, step=30.0))
        figure = draw("mean_slip", Layout([result]))
        figure.canvas.draw()
        texts = figure.axes[0].texts
        assert len(texts) == 3 * len(speeds) and {text.get_rotation() for text in texts} == {turn}
        boxes = sorted((text.get_window_extent().x0, text.get_window_extent().x1) for text in texts)
        assert all(left[1] <= right[0] for left, right in zip(boxes, boxes[1:]))


def two_files(tmp_path, **options):
    """Results of two files that differ by a factor."""
    return [read_result(write_result(tmp_path / f"{name}.h5", title=name, factor=factor, step=15.0, **options))
            for name, factor in (("a", 1.0), ("b", 1.1))]


@pytest.mark.parametrize("options, selection", [({}, ()), ({}, ("4",)), ({"points": ZIP}, ()),
                                                ({"speeds": (300.0,), "oils": (60.0,), "swept": ()}, ())],
                         ids=["grid", "one case", "list", "no sweep"])
def test_two_files_have_no_colour_in_common(tmp_path, options, selection):
    layout = Layout(two_files(tmp_path, **options), selection)
    for name in ("film", "drive_torque"):
        for axes in draw(name, layout).axes:
            lines = curves(axes)
            colours = [[str(line.get_color()) for line in part] for part in
                       ((lines[:len(lines) // 2], lines[len(lines) // 2:]) if name == "film" else (lines[0::2], lines[1::2]))]
            assert not set(colours[0]) & set(colours[1])
    bars = draw("mean_slip", layout).axes[0].patches
    tones = [{str(bar.get_facecolor()) for bar in bars if bool(bar.get_hatch()) is hatched} for hatched in (False, True)]
    assert tones[0] and tones[1] and not tones[0] & tones[1]


def test_the_legend_of_two_files_names_every_curve(tmp_path):
    figure = draw("film", Layout(two_files(tmp_path)))
    values = ["300 rev/min", "600 rev/min", "900 rev/min"]
    assert legend(figure) == ["a", *values, "b", *values]


LONG = "rig of the second campaign with new followers, oil of the third delivery, roller of 8.5 mm with the profile of its supplier, "


ONE = {"swept": (), "speeds": (300.0,), "oils": (60.0,)}
GROUPED = [name for name in FIGURES if name not in CURVES or name == "slip"]  # a curve is drawn as the others are


@pytest.mark.parametrize("count, points", [(2, ONE), (5, ONE), (3, {"speeds": (300.0, 900.0), "oils": (25.0, 95.0)})],
                         ids=["two", "five", "grids"])
@pytest.mark.parametrize("name", GROUPED)
def test_long_titles_of_files_stay_within_the_figure(tmp_path, name, count, points):
    """Titles of 510 characters, of words and without blanks, that begin alike, and one of 60: every file is named, nothing is cut off."""
    titles = [f"{4 * LONG}, at last"[:510], f"{4 * LONG}, at first"[:510], LONG[:60], "x_" * 255, "y_" * 255][:count]
    results = [read_result(write_result(tmp_path / f"rig_{number}.h5", title=title, step=15.0, **points))
               for number, title in enumerate(titles)]
    layout = Layout(results, ("speed_rpm=300",) if name in ("turns", "running_in", "roller") else ())
    figure = draw(name, layout)
    figure.draw_without_rendering()
    pages = (figure, *figure.subfigs, *(part for page in figure.subfigs for part in page.subfigs))
    shown = [made for page in pages for made in page.legends] + [axes.title for axes in figure.findobj(Axes)]
    for box in [made.get_window_extent() for made in shown]:
        assert box.x0 >= figure.bbox.x0 - 1.0 and box.x1 <= figure.bbox.x1 + 1.0 and box.y1 <= figure.bbox.y1 + 1.0
    words = " ".join(text.get_text() for made in shown for text in made.findobj(Text)).replace("\n", " ")
    assert all(f"(rig_{number}.h5)" in words for number in range(2)) and (count < 3 or LONG[:60] in words)


@pytest.mark.parametrize("name", GROUPED)
def test_files_at_different_operating_points_say_them(tmp_path, name):
    """Where no file sweeps speed or temperature; what is the same in all files is not said."""
    results = [read_result(write_result(tmp_path / f"{title}.h5", title=title, speeds=(speed,), oils=(60.0,), swept=(), step=15.0))
               for title, speed in (("a", 300.0), ("b", 2500.0))]
    assert Layout(results).titles == ["a, 300 rev/min", "b, 2500 rev/min"] and Layout(results[:1]).titles == ["a"]
    figure = draw(name, Layout(results))
    words = " ".join(text.get_text() for text in figure.findobj(Text))
    assert "a, 300 rev/min" in words and "b, 2500 rev/min" in words and "60 °C" not in words


def test_sweeps_at_different_temperatures_say_them(tmp_path):
    results = [read_result(write_result(tmp_path / f"{oil}.h5", oils=(oil,), swept=(SPEED,), step=15.0)) for oil in (60.0, 95.0)]
    assert legend(draw("slip", Layout(results)))[::4] == ["made up (60.0.h5), 60 °C", "made up (95.0.h5), 95 °C"]
    results.append(read_result(write_result(tmp_path / "all.h5", title="all", step=15.0)))
    assert Layout(results).titles == ["made up (60.0.h5)", "made up (95.0.h5)", "all"]


def test_files_that_do_not_fit_beside_each_other_stand_below_each_other(tmp_path):
    results = [read_result(write_result(tmp_path / f"{title}.h5", title=title, step=15.0, **ONE)) for title in "abc"]
    [shown] = draw("drive_torque", Layout(results)).legends
    parts = ["geometric", "friction", "drive: all together"]
    # column by column: the first and the third file, the second one
    assert [text.get_text() for text in shown.get_texts()] == ["a", *parts, "c", *parts, "b", *parts, *[""] * 4]


@pytest.mark.parametrize("name", ["slip", "drive_torque", "overview", "dampers"])
def test_a_file_of_one_case_is_drawn_beside_a_long_sweep(tmp_path, name):
    """One of the values that even spacing would leave out is the only one of the second file."""
    speeds, oils = tuple(np.linspace(300.0, 2200.0, 20)), tuple(np.linspace(20.0, 105.0, 18))
    results = [read_result(write_result(tmp_path / f"{title}.h5", title=title, speeds=one, oils=other, step=15.0))
               for title, one, other in (("long", speeds, oils), ("single", speeds[5:6], oils[4:5]))]
    layout = Layout(results)
    figure = draw(name, layout)
    assert "nothing of" not in title(figure) and "values of oil temperature shown" in title(figure)
    assert (speeds[5], (oils[4],)) in {(entry.colour, entry.panel) for entry in layout.entries_of((oils[4],), layout.shown_colours())}
    assert (oils[4],) in layout.shown_panels(3)
    if name == "slip":
        assert legend(figure)[-len(layout.shown_colours()) - 1:][:2] == ["single", "800 rev/min"]
        lines = [line for axes in figure.axes for line in curves(axes)]
        assert len(lines) == 9 * 7 + 1 and len(layout.shown_colours()) == 7


def test_what_the_second_file_does_not_have_is_said_and_has_no_legend(tmp_path):
    results = [read_result(write_result(tmp_path / f"{title}.h5", title=title, step=15.0, without=without))
               for title, without in (("a", ()), ("b", ("cam_wear_depth",)))]
    figure = draw("wear_depth", Layout(results))
    assert legend(figure) == ["a", "300 rev/min", "600 rev/min", "900 rev/min"] and "nothing of b" in title(figure)


def test_values_with_a_result_are_the_ones_that_are_shown(tmp_path):
    """Of four speeds three fit; the last two, of which even spacing takes one, have no result."""
    path = write_result(tmp_path / "four.h5", speeds=(300.0, 2900.0, 3000.0, 4000.0), oils=(60.0,), swept=(SPEED,), step=15.0)
    with h5py.File(path, "a") as file:
        file["summary/status"] = [0, 0, 3, 3]
        for data in file["series"].values():
            if data.name != "/series/cam_angle":
                blank(data, [2, 3])
    layout = Layout([read_result(path)])
    figure = draw("drive_torque", layout)
    assert [axes.get_title() for axes in figure.axes if curves(axes)] == ["300 rev/min", "2900 rev/min"]
    assert not [text for axes in figure.axes for text in axes.texts] and "2 of 4 values of speed shown" in title(figure)
    figure = draw("slip", layout)
    assert legend(figure) == ["300 rev/min", "2900 rev/min"] and "2 of 4 cases have no result" in title(figure)


@pytest.mark.parametrize("groups, expected", [((), [0, 3, 6, 9]), (({4},), [0, 4, 6, 9]), (({4}, {3}), [0, 3, 4, 9]),
                                              (({1}, {2}, {4}, {5}, {7}), [1, 2, 4, 5, 7])])
def test_thinned_values_have_one_of_every_group(groups, expected):
    assert thin_out(list(range(10)), 4, groups) == expected


def test_torques_of_a_shaft_whose_other_cams_are_at_work_are_shown_for_the_whole_turn(tmp_path):
    path = write_result(tmp_path / "one.h5", step=5.0)
    window = event_window(Layout([read_result(path)]), ["torque_drive"])
    assert window[0] > 0.0 and window[1] < 360.0
    with h5py.File(path, "a") as file:
        file["series/torque_drive"][...] += np.roll(file["series/torque_drive"][()], 30, axis=1)
        file["deck/values/cam_bearings.cam_positions_mm"] = "20, 60"
    layout = Layout([read_result(path)])
    assert event_window(layout, ["torque_drive"]) == (0.0, 360.0)
    assert event_window(layout, ["contact_load"]) == window
    figure = draw("overview", layout)
    assert {axes.get_xlim() for axes in figure.subfigs[0].axes} == {(0.0, 360.0)}
    assert "torques of all 2 cams, all else of the first cam" in title(figure)
    assert title(draw("mean_torque", layout)).endswith("torques of all 2 cams")
    with h5py.File(path, "a") as file:
        file["deck/values/engine.camshafts"] = 2
        file["deck/values/engine.given_speed"] = "crankshaft"
        file["summary/crank_turns"] = np.full(9, 2.0)
    layout = Layout([read_result(path)])
    assert "torques of 2 camshafts with 2 cams each, all else of" in title(draw("overview", layout))


@pytest.mark.parametrize("camshafts, words", [(1, "of the first cam of 3 cams"), (2, "of the first cam of 2 camshafts with 3 cams each")])
def test_a_figure_without_a_torque_of_the_shaft_names_none(tmp_path, camshafts, words):
    """Friction of the follower over hours of running is that of the first cam's, as load, slip and loads along its roller are."""
    path = write_result(tmp_path / "one.h5", swept=(), speeds=(600.0,), oils=(60.0,))
    with h5py.File(path, "a") as file:
        file["deck/values/cam_bearings.cam_positions_mm"] = "20, 40, 60"
        file["deck/values/engine.camshafts"] = camshafts
    layout = Layout([read_result(path)])
    for name in ("running_in", "roller", "load", "mean_slip", "dampers", "turns"):
        shown = title(draw(name, layout)).replace("\n", " ")
        assert words in shown and "torque" not in shown, name
    for name in ("friction_torque", "drive_torque", "friction_sources", "mean_torque"):
        shown = title(draw(name, layout)).replace("\n", " ")
        assert "torques of " in shown and "first" not in shown, name


def test_torques_of_an_engine_are_over_the_crank_angle_too(tmp_path):
    path = write_result(tmp_path / "engine.h5", step=5.0)
    for is_engine in (False, True):
        if is_engine:
            with h5py.File(path, "a") as file:
                cases = len(file["summary/mean_slip_ratio"])
                file["summary/crank_turns"], file["summary/crank_angle_at_nose"] = np.full(cases, 2.0), np.full(cases, 470.0)
        figure = draw("drive_torque", Layout([read_result(path)]), whole_cycle=True)
        figure.draw_without_rendering()
        upper = [child for axes in figure.axes for child in axes.child_axes]
        assert len(upper) == (3 if is_engine else 0)
        for axes in upper:
            words = {round(place): text.get_text() for place, text in zip(axes.get_xticks(), axes.get_xticklabels())}
            # nose of the first cam at 470 degrees of the crank, which turns twice
            assert {angle: words[angle] for angle in (0, 60, 180, 300)} == {0: "110", 60: "230", 180: "470", 300: "710"}
            assert axes.get_xlabel() == "crank angle [deg]"


def test_where_contact_is_lost_there_is_no_film(tmp_path):
    path = write_result(tmp_path / "lost.h5", step=5.0)
    with h5py.File(path, "a") as file:
        lost = np.abs(file["series/cam_angle"][()] - 180.0) < 12.0
        for name in ("contact_load", "film_thickness_min", "asperity_friction_share", "friction_contact"):
            values = file[f"series/{name}"][()]
            values[:, lost] = 0.0
            file[f"series/{name}"][...] = values
        file["summary/lost_contact_share"] = np.full(9, lost.mean())
        file["summary/lobe_2_lost_contact_share"] = np.zeros(9)
    figure = draw("film", Layout([read_result(path)]))
    for line in curves(figure.axes[0]):
        assert np.isnan(line.get_ydata()[:-1][lost]).all() and np.nanmin(line.get_ydata()) > 0.0
    assert figure.axes[0].get_yscale() == "log"
    assert "contact of lobe 1 is lost in 9 of 9 cases" in title(figure)
    for line in curves(draw("friction", Layout([read_result(path)])).axes[0]):
        assert np.isfinite(line.get_ydata()).all()


def test_the_lobe_that_loses_contact_is_named_where_there_are_two(tmp_path):
    path = write_result(tmp_path / "lost.h5", step=30.0)
    with h5py.File(path, "a") as file:
        file["summary/lost_contact_share"] = np.zeros(9)
        file["summary/lobe_2_lost_contact_share"] = np.arange(9) / 9
    words = title(draw("load", Layout([read_result(path)]))).replace("\n", " ")
    assert "contact of lobe 2 is lost in 8 of 9 cases" in words and "contact is lost" not in words
    with h5py.File(path, "a") as file:
        file["summary/lost_contact_share"][3] = 0.1
    words = title(draw("load", Layout([read_result(path)]))).replace("\n", " ")
    assert "contact of lobe 1 is lost in 1 of 9 cases, contact of lobe 2 is lost in 8 of 9 cases" in words
    with h5py.File(path, "a") as file:
        del file["summary/lobe_2_lost_contact_share"]
    assert "contact is lost in 1 of 9 cases" in title(draw("load", Layout([read_result(path)])))


def test_series_and_scalars_that_no_figure_knows_do_no_harm(zipped):
    with h5py.File(zipped, "a") as file:
        for name in ("lobe_2_contact_load", "margin"):
            file[f"series/{name}"] = np.full(file["series/contact_load"].shape, 7.0)
        file["summary/margin_pivot"] = np.ones(3)
        file["summary/margin_words"] = np.array(["a", "b", "c"], dtype="S1")
        file["summary/limits"] = np.ones((3, 2))
    for name in FIGURES:
        assert isinstance(draw(name, Layout([read_result(zipped)])), Figure)


def test_every_kind_of_figure_is_drawn_of_one_case(tmp_path):
    result = read_result(write_result(tmp_path / "one.h5", speeds=(600.0,), oils=(60.0,), swept=(), step=15.0))
    for name in FIGURES:
        figure = draw(name, Layout([result]))
        if name in SINGLE:
            assert [len(curves(axes)) for axes in figure.axes] == [1], name
        assert "made up" in title(figure), name
    assert figures.draw("drive_torque", Layout([result])).axes[0].get_ylabel() == "torque [N m]"


def test_sources_have_the_names_of_the_table_and_adjusters_only_where_there_are_some(tmp_path):
    path = write_result(tmp_path / "nine.h5", step=15.0)
    with h5py.File(path, "a") as file:
        for name in ("series/torque_damping", "summary/mean_torque_damping"):
            file[name] = file[name.replace("damping", "needle")][()]
            file[name].attrs["units"] = "N m"
    for words in ("dampers", "dampers and lash adjuster"):
        for name in ("mean_torque", "friction_sources"):
            names = legend(draw(name, Layout([read_result(path)])))
            assert words in names and "roller bearing" in names and "needle bearing" not in names
        with h5py.File(path, "a") as file:
            file[f"deck/values/lash_adjuster.key_{len(words)}"] = 10.0


def test_a_key_that_is_the_same_in_all_panels_is_said_once(tmp_path):
    layout = Layout([read_result(write_result(tmp_path / "nine.h5", step=15.0))])
    layout.panel_keys, layout.panels = [OIL, SPEED], [(25.0, 300.0), (60.0, 300.0)]
    assert [layout.panel_name(panel) for panel in layout.panels] == ["25 °C", "60 °C"]
    assert layout.common_words() == ["300 rev/min"] and layout.panel_words() == "oil temperature"


def test_swept_words_are_labels(tmp_path):
    path = write_result(tmp_path / "words.h5", points=ZIP, step=15.0)
    with h5py.File(path, "a") as file:
        del file[f"sweep/{OIL}"]
        file["sweep/film.law"] = np.array(["moes", "dowson_higginson", "moes"], dtype="S20")
    layout = Layout([read_result(path)])
    assert layout.colours == ["300 rev/min, moes", "600 rev/min, dowson_higginson", "900 rev/min, moes"] or \
        layout.colours == ["moes, 300 rev/min", "dowson_higginson, 600 rev/min", "moes, 900 rev/min"]
    assert layout.short_names == {SPEED: "speed", "film.law": "film law", "case": "case"}
