# SPDX-License-Identifier: BSD-3-Clause
"""What every command shows in terminals of 60, 80, 100 and 120 characters, as it was last looked at.

Digits are masked: the layout is held here, the numbers elsewhere. `pytest --write-snapshots` takes what is shown now;
look at the difference before it is committed.
"""

from __future__ import annotations

import re
import shutil
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import redirect_stderr
from functools import partial
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest

from forcetorque.app.command_line import commands, whole_program
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.lazy import named
from forcetorque.fleet.added_and_failed_recordings import add_recordings
from forcetorque.fleet.sensor_record import AddOptions
from forcetorque.plates.simulated_plates import SimulatedPlate, write_pole_trial, write_standing
from forcetorque.results.answer import MOST_LINES
from forcetorque.results.command import command_of
from forcetorque.results.result import Result
from forcetorque.results.terminal import command_output as output
from forcetorque.workbench.simulated_benches import BenchFaults
from tests.app.added_command import added_command
from tests.app.commands import question_of, typed_commands
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.formats.lerobot.datasets import tool_episodes, write_dataset
from tests.locomotion.foot_forces import write_foot_forces
from tests.scenes.benches import write_bench
from tests.scenes.chambers import write_chambers
from tests.scenes.device_designs import hardly_optimise
from tests.scenes.excited_sensors import write_taps
from tests.scenes.experiments import PARQUET, TWO
from tests.scenes.patches import collapsed, cylinder_patch, position_text
from tests.scenes.swaying import write_swaying
from tests.scenes.thermal_cycles import record, write_cycles
from tests.scenes.touched import write_table, write_touched
from tests.scenes.tutorial_log import FOLDER as FOLDER_OF_THE_TUTORIAL
from tests.scenes.wrist_contest import write_contest, write_runs
from tests.scenes.wrist_sessions import write_sessions

WIDTHS = (60, 80, 100, 120)
FOLDER = Path(__file__).parent / "snapshots"
LIMITS = (
    'schema = "forcetorque/acceptance/1"\nname = "leg"\n\n[evaluate]\nforce_error_mean_N = 1.0\nrmse = { fz = 0.5 }\n'
)
SHORT = ("--type", "OnTdTO", "--type", "CnTdTO", "--lambda", "0", "--lambda", "100")
KNEE = ("--column", "robot.position.knee", "--desired", "robot.position.knee_desired")


POLE = ("--serial", "FP1", "--measure-direction", "parent_to_child", "--tip", "pole_tip", "--head", "pole_head")
POLE += ("--load-cell", "load_cell")


def _of_experiments() -> dict[str, tuple[str, ...]]:
    """Commands of experiments or their sensors, on the experiment of the small arm."""
    analyses = {name: named(reference) for name, reference in commands().items()}
    return {
        name: (*name.split(), PARQUET)
        for name, analysis in analyses.items()
        if command_of(analysis) and next(iter(analysis.__annotations__.values())) in ("SensorRun", "Runs", "Experiment")
    }


