//! Cubic splines through points of the plane, with continuous second derivatives, and their arc length.

use crate::robot::Vec2;

/// Parts of a spline's segment in which Gauss's rule begins to find the arc length.
const PARTS: usize = 8;
/// A part is halved at most so many times: where the curve nearly stops or turns back, its speed is as good as broken.
const HALVINGS: usize = 24;
/// Halvings of all parts together, for each part: no spline costs more, whatever rounding does to it.
const HALVINGS_PER_PART: usize = 64;
/// Nodes and weights of Gauss's rule with eight points over −1 … 1, the positive nodes.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];
/// Newton's method finds a parameter from its arc length in fewer steps.
const NEWTON_STEPS: usize = 60;

/// What holds at both ends of a spline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ends {
    /// The second derivative is zero.
    Natural,
    /// The first derivative is zero.
    AtRest,
}

/// A cubic spline p(u) through points, with its arc length s(u).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spline {
    /// Rising, at least two.
    knots: Vec<f64>,
    points: Vec<Vec2>,
    /// p'' at the knots.
    seconds: Vec<Vec2>,
    /// Parameters in rising order with their arc length.
    arcs: Vec<[f64; 2]>,
}

impl Spline {
    /// Through `points` at `knots`, which rise; `None` of fewer than two.
    pub fn new(knots: Vec<f64>, points: Vec<Vec2>, ends: Ends) -> Option<Self> {
        let rising = knots.windows(2).all(|pair| pair[1] > pair[0]);
        if knots.len() < 2 || knots.len() != points.len() || !rising {
            return None;
        }
        let seconds = seconds(&knots, &points, ends);
        let mut spline = Self { knots, points, seconds, arcs: Vec::new() };
        spline.arcs = spline.measured();
        Some(spline)
    }

    /// Parameters in rising order with their arc length, so close that Gauss's rule is exact to rounding between them: a part
    /// is halved until its two halves are together as long as the whole.
    fn measured(&self) -> Vec<[f64; 2]> {
        let mut parts = Vec::new();
        for pair in self.knots.windows(2) {
            let place = |part: usize| pair[0] + (pair[1] - pair[0]) * part as f64 / PARTS as f64;
            for part in 0..PARTS {
                let (from, to) = (place(part), if part + 1 == PARTS { pair[1] } else { place(part + 1) });
                parts.push((from, to, self.length_between(from, to), HALVINGS));
            }
        }
        let mut left = HALVINGS_PER_PART * parts.len();
        let rounding = f64::EPSILON * parts.iter().map(|part| part.2).sum::<f64>();
        parts.reverse();
        let (mut arcs, mut length) = (vec![[self.start(), 0.0]], 0.0);
        while let Some((from, to, whole, halvings)) = parts.pop() {
            let middle = 0.5 * (from + to);
            let [first, second] = [self.length_between(from, middle), self.length_between(middle, to)];
            if halvings > 0 && left > 0 && (first + second - whole).abs() > rounding {
                left -= 1;
                parts.extend([(middle, to, second, halvings - 1), (from, middle, first, halvings - 1)]);
            } else {
                arcs.extend([[middle, length + first], [to, length + first + second]]);
                length += first + second;
            }
        }
        arcs
    }

    /// The first knot.
    pub fn start(&self) -> f64 {
        self.knots.first().copied().unwrap_or_default()
    }

    /// The last knot.
    pub fn end(&self) -> f64 {
        self.knots.last().copied().unwrap_or_default()
    }

    /// The length of the whole.
    pub fn length(&self) -> f64 {
        self.arcs.last().map_or(0.0, |last| last[1])
    }

    /// p, p' and p'' at u, which is between the ends.
    pub fn at(&self, u: f64) -> [Vec2; 3] {
        let after = self.knots.partition_point(|knot| *knot <= u).clamp(1, self.knots.len() - 1);
        let (left, right) = (after - 1, after);
        let h = self.knots[right] - self.knots[left];
        let b = (u - self.knots[left]) / h;
        let a = 1.0 - b;
        let (low, high) = (self.seconds[left], self.seconds[right]);
        let bend = |part: f64| part * (part * part - 1.0) * h * h / 6.0;
        let turn = |part: f64| (3.0 * part * part - 1.0) * h / 6.0;
        [
            self.points[left] * a + self.points[right] * b + low * bend(a) + high * bend(b),
            (self.points[right] - self.points[left]) / h - low * turn(a) + high * turn(b),
            low * a + high * b,
        ]
    }

