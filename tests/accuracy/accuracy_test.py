#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What measures the accuracy finds the errors that are put in, and writes where it should."""
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import recordings
import replays
import settings

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from measured_page import fill_page, table


def straight_path(step_m, jitter_m=0.0):
    """Four seconds, stamps in ms; every other position is beside the path."""
    return {50 * i: [step_m * i, jitter_m * (i % 2), 0.0] for i in range(81)}


class ScaleErrorTest(unittest.TestCase):
    def test_is_none_of_the_truth_itself(self):
        self.assertEqual(replays.scale_error(straight_path(0.05), straight_path(0.05)), 0)

    def test_is_positive_of_a_path_that_is_too_long(self):
        self.assertAlmostEqual(replays.scale_error(straight_path(0.05), straight_path(0.051)), 0.02)
        self.assertAlmostEqual(replays.scale_error(straight_path(0.05), straight_path(0.049)), -0.02)

    def test_does_not_take_jitter_for_path(self):
        jittery = straight_path(0.05, jitter_m=0.01)
        self.assertAlmostEqual(replays.scale_error(straight_path(0.05), jittery), 0)

    def test_compares_the_same_frames(self):
        shorter = {stamp: at for stamp, at in straight_path(0.05).items() if stamp < 2100}
        self.assertAlmostEqual(replays.scale_error(straight_path(0.05), shorter), 0)


class ReadPositionsTest(unittest.TestCase):
    def test_takes_stamps_in_milliseconds_and_leaves_comments_out(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "path.tum"
            path.write_text("# stamp x y z and so on\n1767225600.050000000 1 2 -3e-1 0 0 0 1\n")
            self.assertEqual(replays.read_positions(path), {1767225600050: [1.0, 2.0, -0.3]})


class AblationsTest(unittest.TestCase):
    def test_leave_out_what_a_build_does_not_know_and_what_is_its_default(self):
        def print_config(program, setting=None):
            if setting == "descriptor=intensity":
                return "intensity", ""
            return (None, "unknown key") if setting == "stereo=block" else ("default", "")

        with mock.patch.object(settings, "print_config", print_config), mock.patch("builtins.print"):
            self.assertEqual(settings.known_ablations("darkling"), [("intensity", "descriptor=intensity")])


class WidthsTest(unittest.TestCase):
    def test_end_at_the_width_of_the_source(self):
        self.assertEqual(settings.widths_of(recordings.Recording("a", 480))[-1], 480)
        self.assertEqual(settings.widths_of(recordings.Recording("a", 479))[-1], 320)


class MeasuredPageTest(unittest.TestCase):
    def test_writes_between_the_marks_of_a_name_and_nowhere_else(self):
        page = "a\n<!-- measured: one -->\nold\n<!-- end -->\nb\n<!-- measured: two -->\n<!-- end -->\n"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "page.md"
            path.write_text(page)
            for _ in range(2):
                fill_page(path, lambda name: f"new {name}\n")
                self.assertEqual(path.read_text(),
                                 "a\n<!-- measured: one -->\n\nnew one\n\n<!-- end -->\nb\n"
                                 "<!-- measured: two -->\n\nnew two\n\n<!-- end -->\n")

    def test_puts_numbers_to_the_right(self):
        self.assertEqual(table(["a", "b", "c"], [["x", "−1", "y"], ["z", "–", "2 †"]]),
                         "| a | b | c |\n| --- | ---: | ---: |\n| x | −1 | y |\n| z | – | 2 † |\n")


if __name__ == "__main__":
    unittest.main()
