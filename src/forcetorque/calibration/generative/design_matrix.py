# SPDX-License-Identifier: BSD-3-Clause
"""The generative model at every mean: what is regressed on what.

response = E wrench + k (variables - reference values) + quadratic + flattening + model + offset + noise

All rows of the response have the same columns, except those of the robot model: what a wrong mass or joint zero does to
a row is its own. Constants large against what changes are taken off first, by session.

Where there are many recordings each is a cell: noise of one is independent of that of the others, and so is what it has
for itself, the offset of its session and terms such as its delay. Of these the columns are kept by cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.noise.slow_noise import Timeline
from forcetorque.base.rows_on_disk import forget_pages
from forcetorque.experiment.calibration.moments import TermColumns, WindowMeans
from forcetorque.experiment.calibration.quadratic_correction import quadratic_terms

MOST_IN_BLOCK = 8192
"""Means whose columns are in memory at a time, so that a recording of a day takes no more than one of some hours."""

MOST_TOGETHER = 12
"""Recordings up to which all are one cell: what each has for itself is then too little to be worth a cell."""


def cells_of(stretches: Sequence[WindowMeans]) -> list[int]:
    """Number the cells.

    Args:
        stretches: Means by recording, in the order of time.

    Returns:
        The number of the cell of every stretch.
    """
    recordings = list(dict.fromkeys(stretch.recording for stretch in stretches))
    if len(recordings) <= MOST_TOGETHER:
        return [0] * len(stretches)
    numbers = {recording: number for number, recording in enumerate(recordings)}
    return [numbers[stretch.recording] for stretch in stretches]


def blocks_of(count: int) -> list[slice]:
    """Divide means.

    Args:
        count: Number of means.

    Returns:
        Blocks of nearly one length, of at most `MOST_IN_BLOCK`.
    """
    ends = np.linspace(0, count, -(-count // MOST_IN_BLOCK) + 1).astype(np.int64).tolist()
    return [slice(start, end) for start, end in zip(ends, ends[1:], strict=False)]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Design:
    """Columns at n means: 6 of the wrench, v of variables, 21 quadratic, 6 of flattening; then those that are free."""

    columns: FloatArray
    """Columns of all rows without their means; shape (n, a)."""
    derivatives: TermColumns
    """Terms of the robot model, of which the columns of s that several cells have are computed as they are used."""
    reading: FloatArray
    """How the rows read errors of the loads; shape (rows, 6)."""
    acting: BoolArray
    """Which of the s terms that several cells have act on each row; shape (rows, s). A cable that pulls along one axis
    acts on one row where rows are components of the wrench; one that pulls nothing is counted to the first row."""
    member: IntArray
    """Number of the session of every mean; shape (n,)."""
    local: FloatArray
    """Columns of the terms that the cell of each mean alone has; shape (n, rows, w). Without their means where the
    session is in that cell alone: other means of the session would depend on the term otherwise."""
    local_places: IntArray
    """Places of these among all t terms, -1 for none; shape (cells, w)."""
    free: FloatArray
    """Ones of every session, and its time where it may drift; shape (n, f); they have no prior."""
    free_places: IntArray
    """Places of the free columns that a cell alone has, -1 for none; shape (cells, e)."""
    response: FloatArray
    """What is regressed, without its means; shape (n, rows)."""
    column_means: FloatArray
    """Means of the columns by session, which were taken off; shape (sessions, a)."""
    model_means: FloatArray
    """Means of the columns of all terms by session; shape (sessions, rows, t)."""
    centred_terms: BoolArray
    """Whether they were taken off; shape (sessions, t)."""
    response_means: FloatArray
    """Means that were taken off; shape (sessions, rows)."""
    timeline: Timeline
    """When the means were taken."""
    cell_ends: IntArray
    """First mean of every cell, and the number of means; shape (cells + 1,)."""
    sessions: tuple[str, ...]
    """Names of the sessions."""
    session_time_s: FloatArray
    """Mean time of every session on its recordings' clocks, from which drift counts; shape (sessions,); s."""
    load_centre: FloatArray
    """Mean wrench, about which the quadratic terms are taken; shape (6,); N, N m."""

    def model(self, rows: slice) -> FloatArray:
        """Give the columns of terms of the robot model that several cells have, without their means.

        Args:
            rows: Which k means.

        Returns:
            The columns; shape (k, rows, s).
        """
        means = self.model_means[:, :, self.derivatives.shared]
        return _shared_in_rows(self.derivatives, self.reading, rows) - means[self.member[rows]]

    @property
    def blocks(self) -> list[slice]:
        """Means in blocks, whose columns are computed together."""
        return blocks_of(len(self.member))

    @property
    def shared_free(self) -> IntArray:
        """Places of the free columns that several cells have."""
        return np.setdiff1d(np.arange(self.free.shape[1]), self.free_places)


