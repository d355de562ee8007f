# SPDX-License-Identifier: BSD-3-Clause
"""Loads on a raised leg whose shin has skin, while motors warm: layout, logs and experiment files, as a user has them.

The recording has counts, force-torque sensor and encoders; each way to estimate torques has an experiment file.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import BIPED_URDF
from forcetorque.skin.layout.formats.layout_table import write_layout_table
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import (
    ON_SKIN,
    ClothStrip,
    ContactTruth,
    FlatWeight,
    SkinBody,
    SkinContact,
)
from forcetorque.skin.simulation.recordings import Loading, TaxelResponses, chamber_messages, contact_recording
from forcetorque.skin.simulation.temperature import HeatResponses, MotorHeat, Warmth, warm_recording
from forcetorque.skin.taxels.calibrate import calibrate_skin

LINK: Final = "r_shin"
KNEE: Final = "r_knee"
SENSOR: Final = "r_leg_ft"
JOINTS: Final = ("r_hip_pitch", "r_hip_roll", "r_hip_yaw", KNEE, "r_ankle_pitch", "r_ankle_roll")
ON_TOP_M: Final = (0.12, 0.13)
HANGING_M: Final = (0.04, 0.05)
"""Distance from the knee."""
SIDEWAYS_M: Final = np.arange(-0.02, 0.021, 0.002)
"""Places across the shin that are tried for one from which nothing slides off sideways."""
BESIDE_M: Final = 0.003
"""How far from that a load is put; each is put there anew."""
WEIGHT: Final = FlatWeight(radius_m=0.025, tilt=(0.0, 0.0))
STRIP: Final = ClothStrip(width_m=0.016, arc_m=0.034, hem_m=0.003)
"""So narrow that 3 kg press harder than the taxels were calibrated for, and 1.9 kg do not."""
NOISE: Final = np.array([0.1, 0.1, 0.1, 0.002, 0.002, 0.002])
OFFSET: Final = np.array([0.5, 0.5, 0.5, 0.01, 0.01, 0.01])
"""Standard deviations of the sensor's noise, and of what its offset is off in a recording; N, N m."""
RISE_K: Final = 10.0
WARM_S: Final = 240.0
"""By how much the motors warm the skin, and its time constant; s."""
EVERY: Final = 2
"""Messages of skin for one of sensor and encoders."""
SETTLED_S: Final = 0.5
"""Time after the weight rests, and before it is lifted, that is left out."""


@dataclass(frozen=True, kw_only=True)
class Load:
    """A mass on the leg, and how far that is raised."""

    mass_kg: float
    on_top: bool
    """On top of the shin, as marked by a star in the thesis, or hanging from a strip of cloth near the knee."""
    degrees: int = 90
    """Angle of the leg: at 90 the skin under a weight on top is level."""

    @property
    def label(self) -> str:
        """Label of its interval."""
        return f"{self.mass_kg:g} kg {'on top' if self.on_top else 'hanging'} at {self.degrees}"


