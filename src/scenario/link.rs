//! A scenario as a link: the text after `#s=` in the page's address. Durable: links made today stay readable.
//!
//! A link is a version mark and then bytes in base64url without padding. The bytes are the fields below in this order, and
//! behind them the CRC-32 (that of zlib) of the version mark and all these bytes, lowest byte first.
//!
//! The version mark is `3` where there is a path, else `2` where a cable has a material of its own, and else `1`, so that older
//! programs open all that they know.
//!
//! | field | form |
//! |---|---|
//! | flags | one byte: 1 a name is given, 2 engineering strain (else Green), 4 tangent stiffness (else secant), added up |
//! | name, if given | its length in bytes as a whole number, then that many bytes of UTF-8 |
//! | gravity, E, A, μ, platform's mass | five numbers |
//! | cables | their count as a whole number; of each its anchor x, y: two numbers; then one byte: 0 equilibrium, 1 constant: a number, 2 by h₀, hₓ, `h_y`, v₀, vₓ, `v_y`: six numbers; then from version `2` on what it has of its own |
//! | of its own | one byte: 1 E, 2 A, 4 μ, 8 Green strain, 16 engineering strain, added up; then of E, A and μ those that are given, in this order, a number each |
//! | elements per cable | whole number |
//! | α, β, position x, y, direction x, y, speed | seven numbers |
//! | path, in version `3` | one byte: the profile (0 quintic, 1 trapezoid, 2 S-curve, 3 constant), 4 more where corners are smooth; the count of its points as a whole number, of each x, y: two numbers; speed, acceleration, jerk, hold: four numbers |
//!
//! - A *whole number* (below 2⁶⁴) is in LEB128: 7 bits a byte, the lowest first, the top bit set in all but the last.
//! - A *number* is first a whole number w = 8 z + k. For k < 7 it is m · 10^(k − 5), where z is m in zigzag: 0, −1, 1, −2,
//!   2 … are 0, 1, 2, 3, 4 …; for k = 7 and z > 0 it is m · 10^e with e in one further byte, signed; in both it is the
//!   double nearest to this decimal. w = 7: a double follows as it is, 8 bytes, the lowest first.
//!
//! What follows the robot's part after an `&` is about the view and no part of this format.
//!
//! The shortest form is written, so most numbers that people type take a byte or two: the paper's robot has 81
//! characters. As deflated JSON it would have 410, as plain doubles 370 or deflated 130, and dragged it would gain more.
//!
//! ```
//! use tautline::scenario::{link, presets};
//!
//! let scenario = presets::PRESETS[0].scenario();
//! let text = link::encode(&scenario);
//! assert_eq!(text.len(), 81);
//! assert_eq!(link::decode(&text), Ok(scenario));
//! ```

use base64::{Engine as _, prelude::BASE64_URL_SAFE_NO_PAD};

use crate::robot::{Damping, Faults, Linearisation, OwnMaterial, Strain, TensionLaw};
use crate::scenario::json::{Cable, Material, Motion, Platform, SCHEMA, Scenario};
use crate::scenario::path::{Corners, Path, ProfileKind};

/// What stands between the page's address and the text of [`encode`].
pub const MARK: &str = "#s=";
/// The first character of a link of the first version.
const FIRST: char = '1';
/// That of the second version, in which cables may have a material of their own.
const SECOND: char = '2';
/// That of the third version, in which there is a path. Later versions begin with the digits after it.
const THIRD: char = '3';

const NAMED: u8 = 1;
const ENGINEERING: u8 = 2;
const TANGENT: u8 = 4;

const OWN_MODULUS: u8 = 1;
const OWN_AREA: u8 = 2;
const OWN_MASS: u8 = 4;
const OWN_GREEN: u8 = 8;
const OWN_ENGINEERING: u8 = 16;

/// The profiles of a path by their numbers.
const PROFILES: [ProfileKind; 4] =
    [ProfileKind::Quintic, ProfileKind::Trapezoid, ProfileKind::Scurve, ProfileKind::Constant];
const SMOOTH: u8 = 4;

/// k where an exponent follows; alone, where a double does.
const LONG: u64 = 7;
/// The exponent for k = 0.
const LOWEST_EXPONENT: i32 = -5;

