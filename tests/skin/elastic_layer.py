# SPDX-License-Identifier: BSD-3-Clause
"""Rigid objects on an elastic layer by finite elements (scikit-fem): pressures of taxels that no Winkler bed makes.

The simulator of the library presses objects into independent springs. Here the skin is a layer of linear elastic
material, bonded to a rigid link: load spreads sideways, edges of an object press hardest, and material beside it rises.
The contact is a linear complementarity problem without friction; a slipping object adds its tangential force.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.pose import cross
from forcetorque.skin.simulation.objects_on_skin import PAD_RADIUS_M, RigidObject

Surface = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Positions and outward unit normals of the outer side at places of a chart; shapes (..., 2) to (..., 3) twice; m."""

STIFFNESS_PA_PER_M: Final = 4e7
"""Pressure over compression where all of the layer is pressed evenly: 40 kPa at 1 mm."""
_ITERATIONS: Final = 400
_SLIP_TURNS: Final = 4
"""How often the normal forces are found anew with the tangential forces that they cause."""
_TOLERANCE: Final = 1e-3
"""Gap under a pressed node, and overlap beside one, over the depth of the object."""


@dataclass(frozen=True, kw_only=True)
class LayerMaterial:
    """What the layer is made of."""

    thickness_m: float = 3e-3
    poisson: float = 0.3

    def lame(self) -> tuple[float, float]:
        """Both constants, such that even compression has `STIFFNESS_PA_PER_M`; Pa."""
        modulus = STIFFNESS_PA_PER_M * self.thickness_m  # lambda + 2 mu, without sideways strain
        share = self.poisson / (1.0 - self.poisson)
        return share * modulus, 0.5 * (1.0 - share) * modulus


