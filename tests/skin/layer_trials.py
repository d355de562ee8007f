# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches that the library computes from pressures of finite elements, which share no equation with its simulator.

`python -m tests.skin.layer_trials --data ../shared/data` prints the figures of docs/skin/wrench.md. Nothing is tuned
here: methods, shares of the predicted deviation and thresholds are those of the library.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import ContactTruth, FlatWeight, SkinContact, Sphere
from forcetorque.skin.simulation.true_surface import TrueSurface
from forcetorque.skin.wrench.known_weight import agreement_of
from forcetorque.skin.wrench.pressure_to_wrench import WrenchMethod
from tests.skin.contact_trials import (
    JUDGED_SEED,
    OFF_EDGE,
    Chain,
    ContactTrial,
    PatchTrials,
    errors,
    leg_drawing,
    leg_layout,
)
from tests.skin.elastic_layer import ElasticLayer, LayerMaterial, Pressing, Surface, cylinder

RADIUS_M: Final = 0.055
PITCH_M: Final = 6.5e-3
ROW_M: Final = PITCH_M * np.sqrt(0.75)
ROWS, COLUMNS = 16, 16
TAXEL_AREA_M2: Final = PITCH_M * ROW_M
"""Area of the lattice that a taxel stands for: the right one of a complete tiling."""
HOLES: Final = ((4, 4), (11, 7), (5, 12))
"""Row and column of the middle of each hole."""
HOLE_M: Final = 0.011
"""Radius of a hole: seven taxels are missing."""
MARGIN_M: Final = 0.012
"""How far the layer goes on beyond the taxels, or a window beyond its contacts."""
WINDOW_M: Final = 0.045
"""Half the side of a part of the leg that is meshed at a time."""
CELL_M: Final = 1.5e-3
CELLS: Final = 3
LEAST_PA: Final = 500.0
"""Pressure above which an ideal pad counts as active: the layer moves a little everywhere."""
SKIN_M: Final = 0.0055
"""Distance from a taxel within which a node is skin."""
ON_SKIN: Final = 0.96
LIGHTEST_N, HEAVIEST_N = 2.0, 30.0
SLIP: Final = 0.3
PLACEMENTS, DRAWS = 5, 1000


@dataclass(frozen=True, kw_only=True)
class Case:
    """A lattice of taxels under a layer, and how objects press on it."""

    material: LayerMaterial = LayerMaterial()
    holes: bool = False
    friction: float = 0.0
    whole: bool = True
    """Whether the true wrench has the tangential forces."""


CASES: Final = {
    "tiling": Case(),
    "slip": Case(friction=SLIP),
    "slip-normal": Case(friction=SLIP, whole=False),
    "holes": Case(holes=True),
    "rubber": Case(material=LayerMaterial(poisson=0.45)),
    "thick": Case(material=LayerMaterial(thickness_m=5e-3)),
}
LEG: Final = "leg"
CHAINS: Final = {"ideal pads": None, "ten frames of 8 bits": Chain()}


@dataclass(frozen=True, kw_only=True, eq=False)
class LayeredPatch:
    """A patch, and the layer over a part of it."""

    layout: SkinLayout
    drawing: FloatArray
    pads: FloatArray
    """Places of the taxels on the chart; shape (n, 2); m."""
    layer: ElasticLayer
    low: FloatArray
    """Where objects may touch; shape (2,); m."""
    high: FloatArray


def tiling(*, holes: bool = False) -> tuple[SkinLayout, FloatArray]:
    """A triangular lattice around a limb, complete or with holes, and its places on the chart."""
    row, column = np.divmod(np.arange(ROWS * COLUMNS), COLUMNS)
    chart = np.stack([PITCH_M * (column + 0.5 * (row % 2) - 0.5 * COLUMNS), ROW_M * (row - 0.5 * ROWS)], axis=1)
    if holes:
        middles = np.stack([chart[r * COLUMNS + c] for r, c in HOLES])
        kept = (np.linalg.norm(chart[:, None] - middles, axis=-1) > HOLE_M).all(axis=1)
        chart = chart[kept]
    positions, normals = cylinder(RADIUS_M)(chart)
    layout = SkinLayout(
        name="lattice",
        frame="limb",
        columns=len(chart),
        taxels=np.arange(len(chart)),
        modules=np.arange(len(chart)) // 10,
        positions=positions,
        normals=normals,
        thermal_pads=[],
        thermal_modules=[],
    )
    return layout, chart


