//! The interface's own state: what is edited and how it is looked at.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::app::limits::LimitsAsked;
use crate::app::settings::Settings;
use crate::app::tour::Tour;
use crate::app::what_if::WhatIfView;
use crate::app::words::Word;
use crate::compute::protocol::{ModeChoice, Which};
use crate::scenario::{Parameter, Scenario};

/// Stands behind the name of a robot that differs from the one of that name.
const CHANGED: &str = ", changed";

/// What the user edits, with undo. Everything else on the screen follows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Always physical: an edit that is not is refused.
    pub scenario: Scenario,
    /// What values reset to: the scenario as it was opened.
    pub original: Scenario,
}

impl Document {
    /// A scenario as it has just been opened.
    pub fn opened(scenario: Scenario) -> Self {
        Self { original: scenario.clone(), scenario }
    }

    /// The same, where a robot that has been changed does not go by the name of the one that was opened, and one that is
    /// again as it was opened does. A name that somebody has given it stays. Where the robot stands, how it moves and
    /// where it flies is no change of the robot.
    pub fn called_rightly(mut self) -> Self {
        let Some(opened) = self.original.name.as_deref().filter(|name| !name.trim().is_empty()) else { return self };
        let changed = if opened.ends_with(CHANGED) { opened.to_owned() } else { format!("{opened}{CHANGED}") };
        let Some(name) = self.scenario.name.as_deref().filter(|name| *name == opened || *name == changed) else {
            return self;
        };
        let Scenario { name: named, motion, path, .. } = self.scenario.clone();
        let as_opened = Scenario { name: named, motion, path, ..self.original.clone() } == self.scenario;
        let right = if as_opened { opened } else { changed.as_str() };
        if name != right {
            self.scenario.name = Some(right.to_owned());
        }
        self
    }
}

/// The plots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Plot {
    /// Eigenvalues in the complex plane.
    #[default]
    Eigenvalues,
    /// Growth rate against speed.
    Growth,
    /// The table of modes.
    Modes,
    /// Critical speed and frequency along the motion.
    Line,
    /// Critical speed against direction.
    Directions,
    /// All eigenvalues against speed.
    Campbell,
    /// Critical speed against the mesh.
    Mesh,
    /// Sensitivities of the critical speed.
    Sensitivities,
    /// Critical speed against any number of the robot.
    WhatIf,
    /// Speed flown and local limits along the path.
    Path,
    /// Gain of the move against its peak speed.
    Gain,
    /// The platform off its path against time, in a flight.
    Deviation,
    /// Cable tensions against time, in a flight.
    Tensions,
}

/// What a plot is about: the tabs are grouped by this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlotGroup {
    /// A move along the path.
    Flight,
    /// The present pose.
    Pose,
    /// More than one pose or direction.
    Workspace,
    /// The robot and its model.
    Model,
}

impl PlotGroup {
    /// All groups with their names and plots.
    pub const ALL: [(Self, &'static str, &'static [Plot]); 4] = [
        (Self::Flight, "Flight", &[Plot::Deviation, Plot::Tensions, Plot::Gain, Plot::Path]),
        (Self::Pose, "This pose", &[Plot::Eigenvalues, Plot::Modes, Plot::Growth]),
        (Self::Workspace, "Workspace", &[Plot::Line, Plot::Directions]),
        (Self::Model, "Model", &[Plot::Campbell, Plot::Sensitivities, Plot::WhatIf, Plot::Mesh]),
    ];

    /// Its plots.
    pub fn plots(self) -> &'static [Plot] {
        Self::ALL.into_iter().find(|(group, ..)| *group == self).map_or(&[], |(_, _, plots)| plots)
    }
}

impl Plot {
    /// What the plot is about.
    pub fn group(self) -> PlotGroup {
        match self {
            Self::Eigenvalues | Self::Modes | Self::Growth => PlotGroup::Pose,
            Self::Line | Self::Directions => PlotGroup::Workspace,
            Self::Campbell | Self::Sensitivities | Self::WhatIf | Self::Mesh => PlotGroup::Model,
            Self::Path | Self::Deviation | Self::Tensions | Self::Gain => PlotGroup::Flight,
        }
    }

