/** Forms of a relation and of an exclusion. */
import { t } from "../../text";
import { Button, IconButton, NumberField, Select } from "../../ui";
import { EntryField, NameField } from "./fields";
import { type CyclogramData, type Quantity, without } from "./model";
import {
  EDGES,
  type Edge,
  type ExclusionData,
  firstMoment,
  type MomentData,
  type PresenceData,
  type RelationData,
  withSides,
} from "./structure";

interface FormProps<Rule> {
  data: CyclogramData;
  rule: Rule;
  onChange: (rule: Rule) => void;
}

/** `then` comes at least `gap` and at most `most` after `first`. */
export function RelationForm({ data, rule, onChange }: FormProps<RelationData>) {
  const put = (change: Partial<Record<keyof RelationData, unknown>>) =>
    onChange(without({ ...rule, ...change }) as RelationData);
  return (
    <div class="cyclogram-form">
      <Moment
        legend={t("cyclogram.later")}
        data={data}
        moment={rule.then}
        onChange={(later) => onChange(withSides(rule, rule.first, later))}
      />
      <Moment legend={t("cyclogram.after")} data={data} moment={rule.first} onChange={(first) => put({ first })} />
      <EntryField label={t("cyclogram.gap")} value={rule.gap} unit="deg" onChange={(gap) => put({ gap })} />
      <EntryField label={t("cyclogram.most")} value={rule.most} unit="deg" onChange={(most) => put({ most })} />
      <EntryField label={t("cyclogram.delay")} value={rule.delay} unit="s" onChange={(delay) => put({ delay })} />
      <NumberField
        label={t("cyclogram.turns")}
        value={rule.turns ?? 0}
        onChange={(turns) => put({ turns: turns || undefined })}
      />
      <NameField
        label={t("cyclogram.why")}
        value={rule.why ?? ""}
        optional
        onCommit={(why) => put({ why: why || undefined })}
      />
    </div>
  );
}

interface MomentProps {
  legend: string;
  data: CyclogramData;
  moment: MomentData;
  onChange: (moment: MomentData) => void;
}

/** Choice of a fixed angle instead of a track. */
const FIXED = "\u0000fixed";

function Moment({ legend, data, moment, onChange }: MomentProps) {
  const tracks = data.tracks ?? {};
  const own = tracks[moment.track ?? ""];
  const edge = EDGES.find((key) => moment[key] !== undefined);
  const instants = EDGES.flatMap((key) =>
    Object.keys((key === "event" ? own?.events : own?.motions) ?? {}).map((name) => ({ key, name })),
  );
  const chosen = instants.findIndex((one) => one.key === edge && one.name === moment[one.key]);
  return (
    <fieldset class="cyclogram-motion">
      <legend>{legend}</legend>
      <Select
        label={t("cyclogram.track")}
        value={moment.angle === undefined ? (moment.track ?? "") : FIXED}
        choices={[
          ...Object.keys(tracks).map((name) => ({ value: name, label: name })),
          { value: FIXED, label: t("cyclogram.fixedAngle") },
        ]}
        onChange={(name) => onChange(name === FIXED ? { angle: "0deg" } : firstMoment(name, tracks[name]))}
      />
      {moment.angle !== undefined ? (
        <EntryField
          label={t("cyclogram.angle")}
          value={moment.angle}
          unit="deg"
          onChange={(angle) => angle !== undefined && onChange({ angle })}
        />
      ) : (
        <Select
          label={t("cyclogram.instant")}
          value={String(chosen)}
          choices={instants.map((one, index) => ({
            value: String(index),
            label: t(`cyclogram.edge_${one.key}`, { name: one.name }),
          }))}
          onChange={(index) => {
            const one = instants[Number(index)];
            if (one !== undefined) onChange(momentOf(moment, one.key, one.name, passing(own, one.name)));
          }}
        />
      )}
      {moment.past !== undefined && (
        <EntryField
          label={t("cyclogram.at")}
          value={moment.at}
          unit={own?.unit ?? "mm"}
          onChange={(at) => at !== undefined && onChange({ ...moment, at })}
        />
      )}
    </fieldset>
  );
}

