# SPDX-License-Identifier: BSD-3-Clause
"""The one form of every result, and how it is shown: terminal, JSON, CSV, notebook, figures, documents."""
