import { formatNumber, t } from "../text";
import { Button } from "./button";

interface ProgressProps {
  label: string;
  /** 0 to 1; left out where it is not known. */
  share?: number | undefined;
  onCancel?: (() => void) | undefined;
}

export function Progress({ label, share, onCancel }: ProgressProps) {
  const percent = share === undefined ? undefined : Math.round(100 * Math.min(Math.max(share, 0), 1));
  return (
    <div class="ui-progress">
      <div class="ui-row">
        <span class="ui-grow">{label}</span>
        {percent !== undefined && <span>{t("ui.progress", { percent: formatNumber(percent) })}</span>}
        {onCancel && (
          <Button size="small" onClick={onCancel}>
            {t("ui.cancel")}
          </Button>
        )}
      </div>
      <div
        class={`ui-progress-bar${percent === undefined ? " open" : ""}`}
        role="progressbar"
        aria-label={label}
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuenow={percent}
      >
        <div style={percent === undefined ? {} : { transform: `scaleX(${percent / 100})` }} />
      </div>
    </div>
  );
}
