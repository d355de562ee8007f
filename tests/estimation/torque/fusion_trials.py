# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of a simulated arm from its FT sensor, from skin, and from motor currents, fused and against the truth.

`python -m tests.estimation.torque.fusion_trials` prints the figures of docs/estimation/fusion.md. Something pushes the
forearm of the moving arm. Its joints' currents bear friction, which is fitted on a recording of its own, with nothing
touching and the FT sensor trusted. Masses and motion are exact here; `tests/estimation/model_error_trials.py` has arms
that differ from their model.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.estimation.torque.covariance_fusion import Fusion, fuse
from forcetorque.estimation.torque.motor_torque import Friction, drive_torque, fit_friction, motor_source
from forcetorque.estimation.torque.torque_source import TorqueSource, wrench_source
from forcetorque.estimation.uncertain.input_errors import Uncertainty
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import random_movement
from forcetorque.simulation.robots import ARM_URDF
from tests.estimation.torque.sources import three
from tests.scenes.simulated_motor import SimulatedMotor

JOINTS: Final = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow")
"""Joints that bear the push; the torque of the wrist is that of the model, whatever FT and skin say."""
SEEDS: Final = 50
JUDGED: Final = 1000
"""First seed: figures are of seeds that nothing was chosen on."""
RATE_HZ: Final = 50.0
DURATION_S: Final = 60.0
LINK: Final = "forearm"
TOUCHED_M: Final = np.array([0.03, 0.0, -0.1])
"""Where the push is; in the forearm; m."""
NORMAL: Final = np.array([-1.0, 0.0, 0.0])
"""Into the robot, along which skin feels the push."""

FT_NOISE: Final = np.diag([0.2, 0.2, 0.2, 0.005, 0.005, 0.005]) ** 2
FT_OFFSET: Final = np.diag([0.5, 0.5, 0.5, 0.01, 0.01, 0.01])
"""Standard deviations of noise and of the offset of one power-up; N, N m."""
SKIN_GAIN: Final = 0.05
SKIN_TANGENT: Final = 0.1
"""Of the two tangential forces over the normal one, which skin does not feel."""
SKIN_NOISE_N: Final = 0.3
SKIN_PLACE_M: Final = 2e-3
"""Of the centre of pressure, sample by sample."""
FLOOR_NM: Final = 0.01
"""Of what encoders leave open, sample by sample, in FT and skin each."""
POSTURE_S: Final = 1.0
"""Time over which errors of the model repeat themselves, where it has any; s; the default of `[fusion]`."""
STANDSTILL: Final = 0.02
VELOCITY_NOISE: Final = 2e-3

MOTOR: Final = SimulatedMotor(
    torque_constant=0.05,
    gear_ratio=100.0,
    coulomb=1.5,
    viscous=0.6,
    inertia=0.08,
    noise_a=0.02,
    ripple=0.1,
    ripple_time_s=0.1,
)
OFFSET_A: Final = 0.01
"""Standard deviation of what a current reads too much; it stays from one recording to the next."""

DRAWN: Final = 500
"""Recordings of sources that are drawn and not simulated, to count false alarms."""

HOT_N: Final = 10.0
FT_BROKEN_N: Final = 5.0
FRICTION_FACTOR: Final = 1.3


@dataclass(frozen=True, kw_only=True)
class Faults:
    """What is broken, beyond what the covariances allow for."""

    hot_n: float = 0.0
    """What skin feels too much at the end; half of it at the start; N."""
    ft_n: float = 0.0
    """Offset of the FT sensor, in a direction of its own; N."""
    friction: float = 1.0
    """Friction over the one that was fitted."""
    variance: float = 1.0
    """Stated over true variance, of the sources below."""
    misstated: tuple[str, ...] = ("ft", "skin", "current")
    """Sources whose variance that is."""

    @property
    def source(self) -> str | None:
        """Which source is broken."""
        return "skin" if self.hot_n else "ft" if self.ft_n else "current" if self.friction != 1.0 else None


