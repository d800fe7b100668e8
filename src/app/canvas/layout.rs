//! Where things are on the screen: between the scene, which knows metres, and those who paint and grab it.

use eframe::egui::{Pos2, Rect, Vec2};

use super::arrow::{self, Arrow};
use super::{Scene, View};
use crate::app::state::Camera;
use crate::robot::BoundingBox;

/// The scene on the screen, in points.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The map from world to screen.
    pub view: View,
    /// The middle of the platform.
    pub platform: Pos2,
    /// The unit vector of the motion.
    pub ahead: Vec2,
    /// How the speed is drawn as a length.
    pub arrow: Arrow,
    /// The tip of the velocity's arrow.
    pub tip: Pos2,
    /// The winches, by cable.
    pub winches: Vec<Pos2>,
}

impl Layout {
    /// Shows `frame` of the world in `canvas`. An arrow that is `held` keeps its scale, or the speed would jump under the
    /// hand; otherwise the scale follows the room there is, and stays near `before`, the m/s per metre that it had.
    pub fn new(
        canvas: Rect,
        frame: BoundingBox,
        camera: Camera,
        scene: &Scene,
        held: Option<Arrow>,
        before: Option<f64>,
    ) -> Self {
        let view = View::new(canvas, frame, camera);
        let platform = view.pos_in_ui(scene.platform);
        let ahead = View::direction_in_ui(scene.direction);
        let arrow = held.unwrap_or_else(|| {
            let room = arrow::room(canvas, platform, ahead);
            Arrow::new(scene.speed, view.scale, room, scene.frame.size().x, before)
        });
        let tip = platform + ahead * arrow.away(scene.speed, view.scale);
        let winches = scene.cables.iter().map(|cable| view.pos_in_ui(cable.anchor)).collect();
        Self { view, platform, ahead, arrow, tip, winches }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::answers::Answers;
    use crate::app::state::Playback;
    use crate::scenario::presets;

    #[test]
    fn things_are_where_the_view_puts_them_and_a_held_arrow_keeps_its_scale() {
        let mut scenario = presets::PRESETS[0].scenario();
        scenario.motion.direction = [0.0, 2.0];
        let scene = Scene::new(&scenario, &Answers::default(), &Playback::default());
        let canvas = Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(600.0, 400.0));
        let layout = Layout::new(canvas, scene.frame, Camera::default(), &scene, None, None);
        assert_eq!(layout.platform, layout.view.pos_in_ui(scenario.motion.position));
        assert_eq!(layout.winches.len(), scenario.cables.len());
        assert!((layout.ahead - Vec2::UP).length() < 1e-6 && layout.tip.y < layout.platform.y, "{layout:?}");
        assert!(canvas.contains(layout.tip), "{layout:?}");
        scenario.motion.speed *= 100.0;
        let fast = Scene::new(&scenario, &Answers::default(), &Playback::default());
        let held = Layout::new(canvas, fast.frame, Camera::default(), &fast, Some(layout.arrow), None);
        assert_eq!(held.arrow, layout.arrow);
        assert!(!canvas.contains(held.tip));
        let free = Layout::new(canvas, fast.frame, Camera::default(), &fast, None, Some(layout.arrow.step));
        assert!(canvas.contains(free.tip) && free.arrow.step > layout.arrow.step, "{free:?}");
    }
}
