import type { Same } from "..";
import type en from "../en/carpet";

export default {
  title: "Halı",
  lead: "Bu görünüm henüz stüdyoda yok. Aynı işi komut satırı yapar:",
} satisfies Same<typeof en>;
