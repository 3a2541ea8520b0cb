#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each check finds what it is there to find, and leaves clean files alone."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import check_files
import check_format
import check_isa_symbols
import check_layers

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SPDX = "// SPDX-License-Identifier: Apache-2.0\n"


class LintTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def only_fault(self, check):
        found = list(check.faults(self.root))
        self.assertEqual(len(found), 1, found)
        return found[0]


class CheckLayers(LintTest):
    def test_lets_includes_go_down(self):
        self.write("src/vo/a.cpp", '#include <vector>\n#include "base/time.h"\n#include "vo/a.h"\n')
        self.write("drivers/x/a.cpp", '#include "drivers/a.h"\n#include "platform/clocks.h"\n')
        self.write("src/app/a.cpp", '#include "io/a.h"\n#include "drivers/x/a.h"\n')
        self.write("drivers/y/a.cpp", '#include "messages/frame_t.hpp"\n')
        self.write("tests/unit/a_test.cpp", '#include "app/a.h"\n#include "support/b.h"\n')
        self.assertEqual(list(check_layers.faults(self.root)), [])

    def test_finds_an_include_that_goes_up(self):
        self.write("src/base/a.h", '#include "vo/limits.h"\n')
        self.assertIn("base includes", self.only_fault(check_layers))

    def test_finds_an_include_across(self):
        self.write("src/vo/a.cpp", '#include "platform/clocks.h"\n')
        self.assertIn("vo includes", self.only_fault(check_layers))

    def test_finds_a_message_inside_the_algorithm(self):
        self.write("src/vo/a.cpp", '#include "messages/pose_t.hpp"\n')
        self.assertIn("vo includes", self.only_fault(check_layers))

    def test_finds_a_path_that_hides_its_layer(self):
        self.write("src/vo/a.cpp", '#include "../io/config.h"\n')
        self.assertIn("no path from the root", self.only_fault(check_layers))

    def test_finds_opencv_in_a_header_only(self):
        self.write("drivers/x/a.cpp", "#include <opencv2/core.hpp>\n")
        self.write("drivers/x/a.h", "#include <opencv2/core.hpp>\n")
        self.assertIn("a.h:1: OpenCV", self.only_fault(check_layers))


class CheckFiles(LintTest):
    def test_lets_an_ordinary_file_pass(self):
        self.write("src/base/a.h", SPDX + "struct Lease {};\n")
        self.write("README.md", "Write to /etc/darkling and ~/logs/x.\n")
        self.assertEqual(list(check_files.faults(self.root)), [])

    def test_finds_a_missing_licence(self):
        self.write("src/base/a.h", "struct Lease {};\n")
        self.assertIn("SPDX", self.only_fault(check_files))

    def test_finds_a_file_that_is_too_long(self):
        self.write("src/base/a.cpp", SPDX + "\n" * check_files.MAX_LINES)
        self.assertIn("301 lines", self.only_fault(check_files))

    def test_finds_an_empty_word_in_a_file_name(self):
        self.write("src/base/image_utils.h", SPDX)
        self.assertIn("file's name", self.only_fault(check_files))

    def test_finds_an_empty_word_in_a_type(self):
        self.write("src/base/a.h", SPDX + "class FrameManager {\n")
        self.assertIn("FrameManager", self.only_fault(check_files))

    def test_finds_data_as_the_end_of_a_type(self):
        self.write("src/base/a.h", SPDX + "struct FrameData {\n")
        self.assertIn("FrameData", self.only_fault(check_files))

    def test_finds_the_path_of_one_machine(self):
        self.write("config/a.yaml", "calibration: /" + "home/somebody/rig.yaml\n")
        self.assertIn("one machine", self.only_fault(check_files))


