"""Detection of English left in a text of another language."""

import html
import re

NAMES = (
    r"seisblock(?: [a-z-]+)?(?: \[?[A-Z]+\]?(?:\.\.\.)?)*",  # a command line
    r"(?<!\w)--?[a-z][\w-]*( [A-Z|]+)*",  # an option, and what stands for its value
    r"\[[A-Z]\w*\](?: (?:eqs?|table|fig|section)\b\.?)?|\b(?:Furukawa|Tsutsui|Housner|Zhang|Ishiyama|West)\d*\b",  # a citation
    r"\b(?:JMA|NIED|K-NET|KiK-net|KNET|KIKNET|PEER|AT2|CSV|TOML|BibTeX|JSON|OBSPY|ObsPy|Newmark|Clopper-Pearson|Parzen|Chozu-sha)\b",
    r"\b(?:NS|EW|UD|PGA|PGV|PGD|DEM|HZ|gal|kine|Hz|mm|cm|rad|kg|kN|deg|rms|ln|omega_V|pi)\b",  # directions, measures, units
    r"'[^']*'|\{[a-z|]+\}|\[[a-z|-]+\]",  # what was typed, and what may be
    r"\b[\w-]+(?:[./][\w-]+)+\b",  # names of files and of pairs of surfaces
    r"Hanmer\s+Springs\s+Emergency\s+Centre|\d+ km [a-z-]+ of Waiau|San Francisco, 1295 Shafter",  # places, as bundled records name them
    r"INTEGER RANGE|INTEGER|FLOAT|TEXT|COMMAND|ARGS|OPTIONS",  # kinds of values
)
WORD = r"[A-Za-z][a-z]+"
ENGLISH = re.compile(rf"{WORD}(?:[,;:.]? {WORD}){{2,}}")


def english_words(text):
    """Return the English in a text: three words in a row that are neither names, units nor citations."""
    for name in NAMES:
        text = re.sub(name, "·", text)
    return [result.group() for result in ENGLISH.finditer(text)]


def visible_text(page):
    """Return what one reads on a page: without scripts, styles, tags, quoted references and the foot."""
    for part in ("script", "style", "ul", "footer"):
        page = re.sub(rf"<{part}.*?</{part}>", "", page, flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]*>", "\n", page))
