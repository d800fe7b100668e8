//! The value of one number at which the critical speed is the one that is wanted.
//!
//! The range is cut into stretches by a list of values. Each stretch is searched by itself, so that workers can share them
//! out, and [`together`] picks the value nearest to the present one. Within a stretch the critical speed v(p) may change
//! continuously, jump where another mode comes first, or not exist. A change of the sign of v(p) − v* between two values is
//! followed by secants and halvings. They end at a value with v(p) = v*, or at a jump across v*, which does not count. Where
//! v(p) is nearer to v* than at both neighbours, a golden section looks whether it gets to v* in between.
//!
//! A robot may have more crossings than this finds: two within one stretch are seen only where v(p) turns there towards v*.

use crate::robot::{Motion, Robot};
use crate::stability::steps::finish;
use crate::study::Verdict;
use crate::study::verdict::verdict_in_steps;
use crate::study::what_if::{Variant, Varied};

/// A value counts as reached where the critical speed is the wanted one within this part of it.
pub const REACHED: f64 = 1e-6;
/// The search goes on until it is within this part, where rounding lets it.
const AIM: f64 = 1e-8;
/// A change of the value by less than this part of it is none: what is still apart on both sides is a jump.
const NARROWEST: f64 = 1e-13;
/// The most halvings and secants together.
const MOST_STEPS: usize = 120;
/// Halvings towards the border of what is feasible.
const TO_BORDER: usize = 30;
/// Steps of the golden section towards a turning point: each leaves 0.618 of the interval.
const TO_TURN: usize = 26;
/// The golden section's part.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// The question: at which value of a number is the critical speed `target`?
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Reach {
    /// The number with the values that cut its range into stretches, in rising order.
    pub number: Varied,
    /// The wanted critical speed v* in m/s, greater than 0.
    pub target: f64,
    /// Critical speeds are searched up to this speed in m/s, finite and not below `target`.
    pub limit: f64,
}

/// A value and the critical speed there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct At {
    /// The value in SI units.
    pub value: f64,
    /// The critical speed in m/s.
    pub speed: f64,
}

/// What is found in one stretch.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Stretch {
    /// Values with the wanted critical speed.
    pub reached: Vec<At>,
    /// The highest critical speed below the wanted one that was seen.
    pub below: Option<At>,
    /// The lowest critical speed above the wanted one that was seen.
    pub above: Option<At>,
}

/// What is found in all of the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reached {
    /// At this value, the nearest to the present one, the critical speed is the wanted one within [`REACHED`].
    Reached(At),
    /// No value was found. These are the nearest critical speeds on either side that were seen: at the values of the list,
    /// towards turning points and at jumps that were followed.
    NotReached {
        /// The highest one below.
        below: Option<At>,
        /// The lowest one above.
        above: Option<At>,
    },
}

impl Reach {
    /// How many stretches there are.
    pub fn len(&self) -> usize {
        self.number.values.len()
    }

    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What is found between a value and the next, in [steps](crate::stability::steps); at the last value, what is found
    /// there. `variant` gets one value.
    pub async fn stretch_in_steps(&self, variant: &Variant<'_>, place: usize) -> Stretch {
        let mut search = Search { variant, reach: self, found: Stretch::default() };
        search.run(place).await;
        search.found
    }
}

/// The value of `reach`'s number, nearest to `present`, at which the critical speed is the wanted one.
pub fn reach(reach: &Reach, variant: &Variant<'_>, present: f64) -> Reached {
    let stretches: Vec<Stretch> = (0..reach.len()).map(|k| finish(reach.stretch_in_steps(variant, k))).collect();
    together(stretches.iter(), present)
}

/// Of all stretches the value nearest to `present`, or how far the critical speed gets.
pub fn together<'a>(stretches: impl Iterator<Item = &'a Stretch> + Clone, present: f64) -> Reached {
    let away = |at: &At| (at.value - present).abs();
    let nearest = stretches.clone().flat_map(|stretch| &stretch.reached).min_by(|a, b| away(a).total_cmp(&away(b)));
    if let Some(at) = nearest {
        return Reached::Reached(*at);
    }
    let below = stretches.clone().filter_map(|stretch| stretch.below).max_by(|a, b| a.speed.total_cmp(&b.speed));
    let above = stretches.filter_map(|stretch| stretch.above).min_by(|a, b| a.speed.total_cmp(&b.speed));
    Reached::NotReached { below, above }
}

