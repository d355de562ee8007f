# SPDX-License-Identifier: BSD-3-Clause
"""Findings against the model: a fault put into a simulated reading is found, a clean one gives none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.inspection.residual_findings import model_findings
from forcetorque.recording.recording import Finding

RATE = 100.0
SECONDS = 60.0
SECOND_NS = 1_000_000_000


def _reading(seed: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Stamps, a noisy reading of a 40 N limb that swings, its expectation, and all samples in use."""
    rng = np.random.default_rng(seed)
    n = int(SECONDS * RATE)
    seconds = np.arange(n) / RATE
    tilt = 0.8 * np.sin(2 * np.pi * 0.05 * seconds)
    expected = np.zeros((n, 6))
    expected[:, 0], expected[:, 2] = 40.0 * np.sin(tilt), -40.0 * np.cos(tilt)
    expected[:, 4] = 8.0 * np.sin(tilt)
    noise = rng.normal(size=(n, 6)) * [0.3, 0.3, 0.3, 0.05, 0.05, 0.05]
    offset = np.array([5.0, -3.0, 12.0, 0.5, 0.2, -0.1])
    return (seconds * 1e9).astype(np.int64), expected + noise + offset, expected, np.ones(n, dtype=bool)


def _find(measured: np.ndarray, seed: int = 1) -> tuple[Finding, ...]:
    stamps, _, expected, in_use = _reading(seed)
    return model_findings("ft", stamps, measured, expected, in_use=in_use)


def _span(first: float, last: float) -> slice:
    return slice(int(first * RATE), int(last * RATE))


def test_a_clean_reading_has_no_findings() -> None:
    """Noise, an offset and motion are nothing to report."""
    for seed in range(5):
        assert _find(_reading(seed)[1], seed) == ()


def test_a_step_is_found_with_time_size_and_axis() -> None:
    """An offset that changes by 10 N for good at 40 s is a step there."""
    _, measured, _, _ = _reading()
    measured[_span(40, 60), 1] += 10.0
    steps = [finding for finding in _find(measured) if finding.kind == "step"]
    assert len(steps) == 1
    assert steps[0].channel == "fy"
    assert steps[0].size == pytest.approx(10.0, abs=0.5)
    assert steps[0].start_ns == pytest.approx(40 * SECOND_NS, abs=0.3 * SECOND_NS)


@pytest.mark.parametrize("at", [10, 20, 30, 40, 50])
def test_a_step_is_found_wherever_it_is(at: float) -> None:
    """Also in the middle of the samples in use, where half of them are on either level."""
    _, measured, _, _ = _reading()
    measured[_span(at, 60), 1] += 20.0
    steps = [finding for finding in _find(measured) if finding.kind == "step"]
    assert [(s.channel, round(s.start_ns * 1e-9)) for s in steps if s.start_ns is not None] == [("fy", at)]


def test_the_ends_of_a_log_are_no_steps() -> None:
    """Strong noise gives no step at the first and last second, where there is no level on one side."""
    for seed in range(5):
        _, measured, _, _ = _reading(seed)
        measured += np.random.default_rng(seed).normal(size=measured.shape) * [3, 3, 3, 0.4, 0.4, 0.4]
        assert not [finding for finding in _find(measured, seed) if finding.kind == "step"]


def test_a_span_off_level_is_found_from_begin_to_end() -> None:
    """An axis that is 8 N off for 10 s is reported with its level and both ends."""
    _, measured, _, _ = _reading()
    measured[_span(20, 30), 1] -= 8.0
    spans = [finding for finding in _find(measured) if finding.kind == "off_level"]
    assert len(spans) == 1
    assert (spans[0].channel, spans[0].size) == ("fy", pytest.approx(-8.0, abs=0.5))
    assert spans[0].start_ns == pytest.approx(20 * SECOND_NS, abs=0.3 * SECOND_NS)
    assert spans[0].end_ns == pytest.approx(30 * SECOND_NS, abs=0.3 * SECOND_NS)


