//! The numbers of a scenario that can be turned: name, unit, range, meaning, where they live.

use crate::app::number::{self, Unit};
use crate::app::settings::{Settings, StressUnit};
use crate::robot::{Allowed, BoundingBox, ELEMENTS, Fault, Vec2};
use crate::scenario::{MOST_PATH_POINTS, Parameter, Scenario};

/// A number of the scenario with its control.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// What it is called.
    pub name: &'static str,
    /// Its letter in the equations.
    pub symbol: &'static str,
    /// The unit people use.
    pub unit: &'static str,
    /// The slider's range in displayed units; typed values may go beyond.
    pub range: [f64; 2],
    /// Whether equal steps of the slider are equal ratios.
    pub logarithmic: bool,
    /// Whether only whole numbers make sense.
    pub integer: bool,
    /// What it means.
    pub meaning: &'static str,
    /// The number.
    pub parameter: Parameter,
}

impl Field {
    /// The same in the units chosen.
    pub fn in_units_of(mut self, settings: Settings) -> Self {
        let modulus = matches!(self.parameter, Parameter::YoungsModulus | Parameter::OwnYoungsModulus(_));
        if modulus && settings.stress == StressUnit::Gigapascal {
            self.range = self.range.map(|end| end / 1e3);
            self.unit = "GPa";
        }
        self
    }

    /// The unit that it is shown in.
    pub fn unit(&self) -> Unit {
        Unit::of(self.unit)
    }

    /// What it is called where it stands alone: its name and letter, or its letter and the cable that it belongs to.
    pub fn full_name(&self) -> String {
        let title = self.title();
        if title == self.symbol && self.name != self.symbol { format!("{} {title}", self.name) } else { title }
    }

    /// What messages call it: its letter, with the cable that it belongs to.
    pub fn title(&self) -> String {
        match self.parameter {
            Parameter::Anchor(cable, _) => format!("{} of winch {}", self.symbol, cable + 1),
            Parameter::Tension(cable)
            | Parameter::Horizontal(cable, _)
            | Parameter::Vertical(cable, _)
            | Parameter::OwnYoungsModulus(cable)
            | Parameter::OwnArea(cable)
            | Parameter::OwnMassPerLength(cable) => format!("{} of cable {}", self.symbol, cable + 1),
            Parameter::PathPoint(point, _) => format!("{} of point {}", self.symbol, point + 1),
            _ => self.symbol.into(),
        }
    }
}

/// The numbers of the motion.
pub const MOTION: [Parameter; 4] =
    [Parameter::Speed, Parameter::Direction, Parameter::Position(0), Parameter::Position(1)];
/// Those of the cables' material.
pub const ROPE: [Parameter; 3] = [Parameter::YoungsModulus, Parameter::Area, Parameter::MassPerLength];
/// Those of a cable's own material.
pub fn own(cable: usize) -> [Parameter; 3] {
    [Parameter::OwnYoungsModulus(cable), Parameter::OwnArea(cable), Parameter::OwnMassPerLength(cable)]
}

/// The number that counts: of a cable, its own where it has one, else that of all cables.
pub fn value(parameter: Parameter, scenario: &Scenario) -> f64 {
    let common = parameter.common().filter(|_| !parameter.is_in(scenario));
    common.unwrap_or(parameter).get(scenario)
}

/// Those of the platform.
pub const PLATFORM: [Parameter; 2] = [Parameter::PlatformMass, Parameter::Gravity];
/// Damping.
pub const DAMPING: [Parameter; 2] = [Parameter::Alpha, Parameter::Beta];

/// The six coefficients of a cable's tension law.
pub fn law(cable: usize) -> [Parameter; 6] {
    let [h0, hx, hy] = [0, 1, 2].map(|i| Parameter::Horizontal(cable, i));
    let [v0, vx, vy] = [0, 1, 2].map(|i| Parameter::Vertical(cable, i));
    [h0, hx, hy, v0, vx, vy]
}

/// What the coefficients of a tension law mean.
pub const LAW: &str = "The tension at the platform's end follows the position: T = √((h0 + hx x + hy y)² + (v0 + vx x + \
                       vy y)²), as that of a force with a horizontal part and a vertical one.";
const POSITION: &str = "The platform's position: x to the right, y up. Drag the platform on the canvas for the same.";
const POINT: &str = "Where the path leads: x to the right, y up. Points can be dragged on the canvas.";
const WINCH: &str = "Where the winch is: x to the right, y up. Once unlocked it can be dragged on the canvas.";

