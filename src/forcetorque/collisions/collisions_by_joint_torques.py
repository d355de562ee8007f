# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of an arm by what its joint torques show beyond the model, without a force-torque sensor (thesis 2.5).

Friction, offsets of the torques and masses that are off move the observed external torques in known directions, each by
a size that is known in advance. Samples without contact tell them; what stays unknown of them, and the noise, is the
covariance of a window. A joint shows a contact where its squared torque over its variance exceeds its threshold.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.window_means import means_over
from forcetorque.base.units import NORMAL_95
from forcetorque.collisions.contact_free_model import FreeModel
from forcetorque.collisions.detection import Release, Threshold, threshold_of
from forcetorque.collisions.momentum_observer import CUT_OFF_HZ, ArmMotion, external_torque, low_passed
from forcetorque.collisions.result import JointCollisions, JointRow, TorqueContactRow, TorqueCurve
from forcetorque.collisions.sensor_residual import PAUSE_S, WARM_UP_S, WINDOW_S
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.named_files import stated_in
from forcetorque.recording.recording import Interval, Use

LEAST_FREE_S: Final = 45.0
"""Time without contact below which the tail of the noise is not known: friction where a joint turns round makes it
heavier than that of normal noise, which alone lets several times the stated false alarms through."""
_SHARE: Final = 0.1
"""Prior standard deviation of offset, of Coulomb and of viscous friction, over the torque that 95 % of the samples of
a joint stay below."""
_MASS: Final = 0.05
"""Prior standard deviation of the mass of a link, relative."""
_UNMODELLED: Final = 0.005
"""Slow errors that no term explains, over the same torque."""
_SLOW: Final = 0.02
"""Velocity over which Coulomb friction changes its sign; rad/s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Windows:
    """An interval in w windows."""

    interval: Interval
    """The interval."""
    time_s: FloatArray
    """Middles; shape (w,); s."""
    torque: FloatArray
    """External torques; shape (w, j); N m."""
    terms: FloatArray
    """What errors of one standard deviation add; shape (w, j, p)."""

    def left(self, model: FreeModel) -> tuple[FloatArray, FloatArray]:
        """Give what no error explains, and its variance without contact; shape (w, j) each."""
        return _left(self.torque, self.terms, model)


def find_joint_collisions(
    experiment: Experiment, intervals: Collection[str], free: Collection[str], alarms_per_hour: float
) -> JointCollisions:
    """Look for contacts by joint torques.

    Args:
        experiment: The experiment, with torques of joints and a base at rest.
        intervals: Labels of the intervals to look at; all that are not ignored if there is none.
        free: Labels of intervals in which nothing touches the robot; those for calibration if there is none.
        alarms_per_hour: Rate of false alarms of all joints together that thresholds are set for.

    Returns:
        Contacts, and what joints notice.

    Raises:
        ExperimentError: If there is no interval, too little time without contact, or the rate is not above 0.
    """
    if not 0.0 < alarms_per_hour <= 3600.0:
        raise ExperimentError(f"alarms per hour: expected a number above 0 and up to 3600, got {alarms_per_hour:g}")
    every = {one.label: one for one in experiment.recording.intervals if one.use is not Use.IGNORE}
    for label in (*intervals, *free):
        if label not in every:
            raise ExperimentError(
                f"no interval is labelled {label!r} that is not ignored; known: {', '.join(every) or 'none'}"
            )
    watched = [every[label] for label in intervals] or list(every.values())
    learnt = [every[label] for label in free] or [one for one in watched if one.use is Use.CALIBRATION]
    if not learnt or not watched:
        raise ExperimentError(
            "expected an interval in which nothing touches the robot, from which friction and noise are learnt; name "
            "one by --free, from Python free"
        )
    arms = {one.label: _arm(experiment, one) for one in {one.label: one for one in (*watched, *learnt)}.values()}
    scale = np.percentile(np.abs(np.concatenate([arms[one.label].torque for one in learnt])), 95, axis=0)
    windows = {label: _windows(every[label], arm, scale) for label, arm in arms.items()}
    joints = arms[watched[0].label].joints
    model, thresholds = _learnt([windows[one.label] for one in learnt], scale, alarms_per_hour)
    rows = [
        row
        for one in watched
        for row in _contacts(windows[one.label], arms[one.label], model, np.array([each.value for each in thresholds]))
    ]
    looked = [windows[one.label] for one in watched]
    return JointCollisions(
        experiment=experiment.name,
        contacts=tuple(sorted(rows, key=lambda row: row.start_s)),
        joints=tuple(_joint_rows(joints, looked, [windows[one.label] for one in learnt], model, thresholds)),
        alarms_per_hour=alarms_per_hour,
        free_s=thresholds[0].free_s,
        looked_at_s=sum(len(one.time_s) for one in looked) * WINDOW_S,
        curves=tuple(_curves(joints, looked, model, thresholds)),
        warnings=tuple(
            f"contacts in {one.label}, from which friction and noise are learnt: what touches there is noticed less; "
            "name intervals without contact by --free"
            for one in learnt
            if any(row.interval == one.label for row in rows)
        ),
    )


def _arm(experiment: Experiment, interval: Interval) -> ArmMotion:
    with stated_in(f"interval {interval.label!r}"):
        arm = ArmMotion.of(experiment, interval)
        if len(arm.time_s) < 2 or float(np.median(np.diff(arm.time_s))) > 1.01 * WINDOW_S:
            raise ExperimentError(f"expected joints at {1.0 / WINDOW_S:g} Hz at least; record them faster")
        return arm


def _windows(interval: Interval, arm: ArmMotion, scale: FloatArray) -> _Windows:
    torque = external_torque(arm)
    count, joints = torque.shape
    places = [arm.motion.names.index(joint) for joint in arm.joints]
    velocity = arm.motion.velocity[:, places]
    fastest = np.maximum(np.percentile(np.abs(velocity), 95, axis=0), _SLOW)
    own = np.zeros((count, joints, 3, joints))
    for k in range(joints):
        own[:, k, 0, k] = _SHARE * scale[k]
        own[:, k, 1, k] = _SHARE * scale[k] * np.tanh(velocity[:, k] / _SLOW)
        own[:, k, 2, k] = _SHARE * scale[k] * velocity[:, k] / fastest[k]
    terms = np.concatenate([own.reshape(count, joints, -1), _MASS * arm.gravity_of_links()], axis=2)
    filtered = low_passed(arm.time_s, terms.reshape(count, -1), CUT_OFF_HZ)
    time_s, means, _ = means_over(arm.time_s, np.hstack([torque, filtered]), WINDOW_S)
    # until filters have settled, also after pauses
    starts = time_s[np.diff(time_s, prepend=-np.inf) > PAUSE_S]
    settled = time_s - starts[np.searchsorted(starts, time_s, side="right") - 1] >= WARM_UP_S
    return _Windows(
        interval=interval,
        time_s=time_s[settled],
        torque=means[settled, :joints],
        terms=means[settled, joints:].reshape(-1, joints, terms.shape[2]),
    )


def _learnt(
    free: Sequence[_Windows], scale: FloatArray, alarms_per_hour: float
) -> tuple[FreeModel, tuple[Threshold, ...]]:
    torque, terms = (np.concatenate([getattr(one, name) for one in free]) for name in ("torque", "terms"))
    free_s = len(torque) * WINDOW_S
    if free_s < LEAST_FREE_S:
        raise ExperimentError(
            f"expected at least {LEAST_FREE_S:g} s in which nothing touches the robot, got {free_s:.2g} s; name longer "
            "intervals by --free, from Python free"
        )
    unmodelled = _UNMODELLED * scale
    model = FreeModel.of(torque, terms, unmodelled)
    joints, half = torque.shape[1], len(torque) // 2
    # each half by what the other tells: what was learnt from fits too well
    statistic = np.concatenate(
        [
            _statistic(torque[own], terms[own], FreeModel.of(torque[other], terms[other], unmodelled))
            for own, other in ((slice(half), slice(half, None)), (slice(half, None), slice(half)))
        ]
    )
    return model, tuple(
        _threshold(statistic[:, k], model.correlation_s, alarms_per_hour / joints) for k in range(joints)
    )


def _statistic(torque: FloatArray, terms: FloatArray, model: FreeModel) -> FloatArray:
    left, variance = _left(torque, terms, model)
    return left**2 / variance


def _threshold(statistic: FloatArray, correlation_s: float, alarms_per_hour: float) -> Threshold:
    """The threshold of one joint, wider where errors beyond what was learnt from are larger than the model has them."""
    wider = max(1.0, float(statistic.mean()))
    threshold = threshold_of(statistic / wider, correlation_s, alarms_per_hour=alarms_per_hour, components=1)
    return replace(threshold, value=wider * threshold.value)


def _left(torque: FloatArray, terms: FloatArray, model: FreeModel) -> tuple[FloatArray, FloatArray]:
    """What no error explains, and its variance without contact; shape (w, j) each."""
    variance = np.diag(model.noise) + np.einsum("wjp,pq,wjq->wj", terms, model.covariance, terms, optimize=True)
    return torque - terms @ model.mean, variance


def _contacts(
    windows: _Windows, arm: ArmMotion, model: FreeModel, thresholds: FloatArray
) -> Sequence[TorqueContactRow]:
    left, variance = windows.left(model)
    ratio = left**2 / variance / thresholds  # (w, j)
    rows = []
    for span in _spans(ratio.max(axis=1), windows.time_s):
        size = ratio[span]
        window, clearest = np.unravel_index(int(size.argmax()), size.shape)
        outermost = int(np.flatnonzero(size[window] > 1.0)[-1])
        rows.append(
            TorqueContactRow(
                interval=windows.interval.label,
                start_s=float(windows.time_s[span][0]) - 0.5 * WINDOW_S,
                end_s=float(windows.time_s[span][-1]) + 0.5 * WINDOW_S,
                link=arm.moved_link(arm.joints[outermost]),
                joint=arm.joints[int(clearest)],
                torque_Nm=float(left[span][window, clearest]),
                half_width_95_Nm=NORMAL_95 * float(np.sqrt(variance[span][window, clearest])),
                over_threshold=float(np.sqrt(size[window, clearest])),
            )
        )
    return rows


def _spans(ratio: FloatArray, time_s: FloatArray) -> Sequence[slice]:
    """Spans that begin above 1, and end as contacts do or before a pause."""
    spans, start, release = [], None, Release()
    pauses = np.diff(time_s, prepend=time_s[:1]) > PAUSE_S
    for k, value in enumerate(ratio):
        if start is not None and pauses[k]:
            spans.append(slice(start, k - release.quiet))
            start = None
        if start is None and value > 1.0:
            start, release = k, Release()
        if start is not None and release.follows(value):
            spans.append(slice(start, k + 1 - release.quiet))
            start = None
    if start is not None:
        spans.append(slice(start, len(ratio) - release.quiet))
    return spans


def _joint_rows(
    joints: Sequence[str],
    looked: Sequence[_Windows],
    free: Sequence[_Windows],
    model: FreeModel,
    thresholds: Sequence[Threshold],
) -> Sequence[JointRow]:
    variance = np.median(np.concatenate([one.left(model)[1] for one in looked]), axis=0)
    explained = np.concatenate([one.terms @ model.mean for one in free])
    return [
        JointRow(
            joint=joint,
            threshold_Nm=float(np.sqrt(thresholds[k].value * variance[k])),
            noise_Nm=float(np.sqrt(model.noise[k, k])),
            explained_Nm=float(np.sqrt((explained[:, k] ** 2).mean())),
        )
        for k, joint in enumerate(joints)
    ]


def _curves(
    joints: Sequence[str], looked: Sequence[_Windows], model: FreeModel, thresholds: Sequence[Threshold]
) -> Sequence[TorqueCurve]:
    time_s = np.concatenate([one.time_s for one in looked])
    order = np.argsort(time_s, kind="stable")
    parts = [one.left(model) for one in looked]
    over = np.concatenate([left / np.sqrt(variance) for left, variance in parts])
    return [
        TorqueCurve(joint=joint, time_s=time_s[order], over_threshold=over[order, k] / np.sqrt(thresholds[k].value))
        for k, joint in enumerate(joints)
    ]
