/** What turns the loom: play, the cyclogram of a row or a knot, its angle, its speed. */
import { formatNumber, formatSpan, t } from "../../text";
import { IconButton, Segments, Select, Slider } from "../../ui";
import { TURN } from "./motion";
import type { Player } from "./player";
import type { Drive, ScenePhase } from "./scene";

const SLOWER = [1, 2, 5, 10, 50];

interface DriveBarProps {
  player: Player;
  drive: Drive;
  period: number;
  /** All that can be turned. */
  drives: readonly Drive[];
  /** The motions of the machine at an angle. */
  motions: (angle: number) => readonly ScenePhase[];
  onDrive: (drive: Drive) => void;
}

export function DriveBar({ player, drive, period, drives, motions, onDrive }: DriveBarProps) {
  const { angle, playing, speed } = player;
  const turned = angle.value;
  const degrees = formatNumber(Math.round((turned * 3600) / TURN) / 10);
  const moving = motions(turned).map(({ track, name }) => `${track}: ${name}`);
  return (
    <div class="loom-drive">
      <p class="loom-moving">{moving.length === 0 ? t("loom.nothingMoves") : moving.join(" · ")}</p>
      <IconButton
        icon={playing.value ? "pause" : "play"}
        label={playing.value ? t("loom.pause") : t("loom.play")}
        onClick={() => {
          playing.value = !playing.value;
        }}
      />
      <Segments
        label={t("loom.drive")}
        labelHidden
        value={drive}
        choices={drives.map((value) => ({ value, label: t(`loom.${value}`) }))}
        onChange={onDrive}
      />
      <Slider
        label={t("loom.angle")}
        value={turned}
        min={0}
        max={TURN}
        step={TURN / 720}
        text={t("loom.angleText", { angle: degrees, time: formatSpan((turned / TURN) * period) })}
        onInput={(to) => {
          angle.value = to;
        }}
      />
      <Select
        label={t("loom.speed")}
        value={String(speed.value)}
        choices={SLOWER.map((factor) => ({
          value: String(1 / factor),
          label: factor === 1 ? t("loom.fullSpeed") : t("loom.slower", { factor }),
        }))}
        onChange={(to) => {
          speed.value = Number(to);
        }}
      />
    </div>
  );
}
