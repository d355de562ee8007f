# SPDX-License-Identifier: BSD-3-Clause
"""Samples over time as data sets of xarray: dimensions, coordinates, units."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import Experiment, load_experiment
from forcetorque.base.errors import MissingExtraError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.recording.stream import Signal, Stream
from tests.scenes.experiment_folders import arm, intact
from tests.scenes.experiments import JOINTS, PARQUET

__all__ = ["arm", "intact"]


@pytest.fixture
def experiment(arm: Path) -> Experiment:
    """The experiment of the small arm, from its file."""
    return load_experiment(arm / PARQUET)


def test_expected_wrenches_are_labelled(experiment: Experiment) -> None:
    """Time in stamps, axes by name; they stay a pair of arrays."""
    pytest.importorskip("xarray")
    expected = experiment["arm_ft"].expected_wrenches("judge")
    time_s, wrench = expected
    labelled = expected.to_xarray()
    assert labelled.expected.dims == ("time", "axis")
    assert list(labelled.axis.values) == list(WRENCH_COMPONENTS)
    assert labelled.expected.attrs["units"] == "N, N, N, N m, N m, N m"
    assert (labelled.expected.attrs["frame"], labelled.attrs["interval"]) == ("arm_ft", "judge")
    np.testing.assert_array_equal(labelled.expected.sel(axis="fz").values, wrench[:, 2])
    assert labelled.time.attrs["units"] == "ns"
    np.testing.assert_allclose((labelled.time - experiment.recording.start_ns) * 1e-9, time_s, atol=1e-9)


def test_readings_are_labelled(experiment: Experiment) -> None:
    """Channels in counts, joints by name."""
    pytest.importorskip("xarray")
    counts = experiment.recording.stream("arm_ft").to_xarray()
    assert (counts.raw.dims, counts.raw.attrs["units"]) == (("time", "channel"), "counts")
    assert counts.attrs["stream"] == "arm_ft"
    joints = experiment.recording.stream("joints").to_xarray()
    assert list(joints.joint.values) == list(JOINTS)
    assert joints.position.attrs["units"] == "rad"
    stamps = experiment.recording.stream("joints").stamp_ns
    np.testing.assert_array_equal(joints.time.values, stamps)


def test_quantities_of_other_columns_have_dimensions_of_their_own() -> None:
    """Two joints move, one is driven; an IMU has axes of its frame."""
    pytest.importorskip("xarray")
    zeros = np.zeros((3, 2))
    signals = {
        "position": Signal(quantity="position", values=zeros, columns=("a", "b"), units=("rad", "m")),
        "torque": Signal(quantity="torque", values=zeros[:, :1], columns=("a",), units=("N m",)),
        "angular_velocity": Signal.of_fixed("angular_velocity", np.zeros((3, 3)), frame="base"),
    }
    labelled = Stream(name="s", clock="c", stamp_ns=np.arange(3), signals=signals).to_xarray()
    assert labelled.position.dims == ("time", "joint")
    assert labelled.torque.dims == ("time", "torque_column")
    assert labelled.position.attrs["units"] == "rad, m"
    assert (labelled.angular_velocity.dims[1], labelled.angular_velocity.attrs["frame"]) == ("xyz", "base")


def test_estimates_are_labelled(experiment: Experiment) -> None:
    """Contact wrenches by contact, torques by joint, beside what was measured and expected."""
    pytest.importorskip("xarray")
    (interval, *_) = experiment.estimate(contacts=["hand"]).intervals
    labelled = interval.to_xarray()
    assert labelled.contact_wrench.dims == ("time", "contact", "axis")
    assert "hand" in labelled.contact.values
    force = labelled.contact_wrench.sel(contact="hand", axis=["fx", "fy", "fz"])
    where = list(interval.estimates.layout.contacts).index("hand")
    np.testing.assert_array_equal(force.values, interval.estimates.contact_wrenches[:, where, :3])
    assert labelled.torque.dims == ("time", "joint")
    assert labelled.measured.dims[0] == "time"


def test_without_xarray_the_extra_is_named(experiment: Experiment, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the line that installs it, before a data set is made; so of pandas."""
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(MissingExtraError, match=r"^to_xarray needs xarray: pip install 'forcetorque\[frames\]'$"):
        experiment.recording.stream("arm_ft").to_xarray()
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(MissingExtraError, match=r"^to_pandas needs pandas: pip install 'forcetorque\[frames\]'$"):
        experiment.inspect().to_pandas()
