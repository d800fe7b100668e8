//! Designs that are kept beside the present one, to see what differs: up to four, called A to D.

use eframe::egui::{Color32, Visuals};

use crate::app::answers::Answers;
use crate::app::certainty::Certainty;
use crate::app::state::{Document, Plot, UiState};
use crate::app::studies::{self, KEPT, Order, Studies, StudyResults};
use crate::app::theme;
use crate::compute::Compute;
use crate::compute::protocol::{
    AnalysedPose, Job, ModeChoice, Reply, Request, SearchEnd, StudyNews, Topic, Update, Which,
};
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::stability::Critical;
use crate::study::Sensitivity;

/// The only revision of a kept design's own engine.
const OWN: u64 = 1;
/// Why no further design can be kept.
const FULL: &str = "A to D are all taken. Remove one of the designs to keep another.";

/// What a kept design is called for short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Letter {
    /// The first one.
    A,
    /// The second one.
    B,
    /// The third one.
    C,
    /// The fourth one.
    D,
}

impl Letter {
    /// All of them, in their order.
    pub const ALL: [Self; KEPT] = [Self::A, Self::B, Self::C, Self::D];

    /// The letter itself.
    pub fn name(self) -> &'static str {
        ["A", "B", "C", "D"][self as usize]
    }

    /// The colour of what belongs to the design.
    pub fn colour(self, visuals: &Visuals) -> Color32 {
        theme::designs(visuals)[self as usize]
    }

    /// The letter before this one.
    pub fn before(self) -> Option<Self> {
        Self::ALL.get((self as usize).checked_sub(1)?).copied()
    }

    /// The letter after this one.
    pub fn after(self) -> Option<Self> {
        Self::ALL.get(self as usize + 1).copied()
    }
}

/// What is to be done with a kept design.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Keep the present design under the next free letter.
    Keep,
    /// Let this one and the present one change places.
    WorkOn(Letter),
    /// Show this one in the plots, or hide it.
    Show(Letter, bool),
    /// Give this one another name; an empty one is none.
    Rename(Letter, String),
    /// Let these two change letters.
    Exchange(Letter, Letter),
    /// Let this one go.
    Remove(Letter),
}

/// A design with what is known of it.
pub struct Design {
    /// The design, with the values that a reset gives back.
    pub document: Document,
    /// Whether answers and plots show it.
    pub shown: bool,
    answers: Answers,
    studies: Studies,
}

impl Design {
    fn new(document: Document, answers: Answers) -> Self {
        Self { document, shown: true, answers, studies: Studies::default() }
    }

    /// What is known of its pose.
    pub fn answers(&self) -> &Answers {
        &self.answers
    }

    /// Whether all is known of its pose that can be.
    pub fn is_complete(&self) -> bool {
        !self.answers.are_awaited()
    }

    /// Its pose and modes.
    pub fn pose(&self) -> Option<&AnalysedPose> {
        self.answers.pose()
    }

    /// Its growth rates against speed.
    pub fn curve(&self) -> &[[f64; 2]] {
        self.answers.curve().map(|(points, _)| points).unwrap_or_default()
    }

    /// By how much the present critical speed is higher, in m/s, where both have one.
    #[cfg(target_arch = "wasm32")] // The mirror for screen readers tells it.
    pub fn difference(&self, now: &Answers) -> Option<f64> {
        let now = now.last_critical()?.critical.as_ref()?;
        Some(now.speed - self.critical()?.speed)
    }

    /// How its critical speed depends on each parameter.
    pub fn sensitivities(&self) -> Option<&[Sensitivity]> {
        self.answers.sensitivities().and_then(|(found, _)| found.as_deref().ok())
    }

    /// The end of its search for a critical speed.
    pub fn search(&self) -> Option<&SearchEnd> {
        self.answers.last_critical()
    }

    /// Its critical speed.
    pub fn critical(&self) -> Option<&Critical> {
        self.search()?.critical.as_ref()
    }

    /// How far its critical speed can be trusted.
    pub fn certainty(&self) -> Certainty {
        Certainty::known(&self.document.scenario, &self.answers, &self.studies)
    }

    /// What is known of a study of it, once there is a picture.
    pub fn study(&self, topic: Topic) -> Option<&StudyResults> {
        self.studies.shown(topic).filter(|shown| shown.current).map(|shown| shown.known)
    }