    /// Whether the curve never turns back on itself at a point: there it would have no tangent.
    pub fn is_smooth(&self) -> bool {
        let mut tangents = self.arcs.iter().map(|[u, _]| self.at(*u)[1]);
        let Some(mut last) = tangents.next() else { return false };
        tangents.all(|tangent| {
            let on = tangent.dot(&last) > 0.0;
            last = tangent;
            on
        })
    }

    /// The arc length at u.
    pub fn arc_length(&self, u: f64) -> f64 {
        let after = self.arcs.partition_point(|[at, _]| *at <= u).clamp(1, self.arcs.len());
        let [from, length] = self.arcs[after - 1];
        length + self.length_between(from, u)
    }

    /// The parameter at arc length s, between 0 and the whole.
    pub fn parameter(&self, s: f64) -> f64 {
        let after = self.arcs.partition_point(|[_, length]| *length <= s).clamp(1, self.arcs.len() - 1);
        let ([mut low, before], [mut high, _]) = (self.arcs[after - 1], self.arcs[after]);
        let from = low;
        let part = self.arcs[after][1] - before;
        let mut u = if part > 0.0 { low + (high - low) * ((s - before) / part).clamp(0.0, 1.0) } else { high };
        let rounding = f64::EPSILON * (self.end() - self.start());
        for _ in 0..NEWTON_STEPS {
            let excess = before + self.length_between(from, u) - s;
            if excess == 0.0 {
                return u;
            }
            *(if excess > 0.0 { &mut high } else { &mut low }) = u;
            let step = excess / self.at(u)[1].norm();
            let next = u - step;
            // Where the curve hardly moves, or Newton's step leads away, halving does.
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - u).abs() <= rounding {
                return next;
            }
            u = next;
        }
        u
    }

    /// The arc length from one parameter to another of the same part.
    fn length_between(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let speed = |node: f64| self.at(middle + half * node)[1].norm();
        half * GAUSS.iter().map(|[node, weight]| weight * (speed(*node) + speed(-node))).sum::<f64>()
    }
}

