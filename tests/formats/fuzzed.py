# SPDX-License-Identifier: BSD-3-Clause
"""Sound files of every form that is read, how each is damaged, and a process in which that is done.

Libraries in C may end the whole process over a damaged file, which no test in the same process could report.
"""

from __future__ import annotations

import os
import random
import re
import resource
import signal
import warnings
import zlib
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from scipy.io import savemat

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.formats.log_format import SketchingFormat
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.tabular.numbers import ISO8601
from forcetorque.formats.tabular.table_layout import StampColumn
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from tests.formats.array_file import test_hdf5_and_npz as arrays
from tests.formats.c3d import test_log_format as c3d
from tests.formats.c3d.plate_files import write_plate
from tests.formats.franka import test_log_format as franka
from tests.formats.franka.states import states, write_states, write_table
from tests.formats.lerobot import test_log_format as lerobot
from tests.formats.lerobot.datasets import write_dataset
from tests.formats.robometry import test_log_format as robometry
from tests.formats.robometry.logger import Leaf, write_log
from tests.formats.ros import test_log_format as ros
from tests.formats.ros.bags import Types, write_bag
from tests.formats.tabular import test_large_and_columnar as tables
from tests.formats.ur_rtde import test_log_format as ur_rtde
from tests.formats.ur_rtde.recordings import recorded, write_binary, write_text
from tests.formats.yarp.port_logs import write_port

SENSE = {"sense": "sensor_to_world"}
SLOWEST_S = 20
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


def array_case(folder: Path, name: str) -> Case:
    """Arrays as NumPy, HDF5 and MATLAB 7.3 have them."""
    path = arrays._write(folder, name)
    return Case(log=path, file=path, read=lambda: arrays._read(path, name, arrays.STREAM))


def _matlab_case(folder: Path, *, packed: bool) -> Case:
    path = folder / "log.mat"
    fields = {"t": arrays.TIMES[:, None], "note": "a text", "c": np.array([np.eye(2), "a"], dtype=object)}
    records = np.zeros((1, 2), dtype=[("a", "O"), ("b", "O")])
    content = {
        "q": arrays.JOINTS,
        "ft": arrays.WRENCHES,
        "s": fields,
        "records": records,
        "k": np.arange(9, dtype="u1"),
    }
    savemat(path, content, do_compression=packed)
    stream = arrays.STREAM | {"time": {"variable": "s.t", "unit": "s"}}
    return Case(log=path, file=path, read=lambda: arrays._read(path, "matlab", stream))


def _hdf5_elsewhere_case(folder: Path) -> Case:
    """With virtual datasets of itself and of another file, external storage, links, and packed numbers."""
    path = arrays._write(folder, "hdf5")
    with h5py.File(folder / "other.h5", "w") as other:
        other["v"] = arrays.WRENCHES
    with h5py.File(path, "r+") as file:
        for name, source in {"itself": ".", "another": str(folder / "other.h5")}.items():
            layout = h5py.VirtualLayout(arrays.WRENCHES.shape, "f8")
            layout[:] = h5py.VirtualSource(source, "v" if name == "another" else name, arrays.WRENCHES.shape)
            file.create_virtual_dataset(name, layout)
        file.create_dataset("outside", (4, 6), "f8", external=[(str(folder / "other.h5"), 0, 192)])
        file["link"] = h5py.ExternalLink(str(folder / "other.h5"), "/v")
        file["soft"] = h5py.SoftLink("/q")
        del file["q"]
        file.create_dataset("q", data=arrays.JOINTS, chunks=(10, 2), compression="gzip", shuffle=True, fletcher32=True)
    return Case(log=path, file=path, read=lambda: arrays._read(path, "hdf5", arrays.STREAM))


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


