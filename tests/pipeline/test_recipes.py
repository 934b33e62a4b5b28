"""Every command in the manuals is run, in a scratch folder, manual by manual and in the order of the page.

A command is a line of a fenced block ```sh, as typed in the top folder; a line that ends with \\ goes on. A block ```toml or ```python whose first
line is `# NAME.toml` or `# NAME.py` becomes that file. Right before a block one comment may stand:

    <!-- run with: OPTIONS -->    the options are added to each program of the block, to make it short
    <!-- not run: REASON -->      too long: each program of the block is run with --check

Of `make` the target has to exist. A block ```text is what the block of commands before it prints: each of its lines has to be among what was
printed, blanks and numbers (also how many in a row) apart; a line `...` stands for any number of lines.

The messages in the first column of a table below `## Messages` are in the sources, `...` standing for whatever is filled in.
"""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = os.environ.get("CRUMBLE_BUILD", ROOT / "build/release")
MANUALS = ["README.md", "dryer/README.md", "breaker/README.md", "rigidstress/README.md", "common/io/README.md", "pipeline/TUTORIAL.md", "pipeline/campaign/README.md", "pipeline/campaign/KERNEL.md", "pipeline/tracks/README.md"]
PROGRAM = re.compile(r"build/release/bin/(dryer|breaker|rigidstress)\b")
BLOCK = re.compile(r"(?ms)(?:^<!-- (run with|not run): ([^\n]*?) -->\n+)?^```(sh|toml|python|text)\n(.*?)^```$")
# With the unit of a time, which is min instead of s on a slow machine.
NUMBER = re.compile(r"(?<![A-Za-z_])[-+]?\d[\d.,]*(?:e[-+]?\d+)?(?: (?:s|min|h|days)\b)?")


def shape(line):
    return re.sub(r"#( #)+", "#", " ".join(NUMBER.sub("#", line).split()))


def commands(text):
    lines = [re.sub(r"(^|\s+)#.*", "", line) for line in text.replace("\\\n", " ").splitlines()]
    return [line for line in lines if line.strip()]


class Manual:
    def __init__(self, text, folder):
        self.text, self.folder = text, folder
        for name in ("pipeline", "build"):
            (folder / name).mkdir()
        (folder / "build/release").symlink_to(BUILD)
        for name in ("scenes", "python", "tracks"):
            (folder / "pipeline" / name).symlink_to(ROOT / "pipeline" / name)
        (folder / "data").symlink_to(ROOT / "data")
        self.targets = set(re.findall(r"(?m)^([a-z0-9-]+):", (ROOT / "pipeline/Makefile").read_text(encoding="utf-8")))

    def complaints(self):
        """What does not hold, in words."""
        printed = ""
        for way, words, kind, block in BLOCK.findall(self.text):
            if kind in ("toml", "python"):
                first = block.splitlines()[0]
                if match := re.fullmatch(r"# (\S+\.(?:toml|py))", first):
                    (self.folder / match[1]).write_text(block, encoding="utf-8")
            elif kind == "text":
                was = {shape(line) for line in printed.splitlines()}
                yield from (f"is not printed: {line}" for line in block.splitlines() if line.strip() not in ("", "...") and shape(line) not in was)
            else:
                printed = ""
                for command in commands(block):
                    done = self.run(command, way, words)
                    printed += done.stdout
                    if done.returncode:
                        yield f"exit code {done.returncode}: {command}\n{done.stdout}"

    def run(self, command, way, words):
        if make := re.match(r"make -C pipeline\b *([a-z0-9-]*)", command):
            known = not make[1] or make[1] in self.targets
            return subprocess.CompletedProcess(command, 0 if known else 2, "" if known else "no such target\n")
        if PROGRAM.search(command):
            command += {"run with": f" {words}", "not run": " --check", "": ""}[way]
        environment = {**os.environ, "CRUMBLE_BIN": str(pathlib.Path(BUILD) / "bin"), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        return subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=self.folder, env=environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def complaints(text):
    with tempfile.TemporaryDirectory() as folder:
        return list(Manual(text, pathlib.Path(folder)).complaints())


class Recipes(unittest.TestCase):
    def test_every_command_of_the_manuals_works_and_prints_what_is_shown(self):
        for name in MANUALS:
            with self.subTest(manual=name):
                self.assertEqual(complaints((ROOT / name).read_text(encoding="utf-8")), [])

    def test_the_manual_of_the_dryer_has_recipes(self):
        blocks = BLOCK.findall((ROOT / "dryer/README.md").read_text(encoding="utf-8"))
        self.assertGreater(sum(len(commands(block)) for _, _, kind, block in blocks if kind == "sh"), 7)


    def test_every_message_that_a_manual_explains_is_one_of_the_programs(self):
        paths = [path for folder in ("common", "dryer", "breaker", "rigidstress") for path in sorted((ROOT / folder).rglob("*.[ch]pp"))]
        # Literals that go on in the next line are one.
        sources = re.sub(r'"\s*\n\s*"', "", "\n".join(path.read_text(encoding="utf-8") for path in paths))
        for name in MANUALS:
            for message in re.findall(r"(?m)^\| `([^`]+)` \|", (ROOT / name).read_text(encoding="utf-8").partition("## Messages")[2]):
                for part in message.split("..."):
                    with self.subTest(manual=name, message=message):
                        self.assertTrue(part.strip(" :;,") in sources, part)


class TheTestItself(unittest.TestCase):
    def complain(self, text, *patterns):
        found = complaints(text)
        self.assertEqual(len(found), len(patterns), found)
        for complaint, pattern in zip(found, patterns):
            self.assertRegex(complaint, pattern)

    def test_a_key_that_does_not_exist_is_found_even_where_the_run_is_too_long(self):
        for way in ("", "<!-- not run: an hour -->\n", "<!-- run with: --check -->\n"):
            self.complain(way + "```sh\nbuild/release/bin/dryer pipeline/scenes/hollow.toml --set particle.raduis=1 -o a.h5\n```\n", "did you mean")

    def test_a_scene_of_the_page_is_a_file_and_its_faults_are_found(self):
        self.complain("```toml\n# my.toml\n[particle]\nraduis = 1\n```\n```sh\nbuild/release/bin/dryer my.toml --check\n```\n", "my.toml:3")

    def test_other_numbers_are_allowed_and_other_words_are_not(self):
        self.complain("```sh\necho 'd_c   160.5 nm in 3 s'\n```\n```text\n...\nd_c 1.7e-3 nm in 2 min\n```\n")
        self.complain("```sh\necho 'd_c   160.5 nm'\n```\n```text\nd_c 160.5 um\n```\n", "is not printed: d_c 160.5 um")

    def test_a_target_that_does_not_exist_is_found(self):
        self.complain("```sh\nmake -C pipeline table2\nmake -C pipeline table9\n```\n", "table9")


if __name__ == "__main__":
    unittest.main()
