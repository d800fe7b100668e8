//! Where everything is on the screen: pure geometry, from the window's size and from what is open.

use eframe::egui::{Pos2, Rect, Vec2};

use crate::app::state::Panels;

/// The form that the screen takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Controls, robot, and a column of plots.
    Wide,
    /// Controls and robot; all plots are in the dock.
    Middle,
    /// A tablet held upright: below the robot, controls and plots side by side.
    Portrait,
    /// A phone held upright: one column.
    Phone,
    /// A low window, such as a phone held across: robot and one sheet.
    Low,
    /// A small frame in another page: answer, robot, one row.
    Frame,
    /// Presentation: answer, robot, the plot under it.
    Present,
}

impl Form {
    /// The form of a window of this size in points.
    pub fn of(size: Vec2, embedded: bool, present: bool) -> Self {
        if embedded && size.x < 640.0 {
            Self::Frame
        } else if size.y < 480.0 {
            Self::Low
        } else if size.x < 760.0 {
            Self::Phone
        } else if present {
            Self::Present
        } else if size.x >= 1200.0 {
            Self::Wide
        } else if size.y > size.x {
            Self::Portrait
        } else {
            Self::Middle
        }
    }

    /// Whether everything is sized for fingers.
    pub fn is_touch(self) -> bool {
        matches!(self, Self::Portrait | Self::Phone | Self::Low)
    }
}

/// Where the parts of the screen are; a part that is not there has no place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrangement {
    /// The form.
    pub form: Form,
    /// The bar at the top.
    pub bar: Option<Rect>,
    /// The controls on the left; below the robot where the form is upright.
    pub controls: Option<Rect>,
    /// The robot.
    pub canvas: Rect,
    /// The strip of the study along the line, under the robot.
    pub strip: Option<Rect>,
    /// The plots under the robot.
    pub dock: Option<Rect>,
    /// What moves, and how.
    pub transport: Option<Rect>,
    /// The plots on the right, or beside the controls.
    pub plots: Option<Rect>,
    /// The second plot on the right.
    pub second: Option<Rect>,
    /// The answer in one line.
    pub line: Option<Rect>,
    /// The sheet with its tabs.
    pub sheet: Option<Rect>,
    /// The column with the answer of a presentation.
    pub column: Option<Rect>,
}

/// The least width of the robot between two panels, in points.
const LEAST_CANVAS: f32 = 320.0;
/// The least and the most of what a person can make of a side panel.
const SIDE: [f32; 2] = [240.0, 900.0];
/// The least height of the dock.
const LEAST_DOCK: f32 = 150.0;
/// The robot with what is under it takes at least this part of the window.
const SHARE: f32 = 0.505;

/// The height of the transport.
fn transport_height(form: Form) -> f32 {
    if form == Form::Portrait { 52.0 } else { 44.0 }
}

/// Arranges a window of this size, in points.
pub fn arrange(window: Rect, panels: Panels, embedded: bool, present: bool, coarse: bool) -> Arrangement {
    let size = window.size();
    let form = Form::of(size, embedded, present);
    let mut arrangement = Arrangement {
        form,
        bar: None,
        controls: None,
        canvas: window,
        strip: None,
        dock: None,
        transport: None,
        plots: None,
        second: None,
        line: None,
        sheet: None,
        column: None,
    };
    let mut rest = window;
    match form {
        Form::Present => {
            let width = (0.31 * size.x).clamp(240.0, 520.0);
            arrangement.column = Some(cut_left(&mut rest, width));
            arrangement.dock = Some(cut_bottom(&mut rest, (0.36 * size.y).floor()));
        }
        Form::Frame => {
            arrangement.bar = Some(cut_top(&mut rest, 44.0));
            arrangement.transport = Some(cut_bottom(&mut rest, 44.0));
        }
        Form::Low => {
            arrangement.bar = Some(cut_top(&mut rest, 44.0));
            let canvas = cut_left(&mut rest, (0.57 * size.x).floor());
            arrangement.sheet = Some(rest);
            rest = canvas;
        }
        Form::Phone => {
            arrangement.bar = Some(cut_top(&mut rest, 48.0));
            let mut upper = cut_top(&mut rest, (0.455 * size.y).ceil());
            arrangement.strip = Some(cut_bottom(&mut upper, (0.11 * size.y).clamp(64.0, 120.0)));
            arrangement.line = Some(cut_top(&mut rest, 44.0));
            arrangement.sheet = Some(rest);
            rest = upper;
        }
        Form::Portrait => {
            arrangement.bar = Some(cut_top(&mut rest, 48.0));
            let mut lower = rest;
            rest = cut_top(&mut lower, (0.512 * size.y).floor());
            arrangement.transport = Some(cut_top(&mut lower, transport_height(form)));
            arrangement.controls = Some(cut_left(&mut lower, 324.0));
            arrangement.plots = Some(lower);
        }
        Form::Wide | Form::Middle => {
            arrangement.bar = Some(cut_top(&mut rest, if coarse { 48.0 } else { 40.0 }));
            let [left, right] = widths(size, rest.height(), form, panels);
            arrangement.controls = (left > 0.0).then(|| cut_left(&mut rest, left));
            arrangement.plots = (right > 0.0).then(|| cut_right(&mut rest, right));
            if size.x >= 1600.0
                && let Some(plots) = &mut arrangement.plots
            {
                arrangement.second = Some(cut_bottom(plots, (0.5 * plots.height()).floor()));
            }
            arrangement.transport = Some(cut_bottom(&mut rest, transport_height(form)));
            if panels.dock {
                let usual = if form == Form::Wide { 0.25 } else { 0.36 } * size.y;
                let height = if panels.dock_height > 0.0 { panels.dock_height } else { usual.max(204.0) };
                let most = (0.6 * rest.height()).max(LEAST_DOCK);
                arrangement.dock = Some(cut_bottom(&mut rest, height.clamp(LEAST_DOCK, most).floor()));
            }
        }
    }
    arrangement.canvas = rest;
    arrangement
}

