//! The cables: a table of all of them, and the numbers of the one that is chosen.

use eframe::egui::{
    Align2, Color32, ComboBox, FontId, Key, KeyboardShortcut, Label, Modifiers, Pos2, RichText, Role, Sense, Ui, Vec2,
    WidgetInfo,
};

use super::ropes;
use super::rows::{EditedScenario, list, rows};
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::number::{Control, Unit};
use crate::app::state::Session;
use crate::app::{canvas, fields, number, theme};
use crate::robot::{BoundingBox, CABLES, OwnMaterial, Strain, TensionLaw};
use crate::scenario::json::{Cable, Material};
use crate::scenario::{Parameter, Scenario, table};

/// The height of a row of the table.
const ROW: f32 = 26.0;

/// Draws the table and what belongs to it.
pub(super) fn ui(
    session: &mut Session,
    ui: &mut Ui,
    sheet: &mut EditedScenario<'_>,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    if let Some(parameter) = sheet.revealed {
        session.cable = cable_of(parameter).or(session.cable);
    }
    session.cable = session.cable.filter(|cable| *cable < sheet.edited.cables.len());
    let columns = Columns::within(ui.available_width());
    titles(ui, &columns);
    for cable in 0..sheet.edited.cables.len() {
        row(session, ui, sheet, facts, &columns, cable);
        if session.cable == Some(cable) {
            let before = sheet.edited.cables.len();
            ui.indent(("cable", cable), |ui| details(ui, sheet, cable));
            if sheet.edited.cables.len() != before {
                session.cable = None;
                return;
            }
        }
    }
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        let height = if sheet.touch { 44.0 } else { 28.0 };
        let count = sheet.edited.cables.len();
        let full = format!("A robot has at most {} cables here.", CABLES.end());
        let button = IconButton::new(Icon::Plus, "Add a cable").text("cable").height(height).framed();
        let button = ui.add_enabled_ui(count < *CABLES.end(), |ui| button.show(ui)).inner;
        if button.grey_because(ui, full).clicked() {
            let cable = another(&sheet.edited);
            sheet.edited.cables.push(cable);
        }
        clipboard(ui, height, commands);
        ui.toggle_value(&mut session.labels, "Labels").explained("Writes every cable's figures beside it");
        ui.toggle_value(&mut session.unlocked, "Unlock the winches").explained(
            "Winches can then be dragged on the canvas, or moved by arrow keys; frame and balance can be changed",
        );
    });
    if !session.unlocked {
        return;
    }
    frame(ui, sheet);
    ui.horizontal_wrapped(|ui| {
        ui.label("Balance").explained("The tensions of these two cables hold the platform in balance");
        let pair = equilibrium(&sheet.edited);
        for place in 0..pair.len().min(2) {
            partner(ui, &mut sheet.edited, &pair, place);
        }
    });
}

/// The table to a spreadsheet, and from one.
fn clipboard(ui: &mut Ui, height: f32, commands: &mut Vec<Command>) {
    let button = |name, text| IconButton::new(Icon::None, name).text(text).height(height).framed();
    let copy = button("Copy the cables", "Copy").show(ui);
    if copy.explained("Puts the table on the clipboard, for a spreadsheet: m and N").clicked() {
        commands.push(Command::CopyCables);
    }
    let keys = ui.ctx().format_shortcut(&KeyboardShortcut::new(Modifiers::COMMAND, Key::V));
    let paste = button("Paste cables", "Paste").show(ui);
    let meaning = format!(
        "Takes the cables from a table on the clipboard: x, y in m and the tension, a number in N or \"balances\", with or \
         without a row of names. Where the browser does not let the page read the clipboard, press {keys}."
    );
    if paste.explained(meaning).clicked() {
        commands.push(Command::Paste);
    }
}

/// The cable that a number belongs to.
fn cable_of(parameter: Parameter) -> Option<usize> {
    match parameter {
        Parameter::Anchor(cable, _)
        | Parameter::Tension(cable)
        | Parameter::Horizontal(cable, _)
        | Parameter::Vertical(cable, _)
        | Parameter::OwnYoungsModulus(cable)
        | Parameter::OwnArea(cable)
        | Parameter::OwnMassPerLength(cable) => Some(cable),
        _ => None,
    }
}

/// Where the columns end, from the left edge in points; the first two are numbers' middles.
struct Columns {
    x: f32,
    y: f32,
    tension: f32,
    now: f32,
    reel: f32,
}

impl Columns {
    fn within(width: f32) -> Self {
        let spare = (width - 248.0).max(0.0);
        Self {
            x: 50.0 + 0.1 * spare,
            y: 82.0 + 0.2 * spare,
            tension: 92.0 + 0.3 * spare,
            now: width - 62.0,
            reel: width - 2.0,
        }
    }
}

