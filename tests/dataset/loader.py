# SPDX-License-Identifier: BSD-3-Clause
"""What lerobot 0.4.4 demands of a dataset, and what a policy needs that the loader does not check, as assertions.

Of huggingface/lerobot 7427f31: `LeRobotDatasetMetadata` and `load_nested_dataset` (a column that info.json lacks, or a
feature that a file lacks, fails in `datasets` as a cast), `get_hf_features_from_features` (types of columns),
`load_episodes` (columns `stats/...`), `load_stats`; of v2.1 `load_episodes_stats`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

QUANTILES = ("q01", "q10", "q50", "q90", "q99")
PLAIN = ("min", "max", "mean", "std", "count")
ROUNDING = 1e-5
"""Statistics of float32 values that were computed in float64, or in float32 as some writers do."""


def require_loadable(root: Path, *, pooled: bool = True) -> dict[str, Any]:
    """Check every demand.

    Args:
        root: The dataset.
        pooled: Whether quantiles of the dataset are means of those of episodes, as the official writer pools them.

    Returns:
        Frames of all episodes in their order, by feature.
    """
    info = json.loads((root / "meta" / "info.json").read_text(encoding="utf-8"))
    is_21 = info["codebase_version"] == "v2.1"
    assert is_21 or info["codebase_version"] == "v3.0"
    features = info["features"]
    for name, feature in features.items():
        assert set(feature) - {"fps", "info"} == {"dtype", "shape", "names"}, name
        if feature["names"] is not None and isinstance(feature["names"], list):
            assert len(np.ravel(feature["names"])) == feature["shape"][0], name
    columns = {name: feature for name, feature in features.items() if feature["dtype"] != "video"}
    episodes = _episodes_21(root, info) if is_21 else _episodes_30(root, info)
    files = dict.fromkeys(episode["file"] for episode in episodes)
    assert {path.relative_to(root).as_posix() for path in (root / "data").rglob("*.parquet")} == set(files)
    tables = [_table(root / file, columns) for file in files]
    assert sum(map(len, tables)) == info["total_frames"]
    assert len(episodes) == info["total_episodes"]
    frames = {
        name: np.concatenate([_values(table.column(name), feature) for table in tables])
        for name, feature in columns.items()
    }
    start = 0
    for number, episode in enumerate(episodes):
        own = slice(start, start + episode["length"])
        assert (frames["episode_index"][own] == number).all()
        np.testing.assert_array_equal(frames["frame_index"][own].ravel(), np.arange(episode["length"]))
        np.testing.assert_array_equal(frames["index"][own].ravel(), np.arange(own.start, own.stop))
        assert (episode.get("from", own.start), episode.get("to", own.stop)) == (own.start, own.stop)
        for name in columns:
            _require_statistics(episode["stats"][name], frames[name][own], () if is_21 else QUANTILES)
        start = own.stop
    assert (root / "meta" / ("tasks.jsonl" if is_21 else "tasks.parquet")).is_file()
    if not is_21:
        stats = json.loads((root / "meta" / "stats.json").read_text(encoding="utf-8"))
        assert set(stats) >= set(columns)
        for name in columns:
            _require_statistics(stats[name], frames[name], ())
            weights = [episode["length"] / start for episode in episodes]
            for key in QUANTILES if pooled else ():
                parts = np.array([episode["stats"][name][key] for episode in episodes])
                np.testing.assert_allclose(np.ravel(stats[name][key]), weights @ parts, rtol=ROUNDING, atol=ROUNDING)
    return frames


def _table(file: Path, columns: Mapping[str, Any]) -> Any:
    """A file whose columns are the features, with their types, as `datasets` casts them."""
    table = pq.read_table(file)
    assert set(table.column_names) == set(columns), file
    assert len(table.column_names) == len(columns)
    for field in table.schema:
        feature = columns[field.name]
        (width,) = feature["shape"]
        kind = field.type.value_type if pa.types.is_nested(field.type) else field.type
        assert str(kind) == {"float32": "float", "float64": "double"}.get(feature["dtype"], feature["dtype"]), field
        if width > 1:
            assert pa.types.is_fixed_size_list(field.type), field
            assert field.type.list_size == width
    metadata = (table.schema.metadata or {}).get(b"huggingface")
    if metadata is not None:
        assert set(json.loads(metadata)["info"]["features"]) == set(columns)
    return table


def _values(column: Any, feature: Mapping[str, Any]) -> Any:
    values = np.array(column.to_pylist(), dtype=float).reshape(len(column), *feature["shape"])
    assert np.isfinite(values).all()
    return values


def _episodes_21(root: Path, info: Mapping[str, Any]) -> list[dict[str, Any]]:
    listed, stats = (
        {row["episode_index"]: row for row in map(json.loads, (root / "meta" / name).read_text("utf-8").splitlines())}
        for name in ("episodes.jsonl", "episodes_stats.jsonl")
    )
    assert list(listed) == list(stats) == list(range(len(listed)))
    return [
        {
            "length": listed[k]["length"],
            "file": info["data_path"].format(episode_chunk=k // info["chunks_size"], episode_index=k),
            "stats": stats[k]["stats"],
        }
        for k in listed
    ]


def _episodes_30(root: Path, info: Mapping[str, Any]) -> list[dict[str, Any]]:
    rows = [
        row
        for file in sorted((root / "meta" / "episodes").rglob("*.parquet"))
        for row in pq.read_table(file).to_pylist()
    ]
    assert [row["episode_index"] for row in rows] == list(range(len(rows)))
    episodes = []
    for row in rows:
        stats: dict[str, dict[str, Any]] = {}
        for key, value in row.items():
            if key.startswith("stats/"):
                name, _, statistic = key.removeprefix("stats/").rpartition("/")
                stats.setdefault(name, {})[statistic] = value
        places = {"chunk_index": row["data/chunk_index"], "file_index": row["data/file_index"]}
        file = info["data_path"].format(**places)
        own = {"length": row["length"], "file": file, "stats": stats}
        episodes.append(own | {"from": row["dataset_from_index"], "to": row["dataset_to_index"]})
    return episodes


def _require_statistics(stats: Mapping[str, Any], values: Any, quantiles: tuple[str, ...]) -> None:
    assert set(PLAIN) | set(quantiles) <= set(stats)
    assert stats["count"] == [len(values)]
    for key in ("min", "max", "mean", "std"):
        expected = getattr(values, key)(axis=0)
        rounding = ROUNDING * max(1.0, float(np.abs(values).max()))
        np.testing.assert_allclose(np.ravel(stats[key]), np.ravel(expected), rtol=ROUNDING, atol=rounding)
    previous = np.ravel(stats["min"])
    for key in (*quantiles, "max"):
        assert (np.ravel(stats[key]) >= previous - ROUNDING * (1.0 + np.abs(previous))).all()
        previous = np.ravel(stats[key])
