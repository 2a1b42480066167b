import { useEffect, useRef, useState } from "preact/hooks";
import type { Corners, PictureAbout } from "../../api/messages";
import { ApiError, post, postPacked } from "../../api/request";
import { formatNumber, t } from "../../text";
import { Button, Dialog, Toggle } from "../../ui";
import type { CarpetModel } from "./model";
import {
  between,
  cornersText,
  cropHandles,
  cropOfRatio,
  cropText,
  movedCrop,
  type PicturePoint,
  pointsOf,
  shiftedCrop,
} from "./parts";

interface SourceProps {
  model: CarpetModel;
  mode: "crop" | "corners";
  onClose: () => void;
}

/** The picture of the recipe, and on it the part that is used, or the corners of a photographed carpet. */
export function SourceDialog({ model, mode, onClose }: SourceProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [about, setAbout] = useState<PictureAbout | null>(null);
  const [points, setPoints] = useState<PicturePoint[]>([]);
  const [problem, setProblem] = useState("");
  const [busy, setBusy] = useState(false);
  const [kept, setKept] = useState(false);
  const picture = model.text("picture");
  const page = Number(model.recipe.value?.page ?? 1);

  useEffect(() => {
    const abort = new AbortController();
    // A crop counts in the picture after it is straightened and turned.
    const before = mode === "crop" ? { corners: model.text("corners"), turn: model.text("turn") } : {};
    postPacked<PictureAbout>("/carpet/picture", { picture, page, most: 1200, ...before }, abort.signal).then(
      ({ about: read, parts }) => {
        const { shown_width: width, shown_height: height } = read;
        const [pixels] = parts([3 * width * height]);
        draw(canvas.current, width, height, pixels ?? new Uint8Array());
        setAbout(read);
        setPoints(startOf(model, mode, read));
      },
      (error: unknown) => !abort.signal.aborted && setProblem(textOf(error)),
    );
    return () => abort.abort();
  }, [picture, page, mode]);

  const find = async () => {
    setBusy(true);
    setProblem("");
    try {
      const answer = await post<Corners>("/carpet/corners", { picture, page });
      setPoints(answer.corners.map(([x, y]) => ({ x, y })));
    } catch (error) {
      setProblem(textOf(error));
    }
    setBusy(false);
  };
  const apply = () => {
    if (about === null) return;
    const [first, last] = [points[0], points[1]];
    if (mode === "corners") model.set({ corners: cornersText(points) });
    else if (first && last) model.set({ crop: cropText(first, last, about.width, about.height) });
    onClose();
  };
  const handles = mode === "crop" ? cropHandles(points) : points;
  const ratio = ratioOf(model);
  const move = (corner: number, to: PicturePoint) => {
    if (about === null) return;
    const held = { x: between(to.x, 0, about.width), y: between(to.y, 0, about.height) };
    setPoints(
      mode === "crop"
        ? movedCrop(points, corner, to, kept ? ratio : null, about)
        : points.map((point, index) => (index === corner ? held : point)),
    );
  };
  const shift = (by: PicturePoint) => about !== null && setPoints(shiftedCrop(points, by, about));
  const keep = (on: boolean) => {
    setKept(on);
    if (on) setPoints(cropOfRatio(points, ratio));
  };
  return (
    <Dialog
      title={mode === "crop" ? t("carpet.cropPicture") : t("carpet.setCorners")}
      open
      wide
      onClose={onClose}
      actions={
        <>
          {mode === "corners" && (
            <Button onClick={() => void find()} disabled={busy || about === null}>
              {busy ? t("carpet.finding") : t("carpet.findCorners")}
            </Button>
          )}
          <Button
            onClick={() => {
              model.set({ [mode]: "" });
              onClose();
            }}
          >
            {mode === "crop" ? t("carpet.wholePicture") : t("carpet.noCorners")}
          </Button>
          <Button kind="primary" onClick={apply} disabled={about === null}>
            {t("carpet.apply")}
          </Button>
        </>
      }
    >
      <p class="ui-help">{mode === "crop" ? t("carpet.cropHelp") : t("carpet.cornersHelp")}</p>
      {problem !== "" && (
        <p class="ui-callout bad" role="alert">
          {problem}
        </p>
      )}
      {mode === "crop" && (
        <div class="ui-row">
          <Toggle label={t("carpet.keepRatio")} value={kept} onChange={keep} />
          <output class="ui-muted">{about !== null && shareText(points, about)}</output>
        </div>
      )}
      <div class="carpet-source">
        <canvas ref={canvas} width={1} height={1} />
        {about !== null && (
          <>
            <svg viewBox={`0 0 ${about.width} ${about.height}`} preserveAspectRatio="none" aria-hidden="true">
              <path
                fill-rule="evenodd"
                d={`M0 0H${about.width}V${about.height}H0ZM${handles.map(({ x, y }) => `${x} ${y}`).join("L")}Z`}
              />
            </svg>
            {mode === "crop" && <Frame handles={handles} about={about} onShift={shift} />}
            {handles.map((point, corner) => (
              <Handle key={corner} corner={corner} point={point} about={about} onMove={move} />
            ))}
          </>
        )}
      </div>
    </Dialog>
  );
}

