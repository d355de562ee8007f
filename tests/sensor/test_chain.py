# SPDX-License-Identifier: BSD-3-Clause
"""From a load to counts and back through every part: element, gauges, bridges, amplifiers, converter, board."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.sensor.elastic_element import Beam, Bending, ElasticElement, GaugePlace, Material, RectangularSection
from forcetorque.sensor.electronics import QUARTER_BRIDGE, Y_ELEMENT, Adc, Bridge, hold_on_saturation
from forcetorque.sensor.full_scale import RawLimits, axis_resolution, reachable_full_scale
from forcetorque.sensor.gauges import ResistiveGauge

FULL_BRIDGE = Bridge(strain_shares=(1.0, -1.0, 1.0, -1.0), is_gauge=(True, True, True, True))
ELEMENT = ElasticElement(
    beam=Beam(
        length=0.012,
        section=RectangularSection(width=0.004, height=0.005),
        material=Material.from_poisson_ratio(200e9, 0.3),
    ),
    hub_radius=0.006,
    arm_angles=Y_ELEMENT.arm_angles,
    places=tuple(GaugePlace(arm=arm, position=0.001, bending=bending) for arm in range(3) for bending in Bending),
)
GAUGE = ResistiveGauge(gauge_factor=100.0, resistance=1000.0, temperature_coefficient=9e-4)
SUPPLY = 3.0
AMPLIFIER_GAIN, AMPLIFIER_OFFSET = 24.0, 0.05
ADC = Adc(bits=16, reference=2.5, signed=True)


def _counts(wrench: FloatArray, *, bridge: Bridge = FULL_BRIDGE, warming: float = 0.0) -> FloatArray:
    strain = wrench @ ELEMENT.strain_matrix().T
    volts = AMPLIFIER_GAIN * SUPPLY * bridge.ratio(GAUGE, strain, warming) + AMPLIFIER_OFFSET
    return np.clip(np.rint(volts / ADC.step), ADC.lowest, ADC.highest)


def _loads(count: int) -> FloatArray:
    rng = np.random.default_rng(1)
    return rng.uniform(-1, 1, size=(count, 6)) * [100, 100, 200, 2, 2, 2]


def _matrix() -> tuple[FloatArray, FloatArray]:
    """Matrix and offset by hand: a full bridge gives gauge factor times strain of the supply."""
    counts_per_strain = SUPPLY * GAUGE.gauge_factor * AMPLIFIER_GAIN / ADC.step
    matrix = np.linalg.inv(counts_per_strain * ELEMENT.strain_matrix())
    return matrix, -matrix @ np.full(6, AMPLIFIER_OFFSET / ADC.step)


def test_the_matrix_of_the_parts_tells_the_load() -> None:
    """What rounding to counts leaves is below half a count of every channel at once."""
    matrix, offset = _matrix()
    loads = _loads(500)
    error = _counts(loads) @ matrix.T + offset - loads
    assert (np.abs(error) <= 0.5 * axis_resolution(matrix) * (1 + 1e-9)).all()
    assert np.abs(_counts(loads)).max() > 1000  # the counts say something


def test_calibration_finds_that_matrix() -> None:
    """Least squares on loads and counts finds the matrix of the parts, to rounding over the spread of counts."""
    matrix, _ = _matrix()
    loads = _loads(500)
    design = np.column_stack([_counts(loads), np.ones(500)])
    fitted = np.linalg.lstsq(design, loads, rcond=None)[0][:6].T
    rounding_over_spread = 0.3 / _counts(loads).std()  # 1 / sqrt(12) of a count, before 500 samples average it
    rows = np.abs(matrix).max(axis=1, keepdims=True)  # each row in its own unit
    np.testing.assert_allclose(fitted / rows, matrix / rows, rtol=0, atol=rounding_over_spread)


def test_temperature_moves_a_quarter_bridge_only() -> None:
    """Ten degrees leave a full bridge of equal gauges where it was without load, and move a quarter bridge far."""
    rest = np.zeros((1, 6))
    full, quarter = (
        _counts(rest, bridge=b, warming=10.0) - _counts(rest, bridge=b) for b in (FULL_BRIDGE, QUARTER_BRIDGE)
    )
    np.testing.assert_array_equal(full, 0.0)
    assert np.abs(quarter).min() > 100


@pytest.mark.parametrize("axis", range(6))
def test_the_board_holds_where_the_reachable_scale_ends(axis: int) -> None:
    """A load that grows along an axis is streamed up to the reachable full scale, and held beyond it."""
    matrix, offset = _matrix()
    limits = RawLimits(
        matrix=matrix, offset=offset, lowest=np.full(6, float(ADC.lowest)), highest=np.full(6, float(ADC.highest))
    )
    largest = reachable_full_scale(limits).positive[axis]
    loads = np.outer([0.5, 0.999, 1.001, 1.5], largest * np.eye(6)[axis])
    held = hold_on_saturation(_counts(loads), lowest=ADC.lowest, highest=ADC.highest)
    np.testing.assert_array_equal(held.saturated, [False, False, True, True])
    np.testing.assert_array_equal(held.counts[3], held.counts[1])
