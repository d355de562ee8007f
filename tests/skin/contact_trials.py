# SPDX-License-Identifier: BSD-3-Clause
"""Objects of 0.2 to 3 kg on a simulated lower leg, and how well their wrenches are told.

`python -m tests.skin.contact_trials` prints the figures of docs/skin/wrench.md: the layout is iCub's `right_leg_lower`,
the truth and the taxels are simulated. Methods were chosen, and `RESIDUAL_SHARE` and `SHAPE_SHARE` fitted, on contacts
of the first seed; figures are of the second.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.contact.contact_clusters import find_contacts
from forcetorque.skin.contact.pressure_frame import PatchReader, PressureFrame
from forcetorque.skin.layout.formats.registry import describe_patch
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.layout.normals import rebuilt_normals
from forcetorque.skin.simulation.objects_on_skin import ContactTruth, SkinBody, contacts
from forcetorque.skin.simulation.recordings import REFERENCE_PA, SIMPLE_AREA_M2, TaxelResponses, chamber_recording
from forcetorque.skin.taxels.curve_comparison import calibrated_taxel
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PressureTable
from forcetorque.skin.taxels.pressure_cycles import REST_SHARE, pressure_cycle
from forcetorque.skin.taxels.taxel_curve import CurveKind, fit_curve
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.pressure_to_wrench import WrenchMethod

TUNED_SEED: Final = 1
JUDGED_SEED: Final = 2
FRAMES: Final = 10
REST_FRAMES: Final = 100
DEAD_SHARE: Final = 0.15
CONTACTS: Final = 600
"""Contacts that errors are told of."""
PREDICTED: Final = 200
"""Contacts in scope that predicted standard deviations are held to, the first ones."""
BINS: Final = ((1, 7), (8, 15), (16, 27), (28, 999))
"""Numbers of active taxels by which errors are told: aliasing between few taxels is most of the error."""
OFF_EDGE: Final = 0.05
"""Share of the force at the edge of the patch below which a contact is off it."""


@dataclass(frozen=True, kw_only=True)
class ContactTrial:
    """One contact, true and told."""

    truth: ContactTruth
    """What the object does."""
    active: int
    """Taxels that feel it."""
    contacts: int
    """Contacts that were found."""
    wrenches: Mapping[WrenchMethod, FloatArray]
    """Sum of the wrenches of all contacts, by method."""
    sd_N: float
    """Predicted standard deviation of the force, by the default method."""
    sd: FloatArray
    """Predicted standard deviations of the wrench of a single contact, by the default method; shape (6,)."""
    centre: FloatArray
    """Centre of pressure of a single contact, by the default method; shape (3,); m."""
    in_scope: bool
    """Whether it is one contact, in range and off the edge, as predicted standard deviations suppose."""


@dataclass(frozen=True, kw_only=True)
class Errors:
    """Mean errors of a method over contacts."""

    number: int
    """Contacts."""
    magnitude_N: float
    """Of the norm of the force."""
    over_load: float
    """The same, each over its load."""
    bias: float
    """Mean signed error, each over its load."""
    vector_N: float
    """Norm of the error of the force."""
    torque_Nm: float
    """Norm of the error of the moment about the link's origin."""
    gained_N: float
    """Error of the norm after one gain that fits all contacts best."""


@dataclass(frozen=True, kw_only=True)
class Chain:
    """How pressures reach the computer."""

    frames: int = FRAMES
    """Frames that are averaged."""
    unloading: bool = False
    """Whether pressure is being taken off."""
    dead: float = 0.0
    """Share of taxels that are dead."""
    both_ways: bool = False
    """Whether curves are fitted to loading and unloading, between the two, and not to loading alone."""


def leg_layout(data: Path) -> SkinLayout:
    """Read the lower leg, whose published normals are placeholders, and rebuild them."""
    leg = describe_patch(data / "icub_skin_positions" / "right_leg_lower.txt")
    return leg.layout(rebuilt_normals(leg.positions, leg.modules))


def leg_drawing(data: Path, layout: SkinLayout) -> FloatArray:
    """Read where its taxels are in the drawing of the GUI, u and v in m."""
    plan = describe_patch(data / "icub_skin_positions" / "skinGui_ini" / "right_leg_lower.ini")
    return plan.positions[np.searchsorted(plan.taxels, layout.taxels), :2]


