# SPDX-License-Identifier: BSD-3-Clause
"""Findings on the recording of an experiment: streams, sensors against the model, taxels."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeVar, cast

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, true_runs
from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import recover_raw
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.sample_quality import sample_quality
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison_with_model import Comparison, compared
from forcetorque.inspection.diagnosis import diagnosed, fault_finding, stability_of
from forcetorque.inspection.plausibility.fault_hypotheses import Explanation
from forcetorque.inspection.plausibility.gate import FEWEST, examine
from forcetorque.inspection.residual_findings import UNEXPLAINED, model_findings
from forcetorque.recording.joint_jumps import JUMPS, are_ignored
from forcetorque.recording.recording import Finding, Interval, MovingSupport, Recording, Support, Use
from forcetorque.recording.stream_faults import frozen_finding, saturation_findings, stream_findings
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.taxels.pressure_cycles import patch_recordings
from forcetorque.skin.taxels.taxel_faults import TaxelFault, taxel_faults

_Found = TypeVar("_Found")

_UNRELIABLE = UNEXPLAINED | {"drift", "saturation", "frozen", "stuck", "gap", "backward_stamp", "joint_jump"}
"""Kinds of findings that make the samples of their interval unreliable."""


def inspect_recording(recording: Recording) -> tuple[Finding, ...]:
    """Find faults of a recording, without a robot.

    Returns:
        Findings of its readers and of single streams; of patches that share their messages, one for all of them.
    """
    ignored = [(one.start_ns, one.end_ns) for one in recording.intervals if one.use is Use.IGNORE]
    jumps = [one for one in recording.findings if one.left_out_ns]
    left_out = {
        name: np.unique([stamp for one in jumps if one.stream == name for stamp in one.left_out_ns])
        for name in {one.stream for one in jumps}
    }

    def is_of_jump(one: Finding) -> bool:
        """Whether all samples that lack a position do so because of a jump."""
        if (one.kind, one.channel) != ("missing", "position") or one.stream not in left_out:
            return False
        first, end = np.searchsorted(left_out[one.stream], [one.start_ns or 0, (one.end_ns or 0) + 1])
        return bool(end - first == one.count)

    found = (
        *(
            one
            for one in recording.findings
            if not (one.kind in JUMPS and are_ignored(recording.stream(one.stream).stamp_ns, one, ignored))
        ),
        *(found for one in recording.streams.values() for found in stream_findings(one) if not is_of_jump(found)),
    )
    messages = {
        name: (stream.clock, stream.stamp_ns.tobytes())
        for name, stream in recording.streams.items()
        if _OF_SKIN & set(stream.signals)
    }
    streams: dict[tuple[object, Finding], list[str]] = {}
    for finding in found:
        key = (messages.get(finding.stream, finding.stream), replace(finding, stream=""))
        streams.setdefault(key, []).append(finding.stream)
    return tuple(
        replace(finding, stream=names[0])
        if len(names) == 1 or names[0] not in messages
        else replace(finding, stream=names[0], message=f"{finding.message}; the same of {', '.join(names[1:])}")
        for (_, finding), names in streams.items()
    )


_OF_SKIN = {"skin_event", "taxel_counts"}
"""Quantities of which one message has those of several patches."""


def inspect_experiment(
    experiment: Experiment,
    *,
    by_model: bool = True,
    with_causes: bool = True,
    calibrations: Mapping[str, Calibration] | None = None,
    sensors: Collection[str] | None = None,
    computed: SensorRun | None = None,
    progress: Progress = lambda _: None,
) -> tuple[Finding, ...]:
    """Find faults of the recording of an experiment, with its robot and sensors, each of which is compared once.

    The sensors are compared with the model over the whole log where all intervals have one support
    frame, else inside each interval. With a distal contact, or where the model cannot be evaluated, the
    reason is a finding.

    Args:
        experiment: The experiment.
        by_model: Whether sensors are compared with the model, which has no contact but the support.
        with_causes: Whether faults of experiment file, URDF and log are looked for, about a second per sensor.
        calibrations: Calibrations that read the sensors in place of their priors, by the name of the sensor.
        sensors: Names of the sensors to inspect; all if None.
        computed: One of them, whose samples need not be computed again; further samples are not kept in it.
        progress: Called with the time that is left, of a log that takes longer than a few seconds.

    Returns:
        Findings in the order of time, those without a time first.
    """
    inspected = [sensor for sensor in experiment.sensors if sensors is None or sensor.name in sensors]
    shared = SharedWrenches(experiment.recording, {sensor.name: sensor.stream for sensor in inspected})
    time_left = TimeLeft(progress, f"inspecting {experiment.name}", len(inspected) * _STEPS)
    findings = list(_once(experiment, "streams", lambda: inspect_recording(experiment.recording)))
    for number, sensor in enumerate(inspected):
        time_left.at(number * _STEPS)
        findings = _with_all_frozen(experiment, sensor, findings)
        try:
            findings += _saturation(experiment, sensor)
        except ForceTorqueError as error:
            text = f"no look for saturation: {error}"
            findings.append(Finding(stream=sensor.stream, kind="not_compared", message=text, count=0))
        if by_model:
            calibration = (calibrations or {}).get(sensor.name)
            run = SensorRun(experiment, sensor, shared=shared)
            if computed is not None and computed.sensor is sensor:
                run = computed.copy()
            at_half = partial(time_left.at, number * _STEPS + 1)
            compared_sensor = _model_findings(run, calibration, with_causes=with_causes, at_half=at_half)
            findings += (replace(one, sensor=sensor.name) for one in compared_sensor)
    return tuple(sorted(findings, key=lambda finding: finding.start_ns or 0))


_STEPS = 2
"""Steps of the inspection of a sensor whose ends are reported: search for causes, and for events."""


def _once(experiment: Experiment, key: Hashable, find: Callable[[], _Found]) -> _Found:
    """What is found of an experiment, computed when it is first needed."""
    if key not in experiment.inspections:
        experiment.inspections[key] = find()
    return cast("_Found", experiment.inspections[key])


def unreliable_intervals(
    experiment: Experiment,
    use: Use,
    *,
    by_model: bool = True,
    sensors: Collection[str] | None = None,
    computed: SensorRun | None = None,
) -> tuple[tuple[Interval, Finding], ...]:
    """Select the findings of `inspect_experiment` inside the intervals of one use.

    Args:
        experiment: The experiment.
        use: Use of the intervals.
        by_model: As of `inspect_experiment`.
        sensors: As of `inspect_experiment`.
        computed: As of `inspect_experiment`.

    Returns:
        Interval and finding, for findings that make its samples unreliable.
    """
    # a fit checks the causes by itself
    found = inspect_experiment(experiment, by_model=by_model, with_causes=False, sensors=sensors, computed=computed)
    return unreliable_among(found, experiment, use)


def unreliable_among(
    found: Sequence[Finding], experiment: Experiment, use: Use
) -> tuple[tuple[Interval, Finding], ...]:
    """Select findings inside the intervals of one use.

    Args:
        found: Findings of `inspect_experiment`.
        experiment: The experiment, with its intervals.
        use: Use of the intervals.

    Returns:
        Interval and finding, for findings that make its samples unreliable.
    """
    findings = [finding for finding in found if finding.kind in _UNRELIABLE]
    return tuple(
        (interval, finding)
        for interval in experiment.recording.intervals
        if interval.use is use
        for finding in findings
        if finding.start_ns is not None
        and finding.end_ns is not None
        and finding.start_ns < interval.end_ns
        and finding.end_ns >= interval.start_ns
    )


def _with_all_frozen(experiment: Experiment, sensor: ExperimentSensor, findings: Sequence[Finding]) -> list[Finding]:
    """Findings with the frozen intervals that fits leave out, also those that only the model shows."""
    stream = experiment.recording.stream(sensor.stream)
    named = [
        frozen_finding(stream, sensor.quantity, run) for run in true_runs(sample_quality(experiment, sensor).frozen)
    ]
    frozen = [replace(finding, message=f"{finding.message}; left out of every fit and evaluation") for finding in named]

    def is_named(finding: Finding) -> bool:
        return (finding.stream, finding.channel) == (stream.name, sensor.quantity) and any(
            finding.start_ns == other.start_ns or finding.kind == "frozen" for other in frozen
        )

    return [*(finding for finding in findings if not is_named(finding)), *frozen]


def _saturation(experiment: Experiment, sensor: ExperimentSensor) -> tuple[Finding, ...]:
    stream = experiment.recording.stream(sensor.stream)
    counts = stream.signal(sensor.quantity).values
    recovered = sensor.quantity == "wrench"
    if recovered:
        if sensor.prior is None:
            return ()
        counts = recover_raw(counts, sensor.prior)
    return saturation_findings(stream, counts, limit_counts=sensor.limit_counts, recovered=recovered)


def _model_findings(
    run: SensorRun, calibration: Calibration | None, *, with_causes: bool, at_half: Callable[[], None]
) -> Iterator[Finding]:
    stream = run.sensor.stream
    if run.sensor.quantity == "raw" and run.sensor.prior is None and calibration is None:
        return
    correction = run.read_by(None, calibration).bare
    supported = [one for one in run.experiment.recording.intervals if _has_motion(one.support)]
    touched = {interval.label: run.touched_beyond(interval) for interval in supported}
    unknown = [label for label, names in touched.items() if names]
    fault = None
    if with_causes and len(unknown) < len(supported):
        over = [] if unknown else over_the_whole_log(run.experiment, supported)
        whole = over[0] if len(over) == 1 else None
        if calibration is None:
            causes, fault = _once(run.experiment, ("causes", run.sensor.name), lambda: _causes(run, correction, whole))
        else:
            causes, fault = _causes(run, correction, whole)
        yield from causes
        at_half()
    if unknown:
        names = dict.fromkeys(name for label in unknown for name in touched[label])
        text = (
            f"no comparison with the model over {', '.join(unknown)}: {', '.join(names)} touches the robot beyond the "
            "sensor"
        )
        yield Finding(stream=stream, kind="not_compared", message=text, count=0)
        supported = [interval for interval in supported if interval.label not in unknown]
    else:
        supported = over_the_whole_log(run.experiment, supported)
    if fault is not None and not fault.changes_every_instant_alike:
        return
    turn = None if fault is None else fault.turn
    for interval in supported:
        if calibration is None and turn is None:
            key = ("events", run.sensor.name, interval.label, interval.start_ns, interval.end_ns)
            against = partial(_against_model_or_reason, run, interval, correction, turn)
            yield from _once(run.experiment, key, against)
        else:
            yield from _against_model_or_reason(run, interval, correction, turn)


def _has_motion(support: Support | MovingSupport | None) -> bool:
    """Whether something says how the support moves, as nothing does of a sensor by itself."""
    return isinstance(support, Support) or (support is not None and not support.is_unknown)


def _causes(
    run: SensorRun, correction: Correction, whole_log: Interval | None
) -> tuple[tuple[Finding, ...], Explanation | None]:
    """Faults of experiment file, URDF and log, or why there is no test; and the best fault."""
    try:
        whole = None if whole_log is None else _samples(run, whole_log, correction)
        comparison = compared(run, correction, whole=whole)
        diagnosis = None if comparison is None or not run.sensor.measured.all() else diagnosed(comparison)
    except ForceTorqueError:
        return (), None  # the comparison of every interval names the reason
    if comparison is None:
        return (), None
    if not run.sensor.measured.all():
        text = "sense, gravity, joints, columns, units, mount and delay are not tested: that takes six components"
        untested = Finding(stream=run.sensor.stream, kind="not_compared", message=text, count=0)
        return (untested, *_implausible(run, comparison)), None
    if diagnosis is None:
        text = (
            "sense, gravity, joints, columns, units, mount and delay are not tested: the expected wrench stays the "
            "same; record the limb while it moves"
        )
        return (Finding(stream=run.sensor.stream, kind="not_compared", message=text, count=0),), None
    if diagnosis.faults:
        return (fault_finding(comparison, diagnosis),), diagnosis.faults[0]
    return tuple(_implausible(run, comparison)), None


def _samples(run: SensorRun, interval: Interval, correction: Correction) -> IntervalSamples:
    return run.interval_samples(interval, variables=correction.variables, smoothed=False, with_flattening=False)


def _implausible(run: SensorRun, comparison: Comparison) -> Iterator[Finding]:
    """What the plausibility checks of `calibrate` refuse or warn of, without a fault that explains it."""
    stream = run.sensor.stream
    data_sets = [
        part.data_set
        for part in comparison.parts
        if part.interval.use is Use.CALIBRATION and not run.possibly_touched(part.interval)
    ]
    if sum(len(data.raw) for data in data_sets) < FEWEST:
        return  # the comparison above had more samples
    try:
        doubts = examine(data_sets, run.sensor.prior, run.sensor.full_scale)
    except FitError as error:
        yield Finding(stream=stream, kind="implausible", message=f"`calibrate` refuses: {error}", count=0)
        return
    for doubt in doubts:
        yield Finding(stream=stream, kind=f"implausible_{doubt.kind}", message=doubt.message, count=0)


def whole_log_samples(run: SensorRun, correction: Correction) -> IntervalSamples | None:
    """Pair reading and expected wrench over the whole log.

    Args:
        run: The sensor.
        correction: How it is read.

    Returns:
        The samples, not smoothed; None where intervals have several supports.
    """
    supported = [interval for interval in run.experiment.recording.intervals if interval.support is not None]
    over = over_the_whole_log(run.experiment, supported)
    return _samples(run, over[0], correction) if len({id(one.support) for one in supported}) == 1 else None


def over_the_whole_log(experiment: Experiment, supported: Sequence[Interval]) -> list[Interval]:
    """Give the intervals in which a sensor can be compared with the model.

    Args:
        experiment: The experiment.
        supported: Its intervals with a support.

    Returns:
        One of the whole log if there is one support, else the intervals.
    """
    if len({id(interval.support) for interval in supported}) != 1:
        return list(supported)
    start, end = experiment.recording.span_ns
    return [replace(supported[0], label="the whole log", start_ns=start, end_ns=end + 1, use=Use.VALIDATION)]


def _against_model_or_reason(
    run: SensorRun, interval: Interval, correction: Correction, turn: FloatArray | None
) -> tuple[Finding, ...]:
    try:
        return _against_model(run, interval, correction, turn)
    except ForceTorqueError as error:
        text = f"no comparison with the model over {interval.label}: {error}"
        return (Finding(stream=run.sensor.stream, kind="not_compared", message=text, count=0),)


def _against_model(
    run: SensorRun, interval: Interval, correction: Correction, turn: FloatArray | None
) -> tuple[Finding, ...]:
    """Findings over an interval, beside a fault that turns or scales the wrench alike at every instant."""
    part = _samples(run, interval, correction)
    stamps, expected = part.samples.stamp_ns, run.sensor.expected_reading(part.samples.reference)
    in_use = _in_use(run.experiment, stamps)
    if not in_use.any():
        return ()
    return model_findings(
        run.sensor.stream,
        stamps,
        part.readings.wrench(correction),
        expected if turn is None else expected @ turn.T,
        in_use=in_use,
        stability=stability_of(run.sensor),
    )


def _in_use(experiment: Experiment, stamp_ns: IntArray) -> BoolArray:
    used = np.zeros(len(stamp_ns), dtype=bool)
    for interval in experiment.recording.intervals:
        if interval.use is not Use.IGNORE:
            used |= interval.holds(stamp_ns)
    return used


_NAMED = 12
"""Largest number of taxels that a message names."""


def inspect_patches(experiment: PatchExperiment) -> tuple[Finding, ...]:
    """Find faults of a recording of skin, and of its taxels.

    Returns:
        Findings of the streams, then of the taxels.
    """
    return (*inspect_recording(experiment.recording), *taxel_findings(experiment))


def taxel_findings(experiment: PatchExperiment) -> tuple[Finding, ...]:
    """Find faults of the taxels of an experiment.

    Returns:
        Findings of every interval with a pressure; of a patch without one, of the whole log, those that need none.
    """
    return tuple(finding for patch in experiment.patches for finding in _of_patch(experiment, patch))


def _of_patch(experiment: PatchExperiment, patch: ExperimentPatch) -> Iterator[Finding]:
    start = experiment.recording.start_ns
    if patch.pressure is None:
        yield from _without_pressure(experiment, patch)
        return
    try:
        recordings = patch_recordings(experiment, patch)
    except ForceTorqueError as error:
        yield Finding(stream=patch.counts, kind="not_compared", message=f"no look at the taxels: {error}", count=0)
        return
    for recording in recordings:
        span = (start + round(1e9 * float(recording.seconds[at])) for at in (0, -1))
        yield from _with_faults(patch, repr(recording.label), recording.faults, TaxelFault, *span)


def _without_pressure(experiment: PatchExperiment, patch: ExperimentPatch) -> Iterator[Finding]:
    """What no pressure explains: a contact may be sudden, and most taxels are not touched."""
    stream = experiment.recording.stream(patch.counts)
    counts = stream.signal("taxel_counts").values[:, patch.taxels]
    read = np.isfinite(counts)
    lost: BoolArray = np.any(read, axis=1) & ~np.any(np.nan_to_num(counts), axis=1)
    read &= ~lost[:, None]
    if lost.any():
        count, ends = int(np.count_nonzero(lost)), np.flatnonzero(lost)[[0, -1]].tolist()
        text = f"{patch.name}: {count} of {len(lost)} messages of zeros, without power or lost"
        yield Finding.over(patch.counts, stream.stamp_ns, "missing", text, *ends, count=count)
    faults: list[tuple[TaxelFault, ...]] = []
    for rows, column in zip(read.T, counts.T, strict=True):
        faults += taxel_faults(column[rows, None], np.full(1, np.inf)) if np.count_nonzero(rows) > 1 else [()]
    if any(faults):
        span = (int(stream.stamp_ns[read.any(axis=1)][at]) for at in (0, -1))
        yield from _with_faults(patch, "the log", faults, (TaxelFault.WRAPS, TaxelFault.RAILS), *span)


def _with_faults(
    patch: ExperimentPatch,
    label: str,
    faults: Sequence[Sequence[TaxelFault]],
    named: Iterable[TaxelFault],
    start_ns: int,
    end_ns: int,
) -> Iterator[Finding]:
    for fault in named:
        columns = [int(patch.taxels[k]) for k, reasons in enumerate(faults) if fault in reasons]
        if not columns:
            continue
        names = ", ".join(map(str, columns[:_NAMED])) + (", ..." if len(columns) > _NAMED else "")
        yield Finding(
            stream=patch.counts,
            kind=f"taxel_{fault.name.lower()}",
            message=f"{patch.name}: {fault.value}: {len(columns)} of {len(patch.taxels)} taxels in {label}: {names}",
            count=len(columns),
            start_ns=start_ns,
            end_ns=end_ns,
            size=float(len(columns)),
            unit="taxels",
        )
