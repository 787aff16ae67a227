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
