# SPDX-License-Identifier: BSD-3-Clause
"""What a command costs before it does anything: CPU seconds of a child process, and the modules it loads.

Measured with bytecode at hand on a quiet 2-core machine: 0.1 s for a help, 0.7 to 0.9 s for the load of 24 poses, 1.0
to 1.1 s for a conclusion of the yoga log; it was 0.4, 3.1 and 3.1 s when SciPy came with every module. Neighbours on a
processor make that up to twice as much. So a command that computes is held against a child that only loads what it
needs of others, 0.35 s there: beside other work, on three Pythons, the load took 1.8 to 2.6 times as much in 27 runs,
the conclusion 1.9 to 3.0 times.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from collections.abc import Collection
from pathlib import Path

import pytest

from forcetorque.app.python.experiment import load_experiment
from forcetorque.experiment.calibration.calibration_file import write_calibration
from forcetorque.formats import registry
from forcetorque.formats.registry import LOG_FORMATS
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, YARP, write_experiments

ROOT = Path(__file__).resolve().parents[1]
RUNS = 3
_START = "from forcetorque.app.command_line import main; main()"
_LIBRARIES = """import rich.console, typer, pydantic, numpy, scipy.linalg, scipy.special
import pyarrow.compute, pyarrow.parquet
"""
_LIST = """import atexit, sys
atexit.register(lambda: sys.stderr.write("MODULES " + " ".join(sys.modules) + "\\n"))
"""
UNUSED = ("matplotlib", "pandas", "scipy.signal", "scipy.spatial", "scipy.stats", "scipy.optimize", "numba")
"""What neither of the commands below has a use for."""


MOST_MODULES = 172
"""Modules of the library that an evaluation may load; 257 when all log formats were loaded."""


@pytest.fixture(scope="module")
def bytecode() -> dict[str, str]:
    """Environment in which the first run keeps the bytecode that is not at hand."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return kept | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def _run(code: str, environment: dict[str, str], *words: object) -> tuple[float, set[str]]:
    """CPU seconds of a child process, user and system together, and the modules that it loaded."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(
        [sys.executable, "-c", _LIST + code, *map(str, words)],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, set(run.stderr.rpartition("MODULES ")[2].split())


def _command(environment: dict[str, str], unused: Collection[str], *words: object) -> float:
    """CPU seconds of a command that loads nothing of what it does not use."""
    seconds, modules = _run(_START, environment, *words)
    assert "forcetorque.app.command_line" in modules
    assert not modules.intersection(unused)
    return seconds


def _within(ratio: float, environment: dict[str, str], *words: object) -> bool:
    """Whether in one of some runs, the first if neighbours let it, a command takes less than so often its libraries."""
    return any(_command(environment, UNUSED, *words) < ratio * _run(_LIBRARIES, environment)[0] for _ in range(RUNS))


def _example(number: str, data_dir: Path, folder: Path) -> Path:
    (path,) = (ROOT / "examples").glob(f"{number}_*.toml")
    copy = folder / path.name
    copy.write_text(path.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
    return copy


def test_a_help_is_there_at_once(bytecode: dict[str, str]) -> None:
    """Neither Pydantic nor anything that computes is loaded, and it takes less than 0.3 s."""
    unused = ("pydantic", "numpy", "scipy", "pyarrow")
    assert any(_command(bytecode, unused, "calibrate", "--help") < 0.3 for _ in range(RUNS))


@pytest.mark.long
@pytest.mark.real_data
def test_a_load_is_weighed_without_what_it_does_not_use(
    bytecode: dict[str, str], data_dir: Path, tmp_path: Path
) -> None:
    """`payload` on 24 rows takes less than 2.7 times what its libraries take."""
    assert _within(2.7, bytecode, "payload", _example("07", data_dir, tmp_path))


@pytest.mark.long
@pytest.mark.real_data
def test_a_log_is_judged_without_what_it_does_not_use(bytecode: dict[str, str], data_dir: Path, tmp_path: Path) -> None:
    """`evaluate` on the yoga log takes less than 3.2 times what its libraries take."""
    file, leg = _example("02", data_dir, tmp_path), tmp_path / "leg.json"
    write_calibration(leg, load_experiment(file)["r_leg_ft_sensor"].calibrate())
    assert _within(3.2, bytecode, "evaluate", file, "-c", leg)


@pytest.mark.long
def test_a_first_log_is_drafted_without_what_it_does_not_use(bytecode: dict[str, str], tmp_path: Path) -> None:
    """Neither pandas, nor the compiler, nor figures are loaded by `init`."""
    tutorial = ROOT / "docs" / "tutorial"
    unused = ("pandas", "numba", "matplotlib")
    _command(
        bytecode, unused, "init", tutorial / "log.csv", "--urdf", tutorial / "robot.urdf", "-o", tmp_path / "new.toml"
    )


def _format_modules(modules: set[str]) -> set[str]:
    """Modules of log formats, that of the registry apart."""
    return modules.intersection(reference.partition(":")[0] for reference in LOG_FORMATS.values()) - {registry.__name__}


@some_cases(("file", "formats"), [(YARP, {"forcetorque.formats.yarp.log_format"}), (PARQUET, set())])
def test_an_evaluation_loads_one_log_format(
    bytecode: dict[str, str], tmp_path: Path, file: str, formats: set[str]
) -> None:
    """That of the log, and of the whole library no more modules than `MOST_MODULES`."""
    write_experiments(tmp_path)
    arm = tmp_path / "arm.json"
    write_calibration(arm, load_experiment(tmp_path / file)["arm_ft"].calibrate())
    _, modules = _run(_START, bytecode, "evaluate", tmp_path / file, "-c", arm)
    assert _format_modules(modules) == formats
    assert sum(module.startswith("forcetorque.") for module in modules) <= MOST_MODULES


@pytest.mark.long
def test_a_schema_loads_all_log_formats(bytecode: dict[str, str]) -> None:
    """Negative control: what has the tables of all formats loads them."""
    _, modules = _run(_START, bytecode, "schema", "experiment")
    assert len(_format_modules(modules)) == len({*LOG_FORMATS.values()}) - 3  # three share a file, one is the project's


@pytest.mark.long
def test_a_module_and_its_time_are_noticed(bytecode: dict[str, str]) -> None:
    """Negative control: a child that loads scipy.signal lists it, and one that is busy for 0.3 s spends them."""
    busy = "import scipy.signal, time\nbusy = time.process_time()\nwhile time.process_time() < busy + 0.3: pass"
    seconds, modules = _run(busy, bytecode)
    assert "scipy.signal" in modules
    assert seconds > 0.3
