# SPDX-License-Identifier: Apache-2.0
"""Errors as tables show them, and whether they are within what is demanded."""
import states
from cases import BLACKOUT, SOON


def error(recording, figures):
    """Drift in %, or RPE in mm where the path is too short for a drift."""
    return figures["drift_percent"] if recording.is_long else 1000 * figures["rpe_rmse_m"]


def unit(recording):
    return "%" if recording.is_long else "mm"


def ratio(recording, figures, clean):
    return error(recording, figures) / error(recording, clean)


def rpe_ratio(figures, clean):
    """Steadier than that of drift, which is of few and overlapping lengths."""
    return figures["rpe_rmse_m"] / clean["rpe_rmse_m"]


def limits_of(case, recording):
    """@return (what is measured, the most that is allowed) of what is demanded of this recording."""
    limits = [("ratio", case.most_ratio)] if case.most_ratio else []
    for of, most in case.most_error:
        if of == recording.name or (of == "rendered" and recording.scene):
            limits.append(("error", most))
    if not case.may_be_lost:
        limits.append(("lost", 0))
    if case.name.startswith("blackout"):
        limits.append(("recovery", SOON))
    return limits


def measured(kind, recording, figures, clean):
    """@return the value that a limit of this kind is about; None where there is none."""
    if kind == "ratio":
        return ratio(recording, figures, clean)
    if kind == "error":
        return error(recording, figures)
    if kind == "lost":
        return figures["lost_frames"]
    return states.recovered_after(states.by_frame(figures), BLACKOUT)


def is_met(value, most):
    return value is not None and value <= most
