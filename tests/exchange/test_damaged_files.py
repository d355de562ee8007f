# SPDX-License-Identifier: BSD-3-Clause
"""Readers of files under damage: a stream or our error, in bounded time and memory; 24 000 cases in the long run."""

from __future__ import annotations

import random
import resource
import time
import warnings
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from forcetorque.errors import ForceTorqueError, FormatError
from forcetorque.exchange.formats import recognised_format
from forcetorque.exchange.log_sketch import SketchingFormat
from forcetorque.exchange.ros import RosFormat
from forcetorque.exchange.tabular import ISO8601, StampColumn
from tests.exchange.array_file import test_hdf5_and_npz as arrays
from tests.exchange.robometry import test_log_format as robometry
from tests.exchange.robometry.logger import Leaf, write_log
from tests.exchange.ros import test_log_format as ros
from tests.exchange.ros.bags import Types, write_bag
from tests.exchange.tabular import test_large_and_columnar as tables
from tests.fuzzing import sampled

SENSE = {"sense": "sensor_to_world"}
SLOWEST_S = 20.0
"""Seconds of one case: some 0.6 s were the slowest of thousands, on a machine that seven others shared."""
LARGEST_GROWTH_MB = 600
"""How much the peak of the process may grow: files are of 60 kB, and what they claim is not believed."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """A sound file, and how it is read."""

    log: Path
    """What is read."""
    file: Path
    """What is damaged."""
    read: Callable[[], object]
    """Reads what is stated of it."""


def _array_case(folder: Path, name: str) -> Case:
    path = arrays._write(folder, name)
    return Case(log=path, file=path, read=lambda: arrays._read(path, name, arrays.STREAM))


def _robometry_case(folder: Path) -> Case:
    turned = {"orientations/waist": Leaf(values=robometry.POSITIONS, elements="rpy", units=["deg"])}
    path = write_log(folder / "log.mat", robometry.LEAVES | turned)
    turn = {"name": "turn", "channel": "orientations/waist", "frame": "waist", "orientation": SENSE}
    return Case(
        log=path, file=path, read=lambda: robometry._read(path, robometry.FT_ENTRY, robometry.JOINT_ENTRY, turn)
    )


def _table_case(folder: Path, name: str) -> Case:
    path = folder / name
    if name == "parquet":
        pq.write_table(pa.table(tables._columns(tables.ROWS)), path)
    else:
        path.write_text(tables._text("\t"), encoding="utf-8")
    layout = tables.LAYOUT if name == "parquet" else tables.TSV
    return Case(log=path, file=path, read=lambda: tables._stream(path, layout))


def _dates_case(folder: Path) -> Case:
    columns = tables._columns(tables.ROWS)
    columns["t"] = columns["t"].astype("datetime64[ms]")
    rows = zip(*(map(str, values) for values in columns.values()), strict=True)
    path = folder / "log.csv"
    path.write_text("\n".join(map(",".join, (columns, *rows))) + "\n", encoding="utf-8")
    layout = replace(tables.LAYOUT, stamp=StampColumn(column="t", unit=ISO8601))
    return Case(log=path, file=path, read=lambda: tables._stream(path, layout))


def _bag_case(folder: Path, form: str, *, index: bool = False) -> Case:
    types, kind = Types(form), "nav_msgs/msg/Odometry"
    odometry = [types.posed(kind, k, turn, (1, 2, 3), "map", "base") for k, turn in enumerate(ros.ROTATIONS)]
    path = write_bag(folder, form, ros._topics(form) | {"/odom": (kind, odometry)})
    names = (".yaml",) if index else (".db3", ".mcap")
    file = path if path.is_file() else next(entry for entry in path.iterdir() if entry.suffix in names)
    topics = {"wrist": "/ft", "joints": "/joint_states", "imu": "/imu", "warm": "/warm"}
    entries = [{"name": name, "topic": topic} for name, topic in topics.items()]
    tf = {"name": "sole", "topic": "/tf", "frame": "sole", "world": "base"}
    turn = {"name": "turn", "topic": "/imu", "orientation": SENSE}
    odom = {"name": "base", "topic": "/odom", "frame": "base", "world": "map"}
    return Case(log=path, file=file, read=lambda: ros._read(path, *entries, tf, turn, odom))


CASES: dict[str, tuple[Callable[[Path], Case], int]] = {
    "npz": (lambda folder: _array_case(folder, "npz"), 4000),
    "hdf5": (lambda folder: _array_case(folder, "hdf5"), 3000),
    "matlab 7.3": (lambda folder: _array_case(folder, "matlab"), 3000),
    "robometry": (_robometry_case, 1500),
    "tsv": (lambda folder: _table_case(folder, "log.tsv"), 3000),
    "dates": (_dates_case, 3000),
    "parquet": (lambda folder: _table_case(folder, "parquet"), 3000),
    "bag of ROS 1": (lambda folder: _bag_case(folder, "bag"), 1000),
    "sqlite3": (lambda folder: _bag_case(folder, "sqlite3"), 1000),
    "mcap": (lambda folder: _bag_case(folder, "mcap"), 1000),
    "index": (lambda folder: _bag_case(folder, "mcap", index=True), 500),
}
"""How each is made, and how many cases of it the long run has."""


def damaged(data: bytes, seed: int) -> bytes:
    """Flip bits, replace bytes, claim huge counts, cut out, repeat, truncate; sometimes nothing."""
    rng = random.Random(seed)
    content = bytearray(data)
    for _ in range(rng.randint(0, 4)):
        at = rng.randrange(len(content))
        match rng.randrange(6):
            case 0:
                content[at] ^= 1 << rng.randrange(8)
            case 1:
                content[at] = rng.randrange(256)
            case 2:
                content[at : at + 8] = b"\xff" * 8
            case 3:
                content[at : at + 4] = (2**31 - 1).to_bytes(4, "little")
            case 4:
                del content[at : at + rng.randrange(64)]
            case 5:
                content[at:at] = content[: rng.randrange(64)]
    return bytes(content[: rng.randrange(len(content))] if rng.random() < 0.2 else content)


def _describe(log: Path) -> None:
    known = recognised_format(log)
    if isinstance(known, SketchingFormat):
        known.sketch(log)
    elif known is not None:
        known.describe(log)


@pytest.mark.fuzz
@pytest.mark.parametrize("name", CASES)
def test_damaged_files_are_refused_or_read(tmp_path: Path, name: str) -> None:
    """Read as stated and described without a statement; both outcomes must have been met."""
    make, count = CASES[name]
    case = make(tmp_path)
    original = case.file.read_bytes()
    case.read()
    outcomes: Counter[str] = Counter()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    drawn = sampled(count)

    @settings(max_examples=drawn, deadline=None, database=None)
    @given(seed=st.integers(0, 2**63))
    def run(seed: int) -> None:
        case.file.write_bytes(damaged(original, seed))
        start = time.perf_counter()
        for read in (case.read, lambda: _describe(case.log)):
            try:
                read()
            except ForceTorqueError as error:
                assert "\n" not in str(error)  # noqa: PT017 - both outcomes are allowed
                outcomes["refused"] += 1
            else:
                outcomes["read"] += 1
        assert time.perf_counter() - start < SLOWEST_S

    # what a library finds odd in a damaged file is no error of ours
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run()
    assert sum(outcomes.values()) >= 2 * min(drawn, 5)
    assert outcomes["refused"] > 0
    grown_mb = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak) / 1024
    assert grown_mb < LARGEST_GROWTH_MB


def test_an_undamaged_file_is_read(tmp_path: Path) -> None:
    """Negative control: what refuses everything would pass the test above."""
    case = _array_case(tmp_path, "npz")
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
