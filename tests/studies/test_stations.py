"""An earthquake's stations: each measured and judged by itself, the worst first; what fails costs only itself."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.two_layer import Contact, load_two_layer
from seisblock.core.errors import ParameterError
from seisblock.measures import measure
from seisblock.models.jump.options import JumpOptions
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import solve_respond
from seisblock.models.rock.options import RockOptions
from seisblock.models.slide.options import SlideOptions
from seisblock.models.stack.options import StackOptions
from seisblock.models.uplift.options import UpliftOptions
from seisblock.readers import read, read_all
from seisblock.readers.discover import iter_records
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read_source
from seisblock.records import Component, Preparation, Record, motion_of
from seisblock.studies.assessment import assess_record as assess_body
from seisblock.studies.azimuth_probability import rank_by_probability
from seisblock.studies.batch.run import run_batch
from seisblock.studies.map.station_response import StationBody, StationCemetery
from seisblock.studies.map.stations import survey_stations
from seisblock.studies.respond.azimuths import respond_directions
from seisblock.studies.sampling import ParameterVariation, sample
from seisblock.studies.survey.assessment import AssessmentMethod, assess_cemetery, assess_record
from seisblock.studies.survey.shaking import component_shakings
from tests.stations import bundle, station_files

STONE = of_kind(Block(0.24, 0.8), "gravestone")
BODY = StationBody(STONE, RespondOptions(mu=0.6), runs=20)


@pytest.fixture(scope="module")
def event(tmp_path_factory):
    """Return the path of a bundle of eight stations, of which one is cut in half."""
    return bundle(tmp_path_factory.mktemp("event") / "event.knt.tar.gz", 8, damaged=(3,))


@pytest.fixture(scope="module")
def station_results(event):
    """Return those stations with a block at each."""
    return survey_stations(event, BODY)


def prepared_record(event, station):
    """Return the record of one station of a bundle, as it is judged."""
    recording = next(item for item in iter_records([str(event)], ReadOptions()) if item.name.startswith(station))
    return Preparation().apply(read_source(recording, ReadOptions()))


def test_damaged_station_fails_alone(station_results):
    """Seven stations are answered and one is named with its reason, last."""
    assert [answer.failure is None for answer in station_results.answers] == [True] * 7 + [False]
    assert "SYA003" in station_results.answers[-1].record and "file truncated" in station_results.answers[-1].failure
    assert len(station_results.mapped) == 7


def test_two_earthquakes_are_detected_behind_incomplete_header():
    """A record with a magnitude alone is accepted; the records of two earthquakes are rejected."""
    values = ({}, {"event_latitude_deg": 35.0, "event_longitude_deg": 139.0}, {"event_latitude_deg": 38.0, "event_longitude_deg": 143.0})
    row = np.sin(np.arange(200.0))
    records = [Record([Component("NS", row)], 0.01, metadata={"magnitude": 7.0, **item}) for item in values]
    with pytest.raises(ParameterError, match="two earthquakes"):
        survey_stations(records)
    assert survey_stations(records[:2]).earthquake.latitude_deg == 35.0


def test_stations_sort_worst_first(station_results):
    """By the share that falls, then the verdict, then the way, then the shaking."""
    items = [(answer.effect.severity, answer.pga_m_s2) for answer in station_results.answers[:-1]]
    assert items == sorted(items, reverse=True)
    assert station_results.answers[0].effect.probability > 0.0 and station_results.answers[-2].effect.probability == 0.0


def test_station_equals_measure_and_respond(event, station_results):
    """Peaks and intensity are those of `measure`, the fate that of `respond` in the direction of the largest probability."""
    answer = station_results.answers[0]
    record = prepared_record(event, answer.station)
    measures = measure(record)
    horizontal = [m for m in measures.components if m.component != "UD"]
    assert answer.pga_m_s2 == max(m.pga_m_s2 for m in horizontal)
    assert answer.pgv_m_s == pytest.approx(max(m.pgv_m_s for m in horizontal), rel=1e-12)
    assert answer.jma_intensity == measures.jma_intensity
    options = RespondOptions(mu=0.6)
    coarse = [row for row in respond_directions(STONE, record, options) if row.moves and row.azimuth_deg % 15.0 == 0.0]
    worst = rank_by_probability("respond", STONE, record, coarse, options, 20, ParameterVariation())[0]
    assert worst.overturning_probability == max(
        sample("respond", STONE.block_toward(row.azimuth_deg), motion_of(record, f"{row.azimuth_deg:g}"), options, 20).probability
        for row in coarse
    )
    assert (answer.effect.azimuth_deg, answer.effect.max_slip_m) == (worst.azimuth_deg, worst.max_displacement_m)
    single = solve_respond(STONE, motion_of(record, f"{worst.azimuth_deg:g}"), mu=0.6).outcome
    assert single.overturned == answer.effect.overturned


FOLLOWED = {
    "rock": StationBody(Block(0.24, 0.8), RockOptions(), runs=5, solver="rock"),
    "slide": StationBody(SlidingBase(0.2), SlideOptions(), solver="slide"),
    "jump": StationBody(load_two_layer("chozusha"), JumpOptions(contact=Contact(0.18)), solver="jump"),
    "uplift": StationBody(SpringBlock.from_frequency(1.2, 1.2, 3.0, frequency_vertical=8.0, beta=0.7), UpliftOptions(), solver="uplift"),
}
"""A body for each solver."""

EFFECTS = {
    "rock": lambda row: (row["overturned"], row["overturned"], None, None, None),
    "slide": lambda row: (row["slips"], None, None, row["max_slip_m"], None),
    "jump": lambda row: (row["outcome"] == "jumped", "overturned" in row["outcome"], None, abs(row["total_displacement_m"]), None),
    "uplift": lambda row: (row["uplifts"], None, None, None, row["max_uplift_m"]),
}
"""What a row of a batch comes to at a station: happened, overturned, probability, way, rise."""


@pytest.mark.parametrize("solver", FOLLOWED)
def test_stations_of_every_solver_equal_batch(event, solver):
    """The worst station's result is the worst row of a batch of its record."""
    subject = FOLLOWED[solver]
    strong = Preparation(scale=3.0)
    answer = survey_stations(event, subject, preparation=strong).answers[0]
    recording = next(item for item in iter_records([str(event)], ReadOptions()) if item.name.startswith(answer.station))
    record = read_source(recording, ReadOptions())
    components = "all-azimuths" if subject.is_directional else ()
    options = {**subject.options.keywords(), "runs": subject.runs, "preparation": strong}
    table = run_batch(record, {"it": subject.body}, solver, components=components, **options)
    effects = {row["component"]: EFFECTS[solver](row) for row in table.rows}
    effect = answer.effect
    expected = (effect.happened, effect.overturned, None, effect.max_slip_m, effect.max_uplift_m)
    if subject.runs:  # objects are counted: the share is that under any horizontal
        processed = strong.apply(record)
        single = assess_body(solver, subject.body, processed, subject.options, subject.runs)
        assert (effect.probability, effect.assessment) == (single.overturning_probability, single)
    name = {0.0: "NS", 90.0: "EW"}[effect.azimuth_deg] if components == () else f"{effect.azimuth_deg:g}"
    assert effect.happened and expected == effects[name]
    assert expected == max(effects.values(), key=lambda text: tuple(value or 0.0 for value in text))


