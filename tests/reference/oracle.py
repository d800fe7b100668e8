#!/usr/bin/env python3
"""Dense reference program for the dynamics of a planar cable-driven parallel robot.

It computes what the project computes - static shape, rates of the cable lengths,
spectrum of the small vibrations, critical speed - with plain dense numpy and scipy,
and shares no code with the project.  The equations are those of docs/theory.md.

    oracle.py SCENARIO.json [--max-speed V] [--step S]   one `tautline/analysis/1` object
    oracle.py --case SCENARIO.json                       a {"scenario", "expected"} object
    oracle.py --check CASE.json ...                      compare with stored files; exit 1 on a miss

A case file (an object with a "scenario" key) is accepted wherever a scenario is.

How each part is done
  statics      Newton on the end force and the length of each cable (no mesh unknowns), with a
               hand-derived Jacobian; continuation in the cable weight when plain Newton fails.
  L', L''      The static equations are expanded in a Taylor series of the path coordinate to
               second order and solved order by order.  No step size is involved: the result
               is exact up to rounding (about 1e-13 relative for L', 1e-12 for L'').
  spectrum     M = R^T R by Cholesky, then LAPACK's eigenvalues of the companion matrix of
               R^-T (.) R^-1.  In secant mode x and y are identical and uncoupled, so the scalar
               problem is solved and each eigenvalue is listed twice.
  critical     First unstable speed of a scan in equal steps, then Brent's method on the largest
               growth rate to 1e-9 m/s.  A window of instability narrower than the step that
               opens and closes between two scanned speeds is not seen.
SI units throughout.
"""

import argparse
import json
import math
import sys

import numpy as np
from scipy.linalg import cholesky, eig, eigvals, solve_triangular
from scipy.optimize import brentq, linear_sum_assignment

DEFAULT_MAX_SPEED = 40.0
DEFAULT_STEP = 0.1
SPEED_TOLERANCE = 1e-9


class Infeasible(Exception):
    """The pose has no static shape with every cable taut; `cable` is 1-based or None."""

    def __init__(self, reason, cable=None):
        super().__init__(reason)
        self.reason = reason
        self.cable = cable


class BadScenario(Exception):
    """The scenario file breaks the format."""


# ---------------------------------------------------------------------------------------------
# Scenario
# ---------------------------------------------------------------------------------------------


def _fields(obj, path, required, optional=()):
    """Check that `obj` is an object holding all `required` and no unknown fields."""
    if not isinstance(obj, dict):
        raise BadScenario(f"{path}: expected an object, got {obj!r}")
    for key in obj:
        if key not in required and key not in optional:
            raise BadScenario(f"{path}.{key}: unknown field")
    for key in required:
        if key not in obj:
            raise BadScenario(f"{path}.{key}: missing")


