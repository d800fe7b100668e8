//! The first crossing of the imaginary axis, by structure: the zeros of det Q(iω, v) over the plane of ω and v.
//!
//! An eigenvalue crosses the axis where det Q(iω, v) = 0 with ω and v real. [`Bounds`] says where in the plane that can
//! happen. Strips of that region are searched in rising order of v: a cell counts as free of zeros when ln det Q, which
//! is singular at every zero, changes along all its edges as its derivatives at their ends say; other cells are halved.
//! Newton's method gives a zero that is suspected in a cell; dividing it out lets the rest of the cell be searched like
//! any other. Where anything stays in doubt the search says so. docs/theory.md section 11.

use nalgebra::Complex;
use rustc_hash::FxHashMap;

use super::axis::Axis;
use super::bounds::Bounds;
use super::characteristic::Characteristic;
use super::count::{Count, Counter, change};
use crate::mechanics::Vibration;
use crate::stability::steps::step;

type C64 = Complex<f64>;

/// A cell is expected to hold this many of all cables' frequencies: the second number counts where the mesh tells how many
/// there are. A turn of the phase takes two, so that none is overlooked between a cell's corners.
const LARGEST_WIDTH: [f64; 2] = [1.4, 1.0];
/// A cell is at most so high that the frequencies of one cable move by this part of their spacing.
const LARGEST_MOVE: f64 = 0.35;
/// The height of a strip in m/s.
const STRIP: f64 = 0.5;
/// The largest height of a strip in m/s, at low speeds, where frequencies hardly move.
const LARGEST_STRIP: f64 = 1.0;
/// At high speeds the height of a strip is this part of the speed where it begins, or up to twice that. So the number of
/// strips grows with the logarithm of the limit.
const STRIP_PART: f64 = 0.01;
/// After this many evaluations per mode a strip is left to counting.
const EFFORT_EACH: usize = 100;
/// A strip is not left to counting before this many evaluations.
const LEAST_EFFORT: usize = 10_000;
/// Cells smaller than this part of the first ones are in doubt.
const SMALLEST_CELL: f64 = 1e-7;
/// Steps to a divergence, by Newton's method or in halves.
const BISECTIONS: u32 = 60;
/// Newton steps to a zero.
const NEWTON_STEPS: usize = 25;
/// Newton's method has ended when its step is this part of a cell.
const CONVERGED: f64 = 1e-11;
/// Two zeros nearer than this part of a cell are the same.
const SAME: f64 = 1e-6;
/// The unstable eigenvalues are counted this part of a strip below the answer. There must be none.
const BELOW: f64 = 1e-3;
/// Where the plane leaves doubt, the unstable eigenvalues are counted at speeds this far apart, in m/s.
const COUNT_STEP: f64 = 0.1;
/// At high speeds the distance is this part of the speed.
const COUNT_PART: f64 = 0.002;
/// Counts give a crossing to this part of its speed, or of 1 m/s.
const COUNTED_TO: f64 = 1e-11;
/// Where a count meets an eigenvalue on the axis, it is made again at a speed that is lower by this, in m/s.
const ASIDE: f64 = 1e-4;
/// A count is tried at most this many times.
const TRIES: u32 = 8;
/// Newton's method moves a crossing that counts have given by no more than this, in m/s.
const POLISHED: f64 = 1e-6;

/// How the search ended where it could tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Search {
    /// An eigenvalue crosses to the right at ±iω (rad/s) and v (m/s), none before.
    Crossing { omega: f64, speed: f64 },
    /// No eigenvalue crosses up to the limit.
    NoneUpTo,
}

/// Why the structured search left the critical speed to a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Doubt {
    /// There is no damping, and to first order in the speed some mode neither grows nor decays.
    Undamped,
    /// The bounds of what can cross do not hold, or leave the range of floating point.
    Unbounded,
    /// The unstable eigenvalues at a speed cannot be counted.
    Count,
}

/// What the plane does not tell of a strip: a cell has become too small, as where crossings coincide, or the effort too
/// large.
struct Unsettled;

/// The search for the first crossing, strip by strip.
#[derive(Debug)]
pub(super) struct FirstCrossing {
    plane: Plane,
    /// Nothing is unstable up to here, in m/s.
    from: f64,
    /// Where the search has begun.
    start: f64,
    limit: f64,
}

