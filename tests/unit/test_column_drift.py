# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Drift at the columns: the sentence and the verdict that follow from it. Needs no YADE."""
from summaries import sample_summary
from timber_houses.recording.verdict import REPAIRABLE, UNSAFE, Structure
from timber_houses.text import english, lines


def test_sentence_and_lines_state_torsion():
    """1/85 at the centre, 1/12 at a column."""
    drifts = {"peak_drift": {"storey1": {"ns": 1 / 85, "ew": 0.0}},
              "column_drift": {"largest": {"storey1": {"ns": 1 / 12, "ew": 0.0}},
                               "median": {"storey1": {"ns": 1 / 80, "ew": 0.0}}}}
    summary = sample_summary(**drifts)
    assert ("peak storey drift 1/85 N-S in storey 1, beyond the damage limit of 1/120, 1/12 N-S at a column (median"
            " 1/80), beyond the safety limit") in english.sentence(summary)
    assert ("Largest storey drift 1/85 N-S in storey 1 of the centre, 1/12 N-S at a column (median 1/80)"
            in lines.drifts(summary))
    drifts["column_drift"]["largest"]["storey1"]["ns"] = 1 / 84
    assert "column" not in english.sentence(sample_summary(**drifts))


def test_verdict_takes_the_drift_at_the_columns():
    assert Structure(peak_drift=1 / 85, column_drift=1 / 12).verdict == UNSAFE
    assert Structure(peak_drift=1 / 150, column_drift=1 / 100).verdict == REPAIRABLE
