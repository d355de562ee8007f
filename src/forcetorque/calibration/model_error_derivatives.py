# SPDX-License-Identifier: BSD-3-Clause
"""What errors of the robot model do to the expected wrenches of one sensor, on the windows of a fit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.calibration.joint.model_error_columns import (
    columns_of_terms,
    delay_terms,
    error_terms,
    link_axes,
    sliding_joints,
    terms_of_body,
)
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.robot_model_error import (
    CABLE_LEVER_M,
    EXACT,
    OF_CABLES,
    PULL,
    TWIST,
    ZERO,
    ErrorTerm,
    ModelTolerance,
    TermKind,
)
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval, MovingSupport, Support
from forcetorque.robot.mechanics.root_motion import imu_frame
from forcetorque.robot.mechanics.sub_model_equations import heavy_bodies, joints_of_part
from forcetorque.robot.mechanics.wrench_derivatives import part_derivatives
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import SubModel, sub_models
from forcetorque.robot.tree import Body, BodyTree, Connection, build_tree, path_to_root

SAMPLES_PER_WINDOW: Final = 10
"""Samples of a window at which the columns are computed: what the model may have wrong moves no faster than a robot."""
_CABLE_JOINTS: Final = 6
"""Most joints on either side of the sensor whose cables reach across it: as many as a limb has."""
_BLOCK: Final = 4096
"""Samples that are differentiated at once."""
_ROUNDING: Final = 1e-6
"""Share of the largest effect of a term below which one is rounding, such as that of a yaw about gravity."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UncertainPart:
    """The part of a robot beyond a sensor, and what may be wrong with its model."""

    tree: BodyTree
    """The robot with what is attached, rooted at the link whose motion is known."""
    bare: BodyTree
    """The robot without: what is attached is specified or identified by itself."""
    part: SubModel
    """The part."""
    tolerance: ModelTolerance
    """How far the model may be off."""
    terms: tuple[ErrorTerm, ...]
    """Masses and centres of its links, zeros of the joints between the root and these, acceleration of the root, and
    what cables and covers pull as joints near the sensor move."""

    @classmethod
    def of(cls, tree: BodyTree, bare: BodyTree, sensor: str, tolerance: ModelTolerance) -> UncertainPart | None:
        """Find the part.

        Args:
            tree: As of the class.
            bare: As of the class.
            sensor: Name of the sensor.
            tolerance: As of the class.

        Returns:
            The part; None where the model is exact, or no link beyond the sensor has inertia.
        """
        if tolerance == EXACT:
            return None
        part = next((part for part in sub_models(tree, [sensor]) if part.sensor == sensor), None)
        if part is None or not heavy_bodies(tree, part):
            return None
        terms = (*error_terms(bare, [part], tolerance), *_cable_terms(tree, part, tolerance))
        return cls(tree=tree, bare=bare, part=part, tolerance=tolerance, terms=terms)

    @property
    def joints(self) -> tuple[str, ...]:
        """Joints that the expected wrench depends on."""
        return joints_of_part(self.tree, self.part)

    def without(self, *kinds: TermKind) -> UncertainPart:
        """Leave out the terms of some kinds.

        Returns:
            The part with the others.
        """
        return replace(self, terms=tuple(term for term in self.terms if term.kind not in kinds))

    def terms_in(self, recording: str) -> tuple[ErrorTerm, ...]:
        """Name the terms, and the delay of the readings, in a recording.

        Args:
            recording: Its name, which the acceleration gets: another recording may have another error.

        Returns:
            The terms of `derivatives`.
        """
        own = (
            term.model_copy(update={"name": f"{term.name} in {recording}"})
            if term.kind is TermKind.ACCELERATION
            else term
            for term in self.terms
        )
        return (*own, *delay_terms([recording], self.tolerance))

    def derivatives(self, joints: JointMotion, root: RootMotion, rates: FloatArray) -> FloatArray:
        """Differentiate the expected wrench by the terms, and by the delay of the readings where there may be one.

        Args:
            joints: Motion of at least `joints`; n samples.
            root: Motion of the root link's frame; one sample or n.
            rates: Rates of change of the expected wrench; shape (n, 6); N/s, N m/s.

        Returns:
            Derivatives; shape (n, 6, terms); N, N m per unit of the term.
        """
        blocks = [slice(start, start + _BLOCK) for start in range(0, len(joints), _BLOCK)]
        late = self.tolerance.delay_s > 0.0
        derivatives = np.empty((len(self.terms) + late, 6, len(joints)))
        for block in blocks if self.terms else ():
            self._differentiate(joints.samples(block), root.samples(block), derivatives[:, :, block])
        if late:
            derivatives[-1] = -rates.T
        return derivatives.transpose(2, 1, 0)

    def _differentiate(self, joints: JointMotion, root: RootMotion, out: FloatArray) -> None:
        """Fill in derivatives by `terms`; shape (terms, 6, n)."""
        places = {term.name: place for place, term in enumerate(self.terms)}
        out[:] = 0.0
        for name in list(places):
            if (kind := next((own for own in (PULL, TWIST) if own in name), None)) is not None:
                axis, _, joint = name.partition(kind)
                component = "xyz".index(axis) + (3 if kind == TWIST else 0)
                out[places.pop(name), component] = joints.position[:, joints.names.index(joint)]
        of_joints = {f"{ZERO}{joint}": joint for joint in self.joints}
        bodies = {k: terms_of_body(self.bare, k) for k in heavy_bodies(self.tree, self.part)}
        bodies = {k: names for k, names in bodies.items() if not places.keys().isdisjoint(names)}
        found = part_derivatives(
            self.tree,
            self.part,
            joints,
            root,
            bare=self.bare,
            axes={k: link_axes(self.bare, k) for k in bodies},
            turned=[of_joints[name] for name in places if name in of_joints],
        )
        columns = columns_of_terms(self.bare, found)
        for name, place in places.items():
            out[place] = columns[name]


