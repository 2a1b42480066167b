"""The sentences of an electrical plan in Turkish."""

ELECTRIC = {
    "electric.title": "Elektrik planı",
    "electric.lead": "Besleme, akıma göre sigorta ve kablolarıyla motorlar, algılayıcılar, klemensler, güvenlik "
    "devresi",
    "electric.supply": "Besleme",
    "electric.supply-how": "Bütün motorlar anma gücünde. Ana şalter kilitlenebilir ve bütün gerilimli iletkenleri "
    "ayırır; kolu kapının önünde, döşemeden {height} yukarıdadır (IEC 60204-1, 5.3: 0,6–1,9 m).",
    "electric.what": "büyüklük",
    "electric.value": "değer",
    "electric.mains": "şebeke",
    "electric.connected": "bağlı yük",
    "electric.mean": "dokurken ortalama güç",
    "electric.main-fuse": "ana sigortalar",
    "electric.main-wire": "şebeke kablosu",
    "electric.motors": "Motorlar",
    "electric.motors-how": "2 kW'a kadar servoların sürücüleri bir faz ile N'de, daha büyükleri üç fazda; adım "
    "motorlarınınkiler 48 V'ta. Akım sargılarınkidir; her sigorta sürücüsünün çektiğinin 1,25 katını, her kablo "
    "sigortanın anma akımını taşır: PVC yalıtımlı bakır, 40 °C'de B2 yöntemi, IEC 60204-1, 12.4 ve çizelge 6, yan "
    "yana yatan kabloların katsayısıyla.",
    "electric.motor": "motor",
    "electric.designation": "tanım",
    "electric.pieces": "adet",
    "electric.power": "anma gücü",
    "electric.current": "akım [A]",
    "electric.fuse": "sigorta [A]",
    "electric.section": "kesit [mm²]",
    "electric.together": "yan yana kablo",
    "electric.sensors": "Algılayıcılar",
    "electric.device": "aygıt",
    "electric.signals": "sinyaller",
    "electric.terminals": "Sinyaller",
    "electric.terminals-how": "Denetimin adresi olan her sinyali (io.csv): girişi olanlar bir kabloyla gelir, "
    "ötekiler hareket denetleyicisi A1'in programları arasında geçer.",
    "electric.signal": "sinyal",
    "electric.terminal": "klemens",
    "electric.parts": "parçalar",
    "electric.safety": "Güvenlik devresi",
    "electric.safety-how": "{stops} ve {guards}, {relay}: acil durdurmalar {stops} rölesinin, koruyucular {guards} "
    "rölesinin iki kanalını açar; kontakları seridir. Açılan röle hareket denetleyicisini {halt} üzerinden hemen "
    "durdurur, bu da bütün eksenleri frenler (IEC 60204-1'in 1 numaralı durdurma kategorisi), sonra bütün sürücülerin "
    "torkunu keser. Devre {circuit} içinde tepki verir; son eksen, {axis}, {whole} sonra durur.",
    "electric.residual": "Sürücüler kapatıldıktan sonra da tehlikeli gerilim taşır: kapaklar açılmadan 60 V'un altı "
    "ölçülmelidir (IEC 60204-1, 6.2.4).",
    "electric.single-line": "Tek hat şeması: besleme ve motorlar",
    "electric.direct": "{volts} doğru akım",
    "electric.brakes": "Frenler",
    "electric.brakes-how": "Fren, inebilecek olanı tutar; sürücüsü onu torkla birlikte açar, tork kesilince bırakır.",
    "electric.feeds": "Neyi ne besler",
    "electric.consumer": "tüketici",
    "electric.volts": "gerilim [V]",
    "electric.all-power": "hepsinin gücü",
    "electric.fed-by": "besleyen",
    "electric.source": "{sign}, {row}: {rated} anma gücünden {load} yüklü; + ve - baraları en az {bar} mm² bakır.",
    "electric.braking": "48 V baralarındaki frenleme modülü R1, adım motorlarının frenlerken geri verdiğini yakar.",
    "electric.braking-title": "Frenleme",
    "electric.braking-how": "Bir motorun rotoruyla ve sürtünmesiz geri verdiği: sürücüsünün kondansatörleri bunu "
    "sonraki hızlanma için saklar ya da bir direnç ortalama gücünü yakar.",
    "electric.stop-energy": "bir duruşun enerjisi",
    "electric.mean-braking": "ortalama güç",
    "electric.stored": "saklanan",
    "electric.burnt": "direnç",
    "electric.channels": "Modüllerin girişleri",
    "electric.channels-how": "Her modül, hareket denetleyicisi A1'in veri yolundadır. Sinyali olmayan algılayıcıyı "
    "A1, TieStatus ve EndStatus içinde numarasıyla bildirir.",
    "electric.module": "modül",
    "electric.inputs": "girişler",
    "electric.piece": "parçalar, numarayla",
    "electric.connected-at": "bağlandığı yer",
    "electric.cabinet": "Pano",
    "electric.cabinet-how": "{size} mm çelik sac, IP54; içindeki her şeyle {mass}. Aygıtları anma güçlerinde "
    "{heat} ısı verir; duvarlar ve fan bunu odanın {rise} üstünde taşır.",
    "electric.enabling-how": "Ayar konumunda, anahtarı çıkarılabilen mod seçici {mode}, onay anahtarı {sign} "
    "kanallarını yalnız koruyucuların yerine koyar ve bütün sürücülerin tam hız girişlerini keser: güvenli sınırlı "
    "hız (IEC 61800-5-2 SLS, en çok 250 mm/s) yürütülen ekseni izler (IEC 60204-1, 9.2.3.5 ve 9.2.4). Acil "
    "durdurmalar iki modda da etkilidir.",
    "electric.sign": "işaret",
    "electric.amplifier": "sürücü [A]",
    "electric.relay": "emniyet rölesi",
    "electric.reset": "yeniden kurma {sign}",
    "electric.halt": "duruş, hemen",
    "electric.amplifiers": "sürücüler",
    "electric.feedback": "geri bildirim",
    "electric.input": "giriş",
    "electric.phase": "faz",
    "electric.phases": "fazların akımları",
    "electric.strips": "Klemensler",
    "electric.strips-how": "X0: şebekenin L1, L2, L3, N, PE uçları. X1: sinyaller. X2: 24 V ve 0 V. X3: kanalıyla "
    "güvenlik devresi. Her klemens dizisinde bir aygıtın parçaları sırayla durur. Motor, fren ve enkoder kabloları "
    "bütün olarak sürücülerine gider.",
    "electric.strip": "dizi",
    "electric.terminals-of": "klemensler",
    "electric.wires": "uçlar",
    "electric.protected": "24 V kanalları",
    "electric.protected-how": "Koruyucu F24 tüketici gruplarını besler: fren ve selenoid bobinleri, güvenlik devresi, "
    "kafalardaki modüllerle algılayıcılar, panodaki denetim.",
    "electric.channel": "kanal",
    "electric.group": "grup",
    "electric.rating": "anma akımı [A]",
    "electric.coils": "bobinler",
    "electric.safety-group": "güvenlik devresi",
    "electric.sensors-group": "algılayıcılar",
    "electric.control": "denetim",
    "electric.cables": "Kablolar",
    "electric.cables-how": "En uzunun ve hepsinin uzunluğu: panodan aygıta üç eksen boyunca, kafadakinde enerji "
    "zincirinden geçerek, {spare} fazlasıyla ve panonun içinde {inside}. Tel sayıları ve kesitleri IEC 60204-1, "
    "çizelge 5'e göre; S: ekranlı.",
    "electric.from": "nereden",
    "electric.to": "nereye",
    "electric.cable": "kablo",
    "electric.longest": "en uzunu",
    "electric.whole-length": "hepsi",
    "electric.in-series": "hepsi, seri",
}
