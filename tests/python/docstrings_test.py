"""What help() says: every public function of the package has its parameters and results described."""

import dataclasses
import inspect
import re

import pytest

import veritrack
from veritrack import sweep, trackers


def _public():
    named = [(f"{module.__name__}.{name}", getattr(module, name)) for module in (veritrack, trackers, sweep)
             for name in module.__all__]
    for name, each in named:
        if inspect.isclass(each):
            yield name, each, each.__init__ if "__init__" in vars(each) else None
            for member, value in vars(each).items():
                if each.__module__.startswith("veritrack.sweep.") and each is not sweep.Swept:
                    continue  # of what a sweep is made of, the classes as a whole
                if member.startswith("_"):
                    continue
                if isinstance(value, property):
                    yield f"{name}.{member}", value, None
                elif isinstance(value, (staticmethod, classmethod)) or inspect.isfunction(value):
                    yield f"{name}.{member}", getattr(each, member), getattr(each, member)
        elif callable(each) and not inspect.ismodule(each):
            yield name, each, each


PUBLIC = {name: (each, function) for name, each, function in _public()}


def test_there_is_something_to_look_at():
    assert len(PUBLIC) > 70


@pytest.mark.parametrize("name", PUBLIC)
def test_what_is_public_is_described(name):
    each, function = PUBLIC[name]
    words = inspect.getdoc(each)
    assert words, "no docstring"
    if function is None:
        return
    taken = [parameter for parameter in inspect.signature(function).parameters if parameter not in ("self", "cls")]
    if taken:
        if dataclasses.is_dataclass(each):  # its attributes are its parameters, those of its base included
            words = "\n".join(inspect.cleandoc(base.__doc__) for base in each.__mro__[:-1])
        described = re.split(r"(?:Parameters|Attributes)\n-{10}\n", words, 1)[-1].replace("**", "").replace(",", " ")
        lines = [line for line in described.splitlines() if line and not line.startswith(" ")]
        missing = [parameter for parameter in taken
                   if not any(parameter in line.partition(":")[0].split() for line in lines)]
        assert not missing, "not described"
    returned = inspect.signature(function).return_annotation
    if not inspect.isclass(each) and returned not in (None, "None", inspect.Signature.empty):
        assert "Returns\n-------\n" in words or len(words.splitlines()[0]) > 20, "no word on what it returns"
