//! The frequency of the mode on show as a tone.
//!
//! Cables of large robots swing below what can be heard, those of small ones at the upper end of it: six powers of ten
//! between them. The tone goes with the cube root of the frequency, so that what is from 1 mHz to 1 MHz comes to lie
//! between 20 Hz and 20 kHz, and the pitch follows wherever the robot is.

#[cfg(target_arch = "wasm32")]
mod web;

#[cfg(target_arch = "wasm32")]
pub use web::Tone;

use crate::app::number::rounded;
use crate::app::settings::Settings;

/// What is heard of 1 Hz, in Hz.
const HEARD_OF_ONE: f64 = 200.0;
/// Frequencies beyond these, in Hz, are silent: their tones would be beyond what ears can do.
const SOUNDING: [f64; 2] = [1e-3, 1e6];

/// The tone for a frequency of the robot, both in Hz: 200 times the cube root. None where that cannot be heard.
pub fn heard(frequency_hz: f64) -> Option<f64> {
    let [low, high] = SOUNDING;
    (low..=high).contains(&frequency_hz).then(|| HEARD_OF_ONE * frequency_hz.cbrt())
}

/// What is said of the tone of a mode with this frequency in Hz, where one is on show.
pub fn text(frequency_hz: Option<f64>, settings: Settings) -> String {
    let (hertz, unit) = settings.hertz();
    let of_mode = |frequency: f64| format!("{} {unit}", rounded(frequency * hertz, 3));
    match frequency_hz.filter(|frequency| frequency.is_finite()) {
        None => "The mode's frequency as a tone".into(),
        Some(frequency) => match heard(frequency) {
            Some(tone) => format!(
                "The mode's frequency as a tone: {} is heard as {} Hz. Eight times the frequency sounds an octave \
                 higher, so that slow and fast robots can be heard.",
                of_mode(frequency),
                rounded(tone, 3)
            ),
            None if frequency == 0.0 => "The mode's frequency as a tone. This mode does not oscillate: silence.".into(),
            None => format!("The mode's frequency as a tone. {} cannot be made one: silence.", of_mode(frequency)),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::settings::FrequencyUnit;

    #[test]
    fn every_frequency_has_a_tone_that_can_be_heard_and_follows_it() {
        let frequencies: Vec<f64> = (0..=900).map(|i| 1e-3 * 10_f64.powf(f64::from(i) / 100.0)).collect();
        for pair in frequencies.windows(2) {
            let [low, high] = [pair[0], pair[1].min(1e6)].map(|frequency| heard(frequency).expect("a tone"));
            assert!((19.999..20_001.0).contains(&low), "{low} Hz");
            // A step of 2.3 % in the frequency is an eighth of a semitone, everywhere the same.
            assert!(((high / low).ln() - (pair[1] / pair[0]).ln() / 3.0).abs() < 1e-9, "{pair:?}: {low}, {high}");
        }
        // An octave is eight times the frequency.
        assert_eq!(heard(1.0), Some(200.0));
        assert_eq!([heard(8.0), heard(0.125)], [Some(400.0), Some(100.0)]);
    }

    #[test]
    fn what_is_said_of_the_tone_is_what_sounds() {
        let settings = Settings::default();
        let said = |frequency| text(Some(frequency), settings);
        for frequency in [1e-3, 0.271_55, 3.0, 66.6, 2_744.0, 1e6] {
            let number = |text: &str, before: &str| -> f64 {
                let rest = text.split(before).nth(1).and_then(|rest| rest.split(' ').next());
                rest.and_then(|number| number.parse().ok()).unwrap_or_else(|| panic!("{text}"))
            };
            let text = said(frequency);
            assert!((number(&text, "tone: ") / frequency - 1.0).abs() < 5e-3, "{text}");
            assert!((number(&text, "heard as ") / heard(frequency).expect("a tone") - 1.0).abs() < 5e-3, "{text}");
        }
        assert!(said(2_744.0).contains("2744 Hz is heard as 2800 Hz"), "{}", said(2_744.0));
        // What is silent is said to be.
        for frequency in [0.0, 9e-4, 1.1e6] {
            assert_eq!(heard(frequency), None);
            assert!(said(frequency).contains("silence"), "{}", said(frequency));
        }
        for nothing in [None, Some(f64::INFINITY), Some(f64::NAN)] {
            assert_eq!(nothing.and_then(heard), None);
            assert_eq!(text(nothing, settings), "The mode's frequency as a tone");
        }
        let radians = Settings { frequency: FrequencyUnit::RadiansPerSecond, ..settings };
        assert!(text(Some(1.0), radians).contains("6.28 rad/s is heard as 200 Hz"), "{}", text(Some(1.0), radians));
    }
}
