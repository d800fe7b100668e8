//! What a study depends on, and which studies are wanted.

use crate::app::state::{MapQuantity, Plot, UiState};
use crate::app::studies::varied::varied;
use crate::compute::protocol::Topic;
use crate::robot::{Damping, Linearisation, Robot};
use crate::scenario::Scenario;
use crate::scenario::json::Motion;
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::scenario::{Path, ProfileKind};
use crate::study::{Directions, Grid, Line, Mapped, Study, WhatIf, workspace};

/// About how many intervals a map has; spread so that they are as wide as they are high.
const MAP_INTERVALS: f64 = 800.0;
/// A map's least and most points in a row or column.
const MAP_POINTS: [f64; 2] = [5.0, 161.0];
/// The border of the feasible region is looked for up to this part of the workspace's size from its edge.
const INSET: f64 = 1e-3;
/// Places along the line.
const LINE_POINTS: usize = 161;
/// Directions of the polar diagram.
const DIRECTIONS: usize = 72;
/// Speeds of the Campbell diagram.
const SPEEDS: usize = 81;
/// Meshes of the convergence study; today's joins them.
const MESHES: [usize; 10] = [4, 6, 8, 10, 14, 20, 28, 40, 56, 80];
/// Elements per cable of the finest mesh that tells which digits are certain: coarser ones may show another mode, finer
/// ones take long.
const FINE: [usize; 2] = [40, 80];
/// Stands where the number of elements does not matter.
const ANY_ELEMENTS: usize = 10;
/// Stands for the motion, which does not matter: a study has its own poses, directions and speeds.
const ANY_MOTION: Motion = Motion { position: [0.0, 0.0], direction: [1.0, 0.0], speed: 0.0 };

/// A study and all that its answers depend on, and nothing else: two requests that are equal have the same answers.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyRequest {
    /// The scenario; what the study does not look at has a fixed value.
    pub scenario: Scenario,
    /// The study.
    pub study: Study,
}

impl StudyRequest {
    /// `study` of the robot of `scenario`.
    pub fn new(scenario: &Scenario, study: Study) -> Self {
        let path = path_for(scenario, study.topic());
        // A path begins where the platform is.
        let position = if path.is_some() { scenario.motion.position } else { ANY_MOTION.position };
        let motion = Motion { position, ..ANY_MOTION };
        let mut scenario = Scenario { name: None, motion, path, ..scenario.clone() };
        // Flights are those of the tangent stiffness, whatever the robot's.
        if matches!(study, Study::Flight { .. }) {
            scenario.linearisation = Linearisation::Tangent;
        }
        if matches!(study, Study::Mesh { .. }) {
            scenario.elements_per_cable = ANY_ELEMENTS;
        }
        // Statics know nothing of what moves.
        if matches!(study, Study::Border { .. }) {
            scenario.damping = Damping { alpha: 0.0, beta: 0.0 };
            scenario.linearisation = Linearisation::Secant;
        }
        Self { scenario, study }
    }

    /// The critical speed of `scenario` on meshes with these numbers of elements per cable; `None` where it is not physical.
    pub fn meshes(scenario: &Scenario, counts: Vec<usize>) -> Option<Self> {
        let (_, motion) = scenario.to_robot().ok()?;
        let (position, direction) = (motion.position(), motion.direction());
        Some(Self::new(scenario, Study::Mesh { position, direction, counts, limit: DEFAULT_MAX_SPEED }))
    }

    /// What it is about.
    pub fn topic(&self) -> Topic {
        self.study.topic()
    }

    /// How many answers give a first picture of it: of a map every fourth point of every fourth row. A border with gaps is
    /// none.
    pub fn first_picture(&self) -> usize {
        match &self.study {
            Study::Map { grid, .. } => grid.nx.div_ceil(4) * grid.ny.div_ceil(4),
            Study::Border { grid } => grid.ny,
            Study::WhatIf(WhatIf { numbers, .. }) if numbers.len() > 1 => {
                numbers.iter().map(|number| number.values.len().div_ceil(4)).product()
            }
            study => study.len().div_ceil(4),
        }
    }
}