def _cable_terms(tree: BodyTree, part: SubModel, tolerance: ModelTolerance) -> Iterator[ErrorTerm]:
    """What cables and covers across a sensor may pull per rad of the joints near it; not of joints that slide.

    A joint that mimics is no unknown: its cables pull in proportion to the position of its leader, near the sensor or
    not, which has one unknown for all joints that it moves.
    """
    if not tolerance.cable_N_rad:
        return
    sliding, known = sliding_joints(tree), joints_of_part(tree, part)
    before = [tree.bodies[k] for k in path_to_root(tree, part.base) if tree.bodies[k].coordinate is not None]
    squares: dict[str, float] = {}
    for body in (*reversed(before[:_CABLE_JOINTS]), *islice(_limb_beyond(tree, part), _CABLE_JOINTS)):
        coordinate = body.coordinate
        if coordinate is None or coordinate.joint not in known:
            continue
        if body.connection is Connection.ROTARY and coordinate.joint not in sliding:
            squares[coordinate.joint] = squares.get(coordinate.joint, 0.0) + coordinate.multiplier**2
    for joint, square in squares.items():
        pull = tolerance.cable_N_rad * float(np.sqrt(square))
        for axis in "xyz":
            yield ErrorTerm(name=f"{axis}{PULL}{joint}", kind=TermKind.PULL, deviation=pull)
            yield ErrorTerm(name=f"{axis}{TWIST}{joint}", kind=TermKind.TWIST, deviation=CABLE_LEVER_M * pull)


def _limb_beyond(tree: BodyTree, part: SubModel) -> Iterator[Body]:
    """Give the bodies behind the joints of the limb beyond a sensor, the nearest first.

    A limb is a chain of links: it ends at a link with more than two joints, such as a pelvis, a chest or a palm. So a
    leg that stands and carries the robot has its own joints, none of waist, arms and the other leg. Other sensors do
    not divide a link.
    """
    link = {part.base}
    while True:
        onward: list[int] = []
        for k, body in enumerate(tree.bodies):  # parents come before children
            if body.parent in link and body.connection is Connection.CUT:
                link.add(k)
            elif body.parent in link:
                onward.append(k)
        if len(onward) != 1:
            return
        yield tree.bodies[onward[0]]
        link = set(onward)


