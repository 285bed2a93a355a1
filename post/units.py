"""Units and numbers as people read them: the one place that figures, tables and pages take them from."""

import re

import numpy as np

# Other spellings of a unit
SAME = {"m s-1": "m/s", "m s-2": "m/s2", "N m-1": "N/m", "rad s-1": "rad/s", "-": "1", "": "1", "N*m": "N m", "N.m": "N m", "degree": "deg"}
# Unit of a file: units that it is shown in, the small ones first, each with how many of them one of the file's is
SHOWN = {
    "m": (("pm", 1e12), ("nm", 1e9), ("um", 1e6), ("mm", 1e3), ("m", 1.0)),
    "m2": (("um2", 1e12), ("mm2", 1e6), ("m2", 1.0)),
    "m/s": (("um/s", 1e6), ("mm/s", 1e3), ("m/s", 1.0)),
    "rad/s": (("rev/min", 30.0 / np.pi),),
    "rpm": (("rev/min", 1.0),),
    "N": (("mN", 1e3), ("N", 1.0)),
    "N/m": (("N/mm", 1e-3), ("N/m", 1.0)),
    "N m": (("N mm", 1e3), ("N m", 1.0)),
    "Pa": (("kPa", 1e-3), ("MPa", 1e-6), ("GPa", 1e-9)),
    "W": (("mW", 1e3), ("W", 1.0)),
    "J": (("mJ", 1e3), ("J", 1.0)),
    "s": (("us", 1e6), ("ms", 1e3), ("s", 1.0)),
    "1": (("1", 1.0), ("%", 100.0)),
}
LEAST = 0.1  # of the largest value in the unit that is chosen
PARTS = ("_share", "slip_ratio", "revolution_slip")  # names of parts of a whole, in per cent
OVER_CYCLES = re.compile("_(deviation|lowest|highest)$")  # behind the name of a scalar: what its values over the cycles are like
DEGREE, MICRO, SQUARE = "\N{DEGREE SIGN}", "\N{MICRO SIGN}", "\N{SUPERSCRIPT TWO}"
WORDS = {"rpm": "rev/min", "degC": DEGREE + "C", "deg": DEGREE, "degree": DEGREE, "um": MICRO + "m", "um2": MICRO + "m" + SQUARE,
         "mm2": "mm" + SQUARE, "m2": "m" + SQUARE, "m/s2": "m/s" + SQUARE, "um/s": MICRO + "m/s", "us": MICRO + "s", "Pas": "Pa s"}
MOST_DIGITS = 10  # of a value that has to differ from its neighbours


def plain_unit(unit):
    """A unit in the spelling of this module."""
    return SAME.get(unit, unit)


def factor(unit, shown):
    """How many of the unit shown one of the file's unit is; None where it is no unit for that."""
    unit = plain_unit(unit)
    return dict(SHOWN.get(unit, ((unit, 1.0),))).get(shown)


def fitting_unit(name, unit, values):
    """Unit that a quantity is shown in so that its largest value is neither long nor tiny, and the factor to it."""
    unit = plain_unit(unit)
    if unit == "1":
        return ("%", 100.0) if OVER_CYCLES.sub("", name).endswith(PARTS) else ("1", 1.0)
    sizes = np.abs(np.asarray(values, dtype=float))
    top = sizes[np.isfinite(sizes)].max(initial=0.0)
    choices = SHOWN.get(unit, ((unit, 1.0),))
    if top == 0.0:
        return next((choice for choice in choices if choice[0] == unit), choices[-1])
    return next((choice for choice in reversed(choices) if top * choice[1] >= LEAST), choices[0])


def shaft_words(summary, name, unit):
    """What to say behind a limit of speed where the deck gives the speed of a crankshaft; nothing elsewhere."""
    return " of the camshaft" if "crank_turns" in summary and name.endswith("_speed") and plain_unit(unit) == "rad/s" else ""


def unit_words(unit):
    """A unit as printed in a figure."""
    return WORDS.get(unit, unit)


def with_unit(words, unit):
    """A label with its unit in brackets, where it has one."""
    return words if unit in ("", "1") else f"{words} [{unit}]"


def bare_name(name, unit):
    """Name of a deck key without the unit that it ends with: `stiffness_N_m` is `stiffness`."""
    last = name.rpartition("_")[2]
    spelled = {"degree": "deg"}.get(unit, unit).replace("1/", "per_").translate(str.maketrans("/ ", "__", "()"))
    for ending in (spelled, last if last in WORDS else ""):
        if ending and name.endswith("_" + ending):
            return name[:-len(ending) - 1]
    return name


def key_words(key, unit):
    """A deck key in words, with its group where the name alone is too short: `film law`, `roller radius`, `cam roughness`."""
    group, _, name = key.rpartition(".")
    bare = bare_name(name, unit)
    is_short = bare.count("_") + (bare != name) < 2
    return (f"{group}_{bare}" if is_short and group not in ("", "operating_point") else bare).replace("_", " ")


def significant(value, count=3):
    """A number with so many significant digits and no exponent."""
    if value == 0.0 or not np.isfinite(value):
        return f"{value:.0f}"
    value = float(f"{value:.{count - 1}e}")  # 99.97 has as many digits before the point as 100
    decimals = count - 1 - int(np.floor(np.log10(abs(value))))
    return f"{round(value, decimals):.{max(decimals, 0)}f}"


def number(value, count=3):
    """A number with so many significant digits, whole numbers in full, with a power of ten where it is tiny or huge."""
    value = float(value)
    if not np.isfinite(value):
        return "-" if np.isnan(value) else str(value)
    if value == 0.0:
        return "0"
    if not 1e-3 <= abs(value) < 1e6:
        return f"{value:.{count - 1}e}"
    if abs(value) >= 10.0 ** (count - 1) or value == round(value):
        return f"{value:.0f}"
    return significant(value, count)


def distinct_texts(values, count=4):
    """Values as texts, numbers with as many digits as it takes to tell them apart."""
    for digits in range(count, MOST_DIGITS + 1):
        texts = [_short(value, digits) if isinstance(value, float) else str(value) for value in values]
        if len(set(texts)) == len(set(values)):
            break
    return texts


def _short(value, digits):
    """A number with at most so many significant digits, and an exponent only where it is tiny or huge."""
    return f"{float(f'{value:.{digits}g}'):.{MOST_DIGITS}g}"
