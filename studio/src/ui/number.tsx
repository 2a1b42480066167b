import type { FieldProps } from "./field";
import { QuantityField } from "./quantity";

interface NumberProps extends Omit<FieldProps, "aside"> {
  value: number;
  min?: number;
  max?: number;
  disabled?: boolean;
  onChange: (value: number) => void;
}

/** A plain number. */
export function NumberField({ value, min, max, onChange, ...rest }: NumberProps) {
  const give = (_: string, number: number | null) => number !== null && onChange(number);
  const bounds = { at_least: min ?? null, at_most: max ?? null };
  return <QuantityField {...rest} value={String(value)} unit="" bounds={bounds} onChange={give} />;
}
