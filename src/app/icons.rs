//! Small pictures on buttons, painted as lines, and the buttons that carry them.

use eframe::egui::{
    Align2, Color32, CornerRadius, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind, TextStyle,
    Ui, Vec2, WidgetInfo, WidgetText,
};

use crate::app::theme;

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// A panel at the left.
    PanelLeft,
    /// A panel at the foot.
    PanelBottom,
    /// A panel at the right.
    PanelRight,
    /// Back.
    Undo,
    /// Forward.
    Redo,
    /// A folded map.
    Map,
    /// A pin.
    Pin,
    /// An arrow out of a box.
    Share,
    /// A screen.
    Present,
    /// Three dots.
    More,
    /// Four corners.
    Fit,
    /// Nothing: words stand alone.
    None,
    /// Two arrows that part.
    Enlarge,
    /// Two arrows that meet.
    Shrink,
    /// Runs.
    Play,
    /// Stops.
    Pause,
    /// Down.
    ChevronDown,
    /// To the right.
    ChevronRight,
    /// Up.
    ChevronUp,
    /// A cross.
    Close,
    /// A loudspeaker.
    Sound,
    /// To the left.
    ArrowLeft,
    /// Up.
    ArrowUp,
    /// A house: the pose that the robot was opened with.
    Home,
    /// Turned round.
    Turn,
    /// Out of a frame, to a page of its own.
    Open,
    /// More.
    Plus,
    /// Less.
    Minus,
    /// Back to what it was.
    Reset,
}

