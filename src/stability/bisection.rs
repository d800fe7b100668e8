//! Halving an interval.

/// Halves the interval from `low` to `high` `halvings` times, and gives what is left of it. `is_low` tells whether a number in it
/// belongs to the lower side.
///
/// ```
/// # use tautline::stability::bisect;
/// let [low, high] = bisect([1.0, 2.0], 52, |x| x * x < 2.0);
/// assert!(low <= 2.0_f64.sqrt() && 2.0_f64.sqrt() <= high && high - low < 1e-15);
/// ```
pub fn bisect([mut low, mut high]: [f64; 2], halvings: usize, is_low: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        if is_low(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    [low, high]
}
