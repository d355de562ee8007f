# SPDX-License-Identifier: BSD-3-Clause
"""Loads of simulated arms by their logs alone: how often intervals hold the truth, and mistakes of users are named.

A UR5 by RTDE and by a bag, and a Panda by external wrenches and by joint torques. Mass, centre, zero, tool centre
point, declared payload and twelve postures are drawn by the seed; moves between postures have noise that forgets itself
in a second. A mistake counts as named where the refusal or an account of the answer has its words.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from benchmarks.harness import write_cases
from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, FormatError
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.log_without_experiment import described_log, experiment_of_description, load_of_torque_logs
from forcetorque.payload.result import LoadRow
from tests.formats.franka.states import write_states, write_table
from tests.formats.ros.bags import TF, Types, write_bag
from tests.formats.ur_rtde.recordings import write_text
from tests.payload import simulated_ur5 as ur5
from tests.payload.simulated_panda import held, moved

EVERY = 5
"""One sample in five goes into a bag."""
REVERSED, TURNED, MIXED, ANOTHER_POINT = "reversed", "wrench turned twice", "mixed units", "another point"
WORLD = "wrench in world axes"


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmCase:
    """A log."""

    arm: str
    """Arm and form of its log."""
    mistake: str
    """What is wrong with it; empty for nothing."""
    seed: int
    mass_holds: bool
    """Whether the interval of the mass holds the truth."""
    centre_holds: int
    """How many of the three coordinates of the centre do."""
    named: bool
    """Whether the mistake is named; of none whether something is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Log:
    """A log with its truth, and the words that name its mistake."""

    path: Path
    mass: float
    centre: FloatArray
    specified: Mapping[str, object]
    words: tuple[str, ...] = ()


def _rtde(folder: Path, seed: int, change: Callable[[ur5.Recording], ur5.Recording], *words: str) -> Log:
    shares = (0.0,) if words else (0.0, 0.5, 1.5)
    recording = change(ur5.simulated(seed, declared_shares=shares))
    path = write_text(folder / "log.csv", recording.columns, delimiter=",")
    stated = {"moment_about": "flange"}
    return Log(path=path, mass=recording.mass, centre=recording.centre, specified=stated, words=words)


def _bag(folder: Path, seed: int, *words: str) -> Log:
    recording, types = ur5.simulated(seed, declared_shares=(0.0,)), Types("mcap")
    pose, reading = recording.pose[::EVERY], recording.reading[::EVERY].copy()
    if WORLD in words:
        halves = (reading[:, :3], reading[:, 3:])
        reading = np.hstack([np.einsum("nij,nj->ni", pose[:, :3, :3], half) for half in halves])
    if MIXED in words:
        reading[:, 3:] *= 1e3
    turns = Rotation.from_matrix(pose[:, :3, :3]).as_quat()
    rows = enumerate(zip(turns, pose[:, :3, 3], strict=True))
    sent = [types.make(TF, transforms=[types.transform(k, turn, place, "base", "tool0")]) for k, (turn, place) in rows]
    wrenches = [types.wrench(k, row, "tool0") for k, row in enumerate(reading)]
    stated = {"measure_direction": "child_to_parent"} if words else {}
    path = write_bag(folder, "mcap", {"/ft": ("geometry_msgs/msg/WrenchStamped", wrenches), "/tf": (TF, sent)})
    return Log(path=path, mass=recording.mass, centre=recording.centre, specified=stated, words=words)


def _states(folder: Path, seed: int, *words: str, **mistake: float) -> Log:
    arm = moved(seed, declared_shares=(0.0,)) if words else moved(seed)
    path = write_states(folder / "log", arm.states(**mistake))  # type: ignore[arg-type]  # a flag is a number too
    return Log(path=path, mass=arm.mass, centre=arm.centre, specified={}, words=words)


def _torques(folder: Path, seed: int, *words: str, sense: float = 1.0) -> Log:
    arm = held(seed)
    path = write_table(folder / "log.csv", arm.states(sense=sense))
    return Log(path=path, mass=arm.mass, centre=arm.centre, specified={"payload_kg": 0.0}, words=words)


def _with_raw(recording: ur5.Recording) -> ur5.Recording:
    return ur5.with_raw_wrench(ur5.about_tcp(recording))