impl FirstCrossing {
    /// A search of a problem that is stable up to the speed `start`, and on to `limit` (m/s).
    ///
    /// # Errors
    /// [`Doubt::Unbounded`].
    pub(super) fn new(vibration: &Vibration, start: f64, limit: f64) -> Result<Self, Doubt> {
        let bounds = Bounds::new(vibration).ok_or(Doubt::Unbounded)?;
        let start = bounds.lowest_speed(limit).max(start).min(limit);
        let plane = Plane {
            known: FxHashMap::default(),
            trend: Trend::default(),
            zeros: Vec::new(),
            evaluations: 0,
            eligible: 0.0,
            cell: [bounds.frequency_step(0.0, LARGEST_WIDTH), STRIP],
            counter: Counter::new(bounds, Axis::new(Characteristic::new(vibration))),
        };
        Ok(Self { plane, from: start, start, limit })
    }

    /// Whether nothing is unstable where the search begins.
    pub(super) async fn begins_stable(&mut self, vibration: &Vibration) -> bool {
        self.plane.is_stable(vibration, self.start).await
    }

    /// The speed (m/s) up to which nothing crosses.
    pub(super) fn searched_up_to(&self) -> f64 {
        self.from
    }

    /// Searches the next strip, in [steps](super::steps) of a cell or less; `None` where nothing crosses in it.
    ///
    /// # Errors
    /// [`Doubt`] where that cannot be told.
    pub(super) async fn search_next_strip(&mut self, vibration: &Vibration) -> Result<Option<Search>, Doubt> {
        let (plane, from, limit) = (&mut self.plane, self.from, self.limit);
        if from >= limit {
            if plane.is_stable(vibration, limit).await {
                return Ok(Some(Search::NoneUpTo));
            }
            let found = plane.by_counting(vibration, self.start, limit).await?;
            return Ok(Some(found.unwrap_or(Search::NoneUpTo)));
        }
        let least = STRIP.max(STRIP_PART * from);
        let top = plane.counter.bounds.highest_frequency(from + least);
        let height = (LARGEST_MOVE * plane.counter.bounds.speed_step(top, from))
            .clamp(least, LARGEST_STRIP.max(2.0 * STRIP_PART * from));
        let to = limit.min(from + height);
        let searched = plane.search_strip(from, to).await;
        let first = plane.first_from(from).copied().filter(|zero| zero.speed <= to);
        let missed = plane.zeros.iter().any(|zero| zero.speed > 0.0 && zero.speed < from);
        let found = match (searched, first) {
            (Ok(()), Some(zero)) => {
                // What crosses first crosses to the right: d Re λ/dv = Im b. Below it nothing is unstable.
                let below = (zero.speed - BELOW * STRIP).max(0.5 * zero.speed);
                let stable = plane.is_stable(vibration, below).await;
                if zero.slope.im > 0.0 && stable {
                    Some(Search::Crossing { omega: zero.omega, speed: zero.speed })
                } else {
                    plane.by_counting(vibration, self.start, to).await?
                }
            }
            (Ok(()), None) if !missed => None,
            (Ok(()), None) => plane.by_counting(vibration, self.start, to).await?,
            (Err(Unsettled), _) => plane.by_counting(vibration, from, to).await?,
        };
        self.from = to;
        Ok(found)
    }
}

/// det Q(iω, v) at one point of the plane, with the strip's trend and zeros divided out.
#[derive(Clone, Copy, Debug)]
struct Corner {
    omega: f64,
    speed: f64,
    log: C64,
    by_omega: C64,
    by_speed: C64,
    /// So many of the zeros found are divided out.
    zeros: usize,
}

/// A zero, near which D is a multiple of (ω − ω₀) + b (v − v₀), where b is the ratio of D's
/// derivatives in v and in ω.
#[derive(Clone, Copy, Debug)]
struct Zero {
    omega: f64,
    speed: f64,
    /// b in rad/s per m/s: the eigenvalue moves by −i b per unit of v.
    slope: C64,
}

impl Zero {
    /// The linear factors of the zero and of its mirror image at −ω, with their derivatives in v; that in ω is 1.
    fn factors(&self, omega: f64, speed: f64) -> impl Iterator<Item = (C64, C64)> + use<> {
        let v = speed - self.speed;
        let mirrored = -self.slope.conj();
        let own = (self.slope * v + (omega - self.omega), self.slope);
        let image = (mirrored * v + (omega + self.omega), mirrored);
        std::iter::once(own).chain((self.omega != 0.0).then_some(image))
    }
}

