# SPDX-License-Identifier: BSD-3-Clause
"""A copy of a dataset with more features: a column in every file of frames, their description and statistics.

Each file is written as a whole or not at all, row group by row group, and a run that was killed is continued.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, OutputError
from forcetorque.base.input_file import READ_ERRORS, read_text, require_file
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.dataset.episode_frames import whole_numbers
from forcetorque.dataset.resumable_folder import ResumableFolder, link_or_copy
from forcetorque.formats.lerobot.dataset import INFO, V21, Episode, LeRobotDataset, episode_files

STATISTICS = "meta/stats.json"
"""File of the statistics of a dataset v3.0."""
EPISODE_STATISTICS = "meta/episodes_stats.jsonl"
"""File of the statistics of the episodes of a dataset v2.1."""
_LINKED = {"videos", "images"}
"""Folders whose files are not copied but get a second name."""
_ARROW_ERRORS = (*READ_ERRORS, pa.ArrowException)
EpisodeValues = Mapping[int, npt.NDArray[np.float32]]
"""Values of all added features by the number of the episode, frame by frame; shape (n, sum of widths)."""


def refuse_known_features(dataset: LeRobotDataset, names: Sequence[str]) -> None:
    """Refuse features that a dataset has already.

    Args:
        dataset: The dataset.
        names: Names of features to add.

    Raises:
        OutputError: If it has one of them, or one is no name of a feature.
    """
    for name in names:
        if not name.strip() or "/" in name:
            raise OutputError(f"--name: expected a name of a feature, without /, got {name!r}")
        if name in dataset.features:
            raise OutputError(
                f"{dataset.root / INFO}: expected no feature {name!r}, it is there already; choose --name"
            )


def add_features(
    dataset: LeRobotDataset,
    folder: ResumableFolder,
    features: Mapping[str, Sequence[str]],
    values_of: Callable[[Path, tuple[Episode, ...]], EpisodeValues],
    progress: Progress,
) -> tuple[int, tuple[Mapping[str, list[float] | list[int]], ...]]:
    """Copy a dataset and add features.

    Args:
        dataset: The dataset, of which nothing is changed.
        folder: The copy.
        features: Names of the elements of the features of float32 that are added, by the name of the feature.
        values_of: Gives the values of the episodes of a file.
        progress: Called with lines for people.

    Returns:
        Number of files of frames that an earlier run had written, and statistics of each feature over the dataset.

    Raises:
        FormatError: If a file is damaged.
    """
    changed = _changed_files(dataset)
    _copy_others(dataset, folder.folder, changed, progress)
    total = sum(episode.frames for episode in dataset.episodes)
    left, frames, resumed = TimeLeft(progress, "writing episodes", total), 0, 0
    statistics: dict[int, list[dict[str, Any]]] = {}
    for file, episodes in dataset.files():
        name = file.relative_to(dataset.root).as_posix()
        known = folder.entry(name)
        if known is None:
            values = values_of(file, episodes)
            known = {str(number): _statistics(rows, features) for number, rows in values.items() if len(rows)}
            _write_frames(file, folder.folder / name, features, values)
            folder.written(name, known)
        else:
            resumed += 1
        statistics |= {int(number): own for number, own in known.items()}
        frames += sum(episode.frames for episode in episodes)
        left.at(frames)
    pooled = tuple(
        pooled_statistics([statistics[number][k] for number in sorted(statistics)]) for k in range(len(features))
    )
    _write_descriptions(dataset, folder.folder, features, statistics, pooled)
    return resumed, pooled


def _changed_files(dataset: LeRobotDataset) -> set[str]:
    """Files that differ in the copy, below the folder of the dataset."""
    changed = {file.relative_to(dataset.root).as_posix() for file, _ in dataset.files()} | {INFO}
    if dataset.version == V21:
        return changed | {EPISODE_STATISTICS}
    return changed | {STATISTICS} | {file.relative_to(dataset.root).as_posix() for file in episode_files(dataset)}


def _copy_others(dataset: LeRobotDataset, target: Path, changed: set[str], progress: Progress) -> None:
    files = []
    for place, folders, names in os.walk(dataset.root):
        folders[:] = sorted(name for name in folders if name not in (".git", ".cache"))
        linked = next((name for name in folders if (Path(place) / name).is_symlink()), None)
        if linked is not None:
            raise FormatError(
                f"{Path(place) / linked}: expected a folder, got a symbolic link to one; copy the dataset first"
            )
        files += [Path(place) / name for name in sorted(names)]
    left = TimeLeft(progress, "copying other files", len(files))
    for number, file in enumerate(files):
        name = file.relative_to(dataset.root)
        if name.as_posix() not in changed:
            if not file.is_file():
                raise FormatError(f"{file}: expected a file, got none that can be copied; copy the dataset again")
            link_or_copy(file, target / name, link=name.parts[0] in _LINKED)
        left.at(number)


def _statistics(rows: npt.NDArray[np.float32], features: Mapping[str, Sequence[str]]) -> list[dict[str, Any]]:
    return [episode_statistics(part.astype(np.float64)) for part in _parts(rows, features)]


def _parts(rows: npt.NDArray[np.float32], features: Mapping[str, Sequence[str]]) -> Iterator[npt.NDArray[np.float32]]:
    start = 0
    for names in features.values():
        yield rows[:, start : start + len(names)]
        start += len(names)


def _write_frames(source: Path, target: Path, features: Mapping[str, Sequence[str]], values: EpisodeValues) -> None:
    """Write a file of frames with the columns, whose rows are those of each episode in their order."""
    target.parent.mkdir(parents=True, exist_ok=True)
    fresh = target.with_name(f"{target.name}.part")
    done = dict.fromkeys(values, 0)
    try:
        with pq.ParquetFile(source) as file:
            schema = _schema(file.schema_arrow, features)
            with pq.ParquetWriter(fresh, schema) as writer:
                for group in range(file.num_row_groups):
                    table = file.read_row_group(group)
                    rows = _rows_of(whole_numbers(table.column("episode_index").combine_chunks()), values, done)
                    for part, (feature, names) in zip(_parts(rows, features), features.items(), strict=True):
                        flat = pa.array(np.ascontiguousarray(part).reshape(-1), pa.float32())
                        column = pa.FixedSizeListArray.from_arrays(flat, len(names))
                        table = table.append_column(schema.field(feature), column)
                    writer.write_table(table.cast(schema), row_group_size=max(1, len(table)))
    except _ARROW_ERRORS as error:
        if isinstance(error, FormatError):
            raise
        text = " ".join(str(error).split())[:200]
        raise FormatError(f"{source}: expected a file of frames that can be copied to {target}, got: {text}") from error
    with fresh.open("rb+") as stream:
        os.fsync(stream.fileno())
    fresh.replace(target)


def _rows_of(numbers: npt.NDArray[np.int64], values: EpisodeValues, done: dict[int, int]) -> npt.NDArray[np.float32]:
    width = next(iter(values.values())).shape[1]
    rows = np.empty((len(numbers), width), dtype=np.float32)
    for block in np.split(np.arange(len(numbers)), np.flatnonzero(np.diff(numbers)) + 1) if len(numbers) else ():
        number = int(numbers[block[0]])
        rows[block] = values[number][done[number] : done[number] + len(block)]
        done[number] += len(block)
    return rows


def _schema(schema: Any, features: Mapping[str, Sequence[str]]) -> Any:
    """The schema with the features, and with their types in the metadata by which `datasets` reads."""
    for feature, names in features.items():
        if feature in schema.names:
            raise FormatError(f"expected no column {feature!r}, which {INFO} lacks, got one")
        schema = schema.append(pa.field(feature, pa.list_(pa.field("element", pa.float32()), len(names))))
    metadata = dict(schema.metadata or {})
    try:
        described = json.loads(metadata[b"huggingface"])
        known = described["info"]["features"]
        vectors = [one for one in known.values() if isinstance(one, dict) and one.get("_type") in ("List", "Sequence")]
        kind = vectors[0]["_type"] if vectors else "Sequence"  # which `datasets` of all versions knows, unlike List
        for feature, names in features.items():
            value = {"dtype": "float32", "_type": "Value"}
            known[feature] = {"feature": value, "length": len(names), "_type": kind}
        metadata[b"huggingface"] = json.dumps(described).encode()
    except (KeyError, ValueError, TypeError, AttributeError):  # absent or another program's; loaders then go by columns
        metadata.pop(b"huggingface", None)
    return schema.with_metadata(metadata)


def _write_descriptions(
    dataset: LeRobotDataset,
    target: Path,
    features: Mapping[str, Sequence[str]],
    statistics: Mapping[int, Sequence[Mapping[str, Any]]],
    pooled: Sequence[Mapping[str, Any]],
) -> None:
    if dataset.version == V21:
        _write_episode_lines(dataset, target, features, statistics)
    else:
        for file in episode_files(dataset):
            _write_episode_table(file, target / file.relative_to(dataset.root), features, statistics)
        _write_statistics(dataset, target, features, pooled)
    content = json.loads(json.dumps(dataset.info))
    # the converter to v3.0 gives every feature its rate
    rate = {"fps": content["fps"]} if any("fps" in one for one in content["features"].values()) else {}
    for feature, names in features.items():
        described = {"dtype": "float32", "shape": [len(names)], "names": list(names)}
        content["features"][feature] = described | rate
    write_bytes_atomically(target / INFO, json.dumps(content, indent=4, ensure_ascii=False).encode())


def _write_statistics(
    dataset: LeRobotDataset, target: Path, features: Mapping[str, Sequence[str]], pooled: Sequence[Mapping[str, Any]]
) -> None:
    file = dataset.root / STATISTICS
    known: Any = {}
    if file.is_file():
        try:
            known = json.loads(read_text(file, "the statistics of a LeRobot dataset"))
        except (ValueError, RecursionError) as error:
            raise FormatError(f"{file}: expected JSON, got {error}") from error
    if not isinstance(known, dict):
        raise FormatError(f"{file}: expected a JSON object with the statistics of features")
    keys = _keys_of([own for own in known.values() if isinstance(own, dict)])
    for feature, own in zip(features, pooled, strict=True):
        known[feature] = {key: own[key] for key in keys}
    write_bytes_atomically(target / STATISTICS, json.dumps(known, indent=4, ensure_ascii=False).encode())


def _keys_of(known: Sequence[Mapping[str, Any]]) -> list[str]:
    """Names of the statistics that features have; of a dataset without any those of v3.0."""
    every = [*PLAIN, *QUANTILES]
    return [key for key in every if not known or key in PLAIN or any(key in own for own in known)]


def _write_episode_table(
    source: Path,
    target: Path,
    features: Mapping[str, Sequence[str]],
    statistics: Mapping[int, Sequence[Mapping[str, Any]]],
) -> None:
    """Append `stats/<feature>/<statistic>` to a file of episodes of v3.0."""
    require_file(source, "the episodes of a LeRobot dataset")
    try:
        table = pq.read_table(source)
        numbers = table.column("episode_index").to_pylist()
        of_others = {name.rpartition("/")[2]: None for name in table.column_names if name.startswith("stats/")}
        for k, feature in enumerate(features):
            for key in _keys_of([of_others] if of_others else []):
                own = [statistics[number][k][key] if number in statistics else None for number in numbers]
                kind = pa.list_(pa.field("element", pa.int64() if key == "count" else pa.float64()))
                table = table.append_column(f"stats/{feature}/{key}", pa.array(own, kind))
        target.parent.mkdir(parents=True, exist_ok=True)
        sink = pa.BufferOutputStream()
        pq.write_table(table, sink)
    except _ARROW_ERRORS as error:
        text = " ".join(str(error).split())[:200]
        raise FormatError(f"{source}: expected the episodes of a LeRobot dataset, got: {text}") from error
    write_bytes_atomically(target, sink.getvalue())


def _write_episode_lines(
    dataset: LeRobotDataset,
    target: Path,
    features: Mapping[str, Sequence[str]],
    statistics: Mapping[int, Sequence[Mapping[str, Any]]],
) -> None:
    """Add to each line of the statistics of episodes of v2.1."""
    file = dataset.root / EPISODE_STATISTICS
    lines = read_text(file, "the statistics of the episodes of a LeRobot dataset v2.1").splitlines()
    written = []
    for number, line in enumerate(lines, start=1):
        if not line.strip():
            continue
        try:
            content = json.loads(line)
            own = content["stats"]
            index = content["episode_index"]
            keys = _keys_of([one for one in own.values() if isinstance(one, dict)] or [dict.fromkeys(PLAIN)])
            if index in statistics:
                for feature, values in zip(features, statistics[index], strict=True):
                    own[feature] = {key: values[key] for key in keys}
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            raise FormatError(f"{file}:{number}: expected episode_index and stats of an episode as JSON") from error
        written.append(json.dumps(content, ensure_ascii=False))
    write_bytes_atomically(target / EPISODE_STATISTICS, ("\n".join(written) + "\n").encode())


QUANTILES = {"q01": 0.01, "q10": 0.10, "q50": 0.50, "q90": 0.90, "q99": 0.99}
"""Quantiles of v3.0, by their names."""
PLAIN = ("min", "max", "mean", "std", "count")
"""Statistics of every version."""
Statistics = Mapping[str, list[float] | list[int]]
"""Values by the name of the statistic, one for each element; of `count` one."""


def episode_statistics(values: FloatArray) -> dict[str, list[float] | list[int]]:
    """Give the statistics of a feature in an episode.

    Args:
        values: Its frames; shape (n, k), n at least 1.

    Returns:
        All of `PLAIN` and `QUANTILES`; standard deviations are those of all frames, not of a sample.
    """
    statistics: dict[str, list[float] | list[int]] = {
        "min": values.min(axis=0).tolist(),
        "max": values.max(axis=0).tolist(),
        "mean": values.mean(axis=0).tolist(),
        "std": values.std(axis=0).tolist(),
        "count": [len(values)],
    }
    quantiles = np.quantile(values, list(QUANTILES.values()), axis=0)
    return statistics | {name: row.tolist() for name, row in zip(QUANTILES, quantiles, strict=True)}


def pooled_statistics(episodes: Sequence[Statistics]) -> dict[str, list[float] | list[int]]:
    """Pool the statistics of episodes.

    Args:
        episodes: Statistics of each, at least one.

    Returns:
        Those of all frames; quantiles are means of those of episodes, weighted by their frames, as LeRobot pools them.
    """
    counts = np.array([one["count"][0] for one in episodes], dtype=np.float64)[:, None]
    share = counts / counts.sum()
    means, deviations = (np.array([one[name] for one in episodes], dtype=np.float64) for name in ("mean", "std"))
    mean = (share * means).sum(axis=0)
    variance = (share * (deviations**2 + (means - mean) ** 2)).sum(axis=0)
    pooled: dict[str, list[float] | list[int]] = {
        "min": np.min([one["min"] for one in episodes], axis=0).tolist(),
        "max": np.max([one["max"] for one in episodes], axis=0).tolist(),
        "mean": mean.tolist(),
        "std": np.sqrt(variance).tolist(),
        "count": [int(counts.sum())],
    }
    for name in QUANTILES:
        pooled[name] = (share * np.array([one[name] for one in episodes], dtype=np.float64)).sum(axis=0).tolist()
    return pooled
