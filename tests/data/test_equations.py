"""common/EQUATIONS.md names the one place in the sources where each equation of the paper stands."""

import collections
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "common/EQUATIONS.md"
MARK = re.compile(r"\(paper, Eqs?\. ([^)]*)\)")
ROW = re.compile(r"\| (\d+) \| [^|]+ \| \[([^\]]+)\]\(([^)]+)\): `([^`]+)` \| [^|]+ \|$")
WITHIN = 45  # lines of a comment and the class or function below it


def marks():
    found = collections.defaultdict(list)
    for folder in ("common", "dryer", "breaker", "rigidstress"):
        for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
            for line, text in enumerate(path.read_text(encoding="utf-8").splitlines()):
                for mark in MARK.finditer(text):
                    for number in mark.group(1).split(","):
                        found[number.strip()].append((str(path.relative_to(ROOT)), line))
    return found


class Equations(unittest.TestCase):
    def setUp(self):
        self.rows = {m.group(1): m.groups()[1:] for m in map(ROW.match, PAGE.read_text(encoding="utf-8").splitlines()) if m}

    def test_all_thirty_are_in_the_table(self):
        self.assertEqual(sorted(map(int, self.rows)), list(range(1, 31)))

    def test_each_is_marked_at_exactly_one_definition_the_one_named(self):
        found = marks()
        self.assertEqual(set(found), set(self.rows))
        for number, (file, _, name) in self.rows.items():
            with self.subTest(equation=number):
                self.assertEqual([place[0] for place in found[number]], [file])
                line = found[number][0][1]
                below = (ROOT / file).read_text(encoding="utf-8").splitlines()[line:line + WITHIN]
                self.assertRegex("\n".join(below), rf"\b{name}\b")

    def test_links_lead_to_the_file(self):
        for number, (file, link, _) in self.rows.items():
            with self.subTest(equation=number):
                self.assertEqual((PAGE.parent / link).resolve(), ROOT / file)


if __name__ == "__main__":
    unittest.main()
