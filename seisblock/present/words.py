"""The words of figures and reports in Japanese: one table, and which language is wanted."""

from __future__ import annotations

import os
import re
from functools import cache

LANGUAGES = ("en", "ja")

LABELS = {
    "t (s)": "時刻 t (s)",
    "f (Hz)": "振動数 f (Hz)",
    "T (s)": "固有周期 T (s)",
    "a (gal)": "加速度 a (gal)",
    "a (m/s²)": "加速度 a (m/s²)",
    "z'' (m/s²)": "地動加速度 z'' (m/s²)",
    "v (kine)": "速度 v (kine)",
    "v (m/s)": "速度 v (m/s)",
    "velocity (m/s)": "速度 (m/s)",
    "x − z (mm)": "相対変位 x − z (mm)",
    "θ (deg)": "傾き θ (deg)",
    "θ/α": "傾き θ/α",
    "θ'/(p α)": "角速度 θ'/(p α)",
    "x of G (mm)": "重心の水平変位 (mm)",
    "rise of G (mm)": "重心の上昇 (mm)",
    "PGA (gal)": "最大加速度 PGA (gal)",
    "H/B": "高さ/幅 H/B",
    "x (m)": "x (m)",
    "largest slip (m)": "最大滑動量 (m)",
    "ground acceleration (m/s²)": "地動加速度 (m/s²)",
    "tilt θ (deg)": "傾き θ (deg)",
    "slip s (mm)": "滑動量 s (mm)",
    "α (degrees)": "転倒限界角 α (度)",
    "largest lean over α (white: stands still)": "最大傾斜/α（白：動かない）",
    "likelihood (over its largest)": "尤度（最大値との比）",
    "surveyed rate": "調査転倒率",
}
"""Labels that are replaced whole."""

PHRASES = {
    # bodies and places
    "Chozu-sha": "手水舎",
    "gravestone": "墓石",
    "short side": "短辺方向",
    "long side": "長辺方向",
    "block": "物体",
    "base": "基盤",
    "object": "物体",
    "stones": "墓石",
    "stone": "墓石",
    "cemetery": "墓地",
    "ground": "地盤",
    "foot": "脚部",
    "corner": "隅",
    # phases and events
    "left foot": "左脚",
    "right foot": "右脚",
    "enlarged, seen from the ground": "拡大図（地盤から見た動き）",
    "jumped": "跳躍",
    "rocking-sliding": "着地後のロッキング滑動",
    "rocked without jumping": "跳躍せずロッキング",
    "did not rock": "ロッキングなし",
    "rest": "静止",
    "rocking": "ロッキング",
    "flight": "跳躍中",
    "impacts": "衝突",
    "impact": "衝突",
    "slides to +x": "+x へ滑動",
    "slides to -x": "-x へ滑動",
    "slip forward": "+x へ滑動",
    "slip backward": "-x へ滑動",
    "sliding": "滑動",
    "stick": "固着",
    "overturns": "転倒",
    "overturned": "転倒",
    "stands": "転倒しない",
    "falls": "転倒",
    "a corner lifts": "隅が浮き上がる",
    "in the air": "浮き上がり",
    "lifts": "浮き上がる",
    "rocks to +x": "+x へ傾斜",
    "rocks to -x": "-x へ傾斜",
    "beyond +alpha": "+α 超過",
    "beyond -alpha": "-α 超過",
    # thresholds and criteria
    "static friction holds between": "静止摩擦の限界",
    "rests within": "静止の範囲",
    "α passed for good": "α を超えて戻らず",
    "edge of falling, unshaken": "自由振動の転倒限界",
    "holds at rest": "静止時に保持",
    "this record": "この記録",
    "foot of the slope": "斜面下端",
    "demand over threshold": "作用/限界",
    "simulated": "数値計算",
    "threshold": "閾値",
    "mu": "μ",
    "kinetic": "動摩擦",
    "slope": "傾斜",
    "level": "水平",
    "one way": "一方向",
    "vertical motion": "上下動",
    "limits of static friction": "静止摩擦の限界",
    "beyond": "超過：",
    "West, static": "West（静的）",
    "as printed": "印刷どおり",
    "first form": "第一式",
    "exact": "厳密解",
    "pulse width": "パルス幅",
    "half sine": "正弦半波",
    "one sine, no impact": "正弦一波（無衝突）",
    "rectangular pulse": "矩形波",
    "velocity step": "速度ステップ",
    "constant force": "一定力",
    "dowelled": "太枘補強",
    "acceleration": "加速度",
    "velocity": "速度",
    # measures
    "Fourier amplitude, Parzen": "フーリエ振幅 Parzen",
    "Response spectrum, damping": "応答スペクトル 減衰",
    "JMA intensity": "計測震度",
    "share of stones": "墓石の割合",
    "share above": "超過割合",
    "share per": "割合／",
    "overturning rate": "転倒率",
    "rate": "転倒率",
    "surveyed rate": "調査転倒率",
    "as surveyed": "調査",
    "reinforced": "補強",
    "restitution": "反発係数",
    "equivalent frequency": "等価振動数",
    "plan: when each corner was in the air": "平面図：各隅の浮き上がり時刻",
    "the first": "最初",
    "median": "中央値",
    "fell": "転倒",
    "red overturns": "赤は転倒",
    "along +x": "+x 方向",
    "across": "直交方向",
    "up": "上下",
    "first at": "最初",
    "highest": "最大",
    # animation
    "x real time": "倍速",
    "x slower": "倍スロー再生",
    "real time": "実時間",
    "record": "記録",
}
"""Phrases that are replaced inside a text, the longest first."""

