# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of the benchmarks and of their pages. Needs no YADE."""


def markdown_table(heads, rows):
    """Rows of cells as a Markdown table, without a line's end."""
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in rows]
    return "\n".join(["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|", *lines])
