# SPDX-License-Identifier: BSD-3-Clause
"""Run the tests on every Python of pyproject.toml, on the oldest of them with the oldest dependencies that it allows.

Every Python has its own environment under build/matrix, the newer ones with what uv.lock says. uv finds a Python on the
PATH, or downloads it. What is no option of this command is given to pytest:

    python -m tests.matrix [--only 3.12] tests -m "not long"
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import time
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
UV = Path(sys.executable).with_name("uv")
CLASSIFIER = "Programming Language :: Python :: "


@dataclass(frozen=True)
class Combination:
    """A Python, and how its dependencies are chosen: `locked`, or `lowest-direct` as uv calls it."""

    python: str
    resolution: str

    @property
    def folder(self) -> Path:
        """Its environment."""
        return ROOT / "build" / "matrix" / f"{self.python}-{self.resolution}"

    def passes(self, options: Sequence[str]) -> bool:
        """Install what it needs, and run pytest."""
        install = self._install_locked if self.resolution == "locked" else self._install_oldest
        return install() and _ran(self.folder / "bin" / "python", "-m", "pytest", *options)

    def _install_locked(self) -> bool:
        where = {"UV_PROJECT_ENVIRONMENT": str(self.folder)}
        return _ran(UV, "--quiet", "sync", "--locked", "--extra", "test", "--python", self.python, **where)

    def _install_oldest(self) -> bool:
        """Hold what the library needs, with all extras, to the oldest; tools of the tests are as new as that allows."""
        shutil.rmtree(self.folder, ignore_errors=True)
        oldest = self.folder / "oldest.txt"
        choice = ("--extra", "all", "--resolution", self.resolution, "--constraint", "tests/matrix_constraints.txt")
        commands: list[tuple[str | Path, ...]] = [
            ("venv", "--python", self.python, self.folder),
            ("pip", "compile", "pyproject.toml", *choice, "--python", self.folder, "--output-file", oldest),
            ("pip", "install", "--editable", ".[test]", "--constraint", oldest, "--python", self.folder),
        ]
        return all(_ran(UV, "--quiet", *command) for command in commands)


def combinations() -> list[Combination]:
    """Every Python that pyproject.toml names."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = [line.removeprefix(CLASSIFIER) for line in project["classifiers"] if line.startswith(CLASSIFIER)]
    oldest = project["requires-python"].removeprefix(">=")
    return [Combination(python, "lowest-direct" if python == oldest else "locked") for python in named]


def main() -> int:
    """Run them one after the other; 1 if any fails."""
    known = {combination.python: combination for combination in combinations()}
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("--only", choices=known, help="the one Python to run")
    given, options = parser.parse_known_args()
    lines, good = [], True
    for combination in [known[given.only]] if given.only else known.values():
        begin = time.monotonic()
        passed = combination.passes(options)
        good &= passed
        minutes = (time.monotonic() - begin) / 60
        verdict = "passed" if passed else "failed"
        lines.append(f"Python {combination.python}  {combination.resolution:<13}  {verdict}  {minutes:5.1f} min\n")
    sys.stdout.writelines(lines)
    return 0 if good else 1


def _ran(*command: str | Path, **environment: str) -> bool:
    return subprocess.run(command, cwd=ROOT, env=os.environ | environment, check=False).returncode == 0


if __name__ == "__main__":
    sys.exit(main())
