# SPDX-License-Identifier: BSD-3-Clause
"""XML files from anywhere: parsed without entities, with the line of what is wrong."""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element, ParseError

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import parse

from forcetorque.base.errors import FormatError
from forcetorque.base.run_files import declare_input


def read_xml(file: Path) -> Element | None:
    """Parse an XML file that exists.

    Args:
        file: The file.

    Returns:
        Its root element.

    Raises:
        FormatError: If it is not XML, or uses entities or external files.
    """
    declare_input(file)
    try:
        root: Element | None = parse(file).getroot()
    except ParseError as error:
        raise FormatError(f"{file}:{error.position[0]}: expected XML, got {error.msg}") from error
    except (DefusedXmlException, ValueError, LookupError) as error:
        raise FormatError(f"{file}: expected plain XML, got {error!r}") from error
    return root
