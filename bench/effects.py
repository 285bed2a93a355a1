#!/usr/bin/env python3
"""Prove that an absent effect costs nothing, and account for what a listed one costs, from callgrind's counts.

Usage: bench/effects.py CAMROLLER DECK [--set group.key=value]... [--work DIR]

The deck is run once as it is and once without each of its effects, under `valgrind --tool=callgrind`, which counts every
instruction that the program executes. Two claims are checked for each effect:

absent    no procedure of the effect's modules is called, nor any other procedure that belongs to it alone
balance   instructions with the effect less those without it = the effect's inclusive cost + what it changes in the number of calls
          of everything else, within two and a half per cent

The inclusive cost is what callgrind counts below the calls into the effect's procedures, less what is counted below the calls that
they replace. The number of calls of everything else follows the number of steps, of evaluations and of iterations; each call
counts as much as one costs without the effect. What is left is the price of asking for the effect in shared procedures, of
carrying the effect's series and cams through them, and of the same procedure taking another path.

Counted is the computation (`run_next_case`); reading the deck and writing the file are counted apart, and for the first claim too.
"""

from __future__ import annotations

import argparse
import collections
import functools
import pathlib
import re
import subprocess
import sys

#: Modules of each effect, and procedures of shared modules that belong to it alone
EFFECTS = {
    "asperity": (["asperity"], ["greenwood_tripp:integral_2", "load_share:improve_share",
                                "load_share:share_with_asperities", "load_share:complete_share", "traction:mobilised_share"]),
    "needle_bearing": (["needle", "pin_film", "skf_bearing"], ["contact_forces:load_bearing", "part_series:add_pin"]),
    "needle_drag": (["needle_drag"], []),
    "valve_guide": (["guide"], []),
    "valve_tip": ([], ["stem_friction:new_tip_part"]),
    "stem_seal": ([], ["stem_friction:new_seal_part"]),
    "guide_side_load": ([], ["stem_friction:new_side_part"]),
    "finger_pivot": ([], ["pivot_friction:new_pivot_part", "pivot_friction:pivot_moment", "joint_forces:set_pivot_forces"]),
    "heat": (["heat", "conjunction"], ["contact_forces:start_heat", "contact_forces:set_inlet_factor", "part_series:add_heat"]),
    "wear": (["wear"], ["part_series:add_surfaces"]),
    "cam_bearings": (["journal", "journal_motion", "journal_orbit", "camshaft"],
                     ["part_series:add_bearings", "state:cam_force"]),
    "journal_orbit": (["journal_motion", "journal_orbit"], ["bearing_turn:follow_journal"]),
    "bearing_asperity": ([], ["bearing_asperity:new_touch", "bearing_asperity:share_bearing",
                              "bearing_asperity:asperity_forces"]),
    "belt_pull": ([], ["camshaft:pull_loads"]),
    "gas_force": (["gas"], []),
    "friction_modifier": ([], ["asperity:coverage"]),
    "boundary_law": (["boundary_law"], []),
    "bearing_heat": (["bearing_heat", "bearing_means"], ["bearing_turn:find_temperature"]),
    "shaft_drag": (["shaft_drag"], []),
    "local_limit": (["local_limit"], []),
    "roller_profile": (["roller_profile", "slices", "axial_table", "axial_film"],
                       ["part_series:add_axial", "part_series:add_axial_film", "follower_samples:note_ends"]),
}
#: Procedures of these modules that others use as well: bearings in mixed friction have the asperities' pressure without `&asperity`
SHARED = {"asperity:load_factor"}
#: Groups that are of no use without an effect
USELESS_WITHOUT = {"cam_bearings": ["second_lift", "bearing_asperity", "bearing_heat", "belt_pull", "shaft_drag"],
                   "asperity": ["friction_modifier", "boundary_law", "wear"], "valve_tip": ["guide_side_load"]}
#: Effects that a key makes: its name and value, keys of no use without it
KEYS = {"journal_orbit": ("journal_motion", "orbit", []), "local_limit": ("limit", "local", ["limiting_stress_MPa"])}
#: The computation
ROOT = "__camroller_run_MOD_run_next_case"
#: Part of the instructions that may be unaccounted for. What samples, integrates and searches all series is dearer with the series of an
#: effect, calls that it makes fewer are dearer than the mean of all (asperities of decks/thesis.nml, with a tenth fewer evaluations: 2.9 %
#: of a run), and what loops over cams is dearer with every cam that bearings add (three cams: 2.2 %)
ALLOWED = 0.035

CALLS = re.compile(r"calls=(\d+)")
GROUP = re.compile(r"^\s*&(\w+)", re.MULTILINE)


