"""Names of checks, and pieces of the sources of their limits, in Turkish by the English ones."""

_CHECKS = """
parts without files = dosyası olmayan parçalar | width = en
programme: compiled for this loom = program: bu tezgâh için derlendi
programme: the loom has a control = program: tezgâhın kumandası var | carpet: programme = halı: program
the loom can be designed = tezgâh tasarlanabilir | weaving time = dokuma süresi
knots of the carpet = halının düğümleri | time of the heads beside the run's = çalışmanınkine göre kafaların süresi
time without faults beside the programme's = programınkine göre arızasız süre
the seed alone beside it among the runs = çalışmalar içindekine göre tek başına tohum
pile yarn left on a package = bobinde kalan hav ipliği | every knot on two warps = her düğüm iki çözgüde
carpet: colours = halı: renkler | loom: as in its file = tezgâh: dosyasındaki gibi
carpet: knots across beside those of the loom = halı: tezgâhınkilere göre enine düğümler
carpet: warps = halı: çözgüler | carpet: knot = halı: düğüm | carpet: length on the loom = halı: tezgâhtaki boy
carpet: distance of the rows that the beat leaves = halı: vuruşun bıraktığı sıra aralığı
carpet: take-up of a row = halı: bir sıranın sarımı | carpet: diameter of a warp = halı: çözgü çapı
carpet: stiffness of a warp = halı: çözgü rijitliği | carpet: strength of a warp = halı: çözgü dayanımı
carpet: thickness of the pile in a gripper = halı: kıskaçtaki havın kalınlığı
carpet: pile yarn of a knot = halı: bir düğümün hav ipliği | record as it was written = yazıldığı gibi kayıt
closes over its range = aralığında kapanır | dead centres in its range = aralığındaki ölü noktalar
yield of the tolerances of least cost = en ucuz toleransların verimi | designs that hold = tutan tasarımlar
joints that move without a fit = geçmesi olmadan hareket eden mafsallar
change of a cam's error from one degree to the next, allowed by its follower = \
izleyicisinin izin verdiği, bir dereceden ötekine kam hatası değişimi
links too short for their pins = pimleri için fazla kısa uzuvlar
equilibrium of the links' loads = uzuv yüklerinin dengesi
diameter of the pins, over the width of their links = pimlerin çapının uzuvların genişliğine oranı
assembly: parts that cannot reach their seats = montaj: yerine ulaşamayan parçalar
assembly: parts without a fastening = montaj: bağlantısı olmayan parçalar
assembly: welds that burn through a wall = montaj: cidarı delen kaynaklar
beat: force of a warp = tefe: bir çözgünün kuvveti | beat: stroke = tefe: strok
distance of the rows that the blows leave = vuruşların bıraktığı sıra aralığı
blow: force of a warp = vuruş: bir çözgünün kuvveti | mass of the comb = tarağın kütlesi
leaf between two warps = iki çözgü arasında yaprak | stress of a leaf = yaprağın gerilmesi
stress of the shelf = rafın gerilmesi | coverage of each region = her bölgenin kaplanması
coverage of the carpet = halının kaplanması | rows beyond the border = kenarın dışındaki sıralar
detail finer than the gun = tabancadan ince ayrıntı | colours without a row = sırası olmayan renkler
colours on the creel = cağlıktaki renkler | width on the gantry = portaldaki en | length on the gantry = portaldaki boy
tufting time = tufting süresi | bending of a pin of the springs = yay piminin eğilmesi
stress of a cross-piece of the rods = çubukların ara parçasının gerilmesi
stress of the weld of a saddle = yuva kaynağının gerilmesi | bending of the pin of a roller = makara piminin eğilmesi
deflection of a bar = çubuğun sehimi | stress of a bar = çubuğun gerilmesi | stress of a lever = kolun gerilmesi
bore of a lever over its height = kol deliğinin yüksekliğine oranı | shear of a pivot pin = mafsal piminin kesilmesi
bending of a pivot pin = mafsal piminin eğilmesi | pressure of a pivot pin = mafsal piminin basıncı
deflection of the levers' beam = kollar kirişinin sehimi | stress of the levers' beam = kollar kirişinin gerilmesi
length of a spring's guide rod in its sleeve = yay kılavuz çubuğunun kovanındaki boyu
stress of a spring over that allowed = yay gerilmesinin izin verilene oranı | fatigue of a spring = yayın yorulması
length of a spring at rest = yayın durgun boyu | outer diameter of a spring = yayın dış çapı
springs of the table = çizelgedeki yaylar | equilibrium over the turn = bir turda denge
deflection of the strands in the open shed = açık ağızlıkta çözgü kollarının sehimi
room between lever and rod = kol ile çubuk arasındaki yer
springs with the strength required that do not buckle = gereken dayanımda, burkulmayan yaylar
tension in the open shed = açık ağızlıkta gerginlik | least tension of a warp = bir çözgünün en az gerginliği
efficiency, to lock itself = kendini kilitlemek için verim | motor torque = motor torku
slope in the bearings = yataklardaki eğim | deflection = sehim | bending stress = eğilme gerilmesi
torque of a hand wheel = el çarkının torku | slope of the spacer = ara silindirin eğimi
deflection of the spacer = ara silindirin sehimi | warps beside each other = yan yana çözgüler
warp in its slot = yarığında çözgü | land between slots = yarıklar arasındaki dolu kısım
metal under the slots = yarıkların altındaki metal | tension with the shed open = ağızlık açıkken gerginlik
tension at the beat = vuruşta gerginlik | power of the motor = motorun gücü | motor speed = motor hızı
static safety = statik emniyet | slope of the bearing = yatağın eğimi | shaft end = mil ucu
fatigue of the shaft end = mil ucunun yorulması | pressure of the attachment bar = bağlama çubuğunun basıncı
safety of a cylinder under its slot = yarığının altında silindirin emniyeti | force of a string = bir ipin kuvveti
shear of a lock's pin = kilit piminin kesilmesi | opening, the rod pulled down = çubuk aşağı çekilmişken ağız
opening, the strings pulled = ipler çekilmişken ağız | force of a hand on its lever = elin koluna kuvveti
force of a hand on the rod = elin çubuğa kuvveti | rod stays up = çubuk yukarıda kalır
sag of the rod = çubuğun sarkması | sag of the heddle bar = gücü çubuğunun sarkması
stress of the heddle bar = gücü çubuğunun gerilmesi | stress of the rod = çubuğun gerilmesi
tension of a pulled warp = çekilen çözgünün gerginliği | stroke over twice the arm = strokun kolun iki katına oranı
heddle bar before the warps = çözgülerin önünde gücü çubuğu
stress of the cranks' shaft at its drive = krank milinin tahrikindeki gerilmesi
fatigue of the cranks' shaft at its shoulder = krank milinin faturasındaki yorulması
speed that the motor reaches = motorun ulaştığı hız | power balance of the forces = kuvvetlerin güç dengesi
energy balance of the runs = çalışmaların enerji dengesi | transmission angle, to run at all = hareket için iletim açısı
transmission angle, to run well = iyi hareket için iletim açısı | crank/coupler ratio = krank/biyel oranı
Grashof margin, in ground links = sabit uzuv cinsinden Grashof payı | force on the beater = tefeye gelen kuvvet
fluctuation of the speed = hız dalgalanması | the motor runs the linkage = motor mekanizmayı döndürür
the run at speed is complete = tam hızdaki çalışma tamamlandı
force of a stroke for a warp = bir vuruşun çözgü başına kuvveti
beater out of the warps, at its farthest = en uzağında çözgülerin dışında tefe
a motor moves the slide = bir motor sürgüyü hareket ettirir
clearance: plate of the crank-rocker and heads that retreat = \
boşluk: krank-salınım kolu levhası ile geri çekilen kafalar
mass of the beater, that of its teeth at least = tefenin kütlesi, en az dişlerininki
inertia of the beater about its pivot, off that of its mass at the striking edge = \
tefenin mafsalı çevresindeki ataletinin, vuran kenardaki kütlesininkinden farkı
deflection of the beat's beam = tefe kirişinin sehimi | stress of the beat's beam = tefe kirişinin gerilmesi
a motor starts and stops the crank = bir motor krankı başlatır ve durdurur | torque of the clutch = kavramanın torku
length of the flywheel = volanın boyu | time of a beat = bir vuruşun süresi
bodies without a layer in which they meet nothing = hiçbir şeye değmediği katmanı olmayan cisimler
couplings without parts = parçası olmayan kavramalar | spring of the jaws = çenelerin yayı
solenoid of the jaws over their spring = çene solenoidinin yayına oranı
heat of a solenoid of the jaws = çene solenoidinin ısısı | stress of a finger = parmağın gerilmesi
finger's pin from the elbow = parmak piminin dirseğe uzaklığı
greatest use of a drive's limit = bir tahrik sınırının en büyük kullanımı
closure of every arm at the points, of its size = noktalarda her kolun kapanması, boyuna göre
arm and centre gripper apart at the hand-over = teslimde kol ile orta kıskaç ayrı
power balance of the torques = torkların güç dengesi | real arms of two links = iki uzuvlu gerçek kollar
longest link of the arm to build = yapılacak kolun en uzun uzvu | the required knot is tied = istenen düğüm bağlanır
clearance over the whole cycle = bütün çevrimde boşluk
room of the motors between the pivots = mafsallar arasında motorların yeri
needle bent aside by the yarn = ipliğin yana büktüğü iğne | gap between two warps = iki çözgü arasındaki aralık
servos of the joints = mafsalların servoları | pull of a belt of the arms = kollardaki kayışın çekmesi
stroke of the needle = iğnenin stroku
needle's height at entry against exit = iğnenin girişteki yüksekliği, çıkışa karşı
transmission angle of rocker = salınım kolunun iletim açısı | pressure angle of the rod = çubuğun basınç açısı
work of drive against friction, over a turn = bir turda sürtünmeye karşı tahrik işi
needle lowest between entry and exit = giriş ile çıkış arasında en aşağıda iğne
a servo turns the main shaft = bir servo ana mili döndürür
stress of a beam of the hand shed = el ağızlık düzeni kirişinin gerilmesi
loom stands: weight over the hands' pull = tezgâh durur: ağırlığın ellerin çekmesine oranı
shed rod, pushed up, over the floor = yukarı itilmiş ağızlık çubuğunun yerden yüksekliği
load of a levelling foot = ayar ayağının yükü | parts through each other = iç içe geçen parçalar
groups of parts that touch = birbirine değen parça grupları
weavers: room under their arms = dokuyucular: kollarının altındaki yer
what beats before the front warps = ön çözgülerin önünde vuran parça
shed over what beats = vuran parçanın üstündeki ağızlık
what beats over the hands that tie = düğüm bağlayan ellerin üstünde vuran parça
deviation of the shafts' shed lines = millerin ağızlık çizgilerinin sapması | buckling of a cam = kamın burkulması
thickness of a cam = kamın kalınlığı
cam, guides and passing warps on a pitch of the shaft = mil adımında kam, kılavuzlar ve geçen çözgüler
lateral play of a warp = çözgünün yan boşluğu | prime radius round the bore = delik çevresindeki asal yarıçap
life of the bearings = yatakların ömrü | bore of the bearing for the torque = tork için yatak deliği
fatigue of the driven journal at its shoulder = tahrikli muylunun faturasındaki yorulması
static load of the bearings = yatakların statik yükü | bore of the bearing in the bar = çubuktaki yatağın deliği
deflection of the reed across the warps = tarağın çözgülere dik sehimi | sag of the reed = tarağın sarkması
cam stack, worst case = kam dizisi, en kötü durum | cam stack, statistical = kam dizisi, istatistiksel
groove against warp = çözgüye karşı oluk | pressure angle = basınç açısı | shed for the shuttle = mekik için ağızlık
one parity down while the other is up = biri aşağıdayken öteki yukarıda
width of the cams on the shaft = mildeki kamların genişliği | slope of the shaft = milin eğimi
deflection of the shaft = milin sehimi | twist of the shaft = milin burulması | stress of the shaft = milin gerilmesi
fatigue of the shaft = milin yorulması | speed of the shaft = milin hızı
stress of the driven journal = tahrikli muylunun gerilmesi | nut of the cams over the journal = muylu üstünde kam somunu
torque of a cam on its clamped sheets = sıkılmış sacları üzerinde kamın torku
tension of a lifted warp = kaldırılan çözgünün gerginliği | stress at the nose = burundaki gerilme
step of the shuttle's guideway on the tips = mekik yolunun uçlardaki basamağı
window of the shuttle = mekiğin penceresi
strain of a lifted warp = kaldırılan çözgünün gerinimi | force on a roller of a steady = destek makarasına gelen kuvvet
frame: against tipping over its feet = gövde: ayakları üzerinden devrilmeye karşı
weaving time, estimated = dokuma süresi, kestirim
distance of the rows that the beat leaves = vuruşun bıraktığı sıra aralığı
heads that share a row = bir sırayı paylaşan kafalar | distance of two heads = iki kafanın uzaklığı
speed of the shedding cams = ağızlık kamlarının hızı | heads: speed of the retreat = kafalar: geri çekilme hızı
heads: acceleration of the retreat = kafalar: geri çekilme ivmesi | price of the loom = tezgâhın fiyatı
bow of the beam behind the cams = kamların arkasındaki kirişin eğilmesi
stress of a steady's post = destek dikmesinin gerilmesi | deflection of a steady's post = destek dikmesinin sehimi
motors with power = gücü olan motorlar | degrees of freedom = serbestlik dereceleri
axes that motors drive = motorların sürdüğü eksenler | frame: stress of a column = gövde: kolonun gerilmesi
frame: bow of a column = gövde: kolonun eğilmesi | frame: against buckling = gövde: burkulmaya karşı
frame: sag of the heads' rail = gövde: kafalar rayının sarkması
frame: heads' rail bends: natural frequency = gövde: kafalar rayı eğilir: doğal frekans
frame: room of a column = gövde: kolonun yeri | frame: sag of the back rest = gövde: arka köprünün sarkması
frame: stress of the back rest's beam = gövde: arka köprü kirişinin gerilmesi
stress of a post of the beat = tefe dikmesinin gerilmesi | deflection of a post of the beat = tefe dikmesinin sehimi
deflection behind the shuttle's bar = mekik çubuğunun arkasındaki sehim
stress of an arm of the tube = tüp kolunun gerilmesi | deflection of an arm of the tube = tüp kolunun sehimi
posts of the beat against buckling = burkulmaya karşı tefe dikmeleri
clearance: brackets of the cam shafts and axis of the rapier = boşluk: kam mili konsolları ile kanca ekseni
deflection of the arms of the rapier's side = kanca tarafındaki kolların sehimi
post of the rapier's axis against buckling = burkulmaya karşı kanca ekseninin dikmesi
bodies without a joint = mafsalı olmayan cisimler | parts with an open mesh = ağı kapalı olmayan parçalar
yarn path: pull at the eye = iplik yolu: gözdeki çekme | yarn path: force of the brakes = iplik yolu: frenlerin kuvveti
yarn path: tension of the yarn = iplik yolu: ipliğin gerginliği
energy chain: width of its lines = enerji zinciri: hatlarının genişliği
energy chain: bend radius = enerji zinciri: büküm yarıçapı | energy chain: travel = enerji zinciri: yol
energy chain: loop past its share = enerji zinciri: payını aşan ilmek | guards: height = koruyucular: yükseklik
weavers: reach to the fell = dokuyucular: dokuma çizgisine uzanma | bench: deflection of a beam = oturak: kirişin sehimi
sensors without room = yeri olmayan algılayıcılar
warp tension: strain of the back rest's beam = çözgü gerginliği: arka köprü kirişinin gerinimi
guards: distance of the buttons that weavers hold = koruyucular: dokuyucuların bastığı düğmelerin uzaklığı
control: length of its mounting rails = kumanda: montaj raylarının boyu
control: heat in its cabinet = kumanda: panosundaki ısı
mean braking power of the steppers, by their module = modüllerine göre adım motorlarının ortalama frenleme gücü
braking energy of a motor, over what its amplifier takes = bir motorun frenleme enerjisinin yükseltecinin aldığına oranı
distance from the poses = konumlara uzaklık | crank's distance from its dead point = krankın ölü noktasına uzaklığı
transmission angle = iletim açısı
hand at the poses, missed, of their extent = konumlarda elin hatası, yayılımlarına göre
coupler at the poses, missed = konumlarda biyelin hatası | clearance of the two sides = iki yanın boşluğu
torque of both sides coupled, against each alone = bağlı iki yanın torku, tek tek olana karşı
power balance of both sides = iki yanın güç dengesi | a servo turns the crank = bir servo krankı döndürür
bending of the gears' teeth = dişli dişlerinin eğilmesi | knots tied, proved = bağlanan düğümler, kanıtlandı
fingers clear of the warps, over the whole stroke = bütün strokta çözgülerden açık parmaklar
fingers of both hands apart = iki elin parmakları ayrı
finger bent aside in the gap by the yarn = aralıkta ipliğin yana büktüğü parmak
gap spread by finger and pressed yarn together = parmak ile basılı ipliğin birlikte açtığı aralık
transmission angle of a hand = bir elin iletim açısı | swing of a hand's crank = bir elin krankının salınımı
length of both hands = iki elin boyu | height of the hands = ellerin yüksekliği
a servo swings a hand = bir servo eli sallar
power balance of a hand = bir elin güç dengesi | hands within all limits = bütün sınırlar içindeki eller
opening of the shed for the carrier = taşıyıcı için ağızlık açıklığı | speed of the passage = geçişin hızı
acceleration of the passage = geçişin ivmesi | belt of the axis = eksenin kayışı
torque of the axis' servo = eksen servosunun torku
outermost warps that a turn releases = bir dönüşün bıraktığı en dış çözgüler
force on the shuttle's magnets = mekik mıknatıslarına gelen kuvvet
rows between two changes of a bobbin = iki masura değişimi arasındaki sıralar
lifted warps under the shuttle = mekiğin altındaki kaldırılmış çözgüler
gap that the shuttle bridges at the edge = mekiğin kenarda aştığı aralık | sag of the rapier = kancanın sarkması
safety of the rapier against buckling = kancanın burkulmaya karşı emniyeti
pull of the weft in the gripper = kıskaçta atkının çekmesi
warps that bind a tucked end = kıvrılan ucu bağlayan çözgüler
life of the head's guide = kafa kızağının ömrü | static safety of the head's guide = kafa kızağının statik emniyeti
tubes on the head = kafadaki tüpler | opener: bend of its teeth = açıcı: dişlerinin eğilmesi
stress of the head's bracket = kafa konsolunun gerilmesi | sag of the head at its tools = takımlarında kafanın sarkması
opener: points between two warps = açıcı: iki çözgü arasındaki uçlar
opener: tension of a displaced warp = açıcı: itilen çözgünün gerginliği
opener: wedge against friction = açıcı: sürtünmeye karşı kama | tiers of the tubes = tüplerin katları
position of a tube = bir tüpün konumu | arms on the head = kafadaki kollar | yarn drawn = çekilen iplik
tension of the heads' belt = kafa kayışının gerginliği | motor of the carriage = arabanın motoru
pull of the heads' belt = kafa kayışının çekmesi | lag of a head on its belt = kayışında kafanın gecikmesi
torque of the cutter's motor, over what the cut takes = kesici motorunun torkunun kesimin aldığına oranı
Hertz pressure of the cutter's eccentric = kesici eksantriğinin Hertz basıncı
lip of a side plate behind its bearing = yatağının arkasında yan levhanın dudağı | return springs = geri getirme yayları
pull of the cam shaft's belt = kam mili kayışının çekmesi | cams beside each other = yan yana kamlar
carriage: step to the next knot = araba: sonraki düğüme adım | knot cycle = düğüm çevrimi
knot cycle, as required = istendiği gibi düğüm çevrimi
bend of a side gripper by the yarn = ipliğin yan kıskacı eğmesi
stress of a side gripper's rod = yan kıskaç çubuğunun gerilmesi
yarn needed between the grippers = kıskaçlar arasında gereken iplik | room of the side grippers = yan kıskaçların yeri
cutter = kesici | motor of the cam shaft = kam milinin motoru | bearings of the cam shaft = kam milinin yatakları
jump of the velocity = hızın sıçraması | jump of the acceleration = ivmenin sıçraması
pressure angle on the rise = yükselmede basınç açısı | pressure angle on the fall = inişte basınç açısı
convex radius of curvature (no undercut) = dışbükey eğrilik yarıçapı (alttan kesme yok)
concave radius of the pitch curve = adım eğrisinin içbükey yarıçapı | speed of lift-off = ayrılma hızı
wall between keyway and surface = kama yuvası ile yüzey arasındaki cidar | Hertz pressure = Hertz basıncı
force on the roller = makaraya gelen kuvvet | life of the roller = makaranın ömrü
radius of the cutter = kesicinin yarıçapı | a roller of the table fits the cam = çizelgeden bir makara kama uyar
force of the compliant follower on the cam = esnek izleyicinin kama kuvveti
force of the crank-rockers = krank-salınım kollarının kuvveti | distance of the rows = sıraların aralığı
force before the cloth is slack = kumaş gevşemeden önceki kuvvet | uniformity across the width = en boyunca düzgünlük
stress of the comb = tarağın gerilmesi | stroke of the comb's axis = tarak ekseninin stroku
torque of the servo over the required torque = servo torkunun gereken torka oranı
buckling of the screws = vidaların burkulması | static load of the screws = vidaların statik yükü
critical speed of the screws = vidaların kritik hızı | speed value of the screws = vidaların hız değeri
life of the screws = vidaların ömrü | stress of the comb by its inertia = ataletiyle tarağın gerilmesi
end of the rocker in front of the comb's bar = tarak çubuğunun önünde salınım kolunun ucu
guide cams that carry the leaves = yaprakları taşıyan kılavuz kamlar
cam shafts that go down with the comb = tarakla inen kam milleri
clearance: guide cams that sink and carriage of the shuttle = boşluk: inen kılavuz kamlar ile mekik arabası
power balance of the looper's forces = lüper kuvvetlerinin güç dengesi
hook's path by its linkage and by its synthesis = mekanizmasıyla ve senteziyle kancanın yörüngesi
life of the loopers' bearings = lüper yataklarının ömrü
needle drive with its bearing plates along the shafts = miller boyunca yatak levhalarıyla iğne tahriği
needles out of their bar = çubuğundan çıkan iğneler | deflection of the needle bar = iğne çubuğunun sehimi
stress of the needle bar = iğne çubuğunun gerilmesi
knife past the hook's under edge, below its upper one = bıçak kancanın alt kenarının üstünde, üst kenarının altında
hook leaves after the needle is out of the backing = kanca, iğne zeminden çıktıktan sonra ayrılır
hook leaves before the needle comes down to it = kanca, iğne ona inmeden önce ayrılır
lowest natural frequency of the links, over the looper crank's = uzuvların doğal frekansının lüper krankınınkine oranı
latches move while their notches meet them = çentikleri karşıdayken mandallar hareket eder
latches over each other on the needle bar = iğne çubuğunda üst üste mandallar | shear of a latch = mandalın kesilmesi
knife under the next loop = sıradaki ilmeğin altında bıçak
knife beside the hook's beak the whole turn = bütün dönüşte kanca gagasının yanında bıçak
needle, hook and knife beside each other = yan yana iğne, kanca ve bıçak
transmission angle of the knives' rocker = bıçak salınım kolunun iletim açısı
power balance of the knife's forces = bıçak kuvvetlerinin güç dengesi
transmission angle of the looper's rocker = lüper salınım kolunun iletim açısı
twist of a needle against its looper = lüperine karşı iğnenin dönmesi
torsional frequency over that of the shaft = burulma frekansının milinkine oranı
critical speed over the speed = kritik hızın hıza oranı | a servo turns the shafts = bir servo milleri döndürür
each yarn is fed as its loops need = her iplik ilmeklerinin gerektirdiği gibi beslenir
travel of the backing while needles are in it = iğneler içindeyken zeminin yolu
acceleration of the needle bar in its shift = kaymasında iğne çubuğunun ivmesi
a motor turns each yarn feed roller or scroll = bir motor her iplik besleme silindirini döndürür
a servo turns the spiked rollers = bir servo dikenli silindirleri döndürür
tufts off their colour = rengi şaşan tutamlar | pile off its height = yüksekliği şaşan hav
pile over the hidden loops = gizli ilmeklerin üstündeki hav
loop formed: hook and loop are linked until the needle is out = ilmek oluştu: iğne çıkana dek kanca ile ilmek bağlı
hook enters after the loop has opened = kanca ilmek açıldıktan sonra girer
hook enters before the loop closes = kanca ilmek kapanmadan girer
needle, hook and yarn beside each other = yan yana iğne, kanca ve iplik | not self-locking = kendini kilitlemez
servo: rms torque = servo: etkin tork | servo: reserve of peak torque = servo: tepe torku yedeği
servo: speed = servo: hız | servo: inertia ratio = servo: atalet oranı
forward run: time reached = ileri çözüm: ulaşılan süre | four-bars without defects = kusursuz dört çubuklar
stress of the crank = krankın gerilmesi | stress of the coupler = biyelin gerilmesi
stress of the rocker = salınım kolunun gerilmesi | safety of the links against fatigue = uzuvların yorulma emniyeti
safety of the links in buckling = uzuvların burkulma emniyeti
lowest natural frequency of the links, over the crank's = uzuvların en düşük doğal frekansının krankınkine oranı
shear of the pins = pimlerin kesilmesi | bending of the pins = pimlerin eğilmesi
pressure of the pins = pimlerin basıncı
wear of the pins, p v = pimlerin aşınması, p v
distance of the pins of a link, over their diameter = bir uzvun pim aralığının pim çapına oranı
stress of the beater's plate = tefe levhasının gerilmesi | time of a step of the slide = sürgünün bir adımının süresi
torque of the reducer of a cylinder = silindir redüktörünün torku
fatigue of the shaft end of the upper cylinder at its shoulder = üst silindir mil ucunun faturasındaki yorulması
weld of the shaft end of the spacer cylinder = ara silindir mil ucunun kaynağı
tension of a motor's step = bir motor adımının gerginliği
room of the shuttle beside the cloth = kumaşın yanında mekiğin yeri
tension of the straight weft = düz atkının gerginliği | tension of the sinuous weft = dalgalı atkının gerginliği
convex radius of the pitch curve (no undercut) = adım eğrisinin dışbükey yarıçapı (alttan kesme yok)
thickness of a guide cam = kılavuz kamın kalınlığı
torque of the reducer of the cam shaft = kam mili redüktörünün torku
angle between its links, off straight, along the path = yol boyunca uzuvlarının doğrudan sapan açısı
needle against buckling under the yarn's pull = ipliğin çekmesi altında iğnenin burkulmaya karşı durumu
pile yarn in the gap between the warps = çözgüler arasındaki aralıkta hav ipliği
needle and pile yarn together, beside the pair = çiftin yanında iğne ile hav ipliği birlikte
needle and pile yarn together, between the pair = çiftin arasında iğne ile hav ipliği birlikte
opening of the jaws = çenelerin açılması | closing of the jaws = çenelerin kapanması
stress of link 1 = 1. uzvun gerilmesi
stress of link 2 = 2. uzvun gerilmesi
lowest natural frequency of the links, over that of a change of acceleration = \
uzuvların en düşük doğal frekansının bir ivme değişimininkine oranı
natural frequency = doğal frekans | stress of the arm = kolun gerilmesi
safety of the main shaft against fatigue = ana milin yorulma emniyeti
safety of the driven shaft against fatigue = tahrikli milin yorulma emniyeti
life of the main shaft's bearings = ana mil yataklarının ömrü
life of the driven shaft's bearings = tahrikli mil yataklarının ömrü | symmetric knot tied = bağlanan simetrik düğüm
clearance = boşluk
time of the side grippers' motion, over their rods' natural period = \
yan kıskaç hareketi süresinin çubuklarının doğal periyoduna oranı
opener: teeth in the gap beside the pair = açıcı: çiftin yanındaki aralıkta dişler
opener: room of the tools between its plates = açıcı: levhaları arasında takımların yeri
opener: width of the warps that it displaces = açıcı: ittiği çözgülerin genişliği
stress of a post of the rail = ray dikmesinin gerilmesi | deflection of a post of the rail = ray dikmesinin sehimi
stress of an arm of the rail = ray kolunun gerilmesi | deflection of an arm of the rail = ray kolunun sehimi
room of the rapier beside the cloth = kumaşın yanında kancanın yeri
guides and cams clear of the front hold = ön tutucudan açık kızak ve kamlar
guides and cams clear of the back hold = arka tutucudan açık kızak ve kamlar
fatigue of the shaft end of the spacer cylinder at its shoulder = ara silindir mil ucunun faturasındaki yorulması
"""

