# SPDX-License-Identifier: BSD-3-Clause
"""Faults of a bench, by name: rates of detection, and of false alarms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest

from forcetorque.base.errors import SensorError
from forcetorque.workbench.faults import FALSE_ALARMS, Fault, detect_faults, log_upper_tail, signatures
from forcetorque.workbench.known_loads import BenchLoads
from forcetorque.workbench.matrix_fit import (
    ResidualSpace,
    Scatter,
    residual_scatter,
    scatter_of_sensors,
    specified_scatter,
)
from forcetorque.workbench.simulated_benches import BenchFaults, simulate_bench
from tests.cases import some_cases
from tests.scenes.benches import PLACEMENT, thesis_loads
from tests.workbench.trials import (
    TRIALS,
    alarm_share,
    named_share,
    plainly_named_share,
    searches_by_placement,
    simulated_benches,
)

FEW = 12
"""Sensors of the quick tests."""
NAMED = 0.95
"""Share of sensors in which a plain fault is detected."""
MANY = 200
FIRST_SEED, OTHER_SEED = 7100, 7200
"""Seeds that nothing was tuned on."""


@some_cases("name", ["two rows swapped", "weight wrong by 5 %", "0.2 kg of structure forgotten"])
def test_plain_faults_are_detected(name: str) -> None:
    """In nearly all of a few sensors; at most one is missed."""
    assert named_share(TRIALS[name], FEW, FIRST_SEED) >= 1.0 - 1.0 / FEW


def test_undamaged_sensors_have_no_faults() -> None:
    """Negative control: at most one alarm among a few sensors."""
    assert alarm_share(FEW, FIRST_SEED) <= 1.0 / FEW


@pytest.mark.long
@pytest.mark.parametrize("name", ["two rows swapped", "weight wrong by 5 %", "row tilted by 2 deg"])
def test_plain_faults_are_detected_in_nineteen_of_twenty(name: str) -> None:
    """Of 200 sensors with one fault each."""
    assert named_share(TRIALS[name], MANY, OTHER_SEED) >= NAMED


@pytest.mark.long
def test_false_alarms_are_as_rare_as_specified() -> None:
    """The rate that is specified lies within, or above, the interval of 200 sensors."""
    alarms = round(MANY * alarm_share(MANY, OTHER_SEED))
    assert binomtest(alarms, MANY).proportion_ci().low <= FALSE_ALARMS


@pytest.mark.long
def test_sensors_determine_the_scatter_without_a_placement() -> None:
    """Swaps in a fifth of 200 sensors, by the scatter of all; false alarms as specified."""
    among = MANY - MANY // 5
    assert named_share(TRIALS["two rows swapped"], MANY // 5, OTHER_SEED, among=among) >= NAMED
    alarms = round(MANY * alarm_share(MANY, OTHER_SEED, together=True))
    assert binomtest(alarms, MANY).proportion_ci().low <= FALSE_ALARMS


@pytest.mark.long
def test_the_plain_residual_finds_fewer_swaps() -> None:
    """A least-squares fit follows the fault."""
    assert plainly_named_share(MANY, OTHER_SEED) < named_share(TRIALS["two rows swapped"], MANY, OTHER_SEED)


def test_two_faults_are_detected_one_after_the_other() -> None:
    """Both, in the order of their significance."""
    faults = BenchFaults(swapped=(2, 20), no_structure=(14,))
    simulated = simulate_bench(thesis_loads(), PLACEMENT, np.random.default_rng(9), faults=faults)
    (search,) = searches_by_placement([simulated])
    assert {(fault.fault, frozenset(fault.positions)) for fault in search.detected} == {
        (Fault.SWAPPED, frozenset({2, 20})),
        (Fault.WEIGHT, frozenset({14})),
    }
    assert [fault.structure_forgotten for fault in search.detected if fault.fault is Fault.WEIGHT] == [True]


def test_a_component_of_specified_wrenches_is_detected() -> None:
    """Two rows swapped in one component, and one component of another row."""
    rng = np.random.default_rng(3)
    loads = BenchLoads(
        names=tuple(str(k) for k in range(40)),
        wrench=rng.uniform(-10.0, 10.0, (40, 6)),
        series=("all",) * 40,
    )
    measured = loads.wrench + 0.02 * rng.standard_normal((40, 6))
    specified = loads.wrench.copy()
    specified[[4, 9], 1] = specified[[9, 4], 1]
    specified[20, 5] += 1.0
    wrong = replace(loads, wrench=specified)
    detected = detect_faults(wrong, measured - specified, residual_scatter(specified, measured - specified))
    assert {(fault.fault, fault.positions, fault.component) for fault in detected} == {
        (Fault.SWAPPED, (4, 9), 1),
        (Fault.COMPONENT, (20,), 5),
    }


def test_the_plate_needs_its_own_hypothesis() -> None:
    """One degree is detected; without the hypothesis other faults are detected in its place."""
    simulated = simulate_bench(
        thesis_loads(), PLACEMENT, np.random.default_rng(12), faults=BenchFaults(plate_rad=np.deg2rad(1.0))
    )
    (search,) = searches_by_placement([simulated])
    assert [fault.fault for fault in search.detected] == [Fault.PLATE_TILTED]
    scatter = specified_scatter(simulated.bench, np.linalg.inv(simulated.response), PLACEMENT)
    others = [fault for fault in Fault if fault is not Fault.PLATE_TILTED]
    assert Fault.PLATE_TILTED not in {
        fault.fault for fault in detect_faults(search.bench.loads, search.error, scatter, kinds=others)
    }


def test_signatures_are_what_faults_do() -> None:
    """Derivatives of the geometry by finite differences; a swap exchanges."""
    loads = thesis_loads()
    assert loads.weights is not None
    checked = set()
    for kind in signatures(loads):
        if kind.fault is Fault.SWAPPED:
            (index,) = np.flatnonzero((kind.positions == (1, 12)).all(axis=1))
            first, second = kind.change[index, :, :, 0]
            np.testing.assert_allclose(loads.wrench[1] + first, loads.wrench[12])
            np.testing.assert_allclose(loads.wrench[12] + second, loads.wrench[1])
        elif kind.fault is Fault.TILTED:
            turn = 1e-6 * np.array([0.3, -0.5, 0.8])
            weights = loads.weights
            force = weights.gravity * weights.total_kg[6] * (weights.direction + np.cross(turn, weights.direction))[6]
            moved = np.concatenate([force, np.cross(weights.position_m[6], force)])
            np.testing.assert_allclose(kind.change[6, 0] @ turn, moved - loads.wrench[6], atol=1e-12)
        elif kind.fault is Fault.DISPLACED:
            step = np.array([1e-3, 2e-3, -1e-3])
            moment = np.cross(step, loads.wrench[13, :3])
            np.testing.assert_allclose((kind.change[13, 0] @ step)[3:], moment, atol=1e-12)
        checked.add(kind.fault)
    assert checked == set(Fault) - {Fault.COMPONENT}


def test_the_residual_space_removes_a_linear_fit() -> None:
    """Measurements that are linear in the loads leave no residual; distances are chi-squared of six."""
    loads, rng = thesis_loads().wrench, np.random.default_rng(5)
    scatter = np.tile(np.diag([0.1, 0.2, 0.1, 0.01, 0.02, 0.01]) ** 2, (24, 1, 1))
    space = ResidualSpace.of(loads, scatter)
    line = loads @ (0.1 * rng.standard_normal((6, 6))).T + rng.standard_normal(6)
    assert np.abs(space.weighted(line[None])).max() < 1e-6 * np.abs(line).max() / 0.01**2
    noise = rng.standard_normal((400, 24, 6)) * np.sqrt(np.einsum("pii->pi", scatter))
    distances = space.distances(space.weighted(noise))
    assert np.mean(distances) == pytest.approx(6.0, rel=0.03)  # 9600 values, of which some are of lower rank
    with pytest.raises(SensorError, match="expected covariances"):
        ResidualSpace.of(loads, -scatter)


def test_many_sensors_determine_the_scatter_of_positions() -> None:
    """Within a quarter of the truth; a fault in one sensor of twenty does not make it tenfold; too few are refused."""
    rng, loads = np.random.default_rng(8), thesis_loads().wrench
    sizes = np.where(np.arange(24)[:, None] < 18, 0.05, 0.2) * np.array([1.0, 1.0, 1.0, 0.02, 0.02, 0.02])
    residuals = rng.standard_normal((150, 24, 6)) * sizes
    shape = np.tile(np.diag([1.0, 1.0, 1.0, 0.02, 0.02, 0.02]) ** 2, (24, 1, 1))
    ratio = np.sqrt(np.einsum("pii->pi", scatter_of_sensors(loads, residuals, shape).covariance)) / sizes
    assert np.median(ratio) == pytest.approx(1.0, abs=0.25)
    residuals[:8, 3] += [5.0, 5.0, 5.0, 0.1, 0.1, 0.1]  # a hundred times the scatter
    with_fault = np.sqrt(np.einsum("pii->pi", scatter_of_sensors(loads, residuals, shape).covariance)) / sizes
    assert np.median(with_fault) < 1.5 * np.median(ratio)
    with pytest.raises(SensorError, match="at least 30 sensors, got 4"):
        scatter_of_sensors(loads, residuals[:4], shape)


def test_tails_are_those_of_chi_squared_and_of_f() -> None:
    """Far beyond where floats end, too, and with it in order."""
    from scipy.stats import chi2, f

    explained, amounts = np.array([[1.0, 20.0, 900.0, 1400.0]]), np.array([1, 2, 6, 1])
    tail = log_upper_tail(explained, amounts, np.inf)
    np.testing.assert_allclose(tail, chi2.logsf(explained, amounts), rtol=2e-3)
    assert (np.diff(log_upper_tail(np.array([[1e3, 2e3, 4e3, 8e3]]), np.full(4, 2), np.inf)) < 0.0).all()
    farther = log_upper_tail(np.array([[3e3, 1e4, 1e5, 1e6]]), np.full(4, 1), 1200.0)
    assert (np.diff(farther) < -10.0).all()
    assert farther[0, 0] < -700.0
    np.testing.assert_allclose(
        log_upper_tail(explained, amounts, 20.0), f.logsf(explained / amounts, amounts, 20.0), rtol=1e-6
    )


def test_a_scatter_that_is_too_small_is_noticed() -> None:
    """Negative control: with a tenth of the true scatter undamaged sensors have faults."""
    drawn, _ = simulated_benches(4, OTHER_SEED)
    bench = drawn[0].bench
    (search,) = searches_by_placement([drawn[0]])
    scatter = specified_scatter(bench, np.linalg.inv(drawn[0].response), PLACEMENT)
    small = Scatter(covariance=0.01 * scatter.covariance, degrees_of_freedom=np.inf, source="too small")
    assert search.detected == ()
    assert detect_faults(bench.loads, search.error, small)
