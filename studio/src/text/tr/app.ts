import type { Same } from "../catalogue";
import type en from "../en/app";

export default {
  name: "ilmek stüdyosu",
  skip: "İçeriğe geç",
  views: "Görünümler",
  carpet: "Halı",
  machine: "Makine",
  linkage: "Mekanizma",
  synthesis: "Sentez",
  cyclogram: "Çevrim",
  loom: "Tezgâh",
  files: "Dosyalar",
  carpetHint: "Resimden düğüm desenine ve ipliğe",
  machineHint: "Katalogdaki her makineyi tasarla",
  linkageHint: "Mekanizma çiz ve sürükle",
  synthesisHint: "Noktalardan, konumlardan, fonksiyonlardan mekanizma",
  cyclogramHint: "Ana açıya göre hareketler",
  loomHint: "Üç boyutlu tezgâh ve çalışması",
  filesHint: "Proje ve bütün çıktılar",
  carpetHelp:
    "Sayfaya bir resim bırakın: listedeki ipliklerle düğüm desenine dönüşür. Boyutu ve kaliteyi verin, iplikleri değiştirin, tek tek ilmekleri çizin. Soldaki sekmelerde resim, iplikler, halının gereksinimi ve maliyeti bulunur.",
  machineHelp:
    "Katalogdan bir makine seçip parametrelerini değiştirin: çizim, eğriler ve denetimler izler. Sağlanmayan denetim kırmızı olur ve ne kadar aştığını bildirir. Karşılaştırmak için bir durumu B olarak tutun.",
  linkageHelp:
    "Bir araç seçip uzuvları, mafsalları, kızakları ve tahrikleri çizin; bir mafsalı sürükleyin, bütün yörüngeler, bağlama açısı ve ölü konumlar izler. Mekanizma hareket edene kadar panel eksik olanı bildirir.",
  synthesisHelp:
    "Bir dört çubuk mekanizmasının izleyeceği noktaları, konumları ya da fonksiyonu tıklayın. Adaylar yanda, en iyisi önde durur; elenenlerin nedenleri de yazar. Tek tıklama adayı mekanizma düzenleyicisine taşır.",
  cyclogramHelp:
    "Her hat, ana mil açısına göre bir harekettir. Başlangıçları, bitişleri ve düzeyleri sürükleyin; sağlanmayan bağıntılar kırmızı olur. Düğmeler en küçük ivmeyi ya da en kısa turu bulur.",
  loomHelp:
    "Halının tezgâhı, gerçek parçalarıyla. Fareyle ya da parmakla döndürün, bir sırayı oynatın, kesitini alın, sayıları için bir parçaya tıklayın ve halıyı dijital ikizle dokuyun.",
  filesHelp:
    "Projenin bütün dosyaları, komut satırının okuduğu biçimde. Desenleri, çizimleri, çizelgeleri ve programları out/ klasörüne yazın, açın ya da indirin.",
  help: "Yardım ve tuşlar",
  keysHere: "Bu görünümün tuşları",
  keysEverywhere: "Her yerde geçerli tuşlar",
  keysSlider: "Kaydırıcıda ok tuşları bir adım, Page Up ve Page Down on adım oynatır; Home ve End uçlara götürür.",
  keysMotion:
    "Bir hareketin üzerinde, başlangıcında ya da bitişinde ok tuşları onu bir derece, Shift ile on derece taşır.",
  keysFiles: "Sekme tuşu dosyalar ve düğmeler arasında gezer; Enter ya da boşluk seçer.",
  keyUndo: "bu görünümün dosyasında geri al",
  keyRedo: "yinele",
  keySave: "hemen kaydet; stüdyo kendiliğinden de kaydeder",
  keyNext: "sonraki öğeye; Shift ile öncekine",
  keyEscape: "aracı ya da iletişim kutusunu kapatır",
  keyHelp: "bu yardım",
  settings: "Ayarlar",
  theme: "Tema",
  themeAuto: "Sistemdeki gibi",
  themeLight: "Açık",
  themeDark: "Koyu",
  language: "Dil",
  connecting: "Bağlanıyor",
  connected: "Bağlı",
  lost: "Sunucuya ulaşılamıyor",
  lostHelp:
    "Stüdyonun sunucusu yanıt vermiyor. Düzenlemeleriniz burada saklanıyor ve sayfa kendiliğinden yeniden bağlanır. Böyle kalırsa sunucuyu yeniden başlatın: ilmek studio",
  back: "Sunucu geri geldi. Düzenlemeler yeniden kaydediliyor.",
  loading: "Yükleniyor",
  loadFailed: "Bu görünüm yüklenemedi",
  loadFailedHelp:
    "Stüdyonun bir dosyası gelmedi. Projeden hiçbir şey kaybolmadı. Yeniden deneyin; stüdyo güncellendiyse sayfayı yenileyin.",
  tryAgain: "Yeniden dene",
  reload: "Sayfayı yenile",
  broken: "Bu görünüm bir hata yüzünden durdu",
  brokenHelp: "Proje önceki hâliyle kayıtlı. Yeniden deneyin ya da başka bir görünüme geçin. Tarayıcının bildirdiği:",
  dismiss: "Kapat",
  messages: "İletiler",
  hours: "sa",
  minutes: "dk",
} satisfies Same<typeof en>;
