# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of a screening: cells, main effects, interactions."""
import math

from timber_houses.base.atomic_write import write_text
from timber_houses.base.table import csv_text
from timber_houses.text.english import counted

from .. import design
from ..claims import CLAIMS
from ..factors import FACTORS
from ..report import markdown_table
from .cells import cell_name
from .effects import EMPTY, INTERACTION, MAIN, SIGNIFICANT, expected_by_chance
from .responses import COUNT, LOG, RESPONSES, SHARE

CELL_COLUMNS = ("falls_A", "falls_B", "falls_C", "falls_B1", "falls_B2", "falls_C1", "falls_C2", "drift_A", "drift_B",
                "drift_C", "across_B1", "across_B2", "C_over_B", "C1_over_B1", "C2_over_B2", "column_beam_west_B1",
                "brace_beam_west_B1", "claims")
"""Responses in the table of cells."""
MOST_INTERACTIONS = 3
"""Interactions of a response in its table."""


def write(results, folder):
    """Write screening.csv, effects.csv, screening.md to a folder; returns their paths. Raises OSError."""
    found = {name: results.effects(name) for name in RESPONSES}
    contents = {"screening.csv": cells_csv(results), "effects.csv": effects_csv(found),
                "screening.md": markdown(results, found)}
    for name, text in contents.items():
        write_text(folder / name, text)
    return [folder / name for name in contents]


# --- CSV --------------------------------------------------------------------------------------------------------------


def cells_csv(results):
    """One row a cell: levels of the factors, then responses over the motions; logarithms stay logarithms. Empty: a run
    is missing.
    """
    typical = {name: results.typical(name) for name in RESPONSES}
    rows = [
        (cell_name(cell), len(results.motions), *(factor.level(sign).description for factor, sign in zip(FACTORS,
                                                                                                         signs)),
         *(blank(values[k]) for values in typical.values()))
        for k, (cell, signs) in enumerate(zip(results.cells, results.signs))
    ]
    return csv_text(("cell", "motions", *(factor.name for factor in FACTORS), *RESPONSES), rows)


def effects_csv(found):
    rows = [(name, RESPONSES[name].kind, e.kind, label(e), e.value, blank(e.error), blank(e.chance), int(e.stands_out))
            for name, effects in found.items() for e in effects]
    return csv_text(
        ("response", "unit", "kind", "effect_of", "effect", "error_by_motions", "error_by_empty_columns", "stands_out"),
        rows,
    )


def blank(value):
    return None if math.isnan(value) else float(value)


def label(effect, name=lambda k: FACTORS[k].name):
    """Factor, aliased interactions ('a x b = c x d'), or empty column of an effect. name: function of a factor's
    number.
    """
    if effect.kind == MAIN:
        return name(effect.factors[0])
    return " = ".join(f"{name(i)} x {name(j)}" for i, j in effect.factors) or f"no factor ({effect.word})"


# --- Markdown ---------------------------------------------------------------------------------------------------------


def markdown(results, found):
    claims = {name: effects for name, effects in found.items() if name in CLAIMS}
    others = {name: effects for name, effects in found.items() if name not in CLAIMS}
    parts = [head(results, found), factor_table(), cell_table(results), main_table("Main effects", others),
             main_table("Main effects on the shares of motions in which the claims hold", claims),
             interaction_table(others)]
    return "\n\n".join("\n".join(part) for part in parts if part) + "\n"


EXPLANATION = """\
Shares are means, other responses medians over the motions. An effect is the mean of the cells with the second level of
a factor minus that
with the first; x 2: twice as large; pp: percentage points of the motions."""
SCATTER = "In brackets its standard error from the scatter of the motions (bootstrap)."
ONE_MOTION = "One motion has no scatter: effects have no standard errors, and none is tested."
NO_FACTOR = """\
'No factor': root mean square of the effects of columns without a factor,
that is of chance and of interactions of three factors."""
NO_COLUMN = "These cells leave no column without a factor, by which to estimate chance (–)."


def head(results, found):
    effects = [effect for some in found.values() for effect in some]
    motions = f"{counted(len(results.motions), 'motion')}: {', '.join(results.motions)}"
    lines = [f"{len(results.cells)} of {design.RUNS} cells under {motions}.", "", EXPLANATION,
             SCATTER if len(results.motions) > 1 else ONE_MOTION]
    if effects:
        lines += ["", *significance(effects)]
    if len(results.cells) < design.RUNS:
        lines += ["", "The design is not complete: main effects are confounded with two-factor interactions."]
    return lines


