"""Everything public says what it is, and the stubs describe what there is."""

import inspect
import re
import subprocess
import sys

import outrider
import pytest


def public(owner, prefix):
    """Yields the name and the object of everything public that is a class, a function or a property."""
    for name, value in inspect.getmembers(owner):
        if name.startswith("_") or inspect.ismodule(value):
            continue
        if inspect.isclass(value) and value.__module__.startswith("outrider"):
            yield f"{prefix}.{name}", value
            if value is not owner and not issubclass(value, BaseException):
                yield from public(value, f"{prefix}.{name}")
        elif inspect.isroutine(value) or inspect.isdatadescriptor(value):
            yield f"{prefix}.{name}", value


def everything():
    members = dict(public(outrider, "outrider"))
    if pytest.importorskip("matplotlib"):
        from outrider import plot
        own = {name: one for name, one in inspect.getmembers(plot, inspect.isfunction) if one.__module__ == plot.__name__}
        members |= {f"outrider.plot.{name}": one for name, one in own.items() if not name.startswith("_")}
    return members


def test_everything_public_has_a_docstring():
    members = everything()
    assert len(members) > 300 and "outrider.PathPlanner.plan" in members and "outrider.plot.path" in members
    assert not [name for name, value in members.items() if not (value.__doc__ or "").strip()]
    classes = {name for name, value in members.items() if inspect.isclass(value)}
    assert {f"outrider.{name}" for name in outrider.__all__ if inspect.isclass(getattr(outrider, name))} == classes


def test_a_name_without_a_docstring_is_noticed():
    bare = type("Bare", (), {"__module__": "outrider", "__doc__": "Said.", "step": lambda self: None})
    assert [name for name, one in public(type("M", (), {"Bare": bare}), "m") if not one.__doc__] == ["m.Bare.step"]


def test_options_are_in_the_docstring_with_unit_and_range():
    for kind in (outrider.LaserSlam, outrider.LandmarkSlam, outrider.ExploreMission, outrider.CoverProblem,
                 outrider.CoverPlanner, outrider.FrontierMap, outrider.PursuitMission, outrider.PoseGraph.optimise):
        assert "Options:\n  " in kind.__doc__ and "; default " in kind.__doc__, kind
    assert "\n  reach: " in outrider.LaserSlam.__doc__


def test_functions_tell_their_signature():
    assert str(inspect.signature(outrider.run)) == "(scenario, *, seed=None, set={})"
    assert list(inspect.signature(outrider.PathPlanner.plan).parameters)[:4] == ["self", "map", "start", "goal"]


def arguments_of(function):
    """The names of the arguments as the compiled function knows them, from its refusal of one that it does not."""
    try:
        function(no_such_argument=None)
    except TypeError as refusal:
        found = re.search(r"1\. (?:\w+)?\((.*)\)(?: -> .*)?$", str(refusal), re.MULTILINE)
        return re.findall(r"(?:^|, )(\**\w+)(?::|,|$)", found[1]) if found else None
    except Exception:  # noqa: BLE001
        return None
    return None


def test_the_stubs_name_the_arguments_that_there_are():
    compared = 0
    for name, value in everything().items():
        functions = [value.__init__] if inspect.isclass(value) else [value] if inspect.isroutine(value) else []
        for function in functions:
            if not getattr(function, "__text_signature__", None):
                continue
            known = arguments_of(function)
            if known is None:
                continue
            told = [one.name for one in inspect.signature(function).parameters.values() if one.kind != one.VAR_KEYWORD]
            assert told == [one for one in known if one not in ("*", "**kwargs")], (name, known)
            compared += 1
    assert compared > 50


def test_the_stubs_have_every_member(tmp_path):
    allowed = tmp_path / "allowed"  # names of types, and what classes of pybind11 have in common; members are compared
    allowed.write_text("outrider\\._outrider\\.\\w+\noutrider\\._outrider\\.\\w+\\.__init__\n")
    checked = subprocess.run([sys.executable, "-m", "mypy.stubtest", "outrider._outrider", "--concise", "--allowlist",
                              allowed, "--ignore-unused-allowlist"], capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout
