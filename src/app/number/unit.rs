//! Units, and quantities on their way from what is typed to what is stored.

use std::f64::consts::{PI, TAU};

/// Exponents of kg, m, s and rad. An angle counts, so that 1/s, rad/s and Hz are told apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension([i32; 4]);

/// No exponent that anybody means is larger.
const MOST: i32 = 12;

/// What quantities are called.
const KINDS: [([i32; 4], &str); 17] = [
    ([0, 0, 0, 0], "a plain number"),
    ([1, 0, 0, 0], "a mass"),
    ([0, 1, 0, 0], "a length"),
    ([0, 0, 1, 0], "a time"),
    ([0, 0, 0, 1], "an angle"),
    ([0, 2, 0, 0], "an area"),
    ([0, 3, 0, 0], "a volume"),
    ([0, 1, -1, 0], "a speed"),
    ([0, 1, -2, 0], "an acceleration"),
    ([0, 0, -1, 0], "a rate"),
    ([0, 0, -1, 1], "a frequency"),
    ([1, 1, -2, 0], "a force"),
    ([1, -1, -2, 0], "a stress"),
    ([1, 0, -2, 0], "a force per length"),
    ([1, -1, 0, 0], "a mass per length"),
    ([1, -3, 0, 0], "a density"),
    ([1, 2, -2, 0], "a moment"),
];

impl Dimension {
    /// Of a plain number.
    pub const NONE: Self = Self([0; 4]);

    /// What such a quantity is called.
    pub fn kind(self) -> String {
        if let Some((_, name)) = KINDS.iter().find(|(of, _)| *of == self.0) {
            return (*name).into();
        }
        let part = |(name, power): (&str, i32)| match power {
            0 => String::new(),
            1 => format!(" {name}"),
            _ => format!(" {name}^{power}"),
        };
        let parts: String = ["kg", "m", "s", "rad"].into_iter().zip(self.0).map(part).collect();
        format!("a quantity in{parts}")
    }

    fn combined(self, other: Self, sign: i32) -> Option<Self> {
        let mut sum = self.0;
        for (sum, power) in sum.iter_mut().zip(other.0) {
            *sum += sign * power;
            if sum.abs() > MOST {
                return None;
            }
        }
        Some(Self(sum))
    }
}

/// `number` · 10^`exponent` SI units. The power of ten is kept apart, so that 50 mm² is the number that 5e-5 is, and not
/// the product of two rounded ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    number: f64,
    exponent: i32,
    /// Its dimension.
    pub dimension: Dimension,
}

/// Why two quantities have no product, sum or power.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// Beyond the largest number.
    TooLarge,
    /// Not zero, but below the smallest number.
    TooSmall,
    /// A division by zero.
    ByZero,
    /// A power that is no number, or of a unit and not whole, or an unheard-of one.
    Power,
    /// A sum of unlike quantities.
    Unlike,
}

impl Quantity {
    /// A plain number.
    pub fn plain(number: f64) -> Self {
        Self { number, exponent: 0, dimension: Dimension::NONE }
    }

    /// In SI units.
    pub fn si(self) -> f64 {
        shift(self.number, self.exponent)
    }

    /// With the sign turned round.
    pub fn negated(self) -> Self {
        Self { number: -self.number, ..self }
    }

    /// The product.
    pub fn times(self, other: Self) -> Result<Self, Trouble> {
        let dimension = self.dimension.combined(other.dimension, 1).ok_or(Trouble::Power)?;
        let exponent = self.exponent + other.exponent;
        Self { number: self.number * other.number, exponent, dimension }
            .checked(self.number == 0.0 || other.number == 0.0)
    }