/// Four corners, the lower two first.
#[derive(Clone, Copy, Debug)]
struct Cell {
    lower: [Corner; 2],
    upper: [Corner; 2],
}

/// What the many fast modes of a fine mesh make of ln D as v rises: a cubic polynomial p. D e^(−p) has the zeros of D.
#[derive(Clone, Copy, Debug, Default)]
struct Trend {
    from: f64,
    /// Of p in v − `from`, from the constant on.
    coefficients: [f64; 4],
}

impl Trend {
    /// The cubic with these values and slopes at two speeds.
    fn between([from, to]: [f64; 2], [a, b]: [f64; 2], [slope_a, slope_b]: [f64; 2]) -> Self {
        let h = to - from;
        let mean = (b - a) / h;
        let coefficients =
            [a, slope_a, (3.0 * mean - 2.0 * slope_a - slope_b) / h, (slope_a + slope_b - 2.0 * mean) / (h * h)];
        // Where a value is out of range there is no trend to follow.
        if coefficients.iter().all(|c| c.is_finite()) { Self { from, coefficients } } else { Self::default() }
    }

    /// p and its derivative.
    fn at(&self, speed: f64) -> [f64; 2] {
        let v = speed - self.from;
        let [a, b, c, d] = self.coefficients;
        [a + v * (b + v * (c + v * d)), b + v * (2.0 * c + v * 3.0 * d)]
    }
}

/// The plane of ω and v with what has been found in it.
#[derive(Debug)]
struct Plane {
    counter: Counter,
    /// The corners of the strip, which neighbouring cells share, by the bits of ω and v.
    known: FxHashMap<[u64; 2], Corner>,
    trend: Trend,
    zeros: Vec<Zero>,
    evaluations: usize,
    /// Up to this frequency (rad/s) crossings are possible in all of the strip.
    eligible: f64,
    /// The size of the first cells, in rad/s and m/s.
    cell: [f64; 2],
}

impl Plane {
    /// The first of the zeros from a speed on.
    fn first_from(&self, from: f64) -> Option<&Zero> {
        let from = from - SAME * self.cell[1];
        self.zeros.iter().filter(|zero| zero.speed >= from).min_by(|a, b| a.speed.total_cmp(&b.speed))
    }

    /// Whether it is certain that nothing is unstable at a speed.
    async fn is_stable(&mut self, vibration: &Vibration, speed: f64) -> bool {
        let count = self.counter.count(vibration, speed).await;
        count.is_some_and(|count| count.certain && count.unstable == 0)
    }

    /// Finds all zeros below the first one between two speeds, one column of cells after the other.
    async fn search_strip(&mut self, from: f64, to: f64) -> Result<(), Unsettled> {
        self.evaluations = 0;
        self.cell[1] = to - from;
        let mut top = self.counter.bounds.highest_frequency(to);
        self.follow_trend(from, to, top);
        self.take_divergence(from, to).await;
        if let Some(first) = self.first_from(from).filter(|zero| zero.speed < to) {
            top = self.counter.bounds.highest_frequency(first.speed);
        }
        self.eligible = self.counter.bounds.highest_frequency(from);
        let mut omega = 0.0;
        let mut left = [self.corner(omega, from), self.corner(omega, to)];
        while omega < top {
            let bounds = &self.counter.bounds;
            omega += bounds.frequency_step(omega, LARGEST_WIDTH).max(bounds.decay(omega));
            let right = [self.corner(omega, from), self.corner(omega, to)];
            self.search_cells(from, vec![Cell { lower: [left[0], right[0]], upper: [left[1], right[1]] }]).await?;
            left = right;
        }
        Ok(())
    }

    /// Takes a divergence between two speeds in that shows by the sign of det (K + v² D), so that nothing above it has to
    /// be searched: at λ = 0 neither damping nor C have a part in Q, and D is real.
    async fn take_divergence(&mut self, from: f64, to: f64) {
        let negative = |log: C64| log.im.cos() < 0.0;
        let [before, after] = [from, to].map(|speed| {
            // The corner is wanted anyway; without zeros divided out it has the sign.
            let corner = self.corner(0.0, speed);
            if corner.zeros == 0 { corner.log } else { self.counter.axis.at(C64::new(0.0, 0.0), speed).log }
        });
        if !(before.im.is_finite() && after.im.is_finite()) || negative(before) == negative(after) {
            return;
        }
        let (mut low, mut high, mut speed) = (from, to, 0.5 * (from + to));
        for _ in 0..BISECTIONS {
            let here = self.counter.axis.at(C64::new(0.0, 0.0), speed);
            if negative(here.log) == negative(before) {
                low = speed;
            } else {
                high = speed;
            }
            let newton = speed - 1.0 / here.by_speed.re;
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            if (next - speed).abs() <= CONVERGED * self.cell[1] {
                break;
            }
            speed = next;
            step().await;
        }
        if let Some(zero) = self.zero_at(0.0, speed) {
            self.zeros.push(zero);
        }
    }

