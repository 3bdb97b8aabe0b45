# SPDX-License-Identifier: GPL-2.0-or-later
"""HTML pages from the templates in data; values are escaped unless the template marks them as safe."""
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

DATA = Path(__file__).resolve().parents[1] / "data"
ENVIRONMENT = Environment(loader=FileSystemLoader(DATA), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
                          lstrip_blocks=True, keep_trailing_newline=True)


def html(template, **values):
    """Text of a page. template: its path below data; values: those that it names"""
    return ENVIRONMENT.get_template(template).render(values)
