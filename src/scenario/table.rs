//! The cables as a table that spreadsheets take and give: text to cables, and back.
//!
//! A line is a cable. Its columns are `number`, `x`, `y` (m), `tension` and, where a cable has a material of its own, `E`
//! (Pa), `A` (m²), `mu` (kg/m) and `strain`. A tension is `balances`, a number in N, or `law h0 hx hy v0 vx vy`. Columns are
//! parted by tabs, semicolons or commas; where it is not by commas, a comma may be the decimal sign.

use std::fmt::Write as _;

use crate::robot::{CABLES, OwnMaterial, Strain, TensionLaw};
use crate::scenario::Scenario;
use crate::scenario::json::Cable;

/// A column of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    Number,
    X,
    Y,
    Tension,
    Modulus,
    Area,
    Mass,
    Strain,
}

impl Column {
    /// All of them in their order, each with its name and unit, and with other names that are understood, in small
    /// letters.
    const ALL: [(Self, &'static str, &'static str, &'static [&'static str]); 8] = [
        (Self::Number, "number", "", &["no", "no.", "nr", "nr.", "#", "cable", "n°"]),
        (Self::X, "x", "m", &[]),
        (Self::Y, "y", "m", &[]),
        (Self::Tension, "tension", "N", &["t", "force"]),
        (Self::Modulus, "E", "Pa", &["youngs_modulus", "young's modulus", "youngs modulus"]),
        (Self::Area, "A", "m²", &["area", "cross-section"]),
        (Self::Mass, "mu", "kg/m", &["μ", "µ", "mass_per_length", "mass per length"]),
        (Self::Strain, "strain", "", &[]),
    ];

    fn name(self) -> &'static str {
        Self::ALL.iter().find(|(column, ..)| *column == self).map_or("", |(_, name, ..)| name)
    }

    fn unit(self) -> &'static str {
        Self::ALL.iter().find(|(column, ..)| *column == self).map_or("", |(_, _, unit, _)| unit)
    }
}

/// The cables as a table with a line of names, parted by tabs.
pub fn write(scenario: &Scenario) -> String {
    let own = scenario.cables.iter().any(|cable| !cable.cable.is_empty());
    let mut text = String::from("number\tx\ty\ttension");
    if own {
        text += "\tE\tA\tmu\tstrain";
    }
    for (i, Cable { anchor: [x, y], tension, cable }) in scenario.cables.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n{}\t{x}\t{y}\t", i + 1);
        let _ = match tension {
            TensionLaw::Equilibrium => write!(text, "balances"),
            TensionLaw::Constant(tension) => write!(text, "{tension}"),
            TensionLaw::Hypot { horizontal: [h0, hx, hy], vertical: [v0, vx, vy] } => {
                write!(text, "law {h0} {hx} {hy} {v0} {vx} {vy}")
            }
        };
        if own {
            for value in [cable.youngs_modulus, cable.area, cable.mass_per_length] {
                text.push('\t');
                if let Some(value) = value {
                    let _ = write!(text, "{value}");
                }
            }
            text += match cable.strain {
                Some(Strain::Green) => "\tgreen",
                Some(Strain::Engineering) => "\tengineering",
                None => "\t",
            };
        }
    }
    text.push('\n');
    text
}

/// Whether a text is meant as a table: it has two lines or more, and a line with two numbers or more.
pub fn is_table(text: &str) -> bool {
    let Some((rows, decimal_comma)) = rows(text) else { return false };
    let numbers = |row: &Row| row.cells.iter().filter(|cell| number(cell, decimal_comma).is_some()).count();
    rows.len() > 1 && rows.iter().any(|row| numbers(row) > 1)
}

