//! What people type into a field: a number, or a small calculation with or without units.
//!
//! ```text
//! sum     = product { ("+" | "−") product }
//! product = factor { ("*" | "/") factor | unit }
//! factor  = { "+" | "−" } atom [ power ]
//! atom    = number | "pi" | unit | "(" sum ")"
//! ```
//!
//! A unit may also be written as 1/s, as the fields do. A unit behind plain numbers belongs to all of them: 1/3 m is a third of a metre. Behind other units it belongs to the
//! last number: 6 kN/2 mm² is 3 kN/mm².

use super::unit::{self, Dimension, Quantity, Trouble, Unit};

/// Longer texts are not read; nobody types them.
pub const LONGEST: usize = 200;
/// Parentheses, powers and signs within each other.
const DEEPEST: usize = 40;

/// What is stored where `text` is typed into the field `name`, which is shown in `unit`.
///
/// # Errors
/// What cannot be read, or is of another kind, as a sentence about the field.
pub fn read(text: &str, name: &str, unit: Unit) -> Result<f64, String> {
    let text = text.trim();
    if text.is_empty() {
        return Err(format!("{name} needs a number"));
    }
    let quantity = evaluate(text)?;
    unit.stored(quantity).map_err(|trouble| match trouble {
        Trouble::Unlike => {
            let (wanted, typed) = (unit.dimension.kind(), quantity.dimension.kind());
            format!("{name} is {wanted}; {} is {typed}", unit_of(text))
        }
        other => told(other, text),
    })
}

/// What a unit's name means, such as "kg/m".
pub fn unit(name: &str) -> Option<Quantity> {
    if name.is_empty() { Some(Quantity::plain(1.0)) } else { evaluate(name).ok() }
}

fn evaluate(text: &str) -> Result<Quantity, String> {
    if text.chars().count() > LONGEST {
        return Err(format!("This is longer than {LONGEST} letters"));
    }
    let mut parser = Parser { text, tokens: tokens(text)?, next: 0, depth: 0 };
    let result = parser.sum()?;
    match parser.peek() {
        None => Ok(result),
        Some(token) if token.kind == Kind::Close => {
            Err("There is one closing parenthesis more than opening ones".into())
        }
        Some(token) => Err(format!("Before {} a + − * or / is missing", quoted(&text[token.from..token.to]))),
    }
}

fn told(trouble: Trouble, text: &str) -> String {
    match trouble {
        Trouble::TooLarge => format!("{} is too large a number", quoted(text)),
        Trouble::TooSmall => format!("{} is not zero, but too small a number", quoted(text)),
        Trouble::ByZero => "Nothing can be divided by zero".into(),
        Trouble::Power => format!("{} has a power without a meaning", quoted(text)),
        Trouble::Unlike => format!("{} adds up unlike quantities", quoted(text)),
    }
}

/// In quotation marks, and not too long for a message.
fn quoted(text: &str) -> String {
    let mut letters = text.chars();
    let start: String = letters.by_ref().take(24).collect();
    let more = if letters.next().is_some() { "…" } else { "" };
    format!("“{start}{more}”")
}

/// The unit at the end of what was typed: behind a number alone, without it; else the whole.
fn unit_of(text: &str) -> String {
    let Ok(tokens) = tokens(text) else { return quoted(text) };
    let is_unit = |kind: Kind| matches!(kind, Kind::Word | Kind::Raised(_) | Kind::Times | Kind::Over);
    match &tokens[..] {
        [first, second, ..] if matches!(first.kind, Kind::Number(_)) && tokens[1..].iter().all(|t| is_unit(t.kind)) => {
            text[second.from..].to_owned()
        }
        all if all.iter().all(|token| is_unit(token.kind)) => text.to_owned(),
        _ => quoted(text),
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Number(f64),
    /// A unit, or pi.
    Word,
    /// Raised digits.
    Raised(i32),
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Open,
    Close,
}

/// A token and where it is, in bytes.
#[derive(Clone, Copy, Debug)]
struct Token {
    kind: Kind,
    from: usize,
    to: usize,
}

/// The letters of a text with their places, to look ahead in.
struct Letters<'a> {
    text: &'a str,
    at: usize,
}