fn titles(ui: &mut Ui, columns: &Columns) {
    let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), 18.0), Sense::hover());
    let weak = theme::tokens(ui.visuals()).weak;
    let titles = [
        (columns.x, Align2::RIGHT_CENTER, "x, m", "Where the winch is, to the right"),
        (columns.y, Align2::RIGHT_CENTER, "y, m", "Where the winch is, upward"),
        (
            columns.tension,
            Align2::LEFT_CENTER,
            "tension",
            "Two cables balance the platform; the others have a tension of their own",
        ),
        (columns.now, Align2::RIGHT_CENTER, "now, N", "The tension at the platform at this pose"),
        (
            columns.reel,
            Align2::RIGHT_CENTER,
            "reel, m/s",
            "How fast the winch reels in or pays out at the present speed",
        ),
    ];
    for (x, align, text, meaning) in titles {
        let at = Pos2::new(rect.min.x + x, rect.center().y);
        put(ui, at, align, RichText::new(text).size(theme::CAPTION).color(weak)).explained(meaning);
    }
}

/// A text at its place.
fn put(ui: &mut Ui, at: Pos2, align: Align2, text: RichText) -> eframe::egui::Response {
    let font = FontId::proportional(theme::BODY);
    let galley = eframe::egui::WidgetText::from(text.clone()).into_galley(
        ui,
        Some(eframe::egui::TextWrapMode::Extend),
        f32::INFINITY,
        font,
    );
    let rect = align.anchor_size(at, galley.size());
    ui.put(rect, Label::new(text).selectable(false).sense(Sense::hover()).extend())
}

/// One cable in a line. A click opens its numbers.
fn row(
    session: &mut Session,
    ui: &mut Ui,
    sheet: &EditedScenario<'_>,
    facts: Facts<'_>,
    columns: &Columns,
    cable: usize,
) {
    let tokens = theme::tokens(ui.visuals());
    let height = if sheet.touch { 44.0 } else { ROW };
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), height), Sense::click());
    let chosen = session.cable == Some(cable);
    let blamed = blamed(facts) == Some(cable);
    let own = !sheet.edited.cables[cable].cable.is_empty();
    let Figures { tension, now, reel } = Figures::of(&sheet.edited, facts, cable);
    let [x, y] = sheet.edited.cables[cable].anchor.map(|at| number::rounded(at, 4).replace('-', "−"));
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(format!(
            "winch at ({x}, {y}) m, {tension}, {now} N, {reel} m/s{}",
            if own { ", own material" } else { "" }
        )),
        ..WidgetInfo::selected(Role::Button, true, chosen, format!("Cable {}", cable + 1))
    });
    if blamed {
        ui.painter().rect_filled(rect, 4.0, tokens.critical_fill);
    } else if chosen || response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 4.0, tokens.field);
    }
    let disc = Pos2::new(rect.min.x + 10.0, rect.center().y);
    let font = FontId::proportional(theme::CAPTION);
    let (fill, colour) = if blamed { (tokens.critical, tokens.on_accent) } else { (Color32::TRANSPARENT, tokens.text) };
    ui.painter().circle(disc, 8.5, fill, (1.0, if blamed { tokens.critical } else { tokens.frame }));
    ui.painter().text(disc, Align2::CENTER_CENTER, (cable + 1).to_string(), font, colour);
    if own {
        ui.painter().circle_filled(disc + Vec2::new(7.5, -7.5), 2.5, tokens.accent_text);
    }
    let font = FontId::proportional(theme::BODY);
    let cell = |x: f32, align: Align2, text: &str, colour: Color32| {
        ui.painter().text(Pos2::new(rect.min.x + x, rect.center().y), align, text, font.clone(), colour);
    };
    cell(columns.x, Align2::RIGHT_CENTER, &x, tokens.text);
    cell(columns.y, Align2::RIGHT_CENTER, &y, tokens.text);
    let weak = if tension == "balances" { tokens.weak } else { tokens.text };
    cell(columns.tension, Align2::LEFT_CENTER, &tension, weak);
    cell(columns.now, Align2::RIGHT_CENTER, &now, tokens.text);
    cell(columns.reel, Align2::RIGHT_CENTER, &reel, tokens.text);
    let more =
        "A click opens its numbers. Orange: the cable that the answer names. A dot: it has a material of its own.";
    if response.explained_at_rest(more).clicked() {
        session.cable = (!chosen).then_some(cable);
    }
}

/// The cable that the answer names.
fn blamed(facts: Facts<'_>) -> Option<usize> {
    let critical = || Some(facts.answers.last_critical()?.critical.as_ref()?.cable);
    facts.answers.failed().map_or_else(critical, |failed| failed.cable)
}

/// A cable's figures in words.
struct Figures {
    tension: String,
    now: String,
    reel: String,
}

