# SPDX-License-Identifier: BSD-3-Clause
"""The compiled evaluator: Newton-Euler passes and estimation over blocks of samples.

A block is LANES samples. Every number of a body is a row of a scratch array with one lane per
sample, so each loop over lanes does the same arithmetic on neighbouring numbers and becomes vector
instructions. `plan` turns what is estimated into arrays, `recursion` and `stages` are compiled into the one function
that `run` calls.
"""
