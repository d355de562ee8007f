# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios in memory: other sensors under the same loads, linear ones, and ones whose workbench error is set."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RobotError
from forcetorque.base.toml_file import read_toml
from forcetorque.recording.recording import Use
from forcetorque.simulation.scenario.scenario import (
    INTERVAL_MARGIN_S,
    Scenario,
    build_scenario,
    load_scenario,
    simulate,
    trace_recordings,
)
from forcetorque.simulation.scenario.scenario_file import LINEAR_ONLY, ScenarioFile, bundled_scenario
from forcetorque.simulation.sensor_family import mounted_with_error, workbench_errors

LEG = "l_leg_ft"
WANTED = np.array([8.90, 11.18, 4.00, 0.790, 0.715, 0.277])
"""Workbench column of thesis Table 5.7; N, N m."""
FORCE_NORM_N = (14.0, 20.0)
"""Range of the mean force norm of a study that starts from 16.7 N (thesis Table 5.5)."""
SEEDS = range(1, 21)
EVERY_TENTH = 0.005
"""The error is set on every tenth sample; means over all of them differ by up to 0.3 %."""
EXACT = 1e-9
"""Rounding of matrices whose condition is about 100."""

ARM = ScenarioFile.model_validate(
    {
        "schema": "forcetorque/scenario/1",
        "name": "arm",
        "seed": 5,
        "robot": {"model": ("arm",)},
        "sensors": {"drift_counts_per_degC": 12.0, "mounting_sd": 0.05, "noise_counts": 3.0},
        "recording": [
            {
                "name": name,
                "motion": {"kind": "random", "duration_s": 40.0, "slowest_hz": 0.3, "speed": 2.0},
                "temperature_degC": (start, start + 4.0),
                "use": use,
            }
            for name, start, use in (("fit", 25.0, "calibration"), ("judge", 30.0, "validation"))
        ],
    }
)


@cache
def insitu() -> Scenario:
    """The bundled scenario with the sensor of the left leg alone, its validation recordings only."""
    content = read_toml(bundled_scenario("icub-insitu"), ScenarioFile, what="a scenario")
    judged = tuple(entry for entry in content.recording if entry.use is Use.VALIDATION)
    assert len(judged) == 5
    return build_scenario(content.model_copy(update={"recording": judged}).with_sensors(names=(LEG,)))


def _judged(error: FloatArray) -> FloatArray:
    """Errors at 100 Hz over the interval of a recording, with the offset of its first second."""
    margin = round(100 * INTERVAL_MARGIN_S)
    inside = error[margin:-margin]
    return inside - inside[:100].mean(axis=0)


def _errors(scenario: Scenario, loads: list[FloatArray]) -> FloatArray:
    """What the workbench matrix makes of the counts of perfect channels, by way of those counts."""
    specimen = scenario.specimens[LEG]
    parts = []
    for load in loads:
        counts = np.linalg.solve(specimen.sensor.matrix, load.T).T
        parts.append(_judged(counts @ specimen.workbench.T - load))
    return np.concatenate(parts)


@pytest.mark.long
def test_the_workbench_error_is_that_of_the_thesis_whatever_the_draw() -> None:
    """For 20 sensors each axis errs as set and the force norm lies in the range; as drawn some norms do not."""
    scenario = insitu()
    loads = [trace.loads[LEG] for trace in trace_recordings(scenario).values()]
    norms, drawn = [], []
    for seed in SEEDS:
        errors = _errors(scenario.with_sensors(seed=seed), loads)
        np.testing.assert_allclose(np.abs(errors).mean(axis=0), WANTED, rtol=EVERY_TENTH)
        norms.append(np.linalg.norm(errors[:, :3], axis=1).mean())
        without = _errors(scenario.with_sensors(seed=seed, workbench_error=None), loads)
        drawn.append(np.linalg.norm(without[:, :3], axis=1).mean())
    assert len(norms) == 20
    assert FORCE_NORM_N[0] < min(norms) < max(norms) < FORCE_NORM_N[1]
    assert min(drawn) < FORCE_NORM_N[0]
    assert max(drawn) > FORCE_NORM_N[1]


def test_recordings_show_the_error_that_was_set() -> None:
    """Recorded counts through the workbench matrix err as set, noise and drift within a recording included."""
    scenario = insitu().with_sensors(**LINEAR_ONLY)
    traces = trace_recordings(scenario)
    parts = []
    for made in simulate(scenario, traces):
        raw = made.recording.stream(LEG).signal("raw").values
        parts.append(_judged(raw @ scenario.specimens[LEG].workbench.T - traces[made.name].loads[LEG]))
    assert len(parts) == 5
    np.testing.assert_allclose(np.abs(np.concatenate(parts)).mean(axis=0), WANTED, rtol=2 * EVERY_TENTH)


