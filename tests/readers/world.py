"""Synthetic files in the layouts of AFAD, UNAM, BHRC, CSMNC, RENADIC and USC, written for tests: no agency's numbers are in them."""

from __future__ import annotations

import numpy as np

from tests.readers.layouts import DT, Rows, fortran

TENTH_G = 98.0665
"""gal."""


def afad(rows: Rows) -> str:
    """Return three components in the layout of AFAD."""
    rows = [np.round(row, 6) for row in rows]
    peaks = " ".join(f"({name}) {np.abs(row - row.mean()).max():.6f}" for name, row in zip(("N-S", "E-W", "U-D"), rows, strict=True))
    head = [
        "STRONG GROUND MOTION RECORDS OF TURKIYE",
        "PLACE                   : SYNTHETIC, NOT A RECORDING",
        "EARTHQUAKE DATE         : 2020/01/02 03:04:00 (GMT)",
        "EPICENTER COORDINATES   : 36.91980N-27.44350E",
        "EARTHQUAKE DEPTH (km)   : 19.44",
        "EARTHQUAKE MAGNITUDE    : 6.5 Mw",
        "STATION ID              : 0000",
        "STATION COORDINATES     : 37.87470N-27.59223E",
        "STATION ALTITUDE (m)    : 66",
        "RECORDER TYPE           : none",
        "RECORDER SERIAL NO      : 1",
        "RECORD TIME             : 02/01/2020 03:04:05.250000 (GMT)",
        f"NUMBER OF DATA          : {len(rows[0])}",
        f"SAMPLING INTERVAL (sec) : {DT}",
        f"RAW PGA VALUES (gal)    : {peaks}",
        "Copyright",
        "NONE",
        "       N-S          E-W          U-D",
    ]
    return "\n".join(head) + "\n" + "".join("".join(f"{x:13.6f}" for x in line) + "\n" for line in zip(*rows, strict=True))


def unam(rows: Rows, *, bearings: str = "/V/N00E/N90E", first: str = "03:04:05.25") -> str:
    """Return up, north and east in the layout of UNAM."""
    north, east, up = (np.round(row, 4) for row in rows)
    columns = (up, north, east)
    n, rule = len(up), "-" * 80
    item = lambda texts: "".join(f"/{text}" for text in texts)  # noqa: E731
    entries = [
        ("ARCHIVO ESTANDAR DE ACELERACION:", None),
        ("VERSION DEL FORMATO", "2.0"),
        ("NOMBRE DE LA ESTACION", "SINTETICA"),
        ("CLAVE DE LA ESTACION", "SYN1"),
        ("COORDENADAS DE LA ESTACION", "16.84851 LAT. N"),
        ("", "99.85157 LONG. W"),
        ("ALTITUD (msnm)", "13"),
        ("NUMERO DE CANALES", "3"),
        ("ORIENTACION C1-C6 (rumbo;orientacion)", bearings),
        ("INTERVALO DE MUESTREO, C1-C6 (s)", item([f"{DT:g}"] * 3)),
        ("FECHA DEL SISMO [GMT]", "2020/01/02"),
        ("HORA EPICENTRO (GMT)", "03:04:00"),
        ("MAGNITUD(ES)", "/M=7.1"),
        ("COORDENADAS DEL EPICENTRO", "18.3353 LAT. N"),
        ("", "98.6763 LONG. W"),
        ("PROFUNDIDAD FOCAL (Km)", "38.5"),
        ("HORA DE LA PRIMERA MUESTRA (GMT)", first),
        ("DURACION DEL REGISTRO (s), C1-C6", item([f"{n * DT:.2f}"] * 3)),
        ("NUM. TOTAL DE MUESTRAS, C1-C6", item([n] * 3)),
        ("ACEL. MAX.(Gal), C1-C6", item([f"{row[np.abs(row).argmax()]:.4f}" for row in columns])),
        ("UNIDADES DE LOS DATOS", "Gal (cm/s/s)"),
        ("FORMATO DATOS (FORTRAN,10 campos/dato)", "3F10.4"),
    ]
    head = ["*" * 80, "                       INSTITUTO DE INGENIERIA, UNAM", "*" * 80]
    head += [key if value is None else f"{key:<39}: {value}" for key, value in entries]
    head += ["=" * 80, "DATOS DE ACELERACION:", rule, "   CANAL-1   CANAL-2   CANAL-3", "         V      N00E      N90E", rule]
    return "\n".join(head) + "\n" + "".join("".join(f"{x:10.4f}" for x in line) + "\n" for line in zip(*columns, strict=True))


