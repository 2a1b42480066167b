/** Components that every view uses. */
export { Button, IconButton } from "./button";
export { CopyCommand, copyText } from "./copy";
export { Dialog } from "./dialog";
export { Icon, type IconName } from "./icons";
export { type Choice, Segments } from "./segments";
export { Tabs } from "./tabs";
export { type ToastKind, toast } from "./toast";
