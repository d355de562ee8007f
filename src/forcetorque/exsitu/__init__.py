# SPDX-License-Identifier: BSD-3-Clause
"""The workbench: known loads, what a sensor reads of them, the fit, its held-out errors, and the bench's faults."""

from forcetorque.exsitu.bench import Bench, Placement
from forcetorque.exsitu.block import BIAS, Block
from forcetorque.exsitu.faults import Fault, Signatures, signatures
from forcetorque.exsitu.fit import SESSION, BenchFit, fit_bench
from forcetorque.exsitu.guide import block_findings
from forcetorque.exsitu.held_out import FOLDS, SHUFFLES, held_out_errors, in_folds, one_by_one, rms, whole_series
from forcetorque.exsitu.load_table import THESIS_TABLE, read_loads
from forcetorque.exsitu.loads import BenchLoads, Weights
from forcetorque.exsitu.reading_matrix import reading_matrix
from forcetorque.exsitu.residual import ResidualSpace
from forcetorque.exsitu.scatter import LEAST_SENSORS, Scatter, own_scatter, scatter_of_sensors, stated_scatter
from forcetorque.exsitu.span import MissingMoment, Span
from forcetorque.exsitu.specimens import BenchFaults, Specimen, simulate_specimen
from forcetorque.exsitu.suspects import FALSE_ALARMS, Suspect, plainest, suspects
from forcetorque.exsitu.uncertain_loads import MatrixError, UncertainLoads

__all__ = [
    "BIAS",
    "FALSE_ALARMS",
    "FOLDS",
    "LEAST_SENSORS",
    "SESSION",
    "SHUFFLES",
    "THESIS_TABLE",
    "Bench",
    "BenchFaults",
    "BenchFit",
    "BenchLoads",
    "Block",
    "Fault",
    "MatrixError",
    "MissingMoment",
    "Placement",
    "ResidualSpace",
    "Scatter",
    "Signatures",
    "Span",
    "Specimen",
    "Suspect",
    "UncertainLoads",
    "Weights",
    "block_findings",
    "fit_bench",
    "held_out_errors",
    "in_folds",
    "one_by_one",
    "own_scatter",
    "plainest",
    "read_loads",
    "reading_matrix",
    "rms",
    "scatter_of_sensors",
    "signatures",
    "simulate_specimen",
    "stated_scatter",
    "suspects",
    "whole_series",
]