    /// Asks for the studies of the plots on show, while `idle`.
    fn want(&mut self, idle: bool, state: &UiState, plots: &[Plot]) -> Vec<Order> {
        let critical = self.critical().map(|critical| critical.speed);
        let idle = idle && self.shown && self.is_complete() && !self.answers.pose_failed();
        let plots = if idle { plots } else { &[] };
        let mut requests = studies::wanted(&self.document.scenario, state, plots, critical, idle);
        // These show one design.
        requests
            .retain(|request| !matches!(request.topic(), Topic::Map | Topic::Border | Topic::Reach | Topic::Flight));
        self.studies.want(requests)
    }
}

/// The designs that are kept, each under its letter.
#[derive(Default)]
pub struct Designs {
    kept: [Option<Design>; KEPT],
    /// Computes what is not known yet: of one design at a time.
    engine: Option<(Letter, Compute)>,
}

impl std::fmt::Debug for Designs {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_list().entries(self.all().map(|(letter, design)| (letter, &design.document))).finish()
    }
}

impl Designs {
    /// Puts a design back that was written down earlier.
    pub fn restore(&mut self, letter: Letter, document: Document, shown: bool) {
        self.kept[letter as usize] = Some(Design { shown, ..Design::new(document, Answers::default()) });
    }

    /// The design of a letter.
    pub fn get(&self, letter: Letter) -> Option<&Design> {
        self.kept[letter as usize].as_ref()
    }

    /// All that are kept.
    pub fn all(&self) -> impl Iterator<Item = (Letter, &Design)> {
        Letter::ALL.into_iter().filter_map(|letter| Some((letter, self.get(letter)?)))
    }

    /// Those that answers and plots show.
    pub fn shown(&self) -> impl Iterator<Item = (Letter, &Design)> {
        self.all().filter(|(_, design)| design.shown)
    }

    /// Keeps a design with what is known of it. What is not known yet is computed: the engine of the present design goes
    /// on with whatever that becomes.
    ///
    /// # Errors
    /// Where all letters are taken.
    pub fn keep(&mut self, document: Document, answers: &Answers) -> Result<(), String> {
        let free = self.kept.iter_mut().find(|kept| kept.is_none()).ok_or(FULL)?;
        *free = Some(Design::new(document, known(answers)));
        Ok(())
    }

    /// Puts the present design in the place of a kept one, which it gives. The place must be at rest.
    pub fn swap(&mut self, letter: Letter, document: Document, answers: &Answers) -> Option<Document> {
        let kept = self.kept[letter as usize].as_mut()?;
        let shown = kept.shown;
        let before = std::mem::replace(kept, Design { shown, ..Design::new(document, known(answers)) });
        Some(before.document)
    }

    /// Lets two letters change places. Both must be at rest.
    pub fn exchange(&mut self, one: Letter, other: Letter) {
        self.kept.swap(one as usize, other as usize);
    }

    /// Lets a design go, which must be at rest.
    pub fn remove(&mut self, letter: Letter) {
        self.kept[letter as usize] = None;
    }

    /// Shows a design in answers and plots, or hides it.
    pub fn show(&mut self, letter: Letter, shown: bool) {
        if let Some(design) = &mut self.kept[letter as usize] {
            design.shown = shown;
        }
    }

    /// Gives a design another name.
    pub fn rename(&mut self, letter: Letter, name: String) {
        if let Some(design) = &mut self.kept[letter as usize] {
            design.document.scenario.name = Some(name).filter(|name| !name.is_empty());
        }
    }

    /// Brings a letter's computations to rest: what the pool is to be told.
    pub fn rest(&mut self, letter: Letter) -> Vec<Order> {
        self.engine.take_if(|(at_work, _)| *at_work == letter);
        self.kept[letter as usize].as_mut().map(|design| design.studies.want(Vec::new())).unwrap_or_default()
    }

