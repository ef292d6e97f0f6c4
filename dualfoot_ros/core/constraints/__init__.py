"""The methods by name.  Each is one module with a ``Config`` and, unless idle, a ``Method``."""

from types import ModuleType

from . import (
    idc,
    max_distance,
    max_distance_projection,
    mdmd_ckf,
    mdmd_ekf,
    mdmd_ukf,
    min_distance,
    rigid_pair,
    spacing_vector,
    step_length,
    varying_distance,
    zupt,
)

METHODS: dict[str, ModuleType] = {
    module.__name__.rpartition(".")[2]: module
    for module in (
        zupt,
        max_distance,
        min_distance,
        mdmd_ekf,
        mdmd_ukf,
        mdmd_ckf,
        idc,
        max_distance_projection,
        varying_distance,
        spacing_vector,
        step_length,
        rigid_pair,
    )
}
