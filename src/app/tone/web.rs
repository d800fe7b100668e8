//! The browser's oscillator.

use web_sys::{AudioContext, GainNode, OscillatorNode};

/// How loud it is, of one.
const VOLUME: f32 = 0.08;
/// Changes take this time constant, in s, so that they do not click.
const GLIDE: f64 = 0.03;

/// A tone, once one has been asked for.
#[derive(Default)]
pub struct Tone {
    source: Option<Source>,
}

struct Source {
    context: AudioContext,
    oscillator: OscillatorNode,
    gain: GainNode,
    /// What sounds, in Hz of the robot.
    sounding: Option<f64>,
}

impl Source {
    fn new() -> Result<Self, wasm_bindgen::JsValue> {
        let context = AudioContext::new()?;
        let (oscillator, gain) = (context.create_oscillator()?, context.create_gain()?);
        gain.gain().set_value(0.0);
        oscillator.connect_with_audio_node(&gain)?;
        gain.connect_with_audio_node(&context.destination())?;
        oscillator.start()?;
        Ok(Self { context, oscillator, gain, sounding: None })
    }

    #[expect(clippy::cast_possible_truncation)] // As the browser's interface has it.
    fn sound(&mut self, frequency: Option<f64>) -> Result<(), wasm_bindgen::JsValue> {
        let now = self.context.current_time();
        let heard = frequency.and_then(super::heard);
        if let Some(heard) = heard {
            self.oscillator.frequency().set_target_at_time(heard as f32, now, GLIDE)?;
        }
        let volume = if heard.is_some() { VOLUME } else { 0.0 };
        self.gain.gain().set_target_at_time(volume, now, GLIDE)?;
        self.sounding = frequency;
        Ok(())
    }
}

impl Tone {
    /// Sounds for a frequency of the robot, in Hz, or not at all.
    pub fn sound(&mut self, frequency: Option<f64>) {
        if self.source.is_none() && frequency.is_some() {
            // A browser without sound stays silent.
            self.source = Source::new().ok();
        }
        if let Some(source) = self.source.as_mut().filter(|source| source.sounding != frequency) {
            let _ = source.sound(frequency);
        }
    }
}