impl Field {
    /// The field of a number; the sliders of places follow `frame`, the box that the winches span.
    #[expect(clippy::too_many_lines)] // One arm for each number.
    pub fn of(parameter: Parameter, frame: BoundingBox) -> Self {
        let (low, high) = (frame.low, frame.high);
        let named = |name, symbol, unit, range, meaning| Self {
            name,
            symbol,
            unit,
            range,
            logarithmic: false,
            integer: false,
            meaning,
            parameter,
        };
        let winch = |name, i: usize| {
            let more = 0.2 * (high[i] - low[i]);
            named(name, name, "m", [low[i] - more, high[i] + more], WINCH)
        };
        let coefficient = |name, i: usize| {
            let (unit, end) = if i == 0 { ("N", 500.0) } else { ("N/m", 50.0) };
            named(name, name, unit, [-end, end], LAW)
        };
        let logarithmic = |field: Self| Self { logarithmic: true, ..field };
        match parameter {
            Parameter::Speed => named(
                "Speed",
                "v",
                "m/s",
                [0.0, 40.0],
                "The platform's speed v along its direction of motion. The eigenvalues on show are those at this speed; \
                 the critical speed does not depend on it.",
            ),
            // The components of a direction are one number to people.
            Parameter::Direction | Parameter::DirectionComponent(_) => named(
                "Direction",
                "θ",
                "°",
                [-180.0, 180.0],
                "The direction of the motion: 0° to the right, 90° upward. Drag the arrow's tip on the canvas for the \
                 same.",
            ),
            Parameter::Position(0) => named("Position", "x", "m", [low.x, high.x], POSITION),
            Parameter::Position(_) => named("Position", "y", "m", [low.y, high.y], POSITION),
            Parameter::YoungsModulus | Parameter::OwnYoungsModulus(_) => logarithmic(named(
                "Young's modulus",
                "E",
                "MPa",
                [1.0, 300_000.0],
                "How hard the cables' material is to stretch. With the cross-section A it makes the axial stiffness EA.",
            )),
            Parameter::Area | Parameter::OwnArea(_) => logarithmic(named(
                "Cross-section",
                "A",
                "cm²",
                [0.001, 10.0],
                "The area of a cable that carries its load.",
            )),
            Parameter::MassPerLength | Parameter::OwnMassPerLength(_) => logarithmic(named(
                "Cable mass",
                "μ",
                "kg/m",
                [0.001, 10.0],
                "Mass of a metre of cable without tension. Waves run along a cable at √(T/μ): slowly where it is heavy.",
            )),
            Parameter::PlatformMass => {
                let meaning = "Mass of the platform. It counts as a point: it cannot turn.";
                logarithmic(named("Platform mass", "m", "kg", [0.01, 1000.0], meaning))
            }
            Parameter::Gravity => {
                named("Gravity", "g", "m/s²", [0.0, 20.0], "Gravitational acceleration. At 0 the cables are straight.")
            }
            Parameter::Alpha => named(
                "Mass damping",
                "α",
                "1/s",
                [0.0, 5.0],
                "Damping in proportion to mass, the α of αM + βK: all vibrations die out alike. It works against reeling \
                 in, which feeds all of them alike.",
            ),
            Parameter::Beta => logarithmic(named(
                "Stiffness damping",
                "β",
                "s",
                [0.0, 0.1],
                "Damping in proportion to stiffness, the β of αM + βK: fast vibrations die out first.",
            )),
            Parameter::Elements => {
                let meaning = "The straight pieces that each cable is computed as. The error falls as 1/n² for flutter, as 1/n for \
                               a divergence; the work grows faster than n. The plot Mesh error tells how large it is.";
                Self { integer: true, ..named("Elements per cable", "n", "", [2.0, 40.0], meaning) }
            }
            Parameter::Anchor(_, 0) => winch("x", 0),
            Parameter::Anchor(..) => winch("y", 1),
            Parameter::Tension(_) => logarithmic(named(
                "Tension",
                "T",
                "N",
                [1.0, 10_000.0],
                "The tension that the winch holds at the platform's end of this cable.",
            )),
            Parameter::Horizontal(_, i) => coefficient(["h0", "hx", "hy"][i.min(2)], i),
            Parameter::Vertical(_, i) => coefficient(["v0", "vx", "vy"][i.min(2)], i),
            Parameter::PathSpeed => named(
                "Peak speed",
                "v",
                "m/s",
                [0.1, 20.0],
                "The highest speed on the path; with a constant profile the only one. A short path may not reach it.",
            ),
            Parameter::PathAcceleration => named(
                "Acceleration",
                "a",
                "m/s²",
                [0.1, 30.0],
                "How fast the speed changes, at most, in a trapezoid or an S-curve.",
            ),
            Parameter::PathJerk => logarithmic(named(
                "Jerk",
                "j",
                "m/s³",
                [0.1, 1000.0],
                "How fast the acceleration changes in an S-curve.",
            )),
            Parameter::PathHold => named(
                "Hold",
                "Hold",
                "s",
                [0.0, 10.0],
                "How long the flight goes on after the move, to see what is left of the vibration.",
            ),
            Parameter::PathPoint(_, 0) => named("Point", "x", "m", [low.x, high.x], POINT),
            Parameter::PathPoint(..) => named("Point", "y", "m", [low.y, high.y], POINT),
        }
    }
}

