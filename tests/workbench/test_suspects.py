# SPDX-License-Identifier: BSD-3-Clause
"""Faults of a bench, by name: how often they are found, and how often where there are none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest

from forcetorque.base.errors import SensorError
from forcetorque.workbench.faults import FALSE_ALARMS, Fault, log_upper_tail, signatures, suspects
from forcetorque.workbench.fit import ResidualSpace, Scatter, own_scatter, scatter_of_sensors, stated_scatter
from forcetorque.workbench.loads import BenchLoads
from forcetorque.workbench.simulated_benches import BenchFaults, simulate_specimen
from tests.scenes.benches import PLACEMENT, thesis_loads
from tests.workbench.trials import TRIALS, alarm_share, examined, named_share, plainly_named_share, specimens

FEW = 12
"""Sensors of the quick tests."""
NAMED = 0.95
"""Share of sensors in which a plain fault is named."""
MANY = 200
FIRST_SEED, OTHER_SEED = 7100, 7200
"""Seeds that nothing was tuned on."""


@pytest.mark.parametrize("name", ["two rows swapped", "weight wrong by 5 %", "0.2 kg of structure forgotten"])
def test_plain_faults_are_named(name: str) -> None:
    """In nearly all of a few sensors; at most one is missed."""
    assert named_share(TRIALS[name], FEW, FIRST_SEED) >= 1.0 - 1.0 / FEW


def test_sound_sensors_are_let_pass() -> None:
    """Negative control: no fault, no name, but for one of a few."""
    assert alarm_share(FEW, FIRST_SEED) <= 1.0 / FEW


@pytest.mark.long
@pytest.mark.parametrize("name", ["two rows swapped", "weight wrong by 5 %", "row tilted by 2 deg"])
def test_plain_faults_are_named_in_nineteen_of_twenty(name: str) -> None:
    """Of 200 sensors with one fault each."""
    assert named_share(TRIALS[name], MANY, OTHER_SEED) >= NAMED


@pytest.mark.long
def test_false_alarms_are_as_rare_as_stated() -> None:
    """The rate that is stated lies within, or above, the interval of 200 sensors."""
    alarms = round(MANY * alarm_share(MANY, OTHER_SEED))
    assert binomtest(alarms, MANY).proportion_ci().low <= FALSE_ALARMS


@pytest.mark.long
def test_sensors_tell_the_scatter_where_nothing_is_stated() -> None:
    """Swaps in a fifth of 200 sensors, by the scatter of all; false alarms as stated."""
    among = MANY - MANY // 5
    assert named_share(TRIALS["two rows swapped"], MANY // 5, OTHER_SEED, among=among) >= NAMED
    alarms = round(MANY * alarm_share(MANY, OTHER_SEED, together=True))
    assert binomtest(alarms, MANY).proportion_ci().low <= FALSE_ALARMS


@pytest.mark.long
def test_the_plain_residual_names_fewer_swaps() -> None:
    """A least-squares fit follows the fault."""
    assert plainly_named_share(MANY, OTHER_SEED) < named_share(TRIALS["two rows swapped"], MANY, OTHER_SEED)


def test_two_faults_are_named_one_after_the_other() -> None:
    """Each beside the other, whichever is plainer."""
    faults = BenchFaults(swapped=(2, 20), no_structure=(14,))
    specimen = simulate_specimen(thesis_loads(), PLACEMENT, np.random.default_rng(9), faults=faults)
    (one,) = examined([specimen])
    assert {(suspect.fault, frozenset(suspect.positions)) for suspect in one.suspects} == {
        (Fault.SWAPPED, frozenset({2, 20})),
        (Fault.WEIGHT, frozenset({14})),
    }
    assert [suspect.structure_forgotten for suspect in one.suspects if suspect.fault is Fault.WEIGHT] == [True]


def test_a_component_of_stated_wrenches_is_named() -> None:
    """Two rows swapped in one component, and one component of another row."""
    rng = np.random.default_rng(3)
    loads = BenchLoads(
        names=tuple(str(k) for k in range(40)),
        wrench=rng.uniform(-10.0, 10.0, (40, 6)),
        series=("all",) * 40,
    )
    read = loads.wrench + 0.02 * rng.standard_normal((40, 6))
    stated = loads.wrench.copy()
    stated[[4, 9], 1] = stated[[9, 4], 1]
    stated[20, 5] += 1.0
    wrong = replace(loads, wrench=stated)
    named = suspects(wrong, read - stated, own_scatter(stated, read - stated))
    assert {(one.fault, one.positions, one.component) for one in named} == {
        (Fault.SWAPPED, (4, 9), 1),
        (Fault.COMPONENT, (20,), 5),
    }


def test_the_plate_needs_its_own_hypothesis() -> None:
    """By one degree it is named; without the hypothesis others are named in its place."""
    specimen = simulate_specimen(
        thesis_loads(), PLACEMENT, np.random.default_rng(12), faults=BenchFaults(plate_rad=np.deg2rad(1.0))
    )
    (one,) = examined([specimen])
    assert [suspect.fault for suspect in one.suspects] == [Fault.PLATE_TILTED]
    scatter = stated_scatter(specimen.bench, np.linalg.inv(specimen.response), PLACEMENT)
    others = [fault for fault in Fault if fault is not Fault.PLATE_TILTED]
    assert Fault.PLATE_TILTED not in {
        suspect.fault for suspect in suspects(one.bench.loads, one.error, scatter, kinds=others)
    }


def test_signatures_are_what_faults_do() -> None:
    """Derivatives of the geometry by finite differences; a swap exchanges."""
    loads = thesis_loads()
    assert loads.weights is not None
    checked = set()
    for every in signatures(loads):
        if every.fault is Fault.SWAPPED:
            (place,) = np.flatnonzero((every.positions == (1, 12)).all(axis=1))
            first, second = every.change[place, :, :, 0]
            np.testing.assert_allclose(loads.wrench[1] + first, loads.wrench[12])
            np.testing.assert_allclose(loads.wrench[12] + second, loads.wrench[1])
        elif every.fault is Fault.TILTED:
            turn = 1e-6 * np.array([0.3, -0.5, 0.8])
            weights = loads.weights
            force = weights.gravity * weights.total_kg[6] * (weights.direction + np.cross(turn, weights.direction))[6]
            moved = np.concatenate([force, np.cross(weights.position_m[6], force)])
            np.testing.assert_allclose(every.change[6, 0] @ turn, moved - loads.wrench[6], atol=1e-12)
        elif every.fault is Fault.DISPLACED:
            step = np.array([1e-3, 2e-3, -1e-3])
            moment = np.cross(step, loads.wrench[13, :3])
            np.testing.assert_allclose((every.change[13, 0] @ step)[3:], moment, atol=1e-12)
        checked.add(every.fault)
    assert checked == set(Fault) - {Fault.COMPONENT}


def test_the_residual_space_holds_what_no_line_explains() -> None:
    """Readings that are a line of the loads leave nothing; distances are chi-squared of six."""
    loads, rng = thesis_loads().wrench, np.random.default_rng(5)
    scatter = np.tile(np.diag([0.1, 0.2, 0.1, 0.01, 0.02, 0.01]) ** 2, (24, 1, 1))
    space = ResidualSpace.of(loads, scatter)
    line = loads @ (0.1 * rng.standard_normal((6, 6))).T + rng.standard_normal(6)
    assert np.abs(space.weighed(line[None])).max() < 1e-6 * np.abs(line).max() / 0.01**2
    noise = rng.standard_normal((400, 24, 6)) * np.sqrt(np.einsum("pii->pi", scatter))
    distances = space.distances(space.weighed(noise))
    assert np.mean(distances) == pytest.approx(6.0, rel=0.03)  # 9600 values, of which some are of lower rank
    with pytest.raises(SensorError, match="expected covariances"):
        ResidualSpace.of(loads, -scatter)


def test_many_sensors_tell_the_scatter_of_positions() -> None:
    """Within a quarter of the truth; a fault in one sensor of twenty does not make it tenfold; too few are refused."""
    rng, loads = np.random.default_rng(8), thesis_loads().wrench
    sizes = np.where(np.arange(24)[:, None] < 18, 0.05, 0.2) * np.array([1.0, 1.0, 1.0, 0.02, 0.02, 0.02])
    residuals = rng.standard_normal((150, 24, 6)) * sizes
    shape = np.tile(np.diag([1.0, 1.0, 1.0, 0.02, 0.02, 0.02]) ** 2, (24, 1, 1))
    told = np.sqrt(np.einsum("pii->pi", scatter_of_sensors(loads, residuals, shape).covariance)) / sizes
    assert np.median(told) == pytest.approx(1.0, abs=0.25)
    residuals[:8, 3] += [5.0, 5.0, 5.0, 0.1, 0.1, 0.1]  # a hundred times the scatter
    beside = np.sqrt(np.einsum("pii->pi", scatter_of_sensors(loads, residuals, shape).covariance)) / sizes
    assert np.median(beside) < 1.5 * np.median(told)
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
    """Negative control: with a tenth of the true scatter sound sensors are suspected."""
    drawn, _ = specimens(4, OTHER_SEED)
    bench = drawn[0].bench
    (one,) = examined([drawn[0]])
    scatter = stated_scatter(bench, np.linalg.inv(drawn[0].response), PLACEMENT)
    small = Scatter(covariance=0.01 * scatter.covariance, degrees_of_freedom=np.inf, source="too small")
    assert one.suspects == ()
    assert suspects(bench.loads, one.error, small)