LOGS: Mapping[tuple[str, str], Callable[[Path, int], Log]] = {
    ("UR5, RTDE", ""): lambda folder, seed: _rtde(folder, seed, lambda same: same),
    ("UR5, RTDE", "reaction"): lambda folder, seed: _rtde(folder, seed, ur5.reaction, REVERSED),
    ("UR5, RTDE", "tool axes"): lambda folder, seed: _rtde(folder, seed, ur5.tool_axes, TURNED),
    ("UR5, RTDE", "N mm"): lambda folder, seed: _rtde(folder, seed, ur5.newton_millimetres, MIXED),
    ("UR5, RTDE", "mm"): lambda folder, seed: _rtde(folder, seed, ur5.millimetres, "it is in mm"),
    ("UR5, RTDE", "about the TCP"): lambda folder, seed: _rtde(folder, seed, ur5.about_tcp, ANOTHER_POINT),
    ("UR5, RTDE", "about the TCP, raw logged"): lambda folder, seed: _rtde(
        folder, seed, _with_raw, "moment_about: expected tcp"
    ),
    ("UR5, bag", ""): _bag,
    ("UR5, bag", "base axes"): lambda folder, seed: _bag(folder, seed, WORLD),
    ("UR5, bag", "N mm"): lambda folder, seed: _bag(folder, seed, MIXED),
    ("Panda, wrench", ""): _states,
    ("Panda, wrench", "reaction"): lambda folder, seed: _states(folder, seed, REVERSED, sense=1.0),
    ("Panda, wrench", "tool axes"): lambda folder, seed: _states(folder, seed, TURNED, along_flange=True),
    ("Panda, wrench", "N mm"): lambda folder, seed: _states(folder, seed, MIXED, moment_unit=1e3),
    ("Panda, wrench", "mm"): lambda folder, seed: _states(folder, seed, MIXED, "it is in mm", pose_unit=1e3),
    ("Panda, torques", ""): _torques,
    ("Panda, torques", "reaction"): lambda folder, seed: _torques(folder, seed, REVERSED, sense=-1.0),
}
"""Makes a log by arm and mistake."""


def _answer(log: Log) -> tuple[LoadRow, list[str]]:
    """The load, and what is named."""
    description = described_log(log.path, log.specified)
    if description.torques is not None:
        return load_of_torque_logs({log.path: description.torques}, log.specified).load, []
    experiment, _, arm = experiment_of_description(log.path, description, log.specified, log.path.parent)
    weighed = weigh_load([SensorRun(experiment, experiment.sensors[0])])
    return weighed.loads[0], [*(row.name for row in weighed.hypotheses), *arm.contradictions]


def run_case(arm: str, mistake: str, seed: int) -> ArmCase:
    """Weigh the load of one log.

    Args:
        arm: Arm and form of its log.
        mistake: What is wrong with it.
        seed: Seed of all that is drawn.

    Returns:
        What came of it.
    """
    with tempfile.TemporaryDirectory() as folder:
        log = LOGS[arm, mistake](Path(folder), seed)
        try:
            load, named = _answer(log)
        except (FitError, FormatError) as error:
            load, named = None, [str(error)]
    error = (
        np.full(3, np.inf) if load is None else np.abs(np.array(load.centre_of_mass_m, dtype=np.float64) - log.centre)
    )
    half = np.zeros(3) if load is None else np.array(load.centre_of_mass_half_width_95_m, dtype=np.float64)
    is_held = load is not None and abs((load.mass_kg or 0.0) - log.mass) <= (load.mass_half_width_95_kg or 0.0)
    is_named = any(words in text for words in log.words for text in named) if mistake else bool(named)
    return ArmCase(
        arm=arm,
        mistake=mistake,
        seed=seed,
        mass_holds=bool(is_held),
        centre_holds=int((error <= half).sum()),
        named=is_named,
    )


def _cases(names: list[tuple[str, str]], seeds: range) -> Iterator[ArmCase]:
    for arm, mistake in names:
        cases = [run_case(arm, mistake, seed) for seed in seeds]
        mass, centre, named = (
            sum(getattr(case, name) for case in cases) for name in ("mass_holds", "centre_holds", "named")
        )
        rates = f"mass {mass}, centre {centre / 3:.1f}, something is named {named}" if not mistake else f"named {named}"
        print(f"{arm}, {mistake or 'nothing wrong'}: {rates} of {len(cases)}", flush=True)
        yield from cases


def main() -> None:
    """Run all cases, print the rates, and write every case."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=100, help="how many of each arm and mistake")
    parser.add_argument("--first-seed", type=int, default=0)
    parser.add_argument("--quick", action="store_true", help="two seeds")
    parser.add_argument("--json", type=Path, help="file for every case")
    parser.add_argument("--only", default="", help="part of the arm and mistake, such as 'Panda, wrench, mm'")
    options = parser.parse_args()
    names = [one for one in LOGS if options.only in ", ".join(one)]
    count = 2 if options.quick else options.seeds
    write_cases(options.json, list(_cases(names, range(options.first_seed, options.first_seed + count))))


if __name__ == "__main__":
    main()