/// The field of the number at a path of the scenario file, for what is said of it.
fn at_path(path: &str, scenario: &Scenario) -> Option<Field> {
    // A direction is one number to people, and two in a file: the angle comes before its components.
    let all = [Parameter::Direction].into_iter().chain(Parameter::all(scenario));
    let has = |parameter: &Parameter| {
        path.strip_prefix(&parameter.path()).is_some_and(|rest| rest.is_empty() || rest.starts_with('['))
    };
    let nowhere = BoundingBox { low: Vec2::zeros(), high: Vec2::zeros() };
    all.into_iter().find(has).map(|parameter| Field::of(parameter, nowhere))
}

/// Puts another value, as it is stored, in the place of a number. A cable that has none of its own gets one.
///
/// # Errors
/// Why it is not allowed, in the words of the field that it is about: mostly this one.
pub fn edited(scenario: &Scenario, field: &Field, value: f64, settings: Settings) -> Result<Scenario, String> {
    let mut edited = scenario.clone();
    if field.integer && value.fract() != 0.0 {
        let fault = Fault::new(field.parameter.path(), value, Allowed::Whole(ELEMENTS));
        return Err(in_words(&fault, scenario, settings));
    }
    field.parameter.give(&mut edited, value);
    check(&edited, settings).map(|()| edited)
}

/// Whether a scenario is physical.
///
/// # Errors
/// What is wrong first, in words.
pub fn check(scenario: &Scenario, settings: Settings) -> Result<(), String> {
    let Err(faults) = scenario.to_robot() else { return Ok(()) };
    Err(faults.list().first().map(|fault| in_words(fault, scenario, settings)).unwrap_or_default())
}

/// What is wrong, in the words and the unit of the field that it belongs to.
fn in_words(fault: &Fault, scenario: &Scenario, settings: Settings) -> String {
    let of = |path: &str| at_path(path, scenario).map(|field| field.in_units_of(settings));
    if let Allowed::OtherThanAnchor(other) = fault.allowed {
        let cables = 0..scenario.cables.len();
        let cable = cables.into_iter().find(|cable| fault.path == format!("cables[{cable}].anchor"));
        return match cable {
            Some(cable) => format!("Winch {} must not be where winch {} is", cable + 1, other + 1),
            None => fault.to_string(),
        };
    }
    let Some(field) = of(&fault.path) else { return of_path(&fault.path).unwrap_or_else(|| fault.to_string()) };
    let (title, unit) = (field.title(), field.unit());
    let zero = unit.with_name("0");
    let found = fault.value.parse().map(|value| unit.with_name(&number::brief(unit.shown(value))));
    let found = found.map(|found| format!(", not {found}")).unwrap_or_default();
    match &fault.allowed {
        Allowed::Positive => format!("{title} must be more than {zero}{found}"),
        Allowed::NotNegative { instead: "" } => format!("{title} must be {zero} or more{found}"),
        Allowed::NotNegative { instead } => format!("{title} must be {zero} or more{found}: {instead}"),
        Allowed::Finite => format!("{title} must be a finite number"),
        Allowed::Whole(range) => {
            format!("{title} must be a whole number from {} to {}{found}", range.start(), range.end())
        }
        Allowed::ProductsWith(paths) => {
            let others: Vec<&str> = paths.iter().filter_map(|path| of(path)).map(|field| field.symbol).collect();
            format!("The product of {title} and {} is too large or too small a number", others.join(" or "))
        }
        Allowed::OtherThanAnchor(_) => fault.to_string(),
        Allowed::Words(words) => format!("{title} must be {words}"),
    }
}

