# SPDX-License-Identifier: BSD-3-Clause
"""Small data to draw, and questions to what was drawn."""

from __future__ import annotations

import io
import struct
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.text import Text

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.figures.excitation import excitation_figure, space_figure
from forcetorque.calibration.figures.information import joint_figure, learnt_figure
from forcetorque.calibration.figures.lambda_curves import held_out_figure, lambda_difference_figure
from forcetorque.calibration.joint.robust_fit import PartResidual
from forcetorque.calibration.summary import InformationGain
from forcetorque.contests.contest_scores import ContestLoadRow
from forcetorque.contests.figures import contest_figure
from forcetorque.device.excitation_and_predicted_errors import DirectionRow
from forcetorque.device.figures import device_figure, envelope_figure, predicted_error_figure, reference_error_figure
from forcetorque.device.motors_hinge_and_envelope import VIEWS, EnvelopeRow
from forcetorque.device.requirements import GradeRow
from forcetorque.estimation.figures import contact_figure, torque_figure
from forcetorque.evaluation.figures.errors_and_matrices import comparison_figure, difference_figure, residual_figure
from forcetorque.evaluation.figures.load_cases import use_figure
from forcetorque.evaluation.figures.sphere import force_space_figure, index_figure, sphere_figure
from forcetorque.evaluation.load_cases.verdict import LoadCaseError, LoadCaseVerdict, Reason
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere, analyse_sphere
from forcetorque.evaluation.trials.trials import TrialGroup, TrialSphere, group_trials
from forcetorque.experiment.calibration.provenance import Validity
from forcetorque.experiment.validation_offset import Offset
from forcetorque.locomotion.figures import (
    balance_figure,
    coherence_figure,
    motion_figure,
    oscillation_causes_figure,
    torque_loop_figure,
)
from forcetorque.locomotion.logged_signals import motion_signals_of_arrays
from forcetorque.locomotion.motion_quality import motion
from forcetorque.locomotion.net_force.result import Coherence, PhaseForce
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole, centre_of_pressure
from forcetorque.locomotion.standing.interval_balance import FootPressure, IntervalBalance, RobotBalance
from forcetorque.locomotion.standing.support_phases import ContactThresholds, support_phases
from forcetorque.locomotion.torque_control.torque_loop_study import TorqueLoopRow, TorqueLoopStudy
from forcetorque.results.figure_style import png_bytes
from forcetorque.robot.motion import JointMotion
from forcetorque.sensor.bandwidth.driven_response import ChannelResponse
from forcetorque.sensor.bandwidth.excited_records import ExcitationKind
from forcetorque.sensor.bandwidth.frequency_response import ResponseCurve
from forcetorque.sensor.bandwidth.pooled_decays import DecayCurve
from forcetorque.sensor.bandwidth.response import Response
from forcetorque.sensor.bandwidth.second_order import SecondOrder
from forcetorque.sensor.figures import response_figure
from forcetorque.skin.figures import skin_event_figure, skin_layout_figure, skin_wrench_figure, taxel_figure
from forcetorque.skin.surface import skin_surface, unrolled
from forcetorque.skin.taxels.result import TaxelPicture
from forcetorque.skin.wrench.result import SkinEventPicture, SkinWrenchPicture
from forcetorque.study.figures import lambda_force_figure
from forcetorque.workbench.figures import bench_figure
from tests.locomotion.torque_control.test_causes import cause_row, causes_of
from tests.scenes.patches import cylinder_patch
from tests.skin.layout.skins import cylinder

LAMBDAS = np.array([0, 1, 5, 10, 50, 100, 1e3, 5e3, 1e4, 5e4, 1e5, 5e5, 1e6])
"""Those of the thesis, table 5.5; counts2."""
TYPES = ("SnTdTO", "SwTdTO", "SwTrTO", "OnTdTO", "OwTdTO", "OwTrTO")


def _wrenches(rng: np.random.Generator, count: int = 400) -> np.ndarray:
    return np.cumsum(rng.normal(size=(count, 6)), axis=0) * [2.0, 2.0, 4.0, 0.1, 0.1, 0.05]