    /// What is unstable at a speed, or a little below it where an eigenvalue is on the axis; with the speed.
    async fn count_near(&mut self, vibration: &Vibration, speed: f64) -> Result<(f64, Count), Doubt> {
        for k in 0..TRIES {
            let speed = speed - ASIDE * f64::from(k);
            if let Some(count) = self.counter.count(vibration, speed).await.filter(|count| count.certain) {
                return Ok((speed, count));
            }
        }
        Err(Doubt::Count)
    }

    /// The first crossing between two speeds by counting what is unstable on the way; nothing is at the first one.
    ///
    /// Cells get very small where many eigenvalues cross nearly together. A count does not, as long as it is not made
    /// where they cross. What becomes unstable and stable again between two counts is not seen, unless the plane has
    /// shown it.
    async fn by_counting(&mut self, vibration: &Vibration, from: f64, to: f64) -> Result<Option<Search>, Doubt> {
        let beyond = self.zeros.iter().map(|zero| zero.speed + BELOW * STRIP);
        let mut speeds: Vec<f64> = beyond.filter(|speed| (from..to).contains(speed)).collect();
        let steps = ((to - from) / COUNT_STEP.max(COUNT_PART * to)).ceil().max(1.0);
        let mut part = 1.0;
        while part <= steps {
            speeds.push(from + (to - from) * part / steps);
            part += 1.0;
        }
        speeds.sort_by(f64::total_cmp);
        // The next strip begins anew.
        self.zeros.clear();
        self.known.clear();
        let mut stable = from;
        for speed in speeds {
            let (speed, Count { unstable, nearest, .. }) = self.count_near(vibration, speed).await?;
            if unstable > 0 {
                return self.bisect(vibration, [stable, speed], nearest).await.map(Some);
            }
            stable = speed;
        }
        Ok(None)
    }

    /// A crossing between a speed where nothing is unstable and one where something is, near the frequency `nearest`.
    async fn bisect(
        &mut self,
        vibration: &Vibration,
        [mut stable, mut unstable]: [f64; 2],
        mut nearest: f64,
    ) -> Result<Search, Doubt> {
        while unstable - stable > COUNTED_TO * unstable.max(1.0) {
            // Where it meets an eigenvalue on the axis there is no count, but beside.
            let mut counted = None;
            for part in [0.5, 0.4, 0.6] {
                let speed = stable + part * (unstable - stable);
                counted = self.counter.count(vibration, speed).await.map(|count| (speed, count));
                if counted.is_some() {
                    break;
                }
            }
            match counted {
                Some((speed, Count { unstable: 0, .. })) => stable = speed,
                Some((speed, count)) => (unstable, nearest) = (speed, count.nearest),
                None if unstable - stable < POLISHED => break,
                None => return Err(Doubt::Count),
            }
        }
        // Newton's method knows it better, where it is alone.
        let (mut omega, mut speed) = (nearest, unstable);
        for _ in 0..NEWTON_STEPS {
            let Some(step) = newton_step(&self.at(omega, speed)) else { break };
            (omega, speed) = (omega + step[0], speed + step[1]);
            if step[0].abs() > self.cell[0] || (speed - unstable).abs() > POLISHED {
                break;
            }
            if step[0].abs() <= CONVERGED * self.cell[0] && step[1].abs() <= CONVERGED {
                return Ok(self.crossing(omega, speed));
            }
        }
        Ok(self.crossing(nearest, unstable))
    }

    /// A crossing, a divergence where the frequency is zero but for rounding.
    fn crossing(&self, omega: f64, speed: f64) -> Search {
        let omega = omega.abs();
        Search::Crossing { omega: if omega <= SAME * self.cell[0] { 0.0 } else { omega }, speed }
    }

