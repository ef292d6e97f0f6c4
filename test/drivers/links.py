"""What the tests of real links share: collecting, waiting, and what a process holds."""

import os
import threading
import time
import tty
from pathlib import Path

from processes import PATIENCE_S


class Collector:
    """Takes what a source hands on."""

    def __init__(self):
        self.samples = []
        self.states = []
        self.threads = set()
        self._changed = threading.Condition()

    def take(self, samples):
        with self._changed:
            self.samples += samples
            self.threads.add(threading.current_thread())
            self._changed.notify_all()

    def state(self, state, reason):
        with self._changed:
            self.states.append((state, reason))
            self._changed.notify_all()

    def wait_for(self, condition):
        with self._changed:
            return self._changed.wait_for(lambda: condition(self), PATIENCE_S)

    def wait_for_samples(self, count):
        return self.wait_for(lambda c: len(c.samples) >= count)

    def wait_for_state(self, state):
        return self.wait_for(lambda c: c.states and c.states[-1][0] is state)


class PluggedDevice:
    """A serial device at a path; can be unplugged and come back, with another number behind."""

    def __init__(self, path: Path):
        self.path = path
        self._ends = None

    def plug(self):
        self._ends = os.openpty()
        tty.setraw(self._ends[1])
        self.path.symlink_to(os.ttyname(self._ends[1]))

    def send(self, data):
        os.write(self._ends[0], data)

    def unplug(self):
        self.path.unlink(missing_ok=True)
        for end in self._ends or ():
            os.close(end)
        self._ends = None


def held():
    """Return how many descriptors and threads this process has."""
    return len(list(Path("/proc/self/fd").iterdir())), threading.active_count()


def settle(expected):
    """Return what is held, once it is back at ``expected`` or patience is at its end."""
    deadline = time.monotonic() + PATIENCE_S
    while held() != expected and time.monotonic() < deadline:
        time.sleep(0.01)
    return held()
