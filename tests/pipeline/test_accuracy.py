"""Pages ACCURACY.md: what is not measured again stays as it is, with its head; and the pages in the tree are the generated ones."""

import contextlib
import io
import json
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "pipeline/verify"))
import accuracy  # noqa: E402

PAGE = """page = "PAGE"
title = "Accuracy of a clock"

[[table]]
name = "slow"
question = "Is it slow?"
text = "Seconds a day."
cost = "a day"
command = "printf 'made for %s\\\\n\\\\n| a | b |\\\\n|---|---|\\\\n| 1 | 2 |\\\\n\\\\n| c |\\\\n|---|\\\\n| 3 |\\\\n' WORDS"

[[table]]
name = "rows"
question = "Is it right?"
command = "printf '{\\"d\\": [%s], \\"none\\": null}' > {out}.json"
row = "case"
reference = "two"
rows = [{name = "one", arguments = "1.5"}, {name = "two", arguments = "2"}]
columns = [["d", "d.0", ".2f"], ["difference, %", "d.0", "+.1f", "percent"], ["nothing", "none", "d"]]
"""


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.page = self.folder / "ACCURACY.md"
        self.declare(PAGE)
        was = accuracy.DECLARED
        accuracy.DECLARED = self.folder
        self.addCleanup(setattr, accuracy, "DECLARED", was)

    def declare(self, text):
        (self.folder / "clock.toml").write_text(text.replace("PAGE", str(self.page)))

    def run_it(self, *asked):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            accuracy.main(list(asked))
        return self.page.read_text()

    def test_a_table_that_was_never_measured_says_so_and_how_to(self):
        text = self.run_it()
        self.assertIn("## Not measured with these programs yet\n\n- Is it slow? `make -C pipeline accuracy RUN=clock.slow` (a day)\n", text)
        self.assertNotIn("Seconds a day.", text)

    def test_the_tables_of_what_a_command_prints_stand_below_command_commit_date_and_processor(self):
        text = self.run_it("clock.slow")
        self.assertRegex(text, r"(?s)    printf '.*' WORDS\n\nCommit \w+( and changes)?, \d{4}-\d\d-\d\d, .+, load [0-9.]+; all of it took .* s of CPU\.")
        self.assertIn("| a | b |\n|---|---|\n| 1 | 2 |\n\n| c |\n|---|\n| 3 |\n<!-- end -->", text)
        self.assertIn("RUN=clock.rows", text)  # not asked for

    def test_only_the_tables_are_taken_whose_beginning_is_named(self):
        self.declare(PAGE.replace('cost = "a day"', 'starting = ["| c |"]'))
        text = self.run_it("clock.slow")
        self.assertNotIn("\n| a |", text)
        self.assertIn("| 3 |", text)
        self.declare(PAGE.replace('cost = "a day"', 'starting = ["| d |"]'))
        with self.assertRaises(SystemExit):
            self.run_it("clock.slow")

    def test_rows_are_runs_and_their_numbers_come_from_the_reports(self):
        rows = [line.split("|")[1:-1] for line in self.run_it("clock.rows").splitlines() if line.startswith("|")]
        self.assertEqual([[cell.strip() for cell in row] for row in rows if "-" not in row[0]],
                         [["case", "d", "difference, %", "nothing", "arguments"], ["one", "1.50", "-25.0", "", "`1.5`"],
                          ["two", "2.00", "", "", "`2`"]])

    def test_a_table_can_be_a_csv_file_that_the_command_writes(self):
        self.declare(PAGE[:PAGE.index("[[table]]")] + '[[table]]\nname = "n"\nquestion = "q"\ncsv = "a.csv"\n'
                     "command = \"printf 'x,y\\\\n1,2\\\\n' > {out}/a.csv\"\n")
        self.assertIn("> out/a.csv\n\nCommit", text := self.run_it("clock.n"))
        self.assertIn("| x | y |\n|---|---|\n| 1 | 2 |\n<!-- end -->", text)

    def test_what_is_not_measured_again_stays_below_a_new_text(self):
        before = accuracy.kept(self.run_it("clock"))
        self.declare(PAGE.replace("Seconds a day", "Minutes a year").replace("printf", "false"))
        text = self.run_it()
        self.assertIn("Minutes a year", text)
        self.assertEqual(accuracy.kept(text), before)
        with self.assertRaises(SystemExit):  # the command fails, and the page stays
            self.run_it("clock")
        self.assertEqual(self.page.read_text(), text)

    def test_a_stored_file_gives_the_commit_and_date_of_its_last_change(self):
        stored = "pipeline/verify/brownian.json"
        self.declare(f'page = "PAGE"\ntitle = "t"\n[[table]]\nname = "n"\nquestion = "q"\nfile = "{stored}"\ncommand = "c"\nprocessor = "p"\n'
                     'row = "r"\ncolumns = [["d_c", "d_c_relative.difference", ".4f"]]\n')
        text = self.run_it("clock.n")
        self.assertRegex(text, rf"Commit \w+, \S+, p; stored in `{stored}`\.")
        for name, row in json.loads((ROOT / stored).read_text()).items():
            self.assertRegex(text, rf"\| {name} +\| {row['d_c_relative']['difference']:.4f} ")

    def test_a_name_that_is_not_declared_is_refused_with_those_that_are(self):
        with self.assertRaisesRegex(SystemExit, "no such table: clock.fast; there are clock.rows, clock.slow"):
            self.run_it("clock.fast")


class InTheTree(unittest.TestCase):
    def test_every_page_is_what_its_declaration_makes_of_its_tables(self):
        for name, declared in accuracy.declarations().items():
            with self.subTest(page=declared["page"]):
                text = (ROOT / declared["page"]).read_text(encoding="utf-8")
                self.assertEqual(accuracy.render(name, declared, accuracy.kept(text)), text)
                self.assertLessEqual(set(accuracy.kept(text)), {table["name"] for table in declared["table"]})

    def test_every_test_that_a_page_names_exists(self):
        tests = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("*") if path.suffix in (".cpp", ".txt", ".py"))
        for name, declared in accuracy.declarations().items():
            for test in re.findall(r"`\w+(?:/\*)?\.(\w+)(?:/\*)?`", declared.get("closing", "")):
                with self.subTest(page=name, test=test):
                    self.assertTrue(re.search(rf"\b{test}\b", tests), "there is no such test")


if __name__ == "__main__":
    unittest.main()
