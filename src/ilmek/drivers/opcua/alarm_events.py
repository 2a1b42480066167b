"""Events of the server: alarms as conditions (OPC 10000-9), and changes of job orders (OPC 10031-4)."""

from datetime import UTC, datetime
from typing import Any

from asyncua import ua

from ilmek.drivers.opcua.job_orders import Job
from ilmek.drivers.opcua.methods import job_order, job_response, job_state
from ilmek.drivers.opcua.model import ALARM_TYPE, LOOM
from ilmek.drivers.opcua.space import AddressSpace
from ilmek.loom.control.alarms import ALARMS
from ilmek.loom.control.view import AlarmView

NOTE = 300
"""Severity of a job order's event, and of an alarm that is not in the controller's list."""


class LoomEvents:
    """Sends the events, from the server's object and from the loom's.

    An alarm is active from when it is raised until it is cleared, and is retained meanwhile, so that ConditionRefresh
    repeats it. One for which the loom stands is unacknowledged meanwhile: it is cleared when its cause has ended and an
    operator acknowledges it.
    """

    def __init__(self, space: AddressSpace) -> None:
        self._space = space
        self._active: dict[str, AlarmView] = {}
        self._alarm: list[Any] = []
        self._job: list[Any] = []

    async def prepare(self) -> None:
        """Make the generators of events."""
        source = self._space.node_id(LOOM)
        job_type = self._space.type_id("ISA95:ISA95JobOrderStatusEventType")
        for emitter in (ua.NodeId(ua.ObjectIds.Server), source):
            server = self._space.server
            for kind, found in ((self._space.type_id(f"Loom:{ALARM_TYPE}"), self._alarm), (job_type, self._job)):
                generator = await server.get_event_generator(kind, emitter)
                event = generator.event
                event.SourceNode, event.SourceName = source, LOOM
                if kind == job_type:
                    for name in ("JobState", "JobOrder", "JobResponse"):
                        event.add_property(name, None, ua.VariantType.ExtensionObject)
                for name, data in event.data_types.items():  # asyncua encodes by built-in types alone
                    if isinstance(data, ua.NodeId):
                        event.data_types[name] = self._space.encoding(data)
                found.append(generator)

    async def alarms(self, alarms: tuple[AlarmView, ...]) -> None:
        """Send what has changed: alarms that were raised and those that were cleared."""
        now = {alarm.name: alarm for alarm in alarms}
        for name, alarm in now.items():
            if name not in self._active:
                await self._send(alarm, active=True)
        for name, alarm in self._active.items():
            if name not in now:
                await self._send(alarm, active=False)
        self._active = now

    async def job(self, job: Job) -> None:
        """Send the new state of a job order."""
        for generator in self._job:
            generator.event.JobState = job_state(self._space, job)
            generator.event.JobOrder = job_order(job)
            generator.event.JobResponse = job_response(self._space, job)
            generator.event.Severity = NOTE
            await generator.trigger(message=f"Job order {job.order}: {job.state.value}")

    async def _send(self, alarm: AlarmView, *, active: bool) -> None:
        kind = ALARMS.get(alarm.name)
        unacknowledged = active and alarm.stops
        fields = {
            "NodeId": self._space.node_id(f"{LOOM}.Alarms.{alarm.name}"),
            "ConditionName": alarm.name,
            "ConditionClassId": ua.NodeId(ua.ObjectIds.ProcessConditionClassType),
            "ConditionClassName": ua.LocalizedText("ProcessConditionClass"),
            "BranchId": ua.NodeId(),
            "Retain": active,
            "EnabledState": ua.LocalizedText("Enabled"),
            "EnabledState/Id": True,
            "ActiveState": ua.LocalizedText("Active" if active else "Inactive"),
            "ActiveState/Id": active,
            "ActiveState/TransitionTime": datetime.now(UTC),
            "AckedState": ua.LocalizedText("Unacknowledged" if unacknowledged else "Acknowledged"),
            "AckedState/Id": not unacknowledged,
            "Severity": NOTE if kind is None else kind.severity,
            "Cause": alarm.cause,
            "Remedy": alarm.remedy,
            "StopsLoom": alarm.stops,
        }
        for generator in self._alarm:
            for name, value in fields.items():
                setattr(generator.event, name, value)
            await generator.trigger(message=f"{alarm.cause}: {alarm.remedy}" if active else f"{alarm.cause}: cleared")
