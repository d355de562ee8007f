# SPDX-License-Identifier: BSD-3-Clause
"""Tables 7.1, 7.2 and 7.3 of simulated trials, against the truth and beside what the thesis prints."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from operator import attrgetter
from typing import Annotated, ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.evaluation.sphere.resampling import jackknife_margin
from forcetorque.results.number_text import number
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, table_of
from forcetorque.study.skin.raised_leg import LOADS, Load
from forcetorque.study.skin.trial import LoadTrial, PrintedLoad, contradictions, printed_load

LEVEL_DEG: Final = 90
"""Angle of the leg in Tables 7.1 and 7.2."""
_LEVEL: Final = Load(mass_kg=1.0, on_top=True)
_LEANING: Final = Load(mass_kg=1.0, on_top=True, degrees=75)
_LIGHT: Final = Load(mass_kg=1.0, on_top=False)
_HEAVY: Final = Load(mass_kg=1.9, on_top=False)
_RANGE_KG: Final = 3.0
"""Mass from which taxels may be pressed harder than they were calibrated for."""

Trials = Sequence[Sequence[LoadTrial]]
"""Loads of every trial."""


class LoadRow(Row):
    """One load on the leg at one angle, over all trials."""

    mass_kg: float
    """Its mass."""
    on_top: bool
    """Whether it rests on top of the shin, as marked by a star, or hangs from a strip of cloth."""
    degrees: int
    """Angle of the leg; at 90 the skin under one kilogram on top is level."""
    trials: int
    """Number of trials."""
    weight_N: float
    """Its weight."""
    simple_N: float
    """Mean force by (7.13)."""
    interpolated_N: float
    """Mean norm of the force of (7.4)."""
    simple_error_N: float
    """Mean absolute error of the simple force."""
    interpolated_error_N: float
    """The same of the interpolated one."""
    beyond_range: int
    """Trials in which a taxel measured more than it was calibrated for."""
    knee_Nm: float
    """Mean of the true torque of the knee."""
    ft_Nm: float
    """Mean torque by the force-torque sensor."""
    skin_Nm: float
    """Mean torque by skin."""
    ft_sd_Nm: float
    """Standard deviation within a trial, by the sensor; pooled."""
    skin_sd_Nm: float
    """The same by skin."""
    difference_Nm: float
    """Mean absolute difference of skin and sensor."""
    rmse_to_ft_Nm: float
    """Root mean square of skin less sensor."""
    ft_rmse_Nm: float
    """Root mean square error of the sensor."""
    skin_rmse_Nm: float
    """Root mean square error of skin."""
    hot_rmse_Nm: float
    """Root mean square error of skin with heat left in."""
    skin_bias_Nm: float
    """Mean error of skin."""
    along_share: float
    """Part of the weight along the shin, which no taxel measures."""
    thesis: PrintedLoad
    """What the thesis prints."""

    @property
    def name(self) -> str:
        """Its name in the tables of the thesis."""
        return f"{self.mass_kg:g} kg{'*' if self.on_top else ''}"

    @property
    def leaning(self) -> bool:
        """Whether it is the load of Table 7.3."""
        return self.on_top and self.mass_kg == 1.0


class ComparedRow(Row):
    """One number of the trials beside that of the printed tables."""

    quantity: Annotated[str, Shown("quantity")]
    """What it is."""
    unit: Annotated[str, Shown("unit")]
    """Its unit."""
    simulated: Annotated[float, Shown("simulated", digits=3, error="half_width_95")]
    """Of all trials."""
    half_width_95: float | None
    """Half of its 95 % interval, by the jackknife over trials; None for one trial."""
    thesis: Annotated[float | None, Shown("thesis", digits=3)]
    """Of the printed tables; None where the thesis knows no truth."""


class SkinStudy(DrawnResult):
    """Forces and torques by skin on a simulated leg, as in thesis 7.3."""

    answered_by: ClassVar[str | None] = "forcetorque.study.command:skin_study_answer"
    drawn_by: ClassVar[str] = "forcetorque.study.figures:skin_study_figure"

    schema_name: Literal["forcetorque/study_skin/1"] = Field(default="forcetorque/study_skin/1", alias="schema")
    """Form of the result."""
    layout: str
    """Layout of the skin."""
    taxels: int
    """Its taxels."""
    trials: int
    """Number of trials."""
    seed: int
    """Seed of the first trial; the others follow."""
    loads: tuple[LoadRow, ...]
    """One per load and angle."""
    compared: tuple[ComparedRow, ...]
    """Numbers beside those of the printed tables, over the loads that they have."""

    def compared_of(self, quantity: str) -> ComparedRow:
        """Give a compared number.

        Args:
            quantity: What it is.

        Returns:
            Its row.
        """
        return next(row for row in self.compared if row.quantity == quantity)

    def blocks(self) -> Iterator[Table | str]:
        """Give the comparison with the thesis and its three tables.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.compared, "over the loads of the printed tables; ± is half a 95 % interval over trials")
        yield from contradictions()
        level = [row for row in self.loads if row.degrees == LEVEL_DEG]
        forces = "Table 7.1, forces in N: means, mean absolute errors, and what the thesis prints"
        yield _table(forces, level, _FORCES, 2)
        torques = "Table 7.2, torque of the knee in N m: against the sensor, the truth, and what the thesis prints"
        yield _table(torques, level, _TORQUES, 3)
        leaning = "Table 7.3, torque of the knee in N m with 1 kg on top of a leaning leg"
        yield _table(leaning, [row for row in self.loads if row.leaning], _ANGLES, 3)
        yield "robot, taxels, heat and loads are simulated; masses of the robot are exact; * is on top of the shin"


