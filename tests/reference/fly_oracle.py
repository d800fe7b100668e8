#!/usr/bin/env python3
"""Flights by scipy's explicit DOP853, for tests/flight.rs; shares no code with the project.

    fly_oracle.py CASE.json     the case with its "summary" and "samples" computed anew

CASE.json has "scenario", "path", "profile" (quintic only), "hold" and "kick" as the files in flights/ have.

Statics are those of oracle.py at Chebyshev points along the path; lengths, node positions and end forces between
them, and their derivatives in s, come from the polynomials through these.  The equations are those of docs/theory.md
section 14, assembled as dense matrices over all nodes.  The flight is computed twice, with tolerances of 1e-8 and
1e-10, and "agreement" says how far the two are apart.
"""

import json
import sys

import numpy as np
from numpy.polynomial.chebyshev import Chebyshev
from scipy.integrate import solve_ivp

import oracle

POINTS = 40


class Flight:
    def __init__(self, case):
        self.robot = oracle.Robot(case["scenario"])
        self.robot.secant = False
        self.start = np.array(case["path"]["start"])
        self.d = np.array(case["path"]["direction"])
        self.distance = case["path"]["distance"]
        assert case["profile"]["kind"] == "quintic"
        self.duration = 15.0 * self.distance / (8.0 * case["profile"]["v"])
        self.end = self.duration + case["hold"]
        self.kick = np.zeros(2) if case["kick"] is None else np.array(case["kick"])
        n, count = self.robot.n, len(self.robot.anchors)
        # Node numbers along each cable: the platform, the inner ones, and -1 for the winch.
        self.nodes = [[0] + [1 + i * (n - 1) + k for k in range(n - 1)] + [-1] for i in range(count)]
        self.free = 1 + count * (n - 1)
        s = 0.5 * self.distance * (1.0 - np.cos(np.pi * (np.arange(POINTS) + 0.5) / POINTS))
        rows = []
        for value in s:
            self.robot.p = self.start + value * self.d
            P, L, _ = oracle.solve_statics(self.robot)
            r = np.zeros((self.free, 2))
            for i in range(count):
                cable = self.robot.cable(i)
                offsets = oracle.cable_shape(P[i], L[i], cable.weight_per_length(), cable)[3]
                for k, node in enumerate(self.nodes[i][:-1]):
                    r[node] = self.robot.p + offsets[k]
            rows.append(np.concatenate([L, P.ravel(), r.ravel()]))
        columns = np.array(rows).T
        fits = [Chebyshev.fit(s, column, POINTS - 1, domain=[0.0, self.distance]) for column in columns]
        coefficients = np.array([fit.coef for fit in fits]).T
        derive = np.polynomial.chebyshev.chebder
        scale = 2.0 / self.distance
        self.series = [coefficients, derive(coefficients) * scale, derive(coefficients, 2) * scale**2]
        print(f"last coefficients {np.abs(coefficients[-5:]).max():.1e}", file=sys.stderr)

    def profile(self, t):
        if t >= self.duration:
            return self.distance, 0.0, 0.0
        T, D, x = self.duration, self.distance, t / self.duration
        return (D * (10 * x**3 - 15 * x**4 + 6 * x**5), D / T * (30 * x**2 - 60 * x**3 + 30 * x**4),
                D / T**2 * (60 * x - 180 * x**2 + 120 * x**3))

    def quasi_static(self, t):
        s, v, a = self.profile(t)
        x = 2.0 * s / self.distance - 1.0
        z, z1, z2 = (np.polynomial.chebyshev.chebval(x, c) for c in self.series)
        count = len(self.robot.anchors)
        cut = lambda y: (y[:count], y[count:3 * count].reshape(count, 2), y[3 * count:].reshape(self.free, 2))
        (L, P, r), (L1, _, r1), (L2, _, _) = cut(z), cut(z1), cut(z2)
        return L, v * L1, v * v * L2 + a * L1, P, r, v * r1

    def forces(self, i, r, L):
        """Spans, unit vectors and forces of the elements of cable i."""
        robot = self.robot
        positions = np.vstack([r[self.nodes[i][:-1]], robot.anchors[i]])
        span = np.diff(positions, axis=0)
        size = np.hypot(span[:, 0], span[:, 1])
        stretch = size / (L[i] / robot.n)
        EA = robot.EA[i]
        N = 0.5 * EA * (stretch**3 - stretch) if robot.strain[i] == "green" else EA * (stretch - 1.0)
        return positions, span / size[:, None], N

    def mass(self, L):
        M = np.zeros((self.free + 1, self.free + 1))
        M[0, 0] = self.robot.mass
        for i, nodes in enumerate(self.nodes):
            m = self.robot.mu[i] * L[i] / self.robot.n
            for k in range(self.robot.n):
                M[np.ix_(nodes[k:k + 2], nodes[k:k + 2])] += m * np.array([[1 / 3, 1 / 6], [1 / 6, 1 / 3]])
        return M[:-1, :-1]

    def slope(self, t, y):
        robot, n = self.robot, self.robot.n
        r, v = y.reshape(2, self.free, 2)
        L, L1, L2, P, _, v_qs = self.quasi_static(t)
        M = self.mass(L)
        F = np.zeros((self.free + 1, 2))
        F[0, 1] -= robot.mass * robot.g
        F[:-1] -= robot.alpha * M @ (v - v_qs)
        for i, nodes in enumerate(self.nodes):
            positions, e, N = self.forces(i, r, L)
            velocities = np.vstack([v[nodes[:-1]], np.zeros(2)])
            deviating = np.vstack([(v - v_qs)[nodes[:-1]], np.zeros(2)])
            _, C, K = oracle.element_matrices(L[i], L1[i], L2[i], robot.mu[i], n)
            blocks = robot.beta * oracle.elastic_blocks(P[i], L[i], robot.cable(i))
            half = np.array([0.0, 0.5 * robot.mu[i] * robot.g * L[i] / n])
            for k in range(n):
                pair = slice(k, k + 2)
                force = -C[k] @ velocities[pair] - K[k] @ positions[pair] - half
                pull = N[k] * e[k] + blocks[k] @ (deviating[k + 1] - deviating[k])
                F[nodes[k]] += force[0] + pull
                F[nodes[k + 1]] += force[1] - pull
        return np.concatenate([v.ravel(), np.linalg.solve(M, F[:-1]).ravel()])

    def fly(self, tolerance, times):
        L, _, _, _, r, v = self.quasi_static(0.0)
        impulse = np.zeros((self.free, 2))
        impulse[0] = self.kick
        v = v + np.linalg.solve(self.mass(L), impulse)
        y, states = np.concatenate([r.ravel(), v.ravel()]), []
        # The move and the hold apart: the third derivative of s jumps between them.
        for a, b in [(0.0, self.duration), (self.duration, self.end)]:
            inside = times[(times >= a) & ((times < b) | (b == self.end))]
            found = solve_ivp(self.slope, (a, b), y, method="DOP853", rtol=tolerance, atol=1e-2 * tolerance,
                              t_eval=np.union1d(inside, [b]))
            assert found.success, found.message
            states.extend(found.y.T[:len(inside)])
            y = found.y[:, -1]
        return np.array(states)

    def sample(self, t, y):
        r, v = y.reshape(2, self.free, 2)
        s, speed, a = self.profile(t)
        L = self.quasi_static(t)[0]
        platform, winch, least = [], [], np.inf
        for i in range(len(L)):
            _, e, N = self.forces(i, r, L)
            half = np.array([0.0, 0.5 * self.robot.mu[i] * self.robot.g * L[i] / self.robot.n])
            platform.append(float(np.hypot(*(N[0] * e[0] - half))))
            winch.append(float(N[-1]))
            least = min(least, float(N.min()))
        return {"t": t, "s": s, "v": speed, "a": a, "deviation": list(r[0] - self.start - s * self.d),
                "deviation_velocity": list(v[0] - speed * self.d), "tension_at_platform": platform,
                "element_force_at_winch": winch, "smallest_element_force": least, "unstretched_length": list(L)}


def main():
    with open(sys.argv[1]) as file:
        case = json.load(file)
    flight = Flight(case)
    times = np.linspace(0.0, flight.end, 21)
    grid = np.linspace(flight.duration, flight.end, 501)
    every = np.unique(np.concatenate([times, grid]))
    coarse, fine = (flight.fly(tolerance, every) for tolerance in (1e-8, 1e-10))
    platform = fine[:, :2]
    after = every >= flight.duration
    away = np.hypot(*(platform[after] - flight.start - flight.distance * flight.d).T)
    case["summary"] = {"duration_of_move": flight.duration, "end": flight.end, "residual_max_m": float(away.max()),
                       "residual_max_at_s": float(every[after][away.argmax()])}
    case["agreement"] = {"platform_m": float(np.abs(coarse[:, :2] - platform).max())}
    case["samples"] = [flight.sample(float(t), fine[np.searchsorted(every, t)]) for t in times]
    json.dump(case, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
