"""Surfaces over hours of running: films, worn depths, friction (`/running_in` of a result file)."""

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
import numpy as np

from layout import line_style
from parts import head, legend_height, wrap_labels
from quantities import Missing
from units import unit_words

WIDTH, HEIGHT = 9.0, 7.4  # of the figure without the lines of its legend after the first [inch]
# Title, unit, factor from the file's unit, names of the history with words for each line
PANELS = (("thickness of the tribofilm", "nm", 1e9, (("largest_cam_film", "cam, largest"), ("mean_cam_film", "cam, mean"), ("roller_film", "roller"))),
          ("worn depth", "pm", 1e12, (("largest_cam_wear", "cam, largest"), ("mean_cam_wear", "cam, mean"), ("roller_wear", "roller"))),
          ("mean boundary coefficient", "1", 1.0, (("mean_boundary_coefficient", ""),)),
          ("mean friction torque of the follower", "N mm", 1e3, (("mean_friction_torque", ""),)))


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
    for axes, (title, unit, factor, lines) in zip(figure.subplots(2, 2, sharex=True).flat, PANELS):
        for number, entry in enumerate(entries):
            history = layout.results[entry.file].history
            for place, (name, _) in enumerate(lines):
                axes.plot(history["time"].values[entry.case] / 3600.0, factor * history[name].values[entry.case], color=f"C{number % 10}",
                          linestyle=line_style(place))
        axes.set_ylabel(f"{title} [{unit_words(unit)}]")
        axes.set_ylim(bottom=0.0)
        if len(lines) > 1:
            axes.legend(handles=[Line2D([], [], color="C0" if len(entries) == 1 else "0.3", linestyle=line_style(place), label=words)
                                 for place, (_, words) in enumerate(lines)], fontsize="x-small", handlelength=3.0)
        axes.grid(alpha=0.3)
    for axes in figure.axes[2:]:
        axes.set_xlabel("running time [h]")
    head(figure, layout, "surfaces over hours of running", legend, [])
    return figure
