/** What is chosen, with its numbers: name, position, lengths, entries of the file; and what can be done with it. */
import { useSignal } from "@preact/signals";
import { t } from "../../text";
import { Button, formatQuantity, QuantityField, readQuantity, toast } from "../../ui";
import type { Editor } from "./editor";
import { Entries, EntryField } from "./entries";
import { distance, plus, toWorld, type Vec, vec } from "./geometry";
import { bodiesOf, copyBodies, GROUND, type MechanismData, setPoint, type Table } from "./mechanism";
import { endOfSide, type Side, sidesOf } from "./moving";
import { deleteSelection } from "./pointer";
import { renameBody, renameJoint, renamePoint } from "./renaming";

export function Selected({ editor }: { editor: Editor }) {
  const { bodies, joints, points } = editor.selection.value;
  const count = bodies.length + joints.length + points.length;
  if (count === 0) return null;
  const [body, joint, point] = [bodies[0], joints[0], points[0]];
  return (
    <section class="linkage-numbers" aria-label={t("linkage.selected")}>
      {count > 1 ? (
        <h2>{t("linkage.several", { count })}</h2>
      ) : body !== undefined ? (
        <BodyNumbers key={body} editor={editor} body={body} />
      ) : joint !== undefined ? (
        <JointNumbers key={joint} editor={editor} joint={joint} />
      ) : (
        point !== undefined && <PointNumbers key={point} editor={editor} point={point} />
      )}
      <Actions editor={editor} />
    </section>
  );
}

interface NameProps {
  editor: Editor;
  name: string;
  rename: (data: MechanismData, to: string) => boolean;
  onRenamed: (to: string) => void;
}

function NameField({ editor, name, rename, onRenamed }: NameProps) {
  return (
    <EntryField
      label={t("linkage.name")}
      value={name}
      onCommit={(to) => {
        let done = false;
        editor.edit((data) => {
          done = rename(data, to);
        });
        if (done) onRenamed(to);
        else toast(t("linkage.notRenamed", { name: to }), "warn");
        return done;
      }}
    />
  );
}

function BodyNumbers({ editor, body }: { editor: Editor; body: string }) {
  const table = editor.document.data.value?.bodies?.[body];
  if (table === undefined) return null;
  return (
    <>
      <h2>{t("linkage.body", { name: body })}</h2>
      {body !== GROUND && (
        <NameField
          editor={editor}
          name={body}
          rename={(data, to) => renameBody(data, body, to)}
          onRenamed={(to) => editor.select({ bodies: [to] })}
        />
      )}
      {body !== GROUND && table.length === undefined && <Sides editor={editor} body={body} />}
      <Entries editor={editor} path={["bodies", body]} table={table} />
    </>
  );
}

/** The distances of a body's points: a typed one moves the second point. */
function Sides({ editor, body }: { editor: Editor; body: string }) {
  const answer = editor.answer.value?.bodies.find((one) => one.name === body);
  const entries = editor.document.data.value?.bodies?.[body]?.points ?? {};
  if (answer === undefined) return null;
  const own = Object.entries(answer.points).filter(([name]) => Array.isArray(entries[name]));
  const points = Object.fromEntries(own.map(([name, [x, y]]) => [name, vec(x, y)]));
  const set = (side: Side, text: string) => {
    const read = readQuantity(text, "mm");
    if (!("si" in read) || read.si <= 0) return false;
    const to = endOfSide(points, side, read.si);
    const pose = editor.figure.peek()?.poses[body];
    if (answer.solved || !pose || editor.data.joints?.[side.to] === undefined) {
      editor.edit((data) => setPoint(data, body, side.to, to));
    } else editor.moveJoint(side.to, toWorld(pose, to));
    return true;
  };
  return (
    <div class="linkage-entries">
      {sidesOf(points).map((side) => (
        <EntryField
          key={`${side.from} ${side.to}`}
          label={t("linkage.side", { from: side.from, to: side.to })}
          value={formatQuantity(side.length, "mm", 6)}
          onCommit={(text) => set(side, text)}
        />
      ))}
    </div>
  );
}

