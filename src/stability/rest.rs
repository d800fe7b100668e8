//! Without damping: what the speed does to the modes at rest, to first order.
//!
//! At rest every eigenvalue is λ = iω̂ with a real shape x. Where it is simple, dλ/dv = −xᵀCx/(2 xᵀMx) there, a real
//! number: to first order in the speed a mode grows or decays. Only the symmetric part of C counts, which takes energy from
//! cable that is paid out and gives it to cable that is reeled in. docs/theory.md section 8.

use nalgebra::Complex;

use crate::mechanics::Vibration;
use crate::stability::modes::responsible_cable;
use crate::stability::steps::step;
use crate::stability::{Critical, Instability, Mode, NotConverged, Polarisation, Spectra, mode};

/// A mode's growth is a sum over the elements. Below this part of the terms' sizes it is none: the cables that are paid out
/// take what the others give, or no moving cable has a share in the mode.
const NONE: f64 = 1e-9;
/// Two frequencies are apart when they differ by more than this many times their uncertainty.
const APART: f64 = 1e3;
/// An eigenvalue is known to this part of the largest frequency at best.
const ROUNDING_OF_EIGENVALUES: f64 = 1e-15;
/// Modes are looked at in groups of this size, the group with the highest frequencies first.
const AT_ONCE: usize = 16;

/// What the modes at rest tell.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum AtRest {
    /// A mode grows from rest on; the one that grows fastest.
    Grows(Critical),
    /// All decay.
    Decays,
    /// None grows, but it is not known of all that they decay.
    Neutral,
}

/// Looks at all modes at rest of a problem without damping, in [steps](crate::stability::steps) of a mode.
///
/// # Errors
/// [`NotConverged`] where the frequencies cannot be had.
pub(super) async fn growth_at_rest(vibration: &Vibration) -> Result<AtRest, NotConverged> {
    let mut spectra = Spectra::new(vibration)?;
    let spectrum = spectra.spectrum_in_steps(vibration, 0.0).await?;
    let known = |omega: f64| spectrum.rounding(Complex::new(0.0, omega)) + ROUNDING_OF_EIGENVALUES * spectra.scale();
    let all: Vec<f64> = spectrum.modes().map(|mode| mode.eigenvalue.im).collect();
    let apart = |a: f64, b: f64| b - a > APART * known(b);
    let is_simple =
        |i: usize| (i == 0 || apart(all[i - 1], all[i])) && all.get(i + 1).is_none_or(|&next| apart(all[i], next));
    let simple: Vec<f64> = (0..all.len()).filter(|&i| is_simple(i)).map(|i| all[i]).collect();
    // Of eigenvalues that are not simple it is not known what the speed does to them.
    let mut decays = simple.len() == all.len();
    let mut fastest: Option<(f64, Critical)> = None;
    // The order decides which one of equals is the first.
    for &omega in simple.rchunks(AT_ONCE).flatten() {
        let eigenvalue = Complex::new(0.0, omega);
        let mode = mode(vibration, 0.0, eigenvalue, Polarisation::default());
        let [growth, size] = growth(vibration, &mode);
        decays &= growth < -NONE * size;
        // Equal but for rounding, the first one counts.
        let faster = fastest.as_ref().is_none_or(|(fastest, _)| growth > *fastest + NONE * size);
        if growth > NONE * size && faster {
            let cable = responsible_cable(vibration, &mode);
            fastest = Some((growth, Critical { speed: 0.0, eigenvalue, kind: Instability::Flutter, cable }));
        }
        step().await;
    }
    Ok(match fastest {
        Some((_, critical)) => AtRest::Grows(critical),
        None if decays => AtRest::Decays,
        None => AtRest::Neutral,
    })
}

/// −x* C x/(2 x* M x) in 1/s per m/s, and the size of what it is the sum of; not a number where the shape is not known.
fn growth(vibration: &Vibration, mode: &Mode) -> [f64; 2] {
    let (mut transfer, mut size, mut mass) = (0.0, 0.0, 0.0);
    if let (Some(platform), Some(nodes)) = (vibration.hub.platform_mass(), mode.displacement.first()) {
        mass = platform * nodes[0].norm_squared();
    }
    for (chain, nodes) in vibration.chains.iter().zip(&mode.displacement) {
        for (element, pair) in chain.elements().iter().zip(nodes.windows(2)) {
            let (flow, inertia) = (element.transfer(), element.mass());
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let product = pair[i].dotc(&pair[j]).re;
                transfer += flow[(i, j)] * product;
                mass += inertia[(i, j)] * product;
            }
            // The symmetric part counts alone. The rest is large, and its sum is nothing but rounding.
            let own = [0, 1].map(|i| flow[(i, i)].abs() * pair[i].norm_squared());
            size += own[0] + own[1];
        }
    }
    [transfer * -0.5 / mass, size * 0.5 / mass]
}
