"""Published source, formatted as a line of a bibliography or as BibTeX."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Reference:
    """Published source; ``where`` is the journal, publisher or institution, ``authors`` are as in BibTeX: ``Family, G. and Family, G.``."""

    key: str
    authors: str
    year: int
    title: str
    where: str
    kind: str = "article"
    doi: str = ""

    def text(self) -> str:
        """Return the reference as one line of a bibliography."""
        tail = f" doi:{self.doi}" if self.doi else ""
        authors = self.authors.replace(" and others", " et al.").replace(" and ", "; ")
        return f"{authors} ({self.year}). {self.title}. {self.where}.{tail}"

    def bibtex(self) -> str:
        """Return the reference as a BibTeX entry."""
        container = {"article": "journal", "book": "publisher", "techreport": "institution"}.get(self.kind, "howpublished")
        # braces keep the name of an institution together
        authors = self.authors if "," in self.authors else f"{{{self.authors}}}"
        fields = {"author": authors, "year": str(self.year), "title": self.title, container: self.where, "doi": self.doi}
        body = ",\n".join(f"  {name} = {{{value}}}" for name, value in fields.items() if value)
        return f"@{self.kind}{{{self.key},\n{body}\n}}"
