# SPDX-License-Identifier: BSD-3-Clause
"""The compiled evaluator: the question as arrays, and one pass over a block of samples that answers it."""
