"""Twenty-four tasks of the field's textbooks, each a function over `import ilmek` alone; its lines are counted."""

import numpy as np

import ilmek as il
from ilmek.units import deg, mm, rpm

TURN = np.linspace(0, 2 * np.pi, 361)
MASSES = {"crank": il.bar(0, 0.06, mass=0.2), "coupler": il.bar(0, 0.2, mass=0.5), "rocker": il.bar(0, 0.23, mass=0.6)}


def position_to_acceleration():
    motion = il.solve(il.four_bar(0.1, 0.04, 0.12, 0.08), 40 * deg, speed=25.0, acceleration=15.0)
    return [(motion[body].angle, motion[body].omega, motion[body].alpha) for body in ("coupler", "rocker")]


def slider_crank_torque():
    masses, gas = {"slider": il.point_mass(0.6, 0)}, [il.PointForce("slider.B", -500)]
    return il.judged(il.slider_crank(0.05, 0.2), inertias=masses, loads=gas, speed=100.0)


def quick_return():
    bodies = {"ground": {"O": 0, "C": -0.2j}, "crank": {"O": 0, "A": 0.1}, "block": {"A": 0, "slot": 0}}
    bodies, slides = bodies | {"lever": {"C": 0, "slot": 0}}, [il.Slide("slot", "block", "lever")]
    return il.judged(il.mechanism(bodies, "crank", slides=slides, branches={"slot": +1})).time_ratio("lever")


def cusp():
    pole = il.linkage.centrodes(il.solve(il.four_bar(0.3, 0.1, 0.25, 0.28), 60 * deg, speed=1.0), "coupler").moving[0]
    linkage = il.four_bar(0.3, 0.1, 0.25, 0.28, points={"coupler.P": pole})
    return il.judged(linkage).coupler_curve("coupler.P").cusps()


def straight_line():
    linkage = il.four_bar(0.22, 0.1, 0.28, 0.28, points={"coupler.P": 0.56})
    return il.judged(linkage).coupler_curve("coupler.P").straights(0.1 * mm, least=0.05)


def function_generator():
    return il.function_four_bars(np.log10, 1, 10, 60 * deg, 90 * deg, criterion="interpolation")


def burmester(points, angles):
    return il.motion_four_bars(points, angles)


def path(points):
    return il.path_four_bars(points, closed=True)


def many_designs(crank, rocker):
    many = il.four_bar(0.3, 0.06, 0.2, 0.23).vary(crank=crank, rocker=rocker)
    return many.evaluate(turn=73, want=["transmission_angle_min"])


def dwell(file):
    judged = il.judged(il.read_mechanism(file))
    return judged.limits("output"), judged.dwells("output", 0.5 * deg)


def cam():
    back = il.fall(1.5, 0.04, "modified-sine")
    programme = il.cam_programme(il.rise(1.5, 0.04, "3-4-5"), back, il.dwell(2 * np.pi - 3))
    return programme, il.plate_cam(programme, 0.08, roller_radius=0.01)


def curvature(plate, angles):
    return plate.curvature(angles)


def residual_vibration(ratios):
    return il.cams.residual(il.motion_law("cycloidal"), ratios)


def force_balance(masses):
    return il.judged(il.four_bar(0.3, 0.06, 0.2, 0.23), inertias=masses, speed=10.0).shaking.force


def monte_carlo(coupler, rocker):
    linkage = il.four_bar(0.3, 0.06, 0.2, 0.23, points={"coupler.P": 0.1 + 0.05j})
    return linkage.vary(coupler=coupler, rocker=rocker).evaluate(values=[1.0], want=["coupler.P x", "coupler.P y"])


def friction():
    rubbing = [il.dynamics.PinFriction("B0", 0.01, 0.1)]
    return il.judged(il.four_bar(0.3, 0.06, 0.2, 0.23), inertias=MASSES, joint_frictions=rubbing, speed=150 * rpm)


def pendulum():
    swing, masses = il.mechanism({"ground": {"O": 0}, "arm": {"O": 0}}, "arm"), {"arm": il.point_mass(1.0, 0.5)}
    return il.forward_dynamics(swing, masses, 1.0, position=-np.pi / 6, loads=[il.Gravity(-9.81j)])


def five_bar():
    bodies = {"ground": {"A": 0, "E": 0.2}, "left": {"A": 0, "B": 0.1}, "first": {"B": 0, "C": 0.2}}
    bodies |= {"second": {"D": 0, "C": 0.2}, "right": {"E": 0, "D": 0.1}}
    turned = {"left": 2 + 0.3 * np.sin(TURN), "right": 1 + 0.3 * np.cos(TURN)}
    motion = il.solve(il.mechanism(bodies, ["left", "right"], branches={"C": -1}), turned, speed=dict(left=1, right=2))
    return il.inverse_dynamics(motion, {"left": il.bar(0, 0.1, mass=0.3), "first": il.bar(0, 0.2, mass=0.3)})


def knot(points):
    return il.knot(points)


def chart_of_an_array(knots):
    chart = il.Chart.of(knots, il.read_yarns()[:2], "30x40cm", "10x10/dm")
    return chart, chart.statistics, chart.bill()


def machines(name, values, results, fixed):
    return il.study(name, values, record=results, fixed=fixed)


def frames():
    motion = il.solve(il.four_bar(0.3, 0.06, 0.2, 0.23), TURN, speed=10.0)
    return [result.table() for result in (motion, il.inverse_dynamics(motion, MASSES), il.parameters("cam"))]


def records(found):
    return [*found, il.judged(found.best), il.solve(found.best, TURN)]


def a_million_poses():
    return il.solve(il.four_bar(0.3, 0.06, 0.2, 0.23), np.linspace(0, 2 * np.pi, 1_000_000))


BEFORE = {
    "position_to_acceleration": 3, "slider_crank_torque": 8, "quick_return": 9, "cusp": 8, "straight_line": 4,
    "function_generator": 1, "burmester": 2, "path": 1, "many_designs": 12, "dwell": 3, "cam": 6, "curvature": 1,
    "residual_vibration": 3, "force_balance": 4, "monte_carlo": 5, "friction": 2, "pendulum": 3, "five_bar": 6,
    "knot": 2, "chart_of_an_array": 2, "machines": 3, "frames": 1, "records": 1, "a_million_poses": 1,
}  # fmt: skip
"""Lines of the same tasks with the first face, by the readers who did them; some with private imports."""
