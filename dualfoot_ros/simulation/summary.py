"""The facts of a simulated walk, as a person or a program wants to read them."""

from __future__ import annotations

from typing import Any

from .simulate import Simulation


def summary(simulation: Simulation) -> dict[str, Any]:
    """Return route, distance, duration, counts, and mean and spread of the feet's passes."""
    walked, passes = simulation.walk, simulation.walk.passes
    facts: dict[str, Any] = {
        "route": walked.config.route,
        "distance_m": walked.route.length,
        "duration_s": walked.duration_s,
        "rate_hz": walked.config.rate,
        "left_samples": len(simulation.left),
        "right_samples": len(simulation.right),
        "left_stances": len(simulation.left_stances),
        "right_stances": len(simulation.right_stances),
        "passes": len(passes.distance),
    }
    if simulation.pressure:
        facts["pressure_samples"] = {w: len(series) for w, series in simulation.pressure.items()}
    if simulation.left.magnetic_field is not None:
        facts["magnetic_field"] = True
    if facts["passes"]:
        facts["min_distance_mean_m"] = float(passes.distance.mean())
        facts["min_distance_std_m"] = float(passes.distance.std())
        facts["kappa_mean"] = float(passes.kappa.mean())
        facts["kappa_std"] = float(passes.kappa.std())
    return facts
