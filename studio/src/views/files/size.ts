import { formatNumber } from "../../text";

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
