//! A cable of given length hung between two points, by minimising its energy.
//!
//! Independent of how the crate solves the statics, and without two branches, because the energy is convex: a length
//! has one shape, while a tension may have two. So all shapes can be listed, and the taut one told from the others.

use nalgebra::Matrix2;
use tautline::Robot;
use tautline::mechanics::CableShape;
use tautline::robot::{Strain, Vec2};

/// What a cable is made of.
pub struct Hung {
    stiffness: f64,
    strain: Strain,
    weight: f64,
    elements: usize,
}

/// The force on the platform against the unstretched length, from very taut to very slack.
pub type Curve = Vec<(f64, Vec2)>;

/// μ of cable `i` of the robot: its own, or else that of the robot.
pub fn mass_per_length(robot: &Robot, i: usize) -> f64 {
    robot.cables[i].own.mass_per_length.unwrap_or(robot.material.mass_per_length)
}

impl Hung {
    /// Cable `i` of the robot: its own values, or else those of the robot.
    pub fn of(robot: &Robot, i: usize) -> Self {
        let (own, common) = (robot.cables[i].own, robot.material);
        let modulus = own.youngs_modulus.unwrap_or(common.youngs_modulus);
        Self {
            stiffness: modulus * own.area.unwrap_or(common.area),
            strain: own.strain.unwrap_or(common.strain),
            weight: mass_per_length(robot, i) * robot.gravity,
            elements: robot.elements,
        }
    }

    /// The same cable with all forces times `factor`. Its shapes are the same.
    pub fn in_units(self, factor: f64) -> Self {
        Self { stiffness: self.stiffness * factor, weight: self.weight * factor, ..self }
    }

    /// N(λ) and dN/dλ.
    pub fn law(&self, stretch: f64) -> (f64, f64) {
        match self.strain {
            Strain::Engineering => (self.stiffness * (stretch - 1.0), self.stiffness),
            Strain::Green => (
                0.5 * self.stiffness * (stretch.powi(3) - stretch),
                0.5 * self.stiffness * (3.0 * stretch * stretch - 1.0),
            ),
        }
    }

    /// λ(N); for Green's law by Cardano's formula.
    pub fn stretch(&self, force: f64) -> f64 {
        match self.strain {
            Strain::Engineering => 1.0 + force / self.stiffness,
            Strain::Green => {
                let triple = 27.0_f64.sqrt() * force / self.stiffness;
                let cosine = if triple < 1.0 { (triple.acos() / 3.0).cos() } else { (triple.acosh() / 3.0).cosh() };
                cosine * 2.0 / 3.0_f64.sqrt()
            }
        }
    }

    /// Complementary energy ∫λ dN: N λ less the strain energy.
    fn energy(&self, force: f64, stretch: f64) -> f64 {
        let strain = match self.strain {
            Strain::Engineering => stretch - 1.0,
            Strain::Green => 0.5 * (stretch * stretch - 1.0),
        };
        force * stretch - 0.5 * self.stiffness * strain * strain
    }

    /// The force on the platform of a cable of the robot with this shape, P = t₀ − (0, w l/2).
    pub fn platform_force(&self, shape: &CableShape) -> Vec2 {
        shape.t0 - Vec2::new(0.0, 0.5 * self.weight * shape.length / self.elements as f64)
    }

