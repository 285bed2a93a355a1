"""Tables and sections of the comparison with the source thesis: both decks beside each other, what each choice is
worth, magnitudes, values as printed, and the source's step."""

import numpy as np

from comparison_claims import STATEMENTS, band, by_temperature, largest, listed, percent
from comparison_runs import CHOICES, SPEEDS, TEMPERATURES
from units import significant

WHERE = [(row, column) for row in range(len(SPEEDS)) for column in range(len(TEMPERATURES))]
NAMES = [f"{SPEEDS[row]:.0f}/{TEMPERATURES[column]:.0f}" for row, column in WHERE]


def table(head, rows):
    """Lines of a table."""
    yield "| " + " | ".join(head) + " |"
    yield "|" + "---|" * len(head)
    for row in rows:
        yield "| " + " | ".join(row) + " |"


def coefficient(points):
    """Mean friction force over mean load [-]."""
    return points.scalar("mean_friction_contact") / points.scalar("mean_contact_load")


TORQUE_COLUMNS = [("contact [N mm]", lambda points: points.torque("contact") * 1e3),
                  ("bearings [N mm]", lambda points: points.torque("bearings") * 1e3),
                  ("needle [N mm]", lambda points: points.torque("needle") * 1e3),
                  ("guide [N mm]", lambda points: points.torque("guide") * 1e3),
                  ("all [N mm]", lambda points: points.torque("friction") * 1e3)]
CONTACT_COLUMNS = [("mean slip [%]", lambda points: points.scalar("mean_slip_ratio") * 100.0),
                   ("peak pressure [GPa]", lambda points: points.scalar("max_hertz_pressure") * 1e-9),
                   ("thinnest film [µm]", lambda points: points.scalar("min_film_thickness_min") * 1e6),
                   ("largest contact friction [N]", lambda points: points.scalar("max_friction_contact")),
                   ("mean friction coefficient [-]", coefficient)]


def beside(columns, first, second):
    """A row for each point, the value of the first run before that of the second."""
    pairs = [(value(first), value(second)) for _, value in columns]
    return table(["point", *(title for title, _ in columns)],
                 [[name, *(f"{significant(one[where])} / {significant(two[where])}" for one, two in pairs)]
                  for name, where in zip(NAMES, WHERE)])


def both_decks(runs):
    """thesis.nml and thesis_source.nml at the nine points."""
    first, second = runs["thesis"], runs["thesis_source"]
    speeds = np.abs(first.series("rolling_speed") / first.series("cam_surface_speed") - 1.0)[0, 0]
    yield from ["## Both decks beside each other", "",
                "Points are cam speed in rev/min over oil temperature in °C; the first number is `thesis.nml`, the "
                "second `thesis_source.nml`. Mean torques:", ""]
    yield from beside(TORQUE_COLUMNS, first, second)
    yield from ["", "![Mean friction torque](figures/thesis_vs_thesis_source_mean_torque.png)", "", "The contact:", ""]
    yield from beside(CONTACT_COLUMNS, first, second)
    yield from ["", "![Slip ratio](figures/thesis_vs_thesis_source_slip.png)", "",
                "The mean friction coefficient is mean friction over mean load. Loads, pressures and films are "
                "nearly the same; friction and slip are not, because of how the losses are counted and what turns "
                "the roller. Cold, the largest friction is a short peak at the beginning of the event "
                f"({first.angle[np.argmax(first.series('friction_contact')[2, 0])]:.0f}° at 900 rev/min), where the "
                "load comes back and spins up a roller that has slowed down. The speed of the roller's surface in "
                "pure rolling, which the source takes as the contact's speed over the cam, differs from that by up "
                f"to {percent(speeds.max())} (at {first.angle[speeds.argmax()]:.0f}°).", ""]


def each_choice(runs):
    """What each choice of the source's bookkeeping changes when it alone is made."""
    base = runs["open_energy"]
    yield from ["## What each choice is worth", "",
                "The closed energy balance needs all of its parts, so the first step is to give it up: losses are "
                "then added up as in the source, everything else stays. On top of that, one choice at a time is made "
                "as in the source. Mean friction torque in N mm:", ""]
    runs_shown = [("`thesis.nml`", runs["thesis"]), *((run.words, runs[run.name]) for run in CHOICES),
                  ("`thesis_source.nml`: all together", runs["thesis_source"])]
    yield from table(["run", *NAMES], [[words, *(significant(points.torque("friction")[where] * 1e3)
                                                 for where in WHERE)] for words, points in runs_shown])
    yield from ["", "Mean slip ratio in %:", ""]
    yield from table(["run", *NAMES], [[words, *(significant(points.scalar("mean_slip_ratio")[where] * 100.0)
                                                 for where in WHERE)] for words, points in runs_shown])
    yield ""
    yield from choices_in_words(runs, base)


