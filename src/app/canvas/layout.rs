//! Where things are on the screen: between the scene, which knows metres, and those who paint and grab it.

use eframe::egui::{Pos2, Rect, Vec2};

use super::arrow::{self, Arrow, Ground};
use super::{Scene, View};

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
    /// Points from the platform to the end of its line on the canvas.
    room: f32,
}

/// A speed marked on the line of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedMark {
    /// Where it is; where that is not on the canvas, the end of the line on it.
    pub at: Pos2,
    /// Whether it lies beyond the canvas.
    pub beyond: bool,
}

/// The arrow of the frame before, and what is done to it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Before {
    /// The arrow, where there was one.
    pub arrow: Option<Arrow>,
    /// Whether a pointer is pressed.
    pub pressed: bool,
    /// Whether it holds the arrow's tip.
    pub held: bool,
}

impl Layout {
    /// Shows a scene through `view`, the arrow within `free`, the part of the canvas that nothing covers. An arrow that is held
    /// keeps its scale, or the speed would jump under the hand.
    pub fn new(view: View, free: Rect, scene: &Scene, before: Before) -> Self {
        let platform = view.pos_in_ui(scene.platform);
        let ahead = View::direction_in_ui(scene.direction);
        let within = if free.contains(platform) { free } else { view.rect };
        let room = arrow::room(within, platform, ahead);
        let arrow = before.arrow.filter(|_| before.held && before.pressed).unwrap_or_else(|| {
            let ground = Ground { scale: view.scale, room, width: scene.frame.size().x };
            let step = before.arrow.map(|arrow| arrow.step);
            Arrow::new(scene.speed, scene.farthest_mark, ground, step, before.pressed)
        });
        let tip = platform + ahead * arrow.away(scene.speed, view.scale);
        let winches = scene.cables.iter().map(|cable| view.pos_in_ui(cable.anchor)).collect();
        Self { view, platform, ahead, arrow, tip, winches, room }
    }

    /// Where a speed in m/s is marked; nowhere where the platform itself is not on the canvas.
    pub fn mark(&self, speed: f64) -> Option<SpeedMark> {
        if self.room.is_infinite() {
            return None;
        }
        let away = self.arrow.away(speed, self.view.scale);
        Some(SpeedMark { at: self.platform + self.ahead * away.min(self.room), beyond: away > self.room })
    }

    /// The unit vector across the motion that points up on the screen, to the right where the motion goes straight up or down.
    pub fn up(&self) -> Vec2 {
        let across = self.ahead.rot90();
        let is_up = if across.y.abs() > 1e-3 { across.y < 0.0 } else { across.x > 0.0 };
        if is_up { across } else { -across }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::answers::Answers;
    use crate::app::canvas::model::First;
    use crate::app::state::{Camera, Playback};
    use crate::scenario::{Scenario, presets};
    use crate::stability::Instability;
    use eframe::egui::epaint::MarginF32;

    fn canvas() -> Rect {
        Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(600.0, 400.0))
    }

    fn scene(scenario: &Scenario) -> Scene {
        Scene::new(scenario, &Answers::default(), &Playback::default())
    }

    fn view(scene: &Scene) -> View {
        View::new(canvas(), MarginF32::ZERO, scene.frame, Camera::default())
    }

    #[test]
    fn things_are_where_the_view_puts_them_and_a_held_arrow_keeps_its_scale() {
        let mut scenario = presets::PRESETS[0].scenario();
        scenario.motion.direction = [0.0, 2.0];
        let slow = scene(&scenario);
        let layout = Layout::new(view(&slow), canvas(), &slow, Before::default());
        assert_eq!(layout.platform, layout.view.pos_in_ui(scenario.motion.position));
        assert_eq!(layout.winches.len(), scenario.cables.len());
        assert!((layout.ahead - Vec2::UP).length() < 1e-6 && layout.tip.y < layout.platform.y, "{layout:?}");
        assert!((layout.up() - Vec2::RIGHT).length() < 1e-6, "{layout:?}");
        assert!(canvas().contains(layout.tip), "{layout:?}");
        scenario.motion.speed *= 100.0;
        let fast = scene(&scenario);
        let before = Before { arrow: Some(layout.arrow), pressed: true, held: true };
        let held = Layout::new(view(&fast), canvas(), &fast, before);
        assert_eq!(held.arrow, layout.arrow);
        assert!(!canvas().contains(held.tip));
        let free = Layout::new(view(&fast), canvas(), &fast, Before { held: false, pressed: false, ..before });
        assert!(canvas().contains(free.tip) && free.arrow.step > layout.arrow.step, "{free:?}");
    }

    #[test]
    fn the_critical_speed_is_marked_on_the_canvas_wherever_the_platform_is() {
        let mut scenario = presets::PRESETS[0].scenario();
        for x in [-6.0, 0.0, 5.0, 9.0] {
            scenario.motion.position = [x, 0.0];
            let critical = First { speed: 11.3, cable: 3, kind: Instability::Flutter };
            let scene = Scene { critical: Some(critical), waves: Some(11.9), farthest_mark: 11.9, ..scene(&scenario) };
            let layout = Layout::new(view(&scene), canvas(), &scene, Before::default());
            let [critical, waves] = [11.3, 11.9].map(|speed| layout.mark(speed).expect("a platform in view"));
            assert!(!critical.beyond && !waves.beyond && canvas().contains(waves.at), "{x}: {waves:?}");
            assert!(layout.tip.x < critical.at.x && critical.at.x < waves.at.x, "{x}: {layout:?}");
            // What is far off is at the border.
            let far = layout.mark(900.0).expect("a platform in view");
            assert!(far.beyond && canvas().contains(far.at) && far.at.x > canvas().max.x - 20.0, "{x}: {far:?}");
        }
    }
}