def _number(value, path, minimum=None, strict=False):
    """A finite number, optionally >= (or > when strict) `minimum`."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise BadScenario(f"{path}: expected a finite number, got {value!r}")
    if minimum is not None and (value < minimum or (strict and value == minimum)):
        raise BadScenario(f"{path}: {value!r} must be {'>' if strict else '>='} {minimum}")
    return float(value)


def _vector(value, path, size):
    """A list of `size` finite numbers as an array."""
    if not isinstance(value, list) or len(value) != size:
        raise BadScenario(f"{path}: expected {size} numbers, got {value!r}")
    return np.array([_number(item, f"{path}[{i}]") for i, item in enumerate(value)])


def _choice(value, path, allowed):
    if value not in allowed:
        raise BadScenario(f"{path}: {value!r} is not one of {', '.join(allowed)}")
    return value


class Robot:
    """A scenario with its defaults filled in.

    EA (cables,) [N], mu (cables,) [kg/m], mass [kg], g [m/s^2], strain per cable "green" or
    "engineering", anchors (cables, 2) [m], laws: per cable None (equilibrium) or an array (2, 3) whose rows give
    the horizontal and vertical part as c0 + cx x + cy y [N], pair: indices of the two equilibrium
    cables, n elements per cable, alpha [1/s], beta [s], secant (bool), p (2,) [m],
    d unit vector (2,), speed [m/s].
    """

    def __init__(self, scenario):
        s = scenario
        _fields(s, "scenario", ("cable", "platform", "cables", "elements_per_cable", "damping", "motion"),
                ("schema", "name", "gravity", "linearisation"))
        if "schema" in s:
            _choice(s["schema"], "schema", ("tautline/scenario/1", "tautline/scenario/2"))
        self.g = _number(s.get("gravity", 9.81), "gravity", 0.0)
        _fields(s["cable"], "cable", ("youngs_modulus", "area", "mass_per_length"), ("strain",))
        self._material(s["cable"], "cable")
        _fields(s["platform"], "platform", ("mass",))
        self.mass = _number(s["platform"]["mass"], "platform.mass", 0.0, True)
        cables = s["cables"]
        if not isinstance(cables, list) or not 3 <= len(cables) <= 8:
            raise BadScenario("cables: expected a list of 3 to 8 cables")
        self.anchors = np.zeros((len(cables), 2))
        self.laws = []
        self.EA, self.mu, self.strain = np.zeros(len(cables)), np.zeros(len(cables)), []
        for i, cable in enumerate(cables):
            _fields(cable, f"cables[{i}]", ("anchor", "tension"), ("cable",))
            own = cable.get("cable", {})
            _fields(own, f"cables[{i}].cable", (), ("youngs_modulus", "area", "mass_per_length", "strain"))
            self.EA[i], self.mu[i], strain = self._material({**s["cable"], **own}, f"cables[{i}].cable")
            self.strain.append(strain)
            self.anchors[i] = _vector(cable["anchor"], f"cables[{i}].anchor", 2)
            self.laws.append(self._law(cable["tension"], f"cables[{i}].tension"))
        for i in range(len(cables)):
            for j in range(i):
                if np.array_equal(self.anchors[i], self.anchors[j]):
                    raise BadScenario(f"cables[{i}].anchor: coincides with cables[{j}].anchor")
        self.pair = [i for i, law in enumerate(self.laws) if law is None]
        if len(self.pair) != 2:
            raise BadScenario(f"cables: {len(self.pair)} at equilibrium, exactly 2 are needed")
        self.n = s["elements_per_cable"]
        if isinstance(self.n, bool) or not isinstance(self.n, int) or not 2 <= self.n <= 200:
            raise BadScenario(f"elements_per_cable: {self.n!r} is not an integer from 2 to 200")
        _fields(s["damping"], "damping", ("alpha", "beta"))
        self.alpha = _number(s["damping"]["alpha"], "damping.alpha", 0.0)
        self.beta = _number(s["damping"]["beta"], "damping.beta", 0.0)
        self.secant = _choice(s.get("linearisation", "secant"), "linearisation", ("secant", "tangent")) == "secant"
        _fields(s["motion"], "motion", ("position", "direction", "speed"))
        self.p = _vector(s["motion"]["position"], "motion.position", 2)
        self.d = _vector(s["motion"]["direction"], "motion.direction", 2)
        length = math.hypot(*self.d)
        if length == 0.0:
            raise BadScenario("motion.direction: must not be zero")
        self.d = self.d / length
        self.speed = _number(s["motion"]["speed"], "motion.speed")

    @staticmethod
    def _law(tension, path):
        if tension == "equilibrium":
            return None
        if isinstance(tension, dict) and set(tension) == {"constant"}:
            return np.array([[_number(tension["constant"], path + ".constant", 0.0, True), 0.0, 0.0], [0.0, 0.0, 0.0]])
        if isinstance(tension, dict) and set(tension) == {"horizontal", "vertical"}:
            return np.array([_vector(tension[key], f"{path}.{key}", 3) for key in ("horizontal", "vertical")])
        raise BadScenario(f"{path}: neither equilibrium, constant nor horizontal and vertical")

    @staticmethod
    def _material(material, path):
        """EA [N], mu [kg/m] and the strain of a cable that is made of `material`."""
        modulus, area, mu = (_number(material[key], f"{path}.{key}", 0.0, True)
                             for key in ("youngs_modulus", "area", "mass_per_length"))
        return modulus * area, mu, _choice(material.get("strain", "green"), f"{path}.strain", ("green", "engineering"))

    def cable(self, i):
        """What the shape functions need to know of cable i."""
        return _SingleCable(self.n, self.EA[i], self.mu[i], self.g, self.strain[i], self.secant)


# ---------------------------------------------------------------------------------------------
# Axial law: N(lambda), its slope and curvature, and its inverse
# ---------------------------------------------------------------------------------------------


def axial_slope(stretch, EA, strain):
    """dN/dlambda [N]."""
    return 0.5 * EA * (3.0 * stretch**2 - 1.0) if strain == "green" else EA + 0.0 * stretch


def axial_curvature(stretch, EA, strain):
    """d2N/dlambda2 [N]."""
    return 3.0 * EA * stretch if strain == "green" else 0.0 * stretch


def stretch_of(force, EA, strain):
    """The stretch lambda >= 1 at which the axial force is `force` >= 0 (array)."""
    tau = np.asarray(force, dtype=float) / EA
    if strain == "engineering":
        return 1.0 + tau
    # lambda^3 - lambda - 2 tau = 0: convex for lambda > 0, and both starting values lie above
    # the root, so Newton descends onto it monotonically.
    stretch = 1.0 + np.minimum(tau, np.cbrt(2.0 * tau))
    for _ in range(60):
        step = (stretch**3 - stretch - 2.0 * tau) / (3.0 * stretch**2 - 1.0)
        stretch = stretch - step
        if np.max(np.abs(step) / stretch) < 1e-15:
            break
    return stretch


# ---------------------------------------------------------------------------------------------
# Shape of one cable from the force P with which it pulls the platform and its length L
# ---------------------------------------------------------------------------------------------


def element_forces(P, L, w, n):
    """Forces of the n elements pointing away from the platform, (n, 2).

    The platform's end node carries half an element's weight and each further node a whole one,
    so element k carries P plus the weight of (k + 1/2) elements below its centre.
    """
    t = np.empty((n, 2))
    t[:, 0] = P[0]
    t[:, 1] = P[1] + w * L / n * (np.arange(n) + 0.5)
    return t


def cable_shape(P, L, w, cable):
    """Element forces (n, 2), their magnitudes, stretches, and node offsets from the platform (n+1, 2)."""
    t = element_forces(P, L, w, cable.n)
    force = np.hypot(t[:, 0], t[:, 1])
    stretch = stretch_of(force, cable.EA, cable.strain)
    steps = (L / cable.n) * (stretch / force)[:, None] * t
    return t, force, stretch, np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])


def cable_end(P, L, w, cable):
    """End offset r_n - r_0 and its derivatives by P (2, 2), by L (2,) and by w (2,)."""
    n = cable.n
    t, force, stretch, nodes = cable_shape(P, L, w, cable)
    l = L / n
    e = t / force[:, None]
    across = l * stretch / force
    along = l / axial_slope(stretch, cable.EA, cable.strain)
    # d(step)/dt = across (I - e e^T) + along e e^T, per element
    dt = across[:, None, None] * np.eye(2) + (along - across)[:, None, None] * e[:, :, None] * e[:, None, :]
    lever = np.arange(n) + 0.5
    d_P = dt.sum(axis=0)
    by_vertical = dt[:, :, 1]
    d_L = nodes[-1] / L + (by_vertical * (w * lever / n)[:, None]).sum(axis=0)
    d_w = (by_vertical * (l * lever)[:, None]).sum(axis=0)
    return nodes[-1], d_P, d_L, d_w


# ---------------------------------------------------------------------------------------------
# Newton, and continuation in the cable weight
# ---------------------------------------------------------------------------------------------


def newton(residual, u, iterations, lengths):
    """Undamped Newton; `lengths` selects the unknowns that must stay positive.

    `residual(u)` returns (R, dR/du, dR/dw) with R scaled to order one.  Returns the solution and
    its Jacobian, or None when it does not converge within `iterations`.
    """
    for _ in range(iterations):
        R, J, _ = residual(u)
        size = np.max(np.abs(R))
        if not np.isfinite(size):
            return None
        try:
            u = u - np.linalg.solve(J, R)
        except np.linalg.LinAlgError:
            return None
        if not np.all(np.isfinite(u)) or np.any(u[lengths] <= 0.0):
            return None
        if size < 1e-9:
            # Convergence is quadratic: the step just taken leaves only rounding.
            return u, residual(u)[1]
    return None


def orientation(J):
    """Sign of the determinant of a Jacobian."""
    return np.linalg.slogdet(J)[0]


def follow_weight(make_residual, u, w, lengths):
    """Follow the solution that starts at the straight weightless cables up to weight `w`.

    `make_residual(weight)` gives the residual function at that weight.  Returns ((u, J), u), or
    (None, last u reached) where the branch ends, at a fold, before the full weight.
    """
    _, J, d_w = make_residual(0.0)(u)
    sign = orientation(J)
    s, ds = 0.0, 0.25
    while s < 1.0:
        ds = min(ds, 1.0 - s)
        guess = u - np.linalg.solve(J, d_w) * (w * ds)
        found = None
        if np.all(np.isfinite(guess)) and np.all(guess[lengths] > 0.0):
            found = newton(make_residual(w * (s + ds)), guess, 6, lengths)
        if found is not None:
            near = np.max(np.abs(found[0] - guess)) <= 0.1 * np.max(np.abs(found[0]))
            if orientation(found[1]) != sign or not near:
                found = None
        if found is None:
            ds *= 0.5
            if ds < 1e-8:
                return None, u
            continue
        s = 1.0 if s + ds >= 1.0 else s + ds
        u = found[0]
        _, J, d_w = make_residual(w * s)(u)
        ds *= 2.0
    return (u, J), u


def taut_solution(make_residual, straight, guess, w, lengths):
    """The solution at weight `w` connected to the straight weightless one.

    Newton from `guess` at full weight; kept when it converges quickly and the determinant of the
    Jacobian has the sign it has at the straight solution (it changes where two branches meet).
    Otherwise the weight is turned on gradually.  Returned as by `follow_weight`.
    """
    sign = orientation(make_residual(0.0)(straight)[1])
    if guess is not None:
        found = newton(make_residual(w), guess, 8, lengths)
        if found is not None and orientation(found[1]) == sign:
            return found, found[0]
    return follow_weight(make_residual, straight, w, lengths)


# ---------------------------------------------------------------------------------------------
# Statics of the robot
# ---------------------------------------------------------------------------------------------


def chord(robot, i):
    """Unit vector from the platform to anchor i, and the distance."""
    c = robot.anchors[i] - robot.p
    d = math.hypot(*c)
    if d == 0.0:
        raise Infeasible(f"the platform sits on the anchor of cable {i + 1}", i + 1)
    return c / d, d


def reversal(P, L, w, n):
    """Whether a vertical cable's force changes direction along its length (it would fold back)."""
    if abs(P[0]) > 1e-12 * math.hypot(*P):
        return False
    vertical = element_forces(P, L, w, n)[:, 1]
    return vertical.min() <= 0.0 <= vertical.max()


