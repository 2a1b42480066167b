"""Plugin of mypy: each operator of NumPy's arrays has one signature, which takes half of the time of `make types` away.

NumPy declares up to seventeen overloads of an operator, by the kinds of both operands. The arrays of this package state
kind and shape for jaxtyping; for mypy they are of any kind, so that several overloads match, all of them are compared
at every operator, and the result is `Any`. With one signature the result of two arrays is an array, which mypy checks.
"""

from collections.abc import Callable

from mypy.nodes import Decorator, OverloadedFuncDef
from mypy.plugin import ClassDefContext, Plugin
from mypy.types import AnyType, CallableType, TypeOfAny, UnboundType, UnionType

ARITHMETIC = ("add", "sub", "mul", "truediv", "floordiv", "mod", "pow", "matmul", "and", "or", "xor")
OPERATORS = {f"__{side}{name}__" for name in ARITHMETIC for side in ("", "r")} | {
    f"__{name}__" for name in ("lt", "le", "gt", "ge")
}
OPERANDS = ("complex", "generic", "ndarray", "tuple", "list")
"""Numbers of Python and NumPy, arrays, and rows of numbers, as the stubs of NumPy name them."""


class ArrayOperators(Plugin):
    """Operators of `numpy.ndarray` that take numbers, rows and arrays and give an array."""

    def get_customize_class_mro_hook(self, fullname: str) -> Callable[[ClassDefContext], None] | None:
        """The change of the declaration of `numpy.ndarray`; None for every other class."""
        return one_signature if fullname == "numpy.ndarray" else None


def one_signature(context: ClassDefContext) -> None:
    """Leave of every operator two overloads, the fewest that mypy takes, with one signature."""
    for method in context.cls.defs.body:
        if isinstance(method, OverloadedFuncDef) and method.name in OPERATORS:
            method.items, method.unanalyzed_items = method.items[:2], method.unanalyzed_items[:2]
            for item in method.items:
                function = item.func if isinstance(item, Decorator) else item
                for signature in (function.type, function.unanalyzed_type):
                    if isinstance(signature, CallableType):
                        signature.variables = ()
                        signature.arg_types[:2] = [
                            AnyType(TypeOfAny.explicit),
                            UnionType([UnboundType(name) for name in OPERANDS]),
                        ]
                        signature.ret_type = UnboundType("ndarray")


def plugin(_version: str) -> type[Plugin]:
    """The entry point that mypy calls."""
    return ArrayOperators
