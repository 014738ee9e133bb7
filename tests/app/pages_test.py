#!/usr/bin/env python3
"""docs/commands.md names every command and every option of each, and the completion of each shell does too.

  pages_test.py AXIL SOURCE_FOLDER
"""
import pathlib
import re
import subprocess
import sys
import unittest

AXIL, SOURCE = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
PAGE = (SOURCE / "docs/commands.md").read_text(encoding="utf-8")


def said(*words):
    done = subprocess.run([AXIL, *words], capture_output=True, text=True, encoding="utf-8", timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


COMMANDS = re.findall(r"^  ([a-z-]+)  ", said("--help").split("Subcommands:")[1], re.M)


def options(command):
    return {o for o in re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]*)", said(command, "--help"), re.M)} - {"--help"}


class Pages(unittest.TestCase):
    def test_every_command_and_option_is_on_the_page(self):
        self.assertGreater(len(COMMANDS), 12)
        for command in COMMANDS:
            self.assertIn(f"`axil {command} ", PAGE)
            rows = [row for row in PAGE.splitlines() if row.startswith("|") and f"`{command}`" in row.split("|")[1]]
            for option in options(command):
                known = any(option in row for row in rows) or f"`axil {command} {option}" in PAGE
                self.assertTrue(known, f"{command} {option}")

    def test_completion_knows_them_all(self):
        for shell in ("bash", "zsh", "fish"):
            script = said("completion", shell)
            for command in COMMANDS:
                self.assertIn(command, script)
                for option in options(command):
                    self.assertIn(option if shell != "fish" else f"-l {option[2:]}", script, (shell, command))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