/// Lines of the pictures on a square from 0 to 16, y down.
#[expect(clippy::too_many_lines)] // One arm for each picture.
fn lines(icon: Icon) -> &'static [&'static [[f32; 2]]] {
    match icon {
        Icon::PanelLeft => &[BOX, &[[6.0, 3.0], [6.0, 13.0]]],
        Icon::PanelRight => &[BOX, &[[10.0, 3.0], [10.0, 13.0]]],
        Icon::PanelBottom => &[BOX, &[[2.0, 9.5], [14.0, 9.5]]],
        Icon::Undo => &[
            &[[6.0, 2.5], [2.5, 6.0], [6.0, 9.5]],
            &[[2.5, 6.0], [9.5, 6.0], [12.0, 6.8], [13.3, 8.6], [13.5, 10.2], [12.8, 12.0], [11.0, 13.5], [6.5, 13.5]],
        ],
        Icon::Redo => &[
            &[[10.0, 2.5], [13.5, 6.0], [10.0, 9.5]],
            &[[13.5, 6.0], [6.5, 6.0], [4.0, 6.8], [2.7, 8.6], [2.5, 10.2], [3.2, 12.0], [5.0, 13.5], [9.5, 13.5]],
        ],
        Icon::Map => &[
            &[
                [1.5, 4.0],
                [5.8, 2.3],
                [10.2, 4.0],
                [14.5, 2.3],
                [14.5, 12.0],
                [10.2, 13.7],
                [5.8, 12.0],
                [1.5, 13.7],
                [1.5, 4.0],
            ],
            &[[5.8, 2.3], [5.8, 12.0]],
            &[[10.2, 4.0], [10.2, 13.7]],
        ],
        Icon::Pin => &[
            &[[5.0, 2.0], [11.0, 2.0]],
            &[[6.0, 2.0], [6.0, 6.5], [3.5, 9.5], [12.5, 9.5], [10.0, 6.5], [10.0, 2.0]],
            &[[8.0, 9.5], [8.0, 14.5]],
        ],
        Icon::Share => &[
            &[[3.0, 8.0], [3.0, 14.0], [13.0, 14.0], [13.0, 8.0]],
            &[[8.0, 10.0], [8.0, 1.8]],
            &[[5.0, 4.6], [8.0, 1.8], [11.0, 4.6]],
        ],
        Icon::Present => &[
            &[[1.5, 2.5], [14.5, 2.5], [14.5, 11.0], [1.5, 11.0], [1.5, 2.5]],
            &[[8.0, 11.0], [8.0, 14.0]],
            &[[5.0, 14.0], [11.0, 14.0]],
        ],
        Icon::Fit => &[
            &[[2.5, 6.0], [2.5, 2.5], [6.0, 2.5]],
            &[[10.0, 2.5], [13.5, 2.5], [13.5, 6.0]],
            &[[13.5, 10.0], [13.5, 13.5], [10.0, 13.5]],
            &[[6.0, 13.5], [2.5, 13.5], [2.5, 10.0]],
        ],
        Icon::Enlarge => &[
            &[[9.5, 2.5], [13.5, 2.5], [13.5, 6.5]],
            &[[13.5, 2.5], [9.0, 7.0]],
            &[[6.5, 13.5], [2.5, 13.5], [2.5, 9.5]],
            &[[2.5, 13.5], [7.0, 9.0]],
        ],
        Icon::Shrink => &[
            &[[9.0, 3.0], [9.0, 7.0], [13.0, 7.0]],
            &[[13.5, 2.5], [9.0, 7.0]],
            &[[3.0, 9.0], [7.0, 9.0], [7.0, 13.0]],
            &[[2.5, 13.5], [7.0, 9.0]],
        ],
        Icon::ChevronDown => &[&[[4.0, 6.0], [8.0, 10.0], [12.0, 6.0]]],
        Icon::ChevronRight => &[&[[6.0, 4.0], [10.0, 8.0], [6.0, 12.0]]],
        Icon::ChevronUp => &[&[[4.0, 10.0], [8.0, 6.0], [12.0, 10.0]]],
        Icon::Close => &[&[[3.5, 3.5], [12.5, 12.5]], &[[12.5, 3.5], [3.5, 12.5]]],
        Icon::Sound => &[
            &[[2.0, 6.0], [4.5, 6.0], [8.0, 3.0], [8.0, 13.0], [4.5, 10.0], [2.0, 10.0], [2.0, 6.0]],
            &[[10.3, 5.8], [11.3, 8.0], [10.3, 10.2]],
            &[[12.3, 3.8], [13.8, 8.0], [12.3, 12.2]],
        ],
        Icon::ArrowUp => &[&[[8.0, 13.0], [8.0, 3.0]], &[[4.0, 7.0], [8.0, 3.0], [12.0, 7.0]]],
        Icon::ArrowLeft => &[&[[13.0, 8.0], [3.0, 8.0]], &[[7.0, 4.0], [3.0, 8.0], [7.0, 12.0]]],
        Icon::Home => &[&[[1.8, 8.0], [8.0, 2.2], [14.2, 8.0]], &[[3.6, 6.6], [3.6, 13.8], [12.4, 13.8], [12.4, 6.6]]],
        Icon::Turn => &[
            &[[2.5, 5.0], [11.0, 5.0], [13.2, 6.2], [13.8, 8.0], [13.2, 9.8], [11.0, 11.0], [3.0, 11.0]],
            &[[6.0, 8.0], [3.0, 11.0], [6.0, 14.0]],
        ],
        Icon::Open => &[
            &[[7.0, 3.0], [2.5, 3.0], [2.5, 13.5], [13.0, 13.5], [13.0, 9.0]],
            &[[9.5, 2.5], [13.5, 2.5], [13.5, 6.5]],
            &[[13.5, 2.5], [7.5, 8.5]],
        ],
        Icon::Plus => &[&[[8.0, 3.0], [8.0, 13.0]], &[[3.0, 8.0], [13.0, 8.0]]],
        Icon::Minus => &[&[[3.0, 8.0], [13.0, 8.0]]],
        Icon::Reset => &[
            &[[2.5, 2.5], [2.5, 6.2], [6.2, 6.2]],
            &[
                [2.5, 6.2],
                [4.4, 3.6],
                [7.0, 2.4],
                [10.2, 2.8],
                [12.8, 5.0],
                [13.6, 8.0],
                [12.8, 11.0],
                [10.2, 13.2],
                [7.0, 13.6],
                [4.4, 12.4],
                [3.0, 10.4],
            ],
        ],
        Icon::None | Icon::More | Icon::Play | Icon::Pause => &[],
    }
}

const BOX: &[[f32; 2]] = &[[2.0, 3.0], [14.0, 3.0], [14.0, 13.0], [2.0, 13.0], [2.0, 3.0]];

