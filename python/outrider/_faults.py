"""The exceptions of Outrider: one class for each kind of fault."""


class Fault(Exception):
    """Outrider refused a request or could not fulfil it; each kind of fault has its class."""

    code = "fault"

    def __init__(self, sentence: str, where: str = "") -> None:
        super().__init__(f"{where}: {sentence}" if where else sentence)
        self.sentence = sentence
        """One sentence, with the value and the remedy."""
        self.where = where
        """File and line, key of an option, or name of an argument; may be empty."""


class StartBlocked(Fault):
    """The start collides with an obstacle."""

    code = "start_blocked"


class GoalBlocked(Fault):
    """The goal collides with an obstacle."""

    code = "goal_blocked"


class OutsideMap(Fault):
    """The start or the goal lies outside the known world."""

    code = "outside_map"


class NoPath(Fault):
    """Proven: no path connects the start and the goal."""

    code = "no_path"


class NoShot(Fault):
    """No flight of the stated resolution hits the target."""

    code = "no_shot"


class BudgetExhausted(Fault):
    """The budget ended first."""

    code = "budget_exhausted"


class Cancelled(Fault):
    """The caller asked to stop."""

    code = "cancelled"


class BadInput(Fault, ValueError):
    """A file, key or value is wrong; the sentence names the remedy."""

    code = "bad_input"


class CannotWrite(Fault, OSError):
    """The system failed to write a file, for instance on a full disk."""

    code = "cannot_write"


class RobotFailed(Fault):
    """A robot or a mission written in Python failed; `__cause__` is its exception, if it raised one."""

    code = "robot_failed"


_CLASSES = {kind.code: kind for kind in (StartBlocked, GoalBlocked, OutsideMap, NoPath, NoShot, BudgetExhausted,
                                         Cancelled, BadInput, CannotWrite)}


def exception_of(code: str, sentence: str, where: str) -> Fault:
    """Returns the exception of that code."""
    return _CLASSES[code](sentence, where)