def prescribed_tension(robot, i):
    """Tension at the platform that the law of cable i asks for, N."""
    h, v = robot.laws[i] @ np.array([1.0, robot.p[0], robot.p[1]])
    return math.hypot(h, v)


def solve_prescribed(robot, i):
    """Taut shape of a cable of prescribed tension: (u, J) with u = (Px, Py, L)."""
    T = prescribed_tension(robot, i)
    if T <= 0.0:
        raise Infeasible(f"the tension prescribed for cable {i + 1} vanishes here", i + 1)
    e, d = chord(robot, i)
    cable = robot.cable(i)
    w = cable.weight_per_length()

    def make_residual(weight):
        def residual(u):
            P, L = u[:2], u[2]
            end, d_P, d_L, d_w = cable_end(P, L, weight, cable)
            R = np.append((end - e * d) / d, (P @ P / T**2 - 1.0))
            J = np.zeros((3, 3))
            J[:2, :2] = d_P / d
            J[:2, 2] = d_L / d
            J[2, :2] = 2.0 * P / T**2
            return R, J, np.append(d_w / d, 0.0)
        return residual

    taut_stretch = float(stretch_of(T, cable.EA, cable.strain))
    straight = np.array([T * e[0], T * e[1], d / taut_stretch])
    # Parabolic cable: the chord carries `axial`, each end half the weight W.
    W = w * straight[2]
    discriminant = (e[1]**2 - 1.0) * W**2 + 4.0 * T**2
    guess = None
    if discriminant > 0.0:
        axial = 0.5 * (e[1] * W + math.sqrt(discriminant))
        if axial > 0.0:
            sag = (W * e[0] / axial)**2 / 24.0
            guess = np.array([axial * e[0], axial * e[1] - 0.5 * W, straight[2] * (1.0 + sag)])
    found, _ = taut_solution(make_residual, straight, guess, w, [2])
    if found is None or reversal(found[0][:2], found[0][2], w, robot.n):
        raise Infeasible(
            f"the tension prescribed for cable {i + 1}, {T:.6g} N, cannot carry the cable's own weight "
            f"over the distance to its winch", i + 1)
    return found