def choices_in_words(runs, base):
    """Changes against the open balance, with their causes."""
    def change(name):
        return (runs[name].torque("friction") / base.torque("friction") - 1.0) * 100.0

    def span(name):
        values = change(name)
        return f"{values.min():+.1f} to {values.max():+.1f} %"

    closed = (base.torque("friction") / runs["thesis"].torque("friction") - 1.0) * 100.0
    yield from [
        f"- *Losses as in the source* ({closed.min():+.1f} to {closed.max():+.1f} % against `thesis.nml`): the needle "
        "bearing counts twice, once in the traction that keeps the roller turning and once by itself, which shows "
        "most where all else is small. When cold, part of it is made up for by rolling friction, charged on the arm "
        "of the tangent instead of at the speeds of both surfaces.",
        f"- *Arm* ({span('parallel_arm')}): the normal is taken parallel to the valve's axis, which makes the load a "
        "little smaller on average during the event and leaves it on the base circle.",
        f"- *Spin* ({span('thesis_spin')}): the roller turns more slowly at the nose, so the needle bearing takes "
        "less; its inertia asks for more traction, which raises the contact's loss where that is the larger part, "
        "fast and hot.",
        f"- *Boundary friction* ({span('full_boundary')}): counted in full it is the largest change of all, where "
        "films are thin. Slip stays the same, since the roller's own balance has no use for it: nothing in the "
        "mechanism supplies that power.",
        f"- *Rolling law* ({span('goksem_rolling')}): an elastic law on a nearly rigid base circle brakes the roller "
        "more, hence more slip there; during the event it gives less than the law of `thesis.nml`.",
        f"- *Rolling resistance outside the roller's balance* ({span('rolling_apart')}): it no longer brakes the "
        "roller, so slip on the cold base circle falls by an order of magnitude, and the traction that would drive "
        "against it is not charged.",
        ""]


def magnitudes(runs):
    """Losses against what was measured on other roller cams."""
    yield from ["## Magnitudes", "",
                "Bair and others (1986) found 1.75 to 3.9 J per cam revolution for flat followers and 18 % of that "
                "for roller followers: 0.32 to 0.70 J, a mean torque of 0.05 to 0.11 N m. That is the contact of cam and "
                "follower with the roller's bearing, without camshaft bearings and valve guide. Energy lost per cam "
                "revolution, in J, by these two and by all together:", ""]
    works = []
    for name in ("thesis", "thesis_source"):
        works += [runs[name].scalar("work_contact") + runs[name].scalar("work_needle"), runs[name].scalar("work_friction")]
    yield from table(["point", "`thesis.nml`, contact and roller bearing", "all", "`thesis_source.nml`, contact and roller bearing", "all"],
                     [[name, *(significant(work[where]) for work in works)] for name, where in zip(NAMES, WHERE)])
    inside = [int(((work >= 0.32) & (work <= 0.70)).sum()) for work in works[::2]]
    yield from ["", f"Inside the measured range are contact and roller bearing at {inside[0]} of nine points of `thesis.nml` and at "
                    f"{inside[1]} of `thesis_source.nml`; mean torques of all friction go from {band(runs['thesis'].torque('friction'))} N m and from "
                    f"{band(runs['thesis_source'].torque('friction'))} N m. Warm and hot, "
                    "runs of `thesis.nml` lie far below the measured range; the measured train had another geometry, so no "
                    "more than the order of magnitude can be asked for, and hot runs do not reach it.", ""]


def as_printed(runs):
    """Values of Appendix B with their misprints."""
    points = runs["thesis_as_printed"]
    torque = points.series("torque_geometric").max(axis=-1)
    yield from ["## Values as printed", "",
                "`thesis_as_printed.nml` keeps the misprints. Its spring gives a peak pressure of "
                f"{significant(points.scalar('max_hertz_pressure').max() * 1e-9)} GPa (statement 1: 0.64 GPa), "
                f"geometric torques of {listed(torque[:, 0])} N m at the three speeds (statement 10: hardly any "
                "change; `thesis.nml` has ten times as much) and a load that is the adjuster's 64 N for most of the "
                f"event; its guide takes {band(points.share('guide'), 100.0)} % of the friction torque (statement 9: "
                "0.6 to 3 %). It cannot be what the source ran.", ""]


def fixed_step(runs):
    """What the integration with the source's step does to the statements."""
    points, accurate = runs["fixed_step"], runs["thesis_source"]
    total, slip = points.torque("friction"), largest(points, "slip_ratio", (0.0, 360.0))
    gained, lost = [], []
    for statement in STATEMENTS:
        for claim in statement.claims:
            before, after = claim.check(accurate)[0], claim.check(points)[0]
            (gained if after and not before else lost if before and not after else []).append(claim.words)
    yield from ["## The source's step", "",
                "The source integrates the roller with an explicit step and does not state its size; here it is one "
                "degree. The film's traction decays within a small part of that, so the step overshoots and the "
                "sliding speed jumps between the friction limits: chatter, not physics. Its numbers change with "
                "every rounding, so they are given to one digit and not tested. `thesis_source.nml` with this step: "
                f"slip up to {significant(100.0 * slip.min(), 1)} % at the calmest of the nine points and "
                f"{significant(100.0 * slip.max(), 1)} % at the worst, mean friction torque {total.min():.1f} to "
                f"{total.max():.1f} N m instead of {accurate.torque('friction').min():.2f} to "
                f"{accurate.torque('friction').max():.2f} N m, bearings "
                f"{10.0 * round(10.0 * points.share('bearings')[2, 0]):.0f} % of it at 900 rev/min and 25 °C, needle "
                f"bearing {100.0 * points.share('needle').min():.0f} to {100.0 * points.share('needle').max():.0f} "
                "%.", "",
                "Claims that hold with this step and not with an accurate integration, in one build; another, which "
                "rounds differently, may have a few others:", "",
                *(f"- {words}" for words in gained or ["none"]), "",
                "Claims that no longer hold with it, in that build:", "", *(f"- {words}" for words in lost or ["none"]), "",
                "\"Areas of high slip followed at once by very low slip\", which the source reports, are what such a "
                "step gives. Some of its shares and trends are thus those of the step; others hold by chance, and a "
                "step of one degree does not reproduce its figures either: how it stepped remains open.", ""]
