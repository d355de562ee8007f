# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of samples: whether the load is at rest, and whether the block is of its position."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.experiment.workbench_file import BIAS
from forcetorque.workbench.position_means import Block, block_findings
from forcetorque.workbench.simulated_benches import simulate_bench
from tests.scenes.benches import PLACEMENT, thesis_loads

FULL_SCALE = np.full(6, 32767.0)


def _block(
    mean: FloatArray, position: str = "1", *, rng: np.random.Generator | None = None, bias: Block | None = None
) -> Block:
    noise = np.zeros((100, 6)) if rng is None else rng.standard_normal((100, 6))
    return Block.of(position, mean + noise, FULL_SCALE, source=f"output{position}.dat", bias=bias)


def test_a_block_at_rest_is_its_mean() -> None:
    """With the standard error of white noise, and without findings."""
    block = _block(np.arange(6.0), rng=np.random.default_rng(1))
    np.testing.assert_allclose(block.mean, np.arange(6.0), atol=0.5)
    assert block.standard_error == pytest.approx(0.1, rel=0.5)
    assert (block.moved, block.saturated, block.frozen) == (False, False, False)


def test_invalid_samples_are_detected() -> None:
    """A load that is put down within the block, a channel at its limit, a frozen log, a gap."""
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
    """Findings of positions that are recorded in one order and named in another."""
    simulated = simulate_bench(thesis_loads(), PLACEMENT, np.random.default_rng(6), with_prior=True)
    bench, rng = simulated.bench, np.random.default_rng(7)
    bias = _block(np.zeros(6), BIAS, rng=np.random.default_rng(8))
    blocks = [
        _block(scale * bench.raw[k], bench.loads.names[n], rng=rng, bias=bias)
        for k, n in zip(order, named, strict=True)
    ]
    return block_findings(blocks, bench.loads, bench.prior)


def test_valid_blocks_have_no_findings() -> None:
    """All 24 of most sensors: their sensitivity differs by a tenth."""
    assert not any(_findings(list(range(24)), list(range(24))))


def test_a_block_of_another_position_is_detected() -> None:
    """The position that it matches; a load that was not moved; a reversed sign."""
    taken_for = _findings([0, 8], [0, 3])
    assert taken_for[0] == ()
    assert "matches position 9" in taken_for[1][0]
    assert "equals that of position 1 before it" in _findings([0, 0], [0, 1])[1][0]
    assert "sign is reversed" in _findings([0, 1], [0, 1], scale=-1.2)[1][0]
    assert "0.4" in _findings([4, 5], [4, 5], scale=0.4)[0][0]


def test_permuted_forces_and_moments_are_detected() -> None:
    """Where the nominal matrix measures the moment in place of the force."""
    simulated = simulate_bench(thesis_loads(), PLACEMENT, np.random.default_rng(6), with_prior=True)
    bench = simulated.bench
    assert bench.prior is not None
    permuted = np.roll(bench.prior, 3, axis=0)
    bias = _block(np.zeros(6), BIAS, rng=np.random.default_rng(2))
    blocks = [_block(bench.raw[0], "1", rng=np.random.default_rng(1), bias=bias)]
    assert block_findings(blocks, bench.loads, bench.prior) == [()]
    assert "forces and moments are permuted" in block_findings(blocks, bench.loads, permuted)[0][0]


def test_a_bias_that_is_not_valid_is_reported_with_its_position() -> None:
    """Its message is marked as that of the bias; the block itself is valid."""
    bench = simulate_bench(thesis_loads(), PLACEMENT, np.random.default_rng(6), with_prior=True).bench
    block = _block(bench.raw[0], "1", rng=np.random.default_rng(1), bias=_block(np.zeros(6), BIAS))
    assert block_findings([block], bench.loads, bench.prior) == [
        ("bias: no channel changes at all: is the log frozen?",)
    ]
