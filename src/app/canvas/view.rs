//! From metres, y up, to points on the screen, y down. The only place where y flips.

use eframe::egui::epaint::MarginF32;
use eframe::egui::{Pos2, Rect, Vec2};

use crate::app::state::Camera;
use crate::robot::BoundingBox;

/// Room around the workspace for the numbers of winches and axes, in points.
const NUMBERS: MarginF32 = MarginF32 { left: 44.0, right: 24.0, top: 24.0, bottom: 24.0 };
/// The workspace is drawn as if it had at least this much room, in points.
const LEAST: f32 = 40.0;

/// The map from world to screen.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The canvas on the screen.
    pub rect: Rect,
    /// Points per metre.
    pub scale: f64,
    /// Where zooming leaves things in place, unless the pointer says where.
    pub middle: Pos2,
    /// The world point that is there.
    centre: [f64; 2],
}

impl View {
    /// How an image whose first row is the lowest one is laid on the screen.
    pub const IMAGE: Rect = Rect { min: Pos2::new(0.0, 1.0), max: Pos2::new(1.0, 0.0) };

    /// Shows `frame` in `rect`, magnified and moved by `camera`. Without that, frame and numbers keep clear of `insets`,
    /// where something else covers the canvas, and are in the middle of the rest as far as the numbers leave them room.
    pub fn new(rect: Rect, insets: MarginF32, frame: BoundingBox, camera: Camera) -> Self {
        let free = rect - insets;
        let room = free - NUMBERS;
        let (size, middle) = (frame.size(), frame.middle());
        let [width, height] = [room.width(), room.height()].map(|side| f64::from(side.max(LEAST)));
        let fit = (width / size.x).min(height / size.y);
        #[expect(clippy::cast_possible_truncation)] // At most the room, which is f32.
        let half = [0.5 * size.x * fit, 0.5 * size.y * fit].map(|side| side as f32);
        let within = |middle: f32, low: f32, high: f32, half: f32| middle.max(low + half).min(high - half);
        let on_screen = Pos2::new(
            within(free.center().x, room.min.x, room.max.x, half[0]),
            within(free.center().y, room.min.y, room.max.y, half[1]),
        );
        let centre = [middle.x + camera.offset[0], middle.y + camera.offset[1]];
        Self { rect, scale: fit * camera.zoom, middle: on_screen, centre }
    }

    /// Where a world point (m, y up) is on the screen (points, y down).
    #[expect(clippy::cast_possible_truncation)] // Screen coordinates are f32.
    pub fn pos_in_ui(&self, pos_in_world: [f64; 2]) -> Pos2 {
        let [x, y] = [0, 1].map(|i| (pos_in_world[i] - self.centre[i]) * self.scale);
        self.middle + Vec2::new(x as f32, -y as f32)
    }

    /// Where a rectangle of the world is on the screen.
    pub fn rect_in_ui(&self, BoundingBox { low, high }: BoundingBox) -> Rect {
        Rect::from_two_pos(self.pos_in_ui(low.into()), self.pos_in_ui(high.into()))
    }

    /// Which world point (m, y up) is at a point of the screen (points, y down).
    pub fn pos_in_world(&self, pos_in_ui: Pos2) -> [f64; 2] {
        let [x, y] = self.vec_in_world(pos_in_ui - self.middle);
        [self.centre[0] + x, self.centre[1] + y]
    }

    /// A displacement on the screen as one in the world.
    pub fn vec_in_world(&self, vec_in_ui: Vec2) -> [f64; 2] {
        [f64::from(vec_in_ui.x) / self.scale, -f64::from(vec_in_ui.y) / self.scale]
    }

    /// The unit vector on the screen of a direction in the world.
    #[expect(clippy::cast_possible_truncation)]
    pub fn direction_in_ui(direction: [f64; 2]) -> Vec2 {
        Vec2::new(direction[0] as f32, -direction[1] as f32).normalized()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper() -> BoundingBox {
        BoundingBox { low: [-10.0, -5.0].into(), high: [10.0, 5.0].into() }
    }

    #[test]
    fn the_way_back_is_the_way_there_reversed_and_y_points_up() {
        let rect = Rect::from_min_size(Pos2::new(100.0, 50.0), Vec2::new(640.0, 480.0));
        let insets = MarginF32 { top: 90.0, ..MarginF32::ZERO };
        let view = View::new(rect, insets, paper(), Camera { zoom: 1.7, offset: [1.0, -2.0] });
        for point in [[0.0, 0.0], [3.5, -2.25], [-10.0, 5.0]] {
            let back = view.pos_in_world(view.pos_in_ui(point));
            for i in 0..2 {
                // Screen coordinates are f32 of some hundred points.
                assert!((back[i] - point[i]).abs() < 1e-4 / view.scale * 10.0, "{back:?} {point:?}");
            }
        }
        assert!(view.pos_in_ui([0.0, 1.0]).y < view.pos_in_ui([0.0, 0.0]).y);
    }

    /// Beside a desktop's answer card, on a phone, in a frame of a page, and where there is hardly any room.
    #[test]
    fn the_workspace_keeps_clear_of_what_covers_the_canvas() {
        for (size, insets) in [
            ([719.0, 508.0], MarginF32 { top: 164.0, ..MarginF32::ZERO }),
            ([360.0, 250.0], MarginF32 { top: 48.0, ..MarginF32::ZERO }),
            ([600.0, 313.0], MarginF32::ZERO),
            ([900.0, 300.0], MarginF32 { left: 340.0, ..MarginF32::ZERO }),
        ] {
            let rect = Rect::from_min_size(Pos2::new(273.0, 40.0), size.into());
            let view = View::new(rect, insets, paper(), Camera::default());
            let (shown, room) = (view.rect_in_ui(paper()), rect - insets - NUMBERS);
            assert!(room.expand(0.01).contains_rect(shown), "{shown:?} in {room:?}");
            // As large as can be.
            let fills = (shown.width() - room.width()).abs() < 0.01 || (shown.height() - room.height()).abs() < 0.01;
            assert!(fills, "{shown:?} in {room:?}");
        }
        let tiny = Rect::from_min_size(Pos2::ZERO, Vec2::new(60.0, 20.0));
        let view = View::new(tiny, MarginF32::same(30.0), paper(), Camera::default());
        assert!(view.scale > 0.0 && view.middle.is_finite(), "{view:?}");
    }

    /// Where the height limits it, the workspace is in the middle of the width.
    #[test]
    fn the_workspace_is_in_the_middle_where_the_numbers_allow_it() {
        let rect = Rect::from_min_size(Pos2::new(273.0, 40.0), Vec2::new(719.0, 508.0));
        let view = View::new(rect, MarginF32 { top: 164.0, ..MarginF32::ZERO }, paper(), Camera::default());
        assert!((view.pos_in_ui([0.0, 0.0]).x - rect.center().x).abs() < 1e-3);
    }
}
