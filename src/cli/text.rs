//! The analysis as text for people.

use std::f64::consts::TAU;
use std::fmt::{self, Write as _};

use crate::robot::{Linearisation, Motion, OwnMaterial, Strain, TensionLaw};
use crate::scenario::report::{
    CriticalReport, KindReport, SlackAccelerationReport, SlackLimitReport, StatusReport, WaveLimitReport,
};
use crate::scenario::{Report, Scenario};

/// Slower changes of length per metre of travel are none.
const STILL: f64 = 1e-9;

pub(super) const CAVEAT: &str = "Note: the criterion freezes time, so a cable being reeled in looks unstable at every speed unless \
                      damping hides it.";

/// The whole analysis of `scenario`, which moves as `motion`.
pub(super) fn report(scenario: &Scenario, motion: &Motion, report: &Report) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, scenario, motion, report);
    text
}

fn write(text: &mut String, scenario: &Scenario, motion: &Motion, report: &Report) -> fmt::Result {
    heading(text, scenario, motion)?;
    let reason = report.reason.as_deref().unwrap_or_default();
    if report.cables.is_empty() {
        let what = if report.feasible == Some(false) { "Not feasible" } else { "Not computed" };
        return writeln!(text, "\n{what}. {reason}");
    }
    cables(text, scenario, report)?;
    stability(text, report)?;
    match (&report.critical, report.status) {
        (Some(critical), _) => critical_speed(text, report, critical)?,
        (None, Some(StatusReport::None)) => {
            writeln!(text, "Critical speed: none found up to {} m/s", digits(report.searched_up_to, 6))?;
        }
        (None, _) => writeln!(text, "Critical speed: not known. {reason}")?,
    }
    if let Some(WaveLimitReport { speed, cable, .. }) = report.wave_limit {
        let speed = digits(speed, 4);
        writeln!(
            text,
            "Wave limit: {speed} m/s, where the winch of cable {cable} reels as fast as waves run along it"
        )?;
    }
    if let Some(slack) = &report.slack_acceleration {
        slack_acceleration(text, slack)?;
    }
    writeln!(text, "\n{CAVEAT}")
}

fn slack_acceleration(text: &mut String, slack: &SlackAccelerationReport) -> fmt::Result {
    let limits = [("speeding up", &slack.accelerating), ("braking", &slack.braking)];
    let told = |(how, limit): (&str, &Option<_>)| {
        let SlackLimitReport { value, cable } = limit.as_ref()?;
        Some(format!("{} m/s² {how} (cable {cable})", digits(*value, 4)))
    };
    let told: Vec<String> = limits.into_iter().filter_map(told).collect();
    if told.is_empty() {
        writeln!(text, "Slack acceleration: none, no cable goes slack")?;
    } else {
        writeln!(text, "Slack acceleration: {}, by statics", told.join(", "))?;
        writeln!(
            text,
            "    Flown, slack comes earlier: at up to 30 % less peak speed, which is half the acceleration"
        )?;
    }
    let deviation = digits(1e3 * slack.deviation_per_acceleration, 3);
    writeln!(text, "    The platform gives way by {deviation} mm per m/s²")
}

fn heading(text: &mut String, scenario: &Scenario, motion: &Motion) -> fmt::Result {
    let cable = &scenario.cable;
    let strain = strain_name(cable.strain);
    let linearisation = match scenario.linearisation {
        Linearisation::Secant => "secant",
        Linearisation::Tangent => "tangent",
    };
    let name = scenario.name.as_deref().unwrap_or("Robot without a name");
    // No line breaks and no orders to the terminal.
    writeln!(text, "{}", name.replace(char::is_control, " "))?;
    writeln!(
        text,
        "{} cables: EA = {} N, {} kg/m, {strain} strain, {linearisation} stiffness, {} elements each; platform {} kg; \
         damping α = {} 1/s, β = {} s",
        scenario.cables.len(),
        digits(cable.youngs_modulus * cable.area, 4),
        digits(cable.mass_per_length, 4),
        scenario.elements_per_cable,
        digits(scenario.platform.mass, 4),
        digits(scenario.damping.alpha, 4),
        digits(scenario.damping.beta, 4),
    )?;
    let (position, direction) = (motion.position(), motion.direction());
    writeln!(
        text,
        "Platform at ({}, {}) m, moving along ({}, {}) at {} m/s",
        digits(position.x, 6),
        digits(position.y, 6),
        digits(direction.x, 4),
        digits(direction.y, 4),
        digits(motion.speed(), 6),
    )
}