COMMANDS = _of_experiments() | {
    "accept": ("accept", PARQUET, "--spec", "limits.toml", "-c", "fitted.json"),
    "robot balance": ("robot", "balance", "feet/standing.toml", "--touch", "50N", "--release", "20N"),
    "calibrate": ("calibrate", PARQUET, "-o", "new.json", "--lambda", "5"),
    "robot coherence": ("robot", "coherence", PARQUET, "-c", "fitted.json", "--offset", "fitted", "--offset", "none"),
    "robot collisions": ("robot", "collisions", PARQUET, "--free", "fit"),
    "study compare": ("study", "compare", PARQUET, "-c", "fitted.json"),
    "dataset check": ("dataset", "check", "learning/frames", "--sense", "sensor_to_world"),
    "bench device": ("bench", "device"),
    "bench contest": ("bench", "contest", "wrist/contest.toml"),
    "estimate": ("estimate", PARQUET, "-o", "contacts.parquet", "-c", "fitted.json"),
    "evaluate": ("evaluate", PARQUET, "-c", "fitted.json"),
    "export": ("export", "fitted.json", "--to", "csv", "-o", "matrix.csv"),
    "fleet add": ("fleet", "add", PARQUET, "--into", "new_dataset"),
    "fleet report": ("fleet", "report", "dataset", "-c", "fitted.json", "-o", "fleet.html"),
    "fleet table": ("fleet", "table", "dataset"),
    "bench gains": ("bench", "gains", PARQUET),
    "init": ("init", "begun/log.csv", "--urdf", "begun/robot.urdf", "-o", "begun.toml"),
    "inspect": ("inspect", "faulty.toml"),
    "robot motion": ("robot", "motion", "sway/swaying.toml", *KNEE),
    "plan": ("plan", PARQUET, "-c", "fitted.json", "--clearance-deg", "12", "--seconds", "20", "--recordings", "2"),
    "report": ("report", PARQUET, "fitted.json", "-o", "report.html"),
    "bench response": ("bench", "response", "excited/taps.toml", "-e", "impact", "--force", "log"),
    "skin calibrate": ("skin", "calibrate", "fit.toml", "kept.toml", "-o", "palm.json"),
    "skin check": ("skin", "check", "patch.txt"),
    "skin wrench": ("skin", "wrench", "touched.toml", "--table", "shank.json"),
    "study sphere": ("study", "sphere", PARQUET, "-c", "fitted.json"),
    "study fits": ("study", "fits", PARQUET, "-o", "study", *SHORT),
    "tare": ("tare", PARQUET, "--interval", "judge", "-c", "fitted.json"),
    "bench plate": ("bench", "plate", "floor/standing.c3d"),
    "bench fit-plate": ("bench", "fit-plate", "floor/pole.c3d", *POLE),
    "bench sensor": ("bench", "sensor", "--force", "0,0,500", "--lever", "0,0.01,0"),
    "bench thermal": ("bench", "thermal", "chamber/chamber.toml"),
    "bench drift": ("bench", "drift", "days/days.toml"),
    "study validate": ("study", "validate", TWO, "-c", "fitted.json"),
    "view": ("view", PARQUET, "-o", "view.html"),
    "bench workbench": ("bench", "workbench", "SIM001.toml"),
}
"""What is typed; of a command that only needs an experiment nothing has to be stated."""
SLOW = ("bench device", "skin wrench")
"""Commands that take some seconds, of which other tests see the table."""
WITHOUT_TABLE = {
    "dataset compensate",
    "demo",
    "fleet run",
    "live",
    "payload",
    "robot joint-collisions",
    "robot oscillation-causes",
    "robot torque-loop",
    "run",
    "schema",
    "simulate",
    "study skin",
}
"""Shown elsewhere: `payload` needs a wrist, `fleet run` processes, `simulate`, `torque-loop`, `oscillation-causes`,
`study skin`, `run` and `demo` minutes; `schema` is JSON; `dataset compensate` a dataset, `live` a stream,
`joint-collisions` an arm, which their own tests have."""


def _write_limits(arm: Path) -> None:
    (arm / "limits.toml").write_text(LIMITS, encoding="utf-8")


def _write_faulty(arm: Path) -> None:
    text = (arm / PARQUET).read_text(encoding="utf-8")
    limited = text.replace('stream = "arm_ft"', 'stream = "arm_ft"\nlimit_counts = 9000')
    (arm / "faulty.toml").write_text(limited, encoding="utf-8")


def _write_touch(arm: Path) -> None:
    write_chambers(arm)
    write_touched(arm, broken=25)
    write_table(arm)


def _write_warm_record(arm: Path) -> None:
    (arm / "chamber").mkdir()
    write_cycles(arm / "chamber", *record(np.random.default_rng(1), hours=0.2))


def _write_days(arm: Path) -> None:
    (arm / "days").mkdir()
    write_sessions(arm / "days")


def _write_runs(arm: Path) -> None:
    (arm / "wrist").mkdir()
    write_runs(arm / "wrist")
    write_contest(arm / "wrist", {"masses": 1.0, "judge": 2.0})


def _write_fast(arm: Path) -> None:
    (arm / "excited").mkdir()
    write_taps(arm / "excited")


def _write_feet(arm: Path) -> None:
    (arm / "feet").mkdir()
    write_foot_forces(arm / "feet")


def _write_sway(arm: Path) -> None:
    (arm / "sway").mkdir()
    write_swaying(arm / "sway")


def _write_dataset(arm: Path) -> None:
    episodes = tool_episodes([60] * 6, seed=1, mass=[0.8] * 3 + [1.1] * 3)
    episodes[1]["observation.wrench"][20:45, 3] = 0.123
    write_dataset(arm / "learning" / "frames", episodes)


def _write_plates(arm: Path) -> None:
    (arm / "floor").mkdir()
    rng = np.random.default_rng(3)
    plates = [SimulatedPlate.draw(rng, centre_m=(x, 0.4), crosstalk=0.02, corner_error_m=0.003) for x in (0.3, 0.9)]
    write_standing(arm / "floor" / "standing.c3d", plates, rng)
    write_pole_trial(arm / "floor" / "pole.c3d", plates[0], rng)


def _write_log(arm: Path) -> None:
    shutil.copytree(FOLDER_OF_THE_TUTORIAL, arm / "begun")


def _write_records(arm: Path) -> None:
    add_recordings([arm / PARQUET], arm / "dataset", AddOptions())


def _write_patch(arm: Path) -> None:
    (arm / "patch.txt").write_text(position_text(collapsed(cylinder_patch(), 4)), encoding="utf-8")