def _balance(rng: np.random.Generator) -> Figure:
    time_s = 0.02 * np.arange(400)
    share = np.clip(0.5 + 0.5 * np.minimum(time_s - 2.0, 6.0 - time_s), 0.5, 1.0)
    forces = {"l_sole": 300.0 * share, "r_sole": 300.0 * (1.0 - share)}
    feet = []
    for frame, force in forces.items():
        wrench = np.zeros((400, 6))
        wrench[:, 2], wrench[:, 3:5] = force, force[:, None] * rng.normal(0.0, 0.01, (400, 2))
        sole = Sole(frame=frame, outline=np.array([[-0.05, -0.04], [0.1, -0.04], [0.1, 0.04], [-0.05, 0.04]]))
        pressure = centre_of_pressure(wrench, least_load_N=45.0)
        feet.append(
            FootPressure(
                sole=sole,
                sensors=(f"{frame[0]}_foot_ft",),
                wrench=wrench,
                covariance=None,
                pressure=pressure,
                reading_alone=None,
            )
        )
    return balance_figure(
        IntervalBalance(
            recording="biped",
            label="standing",
            stamp_ns=(time_s * 1e9).astype(np.int64),
            time_s=time_s,
            weight_N=300.0,
            forces=forces,
            net_N=np.full(400, 300.0),
            phases=support_phases(forces, time_s, ContactThresholds(contact_threshold_N=45.0, release_N=18.0)),
            feet=tuple(feet),
            robot=RobotBalance(frame="l_sole", pressure=feet[0].pressure),
        )
    )


def _torque_loop(rng: np.random.Generator) -> Figure:
    rows = [
        TorqueLoopRow(
            tilt_deg=tilt_deg,
            gain_factor=1.0,
            errors=errors,
            scale=scale,
            force_error_N=16.4 * scale,
            runs=30,
            tracking_rms_Nm=0.2 + scale * rng.uniform(1.0, 1.5),
            tracking_half_width_95_Nm=0.2,
            centre_rms_mm=3.0,
            falls=int(7 * scale),
            falls_least_percent=20.0 * scale,
            falls_most_percent=25.0 * scale,
            oscillating=int(scale),
            oscillating_least_percent=2.0 * scale,
            oscillating_most_percent=10.0 * scale,
            amplitude_mm=None,
        )
        for tilt_deg in (0.0, 10.0)
        for errors, scale in (("none", 0.0), ("workbench", 1.0), ("workbench", 2.0), ("in situ", 0.2))
    ]
    return torque_loop_figure(
        TorqueLoopStudy(name="biped", weight_N=303.0, duration_s=6.7, delay_s=0.001, rows=tuple(rows), onsets=())
    )


def _oscillation_causes(rng: np.random.Generator) -> Figure:
    counts = rng.integers(0, 20, size=3)
    return oscillation_causes_figure(causes_of(*(cause_row(f"cause {k}", int(n)) for k, n in enumerate(counts))))


def _space(rng: np.random.Generator) -> Figure:
    return space_figure({name: _wrenches(rng) for name in ("grid", "z-torque", "support leg", "other leg")})


def _force_space(rng: np.random.Generator) -> Figure:
    return force_space_figure({"leg": [("prior", _wrenches(rng)[:, :3]), ("model", _wrenches(rng)[:, :3])]})


def _difference(rng: np.random.Generator) -> Figure:
    matrices = rng.normal(size=(7, 36))
    between = np.abs(matrices[:, None] - matrices[None]).mean(axis=2)
    return difference_figure(["Workbench", *TYPES], 10.0 * between, unit="1e-4 N/count")


def _curves(rng: np.random.Generator) -> dict[str, np.ndarray]:
    return {kind: np.cumsum(rng.uniform(size=len(LAMBDAS))) + 2.0 for kind in TYPES}


def _lambda_difference(rng: np.random.Generator) -> Figure:
    return lambda_difference_figure(LAMBDAS, _curves(rng), unit="1e-4 N/count")


