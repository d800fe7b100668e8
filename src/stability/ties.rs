//! Choosing among numbers that may be equal but for rounding, as those of mirrored cables and directions are: then the
//! first one counts, so that no answer depends on how numbers were rounded.

/// Of critical speeds: they are known to about 1e-8 of themselves, or of 1 m/s.
pub const TIE_OF_SPEEDS: f64 = 1e-7;
/// Of shares of the kinetic energy.
pub const TIE_OF_SHARES: f64 = 1e-6;

/// The index of the first of `values` that is larger than all others, or less than `tie` below the largest.
pub fn first_largest(values: impl IntoIterator<Item = f64> + Clone, tie: f64) -> Option<usize> {
    let largest = values.clone().into_iter().max_by(f64::total_cmp)?;
    values.into_iter().position(|value| value >= largest - tie)
}

/// The index of the first of `speeds` in m/s that is lower than all others but for a [`TIE_OF_SPEEDS`].
pub fn first_lowest(speeds: impl IntoIterator<Item = f64> + Clone) -> Option<usize> {
    let lowest = speeds.clone().into_iter().min_by(f64::total_cmp)?;
    speeds.into_iter().position(|speed| !is_lower(lowest, speed))
}

/// Whether a speed (m/s) is lower than another one by more than a [`TIE_OF_SPEEDS`].
pub fn is_lower(speed: f64, other: f64) -> bool {
    speed < other - TIE_OF_SPEEDS * other.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_what_is_equal_but_for_rounding_the_first_counts() {
        let above = 1.0 + 4.0 * f64::EPSILON;
        for (values, largest) in [
            (vec![0.3, 0.3 * above, 0.1], Some(0)),
            (vec![0.1, 0.3, 0.3 * above], Some(1)),
            (vec![0.3, 0.3 + 2.0 * TIE_OF_SHARES], Some(1)),
            (vec![], None),
        ] {
            assert_eq!(first_largest(values.iter().copied(), TIE_OF_SHARES), largest, "{values:?}");
        }
        for (speeds, lowest) in [
            (vec![11.3 * above, 11.3, 12.0], Some(0)),
            (vec![12.0, 11.3 * above, 11.3], Some(1)),
            (vec![11.3, 11.3 * (1.0 - 2.0 * TIE_OF_SPEEDS)], Some(1)),
            (vec![1e-9, 0.0], Some(0)),
            (vec![], None),
        ] {
            assert_eq!(first_lowest(speeds.iter().copied()), lowest, "{speeds:?}");
        }
    }
}