def _lists_case(folder: Path, form: str) -> Case:
    """Lists of fixed and of variable length in a table of Parquet, or in a file or stream of Arrow."""
    columns = tables._columns(tables.ROWS)
    flat = pa.array(np.column_stack([columns[name] for name in WRENCH_COMPONENTS]).reshape(-1))
    lists = pa.FixedSizeListArray.from_arrays(flat, 6)
    table = pa.table({"t": columns["t"], "w": lists, "v": lists.cast(pa.list_(flat.type))})
    path = folder / f"log.{form}"
    if form == "parquet":
        pq.write_table(table, path)
    else:
        make = pa.ipc.new_file if form == "feather" else pa.ipc.new_stream
        packed = pa.ipc.IpcWriteOptions(compression="lz4") if form == "feather" else None
        with make(str(path), table.schema, options=packed) as writer:
            writer.write_table(table, max_chunksize=tables.ROWS // 2)
    signals = [replace(tables.WRENCH, columns=tuple(f"{name}[{k}]" for k in range(6))) for name in "wv"]
    layouts = [replace(tables.LAYOUT, signals=(signal,)) for signal in signals]
    return Case(log=path, file=path, read=lambda: [tables._stream(path, layout) for layout in layouts])


def _dates_case(folder: Path) -> Case:
    columns = tables._columns(tables.ROWS)
    columns["t"] = columns["t"].astype("datetime64[ms]")
    rows = zip(*(map(str, values) for values in columns.values()), strict=True)
    path = folder / "log.csv"
    path.write_text("\n".join(map(",".join, (columns, *rows))) + "\n", encoding="utf-8")
    layout = replace(tables.LAYOUT, stamp=StampColumn(column="t", unit=ISO8601))
    return Case(log=path, file=path, read=lambda: tables._stream(path, layout))


def _recording_case(folder: Path) -> Case:
    raw = Signal(quantity="raw", values=arrays.WRENCHES, columns=tuple("abcdef"), units=("counts",) * 6)
    stream = Stream(name="ft", clock="own", stamp_ns=np.arange(len(arrays.WRENCHES)), signals={"raw": raw})
    write_recording(folder / "log", Recording(streams={"ft": stream}))
    return Case(log=folder / "log", file=folder / "log" / "ft.parquet", read=lambda: read_recording(folder / "log"))


def _port_case(folder: Path) -> Case:
    text = "".join(f"{k} {10 + k / 8} 1 2 3 4 5 {k}\n" for k in range(40))
    port = write_port(folder / "log" / "ft", text, packed=True)
    read = lambda: read_analog(port, stream="ft", frame="sensor")  # noqa: E731
    return Case(log=folder / "log", file=port / "data.log.gz", read=read)


def _bag_case(folder: Path, form: str, *, index: bool = False, packed: str = "") -> Case:
    types, kind = Types(form), "nav_msgs/msg/Odometry"
    odometry = [types.posed(kind, k, turn, (1, 2, 3), "map", "base") for k, turn in enumerate(ros.ROTATIONS)]
    path = write_bag(folder, form, ros._topics(form) | {"/odom": (kind, odometry)}, packed)
    names = (".yaml",) if index else (".db3", ".mcap")
    file = path if path.is_file() else next(entry for entry in path.iterdir() if entry.suffix in names)
    topics = {"wrist": "/ft", "joints": "/joint_states", "imu": "/imu", "warm": "/warm"}
    entries = [{"name": name, "topic": topic} for name, topic in topics.items()]
    tf = {"name": "sole", "topic": "/tf", "frame": "sole", "world": "base"}
    turn = {"name": "turn", "topic": "/imu", "orientation": SENSE}
    odom = {"name": "base", "topic": "/odom", "frame": "base", "world": "map"}
    return Case(log=path, file=file, read=lambda: ros._read(path, *entries, tf, turn, odom))


def _dataset_case(folder: Path, version: str, damaged: str) -> Case:
    root = write_dataset(folder / "dataset", lerobot.EPISODES, version=version)
    return Case(log=root, file=root / damaged, read=lambda: lerobot.read(root))


def _rtde_case(folder: Path, *, binary: bool) -> Case:
    columns = recorded(ur_rtde.TOOL, samples=3)
    path = write_binary(folder / "log", columns) if binary else write_text(folder / "log", columns)
    return Case(log=path, file=path, read=lambda: ur_rtde._read(path, moment_about="flange"))


def _franka_case(folder: Path, *, table: bool) -> Case:
    write = write_table if table else write_states
    path = write(folder / "log", states(samples=2))
    return Case(log=path, file=path, read=lambda: franka._read(path))


def _c3d_case(folder: Path, kind: int) -> Case:
    path = write_plate(folder / "log", kind)
    return Case(log=path, file=path, read=lambda: c3d.read(path))


CASES: dict[str, tuple[str, Callable[[Path], Case]]] = {
    "npz": ("npz", lambda folder: array_case(folder, "npz")),
    "hdf5": ("hdf5", lambda folder: array_case(folder, "hdf5")),
    "hdf5 of other files": ("hdf5", _hdf5_elsewhere_case),
    "matlab 5": ("matlab", lambda folder: _matlab_case(folder, packed=False)),
    "matlab 7": ("matlab", lambda folder: _matlab_case(folder, packed=True)),
    "matlab 7.3": ("matlab", lambda folder: array_case(folder, "matlab")),
    "robometry": ("robometry", _robometry_case),
    "tsv": ("tabular", lambda folder: _table_case(folder, "log.tsv")),
    "dates": ("tabular", _dates_case),
    "parquet table": ("tabular", lambda folder: _table_case(folder, "parquet")),
    "lists in a table": ("tabular", lambda folder: _lists_case(folder, "parquet")),
    "lists in a file of Arrow": ("tabular", lambda folder: _lists_case(folder, "feather")),
    "lists in a stream of Arrow": ("tabular", lambda folder: _lists_case(folder, "arrows")),
    "recording": ("parquet", _recording_case),
    "packed port": ("yarp", _port_case),
    "bag of ROS 1": ("ros", lambda folder: _bag_case(folder, "bag")),
    "packed bag of ROS 1": ("ros", lambda folder: _bag_case(folder, "bag", packed="BZ2")),
    "sqlite3": ("ros", lambda folder: _bag_case(folder, "sqlite3")),
    "packed sqlite3": ("ros", lambda folder: _bag_case(folder, "sqlite3", packed="MESSAGE")),
    "mcap": ("ros", lambda folder: _bag_case(folder, "mcap")),
    "packed mcap": ("ros", lambda folder: _bag_case(folder, "mcap", packed="STORAGE")),
    "rtde": ("ur_rtde", lambda folder: _rtde_case(folder, binary=False)),
    "binary rtde": ("ur_rtde", lambda folder: _rtde_case(folder, binary=True)),
    "states": ("franka", lambda folder: _franka_case(folder, table=False)),
    "table of states": ("franka", lambda folder: _franka_case(folder, table=True)),
    "forces and moments": ("c3d", lambda folder: _c3d_case(folder, 2)),
    "volts and a matrix": ("c3d", lambda folder: _c3d_case(folder, 4)),
    "index": ("ros", lambda folder: _bag_case(folder, "mcap", index=True)),
    "frames of a dataset": (
        "lerobot",
        lambda folder: _dataset_case(folder, "v3.0", "data/chunk-000/file-000.parquet"),
    ),
    "episodes of a dataset": (
        "lerobot",
        lambda folder: _dataset_case(folder, "v3.0", "meta/episodes/chunk-000/file-000.parquet"),
    ),
    "frames of an episode": (
        "lerobot",
        lambda folder: _dataset_case(folder, "v2.1", "data/chunk-000/episode_000001.parquet"),
    ),
    "description of a dataset of v3.0": ("lerobot", lambda folder: _dataset_case(folder, "v3.0", "meta/info.json")),
    "list of episodes": ("lerobot", lambda folder: _dataset_case(folder, "v2.1", "meta/episodes.jsonl")),
    "description of a dataset": ("lerobot", lambda folder: _dataset_case(folder, "v2.1", "meta/info.json")),
}
"""Name of the format that reads each, and how it is made."""


def damaged(data: bytes, seed: int) -> bytes:
    """Flip bits, replace bytes, claim huge counts, cut out, repeat, truncate, also in what zlib packs; or nothing."""
    rng = random.Random(seed)
    content = bytearray(data)
    for _ in range(rng.randint(0, 4)):
        at = rng.randrange(len(content))
        match rng.randrange(9):
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
            case 6:  # tags, counts and offsets are such words
                at -= at % 8
                content[at : at + 4] = rng.choice((0, 1, 2, 3, 14, 15, rng.randrange(1 << 16))).to_bytes(4, "little")
            case 7:
                content[at : at + 8] = rng.randrange(1 << rng.choice((16, 32, 63))).to_bytes(8, "little")
            case 8:
                _damage_packed(content, rng)
        if not content:
            return b""
    return bytes(content[: rng.randrange(len(content))] if rng.random() < 0.2 else content)


def _damage_packed(content: bytearray, rng: random.Random) -> None:
    """Change words of what one zlib stream unpacks to, and pack it again, its length in front if it is an element."""
    places = [match.start() for match in re.finditer(rb"\x78[\x01\x5e\x9c\xda]", bytes(content))]
    rng.shuffle(places)
    for place in places:
        unpacker = zlib.decompressobj()
        try:
            plain = bytearray(unpacker.decompress(bytes(content[place:]), 1 << 20))
        except zlib.error:
            continue
        if not unpacker.eof or len(plain) < 8:
            continue
        size = len(content) - place - len(unpacker.unused_data)
        for _ in range(rng.randint(1, 3)):
            at = rng.randrange(len(plain) // 4) * 4
            plain[at : at + 4] = rng.choice((0, 1, 2, 5, 9, 14, 17, rng.randrange(1 << 31))).to_bytes(4, "little")
        packed = zlib.compress(bytes(plain))
        if content[place - 4 : place] == size.to_bytes(4, "little"):
            content[place - 4 : place] = len(packed).to_bytes(4, "little")
        content[place : place + size] = packed
        return


def describe(log: Path) -> None:
    """Read a log as `inspect` and `init` do."""
    known = recognised_format(log)
    if isinstance(known, SketchingFormat):
        known.sketch(log)
    elif known is not None:
        known.describe(log)


class _TooSlowError(Exception):
    """A case took longer than it may."""


def _stop(number: int, frame: Any) -> None:
    raise _TooSlowError(f"a case took over {SLOWEST_S} s")


def run_cases(name: str, folder: Path, seeds: Sequence[int], *, abort: bool = False) -> Counter[str]:
    """Read damaged files, in a process of its own.

    Args:
        name: One of `CASES`.
        folder: Empty folder; `seed` in it holds the seed of the case at hand.
        seeds: How to damage each.
        abort: Whether to end the process in the first case, as a library would.

    Returns:
        How often files were read and refused.
    """
    case = CASES[name][1](folder)
    original = case.file.read_bytes()
    case.read()
    outcomes: Counter[str] = Counter()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    signal.signal(signal.SIGALRM, _stop)
    # what a library finds odd in a damaged file is no error of ours
    warnings.simplefilter("ignore")
    for seed in seeds:
        (folder / "seed").write_text(str(seed), encoding="utf-8")
        if abort:
            os.abort()
        case.file.write_bytes(damaged(original, seed))
        signal.alarm(SLOWEST_S)
        for read in (case.read, lambda: describe(case.log)):
            try:
                read()
            except ForceTorqueError as error:
                if "\n" in str(error):
                    raise AssertionError(f"more than one line: {error}") from error
                outcomes["refused"] += 1
            else:
                outcomes["read"] += 1
        signal.alarm(0)
    grown_mb = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak) / 1024
    if grown_mb > LARGEST_GROWTH_MB:
        raise AssertionError(f"the process grew by {grown_mb:.0f} MB")
    return outcomes


class Processes:
    """A process that reads damaged files, and another one after each that did not survive it."""

    def __init__(self) -> None:
        self._pool: ProcessPoolExecutor | None = None

    def run(self, name: str, folder: Path, seeds: Sequence[int], *, abort: bool = False) -> Counter[str]:
        """Read damaged files as `run_cases` does; what it raises, and the end of the process, names the case."""
        if self._pool is None:
            self._pool = ProcessPoolExecutor(max_workers=1, mp_context=get_context("spawn"))
        try:
            return self._pool.submit(run_cases, name, folder, seeds, abort=abort).result()
        except BrokenProcessPool as error:
            self._pool = None
            raise AssertionError(f"{name}: the process ended in case {_seed(folder)}") from error
        except Exception as error:
            raise AssertionError(f"{name}: case {_seed(folder)}: {type(error).__name__}: {error}") from error

    def close(self) -> None:
        """End the process."""
        if self._pool is not None:
            self._pool.shutdown()


def _seed(folder: Path) -> str:
    file = folder / "seed"
    return file.read_text(encoding="utf-8") if file.is_file() else "none: the sound file"


__all__ = ["CASES", "Processes", "array_case", "damaged"]