def _lambda_force(rng: np.random.Generator) -> Figure:
    curves = {name: _curves(rng) for name in ("noTz", "suppOnly", "All")}
    return lambda_force_figure(LAMBDAS, curves, workbench=16.7, chosen=("All", "OwTrTO", 1e3))


def _contact(rng: np.random.Generator) -> Figure:
    candidates = {name: _wrenches(rng)[:, :3] for name in ("Workbench", "best", "best by axis")}
    spans = [("grid, day 1", 0, 180), ("support leg, day 2", 180, 400)]
    return contact_figure(np.arange(400) * 0.01, candidates, unit="N", spans=spans)


def _comparison(rng: np.random.Generator) -> Figure:
    reference = _wrenches(rng)
    candidates = {name: reference + 0.1 * _wrenches(rng) for name in ("ex situ", "in situ")}
    return comparison_figure(np.arange(400) * 0.01, reference, candidates)


def sphere_of(
    force: np.ndarray, reference: np.ndarray | None, *, candidate: str = "prior", mass: float | None = None
) -> SensorSphere:
    """What an experiment gives of a sensor that read these forces."""
    wrench, expected = (None if f is None else np.hstack([f, 0.1 * f[:, ::-1]]) for f in (force, reference))
    return SensorSphere(
        sensor="leg_ft",
        serial="SN1",
        calibration=candidate,
        intervals=("grid",),
        fitted_on=(),
        no_model="no joints" if reference is None else None,
        force=force,
        reference=reference,
        analysis=analyse_sphere(wrench, expected, gravity=9.81, mass=mass),
    )


def _sphere(rng: np.random.Generator) -> Figure:
    directions = rng.normal(size=(500, 3))
    reference = 46.0 * directions / np.linalg.norm(directions, axis=1, keepdims=True)
    force = reference @ (np.eye(3) + 0.2 * rng.normal(size=(3, 3))) + rng.normal(size=3) + rng.normal(size=(500, 3))
    return sphere_figure([sphere_of(force, reference), sphere_of(force[:40], None, candidate="new.json", mass=4.7)])


def _residual(rng: np.random.Generator) -> Figure:
    time = 0.01 * np.arange(400) + 3.0 * (np.arange(400) > 250)
    return residual_figure(time, {"prior": 0.3 * _wrenches(rng), "new": 0.1 * _wrenches(rng)})


def validity_of_directions(
    variance: np.ndarray, explained: np.ndarray, excited: Sequence[bool], directions: np.ndarray
) -> Validity:
    """What supports a calibration by its raw directions, nothing else."""
    none, zero = np.zeros(len(excited)), np.zeros(6)
    return Validity(
        raw_minimum_counts=none,
        raw_maximum_counts=none,
        expected_wrench_sd=zero,
        rank=len(excited),
        condition=None,
        directions=directions,
        variance_counts2=variance,
        explained=explained,
        excited=tuple(excited),
    )


def excitation_of_sensors(rng: np.random.Generator, *channels: int) -> dict[str, Validity]:
    """What the figure of excitation takes of sensors with so many channels: every second direction is excited."""
    sensors = {}
    for k, c in enumerate(channels):
        share = np.where(np.arange(c) % 2, rng.uniform(0.0, 0.4, c), rng.uniform(0.6, 1.0, c))
        variance, directions = np.sort(10.0 ** rng.uniform(0.0, 8.0, c))[::-1], np.linalg.qr(rng.normal(size=(c, c)))[0]
        sensors[f"sensor {k}"] = validity_of_directions(variance, share, [bool(one > 0.5) for one in share], directions)
    return sensors


def _excitation(rng: np.random.Generator) -> Figure:
    return excitation_figure(excitation_of_sensors(rng, 6, 12))