def solve_pair(robot, pull):
    """The two equilibrium cables under `pull`, the force of the other cables on the platform.

    Returns (u, J) with u = (P1x, P1y, L1, L2); the second cable pulls with -(load + P1).
    """
    i, j = robot.pair
    load = pull - np.array([0.0, robot.mass * robot.g])
    cables = robot.cable(i), robot.cable(j)
    w = np.array([cable.weight_per_length() for cable in cables])
    (e1, d1), (e2, d2) = chord(robot, i), chord(robot, j)
    chords = np.column_stack([e1, e2])
    if abs(np.linalg.det(chords)) < 1e-12:
        raise Infeasible(f"the equilibrium cables {i + 1} and {j + 1} lie on one line at this pose, "
                         f"so their tensions are not determined", i + 1)
    axial = np.linalg.solve(chords, -load)
    if axial.min() <= 0.0:
        k = robot.pair[int(np.argmin(axial))] + 1
        raise Infeasible(f"cable {k} would have to push the platform to hold this pose", k)

    # Here the weight is a part of that of both cables, from 0 to 1.
    def make_residual(weight):
        def residual(u):
            P1, L1, L2 = u[:2], u[2], u[3]
            end1, d1_P, d1_L, d1_w = cable_end(P1, L1, weight * w[0], cables[0])
            end2, d2_P, d2_L, d2_w = cable_end(-load - P1, L2, weight * w[1], cables[1])
            R = np.concatenate([(end1 - e1 * d1) / d1, (end2 - e2 * d2) / d2])
            J = np.zeros((4, 4))
            J[:2, :2] = d1_P / d1
            J[2:, :2] = -d2_P / d2
            J[:2, 2] = d1_L / d1
            J[2:, 3] = d2_L / d2
            return R, J, np.concatenate([d1_w * w[0] / d1, d2_w * w[1] / d2])
        return residual

    stretch = [float(stretch_of(force, cable.EA, cable.strain)) for force, cable in zip(axial, cables, strict=True)]
    straight = np.array([*(axial[0] * e1), d1 / stretch[0], d2 / stretch[1]])
    W1, W2 = w * straight[2:]
    heavy = np.linalg.solve(chords, -load + np.array([0.0, 0.5 * (W1 + W2)]))
    guess = None
    if heavy.min() > 0.0:
        sag = (np.array([W1 * e1[0], W2 * e2[0]]) / heavy)**2 / 24.0
        guess = np.array([heavy[0] * e1[0], heavy[0] * e1[1] - 0.5 * W1,
                          straight[2] * (1.0 + sag[0]), straight[3] * (1.0 + sag[1])])
    found, last = taut_solution(make_residual, straight, guess, 1.0, [2, 3])
    if found is not None:
        u = found[0]
        for k, P, L, weight in ((i, u[:2], u[2], w[0]), (j, -load - u[:2], u[3], w[1])):
            if reversal(P, L, weight, robot.n):
                raise Infeasible(f"cable {k + 1} hangs slack under its own weight", k + 1)
        return found
    slack = [math.hypot(*last[:2]) / last[2], math.hypot(*(load + last[:2])) / last[3]]
    k = robot.pair[int(np.argmin(slack))] + 1
    raise Infeasible(f"the equilibrium cables have no taut shape here: cable {k} cannot carry its own weight", k)


def solve_statics(robot):
    """End forces P (cables, 2), lengths L (cables,), and what the length rates need."""
    count = len(robot.anchors)
    P, L, jacobians = np.zeros((count, 2)), np.zeros(count), {}
    for i in range(count):
        if robot.laws[i] is not None:
            u, jacobians[i] = solve_prescribed(robot, i)
            P[i], L[i] = u[:2], u[2]
    i, j = robot.pair
    pull = P.sum(axis=0)
    u, jacobians["pair"] = solve_pair(robot, pull)
    P[i], L[i], L[j] = u[:2], u[2], u[3]
    P[j] = np.array([0.0, robot.mass * robot.g]) - pull - u[:2]
    return P, L, jacobians


# ---------------------------------------------------------------------------------------------
# Length rates: second-order Taylor series in the path coordinate sigma
#
# A series is an array whose first axis holds the coefficients of 1, sigma, sigma^2.
# ---------------------------------------------------------------------------------------------


def series(*coefficients):
    return np.array(coefficients, dtype=float)


def s_mul(a, b):
    """Product of two series, truncated."""
    return np.array([a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0]])


def s_div(a, b):
    """Quotient of two series, truncated."""
    q0 = a[0] / b[0]
    q1 = (a[1] - q0 * b[1]) / b[0]
    return np.array([q0, q1, (a[2] - q0 * b[2] - q1 * b[1]) / b[0]])


def s_sqrt(a):
    """Square root of a series, truncated."""
    r0 = np.sqrt(a[0])
    r1 = a[1] / (2.0 * r0)
    return np.array([r0, r1, (a[2] - r1 * r1) / (2.0 * r0)])


def s_stretch(force, EA, strain):
    """Stretch as a series from the axial force as a series."""
    c0 = stretch_of(force[0], EA, strain)
    slope = axial_slope(c0, EA, strain)
    c1 = force[1] / slope
    return np.array([c0, c1, (force[2] - 0.5 * axial_curvature(c0, EA, strain) * c1**2) / slope])


def s_cable_end(Px, Py, L, cable):
    """End offset (x, y) of a cable as series, from the series of its end force and length."""
    n = cable.n
    lever = (np.arange(n) + 0.5) * cable.weight_per_length() / n
    tx = Px[:, None] * np.ones(n)
    ty = Py[:, None] + L[:, None] * lever
    force = s_sqrt(s_mul(tx, tx) + s_mul(ty, ty))
    ratio = s_div(s_stretch(force, cable.EA, cable.strain), force)
    l = L[:, None] * np.full(n, 1.0 / n)
    return [s_mul(l, s_mul(ratio, t)).sum(axis=1) for t in (tx, ty)]


def solve_series(residual, u, J):
    """Series of the unknowns, (3, unknowns), from their values `u` and the Jacobian `J` there."""
    U = np.zeros((3, len(u)))
    U[0] = u
    for order in (1, 2):
        # The top coefficient enters the residual's top coefficient only through J.
        U[order] = -np.linalg.solve(J, residual(U)[order])
    return U


