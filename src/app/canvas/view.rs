//! From metres, y up, to points on the screen, y down. The only place where y flips.

use eframe::egui::{Pos2, Rect, Vec2};

use crate::app::state::Camera;
use crate::robot::BoundingBox;

/// Room around the robot, in points.
const MARGIN: f32 = 44.0;

/// The map from world to screen.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The canvas on the screen.
    pub rect: Rect,
    /// Points per metre.
    pub scale: f64,
    centre: [f64; 2],
}

impl View {
    /// How an image whose first row is the lowest one is laid on the screen.
    pub const IMAGE: Rect = Rect { min: Pos2::new(0.0, 1.0), max: Pos2::new(1.0, 0.0) };

    /// Shows `frame` in `rect`, magnified and moved by `camera`.
    pub fn new(rect: Rect, frame: BoundingBox, camera: Camera) -> Self {
        let room = (rect.size() - Vec2::splat(2.0 * MARGIN)).max(Vec2::splat(40.0));
        let (size, middle) = (frame.size(), frame.middle());
        let fit = (f64::from(room.x) / size.x).min(f64::from(room.y) / size.y);
        let centre = [middle.x + camera.offset[0], middle.y + camera.offset[1]];
        Self { rect, scale: fit * camera.zoom, centre }
    }

    /// Where a world point (m, y up) is on the screen (points, y down).
    #[expect(clippy::cast_possible_truncation)] // Screen coordinates are f32.
    pub fn pos_in_ui(&self, pos_in_world: [f64; 2]) -> Pos2 {
        let [x, y] = [0, 1].map(|i| (pos_in_world[i] - self.centre[i]) * self.scale);
        self.rect.center() + Vec2::new(x as f32, -y as f32)
    }

    /// Where a rectangle of the world is on the screen.
    pub fn rect_in_ui(&self, BoundingBox { low, high }: BoundingBox) -> Rect {
        Rect::from_two_pos(self.pos_in_ui(low.into()), self.pos_in_ui(high.into()))
    }

    /// Which world point (m, y up) is at a point of the screen (points, y down).
    pub fn pos_in_world(&self, pos_in_ui: Pos2) -> [f64; 2] {
        let [x, y] = self.vec_in_world(pos_in_ui - self.rect.center());
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

    #[test]
    fn the_way_back_is_the_way_there_reversed_and_y_points_up() {
        let rect = Rect::from_min_size(Pos2::new(100.0, 50.0), Vec2::new(640.0, 480.0));
        let frame = BoundingBox { low: [-10.0, -5.0].into(), high: [10.0, 5.0].into() };
        let view = View::new(rect, frame, Camera { zoom: 1.7, offset: [1.0, -2.0] });
        for point in [[0.0, 0.0], [3.5, -2.25], [-10.0, 5.0]] {
            let back = view.pos_in_world(view.pos_in_ui(point));
            for i in 0..2 {
                // Screen coordinates are f32 of some hundred points.
                assert!((back[i] - point[i]).abs() < 1e-4 / view.scale * 10.0, "{back:?} {point:?}");
            }
        }
        assert!(view.pos_in_ui([0.0, 1.0]).y < view.pos_in_ui([0.0, 0.0]).y);
    }
}