def test_survey_stations_rejects_unsupported_options():
    """A solver that follows no body, and versions where there are none, in one sentence."""
    with pytest.raises(ParameterError, match="'stack' is not available for stations"):
        StationBody(Block(0.24, 0.8), StackOptions(), solver="stack")
    with pytest.raises(ParameterError, match="slide does not support samples"):
        StationBody(0.2, SlideOptions(), runs=5, solver="slide")


def test_cemetery_rate_of_station_equals_that_of_its_record(event):
    """Stones without dowels are simulated as in `overturn-rate`: those that either horizontal overturns; with dowels by the criterion."""
    cemetery = read_cemetery("aoyama.csv")
    answer = survey_stations(event, StationCemetery(cemetery)).answers[0]
    record = prepared_record(event, answer.station)
    rates = assess_record(cemetery, component_shakings(record, ("NS", "EW")), AssessmentMethod("simulate", runs=8))
    assert answer.effect.rate == rates[-1].rate > 0.0
    assert StationCemetery(cemetery.with_dowels()).assessment.criterion == "furukawa"


def test_cemetery_rate_is_worst_over_azimuths(event):
    """The rate is at least that of either component, and that of `overturn-rate` towards its azimuth."""
    cemetery = read_cemetery("aoyama.csv")
    answer = survey_stations(event, StationCemetery(cemetery, AssessmentMethod())).answers[0]
    record = prepared_record(event, answer.station)
    rates = [assess_cemetery(cemetery, shaking, AssessmentMethod()).rate for shaking in component_shakings(record, ("NS", "EW"))]
    assert answer.effect.rate >= max(rates) > 0.0
    (towards,) = component_shakings(record, (f"{answer.effect.azimuth_deg:g}",))
    assert assess_cemetery(cemetery, towards, AssessmentMethod()).rate == answer.effect.rate


