"""The entries of the bibliography, each once."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Reference:
    """One published source."""

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
        fields = {"author": self.authors, "year": str(self.year), "title": self.title, container: self.where, "doi": self.doi}
        body = ",\n".join(f"  {name} = {{{value}}}" for name, value in fields.items() if value)
        return f"@{self.kind}{{{self.key},\n{body}\n}}"


LITERATURE = (
    Reference(
        "Urone2022",
        "Urone, P. P. and Hinrichs, R.",
        2022,
        "College Physics, 2nd edition",
        "OpenStax",
        kind="book",
    ),
    Reference(
        "Sugimoto2017",
        "Sugimoto, K. and Taniguchi, T. and Mukaibo, K. and Ono, Y.",
        2017,
        "Explanation of jumping behavior of Chozu-sha in view of dynamics of discontinuous system",
        "Journal of Structural Engineering A, JSCE, 63A (in Japanese)",
    ),
    Reference(
        "Tsutsui",
        "Tsutsui, M. and Yamao, T.",
        2020,
        "A study on the rocking of rectangular blocks (in Japanese)",
        "JSCE Annual Meeting",
        kind="misc",
    ),
    Reference(
        "Furukawa2009",
        "Furukawa, A. and others",
        2009,
        "Proposal of an overturning criterion of gravestones during earthquakes (in Japanese)",
        "Proc. 30th JSCE Earthquake Engineering Symposium",
    ),
    Reference(
        "Fujino1978",
        "Fujino, Y. and Sasaki, Y. and Hakuno, M.",
        1978,
        "Slip of a friction-controlled mass excited by earthquake motions (in Japanese)",
        "Bulletin of the Earthquake Research Institute, University of Tokyo, 53",
    ),
    Reference(
        "Okumura1987",
        "Okumura, T. and Matsui, K. and Suzuki, T. and Honda, M.",
        1987,
        "Uplift due to harmonic rocking of rigid body",
        "in Japanese, dated 16 October 1987; the copy at hand does not name the journal",
        kind="misc",
    ),
    Reference(
        "Housner1963",
        "Housner, G. W.",
        1963,
        "The behavior of inverted pendulum structures during earthquakes",
        "Bulletin of the Seismological Society of America, 53(2), 403-417",
    ),
    Reference(
        "Zhang2001",
        "Zhang, J. and Makris, N.",
        2001,
        "Rocking response of free-standing blocks under cycloidal pulses",
        "Journal of Engineering Mechanics, 127(5), 473-483",
        doi="10.1061/(ASCE)0733-9399(2001)127:5(473)",
    ),
    Reference(
        "WangMason1992",
        "Wang, Y. and Mason, M. T.",
        1992,
        "Two-dimensional rigid-body collisions with friction",
        "Journal of Applied Mechanics, 59(3), 635-642",
        doi="10.1115/1.2893771",
    ),
    Reference(
        "Moreau1988",
        "Moreau, J. J.",
        1988,
        "Unilateral contact and dry friction in finite freedom dynamics",
        "Nonsmooth Mechanics and Applications, CISM 302, Springer, 1-82",
        kind="book",
    ),
    Reference(
        "Newmark1965",
        "Newmark, N. M.",
        1965,
        "Effects of earthquakes on dams and embankments",
        "Geotechnique, 15(2), 139-160",
        doi="10.1680/geot.1965.15.2.139",
    ),
    Reference(
        "WestermoUdwadia1983",
        "Westermo, B. and Udwadia, F.",
        1983,
        "Periodic response of a sliding oscillator system to harmonic excitation",
        "Earthquake Engineering and Structural Dynamics, 11(1), 135-146",
        doi="10.1002/eqe.4290110111",
    ),
    Reference(
        "Ishiyama1982",
        "Ishiyama, Y.",
        1982,
        "Motions of rigid bodies and criteria for overturning by earthquake excitations",
        "Earthquake Engineering and Structural Dynamics, 10(5), 635-650",
        doi="10.1002/eqe.4290100502",
    ),
    Reference(
        "Arias1970",
        "Arias, A.",
        1970,
        "A measure of earthquake intensity",
        "Seismic Design for Nuclear Power Plants, MIT Press, 438-483",
        kind="book",
    ),
    Reference(
        "JMA1996",
        "Japan Meteorological Agency",
        1996,
        "Shindo wo shiru (Understanding seismic intensity), method of the instrumental intensity",
        "Gyosei, Tokyo (in Japanese)",
        kind="book",
    ),
    Reference(
        "Midorikawa1999",
        "Midorikawa, S. and Fujimoto, K. and Muramatsu, I.",
        1999,
        "Correlation of new J.M.A. instrumental seismic intensity with former J.M.A. seismic intensity and ground motion parameters "
        "(in Japanese)",
        "Journal of Social Safety Science, 1, 51-56",
    ),
    Reference(
        "NigamJennings1969",
        "Nigam, N. C. and Jennings, P. C.",
        1969,
        "Calculation of response spectra from strong-motion earthquake records",
        "Bulletin of the Seismological Society of America, 59(2), 909-922",
    ),
    Reference(
        "Parzen1961",
        "Parzen, E.",
        1961,
        "Mathematical considerations in the estimation of spectra",
        "Technometrics, 3(2), 167-190",
        doi="10.1080/00401706.1961.10489939",
    ),
    Reference(
        "TrifunacBrady1975",
        "Trifunac, M. D. and Brady, A. G.",
        1975,
        "A study on the duration of strong earthquake ground motion",
        "Bulletin of the Seismological Society of America, 65(3), 581-626",
    ),
    Reference(
        "ShentonJones1991",
        "Shenton, H. W. and Jones, N. P.",
        1991,
        "Base excitation of rigid bodies. I: Formulation",
        "Journal of Engineering Mechanics, 117(10), 2286-2306",
        doi="10.1061/(ASCE)0733-9399(1991)117:10(2286)",
    ),
    Reference(
        "Shenton1996",
        "Shenton, H. W.",
        1996,
        "Criteria for initiation of slide, rock, and slide-rock rigid-body modes",
        "Journal of Engineering Mechanics, 122(7), 690-693",
        doi="10.1061/(ASCE)0733-9399(1996)122:7(690)",
    ),
    Reference(
        "GenotBrogliato1999",
        "Génot, F. and Brogliato, B.",
        1999,
        "New results on Painlevé paradoxes",
        "European Journal of Mechanics A/Solids, 18(4), 653-677",
        doi="10.1016/S0997-7538(99)00144-8",
    ),
    Reference(
        "Baker2015",
        "Baker, J. W.",
        2015,
        "Efficient analytical fragility function fitting using dynamic structural analysis",
        "Earthquake Spectra, 31(1), 579-599",
        doi="10.1193/021113EQS025M",
    ),
    Reference(
        "Vamvatsikos2002",
        "Vamvatsikos, D. and Cornell, C. A.",
        2002,
        "Incremental dynamic analysis",
        "Earthquake Engineering and Structural Dynamics, 31(3), 491-514",
        doi="10.1002/eqe.141",
    ),
    Reference(
        "LucoCornell2007",
        "Luco, N. and Cornell, C. A.",
        2007,
        "Structure-specific scalar intensity measures for near-source and ordinary earthquake ground motions",
        "Earthquake Spectra, 23(2), 357-392",
        doi="10.1193/1.2723158",
    ),
    Reference(
        "DimitrakopoulosParaskeva2015",
        "Dimitrakopoulos, E. G. and Paraskeva, T. S.",
        2015,
        "Dimensionless fragility curves for rocking response to near-fault excitations",
        "Earthquake Engineering and Structural Dynamics, 44(12), 2015-2033",
        doi="10.1002/eqe.2571",
    ),
    Reference(
        "Lilliefors1967",
        "Lilliefors, H. W.",
        1967,
        "On the Kolmogorov-Smirnov test for normality with mean and variance unknown",
        "Journal of the American Statistical Association, 62(318), 399-402",
        doi="10.1080/01621459.1967.10482916",
    ),
    Reference(
        "SuWei1991",
        "Su, J. Q. and Wei, L. J.",
        1991,
        "A lack-of-fit test for the mean function in a generalized linear model",
        "Journal of the American Statistical Association, 86(414), 420-426",
        doi="10.1080/01621459.1991.10475059",
    ),
    Reference(
        "Cornell2002",
        "Cornell, C. A. and Jalayer, F. and Hamburger, R. O. and Foutch, D. A.",
        2002,
        "Probabilistic basis for 2000 SAC Federal Emergency Management Agency steel moment frame guidelines",
        "Journal of Structural Engineering, ASCE, 128(4), 526-533",
        doi="10.1061/(ASCE)0733-9445(2002)128:4(526)",
    ),
    Reference(
        "AndrieuRoberts2009",
        "Andrieu, C. and Roberts, G. O.",
        2009,
        "The pseudo-marginal approach for efficient Monte Carlo computations",
        "Annals of Statistics, 37(2), 697-725",
        doi="10.1214/07-AOS574",
    ),
    Reference(
        "Cornuet2012",
        "Cornuet, J.-M. and Marin, J.-M. and Mira, A. and Robert, C. P.",
        2012,
        "Adaptive multiple importance sampling",
        "Scandinavian Journal of Statistics, 39(4), 798-812",
        doi="10.1111/j.1467-9469.2011.00756.x",
    ),
    Reference(
        "Richtmyer1951",
        "Richtmyer, R. D.",
        1951,
        "The evaluation of definite integrals, and a quasi-Monte-Carlo method based on the properties of algebraic numbers",
        "Report LA-1342, Los Alamos Scientific Laboratory",
        kind="techreport",
    ),
    Reference(
        "Brier1950",
        "Brier, G. W.",
        1950,
        "Verification of forecasts expressed in terms of probability",
        "Monthly Weather Review, 78(1), 1-3",
    ),
)
"""In the order in which the program came to rely on them."""
