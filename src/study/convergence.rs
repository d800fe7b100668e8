//! What finer meshes would give: Richardson's extrapolation of the critical speed, and how far it can be trusted.

use std::ops::RangeInclusive;

use crate::stability::{Critical, Instability};
use crate::study::{Status, Verdict};

/// Differences below this part of a value are those of the search, not of the mesh.
const ROUNDING_OF_SEARCH: f64 = 1e-8;
/// Frequencies of one mode on two successive meshes differ by at most this part.
const SAME_MODE: f64 = 0.25;
/// An order that three meshes show counts if it is the known one times a factor in this range.
const ORDERS: RangeInclusive<f64> = 0.5..=2.5;
/// An estimate is not better than this part of what extrapolation adds (Roache's grid convergence index).
const LEAST_SHARE: f64 = 0.25;

/// The order with which the critical speed of this kind converges: the error falls as n to the power of minus this.
///
/// Flutter is an eigenvalue of linear elements and has the order 2. A divergence is where the flow of cable reaches the
/// speed of waves, nearly always at the winch; on a mesh that is decided by the last element's mean, half an element away
/// from there, which is of order 1 (docs/theory.md section 10).
pub fn known_order(kind: Instability) -> f64 {
    match kind {
        Instability::Flutter => 2.0,
        Instability::Divergence => 1.0,
    }
}

/// The orders that fine enough meshes show. Between them lies the known one; a divergence shows more than 1 by about
/// 1/ln n. Where meshes show another, all that extrapolation adds is in doubt.
fn settled_orders(kind: Instability) -> RangeInclusive<f64> {
    match kind {
        Instability::Flutter => 1.8..=2.2,
        Instability::Divergence => 0.9..=1.5,
    }
}

/// What the critical speeds on several meshes say about n → ∞.
#[derive(Clone, Debug, PartialEq)]
pub enum Convergence {
    /// The limit can be told.
    Limit(Extrapolation),
    /// It cannot.
    Unknown(NoLimit),
}

/// The limit of the critical speed as n → ∞.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrapolation {
    /// In m/s.
    pub limit: f64,
    /// The limit lies within this of [`Self::limit`], in m/s: an estimate, not a bound.
    pub uncertainty: f64,
    /// The same of the crossing mode's frequency, in Hz.
    pub frequency: Estimate,
    /// The error falls as n to the power of minus this.
    pub order: f64,
    /// Whether the order was found from three meshes; else it is the [known one](known_order).
    pub estimated: bool,
    /// The critical speed on today's mesh less the limit, in m/s; `None` where it is not among the meshes, has no
    /// critical speed, or one of another kind, cable or mode.
    pub error: Option<f64>,
}

/// A limit and how far off it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The limit as n → ∞.
    pub limit: f64,
    /// The limit lies within this of it: an estimate, not a bound.
    pub uncertainty: f64,
}

/// Why the limit cannot be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoLimit {
    /// No critical speed on the finest mesh.
    NoneCritical,
    /// A critical speed on one mesh only.
    TooFew,
    /// Instability, responsible cable or mode are not the same on the finest meshes.
    Changes,
    /// The differences between meshes do not shrink as they should: the meshes are too coarse.
    Unsettled,
}

