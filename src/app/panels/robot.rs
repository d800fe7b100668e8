//! The robot's layout: winches, how many cables, which two are at equilibrium, the size of the frame.

use eframe::egui::{Button, CollapsingHeader, ComboBox, Ui};

use super::rows::{NUMBER, Sheet, rows};
use crate::app::meaning::Explain as _;
use crate::app::number::{Control, Unit};
use crate::app::{canvas, fields};
use crate::robot::{BoundingBox, CABLES, TensionLaw};
use crate::scenario::v1::Cable;
use crate::scenario::{Parameter, Scenario};

/// Draws the controls.
pub(super) fn ui(unlocked: &mut bool, ui: &mut Ui, sheet: &mut Sheet<'_>) {
    ui.add_space(6.0);
    CollapsingHeader::new("Layout of the robot").show(ui, |ui| {
        ui.checkbox(unlocked, "Unlock the winches")
            .explained("Winches can then be dragged on the canvas, or moved by arrow keys");
        frame(ui, sheet);
        ui.horizontal_wrapped(|ui| {
            ui.label("At equilibrium").explained("The tensions of these two cables hold the platform in balance");
            let pair = equilibrium(&sheet.edited);
            for place in 0..pair.len().min(2) {
                partner(ui, &mut sheet.edited, &pair, place);
            }
        });
        let count = sheet.edited.cables.len();
        let mut removed = None;
        for cable in 0..count {
            CollapsingHeader::new(format!("Winch {}", cable + 1)).id_salt(("winch", cable)).show(ui, |ui| {
                rows(ui, sheet, &[Parameter::Anchor(cable, 0), Parameter::Anchor(cable, 1)]);
                let reason = why_it_stays(&sheet.edited, cable);
                let button = ui.add_enabled(reason.is_none(), Button::new(format!("Remove cable {}", cable + 1)));
                if button.grey_because(ui, reason.unwrap_or_default()).clicked() {
                    removed = Some(cable);
                }
            });
        }
        if let Some(cable) = removed {
            sheet.edited.cables.remove(cable);
        }
        let full = format!("A robot has at most {} cables here.", CABLES.end());
        let button = ui.add_enabled(count < *CABLES.end(), Button::new("Add a cable"));
        if button.grey_because(ui, full).clicked() {
            let cable = another(&sheet.edited);
            sheet.edited.cables.push(cable);
        }
    });
}

/// Width and height of the frame that the winches span; another one moves them all in proportion.
fn frame(ui: &mut Ui, sheet: &mut Sheet<'_>) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Frame").explained("The workspace that the winches span. Another size moves them in proportion.");
        for (i, name) in [(0, "Width"), (1, "Height")] {
            let winches = sheet.edited.cables.iter().map(|cable| cable.anchor.into());
            let Some(spanned) = BoundingBox::of(winches) else { continue };
            let (before, middle) = (spanned.size()[i], spanned.middle()[i]);
            if before <= 0.0 {
                continue;
            }
            let label = ui.label(name);
            let control = Control { name, unit: Unit::of("m"), step: 0.01 * before, size: NUMBER };
            let mut answer = control.show(ui, before);
            answer.response = answer.response.labelled_by(label.id);
            let Some(size) = answer.value else { continue };
            if size <= 0.0 {
                answer.refuse(ui, format!("{name} must be more than 0 m"));
                continue;
            }
            let mut edited = sheet.edited.clone();
            let scaled = |at: f64| middle + (at - middle) * (size / before);
            edited.cables.iter_mut().for_each(|cable| cable.anchor[i] = scaled(cable.anchor[i]));
            edited.motion.position[i] = scaled(edited.motion.position[i]);
            match fields::check(&edited, sheet.settings) {
                Ok(()) => sheet.edited = edited,
                Err(reason) => answer.refuse(ui, reason),
            }
        }
    });
}

fn equilibrium(scenario: &Scenario) -> Vec<usize> {
    let cables = scenario.cables.iter().enumerate();
    cables.filter(|(_, cable)| cable.tension == TensionLaw::Equilibrium).map(|(i, _)| i).collect()
}

/// One of the two; choosing another one exchanges their tension laws.
fn partner(ui: &mut Ui, edited: &mut Scenario, pair: &[usize], place: usize) {
    let now = pair[place];
    let name = ["First cable at equilibrium", "Second cable at equilibrium"][place];
    let list = ComboBox::from_id_salt(name).width(70.0).selected_text(format!("Cable {}", now + 1)).show_ui(ui, |ui| {
        for other in (0..edited.cables.len()).filter(|other| *other == now || !pair.contains(other)) {
            if ui.selectable_label(other == now, format!("Cable {}", other + 1)).clicked() && other != now {
                let law = edited.cables[other].tension;
                edited.cables[other].tension = TensionLaw::Equilibrium;
                edited.cables[now].tension = law;
            }
        }
    });
    canvas::named(&list.response, name, &format!("Cable {}", now + 1));
}

/// Why a cable cannot be removed, if it cannot.
fn why_it_stays(scenario: &Scenario, cable: usize) -> Option<&'static str> {
    if scenario.cables.len() <= *CABLES.start() {
        Some("A robot has at least three cables here.")
    } else if scenario.cables[cable].tension == TensionLaw::Equilibrium {
        Some("Two cables must be at equilibrium: choose another one in its place first.")
    } else {
        None
    }
}

/// A further cable: where the frame has most room, with the mean of the tensions prescribed.
fn another(scenario: &Scenario) -> Cable {
    let frame = canvas::frame(scenario);
    let [[left, bottom], [middle, height], [right, top]] =
        [frame.low, frame.middle(), frame.high].map(<[f64; 2]>::from);
    let places = [
        [left, bottom],
        [right, bottom],
        [left, top],
        [right, top],
        [middle, top],
        [middle, bottom],
        [left, height],
        [right, height],
    ];
    let room = |at: &[f64; 2]| {
        let away = |cable: &Cable| (cable.anchor[0] - at[0]).hypot(cable.anchor[1] - at[1]);
        scenario.cables.iter().map(away).fold(f64::INFINITY, f64::min)
    };
    let anchor = places.into_iter().max_by(|a, b| room(a).total_cmp(&room(b))).unwrap_or([middle, top]);
    let prescribed = scenario.cables.iter().filter(|cable| cable.tension != TensionLaw::Equilibrium);
    let tensions: Vec<f64> = prescribed.map(|cable| cable.tension.at(scenario.motion.position)).collect();
    let mean = tensions.iter().sum::<f64>() / tensions.len().max(1) as f64;
    // To three digits: nobody means it more exactly.
    let tension = format!("{mean:.2e}").parse().ok().filter(|tension| *tension > 0.0).unwrap_or(1.0);
    Cable { anchor, tension: TensionLaw::Constant(tension) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::presets;

    /// Cable after cable up to the limit, each time a physical robot.
    #[test]
    fn cables_can_be_added_up_to_eight() {
        let mut scenario = presets::PRESETS[0].scenario();
        while scenario.cables.len() < *CABLES.end() {
            scenario.cables.push(another(&scenario));
            assert!(scenario.to_robot().is_ok(), "{:?}", scenario.cables);
        }
        assert_eq!(equilibrium(&scenario), [0, 1]);
        assert!(why_it_stays(&scenario, 0).is_some() && why_it_stays(&scenario, 5).is_none());
    }
}
