"""Briefs of linkages: syntheses, mechanisms of files and of texts, studies, cyclograms, knots of paths."""

from briefs.brief import called, designed

D = "(60mm,0mm) (52mm,12mm) (30mm,18mm) (8mm,12mm) (0mm,0mm) (15mm,0mm) (30mm,0mm) (45mm,0mm)"
NINE = "(18mm,66mm) (30mm,88mm) (21mm,94mm) (6mm,90mm) (-9mm,78mm) (-21mm,59mm) (-24mm,42mm) (-18mm,34mm) (-4mm,41mm)"
FLAP = "(0mm,0mm,35deg) (40mm,22mm,12deg) (78mm,12mm,-22deg) (92mm,-28mm,-60deg)"
RANGE = "10mm..120mm"

SYNTHESES = (
    designed("path", "A point follows a flat D within 1 mm.", "path-four-bar", points=D, closed="yes", ground=RANGE,
             crank=RANGE, coupler=RANGE, rocker=RANGE, transmission_min="40deg"),
    designed("ranked paths", "The same within 2 mm, the best machine of those.", "path-four-bar", points=D,
             closed="yes", error_max="2mm", size_max="250mm", transmission_min="30deg"),
    designed("straight path", "A point goes up 25 mm along a line.", "path-four-bar"),
    designed("nine points", "A point passes nine points exactly.", "path-four-bar", exact="yes", points=NINE),
    designed("small linkage", "The line with links within 200 mm.", "path-four-bar", size_max="200mm"),
    designed("three poses", "A gripper takes three poses.", "motion-four-bar"),
    designed("four poses", "A flap takes four poses within 200 mm.", "motion-four-bar", poses=FLAP, size_max="200mm"),
    designed("transmission of poses", "Three poses, 45 degrees of transmission.", "motion-four-bar",
             transmission_min="45deg"),
    designed("logarithm", "A linkage adds in logarithms.", "function-four-bar", function="log10", start="1", stop="2"),
    designed("square by least squares", "A linkage squares, least squares.", "function-four-bar", function="x^2",
             start="0.5", stop="1.5", criterion="least-squares", rocker_swing="60deg"),
    designed("even error", "The error of a power alternates.", "function-four-bar", function="x^1.5", start="1",
             stop="4", criterion="minimax", crank_swing="90deg", rocker_swing="60deg"),
)  # fmt: skip

FOUR_BAR = """
name = "four-bar"
gravity = "9.81m/s^2"
links = { width = "20mm", thickness = "8mm", material = "structural steel" }
inputs = { A0 = "crank" }
branches = { B = 1 }
motions = { A0 = "150rpm" }

[values]
r = "60mm"

[bodies]
ground.points = { A0 = [0, 0], B0 = ["5*r", 0] }
crank.length = "r"
coupler = { length = "200mm", points.P = { radius = "100mm", angle = "25deg" } }
rocker.length = "4*r - 10mm"

[joints]
A0.pin = ["ground", "crank"]
A.pin = ["crank", "coupler"]
B.pin = ["coupler", "rocker"]
B0.pin = ["ground", "rocker"]
"""
YOKE = """
name = "scotch yoke"
inputs = { O = "crank" }
motions = { O = "120rpm" }
links = { width = "20mm", thickness = "8mm", material = "structural steel" }
[bodies]
ground.points = { O = [0, 0], line = [0, 0] }
crank.length = "40mm"
yoke = { points = { A = [0, 0], line = [0, 0] }, mass = "2kg" }
[joints]
O.pin = ["ground", "crank"]
A = { slot = ["crank", "yoke"], along = "90deg" }
line.slide = ["yoke", "ground"]
"""
FOLLOWER = """
name = "follower"
inputs = { O = "cam" }
motions = { O = "300rpm" }
[bodies]
ground.points = { O = [0, 0], G = ["0mm", 0] }
cam.points = { O = [0, 0] }
follower = { points = { G = [0, 0], R = [0, 0] }, mass = "0.5kg" }
[joints]
O.pin = ["ground", "cam"]
G = { slide = ["follower", "ground"], along = "90deg" }
[couplings.lift]
cam = [["cam", "O"], ["follower", "G"]]
roller = "R"
second_at = "40mm"
groove = true
lift = [
    { to = "20mm", over = "120deg", law = "cycloidal" }, { dwell = "60deg" },
    { to = "0mm", over = "120deg", law = "cycloidal" }, { dwell = "60deg" },
]
"""