/// The cables that a table describes, for a robot that has had the cables of `present`.
///
/// What the table does not have, a cable keeps: its tension and its own material. Where there is no column of tensions
/// and not exactly two of the present ones balance, the first two do. A cable that is new has the
/// [`usual_tension`] and no own material.
///
/// # Errors
/// What is wrong first, with row, column, value and what is allowed. Rows count from 1, the names' row included. Whether
/// the robot is physical with these cables, [`Scenario::to_robot`] tells.
pub fn read(text: &str, present: &Scenario) -> Result<Vec<Cable>, String> {
    let Some((rows, decimal_comma)) = rows(text) else {
        return Err("There is no table: its columns are parted by tabs, semicolons or commas.".into());
    };
    let names = rows.first().filter(|row| row.cells.iter().all(|cell| number(cell, decimal_comma).is_none()));
    let lines = if names.is_some() { rows.get(1..).unwrap_or_default() } else { &rows[..] };
    let columns = match names {
        Some(names) => by_name(names)?,
        None => by_order(lines, decimal_comma)?,
    };
    if !CABLES.contains(&lines.len()) {
        let (least, most) = (CABLES.start(), CABLES.end());
        return Err(format!("The table has {} cables; a robot has {least} to {most}.", lines.len()));
    }
    let places = places(lines, &columns, decimal_comma)?;
    let mut cables = vec![Cable::new([0.0; 2], TensionLaw::Equilibrium); lines.len()];
    for (line, place) in lines.iter().zip(places) {
        if let Some(cable) = cables.get_mut(place) {
            *cable = Reading { line, columns: &columns, decimal_comma }.cable(place, present)?;
        }
    }
    let balancing = |cables: &[Cable]| cables.iter().filter(|cable| cable.tension == TensionLaw::Equilibrium).count();
    if !columns.contains(&Column::Tension) && balancing(&cables) != 2 {
        for (i, cable) in cables.iter_mut().enumerate() {
            match cable.tension {
                _ if i < 2 => cable.tension = TensionLaw::Equilibrium,
                TensionLaw::Equilibrium => cable.tension = TensionLaw::Constant(usual_tension(present)),
                _ => {}
            }
        }
    }
    match balancing(&cables) {
        2 => Ok(cables),
        count => Err(format!("Column tension: \"balances\" must stand in exactly two rows, not in {count}.")),
    }
}

/// A tension in N that suits a further cable: the mean of those prescribed at the present pose, to three digits.
pub fn usual_tension(scenario: &Scenario) -> f64 {
    let at = scenario.motion.position;
    let prescribed = scenario.cables.iter().filter(|cable| cable.tension != TensionLaw::Equilibrium);
    let tensions: Vec<f64> = prescribed.map(|cable| cable.tension.at(at)).collect();
    #[expect(clippy::cast_precision_loss)] // A few cables.
    let mean = tensions.iter().sum::<f64>() / tensions.len().max(1) as f64;
    // To three digits: nobody means it more exactly.
    format!("{mean:.2e}").parse().ok().filter(|tension| *tension > 0.0).unwrap_or(1.0)
}

/// A line that is not empty.
struct Row {
    /// Its number in the text, from 1.
    number: usize,
    cells: Vec<String>,
}

/// The lines with their cells, and whether a comma may be the decimal sign; `None` where nothing parts columns.
fn rows(text: &str) -> Option<(Vec<Row>, bool)> {
    let text = text.trim_start_matches('\u{feff}');
    let separator = ['\t', ';', ','].into_iter().find(|separator| text.contains(*separator))?;
    let cells = |line: &str| line.split(separator).map(|cell| plain(cell).to_owned()).collect::<Vec<_>>();
    let lines = text.lines().enumerate().map(|(i, line)| Row { number: i + 1, cells: cells(line) });
    let rows: Vec<Row> = lines.filter(|row| row.cells.iter().any(|cell| !cell.is_empty())).collect();
    (!rows.is_empty()).then_some((rows, separator != ','))
}

/// A cell without the spaces and quotes around it.
fn plain(cell: &str) -> &str {
    let cell = cell.trim();
    cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"')).unwrap_or(cell).trim()
}

