"""The changes that can be made of a source file, one at a time.

Left out are sites where a change is no error of a computation:
- figures and drawings: functions named so;
- annotations, decorators, messages, assertions, representations, declarations of parameters and results;
- tables of data, and numbers written outside functions or as a default: data with their source, which a test would
  only repeat;
- tolerances: numbers below 1e-4, constants of a module below 1e-4 or named like one, and what scales them;
- sample counts: the number of points of `linspace` and `geomspace`, rounds of a loop whose number is not used,
  digits of `round`.
"""

import ast
import copy
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

COMPARISONS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.GtE,
    ast.LtE: ast.Gt,
    ast.Gt: ast.LtE,
    ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
}
BOUNDARIES: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
}
ARITHMETIC: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.FloorDiv,
}
NAMES = {
    **{
        one: other
        for pair in (("max", "min"), ("any", "all"), ("maximum", "minimum"))
        for one, other in (pair, pair[::-1])
    },
    **{
        one: other
        for pair in (("sin", "cos"), ("real", "imag"), ("argmax", "argmin"))
        for one, other in (pair, pair[::-1])
    },
}
TOLERANCE = 1e-4
"""Numbers below it are tolerances of the numerics: a change of one is no change of what is computed."""
TOLERANCES = re.compile(
    r"_?(ROUNDING|TOLERANCE|ACCURACY|SLACK|GRACE|NOTHING|SAME|MET|STILL|NEAR)|.*_(ROUNDING|TOLERANCE)"
)
"""Names of tolerances, where a module imports them."""
DISPLAY = re.compile(r"^__(repr|str)__$|(^|_)(drawings?|figures?|plots?|pictures?|animations?)(_|$)")
"""Names of functions whose output is looked at."""
POINTS = {"linspace": 2, "geomspace": 2, "round": 1}
"""Functions and the index of their argument that is a number of points or digits."""


@dataclass(frozen=True)
class Mutant:
    """One change of a module: which variant of which node of its syntax tree, and what it says before and after.

    number  of those with the same key, from 1 on
    """

    module: str
    function: str
    line: int
    before: str
    after: str
    node: int
    variant: int
    number: int = 1

    @property
    def key(self) -> str:
        """What it is, whatever its line."""
        return f"{self.module} {self.function}: {self.before} -> {self.after}"

    @property
    def position(self) -> str:
        """What it is, and which of those in the same function, whatever its line."""
        return f"{self.key} {self.number}"


def mutants_of(module: str, source: str) -> list[Mutant]:
    """All changes of a module's source."""
    tree = ast.parse(source)
    functions = dict(_functions(tree))
    left_out = _left_out(tree)
    found, times = [], Counter[str]()
    for index, node in enumerate(ast.walk(tree)):
        if isinstance(node, ast.expr) and node not in left_out:
            for variant, changed in enumerate(_variants(node)):
                texts = ast.unparse(node), ast.unparse(changed)
                made = Mutant(module, functions.get(index, ""), node.lineno, *texts, index, variant)
                times[made.key] += 1
                found.append(replace(made, number=times[made.key]))
    return found


def mutated(source: str, mutant: Mutant) -> ast.Module:
    """The syntax tree of the source with the change made."""
    tree = ast.parse(source)
    target = list(ast.walk(tree))[mutant.node]
    assert isinstance(target, ast.expr)
    _Replacement(target, list(_variants(target))[mutant.variant]).visit(tree)
    return ast.fix_missing_locations(tree)


class _Replacement(ast.NodeTransformer):
    def __init__(self, target: ast.expr, replacement: ast.expr) -> None:
        self.target, self.replacement = target, ast.copy_location(replacement, target)

    def visit(self, node: ast.AST) -> ast.AST:
        return self.replacement if node is self.target else self.generic_visit(node)


