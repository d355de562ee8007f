# SPDX-License-Identifier: BSD-3-Clause
"""Principles on one element: closed forms against simulated readings, by hand, and what they cannot read."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.sensor.choice.principles import (
    PrincipleSensor,
    Stimulus,
    compare_principles,
    principle_sensors,
    resonance_hz,
    stimulus_matrix,
)
from forcetorque.sensor.electronics import Y_ELEMENT

SENSORS = {sensor.channel.principle: sensor for sensor in principle_sensors()}
LOAD = np.array([40.0, -30.0, 300.0, 4.0, 2.0, -3.0])
SAMPLES = 20_000


@pytest.mark.parametrize("name", SENSORS)
def test_small_loads_are_read_as_they_are(name: str) -> None:
    """Each principle is read by its own slopes: a thousandth of the load within a thousandth of itself."""
    sensor = SENSORS[name]
    small = 1e-3 * LOAD
    assert sensor.read(small[None], 0.0)[0] == pytest.approx(small, rel=1e-3)
    # negative control: read by the slopes of a channel of twice the sensitivity
    doubled = replace(sensor, sensed=2.0 * sensor.sensed)
    assert (doubled.matrix @ sensor.sensed * sensor.channel.slope() @ small) == pytest.approx(0.5 * small, rel=1e-3)


@pytest.mark.parametrize("name", [name for name, sensor in SENSORS.items() if sensor.channel.noise is not None])
def test_noise_is_that_of_simulated_samples(name: str) -> None:
    """Standard deviation of 20000 samples: relative error 1 / sqrt(2 n) = 0.5 %; 2.5 % is five of these."""
    sensor = SENSORS[name]
    reading = sensor.read(np.zeros((SAMPLES, 6)), 0.0, rng=np.random.default_rng(3))
    assert reading.std(axis=0) == pytest.approx(sensor.noise(), rel=5.0 / math.sqrt(2.0 * SAMPLES))


@pytest.mark.parametrize("name", [name for name, sensor in SENSORS.items() if sensor.channel.temperature_known])
def test_zero_drift_is_what_a_warm_sensor_reads_without_load(name: str) -> None:
    """At a hundredth of a degree, within the curvature of the channel."""
    sensor = SENSORS[name]
    drift = sensor.zero_drift()
    assert drift is not None
    assert 100.0 * sensor.read(np.zeros((1, 6)), 0.01)[0] == pytest.approx(drift, rel=2e-3, abs=1e-4)


def test_a_half_bridge_has_no_zero_drift_and_a_quarter_bridge_has() -> None:
    """The quarter bridge reads one degree as a strain of TCR over gauge factor on every channel, by hand."""
    half, quarter = SENSORS["silicon gauges, half bridge"], SENSORS["silicon gauge, quarter bridge"]
    assert half.zero_drift() == pytest.approx(np.zeros(6), abs=1e-9)
    strain = 90000e-6 / 130.0
    assert quarter.zero_drift() == pytest.approx(
        np.linalg.solve(quarter.sensed, np.full(6, strain)), rel=1e-6, abs=1e-6
    )
    # the linear gauge (1.9), (1.10) has no term of strain times temperature, which its gain would drift by
    assert half.gain_per_degC(LOAD) is quarter.gain_per_degC(LOAD) is None
    warm, zero = half.read(np.stack([LOAD, 0.0 * LOAD]), 1.0)
    assert warm - zero == pytest.approx(half.read(LOAD[None], 0.0)[0])


def test_noise_of_gauges_by_hand() -> None:
    """Johnson noise of 200 ohm in 500 Hz and rounding of 16 bits, over 2.5 V times 130 / 2 of a half bridge."""
    sensor = SENSORS["silicon gauges, half bridge"]
    volts = math.hypot(math.sqrt(4 * 1.380649e-23 * 293.15 * 200 * 500), 2 * 1.65 / 2**16 / 113 / math.sqrt(12))
    expected = volts / (2.5 * 130 / 2) * np.linalg.norm(np.linalg.inv(sensor.sensed), axis=1)
    assert sensor.noise() == pytest.approx(expected, rel=1e-6)


def test_a_crystal_loses_a_constant_load_and_a_gauge_does_not() -> None:
    """After the time constant of 100 s it reads 1 / e of a step, exactly; a gauge all of it."""
    loads = np.concatenate([np.zeros((1, 6)), np.tile(LOAD, (1000, 1))])
    crystal = SENSORS["piezoelectric"].read(loads, 0.0, rate_hz=10.0)
    # the load begins linearly within the first step, so its charge is that of a step in the middle of it
    assert crystal[-1] / LOAD == pytest.approx(np.full(6, math.exp(-(100.0 - 0.05) / 100.0)), rel=1e-6)
    gauge = SENSORS["foil gauges, half bridge"].read(loads, 0.0, rate_hz=10.0)
    assert gauge[-1] == pytest.approx(LOAD, rel=1e-6)
    rows, _ = compare_principles(LOAD)
    (lost,) = (row.lost_percent_per_minute for row in rows if row.principle == "piezoelectric")
    assert lost == pytest.approx(100.0 * (1.0 - math.exp(-0.6)))
    assert sum(row.lost_percent_per_minute == 0.0 for row in rows) == len(rows) - 1


def test_forces_of_arms_balance_the_load_along_z() -> None:
    """The channels out of the plane sense what the hub exerts on each arm: together the force along z."""
    force = stimulus_matrix(Y_ELEMENT, Stimulus.FORCE)
    assert force[1::2].sum(axis=0) == pytest.approx([0, 0, 1, 0, 0, 0], abs=1e-12)
    moved = stimulus_matrix(Y_ELEMENT, Stimulus.DEFLECTION)
    assert moved[1::2, 2] == pytest.approx(np.full(3, 1.0 / Y_ELEMENT.stiffness()[2, 2]), rel=1e-9)


def test_resonance_of_a_mass_on_a_spring() -> None:
    """The softest direction of the element; four times the mass has half the frequency."""
    compliance = np.linalg.inv(Y_ELEMENT.stiffness())
    softest = max(compliance[0, 0], compliance[1, 1], compliance[2, 2])
    assert resonance_hz(Y_ELEMENT, 1.0) == pytest.approx(math.sqrt(1.0 / softest) / (2 * math.pi), rel=1e-6)
    assert resonance_hz(Y_ELEMENT, 4.0) == pytest.approx(0.5 * resonance_hz(Y_ELEMENT, 1.0))


def test_a_load_that_closes_the_gap_has_no_reading() -> None:
    """50 um of gap over 0.27 nm/N: a million newtons along -z; the other numbers remain."""
    rows, curves = compare_principles(np.array([0.0, 0.0, -1e6, 0.0, 0.0, 0.0]))
    row = next(row for row in rows if row.principle == "capacitive")
    assert row.nonlinearity_percent is None
    assert row.noise_N is not None
    assert "capacitive" not in {curve.principle for curve in curves}
    assert "piezoelectric" in {curve.principle for curve in curves}


def test_a_load_that_saturates_the_converter_has_no_reading() -> None:
    """By hand: half of 16 bits in 3.3 V over a gain of 113 is 14.6 mV, 2.5 V times 130 / 2 a strain of 90e-6."""
    strain = 1.65 * (1.0 - 2.0**-15) / 113 / (2.5 * 130 / 2)
    sensor = SENSORS["silicon gauges, half bridge"]
    along_z = float(np.abs(sensor.sensed[:, 2]).max())
    (within, beyond) = (np.array([[0.0, 0.0, share * strain / along_z, 0.0, 0.0, 0.0]]) for share in (0.999, 1.001))
    assert sensor.read(within, 0.0)[0] == pytest.approx(within[0], rel=1e-6, abs=1e-6)
    with pytest.raises(SensorError, match="half bridge: expected bridge voltages from -0.0146 to 0.0146 V"):
        sensor.read(beyond, 0.0)
    rows = {row.principle: row for row in compare_principles(np.array([0.0, 0.0, 20000.0, 0.0, 0.0, 0.0]))[0]}
    assert rows["silicon gauges, half bridge"].nonlinearity_percent is None
    assert rows["foil gauges, half bridge"].nonlinearity_percent is None
    assert rows["piezoelectric"].nonlinearity_percent is not None


def test_unknown_numbers_are_empty() -> None:
    """Noise of an interrogator, drift of a light source: the model has none, and invents none."""
    rows = {row.principle: row for row in compare_principles(LOAD)[0]}
    assert rows["optical, Bragg grating"].noise_N is None
    assert rows["optical, reflected light"].temperature_force_N_per_degC is None
    assert rows["piezoelectric"].gain_percent_per_degC is None
    assert isinstance(SENSORS["capacitive"], PrincipleSensor)


def test_the_table_of_the_page_is_computed() -> None:
    """`docs/sensor/choice.md` has the numbers of 500 N at 10 mm."""
    page = (Path(__file__).parents[3] / "docs/sensor/choice.md").read_text(encoding="utf-8")
    rows, _ = compare_principles(np.array([0.0, 0.0, 500.0, 5.0, 0.0, 0.0]))
    for row in rows:
        cells = (
            _cell(row.noise_N, 4),
            _cell(row.temperature_force_N_per_degC, 2),
            _cell(row.gain_percent_per_degC, 2),
            _cell(row.nonlinearity_percent, 2),
            _cell(row.lost_percent_per_minute, 1),
        )
        assert f"| {row.principle} | {' | '.join(cells)} |" in page
    assert len(rows) == 7


def _cell(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f}".replace("-0.00", "0.00")
