//! The plots: groups and tabs to choose them by, and each in a file of its own.

mod axis;
mod campbell;
mod chart;
mod common;
mod directions;
mod eigenvalues;
mod flight;
mod growth;
mod header;
mod labels;
mod line;
mod mesh;
mod modes;
mod range;
mod sensitivities;
mod what_if;

use eframe::egui::{Align, Context, Id, Label, Layout, Rect, TextStyle, Ui, UiBuilder, Vec2};

pub use common::{Slot, progress_of};

use crate::app::canvas::View;
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::picture::PLOT;
use crate::app::state::{Plot, Session, UiState};
use common::PlotPlace;
use header::Header;
use range::VisibleRange;

/// Room beside the tabs under the robot, in points.
const MARGIN: f32 = 12.0;
/// With less height than this, in points, a plot tells nothing, and the panel scrolls.
const LEAST: f32 = 190.0;

/// Draws the plot of this slot with what it is chosen by, in all the room there is. In the dock the study along the line is
/// on the horizontal axis of `view`. Gives where the plot itself is.
pub fn ui(
    slot: Slot,
    state: &mut UiState,
    session: &mut Session,
    ui: &mut Ui,
    facts: Facts<'_>,
    view: Option<&View>,
    commands: &mut Vec<Command>,
) -> Rect {
    let wheel = !slot.is_sheet() && !session.embedded;
    let mut open = match slot {
        Slot::Right | Slot::Sheet => state.plot,
        Slot::Second => state.second,
        Slot::Dock | Slot::Under => state.dock,
        Slot::Present | Slot::Picture => UiState::presented(facts.document.scenario.path.is_some()),
        Slot::Large => session.large.unwrap_or(state.plot),
    };
    if slot == Slot::Dock {
        open = state.dock_plot(facts.document.scenario.path.is_some());
    }
    let explanation = |plot| explanation(plot, facts);
    let mut header =
        Header { open: &mut open, large: &mut session.large, camera: &mut session.camera, explanation: &explanation };
    let rect = ui.push_id(("plots", slot), |ui| {
        if slot != Slot::Present {
            // A plot under the robot has its whole width, its tabs do not.
            let margin = if slot.is_under_the_robot() { MARGIN } else { 0.0 };
            let inside = ui.available_rect_before_wrap().shrink2(Vec2::new(margin, 0.0));
            ui.scope_builder(UiBuilder::new().max_rect(inside), |ui| header.ui(slot, wheel, ui, facts, commands));
        }
        let place = PlotPlace { slot, plot: *header.open, wheel };
        let foot =
            if matches!(slot, Slot::Dock | Slot::Present) { 0.0 } else { ui.spacing().interact_size.y.max(28.0) + 4.0 };
        let room = ui.available_rect_before_wrap();
        let rect = Rect::from_min_max(room.min, room.max - Vec2::new(0.0, foot));
        ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
            let told = slot == Slot::Under && header::explains(ui.ctx(), place);
            if slot.is_under_the_robot() && place.plot.is_along_a_way() && !told {
                draw(place, view, state, ui, facts, commands);
            } else {
                gestures::scroll(ui, |ui| explained(place, view, state, ui, facts, commands));
            }
        });
        if foot > 0.0 {
            let margin = if slot == Slot::Under { MARGIN } else { 0.0 };
            let below = Rect::from_min_max(rect.left_bottom(), room.max).shrink2(Vec2::new(margin, 0.0));
            ui.scope_builder(UiBuilder::new().max_rect(below), |ui| header.foot(place, ui, facts, commands));
        }
        rect
    });
    let rect = rect.inner;
    match slot {
        Slot::Right | Slot::Sheet => state.plot = open,
        Slot::Second => state.second = open,
        Slot::Dock | Slot::Under => state.dock = open,
        Slot::Present | Slot::Picture => {}
        // Unless it has just been sent back to its size.
        Slot::Large => session.large = session.large.map(|_| open),
    }
    rect
}

/// Draws the study along the path, or along the line where there is no path, as a mere strip under the robot.
pub fn strip(state: &UiState, ui: &mut Ui, rect: Rect, view: &View, facts: Facts<'_>, commands: &mut Vec<Command>) {
    if facts.document.scenario.path.is_some() {
        let asked = flight::speeds::Asked { view: Some(view), now: flight::now(state, facts), limits: &state.limits };
        flight::speeds::strip(ui, rect, asked, facts);
    } else {
        line::strip(ui, rect, view, facts, commands);
    }
}

/// Draws a plot for a picture: the part of it that is on show in the `chart` of this name on the `screen`.
pub fn picture(plot: Plot, screen: &Context, chart: Id, state: &mut UiState, ui: &mut Ui, facts: Facts<'_>) {
    let place = PlotPlace { slot: Slot::Picture, plot, wheel: false };
    // The speed diagram has a second chart.
    for (there, here) in [(chart, place.id()), (chart.with("growth"), place.id().with("growth"))] {
        VisibleRange::of(screen, there).show(ui.ctx(), here);
    }
    explained(place, None, state, ui, facts, &mut Vec::new());
}

