# SPDX-License-Identifier: BSD-3-Clause
"""Rows of contacts on skin, and what figures of them are drawn of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.result import AxisValues, FloatOrNull, Row, Shown, WrenchValues, finite_or_none
from forcetorque.skin.contact import PressureFrame, SkinContacts, lobes
from forcetorque.skin.wrench import SkinPatch


class SkinContactRow(Row):
    """One contact at one time."""

    time_s: Annotated[float, Shown("time", "s", digits=2)]
    """Middle of the messages that are averaged, since the start of the recording."""
    contact: Annotated[int, Shown("contact")]
    """Number of the contact, from 1, which it keeps from its first frame to its last."""
    force_N: Annotated[float, Shown("force", "N", digits=2, error="force_sd_N")]
    """Norm of the force, (7.4)."""
    force_sd_N: FloatOrNull
    """Its standard deviation, from noise, calibration and what is between taxels; none for methods that have none."""
    hysteresis_N: Annotated[float, Shown("hysteresis", "N", digits=2)]
    """How much more the same load reads while it is taken off than while it is put on."""
    drift_limit_N: Annotated[float | None, Shown("drift limit", "N", digits=1)]
    """Heat that may have come through it: time in contact times the rate of the warm-up; none without one."""
    normal_force_N: Annotated[float, Shown("normal force", "N", digits=2)]
    """Integral of the pressure, (7.12); on a bent patch it is larger than the norm of the force."""
    wrench: WrenchValues
    """What the contact does to the link, in its frame and about its origin; N, N m."""
    centre_of_pressure_m: AxisValues
    """Mean position by pressure, in the frame of the link."""
    centroid_m: AxisValues
    """Middle of its area, in the frame of the link."""
    normal: AxisValues
    """Mean outward unit normal of its area."""
    area_mm2: Annotated[float, Shown("area", "mm2", digits=0)]
    """Area of its active taxels."""
    peak_kPa: Annotated[float, Shown("peak", "kPa", digits=1)]
    """Largest pressure of a taxel."""
    active: Annotated[int, Shown("taxels")]
    """Active taxels."""
    lobes: Annotated[int, Shown("hills")]
    """Hills of its pressure: more than one may be as many contacts that touch each other."""
    beyond_range: Annotated[bool, Shown("beyond range")]
    """Whether a taxel reads more than it was calibrated for."""
    edge_share: Annotated[float, Shown("at edge", digits=2)]
    """Share of the normal force at the edge of the patch; beyond it pressure is not felt."""
    taxels: tuple[int, ...]
    """Columns of its active taxels."""

    def flat(self) -> dict[str, object]:
        """Give the row as one line of a table, with one cell for the taxels.

        Returns:
            Values by key.
        """
        flat = Row.flat(self.model_copy(update={"taxels": ()}))
        return {**flat, "taxels": " ".join(map(str, self.taxels))}


def contact_rows(
    patch: SkinPatch, frame: PressureFrame, contacts: SkinContacts, time_s: float
) -> tuple[SkinContactRow, ...]:
    """Write the contacts of a frame down.

    Args:
        patch: The patch.
        frame: The frame.
        contacts: Its contacts.
        time_s: Its time.

    Returns:
        A row per contact.
    """
    hills = lobes(patch.surface, contacts, frame.pressures)
    taxels = [contacts.taxels(number) for number in range(len(contacts))]
    return tuple(
        SkinContactRow(
            time_s=time_s,
            contact=int(contacts.identity[number]),
            force_N=float(contacts.force_N[number]),
            force_sd_N=float(contacts.force_sd_N[number]),
            hysteresis_N=float(contacts.hysteresis_N[number]),
            drift_limit_N=finite_or_none(contacts.drift_limit_N[number]),
            normal_force_N=float(contacts.normal_force_N[number]),
            wrench=contacts.wrench[number],
            centre_of_pressure_m=contacts.centre_of_pressure[number],
            centroid_m=contacts.centroid[number],
            normal=contacts.normal[number],
            area_mm2=1e6 * float(contacts.area_m2[number]),
            peak_kPa=1e-3 * float(contacts.peak_Pa[number]),
            active=len(taxels[number]),
            lobes=int(hills[number]),
            beyond_range=bool(contacts.beyond_range[number]),
            edge_share=float(contacts.edge_share[number]),
            taxels=tuple(patch.layout.taxels[taxels[number]].tolist()),
        )
        for number in range(len(contacts))
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinWrenchPicture:
    """A recording of a patch, and its pressures when the force was largest."""

    patch: str
    """Name of the patch."""
    seconds: FloatArray
    """Times; shape (k,); s."""
    forces: Mapping[str, FloatArray]
    """Forces over time by their names; shape (k,) each; N."""
    places: FloatArray
    """Taxels, laid flat; shape (n, 2); m."""
    triangles: IntArray
    """Facets between them; shape (m, 3)."""
    pressures: FloatArray
    """Pressure on each taxel; shape (n,); Pa."""
    pressed_s: float
    """When."""

    @property
    def pressed_kPa(self) -> FloatArray:
        """Pressure on each taxel; shape (n,)."""
        return 1e-3 * np.asarray(self.pressures)
