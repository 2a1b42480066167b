/** What is asked of a result in a study. */
import type { StudyRequest } from "../api/messages";

export type Wish = "least" | "most" | "shown";

/** Goals and further results of a study. */
export function wanted(wishes: ReadonlyMap<string, Wish>): Pick<StudyRequest, "goals" | "record"> {
  const of = (wish: Wish) => [...wishes].filter(([, one]) => one === wish).map(([name]) => name);
  return { goals: [...of("least"), ...of("most").map((name) => `most ${name}`)], record: of("shown") };
}