/// The title of a plot's picture.
pub fn picture_title(plot: Plot, facts: Facts<'_>) -> String {
    let motion = facts.document.scenario.motion;
    match plot {
        Plot::Line => {
            format!("Critical speed and frequency along {}", header::line_of(motion.position, motion.direction))
        }
        Plot::Directions => "Critical speed by direction, m/s".into(),
        Plot::Growth => "Largest growth rate against speed".into(),
        Plot::Campbell => "Frequencies and growth rates of all modes against speed".into(),
        Plot::Mesh => "Critical speed against the mesh".into(),
        Plot::Sensitivities => "What to change for another critical speed".into(),
        Plot::WhatIf => "Critical speed and frequency against a number of the robot".into(),
        Plot::Path => "Speed on the path and its limits".into(),
        Plot::Gain => "Gain of the move against its peak speed".into(),
        Plot::Deviation => "Platform off its path in a flight".into(),
        Plot::Tensions => "Cable tensions at the platform in a flight".into(),
        _ => plot.title().into(),
    }
}

/// The size of a plot's picture, in points: tables are as high as they are long.
pub fn picture_size(plot: Plot, facts: Facts<'_>) -> Vec2 {
    // A row of the table of modes with the space below it.
    const ROW: f32 = 30.0;
    let rows = match plot {
        Plot::Modes => common::with_modes(facts.answers).map_or(0, |pose| pose.modes.len()),
        Plot::Sensitivities => facts.answers.sensitivities().map_or(0, |(found, _)| found.as_ref().map_or(0, Vec::len)),
        _ => 0,
    };
    #[expect(clippy::cast_precision_loss)] // At most a few hundred.
    let table = (rows as f32 + 4.0) * ROW + 100.0;
    PLOT.max(Vec2::new(0.0, table))
}

/// Draws a plot, and below it what it means, where that is asked for.
fn explained(
    place: PlotPlace,
    view: Option<&View>,
    state: &mut UiState,
    ui: &mut Ui,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let text = (place.slot != Slot::Dock && header::explains(ui.ctx(), place)).then(|| explanation(place.plot, facts));
    let size = ui.available_size();
    let below = text.as_ref().map_or(0.0, |text| {
        let font = TextStyle::Body.resolve(ui.style());
        let galley = ui.painter().layout(text.clone(), font, ui.visuals().text_color(), size.x);
        galley.size().y + ui.spacing().item_spacing.y
    });
    let room = Vec2::new(size.x, (size.y - below).max(LEAST));
    // Where not all is in sight, the wheel scrolls.
    let place = PlotPlace { wheel: place.wheel && size.y - below >= LEAST, ..place };
    ui.allocate_ui_with_layout(room, Layout::top_down(Align::Min), |ui| {
        ui.set_min_size(room);
        draw(place, view, state, ui, facts, commands);
    });
    if let Some(text) = text {
        ui.add(Label::new(text).wrap());
    }
}

fn draw(
    place: PlotPlace,
    view: Option<&View>,
    state: &mut UiState,
    ui: &mut Ui,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    match place.plot {
        Plot::Eigenvalues => eigenvalues::ui(place, ui, facts, commands),
        Plot::Modes => modes::ui(ui, facts, commands),
        Plot::Growth => growth::ui(place, ui, facts),
        Plot::Line => line::ui(place, view, ui, facts, commands),
        Plot::Directions => directions::ui(place, ui, facts, commands),
        Plot::Campbell => campbell::ui(place, &mut state.campbell_hz, ui, facts, commands),
        Plot::Mesh => mesh::ui(place, ui, facts),
        Plot::Sensitivities => sensitivities::ui(ui, facts, commands),
        Plot::WhatIf => what_if::ui(place, &mut state.what_if, ui, facts, commands),
        Plot::Path => {
            let asked = flight::speeds::Asked { view, now: flight::now(state, facts), limits: &state.limits };
            flight::speeds::ui(place, asked, ui, facts, commands);
        }
        Plot::Gain => flight::gain::ui(place, ui, facts, commands),
        Plot::Deviation => flight::deviation::ui(place, flight::now(state, facts), ui, facts, commands),
        Plot::Tensions => flight::tensions::ui(place, flight::now(state, facts), ui, facts, commands),
    }
}

/// What a plot shows, in plain words, for those who ask.
fn explanation(plot: Plot, facts: Facts<'_>) -> String {
    match plot {
        Plot::Eigenvalues => eigenvalues::MEANING.into(),
        Plot::Modes => modes::MEANING.into(),
        Plot::Growth => growth::MEANING.into(),
        Plot::Line => line::meaning(facts),
        Plot::Directions => directions::MEANING.into(),
        Plot::Campbell => campbell::MEANING.into(),
        Plot::Mesh => mesh::MEANING.into(),
        Plot::Sensitivities => sensitivities::MEANING.into(),
        Plot::WhatIf => what_if::MEANING.into(),
        Plot::Path => flight::speeds::meaning(facts),
        Plot::Gain => flight::gain::meaning(facts),
        Plot::Deviation => flight::deviation::meaning(facts),
        Plot::Tensions => flight::tensions::meaning(facts),
    }
}