def lattice_patch(material: LayerMaterial, *, holes: bool = False) -> LayeredPatch:
    """The lattice under one layer."""
    layout, chart = tiling(holes=holes)
    low, high = chart.min(axis=0), chart.max(axis=0)
    layer = ElasticLayer.on(cylinder(RADIUS_M), low - MARGIN_M, high + MARGIN_M, material, cell_m=CELL_M, cells=CELLS)
    return LayeredPatch(layout=layout, drawing=chart, pads=chart, layer=layer, low=low, high=high)


def leg_patches(data: Path, material: LayerMaterial, rng: np.random.Generator, number: int) -> Iterator[LayeredPatch]:
    """Parts of iCub's lower leg, each around a taxel that is drawn."""
    layout = leg_layout(data)
    drawing, true = leg_drawing(data, layout), TrueSurface.through(layout)
    pads = true.chart(layout.positions)
    for middle in rng.permutation(pads)[:number]:
        low, high = (np.clip(middle + side, true.low, true.high) for side in (-WINDOW_M, WINDOW_M))
        layer = ElasticLayer.on(_through(true), low, high, material, cell_m=CELL_M, cells=CELLS)
        inside = WINDOW_M - 2.0 * MARGIN_M
        yield LayeredPatch(
            layout=layout, drawing=drawing, pads=pads, layer=layer, low=middle - inside, high=middle + inside
        )


def _through(true: TrueSurface) -> Surface:
    def at(places: FloatArray) -> tuple[FloatArray, FloatArray]:
        points = true.at(places)
        return points.positions, points.normals

    return at


def layer_truths(
    patch: LayeredPatch, rng: np.random.Generator, number: int, *, friction: float = 0.0, whole: bool = True
) -> Iterator[ContactTruth]:
    """Push discs and balls of 2 to 30 N, about, into a layer; where skin feels less than 96 % is drawn anew.

    The true wrench has the tangential forces, unless `whole` is false.
    """
    yielded = 0
    while yielded < number:
        thing = (
            FlatWeight(radius_m=float(rng.uniform(0.01, 0.03)), tilt=tuple(rng.normal(0.0, 0.02, 2).tolist()))
            if yielded % 2 == 0
            else Sphere(radius_m=float(rng.uniform(0.03, 0.10)))
        )
        place, spin, slip = rng.uniform(patch.low, patch.high), *rng.uniform(0.0, 2.0 * np.pi, 2)
        force = float(np.exp(rng.uniform(np.log(LIGHTEST_N), np.log(HEAVIEST_N))))
        depth = patch.layer.depth_of(Pressing(thing=thing, place=place, spin=spin, depth_m=0.0), force)
        pressing = Pressing(thing=thing, place=place, spin=spin, depth_m=depth, friction=friction, slip=slip)
        told = patch.layer.press(pressing, patch.pads)
        share = _on_skin(told.nodes, told.forces_N, patch.layout.positions)
        if share < ON_SKIN or not LIGHTEST_N / 2.0 < told.normal_force_N < 2.0 * HEAVIEST_N:
            continue
        assert told.gap < 0.02, told.gap
        load = float(np.linalg.norm(told.normal_wrench[:3]))
        yielded += 1
        yield ContactTruth(
            contact=SkinContact(thing=thing, mass_kg=load / STANDARD_GRAVITY, place=place, spin=spin),
            wrench=told.wrench if whole else told.normal_wrench,
            normal_force_N=told.normal_force_N,
            centre=told.centre,
            peak_Pa=told.peak_Pa,
            on_skin=share,
            pressures=told.compressions,
        )


def _on_skin(nodes: FloatArray, forces: FloatArray, taxels: FloatArray) -> float:
    from scipy.spatial import KDTree

    distance, _ = KDTree(taxels).query(nodes)
    return float(forces[distance <= SKIN_M].sum() / forces.sum())


@dataclass(frozen=True, kw_only=True)
class Held:
    """How predicted deviations hold for single contacts in range and off the edge."""

    number: int
    force: float
    """Share of norms of forces within two deviations."""
    vector: float
    """Root mean square of the norm of the force error over that of the predicted deviation."""
    moment: float
    """The same of the moment about the link's origin."""
    centre_m: float
    """Mean error of the centre of pressure."""


