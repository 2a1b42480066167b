import { useState } from "preact/hooks";
import type { ShownTrack } from "../../api/messages";
import { t } from "../../text";
import { Button, IconButton, Select, Toggle } from "../../ui";
import type { Shown } from "./curves";
import { EntryField, NameField } from "./fields";
import { type CyclogramData, type EventData, type Quantity, type TrackData, withEntries, without } from "./model";
import { MotionForm } from "./motion-form";
import {
  freeName,
  longestDwell,
  renamedEvent,
  renamedTrack,
  withoutEvent,
  withoutTrack,
  withStroke,
  withTrack,
} from "./structure";

interface TracksProps {
  data: CyclogramData;
  shown: Shown;
  onChange: (data: CyclogramData) => void;
}

/** All tracks as typed values: what the lanes show and what they do not, for the keyboard; added and removed here. */
export function Tracks({ data, shown, onChange }: TracksProps) {
  const [opened, setOpened] = useState("");
  const names = Object.keys(data.tracks ?? {});
  const add = () => {
    const name = freeName(t("cyclogram.track").toLowerCase(), names);
    setOpened(name);
    onChange(withTrack(data, name));
  };
  return (
    <div class="ui-stack">
      {shown.about.tracks.map((track) => (
        <details key={track.name} class="ui-details" open={track.name === opened || shown.about.tracks.length < 3}>
          <summary>
            {track.name} <span class="ui-muted">{track.actuator}</span>
          </summary>
          <TrackForm
            data={data}
            track={track}
            laws={shown.about.laws}
            names={names}
            onChange={onChange}
            onRename={(name) => {
              setOpened(name);
              onChange(renamedTrack(data, track.name, name));
            }}
          />
        </details>
      ))}
      <div class="ui-row">
        <Button icon="add" onClick={add}>
          {t("cyclogram.addTrack")}
        </Button>
      </div>
    </div>
  );
}

interface TrackProps {
  data: CyclogramData;
  track: ShownTrack;
  laws: readonly string[];
  names: readonly string[];
  onChange: (data: CyclogramData) => void;
  onRename: (name: string) => void;
}

/** Units of positions. */
const UNITS = ["mm", "cm", "m", "deg", "rad", ""] as const;

/** Limits of an actuator, and the unit of each after that of the track. */
const LIMITS = { speed: "/s", acceleration: "/s^2", jerk: "/s^3" } as const;

function TrackForm({ data, track, laws, names, onChange, onRename }: TrackProps) {
  const own = data.tracks?.[track.name] ?? {};
  const put = (change: Partial<Record<string, unknown>>) => onChange(withEntries(data, track.name, change));
  const limits = (own["limits"] ?? {}) as Record<string, Quantity | undefined>;
  const limit = (name: string, value: Quantity | undefined) => {
    const made = without({ ...limits, [name]: value });
    put({ limits: Object.keys(made).length ? made : undefined });
  };
  const unit = track.shown_unit;
  const units = UNITS.includes(unit as (typeof UNITS)[number]) ? UNITS : [unit, ...UNITS];
  return (
    <div class="cyclogram-track ui-stack">
      <div class="cyclogram-fields">
        <NameField label={t("cyclogram.name")} value={track.name} taken={names} onCommit={onRename} />
        <NameField
          label={t("cyclogram.actuator")}
          value={track.actuator}
          optional
          onCommit={(actuator) => put({ actuator: actuator || undefined })}
        />
        {track.motions.length === 0 && (
          <Select
            label={t("cyclogram.unit")}
            value={unit}
            choices={units.map((one) => ({ value: one, label: one || t("cyclogram.noUnit") }))}
            onChange={(to) => put({ unit: to })}
          />
        )}
        <EntryField
          label={t("cyclogram.revolves")}
          value={own["revolves"] as Quantity | undefined}
          unit={unit}
          placeholder={t("cyclogram.returns")}
          onChange={(revolves) => put({ revolves })}
        />
        {Object.entries(LIMITS).map(([name, per]) => (
          <EntryField
            key={name}
            label={t(`cyclogram.limit_${name as keyof typeof LIMITS}`)}
            value={limits[name]}
            unit={`${unit || "1"}${per}`}
            placeholder={t("cyclogram.noLimit")}
            onChange={(value) => limit(name, value)}
          />
        ))}
        <EntryField
          label={t("cyclogram.limit_time")}
          value={limits["time"]}
          unit="s"
          placeholder={t("cyclogram.noLimit")}
          onChange={(value) => limit("time", value)}
        />
      </div>
      <Toggle label={t("cyclogram.keep")} value={track.locked} onChange={(held) => put({ held: held || undefined })} />
      {track.motions.map((part) => (
        <MotionForm key={part.name} data={data} track={track} part={part} laws={laws} onChange={onChange} />
      ))}
      <Events data={data} track={track} events={own.events ?? {}} onChange={onChange} />
      <div class="ui-row">
        <Button
          size="small"
          icon="add"
          disabled={longestDwell(track) === null}
          onClick={() => onChange(withStroke(data, track, laws))}
        >
          {t("cyclogram.addStroke")}
        </Button>
        <Button size="small" icon="add" onClick={() => put({ events: { ...own.events, ...newEvent(track) } })}>
          {t("cyclogram.addEvent")}
        </Button>
        <Button
          size="small"
          icon="remove"
          disabled={names.length < 2}
          onClick={() => onChange(withoutTrack(data, track.name))}
        >
          {t("cyclogram.removeTrack")}
        </Button>
      </div>
    </div>
  );
}