    /// The same in the cells that are `open`, the last one first. Each part of a cell that is looked at is a step.
    async fn search_cells(&mut self, from: f64, mut open: Vec<Cell>) -> Result<(), Unsettled> {
        // The lower or left half of a cell comes before the other.
        while let Some(mut cell) = open.pop() {
            if let Some(halves) = self.halves_to_search(from, &mut cell)? {
                open.extend(halves.into_iter().rev());
            }
            step().await;
        }
        Ok(())
    }

    /// Finds what can be found in a cell as it is; its halves, where they have to be searched by themselves.
    fn halves_to_search(&mut self, from: f64, cell: &mut Cell) -> Result<Option<[Cell; 2]>, Unsettled> {
        loop {
            let after_the_first = self.first_from(from).is_some_and(|first| first.speed <= cell.lower[0].speed);
            if after_the_first || !self.is_eligible(cell) {
                return Ok(None);
            }
            cell.lower.iter_mut().chain(&mut cell.upper).for_each(|corner| self.divide_zeros_out(corner));
            let changes = self.changes(cell);
            if changes[0] <= 1.0 && changes[1] <= 1.0 {
                return Ok(None);
            }
            if let Some(zero) = self.zero_in(cell) {
                self.zeros.push(zero);
                continue;
            }
            let size = cell.size();
            let vanishing = size[0] < SMALLEST_CELL * self.cell[0] || size[1] < SMALLEST_CELL * self.cell[1];
            if vanishing || self.evaluations > LEAST_EFFORT.max(EFFORT_EACH * self.counter.bounds.modes()) {
                return Err(Unsettled);
            }
            return Ok(Some(self.halves(cell, changes)));
        }
    }

    /// D at a point, with the trend and all zeros found divided out.
    fn at(&mut self, omega: f64, speed: f64) -> Corner {
        self.evaluations += 1;
        let i = C64::new(0.0, 1.0);
        let value = self.counter.axis.at(i * omega, speed);
        let [trend, slope] = self.trend.at(speed);
        let (log, by_omega, by_speed) = (value.log - trend, i * value.by_lambda, value.by_speed - slope);
        let mut corner = Corner { omega, speed, log, by_omega, by_speed, zeros: 0 };
        self.divide_zeros_out(&mut corner);
        corner
    }

    /// The same at a corner of cells.
    fn corner(&mut self, omega: f64, speed: f64) -> Corner {
        let key = [omega.to_bits(), speed.to_bits()];
        if let Some(corner) = self.known.get(&key) {
            return *corner;
        }
        let corner = self.at(omega, speed);
        self.known.insert(key, corner);
        corner
    }

    /// Goes on to the strip between two speeds with crossings below the frequency `top`.
    fn follow_trend(&mut self, from: f64, to: f64, top: f64) {
        // To the right of the axis, further than what moves in the strip: nothing but the trend is left of it.
        let [begin, end] = [from, to].map(|speed| self.counter.axis.at(top.into(), speed));
        let trend = Trend::between([from, to], [begin.log.re, end.log.re], [begin.by_speed.re, end.by_speed.re]);
        let ([before, slope_before], [after, slope_after]) = (self.trend.at(from), trend.at(from));
        self.trend = trend;
        self.known.retain(|&[_, speed], corner| {
            corner.log += before - after;
            corner.by_speed += slope_before - slope_after;
            speed == from.to_bits()
        });
    }

    /// Divides those zeros out of a corner that were found since it was computed.
    fn divide_zeros_out(&self, corner: &mut Corner) {
        let new = &self.zeros[corner.zeros..];
        if new.is_empty() {
            return;
        }
        let mut product = C64::new(1.0, 0.0);
        for (factor, slope) in new.iter().flat_map(|zero| zero.factors(corner.omega, corner.speed)) {
            let inverse = factor.conj() / factor.norm_sqr();
            product *= factor;
            corner.by_omega -= inverse;
            corner.by_speed -= slope * inverse;
        }
        corner.log -= C64::new(0.5 * product.norm_sqr().ln(), product.arg());
        corner.zeros = self.zeros.len();
    }

