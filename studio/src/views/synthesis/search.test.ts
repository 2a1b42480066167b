import { afterEach, beforeEach, expect, it, vi } from "vitest";

const answers: { quick: boolean; answer: (found: unknown) => void }[] = [];

vi.mock("../../api/request", () => ({
  post: () => new Promise((answer) => answers.push({ quick: true, answer })),
}));
vi.mock("../../api/work", () => ({
  runWork: () => new Promise((answer) => answers.push({ quick: false, answer })),
}));

const { CandidateSearch, PAUSE } = await import("./search");

beforeEach(() => {
  vi.useFakeTimers();
  answers.length = 0;
});
afterEach(() => void vi.useRealTimers());

const task = (number: number) => ({ machine: "motion-four-bar", settings: { number } }) as never;

it("keeps the full answer where a short one comes later", async () => {
  const search = new CandidateSearch();
  search.follow(task(1), false);
  search.follow(task(2), true);
  await vi.advanceTimersByTimeAsync(PAUSE);
  const [first, full] = answers;
  full?.answer({ quick: false, name: "full" });
  await vi.advanceTimersByTimeAsync(0);
  first?.answer({ quick: true, name: "short, of the first task" });
  await vi.advanceTimersByTimeAsync(0);
  answers[2]?.answer({ quick: true, name: "short, of the second task" });
  await vi.advanceTimersByTimeAsync(0);
  expect(answers.map((one) => one.quick)).toEqual([true, false, true]);
  expect(search.state.value).toBe("done");
  expect(search.answer.value).toEqual({ quick: false, name: "full" });
});

it("stays stopped where a short answer comes later", async () => {
  const search = new CandidateSearch();
  search.follow(task(1), false);
  search.stop();
  answers[0]?.answer({ quick: true });
  await vi.advanceTimersByTimeAsync(0);
  expect(search.state.value).toBe("stopped");
});
