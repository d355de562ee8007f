# SPDX-License-Identifier: BSD-3-Clause
"""States of libfranka: the flange's wrench by the published conventions, lost estimates, and other orders refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.franka.log_format import FrankaFormat, FrankaLog
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.registry import recognised_format
from forcetorque.inspection.draft.draft import draft_experiment
from tests.formats.franka.states import CENTRE, MASS, ZERO, states, write_states, write_table

ROUNDING = 1e-12


def _read(path: Path, **stated: object) -> LogReading:
    context = ExperimentContext(
        experiment=path.parent / "x.toml", inputs=Inputs(path.parent), sensors={}, joint_units={}
    )
    return FrankaFormat().read(FrankaLog.model_validate({"format": "franka", "path": path.name, **stated}), context)


def _left(reading: LogReading, mass: float = MASS, centre: FloatArray = CENTRE, zero: FloatArray = ZERO) -> FloatArray:
    """What a load that the robot holds up leaves of the wrench at the flange; shape (n, 6)."""
    (wrist,) = (stream for stream in reading.streams if stream.name == "wrist")
    weight = mass * wrist.signal("gravity").values
    return wrist.signal("wrench").values + np.hstack([weight, np.cross(centre, weight)]) - zero


@pytest.mark.parametrize("fields", [(), ("K_F_ext_hat_K",), ("O_F_ext_hat_K",)])
def test_the_load_explains_the_wrench_at_the_flange(tmp_path: Path, fields: tuple[str, ...]) -> None:
    """From either form of the wrench, or both; an estimate of exactly zero is missing, and named."""
    made = [{key: value for key, value in state.items() if key not in fields} for state in states()]
    path = write_states(tmp_path / "log", made)
    assert isinstance(recognised_format(path), FrankaFormat)
    reading = _read(path)
    left = _left(reading)
    lost = np.isnan(left).all(axis=1)
    assert lost.sum() == 1
    np.testing.assert_allclose(left[~lost], 0.0, atol=ROUNDING)
    (finding,) = reading.findings
    assert (finding.kind, finding.count) == ("lost_samples", 1)
    assert np.nanmax(np.abs(_left(reading, mass=-MASS))) > 1.0


def test_the_declared_load_is_added(tmp_path: Path) -> None:
    """The whole load is left, whatever setLoad was given; the end effector of Desk is not part of it."""
    made = states(declared=0.4, declared_centre=np.array([0.0, 0.01, 0.05]))
    path = write_states(tmp_path / "log", made)
    assert np.nanmax(np.abs(_left(_read(path)))) < ROUNDING
    wrist = FrankaFormat().describe(path).wrist
    assert wrist is not None
    assert [load.mass for load in wrist.declared] == [0.4]
    assert any("0.73 kg" in words for words in wrist.assumed)
    content = draft_experiment(path).content
    assert 'measure_direction = "parent_to_child"' in content
    assert "joints" not in content


def test_a_table_has_no_wrench(tmp_path: Path) -> None:
    """The table holds joints: their torques are read, and what lacks is named."""
    path = write_table(tmp_path / "log.csv", states())
    assert isinstance(recognised_format(path), FrankaFormat)
    description = FrankaFormat().describe(path)
    assert [stream.name for stream in description.reading.streams] == ["joints", "external_torques"]
    assert description.wrist is None
    assert "neither a wrench" in description.wrist_lacks
    stamps = _read(path).streams[0].stamp_ns
    assert (stamps[0], stamps[1] - stamps[0]) == (1_000_000_000, 1_000_000)


def test_what_a_subset_lacks_is_asked(tmp_path: Path) -> None:
    """Poses of frames and the declared load, each by its key."""
    made = [{key: state[key] for key in ("time", "O_T_EE", "K_F_ext_hat_K", "tau_J")} for state in states()]
    path = write_states(tmp_path / "log", made)
    description = FrankaFormat().describe(path)
    assert set(description.undetermined) == {"F_T_EE", "EE_T_K", "payload_kg"}
    whole = states()[0]
    left = _left(_read(path, F_T_EE=whole["F_T_EE"], EE_T_K=whole["EE_T_K"], payload_kg=0.0))
    assert np.nanmax(np.abs(left)) < ROUNDING
    with pytest.raises(FormatError, match="F_T_EE: expected pose of the end effector"):
        _read(path)


def _by_rows(state: dict[str, Any]) -> dict[str, Any]:
    return {**state, "O_T_EE": np.array(state["O_T_EE"]).reshape(4, 4).T.ravel().tolist()}


def _other_axes(state: dict[str, Any]) -> dict[str, Any]:
    return {**state, "O_F_ext_hat_K": state["K_F_ext_hat_K"]}


def _huge(state: dict[str, Any]) -> dict[str, Any]:
    return {**state, "O_T_EE": [1e200 * value if k < 15 else value for k, value in enumerate(state["O_T_EE"])]}


@pytest.mark.parametrize(
    ("change", "match"),
    [
        (_by_rows, "O_T_EE: expected 16 numbers column by column, .* got them row by row"),
        (_other_axes, "one of them has other axes, or the poses are transposed"),
        (_huge, "O_T_EE: expected a rotation in the first three rows"),
        (lambda state: {**state, "q": [0.0] * 6}, "log:1: .* got q without 7 numbers"),
        (lambda state: {**state, "q": [1e400] * 7}, "log:1: .* got a number that is not finite"),
        (lambda state: {**state, "time": 1e300}, "time: expected milliseconds"),
    ],
)
def test_other_orders_and_numbers_are_refused(tmp_path: Path, change: Any, match: str) -> None:
    """A pose row by row, a wrench along other axes, and damaged fields, each by its name."""
    path = write_states(tmp_path / "log", [change(state) for state in states()])
    with pytest.raises(FormatError, match=match):
        FrankaFormat().describe(path)


def test_a_cut_state_is_named(tmp_path: Path) -> None:
    """A program that was killed leaves part of a line; a damaged line in between is refused."""
    path = write_states(tmp_path / "log", states())
    text = path.read_text(encoding="ascii")
    path.write_text(text[:-200], encoding="ascii")
    assert [finding.kind for finding in _read(path).findings] == ["cut_row", "lost_samples"]
    path.write_text(text.replace('"q"', "q", 3), encoding="ascii")
    assert recognised_format(path) is None
    lines = text.splitlines(keepends=True)
    path.write_text("".join([*lines[:4], "{\n", *lines[4:]]), encoding="ascii")
    with pytest.raises(FormatError, match="log:5: expected a state with time, O_T_EE"):
        _read(path)


@pytest.mark.real_data
def test_the_sample_has_its_truth(data_dir: Path) -> None:
    """The load of the sample leaves the noise of the sample."""
    folder = data_dir / "franka_state"
    if not folder.is_dir():
        pytest.skip("no franka_state in the folder of real measurements")
    left = _left(_read(folder / "franka_states.jsonl", gravity=9.81), zero=np.zeros(6))
    assert np.abs(left.mean(axis=0)).max() < 0.03
    assert isinstance(recognised_format(folder / "franka_log.csv"), FrankaFormat)
