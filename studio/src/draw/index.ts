/** Figures of reports, drawn from plain data, with a shared cursor. */
import "./checks.css";
import "./draw.css";

export { CheckList, type CheckShown } from "./checks";
export { CursorContext, type Cursors, cursorOf, moveTo, useCursor } from "./cursor";
export { Designs } from "./designs";
export { Drawing } from "./drawing";
export * from "./figures";
export { colourOf, colours, cssColour } from "./looks";
export { Player } from "./player";
export { Plot } from "./plot";
export { Figure, SharedCursor, Tables } from "./report";
export { ChoiceTable, ResultTable } from "./results";
export { Gantt, StackedBars } from "./spans";
export { Timing } from "./timing";
