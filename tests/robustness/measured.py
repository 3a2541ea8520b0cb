# SPDX-License-Identifier: Apache-2.0
"""All that is replayed, and the tables of it."""
import dataclasses
import pathlib
import sys

import cases
import confidence_tables
import states
import verdicts
from replays import Replay, replay_all  # after cases, which finds the accuracy scripts

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from measured_page import table

NOTHING = "–"


def digits(value):
    if abs(value) >= 1e5:
        return f"{value:.0e}"
    return f"{value:#.3g}".rstrip(".") if abs(value) < 1000 else f"{value:.0f}"


def doubtful(figures):
    """Degraded, lost and resets; nothing where all was well."""
    words = [f"{figures[key]} {word}" for key, word in (
        ("degraded_frames", "degraded"), ("lost_frames", "lost"), ("bad_frames", "bad"),
        ("resets", "resets")) if figures[key]]
    return ", ".join("1 reset" if word == "1 resets" else word for word in words)


@dataclasses.dataclass(frozen=True)
class Scope:
    """What is asked in one go."""
    at_hand: tuple
    descriptors: tuple = cases.DESCRIPTORS
    seeds: int = 500
    has_plots: bool = True


class Measured:
    """Every table of the page, by its name there."""

    def __init__(self, program, scope, at_once):
        self.scope = scope
        figures = replay_all(program, self.group_runs() + self.plot_runs() + self.stream_runs()
                             + self.drawn_runs(), at_once)
        self.figures = {run: confidence_tables.without_flaws(run.recording, of)
                        for run, of in figures.items()}

    def run_of(self, recording, descriptor, injections=()):
        return Replay(recording, setting=dict(cases.DESCRIPTORS)[descriptor], injections=injections)

    def of(self, *words):
        return self.figures[self.run_of(*words)]

    def group_runs(self):
        every = [()] + [case.injections for group in cases.GROUPS.values() for case in group]
        return [self.run_of(r, descriptor, injections) for r in self.scope.at_hand
                for descriptor, _ in self.scope.descriptors for injections in every]

    def plotted(self):
        return [r for r in self.scope.at_hand if r.name in cases.PLOTTED_RECORDINGS]

    def plot_runs(self):
        if not self.scope.has_plots:
            return []
        return [self.run_of(r, descriptor, (f"{name}={level}",)) for r in self.plotted()
                for descriptor, _ in cases.DESCRIPTORS
                for name, levels in cases.PLOTTED.items() for level in levels]

    def streams(self):
        """@return (stream, recording, its replay) each."""
        fault = f"@{cases.FAULT.start}:{cases.FAULT.stop}"
        return [(stream, r, self.run_of(r, "bit-planes", (stream + fault,)))
                for stream in cases.STREAMS for r in self.scope.at_hand
                if r.name in cases.STREAM_RECORDINGS]

    def stream_runs(self):
        return [run for _, _, run in self.streams()]

    def drawn_runs(self):
        runs = []
        for seed in range(self.scope.seeds):
            recording = self.scope.at_hand[seed % len(self.scope.at_hand)]
            injections = cases.drawn_injections(seed, cases.frame_count(recording))
            runs.append(self.run_of(recording, "bit-planes", injections))
        return runs

    def group(self, name):
        head = ["injection", "recording"]
        for descriptor, _ in self.scope.descriptors:
            head += [descriptor, "ratio", "of RPE", "frames, resets"]
        rows = []
        for case in (cases.Case("none", 0, ()),) + cases.GROUPS[name]:
            for r in self.scope.at_hand:
                cells = [case.name if r == self.scope.at_hand[0] else "", r.name]
                for descriptor, _ in self.scope.descriptors:
                    f, clean = self.of(r, descriptor, case.injections), self.of(r, descriptor)
                    cells += [f"{digits(verdicts.error(r, f))} {verdicts.unit(r)}",
                              f"{verdicts.ratio(r, f, clean):.2f}",
                              f"{verdicts.rpe_ratio(f, clean):.2f}", doubtful(f)]
                rows.append(cells)
        return table(head, rows)

    def wanted(self):
        rows = []
        for case in (case for group in cases.GROUPS.values() for case in group):
            limits = {}  # of a kind and size → recording → value
            for r in self.scope.at_hand:
                f, clean = self.of(r, "bit-planes", case.injections), self.of(r, "bit-planes")
                for kind, most in verdicts.limits_of(case, r):
                    value = verdicts.measured(kind, r, f, clean)
                    limits.setdefault((kind, most), {})[r] = value
            rows += [self.wanted_row(case, *limit, values) for limit, values in limits.items()]
        share = confidence_tables.wrong_percent(self.figures[run] for run in self.drawn_runs())
        if share is not None:
            rows.append(["drawn runs", f"confidently wrong in at most {cases.MOST_WRONG_PERCENT} % of frames",
                         f"{share:.2f} %", "", "yes" if share <= cases.MOST_WRONG_PERCENT else "no"])
        return table(["injection", "demanded", "worst", "of", "met"], rows)

    def wanted_row(self, case, kind, most, values):
        never = lambda value: float("inf") if value is None else value
        worst = max(values, key=lambda r: never(values[r]))
        of = worst.name if len(values) > 1 or kind == "error" else ""
        unit = f" {verdicts.unit(worst)}" if kind == "error" else ""
        demanded = {"ratio": f"at most {most} times clean", "error": f"at most {most}{unit}",
                    "lost": "no frame lost", "recovery": f"valid within {most} frames"}[kind]
        missed = [r.name for r in values if not verdicts.is_met(values[r], most)]
        shown = NOTHING if values[worst] is None else f"{digits(values[worst])}{unit}"
        if kind in ("lost", "recovery") and values[worst] is not None:
            shown = str(values[worst])
        return [case.name, demanded, shown, of, "no: " + ", ".join(missed) if missed else "yes"]

    def bad_streams(self):
        soon = range(cases.FAULT.start, cases.FAULT.start + cases.SOON)
        rows = []
        for stream, r, run in self.streams():
            f = self.figures[run]
            at = states.by_frame(f)
            found, reasons = states.seen(at, soon)
            after = states.noticed_after(at, cases.FAULT)
            recovered = states.recovered_after(at, cases.FAULT)
            is_refused = "eyes_swapped" in f["reasons"] and f["reasons"]["eyes_swapped"] > 0
            rows.append([stream, r.name, ", ".join(found), ", ".join(reasons),
                         NOTHING if after is None else after,
                         "{}, {}, {}".format(*states.counts(at, cases.FAULT)),
                         "refused" if is_refused else NOTHING if recovered is None else recovered,
                         f["resets"], f["confidently_wrong"] or ""])
        return table(["stream", "recording", f"states of the first {cases.SOON} frames", "reasons",
                      "noticed after", "valid, degraded, lost", "valid again after", "resets",
                      "confidently wrong"], rows)

    def confidence(self):
        above = list(dict.fromkeys(self.group_runs() + self.plot_runs()))
        by_kind = {"injections above": above, "bad streams": self.stream_runs(),
                   "drawn": self.drawn_runs()}
        return confidence_tables.by_recording(by_kind, self.scope.at_hand, self.figures)

    def drawn(self):
        return confidence_tables.by_injection(self.drawn_runs(), self.figures)

    def write(self, name):
        return self.group(name) if name in cases.GROUPS else getattr(self, name)()

    def plot(self, folder):
        import level_plots  # matplotlib is not for tests
        folder.mkdir(exist_ok=True)
        figures_of = lambda r, descriptor, text: self.of(r, descriptor, (text,) if text else ())
        level_plots.plot_levels(folder / "levels.png", self.plotted(), figures_of)


