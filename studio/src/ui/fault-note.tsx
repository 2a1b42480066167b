import type { ComponentChildren } from "preact";
import type { Fault } from "../api/fault";

/** What is wrong, what is allowed, and what to do; nothing where nothing is wrong. */
export function FaultNote({ fault, children }: { fault: Fault | null; children?: ComponentChildren }) {
  if (fault === null) return null;
  return (
    <div class="ui-callout bad" role="alert">
      <strong>{fault.given}</strong>
      {fault.allowed && <p>{fault.allowed}</p>}
      {fault.do && <p>{fault.do}</p>}
      {children}
    </div>
  );
}
