import re
import sys
import unittest

from sandbox import ROOT, Sandbox

sys.path.insert(0, str(ROOT / "pipeline"))
import portability  # noqa: E402

V2, V3, V4 = (portability.NEEDED[f"x86-64-v{level}"] for level in (2, 3, 4))

# Stands for cmake: g++ compiles all, clang++ finds one warning, twice.
CMAKE = """#!/bin/bash
echo "cmake $*" >> "$LOG"
[[ $1 == --build && $2 == *clang* ]] || exit 0
for i in 1 2; do echo "a.cpp:3:4: error: unused variable 'x' [-Werror,-Wunused-variable]"; done
exit 1
"""
CTEST = """#!/bin/bash
echo "ctest $*" >> "$LOG"
echo "99% tests passed, ${FAILED:-0} tests failed out of 700"
"""


class Levels(unittest.TestCase):
    def test_a_processor_has_the_levels_whose_instructions_it_has(self):
        for flags, last in ((set(), "native"), (V2, "x86-64-v2"), (V2 | V3, "x86-64-v3"), (V2 | V4, "x86-64-v2"),
                            (V2 | V3 | V4, "x86-64-v4")):
            self.assertEqual(portability.levels_here(flags)[-1], last)

    def test_elsewhere_is_a_level_that_this_processor_is_not_at(self):
        for flags, level in ((V2, "x86-64-v4"), (V2 | V3, "x86-64-v4"), (V2 | V3 | V4, "x86-64-v3"), (set(), None)):
            self.assertEqual(portability.level_elsewhere(portability.levels_here(flags)), level)


class Table(Sandbox):
    def setUp(self):
        super().setUp()
        self.stand_in("cmake", CMAKE)
        self.stand_in("ctest", CTEST)
        for compiler in ("g++", "clang++"):
            self.stand_in(compiler, f"#!/bin/bash\necho '{compiler} 99.9'\n")

    def portability(self, *arguments, **environment):
        return self.run_in_sandbox("/usr/bin/python3", "-B", "pipeline/portability.py", *arguments, **environment)

    def rows(self, text):
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")][2:]

    def test_a_row_says_what_was_built_what_was_found_and_what_passed(self):
        done = self.portability("--levels", "native", "-o", "out/table.md")
        gcc, clang = self.rows(done.stdout)
        self.assertEqual(gcc[:4] + [gcc[5]], ["g++", "native", "yes", "0", "700 of 700"])
        self.assertEqual(clang[:4] + [clang[5]], ["clang++", "native", "no", "1", "not run"])
        self.assertEqual(done.returncode, 1)
        self.assertEqual((self.root / "out" / "table.md").read_text().strip(), done.stdout.strip())
        self.assertRegex(done.stdout, r"(?m)^- command: `portability.py --levels native -o out/table.md`$")
        self.assertRegex(done.stdout, r"(?m)^- g\+\+: g\+\+ 99\.9$")
        for call in self.called("cmake")[::2]:
            self.assertRegex(call, "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON")

    def test_it_ends_with_0_if_all_builds_and_passes_and_with_1_if_a_test_fails(self):
        self.assertEqual(self.portability("--levels", "native", "--compilers", "g++").returncode, 0)
        failed = self.portability("--levels", "native", "--compilers", "g++", FAILED="1")
        self.assertEqual((failed.returncode, self.rows(failed.stdout)[0][5]), (1, "699 of 700"))

    def test_a_compiler_that_is_not_there_is_named(self):
        done = self.portability("--levels", "native", "--compilers", "no-such-compiler")
        self.assertEqual((done.returncode, self.rows(done.stdout)[0][2]), (1, "not installed"))

    def test_tests_of_the_pipeline_itself_are_left_to_the_release_build(self):
        self.portability("--levels", "native", "--compilers", "g++")
        pattern = re.search(r"-E (\S+)", self.called("ctest")[0])[1]
        self.assertTrue(all(re.search(pattern, name) for name in ("pipeline.quick", "pipeline.elsewhere")))
        self.assertFalse(re.search(pattern, "pipeline.scene.hollow"))

    def test_elsewhere_compiles_the_programs_alone(self):
        done = self.portability("--elsewhere")
        if done.returncode == portability.SKIPPED:
            self.skipTest(done.stdout)
        self.assertEqual(done.returncode, 0, done.stderr)
        _, build = self.called("cmake")
        self.assertIn("--target dryer agglomerate rigidstress breaker", build)
        self.assertEqual(self.called("ctest"), [])


if __name__ == "__main__":
    unittest.main()