    /// What its tab says.
    pub fn title(self) -> &'static str {
        match self {
            Self::Eigenvalues => "Eigenvalues",
            Self::Modes => "Modes",
            Self::Growth => "Growth",
            Self::Line => "Along the line",
            Self::Directions => "Directions",
            Self::Campbell => "Speed diagram",
            Self::Sensitivities => "What to change",
            Self::WhatIf => "What if",
            Self::Mesh => "Mesh error",
            Self::Path => "Speed on the path",
            Self::Deviation => "Deviation",
            Self::Tensions => "Tensions",
            Self::Gain => "Gain",
        }
    }

    /// Its name in a link.
    pub fn name(self) -> &'static str {
        match self {
            Self::Eigenvalues => "eigenvalues",
            Self::Modes => "modes",
            Self::Growth => "growth",
            Self::Line => "line",
            Self::Directions => "directions",
            Self::Campbell => "speed",
            Self::Sensitivities => "change",
            Self::WhatIf => "whatif",
            Self::Mesh => "mesh",
            Self::Path => "path",
            Self::Deviation => "deviation",
            Self::Tensions => "tensions",
            Self::Gain => "gain",
        }
    }

    /// Those that can be under the robot: the ones on the way of the platform have its horizontal axis.
    pub const UNDER_THE_ROBOT: [Self; 3] = [Self::Path, Self::Line, Self::Directions];

    /// Whether it is about a way of the platform, so that it can share the robot's horizontal axis.
    pub fn is_along_a_way(self) -> bool {
        matches!(self, Self::Line | Self::Path)
    }

    /// All that can be opened.
    pub fn all() -> impl Iterator<Item = Self> {
        PlotGroup::ALL.into_iter().flat_map(|(_, _, plots)| plots.iter().copied())
    }
}

/// What the map under the robot shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum MapQuantity {
    /// The critical speed.
    #[default]
    Speed,
    /// The frequency at the critical speed.
    Frequency,
    /// Flutter or divergence.
    Kind,
    /// The responsible cable.
    Cable,
    /// The largest growth rate at the present speed.
    Growth,
    /// The wave limit.
    Waves,
}

/// The map under the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MapView {
    /// Whether it is switched on.
    pub on: bool,
    /// What it shows.
    pub quantity: MapQuantity,
    /// In the worst of 16 directions, rather than the motion's.
    pub worst: bool,
}

/// What a phone shows below the answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SheetTab {
    /// The motion.
    #[default]
    Move,
    /// All other numbers of the robot.
    Robot,
    /// Plots.
    Plots,
    /// What it all means.
    Explain,
}

