# SPDX-License-Identifier: GPL-2.0-or-later
"""Summaries and events in Japanese, for the player. Functions, numbers and names are the same as in English."""
from ..recording.summary import TownSummary
from ..recording.verdict import COLLAPSED, DAMAGE, STATES, TILT, UNDAMAGED, passed
from . import english
from .english import SMALL, ratio

DIRECTIONS = {"ns": "南北", "ew": "東西"}
SIDES = {"north": "北", "south": "南", "east": "東", "west": "西"}
STRUCTURES = {"entrance": "玄関"}
ORIGIN = {"none": "地動なし", "motion": "地動", "record": "記録", "intensity": "計測震度", "step": "時間刻み"}
"""Words of pictures/provenance.py."""
OUTCOMES = {"undamaged": "無被害", "repairable": "補修可能", "unsafe": "危険", "total loss": "全壊",
            "collapsed": "倒壊", "failed": "計算失敗"}
WALL_LEVELS = {"design": "設計値", "mean": "平均値"}
LEVELS = {"damage limit": "損傷の始まり", "safety limit": "大きな損傷"}


def title(summary):
    """'住宅 C2：地震、積雪 5.6 t', of a town '区画 corner（住宅 C2）：地震'; of the town itself '町 harbour'."""
    if isinstance(summary, TownSummary):
        return f"町 {summary.model}"
    house = f"住宅 {summary.model}" if summary.lot is None else f"区画 {summary.lot}（住宅 {summary.model}）"
    loads = ["地震"] * summary.earthquake + [f"積雪 {summary.snow_mass_kg / 1000:.1f} t"] * summary.snow
    return f"{house}：{'、'.join(loads) or '自重のみ'}"


def result(summary):
    """Outcome: place in an ensemble, verdict, peak and residual drift, other structures, joints, columns, snow; of a
    town its houses by verdict."""
    if isinstance(summary, TownSummary):
        counts = ((state, summary.verdicts.count(state)) for state in STATES)
        houses = "、".join(f"{OUTCOMES[state]} {count} 棟" for state, count in counts if count)
        return f"{len(summary.lots)} 棟のうち{houses}。"
    parts = [remark(english.cut_off, summary), outcome(summary), remark(english.other_walls, summary),
             remark(english.weight, summary), moving(summary), *structures(summary), joints(summary), columns(summary),
             snow(summary), remark(english.record, summary), early(summary), remark(english.unconverged, summary)]
    return ensemble(summary) + "。".join(filter(None, parts)) + "。"


REMARKS = {
    english.cut_off: lambda summary: f"{summary.duration_s:.2f} 秒で計算を打ち切り、以下の結果は信頼できない",
    english.other_walls: lambda summary: (f"耐力壁の強さを{WALL_LEVELS[summary.walls.other.level]}とすると"
                                          f"{OUTCOMES[summary.walls.other.verdict]}"),
    english.weight: lambda summary: ("揺れの前に{}で損傷" if summary.earthquake else "{}による損傷").format(
        "自重と積雪" if summary.snow else "自重"),
    english.record: lambda summary: "記録の加速度に一定の成分がある",
    english.unconverged: lambda summary: f"{summary.solver.unconverged_steps} ステップが収束していない",
}
"""Part of an English sentence: the same in Japanese, where the part is not empty."""


def remark(part, summary):
    return REMARKS[part](summary) if part(summary) else ""


def outcome(summary):
    if summary.collapsed:
        return f"{summary.collapse_time_s:.1f} 秒に倒壊"
    drift, storey, direction = summary.largest_drift()
    left = summary.largest_drift("residual_drift")[0]
    name = "残留変形角" if summary.main.settled else "終了時の変形角"
    residual = f"、{name} {below(left)}" if drift >= DAMAGE.drift else ""
    peak = (f"{ratio(drift, '')}（{direction_name(direction)}、{storey.removeprefix('storey')} 階）" if drift >= SMALL
            else "1/1000 未満")
    lean = "（最後に傾いている）" if summary.main.leans else ""
    return f"{OUTCOMES[summary.main.verdict]}{lean}。最大層間変形角 {peak}{residual}"


def moving(summary):
    amplitude, _, direction = summary.largest_drift("final_amplitude")
    return (f"なお ±{below(amplitude)}（{direction_name(direction)}）で揺れている"
            if summary.still_moving and not summary.collapsed else "")


def structures(summary):
    for name, facts in summary.others:
        time = summary.fall_time(name)
        if facts.verdict == COLLAPSED:
            yield f"{structure_name(name)}は" + ("倒壊" if time is None else f" {time:.1f} 秒に倒壊")
        elif facts.verdict != UNDAMAGED:
            lean = "（最後に傾いている）" if facts.leans else ""
            yield f"{structure_name(name)}は{OUTCOMES[facts.verdict]}{lean}（最大層間変形角 {below(facts.peak_drift)}）"


