//! The place of a crossing between two speeds of the scan.

use crate::stability::NotConverged;
use crate::stability::critical::scan::Scan;

/// The crossing is refined to this many m/s.
pub(super) const REFINED_TO: f64 = 1e-9;

impl Scan<'_> {
    /// The crossing (m/s) between a stable and an unstable speed, by bisection.
    pub(super) async fn refine(&mut self, mut stable: f64, mut unstable: f64) -> Result<f64, NotConverged> {
        // Far from zero two neighbouring numbers may be further apart than that.
        while unstable - stable > REFINED_TO.max(4.0 * f64::EPSILON * unstable) {
            let middle = 0.5 * (stable + unstable);
            if self.growth.is_in(&self.spectrum(middle).await?) {
                unstable = middle;
            } else {
                stable = middle;
            }
        }
        Ok(0.5 * (stable + unstable))
    }
}