def learnt_of(rng: np.random.Generator) -> tuple[InformationGain, ...]:
    """What some recordings taught of every direction: more of some, less of others."""
    return tuple(
        InformationGain(
            direction=name,
            force_error_before_N=before,
            force_error_after_N=before * (1.05 - share),
            moment_error_before_Nm=0.05 * before,
            moment_error_after_Nm=0.05 * before * (1.05 - share),
            uncertainty_reduction=share,
        )
        for name, before, share in zip(WRENCH_COMPONENTS, rng.uniform(0.03, 0.06, 6), rng.uniform(0, 1, 6), strict=True)
    )


def _joint(rng: np.random.Generator) -> Figure:
    time = np.arange(200) * 0.25
    return joint_figure(
        [
            PartResidual(
                part=part,
                label=label,
                recording="sway",
                session="day 1",
                root_link="chest",
                sensors=(part, "l_foot_ft"),
                time_s=time,
                before=rng.normal(size=(200, 6)),
                after=0.1 * rng.normal(size=(200, 6)),
                at_sensors=rng.normal(size=(200, 2, 6)),
                rows=np.ones(6),
                mass_kg=4.0,
                kept=(time < 20.0) | (time > 21.0),
            )
            for part in ("chest", "l_leg_ft", "r_leg_ft")
            for label in ("sway", "steps")
        ]
    )


def _taxel(rng: np.random.Generator) -> Figure:
    seconds = 0.1 * np.arange(600)
    pressure = 3e5 * np.clip(1.1 - np.abs(seconds / 30.0 - 1.0), 0.0, 1.0)
    fall = np.rint(pressure[:, None] / rng.uniform(6e3, 1e4, 8) + rng.normal(0.0, 0.6, (600, 8)))
    levels = np.linspace(0.0, 50.0, 100)
    curves = {
        "monotone": 8e3 * levels,
        "line": 8.2e3 * levels,
        "polynomial": 2e2 * levels**2,
        "capacitor": 7e3 * levels,
    }
    return taxel_figure(
        TaxelPicture(
            recording="chamber: up and down",
            seconds=seconds,
            pressure=pressure,
            fall=fall,
            mean_fall=fall.mean(axis=1),
            names=tuple(f"taxel {k}" for k in range(8)),
            curves=curves,
            levels=levels,
            highest=1.5e5,
        )
    )


def _skin_event(rng: np.random.Generator) -> Figure:
    seconds = np.linspace(0.0, 60.0, 300)
    pictures = [
        SkinEventPicture(stream=name, seconds=seconds, heuristic=np.maximum(0.0, rng.normal(size=300).cumsum()))
        for name in ("r_forearm_events", "r_hand_events")
    ]
    return skin_event_figure(pictures)


def _torque(rng: np.random.Generator) -> Figure:
    seconds = np.linspace(0.0, 60.0, 300)
    truth = rng.normal(size=(300, 2)).cumsum(axis=0)
    estimates = {"skin": truth + rng.normal(0.0, 0.3, (300, 2)), "force-torque sensor": truth + 0.4}
    return torque_figure(
        seconds,
        ("r_knee", "r_hip_pitch"),
        estimates,
        deviations={"skin": np.full((300, 2), 0.3)},
        reference=("truth", truth),
    )


def _skin_wrench(rng: np.random.Generator) -> Figure:
    surface = skin_surface(cylinder())
    pressures = 2e4 * np.exp(-0.5 * (np.linalg.norm(surface.positions - surface.positions[100], axis=1) / 0.012) ** 2)
    seconds = np.linspace(0.0, 60.0, 300)
    load = 9.81 * np.clip(np.sin(0.2 * seconds), 0.0, 1.0)
    return skin_wrench_figure(
        SkinWrenchPicture(
            patch="lower leg",
            seconds=seconds,
            forces={
                "kriging, norm of the force": load + rng.normal(0.0, 0.2, 300),
                "simple, norm of the force": 0.8 * load,
            },
            places=unrolled(surface),
            triangles=surface.triangles,
            pressures=load[:, None] / 9.81 * pressures,
            strongest=int(load.argmax()),
        ),
        load,
    )