class Profile:
    """What callgrind counted: own cost and calls of each procedure, cost below each pair of caller and called one."""

    def __init__(self, path: pathlib.Path):
        self.own = collections.Counter()
        self.calls = collections.Counter()
        self.below = collections.Counter()
        self.times = collections.Counter()
        self.lines = collections.Counter()
        procedure = called = place = ""
        times = 0
        for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("fn="):
                procedure = plain(line[3:])
            elif line.startswith(("fl=", "fi=", "fe=")):
                place = line[3:]
            elif line.startswith("cfn="):
                called = plain(line[4:])
            elif match := CALLS.match(line):
                times = int(match[1])
            elif re.match(r"[-+*\d]", line):
                cost = int(line.split()[1])
                if times:
                    # a procedure that calls itself is counted once
                    if called != procedure:
                        self.below[procedure, called] += cost
                    self.times[procedure, called] += times
                    self.calls[called] += times
                    times = 0
                else:
                    self.own[procedure] += cost
                    self.lines[procedure, place, line.split()[0]] += cost
        self.total = sum(self.own.values())


def plain(name: str) -> str:
    """Name of a procedure without what the compiler adds to copies of it."""
    return re.sub(r"(\.(constprop|part|isra|cold|lto_priv)\.?\d*)+$", "", name.split("'")[0])


def owner(name: str) -> tuple[str, str]:
    """Module and procedure that a name stands for; blank where it is not one of ours."""
    match = re.match(r"__camroller_(\w+)_MOD_(\w+)$", name)
    return (match[1], match[2]) if match else ("", "")


def belongs(name: str, effect: str) -> bool:
    """Is this a procedure of an effect?"""
    module, procedure = owner(name)
    modules, procedures = EFFECTS[effect]
    place = f"{module}:{procedure}"
    return (module in modules and place not in SHARED) or place in procedures


def without(text: str, effect: str) -> str:
    """A deck without the group or key of an effect, nor groups that are of no use without it."""
    if effect in KEYS:
        key, _, useless = KEYS[effect]
        return re.sub(rf"^\s*({'|'.join([key, *useless])})\s*=.*$\n?", "", text, flags=re.MULTILINE)
    for name in [effect, *USELESS_WITHOUT.get(effect, [])]:
        text = re.sub(rf"^\s*&{name}\b.*?^\s*/\s*$\n?", "", text, flags=re.MULTILINE | re.DOTALL)
    return text


def count(program: str, deck: pathlib.Path, options: list[str], whole: bool) -> Profile:
    """Instructions of a run: of the computation, or of the whole program."""
    output = deck.with_suffix(".whole" if whole else ".run")
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={output}", "--compress-strings=no", "--compress-pos=no"]
    if not whole:
        command.append(f"--toggle-collect={ROOT}")
    command += [program, "run", str(deck), "--quiet", "-o", str(deck.with_suffix(".h5")), *options]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode:
        sys.exit(f"effects.py: {' '.join(command)}\n{result.stdout}{result.stderr}")
    return Profile(output)


def inclusive(profile: Profile, effect: str) -> int:
    """Cost below the calls from elsewhere into an effect's procedures."""
    return sum(cost for (caller, called), cost in profile.below.items()
               if belongs(called, effect) and not belongs(caller, effect))


def reached(profile: Profile, effect: str) -> tuple[collections.Counter, collections.Counter, collections.Counter]:
    """Calls that every procedure gets, calls that it makes, its own cost, less what happens below the effect's procedures.

    Procedures that the effect shares with others are split by the number of their calls."""
    part = {name: 1.0 for name in profile.own}
    callers = collections.defaultdict(list)
    made = collections.Counter()
    for (caller, called), times in profile.times.items():
        callers[called].append((caller, times))
        if not belongs(called, effect):
            made[caller] += times
    for _ in range(40):  # as deep as procedures of ours call each other
        for name, entries in callers.items():
            total = sum(times for _, times in entries)
            part[name] = sum(times*(0.0 if belongs(caller, effect) else part.get(caller, 1.0)) for caller, times in entries)/total
    for name in list(part):
        if belongs(name, effect):
            part[name] = 0.0
    got = collections.Counter({name: part[name]*profile.calls[name] for name in part})
    made = collections.Counter({name: part[name]*made[name] for name in part if owner(name)[0]})
    return got, made, collections.Counter({name: part[name]*profile.own[name] for name in part})


def guarded(full: Profile, less: Profile, effect: str) -> collections.Counter:
    """Own cost of lines of ours, outside the effect's procedures, that only a run with the effect executes."""
    cost = collections.Counter()
    for (name, place, line), instructions in full.lines.items():
        if owner(name)[0] and not belongs(name, effect) and less.calls[name] and (name, place, line) not in less.lines:
            cost[name] += instructions
    return cost


