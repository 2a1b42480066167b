import type { Same } from "..";
import type en from "../en/linkage";

export default {
  title: "Kol mekanizması",
  lead: "Bu görünüm henüz stüdyoda yok. Aynı işi komut satırı yapar:",
} satisfies Same<typeof en>;
