import type { Same } from "..";
import type en from "../en/machine";

export default {
  title: "Makine",
  lead: "Bu görünüm henüz stüdyoda yok. Aynı işi komut satırı yapar:",
} satisfies Same<typeof en>;
