# SPDX-License-Identifier: BSD-3-Clause
"""Ellipsoids through a million forces: seconds with the uncertainty, against single fits of NumPy and SciPy."""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.sphere.algebraic_fit import direct_fit, gradient_weighted_fit
from forcetorque.evaluation.sphere.cloud import QuadricMoments, extent
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid, ellipsoid_of_map
from forcetorque.evaluation.sphere.geometric_fit import ellipsoid_distances, refine_ellipsoid
from forcetorque.evaluation.sphere.resampling import Resampled, resampled
from forcetorque.evaluation.sphere.sensor_sphere import SphereAnalysis, analyse_sphere

WEIGHT, NOISE = 46.4, 0.5
"""Weight of a leg and noise of its sensor; N."""
MATRIX = np.array([[1.12, 0.08, -0.05], [-0.04, 1.45, 0.10], [0.06, 0.02, 1.03]])
"""What the sensor makes of forces."""


def main() -> None:
    """Time both, and write ratios and how far they agree."""
    options = arguments(__doc__ or "")
    count, rounds = (50_000, 3) if options.quick else (1_000_000, 10)
    reference = WEIGHT * _directions(count)
    force = reference @ MATRIX.T + [12.0, -30.0, 55.0] + NOISE * np.random.default_rng(1).normal(size=(count, 3))
    start = ellipsoid_of_map(MATRIX, centre=force.mean(axis=0), radius=0.9 * WEIGHT)
    wrench, expected = (np.hstack([f, 0.1 * f[:, ::-1]]) for f in (force, reference))
    tasks = {
        "direct and gradient-weighted fits, 278 parts each": lambda: _algebraic(force),
        "direct fit in NumPy, once": lambda: _direct_in_numpy(force),
        "geometric fit": lambda: refine_ellipsoid(force, start),
        "whole analysis": lambda: analyse_sphere(wrench, expected, gravity=9.81),
    }
    seconds = interleaved(tasks, rounds=rounds)
    # minutes for a million: a few rounds on as many points as it is bearable for
    few = force[:: -(-count // 20_000)]
    slow = {
        "geometric fit, 20000 points": lambda: refine_ellipsoid(few, start),
        "geometric fit in SciPy, 20000 points": lambda: _geometric_in_scipy(few, start),
    }
    seconds |= interleaved(slow, rounds=3)
    analysis: SphereAnalysis = analyse_sphere(wrench, expected, gravity=9.81)
    ours, _ = refine_ellipsoid(few, start)
    difference = np.abs(ours.axis_intersections - _geometric_in_scipy(few, start)).max()
    truth = ellipsoid_of_map(MATRIX, centre=np.zeros(3), radius=WEIGHT).axis_intersections
    found = analysis.masses(analysis.free)
    write_result(
        options.json,
        ratios={
            "556 algebraic fits to one by NumPy": median_ratio(
                seconds["direct and gradient-weighted fits, 278 parts each"], seconds["direct fit in NumPy, once"]
            ),
            "geometric fit to SciPy's": median_ratio(
                seconds["geometric fit, 20000 points"], seconds["geometric fit in SciPy, 20000 points"]
            ),
        },
        seconds=seconds,
        accuracy={
            "points": count,
            "largest difference of a direct intersection from NumPy's, N": float(
                np.abs(1.0 / _algebraic(force)[0].whole[:3] - _direct_in_numpy(force)).max()
            ),
            "largest difference of a geometric intersection from SciPy's, N": float(difference),
            "largest error of an intersection without the model, N": float(
                np.nan if found is None else np.abs(9.81 * found - truth).max()
            ),
            "identifiable": analysis.free.identifiable,
        },
        rounds=rounds,
        packages=("numpy", "scipy"),
    )


def _directions(count: int) -> FloatArray:
    """Directions of gravity on a grid of 60 degrees to each side, in seven rows."""
    time = np.linspace(0.0, 7.0, count, endpoint=False)
    row = np.floor(time)
    there = 2.0 * (time - row) - 1.0
    slow, fast = np.pi / 3.0 * (row / 3.0 - 1.0), np.pi / 3.0 * np.where(row % 2 == 0, there, -there)
    return np.column_stack([np.sin(fast), -np.sin(slow) * np.cos(fast), -np.cos(slow) * np.cos(fast)])


def _algebraic(force: FloatArray) -> list[Resampled]:
    moments = QuadricMoments.of(force)
    return [
        resampled(moments.sums, lambda mean, fit=fit: fit(mean, moments).inverse_lengths, extent=extent)
        for fit in (direct_fit, gradient_weighted_fit)
    ]


def _direct_in_numpy(force: FloatArray) -> FloatArray:
    """Axis intersections by the direct method on the design matrix, with the largest k that ours tries."""
    shift = force.mean(axis=0)
    scale = np.sqrt(((force - shift) ** 2).sum(axis=1).mean())
    x, y, z = ((force - shift) / scale).T
    one = np.ones(len(force))
    design = np.column_stack([x * x, y * y, z * z, 2 * y * z, 2 * x * z, 2 * x * y, 2 * x, 2 * y, 2 * z, one])
    scatter = design.T @ design
    k = 1000.0
    constraint = np.zeros((6, 6))
    constraint[:3, :3] = k / 2 - 1 - k / 2 * np.eye(3)
    constraint[3:, 3:] = -k * np.eye(3)
    rest = np.linalg.solve(scatter[6:, 6:], scatter[6:, :6])
    values, vectors = np.linalg.eig(np.linalg.solve(constraint, scatter[:6, :6] - scatter[:6, 6:] @ rest))
    v = vectors[:, np.argmax(values.real)].real
    linear = -rest @ v
    a = np.array([[v[0], v[5], v[4]], [v[5], v[1], v[3]], [v[4], v[3], v[2]]])
    level = linear[:3] @ np.linalg.solve(a, linear[:3]) - linear[3]
    return scale / np.sqrt(np.diag(a) / level)


def _geometric_in_scipy(force: FloatArray, start: Ellipsoid) -> FloatArray:
    """Axis intersections by `least_squares` on the same distances, with its own Jacobian."""
    values, axes = np.linalg.eigh(start.shape)
    axes = axes * np.sign(np.linalg.det(axes))

    def ellipsoid(p: FloatArray) -> Ellipsoid:
        turned = Rotation.from_rotvec(p[6:]).as_matrix() @ axes
        return Ellipsoid(centre=p[:3], shape=turned @ np.diag(np.exp(-2.0 * p[3:6])) @ turned.T)

    begin = np.concatenate([start.centre, -0.5 * np.log(values), np.zeros(3)])
    found = least_squares(lambda p: ellipsoid_distances(force, ellipsoid(p)), begin, xtol=1e-12, ftol=1e-12, gtol=1e-12)
    return ellipsoid(found.x).axis_intersections


if __name__ == "__main__":
    main()
