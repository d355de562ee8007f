# SPDX-License-Identifier: BSD-3-Clause
"""What temperature does to a recorded sensor: coefficients that `calibrate` can take, and what makes them doubtful."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import load_experiment as interactive_experiment
from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.sensor.commands import thermal
from tests.page_scripts import unmarked
from tests.results.showing import require_shown
from tests.scenes.experiments import PARQUET
from tests.scenes.thermal_cycles import HYSTERESIS, PER_DEGREE, TEXT, record, write_cycles
from tests.scenes.warm_experiments import TEMPERATURE, with_variables

ENOUGH = 3.0
"""Half-widths of 95 % intervals within which all of some numbers lie, where the shape of the noise is misjudged too."""


@pytest.fixture(scope="module")
def chamber(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two cycles in a chamber."""
    return write_cycles(tmp_path_factory.mktemp("chamber"), *record(np.random.default_rng(11)))


def _run(path: Path) -> SensorRun:
    experiment = load_experiment(path)
    return SensorRun(experiment, experiment.sensors[0])


def test_the_drift_of_every_component_is_shown(chamber: Path) -> None:
    """Six rows with the truth within their intervals, and no doubt."""
    result = thermal(_run(chamber))
    require_shown(result)
    (sensor,) = result.sensors
    assert result.warnings == ()
    assert (sensor.cycles, sensor.sessions, sensor.channels, sensor.variable) == (2.0, 1, (), "temperature")
    for row, slope, apart in zip(sensor.components, PER_DEGREE, HYSTERESIS, strict=True):
        assert abs(row.drift_per_degC - slope) < ENOUGH * row.drift_half_width_95_per_degC
        assert row.hysteresis is not None
        assert row.hysteresis_half_width_95 is not None
        assert abs(row.hysteresis - apart) < ENOUGH * row.hysteresis_half_width_95
    assert len(result.records()) == 6


def test_what_calibrate_is_told_takes_the_drift_off(chamber: Path) -> None:
    """Added as a calibration adds them, the coefficients take the drift off; with the other sign they double it."""
    run = _run(chamber)
    (sensor,) = thermal(run).sensors
    lines = sensor.variable_table()
    assert lines is not None
    stated = tomllib.loads("\n".join(lines))
    coefficients = np.array(stated["prior_coefficients"])[:, None]
    reading = run.stream.signal("wrench").values
    degrees = run.stream.signal("temperature").values
    for sign, share in ((1.0, 0.1), (-1.0, 3.0)):
        model = WrenchModel(
            matrix=np.eye(6),
            offset=np.zeros(6),
            coefficients=sign * coefficients,
            reference_values=np.array([sensor.reference_degC]),
        )
        left = np.std(model.wrench(reading, degrees)[:, 2]) / np.std(reading[:, 2])
        assert left < share if sign > 0.0 else left > 0.5 * share
    text = TEXT.replace('name = "temperature"\n', 'name = "temperature"\n' + "\n".join(lines) + "\n")
    (chamber.parent / "told.toml").write_text(text)
    told = load_experiment(chamber.parent / "told.toml").sensors[0].variables[0].linear
    assert told.prior is not None
    assert told.prior_deviation is not None
    np.testing.assert_allclose(told.prior, -PER_DEGREE, rtol=0.1)


def test_doubts_are_named(tmp_path: Path) -> None:
    """A small range, one cycle, a rise alone, a step of the load."""
    time, degrees, reading = record(np.random.default_rng(12), cycles=1.0, swing_degC=3.0)
    reading[3000:, 2] -= 2.0
    doubts = " ".join(thermal(_run(write_cycles(tmp_path, time, degrees, reading))).warnings)
    assert "degC only" in doubts
    assert "heating against cooling is hardly separable from a drift in time" in doubts
    assert "fz steps by" in doubts
    rise = thermal(_run(write_cycles(tmp_path, *record(np.random.default_rng(13), cycles=0.5))))
    doubts = " ".join(rise.warnings)
    assert "drift with temperature and drift in time are one" in doubts
    assert "no hysteresis is determined" in doubts
    assert rise.sensors[0].variable_table() is None
    assert '"drift_half_width_95_per_degC": null' in rise.json_text()


def test_raw_channels_have_a_row_each(tmp_path: Path) -> None:
    """A sensor with raw counts and a prior matrix drifts in counts as it does in newtons."""
    time, degrees, reading = record(np.random.default_rng(14))
    counts = 10.0 * reading  # N and N m per count
    write_cycles(tmp_path, time, degrees, counts)
    write_matrix_file(tmp_path / "prior.txt", encode_matrix(0.1 * np.eye(6)))
    text = TEXT.replace('quantity = "wrench"', 'quantity = "raw"').replace(
        '["N", "N", "N", "N m", "N m", "N m"]\nframe = "ft"',
        '["counts", "counts", "counts", "counts", "counts", "counts"]',
    )
    (tmp_path / "raw.toml").write_text(text.replace('prior = "identity"', 'prior = "prior.txt"'))
    (sensor,) = thermal(_run(tmp_path / "raw.toml")).sensors
    assert [(row.signal, row.unit) for row in sensor.channels] == [(f"ch{k}", "counts") for k in range(6)]
    for channel, component in zip(sensor.channels, sensor.components, strict=True):
        assert channel.drift_per_degC == pytest.approx(10.0 * component.drift_per_degC, rel=1e-3)


def test_a_calibration_that_knows_the_temperature_is_not_told_again(warm_log: Path) -> None:
    """Read by it the drift is what is left, which is nothing to take off once more."""
    run = interactive_experiment(with_variables(warm_log / PARQUET, TEMPERATURE))["arm_ft"]
    calibration = calibrate_sensor(run, code_version="1", created="now")
    assert [variable.name for variable in calibration.variables] == ["temperature"]
    (before,), (after,) = run.thermal().sensors, run.thermal(calibration).sensors
    assert (before.corrected, after.corrected, after.variable_table()) == (False, True, None)
    assert after.wrench_source == "calibration"


def test_the_script_of_its_page_runs(
    chamber: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It prints the table of the command."""
    (code,) = unmarked((Path(__file__).parents[3] / "docs" / "sensor" / "temperature.md").read_text(encoding="utf-8"))
    (chamber.parent / "cycles.toml").write_text(TEXT)
    monkeypatch.chdir(chamber.parent)
    exec(compile(code, "thermal.md", "exec"), {})
    assert "heating - cooling" in capsys.readouterr().out


def test_what_is_missing_is_said(arm: Path, chamber: Path) -> None:
    """A sensor without a thermometer, a variable and an interval that are not there."""
    with pytest.raises(ExperimentError, match=r"expected one \[\[sensor.variable\]\] in degC, got none"):
        thermal(_run(arm / PARQUET))
    with pytest.raises(ExperimentError, match="no variable 'room' in degC; known: temperature"):
        thermal(_run(chamber), variable="room")
    with pytest.raises(ExperimentError, match="no interval is labelled 'oven'; known: chamber"):
        thermal(_run(chamber), intervals=["oven"])
