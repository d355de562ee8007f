// SPDX-License-Identifier: BSD-3-Clause
// Written by `make web-types` from src/forcetorque/viewer/scene.py; change that file instead.

/** An array in the block: little-endian, in C order; NaN is absent. */
export interface ArrayRef {
  /** Where it starts; bytes, a multiple of 8. */
  readonly offset: number;
  /** Its shape. */
  readonly shape: readonly number[];
  /** Its type. */
  readonly dtype: "float32" | "float64" | "uint32";
  /** Length of its packed form, as `viewer/packing.py` describes it; null where it is stored as it is. */
  readonly packed_bytes: number | null;
  /** Array of the same shape (n, c) that `matrix` multiplies, and what is stored is added to; or null. */
  readonly base: ArrayRef | null;
  /** Matrix of c columns, row by row: a row of values is `matrix` times the row of `base`, and the stored row. */
  readonly matrix: readonly number[] | null;
}

/**
 * A joint; its coordinate is `multiplier * column + offset`.
 *
 * Pose of the child = pose of the parent * parent_H_child * (turn by, or slide along, axis times coordinate).
 */
export interface Joint {
  /** Name. */
  readonly name: string;
  /** How it moves. */
  readonly type: "fixed" | "rotary" | "prismatic";
  /** Parent link. */
  readonly parent: string;
  /** Child link. */
  readonly child: string;
  /** Pose of the child at coordinate zero; 16 numbers. */
  readonly parent_H_child: readonly number[];
  /** Unit axis in the child frame; 3 numbers. */
  readonly axis: readonly number[];
  /** Index into `coordinates`; null where it stays at `offset`. */
  readonly column: number | null;
  /** Ratio to the column. */
  readonly multiplier: number;
  /** Value where the column is zero; rad or m. */
  readonly offset: number;
}

/** Something to draw at a link. */
export interface Shape {
  /** Link. */
  readonly link: string;
  /** Its pose; 16 numbers. */
  readonly link_H_shape: readonly number[];
  /** What it is. */
  readonly kind: "box" | "cylinder" | "sphere" | "mesh";
  /** Box: x, y, z; cylinder: radius, length along z; sphere: radius; mesh: scale x, y, z. */
  readonly size: readonly number[];
  /** Index into `meshes`; null unless the kind is mesh. */
  readonly mesh: number | null;
  /** Red, green, blue, opacity from 0 to 1. */
  readonly colour: readonly number[];
}

/** Triangles. */
export interface Mesh {
  /** Shape (v, 3) float32. */
  readonly vertices: ArrayRef;
  /** Indices of vertices; shape (f, 3) uint32. */
  readonly faces: ArrayRef;
}

/** The robot as a tree of links. */
export interface Robot {
  /** Name of the model. */
  readonly name: string;
  /** Link whose pose in the world is `root`. */
  readonly root_link: string;
  /** Links. */
  readonly links: readonly string[];
  /** Joints, parents before children. */
  readonly joints: readonly Joint[];
  /** What to draw. */
  readonly shapes: readonly Shape[];
  /** Meshes of the shapes. */
  readonly meshes: readonly Mesh[];
}

/** A sphere in the space of forces or moments. */
export interface Sphere {
  /** Centre; 3 numbers. */
  readonly centre: readonly number[];
  /** Radius. */
  readonly radius: number;
}

/** Points `centre + axes u` for every unit vector u. */
export interface Ellipsoid {
  /** Centre; 3 numbers. */
  readonly centre: readonly number[];
  /** Half axes as the columns of a matrix, row by row; 9 numbers. */
  readonly axes: readonly number[];
}

/** What the page shows of all of a series; columns are fx, fy, fz and norm of the force, then of the moment. */
export interface SeriesOverview {
  /** Samples of a block; there are b blocks, and a rest that is shorter. */
  readonly samples: number;
  /** Lowest, then highest of each column; shape (b, 16) float32; N, N m; NaN where all are absent. */
  readonly wrench: ArrayRef;
  /** Lowest, highest, sum, sum of squares, number of the errors in use; shape (b, 40) float32; N, N m; or null. */
  readonly error: ArrayRef | null;
  /** As `wrench`, of the standard deviation; or null. */
  readonly deviation: ArrayRef | null;
  /** One sample in so many is in `points`. */
  readonly every: number;
  /** Values of the first sample and every one that follows; shape (p, 6) float32; N, N m. */
  readonly points: ArrayRef;
}

