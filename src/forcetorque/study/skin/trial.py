# SPDX-License-Identifier: BSD-3-Clause
"""One trial of the experiment of thesis 7.3: forces and torques estimated from its files, and the truth."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import EstimationError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.recordings import SIMPLE_AREA_M2, Loading
from forcetorque.skin.wrench.wrench import WrenchChoice, skin_wrench
from forcetorque.study.skin.raised_leg import KNEE, LOADS, Load, LoadTruth, write_leg

LOADING: Final = Loading(rest_s=10.0, ramp_s=1.0, hold_s=10.0)
"""Each load rests for ten seconds."""
STEPS: Final = 5
"""Steps of a trial that `trial` counts."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LoadTrial:
    """What is estimated of one load, and the truth."""

    truth: LoadTruth
    """What the load does."""
    simple_N: float
    """Mean force by (7.13)."""
    interpolated_N: float
    """Mean norm of the force of (7.4), by kriging."""
    beyond_range: bool
    """Whether a taxel measured more than it was calibrated for."""
    ft_Nm: FloatArray
    """Torque of the knee by the sensor; shape (n,)."""
    skin_Nm: FloatArray
    """By skin, without the heat that the warm-up shows; shape (n,)."""
    hot_Nm: FloatArray
    """By skin, with heat left in; shape (n,)."""

    @property
    def load(self) -> Load:
        """The load."""
        return self.truth.load

    @property
    def weight_N(self) -> float:
        """Its weight, the reference of Table 7.1."""
        return self.load.mass_kg * STANDARD_GRAVITY

    def rmse(self, torque: FloatArray, reference: FloatArray | None = None) -> float:
        """Compute the root mean square error of a torque.

        Args:
            torque: Estimate; shape (n,); N m.
            reference: Another estimate; shape (n,); N m. The truth if None.

        Returns:
            The error; N m.
        """
        return float(np.sqrt(np.mean((torque - (self.truth.knee_Nm if reference is None else reference)) ** 2)))


def trial(
    folder: Path,
    layout: SkinLayout,
    loads: Sequence[Load] = LOADS,
    *,
    seed: int,
    loading: Loading = LOADING,
    done: Callable[[], None] = lambda: None,
) -> list[LoadTrial]:
    """Write the recording, and estimate from its files as a user would.

    Args:
        folder: Where files are written.
        layout: Skin in the frame of the shin.
        loads: Loads in their order.
        seed: Of taxels, noise, offset and positions.
        loading: How long each load rests.
        done: Called after each of `STEPS` steps.

    Returns:
        A record per load.
    """
    truths = write_leg(folder, layout, loads, seed=seed, loading=loading)
    done()
    torques = {}
    for name in ("ft", "skin_warm", "skin_cold"):
        torques[name] = list(_knee_torques(folder / f"{name}.toml"))
        done()
    forces = list(_forces(folder, loads, loading))
    done()
    trials = []
    for k, (truth, (simple, interpolated, beyond)) in enumerate(zip(truths, forces, strict=True)):
        stamps, ft = torques["ft"][k]
        skin, hot = (_at(stamps, *torques[name][k]) for name in ("skin_warm", "skin_cold"))
        trials.append(
            LoadTrial(
                truth=truth,
                simple_N=simple,
                interpolated_N=interpolated,
                beyond_range=beyond,
                ft_Nm=ft,
                skin_Nm=skin,
                hot_Nm=hot,
            )
        )
    return trials


def _knee_torques(file: Path) -> Iterator[tuple[IntArray, FloatArray]]:
    """Stamps and torque of the knee in each interval."""
    experiment = load_experiment(file, Purpose.FORCES)
    for interval in estimate_experiment(experiment, corrections_of(experiment, {})):
        yield interval.stamp_ns, interval.estimates.torque(KNEE)


def _at(stamps: IntArray, skin_stamps: IntArray, values: FloatArray) -> FloatArray:
    """Values at the stamps of the sensor, which are some of those of the skin."""
    common = np.isin(skin_stamps, stamps)
    if not np.array_equal(skin_stamps[common], stamps):
        raise EstimationError("torques by skin: expected a sample at every stamp of the sensor, got others")
    return values[common]


def _forces(folder: Path, loads: Sequence[Load], loading: Loading) -> Iterator[tuple[float, float, bool]]:
    """Simple and interpolated force while each load rests, and whether a taxel was beyond its range."""
    choice = WrenchChoice(taxel_area_mm2=1e6 * SIMPLE_AREA_M2)
    wrench = skin_wrench(folder / "skin_warm.toml", folder / "warm.json", choice=choice)
    forces, seconds = wrench.picture.forces, wrench.picture.seconds
    simple, interpolated = (next(v for name, v in forces.items() if name.startswith(m)) for m in ("simple", "kriging"))
    for k in range(len(loads)):
        begin = loading.rest_s + k * loading.turn_s + loading.ramp_s
        held: BoolArray = (seconds > begin) & (seconds < begin + loading.hold_s)
        beyond = any(row.beyond_range for row in wrench.contacts if begin < row.time_s < begin + loading.hold_s)
        yield float(simple[held].mean()), float(interpolated[held].mean()), beyond
