"""The person between the feet: heading, floor, smooth motion, steps, and how far to trust it."""

from .person import PersonEstimate, PersonTracker
from .smoothing import SmoothedPerson, Smoother
from .steps import Step, StepTracker
from .trust import LOST_HEADING_STD, Trust, TrustTracker

__all__ = [
    "LOST_HEADING_STD",
    "PersonEstimate",
    "PersonTracker",
    "SmoothedPerson",
    "Smoother",
    "Step",
    "StepTracker",
    "Trust",
    "TrustTracker",
]
