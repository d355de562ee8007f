# SPDX-License-Identifier: BSD-3-Clause
"""Statistics of features as LeRobot keeps them: of an episode, and pooled over a dataset [1].

References:
    [1] huggingface/lerobot 7427f31, src/lerobot/datasets/compute_stats.py: `aggregate_feature_stats` weights
        quantiles of episodes by their counts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray

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
