"""Briefs of machines of the catalogue: cams, beat-up, sheds, warps, wefts, knotting, tufting."""

from briefs.brief import called, designed

FACTS = ("parameters", {"name": "cam"})

CAMS = (
    designed("plate cam", "A cam lifts a slide by 30 mm over 100 degrees.", "cam", FACTS, lift="30mm", rise="100deg"),
    designed("dwell", "A cam holds its follower up for 60 degrees.", "cam", rise="90deg", dwell="60deg", fall="90deg"),
    designed("law of a cam", "The same in the two flanks: modified trapezoid out, 3-4-5 back.", "cam",
             law="modified-trapezoid", fall_law="3-4-5"),
    designed("offset follower", "The guide stands 6 mm beside the shaft.", "cam", offset="6mm"),
    designed("flat follower", "A flat face on a cam.", "cam", follower="flat", lift="15mm", rise="120deg",
             prime_radius="35mm"),
    designed("knife edge", "A knife edge traces a cam at low speed.", "cam", follower="knife", lift="10mm", load="10N"),
    designed("rocker on a cam", "A cam swings an arm by 20 degrees.", "cam", motion="oscillating", angle="20deg"),
    designed("conjugate cams", "A pair of plates drives its follower both ways.", "cam", kind="conjugate", lift="15mm"),
    designed("groove", "A groove drives the follower both ways.", "cam", kind="grooved", lift="15mm"),
    designed("barrel cam", "A groove around a drum.", "cam", kind="barrel", lift="40mm", rise="120deg"),
    designed("face cam", "A cam on the end of a drum.", "cam", kind="face", lift="10mm"),
    designed("wedge cam", "A straight cam on a slide.", "cam", kind="wedge", lift="10mm"),
    designed("pressure angle", "A pressure angle of at most 25 degrees.", "cam", pressure_angle_limit="25deg"),
    designed("fast cam", "600 turns a minute without a jump of the follower.", "cam", speed="600rpm", law="cycloidal",
             rise="180deg", lift="10mm", prime_radius="40mm"),
    designed("elastic follower", "The linkage behind the cam is not stiff.", "cam", linkage_stiffness="2N/um",
             speed="200rpm"),
    designed("contact pressure", "A heavy follower: 5 kg, 800 N.", "cam", mass="5kg", load="800N", lift="15mm"),
    designed("small shaft", "A cam for a bore of 20 mm.", "cam", bore="20mm"),
)  # fmt: skip

BEATING = (
    designed("beat-up by a swing", "Beat with a swing of 30 degrees.", "beat-up", swing="30deg", beta="48deg"),
    designed("beat-up by the hand", "The beater follows the weaver's hand.", "beat-up"),
    designed("force at the beat", "Beat with 80 N.", "beat-up", beat_force="80N", beater_mass="4kg"),
    designed("quick return of the beat", "A slower half before the beat.", "beat-up", crank_rotation="185deg"),
    designed("even run", "A flywheel for 2 percent of fluctuation.", "beat-up", fluctuation="0.02"),
    designed("counterweights", "Half of the first harmonic is balanced.", "beat-up", balance_share="0.5"),
    designed("steel links", "Links of structural steel.", "beat-up", strength__material="structural steel"),
    designed("beat by a clutch", "A motor that runs through, and a clutch.", "beat-up", start__drive="clutch"),
    designed("travelling beater", "The beater goes along the fell and stops.", "beat-up", travel__mode="start-stop"),
    called("choice of a crank-rocker", "The least torque over the swings.", "study", target="beat-up",
           vary={"swing": "28deg..32deg"}, goals=["drive_torque_max"], samples=4),
    designed("comb on screws", "A comb beats all warps at once.", "hammer"),
    designed("comb on belts", "The same on belts.", "hammer", axis="belt"),
    designed("comb on crank-rockers", "Crank-rockers beat the comb.", "hammer", drive="linkage"),
    designed("wide comb", "1,200 warps.", "hammer", cloth__warps="1200"),
)  # fmt: skip

WARPS = (
    designed("shed by cams", "Two shafts open a shed of 60 mm.", "shedding"),
    designed("staggered shed", "The shafts one after the other, wefts by rapier.", "shedding", phase="staggered",
             guideway="no"),
    designed("smooth shed", "Without a jump at the ends.", "shedding", law="cycloidal"),
    designed("warps in a reed", "A reed guides the warps.", "shedding", guides="reed"),
    designed("low shed", "40 mm are enough for a rapier.", "shedding", lift="40mm", shuttle_height="25mm"),
    designed("back rest", "A sprung back rest relieves the lifted warps.", "tension-compensator"),
    designed("soft back rest", "Tension within 30 percent.", "tension-compensator", tension_most="1.3"),
    designed("warp cylinder", "A cylinder with a motor tensions 600 warps.", "warp-tension"),
    designed("cylinder by hand", "The weavers wind the cloth.", "warp-tension", winding="hand"),
    designed("wool warps", "Warps of wool.", "warp-tension", cloth__yarns__warp="wool"),
    designed("weft by shuttle", "A shuttle lays the wefts.", "weft", carrier="shuttle"),
    designed("weft by rapier", "A rapier lays the wefts.", "weft", carrier="rapier"),
    designed("quick weft", "The least time of a row.", "weft", aim="time"),
    designed("shed by hand", "A rod and string heddles.", "hand-shed"),
    designed("comb by hand", "A comb in the weaver's hand.", "hand-beat"),
    designed("hand loom", "A loom without drives.", "hand-loom"),
    designed("two weavers", "Two weavers side by side at 1.6 m.", "hand-loom", width="1.6m", weavers="2"),
)  # fmt: skip

KNOTS = (
    designed("needle bars", "The needles of a tufting machine at 160 a minute.", "tufting"),
    designed("tufting machine", "A tufting machine for a loop of 6 mm.", "tufting-machine"),
    designed("hand for a jufti", "The hand that ties a jufti.", "knotting-four-bar", task__knot="jufti"),
    designed("hand for a knot", "The hand that ties a Turkish knot.", "knotting-four-bar", task__knot="turkish"),
    designed("arms", "Two arms tie a symmetric knot clear of the warps.", "knotting-dyad"),
    designed("asymmetric knot", "Arms for the Persian knot.", "knotting-dyad", knot="asymmetric"),
    designed("open to the right", "The Persian knot open to the right.", "knotting-dyad", knot="asymmetric",
             opens="right"),
    designed("direct elbows", "Servos in the elbows.", "knotting-dyad", elbow_drive="direct"),
    designed("six cams", "One shaft with six cams ties a knot a turn.", "weaver"),
    designed("best times", "The least accelerations of the six cams.", "weaver", optimise="yes"),
    designed("fewer colours", "Eight tubes are enough.", "weaver", tubes="8"),
    designed("closed cams", "Grooves instead of springs.", "weaver", closure="groove"),
    designed("slide of tubes", "The colours on a slide.", "weaver", magazine="slide"),
)  # fmt: skip
