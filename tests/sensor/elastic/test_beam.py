# SPDX-License-Identifier: BSD-3-Clause
"""A clamped beam: against tables of cantilevers, and its strain against its energy."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.elastic_element import Beam, Material, RectangularSection

MATERIAL = Material(young_modulus=200e9, shear_modulus=78e9)
SECTION = RectangularSection(width=0.003, height=0.005)
BEAM = Beam(length=0.02, section=SECTION, material=MATERIAL)

ROUNDING = 1e-11
"""Relative rounding of the inverse of a 2 x 2 block, whose condition number is below 1e5."""

WRENCH = np.array([30.0, -20.0, 50.0, 0.3, -0.4, 0.2])
"""A load without symmetry; N, N m."""


def _cantilever_flexibility() -> FloatArray:
    """Displacement of the free end per load, from the tables: F l3 / 3 E I, F l2 / 2 E I, M l / E I."""
    l, E = BEAM.length, MATERIAL.young_modulus  # noqa: E741
    flexibility = np.zeros((6, 6))
    flexibility[0, 0] = l / (E * SECTION.area)
    flexibility[3, 3] = l / (MATERIAL.shear_modulus * SECTION.torsion_constant)
    # the free end is at x = 0: pushed along y it slopes downwards to the clamp, so it turns about -z
    for (move, turn), moment, sign in (
        ((1, 5), SECTION.second_moment_z, -1.0),
        ((2, 4), SECTION.second_moment_y, 1.0),
    ):
        flexibility[move, move] = l**3 / (3.0 * E * moment)
        flexibility[turn, turn] = l / (E * moment)
        flexibility[move, turn] = flexibility[turn, move] = sign * l**2 / (2.0 * E * moment)
    return flexibility


def test_stiffness_inverts_the_tables_of_cantilevers() -> None:
    """The load that makes a displacement is the displacement's inverse problem."""
    product = BEAM.stiffness() @ _cantilever_flexibility()
    scale = np.abs(BEAM.stiffness()) @ np.abs(_cantilever_flexibility())
    assert (np.abs(product - np.eye(6)) <= ROUNDING * np.maximum(scale, 1.0)).all()


def test_a_coupling_of_the_wrong_sign_does_not() -> None:
    """Negative control: the sign of the couple that keeps an end straight matters in each plane."""
    tried = 0
    for i, j in ((1, 5), (2, 4)):
        wrong = BEAM.stiffness()
        wrong[i, j], wrong[j, i] = -wrong[i, j], -wrong[j, i]
        assert np.abs(np.diag(wrong @ _cantilever_flexibility()) - 1.0).max() > 1.0
        tried += 1
    assert tried == 2


def test_a_guided_end_is_four_times_stiffer_than_a_free_one() -> None:
    """12 E I / l3 for an end that cannot turn, 3 E I / l3 for one that can."""
    guided = BEAM.stiffness()[2, 2]
    free = 1.0 / np.linalg.inv(BEAM.stiffness())[2, 2]
    assert guided == pytest.approx(4.0 * free, rel=ROUNDING)


def _strain_energy(wrench: FloatArray) -> float:
    """Energy of strains along the beam, by exact quadrature of their squares over the volume; J."""
    nodes, weights = np.polynomial.legendre.leggauss(3)  # exact up to fifth powers, the strain is linear
    energy = 0.0
    for x, wx in zip(nodes, weights, strict=True):
        for y, wy in zip(nodes, weights, strict=True):
            for z, wz in zip(nodes, weights, strict=True):
                strain = BEAM.strain(
                    wrench,
                    position=0.5 * BEAM.length * (1 + x),
                    y=0.5 * SECTION.width * y,
                    z=0.5 * SECTION.height * z,
                )
                energy += wx * wy * wz / 8.0 * float(strain) ** 2
    return 0.5 * MATERIAL.young_modulus * energy * SECTION.area * BEAM.length


def _work(wrench: FloatArray) -> float:
    """Work of a load on the inner end, without that of the torque in twisting; J."""
    displacement = np.linalg.solve(BEAM.stiffness(), wrench)
    return float(0.5 * (wrench @ displacement - wrench[3] * displacement[3]))


def test_strain_holds_the_work_of_the_load() -> None:
    """The energy of all strains equals the work of the load at the end, whatever the load."""
    rng = np.random.default_rng(1)
    for load in (WRENCH, *rng.normal(size=(5, 6)) * [50, 50, 50, 1, 1, 1]):
        assert _strain_energy(load) == pytest.approx(_work(load), rel=ROUNDING)


def test_a_moment_of_the_wrong_sign_breaks_the_energy() -> None:
    """Negative control: strains of a reversed moment hold another energy."""
    wrong = WRENCH * [1, 1, 1, 1, -1, -1]
    assert abs(_strain_energy(wrong) / _work(WRENCH) - 1.0) > 0.1


def test_strain_by_hand() -> None:
    """At the clamp a force along z bends with its full lever: M = -F l about y; a push shortens."""
    upper = BEAM.strain([0, 0, 40.0, 0, 0, 0], position=BEAM.length, y=0.0, z=SECTION.height / 2)
    # pushed up at its free end, the beam is pressed on its upper face at the clamp
    bent = 40.0 * BEAM.length * (SECTION.height / 2) / (MATERIAL.young_modulus * SECTION.second_moment_y)
    assert upper == pytest.approx(-bent, rel=ROUNDING)
    pushed = BEAM.strain([40.0, 0, 0, 0, 0, 0], position=0.01, y=0.001, z=0.001)
    assert pushed == pytest.approx(-40.0 / (MATERIAL.young_modulus * SECTION.area), rel=ROUNDING)


def test_faces_bend_oppositely() -> None:
    """Without a force along the beam opposite places of a section have opposite strains."""
    bent = WRENCH * [0, 1, 1, 1, 1, 1]
    there = BEAM.strain(bent, position=0.004, y=0.0015, z=-0.0025)
    assert there == pytest.approx(-BEAM.strain(bent, position=0.004, y=-0.0015, z=0.0025), rel=ROUNDING)
    assert abs(there) > 1e-6


def test_bad_arguments_are_refused() -> None:
    """A beam without length, and a load that is no wrench."""
    with pytest.raises(SensorError, match="Beam: length"):
        Beam(length=-1.0, section=SECTION, material=MATERIAL)
    with pytest.raises(ShapeError, match="end_wrench"):
        BEAM.strain(np.zeros(3), position=0.0, y=0.0, z=0.0)
