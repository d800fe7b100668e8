//! Numbers as text, as people write them.

/// `value` · 10^`power` with all its digits: the fewest that lead back to the same number.
pub fn shifted(value: f64, power: i32) -> String {
    write(&format!("{value:e}"), power)
}

/// Rounded to `digits` significant ones; whole numbers of up to seven keep them all.
pub fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent = split(&text).1;
    let whole = usize::try_from(exponent).map_or(0, |exponent| exponent + 1);
    if whole > digits && exponent < LARGE {
        return write(&format!("{value:.*e}", whole - 1), 0);
    }
    write(&text, 0)
}

/// Numbers from 10^`LARGE` on have an exponent, and those below 10^`SMALL`.
const LARGE: i32 = 7;
const SMALL: i32 = -3;

fn split(scientific: &str) -> (&str, i32) {
    let (digits, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    (digits, exponent.parse().unwrap_or(0))
}

/// Writes what Rust's scientific notation says, times a power of ten, without needless zeros, and without an exponent
/// where it reads well without.
fn write(scientific: &str, power: i32) -> String {
    let (digits, exponent) = split(scientific);
    let (sign, digits) = digits.strip_prefix('-').map_or(("", digits), |digits| ("-", digits));
    if !digits.starts_with(|c: char| c.is_ascii_digit()) {
        return scientific.to_owned(); // Infinite, or no number.
    }
    let digits: String = digits.chars().filter(char::is_ascii_digit).collect();
    let digits = digits.trim_end_matches('0');
    if digits.is_empty() {
        return "0".into();
    }
    let exponent = exponent.saturating_add(power);
    match usize::try_from(exponent) {
        _ if !(SMALL..LARGE).contains(&exponent) => {
            let (first, rest) = digits.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{point}{rest}e{exponent}")
        }
        Ok(exponent) if digits.len() > exponent + 1 => {
            let (whole, part) = digits.split_at(exponent + 1);
            format!("{sign}{whole}.{part}")
        }
        Ok(exponent) => format!("{sign}{digits}{}", "0".repeat(exponent + 1 - digits.len())),
        Err(_) => {
            let zeros = "0".repeat(usize::try_from(-1 - exponent).unwrap_or(0));
            format!("{sign}0.{zeros}{digits}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_and_large_numbers_have_an_exponent() {
        let cases = [
            (4e-7, "4e-7", "4e-7"),
            (1.234_567_8e-5, "1.2346e-5", "1.2345678e-5"),
            (2.1e11, "2.1e11", "2.1e11"),
            (0.0, "0", "0"),
            (-0.0, "0", "0"),
            (0.005, "0.005", "0.005"),
            (-0.012_345_678, "-0.012346", "-0.012345678"),
            (125.0, "125", "125"),
            (0.1 + 0.2, "0.3", "0.30000000000000004"),
            (123_456.789, "123457", "123456.789"),
            (1_234_567.8, "1234568", "1234567.8"),
            (9_999_999.9, "1e7", "9999999.9"),
            (300_000.0, "300000", "300000"),
            (1e7, "1e7", "1e7"),
            (9.999_99, "10", "9.99999"),
            (0.000_999_999, "0.001", "9.99999e-4"),
            (-1.5e300, "-1.5e300", "-1.5e300"),
            (5e-324, "4.9407e-324", "5e-324"),
            (f64::MAX, "1.7977e308", "1.7976931348623157e308"),
        ];
        for (value, short, full) in cases {
            assert_eq!((rounded(value, 5).as_str(), shifted(value, 0).as_str()), (short, full), "{value:?}");
        }
    }

    #[test]
    fn no_digit_is_lost_by_a_power_of_ten() {
        for (value, power, text) in
            [(5e-5, 4, "0.5"), (1.25e8, -6, "125"), (1.1e-6, 4, "0.011"), (1.2e5, -9, "1.2e-4"), (0.0, 4, "0")]
        {
            assert_eq!(shifted(value, power), text);
        }
    }
}