def length_rates(robot, P, L, jacobians):
    """dL/dsigma and d2L/dsigma2 of every cable along p + sigma d."""
    count = len(robot.anchors)
    rates, curvatures = np.zeros(count), np.zeros(count)
    x, y = series(robot.p[0], robot.d[0], 0.0), series(robot.p[1], robot.d[1], 0.0)
    one = series(1.0, 0.0, 0.0)
    pull_x, pull_y = series(0, 0, 0), series(0, 0, 0)
    for i in range(count):
        if robot.laws[i] is None:
            continue
        h, v = (law[0] * one + law[1] * x + law[2] * y for law in robot.laws[i])
        T2 = s_mul(h, h) + s_mul(v, v)
        scale, d, cable = T2[0], chord(robot, i)[1], robot.cable(i)

        def residual(U):
            ex, ey = s_cable_end(U[:, 0], U[:, 1], U[:, 2], cable)
            return np.column_stack([
                (x + ex - robot.anchors[i, 0] * one) / d,
                (y + ey - robot.anchors[i, 1] * one) / d,
                (s_mul(U[:, 0], U[:, 0]) + s_mul(U[:, 1], U[:, 1]) - T2) / scale])

        U = solve_series(residual, [P[i, 0], P[i, 1], L[i]], jacobians[i])
        rates[i], curvatures[i] = U[1, 2], 2.0 * U[2, 2]
        pull_x, pull_y = pull_x + U[:, 0], pull_y + U[:, 1]
    i, j = robot.pair
    di, dj = chord(robot, i)[1], chord(robot, j)[1]
    load_x, load_y = pull_x, pull_y - robot.mass * robot.g * one

    def residual(U):
        ax, ay = s_cable_end(U[:, 0], U[:, 1], U[:, 2], robot.cable(i))
        bx, by = s_cable_end(-load_x - U[:, 0], -load_y - U[:, 1], U[:, 3], robot.cable(j))
        return np.column_stack([
            (x + ax - robot.anchors[i, 0] * one) / di, (y + ay - robot.anchors[i, 1] * one) / di,
            (x + bx - robot.anchors[j, 0] * one) / dj, (y + by - robot.anchors[j, 1] * one) / dj])

    U = solve_series(residual, [P[i, 0], P[i, 1], L[i], L[j]], jacobians["pair"])
    rates[[i, j]], curvatures[[i, j]] = U[1, 2:], 2.0 * U[2, 2:]
    return rates, curvatures


# ---------------------------------------------------------------------------------------------
# Matrices
# ---------------------------------------------------------------------------------------------


def element_matrices(L, rate, curvature, mu, n):
    """Element matrices of one cable at unit speed, each (n, 2, 2): M, C / v and K_dyn / v^2."""
    l, l_dot, l_ddot = L / n, rate / n, curvature / n
    k = np.arange(n)
    w0, w1 = -k * l_dot, -(k + 1) * l_dot
    a0, a1 = -k * l_ddot, -(k + 1) * l_ddot
    convect = lambda p, q: np.array([[-(p / 3 + q / 6), p / 3 + q / 6], [-(p / 6 + q / 3), p / 6 + q / 3]])
    M = np.broadcast_to(mu * l * np.array([[1 / 3, 1 / 6], [1 / 6, 1 / 3]]), (n, 2, 2))
    C = 2.0 * mu * convect(w0, w1)
    K = mu * convect(a0, a1) - (mu / l) * (w0**2 + w0 * w1 + w1**2) / 3.0 * np.array([[[1], [-1]], [[-1], [1]]])
    return M, np.moveaxis(C, -1, 0), np.moveaxis(K, -1, 0)


def elastic_blocks(P, L, cable):
    """2 x 2 blocks A / l of the elastic stiffness of one cable's elements, (n, 2, 2)."""
    t, force, stretch, _ = cable_shape(P, L, cable.weight_per_length(), cable)
    secant = force / stretch
    blocks = secant[:, None, None] * np.eye(2)
    if not cable.secant:
        e = t / force[:, None]
        extra = axial_slope(stretch, cable.EA, cable.strain) - secant
        blocks = blocks + extra[:, None, None] * e[:, :, None] * e[:, None, :]
    return blocks * (cable.n / L)


class Dynamics:
    """Dense matrices at one pose, in the coordinates in which the mass matrix is the identity.

    The platform is node 0, then each cable's inner nodes from platform to winch.  In secant mode
    the unknowns are one per node (x and y are copies of each other), otherwise x, y per node.
    K_el, C1, K2: (unknowns, unknowns); the damping matrix at speed v is v C1 + alpha I + beta K_el
    and the stiffness K_el + v^2 K2.
    """

    def __init__(self, robot, P, L, rates, curvatures):
        n, count = robot.n, len(L)
        nodes = 1 + count * (n - 1)
        wall = nodes  # every winch node is collected in one extra row that is dropped
        M, C, K2 = (np.zeros((nodes + 1, nodes + 1)) for _ in range(3))
        K_el = np.zeros((nodes + 1, nodes + 1, 2, 2))
        self.cable_mass = []
        for i in range(count):
            index = np.concatenate([[0], 1 + i * (n - 1) + np.arange(n - 1), [wall]])
            ends = np.column_stack([index[:-1], index[1:]])
            where = (ends[:, :, None], ends[:, None, :])
            Me, Ce, Ke = element_matrices(L[i], rates[i], curvatures[i], robot.mu[i], n)
            own = np.zeros_like(M)
            np.add.at(own, where, Me)
            self.cable_mass.append(own[:nodes, :nodes])
            M += own
            np.add.at(C, where, Ce)
            np.add.at(K2, where, Ke)
            blocks = elastic_blocks(P[i], L[i], robot.cable(i))
            signs = np.array([[1.0, -1.0], [-1.0, 1.0]])
            np.add.at(K_el, where, signs[None, :, :, None, None] * blocks[:, None, None, :, :])
        M[0, 0] += robot.mass
        M, C, K2, K_el = (A[:nodes, :nodes] for A in (M, C, K2, K_el))
        if robot.secant:
            K_el = K_el[:, :, 0, 0]
            self.copies = 2
        else:
            M, C, K2 = (np.kron(A, np.eye(2)) for A in (M, C, K2))
            K_el = K_el.transpose(0, 2, 1, 3).reshape(2 * nodes, 2 * nodes)
            self.cable_mass = [np.kron(A, np.eye(2)) for A in self.cable_mass]
            self.copies = 1
        self.alpha, self.beta = robot.alpha, robot.beta
        self.M, self.C, self.K_dyn = M, C, K2
        self.R = cholesky(M)
        self.K_el, self.C1, self.K2 = (self._whiten(A) for A in (K_el, C, K2))
        # C1 and K2 have no symmetry; K_el has, and rounding must not take it away.
        self.K_el = 0.5 * (self.K_el + self.K_el.T)
        self.size = len(M)

    def _whiten(self, A):
        """R^-T A R^-1."""
        half = solve_triangular(self.R, A, trans="T")
        return solve_triangular(self.R, half.T, trans="T").T

    def companion(self, v):
        """State matrix of (q, dq/dt) at speed v."""
        N = self.size
        A = np.zeros((2 * N, 2 * N))
        A[:N, N:] = np.eye(N)
        A[N:, :N] = -(self.K_el + v * v * self.K2)
        A[N:, N:] = -(v * self.C1 + self.beta * self.K_el)
        A[range(N, 2 * N), range(N, 2 * N)] -= self.alpha
        return A

    def eigenvalues(self, v):
        """Eigenvalues of the problem as solved: once each in secant mode."""
        return eigvals(self.companion(v), overwrite_a=True, check_finite=False)

    def growth(self, v):
        """Largest real part, 1/s."""
        return float(self.eigenvalues(v).real.max())

    def fastest_mode(self, v):
        """Eigenvalue of largest real part, and the cable (1-based) that moves most in its mode.

        The measure is the kinetic energy of the cable's own mass, x* M_cable x.
        """
        values, vectors = eig(self.companion(v), overwrite_a=True, check_finite=False)
        best = int(np.argmax(values.real))
        x = solve_triangular(self.R, vectors[:self.size, best])
        shares = [np.vdot(x, A @ x).real for A in self.cable_mass]
        return values[best], int(np.argmax(shares)) + 1


