"""Nouns of machines in Turkish: titles of parts, bodies, tracks and motions, put together from those they consist of.

    X of the Y, Y's X, y-x     =     y x+suffix          kam mili yatağı: bearing of the cam shaft

The suffix of possession follows the last vowel; k after a vowel becomes ğ, ç becomes c. A noun with a + has it already.
"""

import re
from functools import lru_cache

from ilmek.sentences.checks_turkish import CHECKS, SOURCES

_NOUNS = """
amplifier = yükselteç | brake = fren | braking module = frenleme modül+ü | cabinet = pano | fuse = sigorta
enabling switch for setting up = ayar için onay anahtar+ı | mode selector = mod seçici
mounting plate of the cabinet = pano montaj levha+sı | height of the shed = ağızlık yüksekliğ+i
opener between two warps = iki çözgü arasında açıcı | gripper beside a warp = çözgü yanında kıskaç
profile of the upper cam = üst kam profil+i | profile of the lower cam = alt kam profil+i
upper cam on its bar = çubuğunda üst kam | lower cam on its bar = çubuğunda alt kam
opener on its rods = çubuklarında açıcı | bores of the rods = çubuk delikler+i | teeth of the opener = açıcı dişler+i
cam of the warp = çözgü kam+ı | warp between its guides = kılavuzları arasında çözgü
head on its rail = rayında kafa | gripper in the face = alında kıskaç | bore of the face = alın deliğ+i
gripper in the opener's cross-bar = açıcı köprüsünde kıskaç | bore of the opener's cross-bar = açıcı köprü deliğ+i
relay of the emergency stops = acil durdurma röle+si | relay of the guards = koruyucu röle+si
eye bolt = mapa | fuses of 24 V = 24 V sigortaları+
fan in the door of the cabinet = pano kapağı fan+ı | inputs = girişler | main switch = ana şalter | outputs = çıkışlar
inputs for the yarns of a head = kafa ipliklerinin girişleri+ | steppers = adım motorları | strain = gerinim
plate of an eye bolt on a column = kolondaki mapa levha+sı | lifting eyes = kaldırma mapaları+ | eye-bolt = mapa
plate of an eye bolt on a foot = ayaktaki mapa levha+sı | plate of an arm for its axis = kolun eksen levha+sı
analog inputs = analog girişler | mains = şebeke | protective conductors = koruma iletkenler+i
outlet of the air in the door = kapıdaki hava çıkış+ı
plate of a device on a post = dikmedeki aygıt levha+sı | plate of an interlock on a post = dikmedeki kilit levha+sı
console of a motor at an edge = kenar motoru konsol+u | adapter = adaptör
adapter of a vertical axis = düşey eksen adaptör+ü
right adapter = sağ adaptör | left adapter = sol adaptör | retaining ring = emniyet segmanı+
plate of the rail for a carriage = rayın araba levha+sı
anchor of the cabinet = panonun dübel+i
anchor of the plate of a post of the guards = korkuluk dikmesi levhasının dübel+i
anchor of the plate under the post of the rapier's axis = kancalı eksen dikmesi alt levhasının dübel+i
plate of the post for the rapier's axis = kancalı eksen dikmesinin levha+sı
half of the guide of the followers = izleyici kızağı yarı+sı
actuator = karşılık | angle reducer = açılı redüktör | arm = kol | arm 1 = 1. kol | arm 2 = 2. kol | axes = eksenler
attachment bar = bağlama çubuğ+u | axis = eksen | axle = dingil | back = geri | back rest = arka köprü | bar = çubuk
bar under the heads' guide = kafa kızağı alt lama+sı | bars and rods = çubuk ve miller | beam = kiriş | beat = tefe
beam across = enine kiriş | beam across at the floor = zemindeki enine kiriş | beat-up = tefeleme | beater = tefe
beam across between the front feet = ön ayaklar arası enine kiriş | bearing = yatak | bearings = yataklar
beam along an edge = kenar boyu kiriş+i | bell cranks = dirsekli kollar | belt = kayış | belt axis = kayış eksen+i
block = blok | block under that plate = o levhanın alt blok+u | bracket = konsol
bundle = demet | bush = burç | cam = kam | cam belt = kam kayış+ı | cam shaft = kam mil+i | cams = kamlar
carriage = araba | tubes = tüpler | yarns = iplikler | heads' belt about a pulley = kasnaktaki kafa kayış+ı
carriages = arabalar | carrier = taşıyıcı | centre gripper = orta kıskaç | centre jaws = orta çeneler | creel = cağlık
centre-gripper grasp = orta kıskaç kavrama+sı | centre-gripper motion = orta kıskaç hareket+i | chain = zincir
chains = zincirler | circuit = devre | clamp = bağlantı | close = kapan | cloth = kumaş
pressure ring = baskı bileziğ+i | locknut = kontra somun+u | tab washer = emniyet rondela+sı
collar = bilezik | colours = renkler | column = kolon | comb = tarak | compensator = dengeleyici | control = kumanda
conduits = kılavuz hortumlar | cover = kapak | cross = geç | cross bar = enine çubuk | cross-piece = ara parça
cutter = kesici | cylinder = silindir | devices at an edge = kenar aygıtları+ | door = kapı | doors = kapılar
devices at the edges = kenarlardaki aygıtlar | down = aşağı | draw = çek | drawbar = çekme çubuğ+u | drive = tahrik
driven shaft end = tahrikli mil uc+u | drum = tambur | duct = kanal | eccentric = eksantrik | encoder = kodlayıcı
emergency stop = acil durdurma | end = uc+u | energy chain = enerji zincir+i | energy chains = enerji zincirler+i
even bar = çift çubuk | even stand = çift ayaklık | even warps = çift çözgüler | eye = göz | face = alın
even rods = çift sıra çubuklar+ı | even spring anchors = çift sıra yay ayaklar+ı | guide rod = kılavuz çubuk
even spring ends = çift sıra yay uçlar+ı | odd spring ends = tek sıra yay uçlar+ı | guide sleeve = kılavuz kovan+ı
odd rods = tek sıra çubuklar+ı | odd spring anchors = tek sıra yay ayaklar+ı
finger = parmak | fingers = parmaklar | flag = bayrak | follower = izleyici | followers = izleyiciler | forward = ileri
frame = gövde | freewheel = tek yönlü kavrama | front foot = ön ayak | gripper = kıskaç | guards = koruyucular
guide = kızak | guide cam = kılavuz kam | guide cam beside shims = şimli kılavuz kam | hammer = tokmak | head = kafa
heads = kafalar | hinge = menteşe | home = eve | index = indeks | insert = sok | interlock = kilitleme | jaws = çeneler
key = kama | knife = bıçak | leaf = yaprak | left side gripper = sol yan kıskaç | levelling foot = ayar ayağ+ı
lever = kol | lift = kaldır | light barrier for broken warps = çözgü kopuşu ışık bariyer+i | lintel = üst kiriş
lower = indir | lower cylinder = alt silindir | lower bearings = alt yataklar | lower drive = alt tahrik | lug = kulak
magazine = magazin | motion controller = hareket denetleyici+si | motor = motor | mounting rail = montaj ray+ı
needles at the edges = kenarlardaki iğneler | nut = somun | odd warps = tek çözgüler | open = aç | output = çıkış
open warps = çözgüleri aç | package = bobin | panel = panel | peg = pim | pile handler = hav taşıyıcı+sı
pile yarn = hav ipliğ+i | pin = pim | pinion = pinyon | pivot = mafsal | plate = levha | post = dikme | present = sun
plate across behind the carriages = arabaların arkasındaki enine levha | plate across the head = kafanın enine levha+sı
plate under the post = dikme taban levha+sı | power supply = güç kaynağ+ı | pull back = geri çek | pulley = kasnak
rack = kremayer | rail = ray | rapier = kanca | rapier with its carriage = arabasıyla kanca | rear foot = arka ayak
reducer = redüktör | reset = yeniden kurma düğme+si | retreat = geri çekilme | retreated heads = geri çekilmiş kafalar
return = dön | return spring = geri getirme yay+ı | right side gripper = sağ yan kıskaç | rod = çubuk | rods = çubuklar
roller = makara | saddle = yuva | safety circuit = emniyet devre+si | safety relay = emniyet röle+si | screw = vida
seat = yuva | selector = seçici | selector, cutters and needles = seçici, kesici ve iğneler | sensor = algılayıcı
shaft = mil | shaft end = mil uc+u | shed-encoder = ağızlık kodlayıcı+sı | shedding cam = ağızlık kam+ı | shims = şimler
shedding cams = ağızlık kamlar+ı | side = yan | side carriage = yan araba | side gripper = yan kıskaç
side jaws = yan çeneler | side plate = yan levha | side-gripper grasp = yan kıskaç kavrama+sı | sley = tefe tarağ+ı
side-gripper motion = yan kıskaç hareket+i | slide = sürgü | sliding knife = kayan bıçak | small pulley = küçük kasnak
spacer = ara parça | spacer cylinder = ara silindir | spacer bearings = ara silindir yataklar+ı | spring = yay
spacer drive = ara silindir tahriğ+i | springs = yaylar | stand = ayaklık | step = adım | stop motion = durdurma düzen+i
support = destek | take up = sar | take-up = sarma | half = yarı+sı
sensor of the warps' tension = çözgü gerginliği algılayıcı+sı | terminal = klemens | tie = bağ
to tube = tüpe | toothed plate = dişli levha | trough = oluk | tube = tüp | tuck-in needle = kıvırma iğne+si
turn back = geri dön | turning cam shaft = dönen kam mil+i | turning cutters = dönen kesiciler | wire = tel
turning eccentric = dönen eksantrik | turning pile handler = dönen hav taşıyıcı+sı | turning pinion = dönen pinyon
twisted bar = burgulu çubuk | twisted bars = burgulu çubuklar | two signals = iki sinyal | up = yukarı
upper cylinder = üst silindir | upper bearings = üst yataklar | upper drive = üst tahrik | upright = dikey direk
upper cylinder, back rest and compensator = üst silindir, arka köprü ve dengeleyici | vertical axis = düşey eksen
warp = çözgü | warps = çözgüler | warp opener = çözgü açıcı | weft = atkı | weft cutter = atkı kesici+si
weft selector = atkı seçici+si | withdraw = geri al | yarn = iplik | yarn brake = iplik fren+i | yarn tube = iplik tüp+ü
yarn tubes = iplik tüpler+i | yarns and cables = iplik ve kablolar | rocker = salınım kol+u
tension compensator = gerginlik dengeleyici+si | warp tension = çözgü gerginliğ+i | weaver = dokuma kafa+sı
shedding = ağızlık düzen+i | automated loom = otomatik tezgâh | head-encoder = kafa kodlayıcı+sı | guides = kızaklar
head on its carriage = kafayı arabasına bağlayan | head to its energy chain = kafanın enerji zincir+i | crank = krank
energy chain of a head with its cables = kablolarıyla kafa enerji zincir+i | weft sensor = atkı algılayıcı+sı
face of the head with the tools' guides = kafanın takım kızaklı aln+ı
tie of the guards to a rear foot = koruyucu ile arka ayak bağ+ı
arm of a head to its energy chain = kafanın enerji zincir+i kol+u | axle of such a roller = makara dingil+i
bracket of the head on its carriage = kafanın araba konsol+u | warp stop barrier = çözgü durdurma bariyer+i
yarn duct = iplik kanal+ı | retreat sensor = geri çekilme algılayıcı+sı | tension sensor = gerginlik algılayıcı+sı
beat encoder = tefe kodlayıcı+sı | carrier of the weft = atkı taşıyıcı+sı | coupler = biyel | links = uzuvlar
heddle bar = gücü çubuğ+u | heddles = gücüler | string heddle = ip gücü | shuttle = mekik | bench = oturak
elbow = dirsek
hand shed = el ağızlık düzen+i | driven shaft = tahrikli mil | main shaft = ana mil | bearing plate = yatak levha+sı
belt and pulleys = kayış ve kasnaklar | first links = birinci uzuvlar | second links = ikinci uzuvlar | board = tahta
blade = ağız | needle = iğne | bobbin = masura | box at the left edge = sol kenar kutu+su | box = kutu
shuttles = mekikler
box at the right edge = sağ kenar kutu+su | centre finger = orta parmak | centre rod = orta çubuk
elbow shaft = dirsek mil+i
coupler with holder and gripper = tutuculu ve kıskaçlı biyel | elbow-shaft-* = karşı dirsek mil+i
shed rod = ağızlık çubuğ+u
eye and brake = göz ve fren | foot board = ayak tahta+sı | foot = ayak | frame plate = gövde levha+sı
hand lever = el kol+u
hand wheel = el çark+ı | handle = tutamak | hanger = askı | hub = göbek | left lock = sol kilit
right lock = sağ kilit
left finger = sol parmak | right finger = sağ parmak | left rod = sol çubuk | right rod = sağ çubuk | leg = bacak
lifted bobbin = kaldırılan masura | lifted comb = kaldırılan tarak | lifted knife = kaldırılan bıçak | shelf = raf
lifted scissors = kaldırılan makas | scissors = makas | link 1 = 1. uzuv | link 2 = 2. uzuv | link 1 * = karşı 1. uzuv
link 2 * = karşı 2. uzuv | link-1-* = karşı 1. uzuv | link-2-* = karşı 2. uzuv | machine = makine | magnet = mıknatıs
neck = boyun | solenoid = solenoid | needle bar with its needles = iğneleriyle iğne çubuğ+u | odd bar = tek çubuk
odd stand = tek ayaklık | pin that locks a lever = kol kilitleme pim+i | crank and rocker = krank ve salınım kolu
arms = kollar
pulley on the shaft = mil üstü kasnak | servo = servo | first link = birinci uzuv | second link = ikinci uzuv
tools = takımlar
shaft of a second link, with its pulleys = kasnaklarıyla ikinci uzuv mil+i | sinuous weft = dalgalı atkı | tooth = diş
sleeve of a first link, with its pulley = kasnağıyla birinci uzuv kovan+ı | straight weft = düz atkı | stem = gövde
hand beat = elle tefeleme | knotting dyad = düğüm diyad+ı | knotting four bar = dört çubuklu düğüm mekanizma+sı
function four bar = fonksiyon dört çubuğ+u | motion four bar = hareket dört çubuğ+u
path four bar = yörünge dört çubuğ+u
tufting = tufting düzen+i | shuttle's axis = mekik eksen+i
Assembly drawing = Montaj resm+i | see list = listeye bakın
Exploded along the axes of joints and seats = Mafsal ve yuva eksenleri boyunca açılmış
items as in the list on sheet = kalemler listedeki gibi, sayfa
light grid = ışık perde+si | button = düğme | Automated loom = Otomatik tezgâh | Hand loom = El tezgâh+ı
Beat by hand = Elle tefeleme | Beat-up = Tefeleme | Hammer = Tokmak | Hand shed = El ağızlık düzen+i | Cam = Kam
Knotting head = Düğüm kafa+sı | Knotting dyad = Düğüm diyad+ı | Knotting four-bar = Dört çubuklu düğüm mekanizma+sı
Shedding cams = Ağızlık kamlar+ı | Tension compensator = Gerginlik dengeleyici+si | Weft = Atkı
Tufting needle mechanism = Tufting iğne mekanizma+sı | Warp tension = Çözgü gerginliğ+i
torque arm = moment kol+u | holder = tutucu | left side plate = sol yan levha | right side plate = sağ yan levha
four screws M4 through the door into its handle = dört M4 vida kapıdan kolunun içine
two screws M6 into the threads of the plate = iki M6 vida levhanın dişlerine
its clips snap into its cut-out in the door = tırnakları kapıdaki kesiğine oturur
clamps on the rear shaft end of its motor = motorunun arka mil ucuna sıkılır
its spring plate with screws takes the torque = vidalı yay levhası momenti alır
its set screw clamps it in a slot of the axis = setuskuru onu eksenin kanalında sıkar
two screws M4 through the mesh into its counter plate = iki M4 vida örgüden karşı levhasına
hangs in its holder, which comes with two screws = iki vidayla gelen tutucusunda asılı
its ring nut clamps it in its hole in the door = halka somunu onu kapıdaki deliğinde sıkar
built onto its motor by the maker = üreticisi tarafından motoruna takılı
lies half in its slot, by cable ties at its ends until the first turn of the warps keeps it = \
yarısı oluğunda yatar, çözgünün ilk sarımı onu tutana kadar uçlarında kablo bağıyla
its hinges on the wall of the cabinet, of its maker = pano duvarında, üreticisinin menteşeleriyle
its nuts on the studs of the cabinet's wall = somunları pano duvarının saplamalarında
its end brackets, each with two screws M5, on trough and arm = uç braketleri, ikişer M5 vidayla, oluk ve kol üzerinde
two screws M6 with washers through the slots of its base into the plate of its stand = \
tabanının yarıklarından iki pullu M6 vida ayaklığının levhasına
snaps onto its rail, EN 60715 = rayına geçer, EN 60715
screws M6 through its slots into the threads of the plate, EN 60715 = \
yarıklarından M6 vidalar levhanın dişlerine, EN 60715
its clamps, each with a screw M8, on the posts = kelepçeleri, her biri bir M8 vidayla, dikmelerde
halves of its hinges, welded to its post = menteşe yarıları, dikmesine kaynaklı
its halves welded to the post and to the frame of the door = yarıları dikmeye ve kapının çerçevesine kaynaklı
on the adapter of its slide, with the screws of that = kızağının adaptöründe, onun vidalarıyla
bonded in its pocket = cebine yapıştırılı | bonded in its slot = yarığına yapıştırılı
on the input shaft of its reducer, with the key of that = redüktörünün giriş milinde, onun kamasıyla
its loop lies round the bar = ilmeği çubuğun çevresinde | bonded with epoxy resin = epoksi reçineyle yapıştırılı
its shank in the needle bar, with its latch = sapı iğne çubuğunda, mandalıyla
bonded on the needle bar = iğne çubuğuna yapıştırılı
its shank in the needle bar, with a set screw = sapı iğne çubuğunda, setuskurla
its stub is bonded in the end of the rapier = sapı kancanın ucuna yapıştırılı
its clamp grips the end of the rapier with its own screws = kelepçesi kancanın ucunu kendi vidalarıyla kavrar
locking assembly = sıkma bilezik takım+ı | stepper = adım motor+u | stress = gerilme
latch of a needle = iğne mandal+ı
loopers = lüperler | looper = lüper | knives = bıçaklar | bearing of the loopers = lüper yatağ+ı
arm of the loopers = lüper kol+u | arm of the knives = bıçak kol+u | looper bar = lüper çubuğ+u
bearing plate of the loopers = lüper yatak levha+sı | belt of the loopers = lüper kayış+ı | pin looper = lüper pim+i
crank shaft of the loopers = lüper krank mil+i | pulley of the loopers' belt = lüper kayışı kasnağ+ı
looper shaft = lüper mil+i | looper coupler = lüper biyel+i | looper rocker = lüper salınım kol+u
knife bar = bıçak çubuğ+u | knife shaft = bıçak mil+i | knife coupler = bıçak biyel+i
knife rocker = bıçak salınım kol+u | bed plate = tabla | post of the bed plate = tabla dikme+si
presser = baskı lama+sı | end plate = yan levha | flywheel = volan | push rod = itme çubuğ+u | needle bar = iğne çubuğ+u
tufting needle = tafting iğne+si | spiked roller of the backing = zeminin dikenli silindir+i
spiked roller = dikenli silindir | yarn roller = iplik silindir+i | yarn feed roller = iplik besleme silindir+i
plate of scrolls = iplik makaraları levha+sı | scroll of a needle's yarn = iğne ipliğinin makara+sı
scroll = iplik makara+sı | housing = yatak gövde+si | column between the plates = levhalar arası kolon
coupling of servo and shaft = servo mil kavrama+sı | finger with its pillar = ayaklı parmak
pillar of a servo's plate = servo levhasının ayağ+ı | plate of a hand = el levha+sı
"""