def held(trials: Sequence[ContactTrial]) -> Held:
    """Compare errors with what was predicted of them."""
    scope = [one for one in trials if one.in_scope]
    assert scope
    ours = np.stack([one.wrenches[WrenchMethod.KRIGING] for one in scope])
    true = np.stack([one.truth.wrench for one in scope])
    norm, true_norm = (np.linalg.norm(wrench[:, :3], axis=1) for wrench in (ours, true))
    sd, told_sd = np.stack([one.sd for one in scope]), np.array([one.sd_N for one in scope])
    centre = np.stack([one.centre - one.truth.centre for one in scope])
    return Held(
        number=len(scope),
        force=float(np.mean(np.abs(norm - true_norm) <= 2.0 * told_sd)),
        vector=float(np.linalg.norm((ours - true)[:, :3]) / np.linalg.norm(sd[:, :3])),
        moment=float(np.linalg.norm((ours - true)[:, 3:]) / np.linalg.norm(sd[:, 3:])),
        centre_m=float(np.linalg.norm(centre, axis=1).mean()),
    )


def lines(name: str, trials: Sequence[ContactTrial]) -> Iterator[str]:
    """Errors by method, and how predicted deviations hold."""
    load = np.mean([one.truth.load_N for one in trials])
    yield f"{name}: {len(trials)} contacts of {load:.1f} N on average"
    for method in WrenchMethod:
        told = errors(trials, method)
        yield (
            f"  {method}: {told.magnitude_N:.3f} N, {told.over_load:.1%}, bias {told.bias:+.1%}, moment "
            f"{told.torque_Nm:.4f} N m, with its best gain {told.gained_N:.3f} N"
        )
    shares = np.array([np.linalg.norm(one.wrenches[WrenchMethod.KRIGING][:3]) / one.truth.load_N for one in trials])
    rng = np.random.default_rng(JUDGED_SEED)
    verdicts = Counter(agreement_of(rng.choice(shares, PLACEMENTS, replace=False))[2] for _ in range(DRAWS))
    words = ", ".join(f"{verdict} {count}" for verdict, count in sorted(verdicts.items()))
    yield f"  known weight, {PLACEMENTS} placements each of {DRAWS} draws of these contacts: {words}"
    kept = held(trials)
    yield (
        f"  {kept.number} single contacts with under {OFF_EDGE:.0%} at the edge, in range: {kept.force:.1%} within two "
        f"deviations, RMS error over deviation: force {kept.vector:.2f}, moment {kept.moment:.2f}; centre "
        f"{1e3 * kept.centre_m:.2f} mm"
    )


def main() -> None:
    """Print errors on a patch of a material."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("case", choices=(*CASES, LEG))
    parser.add_argument("--data", type=Path, default=Path("../shared/data"), help="folder of measured data")
    parser.add_argument("--contacts", type=int, default=100)
    parser.add_argument("--windows", type=int, default=5, help="parts of the leg")
    parser.add_argument("--seed", type=int, default=JUDGED_SEED)
    options = parser.parse_args()
    if options.case == LEG:
        rng = np.random.default_rng(options.seed)
        parts = list(leg_patches(options.data, LayerMaterial(), rng, options.windows))
        each = options.contacts // options.windows
        _print(LEG, parts, [list(layer_truths(part, rng, each)) for part in parts], options.seed)
        return
    case = CASES[options.case]
    patch = lattice_patch(case.material, holes=case.holes)
    rng = np.random.default_rng(options.seed)
    truths = list(layer_truths(patch, rng, options.contacts, friction=case.friction, whole=case.whole))
    _print(options.case, [patch], [truths], options.seed)


def _print(name: str, parts: Sequence[LayeredPatch], truths: Sequence[Sequence[ContactTruth]], seed: int) -> None:
    layout, drawing = parts[0].layout, parts[0].drawing
    area = TAXEL_AREA_M2 if layout.name == "lattice" else 39e-6
    patch = PatchTrials(layout, drawing, seed, simple_area_m2=area, least_pa=LEAST_PA)
    every = [truth for some in truths for truth in some]
    for chain_name, chain in CHAINS.items():
        for line in lines(f"{name}, {chain_name}", patch.trials(every, chain)):
            print(line, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
