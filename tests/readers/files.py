"""Small files in the layouts of JMA and NIED, written for tests."""

from __future__ import annotations

import io
import tarfile
from pathlib import Path

JMA_HEADER = (
    "SITE CODE= EA0米子市博労町（旧）        ,35.2733,133.3483,  9,7.3,36805.5627072,  3.62,  6.15\r\n"
    " LAT.=    0.0000\r\n LON.=    0.0000\r\n SAMPLING RATE= 100Hz \r\n UNIT  = gal(cm/s/s) \r\n"
    "INITIAL TIME = 2000 10 06 13 30 10\r\n NS,EW,UD\r\n"
)
JMA_BODY = "-0.018,0.000,-0.017\r\n0.306,-12.345,1.001\r\n306.21,0.5,-7.100\r\n"

KOBE = (
    "SITE CODE= 193,,,,,\r\n LAT.=    34.6967,,,,,\r\n LON.=    135.2100,,,,,\r\n SAMPLING RATE= 50Hz,,,,,,,\r\n"
    " UNIT  = gal(cm/s/s),,,,,,,\r\nINITIAL TIME = 95 01 17 05 47 31,,,,,\r\n NS,EW,UD,,,,,\r\n0,0.03,0,,,,,\r\n-1.5,2.25,3,,,,,\r\n"
)


def knet(
    counts: list[int] | None = None,
    *,
    direction: str = "N-S",
    station: str = "NIG019",
    duration: str | None = None,
    maximum: str | None = None,
    time: str = "2004/10/23 17:56:20",
    **changes: str,
) -> str:
    """Return a K-NET or KiK-net ASCII file; `changes` replaces header values by label."""
    counts = [1000 + (i * 37) % 101 for i in range(200)] if counts is None else counts
    mean = sum(counts) / len(counts) if counts else 0.0
    peak = max((abs(c - mean) for c in counts), default=0.0) * 3920 / 6182761
    values = {
        "Origin Time": "2004/10/23 17:56:00",
        "Lat.": "37.288",
        "Long.": "138.870",
        "Depth. (km)": "13",
        "Mag.": "6.8",
        "Station Code": station,
        "Station Lat.": "37.3054",
        "Station Long.": "138.7900",
        "Station Height(m)": "99",
        "Record Time": time,
        "Sampling Freq(Hz)": "100Hz",
        "Duration Time(s)": duration or f"{len(counts) // 100}",
        "Dir.": direction,
        "Scale Factor": "3920(gal)/6182761",
        "Max. Acc. (gal)": maximum or f"{peak:.3f}",
        "Last Correction": "2004/10/23 17:56:00",
        "Memo.": "",
    } | changes
    header = "".join(f"{label:<18}{value}\n" for label, value in values.items())
    return header + "".join("".join(f"{c:8d} " for c in counts[i : i + 8]) + "\n" for i in range(0, len(counts), 8))


def kik_net(directory: Path, stem: str = "NGNH310011100613") -> Path:
    """Write the six files of a KiK-net station; return their common path without extension."""
    channels = ["NS1", "EW1", "UD1", "NS2", "EW2", "UD2"]
    for number, name in enumerate(channels, start=1):
        counts = [number * 100 + (i * 31) % 57 for i in range(200)]
        (directory / f"{stem}.{name}").write_text(knet(counts, direction=str(number), station="NGNH31"))
    return directory / stem


KNET_CSV = """#K-NET CSV
#Event
#OriginTime,Latitude,Longitude,Depth(km),Magnitude
#2019/01/02 17:47:00,36.708,140.952,32,3.8
#Station
#Code,Latitude,Longitude,Height(m)
#FKS005,37.6389,140.9853,17
#Record
#SamplingFrequency(Hz)
#100
#DurationTime(s)
#60
#Offset
#N-S(gal),E-W(gal),U-D(gal)
#-18.60,-1.40,26.10
#Time,RelativeTime(s),N-S(gal),E-W(gal),U-D(gal)
2019/01/02 17:47:27.00,0.00,-18.56,-1.43,26.00
2019/01/02 17:47:27.01,0.01,-18.60,-1.38,26.11
2019/01/02 17:47:27.02,0.02,-18.63,-1.40,26.10
"""

KIK_CSV = (
    KNET_CSV.replace("#K-NET", "#KiK-net")
    .replace("Height(m)", "Height1(m),Height2(m)")
    .replace("N-S(gal),E-W(gal),U-D(gal)", "1(gal),2(gal),3(gal),4(gal),5(gal),6(gal)")
    .replace("-18.56,-1.43,26.00", "1,2,3,4,5,6")
    .replace("-18.60,-1.38,26.11", "1,2,3,4,5,6")
    .replace("-18.63,-1.40,26.10", "1,2,3,4,5,6")
)


def tar(files: dict[str, bytes], *, mode: str = "w") -> bytes:
    """Return a tar of files, members named ./name; mode ``w:gz`` compresses it."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode=mode) as archive:
        for name, data in files.items():
            member = tarfile.TarInfo(f"./{name}")
            member.size = len(data)
            archive.addfile(member, io.BytesIO(data))
    return buffer.getvalue()
