/** Draws a chart with WebGL2: knots as textures of one byte, a palette, symbols; at most one frame a refresh. */
import { type Grid, type Tile, tileKnots, tilesOf, type View } from "./geometry";
import { FRAGMENT, VERTEX } from "./shaders";
import type { Span } from "./symmetry";

export interface Scene {
  view: View;
  /** Share of the canvas left of which chart or picture is shown, 0 to 1. */
  split: number;
  left: "chart" | "source";
}

export interface Paint {
  srgb: string;
  symbol: string;
}

interface TileTexture extends Tile {
  texture: WebGLTexture;
}

const UNIFORMS = [
  "u_knots",
  "u_palette",
  "u_symbols",
  "u_source",
  "u_tile",
  "u_view",
  "u_size",
  "u_grid",
  "u_split",
  "u_left",
  "u_samples",
  "u_lines",
  "u_ratio",
] as const;

/** Largest side of a texture that is used: larger ones are slow to make. */
const LARGEST_TILE = 8192;

/** Side of a symbol in the atlas [px]. */
const CELL = 64;

/** Time after the last change of the view after which its pixels are averaged finely [ms]. */
const REST = 120;

/** Time between two frames above which a moving view is drawn more coarsely, with half as many pixels a side [ms]. */
const SLOW = 24;

export class Renderer {
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;
  readonly #at: Record<(typeof UNIFORMS)[number], WebGLUniformLocation | null>;
  readonly #palette: WebGLTexture;
  readonly #symbols: WebGLTexture;
  readonly #source: WebGLTexture;
  #tiles: TileTexture[] = [];
  #grid: Grid = { rows: 0, columns: 0, aspect: 1 };
  #scene: Scene | null = null;
  #frame = 0;
  #rest: ReturnType<typeof setTimeout> | undefined;
  #fine = false;
  #coarse = false;
  #full = { width: 1, height: 1 };
  /** Mean time between the frames of a movement [ms]; long where there is no graphics hardware. */
  #pace = 16;
  #last = 0;
  #hasSource = false;
  /** Pictures drawn, stated on the canvas for measurements. */
  #pictures = 0;
  #signs = "";

