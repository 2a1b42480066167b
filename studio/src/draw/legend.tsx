import { cssColour, dashesOf, markerPath } from "./looks";

/** The line of a look as it is drawn: colour, dashes and marker. */
export function Swatch({ look, dashed = false, marked = true }: { look: number; dashed?: boolean; marked?: boolean }) {
  const dashes = dashesOf(look, dashed)
    .map((length) => 1.8 * length)
    .join(" ");
  return (
    <svg class="fig-swatch" width="26" height="12" viewBox="0 0 26 12" aria-hidden="true">
      <path d="M1 6H25" stroke={cssColour(look)} stroke-width="2" stroke-dasharray={dashes || undefined} />
      {marked && <path d={markerPath(look, 13, 6, 3.4)} fill={cssColour(look)} />}
    </svg>
  );
}

/** A filled square of a look. */
export function Patch({ look, pale = false }: { look: number; pale?: boolean }) {
  return (
    <svg class="fig-swatch" width="14" height="12" viewBox="0 0 14 12" aria-hidden="true">
      <rect x="1" y="1" width="12" height="10" rx="2" fill={cssColour(look)} fill-opacity={pale ? 0.35 : 1} />
    </svg>
  );
}
