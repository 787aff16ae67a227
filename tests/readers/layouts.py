"""Synthetic files in the layouts of CSMIP, COSMOS, SMC, ESM, GeoNet and CWA, written for tests: no agency's numbers are in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

Rows = Sequence[np.ndarray]
"""Components, gal."""

DT = 0.01


def fortran(values, item: int, form: str) -> str:
    """Return numbers in lines of so many, each printed as Fortran does, without a zero before the point where there is no room."""
    cells = [format(value, form) for value in values]
    return "".join("".join(cells[i : i + item]).rstrip(" ") + "\n" for i in range(0, len(cells), item))


def _peak(row) -> tuple[float, float]:
    """Return the largest sample and its time."""
    at = int(np.abs(row).argmax())
    return float(row[at]), at * DT


def smc(
    row, *, title: str = "2 CORRECTED ACCELEROGRAM", azimuth: int = 360, vertical: int = 90, place: str = "", floor: int = -32768
) -> str:
    """Return one component in the layout of SMC, samples of five digits."""
    row = np.array([float(f"{x:.4E}") for x in row])
    text = [
        title,
        "*",
        "SYN1A",
        "     2020   1   2    0304 Synthetic earthquake, NOT a recording",
        "Moment Mag=      6.1 Ms=          Ml=",
        f"station = Synthetic, 1 Test Street{place:<8} component=    {azimuth}",
        f"epicentral dist =     12.0       pk     ={np.abs(row).max():9.1f}",
        "inst type=none       data source = SYNTHETIC",
        "*",
        "*",
        "*",
    ]
    integers = [-32768] * 48
    integers[1:8] = [2020, 2, 3, 4, 5, 250, 111]
    integers[8:17] = [1, 3, 3, -32768, vertical, azimuth, 101, 1, len(row)]
    integers[24], integers[29] = floor, 4711
    reals = [1.7e38] * 50
    reals[1:6] = [1 / DT, 37.0, -121.5, 10.0, 6.1]
    reals[10:12], reals[16] = [37.1, -121.6], 12.0
    reals[28:32] = [DT * row.argmax(), row.max(), DT * row.argmin(), row.min()]
    head = (
        "".join(f"{line:<80}\r\n" for line in text)
        + fortran(integers, 8, "10d")
        + fortran(reals, 5, "15.7E")
        + "|synthetic, NOT a recording\n"
    )
    # E+01 has one digit of exponent in these files
    cells = [f"{x:11.4E}".replace("E+0", "E+").replace("E-0", "E-") for x in row]
    return head + "".join("".join(cells[i : i + 8]) + "\n" for i in range(0, len(cells), 8))


def esm(row, *, stream: str = "HNE", data: str = "ACCELERATION") -> str:
    """Return one component in the layout of ESM."""
    row = np.round(row, 6)
    peak, at = _peak(row)
    keys = {
        "EVENT_NAME": "SYNTHETIC, NOT A RECORDING",
        "EVENT_ID": "SYN-1",
        "EVENT_DATE_YYYYMMDD": "20200102",
        "EVENT_TIME_HHMMSS": "030400",
        "EVENT_LATITUDE_DEGREE": "38.1000",
        "EVENT_LONGITUDE_DEGREE": "23.5400",
        "EVENT_DEPTH_KM": "9.0",
        "MAGNITUDE_W": "",
        "MAGNITUDE_L": "4.6",
        "NETWORK": "SY",
        "STATION_CODE": "SYN1",
        "STATION_NAME": "Δοκιμή",
        "STATION_LATITUDE_DEGREE": "37.634900",
        "STATION_LONGITUDE_DEGREE": "22.729300",
        "STATION_ELEVATION_M": "34",
        "LOCATION": "",
        "EPICENTRAL_DISTANCE_KM": "88.1",
        "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": "20200102_030405.250",
        "SAMPLING_INTERVAL_S": f"{DT:.6f}",
        "NDATA": str(len(row)),
        "DURATION_S": f"{len(row) * DT:.3f}",
        "STREAM": stream,
        "UNITS": "cm/s^2",
        "PGA_CM/S^2": f"{peak:.6f}",
        "TIME_PGA_S": f"{at:.6f}",
        "DATA_TYPE": data,
        "USER5": "",
    }
    return "".join(f"{key}: {value}\n" for key, value in keys.items()) + "".join(f"{x:.6f}\n" for x in row)


def cwa(rows: Rows, *, event: bool = True, sequence: str = "Time U(+); N(+); E(+)") -> str:
    """Return north, east and up in the layout of CWA: of its data centre, in local time, or of single files, in UTC."""
    north, east, up = (np.round(row, 3) for row in rows)
    zone, hours = ("(GMT+08)", 11) if event else ("", 3)
    text = [
        "Earthquake Information, SYNTHETIC, NOT a recording",
        f"Origin Time{zone}: 2020/01/02-{hours:02d}:04:00",
        "EpicenterLongitude(E): 121.69",
        "EpicenterLatitude(N):  24.14",
        "Depth(km): 10.0",
        "Magnitude(Ml): 6.1",
        "Station Information",
        "StationLongitude(E): 121.092",
        "StationLatitude(N): 22.860",
        "StationName: Test Town Hall",
    ]
    record = [
        "StationCode: SYN1",
        "InstrumentKind: none(SYNTHETIC)",
        f"StartTime{zone}: 2020/01/02-{hours:02d}:04:05.250 ",
        f"RecordLength(sec): {len(up) * DT:8.3f}",
        f"SampleRate(Hz): {1 / DT:.0f}",
        "AmplitudeUnit:  gal. DCoffset(corr)",
        *(f"AmplitudeMAX. {name}:{row.max():9.3f}~{row.min():9.3f}" for name, row in zip("UNE", (up, north, east), strict=True)),
        f"DataSequence: {sequence}",
        "Data: 4F10.3 ",
    ]
    holding = {"Time": DT * np.arange(len(up)), "U": up, "N": north, "E": east}
    columns = [holding[name] for name in sequence.replace("(+)", "").replace(";", "").split()]
    body = "".join("".join(f"{x:10.3f}" for x in row) + "\n" for row in zip(*columns, strict=True))
    return "".join(f"#{line}\n" for line in ((text if event else []) + record)) + body


def geonet(rows: Rows, *, volume: int = 1, names: Sequence[str] = ("N10E", "N80W", "Up")) -> str:
    """Return components in the layout of GeoNet, mm/s^2; volume 2 with velocities and displacements, of other lengths."""
    return "".join(_geonet(np.round(10.0 * row, 1), name, volume) for row, name in zip(rows, names, strict=True))


def _geonet(row, name: str, volume: int) -> str:
    """Return one component."""
    peak, at = _peak(row)
    size = len(row)
    text = [
        f"{'Uncorrected' if volume == 1 else 'Corrected'} accelerogram 20200102_030400_SYN1_20 GNS Science layout, SYNTHETIC",
        "Site SYN1      42 31 12S  172 49 48E     Synthetic, NOT a recording",
        "Test Town Hall",
        "Instrument none",
        "Resolution: 24-bit   Instr Period: 0.0050 s   Damping: 0.700",
        "Accelerogram 20200102_030400_SYN1_20                 Processed 2020 January 03",
        "5 km south-west of Nowhere",
        "2020 January 02         03:04:00 UT",
        "Epicentre  42 41 24S 173 01 12E  Bearing S40E  Dist   25km  Depth   15km Mw 6.10",
        f"Number of points  {size}    Duration {size * DT:.2f} s",
        f"Raw readings in units of 1.00 mm/s/s  at intervals of {DT:.3f} s",
        "Data is unfiltered",
        f"Component {name}",
        f"Acceleration:  Peak   {peak:.1f} mm/s/s at {at:6.2f} s     RMS   {np.sqrt((row**2).mean()):.2f} mm/s/s",
        "Velocity record",
        "Displacement record",
    ]
    integers = [0] * 40
    integers[8:10], integers[18:20], integers[38:40] = [2020, 1], [2, 3], [4, 5250]
    integers[33:36] = [size, *((size - 1, size - 12) if volume == 2 else (0, 0))]
    reals = [0.0] * 60
    reals[24:26] = [0.005, DT]
    body = [fortran(part, 10, "8.1f") for part in (row, row[: integers[34]] / 10, row[: integers[35]] / 100)]
    return "".join(f"{line}\n" for line in text) + fortran(integers, 10, "8d") + fortran(reals, 10, "8.4f") + "".join(body)


def _bare(value: float, width: int, decimals: int) -> str:
    """Return a number without the zero before its point."""
    text = f"{value:.{decimals}f}"
    return (text.replace("0.", ".", 1) if abs(value) < 1 else text).rjust(width)


def csmip(rows: Rows, *, volume: int = 2, names: Sequence[str] = ("90 Deg", "360 Deg", "Up"), places: Sequence[str] = ()) -> str:
    """Return channels in the layout of CSMIP, one behind the other; volume 2 in cm/s^2 with velocities and displacements, volume 1 in g."""
    place = places or [""] * len(names)
    return "".join(_csmip(row, i + 1, names[i], place[i], volume, len(rows)) for i, row in enumerate(rows))


def _csmip(row, number: int, name: str, place: str, volume: int, count: int) -> str:
    """Return one channel."""
    size = len(row)
    row = np.round(row / 980.665, 6) if volume == 1 else np.round(row, 3)
    peak, at = _peak(row)
    about = [
        "SYNTHETIC EARTHQUAKE, NOT A RECORDING",
        "JANUARY 1, 2020 19:04 PST               (ORIGIN(SYN): 01/02/20, 03:04:00.5 UTC)",
        "00001-S0001-20002.01               TRIGGER TIME: 01/01/20, 19:04:05.2 PST",
        f"STATION NO. 00001   35.908N, 120.458W     NONE   S/N 0001  ({count} Chns of {count:2d} at Sta)",
        "TEST TOWN - CITY HALL                     SYN",
        f"CHAN {number:2d}: {name}      {place}",
        "SYNTHETIC EARTHQUAKE    JANUARY 1, 2020 19:04 PST",
        "HYPOCENTER(SYN): 36.25N,120.28W, H=9KM.                ML=6.5(SYN), MW=6.1(SYN)",
        "INSTR PERIOD =  .0407 SEC,  DAMPING =  .630,  SENSITIVITY = 1.87 CM/G.",
    ]
    numbers = [0] * 100
    if volume == 1:
        text = [
            "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/03/20, SYNTHETIC",
            *about,
            f"NO. OF POINTS = {size:6d}  RECORD LENGTH = {size * DT:.3f} SEC   AT 100 SAMPLES/SEC",
            f"UNITS OF UNCOR ACCEL IS G.                 MAX  = {_bare(peak, 7, 3)} G, AT {at:7.3f} SEC.",
            "RMS ACCEL OF COMPLETE RECORD =  .008 G.",
        ]
        head = f"{size} POINTS OF ACCEL DATA EQUALLY SPACED AT .010 SEC.  (UNITS: G)\n"
        body = head + _lines(row, 9, 6)
        reals = [0.0] * 50
    else:
        text = [
            f"CORRECTED ACCELEROGRAM   00001-S0001-20002.01       CHAN {number:2d}: {name}     FROM",
            "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/03/20, SYNTHETIC",
            *about,
            f"                        RECORD LENGTH = {size * DT:.3f} SEC.",
            "                                     UNCOR MAX  =  -.275 G, AT  10.947 SEC.",
            "RMS ACCEL OF (UNCOR) RECORD  =  .030 G.",
            "ACCELEROGRAM BANDPASS FILTERED WITH RAMPS AT  .050- .100 AND 23.00-25.00 CYC/SEC",
            f"{size:6d} POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA",
            "AT EQUALLY-SPACED INTERVALS OF    .010  SEC.",
            f"PEAK ACCELERATION = {_bare(peak, 9, 3)}    CM/SEC/SEC  AT {at:8.3f}   SEC.",
            "PEAK   VELOCITY   =   -28.253      CM/SEC    AT   11.100   SEC.",
            "PEAK DISPLACEMENT =     5.449        CM      AT    7.660   SEC.",
            "INITIAL VELOCITY  =     -.052   CM/SEC;   INITIAL DISPLACEMENT =    -.110   CM",
            "SYNTHETIC EARTHQUAKE",
            "",
            f"00001-S0001-20002.01      TEST TOWN - CITY HALL   CHAN {number:2d}: {name}",
            "",
        ]
        parts = (("ACCEL", "CM/SEC/SEC", row), ("VELOC", "CM/SEC", row[1:] / 10), ("DISPL", "CM", row[2:] / 100))
        body = "".join(
            f"{len(part):5d} POINTS OF {word} DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: {unit})\n" + _lines(part, 10, 3)
            for word, unit, part in parts
        )
        reals = [0.0] * 100
    header = "".join(f"{line}\n" for line in text) + fortran(numbers, 16, "5d") + fortran(reals, 8, "10.3f")
    return header + body + f"/&  ----------  END OF DATA FOR CHANNEL {number:2d}  ----------\n"


def _lines(values, width: int, decimals: int) -> str:
    """Return numbers eight to a line, without zeros before the point."""
    cells = [_bare(value, width, decimals) for value in values]
    return "".join("".join(cells[i : i + 8]) + "\n" for i in range(0, len(cells), 8))


def cosmos(
    row,
    *,
    title: str = "Corrected acceleration",
    level: int = 2,
    unit: int = 4,
    azimuth: int = 340,
    structure: int = 4,
    place: str = "",
    seed: str = "",
) -> str:
    """Return one channel in the layout of COSMOS."""
    row = np.round(row, 5)
    peak, at = _peak(row)
    text = [
        f"{title}    (Format v01.20 with 13 text lines) Src: synthetic.txt",
        "Record of Synthetic Earthquake of Thu Jan 2, 2020 03:04 UTC",
        "Hypocenter: 34.0580  -117.0110  H= 12km(SYN) ML=4.9, Mw=4.8(SYN)",
        "Origin: 01/02/2020, 03:04:00.5 UTC (SYN)",
        "Statn No: 05-00001  Code:SY-SYN1   SYN  Test Town - City Hall",
        "Coords: 34.0460 -117.0350  Site Geology: unknown",
        "Recorder: none      ( 1 Chns of  3 at Sta) Sensor: none",
        "Rcrd start time:01/02/2020, 03:04:05.250 UTC (Q=5) RcrdId: SYNTHETIC",
        f"Sta Chan  1: 340 deg (Rcrdr Chan  1) Location: {place}",
        "Raw record length =  6.000  sec, Uncor max =   -.167 g  at    2.850 sec",
        f"Processed: 01/03/2020, 12:01:00 PST      Max = {peak:10.3f} cm/sec2  at {at:7.3f} sec",
        "Record filtered below 0.30  Hz (periods over  14.5 secs), and above 40.0 Hz",
        "Values used when parameter or data value is unknown/unspecified:   -999, -999.0",
    ]
    integers = [-999] * 100
    integers[:4] = [level, 1, unit, 120]
    integers[18], integers[53] = structure, azimuth
    integers[39:45] = [2020, 2, 1, 2, 3, 4]
    reals = [-999.0] * 100
    reals[:3], reals[9:15] = [34.046, -117.035, 15.0], [34.058, -117.011, 12.0, 4.8, -999.0, 4.9]
    reals[16], reals[29], reals[61:65] = 2.6, 5.25, [1000 * DT, len(row) * DT, peak, at]
    comments = [f"|<SCNL>SYN1.{seed}.SY.--", "| synthetic, NOT a recording"]
    return (
        "".join(f"{line}\n" for line in text)
        + " 100 Integer-header values follow on  10 lines, Format= (10I8)\n"
        + fortran(integers, 10, "8d")
        + " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n"
        + fortran(reals, 6, "13.6f")
        + '  2 Comment line(s) follow, each starting with a "|":\n'
        + "".join(f"{line}\n" for line in comments)
        + f"{len(row):7d}  acceleration pts, approx    6 secs, units=cm/sec2({unit:02d}),Format=(8F10.5)\n"
        + fortran(row, 8, "10.5f")
        + "/&  ----------  End of data for channel  1  ----------\n"
    )
