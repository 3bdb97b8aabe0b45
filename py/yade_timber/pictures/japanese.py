# SPDX-License-Identifier: GPL-2.0-or-later
"""Texts of the player in Japanese: title, result and events of a run. Numbers and names are the same as in English. Needs no YADE."""
import re

from ..recording import verdict
from ..recording.sentences import SMALL, fall_time, first_time, joints_and_sheets, largest_drift, main_structure, missed_onset, ratio

DIRECTIONS = {"ns": "南北", "ew": "東西"}
SIDES = {"north": "北", "south": "南", "east": "東", "west": "西"}
STRUCTURES = {"entrance": "玄関"}
ORIGIN = {"No ground motion": "地動なし", "Ground motion": "地動", "Record ": "記録 ", "JMA intensity": "計測震度", "time step": "時間刻み"}
OUTCOMES = {"undamaged": "無被害", "repairable": "補修可能", "unsafe": "危険", "collapsed": "倒壊", "failed": "計算失敗"}
LEVELS = {"1/120": "層間変形角が 1/120 を超える（損傷の始まり）", "1/30": "層間変形角が 1/30 を超える（大きな損傷）"}
SHAKING = {"the shaking begins": "揺れの始まり", "strongest shaking": "最大の揺れ"}


def title(found):
    """'住宅 C2：地震、積雪 5.6 t' of a summary."""
    loads = ["地震"] * bool(found.get("earthquake")) + [f"積雪 {found['snow_mass_kg'] / 1000:.1f} t" if found["snow"] else ""]
    loads = list(filter(None, loads))
    return f"住宅 {found['model']}：{'、'.join(loads) or '自重のみ'}"


def result(found):
    """Outcome of a summary: place in an ensemble, verdict, peak and residual drift, other structures, joints, columns, snow."""
    parts = [outcome(found), moving(found), *structures(found), joints(found), columns(found), snow(found), early(found)]
    return ensemble(found) + "。".join(filter(None, parts)) + "。"


def moving(found):
    """Amplitude of the motion that remains; empty at rest."""
    if not found.get("still_moving") or found["collapsed"]:
        return ""
    amplitude, _, direction = largest_drift(found, "final_amplitude")
    return f"なお ±{below(amplitude)}（{DIRECTIONS.get(direction, direction)}）で揺れている"


def joints(found):
    """Broken and partly broken joints and wall sheets."""
    (broken, total), (torn, sheets) = joints_and_sheets(found)
    walls = f"、壁面 {sheets} 面のうち {torn} 面" if sheets else ""
    partly = found["broken"].get("partly_broken", 0) + found["broken"].get("wall_sheets_partly", 0)
    before = found["broken"].get("damaged_at_start", {}).get("total", 0)
    more = [f"一部破断 {partly} か所" if partly else "", f"最初から破断 {before} か所" if before else ""]
    others = "、".join(filter(None, more))
    return f"接合部 {total} か所のうち {broken} か所{walls}が破断" + (f"（ほかに{others}）" if others else "")


def columns(found):
    """Fallen and loose columns, and the time of the first loss; empty without."""
    counts, first = found.get("columns", {}), first_time(found, "columns_lost")
    lost = [f"{counts[kind]} 本が{text}" for kind, text in (("fallen", "倒れた"), ("loose", "外れた")) if counts.get(kind)]
    since = "" if first is None else f"（{first:.1f} 秒から）"
    return f"柱 {counts['total']} 本のうち{'、'.join(lost)}{since}" if lost else ""


def snow(found):
    """Time from which snow has fallen from the roofs; empty without."""
    first = first_time(found, "snow_fallen") if found["snow"] else None
    return "" if first is None else f"雪は {first:.1f} 秒から落下"


def early(found):
    """Remark on a run that ends before the strong shaking; empty for others."""
    onset = missed_onset(found)
    return "" if onset is None else f"強い揺れ（{onset:.1f} 秒）の前で計算を終了"


def ensemble(found):
    """'16 回の計算の 7 番目（危険 12 回、倒壊 4 回）。' of a run that is shown for an ensemble, else empty."""
    known = found.get("ensemble")
    outcomes = "、".join(f"{OUTCOMES.get(state, state)} {number} 回" for state, number in known["outcomes"].items()) if known else ""
    return f"{known['runs']} 回の計算の {known['run']} 番目（{outcomes}）。" if known else ""


def origin(text):
    """Line of `provenance.provenance` with its words in Japanese."""
    for english, japanese in ORIGIN.items():
        text = text.replace(english, japanese)
    return re.sub(r"Run (\d+) of (\d+)", r"\2 回の計算の \1 番目", text)


def outcome(found):
    if found["collapsed"]:
        return f"{found['collapse_time_s']:.1f} 秒に倒壊"
    drift, storey, direction = largest_drift(found)
    left = largest_drift(found, "residual_drift")[0]
    residual = f"、残留変形角 {below(left)}" if drift >= 1 / 120 else ""
    peak = f"{ratio(drift, '')}（{DIRECTIONS.get(direction, direction)}、{storey[len('storey'):]} 階）" if drift >= SMALL else "1/1000 未満"
    facts = main_structure(found)
    lean = "（最後に傾いている）" if verdict.leans(facts) else ""
    return f"{OUTCOMES[verdict.judge(facts)]}{lean}。最大層間変形角 {peak}{residual}"


def structures(found):
    """Verdicts on the structures other than the main one, unless they are undamaged."""
    for name, facts in list(found.get("structures", {}).items())[1:]:
        state, time = verdict.judge(facts), fall_time(name, found)
        place = STRUCTURES.get(name, name)
        if state == verdict.COLLAPSED:
            yield f"{place}は" + ("倒壊" if time is None else f" {time:.1f} 秒に倒壊")
        elif state != verdict.UNDAMAGED:
            yield f"{place}は{OUTCOMES[state]}（最大層間変形角 {below(facts['peak_drift'])}）"


def below(drift):
    """A drift in the notation of engineers: 1/85, 1/1000 未満."""
    return f"{ratio(drift, '')}{' 未満' if drift < SMALL else ''}"


def event(kind, text, lot=None):
    """Text of an event, from its kind and its English text; the English one where the kind is unknown. lot: of a town, with which the text begins"""
    if lot is not None:
        return f"{lot}：{event(kind, text.removeprefix(f'{lot}: '))}"
    if kind == "level":
        return next((ja for level, ja in LEVELS.items() if level in text), text)
    if kind == "first_break":
        found = re.search(r"([\d.]+) kN", text)
        return "最初のばねの破断" + (f"（{found[1]} kN）" if found else "")
    if kind == "tilt":
        return f"層間変形角が 1/10 を超える（{'東西' if 'E-W' in text else '南北'}）"
    if kind == "columns_lost":
        found = re.match(r"(\d+) of (\d+)", text)
        return f"柱 {found[2]} 本のうち {found[1]} 本が倒れるか外れた" if found else text
    if kind == "snow_fallen":
        side = next((ja for en, ja in SIDES.items() if en in text), "")
        return f"{side}の屋根の雪が落ちる" if side else "屋根の雪が落ちる"
    name = text.split(" has ")[0]
    fixed = {"shaking": SHAKING.get(text, text), "collapse": "倒壊：床が階高の半分以上落ちた", "structure_fallen": f"{STRUCTURES.get(name, name)}が倒れた"}
    return fixed.get(kind, text)
