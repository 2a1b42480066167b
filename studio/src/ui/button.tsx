import type { ButtonHTMLAttributes, ComponentChildren } from "preact";
import { Icon, type IconName } from "./icons";

interface Look {
  kind?: "plain" | "primary" | "quiet" | "danger";
  size?: "normal" | "small";
  icon?: IconName;
  /** Makes the button a toggle, and says whether it is on. */
  pressed?: boolean;
}

type ButtonProps = Look &
  Omit<ButtonHTMLAttributes<HTMLButtonElement>, "size" | "icon"> & { children?: ComponentChildren };

export function Button({
  kind = "plain",
  size = "normal",
  icon,
  pressed,
  children,
  class: more,
  ...rest
}: ButtonProps) {
  const names = ["ui-button", kind, size === "small" ? "small" : "", more ?? ""].filter(Boolean).join(" ");
  return (
    <button type="button" class={names} {...(pressed === undefined ? {} : { "aria-pressed": pressed })} {...rest}>
      {icon && <Icon name={icon} />}
      {children}
    </button>
  );
}

/** A button that shows only an icon; the label is its name, shown as a hint. */
export function IconButton({ label, kind = "quiet", ...rest }: { label: string; icon: IconName } & ButtonProps) {
  return <Button kind={kind} aria-label={label} title={label} {...rest} class={`icon ${rest.class ?? ""}`} />;
}
