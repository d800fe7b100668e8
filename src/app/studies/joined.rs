//! The modes of the Campbell diagram: its eigenvalues joined from speed to speed, which the pool does.

use super::{Order, StudyResults};
use crate::app::series::{self, Piece};
use crate::compute::protocol::{Revision, StudyJob, StudyNews, Topic};
use crate::study::{Answer, Study};

/// What modes are joined of: a study's answers so far, up to a highest frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Source {
    version: (Revision, usize),
    answered: usize,
    highest: f64,
}

/// The modes on show, and those that are being joined.
#[derive(Debug, Default)]
pub struct Joined {
    revision: Revision,
    /// What the pool is at: one at a time, so that each of a slider's movements need not end before there is a picture.
    waiting: Option<Source>,
    /// What has been joined last, or could not be.
    last: Option<Source>,
    pieces: Vec<Piece>,
}

impl Joined {
    /// Says what the pool is to be told so that modes of `known`, the study on show, up to `highest` Hz will be there;
    /// without a study nothing is joined.
    pub fn want(&mut self, known: Option<&StudyResults>, highest: f64) -> Option<Order> {
        let Some(known) = known else {
            return self.waiting.take().map(|_| Order::Cancel(Topic::Modes));
        };
        let source = Source { version: known.version, answered: known.answered(), highest };
        if self.waiting.is_some_and(|waiting| waiting.version.0 == source.version.0) || self.last == Some(source) {
            return None;
        }
        // Of one study that is at work again only where there is twice as much of it.
        let more = |last: Source| source.answered >= 2 * last.answered.max(8) || known.is_complete();
        let same = |last: &Source| last.version.0 == source.version.0 && last.highest.to_bits() == highest.to_bits();
        if self.last.filter(same).is_some_and(|last| !more(last)) {
            return None;
        }
        self.waiting = Some(source);
        self.revision += 1;
        Some(Order::Want(StudyJob {
            revision: self.revision,
            scenario: known.request.scenario.to_json(),
            study: Study::Modes { spectra: series::spectra_up_to(known, highest) },
        }))
    }

    /// Takes in what the pool has found.
    pub fn take(&mut self, news: &StudyNews) {
        let ended = match news {
            StudyNews::Places { topic: Topic::Modes, revision, answers } if *revision == self.revision => {
                if let [(0, Answer::Modes(Ok(tracks)))] = answers.as_slice() {
                    self.pieces = tracks.iter().flat_map(series::pieces).collect();
                }
                true
            }
            StudyNews::Refused { topic: Topic::Modes, revision, .. } => *revision == self.revision,
            StudyNews::Broken(_) => true,
            _ => false,
        };
        if ended && let Some(source) = self.waiting.take() {
            self.last = Some(source);
        }
    }

    /// Their lines, of the study and the range that were joined last.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Whether modes are being joined.
    pub fn is_working(&self) -> bool {
        self.waiting.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::studies::StudyRequest;
    use crate::robot::Vec2;
    use crate::scenario::presets;
    use crate::study::campbell::Track;
    use nalgebra::Complex;

    /// Two modes at four speeds, in the order in which the spectra have them.
    fn known(answered: usize) -> StudyResults {
        let study = Study::Campbell { position: Vec2::zeros(), direction: Vec2::x(), to: 3.0, count: 4 };
        let request = StudyRequest::new(&presets::PRESETS[0].scenario(), study);
        let values = |i: usize| [[-0.1, 1.0 + i as f64], [-0.2, 5.0 - i as f64], [-9.0, 900.0]];
        let spectrum = |i: usize| values(i).map(|[re, im]| Complex::new(re, im)).to_vec();
        let places = (0..4).map(|i| (i < answered).then(|| Answer::Spectrum(Ok(spectrum(i))))).collect();
        StudyResults { request, places, version: (7, answered) }
    }

    fn asked(order: Option<Order>) -> StudyJob {
        let Some(Order::Want(job)) = order else { panic!("{order:?}") };
        job
    }

    fn answer(job: &StudyJob, modes: Vec<Track>) -> StudyNews {
        StudyNews::Places { topic: Topic::Modes, revision: job.revision, answers: vec![(0, Answer::Modes(Ok(modes)))] }
    }

    /// A slider asks for another range in every frame: what is at work ends, then comes what is wanted by then.
    #[test]
    fn a_moving_slider_joins_modes_one_range_after_the_other() {
        let mut joined = Joined::default();
        let known = known(4);
        let first = asked(joined.want(Some(&known), 5.0));
        let Study::Modes { spectra } = &first.study else { panic!("{first:?}") };
        assert_eq!((spectra.len(), spectra[0].1.len()), (4, 2), "900 rad/s are beyond the range");
        for highest in [5.0, 6.0, 7.0, 8.0] {
            assert_eq!(joined.want(Some(&known), highest), None, "one at a time");
        }
        assert!(joined.pieces().is_empty() && joined.is_working(), "nothing is joined here");
        let track = |re: f64, from: f64, step: f64| {
            let point = |i| (f64::from(i), Complex::new(re, from + step * f64::from(i)));
            Track { points: (0..4).map(point).collect() }
        };
        joined.take(&answer(&first, vec![track(-0.1, 1.0, 1.0), track(-0.2, 5.0, -1.0)]));
        assert_eq!((joined.pieces().len(), joined.is_working()), (2, false));
        assert_eq!(joined.pieces()[1].points[3], (3.0, Complex::new(-0.2, 2.0)));
        let second = asked(joined.want(Some(&known), 8.0));
        assert!(second.revision > first.revision);
        joined.take(&answer(&first, Vec::new()));
        assert!(joined.is_working(), "an answer that is too late says nothing");
        joined.take(&answer(&second, Vec::new()));
        assert_eq!(joined.want(Some(&known), 8.0), None, "all is known");
    }

    #[test]
    fn what_cannot_be_joined_is_not_asked_for_again_and_again() {
        let mut joined = Joined::default();
        asked(joined.want(Some(&known(4)), 5.0));
        joined.take(&StudyNews::Broken("no workers".into()));
        assert_eq!((joined.want(Some(&known(4)), 5.0), joined.is_working()), (None, false));
        asked(joined.want(Some(&known(4)), 6.0));
        assert_eq!(joined.want(None, 6.0), Some(Order::Cancel(Topic::Modes)), "nobody looks any more");
        assert_eq!(joined.want(None, 6.0), None);
    }
}