def significance(effects):
    """Lines on what bold means, and on how many effects are bold by chance. effects: of all responses"""
    has_empty = any(effect.kind == EMPTY for effect in effects)
    if not any(effect.is_tested for effect in effects):
        return [NO_FACTOR if has_empty else NO_COLUMN]
    tested, bold = sum(effect.is_tested for effect in effects), sum(effect.stands_out for effect in effects)
    both = " of both kinds" if has_empty else ""
    return [f"{NO_FACTOR if has_empty else NO_COLUMN} **Bold**: beyond {SIGNIFICANT:g} standard errors{both}.",
            f"{bold} of the {tested} effects tested are beyond that. Without any true effect, normally distributed "
            f"errors would put some "
            f"{expected_by_chance(tested):.0f} there: a single bold number is no finding."]


def factor_table():
    rows = [(k, factor.name, *(level.description for level in factor.levels)) for k, factor in enumerate(FACTORS, 1)]
    return ["## Factors", "", *markdown_table(("", "factor", "first level (-)", "second level (+)"), rows)]


def cell_table(results):
    typical = {name: results.typical(name) for name in CELL_COLUMNS}
    rows = [(cell_name(cell), sign_text(signs), *(value_text(name, values[k]) for name, values in typical.items()))
            for k, (cell, signs) in enumerate(zip(results.cells, results.signs))]
    return ["## Cells", "", f"Levels of the factors 1 to {len(FACTORS)} in this order.", "",
            *markdown_table(("cell", "levels", *(RESPONSES[name].title for name in CELL_COLUMNS)), rows)]


def sign_text(signs):
    """'--+ +-...' in groups of three."""
    text = "".join("+" if sign > 0 else "-" for sign in signs)
    return "`" + " ".join(text[k:k + 3] for k in range(0, len(text), 3)) + "`"


def main_table(title, found):
    rows = []
    for name, effects in found.items():
        mains, kind = [effect for effect in effects if effect.kind == MAIN], RESPONSES[name].kind
        rows += ([(RESPONSES[name].title, *(effect_text(kind, e) for e in mains), size_text(kind, mains[0].chance))]
                 if mains else [])
    if not rows:
        return [f"## {title}", "", "The cells do not determine them yet."]
    return [
        f"## {title}",
        "",
        *markdown_table(("response", *(f"{k} {factor.title}" for k, factor in enumerate(FACTORS, 1)), "no factor"),
                        rows),
    ]


def interaction_table(found):
    """The most significant interactions of each response, with their aliases."""
    rows = []
    for name, effects in found.items():
        strong = sorted((e for e in effects if e.kind == INTERACTION and e.stands_out),
                        key=lambda e: -abs(e.significance))
        rows += [(RESPONSES[name].title, effect_text(RESPONSES[name].kind, e).replace("*", ""), label(e))
                 for e in strong[:MOST_INTERACTIONS]]
    if not rows:
        return []
    return ["## Interactions beyond two standard errors", "",
            f"The {MOST_INTERACTIONS} most significant ones of each response. "
            "Interactions in a row are confounded with one another: the sum of their effects is seen.", "",
            *markdown_table(("response", "effect", "interactions"), rows)]


# --- numbers as text --------------------------------------------------------------------------------------------------


def value_text(name, value):
    """Value of a response: drifts as 1/10, ratios as factors, shares in per cent."""
    kind = RESPONSES[name].kind
    if math.isnan(value):
        return ""
    if kind == LOG and name.startswith("drift"):
        return "falls" if value >= 0 else f"1/{10 ** -value:.0f}" if value < -0.7 else f"{10 ** value:.2f}"
    return {LOG: f"{10 ** value:.2g}", SHARE: f"{100 * value:.0f} %", COUNT: f"{value:g}"}[kind]


def effect_text(kind, effect):
    """'x 1.5 (1.2)' for a factor and that of its standard error, '+40 pp (10)' for shares, '+0.40 (0.10)' for counts;
    bold when it stands out.
    """
    sign = "" if kind == LOG or effect.value < 0 else "+"
    error = ("" if math.isnan(effect.error)
             else f" ({size_text(kind, effect.error).removeprefix('x ').removesuffix(' pp')})")
    text = f"{sign}{size_text(kind, effect.value)}{error}"
    return f"**{text}**" if effect.stands_out else text


def size_text(kind, value):
    """'x 1.50' for a logarithm, '40 pp' for a difference of shares, '0.40' for counts; a dash for NaN."""
    if math.isnan(value):
        return "–"
    return {LOG: f"x {10 ** value:.2f}", SHARE: f"{round(100 * value)} pp", COUNT: f"{value:.2f}"}[kind]
