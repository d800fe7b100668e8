//! What differs between the present design and those that are kept, as a table.

use crate::app::answers::{Answers, CriticalState};
use crate::app::certainty::Certainty;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::fields::Field;
use crate::app::number;
use crate::app::settings::Settings;
use crate::robot::{BoundingBox, Linearisation, Strain, TensionLaw, Vec2};
use crate::scenario::report::CriticalReport;
use crate::scenario::{Corners, Parameter, Path, ProfileKind, Scenario};

/// Stands where a design has no such number.
const NONE: &str = "–";

/// The table: a column for each design, a row for each thing that is compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// What the columns are called: "Now", then the letters of the designs that are shown.
    pub columns: Vec<&'static str>,
    /// The answers, whether they differ or not.
    pub answers: Vec<Row>,
    /// What of the designs differs.
    pub differences: Vec<Row>,
}

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What is compared.
    pub name: String,
    /// It, in each column.
    pub cells: Vec<String>,
}

/// A column's design with what is known of it.
struct Column<'a> {
    name: &'static str,
    scenario: &'a Scenario,
    answers: &'a Answers,
    certainty: Certainty,
}

impl Comparison {
    /// The present design and those that are shown.
    pub fn of(facts: Facts<'_>) -> Self {
        let present = Column {
            name: "Now",
            scenario: &facts.document.scenario,
            answers: facts.answers,
            certainty: facts.certainty,
        };
        let kept = facts.designs.shown().map(|(letter, design)| Column {
            name: letter.name(),
            scenario: &design.document.scenario,
            answers: design.answers(),
            certainty: design.certainty(),
        });
        let columns: Vec<Column<'_>> = std::iter::once(present).chain(kept).collect();
        let scenarios: Vec<&Scenario> = columns.iter().map(|column| column.scenario).collect();
        Self {
            columns: columns.iter().map(|column| column.name).collect(),
            answers: answers(&columns, facts.settings),
            differences: differences(&scenarios, facts.settings),
        }
    }
}

/// The rows of what is known of each.
fn answers(columns: &[Column<'_>], settings: Settings) -> Vec<Row> {
    let (hertz, unit) = settings.hertz();
    let critical = |name: &str, value: &dyn Fn(&CriticalReport, Certainty) -> String| Row {
        name: name.into(),
        cells: columns.iter().map(|column| of_critical(column, value)).collect(),
    };
    let waves = |column: &Column<'_>| {
        let limit = column.answers.pose().filter(|_| column.answers.pose_is_current())?.report.wave_limit.as_ref()?;
        Some(format!("{} m/s", digits::like(limit.speed, None)))
    };
    vec![
        critical("Critical speed", &|critical, certainty| {
            format!("{} m/s", digits::certain(critical.speed, certainty.speed()))
        }),
        critical("Frequency", &|critical, certainty| {
            let uncertainty = certainty.frequency_hz().map(|off| off * hertz);
            format!("{} {unit}", digits::certain(critical.frequency_hz * hertz, uncertainty))
        }),
        critical("Kind", &|critical, _| critical.kind.to_string()),
        critical("Cable", &|critical, _| critical.cable.to_string()),
        Row {
            name: "Wave limit".into(),
            cells: columns.iter().map(|column| waves(column).unwrap_or_else(|| NONE.into())).collect(),
        },
    ]
}

/// Something of a critical speed, or why there is none.
fn of_critical(column: &Column<'_>, value: &dyn Fn(&CriticalReport, Certainty) -> String) -> String {
    match column.answers.critical() {
        CriticalState::Current(answer) => match &answer.critical {
            Some(critical) => value(&CriticalReport::from(critical), column.certainty),
            None if answer.failure.is_some() => "not known".into(),
            None => "none found".into(),
        },
        CriticalState::Recomputing { .. } => "…".into(),
        CriticalState::Failed(_) => "no equilibrium".into(),
        CriticalState::Broken(_) => "not known".into(),
    }
}