  /** The renderer of a canvas; null where the browser has no WebGL2. */
  static of(canvas: HTMLCanvasElement): Renderer | null {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: true, preserveDrawingBuffer: false });
    return gl === null ? null : new Renderer(canvas, gl);
  }

  private constructor(
    readonly canvas: HTMLCanvasElement,
    gl: WebGL2RenderingContext,
  ) {
    this.#gl = gl;
    this.#program = programOf(gl);
    this.#at = Object.fromEntries(UNIFORMS.map((name) => [name, gl.getUniformLocation(this.#program, name)])) as Record<
      (typeof UNIFORMS)[number],
      WebGLUniformLocation | null
    >;
    this.#palette = textureOf(gl, gl.NEAREST);
    this.#symbols = textureOf(gl, gl.LINEAR_MIPMAP_LINEAR);
    this.#source = textureOf(gl, gl.LINEAR);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.bindTexture(gl.TEXTURE_2D, this.#source);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 1, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, new Uint8Array(3));
  }

  /** Largest number of knots on a side of a texture. */
  get largestTile(): number {
    return Math.min(LARGEST_TILE, this.#gl.getParameter(this.#gl.MAX_TEXTURE_SIZE) as number);
  }

  setChart(grid: Grid, knots: Uint8Array): void {
    const gl = this.#gl;
    const same = grid.rows === this.#grid.rows && grid.columns === this.#grid.columns;
    this.#grid = grid;
    if (!same) {
      for (const tile of this.#tiles) gl.deleteTexture(tile.texture);
      this.#tiles = tilesOf(grid.rows, grid.columns, this.largestTile).map((tile) => ({
        ...tile,
        texture: textureOf(gl, gl.NEAREST),
      }));
    }
    for (const tile of this.#tiles) {
      gl.bindTexture(gl.TEXTURE_2D, tile.texture);
      const part = tileKnots(knots, grid.columns, tile);
      const { columns, rows } = tile;
      if (same) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, columns, rows, gl.RED_INTEGER, gl.UNSIGNED_BYTE, part);
      else gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8UI, columns, rows, 0, gl.RED_INTEGER, gl.UNSIGNED_BYTE, part);
    }
    this.draw();
  }

  /** Gives knots a yarn on the screen, before the server has made the chart with them. */
  paint(spans: readonly Span[], yarn: number): void {
    const gl = this.#gl;
    const value = new Uint8Array(this.#grid.columns).fill(yarn);
    for (const tile of this.#tiles) {
      gl.bindTexture(gl.TEXTURE_2D, tile.texture);
      for (const { column, line, length } of spans) {
        const from = Math.max(column - tile.column, 0);
        const number = Math.min(column + length - tile.column, tile.columns) - from;
        const row = line - tile.line;
        if (number < 1 || row < 0 || row >= tile.rows) continue;
        gl.texSubImage2D(gl.TEXTURE_2D, 0, from, row, number, 1, gl.RED_INTEGER, gl.UNSIGNED_BYTE, value);
      }
    }
    this.draw();
  }

  setYarns(yarns: readonly Paint[]): void {
    const gl = this.#gl;
    const colours = new Uint8Array(256 * 4).fill(255);
    yarns.forEach((yarn, at) => {
      const code = Number.parseInt(yarn.srgb.slice(1), 16);
      colours.set([code >> 16, (code >> 8) & 255, code & 255], 4 * at);
    });
    gl.bindTexture(gl.TEXTURE_2D, this.#palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colours);
    const signs = yarns.map((yarn) => yarn.symbol).join("\n");
    if (signs !== this.#signs) this.#setSymbols(yarns);
    this.#signs = signs;
    this.draw();
  }

  #setSymbols(yarns: readonly Paint[]): void {
    const gl = this.#gl;
    const atlas = document.createElement("canvas");
    atlas.width = 16 * CELL;
    atlas.height = 16 * CELL;
    const context = atlas.getContext("2d");
    if (context === null) return;
    context.fillStyle = "#000";
    context.fillRect(0, 0, atlas.width, atlas.height);
    context.fillStyle = "#fff";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.font = `${0.66 * CELL}px "DejaVu Sans", system-ui, sans-serif`;
    yarns.slice(0, 256).forEach((yarn, at) => {
      context.fillText(yarn.symbol, ((at % 16) + 0.5) * CELL, (Math.floor(at / 16) + 0.54) * CELL, 0.9 * CELL);
    });
    gl.bindTexture(gl.TEXTURE_2D, this.#symbols);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, gl.RED, gl.UNSIGNED_BYTE, atlas);
    gl.generateMipmap(gl.TEXTURE_2D);
  }

  /** The fitted picture, three bytes a pixel. */
  setSource(width: number, height: number, pixels: Uint8Array): void {
    const gl = this.#gl;
    gl.bindTexture(gl.TEXTURE_2D, this.#source);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, width, height, 0, gl.RGB, gl.UNSIGNED_BYTE, pixels);
    this.#hasSource = true;
    this.draw();
  }

  /** Shows a scene in the next frame. */
  show(scene: Scene): void {
    this.#scene = scene;
    if (this.#fine) this.#coarse = false;
    this.#fine = false;
    this.draw();
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => {
      this.#fine = true;
      this.draw();
    }, REST);
  }

  /** Sets the size of the picture [px]. */
  resize(width: number, height: number): void {
    this.#full = { width, height };
    this.draw();
  }

  draw(): void {
    if (this.#frame === 0) this.#frame = requestAnimationFrame(() => this.#drawNow());
  }

  #drawNow(): void {
    this.#frame = 0;
    const [gl, scene, grid] = [this.#gl, this.#scene, this.#grid];
    const now = performance.now();
    if (!this.#fine && now - this.#last < REST) this.#pace += 0.2 * (now - this.#last - this.#pace);
    this.#last = now;
    if (this.#pace > SLOW) this.#coarse = true;
    const part = this.#coarse && !this.#fine ? 2 : 1;
    const [width, height] = [Math.ceil(this.#full.width / part), Math.ceil(this.#full.height / part)];
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (scene === null || grid.rows === 0 || gl.isContextLost()) return;
    const ratio = width / Math.max(1, this.canvas.clientWidth);
    const px = scene.view.scale * ratio;
    const least = px * Math.min(1, grid.aspect);
    gl.useProgram(this.#program);
    const textures = [null, this.#palette, this.#symbols, this.#source];
    textures.forEach((texture, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      if (texture !== null) gl.bindTexture(gl.TEXTURE_2D, texture);
    });
    gl.uniform1i(this.#at.u_knots, 0);
    gl.uniform1i(this.#at.u_palette, 1);
    gl.uniform1i(this.#at.u_symbols, 2);
    gl.uniform1i(this.#at.u_source, 3);
    gl.uniform4f(this.#at.u_view, scene.view.x, scene.view.y, px * grid.aspect, px);
    gl.uniform2f(this.#at.u_size, width, height);
    gl.uniform2f(this.#at.u_grid, grid.columns, grid.rows);
    gl.uniform1f(this.#at.u_split, scene.split >= 1 ? width + 9 : scene.split * width);
    gl.uniform1i(this.#at.u_left, scene.left === "source" && this.#hasSource ? 1 : 0);
    gl.uniform1i(this.#at.u_samples, samplesOf(least, this.#fine ? 8 : this.#coarse ? 1 : 2));
    gl.uniform1f(this.#at.u_lines, 10);
    gl.uniform1f(this.#at.u_ratio, ratio);
    gl.activeTexture(gl.TEXTURE0);
    for (const tile of this.#tiles) {
      gl.bindTexture(gl.TEXTURE_2D, tile.texture);
      gl.uniform4f(this.#at.u_tile, tile.column, tile.line, tile.columns, tile.rows);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
    this.#pictures += 1;
    this.canvas.dataset["pictures"] = String(this.#pictures);
  }

  /** Gives the graphics memory back. */
  end(): void {
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#rest);
    const gl = this.#gl;
    for (const tile of this.#tiles) gl.deleteTexture(tile.texture);
    for (const texture of [this.#palette, this.#symbols, this.#source]) gl.deleteTexture(texture);
    gl.deleteProgram(this.#program);
    this.#tiles = [];
  }
}

/** Samples of a pixel in each direction: as many as knots lie in it, at most `most`. */
export function samplesOf(pixelsPerKnot: number, most: number): number {
  if (pixelsPerKnot >= 2) return 1;
  return Math.min(Math.ceil(1 / pixelsPerKnot) + 1, most);
}

function textureOf(gl: WebGL2RenderingContext, filter: number): WebGLTexture {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter === gl.NEAREST ? gl.NEAREST : gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}

function programOf(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram();
  for (const [kind, text] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(kind) as WebGLShader;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const shaders = gl.getAttachedShaders(program) ?? [];
    throw new Error(shaders.map((shader) => gl.getShaderInfoLog(shader)).join("\n"));
  }
  return program;
}
