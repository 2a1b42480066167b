"""Who may do what: the gate before asyncua's server.

asyncua 2.1 accepts a session on a channel without security even where no such endpoint is offered, binds a session to
any channel that knows its number before the user is checked, reads a message of any announced size, and lets a session
touch the subscriptions of others. The classes here refuse all of that, keep each client within bounds, and give every
call and write to the user's right.
"""

import asyncio
import socket
import time
from collections.abc import Awaitable, Callable, Iterable
from typing import Any

from asyncua import Server, ua
from asyncua.common.connection import TransportLimits
from asyncua.common.utils import ServiceError
from asyncua.crypto.permission_rules import User, UserRole
from asyncua.server.binary_server_asyncio import BinaryServer, OPCUAProtocol
from asyncua.server.internal_server import InternalServer
from asyncua.server.internal_session import InternalSession
from asyncua.server.uaprocessor import UaProcessor

from ilmek.drivers.opcua.users import UserList, UserRight

MOST_CONNECTIONS = 512
"""Connections at a time, sessions included."""

MOST_SUBSCRIPTIONS, MOST_OF_SESSION = 1024, 8
"""Subscriptions of all sessions, and of one."""

MOST_ITEMS = 1000
"""Monitored items of a subscription, and nodes of one request."""

LEAST_INTERVAL = 50.0
"""Least publishing interval [ms]: a shorter one that a client requests is revised to it."""

LONGEST_QUEUE = 1000
"""Notifications that wait for a client, of one item."""

REQUEST_RATE, REQUEST_BURST = 500.0, 500.0
"""Requests of a client a second, and at once; what is above waits, and a client that does not is cut off."""

LARGEST_CHUNK, LARGEST_MESSAGE = 1 << 16, 1 << 22
"""Largest chunk and largest message of a client [bytes]."""

_I = ua.ObjectIds
_ACKNOWLEDGE = ua.NodeId(_I.AcknowledgeableConditionType_Acknowledge)
_DISCOVERY = {
    ua.NodeId(_I.GetEndpointsRequest_Encoding_DefaultBinary),
    ua.NodeId(_I.FindServersRequest_Encoding_DefaultBinary),
    ua.NodeId(_I.CloseSecureChannelRequest_Encoding_DefaultBinary),
}
_REFUSED = {
    ua.NodeId(_I.RegisterServerRequest_Encoding_DefaultBinary),
    ua.NodeId(_I.RegisterServer2Request_Encoding_DefaultBinary),
    ua.NodeId(_I.AddNodesRequest_Encoding_DefaultBinary),
    ua.NodeId(_I.DeleteNodesRequest_Encoding_DefaultBinary),
    ua.NodeId(_I.AddReferencesRequest_Encoding_DefaultBinary),
    ua.NodeId(_I.DeleteReferencesRequest_Encoding_DefaultBinary),
    ua.NodeId(_I.TransferSubscriptionsRequest_Encoding_DefaultBinary),
}


_OVERRIDDEN = {
    UaProcessor: ("_process_message",),
    OPCUAProtocol: ("connection_made", "data_received"),
    BinaryServer: ("_make_protocol", "_close_task_loop", "start"),
    InternalServer: ("create_session", "lookup_external_session"),
    InternalSession: ("activate_session", "call", "write", "create_subscription", "delete_subscriptions"),
    Server: ("_setup_server_nodes",),
}
_MISSING = [
    f"{base.__name__}.{name}" for base, names in _OVERRIDDEN.items() for name in names if name not in vars(base)
]
if _MISSING:  # another version of asyncua: the gate would stand open
    raise ImportError(f"asyncua has no {', '.join(_MISSING)}; ilmek serve needs asyncua 2.1")


class RightUser(User):
    """A user of asyncua that carries the right."""

    def __init__(self, name: str | None, right: UserRight) -> None:
        super().__init__(role=UserRole.User, name=name)
        self.right = right


class GatedProcessor(UaProcessor):
    """The requests of a client: only discovery without security, never more than the rate."""

    _tokens, _filled = REQUEST_BURST, 0.0

    async def _process_message(self, typeid: Any, requesthdr: Any, seqhdr: Any, body: Any) -> Any:
        if self._connection.security_policy.Mode != ua.MessageSecurityMode.SignAndEncrypt and typeid not in _DISCOVERY:
            raise ServiceError(ua.StatusCodes.BadSecurityModeInsufficient)
        if typeid in _REFUSED:
            raise ServiceError(ua.StatusCodes.BadServiceUnsupported)
        await self._pace()
        if typeid == ua.NodeId(_I.CreateSessionRequest_Encoding_DefaultBinary) and self.session is not None:
            if self.session.is_activated():
                raise ServiceError(ua.StatusCodes.BadTooManySessions)  # one of a connection
            await self.session.close_session()  # its user was refused
        return await super()._process_message(typeid, requesthdr, seqhdr, body)

    async def _pace(self) -> None:
        now = time.monotonic()
        self._tokens = min(REQUEST_BURST, self._tokens + (now - self._filled) * REQUEST_RATE) - 1.0
        self._filled = now
        if self._tokens < 0.0:
            await asyncio.sleep(-self._tokens / REQUEST_RATE)