@pytest.mark.long
def test_only_the_mounted_matrix_of_the_named_sensor_changes() -> None:
    """Workbench matrices, offsets and drifts in counts, and other sensors are as they are drawn without the table."""
    fixed = load_scenario(bundled_scenario("icub-insitu"))
    drawn = fixed.with_sensors(workbench_error=None)
    assert list(fixed.specimens) == list(drawn.specimens)
    changed = []
    for name, specimen in fixed.specimens.items():
        other = drawn.specimens[name]
        np.testing.assert_array_equal(specimen.workbench, other.workbench)
        counts, others = (np.linalg.solve(s.sensor.matrix, s.sensor.offset) for s in (specimen, other))
        np.testing.assert_allclose(counts, others, rtol=EXACT)
        assert specimen.sensor.drift is not None
        assert other.sensor.drift is not None
        np.testing.assert_array_equal(specimen.sensor.drift.slope, other.sensor.drift.slope)
        if not np.array_equal(specimen.sensor.matrix, other.sensor.matrix):
            changed.append(name)
    assert changed == [LEG]


def test_rows_of_the_error_are_scaled_by_hand() -> None:
    """A sensor that reads a tenth too much, asked for 5 N and 0.5 N m, then reads half too much, zero where zero."""
    workbench = np.diag([0.01, 0.02, 0.03, 0.001, 0.002, 0.003])
    loads = [np.outer([1.0, -1.0], [10.0, 10, 10, 1, 1, 1]), np.zeros((3, 6))]  # a load at rest is all offset
    moving = np.array([2 / 5] * 6)
    found = mounted_with_error(workbench, workbench / 1.1, loads, mean_absolute=moving * [5.0, 0.0, 5.0, 0.5, 0.5, 0.0])
    np.testing.assert_allclose(found, workbench / np.array([1.5, 1.0, 1.5, 1.5, 1.5, 1.0])[:, None], atol=EXACT)
    errors = np.abs(workbench_errors(workbench, found, loads)).mean(axis=0)
    np.testing.assert_allclose(errors, moving * [5.0, 0.0, 5.0, 0.5, 0.5, 0.0], atol=EXACT)


def test_errors_that_no_mounting_makes_are_refused() -> None:
    """A perfect mounting has nothing to scale; one that reads too little cannot turn the sign."""
    workbench, loads = np.eye(6), [np.outer([1.0, -1.0], np.ones(6))]
    with pytest.raises(FormatError, match="expected an error of 1 N in fx, but mounting as drawn gives none"):
        mounted_with_error(workbench, workbench, loads, mean_absolute=np.ones(6))
    nearly = mounted_with_error(workbench, 1.25 * workbench, loads, mean_absolute=np.full(6, 0.9))
    np.testing.assert_allclose(nearly, 10.0 * workbench, rtol=EXACT)
    with pytest.raises(FormatError, match="read with the wrong sign; ask for less"):
        mounted_with_error(workbench, 1.25 * workbench, loads, mean_absolute=np.ones(6))


def _left(scenario: Scenario) -> tuple[float, int]:
    """RMS of the residual of a linear fit in the force, over what noise leaves, and the number of held samples."""
    traces = trace_recordings(scenario)
    raw, temperature, load = [], [], []
    for made in simulate(scenario, traces):
        stream = made.recording.stream("arm_ft")
        raw.append(stream.signal("raw").values[~stream.held])
        temperature.append(stream.signal("temperature").values[~stream.held])
        load.append(traces[made.name].loads["arm_ft"][~stream.held])
    held = sum(len(trace.loads["arm_ft"]) for trace in traces.values()) - sum(map(len, raw))
    reading = np.hstack([np.concatenate(raw), np.concatenate(temperature)])
    design, wanted = np.column_stack([reading, np.ones(len(reading))]), np.concatenate(load)
    residual = (wanted - design @ np.linalg.lstsq(design, wanted, rcond=None)[0])[:, :3]
    matrix, noise = scenario.specimens["arm_ft"].sensor.matrix[:3], scenario.file.sensors.noise_counts
    rounding = 1.0 / 12.0  # of counts to whole ones
    floor = np.sqrt((noise**2 + rounding) * (matrix**2).sum())
    return float(np.sqrt((residual**2).sum(axis=1).mean()) / floor), held


