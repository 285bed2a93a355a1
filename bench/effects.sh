#!/usr/bin/env bash
# Count what effects cost and check that absent ones cost nothing; rewrites bench/tables/effects.txt.
#
# Usage: make bench-effects      ten minutes
# Needs valgrind, which nothing else here does. Instructions are counted, so a busy machine does not matter.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() { printf 'bench-effects: %s\n' "$*" >&2; exit 1; }

command -v valgrind > /dev/null || fail "valgrind is missing (valgrind in Debian)"
program=build/counted/bin/camroller
work=build/bench/effects
mkdir -p "$work"
failed=()
# A deck that fails keeps its rows, and those after it follow
count() {
    .venv/bin/python bench/effects.py "$program" "$@" --work "$work" --set numerics.tolerance=1e-5 || failed+=("$1")
}
{
    count decks/thesis.nml --set operating_point.speed_rpm=300 --set operating_point.oil_temperature_degC=95
    count decks/thesis.nml --set operating_point.speed_rpm=900 --set operating_point.oil_temperature_degC=25
    count decks/three_cam_head.nml
    count decks/logarithmic_roller.nml --set operating_point.speed_rpm=300 --set operating_point.oil_temperature_degC=95 \
        --set roller_profile.slice_series=.false.
    count decks/plain_pin.nml --only needle_bearing
    count decks/local_limit.nml --only local_limit --set operating_point.speed_rpm=3000
    count decks/journal_orbits.nml --only journal_orbit bearing_asperity
    count bench/all_effects.nml
} > "$work/table.part"
mv "$work/table.part" bench/tables/effects.txt
cat bench/tables/effects.txt
[ ${#failed[@]} -eq 0 ] || fail "the balance is not within its bound, or an absent effect is called: ${failed[*]}"
