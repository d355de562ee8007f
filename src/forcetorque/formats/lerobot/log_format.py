# SPDX-License-Identifier: BSD-3-Clause
"""Datasets of LeRobot as a format of logs: one episode is a recording whose columns an experiment file specifies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.arrow import arrow_numbers
from forcetorque.base.errors import FormatError, require_known
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.headings import read_heading
from forcetorque.formats.lerobot.dataset import (
    Episode,
    LeRobotDataset,
    dataset_of_file,
    frame_batches,
    is_dataset,
    read_dataset,
)
from forcetorque.formats.log_format import (
    LogContext,
    LogDescription,
    LogReading,
    LogSketch,
    LogTable,
    SketchedColumns,
    StreamReading,
)
from forcetorque.formats.tabular.log_format import Extent, SignalTable, declared_signal
from forcetorque.formats.tabular.table import read_rows
from forcetorque.formats.tabular.table_layout import EvenRows, Rows, TableLayout
from forcetorque.recording.recording import Finding

_CLOCK = "frames"
"""Name of the clock of frames."""
_SKETCHED_ROWS = 100_000
"""Frames of whose numbers a sketch gives the range."""


class LeRobotStream(Table):
    """Features of one episode."""

    name: Text
    """Name of the stream in the recording."""
    signal: Annotated[tuple[SignalTable, ...], Field(min_length=1)]
    """What is read; columns are elements of features, such as `observation.wrench.fx`."""


class LeRobotLog(LogTable):
    """One episode of a LeRobot dataset, v2.1 or v3.0."""

    format: Literal["lerobot"]
    """Format of the recording."""
    path: Path
    """Folder of the dataset, which has meta/info.json."""
    episode: Annotated[int, Field(ge=0, strict=True)]
    """Number of the episode, from 0."""
    stream: Annotated[tuple[LeRobotStream, ...], Field(min_length=1)]
    """What is read of it."""


class LeRobotFormat:
    """Datasets that name the elements of features, and specify neither unit, frame, sign nor true time."""

    table = LeRobotLog
    sign = "meta/info.json of a LeRobot dataset"

    def recognises(self, path: Path) -> bool:
        """Look for the description of the dataset, also of one of its files."""
        return is_dataset(path) or dataset_of_file(path) is not None

    def sketch(self, path: Path) -> LogSketch:
        """Look at names and numbers of all measured features."""
        dataset = read_dataset(dataset_of_file(path) or path)
        episodes = episodes_below(dataset, path)
        return _sketch(dataset, path, episodes)

    def describe(self, path: Path) -> LogDescription:
        """Refuse: the format has neither units nor frames."""
        dataset = read_dataset(dataset_of_file(path) or path)
        raise FormatError(
            f"{path}: expected a log that specifies what it holds, got a LeRobot dataset {dataset.version} without "
            f"units, frames and signs; specify them in an experiment file; `forcetorque init {path}` begins one"
        )

    def read(self, specified: LeRobotLog, context: LogContext) -> LogReading:
        """Read one episode."""
        dataset = read_dataset(context.folder(specified.path))
        context.file(specified.path / "meta" / "info.json")
        episode = dataset.episode(specified.episode)
        context.file(specified.path / episode.file.relative_to(dataset.root))
        readings = []
        for k, entry in enumerate(specified.stream):
            with context.stated_in(f"stream[{k}]"):
                readings.append(_read_stream(dataset, episode, entry))
        origin = {"format": "lerobot", "version": dataset.version, "episode": str(episode.index)}
        return LogReading.of(readings, origin=origin)


def episodes_below(dataset: LeRobotDataset, path: Path) -> tuple[Episode, ...]:
    """Give the episodes of a dataset, or of one of its files.

    Args:
        dataset: The dataset.
        path: Its folder, or a file of frames.

    Returns:
        The episodes, at least one.

    Raises:
        FormatError: If the file is of no episode.
    """
    if path.is_dir():
        return dataset.episodes
    episodes = tuple(one for one in dataset.episodes if one.file.absolute() == path.absolute())
    if not episodes:
        raise FormatError(f"{path}: expected a file of the dataset {dataset.root}, whose episodes do not name it")
    return episodes


def _sketch(dataset: LeRobotDataset, path: Path, episodes: Sequence[Episode]) -> LogSketch:
    labels = tuple(dataset.labels)
    extents = {label: Extent() for label in labels}
    rows, stopped, wanted = 0, None, pa.array([episode.index for episode in episodes], pa.int64())
    for file in dict.fromkeys(episode.file for episode in episodes):
        for numbers, batch in frame_batches(dataset, file, labels):
            chosen = batch.filter(pc.is_in(numbers, wanted))
            for k, extent in enumerate(extents.values(), start=1):
                extent.add(chosen.column(k))
            rows += len(chosen)
        if rows >= _SKETCHED_ROWS:
            stopped = f"{dataset.root}: the dataset has {sum(episode.frames for episode in episodes)} frames"
            break
    total = sum(episode.frames for episode in episodes)
    return LogSketch(
        path=path,
        columns=tuple(_column(label, extent, total) for label, extent in extents.items()),
        ranged_rows=rows if rows < total and stopped else None,
        stopped=stopped if rows < total else None,
        rate_hz=dataset.fps,
        episodes=tuple(episode.index for episode in episodes),
    )


def _column(label: str, extent: Extent, rows: int) -> SketchedColumns:
    unit = read_heading(label).unit
    if not extent.count:
        return SketchedColumns(name=label, rows=rows, unit=unit)
    mean = extent.total / extent.count
    return SketchedColumns(
        name=label, rows=rows, unit=unit, smallest=extent.smallest, largest=extent.largest, mean=mean
    )


def _read_stream(dataset: LeRobotDataset, episode: Episode, entry: LeRobotStream) -> StreamReading:
    layout = TableLayout(
        stamp=EvenRows(rate_hz=dataset.fps, start_s=0.0),
        signals=tuple(declared_signal(signal) for signal in entry.signal),
    )
    labels = tuple(dict.fromkeys(column for signal in layout.signals for column in signal.columns))
    for label in labels:
        require_known(label, dataset.labels, FormatError, f"{dataset.root}: no column {label!r}")
    rows = Rows(
        name=f"{episode.file}: episode {episode.index}",
        count=episode.frames,
        batches=_episode_batches(dataset, episode, labels),
        place=lambda row: f"{episode.file}: episode {episode.index}: frame {row}",
    )
    (stream,) = (reading := read_rows(rows, layout, stream=entry.name, clock=_CLOCK)).streams
    text = (
        f"times are made up: frame_index / {dataset.fps:g} Hz, as the format defines them; jitter, lost frames and "
        "delays of signals are not in the dataset"
    )
    made_up = Finding(
        stream=entry.name, kind="stated_rate", message=text, count=len(stream), size=dataset.fps, unit="Hz"
    )
    return StreamReading(stream, (made_up, *reading.findings))


def _episode_batches(dataset: LeRobotDataset, episode: Episode, labels: tuple[str, ...]) -> Iterator[Any]:
    frame = 0
    for numbers, batch in frame_batches(dataset, episode.file, labels, episode=episode.index):
        chosen = batch.filter(pc.equal(numbers, episode.index))
        frames = frame_numbers(chosen.column(0))
        wrong = np.flatnonzero(frames != np.arange(frame, frame + len(frames)))
        if len(wrong):
            raise FormatError(
                f"{episode.file}: episode {episode.index}: frame_index: expected {frame + int(wrong[0])}, got "
                f"{frames[wrong[0]]:g}: frames are missing or in another order, so frame_index / fps is not even"
            )
        frame += len(frames)
        arrays = [chosen.column(k) for k in range(1, 1 + len(labels))]
        yield pa.RecordBatch.from_arrays(arrays, names=list(labels))


def frame_numbers(column: Any) -> FloatArray:
    """Give the numbers of a column, whatever their type.

    Args:
        column: Column of Arrow with numbers.

    Returns:
        The numbers, NaN where there is none; shape (n,).

    Raises:
        FormatError: If the column holds something else.
    """
    if not (pa.types.is_integer(column.type) or pa.types.is_floating(column.type)):
        raise FormatError(f"expected a column of numbers, got {column.type}")
    return arrow_numbers(column.cast(pa.float64(), safe=False))
