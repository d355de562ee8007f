# SPDX-License-Identifier: BSD-3-Clause
"""Tables 7.1, 7.2 and 7.3 of the thesis from a simulated leg, against truth and, as printed, against the FT sensor.

`python -m tests.skin.thesis_trials --data ../shared/data` prints those of docs/skin/experiment.md: the layout is iCub's
`right_leg_lower`; robot, weights, taxels and heat are simulated.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.recordings import Loading
from forcetorque.skin.wrench.wrench import WrenchChoice, skin_wrench
from tests.skin.contact_trials import SIMPLE_AREA_M2, leg_layout
from tests.skin.thesis_leg import KNEE, LOADS, Load, LoadTruth, write_leg

SEEDS: Final = 10
LOADING: Final = Loading(rest_s=10.0, ramp_s=1.0, hold_s=10.0)


@dataclass(frozen=True, kw_only=True)
class LoadRow:
    """All that is told of one load, and the truth."""

    truth: LoadTruth
    simple_N: float
    """Mean of (7.13), of the area with which it is as low as in table 7.1."""
    interpolated_N: float
    """Mean norm of the force, (7.4), by kriging."""
    beyond_range: bool
    """Whether a taxel read more than it was calibrated for."""
    ft_Nm: FloatArray
    """Torque of the knee by the sensor; shape (n,)."""
    skin_Nm: FloatArray
    """By skin, with heat taken out as it was learned; shape (n,)."""
    hot_Nm: FloatArray
    """By skin, with heat left in; shape (n,)."""

    @property
    def load(self) -> Load:
        """The load."""
        return self.truth.load

    @property
    def weight_N(self) -> float:
        """Its weight, the reference of table 7.1."""
        return self.load.mass_kg * STANDARD_GRAVITY

    def rmse(self, told: FloatArray, reference: FloatArray | None = None) -> float:
        """Root mean square error of a torque, against the truth or another estimate; N m."""
        return float(np.sqrt(np.mean((told - (self.truth.knee_Nm if reference is None else reference)) ** 2)))


def experiment(
    folder: Path, layout: SkinLayout, loads: Sequence[Load] = LOADS, *, seed: int, loading: Loading = LOADING
) -> list[LoadRow]:
    """Do the experiment once: write the recording, and estimate from its files as a user would."""
    truths = write_leg(folder, layout, loads, seed=seed, loading=loading)
    torques = {name: list(_knee(folder / f"{name}.toml")) for name in ("ft", "skin_warm", "skin_cold")}
    forces = list(_forces(folder, loads, loading))
    rows = []
    for k, (truth, (simple, interpolated, beyond)) in enumerate(zip(truths, forces, strict=True)):
        stamps, ft = torques["ft"][k]
        skin, hot = (_at(stamps, *torques[name][k]) for name in ("skin_warm", "skin_cold"))
        rows.append(
            LoadRow(
                truth=truth,
                simple_N=simple,
                interpolated_N=interpolated,
                beyond_range=beyond,
                ft_Nm=ft,
                skin_Nm=skin,
                hot_Nm=hot,
            )
        )
    return rows


def _knee(file: Path) -> Iterator[tuple[IntArray, FloatArray]]:
    """Stamps and torque of the knee in each interval."""
    content = load_experiment(file, Purpose.FORCES)
    for span in estimate_experiment(content, corrections_of(content, {})):
        yield span.stamp_ns, span.estimates.torque(KNEE)


def _at(stamps: IntArray, own: IntArray, values: FloatArray) -> FloatArray:
    """Values at the stamps of the sensor, which are some of those of the skin."""
    common = np.isin(own, stamps)
    assert np.array_equal(own[common], stamps)
    return values[common]


def _forces(folder: Path, loads: Sequence[Load], loading: Loading) -> Iterator[tuple[float, float, bool]]:
    """Simple and interpolated force while each load rests, and whether a taxel was beyond its range."""
    choice = WrenchChoice(taxel_area_mm2=1e6 * SIMPLE_AREA_M2)
    told = skin_wrench(folder / "skin_warm.toml", folder / "warm.json", choice=choice)
    forces = told.picture.forces
    simple, interpolated = (next(v for name, v in forces.items() if name.startswith(m)) for m in ("simple", "kriging"))
    for k in range(len(loads)):
        begin = loading.rest_s + k * loading.turn_s + loading.ramp_s
        held: BoolArray = (told.picture.seconds > begin) & (told.picture.seconds < begin + loading.hold_s)
        beyond = any(row.beyond_range for row in told.contacts if begin < row.time_s < begin + loading.hold_s)
        yield float(simple[held].mean()), float(interpolated[held].mean()), beyond


def force_table(rows: Sequence[LoadRow]) -> Iterator[str]:
    """Table 7.1, with the flag of the range."""
    yield "| mass | reference | simple | interpolated | error, simple | error, interpolated | beyond range |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for row in rows:
        errors = [abs(force - row.weight_N) for force in (row.simple_N, row.interpolated_N)]
        numbers = [row.weight_N, row.simple_N, row.interpolated_N, *errors]
        yield f"| {_mass(row.load)} | {' | '.join(f'{n:.2f}' for n in numbers)} | {'yes' if row.beyond_range else ''} |"


def torque_table(rows: Sequence[LoadRow]) -> Iterator[str]:
    """Table 7.2, with what it lacks: the truth, and skin with heat left in."""
    yield "| mass | FT | skin | sd, FT | sd, skin | RMSE to FT | truth | RMSE, FT | RMSE, skin | heat left in |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
    for row in rows:
        numbers = [
            *(told.mean() for told in (row.ft_Nm, row.skin_Nm)),
            *(told.std() for told in (row.ft_Nm, row.skin_Nm)),
            row.rmse(row.skin_Nm, row.ft_Nm),
            row.truth.knee_Nm,
            *(row.rmse(told) for told in (row.ft_Nm, row.skin_Nm, row.hot_Nm)),
        ]
        yield f"| {_mass(row.load)} | {' | '.join(f'{n:.3f}' for n in numbers)} |"


def angle_table(rows: Sequence[LoadRow]) -> Iterator[str]:
    """Table 7.3, with the truth and the part of the weight that no taxel feels."""
    yield "| degrees | FT | skin | mean difference | RMSE to FT | truth | RMSE, skin | along the shin |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- |"
    for row in rows:
        numbers = [
            row.ft_Nm.mean(),
            row.skin_Nm.mean(),
            np.abs(row.skin_Nm - row.ft_Nm).mean(),
            row.rmse(row.skin_Nm, row.ft_Nm),
            row.truth.knee_Nm,
            row.rmse(row.skin_Nm),
        ]
        share = row.truth.along_N / row.weight_N
        yield f"| {row.load.degrees} | {' | '.join(f'{n:.3f}' for n in numbers)} | {share:.1%} |"


def _mass(load: Load) -> str:
    return f"{load.mass_kg:g} kg{'*' if load.on_top else ''}"


def level(rows: Sequence[LoadRow]) -> list[LoadRow]:
    """Rows of the level leg, which make tables 7.1 and 7.2."""
    return [row for row in rows if row.load.degrees == 90]


def leaned(rows: Sequence[LoadRow]) -> list[LoadRow]:
    """Rows of the kilogram on top at every angle, which make table 7.3."""
    return [row for row in rows if row.load.on_top and row.load.mass_kg == 1.0]


def mean_errors(rows: Sequence[LoadRow]) -> tuple[float, float]:
    """Mean absolute errors of simple and interpolated force; N."""
    errors = [[abs(force - row.weight_N) for force in (row.simple_N, row.interpolated_N)] for row in rows]
    simple, interpolated = np.mean(errors, axis=0)
    return float(simple), float(interpolated)


def gained_errors(rows: Sequence[LoadRow]) -> tuple[float, float]:
    """The same after the gain that fits all of these loads best."""
    weight = np.array([row.weight_N for row in rows])
    told = np.array([[row.simple_N, row.interpolated_N] for row in rows])
    gains = weight @ told / (told**2).sum(axis=0)
    simple, interpolated = np.abs(gains * told - weight[:, None]).mean(axis=0)
    return float(simple), float(interpolated)


def pooled_rmse(rows: Sequence[LoadRow]) -> float:
    """Root mean square error of the torque of skin against the truth, over rows; N m."""
    return float(np.sqrt(np.mean([row.rmse(row.skin_Nm) ** 2 for row in rows])))


def summary(several: Sequence[Sequence[LoadRow]]) -> Iterator[str]:
    """What several experiments say together."""
    everything = [row for rows in several for row in level(rows)]
    inside = [row for row in everything if row.load.mass_kg < 3.0]
    for name, some in (("all loads", everything), ("without 3 kg", inside)):
        raw, gained = mean_errors(some), gained_errors(some)
        words = f"{name}: mean error {raw[0]:.2f} N simple, {raw[1]:.2f} N interpolated"
        yield f"{words}; with the gain that fits best {gained[0]:.2f} and {gained[1]:.2f} N"
    to_ft = [row.rmse(row.skin_Nm, row.ft_Nm) for row in everything]
    ft = np.sqrt(np.mean([row.rmse(row.ft_Nm) ** 2 for row in everything]))
    hot = np.sqrt(np.mean([row.rmse(row.hot_Nm) ** 2 for row in everything]))
    yield f"torques: RMSE of skin to FT {np.mean(to_ft):.3f} N m on average"
    yield f"to the truth: skin {pooled_rmse(everything):.3f}, FT {ft:.3f}, skin with heat left in {hot:.2f} N m"
    for angle in (90, 85, 80, 75):
        at = [row for rows in several for row in leaned(rows) if row.load.degrees == angle]
        bias = np.mean([row.skin_Nm.mean() - row.truth.knee_Nm for row in at])
        yield f"{angle} degrees: skin RMSE {pooled_rmse(at):.3f} N m, bias {bias:+.3f} N m of {len(at)}"
    for beyond in (False, True):
        peaks = [1e-3 * row.truth.peak_Pa for row in everything if row.beyond_range is beyond]
        words = "flagged beyond range" if beyond else "not flagged"
        yield f"{len(peaks)} loads {words}, with peaks of {min(peaks):.0f} to {max(peaks):.0f} kPa" if peaks else words


def experiments(layout: SkinLayout, seeds: Sequence[int]) -> Iterator[list[LoadRow]]:
    """Do the experiment once for each seed."""
    for seed in seeds:
        with tempfile.TemporaryDirectory() as folder:
            yield experiment(Path(folder), layout, seed=seed)


def main() -> None:
    """Print the tables of the first seed, and what all seeds say."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--data", type=Path, default=Path("../shared/data"), help="folder of measured data")
    parser.add_argument("--seeds", type=int, default=SEEDS)
    options = parser.parse_args()
    several = list(experiments(leg_layout(options.data), range(1, options.seeds + 1)))
    first = several[0]
    tables = (force_table(level(first)), torque_table(level(first)), angle_table(leaned(first)))
    for line in (*(line for table in tables for line in (*table, "")), *summary(several)):
        print(line)  # noqa: T201


if __name__ == "__main__":
    main()
