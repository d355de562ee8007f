# SPDX-License-Identifier: BSD-3-Clause
"""Layout of a dataset of LeRobot, v2.1 and v3.0: features, episodes, and the files that hold their frames [1].

Units, frames, signs and true times are no part of the format: `timestamp` is `frame_index / fps`.

References:
    [1] huggingface/lerobot 7427f31, src/lerobot/datasets/utils.py and scripts/convert_dataset_v21_to_v30.py.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from pathlib import Path
from typing import Any

from forcetorque.base.errors import FormatError, known_names, quoted, require_known
from forcetorque.base.input_file import read_text, require_file
from forcetorque.formats.tabular.list_columns import element_name
from forcetorque.formats.tabular.row_readers import columnar_file

INFO = "meta/info.json"
"""What makes a folder a dataset."""
V21, V30 = "v2.1", "v3.0"
"""Versions of the layout that are read: a file for each episode, and files of many episodes."""
EPISODES = {V21: "meta/episodes.jsonl", V30: "meta/episodes"}
"""File or folder of the list of episodes."""
COUNTERS = ("timestamp", "frame_index", "episode_index", "index", "task_index")
"""Features that every dataset has, none of which was measured."""
_NUMBERS = {"float16", "float32", "float64", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64"}
_PLACE = re.compile(r"\{(\w+)(?::0?(\d+)d?)?\}")
_MOST_INFO = 1 << 26
_MOST_ELEMENTS = 1000
_LONGEST_EPISODE = 1 << 26


@dataclass(frozen=True, slots=True, kw_only=True)
class Feature:
    """A quantity of every frame of a dataset."""

    name: str
    """Its key, such as `observation.wrench`."""
    dtype: str
    """Type of its elements, such as `float32`, `video`, `image`, `string`."""
    shape: tuple[int, ...]
    """Its shape; (1,) of a plain column."""
    names: tuple[str, ...]
    """Names of its elements; empty where the dataset has none, or not one for each."""

    @property
    def elements(self) -> int:
        """Numbers of a frame; 0 where it is none of one axis, such as a video."""
        is_vector = self.dtype in _NUMBERS and len(self.shape) == 1 and 0 < self.shape[0] <= _MOST_ELEMENTS
        return self.shape[0] if is_vector else 0

    @property
    def labels(self) -> tuple[str, ...]:
        """Name of each element in the dataset, such as `observation.wrench.fx`, or `observation.wrench[0]`."""
        if self.elements == 1:
            return (self.name,)
        if self.names:
            return tuple(f"{self.name}.{name}" for name in self.names)
        return tuple(element_name(self.name, k) for k in range(self.elements))


@dataclass(frozen=True, slots=True, kw_only=True)
class Episode:
    """One recording of a dataset."""

    index: int
    """Its number."""
    frames: int
    """Number of its frames."""
    file: Path
    """File that holds them, alone or beside other episodes; it may be absent."""


@dataclass(frozen=True, kw_only=True)
class LeRobotDataset:
    """A dataset, of which the descriptions are read and no frame."""

    root: Path
    """Its folder."""
    version: str
    """Version of its layout."""
    fps: float
    """Frames per second, as the dataset has it."""
    features: Mapping[str, Feature]
    """Features by their names."""
    info: Mapping[str, Any]
    """Content of `meta/info.json`."""

    @property
    def numeric_features(self) -> tuple[Feature, ...]:
        """Features with numbers that may have been measured."""
        return tuple(one for name, one in self.features.items() if one.elements and name not in COUNTERS)

    @property
    def labels(self) -> Mapping[str, tuple[Feature, int]]:
        """Feature and place of every element, by its label."""
        return {label: (one, k) for one in self.numeric_features for k, label in enumerate(one.labels)}

    @cached_property
    def episodes(self) -> tuple[Episode, ...]:
        """Episodes, in the order of their numbers.

        Raises:
            FormatError: If the list of episodes is damaged, or does not number them from 0 on.
        """
        rows = _episodes_21(self) if self.version == V21 else _episodes_30(self)
        episodes = sorted(rows, key=lambda episode: episode.index)
        numbers = [episode.index for episode in episodes]
        if not episodes or numbers != list(range(len(numbers))):
            raise FormatError(
                f"{self.root / EPISODES[self.version]}: expected every episode from 0 on once, got "
                f"{quoted(', '.join(map(str, numbers)))}; copy the dataset again"
            )
        return tuple(episodes)

    def episode(self, number: int) -> Episode:
        """Find an episode.

        Args:
            number: Its number.

        Returns:
            The episode.

        Raises:
            FormatError: If there is none of that number.
        """
        if not 0 <= number < len(self.episodes):
            raise FormatError(
                f"{self.root}: episode: expected a number from 0 to {len(self.episodes) - 1}, got {number}"
            )
        return self.episodes[number]

    def files(self) -> Iterator[tuple[Path, tuple[Episode, ...]]]:
        """Go through the files of frames.

        Yields:
            Each file once, with its episodes in the order of their numbers.
        """
        files: dict[Path, list[Episode]] = {}
        for episode in self.episodes:
            files.setdefault(episode.file, []).append(episode)
        yield from ((file, tuple(episodes)) for file, episodes in files.items())

    def feature(self, name: str) -> Feature:
        """Find a feature that has numbers.

        Args:
            name: Its name.

        Returns:
            The feature.

        Raises:
            FormatError: If there is none of that name.
        """
        known = {one.name: one for one in self.numeric_features}
        require_known(name, known, FormatError, f"{self.root / INFO}: no feature with numbers is called {name!r}")
        return known[name]


def is_dataset(path: Path) -> bool:
    """Check whether a folder is a dataset.

    Args:
        path: File or folder.

    Returns:
        Whether it has a `meta/info.json` with `codebase_version` and `features`.
    """
    file = path / INFO
    try:
        if not path.is_dir() or not file.is_file() or file.stat().st_size > _MOST_INFO:
            return False
        text = file.read_bytes()
    except OSError:
        return False
    return b'"codebase_version"' in text and b'"features"' in text


def dataset_of_file(path: Path) -> Path | None:
    """Find the dataset that a file of frames belongs to.

    Args:
        path: File or folder.

    Returns:
        Its folder; None for what is no Parquet file below `data` of a dataset.
    """
    if path.suffix != ".parquet" or not path.is_file():
        return None
    parents = path.absolute().parents
    return next((root for root in parents[2:4] if is_dataset(root) and root / "data" in parents), None)


def read_dataset(root: Path) -> LeRobotDataset:
    """Read the description of a dataset.

    Args:
        root: Its folder.

    Returns:
        The dataset.

    Raises:
        FormatError: If the description is damaged, or of another version.
    """
    file = root / INFO
    require_file(file, "a description of a LeRobot dataset")
    if file.stat().st_size > _MOST_INFO:
        raise FormatError(f"{file}: expected at most {_MOST_INFO >> 20} MiB, got {file.stat().st_size >> 20} MiB")
    info = _json(read_text(file, "a description of a LeRobot dataset"), str(file))
    version = info.get("codebase_version")
    if version not in EPISODES:
        raise FormatError(
            f"{file}: codebase_version: expected {' or '.join(EPISODES)}, got {quoted(str(version))}; convert a copy "
            "with the scripts of lerobot"
        )
    fps = info.get("fps")
    if isinstance(fps, bool) or not isinstance(fps, int | float) or not (isfinite(fps) and 0.0 < fps <= 1e6):
        raise FormatError(f"{file}: fps: expected frames per second above 0, got {quoted(str(fps))}")
    features = info.get("features")
    if not isinstance(features, dict) or not features:
        raise FormatError(f"{file}: features: expected a table of features, got {quoted(str(features))}")
    return LeRobotDataset(
        root=root,
        version=str(version),
        fps=float(fps),
        features={name: _feature(name, content, file) for name, content in features.items()},
        info=info,
    )


def frame_batches(
    dataset: LeRobotDataset, file: Path, labels: tuple[str, ...], *, episode: int | None = None
) -> Iterator[tuple[Any, Any]]:
    """Give frames of a file, some at a time.

    Args:
        dataset: The dataset.
        file: One of its files.
        labels: Elements that are read.
        episode: Number of an episode that is looked for; frames of others may be left out.

    Yields:
        Column of episode numbers, and batch of Arrow with frame numbers and a column for each element.

    Raises:
        FormatError: If the file is damaged, or lacks a feature.
    """
    require_file(file, f"the frames of episodes of {dataset.root}")
    names, batches = columnar_file(file)
    known, there = dataset.labels, set(names)
    sources = []
    for label in labels:
        feature, k = known[label]
        choices = [element_name(feature.name, k), *([feature.name] if feature.elements == 1 else ())]
        source = next((one for one in choices if one in there), None)
        if source is None or element_name(feature.name, feature.elements) in there:
            raise FormatError(
                f"{file}: expected {feature.elements} number(s) of {feature.name!r} in each frame, as {INFO} has it, "
                f"got {known_names(feature.name, there)}"
            )
        sources.append(source)
    required = _required(file, there)
    holding = None if episode is None else (required[0], episode)
    for batch in batches([*required, *sources], holding=holding):
        yield batch.column(0), batch.select(range(1, 2 + len(sources)))


def _required(file: Path, there: set[str]) -> tuple[str, str]:
    for name in ("episode_index", "frame_index"):
        if name not in there:
            raise FormatError(f"{file}: expected a column {name}, got {known_names(name, there)}")
    return "episode_index", "frame_index"


def _json(text: str, where: str) -> dict[str, Any]:
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FormatError(f"{where}: expected JSON, got {error}") from error
    if not isinstance(content, dict):
        raise FormatError(f"{where}: expected a JSON object, got {quoted(text)}")
    return content


def _feature(name: str, content: Any, file: Path) -> Feature:
    where = f"{file}: features: {quoted(name)}"
    if not isinstance(content, dict) or not isinstance(content.get("dtype"), str):
        raise FormatError(f"{where}: expected dtype and shape, got {quoted(str(content))}")
    shape = content.get("shape")
    if not isinstance(shape, list) or not all(type(size) is int and 0 <= size < 1 << 32 for size in shape):
        raise FormatError(f"{where}: shape: expected a list of sizes, got {quoted(str(shape))}")
    named = tuple(_names(content.get("names")))
    fits = len(shape) == 1 and len(named) == shape[0] == len(set(named))
    return Feature(name=name, dtype=content["dtype"], shape=tuple(shape), names=named if fits else ())


def _names(content: Any) -> Iterator[str]:
    """Names of elements in the forms that datasets have: lists, nested ones, tables of lists or of places."""
    pending = [content]
    for _ in range(2 * _MOST_ELEMENTS):
        if not pending:
            return
        one = pending.pop(0)
        if isinstance(one, str):
            yield one
        elif isinstance(one, list):
            pending[:0] = one
        elif isinstance(one, dict) and one and all(type(place) is int for place in one.values()):
            pending[:0] = sorted(one, key=lambda key: one[key])
        elif isinstance(one, dict):
            pending[:0] = one.values()


def data_file(dataset: LeRobotDataset, places: Mapping[str, int]) -> Path:
    """Give the path of a file of frames.

    Args:
        dataset: The dataset.
        places: Values of the names in `data_path` of its description.

    Returns:
        The path, below the folder of the dataset.

    Raises:
        FormatError: If `data_path` has other names, or leads elsewhere.
    """
    template = dataset.info.get("data_path")
    where = f"{dataset.root / INFO}: data_path"
    if not isinstance(template, str) or not template.endswith(".parquet"):
        raise FormatError(f"{where}: expected a path of Parquet files, got {quoted(str(template))}")

    def filled(match: re.Match[str]) -> str:
        if match[1] not in places:
            raise FormatError(f"{where}: {known_names(match[1], places)}; got {quoted(match[1])}")
        return str(places[match[1]]).zfill(min(int(match[2] or 0), 20))

    text = _PLACE.sub(filled, template)
    if Path(text).is_absolute() or ".." in Path(text).parts or not text.isprintable() or "{" in text:
        raise FormatError(f"{where}: expected a path below the folder of the dataset, got {quoted(template)}")
    return dataset.root / text


def _episodes_21(dataset: LeRobotDataset) -> Iterator[Episode]:
    file = dataset.root / EPISODES[V21]
    chunk = dataset.info.get("chunks_size")
    if type(chunk) is not int or chunk < 1:
        raise FormatError(
            f"{dataset.root / INFO}: chunks_size: expected a number of episodes, got {quoted(str(chunk))}"
        )
    for number, line in enumerate(read_text(file, "the episodes of a LeRobot dataset").splitlines(), start=1):
        if not line.strip():
            continue
        content = _json(line, f"{file}:{number}")
        index = _whole(content.get("episode_index"), f"{file}:{number}: episode_index")
        yield Episode(
            index=index,
            frames=_whole(content.get("length"), f"{file}:{number}: length"),
            file=data_file(dataset, {"episode_chunk": index // chunk, "episode_index": index}),
        )


def episode_files(dataset: LeRobotDataset) -> list[Path]:
    """List the Parquet files of a dataset v3.0 that have its episodes.

    Args:
        dataset: The dataset.

    Returns:
        The files, at least one.

    Raises:
        FormatError: If there is none.
    """
    folder = dataset.root / EPISODES[V30]
    files = sorted(folder.glob("chunk-*/file-*.parquet"))
    if not files:
        raise FormatError(f"{folder}: expected Parquet files with the episodes of the dataset, got none")
    return files


def _episodes_30(dataset: LeRobotDataset) -> Iterator[Episode]:
    columns = ("episode_index", "length", "data/chunk_index", "data/file_index")
    for file in episode_files(dataset):
        require_file(file, "the episodes of a LeRobot dataset")
        there, batches = columnar_file(file)
        for name in columns:
            if there.count(name) != 1:
                raise FormatError(f"{file}: expected one column {name!r}; {known_names(name, there)}")
        for batch in batches(columns):
            for row in zip(*(batch.column(k).to_pylist() for k in range(len(columns))), strict=True):
                index, frames, chunk, number = (_whole(*one) for one in zip(row, columns, strict=True))
                places = {"chunk_index": chunk, "file_index": number}
                yield Episode(index=index, frames=frames, file=data_file(dataset, places))


def _whole(value: Any, where: str) -> int:
    if type(value) is not int or not 0 <= value < _LONGEST_EPISODE:
        raise FormatError(f"{where}: expected a whole number from 0 on, got {quoted(str(value))}")
    return value
