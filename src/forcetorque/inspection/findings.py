# SPDX-License-Identifier: BSD-3-Clause
"""Inspect the recording of an experiment: its streams by themselves, and its sensors against the model."""

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
from forcetorque.inspection.model_findings import model_findings
from forcetorque.recording.quality import frozen_finding, saturation_findings, spans, stream_findings
from forcetorque.recording.recording import Finding, Interval, Recording, Use

_DOUBTFUL = {"contact", "light_contact", "off_level", "step", "saturation", "frozen", "stuck", "gap", "backward_stamp"}
"""Kinds of findings that make the samples of their span doubtful."""


def inspect_recording(recording: Recording) -> tuple[Finding, ...]:
    """Look for what is wrong with a recording, without a robot.

    Args:
        recording: The recording.

    Returns:
        Findings of its readers and of every stream by itself.
    """
    return (*recording.findings, *(f for stream in recording.streams.values() for f in stream_findings(stream)))


def inspect_experiment(experiment: Experiment, *, by_model: bool = True) -> tuple[Finding, ...]:
    """Look for what is wrong with the recording of an experiment, with its robot and sensors.

    The sensors are compared with the model over the whole log where all intervals have one support
    frame, else inside each interval. Where something touches the robot beyond a sensor, or the model
    cannot be evaluated, the reason is a finding.

    Args:
        experiment: The experiment.
        by_model: Whether sensors are compared with the model, as if nothing but the support touched the robot.

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


def doubtful_spans(experiment: Experiment, use: Use, *, by_model: bool = True) -> tuple[tuple[Interval, Finding], ...]:
    """Find what `inspect_experiment` sees inside the intervals of one use.

    Args:
        experiment: The experiment.
        use: Use of the intervals.
        by_model: As of `inspect_experiment`.

    Returns:
        Interval and finding, for findings that make its samples doubtful.
    """
    findings = [finding for finding in inspect_experiment(experiment, by_model=by_model) if finding.kind in _DOUBTFUL]
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
    """Name the stretches that fits leave out, also those that only the model finds frozen."""
    stream = experiment.recording.stream(sensor.stream)
    named = [frozen_finding(stream, sensor.quantity, run) for run in spans(sample_quality(experiment, sensor).frozen)]
    frozen = [replace(one, message=f"{one.message}; left out of every fit and evaluation") for one in named]

    def is_named(finding: Finding) -> bool:
        return (finding.stream, finding.channel) == (stream.name, sensor.quantity) and any(
            finding.start_ns == one.start_ns or finding.kind == "frozen" for one in frozen
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
    """One span of the whole log if there is one support, else the intervals."""
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