def _functions(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Index in the order of `ast.walk`, and name of its function, of every node; no name of what is run at import."""
    names: dict[ast.AST, str] = {}

    def name(node: ast.AST, inside: str, in_function: bool) -> None:
        for child in ast.iter_child_nodes(node):
            own = f"{inside}.{child.name}".strip(".") if isinstance(child, ast.FunctionDef | ast.ClassDef) else inside
            within = in_function or isinstance(child, ast.FunctionDef)
            names[child] = own if within else ""
            name(child, own, within)

    name(tree, "", False)
    yield from ((index, names.get(one, "")) for index, one in enumerate(ast.walk(tree)))


def _left_out(tree: ast.Module) -> set[ast.AST]:
    """Nodes that are no computation, as the module's docstring lists them."""
    roots: list[ast.AST | None] = [*_data(tree)]
    for node in ast.walk(tree):
        roots += _settings(node)
        match node:
            case ast.FunctionDef():
                arguments = [*node.args.args, *node.args.kwonlyargs, *node.args.posonlyargs]
                defaults = [one for one in (*node.args.defaults, *node.args.kw_defaults) if one and _is_number(one)]
                roots += [node.returns, *node.decorator_list, *(one.annotation for one in arguments), *defaults]
            case ast.AnnAssign():
                roots.append(node.annotation)
                if ast.unparse(node.annotation).endswith("TypeAlias") or _is_declaration(node.value):
                    roots.append(node.value)
            case ast.ClassDef():
                roots += [*node.decorator_list, *node.bases]
            case ast.Dict() | ast.Tuple() | ast.List() if _is_table(node):
                roots.append(node)
            case ast.Raise() | ast.JoinedStr() | ast.Assert() | ast.Import() | ast.ImportFrom():
                roots.append(node)
            case ast.If() if "__name__" in ast.unparse(node.test):
                roots.append(node)
            case ast.Assign() if isinstance(node.value, ast.Subscript | ast.BinOp) and _is_alias(node.value):
                roots.append(node.value)
    return _tolerances(tree) | {inner for root in roots if root is not None for inner in ast.walk(root)}


def _constants(tree: ast.Module) -> Iterator[tuple[str, ast.expr]]:
    """Names in capitals that a module gives a value."""
    for node in tree.body:
        match node:
            case (
                ast.Assign(targets=[ast.Name(id=name)], value=value)
                | ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as value)
            ) if name.isupper():
                yield name, value


def _data(node: ast.AST) -> Iterator[ast.AST]:
    """Numbers outside functions."""
    for child in ast.iter_child_nodes(node):
        if _is_number(child):
            yield child
        elif not isinstance(child, ast.FunctionDef | ast.Lambda):
            yield from _data(child)


def _tolerances(tree: ast.Module) -> set[ast.AST]:
    """Products with a tolerance, whole; of sums and differences with one, whether it is added."""
    small = {name for name, value in _constants(tree) if _is_tolerance(value, set())}
    found: set[ast.AST] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and any(_is_tolerance(side, small) for side in (node.left, node.right)):
            found |= set(ast.walk(node)) if isinstance(node.op, ast.Mult | ast.Div) else {node}
        elif isinstance(node, ast.BinOp) and _is_nearly_one(node.right, small):
            found |= {node, *ast.walk(node.right)}
    return found


def _is_number(value: ast.AST) -> bool:
    """Whether it is a literal number, also with a sign or a unit, or a fraction of two."""
    match value:
        case ast.UnaryOp():
            return _is_number(value.operand)
        case ast.BinOp(op=ast.Mult() | ast.Div() as operator, right=right):
            unit = isinstance(operator, ast.Mult) and isinstance(right, ast.Name)
            return _is_number(value.left) and (unit or _is_number(right))
    return isinstance(value, ast.Constant) and isinstance(value.value, int | float)


def _is_tolerance(value: ast.expr, small: set[str]) -> bool:
    """Whether it is a number below `TOLERANCE`, or the name of one."""
    match value:
        case ast.Constant(value=float() as number):
            return 0 < abs(number) < TOLERANCE
        case ast.Name(id=name):
            return name in small or TOLERANCES.fullmatch(name) is not None
        case ast.BinOp(op=ast.Mult() | ast.Div()):
            return _is_tolerance(value.left, small) or _is_tolerance(value.right, small)
    return False


def _is_nearly_one(value: ast.expr, small: set[str]) -> bool:
    """Whether it is 1, more or less a tolerance."""
    match value:
        case ast.BinOp(left=ast.Constant(value=1), op=ast.Add() | ast.Sub(), right=right):
            return _is_tolerance(right, small)
    return False


