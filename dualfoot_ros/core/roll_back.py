"""Going back to the epoch that something was found out about, and running again from there."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from .constraints.method import Request
from .joint_estimate import JointEstimate, Outcome
from .kernel import Engine, Workspace
from .kernel import layout as lay

ACTIONS = 16  # constraints kept before those that no roll-back can reach are dropped


class RollBack:
    """Corrects the past of a workspace, and does there again what had been done since.

    The kernel's ring of snapshots says how far back it can go.
    """

    def __init__(self, space: Workspace) -> None:
        self._space = space
        self._actions: list[tuple[int, Callable[[JointEstimate], Outcome]]] = []

    def use(self, engine: Engine, estimate: JointEstimate) -> None:
        """Go on with another form of the kernel."""
        self._engine, self._estimate = engine, estimate

    def forget(self) -> None:
        """Forget what was applied: it cannot be applied again."""
        self._actions.clear()

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

    def apply(self, requests: Sequence[Request]) -> list[tuple[Request, Outcome]]:
        """Apply all at their moments, or all now, and return what came of each, by epoch."""
        now = self._space.epoch
        if requests[0].roll_back:
            if len(requests) > 1:
                requests = sorted(requests, key=lambda request: request.epoch)
            outcomes = self._replay(requests[0].epoch + 1, requests)
        else:
            outcomes = [request.apply(self._estimate) for request in requests]
        pairs = list(zip(requests, outcomes, strict=True))
        for request, outcome in pairs:
            if outcome.accepted:
                self._actions.append((request.epoch if request.roll_back else now, request.apply))
        if len(self._actions) > ACTIONS:
            oldest = self._space.oldest  # asked once: some methods act at every epoch
            self._actions = [action for action in self._actions if action[0] >= oldest]
        return pairs

    def _replay(self, first: int, fresh: Sequence[Request]) -> list[Outcome]:
        """Go back to before epoch ``first`` and run up to the newest again.

        Constraints already applied since are applied again, each at its own epoch; the ``fresh``
        ones, none earlier than ``first - 1``, join them.  Returns what came of the fresh ones.
        """
        space, engine = self._space, self._engine
        w, n = space.w, space.n
        engine.restore(w, n, first)
        outcomes = []
        actions = [(request.epoch, request.apply, True) for request in fresh]
        old = [(epoch, apply, False) for epoch, apply in self._actions if epoch >= first]
        if old:
            actions = sorted([*old, *actions], key=lambda action: action[0])
        for epoch, apply, is_fresh in actions:
            if first <= epoch:
                engine.rerun(w, n, first, epoch)
                first = epoch + 1
            outcome = apply(self._estimate)
            if is_fresh:
                outcomes.append(outcome)
        engine.rerun(w, n, first, space.epoch)
        return outcomes