impl Figures {
    fn of(scenario: &Scenario, facts: Facts<'_>, cable: usize) -> Self {
        const NONE: &str = "–";
        let failed = facts.answers.failed();
        let pushes = failed.filter(|failed| failed.cable == Some(cable) && failed.report.feasible == Some(false));
        let law = match scenario.cables[cable].tension {
            TensionLaw::Equilibrium => "balances",
            TensionLaw::Constant(_) => "constant",
            TensionLaw::Hypot { .. } => "by law",
        };
        let tension = if pushes.is_some() { "pushes" } else { law };
        let report = facts.answers.pose().and_then(|pose| pose.report.cables.get(cable));
        let now = match (report, pushes.and_then(|failed| failed.push), &scenario.cables[cable].tension) {
            (_, Some(push), _) => format!("−{}", newtons(push)),
            (Some(report), ..) => newtons(report.tension_at_platform),
            (None, None, TensionLaw::Equilibrium) => NONE.into(),
            (None, None, law) => newtons(law.at(scenario.motion.position)),
        };
        let reel = report.map_or_else(
            || NONE.to_owned(),
            |report| {
                let rate = report.length_rate * scenario.motion.speed;
                let size = number::rounded(rate.abs(), 2);
                if rate < 0.0 { format!("in {size}") } else { format!("out {size}") }
            },
        );
        Self { tension: tension.into(), now, reel }
    }
}

/// A force without its unit.
fn newtons(force: f64) -> String {
    number::rounded(force, if force.abs() < 1000.0 { 3 } else { 4 })
}

/// The numbers of one cable.
fn details(ui: &mut Ui, sheet: &mut EditedScenario<'_>, cable: usize) {
    rows(ui, sheet, &[Parameter::Anchor(cable, 0), Parameter::Anchor(cable, 1)]);
    let law = sheet.edited.cables[cable].tension;
    if law != TensionLaw::Equilibrium {
        #[derive(Clone, Copy, PartialEq)]
        enum Kind {
            Constant,
            Law,
        }
        let mut kind = if matches!(law, TensionLaw::Constant(_)) { Kind::Constant } else { Kind::Law };
        let tension = law.at(sheet.edited.motion.position);
        let all = [(Kind::Constant, "constant".to_owned()), (Kind::Law, "by law".to_owned())];
        ui.horizontal(|ui| {
            ui.label("Tension").explained(fields::LAW);
            if list(ui, &format!("Tension law of cable {}", cable + 1), &mut kind, &all, 84.0) {
                sheet.edited.cables[cable].tension = match kind {
                    Kind::Constant => TensionLaw::Constant(tension),
                    Kind::Law => TensionLaw::Hypot { horizontal: [tension, 0.0, 0.0], vertical: [0.0; 3] },
                };
            }
            ui.weak(format!("{tension:.1} N here"));
        });
        match sheet.edited.cables[cable].tension {
            TensionLaw::Constant(_) => rows(ui, sheet, &[Parameter::Tension(cable)]),
            _ => rows(ui, sheet, &fields::law(cable)),
        }
    }
    own_material(ui, sheet, cable);
    let reason = why_it_stays(&sheet.edited, cable);
    let name = format!("Remove cable {}", cable + 1);
    let button = ui.add_enabled(reason.is_none(), eframe::egui::Button::new(name));
    if button.grey_because(ui, reason.unwrap_or_default()).clicked() {
        sheet.edited.cables.remove(cable);
    }
}

/// What this cable is made of, where it is not what all are made of.
fn own_material(ui: &mut Ui, sheet: &mut EditedScenario<'_>, cable: usize) {
    let mut own = !sheet.edited.cables[cable].cable.is_empty();
    let meaning = "This cable has its own E, A, μ and strain law. Each begins with the value of all cables.";
    if ui.checkbox(&mut own, "Own material").explained(meaning).changed() {
        let Material { youngs_modulus, area, mass_per_length, strain } = sheet.edited.material_of(cable);
        sheet.edited.cables[cable].cable = if own {
            OwnMaterial {
                youngs_modulus: Some(youngs_modulus),
                area: Some(area),
                mass_per_length: Some(mass_per_length),
                strain: Some(strain),
            }
        } else {
            OwnMaterial::default()
        };
    }
    if !own {
        return;
    }
    ropes::ui(ui, sheet, Some(cable));
    rows(ui, sheet, &fields::own(cable));
    ui.horizontal(|ui| {
        ui.label("Strain").explained("Green: N = ½ EA (λ³ − λ). Engineering: N = EA (λ − 1).");
        let all = [
            (None, "as all".to_owned()),
            (Some(Strain::Green), "Green".to_owned()),
            (Some(Strain::Engineering), "engineering".to_owned()),
        ];
        let name = format!("Strain of cable {}", cable + 1);
        list(ui, &name, &mut sheet.edited.cables[cable].cable.strain, &all, 110.0);
    });
}

/// Width and height of the frame that the winches span; another one moves them all in proportion.
fn frame(ui: &mut Ui, sheet: &mut EditedScenario<'_>) {
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
            let control = Control { name, unit: Unit::of("m"), step: 0.01 * before, size: Vec2::new(64.0, 24.0) };
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
    Cable::new(anchor, TensionLaw::Constant(table::usual_tension(scenario)))
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