/** Wrenches of a sensor, in its frame and in its own sign convention. */
export interface WrenchSeries {
  /** What it is, in words. */
  readonly name: string;
  /** At most one series of a sensor is expected. */
  readonly role: "expected" | "measured";
  /** Whether a calibration gives it, and not the prior or the log. */
  readonly calibrated: boolean;
  /** Largest force and largest moment; N, N m; 0 where all are absent. */
  readonly peak: readonly number[];
  /** Shape (n, 6) float32; N, N m. */
  readonly values: ArrayRef;
  /** Standard deviation of its error by the posterior of its calibration; shape (n, 6) float32; N, N m; or null. */
  readonly deviation: ArrayRef | null;
  /** Sphere that gravity draws by the model; on the expected series; N. */
  readonly reference_force: Sphere | null;
  /** The same of the moments; N m. */
  readonly reference_moment: Sphere | null;
  /** Ellipsoid that the forces draw; N; null where it is not identifiable. */
  readonly ellipsoid_force: Ellipsoid | null;
  /** Ellipsoid that the moments draw; N m; null where it is not identifiable. */
  readonly ellipsoid_moment: Ellipsoid | null;
  /** What is shown of all of it; null where it is short. */
  readonly overview: SeriesOverview | null;
}

/** A force-torque sensor; or a part that nothing touches, with what its sensors leave of its equation. */
export interface Sensor {
  /** Name in the robot model; of a part, in words. */
  readonly name: string;
  /** Serial number; empty for a part. */
  readonly serial: string;
  /** Link that its frame is given in. */
  readonly link: string;
  /** Pose of its frame; 16 numbers. */
  readonly link_H_sensor: readonly number[];
  /** Link that acts, in the sign of the reading; null for a part: no link does what is left over. */
  readonly acting: string | null;
  /** Link, or part, that is acted on. */
  readonly acted_on: string;
  /** The expected wrench, what was logged or the prior gives, then one series per calibration. */
  readonly wrenches: readonly WrenchSeries[];
}

/** Wrenches of the world on the robot at one place. */
export interface ContactSeries {
  /** Name of the contact. */
  readonly name: string;
  /** Link that is touched. */
  readonly link: string;
  /** Pose of the contact frame; 16 numbers. */
  readonly link_H_contact: readonly number[];
  /** In the contact frame; shape (n, 6) float32; N, N m. */
  readonly values: ArrayRef;
}

/** Contacts on skin, frame by frame: k frames with m contacts together. */
export interface SkinContactFrames {
  /** Start of each frame, increasing; s; shape (k,) float64. */
  readonly time_s: ArrayRef;
  /** How long a frame is shown, unless the next one comes first; s. */
  readonly hold_s: number;
  /** Where the contacts of each frame begin, and their number at the end; shape (k + 1,) uint32. */
  readonly first: ArrayRef;
  /** Centres of pressure, in the frame of the link; m; shape (m, 3) float32. */
  readonly place: ArrayRef;
  /** What each does to the link, along its axes; shape (m, 3) float32; N, but for contacts of a heuristic. */
  readonly force: ArrayRef;
  /** Half axes of one standard deviation of the force, as the columns of matrices; N; shape (m, 9) float32. */
  readonly spread: ArrayRef | null;
  /** Number of each contact, which it keeps from frame to frame; shape (m,) uint32. */
  readonly identity: ArrayRef;
}

/** A patch of artificial skin with its pressures; its v taxels are the corners of its facets. */
export interface SkinPatch {
  /** Name of the patch. */
  readonly name: string;
  /** Link that it is mounted on, in whose frame its vectors are. */
  readonly link: string;
  /** Taxels; m; shape (v, 3) float32. */
  readonly vertices: ArrayRef;
  /** Indices of vertices; shape (f, 3) uint32. */
  readonly faces: ArrayRef;
  /** Pressure of contacts in each frame, 0 beside them; Pa; shape (k, v) float32. */
  readonly pressure: ArrayRef;
  /** Largest of them; Pa. */
  readonly largest_Pa: number;
  /** Contacts, with their uncertainty. */
  readonly contacts: SkinContactFrames;
}

/** Contacts that a skinManager sees; what it calls force is a heuristic, not newtons. */
export interface SkinEventSeries {
  /** Name of the stream. */
  readonly name: string;
  /** Frame that the contacts are given in. */
  readonly link: string;
  /** Contacts; their force is the heuristic and has no spread. */
  readonly contacts: SkinContactFrames;
}

