import type { ComponentChildren } from "preact";
import { t } from "../text";
import { IconButton } from "./button";

interface ZoomProps {
  onZoom: (factor: number) => void;
  onFit: () => void;
  /** The whole drawing is shown: there is nothing to fit; and nothing smaller. */
  whole?: boolean;
  least?: boolean;
  children?: ComponentChildren;
}

const STEP = 1.4;

/** The buttons of a canvas: larger, smaller, everything. */
export function Zoom({ onZoom, onFit, whole = false, least = false, children }: ZoomProps) {
  return (
    <div class="ui-zoom">
      <IconButton icon="plus" label={t("figure.zoomIn")} onClick={() => onZoom(STEP)} />
      <IconButton icon="minus" label={t("figure.zoomOut")} disabled={least} onClick={() => onZoom(1 / STEP)} />
      <IconButton icon="fit" label={t("figure.zoomFit")} disabled={whole} onClick={onFit} />
      {children}
    </div>
  );
}
