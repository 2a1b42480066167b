import type { Same } from "..";
import type en from "../en/synthesis";

export default {
  title: "Sentez",
  lead: "Bu görünüm henüz stüdyoda yok. Aynı işi komut satırı yapar:",
} satisfies Same<typeof en>;
