# SPDX-License-Identifier: BSD-3-Clause
"""Small datasets in the layouts of LeRobot v2.1 and v3.0, as their official writers make them.

The layout is that of huggingface/lerobot 7427f31: src/lerobot/datasets/utils.py and convert_dataset_v21_to_v30.py.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

FPS = 50
WRENCH = ("fx", "fy", "fz", "tx", "ty", "tz")
QUATERNION = {"axes": ["qx", "qy", "qz", "qw"]}
QUANTILES = {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}
Frames = Mapping[str, Any]
"""Values by feature; shape (n, k) or (n,)."""


def write_dataset(
    root: Path,
    episodes: Sequence[Frames],
    *,
    version: str = "v3.0",
    names: Mapping[str, Any] | None = None,
    per_file: int = 1000,
    variable_lists: bool = False,
) -> Path:
    """Write a dataset.

    Args:
        root: Its folder, which is made.
        episodes: Frames of each episode.
        version: `v2.1` or `v3.0`.
        names: Names of the elements of features; of the wrench and the quaternion those above.
        per_file: Episodes in a file of v3.0.
        variable_lists: Whether vectors are lists of variable length, as some writers make them.

    Returns:
        The folder.
    """
    frames = [_with_counters(k, episode, episodes) for k, episode in enumerate(episodes)]
    named = {"observation.wrench": list(WRENCH), "observation.ee_quat": QUATERNION} | dict(names or {})
    features = {key: _feature(value, named.get(key)) for key, value in frames[0].items()}
    is_21 = version == "v2.1"
    info: dict[str, Any] = {
        "codebase_version": version,
        "robot_type": "synthetic_arm",
        "total_episodes": len(frames),
        "total_frames": sum(map(_length, frames)),
        "total_tasks": 1,
        "chunks_size": 1000,
        "fps": FPS,
        "splits": {"train": f"0:{len(frames)}"},
        "data_path": "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet"
        if is_21
        else "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
        "video_path": None,
        "features": features,
    }
    info |= {"total_videos": 0, "total_chunks": 1} if is_21 else {"data_files_size_in_mb": 100}
    (root / "meta").mkdir(parents=True)
    (root / "meta" / "info.json").write_text(json.dumps(info, indent=4), encoding="utf-8")
    stats = [{key: stats_of(value, quantiles=not is_21) for key, value in episode.items()} for episode in frames]
    kind = "Sequence" if is_21 else "List"  # as `datasets` wrote it when the layout was in use
    tables = [_table(episode, features, variable_lists=variable_lists, kind=kind) for episode in frames]
    (_write_21 if is_21 else _write_30)(root, tables, stats, per_file)
    return root


def stats_of(values: Any, *, quantiles: bool) -> dict[str, list[float]]:
    """Give the statistics that a dataset has of a feature of an episode."""
    rows = np.asarray(values, dtype=np.float64).reshape(len(values), -1)
    stats = {name: getattr(rows, name)(axis=0).tolist() for name in ("min", "max", "mean", "std")}
    stats["count"] = [len(rows)]
    if quantiles:
        stats |= {name: np.quantile(rows, share, axis=0).tolist() for name, share in QUANTILES.items()}
    return stats


def pooled(parts: Sequence[Mapping[str, Sequence[float]]]) -> dict[str, list[float]]:
    """Pool statistics of episodes as lerobot's `aggregate_stats` does: quantiles are means, weighted by counts."""
    counts = np.array([part["count"][0] for part in parts], dtype=float)[:, None]
    mean = (counts * [part["mean"] for part in parts]).sum(axis=0) / counts.sum()
    second = np.square([part["std"] for part in parts]) + np.square(np.array([part["mean"] for part in parts]) - mean)
    stats = {
        "min": np.min([part["min"] for part in parts], axis=0),
        "max": np.max([part["max"] for part in parts], axis=0),
        "mean": mean,
        "std": np.sqrt((counts * second).sum(axis=0) / counts.sum()),
    }
    quantiles = {name: (counts * [part[name] for part in parts]).sum(axis=0) / counts.sum() for name in QUANTILES}
    return {name: values.tolist() for name, values in (stats | quantiles).items()} | {"count": [int(counts.sum())]}


def _length(episode: Frames) -> int:
    return len(episode["index"])


def _with_counters(number: int, episode: Frames, episodes: Sequence[Frames]) -> dict[str, Any]:
    lengths = [len(next(iter(one.values()))) for one in episodes]
    n, before = lengths[number], sum(lengths[:number])
    return dict(episode) | {
        "timestamp": (np.arange(n) / FPS).astype(np.float32),
        "frame_index": np.arange(n),
        "episode_index": np.full(n, number),
        "index": np.arange(before, before + n),
        "task_index": np.zeros(n, dtype=np.int64),
    }


def _feature(values: Any, names: Any) -> dict[str, Any]:
    values = np.asarray(values)
    return {"dtype": str(values.dtype), "shape": list(values.shape[1:]) or [1], "names": names}