def critical_speed(dynamics, max_speed, step):
    """First unstable speed up to `max_speed`, as the "critical" object plus `scan_speed`, or None."""
    low = 0.0
    if dynamics.alpha == 0.0 and dynamics.beta == 0.0:
        # Undamped: every growth rate is zero at rest, so the sign just above decides.
        tiny = 1e-3
        values = dynamics.eigenvalues(tiny)
        if values.real.max() > 1e-11 * np.abs(values).max():
            return describe(dynamics, 0.0, tiny, 0.0)
        low = tiny
    count = int(math.ceil(max_speed / step - 1e-9))
    for k in range(1, count + 1):
        v = min(k * step, max_speed)
        if dynamics.growth(v) > 0.0:
            speed = low
            if dynamics.growth(low) < 0.0:
                speed = brentq(dynamics.growth, low, v, xtol=SPEED_TOLERANCE, rtol=1e-14)
            return describe(dynamics, speed, speed, v)
        low = v
    return None


def describe(dynamics, speed, at, scan_speed):
    value, cable = dynamics.fastest_mode(at)
    frequency = abs(value.imag) / (2.0 * math.pi)
    if frequency < 1e-7:
        frequency = 0.0
    return {"speed": float(speed), "frequency_hz": float(frequency),
            "kind": "flutter" if frequency > 0.0 else "divergence", "cable": cable, "scan_speed": float(scan_speed)}


# ---------------------------------------------------------------------------------------------
# Whole analysis
# ---------------------------------------------------------------------------------------------


def analyse(scenario, max_speed=DEFAULT_MAX_SPEED, step=DEFAULT_STEP):
    """The analysis object; "critical" also holds "scan_speed" and, when infeasible, "cable" is set."""
    robot = Robot(scenario)
    out = {"schema": "tautline/analysis/1", "feasible": True, "reason": None, "cables": [],
           "speed": robot.speed, "eigenvalues": [], "max_growth_rate": None, "stable": None,
           "critical": None, "searched_up_to": float(max_speed)}
    try:
        P, L, jacobians = solve_statics(robot)
    except Infeasible as error:
        out.update(feasible=False, reason=error.reason[0].upper() + error.reason[1:] + ".", cable=error.cable)
        return out
    rates, curvatures = length_rates(robot, P, L, jacobians)
    for i in range(len(L)):
        cable = robot.cable(i)
        w = cable.weight_per_length()
        nodes = robot.p + cable_shape(P[i], L[i], w, cable)[3]
        nodes[-1] = robot.anchors[i]
        out["cables"].append({
            "unstretched_length": float(L[i]),
            "tension_at_platform": math.hypot(*P[i]),
            "tension_at_winch": math.hypot(P[i, 0], P[i, 1] + w * L[i]),
            "length_rate": float(rates[i]),
            "length_curvature": float(curvatures[i]),
            "nodes": nodes.tolist()})
    dynamics = Dynamics(robot, P, L, rates, curvatures)
    values = np.repeat(dynamics.eigenvalues(robot.speed), dynamics.copies)
    values = values[np.lexsort((values.imag, values.real))]
    out["eigenvalues"] = [[float(z.real), float(z.imag)] for z in values]
    out["max_growth_rate"] = float(values.real.max())
    out["stable"] = out["max_growth_rate"] < 0.0
    out["critical"] = critical_speed(dynamics, max_speed, step)
    return out


def as_analysis(result):
    """Only the fields of the analysis format."""
    public = {key: value for key, value in result.items() if key != "cable"}
    if public["critical"] is not None:
        public["critical"] = {k: v for k, v in public["critical"].items() if k != "scan_speed"}
    return public


def as_expected(result):
    """The "expected" part of a case file."""
    if not result["feasible"]:
        return {"feasible": False, "cable": result["cable"]}
    return {key: result[key] for key in ("cables", "eigenvalues", "max_growth_rate", "critical", "searched_up_to")}


# ---------------------------------------------------------------------------------------------
# Comparison with stored files
# ---------------------------------------------------------------------------------------------

