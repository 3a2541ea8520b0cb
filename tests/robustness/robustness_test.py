#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What measures the robustness reads states, ratios and limits as they are."""
import unittest

import cases
import confidence_tables
import states
import verdicts
from measured import Measured, Scope, doubtful
from replays import Replay
from write_robustness import parse

CAR = cases.RECORDINGS[0]
DRONE = cases.RECORDINGS[1]
MINE = cases.RECORDINGS[2]


def figures_of(**others):
    figures = {"drift_percent": 1.0, "rpe_rmse_m": 0.002, "degraded_frames": 0, "lost_frames": 0,
               "bad_frames": 0, "resets": 0, "frames": 100, "confident_frames": 90,
               "confidently_wrong": 0, "reasons": {}, "states": []}
    return figures | others


def span(first, frames, state, *reasons):
    return {"first": first, "frames": frames, "state": state, "reasons": list(reasons), "resets": 0}


BLACK = states.by_frame(figures_of(states=[
    span(0, 31, "valid"), span(31, 2, "degraded", "residual_high"), span(33, 29, "lost", "low_texture"),
    span(62, 40, "valid")]))


class StatesTest(unittest.TestCase):
    def test_count_the_frames_until_a_fault_is_noticed_and_over(self):
        self.assertEqual(states.noticed_after(BLACK, cases.FAULT), 2)
        self.assertEqual(states.recovered_after(BLACK, cases.FAULT), 3)
        self.assertEqual(states.counts(BLACK, cases.FAULT), (1, 2, 27))

    def test_tell_what_came_in_its_order(self):
        self.assertEqual(states.seen(BLACK, range(30, 35)),
                         (["valid", "degraded", "lost"], ["residual_high", "low_texture"]))

    def test_know_what_never_comes(self):
        self.assertIsNone(states.noticed_after(BLACK, range(0, 10)))
        self.assertIsNone(states.recovered_after(BLACK, range(0, 102)))


class VerdictsTest(unittest.TestCase):
    def test_take_drift_of_long_paths_and_rpe_of_short_ones(self):
        self.assertEqual(verdicts.error(CAR, figures_of()), 1.0)
        self.assertEqual(verdicts.error(DRONE, figures_of()), 2.0)
        self.assertEqual(verdicts.ratio(CAR, figures_of(drift_percent=3.0), figures_of()), 3.0)

    def test_hold_a_recording_to_what_is_demanded_of_it(self):
        night = cases.GROUPS["darkness"][2]
        self.assertEqual(verdicts.limits_of(night, CAR), [("error", 1.6)])
        self.assertEqual(verdicts.limits_of(night, MINE), [])
        self.assertEqual(verdicts.limits_of(cases.GROUPS["darkness"][0], MINE), [("error", 1.0)])
        self.assertEqual(verdicts.limits_of(cases.GROUPS["gaps"][0], MINE), [("recovery", 5)])

    def test_find_what_is_not_met(self):
        self.assertTrue(verdicts.is_met(1.5, 1.5))
        self.assertFalse(verdicts.is_met(1.6, 1.5))
        self.assertFalse(verdicts.is_met(None, 5))


class DrawnTest(unittest.TestCase):
    def test_are_the_same_for_a_seed_and_differ_between_seeds(self):
        drawn = [cases.drawn_injections(seed, 51) for seed in range(50)]
        self.assertEqual(drawn, [cases.drawn_injections(seed, 51) for seed in range(50)])
        self.assertGreater(len(set(drawn)), 45)

    def test_stay_within_the_recording(self):
        for injection in (one for seed in range(200) for one in cases.drawn_injections(seed, 51)):
            if "@" in injection:
                first, last = injection.partition("@")[2].partition(",")[0].split(":")
                self.assertTrue(0 < int(first) < int(last) <= 51, injection)


class ConfidenceTablesTest(unittest.TestCase):
    def test_count_a_run_for_each_of_its_injections(self):
        runs = [Replay(CAR, injections=("gain=2@3:5,seed=1", "white")),
                Replay(CAR, injections=("gain=4",))]
        figures = {runs[0]: figures_of(confidently_wrong=2), runs[1]: figures_of()}
        text = confidence_tables.by_injection(runs, figures)
        self.assertIn("| gain | 2 | 200 | 180 | 2 | 1.00 |", text)
        self.assertIn("| white | 1 | 100 | 90 | 2 | 2.00 |", text)

    def test_leave_out_what_was_not_judged(self):
        refused = figures_of(confidently_wrong=None, confident_frames=None)
        self.assertIsNone(confidence_tables.wrong_percent([refused]))
        self.assertEqual(confidence_tables.wrong_percent([refused, figures_of(confidently_wrong=1)]), 1.0)


    def test_do_not_count_jumps_of_the_truth(self):
        figures = figures_of(confidently_wrong=2, confidently_wrong_frames=[16, 40])
        self.assertEqual(confidence_tables.without_flaws(DRONE, figures)["confidently_wrong"], 1)
        self.assertEqual(confidence_tables.without_flaws(CAR, figures)["confidently_wrong"], 2)


class TablesTest(unittest.TestCase):
    def measured(self, figures):
        """Of every replay the same, but for those that `figures` knows."""
        measured = Measured.__new__(Measured)
        measured.scope = Scope(at_hand=(CAR, DRONE), seeds=3, has_plots=False)
        runs = measured.group_runs() + measured.stream_runs() + measured.drawn_runs()
        measured.figures = {run: figures_of() for run in runs} | figures
        return measured

    def test_show_ratio_and_what_became_of_frames(self):
        run = Replay(CAR, injections=("gamma=2",))
        worse = figures_of(drift_percent=2.0, lost_frames=3, resets=1)
        text = self.measured({run: worse}).write("brightness")
        self.assertIn("| gamma=2 | kitti_06 | 2.00 % | 2.00 | 1.00 | 3 lost, 1 reset | 1.00 %", text)

    def test_name_who_misses_a_demand(self):
        run = Replay(CAR, injections=("gamma=2",))
        text = self.measured({run: figures_of(drift_percent=2.0)}).write("wanted")
        self.assertIn("| gamma=2 | at most 1.3 times clean | 2.00 | kitti_06 | no: kitti_06 |", text)
        self.assertIn("| gamma=0.5 | at most 1.3 times clean | 1.00 | kitti_06 | yes |", text)

    def test_show_when_a_stream_is_noticed(self):
        run = Replay(DRONE, injections=("black@30:60",))
        figures = figures_of(states=[span(0, 32, "valid"), span(32, 40, "lost", "low_texture")])
        text = self.measured({run: figures}).write("bad_streams")
        self.assertIn("| black | euroc_mh01_a | valid, lost | low_texture | 3 | 2, 0, 28 | – | 0 |  |", text)

    def test_count_resets_as_one_says_it(self):
        self.assertEqual(doubtful(figures_of(resets=1)), "1 reset")
        self.assertEqual(doubtful(figures_of(resets=11, bad_frames=2)), "2 bad, 11 resets")


class OptionsTest(unittest.TestCase):
    def test_are_all_optional(self):
        self.assertFalse(parse([]).quick)
        self.assertEqual(parse(["--seeds", "500", "--at-once", "1", "x"]).seeds, 500)


if __name__ == "__main__":
    unittest.main()
