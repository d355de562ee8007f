# SPDX-License-Identifier: BSD-3-Clause
"""A patch of skin as a force-torque sensor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only, require_shape
from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.surface import SkinSurface, edge_taxels, rim_strip, skin_surface
from forcetorque.skin.wrench.curved_elements import SkinElements, skin_elements
from forcetorque.skin.wrench.pressure_to_wrench import (
    PredictedPressures,
    WrenchMethod,
    WrenchOperator,
    kriging_operator,
    linear_operator,
    simple_operator,
    thesis_operator,
)

_KEPT: Final = 16
"""Operators that are kept: masks of live taxels change now and then, not from frame to frame."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SkinPatch:
    """A patch, its surface, and how the wrench is computed from its pressures."""

    layout: SkinLayout
    """Where the taxels are."""
    method: WrenchMethod
    """How pressures are interpolated between taxels."""
    surface: SkinSurface
    """The surface through the taxels."""
    elements: SkinElements
    """Its pieces, over which pressures are summed."""
    at_edge: BoolArray
    """Taxels beyond which pressure is not felt; shape (n,)."""
    taxel_area_m2: float | None = None
    """Area of a taxel, for the simple method."""
    plane: FloatArray | None = None
    """Places of the taxels in a drawing, for the method of the thesis; shape (n, 2); m."""

    @classmethod
    def of(
        cls,
        layout: SkinLayout,
        method: WrenchMethod | str = WrenchMethod.KRIGING,
        *,
        taxel_area_m2: float | None = None,
        plane: FloatArray | None = None,
    ) -> Self:
        """Prepare a patch.

        Args:
            layout: Where the taxels are, with valid normals.
            method: How pressures are interpolated between taxels.
            taxel_area_m2: Area of a taxel; the simple method needs it, no other takes it.
            plane: Places of the taxels in a drawing; the method of the thesis needs them, no other takes them; shape
                (n, 2); m.

        Returns:
            The patch.

        Raises:
            SkinError: If the method lacks what it needs, or is given what it does not take.
        """
        chosen = WrenchMethod(method)
        for name, given, owner in (
            ("taxel_area_m2", taxel_area_m2, WrenchMethod.SIMPLE),
            ("plane", plane, WrenchMethod.THESIS),
        ):
            if (given is not None) != (chosen is owner):
                raise SkinError(
                    f"patch {layout.name!r}: {name}: expected {'a value' if chosen is owner else 'none'} for the "
                    f"method {chosen}, got {'none' if given is None else 'one'}; only {owner} takes it"
                )
        surface = skin_surface(layout.positions, outward=layout.normals)
        return cls(
            layout=layout,
            method=chosen,
            surface=surface,
            elements=skin_elements(surface, rim_strip(surface)),
            at_edge=edge_taxels(surface),
            taxel_area_m2=taxel_area_m2,
            plane=None if plane is None else read_only(plane, name="plane", shape=(len(layout), 2)),
        )

    def predicted_pressures(self, live: BoolArray) -> PredictedPressures:
        """Predict each taxel from its neighbours, built and kept as operators are.

        Args:
            live: Taxels that can be trusted, at least two; shape (n,).

        Returns:
            Neighbours and their weights.
        """
        return self._predicted_by_mask(live.tobytes())

    def operator(self, live: BoolArray | None = None) -> WrenchOperator:
        """Give the map from pressures to the wrench, built anew for every other mask of live taxels and then kept.

        Args:
            live: Taxels that can be trusted; all by default; shape (n,).

        Returns:
            The operator.

        Raises:
            SkinError: If no taxel lives.
        """
        mask = np.ones(len(self.layout), dtype=np.bool_) if live is None else np.asarray(live, dtype=np.bool_)
        require_shape(mask, name="live", shape=(len(self.layout),))
        if not mask.any():
            raise SkinError(f"patch {self.layout.name!r}: live: expected a taxel that can be trusted, got none")
        return self._operator_by_mask(mask.tobytes())

    @cached_property
    def _operator_by_mask(self) -> Callable[[bytes], WrenchOperator]:
        return lru_cache(maxsize=_KEPT)(lambda mask: self._built(np.frombuffer(mask, dtype=np.bool_)))

    @cached_property
    def _predicted_by_mask(self) -> Callable[[bytes], PredictedPressures]:
        return lru_cache(maxsize=_KEPT)(
            lambda mask: PredictedPressures.of(self.surface, np.frombuffer(mask, dtype=np.bool_))
        )

    def _built(self, live: BoolArray) -> WrenchOperator:
        if self.taxel_area_m2 is not None:
            return simple_operator(self.layout, live, taxel_area_m2=self.taxel_area_m2)
        if self.plane is not None:
            return thesis_operator(self.layout, live, plane=self.plane)
        build = linear_operator if self.method is WrenchMethod.LINEAR else kriging_operator
        return build(self.surface, self.elements, live)
