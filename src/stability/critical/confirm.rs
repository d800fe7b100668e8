//! Whether a crossing that the scan has refined is one, and where its growth begins.

use crate::stability::NotConverged;
use crate::stability::critical::scan::{CERTAIN, Growth, Scan, is_hidden};

/// Without damping, growth by this part of its rounding at half the crossing's speed has begun at rest. Rounding is a
/// hundred times smaller yet.
const FROM_REST: f64 = 0.0625;

impl Scan<'_> {
    /// Whether the growth rate changes its sign at a crossing (m/s), by more than its rounding; without damping the growth
    /// rate below the crossing is rounding, and its sign tells nothing.
    ///
    /// # Errors
    /// [`NotConverged`] where it does not.
    pub(super) async fn confirm(&mut self, crossing: f64) -> Result<(), NotConverged> {
        for (near, sign) in [((crossing - CERTAIN).max(0.0), -1.0), (crossing + CERTAIN, 1.0)] {
            let spectrum = self.spectrum(near).await?;
            let contradicts = is_hidden(&spectrum) || spectrum.growth_rate() * sign < 0.0;
            if matches!(self.growth, Growth::Damped) && contradicts {
                return Err(NotConverged);
            }
        }
        Ok(())
    }

    /// Whether what is seen to grow from a crossing (m/s) on has grown from rest on. Without damping that is possible:
    /// where frequencies are high, growth exceeds their rounding late.
    pub(super) async fn grows_from_rest(&mut self, crossing: f64) -> Result<bool, NotConverged> {
        let Growth::Undamped { rounding } = self.growth else { return Ok(false) };
        // At half the speed a half of the growth is left if it is proportional to the speed, a quarter if to its square.
        Ok(self.spectrum(0.5 * crossing).await?.growth_rate() > FROM_REST * rounding)
    }
}