def _table(episode: Frames, features: Mapping[str, Any], *, variable_lists: bool, kind: str) -> Any:
    arrays, described = {}, {}
    for key, values in episode.items():
        values = np.asarray(values)
        flat, value = pa.array(values.reshape(-1)), {"dtype": features[key]["dtype"], "_type": "Value"}
        if values.ndim == 1:
            arrays[key], described[key] = flat, value
            continue
        arrays[key] = pa.FixedSizeListArray.from_arrays(flat, values.shape[1])
        if variable_lists:
            arrays[key] = arrays[key].cast(pa.list_(flat.type))
        described[key] = {"feature": value, "length": values.shape[1], "_type": kind}
    metadata = {b"huggingface": json.dumps({"info": {"features": described}}).encode()}
    return pa.table(arrays).replace_schema_metadata(metadata)


def _write_21(root: Path, tables: Sequence[Any], stats: Sequence[Any], per_file: int) -> None:
    (root / "data" / "chunk-000").mkdir(parents=True)
    episodes, lines = [], []
    for k, (table, own) in enumerate(zip(tables, stats, strict=True)):
        pq.write_table(table, root / "data" / "chunk-000" / f"episode_{k:06d}.parquet")
        episodes.append(json.dumps({"episode_index": k, "tasks": ["hold"], "length": len(table)}))
        lines.append(json.dumps({"episode_index": k, "stats": own}))
    meta = root / "meta"
    (meta / "episodes.jsonl").write_text("\n".join(episodes) + "\n", encoding="utf-8")
    (meta / "episodes_stats.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (meta / "tasks.jsonl").write_text('{"task_index": 0, "task": "hold"}\n', encoding="utf-8")


def _write_30(root: Path, tables: Sequence[Any], stats: Sequence[Any], per_file: int) -> None:
    (root / "data" / "chunk-000").mkdir(parents=True)
    (root / "meta" / "episodes" / "chunk-000").mkdir(parents=True)
    rows, start = [], 0
    for first in range(0, len(tables), per_file):
        number = first // per_file
        path = root / "data" / "chunk-000" / f"file-{number:03d}.parquet"
        with pq.ParquetWriter(path, tables[0].schema) as writer:
            for k, table in list(enumerate(tables))[first : first + per_file]:
                writer.write_table(table)
                row = {"episode_index": k, "tasks": ["hold"], "length": len(table), "data/chunk_index": 0}
                row |= {"data/file_index": number, "dataset_from_index": start, "dataset_to_index": start + len(table)}
                row |= {f"stats/{key}/{stat}": values for key, own in stats[k].items() for stat, values in own.items()}
                rows.append(row)
                start += len(table)
    pq.write_table(pa.Table.from_pylist(rows), root / "meta" / "episodes" / "chunk-000" / "file-000.parquet")
    tasks = pa.table({"task_index": [0], "__index_level_0__": ["hold"]})
    text = {"name": None, "field_name": "__index_level_0__", "pandas_type": "unicode", "numpy_type": "object"}
    described = {"index_columns": ["__index_level_0__"], "column_indexes": [], "columns": [text | {"metadata": None}]}
    tasks = tasks.replace_schema_metadata({b"pandas": json.dumps(described).encode()})  # lerobot takes text as index
    pq.write_table(tasks, root / "meta" / "tasks.parquet")
    total = {key: pooled([own[key] for own in stats]) for key in stats[0]}
    (root / "meta" / "stats.json").write_text(json.dumps(total, indent=4), encoding="utf-8")


def tool_episodes(
    lengths: Sequence[int],
    *,
    seed: int = 0,
    mass: float | Sequence[float] = 0.8,
    centre: Sequence[float] = (0.01, -0.02, 0.05),
    bias: Any = (1.5, -0.7, 2.2, 0.05, -0.03, 0.02),
    noise: Sequence[float] = (0.05, 0.002),
    gravity: float = 9.80665,
) -> list[dict[str, Any]]:
    """Make episodes in which a wrist turns a tool: the hanging tool reads `R' (0, 0, -m g)`, as `child_to_parent` does.

    Args:
        lengths: Frames of each episode.
        seed: Of noise and motion.
        mass: Of the tool; kg; one for all episodes or for each.
        centre: Its centre of mass in the sensor; m.
        bias: Of the reading; shape (6,), or (episodes, 6); N, N m.
        noise: Standard deviation of forces (N) and moments (N m).
        gravity: m/s2.

    Returns:
        Frames of `observation.state`, `observation.wrench` and `observation.ee_quat` (x, y, z, w; sensor to world).
    """
    from scipy.spatial.transform import Rotation

    rng = np.random.default_rng(seed)
    masses = np.broadcast_to(mass, len(lengths))
    biases = np.broadcast_to(np.asarray(bias, dtype=float), (len(lengths), 6))
    episodes = []
    for k, n in enumerate(lengths):
        time, phase = np.arange(n) / FPS, rng.uniform(0.0, 2.0 * np.pi, 3)
        angles = np.array([1.2, 1.1, 0.4]) * np.sin(np.array([0.9, 1.3, 0.5]) * time[:, None] + phase)
        turned = Rotation.from_euler("xyz", angles)
        force = turned.inv().apply([0.0, 0.0, -float(masses[k]) * gravity])
        wrench = np.hstack([force, np.cross(np.asarray(centre, dtype=float), force)]) + biases[k]
        wrench += rng.normal(size=(n, 6)) * np.repeat(noise, 3)
        episodes.append(
            {
                "observation.state": angles.astype(np.float32),
                "observation.wrench": wrench.astype(np.float32),
                "observation.ee_quat": turned.as_quat(),
            }
        )
    return episodes
