# SPDX-License-Identifier: BSD-3-Clause
"""Readers of files under damage: a stream or our error, in bounded time and memory; 145 000 cases in the long run."""

from __future__ import annotations

import random
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from forcetorque.base.errors import FormatError
from forcetorque.formats.registry import LOG_FORMATS
from forcetorque.formats.ros.log_format import RosFormat
from tests.cases import some_cases
from tests.formats.fuzzed import CASES, SLOWEST_S, Processes, array_case, damaged
from tests.formats.ros import test_log_format as ros
from tests.formats.ros.bags import write_bag
from tests.fuzzing import sampled

SLOW = (
    "packed sqlite3",
    "packed mcap",
    "index",
    "matlab 7.3",
    "hdf5 of other files",
    "lists in a stream of Arrow",
    "frames of an episode",
    "description of a dataset of v3.0",
)
"""Forms of files that take seconds, or are read as others are; those stand for them in the quick run."""


@pytest.fixture(scope="module")
def processes() -> Iterator[Processes]:
    """A process of its own, in which files are read."""
    processes = Processes()
    yield processes
    processes.close()


@pytest.mark.fuzz
@some_cases("name", sorted(CASES, key=SLOW.__contains__), quick=len(CASES) - len(SLOW))
def test_damaged_files_are_refused_or_read(
    tmp_path: Path, name: str, processes: Processes, request: pytest.FixtureRequest
) -> None:
    """Read as stated and described without a statement; nothing ends the process, and both outcomes were met."""
    rng = random.Random(f"{name} {request.config.getoption('hypothesis_seed')}")
    seeds = [rng.randrange(2**63) for _ in range(sampled(5000))]
    outcomes = processes.run(name, tmp_path, seeds)
    assert sum(outcomes.values()) == 2 * len(seeds)
    assert outcomes["refused"] > 0


def test_every_format_is_damaged() -> None:
    """A format that is added without a sound file here fails."""
    assert {name for name, _ in CASES.values()} == {*LOG_FORMATS}


def test_the_end_of_a_process_is_noticed(tmp_path: Path, processes: Processes) -> None:
    """Negative control: by name of the form and seed of the case; another process goes on."""
    with pytest.raises(AssertionError, match="npz: the process ended in case 3"):
        processes.run("npz", tmp_path, [3], abort=True)
    assert sum(processes.run("npz", tmp_path, [3]).values()) == 2


def test_damaged_statistics_of_a_row_group_end_no_process(tmp_path: Path, processes: Processes) -> None:
    """Arrow ends the process where it is asked for those of this case, which a random run found."""
    assert sum(processes.run("frames of a dataset", tmp_path, [676675875097658357]).values()) == 2


def test_an_undamaged_file_is_read(tmp_path: Path) -> None:
    """Negative control: what refuses everything would pass the test above."""
    case = array_case(tmp_path, "npz")
    original = case.file.read_bytes()
    seeds = [seed for seed in range(100) if damaged(original, seed) == original]
    assert seeds
    case.file.write_bytes(damaged(original, seeds[0]))
    case.read()


BOMBS = {
    "deep lists": "[" * 100_000,
    "deep tables": "".join(f"{' ' * k}a:\n" for k in range(2000)),
    "entities": "a: &a [x, x, x, x, x, x, x, x, x]\n"
    + "".join(f"{chr(98 + k)}: &{chr(98 + k)} [{', '.join(9 * [f'*{chr(97 + k)}'])}]\n" for k in range(20)),
    "large": "#" + "x" * (1 << 21),
}


@pytest.mark.parametrize("bomb", BOMBS)
def test_bombs_in_the_index_of_a_bag_are_refused(tmp_path: Path, bomb: str) -> None:
    """Nesting, entities that multiply and mere size: our error within seconds."""
    folder = write_bag(tmp_path, "mcap", {"/ft": ros._topics("mcap")["/ft"]})
    (folder / "metadata.yaml").write_text("rosbag2_bagfile_information:\n" + BOMBS[bomb], encoding="utf-8")
    start = time.perf_counter()
    with pytest.raises(FormatError):
        RosFormat().describe(folder)
    assert time.perf_counter() - start < SLOWEST_S