/// The path as far as a study of this topic depends on it.
fn path_for(scenario: &Scenario, topic: Topic) -> Option<Path> {
    let path = scenario.path.clone();
    match topic {
        // Where it leads, and not how fast.
        Topic::Path => path.map(|path| Path {
            profile: ProfileKind::Quintic,
            speed: 1.0,
            acceleration: 1.0,
            jerk: 1.0,
            hold: 0.0,
            ..path
        }),
        // The study has its own speeds.
        Topic::Gains => path.map(|path| Path { speed: 1.0, hold: 0.0, ..path }),
        Topic::Move | Topic::Allowed => path.map(|path| Path { hold: 0.0, ..path }),
        Topic::Flight => path,
        _ => None,
    }
}

/// The border of the feasible region, which whoever drags out of it wants to see at once, and the studies of what is open:
/// the map where it is switched on, and those of the plots on show, of each topic one; where nothing is under way that
/// could be disturbed, `at_rest`, also which digits of the critical speed are certain. `critical` is the last critical
/// speed known, in m/s.
pub fn wanted(
    scenario: &Scenario,
    state: &UiState,
    plots: &[Plot],
    critical: Option<f64>,
    at_rest: bool,
) -> Vec<StudyRequest> {
    let Ok((robot, motion)) = scenario.to_robot() else { return Vec::new() };
    let (position, direction) = (motion.position(), motion.direction());
    let limit = DEFAULT_MAX_SPEED;
    let [nx, ny] = map_points(&robot);
    let grid = Grid::of(&robot, nx, ny);
    let mut requests = vec![StudyRequest::new(scenario, Study::Border { grid: within(grid) })];
    if state.map.on {
        let directions =
            if state.map.worst { Directions::Worst(Directions::WORST_OF) } else { Directions::One(direction) };
        let mapped = match state.map.quantity {
            MapQuantity::Growth => Mapped::Growth { speed: motion.speed() },
            _ => Mapped::Critical { limit },
        };
        requests.push(StudyRequest::new(scenario, Study::Map { grid, directions, mapped }));
    }
    let shows = |list: &[Plot]| list.iter().any(|plot| plots.contains(plot));
    if shows(&[Plot::Line]) {
        requests.push(StudyRequest::new(
            scenario,
            Study::Line { line: Line::through(&robot, &motion, LINE_POINTS), limit },
        ));
    }
    if shows(&[Plot::Directions]) {
        requests.push(StudyRequest::new(scenario, Study::Directions { position, count: DIRECTIONS, limit }));
    }
    // Eigenvalues leave traces from rest on.
    if shows(&[Plot::Campbell, Plot::Eigenvalues]) {
        let to = highest_speed(motion.speed(), critical);
        requests.push(StudyRequest::new(scenario, Study::Campbell { position, direction, to, count: SPEEDS }));
    }
    if shows(&[Plot::WhatIf]) {
        let studies = varied(scenario, &state.what_if).into_iter();
        requests.extend(studies.map(|(scenario, study)| StudyRequest { scenario, study }));
    }
    let meshes = if shows(&[Plot::Mesh]) {
        Some(meshes(scenario.elements_per_cable))
    } else {
        (at_rest && critical.is_some()).then(|| fine(scenario.elements_per_cable))
    };
    requests.extend(meshes.and_then(|counts| StudyRequest::meshes(scenario, counts)));
    requests
}

/// The meshes that tell which digits of the critical speed are certain: three, each with twice the elements of the one
/// before, the finest with four times today's where that is not much work.
fn fine(today: usize) -> Vec<usize> {
    let quarter = (4 * today).clamp(FINE[0], FINE[1]) / 4;
    vec![quarter, 2 * quarter, 4 * quarter]
}

/// The grid a little smaller. On the very edge of the workspace some cables lie in one line, so that nothing there is
/// feasible: the border would cut the corners of the region.
fn within(grid: Grid) -> Grid {
    let inset = INSET * (grid.high - grid.low);
    Grid { low: grid.low + inset, high: grid.high - inset, ..grid }
}

