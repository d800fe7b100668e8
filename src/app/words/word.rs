//! The words that have a card.

/// A word with a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Word {
    /// The critical speed.
    CriticalSpeed,
    /// The frozen-time criterion.
    FrozenTime,
    /// The wave limit.
    WaveLimit,
    /// How near a move comes to the wave limit.
    WaveRatio,
    /// The gain of a move.
    Gain,
    /// A path.
    Path,
    /// A motion profile.
    MotionProfile,
    /// Flutter.
    Flutter,
    /// Divergence.
    Divergence,
    /// Growth rate.
    GrowthRate,
    /// Damping ratio.
    DampingRatio,
    /// Mode shape.
    ModeShape,
    /// Secant and tangent stiffness.
    Stiffness,
    /// Green's and engineering strain.
    Strain,
    /// Holding and stiffening cable.
    Holding,
    /// Unstretched length.
    UnstretchedLength,
    /// Reeled in and paid out.
    Reeling,
    /// Slack.
    Slack,
    /// Campbell or speed diagram.
    Campbell,
    /// Mesh error.
    MeshError,
    /// Sensitivity.
    Sensitivity,
}

impl Word {
    /// All of them, what comes first to a reader first.
    pub const ALL: [Self; 21] = [
        Self::CriticalSpeed,
        Self::Flutter,
        Self::Divergence,
        Self::FrozenTime,
        Self::WaveLimit,
        Self::WaveRatio,
        Self::Gain,
        Self::Path,
        Self::MotionProfile,
        Self::ModeShape,
        Self::GrowthRate,
        Self::DampingRatio,
        Self::Reeling,
        Self::UnstretchedLength,
        Self::Holding,
        Self::Slack,
        Self::Stiffness,
        Self::Strain,
        Self::Campbell,
        Self::Sensitivity,
        Self::MeshError,
    ];
}