# Quantity: tolerance, meaning of the deviation
TOLERANCES = {
    "statics": (1e-8, "lengths, tensions and nodes, relative"),
    "length_rate": (1e-7, "dL/dsigma"),
    "length_curvature": (1e-5, "d2L/dsigma2 times the longest cable"),
    "eigenvalues": (1e-6, "matched one to one, of the largest |lambda|"),
    "max_growth_rate": (1e-6, "of the largest |lambda|"),
    "critical_speed": (1e-3, "m/s; infinite if only one side has one"),
    "frequency": (1e-3, "Hz at the critical speed"),
    "feasibility": (0.0, "verdict and cable, kind and cable where stored"),
    "catenary": (2e-8, "end forces, relative"),
    "mesh": (1e-6, "end force on a mesh, relative"),
    "modes": (1e-5, "in-plane frequencies, relative"),
    "irvine_caughey": (1e-6, "Omega / pi"),
}


def compare_case(case):
    """Deviations {quantity: value} between a stored case and this program."""
    want = case["expected"]
    got = analyse(case["scenario"], want.get("searched_up_to", DEFAULT_MAX_SPEED))
    if not want.get("feasible", True) or not got["feasible"]:
        same = not got["feasible"] and not want.get("feasible", True) and got["cable"] == want["cable"]
        return {"feasibility": 0.0 if same else math.inf}
    out = dict.fromkeys(("statics", "length_rate", "length_curvature"), 0.0)
    longest = max(c["unstretched_length"] for c in want["cables"])
    for a, b in zip(got["cables"], want["cables"], strict=True):
        for key in ("unstretched_length", "tension_at_platform", "tension_at_winch"):
            out["statics"] = max(out["statics"], abs(a[key] - b[key]) / abs(b[key]))
        shift = np.abs(np.array(a["nodes"]) - np.array(b["nodes"])).max() / longest
        out["statics"] = max(out["statics"], shift)
        out["length_rate"] = max(out["length_rate"], abs(a["length_rate"] - b["length_rate"]))
        out["length_curvature"] = max(out["length_curvature"],
                                      abs(a["length_curvature"] - b["length_curvature"]) * longest)
    ours, theirs = (np.array(x["eigenvalues"]) @ [1.0, 1.0j] for x in (got, want))
    largest = np.abs(theirs).max()
    if len(ours) == len(theirs):
        distance = np.abs(ours[:, None] - theirs[None, :])
        out["eigenvalues"] = distance[linear_sum_assignment(distance)].max() / largest
    else:
        out["eigenvalues"] = math.inf
    out["max_growth_rate"] = abs(got["max_growth_rate"] - want["max_growth_rate"]) / largest
    a, b = got["critical"], want["critical"]
    if a is None or b is None:
        out["critical_speed"] = 0.0 if a is b else math.inf
    else:
        out["critical_speed"] = abs(a["speed"] - b["speed"])
        out["frequency"] = abs(a["frequency_hz"] - b["frequency_hz"])
        extra = [key for key in ("kind", "cable") if key in b]
        out["feasibility"] = 0.0 if all(a[key] == b[key] for key in extra) else math.inf
    return out


def catenary_ends(span, rise, L, w, EA):
    """H, V at the upper end and V at the lower end of an elastic catenary (engineering strain).

    The force at arc length s from the lower end is (H, V0 + w s); integrating the direction times
    the stretch 1 + |force| / EA gives both end conditions in closed form.
    """
    def residual(u):
        H, V0 = u
        V1, F0 = V0 + w * L, math.hypot(H, V0)
        F1 = math.hypot(H, V1)
        x = H / w * (math.asinh(V1 / H) - math.asinh(V0 / H)) + H * L / EA
        y = (F1 - F0) / w + (V1**2 - V0**2) / (2.0 * w * EA)
        by_H = (math.asinh(V1 / H) - math.asinh(V0 / H)) / w + L / EA - (V1 / F1 - V0 / F0) / w
        cross = H / w * (1.0 / F1 - 1.0 / F0)
        by_V = (V1 / F1 - V0 / F0) / w + L / EA
        return np.array([x - span, y - rise]), np.array([[by_H, cross], [cross, by_V]])

    # Start from the parabola of the same length, halving steps that leave H > 0.
    chord_length = math.hypot(span, rise)
    slack = max(L / chord_length - 1.0, 1e-3)
    H = w * L * math.sqrt(1.0 / (24.0 * slack)) * (span / chord_length)**2
    u = np.array([H, H * rise / span - 0.5 * w * L])
    for _ in range(100):
        R, J = residual(u)
        step = np.linalg.solve(J, R)
        while u[0] - step[0] <= 0.0:
            step *= 0.5
        u = u - step
        if np.abs(step).max() < 1e-12 * abs(u[0]):
            break
    return u[0], u[1] + w * L, u[1]


class _SingleCable:
    """What the shape functions need to know of a robot, for one cable on its own."""

    def __init__(self, n, EA, mu, g, strain="engineering", secant=False):
        self.n, self.EA, self.mu, self.g, self.strain, self.secant = n, EA, mu, g, strain, secant

    def weight_per_length(self):
        return self.mu * self.g


def mesh_ends(cable, span, rise, L, start):
    """Force (H, V) at the lower end of a meshed cable of length L from (0, 0) to (span, rise)."""
    u = np.array(start, dtype=float)
    for _ in range(50):
        end, d_P, _, _ = cable_end(u, L, cable.weight_per_length(), cable)
        step = np.linalg.solve(d_P, end - [span, rise])
        u = u - step
        if np.abs(step).max() < 1e-12 * np.abs(u).max():
            break
    return u


