"""Throw damaged streams at the decoders and hold them to what they promise.

One execution: a fresh decoder takes good frames, then the same frames damaged, cut in pieces
anywhere, then two good frames.  In half of them it is the content that is damaged, in frames that
are valid: with the right checksum, stuffing and end.  It must raise
nothing, keep its buffer bounded, count every byte, give finite samples only, and give the last
frame's sample.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

ROOT = Path(__file__).resolve().parents[1]
for folder in (ROOT, ROOT / "test"):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))

from drivers import frames  # noqa: E402  (the encoders of the tests)

from benchmark.valid_frames import NAMES, sealed  # noqa: E402
from dualfoot_ros.drivers import Decoder, Sample, make_decoder  # noqa: E402

EXAMPLES = """examples:
  python benchmark/fuzz_decoders.py --executions 1000000
  python benchmark/fuzz_decoders.py --executions 20000 --formats witmotion xbus --json
  python benchmark/fuzz_decoders.py --formats mcu --seed 7 --executions 1000
"""
CORPUS = 64
SHOWN = 5
Damage = Callable[[random.Random, bytearray], None]


class BrokenPromiseError(Exception):
    """A decoder broke what it promises."""


def corpus(name: str) -> list[bytes]:
    """Return good frames of a format."""
    encode = frames.dot if name == "dot" else frames.ENCODERS[name]
    return [encode(k) for k in range(CORPUS)]


def flip(dice: random.Random, data: bytearray) -> None:
    """Flip a bit."""
    data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)


def overwrite(dice: random.Random, data: bytearray) -> None:
    """Set a byte to one that frames are made of."""
    data[dice.randrange(len(data))] = dice.choice(b"\x00\x0a\x55\xfa\xff\x36\x51\x52\xdb,I")


def cut(dice: random.Random, data: bytearray) -> None:
    """Take a piece out."""
    at = dice.randrange(len(data))
    del data[at : at + dice.randrange(1, 40)]


def double(dice: random.Random, data: bytearray) -> None:
    """Say a piece twice."""
    at = dice.randrange(len(data))
    data[at:at] = data[at : at + dice.randrange(1, 40)]


def noise(dice: random.Random, data: bytearray) -> None:
    """Put noise in."""
    at = dice.randrange(len(data) + 1)
    data[at:at] = dice.randbytes(dice.randrange(1, 60))


DAMAGES: tuple[Damage, ...] = (flip, overwrite, cut, double, noise)


def damaged(dice: random.Random, good: list[bytes]) -> bytes:
    """Return a few frames with a few damages."""
    data = bytearray(b"".join(dice.choices(good, k=dice.randrange(1, 4))))
    for _ in range(dice.randrange(1, 5)):
        if data:
            dice.choice(DAMAGES)(dice, data)
    return bytes(data)


def valid(dice: random.Random, name: str) -> bytes:
    """Return a few valid frames of damaged content."""
    count = dice.randrange(1, 4)
    return b"".join(sealed(name, dice.randrange(CORPUS), dice, DAMAGES) for _ in range(count))


def feed(decoder: Decoder, dice: random.Random, data: bytes) -> list[Sample]:
    """Feed in pieces, or whole where each call is a message; look at the buffer each time."""
    samples: list[Sample] = []
    size = 4096 if decoder.message_oriented else dice.choice((1, 5, 16, 37, 64, 300, 4096))
    for at in range(0, len(data), size):
        samples += decoder.feed(data[at : at + size], 7)
        if decoder.buffered > decoder.max_buffer:
            raise BrokenPromiseError(
                f"buffer of {decoder.buffered} bytes, {decoder.max_buffer} allowed"
            )
    return samples


def execute(name: str, good: list[bytes], dice: random.Random) -> tuple[int, int]:
    """Run once; return samples given for damaged bytes, and 1 where the last frame was lost.

    Raises
    ------
    BrokenPromiseError
        When a promise is broken; anything else that is raised is a broken promise as well.
    """
    decoder = make_decoder(frames.decoder_format(name))
    feed(decoder, dice, frames.preamble(name))
    if dice.random() < 0.5:
        feed(decoder, dice, good[0])
    bad = valid(dice, name) if dice.random() < 0.5 else damaged(dice, good)
    given = feed(decoder, dice, bad)
    last = dice.randrange(1, CORPUS)
    for piece in (good[last - 1], good[last]):
        after = feed(decoder, dice, piece)
    _check_samples(given + after)
    if decoder.counters["bytes"] < len(bad):
        raise BrokenPromiseError("not every byte is counted")
    force, _ = frames.truth(last)
    back = after and math.dist(after[-1].specific_force, force) < 1e-2
    return len(given), 0 if back else 1


def _check_samples(samples: list[Sample]) -> None:
    for sample in samples:
        values = (*sample.specific_force, *sample.angular_rate)
        if len(values) != 6 or not all(map(math.isfinite, values)):
            raise BrokenPromiseError(f"a sample that is not finite: {sample}")
        if sample.ticks is not None and not 0 <= sample.ticks < 1 << sample.tick_bits:
            raise BrokenPromiseError(f"ticks beyond {sample.tick_bits} bits: {sample}")


def fuzz(name: str, executions: int, seed: int, advance: Callable[[], None]) -> dict[str, Any]:
    """Run many executions; every one can be repeated from its own seed."""
    good = corpus(name)
    failures: list[str] = []
    samples = lost = 0
    start = time.perf_counter()
    for number in range(executions):
        own_seed = f"{name} {seed} {number}"
        try:
            given, missed = execute(name, good, random.Random(own_seed))
            samples, lost = samples + given, lost + missed
        except Exception as error:
            failures.append(f"seed '{own_seed}': {type(error).__name__}: {error}")
        if number % 1000 == 0:
            advance()
    elapsed_s = time.perf_counter() - start
    return {
        "format": name,
        "executions": executions,
        "per_second": round(executions / elapsed_s),
        "samples_of_damaged_bytes": samples,
        "second_frame_lost": lost,
        "failures": failures,
    }


def show(results: list[dict[str, Any]], console: Console) -> None:
    """Print a table, and the first failures with their seeds."""
    table = Table("format", "executions", "1/s", "second frame lost", "failures")
    for result in results:
        table.add_row(
            result["format"],
            str(result["executions"]),
            str(result["per_second"]),
            str(result["second_frame_lost"]),
            str(len(result["failures"])),
        )
    console.print(table)
    for result in results:
        for failure in result["failures"][:SHOWN]:
            console.print(f"{result['format']}: {failure}", markup=False)


def main(arguments: list[str] | None = None) -> int:
    """Run from the command line; the exit code is 1 when a promise was broken."""
    parser = argparse.ArgumentParser(
        description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--executions", type=int, default=10_000, help="for each format")
    parser.add_argument("--formats", nargs="+", choices=NAMES, default=NAMES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    args = parser.parse_args(arguments)
    if args.executions < 1:
        parser.error(f"--executions is {args.executions}; allowed is 1 or more")
    results = []
    with Progress(console=Console(stderr=True), transient=True) as progress:
        for name in args.formats:
            task = progress.add_task(name, total=args.executions)
            results.append(
                fuzz(name, args.executions, args.seed, lambda t=task: progress.advance(t, 1000))
            )
    if args.json:
        print(json.dumps({"results": results}))
    else:
        show(results, Console())
    return 1 if any(result["failures"] for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