class PatchTrials:
    """A patch with every method, and its taxels."""

    def __init__(
        self,
        layout: SkinLayout,
        drawing: FloatArray,
        seed: int,
        *,
        simple_area_m2: float = SIMPLE_AREA_M2,
        least_pa: float = 0.0,
    ) -> None:
        self.seed, self.layout, self._least_pa = seed, layout, least_pa
        self.patches = {
            WrenchMethod.SIMPLE: SkinPatch.of(layout, "simple", taxel_area_m2=simple_area_m2),
            WrenchMethod.THESIS: SkinPatch.of(layout, "thesis", plane=drawing),
            WrenchMethod.LINEAR: SkinPatch.of(layout, "linear"),
            WrenchMethod.KRIGING: SkinPatch.of(layout, "kriging"),
        }
        rng = np.random.default_rng([seed, 1])
        self.taxels = TaxelResponses.drawn(len(layout), rng)
        self.tables = {both: chamber_table(self.taxels, rng, both_ways=both) for both in (False, True)}

    def trials(self, truths: Sequence[ContactTruth], chain: Chain | None = None) -> list[ContactTrial]:
        """Tell what each object does, from ideal pads or through a chain."""
        if chain is None:
            return [self._trial(one, self._ideal(one)) for one in truths]
        rng = np.random.default_rng([self.seed, 2])
        live = np.ones(len(self.layout), dtype=np.bool_)
        live[rng.permutation(len(live))[: round(chain.dead * len(live))]] = False
        rest = self.taxels.counts(np.zeros(len(live)), rng, frames=REST_FRAMES).astype(np.float64)
        reader = PatchReader.at_rest(self.tables[chain.both_ways], rest, live=live)
        return [self._trial(one, self._read(one, chain, reader, rng)) for one in truths]

    def _read(self, truth: ContactTruth, chain: Chain, reader: PatchReader, rng: np.random.Generator) -> PressureFrame:
        peak = truth.pressures / rng.uniform(0.3, 0.9) if chain.unloading else None
        return reader.frame(self.taxels.counts(truth.pressures, rng, frames=chain.frames, peak=peak))

    def _trial(self, truth: ContactTruth, frame: PressureFrame) -> ContactTrial:
        told = {method: find_contacts(patch, frame) for method, patch in self.patches.items()}
        ours = told[WrenchMethod.KRIGING]
        one = len(ours) == 1
        return ContactTrial(
            truth=truth,
            active=int(frame.active.sum()),
            contacts=len(ours),
            wrenches={method: contacts.wrench.sum(axis=0) for method, contacts in told.items()},
            sd_N=float(ours.force_sd_N[0]) if one else np.nan,
            sd=np.sqrt(np.diagonal(ours.covariance[0])) if one else np.full(6, np.nan),
            centre=ours.centre_of_pressure[0] if one else np.full(3, np.nan),
            in_scope=one and not ours.beyond_range[0] and bool(ours.edge_share[0] < OFF_EDGE),
        )

    def _ideal(self, truth: ContactTruth) -> PressureFrame:
        pressures = np.maximum(truth.pressures, 0.0)
        return PressureFrame(
            pressures=pressures, active=pressures > self._least_pa, beyond_range=pressures > REFERENCE_PA
        )


class Leg(PatchTrials):
    """The lower leg and its true surface."""

    def __init__(self, data: Path, seed: int) -> None:
        layout = leg_layout(data)
        super().__init__(layout, leg_drawing(data, layout), seed)
        self.body = SkinBody.of(layout)

    def truths(self, number: int) -> list[ContactTruth]:
        """Rest so many objects on it."""
        return list(contacts(self.body, np.random.default_rng(self.seed), number))


def chamber_table(taxels: TaxelResponses, rng: np.random.Generator, *, both_ways: bool) -> PressureTable:
    """Calibrate taxels in a chamber, on loading alone or on both ways."""
    log = chamber_recording(taxels, highest_pa=REFERENCE_PA, ramp_s=8.0, rng=rng)
    counts = log.stream("counts").signal("taxel_counts").values
    cycle = pressure_cycle(counts, log.stream("chamber").signal("pressure").values[:, 0])
    # long rest would outweigh the first counts of the rise: noise there is no pressure
    pressed = cycle.pressure > REST_SHARE * cycle.highest
    used = pressed if both_ways else pressed & ~cycle.unloading
    number = cycle.fall.shape[1]
    curves = [
        fit_curve(CurveKind.MONOTONE, cycle.fall[used, k], cycle.pressure[used], range_counts=float(cycle.top_fall[k]))
        for k in range(number)
    ]
    worth = [
        calibrated_taxel(k, curve, cycle.fall[:, k], cycle.pressure, cycle.unloading) for k, curve in enumerate(curves)
    ]
    return PressureTable(
        patch="leg",
        columns=number,
        taxels=np.arange(number),
        live=np.ones(number, dtype=np.bool_),
        values=np.stack([curve.pressure(np.arange(256.0)) for curve in curves], axis=1),
        range_counts=np.array([curve.range_counts for curve in curves]),
        error=np.array([one.error_pa for one in worth]),
        hysteresis=np.array([one.hysteresis_pa for one in worth]),
    )


