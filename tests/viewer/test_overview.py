# SPDX-License-Identifier: BSD-3-Clause
"""Overviews hold the extremes and sums of the samples themselves."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.viewer import packing as overview
from forcetorque.viewer.packing import packed, with_overviews
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene

BLOCK = 50


@pytest.fixture
def seen(built: BuiltScene, monkeypatch: pytest.MonkeyPatch) -> BuiltScene:
    """A short log with overviews."""
    monkeypatch.setattr(overview, "FEWEST_SAMPLES", 1)
    monkeypatch.setattr(overview, "BLOCK", BLOCK)
    monkeypatch.setattr(overview, "MOST_POINTS", 100)
    return with_overviews(built)


def _eight(wrench: FloatArray) -> FloatArray:
    force, moment = wrench[:, :3], wrench[:, 3:]
    return np.column_stack([force, np.linalg.norm(force, axis=1), moment, np.linalg.norm(moment, axis=1)])


def test_overviews_are_what_the_samples_of_each_block_give(seen: BuiltScene) -> None:
    """Block by block in plain loops; samples of ignored intervals, and absent ones, have no error."""
    scene, block = seen.scene, seen.block
    time_s = read_array(block, scene.time_s)
    ignored = np.zeros(len(time_s), dtype=bool)
    for interval in scene.intervals:
        if interval.use == "ignore":
            ignored |= (time_s >= interval.start_s) & (time_s < interval.end_s)
    compared = with_absent = 0
    for sensor in scene.sensors:
        expected = read_array(block, sensor.wrenches[0].values).astype(float)
        assert sensor.wrenches[0].role == "expected"
        for series in sensor.wrenches:
            known = series.overview
            assert known is not None
            values = read_array(block, series.values).astype(float)
            np.testing.assert_array_equal(read_array(block, known.points), values[:: known.every].astype(np.float32))
            error = _eight(values - expected)
            error[ignored] = np.nan
            tables = [(known.wrench, _eight(values), 2), (known.error, error, 5)]
            for reference, samples, parts in tables:
                if reference is None:
                    assert series.role == "expected"
                    continue
                table = read_array(block, reference)
                assert table.shape == (len(samples) // BLOCK, 8 * parts)
                for k, row in enumerate(table):
                    for column in range(8):
                        inside = samples[k * BLOCK : (k + 1) * BLOCK, column]
                        inside = inside[np.isfinite(inside)]
                        with_absent += 0 < len(inside) < BLOCK
                        low, high, *sums = row[column::8]
                        compared += 1
                        if parts == 5:
                            wanted = [inside.sum(), (inside**2).sum(), len(inside)]
                            np.testing.assert_allclose(sums, wanted, rtol=1e-5, atol=1e-5)
                        if len(inside):
                            np.testing.assert_allclose([low, high], [inside.min(), inside.max()], rtol=1e-5, atol=1e-5)
                        else:
                            assert np.isnan([low, high]).all()
    assert compared > 100
    assert with_absent > 0


def test_a_short_log_has_no_overview(built: BuiltScene) -> None:
    """Its samples are unpacked as quickly."""
    assert with_overviews(built) is built
    assert all(series.overview is None for sensor in packed(built).scene.sensors for series in sensor.wrenches)


def test_a_page_keeps_overviews_and_packs_their_points(seen: BuiltScene, built: BuiltScene) -> None:
    """What sums are made of is not rounded; points are."""
    series = packed(built).scene.sensors[0].wrenches[0]
    assert series.overview is not None
    assert series.overview.points.packed_bytes is not None
    assert series.overview.wrench.packed_bytes is None
    assert seen.scene.sensors[0].wrenches[0].overview is not None