/// What is known at a value: the critical speed in m/s, infinite where there is none up to the limit; `None` where there is
/// no equilibrium, where it could not be computed, and where the value is not physical.
type Seen = Option<f64>;

struct Search<'a> {
    variant: &'a Variant<'a>,
    reach: &'a Reach,
    found: Stretch,
}

impl Search<'_> {
    async fn run(&mut self, place: usize) {
        let Reach { number: Varied { values, .. }, target, .. } = self.reach;
        let Some(&here) = values.get(place) else { return };
        let speed = self.at(here).await;
        if let Some(speed) = speed.filter(|speed| self.is_reached(*speed, AIM)) {
            self.found.reached.push(At { value: here, speed });
            return;
        }
        let next = values.get(place + 1).copied();
        let at_next = match next {
            Some(next) => self.at(next).await,
            None => None,
        };
        if let Some(next) = next
            && let Some(at) = self.between((here, speed), (next, at_next)).await
        {
            self.found.reached.push(at);
        }
        // A turning point towards the target, where neither neighbour is nearer to it nor on its other side.
        let Some(speed) = speed.filter(|speed| speed.is_finite()) else { return };
        let before = place.checked_sub(1).and_then(|before| values.get(before)).copied();
        let at_before = match before {
            Some(before) => self.at(before).await,
            None => None,
        };
        let farther = |other: Seen| {
            other.is_none_or(|other| (other >= *target) == (speed >= *target) && self.away(other) >= self.away(speed))
        };
        if farther(at_before) && farther(at_next) {
            self.turn([before.unwrap_or(here), next.unwrap_or(here)], (here, speed)).await;
        }
    }

    fn away(&self, speed: f64) -> f64 {
        (speed - self.reach.target).abs()
    }

    fn is_reached(&self, speed: f64, part: f64) -> bool {
        self.away(speed) <= part * self.reach.target
    }

    fn is_above(&self, speed: f64) -> bool {
        speed >= self.reach.target
    }

    /// The critical speed at a value; the nearest ones on both sides are remembered.
    async fn at(&mut self, value: f64) -> Seen {
        let (robot, motion) = (self.variant)(&[value])?;
        let speed = critical(&robot, &motion, self.reach.limit).await?;
        if speed.is_finite() {
            let above = self.is_above(speed);
            let side = if above { &mut self.found.above } else { &mut self.found.below };
            let nearer = |best: &At| if above { speed < best.speed } else { speed > best.speed };
            if side.as_ref().is_none_or(nearer) {
                *side = Some(At { value, speed });
            }
        }
        Some(speed)
    }

    /// A crossing between two values, where they tell that there is one.
    async fn between(&mut self, a: (f64, Seen), b: (f64, Seen)) -> Option<At> {
        match (a, b) {
            ((a, Some(at_a)), (b, Some(at_b))) => self.root((a, at_a), (b, at_b)).await,
            ((a, Some(at_a)), (gap, None)) | ((gap, None), (a, Some(at_a))) => self.near_border((a, at_a), gap).await,
            ((_, None), (_, None)) => None,
        }
    }

    /// A crossing between a value with a critical speed and the border of those that have none.
    async fn near_border(&mut self, mut known: (f64, f64), mut gap: f64) -> Option<At> {
        for _ in 0..TO_BORDER {
            let middle = 0.5 * (known.0 + gap);
            match self.at(middle).await {
                None => gap = middle,
                Some(speed) if self.is_above(speed) != self.is_above(known.1) => {
                    return self.root(known, (middle, speed)).await;
                }
                Some(speed) => known = (middle, speed),
            }
        }
        None
    }

    /// The crossing between two values on different sides: by secants and halvings in turn, so that a jump is closed in as
    /// surely as a steep curve. `None` at a jump, and where both are on one side.
    async fn root(&mut self, mut a: (f64, f64), mut b: (f64, f64)) -> Option<At> {
        if self.is_above(a.1) == self.is_above(b.1) {
            return None;
        }
        for i in 0..MOST_STEPS {
            let width = b.0 - a.0;
            if width.abs() <= NARROWEST * (a.0.abs() + b.0.abs()) {
                break;
            }
            let part = (self.reach.target - a.1) / (b.1 - a.1);
            let secant = i % 2 == 0 && part.is_finite() && a.1.is_finite() && b.1.is_finite();
            let x = a.0 + width * if secant { part.clamp(0.01, 0.99) } else { 0.5 };
            let Some(speed) = self.at(x).await else {
                // Something within has no equilibrium: up to it from either side.
                let from_a = self.near_border_alone(a, x).await;
                return match from_a {
                    Some(at) => Some(at),
                    None => self.near_border_alone(b, x).await,
                };
            };
            if self.is_reached(speed, AIM) {
                return Some(At { value: x, speed });
            }
            if self.is_above(speed) == self.is_above(a.1) {
                a = (x, speed);
            } else {
                b = (x, speed);
            }
        }
        let nearer = if self.away(a.1) <= self.away(b.1) { a } else { b };
        self.is_reached(nearer.1, REACHED).then_some(At { value: nearer.0, speed: nearer.1 })
    }

    /// As [`Self::near_border`], where the crossing before it is halved alone: a function that calls itself would have a size
    /// without end.
    async fn near_border_alone(&mut self, mut known: (f64, f64), mut other: f64) -> Option<At> {
        for _ in 0..MOST_STEPS {
            let middle = 0.5 * (known.0 + other);
            match self.at(middle).await {
                Some(speed) if self.is_reached(speed, REACHED) => return Some(At { value: middle, speed }),
                Some(speed) if self.is_above(speed) == self.is_above(known.1) => known = (middle, speed),
                _ => other = middle,
            }
            if (known.0 - other).abs() <= NARROWEST * (known.0.abs() + other.abs()) {
                break;
            }
        }
        None
    }

    /// Looks by golden section for the speed nearest to the target between two values around `here`. Where it gets to the
    /// other side, there is a crossing before and one behind.
    async fn turn(&mut self, [mut low, mut high]: [f64; 2], here: (f64, f64)) {
        let above = self.is_above(here.1);
        let mut best = here;
        for _ in 0..TO_TURN {
            // The longer side of what is left.
            let upward = high - best.0 > best.0 - low;
            let end = if upward { high } else { low };
            let x = best.0 + (1.0 - GOLDEN) * (end - best.0);
            let speed = self.at(x).await;
            if let Some(speed) = speed
                && (self.is_above(speed) != above || self.is_reached(speed, AIM))
            {
                let near = self.root(best, (x, speed)).await;
                let at_end = self.at(end).await;
                let far = self.between((x, Some(speed)), (end, at_end)).await;
                let touches = self.is_reached(speed, AIM).then_some(At { value: x, speed });
                self.found.reached.extend([near, far, touches].into_iter().flatten());
                return;
            }
            match speed {
                Some(speed) if self.away(speed) < self.away(best.1) => {
                    if upward {
                        low = best.0;
                    } else {
                        high = best.0;
                    }
                    best = (x, speed);
                }
                _ if upward => high = x,
                _ => low = x,
            }
        }
        if self.is_reached(best.1, REACHED) {
            self.found.reached.push(At { value: best.0, speed: best.1 });
        }
    }
}

/// The critical speed, infinite where there is none up to the limit.
async fn critical(robot: &Robot, motion: &Motion, limit: f64) -> Seen {
    match verdict_in_steps(robot, motion, limit).await.0 {
        Verdict::Critical(critical) => Some(critical.speed),
        Verdict::NoneUpTo(_) => Some(f64::INFINITY),
        Verdict::Infeasible | Verdict::Unknown | Verdict::NotConverged => None,
    }
}
