"""Surfaces over hours of running: films, worn depths, friction (`/running_in` of a result file)."""

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
import numpy as np

from layout import line_style
from parts import head, least_shown, legend_height, linear_axis, log_axis, wrap_labels
from quantities import Missing
from units import factor, fitting_unit, unit_words

WIDTH, HEIGHT = 9.0, 7.4  # of the figure without the lines of its legend after the first [inch]
# Title, unit (blank: that which suits the values), names of the history with words for each line
PANELS = (("thickness of the tribofilm", "nm", (("largest_cam_film", "cam, largest"), ("mean_cam_film", "cam, mean"), ("roller_film", "roller"))),
          ("worn depth", "", (("largest_cam_wear", "cam, largest"), ("mean_cam_wear", "cam, mean"), ("roller_wear", "roller"))),
          ("mean boundary coefficient", "1", (("mean_boundary_coefficient", ""),)),
          ("mean friction torque of the follower", "N mm", (("mean_friction_torque", ""),)))


def running_in_figure(layout, _whole_cycle=None):
    """What becomes of cam and roller over hours, a colour for each case, a line style for each surface."""
    layout.refuse_too_many()
    entries = [entry for entry in layout.entries if "time" in layout.results[entry.file].history
               and np.isfinite(layout.results[entry.file].history["time"].values[entry.case]).all()]
    if not entries:
        raise Missing("hours of running: &running_in")
    cases = [Line2D([], [], color=f"C{number % 10}", label=layout.entry_words(entry)) for number, entry in enumerate(entries)]
    legend = wrap_labels(cases, WIDTH) if len(entries) > 1 else [], None
    figure = Figure(figsize=(WIDTH, HEIGHT + legend_height(legend, WIDTH)), layout="constrained")
    for axes, (title, unit, lines) in zip(figure.subplots(2, 2, sharex=True).flat, PANELS):
        unit, floor = _draw(axes, layout, entries, unit, [name for name, _ in lines])
        axes.set_ylabel(f"{title} [{unit_words(unit)}]")
        if floor:
            log_axis(axes, floor, axes.dataLim.ymax)
        else:
            linear_axis(axes, 0.0, axes.dataLim.ymax)
        if len(lines) > 1:
            axes.legend(handles=[Line2D([], [], color="C0" if len(entries) == 1 else "0.3", linestyle=line_style(place), label=words)
                                 for place, (_, words) in enumerate(lines)], fontsize="x-small", handlelength=3.0)
        axes.grid(alpha=0.3)
    for axes in figure.axes[2:]:
        axes.set_xlabel("running time [h]")
    head(figure, layout, "surfaces over hours of running", legend, [], [name for *_, lines in PANELS for name, _ in lines])
    return figure


def _draw(axes, layout, entries, unit, names):
    """Lines of one panel, in a unit or in the one that suits them; returns the unit and where a logarithmic axis ends below, 0 for another."""
    histories = [(layout.results[entry.file].history, entry.case) for entry in entries]
    tops = [max(np.nanmax(history[name].values[case]) for name in names) for history, case in histories]
    of_file = histories[0][0][names[0]].units
    unit, scale = (unit, factor(of_file, unit)) if unit else fitting_unit(names[0], of_file, tops)
    for number, (history, case) in enumerate(histories):
        for place, name in enumerate(names):
            axes.plot(history["time"].values[case] / 3600.0, scale * history[name].values[case], color=f"C{number % 10}",
                      linestyle=line_style(place))
    return unit, scale * least_shown(tops)
