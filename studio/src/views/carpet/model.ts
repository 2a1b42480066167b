/** The state of the view: the recipe's document, its chart, the tool in hand. */
import { computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import { connection } from "../../api/connection";
import { type Latest, latest } from "../../api/latest";
import type { ChartAnswer, ChartYarn, ListedYarn } from "../../api/messages";
import { ApiError, type Packed, postPacked } from "../../api/request";
import { remember, remembered } from "../../app/settings";
import { type Document, openDocument } from "../../project";
import { language } from "../../text";
import { type Anchor, anchored, type EditLine, placedLines, withAnchor, withLines, withoutLine } from "./edit-lines";
import type { Grid, Knot } from "./geometry";
import { type Placing, pieceOf, placingEdits, recoloured, tileEntry } from "./placing";
import type { FoundSpecks } from "./specks";
import type { Brush } from "./strokes";
import type { Symmetry } from "./symmetry";

/** The data of a recipe's file. */
export type Recipe = Record<string, unknown>;

export interface Chart {
  about: ChartAnswer;
  knots: Uint8Array;
  grid: Grid;
}

export interface Source {
  key: string;
  width: number;
  height: number;
  pixels: Uint8Array;
}

export const TOOLS = ["pan", "pencil", "line", "fill", "select", "mirror", "repeat", "border"] as const;
export type Tool = (typeof TOOLS)[number];

/** Pause after the last change before a chart is made with all colours of a photo [ms]. */
const PAUSE = 450;

/** Time after which a chart in the making is given up for a newer state [ms]. */
const PATIENCE = 3000;

export class CarpetModel {
  readonly document: Document<Recipe>;
  readonly chart = signal<Chart | null>(null);
  readonly source = signal<Source | null>(null);
  /** What the server refuses in the recipe; null: nothing. */
  readonly problem = signal<ApiError | null>(null);
  readonly busy = signal(false);
  /** Time that the last chart took, from the change to the answer [ms]. */
  readonly tool = signal<Tool>("pan");
  /** Name of the yarn that the tools give. */
  readonly yarn = signal("");
  /** Tile of the tool repeat, once it is chosen. */
  readonly tile = signal<readonly [Knot, Knot] | null>(null);
  /** Part that is selected, and what is held over the chart. */
  readonly selection = signal<readonly [Knot, Knot] | null>(null);
  readonly placing = signal<Placing | null>(null);
  /** Width of the brush [knots], and what is drawn with each stroke. */
  readonly brush = signal(1);
  readonly symmetry = signal<Symmetry>("none");
  readonly borderWidth = signal(3);
  readonly mirror = signal<"across" | "along" | "both">("across");
  readonly split = signal(Number(remembered("carpet.split") ?? "0.5"));
  readonly left = signal<"chart" | "source">("chart");
  /** The specks of the chart, while they are looked at, and whether they are marked. */
  readonly specks = signal<FoundSpecks | null>(null);
  readonly specksShown = signal(false);
  readonly weaving = signal(false);
  /** Row that is to be shown in the chart. */
  readonly sought = signal<number | null>(null);
  readonly recipe: ReadonlySignal<Recipe | null>;
  readonly yarnIndex: ReadonlySignal<number>;
  readonly #send: Latest<{ recipe: Recipe; draft: boolean }>;
  /** A chart waits for the server to be back. */
  #isWaiting = false;
  /** The recipe whose chart was asked for last. */
  #sent: Recipe | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(readonly path: string) {
    this.document = openDocument<Recipe>(path);
    this.recipe = computed(() => this.document.data.value);
    this.yarnIndex = computed(
      () => this.chart.value?.about.yarns.findIndex((yarn) => yarn.name === this.yarn.value) ?? -1,
    );
    this.#send = latest(
      ({ recipe, draft }: { recipe: Recipe; draft: boolean }, abort) => {
        this.busy.value = true;
        const source = this.source.peek()?.key ?? "";
        return postPacked<ChartAnswer>("/carpet/chart", { recipe, path, draft, source }, abort);
      },
      (answer, { recipe }) => this.#take(answer, recipe),
      (error) => {
        this.busy.value = false;
        this.problem.value = error instanceof ApiError ? error : null;
        this.#isWaiting = !(error instanceof ApiError);
      },
      PATIENCE,
    );
  }

  /** Follows the document until the returned function is called. */
  follow(): () => void {
    let spoken = language.peek();
    const end = effect(() => {
      // What is reported of the chart is in the language of the page.
      if (language.value !== spoken) this.#sent = null;
      spoken = language.value;
      const recipe = this.recipe.value;
      // What is in the file as it is, and refused by its reader, has no chart.
      const state = this.document.saved.value;
      const isRefused = state === "missing" || (state === "saved" && this.document.error.value !== null);
      clearTimeout(this.#timer);
      if (recipe === null || (recipe === this.#sent && !isRefused)) return;
      this.#sent = isRefused ? null : recipe;
      if (!isRefused) this.#send({ recipe, draft: true });
    });
    const back = effect(() => {
      const recipe = this.recipe.peek();
      if (connection.value !== "connected" || !this.#isWaiting || recipe === null) return;
      this.#isWaiting = false;
      this.#send({ recipe, draft: true });
    });
    const kept = effect(() => remember("carpet.split", String(this.split.value)));
    return () => {
      this.#sent = null;
      end();
      back();
      kept();
      clearTimeout(this.#timer);
      this.#send.cancel();
      this.busy.value = false;
    };
  }

  #take({ about, parts }: Packed<ChartAnswer>, recipe: Recipe): void {
    const { rows, columns, width, length, source } = about;
    const pixels = source?.sent ? 3 * source.width * source.height : 0;
    const [knots, shown] = parts([rows * columns, pixels]);
    this.busy.value = false;
    this.problem.value = null;
    if (source?.sent && shown !== undefined) {
      this.source.value = { key: source.key, width: source.width, height: source.height, pixels: shown };
    }
    const aspect = width / columns / (length / rows);
    this.chart.value = { about, knots: knots ?? new Uint8Array(), grid: { rows, columns, aspect } };
    if (!about.yarns.some((yarn) => yarn.name === this.yarn.peek())) this.yarn.value = about.yarns[0]?.name ?? "";
    clearTimeout(this.#timer);
    if (about.draft) {
      this.#timer = setTimeout(() => {
        if (this.recipe.peek() === recipe) this.#send({ recipe, draft: false });
      }, PAUSE);
    }
  }

  /** A value of the recipe as text; "" where it is not given. */
  text(key: string): string {
    const value = this.recipe.value?.[key];
    if (Array.isArray(value)) return value.join(", ");
    return value === undefined || value === null ? "" : String(value);
  }

  /** Sets values of the recipe; "", null and undefined take a key out. */
  set(values: Recipe): void {
    const grid = this.chart.peek()?.grid;
    this.document.update((recipe) => {
      // Edits that state no grid count the knots of the carpet as it was.
      if (grid !== undefined && ("size" in values || "quality" in values)) {
        const edits = anchored(recipe, `${grid.columns}x${grid.rows}`);
        if (edits !== null) recipe["edits"] = edits;
      }
      for (const [key, value] of Object.entries(values)) {
        if (value === "" || value === null || value === undefined) delete recipe[key];
        else recipe[key] = value;
      }
      return recipe;
    });
  }

  /** The edits of the recipe. */
  edits(): readonly EditLine[] {
    return placedLines(this.recipe.value);
  }

  /** Holds an edit on the design at every size, or on the knots of this size alone. */
  anchorEdit(at: number, on: Anchor): void {
    const grid = this.chart.peek()?.grid;
    if (grid !== undefined) {
      this.set({ edits: withAnchor(this.recipe.peek(), at, on, `${grid.columns}x${grid.rows}`) });
    }
  }

  /** Takes an edit out. */
  dropEdit(at: number): void {
    this.set({ edits: withoutLine(this.recipe.peek(), at) });
  }

  /** The yarns of the chart, then those of the list. */
  yarns(): readonly ListedYarn[] {
    const about = this.chart.value?.about;
    return about === undefined ? [] : [...about.yarns, ...about.listed];
  }

  /** The colour of a yarn by its name. */
  colourOf(name: string): string {
    return this.yarns().find((yarn) => yarn.name === name)?.srgb ?? "transparent";
  }

  /** The yarn of a knot of the chart. */
  yarnAt(knot: Knot): ChartYarn | undefined {
    const chart = this.chart.peek();
    return chart?.about.yarns[chart.knots[knot.line * chart.grid.columns + knot.column] ?? 0];
  }

  /** Takes a yarn into the hand; a motif that is held gets it. */
  takeYarnOf(name: string): void {
    this.yarn.value = name;
    const placing = this.placing.peek();
    if (placing?.kind === "motif") {
      this.placing.value = { ...placing, piece: recoloured(placing.piece, this.colourOf(name)) };
    }
  }

  /** Takes the yarn of a knot into the hand. */
  takeYarn(knot: Knot): void {
    this.takeYarnOf(this.yarnAt(knot)?.name ?? this.yarn.peek());
  }

  /** Takes another tool. */
  takeTool(tool: Tool): void {
    this.tool.value = tool;
    this.tile.value = null;
    this.selection.value = null;
    this.placing.value = null;
  }

  /** Holds the selected part over the chart, to place it once or more often. */
  hold(kind: "copy" | "move"): void {
    const [from, chart] = [this.selection.peek(), this.chart.peek()];
    if (from === null || chart === null) return;
    const colours = chart.about.yarns.map((yarn) => yarn.srgb);
    const piece = pieceOf(chart.knots, chart.grid, from, colours);
    this.placing.value = { kind, piece, from, mirrored: false, turned: 0 };
  }

  /** How strokes are drawn. */
  drawing(): Brush {
    return { yarn: this.yarn.peek(), width: this.brush.peek(), symmetry: this.symmetry.peek() };
  }

  /** Places what is held with its upper left knot at a knot. */
  place(at: Knot): void {
    const [placing, chart] = [this.placing.peek(), this.chart.peek()];
    if (placing === null || chart === null) return;
    if (placing.kind === "tile") {
      const before = this.recipe.peek()?.["motif"];
      this.set({ motif: [...(Array.isArray(before) ? before : []), tileEntry(placing, at, chart.grid)] });
      return;
    }
    this.edit(placingEdits(placing, at, this.drawing(), chart.grid));
    // What was moved is no longer where it was.
    if (placing.kind === "move") {
      this.placing.value = null;
      this.selection.value = null;
    }
  }

  /** Adds edits to the recipe; undo takes them out again. */
  edit(lines: readonly string[]): void {
    const grid = this.chart.peek()?.grid;
    if (lines.length === 0 || grid === undefined) return;
    const text = `${grid.columns}x${grid.rows}`;
    this.document.update((recipe) => ({ ...recipe, edits: withLines(recipe, lines, text) }));
  }
}

const models = new Map<string, CarpetModel>();

/** The model of a recipe: the same one as long as the page is open. */
export function modelOf(path: string): CarpetModel {
  const known = models.get(path);
  // A file that was made or brought back is another document.
  if (known !== undefined && known.document === openDocument<Recipe>(path)) return known;
  const model = new CarpetModel(path);
  models.set(path, model);
  return model;
}

/** Names of a list of yarns as the recipe has them: a list, or texts with commas or semicolons. */
export function namesOf(value: unknown): string[] {
  if (Array.isArray(value)) return value.map(String);
  if (typeof value !== "string") return [];
  const names = value.match(/\s*"[^"]*"|\s*'[^']*'|[^,;]+/g) ?? [];
  return names.map((name) => name.trim().replace(/^(["'])(.*)\1$/, "$2")).filter(Boolean);
}
