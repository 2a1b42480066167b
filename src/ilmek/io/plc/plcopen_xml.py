"""PLCopen XML: a control program as a project that engineering tools import.

Format: PLCopen TC6, XML formats for IEC 61131-3, version 2.01. The time of creation is a constant: the same program
gives the same bytes.
"""

from collections.abc import Iterable
from xml.etree import ElementTree as ET

from ilmek import __version__
from ilmek.io.plc.units import PlcArray, PlcProject, PlcSection, PlcStructure, PlcType, PlcUnit, PlcVariable

NAMESPACE = "http://www.plcopen.org/xml/tc6_0201"
XHTML = "http://www.w3.org/1999/xhtml"

ELEMENTARY = {"BOOL", "DWORD", "SINT", "INT", "DINT", "USINT", "UINT", "UDINT", "REAL", "LREAL", "STRING"}

_KINDS = {"FUNCTION": "function", "FUNCTION_BLOCK": "functionBlock", "PROGRAM": "program"}
_SECTIONS = {
    "VAR_INPUT": ("inputVars", {}),
    "VAR_OUTPUT": ("outputVars", {}),
    "VAR_IN_OUT": ("inOutVars", {}),
    "VAR": ("localVars", {}),
    "VAR RETAIN": ("localVars", {"retain": "true"}),
}
_CREATED = "2000-01-01T00:00:00"


def plcopen_xml(project: PlcProject) -> bytes:
    """The project as an XML document in UTF-8."""
    root = ET.Element("project", {"xmlns": NAMESPACE, "xmlns:xhtml": XHTML})
    ET.SubElement(
        root,
        "fileHeader",
        {"companyName": "ilmek", "productName": "ilmek", "productVersion": __version__, "creationDateTime": _CREATED},
    )
    content = ET.SubElement(root, "contentHeader", {"name": project.name})
    coordinates = ET.SubElement(content, "coordinateInfo")
    for language in ("fbd", "ld", "sfc"):
        ET.SubElement(ET.SubElement(coordinates, language), "scaling", {"x": "1", "y": "1"})
    types = ET.SubElement(root, "types")
    data = ET.SubElement(types, "dataTypes")
    for array in project.arrays:
        _array(ET.SubElement(ET.SubElement(data, "dataType", {"name": array.name}), "baseType"), array)
    for structure in project.structures:
        _structure(data, structure)
    units = ET.SubElement(types, "pous")
    for unit in project.units:
        _unit(units, unit)
    _instances(root, project)
    ET.indent(root)
    document: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return document + b"\n"


def _structure(parent: ET.Element, structure: PlcStructure) -> None:
    made = ET.SubElement(parent, "dataType", {"name": structure.name})
    _variables(ET.SubElement(ET.SubElement(made, "baseType"), "struct"), structure.variables)


def _unit(parent: ET.Element, unit: PlcUnit) -> None:
    made = ET.SubElement(parent, "pou", {"name": unit.name, "pouType": _KINDS[unit.kind]})
    interface = ET.SubElement(made, "interface")
    if unit.returns:
        _type(ET.SubElement(interface, "returnType"), unit.returns)
    for section in unit.sections:
        _section(interface, section)
    _text(ET.SubElement(ET.SubElement(made, "body"), "ST"), unit.body)
    _text(ET.SubElement(made, "documentation"), unit.meaning)


def _section(parent: ET.Element, section: PlcSection) -> None:
    name, attributes = _SECTIONS[section.kind]
    _variables(ET.SubElement(parent, name, attributes), section.variables)


def _variables(parent: ET.Element, variables: Iterable[PlcVariable]) -> None:
    for variable in variables:
        located = {"address": variable.address} if variable.address else {}
        made = ET.SubElement(parent, "variable", {"name": variable.name, **located})
        _type(ET.SubElement(made, "type"), variable.kind)
        if variable.initial:
            _initial(ET.SubElement(made, "initialValue"), variable.initial)
        if variable.meaning:
            _text(ET.SubElement(made, "documentation"), variable.meaning)


def _type(parent: ET.Element, kind: PlcType) -> None:
    if isinstance(kind, str) and kind in ELEMENTARY:
        ET.SubElement(parent, kind)
    else:
        ET.SubElement(parent, "derived", {"name": str(kind)})


def _array(parent: ET.Element, array: PlcArray) -> None:
    made = ET.SubElement(parent, "array")
    ET.SubElement(made, "dimension", {"lower": "0", "upper": str(array.size - 1)})
    _type(ET.SubElement(made, "baseType"), array.element)


def _initial(parent: ET.Element, initial: str | tuple[str, ...]) -> None:
    if isinstance(initial, str):
        ET.SubElement(parent, "simpleValue", {"value": initial})
        return
    values = ET.SubElement(parent, "arrayValue")
    for one in initial:
        ET.SubElement(ET.SubElement(values, "value"), "simpleValue", {"value": one})


def _text(parent: ET.Element, text: str) -> None:
    ET.SubElement(parent, "xhtml:p").text = text


def _instances(root: ET.Element, project: PlcProject) -> None:
    configurations = ET.SubElement(ET.SubElement(root, "instances"), "configurations")
    resource = ET.SubElement(
        ET.SubElement(configurations, "configuration", {"name": "Configuration"}), "resource", {"name": "Controller"}
    )
    task = ET.SubElement(resource, "task", {"name": "Cycle", "interval": project.interval, "priority": "1"})
    program = project.units[-1].name
    ET.SubElement(task, "pouInstance", {"name": f"{program}Instance", "typeName": program})