impl SheetTab {
    /// All with their names.
    pub const ALL: [(Self, &'static str); 4] =
        [(Self::Move, "Move"), (Self::Robot, "Robot"), (Self::Plots, "Plots"), (Self::Explain, "Explain")];
}

/// Which panels are open, and how large a person has made them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[expect(clippy::struct_excessive_bools)] // One for each panel.
pub struct Panels {
    /// The controls on the left.
    pub left: bool,
    /// The same where there is too little room for a column of plots.
    pub left_where_narrow: bool,
    /// The plots on the right.
    pub right: bool,
    /// The plots under the robot.
    pub dock: bool,
    /// The widths of the panels on the left and on the right, in points; 0 where nobody has set them.
    pub widths: [f32; 2],
    /// The height of the dock, in points; 0 where nobody has set it.
    pub dock_height: f32,
}

impl Default for Panels {
    fn default() -> Self {
        Self { left: true, left_where_narrow: false, right: true, dock: true, widths: [0.0; 2], dock_height: 0.0 }
    }
}

/// The groups of controls, each open or folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
#[expect(clippy::struct_excessive_bools)] // One for each group; they know nothing of each other.
pub struct Sections {
    /// Speed, direction, position.
    pub motion: bool,
    /// Where the platform flies from its position.
    pub path: bool,
    /// The table of cables.
    pub cables: bool,
    /// The cables' material.
    pub rope: bool,
    /// Mass and gravity.
    pub platform: bool,
    /// Damping.
    pub damping: bool,
    /// Stiffness, strain, mesh.
    pub model: bool,
    /// Hints at unusual numbers.
    pub plausible: bool,
}

impl Default for Sections {
    fn default() -> Self {
        Self {
            motion: true,
            path: false,
            cables: true,
            rope: false,
            platform: false,
            damping: false,
            model: false,
            plausible: false,
        }
    }
}

/// How the document is looked at, as far as that survives a restart.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct UiState {
    /// The plot on the right; on a phone the only one.
    pub plot: Plot,
    /// The second plot on the right, where there is room for two.
    pub second: Plot,
    /// The plot under the robot.
    pub dock: Plot,
    /// What a phone shows.
    pub sheet: SheetTab,
    /// The mode shape's movement.
    pub playback: Playback,
    /// Which panels are open.
    #[serde(rename = "open_panels")]
    pub panels: Panels,
    /// Which groups of controls are open.
    pub sections: Sections,
    /// Whether the tour has been taken or skipped.
    pub tour_taken: bool,
    /// The map under the robot.
    pub map: MapView,
    /// Up to which frequency the Campbell diagram is drawn, in Hz.
    pub campbell_hz: f64,
    /// What the plot "What if" is asked; a restart begins anew.
    #[serde(skip)]
    pub what_if: WhatIfView,
    /// What the fastest allowed profile is asked.
    pub limits: LimitsAsked,
    /// What people choose once.
    pub settings: Settings,
}

/// How the document is looked at for the moment: a restart begins anew.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools)] // One switch each; they know nothing of each other.
pub struct Session {
    /// The mode whose shape is drawn.
    pub mode: ModeChoice,
    /// Whether the mode's frequency sounds as a tone; pages may not sound unasked.
    pub sound: bool,
    /// The tour, while it is on show.
    pub tour: Option<Tour>,
    /// The control to bring into view.
    pub revealed: Option<Parameter>,
    /// Whether winches can be dragged.
    pub unlocked: bool,
    /// The cable whose numbers are open in the table, 0-based.
    pub cable: Option<usize>,
    /// Whether every cable says its figures.
    pub labels: bool,
    /// The plot that has the place of the robot.
    pub large: Option<Plot>,
    /// Robot, answer and one plot alone, large.
    pub present: bool,
    /// The page is a frame in another page.
    pub embedded: bool,
    /// The word whose card is open.
    pub word: Option<Word>,
    /// The canvas's zoom and pan.
    pub camera: Camera,
    /// Windows over the page.
    pub windows: Windows,
}

impl Default for Session {
    fn default() -> Self {
        Self {
            mode: ModeChoice { which: Which::Present, along_x: false },
            sound: false,
            tour: None,
            revealed: None,
            unlocked: false,
            cable: None,
            labels: false,
            large: None,
            present: false,
            embedded: false,
            word: None,
            camera: Camera::default(),
            windows: Windows::default(),
        }
    }
}

/// Which windows are open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools)] // One switch each; they know nothing of each other.
pub struct Windows {
    /// The settings.
    pub settings: bool,
    /// The keyboard shortcuts.
    pub shortcuts: bool,
    /// The theory.
    pub theory: bool,
    /// The checks of theory, computed anew.
    pub validation: bool,
    /// The designs that are kept, and what differs.
    pub designs: bool,
    /// The fastest profile that machine and limits allow on the path.
    pub fastest: bool,
    /// Where the winches of a new robot are put.
    pub new_robot: bool,
}

impl UiState {
    /// The plot under a robot that has no room for more.
    pub fn presented(path: bool) -> Plot {
        if path { Plot::Path } else { Plot::Line }
    }

    /// The plot under a robot whose document has a path, or has none.
    pub fn dock_plot(&self, path: bool) -> Plot {
        match self.dock {
            Plot::Path if !path => Plot::Line,
            dock if Plot::UNDER_THE_ROBOT.contains(&dock) => dock,
            _ => Self::presented(path),
        }
    }
}

impl Default for UiState {
    fn default() -> Self {
        Self {
            plot: Plot::Eigenvalues,
            second: Plot::Directions,
            dock: Plot::Line,
            sheet: SheetTab::default(),
            playback: Playback::default(),
            panels: Panels::default(),
            sections: Sections::default(),
            tour_taken: false,
            map: MapView::default(),
            campbell_hz: 5.0,
            what_if: WhatIfView::default(),
            limits: LimitsAsked::default(),
            settings: Settings::default(),
        }
    }
}

/// What moves on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Movement {
    /// What a small disturbance becomes at the present speed: it dies out or grows.
    #[default]
    LetGo,
    /// One mode's shape, which swings for ever.
    Mode,
    /// The flight along the document's path; without a path, as if let go.
    Fly,
}

