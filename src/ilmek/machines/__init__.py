"""Concrete machines. A new machine is a package here and a line below; `ilmek.machines.catalogue` finds it."""

SUMMARIES = {
    "automated-loom": "the loom for one carpet: heads, shedding, beat-up, warp tension, timed together",
    "weaver": "knotting head: five cams on one shaft, one knot a turn (thesis, 2.2.3)",
    "beat-up": "crank-rocker that beats weft and knots to the fell: links, motion, forces",
    "cam": "a cam and its follower: profile, pressure angle, curvature, forces, spring, roller",
    "shedding": "cams that open the shed: profile, pressure angle, curvature, torque, square shaft",
    "hammer": "comb that beats the rows: force per warp, rows it leaves, uniformity, stroke or crank-rockers",
    "warp-tension": "cylinder that tensions the warps: slope, deflection, torque, reducer and motor, take-up",
    "tufting": "needle six-bar of a tufting machine: motion, torques of both shafts, forces, friction of the backing",
    "knotting-four-bar": "four-bar with a gripper on its coupler, from links or three poses, one side or two on gears",
    "knotting-dyad": "two-link arms that tie a proved knot clear of the warps, or every arm through four timed points",
    "path-four-bar": "four-bars whose coupler point passes given points, the nearest within limits or all exact ones",
    "motion-four-bar": "four-bars whose coupler takes three, four or five given poses, those without defects ranked",
    "function-four-bar": "four-bars whose rocker generates a function of the crank angle, exact or best over the range",
}
"""What each machine is, by its name, in the order of the catalogue; its package has the name with _ for -."""
