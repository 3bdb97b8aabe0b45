# SPDX-License-Identifier: GPL-2.0-or-later
"""Text of CSV files. Needs no YADE."""
import csv
import io


def csv_text(header, rows):
    """Text of a CSV file: floats with 12 significant digits, zero without a sign; other values as they are."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([f"{value + 0.0:.12g}" if isinstance(value, float) else value for value in row] for row in rows)
    return text.getvalue()