def joints(summary):
    (broken, total), (torn, sheets) = summary.joints_and_sheets
    walls = f"、壁面 {sheets} 面のうち {torn} 面" if sheets else ""
    partly, before = summary.partly_broken, summary.broken.damaged_at_start.total
    others = "、".join([f"一部破断 {partly} か所"] * bool(partly) + [f"最初から破断 {before} か所"] * bool(before))
    return f"接合部 {total} か所のうち {broken} か所{walls}が破断" + (f"（ほかに{others}）" if others else "")


def columns(summary):
    counts, first = summary.columns, summary.first_time("columns_lost")
    lost = [f"{number} 本が{text}" for number, text in ((counts.fallen, "倒れた"), (counts.loose, "外れた")) if number]
    since = "" if first is None else f"（{first:.1f} 秒から）"
    return f"柱 {counts.total} 本のうち{'、'.join(lost)}{since}" if lost else ""


def snow(summary):
    first = summary.first_time("snow_fallen") if summary.snow else None
    return "" if first is None else f"雪は {first:.1f} 秒から落下"


def early(summary):
    if summary.rest_s is not None:
        return f"{summary.rest_s:.0f} 秒から瓦礫が静止したため、{summary.duration_s:.0f} 秒で計算を終了"
    onset, end = summary.missed_shaking or (None, None)
    if onset is None:
        return ""
    return (f"強い揺れ（{onset:.1f} 秒）の前に計算を終了" if summary.duration_s < onset else f"強い揺れ（{onset:.1f}～{end:.1f} 秒）の途中で計算を終了")


def ensemble(summary):
    """'16 回の計算の 7 番目（危険 12 回、倒壊 4 回）。' of a run that is shown for an ensemble, else empty."""
    if not summary.ensemble:
        return ""
    outcomes = "、".join(f"{OUTCOMES.get(state, state)} {number} 回"
                        for state, number in summary.ensemble.outcomes.items())
    return f"{place_in_ensemble(summary.ensemble)}（{outcomes}）。"


def place_in_ensemble(place):
    """'16 回の計算の 7 番目'. place: summary.Ensemble"""
    return f"{place.runs} 回の計算の {place.run} 番目"


def event(one):
    text = PHRASES[one.kind](one.facts)
    return text if one.lot is None else f"{one.lot}：{text}"


def own_weight(facts):
    """'揺れの前に自重で損傷：接合部 12 か所が破断、最大層間変形角 1/45'."""
    main = next(iter(facts.structures), None)
    damaged = [(name, one) for name, one in facts.structures.items() if one.verdict != UNDAMAGED]
    parts = [("" if name == main else f"{structure_name(name)}は") + _damage(one) for name, one in damaged]
    return f"揺れの前に自重{'と雪' * facts.snow}で損傷：{'、'.join(parts)}"


def _damage(facts):
    if facts.collapsed:
        return "倒壊"
    counts = ((facts.broken, "接合部 {} か所が破断"), (facts.partly_broken, "接合部 {} か所が一部破断"),
              (facts.columns_lost, "柱 {} 本が倒れるか外れた"))
    return "、".join([*(text.format(number) for number, text in counts if number), f"最大層間変形角 {below(facts.peak_drift)}"])


def level(facts):
    limit = passed(facts.drift)
    return f"層間変形角が {ratio(limit.drift)} を超える（{LEVELS[limit.name]}）"


PHRASES = {
    "first_break": lambda facts: "最初のばねの破断" + (f"（{facts.force_n / 1000:.1f} kN）" if facts.force_n else ""),
    "tilt": lambda facts: f"層間変形角が {TILT.ratio} を超える（{direction_name(facts.direction)}）",
    "collapse": lambda facts: "倒壊：床が階高の半分以上落ちた",
    "own_weight": own_weight,
    "structure_fallen": lambda facts: f"{structure_name(facts.structure)}が倒れた",
    "columns_lost": lambda facts: f"柱 {facts.total} 本のうち {facts.number} 本が倒れるか外れた",
    "snow_fallen": lambda facts: (f"{structure_name(facts.structure)}の" * bool(facts.structure)
                                  + f"{SIDES.get(facts.side)}の" * (facts.side in SIDES) + "屋根の雪が落ちる"),
    "shaking_begins": lambda facts: "揺れの始まり",
    "strongest_shaking": lambda facts: "最大の揺れ",
    "level": level,
}


def direction_name(key):
    return DIRECTIONS.get(key, key)


def structure_name(name):
    return STRUCTURES.get(name, name)


def below(drift):
    """A drift in the notation of engineers: 1/85, 1/1000 未満."""
    return f"{ratio(drift, '')}{' 未満' if drift < SMALL else ''}"


MEANING = {"undamaged": "補修が必要な被害は予想されません。",
           "repairable": "補修できる被害（仕上げのひび割れ、接合部のゆるみ）です。専門家の点検を受けてください。",
           "unsafe": "専門家が調査するまで、立ち入らないでください。",
           "total loss": "傾きが大きく、補修できません。立ち入らないでください。",
           "collapsed": "階がつぶれ、中にいる人の命に危険があります。"}
OWNER = {"start": "はじめ", "end": "終わり", "events": "できごと", "seconds": "秒",
         "note": "一つの地震についての計算例です。安全を保証するものではありません。専門家に相談してください。"}