def _settings(node: ast.AST) -> list[ast.AST]:
    """Functions of display; numbers of points, rounds or digits."""
    match node:
        case ast.FunctionDef(name=name) if DISPLAY.search(name):
            return [node]
        case ast.For(target=ast.Name(id="_"), iter=ast.Call(func=ast.Name(id="range")) as rounds):
            return [rounds]
        case ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name)) if name in POINTS:
            return [*node.args[POINTS[name] :][:1], *(one.value for one in node.keywords if one.arg == "num")]
    return []


def _is_declaration(value: ast.expr | None) -> bool:
    """Whether it declares a parameter or a result: a call with a documentation."""
    return isinstance(value, ast.Call) and any(keyword.arg == "doc" for keyword in value.keywords)


def _is_table(collection: ast.Dict | ast.Tuple | ast.List) -> bool:
    """Whether it is a table of data, copied from its source: eight numbers or more."""
    numbers = [
        node for node in ast.walk(collection) if isinstance(node, ast.Constant) and not isinstance(node.value, str)
    ]
    return len(numbers) >= 8 and not any(
        isinstance(node, ast.Name | ast.comprehension) for node in ast.walk(collection)
    )


def _is_alias(value: ast.expr) -> bool:
    """Whether it is a name for a type, like `Float[np.ndarray, "n"]` or `int | None`."""
    return "ndarray" in ast.unparse(value) or "None" in ast.unparse(value)


def _variants(node: ast.expr) -> Iterator[ast.expr]:
    """What an expression may be changed into."""
    yield from _of_operators(node)
    yield from _of_values(node)


def _of_operators(node: ast.expr) -> Iterator[ast.expr]:
    match node:
        case ast.Compare(ops=[operator], comparators=[right]):
            yield from _compared(node, operator, right)
        case ast.BoolOp():
            yield _with(node, op=ast.Or() if isinstance(node.op, ast.And) else ast.And())
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            yield node.operand
        case ast.BinOp() if not any(
            isinstance(inner, ast.Constant) and isinstance(inner.value, str) for inner in ast.walk(node)
        ):
            yield from _computed(node)
        case ast.IfExp():
            yield _with(node, body=node.orelse, orelse=node.body)


def _of_values(node: ast.expr) -> Iterator[ast.expr]:
    match node:
        case ast.Constant(value=int() as value) if not isinstance(value, bool):
            yield _with(node, value=value + 1 if abs(value) < 100 else value + value // 10)
        case ast.Constant(value=float() as value) if abs(value) >= TOLERANCE:
            yield _with(node, value=value * 1.1)
        case ast.Call(func=ast.Name(id="abs"), args=[inner]):
            yield inner
        case ast.Call(func=ast.Name(id=name)) if name in NAMES:
            yield _with(node, func=ast.Name(NAMES[name], ast.Load()))
        case ast.Call(func=ast.Attribute(attr=name) as function) if name in NAMES:
            yield _with(node, func=_with(function, attr=NAMES[name]))
        case ast.Attribute(attr="real" | "imag" as name, ctx=ast.Load()):
            yield _with(node, attr=NAMES[name])


def _compared(node: ast.Compare, operator: ast.cmpop, right: ast.expr) -> Iterator[ast.expr]:
    """The opposite; and the other boundary of whole numbers, where being equal is a case of its own."""
    if type(operator) in COMPARISONS:
        yield _with(node, ops=[COMPARISONS[type(operator)]()])
    if type(operator) in BOUNDARIES and any(_is_whole(side) for side in (node.left, right)):
        yield _with(node, ops=[BOUNDARIES[type(operator)]()])


def _is_whole(side: ast.expr) -> bool:
    match side:
        case ast.Constant(value=int() as value):
            return value > 0
        case ast.Call(func=ast.Name(id="len")) | ast.Attribute(attr="size" | "ndim"):
            return True
    return False


def _computed(node: ast.BinOp) -> Iterator[ast.expr]:
    """The opposite operation, and products and quotients without one factor."""
    if type(node.op) in ARITHMETIC:
        yield _with(node, op=ARITHMETIC[type(node.op)]())
    if isinstance(node.op, ast.Mult | ast.Div | ast.Pow):
        yield node.left
    if isinstance(node.op, ast.Mult):
        yield node.right


def _with(node: ast.expr, **changes: object) -> ast.expr:
    changed = copy.copy(node)
    for name, value in changes.items():
        setattr(changed, name, value)
    return changed