_FORCES: Final = {
    "mass": "name",
    "weight": "weight_N",
    "simple": "simple_N",
    "interpolated": "interpolated_N",
    "error, simple": "simple_error_N",
    "error, interpolated": "interpolated_error_N",
    "beyond range": "beyond_range",
    "thesis, simple": "thesis.simple_N",
    "thesis, interpolated": "thesis.interpolated_N",
}
_TORQUES: Final = {
    "mass": "name",
    "FT": "ft_Nm",
    "skin": "skin_Nm",
    "sd, FT": "ft_sd_Nm",
    "sd, skin": "skin_sd_Nm",
    "RMSE to FT": "rmse_to_ft_Nm",
    "truth": "knee_Nm",
    "RMSE, FT": "ft_rmse_Nm",
    "RMSE, skin": "skin_rmse_Nm",
    "heat left in": "hot_rmse_Nm",
    "thesis, FT": "thesis.ft_Nm",
    "thesis, skin": "thesis.skin_Nm",
    "thesis, RMSE to FT": "thesis.rmse_to_ft_Nm",
}
_ANGLES: Final = {
    "degrees": "degrees",
    "FT": "ft_Nm",
    "skin": "skin_Nm",
    "mean difference": "difference_Nm",
    "RMSE to FT": "rmse_to_ft_Nm",
    "truth": "knee_Nm",
    "RMSE, skin": "skin_rmse_Nm",
    "bias, skin": "skin_bias_Nm",
    "along the shin": "along_share",
    "thesis, FT": "thesis.leaning_ft_Nm",
    "thesis, skin": "thesis.leaning_skin_Nm",
    "thesis, RMSE to FT": "thesis.leaning_rmse_to_ft_Nm",
}
"""Fields of a load, or of what the thesis prints of it, by heading."""


def _table(caption: str, rows: Sequence[LoadRow], fields: Mapping[str, str], digits: int) -> Table:
    def cell(row: LoadRow, field: str) -> str:
        value = attrgetter(field)(row)
        if field == "along_share":
            return f"{value:.1%}"
        return str(value) if isinstance(value, str | int) else number(value, digits)

    lines = tuple(tuple(cell(row, field) for field in fields.values()) for row in rows)
    return Table(caption=caption, headings=tuple(fields), rows=lines)


