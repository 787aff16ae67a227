"""ObsPy reads JMA CSV, K-NET CSV, AT2, CSMIP, COSMOS, SMC, ESM, GeoNet and CWA through the plugins, and they claim nothing else."""

from __future__ import annotations

import importlib.util
import io
from pathlib import Path

import numpy as np
import obspy
import pytest
from obspy.core.util.base import ENTRY_POINTS, buffered_load_entry_point

from seisblock.readers import obspy_plugins, read
from seisblock.readers.registry import list_formats
from seisblock.samples import sample_path
from tests.fuzz.formats import FORMATS
from tests.readers.files import JMA_BODY, JMA_HEADER, KIK_CSV, KNET_CSV, KOBE, knet

AT2 = "PEER\nEvent, 1/1/2000, Place, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  3, DT= .0100 SEC\n.1 .2 .3\n"
OURS = {
    "jma": ((JMA_HEADER + JMA_BODY).encode("cp932"), obspy_plugins.is_jma_csv, obspy_plugins.read_jma_csv),
    "kobe": (KOBE.encode("cp932"), obspy_plugins.is_jma_csv, obspy_plugins.read_jma_csv),
    "knet-csv": (KNET_CSV.encode(), obspy_plugins.is_knet_csv, obspy_plugins.read_knet_csv),
    "kik-csv": (KIK_CSV.encode(), obspy_plugins.is_knet_csv, obspy_plugins.read_knet_csv),
    "at2": (AT2.encode(), obspy_plugins.is_at2, obspy_plugins.read_at2),
    "csmip": (FORMATS["csmip-v2"].data, obspy_plugins.is_csmip, obspy_plugins.read_csmip),
    "cosmos": (FORMATS["cosmos"].data, obspy_plugins.is_cosmos, obspy_plugins.read_cosmos),
    "smc": (FORMATS["smc"].data, obspy_plugins.is_smc, obspy_plugins.read_smc),
    "esm": (FORMATS["esm"].data, obspy_plugins.is_esm, obspy_plugins.read_esm),
    "cwa": (FORMATS["cwa"].data, obspy_plugins.is_cwa, obspy_plugins.read_cwa),
    "geonet": (FORMATS["geonet-v1"].data, obspy_plugins.is_geonet, obspy_plugins.read_geonet),
}
CLAIMS = {claims for _, claims, _ in OURS.values()}


@pytest.mark.parametrize("kind", OURS)
def test_files_are_detected_by_their_plugin_only(tmp_path, kind):
    """Of our plugins one claims it, as a path and as a stream; none of ObsPy's formats before ours does."""
    data, claims, _ = OURS[kind]
    path = tmp_path / "AA06EA01.csv"
    path.write_bytes(data)
    assert {c for c in CLAIMS if c(str(path))} == {claims}
    assert claims(path)
    stream = io.BytesIO(data)
    assert claims(stream)
    assert stream.tell() == 0
    for name, entry in ENTRY_POINTS["waveform"].items():
        if entry.dist.name == "obspy" and name != "PICKLE":
            is_format = buffered_load_entry_point("obspy", f"obspy.plugin.waveform.{name}", "isFormat")
            assert not is_format(str(path)), name


def test_plugins_detect_no_other_files(tmp_path):
    """None of ObsPy's own example files, nor a K-NET ASCII file, nor a note, is claimed."""
    root = Path(obspy.__file__).parent / "io"
    (tmp_path / "note.txt").write_text("SITE CODE is what the header of a JMA file begins with")
    (tmp_path / "a.NS").write_text(knet())
    (tmp_path / "velocity.vt2").write_text(AT2.replace("ACCELERATION", "VELOCITY"))
    candidates = [*root.glob("*/tests/data/*"), *tmp_path.iterdir()]
    assert len(candidates) > 50
    claimed = [str(p) for p in candidates if p.is_file() for claims in CLAIMS if claims(str(p))]
    assert claimed == []


@pytest.mark.parametrize("kind", OURS)
def test_plugin_streams_are_in_m_s2_with_header(tmp_path, kind):
    """Samples are those of `read`, in m/s^2, calib 1, starts in UTC, the header under the format's name."""
    data, _, reads = OURS[kind]
    path = tmp_path / "record"
    path.write_bytes(data)
    record, stream = read(path), reads(str(path))
    assert all(trace.stats.calib == 1.0 for trace in stream)
    channel = record.codes[0] + ("2" if kind == "kik-csv" else "")
    trace = next(t for t in stream if t.stats.channel == channel)
    np.testing.assert_array_equal(trace.data, record.components[0].acceleration)
    assert trace.stats.delta == record.dt
    if record.start is not None:
        assert trace.stats.starttime == obspy.UTCDateTime(record.start)
    key = kind.replace("kik", "knet").replace("-", "").replace("kobe", "jma").replace("jma", "jmacsv")
    assert trace.stats[key]["unit"] == "m/s2"
    repeat = reads(io.BytesIO(data))
    assert len(repeat) == len(stream)
    trace.data += 1.0  # a stream is the caller's own


def test_entry_points_can_be_imported():
    """The plugins that a build declares are those of the registered formats, and each name can be imported."""
    root = Path(__file__).parents[2]
    specification = importlib.util.spec_from_file_location("hatch_build", root / "hatch_build.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    metadata = {}
    module.Plugins(str(root), {}).update(metadata)
    groups = metadata["entry-points"]
    assert set(groups["obspy.plugin.waveform"]) == {item.obspy_name for item in list_formats() if item.plugin}
    for name in groups["obspy.plugin.waveform"]:
        for target in groups[f"obspy.plugin.waveform.{name}"].values():
            module_name, function = target.split(":")
            assert callable(getattr(importlib.import_module(module_name), function))


def test_obspy_read_uses_installed_plugins():
    """In an environment with seisblock installed, obspy.read takes a JMA CSV by itself."""
    if "JMACSV" not in ENTRY_POINTS["waveform"]:
        pytest.skip("seisblock is not installed here, so ObsPy cannot know its entry points")
    stream = obspy.read(str(sample_path("synthetic_jma.csv")))
    assert [t.stats.channel for t in stream] == ["NS", "EW", "UD"]
    assert stream[0].stats._format == "JMACSV"
