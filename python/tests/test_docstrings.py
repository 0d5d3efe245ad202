"""Every public name has a docstring. The pages of the interface and the stubs consist of them."""

from __future__ import annotations

import builtins
import inspect

import lichtmc

PUBLIC = [*lichtmc.__all__, "RuntimeError"]  # which would replace Python's own in `from lichtmc import *`
INHERITED = {"with_traceback", "add_note", "args"}  # of Python's exceptions


def text_of(member: object) -> str:
    """The docstring without the signature, which nanobind writes before it."""
    if isinstance(member, (staticmethod, classmethod)):
        member = member.__func__
    signatures = getattr(member, "__nb_signature__", None)
    if signatures is not None:
        return "\n".join(each[1] or "" for each in signatures).strip()
    if isinstance(member, property):
        return (member.__doc__ or (text_of(member.fget) if member.fget else "")).strip()
    return (inspect.getdoc(member) or "").strip()


def members_of(cls: type) -> list[tuple[str, object]]:
    return [(name, member) for name, member in vars(cls).items()
            if not name.startswith("_") and name not in INHERITED
            and (callable(member) or isinstance(member, (property, staticmethod, classmethod)) or hasattr(member, "__get__"))]


def test_every_public_name_has_a_docstring() -> None:
    without = []
    for name in PUBLIC:
        if name == "__version__":
            continue
        thing = getattr(lichtmc, name)
        if not text_of(thing):
            without.append(name)
        if inspect.isclass(thing):
            without += [f"{name}.{member_name}" for member_name, member in members_of(thing) if not text_of(member)]
    assert without == []


def test_a_missing_docstring_is_noticed() -> None:
    class Without:
        def method(self) -> None: ...

        @property
        def value(self) -> int:
            return 0

    assert not text_of(Without) and [text_of(member) for _, member in members_of(Without)] == ["", ""]
    assert "\n" not in text_of(lichtmc.Room.cuboid).split("(")[0]


def test_all_names_the_public_names() -> None:
    assert len(lichtmc.__all__) == len(set(lichtmc.__all__))
    modules = {"annotations"}
    public = {name for name, value in vars(lichtmc).items()
              if not name.startswith("_") and not inspect.ismodule(value) and name not in modules}
    assert public == set(PUBLIC) - {"__version__"}


def test_an_import_of_all_leaves_the_names_of_python() -> None:
    assert not set(lichtmc.__all__) & set(dir(builtins))
