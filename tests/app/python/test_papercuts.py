# SPDX-License-Identifier: BSD-3-Clause
"""What a script meets first: missing arguments, mistaken units, completion and texts of objects."""

from __future__ import annotations

from inspect import getdoc, getmembers_static, signature
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel

from forcetorque.app.python.experiment import Experiment, load_experiment
from forcetorque.app.python.experiment_of_arrays import experiment_of_arrays
from forcetorque.app.python.run import Run
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.robot.urdf import read_urdf
from forcetorque.sensor.gains.gains import Gains
from forcetorque.simulation.robots import ARM_URDF
from tests.app.python.arrays import arrays_of
from tests.scenes.experiment_folders import arm, intact
from tests.scenes.experiments import PARQUET

__all__ = ["arm", "intact"]


@pytest.fixture
def experiment(arm: Path) -> Experiment:
    """The experiment of the small arm, from its file."""
    return load_experiment(arm / PARQUET)


def test_all_missing_arguments_are_named_at_once(experiment: Experiment) -> None:
    """With shapes and units; an argument that there is not is refused as Python does."""
    given = arrays_of(experiment)
    some = {name: given[name] for name in ("robot", "sensor", "time_s", "reading", "joints")}
    with pytest.raises(ExperimentError) as refused:
        experiment_of_arrays(**some)
    assert str(refused.value) == (
        "experiment_of_arrays: expected also support (name of the link that stands still), gravity_direction (where "
        "things fall, in the axes of the support, shape (3,)), calibrate (span to fit, start and end, s), serial "
        "(serial number, text)"
    )
    with pytest.raises(TypeError, match="unexpected keyword argument 'jugde'"):
        experiment_of_arrays(**given | {"jugde": (0.0, 1.0)})
    assert "time_s" in signature(experiment_of_arrays).parameters


@pytest.mark.parametrize(
    ("reading", "changes", "message"),
    [
        (0.01, {}, r'expected counts .*, got fractions up to .*, as of N; state quantity="wrench"'),
        (1.0, {"quantity": "wrench"}, r"expected N and N m, got whole numbers up to .*, as of counts; state quantity"),
    ],
)
def test_counts_and_newtons_are_told_apart_by_magnitude(
    experiment: Experiment, reading: float, changes: dict[str, Any], message: str
) -> None:
    """Fractions of no more than 0.5 % of the limit are no counts, whole numbers of thousands no newtons."""
    arguments = arrays_of(experiment)
    counts = np.rint(arguments["reading"])
    mistaken = arguments | {"reading": counts * reading * (160.0 / np.abs(counts).max() / 0.01)} | changes
    mistaken["reading"] = np.rint(mistaken["reading"]) if reading == 1.0 else mistaken["reading"]
    with pytest.raises(ExperimentError, match=message):
        experiment_of_arrays(**mistaken)


def test_small_fractions_are_counts_of_a_converter_with_that_limit(experiment: Experiment) -> None:
    """Its limit says so: volts of a card, for which no count is known."""
    arguments = arrays_of(experiment)
    volts = arguments["reading"] / np.abs(arguments["reading"]).max() * 4.5
    assert experiment_of_arrays(**arguments | {"reading": volts, "limit_counts": 5.0}).sensors


def test_a_robot_is_a_line() -> None:
    """Name, links, joints and sensors; not the content of every link."""
    robot = read_urdf(ARM_URDF)
    assert (
        repr(robot)
        == f"<RobotModel 'arm': {len(robot.links)} links, {len(robot.joints)} joints (5 moving), sensors arm_ft>"
    )
    assert len(repr(robot)) < 120


def test_completion_shows_what_is_of_the_library() -> None:
    """Nothing of pydantic, which works all the same; control: the classes have it."""
    of_pydantic = {name for name in dir(BaseModel) if not name.startswith("__")}
    for thing in (Gains(experiment="arm", margin=0.2, sensors=()), Calibration.model_construct(offset=np.zeros(6))):
        names = set(dir(thing))
        assert names & of_pydantic == set()
        assert of_pydantic <= set(dir(type(thing)))
        assert names & {"margin", "offset"}
        assert names & {"json_text", "save"}
        assert type(thing.model_copy()) is type(thing)


@pytest.mark.parametrize("kind", [Experiment, Run])
def test_methods_state_their_options(kind: type[Experiment] | type[Run]) -> None:
    """`help(experiment.run)` and so on: every parameter of a method is in its docstring."""
    methods = [name for name, _ in getmembers_static(kind) if not name.startswith("_") and name in _own_names(kind)]
    assert len(methods) > 5
    for name in methods:
        method = getattr(kind, name)
        text = getdoc(method) or ""
        options = [option for option, one in signature(method).parameters.items() if one.kind is one.KEYWORD_ONLY]
        absent = [option for option in options if f"{option}:" not in text]
        assert not absent, f"{kind.__name__}.{name}: {absent}"


def _own_names(kind: type) -> set[str]:
    return {name for name in vars(kind) if callable(getattr(kind, name))}