/// The limit of the critical speed as n → ∞ from `meshes`, each elements per cable and verdict, and the error with
/// `today` elements.
///
/// With v at n, 2n and 4n elements, 4n the finest mesh, the order seen is p = log₂ ((v₂ₙ − vₙ)/(v₄ₙ − v₂ₙ)), and the
/// limit that an order p promises is v₄ₙ + (v₄ₙ − v₂ₙ)/(2ᵖ − 1). Once the meshes are fine enough, the limit lies between
/// the promises of the order seen and of the [known one](known_order). Their middle is told, and their distance is the
/// uncertainty. It is at least a quarter of what extrapolation adds to v₄ₙ, and all of that if the order seen is not one of
/// fine meshes. With two meshes only, the known order is taken, and all that extrapolation adds is uncertain. The meshes must
/// agree in kind, cable and (to a quarter) frequency. A mesh without a known verdict is passed over.
pub fn richardson(meshes: &[(usize, Verdict)], today: usize) -> Convergence {
    let mut meshes: Vec<&(usize, Verdict)> =
        meshes.iter().filter(|(n, verdict)| *n > 0 && verdict.status() != Status::Failed).collect();
    meshes.sort_by_key(|(n, _)| *n);
    meshes.dedup_by_key(|(n, _)| *n);
    let critical: Vec<(usize, Option<&Critical>)> =
        meshes.iter().map(|(n, verdict)| (*n, verdict.critical())).collect();
    let Some((_, Some(_))) = critical.last() else { return Convergence::Unknown(NoLimit::NoneCritical) };
    if critical.iter().filter(|(_, critical)| critical.is_some()).count() < 2 {
        return Convergence::Unknown(NoLimit::TooFew);
    }
    let at = |n: usize| critical.iter().position(|(other, _)| *other == n);
    let thrice = (0..critical.len()).rev().find_map(|i| {
        let n = critical[i].0;
        let (half, quarter) = (at(n / 2)?, at(n / 4)?);
        n.is_multiple_of(4).then_some([i, half, quarter])
    });
    let last = critical.len() - 1;
    let used = thrice.map_or_else(|| vec![last, last - 1], Vec::from);
    // Those used must show one mode, and finer ones as well.
    let mut mode = None;
    for &(_, found) in used.iter().rev().map(|&i| &critical[i]).chain(&critical[used[0]..]) {
        match (found, mode) {
            (Some(found), Some(before)) if !same_mode(before, found) => return Convergence::Unknown(NoLimit::Changes),
            (None, _) => return Convergence::Unknown(NoLimit::Changes),
            _ => mode = found,
        }
    }
    let (finest, Some(at_finest)) = critical[used[0]] else { return Convergence::Unknown(NoLimit::NoneCritical) };
    let coarser: Vec<(usize, &Critical)> =
        used[1..].iter().filter_map(|&i| Some((critical[i].0, critical[i].1?))).collect();
    let kind = at_finest.kind;
    let known = known_order(kind);
    let extrapolated = |value: &dyn Fn(&Critical) -> f64| {
        if let [(_, half), (_, quarter)] = coarser[..] {
            return from_three(value(quarter), value(half), value(at_finest), kind);
        }
        let (n, before) = *coarser.first()?;
        let value_here = value(at_finest);
        let change = (value_here - value(before)) / ((finest as f64 / n as f64).powf(known) - 1.0);
        let uncertainty = change.abs().max(ROUNDING_OF_SEARCH * value_here.abs());
        Some((Estimate { limit: value_here + change, uncertainty }, None))
    };
    let Some((speed, order)) = extrapolated(&|critical| critical.speed) else {
        return Convergence::Unknown(NoLimit::Unsettled);
    };
    let frequencies = || coarser.iter().map(|(_, critical)| critical.frequency_hz());
    // A frequency need not settle as the speed does: then it is as uncertain as it changes from mesh to mesh.
    let frequency = extrapolated(&Critical::frequency_hz).map_or_else(
        || {
            let limit = at_finest.frequency_hz();
            Estimate { limit, uncertainty: frequencies().map(|other| (other - limit).abs()).fold(0.0, f64::max) }
        },
        |(frequency, _)| frequency,
    );
    // Of the same mode as a mesh that was used; these are alike from one to the next.
    let alike = |today: &&Critical| used.iter().filter_map(|&i| critical[i].1).any(|other| same_mode(today, other));
    let at_today = at(today).and_then(|i| critical[i].1).filter(alike);
    Convergence::Limit(Extrapolation {
        limit: speed.limit,
        uncertainty: speed.uncertainty,
        frequency,
        order: order.unwrap_or(known),
        estimated: order.is_some(),
        error: at_today.map(|critical| critical.speed - speed.limit),
    })
}

/// The limit of values at n, 2n and 4n elements, and the order seen where the values tell one; `None` where they do not
/// settle.
fn from_three(quarter: f64, half: f64, finest: f64, kind: Instability) -> Option<(Estimate, Option<f64>)> {
    let known = known_order(kind);
    let (first, second) = (half - quarter, finest - half);
    let rounding = ROUNDING_OF_SEARCH * finest.abs();
    let by_known = finest + second / (known.exp2() - 1.0);
    if second.abs() <= rounding && first.abs() <= rounding {
        return Some((Estimate { limit: by_known, uncertainty: rounding }, None));
    }
    // Without a sign, NaN and infinite are outside of all orders.
    let order = Some((first / second).log2()).filter(|order| ORDERS.contains(&(order / known)))?;
    let by_seen = finest + second / (order.exp2() - 1.0);
    let limit = 0.5 * (by_known + by_seen);
    let share = if settled_orders(kind).contains(&order) { LEAST_SHARE } else { 1.0 };
    let uncertainty = (by_known - by_seen).abs().max(share * (limit - finest).abs()).max(rounding);
    Some((Estimate { limit, uncertainty }, Some(order)))
}

/// Whether two meshes show one mode: the same kind and cable, and frequencies that differ by at most a quarter.
pub fn same_mode(a: &Critical, b: &Critical) -> bool {
    let (one, other) = (a.frequency_hz(), b.frequency_hz());
    a.kind == b.kind && a.cable == b.cable && (one - other).abs() <= SAME_MODE * one.max(other)
}