def _learnt(rng: np.random.Generator) -> Figure:
    return learnt_figure({"one recording": learnt_of(rng), "all": learnt_of(rng)})


def use_of(
    candidate: str = "leg.json",
    load_case: str = "push",
    *,
    force: float = 4.0,
    before: float | None = 20.0,
    allowed: float | None = 8.0,
    measured: float | None = None,
    reasons: tuple[Reason, ...] = (),
    **changed: Any,
) -> LoadCaseVerdict:
    """A verdict whose force error has this median; moment errors are a hundredth of it, intervals half to double."""

    def error(quantity: Any, unit: Any, scale: float) -> LoadCaseError:
        old, limit = (None if value is None else scale * value for value in (before, allowed))
        return LoadCaseError(
            quantity=quantity,
            unit=unit,
            load=100.0 * scale,
            before=old,
            before_at_least=None if old is None else 0.5 * old,
            before_at_most=None if old is None else 2.0 * old,
            after=scale * force,
            after_at_least=0.5 * scale * force,
            after_at_most=2.0 * scale * force,
            allowed=limit,
            measured=None if measured is None else scale * measured,
            axes=(scale * force,) * 3,
            from_matrix=scale * force,
            from_offset=0.0,
            from_variables=0.0,
            from_noise=0.0,
            from_model=0.0,
        )

    enough = allowed is None or 2.0 * force <= allowed
    values: dict[str, Any] = {
        "decision": "use" if enough else "do not use",
        "message": f"{'use' if enough else 'do not use'} for a push of 100 N: it errs by some {force:g} N",
        "within": 0.99 if enough else 0.01,
        "specified": True,
        "offset": "fitted",
    }
    return LoadCaseVerdict(
        sensor="leg_ft",
        serial="SN1",
        calibration=candidate,
        load_case=load_case,
        loads="a push of 100 N",
        reasons=reasons,
        errors=(error("force", "N", 1.0), error("moment", "N m", 0.01)),
        **(values | changed),
    )


def _use(rng: np.random.Generator) -> Figure:
    uses = [
        use_of(load_case=name, force=rng.uniform(0.5, 30.0), measured=rng.uniform(0.5, 30.0))
        for name in ("push", "weight of the robot", "tool")
    ]
    return use_figure(uses, {"leg.json": "leg.json"})


def _held_out(rng: np.random.Generator) -> Figure:
    finite, lambdas = LAMBDAS, np.append(10.0 ** np.arange(-2.0, 9.0), np.inf)
    curves = {
        "left": (finite, rng.uniform(2.0, 9.0, len(finite)), 50.0),
        "right": (lambdas, rng.uniform(2.0, 9.0, len(lambdas)), np.inf),
        "arm": (lambdas, rng.uniform(2.0, 9.0, len(lambdas)), None),
    }
    return held_out_figure(curves, worst_ratios={"right": rng.uniform(0.1, 9.0, len(lambdas))})


def trial_groups(
    rng: np.random.Generator, *, sensors: int, trials: int = 3, caps: int = 0, with_model: bool = True
) -> list[TrialGroup]:
    """Groups of trials of sensors, the last of which covered a small part of the sphere only."""
    spheres = []
    for k in range(sensors):
        matrix = np.eye(3) + 0.15 * rng.normal(size=(3, 3))
        for _ in range(trials):
            directions = rng.normal(size=(300, 3))
            if k >= sensors - caps:
                directions = 0.1 * directions + [0.0, 0.0, 1.0]
            reference = 46.0 * directions / np.linalg.norm(directions, axis=1, keepdims=True)
            force = reference @ matrix.T + 5.0 * rng.normal(size=3) + 0.5 * rng.normal(size=(300, 3))
            sphere = replace(sphere_of(force, reference if with_model else None, mass=4.7), serial=f"SN{k}")
            spheres.append(
                TrialSphere(file="a.toml", experiment="a", condition=None, number=None, prior=None, sphere=sphere)
            )
    return group_trials(spheres)[0]