@dataclass(frozen=True, kw_only=True)
class Pressing:
    """A rigid object that is pushed into the layer along the normal at a place."""

    thing: RigidObject
    place: FloatArray
    """On the chart; shape (2,); m."""
    spin: float
    """How it is turned about that normal; rad."""
    depth_m: float
    friction: float = 0.0
    """Tangential over normal force, all along the direction in which the object slips."""
    slip: float = 0.0
    """That direction, from the first axis of the chart; rad."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LayerContact:
    """What an object does to the link, and what taxels would read."""

    wrench: FloatArray
    """Sum of the forces on all nodes, about the origin of the link; shape (6,); N, N m."""
    normal_wrench: FloatArray
    """The same without tangential forces; shape (6,)."""
    normal_force_N: float
    centre: FloatArray
    """Mean position by normal force; shape (3,); m."""
    nodes: FloatArray
    """Positions of pressed nodes; shape (k, 3); m."""
    forces_N: FloatArray
    """Normal force on each; shape (k,)."""
    peak_Pa: float
    compressions: FloatArray
    """Mean pressure that each capacitive pad reads from its compression; shape (n,); Pa."""
    gap: float
    """Largest violation of the contact condition over the depth."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ElasticLayer:
    """A layer on a part of a surface, factorised once."""

    positions: FloatArray
    """Nodes of the outer side; shape (a, b, 3); m."""
    normals: FloatArray
    """Outward normals there; shape (a, b, 3)."""
    areas: FloatArray
    """Area of each; shape (a, b); m²."""
    axes: tuple[FloatArray, FloatArray]
    """Places of the nodes on the chart; m."""
    even: FloatArray
    """Compression of each node by an even pressure of 1 Pa; shape (a, b); m."""
    solve: Callable[[FloatArray], FloatArray]
    """Displacements of the outer side by forces on its nodes; shapes (a, b, 3); m, N."""
    surface: Surface

    @classmethod
    def on(
        cls, surface: Surface, low: FloatArray, high: FloatArray, material: LayerMaterial, *, cell_m: float, cells: int
    ) -> Self:
        """Mesh the layer by hexahedra, and factorise its stiffness.

        Args:
            surface: Its outer side.
            low: Smallest place on the chart; shape (2,); m.
            high: Largest; shape (2,); m.
            material: The layer.
            cell_m: Sides of its elements along the surface, about.
            cells: Elements through its thickness.

        Returns:
            The layer.
        """
        from scipy.sparse.linalg import splu
        from skfem import Basis, ElementHex1, ElementVector, MeshHex
        from skfem.models.elasticity import linear_elasticity

        across, along = (np.linspace(a, b, round((b - a) / cell_m) + 1) for a, b in zip(low, high, strict=True))
        chart = MeshHex.init_tensor(across, along, np.linspace(0.0, material.thickness_m, cells + 1))
        outside, outward = surface(chart.p[:2].T)
        below = material.thickness_m - chart.p[2]
        mesh = MeshHex((outside - below[:, None] * outward).T, chart.t)
        basis = Basis(mesh, ElementVector(ElementHex1()), intorder=2)
        stiffness = linear_elasticity(*material.lame()).assemble(basis).tocsc()
        order = np.lexsort((chart.p[1], chart.p[0], chart.p[2]))
        top: IntArray = order[-len(across) * len(along) :].reshape(len(across), len(along))
        free = basis.nodal_dofs[:, chart.p[2] > 0.0].ravel()
        place = np.full(basis.N, -1)
        place[free] = np.arange(len(free))
        dofs = np.moveaxis(place[basis.nodal_dofs[:, top]], 0, -1)
        factor = splu(stiffness[free][:, free], permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})

        def solve(forces: FloatArray) -> FloatArray:
            right = np.zeros(len(free))
            right[dofs] = forces
            moved: FloatArray = factor.solve(right)[dofs]
            return moved

        positions = mesh.p.T[top]
        normals = surface(np.stack(np.meshgrid(across, along, indexing="ij"), axis=-1))[1]
        areas = _areas(positions)
        even = -np.sum(solve(-areas[..., None] * normals) * normals, axis=-1)
        return cls(
            positions=positions,
            normals=normals,
            areas=areas,
            axes=(across, along),
            even=even,
            solve=solve,
            surface=surface,
        )

    def press(self, pressing: Pressing, pads: FloatArray) -> LayerContact:
        """Push an object in, and read taxels.

        Args:
            pressing: The object.
            pads: Places of taxels on the chart; shape (n, 2); m.

        Returns:
            Wrench and readings.
        """
        overlap = self._overlap(pressing)
        slip = pressing.friction * self._tangent(pressing.slip)
        forces = np.zeros(self.areas.shape)
        for _ in range(_SLIP_TURNS if pressing.friction else 1):
            moved = np.sum(self.solve(forces[..., None] * slip) * self.normals, axis=-1)
            forces = self._pressed(overlap + moved, forces)
        pushes = -forces[..., None] * self.normals
        displaced = self.solve(pushes + forces[..., None] * slip)
        compression = -np.sum(displaced * self.normals, axis=-1)
        left = overlap - compression
        under = forces > 0.0
        return LayerContact(
            wrench=self._wrench(pushes + forces[..., None] * slip),
            normal_wrench=self._wrench(pushes),
            normal_force_N=float(forces.sum()),
            centre=np.einsum("ab,abi->i", forces, self.positions) / forces.sum(),
            nodes=self.positions[under],
            forces_N=forces[under],
            peak_Pa=float((forces / self.areas).max()),
            compressions=self._at(pads, compression / self.even),
            gap=float(max(np.abs(left[under]).max(), left.max()) / pressing.depth_m),
        )

    def depth_of(self, pressing: Pressing, force_N: float) -> float:
        """How deep independent springs would let an object sink in under a force; m. The layer bears about as much."""
        from scipy.optimize import brentq

        def missing(depth: float) -> float:
            overlap = self._overlap(replace(pressing, depth_m=depth))
            return float((np.maximum(overlap, 0.0) * self.areas).sum()) * STIFFNESS_PA_PER_M - force_N

        return float(brentq(missing, 1e-6, 5e-3, xtol=1e-6))

    def _wrench(self, pushes: FloatArray) -> FloatArray:
        moments = cross(self.positions, pushes)
        return np.concatenate([pushes.sum(axis=(0, 1)), moments.sum(axis=(0, 1))])

    def _overlap(self, pressing: Pressing) -> FloatArray:
        """How far the layer, as it is at rest, is inside the object, along its own normals; m."""
        touch, normal = self.surface(pressing.place)
        along = self.surface(pressing.place + np.array([1e-5, 0.0]))[0] - touch
        along /= np.linalg.norm(along)
        across = cross(normal, along)
        offset = self.positions - touch
        first, second, above = offset @ along, offset @ across, offset @ normal
        cosine, sine = np.cos(pressing.spin), np.sin(pressing.spin)
        height = pressing.thing.height(cosine * first + sine * second, cosine * second - sine * first)
        facing = self.normals @ normal
        overlap = np.where(facing > 0.0, above - height, -np.inf)
        overlap = overlap - overlap.max() + pressing.depth_m
        return np.where(np.isfinite(overlap), overlap * facing, -np.inf)

    def _tangent(self, angle: float) -> FloatArray:
        """Unit tangents at an angle from the first axis of the chart; shape (a, b, 3)."""
        by_arc = np.gradient(self.positions, axis=0)
        first = by_arc - np.sum(by_arc * self.normals, axis=-1, keepdims=True) * self.normals
        first /= np.linalg.norm(first, axis=-1, keepdims=True)
        second = cross(self.normals, first)
        return np.cos(angle) * first + np.sin(angle) * second

    def _pressed(self, overlap: FloatArray, start: FloatArray) -> FloatArray:
        """Normal forces such that no node is inside the object and none is pulled.

        By the conjugate gradients of Polonsky and Keer (1999), with a given depth in place of a given load.
        """
        can = np.isfinite(overlap)
        target = np.where(can, overlap, 0.0)
        weight = self.areas / self.even
        forces = start if start.any() else np.maximum(target, 0.0) * weight
        direction, previous, restart = np.zeros_like(forces), 1.0, True
        depth = float(target.max())
        for _ in range(_ITERATIONS):
            short = np.where(can, target - self._sunk(forces), 0.0)  # positive: needs more force
            active = can & (forces > 0.0)
            wrong = np.where(active, np.abs(short), np.maximum(short, 0.0))
            if wrong.max() < _TOLERANCE * depth:
                break
            ready = np.where(active, weight * short, 0.0)
            power = float((ready * short).sum())
            direction = np.where(active, ready + (0.0 if restart else power / previous) * direction, 0.0)
            previous = power
            along = self._sunk(direction)
            step = float((short * direction)[active].sum() / (direction * along)[active].sum())
            forces = np.maximum(forces + step * direction, 0.0)
            inside = can & (forces == 0.0) & (short > 0.0)
            restart = bool(inside.any()) or bool((active & (forces == 0.0)).any())
            forces = np.where(inside, step * weight * short, forces)
        return forces

    def _sunk(self, forces: FloatArray) -> FloatArray:
        return -np.sum(self.solve(-forces[..., None] * self.normals) * self.normals, axis=-1)

    def _at(self, pads: FloatArray, values: FloatArray) -> FloatArray:
        """Means over pads."""
        from scipy.interpolate import RegularGridInterpolator

        angle = 2.0 * np.pi * (np.arange(12) + 0.5) / 12
        rings = [radius * np.stack([np.cos(angle), np.sin(angle)], axis=1) for radius in (0.41, 0.71, 0.91)]
        points = pads[:, None] + PAD_RADIUS_M * np.concatenate(rings)
        read = RegularGridInterpolator(self.axes, values, bounds_error=False, fill_value=0.0)
        mean: FloatArray = read(points).mean(axis=1)
        return mean


def cylinder(radius_m: float) -> Surface:
    """Skin around z; the chart is (arc, place along z)."""

    def at(places: FloatArray) -> tuple[FloatArray, FloatArray]:
        angle = places[..., 0] / radius_m
        normals = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
        return radius_m * normals + places[..., 1:] * np.array([0.0, 0.0, 1.0]), normals

    return at


def _areas(positions: FloatArray) -> FloatArray:
    """Area that each node of a grid stands for: a quarter of each cell around it; shape (a, b); m²."""
    first = positions[1:, 1:] - positions[:-1, :-1]
    second = positions[1:, :-1] - positions[:-1, 1:]
    cell = 0.5 * np.linalg.norm(cross(first, second), axis=-1)
    areas = np.zeros(positions.shape[:2])
    for rows in (slice(None, -1), slice(1, None)):
        for columns in (slice(None, -1), slice(1, None)):
            areas[rows, columns] += 0.25 * cell
    return areas