/// Why a link cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// It is not what [`encode`] gave.
    #[error("This link is damaged: a part of it is missing or was changed. Copy all of it once more.")]
    Damaged,
    /// Its format is one of the future.
    #[error("This link was made by a newer version of Tautline. Reload the page, or update the program.")]
    Newer,
    /// It says something that no robot can be.
    #[error(transparent)]
    NotPhysical(#[from] Faults),
}

/// `scenario` as the text after `#s=`, of letters, digits, `-` and `_`.
///
/// [`decode`] gives back the same scenario to the last bit if it is physical, and else tells why it is not.
pub fn encode(scenario: &Scenario) -> String {
    let version = match &scenario.path {
        Some(_) => THIRD,
        None if scenario.schema() == SCHEMA => FIRST,
        None => SECOND,
    };
    let mut out = Writer::default();
    out.scenario(scenario, version);
    out.0.extend(checksum(version, &out.0));
    format!("{version}{}", BASE64_URL_SAFE_NO_PAD.encode(out.0))
}

/// The scenario in `text`, which is what follows `#s=`.
///
/// Behind it there may be `&` and anything else, which is not about the robot but about how it is looked at. There may
/// also be spaces and punctuation, and characters may be percent-encoded: programs that pass links on do such things, and
/// no link contains any. Time and memory are in proportion to the length of `text`.
///
/// # Errors
/// A link that is damaged or of a newer version; all that is not physical, as for a file.
pub fn decode(text: &str) -> Result<Scenario, LinkError> {
    let text = percent_encoding::percent_decode_str(text).decode_utf8_lossy();
    let text = text.split('&').next().unwrap_or_default();
    let text = text.trim_start().trim_end_matches(|c: char| !(c.is_ascii_alphanumeric() || c == '-' || c == '_'));
    let mut rest = text.chars();
    let version = match rest.next() {
        Some(version @ (FIRST | SECOND | THIRD)) => version,
        Some('4'..='9') => return Err(LinkError::Newer),
        _ => return Err(LinkError::Damaged),
    };
    let bytes = BASE64_URL_SAFE_NO_PAD.decode(rest.as_str()).map_err(|_| LinkError::Damaged)?;
    let (fields, sum) = bytes.split_last_chunk().ok_or(LinkError::Damaged)?;
    let mut reader = Reader(fields);
    let scenario = if checksum(version, fields) == *sum { reader.scenario(version) } else { None };
    let scenario = scenario.filter(|_| reader.0.is_empty()).ok_or(LinkError::Damaged)?;
    Ok(scenario.to_robot().map(|_| scenario)?)
}

/// Of the version too: a link whose mark was changed to another one's is damaged.
fn checksum(version: char, fields: &[u8]) -> [u8; 4] {
    crc32(&[&[version as u8], fields].concat()).to_le_bytes()
}

/// CRC-32 as zlib computes it, bit by bit: a link is short, and a table would take 16 kB of every program.
fn crc32(bytes: &[u8]) -> u32 {
    let shifted = |rest: u32| (rest >> 1) ^ if rest & 1 == 1 { 0xedb8_8320 } else { 0 };
    !bytes.iter().fold(!0, |rest, &byte| (0..8).fold(rest ^ u32::from(byte), |rest, _| shifted(rest)))
}

#[derive(Default)]
struct Writer(Vec<u8>);

