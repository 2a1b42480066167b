"""The address space: companion NodeSets, the loom's own types, instances of both, and their values."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from datetime import UTC, datetime
from importlib import resources
from typing import Any

from asyncua import Server, ua
from asyncua.server.address_space import NodeData

from ilmek.drivers.opcua.model import (
    ALARM_FIELDS,
    ALARM_TYPE,
    LOOM,
    METHODS,
    NAMESPACE,
    TYPES,
    LoomNameplate,
    TypeField,
    own_objects,
)
from ilmek.drivers.opcua.values import BLOCKS, PACKML, CurrentState

NODE_SETS: Mapping[str, tuple[str, str]] = {
    "DI": ("di.xml", "http://opcfoundation.org/UA/DI/"),
    "Machinery": ("machinery.xml", "http://opcfoundation.org/UA/Machinery/"),
    "ISA95": ("isa95-jobcontrol.xml", "http://opcfoundation.org/UA/ISA95-JOBCONTROL_V2/"),
    "Jobs": ("machinery-jobs.xml", "http://opcfoundation.org/UA/Machinery/Jobs/"),
    "PackML": ("packml.xml", "http://opcfoundation.org/UA/PackML/"),
}
"""File and namespace of each companion specification, in an order in which they can be loaded."""

_WITHOUT_STRUCTURES = {"DI", "Jobs"}
"""NodeSets with option sets, which asyncua 2.1 cannot load as structures; the loom uses none of them."""

OPTIONAL = frozenset(
    (
        "Manufacturer", "Model", "SerialNumber", "SoftwareRevision", "ProductInstanceUri", "Number", "PackMLVersion",
        "TagID", "Abort", "Clear", "Stop", "Reset", "Start", "Hold", "Unhold", "Suspend", "Unsuspend",
        "StoreAndStart", "Store", "Pause", "Resume", "Cancel", "RevokeStart", "JobOrderResponseList",
    )
)  # fmt: skip
"""Browse names of optional children that the instances have."""

_A, _I = ua.AttributeIds, ua.ObjectIds
_TYPE_CLASSES = (ua.NodeClass.ObjectType, ua.NodeClass.VariableType, ua.NodeClass.DataType, ua.NodeClass.ReferenceType)
_CHILD_REFERENCES = {_I.HasComponent, _I.HasProperty, _I.HasAddIn, _I.Organizes, _I.HasOrderedComponent}


class SharedValue(ua.DataValue):
    """A value that nobody changes: all subscribers have the same one, of which asyncua would make a copy for each."""

    def __deepcopy__(self, _: object) -> "SharedValue":
        return self


class AddressSpace:
    """The nodes of a server. Build it before the server starts; write values on the server's event loop."""

    def __init__(self, server: Server, plate: LoomNameplate) -> None:
        self.server, self.plate = server, plate
        self.spaces: dict[str, int] = {"UA": 0}
        self._types: dict[str, ua.NodeId] = {}
        self._variant: dict[str, tuple[ua.VariantType, bool]] = {}
        self._last: dict[str, object] = {}
        self._methods: dict[str, tuple[ua.NodeId, ua.NodeId]] = {}

    async def build(self) -> None:
        """Load the NodeSets and make all nodes."""
        for key, (file, uri) in NODE_SETS.items():
            text = (resources.files("ilmek.drivers.opcua") / "nodesets" / file).read_text(encoding="utf-8-sig")
            await self.server.import_xml(xmlstring=text, auto_load_definitions=key not in _WITHOUT_STRUCTURES)
            self.spaces[key] = await self.server.get_namespace_index(uri)
        self.spaces["Loom"] = await self.server.register_namespace(NAMESPACE)
        self._index_types()
        await self._own_types()
        await self._loom()

    def node_id(self, path: str) -> ua.NodeId:
        """The identifier of a node of the loom."""
        return ua.NodeId(path, self.spaces["Loom"], ua.NodeIdType.String)

    def type_id(self, name: str) -> ua.NodeId:
        """The identifier of a type: "Machinery:MachineIdentificationType"; without a namespace one of OPC UA."""
        return self._types[name]

    @property
    def paths(self) -> tuple[str, ...]:
        """The paths of all variables of the loom."""
        return tuple(self._variant)

    @property
    def methods(self) -> tuple[str, ...]:
        """The paths of all methods of the loom."""
        return tuple(self._methods)

    def bind(self, path: str, called: Callable[..., object]) -> tuple[ua.NodeId, ua.NodeId]:
        """Answer calls of a method, at the instance and at its type, by a coroutine function."""
        for identifier in self._methods[path]:
            self.server.iserver.isession.add_method_callback(identifier, called)
        return self._methods[path]

    async def write(self, values: Mapping[str, object]) -> int:
        """Write the values that have changed; the number of nodes written."""
        now, written = datetime.now(UTC), 0
        for path, value in values.items():
            if path not in self._variant or (path in self._last and self._last[path] == value):
                continue
            self._last[path] = value
            if isinstance(value, CurrentState) or (value is None and path.endswith(".CurrentState")):
                await self._write_state(path, value, now)
            else:
                await self._write(path, value, now)
            written += 1
        return written

    async def _write(self, path: str, value: object, now: datetime, bad: int = ua.StatusCodes.BadNoData) -> None:
        kind, array = self._variant[path]
        if value is None:
            written = SharedValue(StatusCode=ua.StatusCode(bad), SourceTimestamp=now, ServerTimestamp=now)
        else:
            if kind is ua.VariantType.LocalizedText:
                value = ua.LocalizedText(value)
            variant = ua.Variant(value, kind, is_array=True) if array else ua.Variant(value, kind)
            written = SharedValue(variant, ua.StatusCode(), now, now)
        await self.server.iserver.write_attribute_value(self.node_id(path), written)

    async def _write_state(self, path: str, state: CurrentState | None, now: datetime) -> None:
        identifier, number = (None, None) if state is None else self._state(state)
        bad = ua.StatusCodes.BadStateNotActive
        await self._write(path, None if state is None else state.name, now, bad)
        await self._write(f"{path}.Id", identifier, now, bad)
        if f"{path}.Number" in self._variant:
            await self._write(f"{path}.Number", number, now, bad)

    def _state(self, state: CurrentState) -> tuple[ua.NodeId, int | None]:
        for owner in self._with_supertypes(self.type_id(state.machine)):
            for child in self._children(owner):
                if child.BrowseName.Name == state.name and child.NodeClass == ua.NodeClass.Object:
                    number = [one for one in self._children(child.NodeId) if one.BrowseName.Name == "StateNumber"]
                    return child.NodeId, None if not number else self._attribute(number[0].NodeId, _A.Value)
        raise KeyError(state)

    def members(self, machine: str, kind: str) -> list[ua.NodeId]:
        """The states or the transitions of a state machine type: its children of a type, "StateType" for example."""
        owners = self._with_supertypes(self.type_id(machine))
        children = (child for owner in owners for child in self._children(owner))
        return [child.NodeId for child in children if child.TypeDefinition == self.type_id(kind)]

    def state_number(self, machine: str, name: str) -> tuple[ua.NodeId, int]:
        """Node and number of a state of a state machine type."""
        identifier, number = self._state(CurrentState(machine, name))
        return identifier, 0 if number is None else int(number)

    async def _own_types(self) -> None:
        base, alarm = ua.NodeId(_I.BaseObjectType), ua.NodeId(_I.OffNormalAlarmType)
        for name, fields in TYPES.items():
            await self._own_type(name, base, fields, ua.NodeId(_I.HasComponent), _I.BaseDataVariableType)
        await self._own_type(ALARM_TYPE, alarm, ALARM_FIELDS, ua.NodeId(_I.HasProperty), _I.PropertyType)
        await self._own_type("LoomType", base, (), ua.NodeId(_I.HasComponent), _I.BaseDataVariableType)

    async def _own_type(
        self, name: str, base: ua.NodeId, fields: Iterable[TypeField], reference: ua.NodeId, kind: int
    ) -> None:
        identifier = self._types[f"Loom:{name}"] = self.node_id(name)
        attributes = ua.ObjectTypeAttributes(DisplayName=ua.LocalizedText(name), IsAbstract=False)
        await self._add(
            base, ua.NodeId(_I.HasSubtype), identifier, self._own_name(name), attributes=attributes, kind=None
        )
        for method, (_, meaning) in METHODS.get(name, {}).items():
            child = self.node_id(f"{name}.{method}")
            called = ua.MethodAttributes(
                DisplayName=ua.LocalizedText(method),
                Description=ua.LocalizedText(meaning),
                Executable=True,
                UserExecutable=True,
            )
            await self._add(identifier, reference, child, self._own_name(method), attributes=called, kind=None)
            await self._refer(child, _I.HasModellingRule, ua.NodeId(_I.ModellingRule_Mandatory))
        for field in fields:
            variable = ua.VariableAttributes(
                DisplayName=ua.LocalizedText(field.name),
                Description=ua.LocalizedText(field.meaning),
                DataType=self._types[field.data],
                Value=self._default(field),
                ValueRank=1 if field.array else -1,
                ArrayDimensions=[0] if field.array else None,
                AccessLevel=ua.AccessLevel.CurrentRead.mask,
                UserAccessLevel=ua.AccessLevel.CurrentRead.mask,
            )
            child = self.node_id(f"{name}.{field.name}")
            await self._add(
                identifier, reference, child, self._own_name(field.name), attributes=variable, kind=ua.NodeId(kind)
            )
            await self._refer(child, _I.HasModellingRule, ua.NodeId(_I.ModellingRule_Mandatory))

    def _default(self, field: TypeField) -> ua.Variant:
        encoding = self.encoding(self._types[field.data])
        return ua.Variant([] if field.array else ua.get_default_value(encoding), encoding, is_array=field.array)

    async def _loom(self) -> None:
        machines = self._child(ua.NodeId(_I.ObjectsFolder), "Machines")
        organizes, component, add_in = (ua.NodeId(one) for one in (_I.Organizes, _I.HasComponent, _I.HasAddIn))
        folder = ua.NodeId(_I.FolderType)
        machine, blocks = self.node_id(LOOM), self.node_id(BLOCKS)
        await self._object(machines, organizes, LOOM, self._own_name(LOOM), self._types["Loom:LoomType"])
        await self.instance(LOOM, "DI:Identification", "Machinery:MachineIdentificationType", add_in)
        await self._object(machine, component, BLOCKS, self._name("Machinery:MachineryBuildingBlocks"), folder)
        for name, kind in (
            ("Machinery:MachineryItemState", "Machinery:MachineryItemState_StateMachineType"),
            ("Machinery:MachineryOperationMode", "Machinery:MachineryOperationModeStateMachineType"),
            ("Jobs:JobManagement", "Jobs:JobManagementType"),
        ):
            await self.instance(BLOCKS, name, kind, add_in)
        await self._refer(blocks, _I.Organizes, self.node_id(f"{LOOM}.Identification"))
        await self.instance(LOOM, "Loom:PackML", "PackML:PackMLBaseObjectType", component)
        await self._refer(self._child(ua.NodeId(_I.ObjectsFolder), "PackMLObjects"), _I.Organizes, self.node_id(PACKML))
        for group in ("Heads", "Bobbins") if self.plate.bobbins else ("Heads",):
            await self._object(machine, component, f"{LOOM}.{group}", self._own_name(group), folder)
        for path, kind in own_objects(self.plate).items():
            parent, _, name = path.rpartition(".")
            await self.instance(parent, f"Loom:{name}", f"Loom:{kind}", component)

    async def instance(self, parent: str, name: str, kind: str, reference: ua.NodeId) -> None:
        """Make an object of a type below a node of the loom, with its mandatory children and those of `OPTIONAL`."""
        path = f"{parent}.{name.partition(':')[2]}"
        await self._object(self.node_id(parent), reference, path, self._name(name), self._types[kind])
        await self._copy_children(path, [self._types[kind]])

    async def _copy_children(self, path: str, declarations: list[ua.NodeId]) -> None:
        """Copy the children of instance declarations and types, those of the first where several have a name."""
        copied: dict[str, list[ua.ReferenceDescription]] = {}
        for owner in (supertype for declared in declarations for supertype in self._with_supertypes(declared)):
            for child in self._children(owner):
                rule = self._rule(child.NodeId)
                if rule == _I.ModellingRule_Mandatory or (
                    rule == _I.ModellingRule_Optional and child.BrowseName.Name in OPTIONAL
                ):
                    copied.setdefault(child.BrowseName.Name, []).append(child)
        for name, children in copied.items():
            await self._copy(path, f"{path}.{name}", children)

    async def _copy(self, parent: str, path: str, children: list[ua.ReferenceDescription]) -> None:
        child, node = children[0], self._node(children[0].NodeId)
        identifier = self.node_id(path)
        attributes: Any
        kind: ua.NodeId | None = child.TypeDefinition
        if child.NodeClass == ua.NodeClass.Variable:
            attributes = self._variable_attributes(node)
            encoding = self.encoding(attributes.DataType)
            if encoding is not None:
                self._variant[path] = encoding, attributes.ValueRank >= 1
        elif child.NodeClass == ua.NodeClass.Method:
            attributes, kind = ua.MethodAttributes(Executable=True, UserExecutable=True), None
            self._methods[path] = identifier, children[-1].NodeId
        else:
            attributes = ua.ObjectAttributes()
        attributes.DisplayName = ua.LocalizedText(child.BrowseName.Name)
        attributes.Description = self._attribute(child.NodeId, _A.Description) or ua.LocalizedText()
        await self._add(
            self.node_id(parent), child.ReferenceTypeId, identifier, child.BrowseName, attributes=attributes, kind=kind
        )
        below = [one.NodeId for one in children]
        if kind is not None and not kind.is_null():
            below.append(kind)
        await self._copy_children(path, below)

    def _variable_attributes(self, node: NodeData) -> ua.VariableAttributes:
        found = {name: self._attribute(node.nodeid, getattr(_A, name)) for name in ("DataType", "ValueRank", "Value")}
        dimensions = self._attribute(node.nodeid, _A.ArrayDimensions)
        value = node.attributes[_A.Value].value
        return ua.VariableAttributes(
            DataType=found["DataType"],
            ValueRank=found["ValueRank"],
            ArrayDimensions=dimensions or None,
            Value=ua.Variant() if value is None or value.Value is None else value.Value,
            AccessLevel=ua.AccessLevel.CurrentRead.mask,
            UserAccessLevel=ua.AccessLevel.CurrentRead.mask,
        )

    def encoding(self, data_type: ua.NodeId) -> ua.VariantType | None:
        """The built-in type by which values of a data type are encoded: the one that it is derived from."""
        for identifier in self._with_supertypes(data_type):
            if identifier.NamespaceIndex == 0 and identifier.Identifier == _I.Enumeration:
                return ua.VariantType.Int32
            if identifier.NamespaceIndex == 0 and 1 <= identifier.Identifier <= _I.Structure:
                return ua.VariantType(identifier.Identifier)
        return None

    async def _object(
        self, parent: ua.NodeId, reference: ua.NodeId, path: str, name: ua.QualifiedName, kind: ua.NodeId
    ) -> None:
        attributes = ua.ObjectAttributes(DisplayName=ua.LocalizedText(name.Name))
        await self._add(parent, reference, self.node_id(path), name, attributes=attributes, kind=kind)

    async def _add(
        self,
        parent: ua.NodeId,
        reference: ua.NodeId,
        identifier: ua.NodeId,
        name: ua.QualifiedName,
        *,
        attributes: object,
        kind: ua.NodeId | None,
    ) -> None:
        classes = {
            ua.ObjectAttributes: ua.NodeClass.Object,
            ua.VariableAttributes: ua.NodeClass.Variable,
            ua.MethodAttributes: ua.NodeClass.Method,
            ua.ObjectTypeAttributes: ua.NodeClass.ObjectType,
        }
        item = ua.AddNodesItem(
            ParentNodeId=parent,
            ReferenceTypeId=reference,
            RequestedNewNodeId=identifier,
            BrowseName=name,
            NodeClass=classes[type(attributes)],
            NodeAttributes=attributes,
            TypeDefinition=ua.NodeId() if kind is None else kind,
        )
        (added,) = await self.server.iserver.isession.add_nodes([item])
        added.StatusCode.check()

    async def _refer(self, source: ua.NodeId, reference: int, target: ua.NodeId) -> None:
        item = ua.AddReferencesItem(
            SourceNodeId=source, ReferenceTypeId=ua.NodeId(reference), IsForward=True, TargetNodeId=target
        )
        (added,) = await self.server.iserver.isession.add_references([item])
        added.check()

    def _index_types(self) -> None:
        names = {index: f"{key}:" for key, index in self.spaces.items() if index}
        for identifier in list(self.server.iserver.aspace.keys()):
            if self._attribute(identifier, _A.NodeClass) in _TYPE_CLASSES:
                name = self._attribute(identifier, _A.BrowseName)
                self._types[f"{names.get(identifier.NamespaceIndex, '')}{name.Name}"] = identifier

    def _with_supertypes(self, identifier: ua.NodeId) -> Iterator[ua.NodeId]:
        """A node, the interfaces that it has, and the same of each type that it is derived from."""
        yield identifier
        for reference in self._node(identifier).references:
            if reference.ReferenceTypeId.Identifier == _I.HasInterface and reference.IsForward:
                yield from self._with_supertypes(reference.NodeId)
        for reference in self._node(identifier).references:
            if reference.ReferenceTypeId.Identifier == _I.HasSubtype and not reference.IsForward:
                yield from self._with_supertypes(reference.NodeId)

    def _children(self, identifier: ua.NodeId) -> Iterator[ua.ReferenceDescription]:
        for reference in self._node(identifier).references:
            known = reference.ReferenceTypeId.NamespaceIndex == 0
            if known and reference.IsForward and reference.ReferenceTypeId.Identifier in _CHILD_REFERENCES:
                yield reference

    def _child(self, identifier: ua.NodeId, name: str) -> ua.NodeId:
        return next(child.NodeId for child in self._children(identifier) if child.BrowseName.Name == name)

    def _rule(self, identifier: ua.NodeId) -> int | None:
        for reference in self._node(identifier).references:
            if reference.ReferenceTypeId.Identifier == _I.HasModellingRule and reference.IsForward:
                return int(reference.NodeId.Identifier)
        return None

    def _node(self, identifier: ua.NodeId) -> NodeData:
        return self.server.iserver.aspace[identifier]

    def _attribute(self, identifier: ua.NodeId, attribute: ua.AttributeIds) -> Any:
        value = self.server.iserver.aspace.read_attribute_value(identifier, attribute).Value
        return None if value is None else value.Value

    def _own_name(self, name: str) -> ua.QualifiedName:
        return ua.QualifiedName(name, self.spaces["Loom"])

    def _name(self, name: str) -> ua.QualifiedName:
        space, _, name = name.partition(":")
        return ua.QualifiedName(name, self.spaces[space])