def errors(trials: Sequence[ContactTrial], method: WrenchMethod) -> Errors:
    """Average the errors of a method."""
    true = np.stack([one.truth.wrench for one in trials])
    told = np.stack([one.wrenches[method] for one in trials])
    load = np.array([one.truth.load_N for one in trials])
    norm, true_norm = np.linalg.norm(told[:, :3], axis=1), np.linalg.norm(true[:, :3], axis=1)
    gain = norm @ true_norm / (norm @ norm)
    off = told - true
    return Errors(
        number=len(trials),
        magnitude_N=float(np.abs(norm - true_norm).mean()),
        over_load=float((np.abs(norm - true_norm) / load).mean()),
        bias=float(((norm - true_norm) / load).mean()),
        vector_N=float(np.linalg.norm(off[:, :3], axis=1).mean()),
        torque_Nm=float(np.linalg.norm(off[:, 3:], axis=1).mean()),
        gained_N=float(np.abs(gain * norm - true_norm).mean()),
    )


def within(trials: Sequence[ContactTrial], times: float) -> tuple[float, int]:
    """Share of the first contacts in scope that are off by at most so many predicted deviations, and their number."""
    scope = [one for one in trials if one.in_scope][:PREDICTED]
    off = [
        abs(np.linalg.norm(one.wrenches[WrenchMethod.KRIGING][:3]) - np.linalg.norm(one.truth.wrench[:3])) / one.sd_N
        for one in scope
    ]
    return float(np.mean(np.array(off) <= times)), len(scope)


def by_active(trials: Sequence[ContactTrial]) -> dict[tuple[int, int], list[ContactTrial]]:
    """Sort contacts by the number of taxels that feel them."""
    return {(low, high): [one for one in trials if low <= one.active <= high] for low, high in BINS}


CHAINS: Final[Mapping[str, Chain | None]] = {
    "ideal pads": None,
    "chain, one frame, loading": Chain(frames=1),
    "chain, ten frames, loading": Chain(),
    "chain, ten frames, unloading": Chain(unloading=True),
    "chain, ten frames, loading, 15 % dead": Chain(dead=DEAD_SHARE),
    "chain, ten frames, loading, curves of both ways": Chain(both_ways=True),
    "chain, ten frames, unloading, curves of both ways": Chain(both_ways=True, unloading=True),
}


def main() -> None:
    """Print errors by chain, method and number of active taxels, and how often predicted deviations hold."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--data", type=Path, default=Path("../shared/data"), help="folder of measured data")
    parser.add_argument("--contacts", type=int, default=CONTACTS)
    parser.add_argument("--seed", type=int, default=JUDGED_SEED)
    options = parser.parse_args()
    leg = Leg(options.data, options.seed)
    truths = leg.truths(options.contacts)
    for name, chain in CHAINS.items():
        trials = leg.trials(truths, chain)
        print(f"\n{name}: {len(trials)} contacts, {np.mean([t.truth.load_N for t in trials]):.1f} N")  # noqa: T201
        for method in WrenchMethod:
            print(_line(method, errors(trials, method)))  # noqa: T201
            for (low, high), some in by_active(trials).items():
                if some:
                    told = errors(some, method)
                    words = f"{told.number} contacts, {told.over_load:.2%}, bias {told.bias:+.1%}"
                    print(f"    {low} to {high} active: {words}")  # noqa: T201
        shares = ", ".join(f"{within(trials, times)[0]:.1%} within {times:g} sd" for times in (1.0, 2.0))
        print(f"  {within(trials, 1.0)[1]} contacts in scope: {shares}")  # noqa: T201


def _line(method: WrenchMethod, told: Errors) -> str:
    return (
        f"  {method}: {told.magnitude_N:.3f} N, {told.over_load:.2%} of the load, bias {told.bias:+.1%}, vector "
        f"{told.vector_N:.3f} N, torque {told.torque_Nm:.4f} N m, with its best gain {told.gained_N:.3f} N"
    )


if __name__ == "__main__":
    main()
