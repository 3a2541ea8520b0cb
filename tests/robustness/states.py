# SPDX-License-Identifier: Apache-2.0
"""What happened frame by frame, from the `states` of `--stats`."""


def by_frame(figures):
    """@return frame → (state, reasons)."""
    return {frame: (span["state"], tuple(span["reasons"])) for span in figures["states"]
            for frame in range(span["first"], span["first"] + span["frames"])}


def noticed_after(states, fault):
    """@return which frame of the fault is the first that is not valid, counted from 1; None for
    none."""
    return next((frame - fault.start + 1 for frame in fault
                 if states.get(frame, ("valid",))[0] != "valid"), None)


def recovered_after(states, fault):
    """@return which frame after the fault is the first valid one, counted from 1; None for none."""
    after = sorted(frame for frame in states if frame >= fault.stop)
    return next((frame - fault.stop + 1 for frame in after if states[frame][0] == "valid"), None)


def seen(states, frames):
    """@return states and reasons within `frames`, in the order they came."""
    at = [states[frame] for frame in frames if frame in states]
    return (list(dict.fromkeys(state for state, _ in at)),
            list(dict.fromkeys(reason for _, reasons in at for reason in reasons)))


def counts(states, frames):
    """@return how many of `frames` were valid, degraded and lost."""
    at = [states[frame][0] for frame in frames if frame in states]
    return tuple(at.count(state) for state in ("valid", "degraded", "lost"))
