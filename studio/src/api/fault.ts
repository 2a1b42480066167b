/** What a request that failed reports to its user. */
import { ApiError, ServerLost } from "./request";

export interface Fault {
  given: string;
  allowed: string;
  do: string;
}

/** The report of an error; null where there is none to make: it was aborted, or the server is lost, which the frame shows. */
export function faultOf(error: unknown): Fault | null {
  if (error instanceof ServerLost || (error instanceof DOMException && error.name === "AbortError")) return null;
  if (error instanceof ApiError) return { given: error.given, allowed: error.allowed, do: error.do };
  return { given: error instanceof Error ? error.message : String(error), allowed: "", do: "" };
}