    /// How far the edges are from being free of zeros, in ω and in v: at most one where they are. Infinite in v where the
    /// cell is too tall to tell.
    fn changes(&self, cell: &Cell) -> [f64; 2] {
        let (Cell { lower: [a, b], upper: [c, d] }, size) = (cell, cell.size());
        let in_omega = |a: &Corner, b: &Corner| change(b.log - a.log, a.by_omega * size[0], b.by_omega * size[0]);
        let in_speed = |a: &Corner, b: &Corner| change(b.log - a.log, a.by_speed * size[1], b.by_speed * size[1]);
        let tall = if self.is_tall(cell) { f64::INFINITY } else { 0.0 };
        [in_omega(a, b).max(in_omega(c, d)), in_speed(a, c).max(in_speed(b, d)).max(tall)]
    }

    /// Whether something can cross in the cell.
    fn is_eligible(&self, cell: &Cell) -> bool {
        let omega = cell.lower[0].omega;
        omega <= self.eligible || omega <= self.counter.bounds.highest_frequency(cell.upper[0].speed)
    }

    /// Whether frequencies may move so far within the cell that a turn of the phase could be overlooked.
    fn is_tall(&self, cell: &Cell) -> bool {
        let corner = &cell.upper[1];
        cell.size()[1] > LARGEST_MOVE * self.counter.bounds.speed_step(corner.omega, corner.speed)
    }

    /// The cell in two, the lower or left one first, across the direction in which it is less clearly free.
    fn halves(&mut self, cell: &Cell, [in_omega, in_speed]: [f64; 2]) -> [Cell; 2] {
        let ([a, b], [c, d]) = (cell.lower, cell.upper);
        if in_omega > in_speed {
            let omega = 0.5 * (a.omega + b.omega);
            let (low, high) = (self.corner(omega, a.speed), self.corner(omega, c.speed));
            [Cell { lower: [a, low], upper: [c, high] }, Cell { lower: [low, b], upper: [high, d] }]
        } else {
            let speed = 0.5 * (a.speed + c.speed);
            let (left, right) = (self.corner(a.omega, speed), self.corner(b.omega, speed));
            [Cell { lower: [a, b], upper: [left, right] }, Cell { lower: [left, right], upper: [c, d] }]
        }
    }

    /// A zero in or near the cell that has not been found before, where Newton's steps from its corners point at one.
    fn zero_in(&mut self, cell: &Cell) -> Option<Zero> {
        let corners = [cell.lower[0], cell.lower[1], cell.upper[0], cell.upper[1]];
        let start = corners.iter().find_map(|corner| {
            let [omega, speed] = newton_step(corner)?;
            let (omega, speed) = (corner.omega + omega, corner.speed + speed);
            cell.is_near(omega, speed).then_some((omega, speed))
        })?;
        let (mut omega, mut speed) = start;
        for _ in 0..NEWTON_STEPS {
            let here = self.at(omega, speed);
            let [d_omega, d_speed] = newton_step(&here)?;
            (omega, speed) = (omega + d_omega, speed + d_speed);
            if !cell.is_near(omega, speed) {
                return None;
            }
            if d_omega.abs() <= CONVERGED * self.cell[0] && d_speed.abs() <= CONVERGED * self.cell[1] {
                return self.zero_at(omega.abs(), speed);
            }
        }
        None
    }

    /// The zero at a point, if it is a new one.
    fn zero_at(&mut self, omega: f64, speed: f64) -> Option<Zero> {
        let near = SAME * self.cell[0];
        let known =
            |zero: &Zero| (zero.omega - omega).abs() <= near && (zero.speed - speed).abs() <= SAME * self.cell[1];
        if self.zeros.iter().any(known) {
            return None;
        }
        // Close by, both logarithmic derivatives are those of the zero's linear factor.
        let omega = if omega <= near { 0.0 } else { omega };
        let beside = self.at(omega + near, speed);
        let slope = beside.by_speed / beside.by_omega;
        (slope.re.is_finite() && slope.im != 0.0).then_some(Zero { omega, speed, slope })
    }
}

impl Cell {
    fn size(&self) -> [f64; 2] {
        [self.lower[1].omega - self.lower[0].omega, self.upper[0].speed - self.lower[0].speed]
    }

    /// Whether a point is in the cell, or no further from it than half its size.
    fn is_near(&self, omega: f64, speed: f64) -> bool {
        let [width, height] = self.size();
        let (from, to) = (&self.lower[0], &self.upper[1]);
        (from.omega - 0.5 * width..=to.omega + 0.5 * width).contains(&omega)
            && (from.speed - 0.5 * height..=to.speed + 0.5 * height).contains(&speed)
    }
}