def test_a_contact_that_carries_the_limb_is_a_contact_and_nothing_else() -> None:
    """A push of 30 N against the weight of 40 N is one contact; its axes are not listed one by one."""
    _, measured, expected, _ = _reading()
    part = _span(10, 18)
    measured[part] -= 0.75 * expected[part]
    found = _find(measured)
    assert [finding.kind for finding in found if finding.start_ns < 19 * SECOND_NS] == ["contact"]
    assert found[0].size == pytest.approx(30.0, abs=1.5)
    assert found[0].start_ns == pytest.approx(10 * SECOND_NS, abs=0.3 * SECOND_NS)


def test_a_contact_is_one_event_though_it_fills_most_of_the_log_and_lifts_only_at_times() -> None:
    """35 of 60 s, in which the limb is lifted, pushed sideways, and lifted again; the level is that beside it."""
    _, measured, expected, _ = _reading()
    push = np.zeros(6)
    push[[1, 3]] = 30.0, 4.0
    measured[_span(15, 25)] -= 0.75 * expected[_span(15, 25)]
    measured[_span(25, 40)] += push
    measured[_span(40, 50)] -= 0.75 * expected[_span(40, 50)]
    (contact,) = _find(measured)
    assert contact.kind == "contact"
    assert contact.start_ns == pytest.approx(15 * SECOND_NS, abs=0.3 * SECOND_NS)
    assert contact.end_ns == pytest.approx(50 * SECOND_NS, abs=0.3 * SECOND_NS)


@pytest.mark.real_data
def test_the_contact_of_a_tool_is_one_event(data_dir: Path) -> None:
    """A Gamma on a KUKA that rubs from 0.6 to 4.1 s of 6.3 s, under a load that was weighed in still poses."""
    run = data_dir / "ati_gamma_kuka_med14_skrede" / "3-vibrations-contact"
    wrench = np.loadtxt(f"{run}_wrench.csv", delimiter=",", skiprows=1)
    turn = np.loadtxt(f"{run}_orientations.csv", delimiter=",", skiprows=1)
    stamps = wrench[:, 0].astype(np.int64) * 1000
    down = np.column_stack([np.interp(wrench[:, 0], turn[:, 0], -9.82085 * turn[:, column]) for column in (7, 8, 9)])
    weight = 0.932 * down
    expected = np.hstack([weight, np.cross([0.0003, 0.0, 0.0439], weight)])
    found = model_findings("wrist", stamps, wrench[:, 1:], expected, in_use=np.ones(len(stamps), dtype=bool))
    (contact,) = [one for one in found if one.kind != "outlier"]
    assert contact.kind == "contact"
    assert contact.size == pytest.approx(17.0, abs=1.0)
    seconds = [(instant - stamps[0]) * 1e-9 for instant in (contact.start_ns, contact.end_ns)]
    assert seconds == pytest.approx([0.6, 4.15], abs=0.2)


def test_a_light_lift_leaves_both_readings_open() -> None:
    """A push of 8 N against the weight may be a contact or a step: both are reported."""
    _, measured, expected, _ = _reading()
    part = _span(10, 18)
    measured[part] -= 0.2 * expected[part]
    kinds = {finding.kind for finding in _find(measured)}
    assert "light_contact" in kinds
    assert kinds & {"off_level", "step"}
    assert "contact" not in kinds


def test_a_load_along_gravity_is_no_contact() -> None:
    """Negative control: added weight pulls the other way and is off level, not a contact."""
    _, measured, expected, _ = _reading()
    part = _span(10, 18)
    measured[part] += 0.75 * expected[part]
    kinds = {finding.kind for finding in _find(measured)}
    assert "off_level" in kinds
    assert not kinds & {"contact", "light_contact"}