    /// The force on the platform of a cable of unstretched length `length` along `chord`; none where it hangs so
    /// slack that an element carries nothing at all.
    ///
    /// Minimises Σ l ∫λ dN − P · chord over the force P: its gradient is the distance of the end from the anchor.
    pub fn force(&self, chord: Vec2, length: f64) -> Option<Vec2> {
        if self.weight == 0.0 && length >= chord.norm() {
            return None;
        }
        let l = length / self.elements as f64;
        let evaluate = |p: Vec2| {
            let (mut value, mut gradient, mut hessian) = (-p.dot(&chord), -chord, Matrix2::zeros());
            for k in 0..self.elements {
                let t = p + Vec2::new(0.0, self.weight * l * (k as f64 + 0.5));
                let (force, e) = (t.norm(), t.normalize());
                let stretch = self.stretch(force);
                value += l * self.energy(force, stretch);
                gradient += e * (l * stretch);
                let across = stretch / force;
                let along = 1.0 / self.law(stretch).1;
                hessian += (Matrix2::identity() * across + e * e.transpose() * (along - across)) * l;
            }
            (value, gradient, hessian)
        };
        // Along the chord at the cable's middle, with the tension of least energy.
        let straight = self.law((chord.norm() / length).max(1.0)).0;
        let start = |pull: f64| chord.normalize() * (straight + pull) - Vec2::new(0.0, 0.5 * self.weight * length);
        let starts = (-8..=16).map(|k| start(self.weight * length * 1.6_f64.powi(k)));
        let mut p = starts.min_by(|&a, &b| evaluate(a).0.total_cmp(&evaluate(b).0)).expect("several");
        let mut last_step = f64::INFINITY;
        for _ in 0..200 {
            let (value, gradient, hessian) = evaluate(p);
            let step = hessian.try_inverse()? * gradient;
            // Converged, and rounding keeps Newton's steps from getting smaller.
            if gradient.norm() < 1e-10 * chord.norm() && step.norm() >= 0.5 * last_step {
                return Some(p);
            }
            last_step = step.norm();
            let mut part = 1.0;
            // Towards the end rounding hides the descent: there whole steps are safe. The horizontal force is that of
            // all elements and keeps its sign.
            while gradient.norm() > 1e-6 * chord.norm()
                && (evaluate(p - step * part).0 > value - 1e-4 * part * gradient.dot(&step)
                    || (p - step * part).x / p.x < 0.2)
            {
                part *= 0.5;
                if part < 1e-9 {
                    return None;
                }
            }
            p -= step * part;
        }
        None
    }

    /// The force against the length: from 1e5 N down in steps of 15 %, then from no slack up to 200 %.
    pub fn curve(&self, chord: Vec2) -> Curve {
        let taut = (0..140).map(|k| 1.0 / self.stretch(1e5 * 1.15_f64.powi(-k)));
        let slack = (0..90).map(|k| 1.0 + 2.0 * 1.25_f64.powi(k - 89));
        let lengths = taut.chain(slack).map(|relative| relative * chord.norm());
        lengths.map_while(|length| self.force(chord, length).map(|force| (length, force))).collect()
    }

    /// The length at which the tension at the platform is least, and that tension: shorter cables are taut, longer ones
    /// slack.
    pub fn least_tension(&self, chord: Vec2) -> Option<(f64, f64)> {
        let tension = |length: f64| self.force(chord, length).map(|force| force.norm());
        let curve = self.curve(chord);
        let least = (0..curve.len()).min_by(|&i, &j| curve[i].1.norm().total_cmp(&curve[j].1.norm()))?;
        let (mut low, mut high) = (curve.get(least.checked_sub(1)?)?.0, curve.get(least + 1)?.0);
        while high - low > 1e-9 * high {
            let third = (high - low) / 3.0;
            if tension(low + third)? < tension(high - third)? { high -= third } else { low += third }
        }
        Some((low, tension(low)?))
    }
}

/// Where two cables pull with `load` together: the places on their curves, as numbers of segments.
pub fn crossings(curves: &[Curve; 2], load: Vec2) -> Vec<[usize; 2]> {
    let mut found = Vec::new();
    for (i, a) in curves[0].windows(2).enumerate() {
        for (j, b) in curves[1].windows(2).enumerate() {
            // p₀ + x (p₁ − p₀) = q₀ + y (q₁ − q₀), with q the force that is left for the first cable.
            let (p, q) = (a[1].1 - a[0].1, b[0].1 - b[1].1);
            let gap = load - b[0].1 - a[0].1;
            let (x, y) = (gap.perp(&q) / p.perp(&q), gap.perp(&p) / p.perp(&q));
            if (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) {
                found.push([i, j]);
            }
        }
    }
    found
}

/// The place of a length on a curve.
pub fn place(curve: &Curve, length: f64) -> usize {
    curve.partition_point(|(other, _)| *other < length).saturating_sub(1)
}
