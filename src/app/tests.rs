//! What the interface does where its engine fails: with an engine made up here.

use std::sync::mpsc::channel;

use eframe::egui::Vec2;
use egui_kittest::Harness;

use super::{Start, Tautline};
use crate::compute::Compute;
use crate::compute::protocol::{Reply, Update};
use crate::scenario::presets;

fn app() -> Harness<'static, Tautline> {
    let start = Start { scenario: Some(presets::PRESETS[0].scenario()), ..Start::default() };
    Harness::builder().with_size(Vec2::new(1280.0, 800.0)).build_eframe(|context| Tautline::new(context, start))
}

/// The browser may report an error of a worker and the watch its silence between two frames: that is one loss.
#[test]
fn an_engine_that_is_lost_twice_between_two_frames_is_started_again_once() {
    let mut app = app();
    for (loss, reasons) in [["an error", "it does not answer"], ["an error", "another error"]].iter().enumerate() {
        let (outbox, replies) = channel();
        for reason in reasons {
            let update = Update::Broken((*reason).into());
            outbox.send(Reply { revision: app.state().engine.revision, update }).expect("an open channel");
        }
        app.state_mut().engine.compute = Some(Compute::of_replies(replies));
        let before = app.state().engine.revision;
        app.step();
        let state = app.state();
        assert_eq!(
            (state.engine.losses as usize, state.engine.revision),
            (loss + 1, before + 1),
            "{:?}",
            state.notice()
        );
        assert!(state.engine.compute.is_some(), "it has been started again");
        assert!(state.notice().is_some_and(|notice| notice.contains("(an error)")), "{:?}", state.notice());
    }
}