/// p'' at the knots, by the tridiagonal equations that make p' continuous.
fn seconds(knots: &[f64], points: &[Vec2], ends: Ends) -> Vec<Vec2> {
    let last = knots.len() - 1;
    let step = |i: usize| knots[i + 1] - knots[i];
    let slope = |i: usize| (points[i + 1] - points[i]) / step(i);
    // Rows of lower, middle, upper diagonal and right side.
    let row = |i: usize| -> (f64, f64, f64, Vec2) {
        match (i, ends) {
            (0, Ends::AtRest) => (0.0, step(0) / 3.0, step(0) / 6.0, slope(0)),
            (i, Ends::AtRest) if i == last => (step(i - 1) / 6.0, step(i - 1) / 3.0, 0.0, -slope(i - 1)),
            (i, Ends::Natural) if i == 0 || i == last => (0.0, 1.0, 0.0, Vec2::zeros()),
            _ => (step(i - 1) / 6.0, (step(i - 1) + step(i)) / 3.0, step(i) / 6.0, slope(i) - slope(i - 1)),
        }
    };
    let mut upper = vec![0.0; last + 1];
    let mut values = vec![Vec2::zeros(); last + 1];
    for i in 0..=last {
        let (lower, middle, up, right) = row(i);
        let (above, before) = if i == 0 { (0.0, Vec2::zeros()) } else { (upper[i - 1], values[i - 1]) };
        let pivot = middle - lower * above;
        upper[i] = up / pivot;
        values[i] = (right - before * lower) / pivot;
    }
    for i in (0..last).rev() {
        let next = values[i + 1];
        values[i] -= next * upper[i];
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Points of a circle of radius 2 m, at their angles, from 0 to 90°.
    fn quarter(count: usize, ends: Ends) -> Spline {
        let angles: Vec<f64> = (0..=count).map(|i| FRAC_PI_2 * i as f64 / count as f64).collect();
        let points = angles.iter().map(|angle| 2.0 * Vec2::new(angle.cos(), angle.sin())).collect();
        Spline::new(angles, points, ends).expect("a spline")
    }

    /// Inside, where the ends do not matter, a spline converges to the curve; its length with order 4 at least.
    #[test]
    fn a_spline_through_a_circle_is_nearly_one() {
        let error = |count| {
            let spline = quarter(count, Ends::Natural);
            let of = |u: f64| spline.at(u * FRAC_PI_2).map(|derivative| (derivative.norm() - 2.0).abs());
            let all = (0..50).map(|i| of(0.4 + 0.004 * f64::from(i)));
            all.fold([0.0_f64; 3], |most, error| [0, 1, 2].map(|order| most[order].max(error[order])))
        };
        let (coarse, fine) = (error(16), error(32));
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            assert!(fine < 0.3 * coarse && coarse < 1e-2, "{coarse} {fine}");
        }
    }

    /// p passes through its points, p' and p'' are the derivatives and continuous, and the ends are as they should be.
    #[test]
    fn derivatives_are_those_of_the_curve() {
        let knots = vec![0.0, 0.7, 1.5, 3.0];
        let points: Vec<Vec2> = [[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [2.0, -1.0]].map(Vec2::from).to_vec();
        for ends in [Ends::Natural, Ends::AtRest] {
            let spline = Spline::new(knots.clone(), points.clone(), ends).expect("a spline");
            for (knot, point) in knots.iter().zip(&points) {
                assert!((spline.at(*knot)[0] - point).norm() < 1e-14);
            }
            let h = 1e-5;
            for u in [0.1, 0.71, 1.1, 1.51, 2.2] {
                let [at, before, after] = [u, u - h, u + h].map(|u| spline.at(u));
                for order in 0..2 {
                    let slope = (after[order] - before[order]) / (2.0 * h);
                    assert!((slope - at[order + 1]).norm() < 1e-4, "{ends:?} {u} {order}");
                }
            }
            let order = if ends == Ends::Natural { 2 } else { 1 };
            for u in [0.0, 3.0] {
                assert!(spline.at(u)[order].norm() < 1e-13, "{ends:?} {u}");
            }
        }
    }

    /// The arc length is that of a fine polygon, and the parameter its inverse, also where the curve begins at rest.
    #[test]
    fn arc_length_and_parameter_are_inverse() {
        let points: Vec<Vec2> = [[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [2.0, -1.0]].map(Vec2::from).to_vec();
        for ends in [Ends::Natural, Ends::AtRest] {
            let spline = Spline::new(vec![0.0, 0.7, 1.5, 3.0], points.clone(), ends).expect("a spline");
            let polygon = |pieces: usize| -> f64 {
                let at = |i: usize| spline.at(3.0 * i as f64 / pieces as f64)[0];
                (0..pieces).map(|i| (at(i + 1) - at(i)).norm()).sum()
            };
            // Richardson: a polygon's length is off by the square of its sides.
            let limit = (4.0 * polygon(20_000) - polygon(10_000)) / 3.0;
            assert!((spline.length() - limit).abs() < 1e-8, "{ends:?}: {} {limit}", spline.length());
            for part in [0.0, 1e-6, 0.1, 0.37, 0.5, 0.999, 1.0] {
                let s = part * spline.length();
                let back = spline.arc_length(spline.parameter(s));
                assert!((back - s).abs() < 1e-12 * spline.length(), "{ends:?} {part}: {back} {s}");
            }
        }
    }

    #[test]
    fn a_line_stays_a_line_and_a_way_back_is_not_smooth() {
        let on = |xs: &[f64]| -> Spline {
            let points: Vec<Vec2> = xs.iter().map(|x| Vec2::new(*x, 0.5 * x)).collect();
            let mut knots = vec![0.0];
            for pair in points.windows(2) {
                knots.push(knots[knots.len() - 1] + (pair[1] - pair[0]).norm());
            }
            Spline::new(knots, points, Ends::Natural).expect("a spline")
        };
        let line = on(&[0.0, 1.0, 4.0]);
        assert!(line.is_smooth() && (line.length() - 4.0 * 1.25_f64.sqrt()).abs() < 1e-14);
        let [p, first, second] = line.at(2.0);
        assert!((p.y - 0.5 * p.x).abs() < 1e-15 && (first.norm() - 1.0).abs() < 1e-14 && second.norm() < 1e-14);
        assert!(!on(&[0.0, 4.0, 1.0]).is_smooth());
        let quarter = quarter(8, Ends::Natural);
        assert!(quarter.is_smooth() && (quarter.length() - PI).abs() < 1e-3);
        assert_eq!(Spline::new(vec![0.0, 0.0], vec![Vec2::zeros(); 2], Ends::Natural), None);
    }
}