/** An event at the end of the first motion; at 0 where there is none. */
function newEvent(track: ShownTrack): TrackData["events"] {
  const name = freeName(
    t("cyclogram.event").toLowerCase(),
    track.events.map((one) => one.name),
  );
  const first = track.motions[0];
  return { [name]: first === undefined ? { angle: "0deg" } : { on: first.name, share: 1 } };
}

interface EventsProps {
  data: CyclogramData;
  track: ShownTrack;
  events: Record<string, EventData>;
  onChange: (data: CyclogramData) => void;
}

/** Named instants: at an angle, or at a share or a position of a motion, which they follow. */
function Events({ data, track, events, onChange }: EventsProps) {
  const put = (name: string, event: EventData) =>
    onChange(withEntries(data, track.name, { events: { ...events, [name]: without(event) } }));
  return (
    <>
      {Object.entries(events).map(([name, event]) => (
        <fieldset key={name} class="cyclogram-motion">
          <legend>
            {t("cyclogram.event")}: {name}
          </legend>
          <NameField
            label={t("cyclogram.name")}
            value={name}
            taken={Object.keys(events)}
            onCommit={(to) => onChange(renamedEvent(data, track.name, name, to))}
          />
          <Select
            label={t("cyclogram.follows")}
            value={event.on ?? ""}
            choices={[
              { value: "", label: t("cyclogram.noMotion") },
              ...track.motions.map((one) => ({ value: one.name, label: one.name })),
            ]}
            onChange={(on) => put(name, on === "" ? { angle: "0deg" } : { on, share: 1 })}
          />
          {event.on === undefined ? (
            <EntryField
              label={t("cyclogram.angle")}
              value={event.angle}
              unit="deg"
              onChange={(angle) => angle !== undefined && put(name, { angle })}
            />
          ) : (
            <>
              <EntryField
                label={t("cyclogram.share")}
                value={event["passing"] === undefined ? ((event["share"] as Quantity | undefined) ?? 1) : undefined}
                unit=""
                onChange={(share) =>
                  put(name, { on: event.on as string, share: share === undefined ? 1 : Number(share) })
                }
              />
              <EntryField
                label={t("cyclogram.passing")}
                value={event["passing"] as Quantity | undefined}
                unit={track.shown_unit}
                onChange={(passing) =>
                  put(
                    name,
                    passing === undefined ? { on: event.on as string, share: 1 } : { on: event.on as string, passing },
                  )
                }
              />
            </>
          )}
          <IconButton
            icon="remove"
            size="small"
            label={t("cyclogram.remove", { name })}
            onClick={() => onChange(withoutEvent(data, track.name, name))}
          />
        </fieldset>
      ))}
    </>
  );
}