/// The rows of what is not the same in all designs.
fn differences(scenarios: &[&Scenario], settings: Settings) -> Vec<Row> {
    let texts = |name: String, text: &dyn Fn(&Scenario) -> String| Row {
        name,
        cells: scenarios.iter().map(|scenario| text(scenario)).collect(),
    };
    let most = scenarios.iter().map(|scenario| scenario.cables.len()).max().unwrap_or_default();
    let mut rows = vec![
        texts("Cables".into(), &|scenario| scenario.cables.len().to_string()),
        texts("Strain".into(), &|scenario| strain(scenario.cable.strain).into()),
        texts("Stiffness".into(), &|scenario| stiffness(scenario.linearisation).into()),
        texts("Path".into(), &|scenario| scenario.path.as_ref().map_or(NONE.into(), shape)),
        texts("Motion profile".into(), &|scenario| scenario.path.as_ref().map_or(NONE, profile).into()),
    ];
    for i in 0..most {
        rows.push(texts(format!("Tension of cable {}", i + 1), &|scenario| {
            scenario.cables.get(i).map_or(NONE, |cable| kind(&cable.tension)).into()
        }));
    }
    rows.retain(|row| row.cells.windows(2).any(|pair| pair[0] != pair[1]));
    let numbers = parameters(scenarios).into_iter().filter(|parameter| counts(*parameter, scenarios));
    rows.extend(numbers.filter_map(|parameter| number_row(parameter, scenarios, settings)));
    rows
}

/// Whether a number is worth a row: a profile may not have it, and where one design has a path and another has none, the
/// row of the path says it all.
fn counts(parameter: Parameter, scenarios: &[&Scenario]) -> bool {
    let paths = || scenarios.iter().filter_map(|scenario| scenario.path.as_ref());
    match parameter {
        Parameter::PathAcceleration => {
            paths().any(|path| matches!(path.profile, ProfileKind::Trapezoid | ProfileKind::Scurve))
        }
        Parameter::PathJerk => paths().any(|path| path.profile == ProfileKind::Scurve),
        Parameter::PathPoint(..) => paths().count() > 1,
        _ => true,
    }
}

/// All numbers that one of the designs has. A direction is one number to people.
fn parameters(scenarios: &[&Scenario]) -> Vec<Parameter> {
    let mut all = Vec::new();
    for parameter in scenarios.iter().flat_map(|scenario| Parameter::all(scenario)) {
        let parameter =
            if matches!(parameter, Parameter::DirectionComponent(_)) { Parameter::Direction } else { parameter };
        if !all.contains(&parameter) {
            all.push(parameter);
        }
    }
    all
}

/// The row of a number, where it is not the same in all designs.
fn number_row(parameter: Parameter, scenarios: &[&Scenario], settings: Settings) -> Option<Row> {
    let value = |scenario: &&Scenario| parameter.is_in(scenario).then(|| parameter.get(scenario));
    let values: Vec<Option<f64>> = scenarios.iter().map(value).collect();
    if values.windows(2).all(|pair| pair[0] == pair[1]) {
        return None;
    }
    let nowhere = BoundingBox { low: Vec2::zeros(), high: Vec2::zeros() };
    let field = Field::of(parameter, nowhere).in_units_of(settings);
    let unit = field.unit();
    let cells = |text: &dyn Fn(f64) -> String| -> Vec<String> {
        values.iter().map(|value| value.map_or_else(|| NONE.into(), text)).collect()
    };
    let brief = cells(&|value| unit.with_name(&number::brief(unit.shown(value))));
    // Numbers that differ do not look the same.
    let alike = values
        .iter()
        .zip(&brief)
        .any(|(value, text)| values.iter().zip(&brief).any(|(other, same)| value != other && text == same));
    let cells = if alike { cells(&|value| unit.with_name(&unit.full(value))) } else { brief };
    Some(Row { name: field.full_name(), cells })
}

fn strain(strain: Strain) -> &'static str {
    match strain {
        Strain::Green => "Green",
        Strain::Engineering => "engineering",
    }
}

fn stiffness(linearisation: Linearisation) -> &'static str {
    match linearisation {
        Linearisation::Secant => "secant",
        Linearisation::Tangent => "tangent",
    }
}

/// How many points a path leads to, and how it passes them.
fn shape(path: &Path) -> String {
    match (path.points.len(), path.corners) {
        (1, _) => "straight".into(),
        (count, Corners::Stop) => format!("{count} points, stops"),
        (count, Corners::Smooth) => format!("{count} points, smooth"),
    }
}

fn profile(path: &Path) -> &'static str {
    match path.profile {
        ProfileKind::Quintic => "quintic",
        ProfileKind::Trapezoid => "trapezoid",
        ProfileKind::Scurve => "S-curve",
        ProfileKind::Constant => "constant",
    }
}

