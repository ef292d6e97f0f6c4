"""The filter's kernel: one Python source, interpreted or compiled with the same bits."""

from .engine import BackgroundEngine, Engine, compiled, interpreted

__all__ = ["BackgroundEngine", "Engine", "compiled", "interpreted"]
