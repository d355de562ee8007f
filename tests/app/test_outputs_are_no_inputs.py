# SPDX-License-Identifier: BSD-3-Clause
"""Every output option of every command: no input and no file of somebody else is written over."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import get_args, get_type_hints

import pytest
from typer import Typer
from typer.models import OptionInfo

from forcetorque.app.command_line import whole_program
from tests.app.outcome import Run
from tests.browser import BROWSERS
from tests.cases import some_cases
from tests.scenes.benches import write_bench
from tests.scenes.experiments import PARQUET, TWO, YARP, edit, snapshot

INPUT_OPTIONS = {
    "--browser",
    "--calibration",
    "--catalogue",
    "--load",
    "--matrices",
    "--mesh-dir",
    "--plan",
    "--population",
    "--replay",
    "--robot",
    "--resume",
    "--spec",
    "--stream",
    "--urdf",
    "--warm-up",
    "--weights",
}
"""Options with a path that is read, in every command that has them; lines of what is resumed are rewritten in it."""
TABLE_THAT_IS_READ = ("skin wrench", "--table")
NEW_FOLDERS = {
    ("bench device", "--figures"),
    ("bench device", "--output"),
    ("dataset compensate", "--output"),
    ("plan", "--output"),
    ("simulate", "--output"),
    ("study fits", "--output"),
}
"""Outputs that must not be there yet, or be empty folders."""
FOLDERS = {("calibrate", "--moments"), ("demo", "--output"), ("fleet add", "--into"), ("run", "--output")}
"""Outputs that are added to what a folder holds."""

WORDS = {
    "demo": "",
    "robot balance": f"{PARQUET}",
    "calibrate": f"{PARQUET} -o new.json",
    "robot coherence": f"{PARQUET}",
    "robot collisions": f"{PARQUET}",
    "accept": f"{PARQUET} --spec fitted.json",
    "study compare": f"{PARQUET}",
    "study validate": f"{PARQUET}",
    "bench fit-plate": f"{PARQUET} --serial FP1 --measure-direction parent_to_child",
    "bench contest": f"{PARQUET}",
    "bench device": f"{PARQUET}",
    "bench plate": f"{PARQUET}",
    "dataset check": f"{PARQUET}",
    "dataset compensate": f"{PARQUET} -o new",
    "estimate": f"{PARQUET} -o new.csv",
    "evaluate": f"{PARQUET} -c fitted.json",
    "export": "fitted.json --to csv",
    "fleet add": f"{PARQUET}",
    "fleet report": "fitted.json -c fitted.json",
    "fleet run": f"{PARQUET}",
    "fleet table": f"{PARQUET}",
    "bench gains": f"{PARQUET}",
    "init": f"{PARQUET}",
    "inspect": f"{PARQUET}",
    "live": f"{PARQUET} --replay {PARQUET}",
    "robot joint-collisions": f"{PARQUET}",
    "robot motion": f"{PARQUET}",
    "payload": f"{PARQUET} --to ft-tools",
    "plan": f"{PARQUET}",
    "report": f"{PARQUET}",
    "bench response": f"{PARQUET} -e impact",
    "run": f"{PARQUET}",
    "simulate": f"{PARQUET}",
    "skin calibrate": f"{PARQUET} -o new.json",
    "skin check": f"{PARQUET}",
    "skin wrench": f"{PARQUET} --table fitted.json",
    "study sphere": f"{PARQUET}",
    "study fits": f"{PARQUET} -o studied",
    "study skin": f"{PARQUET}",
    "tare": f"{PARQUET} --interval fit --to ft-tools",
    "bench sensor": f"{PARQUET}",
    "bench thermal": f"{PARQUET}",
    "bench drift": f"{PARQUET}",
    "robot oscillation-causes": f"{PARQUET}",
    "robot torque-loop": f"{PARQUET}",
    "view": f"{PARQUET}",
    "bench workbench": f"{PARQUET}",
}
"""What every command with an output is asked; its first word is read by it."""
ENDINGS = {
    "robot balance": ".csv",
    "estimate": ".parquet",
    "fleet report": ".html",
    "live": ".parquet",
    "report": ".html",
    "skin calibrate": ".json",
    "skin wrench": ".csv",
    "calibrate": ".json",
}
"""Of `--output`, where the command takes only that."""

IS_INPUT = "expected a file to write that is not read, got an input of this run"
IS_FOREIGN = "expected a new file, or a result or figure to replace, got another file"


def _path_options(program: Typer, group: str = "") -> Iterator[tuple[str, str]]:
    """Command and long name of every option with a path."""
    for inner in program.registered_groups:
        assert inner.typer_instance is not None
        yield from _path_options(inner.typer_instance, f"{inner.typer_instance.info.name} ")
    for command in program.registered_commands:
        assert command.callback is not None
        for name, hint in get_type_hints(command.callback, include_extras=True).items():
            for option in getattr(hint, "__metadata__", ()):
                if isinstance(option, OptionInfo) and "Path" in str(get_args(hint)[0]):
                    # the first flag in an annotation is where typer expects a default until it reads the signature
                    flags = (option.default, *(option.param_decls or ()))
                    declared = [flag for flag in flags if isinstance(flag, str) and flag.startswith("--")]
                    yield f"{group}{command.name}", next(iter(declared), f"--{name.replace('_', '-')}")


OPTIONS = sorted(_path_options(whole_program()))
OUTPUTS = [each for each in OPTIONS if each[1] not in INPUT_OPTIONS and each != TABLE_THAT_IS_READ]
FILES = [each for each in OUTPUTS if each not in NEW_FOLDERS | FOLDERS]
FORCED = {words for words, option in FILES if option == "--output"}
"""Commands with `--force`: those with an output that is no figure."""


def _asked(command: str, option: str, name: str) -> list[str]:
    """Words of the command with another output in place of its own."""
    words = [*command.split(), *WORDS[command].split()]
    if option == "--output" and "-o" in words:
        del words[words.index("-o") :][:2]
        del words[words.index("-o") : words.index("-o") + 2]
    if option in {"--figure", "--view"} and "--to" in words:  # the form of the file that --output names
        del words[words.index("--to") : words.index("--to") + 2]
    return [*words, option, name]


def _ending(command: str, option: str) -> str:
    own = {
        "--figure": ".png",
        "--film": ".gif",
        "--repaired": ".csv",
        "--table": ".csv",
        "--video": ".mp4",
        "--view": ".html",
    }
    return own.get(option) or ENDINGS.get(command, ".out")


def test_every_output_option_is_looked_at() -> None:
    """A new command with an output needs its words here; a new option is an output unless it is said to be read."""
    assert {command for command, _ in OUTPUTS} == set(WORDS)
    assert set(OUTPUTS) > NEW_FOLDERS | FOLDERS
    assert {option for _, option in OPTIONS if (_, option) not in OUTPUTS} - {"--table"} == INPUT_OPTIONS
    assert len(FILES) > 25


@pytest.mark.parametrize(("command", "option"), FILES)
def test_an_output_that_is_an_input_is_refused(arm: Path, run: Run, command: str, option: str) -> None:
    """Also behind a link with the ending that the command takes, and whatever is forced; nothing changes."""
    if option == "--video" and not any(map(shutil.which, BROWSERS)):
        pytest.skip(f"no browser: none of {', '.join(BROWSERS)} is installed")
    name = f"output{_ending(command, option)}"
    Path(name).symlink_to(WORDS[command].split()[0])
    before = snapshot(arm)
    words = _asked(command, option, name)
    forced = command in FORCED
    # a calibration is a result, which needs no force; the sensors name the files of `calibrate`, so it reads first
    read_first = (command, option) in {
        ("calibrate", "--output"),
        ("calibrate", "--write-urdf"),
        ("export", "--output"),
        ("fleet report", "--figure"),
        ("fleet report", "--output"),
    }
    assert (IS_INPUT if read_first else IS_FOREIGN) in run(*words).error()
    if forced:
        assert IS_INPUT in run(*words, "--force").error()
    assert snapshot(arm) == before


@pytest.mark.parametrize(("command", "option"), sorted(NEW_FOLDERS))
def test_a_folder_that_is_there_stays(arm: Path, run: Run, command: str, option: str) -> None:
    """Also where it holds the log that is read."""
    before = snapshot(arm)
    assert run(*_asked(command, option, "recording")).code == 2
    assert snapshot(arm) == before


def test_kept_moments_never_replace_an_input(arm: Path, run: Run) -> None:
    """Their names are known once the recording is read; a link under that name to the robot is not followed."""
    Path("kept").mkdir()
    place = Path("kept/arm_ft_SIM001_small arm.json")
    assert run("calibrate", PARQUET, "-o", "new.json", "--moments", "kept").code == 0
    place.unlink()
    place.symlink_to("../arm.urdf")
    before = snapshot(arm)
    words = ("calibrate", PARQUET, "-o", "new.json", "--moments", "kept")
    for more in ((), ("--force",)):
        assert "got an input of " in run(*words, *more).err
    assert snapshot(arm) == before


NESTED = {
    PARQUET: ("arm.urdf", "matrix_SIM001.txt", "recording/arm_ft.parquet", "recording/joints.parquet", PARQUET),
    YARP: ("log/arm_ft/analog:o/data.log", "log/arm/stateExt:o/info.log"),
}
"""What an experiment file points to, directly and inside a folder that it names."""


@pytest.mark.parametrize("linked", [False, True], ids=["symbolic", "hard"])
@pytest.mark.parametrize(("file", "source"), [(file, one) for file, sources in NESTED.items() for one in sources])
def test_all_that_an_experiment_points_to_is_an_input(
    arm: Path, run: Run, file: str, source: str, linked: bool
) -> None:
    """Every file that provenance hashes, under any of its names."""
    for ending in (".parquet", ".json", ".out"):
        link = Path(f"output{ending}")
        link.hardlink_to(source) if linked else link.symlink_to(source)
    before = snapshot(arm)
    for words in (
        ("estimate", file, "-o", "output.parquet"),
        ("calibrate", file, "-o", "output.json"),
        ("tare", file, "--interval", "fit", "--to", "ft-tools", "-o", "output.out"),
        ("view", file, "-o", "output.out"),
    ):
        assert IS_INPUT in run(*words, "--force").error(), words
    assert snapshot(arm) == before


@pytest.mark.parametrize(
    ("words", "source"),
    [
        (("calibrate", TWO, "--jointly", "-o", "."), "arm.urdf"),
        (("calibrate", PARQUET, "-o", "."), "arm.urdf"),
        (("estimate", PARQUET, "-c", "fitted.json", "-o", "output.csv"), "fitted.json"),
        (("view", PARQUET, "-c", "fitted.json", "-o", "output.csv"), "fitted.json"),
        (("report", PARQUET, "fitted.json", "-o", "output.html"), "fitted.json"),
        (
            ("export", "fitted.json", "--to", "wholebodydynamics", "--stream", "copy.json", "-o", "copy.json"),
            "arm.urdf",
        ),
    ],
)
def test_files_that_options_name_are_inputs(arm: Path, run: Run, words: tuple[str, ...], source: str) -> None:
    """Calibrations, and every file of a folder of results."""
    Path("copy.json").write_bytes(Path("fitted.json").read_bytes())
    for name in ("output.csv", "output.html", "arm_ft_SIM001.json"):
        Path(name).symlink_to(source)
    before = snapshot(arm)
    assert IS_INPUT in run(*words, "--force").error()
    assert snapshot(arm) == before


def test_readings_of_a_bench_are_inputs(tmp_path: Path, run: Run) -> None:
    """Its file names the blocks, which `-o` must not replace."""
    bench, _ = write_bench(tmp_path)
    before = snapshot(tmp_path)
    for name in (bench.name, "nominal.txt", "SIM001_output1.dat", "SIM001_output24.dat"):
        assert IS_INPUT in run("bench", "workbench", bench, "-o", tmp_path / name, "--force").error(), name
    assert snapshot(tmp_path) == before


def test_one_recording_is_not_written_over_before_it_is_read(arm: Path, run: Run) -> None:
    """The estimates of the first of two files would take the place of the log of the second."""
    Path("late.toml").write_bytes(Path(PARQUET).read_bytes())
    edit(Path("late.toml"), 'path = "recording"', 'path = "later"')
    Path("later").mkdir()
    for file in Path("recording").iterdir():
        (Path("later") / file.name).write_bytes(file.read_bytes())
    Path("samples.parquet.parquet").symlink_to("later/arm_ft.parquet")
    before = snapshot(arm)
    assert IS_INPUT in run("estimate", PARQUET, "late.toml", "-o", "samples.parquet", "--force").error()
    assert snapshot(arm) == before


def test_two_outputs_are_two_files(palm_words: tuple[str, ...], run: Run) -> None:
    """The second would replace the first."""
    assert "got the same one twice" in run(*palm_words, "-o", "same.csv", "--table", "./same.csv").error()


@pytest.fixture
def palm_words(arm: Path) -> tuple[str, ...]:
    """A command with two outputs of any ending."""
    return ("skin", "calibrate", PARQUET)


FOREIGN = {
    "robot.urdf": b'<?xml version="1.0"?>\n<robot name="arm"/>\n',
    "experiment.toml": b'schema = "forcetorque/experiment/1"\n',
    "log.csv": b"t,fx,fy\n0,1,2\n",
    "log.mat": b"MATLAB 5.0 MAT-file, Platform: GLNXA64",
    "log.h5": b"\x89HDF\r\n\x1a\n",
    "log.npz": b"PK\x03\x04",
    "log.bag": b"#ROSBAG V2.0\n",
    "log.mcap": b"\x89MCAP0\r\n",
    "link.stl": b"solid link\n",
    "link.dae": b'<?xml version="1.0"?>\n<COLLADA/>\n',
    "package.json": b'{"name": "mine"}',
    "recording.json": b'{"schema": "forcetorque/recording/1"}',
    "params.yaml": b"controller_manager:\n",
    "short.parquet": b"PAR1",
}


@pytest.mark.parametrize("name", FOREIGN)
def test_what_somebody_else_made_is_replaced_only_by_force(arm: Path, run: Run, name: str) -> None:
    """The first run changes nothing, the second writes what it was asked for."""
    Path(name).write_bytes(FOREIGN[name])
    words = ("export", "fitted.json", "--to", "csv", "-o", name)
    assert IS_FOREIGN in run(*words).error()
    assert Path(name).read_bytes() == FOREIGN[name]
    assert run(*words, "--force").code == 0
    assert Path(name).read_text(encoding="utf-8").startswith("sensor,serial,component")


@pytest.mark.parametrize("name", ["matrix_SIM001.txt", "recording/joints.parquet", "log/arm_ft/analog:o/data.log"])
def test_real_files_of_others_are_seen_as_such(arm: Path, run: Run, name: str) -> None:
    """A matrix file, a stream of a recording and a port of a log, none of which the command reads."""
    before = snapshot(arm)
    assert IS_FOREIGN in run("export", "fitted.json", "--to", "csv", "-o", name).error()
    assert snapshot(arm) == before


@some_cases(
    "words",
    [
        ("calibrate", PARQUET, "-o", "folder"),
        ("estimate", PARQUET, "-o", "new.parquet"),
        ("estimate", PARQUET, "-o", "new.csv"),
        ("export", "fitted.json", "--to", "csv", "-o", "new"),
        ("export", "fitted.json", "--to", "wholebodydynamics", "-o", "new"),
        ("export", "fitted.json", "--to", "csv", "-o", "empty"),
        ("view", PARQUET, "-o", "new.html"),
        ("calibrate", PARQUET, "-o", "new.json", "--figure", "new.png"),
    ],
    quick=6,
)
def test_a_result_is_replaced_by_the_next_one(arm: Path, run: Run, words: tuple[str, ...]) -> None:
    """Whoever types a command again wants its result again: no force is needed."""
    Path("empty").touch()
    for _ in range(2):
        ended = run(*words)
        assert (ended.code, "error" in ended.err) == (0, False), ended.err
