"""Going back to the epoch that something was found out about, and running again from there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from .constraints.method import Request
from .joint_estimate import JointEstimate, Outcome
from .kernel import Engine, Workspace
from .kernel import layout as lay
from .misfit import apply_doubting

ACTIONS = 16  # constraints kept before those that no roll-back can reach are dropped
Feet = Sequence[int]


class Action(NamedTuple):
    """A constraint and the epoch it was applied at; ``doubted`` feet are where it may not fit."""

    epoch: int
    apply: Callable[[JointEstimate], Outcome]
    doubted: Feet


class RollBack:
    """Corrects the past of a workspace, and does there again what had been done since.

    The kernel's ring of snapshots says how far back it can go.
    """

    def __init__(self, space: Workspace) -> None:
        self._space = space
        self._actions: list[Action] = []
        self.newest = -1  # epoch of the newest of them

    def use(self, engine: Engine, estimate: JointEstimate) -> None:
        """Go on with another form of the kernel."""
        self._engine, self._estimate = engine, estimate

    def forget(self) -> None:
        """Forget what was applied: it cannot be applied again."""
        self._actions.clear()
        self.newest = -1

    def clean_phases(self, bits: Sequence[int]) -> None:
        """Undo the zero velocity of a stance, or the swing within one, that was none.

        ``bits`` (2,) are the notices of each foot.
        """
        if not (bits[0] | bits[1]) & (lay.STANCE_FALSE | lay.SWING_FALSE):
            return
        space, now = self._space, self._space.epoch
        firsts = []
        for foot in range(2):
            if bits[foot] & lay.STANCE_FALSE:
                first = space.foot(foot, "N_START")
                still = False
            elif bits[foot] & lay.SWING_FALSE:
                first = space.foot(foot, "N_LEAVE")
                still = True
            else:
                continue
            if first >= space.oldest:
                self._engine.set_flags(space.n, foot, first, now, still)
                firsts.append(first)
        if firsts:
            self._replay(min(firsts), [])

    def before_newest(self, change: Callable[[], None]) -> None:
        """Run the newest epoch again after a ``change`` of the state before it."""
        epoch = self._space.epoch
        self._engine.restore(self._space.w, self._space.n, epoch)
        change()
        self._engine.rerun(self._space.w, self._space.n, epoch, epoch)

    def apply(self, requests: Sequence[Request], doubted: Feet = ()) -> list[Outcome]:
        """Apply all at their moments, or all now; return what came of each.

        They are in the order of their epochs.  Where one cannot fit, the places of the ``doubted``
        feet are taken for unknown.
        """
        space = self._space
        if requests[0].roll_back:
            fresh = [Action(request.epoch, request.apply, doubted) for request in requests]
            outcomes = self._replay(requests[0].epoch + 1, fresh)
        else:
            fresh = [Action(space.epoch, request.apply, doubted) for request in requests]
            outcomes = [self._outcome(action) for action in fresh]
        for action, outcome in zip(fresh, outcomes, strict=True):
            if outcome.accepted:
                self._actions.append(action)
                self.newest = max(self.newest, action.epoch)
        if len(self._actions) > ACTIONS:
            self._forget_old()
        return outcomes

    def note(self, action: Action) -> None:
        """Take note of what the kernel has applied by itself, after all others."""
        self._actions.append(action)
        self.newest = action.epoch
        if len(self._actions) > ACTIONS:
            self._forget_old()

    def _forget_old(self) -> None:
        """Forget what no roll-back can reach."""
        oldest = self._space.oldest
        self._actions = [action for action in self._actions if action.epoch >= oldest]

    def _outcome(self, action: Action) -> Outcome:
        """Apply an action to the present state."""
        if not action.doubted:
            return action.apply(self._estimate)
        return apply_doubting(self._space, self._estimate, action.apply, action.doubted)

    def _replay(self, first: int, fresh: Sequence[Action]) -> list[Outcome]:
        """Go back to before epoch ``first`` and run up to the newest again.

        Constraints already applied since are applied again, each at its own epoch; the ``fresh``
        ones, none earlier than ``first - 1``, join them.  Returns what came of the fresh ones.
        """
        space, engine = self._space, self._engine
        w, n = space.w, space.n
        engine.restore(w, n, first)
        outcomes = []
        actions = [(action, True) for action in fresh]
        actions += [(action, False) for action in self._actions if action.epoch >= first]
        # of one epoch those that were there before come first
        for action, is_fresh in sorted(actions, key=lambda each: (each[0].epoch, each[1])):
            if first <= action.epoch:
                engine.rerun(w, n, first, action.epoch)
                first = action.epoch + 1
            outcome = self._outcome(action)
            if is_fresh:
                outcomes.append(outcome)
        engine.rerun(w, n, first, space.epoch)
        return outcomes