def bhrc(rows: Rows, *, azimuths: str = "Azimuth L 324   T 54 ", end: bool = True) -> str:
    """Return the components L, T and V in the layout of BHRC, g/10."""
    longitudinal, transverse, up = (row / TENTH_G for row in rows)
    n = len(up)
    text = "* VOL1DS FILE:  9999/01\nInst Type = none\nOrigin Time : 2020/01/02   03:04:00\n\nL\n" + " " * 70 + "\n"
    for name, row in (("L1", longitudinal), ("V2", up), ("T3", transverse)):
        text += f"COMP {name:<65}\n"
        text += f"Synthetic                 Station   37.485 N 45.891 E   Altitude 1333m   {azimuths}\n"
        text += "Epicenter 38.520 N 46.860 E   FD 12 Km mb      Ms      Mw6.1   M        ML   (NONE   )\n"
        text += "INSTR PERIOD =  .019 SEC   DAMPING =  .640\n"
        text += f"NO. OF POINTS = {n:6d}      DURATION = {n * DT:7.3f}\nUNITS ARE SECONDS AND G/10\n" + " " * 70 + "\n"
        text += fortran([0] * 100, 16, "5d") + fortran([0.0] * 50, 8, "13.6E")
        text += fortran([f"{x:.6E}" for x in row], 10, ">13") + ("/&\n" if end or name != "T3" else "")
    return text


def csmnc(row, component: str = "EW", *, number: int = 1, quantity: str = "ACCELERATION", recorder: str = "2020-01-2 11:04:05.250") -> str:
    """Return one component in the layout of CSMNC; the recorder time may be missing."""
    row = np.round(row, 4)
    at = int(np.abs(row).argmax())
    head = [
        f"065SYN2001021104{number:02}",
        "0200102110400 2020-01-02 11:4:0 BTM",
        "SYNTHETIC EARTHQUAKE, NOWHERE,CHN",
        "EPICENTER  39.939N 77.339E DEPTH 9 KM",
        "MAGNITUDE  4.0(Ms)",
        "STATION: 65SYN 39.700N 77.599E",
        "SITE CONDITION: SOIL",
        "INSTRUMENT TYPE: NONE/NONE",
        "OBSERVING POINT: GROUND",
        f"COMP. {component}",
        f"UNCORRECTED {quantity}          UNIT: CM/SEC{'/SEC' if quantity == 'ACCELERATION' else ''}",
        f"NO. OF POINTS:  {row.size}  EQUALLY SPACED INTERVALS OF:  {DT:.3f}  SEC",
        f"PEAK VALUE:    {row[at]:.3f}   AT   {at * DT:.2f} SEC    DURATION:  {row.size * DT:g} SEC",
        "PRE-EVENT TIME:  20  SEC" + (f"  RECORDER TIME:  {recorder} BTM" if recorder else ""),
        "CSMNC",
        "",
    ]
    cells = [f"{value:13.6E}".replace("E+0", "E").replace("E-0", "E-") for value in row]
    return "\n".join(head) + "\n" + "".join(" ".join(cells[k : k + 8]) + " \n" for k in range(0, len(cells), 8))


def pairs(values, times) -> str:
    """Return pairs of time, s, and acceleration, g/10, five per line, each number in seven columns."""
    return fortran(np.column_stack((times, np.asarray(values) / TENTH_G)).ravel(), 10, "7.3f")


def renadic(rows: Rows, *, times=None) -> str:
    """Return three components in the layout of RENADIC, a volume 1 of CSMIP with pairs of time and acceleration."""
    times = DT * np.arange(len(rows[0])) if times is None else times
    text = ""
    for number, (name, row) in enumerate(zip(("EW", "NS", "UP"), (rows[1], rows[0], rows[2]), strict=True), 1):
        tenths = np.round(row / TENTH_G, 3)
        at = int(np.abs(tenths).argmax())
        text += "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 07/27/2020\nSYNTHETIC, NOT A RECORDING\n"
        text += "01/02/2020 3:04:00 (GMT)                (ORIGIN: 01/02/2020 3:04:00 GMT)\n"
        text += "                                   TRIGGER TIME: 1/02/2020 3:04:05.000 GMT\n"
        text += "STATION NO.          0.000N    0.000E  NONE      S/N  0   (3  CHNS OF 3  AT STA)\nNONE S/N 0\n"
        text += f"CHAN  {number}: {name}       (STA CHN:  {number})\nNOBODY\nHYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00\n"
        text += "INSTR PERIOD = 0.0390 SEC,  DAMPING =0.7000,  SENSITIVITY =1.250 VDC/G\n"
        text += f"NO. OF POINTS = {len(row):6d}  RECORD LENGTH = {times[-1] + DT:.3f} SEC\n"
        text += f"UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  {tenths[at] / 10:.3f} G, AT  {times[at]:.3f} SEC\n"
        text += "RMS ACCEL OF COMPLETE RECORD = 0.004 G\n"
        text += fortran([0] * 100, 16, "5d") + fortran([0.0] * 50, 8, "10.3f") + pairs(row, times)
        text += f"/&  ----------  END OF DATA FOR CHANNEL {number}  ----------\n"
    return text