/// Points of a map in a row and in a column.
fn map_points(robot: &Robot) -> [usize; 2] {
    let [low, high] = workspace(robot);
    let size = high - low;
    let side = (size.x * size.y / MAP_INTERVALS).sqrt();
    [size.x, size.y].map(|length| {
        let [least, most] = MAP_POINTS;
        // Clamped to small numbers; a quotient that is none becomes the least.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let points = ((length / side).round() + 1.0).clamp(least, most) as usize;
        points.max(5)
    })
}

/// Where the Campbell diagram ends, in m/s: beyond both speeds, and round, so that it seldom changes.
fn highest_speed(today: f64, critical: Option<f64>) -> f64 {
    let beyond = 1.2 * today.max(critical.unwrap_or(0.0));
    (5.0 * (beyond / 5.0).ceil()).max(5.0)
}

/// The meshes of the convergence study, from the coarsest on.
fn meshes(today: usize) -> Vec<usize> {
    let mut counts = MESHES.to_vec();
    if let Err(place) = counts.binary_search(&today) {
        counts.insert(place, today);
    }
    counts
}

#[cfg(test)]
mod tests {
    // Round numbers.
    #![expect(clippy::float_cmp)]

    use super::*;
    use crate::scenario::presets;

    fn state(map: bool, plot: Plot) -> UiState {
        let mut state = UiState { plot, ..UiState::default() };
        state.map.on = map;
        state
    }

    /// Whether the request for `plot`, or for the map, changes when `edit` is made.
    fn changes(state: &UiState, edit: impl Fn(&mut Scenario)) -> bool {
        let before = presets::PRESETS[0].scenario();
        let mut after = before.clone();
        edit(&mut after);
        let request = |scenario| wanted(scenario, state, &[state.plot], Some(11.3), false).pop();
        request(&before) != request(&after)
    }

    #[test]
    fn only_what_is_open_is_wanted() {
        let paper = presets::PRESETS[0].scenario();
        let topics = |state: &UiState, plots: &[Plot]| -> Vec<Topic> {
            wanted(&paper, state, plots, None, true).iter().map(StudyRequest::topic).collect()
        };
        let border = Topic::Border;
        assert_eq!(topics(&state(false, Plot::Modes), &[Plot::Modes]), [border]);
        assert_eq!(topics(&state(true, Plot::Mesh), &[Plot::Mesh]), [border, Topic::Map, Topic::Mesh]);
        // All plots on show, each topic once: eigenvalues leave the traces that the speed diagram is made of.
        let all: Vec<Plot> = Plot::all().chain([Plot::Line]).collect();
        let of_all = [border, Topic::Line, Topic::Directions, Topic::Campbell, Topic::Mesh];
        assert_eq!(topics(&state(false, Plot::Modes), &all), of_all);
        assert_eq!(topics(&state(false, Plot::Modes), &[Plot::Eigenvalues]), [border, Topic::Campbell]);
        // At rest, also which digits are certain, unless the plot of meshes says so.
        let at_rest = |plot, critical, at_rest| -> Vec<StudyRequest> {
            wanted(&paper, &state(false, Plot::Modes), &[plot], critical, at_rest).split_off(1)
        };
        let meshes = |requests: Vec<StudyRequest>| match &requests[..] {
            [StudyRequest { study: Study::Mesh { counts, .. }, .. }] => counts.clone(),
            other => panic!("{other:?}"),
        };
        assert_eq!(meshes(at_rest(Plot::Modes, Some(11.3), true)), [10, 20, 40]);
        assert_eq!(meshes(at_rest(Plot::Mesh, Some(11.3), true)).len(), MESHES.len());
        assert!(at_rest(Plot::Modes, Some(11.3), false).is_empty(), "a drag is not disturbed");
        assert!(at_rest(Plot::Modes, None, true).is_empty(), "there is nothing to be certain of");
        assert_eq!(at_rest(Plot::Line, Some(11.3), true).len(), 2);
        for (n, finest) in [(2, 40), (10, 40), (15, 60), (20, 80), (200, 80)] {
            assert_eq!(fine(n), [finest / 4, finest / 2, finest]);
        }
        // On a phone the plots may be hidden.
        assert_eq!(topics(&state(true, Plot::Mesh), &[]), [border, Topic::Map]);
    }

