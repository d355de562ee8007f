# SPDX-License-Identifier: BSD-3-Clause
"""Limits behind what is said of a load: on either side of each, by numbers of a result."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.arm_log import FLANGE
from forcetorque.payload.identification.estimation_problem import Load
from forcetorque.payload.identification.load_estimates import BiasTestRow
from forcetorque.payload.load_warnings import (
    _doubled,
    behind_flange,
    payload_doubts,
    reason_to_withhold,
    samples_disagree,
    torque_doubt,
)
from forcetorque.payload.result import LoadRow


def _row(half_kg: float, half_m: float) -> LoadRow:
    return LoadRow(
        load="tool",
        estimated=True,
        mass_kg=2.0,
        mass_half_width_95_kg=half_kg,
        centre_of_mass_m=(0.0, 0.0, 0.1),
        centre_of_mass_half_width_95_m=(0.0, half_m, 0.0),
        inertia_kgm2=None,
        inertia_half_width_95_kgm2=None,
    )


@pytest.mark.parametrize(
    ("half_kg", "half_m", "word"),
    [(0.39, 0.0195, None), (0.41, 0.0, "mass"), (0.0, 0.0205, "centre of mass")],
)
def test_a_load_by_torques_is_told_to_a_fifth_and_to_two_centimetres(half_kg: float, half_m: float, word: str) -> None:
    """Of its mass, and of its centre along any axis."""
    doubt = torque_doubt(_row(half_kg, half_m))
    assert doubt is None if word is None else doubt is not None and f"leave the {word} " in doubt


@pytest.mark.parametrize(
    ("height_m", "half_m", "named"), [(-0.029, 0.02, False), (-0.031, 0.02, True), (0.1, 0.0, False)]
)
def test_a_centre_surely_a_centimetre_behind_the_flange_is_named(height_m: float, half_m: float, named: bool) -> None:
    """By its interval, and only in the frame of the flange."""
    load: Any = SimpleNamespace(
        centre_of_mass=np.array([0.0, 0.0, height_m]),
        centre_of_mass_half_width=np.full(3, half_m),
        estimated=True,
        is_determined=True,
        mass=1.0,
        mass_half_width=0.1,
    )
    assert bool(list(behind_flange(FLANGE, [load]))) == named
    assert not list(behind_flange("wrist", [load]))


@pytest.mark.parametrize(
    ("of", "p_value", "named"), [("intervals", 0.0099, True), ("intervals", 0.0101, False), ("sessions", 1e-9, False)]
)
def test_biases_of_intervals_that_differ_by_a_chance_of_one_in_hundred_are_named(
    of: str, p_value: float, named: bool
) -> None:
    """Those of sessions differ by nature."""
    test = BiasTestRow(of=of, p_value=p_value, largest_difference=(1.0,) * 6, plain_mass_with_one_bias_kg=(1.0,))
    weighed: Any = SimpleNamespace(
        hypotheses=(),
        bias_tests=(test,),
        loads=(_row(0.1, 0.01),),
        disagreements=(),
        left_out=0,
        disagreeing=(),
        validation=(),
    )
    assert any("one bias for a session is wrong" in words for words in payload_doubts(weighed)) == named


def _withheld(**changes: Any) -> str | None:
    """Why a result of 100 samples without a fault, but for the changes, is not to be told to a robot."""
    load = SimpleNamespace(estimated=True)
    fields = {"hypotheses": (), "disagreements": (), "disagreeing": (), "undetermined": (), "loads": (load,)}
    weighed: Any = SimpleNamespace(observations=100, **(fields | changes))
    return reason_to_withhold(weighed)


@pytest.mark.parametrize(("count", "disagree"), [(0, False), (5, False), (6, True)])
def test_samples_disagree_from_a_twentieth_on(count: int, disagree: bool) -> None:
    """Which withholds the load, with their number."""
    weighed: Any = SimpleNamespace(disagreements=(), disagreeing=("row",) * count, observations=100)
    assert samples_disagree(weighed) == disagree
    expected = f"{count} of 100 samples disagree with the others" if disagree else None
    assert _withheld(disagreeing=("row",) * count) == expected


def test_a_load_is_withheld_for_the_first_reason() -> None:
    """Hypotheses before samples, samples before what is undetermined; of several of a kind, the first."""
    hypotheses = tuple(SimpleNamespace(name=name, description="words") for name in ("no load", "turned mount"))
    rest: dict[str, Any] = {
        "disagreements": ("morning and noon differ", "noon and night differ"),
        "undetermined": ("mass", "centre"),
    }
    assert _withheld() is None
    assert _withheld(undetermined=rest["undetermined"]) == "mass"
    assert _withheld(**rest) == "morning and noon differ"
    both = "morning and noon differ; 2 of 100 samples disagree with the others"
    assert _withheld(**rest, disagreeing=("row", "row")) == both
    assert _withheld(**rest, hypotheses=hypotheses) == "no load: words"
    # a specified load may be nothing
    specified = (SimpleNamespace(estimated=False),)
    assert _withheld(**rest, hypotheses=hypotheses, loads=specified) == "turned mount: words"
    assert _withheld(hypotheses=hypotheses[:1], loads=specified) is None


@pytest.mark.parametrize(("share", "named"), [(0.0, True), (0.4, True), (0.45, False), (1.0, False)])
def test_a_load_that_the_urdf_has_too_is_named_where_readings_fit_better_without_it(share: float, named: bool) -> None:
    """Where the one residual is below 0.7 of the other: up to a share of 0.41 of its weight that the URDF lacks.

    Both by hand, the share and the rest of the weight about its mean in each interval.
    """
    rng = np.random.default_rng(3)
    gravity, known, block = 9.8 * rng.normal(size=(40, 3)), rng.normal(size=(40, 6)), np.repeat([0, 1], 20)
    weight = np.hstack([2.0 * gravity, np.zeros((40, 3))])
    columns = np.zeros((40, 6, 10))
    columns[:, :3, 0] = -gravity
    bias = np.array([[5.0] * 6, [-3.0] * 6])[block]
    problem = SimpleNamespace(
        direction=MeasureDirection.CHILD_TO_PARENT,
        rows=SimpleNamespace(
            columns=columns,
            known=known,
            wrench=known + share * weight + bias,
            load=np.zeros(40, dtype=np.int64),
            block=block,
        ),
    )
    load = Load(name="tool", mass=2.0, centre_of_mass=np.array([0.0, 0.0, 0.1]))
    run: Any = SimpleNamespace(experiment=None)
    loads: Any = SimpleNamespace(loads=(load,), problem=lambda _: problem)
    words = list(_doubled(run, loads))
    assert len(words) == named
    about = 2.0 * (gravity.reshape(2, 20, 3) - gravity.reshape(2, 20, 3).mean(axis=1, keepdims=True))
    whole_N = np.sqrt((about**2).sum(axis=2).mean())
    for text in words:
        with_it, without = (float(match) for match in re.findall(r"(\S+) N with", text))
        assert (with_it, without) == pytest.approx(((1.0 - share) * whole_N, share * whole_N), rel=5e-3, abs=1e-9)
