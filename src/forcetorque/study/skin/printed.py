# SPDX-License-Identifier: BSD-3-Clause
"""Tables 7.1, 7.2 and 7.3 as the thesis prints them, and where they contradict themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from forcetorque.results.table import Row
from forcetorque.study.skin.raised_leg import Load


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

    Args:
        load: The load.

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
