# SPDX-License-Identifier: BSD-3-Clause
"""The whole way from logs to sensors that can be used, stage by stage."""
