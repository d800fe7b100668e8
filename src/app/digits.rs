//! Figures with the digits that are certain.
//!
//! What the numerics give has sixteen digits; of a critical speed or a frequency the mesh makes most of them worthless.
//! People are shown those that are certain, programs and files get them all.

/// Digits that are shown where nothing is known of the uncertainty.
const CAUTIOUS: i32 = 3;
/// More digits are never shown.
const MOST: i32 = 6;

/// A value with the digits that are certain: the last one is off by five at most where the value is off by
/// `uncertainty`. Three significant digits where that is not known. At least one digit is shown, at most six.
pub fn certain(value: f64, uncertainty: Option<f64>) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return "?".into();
    }
    rounded(value, place(value, uncertainty))
}

/// The same with its sign, for differences.
pub fn with_sign(value: f64, uncertainty: Option<f64>) -> String {
    let text = certain(value, uncertainty);
    if text.starts_with('-') { text } else { format!("+{text}") }
}

/// The same with three significant digits at most: where an uncertainty is known only of something like it.
pub fn three_at_most(value: f64, uncertainty: Option<f64>) -> String {
    certain(value, uncertainty.map(|uncertainty| uncertainty.max(power(leading(value) + 1 - CAUTIOUS))))
}

/// A value that may be off by `share` of itself, with three significant digits at most.
pub fn like(value: f64, share: Option<f64>) -> String {
    three_at_most(value, share.map(|share| share * value.abs()))
}

/// The same with its sign, for differences.
pub fn change_like(value: f64, share: Option<f64>) -> String {
    let text = like(value, share);
    if text.starts_with('-') { text } else { format!("+{text}") }
}

/// How far the value as it is shown may be off, rounded up to two digits.
pub fn margin(value: f64, uncertainty: f64) -> String {
    let shown: f64 = certain(value, Some(uncertainty)).parse().unwrap_or(value);
    rounded_up((shown - value).abs() + uncertainty, 2)
}

/// What a size that is greater than 0 is at most, with one digit.
pub fn at_most(size: f64) -> String {
    rounded_up(size, 1)
}

fn rounded_up(size: f64, digits: i32) -> String {
    if size <= 0.0 || !size.is_finite() {
        return certain(size, None);
    }
    let place = leading(size) + 1 - digits;
    rounded((size / power(place) - 1e-9).ceil() * power(place), place)
}

/// The place of the last digit to show, as the power of ten.
fn place(value: f64, uncertainty: Option<f64>) -> i32 {
    let leading = leading(value);
    let least = match uncertainty {
        Some(uncertainty) if uncertainty.is_finite() => magnitude(2.0 * uncertainty),
        _ => leading + 1 - CAUTIOUS,
    };
    least.clamp(leading + 1 - MOST, leading)
}

/// The place of the first digit.
fn leading(value: f64) -> i32 {
    magnitude(value.abs())
}

/// The largest power of ten that is not above `value`.
fn magnitude(value: f64) -> i32 {
    if value <= 0.0 || !value.is_finite() {
        return -300;
    }
    // Of a finite number: from -324 to 308.
    #[expect(clippy::cast_possible_truncation)]
    let exponent = value.log10().floor() as i32;
    exponent
}

fn power(exponent: i32) -> f64 {
    10.0_f64.powi(exponent)
}

/// Rounded to a place; very large and very small values with an exponent.
fn rounded(value: f64, place: i32) -> String {
    let digits = usize::try_from(leading(value) - place).unwrap_or(0);
    if !(1e-4..1e7).contains(&value.abs()) {
        return format!("{value:.digits$e}");
    }
    match usize::try_from(-place) {
        Ok(decimals) => format!("{value:.decimals$}"),
        Err(_) => format!("{}", (value / power(place)).round() * power(place)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_certain_digits_are_shown() {
        let cases = [
            (11.299_043, Some(0.308), "11.3"),
            (11.299_043, Some(0.6), "11"),
            (11.299_043, Some(0.002), "11.299"),
            (11.299_043, Some(7.0), "10"),
            (11.299_043, Some(90.0), "10"),
            (11.299_043, Some(0.0), "11.2990"),
            (11.299_043, None, "11.3"),
            (0.271_55, Some(0.000_46), "0.2716"),
            (0.271_55, None, "0.272"),
            (1234.0, Some(60.0), "1200"),
            (1234.0, None, "1230"),
            (-0.012_345, None, "-0.0123"),
            (0.000_012_345, None, "1.23e-5"),
            (0.0, Some(0.1), "0"),
            (0.0, None, "0"),
            (9.996, None, "10.00"),
        ];
        for (value, uncertainty, expected) in cases {
            assert_eq!(certain(value, uncertainty), expected, "{value} ± {uncertainty:?}");
        }
        assert_eq!((with_sign(0.123_4, None), with_sign(-0.123_4, None)), ("+0.123".into(), "-0.123".into()));
        assert_eq!((like(11.299, Some(1e-6)), like(11.299, Some(0.03)), like(11.299, None)).2, "11.3");
        assert_eq!((like(11.299, Some(1e-6)), like(11.299, Some(0.06))), ("11.3".into(), "11".into()));
        assert_eq!((margin(11.299_043, 0.308), margin(12.838, 1.01)), ("0.31".into(), "1.2".into()));
        assert_eq!([f64::NAN, f64::INFINITY].map(|value| certain(value, None)), ["?", "?"]);
    }

    /// Of any value: the shown one lies within five of its last digit of all that the value may be, and with one digit
    /// more it would not.
    #[test]
    fn the_last_digit_is_off_by_five_at_most() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..20_000 {
            let value = 10.0_f64.powf(8.0 * random() - 4.0) * if random() < 0.5 { -1.0 } else { 1.0 };
            let uncertainty = value.abs() * 10.0_f64.powf(-5.0 * random());
            let text = certain(value, Some(uncertainty));
            let shown: f64 = text.parse().expect("a number");
            let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let place = place(value, Some(uncertainty));
            assert!((shown - value).abs() <= 0.500_001 * power(place), "{value} ± {uncertainty}: {text}");
            // The uncertainty is at least half a unit of the last digit shown, unless six are enough, and at most five.
            assert!(place <= leading(value));
            if place < leading(value) {
                assert!(uncertainty < 5.000_001 * power(place), "{value} ± {uncertainty}: {text}");
            }
            if place > leading(value) + 1 - MOST && place < leading(value) {
                assert!(2.0 * uncertainty > 0.999_999 * power(place), "{value} ± {uncertainty}: {text}");
            }
            assert!(decimals <= 9, "{text}");
            let margin: f64 = margin(value, uncertainty).parse().expect("a number");
            assert!(margin >= 0.999_999 * ((shown - value).abs() + uncertainty), "{text} ± {margin} of {uncertainty}");
        }
    }
}