FAULTS: Final = {
    "sound": Faults(),
    "hot skin": Faults(hot_n=HOT_N),
    "FT offset": Faults(ft_n=FT_BROKEN_N),
    "friction": Faults(friction=FRICTION_FACTOR),
    "variances 4 times too small": Faults(variance=0.25),
    "variances 4 times too large": Faults(variance=4.0),
    "variance of FT alone 4 times too small": Faults(variance=0.25, misstated=("ft",)),
}


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One recording."""

    truth: FloatArray
    """True torques; shape (n, j); N m."""
    sources: tuple[TorqueSource, ...]
    """FT, skin and current."""
    fusion: Fusion
    """All of them together."""

    def errors(self, name: str) -> FloatArray:
        """Errors of a source, or of `fused`, where all sources know the torque, NaN elsewhere."""
        torque = {source.name: source.torque for source in self.sources} | {"fused": self.fusion.torque}
        known = np.all([np.isfinite(source.torque) for source in self.sources], axis=0)
        return np.where(known, torque[name] - self.truth, np.nan)


class Arm:
    """The arm of one seed: its motors, and how it moves and is pushed."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.model = read_urdf(ARM_URDF)
        self.robot = self.model
        self.model_deviation = np.full(len(JOINTS), FLOOR_NM)
        self.noise_time_s = 0.0
        self.stand = Stand(model=self.model, support="base", gravity_direction=np.array([0.0, 0.0, -1.0]))
        self.motors = [replace(MOTOR, offset_a=OFFSET_A * self.rng.standard_normal()) for _ in JOINTS]
        self.root = RootMotion.fixed(self.stand.gravity_direction, gravity=self.stand.gravity)
        self.push = Contact(link=LINK, name="push", type=ContactType.KNOWN)
        self.anywhere = Contact(link=LINK, name="anything")
        self.seconds = np.arange(round(DURATION_S * RATE_HZ)) / RATE_HZ
        self.stamp_ns = np.rint(self.seconds * 1e9).astype(np.int64)

    def with_robot(self, robot: RobotModel) -> Arm:
        """Let the arm be another one than its model, whose errors change with the posture."""
        self.robot = robot
        self.noise_time_s = POSTURE_S
        return self

    def stating(self, model_deviation: FloatArray) -> Arm:
        """State other deviations of the model; shape (j,); N m."""
        self.model_deviation = model_deviation
        return self

    def question(self, *contacts: Contact, ft: bool = False) -> Question:
        """Ask for the torques; the base takes up what else there is."""
        tree = build_tree(self.model, "base")
        measured = ("arm_ft",) if ft else ()
        return Question(
            tree=tree,
            measured=measured,
            contacts=(Contact(link="base"), *contacts),
            torques=JOINTS,
            torque_sum=TorqueSum.SUB_MODEL,
        )

    def motion(self) -> JointMotion:
        """Move at random."""
        return random_movement(self.stand, rng=self.rng, duration_s=DURATION_S).joints(self.seconds)

    def trial(self, faults: Faults) -> Trial:
        """Fit friction while nothing touches, then be pushed, and tell the torques."""
        frictions = self._frictions()
        motion = self.motion()
        normal = 15.0 + 5.0 * np.sin(0.5 * self.seconds + self.rng.uniform(0.0, 6.0))
        truth, ft_true = self.truth(motion, self.pushes(normal, SKIN_TANGENT * self.rng.standard_normal(2)))
        ft = self._ft(motion, ft_true, faults.ft_n)
        skin = self._skin(motion, normal, faults.hot_n)
        current = self._current(motion, truth, frictions, faults.friction)
        sources = tuple(
            _restated(source, faults.variance if source.name in faults.misstated else 1.0)
            for source in (ft, skin, current)
        )
        return Trial(truth=truth, sources=sources, fusion=fuse(sources))

    def pushes(self, normal: FloatArray, tangent: FloatArray) -> FloatArray:
        """The push as a wrench about the origin of the link; shape (n, 6)."""
        force = normal[:, None] * (NORMAL + np.array([0.0, *tangent]))
        return np.hstack([force, np.cross(TOUCHED_M, force)])

    def truth(self, motion: JointMotion, pushes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """True torques, and what a perfect FT sensor reads."""
        tree = build_tree(self.robot, "base")
        asked = Question(tree=tree, contacts=(self.push,), torques=JOINTS, expected=("arm_ft",), equations=())
        answer = estimate(asked, motion, self.root, known=Wrenches.of({"push": pushes}))
        return answer.torques, answer.expected_of("arm_ft")

    def _ft(self, motion: JointMotion, truth: FloatArray, broken_n: float) -> TorqueSource:
        offset = FT_OFFSET @ self.rng.standard_normal(6)
        direction = self.rng.standard_normal(3)
        offset[:3] += broken_n * direction / np.linalg.norm(direction)
        reading = truth + offset + self.rng.standard_normal(truth.shape) @ np.sqrt(FT_NOISE)
        source = wrench_source(
            "ft",
            self.question(self.anywhere, ft=True),
            motion,
            self.root,
            self.stamp_ns,
            uncertainty=Uncertainty(measured={"arm_ft": FT_NOISE}, lasting={"arm_ft": FT_OFFSET}),
            model_deviation=self.model_deviation,
            noise_time_s=self.noise_time_s,
            measured=Wrenches.of({"arm_ft": reading}),
        )
        return replace(source, torque=source.torque + FLOOR_NM * self.rng.standard_normal(source.torque.shape))

    def _skin(self, motion: JointMotion, normal: FloatArray, hot_n: float) -> TorqueSource:
        n = len(normal)
        gain = 1.0 + SKIN_GAIN * self.rng.standard_normal()
        hot = np.linspace(0.5, 1.0, n) * hot_n
        felt = gain * normal + hot + SKIN_NOISE_N * self.rng.standard_normal(n)
        wrench = self.pushes(felt, np.zeros(2))
        shift = SKIN_PLACE_M * self.rng.standard_normal((n, 2))
        wrench[:, 4:] += np.stack([-shift[:, 1] * felt, shift[:, 0] * felt], axis=1)
        unit = np.stack([self.pushes(np.ones(1), t)[0] for t in np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])])
        columns = np.vstack([unit[0], unit[1:] - unit[0]])
        lasting = felt[:, None, None] * (columns * np.array([[SKIN_GAIN], [SKIN_TANGENT], [SKIN_TANGENT]])).T
        place = np.zeros((6, 6))
        place[4, 4] = place[5, 5] = SKIN_PLACE_M**2
        noise = SKIN_NOISE_N**2 * np.outer(unit[0], unit[0]) + felt[:, None, None] ** 2 * place
        source = wrench_source(
            "skin",
            self.question(self.push),
            motion,
            self.root,
            self.stamp_ns,
            uncertainty=Uncertainty(known={"push": noise}, lasting={"push": lasting}),
            model_deviation=self.model_deviation,
            noise_time_s=self.noise_time_s,
            known=Wrenches.of({"push": wrench}),
        )
        return replace(source, torque=source.torque + FLOOR_NM * self.rng.standard_normal(source.torque.shape))

    def _drive_torques(self, motion: JointMotion, torque: FloatArray, factor: float) -> FloatArray:
        drive = []
        for k, (joint, motor) in enumerate(zip(JOINTS, self.motors, strict=True)):
            column = motion.names.index(joint)
            motions = (motion.velocity[:, column], motion.acceleration[:, column])
            current = motor.current(torque[:, k], *motions, self.rng, rate_hz=RATE_HZ, friction_factor=factor)
            constant, ratio = motor.torque_constant, motor.gear_ratio
            drive.append(drive_torque(joint, current, torque_constant=constant, gear_ratio=ratio))
        return np.stack(drive, axis=1)

    def _seen(self, motion: JointMotion) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration as they are told from encoders."""
        columns = [motion.names.index(joint) for joint in JOINTS]
        velocity = motion.velocity[:, columns]
        return velocity + VELOCITY_NOISE * self.rng.standard_normal(velocity.shape), motion.acceleration[:, columns]

    def _frictions(self) -> list[Friction]:
        """Fit every joint while nothing touches and the FT sensor is trusted."""
        motion = self.motion()
        truth, reading = self.truth(motion, np.zeros((len(self.seconds), 6)))
        trusted = self._ft(motion, reading, 0.0)
        drive, (velocity, acceleration) = self._drive_torques(motion, truth, 1.0), self._seen(motion)
        return [
            fit_friction(
                joint,
                drive[:, k],
                trusted.torque[:, k],
                velocity[:, k],
                acceleration[:, k],
                period_s=1.0 / RATE_HZ,
                standstill=STANDSTILL,
                trusted_variance=trusted.noise[:, k, k],
                trusted_lasting=trusted.lasting[:, k],
                trusted_shared=trusted.shared[:, k],
            )
            for k, joint in enumerate(JOINTS)
        ]

    def _current(
        self, motion: JointMotion, truth: FloatArray, frictions: Sequence[Friction], factor: float
    ) -> TorqueSource:
        drive = self._drive_torques(motion, truth, factor)
        return motor_source("current", frictions, self.stamp_ns, drive, *self._seen(motion))


def _restated(source: TorqueSource, factor: float) -> TorqueSource:
    """The same source with another variance."""
    if factor == 1.0:
        return source
    root = np.sqrt(factor)
    return replace(source, noise=factor * source.noise, lasting=root * source.lasting, shared=root * source.shared)


def trials(faults: Faults, seeds: int = SEEDS, first: int = JUDGED) -> Iterator[Trial]:
    """Be pushed once per seed."""
    for seed in range(first, first + seeds):
        yield Arm(seed).trial(faults)


@dataclass(frozen=True, kw_only=True)
class Figures:
    """What trials amount to."""

    rmse: dict[str, FloatArray]
    """Root mean square errors per joint, pooled over seeds and samples; N m."""
    named: dict[str | None, int]
    """In how many recordings each source was named."""
    conflicts: int
    """Recordings with a conflict."""
    windows: float
    """Share of windows with a conflict."""
    covered: float
    """Share of 95 % intervals that hold the truth, samples and joints together."""
    covered_unwidened: float
    """The same, had no conflict widened them."""
    covered_by_seed: FloatArray
    """The same, by recording."""
    innovation: dict[str, float]
    """Mean of squared normalised innovations, per degree of freedom."""


def figures(some: Sequence[Trial]) -> Figures:
    """Sum trials up."""
    names = ("ft", "skin", "current", "fused")
    squares = {name: np.concatenate([trial.errors(name) for trial in some]) ** 2 for name in names}
    named: dict[str | None, int] = {}
    for trial in some:
        named[trial.fusion.conflict.source] = named.get(trial.fusion.conflict.source, 0) + 1
    covered = np.array([_covered(trial, 1.0) for trial in some])
    windows = [window.is_there for trial in some for window in trial.fusion.windows]
    innovations = {
        name: [trial.fusion.conflict.innovation(name) for trial in some] for name in ("ft", "skin", "current")
    }
    return Figures(
        rmse={name: np.sqrt(np.nanmean(square, axis=0)) for name, square in squares.items()},
        named=named,
        conflicts=sum(trial.fusion.conflict.is_there for trial in some),
        windows=float(np.mean(windows)),
        covered=float(covered.mean()),
        covered_unwidened=float(np.mean([_covered(trial, 1.0 / _widening(trial.fusion)) for trial in some])),
        covered_by_seed=covered,
        innovation={
            name: sum(d.chi2 for d in several) / sum(d.degrees_of_freedom for d in several)
            for name, several in innovations.items()
        },
    )


def _widening(fusion: Fusion) -> float:
    """Factor by which a conflict that nobody alone explains widens intervals."""
    alone = fusion.conflict.source is not None or not fusion.conflict.is_there
    return 1.0 if alone else max(1.0, fusion.conflict.everyone.total.ratio) ** 0.5


def _covered(trial: Trial, factor: float) -> float:
    return float(np.mean(np.abs(trial.fusion.torque - trial.truth) <= factor * trial.fusion.half_width))


def sound_rmse(some: Sequence[Trial], broken: str | None) -> FloatArray:
    """Error of the sound sources fused by themselves, without any that is broken; per joint; N m."""
    squares = []
    for trial in some:
        alone = fuse([source for source in trial.sources if source.name != broken])
        squares.append(np.where(np.isfinite(trial.errors("fused")), alone.torque - trial.truth, np.nan) ** 2)
    rmse: FloatArray = np.sqrt(np.nanmean(np.concatenate(squares), axis=0))
    return rmse


def pooled(rmse: FloatArray) -> float:
    """Put the errors of joints together."""
    return float(np.sqrt((rmse**2).mean()))


def in_words(what: str, faults: Faults, some: Sequence[Trial]) -> str:
    """Write figures down."""
    told = figures(some)
    sound = pooled(sound_rmse(some, faults.source))
    low, high = np.quantile(told.covered_by_seed, [0.1, 0.9])
    lines = [f"{what}: {len(some)} seeds, joints {', '.join(JOINTS)}"]
    for name, rmse in told.rmse.items():
        lines.append(f"  {name:8s} RMSE {' '.join(f'{v:.3f}' for v in rmse)}, all {pooled(rmse):.3f} N m")
    lines += [
        f"  fused over best single source: {pooled(told.rmse['fused']) / best_single(told.rmse):.3f}",
        f"  fused over sound sources alone: {pooled(told.rmse['fused']) / sound:.3f}",
        f"  conflict in {told.conflicts} of {len(some)}, named {told.named}; in {told.windows:.2%} of windows",
        f"  95 % intervals hold {told.covered:.1%} ({told.covered_unwidened:.1%} unwidened)",
        f"  the same in the middle 80 % of recordings: {low:.1%} to {high:.1%}",
        f"  squared normalised innovations {', '.join(f'{k} {v:.2f}' for k, v in told.innovation.items())}",
    ]
    return "\n".join(lines)


def best_single(rmse: Mapping[str, FloatArray]) -> float:
    """Error of the best of the sources, all joints together; N m."""
    return min(pooled(error) for name, error in rmse.items() if name != "fused")


def alarms(rate: float, recordings: int = DRAWN) -> tuple[int, int]:
    """Count conflicts between sources whose errors are drawn as they state them."""
    some = (fuse(three(seed), false_alarm=rate).conflict.is_there for seed in range(JUDGED, JUDGED + recordings))
    return sum(some), recordings


def main() -> None:
    """Print errors, conflicts and coverage for everything that may be broken."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--seeds", type=int, default=SEEDS)
    seeds: int = parser.parse_args().seeds
    for what, faults in FAULTS.items():
        print(in_words(what, faults, list(trials(faults, seeds))), flush=True)  # noqa: T201
    for rate in (0.01, 0.05):
        count, of = alarms(rate, 10 * seeds)
        print(f"stated rate {rate:.0%}: {count} false alarms in {of} recordings of drawn sources")  # noqa: T201


if __name__ == "__main__":
    main()
