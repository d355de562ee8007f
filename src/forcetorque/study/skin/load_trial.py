# SPDX-License-Identifier: BSD-3-Clause
"""One trial of the experiment of thesis 7.3, from its files, and the same loads as Tables 7.1 to 7.3 print them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
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
from forcetorque.results.table import Row
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.recordings import SIMPLE_AREA_M2, Loading
from forcetorque.skin.wrench.skin_wrench import WrenchChoice, skin_wrench
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


class PrintedLoad(Row):
    """What the thesis prints of one load; None where it prints nothing."""

    simple_N: float | None = None
    """Table 7.1: force by (7.13)."""
    interpolated_N: float | None = None
    """Table 7.1: norm of the force of (7.4)."""
    ft_Nm: float | None = None
    """Table 7.2: mean torque by the force-torque sensor."""
    skin_Nm: float | None = None
    """Table 7.2: mean torque by interpolated skin."""
    ft_sd_Nm: float | None = None
    """Table 7.2: standard deviation by the sensor."""
    skin_sd_Nm: float | None = None
    """Table 7.2: standard deviation by skin."""
    rmse_to_ft_Nm: float | None = None
    """Table 7.2: root mean square of skin less sensor."""
    leaning_ft_Nm: float | None = None
    """Table 7.3: mean torque by the sensor."""
    leaning_skin_Nm: float | None = None
    """Table 7.3: mean torque by skin."""
    leaning_difference_Nm: float | None = None
    """Table 7.3: average difference."""
    leaning_rmse_to_ft_Nm: float | None = None
    """Table 7.3: root mean square of skin less sensor."""

    @property
    def leaning_change_Nm(self) -> float | None:
        """Mean torque by skin less that by the sensor, of Table 7.3."""
        skin, ft = self.leaning_skin_Nm, self.leaning_ft_Nm
        return None if skin is None or ft is None else skin - ft


_FORCES: Final[Mapping[Load, tuple[float, float]]] = {
    Load(mass_kg=0.5, on_top=True): (4.6376, 5.2482),
    Load(mass_kg=1.0, on_top=False): (7.591, 9.935),
    Load(mass_kg=1.0, on_top=True): (8.184, 10.095),
    Load(mass_kg=1.5, on_top=False): (11.606, 14.142),
    Load(mass_kg=1.7, on_top=False): (14.659, 17.723),
    Load(mass_kg=1.9, on_top=False): (15.528, 19.054),
    Load(mass_kg=3.0, on_top=False): (22.555, 27.697),
}
_TORQUES: Final[Mapping[Load, tuple[float, float, float, float, float]]] = {
    Load(mass_kg=1.0, on_top=False): (4.4184, 4.2667, 0.0189, 0.0207, 0.1529),
    Load(mass_kg=1.0, on_top=True): (4.7511, 4.7666, 0.0300, 0.0216, 0.0356),
    Load(mass_kg=1.5, on_top=False): (4.4908, 4.3211, 0.0078, 0.0117, 0.1703),
    Load(mass_kg=1.7, on_top=False): (4.5038, 4.3463, 0.0077, 0.0135, 0.1582),
    Load(mass_kg=1.9, on_top=False): (4.5212, 4.3578, 0.0071, 0.0233, 0.1653),
    Load(mass_kg=3.0, on_top=False): (4.3868, 4.4806, 0.0423, 0.0451, 0.0964),
}
_ANGLES: Final[Mapping[int, tuple[float, float, float, float]]] = {
    90: (5.204, 5.234, 0.07, 0.129),
    85: (5.205, 5.021, 0.225, 0.265),
    80: (5.188, 4.886, 0.304, 0.319),
    75: (5.204, 4.627, 0.539, 0.558),
}
_ROUNDING_NM: Final = 0.002
"""By which a printed difference of printed means may be off."""


def printed_load(load: Load) -> PrintedLoad:
    """Give what the thesis prints of a load.

    Returns:
        Its numbers of all three tables.
    """
    fields = PrintedLoad.model_fields
    leaning = _ANGLES.get(load.degrees) if load.on_top and load.mass_kg == 1.0 else None
    values = (
        *(_FORCES.get(load) or (None,) * 2),
        *(_TORQUES.get(load) or (None,) * 5),
        *(leaning or (None,) * 4),
    )
    return PrintedLoad(**dict(zip(fields, values, strict=True)))


def contradictions() -> Iterator[str]:
    """Find what the printed tables cannot be.

    Yields:
        A sentence per angle at which the means differ by more than a mean difference or a root mean square can be less.
    """
    for degrees, (ft, skin, difference, rmse) in _ANGLES.items():
        if abs(ft - skin) > min(difference, rmse) + _ROUNDING_NM:
            yield (
                f"Table 7.3 of the thesis at {degrees} degrees: means differ by {abs(ft - skin):.3f} N m, and neither "
                f"an average difference of {difference:.3f} nor an RMSE of {rmse:.3f} N m can be less"
            )
