"""Directions of components from names: compass points, bearings, azimuths, axes, SEED codes."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from seisblock.records.azimuth import bearing_to_azimuth

_COMPASS_WORDS = {
    0.0: (
        *("ns", "sn", "n", "north", "northsouth", "southnorth", "northward", "南北", "南北向"),
        *("norte", "nortesur", "nord", "nordsud", "nordsüd", "kuzey", "kuzeygüney", "kuzeyguney"),
    ),
    90.0: (
        *("ew", "we", "e", "east", "eastwest", "westeast", "eastward", "東西", "東西向", "东西", "东西向"),
        *("eo", "oe", "este", "esteoeste", "est", "estovest", "estouest", "ow", "wo", "ost", "ostwest", "doğu", "doğubatı", "dogubati"),
    ),
    180.0: ("s", "south", "southward"),
    270.0: ("w", "west", "westward"),
}
_UP = (
    *("ud", "u", "z", "up", "updn", "updown", "upward", "vertical", "vert", "ver", "v", "上下", "鉛直", "垂直"),
    *("垂直向", "竖向", "竖直", "竖直向", "verticale", "vertikal", "düşey", "dusey"),
)
_DOWN = ("d", "dwn", "down", "dn", "downward")
_AXIS_WORDS = {
    "X": ("x",),
    "Y": ("y",),
    "L": ("l", "long", "longitudinal"),
    "T": ("tr", "trans", "transverse", "transversal", "tran"),
    "R": ("r", "radial"),
    "H1": ("h1",),
    "H2": ("h2",),
}
_COMPASS_AZIMUTHS = {word: azimuth for azimuth, words in _COMPASS_WORDS.items() for word in words}
_AXIS_CODES = {word: code for code, words in _AXIS_WORDS.items() for word in words}
_TURKISH_AXES = {"k-g": 0.0, "d-b": 90.0}
"""North-south and east-west as written in Turkish; KG and DB without the hyphen are units."""

_ACCELERATION = r"(?:acc(?:el(?:eration)?)?|aceleraci[oó]n|acc[eé]l[eé]ration|accelerazione|beschleunigung|ivme)"
_FILLER_WORDS = re.compile(
    rf"^(?:{_ACCELERATION}|a|(?:componente?|comp|cmp|direction|dir)(?=[ ,_.:-]+\D))[ ,_.:-]+(?=.)"
    r"|^(?:acc|a)(?=[xyz]$)|^acc(?=(?:ns|ew|ud)$)|(?<=^ns|^ew|^ud)acc$"
    rf"|(?<=.)[ ,_.-]+(?:{_ACCELERATION}|componente?|comp|cmp|direction|dir)\.?$"
    r"|(?<!\d)(?:加速度|成分|方向|波形|向き)(?!\s*\d)|(?<=[北西下直nsewudzxy])動$",
    re.IGNORECASE,
)
"""Words next to a direction that carry no direction."""

_QUADRANT = re.compile(r"([NS])(\d{1,3}(?:\.\d+)?)([EW])", re.IGNORECASE)
_DEGREES = re.compile(r"(?:az(?:imuth)?)?(\d{1,3}(?:\.\d+)?)(deg(?:rees?)?|°|度)?", re.IGNORECASE)
_SEED = re.compile(r"(?:.*\.)?([FGDCESHBMLV][NLGH])([NEZ123])", re.IGNORECASE)
_SEED_POINTS = {"N": "NS", "E": "EW", "Z": "UD"}


@dataclass(frozen=True)
class Direction:
    """A direction of ground motion.

    `code` is ``NS``, ``EW``, ``UD``, the azimuth in degrees (``164``), or the name of an axis of unknown azimuth; `azimuth_deg` the azimuth
    of the positive direction, degrees clockwise from north. `sign` is -1 if the name is positive down: samples are converted to ``UD``,
    positive up. A bare number has no degree mark: an azimuth only together with a perpendicular one. `velocity` marks the SEED code of a
    velocity sensor.
    """

    code: str
    azimuth_deg: float | None = None
    sign: float = 1.0
    is_bare_number: bool = False
    velocity: bool = False


def direction_from_azimuth(azimuth_deg: float, *, is_bare_number: bool = False) -> Direction:
    """Return the direction of an azimuth: ``NS`` for 0 and 360, ``EW`` for 90, else the degrees."""
    azimuth = azimuth_deg % 360.0
    return Direction({0.0: "NS", 90.0: "EW"}.get(azimuth, f"{azimuth:g}"), azimuth, is_bare_number=is_bare_number)


def strip_component_words(text: str) -> str:
    """Return a name without the words component, direction and acceleration; such a word alone stays.

    Examples
    --------
    >>> [strip_component_words(name) for name in ("UD成分", "南北方向", "上下動", "加速度NS", "NS component", "acc_x", "HNE_acc", "加速度")]
    ['UD', '南北', '上下', 'NS', 'NS', 'x', 'HNE', '加速度']
    """
    previous_text, stripped_text = text.strip(), _FILLER_WORDS.sub("", text.strip())
    # repeated until unchanged: filler words may stand on both sides
    while stripped_text and stripped_text != previous_text:
        previous_text, stripped_text = stripped_text.strip(), _FILLER_WORDS.sub("", stripped_text.strip())
    return previous_text


_SIGNED = re.compile(
    r"^(?P<before>[-+−＋])?\s*(?P<name>[^()\[\]（）]*?)\s*(?:[(\[（]\s*(?P<inner>[^()\[\]（）]*?)\s*[)\]）])?\s*(?P<after>[-+−＋])?$"
)
_SENSE_WORD = re.compile(r"^(.+?)[\s_-]+((?:up|down)(?:ward)?|dn|dwn)(?:[\s_-]+(?:positive|pos))?$", re.IGNORECASE)
_POSITIVE_WORDS = re.compile(r"\b(?:positive|pos|plus|is)\b|[+＋]|[がを]?正|向き|向", re.IGNORECASE)
_AXES_BY_AZIMUTH = {0.0: ("NS", 1.0), 180.0: ("NS", -1.0), 90.0: ("EW", 1.0), 270.0: ("EW", -1.0)}


def parse_signed_direction(text: str) -> Direction | None:
    """Return the direction of a name with a sign or with the positive sense in brackets, None for other names.

    Examples
    --------
    >>> [(d.code, d.sign) for d in map(parse_signed_direction, ("UD(down)", "Z down", "-UD", "NS(S+)", "EW (+E)", "UD(上が正)"))]
    [('UD', -1.0), ('UD', -1.0), ('UD', -1.0), ('NS', -1.0), ('EW', 1.0), ('UD', 1.0)]
    >>> parse_signed_direction("UD"), parse_signed_direction("UD (filtered)"), parse_signed_direction("up-down")
    (None, None, None)
    """
    if parse_direction(text) is None:
        # "up-down" is a name, "Z down" a name and its sense
        text = _SENSE_WORD.sub(r"\1 (\2)", text.strip())
    match = _SIGNED.match(text.strip())
    if match is None:
        return None
    base = parse_direction(match["name"])
    mark = match["before"] or match["after"]
    if base is None or not (mark or match["inner"]):
        return None
    sign = -1.0 if mark in ("-", "−") else 1.0
    if match["inner"]:
        word = _POSITIVE_WORDS.sub("", match["inner"]).strip(" :=")
        sense = parse_direction({"下": "down", "上": "up", "北": "n", "南": "s", "東": "e", "西": "w"}.get(word, word))
        if sense is None:
            return None
        if base.code == "UD":
            # the name may be Z, the sense down
            if sense.code != "UD":
                return None
            sign *= sense.sign
        else:
            base_axis, sense_axis = (_AXES_BY_AZIMUTH.get(d.azimuth_deg if d.azimuth_deg is not None else -1.0) for d in (base, sense))
            if base_axis is None or sense_axis is None or base_axis[0] != sense_axis[0]:
                return None
            sign *= base_axis[1] * sense_axis[1]
    return replace(base, sign=base.sign * sign)


def parse_direction(text: str) -> Direction | None:
    """Return the direction denoted by a word, or None.

    Parameters
    ----------
    text : str
        ``NS``, ``N-S``, ``E/W``, ``SN``, ``WE``, ``north``, ``東西``; ``N10E``, ``N120E``; ``10``, ``280°``; ``UP``, ``DWN``; ``X``, ``Y``,
        ``Z``; ``L``, ``V``, ``radial``; ``HNN``, ``HNE``, ``HNZ``, ``HN1``; also
        with a word for component: ``UD成分``, ``東西方向``, ``上下動``, ``NS component``; in Spanish, Italian, German, French, Turkish and
        Chinese: ``E-O``, ``O-W``, ``K-G``, ``verticale``, ``东西向``. A lone ``T`` is excluded: it may be the time.

    Examples
    --------
    >>> [parse_direction(word).code for word in ("N-S", "E/W", "UP", "N80W", "280°", "HNZ", "HN1", "Y")]
    ['NS', 'EW', 'UD', '280', '280', 'UD', 'HN1', 'Y']
    >>> parse_direction("pressure") is None
    True
    """
    text = strip_component_words(text)
    word = re.sub(r"[\s_\-./]", "", text)
    key = word.lower()
    azimuth = _COMPASS_AZIMUTHS.get(key, _TURKISH_AXES.get(text.lower()))
    if azimuth is not None:
        return direction_from_azimuth(azimuth)
    if key in _UP:
        return Direction("UD")
    if key in _DOWN:
        return Direction("UD", sign=-1.0)
    if key in _AXIS_CODES:
        return Direction(_AXIS_CODES[key])
    quadrant = _QUADRANT.fullmatch(re.sub(r"[°度]", "", re.sub(r"[\s_-]", "", text)))
    if quadrant and float(quadrant[2]) <= 90.0:
        return direction_from_azimuth(bearing_to_azimuth(quadrant[1], float(quadrant[2]), quadrant[3]))
    # N120E: from north through east
    if quadrant and float(quadrant[2]) <= 360.0 and (quadrant[1] + quadrant[3]).upper() == "NE":
        return direction_from_azimuth(float(quadrant[2]))
    degrees = _DEGREES.fullmatch(re.sub(r"[\s_:=-]", "", text))
    if degrees and float(degrees[1]) <= 360.0:
        return direction_from_azimuth(float(degrees[1]), is_bare_number=degrees[0] == degrees[1])
    # SEED code: band, instrument (N accelerometer, H and L seismometers), orientation
    seed = _SEED.fullmatch(text.strip())
    if seed:
        letter, instrument = seed[2].upper(), seed[1].upper()
        code = _SEED_POINTS.get(letter, instrument + letter)
        return Direction(code, {"NS": 0.0, "EW": 90.0}.get(code), velocity=instrument[1] in "HL")
    return None