def model_columns(run: SensorRun, interval: Interval, data: DataSet) -> tuple[tuple[ErrorTerm, ...], FloatArray]:
    """Differentiate the expected wrenches of a sensor by what the robot model may have wrong.

    The numbers are masses and centres of the links beyond the sensor, zeros of the joints between the support and
    these, the acceleration of the support frame, the delay of the readings, and what cables and covers add as the
    joints near the sensor move, in proportion to their positions. Tolerances are those of the experiment.
    Attached loads are taken as they were specified or identified.

    Args:
        run: The sensor.
        interval: An interval of it.
        data: The fitted samples of the interval.

    Returns:
        The numbers, and derivatives by them, means over the windows of `data`; shape (w, 6, terms); N, N m per unit of
        the term. No terms where the model is exact, no link beyond the sensor has inertia, or where a load stands in
        for the robot.
    """
    picked, window = _picked(data)
    at_ns = np.round(data.time_s[picked] * 1e9).astype(np.int64)
    terms, columns = derivatives_at(run, interval, data.recording, at_ns, _rates(data)[picked])
    means = _means(columns, window[picked], int(window[-1]) + 1)
    effect = np.abs(means).max(axis=(0, 1)) * [term.deviation for term in terms]
    # moments without cables are of an earlier version; where all joints are at zero they pull nothing
    of_cables = np.array([term.kind in OF_CABLES for term in terms], dtype=bool)
    moved = of_cables | (effect > _ROUNDING * effect.max(initial=0.0))
    return tuple(term for term, used in zip(terms, moved, strict=True) if used), means[:, :, moved]


def derivatives_at(
    run: SensorRun,
    interval: Interval,
    recording: str,
    at_ns: IntArray,
    rates: FloatArray,
    *,
    without: Sequence[TermKind] = (),
) -> tuple[tuple[ErrorTerm, ...], FloatArray]:
    """Differentiate the expected wrench of a sensor at instants by what the robot model may have wrong.

    Args:
        run: The sensor.
        interval: An interval of it.
        recording: Name of the recording, as `UncertainPart.terms_in` takes it.
        at_ns: Instants; shape (n,); ns.
        rates: Rates of change of the expected wrench at these; shape (n, 6); N/s, N m/s.
        without: Kinds of numbers that are left out.

    Returns:
        The numbers, and derivatives by them; shape (n, 6, terms); N, N m per unit of the term; NaN in gaps. No terms in
        the cases that `model_columns` names.
    """
    nothing = ((), np.zeros((len(at_ns), 6, 0)))
    experiment, support, loads = run.experiment, interval.support, run.experiment.loads
    tolerance = experiment.fit_options.tolerance
    of_load = loads is not None and (loads.applied is not None or loads.in_place_of_robot)
    if support is None or of_load:
        return nothing
    tree = build_tree(experiment.model_on(support), support.frame)
    bare = tree if loads is None else build_tree(experiment.model, support.frame)
    uncertain = UncertainPart.of(tree, bare, run.sensor.name, tolerance)
    if uncertain is None:
        return nothing
    left_out = () if _measured_at_root(run, support, tree) else (TermKind.ACCELERATION,)
    uncertain = uncertain.without(*without, *left_out)
    terms = uncertain.terms_in(recording)
    if not terms:
        return nothing
    joints, root = run.motion_at(support, uncertain.joints, at_ns)
    return terms, uncertain.derivatives(joints, root, rates)


def _measured_at_root(run: SensorRun, support: Support | MovingSupport, tree: BodyTree) -> bool:
    """Whether the acceleration is known in the frame of the support, where an error of it is constant."""
    if isinstance(support, Support):
        return True
    frame = imu_frame(run.experiment.model, run.experiment.recording, support)
    return tree.frames[frame][0] == tree.frames[support.frame][0]


def _picked(data: DataSet) -> tuple[IntArray, IntArray]:
    """Samples at which the columns are computed, and the number of the window of every sample."""
    window = data.window
    starts = np.flatnonzero(np.diff(window, prepend=-1))
    counts = np.diff(starts, append=len(window))
    step = np.maximum(counts // SAMPLES_PER_WINDOW, 1)
    place = np.arange(len(window)) - starts[window]
    return np.flatnonzero((place - step[window] // 2) % step[window] == 0), window


def _rates(data: DataSet) -> FloatArray:
    """Rate of change of the expected wrench; shape (n, 6); N/s, N m/s; zero where no time passes."""
    if len(data.time_s) < 2 or not (np.diff(data.time_s) > 0.0).all():
        return np.zeros_like(data.reference)
    return np.gradient(data.reference, data.time_s - data.time_s[0], axis=0)


def _means(columns: FloatArray, window: IntArray, windows: int) -> FloatArray:
    """Means over windows of what is finite; zero where nothing is; shape (windows, 6, terms)."""
    whole = np.isfinite(columns).all(axis=(1, 2))
    total = np.zeros((windows, *columns.shape[1:]))
    filled, starts = np.unique(window[whole], return_index=True)
    if len(filled):
        total[filled] = np.add.reduceat(columns if whole.all() else columns[whole], starts, axis=0)
    return total / np.maximum(np.bincount(window[whole], minlength=windows), 1)[:, None, None]
