# SPDX-License-Identifier: GPL-2.0-or-later
"""Screening of the paper's open choices: a designed set of house variants (cells), each run under several motions.
Needs no YADE.

    cells.py      design -> house files and the rows of a batch table
    responses.py  summaries of a cell under a motion -> numbers
    effects.py    numbers of all cells -> effects of factors and interactions, with standard errors
    report.py     tables
    picture.py    effects as a picture
"""
