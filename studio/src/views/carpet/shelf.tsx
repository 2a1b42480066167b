import { useEffect, useMemo, useState } from "preact/hooks";
import type { PictureAbout } from "../../api/messages";
import { postPacked } from "../../api/request";
import { project, uploadPicture } from "../../project";
import { formatNumber, t } from "../../text";
import { Button, Slider, Toggle, toast } from "../../ui";
import { Borders } from "./border-list";
import type { CarpetModel } from "./model";
import { MOTIFS, type MotifName } from "./motifs";
import { canvasOf, type Piece, type Placing, pictureOf, pieceOf, pieceOfMotif } from "./placing";

/** Largest side of a picture that is a tile [pixels]. */
const LARGEST_TILE = 240;

/** Largest file that is looked at as a tile [bytes]. */
const LARGEST_FILE = 200_000;

const NAMES = Object.keys(MOTIFS) as MotifName[];

/** Motifs to place on the chart: those of the studio in the yarn in hand, and the small pictures of the project. */
export function Shelf({ model }: { model: CarpetModel }) {
  const [scale, setScale] = useState(1);
  const colour = model.colourOf(model.yarn.value);
  const hold = (name: MotifName) => {
    model.takeTool("select");
    const piece = pieceOfMotif(MOTIFS[name], scale, colour);
    model.placing.value = { kind: "motif", piece, mirrored: false, turned: 0 };
  };
  return (
    <div class="ui-stack">
      <p class="ui-help">{t("carpet.shelfHelp")}</p>
      <Slider
        label={t("carpet.motifScale")}
        value={scale}
        min={1}
        max={6}
        step={1}
        text={formatNumber(scale)}
        onInput={(value) => {
          setScale(value);
          model.placing.value = null;
        }}
      />
      <ul class="carpet-motifs" aria-label={t("carpet.motifs")}>
        {NAMES.map((name) => (
          <Motif key={name} name={name} colour={colour} onHold={() => hold(name)} />
        ))}
      </ul>
      <p class="ui-help">{t("carpet.motifSource")}</p>
      <Tiles model={model} />
      <Keep model={model} />
      <details class="ui-details">
        <summary>{t("carpet.borders")}</summary>
        <Borders model={model} />
      </details>
    </div>
  );
}

function Motif({ name, colour, onHold }: { name: MotifName; colour: string; onHold: () => void }) {
  const href = useMemo(() => pictureOf(pieceOfMotif(MOTIFS[name], 1, colour)), [name, colour]);
  return (
    <li>
      <button type="button" class="carpet-motif" onClick={onHold}>
        <img src={href} alt="" />
        <span>
          <strong>{t(`carpet.${name}Motif`)}</strong>
          <span class="ui-help">{t(`carpet.${name}Meaning`)}</span>
        </span>
      </button>
    </li>
  );
}

/** A small picture of the project. */
interface Tile {
  path: string;
  piece: Piece;
}

function Tiles({ model }: { model: CarpetModel }) {
  const [tiles, setTiles] = useState<readonly Tile[]>([]);
  const [shows, setShows] = useState(false);
  const pictures = project.value?.pictures ?? [];
  const paths = pictures.filter((picture) => picture.size <= LARGEST_FILE).map((picture) => picture.path);
  const key = paths.join("\n");
  useEffect(() => {
    const abort = new AbortController();
    void Promise.all(paths.map((path) => tileOf(path, abort.signal))).then(
      (answers) => !abort.signal.aborted && setTiles(answers.filter((tile) => tile !== null)),
    );
    return () => abort.abort();
  }, [key]);
  const hold = ({ path, piece }: Tile) => {
    model.takeTool("select");
    const [red = 0, green = 0, blue = 0] = piece.pixels;
    const ground = `#${((1 << 24) | (red << 16) | (green << 8) | blue).toString(16).slice(1)}`;
    const placing: Placing = { kind: "tile", piece, picture: path, mirrored: false, turned: 0 };
    model.placing.value = shows ? { ...placing, transparent: ground, piece: without(piece, ground) } : placing;
  };
  if (tiles.length === 0) return <p class="ui-help">{t("carpet.noTiles", { most: LARGEST_TILE })}</p>;
  return (
    <div class="ui-stack">
      <h2>{t("carpet.tiles")}</h2>
      <Toggle label={t("carpet.tileGround")} value={shows} onChange={setShows} />
      <ul class="carpet-motifs" aria-label={t("carpet.tiles")}>
        {tiles.map((tile) => (
          <li key={tile.path}>
            <button type="button" class="carpet-motif" onClick={() => hold(tile)}>
              <img src={pictureOf(tile.piece)} alt="" />
              <span>{tile.path.replace(/^pictures\//, "")}</span>
            </button>
          </li>
        ))}
      </ul>
    </div>
  );
}

/** A piece whose knots of a colour do not show. */
function without({ columns, rows, pixels }: Piece, colour: string): Piece {
  const fresh = new Uint8ClampedArray(pixels);
  const code = Number.parseInt(colour.slice(1), 16);
  for (let at = 0; at < fresh.length; at += 4)
    if ((((fresh[at] ?? 0) << 16) | ((fresh[at + 1] ?? 0) << 8) | (fresh[at + 2] ?? 0)) === code) fresh[at + 3] = 0;
  return { columns, rows, pixels: fresh };
}

/** A picture as a tile; null where it is larger, or cannot be read. */
async function tileOf(path: string, abort: AbortSignal): Promise<Tile | null> {
  try {
    const body = { picture: path, most: LARGEST_TILE };
    const { about, parts } = await postPacked<PictureAbout>("/carpet/picture", body, abort);
    const { width, height, shown_width: columns, shown_height: rows } = about;
    if (width !== columns || height !== rows) return null;
    const [rgb = new Uint8Array()] = parts([3 * columns * rows]);
    const pixels = new Uint8ClampedArray(4 * columns * rows).fill(255);
    for (let at = 0; at < columns * rows; at += 1) pixels.set(rgb.subarray(3 * at, 3 * at + 3), 4 * at);
    return { path, piece: { columns, rows, pixels } };
  } catch {
    return null;
  }
}

/** Puts the selected part on the shelf: a picture of the project. */
function Keep({ model }: { model: CarpetModel }) {
  const keep = () => {
    const [from, chart] = [model.selection.peek(), model.chart.peek()];
    if (from === null || chart === null) return;
    const colours = chart.about.yarns.map((yarn) => yarn.srgb);
    canvasOf(pieceOf(chart.knots, chart.grid, from, colours)).toBlob((blob) => {
      if (blob === null) return;
      uploadPicture(new File([blob], "motif.png", { type: "image/png" })).catch((error: unknown) =>
        toast(t("carpet.notTaken", { name: "motif.png" }), "bad", error instanceof Error ? error.message : ""),
      );
    });
  };
  return (
    <div class="ui-row">
      <Button disabled={model.selection.value === null} onClick={keep}>
        {t("carpet.keepSelection")}
      </Button>
    </div>
  );
}