impl Letters<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    /// Takes the next letter, if it is such a one.
    fn take(&mut self, such: impl Fn(char) -> bool) -> Option<char> {
        let letter = self.peek().filter(|letter| such(*letter))?;
        self.at += letter.len_utf8();
        Some(letter)
    }

    /// Takes as many letters as are such ones.
    fn take_all(&mut self, such: impl Fn(char) -> bool) -> String {
        std::iter::from_fn(|| self.take(&such)).collect()
    }
}

fn is_digit(letter: char) -> bool {
    letter.is_ascii_digit()
}

fn is_minus(letter: char) -> bool {
    matches!(letter, '-' | '−' | '–')
}

/// The value of a raised digit.
fn raised(letter: char) -> Option<i32> {
    let place = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|raised| raised == letter)?;
    i32::try_from(place).ok()
}

fn tokens(text: &str) -> Result<Vec<Token>, String> {
    let mut letters = Letters { text, at: 0 };
    let mut tokens = Vec::new();
    loop {
        letters.take_all(char::is_whitespace);
        let from = letters.at;
        let Some(letter) = letters.peek() else { return Ok(tokens) };
        let kind = if is_digit(letter) || matches!(letter, '.' | ',') {
            Kind::Number(number(&mut letters)?)
        } else if letter.is_alphabetic() || letter == '°' {
            letters.take_all(|letter| letter.is_alphabetic() || letter == '°');
            Kind::Word
        } else if letter == '⁻' || raised(letter).is_some() {
            let sign = if letters.take(|letter| letter == '⁻').is_some() { -1 } else { 1 };
            let digits = letters.take_all(|letter| raised(letter).is_some());
            let power = digits
                .chars()
                .filter_map(raised)
                .fold(0_i32, |power, digit| power.saturating_mul(10).saturating_add(digit));
            Kind::Raised(sign * power)
        } else {
            letters.take(|_| true);
            match letter {
                '+' => Kind::Plus,
                _ if is_minus(letter) => Kind::Minus,
                '*' if letters.take(|letter| letter == '*').is_some() => Kind::Power,
                '*' | '·' | '×' | '⋅' | '∙' => Kind::Times,
                '/' | '÷' | '∕' => Kind::Over,
                '^' => Kind::Power,
                '(' => Kind::Open,
                ')' => Kind::Close,
                _ => return Err(format!("{} has no meaning here", quoted(&letter.to_string()))),
            }
        };
        tokens.push(Token { kind, from, to: letters.at });
    }
}

/// Reads a number: with a decimal point or comma, spaces between groups of three digits, and an exponent.
fn number(letters: &mut Letters) -> Result<f64, String> {
    let from = letters.at;
    let mut run = letters.take_all(is_digit);
    let mut groups = 0;
    while (1..=3).contains(&run.len()) || groups > 0 {
        let here = letters.at;
        letters.take(char::is_whitespace);
        let group = letters.take_all(is_digit);
        if letters.at == here || group.len() != 3 {
            letters.at = here;
            break;
        }
        run += &group;
        groups += 1;
    }
    run += &letters.take_all(|letter| is_digit(letter) || matches!(letter, '.' | ','));
    let written = letters.text[from..letters.at].to_owned();
    let before = letters.at;
    if letters.take(|letter| matches!(letter, 'e' | 'E')).is_some() {
        let minus = letters.take(|letter| letter == '+' || is_minus(letter)).is_some_and(is_minus);
        let digits = letters.take_all(is_digit);
        if digits.is_empty() {
            letters.at = before; // A word that begins with e; there is no such unit, and that will be said.
        } else {
            run = decimal(&run, &written, groups > 0)? + if minus { "e-" } else { "e" } + &digits;
        }
    }
    if letters.at == before {
        run = decimal(&run, &written, groups > 0)?;
    }
    let written = &letters.text[from..letters.at];
    let value: f64 = run.parse().map_err(|_| format!("{} is not a number", quoted(written)))?;
    if !value.is_finite() {
        return Err(told(Trouble::TooLarge, written));
    }
    let mantissa = run.split('e').next().unwrap_or_default();
    if value == 0.0 && mantissa.contains(|digit| matches!(digit, '1'..='9')) {
        return Err(told(Trouble::TooSmall, written));
    }
    Ok(value)
}