MASSES_KG: Final = (1.0, 1.5, 1.7, 1.9, 3.0)
LOADS: Final = (
    Load(mass_kg=0.5, on_top=True),
    *(Load(mass_kg=mass, on_top=True) for mass in MASSES_KG),
    *(Load(mass_kg=mass, on_top=False) for mass in MASSES_KG),
    *(Load(mass_kg=1.0, on_top=True, degrees=angle) for angle in (85, 80, 75)),
)
"""In their order: the leg is lowered at the end."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LoadTruth:
    """What a load truly does."""

    load: Load
    wrench: FloatArray
    """On the shin in its frame and about its origin, the knee; shape (6,); N, N m."""
    along_N: float
    """Part of its weight along the shin, which no taxel feels."""
    knee_Nm: float
    """Torque of the knee."""
    peak_Pa: float
    """Largest pressure."""


def write_leg(
    folder: Path, layout: SkinLayout, loads: Sequence[Load], *, seed: int, loading: Loading
) -> list[LoadTruth]:
    """Write everything, and calibrate the taxels, with and without the warm-up.

    Args:
        folder: Where to.
        layout: Skin in the frame of the shin: x to the front, which is up where the leg is raised, z to the knee.
        loads: Loads in their order.
        seed: Of taxels, noise and offset.
        loading: How long each rests.

    Returns:
        The truth.
    """
    body, rng = SkinBody.of(layout), np.random.default_rng(seed)
    taxels, heat = TaxelResponses.drawn(len(layout), rng), HeatResponses.drawn(layout, rng)
    write_layout_table(folder / "shin.csv", layout)
    write_recording(folder / "bag", chamber_messages(layout, taxels, rng))
    write_recording(folder / "warm", warm_recording(layout, taxels, heat, rng, warmth=Warmth(hold_s=900.0)))
    places = _places(body, loads, rng)
    hip = _hip_rad(body, loads, places)
    pressed = [_pressed(body, *one) for one in zip(loads, places, hip.tolist(), strict=True)]
    seconds, shares = loading.shares(len(loads))
    rise = MotorHeat(responses=heat, rise_K=RISE_K * (1.0 - np.exp(-seconds / WARM_S)))
    touched = contact_recording(layout, taxels, [truth for truth, _ in pressed], rng, loading=loading, heat=rise)
    counts = touched.stream("counts")
    whole = shares @ np.stack([wrench for _, wrench in pressed])
    joints = leg_motion(_hip(hip, seconds, loading))
    leg = loaded_leg(joints, whole)
    reading = leg.expected_of(SENSOR) + OFFSET * rng.normal(size=6) + NOISE * rng.normal(size=(len(seconds), 6))
    streams = {
        "counts": counts,
        SENSOR: _stream(SENSOR, counts, _wrench(reading)),
        "joints": _stream("joints", counts, _positions(joints)),
    }
    write_recording(folder / "leg", Recording(streams=streams))
    (folder / "leg.urdf").write_text(BIPED_URDF.read_text(encoding="utf-8"), encoding="utf-8")
    for name, text in _files(loads, loading).items():
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    for name, warm_up in (("cold", None), ("warm", folder / "warm.toml")):
        answer = calibrate_skin([folder / "bag.toml"], code_version="1", created="2020-01-01", warm_up=warm_up)
        answer.calibration.save(folder / f"{name}.json")
    knee = leg.torque(KNEE)
    middles = [int(np.flatnonzero(shares[:, k] == 1.0).mean()) for k in range(len(loads))]
    return [
        LoadTruth(
            load=load,
            wrench=wrench,
            along_N=float(np.linalg.norm((wrench - truth.wrench)[[0, 2]])),
            knee_Nm=float(knee[row]),
            peak_Pa=truth.peak_Pa,
        )
        for load, (truth, wrench), row in zip(loads, pressed, middles, strict=True)
    ]


def _places(body: SkinBody, loads: Sequence[Load], rng: np.random.Generator) -> list[FloatArray]:
    """Where each load rests, on the chart of the skin: on all angles of one mass on top at the same place; m."""
    places: dict[tuple[float, bool], FloatArray] = {}
    for load in loads:
        if (load.mass_kg, load.on_top) not in places:
            places[load.mass_kg, load.on_top] = _place(body, load, rng)
    return [places[load.mass_kg, load.on_top] for load in loads]


def _place(body: SkinBody, load: Load, rng: np.random.Generator) -> FloatArray:
    """A place beside the one on which this load would push neither left nor right."""
    radius, along = body.surface.mean_radius_m, -rng.uniform(*(ON_TOP_M if load.on_top else HANGING_M))
    front = np.array([[np.sqrt(max(radius**2 - y**2, 0.0)), y, along] for y in SIDEWAYS_M])
    charted = body.surface.chart(front)
    inside = ((charted >= body.surface.low) & (charted <= body.surface.high)).all(axis=1)
    truths = [_resting(body, load, place, load.mass_kg) for place in charted[inside]]
    on_skin = [one for one in truths if one.on_skin >= ON_SKIN]
    if not on_skin:
        raise SkinError(
            f"layout {body.layout.name!r}: expected skin of a shin under {load.label}, {-100.0 * along:.0f} cm from "
            "the knee along -z of its frame, got none there; give a layout with x to the front and the knee as origin"
        )
    middle = min(on_skin, key=lambda one: abs(one.wrench[1])).contact.place
    place: FloatArray = middle + [rng.uniform(-BESIDE_M, BESIDE_M), 0.0]
    return place


def _resting(body: SkinBody, load: Load, place: FloatArray, pressing_kg: float) -> ContactTruth:
    """What the load does where it rests, pressing with some of its mass."""
    thing = WEIGHT if load.on_top else STRIP
    return body.press(SkinContact(thing=thing, mass_kg=pressing_kg, place=place, spin=0.0))


def _hip_rad(body: SkinBody, loads: Sequence[Load], places: Sequence[FloatArray]) -> FloatArray:
    """Angle of the hip for each load: at 90 degrees the push of a kilogram on top is vertical; shape (k,)."""
    kilogram = next(k for k, load in enumerate(loads) if load.on_top and load.mass_kg == 1.0)
    push = _resting(body, loads[kilogram], places[kilogram], 1.0).wrench
    level = np.pi / 2.0 + np.arctan2(push[2], -push[0])
    hip: FloatArray = level - np.radians([90.0 - load.degrees for load in loads])
    return hip


def _pressed(body: SkinBody, load: Load, place: FloatArray, hip_rad: float) -> tuple[ContactTruth, FloatArray]:
    """What the skin feels of a load, and the whole of its weight, which acts at the centre of pressure."""
    down = np.array([-np.sin(hip_rad), 0.0, -np.cos(hip_rad)])
    share = float(-body.surface.at(place).normals @ down)
    truth = _resting(body, load, place, load.mass_kg * share)
    tangent = load.mass_kg * STANDARD_GRAVITY * down - truth.wrench[:3]
    return truth, truth.wrench + np.concatenate([tangent, np.cross(truth.centre, tangent)])


def _hip(angles: FloatArray, seconds: FloatArray, loading: Loading) -> FloatArray:
    """Angle of the hip: it moves while nothing rests on the leg, in a second, a second before the next load; rad."""
    begin = loading.rest_s + loading.turn_s * np.arange(len(angles))
    before = np.concatenate([angles[:1], angles[:-1]])
    times, values = (np.stack(pair, axis=1).ravel() for pair in ((begin - 2.0, begin - 1.0), (before, angles)))
    return np.interp(seconds, times, values)


def leg_motion(hip: FloatArray) -> JointMotion:
    """Give the leg at rest in every pose; the other joints of the robot are at zero.

    Args:
        hip: Pitch of the hip; shape (n,); rad.

    Returns:
        Positions of all joints, those of the leg first.
    """
    model = read_urdf(BIPED_URDF)
    others = [name for name, joint in model.joints.items() if joint.type.moves and name not in JOINTS]
    positions = np.zeros((len(hip), len(JOINTS) + len(others)))
    positions[:, 0] = hip
    return JointMotion.at_rest((*JOINTS, *others), positions)


def loaded_leg(joints: JointMotion, shin_wrench: FloatArray) -> Estimates:
    """Compute what a perfect sensor reads, and the torque of the knee, while the pelvis is held upright.

    Args:
        joints: The leg at rest.
        shin_wrench: What the load does to the shin, in its frame and about its origin; shape (n, 6); N, N m.

    Returns:
        The expected reading of `SENSOR` and the torque of `KNEE`.
    """
    load = Contact(link=LINK, type=ContactType.KNOWN)
    question = Question(
        tree=build_tree(read_urdf(BIPED_URDF), "pelvis"),
        contacts=(load,),
        expected=(SENSOR,),
        torques=(KNEE,),
        equations=(),
    )
    root = RootMotion.fixed([0.0, 0.0, -1.0])
    return estimate(question, joints, root, known=Wrenches.of({load.name: shin_wrench}))


def _stream(name: str, counts: Stream, signal: Signal) -> Stream:
    thinned = replace(signal, values=np.ascontiguousarray(signal.values[::EVERY]))
    return Stream(name=name, clock=counts.clock, stamp_ns=counts.stamp_ns[::EVERY], signals={signal.quantity: thinned})


def _wrench(values: FloatArray) -> Signal:
    return Signal(quantity="wrench", values=values, columns=WRENCH_COMPONENTS, units=WRENCH_UNITS, frame=SENSOR)


def _positions(joints: JointMotion) -> Signal:
    values = joints.position[:, : len(JOINTS)]
    return Signal(quantity="position", values=values, columns=JOINTS, units=("rad",) * len(JOINTS))


_HEAD = """schema = "forcetorque/experiment/1"
name = "{name}"
recording = {{ format = "parquet", path = "{log}" }}
"""
_PATCH = """
[[patch]]
name = "shin"
counts = "counts"
layout = "shin.csv"
"""
_ROBOT = """
[robot]
urdf = "leg.urdf"

