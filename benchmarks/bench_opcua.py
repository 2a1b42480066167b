"""200 subscribers of the loom's OPC UA server at 10 Hz over a signed and encrypted channel: dropped, late, load.

The server and its loom are in one process, the subscribers in another. The loom ties a knot ten times a second, and
every subscriber must see each of its values, in order. Then a client floods the server: how much slower is the loom.

Limits: none dropped; the loom under a flood at least at half of its speed.
"""

import asyncio
import multiprocessing
import os
import resource
import sys
import threading
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

from asyncua import Client
from asyncua.crypto.security_policies import SecurityPolicyBasic256Sha256
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat

from ilmek.drivers.opcua.certificate import make_credentials
from ilmek.drivers.opcua.model import LoomNameplate
from ilmek.drivers.opcua.server import LoomServer
from ilmek.drivers.opcua.users import LoomUser, UserList, UserRight, hashed

sys.path.append(str(Path(__file__).parents[1] / "tests" / "support"))
from opcua_loom import PROGRAMME, SteppingLoom

SUBSCRIBERS = int(os.environ.get("SUBSCRIBERS", "200"))
SECONDS = float(os.environ.get("SECONDS", "20"))
PERIOD = 100.0
"""Publishing interval [ms]."""

PLATE = LoomNameplate("ilmek", "loom", "0123456789ab", "0", PROGRAMME, "carpet", 6, 24, 2, 3, ("a", "b", "c"))


class Subscriber:
    """The values that a subscriber has seen, and how late each was [s]."""

    def __init__(self) -> None:
        self.values: list[int] = []
        self.late: list[float] = []

    def datachange_notification(self, _: Any, value: Any, data: Any) -> None:
        self.values.append(int(value))
        sent = data.monitored_item.Value.SourceTimestamp
        self.late.append(time.time() - sent.timestamp())

    def status_change_notification(self, status: Any) -> None:
        raise AssertionError(f"the subscription was ended: {status}")

    @property
    def dropped(self) -> int:
        """Values that were left out between two that were seen."""
        return sum(after - before - 1 for before, after in pairwise(self.values))


async def _client(url: str, pair: tuple[bytes, bytes, bytes]) -> Any:
    client = Client(url, timeout=120, watchdog_intervall=600.0)  # a busy computer is no lost connection
    client.application_uri = "urn:bench:client"
    await client.set_security(SecurityPolicyBasic256Sha256, pair[0], pair[1], server_certificate=pair[2])
    client.set_user("viewer")
    client.set_password("viewer-password")
    await client.connect()
    return client


async def _subscribe(url: str, pair: tuple[bytes, bytes, bytes]) -> tuple[list[Subscriber], float]:
    handlers = [Subscriber() for _ in range(SUBSCRIBERS)]
    clients = [await _client(url, pair) for _ in handlers]
    index = await clients[0].get_namespace_index("urn:ilmek:loom")
    for client, handler in zip(clients, handlers, strict=True):
        subscription = await client.create_subscription(PERIOD, handler)
        await subscription.subscribe_data_change(client.get_node(f"ns={index};s=Loom.Carpet.Knots"), queuesize=100)
    for handler in handlers:
        handler.values.clear()
        handler.late.clear()
    spent = time.process_time()
    await asyncio.sleep(SECONDS)
    spent = time.process_time() - spent
    for client in clients:
        await client.disconnect()
    return handlers, spent


def _subscribers(url: str, pair: tuple[bytes, bytes, bytes], out: Any) -> None:
    handlers, spent = asyncio.run(_subscribe(url, pair))
    late = sorted(one for handler in handlers for one in handler.late)
    seen = [len(handler.values) for handler in handlers]
    out.put((sum(handler.dropped for handler in handlers), min(seen), max(seen), late, spent))


async def _flood(url: str, pair: tuple[bytes, bytes, bytes], seconds: float) -> int:
    client = await _client(url, pair)
    index = await client.get_namespace_index("urn:ilmek:loom")
    node = client.get_node(f"ns={index};s=Loom.Carpet.Knots")
    done, end = 0, time.monotonic() + seconds
    while time.monotonic() < end:
        await asyncio.gather(*(node.read_value() for _ in range(200)))
        done += 200
    await client.disconnect()
    return done


def _flooder(url: str, pair: tuple[bytes, bytes, bytes], out: Any) -> None:
    out.put(asyncio.run(_flood(url, pair, 5.0)))


def _work(stop: threading.Event, done: list[int]) -> None:
    """A loom's thread: plain Python, as fast as it can."""
    while not stop.is_set():
        for _ in range(1000):
            pass
        done[0] += 1


def _speed(seconds: float) -> float:
    stop, done = threading.Event(), [0]
    thread = threading.Thread(target=_work, args=(stop, done))
    thread.start()
    time.sleep(seconds)
    stop.set()
    thread.join()
    return done[0] / seconds


def run() -> None:
    """Print the figures."""
    made = make_credentials("urn:bench:client", "client", ("localhost",))
    key = made.key.private_bytes(Encoding.DER, PrivateFormat.PKCS8, NoEncryption())
    users = UserList({"viewer": LoomUser("viewer", UserRight.VIEWER, hashed("viewer-password"))})
    loom = SteppingLoom(total=10**9, step=1)
    credentials = make_credentials(PLATE.uri, "loom", ("127.0.0.1",))
    pair = made.certificate.public_bytes(Encoding.DER), key, credentials.certificate.public_bytes(Encoding.DER)
    context = multiprocessing.get_context("spawn")
    out = context.Queue()
    start = time.perf_counter()
    with LoomServer(loom, PLATE, users, credentials, port=0) as server:
        print(f"server started in {time.perf_counter() - start:.1f} s")
        for command in ("reset", "start"):
            time.sleep(0.5)
            loom.command(command)
        before, begin = time.process_time(), time.perf_counter()
        process = context.Process(target=_subscribers, args=(server.url, pair, out))
        process.start()
        dropped, least, most, late, spent = out.get()
        process.join()
        load = (time.process_time() - before) / (time.perf_counter() - begin)
        print(
            f"{SUBSCRIBERS} subscribers, {SECONDS:.0f} s: {least} to {most} values each, {dropped} dropped; "
            f"late {1e3 * late[len(late) // 2]:.0f} ms (median), {1e3 * late[int(0.99 * len(late))]:.0f} ms (99 %), "
            f"{1e3 * late[-1]:.0f} ms (most); load of the server {load:.0%}, of the subscribers {spent / SECONDS:.0%}"
        )
        alone = _speed(5.0)
        process = context.Process(target=_flooder, args=(server.url, pair, out))
        process.start()
        time.sleep(2.0)
        flooded = _speed(4.0)
        print(
            f"flood: {out.get() / 5.0:.0f} requests/s answered; the loom's thread at {flooded / alone:.0%} of its speed"
        )
        process.join()
    print(f"memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")
