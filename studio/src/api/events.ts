/** Events of the server by WebSocket; the connection is made again after it is lost. */
import { connection } from "./connection";
import { page } from "./request";

/** An event; which fields it has depends on its type: see the server's events.py. */
export type ServerEvent =
  | { type: "hello"; version: string; start: number }
  | { type: "step"; work: number; stage: string; share: number }
  | { type: "news"; work: number; news: unknown }
  | { type: "done"; work: number; time: number }
  | { type: "failed"; work: number; error: { given: string; allowed: string; do: string } | null }
  | { type: "cancelled"; work: number }
  | { type: "announced"; news: unknown }
  | { type: "changed"; paths: string[] };

type Listener = (event: ServerEvent) => void;

/** Delays before the attempts to connect again [ms]; the last one stays. */
const DELAYS = [100, 250, 500, 1000, 2000, 4000];

const listeners = new Set<Listener>();
let attempt = 0;
let socket: WebSocket | undefined;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Receive each event; returns what ends it. After each "hello" the server may know nothing of earlier works. */
export function onEvent(listener: Listener): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** Connect, and stay connected. */
export function connect(): void {
  if (socket || timer !== undefined) return;
  open();
  window.addEventListener("online", now);
  document.addEventListener("visibilitychange", now);
}

/** Try at once, where the next attempt waits: the page is seen again, or somebody asks for it. */
export function now(): void {
  if (timer === undefined || document.visibilityState === "hidden") return;
  clearTimeout(timer);
  timer = undefined;
  open();
}

function open(): void {
  const opened = new WebSocket(
    `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/events?page=${page}`,
  );
  socket = opened;
  opened.onmessage = (message) => {
    attempt = 0;
    connection.value = "connected";
    const event = JSON.parse(String(message.data)) as ServerEvent;
    for (const listener of [...listeners]) listener(event);
  };
  opened.onclose = () => {
    if (socket !== opened) return;
    socket = undefined;
    connection.value = "lost";
    const delay = DELAYS[Math.min(attempt++, DELAYS.length - 1)] ?? 0;
    timer = setTimeout(() => {
      timer = undefined;
      open();
    }, delay);
  };
}
