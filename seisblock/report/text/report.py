"""Text of ``seisblock report``: one line per body."""

from __future__ import annotations

from collections.abc import Iterator

from rich.text import Text

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import gettext, join_list
from seisblock.output.text.tables import styled_line
from seisblock.report.text.assessment import headline, object_headline, style
from seisblock.studies.report.responses import BodyResponses, ReportData


def tables(data: ReportData) -> Iterator[Text]:
    """Yield the assessment of each body."""
    for body in data.bodies:
        yield styled_line(body_headline(body), style(body.assessment))


def body_headline(body: BodyResponses) -> str:
    """Return the assessment of a body under any of its directions in one line."""
    name = gettext(body_name(body.subject.name))
    if len(body.cards) > 1:
        return object_headline(body.assessment, name)
    return headline(body.assessment, join_list([name, body.assessment.direction]))
