//! What finer meshes would give: Richardson's extrapolation of the critical speed.

use crate::stability::Critical;
use crate::study::{Status, Verdict};

/// The order of linear elements: the error falls as n⁻².
const ORDER: f64 = 2.0;
/// Orders that three meshes may show; beyond, they are too coarse or differ by more than the mesh's error.
const ORDERS: std::ops::RangeInclusive<f64> = 1.0..=3.0;
/// Of the critical speed: smaller differences are those of the search, not of the mesh.
const ROUNDING: f64 = 1e-8;
/// Frequencies of one mode on two successive meshes differ by at most this part.
const SAME_MODE: f64 = 0.25;

/// What the critical speeds on several meshes say about n → ∞.
#[derive(Clone, Debug, PartialEq)]
pub enum Convergence {
    /// The limit can be told.
    Limit(Extrapolation),
    /// It cannot.
    Unknown(Doubt),
}

/// The limit of the critical speed as n → ∞.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrapolation {
    /// In m/s.
    pub limit: f64,
    /// The error falls as n to the power of minus this.
    pub order: f64,
    /// Whether the order was found from three meshes; else it is the theoretical one, 2.
    pub estimated: bool,
    /// The critical speed on today's mesh less the limit, in m/s; `None` where it is not among the meshes or has no
    /// critical speed.
    pub error: Option<f64>,
}

/// Why the limit cannot be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// No critical speed on the finest mesh.
    NoneCritical,
    /// A critical speed on one mesh only.
    TooFew,
    /// Kind, responsible cable or mode change from the last mesh but one to the finest.
    Changes,
    /// The differences between meshes do not shrink as they should: the meshes are too coarse.
    Unsettled,
}

/// The limit of the critical speed as n → ∞ from `meshes`, each elements per cable and verdict, and the error with
/// `today` elements.
///
/// Of the finest meshes that agree in kind, cable and (to a quarter) frequency: with v at n, 2n and 4n elements the
/// order is p = log₂ ((v₂ₙ − vₙ)/(v₄ₙ − v₂ₙ)) and the limit v₄ₙ + (v₄ₙ − v₂ₙ)/(2ᵖ − 1). Where there are no three such
/// meshes, or they show no order from 1 to 3 although the differences shrink, p = 2 and the limit comes from the two
/// finest meshes. Meshes of which nothing is known are passed over.
pub fn richardson(meshes: &[(usize, Verdict)], today: usize) -> Convergence {
    let mut meshes: Vec<&(usize, Verdict)> =
        meshes.iter().filter(|(n, verdict)| *n > 0 && verdict.status() != Status::Failed).collect();
    meshes.sort_by_key(|(n, _)| *n);
    meshes.dedup_by_key(|(n, _)| *n);
    let critical: Vec<(usize, Option<&Critical>)> =
        meshes.iter().map(|(n, verdict)| (*n, verdict.critical())).collect();
    let Some(&(finest, Some(at_finest))) = critical.last() else { return Convergence::Unknown(Doubt::NoneCritical) };

    // The finest meshes that show one mode, the finest first.
    let mut alike = vec![(finest, at_finest)];
    for &(n, coarser) in critical.iter().rev().skip(1) {
        let finer = alike[alike.len() - 1].1;
        match coarser.filter(|coarser| same_mode(coarser, finer)) {
            Some(coarser) => alike.push((n, coarser)),
            None => break,
        }
    }
    let [(_, v), (coarser, before), ..] = alike[..] else {
        let critical_before = critical.len() > 1 && critical[critical.len() - 2].1.is_some();
        return Convergence::Unknown(if critical_before { Doubt::Changes } else { Doubt::TooFew });
    };
    let speed_at = |n: usize| alike.iter().find(|(other, _)| *other == n).map(|(_, critical)| critical.speed);
    let rounding = ROUNDING * v.speed;
    let mut order = None;
    if finest % 4 == 0
        && let (Some(half), Some(quarter)) = (speed_at(finest / 2), speed_at(finest / 4))
    {
        let (first, second) = (half - quarter, v.speed - half);
        if second.abs() > rounding {
            // Without a sign, NaN and infinite are outside of all orders.
            order = Some((first / second).log2()).filter(|order| ORDERS.contains(order));
            if order.is_none() && 2.0 * second.abs() > first.abs() {
                return Convergence::Unknown(Doubt::Unsettled);
            }
        }
    }
    let limit = match order {
        Some(order) => v.speed + (v.speed - speed_at(finest / 2).unwrap_or(v.speed)) / (order.exp2() - 1.0),
        None => v.speed + (v.speed - before.speed) / ((finest as f64 / coarser as f64).powf(ORDER) - 1.0),
    };
    let at_today = critical.iter().find(|(n, _)| *n == today).and_then(|(_, critical)| *critical);
    Convergence::Limit(Extrapolation {
        limit,
        order: order.unwrap_or(ORDER),
        estimated: order.is_some(),
        error: at_today.map(|critical| critical.speed - limit),
    })
}

fn same_mode(a: &Critical, b: &Critical) -> bool {
    let (one, other) = (a.frequency_hz(), b.frequency_hz());
    a.kind == b.kind && a.cable == b.cable && (one - other).abs() <= SAME_MODE * one.max(other)
}
