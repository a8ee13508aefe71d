"""The name under which a kernel is cached carries all that decides its code, and nothing that changes between processes."""

import subprocess
import sys

from stiction.engine.compiled import _decides, bind

NAME_OF_A_KERNEL = """
from stiction.laws.tangential.shared.slip_or_yield import fill_kinks
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import RECORD, plastic, plastic_coordinate
from stiction.laws.tangential.soft_coating_2015 import resistance
from stiction.engine.heights import gaussian
from stiction.laws.joining import _joined, _kernel, _states_template
from stiction.engine.summation import _scattered_kernel
heights = gaussian()
print(fill_kinks.py_func.__qualname__)
along, coordinate = _joined(plastic, plastic_coordinate, resistance, False, 2, 5)
print(_scattered_kernel(along, coordinate, heights.density, heights.window, 12).py_func.__qualname__)
print(_kernel(_states_template, along, coordinate, 12).py_func.__qualname__)
"""


def outer(factor):
    """A function that calls another, in which the factor stands."""
    names = {}
    exec(f"def inner(x):\n    return {factor} * x\ndef outer(x):\n    return inner(x)", names)
    return names["outer"]


def test_a_formula_named_by_a_formula_decides():
    assert _decides(outer(2)) == _decides(outer(2))
    assert _decides(outer(2)) != _decides(outer(3))


def test_what_is_bound_decides():
    def template(x):
        return rule(x)  # noqa: F821

    assert _decides(bind(template, rule=outer(2))) != _decides(bind(template, rule=outer(3)))
    assert _decides(bind(template, rule=outer(2))) == _decides(bind(template, rule=outer(2)))


def test_names_are_the_same_in_every_process():
    """An address in a name would make every process compile anew."""
    names = [
        subprocess.run([sys.executable, "-c", NAME_OF_A_KERNEL], check=True, capture_output=True, text=True).stdout
        for _ in range(2)
    ]
    assert names[0] == names[1] and len(names[0].split()) == 3