def _coherence(rng: np.random.Generator) -> Figure:
    phases = ("hanging", "double_1", "l_sole", "double_2", "r_sole", "double_3")
    rows = tuple(
        PhaseForce(
            phase=phase,
            contact_links=("l_sole",),
            calibration=candidate,
            offset=offset,
            offset_interval=interval,
            samples=100,
            force_N=error + [0.0, 0.0, 324.7],
            force_error_N=error,
            force_half_width_95_N=(None, 0.5, None) if phase == "double_3" else (1.0, 0.3, 0.7),
            force_deviation_N=(1.0, 2.0, 0.5),
            force_smallest_N=error - 3.0,
            force_largest_N=error + 3.0,
            moment_error_Nm=None,
            moment_half_width_95_Nm=None,
            moment_deviation_Nm=None,
            moment_smallest_Nm=None,
            moment_largest_Nm=None,
            evidence=phase != interval,
        )
        for offset, interval in ((Offset.ONE_LINK_IMU, "hanging"), (Offset.NONE, None))
        for phase in phases
        for candidate in ("prior", "in situ", "a/longer/name/of/a/folder")
        for error in (rng.normal(0.0, 9.0, 3),)
    )
    return coherence_figure(Coherence(experiment="a", mass_kg=33.1, weight_N=324.7, rows=rows, offsets=(), summary=()))


def _index(rng: np.random.Generator) -> Figure:
    return index_figure(trial_groups(rng, sensors=2, trials=2, caps=1))


def _skin_layout(rng: np.random.Generator) -> Figure:
    patch = cylinder_patch()
    assert patch.normals is not None
    placeholder = np.tile(rng.normal(size=3) / 3.0, (len(patch), 1))
    return skin_layout_figure(patch.positions, {"as written": placeholder, "rebuilt": patch.normals})


def _envelope(rng: np.random.Generator) -> Figure:
    angles = np.sort(rng.uniform(0.0, 2.0 * np.pi, 30))
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    return envelope_figure([EnvelopeRow.of(view, size * circle) for size, view in enumerate(VIEWS, start=1)])


def _reference_error(rng: np.random.Generator) -> Figure:
    widths = rng.uniform(0.01, 1.0, 8)
    return reference_error_figure(
        [
            GradeRow(
                gravity_by="IMU" if k % 2 else "encoders",
                full_width=float(width),
                plus_minus=round(float(0.5 * width), 4),
                unit="m/s2" if k % 2 else "deg",
                rms=width * np.array([1.0, 1.1, 1.2, 0.2, 0.2, 0.1]),
                single_force_N=2.0 * float(width),
                single_moment_Nm=0.5 * float(width),
                largest=width * np.array([2.0, 2.1, 2.2, 0.6, 0.6, 0.4]),
                largest_force_N=2.2 * float(width),
                largest_moment_Nm=0.6 * float(width),
                force_norm_N=3.0 * float(width),
                moment_norm_Nm=0.8 * float(width),
                force_met_to_kg=None,
                moment_met_to_kg=5.0,
            )
            for k, width in enumerate(widths)
        ]
    )


def _motion(rng: np.random.Generator) -> Figure:
    time = np.arange(2000) / 100.0
    columns = {
        "_com $y$ " + "x" * 60: 0.004 * np.cos(8.0 * time) + 0.001 * rng.normal(size=2000),
        "still": rng.normal(size=2000),
        "joint": np.where(time < 8.0, 0.0, 0.3) + 0.001 * rng.normal(size=2000),
    }
    signals = motion_signals_of_arrays(time, columns, dict.fromkeys(columns, "m"))
    still = motion(signals[:2])
    stepped = motion(signals[2:], steps_s=[8.0])
    rows, curves = (*still.oscillations, *stepped.oscillations), (*still.curves, *stepped.curves)
    return motion_figure(stepped.model_copy(update={"oscillations": rows, "curves": curves}))