@pytest.mark.long
def test_a_linear_fit_of_linear_sensors_leaves_only_noise() -> None:
    """With every other effect on it leaves much more; the changes take all of them out, and nothing else."""
    spoilt = {"limit_counts": 9000, "gradient_counts_per_degC": 10.0, "hysteresis_counts_per_degC": 10.0}
    spoilt |= {"creep_share": 0.02, "creep_time_s": 5.0, "crosstalk_counts": 300.0}
    assert set(LINEAR_ONLY) < {*spoilt}
    real = build_scenario(ARM.with_sensors(**spoilt))
    linear = real.with_sensors(**LINEAR_ONLY)
    ratio, held = _left(linear)
    assert ratio == pytest.approx(1.0, abs=0.03)  # of 24000 residuals, and the errors-in-variables of a fit to counts
    assert held == 0
    for name in LINEAR_ONLY:
        # cross-talk is relative to the full scale, which a limit out of reach would put out of reach too
        ratio, held = _left(linear.with_sensors(**{"limit_counts": 32767, name: spoilt[name]}))
        assert held > 0 if name == "limit_counts" else ratio > 1.1, name
    first, second = real.specimens["arm_ft"], linear.specimens["arm_ft"]
    np.testing.assert_array_equal(first.sensor.matrix, second.sensor.matrix)
    np.testing.assert_array_equal(first.sensor.offset, second.sensor.offset)


def _raw(scenario: Scenario, *args: object) -> list[FloatArray]:
    return [made.recording.stream("arm_ft").signal("raw").values for made in simulate(scenario, *args)]  # type: ignore[arg-type]


@pytest.mark.long
def test_traces_serve_any_number_of_sensors() -> None:
    """With traces come the same recordings as without; another seed of the sensors changes counts and no load."""
    scenario = build_scenario(ARM)
    traces = trace_recordings(scenario)
    for first, second in zip(_raw(scenario, traces), _raw(scenario), strict=True):
        np.testing.assert_array_equal(first, second)
    other = scenario.with_sensors(seed=6)
    anew = build_scenario(ARM.with_sensors(seed=6))
    again = trace_recordings(anew)
    for name, trace in traces.items():
        np.testing.assert_array_equal(trace.loads["arm_ft"], again[name].loads["arm_ft"])
        np.testing.assert_array_equal(trace.joints.stamp_ns, again[name].joints.stamp_ns)
    for first, second, old in zip(_raw(other, traces), _raw(anew), _raw(scenario), strict=True):
        np.testing.assert_array_equal(first, second)
        assert np.abs(first - old).min() >= 0.0
        assert not np.array_equal(first - first.mean(axis=0), old - old.mean(axis=0))
    moved = trace_recordings(build_scenario(ARM.model_copy(update={"seed": 6})))
    assert not np.array_equal(moved["fit"].loads["arm_ft"], traces["fit"].loads["arm_ft"])


@pytest.mark.long
def test_sensors_that_are_left_out_change_no_other() -> None:
    """A sensor keeps its matrix, serial number and offsets whichever others are simulated."""
    every = load_scenario(bundled_scenario("icub-insitu"))
    for name in ("r_leg_ft", LEG):
        alone = every.with_sensors(names=(name,), workbench_error=None)
        assert list(alone.specimens) == [name]
        first, second = alone.specimens[name], every.with_sensors(workbench_error=None).specimens[name]
        assert first.serial == second.serial
        np.testing.assert_array_equal(first.sensor.matrix, second.sensor.matrix)
    with pytest.raises(FormatError, match="sensor 'l_leg_ft' is not among those that are simulated; .*r_leg_ft"):
        every.with_sensors(names=("r_leg_ft",))


def test_what_does_not_fit_is_refused() -> None:
    """Traces of other motions or without a sensor, and keys that sensors do not have."""
    scenario = build_scenario(ARM)
    traces = trace_recordings(build_scenario(ARM))
    with pytest.raises(RobotError, match="trace of 'fit': expected one of this scenario's own motions"):
        _raw(scenario, traces)
    with pytest.raises(RobotError, match="trace of 'fit': expected"):
        _raw(scenario, {})
    plan = scenario.plans[0]
    with pytest.raises(RobotError, match="movement 'fit' was traced without sensor 'arm_ft'"):
        _raw(scenario, {plan.name: plan.trace([], seed=5)})
    with pytest.raises(ValueError, match="unknown key 'sede'; did you mean \"seed\""):
        scenario.with_sensors(sede=3)
    with pytest.raises(ValueError, match="greater than or equal to 0"):
        scenario.with_sensors(noise_counts=-1.0)
