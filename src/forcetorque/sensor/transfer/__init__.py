# SPDX-License-Identifier: BSD-3-Clause
"""Transfer functions of one channel: fit, predict, inverse, and which kind to take (thesis 3.1)."""

from forcetorque.sensor.transfer.compare import FITTERS, Comparison, Failure, Fitter, Score, compare
from forcetorque.sensor.transfer.exponential import Exponential, fit_exponential
from forcetorque.sensor.transfer.linear import Linear, fit_linear
from forcetorque.sensor.transfer.logarithmic import Logarithmic, fit_logarithmic
from forcetorque.sensor.transfer.network import Network, fit_network
from forcetorque.sensor.transfer.piecewise_linear import PiecewiseLinear, fit_piecewise_linear
from forcetorque.sensor.transfer.polynomial import Polynomial, fit_polynomial
from forcetorque.sensor.transfer.power import Power, fit_power
from forcetorque.sensor.transfer.spline import Spline, fit_spline
from forcetorque.sensor.transfer.transfer_function import TransferFunction

__all__ = [
    "FITTERS",
    "Comparison",
    "Exponential",
    "Failure",
    "Fitter",
    "Linear",
    "Logarithmic",
    "Network",
    "PiecewiseLinear",
    "Polynomial",
    "Power",
    "Score",
    "Spline",
    "TransferFunction",
    "compare",
    "fit_exponential",
    "fit_linear",
    "fit_logarithmic",
    "fit_network",
    "fit_piecewise_linear",
    "fit_polynomial",
    "fit_power",
    "fit_spline",
]
