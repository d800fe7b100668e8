//! Round numbers: the steps of grids and scales, and what a hand means.

use eframe::egui::emath::smart_aim::best_in_range_f64;

/// The smallest of 1, 2, 5 times a power of ten that is at least `least`.
pub fn round_step(least: f64) -> f64 {
    let decade = 10.0_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|digit| digit * decade).find(|&step| step >= least).unwrap_or(10.0 * decade)
}

/// The roundest number within half a point of the screen: a hand cannot mean it more exactly.
pub fn roundest(value: f64, point: f64) -> f64 {
    best_in_range_f64(value - 0.5 * point, value + 0.5 * point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_steps_are_round() {
        for (least, step) in [(0.8, 1.0), (1.0, 1.0), (1.3, 2.0), (3.0, 5.0), (7.0, 10.0), (0.03, 0.05)] {
            assert!((round_step(least) / step - 1.0).abs() < 1e-12, "{least}: {}", round_step(least));
        }
    }
}
