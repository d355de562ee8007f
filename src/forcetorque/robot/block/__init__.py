# SPDX-License-Identifier: BSD-3-Clause
"""Newton-Euler passes in compiled code, over blocks of samples.

A block is LANES samples. Every number of a body is a row of a scratch array with one lane per
sample, so each loop over lanes does the same arithmetic on neighbouring numbers and becomes vector
instructions. The functions here are compiled into the evaluator that calls them.
"""