def _response(rng: np.random.Generator) -> Figure:
    frequency = np.linspace(0.5, 200.0, 400)
    sensor = SecondOrder(natural_frequency_hz=30.0, damping=0.05, gain=1.0, covariance=1e-4 * np.eye(3))
    value = sensor.response(frequency) * (1.0 + 0.05 * rng.normal(size=400))
    time = np.linspace(0.01, 0.6, 300)
    fitted = np.exp(-9.0 * time) * np.cos(190.0 * time)
    decays = tuple(
        DecayCurve(
            title=f"_taps $of$ {'x' * 40}, {k}.00 s",
            time_s=time,
            measurement=fitted + 0.02 * rng.normal(size=300),
            fitted=fitted,
        )
        for k in range(5)
    )
    curve = ResponseCurve(
        frequency_hz=frequency,
        real=value.real,
        imaginary=value.imag,
        fitted_real=sensor.response(frequency).real,
        fitted_imaginary=sensor.response(frequency).imag,
        radius_95=np.full(400, 0.05),
        coherence=np.linspace(1.0, 0.2, 400),
        chance=0.4,
        driven=np.ones(400),
        explained_share=0.99,
        averages=8.0,
    )
    return response_figure(
        Response(
            sensor="_left $wrist$ " + "x" * 70,
            serial="FT1",
            wrench_source="the logged wrench",
            excitation=ExcitationKind.IMPACT,
            signal="fz",
            force="hammer",
            rate_hz=500.0,
            samples=5000,
            events=(),
            numbers=(),
            curve=curve,
            channels=tuple(_channel_response(name, curve) for name in WRENCH_COMPONENTS),
            inverse=None,
            refused=(),
            decays=decays,
        )
    )


def _channel_response(name: str, curve: ResponseCurve) -> ChannelResponse:
    return ChannelResponse(
        channel=name,
        explained_share=0.99,
        coherence=0.98,
        lowest_hz=2.0,
        lowest_gain=None if name == "tz" else 1.0,
        lowest_half_width_95=None if name == "tz" else 0.1,
        natural_frequency_hz=None,
        natural_frequency_half_width_95_hz=None,
        gain=None,
        gain_half_width_95=None,
        unit="1",
        moves_with=None,
        undetermined=None,
        curve=curve,
    )


def _bench(rng: np.random.Generator) -> Figure:
    directions = rng.standard_normal((24, 3))
    forces = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    return bench_figure(
        {
            "5.2 kg": (forces[:16], rng.standard_normal((16, 6))),
            "25.2 kg": (1.01 * forces[16:], 3.0 * rng.standard_normal((8, 6))),
        }
    )


def _device(rng: np.random.Generator) -> Figure:
    time = np.linspace(0.0, 120.0, 1200)
    names = ("pitch", "yaw", "hinge")
    motion = JointMotion.at_rest(names, np.cumsum(rng.normal(scale=0.02, size=(1200, 3)), axis=0))
    return device_figure(time, motion, {name: 100.0 * rng.normal(size=1200) for name in names})


def _contest(rng: np.random.Generator) -> Figure:
    rows = []
    for name in ("mini58 as bought", "ours, in situ", "ours, workbench", "in-situ without a prior"):
        for load in (10.0, 15.0, 20.0, 30.0):
            rmse = 0.01 * load * np.repeat([1.0, 0.05], 3) * rng.uniform(0.5, 2.0, 6)
            known = load > 10.0
            rows.append(
                ContestLoadRow(
                    contestant=name,
                    load_kg=load,
                    rmse=rmse,
                    rmse_low=0.8 * rmse if known else None,
                    rmse_high=1.3 * rmse if known else None,
                )
            )
    return contest_figure(rows)


def _predicted_error(rng: np.random.Generator) -> Figure:
    names = ("12 steps", "third lock", "workbench, 0.2 deg and 1 mm")
    rows = []
    for error in ("force, N", "moment, N m"):
        for name in names:
            values = dict(zip(WRENCH_COMPONENTS, np.exp(rng.normal(size=6)).tolist(), strict=True))
            unknown = {"fy": np.inf} if name == "12 steps" else {}
            rows.append(DirectionRow(motion=name, error=error, **(values | unknown)))
    return predicted_error_figure(rows)


