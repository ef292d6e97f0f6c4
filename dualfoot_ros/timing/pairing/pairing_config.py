"""Parameters of the synchronisation of the two feet."""

from __future__ import annotations

from dataclasses import dataclass

from ...core import ConfigError, Parameters, parameter


@dataclass(frozen=True)
class AlignerConfig(Parameters):
    """How two streams become pairs with equal stamps."""

    rate: float = parameter(
        0.0,
        "rate of the common grid; 0: the stamps of the reference foot, and in its holes those of "
        "the other",
        unit="Hz",
        minimum=0.0,
        maximum=2000.0,
    )
    reference: str = parameter(
        "left",
        "foot whose samples stay as they are when the rate is 0; the other is interpolated",
        choices=("left", "right"),
    )
    between: str = parameter(
        "interpolate",
        "value between two samples: on the line through both (as in the papers), or the earlier "
        "one held",
        choices=("interpolate", "hold"),
    )
    max_gap: float = parameter(
        0.1,
        "longest interval between two samples of a foot that is filled; in a longer one the pairs "
        "have the other foot only",
        unit="s",
        minimum=0.001,
        maximum=1.0,
    )
    max_delay: float = parameter(
        0.5,
        "longest time a pair waits for a foot that is late; then the other foot goes on alone "
        "until that one is back in time (not shorter than max_gap)",
        unit="s",
        minimum=0.001,
        maximum=10.0,
    )
    tolerance: float = parameter(
        1.0e-6, "stamps closer than this are equal", unit="s", minimum=0.0, maximum=1.0e-3
    )
    restart_after: int = parameter(
        20,
        "successive samples older than the newest that mean the stream began anew",
        minimum=2,
        maximum=10_000,
    )

    def __post_init__(self) -> None:
        """Check every field, and that the delay covers the gap; raise ConfigError if not."""
        super().__post_init__()
        if self.max_delay < self.max_gap:
            raise ConfigError(
                f"parameter 'max_delay' is {self.max_delay}; allowed is at least 'max_gap', "
                f"{self.max_gap} s"
            )

    @property
    def holds(self) -> bool:
        """Whether the earlier sample is held rather than interpolated."""
        return self.between == "hold"

    @property
    def max_gap_ns(self) -> int:
        """Longest interval that is interpolated across, in ns."""
        return round(self.max_gap * 1e9)

    @property
    def max_delay_ns(self) -> int:
        """Longest wait for the other foot, in ns."""
        return round(self.max_delay * 1e9)

    @property
    def tolerance_ns(self) -> int:
        """Difference up to which stamps are equal, in ns."""
        return round(self.tolerance * 1e9)