def skin_study(trials: Trials, *, layout: str, taxels: int, seed: int) -> SkinStudy:
    """Summarise trials.

    Args:
        trials: Loads of every trial, all with the same loads in their order.
        layout: Layout of the skin.
        taxels: Its taxels.
        seed: Seed of the first trial.

    Returns:
        The tables, and what they come to.
    """
    return SkinStudy(
        layout=layout,
        taxels=taxels,
        trials=len(trials),
        seed=seed,
        loads=tuple(_load_row(same) for same in zip(*trials, strict=True)),
        compared=tuple(_compared(trials)),
        warnings=("one trial: expected two or more for 95 % intervals",) if len(trials) == 1 else (),
    )


def _load_row(same: Sequence[LoadTrial]) -> LoadRow:
    """Average one load over trials; errors are pooled before they are averaged."""

    def mean(value: Callable[[LoadTrial], float]) -> float:
        return float(np.mean([value(one) for one in same]))

    def pooled(value: Callable[[LoadTrial], float]) -> float:
        return _pooled([value(one) for one in same])

    load = same[0].load
    return LoadRow(
        mass_kg=load.mass_kg,
        on_top=load.on_top,
        degrees=load.degrees,
        trials=len(same),
        weight_N=same[0].weight_N,
        simple_N=mean(lambda one: one.simple_N),
        interpolated_N=mean(lambda one: one.interpolated_N),
        simple_error_N=mean(lambda one: abs(one.simple_N - one.weight_N)),
        interpolated_error_N=mean(lambda one: abs(one.interpolated_N - one.weight_N)),
        beyond_range=sum(one.beyond_range for one in same),
        knee_Nm=mean(lambda one: one.truth.knee_Nm),
        ft_Nm=mean(lambda one: float(one.ft_Nm.mean())),
        skin_Nm=mean(lambda one: float(one.skin_Nm.mean())),
        ft_sd_Nm=pooled(lambda one: float(one.ft_Nm.std())),
        skin_sd_Nm=pooled(lambda one: float(one.skin_Nm.std())),
        difference_Nm=mean(lambda one: float(np.abs(one.skin_Nm - one.ft_Nm).mean())),
        rmse_to_ft_Nm=pooled(lambda one: one.rmse(one.skin_Nm, one.ft_Nm)),
        ft_rmse_Nm=pooled(lambda one: one.rmse(one.ft_Nm)),
        skin_rmse_Nm=pooled(lambda one: one.rmse(one.skin_Nm)),
        hot_rmse_Nm=pooled(lambda one: one.rmse(one.hot_Nm)),
        skin_bias_Nm=mean(lambda one: float(one.skin_Nm.mean()) - one.truth.knee_Nm),
        along_share=mean(lambda one: one.truth.along_N / one.weight_N),
        thesis=printed_load(load),
    )


SIMPLE: Final = "mean error of the simple force below 3 kg"
INTERPOLATED: Final = "mean error of the interpolated force below 3 kg"
GAINED_SIMPLE: Final = "the same, simple, with the gain that fits best"
GAINED_INTERPOLATED: Final = "the same, interpolated, with the gain that fits best"
TO_FT: Final = "RMSE of skin to the sensor, mean over loads"
TO_TRUTH: Final = "RMSE of skin to the truth"
LOST: Final = "skin less sensor, 75 less 90 degrees"
RISE: Final = "torque by the sensor, 1.9 less 1 kg hanging"


