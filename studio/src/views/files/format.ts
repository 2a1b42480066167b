import { formatNumber, language } from "../../text";

/** A number of bytes in words: "320 kB". */
export function sizeText(bytes: number): string {
  const units = ["B", "kB", "MB", "GB"];
  let power = 0;
  let value = bytes;
  while (value >= 999.5 && power < units.length - 1) {
    value /= 1000;
    power += 1;
  }
  return `${formatNumber(value, 3)} ${units[power]}`;
}

/** A time [s since 1970]: today's as hour and minute, another one with its date. */
export function timeText(seconds: number): string {
  const time = new Date(1000 * seconds);
  const isToday = time.toDateString() === new Date().toDateString();
  const style = isToday ? {} : ({ dateStyle: "medium" } as const);
  return new Intl.DateTimeFormat(language.value, { ...style, timeStyle: "short", hourCycle: "h23" }).format(time);
}
