//! What the fastest allowed profile is asked: how far below which limits, and what the machine can do.

use serde::{Deserialize, Serialize};

/// Which local limit the speed keeps below.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Below {
    /// The wave limit.
    #[default]
    Waves,
    /// The frozen critical speed.
    Frozen,
    /// The lower one of the two.
    Both,
}

impl Below {
    /// All with their names.
    pub const ALL: [(Self, &'static str); 3] =
        [(Self::Waves, "wave limit"), (Self::Frozen, "frozen"), (Self::Both, "both")];
}

/// What is asked. A limit that is not given does not act.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LimitsAsked {
    /// The speed keeps below this part of the local limit.
    pub safety: f64,
    /// Which local limit.
    pub below: Below,
    /// The platform's acceleration and braking along the path, in m/s².
    pub acceleration: Option<f64>,
    /// The winches' speed |L̇| in m/s.
    pub winch_speed: Option<f64>,
    /// The winches' acceleration |L̈| in m/s².
    pub winch_acceleration: Option<f64>,
    /// Which part of the acceleration at which a cable goes slack by statics.
    pub slack: Option<f64>,
}

impl Default for LimitsAsked {
    /// 80 % of the wave limit, with 3 m/s².
    fn default() -> Self {
        Self {
            safety: 0.8,
            below: Below::default(),
            acceleration: Some(3.0),
            winch_speed: None,
            winch_acceleration: None,
            slack: None,
        }
    }
}