def _of_capabilities() -> dict[str, Callable[[np.random.Generator], Figure]]:
    """Functions `draw_<name>` of every `drawn_figures.py` of the tests, by the names of their figures."""
    root = Path(__file__).parents[2]
    modules = [
        import_module(".".join(path.relative_to(root).with_suffix("").parts))
        for path in sorted((root / "tests").rglob("drawn_figures.py"))
    ]
    return {
        name.removeprefix("draw_"): function
        for module in modules
        for name, function in vars(module).items()
        if name.startswith("draw_")
    }


FIGURES: dict[str, Callable[[np.random.Generator], Figure]] = {
    "balance": _balance,
    "bench": _bench,
    "space": _space,
    "force space": _force_space,
    "device": _device,
    "predicted_error": _predicted_error,
    "difference": _difference,
    "lambda difference": _lambda_difference,
    "lambda force": _lambda_force,
    "contact": _contact,
    "contest": _contest,
    "coherence": _coherence,
    "comparison": _comparison,
    "sphere": _sphere,
    "residual": _residual,
    "envelope": _envelope,
    "excitation": _excitation,
    "held out": _held_out,
    "joint": _joint,
    "learnt": _learnt,
    "reference error": _reference_error,
    "skin event": _skin_event,
    "skin_wrench": _skin_wrench,
    "taxel": _taxel,
    "motion": _motion,
    "response": _response,
    "torque": _torque,
    "torque loop": _torque_loop,
    "oscillation causes": _oscillation_causes,
    "index": _index,
    "skin layout": _skin_layout,
    "use": _use,
} | _of_capabilities()
"""A figure of every kind that is drawn from plain arrays, of random data."""


@contextmanager
def recorded_figures() -> Iterator[list[Figure]]:
    """Every figure that is made meanwhile, not drawn."""
    figures: list[Figure] = []
    make = Figure.__init__

    def record(figure: Figure, *args: Any, **options: Any) -> None:
        make(figure, *args, **options)
        figures.append(figure)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "__init__", record)
        yield figures


def size_of(png: bytes) -> tuple[int, int]:
    """Width and height that the header of a PNG states."""
    return struct.unpack(">II", png[16:24])


def pixels(figure: Figure) -> np.ndarray:
    """Draw a figure: red, green and blue from 0 to 255; shape (height, width, 3)."""
    return np.rint(255 * np.asarray(imread(io.BytesIO(png_bytes(figure)), format="png"))[:, :, :3]).astype(int)


def count_of(image: np.ndarray, colour: str) -> int:
    """How many pixels have exactly a colour."""
    return int((image == [int(colour[k : k + 2], 16) for k in (1, 3, 5)]).all(axis=2).sum())


def shown_texts(figure: Figure) -> list[Text]:
    """Every text that can be seen, but those of views in space."""
    hidden = {id(text) for panel in panels(figure) for text in _hidden(panel)}
    texts = [text for text in figure.findobj(Text) if id(text) not in hidden]
    return [text for text in texts if text.get_visible() and text.get_text().strip()]


def _hidden(panel: Axes) -> list[Text]:
    """Numbers beyond the ends of an axis, which exist and are not drawn; all texts of a view in space."""
    if panel.name == "3d":
        return panel.findobj(Text)
    hidden = []
    for axis in (panel.xaxis, panel.yaxis):
        low, high = sorted(axis.get_view_interval())
        for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
            if not low <= tick.get_loc() <= high:
                hidden += [tick.label1, tick.label2]
    return hidden


def panels(figure: Figure) -> list[Axes]:
    """Its panels."""
    return list(figure.axes)


def words(figure: Figure) -> str:
    """All that is written in a figure, a line per text."""
    return "\n".join(text.get_text() for text in figure.findobj(Text))


def legend_of(figure: Figure) -> list[str]:
    """What the legend of a figure names."""
    (legend,) = figure.legends
    return [text.get_text() for text in legend.get_texts()]