    /// Takes in what the engine has found, and has it begin with the next design that is not known whole; it calls `wake`
    /// when there is news.
    ///
    /// # Errors
    /// Where the engine is lost, or there is none to be had.
    pub fn go_on(&mut self, wake: impl Fn() + Send + 'static) -> Result<(), String> {
        if let Some((letter, engine)) = &mut self.engine {
            let Some(design) = &mut self.kept[*letter as usize] else {
                self.engine = None;
                return Ok(());
            };
            for reply in engine.poll() {
                if let Reply { update: Update::Broken(reason), .. } = reply {
                    design.answers.break_down(reason.clone());
                    let text = format!("Design {} could not be computed: {reason}.", letter.name());
                    self.engine = None;
                    return Err(text);
                }
                design.answers.take(reply);
            }
            if design.is_complete() {
                self.engine = None;
            }
        } else if let Some((letter, design)) = Letter::ALL
            .into_iter()
            .zip(&mut self.kept)
            .filter_map(|(letter, kept)| Some((letter, kept.as_mut()?)))
            .find(|(_, design)| !design.is_complete())
        {
            design.answers = Answers::default();
            design.answers.expect(OWN);
            let job = Job {
                revision: OWN,
                scenario: design.document.scenario.to_json(),
                max_speed: DEFAULT_MAX_SPEED,
                mode: ModeChoice { which: Which::Critical, along_x: false },
            };
            let begun = Compute::start(wake).and_then(|mut engine| {
                engine.submit(&Request::Analyze(job))?;
                Ok(engine)
            });
            match begun {
                Ok(engine) => self.engine = Some((letter, engine)),
                Err(reason) => {
                    design.answers.break_down(reason.clone());
                    return Err(reason);
                }
            }
        }
        Ok(())
    }

    /// Asks for the studies of the plots on show, while `idle`: the present design comes first, then one design after the
    /// other. Says what each letter tells the pool.
    pub fn want(&mut self, mut idle: bool, state: &UiState, plots: &[Plot]) -> Vec<(Letter, Vec<Order>)> {
        let mut all = Vec::new();
        for (letter, kept) in Letter::ALL.into_iter().zip(&mut self.kept) {
            if let Some(design) = kept {
                all.push((letter, design.want(idle, state, plots)));
                idle &= !design.studies.is_working();
            }
        }
        all
    }

    /// Takes in what the pool has found for one of them, by its place among the letters.
    pub fn take(&mut self, place: usize, news: StudyNews) {
        if let Some(Some(design)) = self.kept.get_mut(place) {
            design.studies.take(news);
        }
    }

    /// Whether not all is known of the pose of one of them.
    pub fn are_awaited(&self) -> bool {
        self.all().any(|(_, design)| !design.is_complete())
    }

    /// Whether a study of one of them is being computed.
    pub fn are_studied(&self) -> bool {
        self.all().any(|(_, design)| design.studies.is_working())
    }
}

/// Answers to be kept: those that are not complete are computed anew.
fn known(answers: &Answers) -> Answers {
    if answers.all_current() { answers.clone() } else { Answers::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::presets;

    #[test]
    fn four_designs_are_kept_and_no_fifth_one() {
        let mut designs = Designs::default();
        let document = |mass: f64| {
            let mut scenario = presets::PRESETS[0].scenario();
            scenario.platform.mass = mass;
            Document::opened(scenario)
        };
        let masses = |designs: &Designs| -> Vec<(&str, f64)> {
            designs.all().map(|(letter, design)| (letter.name(), design.document.scenario.platform.mass)).collect()
        };
        for mass in [1.0, 2.0, 3.0, 4.0] {
            assert_eq!(designs.keep(document(mass), &Answers::default()), Ok(()));
        }
        assert!(designs.keep(document(5.0), &Answers::default()).is_err_and(|reason| reason.contains("A to D")));
        designs.exchange(Letter::A, Letter::B);
        assert_eq!(masses(&designs), [("A", 2.0), ("B", 1.0), ("C", 3.0), ("D", 4.0)]);
        // The present one takes the place of the one that is worked on.
        designs.show(Letter::C, false);
        assert_eq!(designs.swap(Letter::C, document(9.0), &Answers::default()), Some(document(3.0)));
        assert_eq!(masses(&designs)[2], ("C", 9.0));
        assert_eq!(designs.shown().map(|(letter, _)| letter.name()).collect::<String>(), "ABD");
        designs.remove(Letter::B);
        assert_eq!(designs.swap(Letter::B, document(1.0), &Answers::default()), None);
        // The next free letter.
        assert_eq!(designs.keep(document(5.0), &Answers::default()), Ok(()));
        assert_eq!(masses(&designs)[1], ("B", 5.0));
    }

    #[test]
    fn letters_have_neighbours() {
        assert_eq!(Letter::ALL.map(Letter::before), [None, Some(Letter::A), Some(Letter::B), Some(Letter::C)]);
        assert_eq!(Letter::ALL.map(Letter::after), [Some(Letter::B), Some(Letter::C), Some(Letter::D), None]);
    }
}
