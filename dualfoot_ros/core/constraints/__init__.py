"""The methods by name; each is one module with a ``Config`` and, unless idle, a ``Method``."""

from . import idc, zupt

METHODS = {"zupt": zupt, "idc": idc}
