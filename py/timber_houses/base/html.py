# SPDX-License-Identifier: GPL-2.0-or-later
"""HTML pages from the templates in data; values are escaped unless the template marks them as safe."""
import base64
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

DATA = Path(__file__).resolve().parents[1] / "data"


@cache
def _environment():
    return Environment(loader=FileSystemLoader(DATA), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
                       lstrip_blocks=True, keep_trailing_newline=True)


def html(template, **values):
    """Text of a page. template: its path below data; values: those that it names"""
    return _environment().get_template(template).render(values)


def embedded(content, kind):
    """The address of an image for a page without other files. content: of its file; kind: 'png', 'jpeg'"""
    return f"data:image/{kind};base64,{base64.b64encode(content).decode()}"