/// Paints a picture of 16 points about `centre`.
pub fn paint(painter: &Painter, icon: Icon, centre: Pos2, colour: Color32) {
    let corner = centre - Vec2::splat(8.0);
    let at = |[x, y]: [f32; 2]| corner + Vec2::new(x, y);
    match icon {
        Icon::More => {
            for x in [3.0, 8.0, 13.0] {
                painter.circle_filled(at([x, 8.0]), 1.5, colour);
            }
        }
        Icon::Play => {
            let triangle = [[4.5, 2.5], [13.5, 8.0], [4.5, 13.5]].map(at).to_vec();
            painter.add(Shape::convex_polygon(triangle, colour, Stroke::NONE));
        }
        Icon::Pause => {
            for x in [4.0, 9.0] {
                painter.rect_filled(Rect::from_min_size(at([x, 3.0]), Vec2::new(3.0, 10.0)), 1.0, colour);
            }
        }
        _ => {
            for line in lines(icon) {
                let points = line.iter().map(|point| at(*point)).collect();
                painter.add(Shape::line(points, Stroke::new(1.4, colour)));
            }
        }
    }
}

/// Shows that what is drawn here has the keyboard's focus.
pub fn focus_ring(ui: &Ui, response: &Response, rect: Rect) {
    if response.has_focus() {
        let stroke = Stroke::new(2.0, theme::tokens(ui.visuals()).accent);
        ui.painter().rect_stroke(rect, 5.0, stroke, StrokeKind::Inside);
    }
}

/// A button with a picture, with words beside it or without.
#[derive(Clone, Copy, Debug)]
pub struct IconButton<'a> {
    icon: Icon,
    name: &'a str,
    text: &'a str,
    height: f32,
    selected: Option<bool>,
    primary: bool,
    framed: bool,
}

impl<'a> IconButton<'a> {
    /// A button called `name`, without words on it.
    pub fn new(icon: Icon, name: &'a str) -> Self {
        Self { icon, name, text: "", height: 28.0, selected: None, primary: false, framed: false }
    }

    /// With words on it.
    pub fn text(self, text: &'a str) -> Self {
        Self { text, ..self }
    }

    /// As high as this, in points.
    pub fn height(self, height: f32) -> Self {
        Self { height, ..self }
    }

    /// A switch that is on or off.
    pub fn selected(self, selected: bool) -> Self {
        Self { selected: Some(selected), ..self }
    }

    /// What people are most likely to want: filled with the accent.
    pub fn primary(self) -> Self {
        Self { primary: true, ..self }
    }

    /// On a ground of its own.
    pub fn framed(self) -> Self {
        Self { framed: true, ..self }
    }

    /// Draws it.
    pub fn show(self, ui: &mut Ui) -> Response {
        let font = TextStyle::Button.resolve(ui.style());
        let tokens = theme::tokens(ui.visuals());
        let galley = (!self.text.is_empty()).then(|| {
            WidgetText::from(self.text).into_galley(ui, Some(eframe::egui::TextWrapMode::Extend), f32::INFINITY, font)
        });
        let words = galley.as_ref().map_or(0.0, |galley| galley.size().x + 8.0);
        let padding = if words > 0.0 { 8.0 } else { 0.5 * (self.height - 16.0) };
        let picture = if self.icon == Icon::None { -8.0 } else { 16.0 };
        let size = Vec2::new(picture + words + 2.0 * padding, self.height);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        let enabled = ui.is_enabled();
        response.widget_info(|| {
            let name = if self.name.is_empty() { self.text } else { self.name };
            match self.selected {
                Some(selected) => WidgetInfo::selected(Role::Button, enabled, selected, name),
                None => WidgetInfo::labeled(Role::Button, enabled, name),
            }
        });
        if ui.is_rect_visible(rect) {
            let on = self.selected == Some(true);
            let (fill, colour) = if self.primary {
                (tokens.accent, tokens.on_accent)
            } else if on {
                (tokens.accent_fill, tokens.accent_text)
            } else if response.hovered() || response.is_pointer_button_down_on() {
                (tokens.track, tokens.text)
            } else if self.framed {
                (tokens.field, tokens.text)
            } else {
                (Color32::TRANSPARENT, tokens.text)
            };
            let fade = if enabled { 1.0 } else { 0.4 };
            let corner = CornerRadius::same(6);
            ui.painter().rect_filled(rect, corner, fill.gamma_multiply(fade));
            focus_ring(ui, &response, rect);
            let colour = colour.gamma_multiply(fade);
            paint(ui.painter(), self.icon, Pos2::new(rect.min.x + padding + 8.0, rect.center().y), colour);
            if let Some(galley) = galley {
                let at = Pos2::new(rect.min.x + padding + picture + 8.0, rect.center().y);
                let place = Align2::LEFT_CENTER.anchor_size(at, galley.size());
                ui.painter().galley(place.min, galley, colour);
            }
        }
        response
    }
}