/// A finite number, in the forms that spreadsheets write.
fn number(cell: &str, decimal_comma: bool) -> Option<f64> {
    let cell = cell.replace('−', "-");
    let cell = if decimal_comma { cell.replace(',', ".") } else { cell };
    // Words like "infinity" are numbers to the parser.
    let digits = cell.chars().any(|c| c.is_ascii_digit());
    cell.parse().ok().filter(|number: &f64| digits && number.is_finite())
}

/// The columns that a row of names has.
fn by_name(names: &Row) -> Result<Vec<Column>, String> {
    let mut columns = Vec::new();
    // Columns without a name and without cells are left over at the right of many selections.
    let filled = names.cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
    for cell in &names.cells[..filled] {
        let (name, unit) = match cell.split_once(['(', '[', ',']) {
            Some((name, unit)) => (name.trim(), unit.trim_end_matches([')', ']']).trim()),
            None => (cell.as_str(), ""),
        };
        let low = name.to_lowercase();
        let is_it = |(_, name, _, others): &&(Column, &str, &str, &[&str])| {
            name.to_lowercase() == low || others.contains(&low.as_str())
        };
        let place = format!("Row {}", names.number);
        let Some((column, name, si, _)) = Column::ALL.iter().find(is_it) else {
            let all = Column::ALL.map(|(_, name, ..)| name).join(", ");
            return Err(format!("{place}: \"{cell}\" is no column of the table. There are {all}."));
        };
        if !unit.is_empty() && unit.replace("m2", "m²").replace("m^2", "m²") != *si {
            let wanted = if si.is_empty() { "no unit".to_owned() } else { format!("numbers in {si}") };
            return Err(format!("{place}, column {name}: the unit is \"{unit}\"; the table has {wanted} here."));
        }
        if columns.contains(column) {
            return Err(format!("{place}: the column {name} is there twice."));
        }
        columns.push(*column);
    }
    for needed in [Column::X, Column::Y] {
        if !columns.contains(&needed) {
            return Err(format!("{}: a column {} is needed, in m.", place_of(names), needed.name()));
        }
    }
    Ok(columns)
}

fn place_of(row: &Row) -> String {
    format!("Row {}", row.number)
}

/// The columns of a table without names: x, y and tension, the cables' numbers before them or not.
fn by_order(lines: &[Row], decimal_comma: bool) -> Result<Vec<Column>, String> {
    let filled = |row: &Row| row.cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
    let width = lines.iter().map(filled).max().unwrap_or(0);
    #[expect(clippy::cast_precision_loss)] // A few cables.
    let numbered = lines
        .iter()
        .enumerate()
        .all(|(i, row)| row.cells.first().and_then(|cell| number(cell, decimal_comma)) == Some((i + 1) as f64));
    let third = |row: &Row| row.cells.get(2).is_some_and(|cell| number(cell, decimal_comma).is_some());
    match width {
        2 => Ok(vec![Column::X, Column::Y]),
        3 if numbered && lines.iter().all(third) => Ok(vec![Column::Number, Column::X, Column::Y]),
        3 => Ok(vec![Column::X, Column::Y, Column::Tension]),
        4 if numbered => Ok(vec![Column::Number, Column::X, Column::Y, Column::Tension]),
        _ => Err(format!(
            "The table has {width} columns and no names. Without names there are x, y and tension, after the cables' \
             numbers 1, 2, 3 … or alone. A first row with names can have {}.",
            Column::ALL.map(|(_, name, ..)| name).join(", ")
        )),
    }
}

