"""Which cases of a file have a result, were not computed or have lost contact, and how a figure, a table and a page say so."""

import re

import numpy as np

NOT_COMPUTED = -1  # status of a case that a partial file does not have
MOST_FAILURES = 5  # told one by one


def status_of(result):
    """Status of each case: 0 where it has a result, -1 where a partial file does not have it."""
    status = result.summary.get("status")
    return np.zeros(result.cases, dtype=int) if status is None or np.shape(status.values) != (result.cases,) else status.values


def not_computed(result):
    """Cases that a partial file does not have."""
    return set(np.flatnonzero(np.equal(status_of(result), NOT_COMPUTED)).tolist())


def failures(result, cases):
    """Those of some cases that were computed and have no result, each with the reason."""
    missing = not_computed(result)
    return [(case, reason) for case, reason in result.failed_cases() if case in cases and case not in missing]


def failure_lines(result, cases, most=MOST_FAILURES):
    """Lines on those of some cases that were computed and have no result: the reasons of the first, then how many more."""
    failed = failures(result, cases)
    more = len(failed) - most
    return [f"case {case} has no result: {reason}".rstrip(": ") for case, reason in failed[:most]] \
        + ([f"{more} more case{'s have' if more > 1 else ' has'} no result"] if more > 0 else [])


def not_computed_words(statuses):
    """How many of the cases of these statuses a partial file does not have; empty where it has all."""
    count = sum(status == NOT_COMPUTED for status in statuses)
    return f"{count} of {len(statuses)} cases {'was' if count == 1 else 'were'} not computed" if count else ""


def missing_words(statuses):
    """How many of the cases of these statuses were not computed, and how many have no result: parts of a sentence."""
    count = sum(status not in (0, NOT_COMPUTED) for status in statuses)
    return list(filter(None, [not_computed_words(statuses), f"{count} of {len(statuses)} cases have no result" if count else ""]))


def lost_contact(result):
    """For each lobe shape, from 1 on, and each case: is contact lost for a part of the cycle?"""
    found = {re.fullmatch(r"(?:lobe_(\d+)_)?lost_contact_share", name): share.values for name, share in result.summary.items()}
    return {int(match[1] or 1): np.greater(values, 0.0) for match, values in found.items() if match and np.shape(values) == (result.cases,)}


def lost_contact_words(lost):
    """In how many of some cases contact is lost, by which lobe shape where there are several: parts of a sentence."""
    several = max(lost, default=1) > 1
    return [f"contact{several * f' of lobe {lobe}'} is lost" + (len(cases) > 1) * f" in {sum(cases)} of {len(cases)} cases"
            for lobe, cases in sorted(lost.items()) if any(cases)]