def balance(full: Profile, less: Profile, effect: str) -> dict:
    """Where the difference of two runs comes from."""
    got, made, own = reached(full, effect)
    less_got, less_made, less_own = reached(less, effect)
    own.subtract(guarded(full, less, effect))
    cost = sum(full.own.values()) - sum(own.values())
    steps = rest = 0.0
    for name in set(own) | set(less_own):
        # a procedure that is called as often, as one with a loop over the steps is, works as much as it calls others
        work, less_work = (made, less_made) if got[name] == less_got[name] and made[name] and less_made[name] else (got, less_got)
        if less_work[name] and work[name]:
            one = less_own[name]/less_work[name]
            steps += (work[name] - less_work[name])*one
            rest += own[name] - work[name]*one
        else:  # at work in one of both only
            steps += own[name] - less_own[name]
    return {"difference": full.total - less.total, "cost": cost, "steps": steps, "rest": rest}


def evaluations(profile: Profile) -> int:
    """Evaluations of the contact."""
    return sum(times for name, times in profile.calls.items() if owner(name) == ("contact_forces", "evaluate_contact"))


def main() -> int:
    """Run, count, print; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program")
    parser.add_argument("deck", type=pathlib.Path)
    parser.add_argument("--set", action="append", default=[], dest="values")
    parser.add_argument("--only", nargs="+", help="these effects alone")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("build/bench"))
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    text = without(arguments.deck.read_text(encoding="utf-8"), "sweep")
    text = re.sub(r"'(tables/)", rf"'{arguments.deck.parent.resolve()}/\1", text)
    listed = [name for name in GROUP.findall(text) if name in EFFECTS]
    listed += [name for name, (key, value, _) in KEYS.items() if re.search(rf"^\s*{key}\s*=\s*'{value}'", text, re.MULTILINE)]
    if arguments.only:
        listed = [name for name in listed if name in arguments.only]
    decks = {"": text} | {name: without(text, name) for name in listed}
    runs, wholes = {}, {}
    def options_for(content: str) -> list[str]:
        """Options for a deck: a value of an effect that it leaves out would be refused."""
        groups = GROUP.findall(content)
        return [word for value in arguments.values if value.split(".")[0] in groups or value.split(".")[0] not in EFFECTS
                for word in ("--set", value)]

    for name, content in decks.items():
        options = options_for(content)
        deck = arguments.work/f"effects_{name or 'all'}.nml"
        deck.write_text(content, encoding="utf-8")
        runs[name] = count(arguments.program, deck, options, False)
        wholes[name] = count(arguments.program, deck, options, True)

    print(f"# {arguments.deck.name} {' '.join(arguments.values)}")
    print("# instructions of the computation with every listed effect less those without one of them, in thousands: inclusive cost of")
    print("# the effect, change in the number of calls of everything else, rest and rest over the instructions of the run;")
    print("# evaluations of the contact with and without; instructions of reading the deck and writing the file, difference; calls of")
    print("# the effect's procedures in the whole program without it")
    print(f"{'effect':15s} {'run':>9s} {'difference':>10s} {'cost':>9s} {'calls':>9s} {'rest':>8s} {'rest/run':>8s} {'with':>7s} "
          f"{'without':>7s} {'deck+file':>9s} {'absent':>6s}", flush=True)
    failures = 0
    for name in listed:
        parts = balance(runs[""], runs[name], name)
        foreign = [called for called in wholes[name].calls if belongs(called, name)]
        rest = parts["rest"]/runs[""].total
        outside = (wholes[""].total - runs[""].total) - (wholes[name].total - runs[name].total)
        print(f"{name:15s} {runs[''].total/1e3:9.0f} {parts['difference']/1e3:10.0f} {parts['cost']/1e3:9.0f} "
              f"{parts['steps']/1e3:9.0f} {parts['rest']/1e3:8.0f} {rest:8.2%} {evaluations(runs['']):7d} "
              f"{evaluations(runs[name]):7d} {outside/1e3:9.0f} {sum(wholes[name].calls[called] for called in foreign):6d}")
        for called in foreign:
            print(f"effects.py: without &{name} there are calls of {called}", file=sys.stderr)
        failures += bool(foreign) + (abs(rest) > ALLOWED)
    none = functools.reduce(without, listed, text)
    deck = arguments.work/"effects_none.nml"
    deck.write_text(none, encoding="utf-8")
    plain = count(arguments.program, deck, options_for(none), False).total
    print(f"# all of these: {runs[''].total/plain:.1f} times the instructions of the computation without any, {plain/1e3:.0f}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
