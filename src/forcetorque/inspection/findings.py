# SPDX-License-Identifier: BSD-3-Clause
"""Findings on the recording of an experiment: streams, sensors against the model, taxels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import BoolArray, IntArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.calibration.sensor_model import recover_raw
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sample_quality import sample_quality
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.residual_findings import model_findings
from forcetorque.recording.recording import Finding, Interval, Recording, Use
from forcetorque.recording.stream_faults import frozen_finding, saturation_findings, stream_findings, true_runs
from forcetorque.skin.experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.taxels.faults import TaxelFault
from forcetorque.skin.taxels.recording import PatchRecording, patch_recordings

_UNRELIABLE = {
    "contact",
    "light_contact",
    "off_level",
    "step",
    "saturation",
    "frozen",
    "stuck",
    "gap",
    "backward_stamp",
}
"""Kinds of findings that make the samples of their interval unreliable."""


def inspect_recording(recording: Recording) -> tuple[Finding, ...]:
    """Find faults of a recording, without a robot.

    Args:
        recording: The recording.

    Returns:
        Findings of its readers and of single streams.
    """
    return (*recording.findings, *(f for stream in recording.streams.values() for f in stream_findings(stream)))


def inspect_experiment(experiment: Experiment, *, by_model: bool = True) -> tuple[Finding, ...]:
    """Find faults of the recording of an experiment, with its robot and sensors.

    The sensors are compared with the model over the whole log where all intervals have one support
    frame, else inside each interval. With a distal contact, or where the model cannot be evaluated, the
    reason is a finding.

    Args:
        experiment: The experiment.
        by_model: Whether sensors are compared with the model, which has no contact but the support.

    Returns:
        Findings in the order of time, those without a time first.
    """
    findings = list(inspect_recording(experiment.recording))
    for sensor in experiment.sensors:
        findings = _with_all_frozen(experiment, sensor, findings)
        try:
            findings += _saturation(experiment, sensor)
        except ForceTorqueError as error:
            text = f"no look for saturation: {error}"
            findings.append(Finding(stream=sensor.stream, kind="not_compared", message=text, count=0))
        if by_model:
            findings += _model_findings(SensorRun(experiment, sensor))
    return tuple(sorted(findings, key=lambda finding: finding.start_ns or 0))


def unreliable_intervals(
    experiment: Experiment, use: Use, *, by_model: bool = True
) -> tuple[tuple[Interval, Finding], ...]:
    """Select the findings of `inspect_experiment` inside the intervals of one use.

    Args:
        experiment: The experiment.
        use: Use of the intervals.
        by_model: As of `inspect_experiment`.

    Returns:
        Interval and finding, for findings that make its samples unreliable.
    """
    findings = [finding for finding in inspect_experiment(experiment, by_model=by_model) if finding.kind in _UNRELIABLE]
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


def _model_findings(run: SensorRun) -> Iterator[Finding]:
    stream = run.sensor.stream
    supported = [interval for interval in run.experiment.recording.intervals if interval.support is not None]
    touched = {interval.label: run.touched_beyond(interval) for interval in supported}
    unknown = [label for label, names in touched.items() if names]
    if unknown:
        names = dict.fromkeys(name for label in unknown for name in touched[label])
        text = (
            f"no comparison with the model over {', '.join(unknown)}: {', '.join(names)} touches the robot beyond the "
            "sensor"
        )
        yield Finding(stream=stream, kind="not_compared", message=text, count=0)
        supported = [interval for interval in supported if interval.label not in unknown]
    else:
        supported = _over_the_whole_log(run.experiment, supported)
    for interval in supported:
        try:
            yield from _against_model(run, interval)
        except ForceTorqueError as error:
            text = f"no comparison with the model over {interval.label}: {error}"
            yield Finding(stream=stream, kind="not_compared", message=text, count=0)


def _over_the_whole_log(experiment: Experiment, supported: Sequence[Interval]) -> list[Interval]:
    """One interval of the whole log if there is one support, else the intervals."""
    if len({id(interval.support) for interval in supported}) != 1:
        return list(supported)
    start, end = experiment.recording.span_ns
    return [replace(supported[0], label="the whole log", start_ns=start, end_ns=end + 1, use=Use.VALIDATION)]


def _against_model(run: SensorRun, interval: Interval) -> tuple[Finding, ...]:
    sensor, samples = run.sensor, run.interval_samples(interval, smoothed=False).samples
    measured = samples.reading.values
    if sensor.quantity == "raw":
        if sensor.prior is None:
            return ()
        measured = measured @ sensor.prior.T
    in_use = _in_use(run.experiment, samples.stamp_ns)
    if not in_use.any():
        return ()
    return model_findings(sensor.stream, samples.stamp_ns, measured, samples.reference, in_use=in_use)


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

    Args:
        experiment: The experiment.

    Returns:
        Findings of the streams, then of the taxels in every interval with a pressure.
    """
    return (*inspect_recording(experiment.recording), *taxel_findings(experiment))


def taxel_findings(experiment: PatchExperiment) -> tuple[Finding, ...]:
    """Find faults of the taxels of an experiment.

    Args:
        experiment: The experiment.

    Returns:
        Findings of every interval with a pressure.
    """
    return tuple(finding for patch in experiment.patches for finding in _of_patch(experiment, patch))


def _of_patch(experiment: PatchExperiment, patch: ExperimentPatch) -> Iterator[Finding]:
    if patch.pressure is None:
        return
    start = experiment.recording.start_ns
    try:
        recordings = patch_recordings(experiment, patch)
    except ForceTorqueError as error:
        yield Finding(stream=patch.counts, kind="not_compared", message=f"no look at the taxels: {error}", count=0)
        return
    for recording in recordings:
        for fault in TaxelFault:
            yield from _with(patch, recording, fault, start)


def _with(patch: ExperimentPatch, recording: PatchRecording, fault: TaxelFault, start: int) -> Iterator[Finding]:
    columns = [int(patch.taxels[k]) for k, reasons in enumerate(recording.faults) if fault in reasons]
    if columns:
        named = ", ".join(map(str, columns[:_NAMED])) + (", ..." if len(columns) > _NAMED else "")
        yield Finding(
            stream=patch.counts,
            kind=f"taxel_{fault.name.lower()}",
            message=f"{patch.name}: {len(columns)} of {len(patch.taxels)} taxels in {recording.label!r}: {named}",
            count=len(columns),
            start_ns=start + round(1e9 * float(recording.seconds[0])),
            end_ns=start + round(1e9 * float(recording.seconds[-1])),
            size=float(len(columns)),
            unit="taxels",
        )