class GatedProtocol(OPCUAProtocol):
    """A connection whose messages are bounded."""

    processor: UaProcessor | None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        if self.processor is not None:
            self.processor = GatedProcessor(self.iserver, self.transport, self.limits)
            self.processor.set_policies(self.policies)

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        if len(self._buffer) > LARGEST_CHUNK and self.transport is not None:
            self.transport.close()


class GatedBinaryServer(BinaryServer):
    """Listens for gated connections at a socket that is bound."""

    def __init__(self, internal_server: InternalServer, bound: socket.socket, limits: TransportLimits) -> None:
        super().__init__(internal_server, *bound.getsockname()[:2], limits)
        self._bound = bound

    async def start(self) -> None:
        self._server = await asyncio.get_running_loop().create_server(self._make_protocol, sock=self._bound)
        self.cleanup_task = asyncio.create_task(self._close_task_loop())

    def _make_protocol(self) -> OPCUAProtocol:
        return GatedProtocol(
            iserver=self.iserver,
            policies=self._policies,
            clients=self.clients,
            closing_tasks=self.closing_tasks,
            limits=self.limits,
        )


class GatedSession(InternalSession):
    """A client's session: its user's right for calls and writes, its own subscriptions only."""

    right: UserRight | None = None

    def activate_session(
        self, params: ua.ActivateSessionParameters, peer_certificate: bytes | None
    ) -> ua.ActivateSessionResult:
        self.iserver.address = str(self.name[0]) if isinstance(self.name, tuple) else str(self.name)
        result = super().activate_session(params, peer_certificate)
        self.right = getattr(self.user, "right", None)
        return result

    async def call(self, params: list[ua.CallMethodRequest]) -> list[ua.CallMethodResult]:
        results = []
        for request in _bounded(params):
            if self.right is UserRight.OPERATOR and request.MethodId == _ACKNOWLEDGE:
                results.append(await self.iserver.acknowledged(request))
            elif self.right is UserRight.OPERATOR or request.MethodId in self.iserver.open_methods:
                results += await super().call([request])
            else:
                results.append(ua.CallMethodResult(StatusCode=ua.StatusCode(ua.StatusCodes.BadUserAccessDenied)))
        return results

    async def read(self, params: ua.ReadParameters) -> list[ua.DataValue]:
        _bounded(params.NodesToRead)
        return await super().read(params)

    async def write(self, params: ua.WriteParameters) -> list[ua.StatusCode]:
        return [ua.StatusCode(ua.StatusCodes.BadUserAccessDenied) for _ in _bounded(params.NodesToWrite)]

    async def browse(self, params: ua.BrowseParameters) -> list[ua.BrowseResult]:
        _bounded(params.NodesToBrowse)
        return await super().browse(params)

    async def create_subscription(self, params: Any, callback: Any, request_callback: Any = None) -> Any:
        if (
            sum(subscription.session_id == self.session_id for subscription in self._subscriptions.values())
            >= MOST_OF_SESSION
        ):
            raise ServiceError(ua.StatusCodes.BadTooManySubscriptions)
        params.RequestedPublishingInterval = max(LEAST_INTERVAL, params.RequestedPublishingInterval or 0.0)
        return await super().create_subscription(params, callback, request_callback)

    async def create_monitored_items(
        self, params: ua.CreateMonitoredItemsParameters
    ) -> list[ua.MonitoredItemCreateResult]:
        subscription = self._own(params.SubscriptionId)
        if len(subscription.monitored_item_srv._monitored_items) + len(_bounded(params.ItemsToCreate)) > MOST_ITEMS:
            raise ServiceError(ua.StatusCodes.BadTooManyMonitoredItems)
        return await super().create_monitored_items(params)

    async def modify_monitored_items(
        self, params: ua.ModifyMonitoredItemsParameters
    ) -> list[ua.MonitoredItemModifyResult]:
        self._own(params.SubscriptionId)
        return await super().modify_monitored_items(params)

    async def delete_monitored_items(self, params: ua.DeleteMonitoredItemsParameters) -> list[ua.StatusCode]:
        self._own(params.SubscriptionId)
        return await super().delete_monitored_items(params)

    async def set_monitoring_mode(self, params: ua.SetMonitoringModeParameters) -> list[ua.StatusCode]:
        self._own(params.SubscriptionId)
        return await super().set_monitoring_mode(params)

    async def set_publishing_mode(self, params: ua.SetPublishingModeParameters) -> list[ua.StatusCode]:
        for number in _bounded(params.SubscriptionIds):
            self._own(number)
        return await super().set_publishing_mode(params)

    async def delete_subscriptions(self, ids: list[int]) -> list[ua.StatusCode]:
        for number in ids:
            if number in self._subscriptions:
                self._own(number)
        return await super().delete_subscriptions(ids)

    def publish(self, acks: Iterable[ua.SubscriptionAcknowledgement] | None = None) -> tuple[int, list[ua.StatusCode]]:
        known = self._subscriptions
        own = [
            ack
            for ack in acks or ()
            if ack.SubscriptionId not in known or known[ack.SubscriptionId].session_id == self.session_id
        ]
        return super().publish(own)

    def republish(self, params: ua.RepublishParameters) -> ua.NotificationMessage:
        self._own(params.SubscriptionId)
        return super().republish(params)

    def modify_subscription(self, params: ua.ModifySubscriptionParameters) -> ua.ModifySubscriptionResult:
        self._own(params.SubscriptionId)
        return super().modify_subscription(params)

    @property
    def _subscriptions(self) -> dict[int, Any]:
        subscriptions: dict[int, Any] = self.subscription_service.subscriptions
        return subscriptions

    def _own(self, number: int) -> Any:
        found = self._subscriptions.get(number)
        if found is None or found.session_id != self.session_id:
            raise ServiceError(ua.StatusCodes.BadSubscriptionIdInvalid)
        return found


