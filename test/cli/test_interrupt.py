"""Ctrl-C, whenever it comes: one sentence, 130, nothing left that runs."""

import signal
import threading

import pytest
from processes import PATIENCE_S

from dualfoot_ros.cli.process import interrupt
from dualfoot_ros.recording import Recording, write_bag
from dualfoot_ros.simulation import WalkConfig, simulate

# CPU time of all processes from the signal to the end, which a busy machine does not stretch.
# What goes on working would use a minute of it.
SOON_S = 1.0
SCRIPT = """
import os, sys, time
from dualfoot_ros.cli import main as m
from dualfoot_ros.cli.process import interrupt
class V: HELP = EXAMPLES = ''; add_arguments = staticmethod(lambda p: None)
def wait(): [time.sleep(0.01) for _ in range({patience})]
def run(args):
{body}
V.run = staticmethod(run)
m.load = lambda name: V
sys.argv = ['dualfoot', 'info']
sys.exit(m.main())
"""


def script(body):
    lines = "".join(f"    {line}\n" for line in body.strip("\n").splitlines())
    return "-c", SCRIPT.format(body=lines, patience=round(100 * PATIENCE_S))


def interrupted(running, number=signal.SIGINT, **how):
    """Send a signal once the process has said "on"; return how it ended."""
    assert running.until(lambda session: "on" in session.said(), "on")
    running.send(number, **how)
    return running.end()


def test_an_interrupted_process_leaves_no_traceback(session):
    ended = interrupted(session(*script("print('on', flush=True)\nwait()")))
    assert (ended.code, ended.error) == (130, "dualfoot info: interrupted\n")


def test_an_interrupt_that_is_swallowed_ends_the_process_all_the_same(session):
    body = """
try:
    print('on', flush=True)
    wait()
except BaseException:
    pass
wait()
"""
    ended = interrupted(session(*script(body)))
    assert (ended.code, ended.error) == (130, "dualfoot info: interrupted\n")


def test_an_interrupt_that_can_only_be_printed_is_not_printed(session):
    body = """
class Deaf:
    def __del__(self):
        print('on', flush=True)
        wait()
Deaf()
wait()
"""
    ended = interrupted(session(*script(body)))
    assert (ended.code, ended.error) == (130, "dualfoot info: interrupted\n")


def test_an_interrupt_that_comes_out_as_another_error_is_one(session):
    body = """
try:
    print('on', flush=True)
    wait()
except KeyboardInterrupt:
    raise RuntimeError('mangled')
"""
    ended = interrupted(session(*script(body)))
    assert (ended.code, ended.error) == (130, "dualfoot info: interrupted\n")


def test_what_was_begun_is_put_in_order_after_an_interrupt(session):
    body = """
interrupt.GRACE_S = 3600.0
try:
    print('on', flush=True)
    wait()
finally:
    print('in order', flush=True)
"""
    ended = interrupted(session(*script(body)))
    assert (ended.code, ended.out) == (130, "on\nin order\n")


def test_it_is_seen_from_another_thread_that_something_is_put_in_order():
    seen = []

    def look():
        thread = threading.Thread(target=lambda: seen.append(interrupt._putting_in_order()))
        thread.start()
        thread.join()

    def strike():
        raise KeyboardInterrupt

    try:
        strike()
    except KeyboardInterrupt:
        look()
    look()
    assert seen == [True, False]


def test_an_interrupt_that_is_ignored_stays_so(session):
    body = """
import signal
signal.signal(signal.SIGINT, signal.SIG_IGN)
with interrupt.Interruptible('never said'):
    os.kill(os.getpid(), signal.SIGINT)
print('over', flush=True)
return 0
"""
    ended = session(*script(body)).end()
    assert (ended.code, ended.out, ended.error) == (0, "over\n", "")


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    """Return the folders of two simulated walks."""
    folder = tmp_path_factory.mktemp("bags")
    for seed in (4, 5):
        made = simulate(WalkConfig(route="straight", rate=60.0, standing=4.0), seed=seed)
        write_bag(folder / f"walk{seed}", Recording(made.left, made.right))
    return [str(folder / "walk4"), str(folder / "walk5")]


@pytest.fixture
def verb(session, bags):
    """Start a verb that has a minute's work for two workers."""

    def start(name):
        arguments = {
            "compare": [*bags, "--methods", "mdmd_ukf", "--sweep", "kappa=0.3:0.8:0.005"],
            "consistency": ["--walks", "500", "--rate", "60"],
        }[name]
        running = session("-m", "dualfoot_ros", name, *arguments, "--jobs", "2")
        # A second thread is the one that waits for an interrupt; before it there is only Python.
        assert running.until(lambda s: s.threads() > 1, "the command's own code")
        return running

    return start


def imports(running, library):
    """Tell whether a worker, or their server, has loaded a library."""
    return any(running.maps(pid, library) for pid in running.others())


def has_kernel(running):
    """Tell whether a worker has the kernel: as a library from the cache, or by its compiler."""
    return imports(running, "/kernel-") or imports(running, "llvmlite")


MOMENTS = {
    "before any import": lambda running, cpu_s: True,
    "when the server of workers is started": lambda running, cpu_s: running.others(),
    "while it imports": lambda running, cpu_s: cpu_s > 0.3,
    "while it imports more": lambda running, cpu_s: cpu_s > 0.7,
    "while the server imports": lambda running, cpu_s: imports(running, "_multiarray_umath"),
    "when a worker is started": lambda running, cpu_s: running.forked(),
    "when both are": lambda running, cpu_s: len(running.forked()) == 2,
    "while they load the kernel": lambda running, cpu_s: has_kernel(running),
    "while they work": lambda running, cpu_s: cpu_s > 1.0,  # from then on
}


def at(moment, running):
    """Wait for the moment."""
    if moment == "while they work":
        at("while they load the kernel", running)
    begin_s = running.cpu_s()
    assert running.until(lambda s: MOMENTS[moment](s, s.cpu_s() - begin_s), moment)


@pytest.mark.parametrize("moment", MOMENTS)
def test_ctrl_c_in_compare_ends_all_its_processes_soon_whenever_it_comes(verb, moment):
    running = verb("compare")
    at(moment, running)
    before_s = running.send(signal.SIGINT)
    ended = running.end()
    assert (ended.code, ended.out, ended.error) == (130, "", "dualfoot compare: interrupted\n")
    assert ended.cpu_s - before_s < SOON_S


def test_ctrl_c_in_consistency_ends_all_its_processes_soon(verb):
    running = verb("consistency")
    at("while they load the kernel", running)
    before_s = running.send(signal.SIGINT)
    ended = running.end()
    assert (ended.code, ended.out) == (130, "")
    assert ended.error == "dualfoot consistency: interrupted\n"
    assert ended.cpu_s - before_s < SOON_S


@pytest.mark.parametrize("moment", ["when a worker is started", "while they load the kernel"])
def test_a_request_to_terminate_compare_ends_its_workers_first(verb, moment):
    running = verb("compare")
    at(moment, running)
    before_s = running.send(signal.SIGTERM, group=False)
    ended = running.end()
    assert (ended.code, ended.out, ended.error) == (-signal.SIGTERM, "", "")
    assert ended.cpu_s - before_s < SOON_S