/// Which cable (0-based) each line is: by its number where there is such a column, else in order.
fn places(lines: &[Row], columns: &[Column], decimal_comma: bool) -> Result<Vec<usize>, String> {
    let Some(at) = columns.iter().position(|column| *column == Column::Number) else {
        return Ok((0..lines.len()).collect());
    };
    let mut places = Vec::new();
    for row in lines {
        let cell = row.cells.get(at).map_or("", String::as_str);
        #[expect(clippy::cast_precision_loss)] // A few cables.
        let place = (0..lines.len()).find(|place| number(cell, decimal_comma) == Some((place + 1) as f64));
        let Some(place) = place.filter(|place| !places.contains(place)) else {
            let (row, count) = (place_of(row), lines.len());
            return Err(format!(
                "{row}, column number: \"{cell}\" must be a whole number from 1 to {count}, each in one row."
            ));
        };
        places.push(place);
    }
    Ok(places)
}

/// One line on its way to a cable.
struct Reading<'a> {
    line: &'a Row,
    columns: &'a [Column],
    decimal_comma: bool,
}

impl Reading<'_> {
    /// The cell of a column; empty where the table has none.
    fn cell(&self, column: Column) -> &str {
        let at = self.columns.iter().position(|other| *other == column);
        at.and_then(|at| self.line.cells.get(at)).map_or("", String::as_str)
    }

    fn wrong(&self, column: Column, allowed: &str) -> String {
        let (place, name, cell) = (place_of(self.line), column.name(), self.cell(column));
        format!("{place}, column {name}: \"{cell}\" must be {allowed}.")
    }

    fn cable(&self, place: usize, present: &Scenario) -> Result<Cable, String> {
        let before = present.cables.get(place);
        let coordinate = |column: Column| {
            number(self.cell(column), self.decimal_comma).ok_or_else(|| self.wrong(column, "a number in m"))
        };
        let anchor = [coordinate(Column::X)?, coordinate(Column::Y)?];
        let tension = match self.tension()? {
            Some(tension) => tension,
            None => before.map_or_else(|| TensionLaw::Constant(usual_tension(present)), |cable| cable.tension),
        };
        let mut own = before.map(|cable| cable.cable).unwrap_or_default();
        let OwnMaterial { youngs_modulus, area, mass_per_length, strain } = &mut own;
        let numbers = [(Column::Modulus, youngs_modulus), (Column::Area, area), (Column::Mass, mass_per_length)];
        for (column, value) in numbers.into_iter().filter(|(column, _)| self.columns.contains(column)) {
            *value = self.positive(column)?;
        }
        if self.columns.contains(&Column::Strain) {
            *strain = match self.cell(Column::Strain).to_lowercase().as_str() {
                "" => None,
                "green" => Some(Strain::Green),
                "engineering" => Some(Strain::Engineering),
                _ => return Err(self.wrong(Column::Strain, "\"green\", \"engineering\" or empty")),
            };
        }
        Ok(Cable { anchor, tension, cable: own })
    }

    /// The positive number of a column, where there is one.
    fn positive(&self, column: Column) -> Result<Option<f64>, String> {
        let cell = self.cell(column);
        if cell.is_empty() {
            return Ok(None);
        }
        let value = number(cell, self.decimal_comma).filter(|value| *value > 0.0);
        value
            .map(Some)
            .ok_or_else(|| self.wrong(column, &format!("a number in {}, more than 0, or empty", column.unit())))
    }

    fn tension(&self) -> Result<Option<TensionLaw>, String> {
        let cell = self.cell(Column::Tension).to_lowercase();
        let wrong = || {
            let allowed = "\"balances\", a number in N, more than 0, or \"law h0 hx hy v0 vx vy\" with six numbers";
            self.wrong(Column::Tension, allowed)
        };
        if cell.is_empty() {
            return Ok(None);
        }
        if ["balances", "balance", "equilibrium"].contains(&cell.as_str()) {
            return Ok(Some(TensionLaw::Equilibrium));
        }
        if let Some(law) = cell.strip_prefix("law") {
            let numbers: Option<Vec<f64>> =
                law.split_whitespace().map(|part| number(part, self.decimal_comma)).collect();
            let numbers: [f64; 6] = numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(wrong)?;
            let [h0, hx, hy, v0, vx, vy] = numbers;
            return Ok(Some(TensionLaw::Hypot { horizontal: [h0, hx, hy], vertical: [v0, vx, vy] }));
        }
        let value = cell.strip_suffix('n').unwrap_or(&cell).trim_end();
        let tension = number(value, self.decimal_comma).filter(|tension| *tension > 0.0).ok_or_else(wrong)?;
        Ok(Some(TensionLaw::Constant(tension)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::presets;

    fn paper() -> Scenario {
        presets::PRESETS[0].scenario()
    }

    fn refused(text: &str) -> String {
        read(text, &paper()).expect_err("refused")
    }

    fn square(tensions: [TensionLaw; 4]) -> Vec<Cable> {
        let anchors = [[-10.5, 5.0], [10.5, 5.0], [-10.5, -5.0], [10.5, -5.0]];
        anchors.into_iter().zip(tensions).map(|(anchor, tension)| Cable::new(anchor, tension)).collect()
    }

    const TWO_BALANCE: [TensionLaw; 4] =
        [TensionLaw::Equilibrium, TensionLaw::Equilibrium, TensionLaw::Constant(67.3), TensionLaw::Constant(70.0)];

    #[test]
    fn what_is_written_is_read_again_to_the_last_bit() {
        for preset in presets::PRESETS {
            let mut scenario = preset.scenario();
            assert!(is_table(&write(&scenario)), "{}", preset.name);
            assert_eq!(read(&write(&scenario), &paper()).as_ref(), Ok(&scenario.cables), "{}", preset.name);
            scenario.cables[2].cable.youngs_modulus = Some(74.5e9 / 3.0);
            scenario.cables[0].cable = OwnMaterial {
                area: Some(1e-7),
                mass_per_length: Some(0.1),
                strain: Some(Strain::Engineering),
                ..OwnMaterial::default()
            };
            scenario.cables[1].cable.strain = Some(Strain::Green);
            scenario.cables[1].anchor = [1.0 / 3.0, 1e-9];
            assert_eq!(read(&write(&scenario), &paper()).as_ref(), Ok(&scenario.cables), "{}", preset.name);
        }
    }

    #[test]
    fn a_table_has_names_and_the_own_materials_where_there_are_some() {
        let mut scenario = paper();
        let first = |scenario: &Scenario| write(scenario).lines().next().map(str::to_owned);
        assert_eq!(first(&scenario).as_deref(), Some("number\tx\ty\ttension"));
        assert_eq!(write(&scenario).lines().nth(1), Some("1\t-10\t5\tbalances"));
        assert_eq!(write(&scenario).lines().nth(3), Some("3\t-10\t-5\tlaw 50 5 0 45 0 0"));
        scenario.cables[3].cable.area = Some(2e-5);
        assert_eq!(first(&scenario).as_deref(), Some("number\tx\ty\ttension\tE\tA\tmu\tstrain"));
        assert_eq!(write(&scenario).lines().nth(4), Some("4\t10\t-5\tlaw 50 -5 0 45 0 0\t\t0.00002\t\t"));
    }

    /// As each program puts a selection on the clipboard or in a file.
    #[test]
    fn the_forms_of_spreadsheets_are_read() {
        let forms = [
            // Excel: tabs, both ends of lines, an empty row after the last.
            "x\ty\ttension\r\n-10.5\t5\tbalances\r\n10.5\t5\tbalances\r\n-10.5\t-5\t67.3\r\n10.5\t-5\t70\r\n",
            // The same in a country with decimal commas, without names.
            "-10,5\t5\tbalances\r\n10,5\t5\tbalances\r\n-10,5\t-5\t67,3\r\n10,5\t-5\t70\r\n",
            // Google Sheets: tabs, no end of the last line, a typographic minus, empty columns beside the table.
            "Number\tX\tY\tTension\t\n1\t−10.5\t5\tbalances\t\n2\t10.5\t5\tbalances\t\n3\t−10.5\t−5\t67.3\t\n4\t10.5\t−5\t70\t",
            // LibreOffice: a CSV file with quotes, semicolons and decimal commas.
            "\"x\";\"y\";\"tension\"\n-10,5;5;\"balances\"\n10,5;5;\"balances\"\n-10,5;-5;67,3\n10,5;-5;70\n",
            // CSV with commas, a mark at the start, units in the names, other names and another order.
            "\u{feff}T (N),y [m],x (m),No.\nequilibrium,5,-10.5,1\nBalances,5,10.5,2\n67.3 N,-5,-10.5,3\n7e1,-5,10.5,4\n",
            // The rows in another order than their numbers, an empty row between them.
            "number\tx\ty\ttension\n4\t10.5\t-5\t70\n1\t-10.5\t5\tbalances\n\n3\t-10.5\t-5\t67.3\n2\t10.5\t5\tbalances\n",
            // Numbers before, no names.
            "1;-10.5;5;balances\n2;10.5;5;balances\n3;-10.5;-5;67.3\n4;10.5;-5;70",
        ];
        for form in forms {
            assert!(is_table(form), "{form}");
            assert_eq!(read(form, &paper()), Ok(square(TWO_BALANCE)), "{form}");
        }
    }

    #[test]
    fn what_the_table_does_not_have_stays() {
        let mut present = paper();
        present.cables[1].cable.area = Some(2e-5);
        let text = "x\ty\n-10.5\t5\n10.5\t5\n-10.5\t-5\n10.5\t-5";
        let read_on = |present: &Scenario, text: &str| read(text, present).expect("a table");
        let moved = read_on(&present, text);
        for (cable, before) in moved.iter().zip(&present.cables) {
            assert_eq!((cable.tension, cable.cable), (before.tension, before.cable));
        }
        assert_eq!(moved[0], Cable { anchor: [-10.5, 5.0], ..present.cables[0] });
        // Single cells that are empty, too; a column that is there and empty takes the own value away.
        let mixed = read_on(&present, "x\ty\tT\tA\n-9\t5\t\t\n9\t5\t\t\n-9\t-5\t80\t\n9\t-5\t\t1e-5");
        assert_eq!(mixed[2].tension, TensionLaw::Constant(80.0));
        assert_eq!(mixed[3].tension, present.cables[3].tension);
        assert_eq!((mixed[1].cable.area, mixed[3].cable.area), (None, Some(1e-5)));
        // A fifth cable has the mean tension: hypot(50, 45) N at the middle.
        let five = read_on(&present, "-9;5\n9;5\n-9;-5\n9;-5\n0;-6");
        assert_eq!(five[4].tension, TensionLaw::Constant(67.3));
        // Where other cables than those in the table balance, the first two do.
        present.cables.swap(0, 3);
        let three = read_on(&present, "-9;5\n9;5\n0;-5");
        let balance: Vec<bool> = three.iter().map(|cable| cable.tension == TensionLaw::Equilibrium).collect();
        assert_eq!(balance, [true, true, false]);
        // The numbers of cables, and no tensions.
        let numbered = read_on(&paper(), "1\t-9\t5\n2\t9\t5\n3\t-9\t-5\n4\t9\t-5");
        assert_eq!(numbered[2], Cable { anchor: [-9.0, -5.0], ..paper().cables[2] });
    }

    #[test]
    fn a_law_may_have_decimal_commas() {
        let text =
            "x;y;tension\n-10,5;5;balances\n10,5;5;balances\n-10,5;-5;law 50 0,5 0 45 0 0\n10,5;-5;Law 1 2 3 4 5 6";
        let laws = [([50.0, 0.5, 0.0], [45.0, 0.0, 0.0]), ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0])];
        let [third, fourth] = laws.map(|(horizontal, vertical)| TensionLaw::Hypot { horizontal, vertical });
        assert_eq!(read(text, &paper()), Ok(square([TWO_BALANCE[0], TWO_BALANCE[1], third, fourth])));
    }

    #[test]
    fn faults_name_row_column_value_and_what_is_allowed() {
        let rest = "\n10\t5\tbalances\n-10\t-5\t60\n10\t-5\t60";
        let first = |row: &str| refused(&format!("x\ty\ttension\n{row}{rest}"));
        assert_eq!(first("ten\t5\tbalances"), "Row 2, column x: \"ten\" must be a number in m.");
        assert_eq!(first("-10\t\tbalances"), "Row 2, column y: \"\" must be a number in m.");
        assert_eq!(first("-10\t1.234,5\tbalances"), "Row 2, column y: \"1.234,5\" must be a number in m.");
        assert_eq!(first("inf\t5\tbalances"), "Row 2, column x: \"inf\" must be a number in m.");
        assert_eq!(first("#N/A\t5\tbalances"), "Row 2, column x: \"#N/A\" must be a number in m.");
        let allowed = "\"balances\", a number in N, more than 0, or \"law h0 hx hy v0 vx vy\" with six numbers";
        for cell in ["-5", "0", "slack", "law 1 2 3", "law 1 2 3 4 5 x"] {
            let wrong = format!("Row 2, column tension: \"{cell}\" must be {allowed}.");
            assert_eq!(first(&format!("-10\t5\t{cell}")), wrong);
        }
        assert_eq!(first("-10\t5\t60"), "Column tension: \"balances\" must stand in exactly two rows, not in 1.");
        let named = |names: &str| refused(&format!("{names}\n-10\t5\tbalances{rest}"));
        assert_eq!(
            named("x\ty\ttensoin"),
            "Row 1: \"tensoin\" is no column of the table. There are number, x, y, tension, E, A, mu, strain."
        );
        assert_eq!(
            named("x\ty (mm)\ttension"),
            "Row 1, column y: the unit is \"mm\"; the table has numbers in m here."
        );
        assert_eq!(named("x\tx\ttension"), "Row 1: the column x is there twice.");
        assert_eq!(named("x\tE\ttension"), "Row 1: a column y is needed, in m.");
        assert_eq!(
            refused("number\tx\ty\n1\t-10\t5\n2\t10\t5\n2\t-10\t-5"),
            "Row 4, column number: \"2\" must be a whole number from 1 to 3, each in one row."
        );
        assert_eq!(refused("1\t2\n3\t4"), "The table has 2 cables; a robot has 3 to 8.");
        assert!(
            refused("1\t2\t3\t4\t5\n1\t2\t3\t4\t5\n1\t2\t3\t4\t5").starts_with("The table has 5 columns and no names.")
        );
        assert_eq!(
            refused("x\ty\tA\tstrain\n-10\t5\t-1\t\n10\t5\t\t\n0\t-5\t\t"),
            "Row 2, column A: \"-1\" must be a number in m², more than 0, or empty."
        );
        assert_eq!(
            refused("x\ty\tA\tstrain\n-10\t5\t\tHooke\n10\t5\t\t\n0\t-5\t\t"),
            "Row 2, column strain: \"Hooke\" must be \"green\", \"engineering\" or empty."
        );
        assert!(refused("nothing").starts_with("There is no table"));
    }

    #[test]
    fn other_texts_are_no_tables() {
        let scenario = paper().to_json();
        for text in ["", "x", "hello, world\nhow, are you", "1, 2", "#s=AbC", " ", "\t\n\t\n"] {
            assert!(!is_table(text), "{text:?}");
        }
        // A scenario has commas and numbers; it is known by its brace before anybody asks.
        assert!(scenario.starts_with('{'));
    }
}
