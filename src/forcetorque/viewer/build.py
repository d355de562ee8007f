# SPDX-License-Identifier: BSD-3-Clause
"""From an experiment to the scene of its whole log."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ForceTorqueError
from forcetorque.estimation import Contact
from forcetorque.experiment import (
    Experiment,
    ExperimentSensor,
    IntervalEstimates,
    estimate_experiment,
    inspect_experiment,
)
from forcetorque.experiment.contacts import contacts_at_sensors
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot import build_tree
from forcetorque.viewer.expected import expected_readings
from forcetorque.viewer.geometry import flat, robot_geometry
from forcetorque.viewer.instants import Posture, posture_at
from forcetorque.viewer.root_pose import root_poses
from forcetorque.viewer.scene import Block, ContactSeries, Robot, Scene, SceneFinding, SceneInterval
from forcetorque.viewer.series import first_corrections, scene_sensor
from forcetorque.viewer.tree import scene_joints


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BuiltScene:
    """A scene with its arrays."""

    scene: Scene
    """The header."""
    block: bytes
    """The arrays."""


def build_scene(
    experiment: Experiment,
    calibrations: Mapping[str, Calibration],
    *,
    urdf: Path | None = None,
    sensors: Sequence[str] | None = None,
    mesh_folders: Sequence[Path] = (),
    provenance: Sequence[str] = (),
) -> BuiltScene:
    """Collect everything that the viewer shows of an experiment.

    The instants are the stamps of the first shown sensor; other streams are interpolated at them. What is absent
    becomes a note and not an error, but for calibrations that may not be applied. Values are not smoothed.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name.
        urdf: File of the robot, for its looks; None for a load without one.
        sensors: Sensors to show; all of the experiment if None.
        mesh_folders: Folders with packages of meshes that are looked at first.
        provenance: Lines to add to the list of inputs.

    Returns:
        The scene.

    Raises:
        ExperimentError: If the experiment has no sensor of a name, or a calibration may not be applied.
        RecordingError: If there is no sample to show.
    """
    groups: dict[str, dict[str, Calibration]] = {}
    for name, calibration in calibrations.items():
        with stated_in(name):
            groups.setdefault(experiment.sensor(calibration.sensor.name).name, {})[name] = calibration
    names = dict.fromkeys(experiment.sensor(name).name for name in sensors or (s.name for s in experiment.sensors))
    shown = [experiment.sensor(name) for name in names]
    with_samples, notes = _without_empty(experiment, shown[0])
    block = Block()
    posture = posture_at(experiment.recording, experiment.model, experiment.recording.stream(shown[0].stream))
    root = root_poses(
        experiment.recording, experiment.model, posture, experiment.recording.intervals, experiment.processing
    )
    expected, lacking = expected_readings(experiment, tuple(names), posture, with_samples.recording.intervals)
    notes += [*posture.notes, *root.notes, *lacking]
    if experiment.processing.smoothing is not None:
        notes.append("the smoothing of the experiment file is not applied to what is shown")
    start_ns = experiment.recording.start_ns
    # arrays in the order in which a page that is loaded in pieces needs them
    time_s = block.add(seconds_since(posture.stamp_ns, start_ns), "float64")
    positions, roots = block.add(posture.position, "float32"), block.add(root.values, "float32")
    geometry = robot_geometry(experiment.model, urdf, block, mesh_folders=mesh_folders)
    notes += geometry.notes
    scene = Scene(
        title=experiment.name,
        provenance=(*_inputs(experiment), *provenance, f"forcetorque {version('forcetorque')}"),
        samples=len(posture.stamp_ns),
        start_ns=str(start_ns),
        time_s=time_s,
        positions=positions,
        coordinates=posture.names,
        root=roots,
        robot=Robot(
            name=experiment.model.name,
            root_link=experiment.model.root_link,
            links=tuple(experiment.model.links),
            joints=scene_joints(experiment.model, posture.names),
            shapes=geometry.shapes,
            meshes=geometry.meshes,
        ),
        sensors=tuple(
            scene_sensor(
                with_samples, sensor, groups.get(sensor.name, {}), expected[sensor.name], posture, block, notes
            )
            for sensor in shown
        ),
        contacts=_contacts(with_samples, groups, posture, block, notes),
        intervals=tuple(_interval(interval, start_ns) for interval in experiment.recording.intervals),
        findings=_findings(with_samples),
        notes=tuple(notes),
        annotations_url=None,
    )
    return BuiltScene(scene=scene, block=block.bytes())


def _without_empty(experiment: Experiment, sensor: ExperimentSensor) -> tuple[Experiment, list[str]]:
    """Leave out intervals that hold no sample of a sensor, and say which."""
    recording = experiment.recording
    stamps = recording.stream(sensor.stream).stamp_ns
    start, end = recording.span_ns
    kept, notes = [], []
    for interval in recording.intervals:
        inside = (stamps >= interval.start_ns) & (stamps < interval.end_ns)
        if inside.any() and start <= interval.start_ns and interval.end_ns <= end + 1:
            kept.append(interval)
        else:
            notes.append(f"interval {interval.label!r} is left out: it holds no sample, or ends outside the log")
    if notes:
        experiment = replace(experiment, recording=recording.with_intervals(kept))
    return experiment, notes


def _inputs(experiment: Experiment) -> list[str]:
    return [f"{name} sha256 {digest}" for name, digest in sorted(experiment.inputs_sha256.items())]


def _interval(interval: Interval, start_ns: int) -> SceneInterval:
    return SceneInterval(
        label=interval.label,
        use=interval.use.value,
        start_s=(interval.start_ns - start_ns) * 1e-9,
        end_s=(interval.end_ns - start_ns) * 1e-9,
        support=None if interval.support is None else interval.support.frame,
    )


def _findings(experiment: Experiment) -> tuple[SceneFinding, ...]:
    start_ns = experiment.recording.start_ns
    return tuple(
        SceneFinding(
            stream=finding.stream,
            kind=finding.kind,
            message=finding.message,
            start_s=None if finding.start_ns is None else (finding.start_ns - start_ns) * 1e-9,
            end_s=None if finding.end_ns is None else (finding.end_ns - start_ns) * 1e-9,
        )
        for finding in inspect_experiment(experiment)
    )


def _contacts(
    experiment: Experiment,
    groups: Mapping[str, Mapping[str, Calibration]],
    posture: Posture,
    block: Block,
    notes: list[str],
) -> tuple[ContactSeries, ...]:
    """Estimated wrenches of the contacts that the experiment states, or at its sensors, and of the support."""
    try:
        corrections = first_corrections(experiment, groups)
        spans = estimate_experiment(experiment, corrections)
    except ForceTorqueError as error:
        notes.append(f"no contact wrenches: {error}")
        return ()
    sources = "; ".join(f"{sensor}: {correction.source}" for sensor, correction in corrections.items())
    what = "that the experiment states" if experiment.contacts else "at the sensors"
    notes.append(f"contact wrenches {what} are estimated with {sources}")
    notes += dict.fromkeys(
        f"contacts: left out {text}"
        for span in spans
        for text in span.left_out
        if text.startswith("sub-model")  # torques and expected readings are not shown from here
    )
    found: dict[str, FloatArray] = {}
    for span in spans:
        # its instants are those of the experiment's first sensor, which need not be shown
        at = np.searchsorted(span.stamp_ns, posture.stamp_ns, side="right") - 1
        inside = (posture.stamp_ns >= span.interval.start_ns) & (posture.stamp_ns < span.interval.end_ns) & (at >= 0)
        for name in span.estimates.layout.contacts:
            values = found.setdefault(name, np.full((len(posture.stamp_ns), 6), np.nan))
            values[inside] = span.estimates.contact(name)[at[inside]]
    places = _places(experiment, spans)
    return tuple(
        ContactSeries(
            name=name,
            link=places[name].link,
            link_H_contact=flat(places[name].link_H_contact),
            values=block.add(values, "float32"),
        )
        for name, values in found.items()
    )


def _places(experiment: Experiment, spans: Sequence[IntervalEstimates]) -> dict[str, Contact]:
    """Contacts by name: the support at its own origin, and those of the experiment or at its sensors."""
    places: dict[str, Contact] = {}
    for span in spans:
        support = span.interval.support
        if support is not None:
            tree = build_tree(experiment.model, support.frame)
            at_sensors = contacts_at_sensors(tree, [sensor.name for sensor in experiment.sensors])
            stated = [entry.contact for entry in experiment.contacts]
            places |= {contact.name: contact for contact in (Contact(link=support.frame), *(stated or at_sensors))}
    return places
