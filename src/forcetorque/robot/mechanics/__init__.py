# SPDX-License-Identifier: BSD-3-Clause
"""What mechanics demands of sensors, contacts and joints: one question, a readable and a compiled evaluator."""
