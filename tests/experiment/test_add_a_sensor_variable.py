# SPDX-License-Identifier: BSD-3-Clause
"""A variable of a sensor is a quantity and its unit, a line each: files, fits and what they write know it from then on.

This is the recipe of docs/architecture.md, followed with a humidity.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import RecordingError, UnitError
from forcetorque.base.units import SI_FACTORS
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import TableLayout, TableSignal
from forcetorque.recording.storage import read_recording, recording_schema
from forcetorque.recording.stream import QUANTITIES, Labels, Quantity, Signal
from tests.scenes.experiments import MOUNTED, PARQUET
from tests.scenes.warm_experiments import EXACT, PER_DEGREE, fixed_signal, put, with_variables

HUMIDITY = Quantity(
    name="humidity",
    labels=Labels.FIXED,
    columns=("humidity",),
    units=("%",),
    description="Relative humidity of the air around a sensor.",
)
STATED = '\n[[sensor.variable]]\nname = "air"\nstream = "board"\nquantity = "humidity"\n'


@pytest.fixture
def added(monkeypatch: pytest.MonkeyPatch) -> None:
    """The line of the table of quantities."""
    monkeypatch.setitem(QUANTITIES, HUMIDITY.name, HUMIDITY)


def _renamed(folder: Path) -> Path:
    """Let what moves the sensor be a humidity of the same values, in place of the temperature."""
    board = read_recording(folder / "recording").stream("board")
    signals = {"humidity": fixed_signal("humidity", board.signal("temperature").values)}
    put(folder, replace(board, signals=signals))
    return with_variables(folder / PARQUET, STATED)


@pytest.mark.usefixtures("added")
def test_a_fit_finds_what_it_does(warm_log: Path) -> None:
    """It is written, read back, stated for the sensor, and its coefficients are exact."""
    experiment = load_experiment(_renamed(warm_log))
    run = SensorRun(experiment, "arm_ft")
    made = calibrate_sensor(run, code_version="1", created="now", regularisation=0.0)
    (variable,) = made.variables
    assert (variable.name, variable.unit) == ("air", "%")
    assert np.abs(variable.coefficients - PER_DEGREE).max() < EXACT * np.abs(PER_DEGREE).max()
    assert np.abs(made.matrix - MOUNTED).max() < EXACT * np.abs(MOUNTED).max()


@pytest.mark.usefixtures("added")
def test_tables_of_it_are_read_once_its_unit_is_known(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A column is declared as it; before the line of the unit it is refused, by name."""
    (tmp_path / "air.csv").write_text("rh\n40\n41.5\n", encoding="utf-8")
    declared = TableSignal(quantity="humidity", columns=("rh",), units=("%",))
    layout = TableLayout(stamp=None, signals=(declared,))
    with pytest.raises(UnitError, match="unknown unit '%'"):
        read_table(tmp_path / "air.csv", layout, stream="air", clock="board")
    monkeypatch.setitem(SI_FACTORS, "%", ("%", 1.0))
    read = read_table(tmp_path / "air.csv", layout, stream="air", clock="board").streams[0].signal("humidity")
    assert (read.columns, read.units) == (("humidity",), ("%",))
    assert read.values[:, 0].tolist() == [40.0, 41.5]


@pytest.mark.usefixtures("added")
def test_the_form_of_recordings_describes_it() -> None:
    """`forcetorque schema recording` says what it is."""
    assert recording_schema()["quantities"]["humidity"]["description"] == HUMIDITY.description


def test_without_the_line_it_is_refused() -> None:
    """Negative control: no signal can hold it; what has no quantity of its own is a scalar."""
    values = np.zeros((1, 1))
    with pytest.raises(RecordingError, match="no quantity is called 'humidity'"):
        Signal(quantity="humidity", values=values, columns=HUMIDITY.columns, units=HUMIDITY.units)
    assert Signal(quantity="scalar", values=values, columns=("humidity",), units=("%",)).quantity == "scalar"
