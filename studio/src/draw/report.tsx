import type { ComponentChildren } from "preact";
import { useMemo } from "preact/hooks";
import { Table } from "../ui";
import { CursorContext, type Cursors } from "./cursor";
import { Drawing } from "./drawing";
import { aboutOf, type ShownFigure, type ShownTable } from "./figures";
import { Player } from "./player";
import { Plot } from "./plot";
import { Gantt, StackedBars } from "./spans";
import { Timing } from "./timing";

/** A figure with its title and note. */
export function Figure({
  figure,
  ghost,
  autoplay = false,
}: Omit<BodyProps, "height" | "autoplay"> & { autoplay?: boolean }) {
  const { title, note } = aboutOf(figure);
  const wide = figure.timing || figure.gantt || figure.bars;
  return (
    <figure class={`figure${wide ? " wide" : ""}`}>
      <figcaption>{title}</figcaption>
      <FigureBody figure={figure} ghost={ghost} autoplay={autoplay} />
      {note && <p class="ui-help">{note}</p>}
    </figure>
  );
}

interface BodyProps {
  figure: ShownFigure;
  /** Another state of it, pale behind what moves. */
  ghost?: ShownFigure | undefined;
  autoplay: boolean;
  /** Height of curves and drawings [px]. */
  height?: number | undefined;
}

/** A figure without title and note. */
export function FigureBody({ figure, ghost, autoplay, height }: BodyProps) {
  const { plot, drawing, animation, timing, gantt, bars } = figure;
  const { title } = aboutOf(figure);
  if (plot) return <Plot plot={plot} title={title} height={height} />;
  if (drawing) return <Drawing drawing={drawing} title={title} height={height} />;
  if (animation) return <Player animation={animation} ghost={ghost?.animation} {...{ title, autoplay, height }} />;
  if (timing) return <Timing timing={timing} title={title} />;
  if (gantt) return <Gantt gantt={gantt} title={title} />;
  return bars ? <StackedBars bars={bars} title={title} /> : null;
}

/** Figures over the same quantity inside share a cursor. */
export function SharedCursor({ children }: { children: ComponentChildren }) {
  const cursors = useMemo<Cursors>(() => new Map(), []);
  return <CursorContext.Provider value={cursors}>{children}</CursorContext.Provider>;
}

/** Tables of a report. */
export function Tables({ tables }: { tables: readonly ShownTable[] }) {
  return (
    <div class="ui-stack">
      {tables.map((table) => (
        <Table
          key={table.name}
          label={table.title}
          columns={table.columns}
          rows={table.rows}
          height="420px"
          captioned
        />
      ))}
    </div>
  );
}