/// The widths of the panels on the left and on the right; 0 where one is folded.
fn widths(size: Vec2, height: f32, form: Form, panels: Panels) -> [f32; 2] {
    let set = |set: f32, usual: f32| if set > 0.0 && set.is_finite() { set.clamp(SIDE[0], SIDE[1]) } else { usual };
    let wide = size.x >= 1600.0;
    let open = if form == Form::Wide { panels.left } else { panels.left_where_narrow };
    let usual_left = if wide { 320.0 } else { 272.0 };
    let left = if open { set(panels.widths[0], usual_left) } else { 0.0 };
    // The robot with what is under it keeps half of the window, unless a person wants a panel larger. That of one panel
    // changes nothing of the other.
    let room = size.x - usual_left - SHARE * size.x * size.y / height;
    let usual = if size.x >= 2600.0 {
        0.24 * size.x
    } else if wide {
        560.0
    } else {
        288.0
    };
    let usual = usual.min(room.max(SIDE[0])).floor();
    let right = if form == Form::Wide && panels.right { set(panels.widths[1], usual) } else { 0.0 };
    let left = left.min((size.x - LEAST_CANVAS - right).max(SIDE[0].min(left)));
    let right = right.min((size.x - LEAST_CANVAS - left).max(SIDE[0].min(right)));
    [left, right]
}

fn cut_top(rest: &mut Rect, height: f32) -> Rect {
    let (cut, left) = rest.split_top_bottom_at_y((rest.min.y + height).min(rest.max.y));
    *rest = left;
    cut
}

fn cut_bottom(rest: &mut Rect, height: f32) -> Rect {
    let (left, cut) = rest.split_top_bottom_at_y((rest.max.y - height).max(rest.min.y));
    *rest = left;
    cut
}

fn cut_left(rest: &mut Rect, width: f32) -> Rect {
    let (cut, left) = rest.split_left_right_at_x((rest.min.x + width).min(rest.max.x));
    *rest = left;
    cut
}

fn cut_right(rest: &mut Rect, width: f32) -> Rect {
    let (left, cut) = rest.split_left_right_at_x((rest.max.x - width).max(rest.min.x));
    *rest = left;
    cut
}

/// The edges that a person can drag: of the controls, of the plots, of the dock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Between controls and robot.
    Left,
    /// Between robot and plots.
    Right,
    /// Between robot and dock.
    Dock,
}

impl Arrangement {
    /// The edges that can be dragged, with their names and the ground on which they can be grabbed.
    pub fn edges(&self) -> impl Iterator<Item = (Edge, &'static str, Rect)> {
        const REACH: f32 = 4.0;
        let movable = matches!(self.form, Form::Wide | Form::Middle);
        let upright = |x: f32, of: Rect| Rect::from_x_y_ranges(x - REACH..=x + REACH, of.y_range());
        let level = |of: Rect| Rect::from_x_y_ranges(of.x_range(), of.min.y - REACH..=of.min.y + REACH);
        let right = self.plots.map(|plots| self.second.map_or(plots, |second| plots.union(second)));
        let edges = [
            self.controls.map(|of| (Edge::Left, "Resize the controls", upright(of.max.x, of))),
            right.map(|of| (Edge::Right, "Resize the plots", upright(of.min.x, of))),
            self.dock.map(|of| (Edge::Dock, "Resize the dock", level(of))),
        ];
        edges.into_iter().flatten().filter(move |_| movable)
    }

    /// What a panel is to be when its edge is dragged to a place.
    pub fn resize(&self, panels: &mut Panels, edge: Edge, to: Pos2, window: Rect) {
        // Neither pushes the other one.
        let most = |other: Option<Rect>| {
            (window.width() - LEAST_CANVAS - other.map_or(0.0, |other| other.width())).clamp(SIDE[0], SIDE[1])
        };
        match edge {
            Edge::Left => panels.widths[0] = (to.x - window.min.x).clamp(SIDE[0], most(self.plots)),
            Edge::Right => panels.widths[1] = (window.max.x - to.x).clamp(SIDE[0], most(self.controls)),
            Edge::Dock => {
                let bottom = self.dock.map_or(window.max.y, |dock| dock.max.y);
                panels.dock_height = (bottom - to.y).max(LEAST_DOCK);
            }
        }
    }

