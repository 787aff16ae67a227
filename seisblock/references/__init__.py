"""Bibliography by key, used by docstrings, ``seisblock cite`` and the JSON documents."""

from __future__ import annotations

import re
from collections.abc import Iterable

from seisblock.core.registry import get_solver, solver_names
from seisblock.references.ground_motion import GROUND_MOTION
from seisblock.references.literature import LITERATURE
from seisblock.references.reference import Reference
from seisblock.references.statistics import STATISTICS

REFERENCES = {reference.key: reference for reference in (*LITERATURE, *STATISTICS, *GROUND_MOTION)}
"""All references by key."""

SOFTWARE = Reference(
    "seisblock",
    "seisblock contributors",
    2025,
    "seisblock: seismic response of unanchored objects",
    "Python package",
    kind="software",
)
"""Reference of this program."""

TOPIC_PAPERS: dict[str, tuple[str, ...]] = {
    "measures": ("Furukawa2009", "JMA1996", "JMA2016", "Arias1970", "TrifunacBrady1975", "Parzen1961", "NigamJennings1969", "Boore2010"),
    "response spectrum": ("NigamJennings1969",),
    "spectrum of all directions": ("Boore2010",),
    "storey": ("NigamJennings1969", "Chopra2012"),
    "sliding": ("Fujino1978",),
    "one-way sliding": ("Newmark1965",),
    "rocking": ("Housner1963", "Zhang2001", "Ishiyama1982"),
    "a scan's arms": ("Housner1963", "Furukawa2009"),
    "jump": ("Sugimoto2017",),
    "two-layer body": ("Sugimoto2017",),
    "landing with friction": ("WangMason1992", "Moreau1988"),
    "uplift": ("Okumura1987",),
    "pile": ("Furukawa2009",),
    "rigid pile": ("Furukawa2009", "AlartCurnier1991", "Gottschalk1996", "Jean1999", "Moreau1988", "Silcowitz2010", "TasoraAnitescu2011"),
    "rigid body in space": ("Moreau1988", "Jean1999", "SimoWong1991", "AlartCurnier1991"),
    "all modes": ("ShentonJones1991", "Shenton1996", "Housner1963", "WangMason1992", "Moreau1988", "GenotBrogliato1999"),
    "overturning criteria": ("Furukawa2009", "Tsutsui", "Housner1963", "Zhang2001", "Ishiyama1982"),
    "gravestones as fitted": ("Furukawa2009",),
    "gravestones as blocks": ("Furukawa2009", "Housner1963"),
    "intensity of a velocity": ("Midorikawa1999",),
    "fit": ("AndrieuRoberts2009", "Cornuet2012", "DelMoral2006", "Neyman1934", "Richtmyer1951", "Brier1950"),
    "fragility": ("Baker2015", "Vamvatsikos2002", "LucoCornell2007", "DimitrakopoulosParaskeva2015", "Lilliefors1967", "SuWei1991"),
    "risk": ("Cornell2002",),
    "scenario": ("JMA1996", "JMA2009", "KornGraubard1998"),
    "synthetic records": (
        "Boore2003",
        "Campbell2003",
        "BooreJoyner1997",
        "AtkinsonSilva2000",
        "HanksKanamori1979",
        "SaragoniHart1974",
        "NewmarkHall1982",
    ),
}
"""Papers used, by topic; all lists of citations in results derive from this table."""


def papers(*topics: str) -> tuple[str, ...]:
    """Return the keys of the papers of some topics, without duplicates, in order.

    Examples
    --------
    >>> papers("jump", "landing with friction")
    ('Sugimoto2017', 'WangMason1992', 'Moreau1988')
    """
    return tuple(dict.fromkeys(key for topic in topics for key in TOPIC_PAPERS[topic]))


def find_citations(texts: Iterable[str]) -> tuple[str, ...]:
    """Return the citation keys in brackets in some texts, without duplicates, in order."""
    return tuple(dict.fromkeys(key for text in texts for key in re.findall(r"\[(\w+)\]", text) if key in REFERENCES))


COMMAND_PAPERS: dict[str, tuple[str, ...]] = {
    "measure": papers("measures", "response spectrum"),
    "batch": papers("all modes", "two-layer body"),
    "map": papers("measures", "all modes", "gravestones as fitted", "intensity of a velocity"),
    "body": papers("a scan's arms"),
    "risk": papers("risk"),
    "scenario": papers("scenario", "all modes", "synthetic records"),
    "secure": papers("scenario", "all modes", "synthetic records"),
    "fragility": papers("fragility", "spectrum of all directions", "all modes", "rocking", "sliding", "rigid pile", "synthetic records"),
    "criteria": papers("overturning criteria", "rocking", "all modes"),
    "spectrum": papers("rocking", "sliding", "all modes"),
    "overturn-rate": papers("gravestones as fitted", "gravestones as blocks"),
    "infer": papers("gravestones as fitted", "gravestones as blocks", "intensity of a velocity", "sliding", "jump", "rigid body in space"),
    "fit": papers("rocking", "fit"),
    "report": papers(
        "measures", "response spectrum", "all modes", "rocking", "sliding", "jump", "uplift", "overturning criteria", "two-layer body"
    ),
}
"""Papers used by each command that is no solver; each JSON document lists those of its result."""


def cited_commands() -> tuple[str, ...]:
    """Return the commands with references."""
    return tuple(dict.fromkeys((*solver_names(), *COMMAND_PAPERS)))


def command_papers(command: str) -> tuple[str, ...]:
    """Return the keys of the papers of a command: those of its solver, or of its study."""
    if command in COMMAND_PAPERS:
        return COMMAND_PAPERS[command]
    solver = get_solver(command)
    return papers(*solver.topics, *solver.command_topics)
