"""Which parameters of ``fusion`` may change while it runs, and why the others may not."""

from __future__ import annotations

LIVE = frozenset(
    [
        *(f"stance.{name}" for name in ("threshold", "gyro_std", "force_std")),
        *(f"zupt.{name}" for name in ("std", "rate_std", "still_std")),
        *(f"aids.{name}" for name in ("flat_floor", "floor_std", "static_std")),
        *(f"aids.{name}" for name in ("barometer_std", "barometer_samples")),
        *(f"aids.magnetic_{name}" for name in ("std", "size", "dip", "stances")),
        "spacing_vector.spacing",
        "spacing_vector.spacing_std",
        *(
            f"{method}.{name}"
            for method in ("min_distance", "mdmd_ekf", "mdmd_ukf", "mdmd_ckf", "idc")
            for name in ("distance", "distance_std")
        ),
        "person.trust_limit",
    ]
)
REASONS = {
    "method": "a track belongs to one method",
    "gravity": "the track was levelled with it",
    "alignment": "the track starts from it",
    "heading": "the track starts from it",
    "initial": "the track starts from it",
    "increments": "the track starts from it",
    "frames": "subscribers know the frames by these names",
    "stance": "the memory of the filter is sized by it",
    "aids": "its topics are subscribed at the start",
}
OTHERWISE = "it is read at the start"


def reason_read_only(name: str) -> str:
    """Return why the parameter ``name`` cannot change while a node runs."""
    return REASONS.get(name.partition(".")[0], OTHERWISE)