/// What is wrong with the shape of the path, which is no matter of one number.
fn of_path(path: &str) -> Option<String> {
    if path == "path.points" {
        return Some(format!("A path leads to 1 to {MOST_PATH_POINTS} points"));
    }
    if path == "path.corners" {
        return Some("These points have no smooth path: at one of them it would have to turn back".into());
    }
    let point: usize = path.strip_prefix("path.points[")?.strip_suffix(']')?.parse().ok()?;
    let before = if point == 0 { "its start".into() } else { format!("point {point}") };
    Some(format!("Point {} of the path must not be where {before} is", point + 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Corners, Path, presets};

    fn field(parameter: Parameter) -> Field {
        Field::of(parameter, BoundingBox { low: Vec2::zeros(), high: Vec2::zeros() })
    }

    #[test]
    fn every_field_has_its_unit_and_every_fault_finds_its_field() {
        for mut scenario in presets::PRESETS.iter().map(presets::Preset::scenario) {
            for parameter in [Parameter::OwnYoungsModulus(1), Parameter::OwnArea(1), Parameter::OwnMassPerLength(1)] {
                parameter.give(&mut scenario, 1.0);
            }
            scenario.path = Some(Path::new(vec![[0.1, 0.2]], 1.0));
            for field in Parameter::all(&scenario).into_iter().chain([Parameter::Direction]).map(field) {
                let kind = field.unit().dimension.kind();
                assert_eq!(kind == "a plain number", field.unit.is_empty(), "{}: {kind}", field.name);
                // The same number, and no other one, is found by the path of its fault.
                let mut wrong = scenario.clone();
                field.parameter.set(&mut wrong, f64::NAN);
                let faults = wrong.to_robot().map_or_else(crate::robot::Faults::into_list, |_| Vec::new());
                assert!(
                    faults.iter().any(|fault| fault.path.starts_with(&field.parameter.path())),
                    "{field:?}: {faults:?}"
                );
                let text = check(&wrong, Settings::default()).expect_err("no number");
                assert!(text.starts_with(field.symbol), "{field:?}: {text}");
            }
        }
    }

    #[test]
    fn what_is_not_allowed_is_said_in_the_words_and_the_unit_of_the_field() {
        let scenario = presets::PRESETS[0].scenario();
        let mut settings = Settings::default();
        let refused = |parameter: Parameter, value: f64, settings: Settings| {
            edited(&scenario, &field(parameter), value, settings).expect_err("refused")
        };
        assert_eq!(refused(Parameter::YoungsModulus, -5e6, settings), "E must be more than 0 MPa, not -5 MPa");
        let beyond = "The product of E and A is too large or too small a number";
        assert_eq!(
            (refused(Parameter::YoungsModulus, 1e-320, settings), refused(Parameter::YoungsModulus, 1e-310, settings)),
            (beyond.into(), beyond.into())
        );
        settings.stress = StressUnit::Gigapascal;
        assert_eq!(refused(Parameter::YoungsModulus, 0.0, settings), "E must be more than 0 GPa, not 0 GPa");
        assert_eq!(refused(Parameter::Area, 0.0, settings), "A must be more than 0 cm², not 0 cm²");
        assert_eq!(
            refused(Parameter::Speed, -1.0, settings),
            "v must be 0 m/s or more, not -1 m/s: turn the direction round to go back"
        );
        let mut path = scenario.clone();
        path.path = Some(Path::new(vec![path.motion.position], 1.0));
        let of = |path: &Scenario| check(path, settings).expect_err("refused");
        assert_eq!(of(&path), "Point 1 of the path must not be where its start is");
        path.path = Some(Path::new(Vec::new(), 1.0));
        assert_eq!(of(&path), "A path leads to 1 to 100 points");
        path.path = Some(Path { corners: Corners::Smooth, ..Path::new(vec![[4.0, 0.0], [1.0, 0.0]], 1.0) });
        assert!(of(&path).starts_with("These points have no smooth path"));
        let own = Parameter::OwnYoungsModulus(2);
        let mut with_own = scenario.clone();
        own.give(&mut with_own, 2e11);
        let refused_own = |value: f64| edited(&with_own, &field(own), value, settings).expect_err("refused");
        assert_eq!(refused_own(-5e9), "E of cable 3 must be more than 0 GPa, not -5 GPa");
        assert_eq!(refused_own(1e-310), "The product of E of cable 3 and A is too large or too small a number");
        assert_eq!(refused(Parameter::Elements, 2.5, settings), "n must be a whole number from 2 to 200, not 2.5");
        assert_eq!(refused(Parameter::Elements, 1e9, settings), "n must be a whole number from 2 to 200, not 1e9");
    }
}