/// What moves on the canvas, and how.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct Playback {
    /// Whether time runs.
    pub playing: bool,
    /// What moves.
    pub movement: Movement,
    /// Seconds of the robot since it was let go; it begins anew by itself.
    #[serde(skip)]
    pub since: f64,
    /// The largest displacement on the screen, as a part of the robot's width.
    pub amplitude: f64,
    /// Seconds of the robot per second of the screen.
    pub slow_motion: f64,
    /// The oscillation's phase in radians.
    pub phase: f64,
}

impl Default for Playback {
    fn default() -> Self {
        Self { playing: true, movement: Movement::default(), since: 0.0, amplitude: 0.03, slow_motion: 1.0, phase: 0.0 }
    }
}

impl Playback {
    /// Phases in one oscillation when it is looked at step by step.
    const STEPS: f64 = 24.0;

    /// Stops, and goes on by this number of steps.
    pub fn step(&mut self, steps: f64) {
        self.playing = false;
        self.phase = (self.phase + steps * TAU / Self::STEPS).rem_euclid(TAU);
    }
}

/// The canvas's zoom and pan: identity shows the whole robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Magnification, 1 where the whole robot fits.
    pub zoom: f64,
    /// The world point in the middle of the canvas less the robot's middle, in m.
    pub offset: [f64; 2],
}

impl Default for Camera {
    fn default() -> Self {
        Self { zoom: 1.0, offset: [0.0, 0.0] }
    }
}

impl Camera {
    /// Zooms by a factor about the middle.
    pub fn magnify(&mut self, factor: f64) {
        self.zoom = (self.zoom * factor).clamp(0.2, 200.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Path, presets};

    #[test]
    fn a_changed_robot_does_not_go_by_the_name_of_the_one_that_was_opened() {
        let opened = || Document::opened(presets::PRESETS[0].scenario());
        let name = |document: Document| document.called_rightly().scenario.name.expect("a name");
        assert_eq!(name(opened()), "Paper robot");
        // Its pose and motion are not the robot.
        let mut moved = opened();
        moved.scenario.motion.position = [1.0, 0.5];
        moved.scenario.motion.speed = 1.0;
        moved.scenario.path = Some(Path::new(vec![[6.0, 0.0]], 5.0));
        assert_eq!(name(moved), "Paper robot");
        let mut changed = opened();
        changed.scenario.platform.mass = 3.0;
        let mut changed = changed.called_rightly();
        assert_eq!(name(changed.clone()), "Paper robot, changed");
        // As it was again.
        changed.scenario.platform.mass = changed.original.platform.mass;
        assert_eq!(name(changed.clone()), "Paper robot");
        // What somebody has typed stays as it is typed.
        changed.scenario.name = Some("Mine".into());
        assert_eq!(name(changed.clone()), "Mine");
        changed.scenario.platform.mass = 4.0;
        assert_eq!(name(changed.clone()), "Mine");
        // One that was opened as a changed one says it once.
        changed.scenario.name = Some("Paper robot, changed".into());
        let mut again = Document::opened(changed.scenario);
        again.scenario.platform.mass = 5.0;
        assert_eq!(name(again.clone()), "Paper robot, changed");
        again.original.name = None;
        again.scenario.name = None;
        assert_eq!(again.called_rightly().scenario.name, None);
    }

    #[test]
    fn every_plot_is_in_its_group() {
        // A plot that is missing here is named by the compiler.
        let place = |plot: Plot| match plot {
            Plot::Deviation => 0,
            Plot::Tensions => 1,
            Plot::Gain => 2,
            Plot::Path => 3,
            Plot::Eigenvalues => 4,
            Plot::Modes => 5,
            Plot::Growth => 6,
            Plot::Line => 7,
            Plot::Directions => 8,
            Plot::Campbell => 9,
            Plot::Sensitivities => 10,
            Plot::WhatIf => 11,
            Plot::Mesh => 12,
        };
        assert_eq!(Plot::all().map(place).collect::<Vec<_>>(), (0..13).collect::<Vec<_>>());
        for (group, _, plots) in PlotGroup::ALL {
            assert!(plots.iter().all(|plot| plot.group() == group), "{plots:?}");
        }
    }
}