    #[test]
    fn the_border_depends_on_the_robot_alone() {
        let nothing = state(false, Plot::Modes);
        let others: [fn(&mut Scenario); 5] = [
            |s| s.motion.position = [3.0, 1.0],
            |s| s.motion.direction = [0.0, 1.0],
            |s| s.motion.speed = 9.0,
            |s| s.damping.alpha *= 2.0,
            |s| s.linearisation = Linearisation::Tangent,
        ];
        assert_eq!(others.map(|edit| changes(&nothing, edit)), [false; 5]);
        assert!(changes(&nothing, |s| s.platform.mass *= 2.0));
        assert!(changes(&nothing, |s| s.cables[0].anchor[0] -= 1.0));
    }

    #[test]
    fn a_map_depends_on_neither_pose_nor_speed() {
        let mut map = state(true, Plot::Modes);
        let everything: [fn(&mut Scenario); 4] = [
            |s| s.motion.position = [3.0, 1.0],
            |s| s.motion.speed = 9.0,
            |s| s.motion.direction = [0.0, 1.0],
            |s| s.cable.youngs_modulus *= 2.0,
        ];
        let dependence = |state: &UiState| everything.map(|edit| changes(state, edit));
        assert_eq!(dependence(&map), [false, false, true, true]);
        map.map.worst = true;
        assert_eq!(dependence(&map), [false, false, false, true]);
        map.map.quantity = MapQuantity::Growth;
        assert_eq!(dependence(&map), [false, true, false, true]);
        // One study answers these.
        let paper = presets::PRESETS[0].scenario();
        let request = |quantity| {
            let mut state = state(true, Plot::Modes);
            state.map.quantity = quantity;
            wanted(&paper, &state, &[], None, true)
        };
        for quantity in [MapQuantity::Frequency, MapQuantity::Kind, MapQuantity::Cable, MapQuantity::Waves] {
            assert_eq!(request(quantity), request(MapQuantity::Speed));
        }
    }

    #[test]
    fn a_line_depends_on_what_is_across_it() {
        let line = state(false, Plot::Line);
        assert!(!changes(&line, |s| s.motion.position = [3.0, 0.0]));
        assert!(!changes(&line, |s| s.motion.direction = [2.0, 0.0]));
        assert!(changes(&line, |s| s.motion.position = [3.0, 0.5]));
        assert!(changes(&line, |s| s.motion.position = [30.0, 0.0]));
        assert!(changes(&line, |s| s.motion.direction = [-1.0, 0.0]));
        assert!(!changes(&line, |s| s.motion.speed = 1.0));
    }

    #[test]
    fn the_other_studies_depend_on_the_pose() {
        for (plot, on_direction) in [(Plot::Directions, false), (Plot::Campbell, true), (Plot::Mesh, true)] {
            let open = state(false, plot);
            assert!(changes(&open, |s| s.motion.position = [3.0, 0.0]));
            assert_eq!(changes(&open, |s| s.motion.direction = [0.0, 1.0]), on_direction, "{plot:?}");
            assert!(!changes(&open, |s| s.motion.speed = 1.0));
        }
        // Another mesh changes the convergence study only where it is not among those looked at.
        let mesh = state(false, Plot::Mesh);
        assert!(!changes(&mesh, |s| s.elements_per_cable = 20));
        assert!(changes(&mesh, |s| s.elements_per_cable = 12));
        assert_eq!(meshes(12)[..6], [4, 6, 8, 10, 12, 14]);
    }

    #[test]
    fn sizes_fit_the_workspace() {
        let (robot, _) = presets::PRESETS[0].scenario().to_robot().expect("physical");
        assert_eq!(map_points(&robot), [41, 21]);
        assert_eq!(
            [highest_speed(5.0, Some(11.3)), highest_speed(0.0, None), highest_speed(30.0, None)],
            [15.0, 5.0, 40.0]
        );
    }
}