def _usc_head(name: str, count: int, seconds: float) -> str:
    return (
        "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:                        \nSYNTHETIC EARTHQUAKE   21\n"
        "JAN 2, 2020 -0304 GMT   22\nIBB000  94.000.0 N   18\nSTATION USC# 0061   34 17 11N, 118 13 31W   39\n"
        f"SYNTHETIC STATION   48\nCOMP {name}      9\nSYNTHETIC EARTHQUAKE   JAN 2, 2020 -0304 GMT   46\n"
        "EPICENTER -   34 12 48N, 118 32 13W   35\nINSTR PERIOD =  .039 SEC  DAMPING =   .550  SENSITIVITY =   1.91CM/G    69\n"
        f"NO. OF POINTS = {count:6d}      DURATION = {seconds:7.3f} SEC   50\nUNITS ARE SEC AND G/10   22\n"
        "RMS ACCLN. OF COMPLETE RECORD =     .305 G/10   45\n"
    )


def usc_v1(row, times, *, name: str = "N08W", form: str = "8.3f", margin: str = "") -> str:
    """Return one component in the layout of USC volume 1."""
    numbers = np.column_stack((times, np.asarray(row) / TENTH_G)).ravel()
    pairs_text = "".join(margin + line for line in fortran(numbers, 10, form).splitlines(keepends=True))
    body = fortran([0] * 100, 16, "5d") + fortran([0.0] * 50, 8, "10.3f") + pairs_text
    return _usc_head(name, len(row), times[-1]) + body


def usc_v2(row, *, name: str = "N08W", sign: float = 1.0, states_unit: bool = True, quantities: str = "ACC VEL DIS") -> str:
    """Return one component in the layout of USC volume 2 with some of its quantities; `sign` is that of the header peak."""
    row, n = np.round(row, 3), len(row)
    peak = sign * row[np.abs(row).argmax()]
    text = f"CORRECTED ACCELEROGRAM  IIBB000  94.000.0 COMP {name}   FILE   0  CORRESPONDING T \n" + _usc_head(name, 8820, 37.7)
    text += "ACCELEROGRAM IS BAND-PASS FILTERED BETWEEN  .225- .325 AND 25.00-27.00 HZ.\n"
    text += f"{n:6d}  INSTRUMENT AND BASELINE CORRECTED DATA\nAT EQUALLY-SPACED INTERVALS OF {DT:7.3f}  SEC.\n"
    text += f"PEAK ACCELERATION = {peak:11.5f}  CMS/SEC/SEC AT    4.580   SEC.\nPEAK   VELOCITY   =    12.0  CMS/SEC   AT    4.5   SEC.\n"
    text += "PEAK DISPLACEMENT =     1.42006      CMS     AT    4.580   SEC.\nINITIAL VELOCITY  =      .8344  CMS/SEC;\n"
    text += "SYNTHETIC EARTHQUAKE   JAN 2, 2020 -0304 GMT\nMAGNITUDE =  6.7    EPICENTRAL DISTANCE =  29.76 KM\nIIBB000\nW\n"
    text += fortran([0] * 100, 16, "5d") + fortran([0.0] * 100, 8, "10.3f")
    units = {"ACC": "CM/SEC/SEC", "VEL": "CM/SEC", "DIS": "CM"}
    for quantity, unit in ((quantity, units[quantity]) for quantity in quantities.split()):
        stated = f"  IN UNITS {unit}" if states_unit else ""
        text += f"{n:6d} POINTS OF {quantity} DATA EQUALLY SPACED AT {DT:6.3f} SEC.{stated}\n" + fortran(row, 8, "10.3f")
    return text
