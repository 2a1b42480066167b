"""Controllers for which the program is written: how each counts addresses, and in which files it takes a program."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from ilmek.io.plc.io_list import AddressStyle, IoRow, io_csv, io_rows
from ilmek.io.plc.main_program import main_program
from ilmek.io.plc.plcopen_xml import plcopen_xml
from ilmek.io.plc.scl import scl_source
from ilmek.io.plc.units import PlcProject
from ilmek.plugins import Registry

Writer = Callable[[PlcProject, list[IoRow]], bytes]


@dataclass(frozen=True, slots=True)
class PlcTarget:
    """A controller: its style of addresses, and the name and writer of each file of the program.

    node     of a variable on the controller's own OPC UA server, an identifier with {} for its name; "": it has none
    quote    around each part of that name
    signals  the program has a variable for each signal, beside its address
    """

    title: str
    style: AddressStyle
    writers: tuple[tuple[str, Writer], ...]
    node: str = ""
    quote: str = ""
    signals: bool = True

    def named(self, name: str) -> str:
        """A variable's name on that server: of a structure with its member."""
        return ".".join(f"{self.quote}{part}{self.quote}" for part in name.split("."))

    def files(self, project: PlcProject) -> dict[str, bytes]:
        """Contents of the program's files and of the list of inputs and outputs, by name."""
        rows = io_rows(project.units[-1], self.style)
        written = {name: writer(project, rows) for name, writer in self.writers}
        return written | {"io.csv": io_csv(project.units[-1], self.style).encode()}


def whole_program(project: PlcProject, rows: list[IoRow]) -> PlcProject:
    """The project with the program that its task runs."""
    return replace(project, units=(*project.units, main_program(project.units[-1], rows)))


def _text(project: PlcProject, rows: list[IoRow]) -> bytes:
    return whole_program(project, rows).text.encode()


def _xml(project: PlcProject, rows: list[IoRow]) -> bytes:
    return plcopen_xml(whole_program(project, rows))


def _scl(project: PlcProject, rows: list[IoRow]) -> bytes:
    return scl_source(project, rows).encode()


_IEC = (("loom.st", _text), ("loom.xml", _xml))

TARGETS = Registry(
    "ilmek.controllers",
    {
        "codesys": PlcTarget(
            "CODESYS 3", AddressStyle(by_bytes=False), _IEC,
            "ns=4;s=|var|CODESYS Control Win V3 x64.Application.Main.{}"
        ),
        "twincat": PlcTarget("TwinCAT 3", AddressStyle(by_bytes=True), _IEC, "ns=4;s=Main.{}"),
        "tia": PlcTarget(
            "TIA Portal, S7-1200 and S7-1500", AddressStyle(by_bytes=True, bit=""), (("loom.scl", _scl),),
            'ns=3;s="LoomData".{}', '"', signals=False,
        ),
        "openplc": PlcTarget("OpenPLC", AddressStyle(by_bytes=False), (("loom.st", _text),)),
    },
    PlcTarget,
)  # fmt: skip
"""Targets by name."""
