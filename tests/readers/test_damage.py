"""However a file is damaged, the answer is a record or one sentence of ours, never a traceback."""

from __future__ import annotations

import io

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from seisblock.core.errors import InputError
from seisblock.readers import read
from tests.readers.files import JMA_BODY, JMA_HEADER, KIK_CSV, KNET_CSV, KOBE, knet, tar

AT2 = "PEER\nEvent, 1/1/2000, Place, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  6, DT= .0100 SEC\n.1 .2 .3 .4 .5\n.6\n"
TABLE = "time,NS (gal),EW (gal)\n" + "".join(f"{i / 100:.2f},{i},2\n" for i in range(20))
FULL = {
    "jma": (JMA_HEADER + JMA_BODY).encode("cp932"),
    "kobe": KOBE.encode(),
    "knet": knet().encode(),
    "knet-csv": KNET_CSV.encode(),
    "kik-csv": KIK_CSV.encode(),
    "at2": AT2.encode(),
    "table": TABLE.encode(),
    "bundle": tar({"a.NS": knet().encode()}, mode="w:gz"),
}
SPOILERS = [b"", b"\n", b",", b"nan", b"-1e999", b"\x00", b"\xff", b"#", b'"', b"=", b"0", b"x"]


@pytest.mark.parametrize("kind", FULL)
@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_damaged_file_gives_record_or_input_error(tmp_path, kind, data):
    """Cut anywhere, spoilt anywhere, bytes lost anywhere: a record, or an InputError in one line that names the file."""
    full = FULL[kind]
    start = data.draw(st.integers(0, min(len(full), 1200)), label="from")
    missing = data.draw(st.integers(0, 40), label="lost")
    cut = data.draw(st.sampled_from([None, start + 1]), label="cut")
    damaged = (full[:start] + data.draw(st.sampled_from(SPOILERS), label="spoiler") + full[start + missing :])[:cut]
    _try(tmp_path, damaged)


@given(damaged=st.binary(max_size=300))
@example(damaged=b"SITE CODE3\n SAMPLING RATE= 100Hz\nUNIT=gal\nINITIAL TIME = 2000 10 06 13 30 10\nNS,EW,UD\n1,2,3\n4,5,6\n")
@example(damaged=KOBE.split("0,0.03")[0].encode() + b",,,\n,,,\n")
@example(damaged=b"time,,2\n0.01,1,2\n0.02,1,2\n")
@example(damaged=KIK_CSV.replace("#Time,RelativeTime", "#Time RelativeTime").encode())
@example(damaged=(JMA_HEADER.replace("36805.5627072", "36805.56E70") + JMA_BODY).encode("cp932"))
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_random_bytes_give_record_or_input_error(tmp_path, damaged):
    """Any bytes at all, and some that once were: a record or an InputError."""
    _try(tmp_path, damaged)


def _try(directory, damaged):
    """Read bytes; check that any exception belongs to the package and names the file."""
    path = directory / "damaged"
    path.write_bytes(damaged)
    try:
        assert read(path).samples >= 2
    except InputError as error:
        assert "damaged" in str(error)
        assert "\n" not in str(error)


def test_plugins_reject_damaged_streams():
    """The plugins raise ours as well."""
    from seisblock.readers import obspy_plugins

    with pytest.raises(InputError):
        obspy_plugins.read_jma_csv(io.BytesIO(JMA_HEADER.encode("cp932")))