def _bounded(items: Any) -> Any:
    if not items:
        raise ServiceError(ua.StatusCodes.BadNothingToDo)
    if len(items) > MOST_ITEMS:
        raise ServiceError(ua.StatusCodes.BadTooManyOperations)
    return items


async def _unknown(_: ua.CallMethodRequest) -> ua.CallMethodResult:
    return ua.CallMethodResult(StatusCode=ua.StatusCode(ua.StatusCodes.BadNodeIdUnknown))


class GatedInternalServer(InternalServer):
    """Sessions of gated users within bounds; a session stays on the channel on which it began.

    open_methods  that a viewer may call too     acknowledged  answers the method Acknowledge of a condition
    """

    def __init__(self, users: UserList, log: Callable[[str], None]) -> None:
        super().__init__(user_manager=self)
        self.users, self.log, self.address = users, log, ""
        self.open_methods: set[ua.NodeId] = {
            ua.NodeId(_I.ConditionType_ConditionRefresh),
            ua.NodeId(_I.ConditionType_ConditionRefresh2),
        }
        self.acknowledged: Callable[[ua.CallMethodRequest], Awaitable[ua.CallMethodResult]] = _unknown
        self.bind_condition_methods = True
        self.max_connections = MOST_CONNECTIONS
        self.max_subscriptions = MOST_SUBSCRIPTIONS
        self.max_monitored_item_queue_size = LONGEST_QUEUE
        self.max_unacked_messages_per_subscription = 100
        self.max_pending_activation_seconds = 10.0
        anonymous = (ua.AnonymousIdentityToken,) if users.anonymous else ()
        self.supported_tokens = (ua.UserNameIdentityToken, *anonymous)

    def create_session(self, name: str, user: User | None = None, external: bool = False) -> InternalSession:
        if not external:
            return super().create_session(name) if user is None else super().create_session(name, user)
        return GatedSession(self, self.aspace, self.subscription_service, name, external=True)

    def lookup_external_session(self, auth_token: ua.NodeId) -> None:
        """No session is continued on another channel: the client opens a new one."""

    def get_user(self, _: Any, username: Any = None, password: Any = None, certificate: Any = None) -> User | None:  # noqa: ARG002
        """The user of a name and a password (asyncua's user manager)."""
        try:
            right = self.users.admitted(self.address, username, password)
        except TypeError:
            right = None
        if right is None:
            self.log(f"refused a client at {self.address}: unknown user or wrong password")
            return None
        return RightUser(username, right)


class GatedServer(Server):
    """asyncua's server behind the gate: SignAndEncrypt with Basic256Sha256 alone."""

    def __init__(self, bound: socket.socket, users: UserList, log: Callable[[str], None]) -> None:
        super().__init__(iserver=GatedInternalServer(users, log))
        self._bound = bound
        self.set_security_policy([ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt])
        self.limits.max_recv_buffer = LARGEST_CHUNK
        self.limits.max_message_size = LARGEST_MESSAGE
        self.limits.max_chunk_count = LARGEST_MESSAGE // LARGEST_CHUNK

    async def start(self) -> None:
        """Listen."""
        await self._setup_server_nodes()
        await self.iserver.start()
        self.bserver = GatedBinaryServer(self.iserver, self._bound, self.limits)
        self.bserver.set_policies(self._policies)
        await self.bserver.start()
