# SPDX-License-Identifier: BSD-3-Clause
"""Several recordings of one load on one sensor as one problem: power-ups are the recordings' own, the load is one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from forcetorque.base.errors import FitError
from forcetorque.payload.identification.problem import LoadProblem, LoadRows

_OPTIONAL = (
    "angular_velocity_products",
    "angular_acceleration",
    "columns",
    "known",
    "time_s",
    "variables",
    "orientation",
)


def together(problems: Mapping[str, LoadProblem]) -> LoadProblem:
    """Join problems with the same loads.

    Args:
        problems: Problems by the name of their recording, at least one.

    Returns:
        The problem of all rows; names of sessions, intervals and rows begin with those of their recordings.

    Raises:
        FitError: If loads, direction or variables differ.
    """
    names, parts = list(problems), list(problems.values())
    if len(parts) == 1:
        return parts[0]
    first = parts[0]
    for name, problem in problems.items():
        if not _alike(first, problem):
            raise FitError(
                f"{name}: expected the loads, measure_direction, drift, mount, tilt and variables of {names[0]}, got "
                "others; state them alike to weigh recordings together"
            )
    sessions, blocks = ([len(getattr(problem, field)) for problem in parts] for field in ("sessions", "blocks"))
    lengths = [len(problem.rows) for problem in parts]
    rows = LoadRows(
        wrench=np.concatenate([problem.rows.wrench for problem in parts]),
        proper_acceleration=np.concatenate([problem.rows.proper_acceleration for problem in parts]),
        session=_shifted([problem.rows.session for problem in parts], sessions),
        block=_shifted([problem.rows.block for problem in parts], blocks),
        load=np.concatenate([problem.rows.load for problem in parts]),
        share=np.concatenate([problem.rows.share for problem in parts]),
        names=tuple(f"{name}: {row}" for name, problem in problems.items() for row in problem.rows.names),
        **{field: _optional([problem.rows for problem in parts], field, lengths) for field in _OPTIONAL},
    )
    return replace(
        first,
        rows=rows,
        sessions=tuple(_named(name, own) for name, problem in problems.items() for own in problem.sessions),
        blocks=tuple(f"{name}: {own}" for name, problem in problems.items() for own in problem.blocks),
        tilt=first.tilt and rows.orientation is not None,
    )


def _named(recording: str, session: str) -> str:
    return session if session == recording else f"{recording}: {session}"


def _alike(first: LoadProblem, other: LoadProblem) -> bool:
    def stated(problem: LoadProblem) -> tuple[object, ...]:
        loads = tuple(
            (
                load.name,
                load.mass,
                None if load.centre_of_mass is None else tuple(load.centre_of_mass),
                str(load.inertia),
            )
            for load in problem.loads
        )
        return loads, problem.direction, problem.drift, problem.mount, problem.tilt, problem.variables

    return stated(first) == stated(other)


def _shifted(numbers: list[np.ndarray], counts: list[int]) -> np.ndarray:
    starts = np.cumsum([0, *counts[:-1]])
    return np.concatenate([own + start for own, start in zip(numbers, starts, strict=True)])


def _optional(rows: list[LoadRows], field: str, lengths: list[int]) -> np.ndarray | None:
    """Values of a field; zeros for a motion that was slow in some of the recordings, none where they are needed."""
    values = [getattr(own, field) for own in rows]
    if all(value is None for value in values):
        return None
    if field.startswith("angular"):
        values = [np.zeros((n, 3)) if value is None else value for value, n in zip(values, lengths, strict=True)]
    return None if any(value is None for value in values) else np.concatenate(values)
