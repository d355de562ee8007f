# SPDX-License-Identifier: BSD-3-Clause
"""The sums behind a fit and its errors, by hand with pandas and with dask.dataframe, and by the moments of the library.

All take the same tables of readings and expected wrenches, one file per recording, and give the normal equations of a
least-squares fit with an offset, and the sums of errors of the prior matrix per axis and of their squares.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from forcetorque import load_experiment
from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.calibration.moments import Moments, pooled
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use

RAW = [f"raw_{k}" for k in range(6)]
WRENCH = list(WRENCH_COMPONENTS)


def write_tables(experiment: Path, number: int, folder: Path) -> tuple[list[Path], FloatArray]:
    """Write the calibration samples of a recording of one sensor as tables.

    Args:
        experiment: Experiment file.
        number: Number of equal tables.
        folder: Folder to make.

    Returns:
        Their files; and the prior matrix, shape (6, 6).

    Raises:
        SystemExit: If the sensor has no prior matrix.
    """
    content = load_experiment(experiment)
    run = SensorRun(content, content.sensors[0])
    (part,) = run.samples(Use.CALIBRATION)
    if run.sensor.prior is None:
        raise SystemExit(f"{experiment}: expected a sensor with a prior matrix")
    frame = pd.DataFrame(np.hstack([part.raw, part.samples.reference]), columns=[*RAW, *WRENCH])
    folder.mkdir()
    files = [folder / f"{k:05d}.parquet" for k in range(number)]
    for file in files:
        frame.to_parquet(file)
    return files, run.sensor.prior


def sums_of(frame: pd.DataFrame, prior: FloatArray) -> FloatArray:
    """Sum up samples.

    Args:
        frame: Columns `RAW` and `WRENCH`; n rows; counts, N, N m.
        prior: Prior matrix; shape (6, 6).

    Returns:
        Products of readings and one, products of these and wrenches, errors, squared errors; shape (103,).
    """
    raw, wrench = frame[RAW].to_numpy(), frame[WRENCH].to_numpy()
    rows, error = np.column_stack([raw, np.ones(len(raw))]), raw @ prior.T - wrench
    return np.concatenate([(rows.T @ rows).ravel(), (rows.T @ wrench).ravel(), error.sum(0), (error**2).sum(0)])


def with_pandas(files: Sequence[Path], prior: FloatArray) -> FloatArray:
    """Sum up tables one after the other.

    Args:
        files: The tables.
        prior: As of `sums_of`.

    Returns:
        As of `sums_of`.
    """
    return np.sum([sums_of(pd.read_parquet(file), prior) for file in files], axis=0)


def _sums_frame(frame: pd.DataFrame, prior: FloatArray) -> pd.DataFrame:
    return pd.DataFrame([sums_of(frame, prior)])


def with_dask(files: Sequence[Path], prior: FloatArray, address: str) -> FloatArray:
    """Sum up tables on a cluster, each in a task of its own.

    Args:
        files: The tables.
        prior: As of `sums_of`.
        address: Address of its scheduler.

    Returns:
        As of `sums_of`.
    """
    import dask.dataframe as dd
    from distributed import Client

    meta = pd.DataFrame(np.zeros((0, 103)))
    with Client(address):
        frame = dd.read_parquet([str(file) for file in files], split_row_groups=True)
        return frame.map_partitions(_sums_frame, prior, meta=meta).sum().compute().to_numpy()


def with_moments(files: Sequence[Path], prior: FloatArray) -> FloatArray:
    """Sum up tables as the library does.

    Args:
        files: The tables.
        prior: As of `sums_of`.

    Returns:
        As of `sums_of`.
    """
    frames = (pd.read_parquet(file) for file in files)
    moments = pooled(Moments.of(frame[RAW].to_numpy(), frame[WRENCH].to_numpy()) for frame in frames)
    mean = np.concatenate([moments.mean[:6], [1.0], moments.mean[6:]])
    products = moments.count * np.outer(mean, mean)
    others = np.r_[:6, 7:13]
    products[np.ix_(others, others)] += moments.count * moments.second
    error = moments.count * (prior @ moments.mean[:6] - moments.mean[6:])
    squares = moments.count * moments.squared_error(WrenchModel(matrix=prior, offset=np.zeros(6)))
    return np.concatenate([products[:7, :7].ravel(), products[:7, 7:].ravel(), error, squares])