    /// The quotient.
    pub fn over(self, other: Self) -> Result<Self, Trouble> {
        if other.number == 0.0 {
            return Err(Trouble::ByZero);
        }
        let dimension = self.dimension.combined(other.dimension, -1).ok_or(Trouble::Power)?;
        let exponent = self.exponent - other.exponent;
        Self { number: self.number / other.number, exponent, dimension }.checked(self.number == 0.0)
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Result<Self, Trouble> {
        if self.dimension != other.dimension {
            return Err(Trouble::Unlike);
        }
        let sum = if self.exponent == other.exponent {
            Self { number: self.number + other.number, ..self }
        } else {
            Self { number: self.si() + other.si(), exponent: 0, ..self }
        };
        sum.checked(true)
    }

    /// The power.
    pub fn to_the(self, power: Self) -> Result<Self, Trouble> {
        if power.dimension != Dimension::NONE {
            return Err(Trouble::Power);
        }
        let power = power.si();
        let result = if self.dimension == Dimension::NONE {
            let base = self.si();
            if base == 0.0 && power < 0.0 {
                return Err(Trouble::ByZero);
            }
            Self::plain(base.powf(power))
        } else {
            let is_power = |whole: &i32| (f64::from(*whole) - power).abs() < f64::EPSILON;
            let whole = (-MOST..=MOST).find(is_power).ok_or(Trouble::Power)?;
            let dimension = Dimension(self.dimension.0.map(|each| each * whole));
            let dimension = dimension.combined(Dimension::NONE, 1).ok_or(Trouble::Power)?;
            Self { number: self.number.powi(whole), exponent: self.exponent * whole, dimension }
        };
        if result.number.is_nan() { Err(Trouble::Power) } else { result.checked(self.number == 0.0) }
    }

    fn checked(self, may_be_zero: bool) -> Result<Self, Trouble> {
        let value = self.si();
        if !(self.number.is_finite() && value.is_finite()) {
            Err(Trouble::TooLarge)
        } else if !may_be_zero && (self.number == 0.0 || value == 0.0) {
            Err(Trouble::TooSmall)
        } else {
            Ok(self)
        }
    }
}

/// `value` · 10^`power`, rounded once: the number with the same digits. Multiplying by 1e-4 would round twice, since
/// 1e-4 is no binary number.
pub fn shift(value: f64, power: i32) -> f64 {
    if power == 0 || value == 0.0 || !value.is_finite() {
        return value;
    }
    let text = format!("{value:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent = exponent.parse().unwrap_or(0_i32).saturating_add(power);
    format!("{digits}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// Name, size as a number and a power of ten of SI units, dimension, whether SI prefixes go with it.
type Row = (&'static str, f64, i32, [i32; 4], bool);

/// Newtons per pound-force: 0.45359237 kg times the standard acceleration 9.80665 m/s².
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Pascals per pound-force per square inch.
const PSI: f64 = POUND_FORCE / 0.000_645_16;

const UNITS: [Row; 22] = [
    ("m", 1.0, 0, [0, 1, 0, 0], true),
    ("in", 25.4, -3, [0, 1, 0, 0], false),
    ("inch", 25.4, -3, [0, 1, 0, 0], false),
    ("ft", 304.8, -3, [0, 1, 0, 0], false),
    ("g", 1.0, -3, [1, 0, 0, 0], true),
    ("t", 1.0, 3, [1, 0, 0, 0], false),
    ("lb", 0.453_592_37, 0, [1, 0, 0, 0], false),
    ("lbs", 0.453_592_37, 0, [1, 0, 0, 0], false),
    ("s", 1.0, 0, [0, 0, 1, 0], true),
    ("min", 60.0, 0, [0, 0, 1, 0], false),
    ("h", 3600.0, 0, [0, 0, 1, 0], false),
    ("N", 1.0, 0, [1, 1, -2, 0], true),
    ("lbf", POUND_FORCE, 0, [1, 1, -2, 0], false),
    ("Pa", 1.0, 0, [1, -1, -2, 0], true),
    ("psi", PSI, 0, [1, -1, -2, 0], false),
    ("ksi", PSI, 3, [1, -1, -2, 0], false),
    ("bar", 1.0, 5, [1, -1, -2, 0], false),
    ("Hz", TAU, 0, [0, 0, -1, 1], true),
    ("rad", 1.0, 0, [0, 0, 0, 1], true),
    ("°", PI / 180.0, 0, [0, 0, 0, 1], false),
    ("deg", PI / 180.0, 0, [0, 0, 0, 1], false),
    ("mph", 0.447_04, 0, [0, 1, -1, 0], false),
];

const PREFIXES: [(&str, i32); 12] = [
    ("n", -9),
    ("µ", -6), // The sign for micro, and the Greek letter.
    ("μ", -6),
    ("u", -6),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("h", 2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
];

/// The unit of this name, with or without a prefix.
pub fn named(name: &str) -> Option<Quantity> {
    let quantity = |&(_, number, exponent, dimension, _): &Row, power: i32| Quantity {
        number,
        exponent: exponent + power,
        dimension: Dimension(dimension),
    };
    if let Some(unit) = UNITS.iter().find(|unit| unit.0 == name) {
        return Some(quantity(unit, 0));
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let rest = name.strip_prefix(prefix)?;
        UNITS.iter().find(|unit| unit.4 && unit.0 == rest).map(|unit| quantity(unit, *power))
    })
}

/// The names of units that differ from `name` in small and capital letters alone.
pub fn similar(name: &str) -> Vec<String> {
    let name = name.to_lowercase();
    let plain = UNITS.iter().map(|unit| unit.0.to_owned());
    let with_prefix = PREFIXES
        .iter()
        .flat_map(|(prefix, _)| UNITS.iter().filter(|unit| unit.4).map(move |unit| format!("{prefix}{}", unit.0)));
    plain.chain(with_prefix).filter(|unit| unit.to_lowercase() == name).collect()
}

/// The unit that a number is shown and typed in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Its name; empty for plain numbers.
    pub name: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// What it is in the unit that the program counts in, apart from a power of ten.
    ratio: f64,
    /// The power of ten.
    exponent: i32,
    /// The unit that the program counts in, in SI units.
    stored: f64,
}

impl Unit {
    /// A unit, or a product of units, for numbers that the program holds in SI units. A name that is none is that of a
    /// plain number.
    pub fn of(name: &'static str) -> Self {
        Self::counted_in(1.0, name)
    }

    /// The same for numbers that the program holds in Hz.
    pub fn of_hertz(name: &'static str) -> Self {
        Self::counted_in(TAU, name)
    }

    fn counted_in(stored: f64, name: &'static str) -> Self {
        let Quantity { number, exponent, dimension } =
            super::expression::unit(name).unwrap_or_else(|| Quantity::plain(1.0));
        Self { name, dimension, ratio: number / stored, exponent, stored }
    }

    /// Whether it is a power of ten times the unit that the program counts in, so that digits stay as they are.
    fn is_decimal(self) -> bool {
        self.ratio.to_bits() == 1.0_f64.to_bits()
    }

    /// What is stored where `quantity` is typed: plain numbers are meant in this unit.
    ///
    /// # Errors
    /// A quantity of another kind, or one beyond the range of numbers.
    pub fn stored(self, quantity: Quantity) -> Result<f64, Trouble> {
        let Quantity { number, exponent, dimension } = quantity;
        if dimension == Dimension::NONE {
            let counted = Quantity { number: number * self.ratio, exponent: exponent + self.exponent, dimension };
            counted.checked(number == 0.0).map(Quantity::si)
        } else if dimension == self.dimension {
            Ok(quantity.si() / self.stored)
        } else {
            Err(Trouble::Unlike)
        }
    }

    /// The stored value for this number of units on the screen.
    pub fn to_stored(self, shown: f64) -> f64 {
        shift(shown * self.ratio, self.exponent)
    }

    /// How many units are shown where `stored` is stored.
    pub fn shown(self, stored: f64) -> f64 {
        shift(stored / self.ratio, -self.exponent)
    }

    /// All digits of what is stored. Of a unit that is no power of ten the last digits come from the conversion alone;
    /// these are left out.
    pub fn full(self, stored: f64) -> String {
        if self.is_decimal() {
            return super::text::shifted(stored, -self.exponent);
        }
        let shown = self.shown(stored);
        super::text::shifted(format!("{shown:.13e}").parse().unwrap_or(shown), 0)
    }

    /// The number, and the unit where there is one.
    pub fn with_name(self, number: &str) -> String {
        match self.name {
            "" => number.to_owned(),
            "°" => format!("{number}°"),
            name => format!("{number} {name}"),
        }
    }
}
