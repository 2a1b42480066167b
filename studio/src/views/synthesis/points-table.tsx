import { t } from "../../text";
import { Button, IconButton, QuantityField, quantityText } from "../../ui";
import { isRemovable, LISTS, type Machine, type TaskPoint } from "./task";

interface PointsProps {
  machine: Machine;
  points: readonly TaskPoint[];
  chosen: number;
  onChoose: (index: number) => void;
  onChange: (points: TaskPoint[]) => void;
}

const FIELDS = ["x", "y", "angle"] as const;

/** The points of the task as typed values: what the canvas shows, for the keyboard. */
export function PointsTable({ machine, points, chosen, onChoose, onChange }: PointsProps) {
  const { units, most } = LISTS[machine];
  const fields = FIELDS.slice(0, units.length);
  const change = (index: number, field: (typeof FIELDS)[number], si: number | null) => {
    if (si !== null) onChange(points.map((one, at) => (at === index ? { ...one, [field]: si } : one)));
  };
  const add = () => onChange([...points, nextPoint(machine, points)]);
  const move = (index: number, by: number) => {
    const list = [...points];
    const [one] = list.splice(index, 1);
    if (one !== undefined) list.splice(index + by, 0, one);
    onChange(list);
    onChoose(index + by);
  };
  return (
    <div class="ui-stack">
      <ol class="synthesis-points">
        {points.map((point, index) => (
          <li key={index} class={index === chosen ? "chosen" : ""} onFocusIn={() => onChoose(index)}>
            <span class="synthesis-point-number">{index + 1}</span>
            <div class="synthesis-point-fields">
              {fields.map((field, at) => (
                <QuantityField
                  key={field}
                  label={t(`synthesis.${field}`)}
                  value={quantityText(point[field] ?? 0, units[at] ?? "")}
                  unit={units[at] ?? ""}
                  onChange={(_, si) => change(index, field, si)}
                />
              ))}
            </div>
            <div class={`synthesis-point-buttons ${fields.length > 2 ? "column" : ""}`}>
              {machine !== "function-four-bar" && (
                <>
                  <IconButton
                    icon="up"
                    size="small"
                    label={t("synthesis.earlier", { number: index + 1 })}
                    disabled={index === 0}
                    onClick={() => move(index, -1)}
                  />
                  <IconButton
                    icon="down"
                    size="small"
                    label={t("synthesis.later", { number: index + 1 })}
                    disabled={index === points.length - 1}
                    onClick={() => move(index, 1)}
                  />
                </>
              )}
              <IconButton
                icon="remove"
                size="small"
                label={t("synthesis.removePoint", { number: index + 1 })}
                disabled={!isRemovable(machine, points.length)}
                onClick={() => onChange(points.filter((_, at) => at !== index))}
              />
            </div>
          </li>
        ))}
      </ol>
      <div class="ui-row">
        <Button icon="add" disabled={points.length >= most} onClick={add}>
          {t(machine === "motion-four-bar" ? "synthesis.addPose" : "synthesis.addPoint")}
        </Button>
        {machine !== "function-four-bar" && (
          <Button icon="remove" disabled={points.length === 0} onClick={() => onChange([])}>
            {t("synthesis.removeAll")}
          </Button>
        )}
        <span class="ui-muted">{t("synthesis.pointsOf", { count: points.length, most })}</span>
      </div>
    </div>
  );
}

/** How far the second pose is turned from the first [rad]: poses of one angle have parallelograms alone. */
const TURNED = -Math.PI / 12;

/** A point beyond the last one, as far from it as this from the one before. */
export function nextPoint(machine: Machine, points: readonly TaskPoint[]): TaskPoint {
  const last = points.at(-1);
  const before = points.at(-2);
  const step = machine === "function-four-bar" ? { x: 1, y: 1 } : { x: 0.01, y: 0 };
  if (last === undefined) return machine === "motion-four-bar" ? { x: 0, y: 0, angle: 0 } : { x: 0, y: 0 };
  const by = before === undefined ? step : { x: last.x - before.x || step.x, y: last.y - before.y };
  const next = { x: last.x + by.x, y: last.y + by.y };
  if (last.angle === undefined) return next;
  return { ...next, angle: before?.angle === undefined ? last.angle + TURNED : 2 * last.angle - before.angle };
}
