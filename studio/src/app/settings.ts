/** What the user chose for this browser: theme and language. */
import { computed, effect, signal } from "@preact/signals";
import { LANGUAGES, type Language, setLanguage } from "../text";

export const THEMES = ["auto", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

export const theme = signal<Theme>("auto");

const system = matchMedia("(prefers-color-scheme: dark)");
const systemDark = signal(system.matches);
system.addEventListener("change", () => {
  systemDark.value = system.matches;
});

/** Whether the page is dark. */
export const dark = computed(() => (theme.value === "auto" ? systemDark.value : theme.value === "dark"));
effect(() => {
  document.documentElement.dataset["theme"] = dark.value ? "dark" : "light";
});

/** A value that this browser keeps; null where it keeps nothing. */
export function remembered(key: string): string | null {
  try {
    return localStorage.getItem(`ilmek.${key}`);
  } catch {
    return null;
  }
}

/** Has this browser keep a value, where it may. */
export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(`ilmek.${key}`, value);
  } catch {
    // Private windows may keep nothing; the value then holds until the page is closed.
  }
}

/** Chooses a theme. */
export function chooseTheme(chosen: Theme): void {
  theme.value = chosen;
  remember("theme", chosen);
}

/** Chooses a language. */
export async function chooseLanguage(chosen: Language): Promise<void> {
  await setLanguage(chosen);
  remember("language", chosen);
}

/** Applies what this browser remembers; without that, the language that the browser prefers. */
export async function applySettings(): Promise<void> {
  const kept = THEMES.find((one) => one === remembered("theme"));
  if (kept !== undefined) chooseTheme(kept);
  const preferred = [remembered("language"), ...navigator.languages].map((one) => (one ?? "").slice(0, 2));
  const found = preferred.find((one) => one in LANGUAGES) as Language | undefined;
  if (found !== undefined && found !== "en") await setLanguage(found);
}
