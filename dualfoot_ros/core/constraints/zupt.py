"""``zupt``: zero-velocity updates only, both feet uncoupled (the base of all four papers)."""

from __future__ import annotations

from .method import Method


class ZuptOnly(Method):
    """Asks for no constraint; the base has no parameters of its own."""

    name = "zupt"
