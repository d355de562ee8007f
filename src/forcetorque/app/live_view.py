# SPDX-License-Identifier: BSD-3-Clause
"""`live --view`: the viewer follows the samples while they come."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial, update_wrapper
from inspect import Parameter, signature
from pathlib import Path
from typing import Annotated, Any, Final, get_type_hints

import typer

from forcetorque.base.errors import ForceTorqueError

COMMAND: Final = "live"
_WINDOW_S: Final = 30.0


def with_live_view(name: str, command: Callable[..., Any]) -> Callable[..., Any]:
    """Let `live` show what it does in the browser.

    Args:
        name: Name of the command.
        command: The command, which takes as `page` what serves a run.

    Returns:
        The command with the options of the page if it is `live`, else as it is.
    """
    if name != COMMAND:
        return command

    def run(
        view: Annotated[
            bool, typer.Option("--view", help="Show it in the browser, on a page of this machine.")
        ] = False,
        view_s: Annotated[
            float | None, typer.Option("--view-s", help="Time that the page shows, s. Default: 30.")
        ] = None,
        port: Annotated[
            int | None, typer.Option("--port", help="Port of 127.0.0.1 for the page. Default: any that is free.")
        ] = None,
        no_browser: Annotated[bool, typer.Option("--no-browser", help="Print its address and open nothing.")] = False,
        mesh_dir: Annotated[
            list[Path] | None, typer.Option("--mesh-dir", help="Folder that holds the packages of meshes.")
        ] = None,
        **given: Any,
    ) -> Any:
        stated = {"--view-s": view_s, "--port": port, "--no-browser": no_browser or None, "--mesh-dir": mesh_dir}
        useless = [option for option, value in stated.items() if value is not None]
        if view:
            from forcetorque.viewer.live_page import live_page

            given["page"] = partial(
                live_page,
                window_s=_WINDOW_S if view_s is None else view_s,
                port=port or 0,
                mesh_folders=mesh_dir or (),
                opened=partial(_show_address, open_browser=not no_browser),
            )
        elif useless:
            raise ForceTorqueError(f"{useless[0]} is of the page that --view shows; expected --view too, got none")
        return command(**given)

    typed = [one for one in _typed_parameters(command) if one.name != "page"]
    typed += [one for one in _typed_parameters(run) if one.kind is not Parameter.VAR_KEYWORD]
    update_wrapper(run, command)
    run.__signature__ = signature(command).replace(parameters=typed)  # type: ignore[attr-defined]
    run.__annotations__ = {one.name: one.annotation for one in typed}
    return run


def _typed_parameters(function: Callable[..., Any]) -> list[Parameter]:
    hints = get_type_hints(function, include_extras=True)
    return [one.replace(annotation=hints[one.name]) for one in signature(function).parameters.values()]


def _show_address(url: str, *, open_browser: bool) -> None:
    from forcetorque.results.terminal.output import start_logging
    from forcetorque.viewer.page import open_in_browser

    log = start_logging()
    log.info("page: %s", url)
    if open_browser and not open_in_browser(url):
        log.warning("no browser could be opened; open the address yourself")
