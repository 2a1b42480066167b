/** Texts of studies in Turkish. */
import type { Same } from "../catalogue";
import type en from "../en/study";

export default {
  title: "İnceleme",
  vary: "Değişen",
  range: "27deg..33deg gibi bir aralık ya da virgüllü değerler",
  result: "Sonuç",
  least: "olabildiğince küçük",
  most: "olabildiğince büyük",
  shown: "yalnız gösterilsin",
  without: "Çıkar: {name}",
  designs: "Tasarım sayısı",
  run: "İncele",
  running: "Tasarlanıyor",
  found:
    "{count} tasarım, {made} yapıldı, {feasible} her denetimi sağlıyor|{count} tasarım, {made} yapıldı, {feasible} her denetimi sağlıyor",
  further: "Aynı inceleme uçbirimde; orada daha büyük olabilir ve durdurulunca sürdürülebilir:",
  asB: "B olarak aç",
  take: "Değerlerini al",
} satisfies Same<typeof en>;
