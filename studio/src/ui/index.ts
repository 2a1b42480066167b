/** Components that every view uses. */
export { Button, IconButton } from "./button";
export { CopyCommand, copyText } from "./copy";
export { Dialog } from "./dialog";
export { FaultNote } from "./fault-note";
export { Icon, type IconName } from "./icons";
export { NumberField } from "./number";
export { Progress } from "./progress";
export { boundsText, QuantityField } from "./quantity";
export { type Choice, Segments } from "./segments";
export { Select, TextField, Toggle } from "./select";
export { Slider } from "./slider";
export { Split } from "./split";
export { type Cell, Table, type TableColumn } from "./table";
export { Tabs } from "./tabs";
export { type ToastKind, toast } from "./toast";
export { type Bounds, formatQuantity, fromSi, parseUnit, quantityText, readQuantity, shownUnit } from "./units";
export { type Size, useSize } from "./use-size";