NOUNS = dict(pair.split(" = ") for line in _NOUNS.strip().split("\n") for pair in line.split(" | "))

_PHRASES = SOURCES | CHECKS

_OF = re.compile(r"(.+?) of (?:the |an? |such a )?(.+)")
_ITS = re.compile(r"(.+?)(?:'s|(?<=s)') (.+)")
_SENTENCE = re.compile(r"[a-z]{3,} [a-z]{2,}")
_PARAMETER = re.compile(r"parameters? ([\w.]+)")
_PIECES = re.compile(r"(; |: |\d+ × | \d+$)")
_CAPITALS = str.maketrans("i", "İ")
_VOWELS = {"a": "ı", "ı": "ı", "e": "i", "i": "i", "o": "u", "u": "u", "ö": "ü", "ü": "ü"}


@lru_cache(maxsize=4096)
def named(text: str) -> str:
    """A text with its nouns in Turkish; what is not known stays as it is.

    >>> named("2 × bearing of the cam shaft; 1 × heads' rail"), named("weaver: sley-follower"), named("NEMA 17")
    ('2 × kam mili yatağı; 1 × kafalar rayı', 'dokuma kafası: tefe tarağı izleyicisi', 'NEMA 17')
    >>> named("Beat-up: stress of a leaf")
    'Tefeleme: yaprağın gerilmesi'
    """
    if text in _PHRASES:
        return _PHRASES[text]
    whole = None if "; " in text else _noun(text)
    head, colon, rest = text.partition(": ")
    if whole is None and colon and "; " not in text:
        return f"{named(head)}: {named(rest)}"
    if whole is None:
        whole = "".join(map(_listed, _PIECES.split(text)))
    if whole == text and text[:1].isupper():
        lowered = text[0].lower() + text[1:]
        whole = named(lowered)
        return text if whole == lowered else whole[0].translate(_CAPITALS).upper() + whole[1:]
    return whole.replace("+", "")


