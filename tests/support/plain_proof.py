"""The rules of a programme in plain Python, knot by knot and pair by pair: what the proof is compared with."""

from collections import Counter

from ilmek.loom.operations import EMPTY, ROW_ENDS, LoomProgramme, RowEnd, RowOperations, Stop

Knots = list[tuple[int, int]]


def broken_rules(programme: LoomProgramme) -> list[str]:
    """The names of the rules that are broken, in order."""
    rules = PlainRules(programme)
    for number in range(programme.setup.rows):
        rules.weave(programme.operations(number), programme.chart_row(number).tolist())
    return rules.broken


class PlainRules:
    """Weaves a programme row by row, and keeps what is broken."""

    def __init__(self, programme: LoomProgramme) -> None:
        self.setup = setup = programme.setup
        self.broken: list[str] = []
        self.yarn = {(h, t): int(setup.loading[h, t]) for h in range(setup.heads) for t in range(setup.tubes)}
        self.left = {key: float(setup.packages[key]) for key in self.yarn}
        self.position: dict[int, int] = {}
        self.woven = Counter[int]()

    def require(self, holds: bool, rule: str) -> None:
        self.broken += [] if holds else [rule]

    def weave(self, row: RowOperations, chart: list[int]) -> None:
        knots = list(zip(row.columns.tolist(), row.tubes.tolist(), strict=True))
        parts = [[[knots.pop(0) for _ in range(count)] for count in phases] for phases in row.counts.tolist()]
        for head, phases in enumerate(parts):
            self.begin(head, [knot for phase in phases for knot in phase])
        for phase in range(row.phases):
            for stop in row.stops:
                if stop.phase == phase:
                    self.change(stop)
            self.tie([phases[phase] for phases in parts], chart)
        tied = [column for column, yarn in enumerate(chart) if yarn != EMPTY]
        self.require(sorted(row.columns.tolist()) == tied, "each knot once")
        self.require(row.ends == ROW_ENDS, "the end of the row")
        for weft, end in enumerate((RowEnd.STRAIGHT_WEFT, RowEnd.SINUOUS_WEFT)[: len(self.setup.wefts)]):
            self.woven[weft] += row.ends.count(end)
            self.require(self.woven[weft] <= self.setup.wefts[weft].rows, "weft enough")

    def begin(self, head: int, knots: Knots) -> None:
        if knots:
            idle = max(abs(knots[0][0] - self.position.get(head, knots[0][0])) - 1, 0)
            times = self.setup.times
            self.require(idle * round(1e9 * times.travel) <= round(1e9 * times.row_ends[-1]), "time to the next row")
            self.position[head] = knots[0][0]

    def change(self, stop: Stop) -> None:
        self.require(len(set(stop.wefts)) == len(stop.wefts), "a bobbin once in a stop")
        for weft in stop.wefts:
            self.woven[weft] = 0
        for one in stop.tubes:
            self.require(one.length > 0, "yarn on a package")
            self.yarn[one.head, one.tube], self.left[one.head, one.tube] = one.yarn, one.length

    def tie(self, parts: list[Knots], chart: list[int]) -> None:
        visited: dict[int, set[int]] = {}
        for head, knots in enumerate(parts):
            for column, tube in knots:
                visited.setdefault(head, set()).add(column)
                self.position[head] = column
                yarn = self.yarn.get((head, tube), EMPTY)
                self.require(yarn != EMPTY and chart[column] == yarn, "the chart's colour")
                if yarn != EMPTY:
                    self.left[head, tube] -= self.setup.knot_yarn[yarn]
                    self.require(self.left[head, tube] >= -1e-9, "yarn enough")
        if visited:
            first, last, spacing = min(visited), max(visited), self.setup.spacing
            self.require(min(visited[first]) >= first * spacing, "room at the left")
            beyond = self.setup.columns - 1 - max(visited[last])
            self.require(beyond >= (self.setup.heads - 1 - last) * spacing, "room at the right")
        for one, columns in visited.items():
            for other, others in visited.items():
                near = min(b - a for a in columns for b in others)
                self.require(one >= other or near >= (other - one) * self.setup.spacing, "heads apart")