[[support]]
frame = "pelvis"
gravity_direction = [0.0, 0.0, -1.0]
"""
_FT = f"""
[[sensor]]
name = "{SENSOR}"
stream = "{SENSOR}"
serial = "F1"
prior = "identity"

[[contact]]
frame = "{LINK}"
"""
_FORCE = f'table = "{{table}}.json"\nlink = "{LINK}"\nfriction = 0.0\n'
_INTERVAL = '\n[[interval]]\nlabel = "{label}"\nstart_s = {start:g}\nuse = "{use}"\n'


def _files(loads: Sequence[Load], loading: Loading) -> dict[str, str]:
    """Experiment files by name: of chamber and warm-up, and of the leg by sensor, and by skin alone."""
    files = {
        name: _HEAD.format(name=name, log=name)
        + _PATCH
        + extra
        + _INTERVAL.format(label=name, start=0, use="calibration")
        for name, extra in (("bag", 'pressure = "chamber"\n'), ("warm", ""))
    }
    intervals = "".join(
        _INTERVAL.format(label=load.label, start=start + loading.ramp_s + SETTLED_S, use="validation")
        + f'end_s = {start + loading.ramp_s + loading.hold_s - SETTLED_S:g}\nsupport = "pelvis"\n'
        for k, load in enumerate(loads)
        for start in [loading.rest_s + k * loading.turn_s]
    )
    files["ft"] = _HEAD.format(name="ft", log="leg") + _ROBOT + _FT + intervals
    for table in ("cold", "warm"):
        patch = _PATCH + _FORCE.format(table=table)
        files[f"skin_{table}"] = _HEAD.format(name=f"skin {table}", log="leg") + _ROBOT + patch + intervals
    return files
