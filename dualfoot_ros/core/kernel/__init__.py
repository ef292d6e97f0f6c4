"""The filter's kernel: one Python source on flat arrays, made to be compiled as it stands."""

from . import layout
from .engine import ENTRIES, MODULES, Engine, interpreted, kernel_functions, looked_at
from .workspace import Workspace, joint_covariance

__all__ = [
    "ENTRIES",
    "MODULES",
    "Engine",
    "Workspace",
    "interpreted",
    "joint_covariance",
    "kernel_functions",
    "layout",
    "looked_at",
]
