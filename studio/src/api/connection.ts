/** Whether the studio's server answers; set by what talks to it, shown by the frame. */
import { signal } from "@preact/signals";

export type Connection = "connecting" | "connected" | "lost";

export const connection = signal<Connection>("connecting");
