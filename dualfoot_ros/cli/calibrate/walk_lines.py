"""The result of ``dualfoot calibrate walk`` in words, and as plain values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ...calibration import FootResult, PivotFit, WalkCalibration

PERCENT = 100.0


def result_lines(result: WalkCalibration, pivot: PivotFit | None) -> Iterator[str]:
    """Yield the result in words: each foot, the checks, the pivot."""
    for name, foot in result.feet.items():
        yield from _foot_lines(name, foot)
    yield from _check_lines(result)
    if pivot is not None:
        yield from _pivot_lines(pivot)


def _foot_lines(name: str, foot: FootResult) -> Iterator[str]:
    from ...calibration import ELEMENTS, median_explained, weakest

    turned = foot.turned
    yield f"{name}: gyro matrix from {_many(len(foot.fit.walks), 'walk')}, {turned.seconds:.0f} s"
    yield "           " + " ".join(f"{element:>7}" for element in ELEMENTS)
    for title, values in (("percent", foot.fit.elements), ("+-", foot.elements_std)):
        yield f"  {title:<9}" + " ".join(f"{PERCENT * v:+7.3f}" for v in values)
    weak = weakest(foot.fit)
    yield f"  least is known of {weak}: +- {PERCENT * weak.std:.2f} %"
    yield f"  self-test: a known matrix comes back within {PERCENT * foot.test.error:.2f} %"
    if foot.left_out:
        agreement = sum(each.agreement for each in foot.left_out) / len(foot.left_out)
        yield (
            "  walks left out: the matrix of the others explains "
            f"{PERCENT * median_explained(foot.left_out):.0f} % of what one of their own would "
            f"(median); disagreement {agreement:.1f} (1 is due)"
        )
    else:
        yield "  walks left out: none, as there is one walk; give two or more"


def _check_lines(result: WalkCalibration) -> Iterator[str]:
    from ...calibration import median_of

    checks = list(result.checks.values())
    for what, unit, digits, pick in (
        ("closing error", "%", 2, "closure_percent"),
        ("floor markers", "m RMSE", 3, "marker_rmse_m"),
    ):
        before = median_of([getattr(c.before, pick) for c in checks])
        after = median_of([getattr(c.after, pick) for c in checks])
        if before is not None and after is not None:
            yield (
                f"{what}: {before:.{digits}f} {unit} before, {after:.{digits}f} after (median of "
                f"{_many(len(checks), 'walk')}, each with the matrix of the others)"
            )


def _pivot_lines(pivot: PivotFit) -> Iterator[str]:
    rise = [
        sum(abs(h) for h in heights) / len(heights)
        for heights in (pivot.heights_before, pivot.heights_after)
    ]
    yield (
        f"pivot: zupt.lever_back {pivot.lever_back:.3f} +- {pivot.lever_back_std:.3f} m, the "
        f"loops end {rise[0]:.2f} m too high or low before, {rise[1]:.2f} after (mean of "
        f"{_many(len(pivot.heights_before), 'loop')})"
    )
    if pivot.lengths:
        yield f"  zupt.lever_arm {pivot.lever_arm:.3f} +- {pivot.lever_arm_std:.3f} m, by markers"
    else:
        yield "  zupt.lever_arm is left as it is: no walk has floor markers"
    if not pivot.paces:
        yield "  all walks have one pace; add slow and fast ones, as one pivot has to serve both"


def result_facts(result: WalkCalibration, pivot: PivotFit | None) -> dict[str, Any]:
    """Return the result as plain values for JSON."""
    from dataclasses import asdict

    feet = {
        name: {
            "elements": foot.fit.elements,
            "elements_std": foot.elements_std,
            "matrix": foot.fit.matrix,
            "bias": foot.bias,
            "self_test_error": foot.test.error,
            "self_test_passed": foot.test.passed,
            "left_out": [asdict(each) for each in foot.left_out],
            "turned_left_deg": foot.turned.left_deg,
            "turned_right_deg": foot.turned.right_deg,
            "remarks": list(foot.remarks()),
        }
        for name, foot in result.feet.items()
    }
    return {
        **feet,
        "walks": list(result.names),
        "checks": {name: asdict(check) for name, check in result.checks.items()},
        "pivot": None if pivot is None else {**asdict(pivot), "parameters": pivot.parameters()},
    }


def _many(count: int, unit: str) -> str:
    return f"{count} {unit}" if count == 1 else f"{count} {unit}s"