def test_survey_stations_is_independent_of_thread_count(event, station_results):
    """One worker gives the same stations in the same order."""
    repeat = survey_stations(event, BODY, workers=1)
    assert repeat == station_results


@pytest.mark.parametrize("code", ["SYA005", " sya005 "])
def test_survey_stations_selects_one_station(event, tmp_path, code):
    """Of a bundle and of a folder; what cannot be read is named all the same."""
    for name, data in {**station_files(4), **station_files(5)}.items():
        (tmp_path / name).write_bytes(data)
    (first, damaged) = survey_stations(event, read_options=ReadOptions(station=code)).answers
    (second,) = survey_stations(tmp_path, read_options=ReadOptions(station=code)).answers
    assert first.station == second.station == "SYA005" and first.pga_m_s2 == second.pga_m_s2
    assert damaged.failure is not None
    with pytest.raises(ParameterError, match="no station 'NOWHERE'"):
        survey_stations(tmp_path, read_options=ReadOptions(station="NOWHERE"))


def test_survey_stations_rejects_two_earthquakes(tmp_path):
    """Another origin time, or an epicentre far away, with the stations that tell them; three minutes are one earthquake."""
    for number, changes in ((1, {}), (2, {"Origin Time": "2004/10/23 18:34:00", "time": "2004/10/23 18:34:20"})):
        for name, data in station_files(number, **changes).items():
            (tmp_path / name).write_bytes(data)
    with pytest.raises(ParameterError, match=r"two earthquakes: 2004-10-23 08:56 UTC .SYA001. and 2004-10-23 09:34 UTC .SYA002."):
        survey_stations(tmp_path)
    nearby, distant = (read_files(tmp_path / part, station_files(3, **header)) for part, header in (("a", {}), ("b", {"Lat.": "35.000"})))
    with pytest.raises(ParameterError, match="two earthquakes"):
        survey_stations([nearby, distant])
    soon = read_files(tmp_path / "c", station_files(4, **{"Origin Time": "2004/10/23 17:57:00"}))
    assert len(survey_stations([nearby, soon]).answers) == 2


def read_files(folder, files):
    """Return the record of some files, written to a folder."""
    folder.mkdir()
    for name, data in files.items():
        (folder / name).write_bytes(data)
    (record,) = read_all(sorted(folder.iterdir()))
    return record


def test_station_without_coordinates_is_listed_only(station_results):
    """JMA's zeros and a table's nothing are no coordinates; with one horizontal of unknown azimuth there is no worst direction."""
    listed = survey_stations([read("synthetic_jma"), read("elcentro_1940_ns")], BODY)
    assert listed.mapped == ()
    jma, table = listed.answers
    assert (jma.latitude, jma.failure) == (None, None) and jma.pga_m_s2 > 9.0
    assert table.pga_m_s2 == pytest.approx(3.12656, abs=1e-4) and table.failure is not None and table.effect.azimuth_deg is None
    assert station_results.earthquake.magnitude == 6.8 and station_results.origin_told == "2004-10-23 17:56:00 JST"


def test_survey_stations_rejects_empty_input():
    """No record at all is refused."""
    with pytest.raises(ParameterError, match="no records"):
        survey_stations([])


def test_survey_stations_finds_worst_azimuth():
    """A shaking along 45 degrees does its worst there, though both components are smaller."""
    record = read("synthetic_jma")
    north = record.component("NS").acceleration
    half = north / np.sqrt(2)
    along = record.with_components([Component("NS", half), Component("EW", half), record.component("UD")], "turned")
    answer = survey_stations([along], StationCemetery(read_cemetery("aoyama.csv"), AssessmentMethod())).answers[0]
    assert answer.effect.azimuth_deg == 45.0
    assert answer.pga_m_s2 == pytest.approx(np.abs(north).max() / np.sqrt(2))