fn kind(tension: &TensionLaw) -> &'static str {
    match tension {
        TensionLaw::Equilibrium => "balances",
        TensionLaw::Constant(_) => "constant",
        TensionLaw::Hypot { .. } => "law",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::presets;

    fn paper() -> Scenario {
        presets::PRESETS[0].scenario()
    }

    fn rows(scenarios: &[&Scenario]) -> Vec<(String, Vec<String>)> {
        let rows = differences(scenarios, Settings::default());
        rows.into_iter().map(|row| (row.name, row.cells)).collect()
    }

    #[test]
    fn only_what_differs_has_a_row() {
        assert_eq!(rows(&[&paper(), &paper()]), []);
        let mut heavy = paper();
        heavy.platform.mass = 2.5;
        heavy.cable.youngs_modulus = 2.5e8;
        heavy.linearisation = Linearisation::Tangent;
        heavy.name = Some("A name is no number".into());
        let row = |name: &str, cells: [&str; 3]| (name.to_owned(), cells.map(ToOwned::to_owned).to_vec());
        assert_eq!(
            rows(&[&paper(), &heavy, &paper()]),
            [
                row("Stiffness", ["secant", "tangent", "secant"]),
                row("Young's modulus E", ["125 MPa", "250 MPa", "125 MPa"]),
                row("Platform mass m", ["2 kg", "2.5 kg", "2 kg"]),
            ]
        );
    }

    #[test]
    fn what_a_design_does_not_have_is_said() {
        let mut less = paper();
        less.cables.pop();
        less.cables[2].tension = TensionLaw::Constant(40.0);
        let rows = rows(&[&paper(), &less]);
        let cells = |name: &str| rows.iter().find(|row| row.0 == name).map(|row| row.1.join(", "));
        assert_eq!(cells("Cables").as_deref(), Some("4, 3"));
        assert_eq!(cells("Tension of cable 3").as_deref(), Some("law, constant"));
        assert_eq!(cells("Tension of cable 4").as_deref(), Some("law, –"));
        assert_eq!(cells("x of winch 4").as_deref(), Some("10 m, –"));
        assert_eq!(cells("T of cable 3").as_deref(), Some("–, 40 N"));
    }

    #[test]
    fn of_paths_only_what_counts_has_a_row() {
        let mut straight = Scenario { path: Some(Path::new(vec![[6.0, 0.0]], 5.0)), ..paper() };
        let names = |scenarios: &[&Scenario]| rows(scenarios).into_iter().map(|row| row.0).collect::<Vec<_>>();
        let cells = |scenarios: &[&Scenario], name: &str| {
            rows(scenarios).into_iter().find(|row| row.0 == name).map(|row| row.1.join("; "))
        };
        // A quintic has neither acceleration nor jerk.
        let with_and_without = names(&[&paper(), &straight]);
        assert_eq!(with_and_without[..2], ["Path", "Motion profile"]);
        assert!(with_and_without.len() == 4, "{with_and_without:?}");
        assert_eq!(cells(&[&paper(), &straight], "Path").as_deref(), Some("–; straight"));
        let mut smooth = straight.clone();
        if let Some(path) = &mut smooth.path {
            (path.corners, path.profile, path.acceleration) = (Corners::Smooth, ProfileKind::Scurve, 3.0);
            path.points = vec![[5.0, 0.0], [6.0, 2.0]];
        }
        let pair = [&straight, &smooth];
        assert_eq!(cells(&pair, "Path").as_deref(), Some("straight; 2 points, smooth"));
        assert_eq!(cells(&pair, "Motion profile").as_deref(), Some("quintic; S-curve"));
        assert_eq!(cells(&pair, "x of point 1").as_deref(), Some("6 m; 5 m"));
        assert_eq!(cells(&pair, "y of point 2").as_deref(), Some("–; 2 m"));
        assert!(names(&pair).iter().any(|name| name.contains("Acceleration")), "{:?}", names(&pair));
        assert!(!names(&pair).iter().any(|name| name.contains("Jerk")), "it is the same");
        if let Some(path) = &mut straight.path {
            (path.acceleration, path.jerk) = (7.0, 70.0);
        }
        let quintic = Scenario { path: Some(Path::new(vec![[6.0, 0.0]], 5.0)), ..paper() };
        assert_eq!(names(&[&straight, &quintic]), Vec::<String>::new(), "numbers that a quintic does not have");
    }

    #[test]
    fn numbers_that_differ_look_different() {
        let mut nearly = paper();
        nearly.platform.mass = 2.0 + 1e-12;
        let rows = rows(&[&paper(), &nearly]);
        assert!(rows.len() == 1 && rows[0].1[0] != rows[0].1[1], "{rows:?}");
    }
}
