# SPDX-License-Identifier: BSD-3-Clause
"""Run a notebook as Jupyter does, cell by cell in one namespace, and keep what each cell prints and shows."""

from __future__ import annotations

import ast
import base64
import io
from contextlib import redirect_stdout
from typing import Any

from PIL import Image

_COLOURS = 32


def run_notebook(notebook: dict[str, Any], name: str) -> dict[str, Any]:
    """Run the code cells of a notebook, and put their outputs into it.

    Args:
        notebook: Its content; changed.
        name: What tracebacks call it.

    Returns:
        The names that the cells defined.
    """
    names: dict[str, Any] = {}
    code_cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    for number, cell in enumerate(code_cells, start=1):
        body = ast.parse("".join(cell["source"]))
        last = body.body.pop() if isinstance(body.body[-1], ast.Expr) else None
        text, value = io.StringIO(), None
        with redirect_stdout(text):
            exec(compile(body, name, "exec"), names)
            if isinstance(last, ast.Expr):
                value = eval(compile(ast.Expression(last.value), name, "eval"), names)
        cell["execution_count"], cell["outputs"] = number, []
        if text.getvalue():
            cell["outputs"].append({"name": "stdout", "output_type": "stream", "text": _lines(text.getvalue())})
        if value is not None:
            cell["outputs"].append(
                {"data": _shown(value), "execution_count": number, "metadata": {}, "output_type": "execute_result"}
            )
    return names


def texts(notebook: dict[str, Any]) -> list[str]:
    """What the cells of a notebook print and show as text, cell by cell."""
    outputs = [output for cell in notebook["cells"] for output in cell.get("outputs", [])]
    return ["".join(output["text"] if "text" in output else output["data"]["text/plain"]) for output in outputs]


def _shown(value: Any) -> dict[str, Any]:
    """A value as text, as HTML and as a picture, as far as it has them."""
    data: dict[str, Any] = {"text/plain": _lines(repr(value))}
    if html := getattr(value, "_repr_html_", lambda: None)():
        data = {"text/html": _lines(html), **data}
    if hasattr(value, "_repr_png_"):
        data = {"image/png": base64.b64encode(_small(value._repr_png_())).decode() + "\n", **data}
    return data


def _small(png: bytes) -> bytes:
    """A picture of half the size and few colours, a tenth of the bytes."""
    picture, content = Image.open(io.BytesIO(png)).convert("RGB"), io.BytesIO()
    picture.resize((picture.width // 2, picture.height // 2)).quantize(_COLOURS).save(content, "png", optimize=True)
    return content.getvalue()


def _lines(text: str) -> list[str]:
    return text.splitlines(keepends=True)
