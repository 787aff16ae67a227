"""Bibliography: earthquakes and ground motion."""

from __future__ import annotations

from seisblock.references.reference import Reference

GROUND_MOTION = (
    Reference(
        "JMA2009",
        "Japan Meteorological Agency",
        2009,
        "Tables explaining the JMA Seismic Intensity Scale (in Japanese: Kishocho shindo kaikyu kanren kaisetsuhyo)",
        "Japan Meteorological Agency, Tokyo, https://www.jma.go.jp/jma/kishou/know/shindo/kaisetsu.html",
        kind="techreport",
    ),
    Reference(
        "Boore2003",
        "Boore, D. M.",
        2003,
        "Simulation of ground motion using the stochastic method",
        "Pure and Applied Geophysics, 160(3-4), 635-676",
        doi="10.1007/PL00012553",
    ),
    Reference(
        "Boore2010",
        "Boore, D. M.",
        2010,
        "Orientation-independent, nongeometric-mean measures of seismic intensity from two horizontal components of motion",
        "Bulletin of the Seismological Society of America, 100(4), 1830-1835",
        doi="10.1785/0120090400",
    ),
    Reference(
        "Campbell2003",
        "Campbell, K. W.",
        2003,
        "Prediction of strong ground motion using the hybrid empirical method and its use in the development of ground-motion "
        "(attenuation) relations in eastern North America",
        "Bulletin of the Seismological Society of America, 93(3), 1012-1033",
        doi="10.1785/0120020002",
    ),
    Reference(
        "BooreJoyner1997",
        "Boore, D. M. and Joyner, W. B.",
        1997,
        "Site amplifications for generic rock sites",
        "Bulletin of the Seismological Society of America, 87(2), 327-341",
        doi="10.1785/BSSA0870020327",
    ),
    Reference(
        "AtkinsonSilva2000",
        "Atkinson, G. M. and Silva, W.",
        2000,
        "Stochastic modeling of California ground motions",
        "Bulletin of the Seismological Society of America, 90(2), 255-274",
        doi="10.1785/0119990064",
    ),
    Reference(
        "HanksKanamori1979",
        "Hanks, T. C. and Kanamori, H.",
        1979,
        "A moment magnitude scale",
        "Journal of Geophysical Research, 84(B5), 2348-2350",
        doi="10.1029/JB084iB05p02348",
    ),
    Reference(
        "SaragoniHart1974",
        "Saragoni, G. R. and Hart, G. C.",
        1974,
        "Simulation of artificial earthquakes",
        "Earthquake Engineering and Structural Dynamics, 2(3), 249-267",
        doi="10.1002/eqe.4290020305",
    ),
    Reference(
        "NewmarkHall1982",
        "Newmark, N. M. and Hall, W. J.",
        1982,
        "Earthquake spectra and design",
        "Earthquake Engineering Research Institute, Oakland, California",
        kind="book",
    ),
    Reference(
        "FEMAP58",
        "Applied Technology Council",
        2018,
        "Seismic performance assessment of buildings, volume 3: supporting electronic materials, fragility database 3.1.2",
        "FEMA P-58-3, Federal Emergency Management Agency, Washington, D.C.",
        kind="techreport",
    ),
    Reference(
        "Chopra2012",
        "Chopra, A. K.",
        2012,
        "Dynamics of structures: theory and applications to earthquake engineering",
        "Prentice Hall, 4th edition",
        kind="book",
    ),
    Reference(
        "JMA2016",
        "Japan Meteorological Agency",
        2016,
        "Zettai sokudo outou keisan no kaizen ni tsuite (On the improved computation of absolute velocity responses), 7th meeting of the "
        "panel on information on long-period ground motion, document 2",
        "Tokyo (in Japanese)",
        kind="techreport",
    ),
)
"""References on synthetic records, floor motion, long-period ground motion and furniture."""
