"""Loopback FDSN data centre that plays synthetic answers, with faults on demand: no agency's numbers are in them."""

from __future__ import annotations

import io
import threading
from collections import Counter
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlparse

import obspy
from obspy.clients.fdsn.header import DEFAULT_PARAMETERS, OPTIONAL_PARAMETERS
from obspy.core.event import Catalog, Event, EventDescription, Magnitude, Origin, ResourceIdentifier
from obspy.core.inventory import Inventory, Network

from tests.readers.stations import START, channel, inventory, trace

EVENT_ID, NETWORK = "syn0001", "XX"
STATIONS = {"NEAR": (35.0, 139.1), "MID": (35.3, 139.0), "FAR": (37.0, 139.0)}
"""Places; the epicentre is at 35.0, 139.0."""


def event(place=(35.0, 139.0)) -> Catalog:
    """Return the catalogue of the synthetic event, 12 s before the records start."""
    origin = Origin(time=START - 12.0, latitude=place[0], longitude=place[1], depth=10000.0)
    description = EventDescription("synthetic", "earthquake name")
    return Catalog(
        [Event(ResourceIdentifier("smi:syn/1"), origins=[origin], magnitudes=[Magnitude(mag=6.1)], event_descriptions=[description])]
    )


def station(code: str) -> Inventory:
    """Return the inventory of a station with two accelerometers, 00 and 10."""
    sensors = [channel(name, location=location, stages=True) for location in ("10", "00") for name in ("HNN", "HNE", "HNZ")]
    result = inventory(*sensors, network=NETWORK, station=code)
    site = result[0][0]
    site.latitude, site.longitude = STATIONS[code]
    for item in site:
        item.latitude, item.longitude = STATIONS[code]
    return result


class DataCenterServer(ThreadingHTTPServer):
    """Server with a count of requests by service, and faults: status codes or bytes to be sent before the right answer."""

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.requests: Counter[str] = Counter()
        self.faults: dict[str, list[int | bytes]] = {}
        self.empty: set[str] = set()
        self.services = {"dataselect", "station", "event"}

    @property
    def url(self) -> str:
        """Address of the data centre."""
        return f"http://127.0.0.1:{self.server_port}"


class _Handler(BaseHTTPRequestHandler):
    server: DataCenterServer

    def log_message(self, *_) -> None:
        """Keep quiet."""

    def do_GET(self) -> None:
        """Answer a request."""
        url = urlparse(self.path)
        _, _, service, _, resource = url.path.split("/")
        query = {key: values[0] for key, values in parse_qs(url.query).items()}
        if service not in self.server.services:
            self._send(404)
        elif resource == "application.wadl":
            self._send(200, _wadl(service, self.server.url).encode())
        elif resource != "query":
            self._send(200, f"<?xml version='1.0'?><{resource}/>".encode())
        else:
            self.server.requests[service] += 1
            key = f"{service}:{query.get('station', '')}"
            faults = self.server.faults.get(key) or self.server.faults.get(service) or []
            fault = faults.pop(0) if faults else None
            if isinstance(fault, int):
                self._send(fault, b"fault on demand")
            else:
                content = fault if fault is not None else answer_of(service, query)
                self._send(200 if content and query.get("station") not in self.server.empty else 204, content)

    def _send(self, status: int, content: bytes = b"") -> None:
        self.send_response(status)
        self.send_header("Content-Length", str(len(content) if status != 204 else 0))
        self.end_headers()
        if status != 204:
            self.wfile.write(content)


def _wadl(service: str, url: str) -> str:
    names = DEFAULT_PARAMETERS[service] + OPTIONAL_PARAMETERS[service]
    params = "".join(f'<param name="{name}" style="query" type="xs:string"/>' for name in names)
    resource = f'<resource path="query"><method name="GET" id="query"><request>{params}</request></method></resource>'
    head = '<application xmlns="http://wadl.dev.java.net/2009/02" xmlns:xs="http://www.w3.org/2001/XMLSchema">'
    return f'<?xml version="1.0"?>{head}<resources base="{url}/fdsnws/{service}/1/">{resource}</resources></application>'


def answer_of(service: str, query: dict[str, str]) -> bytes:
    buffer = io.BytesIO()
    if service == "event":
        if query.get("eventid") == EVENT_ID:
            event().write(buffer, "QUAKEML")
    elif service == "station":
        sites = [site for code in STATIONS if _matches(query, code) for site in station(code)[0]]
        if sites:
            result = Inventory([Network(NETWORK, stations=sites)], source="synthetic")
            result = result.select(location=query.get("location", "*"))
            result.write(buffer, "STATIONXML", level="channel" if query["level"] == "channel" else "response")
    else:
        location = query["location"].replace("-", "")
        codes = query["channel"].split(",")
        stream = obspy.Stream([trace(code, network=NETWORK, station=query["station"], location=location, start=START) for code in codes])
        stream.trim(obspy.UTCDateTime(query["starttime"]), obspy.UTCDateTime(query["endtime"]))
        if stream:
            stream.write(buffer, "MSEED")
    return buffer.getvalue()


def _matches(query: dict[str, str], code: str) -> bool:
    place = STATIONS[code]
    if "maxradius" in query:
        center = float(query["latitude"]), float(query["longitude"])
        return sum((a - b) ** 2 for a, b in zip(place, center, strict=True)) ** 0.5 <= float(query["maxradius"])
    return query.get("station", "*") in ("*", code) and query.get("network", "*") in ("*", NETWORK)


@contextmanager
def data_center():
    """Run the server inside the block."""
    server = DataCenterServer()
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
    thread.start()
    try:
        yield server
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