/// The step in ω and v after which ln D's linear model has D = 0.
fn newton_step(corner: &Corner) -> Option<[f64; 2]> {
    let (a, b) = (corner.by_omega, corner.by_speed);
    let determinant = a.re * b.im - a.im * b.re;
    let step = [-b.im / determinant, a.im / determinant];
    step.iter().all(|part| part.is_finite()).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::paper_spec;
    use crate::stability::steps::finish;
    use crate::stability::{Eigenproblem, problems};

    fn problem() -> Vibration {
        problems::of_robot(paper_spec(), [0.0, 0.0], [1.0, 0.0])
    }

    fn plane(vibration: &Vibration) -> Plane {
        Plane {
            counter: Counter::new(Bounds::new(vibration).unwrap(), Axis::new(Characteristic::new(vibration))),
            known: FxHashMap::default(),
            trend: Trend::default(),
            zeros: Vec::new(),
            evaluations: 0,
            eligible: 0.0,
            cell: [1.0, 1.0],
        }
    }

    /// The first crossing.
    fn crossing(vibration: &Vibration) -> [f64; 2] {
        let mut search = FirstCrossing::new(vibration, 0.0, 20.0).unwrap();
        loop {
            match finish(search.search_next_strip(vibration)).unwrap() {
                None => {}
                Some(Search::Crossing { omega, speed }) => return [omega, speed],
                Some(Search::NoneUpTo) => panic!("no crossing"),
            }
        }
    }

    fn corner(omega: f64, speed: f64) -> Corner {
        let zero = C64::new(0.0, 0.0);
        Corner { omega, speed, log: zero, by_omega: zero, by_speed: zero, zeros: 0 }
    }

    fn cell([left, right]: [f64; 2], [from, to]: [f64; 2]) -> Cell {
        Cell { lower: [corner(left, from), corner(right, from)], upper: [corner(left, to), corner(right, to)] }
    }

    #[test]
    fn a_trend_is_the_cubic_through_both_ends() {
        let p = |v: f64| 2.0 - v + 0.5 * v * v + 0.25 * v * v * v;
        let slope = |v: f64| -1.0 + v + 0.75 * v * v;
        let trend = Trend::between([1.5, 4.0], [p(1.5), p(4.0)], [slope(1.5), slope(4.0)]);
        for v in [1.5, 2.7, 4.0, 5.0] {
            let [value, derivative] = trend.at(v);
            assert!(
                (value - p(v)).abs() < 1e-12 && (derivative - slope(v)).abs() < 1e-12,
                "{value} {derivative} at {v}"
            );
        }
    }

    /// One step leads to the zero of a function that is linear in ω and v.
    #[test]
    fn a_newton_step_ends_where_a_linear_function_is_zero() {
        let (p, q) = (C64::new(2.0, -1.0), C64::new(0.5, 3.0));
        for step in [[0.3, -0.2], [-4.0, 0.1], [0.0, 5.0]] {
            let value = -(p * step[0] + q * step[1]);
            let corner = Corner { by_omega: p / value, by_speed: q / value, ..corner(7.0, 9.0) };
            let found = newton_step(&corner).unwrap();
            assert!((0..2).all(|i| (found[i] - step[i]).abs() < 1e-14 * 5.0), "{found:?}, not {step:?}");
        }
        assert_eq!(newton_step(&corner(7.0, 9.0)), None);
    }

    #[test]
    fn near_a_cell_is_half_its_size() {
        let cell = cell([1.0, 3.0], [2.0, 6.0]);
        for (omega, speed, near) in [
            (0.01, 0.01, true),
            (3.99, 7.99, true),
            (-0.01, 4.0, false),
            (4.01, 4.0, false),
            (2.0, -0.01, false),
            (2.0, 8.01, false),
        ] {
            assert_eq!(cell.is_near(omega, speed), near, "{omega} {speed}");
        }
    }

    /// In a cell that is no taller, frequencies move by at most 0.35 of their spacing: those of a string by
    /// 2 s² v ω per unit of v, spaced by π over the time that a wave travels.
    #[test]
    fn a_cell_in_which_the_phase_may_turn_is_tall() {
        let vibration = problem();
        let mut plane = plane(&vibration);
        let height = LARGEST_MOVE * plane.counter.bounds.speed_step(30.0, 8.0);
        for (part, tall) in [(0.99, false), (1.01, true)] {
            let cell = cell([20.0, 30.0], [8.0 - part * height, 8.0]);
            assert_eq!(plane.is_tall(&cell), tall, "{part}");
            assert_eq!(plane.changes(&cell)[1].is_infinite(), tall, "{part}");
        }
        // What can cross at all: up to the bound at the top of the cell, or anywhere in the strip.
        let top = plane.counter.bounds.highest_frequency(8.0);
        for (eligible, omega, expected) in [(0.0, 0.99, true), (0.0, 1.01, false), (1.1 * top, 1.01, true)] {
            plane.eligible = eligible;
            let cell = cell([omega * top, 2.0 * top], [7.0, 8.0]);
            assert_eq!(plane.is_eligible(&cell), expected, "{eligible} {omega}");
        }
    }

    /// An eigenvalue that crosses moves by −i b per unit of v, its conjugate by the conjugate of that.
    #[test]
    fn a_zero_has_the_slope_of_the_eigenvalue() {
        let vibration = problem();
        let mut plane = plane(&vibration);
        let [omega, speed] = crossing(&vibration);
        let off = newton_step(&plane.at(omega, speed)).unwrap();
        assert!(off.iter().all(|part| part.abs() < 1e-10), "the crossing is off by {off:?}");
        let zero = plane.zero_at(omega, speed).unwrap();
        let dense = Eigenproblem::new(&vibration).unwrap();
        let near = |speed: f64| {
            let spectrum = dense.spectrum(speed).unwrap();
            let distance = |l: &C64| (l - C64::new(0.0, omega)).norm();
            spectrum.eigenvalues().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
        };
        let h = 1e-3;
        let slope = (near(speed + h) - near(speed - h)) / (2.0 * h);
        let moved = zero.slope * C64::new(0.0, -1.0);
        assert!((moved - slope).norm() < 1e-4 * slope.norm(), "{moved} {slope}");
        for (omega, speed) in [(1.0, 9.0), (-2.5, 12.0)] {
            let [(own, by_speed), (image, image_by_speed)] = zero.factors(omega, speed).collect::<Vec<_>>()[..] else {
                panic!("two factors")
            };
            assert_eq!(own, C64::from(omega - zero.omega) + zero.slope * (speed - zero.speed));
            let mirrored = zero.factors(-omega, speed).next().unwrap().0;
            assert_eq!([image, image_by_speed], [-mirrored.conj(), -by_speed.conj()]);
        }
        plane.zeros.push(zero);
        assert!(plane.zero_at(omega, speed).is_none(), "found twice");
        assert!(plane.zero_at(omega, speed + 0.1).is_some() && plane.zero_at(omega + 0.1, speed).is_some(), "others");
        // Divided out, nothing of it is left: next to it D is a smooth function.
        let [left, right] = [-1e-4, 1e-4].map(|aside| plane.at(omega + aside, speed));
        let size = left.by_omega.norm();
        assert!((left.by_omega - right.by_omega).norm() < 1e-2 * size, "{left:?} {right:?}");
        // The slope is known to what D bends by over the 1e-6 rad/s it was taken at, a hundredth of the 1e-4 rad/s here.
        assert!((left.by_speed - right.by_speed).norm() < 1e-1 * size, "{left:?} {right:?}");
    }

    /// Corners between two strips are kept, with the new trend in place of the old one.
    #[test]
    fn corners_follow_the_trend() {
        let vibration = problem();
        let mut plane = plane(&vibration);
        plane.follow_trend(9.0, 10.0, 30.0);
        for speed in [9.0, 10.0] {
            plane.corner(2.0, speed);
        }
        plane.follow_trend(10.0, 11.0, 25.0);
        let kept: Vec<Corner> = plane.known.values().copied().collect();
        let fresh = plane.at(2.0, 10.0);
        let [corner] = kept[..] else { panic!("{kept:?}") };
        for (a, b) in [(corner.log, fresh.log), (corner.by_omega, fresh.by_omega), (corner.by_speed, fresh.by_speed)] {
            assert!((a - b).norm() < 1e-12 * (1.0 + b.norm()), "{corner:?} {fresh:?}");
        }
        // The trend is what D does to the right of the axis: there the two ends of the strip differ by the phase alone.
        for speed in [10.0, 11.0] {
            let value = plane.counter.axis.at(25.0.into(), speed);
            let [trend, slope] = plane.trend.at(speed);
            assert!((value.log.re - trend).abs() < 1e-9 * trend.abs() && (value.by_speed.re - slope).abs() < 1e-9);
        }
    }
}