    /// The robot with what is under it.
    pub fn centre(&self) -> Rect {
        [self.strip, self.dock, self.transport.filter(|_| self.form != Form::Frame)]
            .into_iter()
            .flatten()
            .fold(self.canvas, Rect::union)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arrangement(width: f32, height: f32, panels: Panels) -> Arrangement {
        arrange(Rect::from_min_size(Pos2::ZERO, Vec2::new(width, height)), panels, false, false, false)
    }

    fn all(arrangement: &Arrangement) -> Vec<(&'static str, Rect)> {
        let named = [
            ("bar", arrangement.bar),
            ("controls", arrangement.controls),
            ("canvas", Some(arrangement.canvas)),
            ("strip", arrangement.strip),
            ("dock", arrangement.dock),
            ("transport", arrangement.transport),
            ("plots", arrangement.plots),
            ("second", arrangement.second),
            ("line", arrangement.line),
            ("sheet", arrangement.sheet),
            ("column", arrangement.column),
        ];
        named.into_iter().filter_map(|(name, rect)| Some((name, rect?))).collect()
    }

    #[test]
    fn parts_fill_the_window_without_overlap() {
        for (width, height) in [
            (320.0, 640.0),
            (360.0, 740.0),
            (740.0, 360.0),
            (768.0, 1024.0),
            (1024.0, 768.0),
            (1199.0, 700.0),
            (1200.0, 600.0),
            (1280.0, 720.0),
            (1280.0, 800.0),
            (1600.0, 900.0),
            (1920.0, 1080.0),
            (3840.0, 2160.0),
        ] {
            for (embedded, present) in [(false, false), (true, false), (false, true)] {
                let window = Rect::from_min_size(Pos2::ZERO, Vec2::new(width, height));
                let arrangement = arrange(window, Panels::default(), embedded, present, false);
                let all = all(&arrangement);
                let area: f32 = all.iter().map(|(_, rect)| rect.area()).sum();
                assert!((area / window.area() - 1.0).abs() < 1e-4, "{width} × {height}: {all:?}");
                for (name, rect) in &all {
                    assert!(rect.width() >= 100.0 && rect.height() >= 40.0, "{width} × {height}: {name} {rect:?}");
                    assert!(window.contains_rect(*rect), "{width} × {height}: {name} {rect:?}");
                }
            }
        }
    }

    #[test]
    fn the_robot_has_its_share_of_every_window() {
        let share = |rect: Rect, width: f32, height: f32| rect.area() / (width * height);
        let wide = [
            (768.0, 1024.0),
            (1024.0, 768.0),
            (1200.0, 800.0),
            (1280.0, 720.0),
            (1280.0, 800.0),
            (1599.0, 900.0),
            (1600.0, 900.0),
            (1920.0, 1080.0),
            (3840.0, 2160.0),
        ];
        for (width, height) in wide {
            let arrangement = arrangement(width, height, Panels::default());
            assert!(share(arrangement.centre(), width, height) >= 0.5, "{width} × {height}: {arrangement:?}");
        }
        let desktop = arrangement(1280.0, 800.0, Panels::default());
        assert!(share(desktop.canvas, 1280.0, 800.0) >= 0.36, "{desktop:?}");
        for (width, height) in [(320.0, 640.0), (360.0, 740.0), (600.0, 900.0)] {
            let arrangement = arrangement(width, height, Panels::default());
            assert!(share(arrangement.centre(), width, height) >= 0.45, "{width} × {height}: {arrangement:?}");
        }
        let low = arrangement(740.0, 360.0, Panels::default());
        assert!(low.canvas.width() >= 0.56 * 740.0, "{low:?}");
    }

    #[test]
    fn folded_panels_leave_their_room_to_the_robot() {
        let folded = Panels { left: false, right: false, dock: false, ..Panels::default() };
        let arrangement = arrangement(1280.0, 800.0, folded);
        assert_eq!(arrangement.canvas, Rect::from_min_max(Pos2::new(0.0, 40.0), Pos2::new(1280.0, 756.0)));
    }

    #[test]
    fn an_edge_goes_where_it_is_dragged_and_the_robot_keeps_some_room() {
        let window = Rect::from_min_size(Pos2::ZERO, Vec2::new(1280.0, 800.0));
        let mut panels = Panels::default();
        arrangement(1280.0, 800.0, panels).resize(&mut panels, Edge::Left, Pos2::new(300.0, 400.0), window);
        assert_eq!(arrangement(1280.0, 800.0, panels).controls.map(|rect| rect.width()), Some(300.0));
        for (edge, to) in [(Edge::Right, Pos2::ZERO), (Edge::Left, Pos2::new(1280.0, 0.0)), (Edge::Dock, Pos2::ZERO)] {
            arrangement(1280.0, 800.0, panels).resize(&mut panels, edge, to, window);
        }
        let canvas = arrangement(1280.0, 800.0, panels).canvas;
        assert!(canvas.width() >= LEAST_CANVAS - 1.0 && canvas.height() > 200.0, "{canvas:?}");
    }
}
