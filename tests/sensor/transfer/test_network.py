# SPDX-License-Identifier: BSD-3-Clause
"""A network with one hidden layer: what it learns, what it keeps, and how it fails."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from forcetorque.base.errors import FitError, MissingExtraError
from forcetorque.sensor.transfer.parametric import fit_linear
from forcetorque.sensor.transfer.sections_and_network import Network, fit_network
from forcetorque.sensor.transfer.static_curves import compare

STIMULUS = np.linspace(0.0, 50.0, 60)
OUTPUT = 240.0 - 100.0 * np.sqrt(STIMULUS / 50.0 + 0.05)


def test_output_by_hand() -> None:
    """Two neurons: 2 tanh(0.5 s + 0.1) - 3 tanh(-s) + 4 at s = 1."""
    model = Network(
        lowest=0.0,
        highest=2.0,
        weights=np.array([0.5, -1.0]),
        biases=np.array([0.1, 0.0]),
        output_weights=np.array([2.0, -3.0]),
        output_bias=4.0,
    )
    assert model.predict(1.0) == pytest.approx(2 * np.tanh(0.6) + 3 * np.tanh(1.0) + 4)


def test_a_network_learns_a_curve_and_inverts_it() -> None:
    """Four neurons follow a root to a hundredth of its span, where a line is off by a tenth; the inverse undoes it."""
    model = fit_network(STIMULUS, OUTPUT)
    span = float(np.ptp(OUTPUT))
    assert np.abs(model.predict(STIMULUS) - OUTPUT).max() < 0.01 * span
    assert np.abs(fit_linear(STIMULUS, OUTPUT).predict(STIMULUS) - OUTPUT).max() > 0.1 * span
    np.testing.assert_allclose(model.inverse(model.predict(STIMULUS)), STIMULUS, rtol=0, atol=1e-9)


def test_the_seed_decides() -> None:
    """The same seed gives the same network, in other units too; another seed gives another."""
    once, again, other = (fit_network(STIMULUS, OUTPUT, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(once.weights, again.weights)
    assert np.abs(once.weights - other.weights).max() > 1e-6
    # scaling rounds, and training multiplies what rounding did: compare curves, to a thousandth of the span
    scaled = fit_network(1e3 * STIMULUS, 1e-3 * OUTPUT, seed=1)
    difference = 1e3 * scaled.predict(1e3 * STIMULUS) - once.predict(STIMULUS)
    assert np.abs(difference).max() < 1e-2 * np.ptp(OUTPUT)


def test_points_that_teach_nothing_are_refused() -> None:
    """Fewer stimuli than parameters, an output that never changes, no neurons."""
    with pytest.raises(FitError, match="10 different stimuli do not determine 13 parameters"):
        fit_network(STIMULUS[:10], OUTPUT[:10])
    with pytest.raises(FitError, match="nothing to learn"):
        fit_network(STIMULUS, np.full(60, 3.0))
    with pytest.raises(FitError, match="at least 1 neuron"):
        fit_network(STIMULUS, OUTPUT, neurons=0)


def test_without_the_extra_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """A missing scikit-learn is an error that names the extra, and one failed kind in a comparison."""
    for name in ("sklearn", "sklearn.exceptions", "sklearn.neural_network"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MissingExtraError, match=r"pip install 'forcetorque\[network\]'"):
        fit_network(STIMULUS, OUTPUT)
    scores, failures = compare(STIMULUS, OUTPUT, fitters={"line": fit_linear, "network": fit_network})
    assert [score.name for score in scores] == ["line"]
    assert list(failures) == ["network"]
    assert "forcetorque[network]" in failures["network"]


def test_importing_transfer_functions_does_not_import_scikit_learn() -> None:
    """A bare install can use every other kind."""
    code = "import sys, forcetorque.sensor.transfer; assert 'sklearn' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
