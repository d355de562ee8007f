# SPDX-License-Identifier: BSD-3-Clause
"""The scene that the page draws: a header of these classes, and one block of bytes with its arrays.

The page knows the same classes as TypeScript (`typescript.py`). Values are in SI units; poses are `a_H_b` with
`p_a = a_H_b p_b`, row by row as 16 numbers; wrenches are force then moment.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import Literal


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayRef:
    """An array in the block: little-endian, in C order; NaN is absent."""

    offset: int
    """Where it starts; bytes, a multiple of 8."""
    shape: tuple[int, ...]
    """Its shape."""
    dtype: Literal["float32", "float64", "uint32"]
    """Its type."""
    packed_bytes: int | None = None
    """Length of its packed form, as `viewer/packing.py` describes it; null where it is stored as it is."""
    base: ArrayRef | None = None
    """Array of the same shape (n, c) that `matrix` multiplies, and what is stored is added to; or null."""
    matrix: tuple[float, ...] | None = None
    """Matrix of c columns, row by row: a row of values is `matrix` times the row of `base`, and the stored row."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint:
    """A joint; its coordinate is `multiplier * column + offset`.

    Pose of the child = pose of the parent * parent_H_child * (turn by, or slide along, axis times coordinate).
    """

    name: str
    """Name."""
    type: Literal["fixed", "rotary", "prismatic"]
    """How it moves."""
    parent: str
    """Parent link."""
    child: str
    """Child link."""
    parent_H_child: tuple[float, ...]
    """Pose of the child at coordinate zero; 16 numbers."""
    axis: tuple[float, ...]
    """Unit axis in the child frame; 3 numbers."""
    column: int | None
    """Index into `coordinates`; null where it stays at `offset`."""
    multiplier: float
    """Ratio to the column."""
    offset: float
    """Value where the column is zero; rad or m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """Something to draw at a link."""

    link: str
    """Link."""
    link_H_shape: tuple[float, ...]
    """Its pose; 16 numbers."""
    kind: Literal["box", "cylinder", "sphere", "mesh"]
    """What it is."""
    size: tuple[float, ...]
    """Box: x, y, z; cylinder: radius, length along z; sphere: radius; mesh: scale x, y, z."""
    mesh: int | None
    """Index into `meshes`; null unless the kind is mesh."""
    colour: tuple[float, ...]
    """Red, green, blue, opacity from 0 to 1."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mesh:
    """Triangles."""

    vertices: ArrayRef
    """Shape (v, 3) float32."""
    faces: ArrayRef
    """Indices of vertices; shape (f, 3) uint32."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """The robot as a tree of links."""

    name: str
    """Name of the model."""
    root_link: str
    """Link whose pose in the world is `root`."""
    links: tuple[str, ...]
    """Links."""
    joints: tuple[Joint, ...]
    """Joints, parents before children."""
    shapes: tuple[Shape, ...]
    """What to draw."""
    meshes: tuple[Mesh, ...]
    """Meshes of the shapes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sphere:
    """A sphere in the space of forces or moments."""

    centre: tuple[float, ...]
    """Centre; 3 numbers."""
    radius: float
    """Radius."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ellipsoid:
    """Points `centre + axes u` for every unit vector u."""

    centre: tuple[float, ...]
    """Centre; 3 numbers."""
    axes: tuple[float, ...]
    """Half axes as the columns of a matrix, row by row; 9 numbers."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SeriesOverview:
    """What the page shows of all of a series; columns are fx, fy, fz and norm of the force, then of the moment."""

    samples: int
    """Samples of a block; there are b blocks, and a rest that is shorter."""
    wrench: ArrayRef
    """Lowest, then highest of each column; shape (b, 16) float32; N, N m; NaN where all are absent."""
    error: ArrayRef | None
    """Lowest, highest, sum, sum of squares, number of the errors in use; shape (b, 40) float32; N, N m; or null."""
    deviation: ArrayRef | None
    """As `wrench`, of the standard deviation; or null."""
    every: int
    """One sample in so many is in `points`."""
    points: ArrayRef
    """Values of the first sample and every one that follows; shape (p, 6) float32; N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WrenchSeries:
    """Wrenches of a sensor, in its frame and in its own sign convention."""

    name: str
    """What it is, in words."""
    role: Literal["expected", "measured"]
    """At most one series of a sensor is expected."""
    calibrated: bool
    """Whether a calibration gives it, and not the prior or the log."""
    peak: tuple[float, ...]
    """Largest force and largest moment; N, N m; 0 where all are absent."""
    values: ArrayRef
    """Shape (n, 6) float32; N, N m."""
    deviation: ArrayRef | None
    """Standard deviation of its error by the posterior of its calibration; shape (n, 6) float32; N, N m; or null."""
    reference_force: Sphere | None
    """Sphere that gravity draws by the model; on the expected series; N."""
    reference_moment: Sphere | None
    """The same of the moments; N m."""
    ellipsoid_force: Ellipsoid | None
    """Ellipsoid that the forces draw; N; null where it is not identifiable."""
    ellipsoid_moment: Ellipsoid | None
    """Ellipsoid that the moments draw; N m; null where it is not identifiable."""
    overview: SeriesOverview | None = None
    """What is shown of all of it; null where it is short."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor:
    """A force-torque sensor; or a part that nothing touches, with what its sensors leave of its equation."""

    name: str
    """Name in the robot model; of a part, in words."""
    serial: str
    """Serial number; empty for a part."""
    link: str
    """Link that its frame is given in."""
    link_H_sensor: tuple[float, ...]
    """Pose of its frame; 16 numbers."""
    acting: str | None
    """Link that acts, in the sign of the reading; null for a part: no link does what is left over."""
    acted_on: str
    """Link, or part, that is acted on."""
    wrenches: tuple[WrenchSeries, ...]
    """The expected wrench, what was logged or the prior gives, then one series per calibration."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSeries:
    """Wrenches of the world on the robot at one place."""

    name: str
    """Name of the contact."""
    link: str
    """Link that is touched."""
    link_H_contact: tuple[float, ...]
    """Pose of the contact frame; 16 numbers."""
    values: ArrayRef
    """In the contact frame; shape (n, 6) float32; N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinContactFrames:
    """Contacts on skin, frame by frame: k frames with m contacts together."""

    time_s: ArrayRef
    """Start of each frame, increasing; s; shape (k,) float64."""
    hold_s: float
    """How long a frame is shown, unless the next one comes first; s."""
    first: ArrayRef
    """Where the contacts of each frame begin, and their number at the end; shape (k + 1,) uint32."""
    place: ArrayRef
    """Centres of pressure, in the frame of the link; m; shape (m, 3) float32."""
    force: ArrayRef
    """What each does to the link, along its axes; shape (m, 3) float32; N, but for contacts of a heuristic."""
    spread: ArrayRef | None
    """Half axes of one standard deviation of the force, as the columns of matrices; N; shape (m, 9) float32."""
    identity: ArrayRef
    """Number of each contact, which it keeps from frame to frame; shape (m,) uint32."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinPatch:
    """A patch of artificial skin with its pressures; its v taxels are the corners of its facets."""

    name: str
    """Name of the patch."""
    link: str
    """Link that it is mounted on, in whose frame its vectors are."""
    vertices: ArrayRef
    """Taxels; m; shape (v, 3) float32."""
    faces: ArrayRef
    """Indices of vertices; shape (f, 3) uint32."""
    pressure: ArrayRef
    """Pressure of contacts in each frame, 0 beside them; Pa; shape (k, v) float32."""
    largest_Pa: float
    """Largest of them; Pa."""
    contacts: SkinContactFrames
    """Contacts, with their uncertainty."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinEventSeries:
    """Contacts that a skinManager sees; what it calls force is a heuristic, not newtons."""

    name: str
    """Name of the stream."""
    link: str
    """Frame that the contacts are given in."""
    contacts: SkinContactFrames
    """Contacts; their force is the heuristic and has no spread."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneInterval:
    """An interval of the experiment."""

    label: str
    """Label."""
    use: Literal["calibration", "validation", "ignore"]
    """What its samples are for."""
    start_s: float
    """Start; s."""
    end_s: float
    """End, itself excluded; s."""
    support: str | None
    """Support frame."""
    states_support: bool
    """Whether the experiment file names supports; that of a wrist sensor is always its own frame."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneFinding:
    """Something that is wrong with the recording."""

    stream: str
    """Stream."""
    kind: str
    """Kind in one word."""
    message: str
    """Description."""
    start_s: float | None
    """First instant; s; null where it has none."""
    end_s: float | None
    """Last instant; s; null where it has none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveFeed:
    """Where samples of a running stream come from; the arrays over time are then none of the block and begin empty."""

    url: str
    """Address that answers with a `LiveUpdate`."""
    window_s: float
    """Time that is shown; s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveSensorState:
    """A sensor of a running stream, as it is now."""

    status: str
    """`ok`, or what is wrong with the last sample."""
    samples: int
    """Samples so far."""
    faulty: int
    """Samples with a fault."""
    drift: tuple[float, ...] | None
    """Change of the bias since the tare; 6 numbers; N, N m; null without a tare."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveUpdate:
    """What came since the last one, in a line.

    After it come the new rows, array by array: time, positions, root, and values and deviation of every series.
    """

    first: int
    """Number of the first row, from 0 at the begin of the stream."""
    rows: int
    """Rows that follow."""
    total: int
    """Samples so far."""
    received: int
    """Packets that could be read."""
    lost: int | None
    """Packets that never came; null where that cannot be known."""
    late: int
    """Packets that came late."""
    repeated: int
    """Packets that came twice."""
    silent_s: float
    """Time since the last packet; s."""
    ended_by: str | None
    """Why the stream ended; null while it lasts."""
    sensors: tuple[LiveSensorState, ...]
    """Sensors in the order of the scene."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """Everything that the page shows."""

    schema: Literal["forcetorque/scene/1"] = "forcetorque/scene/1"
    """Form of the header."""
    title: str
    """Name of the experiment."""
    provenance: tuple[str, ...]
    """Files with hashes and code version, a line each."""
    samples: int
    """Number of samples n."""
    start_ns: str
    """Stamp of second 0 as a decimal number; ns."""
    end_s: float
    """End of the log over all streams, itself excluded: the latest end that an interval may have; s."""
    time_s: ArrayRef
    """Seconds since the start of the recording, as intervals count them; shape (n,) float64."""
    positions: ArrayRef
    """Joint coordinates; shape (n, d) float32; rad or m."""
    coordinates: tuple[str, ...]
    """Joints of the d columns."""
    root: ArrayRef
    """Pose of the root link in the world, z up: x, y, z, then qw, qx, qy, qz; shape (n, 7) float32; m."""
    robot: Robot
    """The robot."""
    sensors: tuple[Sensor, ...]
    """Sensors."""
    contacts: tuple[ContactSeries, ...]
    """Contacts that were estimated."""
    skin: tuple[SkinPatch, ...] = ()
    """Patches of skin with a calibration."""
    skin_events: tuple[SkinEventSeries, ...] = ()
    """Contacts that a skinManager sees."""
    intervals: tuple[SceneInterval, ...]
    """Intervals in the order of the experiment."""
    findings: tuple[SceneFinding, ...]
    """Findings in the order of time."""
    notes: tuple[str, ...]
    """What is absent, and why."""
    annotations_url: str | None
    """Where the page sends saved samples; null in a file."""
    live: LiveFeed | None = None
    """Where samples come from while a robot runs; null for a recording."""


def scene_json(scene: Scene) -> str:
    """Write the header of a scene.

    Args:
        scene: The scene.

    Returns:
        JSON in one line, without NaN.
    """
    return json.dumps(asdict(scene), allow_nan=False, ensure_ascii=False, separators=(",", ":"))