def design_of(
    stretches: Sequence[WindowMeans],
    response: FloatArray,
    counts: FloatArray,
    model: TermColumns,
    reading: FloatArray,
    *,
    drift: bool,
    centre: FloatArray,
) -> Design:
    """Set up the columns.

    Args:
        stretches: Means by recording, in the order of time.
        response: What is regressed; shape (n, rows).
        counts: Modelled readings, relative to full scale, that the quadratic terms are products of; shape (n, 6).
        model: Derivatives by terms of the robot model, with the number of the cell of every mean as its group.
        reading: How the rows read errors of the loads; shape (rows, 6).
        drift: Whether the offset of a session may move in time.
        centre: Reference values of the variables; shape (v,).

    Returns:
        The design.
    """
    sessions = tuple(dict.fromkeys(stretch.session for stretch in stretches))
    lengths = [len(stretch) for stretch in stretches]
    member = np.repeat([sessions.index(s.session) for s in stretches], lengths)
    cell = model.group
    count, time = np.concatenate([s.count for s in stretches]), np.concatenate([s.time_s for s in stretches])
    wrench = np.concatenate([s.reference for s in stretches])
    about = counts - counts.mean(axis=0)
    variables = np.concatenate([s.variables for s in stretches]) - centre
    flattening = np.concatenate([s.flattening for s in stretches])
    columns, column_means = _centred(np.hstack([wrench, variables, quadratic_terms(about), flattening]), member, count)
    centred, response_means = _centred(response, member, count)
    elapsed, session_time = _centred(time[:, None], member, count)
    ones = (member[:, None] == np.arange(len(sessions))).astype(np.float64)
    alone = np.array([len(np.unique(cell[member == number])) == 1 for number in range(len(sessions))])
    local, model_means, acting = _centred_terms(model, reading, member, count, alone)
    centred_terms = np.ones((len(sessions), len(model.terms)), dtype=bool)
    for number in np.flatnonzero(~alone):
        of_cells = model.local[np.unique(cell[member == number])]
        centred_terms[number, of_cells[of_cells >= 0]] = False
    recordings = list(dict.fromkeys(s.recording for s in stretches))
    return Design(
        columns=columns,
        derivatives=model,
        reading=reading,
        acting=acting,
        member=member,
        local=local,
        local_places=model.local,
        free=np.hstack([ones, ones * elapsed]) if drift else ones,
        free_places=_own_sessions(member, cell, alone, drift=drift),
        response=centred,
        column_means=column_means,
        model_means=model_means,
        centred_terms=centred_terms,
        response_means=response_means,
        timeline=Timeline.of(
            time,
            np.repeat([recordings.index(s.recording) for s in stretches], lengths),
            count / np.median(count),
        ),
        cell_ends=np.searchsorted(cell, np.arange(int(cell.max()) + 2)),
        sessions=sessions,
        session_time_s=session_time[:, 0],
        load_centre=np.average(wrench, axis=0, weights=count),
    )


def _shared_in_rows(model: TermColumns, reading: FloatArray, rows: slice) -> FloatArray:
    """What terms that several cells have add to rows, per deviation of each term; shape (k, rows, s)."""
    columns = model.columns[rows] * model.deviations[model.shared]
    forget_pages([model.columns])
    return np.einsum("kc,nct->nkt", reading, columns)


def _local_in_rows(model: TermColumns, reading: FloatArray) -> FloatArray:
    """The same of terms that one cell alone has; shape (n, rows, w)."""
    # where a cell has fewer terms the column is 0
    size = np.where(model.local >= 0, model.deviations[model.local], 0.0)
    return np.einsum("kc,nct->nkt", reading, model.local_columns * size[model.group][:, None, :])


def _centred_terms(
    model: TermColumns, reading: FloatArray, member: IntArray, count: FloatArray, alone: BoolArray
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Local columns of terms, without means by session where these are taken off; means of all; rows they act on."""
    cell, weight = model.group, np.bincount(member, weights=count)
    means = np.zeros((len(alone), len(reading), len(model.terms)))
    of_shared = np.zeros((len(alone), len(reading), len(model.shared)))
    acting = np.zeros((len(reading), len(model.shared)), dtype=bool)
    for rows in blocks_of(len(member)):
        columns = _shared_in_rows(model, reading, rows)
        np.add.at(of_shared, member[rows], columns * count[rows, None, None])
        acting |= columns.any(axis=0)
    acting[0] |= ~acting.any(axis=0)
    means[:, :, model.shared] = of_shared / weight[:, None, None]
    local = _local_in_rows(model, reading)
    for number, places in enumerate(model.local):
        used = places >= 0
        for session in np.unique(member[cell == number]):
            inside = (cell == number) & (member == session)
            mean = np.einsum("nkw,n->kw", local[inside], count[inside]) / weight[session]
            means[session][:, places[used]] = mean[:, used]
            if alone[session]:
                local[inside] -= mean
    return local, means, acting


def _own_sessions(member: IntArray, cell: IntArray, alone: BoolArray, *, drift: bool) -> IntArray:
    """Places of the free columns that every cell alone has, -1 after the last; shape (cells, e)."""
    own: list[list[int]] = [[] for _ in range(int(cell.max()) + 1)]
    for session in np.flatnonzero(alone):
        own[int(cell[member == session][0])] += [int(session), int(session) + len(alone)] if drift else [int(session)]
    width = max(map(len, own))
    return np.array([places + [-1] * (width - len(places)) for places in own], dtype=np.int64).reshape(len(own), width)


def _centred(values: FloatArray, member: IntArray, count: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values less the mean of their session, and these means."""
    means = session_means(values, member, count)
    return values - means[member], means


def session_means(values: FloatArray, member: IntArray, count: FloatArray) -> FloatArray:
    """Average values over sessions.

    Args:
        values: Values; shape (n, k).
        member: Number of the session of each; shape (n,).
        count: Samples that each stands for; shape (n,).

    Returns:
        Means; shape (sessions, k).
    """
    total = np.zeros((int(member.max()) + 1, values.shape[1]))
    np.add.at(total, member, values * count[:, None])
    return total / np.bincount(member, weights=count)[:, None]