/** Width by length of the carpet. */
function ratioOf(model: CarpetModel): number {
  const carpet = model.chart.value?.about;
  return carpet === undefined ? 1 : carpet.width / carpet.length;
}

/** The share of the picture that a crop keeps. */
function shareText([first, last]: readonly PicturePoint[], about: PictureAbout): string {
  if (first === undefined || last === undefined) return "";
  const share = Math.abs((last.x - first.x) * (last.y - first.y)) / (about.width * about.height);
  return t("carpet.cropShare", { share: formatNumber(100 * share, 3) });
}

/** Steps of the arrow keys [pixels of the picture]. */
function keyStep(event: KeyboardEvent, about: PictureAbout): PicturePoint | null {
  const step = (event.shiftKey ? 0.05 : 0.005) * Math.max(about.width, about.height);
  const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
  if (by === undefined) return null;
  event.preventDefault();
  return { x: by[0] ?? 0, y: by[1] ?? 0 };
}

/** Where a pointer that is held by an element of the picture is [pixels of the picture]. */
function heldPoint(event: PointerEvent, about: PictureAbout): PicturePoint | null {
  const element = event.currentTarget as HTMLElement;
  const box = element.parentElement?.getBoundingClientRect();
  if (box === undefined || !element.hasPointerCapture(event.pointerId)) return null;
  return {
    x: ((event.clientX - box.left) / box.width) * about.width,
    y: ((event.clientY - box.top) / box.height) * about.height,
  };
}

interface FrameProps {
  handles: readonly PicturePoint[];
  about: PictureAbout;
  onShift: (by: PicturePoint) => void;
}

/** The part that is used: dragged, or moved by the arrow keys, as it is. */
function Frame({ handles, about, onShift }: FrameProps) {
  const from = useRef<PicturePoint | null>(null);
  const [xs, ys] = [handles.map(({ x }) => x), handles.map(({ y }) => y)];
  const [left, top] = [Math.min(...xs), Math.min(...ys)];
  const shares = {
    left: `${(100 * left) / about.width}%`,
    top: `${(100 * top) / about.height}%`,
    width: `${(100 * (Math.max(...xs) - left)) / about.width}%`,
    height: `${(100 * (Math.max(...ys) - top)) / about.height}%`,
  };
  const drag = (event: PointerEvent) => {
    const to = heldPoint(event, about);
    if (to !== null && from.current !== null) onShift({ x: to.x - from.current.x, y: to.y - from.current.y });
    from.current = to;
  };
  const key = (event: KeyboardEvent) => {
    const by = keyStep(event, about);
    if (by !== null) onShift(by);
  };
  return (
    <button
      type="button"
      class="carpet-frame"
      style={shares}
      aria-label={t("carpet.cropFrame")}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        from.current = heldPoint(event, about);
      }}
      onPointerMove={drag}
      onKeyDown={key}
    />
  );
}

interface HandleProps {
  corner: number;
  point: PicturePoint;
  about: PictureAbout;
  onMove: (corner: number, to: PicturePoint) => void;
}

/** A corner that is dragged, or moved by the arrow keys. */
function Handle({ corner, point, about, onMove }: HandleProps) {
  const names = [t("carpet.upperLeft"), t("carpet.upperRight"), t("carpet.lowerRight"), t("carpet.lowerLeft")];
  const drag = (event: PointerEvent) => {
    const to = heldPoint(event, about);
    if (to !== null) onMove(corner, to);
  };
  const key = (event: KeyboardEvent) => {
    const by = keyStep(event, about);
    if (by !== null) onMove(corner, { x: point.x + by.x, y: point.y + by.y });
  };
  return (
    <button
      type="button"
      class="carpet-handle"
      style={{ left: `${(100 * point.x) / about.width}%`, top: `${(100 * point.y) / about.height}%` }}
      aria-label={`${names[corner] ?? ""}: ${Math.round(point.x)}, ${Math.round(point.y)}`}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={drag}
      onKeyDown={key}
    >
      {corner + 1}
    </button>
  );
}

function startOf(model: CarpetModel, mode: "crop" | "corners", about: PictureAbout): PicturePoint[] {
  const { width, height } = about;
  const stated = pointsOf(model.text(mode), mode === "crop" ? 2 : 4, width, height);
  if (stated !== null) return stated;
  const whole = [
    { x: 0, y: 0 },
    { x: width, y: height },
  ];
  if (mode === "crop") return whole;
  const [left, right, top, bottom] = [0.1 * width, 0.9 * width, 0.1 * height, 0.9 * height];
  return [
    { x: left, y: top },
    { x: right, y: top },
    { x: right, y: bottom },
    { x: left, y: bottom },
  ];
}

function draw(canvas: HTMLCanvasElement | null, width: number, height: number, pixels: Uint8Array): void {
  const context = canvas?.getContext("2d");
  if (!canvas || !context) return;
  canvas.width = width;
  canvas.height = height;
  const image = context.createImageData(width, height);
  for (let at = 0; at < width * height; at += 1) {
    image.data.set(pixels.subarray(3 * at, 3 * at + 3), 4 * at);
    image.data[4 * at + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

function textOf(error: unknown): string {
  if (!(error instanceof ApiError)) return t("app.lost");
  return [error.given, error.allowed, error.do].filter(Boolean).join("; ");
}
