"""Real sensors: bytes of a device in, samples in SI units out."""

from typing import TYPE_CHECKING

from ..lazy_face import lazy_face

if TYPE_CHECKING:
    from ..core import SourceError
    from .checks import CheckConfig, SensorCheck, SensorFault, SensorFinding
    from .checks import CheckConfig as Checks  # a short name, which programs of users have
    from .conditioning import Conditioner, ConditioningConfig
    from .conditioning import ConditioningConfig as Conditioning  # another
    from .probing.listening import BAUDS, Chunk, Heard, listen
    from .probing.recognition import Recognition, devices_on_bus, recognise
    from .probing.scan import Found, announced_devices, bluetooth_devices, serial_ports
    from .protocols.decoder import COUNTERS, Decoder
    from .protocols.registry import FORMATS, make_decoder
    from .reader import BackoffConfig, Reader, State
    from .sample import Sample
    from .sample_series import SampleSeries, series_of
    from .source import Source, make_transport
    from .transports.transport import Transport
    from .uri import SCHEMES, SourceUri, parse_uri

__getattr__, __dir__ = lazy_face(__name__)

__all__ = [
    "BAUDS",
    "COUNTERS",
    "FORMATS",
    "SCHEMES",
    "BackoffConfig",
    "CheckConfig",
    "Checks",
    "Chunk",
    "Conditioner",
    "Conditioning",
    "ConditioningConfig",
    "Decoder",
    "Found",
    "Heard",
    "Reader",
    "Recognition",
    "Sample",
    "SampleSeries",
    "SensorCheck",
    "SensorFault",
    "SensorFinding",
    "Source",
    "SourceError",
    "SourceUri",
    "State",
    "Transport",
    "announced_devices",
    "bluetooth_devices",
    "devices_on_bus",
    "listen",
    "make_decoder",
    "make_transport",
    "parse_uri",
    "recognise",
    "serial_ports",
    "series_of",
]