def test_a_drift_is_one_finding_with_its_size() -> None:
    """15 N over the minute, beside a model whose fz takes 10 % of fx; without it nothing is found."""
    _, measured, expected, _ = _reading()
    measured[:, 2] += 0.1 * expected[:, 0]
    assert _find(measured) == ()
    measured[:, 1] += np.linspace(0.0, 15.0, len(measured))
    (drift,) = _find(measured)
    assert (drift.kind, drift.channel) == ("drift", "fy")
    assert drift.size == pytest.approx(15.0, abs=1.0)


@pytest.mark.parametrize("length_s", [0.5, 3.0])
def test_a_push_is_one_finding_with_its_time(length_s: float) -> None:
    """10 N to the side with a moment, which do not lift the limb; one axis alone is off its level instead."""
    _, measured, _, _ = _reading()
    measured[_span(20, 20 + length_s), 1] += 10.0
    alone = [finding.kind for finding in _find(measured)]
    assert "light_contact" not in alone
    measured[_span(20, 20 + length_s), 3] += 3.0
    (push,) = _find(measured)
    assert push.kind == "light_contact"
    assert push.size == pytest.approx(10.0, abs=1.5)
    assert push.start_ns == pytest.approx(20 * SECOND_NS, abs=0.1 * SECOND_NS)
    assert push.end_ns == pytest.approx((20 + length_s) * SECOND_NS, abs=0.1 * SECOND_NS)


def test_a_movement_of_the_joints_is_no_step_where_the_model_is_off() -> None:
    """A limb that turns within a second, again and again, with an fx that takes 25 % of fz; a step on top is found."""
    stamps, _, _, in_use = _reading()
    seconds = stamps * 1e-9
    tilt = np.interp(seconds % 10.0, [0.0, 4.5, 5.5, 9.5, 10.0], [0.0, 0.0, 1.2, 1.2, 0.0])
    expected = np.zeros((len(seconds), 6))
    expected[:, 0], expected[:, 2] = 40.0 * np.sin(tilt), -40.0 * np.cos(tilt)
    measured = expected + np.random.default_rng(4).normal(size=expected.shape) * [0.3, 0.3, 0.3, 0.05, 0.05, 0.05]
    measured[:, 0] += 0.25 * expected[:, 2]
    assert model_findings("ft", stamps, measured, expected, in_use=in_use) == ()
    measured[_span(35, 60), 0] += 12.0
    found = model_findings("ft", stamps, measured, expected, in_use=in_use)
    assert any(
        one.kind == "step" and one.start_ns == pytest.approx(35 * SECOND_NS, abs=0.5 * SECOND_NS) for one in found
    )


def test_single_samples_far_off_are_outliers() -> None:
    """Two spikes of one axis are one line with their number, the largest and its time."""
    _, measured, _, _ = _reading()
    measured[1500, 0] += 30.0
    measured[3200, 0] -= 60.0
    found = _find(measured)
    assert [finding.kind for finding in found] == ["outlier"]
    assert (found[0].channel, found[0].size) == ("fx", pytest.approx(-60.0, abs=1.5))
    assert found[0].message.startswith("2 outlier")
    assert found[0].start_ns == 32 * SECOND_NS


def test_vibration_is_no_finding() -> None:
    """A vibration of 3 N at 9 Hz is taken out by the running median."""
    stamps, measured, _, _ = _reading()
    measured[:, 1] += 3.0 * np.sin(2 * np.pi * 9.0 * stamps * 1e-9)
    assert _find(measured) == ()


def test_shapes_are_checked() -> None:
    """Arrays that do not fit, or no sample in use, are refused."""
    stamps, measured, expected, in_use = _reading()
    with pytest.raises(ShapeError, match="one shape"):
        model_findings("ft", stamps, measured[:-1], expected, in_use=in_use)
    with pytest.raises(ShapeError, match="0 in use"):
        model_findings("ft", stamps, measured, expected, in_use=~in_use)
