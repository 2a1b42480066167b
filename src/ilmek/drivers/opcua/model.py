"""The loom's own types, and what a server shows of the loom: plain tables, without OPC UA.

Paths are those of the nodes' identifiers: `Loom.Carpet.Row`. What comes from companion specifications is instantiated
from their own types; see `space`.
"""

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.records import value_record

NAMESPACE = "urn:ilmek:loom"
"""URI of the loom's own namespace."""

LOOM = "Loom"
"""Identifier of the loom's object, and browse name in the folder Machines."""


@value_record
class LoomNameplate:
    """What a server states about the loom and its carpet, which does not change while it runs.

    programme   digest of the programme      title   what people call it, such as its file name
    yarns       names of the carpet's yarns  bobbins names of the bobbins of weft
    """

    manufacturer: str
    model: str
    serial: str
    software: str
    programme: str
    title: str
    rows: int
    columns: int
    heads: int
    tubes: int
    yarns: tuple[str, ...]
    bobbins: tuple[str, ...] = ()

    @property
    def uri(self) -> str:
        """Unique URI of the loom, and of the server as an application."""
        return f"urn:ilmek:loom:{self.serial}"


@value_record
class TypeField:
    """A variable of one of the loom's own types: name, data type of OPC UA, meaning; array: of any length."""

    name: str
    data: str
    meaning: str
    array: bool = False


TYPES: Mapping[str, tuple[TypeField, ...]] = MappingProxyType(
    {
        "CarpetType": (
            TypeField("Programme", "String", "digest of the programme, SHA-256"),
            TypeField("Title", "String", "name of the programme's file"),
            TypeField("Rows", "UInt32", "rows of the carpet"),
            TypeField("Columns", "UInt32", "knots of a row"),
            TypeField("Row", "UInt32", "row in work, from 0 at the bottom edge"),
            TypeField("Knots", "UInt32", "certain knots: durable in the journal"),
            TypeField("KnotsTotal", "UInt32", "knots of the carpet"),
            TypeField("KnotsUncertain", "UInt32", "knots that were begun and whose end is not known"),
            TypeField("Faults", "UInt32", "knots that had to be tried again"),
            TypeField("LoomTime", "Duration", "the loom's clock [ms]"),
            TypeField("TimeLeft", "Duration", "until the end by the programme, without faults [ms]"),
            TypeField("OperatorTask", "String", "what the operator changes in the stop that the loom waits in"),
        ),
        "HeadType": (
            TypeField("Column", "UInt32", "warp pair of the knot in work or of the last one; Bad_NoData: none yet"),
            TypeField("Tube", "UInt32", "its tube"),
            TypeField("Yarn", "String", "its yarn"),
            TypeField("RowKnots", "UInt32", "knots of the head in this row"),
            TypeField("RowKnotsTied", "UInt32", "of these, those that are done"),
            TypeField("NextYarn", "String", "of its next knot in another yarn; Bad_NoData: none in this row"),
        ),
        "YarnPackageType": (
            TypeField("Yarn", "String", "yarn of the package; Bad_NoData: the tube is empty"),
            TypeField("Left", "Double", "length left [m]"),
        ),
        "WeftBobbinType": (
            TypeField("Weft", "String", "name of the weft"),
            TypeField("RowsLeft", "UInt32", "rows that the bobbin lasts"),
        ),
        "AlarmListType": (
            TypeField("Count", "UInt32", "number of active alarms"),
            TypeField("Names", "String", "of the active alarms, stable", array=True),
            TypeField("Causes", "String", "of each", array=True),
            TypeField("Remedies", "String", "of each", array=True),
            TypeField("Stops", "Boolean", "whether the loom stands until it is cleared", array=True),
        ),
        "LoomStatusType": (
            TypeField("State", "String", "state by PackML, as the controller names it"),
            TypeField("StateNumber", "UInt32", "its number by PackTags, Status.StateCurrent"),
            TypeField("Mode", "String", "mode by PackML"),
            TypeField("ModeNumber", "UInt32", "its number by PackTags, Status.UnitModeCurrent"),
            TypeField("Commands", "String", "commands that the state permits", array=True),
            TypeField("LastRefusal", "String", "why the controller refused the last command that it refused"),
        ),
    }
)
"""Object types of the loom's namespace, all subtypes of BaseObjectType."""

METHODS: Mapping[str, Mapping[str, tuple[str, str]]] = MappingProxyType(
    {
        "LoomStatusType": {
            "Resume": ("resume", "lead the loom on to Execute from wherever it stands; acknowledges all alarms"),
            "AnswerYes": ("yes", "answer what the controller asks: the knot or operation is in the carpet"),
            "AnswerNo": ("no", "the same: it is not in the carpet"),
        },
        "AlarmListType": {"Acknowledge": ("acknowledge", "all alarms were seen and their causes removed")},
    }
)
"""Methods of these types, all without arguments: the command that each gives, and its meaning."""

ALARM_TYPE = "LoomAlarmType"
ALARM_FIELDS = (
    TypeField("Cause", "String", "cause of the alarm"),
    TypeField("Remedy", "String", "what the operator does about it"),
    TypeField("StopsLoom", "Boolean", "whether the loom stands until it is cleared"),
)
"""Type of the events of alarms: a subtype of OffNormalAlarmType with these properties."""


def own_objects(plate: LoomNameplate) -> dict[str, str]:
    """Path and type of each object of the loom's own types."""
    found = {f"{LOOM}.Status": "LoomStatusType", f"{LOOM}.Carpet": "CarpetType", f"{LOOM}.Alarms": "AlarmListType"}
    for head in range(plate.heads):
        found[f"{LOOM}.Heads.Head{head}"] = "HeadType"
        found |= {f"{LOOM}.Heads.Head{head}.Tube{tube}": "YarnPackageType" for tube in range(plate.tubes)}
    return found | {f"{LOOM}.Bobbins.Bobbin{index}": "WeftBobbinType" for index, _ in enumerate(plate.bobbins)}