impl Writer {
    fn scenario(&mut self, scenario: &Scenario, version: char) {
        let Scenario { name, gravity, cable, platform, cables, damping, motion, .. } = scenario;
        let strain = ENGINEERING * u8::from(cable.strain == Strain::Engineering);
        let linearisation = TANGENT * u8::from(scenario.linearisation == Linearisation::Tangent);
        self.0.push(NAMED * u8::from(name.is_some()) + strain + linearisation);
        if let Some(name) = name {
            self.whole(name.len() as u64);
            self.0.extend(name.as_bytes());
        }
        self.numbers(&[*gravity, cable.youngs_modulus, cable.area, cable.mass_per_length, platform.mass]);
        self.whole(cables.len() as u64);
        for Cable { anchor, tension, cable: own } in cables {
            self.numbers(anchor);
            match tension {
                TensionLaw::Equilibrium => self.0.push(0),
                TensionLaw::Constant(tension) => {
                    self.0.push(1);
                    self.number(*tension);
                }
                TensionLaw::Hypot { horizontal, vertical } => {
                    self.0.push(2);
                    self.numbers(&[*horizontal, *vertical].concat());
                }
            }
            if version != FIRST {
                self.own(own);
            }
        }
        self.whole(scenario.elements_per_cable as u64);
        let Motion { position: [x, y], direction: [dx, dy], speed } = *motion;
        self.numbers(&[damping.alpha, damping.beta, x, y, dx, dy, speed]);
        if let Some(path) = &scenario.path {
            self.path(path);
        }
    }

    fn path(&mut self, path: &Path) {
        let profile = PROFILES.iter().position(|profile| *profile == path.profile).unwrap_or_default();
        self.0.push(profile.to_le_bytes()[0] + SMOOTH * u8::from(path.corners == Corners::Smooth));
        self.whole(path.points.len() as u64);
        for point in &path.points {
            self.numbers(point);
        }
        self.numbers(&[path.speed, path.acceleration, path.jerk, path.hold]);
    }

    fn own(&mut self, own: &OwnMaterial) {
        let OwnMaterial { youngs_modulus, area, mass_per_length, strain } = *own;
        let strain = match strain {
            None => 0,
            Some(Strain::Green) => OWN_GREEN,
            Some(Strain::Engineering) => OWN_ENGINEERING,
        };
        let numbers = [(OWN_MODULUS, youngs_modulus), (OWN_AREA, area), (OWN_MASS, mass_per_length)];
        self.0.push(numbers.iter().filter(|(_, number)| number.is_some()).fold(strain, |sum, (flag, _)| sum + flag));
        for number in numbers.into_iter().filter_map(|(_, number)| number) {
            self.number(number);
        }
    }

    fn numbers(&mut self, numbers: &[f64]) {
        for number in numbers {
            self.number(*number);
        }
    }

    fn number(&mut self, number: f64) {
        let exact = [&[LONG.to_le_bytes()[0]][..], &number.to_le_bytes()].concat();
        // −0 would lose its sign.
        let same = |short: &Self| Reader(&short.0).number().is_some_and(|read| read.to_bits() == number.to_bits());
        let short = Self::short(number).filter(|short| short.0.len() < exact.len() && same(short));
        self.0.extend(short.map_or(exact, |short| short.0));
    }

    /// By the shortest decimal m · 10^e that is read as `number`, if it is finite and e within range.
    fn short(number: f64) -> Option<Self> {
        let text = format!("{number:e}");
        let (digits, exponent) = text.split_once('e')?;
        let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let m: i64 = digits.replace('.', "").parse().ok()?;
        let e = exponent.parse::<i32>().ok()? - i32::try_from(decimals).ok()?;
        let zigzag = ((m << 1) ^ (m >> 63)).cast_unsigned();
        let mut short = Self::default();
        let k = u64::try_from(e - LOWEST_EXPONENT).map_or(LONG, |k| k.min(LONG));
        short.whole(8 * zigzag + k);
        if k == LONG {
            short.0.push(i8::try_from(e).ok()?.cast_unsigned());
        }
        Some(short)
    }

    fn whole(&mut self, mut whole: u64) {
        while whole >= 0x80 {
            self.0.push(whole.to_le_bytes()[0] | 0x80);
            whole >>= 7;
        }
        self.0.push(whole.to_le_bytes()[0]);
    }
}

