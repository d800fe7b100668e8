//! What people choose once: colours, units, movement.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::app::digits;

/// What people choose once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Light, dark, or as the system.
    pub theme: ThemeChoice,
    /// How frequencies are written.
    pub frequency: FrequencyUnit,
    /// How stresses are written.
    pub stress: StressUnit,
    /// Whether nothing moves by itself.
    pub motion: MotionChoice,
    /// The size of all texts in percent, see [`TEXT_SIZES`].
    pub text_percent: u16,
    /// Whether keys without Ctrl or Alt do something wherever the focus is. Those who dictate switch it off.
    pub single_keys: bool,
}

/// How large texts can be made, in percent.
pub const TEXT_SIZES: std::ops::RangeInclusive<u16> = 80..=200;

impl Default for Settings {
    fn default() -> Self {
        Self {
            theme: ThemeChoice::default(),
            frequency: FrequencyUnit::default(),
            stress: StressUnit::default(),
            motion: MotionChoice::default(),
            text_percent: 100,
            single_keys: true,
        }
    }
}

impl Settings {
    /// Whether nothing may move by itself.
    pub fn reduces_motion(self) -> bool {
        match self.motion {
            MotionChoice::System => system_reduces_motion(),
            MotionChoice::Full => false,
            MotionChoice::Reduced => true,
        }
    }

    /// The unit of frequencies: what one hertz is in it, and its name.
    pub fn hertz(self) -> (f64, &'static str) {
        match self.frequency {
            FrequencyUnit::Hertz => (1.0, "Hz"),
            FrequencyUnit::RadiansPerSecond => (TAU, "rad/s"),
        }
    }

    /// A frequency in Hz as a text in the unit chosen, with the digits that are certain.
    pub fn frequency_text(self, frequency_hz: f64, uncertainty_hz: Option<f64>) -> String {
        let (hertz, unit) = self.hertz();
        format!("{} {unit}", digits::certain(frequency_hz * hertz, uncertainty_hz.map(|off| off * hertz)))
    }
}

/// Whether the browser's user has asked for little movement; desktop systems do not tell.
fn system_reduces_motion() -> bool {
    #[cfg(target_arch = "wasm32")]
    let reduced = web_sys::window()
        .and_then(|window| window.match_media("(prefers-reduced-motion: reduce)").ok().flatten())
        .is_some_and(|query| query.matches());
    #[cfg(not(target_arch = "wasm32"))]
    let reduced = false;
    reduced
}

/// Light, dark, or as the system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ThemeChoice {
    /// As the system.
    #[default]
    System,
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
}

/// How frequencies are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FrequencyUnit {
    /// In Hz.
    #[default]
    Hertz,
    /// In rad/s.
    RadiansPerSecond,
}

/// How stresses are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum StressUnit {
    /// In `MPa`, that is N/mm².
    #[default]
    Megapascal,
    /// In `GPa`.
    Gigapascal,
}

/// Whether things may move by themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum MotionChoice {
    /// As the system requests, where it tells.
    #[default]
    System,
    /// They may.
    Full,
    /// Nothing moves by itself.
    Reduced,
}