def mesh_frequencies(cable, P, L, count):
    """Lowest in-plane frequencies, Hz, of a meshed cable with both ends fixed."""
    n = cable.n
    M = cable.mu * L / n * (np.diag(np.full(n - 1, 2 / 3)) + np.diag(np.full(n - 2, 1 / 6), 1)
                            + np.diag(np.full(n - 2, 1 / 6), -1))
    R = np.kron(cholesky(M), np.eye(2))
    blocks = elastic_blocks(P, L, cable)
    K = np.zeros((n - 1, 2, n - 1, 2))
    for k in range(n - 1):
        K[k, :, k, :] = blocks[k] + blocks[k + 1]
        if k + 2 < n:
            K[k, :, k + 1, :] = K[k + 1, :, k, :] = -blocks[k + 1]
    K = K.reshape(2 * (n - 1), 2 * (n - 1))
    half = solve_triangular(R, K, trans="T")
    K = solve_triangular(R, half.T, trans="T")
    return np.sqrt(np.linalg.eigvalsh(0.5 * (K + K.T))[:count]) / (2.0 * math.pi)


def irvine_caughey_roots(lambda2, count):
    """Lowest symmetric roots Omega / pi of tan(z) = z - (4 / lambda^2) z^3, z = Omega / 2.

    Written with sine and cosine so that the poles of the tangent are no obstacle.
    """
    cubic = 0.0 if lambda2 is None else 4.0 / lambda2
    # Divided by z^3, which removes the root at the origin for every finite lambda^2.
    f = lambda z: (math.sin(z) - (z - cubic * z**3) * math.cos(z)) / z**3
    grid = np.linspace(0.05, 0.5 * math.pi * (2 * count + 2), 4000)
    values = [f(z) for z in grid]
    roots = [brentq(f, grid[k], grid[k + 1], xtol=1e-14)
             for k in range(len(grid) - 1) if values[k] * values[k + 1] < 0.0]
    return [2.0 * z / math.pi for z in roots[:count]]


def compare_catenary(data):
    """Deviations between catenary.json and what closed forms and the elements give."""
    out = {"catenary": 0.0, "mesh": 0.0, "modes": 0.0, "irvine_caughey": 0.0}
    c = data["cable"]
    w = c["mass_per_length"] * c["gravity"]
    for item in data["elastic_catenary"]["cases"]:
        H, V_up, V_low = catenary_ends(c["span"], c["rise"], item["length"], w, c["axial_stiffness"])
        for got, key in ((H, "horizontal"), (V_up, "vertical_upper"), (V_low, "vertical_lower")):
            out["catenary"] = max(out["catenary"], abs(got - item[key]) / math.hypot(H, V_up))
    start = {}

    def mesh(n, L):
        cable = _SingleCable(n, c["axial_stiffness"], c["mass_per_length"], c["gravity"])
        if L not in start:
            H, _, V_low = catenary_ends(c["span"], c["rise"], L, w, c["axial_stiffness"])
            start[L] = (H, V_low)
        return cable, mesh_ends(cable, c["span"], c["rise"], L, start[L])

    m = data["mesh_convergence"]
    for n, want in zip(m["elements"], m["horizontal"], strict=True):
        out["mesh"] = max(out["mesh"], abs(mesh(n, m["length"])[1][0] - want) / want)
    for item in data["in_plane_modes"]["cases"]:
        L, want = item["length"], np.array(item["frequencies_hz"])
        coarse, fine = (mesh_frequencies(*mesh(n, L), L, len(want)) for n in (100, 200))
        limit = fine + (fine - coarse) / 3.0
        out["modes"] = max(out["modes"], float(np.max(np.abs(limit - want) / want)))
    for item in data["irvine_caughey"]["symmetric"]:
        want = item["omega_over_pi"]
        got = irvine_caughey_roots(item["lambda_squared"], len(want))
        out["irvine_caughey"] = max(out["irvine_caughey"], float(np.max(np.abs(np.subtract(got, want)))))
    return out


def check(paths):
    """Compare every file, print the largest deviation per quantity, return whether all are within bounds."""
    worst, fine = {}, True
    for path in paths:
        with open(path, encoding="utf-8") as handle:
            data = json.load(handle)
        deviations = compare_catenary(data) if "elastic_catenary" in data else compare_case(data)
        misses = [f"{k} {v:.3g}" for k, v in deviations.items() if not v <= TOLERANCES[k][0]]
        print(f"{'MISS' if misses else 'ok  '} {path}" + (": " + ", ".join(misses) if misses else ""))
        fine = fine and not misses
        for key, value in deviations.items():
            if key not in worst or not value <= worst[key][0]:
                worst[key] = (value, path)
    print(f"\n{'quantity':18}{'largest':>11}{'allowed':>11}  measured as; file")
    for key, (tolerance, meaning) in TOLERANCES.items():
        if key in worst:
            print(f"{key:18}{worst[key][0]:11.3g}{tolerance:11.3g}  {meaning}; {worst[key][1]}")
    return fine


def load_scenario(path):
    """A scenario from a file; of a case file its "scenario"."""
    with (sys.stdin if path == "-" else open(path, encoding="utf-8")) as handle:
        data = json.load(handle)
    return data["scenario"] if isinstance(data, dict) and "scenario" in data else data


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("files", nargs="+", metavar="FILE", help="scenario or case file; - reads standard input")
    parser.add_argument("--case", action="store_true", help="print scenario and expected values as a case file")
    parser.add_argument("--check", action="store_true", help="compare with stored case files")
    parser.add_argument("--max-speed", type=float, default=DEFAULT_MAX_SPEED, help="end of the search, m/s")
    parser.add_argument("--step", type=float, default=DEFAULT_STEP, help="step of the search, m/s")
    options = parser.parse_args()
    if options.check:
        return 0 if check(options.files) else 1
    if len(options.files) != 1:
        parser.error("one file at a time unless --check is given")
    try:
        scenario = load_scenario(options.files[0])
        result = analyse(scenario, options.max_speed, options.step)
    except (BadScenario, json.JSONDecodeError, OSError) as error:
        print(f"{options.files[0]}: {error}", file=sys.stderr)
        return 2
    if options.case:
        json.dump({"scenario": scenario, "expected": as_expected(result)}, sys.stdout, indent=1)
    else:
        json.dump(as_analysis(result), sys.stdout, indent=1)
    print()
    return 0


if __name__ == "__main__":
    sys.exit(main())
