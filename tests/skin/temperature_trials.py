# SPDX-License-Identifier: BSD-3-Clause
"""A contact of 9.8 N held for sixteen minutes while the skin warms by ten degrees, from inside or from outside.

`python -m tests.skin.temperature_trials` prints the figures of docs/skin/temperature.md: the layout is iCub's
`right_leg_lower`; contacts, taxels and heat are simulated, drawn anew for every trial.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.recording.recording import Recording
from forcetorque.skin.contact.contact_clusters import SkinContacts, find_contacts
from forcetorque.skin.contact.contact_tracking import PatchFollower
from forcetorque.skin.contact.pressure_frame import PatchReader
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import ON_SKIN, ContactTruth, SkinBody, contacts
from forcetorque.skin.simulation.recordings import TaxelResponses
from forcetorque.skin.simulation.temperature import HeatResponses, Warmth, warm_recording
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PressureTable
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains, TaxelDrift
from forcetorque.skin.temperature.warm_up_calibration import fit_warm_up
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from tests.skin.contact_trials import chamber_table, leg_layout

MASS_KG: Final = 1.0
AVERAGED: Final = 10
"""Messages of a frame: one second."""
HIGH_PASS_S: Final = 30.0
"""Time constant of a high-pass that moves the baseline of every taxel, touched or not."""
LAST_S: Final = 10.0
"""Time over which errors are averaged; rules without a memory are asked for twice that at the end only."""
DRAWS: Final = 10
"""Patches with own taxels, gains, object and noise."""
WARM_UP: Final = Warmth(hold_s=1200.0)
"""The recording without contact that gains are learned in."""
INSIDE: Final = Warmth()
OUTSIDE: Final = Warmth(inside_K=0.0, outside_K=10.0)
BOTH: Final = Warmth(outside_K=10.0)
"""Heat while the contact is held: ten degrees each."""
MINUTES: Final = (1, 4, 16)
"""Times in contact at which the limit is held against the error."""


@dataclass(frozen=True, kw_only=True)
class HeldContact:
    """What a rule says of one contact that is held while it is warm."""

    true_N: float
    """Norm of the force."""
    forces_N: FloatArray
    """Norm of the force of all contacts that are told, frame by frame; shape (k,)."""
    limits_N: FloatArray
    """Sum of the drift limits of all contacts; shape (k,)."""
    seconds: FloatArray
    """Time in contact; shape (k,); s."""

    @property
    def errors_N(self) -> FloatArray:
        """Error of the norm; shape (k,)."""
        return np.abs(self.forces_N - self.true_N)

    def at(self, minutes: float) -> tuple[float, float]:
        """Mean error and limit over the last seconds before so many minutes in contact."""
        rows = (self.seconds > 60.0 * minutes - LAST_S) & (self.seconds < 60.0 * minutes)
        return float(self.errors_N[rows].mean()), float(self.limits_N[rows].mean())


class WarmPatch:
    """A patch of one draw: taxels, table, what was learned in a warm-up, and an object that rests on it."""

    def __init__(self, patch: SkinPatch, body: SkinBody, seed: int) -> None:
        self.patch, self.seed = patch, seed
        rng = np.random.default_rng([seed, 1])
        self.truth = resting(body, rng)
        self.taxels = TaxelResponses.drawn(len(patch.layout), rng)
        self.heat = HeatResponses.drawn(patch.layout, rng)
        self.table = _whole_message(chamber_table(self.taxels, rng, both_ways=False), patch.layout)
        log = counts_of(warm_recording(patch.layout, self.taxels, self.heat, rng, warmth=WARM_UP))
        self.learned = HeatGains.learned(fit_warm_up("warm up", *log, patch.layout).taxels)

    def messages(self, warmth: Warmth) -> tuple[FloatArray, FloatArray]:
        """Times and counts while the object is held."""
        rng = np.random.default_rng([self.seed, 2])
        return counts_of(
            warm_recording(self.patch.layout, self.taxels, self.heat, rng, warmth=warmth, truth=self.truth)
        )

    def follow(self, warmth: Warmth) -> dict[str, HeldContact]:
        """Tell the contact by every rule, frame by frame."""
        messages = self.messages(warmth)
        return {rule: self._told(rule, warmth, *messages) for rule in RULES}

    def _told(self, rule: str, warmth: Warmth, seconds: FloatArray, counts: FloatArray) -> HeldContact:
        reader = PatchReader.at_rest(self.table, counts[seconds < warmth.rest_s])
        forces, limits, times = [], [], []
        for second, found in self._contacts(rule, reader, seconds, counts):
            forces.append(float(np.linalg.norm(found.wrench[:, :3].sum(axis=0))))
            limits.append(float(found.drift_limit_N.sum()))
            times.append(second - warmth.rest_s)
        return HeldContact(
            true_N=float(np.linalg.norm(self.truth.wrench[:3])),
            forces_N=np.array(forces),
            limits_N=np.array(limits),
            seconds=np.array(times),
        )

    def _contacts(
        self, rule: str, reader: PatchReader, seconds: FloatArray, counts: FloatArray
    ) -> Iterator[tuple[float, SkinContacts]]:
        follower = PatchFollower(self.patch, reader, self.learned)
        firmware = HeatGains.of_firmware(self.patch.layout)
        passed = np.zeros(len(self.patch.layout))
        for start in range(0, len(seconds) - AVERAGED + 1, AVERAGED):
            rows = slice(start, start + AVERAGED)
            second = float(seconds[rows].mean())
            if rule == "learned":
                yield second, follower.frame(second, counts[rows])[1]
                continue
            fall = np.zeros(len(passed))
            if rule == "firmware":
                mean = counts[rows].mean(axis=0)
                fall, _ = firmware.fall(reader.rest[firmware.pads] - mean[firmware.pads])
            elif rule == "high-pass":
                fall = passed
                left = reader.table.fall(counts[rows].mean(axis=0), reader.rest) - passed
                passed = passed + left * (seconds[AVERAGED] - seconds[0]) / HIGH_PASS_S
            if second < seconds[-1] - 2.0 * LAST_S:
                continue
            none = np.zeros(len(fall))
            drift = TaxelDrift(fall=fall, sd=none, limit=none)
            yield second, find_contacts(self.patch, reader.frame(counts[rows], drift=drift))


RULES: Final = ("none", "firmware", "high-pass", "learned")


def resting(body: SkinBody, rng: np.random.Generator) -> ContactTruth:
    """An object of one kilogram, somewhere on the skin."""
    for truth in contacts(body, rng, 1000):
        heavy = body.press(replace(truth.contact, mass_kg=MASS_KG))
        if heavy.on_skin >= ON_SKIN:
            return heavy
    raise AssertionError("no object has room")


def counts_of(recording: Recording) -> tuple[FloatArray, FloatArray]:
    """Times and counts."""
    stream = recording.stream("counts")
    return 1e-9 * (stream.stamp_ns - stream.stamp_ns[0]), stream.signal("taxel_counts").values


def _whole_message(table: PressureTable, layout: SkinLayout) -> PressureTable:
    """The table of taxels, by their columns in a message with thermal pads."""
    return replace(table, columns=layout.columns, taxels=layout.taxels)


def share_within(trials: Sequence[HeldContact], minutes: float) -> float:
    """Share of trials whose error the drift limit contains after so many minutes."""
    return float(np.mean([error <= limit for error, limit in (trial.at(minutes) for trial in trials)]))


def main() -> None:
    """Print errors by rule and heat, and how often the drift limit contains them."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--data", type=Path, default=Path("../shared/data"), help="folder of measured data")
    parser.add_argument("--draws", type=int, default=DRAWS)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    layout = leg_layout(options.data)
    patch, body = SkinPatch.of(layout), SkinBody.of(layout)
    draws = [WarmPatch(patch, body, options.seed + k) for k in range(options.draws)]
    for name, warmth in (("inside", INSIDE), ("outside", OUTSIDE), ("both", BOTH)):
        told = [draw.follow(warmth) for draw in draws]
        for rule in RULES:
            trials = [draw[rule] for draw in told]
            errors = [trial.at(16)[0] for trial in trials]
            line = f"{name}, {rule}: error after 16 minutes {np.mean(errors):.2f} N, at most {np.max(errors):.2f} N"
            if rule == "learned":
                for minutes in MINUTES:
                    limit = np.median([trial.at(minutes)[1] for trial in trials])
                    line += (
                        f"; {minutes} min: within {limit:.1f} N (median limit) in {share_within(trials, minutes):.0%}"
                    )
            print(line, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