/// Digits with commas and points, as Rust reads them. What can be read in two ways is not guessed.
fn decimal(run: &str, written: &str, grouped: bool) -> Result<String, String> {
    let marks: Vec<char> = run.chars().filter(|letter| !is_digit(*letter)).collect();
    match marks[..] {
        ['.'] if run.len() > 1 => Ok(run.to_owned()),
        [] => Ok(run.to_owned()),
        [','] => {
            let (whole, part) = run.split_once(',').unwrap_or((run, ""));
            if part.is_empty() {
                return Err(format!("{} ends with a comma", quoted(written)));
            }
            let thousands = part.len() == 3 && (1..=3).contains(&whole.len()) && !whole.starts_with('0') && !grouped;
            if thousands {
                return Err(format!(
                    "{} can be read in two ways: write {whole}.{part} or {whole}{part}",
                    quoted(written)
                ));
            }
            Ok(format!("{whole}.{part}"))
        }
        _ if run.chars().any(is_digit) => {
            // Where one mark differs from those before, it is the decimal one.
            let last = marks.last().copied().unwrap_or('.');
            let is_decimal = marks.iter().filter(|mark| **mark == last).count() == 1;
            let place = if is_decimal { run.rfind(last).unwrap_or(run.len()) } else { run.len() };
            let digits = |text: &str| text.chars().filter(|letter| is_digit(*letter)).collect::<String>();
            let (whole, part) = (digits(&run[..place]), digits(&run[place..]));
            let point = if part.is_empty() { "" } else { "." };
            Err(format!("{} has commas or points between thousands: write {whole}{point}{part}", quoted(written)))
        }
        _ => Err(format!("{} is not a number", quoted(written))),
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    next: usize,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.next).copied()
    }

    fn take(&mut self, kind: Kind) -> bool {
        let found = self.peek().is_some_and(|token| token.kind == kind);
        self.next += usize::from(found);
        found
    }

    fn told(&self, trouble: Trouble) -> String {
        told(trouble, self.text)
    }

    fn sum(&mut self) -> Result<Quantity, String> {
        let mut sum = self.product()?;
        loop {
            let sign = if self.take(Kind::Plus) {
                1
            } else if self.take(Kind::Minus) {
                -1
            } else {
                return Ok(sum);
            };
            let next = self.product()?;
            sum = sum.plus(if sign < 0 { next.negated() } else { next }).map_err(|trouble| match trouble {
                Trouble::Unlike => {
                    format!("{} and {} cannot be added", sum.dimension.kind(), next.dimension.kind())
                }
                other => self.told(other),
            })?;
        }
    }

    fn product(&mut self) -> Result<Quantity, String> {
        let mut product = self.factor()?;
        loop {
            product = if self.take(Kind::Times) {
                let factor = self.factor_of(product)?;
                product.times(factor)
            } else if self.take(Kind::Over) {
                let factor = self.factor_of(product)?;
                product.over(factor)
            } else if self.is_at_word() {
                let unit = self.factor()?;
                product.times(unit)
            } else if self.take_one_of_unit() {
                continue;
            } else {
                return Ok(product);
            }
            .map_err(|trouble| self.told(trouble))?;
        }
    }

    /// The next factor of `product`: with the units behind it, where there are units already.
    fn factor_of(&mut self, product: Quantity) -> Result<Quantity, String> {
        let mut factor = self.factor()?;
        while product.dimension != Dimension::NONE && self.is_at_word() {
            let unit = self.factor()?;
            factor = factor.times(unit).map_err(|trouble| self.told(trouble))?;
        }
        Ok(factor)
    }

    fn is_at_word(&self) -> bool {
        self.peek().is_some_and(|token| token.kind == Kind::Word)
    }

    /// Takes the 1 of a unit such as 1/s behind a number.
    fn take_one_of_unit(&mut self) -> bool {
        let kinds = [0, 1, 2].map(|ahead| self.tokens.get(self.next + ahead).map(|token| token.kind));
        let found = kinds == [Some(Kind::Number(1.0)), Some(Kind::Over), Some(Kind::Word)];
        self.next += usize::from(found);
        found
    }

    fn factor(&mut self) -> Result<Quantity, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("{} is nested too deeply", quoted(self.text)));
        }
        let factor = self.signed()?;
        self.depth -= 1;
        Ok(factor)
    }

    fn signed(&mut self) -> Result<Quantity, String> {
        if self.take(Kind::Minus) {
            return Ok(self.factor()?.negated());
        }
        if self.take(Kind::Plus) {
            return self.factor();
        }
        let base = self.atom()?;
        let power = if self.take(Kind::Power) {
            self.factor()?
        } else {
            match self.peek().map(|token| token.kind) {
                Some(Kind::Raised(power)) => {
                    self.next += 1;
                    Quantity::plain(f64::from(power))
                }
                _ => return Ok(base),
            }
        };
        base.to_the(power).map_err(|trouble| self.told(trouble))
    }

    fn atom(&mut self) -> Result<Quantity, String> {
        let Some(token) = self.peek() else {
            return Err(format!("Something is missing behind {}", quoted(self.text)));
        };
        self.next += 1;
        let written = &self.text[token.from..token.to];
        match token.kind {
            Kind::Number(number) => Ok(Quantity::plain(number)),
            Kind::Word => self.word(token, written),
            Kind::Open => {
                let inner = self.sum()?;
                if self.take(Kind::Close) { Ok(inner) } else { Err("A closing parenthesis is missing".into()) }
            }
            _ => Err(format!("Before {} a number is missing", quoted(written))),
        }
    }

    /// A unit, with the 2 of mm2, or pi.
    fn word(&mut self, token: Token, written: &str) -> Result<Quantity, String> {
        if matches!(written, "pi" | "Pi" | "PI" | "π") {
            return Ok(Quantity::plain(std::f64::consts::PI));
        }
        let Some(unit) = unit::named(written) else {
            let similar = unit::similar(written);
            let hint = if similar.is_empty() { String::new() } else { format!(": {}?", similar.join(" or ")) };
            return Err(format!("{} is neither a number nor a unit{hint}", quoted(written)));
        };
        match self.peek() {
            Some(Token { kind: Kind::Number(power), from, to }) if from == token.to && to == from + 1 => {
                self.next += 1;
                unit.to_the(Quantity::plain(power)).map_err(|trouble| self.told(trouble))
            }
            _ => Ok(unit),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;

    fn typed(text: &str, unit: &'static str) -> Result<f64, String> {
        read(text, "X", Unit::of(unit))
    }

    /// Typed text, the field's unit, what is stored in SI units.
    const NUMBERS: [(&str, &str, f64); 38] = [
        ("1.5", "m", 1.5),
        ("1,5", "m", 1.5),
        (" 1,5 ", "m", 1.5),
        ("0,125", "m", 0.125),
        ("1234,5", "m", 1234.5),
        (",5", "m", 0.5),
        (".5", "m", 0.5),
        ("5.", "m", 5.0),
        ("-3", "m", -3.0),
        ("−3", "m", -3.0),
        ("+3", "m", 3.0),
        ("4e-7", "s", 4e-7),
        ("4E−7", "s", 4e-7),
        ("4·10⁻⁷", "s", 4e-7),
        ("1,2345678e-5", "s", 1.234_567_8e-5),
        ("10 000", "m", 10_000.0),
        ("1 234 567,25", "m", 1_234_567.25),
        ("10\u{a0}000", "m", 10_000.0),
        ("1 234,567", "m", 1_234.567),
        ("0e0", "m", 0.0),
        // The field's unit is meant where none is written.
        ("125", "MPa", 125e6),
        ("0.25", "GPa", 0.25e9),
        ("0.5", "cm²", 5e-5),
        ("1.1", "cm²", 1.1e-4),
        ("0.3", "cm²", 3e-5),
        ("180", "°", PI),
        ("10", "", 10.0),
        // Calculations.
        ("1/3", "m", 1.0 / 3.0),
        ("2*pi", "m", 2.0 * PI),
        ("2π", "m", 2.0 * PI),
        ("2 pi", "m", 2.0 * PI),
        ("1 + 2 * 3 - 4/2", "m", 5.0),
        ("(1 + 2) * -(3 - 5)", "m", 6.0),
        ("-2^2", "m", -4.0),
        ("2^3^2", "m", 512.0),
        ("2**-1", "m", 0.5),
        ("2²", "m", 4.0),
        ("3 × 4 ÷ 6", "m", 2.0),
    ];

    /// The same, with units.
    const UNITS: [(&str, &str, f64); 54] = [
        ("12 m", "m", 12.0),
        ("12m", "m", 12.0),
        ("1,5 m", "m", 1.5),
        ("250 mm", "m", 0.25),
        ("25 cm", "m", 0.25),
        ("2 in", "m", 0.0508),
        ("5 ft", "m", 1.524),
        ("5 ft + 6 in", "m", 1.6764),
        ("3/4 in", "m", 0.01905),
        ("1/3 m", "m", 1.0 / 3.0),
        ("1 m + 2 mm", "m", 1.002),
        ("2 * 3 m", "m", 6.0),
        ("3 m * 2", "m", 6.0),
        ("500 g", "kg", 0.5),
        ("2 lb", "kg", 0.907_184_74),
        ("2 t", "kg", 2000.0),
        ("50 N", "N", 50.0),
        ("1.2 kN", "N", 1200.0),
        ("10 lbf", "N", 44.482_216_152_605),
        ("2 kg * 9.81 m/s²", "N", 19.62),
        ("200 GPa", "MPa", 200e9),
        ("125e6 Pa", "MPa", 125e6),
        ("0.5 kPa", "MPa", 500.0),
        ("200 MPa", "GPa", 200e6),
        ("10 psi", "MPa", 68_947.572_931_683_61),
        ("210000 N/mm²", "MPa", 2.1e11),
        ("210000 N/mm2", "MPa", 2.1e11),
        ("6 kN / 2 mm²", "MPa", 3e9),
        ("6 kN/(2 mm^2)", "MPa", 3e9),
        ("50 mm²", "cm²", 5e-5),
        ("pi/4 * (8 mm)^2", "cm²", PI / 4.0 * 64e-6),
        ("1 in²", "cm²", 6.4516e-4),
        ("0.0001 m²", "cm²", 1e-4),
        ("400 g/m", "kg/m", 0.4),
        ("0.4 kg/m", "kg/m", 0.4),
        ("1 N/m", "N/m", 1.0),
        ("3 kN/m", "N/m", 3000.0),
        ("9.81 m/s²", "m/s²", 9.81),
        ("9.81 m/s^2", "m/s²", 9.81),
        ("36 km/h", "m/s", 10.0),
        ("100 mph", "m/s", 44.704),
        ("5 m/s", "m/s", 5.0),
        ("5 m s^-1", "m/s", 5.0),
        ("5 ms", "s", 0.005),
        ("7 µs", "s", 7e-6),
        ("7 μs", "s", 7e-6),
        ("7 us", "s", 7e-6),
        ("0.5 1/s", "1/s", 0.5),
        ("0.5/s", "1/s", 0.5),
        ("90 °", "°", 90.0 * (PI / 180.0)),
        ("90°", "°", 90.0 * (PI / 180.0)),
        ("pi/2 rad", "°", PI / 2.0),
        ("2 Hz", "rad/s", 2.0 * 2.0 * PI),
        ("6 m / 2 m", "MPa", 3e6),
    ];

    #[test]
    fn numbers_calculations_and_units_are_read() {
        for (text, unit, expected) in NUMBERS.into_iter().chain(UNITS) {
            let value = typed(text, unit).unwrap_or_else(|error| panic!("{text:?} in {unit}: {error}"));
            let near = (value - expected).abs() <= 4.0 * f64::EPSILON * expected.abs();
            assert!(near, "{text:?} in {unit} is {value:?} in place of {expected:?}");
            if !text.contains(['+', '*', '/', '^', '⁻', '²']) && !text.contains("in") {
                assert_eq!(value.to_bits(), expected.to_bits(), "{text:?} in {unit} is {value:?}, not {expected:?}");
            }
        }
    }

    #[test]
    fn what_cannot_be_read_is_told_in_words() {
        let cases = [
            ("", "m", "X needs a number"),
            ("abc", "m", "“abc” is neither a number nor a unit"),
            ("200 gpa", "MPa", "“gpa” is neither a number nor a unit: GPa?"),
            ("200 mpa", "MPa", "“mpa” is neither a number nor a unit: mPa or MPa?"),
            ("12 kg", "MPa", "X is a stress; kg is a mass"),
            ("12 kg", "m", "X is a length; kg is a mass"),
            ("3 m", "m/s", "X is a speed; m is a length"),
            ("5 Hz", "1/s", "X is a rate; Hz is a frequency"),
            ("5 m/s", "", "X is a plain number; m/s is a speed"),
            ("2 * 3 kg", "m", "X is a length; “2 * 3 kg” is a mass"),
            ("3 kg m^3", "m", "X is a length; “3 kg m^3” is a quantity in kg m^3"),
            ("1 + 2 m", "m", "a plain number and a length cannot be added"),
            ("1e999", "m", "“1e999” is too large a number"),
            ("1e308 GPa", "MPa", "“1e308 GPa” is too large a number"),
            ("1e308*10", "m", "“1e308*10” is too large a number"),
            ("1e-999", "m", "“1e-999” is not zero, but too small a number"),
            ("1e-320 mm²", "cm²", "“1e-320 mm²” is not zero, but too small a number"),
            ("1/0", "m", "Nothing can be divided by zero"),
            ("0^-1", "m", "Nothing can be divided by zero"),
            ("(-1)^0.5", "m", "“(-1)^0.5” has a power without a meaning"),
            ("2^m", "m", "“2^m” has a power without a meaning"),
            ("m^0.5", "m", "“m^0.5” has a power without a meaning"),
            ("1/", "m", "Something is missing behind “1/”"),
            ("*2", "m", "Before “*” a number is missing"),
            ("(1 + 2", "m", "A closing parenthesis is missing"),
            ("1 + 2)", "m", "There is one closing parenthesis more than opening ones"),
            ("1 2", "m", "Before “2” a + − * or / is missing"),
            ("2(3)", "m", "Before “(” a + − * or / is missing"),
            ("1,234.5", "m", "“1,234.5” has commas or points between thousands: write 1234.5"),
            ("1.234,5", "m", "“1.234,5” has commas or points between thousands: write 1234.5"),
            ("1,234,567", "m", "“1,234,567” has commas or points between thousands: write 1234567"),
            ("1,234", "m", "“1,234” can be read in two ways: write 1.234 or 1234"),
            ("5,", "m", "“5,” ends with a comma"),
            (".", "m", "“.” is not a number"),
            ("5 $", "m", "“$” has no meaning here"),
            ("inf", "m", "“inf” is neither a number nor a unit"),
            ("NaN", "m", "“NaN” is neither a number nor a unit"),
        ];
        for (text, unit, expected) in cases {
            assert_eq!(typed(text, unit), Err(expected.to_owned()), "{text:?} in {unit}");
        }
        let deep = "(".repeat(150);
        assert!(typed(&deep, "m").is_err_and(|error| error.ends_with("nested too deeply")));
        assert!(typed(&"-".repeat(150), "m").is_err());
        assert!(typed(&"1".repeat(201), "m").is_err_and(|error| error.contains("longer than 200")));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// Any text at all is read or refused.
        #[test]
        fn no_text_does_harm(text in ".{0,60}") {
            if let Ok(value) = typed(&text, "cm²") {
                prop_assert!(value.is_finite());
            }
        }

        /// The same for texts of what belongs into calculations.
        #[test]
        fn no_calculation_does_harm(parts in prop::collection::vec(
            prop::sample::select(vec![
                "1", "2,5", "1e300", "1e-300", "0", "9", " ", "+", "-", "*", "/", "^", "**", "(", ")", "²", "⁻", "³", "pi",
                "m", "kg", "GPa", "s", "°", "mm2", ".", ",", "e", "E5", "h", "−", "999",
            ]), 0..40))
        {
            let text: String = parts.concat();
            if let Ok(value) = typed(&text, "MPa") {
                prop_assert!(value.is_finite(), "{text:?} is {value}");
            }
        }

        /// What a field offers to be edited, typed again, is what was there: to the last bit where it has up to 15
        /// digits, which are all that decimal numbers are sure to keep.
        #[test]
        fn a_value_shown_in_full_reads_back(digits in 1_u64..1_000_000_000_000_000, exponent in -40..30) {
            let value: f64 = format!("{digits}e{exponent}").parse().expect("a number");
            for name in ["", "m", "MPa", "GPa", "cm²", "kg/m", "1/s"] {
                let unit = Unit::of(name);
                let text = unit.full(value);
                prop_assert_eq!(read(&text, "X", unit).map(f64::to_bits), Ok(value.to_bits()), "{} {}", text, name);
            }
        }
    }
}