function momentOf(moment: MomentData, edge: Edge, name: string, at: Quantity): MomentData {
  const made: MomentData = { [edge]: name };
  if (moment.track !== undefined) made.track = moment.track;
  return edge === "past" ? { ...made, at } : made;
}

/** A position that a motion passes: that where it ends. */
function passing(track: NonNullable<CyclogramData["tracks"]>[string] | undefined, motion: string): Quantity {
  return track?.motions?.[motion]?.to ?? 0;
}

/** Two presences that exclude each other. */
export function ExclusionForm({ data, rule, onChange }: FormProps<ExclusionData>) {
  const put = (change: Partial<Record<keyof ExclusionData, unknown>>) =>
    onChange(without({ ...rule, ...change }) as ExclusionData);
  return (
    <div class="cyclogram-form">
      <Presence legend={t("cyclogram.never")} data={data} side={rule.first} onChange={(first) => put({ first })} />
      <Presence legend={t("cyclogram.while")} data={data} side={rule.second} onChange={(second) => put({ second })} />
      <EntryField label={t("cyclogram.gap")} value={rule.gap} unit="deg" onChange={(gap) => put({ gap })} />
      <NameField
        label={t("cyclogram.why")}
        value={rule.why ?? ""}
        optional
        onCommit={(why) => put({ why: why || undefined })}
      />
    </div>
  );
}

interface PresenceProps {
  legend: string;
  data: CyclogramData;
  side: PresenceData;
  onChange: (side: PresenceData) => void;
}

function Presence({ legend, data, side, onChange }: PresenceProps) {
  const tracks = data.tracks ?? {};
  const unit = tracks[side.track ?? ""]?.unit ?? "mm";
  const put = (change: Partial<Record<keyof PresenceData, unknown>>) =>
    onChange(without({ ...side, ...change }) as PresenceData);
  return (
    <fieldset class="cyclogram-motion">
      <legend>{legend}</legend>
      <Select
        label={t("cyclogram.track")}
        value={side.windows === undefined ? (side.track ?? "") : FIXED}
        choices={[
          ...Object.keys(tracks).map((name) => ({ value: name, label: name })),
          { value: FIXED, label: t("cyclogram.windows") },
        ]}
        onChange={(track) =>
          onChange(track === FIXED ? { name: t("cyclogram.windows"), windows: [["0deg", "30deg"]] } : { track })
        }
      />
      <NameField
        label={t("cyclogram.zoneName")}
        value={side.name ?? ""}
        optional
        onCommit={(name) => put({ name: name || undefined })}
      />
      {side.windows === undefined ? (
        <>
          <EntryField
            label={t("cyclogram.above")}
            value={side.above}
            unit={unit}
            onChange={(above) => put({ above })}
          />
          <EntryField
            label={t("cyclogram.below")}
            value={side.below}
            unit={unit}
            onChange={(below) => put({ below })}
          />
        </>
      ) : (
        <Windows windows={side.windows} onChange={(windows) => put({ windows })} />
      )}
    </fieldset>
  );
}

interface WindowsProps {
  windows: NonNullable<PresenceData["windows"]>;
  onChange: (windows: Quantity[][]) => void;
}

function Windows({ windows, onChange }: WindowsProps) {
  const put = (index: number, side: 0 | 1, angle: Quantity) =>
    onChange(windows.map((one, at) => (at === index ? one.map((old, own) => (own === side ? angle : old)) : one)));
  return (
    <>
      {windows.map((one, index) => (
        <div class="cyclogram-window" key={index}>
          <EntryField
            label={t("cyclogram.start")}
            value={one[0]}
            unit="deg"
            onChange={(to) => to !== undefined && put(index, 0, to)}
          />
          <EntryField
            label={t("cyclogram.end")}
            value={one[1]}
            unit="deg"
            onChange={(to) => to !== undefined && put(index, 1, to)}
          />
          <IconButton
            icon="remove"
            size="small"
            label={t("cyclogram.removeWindow", { number: index + 1 })}
            disabled={windows.length < 2}
            onClick={() => onChange(windows.filter((_, at) => at !== index))}
          />
        </div>
      ))}
      <Button size="small" icon="add" onClick={() => onChange([...windows, ["0deg", "30deg"]])}>
        {t("cyclogram.addWindow")}
      </Button>
    </>
  );
}