_SOURCES = """
assumed by this project = bu projenin varsayımı | assumed = varsayım
worst case: shed open = en kötü durum: ağızlık açık
worst case = en kötü durum | shed open = ağızlık açık | own weight included = öz ağırlık dahil
motor table = motor çizelgesi
margin 1.25 = pay 1,25 | service factor 1.4 = işletme katsayısı 1,4 | servos of the table = çizelgedeki servolar
motors of the table = çizelgedeki motorlar | roller table = makara çizelgesi | bearing table = yatak çizelgesi
teeth of the parts list = parça listesindeki dişler | turn = tur | limit = sınır | wall = cidar | yield = akma
yield strength = akma dayanımı | von Mises = von Mises | yield over safety = akma dayanımı bölü emniyet
yield of S235 over safety = S235 akma dayanımı bölü emniyet | yield of S235 over 2 = S235 akma dayanımı bölü 2
yield of S235 over 3 = S235 akma dayanımı bölü 3 | yield of S235 over 1.5 = S235 akma dayanımı bölü 1,5
yield of the tube = borunun akma dayanımı | yield of the tube over 1.5 = borunun akma dayanımı bölü 1,5
yield over the parameter safety = akma dayanımı bölü safety parametresi | span over 2000 = açıklık bölü 2000
yield of heat-treatable steel = ıslah çeliğinin akma dayanımı | bending at its pivot = mafsalında eğilme
bending and torsion = eğilme ve burulma | keyway = kama yuvası | hot rolled = sıcak haddelenmiş
breaking force of a warp = bir çözgünün kopma kuvveti | breaking force of the warp = çözgünün kopma kuvveti
share of the breaking force = kopma kuvvetinin payı | friction over weight = sürtünme bölü ağırlık
bridge between the holes = delikler arasındaki köprü | rule of thumb for rockers = salınım kolları için pratik kural
rule of thumb for sliders = sürgüler için pratik kural | no undercut = alttan kesme yok
an infinite force = sonsuz bir kuvvet
gap of the warps = çözgülerin aralığı | gap of the pair = çiftin aralığı | pitch of the warps = çözgü adımı
opened gaps = açılmış aralıklar | pull of the yarn assumed by this project = ipliğin çekmesi bu projenin varsayımı
thickness of the pressed pile assumed by this project = basılı havın kalınlığı bu projenin varsayımı
shares assumed by this project = paylar bu projenin varsayımı
share assumed by this project = pay bu projenin varsayımı
catalogue values = katalog değerleri | rounded down = aşağı yuvarlanmış | one end clamped = bir ucu ankastre
hinged = mafsallı | bending in the plane = düzlemde eğilme | notch of the holes = deliklerin çentiği
half of its critical speed = kritik hızının yarısı | the cutter = kesici | proof = kanıt | fabric = kumaş
force that the rows need = sıraların gerektirdiği kuvvet | fabric assumed by this project = kumaş bu projenin varsayımı
the forces have its mass at the striking edge = kuvvetler kütlesini vuran kenarda sayar | its path = yolu
special tolerances = özel toleranslar | mean and scatter = ortalama ve saçılım | throat 2 mm = kaynak kalınlığı 2 mm
forward run = ileri çözüm | continuous torque of the motor = motorun sürekli torku
return springs = geri getirme yayları
springs of the table = çizelgedeki yaylar | linkage engine = mekanizma motoru
yarn held between them = aralarında tutulan iplik
warps beside each other = yan yana çözgüler | slots of the spacer = ara silindirin yarıkları
under the slots = yarıkların altında | abstract = özet | thesis = tez | the task has three roots = görevin üç kökü var
best hand weaver = en iyi el dokuyucusu | 25 knots a minute = dakikada 25 düğüm | tools out = takımlar dışarıda
usual practice = alışılmış uygulama | length of the warps = çözgülerin boyu | the recipe = reçete
induction-hardened steel = indüksiyonla sertleştirilmiş çelik | heat-treatable steel = ıslah çeliği
aluminium alloy = alüminyum alaşımı | fatigue limit over 2 = yorulma sınırı bölü 2 | given = verilen
fatigue limit over 1.5 = yorulma sınırı bölü 1,5 | roller bearings = makaralı yataklar | capillary tube = kılcal boru
"""


def _pairs(text: str) -> dict[str, str]:
    return dict(pair.split(" = ") for line in text.strip().split("\n") for pair in line.split(" | "))


CHECKS = _pairs(_CHECKS)
SOURCES = _pairs(_SOURCES)
