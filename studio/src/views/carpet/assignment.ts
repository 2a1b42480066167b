/** Yarns that are given to colours of a drawing by hand: the table [map] of the recipe. */
import type { Recipe } from "./model";

/** The table [map] of a recipe: the yarn of each colour `#rrggbb`, which is written in small letters. */
export function mapOf(recipe: Recipe | null): Readonly<Record<string, string>> {
  const map = recipe?.["map"];
  if (typeof map !== "object" || map === null || Array.isArray(map)) return {};
  const pairs = Object.entries(map).filter((pair): pair is [string, string] => typeof pair[1] === "string");
  return Object.fromEntries(pairs.map(([colour, yarn]) => [colour.toLowerCase(), yarn]));
}

/** The table with another yarn for a colour, "": none by hand; null where nothing is left in it. */
export function mapWith(recipe: Recipe | null, colour: string, yarn: string): Record<string, string> | null {
  const { [colour.toLowerCase()]: _, ...rest } = mapOf(recipe);
  const map = yarn === "" ? rest : { ...rest, [colour.toLowerCase()]: yarn };
  return Object.keys(map).length > 0 ? map : null;
}
