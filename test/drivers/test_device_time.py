"""From a sample's raw ticks to time that does not wrap, by the counter model of timing."""

from itertools import pairwise

import pytest

from dualfoot_ros.drivers import make_decoder
from dualfoot_ros.timing.clock.counter import CounterConfig, Unwrapper

from .frames import PERIOD_US, TIMED, decoder_format, preamble, stream

WRAP = (1 << 32) // PERIOD_US  # the sample before 32 bits of microseconds wrap


@pytest.mark.parametrize("name", TIMED)
@pytest.mark.parametrize("first", [0, WRAP - 20])
def test_unwrapped_ticks_advance_by_the_sampling_period(name, first):
    decoder = make_decoder(decoder_format(name))
    decoder.feed(preamble(name), 0)
    samples = decoder.feed(stream(name, 60, first=first)[len(preamble(name)) :], 0)
    assert len(samples) == 60
    model = CounterConfig(bits=str(samples[0].tick_bits), rate=1e9 / samples[0].tick_ns)
    unwrapper = Unwrapper(model)
    times = [unwrapper.time_ns(sample.ticks) for sample in samples]
    steps = {after - before for before, after in pairwise(times)}
    assert steps == {PERIOD_US * 1000}