def _listed(text: str) -> str:
    pieces = text.split(", ")
    known = [_piece(piece) for piece in pieces]
    unknown = any(new is None and _SENTENCE.search(piece) for new, piece in zip(known, pieces, strict=True))
    if unknown and any(piece in _PHRASES for piece in pieces):  # a source is not said in two languages
        return _piece(text) or text
    return _piece(text) or ", ".join(new or piece for new, piece in zip(known, pieces, strict=True))


def _piece(text: str) -> str | None:
    parameter = _PARAMETER.fullmatch(text)
    known = f"parametre {parameter[1]}" if parameter else _PHRASES.get(text) or _noun(text)
    first, both, second = text.partition(" and ")
    if known is None and both:
        pair = _noun(first), _noun(second)
        return f"{pair[0]} ile {pair[1]}" if all(pair) else None
    return known


@lru_cache(maxsize=4096)
def _noun(text: str) -> str | None:
    """A noun with its mark; None where it is not known."""
    if text in NOUNS:
        return NOUNS[text]
    plain = text.replace("-", " ")
    if plain in NOUNS:
        return NOUNS[plain]
    parts = _OF.fullmatch(text)
    pairs = [(parts[1], parts[2])] if parts else []
    owned = _ITS.fullmatch(text)
    pairs += [(owned[2], owned[1])] if owned else []
    whole, dash, last = text.rpartition("-")
    pairs += [(last, whole), (last, " ".join(whole.rsplit("-", 1)))] if dash else []
    known = ((_noun(thing), _noun(owner)) for thing, owner in pairs)
    return next((f"{owner.replace('+', '')} {_possessed(thing)}" for thing, owner in known if thing and owner), None)


def _possessed(noun: str) -> str:
    """A noun with the suffix of possession.

    >>> [_possessed(noun) for noun in ("motor", "levha", "kasnak", "kıskaç", "yay", "kam mil+i")]
    ['motor+u', 'levhas+ı', 'kasnağ+ı', 'kıskac+ı', 'yay+ı', 'kam mil+i']
    """
    if "+" in noun:
        return noun
    end = noun[-1]
    vowel = next(_VOWELS[letter] for letter in reversed(noun.lower()) if letter in _VOWELS)
    if end in _VOWELS:
        return f"{noun}s+{vowel}"
    soft = {"k": "ğ", "ç": "c"}.get(end, end) if len(re.findall("[aıeioöuü]", noun)) > 1 else end
    return f"{noun[:-1]}{soft}+{vowel}"