MECHANISMS = (
    called("own linkage", "A beat-up of four bars that I drew.", "run", ("judge", {"mechanism": FOUR_BAR}),
           mechanism=FOUR_BAR),
    called("yoke", "A yoke that moves as a sine.", "run", mechanism=YOKE),
    called("cam in a linkage", "A cam lifts a slide twenty millimetres.", "run", mechanism=FOLLOWER),
    called("press", "A press with 80 mm of stroke.", "run", mechanism="slider_crank_press.toml",
           values={"stroke": "80mm"}),
    called("leg of twelve bars", "A leg that walks, sixty turns a minute.", "run", mechanism="jansen_leg.toml"),
    called("leg of six bars", "Klann's leg.", "run", mechanism="klann_leg.toml"),
    called("shaper", "A shaper whose return is quick.", "run", ("judge", {"mechanism": "quick_return.toml"}),
           mechanism="quick_return.toml"),
    called("exact line", "A point on an exact straight line.", "run", mechanism="peaucellier.toml",
           over="-40deg..40deg"),
    called("dwell of a linkage", "A six-bar whose output rests.", "run", mechanism="stephenson_dwell.toml"),
    called("geared five-bar", "A five-bar on two gears.", "run", mechanism="geared_five_bar.toml"),
    called("class three", "A linkage without a closed form.", "run", mechanism="class_three.toml"),
    called("needle linkage", "The six-bar of needles.", "run", mechanism="tufting_needle.toml"),
)  # fmt: skip

STUDIES = (
    called("tolerances", "Is the press good with 0.1 mm?", "study", target="slider_crank_press.toml",
           vary={"stroke": "60mm+-0.1mm"}, method="tolerance", samples=8, record=["drive_torque_rms"]),
    called("front of two goals", "Little torque, many beats.", "study", target="beat-up", method="optimum", samples=12,
           vary={"swing": "28deg..34deg", "speed": "12..16rad/s"},
           goals=["drive_torque_max", "most beats_per_minute"]),
    called("what matters", "Does swing or speed matter?", "study", target="beat-up", method="morris", samples=6,
           vary={"swing": "29deg..33deg", "speed": "14..16rad/s"}, record=["drive_torque_max"]),
    called("laws compared", "Which law has the smallest cam?", "study", target="cam", goals=["prime_radius"],
           vary={"law": "cycloidal, modified-sine, 3-4-5"}),
    called("limit of a result", "A swing whose links transmit 50 degrees.", "study", target="beat-up", samples=4,
           vary={"swing": "28deg..32deg"}, hold=["transmission_angle_min >= 50deg"]),
    called("sizes of a press", "Strokes of 40, 60 and 80 mm.", "study", target="slider_crank_press.toml",
           vary={"stroke": "40mm, 60mm, 80mm"}, record=["drive_torque_max"]),
    called("slopes", "How does the torque change with the swing?", "study", target="beat-up", method="local",
           vary={"swing": "29deg..33deg"}, record=["drive_torque_max"]),
)  # fmt: skip

TURKISH = [[0.001 * x, 0.001 * y] for x, y in ((1, 3), (1, -2), (-1, -2), (-1, 2), (3, 2), (3, -2), (1, -2), (1, 3))]

TIMES = (
    called("shortest turn", "The press as quick as its limits allow.", "cyclogram", name="press.toml", goal="period"),
    called("smooth turn", "The press with the least accelerations.", "cyclogram", ("cyclogram", {"name": "press.toml"}),
           name="press.toml", goal="acceleration"),
    called("turn of six cams", "Do the six cams interlock?", "cyclogram", name="weaver"),
    called("row of a loom", "Is a row of the loom in time?", "cyclogram", name="automated-loom:row"),
    designed("proved path", "This path ties a Turkish knot; arms that tie it.", "knotting-dyad",
             ("knot", {"points": TURKISH}), knot="symmetric"),
)  # fmt: skip