/** An interval of the experiment. */
export interface SceneInterval {
  /** Label. */
  readonly label: string;
  /** What its samples are for. */
  readonly use: "calibration" | "validation" | "ignore";
  /** Start; s. */
  readonly start_s: number;
  /** End, itself excluded; s. */
  readonly end_s: number;
  /** Support frame. */
  readonly support: string | null;
  /** Whether the experiment file names supports; that of a wrist sensor is always its own frame. */
  readonly states_support: boolean;
}

/** Something that is wrong with the recording. */
export interface SceneFinding {
  /** Stream. */
  readonly stream: string;
  /** Kind in one word. */
  readonly kind: string;
  /** Description. */
  readonly message: string;
  /** First instant; s; null where it has none. */
  readonly start_s: number | null;
  /** Last instant; s; null where it has none. */
  readonly end_s: number | null;
}

/** Where samples of a running stream come from; the arrays over time are then none of the block and begin empty. */
export interface LiveFeed {
  /** Address that answers with a `LiveUpdate`. */
  readonly url: string;
  /** Time that is shown; s. */
  readonly window_s: number;
}

/** A sensor of a running stream, as it is now. */
export interface LiveSensorState {
  /** `ok`, or what is wrong with the last sample. */
  readonly status: string;
  /** Samples so far. */
  readonly samples: number;
  /** Samples with a fault. */
  readonly faulty: number;
  /** Change of the bias since the tare; 6 numbers; N, N m; null without a tare. */
  readonly drift: readonly number[] | null;
}

/**
 * What came since the last one, in a line.
 *
 * After it come the new rows, array by array: time, positions, root, and values and deviation of every series.
 */
export interface LiveUpdate {
  /** Number of the first row, from 0 at the begin of the stream. */
  readonly first: number;
  /** Rows that follow. */
  readonly rows: number;
  /** Samples so far. */
  readonly total: number;
  /** Packets that could be read. */
  readonly received: number;
  /** Packets that never came; null where that cannot be known. */
  readonly lost: number | null;
  /** Packets that came late. */
  readonly late: number;
  /** Packets that came twice. */
  readonly repeated: number;
  /** Time since the last packet; s. */
  readonly silent_s: number;
  /** Why the stream ended; null while it lasts. */
  readonly ended_by: string | null;
  /** Sensors in the order of the scene. */
  readonly sensors: readonly LiveSensorState[];
}

/** Everything that the page shows. */
export interface Scene {
  /** Form of the header. */
  readonly schema: "forcetorque/scene/1";
  /** Name of the experiment. */
  readonly title: string;
  /** Files with hashes and code version, a line each. */
  readonly provenance: readonly string[];
  /** Number of samples n. */
  readonly samples: number;
  /** Stamp of second 0 as a decimal number; ns. */
  readonly start_ns: string;
  /** End of the log over all streams, itself excluded: the latest end that an interval may have; s. */
  readonly end_s: number;
  /** Seconds since the start of the recording, as intervals count them; shape (n,) float64. */
  readonly time_s: ArrayRef;
  /** Joint coordinates; shape (n, d) float32; rad or m. */
  readonly positions: ArrayRef;
  /** Joints of the d columns. */
  readonly coordinates: readonly string[];
  /** Pose of the root link in the world, z up: x, y, z, then qw, qx, qy, qz; shape (n, 7) float32; m. */
  readonly root: ArrayRef;
  /** The robot. */
  readonly robot: Robot;
  /** Sensors. */
  readonly sensors: readonly Sensor[];
  /** Contacts that were estimated. */
  readonly contacts: readonly ContactSeries[];
  /** Patches of skin with a calibration. */
  readonly skin: readonly SkinPatch[];
  /** Contacts that a skinManager sees. */
  readonly skin_events: readonly SkinEventSeries[];
  /** Intervals in the order of the experiment. */
  readonly intervals: readonly SceneInterval[];
  /** Findings in the order of time. */
  readonly findings: readonly SceneFinding[];
  /** What is absent, and why. */
  readonly notes: readonly string[];
  /** Where the page sends saved samples; null in a file. */
  readonly annotations_url: string | null;
  /** Where samples come from while a robot runs; null for a recording. */
  readonly live: LiveFeed | null;
}