def _compared(trials: Trials) -> Iterator[ComparedRow]:
    """Compute every number for the trials, for all but one of them in turn, and for the printed tables."""
    printed = _of_the_thesis()
    units = dict.fromkeys((SIMPLE, INTERPOLATED, GAINED_SIMPLE, GAINED_INTERPOLATED), "N")
    numbers = _numbers(trials)
    without_one = [_numbers([*trials[:k], *trials[k + 1 :]]) for k in range(len(trials))] if len(trials) > 1 else []
    margins = jackknife_margin(np.array([list(some.values()) for some in without_one])) if without_one else None
    for k, (quantity, value) in enumerate(numbers.items()):
        yield ComparedRow(
            quantity=quantity,
            unit=units.get(quantity, "N m"),
            simulated=value,
            half_width_95=None if margins is None else float(margins[k]),
            thesis=printed.get(quantity),
        )


def _numbers(trials: Trials) -> dict[str, float]:
    """What trials come to, over the loads that the printed tables have."""
    loads = [one for some in trials for one in some]
    below = [one for one in loads if printed_load(one.load).simple_N is not None and one.load.mass_kg < _RANGE_KG]
    torques = [one for one in loads if printed_load(one.load).ft_Nm is not None]
    return {
        **_force_errors(
            np.array([one.weight_N for one in below]), np.array([[one.simple_N, one.interpolated_N] for one in below])
        ),
        TO_FT: float(np.mean([one.rmse(one.skin_Nm, one.ft_Nm) for one in torques])),
        TO_TRUTH: _pooled([one.rmse(one.skin_Nm) for one in torques]),
        "RMSE of the sensor to the truth": _pooled([one.rmse(one.ft_Nm) for one in torques]),
        "RMSE of skin to the truth, heat left in": _pooled([one.rmse(one.hot_Nm) for one in torques]),
        LOST: _mean(loads, _LEANING, lambda one: one.skin_Nm - one.ft_Nm)
        - _mean(loads, _LEVEL, lambda one: one.skin_Nm - one.ft_Nm),
        RISE: _mean(loads, _HEAVY, lambda one: one.ft_Nm) - _mean(loads, _LIGHT, lambda one: one.ft_Nm),
    }


def _of_the_thesis() -> dict[str, float]:
    """The same of the printed tables, as far as they have it."""
    printed = {load: printed_load(load) for load in LOADS}
    below = {load: row for load, row in printed.items() if row.simple_N is not None and load.mass_kg < _RANGE_KG}
    rmse = [row.rmse_to_ft_Nm for row in printed.values() if row.rmse_to_ft_Nm is not None]
    leaning, level, heavy, light = (printed[load] for load in (_LEANING, _LEVEL, _HEAVY, _LIGHT))
    forces = np.array([[row.simple_N, row.interpolated_N] for row in below.values()], dtype=np.float64)
    lost = np.array([row.leaning_change_Nm for row in (leaning, level)], dtype=np.float64)
    rise = np.array([heavy.ft_Nm, light.ft_Nm], dtype=np.float64)
    return {
        **_force_errors(np.array([load.mass_kg * STANDARD_GRAVITY for load in below]), forces),
        TO_FT: float(np.mean(rmse)),
        LOST: float(lost[0] - lost[1]),
        RISE: float(rise[0] - rise[1]),
    }


def _force_errors(weight: FloatArray, forces: FloatArray) -> dict[str, float]:
    """Mean absolute errors of simple and interpolated forces, shape (n, 2), as they are and with one gain each; N."""
    gains = weight @ forces / (forces**2).sum(axis=0)
    plain, gained = (np.abs(gain * forces - weight[:, None]).mean(axis=0).tolist() for gain in (1.0, gains))
    return dict(zip((SIMPLE, INTERPOLATED, GAINED_SIMPLE, GAINED_INTERPOLATED), (*plain, *gained), strict=True))


def _pooled(errors: Sequence[float]) -> float:
    return float(np.sqrt(np.mean(np.square(errors))))


def _mean(loads: Sequence[LoadTrial], load: Load, torque: Callable[[LoadTrial], FloatArray]) -> float:
    """Mean torque of one load over trials; N m."""
    return float(np.mean([torque(one).mean() for one in loads if one.load == load]))
