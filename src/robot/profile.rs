//! How a distance is covered in time: the motion profiles.

/// A motion profile over a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// From rest to rest with s = D(10τ³ − 15τ⁴ + 6τ⁵), τ = t/T: velocity and acceleration are continuous.
    Quintic {
        /// The peak speed in m/s; T = 15 D/(8 v).
        speed: f64,
    },
    /// From rest to rest with a constant acceleration, constant speed, constant braking.
    Trapezoid {
        /// The speed in m/s; where the distance is too short for it, the peak is √(a D).
        speed: f64,
        /// In m/s².
        acceleration: f64,
    },
    /// From rest to rest with seven phases of jerk j, 0, −j, 0, −j, 0, j.
    SCurve {
        /// The speed in m/s; where the distance is too short for it, the largest peak that fits.
        speed: f64,
        /// The largest acceleration in m/s², reached only where v > a²/j.
        acceleration: f64,
        /// In m/s³.
        jerk: f64,
    },
    /// At one speed throughout, without rest at either end.
    Constant {
        /// In m/s.
        speed: f64,
    },
}

impl Profile {
    /// Whether both ends are at rest.
    pub fn is_rest_to_rest(self) -> bool {
        !matches!(self, Self::Constant { .. })
    }

    /// s(t) over the `distance` D in m, from t = 0.
    pub(super) fn timing(self, distance: f64) -> Timing {
        let mut timing = Timing::default();
        match self {
            Self::Quintic { speed } => {
                let duration = 15.0 * distance / (8.0 * speed);
                let scale = |power: i32| distance / duration.powi(power);
                let coefficients = [0.0, 0.0, 0.0, 10.0 * scale(3), -15.0 * scale(4), 6.0 * scale(5)];
                timing.pieces.push(Piece { start: 0.0, coefficients });
                timing.duration = duration;
            }
            Self::Trapezoid { speed, acceleration } => {
                let peak = speed.min((acceleration * distance).sqrt());
                let rise = peak / acceleration;
                let cruise = distance / peak - rise;
                timing.append(rise, acceleration, 0.0);
                timing.append(cruise, 0.0, 0.0);
                timing.append(rise, -acceleration, 0.0);
            }
            Self::SCurve { speed, acceleration, jerk } => {
                let peak = s_curve_peak(distance, speed, acceleration, jerk);
                // The largest acceleration that is reached, and how long it lasts.
                let reached = acceleration.min((peak * jerk).sqrt());
                let (ramp, plateau) = (reached / jerk, (peak / reached - reached / jerk).max(0.0));
                let cruise = (distance / peak - (2.0 * ramp + plateau)).max(0.0);
                for (duration, from, jerk) in [
                    (ramp, 0.0, jerk),
                    (plateau, reached, 0.0),
                    (ramp, reached, -jerk),
                    (cruise, 0.0, 0.0),
                    (ramp, 0.0, -jerk),
                    (plateau, -reached, 0.0),
                    (ramp, -reached, jerk),
                ] {
                    timing.append(duration, from, jerk);
                }
            }
            Self::Constant { speed } => {
                timing.pieces.push(Piece { start: 0.0, coefficients: [0.0, speed, 0.0, 0.0, 0.0, 0.0] });
                timing.duration = distance / speed;
            }
        }
        timing
    }
}

/// The peak speed of an S-curve over `distance`: `speed`, or less where the distance is too short.
fn s_curve_peak(distance: f64, speed: f64, acceleration: f64, jerk: f64) -> f64 {
    // Speeding up to v takes v/a + a/j, or 2 √(v/j) where a is not reached; on average at v/2.
    let rise = |v: f64| {
        if v * jerk > acceleration * acceleration {
            v / acceleration + acceleration / jerk
        } else {
            2.0 * (v / jerk).sqrt()
        }
    };
    if speed * rise(speed) <= distance {
        return speed;
    }
    let without_plateau = (distance * jerk.sqrt() / 2.0).powf(2.0 / 3.0);
    if without_plateau * jerk <= acceleration * acceleration {
        return without_plateau;
    }
    let ramp = acceleration / jerk;
    0.5 * acceleration * ((ramp * ramp + 4.0 * distance / acceleration).sqrt() - ramp)
}

/// s(t) as polynomials, one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Timing {
    pieces: Vec<Piece>,
    /// In seconds.
    pub duration: f64,
}

/// s = Σ cᵢ (t − start)ⁱ from `start` to the next piece's.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    start: f64,
    coefficients: [f64; 6],
}

impl Piece {
    /// s, ṡ and s̈ at time t.
    fn at(&self, time: f64) -> [f64; 3] {
        let t = time - self.start;
        let [mut s, mut v, mut a] = [0.0; 3];
        for &c in self.coefficients.iter().rev() {
            a = a * t + 2.0 * v;
            v = v * t + s;
            s = s * t + c;
        }
        [s, v, a]
    }
}

impl Timing {
    /// Adds a piece that begins where the last one ends, with `acceleration` and `jerk`; none where it takes no time.
    fn append(&mut self, duration: f64, acceleration: f64, jerk: f64) {
        if duration <= 0.0 {
            return;
        }
        let [s, v, _] = self.pieces.last().map_or([0.0; 3], |piece| piece.at(self.duration));
        let coefficients = [s, v, acceleration / 2.0, jerk / 6.0, 0.0, 0.0];
        self.pieces.push(Piece { start: self.duration, coefficients });
        self.duration += duration;
    }

    /// Where one piece ends and the next begins: there the acceleration or the jerk may jump.
    pub fn breaks(&self) -> impl Iterator<Item = f64> {
        self.pieces.iter().skip(1).map(|piece| piece.start)
    }

    /// s, ṡ and s̈ at a time from 0 to the duration; at a break those of the piece that begins, or with `left` of the one
    /// that ends.
    pub fn at(&self, time: f64, left: bool) -> [f64; 3] {
        let after = self.pieces.partition_point(|piece| if left { piece.start < time } else { piece.start <= time });
        self.pieces.get(after.saturating_sub(1)).map_or([0.0; 3], |piece| piece.at(time))
    }
}