function JointNumbers({ editor, joint }: { editor: Editor; joint: string }) {
  const table = editor.document.data.value?.joints?.[joint];
  const drawn = editor.figure.value?.joints.find((one) => one.name === joint);
  if (table === undefined) return null;
  return (
    <>
      <h2>{t("linkage.joint", { name: joint })}</h2>
      <p class="ui-help">{t("linkage.joins", { bodies: bodiesOf(table).join(", ") })}</p>
      <NameField
        editor={editor}
        name={joint}
        rename={(data, to) => renameJoint(data, joint, to)}
        onRenamed={(to) => editor.select({ joints: [to] })}
      />
      {drawn && <Coordinates at={drawn.at} onMove={(to) => editor.moveJoint(joint, to)} />}
      <Entries editor={editor} path={["joints", joint]} table={table as Table} skip={["pin", "slide"]} />
    </>
  );
}

function PointNumbers({ editor, point }: { editor: Editor; point: string }) {
  const drawn = editor.figure.value?.points.find((one) => `${one.body}.${one.name}` === point);
  if (!drawn) return null;
  const { body, name } = drawn;
  const entry = editor.document.data.value?.bodies?.[body]?.points?.[name];
  return (
    <>
      <h2>{t("linkage.pointOf", { name, body })}</h2>
      <NameField
        editor={editor}
        name={name}
        rename={(data, to) => renamePoint(data, body, name, to)}
        onRenamed={(to) => editor.select({ points: [`${body}.${to}`] })}
      />
      <Coordinates at={drawn.at} onMove={(to) => editor.movePoint(body, name, to)} />
      {entry !== undefined && <Entries editor={editor} path={["bodies", body, "points"]} table={{ [name]: entry }} />}
    </>
  );
}

interface CoordinatesProps {
  at: Vec;
  onMove: (to: Vec) => void;
}

/** Position in the world, typed: taken over with Enter or on leaving. */
function Coordinates({ at, onMove }: CoordinatesProps) {
  const typed = useSignal<{ x?: number; y?: number }>({});
  const shown = (value: number) => `${Number((value * 1000).toFixed(4))}mm`;
  const commit = () => {
    const to = vec(typed.peek().x ?? at.x, typed.peek().y ?? at.y);
    if (distance(to, at) > 1e-9) onMove(to);
    typed.value = {};
  };
  return (
    <form
      class="linkage-coordinates"
      onSubmit={(event) => {
        event.preventDefault();
        commit();
      }}
      onFocusOut={(event) => {
        if (!event.currentTarget.contains(event.relatedTarget as Node | null)) commit();
      }}
    >
      <QuantityField
        label="x"
        unit="mm"
        value={shown(at.x)}
        onChange={(_, x) => {
          if (x !== null) typed.value = { ...typed.peek(), x };
        }}
      />
      <QuantityField
        label="y"
        unit="mm"
        value={shown(at.y)}
        onChange={(_, y) => {
          if (y !== null) typed.value = { ...typed.peek(), y };
        }}
      />
      <button type="submit" class="visually-hidden">
        {t("linkage.set")}
      </button>
    </form>
  );
}

/** What can be done with the chosen bodies. */
function Actions({ editor }: { editor: Editor }) {
  const { bodies } = editor.selection.value;
  const copy = (mirrored: boolean) => {
    const figure = editor.figure.peek();
    if (figure === null) return;
    const corners = Object.fromEntries(
      figure.bodies.map((body) => [body.name, Object.fromEntries(body.points.map((point) => [point.name, point.at]))]),
    );
    const all = figure.bodies.filter((body) => bodies.includes(body.name)).flatMap((body) => body.outline);
    const right = Math.max(...all.map((point) => point.x));
    const aside = 24 / editor.camera.peek().scale;
    const place = mirrored
      ? (at: Vec) => vec(2 * right + aside - at.x, at.y)
      : (at: Vec) => plus(at, vec(aside, -aside));
    let made: string[] = [];
    editor.edit((data) => {
      made = copyBodies(data, bodies, corners, place);
    });
    editor.select({ bodies: made });
  };
  const some = bodies.some((body) => body !== GROUND);
  return (
    <div class="ui-row">
      {some && (
        <>
          <Button size="small" onClick={() => copy(false)}>
            {t("linkage.duplicate")}
          </Button>
          <Button size="small" onClick={() => copy(true)}>
            {t("linkage.mirror")}
          </Button>
        </>
      )}
      <Button size="small" icon="remove" onClick={() => deleteSelection(editor)}>
        {t("linkage.remove")}
      </Button>
    </div>
  );
}