LOCALE_VARIABLES = ("LC_ALL", "LC_MESSAGES", "LANG")


def language(asked: str | None = None) -> str:
    """Return the language of figures and reports: the one asked for, else Japanese in a Japanese locale, else English.

    Parameters
    ----------
    asked : "en", "ja" or None
    """
    if asked:
        return asked
    chosen = next((os.environ[name] for name in LOCALE_VARIABLES if os.environ.get(name)), "")
    return "ja" if chosen.lower().startswith("ja") else "en"


def translate(text: str, lang: str) -> str:
    """Return a text of a figure in a language; what no table holds stays as it is."""
    if lang == "en" or not text:
        return text
    return LABELS.get(text) or _pattern().sub(lambda found: PHRASES[found.group(0)], text)


@cache
def _pattern() -> re.Pattern[str]:
    """Return the pattern of every phrase as whole words."""
    longest_first = sorted(PHRASES, key=len, reverse=True)
    return re.compile("|".join(rf"(?<![\w$\\]){re.escape(phrase)}(?!\w)" for phrase in longest_first))


SENTENCES = {
    "What {name} does to what stands there": "{name} の地震動が固定されていない物体に与える影響",
    "The record": "地震記録",
    "JMA intensity {value:.2f} (class {name}).": "計測震度 {value:.2f}（震度階級 {name}）。",
    "Largest horizontal vector {gal:.1f} gal at {time:.2f} s.": "水平合成の最大加速度は {time:.2f} 秒に {gal:.1f} gal。",
    "Acceleration, velocity and spectra of the record.": "記録の加速度、速度、スペクトル。",
    "Criteria beside the simulation": "転倒判定式と数値計算の比較",
    "{name}: {right} of {all} criteria agree with the simulation.": "{name}：{all} の判定式のうち {right} が数値計算と一致。",
    "Demand over threshold: right of 1 a criterion says that the body falls.": "作用／限界。1 より右は「転倒する」という判定。",
    "Where this comes from": "出典と条件",
    "file": "ファイル",
    "format": "形式",
    "processing": "前処理",
    "as read": "読み込んだまま",
    "gravity": "重力加速度",
    "velocity": "速度",
    "command": "コマンド",
    "overturning": "転倒",
    "sliding": "滑動",
    "jump": "跳躍",
    "uplift": "浮き上がり",
    "Rocking and overturning": "ロッキングと転倒",
    "Sliding": "滑動",
    "Jump of the two-layer block": "二層剛体の跳躍",
    "Uplift from corner springs": "隅ばねからの浮き上がり",
    "overturns towards {side}{name}": "{name} の {side} 側へ転倒",
    "rocks and stands: {share:.0%} of the way to overturning ({name})": "転倒しない：転倒限界の {share:.0%}（{name}）",
    "stands still": "動かない",
    "does not slide": "滑らない",
    "slides up to {mm:.0f} mm ({name})": "最大 {mm:.0f} mm 滑る（{name}）",
    "jumps: {mm:+.0f} mm along {name}": "跳躍し {name} に {mm:+.0f} mm 移動",
    "rocks without jumping ({name})": "跳躍せずロッキングのみ（{name}）",
    "no corner lifts": "どの隅も浮かない",
    "corner {corner} lifts, up to {mm:.1f} mm ({name})": "隅 {corner} から浮き、最大 {mm:.1f} mm（{name}）",
    "The body stands still.": "物体は動かない。",
    " after the record's end": "（記録の終了後）",
    "The body overturns to {side}{after}; it lies down at {time:.2f} s.": "{side} 側へ転倒{after}。{time:.2f} 秒に横倒しになる。",
    "The body rocks from {time:.2f} s and stands; it leans to {share:.0%} of its slenderness.": "{time:.2f} 秒からロッキングするが転倒しない。最大傾斜は転倒限界角の {share:.0%}。",
    "The verdict is the same at every factor up to {limit:g}.": "記録を {limit:g} 倍までどの倍率にしても判定は変わらない。",
    "The verdict changes next at {factor:.3f} times this record.": "判定が変わる最も近い倍率は {factor:.3f}。",
    "Below {factor:.3f} times this record it always stands.": "{factor:.3f} 倍より小さければ常に転倒しない。",
    "A change of the record by less than 2 % changes the verdict.": "記録が 2 % 変わるだけで判定が変わる。",
    "Friction holds throughout.": "静止摩擦が保たれ、滑らない。",
    "The body slides from {start:.2f} s, up to {most:.1f} mm at {time:.2f} s; {rest:+.1f} mm remain.": "{start:.2f} 秒から滑り、{time:.2f} 秒に最大 {most:.1f} mm、残留 {rest:+.1f} mm。",
    "The ground acceleration never exceeds the rocking threshold.": "地動加速度はロッキング開始加速度を超えない。",
    "Chain {number}: rocks for {rock:.3f} s, flies for {fly:.3f} s, moves {mm:+.1f} mm; the centroid rises by {rise:.1f} mm.": "第 {number} 回：ロッキング {rock:.3f} 秒、跳躍 {fly:.3f} 秒、移動 {mm:+.1f} mm、重心の上昇 {rise:.1f} mm。",
    "Chain {number}: {outcome}.": "第 {number} 回：{outcome}。",
    "rocked without jumping": "跳躍せずロッキング",
    "overturned while rocking": "ロッキング中に転倒",
    "overturned after landing": "着地後に転倒",
    "record ended while rocking": "ロッキング中に記録が終了",
    "record ended in flight": "跳躍中に記録が終了",
    "record ended after landing": "着地後に記録が終了",
    "No corner leaves its spring.": "どの隅もばねから離れない。",
    "Corner {corner} lifts first, at {time:.2f} s; up to {mm:.1f} mm, {total:.2f} s in the air; largest force {ratio:.1f} times the static one.": "隅 {corner} が {time:.2f} 秒に最初に浮き上がる。最大 {mm:.1f} mm、浮いている時間 {total:.2f} 秒、最大反力は静的値の {ratio:.1f} 倍。",
    "Rocking begins at {factor:.2f} times this record.": "ロッキングはこの記録の {factor:.2f} 倍から始まる。",
    "Sliding begins at {factor:.2f} times this record.": "滑動はこの記録の {factor:.2f} 倍から始まる。",
    "The chain begins at {factor:.2f} times this record.": "ロッキングはこの記録の {factor:.2f} 倍から始まる。",
    "A corner just lifts at {factor:.2f} times this record.": "この記録の {factor:.2f} 倍で隅が浮き始める。",
    "Each model is rigid and planar but for uplift, and each motion is followed by itself: a body that slides and rocks at once does neither exactly as said here. Rocking is sensitive: read the margins before the verdict.": "浮き上がり以外は平面内の剛体モデルであり、各運動は別々に計算している。滑りながらロッキングする物体はここに示すとおりには動かない。ロッキングは敏感な現象なので、判定より先に余裕度を読むこと。",
}
"""Sentences of the report: the English template and its Japanese, with the same fields."""
