"""The loom's own namespace as a NodeSet, the XML by which engineers' tools take over an address space."""

import asyncio
import tempfile
from pathlib import Path

from asyncua import Server

from ilmek.drivers.opcua.model import NAMESPACE, LoomNameplate
from ilmek.drivers.opcua.space import AddressSpace


def exported_nodeset(plate: LoomNameplate) -> str:
    """The types and objects of a loom, without values; it requires the NodeSets in `space.NODE_SETS`."""
    return asyncio.run(_exported(plate))


async def _exported(plate: LoomNameplate) -> str:
    server = Server()
    await server.init()
    await AddressSpace(server, plate).build()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "nodeset.xml"
        await server.export_xml_by_ns(str(path), [NAMESPACE])
        return path.read_text(encoding="utf-8")
