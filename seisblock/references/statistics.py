"""Bibliography: fragility, risk and statistical inference."""

from __future__ import annotations

from seisblock.references.reference import Reference

STATISTICS = (
    Reference(
        "KornGraubard1998",
        "Korn, E. L. and Graubard, B. I.",
        1998,
        "Confidence intervals for proportions with small expected number of positive counts estimated from survey data",
        "Survey Methodology, 24(2), 193-201",
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
        "Lilliefors1967",
        "Lilliefors, H. W.",
        1967,
        "On the Kolmogorov-Smirnov test for normality with mean and variance unknown",
        "Journal of the American Statistical Association, 62(318), 399-402",
        doi="10.1080/01621459.1967.10482916",
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
        "DelMoral2006",
        "Del Moral, P. and Doucet, A. and Jasra, A.",
        2006,
        "Sequential Monte Carlo samplers",
        "Journal of the Royal Statistical Society: Series B, 68(3), 411-436",
        doi="10.1111/j.1467-9868.2006.00553.x",
    ),
    Reference(
        "Neyman1934",
        "Neyman, J.",
        1934,
        "On the two different aspects of the representative method: the method of stratified sampling and the method of purposive "
        "selection",
        "Journal of the Royal Statistical Society, 97(4), 558-625",
        doi="10.2307/2342192",
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
"""References on statistics."""