WRITTEN: Mapping[str, Callable[[Path], object]] = MappingProxyType(
    {
        "limits.toml": _write_limits,
        "faulty.toml": _write_faulty,
        "fit.toml": write_chambers,
        "touched.toml": _write_touch,
        "chamber/chamber.toml": _write_warm_record,
        "days/days.toml": _write_days,
        "wrist/contest.toml": _write_runs,
        "excited/taps.toml": _write_fast,
        "sway/swaying.toml": _write_sway,
        "begun/log.csv": _write_log,
        "patch.txt": _write_patch,
        "dataset": _write_records,
        "learning/frames": _write_dataset,
        "feet/standing.toml": _write_feet,
        "floor/standing.c3d": _write_plates,
        "floor/pole.c3d": _write_plates,
        "SIM001.toml": partial(write_bench, faults=BenchFaults(swapped=(3, 8))),
    }
)
"""What writes the files that commands above name, beyond those of the arm."""


@pytest.fixture
def shown_widths(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a command show its result once for every width, with warnings, and its details."""
    show = output.show_table

    def at_every_width(
        result: Result, *, details: bool, experiments: Sequence[Path], refusals: Sequence[ForceTorqueError]
    ) -> None:
        assert not details
        assert not refusals
        for width in WIDTHS:
            monkeypatch.setenv("COLUMNS", str(width))
            sys.stdout.write(f"===== {width} =====\n")
            with redirect_stderr(sys.stdout):
                show(result, details=False, experiments=experiments)
        for width in WIDTHS if tuple(result.answers()) else ():
            sys.stdout.write(f"===== {width} details =====\n{result.details(width)}")

    monkeypatch.setattr(output, "show_table", at_every_width)


def test_a_command_of_experiments_is_here_without_a_line() -> None:
    """The toy that is added; one that is not added is not."""
    with added_command():
        assert _of_experiments()["extent"] == ("extent", PARQUET)
    assert "extent" not in _of_experiments()


def test_every_command_is_here() -> None:
    """A new command gets its picture."""
    assert set(typed_commands(whole_program())) == COMMANDS.keys() | WITHOUT_TABLE


@pytest.fixture
def _hardly_optimised(monkeypatch: pytest.MonkeyPatch) -> None:
    hardly_optimise(monkeypatch)


@pytest.mark.usefixtures("shown_widths", "blank_pictures", "_hardly_optimised")
@some_cases("name", sorted(COMMANDS, key=SLOW.__contains__), quick=len(COMMANDS) - len(SLOW))
def test_the_layout_is_that_which_was_looked_at(arm: Path, run: Run, name: str, request: pytest.FixtureRequest) -> None:
    """Line by line; no line of a table is wider than the terminal."""
    for file in COMMANDS[name][1:]:
        if file in WRITTEN:
            WRITTEN[file](arm)
    ended = run(*COMMANDS[name])
    codes = (0, 1, 3) if COMMANDS[name][0] == "accept" else (0, 1)  # accepted, rejected, undecided
    assert ended.code in codes, ended.err
    shown = re.sub(
        r"\d", "0", re.sub(r"(?<======) (\d+) (?=details|=====)", lambda match: f" {'x' * int(match[1])} ", ended.out)
    )
    picture = FOLDER / f"{question_of(name)}.txt"
    if request.config.getoption("--write-snapshots"):
        picture.write_text(shown, encoding="utf-8")
    assert shown == picture.read_text(encoding="utf-8")


def test_no_line_is_wider_than_its_terminal() -> None:
    """In all pictures: tables and sentences alike; a word that is longer than a line, such as a path, stands alone."""
    pictures = sorted(FOLDER.glob("*.txt"))
    assert len(pictures) == len(COMMANDS)
    for picture in pictures:
        width = 0
        for line in picture.read_text(encoding="utf-8").splitlines():
            if line.startswith("====="):
                width = line.count("x")
                continue
            assert len(line) <= width or " " not in line.strip(), (picture.name, width, line)
        assert width == WIDTHS[-1]


def test_the_answer_is_at_most_twelve_lines() -> None:
    """At 80 characters, warnings included, of one sensor and its prior; `inspect` shows its table still."""
    lengths = {}
    for picture in sorted(FOLDER.glob("*.txt")):
        parts = re.split(r"^===== (x+(?: details)?) =====\n", picture.read_text(encoding="utf-8"), flags=re.M)
        shown = dict(zip(parts[1::2], parts[2::2], strict=True))
        if f"{'x' * 80} details" in shown:
            lengths[picture.stem] = shown["x" * 80].count("\n")
    assert len(lengths) >= len(COMMANDS) - 1
    assert {name: length for name, length in lengths.items() if length > MOST_LINES} == {}