fn cables(text: &mut String, scenario: &Scenario, report: &Report) -> fmt::Result {
    writeln!(text, "\nCable  tension set by  length     tension at  tension at  length per")?;
    writeln!(text, "                       at rest    platform    winch       travel L'")?;
    for (i, (cable, law)) in report.cables.iter().zip(&scenario.cables).enumerate() {
        let law = match law.tension {
            TensionLaw::Equilibrium => "equilibrium",
            TensionLaw::Constant(_) => "constant",
            TensionLaw::Hypot { .. } => "law",
        };
        writeln!(
            text,
            "{:>5}  {law:<14}  {:>8} m {:>9} N {:>9} N {:>11}  {}",
            i + 1,
            digits(cable.unstretched_length, 5),
            digits(cable.tension_at_platform, 4),
            digits(cable.tension_at_winch, 4),
            format!("{:+.4}", cable.length_rate),
            reeling(cable.length_rate),
        )?;
    }
    own_materials(text, scenario)
}

/// A line for each cable that has something of its own, with what that is.
fn own_materials(text: &mut String, scenario: &Scenario) -> fmt::Result {
    for (i, cable) in scenario.cables.iter().enumerate().filter(|(_, cable)| !cable.cable.is_empty()) {
        let OwnMaterial { youngs_modulus, area, mass_per_length, strain } = cable.cable;
        let mut parts = Vec::new();
        if youngs_modulus.is_some() || area.is_some() {
            let material = scenario.material_of(i);
            parts.push(format!("EA = {} N", digits(material.youngs_modulus * material.area, 4)));
        }
        parts.extend(mass_per_length.map(|mass| format!("{} kg/m", digits(mass, 4))));
        parts.extend(strain.map(|strain| format!("{} strain", strain_name(strain))));
        writeln!(text, "Cable {} alone: {}", i + 1, parts.join(", "))?;
    }
    Ok(())
}

fn strain_name(strain: Strain) -> &'static str {
    match strain {
        Strain::Green => "Green",
        Strain::Engineering => "engineering",
    }
}

/// What the winch does where a cable's length changes by `length_rate` per travel.
fn reeling(length_rate: f64) -> &'static str {
    if length_rate.abs() < STILL {
        "at rest"
    } else if length_rate > 0.0 {
        "paid out"
    } else {
        "reeled in"
    }
}

fn stability(text: &mut String, report: &Report) -> fmt::Result {
    let rightmost = report.eigenvalues.iter().max_by(|a, b| a[0].total_cmp(&b[0]));
    let speed = digits(report.speed, 6);
    let verdict = match report.stable {
        Some(true) => "stable",
        Some(false) => "not stable",
        None => "not known whether it is stable",
    };
    let Some(&[re, im]) = rightmost else {
        return writeln!(text, "\nAt {speed} m/s: {verdict}; the eigenvalues could not be computed");
    };
    writeln!(text, "\nAt {speed} m/s: {verdict}, largest growth rate {} 1/s", digits(re, 4))?;
    let size = re.hypot(im);
    let damping_ratio = if size == 0.0 { 0.0 } else { -re / size };
    let frequency = digits(im.abs() / TAU, 4);
    writeln!(text, "Least stable mode: {frequency} Hz, damping ratio {}", digits(damping_ratio, 3))
}

fn critical_speed(text: &mut String, report: &Report, critical: &CriticalReport) -> fmt::Result {
    let reeled = report.cables.get(critical.cable - 1).map_or("", |cable| reeling(cable.length_rate));
    writeln!(text, "Critical speed: {}, which is {reeled}", critical_sentence(critical))?;
    let margin = critical.speed - report.speed;
    let (now, size) = (digits(report.speed, 6), digits(margin.abs(), 4));
    if margin > 0.0 {
        let part = 100.0 * report.speed / critical.speed;
        writeln!(text, "Margin: {size} m/s above the {now} m/s of the scenario, which uses {part:.0} % of it")
    } else {
        writeln!(text, "Margin: none, the {now} m/s of the scenario exceeds it by {size} m/s")
    }
}

/// Speed, kind and cable.
pub(super) fn critical_sentence(critical: &CriticalReport) -> String {
    let how = match critical.kind {
        KindReport::Flutter => format!("flutter at {} Hz", digits(critical.frequency_hz, 4)),
        KindReport::Divergence => "divergence (no oscillation)".into(),
    };
    format!("{} m/s, {how}, in cable {}", digits(critical.speed, 5), critical.cable)
}

/// `number` to a number of `significant` digits, without zeros at the end; with an exponent where it is very large or small.
pub(super) fn digits(number: f64, significant: usize) -> String {
    let rounded = format!("{number:.*e}", significant - 1);
    let exponent = rounded.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    let value: f64 = rounded.parse().unwrap_or(number);
    match exponent {
        Some(-5..=8) => value.to_string(),
        _ => format!("{value:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn digits_are_significant_ones() {
        for (number, significant, text) in [
            (11.299_042_8, 5, "11.299"),
            (11.3, 5, "11.3"),
            (0.271_550_2, 4, "0.2716"),
            (-0.000_123_456, 3, "-0.000123"),
            (6250.0, 4, "6250"),
            (123_456.0, 4, "123500"),
            (1.5e12, 4, "1.5e12"),
            (1.5e-9, 4, "1.5e-9"),
            (0.0, 4, "0"),
            (40.0, 6, "40"),
        ] {
            assert_eq!(digits(number, significant), text);
        }
    }
}
