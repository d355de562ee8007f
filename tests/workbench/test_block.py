# SPDX-License-Identifier: BSD-3-Clause
"""Blocks as they come: at rest or not, and of the position that they are said to be of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.workbench.bench import BIAS, Block, block_findings
from forcetorque.workbench.simulated_benches import simulate_specimen
from tests.scenes.benches import PLACEMENT, thesis_loads

FULL_SCALE = np.full(6, 32767.0)


def _block(mean: FloatArray, position: str = "1", *, rng: np.random.Generator | None = None) -> Block:
    noise = np.zeros((100, 6)) if rng is None else rng.standard_normal((100, 6))
    return Block.of(position, mean + noise, FULL_SCALE, source=f"output{position}.dat")


def test_a_block_at_rest_is_its_mean() -> None:
    """With the standard error of white noise, and nothing to say."""
    block = _block(np.arange(6.0), rng=np.random.default_rng(1))
    np.testing.assert_allclose(block.mean, np.arange(6.0), atol=0.5)
    assert block.standard_error == pytest.approx(0.1, rel=0.5)
    assert (block.moved, block.saturated, block.frozen) == (False, False, False)


def test_what_is_wrong_with_samples_is_told() -> None:
    """A load that is put down within the block, a channel at its limit, a log that stands, a gap."""
    rng = np.random.default_rng(2)
    step = np.where(np.arange(100)[:, None] < 60, 0.0, 500.0) + rng.standard_normal((100, 6))
    assert Block.of("1", step, FULL_SCALE, source="a").moved
    assert _block(np.full(6, 32767.0), rng=rng).saturated
    assert _block(np.zeros(6)).frozen
    gap = np.zeros((10, 6))
    gap[4, 2] = np.nan
    with pytest.raises(FormatError, match=r"a: .* a missing number in row 5"):
        Block.of("1", gap, FULL_SCALE, source="a")


def _findings(order: list[int], named: list[int], *, scale: float = 1.0) -> list[tuple[str, ...]]:
    """Positions that are recorded in an order, and called something."""
    specimen = simulate_specimen(thesis_loads(), PLACEMENT, np.random.default_rng(6), with_prior=True)
    bench, rng = specimen.bench, np.random.default_rng(7)
    blocks = [_block(scale * bench.raw[k], bench.loads.names[n], rng=rng) for k, n in zip(order, named, strict=True)]
    return block_findings(blocks, [_block(np.zeros(6), BIAS, rng=rng)] * len(order), bench.loads, bench.prior)


def test_sound_blocks_have_no_findings() -> None:
    """All 24 of most specimens: their sensitivity differs by a tenth."""
    assert not any(_findings(list(range(24)), list(range(24))))


def test_a_block_of_another_position_is_told_at_once() -> None:
    """Which one it reads like; one that was not moved; a sign."""
    taken_for = _findings([0, 8], [0, 3])
    assert taken_for[0] == ()
    assert "reads like position 9" in taken_for[1][0]
    assert "as position 1 before it" in _findings([0, 0], [0, 1])[1][0]
    assert "sign is the other way round" in _findings([0, 1], [0, 1], scale=-1.2)[1][0]
    assert "0.4" in _findings([4, 5], [4, 5], scale=0.4)[0][0]


def test_swapped_forces_and_moments_are_told() -> None:
    """Where the nominal matrix reads the moment in place of the force."""
    specimen = simulate_specimen(thesis_loads(), PLACEMENT, np.random.default_rng(6), with_prior=True)
    bench = specimen.bench
    assert bench.prior is not None
    swapped = np.roll(bench.prior, 3, axis=0)
    blocks = [_block(bench.raw[0], "1", rng=np.random.default_rng(1))]
    biases = [_block(np.zeros(6), BIAS, rng=np.random.default_rng(2))]
    loads = replace(bench.loads)
    assert block_findings(blocks, biases, loads, bench.prior) == [()]
    assert "forces and moments were swapped" in block_findings(blocks, biases, loads, swapped)[0][0]
