# SPDX-License-Identifier: BSD-3-Clause
"""The small arm with a sensor that drifts with temperature and supply voltage and has no noise: a fit finds the truth.

Counts are made from the reference wrenches that the samples of the experiment have, so matrix, offset and coefficients
are exact whatever the derivatives of the joints are.
"""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.experiment.interval_samples import samples_over
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import QUANTITIES, Signal, Stream
from tests.scenes.experiments import MOUNTED, OFFSET, PARQUET, edit

PER_DEGREE = np.array([-0.4, 0.3, -1.2, 0.02, 0.01, -0.015])
"""True coefficients of the temperature; N/degC, N m/degC."""
PER_VOLT = np.array([2.0, -1.0, 5.0, 0.1, -0.2, 0.05])
"""True coefficients of the supply voltage; N/V, N m/V."""
WARM_DEGC, NOMINAL_V = 30.0, 12.0
"""Temperature and voltage at which the offset is `OFFSET`."""
EXACT = 1e-7
"""Relative to the largest entry: eps times the square of the condition, some 1e4, of raw readings and variables."""

PERIOD_S = 0.5
"""Of the slow stream `board` with the temperature, the supply voltage and a current."""
TEMPERATURE = '\n[[sensor.variable]]\nname = "temperature"\n'
"""The temperature of the sensor's own stream."""
SLOW_TEMPERATURE = f'{TEMPERATURE}stream = "board"\n'
"""The same from the slow stream."""
SUPPLY = '\n[[sensor.variable]]\nname = "supply"\nstream = "board"\nquantity = "scalar"\ncolumn = "supply"\n'
"""The supply voltage, one of two scalars of the slow stream."""
_PRIOR = 'prior = "matrix_SIM001.txt"\n'
_STAMPS = 50
"""The slow stream ends after the others do."""


def true_temperature(seconds: FloatArray) -> FloatArray:
    """Temperature at instants of the recording: straight lines between half degrees, up, level and down again."""
    knots = PERIOD_S * np.arange(_STAMPS)
    return np.interp(seconds, knots, 0.5 * np.round(60.0 + 8.0 * np.sin(2.0 * np.pi * knots / 17.0) + 0.3 * knots))


def true_supply(seconds: FloatArray) -> FloatArray:
    """Supply voltage at instants of the recording: straight lines between stamps of the slow stream."""
    knots = PERIOD_S * np.arange(_STAMPS)
    return np.interp(seconds, knots, 12.0 + 0.3 * np.cos(2.0 * np.pi * knots / 5.0))


def warm_up(cold: Path, folder: Path, *, drift: FloatArray = PER_DEGREE, per_volt: FloatArray | None = None) -> Path:
    """Copy the small experiment and let its first sensor drift; the experiment file states no variable yet."""
    shutil.copytree(cold, folder)
    experiment = load_experiment(folder / PARQUET)
    (interval, *_), recording = experiment.recording.intervals, experiment.recording
    start, end = recording.span_ns
    whole = replace(interval, start_ns=start, end_ns=end + 1)
    samples = samples_over(experiment, experiment.sensors[0], whole).samples
    stream = recording.stream("arm_ft")
    seconds = seconds_of(recording, stream.stamp_ns)
    change = np.outer(true_temperature(seconds) - WARM_DEGC, drift)
    if per_volt is not None:
        change = change + np.outer(true_supply(seconds) - NOMINAL_V, per_volt)
    raw = np.array(stream.signal("raw").values)
    found = np.isin(stream.stamp_ns, samples.stamp_ns)
    assert found.sum() > 0.99 * len(found)
    raw[found] = np.linalg.solve(MOUNTED, (samples.reference - OFFSET - change[found]).T).T
    raw[~found] = np.nan
    signals = {
        "raw": replace(stream.signal("raw"), values=raw),
        "temperature": fixed_signal("temperature", true_temperature(seconds)[:, None]),
    }
    put(folder, replace(stream, signals=signals), _board(recording, stream.clock))
    return folder


def seconds_of(recording: Recording, stamp_ns: IntArray) -> FloatArray:
    """Seconds from the earliest stamp of a recording."""
    return np.asarray(stamp_ns - recording.span_ns[0], dtype=np.float64) * 1e-9


def fixed_signal(quantity: str, values: FloatArray) -> Signal:
    """A signal of a quantity whose columns have names and units of their own."""
    return Signal(
        quantity=quantity, values=values, columns=QUANTITIES[quantity].columns, units=QUANTITIES[quantity].units
    )


def _board(recording: Recording, clock: str) -> Stream:
    knots = PERIOD_S * np.arange(_STAMPS)
    scalars = np.column_stack([true_supply(knots), 0.1 + 0.001 * knots])
    scalar = Signal(quantity="scalar", values=scalars, columns=("supply", "current"), units=("V", "A"))
    temperature = fixed_signal("temperature", true_temperature(knots)[:, None])
    stamps = recording.span_ns[0] + np.rint(knots * 1e9).astype(np.int64)
    return Stream(name="board", clock=clock, stamp_ns=stamps, signals={"scalar": scalar, "temperature": temperature})


def put(folder: Path, *streams: Stream) -> None:
    """Write streams into the recording of an experiment, in place of those of the same names."""
    recording = read_recording(folder / "recording")
    write_recording(
        folder / "recording", replace(recording, streams={**recording.streams, **{s.name: s for s in streams}})
    )


def with_variables(file: Path, *variables: str) -> Path:
    """State variables of the first sensor in an experiment file, and give the file back."""
    return edit(file, _PRIOR, _PRIOR + "".join(variables))