/// What has not been read yet. Every reading gives nothing where the bytes are not a scenario's.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn scenario(&mut self, version: char) -> Option<Scenario> {
        let [flags] = self.bytes().filter(|[flags]| *flags < 2 * TANGENT)?;
        let has = |flag| flags & flag != 0;
        Some(Scenario {
            name: if has(NAMED) { Some(self.text()?) } else { None },
            gravity: self.number()?,
            cable: Material {
                youngs_modulus: self.number()?,
                area: self.number()?,
                mass_per_length: self.number()?,
                strain: if has(ENGINEERING) { Strain::Engineering } else { Strain::Green },
            },
            platform: Platform { mass: self.number()? },
            // Grows with what is really there, whatever the count says.
            cables: (0..self.whole()?).map(|_| self.cable(version)).collect::<Option<_>>()?,
            elements_per_cable: usize::try_from(self.whole()?).unwrap_or(usize::MAX),
            damping: Damping { alpha: self.number()?, beta: self.number()? },
            linearisation: if has(TANGENT) { Linearisation::Tangent } else { Linearisation::Secant },
            motion: Motion { position: self.numbers()?, direction: self.numbers()?, speed: self.number()? },
            path: if version == THIRD { Some(self.path()?) } else { None },
        })
    }

    fn path(&mut self) -> Option<Path> {
        let [flags] = self.bytes().filter(|[flags]| *flags < 2 * SMOOTH)?;
        Some(Path {
            profile: PROFILES[usize::from(flags % SMOOTH)],
            corners: if flags & SMOOTH == 0 { Corners::Stop } else { Corners::Smooth },
            points: (0..self.whole()?).map(|_| self.numbers()).collect::<Option<_>>()?,
            speed: self.number()?,
            acceleration: self.number()?,
            jerk: self.number()?,
            hold: self.number()?,
        })
    }

    fn cable(&mut self, version: char) -> Option<Cable> {
        let anchor = self.numbers()?;
        let tension = match self.bytes()? {
            [0] => TensionLaw::Equilibrium,
            [1] => TensionLaw::Constant(self.number()?),
            [2] => TensionLaw::Hypot { horizontal: self.numbers()?, vertical: self.numbers()? },
            _ => return None,
        };
        let cable = if version == FIRST { OwnMaterial::default() } else { self.own()? };
        Some(Cable { anchor, tension, cable })
    }

    fn own(&mut self) -> Option<OwnMaterial> {
        let [flags] = self.bytes().filter(|[flags]| *flags < 2 * OWN_ENGINEERING)?;
        let strain = match flags & (OWN_GREEN | OWN_ENGINEERING) {
            0 => None,
            OWN_GREEN => Some(Strain::Green),
            OWN_ENGINEERING => Some(Strain::Engineering),
            _ => return None,
        };
        let mut number = |flag| if flags & flag == 0 { Some(None) } else { self.number().map(Some) };
        let (youngs_modulus, area, mass_per_length) = (number(OWN_MODULUS)?, number(OWN_AREA)?, number(OWN_MASS)?);
        Some(OwnMaterial { youngs_modulus, area, mass_per_length, strain })
    }

    fn text(&mut self) -> Option<String> {
        let length = self.whole()?.try_into().ok()?;
        let (text, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        String::from_utf8(text.to_vec()).ok()
    }

    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        (0..N).map(|_| self.number()).collect::<Option<Vec<_>>>()?.try_into().ok()
    }

    fn number(&mut self) -> Option<f64> {
        let whole = self.whole()?;
        if whole == LONG {
            return self.bytes().map(f64::from_le_bytes);
        }
        let (zigzag, k) = (whole / 8, whole % 8);
        let m = (zigzag >> 1).cast_signed() ^ -(zigzag & 1).cast_signed();
        let e = match k {
            LONG => self.bytes().map(i8::from_le_bytes)?.into(),
            _ => i32::try_from(k).ok()? + LOWEST_EXPONENT,
        };
        format!("{m}e{e}").parse().ok()
    }

    fn whole(&mut self) -> Option<u64> {
        let mut whole = 0_u64;
        for shift in (0..64).step_by(7) {
            let [byte] = self.bytes()?;
            let part = u64::from(byte & 0x7f);
            whole |= part << shift;
            if byte < 0x80 {
                // The tenth byte has one bit.
                return Some(whole).filter(|whole| whole >> shift == part);
            }
        }
        None
    }

    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::crc32;

    #[test]
    fn the_checksum_is_that_of_zlib() {
        // The check value of the catalogue of CRC algorithms, and zlib's own of other texts.
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32(b""), 0);
        assert_eq!(crc32(b"The quick brown fox jumps over the lazy dog"), 0x414f_a339);
    }
}