class CheckFormat(LintTest):
    def setUp(self):
        super().setUp()
        shutil.copy(ROOT / ".clang-format", self.root)

    def test_lets_a_formatted_file_pass(self):
        self.write("src/base/a.cpp", "int x = 1;\n")
        self.assertEqual(list(check_format.faults(self.root)), [])

    def test_finds_a_file_that_is_not(self):
        self.write("src/base/a.cpp", "int   x=1;\n")
        self.assertIn("src/base/a.cpp", self.only_fault(check_format))


class CheckIsaSymbols(LintTest):
    def compile(self, name, text):
        source = self.write(name, text)
        target = source.with_suffix(".cpp.o")
        subprocess.run(["g++", "-O0", "-c", str(source), "-o", str(target)], check=True)
        return [str(target)]

    SHARED = "inline int twice(int x) { return 2 * x; }\nint f(int x) { return twice(x); }\n"

    def test_lets_a_file_of_its_own_functions_pass(self):
        own = "namespace { int twice(int x) { return 2 * x; } }\nint f(int x) { return twice(x); }\n"
        self.assertEqual(list(check_isa_symbols.faults(self.compile("k_avx2.cpp", own))), [])

    def test_finds_an_inline_function(self):
        found = list(check_isa_symbols.faults(self.compile("k_avx2.cpp", self.SHARED)))
        self.assertIn("twice(int)", "".join(found))

    def test_leaves_files_for_the_baseline_alone(self):
        self.assertEqual(list(check_isa_symbols.faults(self.compile("k_ref.cpp", self.SHARED))), [])


class RunTidy(LintTest):
    def setUp(self):
        super().setUp()
        shutil.copy(ROOT / ".clang-tidy", self.root)
        (self.root / "build").mkdir()

    def tidy(self, text):
        source = self.write("src/base/a.cpp", text)
        self.write("build/compile_commands.json", json.dumps([{
            "file": str(source), "directory": str(self.root),
            "command": f"/usr/bin/env X=1 /usr/bin/ccache /usr/bin/c++ -I{self.root}/src "
                       f"-std=c++20 -include gone.hxx -c {source}"}]))
        return subprocess.run(
            [sys.executable, str(HERE / "run_tidy.py"), str(self.root), str(self.root / "build")],
            capture_output=True, text=True)

    def test_knows_our_mathematics(self):
        done = self.tidy("constexpr int kMaxPoints = 3;\n"
                         "int f(int J, int T_world_left) {\n"
                         "  const int R_a_b = J;\n  return R_a_b * T_world_left * kMaxPoints;\n}\n")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_finds_a_name_out_of_style(self):
        for text in ("int doIt() { return 1; }\n", "struct small_thing {};\n",
                     "class A { int x = 0; };\n", "constexpr int MAX_POINTS = 3;\n",
                     "int f(int frameCount) { return frameCount; }\n"):
            done = self.tidy(text)
            self.assertEqual(done.returncode, 1, text)
            self.assertIn("readability-identifier-naming", done.stdout)

    def test_finds_a_function_that_is_too_long(self):
        done = self.tidy("int f(int x) {\n" + "  x += 1;\n" * 61 + "  return x;\n}\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("readability-function-size", done.stdout)

    def test_looks_again_only_at_what_changed(self):
        header = self.write("src/base/a.h", "inline int one() { return 1; }\n")
        text = '#include "base/a.h"\nint f() { return one(); }\n'
        self.assertIn("1 looked at", self.tidy(text).stdout)
        self.assertIn("0 looked at", self.tidy(text).stdout)
        header.write_text("inline int one() { return 2; }\n")
        self.assertIn("1 looked at", self.tidy(text).stdout)

    def test_never_takes_a_finding_for_clean(self):
        for _ in range(2):
            self.assertEqual(self.tidy("int doIt() { return 1; }\n").returncode, 1)

    def test_fails_when_there_is_nothing_to_look_at(self):
        self.write("build/compile_commands.json", "[]")
        done = subprocess.run(
            [sys.executable, str(HERE / "run_tidy.py"), str(self.root), str(self.root / "build")],
            capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
