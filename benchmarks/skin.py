# SPDX-License-Identifier: BSD-3-Clause
"""A frame of skin from counts to wrenches of contacts, against interpolating the field anew in every frame."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np

from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.arrays import FloatArray, IntArray
from forcetorque.skin import PressureTable, SkinLayout
from forcetorque.skin.contact import PatchReader, SkinContacts, find_contacts
from forcetorque.skin.wrench import SkinPatch
from forcetorque.skin.wrench.thesis import DISC_POINTS, DISC_RADIUS_M

PITCH_M = 6.6e-3
FEW, MANY = 380, 4000
"""Taxels of a lower leg, and of a whole robot."""
GRID_M = 1e-3
"""Grid on which the thesis interpolates."""
CONTACTS = 4
REPEATS = 20
"""Calls that are timed together: one takes microseconds."""


def main() -> None:
    """Time both, and write ratios, microseconds and how far both agree."""
    options = arguments(__doc__ or "")
    rounds = 3 if options.quick else 30
    few, many = _Skin(FEW), _Skin(MANY)
    operator = few.patch.operator()
    tasks: dict[str, Callable[[], object]] = {
        "product, 380 taxels": lambda: _repeated(lambda: operator.wrench(few.pressures)),
        "frame, 380 taxels": lambda: _repeated(few.frame),
        "frame, 4000 taxels": lambda: _repeated(many.frame),
        "interpolated anew, 380 taxels": few.interpolated,
    }
    seconds = interleaved(tasks, rounds=rounds)
    for name in list(tasks)[:3]:
        seconds[name] = [value / REPEATS for value in seconds[name]]
    build = few.build_seconds()
    peer = seconds["interpolated anew, 380 taxels"]
    whole = float(few.patch.operator().normal_force(few.pressures))
    write_result(
        options.json,
        ratios={
            "frame to interpolating anew, 380 taxels": median_ratio(seconds["frame, 380 taxels"], peer),
            "product to interpolating anew, 380 taxels": median_ratio(seconds["product, 380 taxels"], peer),
        },
        seconds=seconds,
        accuracy={"force over interpolated force": whole / few.interpolated(), "contacts": len(many.frame().wrench)},
        rounds=rounds,
        packages=("numpy", "scipy"),
        figures={
            **{f"{name}_us": 1e6 * statistics.median(values) for name, values in seconds.items()},
            "build_380_taxels_s": build,
            "times_faster_than_interpolating": statistics.median(peer)
            / statistics.median(seconds["frame, 380 taxels"]),
        },
    )


class _Skin:
    """A patch on a half pipe with some contacts, its table, and one message."""

    def __init__(self, number: int) -> None:
        rng = np.random.default_rng(1)
        self.layout, self.flat = _half_pipe(number)
        self.patch = SkinPatch.of(self.layout)
        fall = np.arange(256.0)[:, None] * rng.uniform(900.0, 1200.0, number)
        table = PressureTable(
            patch="pipe",
            columns=number,
            taxels=np.arange(number),
            live=np.ones(number, dtype=bool),
            values=fall,
            range_counts=np.full(number, 50.0),
            error=np.full(number, 200.0),
            hysteresis=np.full(number, 1500.0),
        )
        rest = 240.0 + np.rint(rng.normal(0.0, 0.65, (50, number)))
        self.reader = PatchReader.at_rest(table, rest)
        self.counts = np.rint(self.reader.rest - self._falls(rng))
        self.pressures = table.pressures(self.counts, self.reader.rest)
        angle = 2.0 * np.pi * np.arange(DISC_POINTS) / DISC_POINTS
        outline = DISC_RADIUS_M * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        self._discs = (self.flat[:, None] + outline).reshape(-1, 2)
        low, high = self.flat.min(axis=0), self.flat.max(axis=0)
        self._grid = tuple(np.meshgrid(*(np.arange(a, b, GRID_M) for a, b in zip(low, high, strict=True))))
        self.frame()

    def frame(self) -> SkinContacts:
        """Table, active taxels, ring, contacts and their wrenches."""
        return find_contacts(self.patch, self.reader.frame(self.counts))

    def interpolated(self) -> float:
        """Pressure between discs on a grid of 1 mm, as the thesis has it by `griddata` in every frame, and its sum."""
        from scipy.interpolate import griddata

        pressures = np.repeat(self.pressures, DISC_POINTS)
        field = griddata(self._discs, pressures, self._grid, method="linear", fill_value=0.0)
        return float(field.sum() * GRID_M**2)

    def build_seconds(self) -> float:
        """Surface and operators from nothing, the median of some."""
        taken = []
        for _ in range(5):
            start = time.perf_counter()
            patch = SkinPatch.of(self.layout)
            operator = patch.operator()
            patch.foretold(operator.live)
            taken.append(time.perf_counter() - start)
        return statistics.median(taken)

    def _falls(self, rng: np.random.Generator) -> FloatArray:
        falls = np.zeros(len(self.layout))
        for centre in rng.choice(len(self.layout), CONTACTS, replace=False):
            distance = np.linalg.norm(self.layout.positions - self.layout.positions[centre], axis=1)
            falls += 20.0 * np.exp(-0.5 * (distance / 0.012) ** 2)
        return falls


def _repeated(task: Callable[[], object]) -> None:
    for _ in range(REPEATS):
        task()


def _half_pipe(number: int) -> tuple[SkinLayout, FloatArray]:
    """A triangular lattice on half a cylinder, and the same in a plane."""
    columns = int(np.sqrt(number))
    row, column = np.divmod(np.arange(number), columns)
    flat = PITCH_M * np.stack([column + 0.5 * (row % 2), np.sqrt(0.75) * row], axis=1)
    radius = PITCH_M * columns / np.pi
    angle = flat[:, 0] / radius
    normals = np.stack([np.cos(angle), np.sin(angle), np.zeros(number)], axis=1)
    positions = radius * normals + np.outer(flat[:, 1], [0.0, 0.0, 1.0])
    none: IntArray = np.zeros(0, dtype=np.int64)
    layout = SkinLayout(
        name="pipe",
        frame="link",
        columns=number,
        taxels=np.arange(number),
        modules=np.arange(number) // 10,
        positions=positions,
        normals=normals,
        thermal_pads=none,
        thermal_modules=none,
    )
    return layout, flat


if __name__ == "__main__":
    main()
